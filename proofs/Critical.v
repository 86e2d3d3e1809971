(* No solution below a friction.

   For a mechanical system, t = lambda^2 and mu >= 0 the rows (11) of the slip particles are affine
   in mu: with w = (K + t M) v they are q (-S t'w) + m (-n'w), up to the positive factor q, for
   mu = m/q.  [pencil_at] is the pencil for (m, q); its values at (0, 1) and (1, 0) are the *parts*.

   The checker gets a system, two bounds, a witness for the elimination of the free variables, and a
   tree of boxes (Boxes.v).  Both parts are condensed with the same approximation W and with the
   same factors of the rows.  A leaf is

     BoxFarkas w           w excludes the solutions of the box, by the condensed parts;
     BoxDefinite sign f f' a form has one sign on the box, by the condensed parts;
     BoxRegular w          the matrix of a decided box has no null vector, by the condensed parts
                           (Regular.v);
     BoxWhole w w'         a form has one sign, for the whole pencils at both ends of the interval of mu.

   Without the witness there may be leaves BoxWhole only.

   Theorem [critical_absent]: if the check succeeds, then for every mu in [from, bound] and every
   t >= 0 no motion satisfies the conditions (9) with lambda^2 = t and mu.

   Page: spec/certificates.md, 5.18.
   Rust: crates/check/src/critical.rs, cover/critical.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Farkas Covered Definite Cover Condensation.
From Mceip Require Import Pencil Whole Complete System Boxes Regular.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Inductive critical_leaf :=
  | BoxFarkas of seq Z
  | BoxDefinite of bool & factor * factor & factor * factor
  | BoxRegular of regular
  | BoxWhole of whole & whole.

Section Checker.

Variable s : system.

Definition pencil_at (e : point) := pencil_of s (Lambda2 e.1 e.2).

Definition part_plain := pencil_at (0, 1)%Z.
Definition part_friction := pencil_at (1, 0)%Z.

(* The witness for the other part: the same W, another V. *)
Definition with_left (w : elimination) (other : matrix * matrix) : elimination :=
  Elimination (row_scale w) (unit_of w) (right_w w) other.1 other.2 (bound_c w) (bound_d w)
    (factor_scale w) (stiffness_factor w).

Variable w : option (elimination * (matrix * matrix)).

Definition condensed_parts : option (enclosed * enclosed) :=
  omap (fun wl => (condensed (blocks_of part_plain) wl.1,
                   condensed (blocks_of part_friction) (with_left wl.1 wl.2))) w.

Definition parts_eliminated :=
  if w is Some (w0, other) then
    [&& free_rows_constant part_plain, free_rows_constant part_friction,
        check_elimination (blocks_of part_plain) w0 &
        check_elimination (blocks_of part_friction) (with_left w0 other)]
  else true.

(* Weights of slip rows are the same in both; those of free rows need not be. *)
Definition same_weights (a b : whole) :=
  (whole_negative a == whole_negative b) &&
  all (fun i => nth 1 (whole_weights a) i =? nth 1 (whole_weights b) i)%Z (slip part_plain).

Definition check_critical_leaf (parts : option (enclosed * enclosed)) (r : region)
    (low high : point) (l : critical_leaf) :=
  match l, parts with
  | BoxFarkas v, Some (P0, P1) => box_farkas (mixed low P0 P1) (mixed high P0 P1) r v
  | BoxDefinite negative f f', Some (P0, P1) =>
      box_definite (mixed low P0 P1) (mixed high P0 P1) r negative f f'
  | BoxRegular v, Some (P0, P1) => box_regular (mixed low P0 P1) (mixed high P0 P1) r v
  | BoxWhole a b, _ =>
      [&& same_weights a b, check_whole (pencil_at low) r a & check_whole (pencil_at high) r b]
  | _, None => false
  end.

Definition check_critical (tr : box_tree critical_leaf) (from bound : point) :=
  let parts := condensed_parts in
  [&& system_wellformed s (Lambda2 0 1), parts_eliminated &
      check_boxes (size (slip part_plain)) (check_critical_leaf parts) tr (window zero infinity)
        from bound].

End Checker.

Section Sound.

Lemma pencil_wellformed s e : wellformed (pencil_at s e).
Proof.
rewrite /wellformed /= iota_uniq; apply/allP => i; rewrite mem_iota add0n => lt_i.
exact: leq_trans lt_i (leq_addr _ _).
Qed.

Variables (R : rcfType) (s : system).
Hypothesis wf : system_wellformed s (Lambda2 0 1).

Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation Q0 := (part_plain s).
Notation Q1 := (part_friction s).

(* The kinematics of a motion do not depend on K and M: those of the system without them. *)
Definition without_forces :=
  System (dofs s) [::] [::] (free_dofs s) (particles s) (unit_length s).

Lemma motion_of_variables (t mu : R) v : conditions_9 s t mu v ->
  forall d, d \in iota 0 (dofs s) -> motion s (variables_of s v) d = v d.
Proof.
case=> nonzero at_rest _ slips.
have wf0 : system_wellformed without_forces Mu.
  by case/and5P: wf => u1 r1 p1 _ /andP[l1 _]; apply/and5P; split=> //; rewrite andbT.
have no_force d : force without_forces 0 v d = 0.
  rewrite /force sum_zero // => j _.
  by rewrite /k_entry /m_entry /k_row /m_row /= !nth_nil /= toR0 mulr0 addr0 mul0r.
apply: (system_onto (s := without_forces) (t := 0) wf0); split=> //; split=> // j lt_j p.
have [n0 rate _ _] := slips j lt_j.
by split=> //; rewrite /cone /along !no_force !mulr0 addr0 !mulr0 ?addr0 ?mul0r.
Qed.

Lemma conditions_9_ext (t mu : R) v v' : (forall d, d \in iota 0 (dofs s) -> v d = v' d) ->
  conditions_9 s t mu v -> conditions_9 s t mu v'.
Proof.
move=> same [[d Hd vd] at_rest rows_f rows_s].
have forceE' d' : force s t v d' = force s t v' d' by apply: sum_eq => j Hj; rewrite same.
split; first by exists d; rewrite -?same.
- by move=> d' Hd' out; rewrite -same // at_rest.
- by move=> d' /rows_f; rewrite forceE'.
move=> j lt_j; have := rows_s _ lt_j.
by rewrite /= /cone /slip_rate /along !forceE' !same ?(first_dof_in wf) ?(second_dof_in wf).
Qed.

Section Motion.

Variables (t mu : R) (x : nat -> R).
Hypothesis t0 : 0 <= t.
Hypothesis sat : conditions_9 s t mu (motion s x).

(* The two parts of a slip row, and y = plain + mu friction. *)
Definition plain_row j : R :=
  - (toR (sign_of (particle s j)) *
     along (tangent (particle s j)) (particle s j) (force s t (motion s x))).
Definition friction_row j : R :=
  - along (normal (particle s j)) (particle s j) (force s t (motion s x)).
Definition slip_reaction_at j := plain_row j + mu * friction_row j.

Lemma free_row_at e k : (k < nf)%N -> reaction (pencil_at s e) t x k = 0.
Proof.
move=> lt_k; have [_ _ rows_f _] := sat.
rewrite -(rows_f (nth 0%N (free_dofs s) k)) ?mem_nth // reactionE forceE.
rewrite /row_a /row_b /= !nth_cat !size_map lt_k !(nth_map 0%N) //.
by rewrite (k_product_columns wf) (m_product_columns wf).
Qed.

Lemma slip_row_at e j : (j < ns)%N ->
  reaction (pencil_at s e) t x (nf + j)%N = toR e.2 * plain_row j + toR e.1 * friction_row j.
Proof.
move=> lt_j; rewrite reactionE /plain_row /friction_row /along !forceE /row_a /row_b /=.
rewrite !nth_cat !size_map ltnNge leq_addr /= addKn.
rewrite !(nth_map (SlipParticle 0 0 (0, 0) (0, 0) 0)%Z) // -/(particle s j).
set p := particle s j; rewrite !sum_rows_along.
have [-> ->] := directionE R (- (e.2 * sign_of p)) (- e.1) p.
rewrite !(k_product_columns wf) !(m_product_columns wf) !toRN !toRM.
move: (k_product _ _ _) (k_product _ _ _) (m_product _ _ _) (m_product _ _ _) => k1 k2 m1 m2.
move: (toR (sign_of p)) (toR (tangent p).1) (toR (tangent p).2) => sg t1 t2.
move: (toR (normal p).1) (toR (normal p).2) (toR e.1) (toR e.2) => n1 n2 m q.
by ring.
Qed.

(* The rows of the parts give those of every pencil. *)
Lemma row_at e i : i \in slip Q0 ->
  reaction (pencil_at s e) t x i = toR e.2 * reaction Q0 t x i + toR e.1 * reaction Q1 t x i.
Proof.
case/slip_variable=> j lt_j ->; rewrite !slip_row_at //= toR0 toR1.
by move: (plain_row j) (friction_row j) (toR e.1) (toR e.2) => *; ring.
Qed.

Lemma slip_conditions i : i \in slip Q0 ->
  let y := reaction Q0 t x i + mu * reaction Q1 t x i in [/\ 0 <= x i, 0 <= y & x i * y = 0].
Proof.
case/slip_variable=> j lt_j -> y; have [_ _ _ /(_ j lt_j)] := sat.
set p := particle s j => -[_ rate c0 product].
have l2 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0 // (unit_length_gt0 _ wf).
have yE : y = - cone s t mu (motion s x) p.
  rewrite /y !slip_row_at //= toR0 toR1 /cone -/p /plain_row /friction_row -/p.
  by move: (along _ _ _) (along _ _ _) (toR (sign_of p)) => *; ring.
move: rate product; rewrite (slip_motion wf) // oppr_le0 pmulr_rge0 // => x0 product.
split=> //; first by rewrite yE oppr_ge0.
apply: (mulfI (lt0r_neq0 l2)); rewrite mulr0 -product yE.
by move: (cone _ _ _ _ _) (x _) (toR _) => *; ring.
Qed.

Lemma motion_variables : exists2 i, i \in iota 0 (order Q0) & x i != 0.
Proof. by have [nonzero _ _ _] := sat; apply/(motion_nonzero wf). Qed.

Lemma free_index i : i \in free Q0 -> (i < nf)%N.
Proof. by rewrite mem_iota. Qed.

(* A box of t and mu that holds the motion. *)
Section Box.

Variables (r : region) (low high : point).
Hypotheses (O : ordered (lower r) (upper r)) (Om : ordered low high).
Hypotheses (bt : between t (lower r) (upper r)) (bm : between mu low high).
Hypothesis ag : agrees (size (slip Q0)) r (slip_of Q0 x).
Notation wfQ := (pencil_wellformed s (0, 1)%Z).

Lemma whole_box_absent a b : same_weights s a b -> check_whole (pencil_at s low) r a ->
  check_whole (pencil_at s high) r b -> False.
Proof.
case/andP=> /eqP signs /allP weights checked_a checked_b.
have [f [g [f0 g0 [one val] [fg _]]]] := weights_of_ends Om bm.
have la := whole_image (Q := pencil_at s low) wfQ O checked_a bt ag motion_variables.
have hb := whole_image (Q := pencil_at s high) wfQ O checked_b bt ag motion_variables.
rewrite -signs in hb; have pos := combination_gt0 f0 g0 fg la hb; move: pos.
rewrite !(mulrCA _ (sign R _)) -mulrDr !mulr_sumr -big_split /= sum_zero ?mulr0 ?ltxx // => i Hi.
have [i_free|i_slip] := orP (free_or_slip (Q := Q0) Hi).
  by rewrite !free_row_at ?mulr0 ?addr0 //; apply: free_index.
have /Z.eqb_spec same := weights i i_slip.
have [_ _ xy] := slip_conditions i_slip.
rewrite (row_at low i_slip) (row_at high i_slip) /weight_of -same.
transitivity (toR (nth 1%Z (whole_weights a) i) *
  (x i * ((f * toR low.2 + g * toR high.2) * reaction Q0 t x i +
          (f * toR low.1 + g * toR high.1) * reaction Q1 t x i))).
  by move: (toR (nth _ _ _)) (x i) (reaction Q0 t x i) (reaction Q1 t x i) => *; ring.
by rewrite one val mul1r xy mulr0.
Qed.

Section Condensed.

Variables (w : elimination) (other : matrix * matrix).
Hypothesis eliminated : parts_eliminated s (Some (w, other)).

Notation w' := (with_left w other).
Notation D0 := (blocks_of Q0).
Notation D1 := (blocks_of Q1).
Notation P0 := (condensed D0 w).
Notation P1 := (condensed D1 w').
Notation A0 := (A_condensed R D0 w).
Notation B0 := (B_condensed R D0 w).
Notation A1 := (A_condensed R D1 w').
Notation B1 := (B_condensed R D1 w').
Notation xs := (slip_of Q0 x).

Lemma eliminated_parts :
  [/\ free_rows_constant Q0 /\ free_rows_constant Q1,
      stiffness_positive D0 w /\ shapes D0 w & stiffness_positive D1 w' /\ shapes D1 w'].
Proof. by case/and4P: eliminated => c0 c1 /andP[? ?] /andP[? ?]. Qed.

Lemma scale_ok i : i \in indices P0 -> 0 < scale_of R w i * toR (unit_of w) ^+ 2.
Proof.
have [_ [_ sh] _] := eliminated_parts => Hi.
by rewrite mulr_gt0 ?exprn_gt0 ?(scale_gt0 _ sh) ?(unit_gt0 _ sh).
Qed.

Lemma free_row_vanishes e k : k \in iota 0 (size (free Q0)) ->
  reaction (pencil_at s e) t x (nth 0%N (free Q0) k) = 0.
Proof.
rewrite mem_iota add0n /= => lt_k; apply: free_row_at.
by apply: free_index; apply: mem_nth.
Qed.

Lemma plain_free k : k \in iota 0 (size (free Q0)) -> free_of Q0 x k = free_part D0 xs k.
Proof.
have [[c0 _] [pos _] _] := eliminated_parts.
apply/(free_rows_vanish pos) : k => k Hk; rewrite -(reaction_free wfQ c0 t).
  exact: free_row_vanishes.
by rewrite mem_iota in Hk.
Qed.

Lemma friction_free k : k \in iota 0 (size (free Q1)) -> free_of Q1 x k = free_part D1 xs k.
Proof.
have [[_ c1] _ [pos _]] := eliminated_parts.
apply/(free_rows_vanish pos) : k => k Hk; rewrite -(reaction_free (Q := Q1) wfQ c1 t).
  exact: free_row_vanishes.
by rewrite mem_iota in Hk.
Qed.

Lemma plain_image i : i \in indices P0 -> image P0 A0 B0 t xs i =
  scale_of R w i * toR (unit_of w) ^+ 2 * reaction Q0 t x (nth 0%N (slip Q0) i).
Proof.
move=> Hi; rewrite (condensed_image (D := D0) w t plain_free) // -(reaction_slip wfQ) //.
by rewrite mem_iota in Hi.
Qed.

Lemma friction_image i : i \in indices P0 -> image P1 A1 B1 t xs i =
  scale_of R w i * toR (unit_of w) ^+ 2 * reaction Q1 t x (nth 0%N (slip Q0) i).
Proof.
move=> Hi; rewrite (condensed_image (D := D1) w' t friction_free) //.
rewrite -(reaction_slip (Q := Q1) wfQ) //.
by rewrite mem_iota in Hi.
Qed.

Lemma slip_nonzero : exists2 i, i \in indices P0 & xs i != 0.
Proof.
have [/hasP[i Hi xi]|/hasPn zero] := boolP (has (fun i => xs i != 0) (indices P0)).
  by exists i.
have {}zero i : i \in indices P0 -> xs i = 0 by move/zero; rewrite negbK => /eqP.
have [i Hi /eqP[]] := motion_variables.
case/orP: (free_or_slip (Q := Q0) Hi) => /(nthP 0%N)[k lt_k <-]; last first.
  by apply: zero; rewrite mem_iota.
rewrite -[LHS]/(free_of Q0 x k) plain_free ?mem_iota // /free_part sum_zero ?oppr0 // => j Hj.
by rewrite zero // mulr0.
Qed.

Notation A e := (fun i j => toR e.2 * A0 i j + toR e.1 * A1 i j).
Notation B e := (fun i j => toR e.2 * B0 i j + toR e.1 * B1 i j).

Lemma mixed_image e i : image (mixed e P0 P1) (A e) (B e) t xs i =
  toR e.2 * image P0 A0 B0 t xs i + toR e.1 * image P1 A1 B1 t xs i.
Proof.
rewrite /image !mulr_sumr -[in RHS]big_split; apply: eq_bigr => j _ /=.
by rewrite /T; move: (A0 i j) (A1 i j) (B0 i j) (B1 i j) (xs j) (toR e.1) (toR e.2) => *; ring.
Qed.

Lemma encloses_mixed e : 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  encloses (mixed e P0 P1) (A e) (B e).
Proof.
have [_ [p0 s0] [p1 s1]] := eliminated_parts => e1 e2.
by apply: mixed_encloses => //; apply: condensation_encloses.
Qed.

Lemma box_parts : exists a b, [/\ 0 <= a, 0 <= b, 0 < a \/ 0 < b &
  box_solution (mixed low P0 P1) (mixed high P0 P1) (A low) (B low) (A high) (B high) t a b xs].
Proof.
have [f [g [f0 g0 [one val] [fg _]]]] := weights_of_ends Om bm.
exists f, g; split=> //; split; first exact: slip_nonzero.
move=> i Hi; have lt_i : (i < size (slip Q0))%N by rewrite mem_iota in Hi.
have [x0 y0 xy] := slip_conditions (mem_nth 0%N lt_i); have c0 := scale_ok Hi.
suff -> : box_image (mixed low P0 P1) (mixed high P0 P1) (A low) (B low) (A high) (B high) t f g
            xs i = scale_of R w i * toR (unit_of w) ^+ 2 *
            (reaction Q0 t x (nth 0%N (slip Q0) i) + mu * reaction Q1 t x (nth 0%N (slip Q0) i)).
  split; [exact: x0 | by rewrite mulr_ge0 // ltW |].
  by rewrite mulrCA -[X in _ * (X * _)]/(x (nth 0%N (slip Q0) i)) xy mulr0.
rewrite /box_image !mixed_image plain_image // friction_image //.
rewrite -[X in X + mu * _]mul1r -one -val.
move: (reaction Q0 t x _) (reaction Q1 t x _) (scale_of R w i) (toR (unit_of w)) => *.
by ring.
Qed.

Lemma farkas_box_absent v : box_farkas (mixed low P0 P1) (mixed high P0 P1) r v -> False.
Proof.
have [a [b [a0 b0 ab sol]]] := box_parts; have [l1 l2 h1 h2] := ordered_ge0 R Om.
exact: (box_farkas_sound (encloses_mixed l1 l2) (encloses_mixed h1 h2) _ O bt ag a0 b0 ab sol).
Qed.

Lemma definite_box_absent negative f f' :
  box_definite (mixed low P0 P1) (mixed high P0 P1) r negative f f' -> False.
Proof.
have [a [b [a0 b0 ab sol]]] := box_parts; have [l1 l2 h1 h2] := ordered_ge0 R Om.
exact: (box_definite_sound (encloses_mixed l1 l2) (encloses_mixed h1 h2) _ O bt ag a0 b0 ab sol).
Qed.

Lemma regular_box_absent v : box_regular (mixed low P0 P1) (mixed high P0 P1) r v -> False.
Proof.
have [a [b [a0 b0 ab sol]]] := box_parts; have [l1 l2 h1 h2] := ordered_ge0 R Om.
exact: (box_regular_sound (encloses_mixed l1 l2) (encloses_mixed h1 h2) _ O bt ag a0 b0 ab sol).
Qed.

End Condensed.

Lemma critical_leaf_absent w l : parts_eliminated s w ->
  check_critical_leaf s (condensed_parts s w) r low high l -> False.
Proof.
case: l => [v|negative f f'|v|a b] /=; last by move=> _ /and3P[]; apply: whole_box_absent.
- by case: w => [[w other]|] //= eliminated; apply: farkas_box_absent.
- by case: w => [[w other]|] //= eliminated; apply: definite_box_absent.
by case: w => [[w other]|] //= eliminated; apply: regular_box_absent.
Qed.

End Box.

End Motion.

End Sound.

Theorem critical_absent (R : rcfType) s w tr from bound : check_critical s w tr from bound ->
  forall (t mu : R) v, 0 <= t -> between mu from bound -> conditions_9 s t mu v -> False.
Proof.
case/and3P=> wf eliminated boxes t mu v t0 bm sat; pose x := variables_of s v.
have {}sat : conditions_9 s t mu (motion s x).
  by apply: (conditions_9_ext wf) (sat) => d Hd; rewrite (motion_of_variables wf sat).
have x0 j : (j < size (slip (part_plain s)))%N -> 0 <= slip_of (part_plain s) x j.
  by move=> lt_j; have [] := slip_conditions wf sat (mem_nth 0%N lt_j).
have start : in_region (size (slip (part_plain s))) t (slip_of (part_plain s) x)
    (window zero infinity).
  split; last by move=> i _; rewrite /state_of nth_nil.
  by rewrite /between /= toR0 toR1 mulr1 mulr0 ler01.
have [r [low [high [l [[bt ag] bm' O Om ok]]]]] := box_reaches_a_leaf boxes x0 start bm.
exact: (critical_leaf_absent wf sat O Om bt bm' ag eliminated ok).
Qed.
