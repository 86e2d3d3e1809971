(* Motions of a mechanical system, given with their forces: the tests of a claim.

   A claim gives a polynomial p with a root t in [a/d, b/d], the support and the biactive variables,
   and for each degree of freedom polynomials v_d and w_d with integer coefficients.  Remainders by
   p (Claim.v) show, at the root t,

       (K + t M) v = w     (K v = w, if the unknown is mu),
       w_d = 0  at free degrees of freedom,      v_d = 0  where nothing moves,

   and for each slip particle

       n'v = 0;   S t'v < 0 and s = 0     in the support,
                  S t'v = 0 and s = 0     if biactive,
                  S t'v = 0 and s < 0     otherwise,

   with s = S t'w + mu n'w + (1 + c^2 mu^2) g S t'v.

   The normal n has the friction factor of the particle as its length (System.v).

   ZeroReaction.v puts these tests together, for systems with particles in contact with zero
   reaction and for those without ([lifted_sound]).

   Page: spec/certificates.md, 5.4.  Rust: crates/check/src/lifted_solution.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Condensation Pencil Claim System.

(* [motion_claim] has the polynomials v as its components.  Reductions of v_d are those of its
   components; of w_d and of ((K + t M) v - w)_d, one for each degree of freedom; of n'v, S t'v and
   s, one for each slip particle. *)
Record lifted := Lifted {
  motion_claim : claim;
  forces : seq polynomial;
  force_reductions : seq reduction;
  balance_reductions : seq reduction;
  normal_reductions : seq reduction;
  rate_reductions : seq reduction;
  cone_reductions : seq reduction }.

Section Checker.

Variables (s : system) (u : unknown) (l : lifted).
Local Open Scope Z_scope.

Notation k := (motion_claim l).
Notation nf := (free_number s).
Notation ns := (size (particles s)).

Definition witness (list : seq reduction) i := nth no_reduction list i.

Definition subtract p q := add_poly p (scale_poly (-1) q).

Definition v_poly d := component k d.
Definition w_poly d := nth [::] (forces l) d.

(* ((K + t M) v - w)_d *)
Definition balance_poly d :=
  let stiff := combine_row (components k) (k_row s d) in
  let inertia := if u is Lambda2 _ _ then 0 :: combine_row (components k) (m_row s d) else [::] in
  subtract (add_poly stiff inertia) (w_poly d).

Definition along_poly (e : planar) p (f : nat -> polynomial) :=
  add_poly (scale_poly e.1 (f (first_dof p))) (scale_poly e.2 (f (second_dof p))).

Definition normal_poly p := along_poly (normal p) p v_poly.
Definition rate_poly p := scale_poly (sign_of p) (along_poly (tangent p) p v_poly).

(* s, times the denominator of mu *)
Definition cone_poly p :=
  let turned := scale_poly (turning s u p) (rate_poly p) in
  match u with
  | Mu => add_poly (scale_poly (sign_of p) (along_poly (tangent p) p w_poly))
                   (0 :: along_poly (normal p) p w_poly)
  | Lambda2 m q =>
      add_poly (add_poly (scale_poly (q * sign_of p) (along_poly (tangent p) p w_poly))
                         (scale_poly m (along_poly (normal p) p w_poly))) turned
  end.

Definition balanced d := shows_zero k (balance_poly d) (witness (balance_reductions l) d).
Definition without_force d := shows_zero k (w_poly d) (witness (force_reductions l) d).
Definition at_rest d := shows_zero k (v_poly d) (component_witness k d).

Definition dof_moves d :=
  shows_positive k (v_poly d) (component_witness k d) ||
  shows_negative k (v_poly d) (component_witness k d).

Definition in_support j := (nf + j)%N \in support k.
Definition is_biactive j := (nf + j)%N \in biactive k.

Definition particle_states j :=
  let p := particle s j in
  let rate := witness (rate_reductions l) j in
  let reaction := witness (cone_reductions l) j in
  [&& shows_zero k (normal_poly p) (witness (normal_reductions l) j),
      if in_support j then shows_negative k (rate_poly p) rate
      else shows_zero k (rate_poly p) rate &
      if in_support j || is_biactive j then shows_zero k (cone_poly p) reaction
      else shows_negative k (cone_poly p) reaction].

End Checker.

Section Sound.

Variables (R : rcfType) (s : system) (u : unknown) (l : lifted).

Notation k := (motion_claim l).
Notation a := (claim_from k).
Notation b := (claim_to k).
Notation d := (claim_denominator k).
Notation ns := (size (particles s)).
Notation all_dofs := (iota 0 (dofs s)).

(* The motion and its forces. *)
Definition v_at (t : R) i := eval (v_poly l i) t.
Definition w_at (t : R) i := eval (w_poly l i) t.

Section AtRoot.

Hypotheses (wf : system_wellformed s u) (interval : root_interval k).
Hypothesis bal : forall i, i \in all_dofs -> balanced s u l i.

Variable t : R.
Hypotheses (at_ : toR a <= toR d * t) (tb : toR d * t <= toR b).
Hypothesis root_t : eval (modulus k) t = 0.

Lemma zero_at g w : shows_zero k g w -> eval g t = 0.
Proof. exact: (zero_sound root_t). Qed.

Lemma negative_at g w : shows_negative k g w -> eval g t < 0.
Proof. exact: (negative_sound interval at_ tb root_t). Qed.

Lemma positive_at g w : shows_positive k g w -> 0 < eval g t.
Proof. exact: (positive_sound interval at_ tb root_t). Qed.

Lemma eval_subtract p q : eval (subtract p q) t = eval p t - eval q t.
Proof.
by rewrite /subtract eval_add eval_scale -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r.
Qed.

Lemma eval_shift p : eval (0%Z :: p) t = t * eval p t.
Proof. by rewrite /eval /= toR0 add0r. Qed.

Lemma eval_along e p f :
  eval (along_poly e p f) t = along e p (fun i => eval (f i) t).
Proof. by rewrite /along_poly eval_add !eval_scale. Qed.

Lemma rateE p : eval (rate_poly l p) t = slip_rate (v_at t) p.
Proof. by rewrite /rate_poly eval_scale eval_along. Qed.

(* The forces of v(t) are w(t). *)
Lemma balance i : i \in all_dofs -> force s (lambda2_of u t) (v_at t) i = w_at t i.
Proof.
move/bal/zero_at; have [rk rm] := rows_in_range wf i.
rewrite /balance_poly eval_subtract eval_add => /eqP; rewrite subr_eq0 => /eqP sum.
rewrite forceE -[RHS]sum; congr (_ + _).
  exact/esym/(combine_rowE _ _ rk).
rewrite /lambda2_of; case: (u) => [|m q]; first by rewrite mul0r.
by rewrite eval_shift; congr (_ * _); exact/esym/(combine_rowE _ _ rm).
Qed.

Lemma along_force e p : first_dof p \in all_dofs -> second_dof p \in all_dofs ->
  along e p (force s (lambda2_of u t) (v_at t)) = along e p (w_at t).
Proof. by move=> first second; rewrite /along !balance. Qed.

Lemma cone_at p : first_dof p \in all_dofs -> second_dof p \in all_dofs ->
  turns_exactly s u p -> eval (cone_poly s u l p) t =
  row_factor R u * cone s (lambda2_of u t) (mu_of u t) (v_at t) p.
Proof.
move=> first second /(turningE (R := R) wf t) turning_t; have c0 := row_factor_gt0 R wf.
rewrite /cone mulrDr mulrA -turning_t !along_force //.
rewrite /cone_poly /row_factor /mu_of in c0 *; case: (u) c0 => [|m q] c0.
  by rewrite eval_add eval_scale eval_shift !eval_along toR0 mul0r addr0 mul1r.
rewrite !eval_add [eval (scale_poly (turning _ _ _) _) _]eval_scale rateE !eval_scale !eval_along.
rewrite toRM -!/(w_at t _).
rewrite -/(along (tangent p) p (w_at t)) -/(along (normal p) p (w_at t)).
by move: (along _ _ _) (along _ _ _) => *; field; exact: lt0r_neq0.
Qed.

(* Signs of the cone line. *)
Lemma cone_signs p w : first_dof p \in all_dofs -> second_dof p \in all_dofs ->
  turns_exactly s u p ->
  (shows_zero k (cone_poly s u l p) w -> cone s (lambda2_of u t) (mu_of u t) (v_at t) p = 0) /\
  (shows_negative k (cone_poly s u l p) w -> cone s (lambda2_of u t) (mu_of u t) (v_at t) p < 0).
Proof.
move=> first second exact; have c0 := row_factor_gt0 R wf.
split=> [/zero_at/eqP|/negative_at]; rewrite cone_at //; last by rewrite pmulr_rlt0.
by rewrite mulf_eq0 gt_eqF //= => /eqP.
Qed.

Lemma states_at j : (j < ns)%N -> particle_states s u l j -> let p := particle s j in
  along (normal p) p (v_at t) = 0 /\
  [/\ in_support s l j -> slip_rate (v_at t) p < 0,
      ~~ in_support s l j -> slip_rate (v_at t) p = 0,
      in_support s l j || is_biactive s l j ->
        cone s (lambda2_of u t) (mu_of u t) (v_at t) p = 0 &
      ~~ (in_support s l j || is_biactive s l j) ->
        cone s (lambda2_of u t) (mu_of u t) (v_at t) p < 0].
Proof.
move=> lt_j + p; rewrite /particle_states -/p.
have [cone_zero cone_negative] :=
  cone_signs (witness (cone_reductions l) j) (first_dof_in wf lt_j) (second_dof_in wf lt_j)
    (particle_turns wf lt_j).
case/and3P=> /zero_at; rewrite /normal_poly eval_along => nv rate reaction.
split=> //; split=> state; move: rate reaction; rewrite ?state ?(negbTE state).
- by move/negative_at; rewrite rateE.
- by move/zero_at; rewrite rateE.
- by move=> _ /cone_zero.
by move=> _ /cone_negative.
Qed.

(* What the states of all slip particles say. *)
Lemma slip_lines : (forall j, (j < ns)%N -> particle_states s u l j) ->
  (forall j, (j < ns)%N -> let p := particle s j in
     [/\ along (normal p) p (v_at t) = 0, slip_rate (v_at t) p <= 0,
         cone s (lambda2_of u t) (mu_of u t) (v_at t) p <= 0 &
         cone s (lambda2_of u t) (mu_of u t) (v_at t) p * slip_rate (v_at t) p = 0]) /\
  has_support s u (support k) (biactive k) t (v_at t).
Proof.
move=> states; split=> j lt_j p; have [nv [r1 r2 c1 c2]] := states_at lt_j (states _ lt_j).
  split=> //.
  - by case: (boolP (in_support s l j)) => [/r1/ltW|/r2->].
  - by case: (boolP (in_support s l j || is_biactive s l j)) => [/c1->|/c2/ltW].
  case: (boolP (in_support s l j)) => [in_j|/r2->]; last by rewrite mulr0.
  by rewrite c1 ?in_j // mul0r.
split=> //.
  by move=> _ biactive_j; apply: c1; rewrite /is_biactive biactive_j orbT.
by move=> out1 out2; apply: c2; rewrite negb_or; apply/andP.
Qed.

(* v != 0 *)
Lemma something_moves moving : (forall j, (j < ns)%N -> particle_states s u l j) ->
  (forall i, i \in moving -> i \in all_dofs) ->
  has (in_support s l) (iota 0 ns) || has (dof_moves l) moving ->
  exists2 i, i \in all_dofs & v_at t i != 0.
Proof.
move=> states in_range; case/orP=> /hasP[i Hi]; last first.
  move=> sign_i; exists i; first exact: in_range.
  case/orP: sign_i => [/positive_at|/negative_at] sign_i; first by rewrite gt_eqF.
  by rewrite lt_eqF.
rewrite mem_iota add0n in Hi => /= in_i; have [_ [r1 _ _ _]] := states_at Hi (states _ Hi).
have := r1 in_i; rewrite /slip_rate /along; set p := particle s i => rate.
have [v1|] := eqVneq (v_at t (first_dof p)) 0; last first.
  by exists (first_dof p); rewrite ?(first_dof_in wf).
exists (second_dof p); first exact: (second_dof_in wf).
by apply: contraTneq rate => v2; rewrite v1 v2 !mulr0 addr0 mulr0 ltxx.
Qed.

End AtRoot.

End Sound.
