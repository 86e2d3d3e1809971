(* Statements about a problem, and what they mean.

   The program prints a statement only if [answer] of Verdict.v gives it, and then it is true
   ([answer_sound]).  Whoever reads this file and the definitions that it names knows what has been
   proved.

   A problem is a pencil, a mechanical system without or with particles of zero reaction, or a plain
   mixed complementarity problem.  Of the first three there are *solutions*: a value t >= 0 and a
   vector, which is x for a pencil and a motion v with (9) for a system.  Vectors that are positive
   multiples of each other are one solution.  Each complementarity variable has a *rate* (x_i; how
   fast a particle slips or opens) and a *row* (y_i), of which one is 0.

   [meaning] says for each kind of statement what it means in a real closed field.

   Pages: spec/certificates.md, 5.1, 5.15; spec/zero-reaction.md, Z.1. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra.
From Mceip Require Import Integers Tree Cover Pencil System Signs Support Families ZeroReaction.
From Mceip Require Import ZeroPencil PlainMcp Points.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Inductive problem :=
  | PencilProblem of pencil
  | SystemProblem of system & unknown
  | ZeroProblem of zero_system & unknown
  | PlainProblem of mcp.

(* Each solution listed lies in the region that is yielded for it.  Every other one belongs to a
   family or lies in an open region. *)
Record solution_set := SolutionSet {
  solutions_in : seq yield;
  families_of_set : seq family;
  open_regions : seq region }.

(* A solution with a value between these ends, with this support.  Off the support the rows are 0 at
   biactive variables, and positive elsewhere. *)
Record asserted := Asserted {
  asserted_from : point;
  asserted_to : point;
  asserted_support : seq nat;
  asserted_biactive : seq nat }.

Inductive statement :=
  (* Each of these solutions exists, with its value in the window. *)
  | EachExists of point & point & seq asserted
  (* All solutions in the window. *)
  | AllInWindow of point & point & solution_set
  (* All solutions at infinity. *)
  | AllAtInfinity of solution_set
  (* No solution for a friction between these two and lambda^2 >= 0. *)
  | NoneForFriction of point & point
  (* A solution with some lambda^2 >= 0 for each friction between these two. *)
  | OneForEachFriction of point & point
  (* Each of these points solves the plain problem. *)
  | PointsSolve of seq mcp_point.

Definition without_zero_particles s := ZeroSystem s [::].

(* The pencil of a problem, by (12)-(14) for a system. *)
Definition pencil_of_problem p : pencil :=
  match p with
  | PencilProblem Q => Q
  | SystemProblem s u => pencil_of s u
  | ZeroProblem z u => zero_pencil z u
  | PlainProblem _ => Pencil 0 [::] [::] [::]
  end.

(* Its complementarity variables, by their numbers in this pencil: one for each slip particle, then
   gap, right and left of each z particle. *)
Definition complementarity p : seq nat :=
  match p with
  | PencilProblem Q => slip Q
  | SystemProblem s _ => iota (free_number s) (size (particles s))
  | ZeroProblem z _ => iota (free_number (without_zero z)) (slip_number z)
  | PlainProblem _ => [::]
  end.

Section Meaning.

Variable R : rcfType.
Implicit Types (t : R) (v : nat -> R).

(* What a problem asks for.  Complementarity variables have numbers; rates are given by their
   positions among them. *)
Record semantics := Semantics {
  variables : seq nat;
  solves : R -> (nat -> R) -> Prop;
  same : (nat -> R) -> (nat -> R) -> Prop;
  rate : (nat -> R) -> nat -> R;
  row : R -> (nat -> R) -> nat -> R }.

(* -(S t'w + mu n'w) at a slip particle. *)
Definition slip_row s u t v j := - cone s (lambda2_of u t) (mu_of u t) v (particle s j).

(* Behind the slip particles, the rows of gap, right and left of each z particle. *)
Definition z_row z u t v i :=
  let s := without_zero z in
  let k := (i - size (particles s))%N in
  let p := zero_particle z (k %/ 3) in
  let w := force s (lambda2_of u t) v in
  let pressure := mu_of u t * along (normal p) p w in
  if (i < size (particles s))%N then slip_row s u t v i
  else nth 0 [:: - along (normal p) p w; along (tangent p) p w - pressure;
                 - along (tangent p) p w - pressure] (k %% 3).

Definition semantics_by (numbers : seq nat) p :=
  match p with
  | PencilProblem Q =>
      Semantics numbers (solution Q) (proportional Q) (fun x j => x (nth 0%N numbers j))
        (fun t x j => reaction Q t x (nth 0%N numbers j))
  | SystemProblem s u =>
      Semantics numbers (satisfies_9 s u) (same_motion s)
        (fun v j => variables_of s v (nth 0%N numbers j)) (slip_row s u)
  | ZeroProblem z u =>
      Semantics numbers (satisfies_9z z u) (same_motion (without_zero z))
        (fun v j => zero_variables_of z v (nth 0%N numbers j)) (z_row z u)
  | PlainProblem _ =>
      Semantics numbers (fun _ _ => False) (fun _ _ => False) (fun _ _ => 0) (fun _ _ _ => 0)
  end.

Definition semantics_of p := semantics_by (complementarity p) p.

Section Solutions.

Variable P : semantics.

(* The value lies between the ends of the region; moving variables have positive rates, those at
   rest the rate 0. *)
Definition lies_in_region r t v := in_region (size (variables P)) t (rate P v) r.

Definition belongs_to (f : family) t v :=
  lies_in_region f.1 t v /\ in_place (held_place f.2) t.

(* Which variables move, and which of the others have rows that are 0. *)
Definition has_signs (support biactive : seq nat) t v := forall j, (j < size (variables P))%N ->
  let i := nth 0%N (variables P) j in
  [/\ i \in support -> 0 < rate P v j, i \notin support -> rate P v j = 0,
      i \notin support -> i \in biactive -> row P t v j = 0 &
      i \notin support -> i \notin biactive -> 0 < row P t v j].

Definition asserted_holds lo hi a := exists t v,
  [/\ solves P t v, between t lo hi, between t (asserted_from a) (asserted_to a) &
      has_signs (asserted_support a) (asserted_biactive a) t v].

(* There are as many different solutions as listed, one in each region. *)
Definition all_solutions_are lo hi (c : solution_set) := exists l : seq (R * (nat -> R)),
  [/\ size l = size (solutions_in c),
      forall m, List.In m l -> solves P m.1 m.2 /\ between m.1 lo hi,
      List.Forall2 (fun y m => between m.1 (yield_from y) (yield_to y) /\
                               lies_in_region (yield_region y) m.1 m.2) (solutions_in c) l,
      List.ForallOrdPairs (fun m m' => ~ (m'.1 = m.1 /\ same P m.2 m'.2)) l &
      forall t v, solves P t v -> between t lo hi ->
        [\/ exists2 m, List.In m l & t = m.1 /\ same P m.2 v,
            exists2 f, List.In f (families_of_set c) & belongs_to f t v |
            exists2 r, List.In r (open_regions c) & lies_in_region r t v]].

(* Each value of the place has a solution of the family, and only one if the place is alone. *)
Definition family_exists (f : family) :=
  is_place R (held_place f.2) /\
  forall t, in_place (held_place f.2) t ->
    (exists v, solves P t v /\ lies_in_region f.1 t v) /\
    (held_alone f.2 -> forall v v', solves P t v -> lies_in_region f.1 t v ->
       solves P t v' -> lies_in_region f.1 t v' -> same P v v').

End Solutions.

(* Solutions at infinity of a pencil (Points.v); their value is 0 in the regions. *)
Definition infinite_solutions_are Q (c : solution_set) :=
  (exists l : seq (nat -> R),
    [/\ size l = size (solutions_in c), forall x, List.In x l -> at_infinity Q x,
        List.Forall2 (fun y x => lies_in_region (semantics_of (PencilProblem Q)) (yield_region y) 0 x)
          (solutions_in c) l,
        List.ForallOrdPairs (fun x x' => ~ proportional Q x x') l &
        forall x : nat -> R, at_infinity Q x ->
          [\/ exists2 x', List.In x' l & proportional Q x' x,
              exists2 f, List.In f (families_of_set c) &
                belongs_to (semantics_of (PencilProblem Q)) f 0 x |
              exists2 r, List.In r (open_regions c) &
                lies_in_region (semantics_of (PencilProblem Q)) r 0 x]]) /\
  forall f, List.In f (families_of_set c) ->
    (exists x : nat -> R,
       at_infinity Q x /\ lies_in_region (semantics_of (PencilProblem Q)) f.1 0 x) /\
    (held_alone f.2 -> forall x x' : nat -> R,
       at_infinity Q x -> lies_in_region (semantics_of (PencilProblem Q)) f.1 0 x ->
       at_infinity Q x' -> lies_in_region (semantics_of (PencilProblem Q)) f.1 0 x' ->
       proportional Q x x').

Definition has_motion p t (mu : R) v :=
  match p with
  | SystemProblem s _ => 0 <= t /\ conditions_9 s t mu v
  | ZeroProblem z _ => 0 <= t /\ conditions_9z z t mu v
  | _ => False
  end.

Definition is_system p :=
  match p with SystemProblem _ _ | ZeroProblem _ _ => True | _ => False end.

Definition meaning p s :=
  match s with
  | EachExists lo hi l => List.Forall (asserted_holds (semantics_of p) lo hi) l
  | AllInWindow lo hi c =>
      all_solutions_are (semantics_of p) lo hi c /\
      forall f, List.In f (families_of_set c) -> family_exists (semantics_of p) f
  | AllAtInfinity c => infinite_solutions_are (pencil_of_problem p) c
  | NoneForFriction from bound => is_system p /\
      forall (mu : R) t v, between mu from bound -> has_motion p t mu v -> False
  | OneForEachFriction from bound =>
      forall mu : R, between mu from bound -> exists t v, has_motion p t mu v
  | PointsSolve points =>
      if p is PlainProblem m then
        points <> [::] /\ forall z, List.In z points -> solves_plain m (point_value R z)
      else False
  end.

End Meaning.
