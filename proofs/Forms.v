(* Linear forms of a motion, for systems with particles in contact with zero reaction (z).

   A form is a pair of rows a and b and stands for (a + t b)'v, where t is the unknown: the force at
   a degree of freedom, the force at a particle in a direction, S t'w + mu n'w.  The rows of the
   pencil of ZeroPencil.v are forms.

   Page: spec/zero-reaction.md, Z.3. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Condensation Pencil Claim System ZeroReaction.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

(* The rows a and b of the linear form (a + t b)'x. *)
Definition form := (sparse_row * sparse_row)%type.

Section Checker.

Local Open Scope Z_scope.

Variables (z : zero_system) (u : unknown).

Notation s := (without_zero z).

Definition at_both (rows : nat -> sparse_row) p (e : planar) : sparse_row :=
  multiple e.1 (rows (first_dof p)) ++ multiple e.2 (rows (second_dof p)).

(* w_d, and e'w at a particle *)
Definition force_form d : form := (k_row s d, if u is Lambda2 _ _ then m_row s d else [::]).

Definition pressing_form (e : planar) p : form :=
  (at_both (k_row s) p e, if u is Lambda2 _ _ then at_both (m_row s) p e else [::]).

(* S t'w + mu n'w, times the denominator of mu *)
Definition cone_form p : form :=
  match u with
  | Mu => (at_both (k_row s) p (direction (sign_of p) 0 p),
           at_both (k_row s) p (direction 0 1 p))
  | Lambda2 m q => (at_both (k_row s) p (direction (q * sign_of p) m p),
                    at_both (m_row s) p (direction (q * sign_of p) m p))
  end.

Definition negative (f : form) : form := (multiple (-1) f.1, multiple (-1) f.2).

End Checker.

(* The values of the forms. *)
Section Values.

Variables (R : rcfType) (z : zero_system) (u : unknown).
Implicit Types (t : R) (v x : nat -> R).

Notation s := (without_zero z).

Definition row_value (row : sparse_row) x : R := \sum_(e <- row) toR e.2 * x e.1.

Definition form_value (f : form) t x := row_value f.1 x + t * row_value f.2 x.

Lemma row_value_nil x : row_value [::] x = 0.
Proof. exact: big_nil. Qed.

Lemma row_value_cat a b x : row_value (a ++ b) x = row_value a x + row_value b x.
Proof. exact: big_cat. Qed.

Lemma row_value_multiple c row x : row_value (multiple c row) x = toR c * row_value row x.
Proof.
rewrite /multiple; case: Z.eqb_spec => [->|_]; first by rewrite toR0 mul0r row_value_nil.
rewrite /row_value big_map mulr_sumr; apply: eq_bigr => e _ /=.
by rewrite toRM mulrA.
Qed.

Lemma value_negative f t x : form_value (negative f) t x = - form_value f t x.
Proof.
rewrite /form_value /= !row_value_multiple -[(-1)%Z]/(Z.opp 1) toRN toR1 !mulN1r.
by rewrite mulrN opprD.
Qed.

Lemma row_value_both rows p e x : row_value (at_both rows p e) x =
  along e p (fun d => row_value (rows d) x).
Proof. by rewrite row_value_cat !row_value_multiple. Qed.

Hypothesis wf : system_wellformed s u.

Lemma force_rows lambda2 x d : force s lambda2 x d =
  row_value (k_row s d) x + lambda2 * row_value (m_row s d) x.
Proof.
have [k m] := rows_in_range wf d.
by rewrite forceE /k_product /m_product /k_entry /m_entry !sum_lookup.
Qed.

Lemma value_force u' d t x : form_value (force_form z u' d) t x = force s (lambda2_of u' t) x d.
Proof.
rewrite force_rows /form_value /force_form /lambda2_of; case: u' => [|m q] //=.
by rewrite row_value_nil mulr0 mul0r.
Qed.

Lemma value_pressing u' e p t x :
  form_value (pressing_form z u' e p) t x = along e p (force s (lambda2_of u' t) x).
Proof.
rewrite /along !force_rows /form_value /pressing_form /lambda2_of; case: u' => [|m q] /=.
  by rewrite row_value_nil row_value_both /along mulr0 !mul0r !addr0.
rewrite !row_value_both /along.
by move: (toR _) (toR _) (row_value _ _) (row_value _ _) => *; ring.
Qed.

(* q S t'w + m n'w *)
Lemma value_cone_parts m q p t x : form_value (cone_form z (Lambda2 m q) p) t x =
  toR q * (toR (sign_of p) * along (tangent p) p (force s t x)) +
  toR m * along (normal p) p (force s t x).
Proof.
rewrite /along !force_rows /form_value /= !row_value_both /along /direction !toRD !toRM /=.
move: (row_value _ _) (row_value _ _) (row_value _ _) (row_value _ _) => *.
by move: (toR _) (toR _) (toR _) (toR _) (toR _) (toR _) (toR _) => *; ring.
Qed.

Lemma value_cone p t x : form_value (cone_form z u p) t x =
  row_factor R u * cone s (lambda2_of u t) (mu_of u t) x p.
Proof.
have := row_factor_gt0 R wf; rewrite /row_factor /cone /lambda2_of /mu_of.
case: (u) => [|m q] f0; last first.
  have q0 : toR q != 0 :> R by rewrite gt_eqF.
  by rewrite value_cone_parts; move: (along _ _ _) (along _ _ _) => *; field.
rewrite mul1r /along !force_rows /form_value /= !row_value_both /along /direction !toRD !toRM.
rewrite toR0 toR1 /=; move: (row_value _ _) (row_value _ _) (row_value _ _) (row_value _ _) => *.
by move: (toR _) (toR _) (toR _) (toR _) (toR _) => *; ring.
Qed.

End Values.

Section Particles.

Variables (R : rcfType) (z : zero_system) (u : unknown).
Hypothesis wf : zero_wellformed z u.

Implicit Types (t : R) (v x : nat -> R).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).

Lemma wf_system : system_wellformed s u.
Proof. by case/and4P: wf. Qed.

Section Sides.

Variables (t : R) (x : nat -> R) (j : nat).

Notation p := (zero_particle z j).
Notation w := (force s (lambda2_of u t) x).
Notation mu := (mu_of u t : R).
Notation w_N := (along (normal p) p w).
Notation w_T := (along (tangent p) p w).

Lemma value_right : form_value (cone_form z u (with_sign (-1) p)) t x =
  row_factor R u * (- w_T + mu * w_N).
Proof. by rewrite (value_cone wf_system) /cone -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r. Qed.

Lemma value_left : form_value (cone_form z u (with_sign 1 p)) t x =
  row_factor R u * (w_T + mu * w_N).
Proof. by rewrite (value_cone wf_system) /cone toR1 mul1r. Qed.

End Sides.

(* The degrees of freedom of the particles. *)
Lemma slip_dofs j : (j < ns)%N ->
  first_dof (particle s j) \in all_dofs /\ second_dof (particle s j) \in all_dofs.
Proof.
by move=> lt_j; rewrite (first_dof_in wf_system lt_j) (second_dof_in wf_system lt_j).
Qed.

Lemma zero_particle_dofs j : (j < nz)%N ->
  first_dof (zero_particle z j) \in all_dofs /\ second_dof (zero_particle z j) \in all_dofs.
Proof.
have /and4P[_ _ in_range _] := wf => lt_j.
have /(all_nthP (SlipParticle 0 0 (0, 0) (0, 0) 0)%Z)/(_ _ lt_j) := in_range.
by rewrite !mem_iota => /andP[].
Qed.

(* (9) and the support speak of degrees of freedom only. *)
Section Extension.

Variables (v v' : nat -> R).
Hypothesis same : forall d, d \in all_dofs -> v d = v' d.

Lemma force_same lambda2 d : force s lambda2 v d = force s lambda2 v' d.
Proof. by apply: sum_eq => j Hj; rewrite same. Qed.

Lemma along_same e p : first_dof p \in all_dofs -> second_dof p \in all_dofs ->
  along e p v = along e p v'.
Proof. by move=> first second; rewrite /along !same. Qed.

Lemma along_force_same e p lambda2 :
  along e p (force s lambda2 v) = along e p (force s lambda2 v').
Proof. by rewrite /along !force_same. Qed.

Lemma conditions_9z_same lambda2 mu : conditions_9z z lambda2 mu v -> conditions_9z z lambda2 mu v'.
Proof.
case=> [[d d_in vd] at_rest free slip zero]; split.
- by exists d; rewrite -?same.
- by move=> d' d'_in out; rewrite -same // at_rest.
- by move=> d' /free; rewrite force_same.
- move=> j lt_j; have [first second] := slip_dofs lt_j; have := slip _ lt_j.
  by rewrite /= /cone /slip_rate !along_force_same !(along_same _ first second).
move=> j lt_j; have [first second] := zero_particle_dofs lt_j; have := zero _ lt_j.
by rewrite /= !along_force_same !(along_same _ first second).
Qed.

End Extension.

End Particles.
