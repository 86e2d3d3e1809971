(* Verdicts that Coq's own evaluation repeats.

   `mceip-verified --coq PROBLEM CERTIFICATE` writes a file of definitions and theorems: the problem
   as it is given, the factors that make it integral, the evidence, the statement, and that it holds.
   Their proof evaluates [answer] by Coq's virtual machine; no extracted program takes part.

   This is what such a file begins with. *)

From Coq Require Export ZArith.
From mathcomp Require Export all_ssreflect all_algebra.
From Mceip Require Export Base Integers Sums Tree Enclosed Farkas Covered Definite Signed Root
  RootLeaf Pinned Cover Number Condensation Pencil Whole Claim EnclosedClaim Complete System Signs
  Support Families Lifted ZeroReaction PlainMcp Series Anchor AnchorLeaf Varying Covers ZeroPencil
  ZeroEnclosed ZeroComplete Boxes Regular Critical CriticalAnchors Presence PresenceAnchors Points
  Rational Statement Equilibrium Unique Stability Stable Verdict.

(* A natural number, written as an integer. *)
Definition n := Z.to_nat.

Ltac by_evaluation factors shown :=
  apply: (@answer_sound _ _ factors shown);
  match goal with |- _ = ?proved => vm_cast_no_check (erefl proved) end.

(* A list of so many solutions with a value in the window, no two the same, in which each one is. *)
Definition exactly (R : rcfType) p lo hi (count : nat) := let P := semantics_of R p in
  exists l : seq (R * (nat -> R)),
    [/\ size l = count,
        forall m, List.In m l -> solves P m.1 m.2 /\ between m.1 lo hi,
        List.ForallOrdPairs (fun m m' => ~ (m'.1 = m.1 /\ same P m.2 m'.2)) l &
        forall t v, solves P t v -> between t lo hi ->
          exists2 m, List.In m l & t = m.1 /\ same P m.2 v].

Lemma number_of_solutions (R : rcfType) p lo hi ys :
  meaning R p (AllInWindow lo hi (SolutionSet ys [::] [::])) -> exactly R p lo hi (size ys).
Proof.
have set : meaning_in (semantics_of R p) (AllInWindow lo hi (SolutionSet ys [::] [::])) ->
    exactly R p lo hi (size ys).
  case=> [[l [number solve _ differ] every] _]; exists l; split=> // t v sat bt.
  by have [|[]|[]] := every t v sat bt.
by case: p set.
Qed.
