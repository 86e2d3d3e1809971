(* Leaves over the region of an anchor.

   Continues Anchor.v.  Over a proper interval [lo, hi] let u in [0, 1] with t = lo + u (hi - lo),
   and let X(u) be the exact condensed matrix at t, its rows multiplied by positive numbers.

   Theorems [local_line], [local_chord]: X is near a line, and near chords, of the local pencil.
   Theorem [anchored_excludes]: a checked leaf that is not a solution excludes every solution of the
   region.  Theorem [anchored_yields]: a checked root leaf with the outcome "solution" has exactly
   one solution in its region, up to a positive factor.

   A pinned region has at most one null vector, by the chord through two values.  Theorems
   [anchored_claimed], [anchored_beside]: the region of a known solution has exactly this one, or
   none.  [anchored_limit]: if there is a null vector at the lower end lo, then every solution of
   the region has the value lo.

   Page: spec/certificates.md, 5.14.
   Rust: crates/check/src/cover/expanded.rs, family.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Farkas Covered Definite Root RootLeaf
  Existence Pinned Cover Condensation Pencil Claim Complete Norms Elimination Series Anchor.

Lemma floor_bounds x g : (0 <? g)%Z -> (x / g * g <=? x)%Z && (x <=? (x / g + 1) * g)%Z.
Proof.
move=> /Z.ltb_spec0 g0; have := Z.mul_div_le x g g0; have := Z.mul_succ_div_gt x g g0.
move: (x / g)%Z => f; clear g0 => above below.
by apply/andP; split; apply/Z.leb_spec0; move: above below; clear; nia.
Qed.

Section Rounding.

Variable R : rcfType.

Lemma divide_up_real x d : (0 <? d)%Z -> toR x / toR d <= toR (divide_up x d) :> R.
Proof.
move=> d0; have d0R : 0 < toR d :> R by rewrite toR_gt0.
by rewrite ler_pdivr_mulr // -toRM toR_le divide_up_ge.
Qed.

Lemma divide_up_le (x : R) z d : 0 < toR d :> R -> x = toR z / toR d -> x <= toR (divide_up z d).
Proof. by rewrite toR_gt0 => d0 ->; apply: divide_up_real. Qed.

(* The radii of Anchor.v, for n = n1/n2 and so on, and s = b/c. *)
Lemma radius_le (pw n1 n2 r1 r2 b c : Z) (n r : R) :
  0 < toR n2 :> R -> 0 < toR r2 :> R -> 0 < toR b :> R -> 0 < toR c :> R ->
  toR n1 = toR n2 * n -> toR r1 = toR r2 * r ->
  toR pw * (n * r / (toR b / toR c)) <= toR (divide_up (pw * n1 * r1 * c) (n2 * r2 * b)).
Proof.
move=> n0 r0 b0 c0 nE rE; apply: divide_up_le; first by rewrite !toRM !mulr_gt0.
by rewrite !toRM nE rE; field; rewrite !gt_eqF.
Qed.

Lemma slope_le (pw e y n1 n2 r1 r2 b c : Z) (n r : R) :
  0 < toR y :> R -> 0 < toR n2 :> R -> 0 < toR r2 :> R -> 0 < toR b :> R -> 0 < toR c :> R ->
  toR n1 = toR n2 * n -> toR r1 = toR r2 * r ->
  toR pw * (toR e / toR y) * (n * r / (toR b / toR c)) <=
  toR (divide_up (pw * e * n1 * r1 * c) (y * n2 * r2 * b)).
Proof.
move=> y0 n0 r0 b0 c0 nE rE; apply: divide_up_le; first by rewrite !toRM !mulr_gt0.
by rewrite !toRM nE rE; field; rewrite !gt_eqF.
Qed.

Lemma square_le (pw e y n1 n2 r1 r2 b c m : Z) (n r : R) :
  0 < toR y :> R -> 0 < toR n2 :> R -> 0 < toR r2 :> R -> 0 < toR b :> R -> 0 < toR c :> R ->
  toR n1 = toR n2 * n -> toR r1 = toR r2 * r ->
  toR pw * (toR e / toR y) * (n * r * toR m / (toR b / toR c) ^+ 2) <=
  toR (divide_up (pw * e * n1 * r1 * m * c * c) (y * n2 * r2 * b * b)).
Proof.
move=> y0 n0 r0 b0 c0 nE rE; apply: divide_up_le; first by rewrite !toRM !mulr_gt0.
by rewrite !toRM nE rE; field; rewrite !gt_eqF.
Qed.

Lemma rounding g scale e r (alpha : R) : (0 <? g)%Z -> 0 < toR scale :> R ->
  `|alpha - toR e| <= toR r ->
  `|toR scale / toR g * alpha - toR (scale * e / g)%Z| <= toR (divide_up (scale * r) g + 1)%Z.
Proof.
move=> g0 s0 near; have g0R : 0 < toR g :> R by rewrite toR_gt0.
set f := (scale * e / g)%Z.
have floor : 0 <= toR scale * toR e / toR g - toR f :> R /\
             toR scale * toR e / toR g - toR f <= 1 :> R.
  rewrite subr_ge0 ler_subl_addr ler_pdivl_mulr // ler_pdivr_mulr // -toR1 -toRD -!toRM !toR_le.
  have /andP[le1 le2] := floor_bounds (scale * e) g0.
  by rewrite [(1 + f)%Z]Z.add_comm.
have -> : toR scale / toR g * alpha - toR f =
    toR scale / toR g * (alpha - toR e) + (toR scale * toR e / toR g - toR f) by ring.
rewrite toRD toR1 (le_trans (ler_norm_add _ _)) // ler_add //; last first.
  by rewrite ger0_norm; case: floor.
rewrite normrM ger0_norm ?divr_ge0 ?(ltW s0) ?(ltW g0R) //.
apply: (@le_trans _ _ (toR scale * toR r / toR g)).
  by rewrite [X in X <= _]mulrAC ler_pmul2r ?invr_gt0 // ler_pmul2l.
by rewrite -toRM divide_up_real.
Qed.

End Rounding.

(* A member A + t B of a pencil over an interval. *)
Section Local.

Variables (R : rcfType) (Q : pencil) (A B : nat -> nat -> R) (a : anchor) (fam : anchor_family).
Variables (low_a low_b : form_bound) (lo hi : point) (grain : Z).
Hypothesis ready : prepared_member Q A B a fam low_a low_b lo hi.
Hypothesis grain0 : (0 <? grain)%Z.
Notation ns := (size (slip Q)).
Notation nf := (size (free Q)).
Notation fi := (iota 0 nf).
Notation si := (iota 0 ns).
Notation y := (member_reaction (order Q) A B).

Let wf : wellformed Q := let: And5 w _ _ _ _ := ready in w.
Let parts := let: And5 _ p _ _ _ := ready in p.
Let bounded : free_bounded Q A B low_a low_b := let: And5 _ _ b _ _ := ready in b.
Let near : family_bounds Q A B a fam := let: And5 _ _ _ n _ := ready in n.
Let proper : proper_interval a low_a low_b lo hi := let: And5 _ _ _ _ p := ready in p.

Notation p := (anchor_center a).1.
Notation q := (anchor_center a).2.
Notation off := (offset a lo hi).
Notation ext := (extent a lo hi).
Notation uy := (unit_y a lo hi).
Notation width := (interval_width lo hi).
Notation bn := (lower_n a low_a low_b lo).
Notation bd := (lower_d low_a low_b lo).

Lemma proper_parts :
  [/\ 0 <= toR lo.1 :> R, 0 < toR lo.2 :> R, 0 < toR hi.2 :> R, 0 < toR width :> R &
      0 < toR bn :> R].
Proof. by case/and5P: proper => *; split; rewrite ?toR_ge0 ?toR_gt0. Qed.

Lemma q_gt0 : 0 < toR q :> R.
Proof. by have [] := parts. Qed.

Lemma uy_gt0 : 0 < toR uy :> R.
Proof. by have [_ l2 h2 _ _] := proper_parts; rewrite !toRM !mulr_gt0 // q_gt0. Qed.

Lemma ext_gt0 : 0 < toR ext :> R.
Proof. by have [_ _ _ w0 _] := proper_parts; rewrite toRM mulr_gt0 // q_gt0. Qed.

Lemma bd_gt0 : 0 < toR bd :> R.
Proof.
have [_ l2 _ _ _] := proper_parts; have [[ca0 _ _] [cb0 _ _]] := bounded.
by rewrite !toRM !mulr_gt0.
Qed.

(* t and d at u. *)
Definition t_of (u : R) := (toR (lo.1 * hi.2)%Z + u * toR width) / toR (lo.2 * hi.2)%Z.
Definition d_of (u : R) := (toR off + u * toR ext) / toR uy.

Definition s_low : R := toR bn / toR bd.

Lemma s_low_gt0 : 0 < s_low.
Proof. by have [_ _ _ _ b0] := proper_parts; rewrite divr_gt0 // bd_gt0. Qed.

Lemma d_ofE u : toR off + toR ext * u = toR uy * d_of u.
Proof. by rewrite /d_of [RHS]mulrC divfK ?gt_eqF ?uy_gt0 // [toR ext * u]mulrC. Qed.

Lemma t_ofE u : toR q * t_of u = toR p + toR q * d_of u.
Proof.
have [_ l2 h2 _ _] := proper_parts; have q0 := q_gt0.
have [/lt0r_neq0 l2' /lt0r_neq0 h2' /lt0r_neq0 q0'] := And3 l2 h2 q0.
rewrite /t_of /d_of /unit_y /extent /offset /interval_width !toRM !toRB !toRM.
by field; rewrite l2' h2' q0'.
Qed.

Section AtU.

Variable u : R.
Hypotheses (u0 : 0 <= u) (u1 : u <= 1).

Lemma lo_le_t : toR lo.1 / toR lo.2 <= t_of u.
Proof.
have [_ l2 h2 w0 _] := proper_parts; rewrite -subr_ge0 /t_of.
have -> : (toR (lo.1 * hi.2)%Z + u * toR width) / toR (lo.2 * hi.2)%Z - toR lo.1 / toR lo.2 =
          u * toR width / (toR lo.2 * toR hi.2).
  by rewrite !toRM; field; rewrite !gt_eqF.
by rewrite divr_ge0 // mulr_ge0 // ltW.
Qed.

Lemma t_of_ge0 : 0 <= t_of u.
Proof.
have [l1 l2 _ _ _] := proper_parts; apply: le_trans lo_le_t.
by rewrite divr_ge0 // ltW.
Qed.

Lemma below_at_u : bounded_below nf (F_at Q A B a (d_of u)) s_low.
Proof.
have [l1 l2 _ _ _] := proper_parts; have [[ca _ _] [cb _ _]] := bounded.
have lo0 : 0 <= toR lo.1 / toR lo.2 :> R by rewrite divr_ge0 // ltW.
have := F_below bounded q_gt0 (t_ofE u) lo0 lo_le_t.
congr (bounded_below _ _ _); rewrite /s_low /lower_n /lower_d !toRM !toRD !toRM.
have [/lt0r_neq0 l2' /lt0r_neq0 ca' /lt0r_neq0 cb'] := And3 l2 ca cb.
by field; rewrite l2' ca' cb'.
Qed.

Definition b_reach : R := toR (reach a lo hi) / toR uy.

Lemma d_bounded : `|d_of u| <= b_reach.
Proof.
have y0 := uy_gt0; rewrite /d_of /b_reach normrM [`|_^-1|]ger0_norm ?invr_ge0 ?(ltW y0) //.
rewrite ler_pmul2r ?invr_gt0 //.
have -> : toR off + u * toR ext = (1 - u) * toR off + u * (toR off + toR ext) by ring.
have v0 : 0 <= 1 - u by rewrite subr_ge0.
rewrite (le_trans (ler_norm_add _ _)) // !normrM (ger0_norm u0) (ger0_norm v0).
have one : `|toR off| <= toR (reach a lo hi) :> R.
  by rewrite -toR_abs toR_le /reach; move: (Z.abs _) (Z.abs _) => x y; clear; lia.
have two : `|toR off + toR ext| <= toR (reach a lo hi) :> R.
  by rewrite -toRD -toR_abs toR_le /reach; move: (Z.abs _) (Z.abs _) => x y; clear; lia.
have -> : toR (reach a lo hi) = (1 - u) * toR (reach a lo hi) + u * toR (reach a lo hi) :> R.
  by ring.
by rewrite ler_add // ler_wpmul2l.
Qed.

End AtU.

Lemma reachE : toR (reach a lo hi) = toR uy * b_reach.
Proof. by rewrite /b_reach mulrC divfK // gt_eqF // uy_gt0. Qed.

(* Bounds of norms over the interval, and of Z of the member. *)
Definition nl i : R := eval (nth [::] (left_norms fam) i) b_reach.
Definition nr j : R := eval (nth [::] (right_norms fam) j) b_reach.
Definition far i j : R := eval (poly_of (spread_z fam) i j) b_reach.

Definition remainder_at u i j := \sum_(k <- fi) l_at Q A B a (d_of u) i k *
  solve nf (F_at Q A B a (d_of u)) (r_at Q A B a (d_of u) j) k.

Lemma bounds_at u i j : 0 <= u -> u <= 1 -> (i < ns)%N -> (j < ns)%N ->
  [/\ norm_le fi (l_at Q A B a (d_of u) i) (nl i), norm_le fi (r_at Q A B a (d_of u) j) (nr j) &
      `|z_at Q A B a (d_of u) i j - value (series_z fam) (d_of u) i j| <= far i j].
Proof.
move=> u0 u1 Hi Hj; exact: (near (t_ofE u) (t_of_ge0 u0) (d_bounded u0 u1) Hi Hj).
Qed.

Lemma remainder_bound u i j : 0 <= u -> u <= 1 -> (i < ns)%N -> (j < ns)%N ->
  `|remainder_at u i j| <= nl i * nr j / s_low.
Proof.
move=> u0 u1 Hi Hj; have [l_le r_le _] := bounds_at u0 u1 Hi Hj.
by rewrite -mulrA; apply: dot_bound (solve_norm s_low_gt0 (below_at_u u0) r_le).
Qed.

(* The same with the integers of the checker. *)
Definition at_reach := homogeneous (reach a lo hi) uy.

Lemma at_reachE n : toR (at_reach n).1 = toR (at_reach n).2 * eval n b_reach /\
  0 < toR (at_reach n).2 :> R.
Proof.
split; first exact: homogeneousE reachE.
exact: homogeneous_power uy_gt0.
Qed.

Lemma remainder_radius_bound power i j : 0 < toR power :> R ->
  toR power * (nl i * nr j / s_low) <=
  toR (remainder_radius a low_a low_b lo power (at_reach (nth [::] (left_norms fam) i))
         (at_reach (nth [::] (right_norms fam) j))).
Proof.
move=> p0; have [_ _ _ _ b0] := proper_parts; have d0 := bd_gt0.
have [lE l0] := at_reachE (nth [::] (left_norms fam) i).
have [rE r0] := at_reachE (nth [::] (right_norms fam) j).
exact: radius_le.
Qed.

Lemma far_bound power i j : 0 < toR power :> R -> toR power * far i j <=
  toR (divide_up (power * (at_reach (poly_of (spread_z fam) i j)).1)
         (at_reach (poly_of (spread_z fam) i j)).2).
Proof.
move=> p0; have [eE e0] := at_reachE (poly_of (spread_z fam) i j).
by apply: divide_up_le => //; rewrite toRM eE mulrCA mulrC mulfK // gt_eqF.
Qed.

(* The exact entries, multiplied by 4, by the power of the substitution and by u^2. *)
Notation u2 := (toR (anchor_unit a) ^+ 2 : R).
Definition power_z : Z := (substituted off ext uy (poly_of (series_z fam) 0 0)).2.

Definition raw u i j := 4%:R * toR power_z * (u2 * condensed_family Q A B a (d_of u) i j).

Definition coefficients i j : polynomial :=
  (substituted off ext uy (poly_of (series_z fam) i j)).1.

Definition exact_entry slopes i j : local_entry :=
  entry_of a low_a low_b fam lo hi slopes (poly_of (series_z fam) i j)
    (at_reach (nth [::] (left_norms fam) i)) (at_reach (nth [::] (right_norms fam) j))
    (at_reach (derivative (nth [::] (left_norms fam) i)))
    (at_reach (derivative (nth [::] (right_norms fam) j)))
    (at_reach (poly_of (spread_z fam) i j)).

Lemma power_same i j :
  (substituted off ext uy (poly_of (series_z fam) i j)).2 = power_z.
Proof. by apply: substituted_power_size; rewrite !size_map. Qed.

Lemma power_gt0 : 0 < toR power_z :> R.
Proof. exact: substituted_power uy_gt0. Qed.

Lemma four z : toR (4 * z)%Z = 4%:R * toR z :> R.
Proof. by rewrite toRM. Qed.

Definition entry_radius i j : Z :=
  (divide_up (power_z * (at_reach (poly_of (spread_z fam) i j)).1)
     (at_reach (poly_of (spread_z fam) i j)).2 +
   remainder_radius a low_a low_b lo power_z (at_reach (nth [::] (left_norms fam) i))
     (at_reach (nth [::] (right_norms fam) j)))%Z.

Definition entry_slope i j : Z :=
  remainder_slope a low_a low_b fam lo hi power_z
    (at_reach (nth [::] (left_norms fam) i)) (at_reach (nth [::] (right_norms fam) j))
    (at_reach (derivative (nth [::] (left_norms fam) i)))
    (at_reach (derivative (nth [::] (right_norms fam) j))).

Section Parts.

Variables (slopes : bool) (i j : nat).
Notation c := (coefficients i j).
Notation e := (exact_entry slopes i j).

Lemma part_a : local_a e = (4 * constant_of c)%Z.
Proof. by []. Qed.

Lemma part_b : local_b e = (4 * chord_of c)%Z.
Proof. by []. Qed.

Lemma part_rb : local_rb e = if slopes then (8 * spread c + 4 * entry_slope i j)%Z else 0%Z.
Proof. by rewrite /exact_entry /entry_of power_same. Qed.

Lemma part_ra : local_ra e = (spread c + 4 * entry_radius i j + local_rb e)%Z.
Proof. by rewrite part_rb /exact_entry /entry_of power_same. Qed.

End Parts.

Lemma rawE u i j : 0 <= u ->
  raw u i j = 4%:R * (toR power_z * (z_at Q A B a (d_of u) i j - remainder_at u i j)).
Proof.
move=> u0; rewrite /raw (condensed_residual s_low_gt0 (below_at_u u0)
  _ _ _ (toR (anchor_unit a)) (right_at a (d_of u)) (left_at a (d_of u))).
by rewrite mulrA.
Qed.

Lemma coefficientsE u i j :
  eval (coefficients i j) u = toR power_z * value (series_z fam) (d_of u) i j.
Proof. by rewrite (substitutedE _ (d_ofE u)) power_same. Qed.

Lemma raw_line slopes u i j : 0 <= u -> u <= 1 -> (i < ns)%N -> (j < ns)%N ->
  let e := exact_entry slopes i j in
  `|raw u i j - (toR (local_a e) + u * toR (local_b e))| <= toR (local_ra e) - toR (local_rb e).
Proof.
move=> u0 u1 Hi Hj; cbv zeta; rewrite part_a part_b part_ra rawE // !toRD addrK !four.
set c := coefficients i j; have [_ _ z_le] := bounds_at u0 u1 Hi Hj.
set z := z_at Q A B a _ i j in z_le *; set e := value _ _ i j in z_le.
have -> : 4%:R * (toR power_z * (z - remainder_at u i j)) -
    (4%:R * toR (constant_of c) + u * (4%:R * toR (chord_of c))) =
    (eval c u - (toR (constant_of c) + u * toR (chord_of c))) *+ 4 +
    (toR power_z * (z - e) - toR power_z * remainder_at u i j) *+ 4.
  by rewrite coefficientsE -/e; move: (remainder_at _ _ _) (toR (chord_of c)) => *; ring.
rewrite (le_trans (ler_norm_add _ _)) // ler_add //.
  by rewrite normrMn; apply: near_chord_poly.
rewrite normrMn mulr_natl ler_muln2r /= /entry_radius toRD (le_trans (ler_norm_sub _ _)) //.
rewrite !normrM (gtr0_norm power_gt0) ler_add //.
  by apply: le_trans (far_bound _ _ power_gt0); rewrite ler_pmul2l ?power_gt0.
apply: le_trans (remainder_radius_bound _ _ power_gt0).
by rewrite ler_pmul2l ?power_gt0 // remainder_bound.
Qed.

(* The family of the local pencil. *)
Definition scale_at i : R := toR (nth 0%Z (anchor_scale a) i) / toR grain.
Definition local_family u i j := scale_at i * raw u i j.

Notation pencil_for := (local_pencil ns a low_a low_b fam lo hi).

Lemma scale_gt0_ i : (i < ns)%N -> 0 < toR (nth 0%Z (anchor_scale a) i) :> R.
Proof. by have [_ _ s0] := parts; apply: s0. Qed.

Lemma local_entriesE slopes i j (f : local_entry -> Z) : (i < ns)%N -> (j < ns)%N ->
  entry [seq [seq f e | e <- row] | row <- local_entries ns a low_a low_b fam lo hi slopes grain]
    i j = f (rounded grain (nth 0%Z (anchor_scale a) i) (exact_entry slopes i j)).
Proof.
move=> Hi Hj; pose at_zero := homogeneous (reach a lo hi) uy.
have nthE (g : polynomial -> polynomial) (L : seq polynomial) k : g [::] = [::] ->
    nth (0%Z, 1%Z) [seq at_zero (g n) | n <- L] k = at_zero (g (nth [::] L k)).
  move=> g0; have [l|l] := ltnP k (size L); first by rewrite (nth_map [::]).
  by rewrite !nth_default ?size_map // g0.
rewrite /entry /local_entries (nth_map [::]) ?size_map ?size_iota //.
rewrite (nth_map 0%N) ?size_iota // (nth_map (LocalEntry 0 0 0 0)) ?size_map ?size_iota //.
rewrite (nth_map 0%N) ?size_iota // !nth_iota // !add0n; congr (f (rounded _ _ _)).
by rewrite /exact_entry !(nthE id) // !(nthE derivative).
Qed.

Lemma in_local i slopes : i \in indices (pencil_for slopes grain) -> (i < ns)%N.
Proof. by rewrite mem_iota. Qed.

(* A pencil through given values is enclosed if its entries are near. *)
Lemma local_encloses slopes (A' B' : nat -> nat -> R) :
  (forall i j, (i < ns)%N -> (j < ns)%N ->
     let e := exact_entry slopes i j in
     `|A' i j - toR (local_a e)| <= toR (local_ra e) /\
     `|B' i j - toR (local_b e)| <= toR (local_rb e)) ->
  encloses (pencil_for slopes grain)
    (fun i j => scale_at i * A' i j) (fun i j => scale_at i * B' i j).
Proof.
move=> close i j /in_local Hi /in_local Hj; have [near_a near_b] := close i j Hi Hj.
rewrite /local_pencil /= !local_entriesE //=.
by split; apply: rounding => //; apply: scale_gt0_.
Qed.

Theorem local_line u : 0 <= u -> u <= 1 -> near_line (pencil_for false grain) local_family u.
Proof.
move=> u0 u1; pose e i j := exact_entry false i j.
pose B' i j : R := toR (local_b (e i j)); pose A' i j := raw u i j - u * B' i j.
exists (fun i j => scale_at i * A' i j), (fun i j => scale_at i * B' i j); split; last first.
  move=> i j _ _; rewrite /Enclosed.T /local_family /A'.
  by move: (scale_at i) (raw u i j) (B' i j) => *; ring.
apply: local_encloses => i j Hi Hj.
have rb0 : toR (local_rb (e i j)) = 0 :> R by rewrite /e part_rb.
have near_u : `|raw u i j - (toR (local_a (e i j)) + u * toR (local_b (e i j)))| <=
    toR (local_ra (e i j)) - toR (local_rb (e i j)) := raw_line false u0 u1 Hi Hj.
rewrite rb0 subr0 in near_u; split; last by rewrite -/(e i j) rb0 /B' subrr normr0.
by rewrite /A' /B' -/(e i j) -addrA -opprD [u * _ + _]addrC.
Qed.

(* Between t and u. *)
Definition u_of (t : R) := (t * toR (lo.2 * hi.2)%Z - toR (lo.1 * hi.2)%Z) / toR width.

Lemma t_of_u t : t_of (u_of t) = t.
Proof.
have [_ l2 h2 w0 _] := proper_parts; rewrite /t_of /u_of.
have m0 : toR (lo.2 * hi.2)%Z != 0 :> R by rewrite toRM mulf_neq0 ?gt_eqF.
by rewrite divfK ?gt_eqF // addrC subrK mulfK.
Qed.

Lemma u_of_between t : between t lo hi -> 0 <= u_of t /\ u_of t <= 1.
Proof.
have [_ l2 h2 w0 _] := proper_parts; case=> lo_t t_hi; rewrite /u_of; split.
  rewrite divr_ge0 ?(ltW w0) // subr_ge0 !toRM mulrA ler_pmul2r //.
rewrite ler_pdivr_mulr // mul1r /interval_width toRB !toRM ler_sub //.
by rewrite mulrCA mulrC ler_pmul2r.
Qed.

Lemma between_local u (e e' : point) :
  between u (local_point lo hi e) (local_point lo hi e') <-> between (t_of u) e e'.
Proof.
have [_ l2 h2 w0 _] := proper_parts.
have m0 : 0 < toR (lo.2 * hi.2)%Z :> R by rewrite toRM mulr_gt0.
have tE : t_of u * toR (lo.2 * hi.2)%Z = toR (lo.1 * hi.2)%Z + u * toR width.
  by rewrite /t_of divfK // gt_eqF.
have localE (x : point) : (t_of u * toR x.2 - toR x.1) * toR (lo.2 * hi.2)%Z =
    u * toR (local_point lo hi x).2 - toR (local_point lo hi x).1.
  by rewrite mulrBl mulrAC tE /local_point /= !toRM !toRB !toRM; ring.
by rewrite /between -![_ <= t_of u * _]subr_ge0 -![t_of u * _ <= _]subr_le0
  -(pmulr_lge0 _ m0) -[in X in _ <-> X](pmulr_lle0 _ m0) !localE subr_ge0 subr_le0.
Qed.

Lemma between_t u : 0 <= u -> u <= 1 -> between (t_of u) lo hi.
Proof.
move=> u0 u1; have [_ l2 h2 w0 _] := proper_parts; split.
  by rewrite -ler_pdivr_mulr // lo_le_t.
rewrite -(ler_pmul2r l2) -mulrA [toR hi.2 * _]mulrC -toRM /t_of divfK; last first.
  by rewrite toRM mulf_neq0 // gt_eqF.
apply: (@le_trans _ _ (toR (lo.1 * hi.2)%Z + toR width)).
  by rewrite ler_add2l ler_pimull // ltW.
by rewrite /interval_width -toRD -toRM toR_le; move: (hi.1 * lo.2)%Z => x; clear; lia.
Qed.

(* Solutions of the pencil and of the family. *)
Definition free_values u xs :=
  Elimination.free_part nf (F_at Q A B a (d_of u)) ns (G_at Q A B a (d_of u)) xs.

(* The free rows vanish where the free variables have these values. *)
Lemma free_values_rows u x : 0 <= u ->
  (forall i, i \in free Q -> y (t_of u) x i = 0) <->
  (forall k, k \in fi -> free_of Q x k = free_values u (slip_of Q x) k).
Proof.
move=> u0; apply: iff_trans (free_rows_vanish s_low_gt0 (below_at_u u0) _ _ _ _).
split=> [rows k /in_free lt_k|rows i /(nthP 0%N)[k lt_k <-]].
  by rewrite -(reaction_free_at A B wf x _ (t_ofE u)) // rows ?mulr0 // mem_nth.
apply: (mulfI (lt0r_neq0 q_gt0)); rewrite mulr0 (reaction_free_at A B wf x _ (t_ofE u)).
by apply: rows; rewrite mem_iota.
Qed.

(* Values of the complementarity variables, and those of the free ones. *)
Definition joined u xs := join Q (free_values u xs) xs.

Lemma slip_of_joined u xs j : (j < ns)%N -> slip_of Q (joined u xs) j = xs j.
Proof. exact: slip_of_join. Qed.

Lemma joined_values u xs k : k \in fi ->
  free_of Q (joined u xs) k = free_values u (slip_of Q (joined u xs)) k.
Proof.
move=> /in_free Hk; rewrite free_of_join // /free_values /Elimination.free_part; congr (- _).
by apply: sum_eq => j; rewrite mem_iota => Hj; rewrite slip_of_joined.
Qed.

Definition row_factor_at i : R := scale_at i * (4%:R * toR power_z * u2) * toR q.

Lemma row_factor_gt0_ i : (i < ns)%N -> 0 < row_factor_at i.
Proof.
move=> Hi; have [q0 u0 s0] := parts.
rewrite !mulr_gt0 ?power_gt0 ?exprn_gt0 ?ltr0n // ?s0 //.
by rewrite invr_gt0 toR_gt0.
Qed.

Lemma local_image slopes u x i : 0 <= u -> (i < ns)%N ->
  (forall k, k \in fi -> free_of Q x k = free_values u (slip_of Q x) k) ->
  family_image (pencil_for slopes grain) local_family u (slip_of Q x) i =
  row_factor_at i * y (t_of u) x (nth 0%N (slip Q) i).
Proof.
move=> u0 Hi part; rewrite /row_factor_at -!mulrA.
rewrite (reaction_slip_at A B wf x _ (t_ofE u)) (condensed_row _ _ i part) !mulr_sumr.
by rewrite /family_image; apply: eq_bigr => j _; rewrite /local_family /raw !mulrA.
Qed.

(* A multiple on the complementarity variables is one everywhere. *)
Lemma scaled_all u (x x' : nat -> R) f :
  (forall k, k \in fi -> free_of Q x k = free_values u (slip_of Q x) k) ->
  (forall k, k \in fi -> free_of Q x' k = free_values u (slip_of Q x') k) ->
  (forall j, (j < ns)%N -> slip_of Q x' j = f * slip_of Q x j) ->
  forall i, i \in iota 0 (order Q) -> x' i = f * x i.
Proof.
move=> part part' scaled i Hi; case/orP: (free_or_slip Hi) => /(nthP 0%N)[k lt_k <-].
  have Hk : k \in fi by rewrite mem_iota.
  rewrite -[LHS]/(free_of Q x' k) -[X in _ = f * X]/(free_of Q x k) part' // part //.
  rewrite /free_values /Elimination.free_part mulrN mulr_sumr.
  by congr (- _); apply: sum_eq => j; rewrite mem_iota => Hj; rewrite scaled // mulrCA.
exact: scaled.
Qed.

(* Polynomials of the blocks in u. *)
Definition shifted_poly i j : {poly R} :=
  (toR q * A i j + toR p * B i j)%:P +
  ((toR off / toR uy)%:P + (toR ext / toR uy)%:P * 'X) * (toR q * B i j)%:P.

Lemma shifted_polyE (u : R) i j : (shifted_poly i j).[u] = shifted_entry A B a (d_of u) i j.
Proof.
rewrite /shifted_poly /shifted_entry /d_of !(hornerD, hornerM, hornerC, hornerX).
have -> : (toR off + u * toR ext) / toR uy = toR off / toR uy + toR ext / toR uy * u by ring.
by [].
Qed.

Definition F_poly i k := shifted_poly (nth 0%N (free Q) i) (nth 0%N (free Q) k).
Definition G_poly i j := shifted_poly (nth 0%N (free Q) i) (nth 0%N (slip Q) j).
Definition H_poly i k := shifted_poly (nth 0%N (slip Q) i) (nth 0%N (free Q) k).
Definition D_poly i j := shifted_poly (nth 0%N (slip Q) i) (nth 0%N (slip Q) j).

Definition family_poly i j : {poly R} :=
  (scale_at i * (4%:R * toR power_z * u2))%:P * condensed_poly nf F_poly G_poly H_poly D_poly i j.

Lemma block_at u : block fi (fun i j => (F_poly i j).[u]) = block fi (F_at Q A B a (d_of u)).
Proof. by apply/matrixP=> i j; rewrite !mxE shifted_polyE. Qed.

Lemma unit_at_u u : 0 <= u -> block fi (F_at Q A B a (d_of u)) \in unitmx.
Proof. by move=> u0; apply: block_unit s_low_gt0 (below_at_u u0). Qed.

Lemma family_polyE u i j : 0 <= u -> (family_poly i j).[u] =
  (free_det nf F_poly).[u] * local_family u i j.
Proof.
move=> u0; rewrite /family_poly hornerM hornerC condensed_polynomial ?block_at ?unit_at_u //.
have -> : condensed_at nf (fun i j => (F_poly i j).[u]) (fun i j => (G_poly i j).[u])
    (fun i j => (H_poly i j).[u]) (fun i j => (D_poly i j).[u]) i j =
    condensed_family Q A B a (d_of u) i j.
  rewrite /condensed_family /condensed_at /D_poly shifted_polyE; congr (_ - _).
  apply: eq_bigr => k _; rewrite /H_poly shifted_polyE; congr (_ * _).
  rewrite /solve block_at; congr (at_index (_ *m _) _); apply/colP=> m; rewrite !mxE.
  exact: shifted_polyE.
by rewrite /local_family /raw mulrCA !mulrA.
Qed.

Lemma free_det_neq0 u : 0 <= u -> (free_det nf F_poly).[u] != 0.
Proof. by move=> u0; rewrite free_detE block_at -unitfE -unitmxE unit_at_u. Qed.

End Local.

(* The pencil itself: chords. *)
Section Exact.

Variables (R : rcfType) (Q : pencil) (a : anchor) (fam : anchor_family) (low_a low_b : form_bound).
Variables (lo hi : point) (grain : Z).
Hypotheses (ready : prepared Q a fam low_a low_b lo hi) (grain0 : (0 <? grain)%Z).
Notation ns := (size (slip Q)).
Notation nf := (size (free Q)).
Notation fi := (iota 0 nf).
Notation si := (iota 0 ns).
Notation A := (a_entry R Q).
Notation B := (b_entry R Q).

Let wf : wellformed Q := let: And5 w _ _ _ _ := ready in w.
Let expanded : expand Q a = Some fam := let: And5 _ e _ _ _ := ready in e.
Let own : prepared_member Q A B a fam low_a low_b lo hi := prepared_ready R ready.

Notation p := (anchor_center a).1.
Notation q := (anchor_center a).2.
Notation off := (offset a lo hi).
Notation ext := (extent a lo hi).
Notation uy := (unit_y a lo hi).
Notation width := (interval_width lo hi).
Notation bn := (lower_n a low_a low_b lo).
Notation bd := (lower_d low_a low_b lo).
Notation d_of := (d_of a lo hi).
Notation t_of := (t_of lo hi).
Notation u_of := (u_of lo hi).
Notation b_reach := (b_reach R a lo hi).
Notation s_low := (s_low R a low_a low_b lo).
Notation at_reach := (at_reach a lo hi).
Notation power_z := (power_z a fam lo hi).
Notation raw := (raw Q A B a fam lo hi).
Notation remainder_at := (remainder_at Q A B a lo hi).
Notation coefficients := (coefficients a fam lo hi).
Notation exact_entry := (exact_entry a fam low_a low_b lo hi).
Notation scale_at := (scale_at R a grain).
Notation local_family := (local_family Q A B a fam lo hi grain).
Notation pencil_for := (local_pencil ns a low_a low_b fam lo hi).
Notation free_values := (free_values Q A B a lo hi).
Notation row_factor_at := (row_factor_at R a fam lo hi grain).
Notation joined := (joined Q A B a lo hi).
Notation family_poly := (family_poly Q A B a fam lo hi grain).
Notation F_poly := (F_poly Q A B a lo hi).

Let proper_parts := proper_parts own.
Let q_gt0 := q_gt0 own.
Let uy_gt0 := uy_gt0 own.
Let ext_gt0 := ext_gt0 own.
Let bd_gt0 := bd_gt0 own.
Let s_low_gt0 := s_low_gt0 own.
Let power_gt0 := power_gt0 own.
Let at_reachE := at_reachE own.
Let d_ofE := d_ofE own.
Let t_of_ge0 := t_of_ge0 own.
Let d_bounded := d_bounded own.
Let below_at_u := below_at_u own.
Let t_of_u := t_of_u own.
Let u_of_between := u_of_between own.
Let between_local := between_local own.
Let between_t := between_t own.
Let free_values_rows := free_values_rows own.
Let slip_of_joined := @slip_of_joined R Q A B a lo hi.
Let joined_values := joined_values own.
Let local_image slopes (u : R) x i : 0 <= u -> (i < ns)%N ->
  (forall k, k \in fi -> free_of Q x k = free_values u (slip_of Q x) k) ->
  family_image (pencil_for slopes grain) local_family u (slip_of Q x) i =
  row_factor_at i * reaction Q (t_of u) x (nth 0%N (slip Q) i).
Proof. exact: (local_image grain own). Qed.
Let local_encloses := local_encloses own grain0.
Let row_factor_gt0_ := row_factor_gt0_ own grain0.
Let family_polyE := family_polyE grain own.
Let free_det_neq0 := free_det_neq0 own.
Let scaled_all := @scaled_all R Q A B a lo hi.
Let local_line := local_line own grain0.
Let rawE := rawE own.
Let raw_line := raw_line own.

Notation l_series := (residual_left Q a (-1)).
Notation r_series := (residual_right Q a (-1)).

Lemma small_l : all (fun M => size M <= nf)%N l_series.
Proof. by have [_ _ _ []] := expand_parts R expanded. Qed.

Lemma small_r : all (fun M => size M <= nf)%N r_series.
Proof. by have [_ _ _ []] := expand_parts R expanded. Qed.

Lemma family_parts i : (i < ns)%N -> nth [::] (left_norms fam) i = norms l_series i /\
  nth [::] (right_norms fam) i = norms r_series i.
Proof.
by move=> Hi; have [_ _ _ [_ _ _ ->]] := expand_parts R expanded; rewrite /= !nth_norms.
Qed.

Notation nl := (fun i => eval (norms l_series i) b_reach).
Notation nr := (fun j => eval (norms r_series j) b_reach).
Definition dl i : R := eval (derivative (norms l_series i)) b_reach.
Definition dr j : R := eval (derivative (norms r_series j)) b_reach.

Lemma remainderE u i j : (i < ns)%N -> (j < ns)%N ->
  remainder_at u i j = \sum_(k <- fi) value l_series (d_of u) k i *
    solve nf (F_at Q A B a (d_of u)) (fun k => value r_series (d_of u) k j) k.
Proof.
move=> Hi Hj; apply: sum_eq => k Hk; rewrite own_left //; congr (_ * _).
by apply: solve_ext => m Hm; rewrite own_right.
Qed.

Lemma remainder_quotient u u' i j : 0 <= u -> u <= 1 -> 0 <= u' -> u' <= 1 ->
  (i < ns)%N -> (j < ns)%N ->
  exists2 x, remainder_at u i j - remainder_at u' i j = (u - u') * x &
    `|x| <= toR ext / toR uy *
      ((dl i * nr j + nl i * dr j) / s_low + nl i * nr j * toR (drift fam) / s_low ^+ 2).
Proof.
move=> u0 u1 v0 v1 Hi Hj; rewrite !remainderE //.
have diff m k : m \in fi -> k \in fi -> F_at Q A B a (d_of u) m k - F_at Q A B a (d_of u') m k =
    (d_of u - d_of u') * toR (lookup (row_1 Q a (nth 0%N (free Q) m)) (nth 0%N (free Q) k)).
  move=> _ _; rewrite /F_at /shifted_entry /row_1 lookup_times toRM -/(B _ _).
  by move: (toR _ * A _ _) (toR _ * B _ _) => *; ring.
have [x xE x_le] := remainder_difference s_low_gt0 (below_at_u u0) (below_at_u v0)
  diff (fun m Hm => (drift_bound R wf expanded Hm).1) (drift_ge0 R expanded)
  (fun m Hm => (drift_bound R wf expanded Hm).2)
  (fun k => slopeE (poly_of l_series k i) (d_of u) (d_of u'))
  (fun k => slopeE (poly_of r_series k j) (d_of u) (d_of u'))
  (series_norm i small_l (d_bounded v0 v1)) (series_norm j small_r (d_bounded u0 u1))
  (series_difference i small_l (d_bounded u0 u1) (d_bounded v0 v1))
  (series_difference j small_r (d_bounded u0 u1) (d_bounded v0 v1)).
exists (toR ext / toR uy * x).
  rewrite xE mulrA; congr (_ * _); rewrite /AnchorLeaf.d_of.
  by rewrite -mulrBl opprD addrACA subrr add0r -mulrBl mulrA.
by rewrite normrM ger0_norm ?divr_ge0 ?(ltW ext_gt0) ?(ltW uy_gt0) // ler_wpmul2l //
  divr_ge0 ?(ltW ext_gt0) ?(ltW uy_gt0).
Qed.

Lemma remainder_slope_bound power i j : 0 < toR power :> R ->
  toR power * (toR ext / toR uy *
      ((dl i * nr j + nl i * dr j) / s_low + nl i * nr j * toR (drift fam) / s_low ^+ 2)) <=
  toR (remainder_slope a low_a low_b fam lo hi power
         (at_reach (norms l_series i)) (at_reach (norms r_series j))
         (at_reach (derivative (norms l_series i))) (at_reach (derivative (norms r_series j)))).
Proof.
move=> p0; have [_ _ _ _ b0] := proper_parts; have d0 := bd_gt0; have y0 := uy_gt0.
have [lE l0] := at_reachE (norms l_series i); have [rE r0] := at_reachE (norms r_series j).
have [dlE dl0] := at_reachE (derivative (norms l_series i)).
have [drE dr0] := at_reachE (derivative (norms r_series j)).
rewrite /remainder_slope !toRD; apply: (@le_trans _ _
  (toR power * (toR ext / toR uy) * (dl i * nr j / s_low) +
   toR power * (toR ext / toR uy) * (nl i * dr j / s_low) +
   toR power * (toR ext / toR uy) * (nl i * nr j * toR (drift fam) / s_low ^+ 2))).
  by rewrite -!mulrDr -mulrDl mulrA.
by apply: ler_add; first apply: ler_add; [apply: slope_le | apply: slope_le | apply: square_le].
Qed.

Lemma raw_chord u u' i j : 0 <= u -> u <= 1 -> 0 <= u' -> u' <= 1 -> (i < ns)%N -> (j < ns)%N ->
  let e := exact_entry true i j in
  exists2 x, raw u i j - raw u' i j = (u - u') * (toR (local_b e) + x) &
    `|x| <= toR (local_rb e).
Proof.
move=> u0 u1 v0 v1 Hi Hj; cbv zeta; rewrite part_b part_rb !rawE // !(own_center wf expanded) //.
rewrite toRD !four !(mulrBr (toR power_z)) !(mulrBr 4%:R) -!(coefficientsE own).
rewrite /entry_slope; have [-> _] := family_parts Hi; have [_ ->] := family_parts Hj.
rewrite [toR (8 * _)%Z]toRM -[toR 8]/(8%:R : R); set c := coefficients i j.
have [x xE x_le] := chord_difference c u0 u1 v0 v1.
have [y yE y_le] := remainder_quotient u0 u1 v0 v1 Hi Hj.
exists (4%:R * x - 4%:R * (toR power_z * y)).
  move: xE yE; set a1 := eval c u; set a2 := eval c u'.
  set b1 := remainder_at u i j; set b2 := remainder_at u' i j => xE yE.
  have -> : 4%:R * a1 - 4%:R * (toR power_z * b1) - (4%:R * a2 - 4%:R * (toR power_z * b2)) =
            4%:R * (a1 - a2) - 4%:R * toR power_z * (b1 - b2) by ring.
  by rewrite xE yE; ring.
rewrite (le_trans (ler_norm_sub _ _)) // ler_add //.
  rewrite normrM ger0_norm ?ler0n // (_ : 8%:R = 4%:R * 2%:R :> R); last by ring.
  by rewrite -mulrA ler_pmul2l ?ltr0n //; apply: le_trans x_le _; rewrite toRM.
rewrite normrM ger0_norm ?ler0n // ler_pmul2l ?ltr0n // normrM (gtr0_norm power_gt0).
apply: le_trans (remainder_slope_bound _ _ power_gt0).
by rewrite ler_pmul2l ?power_gt0.
Qed.

Theorem local_chord u u' : 0 <= u -> u <= 1 -> 0 <= u' -> u' <= 1 ->
  near_chord (pencil_for true grain) local_family u u'.
Proof.
move=> u0 u1 v0 v1; pose e i j := exact_entry true i j.
pose slope i j := (raw u i j - raw u' i j) / (u - u').
pose B i j : R := if u == u' then toR (local_b (e i j)) else slope i j.
pose A i j := raw u i j - u * B i j.
have B_near i j : (i < ns)%N -> (j < ns)%N ->
    `|B i j - toR (local_b (e i j))| <= toR (local_rb (e i j)).
  move=> Hi Hj; have [x xE x_le] := raw_chord u0 u1 v0 v1 Hi Hj.
  rewrite /B; case: eqP => [_|/eqP uu]; first by rewrite subrr normr0; apply: le_trans x_le.
  by rewrite /slope xE mulrAC mulfV ?subr_eq0 // mul1r [_ + x]addrC addrK.
exists (fun i j => scale_at i * A i j), (fun i j => scale_at i * B i j); split.
- apply: local_encloses => i j Hi Hj; split; last exact: B_near.
  have near := raw_line true u0 u1 Hi Hj; cbv zeta in near; rewrite -/(e i j) in near *.
  have -> : A i j - toR (local_a (e i j)) =
      (raw u i j - (toR (local_a (e i j)) + u * toR (local_b (e i j)))) -
      u * (B i j - toR (local_b (e i j))).
    by rewrite /A; move: (raw u i j) (B i j) (toR _) (toR _) => *; ring.
  rewrite (le_trans (ler_norm_sub _ _)) // -[toR (local_ra _)](subrK (toR (local_rb (e i j)))).
  rewrite ler_add // normrM ger0_norm //; apply: le_trans (B_near _ _ Hi Hj).
  by rewrite ler_pimull.
- move=> i j _ _; rewrite /Enclosed.T /local_family /A.
  by move: (scale_at i) (raw u i j) (B i j) => *; ring.
move=> i j _ _; rewrite /Enclosed.T /local_family /A /B /slope; case: eqP => [<-|/eqP uu].
  by move: (scale_at i) (raw u i j) (toR _) => *; ring.
have d0 : u - u' != 0 by rewrite subr_eq0.
have : raw u' i j = raw u i j - (u - u') * ((raw u i j - raw u' i j) / (u - u')).
  by rewrite mulrC divfK // opprB addrC subrK.
set x := (_ / _); move: (raw u i j) x => y x ->.
by move: (scale_at i) => *; ring.
Qed.

Lemma to_family slopes u x : 0 <= u -> solution Q (t_of u) x ->
  family_solves (pencil_for slopes grain) local_family u (slip_of Q x) /\
  forall k, k \in fi -> free_of Q x k = free_values u (slip_of Q x) k.
Proof.
move=> u0 [_ [i0 Hi0 xi0] rows_f rows_s].
have part k : k \in fi -> free_of Q x k = free_values u (slip_of Q x) k.
  by move: k; apply/(free_values_rows x u0).
split=> //; split=> //; first by apply: (slip_part_nonzero part); exists i0.
move=> i /in_local Hi; rewrite (local_image _ u0 Hi part).
exact/(complementary_scaled _ _ (row_factor_gt0_ Hi))/rows_s/mem_nth.
Qed.

Lemma from_family slopes u xs : 0 <= u ->
  family_solves (pencil_for slopes grain) local_family u xs ->
  solution Q (t_of u) (joined u xs).
Proof.
move=> u0 [_ [i0 Hi0 xi0] rows]; set x := joined u xs.
have slipE j : (j < ns)%N -> slip_of Q x j = xs j by apply: slip_of_joined.
have part k := @joined_values u xs k.
split.
- exact: t_of_ge0.
- have lt0 := in_local Hi0; exists (nth 0%N (slip Q) i0); first exact/slip_indices/mem_nth.
  by rewrite -[x _]/(slip_of Q x i0) slipE.
- exact/(free_values_rows x u0).
move=> i /(nthP 0%N)[k Hk <-].
have Hk' : k \in indices (pencil_for slopes grain) by rewrite mem_iota.
have imageE : family_image (pencil_for slopes grain) local_family u xs k =
    row_factor_at k * reaction Q (t_of u) x (nth 0%N (slip Q) k).
  rewrite -(local_image slopes u0 Hk part); apply: sum_eq => j /in_local Hj.
  by rewrite slipE.
rewrite -[x (nth _ _ _)]/(slip_of Q x k) slipE //.
by apply/(complementary_scaled _ _ (row_factor_gt0_ Hk)); rewrite -imageE; apply: rows.
Qed.

(* Leaves *)
Section Leaf.

Variables (states_ : seq state) (l : local_leaf).
Notation r := (Region lo hi states_).
Hypothesis checked : check_anchored ns a low_a low_b fam lo hi r grain l.

Notation local_r := (local_region r).

Lemma local_ordered : ordered (lower local_r) (upper local_r).
Proof. by []. Qed.

Lemma between_unit (u : R) : between u (lower local_r) (upper local_r) -> 0 <= u /\ u <= 1.
Proof. by rewrite /between /= toR0 toR1 !mulr1. Qed.

Lemma in_local_region u (xs : nat -> R) : 0 <= u -> u <= 1 -> agrees ns r xs ->
  in_region ns u xs local_r.
Proof. by move=> u0 u1 ag; split=> //; rewrite /between /= toR0 toR1 !mulr1. Qed.

Theorem anchored_excludes (t : R) x : ~~ wants_slopes l -> solution Q t x ->
  between t lo hi -> agrees ns r (slip_of Q x) -> False.
Proof.
move=> /negbTE tight sol bt ag; have [u0 u1] := u_of_between bt.
rewrite -(t_of_u t) in sol; move: u0 u1 sol; set u := u_of t => u0 u1 sol.
case/and3P: checked => _ _; rewrite tight => ok.
have [fam_sol _] := to_family false u0 sol.
have [A [B [E lin_sol]]] := line_solution (local_line u0 u1) fam_sol.
have reg := in_local_region u0 u1 ag.
move: tight ok; case: (l) => [w|d low high|c|c o] /= tight ok.
- exact: (farkas_sound E local_ordered ok reg lin_sol).
- exact: (definite_sound E local_ordered ok reg lin_sol).
- have D : decided (pencil_for false grain) local_r by case/and5P: ok.
  exact: (absent_sound E local_ordered D ok reg lin_sol).
case/andP: ok => iso signs.
case: o tight signs => [//|i _ /andP[iK neg]|i _ /and3P[Hi nm neg]].
  exact: (negative_x_sound E local_ordered iso iK neg reg lin_sol).
exact: (negative_y_sound E local_ordered iso Hi nm neg reg lin_sol).
Qed.

End Leaf.

Theorem anchored_yields (st : seq state) c :
  check_anchored ns a low_a low_b fam lo hi (Region lo hi st) grain (LocalRoot c Solution) ->
  exists (t : R) x, [/\ between t (from_point c) (to_point c), solution Q t x,
    between t lo hi /\ agrees ns (Region lo hi st) (slip_of Q x) &
    forall t' x', solution Q t' x' -> between t' lo hi ->
      agrees ns (Region lo hi st) (slip_of Q x') ->
      t' = t /\ exists2 f, 0 < f & forall i, i \in iota 0 (order Q) -> x' i = f * x i].
Proof.
move=> checked; case/and3P: (checked) => _ _ root_ok.
have /andP[iso signs] := root_ok.
have unit_u (u : R) : between u (lower (local_region (Region lo hi st)))
    (upper (local_region (Region lo hi st))) -> 0 <= u /\ u <= 1 by apply: between_unit.
have [u [xs [bu sol reg uniq]]] : exists u xs,
    [/\ between u (local_point lo hi (from_point c)) (local_point lo hi (to_point c)),
        family_solves (pencil_for true grain) local_family u xs,
        in_region ns u xs (local_region (Region lo hi st)) &
        forall u' x', family_solves (pencil_for true grain) local_family u' x' ->
          in_region ns u' x' (local_region (Region lo hi st)) ->
          u' = u /\ exists2 g, 0 < g &
            forall i, i \in indices (pencil_for true grain) -> x' i = g * xs i].
  apply: (@curved_solution _ _ _ _ _ (local_ordered st) iso _ (free_det nf F_poly) family_poly _ _
            signs).
  - by move=> u u' /unit_u[u0 u1] /unit_u[v0 v1]; apply: local_chord.
  - by move=> u /unit_u[u0 _]; apply: free_det_neq0.
  by move=> u i j /unit_u[u0 _] _ _; apply: family_polyE.
have [u0 u1] := unit_u _ (proj1 reg).
pose x := joined u xs.
have slipE j : (j < ns)%N -> slip_of Q x j = xs j by apply: slip_of_joined.
have agree_ext (y z : nat -> R) : (forall j, (j < ns)%N -> y j = z j) ->
    agrees ns (Region lo hi st) y -> agrees ns (Region lo hi st) z.
  by move=> same ag j lt_j; have := ag j lt_j; rewrite same.
exists (t_of u), x; split.
- exact/between_local.
- exact: from_family sol.
- split; last by apply: agree_ext (proj2 reg) => j Hj; rewrite slipE.
  exact: between_t.
move=> t' x' sol' bt' ag'; have [v0 v1] := u_of_between bt'.
rewrite -(t_of_u t') in sol' *; move: v0 v1 sol'; set v := u_of t' => v0 v1 sol'.
have [fam_sol part'] := to_family true v0 sol'.
have [vu [f f0 scaled]] := uniq v _ fam_sol (in_local_region v0 v1 ag').
rewrite vu in part' *; split=> //; exists f => //.
apply: (scaled_all (u := u)) => //; first exact: joined_values.
by move=> j Hj; rewrite slipE //; apply: scaled; rewrite mem_iota.
Qed.

(* Regions with at most one null vector *)
Section Pinned.

Variable st : seq state.
Notation r := (Region lo hi st).
Notation local_r := (local_region r).
Notation P := (pencil_for true grain).

Lemma local_between (t : R) (e e' : point) :
  between t e e' -> between (u_of t) (local_point lo hi e) (local_point lo hi e').
Proof. by move=> bt; apply/between_local; rewrite t_of_u. Qed.

Let O_local : ordered (lower local_r) (upper local_r).
Proof. by []. Qed.

Lemma local_supports q :
  supports_region P local_r (local_known lo hi q) = supports_region (enclosed_order ns) r q.
Proof. by []. Qed.

Section Claimed.

Variables (c : pinning) (q : known) (t : R) (x : nat -> R).
Hypothesis checked : check_anchored_claim ns a low_a low_b fam lo hi r grain c q.
Hypothesis known_x : known_solution Q q t x.

Let claimed : check_claimed P local_r c (local_known lo hi q).
Proof. by case/and3P: checked. Qed.

Lemma known_inside_local : 0 <= u_of t /\ u_of t <= 1.
Proof.
case/and5P: claimed => _ _ /and4P[o t2 le_lo le_hi] _ _; case: known_x => bt _ _.
by apply: (between_unit (states_ := st)); apply: between_wider (local_between bt).
Qed.

(* With the chord through t and t' it is a known solution of a pencil. *)
Lemma chord_known t' : between t' lo hi -> exists A B, [/\ encloses P A B,
  is_known P A B (local_known lo hi q) (u_of t) (slip_of Q x) &
  forall x', solution Q t' x' -> solves P A B (u_of t') (slip_of Q x')].
Proof.
move=> bt'; have [u0 u1] := known_inside_local; have [v0 v1] := u_of_between bt'.
have [A [B [E on on']]] := local_chord u0 u1 v0 v1; case: known_x => bt sol signs.
exists A, B; split=> // [|x' sol']; last first.
  rewrite -(t_of_u t') in sol'.
  by apply/(pencil_solution _ on'); case: (to_family true v0 sol').
rewrite -(t_of_u t) in sol signs.
have [fam_sol part] := to_family true u0 sol.
split; [exact: local_between | exact/(pencil_solution _ on) |].
move=> j Hj; have lt_j := in_local Hj; have [pos zero biactive] := signs j lt_j.
split=> // ns_j b_j.
have -> : image P A B (u_of t) (slip_of Q x) j =
    family_image P local_family (u_of t) (slip_of Q x) j.
  by apply: sum_eq => i Hi; rewrite on.
by rewrite (local_image true u0 lt_j part) biactive // mulr0.
Qed.

Lemma claimed_parts_of (t' : R) x' : solution Q t' x' -> between t' lo hi ->
  agrees ns r (slip_of Q x') ->
  exists A B, [/\ encloses P A B,
    is_known P A B (local_known lo hi q) (u_of t) (slip_of Q x),
    solves P A B (u_of t') (slip_of Q x') &
    in_region_of P (u_of t') (slip_of Q x') local_r].
Proof.
move=> sol' bt' ag'; have [A [B [E known_u into]]] := chord_known bt'.
have [v0 v1] := u_of_between bt'.
by exists A, B; split=> //; [exact: into | exact: in_local_region].
Qed.

Theorem anchored_beside (t' : R) x' : ~~ supports_region (enclosed_order ns) r q ->
  solution Q t' x' -> between t' lo hi -> agrees ns r (slip_of Q x') -> False.
Proof.
rewrite -local_supports => beside sol' bt' ag'.
have [A [B [E known_u sol_u reg_u]]] := claimed_parts_of sol' bt' ag'.
exact: (claimed_beside (r := local_r) E O_local claimed known_u beside sol_u reg_u).
Qed.

Theorem anchored_claimed : supports_region (enclosed_order ns) r q ->
  [/\ between t lo hi, agrees ns r (slip_of Q x) &
    forall (t' : R) x', solution Q t' x' -> between t' lo hi -> agrees ns r (slip_of Q x') ->
      t' = t /\ exists2 f, 0 < f & forall i, i \in iota 0 (order Q) -> x' i = f * x i].
Proof.
rewrite -local_supports => supports; have [u0 u1] := known_inside_local; case: (known_x) => _ sol _.
have bt : between t lo hi by rewrite -(t_of_u t); apply: between_t.
have [A [B [E known_u _]]] := chord_known bt.
have [[_ ag] _] := claimed_sound (r := local_r) E O_local claimed known_u supports.
split=> // t' x' sol' bt' ag'.
have [A' [B' [E' known_u' sol_u reg_u]]] := claimed_parts_of sol' bt' ag'.
have [_ uniq] := claimed_sound (r := local_r) E' O_local claimed known_u' supports.
have [eq_u [f f0 scaled]] := uniq _ _ sol_u reg_u.
have eq_t : t' = t by rewrite -(t_of_u t') eq_u t_of_u.
rewrite {}eq_t in sol' *; split=> //; exists f => //.
rewrite -(t_of_u t) in sol sol'.
have [_ part] := to_family true u0 sol; have [_ part'] := to_family true u0 sol'.
by apply: (scaled_all part part') => j Hj; apply: scaled; rewrite mem_iota.
Qed.

End Claimed.

(* A null vector at the lower end *)
Section Limit.

Variables (c : pinning) (x : nat -> R).
Hypothesis checked : check_anchored_limit ns a low_a low_b fam lo hi r grain c.
Hypothesis free_rows : forall i, i \in free Q -> reaction Q (toR lo.1 / toR lo.2) x i = 0.
Hypothesis slip_rows : forall j, (j < ns)%N ->
  if is_moving (state_of r j) then reaction Q (toR lo.1 / toR lo.2) x (nth 0%N (slip Q) j) = 0
  else slip_of Q x j = 0.
Hypothesis pivot_moves : slip_of Q x (pin_pivot c) != 0.

Let pin : pinned P local_r c.
Proof. by case/and3P: checked. Qed.

Lemma t_of_0 : t_of (0 : R) = toR lo.1 / toR lo.2.
Proof.
have [_ l2 h2 _ _] := proper_parts; rewrite /t_of mul0r addr0 !toRM.
by field; rewrite !gt_eqF.
Qed.

Theorem anchored_limit (t' : R) x' : solution Q t' x' -> between t' lo hi ->
  agrees ns r (slip_of Q x') -> t' = toR lo.1 / toR lo.2.
Proof.
move=> sol' bt' ag'; have [v0 v1] := u_of_between bt'.
have [A [B [E on on']]] := local_chord (lexx 0) ler01 v0 v1.
have part k : k \in fi -> free_of Q x k = free_values 0 (slip_of Q x) k.
  by move: k; apply/(free_values_rows x (lexx 0)); rewrite t_of_0.
have xk := pivot_moves.
have [D kJ V0 _] := pinned_parts pin; set k := pin_pivot c in xk kJ V0.
set V := nth _ _ _ in V0.
have null : null_vector A B (moving P local_r) 0 (slip_of Q x).
  move=> l lJ; have Hl := moving_indices lJ; have lt_l := in_local Hl.
  have moves : is_moving (state_of r l) by move: lJ; rewrite mem_filter => /andP[].
  have := slip_rows lt_l; rewrite moves => row0.
  have image0 : image P A B 0 (slip_of Q x) l = 0.
    have -> : image P A B 0 (slip_of Q x) l = family_image P local_family 0 (slip_of Q x) l.
      by apply: sum_eq => i Hi; rewrite on.
    by rewrite (local_image true (lexx 0) lt_l part) t_of_0 row0 mulr0.
  rewrite -[RHS]image0 /image [RHS](sum_support (p := fun j => is_moving (state_of r j))) //.
  move=> j Hj /negbTE rest; have := slip_rows (in_local Hj); rewrite rest => ->.
  by rewrite mulr0.

have sol_v : solves P A B (u_of t') (slip_of Q x').
  rewrite -(t_of_u t') in sol'.
  by apply/(pencil_solution _ on'); case: (to_family true v0 sol').
have reg_v : in_region_of P (u_of t') (slip_of Q x') local_r by apply: in_local_region.
have [g g0 [xk' null']] := scaled_solution D kJ V0 sol_v reg_v.
pose f := toR V / slip_of Q x k.
have null_f : null_vector A B (moving P local_r) 0 (fun j => f * slip_of Q x j).
  by move=> l lJ; under eq_bigr do rewrite mulrCA; rewrite -mulr_sumr null // mulr0.
have fxk : f * slip_of Q x k = toR V by rewrite /f divfK.
have b0 : between (0 : R) (lower local_r) (upper local_r).
  by rewrite /between /= toR0 toR1 !mul0r lexx ler01.
have [u0 _] := pinned_sound (r := local_r) E O_local pin b0 (proj1 reg_v) fxk xk' null_f null'.
by rewrite -(t_of_u t') -u0 t_of_0.
Qed.

End Limit.

End Pinned.

End Exact.
