(* Enclosed claims about systems with particles in contact with zero reaction (z).

   A claim names a support among the slip particles and the variables gap, right and left of the z
   particles (ZeroReaction.v), and an interval of values.  Of right and left of a particle at most
   one is in the support, and one of them is if the gap is.  It is a claim about the pencil of
   ZeroPencil.v (EnclosedClaim.v), but for the half at rest of a particle that opens
   ([resting_halves]).  Its row is 0 at the solution, and not positive: where n'w = 0 and the row of
   the other half is 0, t'w is 0.  So in the pencil of the claim, [support_pencil], this half has
   another row, that has the value of a variable in the support and is positive.

   Theorem [zero_enclosed_sound]: if the claim is checked, then for some t in the interval there is
   a motion with (9), with this support, and with y = 0 off the support at the resting halves only.
   All motions that satisfy (9) at a value of the interval and have this support have this t and are
   its positive multiples.

   Pages: spec/certificates.md, 5.5; spec/zero-reaction.md, Z.3.
   Rust: crates/check/src/enclosed_solution.rs. *)

From Mceip Require Import Base Integers Sums Tree Bounded Pencil EnclosedClaim System ZeroReaction
  ZeroPencil.

Section Checker.

Local Open Scope Z_scope.

Variables (z : zero_system) (u : unknown) (support : seq nat).

Notation nz := (size (zero_particles z)).
Notation Q := (zero_pencil z u).

(* Right and left do not both move, and one of them does if the gap opens. *)
Definition one_half j :=
  ~~ ((right z j \in support) && (left z j \in support)) &&
  ((gap z j \in support) ==> (right z j \in support) || (left z j \in support)).

(* The half at rest of each z particle that opens. *)
Definition resting_halves :=
  [seq left z j | j <- iota 0 nz & (gap z j \in support) && (right z j \in support)] ++
  [seq right z j | j <- iota 0 nz & (gap z j \in support) && (left z j \in support)].

Definition support_pencil :=
  let given b row i := if i \in resting_halves then b else row Q i in
  Pencil (order Q) [seq given [:: (head 0%N support, 1)] row_a i | i <- iota 0 (order Q)]
    [seq given [::] row_b i | i <- iota 0 (order Q)] (free Q).

End Checker.

Definition check_zero_enclosed z u c := let support := box_support c in
  [&& zero_wellformed z u, zero_variables z support,
      all (one_half z support) (iota 0 (size (zero_particles z))) &
      check_enclosed_claim (support_pencil z u support) c].

Section Statements.

Variables (R : rcfType) (z : zero_system).

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

Lemma slip_not_resting z support j : (j < size (particles (without_zero z)))%N ->
  ((free_number (without_zero z) + j)%N \in resting_halves z support) = false.
Proof.
move=> lt_j; apply/negbTE; rewrite mem_cat negb_or; apply/andP.
by split; apply/negP => /mapP[i _]; rewrite /left /right /gap; lia.
Qed.

Section Sound.

Variables (R : rcfType) (z : zero_system) (u : unknown) (support : seq nat).
Hypothesis wf : zero_wellformed z u.

Implicit Types (t : R) (v x : nat -> R).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation Q := (zero_pencil z u).
Notation Q' := (support_pencil z u support).
Notation rest := (resting_halves z support).

Let wf_s : system_wellformed s u := wf_system wf.
Let l2 : 0 < toR (unit_length s) ^+ 2 :> R := L2_gt0 R wf.
Let f0 : 0 < row_factor R u := row_factor_gt0 R wf_s.

Notation one_at_most j := (~~ ((right z j \in support) && (left z j \in support))).

(* Which variables of a motion move. *)
Lemma moving_variables v : (forall j, (j < nz)%N -> one_at_most j) -> moves_on z support v ->
  forall i, i \in slip Q -> (i \in support -> 0 < zero_variables_of z v i) /\
  (i \notin support -> zero_variables_of z v i = 0).
Proof.
move=> apart [slips zeros] i /zero_slip_cases[[j lt_j ->]|[j lt_j cases]].
  have := slips j lt_j; rewrite /zero_variables_of ltn_add2l lt_j /variables_of ltnNge leq_addr /=.
  rewrite addKn; case: (_ \in support) => /= rate; split=> // _; last by rewrite rate mul0r oppr0.
  by rewrite oppr_gt0 pmulr_llt0 ?invr_gt0.
have [opening sliding] := zeros j lt_j; have [gapE rightE leftE] := variables_at v lt_j.
have [c c0 normalE] := along_normal wf v lt_j; rewrite normalE in opening.
have both := apart j lt_j.
case: cases => ->; rewrite ?gapE ?rightE ?leftE.
- move: opening; case: (_ \in support) => /= [|/eqP].
    by rewrite pmulr_rlt0 // => neg; split; rewrite // oppr_gt0 pmulr_llt0 ?invr_gt0.
  by rewrite mulf_eq0 gt_eqF //= => /eqP->; split; rewrite // mul0r oppr0.
- rewrite pmulr_lgt0 ?invr_gt0 //; move: both sliding; case: (right z j \in support) => /=.
    by move=> _ pos; rewrite pos; split=> // _; rewrite divr_gt0.
  case: (left z j \in support) => /= _; last by move=> ->; rewrite ltxx; split.
  by move=> neg; rewrite (lt_gtF neg); split.
rewrite pmulr_llt0 ?invr_gt0 //; move: both sliding; case: (right z j \in support) => /=.
  by move=> /negbTE-> pos; rewrite (lt_gtF pos); split.
case: (left z j \in support) => /= _; last by move=> ->; rewrite ltxx; split.
by move=> neg; rewrite neg; split=> // _; rewrite oppr_gt0 pmulr_llt0 ?invr_gt0.
Qed.

Lemma support_moves biactive t v :
  has_support s u support biactive t v -> has_zero_support z u support biactive t v ->
  forall i, i \in slip Q -> (i \in support -> 0 < zero_variables_of z v i) /\
  (i \notin support -> zero_variables_of z v i = 0).
Proof.
move=> slips zeros; apply: moving_variables.
  by move=> j lt_j; have [_ _ + _ _] := zeros j lt_j; case: (right z j \in _) => //= -[].
split=> j lt_j p.
  by have [pos zero _ _] := slips j lt_j; case: ifPn => [/zero|/negbNE/pos].
have [opening _ sliding _ _] := zeros j lt_j; split=> //.
by move: sliding; case: (_ \in support) => /= [[]|]; case: (_ \in support).
Qed.

Hypothesis halves : all (one_half z support) (iota 0 nz).

Lemma one_half_at j : (j < nz)%N -> one_at_most j.
Proof.
by move=> lt_j; have /andP[] : one_half z support j by apply: (allP halves); rewrite mem_iota.
Qed.

(* The rows of the pencil of the claim. *)
Hypothesis in_slip : forall i, i \in support -> i \in slip Q.

Lemma head_in i : i \in rest -> head 0%N support \in support.
Proof.
rewrite mem_cat => i_in; case: support i_in => [|h l] /=; last by rewrite inE eqxx.
by case/orP=> /mapP[j]; rewrite mem_filter.
Qed.

Lemma support_reaction t x i : i \in iota 0 (order Q) ->
  reaction Q' t x i = if i \in rest then x (head 0%N support) else reaction Q t x i.
Proof.
rewrite mem_iota add0n => /= lt_i; rewrite /reaction /a_entry /b_entry /row_a /row_b /=.
rewrite !(nth_map 0%N) ?size_iota // !nth_iota // !add0n; case: ifP => // i_rest.
have h_in := slip_indices (in_slip (head_in i_rest)).
rewrite (bigD1_seq (head 0%N support)) ?iota_uniq //= eqxx big1 ?addr0.
  by rewrite toR1 toR0 mulr0 addr0 mul1r.
by move=> j /negbTE; rewrite eq_sym => ->; rewrite toR0 mulr0 addr0 mul0r.
Qed.

Lemma rest_slip i : i \in rest -> i \in slip Q /\ i \notin support.
Proof.
rewrite mem_cat => /orP[]/mapP[j]; rewrite mem_filter mem_iota => /andP[/andP[_ other] lt_j] ->.
  split; first by rewrite -[left z j]addn2; apply: three_in_zero_pencil.
  by have both := one_half_at lt_j; rewrite other in both.
split; first by rewrite -[right z j]addn1; apply: three_in_zero_pencil.
by have both := one_half_at lt_j; rewrite other andbT in both.
Qed.

Lemma free_not_rest i : i \in free Q -> (i \in rest) = false.
Proof.
by move=> i_free; apply/negbTE/negP => /rest_slip[]; rewrite mem_filter i_free.
Qed.

(* A solution of the pencil of the claim. *)
Section Found.

Variables (t : R) (x : nat -> R).
Hypothesis sol : solution Q' t x.
Hypothesis on : forall i, i \in slip Q -> i \in support -> 0 < x i.
Hypothesis off : forall i, i \in slip Q -> i \notin support -> x i = 0 /\ 0 < reaction Q' t x i.

Notation p j := (zero_particle z j).
Notation w := (force s (lambda2_of u t) (zero_motion z x)).

Lemma row_on_support i : i \in support -> reaction Q t x i = 0.
Proof.
move=> i_in; have i_slip := in_slip i_in; have [_ _ _ rows] := sol.
have [_ _ /eqP] := rows i i_slip; rewrite mulf_eq0 gt_eqF ?on //=.
rewrite support_reaction ?slip_indices //; case: ifP => [/rest_slip[_]|_ /eqP//].
by rewrite i_in.
Qed.

Lemma row_at_rest i : i \in rest -> reaction Q t x i = 0.
Proof.
rewrite mem_cat => /orP[]/mapP[j]; rewrite mem_filter mem_iota add0n => /andP[/andP[g h] lt_j] ->;
  have [gapE rightE leftE] := zero_reactions wf t x lt_j;
  have [c _ normalE] := along_normal wf w lt_j;
  move: (row_on_support g) (row_on_support h); rewrite gapE rightE leftE normalE;
  move=> /eqP; rewrite oppr_eq0 mulf_eq0 gt_eqF //= => /eqP-> /eqP;
  by rewrite !mulr0 !subr0 mulf_eq0 gt_eqF //= ?oppr_eq0 => /eqP->; rewrite ?oppr0 mulr0.
Qed.

Lemma row_sign_at i : i \in slip Q -> row_sign i support rest (- reaction Q t x i).
Proof.
move=> i_slip; rewrite /row_sign.
have [/row_on_support->|out] := boolP (i \in support); first exact: oppr0.
have [/row_at_rest->|not_rest] := boolP (i \in rest); first exact: oppr0.
have [_] := off i_slip out; rewrite support_reaction ?slip_indices // (negbTE not_rest).
by rewrite oppr_lt0.
Qed.

Lemma found_solution : solution Q t x.
Proof.
have [t0 nonzero rows_f rows_s] := sol; split=> // i Hi.
  have := rows_f i Hi; rewrite support_reaction ?free_not_rest //.
  exact: (free_indices (zero_pencil_wellformed z u)).
have [/row_at_rest->|not_rest] := boolP (i \in rest).
  by have [x0 _ _] := rows_s i Hi; rewrite mulr0.
by have := rows_s i Hi; rewrite support_reaction ?slip_indices // (negbTE not_rest).
Qed.

Lemma found_split : split z x.
Proof.
move=> j lt_j; have [_ _ _ rows] := found_solution.
have r_in : right z j \in slip Q by rewrite -[right z j]addn1; apply: three_in_zero_pencil.
have l_in : left z j \in slip Q by rewrite -[left z j]addn2; apply: three_in_zero_pencil.
have [r0 _ _] := rows _ r_in; have [l0 _ _] := rows _ l_in; split=> //.
have both := one_half_at lt_j.
by move: both; rewrite negb_and => /orP[/(off r_in)|/(off l_in)] [-> _]; rewrite ?mul0r ?mulr0.
Qed.

Lemma found_support : has_support s u support rest t (zero_motion z x).
Proof.
move=> j lt_j q; have i_slip := slip_in_zero_pencil u lt_j.
have := row_sign_at i_slip; rewrite /row_sign slip_not_resting // orbF.
rewrite (zero_slip_reaction wf) // opprK (zero_slip_rate wf) // -/q => sign; split=> //.
- by move=> /(on i_slip) x0; rewrite oppr_lt0 pmulr_rgt0.
- by case/(off i_slip)=> -> _; rewrite mulr0 oppr0.
by move=> out _; move: sign; rewrite (negbTE out) pmulr_rlt0.
Qed.

Lemma found_zero_support : has_zero_support z u support rest t (zero_motion z x).
Proof.
move=> j lt_j q w' v_N v_T w_N w_T mu.
have at_k k := three_in_zero_pencil u lt_j (k := k).
have g_in : gap z j \in slip Q by rewrite -[gap z j]addn0; apply: at_k.
have r_in : right z j \in slip Q by rewrite -[right z j]addn1; apply: at_k.
have l_in : left z j \in slip Q by rewrite -[left z j]addn2; apply: at_k.
have [gapE rightE leftE] := zero_reactions wf t x lt_j.
have both := one_half_at lt_j.
have [c c0 v_normal] := along_normal wf (zero_motion z x) lt_j.
have [c' c'0 w_normal] := along_normal wf w' lt_j.
split.
- rewrite /v_N v_normal (gap_rate wf) // mulrN.
  case: ifPn => [/(off g_in)[-> _]|/negbNE/(on g_in) x0]; first by rewrite !mulr0 oppr0.
  by rewrite oppr_lt0 mulr_gt0 // mulr_gt0.
- have := row_sign_at g_in; rewrite gapE opprK => /(row_sign_factor f0).
  rewrite /w_N w_normal /row_sign; case: ifP => _ => [->|]; first exact: mulr0.
  by rewrite pmulr_rlt0.
- rewrite /v_T (half_rates wf) //; move: both.
  have [r|/(off r_in)[-> _]] := boolP (right z j \in support).
    move=> /= l; split=> //; have [-> _] := off l_in l.
    by rewrite mulr0 subr0 pmulr_rgt0 // on.
  rewrite mulr0 sub0r => _; case: ifPn => [/(off l_in)[-> _]|/negbNE/(on l_in) x0].
    by rewrite mulr0 oppr0.
  by rewrite oppr_lt0 pmulr_rgt0.
- by have := row_sign_at r_in; rewrite rightE -mulrN opprB addrC => /(row_sign_factor f0).
by have := row_sign_at l_in; rewrite leftE -mulrN opprD !opprK => /(row_sign_factor f0).
Qed.

End Found.

(* Any motion with this support solves it. *)
Lemma motion_solution t v : satisfies_9z z u t v -> moves_on z support v ->
  solution Q' t (zero_variables_of z v).
Proof.
move=> sat moves; have [t0 nonzero rows_f rows_s] := zero_pencil_solution wf sat.
split=> // i Hi.
  rewrite support_reaction ?free_not_rest ?rows_f //.
  exact: (free_indices (zero_pencil_wellformed z u)).
rewrite support_reaction ?slip_indices //; case: ifP => [i_rest|_]; last exact: rows_s.
have [_ out] := rest_slip i_rest; have [_ zero] := moving_variables one_half_at moves Hi.
by rewrite zero // mul0r; split=> //; have [] := rows_s _ (in_slip (head_in i_rest)).
Qed.

End Sound.

Theorem zero_enclosed_sound (R : rcfType) z u c (support := box_support c) :
  check_zero_enclosed z u c -> exists (t : R) v,
  [/\ between t (box_from c) (box_to c), satisfies_9z z u t v,
      has_support (without_zero z) u support (resting_halves z support) t v,
      has_zero_support z u support (resting_halves z support) t v &
      forall t' v', satisfies_9z z u t' v' -> between t' (box_from c) (box_to c) ->
        moves_on z support v' -> t' = t /\ same_motion (without_zero z) v v'].
Proof.
case/and4P=> wf in_range halves claim.
have in_slip i : i \in support -> i \in slip (zero_pencil z u).
  move/allP: in_range => in_range /in_range/andP[ge_i lt_i].
  by rewrite mem_filter !mem_iota !add0n -leqNgt ge_i.
have [t [x [bt sol on off uniq]]] := enclosed_claim_sound R claim.
exists t, (zero_motion z x); split=> //.
- apply: (zero_pencil_motion wf); first exact: (found_solution wf halves in_slip sol on).
  exact: (found_split wf halves in_slip sol on off).
- exact: (found_support wf halves in_slip sol on off).
- exact: (found_zero_support wf halves in_slip sol on off).
move=> t' v' sat bt' moves; have signs := moving_variables wf (one_half_at halves) moves.
have [||-> [f f_gt0 scaled]] := uniq _ _ (motion_solution wf halves in_slip sat moves) bt'.
- by move=> i /signs[].
- by move=> i /signs[].
split=> //; exists f => // d d_in; rewrite -(zero_motion_of_variables wf sat d_in).
by apply: zero_motion_scaled d_in => i lt_i; apply: scaled; rewrite mem_iota.
Qed.
