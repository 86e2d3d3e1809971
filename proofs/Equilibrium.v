(* A body under loads: an equilibrium in given contact states.

   The conditions (1), (5), (7), with each candidate in the state that is given, are equations and
   strict inequalities, affine in the displacements u.  [equations] and [inequalities] write them as
   sparse rows over the degrees of freedom, with one more column for the constant; each row is made
   integral by one factor.  V is a list of integers, V_n > 0 behind the n degrees of freedom.

   Evidence is one of two:

   - exact: every equation vanishes at V, every inequality is positive there;
   - a box: with an integer matrix Y, G = M Y for the rows M of the equations, each row dominated by
     its diagonal, and an integer W >= 0

         |(M V)_i| <= (2 G_ii - sum_j |G_ij|) W.

     So there is z with |z_i| <= W and M (V + Y z) = 0.  Each inequality m has

         m V > sum_j |m_j| eps_j,        eps_j = W sum_i |Y_ji|,

     and is positive at V + Y z, which differs from V by at most eps.  Y has no row for the
     constant.

   Theorem [equilibrium_sound]: if the evidence is checked, then the body has an equilibrium in
   these states.

   Page: spec/certificates.md, 5.20.  Rust: crates/check/src/equilibrium.rs. *)

From Mceip Require Import Base Integers Sums Claim Covered Bounded Condensation EnclosedClaim System
  Rational Statement Integral.

Inductive equilibrium_evidence :=
  | ExactAt of seq Z
  | BoxAround of seq Z & matrix & Z.

Section Checker.

Local Open Scope Z_scope.

Definition dominated_row Y V W i row :=
  let g := combine_row Y row in
  (0 <? margin g i) && (Z.abs (sparse_dot row V) <=? margin g i * W).

Definition check_rows n (eqs ineqs : seq sparse_row) w :=
  match w with
  | ExactAt V => [&& 0 <? nth 0 V n, all (fun row => sparse_dot row V =? 0) eqs &
                     all (fun row => 0 <? sparse_dot row V) ineqs]
  | BoxAround V Y W =>
      let eps := [seq norm1 row * W | row <- Y] in
      [&& 0 <? nth 0 V n, (size Y <= n)%N, 0 <=? W, all_from (dominated_row Y V W) 0 eqs &
          all (fun row => absolute_dot row eps <? sparse_dot row V) ineqs]
  end.

Definition times_rational (a b : rational) : rational := (a.1 * b.1, a.2 * b.2).
Definition scaled_by a (row : rational_row) : rational_row :=
  [seq (e.1, times_rational a e.2) | e <- row].
Definition negated := scaled_by (-1, 1).

Variables (B : rational_body) (mu : rational) (amounts : seq rational) (states : seq stated).

Notation n := (body_degrees B).

Definition constant (q : rational) : rational_row := [:: (n, q)].

(* The entries at d of the loads, each times its amount. *)
Definition applied_row (part : load -> rational_row) (d : nat) : rational_row :=
  flatten [seq [seq (n, times_rational la.2 e.2) | e <- part la.1 & e.1 == d]
          | la <- zip (loads B) amounts].

Definition displacement_row d : rational_row := [:: (d, (1, 1))].
Definition reaction_row d := nth [::] (body_stiffness B) d ++ negated (applied_row forces_of d).

Definition tangential_row p (f : nat -> rational_row) :=
  scaled_by (frame_tangent p).1 (f (first_of p)) ++ scaled_by (frame_tangent p).2 (f (second_of p)).

Definition normal_row p (f : nat -> rational_row) := scaled_by (into_obstacle p, 1)
  (scaled_by (frame_normal p).1 (f (first_of p)) ++ scaled_by (frame_normal p).2 (f (second_of p))).

Definition pressure_row p := negated (normal_row p reaction_row).
Definition bound_row p := scaled_by mu (scaled_by (factor_of p) (pressure_row p)).

Definition equations_at (d : nat) :=
  if is_held B d then [:: displacement_row d ++ negated (applied_row displacements_of d)]
  else if touched B states d then [::] else [:: reaction_row d].

Definition state_equations (c : candidate) s :=
  let p := particle_of c in
  let touching := normal_row p displacement_row ++ negated (constant (gap_of c)) in
  let tangential := tangential_row p reaction_row in
  match s with
  | Apart => [::]
  | SticksAt place =>
      [:: touching; tangential_row p displacement_row ++ negated (constant place)]
  | SlipsWith sign => [:: touching; scaled_by (sign, 1) tangential ++ negated (bound_row p)]
  | WithoutReaction => [:: touching; normal_row p reaction_row; tangential]
  end.

Definition state_inequalities (c : candidate) s :=
  let p := particle_of c in
  let tangential := tangential_row p reaction_row in
  match s with
  | Apart => [:: constant (gap_of c) ++ negated (normal_row p displacement_row)]
  | SticksAt _ =>
      [:: pressure_row p; bound_row p ++ negated tangential; bound_row p ++ tangential]
  | SlipsWith _ => [:: pressure_row p]
  | WithoutReaction => [::]
  end.

Definition of_candidates (rows : candidate -> stated -> seq rational_row) :=
  flatten [seq rows c.1 c.2 | c <- zip (candidates B) states].

Definition equations :=
  flatten [seq equations_at d | d <- iota 0 n] ++ of_candidates state_equations.
Definition inequalities := of_candidates state_inequalities.

Definition positive_rational (q : rational) := (0 <? q.1) && (0 <? q.2).

Definition lawful (c : candidate * stated) := positive_rational (factor_of (particle_of c.1)) &&
  (if c.2 is SlipsWith sign then (sign =? 1) || (sign =? -1) else true).

Definition well_stated :=
  [&& positive_rational mu, size amounts == size (loads B), size states == size (candidates B),
      all (all (fun e => e.1 < n)%N) (body_stiffness B) & all lawful (zip (candidates B) states)].

Definition check_equilibrium (m : Z) w :=
  let eqs := equations in
  let ineqs := inequalities in
  [&& well_stated, 0 <? m, exact_rows m eqs, exact_rows m ineqs &
      check_rows n [seq scaled_row m row | row <- eqs] [seq scaled_row m row | row <- ineqs] w].

End Checker.

Section Rows.

Variable R : rcfType.

(* A row at a vector: of integers, of rationals. *)
Definition value_at (row : sparse_row) (w : nat -> R) := \sum_(e <- row) toR e.2 * w e.1.
Definition rational_at (row : rational_row) (w : nat -> R) :=
  \sum_(e <- row) fraction R e.2 * w e.1.

Lemma sparse_dot_value row V : toR (sparse_dot row V) = value_at row (fun j => toR (nth 0%Z V j)).
Proof.
elim: row => [|e row IH]; rewrite /value_at ?big_nil // big_cons /=.
by rewrite toRD toRM IH.
Qed.

Lemma value_scaled m row w : all (fun e => exact m e.2) row ->
  value_at (scaled_row m row) w = toR m * rational_at row w.
Proof.
elim: row => [|e row IH] /= => [_|/andP[ex rest]].
  by rewrite /value_at /rational_at !big_nil mulr0.
rewrite /value_at /rational_at !big_cons mulrDr; congr (_ + _); last exact: IH.
by rewrite /= scaled_fraction // -mulrA.
Qed.

Lemma fraction_times a b : fraction R (times_rational a b) = fraction R a * fraction R b.
Proof. by rewrite /fraction /= !toRM invfM mulrACA. Qed.

Lemma fraction_one : fraction R (1, 1)%Z = 1.
Proof. by rewrite /fraction /= toR1 divr1. Qed.

Lemma rational_cat r r' w : rational_at (r ++ r') w = rational_at r w + rational_at r' w.
Proof. by rewrite /rational_at big_cat. Qed.

Lemma rational_scaled a r w : rational_at (scaled_by a r) w = fraction R a * rational_at r w.
Proof.
rewrite /rational_at big_map mulr_sumr; apply: eq_bigr => e _.
by rewrite fraction_times -mulrA.
Qed.

Lemma rational_negated r w : rational_at (negated r) w = - rational_at r w.
Proof.
rewrite /negated rational_scaled /fraction /= -[(-1)%Z]/(Z.opp 1) toRN toR1 divr1.
exact: mulN1r.
Qed.

(* [check_rows] *)

(* Where the rows of integers have their signs: at w, with w_n > 0. *)
Definition solves_rows (eqs ineqs : seq sparse_row) (w : nat -> R) :=
  (forall row, row \in eqs -> value_at row w = 0) /\
  (forall row, row \in ineqs -> 0 < value_at row w).

Section Box.

Variables (eqs : seq sparse_row) (V : seq Z) (Y : matrix) (W : Z).
Hypotheses (W0 : (0 <=? W)%Z) (regular : all_from (dominated_row Y V W) 0 eqs).

Notation m := (size eqs).
Notation row p := (nth [::] eqs p).
Notation v j := (toR (nth 0%Z V j) : R).
Notation y j p := (toR (nth 0%Z (nth [::] Y j) p) : R).

Let G : 'M[R]_m := \matrix_(p, q) toR (nth 0%Z (combine_row Y (row p)) q).
Let g (p : 'I_m) : R := toR (margin (combine_row Y (row p)) p).
Let residual : 'cV[R]_m := \col_p value_at (row p) (fun j => v j).

Lemma regular_at (p : 'I_m) : 0 < g p /\ `|residual p 0| <= g p * toR W.
Proof.
have := all_from_nth [::] regular (ltn_ord p); rewrite add0n => /andP[g0 small].
rewrite /g toR_gt0; split=> //; rewrite mxE -sparse_dot_value -toR_abs -toRM toR_le.
exact: small.
Qed.

Lemma dominant_rows p : g p <= G p p *+ 2 - \sum_q `|G p q|.
Proof.
rewrite /g /margin toRB toRM mxE ler_sub //.
  by rewrite [toR 2%Z](_ : _ = 2%:R) // mulr_natl.
by under eq_bigr do rewrite mxE; apply: norm1_ge.
Qed.

(* M (V + Y z) = 0 for some z with entries of at most W. *)
Lemma box_solution : exists d : nat -> R, [/\ forall j, (size Y <= j)%N -> d j = 0,
  forall j, `|d j| <= toR (nth 0%Z [seq (norm1 r * W)%Z | r <- Y] j) &
  forall r, r \in eqs -> value_at r (fun j => v j + d j) = 0].
Proof.
have G_unit : G \in unitmx.
  by apply: dominant_unit dominant_rows => p; have [] := regular_at p.
pose z := invmx G *m (- residual); have Gz : G *m z = - residual by rewrite mulKVmx.
have WR : 0 <= toR W :> R by rewrite toR_ge0.
have small p : `|z p 0| <= toR W.
  apply: (dominant_bound _ dominant_rows WR _ Gz) => q; have [? le_q] := regular_at q => //.
  by rewrite mxE normrN.
exists (fun j => \sum_(p < m) y j p * z p 0); split=> [j out|j|r r_in].
- by rewrite big1 // => p _; rewrite [nth [::] Y j]nth_default // nth_nil mul0r.
- have [lt_j|out] := ltnP j (size Y); last first.
    rewrite big1 => [|p _]; first by rewrite normr0 nth_default ?size_map ?toR0.
    by rewrite [nth [::] Y j]nth_default // nth_nil mul0r.
  rewrite (nth_map [::]) // toRM (le_trans (ler_norm_sum _ _ _)) //.
  apply: le_trans (ler_wpmul2r WR (norm1_ge R (nth [::] Y j) m)); rewrite mulr_suml.
  by apply: ler_sum => p _; rewrite normrM ler_wpmul2l.
have lt_r : (index r eqs < m)%N by rewrite index_mem.
pose p := Ordinal lt_r; have rE : row p = r by rewrite /= nth_index.
have : (G *m z) p 0 = - residual p 0 by rewrite Gz mxE.
rewrite !mxE rE => Gz_p; rewrite /value_at; under eq_bigr do rewrite mulrDr.
rewrite big_split -/(value_at r _) /= -[X in X + _]opprK -Gz_p addrC; apply/eqP.
rewrite subr_eq0; apply/eqP; under eq_bigr do rewrite mulr_sumr.
rewrite exchange_big; apply: eq_bigr => q _; rewrite [G p q]mxE rE nth_combine_row mulr_suml.
by apply: eq_bigr => e _; rewrite mulrA.
Qed.

End Box.

Lemma checked_rows n eqs ineqs w : check_rows n eqs ineqs w ->
  exists2 x : nat -> R, 0 < x n & solves_rows eqs ineqs x.
Proof.
case: w => [V|V Y W] /=.
  case/and3P=> V0 /allP zero /allP pos; exists (fun j => toR (nth 0%Z V j)).
    by rewrite toR_gt0.
  split=> row row_in; rewrite -sparse_dot_value; last by rewrite toR_gt0 pos.
  by apply/eqP; rewrite toR_eq0 zero.
case/and5P=> V0 size_Y W0 reg /allP pos.
have [d [d0 small zero]] := box_solution W0 reg.
exists (fun j => toR (nth 0%Z V j) + d j); first by rewrite d0 // addr0 toR_gt0.
split=> // row row_in; rewrite /value_at; under eq_bigr do rewrite mulrDr.
rewrite big_split /= -/(value_at row (fun j => toR (nth 0%Z V j))) -sparse_dot_value.
rewrite -ltr_subl_addr sub0r.
have small_row : all (fun e => `|d e.1| <= toR (nth 0%Z [seq (norm1 r * W)%Z | r <- Y] e.1)) row.
  by apply/allP => e _; apply: small.
apply: le_lt_trans (le_trans (ler_norm _) _) _; rewrite ?normrN.
  exact: absolute_sum_ge small_row.
by rewrite toR_lt pos.
Qed.

End Rows.

Section Sound.

Variables (R : rcfType) (B : rational_body) (mu : rational) (amounts : seq rational).
Variable states : seq stated.

Notation n := (body_degrees B).
Notation columns_in_range := (all (all (fun e => e.1 < n)%N) (body_stiffness B)).

Section Vector.

Variable w : nat -> R.
Hypotheses (w_n : w n = 1) (columns : columns_in_range).
Hypothesis as_many : size amounts = size (loads B).

Notation at_w row := (rational_at row w).

Lemma constant_at q : at_w (constant B q) = fraction R q.
Proof. by rewrite /rational_at big_seq1 w_n mulr1. Qed.

Lemma displacement_at d : at_w (displacement_row d) = w d.
Proof. by rewrite /rational_at big_seq1 fraction_one mul1r. Qed.

Lemma applied_at part d : at_w (applied_row B amounts part d) = applied R B amounts part d.
Proof.
have sz : size (zip (loads B) amounts) = size (loads B) by rewrite size_zip as_many minnn.
rewrite /rational_at /applied_row big_flatten big_map (big_nth (Load [::] [::], (0, 1)%Z)) sz.
rewrite /applied /index_iota subn0; apply: sum_eq => l; rewrite mem_iota => /= lt_l.
rewrite nth_zip //= /given_entry (nth_map (Load [::] [::])) // big_map big_filter.
rewrite mulr_sumr [RHS](bigID (fun e => e.1 == d)) /= [X in _ = _ + X]big1 => [|e /negbTE->].
  by rewrite addr0; apply: eq_bigr => e ->; rewrite w_n mulr1 fraction_times.
by rewrite mulr0.
Qed.

Lemma stiffness_at d : at_w (nth [::] (body_stiffness B) d) =
  \sum_(j <- iota 0 n) given_entry R (body_stiffness B) d j * w j.
Proof.
have range : all (fun e => e.1 < n)%N (nth [::] (body_stiffness B) d).
  have [lt_d|out] := ltnP d (size (body_stiffness B)); last by rewrite nth_default.
  by have /allP := columns; apply; apply: mem_nth.
rewrite /given_entry; under eq_bigr do rewrite mulr_suml.
rewrite exchange_big /rational_at big_seq [RHS]big_seq; apply: eq_bigr => e e_row.
rewrite (bigD1_seq e.1) ?iota_uniq //=; last by rewrite mem_iota add0n (allP range).
by rewrite eqxx big1 ?addr0 // => k /negbTE; rewrite eq_sym => ->; rewrite mul0r.
Qed.

Lemma reaction_at d : at_w (reaction_row B amounts d) = reaction_of B amounts w d.
Proof. by rewrite /reaction_row rational_cat rational_negated stiffness_at applied_at. Qed.

Lemma tangential_at p f F : (forall d, at_w (f d) = F d) ->
  at_w (tangential_row p f) = tangential p F.
Proof. by move=> fE; rewrite rational_cat !rational_scaled !fE. Qed.

Lemma normal_at p f F : (forall d, at_w (f d) = F d) -> at_w (normal_row p f) = normal_to p F.
Proof.
by move=> fE; rewrite rational_scaled rational_cat !rational_scaled !fE /fraction /= toR1 divr1.
Qed.

Notation r := (reaction_of B amounts w).

Lemma pressure_at p : at_w (pressure_row B amounts p) = - normal_to p r.
Proof. by rewrite rational_negated (normal_at _ reaction_at). Qed.

Lemma bound_row_at p : at_w (bound_row B mu amounts p) =
  fraction R mu * fraction R (factor_of p) * - normal_to p r.
Proof. by rewrite /bound_row 2!rational_scaled pressure_at mulrA. Qed.

Lemma touching_at c : at_w (normal_row (particle_of c) displacement_row ++
    negated (constant B (gap_of c))) = normal_to (particle_of c) w - fraction R (gap_of c).
Proof. by rewrite rational_cat rational_negated constant_at (normal_at _ displacement_at). Qed.

(* The rows of a candidate say that it is in its state. *)
Lemma candidate_sound c s : 0 < fraction R mu -> lawful (c, s) ->
  (forall row, row \in state_equations B mu amounts c s -> at_w row = 0) ->
  (forall row, row \in state_inequalities B mu amounts c s -> 0 < at_w row) ->
  in_state mu c s w r.
Proof.
move=> mu0; rewrite /lawful /= => /andP[/andP[c1 c2] sign_s] zero pos.
have factor0 : 0 < fraction R (factor_of (particle_of c)) by rewrite divr_gt0 ?toR_gt0.
have tangential_r := tangential_at (particle_of c) reaction_at.
case: s sign_s zero pos => [|place|sign|] sign_s zero pos.
- have := pos _ (mem_head _ _); rewrite rational_cat rational_negated constant_at.
  by rewrite (normal_at _ displacement_at) subr_gt0.
- have := zero _ (mem_head _ _); rewrite touching_at => /eqP; rewrite subr_eq0 => /eqP touching.
  have := zero _ (mem_last _ _); rewrite rational_cat rational_negated constant_at.
  rewrite (tangential_at _ displacement_at) => /eqP; rewrite subr_eq0 => /eqP at_place.
  have := pos _ (mem_head _ _); rewrite pressure_at => pressed.
  have := pos (bound_row B mu amounts (particle_of c) ++
               negated (tangential_row (particle_of c) (reaction_row B amounts))).
  rewrite !inE eqxx orbT rational_cat rational_negated bound_row_at tangential_r => /(_ isT) right.
  have := pos _ (mem_last _ _); rewrite rational_cat bound_row_at tangential_r => left.
  split=> //; rewrite ltr_norml -subr_gt0 opprK addrC left /=.
  by rewrite -subr_gt0.
- have := zero _ (mem_head _ _); rewrite touching_at => /eqP; rewrite subr_eq0 => /eqP touching.
  have := zero _ (mem_last _ _); rewrite rational_cat rational_negated rational_scaled.
  rewrite bound_row_at tangential_r => /eqP; rewrite subr_eq0 => /eqP on_cone.
  have := pos _ (mem_head _ _); rewrite pressure_at => pressed.
  have bound0 := mulr_gt0 (mulr_gt0 mu0 factor0) pressed.
  have signE : fraction R (sign, 1)%Z = toR sign by rewrite /fraction /= toR1 divr1.
  rewrite signE in on_cone; split=> //; last by rewrite on_cone.
  rewrite -on_cone -[RHS]gtr0_norm ?on_cone // -on_cone normrM.
  suff -> : `|toR sign| = 1 :> R by rewrite mul1r.
  case/orP: sign_s => /Z.eqb_spec->; first by rewrite toR1 normr1.
  by rewrite -[(-1)%Z]/(Z.opp 1) toRN toR1 normrN1.
have := zero _ (mem_head _ _); rewrite touching_at => /eqP; rewrite subr_eq0 => /eqP touching.
have := zero (normal_row (particle_of c) (reaction_row B amounts)).
rewrite !inE eqxx orbT (normal_at _ reaction_at) => /(_ isT) no_pressure.
by have := zero _ (mem_last _ _); rewrite tangential_r.
Qed.

End Vector.

Theorem equilibrium_sound m e : check_equilibrium B mu amounts states m e ->
  has_equilibrium R B mu amounts states.
Proof.
case/and5P=> /and5P[/andP[mu1 mu2] /eqP as_many /eqP all_stated columns lawful_all] m0.
move=> exact_e exact_i /(checked_rows R)[x x_n [zero pos]].
have mu0 : 0 < fraction R mu by rewrite divr_gt0 ?toR_gt0.
have m0R : 0 < toR m :> R by rewrite toR_gt0.
pose w j := x j / x n; have w_n : w n = 1 by rewrite /w mulfV // gt_eqF.
have scaledE rows row : exact_rows m rows -> row \in rows ->
    value_at (scaled_row m row) x = toR m * x n * rational_at row w.
  move=> /allP ex row_in; rewrite value_scaled ?ex // -mulrA; congr (_ * _).
  rewrite /rational_at mulr_sumr; apply: eq_bigr => i _.
  by rewrite mulrCA /w [x n * _]mulrC divfK // gt_eqF.
have zero_w row : row \in equations B mu amounts states -> rational_at row w = 0.
  move=> row_in; have := zero _ (map_f _ row_in); rewrite (scaledE _ _ exact_e) // => /eqP.
  by rewrite !mulf_eq0 (gt_eqF m0R) (gt_eqF x_n) => /eqP.
have pos_w row : row \in inequalities B mu amounts states -> 0 < rational_at row w.
  move=> row_in; have := pos _ (map_f _ row_in); rewrite (scaledE _ _ exact_i) //.
  by rewrite (pmulr_rgt0 _ (mulr_gt0 m0R x_n)).
have at_degree d row : d \in iota 0 n -> row \in equations_at B amounts states d ->
    rational_at row w = 0.
  move=> d_in row_in; apply: zero_w; rewrite mem_cat; apply/orP; left.
  by apply/flatten_mapP; exists d.
split=> //; exists w; split=> [d d_in is_h|d d_in not_h not_t|j lt_j].
- have := at_degree _ _ d_in; rewrite /equations_at is_h => /(_ _ (mem_head _ _)).
  rewrite rational_cat rational_negated displacement_at applied_at // => /eqP.
  by rewrite subr_eq0 => /eqP.
- have := at_degree _ _ d_in; rewrite /equations_at (negbTE not_h) (negbTE not_t).
  by move=> /(_ _ (mem_head _ _)); rewrite reaction_at.
pose c := (candidate_at B j, state_at states j).
have sz : size (zip (candidates B) states) = size (candidates B).
  by rewrite size_zip all_stated minnn.
have cE : nth c (zip (candidates B) states) j = c.
  by rewrite -[RHS](nth_zip _ _ _ (esym all_stated)); apply: set_nth_default; rewrite sz.
have rows_in rows row : row \in rows c.1 c.2 -> row \in of_candidates B states rows.
  move=> row_in; apply/flattenP; exists (rows c.1 c.2) => //.
  by rewrite -cE -(nth_map c [::] (fun c => rows c.1 c.2)) ?sz // mem_nth // size_map sz.
apply: candidate_sound => //; first by rewrite -/c -cE; apply: all_nthP; rewrite // sz.
  by move=> row /rows_in row_in; apply: zero_w; rewrite mem_cat row_in orbT.
by move=> row /rows_in; apply: pos_w.
Qed.

End Sound.
