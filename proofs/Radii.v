(* Bodies with radii as they are written.

   The kernel makes integers of K, M and their radii by one positive factor, and of tangents and
   normals as in Rational.v.  The evidence gives each slip particle a share, a numerator over one
   unit; its friction factor times 1 - share and 1 + share has to enclose the ends of its interval.

   Theorems [radii_absent], [radii_present]: what Members.v proves of the integral members holds of
   the given ones.

   Pages: spec/certificates.md, 5.22; spec/formats.md (radii, friction_factor_range). *)

From Mceip Require Import Base Integers Sums Tree Bounded Condensation Pencil System ZeroReaction
  ZeroPencil Boxes CriticalAnchors PresenceAnchors Members Rational Statement Integral.

Section Checker.

Local Open Scope Z_scope.

Variables (c : scales) (B : rational_system) (radii : rational_radii).
Variables (shares : seq Z) (unit : Z).

Definition scaled_radii := SystemRadii
  [seq scaled_row (entry_scale c) row | row <- radii_of_stiffness radii]
  [seq scaled_row (entry_scale c) row | row <- radii_of_mass radii] shares unit.

(* factor (1 - share) <= lo and hi <= factor (1 + share) *)
Definition range_in_share (f : rational) (range : rational * rational) (share : Z) :=
  [&& 0 <? range.1.2, 0 <? range.2.2,
      f.1 * range.1.2 * (unit - share) <=? range.1.1 * f.2 * unit &
      range.2.1 * f.2 * unit <=? f.1 * range.2.2 * (unit + share)].

Definition exact_radii :=
  [&& exact_system c B, nilp (with_zero B), exact_rows (entry_scale c) (radii_of_stiffness radii),
      exact_rows (entry_scale c) (radii_of_mass radii), 0 <? unit &
      all (fun j => range_in_share
             (factor_of (nth (GivenParticle 0 0 NotInContact ((0, 1), (0, 1)) ((0, 1), (0, 1)) 0
                                (0, 1)) (slipping B) j))
             (nth ((0, 1), (0, 1)) (factor_ranges radii) j) (nth 0 shares j))
        (iota 0 (size (slipping B)))].

Definition check_radii_absent w tr from bound :=
  exact_radii && check_members_absent (scaled_system c B) scaled_radii w tr from bound.

Definition check_radii_present w pieces from bound :=
  exact_radii && check_members_present (scaled_system c B) scaled_radii w pieces from bound.

End Checker.

Section Sound.

Variables (R : rcfType) (c : scales) (B : rational_system) (radii : rational_radii).
Variables (shares : seq Z) (unit : Z).
Hypothesis ex : exact_radii c B radii shares unit.

Notation s := (scaled_system c B).
Notation rad := (scaled_radii c radii shares unit).
Notation C := (toR (entry_scale c) : R).
Notation L := (toR (length_scale c) : R).
Notation dofs_B := (iota 0 (degrees B)).

Let ex_s : exact_system c B. Proof. by case/and5P: ex. Qed.

Lemma radii_no_zero : with_zero B = [::].
Proof. by case/and5P: ex => _ /nilP. Qed.

Lemma radii_flat : zero_wellformed (ZeroSystem s [::]) Mu -> flat_body B.
Proof. by move/zero_wellformed_flat; rewrite (flat_scaled ex_s). Qed.

Variables (k m : nat -> nat -> R) (factor : nat -> R).
Hypothesis member : given_member B radii k m factor.

Definition its_stiffness d e := C * k d e.
Definition its_mass d e := C * m d e.
Definition its_share j := factor j / fraction R (factor_of (slip_at B j)).

Lemma factor_at j : (j < size (slipping B))%N -> 0 < fraction R (factor_of (slip_at B j)).
Proof. by move=> lt_j; have [_ ex_p] := slip_scaled ex_s lt_j; apply: factor_gt0 ex_p. Qed.

Lemma near_scaled rows given d e (x : R) : exact_rows (entry_scale c) rows ->
  exact_rows (entry_scale c) given ->
  `|x - given_entry R given d e| <= given_entry R rows d e ->
  `|C * x - toR (lookup (nth [::] [seq scaled_row (entry_scale c) row | row <- given] d) e)| <=
  toR (lookup (nth [::] [seq scaled_row (entry_scale c) row | row <- rows] d) e).
Proof.
have [C0 _] := scales_gt0 R ex_s.
by move=> ex_r ex_g near; rewrite !scaled_matrix // -mulrBr normrM (gtr0_norm C0) ler_pmul2l.
Qed.

Lemma share_near j : (j < size (slipping B))%N ->
  `|its_share j - 1| * toR unit <= toR (nth 0%Z shares j).
Proof.
move=> lt_j; have f0 := factor_at lt_j; have [_ _ _ ranges] := member.
have [c0 /andP[lo hi]] := ranges j lt_j; move: ex => /and5P[_ _ _ _ /andP[u0 /allP all_in]].
have in_j : j \in iota 0 (size (slipping B)) by rewrite mem_iota.
have /and4P[d1 d2 le_lo le_hi] := all_in j in_j.
set p := slip_at B j in f0 le_lo le_hi *.
have [_ ex_p] := slip_scaled ex_s lt_j; have /and5P[_ _ _ fd0 _] := ex_p.
rewrite -(@toR_gt0 R) in d1; rewrite -(@toR_gt0 R) in d2; rewrite -(@toR_gt0 R) in fd0.
rewrite -(@toR_gt0 R) in u0; rewrite -(@toR_le R) !toRM toRB in le_lo.
rewrite -(@toR_le R) !toRM toRD in le_hi.
set share := toR (nth 0%Z shares j) in le_lo le_hi *.
set range := nth _ _ _ in lo hi d1 d2 le_lo le_hi.
set f := fraction R (factor_of p) in f0 *.
have fE : toR (factor_of p).1 = f * toR (factor_of p).2.
  by rewrite /f /fraction divfK // gt_eqF.
have loE : toR range.1.1 = fraction R range.1 * toR range.1.2.
  by rewrite /fraction divfK // gt_eqF.
have hiE : toR range.2.1 = fraction R range.2 * toR range.2.2.
  by rewrite /fraction divfK // gt_eqF.
have low : f * (toR unit - share) <= factor j * toR unit.
  apply: (@le_trans _ _ (fraction R range.1 * toR unit)); last by rewrite ler_pmul2r.
  rewrite -(ler_pmul2r d1) -(ler_pmul2r fd0).
  move: le_lo; rewrite -[factor_of _]/(factor_of p) fE loE; congr (is_true (_ <= _)).
    by move: (toR _) (toR _) (toR _) => *; ring.
  by move: (fraction _ _) (toR _) (toR _) (toR _) => *; ring.
have high : factor j * toR unit <= f * (toR unit + share).
  apply: (@le_trans _ _ (fraction R range.2 * toR unit)); first by rewrite ler_pmul2r.
  rewrite -(ler_pmul2r d2) -(ler_pmul2r fd0).
  move: le_hi; rewrite -[factor_of _]/(factor_of p) fE hiE; congr (is_true (_ <= _)).
    by move: (fraction _ _) (toR _) (toR _) (toR _) => *; ring.
  by move: (toR _) (toR _) (toR _) => *; ring.
rewrite -[toR unit in X in X <= _]gtr0_norm // -normrM /its_share -/p -/f.
have -> : (factor j / f - 1) * toR unit = (factor j * toR unit - f * toR unit) / f.
  by field; rewrite gt_eqF.
rewrite normrM [`|f^-1|]gtr0_norm ?invr_gt0 // ler_pdivr_mulr // ler_norml.
apply/andP; split; rewrite -subr_ge0; [move: low | move: high]; rewrite -subr_ge0;
  by congr (is_true (0 <= _)); ring.
Qed.

Lemma scaled_member : is_member s rad its_stiffness its_mass its_share.
Proof.
have [sym near_k near_m _] := member.
have /and5P[_ _ ex_k ex_m _] := ex_s; have /and5P[_ _ ex_rk ex_rm _] := ex.
split=> [d e Hd He|d e Hd He|d e Hd He|j].
- by rewrite /its_stiffness; have [-> _] := sym d e Hd He.
- by rewrite /its_mass; have [_ ->] := sym d e Hd He.
- by split; apply: near_scaled => //; [apply: near_k | apply: near_m].
by rewrite size_map => lt_j; apply: share_near.
Qed.

Lemma moves_scaled lambda2 mu v : member_moves B k m factor lambda2 mu v <->
  member_conditions s its_stiffness its_mass its_share lambda2 mu v.
Proof.
have [C0 L0] := scales_gt0 R ex_s.
pose w d := \sum_(e <- dofs_B) (k d e + lambda2 * m d e) * v e.
have forceE d : forced s its_stiffness v d + lambda2 * forced s its_mass v d = C * w d.
  rewrite /forced mulr_sumr -big_split mulr_sumr; apply: eq_bigr => e _ /=.
  by rewrite /its_stiffness /its_mass; move: (k d e) (m d e) (v e) => *; ring.
have zero a (x : R) : 0 < a -> a * x = 0 <-> x = 0.
  move=> a0; split=> [/eqP|->]; last by rewrite mulr0.
  by rewrite mulf_eq0 gt_eqF //= => /eqP.
have rest d : d \in dofs_B ->
    (d \notin moving_dofs s) = (d \in dofs_of [seq p <- given_particles B | sticks p]).
  move=> Hd; rewrite -(stick_scaled ex_s Hd) /moving_with_zero /scaled_zero_system /= radii_no_zero.
  by rewrite cats0.
have slips j : (j < size (slipping B))%N -> let p := particle s j in let p' := slip_at B j in
    let W d := forced s its_stiffness v d + lambda2 * forced s its_mass v d in
    let cone := toR (sign_of p) * along (tangent p) p W +
      mu * (its_share j * along (normal p) p W) in
    let slide' := toR (sign p') * tangential p' v in
    let cone' := toR (sign p') * tangential p' w + factor j * mu * normal_to p' w in
    [/\ along (normal p) p v = 0, slip_rate v p <= 0, cone <= 0 & cone * slip_rate v p = 0] <->
    [/\ normal_to p' v = 0, slide' <= 0, cone' <= 0 & cone' * slide' = 0].
  move=> lt_j p p' W cone slide' cone'; have [eq_p ex_p] := slip_scaled ex_s lt_j.
  have f0 := factor_at lt_j; rewrite -/p' in f0 ex_p eq_p.
  have alongE e : along e p W = C * along e p w.
    by rewrite /along /W !forceE; move: (w _) (w _) => *; ring.
  have -> : cone = C * L * cone'.
    rewrite /cone !alongE /p eq_p (tangent_scaled ex_p) (normal_scaled ex_p) /cone' /=.
    rewrite /its_share -/p'; move: (tangential _ _) (normal_to _ _) => x y.
    by field; rewrite gt_eqF.
  rewrite /p eq_p (slip_rate_scaled v ex_p) (normal_scaled ex_p) -/slide'.
  have CL0 := mulr_gt0 C0 L0; have Lf0 := mulr_gt0 L0 f0.
  rewrite (pmulr_rle0 _ L0) (pmulr_rle0 _ CL0).
  have prod : C * L * cone' * (L * slide') = 0 <-> cone' * slide' = 0.
    by rewrite mulrACA; apply: zero (mulr_gt0 CL0 L0).
  by split=> -[/(zero _ _ Lf0) n r k_le /prod pr]; split.
split=> -[nonzero still free conditions]; split=> //.
- by move=> d Hd; rewrite rest //; apply: still.
- move=> d; rewrite mem_filter => /andP[out Hd]; rewrite forceE.
  by apply/(zero _ _ C0)/free.
- by move=> j; rewrite size_map => lt_j; apply/(slips j lt_j); apply: conditions.
- by move=> d Hd stuck; apply: still; rewrite // rest.
- move=> d Hd out; apply/(zero C _ C0); rewrite -forceE; apply: free.
  by rewrite mem_filter out.
by move=> j lt_j; apply/(slips j lt_j); apply: conditions; rewrite size_map.
Qed.

End Sound.

Theorem radii_absent (R : rcfType) c B radii shares unit w tr from bound :
  check_radii_absent c B radii shares unit w tr from bound ->
  forall k m factor, given_member B radii k m factor ->
  forall (mu t : R) v, between mu from bound -> 0 <= t -> member_moves B k m factor t mu v -> False.
Proof.
case/andP=> ex checked k m factor member mu t v bm t0 /(moves_scaled ex).
have /and3P[wf_rad _ /and3P[wf _ _]] := checked.
exact: (members_absent wf wf_rad (scaled_member ex member) checked t0 bm).
Qed.

Theorem radii_present (R : rcfType) c B radii shares unit w pieces from bound :
  check_radii_present c B radii shares unit w pieces from bound ->
  forall k m factor, given_member B radii k m factor ->
  forall mu : R, between mu from bound -> exists t v, 0 <= t /\ member_moves B k m factor t mu v.
Proof.
case/andP=> ex checked k m factor member mu bm.
have /andP[wf_rad /and4P[wf _ _ _]] := checked.
have [t [v [t0 sat]]] := members_present wf wf_rad (scaled_member ex member) checked bm.
by exists t, v; split=> //; apply/(moves_scaled ex).
Qed.
