(* One motion of the rate problem: T(mu) is definite.

   With the contact states of a body held, a load that grows at the rate f moves it by rates v with

       w = K v - f,   w = 0 at free dofs,   v = 0 at what sticks,   n'v = 0,
       S t'v <= 0,    S t'w + mu n'w <= 0,   (S t'v) (S t'w + mu n'w) = 0.

   For two such motions the difference d has (S t'd) (S t'Kd + mu n'Kd) <= 0 at each slip particle:
   in the variables of the pencil x_i (T(mu) x)_i <= 0 for every complementarity variable, with
   T(mu) x = 0 in the free rows.  So if the condensed pencil is definite at both ends of an interval
   (Signed.v), T(mu) is a P-matrix for every mu between them, and d = 0.

   Theorem [rates_sound]: if the check succeeds, there is at most one such motion for each f and
   each mu of the interval.

   Page: spec/certificates.md, 5.9 ("What more it says").  Rust: crates/check/src/lib.rs,
   [has_unique_rates]. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Definite Signed Condensation
  Pencil System ZeroReaction ZeroPencil Rational Statement Integral.

Section Checker.

Local Open Scope Z_scope.

Definition check_rates (s : system) lo hi w f :=
  let Q := pencil_of s Mu in
  let D := blocks_of Q in
  let P := condensed D w in
  [&& system_wellformed s Mu, wellformed Q, free_rows_constant Q, check_elimination D w &
      [&& 0 <? lo.1, 0 <? lo.2, ordered lo hi & signed_between P lo hi f]].

(* The system without particles of zero reaction; the factors of Rational.v. *)
Definition check_given_rates c B lo hi w f :=
  [&& exact_system c B, nilp (with_zero B) & check_rates (scaled_system c B) lo hi w f].

End Checker.

Section Pencil.

Variables (R : rcfType) (Q : pencil) (w : elimination) (lo hi : point).
Variable f : signed_ends.
Notation D := (blocks_of Q).
Hypotheses (wf : wellformed Q) (constant : free_rows_constant Q) (elim : check_elimination D w).
Hypotheses (O : ordered lo hi) (between_ends : signed_between (condensed D w) lo hi f).

Lemma pencil_reversed_zero (t : R) x : between t lo hi ->
  (forall i, i \in free Q -> reaction Q t x i = 0) ->
  (forall i, i \in slip Q -> x i * reaction Q t x i <= 0) ->
  forall i, i \in iota 0 (order Q) -> x i = 0.
Proof.
move=> W rows_f rows_s; have /andP[positive shaped] := elim.
have xfE : forall k, k \in iota 0 (free_count D) ->
    free_of Q x k = free_part D (slip_of Q x) k.
  exact: (free_part_of_rows wf constant positive rows_f).
have xs0 j : j \in iota 0 (slip_count D) -> slip_of Q x j = 0.
  apply: (reversed_zero (condensation_encloses R positive shaped) O W between_ends) => i Hi.
  have lt_i : (i < size (slip Q))%N by move: Hi; rewrite mem_iota.
  rewrite (condensed_reaction wf w t lt_i xfE).
  have scale0 : 0 < scale_of R w i * toR (unit_of w) ^+ 2.
    by rewrite mulr_gt0 ?(scale_gt0 R shaped) // exprn_gt0 // (unit_gt0 R shaped).
  rewrite mulrCA pmulr_rle0 //.
  by apply: rows_s; apply: mem_nth.
move=> i /free_or_slip/orP[] /(nthP 0%N)[k lt_k <-].
  rewrite -/(free_of Q x k) xfE ?mem_iota // /free_part big_seq big1 ?oppr0 // => j /xs0->.
  by rewrite mulr0.
by rewrite -/(slip_of Q x k) xs0 // mem_iota.
Qed.

End Pencil.

Section System.

Variables (R : rcfType) (s : system) (lo hi : point) (w : elimination) (f : signed_ends).
Hypothesis checked : check_rates s lo hi w f.

Notation all_dofs := (iota 0 (dofs s)).
Notation ns := (size (particles s)).

Lemma system_reversed_zero (mu : R) v : between mu lo hi ->
  (forall d, d \in all_dofs -> d \notin moving_dofs s -> v d = 0) ->
  (forall d, d \in free_dofs s -> force s 0 v d = 0) ->
  (forall j, (j < ns)%N -> let p := particle s j in
     along (normal p) p v = 0 /\ cone s 0 mu v p * slip_rate v p <= 0) ->
  forall d, d \in all_dofs -> v d = 0.
Proof.
case/and5P: checked => wf wf_Q constant elim /and4P[_ _ O ends] W at_rest free_v slips.
pose x := variables_of s v.
have same : forall d, d \in all_dofs -> motion s x d = v d.
  by apply: (motion_restored wf) => // j /slips[].
have forceE d : force s 0 (motion s x) d = force s 0 v d.
  by rewrite /force; apply: sum_eq => j Hj; rewrite same.
have l0 := unit_length_gt0 R wf.
have x0 := pencil_reversed_zero wf_Q constant elim O ends W (x := x).
have zero : forall i, i \in iota 0 (order (pencil_of s Mu)) -> x i = 0.
  apply: x0 => [i|i /slip_variable[j lt_j ->]].
    rewrite free_variable => lt_i; rewrite (free_reaction wf) // forceE.
    by apply: free_v; apply: mem_nth.
  have [_ reversed] := slips _ lt_j.
  have reactionE : reaction (pencil_of s Mu) mu x (free_number s + j)%N =
      - cone s 0 mu v (particle s j).
    rewrite (slip_reaction wf) // /row_factor mul1r /cone.
    rewrite !turning_at_flat ?(flat_particle (wellformed_flat wf) lt_j) // !mul0r !addr0.
    by rewrite /along !forceE.
  have slideE : slip_rate v (particle s j) = - (toR (unit_length s) ^+ 2 * x (free_number s + j)%N).
    rewrite -(slip_motion wf) // /slip_rate /along.
    by rewrite (same _ (first_dof_in wf lt_j)) (same _ (second_dof_in wf lt_j)).
  rewrite -(pmulr_rle0 _ (exprn_gt0 2 l0)) reactionE; move: reversed; rewrite slideE.
  have -> // : forall a b c : R, a * (b * - c) = c * - (a * b) by move=> *; ring.
move=> d Hd; rewrite -same // /motion; case col: (column s d) => [[j c]|] //.
by rewrite zero ?mulr0 // mem_iota add0n; apply: column_in_range col.
Qed.

End System.

Section Given.

Variables (R : rcfType) (c : scales) (B : rational_system) (lo hi : point) (w : elimination).
Variable ends : signed_ends.
Hypothesis checked : check_given_rates c B lo hi w ends.

Notation s := (scaled_system c B).

Theorem rates_sound (mu : R) : between mu lo hi -> one_motion_of_rates B mu.
Proof.
case/and3P: checked => ex /nilP no_zero ok W.
have mu0 : 0 < mu.
  case/and5P: ok => _ _ _ _ /and4P[p0 q0 _ _]; case: W => le_mu _.
  have q0R : 0 < toR lo.2 :> R by rewrite toR_gt0.
  by rewrite -(pmulr_lgt0 _ q0R); apply: lt_le_trans le_mu; rewrite toR_gt0.
have is_flat : flat_body B.
  by rewrite -(flat_scaled ex); case/and5P: ok => /wellformed_flat.
split=> // f v v' [stuck free slips] [stuck' free' slips'] d Hd.
pose e i := v i - v' i.
have forceE i : force_of B 0 e i = force_of B 0 v i - force_of B 0 v' i.
  by rewrite /force_of /product -sumrB; apply: eq_bigr => k _; rewrite mulrBr.
have [C0 L0] := scales_gt0 R ex.
apply/eqP; rewrite -subr_eq0; apply/eqP; apply: (system_reversed_zero ok W (v := e)) => //.
- move=> i Hi out; rewrite /e.
  have stick : i \in dofs_of [seq p <- given_particles B | sticks p].
    by rewrite -(stick_scaled ex Hi) (without_zero_scaled c no_zero) /moving_with_zero cats0.
  by rewrite stuck // stuck' // subrr.
- move=> i; rewrite mem_filter => /andP[out Hi]; rewrite (force_scaled ex) forceE.
  have /eqP := free i Hi out; have /eqP := free' i Hi out; rewrite !subr_eq0 => /eqP-> /eqP->.
  by rewrite subrr mulr0.
move=> j; rewrite size_map => lt_j p; have [eq_k ex_p] := slip_scaled ex lt_j.
have [n0 a0 b0 ab] := slips j lt_j; have [n1 a1 b1 ab1] := slips' j lt_j.
pose q := slip_at B j.
have tangentialE (g h : nat -> R) :
    tangential q (fun i => g i - h i) = tangential q g - tangential q h.
  by rewrite /tangential; move: (fraction _ _) (fraction _ _) => *; ring.
have normalE (g h : nat -> R) : normal_to q (fun i => g i - h i) = normal_to q g - normal_to q h.
  by rewrite /normal_to; move: (fraction _ _) (fraction _ _) (toR _) => *; ring.
rewrite /p eq_k normal_scaled // normalE n0 n1 subrr mulr0; split=> //.
rewrite (cone_scaled ex) // slip_rate_scaled // -/q tangentialE.
pose cone g := toR (sign q) * tangential q g + fraction R (factor_of q) * mu * normal_to q g.
have -> : cone_of B 0 mu e q =
    cone (fun i => force_of B 0 v i - f i) - cone (fun i => force_of B 0 v' i - f i).
  have -> : cone_of B 0 mu e q = cone (fun i => force_of B 0 v i - force_of B 0 v' i).
    by rewrite (flat_cone _ _ _ is_flat lt_j) /cone /tangential /normal_to !forceE.
  by rewrite /cone !tangentialE !normalE; move: (tangential _ _) => *; ring.
rewrite -/(cone _) in b0 ab; rewrite -/(cone _) in b1 ab1.
have split_product (a l x x' g y y' : R) : a * l * (x - x') * (l * (g * (y - y'))) =
    a * l * l * (x * (g * y) + x' * (g * y') - (x * (g * y') + x' * (g * y))) by ring.
rewrite split_product (pmulr_rle0 _ (mulr_gt0 (mulr_gt0 C0 L0) L0)) ab ab1 addr0 sub0r oppr_le0.
by apply: addr_ge0; apply: mulr_le0.
Qed.

End Given.
