(* Complete sets of solutions of a pencil: the main theorem about certificates of pencils.

   The checker gets a pencil, a window [lo, hi] of values (hi may be infinity), a witness for the
   elimination of the free variables, and a tree.  What the tree yields is a list of pairs: a
   region, and the data of its root leaf with the points from and to.

   Theorem [complete_sound]: if the check succeeds, then
     1. each solution with a value in the window lies in the region of something yielded;
     2. each region yielded has exactly one solution up to a positive factor, and its value lies
        between from and to.
   [complete_none]: nothing yielded, no solution in the window.  [complete_one]: one thing yielded,
   exactly one solution in the window.

   Theorem [excluded_sound]: for pencils whose free rows depend on t a tree may use definite leaves
   of the whole pencil only; if the check succeeds, the window has no solution.

   Page: spec/certificates.md, 5.6, 5.14, 5.15.
   Rust: crates/check/src/lib.rs, cover/mod.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Covered Definite Root RootLeaf Cover.
From Mceip Require Import Condensation Pencil Whole.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Section Checker.

Variables (Q : pencil) (w : elimination) (tr : tree (leaf whole)) (lo hi : point).

Definition check_complete :=
  [&& wellformed Q, free_rows_constant Q, check_elimination (blocks_of Q) w &
      check_cover (condensed (blocks_of Q) w) (check_whole Q) tr lo hi].

(* What the tree yields. *)
Definition found := yields tr (window lo hi).

End Checker.

Definition check_excluded Q (tr : tree whole) lo hi :=
  wellformed Q && check_tree (size (slip Q)) (check_whole Q) tr (window lo hi).

Section Sound.

Variables (R : rcfType) (Q : pencil).

(* The solution (t, x) lies in a region. *)
Definition lies_in (r : region) (t : R) x := in_region (size (slip Q)) t (slip_of Q x) r.

Definition proportional (x x' : nat -> R) :=
  exists2 f, 0 < f & forall i, i \in iota 0 (order Q) -> x' i = f * x i.

Definition one_solution_in (r : region) (c : isolation) :=
  exists t x, [/\ between t (from_point c) (to_point c), solution Q t x, lies_in r t x &
    forall t' x', solution Q t' x' -> lies_in r t' x' -> t' = t /\ proportional x x'].

Section Complete.

Variables (w : elimination) (tr : tree (leaf whole)) (lo hi : point).
Hypothesis checked : check_complete Q w tr lo hi.

Notation D := (blocks_of Q).
Notation P := (condensed D w).
Notation A := (A_condensed R D w).
Notation B := (B_condensed R D w).

Lemma parts : [/\ wellformed Q, free_rows_constant Q, stiffness_positive D w, shapes D w &
  check_cover P (check_whole Q) tr lo hi].
Proof. by case/and4P: checked => ? ? /andP[]. Qed.

Lemma condensed_solution t x : solution Q t x ->
  solves P A B t (slip_of Q x) /\
  forall k, k \in iota 0 (size (free Q)) -> free_of Q x k = free_part D (slip_of Q x) k.
Proof.
have [wf con pos shp _] := parts.
by move/(pencil_blocks wf con)/(condensation_exact pos shp).
Qed.

Lemma whole_solution t xs : solves P A B t xs -> exists x,
  solution Q t x /\ forall j, (j < size (slip Q))%N -> slip_of Q x j = xs j.
Proof.
have [wf con pos shp _] := parts => sol.
exists (join Q (free_part D xs) xs); split; last by move=> j; apply: slip_of_join.
by apply: (join_solution wf con); apply/(condensation_exact pos shp).
Qed.

Lemma lies_in_ext r t (x : nat -> R) xs :
  (forall j, (j < size (slip Q))%N -> slip_of Q x j = xs j) ->
  in_region (size (slip Q)) t xs r <-> lies_in r t x.
Proof.
move=> same; rewrite /lies_in; split=> -[bt ag]; split=> // j lt_j; have := ag j lt_j;
  by rewrite same.
Qed.

Lemma whole_leaf_sound r wl (t : R) xs :
  ordered (lower r) (upper r) -> check_whole Q r wl -> in_region (size (slip Q)) t xs r ->
  solves P A B t xs -> False.
Proof.
move=> O ok reg /whole_solution[x [sol same]]; have [wf _ _ _ _] := parts.
have [bt ag] := (lies_in_ext r t same).1 reg.
exact: (whole_sound wf O ok bt ag sol).
Qed.

Lemma encloses_condensed : encloses P A B.
Proof. by have [_ _ pos shp _] := parts; apply: condensation_encloses. Qed.

Theorem complete_sound :
  (forall t x, solution Q t x -> between t lo hi ->
     exists2 rc, List.In rc (found tr lo hi) & lies_in rc.1 t x) /\
  (forall rc, List.In rc (found tr lo hi) -> one_solution_in rc.1 rc.2).
Proof.
have [wf con pos shp cover] := parts.
have [every each] := cover_sound encloses_condensed whole_leaf_sound cover.
split=> [t x /condensed_solution[sol _] bt|rc in_found].
  by have [rc in_found reg] := every t _ sol bt; exists rc.

have [t [xs [bt sol reg uniq]]] := each _ in_found.
exists t, (join Q (free_part D xs) xs).
have same j : (j < size (slip Q))%N -> slip_of Q (join Q (free_part D xs) xs) j = xs j.
  by move=> lt_j; apply: slip_of_join.
split=> //.
- by apply: (join_solution wf con); apply/(condensation_exact pos shp).
- exact/(lies_in_ext _ _ same).

move=> t' x' /condensed_solution[sol' free'] reg'.
have [-> [f f0 scaled]] := uniq _ _ sol' reg'.
split=> //; exists f => // i Hi; case/orP: (free_or_slip Hi) => /(nthP 0%N)[k lt_k <-].
  rewrite -[LHS]/(free_of Q x' k) -[X in _ = f * X]/(free_of Q _ k) free' ?mem_iota //.
  rewrite free_of_join // /free_part mulrN mulr_sumr; congr (- _); apply: sum_eq => j Hj.
  by rewrite scaled // mulrCA.
rewrite -[LHS]/(slip_of Q x' k) -[X in _ = f * X]/(slip_of Q _ k) same //.
by apply: scaled; rewrite mem_iota.
Qed.

Corollary complete_none : found tr lo hi = [::] ->
  forall (t : R) x, solution Q t x -> between t lo hi -> False.
Proof.
by move=> none t x sol bt; have [rc] := complete_sound.1 t x sol bt; rewrite none.
Qed.

Corollary complete_one rc : found tr lo hi = [:: rc] ->
  exists (t : R) x, [/\ between t (from_point rc.2) (to_point rc.2), solution Q t x &
    forall t' x', solution Q t' x' -> between t' lo hi -> t' = t /\ proportional x x'].
Proof.
move=> one; have [|t [x [bt sol reg uniq]]] := complete_sound.2 rc; first by rewrite one; left.
exists t, x; split=> // t' x' sol' bt'; apply: uniq => //.
by have [rc' + reg'] := complete_sound.1 t' x' sol' bt'; rewrite one => -[->|].
Qed.

End Complete.

Theorem excluded_sound tr lo hi : check_excluded Q tr lo hi ->
  forall t (x : nat -> R), solution Q t x -> between t lo hi -> False.
Proof.
case/andP=> wf checked t x sol bt; have [_ _ _ rows_s] := sol.
have x0 j : (j < size (slip Q))%N -> 0 <= slip_of Q x j.
  by move=> lt_j; have [] := rows_s _ (mem_nth 0%N lt_j).
have start : in_region (size (slip Q)) t (slip_of Q x) (window lo hi).
  by split=> // i _; rewrite /state_of nth_nil.
have [[r w] _ [[bt' ag] O ok]] := every_point_reaches_a_leaf checked x0 start.
exact: (whole_sound wf O ok bt' ag sol).
Qed.

End Sound.
