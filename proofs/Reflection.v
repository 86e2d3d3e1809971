(* Eigenvalue problems: values of both signs.

   A pencil whose unknown is an eigenvalue has solutions with values t of either sign.  Those with
   t <= 0 are solutions of the *reflected* pencil (A, -B), at -t:  (A + t B) x = (A + (-t)(-B)) x.

   Theorem [reflected_solution]: (t, x) solves (A, B) if and only if (-t, x) solves (A, -B).
   Theorem [reflected_equivalent]: what is said of (A, -B) is said of the solutions of (A, B) with
   t <= 0, -t in place of t.
   Theorem [both_signs]: if all solutions of (A, B) with a value in [0, b] and all those of (A, -B)
   with a value in [0, a] are known, then all solutions of (A, B) with -a <= t <= b are.

   Page: spec/certificates.md, 5.2 (Values below 0). *)

From Mceip Require Import Base Integers Sums Tree Pencil Rational Statement Integral.

Section Reflection.

Variables (R : rcfType) (Q : rational_pencil).
Implicit Types (t s : R) (x : nat -> R).

Notation semantics_above := (pencil_semantics R Q).
Notation semantics_below := (negative_semantics R Q).

Lemma reflected_entry i j :
  given_entry R (given_b (reflected Q)) i j = - given_entry R (given_b Q) i j.
Proof.
rewrite /given_entry -sumrN /=; elim: (given_b Q) i => [|row rows IH] [|i] /=;
  rewrite ?nth_nil ?big_nil // big_map; apply: eq_bigr => e _ /=.
by case: ifP; rewrite ?oppr0 // /fraction /= toRN mulNr.
Qed.

Lemma reflected_product n s x i :
  product n (given_a (reflected Q)) (given_b (reflected Q)) s x i =
  product n (given_a Q) (given_b Q) (- s) x i.
Proof. by apply: eq_bigr => j _; rewrite reflected_entry mulrN mulNr. Qed.

Theorem reflected_solution t x :
  eigenvalue_solves Q t x <-> eigenvalue_solves (reflected Q) (- t) x.
Proof.
split=> -[nonzero free rows]; split=> // i i_in.
- by rewrite reflected_product opprK free.
- by rewrite reflected_product opprK; apply: rows.
- by rewrite -[t]opprK -reflected_product free.
by rewrite -[t]opprK -reflected_product; apply: rows.
Qed.

Theorem reflected_equivalent : equivalent semantics_below (pencil_semantics R (reflected Q)).
Proof.
split=> //=; first 1 last.
- by move=> v j _; exists 1; rewrite ?ltr01 // mul1r.
- by move=> s v j _; exists 1; rewrite ?ltr01 // mul1r reflected_product.
by move=> s x; rewrite reflected_solution opprK.
Qed.

Theorem both_signs a b below above : all_solutions_are semantics_below zero a below ->
  all_solutions_are semantics_above zero b above -> all_of_both_signs_are R Q a b below above.
Proof.
move=> [l different every] [l' different' every']; exists l, l'; split=> // t x sol [from_a to_b].
have zero_le s : 0 <= s -> toR zero.1 <= s * toR zero.2 by rewrite toR0 toR1 mulr1.
have [t_le0|/ltW t_ge0] := lerP t 0; [left; apply: every | right; apply: every'].
- by split; rewrite ?opprK // oppr_ge0.
- by split; [apply: zero_le; rewrite oppr_ge0 | rewrite mulNr ler_oppl -toRN].
- by [].
by split; first exact: zero_le.
Qed.

End Reflection.
