(* How many solutions there are: which of the regions yielded hold the same one.

   A cover yields regions with exactly one solution each, and an interval [from, to] for its value
   (Cover.v).  Regions may reach beyond their leaves, so two of them may hold the same solution.
   Two yields f and g with the same states hold

     the same solution   if [from, to] of one of them lies in the interval of the region of the
                         other: the solution of f is in the region of g, which has only one;
     different ones      if [from, to] of f and [from, to] of g have no common point.

   If a variable rests in one region and moves in the other, the solutions differ.  [distinct] goes
   through a list of yields, drops those that hold the solution of an earlier one, and gives up if
   neither test decides.

   Theorem [distinct_sound]: if the list that is kept has N members, there are N solutions in the
   window, one in each region kept, no two of them equal, and the solution of each region of the
   list given is one of them.  [distinct_listed]: the same for a cover ([covers], Cover.v).

   The theorem does not depend on what a solution is: [solution] t x is any property, and
   [multiple] x x', for solutions of one value, says that they are positive multiples.

   Page: spec/certificates.md, 5.15 (solutions yielded twice).
   Rust: crates/check/src/cover/found.rs. *)

From Mceip Require Import Base Lists Integers Sums Tree Enclosed RootLeaf Pinned Cover.

Section Checker.

(* The number of complementarity variables, and the window. *)
Variables (n : nat) (lo hi : point).

Definition same_state a b :=
  match a, b with
  | Open, Open | Resting, Resting | Moving, Moving => true
  | _, _ => false
  end.

Definition opposite_state a b :=
  match a, b with Resting, Moving | Moving, Resting => true | _, _ => false end.

Definition some_opposite (r r' : region) :=
  has (fun i => opposite_state (state_of r i) (state_of r' i)) (iota 0 n).

Definition all_same (r r' : region) :=
  all (fun i => same_state (state_of r i) (state_of r' i)) (iota 0 n).

Definition within (inner outer : interval) :=
  [&& ordered inner.1 inner.2, ordered outer.1 outer.2, point_le outer.1 inner.1 &
      point_le inner.2 outer.2].

Definition ends (r : region) : interval := (lower r, upper r).
Definition value_of (y : yield) : interval := (yield_from y, yield_to y).

(* a < b *)
Definition point_lt (a b : point) :=
  [&& (0 <=? a.2)%Z, (0 <=? b.2)%Z & (a.1 * b.2 <? b.1 * a.2)%Z].

(* The comparison of the values comes first: it is cheap, and it decides for most pairs. *)
Definition same_solution (f g : yield) :=
  (within (value_of f) (ends (yield_region g)) || within (value_of g) (ends (yield_region f))) &&
  all_same (yield_region f) (yield_region g).

Definition different_solutions (f g : yield) :=
  [|| point_lt (yield_to f) (yield_from g), point_lt (yield_to g) (yield_from f) |
      some_opposite (yield_region f) (yield_region g)].

(* The yields with different solutions; None if the tests do not tell. *)
Fixpoint distinct (seen kept rest : seq yield) : option (seq yield) :=
  match rest with
  | [::] => Some kept
  | y :: rest' =>
      if has (same_solution y) seen then distinct (y :: seen) kept rest'
      else if within (value_of y) (lo, hi) && all (different_solutions y) kept then
        distinct (y :: seen) (y :: kept) rest'
      else None
  end.

Definition distinct_yields := distinct [::] [::].

End Checker.

Section Sound.

Variable R : rcfType.
Implicit Types (t : R) (x : nat -> R).

Variables (n : nat) (lo hi : point).

(* The complementarity variables of x; what a solution is; which ones count as one. *)
Variable slip_part : (nat -> R) -> nat -> R.
Variable solution : R -> (nat -> R) -> Prop.
Variable multiple : (nat -> R) -> (nat -> R) -> Prop.

Hypothesis multiple_slip : forall x x', multiple x x' ->
  exists2 f, 0 < f & forall i, (i < n)%N -> slip_part x' i = f * slip_part x i.
Hypothesis multiple_sym : forall x x', multiple x x' -> multiple x' x.
Hypothesis multiple_trans : forall x y z, multiple x y -> multiple y z -> multiple x z.

Definition pair_of_solution := (R * (nat -> R))%type.

(* Two solutions are one: the same value, and positive multiples. *)
Definition one_solution (s s' : pair_of_solution) := s'.1 = s.1 /\ multiple s.2 s'.2.

(* s is the solution of y. *)
Definition the_solution (y : yield) (s : pair_of_solution) :=
  [/\ between s.1 (yield_from y) (yield_to y), solution s.1 s.2,
      in_region n s.1 (slip_part s.2) (yield_region y) &
      forall t' x', solution t' x' -> in_region n t' (slip_part x') (yield_region y) ->
        one_solution s (t', x')].

(* A list of solutions, one of each yield of a list; no two of them are one. *)
Definition solutions_of (ys : seq yield) (l : seq pair_of_solution) :=
  List.Forall2 the_solution ys l /\
  List.ForallOrdPairs (fun s s' => ~ one_solution s s') l.

Lemma one_sym s s' : one_solution s s' -> one_solution s' s.
Proof. by case=> eq_t m; split; [rewrite eq_t | exact: multiple_sym]. Qed.

Lemma one_trans s1 s2 s3 : one_solution s1 s2 -> one_solution s2 s3 -> one_solution s1 s3.
Proof.
by case=> t12 x12 [t23 x23]; split; [rewrite t23 | exact: multiple_trans x12 x23].
Qed.

Lemma within_between inner outer t : within inner outer -> between t inner.1 inner.2 ->
  between t outer.1 outer.2.
Proof. by case/and4P=> o o' le1 le2; apply: between_wider. Qed.

Lemma point_lt_sound a b t t' :
  point_lt a b -> t * toR a.2 <= toR a.1 -> toR b.1 <= t' * toR b.2 -> t = t' -> False.
Proof.
case/and3P=> a2 b2 lt t_a b_t' eq_t; rewrite -eq_t in b_t'.
have {}a2 : 0 <= toR a.2 :> R by rewrite toR_ge0.
have {}b2 : 0 <= toR b.2 :> R by rewrite toR_ge0.
have := ler_wpmul2r b2 t_a; have := ler_wpmul2r a2 b_t'.
rewrite -[toR b.1 * _]toRM -[toR a.1 * _]toRM => le1 le2.
have : toR (a.1 * b.2)%Z < toR (b.1 * a.2)%Z :> R by rewrite toR_lt.
by rewrite ltNge (le_trans le1) // mulrAC.
Qed.

Lemma same_states_agree r r' x : all_same n r r' -> agrees n r x -> agrees n r' x.
Proof.
move/allP=> same ag i lt_i; have := ag i lt_i; have := same i; rewrite mem_iota add0n lt_i.
by move/(_ isT); case: state_of; case: state_of.
Qed.

Lemma all_same_sym r r' : all_same n r r' -> all_same n r' r.
Proof. by move/allP=> s; apply/allP=> i /s; case: state_of; case: state_of. Qed.

Lemma same_sound f g s s' : same_solution n f g -> the_solution f s -> the_solution g s' ->
  one_solution s s'.
Proof.
move=> /andP[inside states] [bt sol reg uniq] [bt' sol' reg' uniq'].
case/orP: inside => w.
  apply/one_sym; case: s {uniq} bt sol reg => t x /= bt sol [_ ag].
  by apply: uniq' => //; split; [exact: within_between w bt | exact: same_states_agree ag].
case: s' {uniq'} bt' sol' reg' => t x /= bt' sol' [_ ag].
apply: uniq => //; split; first exact: within_between w bt'.
exact: same_states_agree (all_same_sym states) ag.
Qed.

Lemma different_sound f g s s' : different_solutions n f g -> the_solution f s ->
  the_solution g s' -> ~ one_solution s s'.
Proof.
move=> diff [[from_t t_to] _ [_ ag] _] [[from_t' t_to'] _ [_ ag'] _] [eq_t /multiple_slip].
case=> c c0 scaled; case/or3P: diff => [lt|lt|/hasP[i]].
- exact: (point_lt_sound lt t_to from_t' (esym eq_t)).
- exact: (point_lt_sound lt t_to' from_t eq_t).
rewrite mem_iota add0n => /= lt_i; have := ag i lt_i; have := ag' i lt_i; rewrite scaled //.
case: (state_of (yield_region f) i); case: (state_of (yield_region g) i) => //= + + _.
  by move=> + x0; rewrite x0 mulr0 ltxx.
by move=> /eqP; rewrite mulf_eq0 gt_eqF //= => /eqP->; rewrite ltxx.
Qed.

(* Every solution in the region of y is one of l. *)
Definition covered_by (l : seq pair_of_solution) (y : yield) := forall t x,
  solution t x -> in_region n t (slip_part x) (yield_region y) ->
  exists2 s, List.In s l & one_solution s (t, x).

Lemma Forall2_size (p : yield -> pair_of_solution -> Prop) ys l : List.Forall2 p ys l ->
  size ys = size l.
Proof. by elim=> //= y s ys' l' _ _ ->. Qed.

Lemma Forall2_impl (p q : yield -> pair_of_solution -> Prop) ys l :
  (forall y s, p y s -> q y s) -> List.Forall2 p ys l -> List.Forall2 q ys l.
Proof. by move=> pq; elim=> [|y s ys' l' /pq]; constructor. Qed.

Lemma distinct_invariant seen kept rest ys l :
  (forall y, List.In y rest -> exists s, the_solution y s) ->
  (forall y, List.In y seen -> covered_by l y /\ exists s, the_solution y s) ->
  solutions_of kept l -> (forall y, List.In y kept -> within (value_of y) (lo, hi)) ->
  distinct n lo hi seen kept rest = Some ys ->
  exists l', [/\ solutions_of ys l', forall y, List.In y ys -> within (value_of y) (lo, hi) &
    forall y, List.In y seen \/ List.In y rest -> covered_by l' y].
Proof.
elim: rest seen kept l => [|y rest IH] seen kept l has_one in_seen sol_kept win /=.
  by case=> <-; exists l; split=> // y [/in_seen[]|].
have rest_one y' : List.In y' rest -> exists s, the_solution y' s.
  by move=> y'r; apply: has_one; right.
have [s sol_y] := has_one y (or_introl erefl).
have move_y (Q : yield -> Prop) :
    (forall y', (y = y' \/ List.In y' seen) \/ List.In y' rest -> Q y') ->
    forall y', List.In y' seen \/ (y = y' \/ List.In y' rest) -> Q y'.
  by move=> H y' [?|[?|?]]; apply: H; [left; right | left; left | right].

(* The solution of an earlier one. *)
case: ifP => [/has_In[y' y'_seen same] dist|_].
  have [|l' [sol' win' all']] := IH (y :: seen) _ l rest_one _ sol_kept win dist.
    move=> z /= [<-|/in_seen //]; split; last by exists s.
    move=> t x sol reg; have [cov [s' sol_y']] := in_seen _ y'_seen.
    have one := same_sound same sol_y sol_y'; have [_ _ _ uniq] := sol_y.
    case: s' sol_y' one => t' x' [_ /= sol' reg' _] one.
    have [s'' s''l one''] := cov _ _ sol' reg'; exists s'' => //.
    exact: one_trans (one_trans one'' (one_sym one)) (uniq _ _ sol reg).
  by exists l'; split=> //; apply: move_y.

(* Another solution. *)
case: ifP => // /andP[win_y diff] dist.
have [| | |l' [sol' win' all']] := IH (y :: seen) (y :: kept) (s :: l) rest_one _ _ _ dist.
- move=> z /= [<-|/in_seen[cov one]]; last first.
    by split=> // t x sol reg; have [s' s'l o] := cov t x sol reg; exists s' => //; right.
  split; last by exists s.
  by move=> t x sol reg; exists s; [left | have [_ _ _ uniq] := sol_y; exact: uniq].
- case: sol_kept => each pairs; split; first by constructor.
  constructor=> //; apply/List.Forall_forall => s' /(Forall2_in each)[y' y'_kept sol_y'].
  exact: (different_sound (all_In diff y'_kept) sol_y sol_y').
- by move=> z /= [<-|/win].
by exists l'; split=> //; apply: move_y.
Qed.

Theorem distinct_sound found ys :
  (forall y, List.In y found -> exists s, the_solution y s) ->
  distinct_yields n lo hi found = Some ys ->
  exists l, [/\ solutions_of ys l, forall s, List.In s l -> between s.1 lo hi &
    forall y, List.In y found -> covered_by l y].
Proof.
move=> has_one dist.
have nothing : solutions_of [::] [::] by split; constructor.
have none (Q : yield -> Prop) : forall y, List.In y [::] -> Q y by [].
have [l [sol win all_found]] := distinct_invariant has_one (none _) nothing (none _) dist.
exists l; split=> // [s sl|y y_found]; last by apply: all_found; right.
have [y /win win_y [bt _ _ _]] := Forall2_in (proj1 sol) sl.
exact: within_between win_y bt.
Qed.

(* Lists the solutions that a cover yields. *)
Corollary distinct_listed found other ys :
  covers solution multiple (fun r t x => in_region n t (slip_part x) r) lo hi found other ->
  distinct_yields n lo hi found = Some ys ->
  all_listed solution multiple (fun r t x => in_region n t (slip_part x) r) lo hi ys other.
Proof.
move=> [every each] dist.
have has_one y : List.In y found -> exists s, the_solution y s.
  by move/each=> [t [x [bt sol reg uniq]]]; exists (t, x); split.
have [l [[sols pairs] win all_found]] := distinct_sound has_one dist.
exists l; split=> //.
- exact/esym/(Forall2_size sols).
- by move=> s sl; have [y _ [_ sol _ _]] := Forall2_in sols sl; split=> //; apply: win.
- by apply: Forall2_impl sols => y s [bt _ reg _].
move=> t x sol bt; have [[y y_in reg]|] := every t x sol bt; last by right.
by left; have [s sl one] := all_found y y_in t x sol reg; exists s.
Qed.

End Sound.
