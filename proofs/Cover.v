(* Soundness of a cover: what all leaves of a tree prove together.

   A leaf is one of

     Farkas w                w excludes every solution of the region (Farkas.v);
     Definite d low high     a form with weights d excludes every solution (Definite.v);
     Absent c                no null vector in a decided region (RootLeaf.v);
     Root h c o              one null vector, with the outcome o (RootLeaf.v);
     Claimed h c n           at most one null vector, that of the known solution n (Pinned.v);
     Infinite h c x          at most one null vector, and that one at infinity (Pinned.v);
     Whole w                 a statement about the pencil before condensation (Whole.v);
     Undecided               nothing is said about the region.

   The interval h of a leaf contains that of its region and may reach beyond it, where a value lies
   near an end of the region or at it.  What the leaf proves, it proves for the *extended region*:
   the interval h and the states of the region.

   A root leaf with the outcome "solution", and a claimed leaf whose moving set is the support of
   the known solution, yield: the extended region, and an interval of the value.  The leaves
   Undecided list their regions.

   Theorem [cover_sound]: if a tree is checked on a window, then
     1. every solution in the window lies in a region yielded or in an undecided region, and
     2. each region yielded has exactly one solution, up to a positive factor; its value lies
        between the two points that are yielded.
   [no_solution]: nothing yielded or undecided, no solution.  How many solutions these are is the
   matter of Number.v.

   Page: spec/certificates.md, 5.6 and 5.15.
   Rust: crates/check/src/cover/mod.rs, found.rs. *)

From Mceip Require Import Base Lists Integers Sums Tree Enclosed Farkas Covered Definite Root
  RootLeaf Pinned.

Definition interval := (point * point)%type.

(* A region with one solution, and an interval of its value. *)
Record yield := Yield { yield_region : region; yield_from : point; yield_to : point }.

(* What regions say of the solutions in a window, whatever a solution is, which vectors count as
   the same, and what it is to lie in a region. *)
Section Regions.

Variables (R : realFieldType) (solution : R -> (nat -> R) -> Prop).
Variables (same : (nat -> R) -> (nat -> R) -> Prop) (lies : region -> R -> (nat -> R) -> Prop).
Variables (lo hi : point).

(* The region has exactly one solution. *)
Definition has_one (y : yield) := exists t x,
  [/\ between t (yield_from y) (yield_to y), solution t x, lies (yield_region y) t x &
      forall t' x', solution t' x' -> lies (yield_region y) t' x' -> t' = t /\ same x x'].

Definition in_some (rs : seq region) t x := exists2 r, List.In r rs & lies r t x.

(* Each region has exactly one solution, and every solution lies in one of them or is an other. *)
Definition covers (ys : seq yield) (other : R -> (nat -> R) -> Prop) :=
  (forall t x, solution t x -> between t lo hi ->
     (exists2 y, List.In y ys & lies (yield_region y) t x) \/ other t x) /\
  forall y, List.In y ys -> has_one y.

(* As many different solutions as regions, one in each; every solution is one of them or an
   other. *)
Definition all_listed (ys : seq yield) (other : R -> (nat -> R) -> Prop) :=
  exists l : seq (R * (nat -> R)),
    [/\ size l = size ys,
        forall s, List.In s l -> solution s.1 s.2 /\ between s.1 lo hi,
        List.Forall2 (fun y s => between s.1 (yield_from y) (yield_to y) /\
                                 lies (yield_region y) s.1 s.2) ys l,
        List.ForallOrdPairs (fun s s' => ~ (s'.1 = s.1 /\ same s.2 s'.2)) l &
        forall t x, solution t x -> between t lo hi ->
          (exists2 s, List.In s l & t = s.1 /\ same s.2 x) \/ other t x].

Lemma covers_none : covers [::] (in_some [::]) ->
  forall t x, solution t x -> between t lo hi -> False.
Proof. by case=> every _ t x sol bt; case: (every t x sol bt) => -[]. Qed.

Lemma listed_weaken ys (other other' : R -> (nat -> R) -> Prop) :
  (forall t x, other t x -> other' t x) -> all_listed ys other -> all_listed ys other'.
Proof.
move=> weaker [l [sz sols vals pairs every]]; exists l; split=> // t x sol bt.
by case: (every t x sol bt) => [|/weaker]; [left | right].
Qed.

Definition no_other (t : R) (x : nat -> R) := False.

Lemma listed_none :
  all_listed [::] no_other -> forall t x, solution t x -> between t lo hi -> False.
Proof.
by case=> -[|m l] [//_ _ _ _ every] t x sol bt; case: (every t x sol bt) => [[]|].
Qed.

End Regions.

Arguments no_other {R} t x.

(* A list of solutions of one sort as one of another sort: each x that is good at its t becomes
   f x. *)
Section Transfer.

Variables (R : realFieldType) (solution solution' : R -> (nat -> R) -> Prop).
Variables (same same' : (nat -> R) -> (nat -> R) -> Prop).
Variables (lies lies' : region -> R -> (nat -> R) -> Prop).
Variables (good : R -> (nat -> R) -> Prop) (f : (nat -> R) -> nat -> R).
Variables other other' : R -> (nat -> R) -> Prop.

Hypothesis f_solution : forall t x, good t x -> solution t x -> solution' t (f x).
Hypothesis f_lies : forall r t x, good t x -> lies r t x -> lies' r t (f x).
Hypothesis f_same : forall t x x', good t x -> good t x' -> same' (f x) (f x') -> same x x'.
Hypothesis f_onto : forall t v, solution' t v -> exists x, [/\ solution t x,
  forall x', good t x' -> same x' x -> same' (f x') v & other t x -> other' t v].

Lemma listed_transfer lo hi ys :
  (forall y t x, List.In y ys -> solution t x -> lies (yield_region y) t x -> good t x) ->
  all_listed solution same lies lo hi ys other ->
  all_listed solution' same' lies' lo hi ys other'.
Proof.
move=> good_in [l [sz sols vals pairs every]].
have goods m : List.In m l -> good m.1 m.2.
  move=> m_in; have [y y_in [_ reg]] := Forall2_in vals m_in.
  by have [sol _] := sols m m_in; apply: good_in y_in sol reg.
exists [seq (m.1, f m.2) | m <- l]; split.
- by rewrite size_map.
- move=> m /List.in_map_iff[m' [<- m'_in]] /=; have [sol bt] := sols _ m'_in.
  by split=> //; apply: f_solution => //; apply: (goods m').
- elim: vals goods {sz sols pairs every} => [|y m ys' l' [bt reg] _ IH] goods /=; constructor.
    by split=> //; apply: f_lies => //; apply: (goods m); left.
  by apply: IH => m' m'_in; apply: goods; right.
- elim: pairs goods {sz sols vals every} => [|m l' different _ IH] goods /=; constructor.
    apply/List.Forall_forall => m' /List.in_map_iff[m2 [<- m2_in]] /= [eq_t is_same].
    have /List.Forall_forall/(_ _ m2_in) := different; apply; split=> //.
    apply: (f_same (t := m.1)) is_same; first by apply: (goods m); left.
    by rewrite -eq_t; apply: (goods m2); right.
  by apply: IH => m' m'_in; apply: goods; right.
move=> t v /f_onto[x [sol same_v other_v]] bt.
have [[m m_in [eq_t is_same]]|oth] := every t x sol bt; last by right; apply: other_v.
left; exists (m.1, f m.2); first by apply/List.in_map_iff; exists m.
by split=> //=; apply: same_v is_same; rewrite eq_t; apply: (goods m).
Qed.

End Transfer.

Section Cover.

(* Evidence about the whole pencil, of whatever kind. *)
Variable whole : Type.

Inductive leaf :=
  | Farkas of seq Z
  | Definite of seq Z & factor & factor
  | Absent of absence
  | Root of interval & isolation & outcome
  | Claimed of interval & pinning & nat
  | Infinite of interval & pinning & seq Z
  | Whole of whole
  | Undecided.

Definition extended (r : region) (h : interval) := Region h.1 h.2 (states r).

Definition reaches (r : region) (h : interval) :=
  [&& ordered h.1 h.2, point_le h.1 (lower r) & point_le (upper r) h.2].

Lemma in_extended (R : realFieldType) n r h t (x : nat -> R) :
  ordered (lower r) (upper r) -> reaches r h -> in_region n t x r -> in_region n t x (extended r h).
Proof.
move=> O /and3P[o le_lo le_hi] [bt ag]; split=> //.
exact: (between_wider O o le_lo le_hi bt).
Qed.

Definition window lo hi := Region lo hi [::].

(* A pencil of which only the order counts. *)
Definition enclosed_order n := Enclosed n [::] [::] [::] [::].

Definition nothing_known := Known zero zero [::] [::].

Section Checker.

(* [check_limit r k x]: x gives a null vector of B on the moving set of r, with x_k != 0. *)
Variables (P : enclosed) (solutions : seq known).
Variables (check_whole : region -> whole -> bool) (check_limit : region -> nat -> seq Z -> bool).

Definition known_at n := nth nothing_known solutions n.

Definition yielded (rl : region * leaf) : option yield :=
  match rl.2 with
  | Root h c Solution => Some (Yield (extended rl.1 h) (from_point c) (to_point c))
  | Claimed h c n =>
      let q := known_at n in
      if supports_region P rl.1 q then Some (Yield (extended rl.1 h) (known_from q) (known_to q))
      else None
  | _ => None
  end.

Definition yields (tr : tree leaf) (r : region) := pmap yielded (leaves tr r).

Definition undecided (tr : tree leaf) (r : region) :=
  pmap (fun rl => if rl.2 is Undecided then Some rl.1 else None) (leaves tr r).

Definition check_leaf (r : region) (l : leaf) : bool :=
  match l with
  | Farkas w => farkas P r w
  | Definite d low high => definite P d r low high
  | Absent c => check_absent P r c
  | Root h c o => reaches r h && check_root P (extended r h) c o
  | Claimed h c n =>
      [&& reaches r h, (n < size solutions)%N & check_claimed P (extended r h) c (known_at n)]
  | Infinite h c x =>
      [&& reaches r h, check_infinite P (extended r h) c & check_limit r (pin_pivot c) x]
  | Whole w => check_whole r w
  | Undecided => true
  end.

Definition check_cover (tr : tree leaf) (lo hi : point) :=
  check_tree (size_of P) check_leaf tr (window lo hi).

End Checker.

Section Sound.

Variable R : rcfType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.
Notation solves := (solves P A B).

Variable solutions : seq known.
Hypothesis known_sound : forall n, (n < size solutions)%N ->
  exists t x, is_known P A B (known_at solutions n) t x.

Variable check_whole : region -> whole -> bool.
Hypothesis whole_sound : forall r w (t : R) x,
  ordered (lower r) (upper r) -> check_whole r w -> in_region_of P t x r -> solves t x -> False.

Variable check_limit : region -> nat -> seq Z -> bool.
Hypothesis limit_sound : forall r k x, check_limit r k x -> exists2 xs : nat -> R,
  xs k != 0 & forall l, l \in moving P r -> \sum_(j <- moving P r) B l j * xs j = 0.

(* x' is a positive multiple of x. *)
Definition same_direction (x x' : nat -> R) :=
  exists2 f, 0 < f & forall i, i \in indices P -> x' i = f * x i.

(* A leaf excludes every solution, or it yields, or it is undecided. *)
Lemma leaf_sound r l t x :
  ordered (lower r) (upper r) -> check_leaf P solutions check_whole check_limit r l ->
  in_region_of P t x r -> solves t x ->
  (exists2 y, yielded P solutions (r, l) = Some y & in_region_of P t x (yield_region y)) \/
  l = Undecided.
Proof.
move=> O; case: l => [w|d low high|c|h c o|h c n|h c z|w|] /= ok reg sol; last by right.
- by case: (farkas_sound E O ok reg sol).
- by case: (definite_sound E O ok reg sol).
- have D : decided P r by case/and5P: ok.
  by case: (absent_sound E O D ok reg sol).
- case/andP: ok => rh /andP[iso signs]; have Oh : ordered h.1 h.2 by case/and3P: rh.
  have {}reg := in_extended O rh reg.
  case: o signs => [_|i /andP[iK neg]|i /and3P[Hi nm neg]].
  + by left; exists (Yield (extended r h) (from_point c) (to_point c)).
  + by case: (negative_x_sound (r := extended r h) E Oh iso iK neg reg sol).
  by case: (negative_y_sound (r := extended r h) E Oh iso Hi nm neg reg sol).
- case/and3P: ok => rh lt_n claimed; have Oh : ordered h.1 h.2 by case/and3P: rh.
  have {}reg := in_extended O rh reg.
  have [t0 [x0 sol0]] := known_sound lt_n.
  left; rewrite /yielded /=; case: ifP => [_|/negbT beside].
    by exists (Yield (extended r h) (known_from (known_at solutions n))
                     (known_to (known_at solutions n))).
  by case: (claimed_beside (r := extended r h) E Oh claimed sol0 beside sol reg).
- case/and3P: ok => rh infinite /limit_sound[xs xk Bx].
  have Oh : ordered h.1 h.2 by case/and3P: rh.
  by case: (infinite_sound (r := extended r h) E Oh infinite xk Bx sol (in_extended O rh reg)).
by case: (whole_sound O ok reg sol).
Qed.

Lemma in_window t (x : nat -> R) lo hi :
  between t lo hi -> in_region_of P t x (window lo hi).
Proof. by move=> bt; split=> // i _; rewrite /state_of nth_nil. Qed.

Section Checked.

Variables (tr : tree leaf) (lo hi : point).
Hypothesis checked : check_cover P solutions check_whole check_limit tr lo hi.
Notation found := (yields P solutions tr (window lo hi)).
Notation left_open := (undecided tr (window lo hi)).

Lemma every_solution_is_yielded t x : solves t x -> between t lo hi ->
  (exists2 y, List.In y found & in_region_of P t x (yield_region y)) \/
  (exists2 r, List.In r left_open & in_region_of P t x r).
Proof.
move=> sol bt.
have [[r l] in_leaves [reg O ok]] :=
  every_point_reaches_a_leaf checked (solution_ge0 sol) (in_window x bt).
have [[y yields_y reg_y]|l_open] := leaf_sound O ok reg sol.
  by left; exists y => //; apply/in_pmap; exists (r, l).
by right; exists r => //; apply/in_pmap; exists (r, l); rewrite // l_open.
Qed.

Lemma each_yield_has_one y :
  List.In y found -> has_one solves same_direction (fun r t x => in_region_of P t x r) y.
Proof.
case/in_pmap=> -[r l] in_leaves; rewrite /yielded /=.
have [/= O] := leaves_are_checked checked in_leaves.
case: l in_leaves => // [h c []|h c n] //= in_leaves.
  case/andP=> /and3P[Oh _ _] /andP[iso signs] [<-] /=.
  have [t [x [bt sol reg uniq]]] := solution_sound (r := extended r h) E Oh iso signs.
  by exists t, x; split=> // t' x' sol' reg'; have := uniq t' x' sol' reg'.
case/and3P=> /and3P[Oh _ _] lt_n claimed; case: ifP => // supports [<-] /=.
have [t [x sol0]] := known_sound lt_n.
have [reg uniq] := claimed_sound (r := extended r h) E Oh claimed sol0 supports.
by exists t, x; case: sol0 => bt sol _; split=> // t' x' sol' reg'; have := uniq t' x' sol' reg'.
Qed.

Theorem cover_sound :
  covers solves same_direction (fun r t x => in_region_of P t x r) lo hi found
    (in_some (fun r t x => in_region_of P t x r) left_open).
Proof. by split; [exact: every_solution_is_yielded | exact: each_yield_has_one]. Qed.

Theorem no_solution : found = [::] -> left_open = [::] ->
  forall t x, solves t x -> between t lo hi -> False.
Proof. by move=> none no_open; have := cover_sound; rewrite none no_open; apply: covers_none. Qed.

End Checked.

End Sound.

End Cover.
