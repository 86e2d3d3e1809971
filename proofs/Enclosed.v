(* A pencil known up to radii, and its solutions.

   The leaves of a cover speak of a pencil T(t) = A + t B over the n complementarity variables.
   The checker does not know A and B exactly: it has integer matrices of centers and of radii,

       |A_ij - center_a_ij| <= radius_a_ij,     |B_ij - center_b_ij| <= radius_b_ij,

   all in one unit.  Without free variables the radii are 0; with free variables A + t B is the
   condensed pencil of Condensation.v.

   A solution is a value t >= 0 and a vector x != 0 with 0 <= x _|_ T(t) x >= 0.

   The end of an interval is a point (p, q), and T_end (p, q) = q A + p B.  So T(t) = T_end (t, 1),
   and the direction at infinity is T_end (1, 0) = B.  For t between two ends T(t) is a combination
   of both matrices T_end with weights >= 0 (lemma [T_between]): one proof for finite and infinite
   ends.

   For a second parameter mu between two values the matrix at t is a combination a T + b T' of those
   at these values, with weights that are not negative and not both 0, and so are its images.  A
   *box solution* is a vector x != 0 with 0 <= x _|_ a T x + b T' x >= 0.  A solution is one with
   a = 1 and b = 0 ([solves_box]).

   Page: spec/certificates.md, 5.1 and 5.7.
   Rust: crates/check/src/cover/family.rs, ends.rs. *)

From Mceip Require Import Base Integers Sums Tree.

Record enclosed := Enclosed {
  size_of : nat;
  center_a : matrix;
  center_b : matrix;
  radius_a : matrix;
  radius_b : matrix }.

Definition indices (P : enclosed) := iota 0 (size_of P).

Definition center (P : enclosed) (e : point) i j : Z :=
  (e.2 * entry (center_a P) i j + e.1 * entry (center_b P) i j)%Z.

Definition radius (P : enclosed) (e : point) i j : Z :=
  (e.2 * entry (radius_a P) i j + e.1 * entry (radius_b P) i j)%Z.

Section Pencil.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).

Definition encloses := forall i j, i \in indices P -> j \in indices P ->
  `|A i j - toR (entry (center_a P) i j)| <= toR (entry (radius_a P) i j) /\
  `|B i j - toR (entry (center_b P) i j)| <= toR (entry (radius_b P) i j).

Definition T (t : R) i j := A i j + t * B i j.

Definition image t (x : nat -> R) i := \sum_(j <- indices P) T t i j * x j.

Definition solves t (x : nat -> R) :=
  [/\ 0 <= t, exists2 i, i \in indices P & x i != 0 &
      forall i, i \in indices P -> [/\ 0 <= x i, 0 <= image t x i & x i * image t x i = 0]].

Definition T_end (e : point) i j := toR e.2 * A i j + toR e.1 * B i j.

Lemma T_end_enclosed e i j : encloses -> i \in indices P -> j \in indices P ->
  0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  `|T_end e i j - toR (center P e i j)| <= toR (radius P e i j).
Proof.
move=> E Hi Hj p q; have [near_a near_b] := E _ _ Hi Hj.
rewrite /center /radius !toRD !toRM.

rewrite (_ : T_end e i j - _ = toR e.2 * (A i j - toR (entry (center_a P) i j)) +
                               toR e.1 * (B i j - toR (entry (center_b P) i j))); last first.
  by rewrite /T_end !mulrBr opprD addrACA.
rewrite (le_trans (ler_norm_add _ _)) // !normrM (ger0_norm p) (ger0_norm q).
by rewrite ler_add // ler_wpmul2l.
Qed.

Lemma T_between lo hi t : ordered lo hi -> between t lo hi ->
  exists a b, [/\ 0 <= a, 0 <= b, forall i j, T t i j = a * T_end lo i j + b * T_end hi i j &
                  (0 < a \/ 0 < b) /\ (hi.2 = 0%Z -> 0 < a)].
Proof.
move=> O W; have [a [b [a0 b0 [one val] pos]]] := weights_of_ends O W.
exists a, b; split=> // i j.
by rewrite /T /T_end -{1}[A i j]mul1r -one -{1}val !mulrDr !mulrDl !mulrA addrACA.
Qed.

Lemma solution_ge0 t x : solves t x -> forall i, (i < size_of P)%N -> 0 <= x i.
Proof. by case=> _ _ H i lt_i; have [] := H i; rewrite // mem_iota. Qed.

Lemma agrees_at r (x : nat -> R) i : agrees (size_of P) r x -> i \in indices P ->
  match state_of r i with Open => True | Resting => x i = 0 | Moving => 0 < x i end.
Proof. by move=> ag; rewrite mem_iota add0n => /= lt_i; apply: ag. Qed.

End Pencil.

Notation in_region_of P := (in_region (size_of P)).

Lemma same_indices P P' : size_of P' = size_of P -> indices P' = indices P.
Proof. by rewrite /indices => ->. Qed.

(* A combination of the images of two pencils of one order, with weights a and b. *)
Section Box.

Variable R : realFieldType.
Variables (P P' : enclosed) (A B A' B' : nat -> nat -> R) (t a b : R) (x : nat -> R).

Definition box_image i := a * image P A B t x i + b * image P' A' B' t x i.

Definition box_solution :=
  (exists2 i, i \in indices P & x i != 0) /\
  forall i, i \in indices P -> [/\ 0 <= x i, 0 <= box_image i & x i * box_image i = 0].

End Box.

Lemma solves_box (R : realFieldType) P (A B : nat -> nat -> R) t x :
  solves P A B t x -> box_solution P P A B A B t 1 0 x.
Proof. by case=> _ nonzero rows; split=> // i /rows; rewrite /box_image mul1r mul0r addr0. Qed.
