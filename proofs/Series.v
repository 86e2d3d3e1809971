(* Polynomials whose coefficients are matrices, and their values over an interval.

   A series is a list of integer matrices, constant term first; [value L d i j] is the entry (i, j)
   of its value at d.  Sums, multiples, products with sparse rows and products X(d)' Y(d) of series
   have the values that their names say.  [norms] bounds the Euclidean norms of the columns of the
   coefficients; so the norm of a column of the value at d is at most the value of these bounds at
   |d| ([series_norm]), and the difference of two values is (d - d') times a vector whose norm is at
   most the value of the derivative of the bounds ([series_difference]).

   For a polynomial c(u) over 0 <= u <= 1 let

       chord(c) = c(1) - c(0),     spread(c) = sum_(k >= 2) (k - 1) |c_k|.

   Then c(u) is within spread/4 of c(0) + u chord ([near_chord_poly]), and c(u) - c(u') is
   (u - u') (chord + q) with |q| <= 2 spread ([chord_difference]).

   Page: spec/certificates.md, 5.14.  Rust: crates/check/src/cover/expanded.rs. *)

From Mceip Require Import Base Integers Sums Covered Condensation Norms Claim.

Section Lists.

Variables (T : Type) (add : T -> T -> T).

Fixpoint add_lists (p q : seq T) : seq T :=
  match p, q with
  | a :: p', b :: q' => add a b :: add_lists p' q'
  | [::], _ => q
  | _, [::] => p
  end.

Lemma nth_add_lists (d : T) : (forall x, add d x = x) -> (forall x, add x d = x) ->
  forall p q k, nth d (add_lists p q) k = add (nth d p k) (nth d q k).
Proof.
move=> addl addr; elim=> [|a p IH] [|b q] [|k] //=; rewrite ?addl ?addr ?nth_nil ?addl ?addr //.
Qed.

End Lists.

Section Checker.

Local Open Scope Z_scope.

Definition add_matrix : matrix -> matrix -> matrix := add_lists add_poly.
Definition add_series : seq matrix -> seq matrix -> seq matrix := add_lists add_matrix.

Definition scale_series c (L : seq matrix) : seq matrix :=
  [seq [seq scale_poly c row | row <- M] | M <- L].

Definition product (rows : seq sparse_row) (X : matrix) : matrix :=
  [seq combine_row X row | row <- rows].

Definition product_series rows (L : seq matrix) := [seq product rows X | X <- L].

Definition column_of (X : matrix) j : seq Z := [seq nth 0 row j | row <- X].

Definition columns_of n (X : matrix) := [seq column_of X j | j <- iota 0 n].

Definition cross (cx cy : matrix) : matrix := [seq [seq dot a b | b <- cy] | a <- cx].

(* X' Y, both with n columns. *)
Definition cross_series n (X Y : seq matrix) : seq matrix :=
  let cys := [seq columns_of n M | M <- Y] in
  foldr (fun M s => let cx := columns_of n M in
           add_series [seq cross cx cy | cy <- cys] ([::] :: s)) [::] X.

Definition squares (x : seq Z) : Z := foldr (fun a s => a * a + s) 0 x.

(* A number whose square is more than x >= 0: below 2^256 the least one, above it the double of one
   for x / 4.  The digits say how often to divide; half as many as x has suffice. *)
Definition root_bits : Z := let square a := a * a in square (square (square (square (square 256)))).

Definition refined x s := if (x <? root_bits) && (x <? (s - 1) * (s - 1)) then s - 1 else s.

Fixpoint root_above (digits : positive) (x : Z) : Z :=
  match digits with
  | xI d | xO d => refined x (2 * root_above d (x / 4))
  | xH => x + 1
  end.

(* A number whose square is at least x. *)
Definition root_up (x : Z) : Z := if x is Zpos p then root_above p (x - 1) else 0.

Definition norm2 x := root_up (squares x).

Definition norms (L : seq matrix) j : polynomial := [seq norm2 (column_of M j) | M <- L].

Fixpoint derivative (p : polynomial) : polynomial :=
  if p is _ :: p' then add_poly p' (0 :: derivative p') else [::].

(* The value at x / y times a power of y, and that power. *)
Definition homogeneous x y (p : polynomial) : Z * Z :=
  foldr (fun c s => let power := s.2 * y in (c * power + x * s.1, power)) (0, 1) p.

(* The same for the value at (x + u v) / y, as a polynomial in u. *)
Definition substituted x v y (p : polynomial) : polynomial * Z :=
  foldr (fun c s => let power := s.2 * y in
           (add_poly [:: c * power] (add_poly (scale_poly x s.1) (0 :: scale_poly v s.1)), power))
    ([::], 1) p.

Fixpoint spread_of (p : polynomial) : Z :=
  if p is _ :: p' then norm1 p' + spread_of p' else 0.

Definition total (p : polynomial) : Z := foldr Z.add 0 p.
Definition constant_of (p : polynomial) : Z := nth 0 p 0.
Definition chord_of (p : polynomial) : Z := total (behead p).
Definition spread (p : polynomial) : Z := spread_of (behead p).

Definition poly_of (L : seq matrix) i j : polynomial := [seq entry M i j | M <- L].

End Checker.

Lemma nth_add_poly p q k : nth 0%Z (add_poly p q) k = (nth 0%Z p k + nth 0%Z q k)%Z.
Proof. by elim: p q k => [|a p IH] [|b q] [|k] //=; rewrite ?nth_nil ?Z.add_0_r. Qed.

Lemma nth_scale_poly c p k : nth 0%Z (scale_poly c p) k = (c * nth 0%Z p k)%Z.
Proof.
have [l|l] := ltnP k (size p); first by rewrite (nth_map 0%Z).
by rewrite !nth_default ?size_map // Z.mul_0_r.
Qed.

Lemma entry_add X Y i j : entry (add_matrix X Y) i j = (entry X i j + entry Y i j)%Z.
Proof.
rewrite /entry /add_matrix (@nth_add_lists _ _ [::]) ?nth_add_poly //.
by case.
Qed.

Lemma poly_of_add X Y i j : poly_of (add_series X Y) i j = add_poly (poly_of X i j) (poly_of Y i j).
Proof. by elim: X Y => [|A X IH] [|B Y] //=; rewrite entry_add IH. Qed.

Lemma scale_entry c (M : matrix) i j :
  entry [seq scale_poly c row | row <- M] i j = (c * entry M i j)%Z.
Proof.
rewrite /entry; have [l|l] := ltnP i (size M); first by rewrite (nth_map [::]) ?nth_scale_poly.
by rewrite !nth_default ?size_map // Z.mul_0_r.
Qed.

Lemma poly_of_scale c L i j : poly_of (scale_series c L) i j = scale_poly c (poly_of L i j).
Proof. by elim: L => //= M L IH; rewrite scale_entry IH. Qed.

Lemma nth_column (X : matrix) j k : nth 0%Z (column_of X j) k = entry X k j.
Proof.
rewrite /entry /column_of; have [l|l] := ltnP k (size X); first by rewrite (nth_map [::]).
by rewrite !nth_default ?size_map.
Qed.

Lemma size_column (X : matrix) j : size (column_of X j) = size X.
Proof. exact: size_map. Qed.

Section Values.

Variable R : rcfType.
Implicit Types (d u : R) (p : polynomial).

Definition value (L : seq matrix) d i j := eval (poly_of L i j) d.

Lemma value_nil d i j : value [::] d i j = 0.
Proof. by []. Qed.

Lemma value_cons M L d i j : value (M :: L) d i j = toR (entry M i j) + d * value L d i j.
Proof. by []. Qed.

Lemma value_add X Y d i j : value (add_series X Y) d i j = value X d i j + value Y d i j.
Proof. by rewrite /value poly_of_add eval_add. Qed.

Lemma value_scale c L d i j : value (scale_series c L) d i j = toR c * value L d i j.
Proof. by rewrite /value poly_of_scale eval_scale. Qed.

Lemma entry_nil i j : entry [::] i j = 0%Z.
Proof. by rewrite /entry nth_nil nth_nil. Qed.

Lemma value_shift L d i j : value ([::] :: L) d i j = d * value L d i j.
Proof. by rewrite value_cons entry_nil toR0 add0r. Qed.

Lemma entry_product n rows X i j : all (fun e => e.1 < n)%N (nth [::] rows i) ->
  toR (entry (product rows X) i j) =
  \sum_(k <- iota 0 n) toR (lookup (nth [::] rows i) k) * toR (entry X k j) :> R.
Proof.
move=> range; rewrite /entry /product; have [l|l] := ltnP i (size rows); last first.
  rewrite !nth_default ?size_map //= sum_zero // => k _.
  by rewrite toR0 mul0r.
rewrite (nth_map [::]) // (sum_lookup (fun k => toR (nth 0%Z (nth [::] X k) j)) range).
exact: nth_combine_row.
Qed.

Lemma value_product n rows L d i j : all (fun e => e.1 < n)%N (nth [::] rows i) ->
  value (product_series rows L) d i j =
  \sum_(k <- iota 0 n) toR (lookup (nth [::] rows i) k) * value L d k j.
Proof.
move=> range; elim: L => [|M L IH].
  by rewrite sum_zero // => k _; rewrite value_nil mulr0.
rewrite [LHS]value_cons IH (entry_product _ _ range) mulr_sumr -big_split /=.
by apply: eq_bigr => k _; rewrite value_cons mulrDr [d * _]mulrCA.
Qed.

Lemma entry_cross m n (X Y : matrix) i j : (size X <= m)%N -> (i < n)%N -> (j < n)%N ->
  toR (entry (cross (columns_of n X) (columns_of n Y)) i j) =
  \sum_(k <- iota 0 m) toR (entry X k i) * toR (entry Y k j) :> R.
Proof.
move=> sX lt_i lt_j; rewrite /entry /cross (nth_map [::]) ?size_map ?size_iota //.
rewrite (nth_map [::]) ?size_map ?size_iota // !(nth_map 0%N) ?size_iota // !nth_iota //.
rewrite (@toR_dot R m) ?size_column //; apply: eq_bigr => k _.
by rewrite !add0n !nth_column.
Qed.

Lemma value_cross m n X Y d i j : all (fun M => size M <= m)%N X -> (i < n)%N -> (j < n)%N ->
  value (cross_series n X Y) d i j = \sum_(k <- iota 0 m) value X d k i * value Y d k j.
Proof.
move=> + lt_i lt_j; elim: X => [_|M X IH /andP[sM sX]].
  by rewrite sum_zero // => k _; rewrite value_nil mul0r.
rewrite /cross_series /= -/(cross_series n X Y) value_add value_shift IH //.
have -> : value [seq cross (columns_of n M) cy | cy <- [seq columns_of n M | M <- Y]] d i j =
          \sum_(k <- iota 0 m) toR (entry M k i) * value Y d k j.
  elim: Y {IH} => [|N Y IH]; first by rewrite sum_zero // => k _; rewrite value_nil mulr0.
  rewrite [LHS]value_cons IH (entry_cross _ sM) // mulr_sumr -big_split /=.
  by apply: eq_bigr => k _; rewrite value_cons mulrDr [d * _]mulrCA.
rewrite mulr_sumr -big_split /=; apply: eq_bigr => k _.
by rewrite value_cons mulrDl mulrA.
Qed.

(* Norms *)
Lemma toR_squares n x : (size x <= n)%N ->
  toR (squares x) = \sum_(k <- iota 0 n) toR (nth 0%Z x k) ^+ 2 :> R.
Proof.
elim: x n => [|a x IH] n; first by move=> _; rewrite sum_zero // => k _; rewrite nth_nil expr0n.
case: n => // n sn; rewrite /= big_cons toRD toRM (IH n) // expr2; congr (_ + _).
by rewrite (sum_shift 1).
Qed.

Lemma squares_nonneg x : (0 <= squares x)%Z.
Proof. by elim: x => //= a x; clear; nia. Qed.

Lemma root_above_bound (digits : positive) x : (0 <= x)%Z ->
  (0 <= root_above digits x)%Z /\ (x < root_above digits x * root_above digits x)%Z.
Proof.
elim: digits x => [d IH|d IH|] x x0; last by rewrite /=; move: x0; clear; nia.
all: have := Z.mul_succ_div_gt x 4 erefl; have [|s0 root] := IH (x / 4)%Z; first exact: Z.div_pos.
all: move: s0 root; rewrite -[root_above _ x]/(refined x (2 * root_above d (x / 4))%Z).
all: rewrite /refined; move: (x / 4)%Z (root_above d _) => y s s0 root lead.
all: case: ifP => [/andP[_ /Z.ltb_lt]|_]; move: x0 s0 root lead; clear; nia.
Qed.

Lemma root_up_bound x : (0 <= x)%Z -> (0 <= root_up x)%Z /\ (x <= root_up x * root_up x)%Z.
Proof.
case: x => // d _; rewrite /root_up; have [|r0] := root_above_bound d (x := (Z.pos d - 1)%Z).
  by clear; lia.
by move: (root_above _ _) r0 => r; clear; lia.
Qed.

Lemma norm2_bound x : (0 <= norm2 x)%Z /\ (squares x <= norm2 x * norm2 x)%Z.
Proof. exact/root_up_bound/squares_nonneg. Qed.

Lemma column_norm n (M : matrix) j : (size M <= n)%N ->
  norm_le (iota 0 n) (fun k => toR (entry M k j)) (toR (norm2 (column_of M j)) : R).
Proof.
move=> sM; have [n0 le] := norm2_bound (column_of M j).
split; first by rewrite toR_ge0; apply/Z.leb_spec0.
under eq_bigr do rewrite -nth_column.
rewrite -toR_squares ?size_column // expr2 -toRM toR_le; exact/Z.leb_spec0.
Qed.

Lemma eval_norms_ge0 L j (d : R) : 0 <= d -> 0 <= eval (norms L j) d.
Proof.
move=> d0; elim: L => [|M L IH] //=; rewrite addr_ge0 //; last by rewrite mulr_ge0.
by have [n0 _] := norm2_bound (column_of M j); rewrite toR_ge0; apply/Z.leb_spec0.
Qed.

Lemma series_norm n L j d b : all (fun M => size M <= n)%N L -> `|d| <= b ->
  norm_le (iota 0 n) (fun k => value L d k j) (eval (norms L j) b).
Proof.
move=> + db; have b0 : 0 <= b := le_trans (normr_ge0 d) db.
elim: L => [_|M L IH /andP[sM sL]]; first exact: norm_zero.
rewrite /= -/(eval (norms L j) b).
apply: norm_ext (norm_add (column_norm j sM) (norm_weak _ (norm_scale d (IH sL)))).
  by move=> k _; rewrite value_cons.
by rewrite ler_wpmul2r // eval_norms_ge0.
Qed.

Lemma eval_derivative_cons a p (b : R) : eval (derivative (a :: p)) b =
  eval p b + b * eval (derivative p) b.
Proof. by rewrite /= eval_add /= toR0 add0r. Qed.

Lemma eval_derivative_ge0 L j (b : R) : 0 <= b -> 0 <= eval (derivative (norms L j)) b.
Proof.
move=> b0; elim: L => [|M L IH] //.
by rewrite [norms _ _]/= eval_derivative_cons addr_ge0 ?mulr_ge0 ?eval_norms_ge0.
Qed.

Lemma series_difference n L j d e b : all (fun M => size M <= n)%N L -> `|d| <= b -> `|e| <= b ->
  norm_le (iota 0 n) (fun k => slope (poly_of L k j) d e) (eval (derivative (norms L j)) b).
Proof.
move=> + db eb; have b0 : 0 <= b := le_trans (normr_ge0 d) db.
elim: L => [_|M L IH /andP[sM sL]]; first exact: norm_zero.
rewrite [norms _ _]/= eval_derivative_cons.
apply: norm_add; first exact: series_norm.
apply: norm_weak (norm_scale e (IH sL)).
by rewrite ler_wpmul2r // eval_derivative_ge0.
Qed.

(* Values at fractions *)
Lemma homogeneousE x y p (t : R) : toR x = toR y * t ->
  toR (homogeneous x y p).1 = toR (homogeneous x y p).2 * eval p t.
Proof.
move=> xE; elim: p => [|c p IH] /=; first by rewrite toR0 mulr0.
rewrite -/(eval p t) !toRD !toRM IH xE.
by move: (toR (homogeneous x y p).2) (eval p t) (toR c) (toR y) => *; ring.
Qed.

Lemma homogeneous_power x y p : 0 < toR y :> R -> 0 < toR (homogeneous x y p).2 :> R.
Proof. by move=> y0; elim: p => [|c p IH] /=; rewrite ?toR1 ?ltr01 // toRM mulr_gt0. Qed.

Lemma substituted_cons1 x v y c p : (substituted x v y (c :: p)).1 =
  add_poly [:: (c * ((substituted x v y p).2 * y))%Z]
    (add_poly (scale_poly x (substituted x v y p).1)
       (0%Z :: scale_poly v (substituted x v y p).1)).
Proof. by []. Qed.

Lemma substituted_cons2 x v y c p :
  (substituted x v y (c :: p)).2 = ((substituted x v y p).2 * y)%Z.
Proof. by []. Qed.

Lemma eval_cons c p (u : R) : eval (c :: p) u = toR c + u * eval p u.
Proof. by []. Qed.

Lemma substitutedE x v y p (t u : R) : toR x + toR v * u = toR y * t ->
  eval (substituted x v y p).1 u = toR (substituted x v y p).2 * eval p t.
Proof.
move=> xE; elim: p => [|c p IH]; first by rewrite /= mulr0.
rewrite substituted_cons1 substituted_cons2 !eval_add !eval_cons eval_scale.
rewrite eval_scale IH toR0 add0r !toRM.
set P := toR (substituted x v y p).2; set E := eval p t.
have -> : toR c * (P * toR y) + u * eval [::] u + (toR x * (P * E) + u * (toR v * (P * E))) =
          toR c * (P * toR y) + (toR x + toR v * u) * (P * E) by rewrite /=; ring.
by rewrite xE; ring.
Qed.

Lemma substituted_power x v y p : 0 < toR y :> R -> 0 < toR (substituted x v y p).2 :> R.
Proof. by move=> y0; elim: p => [|c p IH] /=; rewrite ?toR1 ?ltr01 // toRM mulr_gt0. Qed.

Lemma substituted_power_size x v y p q : size p = size q ->
  (substituted x v y p).2 = (substituted x v y q).2.
Proof. by elim: p q => [|a p IH] [|b q] //= [/IH->]. Qed.

(* Chords *)
Section Chord.

Variables (u : R).
Hypotheses (u0 : 0 <= u) (u1 : u <= 1).

Lemma eval_norm1 p : `|eval p u| <= toR (norm1 p).
Proof.
elim: p => [|a p IH] /=; first by rewrite normr0.
rewrite -/(eval p u) toRD toR_abs (le_trans (ler_norm_add _ _)) // ler_add2l normrM ger0_norm //.
by apply: (le_trans _ IH); rewrite ler_pimull.
Qed.

Lemma total_norm1 p : `|toR (total p)| <= toR (norm1 p) :> R.
Proof.
elim: p => [|a p IH] /=; first by rewrite normr0.
by rewrite !toRD toR_abs (le_trans (ler_norm_add _ _)) // ler_add2l.
Qed.

Lemma eval_total p : `|eval p u - toR (total p)| <= toR (spread_of p) /\
  `|u * (eval p u - toR (total p))| *+ 4 <= toR (spread_of p).
Proof.
elim: p => [|a p [IH1 IH2]] /=; first by rewrite subrr mulr0 normr0 mul0rn.
rewrite -/(eval p u) !toRD; set e := eval p u; set s := toR (total p).
have -> : toR a + u * e - (toR a + s) = (u - 1) * s + u * (e - s) by ring.
have v0 : 0 <= 1 - u by rewrite subr_ge0.
have vE : `|(u - 1) * s| = (1 - u) * `|s| by rewrite normrM distrC ger0_norm.
have s_le := total_norm1 p; rewrite -/s in s_le.
split.
  rewrite (le_trans (ler_norm_add _ _)) // vE ler_add //.
    by apply: le_trans s_le; rewrite ler_pimull // ler_subl_addr ler_addl.
  by rewrite normrM ger0_norm //; apply: le_trans IH1; rewrite ler_pimull.
rewrite mulrDr; apply: (@le_trans _ _ ((u * ((1 - u) * `|s|) + u * `|u * (e - s)|) *+ 4)).
  rewrite ler_muln2r /= (le_trans (ler_norm_add _ _)) // ler_add //.
    by rewrite normrM (ger0_norm u0) vE.
  by rewrite normrM (ger0_norm u0).
rewrite mulrnDl ler_add //.
  apply: le_trans s_le; rewrite mulrA -mulrnAl ler_pimull //.
  rewrite -subr_ge0 (_ : _ - _ = (1 - u *+ 2) ^+ 2) ?sqr_ge0 //; by ring.
by rewrite -mulrnAr; apply: le_trans IH2; rewrite ler_pimull // mulrn_wge0.
Qed.

Lemma near_chord_poly p :
  `|eval p u - (toR (constant_of p) + u * toR (chord_of p))| *+ 4 <= toR (spread p).
Proof.
case: p => [|a p]; first by rewrite /= toR0 mulr0 addr0 subrr normr0 mul0rn.
rewrite /spread /chord_of /constant_of /= -/(eval p u).
have -> : toR a + u * eval p u - (toR a + u * toR (total p)) = u * (eval p u - toR (total p)).
  by ring.
exact: (eval_total p).2.
Qed.

End Chord.

Lemma slope_bound p u u' : 0 <= u -> u <= 1 -> 0 <= u' -> u' <= 1 ->
  `|slope p u u'| <= toR (spread_of p).
Proof.
move=> u0 u1 v0 v1; elim: p => [|a p IH] /=; first by rewrite normr0.
rewrite toRD (le_trans (ler_norm_add _ _)) // ler_add //; first exact: eval_norm1.
by rewrite normrM ger0_norm //; apply: le_trans IH; rewrite ler_pimull.
Qed.

Lemma chord_difference p u u' : 0 <= u -> u <= 1 -> 0 <= u' -> u' <= 1 ->
  exists2 q, eval p u - eval p u' = (u - u') * (toR (chord_of p) + q) &
    `|q| <= toR (2 * spread p)%Z.
Proof.
move=> u0 u1 v0 v1; case: p => [|a p].
  by exists 0; rewrite /= ?toR0 ?addr0 ?mulr0 ?subrr ?normr0.
have twice : toR (2 * spread (a :: p))%Z = toR (spread_of p) + toR (spread_of p) :> R.
  by rewrite -toRD; congr toR; rewrite -[spread (a :: p)]/(spread_of p); clear; lia.
exists ((eval p u - toR (total p)) + u' * slope p u u').
  rewrite slopeE -[chord_of (a :: p)]/(total p).
  rewrite -[slope (a :: p) u u']/(eval p u + u' * slope p u u').
  congr (_ * _).
  by move: (toR (total p)) (eval p u) (slope _ _ _) => *; ring.
rewrite twice (le_trans (ler_norm_add _ _)) // ler_add //; first exact: (eval_total u0 u1 p).1.
rewrite normrM ger0_norm //; apply: le_trans (slope_bound p u0 u1 v0 v1).
by rewrite ler_pimull.
Qed.

End Values.
