(* The places of numbers in a list, as a table that is read by position.

   To find a number in a list of n numbers takes n comparisons, and Coq's own evaluation compares
   natural numbers in as many steps as the lesser has units.  Entry i of a table is reached in i
   steps, without a comparison.

   Theorem [nth_mark]: for the numbers of the list, entry i of [mark value k l table] is the value
   at k plus the place of i in l; elsewhere it is the entry of the table.  [nth_places]: the table
   of places.

   Page: none.  Rust: crates/check/src/pencil.rs (positions). *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Section Tables.

Variable T : Type.

(* Values for the places of the numbers in l, beginning at k; the first place of a number counts. *)
Fixpoint mark (value : nat -> T) (k : nat) (l : seq nat) (table : seq (option T)) :=
  if l is i :: l' then set_nth None (mark value k.+1 l' table) i (Some (value k)) else table.

Theorem nth_mark value k l table i : nth None (mark value k l table) i =
  if i \in l then Some (value (k + index i l)) else nth None table i.
Proof.
elim: l k => //= j l IH k; rewrite nth_set_nth /= inE [j == i]eq_sym.
by case: eqVneq => [_|_] /=; rewrite ?addn0 // IH addSnnS.
Qed.

End Tables.

Definition places (l : seq nat) : seq (option nat) := mark id 0 l [::].

Theorem nth_places l i : nth None (places l) i = if i \in l then Some (index i l) else None.
Proof. by rewrite nth_mark nth_nil. Qed.

