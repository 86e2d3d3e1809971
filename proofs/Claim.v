(* Exact solution claims: a solution whose components are polynomials in an algebraic number.

   A claim gives a polynomial p, an interval [a/d, b/d] with 0 <= a <= b, and for each variable i of
   the pencil a polynomial x_i; all have integer coefficients, constant term first.  p changes its
   sign on the interval, so it has a root t there.  For each polynomial g that matters, a witness
   (c, q, r) with c > 0 shows

       c g = p q + r,      hence c g(t) = r(t);

   r = 0 shows g(t) = 0, and a positive lower end of interval Horner of r shows g(t) > 0.

   Theorem [claim_sound]: if the claim is checked, then the pencil has a solution (t, x) with t in
   the interval; x_i > 0 on the support, x_i = 0 for the other complementarity variables, and of
   these y_i = 0 for the biactive ones and y_i > 0 for the rest.

   That p has no other root in the interval is not needed for this statement.

   Page: spec/certificates.md, 5.3.  Rust: crates/check/src/exact_solution.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Root Existence Condensation Pencil.

Definition polynomial := seq Z.

(* c g = p q + r *)
Record reduction := Reduction { multiplier : Z; quotient : polynomial; rest : polynomial }.

Record claim := Claim {
  modulus : polynomial;
  claim_from : Z;
  claim_to : Z;
  claim_denominator : Z;
  support : seq nat;
  biactive : seq nat;
  components : seq polynomial;
  component_reductions : seq reduction;
  reaction_reductions : seq reduction }.

Section Checker.

Local Open Scope Z_scope.

Definition scale_poly (c : Z) (p : polynomial) : polynomial := [seq c * a | a <- p].

Fixpoint add_poly (p q : polynomial) : polynomial :=
  match p, q with
  | a :: p', b :: q' => a + b :: add_poly p' q'
  | [::], _ => q
  | _, [::] => p
  end.

Definition mul_poly (p q : polynomial) : polynomial :=
  foldr (fun a product => add_poly (scale_poly a q) (0 :: product)) [::] p.

Definition zero_poly (p : polynomial) := all (fun a => a =? 0) p.

(* For a <= d t <= b and 0 <= a: an interval that contains d^n p(t), n the length of p, and d^n. *)
Fixpoint horner_interval (a b d : Z) (p : polynomial) : Z * Z * Z :=
  match p with
  | [::] => (0, 0, 1)
  | c :: p' =>
      let: (lo, hi, power) := horner_interval a b d p' in
      let constant := c * (power * d) in
      ((if 0 <=? lo then a * lo else b * lo) + constant,
       (if 0 <=? hi then b * hi else a * hi) + constant, power * d)
  end.

Definition low_on a b d p := (horner_interval a b d p).1.1.
Definition high_on a b d p := (horner_interval a b d p).1.2.

(* p has opposite signs at a/d and b/d. *)
Definition changes_sign a b d p :=
  (high_on a a d p <=? 0) && (0 <=? low_on b b d p) ||
  (0 <=? low_on a a d p) && (high_on b b d p <=? 0).

Definition same_poly (p q : polynomial) := zero_poly (add_poly p (scale_poly (-1) q)).

Definition reduces_by p g (w : reduction) :=
  (0 <? multiplier w) &&
  same_poly (scale_poly (multiplier w) g) (add_poly (mul_poly p (quotient w)) (rest w)).

(* c x + y *)
Fixpoint add_multiple (c : Z) (x y : seq Z) : seq Z :=
  match x, y with
  | [::], _ => y
  | a :: x', [::] => c * a :: add_multiple c x' [::]
  | a :: x', b :: y' => c * a + b :: add_multiple c x' y'
  end.

(* A sparse row times the matrix of these rows, or times a vector of polynomials. *)
Definition combine_row (x : seq polynomial) (row : sparse_row) : polynomial :=
  foldr (fun e sum => add_multiple e.2 (nth [::] x e.1) sum) [::] row.

Variable Q : pencil.

(* y_i as a polynomial in t. *)
Definition row_poly x i : polynomial :=
  add_poly (combine_row x (row_a Q i)) (0 :: combine_row x (row_b Q i)).

Variable k : claim.

Notation a := (claim_from k).
Notation b := (claim_to k).
Notation d := (claim_denominator k).

(* 0 <= a/d <= b/d, with a root of the modulus between them. *)
Definition root_interval := [&& 0 <=? a, a <=? b, 0 <? d & changes_sign a b d (modulus k)].

Definition no_reduction := Reduction 1 [::] [::].

Notation reduces := (reduces_by (modulus k)).

Definition shows_zero g w := reduces g w && zero_poly (rest w).
Definition shows_positive g w := reduces g w && (0 <? low_on a b d (rest w)).
Definition shows_negative g w := reduces g w && (high_on a b d (rest w) <? 0).

Definition component i := nth [::] (components k) i.

Definition reaction_poly i := row_poly (components k) i.

Definition component_witness i := nth no_reduction (component_reductions k) i.
Definition reaction_witness i := nth no_reduction (reaction_reductions k) i.

Definition x_zero i := shows_zero (component i) (component_witness i).
Definition x_positive i := shows_positive (component i) (component_witness i).
Definition x_negative i := shows_negative (component i) (component_witness i).
Definition y_zero i := shows_zero (reaction_poly i) (reaction_witness i).
Definition y_positive i := shows_positive (reaction_poly i) (reaction_witness i).

Definition columns_in_order :=
  all (fun row => all (fun e => e.1 < order Q)%N row) (rows_a Q) &&
  all (fun row => all (fun e => e.1 < order Q)%N row) (rows_b Q).

Definition check_claim :=
  [&& wellformed Q, columns_in_order, root_interval,
      all (fun i => y_zero i) (free Q),
      all (fun i => i \in slip Q) (support k ++ biactive k),
      all (fun i => if i \in support k then [&& x_positive i, y_zero i & i \notin biactive k]
                    else x_zero i && (if i \in biactive k then y_zero i else y_positive i))
        (slip Q) &
      has (fun i => i \in support k) (slip Q) ||
      has (fun i => x_positive i || x_negative i) (free Q)].

End Checker.

Lemma columns_in_rows Q : columns_in_order Q -> forall i,
  all (fun e => e.1 < order Q)%N (row_a Q i) /\ all (fun e => e.1 < order Q)%N (row_b Q i).
Proof.
case/andP=> /allP ca /allP cb i; rewrite /row_a /row_b; split.
  by have [l|l] := ltnP i (size (rows_a Q)); [apply/ca/mem_nth | rewrite nth_default].
by have [l|l] := ltnP i (size (rows_b Q)); [apply/cb/mem_nth | rewrite nth_default].
Qed.

Lemma add_multipleE c x y : add_multiple c x y = add_poly (scale_poly c x) y.
Proof. by elim: x y => [|a x IH] [|b y] //=; rewrite IH //; case: (x) {IH}. Qed.

Lemma nth_add_multiple a x y p :
  nth 0%Z (add_multiple a x y) p = (a * nth 0 x p + nth 0 y p)%Z.
Proof.
elim: x y p => [|b x IH] [|b' y] [|p] /=; rewrite ?nth_nil ?Z.mul_0_r ?Z.add_0_r //.
by rewrite IH nth_nil Z.add_0_r.
Qed.

Section Sound.

Variable R : rcfType.

Lemma nth_combine_row Y row p : toR (nth 0%Z (combine_row Y row) p) =
  \sum_(e <- row) toR e.2 * toR (nth 0%Z (nth [::] Y e.1) p) :> R.
Proof.
elim: row => [|e row IH] /=; first by rewrite big_nil nth_nil.
by rewrite nth_add_multiple toRD toRM big_cons IH.
Qed.

(* The value of a polynomial. *)
Definition eval (p : polynomial) (t : R) := foldr (fun a s => toR a + t * s) 0 p.

Lemma eval_scale c p t : eval (scale_poly c p) t = toR c * eval p t.
Proof.
elim: p => [|a p IH] /=; first by rewrite mulr0.
by rewrite -/(eval _ t) IH toRM -/(eval p t); move: (eval p t) (toR c) (toR a) => *; ring.
Qed.

Lemma eval_add p q t : eval (add_poly p q) t = eval p t + eval q t.
Proof.
elim: p q => [|a p IH] [|b q] /=; rewrite ?add0r ?addr0 //.
rewrite -/(eval _ t) IH toRD -/(eval p t) -/(eval q t).
by move: (eval p t) (eval q t) (toR a) (toR b) => *; ring.
Qed.

Lemma eval_mul p q t : eval (mul_poly p q) t = eval p t * eval q t.
Proof.
elim: p => [|a p IH] /=; first by rewrite mul0r.
rewrite eval_add eval_scale /= -/(mul_poly p q) -/(eval _ t) IH toR0 -/(eval p t).
by move: (eval p t) (eval q t) (toR a) => *; ring.
Qed.

Lemma eval_zero p t : zero_poly p -> eval p t = 0.
Proof.
elim: p => //= a p IH /andP[/Z.eqb_spec-> /IH]; rewrite /eval => ->.
by rewrite toR0 mulr0 addr0.
Qed.

Lemma same_polyE p q t : same_poly p q -> eval p t = eval q t.
Proof.
move=> /(eval_zero t); rewrite eval_add eval_scale -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r.
by move/eqP; rewrite subr_eq0 => /eqP.
Qed.

Lemma reduces_byE p g w t : reduces_by p g w -> eval p t = 0 ->
  0 < toR (multiplier w) :> R /\ toR (multiplier w) * eval g t = eval (rest w) t.
Proof.
case/andP=> c0 /(same_polyE t); rewrite eval_scale eval_add eval_mul => -> ->.
by rewrite mul0r add0r toR_gt0.
Qed.

(* (p(s) - p(t)) / (s - t) *)
Fixpoint slope (p : polynomial) s t : R :=
  if p is _ :: p' then eval p' s + t * slope p' s t else 0.

Lemma slopeE p s t : eval p s - eval p t = (s - t) * slope p s t.
Proof.
elim: p => [|c p IH] /=; first by rewrite subr0 mulr0.
rewrite -/(eval p s) -/(eval p t) mulrDr mulrCA -IH.
by move: (eval p s) (eval p t) (toR c) => *; ring.
Qed.

Lemma combine_rowE n x row t : all (fun e => e.1 < n)%N row ->
  eval (combine_row x row) t = \sum_(j <- iota 0 n) toR (lookup row j) * eval (nth [::] x j) t.
Proof.
move=> range; rewrite (sum_lookup _ range); elim: row {range} => [|e row IH] /=.
  by rewrite big_nil.
by rewrite big_cons add_multipleE eval_add eval_scale IH.
Qed.

Lemma row_polyE Q x t i : columns_in_order Q ->
  eval (row_poly Q x i) t = reaction Q t (fun j => eval (nth [::] x j) t) i.
Proof.
move=> cols; have [ra rb] := columns_in_rows cols i.
rewrite /row_poly eval_add /= -/(eval _ t) toR0 add0r !(@combine_rowE (order Q)) //.
rewrite /reaction mulr_sumr -big_split /=; apply: eq_bigr => j _.
by rewrite /a_entry /b_entry mulrDl mulrA.
Qed.

(* The polynomial of the algebra library. *)
Definition to_poly (p : polynomial) : {poly R} :=
  foldr (fun a s => (toR a)%:P + 'X * s) 0 p.

Lemma horner_to_poly p t : (to_poly p).[t] = eval p t.
Proof.
elim: p => [|a p IH] /=; first by rewrite horner0.
by rewrite hornerD hornerC hornerM hornerX IH.
Qed.

Lemma product_lower (u e a b lo : R) : 0 <= a -> a <= u -> u <= b -> lo <= e ->
  (if 0 <= lo then a * lo else b * lo) <= u * e.
Proof.
move=> a0 au ub le; apply: (@le_trans _ _ (u * lo)); last first.
  by rewrite ler_wpmul2l // (le_trans a0).
case: (lerP 0 lo) => sign; first exact: ler_wpmul2r.
by rewrite ler_nmul2r.
Qed.

Lemma product_upper (u e a b hi : R) : 0 <= a -> a <= u -> u <= b -> e <= hi ->
  u * e <= (if 0 <= hi then b * hi else a * hi).
Proof.
move=> a0 au ub le; apply: (@le_trans _ _ (u * hi)).
  by rewrite ler_wpmul2l // (le_trans a0).
case: (lerP 0 hi) => sign; first exact: ler_wpmul2r.
by rewrite ler_nmul2r.
Qed.

Lemma horner_interval_sound (a b d : Z) p t :
  0 <= toR a :> R -> toR a <= toR d * t -> toR d * t <= toR b -> 0 < toR d :> R ->
  let: (lo, hi, power) := horner_interval a b d p in
  [/\ 0 < toR power :> R, toR lo <= toR power * eval p t & toR power * eval p t <= toR hi].
Proof.
move=> a0 at_ tb d0; elim: p => [|c p IH] /=.
  by rewrite toR1 toR0 mulr0; split; rewrite ?ltr01 ?lexx.
case: (horner_interval a b d p) IH => [[lo hi] power] [power0 le_lo le_hi].
rewrite -/(eval p t).
have valueE : toR (power * d)%Z * (toR c + t * eval p t) =
              toR d * t * (toR power * eval p t) + toR (c * (power * d))%Z.
  by rewrite !toRM; move: (toR power) (toR d) (toR c) (eval p t) => *; ring.
rewrite valueE !toRD !ler_add2r; split.
- by rewrite toRM mulr_gt0.
- have := product_lower a0 at_ tb le_lo; rewrite -(@toR_ge0 R).
  by case: (0 <= toR lo); rewrite toRM.
have := product_upper a0 at_ tb le_hi; rewrite -(@toR_ge0 R).
by case: (0 <= toR hi); rewrite toRM.
Qed.

(* Signs over an interval. *)
Lemma interval_signs a b d p t :
  0 <= toR a :> R -> 0 < toR d :> R -> toR a <= toR d * t -> toR d * t <= toR b ->
  [/\ (0 <=? low_on a b d p)%Z -> 0 <= eval p t, (high_on a b d p <=? 0)%Z -> eval p t <= 0,
      (0 <? low_on a b d p)%Z -> 0 < eval p t & (high_on a b d p <? 0)%Z -> eval p t < 0].
Proof.
move=> a0 d0 at_ tb; have := horner_interval_sound p a0 at_ tb d0; rewrite /low_on /high_on.
case: (horner_interval a b d p) => [[lo hi] power] [power0 le_lo le_hi] /=.
split; rewrite -?(@toR_ge0 R) -?(@toR_le0 R) -?(@toR_gt0 R) -?(@toR_lt0 R) => sign.
- by rewrite -(pmulr_rge0 _ power0); apply: le_trans le_lo.
- by rewrite -(pmulr_rle0 _ power0); apply: le_trans sign.
- by rewrite -(pmulr_rgt0 _ power0); apply: lt_le_trans le_lo.
- by rewrite -(pmulr_rlt0 _ power0); apply: le_lt_trans sign.
Qed.

Lemma low_on_gt0 a b d p t : 0 <= toR a :> R -> 0 < toR d :> R -> toR a <= toR d * t ->
  toR d * t <= toR b -> (0 <? low_on a b d p)%Z -> 0 < eval p t.
Proof. by move=> a0 d0 at_ tb; case: (interval_signs p a0 d0 at_ tb). Qed.

Lemma root_on a b d p :
  0 <= toR a :> R -> toR a <= toR b :> R -> 0 < toR d :> R -> changes_sign a b d p ->
  exists t : R, [/\ toR a <= toR d * t, toR d * t <= toR b & eval p t = 0].
Proof.
move=> a0 ab d0 sign; have at_end c : toR d * (toR c / toR d) = toR c :> R.
  by rewrite mulrC divfK // gt_eqF.
have signs c : toR a <= toR c :> R -> _ := fun ac => @interval_signs c c d p (toR c / toR d)
  (le_trans a0 ac) d0 (eq_ind_r (fun v => toR c <= v) (lexx _) (at_end c))
  (eq_ind_r (fun v => v <= toR c) (lexx _) (at_end c)).
have [a1 a2 _ _] := signs a (lexx _); have [b1 b2 _ _] := signs b ab.
have [t /andP[ta_t t_tb] /rootP root_t] :
    exists2 t, toR a / toR d <= t <= toR b / toR d & root (to_poly p) t.
  apply: root_between; first by rewrite ler_pmul2r ?invr_gt0.
  rewrite !horner_to_poly.
  by case/orP: sign => /andP[s1 s2]; [apply: mulr_le0_ge0 | apply: mulr_ge0_le0]; auto.
by exists t; rewrite -horner_to_poly -(at_end a) -(at_end b) !ler_pmul2l.
Qed.

(* Values at the root, for a claim with a root interval. *)
Section Interval.

Variable k : claim.
Hypothesis interval : root_interval k.

Notation a := (claim_from k).
Notation b := (claim_to k).
Notation d := (claim_denominator k).

Lemma interval_parts :
  [/\ 0 <= toR a :> R, toR a <= toR b :> R, 0 < toR d :> R & changes_sign a b d (modulus k)].
Proof. by case/and4P: interval => a0 ab d0 sign; rewrite toR_ge0 toR_le toR_gt0. Qed.

Lemma modulus_root : exists t : R,
  [/\ toR a <= toR d * t, toR d * t <= toR b & eval (modulus k) t = 0].
Proof. by have [a0 ab d0 sign] := interval_parts; apply: root_on. Qed.

Section AtRoot.

Variable t : R.
Hypotheses (at_ : toR a <= toR d * t) (tb : toR d * t <= toR b).
Hypothesis root_t : eval (modulus k) t = 0.

Lemma zero_sound g w : shows_zero k g w -> eval g t = 0.
Proof.
case/andP=> /reduces_byE/(_ root_t)[c0 eq] /(eval_zero t) r0.
by apply: (mulfI (lt0r_neq0 c0)); rewrite eq r0 mulr0.
Qed.

Lemma positive_sound g w : shows_positive k g w -> 0 < eval g t.
Proof.
have [a0 _ d0 _] := interval_parts.
case/andP=> /reduces_byE/(_ root_t)[c0 eq] sign; rewrite -(pmulr_rgt0 _ c0) eq.
by have [_ _ pos _] := interval_signs (rest w) a0 d0 at_ tb; apply: pos.
Qed.

Lemma negative_sound g w : shows_negative k g w -> eval g t < 0.
Proof.
have [a0 _ d0 _] := interval_parts.
case/andP=> /reduces_byE/(_ root_t)[c0 eq] sign; rewrite -(pmulr_rlt0 _ c0) eq.
by have [_ _ _ neg] := interval_signs (rest w) a0 d0 at_ tb; apply: neg.
Qed.

End AtRoot.

End Interval.

Section Claim.

Variables (Q : pencil) (k : claim).
Hypothesis checked : check_claim Q k.

Notation a := (claim_from k).
Notation b := (claim_to k).
Notation d := (claim_denominator k).

Lemma claim_parts :
  [/\ wellformed Q, columns_in_order Q, root_interval k &
      [/\ forall i, i \in free Q -> y_zero Q k i,
          forall i, i \in slip Q ->
            if i \in support k then [&& x_positive k i, y_zero Q k i & i \notin biactive k]
            else x_zero k i && (if i \in biactive k then y_zero Q k i else y_positive Q k i) &
          has (fun i => i \in support k) (slip Q) ||
          has (fun i => x_positive k i || x_negative k i) (free Q)]].
Proof. by case/and5P: checked => wf cols interval /allP yf /and3P[_ /allP xs nz]. Qed.

Section AtRoot.

Variable t : R.
Hypotheses (at_ : toR a <= toR d * t) (tb : toR d * t <= toR b).
Hypothesis root_t : eval (modulus k) t = 0.

Definition x_at i := eval (component k i) t.

Lemma reaction_polyE i : eval (reaction_poly Q k i) t = reaction Q t x_at i.
Proof. by have [_ cols _ _] := claim_parts; apply: row_polyE. Qed.

End AtRoot.

Theorem claim_sound : exists (t : R) x,
  [/\ toR a <= toR d * t, toR d * t <= toR b, solution Q t x &
      forall i, i \in slip Q ->
        [/\ i \in support k -> 0 < x i, i \notin support k -> x i = 0,
            i \notin support k -> i \in biactive k -> reaction Q t x i = 0 &
            i \notin support k -> i \notin biactive k -> 0 < reaction Q t x i]].
Proof.
have [wf cols interval [yf xs nz]] := claim_parts.
have [a0 ab d0 sign] := interval_parts interval.
have [t [at_ tb root_t]] := modulus_root interval.
exists t, (x_at t).
have support_signs i : i \in slip Q ->
    (i \in support k -> 0 < x_at t i) /\ (i \notin support k -> x_at t i = 0).
  move=> /xs; case: (i \in support k) => /andP[x_sign _]; split=> // _.
    exact: (positive_sound interval at_ tb root_t x_sign).
  exact: (zero_sound root_t x_sign).
have reaction_signs i : i \in slip Q -> i \notin support k ->
    (i \in biactive k -> reaction Q t (x_at t) i = 0) /\
    (i \notin biactive k -> 0 < reaction Q t (x_at t) i).
  move=> /xs + /negbTE ns; rewrite ns -reaction_polyE // => /andP[_].
  case: (i \in biactive k) => y_sign; split=> // _; first exact: (zero_sound root_t y_sign).
  exact: (positive_sound interval at_ tb root_t y_sign).
have on_support i : i \in slip Q -> i \in support k -> reaction Q t (x_at t) i = 0.
  by move=> /xs + i_s; rewrite i_s => /and3P[_ /(zero_sound root_t) <- _]; rewrite reaction_polyE.

split=> //; last first.
  move=> i Hi; have [pos zero] := support_signs _ Hi.
  by split=> // ns; have [] := reaction_signs _ Hi ns.

split.
- by rewrite -(pmulr_rge0 _ d0); apply: le_trans at_.
- case/orP: nz => /hasP[i Hi]; last first.
    move=> sign_i; exists i; first exact: (free_indices wf).
    case/orP: sign_i => sign_i.
      by rewrite gt_eqF // (positive_sound interval at_ tb root_t sign_i).
    by rewrite lt_eqF // (negative_sound interval at_ tb root_t sign_i).
  move=> in_support; exists i; first exact: slip_indices.
  by have [/(_ in_support) pos _] := support_signs _ Hi; rewrite gt_eqF.
- by move=> i /yf y0; rewrite -reaction_polyE //; apply: (zero_sound root_t y0).
move=> i Hi; have [pos zero] := support_signs _ Hi.
have [i_s|ns] := boolP (i \in support k).
  by rewrite on_support // mulr0 lexx; split=> //; apply/ltW/pos.
rewrite zero // mul0r lexx; split=> //; have [y_zero y_pos] := reaction_signs _ Hi ns.
by have [i_b|nb] := boolP (i \in biactive k); [rewrite y_zero | apply/ltW/y_pos].
Qed.

End Claim.

End Sound.
