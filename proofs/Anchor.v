(* Condensation about an anchor, for pencils whose free rows depend on t.

   The pencil is A + t B = (A_0 + d A_1) / q with d = t - p/q; p/q is the *center* of the anchor and
   A_0 = q A + p B, A_1 = q B are integer matrices.  In blocks, f for the free variables:

       F(d) = A_0,ff + d A_1,ff,   G(d) in the free rows,   H(d), D(d) in the other rows.

   The anchor gives series W(d) and V(d) of integer matrices that approximate u F^-1 G and
   u F'^-1 H'.  With r = u G - F W and l = u H' - F' V, series as well,

       u^2 (D - H F^-1 G) = Z - l' F^-1 r,      Z = u^2 D - u H W - V' r.

   z'F(d)z >= q (sigma + t tau) z'z is shown by factors of the symmetric parts of A_ff and B_ff
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

(* Z, bounds of the norms of l and r, and of the sums of rows and columns of A_1,ff; how far Z of a
   member may be from it. *)
Record anchor_family := AnchorFamily {
  series_z : seq matrix;
  left_norms : seq polynomial;
  right_norms : seq polynomial;
  drift : Z;
  spread_z : seq matrix }.

(* An entry of a local pencil: centers and radii at 0 and of the slope. *)
Record local_entry := LocalEntry {
  local_a : Z;
  local_b : Z;
  local_ra : Z;
  local_rb : Z }.

(* What is shown of a region with an anchor. *)
Inductive local_leaf :=
  | LocalFarkas of seq Z
  | LocalDefinite of seq Z & factor & factor
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

(* u Y - F X, for the rows F = f_0 + d f_1; the sign is -1, and 1 where bounds of absolute values
   are put together. *)
Definition residual_series sign (f0 f1 : seq sparse_row) (Y X : seq matrix) : seq matrix :=
  add_series (scale_series (anchor_unit a) Y)
    (scale_series sign (add_series (product_series f0 X) ([::] :: product_series f1 X))).

Definition residual_right sign :=
  residual_series sign (ff_block row_0) (ff_block row_1) [:: fs_block row_0; fs_block row_1]
    (anchor_right a).
Definition residual_left sign :=
  residual_series sign (transposed (ff_block row_0)) (transposed (ff_block row_1))
    [:: sf_block row_0; sf_block row_1] (anchor_left a).

(* Z for a given r. *)
Definition center_series sign (r : seq matrix) : seq matrix :=
  let u := anchor_unit a in
  add_series (scale_series (u * u) [:: ss_block row_0; ss_block row_1])
    (scale_series sign
      (add_series
         (scale_series u (cross_series ns [:: sf_block row_0; sf_block row_1] (anchor_right a)))
         (cross_series ns (anchor_left a) r))).

Definition row_sum (row : sparse_row) := foldr (fun e s => Z.abs e.2 + s) 0 row.

Definition expand_from (sums : seq sparse_row) (l r : seq matrix) : anchor_family :=
  AnchorFamily (center_series (-1) r) [seq norms l i | i <- iota 0 ns]
    [seq norms r j | j <- iota 0 ns]
    (foldr Z.max 0 [seq row_sum row | row <- sums]) [::].

Definition small (L : seq matrix) := all (fun M => size M <= nf)%N L.

(* None if a part has not the right shape. *)
Definition expand : option anchor_family :=
  let f0 := ff_block row_0 in
  let f1 := ff_block row_1 in
  let turned := transposed f1 in
  let l := residual_series (-1) (transposed f0) turned [:: sf_block row_0; sf_block row_1]
    (anchor_left a) in
  let r := residual_series (-1) f0 f1 [:: fs_block row_0; fs_block row_1] (anchor_right a) in
  if [&& 0 <? q, 0 <? anchor_unit a, all (fun i => 0 <? nth 0 (anchor_scale a) i) (iota 0 ns),
         small (anchor_left a), small l & small r]
  then Some (expand_from (f1 ++ turned) l r) else None.

End Expansion.

(* Members of a pencil: entries within radii of its own, which are rows of integers as well. *)
Section Members.

Variables (Q : pencil) (a : anchor) (radii : seq sparse_row * seq sparse_row).

Definition radii_pencil := Pencil (order Q) radii.1 radii.2 (free Q).

Definition absolute (L : seq matrix) : seq matrix :=
  [seq [seq [seq Z.abs c | c <- row] | row <- M] | M <- L].

Definition absolute_anchor := Anchor (anchor_center a) (anchor_unit a) (absolute (anchor_right a))
  (absolute (anchor_left a)) (anchor_scale a).

(* With D = F_m - F and so on, bounds of u D_fs - D_ff W, of u D_sf' - D_ff' V, and of how far Z of
   a member may be from that of the pencil. *)
Definition widened_family (fam : anchor_family) : option anchor_family :=
  let l := residual_left radii_pencil absolute_anchor 1 in
  let r := residual_right radii_pencil absolute_anchor 1 in
  let added (n : seq polynomial) (L : seq matrix) :=
    [seq add_poly (nth [::] n i) (norms L i) | i <- iota 0 (size (slip Q))] in
  if small Q l && small Q r
  then Some (AnchorFamily (series_z fam) (added (left_norms fam) l) (added (right_norms fam) r)
               (drift fam) (center_series radii_pencil absolute_anchor 1 r))
  else None.

End Members.

(* Without radii the pencil is its only member. *)
Definition expand_member Q (radii : option (seq sparse_row * seq sparse_row)) a :=
  if expand Q a is Some fam then
    if radii is Some rad then widened_family Q a rad fam else Some fam
  else None.

(* The rows with the sums of the radii, of a row or a column, taken from the diagonal. *)
Definition lowered (rows radii : seq sparse_row) : seq sparse_row :=
  let turned := transposed radii in
  [seq (i, - Z.max (row_sum (nth [::] radii i)) (row_sum (nth [::] turned i))) :: nth [::] rows i
  | i <- iota 0 (size rows)].

Definition lowered_block Q (row : pencil -> nat -> sparse_row)
    (radii : option (seq sparse_row * seq sparse_row)) :=
  let block := ff_block Q (row Q) in
  if radii is Some rad then lowered block (ff_block Q (row (radii_pencil Q rad))) else block.

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
Definition lower_n :=
  q * (bound_at low_a * bound_times low_b * lo.2 + lo.1 * bound_at low_b * bound_times low_a).
Definition lower_d := bound_times low_a * bound_times low_b * lo.2.

Definition proper_interval :=
  [&& 0 <=? lo.1, 0 <? lo.2, 0 <? hi.2, 0 <? interval_width & 0 <? lower_n].

(* Bounds nl, nr, dl, dr: numerator and denominator. *)
Definition remainder_radius power (nl nr : Z * Z) :=
  divide_up (power * nl.1 * nr.1 * lower_d) (nl.2 * nr.2 * lower_n).

Definition remainder_slope power (nl nr dl dr : Z * Z) :=
  divide_up (power * extent * dl.1 * nr.1 * lower_d) (unit_y * dl.2 * nr.2 * lower_n) +
  divide_up (power * extent * nl.1 * dr.1 * lower_d) (unit_y * nl.2 * dr.2 * lower_n) +
  divide_up (power * extent * nl.1 * nr.1 * drift fam * lower_d * lower_d)
            (unit_y * nl.2 * nr.2 * lower_n * lower_n).

(* e bounds how far a member is from Z. *)
Definition entry_of slopes (z : polynomial) nl nr dl dr (e : Z * Z) : local_entry :=
  let c := substituted offset extent unit_y z in
  let rb := if slopes then 8 * spread c.1 + 4 * remainder_slope c.2 nl nr dl dr else 0 in
  LocalEntry (4 * constant_of c.1) (4 * chord_of c.1)
    (spread c.1 + 4 * (divide_up (c.2 * e.1) e.2 + remainder_radius c.2 nl nr) + rb) rb.

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
                 (get dl i) (get dr j) (at_reach (poly_of (spread_z fam) i j)))
       | j <- iota 0 ns] | i <- iota 0 ns].

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
  | LocalDefinite d low high => definite P d r low high
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

(* The rows of a matrix A + t B. *)
Definition member_reaction (R : rcfType) n (A B : nat -> nat -> R) t (x : nat -> R) i :=
  \sum_(j <- iota 0 n) (A i j + t * B i j) * x j.

(* The blocks of a member A + t B of the pencil. *)
Section Member.

Variables (R : rcfType) (Q : pencil) (A B : nat -> nat -> R) (a : anchor).
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
  toR q * A i j + toR p * B i j + d * (toR q * B i j).

Definition F_at d i k := shifted_entry d (free_at i) (free_at k).
Definition G_at d i j := shifted_entry d (free_at i) (slip_at j).
Definition H_at d i k := shifted_entry d (slip_at i) (free_at k).
Definition D_at d i j := shifted_entry d (slip_at i) (slip_at j).

(* The exact condensed matrix, times q. *)
Definition condensed_family d := condensed_at nf (F_at d) (G_at d) (H_at d) (D_at d).

Lemma shifted_entryE d t i j : toR q * t = toR p + toR q * d ->
  shifted_entry d i j = toR q * (A i j + t * B i j).
Proof.
move=> td; rewrite mulrDr mulrA td /shifted_entry.
by move: (A i j) (B i j) (toR p) => *; ring.
Qed.

Notation y := (member_reaction (order Q) A B).

(* Rows in terms of the blocks. *)
Lemma reaction_free_at d t x k : toR q * t = toR p + toR q * d ->
  toR q * y t x (free_at k) =
  \sum_(m <- fi) F_at d k m * free_of Q x m + \sum_(j <- si) G_at d k j * slip_of Q x j.
Proof.
move=> td; rewrite /member_reaction (sum_free_slip wf) mulrDr !mulr_sumr.
rewrite (sum_positions (free Q)) (sum_positions (slip Q)); congr (_ + _).
  by apply: eq_bigr => j _; rewrite mulrA -(shifted_entryE _ _ td).
by apply: eq_bigr => j _; rewrite mulrA -(shifted_entryE _ _ td).
Qed.

Lemma reaction_slip_at d t x i : toR q * t = toR p + toR q * d ->
  toR q * y t x (slip_at i) =
  \sum_(m <- fi) H_at d i m * free_of Q x m + \sum_(j <- si) D_at d i j * slip_of Q x j.
Proof.
move=> td; rewrite /member_reaction (sum_free_slip wf) mulrDr !mulr_sumr.
rewrite (sum_positions (free Q)) (sum_positions (slip Q)); congr (_ + _).
  by apply: eq_bigr => j _; rewrite mulrA -(shifted_entryE _ _ td).
by apply: eq_bigr => j _; rewrite mulrA -(shifted_entryE _ _ td).
Qed.

Lemma in_free i : i \in fi -> (i < nf)%N.
Proof. by rewrite mem_iota. Qed.

(* The blocks of the free variables are bounded from below. *)
Definition free_form (M : nat -> nat -> R) (z : nat -> R) :=
  \sum_(i <- fi) \sum_(k <- fi) z i * M (free_at i) (free_at k) * z k.

Definition below (low : form_bound) M := [/\ 0 < toR (bound_times low) :> R,
  0 <= toR (bound_at low) :> R & forall z, toR (bound_at low) * (\sum_(k <- fi) z k ^+ 2) <=
    toR (bound_times low) * free_form M z].

Definition free_bounded low_a low_b := below low_a A /\ below low_b B.

(* q (sigma + lo tau) *)
Lemma F_below low_a low_b d t lo : free_bounded low_a low_b -> 0 < toR q :> R ->
  toR q * t = toR p + toR q * d -> 0 <= lo -> lo <= t ->
  bounded_below nf (F_at d) (toR q * (toR (bound_at low_a) / toR (bound_times low_a) +
                                      lo * (toR (bound_at low_b) / toR (bound_times low_b)))).
Proof.
move=> [[ca0 da0 below_a] [cb0 db0 below_b]] q0 td lo0 lo_t z.
move: (below_a z) (below_b z) => {}below_a {}below_b.
set S := \sum_(k <- fi) _ in below_a below_b *; have S0 : 0 <= S by apply: squares_ge0.
have -> : \sum_(i <- fi) \sum_(k <- fi) z i * F_at d i k * z k =
          toR q * (free_form A z + t * free_form B z).
  rewrite mulrDr !mulr_sumr -big_split; apply: sum_eq => i _ /=.
  rewrite !mulr_sumr -big_split; apply: sum_eq => k _ /=.
  rewrite /F_at (shifted_entryE _ _ td).
  by move: (A _ _) (B _ _) (z i) (z k) (toR q) => *; ring.
rewrite -mulrA ler_pmul2l // mulrDl; apply: ler_add.
  by rewrite mulrAC ler_pdivr_mulr // [free_form A z * _]mulrC.
apply: (@le_trans _ _ (lo * free_form B z)).
  by rewrite -mulrA ler_wpmul2l // mulrAC ler_pdivr_mulr // [free_form B z * _]mulrC.
apply: ler_wpmul2r => //.
by rewrite -(pmulr_rge0 _ cb0); apply: le_trans below_b; rewrite mulr_ge0.
Qed.

(* W, V, the residuals and Z of the member at d. *)
Definition right_at (d : R) := value (anchor_right a) d.
Definition left_at (d : R) := value (anchor_left a) d.
Notation u := (toR (anchor_unit a) : R).

Definition r_at d j := residual_r nf (F_at d) (G_at d) u (right_at d) j.
Definition l_at d i := residual_l nf (F_at d) (H_at d) u (left_at d) i.
Definition z_at d := approximate nf (F_at d) (G_at d) (H_at d) (D_at d) u (right_at d) (left_at d).

(* What the bounds of a family say, for |d| <= b. *)
Definition family_bounds (fam : anchor_family) := forall d t b,
  toR q * t = toR p + toR q * d -> 0 <= t -> `|d| <= b ->
  forall i j, (i < ns)%N -> (j < ns)%N ->
  [/\ norm_le fi (l_at d i) (eval (nth [::] (left_norms fam) i) b),
      norm_le fi (r_at d j) (eval (nth [::] (right_norms fam) j) b) &
      `|z_at d i j - value (series_z fam) d i j| <= eval (poly_of (spread_z fam) i j) b].

(* A member over an interval. *)
Definition prepared_member fam low_a low_b lo hi :=
  [/\ wellformed Q,
      [/\ 0 < toR q :> R, 0 < u &
          forall i, (i < ns)%N -> 0 < toR (nth 0%Z (anchor_scale a) i) :> R],
      free_bounded low_a low_b, family_bounds fam & proper_interval a low_a low_b lo hi].

End Member.

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
Notation own := (shifted_entry (a_entry R Q) (b_entry R Q) a).

Lemma own_entry d i j :
  toR (lookup (row_0 Q a i) j) + d * toR (lookup (row_1 Q a i) j) = own d i j.
Proof. by rewrite /shifted_entry /row_0 /row_1 lookup_cat !lookup_times toRD !toRM. Qed.

(* The blocks of the checker. *)
Lemma entry_block (row : nat -> sparse_row) (l1 l2 : seq nat) i j :
  (i < size l1)%N -> (j < size l2)%N ->
  entry [seq [seq lookup (row m) k | k <- l2] | m <- l1] i j =
  lookup (row (nth 0%N l1 i)) (nth 0%N l2 j).
Proof. by move=> Hi Hj; rewrite /entry (nth_map 0%N) // (nth_map 0%N). Qed.

Lemma value_fs d i j : (i < nf)%N -> (j < ns)%N ->
  value [:: fs_block Q (row_0 Q a); fs_block Q (row_1 Q a)] d i j =
  own d (free_at i) (slip_at j).
Proof.
by move=> Hi Hj; rewrite !value_cons value_nil mulr0 addr0 !entry_block // own_entry.
Qed.

Lemma value_ss d i j : (i < ns)%N -> (j < ns)%N ->
  value [:: ss_block Q (row_0 Q a); ss_block Q (row_1 Q a)] d i j =
  own d (slip_at i) (slip_at j).
Proof.
by move=> Hi Hj; rewrite !value_cons value_nil mulr0 addr0 !entry_block // own_entry.
Qed.

Lemma value_sf d i k : (i < ns)%N -> (k < nf)%N ->
  value [:: sf_block Q (row_0 Q a); sf_block Q (row_1 Q a)] d k i =
  own d (slip_at i) (free_at k).
Proof.
move=> Hi Hk; rewrite !value_cons value_nil mulr0 addr0 -own_entry /entry /sf_block.
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

Lemma value_residual sign f0 f1 Y X (d : R) k j :
  (forall i, all (fun e => e.1 < nf)%N (nth [::] f0 i)) ->
  (forall i, all (fun e => e.1 < nf)%N (nth [::] f1 i)) ->
  value (residual_series a sign f0 f1 Y X) d k j = toR (anchor_unit a) * value Y d k j +
  toR sign * \sum_(m <- fi) (toR (lookup (nth [::] f0 k) m) + d * toR (lookup (nth [::] f1 k) m)) *
    value X d m j.
Proof.
move=> range0 range1; rewrite /residual_series value_add !value_scale value_add value_shift.
rewrite !(value_product (n := nf)) //; congr (_ + _ * _).
by rewrite mulr_sumr -big_split; apply: sum_eq => m _ /=; rewrite mulrDl mulrA.
Qed.

Lemma value_right sign d k j : (k < nf)%N -> (j < ns)%N ->
  value (residual_right Q a sign) d k j = toR (anchor_unit a) * own d (free_at k) (slip_at j) +
  toR sign * \sum_(m <- fi) own d (free_at k) (free_at m) * value (anchor_right a) d m j.
Proof.
move=> Hk Hj; rewrite value_residual; try exact: ff_range.
rewrite value_fs //; congr (_ + _ * _); apply: sum_eq => m; rewrite mem_iota => /= Hm.
by rewrite !lookup_ff // own_entry.
Qed.

Lemma value_left sign d k i : (k < nf)%N -> (i < ns)%N ->
  value (residual_left Q a sign) d k i = toR (anchor_unit a) * own d (slip_at i) (free_at k) +
  toR sign * \sum_(m <- fi) own d (free_at m) (free_at k) * value (anchor_left a) d m i.
Proof.
have range row m : all (fun e => e.1 < nf)%N (nth [::] (transposed (ff_block Q row)) m).
  by rewrite -[nf](size_map (fun i => restrict (places (free Q)) (row i))); apply: transposed_range.
move=> Hk Hi; rewrite value_residual; try exact: range.
rewrite value_sf //; congr (_ + _ * _); apply: sum_eq => m; rewrite mem_iota => /= Hm.
by rewrite !lookup_transposed !lookup_ff // own_entry.
Qed.

Lemma value_center sign r d i j : small Q (anchor_left a) -> (i < ns)%N -> (j < ns)%N ->
  value (center_series Q a sign r) d i j =
  toR (anchor_unit a) ^+ 2 * own d (slip_at i) (slip_at j) +
  toR sign * (toR (anchor_unit a) *
      (\sum_(k <- fi) own d (slip_at i) (free_at k) * value (anchor_right a) d k j) +
    \sum_(k <- fi) value (anchor_left a) d k i * value r d k j).
Proof.
move=> sa Hi Hj; have small_h : small Q [:: sf_block Q (row_0 Q a); sf_block Q (row_1 Q a)].
  by rewrite /small /= !size_map leqnn.
rewrite /center_series value_add !value_scale value_add value_scale.
rewrite !(value_cross (m := nf)) // value_ss // toRM -expr2; congr (_ + _ * (_ * _ + _)).
by apply: sum_eq => k; rewrite mem_iota => Hk; rewrite value_sf.
Qed.

Variable fam : anchor_family.
Hypothesis expanded : expand Q a = Some fam.

Notation l_series := (residual_left Q a (-1)).
Notation r_series := (residual_right Q a (-1)).

Lemma expand_parts :
  [/\ 0 < toR q :> R, 0 < toR (anchor_unit a) :> R,
      forall i, (i < ns)%N -> 0 < toR (nth 0%Z (anchor_scale a) i) :> R &
      [/\ small Q (anchor_left a), small Q l_series, small Q r_series &
          fam = expand_from Q a (ff_block Q (row_1 Q a) ++ transposed (ff_block Q (row_1 Q a)))
                  l_series r_series]].
Proof.
move: expanded; rewrite /expand; case: ifP => // /and5P[q0 u0 /allP s0 sa /andP[sl sr]] [<-].
split; rewrite ?toR_gt0 // => i Hi; rewrite toR_gt0; apply: s0; rewrite mem_iota; exact: Hi.
Qed.

Lemma ready_parts : [/\ 0 < toR q :> R, 0 < toR (anchor_unit a) :> R &
  forall i, (i < ns)%N -> 0 < toR (nth 0%Z (anchor_scale a) i) :> R].
Proof. by have [? ? ? _] := expand_parts. Qed.

Variables (low_a low_b : form_bound).
Hypothesis bounded_a : bounded_rows nf (ff_block Q (row_a Q)) low_a.
Hypothesis bounded_b : bounded_rows nf (ff_block Q (row_b Q)) low_b.

Lemma own_bounded : free_bounded Q (a_entry R Q) (b_entry R Q) low_a low_b.
Proof.
have low row low : bounded_rows nf (ff_block Q row) low ->
    below Q low (fun i k => toR (lookup (row i) k) : R).
  move=> bounded; split; [exact: bound_times_gt0 bounded | exact: bound_at_ge0 bounded |].
  move=> z; apply: le_trans (bounded_rows_sound bounded z) _.
  rewrite le_eqVlt; apply/orP; left; apply/eqP; congr (_ * _).
  apply: sum_eq => i /(in_free (Q := Q)) Hi; apply: sum_eq => k /(in_free (Q := Q)) Hk.
  by rewrite lookup_ff.
by split; [exact: low bounded_a | exact: low bounded_b].
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

Lemma drift_row row : row \in ff_block Q (row_1 Q a) ++ transposed (ff_block Q (row_1 Q a)) ->
  all (fun e => e.1 < nf)%N row ->
  \sum_(k <- fi) `|toR (lookup row k)| <= toR (drift fam) :> R.
Proof.
have [_ _ _ [_ _ _ ->]] := expand_parts; rewrite /expand_from /= => + range.
move=> in_rows; apply: le_trans (row_sum_bound range) _; move: in_rows; rewrite toR_le.
move: (_ ++ _) => L; elim: L {range} => //= row' rows IH; rewrite inE.
case/orP=> [/eqP->|/IH]; move: (foldr _ _ _) (row_sum _) => m y; first by clear; lia.
by move: (row_sum row') => y'; clear; lia.
Qed.

Lemma drift_bound i : i \in fi ->
  \sum_(k <- fi) `|toR (lookup (row_1 Q a (free_at i)) (free_at k))| <= toR (drift fam) :> R /\
  \sum_(k <- fi) `|toR (lookup (row_1 Q a (free_at k)) (free_at i))| <= toR (drift fam) :> R.
Proof.
move=> /(in_free (Q := Q)) Hi; have size_f : size (ff_block Q (row_1 Q a)) = nf by rewrite size_map.
split.
  rewrite (sum_eq (g := fun k => `|toR (lookup (nth [::] (ff_block Q (row_1 Q a)) i) k)|)).
    by apply: drift_row; rewrite ?ff_range // mem_cat mem_nth ?size_f.
  by move=> k /(in_free (Q := Q)) Hk; rewrite lookup_ff.
rewrite (sum_eq (g := fun k =>
    `|toR (lookup (nth [::] (transposed (ff_block Q (row_1 Q a))) i) k)|)).
  apply: drift_row; last by rewrite -size_f transposed_range.
  by rewrite mem_cat mem_nth ?orbT // (leq_trans _ (size_columns_ge _ _ _)) ?size_f.
by move=> k /(in_free (Q := Q)) Hk; rewrite lookup_transposed lookup_ff.
Qed.

(* The residuals and Z of the pencil itself. *)
Notation A := (a_entry R Q).
Notation B := (b_entry R Q).

Lemma minus_one : toR (-1) = -1 :> R.
Proof. by rewrite -[(-1)%Z]/(Z.opp 1) toRN toR1. Qed.

Lemma own_right d j k : (j < ns)%N -> k \in fi -> r_at Q A B a d j k = value r_series d k j.
Proof.
move=> Hj /(in_free (Q := Q)) Hk; rewrite value_right //.
by rewrite minus_one mulN1r.
Qed.

Lemma own_left d i k : (i < ns)%N -> k \in fi -> l_at Q A B a d i k = value l_series d k i.
Proof.
move=> Hi /(in_free (Q := Q)) Hk; rewrite value_left //.
by rewrite minus_one mulN1r.
Qed.

Lemma own_center d i j : (i < ns)%N -> (j < ns)%N ->
  z_at Q A B a d i j = value (series_z fam) d i j.
Proof.
move=> Hi Hj; have [_ _ _ [sa _ _ ->]] := expand_parts; rewrite /expand_from /= value_center //.
rewrite minus_one mulN1r opprD addrA /z_at /approximate; congr (_ - _).
by apply: sum_eq => k Hk; rewrite -own_right.
Qed.

Lemma nth_norms (L : seq matrix) i : (i < ns)%N ->
  nth [::] [seq norms L i | i <- si] i = norms L i.
Proof. by move=> Hi; rewrite (nth_map 0%N) ?size_iota // nth_iota. Qed.

Lemma own_bounds : family_bounds Q A B a fam.
Proof.
move=> d t b _ _ db i j Hi Hj; have [_ _ _ [_ sl sr famE]] := expand_parts.
rewrite own_center // subrr normr0 famE /expand_from /= !nth_norms //; split=> //.
  by apply: norm_ext (series_norm i sl db) => k Hk; rewrite own_left.
by apply: norm_ext (series_norm j sr db) => k Hk; rewrite own_right.
Qed.

End Expand.

(* The pencil is a member of itself. *)
Lemma prepared_ready (R : rcfType) Q a fam low_a low_b lo hi :
  prepared Q a fam low_a low_b lo hi ->
  prepared_member Q (a_entry R Q) (b_entry R Q) a fam low_a low_b lo hi.
Proof.
case=> wf expanded ba bb proper; split=> //.
- exact: ready_parts expanded.
- exact: own_bounded.
exact: own_bounds expanded.
Qed.

(* Members within radii. *)
Section Radii.

Variables (R : rcfType) (Q : pencil) (A B : nat -> nat -> R) (a : anchor).
Variable radii : seq sparse_row * seq sparse_row.
Hypothesis wf : wellformed Q.

Notation p := (anchor_center a).1.
Notation q := (anchor_center a).2.
Notation ns := (size (slip Q)).
Notation nf := (size (free Q)).
Notation fi := (iota 0 nf).
Notation free_at k := (nth 0%N (free Q) k).
Notation slip_at k := (nth 0%N (slip Q) k).
Notation Rd := (radii_pencil Q radii).
Notation indices := (iota 0 (order Q)).

Definition within_radii := forall i j, i \in indices -> j \in indices ->
  `|A i j - a_entry R Q i j| <= a_entry R Rd i j /\ `|B i j - b_entry R Q i j| <= b_entry R Rd i j.

Hypothesis near : within_radii.

Lemma free_in k : k \in fi -> free_at k \in indices.
Proof. by move=> /(in_free (Q := Q)) Hk; apply: (free_indices wf); apply: mem_nth. Qed.

Lemma slip_in j : (j < ns)%N -> slip_at j \in indices.
Proof. by move=> Hj; apply/slip_indices/mem_nth. Qed.

(* A sum of radii, taken from the diagonal. *)
Lemma lookup_lowered rows rad i k : (i < size rows)%N ->
  lookup (nth [::] (lowered rows rad) i) k =
  ((if i == k then - Z.max (row_sum (nth [::] rad i)) (row_sum (nth [::] (transposed rad) i))
    else 0) + lookup (nth [::] rows i) k)%Z.
Proof. by move=> Hi; rewrite (nth_map 0%N) ?size_iota // nth_iota //= add0n; case: eqP. Qed.

Lemma lowered_below low (row : pencil -> nat -> sparse_row) (M : nat -> nat -> R) :
  bounded_rows nf (lowered (ff_block Q (row Q)) (ff_block Q (row Rd))) low ->
  (forall i j, i \in indices -> j \in indices ->
     `|M i j - toR (lookup (row Q i) j)| <= toR (lookup (row Rd i) j)) ->
  below Q low M.
Proof.
move=> bounded close; split.
- exact: bound_times_gt0 bounded.
- exact: bound_at_ge0 bounded.
have c0 := bound_times_gt0 R bounded.
move=> z; apply: le_trans (bounded_rows_sound bounded z) _; rewrite ler_pmul2l //.
pose S i k : R := toR (lookup (row Q (free_at i)) (free_at k)).
pose m i k := M (free_at i) (free_at k) - S i k.
pose rows_r := ff_block Q (row Rd); have size_r : size rows_r = nf by rewrite size_map.
pose rho i : R :=
  toR (Z.max (row_sum (nth [::] rows_r i)) (row_sum (nth [::] (transposed rows_r) i))).
have rowE i : i \in fi -> \sum_(k <- fi) z i *
    toR (lookup (nth [::] (lowered (ff_block Q (row Q)) (ff_block Q (row Rd))) i) k) * z k =
    \sum_(k <- fi) z i * S i k * z k - rho i * z i ^+ 2.
  move=> Hi; have lt_i := in_free Hi; rewrite -[- _]mul1r.
  rewrite (bigD1_seq i) ?iota_uniq //= [in RHS](bigD1_seq i) ?iota_uniq //=.
  rewrite !lookup_lowered ?size_map // eqxx lookup_ff // toRD toRN -/(rho i) -/(S i i).
  rewrite mul1r addrAC; congr (_ + _); first by ring.
  rewrite big_seq_cond [RHS]big_seq_cond; apply: eq_bigr => k /andP[/(in_free (Q := Q)) lt_k].
  rewrite eq_sym => /negbTE ik; rewrite !lookup_lowered ?size_map // ik toRD toR0 add0r.
  by rewrite lookup_ff.
have m_le i k : i \in fi -> k \in fi -> `|m i k| <= `|toR (lookup (nth [::] rows_r i) k) : R|.
  move=> Hi Hk; rewrite lookup_ff ?(in_free (Q := Q)) //.
  by apply: le_trans (ler_norm _); apply: close; apply: free_in.
have sums i : i \in fi -> \sum_(k <- fi) (`|m i k| + `|m k i|) <= rho i *+ 2.
  move=> Hi; rewrite big_split mulr2n; apply: ler_add.
    apply: (@le_trans _ _ (toR (row_sum (nth [::] rows_r i)))).
      apply: le_trans (row_sum_bound R (ff_range Rd (row Rd) i)).
      by apply: sum_le => k Hk; apply: m_le.
    by rewrite toR_le; move: (row_sum _) (row_sum _) => *; clear; lia.
  have range : all (fun e => e.1 < nf)%N (nth [::] (transposed rows_r) i).
    by rewrite -size_r transposed_range.
  apply: (@le_trans _ _ (toR (row_sum (nth [::] (transposed rows_r) i)))).
    apply: le_trans (row_sum_bound R range).
    by apply: sum_le => k Hk; rewrite lookup_transposed; apply: m_le.
  by rewrite toR_le; move: (row_sum _) (row_sum _) => *; clear; lia.
have form : `|\sum_(i <- fi) \sum_(k <- fi) z i * m i k * z k| <= \sum_(i <- fi) rho i * z i ^+ 2.
  suff : `|\sum_(i <- fi) \sum_(k <- fi) z i * m i k * z k| *+ 2 <=
      (\sum_(i <- fi) rho i * z i ^+ 2) *+ 2 by rewrite ler_muln2r.
  apply: le_trans (form_by_sums _ _ _) _; rewrite -sumrMnl; apply: sum_le => i Hi.
  rewrite -mulrnAl mulrC ler_wpmul2r ?sqr_ge0 //.
  exact: sums.
rewrite (sum_eq rowE) sumrB ler_subl_addr -ler_subl_addl; apply: le_trans form.
rewrite -normrN; apply: le_trans (ler_norm _); rewrite -sumrB -sumrN.
rewrite le_eqVlt; apply/orP; left; apply/eqP; apply: eq_bigr => i _; rewrite -sumrB -sumrN.
by apply: eq_bigr => k _; rewrite /m; move: (M _ _) (S _ _) => *; ring.
Qed.

Section Bounds.

Hypotheses (q0 : 0 < toR q :> R) (u0 : 0 < toR (anchor_unit a) :> R).
Variables (d t b : R).
Hypotheses (td : toR q * t = toR p + toR q * d) (t0 : 0 <= t) (db : `|d| <= b).

Notation own := (shifted_entry (a_entry R Q) (b_entry R Q) a).
Notation far := (shifted_entry (a_entry R Rd) (b_entry R Rd) a).
Notation its := (shifted_entry A B a).
Notation u := (toR (anchor_unit a) : R).
Notation a' := (absolute_anchor a).

Lemma shifted_near i j : i \in indices -> j \in indices -> `|its d i j - own d i j| <= far b i j.
Proof.
move=> Hi Hj; have [na nb] := near Hi Hj; rewrite !(shifted_entryE _ _ _ _ td) -mulrBr normrM.
rewrite (gtr0_norm q0); apply: (@le_trans _ _ (toR q * (a_entry R Rd i j + t * b_entry R Rd i j))).
  rewrite ler_pmul2l // opprD addrACA -mulrBr (le_trans (ler_norm_add _ _)) // ler_add //.
  by rewrite normrM (ger0_norm t0) ler_wpmul2l.
have rb0 : 0 <= b_entry R Rd i j by apply: le_trans nb.
rewrite mulrDr mulrA td /shifted_entry mulrDl !addrA ler_add2l.
rewrite -mulrA mulrCA ler_wpmul2r ?mulr_ge0 ?(ltW q0) //.
exact: le_trans (ler_norm d) db.
Qed.

Lemma value_absolute L i j : `|value L d i j| <= value (absolute L) b i j.
Proof.
have b0 : 0 <= b by apply: le_trans db.
elim: L => [|M L IH]; first by rewrite value_nil normr0.
rewrite /absolute /= -/(absolute L) !value_cons (le_trans (ler_norm_add _ _)) // ler_add //.
  rewrite -toR_abs (_ : Z.abs _ = entry [seq [seq Z.abs c | c <- row] | row <- M] i j) //.
  rewrite /entry; have [lt_i|ge_i] := ltnP i (size M).
    rewrite (nth_map [::]) //; have [lt_j|ge_j] := ltnP j (size (nth [::] M i)).
      by rewrite (nth_map 0%Z).
    by rewrite !(nth_default 0%Z) ?size_map.
  by rewrite !(nth_default [::]) ?size_map // nth_nil.
by rewrite normrM ler_pmul.
Qed.

Lemma combined (l : seq nat) (f g F G : nat -> R) :
  (forall k, k \in l -> `|f k| <= F k) -> (forall k, k \in l -> `|g k| <= G k) ->
  `|\sum_(k <- l) f k * g k| <= \sum_(k <- l) F k * G k.
Proof.
move=> fF gG; apply: le_trans (sum_norm _ _) _; apply: sum_le => k Hk.
by rewrite normrM ler_pmul ?fF ?gG.
Qed.

Lemma small_absolute L : small Q L -> small Rd (absolute L).
Proof. by move/allP=> sL; apply/allP => _ /mapP[M /sL + ->]; rewrite size_map. Qed.

Lemma right_near j : (j < ns)%N -> forall k, k \in fi ->
  `|r_at Q A B a d j k - r_at Q (a_entry R Q) (b_entry R Q) a d j k| <=
  value (residual_right Rd a' 1) b k j.
Proof.
move=> Hj k Hk; have lt_k := in_free Hk; have Fk := free_in Hk; have Sj := slip_in Hj.
rewrite (value_right (Q := Rd) a' wf) // toR1 mul1r.
have -> : r_at Q A B a d j k - r_at Q (a_entry R Q) (b_entry R Q) a d j k =
    u * (G_at Q A B a d k j - G_at Q (a_entry R Q) (b_entry R Q) a d k j) -
    \sum_(m <- fi) (F_at Q A B a d k m - F_at Q (a_entry R Q) (b_entry R Q) a d k m) *
      right_at a d m j.
  rewrite /r_at /residual_r mulrBr; under [in RHS]eq_bigr do rewrite mulrBl.
  by rewrite sumrB !opprD !opprK addrACA.
rewrite (le_trans (ler_norm_sub _ _)) // ler_add //.
  by rewrite normrM (gtr0_norm u0) ler_pmul2l // shifted_near.
apply: combined => m Hm; first by apply: shifted_near => //; apply: free_in.
exact: value_absolute.
Qed.

Lemma left_near i : (i < ns)%N -> forall k, k \in fi ->
  `|l_at Q A B a d i k - l_at Q (a_entry R Q) (b_entry R Q) a d i k| <=
  value (residual_left Rd a' 1) b k i.
Proof.
move=> Hi k Hk; have lt_k := in_free Hk; have Fk := free_in Hk; have Si := slip_in Hi.
rewrite (value_left (Q := Rd) a' wf) // toR1 mul1r.
have -> : l_at Q A B a d i k - l_at Q (a_entry R Q) (b_entry R Q) a d i k =
    u * (H_at Q A B a d i k - H_at Q (a_entry R Q) (b_entry R Q) a d i k) -
    \sum_(m <- fi) (F_at Q A B a d m k - F_at Q (a_entry R Q) (b_entry R Q) a d m k) *
      left_at a d m i.
  rewrite /l_at /residual_l mulrBr; under [in RHS]eq_bigr do rewrite mulrBl.
  by rewrite sumrB !opprD !opprK addrACA.
rewrite (le_trans (ler_norm_sub _ _)) // ler_add //.
  by rewrite normrM (gtr0_norm u0) ler_pmul2l // shifted_near.
apply: combined => m Hm; first by apply: shifted_near => //; apply: free_in.
exact: value_absolute.
Qed.

Lemma center_near i j : small Q (anchor_left a) -> (i < ns)%N -> (j < ns)%N ->
  `|z_at Q A B a d i j - z_at Q (a_entry R Q) (b_entry R Q) a d i j| <=
  value (center_series Rd a' 1 (residual_right Rd a' 1)) b i j.
Proof.
move=> sa Hi Hj; have [Si Sj] := (slip_in Hi, slip_in Hj).
rewrite (@value_center R Rd a') //; last exact: small_absolute.
rewrite toR1 mul1r.
have -> : z_at Q A B a d i j - z_at Q (a_entry R Q) (b_entry R Q) a d i j =
    u ^+ 2 * (D_at Q A B a d i j - D_at Q (a_entry R Q) (b_entry R Q) a d i j) -
    (u * (\sum_(k <- fi) (H_at Q A B a d i k - H_at Q (a_entry R Q) (b_entry R Q) a d i k) *
           right_at a d k j) +
     \sum_(k <- fi) left_at a d k i *
       (r_at Q A B a d j k - r_at Q (a_entry R Q) (b_entry R Q) a d j k)).
  rewrite /z_at /approximate mulrBr; under [in RHS]eq_bigr do rewrite mulrBl.
  rewrite sumrB; under [X in _ = _ - (_ + X)]eq_bigr do rewrite mulrBr.
  rewrite sumrB /r_at; set h := \sum_(k <- fi) H_at Q A B a d i k * _.
  set h' := \sum_(k <- fi) H_at Q (a_entry R Q) _ a d i k * _.
  set v := \sum_(k <- fi) _ * residual_r _ (F_at Q A B a d) _ _ _ _ k.
  set v' := \sum_(k <- fi) _ * residual_r _ _ _ _ _ _ k.
  by move: h h' v v' => *; ring.
rewrite (le_trans (ler_norm_sub _ _)) // ler_add //.
  by rewrite normrM normrX (gtr0_norm u0) ler_pmul2l ?exprn_gt0 // shifted_near.
rewrite (le_trans (ler_norm_add _ _)) // ler_add //.
  rewrite normrM (gtr0_norm u0) ler_pmul2l //; apply: combined => k Hk.
    by apply: shifted_near => //; apply: free_in.
  exact: value_absolute.
apply: combined => k Hk; first exact: value_absolute.
exact: right_near.
Qed.

End Bounds.

Theorem member_ready fam low_a low_b lo hi : expand_member Q (Some radii) a = Some fam ->
  bounded_rows nf (lowered_block Q row_a (Some radii)) low_a ->
  bounded_rows nf (lowered_block Q row_b (Some radii)) low_b ->
  proper_interval a low_a low_b lo hi -> prepared_member Q A B a fam low_a low_b lo hi.
Proof.
rewrite /expand_member; case ex: (expand Q a) => [own|//] wide ba bb proper.
have [q0 u0 s0 [sa _ _ _]] := expand_parts R ex; split=> //.
  by split; [apply: lowered_below ba _ | apply: lowered_below bb _] => i j Hi Hj;
     have [] := near Hi Hj.
move=> d t b td t0 db i j Hi Hj; move: wide; rewrite /widened_family.
case: ifP => // /andP[sl sr] [<-] /=; have [l_own r_own z_own] := own_bounds wf ex td t0 db Hi Hj.
have b0 : `|b| <= b by rewrite ger0_norm // (le_trans _ db).
have added (n : seq polynomial) (L : seq matrix) k : (k < ns)%N ->
    nth [::] [seq add_poly (nth [::] n i) (norms L i) | i <- iota 0 ns] k =
    add_poly (nth [::] n k) (norms L k).
  by move=> Hk; rewrite (nth_map 0%N) ?size_iota // nth_iota.
rewrite !added // !eval_add; split.
- have wide := norm_dominated (left_near q0 u0 td t0 db Hi) (series_norm i sl b0).
  by apply: norm_ext (norm_add l_own wide) => k _; rewrite addrC subrK.
- have wide := norm_dominated (right_near q0 u0 td t0 db Hj) (series_norm j sr b0).
  by apply: norm_ext (norm_add r_own wide) => k _; rewrite addrC subrK.
rewrite -(own_center wf ex) //; exact: (center_near q0 u0 td t0 db).
Qed.

End Radii.
