(* Condensation about an anchor, for pencils whose free rows depend on t.

   The pencil is A + t B = (A_0 + d A_1) / q with d = t - p/q; p/q is the *center* of the anchor and
   A_0 = q A + p B, A_1 = q B are integer matrices.  In blocks, f for the free variables:

       F(d) = A_0,ff + d A_1,ff,   G(d) in the free rows,   H(d), D(d) in the other rows.

   The anchor gives series W(d) and V(d) of integer matrices that approximate u F^-1 G and
   u F^-1 H'.  With r = u G - F W and l = u H' - F V, series as well,

       u^2 (D - H F^-1 G) = Z - l' F^-1 r,      Z = u^2 D - u H W - V' r.

   F(d) >= q (sigma + t tau) I is shown by factors that cover c A_ff - d I and c B_ff - d I
   ([bounded_rows] of Bounded.v), so the last term is at most |l_i| |r_j| / (q (sigma + lo tau))
   for t >= lo.

   The interval [lo, hi] of a region is described by u in [0, 1] with t = lo + u (hi - lo).
   [local_pencil] computes, from the series and these bounds, an enclosed pencil over [0, 1];
   [local_line] and [local_chord] say that the exact condensed matrix is near a line, and near
   chords, in the sense of RootLeaf.v.

   The leaves of a region are checked for this local pencil, with the interval [0, 1] in place of
   that of the region.  [anchored_excludes]: a leaf that is not a solution excludes the solutions of
   the region.  [anchored_yields]: a root leaf with the outcome "solution" has exactly one.

   (AnchorLeaf.v has both theorems.)

   Page: spec/certificates.md, 5.14.
   Rust: crates/check/src/cover/condensed.rs, expanded.rs, family.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Farkas Covered Definite Root RootLeaf
  Existence Pinned Places Condensation Pencil Claim Norms Elimination Series.

(* The center p/q, u, W, V, and a positive factor for each row of a complementarity variable. *)
Record anchor := Anchor {
  anchor_center : point;
  anchor_unit : Z;
  anchor_right : seq matrix;
  anchor_left : seq matrix;
  anchor_scale : seq Z }.

(* Z, bounds of the norms of l and r, and of the row sums of A_1,ff. *)
Record anchor_family := AnchorFamily {
  series_z : seq matrix;
  left_norms : seq polynomial;
  right_norms : seq polynomial;
  drift : Z }.

(* An entry of a local pencil: centers and radii at 0 and of the slope. *)
Record local_entry := LocalEntry {
  local_a : Z;
  local_b : Z;
  local_ra : Z;
  local_rb : Z }.

(* What is shown of a region with an anchor. *)
Inductive local_leaf :=
  | LocalFarkas of seq Z
  | LocalDefinite of bool & factor & factor
  | LocalAbsent of absence
  | LocalRoot of isolation & outcome.

Section Checker.

Local Open Scope Z_scope.


Section Expansion.

Variables (Q : pencil) (a : anchor).

Notation p := (anchor_center a).1.
Notation q := (anchor_center a).2.
Notation ns := (size (slip Q)).
Notation nf := (size (free Q)).

Definition row_0 i := times_row q (row_a Q i) ++ times_row p (row_b Q i).
Definition row_1 i := times_row q (row_b Q i).

Definition ff_block (row : nat -> sparse_row) :=
  let place := places (free Q) in [seq restrict place (row i) | i <- free Q].
Definition fs_block (row : nat -> sparse_row) : matrix :=
  let columns := slip Q in
  [seq (let entries := row i in [seq lookup entries j | j <- columns]) | i <- free Q].
Definition sf_block (row : nat -> sparse_row) : matrix :=
  let rows := [seq row i | i <- slip Q] in
  [seq [seq lookup entries j | entries <- rows] | j <- free Q].
Definition ss_block (row : nat -> sparse_row) : matrix :=
  let columns := slip Q in
  [seq (let entries := row i in [seq lookup entries j | j <- columns]) | i <- columns].

(* u Y - F X, for F = f_0 + d f_1 *)
Definition residual_series (f0 f1 : seq sparse_row) (Y X : seq matrix) : seq matrix :=
  add_series (scale_series (anchor_unit a) Y)
    (scale_series (-1) (add_series (product_series f0 X) ([::] :: product_series f1 X))).

Definition residual_right :=
  residual_series (ff_block row_0) (ff_block row_1) [:: fs_block row_0; fs_block row_1]
    (anchor_right a).
Definition residual_left :=
  residual_series (ff_block row_0) (ff_block row_1) [:: sf_block row_0; sf_block row_1]
    (anchor_left a).

(* Z for a given r. *)
Definition center_series (r : seq matrix) : seq matrix :=
  let u := anchor_unit a in
  add_series (scale_series (u * u) [:: ss_block row_0; ss_block row_1])
    (scale_series (-1)
      (add_series
         (scale_series u (cross_series ns [:: sf_block row_0; sf_block row_1] (anchor_right a)))
         (cross_series ns (anchor_left a) r))).

Definition row_sum (row : sparse_row) := foldr (fun e s => Z.abs e.2 + s) 0 row.

Definition expand_from (f1 : seq sparse_row) (l r : seq matrix) : anchor_family :=
  AnchorFamily (center_series r) [seq norms l i | i <- iota 0 ns] [seq norms r j | j <- iota 0 ns]
    (foldr Z.max 0 [seq row_sum row | row <- f1]).

Definition small (L : seq matrix) := all (fun M => size M <= nf)%N L.

(* None if a part has not the right shape. *)
Definition expand : option anchor_family :=
  let f0 := ff_block row_0 in
  let f1 := ff_block row_1 in
  let l := residual_series f0 f1 [:: sf_block row_0; sf_block row_1] (anchor_left a) in
  let r := residual_series f0 f1 [:: fs_block row_0; fs_block row_1] (anchor_right a) in
  if [&& 0 <? q, 0 <? anchor_unit a, all (fun i => 0 <? nth 0 (anchor_scale a) i) (iota 0 ns),
         small (anchor_left a), small l & small r]
  then Some (expand_from f1 l r) else None.

End Expansion.

Section Region.

Variables (ns : nat) (a : anchor) (low_a low_b : form_bound) (fam : anchor_family) (lo hi : point).

Notation p := (anchor_center a).1.
Notation q := (anchor_center a).2.

Definition interval_width := hi.1 * lo.2 - lo.1 * hi.2.

(* y d = x + v u, |y d| <= b. *)
Definition offset := (lo.1 * q - p * lo.2) * hi.2.
Definition extent := interval_width * q.
Definition unit_y := lo.2 * hi.2 * q.
Definition reach := Z.max (Z.abs offset) (Z.abs (offset + extent)).

(* F >= (s_n / s_d) I *)
Definition bound_n :=
  q * (bound_at low_a * bound_times low_b * lo.2 + lo.1 * bound_at low_b * bound_times low_a).
Definition bound_d := bound_times low_a * bound_times low_b * lo.2.

Definition proper_interval :=
  [&& 0 <=? lo.1, 0 <? lo.2, 0 <? hi.2, 0 <? interval_width & 0 <? bound_n].

(* Bounds nl, nr, dl, dr: numerator and denominator. *)
Definition remainder_radius power (nl nr : Z * Z) :=
  divide_up (power * nl.1 * nr.1 * bound_d) (nl.2 * nr.2 * bound_n).

Definition remainder_slope power (nl nr dl dr : Z * Z) :=
  divide_up (power * extent * dl.1 * nr.1 * bound_d) (unit_y * dl.2 * nr.2 * bound_n) +
  divide_up (power * extent * nl.1 * dr.1 * bound_d) (unit_y * nl.2 * dr.2 * bound_n) +
  divide_up (power * extent * nl.1 * nr.1 * drift fam * bound_d * bound_d)
            (unit_y * nl.2 * nr.2 * bound_n * bound_n).

Definition entry_of slopes (z : polynomial) nl nr dl dr : local_entry :=
  let c := substituted offset extent unit_y z in
  let rb := if slopes then 8 * spread c.1 + 4 * remainder_slope c.2 nl nr dl dr else 0 in
  LocalEntry (4 * constant_of c.1) (4 * chord_of c.1)
    (spread c.1 + 4 * remainder_radius c.2 nl nr + rb) rb.

(* The row is multiplied by scale and divided by grain. *)
Definition rounded grain scale (e : local_entry) : local_entry :=
  LocalEntry (scale * local_a e / grain) (scale * local_b e / grain)
    (divide_up (scale * local_ra e) grain + 1) (divide_up (scale * local_rb e) grain + 1).

Definition local_entries slopes grain : seq (seq local_entry) :=
  let at_reach := homogeneous reach unit_y in
  let nl := [seq at_reach n | n <- left_norms fam] in
  let nr := [seq at_reach n | n <- right_norms fam] in
  let dl := [seq at_reach (derivative n) | n <- left_norms fam] in
  let dr := [seq at_reach (derivative n) | n <- right_norms fam] in
  let get (l : seq (Z * Z)) i := nth (0, 1) l i in
  [seq [seq rounded grain (nth 0 (anchor_scale a) i)
              (entry_of slopes (poly_of (series_z fam) i j) (get nl i) (get nr j)
                 (get dl i) (get dr j)) | j <- iota 0 ns] | i <- iota 0 ns].

Definition local_pencil slopes grain : enclosed :=
  let t := local_entries slopes grain in
  let table (f : local_entry -> Z) : matrix := [seq [seq f e | e <- row] | row <- t] in
  Enclosed ns (table local_a) (table local_b) (table local_ra) (table local_rb).

(* A point e as a value of u. *)
Definition local_point (e : point) : point :=
  ((e.1 * lo.2 - lo.1 * e.2) * hi.2, e.2 * interval_width).

Definition local_isolation (c : isolation) : isolation :=
  Isolation (pivot c) (vector c) (local_point (from_point c)) (local_point (to_point c))
    (wide_box c) (narrow_box c) (unique c) (left_vector c).

Definition local_known (q : known) : known :=
  Known (local_point (known_from q)) (local_point (known_to q)) (known_support q)
    (known_biactive q).

Definition moved_leaf (l : local_leaf) : local_leaf :=
  if l is LocalRoot c o then LocalRoot (local_isolation c) o else l.

Definition wants_slopes (l : local_leaf) := if l is LocalRoot _ Solution then true else false.

Definition local_region (r : region) : region := Region (0, 1) (1, 1) (states r).

Definition check_local (P : enclosed) (r : region) (l : local_leaf) : bool :=
  match l with
  | LocalFarkas w => farkas P r w
  | LocalDefinite negative low high => definite P negative r low high
  | LocalAbsent c => check_absent P r c
  | LocalRoot c o => check_root P r c o
  end.

(* A leaf of a region with the interval [lo, hi]. *)
Definition check_anchored (r : region) grain (l : local_leaf) :=
  [&& proper_interval, 0 <? grain &
      check_local (local_pencil (wants_slopes l) grain) (local_region r) (moved_leaf l)].

(* The region of a known solution. *)
Definition check_anchored_claim (r : region) grain (c : pinning) (q : known) :=
  [&& proper_interval, 0 <? grain &
      check_claimed (local_pencil true grain) (local_region r) c (local_known q)].

(* A region with at most one null vector. *)
Definition check_anchored_limit (r : region) grain (c : pinning) :=
  [&& proper_interval, 0 <? grain & pinned (local_pencil true grain) (local_region r) c].

End Region.

End Checker.

(* What is checked of a pencil, its anchor and an interval [lo, hi]. *)
Definition prepared Q a fam low_a low_b lo hi :=
  [/\ wellformed Q, expand Q a = Some fam,
      bounded_rows (size (free Q)) (ff_block Q (row_a Q)) low_a,
      bounded_rows (size (free Q)) (ff_block Q (row_b Q)) low_b &
      proper_interval a low_a low_b lo hi].

Lemma prepare Q a fam low_a low_b lo hi : expand Q a = Some fam -> wellformed Q ->
  bounded_rows (size (free Q)) (ff_block Q (row_a Q)) low_a ->
  bounded_rows (size (free Q)) (ff_block Q (row_b Q)) low_b ->
  proper_interval a low_a low_b lo hi -> prepared Q a fam low_a low_b lo hi.
Proof. by []. Qed.

Section Expand.

Variables (R : rcfType) (Q : pencil) (a : anchor).
Hypothesis wf : wellformed Q.

Notation p := (anchor_center a).1.
Notation q := (anchor_center a).2.
Notation ns := (size (slip Q)).
Notation nf := (size (free Q)).
Notation fi := (iota 0 nf).
Notation si := (iota 0 ns).
Notation free_at k := (nth 0%N (free Q) k).
Notation slip_at k := (nth 0%N (slip Q) k).

Definition shifted_entry (d : R) i j : R :=
  toR (lookup (row_0 Q a i) j) + d * toR (lookup (row_1 Q a i) j).

Definition F_at d i k := shifted_entry d (free_at i) (free_at k).
Definition G_at d i j := shifted_entry d (free_at i) (slip_at j).
Definition H_at d i k := shifted_entry d (slip_at i) (free_at k).
Definition D_at d i j := shifted_entry d (slip_at i) (slip_at j).

(* The exact condensed matrix, times q. *)
Definition condensed_family d := condensed_at nf (F_at d) (G_at d) (H_at d) (D_at d).

Lemma shifted_entryE d t i j : toR q * t = toR p + toR q * d ->
  shifted_entry d i j = toR q * (a_entry R Q i j + t * b_entry R Q i j).
Proof.
move=> td; rewrite /shifted_entry /row_0 /row_1 lookup_cat !lookup_times toRD !toRM.
rewrite -/(a_entry R Q i j) -/(b_entry R Q i j); move: (a_entry _ _ _ _) (b_entry _ _ _ _) => x y.
have -> : toR q * (x + t * y) = toR q * x + (toR q * t) * y by ring.
by rewrite td; ring.
Qed.

(* Rows of the pencil in terms of the blocks. *)
Lemma reaction_free_at d t x k : toR q * t = toR p + toR q * d -> (k < nf)%N ->
  toR q * reaction Q t x (free_at k) =
  \sum_(m <- fi) F_at d k m * free_of Q x m + \sum_(j <- si) G_at d k j * slip_of Q x j.
Proof.
move=> td Hk; rewrite /reaction (sum_free_slip wf) mulrDr !mulr_sumr.
rewrite (sum_positions (free Q)) (sum_positions (slip Q)); congr (_ + _).
  by apply: eq_bigr => j _; rewrite mulrA -(shifted_entryE _ _ td).
by apply: eq_bigr => j _; rewrite mulrA -(shifted_entryE _ _ td).
Qed.

Lemma reaction_slip_at d t x i : toR q * t = toR p + toR q * d -> (i < ns)%N ->
  toR q * reaction Q t x (slip_at i) =
  \sum_(m <- fi) H_at d i m * free_of Q x m + \sum_(j <- si) D_at d i j * slip_of Q x j.
Proof.
move=> td Hi; rewrite /reaction (sum_free_slip wf) mulrDr !mulr_sumr.
rewrite (sum_positions (free Q)) (sum_positions (slip Q)); congr (_ + _).
  by apply: eq_bigr => j _; rewrite mulrA -(shifted_entryE _ _ td).
by apply: eq_bigr => j _; rewrite mulrA -(shifted_entryE _ _ td).
Qed.

(* The blocks of the checker. *)
Lemma entry_block (row : nat -> sparse_row) (l1 l2 : seq nat) i j :
  (i < size l1)%N -> (j < size l2)%N ->
  entry [seq [seq lookup (row m) k | k <- l2] | m <- l1] i j =
  lookup (row (nth 0%N l1 i)) (nth 0%N l2 j).
Proof. by move=> Hi Hj; rewrite /entry (nth_map 0%N) // (nth_map 0%N). Qed.

Lemma value_fs d i j : (i < nf)%N -> (j < ns)%N ->
  value [:: fs_block Q (row_0 Q a); fs_block Q (row_1 Q a)] d i j = G_at d i j.
Proof.
by move=> Hi Hj; rewrite !value_cons value_nil mulr0 addr0 !entry_block.
Qed.

Lemma value_ss d i j : (i < ns)%N -> (j < ns)%N ->
  value [:: ss_block Q (row_0 Q a); ss_block Q (row_1 Q a)] d i j = D_at d i j.
Proof.
by move=> Hi Hj; rewrite !value_cons value_nil mulr0 addr0 !entry_block.
Qed.

Lemma value_sf d i k : (i < ns)%N -> (k < nf)%N ->
  value [:: sf_block Q (row_0 Q a); sf_block Q (row_1 Q a)] d k i = H_at d i k.
Proof.
move=> Hi Hk; rewrite !value_cons value_nil mulr0 addr0 /entry /sf_block.
by rewrite !(nth_map 0%N) // !(nth_map [::]) ?size_map // !(nth_map 0%N).
Qed.

Lemma ff_range (row : nat -> sparse_row) i :
  all (fun e => e.1 < nf)%N (nth [::] (ff_block Q row) i).
Proof.
have [l|l] := ltnP i nf; last by rewrite nth_default // size_map.
by rewrite (nth_map 0%N) // restrict_range.
Qed.

Lemma lookup_ff (row : nat -> sparse_row) i k : (i < nf)%N -> (k < nf)%N ->
  lookup (nth [::] (ff_block Q row) i) k = lookup (row (free_at i)) (free_at k).
Proof. by move=> Hi Hk; rewrite (nth_map 0%N) // lookup_restrict. Qed.

Lemma value_residual Y X d k j : (k < nf)%N ->
  value (residual_series a (ff_block Q (row_0 Q a)) (ff_block Q (row_1 Q a)) Y X) d k j =
  toR (anchor_unit a) * value Y d k j - \sum_(m <- fi) F_at d k m * value X d m j.
Proof.
move=> Hk; rewrite /residual_series value_add !value_scale value_add value_shift.
rewrite !(value_product (n := nf)) ?ff_range // -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r.
congr (_ - _); rewrite mulr_sumr -big_split; apply: sum_eq => m /=.
rewrite mem_iota add0n => /andP[_ Hm]; rewrite !lookup_ff // /F_at /shifted_entry.
by rewrite mulrDl mulrA.
Qed.

Variable fam : anchor_family.
Hypothesis expanded : expand Q a = Some fam.

Notation l_series := (residual_left Q a).
Notation r_series := (residual_right Q a).

Lemma expand_parts :
  [/\ 0 < toR q :> R, 0 < toR (anchor_unit a) :> R,
      forall i, (i < ns)%N -> 0 < toR (nth 0%Z (anchor_scale a) i) :> R &
      [/\ small Q (anchor_left a), small Q l_series, small Q r_series &
          fam = expand_from Q a (ff_block Q (row_1 Q a)) l_series r_series]].
Proof.
move: expanded; rewrite /expand; case: ifP => // /and5P[q0 u0 /allP s0 sa /andP[sl sr]] [<-].
split; rewrite ?toR_gt0 // => i Hi; rewrite toR_gt0; apply: s0; rewrite mem_iota; exact: Hi.
Qed.

Variables (low_a low_b : form_bound).
Hypothesis bounded_a : bounded_rows nf (ff_block Q (row_a Q)) low_a.
Hypothesis bounded_b : bounded_rows nf (ff_block Q (row_b Q)) low_b.

Lemma in_free i : i \in fi -> (i < nf)%N.
Proof. by rewrite mem_iota. Qed.

Lemma F_symmetric d : symmetric_on nf (F_at d).
Proof.
move=> i k /in_free Hi /in_free Hk; rewrite /F_at /shifted_entry /row_0 /row_1.
rewrite !lookup_cat !lookup_times !toRD !toRM -!lookup_ff //.
by rewrite (bounded_lookup_sym bounded_a Hi Hk) (bounded_lookup_sym bounded_b Hi Hk).
Qed.

Lemma F1_symmetric :
  symmetric_on nf (fun i k => toR (lookup (row_1 Q a (free_at i)) (free_at k)) : R).
Proof.
move=> i k /in_free Hi /in_free Hk; rewrite /row_1 !lookup_times !toRM -!lookup_ff //.
by rewrite (bounded_lookup_sym bounded_b Hi Hk).
Qed.

(* q (sigma + lo tau) *)
Lemma F_below d t lo : toR q * t = toR p + toR q * d -> 0 <= lo -> lo <= t ->
  bounded_below nf (F_at d) (toR q * (toR (bound_at low_a) / toR (bound_times low_a) +
                                      lo * (toR (bound_at low_b) / toR (bound_times low_b)))).
Proof.
move=> td lo0 lo_t z; have [q0 _ _ _] := expand_parts.
have [ca0 da0] := (bound_times_gt0 R bounded_a, bound_at_ge0 R bounded_a).
have [cb0 db0] := (bound_times_gt0 R bounded_b, bound_at_ge0 R bounded_b).
have := bounded_rows_sound bounded_a z; have := bounded_rows_sound bounded_b z.
set S := \sum_(k <- fi) _; have S0 : 0 <= S by apply: squares_ge0.
set form_b := \sum_(i <- fi) _; set form_a := \sum_(i <- fi) _ => below_b below_a.
have -> : \sum_(i <- fi) \sum_(k <- fi) z i * F_at d i k * z k =
          toR q * (form_a + t * form_b).
  rewrite mulrDr !mulr_sumr -big_split; apply: sum_eq => i /in_free Hi /=.
  rewrite !mulr_sumr -big_split; apply: sum_eq => k /in_free Hk /=.
  rewrite /F_at (shifted_entryE _ _ td) !lookup_ff // /a_entry /b_entry.
  by move: (toR _) (toR _) (z i) (z k) (toR q) => *; ring.
rewrite -mulrA ler_pmul2l // mulrDl; apply: ler_add.
  by rewrite mulrAC ler_pdivr_mulr // [form_a * _]mulrC.
apply: (@le_trans _ _ (lo * form_b)).
  by rewrite -mulrA ler_wpmul2l // mulrAC ler_pdivr_mulr // [form_b * _]mulrC.
apply: ler_wpmul2r => //.
by rewrite -(pmulr_rge0 _ cb0); apply: le_trans below_b; rewrite mulr_ge0.
Qed.

Lemma drift_ge0 : 0 <= toR (drift fam) :> R.
Proof.
have [_ _ _ [_ _ _ ->]] := expand_parts; rewrite /expand_from /= toR_ge0.
elim: [seq row_sum row | row <- _] => //= x l; clear; lia.
Qed.

Lemma row_sum_bound n row : all (fun e => e.1 < n)%N row ->
  \sum_(k <- iota 0 n) `|toR (lookup row k)| <= toR (row_sum row) :> R.
Proof.
elim: row => [_|e row IH /andP[lt_e range]].
  by rewrite /= sum_zero // => k _; rewrite normr0.
rewrite /= toRD toR_abs; apply: (@le_trans _ _ (\sum_(k <- iota 0 n)
    ((if e.1 == k then `|toR e.2| else 0) + `|toR (lookup row k)|))).
  apply: sum_le => k _; case: eqP => _; last by rewrite add0r.
  by rewrite toRD ler_norm_add.
rewrite big_split /= ler_add ?IH // (bigD1_seq e.1) ?iota_uniq ?mem_iota //= eqxx.
by rewrite big1 ?addr0 // => k /negbTE; rewrite eq_sym => ->.
Qed.

Lemma drift_bound i : i \in fi ->
  \sum_(k <- fi) `|toR (lookup (row_1 Q a (free_at i)) (free_at k))| <= toR (drift fam) :> R.
Proof.
move=> /in_free Hi; have [_ _ _ [_ _ _ ->]] := expand_parts; rewrite /expand_from /=.
have -> : \sum_(k <- fi) `|toR (lookup (row_1 Q a (free_at i)) (free_at k))| =
          \sum_(k <- fi) `|toR (lookup (nth [::] (ff_block Q (row_1 Q a)) i) k)| :> R.
  by apply: sum_eq => k /in_free Hk; rewrite lookup_ff.
apply: le_trans (row_sum_bound (ff_range _ _)) _; rewrite toR_le.
have : nth [::] (ff_block Q (row_1 Q a)) i \in ff_block Q (row_1 Q a).
  by rewrite mem_nth // size_map.
move: (ff_block Q (row_1 Q a)) => L; move: (nth _ L i) => x.
elim: L => //= row rows IH; rewrite inE.
case/orP=> [/eqP->|/IH]; move: (foldr _ _ _) (row_sum _) => m y; first by clear; lia.
by move: (row_sum row) => y'; clear; lia.
Qed.

(* The exact identity, in integers. *)
Lemma family_identity d s i j : 0 < s -> bounded_below nf (F_at d) s ->
  (i < ns)%N -> (j < ns)%N ->
  toR (anchor_unit a) ^+ 2 * condensed_family d i j =
  value (series_z fam) d i j -
  \sum_(k <- fi) value l_series d k i * solve nf (F_at d) (fun k => value r_series d k j) k.
Proof.
move=> s0 below Hi Hj; have [q0 u0 _ [sa _ _ ->]] := expand_parts.
set u := toR (anchor_unit a).
pose W := value (anchor_right a) d; pose V := value (anchor_left a) d.
have rE k : k \in fi -> value r_series d k j = residual_r nf (F_at d) (G_at d) u W j k.
  by move=> /in_free Hk; rewrite /residual_right value_residual // value_fs.
have lE k : k \in fi -> value l_series d k i = residual_l nf (F_at d) (H_at d) u V i k.
  by move=> /in_free Hk; rewrite /residual_left value_residual // value_sf.

rewrite /condensed_family (condensed_residual s0 (F_symmetric d) below _ _ _ u W V).
congr (_ - _); last by apply: sum_eq => k Hk; rewrite lE // (solve_ext _ rE).
rewrite /expand_from /= /center_series value_add !value_scale value_add value_scale.
have small_h : small Q [:: sf_block Q (row_0 Q a); sf_block Q (row_1 Q a)].
  by rewrite /small /= !size_map leqnn.
rewrite !(value_cross (m := nf)) // value_ss // toRM -/u -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r.
rewrite /approximate -expr2 opprD addrA; congr (_ - _ * _ - _).
  by apply: sum_eq => k /in_free Hk; rewrite value_sf.
by apply: sum_eq => k Hk; rewrite rE.
Qed.

End Expand.
