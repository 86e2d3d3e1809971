(* Enclosed claims about systems with particles in contact with zero reaction (z).

   A claim names a support among the slip particles and the variables gap, right and left of the z
   particles (ZeroReaction.v), and an interval of values.  Of right and left of a particle at most
   one is in the support, and one of them is if the gap is.  So the support says what each particle
   does after the event, that is, which linear equations the motion v with its forces w satisfies:

       free degree of freedom     w_d = 0
       slip particle              n'v = 0, and in the support x + S t'v = 0, else t'v = 0
       z that opens               n'w = 0, t'w = 0
       z that slips               n'v = 0, -t'w + mu n'w = 0 (right) or t'w + mu n'w = 0 (left)
       z that sticks              n'v = 0, t'v = 0
       any other                  v_d = 0

   These are as many equations as there are degrees of freedom.  The claim is one about the pencil
   [support_pencil], to which EnclosedClaim.v is applied.  Its free variables are the components of
   v, with these equations.  Behind them comes the variable x for each slip particle: in the support
   the rate -S t'v, off it 0.  Its row is -(S t'w + mu n'w), which is 0 in the support and positive
   off it.  The other variables are 0 and have rows for the strict inequalities of the z particles:

       opens           -n'v > 0,  t'v > 0 (right) or -t'v > 0 (left)
       slips           t'v > 0 (right) or -t'v > 0 (left),  -n'w > 0,  no force at the other side
       sticks          -n'w > 0,  t'w - mu n'w > 0,  -t'w - mu n'w > 0

   "No force at the other side" is the third of these lines for right, the second for left.  The
   half that is at rest while the gap opens has no such row: there y = 0, because w = 0 at this
   particle ([resting_halves] are the variables for which this is so).  Three variables stand for
   each z particle; where fewer rows are needed, one is repeated.

   Theorem [zero_enclosed_sound]: if the claim is checked, then for some t in the interval there is
   a motion with (9), with this support, and with y = 0 off the support at the resting halves only.
   All motions that satisfy (9) at a value of the interval and have this support have this t and are
   its positive multiples.

   Pages: spec/certificates.md, 5.5; spec/zero-reaction.md, Z.3.
   Rust: crates/check/src/enclosed_solution.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Root RootLeaf Condensation Pencil Claim.
From Mceip Require Import EnclosedClaim System ZeroReaction.

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

Variables (z : zero_system) (u : unknown) (support : seq nat).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).

(* e'v at a particle *)
Definition rate_form (e : planar) p : form := ([:: (first_dof p, e.1); (second_dof p, e.2)], [::]).

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

(* S t'v *)
Definition sliding_form p := rate_form (direction (sign_of p) 0 p) p.

(* The slip particle is in the support. *)
Definition slides j := (free_number s + j)%N \in support.

(* x + S t'v; the variable of the slip particle j is behind the degrees of freedom. *)
Definition sliding_line j : form :=
  (((dofs s + j)%N, 1) :: (sliding_form (particle s j)).1, [::]).

Definition slip_equations j :=
  let p := particle s j in
  [:: rate_form (normal p) p; if slides j then sliding_line j else sliding_form p].

Definition zero_equations j :=
  let p := zero_particle z j in
  if gap z j \in support then [:: pressing_form (normal p) p; pressing_form (tangent p) p]
  else [:: rate_form (normal p) p;
           if right z j \in support then cone_form (with_sign (-1) p)
           else if left z j \in support then cone_form (with_sign 1 p)
           else rate_form (tangent p) p].

Definition all_equations :=
  [seq force_form d | d <- free_dofs s] ++
  flatten [seq slip_equations j | j <- iota 0 ns] ++
  flatten [seq zero_equations j | j <- iota 0 nz] ++
  [seq ([:: (d, 1)], [::]) | d <- iota 0 (dofs s) & d \notin moving_with_zero z].

(* The row of the slip particle j. *)
Definition slip_line j : form := negative (cone_form (particle s j)).

(* What is positive at a z particle. *)
Definition zero_inequalities j :=
  let p := zero_particle z j in
  let opening := negative (rate_form (normal p) p) in
  let opens := gap z j \in support in
  [:: if opens then opening else negative (pressing_form (normal p) p);
      if right z j \in support then rate_form (tangent p) p
      else if opens then opening else negative (cone_form (with_sign (-1) p));
      if left z j \in support then negative (rate_form (tangent p) p)
      else if opens then opening else negative (cone_form (with_sign 1 p))].

Definition all_inequalities := flatten [seq zero_inequalities j | j <- iota 0 nz].

Definition all_forms :=
  all_equations ++ [seq slip_line j | j <- iota 0 ns] ++ all_inequalities.

Definition pencil_of_forms (forms : seq form) :=
  Pencil (size forms) [seq f.1 | f <- forms] [seq f.2 | f <- forms] (iota 0 (dofs s)).

Definition support_pencil := pencil_of_forms all_forms.

(* The support among the variables of this pencil. *)
Definition slipping_variables := [seq (dofs s + j)%N | j <- iota 0 ns & slides j].

(* Right and left do not both move, and one of them does if the gap opens. *)
Definition one_half j :=
  ~~ ((right z j \in support) && (left z j \in support)) &&
  ((gap z j \in support) ==> (right z j \in support) || (left z j \in support)).

(* The half at rest of each z particle that opens. *)
Definition resting_halves :=
  [seq left z j | j <- iota 0 nz & (gap z j \in support) && (right z j \in support)] ++
  [seq right z j | j <- iota 0 nz & (gap z j \in support) && (left z j \in support)].

Definition check_zero_enclosed (c : enclosed_claim) :=
  [&& zero_wellformed z u, zero_variables z support, all one_half (iota 0 nz),
      size all_equations == dofs s, box_support c == slipping_variables &
      check_enclosed_claim support_pencil c].

End Checker.

Section Statements.

Variables (R : rcfType) (z : zero_system) (u : unknown).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).

(* What moves is the support. *)
Definition moves_on (support : seq nat) (v : nat -> R) :=
  (forall j, (j < ns)%N -> let p := particle s j in
     if (free_number s + j)%N \notin support then slip_rate v p = 0 else slip_rate v p < 0) /\
  (forall j, (j < nz)%N ->
     let p := zero_particle z j in
     let v_N := along (normal p) p v in
     let v_T := along (tangent p) p v in
     (if gap z j \notin support then v_N = 0 else v_N < 0) /\
     (if (right z j \notin support) && (left z j \notin support) then v_T = 0
      else if right z j \in support then 0 < v_T else v_T < 0)).

End Statements.

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

Lemma value_rate e p t x : form_value (rate_form e p) t x = along e p x.
Proof.
by rewrite /form_value /row_value /along !big_cons !big_nil /= mulr0 !addr0.
Qed.

Lemma value_sliding p t x : form_value (sliding_form p) t x = slip_rate x p.
Proof.
rewrite value_rate /slip_rate /along /direction !toRD !toRM toR0 /=.
by move: (toR _) (toR _) (toR _) (x _) (x _) => *; ring.
Qed.

Lemma value_sliding_line j t x : form_value (sliding_line z j) t x =
  x (dofs s + j)%N + slip_rate x (particle s j).
Proof.
rewrite -(value_sliding _ t) /form_value /row_value !big_cons !big_nil /= !mulr0 !addr0.
by rewrite toR1 mul1r addrA.
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

(* The lists of variables. *)
Section Indices.

Variables (z : zero_system) (u : unknown) (support : seq nat).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation rest := (resting_halves z support).

Lemma gap_not_resting j : (gap z j \in rest) = false.
Proof.
apply/negbTE; rewrite mem_cat negb_or; apply/andP.
by split; apply/negP => /mapP[i _]; rewrite /left /right /gap; lia.
Qed.

Lemma slip_not_resting j : (j < ns)%N -> ((free_number s + j)%N \in rest) = false.
Proof.
move=> lt_j; apply/negbTE; rewrite mem_cat negb_or; apply/andP.
by split; apply/negP => /mapP[i _]; rewrite /left /right /gap; lia.
Qed.

Lemma left_resting j : (j < nz)%N ->
  (left z j \in rest) = (gap z j \in support) && (right z j \in support).
Proof.
move=> lt_j; rewrite mem_cat; apply/orP/idP => [[]/mapP[i]|opens].
- rewrite mem_filter => /andP[opens _] eq.
  by have -> : j = i by move: eq; rewrite /left /right /gap; lia.
- by move=> _; rewrite /left /right /gap; lia.
by left; apply/mapP; exists j => //; rewrite mem_filter opens mem_iota.
Qed.

Lemma right_resting j : (j < nz)%N ->
  (right z j \in rest) = (gap z j \in support) && (left z j \in support).
Proof.
move=> lt_j; rewrite mem_cat; apply/orP/idP => [[]/mapP[i]|opens].
- by move=> _; rewrite /left /right /gap; lia.
- rewrite mem_filter => /andP[opens _] eq.
  by have -> : j = i by move: eq; rewrite /left /right /gap; lia.
by right; apply/mapP; exists j => //; rewrite mem_filter opens mem_iota.
Qed.

Notation equations := (all_equations z u support).

Lemma free_equation d : d \in free_dofs s -> force_form z u d \in equations.
Proof. by move=> d_in; rewrite mem_cat map_f. Qed.

Lemma slip_equation j f : (j < ns)%N -> f \in slip_equations z support j -> f \in equations.
Proof.
move=> lt_j f_in; rewrite !mem_cat; apply/or4P/Or42; apply/flatten_mapP.
by exists j; rewrite ?mem_iota.
Qed.

Lemma zero_equation j f : (j < nz)%N -> f \in zero_equations z u support j -> f \in equations.
Proof.
move=> lt_j f_in; rewrite !mem_cat; apply/or4P/Or43; apply/flatten_mapP.
by exists j; rewrite ?mem_iota.
Qed.

Lemma rest_equation d : d \in iota 0 (dofs s) -> d \notin moving_with_zero z ->
  ([:: (d, 1%Z)], [::]) \in equations.
Proof.
move=> d_in out; rewrite !mem_cat; apply/or4P/Or44/mapP.
by exists d; rewrite // mem_filter out.
Qed.

(* Each equation is one of these. *)
Lemma equation_cases f (P : form -> Prop) :
  (forall d, d \in free_dofs s -> P (force_form z u d)) ->
  (forall j g, (j < ns)%N -> g \in slip_equations z support j -> P g) ->
  (forall j g, (j < nz)%N -> g \in zero_equations z u support j -> P g) ->
  (forall d, d \in iota 0 (dofs s) -> d \notin moving_with_zero z -> P ([:: (d, 1%Z)], [::])) ->
  f \in equations -> P f.
Proof.
move=> free slip zero rest; rewrite !mem_cat => /or4P[]; last 1 first.
- by case/mapP=> d; rewrite mem_filter => /andP[out d_in] ->; apply: rest.
- by case/mapP=> d d_in ->; apply: free.
- by case/flatten_mapP=> j; rewrite mem_iota => lt_j; apply: slip.
by case/flatten_mapP=> j; rewrite mem_iota => lt_j; apply: zero.
Qed.

Lemma zero_inequality j f : (j < nz)%N -> f \in zero_inequalities z u support j ->
  f \in all_inequalities z u support.
Proof. by move=> lt_j f_in; apply/flatten_mapP; exists j; rewrite ?mem_iota. Qed.

End Indices.

Lemma of_two (a b : form) (P : form -> Prop) :
  (forall f, f \in [:: a; b] -> P f) -> P a /\ P b.
Proof. by move=> all; split; apply: all; rewrite !inE eqxx ?orbT. Qed.

Lemma of_three (a b c : form) (P : form -> Prop) :
  (forall f, f \in [:: a; b; c] -> P f) -> [/\ P a, P b & P c].
Proof. by move=> all; split; apply: all; rewrite !inE eqxx ?orbT. Qed.

Lemma in_two (a b : form) (P : form -> Prop) :
  P a -> P b -> forall f, f \in [:: a; b] -> P f.
Proof. by move=> Pa Pb f; rewrite !inE => /orP[]/eqP->. Qed.

Lemma in_three (a b c : form) (P : form -> Prop) :
  P a -> P b -> P c -> forall f, f \in [:: a; b; c] -> P f.
Proof. by move=> Pa Pb Pc f; rewrite !inE => /or3P[]/eqP->. Qed.

(* From the values of the forms to (9) with this support, and back. *)
Section Modes.

Variables (R : rcfType) (z : zero_system) (u : unknown) (support : seq nat).
Hypothesis wf : zero_wellformed z u.
Hypothesis halves : all (one_half z support) (iota 0 (size (zero_particles z))).

Implicit Types (t : R) (v x : nat -> R).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).
Notation rest := (resting_halves z support).

Lemma wf_system : system_wellformed s u.
Proof. by case/and4P: wf. Qed.

(* What the equations and inequalities say of a z particle. *)
Section Signs.

Variables (t : R) (x : nat -> R) (j : nat).
Hypothesis lt_j : (j < nz)%N.

Notation p := (zero_particle z j).
Notation w := (force s (lambda2_of u t) x).
Notation mu := (mu_of u t : R).
Notation v_N := (along (normal p) p x).
Notation v_T := (along (tangent p) p x).
Notation w_N := (along (normal p) p w).
Notation w_T := (along (tangent p) p w).

Lemma value_right : form_value (cone_form z u (with_sign (-1) p)) t x =
  row_factor R u * (- w_T + mu * w_N).
Proof. by rewrite (value_cone wf_system) /cone -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r. Qed.

Lemma value_left : form_value (cone_form z u (with_sign 1 p)) t x =
  row_factor R u * (w_T + mu * w_N).
Proof. by rewrite (value_cone wf_system) /cone toR1 mul1r. Qed.

Definition zero_signs :=
  [/\ if gap z j \notin support then v_N = 0 else v_N < 0,
      row_sign (gap z j) support rest w_N,
      if right z j \in support then left z j \notin support /\ 0 < v_T
      else if left z j \notin support then v_T = 0 else v_T < 0,
      row_sign (right z j) support rest (- w_T + mu * w_N) &
      row_sign (left z j) support rest (w_T + mu * w_N)].

Lemma signs_of_forms :
  (forall f, f \in zero_equations z u support j -> form_value f t x = 0) ->
  (forall f, f \in zero_inequalities z u support j -> 0 < form_value f t x) ->
  zero_signs.
Proof.
have f0 := row_factor_gt0 R wf_system.
have /andP[] : one_half z support j by apply: (allP halves); rewrite mem_iota.
rewrite /zero_equations /zero_inequalities /zero_signs /row_sign.
rewrite gap_not_resting right_resting // left_resting // orbF.
case: (gap z j \in support); case: (right z j \in support); case: (left z j \in support) => //=;
  move=> _ _ /(of_two (P := fun f => form_value f t x = 0))[] + +
    /(of_three (P := fun f => 0 < form_value f t x))[];
  rewrite ?value_negative ?value_right ?value_left ?value_rate ?(value_pressing wf_system);
  rewrite ?oppr_gt0 ?(pmulr_rlt0 _ f0).
- move=> -> -> vN vT _; rewrite mulr0 oppr0 addr0; split=> //.
- move=> -> -> vN _ vT; rewrite mulr0 oppr0 addr0; split=> //.
- move=> vN /eqP; rewrite mulf_eq0 gt_eqF //= => /eqP->.
  by split.
- move=> vN /eqP; rewrite mulf_eq0 gt_eqF //= => /eqP->.
  by split.
by move=> vN vT wN row_right row_left; split.
Qed.

Lemma forms_of_modes :
  zero_reaction mu v_N v_T w_N w_T ->
  (if gap z j \notin support then v_N = 0 else v_N < 0) ->
  (if (right z j \notin support) && (left z j \notin support) then v_T = 0
   else if right z j \in support then 0 < v_T else v_T < 0) ->
  (forall f, f \in zero_equations z u support j -> form_value f t x = 0) /\
  (forall f, f \in zero_inequalities z u support j -> 0 <= form_value f t x).
Proof.
have f0 := row_factor_gt0 R wf_system.
have /andP[] : one_half z support j by apply: (allP halves); rewrite mem_iota.
rewrite /zero_equations /zero_inequalities /zero_reaction cone_sides.
move=> both some [vN wN vw /andP[left_le right_le] slip].

have no_force : v_N < 0 -> w_N = 0 /\ w_T = 0.
  move=> vN_neg; have wN0 : w_N = 0.
    by move/eqP: vw; rewrite mulf_eq0 lt_eqF //= => /eqP.
  move: left_le right_le; rewrite wN0 mulr0 !addr0 oppr_le0 => a b.
  by split=> //; apply/eqP; rewrite eq_le a b.
have on_right : 0 < v_T -> - w_T + mu * w_N = 0.
  move=> vT; apply/eqP; rewrite addrC subr_eq0; apply/eqP/(mulfI (lt0r_neq0 vT)).
  by move: slip; rewrite gtr0_norm // => ->; rewrite mulrCA mulrA.
have on_left : v_T < 0 -> w_T + mu * w_N = 0.
  move=> vT; apply/eqP; rewrite addr_eq0; apply/eqP/(mulfI (ltr0_neq0 vT)).
  by move: slip; rewrite ltr0_norm // mulrN [v_T * (_ * _)]mulrCA mulrA => <-; rewrite mulNr opprK.

move: both some; case: (gap z j \in support); case: (right z j \in support);
  case: (left z j \in support) => //= _ _ vN_sign vT_sign;
  (split; [apply: in_two | apply: in_three]);
  rewrite ?value_negative ?value_right ?value_left ?value_rate ?(value_pressing wf_system);
  rewrite ?oppr_ge0 ?(pmulr_rle0 _ f0) //; try by [case: (no_force vN_sign) | apply: ltW].
- by rewrite on_right ?mulr0.
- by rewrite on_left ?mulr0.
Qed.

End Signs.

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

Lemma satisfies_9z_same t : satisfies_9z z u t v -> satisfies_9z z u t v'.
Proof. by case=> t0 /conditions_9z_same. Qed.

Lemma moves_on_same : moves_on z support v -> moves_on z support v'.
Proof.
case=> slip zero; split=> j lt_j.
  have [first second] := slip_dofs lt_j; have := slip _ lt_j.
  by rewrite /= /slip_rate !(along_same _ first second).
have [first second] := zero_particle_dofs lt_j; have := zero _ lt_j.
by rewrite /= !(along_same _ first second).
Qed.

End Extension.

(* A motion with (9) and this support satisfies the equations and, weakly, the inequalities. *)
Section Back.

Variables (t : R) (v : nat -> R).
Hypothesis sat : satisfies_9z z u t v.
Hypothesis on_support : moves_on z support v.
Hypothesis rates : forall j, (j < ns)%N -> slides z support j ->
  v (dofs s + j)%N = - slip_rate v (particle s j).

Lemma rate_of_slip j : (j < ns)%N -> slides z support j ->
  slip_rate v (particle s j) < 0.
Proof.
move=> lt_j in_support; have := on_support.1 _ lt_j.
by rewrite /= -[_ \in _]/(slides _ _ _) in_support.
Qed.

Lemma rate_of_rest j : (j < ns)%N -> ~~ slides z support j ->
  slip_rate v (particle s j) = 0.
Proof. by move=> lt_j out; have := on_support.1 _ lt_j; rewrite /= out. Qed.

Lemma cone_of_slip j : (j < ns)%N -> slides z support j ->
  cone s (lambda2_of u t) (mu_of u t) v (particle s j) = 0.
Proof.
move=> lt_j in_support; have [_ [_ _ _ slip _]] := sat; have [_ _ _ /eqP] := slip _ lt_j.
by rewrite mulf_eq0 [slip_rate _ _ == 0]lt_eqF ?rate_of_slip // orbF => /eqP.
Qed.

Lemma equations_hold f : f \in all_equations z u support -> form_value f t v = 0.
Proof.
have [_ [_ at_rest free slip zero]] := sat => f_in.
apply: (equation_cases (P := fun f => form_value f t v = 0)) f_in => [d|j g|j g|d] in_list.
- by rewrite (value_force wf_system) free.
- have [normal_zero _ _ _] := slip _ in_list.
  move: g; apply: in_two; first by rewrite value_rate.
  case: ifPn => [/(rates in_list)|/(rate_of_rest in_list)]; last by rewrite value_sliding.
  by rewrite value_sliding_line => ->; rewrite addNr.
- have [opening sliding] := on_support.2 _ in_list.
  by have [] := forms_of_modes in_list (zero _ in_list) opening sliding => holds _; apply: holds.
move=> out; rewrite /form_value row_value_nil mulr0 addr0 /row_value big_cons big_nil /=.
by rewrite at_rest // mulr0 addr0.
Qed.

Lemma inequalities_hold f : f \in all_inequalities z u support -> 0 <= form_value f t v.
Proof.
case/flatten_mapP=> j; rewrite mem_iota => lt_j; have [_ [_ _ _ _ zero]] := sat.
have [opening sliding] := on_support.2 _ lt_j.
by have [] := forms_of_modes lt_j (zero _ lt_j) opening sliding => _ holds; apply: holds.
Qed.

End Back.

End Modes.

(* A vector with these values of the forms is a motion with (9) and this support. *)
Section Forth.

Variables (R : rcfType) (z : zero_system) (u : unknown) (support : seq nat).
Hypothesis wf : zero_wellformed z u.
Hypothesis halves : all (one_half z support) (iota 0 (size (zero_particles z))).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).
Notation rest := (resting_halves z support).

Variables (t : R) (x : nat -> R).
Hypothesis t0 : 0 <= t.
Hypothesis equations : forall f, f \in all_equations z u support -> form_value f t x = 0.
Hypothesis inequalities : forall f, f \in all_inequalities z u support -> 0 < form_value f t x.
Hypothesis slipping : forall j, (j < ns)%N -> slides z support j ->
  slip_rate x (particle s j) < 0.
Hypothesis resting : forall j, (j < ns)%N -> ~~ slides z support j ->
  cone s (lambda2_of u t) (mu_of u t) x (particle s j) < 0.
Hypothesis on_the_cone : forall j, (j < ns)%N -> slides z support j ->
  cone s (lambda2_of u t) (mu_of u t) x (particle s j) = 0.
Hypothesis some_slip : exists2 j, (j < ns)%N & slides z support j.

Let wf_s : system_wellformed s u := wf_system wf.

Lemma normal_at_rest j : (j < ns)%N ->
  along (normal (particle s j)) (particle s j) x = 0.
Proof.
move=> lt_j; rewrite -(value_rate _ _ t); apply: equations; apply: slip_equation lt_j _.
by rewrite inE eqxx.
Qed.

Lemma second_equation j : (j < ns)%N ->
  if slides z support j then cone s (lambda2_of u t) (mu_of u t) x (particle s j) = 0
  else slip_rate x (particle s j) = 0.
Proof.
move=> lt_j; have := equations (slip_equation u (support := support) lt_j (mem_last _ _)).
rewrite /=; case: ifP => [in_support _|_]; last by rewrite value_sliding.
exact: on_the_cone.
Qed.

Lemma found_support : has_support s u support rest t x.
Proof.
move=> j lt_j p; have := second_equation lt_j; rewrite /slides -/p slip_not_resting //.
have slip := slipping lt_j; have rest_ := resting lt_j.
move: slip rest_; rewrite /slides -/p; case: (_ \in support) => slip cone_neg eq; split=> //.
Qed.

Lemma found_zero_support : has_zero_support z u support rest t x.
Proof.
move=> j lt_j; apply: (signs_of_forms wf halves lt_j) => f f_in.
  exact: equations (zero_equation lt_j f_in).
exact: inequalities (zero_inequality lt_j f_in).
Qed.

Lemma found_motion : satisfies_9z z u t x.
Proof.
split=> //; split.
- have [j lt_j in_support] := some_slip; have [first second] := slip_dofs wf lt_j.
  have := slipping lt_j in_support; rewrite /slip_rate /along => rate.
  have [first0|first_nz] := eqVneq (x (first_dof (particle s j))) 0; last first.
    by exists (first_dof (particle s j)).
  have [second0|second_nz] := eqVneq (x (second_dof (particle s j))) 0; last first.
    by exists (second_dof (particle s j)).
  by move: rate; rewrite first0 second0 !mulr0 addr0 mulr0 ltxx.
- move=> d d_in out; have := equations (rest_equation u support d_in out).
  by rewrite /form_value row_value_nil mulr0 addr0 /row_value big_cons big_nil /= mul1r addr0.
- by move=> d d_in; rewrite -(value_force wf_s); apply/equations/free_equation.
- move=> j lt_j p; have normal0 := normal_at_rest lt_j; have := second_equation lt_j.
  have slip := slipping lt_j; have rest_ := resting lt_j.
  move: slip rest_; rewrite -/p; case: (slides _ _ _) => [slip _ ->|_ cone_neg ->].
    by split=> //; [apply/ltW/slip | rewrite mul0r].
  by split=> //; [apply/ltW/cone_neg | rewrite mulr0].
exact: (zero_lines found_zero_support).
Qed.

End Forth.

(* From the pencil to the forms. *)
Section Sound.

Variables (R : rcfType) (z : zero_system) (u : unknown) (support : seq nat) (c : enclosed_claim).
Hypothesis checked : check_zero_enclosed z u support c.

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).
Notation rest := (resting_halves z support).
Notation Q := (support_pencil z u support).
Notation forms := (all_forms z u support).
Notation no_form := ([::], [::]).

Lemma zero_enclosed_parts :
  [/\ zero_wellformed z u, all (one_half z support) (iota 0 nz),
      size (all_equations z u support) = dofs s, box_support c = slipping_variables z support &
      check_enclosed_claim Q c].
Proof. by case/and5P: checked => ? _ ? /eqP ? /andP[/eqP ? ?]. Qed.

Let wf : zero_wellformed z u.
Proof. by case: zero_enclosed_parts. Qed.

Let wf_s : system_wellformed s u := wf_system wf.

Lemma size_forms : order Q = (dofs s + ns + size (all_inequalities z u support))%N.
Proof.
have [_ _ eq _ _] := zero_enclosed_parts.
by rewrite -[LHS]/(size forms) size_cat eq size_cat size_map size_iota addnA.
Qed.

Lemma slip_of_forms i : (i \in slip Q) = (dofs s <= i)%N && (i < order Q)%N.
Proof. by rewrite mem_filter !mem_iota /= !add0n -leqNgt. Qed.

Lemma reaction_form (t : R) x i : reaction Q t x i = form_value (nth no_form forms i) t x.
Proof.
have [_ _ _ _ claim] := zero_enclosed_parts.
have [range_a range_b] := EnclosedClaim.columns R claim i.
transitivity (\sum_(j <- iota 0 (order Q)) toR (lookup (row_a Q i) j) * x j +
              t * \sum_(j <- iota 0 (order Q)) toR (lookup (row_b Q i) j) * x j).
  rewrite /reaction mulr_sumr -big_split /=; apply: eq_bigr => j _.
  by rewrite /a_entry /b_entry mulrDl mulrA.
rewrite !sum_lookup // /form_value /row_value /row_a /row_b /=.
have [lt_i|ge_i] := ltnP i (size forms); first by rewrite !(nth_map no_form).
by rewrite !nth_default ?size_map.
Qed.

Lemma equation_index f : f \in all_equations z u support ->
  exists2 i, i \in free Q & nth no_form forms i = f.
Proof.
have [_ _ eq _ _] := zero_enclosed_parts => /(nthP no_form)[i lt_i <-].
exists i; first by rewrite mem_iota -eq.
by rewrite nth_cat lt_i.
Qed.

Lemma form_of_equation i : i \in free Q -> nth no_form forms i \in all_equations z u support.
Proof.
have [_ _ eq _ _] := zero_enclosed_parts; rewrite mem_iota add0n /= -eq => lt_i.
by rewrite nth_cat lt_i mem_nth.
Qed.

Lemma form_of_slip j : (j < ns)%N -> nth no_form forms (dofs s + j) = slip_line z u j.
Proof.
have [_ _ eq _ _] := zero_enclosed_parts => lt_j.
rewrite nth_cat eq ltnNge leq_addr /= addKn nth_cat size_map size_iota lt_j.
by rewrite (nth_map 0%N) ?size_iota // nth_iota.
Qed.

Lemma nth_inequality i : (dofs s + ns <= i)%N ->
  nth no_form forms i = nth no_form (all_inequalities z u support) (i - (dofs s + ns)).
Proof.
have [_ _ eq _ _] := zero_enclosed_parts => ge_i.
rewrite nth_cat eq ltnNge (leq_trans (leq_addr _ _) ge_i) /= nth_cat size_map size_iota.
by rewrite ltnNge leq_subRL ?(leq_trans (leq_addr _ _) ge_i) // ge_i /= subnDA.
Qed.

Lemma inequality_index f : f \in all_inequalities z u support ->
  exists i, [/\ i \in slip Q, (dofs s + ns <= i)%N & nth no_form forms i = f].
Proof.
case/(nthP no_form)=> i lt_i <-; exists (dofs s + ns + i)%N; split; last 1 first.
- by rewrite nth_inequality ?leq_addr // addKn.
- by rewrite slip_of_forms size_forms ltn_add2l lt_i -addnA leq_addr.
exact: leq_addr.
Qed.

Lemma form_of_inequality i : i \in slip Q -> (dofs s + ns <= i)%N ->
  nth no_form forms i \in all_inequalities z u support.
Proof.
rewrite slip_of_forms size_forms => /andP[_ lt_i] ge_i.
by rewrite nth_inequality // mem_nth // ltn_subLR.
Qed.

Lemma slip_in_pencil j : (j < ns)%N -> (dofs s + j)%N \in slip Q.
Proof.
by move=> lt_j; rewrite slip_of_forms size_forms leq_addr -addnA ltn_add2l ltn_addr.
Qed.

Lemma slip_in_support j : (j < ns)%N ->
  ((dofs s + j)%N \in slipping_variables z support) = slides z support j.
Proof.
move=> lt_j; rewrite mem_map; last exact: addnI.
by rewrite mem_filter mem_iota add0n /= lt_j andbT.
Qed.

Lemma rest_out_of_support i : (dofs s + ns <= i)%N -> i \notin slipping_variables z support.
Proof.
move=> ge_i; apply/negP => /mapP[j]; rewrite mem_filter mem_iota add0n /= => /andP[_ lt_j] eq.
by move: ge_i; rewrite eq leq_add2l leqNgt lt_j.
Qed.

Lemma value_slip_line j (t : R) x : form_value (slip_line z u j) t x =
  - (row_factor R u * cone s (lambda2_of u t) (mu_of u t) x (particle s j)).
Proof. by rewrite /slip_line value_negative (value_cone wf_s). Qed.

Lemma zero_pencil_solution : exists (t : R) x,
  [/\ between t (box_from c) (box_to c), satisfies_9z z u t x,
      has_support s u support rest t x, has_zero_support z u support rest t x &
      forall t' x', solution Q t' x' -> between t' (box_from c) (box_to c) ->
        (forall i, i \in slip Q -> i \in box_support c -> 0 < x' i) ->
        (forall i, i \in slip Q -> i \notin box_support c -> x' i = 0) ->
        t' = t /\ exists2 f, 0 < f & forall i, i \in iota 0 (order Q) -> x' i = f * x i].
Proof.
have [_ halves _ support_eq claim] := zero_enclosed_parts.
have f0 := row_factor_gt0 R wf_s.
have [t [x [bt [t0 _ rows_f rows_s] pos off uniq]]] := enclosed_claim_sound R claim.
rewrite support_eq in pos off.

have equations f : f \in all_equations z u support -> form_value f t x = 0.
  by case/equation_index=> i i_free <-; rewrite -reaction_form; apply: rows_f.
have inequalities f : f \in all_inequalities z u support -> 0 < form_value f t x.
  case/inequality_index=> i [i_slip ge_i <-]; rewrite -reaction_form.
  by case: (off _ i_slip (rest_out_of_support ge_i)).
have slipping j : (j < ns)%N -> slides z support j -> slip_rate x (particle s j) < 0.
  move=> lt_j in_support; have i_slip := slip_in_pencil lt_j.
  have x0 : 0 < x (dofs s + j)%N by apply: pos => //; rewrite slip_in_support.
  have := equations _ (slip_equation u (support := support) lt_j (mem_last _ _)).
  rewrite /= in_support value_sliding_line addrC => /eqP; rewrite addr_eq0 => /eqP->.
  by rewrite oppr_lt0.
have on_the_cone j : (j < ns)%N -> slides z support j ->
    cone s (lambda2_of u t) (mu_of u t) x (particle s j) = 0.
  move=> lt_j in_support; have i_slip := slip_in_pencil lt_j.
  have x0 : 0 < x (dofs s + j)%N by apply: pos => //; rewrite slip_in_support.
  have [_ _ /eqP] := rows_s _ i_slip; rewrite mulf_eq0 gt_eqF //= reaction_form.
  by rewrite form_of_slip // value_slip_line oppr_eq0 mulf_eq0 gt_eqF //= => /eqP.
have resting j : (j < ns)%N -> ~~ slides z support j ->
    cone s (lambda2_of u t) (mu_of u t) x (particle s j) < 0.
  move=> lt_j out; have [|_] := off _ (slip_in_pencil lt_j); first by rewrite slip_in_support.
  by rewrite reaction_form form_of_slip // value_slip_line oppr_gt0 pmulr_rlt0.
have some_slip : exists2 j, (j < ns)%N & slides z support j.
  have [_ [[pivot_in _ _ _] _]] := enclosed_parts R claim.
  move: pivot_in; rewrite support_eq => /mapP[j]; rewrite mem_filter mem_iota.
  by rewrite add0n /= => /andP[in_s lt_j] _; exists j.

exists t, x; split=> //.
- exact: (found_motion wf halves t0 equations inequalities slipping resting on_the_cone some_slip).
- exact: (found_support equations slipping resting on_the_cone).
exact: (found_zero_support wf halves equations inequalities).
Qed.

(* The vector of the pencil that belongs to a motion. *)
Definition with_rates (v : nat -> R) i :=
  let j := (i - dofs s)%N in
  if (i < dofs s)%N then v i
  else if (j < ns)%N && slides z support j then - slip_rate v (particle s j) else 0.

Lemma with_rates_same v d : d \in all_dofs -> v d = with_rates v d.
Proof. by rewrite mem_iota add0n /= /with_rates => ->. Qed.

Lemma with_rates_slip v j : (j < ns)%N ->
  with_rates v (dofs s + j)%N =
  if slides z support j then - slip_rate v (particle s j) else 0.
Proof. by move=> lt_j; rewrite /with_rates ltnNge leq_addr /= addKn lt_j. Qed.

Lemma with_rates_beyond v i : (dofs s + ns <= i)%N -> with_rates v i = 0.
Proof.
move=> ge_i; have ge_d := leq_trans (leq_addr _ _) ge_i.
by rewrite /with_rates ltnNge ge_d /= ltnNge leq_subRL // ge_i.
Qed.

Lemma slip_cases i : i \in slip Q ->
  (exists2 j, (j < ns)%N & i = (dofs s + j)%N) \/ (dofs s + ns <= i)%N.
Proof.
rewrite slip_of_forms => /andP[ge_d _]; have [lt_i|] := ltnP i (dofs s + ns); last by right.
by left; exists (i - dofs s)%N; rewrite ?subnKC // ltn_subLR.
Qed.

Lemma with_rates_solution (t : R) v : satisfies_9z z u t v -> moves_on z support v ->
  [/\ solution Q t (with_rates v),
      forall i, i \in slip Q -> i \in box_support c -> 0 < with_rates v i &
      forall i, i \in slip Q -> i \notin box_support c -> with_rates v i = 0].
Proof.
have [_ halves _ support_eq claim] := zero_enclosed_parts; rewrite support_eq.
have f0 := row_factor_gt0 R wf_s => sat0 moves0.
have sat := satisfies_9z_same wf (with_rates_same v) sat0.
have moves := moves_on_same wf (with_rates_same v) moves0.
have rate_same j : (j < ns)%N ->
    slip_rate (with_rates v) (particle s j) = slip_rate v (particle s j).
  move=> lt_j; have [first second] := slip_dofs wf lt_j.
  by rewrite /slip_rate -(along_same (with_rates_same v) _ first second).

have rates j : (j < ns)%N -> slides z support j ->
    with_rates v (dofs s + j)%N = - slip_rate (with_rates v) (particle s j).
  by move=> lt_j in_s; rewrite with_rates_slip // in_s rate_same.
have pos i : i \in slip Q -> i \in slipping_variables z support -> 0 < with_rates v i.
  move=> i_slip; case: (slip_cases i_slip) => [[j lt_j ->]|/rest_out_of_support/negbTE-> //].
  rewrite slip_in_support // with_rates_slip // => in_s.
  by rewrite in_s oppr_gt0 (rate_of_slip moves0).
have off i : i \in slip Q -> i \notin slipping_variables z support -> with_rates v i = 0.
  move=> i_slip; case: (slip_cases i_slip) => [[j lt_j ->]|/with_rates_beyond-> //].
  by rewrite slip_in_support // with_rates_slip // => /negbTE->.

split=> //; have [t0 [[d d_in vd] _ _ slip _]] := sat; split=> //.
- exists d; last by [].
  move: d_in; rewrite size_forms !mem_iota !add0n /= => lt_d.
  by rewrite -addnA ltn_addr.
- move=> i /form_of_equation in_list; rewrite reaction_form.
  exact: (equations_hold wf halves sat moves rates).
move=> i i_slip; have [[j lt_j eq_i]|ge_i] := slip_cases i_slip; last first.
  have x0 := with_rates_beyond v ge_i; rewrite x0 mul0r lexx; split=> //.
  rewrite reaction_form; apply: (inequalities_hold wf halves sat moves).
  exact: form_of_inequality.
rewrite eq_i with_rates_slip // reaction_form form_of_slip //.
rewrite value_slip_line; have [_ rate_le cone_le _] := slip _ lt_j.
have [in_s|out] := boolP (slides z support j).
  rewrite (cone_of_slip sat moves lt_j in_s) mulr0 oppr0 mulr0 lexx; split=> //.
  by rewrite oppr_ge0 -rate_same.
by rewrite mul0r lexx; split=> //; rewrite oppr_ge0 pmulr_rle0.
Qed.

Theorem zero_enclosed_sound : exists (t : R) v,
  [/\ between t (box_from c) (box_to c), satisfies_9z z u t v,
      has_support s u support rest t v, has_zero_support z u support rest t v &
      forall t' v', satisfies_9z z u t' v' -> between t' (box_from c) (box_to c) ->
        moves_on z support v' -> t' = t /\ same_motion s v v'].
Proof.
have [t [x [bt sat slips zero uniq]]] := zero_pencil_solution.
exists t, x; split=> // t' v' sat' bt' moves'.
have [sol pos off] := with_rates_solution sat' moves'.
have [-> [f f0 scaled]] := uniq _ _ sol bt' pos off.
split=> //; exists f => // d d_in; rewrite (with_rates_same v' d_in) scaled //.
move: d_in; rewrite size_forms !mem_iota !add0n /= => lt_d.
by rewrite -addnA ltn_addr.
Qed.

End Sound.
