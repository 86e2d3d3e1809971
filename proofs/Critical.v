(* No solution below a friction.

   For a mechanical system, t = lambda^2 and mu >= 0 the rows of the complementarity variables are
   affine in mu: with w = (K + t M) v they are q (plain) + m (friction) for mu = m/q, up to the
   positive factor q.  The values at (0, 1) and (1, 0) are the *parts* (ZeroPencil.v).  The system
   may have particles in contact with zero reaction (z); a system without them has an empty list.

   The checker gets a system, two bounds, a witness for the elimination of the free variables, and a
   tree of boxes (Boxes.v).  Both parts are condensed with the same approximation W and with the
   same factors of the rows.  A leaf is

     BoxFarkas w           w excludes the solutions of the box, by the condensed parts;
     BoxDefinite d f f'    a form with weights d is positive on the box, by the condensed parts;
     BoxRegular w          the matrix of a decided box has no null vector, by the condensed parts
                           (Regular.v);
     BoxWhole w w'         a form is positive, for the whole pencils at both ends of the interval
                           of mu;
     BoxSigned c f f'      the forms of enclosed parts of all variables, the free rows times c, are
                           positive (Signed.v), for members of a body (CriticalAnchors.v);
     BoxHalves             right and left of a z particle both move, so no motion is in the box.

   Without the witness there may be leaves BoxWhole and BoxHalves only.

   The pencils of a leaf BoxWhole are those of the system in which z particles are free
   ([freed]).  There a motion with (9) has x'y <= 0, because no power comes from a z particle
   (ZeroPower.v), so a form excludes it, if its weights at z particles are not negative.  In the
   split form no symmetric part is definite while right and left may both move.

   Theorem [zero_critical_absent]: if the check succeeds, then for every mu in [from, bound] and
   every t >= 0 no motion satisfies the conditions (9) with lambda^2 = t and mu.
   [critical_absent]: the same without z particles.  All obstacles are flat: otherwise the check
   fails ([zero_wellformed_flat]).

   Pages: spec/certificates.md, 5.18; spec/zero-reaction.md, Z.3 (frictions) and Z.4.
   Rust: crates/check/src/critical.rs, cover/critical.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Farkas Covered Definite Signed Cover
  Condensation Pencil Whole Complete System ZeroReaction ZeroPencil ZeroPower Boxes Regular.

Inductive critical_leaf :=
  | BoxFarkas of seq Z
  | BoxDefinite of seq Z & factor * factor & factor * factor
  | BoxRegular of regular
  | BoxWhole of whole & whole
  | BoxSigned of Z & signed_ends & signed_ends
  | BoxHalves.

(* Evidence about enclosures of both parts. *)
Definition check_parts (P P' : enclosed) (r : region) (low high : point) (l : critical_leaf) :=
  match l with
  | BoxFarkas v => box_farkas (mixed low P P') (mixed high P P') r v
  | BoxDefinite d f f' => box_definite (mixed low P P') (mixed high P P') r d f f'
  | BoxRegular v => box_regular (mixed low P P') (mixed high P P') r v
  | BoxWhole _ _ | BoxSigned _ _ _ | BoxHalves => false
  end.

(* The system in which the z particles are free. *)
Definition freed z := let s := without_zero z in
  ZeroSystem (System (dofs s) (stiffness s) (mass s)
    [seq d <- iota 0 (dofs s) | d \in free_dofs s ++ zero_dofs z] (particles s) (unit_length s))
    [::].

Section Checker.

Variable z : zero_system.

Notation s := (without_zero z).
Notation nz := (size (zero_particles z)).

(* The whole pencil at a friction, z particles free. *)
Definition pencil_at (e : point) := zero_pencil (freed z) (Lambda2 e.1 e.2).

(* Weights of slip rows are the same at both ends; those of free rows need not be. *)
Definition same_weights (a b : whole) :=
  all (fun i => nth 1 (whole_weights a) i =? nth 1 (whole_weights b) i)%Z
    (iota (free_number (without_zero (freed z))) (size (particles s))).

(* The weight of the row of a freed degree of freedom. *)
Definition freed_weight (a : whole) d :=
  nth 1%Z (whole_weights a) (index d (free_dofs (without_zero (freed z)))).

(* Both rows of a z particle have one weight, which is not negative. *)
Definition zero_weights (a : whole) :=
  all (fun p => (0 <=? freed_weight a (first_dof p)) &&
                (freed_weight a (first_dof p) =? freed_weight a (second_dof p)))%Z
    (zero_particles z).

(* Evidence that needs no enclosures. *)
Definition check_whole_leaf (r : region) (low high : point) (l : critical_leaf) :=
  match l with
  | BoxWhole a b =>
      [&& same_weights a b, zero_weights a, zero_weights b, check_whole (pencil_at low) r a &
          check_whole (pencil_at high) r b]
  | BoxHalves => both_halves z r
  | _ => false
  end.

(* The witness for the other part: the same W, another V. *)
Definition with_left (w : elimination) (other : matrix * matrix) : elimination :=
  Elimination (row_scale w) (unit_of w) (right_w w) other.1 other.2 (bound_c w) (bound_d w)
    (factor_scale w) (stiffness_factor w).

Variable w : option (elimination * (matrix * matrix)).

Definition condensed_parts : option (enclosed * enclosed) :=
  omap (fun wl => (condensed (blocks_of (part_plain z)) wl.1,
                   condensed (blocks_of (part_friction z)) (with_left wl.1 wl.2))) w.

Definition parts_eliminated :=
  if w is Some (w0, other) then
    [&& free_rows_constant (part_plain z), free_rows_constant (part_friction z),
        check_elimination (blocks_of (part_plain z)) w0 &
        check_elimination (blocks_of (part_friction z)) (with_left w0 other)]
  else true.

Definition check_critical_leaf (parts : option (enclosed * enclosed)) (r : region)
    (low high : point) (l : critical_leaf) :=
  (if parts is Some (P0, P1) then check_parts P0 P1 r low high l else false)
  || check_whole_leaf r low high l.

Definition check_critical (tr : tree critical_leaf) (from bound : point) :=
  let parts := condensed_parts in
  [&& zero_wellformed z Mu, parts_eliminated &
      check_boxes (slip_number z) (check_critical_leaf parts) tr (window zero infinity)
        from bound].

End Checker.

(* Both parts. *)
Section Parts.

Variables (R : rcfType) (P P' : enclosed) (A B A' B' : nat -> nat -> R).
Hypotheses (E : encloses P A B) (E' : encloses P' A' B') (same : size_of P' = size_of P).
Variables (r : region) (low high : point) (t mu : R) (xs factor row row' : nat -> R).
Hypotheses (O : ordered (lower r) (upper r)) (Om : ordered low high).
Hypotheses (bt : between t (lower r) (upper r)) (bm : between mu low high).
Hypothesis ag : agrees (size_of P) r xs.
Hypothesis factor0 : forall i, i \in indices P -> 0 < factor i.
Hypothesis imageE : forall i, i \in indices P -> image P A B t xs i = factor i * row i.
Hypothesis imageE' : forall i, i \in indices P -> image P' A' B' t xs i = factor i * row' i.
Hypothesis nonzero : exists2 i, i \in indices P & xs i != 0.
Hypothesis signs : forall i, i \in indices P ->
  let y := row i + mu * row' i in [/\ 0 <= xs i, 0 <= y & xs i * y = 0].

Notation Ae e := (fun i j => toR e.2 * A i j + toR e.1 * A' i j).
Notation Be e := (fun i j => toR e.2 * B i j + toR e.1 * B' i j).

Lemma image_mixed e i : image (mixed e P P') (Ae e) (Be e) t xs i =
  toR e.2 * image P A B t xs i + toR e.1 * image P' A' B' t xs i.
Proof.
have same_ix : indices P' = indices P by rewrite /indices same.
rewrite /image same_ix !mulr_sumr -[in RHS]big_split; apply: eq_bigr => j _ /=.
by rewrite /T; move: (A i j) (A' i j) (B i j) (B' i j) (xs j) (toR e.1) (toR e.2) => *; ring.
Qed.

Theorem parts_absent l : check_parts P P' r low high l -> False.
Proof.
have [f [g [f0 g0 [one val] [fg _]]]] := weights_of_ends Om bm.
have [l1 l2 h1 h2] := ordered_ge0 R Om.
have El := mixed_encloses E E' same l1 l2; have Eh := mixed_encloses E E' same h1 h2.
have sol : box_solution (mixed low P P') (mixed high P P') (Ae low) (Be low) (Ae high) (Be high)
    t f g xs.
  split=> // i Hi; have [x0 y0 xy] := signs Hi; have c0 := factor0 Hi.
  have -> : box_image (mixed low P P') (mixed high P P') (Ae low) (Be low) (Ae high) (Be high)
      t f g xs i = factor i * (row i + mu * row' i).
    rewrite /box_image !image_mixed imageE // imageE' //.
    rewrite -[X in X + mu * _]mul1r -one -val.
    by move: (row i) (row' i) (factor i) => *; ring.
  by split; [exact: x0 | rewrite mulr_ge0 // ltW | rewrite mulrCA xy mulr0].
case: l => [v|d k k'|v|//|//|//] /= ok.
- exact: (box_farkas_sound O bt El Eh _ ag f0 g0 fg sol ok).
- exact: (box_definite_sound El Eh _ O bt ag f0 g0 fg sol ok).
exact: (box_regular_sound El Eh _ O bt ag f0 g0 fg sol ok).
Qed.

End Parts.

Section Sound.

Variables (R : rcfType) (z : zero_system).
Hypothesis wf_mu : zero_wellformed z Mu.

Notation s := (without_zero z).
Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).
Notation L := (toR (unit_length s) : R).
Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).
Notation nobody := (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z.

Let wf : zero_wellformed z (Lambda2 0 1) := zero_wellformed_plain wf_mu.
Let wf_s : system_wellformed s (Lambda2 0 1) := wf_system wf.
Let is_flat : flat s := zero_wellformed_flat wf_mu.

(* The freed system. *)
Notation s' := (without_zero (freed z)).
Notation nf' := (free_number s').

Lemma freed_dof d : (d \in free_dofs s') = (d \in free_dofs s ++ zero_dofs z).
Proof.
rewrite mem_filter andb_idr // mem_cat => /orP[d_in|].
  by apply: (moving_dof_in wf_s); rewrite mem_cat d_in.
rewrite mem_cat => /orP[]/(nthP 0%N)[j]; rewrite size_map => lt_j <-.
  by rewrite -zero_first //; case: (zero_particle_dofs wf lt_j).
by rewrite -zero_second //; case: (zero_particle_dofs wf lt_j).
Qed.

Lemma freed_moving d : (d \in moving_dofs s') = (d \in moving_with_zero z).
Proof.
rewrite !mem_cat freed_dof !mem_cat; case: (d \in free_dofs s) => //=.
by rewrite orbC -!orbA.
Qed.

Lemma uniq_freed :
  [/\ uniq (free_dofs s ++ zero_dofs z), uniq (free_dofs s') &
      perm_eq (free_dofs s') (free_dofs s ++ zero_dofs z)].
Proof.
have /and4P[_ um _ _] := wf.
have u1 : uniq (free_dofs s ++ zero_dofs z).
  move: um; rewrite /moving_with_zero !cat_uniq => /and3P[/andP[-> _] /hasPn out ->].
  rewrite andbT /=; apply/hasPn => d /out; apply: contraNN.
  by rewrite /= mem_cat => ->.
have u2 : uniq (free_dofs s') by rewrite filter_uniq ?iota_uniq.
by split=> //; apply: uniq_perm => // d; apply: freed_dof.
Qed.

Lemma freed_wellformed : zero_wellformed (freed z) (Lambda2 0 1).
Proof.
have /and4P[_ um _ _] := wf; have /and5P[_ _ particles rows rest] := wf_s.
have [_ u2 _] := uniq_freed.
have um' : uniq (moving_dofs s').
  rewrite cat_uniq u2; move: um; rewrite /moving_with_zero /moving_dofs !cat_uniq.
  case/and3P=> /and3P[_ /hasPn out ->] /hasPn out' _; rewrite andbT /=.
  apply/hasPn => d d_in; rewrite /= freed_dof mem_cat negb_or out //=.
  by apply: contraL d_in => /out'; rewrite /= mem_cat negb_or => /andP[].
apply/and4P; split=> //; last by rewrite /moving_with_zero cats0.
apply/and5P; split=> //; apply/allP => d; rewrite freed_moving mem_cat => /orP[|d_in].
  by move/(moving_dof_in wf_s); rewrite mem_iota.
have : d \in free_dofs s' by rewrite freed_dof mem_cat d_in orbT.
by rewrite mem_filter mem_iota => /andP[].
Qed.

(* A motion with (9) and its variables. *)
Section Motion.

Variables (t mu : R) (v : nat -> R).
Hypotheses (t0 : 0 <= t) (mu0 : 0 <= mu) (sat : conditions_9z z t mu v).

Notation x := (zero_variables_of z v).
Notation w := (force s t v).

Lemma motion_split : split z x.
Proof. exact: split_variables. Qed.

Lemma motion_variables : exists2 i, i \in iota 0 (order Q0) & x i != 0.
Proof. by have [] := zero_parts_solution wf sat. Qed.

Lemma free_row_at e i : i \in free Q0 -> reaction (zero_pencil z (Lambda2 e.1 e.2)) t x i = 0.
Proof. by have [_ rows _] := zero_parts_solution wf sat => /rows. Qed.

Lemma slip_conditions i : i \in slip Q0 ->
  let y := reaction Q0 t x i + mu * reaction Q1 t x i in [/\ 0 <= x i, 0 <= y & x i * y = 0].
Proof.
have [_ _ rows] := zero_parts_solution wf sat => i_slip; have := rows i i_slip.
by rewrite (flat_split_row (u := Lambda2 0 1)).
Qed.

(* The freed system has the same motion. *)
Notation x' := (zero_variables_of (freed z) v).

Lemma freed_motion d : d \in all_dofs -> zero_motion (freed z) x' d = v d.
Proof.
have [_ at_rest _ slips _] := sat; apply: (motion_of_zero_variables freed_wellformed).
  by move=> d' d'_in; rewrite /moving_with_zero cats0 freed_moving; apply: at_rest.
by move=> j lt_j; have [] := slips j lt_j.
Qed.

Lemma freed_force d : force s' t (zero_motion (freed z) x') d = w d.
Proof. by apply: sum_eq => j Hj; rewrite freed_motion. Qed.

(* y_i of the freed system: a force at free degrees of freedom, both parts at slip particles. *)
Lemma freed_free_row e k : (k < nf')%N ->
  reaction (pencil_at z e) t x' k = w (nth 0%N (free_dofs s') k).
Proof.
by move=> lt_k; rewrite (zero_free_reaction freed_wellformed) //= freed_force.
Qed.

Lemma freed_free_variable k : (k < nf')%N -> x' k = v (nth 0%N (free_dofs s') k) / L.
Proof. by move=> lt_k; rewrite /zero_variables_of ltn_addr // /variables_of lt_k. Qed.

Definition plain_row p := toR (sign_of p) * along (tangent p) p w.
Definition friction_row p := along (normal p) p w.

Lemma freed_slip_row e j : (j < ns)%N -> let p := particle s j in
  reaction (pencil_at z e) t x' (nf' + j)%N =
  - (toR e.2 * plain_row p + toR e.1 * friction_row p).
Proof.
move=> lt_j p; rewrite (slip_part freed_wellformed) //= /along !freed_force.
by rewrite flat_turning ?flat_particle // toR0 mul0r addr0.
Qed.

Lemma freed_slip_variable j : (j < ns)%N ->
  x' (nf' + j)%N = - (slip_rate v (particle s j) / L ^+ 2).
Proof.
by move=> lt_j; rewrite /zero_variables_of ltn_add2l lt_j /variables_of ltnNge leq_addr /= addKn.
Qed.

Lemma freed_variables : exists2 i, i \in iota 0 (order (pencil_at z (0, 1)%Z)) & x' i != 0.
Proof.
have [[d d_in vd] _ _ _ _] := sat.
apply/hasP; apply: contraNT vd => /hasPn none; rewrite -freed_motion //.
rewrite /zero_motion /table_motion nth_table // /row_value big_seq big1 // => c c_in.
have small := columns_small c_in.
by have := none c.1; rewrite mem_iota small negbK => /(_ isT)/eqP->; rewrite mulr0.
Qed.

(* The weighted power of the free degrees of freedom of the freed system. *)
Definition freed_power (a : whole) :=
  \sum_(k <- iota 0 nf') weight_of R (whole_weights a) k *
    (v (nth 0%N (free_dofs s') k) / L * w (nth 0%N (free_dofs s') k)).

Lemma freed_powerE a : freed_power a =
  L^-1 * \sum_(p <- zero_particles z)
    (toR (freed_weight z a (first_dof p)) * (v (first_dof p) * w (first_dof p)) +
     toR (freed_weight z a (second_dof p)) * (v (second_dof p) * w (second_dof p))).
Proof.
have [_ _ rows_f _ _] := sat; have [_ u2 perm] := uniq_freed.
pose f d := toR (freed_weight z a d) * (v d * w d).
transitivity (L^-1 * \sum_(d <- free_dofs s') f d).
  rewrite mulr_sumr sum_positions; apply: sum_eq => k; rewrite mem_iota add0n /= => lt_k.
  rewrite /f /freed_weight index_uniq // /weight_of.
  by move: (toR _) (v _) (w _) (L^-1) => *; ring.
congr (_ * _); rewrite (perm_big _ perm) /= big_cat /= sum_zero ?add0r; last first.
  by move=> d /rows_f wd; rewrite /f wd !mulr0.
by rewrite /zero_dofs big_cat !big_map -big_split.
Qed.

Lemma freed_power_le0 a : zero_weights z a -> freed_power a <= 0.
Proof.
move=> weights; rewrite freed_powerE.
have L0 : 0 < L := unit_length_gt0 R wf_s.
apply: mulr_ge0_le0; first by rewrite invr_ge0 ltW.
rewrite (big_nth nobody) big_nat -oppr_ge0 -sumrN; apply: sumr_ge0 => j /= lt_j.
have /andP[w0 /Z.eqb_spec <-] := all_nthP nobody weights j lt_j.
rewrite -mulrDr oppr_ge0 mulr_ge0_le0 ?toR_ge0 //.
exact: (zero_power_le0 wf sat mu0 lt_j).
Qed.

(* A box of t and mu that holds the motion. *)
Section Box.

Variables (r : region) (low high : point).
Hypotheses (O : ordered (lower r) (upper r)) (Om : ordered low high).
Hypotheses (bt : between t (lower r) (upper r)) (bm : between mu low high).
Hypothesis ag : agrees (slip_number z) r (slip_of Q0 x).

Lemma freed_agrees : agrees (size (slip (pencil_at z low))) r (slip_of (pencil_at z low) x').
Proof.
move=> j; rewrite size_slips {1}/slip_number /= addn0 => lt_j.
have lt_j' : (j < slip_number z)%N by rewrite ltn_addr.
have := ag lt_j'; rewrite /slip_of !zero_slips !nth_iota //; last by rewrite /slip_number ltn_addr.
rewrite freed_slip_variable // /zero_variables_of ltn_add2l lt_j.
by rewrite /variables_of ltnNge leq_addr /= addKn.
Qed.

(* The same of the slip particles, at a friction. *)
Definition slip_power (a : whole) (e : point) :=
  \sum_(j <- iota 0 ns) weight_of R (whole_weights a) (nf' + j) *
    (slip_rate v (particle s j) / L ^+ 2 *
     (toR e.2 * plain_row (particle s j) + toR e.1 * friction_row (particle s j))).

Lemma whole_power a e :
  \sum_(i <- iota 0 (order (pencil_at z e)))
    weight_of R (whole_weights a) i * (x' i * reaction (pencil_at z e) t x' i) =
  freed_power a + slip_power a e.
Proof.
rewrite /= muln0 addn0 iotaD big_cat /=; congr (_ + _).
  apply: sum_eq => k; rewrite mem_iota add0n /= => lt_k.
  by rewrite freed_free_row // freed_free_variable.
rewrite add0n -[X in iota X](addn0 nf') iotaDl big_map /slip_power; apply: sum_eq => j.
rewrite mem_iota add0n /= => lt_j.
by rewrite freed_slip_row // freed_slip_variable // mulrNN.
Qed.

(* In the box the slip particles have none. *)
Lemma slip_power_zero f g a b : same_weights z a b ->
  f * toR low.2 + g * toR high.2 = 1 -> f * toR low.1 + g * toR high.1 = mu ->
  f * slip_power a low + g * slip_power b high = 0.
Proof.
move=> /allP weights one val; rewrite !mulr_sumr -big_split sum_zero // => j.
rewrite mem_iota add0n => lt_j.
have /Z.eqb_spec same : (nth 1 (whole_weights a) (nf' + j) =? nth 1 (whole_weights b) (nf' + j))%Z.
  by apply: weights; rewrite mem_iota leq_addr ltn_add2l.
have [_ _ _ /(_ j lt_j)[_ _ _ product] _] := sat.
transitivity (weight_of R (whole_weights a) (nf' + j) / L ^+ 2 *
  (((f * toR low.2 + g * toR high.2) * plain_row (particle s j) +
    (f * toR low.1 + g * toR high.1) * friction_row (particle s j)) *
   slip_rate v (particle s j))).
  rewrite /weight_of -same /=.
  move: (toR (nth _ _ _)) (slip_rate _ _) (plain_row _) (friction_row _) (L ^+ 2)^-1 => *.
  by ring.
rewrite one val mul1r -[X in _ * (X * _)](_ : cone s t mu v (particle s j) = _) ?product ?mulr0 //.
by rewrite /cone turning_at_flat ?mul0r ?addr0 // flat_particle.
Qed.

Lemma whole_absent a b :
  [&& same_weights z a b, zero_weights z a, zero_weights z b, check_whole (pencil_at z low) r a &
      check_whole (pencil_at z high) r b] -> False.
Proof.
case/and5P=> same zero_a zero_b checked_a checked_b.
have [f [g [f0 g0 [one val] [fg _]]]] := weights_of_ends Om bm.
have wfQ e : wellformed (pencil_at z e) := zero_pencil_wellformed _ _.
have la := whole_image (Q := pencil_at z low) (wfQ _) O checked_a bt freed_agrees freed_variables.
have hb := whole_image (Q := pencil_at z high) (wfQ _) O checked_b bt freed_agrees freed_variables.
have := combination_gt0 f0 g0 fg la hb; rewrite !whole_power.
have -> : f * (freed_power a + slip_power a low) + g * (freed_power b + slip_power b high) =
    f * freed_power a + g * freed_power b.
  rewrite -[RHS]addr0 -(slip_power_zero same one val).
  by move: (freed_power a) (freed_power b) (slip_power a _) (slip_power b _) => *; ring.
rewrite ltNge -oppr_ge0 opprD -!mulrN.
by rewrite addr_ge0 // mulr_ge0 // oppr_ge0 freed_power_le0.
Qed.

Lemma whole_leaf_absent l : check_whole_leaf z r low high l -> False.
Proof.
case: l => [v'|d f f'|v'|a b|c f f'|] //=; first exact: whole_absent.
move=> both; have ag' : agrees (size (slip Q0)) r (slip_of Q0 x) by rewrite size_slips.
exact: both_not_split ag' both motion_split.
Qed.

Section Condensed.

Variables (e : elimination) (other : matrix * matrix).
Hypothesis eliminated : parts_eliminated z (Some (e, other)).

Notation e' := (with_left e other).
Notation D0 := (blocks_of Q0).
Notation D1 := (blocks_of Q1).
Notation P0 := (condensed D0 e).
Notation P1 := (condensed D1 e').
Notation xs := (slip_of Q0 x).
Notation wfQ := (zero_pencil_wellformed z (Lambda2 0 1)).

Lemma eliminated_parts :
  [/\ free_rows_constant Q0 /\ free_rows_constant Q1,
      stiffness_positive D0 e /\ shapes D0 e & stiffness_positive D1 e' /\ shapes D1 e'].
Proof. by case/and4P: eliminated => c0 c1 /andP[? ?] /andP[? ?]. Qed.

Lemma plain_free k : k \in iota 0 (size (free Q0)) -> free_of Q0 x k = free_part D0 xs k.
Proof.
have [[c0 _] [pos _] _] := eliminated_parts.
exact: (free_part_of_rows wfQ c0 pos (free_row_at (0, 1)%Z)).
Qed.

Lemma friction_free k : k \in iota 0 (size (free Q1)) -> free_of Q1 x k = free_part D1 xs k.
Proof.
have [[_ c1] _ [pos _]] := eliminated_parts.
exact: (free_part_of_rows (Q := Q1) wfQ c1 pos (free_row_at (1, 0)%Z)).
Qed.

Lemma condensed_absent l : check_parts P0 P1 r low high l -> False.
Proof.
have [[c0 c1] [p0 s0] [p1 s1]] := eliminated_parts.
have lt_slip i : i \in indices P0 -> (i < size (slip Q0))%N by rewrite mem_iota.
apply: (parts_absent (condensation_encloses R p0 s0) (condensation_encloses R p1 s1) (erefl _)
  O Om bt bm (xs := xs) (factor := fun i => scale_of R e i * toR (unit_of e) ^+ 2)
  (row := fun i => reaction Q0 t x (nth 0%N (slip Q0) i))
  (row' := fun i => reaction Q1 t x (nth 0%N (slip Q0) i))).
- by move: ag; rewrite -(size_slips z (Lambda2 0 1)).
- by move=> i Hi; rewrite mulr_gt0 ?exprn_gt0 ?(scale_gt0 _ s0) ?(unit_gt0 _ s0).
- by move=> i /lt_slip lt_i; rewrite (condensed_reaction wfQ e t lt_i plain_free).
- by move=> i /lt_slip lt_i; rewrite (condensed_reaction (Q := Q1) wfQ e' t lt_i friction_free).
- exact: (slip_part_nonzero plain_free motion_variables).
by move=> i /lt_slip lt_i; apply: slip_conditions; apply: mem_nth.
Qed.

End Condensed.

Lemma critical_leaf_absent e l : parts_eliminated z e ->
  check_critical_leaf z (condensed_parts z e) r low high l -> False.
Proof.
move=> eliminated /orP[|]; last exact: whole_leaf_absent.
by case: e eliminated => [[e other]|] //= eliminated; apply: condensed_absent.
Qed.

End Box.

(* Where the search for a leaf begins. *)
Lemma motion_start : (forall j, (j < slip_number z)%N -> 0 <= slip_of Q0 x j) /\
  in_region (slip_number z) t (slip_of Q0 x) (window zero infinity).
Proof.
split=> [j|].
  by rewrite -(size_slips z (Lambda2 0 1)) => lt_j; have [] := slip_conditions (mem_nth 0%N lt_j).
split; last by move=> i _; rewrite /state_of nth_nil.
by rewrite /between /= toR0 toR1 mulr1 mulr0 ler01.
Qed.

End Motion.

End Sound.

Theorem zero_critical_absent (R : rcfType) z w tr from bound : check_critical z w tr from bound ->
  forall (t mu : R) v, 0 <= t -> between mu from bound -> conditions_9z z t mu v -> False.
Proof.
case/and3P=> wf eliminated boxes t mu v t0 bm sat.
have [x0 start] := motion_start wf t0 sat.
have [r [low [high [l [_ [[bt ag] bm' O Om ok]]]]]] := box_reaches_a_leaf boxes x0 start bm.
exact: (critical_leaf_absent wf (between_ge0 Om bm') sat O Om bt bm' ag eliminated ok).
Qed.

Corollary critical_absent (R : rcfType) s w tr from bound :
  check_critical (ZeroSystem s [::]) w tr from bound ->
  forall (t mu : R) v, 0 <= t -> between mu from bound -> conditions_9 s t mu v -> False.
Proof.
by move=> checked t mu v t0 bm /no_zero_particles; apply: (zero_critical_absent checked t0 bm).
Qed.
