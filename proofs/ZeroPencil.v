(* The pencil of a system with particles in contact with zero reaction (z).

   It is that of System.v with three more variables for each z particle: gap, right and left, with

       -v_N = gap,    v_T = right - left

   for the unit normal, and the rows of the split form

       -w_N,    w_T - c mu w_N,    -w_T - c mu w_N

   (c is the friction factor, which is the length of the normal of the particle; the normal of the
   variable gap and of its row has the length of the tangent, [unit_normal]).

   Right and left may be raised by a common constant, so x is not determined by the motion.  x is
   *split* if of right and left of each particle at least one is 0.

   For lambda^2 as the unknown the rows are polynomials in mu: with the pencils for mu = 0/1 and
   "1/0" as *parts*, they are plain + mu friction + mu^2 c^2 g x ([split_row]); the last term is 0
   where the obstacle is flat ([flat_split_row]).

   A region in which right and left of one particle both move holds no split x ([both_halves]); one
   in which at least one of them is at rest holds split solutions only ([halves_apart]).

   Theorem [zero_parts_solution]: the split variables of a motion with (9), [zero_variables_of],
   satisfy the complementarity conditions with these rows, for every real mu.
   Theorem [zero_parts_motion]: split variables that do so give a motion with (9).

   Theorem [zero_pencil_solution]: the split variables of a motion with (9) solve the pencil, and
   the motion of these variables is that motion ([zero_motion_of_variables]).
   Theorem [zero_pencil_motion]: the motion of a split solution satisfies (9), and its split
   variables are the solution ([zero_variables_of_motion]).

   Pages: spec/certificates.md, 5.1 and 5.3; spec/zero-reaction.md, Z.3.
   Rust: crates/model/src/reduction/eliminate.rs, crates/check/src/pencil.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Condensation Pencil Claim System
  ZeroReaction.

Section Checker.

Local Open Scope Z_scope.

Variables (z : zero_system) (u : unknown).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).

Definition zero_firsts := [seq first_dof p | p <- zero_particles z].
Definition zero_seconds := [seq second_dof p | p <- zero_particles z].

(* The tangent turned, to the side of the normal. *)
Definition turned p : planar := (- (tangent p).2, (tangent p).1).

Definition unit_normal p : planar :=
  if 0 <? inner (normal p) (turned p) then turned p else (- (turned p).1, - (turned p).2).

(* The columns to which a degree of freedom belongs, and the factors it gets. *)
Definition three_columns j (n t : Z) : sparse_row :=
  [:: (gap z j, - n); (right z j, t); (left z j, - t)].

Definition zero_columns d : sparse_row :=
  if d \in zero_firsts then
    let j := index d zero_firsts in let p := zero_particle z j in
    three_columns j (unit_normal p).1 (tangent p).1
  else if d \in zero_seconds then
    let j := index d zero_seconds in let p := zero_particle z j in
    three_columns j (unit_normal p).2 (tangent p).2
  else if column s d is Some c then [:: c] else [::].

Definition zero_table := [seq zero_columns d | d <- iota 0 (dofs s)].

(* The factor by which the rows with mu are multiplied. *)
Definition row_multiple := if u is Lambda2 _ q then q else 1.

Definition scaled_normal p : planar :=
  (row_multiple * (unit_normal p).1, row_multiple * (unit_normal p).2).

(* The rows of gap, right and left, as forms of the motion. *)
Definition zero_forms j : seq linear_form :=
  let p := zero_particle z j in
  [:: negative (pressing_form s u (scaled_normal p) p);
      negative (cone_form s u (with_sign (-1) p)); negative (cone_form s u (with_sign 1 p))].

Definition variable_forms : seq linear_form :=
  [seq force_form s u d | d <- free_dofs s] ++
  [seq negative (cone_form s u p) | p <- particles s] ++
  flatten [seq zero_forms j | j <- iota 0 nz].

Definition zero_pencil := pencil_of_forms zero_table (free_number s + ns + 3 * nz) variable_forms
  (iota 0 (free_number s)).

End Checker.

Definition part_plain z := zero_pencil z (Lambda2 0 1).
Definition part_friction z := zero_pencil z (Lambda2 1 0).

Section Halves.

Variable z : zero_system.
Notation nz := (size (zero_particles z)).

Definition slip_number := (size (particles (without_zero z)) + 3 * nz)%N.

Definition half_state (r : region) i := state_of r (i - free_number (without_zero z)).

Definition halves_apart r := all (fun j =>
  is_resting (half_state r (right z j)) || is_resting (half_state r (left z j))) (iota 0 nz).

Definition both_halves r := has (fun j =>
  is_moving (half_state r (right z j)) && is_moving (half_state r (left z j))) (iota 0 nz).

End Halves.

Lemma zero_pencil_wellformed z u : wellformed (zero_pencil z u).
Proof.
rewrite /wellformed /= iota_uniq; apply/allP => i; rewrite mem_iota add0n -addnA => lt_i.
exact: leq_trans lt_i (leq_addr _ _).
Qed.

Lemma zero_slips z u : slip (zero_pencil z u) = iota (free_number (without_zero z)) (slip_number z).
Proof. by rewrite /zero_pencil /pencil_of_forms -addnA; apply: slip_iota. Qed.

Lemma size_slips z u : size (slip (zero_pencil z u)) = slip_number z.
Proof. by rewrite zero_slips size_iota. Qed.

Lemma nth_triples T (x : T) (f : nat -> seq T) n m j k :
  (forall i, size (f i) = 3%N) -> (k < 3)%N -> (j < n)%N ->
  nth x (flatten [seq f i | i <- iota m n]) (3 * j + k)%N = nth x (f (m + j)%N) k.
Proof.
move=> sz lt_k; elim: n m j => //= n IH m [|j] lt_j; rewrite nth_cat sz.
  by rewrite muln0 add0n lt_k addn0.
have -> : (3 * j.+1 + k = 3 + (3 * j + k))%N by rewrite mulnS addnA.
by rewrite ltnNge leq_addr /= addKn IH // addSnnS.
Qed.

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

Lemma value_right : form_value (cone_form s u (with_sign (-1) p)) t x =
  row_factor R u * (- w_T + mu * w_N).
Proof.
rewrite (value_cone wf_system); last exact: flat_turns.
by rewrite /cone turning_at_flat // mul0r addr0 -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r.
Qed.

Lemma value_left : form_value (cone_form s u (with_sign 1 p)) t x =
  row_factor R u * (w_T + mu * w_N).
Proof.
rewrite (value_cone wf_system); last exact: flat_turns.
by rewrite /cone turning_at_flat // mul0r addr0 toR1 mul1r.
Qed.

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
have /(all_nthP (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z)/(_ _ lt_j) := in_range.
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

Section Real.

Variables (R : rcfType) (z : zero_system) (u : unknown).
Hypothesis wf : zero_wellformed z u.
Implicit Types (t : R) (v x : nat -> R).

Notation s := (without_zero z).
Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).
Notation Q := (zero_pencil z u).
Notation L := (toR (unit_length s) : R).

Let wf_s : system_wellformed s u := wf_system wf.

(* The motion of x. *)
Definition zero_motion x d := table_motion (zero_table z) x d.

Lemma size_forms u' : size (variable_forms z u') = (nf + ns + 3 * nz)%N.
Proof.
rewrite !size_cat !size_map size_flatten /shape -map_comp addnA; congr (_ + _)%N.
rewrite (eq_map (f2 := fun=> 3%N)) // -[in RHS](size_iota 0 nz).
by elim: (iota 0 _) => //= i l ->; rewrite mulnS.
Qed.

(* Where the degrees of freedom are. *)
Lemma dofs_apart :
  [/\ uniq (zero_firsts z), uniq (zero_seconds z),
      forall d, d \in zero_firsts z ++ zero_seconds z -> (d \in moving_dofs s) = false &
      forall d, d \in zero_seconds z -> (d \in zero_firsts z) = false].
Proof.
have /and4P[_ + _ _] := wf; rewrite cat_uniq => /and3P[_ /hasPn out].
rewrite cat_uniq => /and3P[u1 /hasPn d12 u2]; split=> // d d_in; apply/negbTE.
  exact: out.
exact: d12.
Qed.

Lemma zero_first j : (j < nz)%N -> first_dof (zero_particle z j) = nth 0%N (zero_firsts z) j.
Proof. by move=> lt_j; rewrite (nth_map (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z). Qed.

Lemma zero_second j : (j < nz)%N -> second_dof (zero_particle z j) = nth 0%N (zero_seconds z) j.
Proof. by move=> lt_j; rewrite (nth_map (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z). Qed.

Lemma columns_first j : (j < nz)%N -> let p := zero_particle z j in
  zero_columns z (first_dof p) = three_columns z j (unit_normal p).1 (tangent p).1.
Proof.
move=> lt_j p; have [u1 _ _ _] := dofs_apart; rewrite /p zero_first //.
by rewrite /zero_columns mem_nth ?size_map // index_uniq ?size_map.
Qed.

Lemma columns_second j : (j < nz)%N -> let p := zero_particle z j in
  zero_columns z (second_dof p) = three_columns z j (unit_normal p).2 (tangent p).2.
Proof.
move=> lt_j p; have [_ u2 _ apart] := dofs_apart; rewrite /p zero_second // /zero_columns.
have in2 : nth 0%N (zero_seconds z) j \in zero_seconds z by rewrite mem_nth ?size_map.
by rewrite apart // in2 index_uniq ?size_map.
Qed.

Lemma columns_moving d : d \in moving_dofs s ->
  zero_columns z d = if column s d is Some c then [:: c] else [::].
Proof.
move=> d_in; have [_ _ out _] := dofs_apart; rewrite /zero_columns.
case: ifP => [in1|_]; first by have := out d; rewrite mem_cat in1 d_in => /(_ isT).
case: ifP => [in2|_] //; by have := out d; rewrite mem_cat in2 orbT d_in => /(_ isT).
Qed.

Lemma nth_table d : d \in all_dofs -> nth [::] (zero_table z) d = zero_columns z d.
Proof. by rewrite mem_iota add0n /= => lt_d; rewrite (nth_map 0%N) ?size_iota ?nth_iota. Qed.

Lemma columns_small d c : c \in zero_columns z d -> (c.1 < nf + ns + 3 * nz)%N.
Proof.
have three j n n' : (j < nz)%N -> c \in three_columns z j n n' -> (c.1 < nf + ns + 3 * nz)%N.
  move=> lt_j; rewrite !inE => /or3P[]/eqP-> /=; rewrite /right /left /gap; move: lt_j; clear;
    lia.
rewrite /zero_columns; case: ifP => [d_in|_].
  by apply: three; rewrite -(size_map first_dof) index_mem.
case: ifP => [d_in|_]; first by apply: three; rewrite -(size_map second_dof) index_mem.
case col: (column s d) => [[j f]|] //; rewrite inE => /eqP-> /=.
exact: leq_trans (column_in_range col) (leq_addr _ _).
Qed.

Lemma table_small d c : c \in nth [::] (zero_table z) d -> (c.1 < nf + ns + 3 * nz)%N.
Proof.
have [d_in|d_out] := boolP (d \in all_dofs); first by rewrite nth_table //; apply: columns_small.
by rewrite nth_default // size_map size_iota leqNgt; move: d_out; rewrite mem_iota.
Qed.

(* The rows of the pencil are the forms at the motion of x. *)
Lemma zero_reaction_form u' t x i : (i < nf + ns + 3 * nz)%N ->
  reaction (zero_pencil z u') t x i =
  form_value (nth no_form (variable_forms z u') i) t (zero_motion x).
Proof. by move=> lt_i; apply: form_reaction; [apply: table_small | rewrite size_forms]. Qed.

(* The motion at each degree of freedom. *)
Lemma zero_motion_moving x d : d \in moving_dofs s -> zero_motion x d = motion s x d.
Proof.
move=> d_in; rewrite /zero_motion /table_motion nth_table ?(moving_dof_in wf_s) //.
rewrite columns_moving // /motion.
case: (column s d) => [[j c]|]; last by rewrite row_value_nil.
by rewrite /row_value big_seq1.
Qed.

Lemma along_three e p j x : first_dof p \in all_dofs -> second_dof p \in all_dofs ->
  zero_columns z (first_dof p) = three_columns z j (unit_normal p).1 (tangent p).1 ->
  zero_columns z (second_dof p) = three_columns z j (unit_normal p).2 (tangent p).2 ->
  along e p (zero_motion x) =
  - (toR e.1 * toR (unit_normal p).1 + toR e.2 * toR (unit_normal p).2) * x (gap z j) +
  (toR e.1 * toR (tangent p).1 + toR e.2 * toR (tangent p).2) * (x (right z j) - x (left z j)).
Proof.
move=> first second c1 c2; rewrite /along /zero_motion /table_motion !nth_table // c1 c2.
rewrite /row_value !big_cons !big_nil /= !toRN.
move: (x _) (x _) (x _) (toR _) (toR _) (toR _) (toR _) (toR _) (toR _) => *; ring.
Qed.

Lemma along_zero e x j : (j < nz)%N -> let p := zero_particle z j in
  along e p (zero_motion x) =
  - (toR e.1 * toR (unit_normal p).1 + toR e.2 * toR (unit_normal p).2) * x (gap z j) +
  (toR e.1 * toR (tangent p).1 + toR e.2 * toR (tangent p).2) * (x (right z j) - x (left z j)).
Proof.
move=> lt_j p; have [first second] := zero_particle_dofs wf lt_j.
by apply: along_three; rewrite // ?columns_first ?columns_second.
Qed.

Lemma zero_motion_rest x d : d \in all_dofs -> d \notin moving_with_zero z -> zero_motion x d = 0.
Proof.
move=> d_in; rewrite /moving_with_zero mem_cat negb_or => /andP[out].
rewrite /zero_dofs mem_cat negb_or => /andP[out1 out2].
rewrite /zero_motion /table_motion nth_table // /zero_columns (negbTE out1) (negbTE out2).
move: out; rewrite !mem_cat !negb_or => /and3P[/negbTE out_f /negbTE out_1 /negbTE out_2].
by rewrite /column out_f out_1 out_2 row_value_nil.
Qed.

(* The frame of a z particle: t and the unit normal have the length L, the normal is a positive
   multiple of the unit normal. *)
Lemma frame_parts j : (j < nz)%N -> let p := zero_particle z j in let n := unit_normal p in
  [/\ toR (tangent p).1 ^+ 2 + toR (tangent p).2 ^+ 2 = L ^+ 2,
      toR n.1 ^+ 2 + toR n.2 ^+ 2 = L ^+ 2,
      toR n.1 * toR (tangent p).1 + toR n.2 * toR (tangent p).2 = 0 :> R &
      exists2 c : R, 0 < c & toR (normal p).1 = c * toR n.1 /\ toR (normal p).2 = c * toR n.2].
Proof.
move=> lt_j p n; have /and4P[_ _ _ /(all_nthP (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z)] := wf.
move/(_ _ lt_j); rewrite -/(zero_particle z j) -/p => /and3P[/Z.eqb_spec tt nn /Z.eqb_spec tn].
have L0 : 0 < L := unit_length_gt0 R wf_s.
have l2 : 0 < L ^+ 2 by rewrite exprn_gt0.
have ttR : toR (tangent p).1 ^+ 2 + toR (tangent p).2 ^+ 2 = L ^+ 2.
  by rewrite !expr2 -!toRM -toRD -tt.
have nnR : 0 < toR (normal p).1 ^+ 2 + toR (normal p).2 ^+ 2 :> R.
  by rewrite !expr2 -!toRM -toRD toR_gt0.
have tnR : toR (tangent p).1 * toR (normal p).1 + toR (tangent p).2 * toR (normal p).2 = 0 :> R.
  by rewrite -!toRM -toRD -[X in toR X]/(inner _ _) tn toR0.
pose side : R := if (0 <? inner (normal p) (turned p))%Z then 1 else -1.
have n1 : toR n.1 = - side * toR (tangent p).2.
  by rewrite /n /unit_normal /side; case: ifP => _; rewrite /= !toRN ?opprK ?mulN1r ?opprK ?mul1r.
have n2 : toR n.2 = side * toR (tangent p).1.
  by rewrite /n /unit_normal /side; case: ifP => _; rewrite /= ?toRN ?mulN1r ?mul1r.
have side2 : side ^+ 2 = 1 by rewrite /side; case: ifP => _; rewrite ?sqrrN expr1n.
have innerE : toR (inner (normal p) (turned p)) =
    toR (normal p).2 * toR (tangent p).1 - toR (normal p).1 * toR (tangent p).2 :> R.
  by rewrite /inner /turned /= toRD !toRM toRN mulrN addrC.
have side_ge : 0 <= side * (toR (normal p).2 * toR (tangent p).1 -
                            toR (normal p).1 * toR (tangent p).2).
  rewrite -innerE /side; case: ifP => sign; first by rewrite mul1r ltW // toR_gt0.
  by rewrite mulN1r oppr_ge0 leNgt toR_gt0 sign.
move: ttR nnR tnR n1 n2 side_ge; move: (toR (tangent p).1) (toR (tangent p).2) => t1 t2.
move: (toR (normal p).1) (toR (normal p).2) (toR n.1) (toR n.2) => N1 N2 m1 m2.
move=> ttR nnR tnR -> -> side_ge; have [k k0 [e1 e2]] := orthogonal l2 ttR nnR tnR; split=> //.
- transitivity (side ^+ 2 * (t1 ^+ 2 + t2 ^+ 2)); first by ring.
  by rewrite side2 mul1r.
- by ring.
exists (side * k); last by rewrite e1 e2; split; rewrite -[LHS]mul1r -side2; ring.
move: side_ge; rewrite e1 e2 (_ : _ * _ = side * k * (t1 ^+ 2 + t2 ^+ 2)); last by ring.
rewrite ttR pmulr_lge0 // => ge0; rewrite lt_neqAle ge0 andbT eq_sym mulf_neq0 //.
by rewrite -sqrf_eq0 side2 oner_neq0.
Qed.

(* The values of v and of its forces at a particle. *)
Lemma along_normal f j : (j < nz)%N -> let p := zero_particle z j in
  exists2 c : R, 0 < c & along (normal p) p f = c * along (unit_normal p) p f.
Proof.
move=> lt_j p; have [_ _ _ [c c0 [n1 n2]]] := frame_parts lt_j; exists c => //.
by rewrite /along -/p n1 n2; move: (toR _) (toR _) (f _) (f _) => *; ring.
Qed.

Lemma gap_rate x j : (j < nz)%N -> let p := zero_particle z j in
  along (unit_normal p) p (zero_motion x) = - (L ^+ 2 * x (gap z j)).
Proof.
move=> lt_j p; have [_ nn nt _] := frame_parts lt_j.
by rewrite along_zero // -!expr2 -/p nn nt mul0r addr0 mulNr.
Qed.

Lemma half_rates x j : (j < nz)%N -> let p := zero_particle z j in
  along (tangent p) p (zero_motion x) = L ^+ 2 * x (right z j) - L ^+ 2 * x (left z j).
Proof.
move=> lt_j p; have [tt _ nt _] := frame_parts lt_j; rewrite along_zero // -!expr2 -/p tt.
by rewrite ![toR (tangent _).1 * _]mulrC ![toR (tangent _).2 * _]mulrC nt oppr0 mul0r add0r mulrBr.
Qed.

Lemma along_moving e x j : (j < ns)%N -> let p := particle s j in
  along e p (zero_motion x) = along e p (motion s x).
Proof.
move=> lt_j p; rewrite /along !zero_motion_moving // !mem_cat ?first_in ?second_in ?orbT //.
Qed.

Lemma zero_slip_rate x j : (j < ns)%N ->
  slip_rate (zero_motion x) (particle s j) = - (L ^+ 2 * x (nf + j)%N).
Proof. by move=> lt_j; rewrite -(slip_motion wf_s) // /slip_rate along_moving. Qed.

Lemma zero_slip_cases i : i \in slip Q ->
  (exists2 j, (j < ns)%N & i = (nf + j)%N) \/
  (exists2 j, (j < nz)%N & [\/ i = gap z j, i = right z j | i = left z j]).
Proof.
rewrite mem_filter !mem_iota !add0n /= -leqNgt => /andP[ge_i lt_i].
have [lt_s|ge_s] := ltnP i (nf + ns).
  by left; exists (i - nf)%N; [rewrite ltn_subLR | rewrite subnKC].
right; have lt_j : ((i - (nf + ns)) %/ 3 < nz)%N by rewrite ltn_divLR // mulnC ltn_subLR.
exists ((i - (nf + ns)) %/ 3)%N => //.
have := divn_eq (i - (nf + ns)) 3; have : ((i - (nf + ns)) %% 3 < 3)%N by rewrite ltn_mod.
move: (_ %/ 3)%N (_ %% 3)%N ge_s => q r ge_s lt_r eq.
have i_eq : i = (gap z q + r)%N.
  by rewrite /gap [(3 * q)%N]mulnC -addnA -eq subnKC.
case: r lt_r {eq} i_eq => [|[|[|]]] // _ ->.
- by apply: Or31; rewrite addn0.
- by apply: Or32; rewrite addn1.
by apply: Or33; rewrite addn2.
Qed.

(* The rows of the pencil. *)
Notation w t x := (force s (lambda2_of u t) (zero_motion x)).
Notation w2 lambda2 x := (force s lambda2 (zero_motion x)).

Lemma zero_free_reaction u' t x k : (k < nf)%N -> reaction (zero_pencil z u') t x k =
  w2 (lambda2_of u' t) x (nth 0%N (free_dofs s) k).
Proof.
move=> lt_k; rewrite zero_reaction_form; last by rewrite -addnA ltn_addr.
by rewrite nth_cat size_map lt_k (nth_map 0%N) // (value_force wf_s).
Qed.

Lemma nth_slip_form u' j : (j < ns)%N ->
  nth no_form (variable_forms z u') (nf + j) = negative (cone_form s u' (particle s j)).
Proof.
move=> lt_j; rewrite nth_cat size_map ltnNge leq_addr /= addKn nth_cat size_map lt_j.
by rewrite (nth_map (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z).
Qed.

Lemma slip_small j : (j < ns)%N -> (nf + j < nf + ns + 3 * nz)%N.
Proof. by move=> lt_j; rewrite ltn_addr // ltn_add2l. Qed.

Lemma zero_slip_reaction t x j : (j < ns)%N -> reaction Q t x (nf + j)%N =
  - (row_factor R u * cone s (lambda2_of u t) (mu_of u t) (zero_motion x) (particle s j)).
Proof.
move=> lt_j; rewrite zero_reaction_form ?slip_small // nth_slip_form //.
by rewrite value_negative (value_cone wf_s) //; exact: (particle_turns wf_s).
Qed.

Lemma slip_part m q lambda2 x j : (j < ns)%N ->
  reaction (zero_pencil z (Lambda2 m q)) lambda2 x (nf + j)%N = let p := particle s j in
  - (toR q * (toR (sign_of p) * along (tangent p) p (w2 lambda2 x)) +
     toR m * along (normal p) p (w2 lambda2 x) +
     toR (turning s (Lambda2 m q) p) * slip_rate (zero_motion x) p).
Proof.
move=> lt_j; rewrite zero_reaction_form ?slip_small // nth_slip_form //.
by rewrite value_negative (value_cone_parts wf_s).
Qed.

Lemma nth_zero_form u' j k : (j < nz)%N -> (k < 3)%N ->
  nth no_form (variable_forms z u') (gap z j + k) = nth no_form (zero_forms z u' j) k.
Proof.
move=> lt_j lt_k; rewrite nth_cat size_map -/(free_number s).
have -> : (gap z j + k < nf)%N = false.
  by apply/negbTE; rewrite -leqNgt /gap -!addnA leq_addr.
rewrite nth_cat size_map; have -> : (gap z j + k - nf = ns + (3 * j + k))%N.
  by rewrite /gap -!addnA addKn.
by rewrite ltnNge leq_addr /= addKn nth_triples.
Qed.

Lemma gap_small j k : (j < nz)%N -> (k < 3)%N -> (gap z j + k < nf + ns + 3 * nz)%N.
Proof. by rewrite /gap => lt_j lt_k; move: lt_j lt_k; clear; lia. Qed.

Lemma zero_row_form u' t x j k : (j < nz)%N -> (k < 3)%N ->
  reaction (zero_pencil z u') t x (gap z j + k)%N =
  form_value (nth no_form (zero_forms z u' j) k) t (zero_motion x).
Proof. by move=> lt_j lt_k; rewrite zero_reaction_form ?gap_small // nth_zero_form. Qed.

Lemma zero_reactions t x j : (j < nz)%N -> let p := zero_particle z j in
  let w_T := along (tangent p) p (w t x) in let w_N := along (normal p) p (w t x) in
  [/\ reaction Q t x (gap z j) = - (row_factor R u * along (unit_normal p) p (w t x)),
      reaction Q t x (right z j) = row_factor R u * (w_T - mu_of u t * w_N) &
      reaction Q t x (left z j) = row_factor R u * (- w_T - mu_of u t * w_N)].
Proof.
move=> lt_j p w_T w_N.
split.
- rewrite -[gap z j]addn0 zero_row_form //= value_negative (value_pressing wf_s) /along !toRM.
  have -> : toR (row_multiple u) = row_factor R u.
    by rewrite /row_multiple /row_factor; case: (u) => *; rewrite ?toR1.
  by rewrite -/p; move: (toR _) (toR _) (row_factor _ _) (w t x _) (w t x _) => *; ring.
- rewrite -[right z j]addn1 zero_row_form //= value_negative (value_right wf) -/p -/w_T -/w_N.
  by ring.
have -> : left z j = (gap z j + 2)%N by rewrite addn2.
by rewrite zero_row_form //= value_negative (value_left wf) -/p -/w_T -/w_N; ring.
Qed.

Lemma zero_parts m q lambda2 x j : (j < nz)%N -> let p := zero_particle z j in
  let w_T := along (tangent p) p (w2 lambda2 x) in
  let w_N := along (normal p) p (w2 lambda2 x) in
  let Q' := zero_pencil z (Lambda2 m q) in
  [/\ reaction Q' lambda2 x (gap z j) = - (toR q * along (unit_normal p) p (w2 lambda2 x)),
      reaction Q' lambda2 x (right z j) = toR q * w_T - toR m * w_N &
      reaction Q' lambda2 x (left z j) = - (toR q * w_T) - toR m * w_N].
Proof.
move=> lt_j p w_T w_N Q'.
have half S : form_value (cone_form s (Lambda2 m q) (with_sign S p)) lambda2 (zero_motion x) =
    toR q * (toR S * w_T) + toR m * w_N.
  by rewrite (value_cone_parts wf_s) flat_turning // toR0 mul0r addr0.
split.
- rewrite -[gap z j]addn0 zero_row_form //= value_negative (value_pressing wf_s) /along !toRM.
  by rewrite -/p; move: (toR _) (toR _) (toR _) (w2 lambda2 x _) (w2 lambda2 x _) => *; ring.
- rewrite -[right z j]addn1 zero_row_form //= value_negative half -[(-1)%Z]/(Z.opp 1) toRN toR1.
  by ring.
have -> : left z j = (gap z j + 2)%N by rewrite addn2.
by rewrite zero_row_form //= value_negative half toR1; ring.
Qed.

(* c^2 g x at a slip particle, in the unit of the rows. *)
Definition turning_row x i : R :=
  let p := particle s (i - nf) in
  if (i < nf + ns)%N then toR (inner (normal p) (normal p) * geometric_stiffness p) * x i else 0.

(* The rows at lambda^2 and mu; for the values of the unknown those of the pencil. *)
Definition split_row lambda2 mu x i :=
  reaction (part_plain z) lambda2 x i + mu * reaction (part_friction z) lambda2 x i +
  mu ^+ 2 * turning_row x i.

Lemma flat_split_row lambda2 mu x i : flat s -> i \in slip Q -> split_row lambda2 mu x i =
  reaction (part_plain z) lambda2 x i + mu * reaction (part_friction z) lambda2 x i.
Proof.
rewrite zero_slips mem_iota => is_flat /andP[ge_i _]; rewrite /split_row /turning_row.
case: ifP => [lt_i|_]; last by rewrite mulr0 addr0.
by rewrite flat_particle ?ltn_subLR // Z.mul_0_r toR0 mul0r mulr0 addr0.
Qed.

Lemma slip_split_row lambda2 mu x j : (j < ns)%N ->
  split_row lambda2 mu x (nf + j)%N = - cone s lambda2 mu (zero_motion x) (particle s j).
Proof.
move=> lt_j; have [_ _ _ _ l0] := wf_parts wf_s.
rewrite /split_row !slip_part //= plain_turning // friction_turning toR0 toR1 /cone.
rewrite /turning_row ltn_add2l lt_j addKn zero_slip_rate // /turning_at toRM.
move: (along _ _ _) (along _ _ _) (toR (inner _ _)) (toR (geometric_stiffness _)) => w_T w_N nn g.
by move: (toR (sign_of _)) (lt0r_neq0 (unit_length_gt0 R wf_s)) => S L0; field.
Qed.

Lemma zero_split_rows lambda2 mu x j : (j < nz)%N -> let p := zero_particle z j in
  let w_T := along (tangent p) p (w2 lambda2 x) in
  let w_N := along (normal p) p (w2 lambda2 x) in
  [/\ split_row lambda2 mu x (gap z j) = - along (unit_normal p) p (w2 lambda2 x),
      split_row lambda2 mu x (right z j) = w_T - mu * w_N &
      split_row lambda2 mu x (left z j) = - w_T - mu * w_N].
Proof.
move=> lt_j p w_T w_N; rewrite /split_row /part_plain /part_friction.
have no_turning k : turning_row x (gap z j + k) = 0.
  by rewrite /turning_row ifF //; apply/negbTE; rewrite -leqNgt /gap -!addnA !leq_add2l leq_addr.
move: (no_turning 0%N) (no_turning 1%N) (no_turning 2%N); rewrite addn0 addn1 addn2 => -> -> ->.
rewrite !mulr0 !addr0.
have [-> -> ->] := zero_parts 0 1 lambda2 x lt_j.
have [-> -> ->] := zero_parts 1 0 lambda2 x lt_j.
by rewrite -/p -/w_T -/w_N toR0 toR1; split; ring.
Qed.

Lemma reaction_at_unknown t x i : i \in slip Q ->
  reaction Q t x i = row_factor R u * split_row (lambda2_of u t) (mu_of u t) x i.
Proof.
case/zero_slip_cases=> [[j lt_j ->]|[j lt_j cases]].
  by rewrite zero_slip_reaction // slip_split_row // mulrN.
have [g r l] := zero_reactions t x lt_j.
have [g' r' l'] := zero_split_rows (lambda2_of u t) (mu_of u t) x lt_j.
by case: cases => ->; rewrite ?g ?g' ?r ?r' ?l ?l' ?mulrN.
Qed.

(* The variables of a motion; of right and left at most one is not 0. *)
Definition zero_variables_of v i :=
  let k := (i - (nf + ns))%N in
  let p := zero_particle z (k %/ 3) in
  let v_T := along (tangent p) p v / L ^+ 2 in
  if (i < nf + ns)%N then variables_of s v i
  else nth 0 [:: - (along (unit_normal p) p v / L ^+ 2); if 0 < v_T then v_T else 0;
                 if v_T < 0 then - v_T else 0] (k %% 3).

Definition split x := forall j, (j < nz)%N ->
  [/\ 0 <= x (right z j), 0 <= x (left z j) & x (right z j) * x (left z j) = 0].

Lemma variables_at v j : (j < nz)%N -> let p := zero_particle z j in
  let v_T := along (tangent p) p v / L ^+ 2 in
  [/\ zero_variables_of v (gap z j) = - (along (unit_normal p) p v / L ^+ 2),
      zero_variables_of v (right z j) = (if 0 < v_T then v_T else 0) &
      zero_variables_of v (left z j) = (if v_T < 0 then - v_T else 0)].
Proof.
move=> lt_j p v_T; have at_k k : (k < 3)%N -> zero_variables_of v (gap z j + k) =
    nth 0 [:: - (along (unit_normal p) p v / L ^+ 2); if 0 < v_T then v_T else 0;
              if v_T < 0 then - v_T else 0] k.
  move=> lt_k; have -> : (gap z j + k = nf + ns + (j * 3 + k))%N.
    by rewrite [gap z j]/(_ + _)%N [(j * _)%N]mulnC addnA.
  rewrite /zero_variables_of ltnNge leq_addr addKn.
  by rewrite divnMDl // modnMDl divn_small // addn0 modn_small.
split; first by rewrite -[gap z j]addn0 at_k.
  by rewrite -[right z j]addn1 at_k.
have -> : left z j = (gap z j + 2)%N by rewrite addn2.
by rewrite at_k.
Qed.

Lemma L2_gt0 : 0 < L ^+ 2.
Proof. by rewrite exprn_gt0 // (unit_length_gt0 R wf_s). Qed.

Lemma split_variables v : split (zero_variables_of v).
Proof.
move=> j lt_j; have [_ -> ->] := variables_at v lt_j; set v_T := _ / _.
case: (ltrgtP v_T 0) => sign; rewrite ?mul0r ?mulr0 ?lexx; split=> //; last exact: ltW.
by rewrite oppr_ge0 ltW.
Qed.

(* v = (n'v / L^2) n + (t'v / L^2) t *)
Lemma plane (t1 t2 n1 n2 v1 v2 l : R) : 0 < l ->
  t1 ^+ 2 + t2 ^+ 2 = l -> n1 ^+ 2 + n2 ^+ 2 = l -> n1 * t1 + n2 * t2 = 0 ->
  n1 * (n1 * v1 + n2 * v2) + t1 * (t1 * v1 + t2 * v2) = l * v1 /\
  n2 * (n1 * v1 + n2 * v2) + t2 * (t1 * v1 + t2 * v2) = l * v2.
Proof.
move=> l0 tt nn nt; have [||k _ [e1 e2]] := orthogonal (n1 := n1) (n2 := n2) l0 tt; rewrite ?nn //.
  by rewrite -nt; ring.
have k2 : k ^+ 2 = 1.
  by apply: (mulfI (lt0r_neq0 l0)); rewrite mulr1 -[RHS]nn e1 e2 -tt; ring.
rewrite e1 e2 -tt; split.
  transitivity (k ^+ 2 * (t2 * (t2 * v1 - t1 * v2)) + t1 * (t1 * v1 + t2 * v2)); first by ring.
  by rewrite k2; ring.
transitivity (k ^+ 2 * (t1 * (t1 * v2 - t2 * v1)) + t2 * (t1 * v1 + t2 * v2)); first by ring.
by rewrite k2; ring.
Qed.

Lemma difference_of_parts (a : R) :
  (if 0 < a then a else 0) - (if a < 0 then - a else 0) = a.
Proof. by case: (ltrgtP a 0) => [| |->]; rewrite ?subr0 ?sub0r ?opprK. Qed.

Lemma motion_of_zero_variables v :
  (forall d, d \in all_dofs -> d \notin moving_with_zero z -> v d = 0) ->
  (forall j, (j < ns)%N -> along (normal (particle s j)) (particle s j) v = 0) ->
  forall d, d \in all_dofs -> zero_motion (zero_variables_of v) d = v d.
Proof.
move=> at_rest slips d d_in.
have L0 : 0 < L := unit_length_gt0 R wf_s; have l2 := lt0r_neq0 L2_gt0.
have [d_zero|d_other] := boolP (d \in zero_dofs z).
  have at_particle j : (j < nz)%N -> let p := zero_particle z j in
      zero_motion (zero_variables_of v) (first_dof p) = v (first_dof p) /\
      zero_motion (zero_variables_of v) (second_dof p) = v (second_dof p).
    move=> lt_j p; have [first second] := zero_particle_dofs wf lt_j.
    have [gapE rightE leftE] := variables_at v lt_j.
    have [tt nn nt _] := frame_parts lt_j.
    have [v1 v2] := plane (v (first_dof p)) (v (second_dof p)) L2_gt0 tt nn nt.
    rewrite /zero_motion /table_motion !nth_table // columns_first // columns_second // -/p.
    rewrite /row_value !big_cons !big_nil /= gapE rightE leftE -/p !addr0 !toRN.
    have parts (c : R) (a : R) : c * (if 0 < a then a else 0) +
        - c * (if a < 0 then - a else 0) = c * a.
      by rewrite -[in RHS](difference_of_parts a) mulrBr mulNr.
    have component (n1 t1 aN aT vd : R) : n1 * aN + t1 * aT = L ^+ 2 * vd ->
        - n1 * - (aN / L ^+ 2) + t1 * (aT / L ^+ 2) = vd.
      by move=> eq; apply: (mulfI l2); rewrite -eq; field; exact: lt0r_neq0.
    by rewrite !parts; split; apply: component.
  move: d_zero; rewrite mem_cat => /orP[]/(nthP 0%N)[j]; rewrite size_map => lt_j <-.
    by rewrite -zero_first //; case: (at_particle _ lt_j).
  by rewrite -zero_second //; case: (at_particle _ lt_j).

have [d_moving|d_rest] := boolP (d \in moving_dofs s); last first.
  have out : d \notin moving_with_zero z by rewrite mem_cat negb_or d_rest.
  by rewrite zero_motion_rest // at_rest.
rewrite zero_motion_moving //.
transitivity (motion s (variables_of s v) d).
  rewrite /motion; case col: (column s d) => [[j c]|] //.
  by rewrite /zero_variables_of (column_in_range col).
exact: (motion_at_moving wf_s slips).
Qed.

Lemma variables_of_conditions lambda2 mu v : conditions_9z z lambda2 mu v ->
  forall d, d \in all_dofs -> zero_motion (zero_variables_of v) d = v d.
Proof. by case=> [_ at_rest _ slips _]; apply: motion_of_zero_variables => // j /slips[]. Qed.

Lemma zero_motion_of_variables t v : satisfies_9z z u t v ->
  forall d, d \in all_dofs -> zero_motion (zero_variables_of v) d = v d.
Proof. by case=> _ /variables_of_conditions. Qed.

(* A motion in three pairs, and back. *)
Lemma split_pairs (mu v_N r l w_N w_T : R) : 0 <= r -> 0 <= l -> r * l = 0 ->
  zero_reaction mu v_N (r - l) w_N w_T ->
  pair r (w_T - mu * w_N) /\ pair l (- w_T - mu * w_N).
Proof.
rewrite /zero_reaction /pair cone_sides.
move=> r0 l0 rl [_ _ _ /andP[left right] slip].
have row_right : 0 <= w_T - mu * w_N by rewrite -[w_T]opprK -opprD oppr_ge0.
have row_left : 0 <= - w_T - mu * w_N by rewrite -opprD oppr_ge0.
move/eqP: rl slip; rewrite mulf_eq0 => /orP[]/eqP zero; rewrite zero ?sub0r ?subr0.
  rewrite normrN ger0_norm // => slip; split; split=> //; first by rewrite mul0r.
  transitivity (mu * - l * w_N - l * w_T); first by ring.
  by rewrite -slip subrr.
rewrite ger0_norm // => slip; split; split=> //; last by rewrite mul0r.
transitivity (r * w_T - mu * r * w_N); first by ring.
by rewrite -slip subrr.
Qed.

Lemma pair_left (a x y : R) : 0 < a -> pair (a * x) y <-> pair x y.
Proof.
move=> a0; rewrite /pair pmulr_rge0 // -mulrA; split=> -[x0 y0 xy]; split=> //.
  by move/eqP: xy; rewrite mulf_eq0 gt_eqF //= => /eqP.
by rewrite xy mulr0.
Qed.

Lemma pair_right (a x y : R) : 0 < a -> pair x (a * y) <-> pair x y.
Proof. exact: complementary_scaled. Qed.
Lemma slip_in_zero_pencil j : (j < ns)%N -> (nf + j)%N \in slip Q.
Proof.
move=> lt_j; rewrite mem_filter !mem_iota !add0n /= -leqNgt leq_addr /=.
by rewrite -addnA ltn_add2l ltn_addr.
Qed.

Lemma three_in_zero_pencil j k : (j < nz)%N -> (k < 3)%N -> (gap z j + k)%N \in slip Q.
Proof.
move=> lt_j lt_k; rewrite mem_filter !mem_iota !add0n /= gap_small // andbT -leqNgt.
by rewrite /gap -!addnA leq_addr.
Qed.

(* The pairs of a z particle are those of (9). *)
Lemma zero_pairs lambda2 mu x j : (j < nz)%N -> let p := zero_particle z j in
  let w_T := along (tangent p) p (w2 lambda2 x) in
  let w_N := along (normal p) p (w2 lambda2 x) in
  [/\ pair (x (gap z j)) (split_row lambda2 mu x (gap z j)) <->
        pair (- along (normal p) p (zero_motion x)) (- w_N),
      pair (x (right z j)) (split_row lambda2 mu x (right z j)) <->
        pair (L ^+ 2 * x (right z j)) (w_T - mu * w_N) &
      pair (x (left z j)) (split_row lambda2 mu x (left z j)) <->
        pair (L ^+ 2 * x (left z j)) (- w_T - mu * w_N)].
Proof.
move=> lt_j p w_T w_N; have [-> -> ->] := zero_split_rows lambda2 mu x lt_j.
have half a b : pair a b <-> pair (L ^+ 2 * a) b := iff_sym (pair_left _ _ L2_gt0).
split; [|exact: half|exact: half].
have [c c0 ->] := along_normal (zero_motion x) lt_j; rewrite -/p gap_rate //.
have [c' c0' wN] := along_normal (w2 lambda2 x) lt_j; rewrite /w_N -/p wN.
rewrite mulrN opprK -[- (c' * _)]mulrN mulrA; apply: iff_sym.
exact: iff_trans (pair_left _ _ (mulr_gt0 c0 L2_gt0)) (pair_right _ _ c0').
Qed.

Theorem zero_parts_solution lambda2 mu v (x := zero_variables_of v) :
  conditions_9z z lambda2 mu v ->
  [/\ exists2 i, i \in iota 0 (order Q) & x i != 0,
      forall m q i, i \in free Q -> reaction (zero_pencil z (Lambda2 m q)) lambda2 x i = 0 &
      forall i, i \in slip Q -> pair (x i) (split_row lambda2 mu x i)].
Proof.
move=> sat; have same := variables_of_conditions sat.
have splits : split x := split_variables v.
have sat_x : conditions_9z z lambda2 mu (zero_motion x).
  by apply: (conditions_9z_same wf _ sat) => d d_in; rewrite same.
have l2 := L2_gt0; have [[d d_in vd] _ free slips zeros] := sat_x; split.
- have : has (fun i => x i != 0) (iota 0 (order Q)).
    apply: contraNT vd => /hasPn none; rewrite /zero_motion /table_motion nth_table //.
    rewrite /row_value big_seq big1 // => c c_in.
    have : (c.1 < nf + ns + 3 * nz)%N by apply: columns_small c_in.
    move=> small; have := none c.1; rewrite mem_iota small negbK => /(_ isT)/eqP->.
    by rewrite mulr0.
  by case/hasP=> i i_in xi; exists i.
- move=> m q i; rewrite mem_iota add0n /= => lt_i; rewrite zero_free_reaction // free //.
  exact: mem_nth.
move=> i /zero_slip_cases[[j lt_j ->]|[j lt_j cases]].
  have [_ + + xy] := slips _ lt_j; rewrite slip_split_row // => rate cone_le.
  move: rate xy; rewrite zero_slip_rate // oppr_le0 pmulr_rge0 // => x0 xy.
  split=> //; first by rewrite oppr_ge0.
  apply: (mulfI (lt0r_neq0 l2)); rewrite mulr0 -xy.
  by move: (cone _ _ _ _ _) (x _) => *; ring.
have [gap_pair right_pair left_pair] := zero_pairs lambda2 mu x lt_j.
have [r0 l0 rl] := splits j lt_j; have line := zeros _ lt_j.
have [vN wN vw _ _] := line; move: line; rewrite /= half_rates // => line.
have [||| first second] := split_pairs _ _ _ line.
- by rewrite pmulr_rge0.
- by rewrite pmulr_rge0.
- by rewrite mulrACA rl mulr0.
case: cases => ->; [apply/gap_pair | exact/right_pair | exact/left_pair].
by split; rewrite ?oppr_ge0 // mulrNN.
Qed.

Theorem zero_pencil_solution t v : satisfies_9z z u t v ->
  solution Q t (zero_variables_of v).
Proof.
case=> t0 /zero_parts_solution[nonzero rows_f rows_s]; split=> //.
  move=> i i_free; move: (i_free); rewrite mem_iota => lt_i.
  by rewrite zero_free_reaction // -(rows_f 0%Z 1%Z i i_free) zero_free_reaction.
move=> i i_slip; rewrite reaction_at_unknown //.
exact/(pair_right _ _ (row_factor_gt0 R wf_s))/rows_s.
Qed.

Lemma no_variables v : (forall d, d \in all_dofs -> v d = 0) ->
  forall i, (i < nf + ns + 3 * nz)%N -> zero_variables_of v i = 0.
Proof.
move=> zero i lt_i; rewrite /zero_variables_of.
have [lt_s|ge_s] := ltnP i (nf + ns).
  rewrite /variables_of; have [lt_f|ge_f] := ltnP i nf.
    by rewrite zero ?mul0r // (moving_dof_in wf_s) // mem_cat mem_nth.
  have lt_j : (i - nf < ns)%N by rewrite ltn_subLR.
  have [first second] := slip_dofs wf lt_j.
  by rewrite /slip_rate /along !zero // !mulr0 addr0 mulr0 mul0r oppr0.
have lt_j : ((i - (nf + ns)) %/ 3 < nz)%N by rewrite ltn_divLR // mulnC ltn_subLR.
have [first second] := zero_particle_dofs wf lt_j.
rewrite /along !zero // !mulr0 addr0 mul0r oppr0 ltxx.
by case: (_ %% 3)%N => [|[|[|k]]] //=; rewrite nth_nil.
Qed.

Theorem zero_variables_of_motion x i : split x -> (i < nf + ns + 3 * nz)%N ->
  zero_variables_of (zero_motion x) i = x i.
Proof.
move=> splits lt_i; have l2 := L2_gt0; have l_nz := lt0r_neq0 l2.
have [lt_s|ge_s] := ltnP i (nf + ns).
  rewrite /zero_variables_of lt_s -[RHS](variables_of_motion wf_s x); last by rewrite mem_iota.
  rewrite /variables_of; have [lt_f|ge_f] := ltnP i nf.
    by rewrite zero_motion_moving // mem_cat mem_nth.
  have lt_j : (i - nf < ns)%N by rewrite ltn_subLR.
  by rewrite /slip_rate along_moving.
have i_slip : i \in slip Q.
  by rewrite mem_filter !mem_iota !add0n lt_i andbT -leqNgt (leq_trans (leq_addr _ _) ge_s).
case: (zero_slip_cases i_slip) => [[j lt_j eq]|[j lt_j cases]].
  by move: ge_s; rewrite eq leq_add2l leqNgt lt_j.
have [gapE rightE leftE] := variables_at (zero_motion x) lt_j; have [r0 l0 rl] := splits j lt_j.
have rateE : along (tangent (zero_particle z j)) (zero_particle z j) (zero_motion x) / L ^+ 2 =
    x (right z j) - x (left z j).
  by rewrite half_rates // -mulrBr mulrAC divff // mul1r.
case: cases => ->.
- by rewrite gapE gap_rate // mulNr opprK mulrAC divff // mul1r.
- rewrite rightE rateE subr_gt0; case: ltP => [lt|le].
    move/eqP: rl; rewrite mulf_eq0 (gt_eqF (le_lt_trans l0 lt)) /= => /eqP->.
    by rewrite subr0.
  move/eqP: rl; rewrite mulf_eq0 => /orP[]/eqP zero; first by rewrite zero.
  by apply/eqP; rewrite eq_sym eq_le r0 andbT -[X in _ <= X]zero.
rewrite leftE rateE subr_lt0; case: ltP => [lt|le].
  move/eqP: rl; rewrite mulf_eq0 (gt_eqF (le_lt_trans r0 lt)) orbF => /eqP->.
  by rewrite sub0r opprK.
move/eqP: rl; rewrite mulf_eq0 => /orP[]/eqP zero; last by rewrite zero.
by apply/eqP; rewrite eq_sym eq_le l0 andbT -[X in _ <= X]zero.
Qed.

Theorem zero_parts_motion lambda2 mu x :
  (exists2 i, i \in iota 0 (order Q) & x i != 0) ->
  (forall i, i \in free Q -> reaction (part_plain z) lambda2 x i = 0) ->
  (forall i, i \in slip Q -> pair (x i) (split_row lambda2 mu x i)) ->
  split x -> conditions_9z z lambda2 mu (zero_motion x).
Proof.
case=> i0 i0_in xi0 rows_f rows_s splits; have l2 := L2_gt0.
split.
- suff : has (fun d => zero_motion x d != 0) all_dofs by case/hasP=> d d_in vd; exists d.
  apply: contraNT xi0 => /hasPn none; rewrite -(zero_variables_of_motion splits); last first.
    by move: i0_in; rewrite mem_iota.
  apply/eqP/no_variables; last by move: i0_in; rewrite mem_iota.
  by move=> d /none; rewrite negbK => /eqP.
- exact: zero_motion_rest.
- move=> d /(nthP 0%N)[k lt_k <-]; rewrite -(zero_free_reaction (Lambda2 0 1)) // rows_f //.
  by rewrite mem_iota.
- move=> j lt_j p; have [x0 + +] := rows_s _ (slip_in_zero_pencil lt_j).
  rewrite slip_split_row // -/p zero_slip_rate // oppr_le0 oppr_ge0 => y0 xy.
  rewrite along_moving // (normal_motion wf_s) // pmulr_rge0 //; split=> //.
  rewrite -[RHS](mulr0 (L ^+ 2)) -xy.
  by move: (cone _ _ _ _ _) (x _) => *; ring.
move=> j lt_j p w'; have [gap_pair right_pair left_pair] := zero_pairs lambda2 mu x lt_j.
apply/zero_split; exists (L ^+ 2 * x (right z j)), (L ^+ 2 * x (left z j)).
split; first exact: half_rates.
- apply/gap_pair; apply: rows_s; rewrite -[gap z j]addn0; exact: three_in_zero_pencil.
- apply/right_pair; apply: rows_s; rewrite -[right z j]addn1; exact: three_in_zero_pencil.
by apply/left_pair; apply: rows_s; rewrite -[left z j]addn2; exact: three_in_zero_pencil.
Qed.

Theorem zero_pencil_motion t x : solution Q t x -> split x -> satisfies_9z z u t (zero_motion x).
Proof.
case=> t0 nonzero rows_f rows_s splits; split=> //; apply: zero_parts_motion => // i.
  move=> i_free; rewrite -(rows_f i i_free); move: i_free; rewrite mem_iota => lt_i.
  by rewrite !zero_free_reaction.
move=> i_slip; have := rows_s i i_slip; rewrite reaction_at_unknown //.
by move/(pair_right _ _ (row_factor_gt0 R wf_s)).
Qed.

(* Regions and the halves. *)
Section Regions.

Variables (r : region) (x : nat -> R).
Hypothesis ag : agrees (size (slip Q)) r (slip_of Q x).

Lemma half_agrees j i : (j < nz)%N -> i = right z j \/ i = left z j ->
  match half_state z r i with Open => True | Resting => x i = 0 | Moving => 0 < x i end.
Proof.
move=> lt_j half; have [ge_i lt_i] : (nf <= i)%N /\ (i - nf < slip_number z)%N.
  by case: half => ->; rewrite /slip_number /right /left /gap; move: lt_j; clear; lia.
have := @ag (i - nf)%N; rewrite size_slips => /(_ lt_i).
by rewrite /slip_of zero_slips nth_iota // subnKC.
Qed.

Lemma apart_split : halves_apart z r -> (forall i, i \in slip Q -> 0 <= x i) -> split x.
Proof.
move=> /allP apart x0 j lt_j; split.
- by apply: x0; rewrite -[right z j]addn1; apply: three_in_zero_pencil.
- by apply: x0; rewrite -[left z j]addn2; apply: three_in_zero_pencil.
have j_in : j \in iota 0 nz by rewrite mem_iota.
move: (apart j j_in) (half_agrees lt_j (or_introl erefl)) (half_agrees lt_j (or_intror erefl)).
case: (half_state z r (right z j)) => /= [||]; last 1 first.
- by case: (half_state z r (left z j)) => //= _ _ ->; rewrite mulr0.
- by case: (half_state z r (left z j)) => //= _ _ ->; rewrite mulr0.
by move=> _ -> _; rewrite mul0r.
Qed.

Lemma both_not_split : both_halves z r -> split x -> False.
Proof.
case/hasP=> j; rewrite mem_iota add0n /= => lt_j moving splits.
move: moving (half_agrees lt_j (or_introl erefl)) (half_agrees lt_j (or_intror erefl)).
case: (half_state z r (right z j)) => //; case: (half_state z r (left z j)) => // _ pos pos'.
by have [_ _ /eqP] := splits j lt_j; rewrite mulf_eq0 !gt_eqF.
Qed.

End Regions.

(* Multiples. *)
Lemma zero_variables_scaled v v' f i : 0 < f ->
  (forall d, d \in all_dofs -> v' d = f * v d) -> (i < nf + ns + 3 * nz)%N ->
  zero_variables_of v' i = f * zero_variables_of v i.
Proof.
move=> f0 scaled lt_i; rewrite /zero_variables_of; have [lt_s|ge_s] := ltnP i (nf + ns).
  by apply: (variables_scaled wf_s scaled); rewrite mem_iota.
have lt_j : ((i - (nf + ns)) %/ 3 < nz)%N by rewrite ltn_divLR // mulnC ltn_subLR.
have [first second] := zero_particle_dofs wf lt_j.
have along_scaled e : along e (zero_particle z ((i - (nf + ns)) %/ 3)) v' =
    f * along e (zero_particle z ((i - (nf + ns)) %/ 3)) v.
  by rewrite /along !scaled //; move: (toR _) (toR _) (v _) (v _) => *; ring.
rewrite !along_scaled -!mulrA pmulr_rgt0 // pmulr_rlt0 //.
case: (_ %% 3)%N => [|[|[|k]]] /=; rewrite ?nth_nil ?mulr0 ?mulrN //; case: ifP => //.
- by rewrite mulr0.
- by rewrite mulrN.
by rewrite mulr0.
Qed.

Lemma zero_motion_scaled x x' f : (forall i, (i < nf + ns + 3 * nz)%N -> x' i = f * x i) ->
  forall d, d \in all_dofs -> zero_motion x' d = f * zero_motion x d.
Proof.
move=> scaled d d_in; rewrite /zero_motion /table_motion nth_table // /row_value mulr_sumr.
rewrite big_seq [RHS]big_seq.
by apply: eq_bigr => c c_in; rewrite scaled ?(columns_small c_in) // mulrCA.
Qed.

End Real.
