(* The real numbers: every theorem about certificates holds for them.

   The theorems are proved over every real closed field.  Here Coq's real numbers R are one, with
   their own order ([reals_le]), sum, product and unit ([reals_ring]); roots of polynomials come
   from the intermediate value theorem of Coq's library.  The real algebraic numbers of mathcomp
   are another, without axioms.  [answer_sound], the theorem of every verdict, and those behind it
   (README.md, "Sentences") follow for both.

   What is said about R rests on the axioms of Coq's real numbers (sig_forall_dec, sig_not_dec,
   functional_extensionality_dep) and on epsilon_statement, by which mathcomp chooses among real
   numbers.  What is said about the real algebraic numbers rests on none. *)

From Coq Require Import Epsilon FunctionalExtensionality Reals Lra.
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp.real_closed Require Import realalg.
From Mceip Require Import Claim EnclosedClaim System Lifted ZeroReaction ZeroEnclosed PlainMcp.
From Mceip Require Import Families Varying Covers ZeroComplete Critical CriticalAnchors.
From Mceip Require Import PresenceAnchors Radii.
From Mceip Require Import Points Reflection Quadratic Equilibrium Unique Stable Verdict.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope R_scope.

Lemma equalP : Equality.axiom (fun x y : R => Req_EM_T x y : bool).
Proof. by move=> x y; case: Req_EM_T => H; constructor. Qed.

Canonical reals_eqType := EqType R (EqMixin equalP).

(* A real number that has the property, if there is one. *)
Definition choice (P : pred R) (_ : nat) :=
  let x := epsilon (inhabits 0) P in if P x then Some x else None.

Fact choice_correct P n x : choice P n = Some x -> P x.
Proof. by rewrite /choice; case: ifP => // H [<-]. Qed.

Fact choice_complete (P : pred R) : (exists x, P x) -> exists n, choice P n.
Proof. by move=> some; exists 0%N; rewrite /choice (epsilon_spec (inhabits 0) P some). Qed.

Fact choice_extensional P P' : P =1 P' -> choice P =1 choice P'.
Proof. by move=> same n; have -> : P = P' by apply: functional_extensionality. Qed.

Canonical reals_choiceType :=
  ChoiceType R (Choice.Mixin choice_correct choice_complete choice_extensional).

Fact add_associative : associative Rplus. Proof. by move=> *; ring. Qed.
Fact add_commutative : commutative Rplus. Proof. by move=> *; ring. Qed.
Fact add_zero : left_id 0 Rplus. Proof. by move=> *; ring. Qed.
Fact add_opposite : left_inverse 0 Ropp Rplus. Proof. by move=> *; ring. Qed.

Canonical reals_zmodType :=
  ZmodType R (ZmodMixin add_associative add_commutative add_zero add_opposite).

Fact mul_associative : associative Rmult. Proof. by move=> *; ring. Qed.
Fact mul_commutative : commutative Rmult. Proof. by move=> *; ring. Qed.
Fact mul_one : left_id 1 Rmult. Proof. by move=> *; ring. Qed.
Fact mul_add : left_distributive Rmult Rplus. Proof. by move=> *; ring. Qed.
Fact one_not_zero : is_true (negb (eq_op 1 0)). Proof. by apply/eqP; lra. Qed.

Canonical reals_ringType :=
  RingType R (ComRingMixin mul_associative mul_commutative mul_one mul_add one_not_zero).
Canonical reals_comRingType := ComRingType R mul_commutative.

Definition inverse x := if x == 0 then 0 else / x.

Fact inverse_left : GRing.Field.axiom inverse.
Proof. by move=> x x0; rewrite /inverse (negbTE x0); apply: Rinv_l; apply/eqP. Qed.

Fact inverse_zero : inverse 0 = 0.
Proof. by rewrite /inverse eqxx. Qed.

Canonical reals_unitRingType := UnitRingType R (FieldUnitMixin inverse_left inverse_zero).
Canonical reals_comUnitRingType := [comUnitRingType of R].

Fact field_axiom : GRing.Field.mixin_of reals_unitRingType. Proof. by []. Qed.

Canonical reals_idomainType := IdomainType R (FieldIdomainMixin field_axiom).
Canonical reals_fieldType := FieldType R field_axiom.

Definition le x y : bool := Rle_dec x y.
Definition lt x y : bool := Rlt_dec x y.

Lemma leP x y : reflect (x <= y) (le x y).
Proof. by rewrite /le; case: Rle_dec => H; constructor. Qed.

Lemma ltP x y : reflect (x < y) (lt x y).
Proof. by rewrite /lt; case: Rlt_dec => H; constructor. Qed.

Fact le_add x y : le 0 x -> le 0 y -> le 0 (x + y).
Proof. by move=> /leP ? /leP ?; apply/leP; lra. Qed.

Fact le_mul x y : le 0 x -> le 0 y -> le 0 (x * y).
Proof. by move=> /leP ? /leP ?; apply/leP; apply: Rmult_le_pos. Qed.

Fact le_anti x : le 0 x -> le x 0 -> x = 0.
Proof. by move=> /leP ? /leP ?; lra. Qed.

Fact le_sub x y : le 0 (y - x) = le x y.
Proof. by apply/leP/leP => ?; lra. Qed.

Fact le_total x : le 0 x || le x 0.
Proof. by apply/orP; case: (Rle_dec 0 x) => H; [left|right]; apply/leP; lra. Qed.

Fact abs_nonnegative x : le 0 x -> Rabs x = x.
Proof. by move=> /leP H; apply: Rabs_pos_eq. Qed.

Fact lt_is_le x y : lt x y = (y != x) && le x y.
Proof.
apply/ltP/andP => [H|[/eqP H /leP]]; last by case=> // /esym.
by split; [apply/eqP|apply/leP]; lra.
Qed.

Definition order := @RealLeMixin reals_idomainType le lt Rabs
  le_add le_mul le_anti le_sub le_total Rabs_Ropp abs_nonnegative lt_is_le.

Canonical reals_porderType := POrderType ring_display R order.
Canonical reals_latticeType := LatticeType R order.
Canonical reals_distrLatticeType := DistrLatticeType R order.
Canonical reals_orderType := OrderType R order.
Canonical reals_numDomainType := NumDomainType R order.
Canonical reals_normedZmodType := NormedZmodType R R order.
Canonical reals_numFieldType := [numFieldType of R].
Canonical reals_realDomainType := [realDomainType of R].
Canonical reals_realFieldType := [realFieldType of R].

Lemma horner_continuous (p : {poly R}) : continuity (horner p).
Proof.
elim/poly_ind: p => [|p c IH].
  have -> : horner 0 = fct_cte 0 by apply: functional_extensionality => x; rewrite horner0.
  by apply: continuity_const.
have -> : horner (p * 'X + c%:P) = plus_fct (mult_fct (horner p) id) (fct_cte c).
  by apply: functional_extensionality => x; rewrite hornerMXaddC.
apply: continuity_plus; last by apply: continuity_const.
by apply: continuity_mult => //; apply: derivable_continuous; apply: derivable_id.
Qed.

Fact real_closed : Num.real_closed_axiom reals_numDomainType.
Proof.
move=> p a b /leP ab /andP[/leP pa /leP pb].
have [|z [[az zb] pz]] := IVT_cor (horner p) a b (@horner_continuous p) ab.
  by rewrite -(Rmult_0_l (horner p b)); apply: Rmult_le_compat_r.
by exists z; [apply/andP; split; apply/leP|apply/rootP].
Qed.

Canonical reals := RcfType R real_closed.

(* The operations and the order of the field are those of Coq. *)
Lemma reals_meaning (x y : reals) :
  [/\ GRing.add x y = Rplus x y, GRing.mul x y = Rmult x y, GRing.one reals = R1 &
      Order.le x y <-> Rle x y].
Proof. by split=> //; split=> /leP. Qed.

Definition answer_sound_R := @answer_sound reals.
Definition families_number_R := @families_number reals.
Definition families_hold_R := @families_hold reals.
Definition system_families_number_R := @system_families_number reals.
Definition system_families_hold_R := @system_families_hold reals.
Definition varying_number_R := @varying_number reals.
Definition varying_hold_R := @varying_hold reals.
Definition system_varying_number_R := @system_varying_number reals.
Definition system_varying_hold_R := @system_varying_hold reals.
Definition zero_complete_number_R := @zero_complete_number reals.
Definition zero_complete_hold_R := @zero_complete_hold reals.
Definition zero_varying_number_R := @zero_varying_number reals.
Definition zero_varying_hold_R := @zero_varying_hold reals.
Definition claim_sound_R := @claim_sound reals.
Definition enclosed_claim_sound_R := @enclosed_claim_sound reals.
Definition system_claim_R := @system_claim reals.
Definition lifted_sound_R := @lifted_sound reals.
Definition system_enclosed_R := @system_enclosed reals.
Definition zero_sound_R := @zero_sound reals.
Definition zero_enclosed_sound_R := @zero_enclosed_sound reals.
Definition critical_absent_R := @critical_absent reals.
Definition anchored_critical_absent_R := @anchored_critical_absent reals.
Definition zero_critical_absent_R := @zero_critical_absent reals.
Definition zero_anchored_critical_absent_R := @zero_anchored_critical_absent reals.
Definition radii_absent_R := @radii_absent reals.
Definition radii_present_R := @radii_present reals.
Definition presence_sound_R := @presence_sound reals.
Definition zero_presence_sound_R := @zero_presence_sound reals.
Definition point_number_R := @point_number reals.
Definition point_hold_R := @point_hold reals.
Definition system_point_number_R := @system_point_number reals.
Definition system_point_hold_R := @system_point_hold reals.
Definition infinity_number_R := @infinity_number reals.
Definition infinity_hold_R := @infinity_hold reals.
Definition reflected_equivalent_R := @reflected_equivalent reals.
Definition both_signs_R := @both_signs reals.
Definition linearized_equivalent_R := @linearized_equivalent reals.
Definition reflected_quadratic_equivalent_R := @reflected_quadratic_equivalent reals.
Definition plain_mcp_sound_R := @plain_mcp_sound reals.
Definition equilibrium_sound_R := @equilibrium_sound reals.
Definition rates_sound_R := @rates_sound reals.
Definition stability_sound_R := @stability_sound reals.

Definition answer_sound_realalg := @answer_sound realalg_rcfType.
Definition families_number_realalg := @families_number realalg_rcfType.
Definition families_hold_realalg := @families_hold realalg_rcfType.
Definition system_families_number_realalg := @system_families_number realalg_rcfType.
Definition system_families_hold_realalg := @system_families_hold realalg_rcfType.
Definition varying_number_realalg := @varying_number realalg_rcfType.
Definition varying_hold_realalg := @varying_hold realalg_rcfType.
Definition system_varying_number_realalg := @system_varying_number realalg_rcfType.
Definition system_varying_hold_realalg := @system_varying_hold realalg_rcfType.
Definition zero_complete_number_realalg := @zero_complete_number realalg_rcfType.
Definition zero_complete_hold_realalg := @zero_complete_hold realalg_rcfType.
Definition zero_varying_number_realalg := @zero_varying_number realalg_rcfType.
Definition zero_varying_hold_realalg := @zero_varying_hold realalg_rcfType.
Definition claim_sound_realalg := @claim_sound realalg_rcfType.
Definition enclosed_claim_sound_realalg := @enclosed_claim_sound realalg_rcfType.
Definition system_claim_realalg := @system_claim realalg_rcfType.
Definition lifted_sound_realalg := @lifted_sound realalg_rcfType.
Definition system_enclosed_realalg := @system_enclosed realalg_rcfType.
Definition zero_sound_realalg := @zero_sound realalg_rcfType.
Definition zero_enclosed_sound_realalg := @zero_enclosed_sound realalg_rcfType.
Definition critical_absent_realalg := @critical_absent realalg_rcfType.
Definition anchored_critical_absent_realalg := @anchored_critical_absent realalg_rcfType.
Definition zero_critical_absent_realalg := @zero_critical_absent realalg_rcfType.
Definition zero_anchored_critical_absent_realalg := @zero_anchored_critical_absent realalg_rcfType.
Definition radii_absent_realalg := @radii_absent realalg_rcfType.
Definition radii_present_realalg := @radii_present realalg_rcfType.
Definition presence_sound_realalg := @presence_sound realalg_rcfType.
Definition zero_presence_sound_realalg := @zero_presence_sound realalg_rcfType.
Definition point_number_realalg := @point_number realalg_rcfType.
Definition point_hold_realalg := @point_hold realalg_rcfType.
Definition system_point_number_realalg := @system_point_number realalg_rcfType.
Definition system_point_hold_realalg := @system_point_hold realalg_rcfType.
Definition infinity_number_realalg := @infinity_number realalg_rcfType.
Definition infinity_hold_realalg := @infinity_hold realalg_rcfType.
Definition reflected_equivalent_realalg := @reflected_equivalent realalg_rcfType.
Definition both_signs_realalg := @both_signs realalg_rcfType.
Definition linearized_equivalent_realalg := @linearized_equivalent realalg_rcfType.
Definition reflected_quadratic_equivalent_realalg :=
  @reflected_quadratic_equivalent realalg_rcfType.
Definition plain_mcp_sound_realalg := @plain_mcp_sound realalg_rcfType.
Definition equilibrium_sound_realalg := @equilibrium_sound realalg_rcfType.
Definition rates_sound_realalg := @rates_sound realalg_rcfType.
Definition stability_sound_realalg := @stability_sound realalg_rcfType.
