(* The energy of small motions that begin in contact.

   In the coordinates of admissible motions, free degrees of freedom f before slip particles s, a
   small motion x has M x'' + K x = p with p_f = 0; friction is a multiple mu of the rows Kmu, Mmu,
   and row i of the slip particles is y_i = (K x + M x'')_i + mu (Kmu x + Mmu x'')_i >= 0.  Each
   particle slides one way, x_i' >= 0, and x_i' y_i = 0; so x_i'' y_i = 0 almost everywhere.

   u is the part of x that follows the slip particles without inertia: (K u)_f = 0 and u_s = x_s.
   The rest is e = x - u, with z = e'K e.  For any matrix G let

       C = Kmu - G K_f,     E = Mmu - G M_f      (rows of slip particles).

   Lemma [power]:  x''M x'' + e''K e = - sum_i x_i' (y_i(u) + mu (C e)_i + mu (E x'')_i), in which
   the left side is the derivative of (x''M x' + e'K e)/2 (first factors: velocities) and y_i(u) is
   the row of u without inertia.

   Lemma [acceleration]: if M >= m I and 2 mu sum |E| <= m, then |x''| <= (2 kappa / m) |x|, with
   kappa at least the sum of all |K| and mu |C|.  Lemma [drag]: so mu (E x'')_i is at most
   theta_i sum |x_j| + rho_i sqrt z.

   Lemma [form_of_row]: (c'e)^2 <= A e'F e, where F v + l is a multiple of c, and v and l give A.
   Lemma [definite_mean]: Q - b b'/4 is definite between two ends where it is.

   Page: spec/certificates.md, 5.21; the theorem of stability. *)

From Mceip Require Import Base Integers Sums Norms Existence Elimination.

Section Times.

Variables (R : realFieldType) (n : nat).
Implicit Types (A : nat -> nat -> R) (x y : nat -> R).
Notation ix := (iota 0 n).

(* A x, and x'A y *)
Definition times A x i := \sum_(j <- ix) A i j * x j.
Definition pair A x y := \sum_(i <- ix) x i * times A y i.

Lemma timesD A x y i : times A (fun j => x j + y j) i = times A x i + times A y i.
Proof. by rewrite -big_split; apply: eq_bigr => j _; rewrite mulrDr. Qed.

Lemma timesB A x y i : times A (fun j => x j - y j) i = times A x i - times A y i.
Proof. by rewrite -sumrB; apply: eq_bigr => j _; rewrite mulrBr. Qed.

Lemma pair_sym A x y : (forall i j, i \in ix -> j \in ix -> A i j = A j i) ->
  pair A x y = pair A y x.
Proof.
move=> sym; rewrite /pair /times; under eq_bigr do rewrite mulr_sumr.
rewrite exchange_big; apply: sum_eq => j Hj; rewrite mulr_sumr; apply: sum_eq => i Hi.
by rewrite (sym _ _ Hi Hj); move: (A _ _) (x _) (y _) => *; ring.
Qed.

Lemma times_le A x i m : norm_le ix x m -> `|times A x i| <= (\sum_(j <- ix) `|A i j|) * m.
Proof. by move=> xm; apply: dot_bound xm; apply: norm_sum. Qed.

Lemma entry_le x i m : norm_le ix x m -> i \in ix -> `|x i| <= m.
Proof.
move=> [m0 le] Hi; rewrite -(@ler_pexpn2r _ 2) ?nnegrE ?normr_ge0 //.
rewrite -normrX ger0_norm ?sqr_ge0 // (le_trans _ le) //.
by rewrite (bigD1_seq i) ?iota_uniq //= ler_addl sumr_ge0 // => j _; rewrite sqr_ge0.
Qed.

Lemma pair_le A x y m k : norm_le ix x m -> norm_le ix y k ->
  `|pair A x y| <= m * ((\sum_(i <- ix) \sum_(j <- ix) `|A i j|) * k).
Proof.
move=> xm yk; have [m0 _] := xm; have [k0 _] := yk.
apply: le_trans (sum_norm _ _) _; rewrite mulrA [m * _]mulrC -mulrA !mulr_suml.
apply: sum_le => i Hi; rewrite normrM mulrA [_ * m]mulrC -mulrA.
by apply: ler_pmul => //; [apply: entry_le xm Hi | apply: times_le].
Qed.

End Times.

Section Motion.

Variables (R : rcfType) (nf ns : nat).
Variables (K M Kmu Mmu G : nat -> nat -> R) (mu : R).
Implicit Types (x a u : nat -> R).
Notation n := (nf + ns)%N.
Notation fi := (iota 0 nf).
Notation si := (iota 0 ns).
Notation ix := (iota 0 n).
Notation times := (times n).
Notation pair := (pair n).

Hypothesis symK : forall i j, i \in ix -> j \in ix -> K i j = K j i.

Lemma sum_parts (f : nat -> R) :
  \sum_(i <- ix) f i = \sum_(i <- fi) f i + \sum_(j <- si) f (nf + j)%N.
Proof. by rewrite iotaD big_cat add0n /= (sum_shift nf). Qed.

Lemma free_in i : i \in fi -> i \in ix.
Proof. by rewrite !mem_iota !add0n => /leq_trans-> //; apply: leq_addr. Qed.

(* Rows of slip particles less G times the free rows. *)
Definition corrected (A A' : nat -> nat -> R) j i := A' j i - \sum_(k <- fi) G j k * A k i.

Notation C := (corrected K Kmu).
Notation E := (corrected M Mmu).

Lemma times_corrected A A' x j :
  times (corrected A A') x j = times A' x j - \sum_(k <- fi) G j k * times A x k.
Proof.
rewrite /corrected /times; under eq_bigr do rewrite mulrBl mulr_suml.
rewrite sumrB exchange_big; congr (_ - _); apply: eq_bigr => k _; rewrite mulr_sumr.
by apply: eq_bigr => i _; rewrite mulrA.
Qed.

(* The row of a slip particle, and the laws of an instant for which forces are asked. *)
Definition slip_force x a j := times K x (nf + j)%N + times M a (nf + j)%N
  + mu * (times Kmu x j + times Mmu a j).

Definition free_law x a := forall i, i \in fi -> times K x i + times M a i = 0.

Definition follows u x :=
  (forall i, i \in fi -> times K u i = 0) /\ (forall j, j \in si -> u (nf + j)%N = x (nf + j)%N).

Definition still_force u j := times K u (nf + j)%N + mu * times Kmu u j.

Section Instant.

Variables x a : nat -> R.
Hypothesis law : free_law x a.

Lemma work v : (forall j, j \in si -> v (nf + j)%N * slip_force x a j = 0) ->
  pair K v x + pair M v a = - (mu * \sum_(j <- si) v (nf + j)%N * (times C x j + times E a j)).
Proof.
move=> zero; rewrite /pair -big_split sum_parts /= sum_zero ?add0r; last first.
  by move=> i /law eq0; rewrite -mulrDr eq0 mulr0.
rewrite mulr_sumr -sumrN; apply: sum_eq => j Hj; rewrite -mulrDr.
have sameE : times C x j + times E a j = times Kmu x j + times Mmu a j.
  rewrite !times_corrected; apply/eqP; rewrite -subr_eq0.
  set s := \sum_(k <- fi) G j k * times K x k; set s' := \sum_(k <- fi) G j k * times M a k.
  have s0 : s + s' = 0.
    rewrite -big_split sum_zero //= => k /law eq0.
    by rewrite -mulrDr eq0 mulr0.
  have -> : times Kmu x j - s + (times Mmu a j - s') - (times Kmu x j + times Mmu a j) =
    - (s + s') by ring.
  by rewrite s0 oppr0.
rewrite sameE; have := zero j Hj; rewrite /slip_force.
move: (v _) (times K x _) (times M a _) (times Kmu _ _) (times Mmu _ _) => p q r s' t zero'.
by rewrite -[LHS]subr0 -zero'; ring.
Qed.

Lemma apart u v y : follows u y -> (forall j, j \in si -> v (nf + j)%N = 0) -> pair K v u = 0.
Proof.
move=> [free _] off; rewrite /pair sum_parts sum_zero => [|i /free->]; last by rewrite mulr0.
by rewrite add0r sum_zero // => j /off->; rewrite mul0r.
Qed.

Lemma rest_off u y : follows u y -> forall j, j \in si -> y (nf + j)%N - u (nf + j)%N = 0.
Proof. by case=> _ same j /same->; rewrite subrr. Qed.

Lemma power v u u' : (forall j, j \in si -> v (nf + j)%N * slip_force x a j = 0) ->
  follows u x -> follows u' v ->
  let e i := x i - u i in let e' i := v i - u' i in
  pair M v a + pair K e' e = - \sum_(j <- si)
    v (nf + j)%N * (still_force u j + mu * times C e j + mu * times E a j).
Proof.
move=> zero fu fu' e e'.
have := work zero; have offe := rest_off fu; have offe' := rest_off fu'.
have xE : forall w, pair K w x = pair K w e + pair K w u.
  move=> w; rewrite /pair -big_split; apply: eq_bigr => i _ /=.
  by rewrite -mulrDr timesB subrK.
have vE : forall w, pair K v w = pair K e' w + pair K u' w.
  move=> w; rewrite /pair -big_split; apply: eq_bigr => i _ /=.
  by rewrite -mulrDl subrK.
rewrite xE !vE (apart fu offe') add0r.
have -> : pair K u' e = 0 by rewrite pair_sym // (apart fu' offe).
rewrite addr0 => eq.
have uu : pair K u' u = \sum_(j <- si) v (nf + j)%N * times K u (nf + j)%N.
  case: (fu) => free _; case: (fu') => _ same'.
  rewrite /pair sum_parts sum_zero ?add0r => [|i /free->]; last by rewrite mulr0.
  by apply: sum_eq => j /same'->.
have -> : pair M v a + pair K e' e =
    pair K e' e + pair K u' u + pair M v a - pair K u' u by ring.
rewrite eq uu mulr_sumr -opprD -big_split; congr (- _); apply: sum_eq => j Hj /=.
have -> : times C x j = times C e j + times Kmu u j.
  rewrite /e timesB; have -> : times C u j = times Kmu u j.
    rewrite times_corrected sum_zero ?subr0 // => k Hk.
    by case: (fu) => free _; rewrite free // mulr0.
  by rewrite subrK.
by rewrite /still_force; move: (v _) (times _ _ _) => *; ring.
Qed.

(* Accelerations. *)

Variables (m kappa : R) (row_e : nat -> R).
Hypotheses (m0 : 0 < m) (mu0 : 0 <= mu).
Hypothesis heavy : forall y, m * (\sum_(i <- ix) y i ^+ 2) <= pair M y y.
Hypothesis row_eP : forall j, j \in si -> \sum_(i <- ix) `|E j i| <= row_e j.
Hypothesis small : 2%:R * (mu * \sum_(j <- si) row_e j) <= m.
Hypothesis kappaP : \sum_(i <- ix) \sum_(j <- ix) `|K i j| +
  mu * (\sum_(j <- si) \sum_(i <- ix) `|C j i|) <= kappa.
Hypothesis zero_a : forall j, j \in si -> a (nf + j)%N * slip_force x a j = 0.

Lemma slip_in j : j \in si -> (nf + j)%N \in ix.
Proof. by rewrite !mem_iota !add0n /= ltn_add2l. Qed.

Lemma rows_le (A : nat -> nat -> R) y z p q (r : nat -> R) :
  norm_le ix y p -> norm_le ix z q -> (forall j, j \in si -> \sum_(i <- ix) `|A j i| <= r j) ->
  `|\sum_(j <- si) y (nf + j)%N * times A z j| <= p * ((\sum_(j <- si) r j) * q).
Proof.
move=> yp zq rP; have [p0 _] := yp; have [q0 _] := zq.
apply: le_trans (sum_norm _ _) _; rewrite mulr_suml mulr_sumr; apply: sum_le => j Hj.
rewrite normrM; apply: ler_pmul => //; first exact: entry_le yp (slip_in Hj).
by apply: le_trans (times_le _ _ zq) _; apply: ler_wpmul2r => //; apply: rP.
Qed.

Lemma acceleration q : norm_le ix x q -> norm_le ix a (2%:R * kappa / m * q).
Proof.
move=> xq; have [q0 _] := xq.
pose S := \sum_(i <- ix) a i ^+ 2; have S0 : 0 <= S by apply: squares_ge0.
pose p := Num.sqrt S; have p0 : 0 <= p by apply: sqrtr_ge0.
have ap : norm_le ix a p by split=> //; rewrite sqr_sqrtr.
have kappa0 : 0 <= kappa.
  apply: le_trans kappaP; rewrite addr_ge0 ?mulr_ge0 //;
    by apply: sumr_ge0 => i _; apply: sumr_ge0.
suff le : p <= 2%:R * kappa / m * q by apply: norm_weak le ap.
have [->|p_pos] := eqVneq p 0; first by rewrite !mulr_ge0 ?invr_ge0 ?ler0n ?(ltW m0).
have {}p_pos : 0 < p by rewrite lt_neqAle eq_sym p_pos.
have := work zero_a; under eq_bigr do rewrite mulrDr; rewrite big_split /=.
set sc := \sum_(j <- si) _ * times C x j; set se := \sum_(j <- si) _ * times E a j => eq.
have se_le := rows_le ap ap row_eP; rewrite -/se in se_le.
have sc_le := rows_le ap xq (fun j _ => lexx (\sum_(i <- ix) `|C j i|)); rewrite -/sc in sc_le.
have k_le := pair_le K ap xq.
have S_E : S = p ^+ 2 by rewrite sqr_sqrtr.
have ineq : m * p ^+ 2 <= p * (kappa * q) + mu * (p * ((\sum_(j <- si) row_e j) * p)).
  rewrite -S_E; apply: le_trans (heavy a) _.
  have -> : pair M a a = - pair K a x - mu * sc - mu * se.
    by rewrite -[pair M a a](addKr (pair K a x)) eq; ring.
  apply: ler_add; last first.
    by rewrite -mulrN ler_wpmul2l // (le_trans (ler_norm _)) ?normrN.
  apply: (@le_trans _ _ (p * ((\sum_(i <- ix) \sum_(j <- ix) `|K i j|) * q) +
      mu * (p * ((\sum_(j <- si) \sum_(i <- ix) `|C j i|) * q)))).
    apply: ler_add; first by rewrite (le_trans (ler_norm _)) ?normrN.
    by rewrite -mulrN ler_wpmul2l // (le_trans (ler_norm _)) ?normrN.
  rewrite [mu * (p * _)]mulrCA -mulrDr ler_pmul2l //.
  by rewrite mulrA -mulrDl ler_wpmul2r.
have half : mu * (p * ((\sum_(j <- si) row_e j) * p)) <= m * p ^+ 2 / 2%:R.
  rewrite ler_pdivl_mulr ?ltr0n //.
  have -> : mu * (p * ((\sum_(j <- si) row_e j) * p)) * 2%:R =
      2%:R * (mu * \sum_(j <- si) row_e j) * p ^+ 2 by ring.
  by rewrite ler_wpmul2r ?sqr_ge0.
rewrite mulrAC ler_pdivl_mulr // -(ler_pmul2r p_pos).
have {ineq half} := le_trans ineq (ler_add (lexx _) half).
rewrite -ler_subl_addr; have -> : m * p ^+ 2 - m * p ^+ 2 / 2%:R = m * p ^+ 2 / 2%:R by field.
rewrite ler_pdivr_mulr ?ltr0n // => le; apply: le_trans (_ : m * p ^+ 2 <= _).
  by rewrite le_eqVlt; apply/orP; left; apply/eqP; ring.
by apply: le_trans le _; rewrite le_eqVlt; apply/orP; left; apply/eqP; ring.
Qed.

(* |x - u| <= g sqrt z and |u| <= (1 + w) sum |x_j|; here z stands for sqrt z. *)
Lemma drag u g w z : norm_le ix (fun i => x i - u i) (g * z) ->
  norm_le ix u ((1 + w) * \sum_(j <- si) `|x (nf + j)%N|) ->
  forall j, j \in si -> `|mu * times E a j| <=
    mu * row_e j * (2%:R * kappa / m) * (1 + w) * (\sum_(k <- si) `|x (nf + k)%N|) +
    mu * row_e j * (2%:R * kappa / m) * g * z.
Proof.
move=> eg uw j Hj; have xq := norm_add eg uw.
have {}xq : norm_le ix x (g * z + (1 + w) * \sum_(j <- si) `|x (nf + j)%N|).
  by apply: norm_ext xq => i _; rewrite subrK.
have aq := acceleration xq; have [aq0 _] := aq.
rewrite normrM (ger0_norm mu0).
apply: (@le_trans _ _ (mu * (row_e j * (2%:R * kappa / m *
    (g * z + (1 + w) * \sum_(j <- si) `|x (nf + j)%N|))))).
  rewrite ler_wpmul2l //; apply: le_trans (times_le _ _ aq) _.
  by apply: ler_wpmul2r => //; apply: row_eP.
by rewrite le_eqVlt; apply/orP; left; apply/eqP; ring.
Qed.

End Instant.

End Motion.

(* Sums of vectors. *)
Lemma norm_sums (R : realFieldType) (l s : seq nat) (f : nat -> nat -> R) m :
  (forall j, j \in s -> norm_le l (f j) (m j)) ->
  norm_le l (fun k => \sum_(j <- s) f j k) (\sum_(j <- s) m j).
Proof.
elim: s => [|j s IH] each.
  rewrite big_nil; apply: norm_ext (norm_zero l (lexx 0)) => k _.
  by rewrite big_nil.
rewrite big_cons; apply: (norm_ext (y := fun k => f j k + \sum_(i <- s) f i k)).
  by move=> k _; rewrite big_cons.
apply: norm_add; first by apply: each; rewrite mem_head.
by apply: IH => i Hi; apply: each; rewrite inE Hi orbT.
Qed.

Definition symmetric_on (R : Type) n (F : nat -> nat -> R) :=
  forall i k, i \in iota 0 n -> k \in iota 0 n -> F i k = F k i.

(* A linear form of a vector and the quadratic form F. *)
Section Form.

Variables (R : realFieldType) (n : nat) (F : nat -> nat -> R) (s : R).
Notation fi := (iota 0 n).
Notation pair := (pair n F).
Hypotheses (s0 : 0 < s) (sym : symmetric_on n F) (below : bounded_below n F s).

Lemma pair_form x : pair x x = \sum_(i <- fi) \sum_(k <- fi) x i * F i k * x k.
Proof.
by apply: eq_bigr => i _; rewrite /times mulr_sumr; apply: eq_bigr => k _; rewrite mulrA.
Qed.

Lemma pair_ge0 x : 0 <= pair x x.
Proof.
by rewrite pair_form (le_trans _ (below x)) // mulr_ge0 ?(ltW s0) // squares_ge0.
Qed.

Lemma pair_cauchy x y : pair x y ^+ 2 <= pair x x * pair y y.
Proof.
have pairC := pair_sym y x sym.
have line c : 0 <= pair y y - 2%:R * c * pair x y + c ^+ 2 * pair x x.
  have := pair_ge0 (fun k => y k - c * x k).
  have -> // : pair (fun k => y k - c * x k) (fun k => y k - c * x k) =
    pair y y - 2%:R * c * pair x y + c ^+ 2 * pair x x.
  have timesE i : times n F (fun k => y k - c * x k) i = times n F y i - c * times n F x i.
    rewrite timesB; congr (_ - _); rewrite /times mulr_sumr; apply: eq_bigr => j _.
    exact: mulrCA.
  have -> : pair (fun k => y k - c * x k) (fun k => y k - c * x k) =
      pair y y - c * pair y x - c * pair x y + c ^+ 2 * pair x x.
    rewrite /Energy.pair !mulr_sumr -!sumrB -big_split; apply: eq_bigr => i _ /=.
    by rewrite timesE; move: (times _ _ _ _) (times _ _ _ _) (x i) (y i) => *; ring.
  by rewrite pairC; ring.
have [zero|pos] := eqVneq (pair x x) 0; last first.
  have {}pos : 0 < pair x x by rewrite lt_neqAle eq_sym pos pair_ge0.
  have := line (pair x y / pair x x); rewrite -(pmulr_rge0 _ pos).
  have -> : pair x x * (pair y y - 2%:R * (pair x y / pair x x) * pair x y +
      (pair x y / pair x x) ^+ 2 * pair x x) = pair x x * pair y y - pair x y ^+ 2.
    by field; rewrite gt_eqF.
  by rewrite subr_ge0.
have [->|nz] := eqVneq (pair x y) 0; first by rewrite expr0n mulr_ge0 ?pair_ge0.
have := line ((pair y y + 1) / (2%:R * pair x y)); rewrite zero mulr0 addr0.
have -> : pair y y - 2%:R * ((pair y y + 1) / (2%:R * pair x y)) * pair x y =
    - 1 by field; rewrite nz.
by rewrite oppr_ge0 ler10.
Qed.

Lemma form_of_row (u : R) c v l e :
  (forall k, k \in fi -> u * c k = times n F v k + l k) ->
  (u * (\sum_(k <- fi) c k * e k)) ^+ 2 <=
  (pair v v + 2%:R * (\sum_(k <- fi) v k * l k) + s^-1 * \sum_(k <- fi) l k ^+ 2) * pair e e.
Proof.
move=> cE; pose y := solve n F l; pose h k := v k + y k.
have Fy k : k \in fi -> times n F y k = l k by apply: (solveP s0 below l).
have -> : u * (\sum_(k <- fi) c k * e k) = pair e h.
  rewrite mulr_sumr; apply: sum_eq => k Hk; rewrite mulrA cE //.
  by rewrite /h timesD Fy // mulrC.
apply: le_trans (pair_cauchy _ _) _; rewrite mulrC ler_wpmul2r ?pair_ge0 //.
have vl : pair v y = \sum_(k <- fi) v k * l k by apply: sum_eq => k Hk; rewrite Fy.
have -> : pair h h = pair v v + 2%:R * pair v y + pair y y.
  have -> : pair h h = pair v v + pair v y + pair y v + pair y y.
    rewrite /Energy.pair -!big_split; apply: eq_bigr => i _ /=.
    by rewrite /h timesD; move: (times _ _ _ _) (times _ _ _ _) (v i) (y i) => *; ring.
  by rewrite (pair_sym y v sym); ring.
rewrite vl ler_add2l; set b := \sum_(k <- fi) l k ^+ 2.
(* s |y|^2 <= y'F y = y'l, and (y'l)^2 <= |y|^2 |l|^2 *)
have yl : pair y y = \sum_(k <- fi) y k * l k by apply: sum_eq => k Hk; rewrite Fy.
have yy : s * (\sum_(k <- fi) y k ^+ 2) <= pair y y by rewrite pair_form; apply: below.
have b0 : 0 <= b by apply: squares_ge0.
have [->|nz] := eqVneq (pair y y) 0; first by rewrite mulr_ge0 // invr_ge0 ltW.
have pos : 0 < pair y y by rewrite lt_neqAle eq_sym nz pair_ge0.
rewrite mulrC ler_pdivl_mulr // -(ler_pmul2r pos).
apply: (@le_trans _ _ (s * ((\sum_(k <- fi) y k ^+ 2) * b))).
  rewrite mulrAC -expr2 mulrC ler_pmul2l // {1}yl; exact: cauchy_schwarz.
by rewrite mulrA [b * _]mulrC ler_wpmul2r.
Qed.

End Form.

(* Two forms and two linear forms with the weights p and q. *)
Lemma definite_mean (R : realFieldType) (p q a a' b b' : R) : 0 <= p -> 0 <= q -> p + q = 1 ->
  0 < a - b ^+ 2 / 4%:R -> 0 < a' - b' ^+ 2 / 4%:R ->
  0 < p * a + q * a' - (p * b + q * b') ^+ 2 / 4%:R.
Proof.
move=> p0 q0 one pos pos'.
have -> : p * a + q * a' - (p * b + q * b') ^+ 2 / 4%:R =
    (p * (a - b ^+ 2 / 4%:R) + q * (a' - b' ^+ 2 / 4%:R)) + p * q * (b - b') ^+ 2 / 4%:R.
  have -> : q = 1 - p by rewrite -one addrC addKr.
  by field.
apply: ltr_paddr; first by rewrite divr_ge0 ?ler0n // mulr_ge0 ?sqr_ge0 // mulr_ge0.
apply: combination_gt0 => //; have [p1|p1] := eqVneq p 0; last first.
  by left; rewrite lt_neqAle eq_sym p1.
by right; rewrite -[q]add0r -[X in X + q]p1 one ltr01.
Qed.
