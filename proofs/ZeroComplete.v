(* Complete sets of systems with particles in contact with zero reaction (z).

   A cover of such a system is one of the pencil of ZeroPencil.v, of which only the split solutions
   belong to motions: those with right = 0 or left = 0 at each particle.  The tree may leave a
   region undecided because right and left of one particle both move in it: no split solution is
   there.  Such a region is not open ([both_halves]).

   Where the gap and one half move, the row of the other half is 0 at each solution, and no root
   leaf can show it.  The tree leaves the region undecided, and beside it stands an enclosed claim
   about the system (ZeroEnclosed.v), with a leaf that shows that the region has no other solution
   (Pinned.v): [pinned_box].  All other undecided regions have a support leaf or are open, as in
   Families.v.

   A root leaf may refer to a claim about the pencil, as in Complete.v.

   Of the regions with a solution and of the families it is demanded that of right and left of each
   particle one is at rest ([halves_apart]).

   Theorem [zero_complete_number]: if the check succeeds and [zero_solutions] gives a list of N
   regions, then there are N motions with (9) with z particles and a value in the window, one in
   each of them and no two of them equal; every other such motion belongs to a family or lies in an
   open region.  [zero_none]: no regions, no families, nothing open, no motion.
   [zero_complete_hold]: at each value of a family there is a motion in its region, and only one,
   up to a positive factor, where the family is called alone.
   [zero_varying_number], [zero_varying_none], [zero_varying_hold]: the same by condensation about
   anchors.

   Page: spec/certificates.md, 5.6, 5.11, 5.15; spec/zero-reaction.md, Z.3 (covers).
   Rust: crates/check/src/cover/walk.rs, root.rs. *)

From Mceip Require Import Base Lists Integers Sums Tree Enclosed Covered Definite Root RootLeaf
  Pinned Cover Number Condensation Pencil Whole Claim EnclosedClaim Complete Signs Support System
  Families Varying Covers ZeroReaction ZeroPencil ZeroEnclosed.

(* A claim that stands beside a region. *)
Record pinned_box := PinnedBox {
  box_interval : interval;
  near_anchor : nat;  (* where the free rows depend on the unknown: its anchor, *)
  near_grain : Z;     (* and the grain of its local pencil *)
  box_pinning : pinning;
  box_claim : enclosed_claim }.

Section Checker.

Variables (z : zero_system) (u : unknown).

Notation Q := (zero_pencil z u).
Notation ns := (size (slip Q)).
Notation nz := (size (zero_particles z)).

(* The solution of an enclosed claim. *)
Definition known_box (b : pinned_box) :=
  Known (box_from (box_claim b)) (box_to (box_claim b))
    (positions Q (box_support (box_claim b))) [::].

Definition pinned_yield (r : region) (b : pinned_box) :=
  Yield (extended r (box_interval b)) (box_from (box_claim b)) (box_to (box_claim b)).

(* The region has at most one solution, that of the claim. *)
Definition pinned_alone P (r : region) (b : pinned_box) :=
  check_claimed P r (box_pinning b) (known_box b).

Definition pinned_about w families (r : region) (b : pinned_box) :=
  at_anchor w families (near_anchor b) r
    (claim_at Q (near_grain b) (box_pinning b) (known_box b)).

Definition check_pinned (alone : region -> pinned_box -> bool) (r : region) (b : pinned_box) :=
  let r' := extended r (box_interval b) in
  [&& ordered (lower r) (upper r), reaches r (box_interval b), alone r' b,
      supports_region (enclosed_order ns) r' (known_box b) &
      check_zero_enclosed z u (box_claim b)].

Section Beside.

(* Undecided regions, each with an enclosed claim or none. *)
Variables (rs : seq region) (bs : seq (option pinned_box)).

Definition pinned_yields : seq yield :=
  pmap (fun rb => omap (pinned_yield rb.1) rb.2) (zip rs bs).

Definition not_pinned : seq region :=
  pmap (fun rb => if rb.2 is Some _ then None else Some rb.1) (zip rs bs).

Definition check_beside alone :=
  (size rs == size bs) &&
  all (fun rb => if rb.2 is Some b then check_pinned alone rb.1 b else true) (zip rs bs).

End Beside.

(* The regions of different solutions, if right and left are apart in all of them. *)
Definition zero_distinct lo hi (yields : seq yield) (rs : seq region)
    (ls : seq (option support_leaf)) :=
  let families := families_of rs ls in
  if all (halves_apart z) [seq f.1 | f <- families] then
    if distinct_yields ns lo hi
         [seq y <- yields ++ isolated_of rs ls | ~~ has (belongs ns y) families] is Some ys
    then if all (halves_apart z) [seq yield_region y | y <- ys] then Some ys else None
    else None
  else None.

Definition zero_open rs ls := [seq r <- open_of rs ls | ~~ both_halves z r].

Section Cover.

Variables (claims : seq solution_claim) (c : cover) (lo hi : point).
Variables (bs : seq (option pinned_box)) (ls : seq (option support_leaf)).

Notation rs := (regions_open c lo hi).

Definition zero_undecided := not_pinned rs bs.

Definition check_boxes_beside :=
  match c with
  | Eliminated w _ => check_beside rs bs (pinned_alone (condensed (blocks_of Q) w))
  | Anchored w _ => check_beside rs bs (pinned_about w (expansions Q w))
  end.

Definition check_zero_complete :=
  [&& zero_wellformed z u, check_cover_of Q claims c lo hi, check_boxes_beside &
      check_supports Q zero_undecided ls].

Definition zero_solutions :=
  zero_distinct lo hi (regions_found Q claims c lo hi ++ pinned_yields rs bs) zero_undecided ls.

Definition zero_families := families_of zero_undecided ls.
Definition zero_still_open := zero_open zero_undecided ls.

End Cover.

End Checker.

Section Sound.

Variables (R : rcfType) (z : zero_system) (u : unknown).
Hypothesis wf : zero_wellformed z u.
Implicit Types (t : R) (v x : nat -> R).

Notation s := (without_zero z).
Notation Q := (zero_pencil z u).
Notation ns := (size (slip Q)).
Notation nz := (size (zero_particles z)).
Notation total := (free_number s + size (particles s) + 3 * nz)%N.

(* The motion (t, v) lies in a region. *)
Definition zero_motion_in (r : region) t v := lies_in Q r t (zero_variables_of z v).

Lemma apart_split r t x : halves_apart z r -> solution Q t x -> lies_in Q r t x -> split z x.
Proof.
by move=> apart [_ _ _ rows] [_ ag]; apply: ZeroPencil.apart_split ag apart _ => i /rows[].
Qed.

Lemma order_indices i : (i \in iota 0 (order Q)) = (i < total)%N.
Proof. by rewrite mem_iota. Qed.

(* A split solution and its motion. *)
Lemma motion_lies_in r t x : split z x -> lies_in Q r t x ->
  zero_motion_in r t (zero_motion z x).
Proof.
move=> splits [bt ag]; split=> // k lt_k; have := ag k lt_k.
rewrite /slip_of (zero_variables_of_motion wf splits) //.
by rewrite -order_indices; apply: (slip_indices (Q := Q)); apply: mem_nth.
Qed.

Lemma same_motion_scaled x x' : proportional Q x x' ->
  same_motion s (zero_motion z x) (zero_motion z x').
Proof.
case=> f f0 scaled; exists f => //; apply: zero_motion_scaled => i lt_i.
by apply: scaled; rewrite order_indices.
Qed.

Lemma proportional_of_motions x x' : split z x -> split z x' ->
  same_motion s (zero_motion z x) (zero_motion z x') -> proportional Q x x'.
Proof.
move=> splits splits' [f f0 scaled]; exists f => // i; rewrite order_indices => lt_i.
rewrite -(zero_variables_of_motion wf splits' lt_i) -(zero_variables_of_motion wf splits lt_i).
exact: (zero_variables_scaled wf f0 scaled lt_i).
Qed.

(* Any cover of the pencil. *)
Section Cover.

Variables (lo hi : point) (yields : seq yield) (rs : seq region) (ls : seq (option support_leaf)).
Hypothesis supports : check_supports Q rs ls.
Hypothesis cover :
  covers (solution Q) (proportional Q) (lies_in Q) lo hi yields (in_some (R := R) (lies_in Q) rs).

Notation families := (families_of rs ls).

Theorem zero_cover_number ys : zero_distinct z u lo hi yields rs ls = Some ys ->
  all_listed (satisfies_9z z u) (same_motion s) zero_motion_in lo hi ys
    (unlisted (R := R) zero_motion_in families (zero_open z rs ls)).
Proof.
rewrite /zero_distinct; case: ifP => // _; case dist: (distinct_yields _ _ _ _) => [ys'|] //.
case: ifP => // apart [eq_ys]; move: dist apart; rewrite {ys'}eq_ys => dist apart.
apply: (listed_transfer (good := fun=> split z) (f := zero_motion z) _ _ _ _ _
  (cover_number supports cover dist)).
- by move=> t x splits sol; apply: zero_pencil_motion.
- by move=> r t x; apply: motion_lies_in.
- by move=> _ x x'; apply: proportional_of_motions.
- move=> t v sat; exists (zero_variables_of z v); split; first exact: (zero_pencil_solution wf sat).
    move=> x' _ /same_motion_scaled[f f0 scaled]; exists f => // d d_in.
    by rewrite -scaled // (zero_motion_of_variables wf sat).
  case=> [|[r r_in reg]]; [by left | right; exists r => //; apply/in_filter; split=> //].
  apply/negP => both; case: reg => _ ag.
  by apply: both_not_split ag both (split_variables (z := z) v).
move=> y t x y_in; apply: apart_split; apply: (all_In apart); exact: List.in_map.
Qed.

Theorem zero_cover_hold ys : zero_distinct z u lo hi yields rs ls = Some ys ->
  forall f, List.In f families ->
  family_solved zero_motion_in (satisfies_9z z u) (same_motion (R := R) s) f.
Proof.
rewrite /zero_distinct; case: ifP => // apart _ f f_in.
have [is_pl each_value] := supports_families R supports f_in; split=> // t at_t.
have f_apart : halves_apart z f.1 by apply: (all_In apart); apply: List.in_map.
have [[x [sol reg]] alone] := each_value t at_t; split.
  have splits := apart_split f_apart sol reg.
  exists (zero_motion z x); split; first exact: zero_pencil_motion sol splits.
  exact: motion_lies_in.
move=> al v v' sat reg_v sat' reg_v'.
have prop : proportional Q (zero_variables_of z v) (zero_variables_of z v').
  by apply: (alone al) => //; apply: zero_pencil_solution.
have [c c0 scaled] := same_motion_scaled prop.
exists c => // d d_in; have := scaled d d_in.
by rewrite (zero_motion_of_variables wf sat) // (zero_motion_of_variables wf sat').
Qed.

End Cover.

End Sound.

(* The solution of an enclosed claim that stands beside a region. *)
Lemma zero_box_known (R : rcfType) z u b : zero_wellformed z u ->
  check_zero_enclosed z u (box_claim b) ->
  exists (t : R) x, known_solution (zero_pencil z u) (known_box z u b) t x.
Proof.
move=> wf ok; have [t [v [bt sat slips zeros _]]] := zero_enclosed_sound R ok.
case/and4P: ok => _ /allP in_range _ _; exists t, (zero_variables_of z v).
have names : all (fun i => i \in slip (zero_pencil z u)) (box_support (box_claim b)).
  apply/allP=> i /in_range /andP[ge_i lt_i].
  by rewrite mem_filter !mem_iota !add0n -leqNgt ge_i.
split=> // [|k lt_k]; first exact: zero_pencil_solution.
rewrite (mem_positions lt_k names) /slip_of; split=> //.
  by have [] := support_moves wf slips zeros (mem_nth 0%N lt_k).
by have [] := support_moves wf slips zeros (mem_nth 0%N lt_k).
Qed.

(* Boxes beside the regions that a cover leaves undecided. *)
Section Beside.

Variables (R : rcfType) (z : zero_system) (u : unknown) (lo hi : point).
Hypothesis wf : zero_wellformed z u.

Notation Q := (zero_pencil z u).
Notation ns := (size (slip Q)).

Variables (alone : region -> pinned_box -> bool).
Variables (yields : seq yield) (rs : seq region) (bs : seq (option pinned_box)).

Hypothesis beside : check_beside z u rs bs alone.
Hypothesis cover :
  covers (solution Q) (proportional Q) (lies_in Q) lo hi yields (in_some (R := R) (lies_in Q) rs).
Hypothesis alone_sound : forall r b, ordered (lower r) (upper r) -> alone r b ->
  (exists (t : R) x, known_solution Q (known_box z u b) t x) ->
  supports_region (enclosed_order ns) r (known_box z u b) ->
  one_solution_in R Q (Yield r (box_from (box_claim b)) (box_to (box_claim b))).

Lemma beside_covers :
  covers (solution Q) (proportional Q) (lies_in Q) lo hi (yields ++ pinned_yields rs bs)
    (in_some (R := R) (lies_in Q) (not_pinned rs bs)).
Proof.
have /andP[/eqP sz pinned_all] := beside; have [every each] := cover.
split=> [t x sol bt|y].
  have [[y y_in reg]|[r r_in reg]] := every t x sol bt.
    by left; exists y => //; apply/in_cat_or; left.
  have [[b|] rb_in] := in_zip sz r_in; last first.
    by right; exists r => //; apply/in_pmap; exists (r, None).
  left; exists (pinned_yield r b).
    by apply/in_cat_or; right; apply/in_pmap; exists (r, Some b).
  have /and5P[O /and3P[o le_lo le_hi] _ _ _] := all_In pinned_all rb_in.
  by case: reg => bt' ag; split=> //; apply: between_wider O o le_lo le_hi bt'.
case/in_cat_or=> [/each|/in_pmap[[r [b|]] //= rb_in [<-]]] //.
have /and5P[_ reach ok sup box] := all_In pinned_all rb_in.
apply: alone_sound => //; first by case/and3P: reach.
exact: zero_box_known.
Qed.

End Beside.

(* Where a claim is alone, its region has exactly one solution. *)
Lemma alone_constant (R : rcfType) z u claims w tr lo hi r b :
  check_complete (zero_pencil z u) claims w tr lo hi -> ordered (lower r) (upper r) ->
  pinned_alone z u (condensed (blocks_of (zero_pencil z u)) w) r b ->
  (exists (t : R) x, known_solution (zero_pencil z u) (known_box z u b) t x) ->
  supports_region (enclosed_order (size (slip (zero_pencil z u)))) r (known_box z u b) ->
  one_solution_in R (zero_pencil z u)
    (Yield r (box_from (box_claim b)) (box_to (box_claim b))).
Proof.
set Q := zero_pencil z u => complete O ok [t [x [bt sol signs]]] sup.
have [sol_s free_x] := condensed_solution complete sol.
have known_s : is_known (condensed (blocks_of Q) w) (A_condensed R (blocks_of Q) w)
    (B_condensed R (blocks_of Q) w) (known_box z u b) t (slip_of Q x).
  split=> // j; rewrite mem_iota add0n /= => lt_j; have [pos zero _] := signs _ lt_j.
  by split.
have [reg uniq] := claimed_sound (encloses_condensed R complete) O ok known_s sup.
exists t, x; split=> // t' x' sol' reg'.
have [sol_s' free'] := condensed_solution complete sol'.
have [-> [f f0 scaled]] := uniq _ _ sol_s' reg'.
split=> //; exists f => // i Hi; case/orP: (free_or_slip Hi) => /(nthP 0%N)[k lt_k <-].
  rewrite -[LHS]/(free_of Q x' k) -[X in _ = f * X]/(free_of Q x k) free' ?mem_iota //.
  rewrite free_x ?mem_iota // /free_part mulrN mulr_sumr; congr (- _); apply: sum_eq => j Hj.
  by rewrite scaled // mulrCA.
rewrite -[LHS]/(slip_of Q x' k) -[X in _ = f * X]/(slip_of Q x k).
by apply: scaled; rewrite mem_iota.
Qed.

Section Complete.

Variables (R : rcfType) (z : zero_system) (u : unknown) (claims : seq solution_claim) (c : cover).
Variables (lo hi : point) (bs : seq (option pinned_box)) (ls : seq (option support_leaf)).
Hypothesis checked : check_zero_complete z u claims c lo hi bs ls.

Notation s := (without_zero z).
Notation Q := (zero_pencil z u).

Lemma zero_complete_parts :
  [/\ zero_wellformed z u, check_supports Q (zero_undecided c lo hi bs) ls &
  covers (solution Q) (proportional Q) (lies_in Q) lo hi
    (regions_found Q claims c lo hi ++ pinned_yields (regions_open c lo hi) bs)
    (in_some (R := R) (lies_in Q) (zero_undecided c lo hi bs))].
Proof.
case/and4P: checked => wf ok beside supports; split=> //; have cover := cover_covers R ok.
case: c ok beside cover => w tr ok beside cover; apply: (beside_covers wf beside cover) => r b O.
  exact: alone_constant ok O.
by move=> alone known sup; apply: (claim_yields ok O alone known sup).
Qed.

Theorem zero_complete_number ys : zero_solutions z u claims c lo hi bs ls = Some ys ->
  all_listed (satisfies_9z z u) (same_motion s) (zero_motion_in z u) lo hi ys
    (unlisted (R := R) (zero_motion_in z u) (zero_families c lo hi bs ls)
       (zero_still_open z c lo hi bs ls)).
Proof.
by have [wf supports cover] := zero_complete_parts; apply: (zero_cover_number wf supports).
Qed.

Corollary zero_none : zero_solutions z u claims c lo hi bs ls = Some [::] ->
  zero_families c lo hi bs ls = [::] -> zero_still_open z c lo hi bs ls = [::] ->
  forall (t : R) v, satisfies_9z z u t v -> between t lo hi -> False.
Proof.
move=> /zero_complete_number + no_family no_open; rewrite no_family no_open => listed.
exact/listed_none/(listed_weaken (@unlisted_none _ _) listed).
Qed.

Theorem zero_complete_hold ys : zero_solutions z u claims c lo hi bs ls = Some ys ->
  forall f, List.In f (zero_families c lo hi bs ls) ->
  family_solved (zero_motion_in z u) (satisfies_9z z u) (same_motion (R := R) s) f.
Proof. by have [wf supports _] := zero_complete_parts; apply: (zero_cover_hold R wf supports). Qed.

End Complete.

(* Condensation about anchors. *)
Section Anchored.

Variables (R : rcfType) (z : zero_system) (u : unknown) (claims : seq solution_claim).
Variables (w : anchoring) (tr : tree varying_leaf).

Definition zero_varying_number := @zero_complete_number R z u claims (Anchored w tr).
Definition zero_varying_none := @zero_none R z u claims (Anchored w tr).
Definition zero_varying_hold := @zero_complete_hold R z u claims (Anchored w tr).

End Anchored.
