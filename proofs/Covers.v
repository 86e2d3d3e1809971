(* Covers of a pencil, with support leaves, by either kind of evidence.

   The free variables are eliminated where their rows do not depend on the value (Complete.v), or
   condensed about anchors (Varying.v).  A support leaf may stand for each region that the tree
   leaves open (Families.v).

   Theorem [families_number]: if the check succeeds and [all_solutions] gives a list of N regions,
   then there are N solutions with a value in the window, one in each of them and no two of them
   equal; every other solution in the window belongs to a family or lies in an open region.
   [families_exactly]: exactly N, if there is no family and nothing is open.  [families_hold]: what
   is said of families.  [system_families_number], [system_families_exactly],
   [system_families_none], [system_families_hold]: the same for the motions of a mechanical system
   with (9).

   With "varying" in place of "families" in its name a theorem speaks of condensation about anchors.

   Page: spec/certificates.md, 5.12 and 5.15.  Rust: crates/check/src/cover/support.rs, found.rs. *)

From Mceip Require Import Base Integers Sums Tree Cover Number Condensation Pencil Whole Complete
  System Support Families Varying.

(* What takes the place of the free variables, and the tree. *)
Inductive cover :=
  | Eliminated of elimination & tree (leaf whole)
  | Anchored of anchoring & tree varying_leaf.

Section Checker.

Variables (Q : pencil) (claims : seq solution_claim) (c : cover) (lo hi : point).
Variable ls : seq (option support_leaf).

Definition check_cover_of :=
  match c with
  | Eliminated w tr => check_complete Q claims w tr lo hi
  | Anchored w tr => check_varying Q claims w tr lo hi
  end.

(* The regions with a solution, and those that the tree leaves open. *)
Definition regions_found :=
  match c with
  | Eliminated _ tr => found Q claims tr lo hi
  | Anchored _ tr => varying_found Q claims tr lo hi
  end.

Definition regions_open :=
  match c with
  | Eliminated _ tr => left_open tr lo hi
  | Anchored _ tr => varying_open tr lo hi
  end.

Definition families := families_of regions_open ls.

Definition still_open := open_of regions_open ls.

(* The solutions that do not belong to a family. *)
Definition all_solutions :=
  distinct_yields (size (slip Q)) lo hi
    [seq y <- regions_found ++ isolated_of regions_open ls
         | ~~ has (belongs (size (slip Q)) y) families].

Definition check_families := check_cover_of && check_supports Q regions_open ls.

End Checker.

Definition check_system_families s u claims c lo hi ls :=
  system_wellformed s u && check_families (pencil_of s u) claims c lo hi ls.

Lemma cover_wellformed Q claims c lo hi : check_cover_of Q claims c lo hi -> wellformed Q.
Proof. by case: c => w tr /andP[]. Qed.

Theorem cover_covers (R : rcfType) Q claims c lo hi : check_cover_of Q claims c lo hi ->
  covers (solution Q) (proportional Q) (lies_in Q) lo hi (regions_found Q claims c lo hi)
    (in_some (R := R) (lies_in Q) (regions_open c lo hi)).
Proof. by case: c => w tr; [apply: complete_sound | apply: varying_sound]. Qed.

Section Pencils.

Variables (R : rcfType) (Q : pencil) (claims : seq solution_claim) (c : cover) (lo hi : point).
Variable ls : seq (option support_leaf).
Hypothesis checked : check_families Q claims c lo hi ls.

Theorem families_number ys : all_solutions Q claims c lo hi ls = Some ys ->
  all_listed (solution Q) (proportional Q) (lies_in Q) lo hi ys
    (unlisted (R := R) (lies_in Q) (families c lo hi ls) (still_open c lo hi ls)).
Proof.
by case/andP: checked => ok supports; apply: (cover_number supports (cover_covers R ok)).
Qed.

Corollary families_exactly ys : all_solutions Q claims c lo hi ls = Some ys ->
  families c lo hi ls = [::] -> still_open c lo hi ls = [::] ->
  all_listed (solution Q) (proportional Q) (lies_in Q) lo hi ys (no_other (R := R)).
Proof.
move=> /families_number + no_family no_open; rewrite no_family no_open.
by apply: listed_weaken; apply: unlisted_none.
Qed.

Theorem families_hold f : List.In f (families c lo hi ls) -> family_holds R Q f.
Proof. by case/andP: checked => _ supports; apply: supports_families. Qed.

End Pencils.

Section Systems.

Variables (R : rcfType) (s : system) (u : unknown) (claims : seq solution_claim) (c : cover).
Variables (lo hi : point) (ls : seq (option support_leaf)).
Hypothesis checked : check_system_families s u claims c lo hi ls.

Theorem system_families_number ys : all_solutions (pencil_of s u) claims c lo hi ls = Some ys ->
  all_listed (satisfies_9 s u) (same_motion s) (motion_in s u) lo hi ys
    (unlisted (R := R) (motion_in s u) (families c lo hi ls) (still_open c lo hi ls)).
Proof. by case/andP: checked => wf ok /(families_number R ok); apply: motions_number. Qed.

Corollary system_families_exactly ys : all_solutions (pencil_of s u) claims c lo hi ls = Some ys ->
  families c lo hi ls = [::] -> still_open c lo hi ls = [::] ->
  all_listed (satisfies_9 s u) (same_motion s) (motion_in s u) lo hi ys (no_other (R := R)).
Proof.
move=> /system_families_number + no_family no_open; rewrite no_family no_open.
by apply: listed_weaken; apply: unlisted_none.
Qed.

Corollary system_families_none : all_solutions (pencil_of s u) claims c lo hi ls = Some [::] ->
  families c lo hi ls = [::] -> still_open c lo hi ls = [::] ->
  forall (t : R) v, satisfies_9 s u t v -> between t lo hi -> False.
Proof. by move=> none no_family /(system_families_exactly none no_family); apply: listed_none. Qed.

Theorem system_families_hold f : List.In f (families c lo hi ls) ->
  family_solved (motion_in s u) (satisfies_9 s u) (same_motion (R := R) s) f.
Proof. by case/andP: checked => wf ok /(families_hold R ok); apply: motions_hold. Qed.

End Systems.

(* Condensation about anchors. *)
Section Anchored.

Variables (R : rcfType) (Q : pencil) (s : system) (u : unknown) (claims : seq solution_claim).
Variables (w : anchoring) (tr : tree varying_leaf).

Definition varying_number := @families_number R Q claims (Anchored w tr).
Definition varying_exactly := @families_exactly R Q claims (Anchored w tr).
Definition varying_hold := @families_hold R Q claims (Anchored w tr).
Definition system_varying_number := @system_families_number R s u claims (Anchored w tr).
Definition system_varying_exactly := @system_families_exactly R s u claims (Anchored w tr).
Definition system_varying_none := @system_families_none R s u claims (Anchored w tr).
Definition system_varying_hold := @system_families_hold R s u claims (Anchored w tr).

End Anchored.
