(* Integers of the checker inside an ordered field.

   The checker computes with integers (Z, extracted to GMP integers).  Its theorems speak of an
   ordered field R: the real numbers, or the real algebraic numbers.  [toR z] is the integer z as
   an element of R.  This file proves that toR keeps sums, products and order, and gives the
   checker's sums over lists of indices as sums in R.

   Page: spec/certificates.md, 5.1 (the signs of results are those in exact arithmetic).
   Rust: crates/exact (integers); nothing here is a step of the checker. *)

From Mceip Require Import Base.

(* A matrix of integers is the list of its rows; entries outside are 0. *)
Definition matrix := seq (seq Z).

Definition entry (m : matrix) (i j : nat) : Z := nth 0%Z (nth [::] m i) j.

Definition sumZ (l : seq nat) (f : nat -> Z) : Z := foldr (fun i a => (f i + a)%Z) 0%Z l.

Section Embedding.

Variable R : realFieldType.

Definition toR (z : Z) : R := (int_of_Z z)%:~R.

Lemma toRD a b : toR (a + b)%Z = toR a + toR b.
Proof. by rewrite /toR -intrD -(raddfD [additive of int_of_Z]). Qed.

Lemma toRN a : toR (- a)%Z = - toR a.
Proof. by rewrite /toR -mulrNz -(raddfN [additive of int_of_Z]). Qed.

Lemma toRB a b : toR (a - b)%Z = toR a - toR b.
Proof. by rewrite -Z.add_opp_r toRD toRN. Qed.

Lemma toRM a b : toR (a * b)%Z = toR a * toR b.
Proof. by rewrite /toR -intrM -(rmorphM [rmorphism of int_of_Z]). Qed.

Lemma toR0 : toR 0%Z = 0.
Proof. by []. Qed.

Lemma toR1 : toR 1%Z = 1.
Proof. by []. Qed.

Lemma toR_le a b : (toR a <= toR b) = (a <=? b)%Z.
Proof. rewrite /toR ler_int; lia. Qed.

Lemma toR_lt a b : (toR a < toR b) = (a <? b)%Z.
Proof. rewrite /toR ltr_int; lia. Qed.

Lemma toR_abs a : toR (Z.abs a) = `|toR a|.
Proof. rewrite /toR -intr_norm; congr (_%:~R); lia. Qed.

Lemma toR_eq0 a : (toR a == 0) = (a =? 0)%Z.
Proof. rewrite /toR intr_eq0; lia. Qed.

Lemma toR_ge0 a : (0 <= toR a) = (0 <=? a)%Z.
Proof. by rewrite -toR0 toR_le. Qed.

Lemma toR_gt0 a : (0 < toR a) = (0 <? a)%Z.
Proof. by rewrite -toR0 toR_lt. Qed.

Lemma toR_lt0 a : (toR a < 0) = (a <? 0)%Z.
Proof. by rewrite -toR0 toR_lt. Qed.

Lemma toR_le0 a : (toR a <= 0) = (a <=? 0)%Z.
Proof. by rewrite -toR0 toR_le. Qed.

Lemma toR_sum l f : toR (sumZ l f) = \sum_(i <- l) toR (f i).
Proof. by elim: l => [|i l IH]; rewrite ?big_nil ?big_cons //= toRD IH. Qed.

End Embedding.

Arguments toR {R} z.
