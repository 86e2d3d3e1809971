(* Eigenvalue problems: values of both signs.

   A pencil whose unknown is an eigenvalue has solutions with values t of either sign.  Those with
   t <= 0 are solutions of the *reflected* pencil (A, -B), at -t:  (A + t B) x = (A + (-t)(-B)) x.

   Theorem [reflected_solution]: (t, x) solves (A, B) if and only if (-t, x) solves (A, -B).
   Theorem [reflected_equivalent]: what is said of (A, -B) is said of the solutions of (A, B) with
   t <= 0, -t in place of t.
   Theorem [both_signs], of pencils and of quadratic problems (Quadratic.v): if all solutions with a
   value in [0, b] and all those of the reflected problem with a value in [0, a] are known, then all
   solutions with -a <= t <= b are.  Solutions with t = 0 are in both sets, so those of the
   reflected problem whose value is known to be 0 are left out.

   Page: spec/certificates.md, 5.2 (Values below 0). *)

From Mceip Require Import Base Lists Integers Sums Tree Cover Pencil Signs Support Families Rational
  Statement Integral.

Definition zero_yield (y : yield) := (0 <? (yield_to y).2)%Z && ((yield_to y).1 <=? 0)%Z.

Definition zero_family (f : family) :=
  if held_place f.2 is PointAt v then (0 <? value_den v)%Z && (value_to v <=? 0)%Z else false.

Definition nonzero_values (c : solution_set) := SolutionSet
  [seq y <- solutions_in c | ~~ zero_yield y] [seq f <- families_of_set c | ~~ zero_family f]
  (open_regions c).

(* The part of a list that belongs to the items that are kept. *)
Lemma kept_part (T S : Type) (P : T -> S -> Prop) (D : S -> S -> Prop) (out : pred T) ys l :
  List.Forall2 P ys l -> List.ForallOrdPairs D l -> exists kept,
  [/\ List.Forall2 P [seq y <- ys | ~~ out y] kept, List.ForallOrdPairs D kept,
      forall m, List.In m kept -> List.In m l &
      forall m, List.In m l -> List.In m kept \/ exists2 y, out y & P y m].
Proof.
elim=> [|y m {}ys {}l Pym _ IH] pairs; first by exists [::]; split=> //; constructor.
have [all_m rest] : List.Forall (D m) l /\ List.ForallOrdPairs D l by inversion pairs.
have [kept [P_kept D_kept sub sup]] := IH rest; rewrite /=; case: ifPn => [keep|/negPn drop].
  exists (m :: kept); split; try by constructor.
  - constructor=> //; apply/List.Forall_forall=> m' /sub.
    by move: m'; apply/List.Forall_forall.
  - by move=> m' [<-|/sub]; [left | right].
  by move=> m' [<-|/sup[]]; [left; left | left; right | right].
exists kept; split=> // m'; first by move/sub; right.
by case=> [<-|/sup//]; right; exists y.
Qed.

(* The entry of a row at a column; it is [given_entry]. *)
Notation row_entry row j := (\sum_(e <- row) (if e.1 == j then fraction _ e.2 else 0)).

Section Reflection.

Variable R : rcfType.
Implicit Types (t s : R) (x : nat -> R).

Lemma opposite_row_entry row j : row_entry (opposite_row row) j = - row_entry row j :> R.
Proof.
rewrite -sumrN big_map; apply: eq_bigr => e _ /=.
by case: ifP; rewrite ?oppr0 // /fraction /= toRN mulNr.
Qed.

Lemma opposite_entry rows i j :
  given_entry R [seq opposite_row row | row <- rows] i j = - given_entry R rows i j.
Proof.
rewrite /given_entry -opposite_row_entry; congr (\sum_(e <- _) _).
by elim: rows i => [|row rows IH] [|i] /=.
Qed.

(* Vectors that solve the same. *)
Lemma same_rows_equivalent n numbers solved solved' y y' Q :
  (forall t x, solved t x <-> solved' t x) -> (forall t x i, y t x i = y' t x i) ->
  equivalent (from_zero_semantics n numbers solved y Q)
    (from_zero_semantics n numbers solved' y' Q).
Proof.
move=> same_solved same_y; split=> //=.
- by move=> t x [t0 /same_solved].
- by move=> t x [t0 /same_solved].
- by move=> x j _; exists 1; rewrite ?ltr01 // mul1r.
by move=> t x j _ _; exists 1; rewrite ?ltr01 // mul1r same_y.
Qed.

Section Pencil.

Variable Q : rational_pencil.

Lemma reflected_product n s x i :
  product n (given_a (reflected Q)) (given_b (reflected Q)) s x i =
  product n (given_a Q) (given_b Q) (- s) x i.
Proof. by apply: eq_bigr => j _; rewrite opposite_entry mulrN mulNr. Qed.

Theorem reflected_solution t x :
  eigenvalue_solves Q t x <-> eigenvalue_solves (reflected Q) (- t) x.
Proof.
split=> -[nonzero free rows]; split=> // i i_in.
- by rewrite reflected_product opprK free.
- by rewrite reflected_product opprK; apply: rows.
- by rewrite -[t]opprK -reflected_product free.
by rewrite -[t]opprK -reflected_product; apply: rows.
Qed.

Theorem reflected_equivalent :
  equivalent (negative_semantics R Q) (pencil_semantics R (reflected Q)).
Proof.
apply: same_rows_equivalent => [s x|s x i]; first by rewrite reflected_solution opprK.
by rewrite reflected_product.
Qed.

End Pencil.

Lemma zero_yieldP y s : zero_yield y -> 0 <= s -> between s (yield_from y) (yield_to y) -> s = 0.
Proof.
case/andP=> d0 n0 s0 [_ to_y]; apply/eqP; rewrite eq_le s0 andbT.
have d0R : 0 < toR (yield_to y).2 :> R by rewrite toR_gt0.
by rewrite -(pmulr_lle0 _ d0R) (le_trans to_y) // toR_le0.
Qed.

Lemma zero_familyP f s : zero_family f -> 0 <= s -> in_place (held_place f.2) s -> s = 0.
Proof.
rewrite /zero_family; case: (held_place _) => // v /andP[d0 n0] s0 [_ to_v _].
apply/eqP; rewrite eq_le s0 andbT.
have d0R : 0 < toR (value_den v) :> R by rewrite toR_gt0.
by rewrite -(pmulr_rle0 _ d0R) (le_trans to_v) // toR_le0.
Qed.

Lemma positive_values (S : semantics R) lo hi c l :
  all (fun y => (0 <? (yield_from y).1)%Z) (solutions_in c) -> different_solutions S lo hi c l ->
  forall m, List.In m l -> m.1 <> 0.
Proof.
move=> positive [_ _ + _]; elim: (solutions_in c) l positive => [|y ys IH] l /=.
  by move=> _ vals m; inversion vals.
case/andP=> y0 pos vals m; inversion vals as [|? k ? l' [[from_y _] _] rest]; subst=> -[<- eq|].
  by rewrite eq mul0r leNgt toR_gt0 y0 in from_y.
exact: IH pos rest _.
Qed.

Section BothSigns.

Variables (n : nat) (numbers : seq nat) (solved : R -> (nat -> R) -> Prop).
Variables (rows : R -> (nat -> R) -> nat -> R) (Q Q' : rational_pencil).

Notation semantics_above := (from_zero_semantics n numbers solved rows Q).
Notation semantics_below := (below_zero_semantics n numbers solved rows Q').

Theorem both_signs a b below above : all_solutions_are semantics_below zero a below ->
  all_solutions_are semantics_above zero b above ->
  all_of_both_signs_are semantics_below semantics_above solved a b (nonzero_values below) above.
Proof.
move=> [l different every] [l' different' every'].
have [_ sols vals pairs] := different; have [_ sols' _ _] := different'.
have [kept [vals_kept pairs_kept sub sup]] := kept_part zero_yield vals pairs.
have different_kept : different_solutions semantics_below zero a (nonzero_values below) kept.
  split=> // [|m /sub/sols //]; rewrite /=.
  by elim: vals_kept => //= y m ys ms _ _ ->.
exists kept, l'; split=> // [apart m m' m_in m'_in eq|t x sol [from_a to_b]].
  have m0 : 0 <= m.1 by have [[]] := sols _ (sub _ m_in).
  have m'0 : 0 <= m'.1 by have [[]] := sols' _ m'_in.
  have zero_m : m.1 = 0 by apply/eqP; rewrite eq_le m0 andbT -oppr_ge0 eq.
  case/orP: apart => /positive_values positive; first exact: positive different_kept _ m_in zero_m.
  by apply: positive different' _ m'_in _; rewrite -eq zero_m oppr0.
have zero_le s : 0 <= s -> toR zero.1 <= s * toR zero.2 by rewrite toR0 toR1 mulr1.
have [t_lt0|t_ge0] := ltrP t 0; [left | right]; last first.
  by apply: every' => //; split; first exact: zero_le.
have s_ge0 : 0 <= - t by rewrite oppr_ge0 ltW.
have s_neq0 : - t <> 0 by apply/eqP; rewrite oppr_eq0 lt_eqF.
have [||[m m_in [eq same]]|[f f_in [reg at_t]]|open] := every (- t) x.
- by split; rewrite ?opprK.
- by split; [apply: zero_le | rewrite mulNr ler_oppl -toRN].
- apply: Or31; exists m => //; case: (sup _ m_in) => // -[y y0 [bt _]].
  by case: s_neq0; apply: zero_yieldP y0 s_ge0 _; rewrite eq.
- apply: Or32; exists f => //; apply/List.filter_In; split=> //; apply/negP => f0.
  by case: s_neq0; apply: zero_familyP f0 s_ge0 at_t.
exact: Or33.
Qed.

End BothSigns.

End Reflection.
