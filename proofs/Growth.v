(* The differential inequality of the theorem of stability, for functions of time that have a
   derivative at each time.

   y stands for twice the energy, u for b'D + k s, in which D is what the slip particles have slid:
   u does not decrease, and with eps > 0

       y' <= 2 u' (c + sqrt (y - (1/4 + eps) u^2)),     y >= (1/4 + eps) u^2.

   c, of the size of the disturbance, is a constant here.

   [root_grows]: sqrt (y + c^2) grows at most twice as fast as u.  [slope_falls]: where u >= 2c/eps,
   y/u^2 + eps ln u does not grow; so [slide_bounded]: u is at most a multiple of its first value.
   Theorem [growth_bounded]: if u(0) = 0 and y(0) <= c^2, then u <= C c at all times, where C
   depends on eps only.

   Page: spec/stability.md, proof of (a).  Motions have accelerations that jump; for them the same
   holds of absolutely continuous y and u, which is cited and not proved here. *)

From Coq Require Import Reals Ranalysis5 Lra Psatz.

Local Open Scope R_scope.

Section Growth.

Variables (y y' u u' : R -> R) (c eps : R).
Hypotheses (c0 : 0 < c) (eps0 : 0 < eps).
Hypothesis dy : forall t, 0 <= t -> derivable_pt_lim y t (y' t).
Hypothesis du : forall t, 0 <= t -> derivable_pt_lim u t (u' t).
Hypothesis grows : forall t, 0 <= t -> 0 <= u' t.
Hypothesis above : forall t, 0 <= t -> (1/4 + eps) * (u t * u t) <= y t.
Hypothesis inequality : forall t, 0 <= t ->
  y' t <= 2 * u' t * (c + sqrt (y t - (1/4 + eps) * (u t * u t))).

(* A function with a derivative of one sign. *)
Lemma falls f f' a b : 0 <= a <= b ->
  (forall t, a <= t <= b -> derivable_pt_lim f t (f' t)) -> (forall t, a <= t <= b -> f' t <= 0) ->
  f b <= f a.
Proof.
intros [a0 [lt | <-]] df neg; [|lra].
destruct (MVT_cor2 f f' a b lt) as [t [eq [at1 at2]]]; [intros; apply df; lra|].
assert (n := neg t ltac:(lra)); nra.
Qed.

Lemma u_grows a b : 0 <= a <= b -> u a <= u b.
Proof.
intros ab; enough (- u b <= - u a) by lra.
apply (falls (fun t => - u t) (fun t => - u' t) a b ab); intros t at1.
  apply (derivable_pt_lim_opp u t (u' t)), du; lra.
assert (g := grows t ltac:(lra)); lra.
Qed.

Lemma y_ge0 t : 0 <= t -> 0 <= y t.
Proof. intros t0; assert (h := above t t0); nra. Qed.

Lemma root_grows a b : 0 <= a <= b ->
  sqrt (y b + c * c) - 2 * u b <= sqrt (y a + c * c) - 2 * u a.
Proof.
intros ab.
apply (falls (fun t => sqrt (y t + c * c) - 2 * u t)
  (fun t => / (2 * sqrt (y t + c * c)) * y' t - 2 * u' t) a b ab); intros t at1.
  assert (t0 : 0 <= t) by lra; assert (p := y_ge0 t t0).
  apply (derivable_pt_lim_minus (fun t => sqrt (y t + c * c)) (fun t => 2 * u t)).
    apply (derivable_pt_lim_comp (fun t => y t + c * c) sqrt).
      replace (y' t) with (y' t + 0) by lra.
      apply (derivable_pt_lim_plus y (fun _ => c * c)); [now apply dy|].
      apply derivable_pt_lim_const.
    apply derivable_pt_lim_sqrt; nra.
  apply (derivable_pt_lim_scal u 2 t (u' t)), du; lra.
assert (t0 : 0 <= t) by lra; assert (p := y_ge0 t t0); assert (g := grows t t0).
assert (i := inequality t t0); set (s := sqrt (y t - _)) in i.
assert (s_le : s <= sqrt (y t)) by (apply sqrt_le_1_alt; nra).
assert (y_le : sqrt (y t) <= sqrt (y t + c * c)) by (apply sqrt_le_1_alt; nra).
assert (c_le : c <= sqrt (y t + c * c)).
  rewrite <- (sqrt_square c) at 1 by lra. apply sqrt_le_1_alt; lra.
set (w := sqrt (y t + c * c)) in *; assert (w0 : 0 < w) by lra.
apply (Rmult_le_reg_l (2 * w)); [lra|].
replace (2 * w * (/ (2 * w) * y' t - 2 * u' t)) with (y' t - 4 * w * u' t) by (field; lra).
nra.
Qed.

Lemma slope_falls a b : 0 <= a <= b -> 0 < u a -> 2 * c <= eps * u a ->
  y b / (u b * u b) + eps * ln (u b) <= y a / (u a * u a) + eps * ln (u a).
Proof.
intros ab ua large.
apply (falls (fun t => y t / (u t * u t) + eps * ln (u t))
  (fun t => (y' t * (u t * u t) - (u' t * u t + u t * u' t) * y t) / Rsqr (u t * u t)
            + eps * (/ u t * u' t)) a b ab); intros t at1; assert (t0 : 0 <= t) by lra;
  assert (ut := u_grows a t ltac:(lra)); assert (u_pos : 0 < u t) by lra.
  apply (derivable_pt_lim_plus (fun t => y t / (u t * u t)) (fun t => eps * ln (u t))).
    apply (derivable_pt_lim_div y (fun t => u t * u t)); [now apply dy| |nra].
    apply (derivable_pt_lim_mult u u); now apply du.
  apply (derivable_pt_lim_scal (fun t => ln (u t)) eps).
  apply (derivable_pt_lim_comp u ln); [now apply du | now apply derivable_pt_lim_ln].
assert (i := inequality t t0); assert (g := grows t t0); assert (p := above t t0).
set (s := sqrt (y t - _)) in i.
assert (ss : s * s = y t - (1/4 + eps) * (u t * u t)) by (apply sqrt_sqrt; lra).
apply (Rmult_le_reg_l (u t * u t * u t)); [repeat apply Rmult_lt_0_compat; lra|].
rewrite Rmult_0_r.
replace (_ * (_ / Rsqr (u t * u t) + eps * (/ u t * u' t))) with
  (u t * y' t - 2 * u' t * y t + eps * u' t * (u t * u t)) by (unfold Rsqr; field; lra).
assert (step : u t * y' t <= u t * (2 * u' t * (c + s))) by (apply Rmult_le_compat_l; lra).
assert (cu : 2 * c <= eps * u t) by (apply (Rle_trans _ _ _ large), Rmult_le_compat_l; lra).
apply (Rmult_le_compat_r (u t)) in cu; [|lra].
assert (q : 0 <= (s - u t / 2) * (s - u t / 2)) by apply Rle_0_sqr.
enough (u t * (2 * (c + s)) - 2 * y t + eps * (u t * u t) <= 0) by nra.
nra.
Qed.

Lemma slide_bounded a b : 0 <= a <= b -> 0 < u a -> 2 * c <= eps * u a ->
  u b <= u a * exp (y a / (u a * u a) / eps).
Proof.
intros ab ua large; assert (ub := u_grows a b ab); assert (f := slope_falls a b ab ua large).
assert (g : 0 <= y b / (u b * u b)).
  apply Rmult_le_pos; [apply y_ge0; lra|]; apply Rlt_le, Rinv_0_lt_compat; nra.
rewrite <- (exp_ln (u b)) by lra; rewrite <- (exp_ln (u a)) at 1 by lra; rewrite <- exp_plus.
destruct (Rle_lt_dec (ln (u b)) (ln (u a) + y a / (u a * u a) / eps)) as [le | lt].
  destruct le as [lt | ->]; [now apply Rlt_le, exp_increasing | lra].
exfalso; apply (Rmult_lt_compat_l eps) in lt; [|lra].
replace (eps * (ln (u a) + y a / (u a * u a) / eps)) with
  (eps * ln (u a) + y a / (u a * u a)) in lt by (field; split; nra || lra).
lra.
Qed.

Hypotheses (u_start : u 0 = 0) (y_start : y 0 <= c * c).

(* Where u first has the size 2c/eps, y is of the order of c^2. *)
Definition bound := 2 / eps * exp ((1 + eps) * (1 + eps) * 4 / eps).

Theorem growth_bounded t : 0 <= t -> u t <= bound * c.
Proof.
intros t0; pose (l := 2 / eps * c).
assert (e2 : 0 < 2 / eps) by (apply Rmult_lt_0_compat; [lra | now apply Rinv_0_lt_compat]).
assert (l0 : 0 < l) by (unfold l; nra).
assert (x1 : 1 <= exp ((1 + eps) * (1 + eps) * 4 / eps)).
  rewrite <- exp_0 at 1; apply Rlt_le, exp_increasing, Rmult_lt_0_compat.
    assert (0 < (1 + eps) * (1 + eps)) by (apply Rmult_lt_0_compat; lra); lra.
  now apply Rinv_0_lt_compat.
assert (boundE : bound * c = l * exp ((1 + eps) * (1 + eps) * 4 / eps)).
  unfold bound, l; ring.
destruct (Rle_lt_dec (u t) l) as [small | large].
  rewrite boundE, <- (Rmult_1_r (u t)); apply Rmult_le_compat; try lra.
  rewrite <- u_start; apply u_grows; lra.
(* u is l at some time *)
assert (cont : forall x, 0 <= x <= t -> continuity_pt (fun x => u x - l) x).
  intros x at1; apply continuity_pt_minus; [|apply continuity_pt_const; now intros ? ?].
  apply derivable_continuous_pt; exists (u' x); apply du; lra.
assert (pos : 0 < t) by (destruct t0 as [h | <-]; [lra | rewrite u_start in large; lra]).
destruct (IVT_interv (fun x => u x - l) 0 t cont pos) as [a [at1 eq]]; [lra | lra |].
assert (ua : u a = l) by lra.
assert (le : 2 * c <= eps * u a).
  rewrite ua; unfold l; apply Req_le; field; lra.
assert (b := slide_bounded a t ltac:(lra) ltac:(lra) le); rewrite ua in b.
assert (r := root_grows 0 a ltac:(lra)); rewrite u_start, ua in r.
assert (r0 : sqrt (y 0 + c * c) <= 2 * c).
  rewrite <- (sqrt_square (2 * c)) by lra; apply sqrt_le_1_alt; nra.
assert (r1 : sqrt (y a + c * c) <= 2 * c + 2 * l) by lra.
assert (ya : y a <= (2 * c + 2 * l) * (2 * c + 2 * l)).
  assert (p := y_ge0 a ltac:(lra)).
  assert (cc : 0 <= c * c) by (apply Rmult_le_pos; lra).
  assert (q := sqrt_pos (y a + c * c)); assert (e := sqrt_sqrt (y a + c * c) ltac:(lra)).
  assert (m := Rmult_le_compat _ _ _ _ q q r1 r1); lra.
apply (Rle_trans _ _ _ b); rewrite boundE.
apply Rmult_le_compat_l; [lra|].
enough (g : y a / (l * l) <= (1 + eps) * (1 + eps) * 4).
  assert (i : 0 < / eps) by now apply Rinv_0_lt_compat.
  assert (h : y a / (l * l) / eps <= (1 + eps) * (1 + eps) * 4 / eps).
    unfold Rdiv at 1 3; apply Rmult_le_compat_r; lra.
  destruct h as [lt | ->]; [now apply Rlt_le, exp_increasing | lra].
assert (ll : 0 < l * l) by (apply Rmult_lt_0_compat; lra).
apply (Rmult_le_reg_r (l * l)); [lra|].
replace (y a / (l * l) * (l * l)) with (y a) by (field; lra).
apply (Rle_trans _ _ _ ya); replace (2 * c) with (eps * l) by (unfold l; field; lra).
replace ((1 + eps) * (1 + eps) * 4 * (l * l)) with
  ((2 * l + 2 * (eps * l)) * (2 * l + 2 * (eps * l))) by ring.
assert (el : 0 < eps * l) by (apply Rmult_lt_0_compat; lra).
apply Rmult_le_compat; lra.
Qed.

End Growth.
