(* Soundness of a cover: what all leaves of a tree prove together.

   A leaf is one of

     Farkas w                w excludes every solution of the region (Farkas.v);
     Definite sign low high  a definite form excludes every solution (Definite.v);
     Absent c                no null vector in a decided region (RootLeaf.v);
     Root c o                one null vector, with the outcome o (RootLeaf.v);
     Whole w                 a statement about the pencil before condensation (Whole.v).

   A root leaf with the outcome "solution" yields the pair of its region and its data.

   Theorem [cover_sound]: if a tree is checked on a window, then
     1. every solution in the window lies in the region of something yielded, and
     2. each region of something yielded has exactly one solution, up to a positive factor; its
        value lies between the points from and to of the leaf.
   [no_solution]: nothing yielded, no solution.  [exactly_one]: one thing yielded, one solution.

   Page: spec/certificates.md, 5.6 and 5.15.
   Rust: crates/check/src/cover/mod.rs, found.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Farkas Covered Definite Root RootLeaf.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Section Cover.

(* Evidence about the whole pencil, of whatever kind. *)
Variable whole : Type.

Inductive leaf :=
  | Farkas of seq Z
  | Definite of bool & factor & factor
  | Absent of absence
  | Root of isolation & outcome
  | Whole of whole.

Definition yielded (rl : region * leaf) : option (region * isolation) :=
  if rl.2 is Root c Solution then Some (rl.1, c) else None.

Definition yields (tr : tree leaf) (r : region) := pmap yielded (leaves tr r).

Definition window lo hi := Region lo hi [::].

Section Checker.

Variables (P : enclosed) (check_whole : region -> whole -> bool).

Definition check_leaf (r : region) (l : leaf) : bool :=
  match l with
  | Farkas w => farkas P r w
  | Definite negative low high => definite P negative r low high
  | Absent c => check_absent P r c
  | Root c o => check_root P r c o
  | Whole w => check_whole r w
  end.

Definition check_cover (tr : tree leaf) (lo hi : point) :=
  check_tree (size_of P) check_leaf tr (window lo hi).

End Checker.

Lemma in_pmap T U (f : T -> option U) (l : seq T) y :
  List.In y (pmap f l) <-> exists2 x, List.In x l & f x = Some y.
Proof.
elim: l => [|a l IH] /=; first by split=> [|[]].
case fa: (f a) => [b|] /=.
  split=> [[<-|/IH[x xl fx]]|[x [<-|xl] fx]].
  - by exists a => //; left.
  - by exists x => //; right.
  - by left; move: fx; rewrite fa => -[].
  - by right; apply/IH; exists x.
split=> [/IH[x xl fx]|[x [ax|xl] fx]].
- by exists x => //; right.
- by move: fx; rewrite -ax fa.
- by apply/IH; exists x.
Qed.

Section Sound.

Variable R : rcfType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.
Notation solves := (solves P A B).

Variable check_whole : region -> whole -> bool.
Hypothesis whole_sound : forall r w (t : R) x,
  ordered (lower r) (upper r) -> check_whole r w -> in_region_of P t x r -> solves t x -> False.

(* x' is a positive multiple of x. *)
Definition same_direction (x x' : nat -> R) :=
  exists2 f, 0 < f & forall i, i \in indices P -> x' i = f * x i.

Definition has_exactly_one (r : region) (c : isolation) :=
  exists t x, [/\ between t (from_point c) (to_point c), solves t x, in_region_of P t x r &
    forall t' x', solves t' x' -> in_region_of P t' x' r -> t' = t /\ same_direction x x'].

(* A leaf excludes every solution, or it yields. *)
Lemma leaf_sound r l t x :
  ordered (lower r) (upper r) -> check_leaf P check_whole r l ->
  in_region_of P t x r -> solves t x -> exists c, yielded (r, l) = Some (r, c).
Proof.
move=> O; case: l => [w|negative low high|c|c o|w] /= ok reg sol.
- by case: (farkas_sound E O ok reg sol).
- by case: (definite_sound E O ok reg sol).
- have D : decided P r by case/and5P: ok.
  by case: (absent_sound E O D ok reg sol).
- case/andP: ok => iso signs; have D : decided P r by case/and5P: iso.
  case: o signs => [_|i /andP[iK neg]|i /and3P[Hi nm neg]]; first by exists c.
    by case: (negative_x_sound E O D iso iK neg reg sol).
  by case: (negative_y_sound E O D iso Hi nm neg reg sol).
- by case: (whole_sound O ok reg sol).
Qed.

Lemma in_window t (x : nat -> R) lo hi :
  between t lo hi -> in_region_of P t x (window lo hi).
Proof. by move=> bt; split=> // i _; rewrite /state_of nth_nil. Qed.

Section Checked.

Variables (tr : tree leaf) (lo hi : point).
Hypothesis checked : check_cover P check_whole tr lo hi.
Notation found := (yields tr (window lo hi)).

Lemma every_solution_is_yielded t x : solves t x -> between t lo hi ->
  exists2 rc, List.In rc found & in_region_of P t x rc.1.
Proof.
move=> sol bt.
have [[r l] in_leaves [reg O ok]] :=
  every_point_reaches_a_leaf checked (solution_ge0 sol) (in_window x bt).
have [c yields_c] := leaf_sound O ok reg sol.
by exists (r, c) => //; apply/in_pmap; exists (r, l).
Qed.

Lemma each_yield_has_one rc : List.In rc found -> has_exactly_one rc.1 rc.2.
Proof.
case/in_pmap=> -[r l] in_leaves; rewrite /yielded /=.
case: l in_leaves => // c [] //= in_leaves [<-] /=.
have [O /andP[iso signs]] := leaves_are_checked checked in_leaves.
have D : decided P r by case/and5P: iso.
have [t [x [bt sol reg uniq]]] := solution_sound E O D iso signs.
by exists t, x; split=> // t' x' sol' reg'; have := uniq t' x' sol' reg'.
Qed.

Theorem cover_sound :
  (forall t x, solves t x -> between t lo hi ->
     exists2 rc, List.In rc found & in_region_of P t x rc.1) /\
  (forall rc, List.In rc found -> has_exactly_one rc.1 rc.2).
Proof. by split; [exact: every_solution_is_yielded | exact: each_yield_has_one]. Qed.

Theorem no_solution : found = [::] -> forall t x, solves t x -> between t lo hi -> False.
Proof. by move=> none t x sol /(every_solution_is_yielded sol)[rc]; rewrite none. Qed.

Theorem exactly_one rc : found = [:: rc] ->
  exists t x, [/\ between t (from_point rc.2) (to_point rc.2), solves t x &
    forall t' x', solves t' x' -> between t' lo hi -> t' = t /\ same_direction x x'].
Proof.
move=> one; have [|t [x [bt sol reg uniq]]] := @each_yield_has_one rc.
  by rewrite one; left.
exists t, x; split=> // t' x' sol' bt'; apply: uniq => //.
by have [rc' + reg'] := every_solution_is_yielded sol' bt'; rewrite one => -[->|].
Qed.

End Checked.

End Sound.

End Cover.
