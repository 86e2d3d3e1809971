(* No solution below a friction, for free rows that depend on t: condensation about anchors.

   Continues Critical.v.  An anchor (Anchor.v) has one center, unit, W and factors of rows, and a V
   for each part; it may be reversed (Varying.v).  A leaf is

     AboutAnchor n g tr  evidence of Critical.v for both parts, condensed about anchor n with the
                         grain g over the interval of the box; in the tree tr the position u in
                         this interval stands in place of t;
     WithoutAnchor l     a leaf of Critical.v that needs no enclosures.

   Over the box both local pencils are near lines, and their rows have one positive factor, so the
   local pencil at mu is a combination of those at both ends of the interval of mu.

   Theorem [zero_anchored_critical_absent]: if the check succeeds, then for every mu in
   [from, bound] and every t >= 0 no motion satisfies the conditions (9) with lambda^2 = t and mu.
   [anchored_critical_absent]: the same without particles in contact with zero reaction.

   Page: spec/certificates.md, 5.18, with 5.14.
   Rust: crates/check/src/cover/critical.rs, condensed.rs, expanded.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Farkas Covered Definite Pinned Cover
  Condensation Pencil Whole Complete System Norms Elimination Series Anchor AnchorLeaf Varying
  ZeroReaction ZeroPencil Boxes Regular Critical.

Record box_anchor := BoxAnchor {
  reversed_anchor : bool;
  plain_anchor : anchor;
  friction_left : seq matrix }.

Record box_anchoring := BoxAnchoring {
  stiffness_below : form_bound;
  mass_below : form_bound;
  box_anchors : seq box_anchor }.

Inductive anchored_box_leaf :=
  | AboutAnchor of nat & Z & tree critical_leaf
  | WithoutAnchor of critical_leaf.

Section Checker.

Variable z : zero_system.

Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).
Notation ns := (slip_number z).

Definition friction_anchor a (other : seq matrix) : anchor :=
  Anchor (anchor_center a) (anchor_unit a) (anchor_right a) other (anchor_scale a).

Definition expand_part Q (reverse : bool) a : option anchor_family :=
  if reverse then expand (swap_pencil Q) a else expand Q a.

Definition expand_box (b : box_anchor) : option (anchor_family * anchor_family) :=
  if expand_part Q0 (reversed_anchor b) (plain_anchor b) is Some fam then
    if expand_part Q1 (reversed_anchor b) (friction_anchor (plain_anchor b) (friction_left b))
      is Some fam' then Some (fam, fam')
    else None
  else None.

(* A leaf about the enclosures P, P' of both parts; [halves] says that right and left of a particle
   both move. *)
Definition check_local_leaf (halves : region -> bool) (P P' : enclosed) (r : region)
    (low high : point) (l : critical_leaf) :=
  if l is BoxHalves then halves r else check_parts P P' r low high l.

(* The local pencil of a part over [lo, hi]. *)
Definition local_part low_a low_b a fam lo hi grain :=
  local_pencil ns a low_a low_b fam lo hi false grain.

Definition check_about low_a low_b (b : box_anchor) (fams : anchor_family * anchor_family) grain
    (r : region) (low high : point) (tr : tree critical_leaf) :=
  let a := plain_anchor b in
  let a' := friction_anchor a (friction_left b) in
  [&& proper_interval a low_a low_b (lower r) (upper r), (0 <? grain)%Z,
      size (series_z fams.1) == size (series_z fams.2) &
      check_boxes ns (check_local_leaf (both_halves z)
          (local_part low_a low_b a fams.1 (lower r) (upper r) grain)
          (local_part low_a low_b a' fams.2 (lower r) (upper r) grain))
        tr (local_region r) low high].

Variable w : box_anchoring.

Definition no_box_anchor := BoxAnchor false (Anchor zero 0 [::] [::] [::]) [::].

Definition box_expansions := [seq expand_box b | b <- box_anchors w].

Definition check_anchored_box (families : seq (option (anchor_family * anchor_family)))
    (r : region) (low high : point) (l : anchored_box_leaf) :=
  match l with
  | AboutAnchor n grain tr' =>
      let b := nth no_box_anchor (box_anchors w) n in
      if nth None families n is Some fams then
        if reversed_anchor b then
          (0 <? (lower r).1)%Z &&
          check_about (mass_below w) (stiffness_below w) b fams grain (swap_region r) low high tr'
        else check_about (stiffness_below w) (mass_below w) b fams grain r low high tr'
      else false
  | WithoutAnchor l => check_whole_leaf z r low high l
  end.

Definition both_bounded :=
  [&& bounded_rows (size (free Q0)) (ff_block Q0 (row_a Q0)) (stiffness_below w),
      bounded_rows (size (free Q0)) (ff_block Q0 (row_b Q0)) (mass_below w),
      bounded_rows (size (free Q1)) (ff_block Q1 (row_a Q1)) (stiffness_below w) &
      bounded_rows (size (free Q1)) (ff_block Q1 (row_b Q1)) (mass_below w)].

Definition check_anchored_critical (tr : tree anchored_box_leaf) (from bound : point) :=
  let families := box_expansions in
  [&& zero_wellformed z (Lambda2 0 1), nilp (box_anchors w) || both_bounded &
      check_boxes ns (check_anchored_box families) tr (window zero infinity) from bound].

End Checker.

(* One part over the interval of an anchor. *)
Section Part.

Variables (R : rcfType) (Q : pencil) (a : anchor) (fam : anchor_family) (low_a low_b : form_bound).
Variables (lo hi : point) (grain : Z) (t : R) (x : nat -> R).
Hypotheses (ready : prepared Q a fam low_a low_b lo hi) (grain0 : (0 <? grain)%Z).
Hypothesis bt : between t lo hi.
Hypothesis rows_f : forall i, i \in free Q -> reaction Q t x i = 0.

Notation u := (u_of lo hi t).
Notation P := (local_pencil (size (slip Q)) a low_a low_b fam lo hi false grain).

Lemma free_at_u k : k \in iota 0 (size (free Q)) ->
  free_of Q x k = free_values Q a lo hi u (slip_of Q x) k.
Proof.
have [u0 _] := u_of_between ready bt.
by move: k; apply/(free_values_rows ready x u0); rewrite (t_of_u ready).
Qed.

Lemma part_line : exists A B, encloses P A B /\
  forall i, (i < size (slip Q))%N -> image P A B u (slip_of Q x) i =
    row_factor_at R a fam lo hi grain i * reaction Q t x (nth 0%N (slip Q) i).
Proof.
have [u0 u1] := u_of_between ready bt.
have [A [B [E on]]] := local_line ready grain0 false u0 u1; exists A, B; split=> // i lt_i.
rewrite -[X in reaction Q X _ _](t_of_u ready t) -(local_image grain ready false u0 lt_i free_at_u).
by apply: sum_eq => j Hj; rewrite on // mem_iota.
Qed.

End Part.

(* A box with an anchor, for two pencils that differ in their slip rows. *)
Section About.

Variables (R : rcfType) (n : nat) (fr : seq nat) (ra rb ra' rb' : seq sparse_row).
Notation Q := (Pencil n ra rb fr).
Notation Q' := (Pencil n ra' rb' fr).
Variables (a : anchor) (other : seq matrix) (fam fam' : anchor_family) (low_a low_b : form_bound).
Notation a' := (friction_anchor a other).
Variables (grain : Z) (r : region) (low high : point) (t mu : R) (x : nat -> R).
Hypothesis ready : prepared Q a fam low_a low_b (lower r) (upper r).
Hypothesis ready' : prepared Q' a' fam' low_a low_b (lower r) (upper r).
Hypotheses (grain0 : (0 <? grain)%Z) (same_size : size (series_z fam) = size (series_z fam')).
Hypothesis bm : between mu low high.
Hypothesis bt : between t (lower r) (upper r).
Hypothesis ag : agrees (size (slip Q)) r (slip_of Q x).
Hypothesis nonzero : exists2 i, i \in iota 0 n & x i != 0.
Hypothesis rows_f : forall i, i \in fr -> reaction Q t x i = 0.
Hypothesis rows_f' : forall i, i \in fr -> reaction Q' t x i = 0.
Hypothesis signs : forall i, i \in slip Q ->
  let y := reaction Q t x i + mu * reaction Q' t x i in [/\ 0 <= x i, 0 <= y & x i * y = 0].
Variable halves : region -> bool.
Hypothesis halves_absent : forall r',
  halves r' -> agrees (size (slip Q)) r' (slip_of Q x) -> False.

Notation lo := (lower r).
Notation hi := (upper r).
Notation P := (local_pencil (size (slip Q)) a low_a low_b fam lo hi false grain).
Notation P' := (local_pencil (size (slip Q)) a' low_a low_b fam' lo hi false grain).

Lemma same_factor i :
  row_factor_at R a' fam' lo hi grain i = row_factor_at R a fam lo hi grain i.
Proof.
rewrite /row_factor_at; congr (_ * (_ * toR _ * _) * _); rewrite /power_z.
by apply: substituted_power_size; rewrite !size_map same_size.
Qed.

Theorem about_absent tr :
  check_boxes (size (slip Q)) (check_local_leaf halves P P') tr (local_region r) low high -> False.
Proof.
have [u0 u1] := u_of_between ready bt.
have lt_ns i : i \in indices P -> (i < size (slip Q))%N by rewrite mem_iota.
have x0 i : (i < size (slip Q))%N -> 0 <= slip_of Q x i.
  by move=> lt_i; have [] := signs (mem_nth 0%N lt_i).
have start : in_region (size (slip Q)) (u_of lo hi t) (slip_of Q x) (local_region r).
  by split=> //; rewrite /between /= toR0 toR1 !mulr1.
move=> /box_reaches_a_leaf/(_ x0 start bm)[r1 [low1 [high1 [l [_ [[bu ag1] bm1 O1 Om1 leaf_ok]]]]]].
have {leaf_ok} ok : check_parts P P' r1 low1 high1 l.
  by case: l leaf_ok => //= both; have := halves_absent both ag1.
have [A [B [E imageE]]] := part_line ready grain0 bt rows_f.
have [A' [B' [E' imageE']]] := part_line ready' grain0 bt rows_f'.
apply: (parts_absent (r := r1) (t := u_of lo hi t) E E' (erefl _) O1 Om1 bu bm1
  (xs := slip_of Q x) (factor := row_factor_at R a fam lo hi grain)
  (row := fun i => reaction Q t x (nth 0%N (slip Q) i))
  (row' := fun i => reaction Q' t x (nth 0%N (slip Q) i)) _ _ _ _ _ _ ok) => //.
- by move=> i /lt_ns lt_i; apply: (row_factor_gt0_ R ready grain0).
- by move=> i /lt_ns; apply: imageE.
- by move=> i /lt_ns lt_i; rewrite -same_factor; apply: imageE'.
- have part := free_at_u ready bt rows_f.
  by case: (slip_part_nonzero part nonzero) => j Hj xj; exists j.
by move=> i /lt_ns lt_i; apply: signs; apply: mem_nth.
Qed.

End About.

(* The same in 1/t. *)
Theorem about_reversed_absent (R : rcfType) n fr ra rb ra' rb' a other fam fam' low_a low_b grain
    r low high (t mu : R) x (halves : region -> bool) tr
    (Q := Pencil n ra rb fr) (Q' := Pencil n ra' rb' fr) :
  prepared (swap_pencil Q) a fam low_a low_b (swap (upper r)) (swap (lower r)) ->
  prepared (swap_pencil Q') (friction_anchor a other) fam' low_a low_b (swap (upper r))
    (swap (lower r)) -> (0 <? grain)%Z ->
  size (series_z fam) = size (series_z fam') -> between mu low high ->
  0 < t -> between t (lower r) (upper r) -> agrees (size (slip Q)) r (slip_of Q x) ->
  (exists2 i, i \in iota 0 n & x i != 0) ->
  (forall i, i \in fr -> reaction Q t x i = 0) ->
  (forall i, i \in fr -> reaction Q' t x i = 0) ->
  (forall i, i \in slip Q -> let y := reaction Q t x i + mu * reaction Q' t x i in
     [/\ 0 <= x i, 0 <= y & x i * y = 0]) ->
  (forall r', halves r' -> agrees (size (slip Q)) r' (slip_of Q x) -> False) ->
  check_boxes (size (slip Q)) (check_local_leaf halves
      (local_pencil (size (slip Q)) a low_a low_b fam (swap (upper r)) (swap (lower r)) false grain)
      (local_pencil (size (slip Q)) (friction_anchor a other) low_a low_b fam' (swap (upper r))
         (swap (lower r)) false grain)) tr (local_region r) low high -> False.
Proof.
move=> ready ready' grain0 same_size bm t_gt0 bt ag nonzero rows rows' signs apart.
have tn0 := lt0r_neq0 t_gt0; have ti : 0 < t^-1 by rewrite invr_gt0.
apply: (@about_absent R n fr rb ra rb' ra' a other fam fam' low_a low_b grain (swap_region r)
  low high t^-1 mu x ready ready' grain0 same_size bm (swap_between t_gt0 bt) ag nonzero _ _ _
  halves apart).
- by move=> i Hi; rewrite (swap_reaction Q) // rows // mulr0.
- by move=> i Hi; rewrite (swap_reaction Q') // rows' // mulr0.
move=> i Hi y; rewrite /y (swap_reaction Q) // (swap_reaction Q') // mulrCA -mulrDr.
exact/(complementary_scaled _ _ ti)/signs.
Qed.

Section Sound.

Variables (R : rcfType) (z : zero_system) (w : box_anchoring).
Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).

Hypothesis wf : zero_wellformed z (Lambda2 0 1).
Notation wfQ := (zero_pencil_wellformed z (Lambda2 0 1)).
Hypothesis bounds : nilp (box_anchors w) || both_bounded z w.

Variables (t mu : R) (v : nat -> R).
Hypotheses (mu0 : 0 <= mu) (sat : conditions_9z z t mu v).
Notation x := (zero_variables_of z v).
Variables (r : region) (low high : point).
Hypotheses (O : ordered (lower r) (upper r)) (Om : ordered low high).
Hypotheses (bt : between t (lower r) (upper r)) (bm : between mu low high).
Hypothesis ag : agrees (slip_number z) r (slip_of Q0 x).

Lemma both_absent r' : both_halves z r' -> agrees (size (slip Q0)) r' (slip_of Q0 x) -> False.
Proof. by move=> both ag'; apply: both_not_split ag' both (split_variables _). Qed.

Lemma anchored_box_absent l :
  check_anchored_box z w (box_expansions z w) r low high l -> False.
Proof.
case: l => [n grain e|l] /=; last by apply: (whole_leaf_absent wf mu0 sat O Om bt bm ag).
case fams_n: (nth None (box_expansions z w) n) => [fams|//].
have lt_n : (n < size (box_anchors w))%N.
  by rewrite ltnNge; apply/negP => l; rewrite nth_default ?size_map in fams_n.
have /and4P[ba0 bb0 ba1 bb1] : both_bounded z w.
  by case/orP: bounds => // /nilP none; rewrite none in lt_n.
move: fams_n; rewrite (nth_map no_box_anchor) //.
case: (nth no_box_anchor (box_anchors w) n) => reverse a other; rewrite /expand_box /=.
case ex0: (expand_part Q0 reverse a) => [fam|//].
case ex1: (expand_part Q1 reverse (friction_anchor a other)) => [fam'|//] [<-].
have nonzero := motion_variables wf sat.
have rows0 := free_row_at wf sat (0, 1)%Z; have rows1 := free_row_at wf sat (1, 0)%Z.
have signs := slip_conditions wf sat.
have ag' : agrees (size (slip Q0)) r (slip_of Q0 x) by rewrite size_slips.
case: reverse ex0 ex1 => ex0 ex1; last first.
  rewrite /check_about /local_part -(size_slips z (Lambda2 0 1)).
  case/and4P=> /= proper grain0 /eqP same_size ok.
  exact: (about_absent (prepare ex0 wfQ ba0 bb0 proper) (prepare ex1 wfQ ba1 bb1 proper) grain0
    same_size bm bt ag' nonzero rows0 rows1 signs both_absent ok).
rewrite /check_about /local_part -(size_slips z (Lambda2 0 1)) => /andP[lo0].
case/and4P=> /= proper grain0 /eqP same_size ok.
exact: (about_reversed_absent (prepare ex0 wfQ bb0 ba0 proper) (prepare ex1 wfQ bb1 ba1 proper)
  grain0 same_size bm (between_gt0 O lo0 bt) bt ag' nonzero rows0 rows1 signs both_absent ok).
Qed.

End Sound.

Theorem zero_anchored_critical_absent (R : rcfType) z w tr from bound :
  check_anchored_critical z w tr from bound ->
  forall (t mu : R) v, 0 <= t -> between mu from bound -> conditions_9z z t mu v -> False.
Proof.
case/and3P=> wf bounds boxes t mu v t0 bm sat; have [x0 start] := motion_start wf t0 sat.
have [r [low [high [l [_ [[bt ag] bm' O Om ok]]]]]] := box_reaches_a_leaf boxes x0 start bm.
exact: (anchored_box_absent wf bounds (between_ge0 Om bm') sat O Om bt bm' ag ok).
Qed.

Corollary anchored_critical_absent (R : rcfType) s w tr from bound :
  check_anchored_critical (ZeroSystem s [::]) w tr from bound ->
  forall (t mu : R) v, 0 <= t -> between mu from bound -> conditions_9 s t mu v -> False.
Proof.
move=> checked t mu v t0 bm /no_zero_particles.
exact: (zero_anchored_critical_absent checked t0 bm).
Qed.
