(* Lifted solution claims: a motion of a mechanical system, given with its forces.

   A claim gives a polynomial p with a root t in [a/d, b/d], the support and the biactive variables,
   and for each degree of freedom polynomials v_d and w_d with integer coefficients.  Remainders by
   p (Claim.v) show, at the root t,

       (K + t M) v = w     (K v = w, if the unknown is mu),
       w_d = 0  at free degrees of freedom,      v_d = 0  where nothing moves,

   and for each slip particle

       n'v = 0;   S t'v < 0 and S t'w + mu n'w = 0     in the support,
                  S t'v = 0 and S t'w + mu n'w = 0     if biactive,
                  S t'v = 0 and S t'w + mu n'w < 0     otherwise.

   Theorem [lifted_sound]: if the claim is checked, then for some t in the interval the motion v(t)
   satisfies (9), its forces are w(t), and it has the support and the biactive variables claimed.

   The pencil plays no part in this.

   Page: spec/certificates.md, 5.4.  Rust: crates/check/src/lifted_solution.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Condensation Pencil Claim System.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

(* [motion_claim] has the polynomials v as its components.  Reductions of v_d are those of its
   components; of w_d and of ((K + t M) v - w)_d, one for each degree of freedom; of n'v, S t'v and
   S t'w + mu n'w, one for each slip particle. *)
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
  let stiff := combine_row k (k_row s d) in
  let inertia := if u is Lambda2 _ _ then 0 :: combine_row k (m_row s d) else [::] in
  subtract (add_poly stiff inertia) (w_poly d).

Definition along_poly (e : planar) p (f : nat -> polynomial) :=
  add_poly (scale_poly e.1 (f (first_dof p))) (scale_poly e.2 (f (second_dof p))).

Definition normal_poly p := along_poly (normal p) p v_poly.
Definition rate_poly p := scale_poly (sign_of p) (along_poly (tangent p) p v_poly).

(* S t'w + mu n'w, times the denominator of mu *)
Definition cone_poly p :=
  match u with
  | Mu => add_poly (scale_poly (sign_of p) (along_poly (tangent p) p w_poly))
                   (0 :: along_poly (normal p) p w_poly)
  | Lambda2 m q => add_poly (scale_poly (q * sign_of p) (along_poly (tangent p) p w_poly))
                            (scale_poly m (along_poly (normal p) p w_poly))
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

Definition slip_variables := all (fun i => (nf <= i) && (i < nf + ns))%N.

Definition check_lifted :=
  [&& system_wellformed s u, root_interval k, slip_variables (support k ++ biactive k),
      all balanced (iota 0 (dofs s)), all without_force (free_dofs s),
      all (fun d => (d \in moving_dofs s) || at_rest d) (iota 0 (dofs s)),
      all particle_states (iota 0 ns) &
      has in_support (iota 0 ns) || has dof_moves (free_dofs s)].

End Checker.

Section Sound.

Variables (R : rcfType) (s : system) (u : unknown) (l : lifted).
Hypothesis checked : check_lifted s u l.

Notation k := (motion_claim l).
Notation a := (claim_from k).
Notation b := (claim_to k).
Notation d := (claim_denominator k).
Notation ns := (size (particles s)).
Notation all_dofs := (iota 0 (dofs s)).

(* The motion and its forces. *)
Definition v_at (t : R) i := eval (v_poly l i) t.
Definition w_at (t : R) i := eval (w_poly l i) t.

Lemma lifted_parts :
  [/\ system_wellformed s u, root_interval k & forall i, i \in all_dofs -> balanced s u l i] /\
  [/\ forall i, i \in free_dofs s -> without_force l i,
      forall i, i \in all_dofs -> i \notin moving_dofs s -> at_rest l i,
      forall j, (j < ns)%N -> particle_states s u l j &
      has (in_support s l) (iota 0 ns) || has (dof_moves l) (free_dofs s)].
Proof.
case/and5P: checked => wf interval _ /allP bal /and4P[/allP free /allP rest /allP ps nz].
split; split=> //; last by move=> j lt_j; apply: ps; rewrite mem_iota.
by move=> i Hi /negbTE out; have := rest _ Hi; rewrite /= out.
Qed.

Section AtRoot.

Variable t : R.
Hypotheses (at_ : toR a <= toR d * t) (tb : toR d * t <= toR b).
Hypothesis root_t : eval (modulus k) t = 0.

Lemma zero_at g w : shows_zero k g w -> eval g t = 0.
Proof. exact: (zero_sound root_t). Qed.

Lemma negative_at g w : shows_negative k g w -> eval g t < 0.
Proof. by have [[_ i _] _] := lifted_parts; exact: (negative_sound i at_ tb root_t). Qed.

Lemma positive_at g w : shows_positive k g w -> 0 < eval g t.
Proof. by have [[_ i _] _] := lifted_parts; exact: (positive_sound i at_ tb root_t). Qed.

Lemma eval_subtract p q : eval (subtract p q) t = eval p t - eval q t.
Proof.
by rewrite /subtract eval_add eval_scale -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r.
Qed.

Lemma eval_shift p : eval (0%Z :: p) t = t * eval p t.
Proof. by rewrite /eval /= toR0 add0r. Qed.

Lemma eval_along e p f :
  eval (along_poly e p f) t = along e p (fun i => eval (f i) t).
Proof. by rewrite /along_poly eval_add !eval_scale. Qed.

(* The forces of v(t) are w(t). *)
Lemma balance i : i \in all_dofs -> force s (lambda2_of u t) (v_at t) i = w_at t i.
Proof.
have [[wf _ bal] _] := lifted_parts => /bal/zero_at; have [rk rm] := rows_in_range wf i.
rewrite /balance_poly eval_subtract eval_add => /eqP; rewrite subr_eq0 => /eqP sum.
rewrite forceE -[RHS]sum; congr (_ + _).
  exact/esym/(@combine_rowE R (Pencil (dofs s) [::] [::] [::])).
rewrite /lambda2_of; case: (u) => [|m q]; first by rewrite mul0r.
by rewrite eval_shift; congr (_ * _); exact/esym/(@combine_rowE R (Pencil (dofs s) [::] [::] [::])).
Qed.

Lemma cone_at j : (j < ns)%N -> let p := particle s j in
  eval (cone_poly u l p) t =
  row_factor R u * cone s (lambda2_of u t) (mu_of u t) (v_at t) p.
Proof.
move=> lt_j p; have [[wf _ _] _] := lifted_parts.
have c0 := row_factor_gt0 R wf; rewrite /cone.
have same e : along e p (force s (lambda2_of u t) (v_at t)) = along e p (w_at t).
  by rewrite /along !balance ?(first_dof_in wf) ?(second_dof_in wf).
rewrite !same {same}; rewrite /cone_poly /row_factor /mu_of in c0 *; case: (u) c0 => [|m q] c0.
  by rewrite eval_add eval_scale eval_shift !eval_along mul1r.
rewrite eval_add !eval_scale !eval_along toRM -!/(w_at t _).
rewrite -/(along (tangent p) p (w_at t)) -/(along (normal p) p (w_at t)).
by move: (along _ _ _) (along _ _ _) => *; field; exact: lt0r_neq0.
Qed.

Lemma states_at j : (j < ns)%N -> let p := particle s j in
  along (normal p) p (v_at t) = 0 /\
  [/\ in_support s l j -> slip_rate (v_at t) p < 0,
      ~~ in_support s l j -> slip_rate (v_at t) p = 0,
      in_support s l j || is_biactive s l j ->
        cone s (lambda2_of u t) (mu_of u t) (v_at t) p = 0 &
      ~~ (in_support s l j || is_biactive s l j) ->
        cone s (lambda2_of u t) (mu_of u t) (v_at t) p < 0].
Proof.
move=> lt_j p; have [[wf _ _] [_ _ /(_ _ lt_j) + _]] := lifted_parts; rewrite /particle_states -/p.
have c0 := row_factor_gt0 R wf; have cE := cone_at lt_j; rewrite -/p in cE.
have rateE : eval (rate_poly l p) t = slip_rate (v_at t) p.
  by rewrite /rate_poly eval_scale eval_along.
case/and3P=> /zero_at; rewrite /normal_poly eval_along => nv rate reaction.
split=> //; split=> state; move: rate reaction; rewrite ?state ?(negbTE state).
- by move/negative_at; rewrite rateE.
- by move/zero_at; rewrite rateE.
- move=> _ /zero_at/eqP; rewrite cE mulf_eq0 gt_eqF //= => /eqP.
  by [].
by move=> _ /negative_at; rewrite cE pmulr_rlt0.
Qed.

End AtRoot.

Theorem lifted_sound : exists t : R,
  [/\ toR a <= toR d * t /\ toR d * t <= toR b, satisfies_9 s u t (v_at t),
      forall i, i \in all_dofs -> force s (lambda2_of u t) (v_at t) i = w_at t i &
      has_support s u (support k) (biactive k) t (v_at t)].
Proof.
have [[wf interval bal] [free rest states nz]] := lifted_parts.
have [a0 _ d0 _] := interval_parts R interval.
have [t [at_ tb root_t]] := modulus_root R interval.
have at_particle j (lt_j : (j < ns)%N) := states_at at_ tb root_t lt_j.

exists t; split=> //; first 1 last.
- by move=> i Hi; apply: balance.
- move=> j lt_j p; have [_ [r1 r2 c1 c2]] := at_particle _ lt_j; split=> //.
    by move=> _ biactive_j; apply: c1; rewrite /is_biactive biactive_j orbT.
  by move=> out1 out2; apply: c2; rewrite negb_or; apply/andP.
apply/satisfies_9E; split; first by rewrite -(pmulr_rge0 _ d0); apply: le_trans at_.
split.
- case/orP: nz => /hasP[i Hi]; last first.
    move=> sign_i; exists i; first by apply: (moving_dof_in wf); rewrite mem_cat Hi.
    case/orP: sign_i => [/(positive_at at_ tb root_t)|/(negative_at at_ tb root_t)] sign_i.
      by rewrite gt_eqF.
    by rewrite lt_eqF.
  rewrite mem_iota add0n in Hi => /= in_i; have [_ [r1 _ _ _]] := at_particle _ Hi.
  have := r1 in_i; rewrite /slip_rate /along; set p := particle s i => rate.
  have [v1|] := eqVneq (v_at t (first_dof p)) 0; last first.
    by exists (first_dof p); rewrite ?(first_dof_in wf).
  exists (second_dof p); first exact: (second_dof_in wf).
  by apply: contraTneq rate => v2; rewrite v1 v2 !mulr0 addr0 mulr0 ltxx.
- by move=> i Hi out; apply: (zero_at root_t (rest _ Hi out)).
- move=> i Hi; rewrite balance //; first exact: (zero_at root_t (free _ Hi)).
  by apply: (moving_dof_in wf); rewrite mem_cat Hi.
move=> j lt_j p; have [nv [r1 r2 c1 c2]] := at_particle _ lt_j.
split=> //.
- by case: (boolP (in_support s l j)) => [/r1/ltW|/r2->].
- case: (boolP (in_support s l j || is_biactive s l j)) => [/c1->|/c2/ltW] //.
case: (boolP (in_support s l j)) => [in_j|/r2->]; last by rewrite mulr0.
by rewrite c1 ?in_j // mul0r.
Qed.

End Sound.
