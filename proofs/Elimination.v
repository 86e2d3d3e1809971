(* Elimination of the free variables at one value, over an ordered field.

   At a fixed value t the pencil is in blocks, F and G in the free rows, H and D in the others:

       y_f = F x_f + G x_s,    y_s = H x_f + D x_s,

   with z'Fz >= s z'z for some s > 0; F need not be symmetric.  The condensed matrix is
   T = D - H F^-1 G.

   [condensed_row]: with x_f = -F^-1 G x_s the free rows vanish, and y_s = T x_s.
   [condensed_residual]: for any matrices W and V, with r = G - F W and l = H' - F' V,

       T = D - H W - V' r - l' F^-1 r.

   [solve_norm]: |F^-1 b| <= |b| / s in Euclidean norms, so the last term is at most |l| |r| / s.
   [remainder_difference]: for two values t and t' the remainders l' F^-1 r differ by (t - t')
   times a number that is bounded.
   [condensed_polynomial]: if the blocks are polynomials in t, then det F(t) T(t) is a polynomial.

   Page: spec/certificates.md, 5.14.  Rust: crates/check/src/cover/condensed.rs. *)

From Mceip Require Import Base Integers Sums Norms Existence.

Section Elimination.

Variables (R : realFieldType) (n : nat) (F : nat -> nat -> R) (s : R).
Notation fi := (iota 0 n).
Notation norm_le := (norm_le fi).

Definition bounded_below := forall z : nat -> R,
  s * (\sum_(k <- fi) z k ^+ 2) <= \sum_(i <- fi) \sum_(k <- fi) z i * F i k * z k.

Hypotheses (s0 : 0 < s) (below : bounded_below).

Lemma eliminated_injective : injective_on fi F.
Proof.
move=> z Fz k Hk; have := below z.
rewrite [X in _ <= X]sum_zero => [|i Hi]; last first.
  by under eq_bigr do rewrite -mulrA; rewrite -mulr_sumr Fz // mulr0.
rewrite pmulr_rle0 // => squares.
apply/eqP; rewrite -sqrf_eq0 eq_le sqr_ge0 andbT; apply: le_trans squares.
by rewrite (bigD1_seq k) ?iota_uniq //= ler_addl sumr_ge0 // => j _; rewrite sqr_ge0.
Qed.

(* F^-1 b *)
Definition solve (b : nat -> R) :=
  at_index (K := fi) (invmx (block fi F) *m \col_i b (nth 0%N fi i)).

Lemma block_unit : block fi F \in unitmx.
Proof. by rewrite unitmxE unitfE block_det ?iota_uniq //; exact: eliminated_injective. Qed.

Lemma solve_ext b b' : (forall i, i \in fi -> b i = b' i) -> solve b =1 solve b'.
Proof.
move=> same k; rewrite /solve; congr (at_index (_ *m _) _); apply/colP=> i.
by rewrite !mxE same ?mem_nth.
Qed.

Lemma solveP b i : i \in fi -> \sum_(k <- fi) F i k * solve b k = b i.
Proof.
have U := iota_uniq 0 n; have unit_F := block_unit.
move=> /(nthP 0%N)[i' li <-]; rewrite -(block_mul U F _ (Ordinal li)).
by rewrite mulKVmx // mxE.
Qed.

Lemma solve_unique z b : (forall i, i \in fi -> \sum_(k <- fi) F i k * z k = b i) ->
  forall k, k \in fi -> z k = solve b k.
Proof.
move=> Fz k Hk; apply/eqP; rewrite -subr_eq0; apply/eqP; move: k Hk.
apply: (eliminated_injective (z := fun k => z k - solve b k)) => i Hi.
by under eq_bigr do rewrite mulrBr; rewrite sumrB Fz // solveP // subrr.
Qed.

Lemma norm_of_solution z r m : (forall i, i \in fi -> \sum_(k <- fi) F i k * z k = r i) ->
  norm_le r m -> norm_le z (m / s).
Proof.
move=> Fz [m0 r_le]; split; first by rewrite divr_ge0 // ltW.
set Q := \sum_(k <- fi) z k ^+ 2; have Q0 : 0 <= Q by apply: squares_ge0.
have [->|Q_pos] := eqVneq Q 0; first exact: sqr_ge0.
have {}Q_pos : 0 < Q by rewrite lt_neqAle eq_sym Q_pos.
have form_le : s * Q <= \sum_(i <- fi) z i * r i.
  apply: le_trans (below z) _; rewrite le_eqVlt; apply/orP; left; apply/eqP/sum_eq => i Hi.
  by rewrite -Fz // mulr_sumr; apply: eq_bigr => k _; rewrite mulrA.
have sQ0 : 0 <= s * Q by rewrite mulr_ge0 // ltW.
have : (s * Q) ^+ 2 <= Q * m ^+ 2.
  apply: (@le_trans _ _ ((\sum_(i <- fi) z i * r i) ^+ 2)).
    by rewrite ler_pexpn2r ?nnegrE // (le_trans sQ0).
  by apply: le_trans (cauchy_schwarz _ _ _) _; rewrite ler_wpmul2l.
rewrite exprMn [Q ^+ 2]expr2 mulrA mulrC ler_pmul2l // => le.
by rewrite exprMn exprVn ler_pdivl_mulr ?exprn_gt0 // mulrC.
Qed.

Lemma solve_norm r m : norm_le r m -> norm_le (solve r) (m / s).
Proof. by apply: norm_of_solution => i Hi; apply: solveP. Qed.

(* The other blocks. *)
Variables (ns : nat) (G H D : nat -> nat -> R).
Notation si := (iota 0 ns).

Definition condensed_at i j := D i j - \sum_(k <- fi) H i k * solve (G^~ j) k.

Definition free_part xs k := - \sum_(j <- si) solve (G^~ j) k * xs j.

Lemma free_rows_vanish (xf xs : nat -> R) :
  (forall i, i \in fi -> \sum_(k <- fi) F i k * xf k + \sum_(j <- si) G i j * xs j = 0) <->
  (forall k, k \in fi -> xf k = free_part xs k).
Proof.
have F_part i : i \in fi ->
    \sum_(k <- fi) F i k * free_part xs k = - \sum_(j <- si) G i j * xs j.
  move=> Hi; rewrite /free_part; under eq_bigr do rewrite mulrN mulr_sumr.
  rewrite sumrN exchange_big; congr (- _); apply: eq_bigr => j _.
  under eq_bigr do rewrite mulrA; rewrite -mulr_suml; congr (_ * _).
  exact: (solveP (G^~ j)).

split=> rows.
  move=> k Hk; apply/eqP; rewrite -subr_eq0; apply/eqP; move: k Hk.
  apply: (eliminated_injective (z := fun k => xf k - free_part xs k)) => i Hi.
  by under eq_bigr do rewrite mulrBr; rewrite sumrB F_part // opprK; apply: rows.
move=> i Hi; under eq_big_seq => k Hk do rewrite rows //.
by rewrite F_part // addNr.
Qed.

Lemma condensed_row xf xs i : (forall k, k \in fi -> xf k = free_part xs k) ->
  \sum_(k <- fi) H i k * xf k + \sum_(j <- si) D i j * xs j =
  \sum_(j <- si) condensed_at i j * xs j.
Proof.
move=> part; have -> : \sum_(k <- fi) H i k * xf k =
    - \sum_(j <- si) (\sum_(k <- fi) H i k * solve (G^~ j) k) * xs j.
  under eq_big_seq => k Hk do rewrite part // /free_part mulrN mulr_sumr.
  rewrite sumrN exchange_big; congr (- _); apply: eq_bigr => j _.
  by rewrite mulr_suml; apply: eq_bigr => k _; rewrite mulrA.
rewrite addrC -sumrB; apply: eq_bigr => j _; by rewrite -mulrBl.
Qed.

(* Any u, W and V; r = u G - F W, l = u H' - F' V. *)
Variables (u : R) (W V : nat -> nat -> R).

Definition residual_r j k := u * G k j - \sum_(m <- fi) F k m * W m j.
Definition residual_l i k := u * H i k - \sum_(m <- fi) F m k * V m i.

Definition approximate i j := u ^+ 2 * D i j - u * (\sum_(k <- fi) H i k * W k j) -
  \sum_(k <- fi) V k i * residual_r j k.

Lemma condensed_residual i j : u ^+ 2 * condensed_at i j =
  approximate i j - \sum_(k <- fi) residual_l i k * solve (residual_r j) k.
Proof.
pose z := solve (residual_r j).
have zE k : k \in fi -> u * solve (G^~ j) k = W k j + z k.
  move=> Hk; transitivity (solve (fun m => u * G m j) k); last apply/esym; move: k Hk.
    apply: solve_unique => m Hm; under eq_bigr do rewrite mulrCA.
    by rewrite -mulr_sumr (solveP (G^~ j)).
  apply: (solve_unique (z := fun k => W k j + z k)) => m Hm.
  under eq_bigr do rewrite mulrDr; rewrite big_split /= solveP // /residual_r.
  by rewrite addrC subrK.

have -> : \sum_(k <- fi) residual_l i k * z k = u * (\sum_(k <- fi) H i k * z k) -
    \sum_(k <- fi) V k i * residual_r j k.
  rewrite /residual_l; under eq_bigr do rewrite mulrBl; rewrite sumrB mulr_sumr; congr (_ - _).
    by apply: eq_bigr => k _; rewrite mulrA.
  under eq_bigr do rewrite mulr_suml; rewrite exchange_big; apply: sum_eq => m Hm.
  rewrite -(solveP (residual_r j)) // mulr_sumr; apply: sum_eq => k Hk.
  by rewrite -/(z k); move: (F _ _) (V _ _) (z k) => *; ring.
have solved : u * (\sum_(k <- fi) H i k * solve (G^~ j) k) =
    \sum_(k <- fi) H i k * W k j + \sum_(k <- fi) H i k * z k.
  by rewrite mulr_sumr -big_split; apply: sum_eq => k Hk /=; rewrite -mulrDr -zE // mulrCA.
rewrite /condensed_at /approximate mulrBr expr2 -[u * u * \sum_(k <- fi) _]mulrA solved.
by move: (\sum_(k <- fi) _) (\sum_(k <- fi) _) (\sum_(k <- fi) _) (D i j) => *; ring.
Qed.

End Elimination.

(* Remainders at two values. *)
Section Difference.

Variables (R : realFieldType) (n : nat) (F F' M : nat -> nat -> R) (s e beta : R).
Notation fi := (iota 0 n).
Notation norm_le := (norm_le fi).
Hypotheses (s0 : 0 < s) (below : bounded_below n F s) (below' : bounded_below n F' s).
Hypothesis difference : forall i k, i \in fi -> k \in fi -> F i k - F' i k = e * M i k.
Hypotheses (rows : forall i, i \in fi -> \sum_(k <- fi) `|M i k| <= beta) (beta0 : 0 <= beta).
Hypothesis columns : forall k, k \in fi -> \sum_(i <- fi) `|M i k| <= beta.

Variables (l l' r r' ql qr : nat -> R) (nl nr nql nqr : R).
Hypotheses (l_diff : forall k, l k - l' k = e * ql k) (r_diff : forall k, r k - r' k = e * qr k).
Hypotheses (nl' : norm_le l' nl) (nr_ : norm_le r nr) (nql_ : norm_le ql nql).
Hypothesis nqr_ : norm_le qr nqr.

Lemma remainder_difference : exists2 q,
  \sum_(k <- fi) l k * solve n F r k - \sum_(k <- fi) l' k * solve n F' r' k = e * q &
  `|q| <= (nql * nr + nl * nqr) / s + nl * nr * beta / s ^+ 2.
Proof.
have turned : bounded_below n (fun i k => F' k i) s.
  move=> y; rewrite [X in _ <= X]exchange_big; apply: le_trans (below' y) _.
  rewrite (_ : \sum_(i <- fi) _ = \sum_(i <- fi) \sum_(k <- fi) y k * F' i k * y i) //.
  by apply: eq_bigr => i _; apply: eq_bigr => k _; rewrite mulrAC [y i * _]mulrC mulrAC.
pose z := solve n F r; pose z' := solve n F' r'; pose zeta := solve n (fun i k => F' k i) l'.
have z_norm : norm_le z (nr / s) := solve_norm s0 below nr_.
have zeta_norm : norm_le zeta (nl / s) := solve_norm s0 turned nl'.

(* l' . (z - z') = zeta . F' (z - z') = e zeta . (qr - M z) *)
have moved k : k \in fi -> \sum_(m <- fi) F' k m * (z m - z' m) =
                           e * (qr k - \sum_(m <- fi) M k m * z m).
  move=> Hk; under eq_bigr do rewrite mulrBr; rewrite sumrB (solveP s0 below') //.
  have -> : \sum_(m <- fi) F' k m * z m = r k - e * \sum_(m <- fi) M k m * z m.
    rewrite -(solveP s0 below r Hk) mulr_sumr -sumrB; apply: sum_eq => m Hm.
    by rewrite -/(z m) mulrA -difference // mulrBl opprB addrC subrK.
  by rewrite mulrBr -r_diff addrAC.
have zetaE : \sum_(k <- fi) l' k * (z k - z' k) =
             e * (\sum_(k <- fi) zeta k * qr k - \sum_(k <- fi) \sum_(m <- fi)
                                                   zeta k * M k m * z m).
  transitivity (\sum_(k <- fi) zeta k * \sum_(m <- fi) F' k m * (z m - z' m)).
    under [RHS]eq_bigr do rewrite mulr_sumr; rewrite exchange_big; apply: sum_eq => m Hm.
    rewrite -(solveP s0 turned l' Hm) mulr_suml; apply: sum_eq => k Hk.
    by rewrite -/(zeta k); move: (F' _ _) (zeta _) (z m - _) => *; ring.
  rewrite mulrBr !mulr_sumr -sumrB; apply: sum_eq => k Hk; rewrite moved //.
  rewrite mulrCA mulrBr mulrBr; congr (_ - e * _).
  by rewrite mulr_sumr; apply: eq_bigr => m _; rewrite mulrA.

exists (\sum_(k <- fi) ql k * z k + (\sum_(k <- fi) zeta k * qr k -
          \sum_(k <- fi) \sum_(m <- fi) zeta k * M k m * z m)).
  rewrite mulrDr -zetaE mulr_sumr -big_split -sumrB; apply: eq_bigr => k _ /=.
  rewrite mulrA -l_diff -/(z k) -/(z' k).
  by move: (l k) (l' k) (z k) (z' k) => *; ring.
have one := dot_bound nql_ z_norm; have two := dot_bound zeta_norm nqr_.
have three := bilinear_bound rows columns beta0 zeta_norm z_norm.
apply: le_trans (ler_norm_add _ _) _.
have -> : (nql * nr + nl * nqr) / s + nl * nr * beta / s ^+ 2 =
    nql * (nr / s) + (nl / s * nqr + nl / s * (nr / s) * beta).
  by field; rewrite gt_eqF.
apply: ler_add => //; apply: le_trans (ler_norm_sub _ _) _; exact: ler_add.
Qed.

End Difference.

(* Blocks that are polynomials in t. *)
Section Polynomial.

Variables (R : realFieldType) (n : nat) (F G H D : nat -> nat -> {poly R}).
Notation fi := (iota 0 n).
Notation at_ M t := (fun i j => (M i j).[t]) (only parsing).

Definition free_det : {poly R} := \det (\matrix_(i < size fi, j < size fi)
  F (nth 0%N fi i) (nth 0%N fi j)).

Definition adjugate_column j : nat -> {poly R} := fun k =>
  \sum_(i < size fi) (nth 0%N fi i == k)%:R * \sum_(m < size fi)
    (\adj (\matrix_(i < size fi, j < size fi) F (nth 0%N fi i) (nth 0%N fi j))) i m *
    G (nth 0%N fi m) j.

Definition condensed_poly i j : {poly R} :=
  free_det * D i j - \sum_(k <- fi) H i k * adjugate_column j k.

Lemma block_of_poly t : block fi (at_ F t) =
  map_mx (horner_eval t) (\matrix_(i < size fi, j < size fi) F (nth 0%N fi i) (nth 0%N fi j)).
Proof. by apply/matrixP=> i j; rewrite !mxE. Qed.

Lemma free_detE t : free_det.[t] = \det (block fi (at_ F t)).
Proof. by rewrite block_of_poly det_map_mx. Qed.

Lemma condensed_polynomial t i j : block fi (at_ F t) \in unitmx ->
  (condensed_poly i j).[t] =
  free_det.[t] * condensed_at n (at_ F t) (at_ G t) (at_ H t) (at_ D t) i j.
Proof.
move=> unit_F; rewrite /condensed_poly /condensed_at hornerD hornerM hornerN mulrBr.
have dE := free_detE t; move: (free_det.[t]) dE => d dE.
congr (_ - _); rewrite horner_sum mulr_sumr; apply: eq_bigr => k _.
rewrite hornerM mulrCA; congr (_ * _).
rewrite /adjugate_column /solve /at_index horner_sum mulr_sumr; apply: eq_bigr => m _.
rewrite hornerM mulrC [in RHS]mulrA; congr (_ * _); last by case: eqP; rewrite ?hornerC ?horner0.
rewrite mxE horner_sum mulr_sumr; apply: eq_bigr => p _.
rewrite hornerM [X in _ * (_ * X)]mxE mulrA; congr (_ * _).
have det0 : d != 0 by rewrite dE -unitfE -unitmxE.
rewrite /invmx unit_F -dE [X in _ = d * X]mxE mulrA mulfV // mul1r block_of_poly -map_mx_adj.
by rewrite [RHS]mxE.
Qed.

End Polynomial.
