(* Covers with support leaves: isolated solutions and families.

   The tree of a cover leaves the regions of its support leaves undecided (Cover.v); for each
   undecided region there is a support leaf (Support.v), or none if the region stays open.  What a
   support leaf holds is of two sorts:

     isolated   a value, root of p in [a, b], at which there is one solution up to a factor, and no
                other solution with these moving variables has its value in [a, b];
     family     every other place that holds something: an interval of values or one value, with a
                solution at each, and only one where the place is called alone.

   Regions yielded whose value belongs to a family with the same moving variables are dropped: the
   value is one more of that family.

   Theorem [cover_number]: of any cover with undecided regions it is said how many solutions there
   are; every other one belongs to a family or lies in an open region.  [supports_families]: at each
   value of a family there is a solution in its region, and any two are positive multiples of each
   other if the family is called alone.  [motions_number], [motions_hold] say the same of motions
   with (9).

   Page: spec/certificates.md, 5.12 (yields) and 5.15.
   Rust: crates/check/src/cover/support.rs, found.rs. *)

From Mceip Require Import Base Lists Integers Sums Tree Enclosed Covered Definite Root RootLeaf
  Pinned Cover Number Condensation Pencil Whole Claim Complete Signs Support System.

(* A place of a support leaf, with the region of the leaf. *)
Definition family := (region * holding)%type.

Section Checker.

Local Open Scope Z_scope.

Definition same_value (v v' : value) :=
  [&& value_from v =? value_from v', value_to v =? value_to v', value_den v =? value_den v' &
      same_poly (value_poly v) (value_poly v')].

(* a/b < c/d for the end of v and the start of v' *)
Definition ends_before (v v' : value) := value_to v * value_den v' <? value_from v' * value_den v.

(* No t of [from, to] of v, but v itself, lies in the place. *)
Definition away (v : value) (pl : place) :=
  match pl with
  | PointAt v' => [|| same_value v v', ends_before v v' | ends_before v' v]
  | Between v' v'' => ends_before v v' || ends_before v'' v
  | Above v' => ends_before v v'
  end.

Definition isolated_value (l : support_leaf) (h : holding) : option value :=
  match h with
  | Holding (PointAt v) true =>
      if all (fun h' => away v (held_place h')) (holdings l) then Some v else None
  | _ => None
  end.

Definition yield_of (r : region) (v : value) :=
  Yield (Region (start_of v) (end_of v) (states r)) (start_of v) (end_of v).

Definition isolated_in (r : region) (l : support_leaf) : seq yield :=
  pmap (fun h => omap (yield_of r) (isolated_value l h)) (holdings l).

Definition families_in (r : region) (l : support_leaf) : seq family :=
  [seq (r, h) | h <- holdings l & ~~ isSome (isolated_value l h)].

Definition pairs (rs : seq region) (ls : seq (option support_leaf)) := zip rs ls.

Definition check_supports (Q : pencil) rs ls :=
  (size rs == size ls) &&
  all (fun rl => if rl.2 is Some l then ordered (lower rl.1) (upper rl.1) && check_support Q rl.1 l
                 else true) (pairs rs ls).

Definition isolated_of rs ls : seq yield :=
  flatten [seq if rl.2 is Some l then isolated_in rl.1 l else [::] | rl <- pairs rs ls].

Definition families_of rs ls : seq family :=
  flatten [seq if rl.2 is Some l then families_in rl.1 l else [::] | rl <- pairs rs ls].

Definition open_of rs ls : seq region :=
  pmap (fun rl => if rl.2 is Some _ then None else Some rl.1) (pairs rs ls).

(* The value of y, and so its solution, belongs to the family; n complementarity variables. *)
Definition belongs n (y : yield) (f : family) :=
  match held_place f.2 with
  | PointAt v => rational v && within (value_of y) (start_of v, end_of v)
  | Between v v' =>
      point_lt (end_of v) (yield_from y) && point_lt (yield_to y) (start_of v')
  | Above v => point_lt (end_of v) (yield_from y)
  end && all_same n (yield_region y) f.1.

End Checker.

(* Solutions of a family, and what is not in a list: families, and solutions in open regions. *)
Section Unlisted.

Variables (R : rcfType) (lies : region -> R -> (nat -> R) -> Prop).

Definition in_family (f : family) t x := lies f.1 t x /\ in_place (held_place f.2) t.

Definition unlisted (fs : seq family) (rs : seq region) t x :=
  (exists2 f, List.In f fs & in_family f t x) \/ in_some lies rs t x.

(* Each value of the place has a solution in the region, and only one where it is called alone. *)
Definition family_solved (solution : R -> (nat -> R) -> Prop)
    (same : (nat -> R) -> (nat -> R) -> Prop) (f : family) :=
  is_place R (held_place f.2) /\
  forall t, in_place (held_place f.2) t ->
    (exists x, solution t x /\ lies f.1 t x) /\
    (held_alone f.2 -> forall x x', solution t x -> lies f.1 t x ->
       solution t x' -> lies f.1 t x' -> same x x').

Lemma unlisted_none t x : unlisted [::] [::] t x -> False.
Proof. by case=> -[]. Qed.

End Unlisted.

Section Sound.

Variables (R : rcfType) (Q : pencil).
Implicit Types (t : R) (x : nat -> R).
Notation ns := (size (slip Q)).

(* What is said about a family. *)
Definition family_holds := family_solved (lies_in Q) (solution Q) (proportional (R := R) Q).

Lemma same_value_is v v' (s : R) : same_value v v' -> is_value v' s -> is_value v s.
Proof.
case/and4P=> /Z.eqb_spec f /Z.eqb_spec t /Z.eqb_spec d /(same_polyE s) p [as_ sb root_s].
by split; rewrite ?f ?t ?d ?p.
Qed.

(* t in the interval of v, and s at or above the start of v'. *)
Lemma away_sound v pl t : check_value v -> place_checked pl -> away v pl ->
  toR (value_from v) <= toR (value_den v) * t -> toR (value_den v) * t <= toR (value_to v) ->
  in_place pl t -> is_value v t.
Proof.
move=> ok; have [_ _ d0 _] := value_parts R ok; case: pl => [v'|v' v''|v'] /=.
- move=> ok'; have [_ _ d0' _] := value_parts R ok'.
  case/or3P=> [same|lt|lt] at_ tb is_t; first exact: same_value_is same is_t.
    by case: is_t => as_ _ _; have := before_sound d0 d0' lt tb as_; rewrite ltxx.
  by case: is_t => _ sb _; have := before_sound d0' d0 lt sb at_; rewrite ltxx.
- case/andP=> ok' ok''; have [_ _ d0' _] := value_parts R ok'.
  have [_ _ d0'' _] := value_parts R ok''.
  have [s' is_s'] := value_exists R ok'; have [s'' is_s''] := value_exists R ok''.
  case/orP=> lt at_ tb [/(_ _ is_s') st /(_ _ is_s'') ts].
    case: is_s' => as_ _ _; have := before_sound d0 d0' lt tb as_.
    by rewrite ltNge (ltW st).
  case: is_s'' => _ sb _; have := before_sound d0'' d0 lt sb at_.
  by rewrite ltNge (ltW ts).
move=> ok'; have [_ _ d0' _] := value_parts R ok'.
have [s' is_s'] := value_exists R ok' => lt at_ tb /(_ _ is_s') st.
case: is_s' => as_ _ _; have := before_sound d0 d0' lt tb as_.
by rewrite ltNge (ltW st).
Qed.

Section Leaf.

Variables (r : region) (l : support_leaf).
Hypothesis O : ordered (lower r) (upper r).
Hypothesis checked : check_support Q r l.

Lemma holding_checked h : List.In h (holdings l) ->
  place_checked (held_place h) /\ inside r (held_place h).
Proof.
case/in_holdings=> -[pl [f|b]] // pe_in [<-] /=; case/and5P: checked => _ _ _ _ reasons.
by have /andP[? /and3P[]] : check_reason Q r pl (Solved b) := all_In reasons pe_in.
Qed.

Lemma isolated_sound h v : List.In h (holdings l) -> isolated_value l h = Some v ->
  one_solution_in R Q (yield_of r v) /\
  forall t x, lies_in Q r t x -> in_place (held_place h) t ->
    lies_in Q (yield_region (yield_of r v)) t x.
Proof.
move=> h_in; have [ok ins] := holding_checked h_in.
have [is_pl each] := support_holds R O checked h_in.
case: h h_in ok ins is_pl each => -[v'|v' v''|v'] [] //= h_in ok ins _ each.
case: ifP => // isolated [eq_v]; move: h_in ok ins each isolated; rewrite {v'}eq_v.
move=> h_in ok ins each isolated.
have [_ ab d0 _] := value_parts R ok; have [s is_s] := value_exists R ok.
have [[x [sol [bt ag]]] alone] := each s is_s.
have in_interval t : is_value v t -> between t (start_of v) (end_of v).
  by case=> at_ tb _; split; rewrite /= mulrC.
split; last first.
  by move=> t y [_ ag'] at_t; split=> //; apply: in_interval.
exists s, x; split=> //; first exact: in_interval.
  by split=> //; apply: in_interval.
move=> t' x' sol' [[/= at' t'b] ag']; rewrite mulrC in at'; rewrite mulrC in t'b.
have bt' : between t' (lower r) (upper r).
  have [p0 q0 p0' q0'] := ordered_ge0 R O.
  case/andP: ins => /Z.leb_spec0 lo /Z.leb_spec0 hi; split.
    rewrite -(ler_pmul2r d0) -toRM.
    apply: (@le_trans _ _ (toR (value_from v * (lower r).2)%Z)).
      by rewrite toR_le; apply/Z.leb_spec0.
    by rewrite toRM mulrAC ler_wpmul2r // mulrC.
  rewrite -(ler_pmul2r d0) -toRM.
  apply: (@le_trans _ _ (toR (value_to v * (upper r).2)%Z)); last first.
    by rewrite toR_le; apply/Z.leb_spec0.
  by rewrite toRM mulrAC ler_wpmul2r // mulrC.
have sol_in' : solution_in Q r t' x' by [].
have is_t' : is_value v t'.
  have [h' h'_in at_h'] := support_covers O checked sol_in'.
  have [ok' _] := holding_checked h'_in.
  exact: away_sound ok ok' (all_In isolated h'_in) at' t'b at_h'.
have eq_t := value_unique ok is_s is_t'; split=> //.
by apply: (alone isT x x') => //; rewrite /solution_in eq_t.
Qed.

Lemma leaf_covers t x : solution Q t x -> lies_in Q r t x ->
  (exists2 y, List.In y (isolated_in r l) & lies_in Q (yield_region y) t x) \/
  (exists2 f, List.In f (families_in r l) & in_family (lies_in Q) f t x).
Proof.
move=> sol reg; have [h h_in at_h] := support_covers O checked (conj sol reg).
case iso: (isolated_value l h) => [v|].
  left; exists (yield_of r v); last by have [_ into] := isolated_sound h_in iso; apply: into.
  by apply/in_pmap; exists h; rewrite // iso.
right; exists (r, h) => //; apply/List.in_map_iff; exists h; split=> //.
by apply/in_filter; rewrite iso.
Qed.

End Leaf.

Variables (rs : seq region) (ls : seq (option support_leaf)).
Hypothesis checked : check_supports Q rs ls.

Lemma leaf_checked r l : List.In (r, Some l) (zip rs ls) ->
  ordered (lower r) (upper r) /\ check_support Q r l.
Proof.
by move=> rl; case/andP: checked => _ every; have /andP[] := all_In every rl.
Qed.

Theorem supports_cover r t x : List.In r rs -> solution Q t x -> lies_in Q r t x ->
  (exists2 y, List.In y (isolated_of rs ls) & lies_in Q (yield_region y) t x) \/
  unlisted (lies_in Q) (families_of rs ls) (open_of rs ls) t x.
Proof.
move=> r_in sol reg; have /andP[/eqP sz _] := checked.
have [[l|] rl] := in_zip sz r_in; last first.
  by right; right; exists r => //; apply/in_pmap; exists (r, None).
have [O ok] := leaf_checked rl.
case: (leaf_covers O ok sol reg) => -[y y_in reg_y].
  by left; exists y => //; apply/in_flatten_map; exists (r, Some l).
by right; left; exists y => //; apply/in_flatten_map; exists (r, Some l).
Qed.

Theorem supports_isolated y : List.In y (isolated_of rs ls) -> one_solution_in R Q y.
Proof.
case/in_flatten_map=> -[r [l|]] //= rl; have [O ok] := leaf_checked rl.
case/in_pmap=> h h_in; case iso: (isolated_value l h) => [v|] //= [<-].
by have [] := isolated_sound O ok h_in iso.
Qed.

Lemma family_inside f : List.In f (families_of rs ls) ->
  place_checked (held_place f.2) /\
  forall t, in_place (held_place f.2) t -> between t (lower f.1) (upper f.1).
Proof.
case/in_flatten_map=> -[r [l|]] //= rl; have [O ok] := leaf_checked rl.
case/List.in_map_iff=> h [<- /in_filter[h_in _]].
have [ok_h ins] := holding_checked ok h_in.
by split=> //; have [_ bt] := inside_sound R O ok_h ins.
Qed.

Lemma belongs_sound y f t x : List.In f (families_of rs ls) -> belongs ns y f ->
  between t (yield_from y) (yield_to y) -> lies_in Q (yield_region y) t x ->
  in_family (lies_in Q) f t x.
Proof.
move=> f_in /andP[inside states] bt [_ ag]; have [ok into] := family_inside f_in.
suff at_t : in_place (held_place f.2) t.
  by split=> //; split; [apply: into | apply: same_states_agree states ag].
have after v : check_value v -> point_lt (end_of v) (yield_from y) ->
    forall s, is_value v s -> s < t.
  move=> ok_v lt s [_ sb _]; rewrite ltNge; apply/negP => ts.
  have [_ _ d0 _] := value_parts R ok_v; case: bt => from_t _.
  apply: (point_lt_sound lt (t := t) _ from_t erefl).
  by rewrite /= mulrC (le_trans _ sb) // ler_pmul2l.
have before v : check_value v -> point_lt (yield_to y) (start_of v) ->
    forall s, is_value v s -> t < s.
  move=> ok_v lt s [as_ _ _]; rewrite ltNge; apply/negP => st.
  have [_ _ d0 _] := value_parts R ok_v; case: bt => _ t_to.
  apply: (point_lt_sound lt t_to (t' := t) _ erefl).
  by rewrite /= mulrC (le_trans as_) // ler_pmul2l.
move: ok inside; case: (held_place f.2) => [v|v v'|v] /=.
- move=> ok /andP[rat win]; have [s is_s] := value_exists R ok.
  have [/= at_ tb] := within_between win bt.
  by rewrite (rational_value ok rat is_s (t := t)) // mulrC.
- by case/andP=> ok ok' /andP[lt lt']; split; [apply: after | apply: before].
by move=> ok lt; apply: after.
Qed.

Theorem supports_families f : List.In f (families_of rs ls) -> family_holds f.
Proof.
case/in_flatten_map=> -[r [l|]] //= rl; have [O ok] := leaf_checked rl.
case/List.in_map_iff=> h [<- /in_filter[h_in _]].
have [is_pl each] := support_holds R O ok h_in; split=> // t /each[[x sol] alone]; split.
  by exists x.
by move=> al x1 x2 sol1 reg1 sol2 reg2; apply: (alone al).
Qed.

End Sound.

(* Any cover that yields regions with one solution each, and leaves the regions rs undecided. *)
Section Cover.

Variables (R : rcfType) (Q : pencil) (lo hi : point).
Variables (yields : seq yield) (rs : seq region) (ls : seq (option support_leaf)).

Notation ns := (size (slip Q)).
Notation families := (families_of rs ls).
Notation candidates := (yields ++ isolated_of rs ls).

Hypothesis supports : check_supports Q rs ls.
Hypothesis cover :
  covers (solution Q) (proportional Q) (lies_in Q) lo hi yields (in_some (R := R) (lies_in Q) rs).

Theorem cover_number ys :
  distinct_yields ns lo hi [seq y <- candidates | ~~ has (belongs ns y) families] = Some ys ->
  all_listed (solution Q) (proportional Q) (lies_in Q) lo hi ys
    (unlisted (R := R) (lies_in Q) families (open_of rs ls)).
Proof.
have [every each] := cover.
have one_each y : List.In y candidates -> one_solution_in R Q y.
  by case/in_cat_or=> [/each|/(supports_isolated R supports)].
pose kept := [seq y <- candidates | ~~ has (belongs ns y) families].
have kept_or_family y (t : R) x : List.In y candidates -> solution Q t x ->
    lies_in Q (yield_region y) t x ->
    (exists2 y, List.In y kept & lies_in Q (yield_region y) t x) \/
    unlisted (lies_in Q) families (open_of rs ls) t x.
  move=> y_in sol reg; case of_family: (has (belongs ns y) families).
    have [f f_in bel] := has_In of_family.
    have [t0 [x0 [bt _ _ uniq]]] := one_each y y_in; have [eq_t _] := uniq t x sol reg.
    right; left; exists f => //; apply: (belongs_sound supports f_in bel) => //.
    by rewrite eq_t.
  by left; exists y => //; apply/in_filter; rewrite of_family.
apply: (distinct_listed (@proportional_slip R Q) (@proportional_sym R Q)
  (@proportional_trans R Q)); split=> [t x sol bt|y /in_filter[/one_each]] //.
case: (every t x sol bt) => -[y y_in reg].
  by apply: (kept_or_family y) => //; apply/in_cat_or; left.
have [[y' y'_in reg']|] := supports_cover supports y_in sol reg; last by right.
by apply: (kept_or_family y') => //; apply/in_cat_or; right.
Qed.

End Cover.

(* The motions of the solutions that a cover lists. *)
Section Motions.

Variables (R : rcfType) (s : system) (u : unknown) (lo hi : point).
Hypothesis wf : system_wellformed s u.

Notation Q := (pencil_of s u).

Lemma motions_number ys fs rs :
  all_listed (solution Q) (proportional Q) (lies_in Q) lo hi ys
    (unlisted (R := R) (lies_in Q) fs rs) ->
  all_listed (satisfies_9 s u) (same_motion s) (motion_in s u) lo hi ys
    (unlisted (R := R) (motion_in s u) fs rs).
Proof. exact: motions_listed. Qed.

Lemma motions_hold f : family_holds R Q f ->
  family_solved (motion_in s u) (satisfies_9 s u) (same_motion (R := R) s) f.
Proof.
case=> is_pl each; split=> // t /each[[x [sol reg]] alone]; split.
  exists (motion s x); split; first exact/(system_pencil wf).
  exact: (lies_in_motion wf).
move=> al v v' sat reg_v sat' reg_v'.
have prop : proportional Q (variables_of s v) (variables_of s v').
  by apply: (alone al) => //; apply: solution_of_motion.
have [c c0 scaled] := motion_proportional prop.
by exists c => // d Hd; rewrite -(system_onto wf sat') // scaled (system_onto wf sat).
Qed.

End Motions.
