(* Boxes of values of t and of a second parameter mu.

   T(t, mu) is linear in t and in mu.  A box is a region (Tree.v), that is an interval of t with a
   state for each complementarity variable, together with an interval [low, high] of mu.

   For fixed t the matrix at mu is a combination of those at low and at high, and a solution is a
   box solution of both (Enclosed.v).  [mixed_encloses]: enclosures of the two parts give one of the
   pencil at each rational mu.

   Page: spec/certificates.md, 5.18.  Rust: crates/check/src/cover/critical.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Claim Series.

(* q P + m P' for a value m/q. *)
Definition mixed_matrix (e : point) (M M' : matrix) : matrix :=
  add_matrix [seq scale_poly e.2 row | row <- M] [seq scale_poly e.1 row | row <- M'].

Definition mixed (e : point) (P P' : enclosed) : enclosed := Enclosed (size_of P)
  (mixed_matrix e (center_a P) (center_a P')) (mixed_matrix e (center_b P) (center_b P'))
  (mixed_matrix e (radius_a P) (radius_a P')) (mixed_matrix e (radius_b P) (radius_b P')).

(* Enclosures of two parts enclose their combinations. *)
Lemma entry_mixed e M M' i j :
  entry (mixed_matrix e M M') i j = (e.2 * entry M i j + e.1 * entry M' i j)%Z.
Proof. by rewrite /mixed_matrix entry_add !scale_entry. Qed.

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
