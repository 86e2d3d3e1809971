(* Exactly N solutions.

   [complete_sound] says that every solution in the window lies in a region that the tree yields,
   and that each of these regions has exactly one.  Two regions may still hold the same solution,
   at a value where both end.  Two boolean tests exclude this:

       apart a b     a complementarity variable moves in the one region and rests in the other,
                     or the intervals of the values have no point in common;
       inside c      the interval of the value lies in the window.

   Theorem [complete_exactly]: if the check succeeds, all regions are inside and any two are apart,
   then the pencil has exactly N solutions in the window, N the number of regions: there is a list
   of N solutions, one in each region, no two of which are positive multiples of each other, and
   every solution in the window is a positive multiple of one of them.

   Theorem [system_exactly]: the same for the motions that satisfy (9).  [by_computation]: what is
   left of it without the regions, for a check that Coq itself evaluates (Examples.v).

   Page: spec/certificates.md, 5.15.  Program: the sentence "exactly N solutions". *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Covered Definite Root RootLeaf Cover.
From Mceip Require Import Condensation Pencil Whole Complete Claim System.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Section Checker.

Local Open Scope Z_scope.

Definition opposite (a b : state) :=
  match a, b with Moving, Resting | Resting, Moving => true | _, _ => false end.

(* The value p/q is less than the value p'/q'. *)
Definition less (a b : point) := [&& 0 <=? a.2, 0 <=? b.2 & a.1 * b.2 <? b.1 * a.2].

Definition apart n (a b : region * isolation) :=
  [|| has (fun i => opposite (state_of a.1 i) (state_of b.1 i)) (iota 0 n),
      less (to_point a.2) (from_point b.2) | less (to_point b.2) (from_point a.2)].

Fixpoint all_apart n (l : seq (region * isolation)) :=
  if l is a :: rest then all (apart n a) rest && all_apart n rest else true.

Definition inside (lo hi : point) (a : region * isolation) :=
  let: from := from_point a.2 in let: to := to_point a.2 in
  [&& 0 <? from.2, 0 <=? lo.2, lo.1 * from.2 <=? from.1 * lo.2,
      0 <? to.2, 0 <=? hi.2 & to.1 * hi.2 <=? hi.1 * to.2].

Definition check_exactly n lo hi l := all (inside lo hi) l && all_apart n l.

End Checker.

Section Sound.

Variables (R : rcfType) (Q : pencil) (lo hi : point).
Notation n := (size (slip Q)).
Implicit Types (t : R) (x : nat -> R) (s : R * (nat -> R)).

Definition nothing : R * (nat -> R) := (0, fun=> 0).

(* The same solution: one value, and x up to a positive factor. *)
Definition same_solution s s' := s'.1 = s.1 /\ proportional Q s.2 s'.2.

(* A list of solutions in the window, no two the same. *)
Definition solutions (l : seq (R * (nat -> R))) :=
  (forall i, (i < size l)%N ->
     solution Q (nth nothing l i).1 (nth nothing l i).2 /\ between (nth nothing l i).1 lo hi) /\
  (forall i j, (i < j)%N -> (j < size l)%N ->
     ~ same_solution (nth nothing l i) (nth nothing l j)).

(* The solutions of a list lie in the regions of another, one in each. *)
Definition located (regions : seq (region * isolation)) (l : seq (R * (nat -> R))) :=
  forall nowhere i, (i < size regions)%N ->
    let rc := nth nowhere regions i in let s := nth nothing l i in
    between s.1 (from_point rc.2) (to_point rc.2) /\ lies_in Q rc.1 s.1 s.2.

(* What is known of the solution of a region. *)
Definition solution_of (rc : region * isolation) s :=
  [/\ between s.1 (from_point rc.2) (to_point rc.2), solution Q s.1 s.2, lies_in Q rc.1 s.1 s.2 &
      forall t x, solution Q t x -> lies_in Q rc.1 t x -> same_solution s (t, x)].

Lemma choose nowhere l : (forall rc, List.In rc l -> one_solution_in R Q rc.1 rc.2) ->
  exists2 sols, size sols = size l &
    forall i, (i < size l)%N -> solution_of (nth nowhere l i) (nth nothing sols i).
Proof.
elim: l => [|rc l IH] each; first by exists [::].
have [sols size_sols all_sols] : exists2 sols, size sols = size l &
    forall i, (i < size l)%N -> solution_of (nth nowhere l i) (nth nothing sols i).
  by apply: IH => rc' in_l; apply: each; right.
have [t [x [bt sol reg uniq]]] := each rc (or_introl erefl).
exists ((t, x) :: sols) => [/=|]; first by rewrite size_sols.
by case=> [|i] //= lt_i; apply: all_sols.
Qed.

Lemma less_values a b t t' : less a b -> t * toR a.2 <= toR a.1 -> toR b.1 <= t' * toR b.2 ->
  t != t'.
Proof.
case/and3P=> a2 b2 lt_ab below above; apply/eqP => same_t; move: above; rewrite -same_t => above.
have a2_ge0 : 0 <= toR a.2 :> R by rewrite -(toR0 R) toR_le.
have b2_ge0 : 0 <= toR b.2 :> R by rewrite -(toR0 R) toR_le.
have : toR b.1 * toR a.2 <= toR a.1 * toR b.2 :> R.
  have /le_trans-> // := ler_wpmul2r a2_ge0 above.
  by rewrite mulrAC; apply: ler_wpmul2r.
by rewrite -!toRM toR_le; move: lt_ab; lia.
Qed.

Lemma apart_sound rc rc' s s' : apart n rc rc' -> solution_of rc s -> solution_of rc' s' ->
  ~ same_solution s s'.
Proof.
move=> ap [[from to] _ [_ agree] _] [[from' to'] _ [_ agree'] _] [same_t [f f0 scaled]].
case/or3P: ap => [/hasP[i]|lt|lt]; last 2 first.
- by move: (less_values lt to from'); rewrite same_t eqxx.
- by move: (less_values lt to' from); rewrite same_t eqxx.
rewrite mem_iota add0n /= => lt_i opp.
have := agree i lt_i; have := agree' i lt_i.
have in_order : nth 0%N (slip Q) i \in iota 0 (order Q).
  by have := mem_nth 0%N lt_i; rewrite mem_filter => /andP[].
rewrite /slip_of (scaled _ in_order).
case: (state_of rc.1 i) opp; case: (state_of rc'.1 i) => //= _.
- by move=> + xi; rewrite xi mulr0 ltxx.
- by move=> /eqP; rewrite mulf_eq0 (gt_eqF f0) /= => /eqP->; rewrite ltxx.
Qed.

Lemma inside_sound rc s : inside lo hi rc -> solution_of rc s -> between s.1 lo hi.
Proof.
case/and3P=> from2 lo2 /and4P[le_lo to2 hi2 le_hi] [[from to] _ _ _].
have from2_gt0 : 0 < toR (from_point rc.2).2 :> R by rewrite -(toR0 R) toR_lt.
have to2_gt0 : 0 < toR (to_point rc.2).2 :> R by rewrite -(toR0 R) toR_lt.
have lo2_ge0 : 0 <= toR lo.2 :> R by rewrite -(toR0 R) toR_le.
have hi2_ge0 : 0 <= toR hi.2 :> R by rewrite -(toR0 R) toR_le.
have le_lo' : toR lo.1 * toR (from_point rc.2).2 <= toR (from_point rc.2).1 * toR lo.2 :> R.
  by rewrite -!toRM toR_le.
have le_hi' : toR (to_point rc.2).1 * toR hi.2 <= toR hi.1 * toR (to_point rc.2).2 :> R.
  by rewrite -!toRM toR_le.
split.
  rewrite -(ler_pmul2r from2_gt0); apply: le_trans le_lo' _.
  by rewrite [X in _ <= X]mulrAC; apply: ler_wpmul2r.
rewrite -(ler_pmul2r to2_gt0); apply: le_trans le_hi'.
by rewrite mulrAC; apply: ler_wpmul2r.
Qed.

Lemma all_apartP nowhere l i j : all_apart n l -> (i < j)%N -> (j < size l)%N ->
  apart n (nth nowhere l i) (nth nowhere l j).
Proof.
elim: l i j => [|a l IH] i j //= /andP[all_a all_l].
case: j => // j; case: i => [|i] /= lt_ij lt_j; last exact: IH.
exact: (all_nthP nowhere all_a).
Qed.

Lemma position nowhere (l : seq (region * isolation)) rc :
  List.In rc l -> exists2 i, (i < size l)%N & nth nowhere l i = rc.
Proof.
elim: l => //= a l IH [->|/IH[i lt_i <-]]; first by exists 0%N.
by exists i.+1.
Qed.

Variables (w : elimination) (tr : tree (leaf whole)).

Theorem complete_exactly :
  check_complete Q w tr lo hi -> check_exactly n lo hi (found tr lo hi) ->
  exists l : seq (R * (nat -> R)), [/\ size l = size (found tr lo hi), solutions l,
    located (found tr lo hi) l &
    forall t x, solution Q t x -> between t lo hi ->
      exists2 i, (i < size l)%N & same_solution (nth nothing l i) (t, x)].
Proof.
move=> complete /andP[all_inside all_ap]; have [every each] := complete_sound R complete.
case: (found tr lo hi) all_inside all_ap every each => [|nowhere others] all_inside all_ap every each.
  by exists [::]; split=> // t x sol bt; have [rc] := every t x sol bt.
set regions := nowhere :: others in all_inside all_ap every each *.
have [l size_l of_l] := choose nowhere each.
exists l; split=> //; last 1 first.
- move=> t x sol bt; have [rc in_found reg] := every t x sol bt.
  have [i lt_i is_rc] := position nowhere in_found.
  exists i; first by rewrite size_l.
  by have [_ _ _] := of_l _ lt_i; apply=> //; rewrite is_rc.
- split=> [i|i j]; rewrite size_l => lt_i.
    have of_i := of_l _ lt_i; split; first by have [] := of_i.
    by apply: inside_sound of_i; apply: (all_nthP nowhere all_inside).
  move=> lt_j; apply: apart_sound (of_l _ (ltn_trans lt_i lt_j)) (of_l _ lt_j).
  exact: all_apartP.
move=> other i lt_i; rewrite (set_nth_default nowhere) //.
by have [] := of_l _ lt_i.
Qed.

End Sound.

Section Motions.

Variables (R : rcfType) (s : system) (u : unknown) (lo hi : point).
Implicit Types (l : seq (R * (nat -> R))).

(* A list of solutions x of the pencil, no two the same: the motion of each satisfies (9), and every
   motion with (9) and its value in the window is a positive multiple of one of them. *)
Definition lists_motions l :=
  [/\ solutions (pencil_of s u) lo hi l,
      forall i, (i < size l)%N ->
        satisfies_9 s u (nth (nothing R) l i).1 (motion s (nth (nothing R) l i).2) &
      forall t v, satisfies_9 s u t v -> between t lo hi -> exists2 i, (i < size l)%N &
        t = (nth (nothing R) l i).1 /\ same_motion s (motion s (nth (nothing R) l i).2) v].

(* Exactly so many motions satisfy (9) with a value in the window, up to positive factors. *)
Definition has_exactly count := exists2 l, size l = count & lists_motions l.

Variables (w : elimination) (tr : tree (leaf whole)).
Notation regions := (found tr lo hi).

Theorem system_exactly :
  check_system s u w tr lo hi -> check_exactly (size (slip (pencil_of s u))) lo hi regions ->
  exists l, [/\ size l = size regions, located (pencil_of s u) regions l & lists_motions l].
Proof.
case/andP=> wf complete exact.
have [l [size_l sols at_regions all_sols]] := complete_exactly R complete exact.
exists l; split=> //; split=> // [i /(proj1 sols)[sol _]|t v sat bt].
  exact/(system_pencil wf).
have [i lt_i [/= same_t prop]] := all_sols _ _ (solution_of_motion wf sat) bt.
have [f f0 scaled] := motion_proportional prop.
by exists i => //; split=> //; exists f => // d Hd; rewrite -scaled (system_onto wf sat).
Qed.

Corollary by_computation count :
  [&& check_system s u w tr lo hi,
      check_exactly (size (slip (pencil_of s u))) lo hi regions & size regions == count] ->
  has_exactly count.
Proof.
case/and3P=> checked exact /eqP <-.
by have [l [size_l _ listed]] := system_exactly checked exact; exists l.
Qed.

End Motions.
