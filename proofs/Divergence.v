(* (8) if and only if (9): divergence along a constant direction, where all obstacles are flat.

   A motion (8) is u(t) = u0 + alpha(t) v, r(t) = r0 + beta(t) w, with alpha, alpha' and beta
   non-negative, alpha and alpha' non-decreasing, v and w constant, v != 0 and admissible: v = 0 at
   particles that stick, v_N = 0 and S v_T <= 0 at slip particles.  It obeys Signorini's conditions
   (1), Coulomb's law (2), the equation of motion (3), and (4).

   - [solution_of_motion]: if alpha is not constant, v solves (9) with some lambda^2 >= 0.
   - [motion_of_solution]: a solution (lambda^2, v, w) of (9) gives motions (8) with beta = alpha
     and alpha'' = lambda^2 alpha.  They obey (1)-(4) as long as alpha is at most a bound, which
     depends on the equilibrium, v and w, and not on where alpha begins.

   The statements hold over any ordered field; this much of real analysis stays outside:

   - "Not constant" is read as: alpha'(t) > 0 for some t of the interval.  Over the real numbers
     the two are the same, by the mean value theorem.
   - For lambda > 0 the functions alpha with alpha'' = lambda^2 alpha are those with cosh and sinh
     of spec/problem.md, 1.3.  [motion_of_solution] speaks of one time, with the numbers alpha,
     alpha' and alpha'' there.

   The degrees of freedom stand in the order of Reduction.v: f, Ts, Ns, d.

   Page: spec/problem.md, 1.3; spec/errata.md, X14. *)

From Mceip Require Import Base Reduction.

(* Properties that hold from 0 up to some positive number. *)
Section Small.

Variable R : realFieldType.

Definition for_small (P : R -> Prop) := exists2 bound, 0 < bound & forall a, 0 <= a <= bound -> P a.

Lemma for_small_and P Q : for_small P -> for_small Q -> for_small (fun a => P a /\ Q a).
Proof.
move=> [b b0 Pb] [c c0 Qc]; exists (Num.min b c); first by rewrite lt_minr b0 c0.
by move=> a /andP[a0]; rewrite le_minr => /andP[ab ac]; split; [apply: Pb|apply: Qc]; rewrite a0.
Qed.

Lemma for_small_all n (P : 'I_n -> R -> Prop) :
  (forall i, for_small (P i)) -> for_small (fun a => forall i, P i a).
Proof.
move=> each.
suff [b b0 all_P] : exists2 b, 0 < b & forall i a, i \in enum 'I_n -> 0 <= a <= b -> P i a.
  by exists b => // a ab i; apply: all_P; rewrite ?mem_enum.
elim: (enum 'I_n) => [|i list [b b0 Pb]]; first by exists 1; rewrite ?ltr01.
have [c c0 Pc] := for_small_and (each i) (ex_intro2 _ _ b b0 (fun _ => id)).
exists c => // j a; rewrite inE => /orP[/eqP->|j_in] /Pc[] // _ ab; exact: Pb.
Qed.

Lemma stays_negative (c d : R) : c < 0 -> for_small (fun a => c + a * d < 0).
Proof.
move=> c0; have d1 : 0 < `|d| + 1 by rewrite ltr_paddl.
exists (- c / (`|d| + 1)); first by rewrite divr_gt0 // oppr_gt0.
move=> a /andP[a0]; rewrite ler_pdivl_mulr // => ab.
rewrite -ltr_subr_addl sub0r; apply: le_lt_trans (_ : a * `|d| < _).
  by rewrite ler_wpmul2l // ler_norm.
have [->|a_nonzero] := eqVneq a 0; first by rewrite mul0r oppr_gt0.
have a_pos : 0 < a by rewrite lt_def a_nonzero.
by apply: lt_le_trans ab; rewrite ltr_pmul2l // ltr_addl ltr01.
Qed.

Lemma cone_along (m rT rN wT wN a : R) : 0 <= a ->
  `|rT + a * wT| + m * (rN + a * wN) <= `|rT| + m * rN + a * (`|wT| + m * wN).
Proof.
move=> a0; have -> : `|rT| + m * rN + a * (`|wT| + m * wN) =
  `|rT| + a * `|wT| + m * (rN + a * wN) by ring.
by rewrite ler_add2r (le_trans (ler_norm_add _ _)) // normrM (ger0_norm a0).
Qed.

(* The derivative from the right. *)
Definition right_derivative (f : R -> R) t d := forall e, 0 < e ->
  exists2 step, 0 < step & forall h, 0 < h <= step -> `|f (t + h) - f t - d * h| <= e * h.

Lemma short_step f t d e stop : right_derivative f t d -> 0 < e -> t < stop ->
  exists2 h, 0 < h & t + h < stop /\ `|f (t + h) - f t - d * h| <= e * h.
Proof.
move=> derivative e0 before; have [step step0 near] := derivative e e0.
have half : 0 < (stop - t) / 2%:R by rewrite divr_gt0 ?subr_gt0 ?ltr0n.
exists (Num.min step ((stop - t) / 2%:R)); first by rewrite lt_minr step0 half.
split; last by apply: near; rewrite lt_minr step0 half le_minl lexx.
rewrite -ltr_subr_addl (le_lt_trans (_ : _ <= (stop - t) / 2%:R)) ?le_minl ?lexx ?orbT //.
by rewrite ltr_pdivr_mulr ?ltr0n // ltr_pmulr ?subr_gt0 // ltr1n.
Qed.

Lemma growth f t d stop : right_derivative f t d -> 0 < d -> 0 <= f t -> t < stop ->
  exists2 h, 0 < h & t + h < stop /\ 0 < f (t + h).
Proof.
move=> derivative d0 f0 before; have e0 : 0 < d / 2%:R by rewrite divr_gt0 ?ltr0n.
have [h h0 [h_end near]] := short_step derivative e0 before.
exists h => //; split=> //; move: near; rewrite ler_norml => /andP[below _].
have : 0 < f t + d / 2%:R * h by rewrite ltr_paddl // mulr_gt0.
move/lt_le_trans; apply; rewrite -subr_ge0; move: below; rewrite -subr_ge0; congr (_ <= _).
by field.
Qed.

Lemma slope_ge0 f t d stop : right_derivative f t d -> t < stop ->
  (forall q, t <= q -> q < stop -> f t <= f q) -> 0 <= d.
Proof.
move=> derivative before rises; rewrite leNgt; apply/negP=> d0.
have e0 : 0 < - d / 2%:R by rewrite divr_gt0 ?ltr0n ?oppr_gt0.
have [h h0 [h_end near]] := short_step derivative e0 before.
have := rises (t + h); rewrite ler_addl (ltW h0) => /(_ isT h_end); rewrite -subr_ge0 => up.
move: near; rewrite ler_norml => /andP[_]; rewrite leNgt => /negP; apply.
apply: lt_le_trans (_ : - d * h <= _); last by rewrite mulNr ler_addr.
by rewrite ltr_pmul2r // ltr_pdivr_mulr ?ltr0n // ltr_pmulr ?oppr_gt0 // ltr1n.
Qed.

End Small.

Section Divergence.

Variable R : realFieldType.

(* (1) and (2) for one particle; m is its coefficient of friction, c_p mu. *)
Definition signorini (uN rN : R) := [/\ uN <= 0, rN <= 0 & uN * rN = 0].
Definition coulomb (m vT rT rN : R) := `|rT| + m * rN <= 0 /\ `|vT| * rT - m * vT * rN = 0.

(* A slip particle: S the sign of its tangential reaction, a v its velocity. *)
Section SlipParticle.

Variables (S m v rT rN a : R).
Hypothesis sign_squared : S * S = 1.

Lemma norm_sign_mul (x : R) : `|S * x| = `|x|.
Proof.
have sign1 : `|S| = 1.
  apply/eqP; rewrite -(@eqr_expn2 _ 2) ?normr_ge0 ?ler01 //.
  by rewrite expr1n real_normK ?num_real // expr2 sign_squared.
by rewrite normrM sign1 mul1r.
Qed.

Lemma coulomb_of_lines : 0 <= a -> S * v <= 0 -> 0 < S * rT -> S * rT + m * rN <= 0 ->
  (S * rT + m * rN) * (S * v) = 0 -> coulomb m (a * v) rT rN.
Proof.
move=> a0 Sv SrT inside product; split; first by rewrite -norm_sign_mul gtr0_norm.
rewrite normrM (ger0_norm a0) -norm_sign_mul (ler0_norm Sv).
have -> : a * - (S * v) * rT - m * (a * v) * rN =
  - a * S * ((S * rT + m * rN) * (S * v)) + (S * S - 1) * (a * v * (S * rT + m * rN)) by ring.
by rewrite product sign_squared subrr mulr0 mul0r addr0.
Qed.

Lemma inside_of_coulomb : coulomb m (a * v) rT rN -> S * rT + m * rN <= 0.
Proof.
by case=> inside _; apply: le_trans inside; rewrite ler_add2r -(norm_sign_mul rT) ler_norm.
Qed.

Lemma border_of_coulomb : 0 < a -> S * v < 0 -> coulomb m (a * v) rT rN -> S * rT + m * rN = 0.
Proof.
move=> a0 Sv [_]; rewrite normrM (gtr0_norm a0) -norm_sign_mul (ltr0_norm Sv) => product.
have v0 : v != 0 by apply: contraTneq Sv => ->; rewrite mulr0 ltxx.
have : - a * v * (S * rT + m * rN) = 0 by rewrite -product; ring.
by move/eqP; rewrite !mulf_eq0 oppr_eq0 (gt_eqF a0) (negbTE v0) => /eqP.
Qed.

End SlipParticle.

Variables nf ns nd : nat.
Notation all_dofs := (nf + (ns + (ns + nd)))%N.

Variables (K M : 'M[R]_all_dofs) (sign factor : 'I_ns -> R) (mu : R).
Hypothesis sign_squared : forall i, sign i * sign i = 1.

(* The normal degrees of freedom of particles out of contact, and the particles that stick. *)
Variables (gaps sticks : nat) (gap : 'I_gaps -> 'I_nf).
Variables (tangential normal : 'I_sticks -> 'I_nd) (stick_factor : 'I_sticks -> R).

Notation v_f v := (usubmx v).
Notation v_T v := (usubmx (dsubmx v)).
Notation v_N v := (usubmx (dsubmx (dsubmx v))).
Notation v_d v := (dsubmx (dsubmx (dsubmx v))).

(* (1), (2) and (4) for displacements u, velocities u' and reactions r. *)
Definition laws (u u' r : 'cV[R]_all_dofs) :=
  [/\ v_f r = 0,
      forall i, v_f u (gap i) 0 <= 0,
      forall i, signorini (v_N u i 0) (v_N r i 0) /\
                coulomb (mu * factor i) (v_T u' i 0) (v_T r i 0) (v_N r i 0) &
      forall j, signorini (v_d u (normal j) 0) (v_d r (normal j) 0) /\
                coulomb (mu * stick_factor j) (v_d u' (tangential j) 0)
                        (v_d r (tangential j) 0) (v_d r (normal j) 0)].

Variables (f0 u0 r0 : 'cV[R]_all_dofs).

(* (5)-(7), and the contact states: out of contact, on the cone with the sign S, inside it. *)
Definition equilibrium :=
  [/\ K *m u0 = f0 + r0, laws u0 0 r0, forall i, v_f u0 (gap i) 0 < 0,
      forall i, [/\ v_N r0 i 0 < 0, 0 < sign i * v_T r0 i 0 &
                    sign i * v_T r0 i 0 + mu * (factor i * v_N r0 i 0) = 0] &
      forall j, v_d r0 (normal j) 0 < 0 /\
                `|v_d r0 (tangential j) 0| + mu * stick_factor j * v_d r0 (normal j) 0 < 0].

(* (9) on flat obstacles: no particle has a geometric stiffness. *)
Definition flat_conditions_9 lambda2 :=
  conditions_9 (K + lambda2 *: M) sign factor (fun=> 0) mu.

Lemma flat_cone (v w : 'cV[R]_all_dofs) i : cone sign factor (fun=> 0) mu v w i =
  sign i * v_T w i 0 + mu * (factor i * v_N w i 0).
Proof. by rewrite /cone /turning mulr0 mul0r addr0. Qed.

(* (3) for a displacement u and an acceleration u''. *)
Definition momentum (u u'' r : 'cV[R]_all_dofs) := M *m u'' + K *m u = f0 + r.

Hypothesis at_equilibrium : equilibrium.

Lemma v_f_line a (x y : 'cV[R]_all_dofs) i : v_f (x + a *: y) i 0 = v_f x i 0 + a * v_f y i 0.
Proof. by rewrite !mxE. Qed.

Lemma v_T_line a (x y : 'cV[R]_all_dofs) i : v_T (x + a *: y) i 0 = v_T x i 0 + a * v_T y i 0.
Proof. by rewrite !mxE. Qed.

Lemma v_N_line a (x y : 'cV[R]_all_dofs) i : v_N (x + a *: y) i 0 = v_N x i 0 + a * v_N y i 0.
Proof. by rewrite !mxE. Qed.

Lemma v_d_line a (x y : 'cV[R]_all_dofs) i : v_d (x + a *: y) i 0 = v_d x i 0 + a * v_d y i 0.
Proof. by rewrite !mxE. Qed.

Lemma v_T_scale a (x : 'cV[R]_all_dofs) i : v_T (a *: x) i 0 = a * v_T x i 0.
Proof. by rewrite !mxE. Qed.

Lemma v_d_scale a (x : 'cV[R]_all_dofs) i : v_d (a *: x) i 0 = a * v_d x i 0.
Proof. by rewrite !mxE. Qed.

(* At the equilibrium contacts are closed. *)
Lemma closed_slip i : v_N u0 i 0 = 0.
Proof.
have [_ [_ _ slip _] _ cone _] := at_equilibrium.
have [[_ _ product] _] := slip i; have [rN _ _] := cone i.
by move/eqP: product; rewrite mulf_eq0 (lt_eqF rN) orbF => /eqP.
Qed.

Lemma closed_stick j : v_d u0 (normal j) 0 = 0.
Proof.
have [_ [_ _ _ stick] _ _ inside] := at_equilibrium.
have [[_ _ product] _] := stick j; have [rN _] := inside j.
by move/eqP: product; rewrite mulf_eq0 (lt_eqF rN) orbF => /eqP.
Qed.

(* Contact states do not change while alpha is small. *)
Lemma states_persist (v w : 'cV[R]_all_dofs) : for_small (fun a =>
  [/\ forall i, v_f u0 (gap i) 0 + a * v_f v (gap i) 0 < 0,
      forall i, v_N r0 i 0 + a * v_N w i 0 < 0 /\
                0 < sign i * (v_T r0 i 0 + a * v_T w i 0) &
      forall j, v_d r0 (normal j) 0 + a * v_d w (normal j) 0 < 0 /\
                `|v_d r0 (tangential j) 0 + a * v_d w (tangential j) 0| +
                mu * stick_factor j * (v_d r0 (normal j) 0 + a * v_d w (normal j) 0) < 0]).
Proof.
have [_ _ open cone inside] := at_equilibrium.

have gaps_stay : for_small (fun a => forall i, v_f u0 (gap i) 0 + a * v_f v (gap i) 0 < 0).
  by apply: for_small_all => i; apply: stays_negative.

have slips_stay : for_small (fun a => forall i,
    v_N r0 i 0 + a * v_N w i 0 < 0 /\ 0 < sign i * (v_T r0 i 0 + a * v_T w i 0)).
  apply: for_small_all => i; have [rN rT _] := cone i.
  have negative : - (sign i * v_T r0 i 0) < 0 by rewrite oppr_lt0.
  have [b b0 small] := stays_negative (- (sign i * v_T w i 0)) negative.
  apply: (for_small_and (stays_negative (v_N w i 0) rN)).
  exists b => // a /small; rewrite mulrN -opprD oppr_lt0 => positive.
  by rewrite mulrDr [sign i * (a * _)]mulrCA.

have sticks_stay : for_small (fun a => forall j,
    v_d r0 (normal j) 0 + a * v_d w (normal j) 0 < 0 /\
    `|v_d r0 (tangential j) 0 + a * v_d w (tangential j) 0| +
    mu * stick_factor j * (v_d r0 (normal j) 0 + a * v_d w (normal j) 0) < 0).
  apply: for_small_all => j; have [rN gj] := inside j.
  apply: (for_small_and (stays_negative (v_d w (normal j) 0) rN)).
  have [b b0 small] := stays_negative
    (`|v_d w (tangential j) 0| + mu * stick_factor j * v_d w (normal j) 0) gj.
  exists b => // a ab; have /andP[a0 _] := ab.
  exact: le_lt_trans (cone_along _ _ _ _ _ a0) (small a ab).

have [b b0 all] := for_small_and gaps_stay (for_small_and slips_stay sticks_stay).
by exists b => // a /all[? [? ?]].
Qed.

(* A solution (lambda^2, v, w) of (9) gives motions (8): whatever alpha, alpha' >= 0 are at a time,
   as long as alpha is at most [bound], they satisfy (1)-(4) if alpha'' = lambda^2 alpha. *)
Theorem motion_of_solution lambda2 v w :
  flat_conditions_9 lambda2 v w ->
  exists2 bound, 0 < bound & forall alpha alpha', 0 <= alpha <= bound -> 0 <= alpha' ->
    momentum (u0 + alpha *: v) ((lambda2 * alpha) *: v) (r0 + alpha *: w) /\
    laws (u0 + alpha *: v) (alpha' *: v) (r0 + alpha *: w).
Proof.
case=> _ equation wf [vN vd] lines; have [balance [rf _ _ _] _ cone _] := at_equilibrium.
have [bound bound0 states] := states_persist v w.

exists bound => // a a' ab a'0; have [open slips sticks_in] := states a ab.
have /andP[a0 _] := ab.
split.
  rewrite /momentum mulmxDr balance -!scalemxAr -equation mulmxDl -scalemxAl scalerDr scalerA.
  by rewrite [lambda2 * a]mulrC addrC -!addrA.

split.
- by apply/colP=> i; rewrite v_f_line rf wf !mxE mulr0 addr0.
- by move=> i; rewrite v_f_line ltW.
- move=> i; have [rN rT] := slips i; have [_ _ on_cone] := cone i.
  have := lines i; rewrite flat_cone => -[vT inside product].
  rewrite v_N_line closed_slip vN [X in a * X]mxE mulr0 addr0.
  rewrite v_T_scale v_T_line v_N_line.
  set rT' := _ + _ in rT *; set rN' := _ + _ in rN *; set m := mu * factor i.

  have border : sign i * rT' + m * rN' =
                a * (sign i * v_T w i 0 + mu * (factor i * v_N w i 0)).
    by rewrite -[RHS]add0r -on_cone /rT' /rN' /m; ring.
  split; first by split; [exact: lexx | exact: ltW | exact: mul0r].
  apply: (coulomb_of_lines (sign_squared i)) => //; rewrite border ?mulr_ge0_le0 //.
  by rewrite -mulrA product mulr0.
- move=> j; have [rN inside] := sticks_in j.
  rewrite v_d_line closed_stick vd [X in a * X]mxE mulr0 addr0.
  rewrite v_d_scale vd [X in a' * X]mxE mulr0 !v_d_line.
  split; first by split; [exact: lexx | exact: ltW | exact: mul0r].
  by split; [exact: ltW | rewrite normr0 mulr0 !mul0r subr0].
Qed.

Lemma dot_line a b (v x y : 'cV[R]_all_dofs) :
  dot v (a *: x + b *: y) = a * dot v x + b * dot v y.
Proof. by rewrite /dot mulmxDr -!scalemxAr !mxE. Qed.

(* v may be the direction of a motion (8). *)
Definition admissible (v : 'cV[R]_all_dofs) :=
  [/\ v != 0, v_N v = 0, v_d v = 0 & forall i, sign i * v_T v i 0 <= 0].

Hypothesis stiffness_definite : definite K.
Hypothesis mass_semidefinite : semidefinite M.

(* (9) from one time of a motion (8) with alpha > 0 and alpha' > 0. *)
Theorem solution_at_one_time alpha alpha' alpha'' beta v w :
  0 < alpha -> 0 < alpha' -> 0 <= alpha'' -> 0 <= beta -> admissible v ->
  momentum (u0 + alpha *: v) (alpha'' *: v) (r0 + beta *: w) ->
  laws (u0 + alpha *: v) (alpha' *: v) (r0 + beta *: w) ->
  0 < beta /\
  flat_conditions_9 (alpha'' / alpha) v ((beta / alpha) *: w).
Proof.
move=> a0 a'0 a''0 b0 [v0 vN vd vT] balance [rf _ slips _].
have [balance0 [rf0 _ _ _] _ cone _] := at_equilibrium.

have rates : alpha'' *: (M *m v) + alpha *: (K *m v) = beta *: w.
  move: balance; rewrite /momentum mulmxDr -!scalemxAr balance0 addrCA -addrA.
  by move=> /addrI /addrI.

have b_pos : 0 < beta.
  rewrite lt_def b0 andbT; apply/eqP=> b_zero.
  have : dot v (alpha'' *: (M *m v) + alpha *: (K *m v)) = 0.
    by rewrite rates b_zero scale0r /dot mulmx0 mxE.
  rewrite dot_line; apply/eqP; rewrite gt_eqF // ltr_paddl ?mulr_ge0 ?mulr_gt0 //.
  exact: stiffness_definite.

have quotient : 0 < beta / alpha by rewrite divr_gt0.
split=> //; split=> //.
- rewrite mulmxDl -scalemxAl; apply: (scalerI (lt0r_neq0 a0)).
  rewrite scalerDr !scalerA mulrCA divff ?lt0r_neq0 // mulr1 [alpha * _]mulrC divfK ?lt0r_neq0 //.
  by rewrite -rates addrC.
- have : beta *: v_f w = 0.
    by apply/colP=> i; move/colP: rf => /(_ i); rewrite v_f_line rf0 !mxE add0r.
  move/eqP; rewrite scaler_eq0 (gt_eqF b_pos) => /eqP wf.
  by apply/colP=> i; move/colP: wf => /(_ i); rewrite !mxE => ->; rewrite mulr0.
move=> i; have [_ _ on_cone] := cone i; have [_ friction] := slips i.
rewrite v_T_scale v_T_line v_N_line in friction; rewrite flat_cone.
have -> : v_N ((beta / alpha) *: w) i 0 = beta / alpha * v_N w i 0 by rewrite !mxE.
rewrite v_T_scale; set c := sign i * v_T w i 0 + mu * (factor i * v_N w i 0).

have border : sign i * (v_T r0 i 0 + beta * v_T w i 0) +
              mu * factor i * (v_N r0 i 0 + beta * v_N w i 0) = beta * c.
  by rewrite /c -[RHS]add0r -on_cone; ring.
have -> : sign i * (beta / alpha * v_T w i 0) + mu * (factor i * (beta / alpha * v_N w i 0)) =
          beta / alpha * c by rewrite /c; ring.
have c_le0 : c <= 0.
  by have := inside_of_coulomb (sign_squared i) friction; rewrite border pmulr_rle0.
split; first exact: vT.
  by rewrite pmulr_rle0.
have [->|slip] := eqVneq (sign i * v_T v i 0) 0; first by rewrite mulr0.
have slip_neg : sign i * v_T v i 0 < 0 by rewrite lt_def eq_sym slip vT.
have := border_of_coulomb (sign_squared i) a'0 slip_neg friction.
by rewrite border => /eqP; rewrite mulf_eq0 (gt_eqF b_pos) => /eqP->; rewrite mulr0 mul0r.
Qed.

(* A motion (8) for tau <= t < stop.  alpha and alpha' have the derivatives alpha' and alpha'' from
   the right; that beta does not decrease is not used. *)
Definition motion_8 (tau stop : R) (alpha alpha' alpha'' beta : R -> R) v w :=
  (forall t s, tau <= t -> t <= s -> s < stop -> alpha' t <= alpha' s) /\
  forall t, tau <= t < stop ->
    [/\ [/\ 0 <= alpha t, 0 <= alpha' t & 0 <= beta t],
        right_derivative alpha t (alpha' t) /\ right_derivative alpha' t (alpha'' t),
        momentum (u0 + alpha t *: v) (alpha'' t *: v) (r0 + beta t *: w) &
        laws (u0 + alpha t *: v) (alpha' t *: v) (r0 + beta t *: w)].

Theorem solution_of_motion tau stop alpha alpha' alpha'' beta v w :
  admissible v -> motion_8 tau stop alpha alpha' alpha'' beta v w ->
  (exists2 t, tau <= t < stop & 0 < alpha' t) ->
  exists lambda2 k, [/\ 0 <= lambda2, 0 < k & flat_conditions_9 lambda2 v (k *: w)].
Proof.
move=> v_admissible [grows at_time] [t t_in rises].
have [[a0 _ _] [derivative _] _ _] := at_time t t_in.
have /andP[after before] := t_in.

have [h h0 [h_end later]] := growth derivative rises a0 before.
set s := t + h in later h_end *.
have s_in : tau <= s < stop by rewrite h_end andbT (le_trans after) // ler_addl ltW.
have [[_ _ b0] [_ derivative'] balance obeyed] := at_time s s_in.
have a's : 0 < alpha' s by rewrite (lt_le_trans rises) // grows // ler_addl ltW.
have a''s : 0 <= alpha'' s.
  apply: (slope_ge0 derivative' h_end) => q sq q_end.
  by apply: grows => //; case/andP: s_in.

have [b_pos solution] := solution_at_one_time later a's a''s b0 v_admissible balance obeyed.
by exists (alpha'' s / alpha s), (beta s / alpha s); rewrite ?divr_ge0 ?divr_gt0 // ltW.
Qed.

End Divergence.
