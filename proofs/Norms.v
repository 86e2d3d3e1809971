(* Euclidean norms without roots.

   [norm_le l z n] says that the vector z over the list of indices l has a Euclidean norm of at most
   n: 0 <= n and sum z_k^2 <= n^2.  Rules: the inequality of Cauchy and Schwarz ([dot_bound]), the
   triangle inequality ([norm_add]), multiples ([norm_scale]), and the bound of a bilinear form by
   the largest sum of a row or column ([bilinear_bound]).

   Page: spec/certificates.md, 5.14 (bounds of the remainders).
   Rust: crates/check/src/cover/expanded.rs. *)

From Mceip Require Import Base Integers Sums.

Section Norms.

Variables (R : realFieldType) (l : seq nat).
Implicit Types (y z : nat -> R) (a b n : R).

Definition norm_le z n := 0 <= n /\ \sum_(k <- l) z k ^+ 2 <= n ^+ 2.

Lemma squares_ge0 (s : seq nat) z : 0 <= \sum_(k <- s) z k ^+ 2.
Proof. by apply: sumr_ge0 => k _; apply: sqr_ge0. Qed.

Lemma cauchy_schwarz (s : seq nat) y z :
  (\sum_(k <- s) y k * z k) ^+ 2 <= (\sum_(k <- s) y k ^+ 2) * (\sum_(k <- s) z k ^+ 2).
Proof.
elim: s => [|k s IH]; first by rewrite !big_nil expr0n /= mul0r.
rewrite !big_cons; move: IH (squares_ge0 s y) (squares_ge0 s z).
set S := \sum_(k <- s) _ * _; set A := \sum_(k <- s) y k ^+ 2; set B := \sum_(k <- s) z k ^+ 2.
move: (y k) (z k) => p q S_le A0 B0.

(* 2 p q S <= A q^2 + p^2 B *)
have mixed : (p * q) * S *+ 2 <= A * q ^+ 2 + p ^+ 2 * B.
  have right0 : 0 <= A * q ^+ 2 + p ^+ 2 * B.
    by apply: addr_ge0; apply: mulr_ge0 => //; apply: sqr_ge0.
  have [neg|pos] := lerP ((p * q) * S *+ 2) 0; first exact: le_trans neg right0.
  rewrite -(@ler_pexpn2r _ 2) ?nnegrE ?(ltW pos) //.
  apply: (@le_trans _ _ ((p * q) ^+ 2 * (A * B) *+ 4)).
    rewrite (_ : ((p * q) * S *+ 2) ^+ 2 = (p * q) ^+ 2 * S ^+ 2 *+ 4); last by ring.
    by rewrite ler_muln2r ler_wpmul2l ?sqr_ge0.
  rewrite -subr_ge0.
  rewrite (_ : _ - _ = (A * q ^+ 2 - p ^+ 2 * B) ^+ 2); last by ring.
  exact: sqr_ge0.
rewrite -subr_ge0.
have -> : (p ^+ 2 + A) * (q ^+ 2 + B) - (p * q + S) ^+ 2 =
          (A * B - S ^+ 2) + (A * q ^+ 2 + p ^+ 2 * B - (p * q) * S *+ 2) by ring.
by rewrite addr_ge0 // subr_ge0.
Qed.

Lemma dot_bound y z a b : norm_le y a -> norm_le z b -> `|\sum_(k <- l) y k * z k| <= a * b.
Proof.
move=> [a0 ya] [b0 zb]; rewrite -(@ler_pexpn2r _ 2) ?nnegrE ?normr_ge0 ?mulr_ge0 //.
rewrite -normrX ger0_norm ?sqr_ge0 // exprMn (le_trans (cauchy_schwarz l y z)) //.
by apply: ler_pmul => //; apply: squares_ge0.
Qed.

(* A norm is at most the sum of the absolute values. *)
Lemma norm_sum z : norm_le z (\sum_(k <- l) `|z k|).
Proof.
split; first by apply: sumr_ge0.
elim: l => [|k s IH]; first by rewrite !big_nil expr0n.
rewrite !big_cons sqrrD -normrX (ger0_norm (sqr_ge0 _)) -addrA ler_add2l.
by rewrite (le_trans IH) // ler_addr mulrn_wge0 // mulr_ge0 // sumr_ge0.
Qed.

Lemma norm_ext y z n : (forall k, k \in l -> y k = z k) -> norm_le y n -> norm_le z n.
Proof.
move=> same [n0 le]; split=> //; rewrite (_ : \sum_(k <- l) _ = \sum_(k <- l) y k ^+ 2) //.
by apply: sum_eq => k Hk; rewrite same.
Qed.

Lemma norm_weak z a b : a <= b -> norm_le z a -> norm_le z b.
Proof.
move=> ab [a0 za]; have b0 := le_trans a0 ab; split=> //; apply: le_trans za _.
by rewrite ler_pexpn2r ?nnegrE.
Qed.

Lemma norm_zero n : 0 <= n -> norm_le (fun=> 0) n.
Proof.
by move=> n0; split=> //; rewrite big1 ?sqr_ge0 // => k _; rewrite expr0n.
Qed.

Lemma norm_add y z a b : norm_le y a -> norm_le z b -> norm_le (fun k => y k + z k) (a + b).
Proof.
move=> ya zb; have := dot_bound ya zb; move: ya zb => [a0 ya] [b0 zb] dot.
split; first exact: addr_ge0.
have -> : \sum_(k <- l) (y k + z k) ^+ 2 =
    \sum_(k <- l) y k ^+ 2 + (\sum_(k <- l) y k * z k) *+ 2 + \sum_(k <- l) z k ^+ 2.
  rewrite -sumrMnl -!big_split /=; apply: eq_bigr => k _; exact: sqrrD.
rewrite sqrrD; apply: ler_add => //; apply: ler_add => //.
by rewrite ler_muln2r /= (le_trans (ler_norm _)).
Qed.

Lemma norm_scale c z n : norm_le z n -> norm_le (fun k => c * z k) (`|c| * n).
Proof.
move=> [n0 le]; split; first by rewrite mulr_ge0.
under eq_bigr do rewrite exprMn; rewrite -mulr_sumr exprMn -normrX ger0_norm ?sqr_ge0 //.
by rewrite ler_wpmul2l ?sqr_ge0.
Qed.

(* A vector with components of smaller absolute value. *)
Lemma norm_dominated y z n : (forall k, k \in l -> `|y k| <= z k) -> norm_le z n -> norm_le y n.
Proof.
move=> le [n0 zn]; split=> //; apply: le_trans zn; apply: sum_le => k Hk.
rewrite -[y k ^+ 2]ger0_norm ?sqr_ge0 // normrX ler_pexpn2r ?nnegrE ?le //.
exact: le_trans (le k Hk).
Qed.

(* The quadratic form of a matrix, by the sums of its rows and columns (Gershgorin). *)
Lemma form_by_sums (M : nat -> nat -> R) z :
  `|\sum_(i <- l) \sum_(k <- l) z i * M i k * z k| *+ 2 <=
  \sum_(i <- l) z i ^+ 2 * \sum_(k <- l) (`|M i k| + `|M k i|).
Proof.
apply: (@le_trans _ _ (\sum_(i <- l) \sum_(k <- l) `|M i k| * (z i ^+ 2 + z k ^+ 2))).
  rewrite -mulr_natl; apply: (@le_trans _ _
      (2%:R * \sum_(i <- l) \sum_(k <- l) `|z i * M i k * z k|)).
    rewrite ler_pmul2l ?ltr0n //; apply: le_trans (sum_norm _ _) _.
    by apply: sum_le => i _; apply: sum_norm.
  rewrite mulr_sumr; apply: sum_le => i _; rewrite mulr_sumr; apply: sum_le => k _.
  rewrite !normrM (_ : _ * _ = `|M i k| * ((`|z i| * `|z k|) *+ 2)); last first.
    by move: `|_| `|_| `|_| => *; ring.
  rewrite ler_wpmul2l // -[z i ^+ 2]ger0_norm ?sqr_ge0 // -[z k ^+ 2]ger0_norm ?sqr_ge0 //.
  rewrite !normrX -subr_ge0.
  have -> : `|z i| ^+ 2 + `|z k| ^+ 2 - (`|z i| * `|z k|) *+ 2 = (`|z i| - `|z k|) ^+ 2 by ring.
  exact: sqr_ge0.
rewrite le_eqVlt; apply/orP; left; apply/eqP.
under eq_bigr do (under eq_bigr do rewrite mulrDr; rewrite big_split /=).
rewrite big_split /= [X in _ + X]exchange_big -big_split; apply: eq_bigr => i _ /=.
rewrite -big_split mulr_sumr; apply: eq_bigr => k _ /=.
by rewrite mulrDr ![_ * z i ^+ 2]mulrC.
Qed.

(* A matrix whose rows and columns have absolute sums of at most beta. *)
Lemma bilinear_bound (M : nat -> nat -> R) beta y z a b :
  (forall i, i \in l -> \sum_(k <- l) `|M i k| <= beta) ->
  (forall k, k \in l -> \sum_(i <- l) `|M i k| <= beta) -> 0 <= beta ->
  norm_le y a -> norm_le z b ->
  `|\sum_(i <- l) \sum_(k <- l) y i * M i k * z k| <= a * b * beta.
Proof.
move=> rows columns beta0.
(* 2 |y'Mz| <= beta (|y|^2 + |z|^2) *)
have both y' z' : `|\sum_(i <- l) \sum_(k <- l) y' i * M i k * z' k| *+ 2 <=
    beta * (\sum_(k <- l) y' k ^+ 2 + \sum_(k <- l) z' k ^+ 2).
  have half (N : nat -> nat -> R) (w : nat -> R) :
      (forall i, i \in l -> \sum_(k <- l) `|N i k| <= beta) ->
      \sum_(i <- l) \sum_(k <- l) `|N i k| * w i ^+ 2 <= beta * \sum_(k <- l) w k ^+ 2.
    move=> sums; rewrite mulr_sumr; apply: sum_le => i Hi; rewrite -mulr_suml.
    by rewrite ler_wpmul2r ?sqr_ge0 ?sums.
  rewrite mulrDr; apply: le_trans (ler_add (half M y' rows) (half (fun i k => M k i) z' columns)).
  rewrite [X in _ + X]exchange_big -big_split /= -mulr_natl; apply: (@le_trans _ _
      (2%:R * \sum_(i <- l) \sum_(k <- l) `|y' i * M i k * z' k|)).
    rewrite ler_pmul2l ?ltr0n //; apply: le_trans (sum_norm _ _) _.
    by apply: sum_le => i _; apply: sum_norm.
  rewrite mulr_sumr; apply: sum_le => i _; rewrite mulr_sumr -big_split /=.
  apply: sum_le => k _; rewrite -mulrDr !normrM.
  have -> : 2%:R * (`|y' i| * `|M i k| * `|z' k|) = `|M i k| * ((`|y' i| * `|z' k|) *+ 2).
    by move: `|_| `|_| `|_| => *; ring.
  rewrite ler_wpmul2l // -[y' i ^+ 2]ger0_norm ?sqr_ge0 // -[z' k ^+ 2]ger0_norm ?sqr_ge0 //.
  rewrite !normrX -subr_ge0.
  have -> : `|y' i| ^+ 2 + `|z' k| ^+ 2 - (`|y' i| * `|z' k|) *+ 2 =
            (`|y' i| - `|z' k|) ^+ 2 by ring.
  exact: sqr_ge0.

move=> [a0 ya] [b0 zb].
have zero (w : nat -> R) : \sum_(k <- l) w k ^+ 2 <= 0 -> forall k, k \in l -> w k = 0.
  move=> w0 k kl; apply/eqP; rewrite -sqrf_eq0 eq_le sqr_ge0 andbT; apply: le_trans w0.
  by rewrite (big_rem k) //= ler_addl squares_ge0.
have [a_zero|a_pos] := eqVneq a 0.
  rewrite a_zero expr0n /= in ya; rewrite a_zero !mul0r normr_le0; apply/eqP.
  rewrite sum_zero // => i il; rewrite sum_zero // => k _; by rewrite (zero y) ?mul0r.
have [b_zero|b_pos] := eqVneq b 0.
  rewrite b_zero expr0n /= in zb; rewrite b_zero mulr0 mul0r normr_le0; apply/eqP.
  rewrite sum_zero // => i il; rewrite sum_zero // => k kl; by rewrite (zero z) ?mulr0.
have {}a_pos : 0 < a by rewrite lt_neqAle eq_sym a_pos.
have {}b_pos : 0 < b by rewrite lt_neqAle eq_sym b_pos.

(* Applied to y / a and z / b. *)
have := both (fun k => a^-1 * y k) (fun k => b^-1 * z k).
have -> : \sum_(i <- l) \sum_(k <- l) a^-1 * y i * M i k * (b^-1 * z k) =
          (a^-1 * b^-1) * \sum_(i <- l) \sum_(k <- l) y i * M i k * z k.
  rewrite mulr_sumr; apply: eq_bigr => i _; rewrite mulr_sumr; apply: eq_bigr => k _.
  by move: (a^-1) (b^-1) (y i) (z k) (M i k) => *; ring.
have unit_le (w : nat -> R) c : 0 < c -> \sum_(k <- l) w k ^+ 2 <= c ^+ 2 ->
    \sum_(k <- l) (c^-1 * w k) ^+ 2 <= 1.
  move=> c0 le; under eq_bigr do rewrite exprMn; rewrite -mulr_sumr exprVn.
  by rewrite mulrC ler_pdivr_mulr ?exprn_gt0 // mul1r.
set s := \sum_(i <- l) _; rewrite normrM ger0_norm ?mulr_ge0 ?invr_ge0 // => le.
have : (a^-1 * b^-1 * `|s|) *+ 2 <= beta *+ 2.
  apply: le_trans le _; rewrite -mulr_natr ler_wpmul2l //.
  by rewrite (_ : 2%:R = 1 + 1) // ler_add // unit_le.
rewrite ler_muln2r /= => le2.
have -> : `|s| = (a * b) * (a^-1 * b^-1 * `|s|) by field; rewrite !gt_eqF.
by rewrite ler_wpmul2l // mulr_ge0.
Qed.

End Norms.
