(* A solution at every friction of an interval, for mechanical systems.

   The checker gets a system, an interval [from, bound] of mu, the bounds and anchors of
   CriticalAnchors.v, and a list of pieces.  The first piece begins at from, each later one where
   the one before ends, and the last one ends at bound or beyond.  A piece has an interval of t, the
   number of an anchor, the grain of the local pencils, a state for each complementarity variable
   and a witness of Presence.v for both ends of its interval of mu.  Its edges are enclosed over
   intervals of their own, [t0, after] and [before, t1].  Of right and left of a particle
   in contact with zero reaction at least one is at rest, so solutions of the pencil are motions.

   Theorem [zero_presence_sound]: if the check succeeds, then for every mu in [from, bound] there
   are a t >= 0 and a motion that satisfies the conditions (9) with lambda^2 = t and mu.
   [presence_sound]: the same without particles in contact with zero reaction.

   The condensed matrix of both parts is T0(u) + mu T1(u), where u is the position in the interval
   of t; det F times it has polynomials in u as entries (AnchorLeaf.v).  Without free variables F is
   empty and the anchor has no matrices.

   Page: spec/certificates.md, 5.19.  Rust: crates/check/src/presence.rs, cover/presence.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Farkas Covered Definite RootLeaf Pinned
  Cover Condensation Pencil Whole Complete System Norms Elimination Series Anchor AnchorLeaf Varying
  ZeroReaction ZeroPencil Boxes Regular Critical CriticalAnchors Presence.

Record presence_piece := PresencePiece {
  piece_end : point;
  piece_region : region;
  piece_anchor : nat;
  piece_grain : Z;
  piece_after : point;   (* in the variable of the anchor: t, or 1/t for a reversed one *)
  piece_before : point;
  piece_witness : presence }.

Section Checker.

Variables (z : zero_system) (radii : option part_radii) (w : box_anchoring).

(* The pencils at both ends of the interval of mu, over an interval of t. *)
Definition ends_over low_a low_b (b : box_anchor) (fams : anchor_family * anchor_family) grain
    (low high lo hi : point) : enclosed * enclosed :=
  let a := plain_anchor b in
  let P := local_part z low_a low_b a fams.1 lo hi grain in
  let P' := widened radii
    (local_part z low_a low_b (friction_anchor a (friction_left b)) fams.2 lo hi grain) in
  (mixed low P P', mixed high P P').

Definition check_present low_a low_b (b : box_anchor) (fams : anchor_family * anchor_family) grain
    (r : region) (low high after before : point) (v : presence) :=
  let over := ends_over low_a low_b b fams grain low high in
  let proper := proper_interval (plain_anchor b) low_a low_b in
  [&& proper (lower r) (upper r), proper (lower r) after && proper before (upper r),
      (0 <? grain)%Z, size (series_z fams.1) == size (series_z fams.2) &
      check_presence_piece (over (lower r) (upper r)) (over (lower r) after)
        (over before (upper r)) (local_region r) v].

Definition check_piece (families : seq (option (anchor_family * anchor_family))) (low : point)
    (p : presence_piece) :=
  let b := nth no_box_anchor (box_anchors w) (piece_anchor p) in
  let r := piece_region p in
  ordered low (piece_end p) && halves_apart z r &&
  if nth None families (piece_anchor p) is Some fams then
    if reversed_anchor b then
      (0 <? (upper r).2)%Z &&
      check_present (mass_below w) (stiffness_below w) b fams (piece_grain p) (swap_region r) low
        (piece_end p) (piece_after p) (piece_before p) (piece_witness p)
    else check_present (stiffness_below w) (mass_below w) b fams (piece_grain p) r low
           (piece_end p) (piece_after p) (piece_before p) (piece_witness p)
  else false.

Fixpoint check_pieces families (low : point) (pieces : seq presence_piece) (bound : point) :=
  match pieces with
  | [::] => false
  | [:: p] => check_piece families low p &&
              (bound.1 * (piece_end p).2 <=? (piece_end p).1 * bound.2)%Z
  | p :: rest => check_piece families low p && check_pieces families (piece_end p) rest bound
  end.

Definition check_presence (pieces : seq presence_piece) (from bound : point) :=
  let families := box_expansions z radii w in
  [&& zero_wellformed z Mu, both_bounded z radii w, (0 <? bound.2)%Z &
      check_pieces families from pieces bound].

End Checker.

(* Over two intervals the matrix at one value differs by a positive factor. *)
Section Intervals.

Variables (R : rcfType) (Q : pencil) (A B : nat -> nat -> R) (a : anchor) (fam : anchor_family).
Variables (low_a low_b : form_bound) (lo hi lo' hi' : point) (grain : Z) (u u' : R).
Hypothesis ready : prepared_member Q A B a fam low_a low_b lo hi.
Hypothesis ready' : prepared_member Q A B a fam low_a low_b lo' hi'.
Hypothesis same_value : t_of lo hi u = t_of lo' hi' u'.

Definition power_ratio : R :=
  toR (power_z a fam lo' hi') / toR (power_z a fam lo hi).

Lemma power_ratio_gt0 : 0 < power_ratio.
Proof. by rewrite divr_gt0 ?(power_gt0 ready) ?(power_gt0 ready'). Qed.

Lemma family_of_interval i j : local_family Q A B a fam lo' hi' grain u' i j =
  power_ratio * local_family Q A B a fam lo hi grain u i j.
Proof.
have q0 := q_gt0 ready; have p0 := power_gt0 ready.
have same_d : d_of a lo' hi' u' = d_of a lo hi u.
  apply: (mulfI (lt0r_neq0 q0)); apply: (addrI (toR (anchor_center a).1)).
  by rewrite -(t_ofE ready) -(t_ofE ready') same_value.
rewrite /local_family /raw same_d /power_ratio.
move: (scale_at _ _ _ _) (condensed_family _ _ _ _ _ _ _) (toR (power_z a fam lo' hi')) => s c p.
move: (toR (power_z a fam lo hi)) p0 (toR (anchor_unit a)) => p1 p1_gt0 v.
by field; apply: lt0r_neq0.
Qed.

End Intervals.

Lemma t_of_ends (R : rcfType) Q (A B : nat -> nat -> R) a fam low_a low_b p q :
  prepared_member Q A B a fam low_a low_b p q ->
  t_of p q 0 = toR p.1 / toR p.2 :> R /\ t_of p q 1 = toR q.1 / toR q.2 :> R.
Proof.
move=> ready; have [_ p2 q2 _ _] := proper_parts ready.
have [p0 q0] := (lt0r_neq0 p2, lt0r_neq0 q2).
rewrite /t_of /interval_width mul0r mul1r addr0 toRB !toRM.
by split; last rewrite addrCA subrr addr0; field; rewrite ?p0 ?q0.
Qed.

Section Present.

Variables (R : rcfType) (n : nat) (fr : seq nat) (ra rb ra' rb' : seq sparse_row).
Notation Q := (Pencil n ra rb fr).
Notation Q' := (Pencil n ra' rb' fr).
Variables (A B A' B' : nat -> nat -> R) (radii : option part_radii) (g_of : nat -> R).
Variables (a : anchor) (other : seq matrix) (fam fam' : anchor_family) (low_a low_b : form_bound).
Notation a' := (friction_anchor a other).
Variables (grain : Z) (r : region) (low high : point) (mu : R).
Hypothesis ready : prepared_member Q A B a fam low_a low_b (lower r) (upper r).
Hypothesis ready' : prepared_member Q' A' B' a' fam' low_a low_b (lower r) (upper r).
Hypothesis shares : within_shares radii (size (slip Q)) g_of.
Variables after before : point.
Hypothesis proper_s : proper_interval a low_a low_b (lower r) after.
Hypothesis proper_f : proper_interval a low_a low_b before (upper r).
Hypotheses (grain0 : (0 <? grain)%Z) (same_size : size (series_z fam) = size (series_z fam')).
Hypotheses (Om : ordered low high) (bm : between mu low high).
Notation y := (member_reaction n A B).
Notation y' := (member_reaction n A' B').
Hypothesis same_rows : forall t (x : nat -> R) i, i \in fr -> y' t x i = y t x i.

Notation lo := (lower r).
Notation hi := (upper r).
Notation ns := (size (slip Q)).
Notation part lo hi := (local_pencil ns a low_a low_b fam lo hi false grain).
Notation part' lo hi := (local_pencil ns a' low_a low_b fam' lo hi false grain).
Notation over lo hi :=
  (mixed low (part lo hi) (widened radii (part' lo hi)),
   mixed high (part lo hi) (widened radii (part' lo hi))).
Notation P := (part lo hi).
Notation P' := (part' lo hi).
Notation T0 := (local_family Q A B a fam lo hi grain).
Notation T1 := (local_family Q' A' B' a' fam' lo hi grain).
Notation F u := (fun i j => T0 u i j + mu * (g_of i * T1 u i j)).
Notation d0 := (free_det (size (free Q)) (F_poly Q A B a lo hi)).
Notation d1 := (free_det (size (free Q')) (F_poly Q' A' B' a' lo hi)).
Notation N0 := (family_poly Q A B a fam lo hi grain).
Notation N1 := (family_poly Q' A' B' a' fam' lo hi grain).

(* The matrix at mu over an interval, at the position u in it. *)
Definition family_over p q (u : R) i j :=
  local_family Q A B a fam p q grain u i j +
  mu * (g_of i * local_family Q' A' B' a' fam' p q grain u i j).

(* Ready over another interval. *)
Let over_pq p q : proper_interval a low_a low_b p q ->
  prepared_member Q A B a fam low_a low_b p q /\
  prepared_member Q' A' B' a' fam' low_a low_b p q.
Proof. by case: ready ready' => w e b c _ [_ e' b' c' _]. Qed.

Lemma over_lines p q (u f g : R) : proper_interval a low_a low_b p q -> 0 <= u -> u <= 1 ->
  f * toR low.2 + g * toR high.2 = 1 -> f * toR low.1 + g * toR high.1 = mu ->
  exists C D C' D', [/\ encloses (over p q).1 C D, encloses (over p q).2 C' D' &
    forall i j, i \in iota 0 ns -> j \in iota 0 ns ->
      family_over p q u i j = mixed_at C D C' D' u f g i j].
Proof.
move=> /over_pq[pq pq'] u0 u1 one val; have [l1 l2 h1 h2] := ordered_ge0 R Om.
have [C [D [E on]]] := local_line pq grain0 u0 u1.
have [C' [D' [near on']]] := local_line pq' grain0 u0 u1.
have E' := widened_encloses (P := part' p q) shares near.
have same := size_widened radii (part' p q).
exists (fun i j => toR low.2 * C i j + toR low.1 * (g_of i * C' i j)),
  (fun i j => toR low.2 * D i j + toR low.1 * (g_of i * D' i j)),
  (fun i j => toR high.2 * C i j + toR high.1 * (g_of i * C' i j)),
  (fun i j => toR high.2 * D i j + toR high.1 * (g_of i * D' i j)).
split; [exact: (mixed_encloses E E') | exact: (mixed_encloses E E') |].
move=> i j Hi Hj; rewrite /family_over on // on' // /mixed_at /T.
rewrite -[C i j + u * D i j]mul1r -one -val.
by move: (C i j) (D i j) (C' i j) (D' i j) (g_of i) => *; ring.
Qed.

Lemma over_rows p q (u u' : R) : proper_interval a low_a low_b p q ->
  t_of lo hi u = t_of p q u' -> exists2 rho : nat -> R, forall i, i \in iota 0 ns -> 0 < rho i &
    forall i j, i \in iota 0 ns -> j \in iota 0 ns ->
      family_over p q u' i j = rho i * family_over lo hi u i j.
Proof.
move=> /over_pq[pq pq'] same_value; exists (fun=> power_ratio R a fam lo hi p q).
  by move=> i _; apply: (power_ratio_gt0 ready pq).
move=> i j _ _; rewrite /family_over (family_of_interval grain ready pq same_value).
rewrite (family_of_interval grain ready' pq' same_value).
have -> : power_ratio R a' fam' lo hi p q = power_ratio R a fam lo hi p q.
  by rewrite /power_ratio /power_z; congr (toR _ / toR _); apply: substituted_power_size;
     rewrite !size_map same_size.
by move: (power_ratio _ _ _ _ _ _ _) (local_family _ _ _ _ _ _ _ _ _ _ _) (g_of i) => *; ring.
Qed.

Theorem piece_present v :
  check_presence_piece (over lo hi) (over lo after) (over before hi) (local_region r) v ->
  exists t x, [/\ between t lo hi /\ agrees ns r (slip_of Q x),
    exists2 i, i \in iota 0 n & x i != 0, forall i, i \in fr -> y t x i = 0 &
    forall k, (k < ns)%N -> let i := nth 0%N (slip Q) k in
      let row := y t x i + mu * (g_of k * y' t x i) in
      [/\ 0 <= x i, 0 <= row & x i * row = 0]].
Proof.
move=> ok; have [f [g [f0 g0 [one val] [fg _]]]] := weights_of_ends Om bm.
have [_ _ _ _ proper] := ready.
have unit_u (u : R) : between u (lower (local_region r)) (upper (local_region r)) ->
    0 <= u /\ u <= 1 by rewrite /between /= toR0 toR1 !mulr1.
have Or : ordered (lower (local_region r)) (upper (local_region r)) by [].
have start0 : toR (lower (local_region r)).1 / toR (lower (local_region r)).2 = 0 :> R.
  by rewrite /= toR0 mul0r.
have finish1 : toR (upper (local_region r)).1 / toR (upper (local_region r)).2 = 1 :> R.
  by rewrite /= toR1 divr1.
have regular_d (u : R) : between u (lower (local_region r)) (upper (local_region r)) ->
    (d0 * d1).[u] != 0.
  move=> /unit_u[u0 u1]; rewrite hornerM mulf_neq0 //.
    exact: (free_det_neq0 ready).
  exact: (free_det_neq0 ready').
have family_d (u : R) i j : between u (lower (local_region r)) (upper (local_region r)) ->
    i \in indices (over lo hi).1 -> j \in indices (over lo hi).1 ->
    (N0 i j * d1 + (mu * g_of i) *: (N1 i j * d0)).[u] = (d0 * d1).[u] * F u i j.
  move=> /unit_u[u0 u1] _ _; rewrite hornerD hornerZ.
  rewrite [(N0 i j * d1).[u]]hornerM [(N1 i j * d0).[u]]hornerM [(d0 * d1).[u]]hornerM.
  rewrite (family_polyE grain ready) // (family_polyE grain ready') //.
  by move: (d0.[u]) (d1.[u]) (T0 u i j) (T1 u i j) (g_of i) => *; ring.
have lines p q (u : R) : proper_interval a low_a low_b p q -> 0 <= u -> u <= 1 ->
    on_lines (over lo hi).1 f g (over p q).1 (over p q).2 u (family_over p q u).
  by move=> proper_pq u0 u1; apply: over_lines.
have near (u : R) : between u (lower (local_region r)) (upper (local_region r)) ->
    on_lines (over lo hi).1 f g (over lo hi).1 (over lo hi).2 u (family_over lo hi u).
  by case/unit_u; apply: lines.
have near_s : on_lines (over lo hi).1 f g (over lo after).1 (over lo after).2
    (toR (lower (local_region r)).1 / toR (lower (local_region r)).2) (family_over lo after 0).
  by rewrite start0; apply: lines; rewrite ?ler01 ?lexx.
have near_f : on_lines (over lo hi).1 f g (over before hi).1 (over before hi).2
    (toR (upper (local_region r)).1 / toR (upper (local_region r)).2) (family_over before hi 1).
  by rewrite finish1; apply: lines; rewrite ?ler01 ?lexx.
have rows_s : multiple_rows (over lo hi).1 (family_over lo hi)
    (toR (lower (local_region r)).1 / toR (lower (local_region r)).2) (family_over lo after 0).
  by rewrite start0; apply: over_rows;
    rewrite ?(t_of_ends ready).1 ?(t_of_ends (over_pq proper_s).1).1.
have rows_f : multiple_rows (over lo hi).1 (family_over lo hi)
    (toR (upper (local_region r)).1 / toR (upper (local_region r)).2) (family_over before hi 1).
  by rewrite finish1; apply: over_rows;
    rewrite ?(t_of_ends ready).2 ?(t_of_ends (over_pq proper_f).1).2.
have [u [xs [bu [i0 Hi0 xi0] ag signs]]] :=
  piece_exists (P := (over lo hi).1) (P' := (over lo hi).2) (Ps := (over lo after).1)
    (Ps' := (over lo after).2) (Pf := (over before hi).1) (Pf' := (over before hi).2)
    erefl erefl erefl erefl erefl Or f0 g0 fg near near_s near_f rows_s rows_f
    (N := fun i j => N0 i j * d1 + (mu * g_of i) *: (N1 i j * d0)) regular_d family_d ok.
have [u0 u1] := unit_u u bu.

pose t := t_of lo hi u; pose x := joined Q A B a lo hi u xs.
have slipE j : (j < ns)%N -> slip_of Q x j = xs j by apply: slip_of_joined.
have part := joined_values ready u xs.
have rows : forall i, i \in free Q -> y t x i = 0.
  exact/(free_values_rows ready x u0).
have rows' : forall i, i \in free Q' -> y' t x i = 0.
  by move=> i Hi; rewrite same_rows // rows.
have part' := (free_values_rows ready' x u0).1 rows'.
exists t, x; split=> //.
- split; first exact: (between_t ready).
  by move=> j lt_j; rewrite slipE //; apply: ag.
- have lt0 : (i0 < ns)%N by rewrite mem_iota in Hi0.
  exists (nth 0%N (slip Q) i0); first exact/(slip_indices (Q := Q))/mem_nth.
  by rewrite -[x _]/(slip_of Q x i0) slipE.
move=> k lt_k i row.
have Hk : k \in indices (over lo hi).1 by rewrite mem_iota.
have c0 := row_factor_gt0_ ready grain0 lt_k.
have image0 := local_image grain ready false u0 lt_k part.
have image1 := local_image grain ready' false u0 lt_k part'.
have yE : \sum_(j <- indices (over lo hi).1) F u k j * xs j =
    row_factor_at R a fam lo hi grain k * row.
  have -> : row_factor_at R a fam lo hi grain k * row =
      row_factor_at R a fam lo hi grain k * y t x i +
      mu * g_of k * (row_factor_at R a' fam' lo hi grain k * y' t x i).
    rewrite (same_factor R a other grain r same_size) /row.
    by move: (row_factor_at _ _ _ _ _ _ _) (y t x i) (y' t x i) => *; ring.
  rewrite -image0 -image1 /family_image mulr_sumr -big_split /=; apply: sum_eq => j.
  rewrite mem_iota => /= lt_j; rewrite -[slip_of Q' x j]/(slip_of Q x j) slipE // mulrDl.
  by rewrite -!mulrA.
rewrite -[x i]/(slip_of Q x k) slipE //.
by apply/(complementary_scaled _ _ c0); rewrite -yE; apply: signs.
Qed.

End Present.

(* The same in 1/t. *)
Theorem piece_present_reversed (R : rcfType) n fr ra rb ra' rb' (A B A' B' : nat -> nat -> R) radii
    (g_of : nat -> R) a other fam fam' low_a low_b grain
    r low high after before (mu : R) v (Q := Pencil n ra rb fr) (Q' := Pencil n ra' rb' fr)
    (y := member_reaction n A B) (y' := member_reaction n A' B')
    (part := fun lo hi => local_pencil (size (slip Q)) a low_a low_b fam lo hi false grain)
    (part' := fun lo hi => widened radii
       (local_pencil (size (slip Q)) (friction_anchor a other) low_a low_b fam' lo hi false grain))
    (over := fun lo hi =>
       (mixed low (part lo hi) (part' lo hi), mixed high (part lo hi) (part' lo hi))) :
  prepared_member (swap_pencil Q) B A a fam low_a low_b (swap (upper r)) (swap (lower r)) ->
  prepared_member (swap_pencil Q') B' A' (friction_anchor a other) fam' low_a low_b
    (swap (upper r)) (swap (lower r)) -> within_shares radii (size (slip Q)) g_of ->
  proper_interval a low_a low_b (swap (upper r)) after ->
  proper_interval a low_a low_b before (swap (lower r)) -> (0 <? grain)%Z ->
  size (series_z fam) = size (series_z fam') -> ordered low high -> between mu low high ->
  (forall t (x : nat -> R) i, i \in fr ->
     member_reaction n B' A' t x i = member_reaction n B A t x i) ->
  (0 <? (upper r).2)%Z ->
  check_presence_piece (over (swap (upper r)) (swap (lower r))) (over (swap (upper r)) after)
    (over before (swap (lower r))) (local_region r) v ->
  exists t x, [/\ 0 < t /\ agrees (size (slip Q)) r (slip_of Q x),
    exists2 i, i \in iota 0 n & x i != 0, forall i, i \in fr -> y t x i = 0 &
    forall k, (k < size (slip Q))%N -> let i := nth 0%N (slip Q) k in
      let row := y t x i + mu * (g_of k * y' t x i) in
      [/\ 0 <= x i, 0 <= row & x i * row = 0]].
Proof.
move=> ready ready' shares proper_s proper_f grain0 same_size Om bm same_swapped hi2 ok.
have [t [x [[[lo_t _] ag] nonzero rows signs]]] :=
  @piece_present R n fr rb ra rb' ra' B A B' A' radii g_of a other fam fam' low_a low_b grain
    (swap_region r) low high mu ready ready' shares after before proper_s proper_f grain0 same_size
    Om bm same_swapped v ok.
have [_ l2 _ _ _] := proper_parts ready.
have t_gt0 : 0 < t.
  have h2 : 0 < toR (upper r).2 :> R by rewrite toR_gt0.
  by rewrite -(pmulr_lgt0 _ l2); apply: lt_le_trans h2 _.
have tn0 := lt0r_neq0 t_gt0; have ti : t^-1 != 0 by rewrite invr_eq0.
have back (C D : nat -> nat -> R) i :
    member_reaction n D C t x i = t * member_reaction n C D t^-1 x i.
  by rewrite -[in LHS](invrK t) swap_member // invrK.
exists t^-1, x; split=> //; first by rewrite invr_gt0; split.
  move=> i Hi; have := rows i Hi; rewrite (back A B) => /eqP.
  by rewrite mulf_eq0 (negbTE tn0) => /eqP.
move=> k Hk i row; apply/(complementary_scaled _ _ t_gt0).
have -> : t * row = member_reaction n B A t x i + mu * (g_of k * member_reaction n B' A' t x i).
  rewrite !back /row -/(y t^-1 x i) -/(y' t^-1 x i).
  by move: (y _ _ _) (y' _ _ _) (g_of k) => *; ring.
exact: signs.
Qed.

(* A piece of a body: members of both parts. *)
Section Body.

Variables (R : rcfType) (z : zero_system) (radii : option part_radii) (w : box_anchoring).
Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).
Notation wfQ := (zero_pencil_wellformed z (Lambda2 0 1)).
Hypothesis bounds : both_bounded z radii w.
Variables (A B A' B' : nat -> nat -> R) (g_of : nat -> R).
Hypothesis in_plain : member_of Q0 (omap plain_radii radii) A B.
Hypothesis in_friction : member_of Q1 (omap friction_radii radii) A' B'.
Hypothesis shares : within_shares radii (size (slip Q0)) g_of.
Notation y := (member_reaction (order Q0) A B).
Notation y' := (member_reaction (order Q0) A' B').
Hypothesis same_rows : forall i j, i \in free Q0 -> A' i j = A i j /\ B' i j = B i j.

Definition solved_at mu r t x := [/\ 0 <= t, agrees (size (slip Q0)) r (slip_of Q0 x),
  exists2 i, i \in iota 0 (order Q0) & x i != 0, forall i, i \in free Q0 -> y t x i = 0 &
  forall k, (k < size (slip Q0))%N -> let i := nth 0%N (slip Q0) k in
    let row := y t x i + mu * (g_of k * y' t x i) in
    [/\ 0 <= x i, 0 <= row & x i * row = 0]].

Lemma member_piece low (mu : R) p : check_piece z radii w (box_expansions z radii w) low p ->
  between mu low (piece_end p) -> exists t x, solved_at mu (piece_region p) t x.
Proof.
case/andP=> /andP[Om _] + bm; have /and4P[ba0 bb0 ba1 bb1] := bounds.
case fams_n: (nth None (box_expansions z radii w) (piece_anchor p)) => [fams|//].
have lt_n : (piece_anchor p < size (box_anchors w))%N.
  by rewrite ltnNge; apply/negP => l; rewrite nth_default ?size_map in fams_n.
move: fams_n; rewrite (nth_map no_box_anchor) //.
case: (nth no_box_anchor (box_anchors w) (piece_anchor p)) => reverse a other.
rewrite /expand_box /=.
case ex0: (expand_part Q0 _ reverse a) => [fam|//].
case ex1: (expand_part Q1 _ reverse (friction_anchor a other)) => [fam'|//] [<-].
have same t (x : nat -> R) i : i \in free Q0 -> y' t x i = y t x i.
  by move=> Hi; apply: eq_bigr => j _; have [-> ->] := same_rows j Hi.
have same_swapped t (x : nat -> R) i : i \in free Q0 ->
    member_reaction (order Q0) B' A' t x i = member_reaction (order Q0) B A t x i.
  by move=> Hi; apply: eq_bigr => j _; have [-> ->] := same_rows j Hi.
case: reverse ex0 ex1 => ex0 ex1; last first.
  rewrite /check_present /ends_over /local_part -(size_slips z (Lambda2 0 1)).
  case/and5P=> /= proper /andP[proper_s proper_f] grain0 /eqP same_size ok.
  have ready := member_prepared wfQ in_plain ex0 ba0 bb0 proper.
  have ready' := member_prepared (Q := Q1) wfQ in_friction ex1 ba1 bb1 proper.
  have [t [x [[[lo_t _] ag] nonzero rows signs]]] := piece_present ready ready' shares
    proper_s proper_f grain0 same_size Om bm same ok.
  exists t, x; split=> //; have [l1 l2 _ _ _] := proper_parts ready.
  by rewrite -(pmulr_lge0 _ l2); apply: le_trans lo_t.
rewrite /check_present /ends_over /local_part -(size_slips z (Lambda2 0 1)) => /andP[hi2].
case/and5P=> /= proper /andP[proper_s proper_f] grain0 /eqP same_size ok.
have ready := member_prepared (Q := swap_pencil Q0) wfQ (member_swapped in_plain) ex0
  (swapped_below_a bb0) (swapped_below_b ba0) proper.
have ready' := member_prepared (Q := swap_pencil Q1) wfQ (member_swapped in_friction) ex1
  (swapped_below_a bb1) (swapped_below_b ba1) proper.
have [t [x [[t_gt0 ag] nonzero rows signs]]] := piece_present_reversed ready ready' shares
  proper_s proper_f grain0 same_size Om bm same_swapped hi2 ok.
by exists t, x; split=> //; apply: ltW.
Qed.

(* Pieces that follow each other hold a piece for each friction. *)
Lemma piece_of pieces low bound (mu : R) : (0 <? bound.2)%Z ->
  check_pieces z radii w (box_expansions z radii w) low pieces bound -> between mu low bound ->
  exists low1 p, check_piece z radii w (box_expansions z radii w) low1 p /\
    between mu low1 (piece_end p).
Proof.
move=> b2; have {}b2 : 0 < toR bound.2 :> R by rewrite toR_gt0.
elim: pieces low => [//|p rest IH] low ok [low_mu mu_bound].
have [checked|rest_ok] : check_piece z radii w (box_expansions z radii w) low p /\
    (mu * toR (piece_end p).2 <= toR (piece_end p).1) \/
    check_pieces z radii w (box_expansions z radii w) (piece_end p) rest bound /\
    toR (piece_end p).1 <= mu * toR (piece_end p).2.
- move: ok; case: rest {IH} => [/andP[one le]|q rest /andP[one others]]; last first.
    by case: (lerP (mu * toR (piece_end p).2) (toR (piece_end p).1)) => le; [left | right];
       split=> //; apply: ltW.
  left; split=> //; rewrite -(ler_pmul2r b2) mulrAC.
  have e2 : 0 <= toR (piece_end p).2 :> R.
    by case/andP: one => /andP[o _] _; have [] := ordered_ge0 R o.
  apply: (@le_trans _ _ (toR bound.1 * toR (piece_end p).2)); first exact: ler_wpmul2r.
  by rewrite -!toRM toR_le.
- by have [one le] := checked; exists low, p.
by have [others le] := rest_ok; apply: (IH _ others).
Qed.

Theorem member_present pieces from bound (mu : R) :
  check_presence z radii w pieces from bound -> between mu from bound ->
  exists p t x, halves_apart z (piece_region p) /\ solved_at mu (piece_region p) t x.
Proof.
case/and4P=> _ _ b2 ok bm; have [low [p [checked bp]]] := piece_of b2 ok bm.
have [t [x sol]] := member_piece checked bp.
by exists p, t, x; split=> //; case/andP: checked => /andP[].
Qed.

End Body.

Section Sound.

Variables (R : rcfType) (z : zero_system).
Hypothesis wf_mu : zero_wellformed z Mu.
Let wf : zero_wellformed z (Lambda2 0 1) := zero_wellformed_plain wf_mu.
Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).
Notation wfQ := (zero_pencil_wellformed z (Lambda2 0 1)).

(* The rows of the free variables are the same in both parts. *)
Lemma same_free_rows i : i \in free Q0 -> row_a Q1 i = row_a Q0 i /\ row_b Q1 i = row_b Q0 i.
Proof.
rewrite mem_iota add0n /= => lt_i; rewrite /row_a /row_b /= /variable_forms !map_cat.
by rewrite !nth_cat !size_map lt_i.
Qed.

Lemma same_free_reactions t (x : nat -> R) i : i \in free Q0 ->
  reaction Q1 t x i = reaction Q0 t x i.
Proof.
move/same_free_rows=> [ea eb].
by rewrite /reaction; apply: sum_eq => j _; rewrite /a_entry /b_entry ea eb.
Qed.

Lemma same_swapped_reactions t (x : nat -> R) i : i \in free Q0 ->
  reaction (swap_pencil Q1) t x i = reaction (swap_pencil Q0) t x i.
Proof.
move/same_free_rows=> [ea eb]; rewrite /row_a /row_b in ea eb.
by rewrite /reaction; apply: sum_eq => j _; rewrite /a_entry /b_entry /row_a /row_b /= ea eb.
Qed.

(* A solution in a region where right and left are apart. *)
Lemma motion_of_pencil r t mu (x : nat -> R) : halves_apart z r ->
  agrees (size (slip Q0)) r (slip_of Q0 x) ->
  (exists2 i, i \in iota 0 (order Q0) & x i != 0) ->
  (forall i, i \in free Q0 -> reaction Q0 t x i = 0) ->
  (forall i, i \in slip Q0 ->
     let y := reaction Q0 t x i + mu * reaction Q1 t x i in [/\ 0 <= x i, 0 <= y & x i * y = 0]) ->
  conditions_9z z t mu (zero_motion z x).
Proof.
move=> apart ag nonzero rows signs; apply: (zero_parts_motion wf) => // [i i_slip|].
  by rewrite (flat_split_row (u := Lambda2 0 1)) //; [apply: signs | apply: zero_wellformed_flat].
by apply: (apart_split ag apart) => i /signs[].
Qed.

End Sound.

Theorem zero_presence_sound (R : rcfType) z w pieces from bound :
  check_presence z None w pieces from bound ->
  forall mu : R, between mu from bound -> exists t v, 0 <= t /\ conditions_9z z t mu v.
Proof.
move=> checked mu bm; have /and4P[wf bounds _ _] := checked.
have same i j : i \in free (part_plain z) ->
    a_entry R (part_friction z) i j = a_entry R (part_plain z) i j /\
    b_entry R (part_friction z) i j = b_entry R (part_plain z) i j.
  by move=> Hi; have [ea eb] := same_free_rows Hi; rewrite /a_entry /b_entry ea eb.
have shares : within_shares None (size (slip (part_plain z))) (fun=> 1 : R) by [].
have [p [t [x [apart [t0 ag nonzero rows signs]]]]] :=
  member_present bounds (conj erefl erefl) (conj erefl erefl) shares same checked bm.
exists t, (zero_motion z x); split=> //; apply: (motion_of_pencil wf apart ag nonzero rows).
move=> i /(nthP 0%N)[k lt_k <-]; have := signs k lt_k; cbv zeta beta.
by rewrite mul1r.
Qed.

Corollary presence_sound (R : rcfType) s w pieces from bound :
  check_presence (ZeroSystem s [::]) None w pieces from bound ->
  forall mu : R, between mu from bound -> exists t v, 0 <= t /\ conditions_9 s t mu v.
Proof.
move=> checked mu bm; have [t [v [t0 /no_zero_particles sat]]] := zero_presence_sound checked bm.
by exists t, v.
Qed.
