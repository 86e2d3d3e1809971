(* Stability on an interval of friction: the check of its certificate.

   The coordinates are those of the pencil in which mu is unknown (System.v), its free rows times
   unit_length, so that K and M of the admissible motions are symmetric: K is C L^2 times the
   stiffness, in units of displacement that are L times the true ones.  C is entry_scale, L is
   unit_length.

   At both ends, mu = p/q, the certificate has integers Q and b, in one unit:

       Q_ij + theta_i <= T(mu)_ij,    (b_i - rho_i)^2 >= mu^2 a_i^2,    b_i >= rho_i,
       4 Q - b b' strictly covered by a factor (Covered.v), Q symmetric.

   T is the condensed pencil, known up to radii (Condensation.v); a_i^2 bounds (C e)_i^2 / e'K e by
   [form_of_row]; theta and rho are those of Energy.v ([drag]).  Between the ends the means of Q and
   b serve.

   [stable_motions] says what follows in these coordinates, for each mu between them.

   Page: spec/certificates.md, 5.21.  Rust: crates/check/src/stability.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Norms Elimination Condensation
  Pencil System ZeroReaction ZeroPencil Energy Integral.

Local Notation row_of := Condensation.row_of.

(* Q and b in units of 1/[end_unit], and form_times (4 Q - b b'), in units of 1/[end_unit]^2, is
   covered by end_gram L L'. *)
Record stable_end := StableEnd {
  end_form : matrix;
  end_slope : seq Z;
  end_unit : Z;
  end_times : Z;
  end_gram : Z;
  end_rows : seq late_row }.

(* G has a list over the free degrees of freedom for each slip particle, in units of 1/gain_unit;
   mass_form shows a lower bound of M.  Fractions: [turn] >= 2 kappa / m, [wide] >= w, and [root]^2
   times sigma is at least 1. *)
Record stability := Stability {
  gain : matrix;
  gain_unit : Z;
  mass_form : form_bound;
  turn : point;
  wide : point;
  root : point }.

Section Checker.

Local Open Scope Z_scope.

Variables (c : Z) (s : system) (w : elimination) (d : stability).

Definition mu_pencil := pencil_of s Mu.
Definition mass_pencil := pencil_of s (Lambda2 0 1).
Definition friction_pencil := pencil_of s (Lambda2 1 0).

Definition length_of i := if (i < free_number s)%N then unit_length s else 1.

Definition symmetric_form (rows : seq sparse_row) :=
  map_from (fun i row => times_row (length_of i) row) 0 rows.

Definition k_rows := symmetric_form (rows_a mu_pencil).
Definition m_rows := symmetric_form (rows_b mass_pencil).

Definition k_friction j := nth [::] (rows_b mu_pencil) (free_number s + j).
Definition m_friction j := nth [::] (rows_b friction_pencil) (free_number s + j).

(* gain_unit (row - G free rows) *)
Definition corrected_row (free : seq sparse_row) (row : sparse_row) (g : seq Z) : sparse_row :=
  times_row (gain_unit d) row ++ flatten [seq times_row (- e.1) e.2 | e <- zip g free].

(* Tables are made once, by [check_stable]. *)
Definition corrected_at (free friction : seq sparse_row) j :=
  corrected_row (take (free_number s) free) (nth [::] friction (free_number s + j))
    (row_of (gain d) j).

Definition k_corrected := corrected_at k_rows (rows_b mu_pencil).

Definition sum_abs row := norm1 (spread row).

Definition sumZ_of T (f : T -> Z) (l : seq T) := foldr (fun x sum => f x + sum) 0 l.

Notation sides := (iota 0 (size (particles s))).
Notation cl2 := (c * (unit_length s * unit_length s)).

(* gain_unit e_j *)
Definition turned_in free friction := [seq sum_abs (corrected_at free friction j) | j <- sides].
Definition turned_rows := turned_in m_rows (rows_b friction_pencil).

(* kappa, times gain_unit and the denominator of the upper end *)
Definition kappa_in free friction (hi : point) :=
  gain_unit d * hi.2 * sumZ_of sum_abs free +
  hi.1 * sumZ_of (fun j => sum_abs (corrected_at free friction j)) sides.

(* v and l of [form_of_row] for C_j, in units of 1/(gain_unit unit_of). *)
Definition form_vector j :=
  let g := row_of (gain d) j in
  map_from (fun k x => gain_unit d * x - unit_of w * unit_length s * nth 0 g k) 0
    [seq nth 0 (row_of (left_vb w) j) k | k <- iota 0 (free_number s)].

Definition form_rest D j :=
  [seq gain_unit d * x | x <- residual_column D w (sf_b D) (left_vb w) j].

Definition form_size D j :=
  let v := form_vector j in
  let l := form_rest D j in
  let fv := [seq sparse_dot row v | row <- ff D] in
  bound_d w * (dot v fv + 2 * dot v l) + bound_c w * dot l l.

(* The exact F^-1 G is at most this, times unit_of bound_d. *)
Definition width_bound D :=
  sumZ_of (fun j => bound_d w * norm1 (row_of (right_w w) j) +
                    bound_c w * norm1 (residual_column D w (fs D) (right_w w) j)) sides.

Definition check_turn free friction e (hi : point) :=
  [&& 0 <? (turn d).2, 0 <=? (turn d).1,
      2 * (turn d).2 * bound_times (mass_form d) * kappa_in free friction hi <=?
        (turn d).1 * bound_at (mass_form d) * gain_unit d * hi.2 &
      2 * hi.1 * bound_times (mass_form d) * sumZ_of id e <=?
        bound_at (mass_form d) * hi.2 * gain_unit d].

Definition check_wide D :=
  [&& 0 <? (wide d).2, 0 <=? (wide d).1 &
      (wide d).2 * width_bound D <=? (wide d).1 * (unit_of w * bound_d w)].

Definition check_root :=
  [&& 0 <? (root d).2, 0 <=? (root d).1 &
      nilp (free_dofs s) ||
      ((root d).2 * (root d).2 * (bound_c w * (c * unit_length s)) <=?
       (root d).1 * (root d).1 * bound_d w)].

Definition check_shapes free friction mass mass_friction :=
  let n := (free_number s + size (particles s))%N in
  let small rows := all (all (fun e => e.1 < n)%N) rows in
  [&& 0 <? gain_unit d, all (fun j => size (row_of (gain d) j) <= free_number s)%N sides,
      small free && small mass,
      small [seq nth [::] friction (free_number s + j) | j <- sides],
      small [seq nth [::] mass_friction (free_number s + j) | j <- sides] &
      symmetric_rows_sparse free && symmetric_rows_sparse mass].

(* An end at mu = e.1 / e.2; its tables are made once. *)
Section End.

Variables (P : enclosed) (turned sizes : seq Z) (e : point) (f : stable_end).

Definition drag_times i := e.1 * nth 0 turned i * (turn d).1.

Definition below i j :=
  let units := gain_unit d * (turn d).2 * (wide d).2 in
  nth 0 (row_scale w) i * (unit_of w * unit_of w) *
    (cl2 * e.2 * units * entry (end_form f) i j +
     end_unit f * drag_times i * ((wide d).2 + (wide d).1)) <=?
  (center P e i j - radius P e i j) * (end_unit f * units).

Definition steep i :=
  let units := e.2 * gain_unit d * (turn d).2 * (root d).2 * cl2 in
  let rest := nth 0 (end_slope f) i * units - end_unit f * drag_times i * (root d).1 in
  let u := gain_unit d * unit_of w in
  (0 <=? rest) &&
  (e.1 * e.1 * nth 0 sizes i * ((end_unit f * units) * (end_unit f * units)) <=?
   e.2 * e.2 * (rest * rest) * (cl2 * unit_length s * bound_d w * (u * u))).

Definition form_entry (i j : nat) :=
  end_times f * (4 * end_unit f * entry (end_form f) i j -
                 nth 0 (end_slope f) i * nth 0 (end_slope f) j).

Definition check_end :=
  [&& 0 <? end_unit f, 0 <? end_times f, 0 <=? end_gram f,
      all (fun i => all (fun j => entry (end_form f) i j =? entry (end_form f) j i) sides) sides,
      all (fun i => 0 <=? nth 0 (end_slope f) i) sides &
      [&& all (fun i => all (below i) sides) sides, all steep sides,
          size (end_rows f) == size (particles s) &
          covered form_entry (fun a b => end_gram f * late_dot a b) true
            (zip sides (end_rows f))]].

End End.

Definition check_stable (lo hi : point) (low high : stable_end) :=
  let Q := mu_pencil in
  let D := blocks_of Q in
  let P := condensed D w in
  let k := symmetric_form (rows_a Q) in
  let m := m_rows in
  let mass_friction := rows_b friction_pencil in
  let turned := turned_in m mass_friction in
  let sizes := [seq form_size D j | j <- sides] in
  let n := (free_number s + size (particles s))%N in
  [&& system_wellformed s Mu, wellformed Q, free_rows_constant Q, check_elimination D w &
      [&& ordered lo hi, 0 <? hi.2, check_shapes k (rows_b Q) m mass_friction,
          (0 <? bound_at (mass_form d)) && bounded_rows n m (mass_form d) &
          [&& check_turn k (rows_b Q) turned hi, check_wide D, check_root,
              check_end P turned sizes lo low & check_end P turned sizes hi high]]].

End Checker.

Lemma nth_symmetric s rows i j : lookup (nth [::] (symmetric_form s rows) i) j =
  (length_of s i * lookup (nth [::] rows i) j)%Z.
Proof.
have [lt_i|ge_i] := ltnP i (size rows).
  by rewrite (nth_map_from [::]) // add0n lookup_times.
by rewrite !nth_default ?size_map_from //= Z.mul_0_r.
Qed.

Lemma size_spread n row : all (fun e => e.1 < n)%N row -> (size (spread row) <= n)%N.
Proof.
elim: row => //= e row IH /andP[lt_e /IH le_n].
by rewrite size_set_nth geq_max lt_e.
Qed.

Lemma toR_sum_abs (R : realFieldType) n row : all (fun e => e.1 < n)%N row ->
  toR (sum_abs row) = \sum_(i <- iota 0 n) `|toR (lookup row i)| :> R.
Proof.
move=> /size_spread le_n; rewrite /sum_abs (toR_norm1 R le_n).
by apply: eq_bigr => i _; rewrite nth_spread.
Qed.

Lemma toR_sumZ_of (R : realFieldType) T (x : T) f l :
  toR (sumZ_of f l) = \sum_(k <- iota 0 (size l)) toR (f (nth x l k)) :> R.
Proof.
elim: l => [|y l IH]; first by rewrite big_nil.
by rewrite /= big_cons toRD IH (sum_shift 1).
Qed.

Lemma toR_sides (R : realFieldType) f n :
  toR (sumZ_of f (iota 0 n)) = \sum_(j <- iota 0 n) toR (f j) :> R.
Proof.
rewrite (toR_sumZ_of R 0%N) size_iota; apply: sum_eq => j.
by rewrite mem_iota add0n => /= lt_j; rewrite nth_iota.
Qed.

Lemma lookup_gains (R : realFieldType) n g rows i : (size g <= n)%N ->
  toR (lookup (flatten [seq times_row (- e.1) e.2 | e <- zip g rows]) i) =
  - \sum_(k <- iota 0 n) toR (nth 0%Z g k) * toR (lookup (nth [::] rows k) i) :> R.
Proof.
elim: g rows n => [|x g IH] [|r rows] n le_n /=.
- by rewrite sum_zero ?oppr0 // => k _; rewrite nth_nil toR0 mul0r.
- by rewrite sum_zero ?oppr0 // => k _; rewrite nth_nil toR0 mul0r.
- by rewrite sum_zero ?oppr0 // => k _; rewrite nth_nil /= toR0 mulr0.
case: n le_n => // n le_n.
rewrite lookup_cat toRD lookup_times toRM toRN (IH _ n) // big_cons opprD mulNr.
by rewrite (sum_shift 1).
Qed.

Lemma zip_second (S T : eqType) (g : seq S) (rows : seq T) :
  {subset [seq e.2 | e <- zip g rows] <= rows}.
Proof.
elim: g rows => [|x g IH] [|r rows] //= y; rewrite !inE => /orP[->//|/IH ->].
by rewrite orbT.
Qed.

Section Sound.

Variables (R : rcfType) (c : Z) (s : system) (w : elimination) (d : stability).
Variables (lo hi : point) (low high : stable_end).
Hypothesis ok : check_stable c s w d lo hi low high.

Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation n := (nf + ns)%N.
Notation fi := (iota 0 nf).
Notation si := (iota 0 ns).
Notation ix := (iota 0 n).
Notation L := (toR (unit_length s) : R).
Notation Q := (mu_pencil s).
Notation times := (times n).
Notation pair := (pair n).
Implicit Types (x a u v : nat -> R).

Definition KK i j : R := toR (lookup (nth [::] (k_rows s) i) j).
Definition MM i j : R := toR (lookup (nth [::] (m_rows s) i) j).
Definition RR j i : R := toR (lookup (k_friction s j) i).
Definition NN j i : R := toR (lookup (m_friction s j) i).
Definition GG j k : R := toR (nth 0%Z (row_of (gain d) j) k) / toR (gain_unit d).

Notation CC := (corrected nf GG KK RR).
Notation EE := (corrected nf GG MM NN).

Lemma wf : system_wellformed s Mu.
Proof. by case/and5P: ok. Qed.

Lemma wf01 : system_wellformed s (Lambda2 0 1).
Proof. exact: wellformed_plain wf. Qed.

Lemma flat_part j : (j < ns)%N -> geometric_stiffness (particle s j) = 0%Z.
Proof. exact: flat_particle (wellformed_flat wf). Qed.

Lemma L0 : 0 < L.
Proof. exact: (unit_length_gt0 R wf). Qed.

(* Rows as reactions, and as forces of motions. *)

Lemma times_k x i : times KK x i = toR (length_of s i) * reaction Q 0 x i.
Proof.
rewrite /Energy.times /reaction mulr_sumr; apply: eq_bigr => j _.
by rewrite /KK nth_symmetric toRM mul0r addr0 mulrA.
Qed.

Lemma times_m x i : times MM x i = toR (length_of s i) *
  (reaction (mass_pencil s) 1 x i - reaction (mass_pencil s) 0 x i).
Proof.
rewrite /Energy.times /reaction -sumrB mulr_sumr; apply: eq_bigr => j _.
by rewrite /MM nth_symmetric toRM /b_entry /row_b;
  move: (toR _) (toR _) (a_entry _ _ _ _) => *; ring.
Qed.

Lemma times_r x j :
  times RR x j = reaction Q 1 x (nf + j)%N - reaction Q 0 x (nf + j)%N.
Proof.
rewrite /Energy.times /reaction -sumrB; apply: eq_bigr => i _.
by rewrite /RR /k_friction /b_entry /row_b; move: (toR _) (a_entry _ _ _ _) => *; ring.
Qed.

Lemma times_n x j : times NN x j =
  reaction (friction_pencil s) 1 x (nf + j)%N - reaction (friction_pencil s) 0 x (nf + j)%N.
Proof.
rewrite /Energy.times /reaction -sumrB; apply: eq_bigr => i _.
by rewrite /NN /m_friction /b_entry /row_b; move: (toR _) (a_entry _ _ _ _) => *; ring.
Qed.

(* M v *)
Definition inert v i := force s 1 v i - force s 0 v i.

Notation dof k := (nth 0%N (free_dofs s) k).
Notation part j := (particle s j).

Lemma alongB (e : planar) p (f g : nat -> R) :
  along e p (fun i => f i - g i) = along e p f - along e p g.
Proof. by rewrite /along; move: (toR _) (toR _) => *; ring. Qed.

Lemma free_k x k : (k < nf)%N -> times KK x k = L * force s 0 (motion s x) (dof k).
Proof. by move=> lt_k; rewrite times_k /length_of lt_k (free_reaction wf). Qed.

Lemma free_m x k : (k < nf)%N -> times MM x k = L * inert (motion s x) (dof k).
Proof. by move=> lt_k; rewrite times_m /length_of lt_k !(free_reaction wf01). Qed.

Lemma part_reaction m q t x j : (j < ns)%N -> let p := part j in
  reaction (pencil_of s (Lambda2 m q)) t x (nf + j)%N =
  - (toR q * (toR (sign_of p) * along (tangent p) p (force s t (motion s x))) +
     toR m * along (normal p) p (force s t (motion s x))).
Proof.
move=> lt_j p; rewrite system_form_reaction ?ltn_add2l // nth_cat size_map ltnNge leq_addr /= addKn.
rewrite (nth_map (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z) // value_negative (value_cone_parts wf).
by rewrite flat_turning ?flat_part // toR0 mul0r addr0.
Qed.

Lemma length_slip j : toR (length_of s (nf + j)) = 1 :> R.
Proof. by rewrite /length_of ltnNge leq_addr. Qed.

Lemma slip_k x j : (j < ns)%N -> times KK x (nf + j)%N =
  - (toR (sign_of (part j)) * along (tangent (part j)) (part j) (force s 0 (motion s x))).
Proof.
move=> lt_j; rewrite times_k length_slip mul1r (slip_reaction wf) //.
by rewrite /row_factor mul1r /cone /= turning_at_flat ?flat_part // !mul0r !addr0.
Qed.

Lemma slip_m x j : (j < ns)%N -> times MM x (nf + j)%N =
  - (toR (sign_of (part j)) * along (tangent (part j)) (part j) (inert (motion s x))).
Proof.
move=> lt_j; rewrite times_m length_slip mul1r !part_reaction // /inert alongB toR0 toR1.
by move: (along _ _ _) (along _ _ _) (along _ _ _) (along _ _ _) => *; ring.
Qed.

Lemma slip_r x j : (j < ns)%N ->
  times RR x j = - along (normal (part j)) (part j) (force s 0 (motion s x)).
Proof.
move=> lt_j; rewrite times_r !(slip_reaction wf) // /row_factor /cone /=.
rewrite !turning_at_flat ?flat_part // !mul0r !addr0.
by move: (along _ _ _) (along _ _ _) => *; ring.
Qed.

Lemma slip_n x j : (j < ns)%N ->
  times NN x j = - along (normal (part j)) (part j) (inert (motion s x)).
Proof.
move=> lt_j; rewrite times_n !part_reaction // /inert alongB toR0 toR1.
by move: (along _ _ _) (along _ _ _) (along _ _ _) (along _ _ _) => *; ring.
Qed.

(* What the check says. *)

Notation D := (blocks_of Q).
Notation gu := (toR (gain_unit d) : R).
Notation U := (toR (unit_of w) : R).

Lemma wf_Q : wellformed Q.
Proof. by case/and5P: ok. Qed.

Lemma constant : free_rows_constant Q.
Proof. by case/and5P: ok. Qed.

Lemma positive : stiffness_positive D w.
Proof. by case/and5P: ok => _ _ _ /andP[]. Qed.

Lemma shaped : shapes D w.
Proof. by case/and5P: ok => _ _ _ /andP[]. Qed.

Lemma checked_rest :
  [/\ ordered lo hi, (0 <? hi.2)%Z,
      check_shapes s d (k_rows s) (rows_b Q) (m_rows s) (rows_b (friction_pencil s)),
      (0 <? bound_at (mass_form d))%Z && bounded_rows n (m_rows s) (mass_form d) &
      [&& check_turn s d (k_rows s) (rows_b Q) (turned_rows s d) hi, check_wide s w d D,
          check_root c s w d,
          check_end c s w d (condensed D w) (turned_rows s d)
            [seq form_size s w d D j | j <- si] lo low &
          check_end c s w d (condensed D w) (turned_rows s d)
            [seq form_size s w d D j | j <- si] hi high]].
Proof. by case/and5P: ok => _ _ _ _ /and5P[]. Qed.

Lemma gu0 : 0 < gu.
Proof. by have [_ _ /andP[? _] _ _] := checked_rest; rewrite toR_gt0. Qed.

Lemma gain_small j : j \in si -> (size (row_of (gain d) j) <= nf)%N.
Proof. by have [_ _ /and3P[_ /allP gains _] _ _] := checked_rest; apply: gains. Qed.

Lemma free_countE : free_count D = nf.
Proof. by rewrite /= size_iota. Qed.

Lemma slip_countE : slip_count D = ns.
Proof. by rewrite /= system_slips size_iota. Qed.

Lemma small_row rows i : all (all (fun e => e.1 < n)%N) rows ->
  all (fun e : nat * Z => e.1 < n)%N (nth [::] rows i).
Proof.
move=> /allP small; have [lt_i|ge_i] := ltnP i (size rows); last by rewrite nth_default.
exact/small/mem_nth.
Qed.

Lemma small_slip (f : nat -> sparse_row) j : all (all (fun e => e.1 < n)%N) [seq f j | j <- si] ->
  j \in si -> all (fun e => e.1 < n)%N (f j).
Proof. by move=> /allP small Hj; apply/small/map_f. Qed.

Lemma small_rows :
  [/\ all (all (fun e => e.1 < n)%N) (k_rows s), all (all (fun e => e.1 < n)%N) (m_rows s),
      forall j, j \in si -> all (fun e => e.1 < n)%N (k_friction s j),
      forall j, j \in si -> all (fun e => e.1 < n)%N (m_friction s j) &
      symmetric_rows_sparse (k_rows s) && symmetric_rows_sparse (m_rows s)].
Proof.
have [_ _ /and5P[_ _ /andP[k m] kf /andP[mf sym]] _ _] := checked_rest.
by split=> // j; apply: small_slip.
Qed.

(* Rows less G times free rows. *)

Lemma corrected_lookup rows f j i : j \in si ->
  gu * (toR (lookup f i) - \sum_(k <- fi) GG j k * toR (lookup (nth [::] rows k) i)) =
  toR (lookup (corrected_row d (take nf rows) f (row_of (gain d) j)) i) :> R.
Proof.
move=> Hj; rewrite lookup_cat toRD lookup_times toRM (lookup_gains _ _ _ (gain_small Hj)).
rewrite mulrBr mulr_sumr; congr (_ - _); apply: sum_eq => k.
rewrite mem_iota add0n => /= lt_k; rewrite nth_take // /GG mulrA; congr (_ * _).
by rewrite mulrC divfK // gt_eqF // gu0.
Qed.

Lemma corrected_small rows f g : all (fun e => e.1 < n)%N f ->
  all (all (fun e => e.1 < n)%N) rows ->
  all (fun e => e.1 < n)%N (corrected_row d (take nf rows) f g).
Proof.
move=> small_f small_r; rewrite all_cat; apply/andP; split.
  by apply/allP => e /mapP[e' e'_in ->]; exact: (allP small_f _ e'_in).
apply/allP => e /flatten_mapP[[x row] in_zip /mapP[e' e'_in ->]] /=.
have row_in := zip_second (map_f snd in_zip).
exact: (allP (allP small_r _ (mem_take row_in)) _ e'_in).
Qed.

Notation turned j := (toR (nth 0%Z (turned_rows s d) j) : R).
Definition ee j : R := turned j / gu.

Lemma turned_ge0 j : 0 <= turned j.
Proof.
rewrite /turned_rows /turned_in; have [lt_j|ge_j] := ltnP j ns; last first.
  by rewrite nth_default ?size_map ?size_iota.
rewrite (nth_map 0%N) ?size_iota // /sum_abs.
by rewrite (toR_norm1 R (leqnn _)) sumr_ge0.
Qed.

Lemma sums_e j : j \in si -> \sum_(i <- ix) `|EE j i| <= ee j.
Proof.
move=> Hj; have [_ sm _ sn _] := small_rows; have := Hj; rewrite mem_iota add0n => /= lt_j.
rewrite /ee /turned_rows /turned_in (nth_map 0%N) ?size_iota // nth_iota // ler_pdivl_mulr ?gu0 //.
rewrite (toR_sum_abs R (corrected_small _ (sn _ Hj) sm)) mulr_suml.
apply: sum_le => i _; rewrite -corrected_lookup // normrM (gtr0_norm gu0) mulrC.
exact: lexx.
Qed.

Lemma sums_c j : j \in si -> gu * (\sum_(i <- ix) `|CC j i|) = toR (sum_abs (k_corrected s d j)).
Proof.
move=> Hj; have [sk _ sr _ _] := small_rows.
rewrite (toR_sum_abs R (corrected_small _ (sr _ Hj) sk)) mulr_sumr.
by apply: sum_eq => i _; rewrite -corrected_lookup // normrM (gtr0_norm gu0).
Qed.

Lemma size_k : size (k_rows s) = n.
Proof. by rewrite size_map_from !size_map size_cat !size_map. Qed.

Lemma sums_k : \sum_(i <- ix) \sum_(j <- ix) `|KK i j| = toR (sumZ_of sum_abs (k_rows s)).
Proof.
have [sk _ _ _ _] := small_rows; rewrite (toR_sumZ_of R [::]) size_k; apply: sum_eq => i _.
by rewrite (toR_sum_abs R (small_row i sk)).
Qed.

Lemma sym_k i j : i \in ix -> j \in ix -> KK i j = KK j i.
Proof.
have [_ _ _ _ /andP[sym _]] := small_rows; rewrite !mem_iota !add0n => /= lt_i lt_j.
by rewrite /KK (symmetric_lookup sym) ?size_k.
Qed.

Notation mass_at := (toR (bound_at (mass_form d)) : R).
Notation mass_times := (toR (bound_times (mass_form d)) : R).
Definition heaviness : R := mass_at / mass_times.

Lemma bounded_m : bounded_rows n (m_rows s) (mass_form d).
Proof. by have [_ _ _ /andP[_ ?] _] := checked_rest. Qed.

Lemma mass_times0 : 0 < mass_times.
Proof. exact: (bound_times_gt0 R bounded_m). Qed.

Lemma heaviness0 : 0 < heaviness.
Proof.
by have [_ _ _ /andP[? _] _] := checked_rest; rewrite divr_gt0 ?mass_times0 // toR_gt0.
Qed.

Lemma heavy y : heaviness * (\sum_(i <- ix) y i ^+ 2) <= pair MM y y.
Proof.
rewrite /heaviness mulrAC ler_pdivr_mulr ?mass_times0 // [X in _ <= X]mulrC pair_form.
exact: (bounded_rows_sound bounded_m).
Qed.

Lemma sym_m i j : i \in ix -> j \in ix -> MM i j = MM j i.
Proof.
have [_ _ _ _ /andP[_ sym]] := small_rows; rewrite !mem_iota !add0n => /= lt_i lt_j.
by rewrite /MM (symmetric_lookup sym) ?(size_bounded bounded_m).
Qed.

Notation fraction e := (toR e.1 / toR e.2 : R).
Notation Om := (fraction (turn d)).
Notation Wd := (fraction (wide d)).
Notation gg := (fraction (root d)).

Lemma turn_parts : [/\ 0 < toR (turn d).2 :> R, 0 <= Om &
  2%:R * toR hi.1 * mass_times * (\sum_(j <- si) turned j) <= mass_at * toR hi.2 * gu].
Proof.
have [_ _ _ _ /and5P[/and4P[t2 t1 _ small] _ _ _ _]] := checked_rest.
have {}t2 : 0 < toR (turn d).2 :> R by rewrite toR_gt0.
split=> //; first by apply: divr_ge0; [rewrite toR_ge0 | apply: ltW].
move: small; rewrite -(toR_le R) !toRM [toR 2%Z](_ : _ = 2%:R) // (toR_sumZ_of R 0%Z).
by rewrite /turned_rows /turned_in size_map size_iota.
Qed.

Lemma hi2 : 0 < toR hi.2 :> R.
Proof. by have [_ ? _ _ _] := checked_rest; rewrite toR_gt0. Qed.

Definition kappa := Om * heaviness / 2%:R.

Lemma kappa_turn : 2%:R * kappa / heaviness = Om.
Proof.
by rewrite /kappa [2%:R * _]mulrC divfK ?pnatr_eq0 // mulfK // gt_eqF // heaviness0.
Qed.

Section Friction.

Variable mu : R.
Hypothesis bm : between mu lo hi.

Lemma mu_ge0 : 0 <= mu.
Proof. by have [O _ _ _ _] := checked_rest; apply: between_ge0 O bm. Qed.

Lemma mu_le : mu <= toR hi.1 / toR hi.2.
Proof. by rewrite ler_pdivl_mulr ?hi2 //; case: bm. Qed.

Lemma small_e : 2%:R * (mu * \sum_(j <- si) ee j) <= heaviness.
Proof.
have [_ _ small] := turn_parts.
have e0 : 0 <= \sum_(j <- si) ee j.
  by apply: sumr_ge0 => j _; rewrite /ee divr_ge0 ?turned_ge0 ?(ltW gu0).
apply: (@le_trans _ _ (2%:R * (toR hi.1 / toR hi.2 * \sum_(j <- si) ee j))).
  by rewrite ler_pmul2l ?ltr0n // ler_wpmul2r // mu_le.
rewrite /heaviness ler_pdivl_mulr ?mass_times0 // -(ler_pmul2r (mulr_gt0 hi2 gu0)).
rewrite [mass_at * _]mulrA; apply: le_trans small.
have -> : \sum_(j <- si) ee j = (\sum_(j <- si) turned j) / gu by rewrite mulr_suml.
rewrite le_eqVlt; apply/orP; left; apply/eqP.
move: (\sum_(j <- si) _) (lt0r_neq0 gu0) (lt0r_neq0 hi2) => x.
move: gu (toR hi.2 : R) (toR hi.1 : R) mass_times => g q p m g0 q0.
by field; apply/andP; split.
Qed.

Lemma kappaP : \sum_(i <- ix) \sum_(j <- ix) `|KK i j| +
  mu * (\sum_(j <- si) \sum_(i <- ix) `|CC j i|) <= kappa.
Proof.
have [_ _ _ _ /and5P[/and4P[t2 t1 big _] _ _ _ _]] := checked_rest.
have {}t2 : 0 < toR (turn d).2 :> R by rewrite toR_gt0.
move: big; rewrite /kappa_in -(toR_le R) !toRM toRD !toRM [toR 2%Z](_ : _ = 2%:R) //.
rewrite -sums_k toR_sides.
under [X in _ + _ * X]eq_big_seq => j Hj do rewrite -sums_c //.
rewrite -mulr_sumr; set k := \sum_(i <- ix) _; set cs := \sum_(j <- si) _ => big.
have cs0 : 0 <= cs by apply: sumr_ge0 => j _; apply: sumr_ge0.
apply: (@le_trans _ _ (k + toR hi.1 / toR hi.2 * cs)).
  by rewrite ler_add2l ler_wpmul2r // mu_le.
have f0 := mulr_gt0 (mulr_gt0 t2 mass_times0) (mulr_gt0 gu0 hi2).
rewrite -(ler_pmul2r f0) /kappa /heaviness -(@ler_pmul2r _ 2%:R) ?ltr0n //.
move: big (lt0r_neq0 hi2) (lt0r_neq0 mass_times0) (lt0r_neq0 t2).
clear f0 cs0; move: k cs gu (toR hi.2 : R) (toR hi.1 : R) mass_times mass_at
  (toR (turn d).1 : R) (toR (turn d).2 : R) => k cs g q p m b y z big q0 m0 z0.
have -> : (k + p / q * cs) * (z * m * (g * q)) * 2%:R = 2%:R * z * m * (g * q * k + p * (g * cs)).
  by field.
have -> // : y / z * (b / m) / 2%:R * (z * m * (g * q)) * 2%:R = y * b * g * q.
by field; apply/andP; split.
Qed.

End Friction.

(* Forms of the free degrees of freedom. *)

Notation F := (@Condensation.F R D).
Notation bc := (toR (bound_c w) : R).
Notation bd := (toR (bound_d w) : R).

Lemma bc0 : 0 < bc.
Proof. exact: c_gt0 positive. Qed.

Lemma bd0 : 0 < bd.
Proof. exact: d_gt0 positive. Qed.

Lemma U0 : 0 < U.
Proof. exact: unit_gt0 shaped. Qed.

Lemma sigma0 : 0 < bd / bc.
Proof. by rewrite divr_gt0 ?bc0 ?bd0. Qed.

Lemma below_F : bounded_below nf F (bd / bc).
Proof.
move=> z; rewrite mulrAC ler_pdivr_mulr ?bc0 // [X in _ <= X]mulrC -free_countE.
exact: (F_bounded positive z).
Qed.

Lemma free_F i k : i \in fi -> k \in fi -> KK i k = L * F i k.
Proof.
rewrite !mem_iota !add0n => /= lt_i lt_k.
rewrite /KK /Condensation.F nth_symmetric toRM /length_of lt_i; congr (_ * toR _).
have sz : size (Pencil.free Q) = nf by rewrite /= size_iota.
rewrite /= (nth_map 0%N) ?size_iota // (lookup_restrict wf_Q) ?sz //.
by rewrite !nth_iota // !add0n.
Qed.

Lemma sym_F : symmetric_on nf F.
Proof.
move=> i k Hi Hk; apply: (mulfI (lt0r_neq0 L0)); rewrite -!free_F //.
by move: Hi Hk; rewrite !mem_iota !add0n => /= lt_i lt_k; apply: sym_k;
  rewrite mem_iota add0n ltn_addr.
Qed.

Lemma slip_R j k : j \in si -> k \in fi -> RR j k = @at_ R (sf_b D) j k.
Proof.
rewrite !mem_iota !add0n => /= lt_j lt_k.
rewrite /RR /k_friction /at_ /Condensation.row_of /=.
rewrite (nth_map 0%N) ?system_slips ?size_iota // (nth_map 0%N) ?size_iota //.
by rewrite !nth_iota.
Qed.

Notation vv j := (fun k : nat => toR (nth 0%Z (form_vector s w d j) k) : R).
Notation ll j := (fun k : nat => toR (nth 0%Z (form_rest w d D j) k) : R).
Notation sizes j := (toR (form_size s w d D j) : R).

Lemma size_vector j : size (form_vector s w d j) = nf.
Proof. by rewrite size_map_from size_map size_iota. Qed.

Lemma vectorE j k : k \in fi -> vv j k =
  gu * @at_ R (left_vb w) j k - U * L * toR (nth 0%Z (row_of (gain d) j) k).
Proof.
rewrite mem_iota add0n => /= lt_k; rewrite /form_vector (nth_map_from 0%Z) ?size_map ?size_iota //.
by rewrite add0n toRB !toRM (nth_map 0%N) ?size_iota // nth_iota.
Qed.

Lemma restE j k : j \in si -> k \in fi -> ll j k =
  gu * (U * RR j k - \sum_(i <- fi) F k i * @at_ R (left_vb w) j i).
Proof.
move=> Hj Hk; have := Hk; rewrite mem_iota add0n => /= lt_k.
rewrite /form_rest (nth_map 0%Z) ?(size_residual positive) ?free_countE //.
rewrite toRM (residual_columnE R positive); last by rewrite free_countE.
by rewrite free_countE slip_R.
Qed.

Lemma row_form j k : j \in si -> k \in fi ->
  gu * U * CC j k = Energy.times nf F (vv j) k + ll j k.
Proof.
move=> Hj Hk; rewrite [X in _ = _ + X](restE Hj Hk) /corrected.
have -> : Energy.times nf F (vv j) k = gu * (\sum_(i <- fi) F k i * @at_ R (left_vb w) j i) -
    U * L * \sum_(i <- fi) F k i * toR (nth 0%Z (row_of (gain d) j) i).
  rewrite /Energy.times !mulr_sumr -sumrB; apply: sum_eq => i Hi; rewrite vectorE //.
  by move: (at_ _ _ _) (F _ _) (toR _) => *; ring.
have -> : \sum_(i <- fi) GG j i * KK i k =
    gu^-1 * (L * \sum_(i <- fi) F k i * toR (nth 0%Z (row_of (gain d) j) i)).
  rewrite !mulr_sumr; apply: sum_eq => i Hi; rewrite free_F // (sym_F Hi Hk) /GG.
  by move: (toR (nth _ _ _)) (F _ _) L gu^-1 => *; ring.
have := lt0r_neq0 gu0.
by move: (\sum_(i <- fi) _) (\sum_(i <- fi) _) gu U L (RR j k) => *; field.
Qed.

Lemma sizesE j : sizes j = bd * (Energy.pair nf F (vv j) (vv j) +
  2%:R * \sum_(k <- fi) vv j k * ll j k) + bc * \sum_(k <- fi) ll j k ^+ 2.
Proof.
have sv := size_vector j; have le_v : (size (form_vector s w d j) <= nf)%N by rewrite sv.
have le_l : (size (form_rest w d D j) <= nf)%N.
  by rewrite size_map (size_residual positive) free_countE.
rewrite /form_size toRD !toRM toRD toRM [toR 2%Z](_ : _ = 2%:R) //.
rewrite !(toR_dot R _ le_v) (toR_dot R _ le_l); congr (_ * (_ + _) + _).
apply: sum_eq => k; rewrite mem_iota add0n => /= lt_k; congr (_ * _).
have size_D : size (ff D) = nf by rewrite (size_ff positive) free_countE.
rewrite (nth_map [::]) ?size_D //.
have cols : all (fun e => e.1 < nf)%N (nth [::] (ff D) k).
  by rewrite -free_countE; apply: (columns_ff positive k).
by rewrite (toR_sparse_dot R _ cols).
Qed.

(* Vectors that are 0 at slip particles. *)
Lemma pair_free x : (forall j, j \in si -> x (nf + j)%N = 0) ->
  pair KK x x = L * Energy.pair nf F x x.
Proof.
move=> off; rewrite /Energy.pair sum_parts [X in _ + X]sum_zero ?addr0; last first.
  by move=> j /off->; rewrite mul0r.
rewrite mulr_sumr; apply: sum_eq => i Hi; rewrite mulrCA; congr (_ * _).
rewrite /Energy.times sum_parts [X in _ + X]sum_zero ?addr0; last by move=> j /off->; rewrite mulr0.
by rewrite mulr_sumr; apply: sum_eq => k Hk; rewrite free_F // mulrA.
Qed.

Lemma times_free A x j : (forall j, j \in si -> x (nf + j)%N = 0) ->
  times A x j = \sum_(k <- fi) A j k * x k.
Proof.
move=> off; rewrite /Energy.times sum_parts [X in _ + X]sum_zero ?addr0 // => i /off->.
by rewrite mulr0.
Qed.

Lemma pair_ge0_free x : (forall j, j \in si -> x (nf + j)%N = 0) -> 0 <= pair KK x x.
Proof.
by move=> off; rewrite pair_free // mulr_ge0 ?(ltW L0) // (pair_ge0 sigma0 below_F).
Qed.

Lemma row_bound x j : (forall j, j \in si -> x (nf + j)%N = 0) -> j \in si ->
  (times CC x j) ^+ 2 <= sizes j / (bd * L * (gu * U) ^+ 2) * pair KK x x.
Proof.
move=> off Hj; rewrite (times_free _ _ off).
have := form_of_row sigma0 sym_F below_F x (fun k Hk => row_form Hj Hk).
rewrite pair_free // sizesE; set q := Energy.pair nf F x x; set y := \sum_(k <- fi) _ * x k.
set a := Energy.pair nf F _ _; set b := \sum_(k <- fi) _ * ll j k; set e := \sum_(k <- fi) _ ^+ 2.
have g2 : 0 < (gu * U) ^+ 2 by rewrite exprn_gt0 // mulr_gt0 ?gu0 ?U0.
move=> le; rewrite -(ler_pmul2l g2) -exprMn; apply: le_trans le _.
rewrite le_eqVlt; apply/orP; left; apply/eqP.
move: (lt0r_neq0 g2) (lt0r_neq0 bd0) (lt0r_neq0 bc0) (lt0r_neq0 L0).
clear g2; move: a b e q bd bc L (gu * U) => a b e q p r l g g0 p0 r0 l0.
have {}g0 : g != 0 by move: g0; rewrite expf_eq0.
by field; rewrite ?g0 ?p0 ?r0 ?l0.
Qed.

(* C: entry_scale. *)
Notation Cc := (toR c : R).

Lemma root_parts : 0 <= gg /\ (nf = 0%N \/ bc * (Cc * L) <= gg ^+ 2 * bd).
Proof.
have [_ _ _ _ /and5P[_ _ /and3P[r2 r1 enough] _ _]] := checked_rest.
have {}r2 : 0 < toR (root d).2 :> R by rewrite toR_gt0.
split; first by apply: divr_ge0; [rewrite toR_ge0 | apply: ltW].
case/orP: enough => [/nilP none|]; first by left; rewrite /free_number none.
rewrite -(toR_le R) !toRM => enough; right; rewrite expr_div_n mulrAC ler_pdivl_mulr ?exprn_gt0 //.
by rewrite [X in X <= _]mulrC !expr2.
Qed.

Lemma norm_free x : 0 < Cc -> (forall j, j \in si -> x (nf + j)%N = 0) ->
  norm_le ix x (gg / L * Num.sqrt (pair KK x x / Cc)).
Proof.
move=> C0 off; have [g0 enough] := root_parts; have z0 := pair_ge0_free off.
split; first by rewrite mulr_ge0 ?sqrtr_ge0 // divr_ge0 // ltW // L0.
rewrite exprMn sqr_sqrtr ?divr_ge0 ?(ltW C0) // sum_parts [X in _ + X]sum_zero ?addr0; last first.
  by move=> j /off->; rewrite expr0n.
case: enough => [none|enough].
  have -> : \sum_(k <- fi) x k ^+ 2 = 0 by rewrite none big_nil.
  apply: mulr_ge0; first exact: sqr_ge0.
  by rewrite divr_ge0 // ltW.
rewrite pair_free //; set q := Energy.pair nf F x x.
have le : bd * (\sum_(k <- fi) x k ^+ 2) <= bc * q.
  by have := below_F x; rewrite mulrAC ler_pdivr_mulr ?bc0 // -pair_form [_ * bc]mulrC.
rewrite -(ler_pmul2l bd0); apply: le_trans le _.
have q0 : 0 <= q by apply: (pair_ge0 sigma0 below_F).
have -> : bd * ((gg / L) ^+ 2 * (L * q / Cc)) = gg ^+ 2 * bd * (q / (Cc * L)).
  have := lt0r_neq0 L0; have := lt0r_neq0 C0; clear q0; move: L Cc gg bd q => l cc g b q' c0 l0.
  by field; rewrite ?l0 ?c0.
apply: (@le_trans _ _ (bc * (Cc * L) * (q / (Cc * L)))).
  by rewrite -mulrA ler_pmul2l ?bc0 // [X in _ <= X]mulrC divfK // gt_eqF // mulr_gt0 // L0.
by rewrite ler_wpmul2r // divr_ge0 // ltW // mulr_gt0 // L0.
Qed.

(* Vectors that follow the slip particles. *)

Section Still.

Variable u : nat -> R.
Hypothesis still : forall i, i \in fi -> times KK u i = 0.

Lemma free_still i : i \in Pencil.free Q -> reaction Q 0 u i = 0.
Proof.
rewrite free_variable => lt_i; have := still (i := i); rewrite mem_iota add0n /= => /(_ lt_i).
by rewrite times_k /length_of lt_i => /eqP; rewrite mulf_eq0 gt_eqF ?L0 //= => /eqP.
Qed.

Lemma slip_ofE j : (j < ns)%N -> slip_of Q u j = u (nf + j)%N.
Proof. by move=> lt_j; rewrite /slip_of system_slips nth_iota. Qed.

Lemma still_part k : k \in fi ->
  u k = - \sum_(j <- si) @inverse_fs R D j k * u (nf + j)%N.
Proof.
move=> Hk; have := free_part_of_rows wf_Q constant positive free_still (k := k).
rewrite size_iota => /(_ Hk); rewrite /free_of /free_part slip_countE.
have := Hk; rewrite mem_iota add0n => /= lt_k; rewrite nth_iota // add0n => ->.
congr (- _); apply: sum_eq => j; rewrite mem_iota add0n => /= lt_j.
by rewrite slip_ofE.
Qed.

Definition width_of j : R := U^-1 * (toR (norm1 (row_of (right_w w) j)) +
  bc / bd * toR (norm1 (residual_column D w (fs D) (right_w w) j))).

Lemma width_of_ge0 j : 0 <= width_of j.
Proof.
rewrite mulr_ge0 ?invr_ge0 ?(ltW U0) // addr_ge0 ?mulr_ge0 ?invr_ge0 ?(ltW bc0) ?(ltW bd0) //.
  by rewrite (toR_norm1 R (leqnn _)) sumr_ge0.
by rewrite (toR_norm1 R (leqnn _)) sumr_ge0.
Qed.

Lemma norm_inverse j : j \in si -> norm_le fi (@inverse_fs R D j) (width_of j).
Proof.
move=> Hj; set r := residual_column D w (fs D) (right_w w) j.
pose z k := U * @inverse_fs R D j k - @at_ R (right_w w) j k.
have Fz k : k \in fi -> \sum_(i <- fi) F k i * z i = toR (nth 0%Z r k).
  move=> Hk; rewrite /r (residual_columnE R positive) ?free_countE //.
  under eq_bigr do rewrite mulrBr mulrCA; rewrite sumrB -mulr_sumr; congr (_ * _ - _).
  have below' : bounded_below (free_count D) F (bd / bc) by rewrite free_countE; apply: below_F.
  have Hk' : k \in iota 0 (free_count D) by rewrite free_countE.
  by rewrite -[RHS](solveP sigma0 below' (@at_ R (fs D) j) Hk') /inverse_fs free_countE.
have le_r : (size r <= nf)%N by rewrite /r (size_residual positive) free_countE.
have norm_z : norm_le fi z (bc / bd * toR (norm1 r)).
  have := norm_of_solution sigma0 below_F Fz (norm_sum _ _).
  by rewrite -(toR_norm1 R le_r) invf_div mulrC.
have le_w : (size (row_of (right_w w) j) <= nf)%N.
  have Hj' : j \in iota 0 (slip_count D) by rewrite slip_countE.
  rewrite -free_countE; apply: (Condensation.sizes shaped Hj').
  by rewrite !inE eqxx !orbT.
have norm_w : norm_le fi (@at_ R (right_w w) j) (toR (norm1 (row_of (right_w w) j))).
  by rewrite (toR_norm1 R le_w); apply: norm_sum.
have := norm_scale U^-1 (norm_add norm_w norm_z).
rewrite ger0_norm ?invr_ge0 ?(ltW U0) //; apply: norm_ext => k _.
by rewrite /z addrC subrK mulKf // gt_eqF // U0.
Qed.

Lemma width_le j : j \in si -> width_of j <= Wd.
Proof.
move=> Hj; have [_ _ _ _ /and5P[_ /and3P[w2 _ le] _ _ _]] := checked_rest.
have {}w2 : 0 < toR (wide d).2 :> R by rewrite toR_gt0.
apply: (@le_trans _ _ (\sum_(i <- si) width_of i)).
  rewrite (bigD1_seq j) ?iota_uniq //= ler_addl sumr_ge0 // => i _; exact: width_of_ge0.
move: le; rewrite -(toR_le R) !toRM /width_bound toR_sides => le.
have ub := mulr_gt0 U0 bd0; rewrite ler_pdivl_mulr // -(ler_pmul2r ub); apply: le_trans le.
rewrite [_ * toR (wide d).2]mulrC -mulrA le_eqVlt; apply/orP; left; apply/eqP; congr (_ * _).
rewrite mulr_suml; apply: sum_eq => i _.
rewrite /width_of toRD !toRM; have := lt0r_neq0 U0; have := lt0r_neq0 bd0.
move: (toR (norm1 _)) (toR (norm1 _)) bd bc U => a b p q r p0 r0.
by field; rewrite p0 r0.
Qed.

Lemma norm_still :
  norm_le ix u ((1 + Wd) * \sum_(j <- si) `|u (nf + j)%N|).
Proof.
set S := \sum_(j <- si) _; have S0 : 0 <= S by apply: sumr_ge0.
pose f i := if (i < nf)%N then u i else 0.
pose g i := if (i < nf)%N then 0 else u i.
have in_f i : i \in fi -> (i < nf)%N by rewrite mem_iota.
have norm_f : norm_le ix f (Wd * S).
  have each j : j \in si -> norm_le fi (fun k => - u (nf + j)%N * @inverse_fs R D j k)
      (Wd * `|u (nf + j)%N|).
    move=> Hj; apply: norm_weak (norm_scale (- u (nf + j)%N) (norm_inverse Hj)).
    by rewrite normrN mulrC ler_wpmul2r // width_le.
  have [m0 le] := norm_sums each; rewrite -mulr_sumr in m0 le; split=> //.
  rewrite sum_parts [X in _ + X]sum_zero ?addr0; last first.
    by move=> j _; rewrite /f ltnNge leq_addr /= expr0n.
  apply: le_trans le; rewrite le_eqVlt; apply/orP; left; apply/eqP; apply: sum_eq => k Hk.
  rewrite /f in_f // still_part // -sumrN; congr (_ ^+ 2); apply: eq_bigr => j _.
  by rewrite mulNr mulrC.
have norm_g : norm_le ix g S.
  have := norm_sum ix g; rewrite sum_parts sum_zero ?add0r; last first.
    by move=> i Hi; rewrite /g in_f // normr0.
  apply: norm_weak; rewrite le_eqVlt; apply/orP; left; apply/eqP; apply: eq_bigr => j _.
  by rewrite /g ltnNge leq_addr.
have := norm_add norm_f norm_g; rewrite mulrDl mul1r addrC; apply: norm_ext => i _.
by rewrite /f /g; case: ifP; rewrite ?addr0 ?add0r.
Qed.

End Still.

(* The ends. *)

Notation P := (condensed D w).
Notation T_at e := (T_end (A_condensed R D w) (B_condensed R D w) e).
Notation cl2 := (Cc * L ^+ 2).
Notation scale i := (@scale_of R w i * U ^+ 2).

Definition form_of (f : stable_end) i j : R := toR (entry (end_form f) i j) / toR (end_unit f).
Definition slope_of (f : stable_end) i : R := toR (nth 0%Z (end_slope f) i) / toR (end_unit f).

Definition theta mu i := mu * (ee i / cl2) * Om * (1 + Wd).
Definition rho mu i := mu * (ee i / cl2) * Om * gg.

Lemma scale0 i : i \in si -> 0 < scale i.
Proof.
move=> Hi; rewrite mulr_gt0 ?exprn_gt0 ?U0 //; apply: (scale_gt0 R shaped).
by rewrite slip_countE.
Qed.

Lemma fractions : [/\ 0 < toR (turn d).2 :> R, 0 < toR (wide d).2 :> R, 0 < toR (root d).2 :> R,
  0 <= Wd & 0 <= gg].
Proof.
have [_ _ _ _ /and5P[/and4P[t2 _ _ _] /and3P[w2 w1 _] /and3P[r2 r1 _] _ _]] := checked_rest.
by split; rewrite ?divr_ge0 ?toR_gt0 ?toR_ge0 //; apply/Z.leb_spec0/Z.lt_le_incl/Z.ltb_spec0.
Qed.

Section End.

Variables (e : point) (f : stable_end).
Hypotheses (C0 : 0 < Cc) (p0 : 0 <= toR e.1 :> R) (q0 : 0 < toR e.2 :> R).
Hypothesis checked : check_end c s w d P (turned_rows s d) [seq form_size s w d D j | j <- si] e f.

Notation p := (toR e.1 : R).
Notation q := (toR e.2 : R).
Notation one := (toR (end_unit f) : R).

Lemma end_parts : [/\ 0 < one, 0 < toR (end_times f) :> R, (0 <=? end_gram f)%Z,
  forall i j, i \in si -> j \in si -> entry (end_form f) i j = entry (end_form f) j i &
  forall i, i \in si -> 0 <= slope_of f i].
Proof.
case/and5P: checked => u0 t0 g0 /allP sym /andP[/allP b0 _].
have {}u0 : 0 < one by rewrite toR_gt0.
split=> // [|i j Hi Hj|i Hi]; first by rewrite toR_gt0.
  by have /allP/(_ j Hj)/Z.eqb_spec := sym i Hi.
by apply: divr_ge0; [rewrite toR_ge0; apply: b0 | apply: ltW].
Qed.

Lemma end_below i j : i \in si -> j \in si ->
  q * (scale i * (cl2 * (form_of f i j + theta (p / q) i))) <= T_at e i j.
Proof.
move=> Hi Hj; have [u0 _ _ _ _] := end_parts; have [t2 w2 _ _ _] := fractions.
have Hi' : i \in indices P by rewrite /indices /= system_slips size_iota.
have Hj' : j \in indices P by rewrite /indices /= system_slips size_iota.
have E := condensation_encloses R positive shaped.
have := T_end_enclosed E Hi' Hj' p0 (ltW q0); rewrite ler_distl => /andP[below_T _].
apply: le_trans below_T.
case/and5P: checked => _ _ _ _ /andP[_ /and4P[/allP/(_ i Hi)/allP/(_ j Hj) le _ _ _]].
move: le; rewrite /below -(toR_le R) !(toRM, toRD, toRB).
rewrite -/(@scale_of R w i) => le.
have units0 : 0 < one * (gu * toR (turn d).2 * toR (wide d).2) by rewrite !mulr_gt0 ?gu0.
rewrite -(ler_pmul2r units0); apply: le_trans le.
rewrite /form_of /theta /ee le_eqVlt; apply/orP; left; apply/eqP.
move: (lt0r_neq0 C0) (lt0r_neq0 L0) (lt0r_neq0 q0) (lt0r_neq0 u0) (lt0r_neq0 t2) (lt0r_neq0 w2).
move: (lt0r_neq0 gu0); clear.
move: (@scale_of R w i) U Cc L q p one (turned i) gu => sc u cc l qq pp o tt g.
move: (toR (entry _ _ _)) (toR (turn d).1) (toR (turn d).2) (toR (wide d).1) (toR (wide d).2).
move=> x t1 t2 w1 w2 *.
by field; do ?[apply/andP; split].
Qed.

Lemma end_slope_ge i : i \in si -> rho (p / q) i <= slope_of f i /\
  p ^+ 2 * sizes i <=
  q ^+ 2 * (slope_of f i - rho (p / q) i) ^+ 2 * (cl2 * L * bd * (gu * U) ^+ 2).
Proof.
move=> Hi; have [u0 _ _ _ _] := end_parts; have [t2 _ r2 _ _] := fractions.
case/and5P: checked => _ _ _ _ /andP[_ /and4P[_ /allP/(_ i Hi)/andP[rest0 le] _ _]].
have nth_i : nth 0%Z [seq form_size s w d D j | j <- si] i = form_size s w d D i.
  have := Hi; rewrite mem_iota add0n => /= lt_i.
  by rewrite (nth_map 0%N) ?size_iota // nth_iota.
move: rest0 le; rewrite nth_i -(toR_ge0 R) -(toR_le R) !(toRM, toRB).
set units := q * gu * toR (turn d).2 * toR (root d).2 * (Cc * (L * L)).
have units0 : 0 < units by rewrite !mulr_gt0 ?gu0 ?L0.
set rest := _ - _ => rest0 le; set beta := slope_of f i - rho (p / q) i.
have restE : rest = beta * (one * units).
  rewrite /rest /beta /slope_of /rho /ee /units.
  move: (lt0r_neq0 C0) (lt0r_neq0 L0) (lt0r_neq0 q0) (lt0r_neq0 u0) (lt0r_neq0 t2) (lt0r_neq0 r2).
  move: (lt0r_neq0 gu0); clear.
  move: Cc L q p one (turned i) gu => cc l qq pp o tt g.
  move: (toR (nth _ (end_slope f) i)) (toR (turn d).1) (toR (turn d).2) (toR (root d).1).
  move: (toR (root d).2) => x t1 t2 w1 w2 *.
  by field; do ?[apply/andP; split].
have ou := mulr_gt0 u0 units0; move: rest0 le; rewrite restE => rest0 le.
split; first by rewrite -subr_ge0 -(pmulr_lge0 _ ou).
rewrite -(ler_pmul2r (mulr_gt0 ou ou)); apply: le_trans (_ : _ <= _) (le_trans le _).
  by rewrite le_eqVlt; apply/orP; left; apply/eqP; ring.
by rewrite le_eqVlt; apply/orP; left; apply/eqP; ring.
Qed.

Lemma end_steep i x : i \in si -> (forall j, j \in si -> x (nf + j)%N = 0) ->
  p / q * `|times CC x i| <=
  (slope_of f i - rho (p / q) i) * (Cc * L * Num.sqrt (pair KK x x / Cc)).
Proof.
move=> Hi off; have [beta0 le] := end_slope_ge Hi; have := row_bound off Hi.
have z0 := pair_ge0_free off; rewrite -subr_ge0 in beta0.
move: beta0 le; set beta := _ - rho _ _; set z := pair KK x x in z0 *; set y := times CC x i.
move=> beta0 le row; have root0 : 0 <= Num.sqrt (z / Cc) by apply: sqrtr_ge0.
have g2 : 0 < (gu * U) ^+ 2 by rewrite exprn_gt0 // mulr_gt0 ?gu0 ?U0.
rewrite -(@ler_pexpn2r _ 2) ?nnegrE ?mulr_ge0 ?invr_ge0 ?(ltW q0) ?(ltW C0) ?(ltW L0) //.
rewrite !exprMn sqr_sqrtr ?divr_ge0 ?(ltW C0) // -normrX ger0_norm ?sqr_ge0 // exprVn.
have f0 : 0 < q ^+ 2 * (bd * L * (gu * U) ^+ 2).
  by rewrite mulr_gt0 ?exprn_gt0 // mulr_gt0 ?g2 // mulr_gt0 ?bd0 ?L0.
rewrite -(ler_pmul2r f0).
apply: (@le_trans _ _ (p ^+ 2 * sizes i * z)).
  have k0 := mulr_gt0 (mulr_gt0 bd0 L0) g2.
  have := ler_wpmul2r (ltW k0) (ler_wpmul2l (sqr_ge0 p) row).
  have leftE (y' p' q' k : R) : q' != 0 ->
      p' ^+ 2 / q' ^+ 2 * y' ^+ 2 * (q' ^+ 2 * k) = p' ^+ 2 * y' ^+ 2 * k by move=> ?; field.
  have rightE (p' s' k z' : R) : k != 0 ->
      p' ^+ 2 * (s' / k * z') * k = p' ^+ 2 * s' * z' by move=> ?; field.
  by rewrite leftE ?lt0r_neq0 // rightE ?lt0r_neq0.
apply: le_trans (ler_wpmul2r z0 le) _; rewrite le_eqVlt; apply/orP; left; apply/eqP.
have bothE (b' z' q' c' l' d' g' : R) : c' != 0 ->
    q' ^+ 2 * b' ^+ 2 * (c' * l' ^+ 2 * l' * d' * g') * z' =
    b' ^+ 2 * (c' ^+ 2 * l' ^+ 2 * (z' / c')) * (q' ^+ 2 * (d' * l' * g')) by move=> ?; field.
by rewrite bothE ?lt0r_neq0.
Qed.

Lemma end_definite x : (exists2 i, i \in si & x i != 0) ->
  0 < \sum_(i <- si) \sum_(j <- si) x i * form_of f i j * x j -
      (\sum_(i <- si) slope_of f i * x i) ^+ 2 / 4%:R.
Proof.
move=> nonzero; have [u0 t0 g0 sym _] := end_parts.
case/and5P: checked => _ _ _ _ /andP[_ /and4P[_ _ /eqP sz cov]].
have szz : size (zip si (end_rows f)) = ns by rewrite size_zip sz size_iota minnn.
have at_row i : i \in si -> (nth (0%N, (0%N, [::])) (zip si (end_rows f)) i).1 = i.
  by rewrite mem_iota add0n => /= lt_i; rewrite nth_zip ?size_iota ?sz //= nth_iota.
have sym_rows : symmetric_rows (0%N, (0%N, [::])) (form_entry f) (zip si (end_rows f)).
  move=> i j; rewrite szz => lt_i lt_j; rewrite !at_row ?mem_iota //= /form_entry.
  by rewrite sym ?mem_iota // [(nth _ _ i * _)%Z]Z.mul_comm.
have [_ /(_ isT)] := covered_form x (@late_gram R _ _ (0%N, (0%N, [::])) _ g0) sym_rows cov.
have formE : form (0%N, (0%N, [::])) (form_entry f) (zip si (end_rows f)) x =
    toR (end_times f) * (4%:R * one ^+ 2) *
    (\sum_(i <- si) \sum_(j <- si) x i * form_of f i j * x j -
      (\sum_(i <- si) slope_of f i * x i) ^+ 2 / 4%:R).
  rewrite /form szz expr2 [X in X / 4%:R]mulr_suml mulr_suml -sumrB mulr_sumr.
  apply: sum_eq => i Hi; rewrite mulr_sumr mulr_suml -sumrB mulr_sumr; apply: sum_eq => j Hj.
  rewrite !at_row // /form_entry toRM toRB !toRM [toR 4%Z](_ : _ = 4%:R) // /form_of /slope_of.
  move: (lt0r_neq0 u0) (x i) (x j) (toR (entry _ _ _)) (toR (nth _ _ i)) (toR (nth _ _ j)).
  by move: one (toR (end_times f)) => *; field.
rewrite szz formE => pos; have k0 : 0 < toR (end_times f) * (4%:R * one ^+ 2) :> R.
  by rewrite !mulr_gt0 ?ltr0n ?exprn_gt0.
by rewrite -(pmulr_rgt0 _ k0); apply: pos.
Qed.

End End.

(* Between the ends. *)

Notation slip_force := (Energy.slip_force nf ns KK MM RR NN).
Notation still_force := (Energy.still_force nf ns KK RR).
Notation free_law := (Energy.free_law nf ns KK MM).
Notation follows := (Energy.follows nf ns KK).

Definition motions_stable mu := exists (form : nat -> nat -> R) (slope drift : nat -> R),
  [/\ forall i j, i \in si -> j \in si -> form i j = form j i,
      forall i, i \in si -> 0 <= slope i /\ 0 <= drift i,
      forall x, (exists2 i, i \in si & x i != 0) ->
        0 < \sum_(i <- si) \sum_(j <- si) x i * form i j * x j -
            (\sum_(i <- si) slope i * x i) ^+ 2 / 4%:R,
      forall u, (forall i, i \in fi -> times KK u i = 0) ->
        (forall j, j \in si -> 0 <= u (nf + j)%N) -> forall i, i \in si ->
        \sum_(j <- si) cl2 * (form i j + drift i) * u (nf + j)%N <= still_force mu u i &
      forall x a v u u', free_law x a ->
        (forall j, j \in si -> [/\ 0 <= v (nf + j)%N, v (nf + j)%N * slip_force mu x a j = 0 &
                                   a (nf + j)%N * slip_force mu x a j = 0]) ->
        follows u x -> follows u' v ->
        let e i := x i - u i in let e' i := v i - u' i in
        pair MM v a + pair KK e' e <= \sum_(j <- si) v (nf + j)%N *
          (- still_force mu u j + cl2 * drift j * (\sum_(k <- si) `|x (nf + k)%N|) +
           slope j * (Cc * L * Num.sqrt (pair KK e e / Cc)))].

Lemma ee_ge0 i : 0 <= ee i.
Proof. by rewrite divr_ge0 ?turned_ge0 // ltW // gu0. Qed.

Theorem stable_motions mu : 0 < Cc -> between mu lo hi -> motions_stable mu.
Proof.
move=> C0 bm; have [O _ _ _ /and5P[_ _ _ low_ok high_ok]] := checked_rest.
have [p0 _ p0' _] := ordered_ge0 R O.
have q0 : 0 < toR lo.2 :> R by case/and5P: O => _ ? _ _ _; rewrite toR_gt0.
have q0' := hi2; have mu0 := mu_ge0 bm; have [_ Om0 _] := turn_parts.
have [t2 w2 r2 Wd0 gg0] := fractions; have [a [b [a0 b0 [one val] _]]] := weights_of_ends O bm.
set e := toR lo.1 / toR lo.2 : R; set e' := toR hi.1 / toR hi.2 : R.
set f := a * toR lo.2; set f' := b * toR hi.2; rewrite -/f -/f' in one.
have f0 : 0 <= f by rewrite mulr_ge0 // ltW.
have f0' : 0 <= f' by rewrite mulr_ge0 // ltW.
have muE : f * e + f' * e' = mu.
  by rewrite -val /f /f' /e /e' ![_ / _]mulrC !mulrA !mulfK ?gt_eqF.
have [_ _ _ sym slope0] := end_parts low_ok; have [_ _ _ sym' slope0'] := end_parts high_ok.
pose form i j := f * form_of low i j + f' * form_of high i j.
pose slope i := f * slope_of low i + f' * slope_of high i.
have thetaE i : f * theta e i + f' * theta e' i = theta mu i.
  by rewrite -muE /theta !mulrDl !mulrA.
have rhoE i : f * rho e i + f' * rho e' i = rho mu i by rewrite -muE /rho !mulrDl !mulrA.
have cl0 : 0 < cl2 by rewrite mulr_gt0 ?exprn_gt0 ?L0.
have drift0 i : 0 <= theta mu i.
  apply: mulr_ge0; last by rewrite addr_ge0 ?ler01.
  by apply: mulr_ge0 => //; apply: mulr_ge0 => //; rewrite divr_ge0 ?ee_ge0 // ltW.
exists form, slope, (theta mu); split.
- move=> i j Hi Hj; congr (_ * _ + _ * _); rewrite /form_of; congr (toR _ / _).
    exact: sym.
  exact: sym'.
- by move=> i Hi; split=> //; rewrite addr_ge0 // mulr_ge0 ?slope0 ?slope0'.
- move=> x nonzero; have def := end_definite low_ok nonzero.
  have def' := end_definite high_ok nonzero.
  have := definite_mean f0 f0' one def def'; rewrite !mulr_sumr -!big_split /=.
  have -> : \sum_(i <- si) (f * (\sum_(j <- si) x i * form_of low i j * x j) +
      f' * (\sum_(j <- si) x i * form_of high i j * x j)) =
      \sum_(i <- si) \sum_(j <- si) x i * form i j * x j.
    apply: eq_bigr => i _; rewrite !mulr_sumr -big_split; apply: eq_bigr => j _ /=.
    by rewrite /form; move: (x i) (x j) (form_of _ _ _) (form_of _ _ _) => *; ring.
  have -> // : \sum_(i <- si) (f * (slope_of low i * x i) + f' * (slope_of high i * x i)) =
      \sum_(i <- si) slope i * x i.
  by apply: eq_bigr => i _; rewrite /slope mulrDl !mulrA.
- move=> u still u0 i Hi; have lt_i : (i < ns)%N by move: Hi; rewrite mem_iota.
  have s0 := scale0 Hi; rewrite -(ler_pmul2l s0).
  have part k : k \in iota 0 (size (Pencil.free Q)) ->
      free_of Q u k = free_part D (slip_of Q u) k.
    exact: (free_part_of_rows wf_Q constant positive (free_still still)).
  have lt_i' : (i < size (slip Q))%N by rewrite system_slips size_iota.
  have := condensed_reaction wf_Q w mu lt_i' part.
  rewrite system_slips nth_iota //.
  have -> : reaction Q mu u (nf + i)%N = still_force mu u i.
    rewrite /Energy.still_force times_k length_slip mul1r times_r /reaction.
    rewrite -sumrB mulr_sumr -big_split; apply: eq_bigr => j _ /=.
    by move: (a_entry _ _ _ _) (b_entry _ _ _ _) (u j) => *; ring.
  move=> <-; rewrite /image /indices /= system_slips size_iota mulr_sumr.
  apply: sum_le => j Hj; have lt_j : (j < ns)%N by move: Hj; rewrite mem_iota.
  rewrite slip_ofE // mulrA; apply: ler_wpmul2r; first exact: u0.
  have -> : T (A_condensed R D w) (B_condensed R D w) mu i j = a * T_at lo i j + b * T_at hi i j.
    rewrite /T /T_end -{1}[A_condensed R D w i j]mul1r -{1}one -{1}val /f /f'.
    by move: (A_condensed _ _ _ _ _) (B_condensed _ _ _ _ _) => *; ring.
  have := ler_add (ler_wpmul2l a0 (end_below C0 p0 q0 low_ok Hi Hj))
                  (ler_wpmul2l b0 (end_below C0 p0' q0' high_ok Hi Hj)).
  apply: le_trans; rewrite -/e -/e' -thetaE le_eqVlt; apply/orP; left; apply/eqP.
  rewrite /form /f /f'; move: (theta e i) (theta e' i) (form_of _ _ _) (form_of _ _ _) => *.
  by ring.
move=> x acc v u u' law laws fu fu'; lazy zeta.
pose ex i := x i - u i; pose ev i := v i - u' i; rewrite -/ex -/ev.
have zero j (Hj : j \in si) : v (nf + j)%N * slip_force mu x acc j = 0 by have [] := laws j Hj.
have zero_a j (Hj : j \in si) : acc (nf + j)%N * slip_force mu x acc j = 0 by have [] := laws j Hj.
have := power GG sym_k law zero fu fu'; lazy zeta; rewrite -/ex -/ev => ->; rewrite -sumrN.
apply: sum_le => j Hj; rewrite -mulrN; apply: ler_wpmul2l; first by have [] := laws j Hj.
have off i : i \in si -> ex (nf + i)%N = 0 by apply: (rest_off fu).
set root := Num.sqrt _; set S := \sum_(k <- si) _.
have steep : `|mu * times CC ex j| <= (slope j - rho mu j) * (Cc * L * root).
  rewrite normrM (ger0_norm mu0) -{1}muE [(_ + _) * `|_|]mulrDl.
  have := ler_add (ler_wpmul2l f0 (end_steep C0 p0 q0 low_ok Hj off))
                  (ler_wpmul2l f0' (end_steep C0 p0' q0' high_ok Hj off)).
  rewrite -/root -/e -/e' ![f * (e * _)]mulrA ![f' * (e' * _)]mulrA => le.
  apply: le_trans le _; rewrite -rhoE /slope.
  rewrite le_eqVlt; apply/orP; left; apply/eqP.
  by move: (slope_of _ _) (slope_of _ _) (rho _ _) (rho _ _) => *; ring.
have norm_u : norm_le ix u ((1 + Wd) * S).
  case: fu => still same; have := norm_still still.
  by congr (norm_le _ _ (_ * _)); apply: sum_eq => k Hk; rewrite same.
have := drag law heaviness0 mu0 heavy sums_e (small_e bm) (kappaP bm) zero_a
  (norm_free C0 off) norm_u Hj.
rewrite kappa_turn -/S => drags.
have {}drags : `|mu * times EE acc j| <= cl2 * theta mu j * S + rho mu j * (Cc * L * root).
  apply: le_trans drags _; rewrite le_eqVlt; apply/orP; left; apply/eqP; rewrite /theta /rho.
  have splitE (m k o w' g' c' l' s' r' : R) : c' != 0 -> l' != 0 ->
      m * k * o * (1 + w') * s' + m * k * o * (g' / l') * r' =
      c' * l' ^+ 2 * (m * (k / (c' * l' ^+ 2)) * o * (1 + w')) * s' +
      m * (k / (c' * l' ^+ 2)) * o * g' * (c' * l' * r').
    by move=> *; field; do ?[apply/andP; split].
  by apply: splitE; apply: lt0r_neq0; rewrite ?L0.
move: steep drags; rewrite !ler_norml => /andP[steep _] /andP[drags _].
rewrite -subr_ge0 opprK in steep; rewrite -subr_ge0 opprK in drags.
rewrite -subr_ge0; apply: le_trans (addr_ge0 steep drags) _.
rewrite le_eqVlt; apply/orP; left; apply/eqP; move: (mu * times _ _ _) (mu * times _ _ _).
by move: (still_force mu u j) (slope j) (rho mu j) (cl2 * _ * S) (Cc * L * root) => *; ring.
Qed.

End Sound.
