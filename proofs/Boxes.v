(* Boxes of values of t and of a second parameter mu.

   T(t, mu) is linear in t and in mu.  A *box* is a region (Tree.v), that is an interval of t with a
   state for each complementarity variable, together with an interval [low, high] of mu.

   A tree divides a box: "CutValue t" cuts the interval of t, "CutFriction m" that of mu, "Decide i"
   decides whether variable i rests or moves; a leaf is a piece of evidence about its box.

   Theorem [box_reaches_a_leaf]: if the tree is checked, each (t, mu, x) with x >= 0 in the box of
   the root lies in the box of a leaf whose evidence has been checked.

   For fixed t the matrix at mu is a combination of those at low and at high, and a solution is a
   box solution of both (Enclosed.v).  [mixed_encloses]: enclosures of the two parts give one of the
   pencil at each rational mu.

   Page: spec/certificates.md, 5.18.  Rust: crates/check/src/cover/critical.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Claim Series.

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

(* q P + m P' for a value m/q. *)
Definition mixed_matrix (e : point) (M M' : matrix) : matrix :=
  add_matrix [seq scale_poly e.2 row | row <- M] [seq scale_poly e.1 row | row <- M'].

Definition mixed (e : point) (P P' : enclosed) : enclosed := Enclosed (size_of P)
  (mixed_matrix e (center_a P) (center_a P')) (mixed_matrix e (center_b P) (center_b P'))
  (mixed_matrix e (radius_a P) (radius_a P')) (mixed_matrix e (radius_b P) (radius_b P')).

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
