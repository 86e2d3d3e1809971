(* What each file begins with: mathcomp's algebra, its tactics, and the integers Z.

   Page: none. *)

From Coq Require Export ZArith.
From mathcomp Require Export all_ssreflect all_algebra zify ssrZ ring.

#[export] Set Implicit Arguments.
#[export] Unset Strict Implicit.
#[export] Unset Printing Implicit Defensive.

Export Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Open Scope ring_scope.
