(* Systems with particles in contact with zero reaction (z), and exact claims about them.

   Such a particle touches the obstacle and is not pressed against it.  With v_N = n'v, v_T = t'v,
   w_N = n'w, w_T = t'w its lines of (9) are [zero_reaction]:

       v_N <= 0,   w_N <= 0,   v_N w_N = 0,   |w_T| + mu w_N <= 0,   |v_T| w_T = mu v_T w_N.

   [conditions_9z] are these and the lines of (9) for all others (System.v); without z particles
   they are [conditions_9].  As there, n has the friction factor of the particle as its length.

   A z particle has three variables in the pencil, behind those of the slip particles: gap, right
   and left.  They stand for -v_N > 0, v_T > 0 and v_T < 0.  [has_zero_support] says what a support
   and a list of biactive variables mean for v and w.

   The evidence of a claim is a motion v with its forces w, polynomials in t, as in Lifted.v; an
   exact claim, which gives x, is checked with the motion of x.  The signs of v_N, w_N, v_T,
   -w_T + mu w_N and w_T + mu w_N at the root show the lines of (9).

   Theorem [zero_sound]: if the claim is checked, then for some t in the interval the motion v(t)
   satisfies (9) with z particles, its forces are w(t), and it has the support and the biactive
   variables claimed.

   [zero_modes]: the lines of a z particle say that it opens, sticks or slips (table of Z.1).
   [zero_split]: they are three complementarity pairs with v_T = v+ - v- (Z.3), the variables and
   rows of the pencil of an exact claim.

   Pages: spec/zero-reaction.md, Z.1 and Z.3; spec/certificates.md, 5.3 and 5.4.
   Rust: crates/check/src/lifted_solution.rs, crates/model/src/reduction/eliminate.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Condensation Pencil Claim System Lifted.

(* The degrees of freedom of z particles are not free in [without_zero].  The sign and the geometric
   stiffness of a z particle are not used. *)
Record zero_system := ZeroSystem {
  without_zero : system;
  zero_particles : seq slip_particle }.

(* Reductions of n'v, n'w, t'v, -t'w + mu n'w and t'w + mu n'w, one for each z particle. *)
Record zero_claim := ZeroClaim {
  lifted_part : lifted;
  opening_reductions : seq reduction;
  pressure_reductions : seq reduction;
  sliding_reductions : seq reduction;
  right_reductions : seq reduction;
  left_reductions : seq reduction }.

Section Checker.

Variables (z : zero_system) (u : unknown) (c : zero_claim).

Notation s := (without_zero z).
Notation l := (lifted_part c).
Notation k := (motion_claim l).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation nobody := (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z.

Definition zero_particle j := nth nobody (zero_particles z) j.

Definition zero_dofs :=
  [seq first_dof p | p <- zero_particles z] ++ [seq second_dof p | p <- zero_particles z].

(* What moves: all but particles that stick. *)
Definition moving_with_zero := moving_dofs s ++ zero_dofs.

(* The variables of the j-th z particle. *)
Definition gap j := (free_number s + ns + 3 * j)%N.
Definition right j := (gap j).+1.
Definition left j := (gap j).+2.

Definition frame_wellformed p :=
  [&& inner (tangent p) (tangent p) =? unit_length s * unit_length s,
      0 <? inner (normal p) (normal p) & inner (tangent p) (normal p) =? 0]%Z.

Definition zero_wellformed :=
  [&& system_wellformed s u, uniq moving_with_zero,
      all (fun p => (first_dof p < dofs s) && (second_dof p < dofs s))%N (zero_particles z) &
      all frame_wellformed (zero_particles z)].

Definition with_sign sign p :=
  SlipParticle (first_dof p) (second_dof p) (tangent p) (normal p) sign 0.

Definition sliding_poly p := along_poly (tangent p) p (v_poly l).
Definition pressure_poly p := along_poly (normal p) p (w_poly l).

(* -t'w + mu n'w and t'w + mu n'w, times the denominator of mu *)
Definition right_poly p := cone_poly s u l (with_sign (-1) p).
Definition left_poly p := cone_poly s u l (with_sign 1 p).

(* The row of variable i is 0 or negative. *)
Definition row_state i g w :=
  if (i \in support k) || (i \in biactive k) then shows_zero k g w else shows_negative k g w.

Definition zero_states j :=
  let p := zero_particle j in
  let opening := witness (opening_reductions c) j in
  let sliding := witness (sliding_reductions c) j in
  [&& ~~ ((right j \in support k) && (left j \in support k)),
      if gap j \in support k then shows_negative k (normal_poly l p) opening
      else shows_zero k (normal_poly l p) opening,
      row_state (gap j) (pressure_poly p) (witness (pressure_reductions c) j),
      if right j \in support k then shows_positive k (sliding_poly p) sliding
      else if left j \in support k then shows_negative k (sliding_poly p) sliding
      else shows_zero k (sliding_poly p) sliding,
      row_state (right j) (right_poly p) (witness (right_reductions c) j) &
      row_state (left j) (left_poly p) (witness (left_reductions c) j)].

Definition zero_variables :=
  all (fun i => (free_number s <= i) && (i < free_number s + ns + 3 * nz))%N.

Definition check_zero :=
  [&& zero_wellformed, root_interval k, zero_variables (support k ++ biactive k),
      all (balanced s u l) (iota 0 (dofs s)), all (without_force l) (free_dofs s),
      all (fun d => (d \in moving_with_zero) || at_rest l d) (iota 0 (dofs s)),
      all (particle_states s u l) (iota 0 ns), all zero_states (iota 0 nz) &
      has (in_support s l) (iota 0 ns) || has (dof_moves l) (iota 0 (dofs s))].

End Checker.

(* Where mu is the unknown, all obstacles are flat. *)
Lemma zero_wellformed_flat z : zero_wellformed z Mu -> flat (without_zero z).
Proof. by case/and4P=> /wellformed_flat. Qed.

Lemma zero_wellformed_plain z : zero_wellformed z Mu -> zero_wellformed z (Lambda2 0 1).
Proof. by case/and4P=> /wellformed_plain ? ? ? ?; apply/and4P; split. Qed.

Section Statements.

Variable R : rcfType.

(* The lines of (9) for a z particle. *)
Definition zero_reaction (mu v_N v_T w_N w_T : R) :=
  [/\ v_N <= 0, w_N <= 0, v_N * w_N = 0,
      `|w_T| + mu * w_N <= 0 & `|v_T| * w_T = mu * v_T * w_N].

Variables (z : zero_system) (u : unknown).
Implicit Types (t : R) (v : nat -> R).

Notation s := (without_zero z).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).

Definition conditions_9z lambda2 mu v :=
  [/\ exists2 d, d \in all_dofs & v d != 0,
      forall d, d \in all_dofs -> d \notin moving_with_zero z -> v d = 0,
      forall d, d \in free_dofs s -> force s lambda2 v d = 0,
      forall j, (j < ns)%N -> let p := particle s j in
        [/\ along (normal p) p v = 0, slip_rate v p <= 0, cone s lambda2 mu v p <= 0 &
            cone s lambda2 mu v p * slip_rate v p = 0] &
      forall j, (j < nz)%N -> let p := zero_particle z j in let w := force s lambda2 v in
        zero_reaction mu (along (normal p) p v) (along (tangent p) p v)
                         (along (normal p) p w) (along (tangent p) p w)].

(* (9) with z particles and the unknown t >= 0. *)
Definition satisfies_9z t v := 0 <= t /\ conditions_9z (lambda2_of u t) (mu_of u t) v.

(* A row is zero on the support and where it is biactive, negative elsewhere. *)
Definition row_sign i (support biactive : seq nat) (y : R) : Prop :=
  if (i \in support) || (i \in biactive) then y = 0 else y < 0.

(* What z particles do after the event. *)
Definition has_zero_support (support biactive : seq nat) t v := forall j, (j < nz)%N ->
  let p := zero_particle z j in
  let w := force s (lambda2_of u t) v in
  let v_N := along (normal p) p v in
  let v_T := along (tangent p) p v in
  let w_N := along (normal p) p w in
  let w_T := along (tangent p) p w in
  let mu := mu_of u t in
  [/\ if gap z j \notin support then v_N = 0 else v_N < 0,
      row_sign (gap z j) support biactive w_N,
      if right z j \in support then left z j \notin support /\ 0 < v_T
      else if left z j \notin support then v_T = 0 else v_T < 0,
      row_sign (right z j) support biactive (- w_T + mu * w_N) &
      row_sign (left z j) support biactive (w_T + mu * w_N)].

(* The modes of a z particle: it opens, sticks, or slips against the sign S. *)
Definition opens (v_N w_N w_T : R) := [/\ v_N < 0, w_N = 0 & w_T = 0].

Definition sticks (mu v_N v_T w_N w_T : R) :=
  [/\ v_N = 0, v_T = 0, w_T + mu * w_N <= 0, - w_T + mu * w_N <= 0 & w_N <= 0].

Definition slips (S mu v_N v_T w_N w_T : R) :=
  [/\ v_N = 0, S * w_T + mu * w_N = 0, S * v_T < 0 & w_N <= 0].

Lemma cone_sides (a b : R) : (`|a| + b <= 0) = (a + b <= 0) && (- a + b <= 0).
Proof.
rewrite -!ler_subr_addr sub0r ler_norml andbC; congr (_ && _).
by rewrite ler_oppl.
Qed.

Theorem zero_modes (mu v_N v_T w_N w_T : R) : 0 <= mu ->
  zero_reaction mu v_N v_T w_N w_T <->
  [\/ opens v_N w_N w_T, sticks mu v_N v_T w_N w_T, slips 1 mu v_N v_T w_N w_T |
      slips (-1) mu v_N v_T w_N w_T].
Proof.
move=> mu0; rewrite /zero_reaction cone_sides; split.
  case=> vN wN vw /andP[left right] slip.
  have [vN0|vN_neg] := eqVneq v_N 0; last first.
    apply: Or41; split; first by rewrite lt_neqAle vN_neg.
      by move/eqP: vw; rewrite mulf_eq0 (negbTE vN_neg) => /eqP.
    move/eqP: vw left right; rewrite mulf_eq0 (negbTE vN_neg) => /eqP->.
    by rewrite mulr0 !addr0 oppr_le0 => a b; apply/eqP; rewrite eq_le a b.
  case: (ltrgtP v_T 0) => vT; last by apply: Or42.
    apply: Or43; split=> //; rewrite mul1r //.
    move: slip; rewrite ltr0_norm // => slip.
    apply: (mulfI (ltr0_neq0 vT)); rewrite mulr0 mulrDr.
    by rewrite [v_T * (_ * _)]mulrCA mulrA -slip mulNr subrr.
  apply: Or44; split=> //; rewrite mulN1r ?oppr_lt0 //.
  move: slip; rewrite gtr0_norm // => slip.
  apply: (mulfI (lt0r_neq0 vT)); rewrite mulr0 mulrDr.
  by rewrite [v_T * (_ * _)]mulrCA mulrA -slip mulrN addNr.
case=> [[vN -> ->]|[-> -> left right wN]|[-> line vT wN]|[-> line vT wN]].
- by rewrite !mulr0 oppr0 addr0 lexx ltW.
- by rewrite normr0 !mulr0 !mul0r left right.
- move: line vT; rewrite !mul1r => line vT.
  have wT : w_T = - (mu * w_N) by apply/eqP; rewrite -addr_eq0 line.
  rewrite line lexx wT opprK mul0r; split=> //.
    by rewrite -mulr2n pmulrn_lle0 // mulr_ge0_le0.
  by rewrite ltr0_norm // mulrNN mulrCA mulrA.
move: line vT; rewrite !mulN1r oppr_lt0 => line vT.
have wT : w_T = mu * w_N by apply/eqP; rewrite eq_sym -subr_eq0 addrC line.
rewrite line lexx wT mul0r andbT; split=> //.
  by rewrite -mulr2n pmulrn_lle0 // mulr_ge0_le0.
by rewrite gtr0_norm // mulrCA mulrA.
Qed.

(* 0 <= x _|_ y >= 0 *)
Definition pair (x y : R) := [/\ 0 <= x, 0 <= y & x * y = 0].

Theorem zero_split (mu v_N v_T w_N w_T : R) :
  zero_reaction mu v_N v_T w_N w_T <->
  exists v_right v_left : R,
    [/\ v_T = v_right - v_left, pair (- v_N) (- w_N),
        pair v_right (w_T - mu * w_N) & pair v_left (- w_T - mu * w_N)].
Proof.
rewrite /zero_reaction /pair cone_sides; split.
  case=> vN wN vw /andP[left right] slip.
  have gaps : [/\ 0 <= - v_N, 0 <= - w_N & - v_N * - w_N = 0] by rewrite !oppr_ge0 mulrNN.
  have rows : 0 <= w_T - mu * w_N /\ 0 <= - w_T - mu * w_N.
    by rewrite -[w_T in X in X /\ _]opprK -!opprD !oppr_ge0.
  case: rows => row_right row_left; case: (lerP v_T 0) => vT.
    exists 0, (- v_T); split; rewrite ?sub0r ?opprK //; split; rewrite ?mul0r ?oppr_ge0 //.
    move: slip; rewrite ler0_norm // => slip.
    transitivity (mu * v_T * w_N - - v_T * w_T); last by rewrite slip subrr.
    by move: (v_T) (w_T) (w_N) => *; ring.
  exists v_T, 0; split; rewrite ?subr0 //; split; rewrite ?mul0r // ?ltW //.
  move: slip; rewrite gtr0_norm // => slip.
  transitivity (v_T * w_T - mu * v_T * w_N); last by rewrite slip subrr.
  by move: (v_T) (w_T) (w_N) => *; ring.

case=> vr [vl [-> [vN wN vw] [vr0 row_right vr_row] [vl0 row_left vl_row]]].
split; rewrite -?oppr_ge0 ?opprD ?opprK ?row_right ?row_left //; first by rewrite -mulrNN.
have [vr_zero|vr_nz] := eqVneq vr 0.
  rewrite vr_zero sub0r normrN ger0_norm //; apply/eqP; rewrite -subr_eq0 -oppr_eq0 -vl_row.
  by apply/eqP; move: (w_T) (w_N) => *; ring.
have wT : w_T = mu * w_N.
  by apply/eqP; move/eqP: vr_row; rewrite mulf_eq0 (negbTE vr_nz) subr_eq0.
have [->|vl_nz] := eqVneq vl 0.
  by rewrite subr0 ger0_norm // wT; move: (w_N) => *; ring.
have : mu * w_N = 0.
  move/eqP: vl_row; rewrite mulf_eq0 (negbTE vl_nz) wT -opprD oppr_eq0 /= -mulr2n.
  by rewrite mulrn_eq0 => /eqP.
by rewrite wT mulrAC => ->; rewrite mulr0 mul0r.
Qed.

End Statements.

Section Sound.

Variables (R : rcfType) (z : zero_system) (u : unknown) (c : zero_claim).

Notation s := (without_zero z).
Notation l := (lifted_part c).
Notation k := (motion_claim l).
Notation ns := (size (particles s)).
Notation nz := (size (zero_particles z)).
Notation all_dofs := (iota 0 (dofs s)).

Hypothesis checked : check_zero z u c.

Lemma zero_parts :
  [/\ zero_wellformed z u, root_interval k & forall i, i \in all_dofs -> balanced s u l i] /\
  [/\ forall i, i \in free_dofs s -> without_force l i,
      forall i, i \in all_dofs -> i \notin moving_with_zero z -> at_rest l i,
      forall j, (j < ns)%N -> particle_states s u l j,
      forall j, (j < nz)%N -> zero_states z u c j &
      has (in_support s l) (iota 0 ns) || has (dof_moves l) all_dofs].
Proof.
case/and5P: checked => wf interval _ /allP bal /and5P[/allP free /allP rest /allP ps /allP zs nz].
split; split=> //.
- by move=> i Hi /negbTE out; have := rest _ Hi; rewrite /= out.
- by move=> j lt_j; apply: ps; rewrite mem_iota.
by move=> j lt_j; apply: zs; rewrite mem_iota.
Qed.

Lemma zero_dofs_in j : (j < nz)%N ->
  first_dof (zero_particle z j) \in all_dofs /\ second_dof (zero_particle z j) \in all_dofs.
Proof.
have [[/and4P[_ _ in_range _] _ _] _] := zero_parts => lt_j.
have /(all_nthP (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z)/(_ _ lt_j) := in_range.
by rewrite !mem_iota => /andP[].
Qed.

Section AtRoot.

Variable t : R.
Hypothesis at_ : toR (claim_from k) <= toR (claim_denominator k) * t.
Hypothesis tb : toR (claim_denominator k) * t <= toR (claim_to k).
Hypothesis root_t : eval (modulus k) t = 0.

Lemma row_state_sign i g w : row_state c i g w ->
  row_sign i (support k) (biactive k) (eval g t).
Proof.
have [[_ interval _] _] := zero_parts; rewrite /row_state /row_sign; case: ifP => _.
  exact: (zero_at root_t).
exact: (negative_at interval at_ tb root_t).
Qed.

(* A row whose polynomial is a positive multiple. *)
Lemma row_sign_factor i support biactive (f y : R) : 0 < f ->
  row_sign i support biactive (f * y) -> row_sign i support biactive y.
Proof.
move=> f0; rewrite /row_sign; case: ifP => _; last by rewrite pmulr_rlt0.
by move/eqP; rewrite mulf_eq0 gt_eqF //= => /eqP.
Qed.

Lemma row_sign_le0 i support biactive (y : R) : row_sign i support biactive y -> y <= 0.
Proof. by rewrite /row_sign; case: ifP => _ => [->|/ltW]. Qed.

Lemma row_sign_support i support biactive (y : R) :
  i \in support -> row_sign i support biactive y -> y = 0.
Proof. by rewrite /row_sign => ->. Qed.

Lemma zero_states_at : has_zero_support z u (support k) (biactive k) t (v_at l t).
Proof.
have [[/and4P[wf _ _ _] interval bal] [_ _ _ states _]] := zero_parts.
move=> j lt_j p w v_N v_T w_N w_T mu; have [first second] := zero_dofs_in lt_j.
have alongE e : eval (along_poly e p (v_poly l)) t = along e p (v_at l t).
  by rewrite eval_along.
have along_w e : eval (along_poly e p (w_poly l)) t = along e p w.
  by rewrite eval_along /w (along_force wf bal root_t).
have coneE sign : eval (cone_poly s u l (with_sign sign p)) t =
                  row_factor R u * (toR sign * w_T + mu * w_N).
  rewrite (cone_at wf bal root_t) //; last exact: flat_turns.
  by rewrite /cone turning_at_flat // mul0r addr0.
have f0 := row_factor_gt0 R wf.
have negative := negative_at interval at_ tb root_t.
have positive := positive_at interval at_ tb root_t.
have zero := zero_at root_t.

case/and5P: (states _ lt_j) => both opening pressing sliding /andP[row_right row_left].
split.
- by move: opening; rewrite -/p; case: ifP => _ => [/negative|/zero]; rewrite alongE.
- by rewrite /w_N -along_w; apply: row_state_sign pressing.
- move: both sliding; rewrite -/p /sliding_poly; case: ifP => _ /=.
    by move=> out /positive; rewrite alongE.
  by move=> _; case: ifP => _ => [/negative|/zero]; rewrite alongE.
- apply: (row_sign_factor f0); move/row_state_sign: row_right.
  by rewrite /right_poly coneE -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r.
apply: (row_sign_factor f0); move/row_state_sign: row_left.
by rewrite /left_poly coneE toR1 mul1r.
Qed.

End AtRoot.

(* A support and its signs give the lines of (9). *)
Lemma zero_lines support biactive (t : R) v : has_zero_support z u support biactive t v ->
  forall j, (j < nz)%N -> let p := zero_particle z j in let w := force s (lambda2_of u t) v in
    zero_reaction (mu_of u t) (along (normal p) p v) (along (tangent p) p v)
                              (along (normal p) p w) (along (tangent p) p w).
Proof.
move=> signs j lt_j p w; have [opening pressing sliding row_right row_left] := signs _ lt_j.
move: opening pressing sliding row_right row_left; rewrite -/p -/w.
move: (along (normal p) p v) (along (normal p) p w) (along (tangent p) p v).
move: (along (tangent p) p w) (mu_of u t) => w_T mu v_N w_N v_T.
rewrite /zero_reaction cone_sides => opening pressing sliding row_right row_left.
split.
- by case: ifP opening => _ => [->|/ltW].
- exact: row_sign_le0 pressing.
- case: ifP opening => [_ ->|/negbFE in_gap _]; first by rewrite mul0r.
  by rewrite (row_sign_support in_gap pressing) mulr0.
- by rewrite (row_sign_le0 row_right) (row_sign_le0 row_left).
case: ifP sliding => [in_right [_ vT]|_].
  have := row_sign_support in_right row_right.
  by rewrite addrC => /eqP; rewrite subr_eq0 => /eqP<-; rewrite gtr0_norm // mulrCA mulrA.
case: ifP => [_ ->|/negbFE in_left vT]; first by rewrite normr0 mulr0 !mul0r.
have := row_sign_support in_left row_left => /eqP; rewrite addr_eq0 => /eqP->.
by rewrite ltr0_norm // mulrNN mulrCA mulrA.
Qed.

Theorem zero_sound : exists t : R,
  [/\ toR (claim_from k) <= toR (claim_denominator k) * t /\
      toR (claim_denominator k) * t <= toR (claim_to k),
      satisfies_9z z u t (v_at l t),
      forall i, i \in all_dofs -> force s (lambda2_of u t) (v_at l t) i = w_at l t i,
      has_support s u (support k) (biactive k) t (v_at l t) &
      has_zero_support z u (support k) (biactive k) t (v_at l t)].
Proof.
have [[/and4P[wf _ _ _] interval bal] [free rest states _ nonzero]] := zero_parts.
have [a0 _ d0 _] := interval_parts R interval.
have [t [at_ tb root_t]] := modulus_root R interval.
have [lines signs] := slip_lines wf interval bal at_ tb root_t states.
have zero_signs := zero_states_at at_ tb root_t.

exists t; split=> //; last by move=> i Hi; apply: (balance wf bal root_t).
split; first by rewrite -(pmulr_rge0 _ d0); apply: le_trans at_.
split=> //; last exact: zero_lines zero_signs.
- exact: (something_moves wf interval bal at_ tb root_t states (fun i => id)).
- by move=> i Hi out; apply: (zero_at root_t (rest _ Hi out)).
move=> i Hi; have i_in : i \in all_dofs by apply: (moving_dof_in wf); rewrite mem_cat Hi.
by rewrite (balance wf bal root_t) //; exact: (zero_at root_t (free _ Hi)).
Qed.

End Sound.

(* Without z particles (9) is that of System.v. *)
Lemma no_zero_particles (R : rcfType) s (lambda2 mu : R) v :
  conditions_9z (ZeroSystem s [::]) lambda2 mu v <-> conditions_9 s lambda2 mu v.
Proof.
by rewrite /conditions_9z /conditions_9 /moving_with_zero /zero_dofs /= cats0; split=> -[].
Qed.

(* A lifted claim about a system without z particles. *)
Definition check_lifted s u l :=
  check_zero (ZeroSystem s [::]) u (ZeroClaim l [::] [::] [::] [::] [::]).

Corollary lifted_sound (R : rcfType) s u l : check_lifted s u l -> exists t : R,
  [/\ toR (claim_from (motion_claim l)) <= toR (claim_denominator (motion_claim l)) * t /\
      toR (claim_denominator (motion_claim l)) * t <= toR (claim_to (motion_claim l)),
      satisfies_9 s u t (v_at l t),
      forall i, i \in iota 0 (dofs s) -> force s (lambda2_of u t) (v_at l t) i = w_at l t i &
      has_support s u (support (motion_claim l)) (biactive (motion_claim l)) t (v_at l t)].
Proof.
move=> checked; have [t [bt [t0 /no_zero_particles sat] forces sup _]] := zero_sound R checked.
by exists t; split=> //; apply/satisfies_9E.
Qed.
