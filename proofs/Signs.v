(* Signs of polynomials at an algebraic value, and between two of them.

   A value is the root of an integer polynomial p in [a/d, b/d], with 0 <= a <= b and d > 0.  With

       p(s) - p(t) = (s - t) S(s, t),        p(a/d) <= 0 <= p(b/d),

   there is a root, and only one if S > 0 on the interval; S is enclosed by interval Horner.  The
   polynomial -p has the same root, so that S > 0 is no loss of generality.

   A place is one value, the open interval between two values, or all that lies above a value.
   Evidence for the sign of a polynomial g at a place:

     at the value      c g = p q + r with c > 0: the sign of r, by interval Horner; r = 0: zero.
     near a value      c g = p^i h with c > 0, and h > 0 on the whole interval of the value: as
                       p > 0 above the value, g > 0 there.  Below it, -p stands for p.
     in [l, u)         t = (l1 + u1 y) / (l2 + u2 y) with y >= 0; the coefficients of
                       g(t) (l2 + u2 y)^n as a polynomial in y are not negative, and the first
                       one is positive; in (l, u) some coefficient is.  This is Descartes' rule
                       without a change of sign.  u may be infinity.

   An interval between two values is covered by a part near each of them and by intervals [l, u)
   between.

   Theorems: [value_exists], [value_unique]; [positive_sound], [zero_sound]: what the checker says
   about a sign at a place holds at each point of it.

   Page: spec/certificates.md, 5.12, obligations 1 and 2.
   Rust: crates/check/src/cover/rootless.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Existence Pencil Claim.

Record value := Value {
  value_poly : polynomial;
  value_from : Z;
  value_to : Z;
  value_den : Z }.

Inductive place :=
  | PointAt of value
  | Between of value & value
  | Above of value.

(* c g = p^i h *)
Record near := Near { near_multiplier : Z; near_power : nat; near_cofactor : polynomial }.

Inductive sign_evidence :=
  | Identity
  | Remainder of reduction
  | Parts of near & seq point & near.

Section Checker.

Local Open Scope Z_scope.

(* Interval Horner of p, and a lower bound of d^n S(s, t), for s and t in [a/d, b/d]; p has n
   coefficients. *)
Fixpoint slope_interval (a b d : Z) (p : polynomial) : Z * Z * Z * Z :=
  match p with
  | [::] => (0, 0, 1, 0)
  | c :: p' =>
      let: (lo, hi, power, slope) := slope_interval a b d p' in
      let constant := c * (power * d) in
      ((if 0 <=? lo then a * lo else b * lo) + constant,
       (if 0 <=? hi then b * hi else a * hi) + constant, power * d,
       d * lo + (if 0 <=? slope then a * slope else b * slope))
  end.

Definition slope_low a b d p := (slope_interval a b d p).2.

Definition check_value (v : value) :=
  let: Value p a b d := v in
  [&& 0 <=? a, a <=? b, 0 <? d, high_on a a d p <=? 0, 0 <=? low_on b b d p &
      (a =? b) || (0 <? slope_low a b d p)].

Definition low_of (v : value) g := low_on (value_from v) (value_to v) (value_den v) g.

Definition power_poly p i : polynomial := iter i (mul_poly p) [:: 1].

Definition factors p g (w : near) :=
  (0 <? near_multiplier w) &&
  same_poly (scale_poly (near_multiplier w) g)
    (mul_poly (power_poly p (near_power w)) (near_cofactor w)).

Definition rational (v : value) := value_from v =? value_to v.

Definition positive_after v g w :=
  rational v || factors (value_poly v) g w && (0 <? low_of v (near_cofactor w)).

Definition positive_before v g w :=
  rational v ||
  factors (scale_poly (-1) (value_poly v)) g w && (0 <? low_of v (near_cofactor w)).

(* The polynomial g(t) (l2 + u2 y)^n in y, and (l2 + u2 y)^n; n coefficients. *)
Fixpoint moebius (l u : point) (g : polynomial) : polynomial * polynomial :=
  match g with
  | [::] => ([::], [:: 1])
  | c :: g' =>
      let: (numerator, power) := moebius l u g' in
      let power' := mul_poly [:: l.2; u.2] power in
      (add_poly (scale_poly c power') (mul_poly [:: l.1; u.1] numerator), power')
  end.

(* g > 0 in [l, u), or in (l, u) if it is open. *)
Definition positive_on (open : bool) (l u : point) g :=
  let: (numerator, _) := moebius l u g in
  all (fun c => 0 <=? c) numerator &&
  (if open then has (fun c => 0 <? c) numerator else 0 <? head 0 numerator).

Fixpoint positive_between (open : bool) (l : point) (cuts : seq point) (u : point) g :=
  match cuts with
  | [::] => positive_on open l u g
  | c :: cuts' =>
      [&& 0 <? c.2, positive_on open l c g & positive_between false c cuts' u g]
  end.

Definition end_of (v : value) : point := (value_to v, value_den v).
Definition start_of (v : value) : point := (value_from v, value_den v).

Definition positive_in (pl : place) g (e : sign_evidence) :=
  match pl, e with
  | PointAt v, Remainder w => reduces_by (value_poly v) g w && (0 <? low_of v (rest w))
  | Between v v', Parts n cuts n' =>
      [&& positive_after v g n, positive_before v' g n' &
          positive_between true (end_of v) cuts (start_of v') g]
  | Above v, Parts n cuts _ =>
      positive_after v g n && positive_between true (end_of v) cuts infinity g
  | _, _ => false
  end.

Definition zero_in (pl : place) g (e : sign_evidence) :=
  match pl, e with
  | _, Identity => zero_poly g
  | PointAt v, Remainder w => reduces_by (value_poly v) g w && zero_poly (rest w)
  | _, _ => false
  end.

Definition place_checked (pl : place) :=
  match pl with
  | PointAt v | Above v => check_value v
  | Between v v' => check_value v && check_value v'
  end.

End Checker.

Section Sound.

Variable R : rcfType.
Implicit Types (s t : R) (v : value).

Definition is_value v s :=
  [/\ toR (value_from v) <= toR (value_den v) * s, toR (value_den v) * s <= toR (value_to v) &
      eval (value_poly v) s = 0].

Definition in_place (pl : place) t :=
  match pl with
  | PointAt v => is_value v t
  | Between v v' => (forall s, is_value v s -> s < t) /\ (forall s, is_value v' s -> t < s)
  | Above v => forall s, is_value v s -> s < t
  end.

Section Interval.

Variables (a b d : Z).
Hypotheses (a0 : 0 <= toR a :> R) (d0 : 0 < toR d :> R).

Lemma interval_power p : 0 < toR (horner_interval a b d p).2 :> R.
Proof.
elim: p => [|c p IH] /=; first by rewrite toR1 ltr01.
by case: (horner_interval a b d p) IH => [[lo hi] power] /= IH; rewrite toRM mulr_gt0.
Qed.

Lemma low_onE p t : toR a <= toR d * t -> toR d * t <= toR b ->
  toR (low_on a b d p) <= toR (horner_interval a b d p).2 * eval p t.
Proof.
move=> at_ tb; have := horner_interval_sound p a0 at_ tb d0; rewrite /low_on.
by case: (horner_interval a b d p) => [[lo hi] power] /= [].
Qed.

Lemma slope_intervalE p : (slope_interval a b d p).1 = horner_interval a b d p.
Proof.
elim: p => //= c p; case: (slope_interval a b d p) => [[[lo hi] power] sl] /= <- //.
Qed.

Lemma slope_lowE p s t :
  toR a <= toR d * s -> toR d * s <= toR b -> toR a <= toR d * t -> toR d * t <= toR b ->
  toR (slope_low a b d p) <= toR (horner_interval a b d p).2 * slope p s t.
Proof.
move=> as_ sb at_ tb; rewrite /slope_low; elim: p => [|c p IH] /=; first by rewrite toR0 mulr0.
have := low_onE p as_ sb; rewrite /low_on -slope_intervalE.
move: IH; rewrite -slope_intervalE.
case: (slope_interval a b d p) => [[[lo hi] power] sl] /= IH low.
rewrite (_ : toR (power * d)%Z * _ = toR d * (toR power * eval p s) +
               toR d * t * (toR power * slope p s t)); last first.
  by rewrite toRM; move: (eval p s) (slope p s t) (toR power) (toR d) => *; ring.
rewrite toRD toRM ler_add //; first by rewrite ler_wpmul2l // ltW.
have := product_lower a0 at_ tb IH; rewrite -(@toR_ge0 R).
by case: (0 <= toR _); rewrite toRM.
Qed.

Lemma slope_gt0 p s t :
  toR a <= toR d * s -> toR d * s <= toR b -> toR a <= toR d * t -> toR d * t <= toR b ->
  (0 <? slope_low a b d p)%Z -> 0 < slope p s t.
Proof.
move=> as_ sb at_ tb; rewrite -(@toR_gt0 R) => lo.
rewrite -(pmulr_rgt0 _ (interval_power p)).
by apply: lt_le_trans (slope_lowE _ as_ sb at_ tb).
Qed.

End Interval.

Section Value.

Variable v : value.
Hypothesis checked : check_value v.
Notation a := (value_from v).
Notation b := (value_to v).
Notation d := (value_den v).
Notation p := (value_poly v).

Lemma value_parts :
  [/\ 0 <= toR a :> R, toR a <= toR b :> R, 0 < toR d :> R &
      [/\ (high_on a a d p <=? 0)%Z, (0 <=? low_on b b d p)%Z &
          rational v || (0 <? slope_low a b d p)%Z]].
Proof.
move: checked; rewrite /rational; case: (v) => p a b d /=.
by case/and5P=> a0 ab d0 pa /andP[pb slope]; rewrite toR_ge0 toR_le toR_gt0.
Qed.

Lemma value_exists : exists s, is_value v s.
Proof.
by have [a0 ab d0 [pa pb _]] := value_parts; apply: root_on; rewrite // /changes_sign pa pb.
Qed.

Lemma rational_value s t : rational v -> is_value v s ->
  toR a <= toR d * t -> toR d * t <= toR b -> t = s.
Proof.
have [_ _ d0 _] := value_parts; move=> /Z.eqb_spec ab [as_ sb _] at_ tb.
apply: (mulfI (lt0r_neq0 d0)); apply/eqP; rewrite eq_le.
by rewrite (le_trans tb) -?ab // (le_trans sb) -?ab.
Qed.

(* p has the sign of t - s. *)
Lemma poly_sign s t : ~~ rational v -> is_value v s ->
  toR a <= toR d * t -> toR d * t <= toR b ->
  exists2 c, 0 < c & eval p t = (t - s) * c.
Proof.
have [a0 _ d0 [_ _ /orP[->//|pos]]] := value_parts; move=> _ [as_ sb ps] at_ tb.
exists (slope p t s); first exact: (@slope_gt0 a b d).
by rewrite -slopeE ps subr0.
Qed.

Lemma value_unique s t : is_value v s -> is_value v t -> s = t.
Proof.
move=> is_s [at_ tb pt]; have [rat|irr] := boolP (rational v).
  by rewrite (rational_value rat is_s at_ tb).
have [c c0 eq] := poly_sign irr is_s at_ tb; move: eq; rewrite pt => /esym/eqP.
by rewrite mulf_eq0 (gt_eqF c0) orbF subr_eq0 => /eqP.
Qed.

End Value.

Lemma eval_power p i t : eval (power_poly p i) t = eval p t ^+ i.
Proof.
elim: i => [|i IH]; first by rewrite expr0 /= toR1 mulr0 addr0.
by rewrite exprS -IH -eval_mul.
Qed.

Lemma factors_gt0 p g w t : factors p g w -> 0 < eval p t -> 0 < eval (near_cofactor w) t ->
  0 < eval g t.
Proof.
case/andP=> c0 /(same_polyE t); rewrite eval_scale eval_mul eval_power => eq p0 h0.
by rewrite -(@pmulr_rgt0 _ (toR (near_multiplier w))) ?toR_gt0 // eq mulr_gt0 ?exprn_gt0.
Qed.

Lemma positive_after_sound v g w s t : check_value v -> positive_after v g w -> is_value v s ->
  s < t -> toR (value_den v) * t <= toR (value_to v) -> 0 < eval g t.
Proof.
move=> ok + is_s st tb; have [a0 _ d0 _] := value_parts ok.
have at_ : toR (value_from v) <= toR (value_den v) * t.
  by case: is_s => as_ _ _; rewrite (le_trans as_) // ler_pmul2l // ltW.
rewrite /positive_after; have [rat _|irr /= /andP[fac low]] := boolP (rational v).
  by move: st; rewrite (rational_value ok rat is_s at_ tb) ltxx.
have [c c0 eq] := poly_sign ok irr is_s at_ tb.
apply: (factors_gt0 fac); first by rewrite eq mulr_gt0 ?subr_gt0.
exact: (low_on_gt0 a0 d0 at_ tb low).
Qed.

Lemma positive_before_sound v g w s t : check_value v -> positive_before v g w -> is_value v s ->
  t < s -> toR (value_from v) <= toR (value_den v) * t -> 0 < eval g t.
Proof.
move=> ok + is_s ts at_; have [a0 _ d0 _] := value_parts ok.
have tb : toR (value_den v) * t <= toR (value_to v).
  by case: is_s => _ sb _; rewrite (le_trans _ sb) // ler_pmul2l // ltW.
rewrite /positive_before; have [rat _|irr /= /andP[fac low]] := boolP (rational v).
  by move: ts; rewrite (rational_value ok rat is_s at_ tb) ltxx.
have [c c0 eq] := poly_sign ok irr is_s at_ tb.
apply: (factors_gt0 fac); last exact: (low_on_gt0 a0 d0 at_ tb low).
rewrite eval_scale -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r eq -mulNr opprB.
by rewrite mulr_gt0 ?subr_gt0.
Qed.

Lemma moebius_cons l u c g : moebius l u (c :: g) =
  let: (numerator, power) := moebius l u g in
  let power' := mul_poly [:: l.2; u.2] power in
  (add_poly (scale_poly c power') (mul_poly [:: l.1; u.1] numerator), power').
Proof. by []. Qed.

(* The substitution t = (l1 + u1 y) / (l2 + u2 y). *)
Lemma moebiusE l u g t y :
  t * (toR l.2 + y * toR u.2) = toR l.1 + y * toR u.1 ->
  let: (numerator, power) := moebius l u g in
  eval power y = (toR l.2 + y * toR u.2) ^+ size g /\
  eval numerator y = eval power y * eval g t.
Proof.
move=> sub; elim: g => [|c g IH]; first by rewrite /= expr0 toR1 !mulr0 addr0.
have two (a b : Z) : eval [:: a; b] y = toR a + y * toR b by rewrite /= mulr0 addr0.
rewrite moebius_cons; case: (moebius l u g) IH => numerator power [eq_power eq_num].
cbv zeta beta iota; rewrite eval_add eval_scale !eval_mul !two eq_num -sub exprS -eq_power.
split=> //=; rewrite -/(eval g t).
by move: (toR l.2) (toR u.2) (toR c) (eval power y) (eval g t) => *; ring.
Qed.

Lemma eval_nonnegative p (y : R) : 0 <= y -> all (fun c => 0 <=? c)%Z p -> 0 <= eval p y.
Proof.
move=> y0; elim: p => //= c p IH /andP[c0 /IH p0].
by rewrite -/(eval p y) addr_ge0 ?toR_ge0 // mulr_ge0.
Qed.

Lemma eval_positive p (y : R) : 0 < y -> all (fun c => 0 <=? c)%Z p -> has (fun c => 0 <? c)%Z p ->
  0 < eval p y.
Proof.
move=> y0; elim: p => //= c p IH /andP[c0 p0] /orP[cp|/(IH p0) pp]; rewrite -/(eval p y).
  by rewrite ltr_paddr ?toR_gt0 // mulr_ge0 ?(ltW y0) // eval_nonnegative // ltW.
by rewrite ltr_paddl ?toR_ge0 // mulr_gt0.
Qed.

Lemma eval_head p (y : R) : 0 <= y -> all (fun c => 0 <=? c)%Z p -> (0 <? head 0%Z p)%Z ->
  0 < eval p y.
Proof.
move=> y0; case: p => //= c p /andP[_ p0] cp; rewrite -/(eval p y).
by rewrite ltr_paddr ?toR_gt0 // mulr_ge0 // eval_nonnegative.
Qed.

Lemma positive_on_sound open l u g t : positive_on open l u g ->
  0 < toR l.2 :> R -> 0 <= toR u.2 :> R ->
  (if open then toR l.1 < t * toR l.2 else toR l.1 <= t * toR l.2) ->
  t * toR u.2 < toR u.1 -> 0 < eval g t.
Proof.
move=> + l2 u2 lt tu; pose y := (t * toR l.2 - toR l.1) / (toR u.1 - t * toR u.2).
have den : 0 < toR u.1 - t * toR u.2 by rewrite subr_gt0.
have y0 : 0 <= y.
  by apply: divr_ge0 (ltW den); rewrite subr_ge0; case: open lt => // /ltW.
have sub : t * (toR l.2 + y * toR u.2) = toR l.1 + y * toR u.1.
  rewrite /y; move: den; move: (toR l.1) (toR l.2) (toR u.1) (toR u.2) => p q p' q' den.
  by field; rewrite gt_eqF.
have := moebiusE g sub; rewrite /positive_on; case: (moebius l u g) => numerator power.
case=> eq_power eq_num /andP[coefficients strict].
have pos : 0 < eval power y.
  by rewrite eq_power exprn_gt0 // ltr_paddr // mulr_ge0.
rewrite -(pmulr_rgt0 _ pos) -eq_num; case: open lt strict => [lt|_] strict.
  by apply: eval_positive => //; rewrite /y divr_gt0 // subr_gt0.
exact: eval_head.
Qed.

Lemma positive_between_sound open l cuts u g t : positive_between open l cuts u g ->
  0 < toR l.2 :> R -> 0 <= toR u.2 :> R ->
  (if open then toR l.1 < t * toR l.2 else toR l.1 <= t * toR l.2) ->
  t * toR u.2 < toR u.1 -> 0 < eval g t.
Proof.
elim: cuts open l => [|c cuts IH] open l /= ok l2 u2 lt tu.
  exact: (positive_on_sound ok l2 u2 lt tu).
case/and3P: ok => c2 first others; rewrite -(@toR_gt0 R) in c2.
have [tc|ct] := ltrP (t * toR c.2) (toR c.1).
  exact: (positive_on_sound first l2 (ltW c2) lt tc).
exact: (IH _ _ others c2 u2 ct tu).
Qed.

Lemma infinity_above (t : R) : t * toR infinity.2 < toR infinity.1.
Proof. by rewrite /= toR0 mulr0 toR1 ltr01. Qed.

Lemma after_value v t : (forall s, is_value v s -> s < t) -> check_value v ->
  exists2 s, is_value v s & s < t.
Proof. by move=> above ok; have [s is_s] := value_exists ok; exists s => //; apply: above. Qed.

Theorem positive_sound pl g e t : place_checked pl -> positive_in pl g e -> in_place pl t ->
  0 < eval g t.
Proof.
case: pl e => [v|v v'|v] [|w|n cuts n'] //=.
- move=> ok /andP[red low] [at_ tb root_t]; have [a0 _ d0 _] := value_parts ok.
  have [c0 eq] := reduces_byE red root_t.
  by rewrite -(pmulr_rgt0 _ c0) eq; exact: (low_on_gt0 a0 d0 at_ tb low).
- case/andP=> ok ok' /and3P[after before middle] [/after_value/(_ ok)[s is_s st] above].
  have [s' is_s'] := value_exists ok'; have ts' := above _ is_s'.
  have [a0 _ d0 _] := value_parts ok; have [_ _ d0' _] := value_parts ok'.
  have [tb|bt] := lerP (toR (value_den v) * t) (toR (value_to v)).
    exact: (positive_after_sound ok after is_s st tb).
  have [at'|ta'] := lerP (toR (value_from v')) (toR (value_den v') * t).
    exact: (positive_before_sound ok' before is_s' ts' at').
  by apply: (positive_between_sound middle); rewrite /= ?(ltW d0') // mulrC.
move=> ok /andP[after middle] /after_value/(_ ok)[s is_s st].
have [a0 _ d0 _] := value_parts ok.
have [tb|bt] := lerP (toR (value_den v) * t) (toR (value_to v)).
  exact: (positive_after_sound ok after is_s st tb).
by apply: (positive_between_sound middle); rewrite ?infinity_above //= ?toR0 // mulrC.
Qed.

Theorem zero_sound pl g e t : zero_in pl g e -> in_place pl t -> eval g t = 0.
Proof.
case: e => [|w|n cuts n']; case: pl => [v|v v'|v] //=; try by move/(eval_zero t).
case/andP=> red zero [_ _ root_t]; have [c0 eq] := reduces_byE red root_t.
by apply: (mulfI (lt0r_neq0 c0)); rewrite eq (eval_zero t zero) mulr0.
Qed.

End Sound.
