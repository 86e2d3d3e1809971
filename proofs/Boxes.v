(* Boxes of values of t and of a second parameter mu.

   T(t, mu) is linear in t and in mu.  A *box* is a region (Tree.v), that is an interval of t with a
   state for each complementarity variable, together with an interval [low, high] of mu.

   A tree divides a box: "CutValue t" cuts the interval of t, "CutFriction m" that of mu, "Decide i"
   decides whether variable i rests or moves; a leaf is a piece of evidence about its box.

   Theorem [box_reaches_a_leaf]: if the tree is checked, each (t, mu, x) with x >= 0 in the box of
   the root lies in the box of a leaf whose evidence has been checked.

   For fixed t the matrix at mu is a combination a T(t, low) + b T(t, high) with weights that are
   not negative and not both 0, and so are its images.  A *box solution* is a vector x != 0 with
   0 <= x _|_ a T(t, low) x + b T(t, high) x >= 0.

   Theorems [box_farkas_sound], [box_definite_sound]: a vector or a sign that excludes the solutions
   of the region at low and at high alike excludes the box solutions.  [whole_image]: a leaf of the
   whole pencil (Whole.v) gives a form of one sign in x and its images, to be combined likewise.
   [mixed_encloses]: enclosures of the two parts give one of the pencil at each rational mu.

   Page: spec/certificates.md, 5.18.  Rust: crates/check/src/cover/critical.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Farkas Covered Definite Condensation Pencil.
From Mceip Require Import Whole Claim Series.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Section Tree.

Variable leaf : Type.

Inductive box_tree :=
  | CutValue of point & box_tree & box_tree
  | CutFriction of point & box_tree & box_tree
  | Decide of nat & box_tree & box_tree
  | BoxLeaf of leaf.

(* n is the number of complementarity variables; [evidence] checks a leaf. *)
Variables (n : nat) (evidence : region -> point -> point -> leaf -> bool).

Fixpoint check_boxes (tr : box_tree) (r : region) (low high : point) : bool :=
  match tr with
  | CutValue t tr1 tr2 =>
      [&& ordered (lower r) t, ordered t (upper r),
          check_boxes tr1 (below t r) low high & check_boxes tr2 (above t r) low high]
  | CutFriction m tr1 tr2 =>
      [&& ordered low m, ordered m high, check_boxes tr1 r low m & check_boxes tr2 r m high]
  | Decide i tr1 tr2 =>
      [&& (i < n)%N, check_boxes tr1 (decide i Resting r) low high &
          check_boxes tr2 (decide i Moving r) low high]
  | BoxLeaf l => [&& ordered (lower r) (upper r), ordered low high & evidence r low high l]
  end.

Theorem box_reaches_a_leaf (R : realFieldType) tr r low high (t mu : R) (x : nat -> R) :
  check_boxes tr r low high -> (forall i, (i < n)%N -> 0 <= x i) ->
  in_region n t x r -> between mu low high ->
  exists r' low' high' l, [/\ in_region n t x r', between mu low' high',
    ordered (lower r') (upper r'), ordered low' high' & evidence r' low' high' l].
Proof.
move=> + x0.
elim: tr r low high => [c tr1 IH1 tr2 IH2|c tr1 IH1 tr2 IH2|i tr1 IH1 tr2 IH2|l] r low high /=.

(* A cut: t or mu lies on one side of it. *)
- case/and4P=> _ _ c1 c2 [[lo_t t_hi] ag] m_in.
  case: (lerP (t * toR c.2) (toR c.1)) => t_c; first exact: IH1 c1 _ m_in.
  by apply: IH2 c2 _ m_in; split=> //; split=> //; apply: ltW.
- case/and4P=> _ _ c1 c2 reg [lo_m m_hi].
  case: (lerP (mu * toR c.2) (toR c.1)) => m_c; first exact: IH1 c1 reg _.
  by apply: IH2 c2 reg _; split=> //; apply: ltW.

(* Decide: x_i is zero or positive. *)
- case/and3P=> lt_i c1 c2 [bt ag] m_in; have [xi|xi] := eqVneq (x i) 0.
    by apply: IH1 c1 _ m_in; split=> //; apply: agrees_decide.
  apply: IH2 c2 _ m_in; split=> //; apply: agrees_decide => //.
  by rewrite lt_neqAle eq_sym xi x0.

(* Leaf. *)
by case/and3P=> o o' e reg m_in; exists r, low, high, l.
Qed.

End Tree.

Section Checker.

(* The enclosed pencils at both ends of the interval of mu. *)
Variables (P P' : enclosed) (r : region).

Definition strict_in_both w j := strict_column P r w j && strict_column P' r w j.

Definition box_farkas w :=
  [&& signs_of_weights P r w, columns_at_most_zero P r w, columns_at_most_zero P' r w &
      all (fun j => is_resting (state_of r j) || strict_in_both w j) (indices P)
      || has (fun j => is_moving (state_of r j) && strict_in_both w j) (indices P)].

(* One sign, factors at the four corners. *)
Definition box_definite negative (f f' : factor * factor) :=
  definite P negative r f.1 f.2 && definite P' negative r f'.1 f'.2.

End Checker.

(* q P + m P' for a value m/q. *)
Definition mixed_matrix (e : point) (M M' : matrix) : matrix :=
  add_matrix [seq scale_poly e.2 row | row <- M] [seq scale_poly e.1 row | row <- M'].

Definition mixed (e : point) (P P' : enclosed) : enclosed := Enclosed (size_of P)
  (mixed_matrix e (center_a P) (center_a P')) (mixed_matrix e (center_b P) (center_b P'))
  (mixed_matrix e (radius_a P) (radius_a P')) (mixed_matrix e (radius_b P) (radius_b P')).

(* What holds of one end. *)
Section End.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Variables (r : region) (t : R).
Hypotheses (O : ordered (lower r) (upper r)) (W : between t (lower r) (upper r)).

Section Columns.

Variable w : seq Z.
Notation weight i := (toR (nth 0%Z w i) : R).

Definition weighted_column j : R := \sum_(i <- indices P) weight i * T A B t i j.

Lemma weighted_image (x : nat -> R) :
  \sum_(i <- indices P) weight i * image P A B t x i =
  \sum_(j <- indices P) weighted_column j * x j.
Proof.
under eq_bigr do rewrite /image mulr_sumr.
rewrite exchange_big; apply: eq_bigr => j _; rewrite mulr_suml.
by apply: eq_bigr => i _; rewrite mulrA.
Qed.

Lemma column_sign j : columns_at_most_zero P r w -> j \in indices P ->
  ~~ is_resting (state_of r j) ->
  weighted_column j <= 0 /\ (strict_column P r w j -> weighted_column j < 0).
Proof.
move=> /allP columns Hj /negbTE may_move.
have [a [b [a0 b0 Tab [ab a_gt0]]]] := T_between A B O W.
have [p q p' q'] := ordered_ge0 R O.

have c_le : weighted_column j <=
    a * toR (column_bound P w (lower r) j) + b * toR (column_bound P w (upper r) j).
  apply: le_trans (ler_add (ler_wpmul2l a0 (column_bound_sound E w Hj p q))
                           (ler_wpmul2l b0 (column_bound_sound E w Hj p' q'))).
  rewrite !mulr_sumr -big_split /= le_eqVlt; apply/orP; left; apply/eqP/eq_bigr => i _.
  by rewrite Tab mulrDr !mulrA ![_ * weight _]mulrC.

have := columns _ Hj; rewrite may_move /= => /andP[l h].
have l0 : toR (column_bound P w (lower r) j) <= 0 :> R by rewrite toR_le0.
have h0 : toR (column_bound P w (upper r) j) <= 0 :> R by rewrite toR_le0.
split=> [|/andP[sl sh]]; apply: (le_trans c_le) || apply: (le_lt_trans c_le).
  by rewrite -[0]addr0 ler_add // mulr_ge0_le0.
have sl0 : toR (column_bound P w (lower r) j) < 0 :> R by rewrite toR_lt0.
have [ap|na] := boolP (0 < a); first by rewrite ltr_naddr ?mulr_ge0_le0 // pmulr_rlt0.
have bp : 0 < b by case: ab => // ap; rewrite ap in na.
rewrite ltr_naddl ?mulr_ge0_le0 // pmulr_rlt0 // toR_lt0.
by case/orP: sh => // /Z.eqb_spec z; rewrite (a_gt0 z) in na.
Qed.

End Columns.

Lemma definite_image negative low high x : definite P negative r low high ->
  (forall i, i \in indices P -> 0 <= x i) -> agrees (size_of P) r x ->
  (exists2 i, i \in indices P & x i != 0) ->
  0 < sign R negative * \sum_(i <- indices P) x i * image P A B t x i.
Proof.
move=> /andP[L H] x0 ag nonzero; have [p q p' q'] := ordered_ge0 R O.
have [a [b [a0 b0 Tab [ab a_gt0]]]] := T_between A B O W.
have [low0 low1] := definite_end_sound E x0 ag p q L.
have [high0 high1] := definite_end_sound E x0 ag p' q' H.

have -> : sign R negative * (\sum_(i <- indices P) x i * image P A B t x i) =
          a * (sign R negative * quadratic P A B x (lower r)) +
          b * (sign R negative * quadratic P A B x (upper r)).
  rewrite !(mulrCA _ (sign R negative)) -mulrDr; congr (_ * _).
  rewrite /quadratic !mulr_sumr -big_split; apply: eq_bigr => i _.
  rewrite /image !mulr_sumr -big_split; apply: eq_bigr => j _ /=; rewrite Tab.
  by move: (x i) (x j) (T_end _ _ _ _ _) (T_end _ _ _ _ _) => *; ring.

case: ab => [a_pos|b_pos].
  by apply: ltr_paddr; [apply: mulr_ge0 | apply: mulr_gt0 => //; apply: low1].
have [infinite|finite] := eqVneq (upper r).2 0%Z.
  by apply: ltr_paddr; [apply: mulr_ge0 | apply: mulr_gt0; [apply: a_gt0 | apply: low1]].
have finite' := finite_end O (elimN eqP finite).
by apply: ltr_paddl; [apply: mulr_ge0 | apply: mulr_gt0 => //; apply: high1].
Qed.

End End.

Lemma whole_image (R : rcfType) Q r w (t : R) x :
  wellformed Q -> ordered (lower r) (upper r) -> check_whole Q r w ->
  between t (lower r) (upper r) -> agrees (size (slip Q)) r (slip_of Q x) ->
  (exists2 i, i \in iota 0 (order Q) & x i != 0) ->
  0 < sign R (whole_negative w) * \sum_(i <- iota 0 (order Q))
        weight_of R (whole_weights w) i * (x i * reaction Q t x i).
Proof.
move=> wf O /andP[L H] bt ag nonzero.
have [a [b [a0 b0 [one val] [ab a_gt0]]]] := weights_of_ends O bt.
set d := whole_weights w in L H *.
have [low0 low1] := check_end_sound wf ag L.
have [high0 high1] := check_end_sound wf ag H.
set s := sign R (whole_negative w) in low0 low1 high0 high1 *.

have -> : s * (\sum_(i <- iota 0 (order Q)) weight_of R d i * (x i * reaction Q t x i)) =
          a * (s * whole_quadratic Q d x (lower r)) + b * (s * whole_quadratic Q d x (upper r)).
  rewrite !(mulrCA _ s) -mulrDr; congr (_ * _).
  rewrite /whole_quadratic !mulr_sumr -big_split; apply: eq_bigr => i _.
  rewrite /reaction !mulr_sumr -big_split; apply: eq_bigr => j _ /=.
  rewrite /end_entry -[X in X + t * _]mul1r -one -[in LHS]val.
  by move: (weight_of _ _ _) (x i) (x j) (a_entry _ _ _ _) (b_entry _ _ _ _) => *; ring.

case: ab => [a_pos|b_pos].
  by apply: ltr_paddr; [apply: mulr_ge0 | apply: mulr_gt0 => //; apply: low1].
have [infinite|finite] := eqVneq (upper r).2 0%Z.
  by apply: ltr_paddr; [apply: mulr_ge0 | apply: mulr_gt0; [apply: a_gt0 | apply: low1]].
have finite' := finite_end O (elimN eqP finite).
by apply: ltr_paddl; [apply: mulr_ge0 | apply: mulr_gt0 => //; apply: high1].
Qed.

(* Both ends together. *)
Section Box.

Variable R : realFieldType.
Variables (P P' : enclosed) (A B A' B' : nat -> nat -> R).
Hypotheses (E : encloses P A B) (E' : encloses P' A' B') (same : size_of P' = size_of P).

Variables (r : region) (t a b : R) (x : nat -> R).
Hypotheses (O : ordered (lower r) (upper r)) (W : between t (lower r) (upper r)).
Hypothesis ag : agrees (size_of P) r x.
Hypotheses (a0 : 0 <= a) (b0 : 0 <= b) (ab : 0 < a \/ 0 < b).

Definition box_image i := a * image P A B t x i + b * image P' A' B' t x i.

Definition box_solution :=
  (exists2 i, i \in indices P & x i != 0) /\
  forall i, i \in indices P -> [/\ 0 <= x i, 0 <= box_image i & x i * box_image i = 0].

Hypothesis sol : box_solution.

Lemma same_indices : indices P' = indices P.
Proof. by rewrite /indices same. Qed.

Theorem box_farkas_sound w : box_farkas P P' r w -> False.
Proof.
case/and4P=> /allP signs low high strict; have [[i0 Hi0 xi0] compl] := sol.
pose weight i : R := toR (nth 0%Z w i).
pose c j := a * weighted_column P A B t w j + b * weighted_column P' A' B' t w j.

have wy : 0 <= \sum_(i <- indices P) weight i * box_image i.
  apply: sum_ge0 => i Hi; have [x0 y0 xy] := compl _ Hi.
  have := signs _ Hi; have := agrees_at ag Hi.
  case: (state_of r i) => /=; try by move=> _ wi; rewrite mulr_ge0 // /weight toR_ge0.
  by move=> xp _; move/eqP: xy; rewrite mulf_eq0 gt_eqF //= => /eqP->; rewrite mulr0.

have wy_columns : \sum_(i <- indices P) weight i * box_image i = \sum_(j <- indices P) c j * x j.
  transitivity (a * (\sum_(i <- indices P) weight i * image P A B t x i) +
                b * (\sum_(i <- indices P) weight i * image P' A' B' t x i)).
    rewrite !mulr_sumr -big_split; apply: eq_bigr => i _ /=.
    by rewrite mulrDr !(mulrCA (weight i)).
  rewrite weighted_image -same_indices weighted_image same_indices !mulr_sumr -big_split.
  by apply: eq_bigr => j _; rewrite /c mulrDl !mulrA.

have c_sign j : j \in indices P -> ~~ is_resting (state_of r j) ->
    c j <= 0 /\ (strict_in_both P P' r w j -> c j < 0).
  move=> Hj may_move; have Hj' : j \in indices P' by rewrite same_indices.
  have [l l_strict] := column_sign E O W low Hj may_move.
  have [h h_strict] := column_sign E' O W high Hj' may_move.
  split; first by rewrite -[0]addr0 ler_add // mulr_ge0_le0.
  move=> /andP[/l_strict l1 /h_strict h1]; rewrite /c.
  by rewrite -oppr_gt0 opprD -!mulrN; apply: combination_gt0; rewrite ?oppr_gt0.

have term j : j \in indices P -> c j * x j <= 0.
  move=> Hj; have [x0 _ _] := compl _ Hj; have := agrees_at ag Hj; have := c_sign j Hj.
  case: (state_of r j) => /= [/(_ isT)[cj _] _|_ ->|/(_ isT)[cj _] _]; last 1 first.
  - exact: mulr_le0_ge0.
  - exact: mulr_le0_ge0.
  by rewrite mulr0.

have strict_term j : j \in indices P -> 0 < x j -> strict_in_both P P' r w j -> c j * x j < 0.
  move=> Hj xj sj; have := agrees_at ag Hj; have := c_sign j Hj; rewrite pmulr_llt0 //.
  case: (state_of r j) => /= [/(_ isT)[_ cj] _|_ z|/(_ isT)[_ cj] _]; try exact: cj.
  by rewrite z ltxx in xj.

suff : \sum_(j <- indices P) c j * x j < 0 by rewrite -wy_columns ltNge wy.
apply: sum_lt0 => //; case/orP: strict => [/allP every|/hasP[j Hj /andP[moving sj]]].
  have [x0 _ _] := compl _ Hi0.
  exists i0 => //; apply: strict_term => //; first by rewrite lt_neqAle eq_sym xi0.
  have := every _ Hi0; have := agrees_at ag Hi0.
  by case: (state_of r i0) => //= z; rewrite z eqxx in xi0.
exists j => //; apply: strict_term => //; have := agrees_at ag Hj.
by move: moving; case: (state_of r j).
Qed.

Theorem box_definite_sound negative f f' : box_definite P P' r negative f f' -> False.
Proof.
case/andP=> low high; have [nonzero compl] := sol.
have x0 i : i \in indices P -> 0 <= x i by case/compl.
have l := definite_image E O W low x0 ag nonzero.
have h : 0 < sign R negative * \sum_(i <- indices P) x i * image P' A' B' t x i.
  by rewrite -same_indices; apply: (definite_image E' O W high);
     rewrite ?same_indices ?same.
have pos := combination_gt0 a0 b0 ab l h.
suff zero : a * (sign R negative * \sum_(i <- indices P) x i * image P A B t x i) +
            b * (sign R negative * \sum_(i <- indices P) x i * image P' A' B' t x i) = 0.
  by rewrite zero ltxx in pos.
rewrite !(mulrCA _ (sign R negative)) -mulrDr !mulr_sumr -big_split /= sum_zero ?mulr0 // => i Hi.
by rewrite !(mulrCA _ (x i)) -mulrDr; case: (compl i Hi).
Qed.

End Box.

(* Enclosures of two parts enclose their combinations. *)
Lemma entry_mixed e M M' i j :
  entry (mixed_matrix e M M') i j = (e.2 * entry M i j + e.1 * entry M' i j)%Z.
Proof. by rewrite /mixed_matrix entry_add !entry_scale. Qed.

Lemma mixed_encloses (R : realFieldType) e P P' (A B A' B' : nat -> nat -> R) :
  encloses P A B -> encloses P' A' B' -> size_of P' = size_of P ->
  0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  encloses (mixed e P P') (fun i j => toR e.2 * A i j + toR e.1 * A' i j)
    (fun i j => toR e.2 * B i j + toR e.1 * B' i j).
Proof.
move=> E E' same e1 e2 i j Hi Hj.
have [na nb] := E i j Hi Hj; have [||na' nb'] := E' i j; rewrite /indices ?same //.
have near (p q u v c d : R) : `|u - p| <= c -> `|v - q| <= d ->
    `|toR e.2 * u + toR e.1 * v - (toR e.2 * p + toR e.1 * q)| <= toR e.2 * c + toR e.1 * d.
  move=> up vq; rewrite opprD addrACA -!mulrBr (le_trans (ler_norm_add _ _)) //.
  by rewrite !normrM (ger0_norm e1) (ger0_norm e2) ler_add // ler_wpmul2l.
by rewrite /mixed /= !entry_mixed !toRD !toRM; split; apply: near.
Qed.
