(* The power identity for particles in contact with zero reaction.

   For every motion v with (9) and its forces w, in unit tangents and unit normals,

       v'w  =  mu sum_s x c w_N  +  mu sum_z |v_T| c w_N  -  sum_s (1 + c^2 mu^2) g x^2,

   with x = -S v_T, c the friction factor of the particle and g its geometric stiffness
   ([power_identity]).  The sum over the z particles is at most 0, and the last one is 0 where all
   obstacles are flat.  There, if v'w > 0, as it is if K + lambda^2 M is positive definite, then
   mu > 0 and some slip particle slips while its pressure falls: x > 0 and w_N > 0
   ([slips_while_pressure_falls]).  A system without slip particles has no solution.

   Page: spec/zero-reaction.md, Z.2. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Condensation Pencil Claim System Lifted
  ZeroReaction.

Section Power.

Variables (R : rcfType) (z : zero_system) (u : unknown).
Implicit Types v w : nat -> R.

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).
Notation nobody := (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z.

(* v'w with w = (K + lambda^2 M) v *)
Definition power lambda2 v := \sum_(d <- all_dofs) v d * force s lambda2 v d.

(* The part of v'w at a particle. *)
Definition power_at v w p :=
  v (first_dof p) * w (first_dof p) + v (second_dof p) * w (second_dof p).

Hypothesis wf : zero_wellformed z u.

(* Two perpendicular directions. *)
Lemma perpendicular (t1 t2 n1 n2 v1 v2 w1 w2 l : R) :
  t1 ^+ 2 + t2 ^+ 2 = l -> 0 < l -> 0 < n1 ^+ 2 + n2 ^+ 2 -> t1 * n1 + t2 * n2 = 0 ->
  (n1 * v1 + n2 * v2) * (n1 * w1 + n2 * w2) = 0 ->
  l * (v1 * w1 + v2 * w2) = (t1 * v1 + t2 * v2) * (t1 * w1 + t2 * w2).
Proof.
move=> tt l0 nn tn vw; have [k k0 [e1 e2]] := orthogonal l0 tt nn tn.
have cross : (t1 * v2 - t2 * v1) * (t1 * w2 - t2 * w1) = 0.
  by apply: (mulfI (expf_neq0 2 k0)); rewrite mulr0 -vw e1 e2; ring.
by rewrite -[RHS]addr0 -cross -tt; ring.
Qed.

Lemma power_particles lambda2 mu v : conditions_9z z lambda2 mu v ->
  power lambda2 v =
  \sum_(p <- particles s) power_at v (force s lambda2 v) p +
  \sum_(p <- zero_particles z) power_at v (force s lambda2 v) p.
Proof.
case=> _ at_rest free _ _; have [wfs um in_range _] := and4P wf.
set w := force s lambda2 v; pose f d := v d * w d.
have in_all d : d \in moving_with_zero z -> d \in all_dofs.
  rewrite mem_cat => /orP[/(moving_dof_in wfs)//|]; rewrite mem_cat.
  move/(all_nthP nobody): in_range => in_range.
  by case/orP=> /(nthP 0%N)[j]; rewrite size_map => lt_j <-; rewrite (nth_map nobody) //;
    have /andP[] := in_range j lt_j; rewrite mem_iota.

have -> : power lambda2 v = \sum_(d <- moving_with_zero z) f d.
  apply: (sum_subset (iota_uniq _ _) um) => [d|d Hd out]; first exact: in_all.
  by rewrite at_rest ?mul0r.

rewrite /moving_with_zero /moving_dofs /first_dofs /second_dofs /zero_dofs !big_cat !big_map /=.
rewrite (sum_zero (l := free_dofs s)) => [|d /free]; last by rewrite /f /w => ->; rewrite mulr0.
by rewrite add0r -!big_split.
Qed.

(* Tangents are unit_length times unit vectors, normals this times the friction factor. *)
Lemma zero_power lambda2 mu v j : conditions_9z z lambda2 mu v -> (j < nz)%N ->
  let p := zero_particle z j in let w := force s lambda2 v in
  toR (unit_length s) ^+ 2 * power_at v w p =
  mu * (`|along (tangent p) p v| * along (normal p) p w).
Proof.
case=> _ _ _ _ zeros lt_j p w; have [wfs _ _ frames] := and4P wf.
have l0 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0 // (unit_length_gt0 R wfs).
have [_ _ vw _ slip] := zeros j lt_j; rewrite -/p -/w in vw slip.
have /(all_nthP nobody)/(_ j lt_j) := frames; rewrite -/(zero_particle z j) -/p.
case/and3P=> /Z.eqb_spec tt nn /Z.eqb_spec tn.
have {}tt : toR (tangent p).1 ^+ 2 + toR (tangent p).2 ^+ 2 = toR (unit_length s) ^+ 2 :> R.
  by rewrite !expr2 -!toRM -toRD -tt.
have {}nn : 0 < toR (normal p).1 ^+ 2 + toR (normal p).2 ^+ 2 :> R.
  by rewrite !expr2 -!toRM -toRD toR_gt0.
have {}tn : toR (tangent p).1 * toR (normal p).1 + toR (tangent p).2 * toR (normal p).2 = 0 :> R.
  by rewrite -!toRM -toRD -[(_ + _)%Z]/(inner (tangent p) (normal p)) tn.
rewrite /power_at (perpendicular tt l0 nn tn) //.
rewrite -/(along (tangent p) p v) -/(along (tangent p) p w).
move: slip; move: (along (tangent p) p v) (along (tangent p) p w) (along (normal p) p w).
move=> v_T w_T w_N.
case: (ltrgtP v_T 0) => [vT|vT|->]; last by rewrite normr0 !mul0r mulr0.
  by rewrite ltr0_norm // => slip; rewrite -[LHS]opprK -mulNr slip mulNr mulrN mulrA.
by rewrite gtr0_norm // mulrA.
Qed.

(* No power comes from a z particle. *)
Lemma zero_power_le0 lambda2 mu v j : conditions_9z z lambda2 mu v -> 0 <= mu -> (j < nz)%N ->
  power_at v (force s lambda2 v) (zero_particle z j) <= 0.
Proof.
move=> cond mu0 lt_j; have [_ _ _ _ /(_ j lt_j)[_ wN _ _ _]] := cond.
have [wfs _ _ _] := and4P wf.
have l0 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0 // (unit_length_gt0 R wfs).
rewrite -(pmulr_rle0 _ l0) (zero_power cond lt_j).
by rewrite mulr_ge0_le0 // mulr_ge0_le0.
Qed.

Theorem power_identity lambda2 mu v : conditions_9z z lambda2 mu v ->
  let w := force s lambda2 v in
  toR (unit_length s) ^+ 2 * power lambda2 v =
  mu * (\sum_(p <- particles s) - slip_rate v p * along (normal p) p w +
        \sum_(p <- zero_particles z) `|along (tangent p) p v| * along (normal p) p w) -
  \sum_(p <- particles s) turning_at s mu p * slip_rate v p ^+ 2.
Proof.
move=> cond w; have [_ _ _ slips _] := cond; have [wfs _ _ _] := and4P wf.
have l0 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0 // (unit_length_gt0 R wfs).
rewrite (power_particles cond) -/w !mulrDr !mulr_sumr addrAC; congr (_ + _).
  rewrite -sumrB !(big_nth nobody) !big_nat; apply: eq_bigr => j /= lt_j.
  rewrite -!/(particle s j); set p := particle s j.
  have [nv _ _ product] := slips j lt_j; have [sq tt nn tn] := particle_parts R wfs lt_j.
  rewrite -/p in nv product sq tt nn tn.
  rewrite /power_at (perpendicular tt l0 nn tn); last first.
    by move: nv; rewrite /along => ->; rewrite mul0r.
  rewrite -/(along (tangent p) p v) -/(along (tangent p) p w) -[LHS]mul1r -sq.
  rewrite -[RHS](addr0) -product /cone /slip_rate -/w; move: (turning_at _ _ _) => turning.
  by move: (along _ _ _) (along _ _ _) (along _ _ _) (toR _) => *; ring.

rewrite !(big_nth nobody) !big_nat; apply: eq_bigr => j /= lt_j.
exact: zero_power.
Qed.

(* v'w > 0 holds for every v != 0 if K + lambda^2 M is positive definite. *)
Theorem slips_while_pressure_falls lambda2 mu v : flat s -> conditions_9z z lambda2 mu v ->
  0 <= mu -> 0 < power lambda2 v ->
  [/\ 0 < mu & exists2 j, (j < ns)%N & let p := particle s j in
     slip_rate v p < 0 /\ 0 < along (normal p) p (force s lambda2 v)].
Proof.
move=> is_flat cond mu0 positive; have [_ _ _ slips zeros] := cond; have [wfs _ _ _] := and4P wf.
have l0 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0 // (unit_length_gt0 R wfs).

have := mulr_gt0 l0 positive; rewrite (power_identity cond).
rewrite [X in _ - X](_ : _ = 0) ?subr0; last first.
  rewrite (big_nth nobody) big_nat big1 // => j /= lt_j.
  by rewrite turning_at_flat ?mul0r // (flat_particle is_flat lt_j).
set slip_part := \sum_(p <- particles s) _; set zero_part := \sum_(p <- zero_particles z) _.
have zero_le : zero_part <= 0.
  rewrite /zero_part (big_nth nobody) big_nat -oppr_ge0 -sumrN; apply: sumr_ge0 => j /= lt_j.
  by have [_ wN _ _ _] := zeros j lt_j; rewrite oppr_ge0; apply: mulr_ge0_le0.

move=> total; have mu_pos : 0 < mu.
  by rewrite lt_neqAle mu0 andbT; apply: contraTneq total => <-; rewrite mul0r ltxx.

split=> //; move: total; rewrite pmulr_rgt0 // => total.
have : 0 < slip_part by apply: lt_le_trans total _; rewrite ger_addl.
rewrite /slip_part (big_nth nobody) => slip_gt.
have [/existsP[j both]|/existsPn none] := boolP [exists j : 'I_ns,
    (slip_rate v (particle s j) < 0) &&
    (0 < along (normal (particle s j)) (particle s j) (force s lambda2 v))].
  by exists j => //; apply/andP.
move: slip_gt; rewrite ltNge big_nat -oppr_ge0 -sumrN sumr_ge0 // => j /= lt_j.
rewrite oppr_ge0.
have := none (Ordinal lt_j); have [_ rate _ _] := slips j lt_j.
rewrite /= -/(particle s j) negb_and -!leNgt mulNr oppr_le0 => /orP[rate0|pressure].
  have -> : slip_rate v (particle s j) = 0 by apply/eqP; rewrite eq_le rate rate0.
  by rewrite mul0r.
exact: mulr_le0.
Qed.

End Power.
