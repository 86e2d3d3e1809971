(* The reduction of the friction problem to complementarity problems.

   All statements hold over any ordered field R.  A vector over the degrees of freedom is a column;
   its blocks are, in this order, the free ones (f), the tangential ones of the slip particles
   (Ts), the normal ones of the slip particles (Ns), and those that do not move (d).

   What is proved:

   - [reduction], [reduction_onto]: the conditions (9) without particles at zero reaction are
     equivalent to the complementarity eigenproblem (12)-(14), with the maps (10), (11) and the
     blocks (16); each slip particle may have a friction factor c_p of its own, then c_p mu stands
     for mu in its line (spec/problem.md), and the rows of K1 get this factor; and it may have a
     geometric stiffness g_p, for which K* gets diag((1 + c_p^2 mu^2) g_p) (spec/curvature.md);
   - [turned_reaction]: how the line of (9) gets this term;
   - [proposition1]: MCEIP-mu has a solution iff MCP-mu has one.  Hypotheses: K_ff is regular, and
     the f rows of K1 vanish.  (The paper asks less by its words and uses this much.)
   - [proposition2]: MCEIP-lambda2 has a solution iff MCP-lambda2 has one.  Hypothesis:
     K*_ff + lambda^2 M*_ff is regular for every lambda^2 >= 0; [proposition2_definite] derives it
     from K_ff and M_ff definite;
   - [solution_of_mcp], [mcp_of_solution]: the explicit maps behind both propositions;
   - [remark1], [remark1_gamma]: if K0 is definite, every solution of MCEIP-mu has mu > 0, and
     every solution of MCP-mu has gamma = 0;
   - [necessary_condition_19]: if K* is positive definite and M* positive semidefinite, then
     MCEIP-lambda2 has no solution.

   Definite means x' K x > 0 for x != 0; K need not be symmetric.

   Pages: spec/reduction.md (2.1 to 2.4), spec/curvature.md (K.1), spec/solver.md (P1, P2, R1).
   Rust: crates/model/src/reduction/, crates/check/src/pencil.rs. *)

From Mceip Require Import Base.

Section Reduction.

Variable R : realFieldType.

Definition dot n (u v : 'cV[R]_n) : R := (u^T *m v) 0 0.

Definition definite n (K : 'M[R]_n) := forall x : 'cV_n, x != 0 -> 0 < dot x (K *m x).

Definition semidefinite n (K : 'M[R]_n) := forall x : 'cV_n, 0 <= dot x (K *m x).

Definition regular n (K : 'M[R]_n) := forall x : 'cV_n, K *m x = 0 -> x = 0.

Definition nonnegative n (v : 'cV[R]_n) := forall i, 0 <= v i 0.

(* 0 <= a _|_ b >= 0 *)
Definition complementary n (a b : 'cV[R]_n) := [/\ nonnegative a, nonnegative b & dot a b = 0].

Lemma dotE n (u v : 'cV[R]_n) : dot u v = \sum_i u i 0 * v i 0.
Proof. by rewrite /dot mxE; apply: eq_bigr => i _; rewrite mxE. Qed.

Lemma definite_regular n (K : 'M[R]_n) : definite K -> regular K.
Proof.
move=> pos x Kx; apply/eqP/negPn/negP=> /pos.
by rewrite Kx /dot mulmx0 mxE ltxx.
Qed.

(* a'b = 0 means a_i b_i = 0 for each i. *)
Lemma complementaryP n (a b : 'cV[R]_n) :
  complementary a b <-> [/\ nonnegative a, nonnegative b & forall i, a i 0 * b i 0 = 0].
Proof.
split=> -[a0 b0 ab]; split=> //; last by rewrite dotE big1.
move=> i; apply/eqP; move/eqP: ab; rewrite dotE psumr_eq0 => [/allP/(_ i)/=|j _].
  by rewrite mem_index_enum => /(_ isT).
exact: mulr_ge0.
Qed.

Lemma complementary_scale n k (a b : 'cV[R]_n) :
  0 <= k -> complementary a b -> complementary (k *: a) (k *: b).
Proof.
move=> k0 /complementaryP[a0 b0 ab]; apply/complementaryP; split=> i; rewrite !mxE ?mulr_ge0 //.
by rewrite mulrACA ab mulr0.
Qed.

Lemma col_mx_zero m n (a : 'cV[R]_m) (b : 'cV[R]_n) : col_mx a b = 0 <-> a = 0 /\ b = 0.
Proof.
by split=> [/eqP|[-> ->]]; rewrite ?col_mx0 // col_mx_eq0 => /andP[/eqP-> /eqP->].
Qed.

(* Where the obstacle is curved, a particle that moves by v_T along it has tangent and normal turned
   by phi = kappa v_T; w'_T and w'_N are the rates of its reaction in these directions.  The line of
   (9) for w' is that for w with the geometric stiffness kappa r_N of the reaction r at equilibrium,
   which is on the cone.  m is the coefficient of friction of the particle. *)
Theorem turned_reaction (S m kappa v_T w_T w_N r_T r_N : R) : r_T = - (S * m * r_N) ->
  let phi := kappa * v_T in
  let w'_T := w_T + phi * r_N in
  let w'_N := w_N - phi * r_T in
  S * w'_T + m * w'_N = S * w_T + m * w_N + (1 + m ^+ 2) * (kappa * r_N) * (S * v_T).
Proof. by move=> -> /=; ring. Qed.

(* The eigenproblem and its embedding in a complementarity problem. *)
Section Eigenproblem.

Variables nf ns : nat.
Implicit Types (T A B : 'M[R]_(nf + ns)) (x y : 'cV[R]_(nf + ns)).

Notation f := usubmx.
Notation s := dsubmx.

(* x != 0, T x = y, y_f = 0, 0 <= x_s _|_ y_s >= 0 *)
Definition null_solution T x y :=
  [/\ x != 0, T *m x = y, f y = 0 & complementary (s x) (s y)].

(* (12)-(14) and (21)-(23): t >= 0 and a null solution of A + t B. *)
Definition eigenproblem A B t x y := 0 <= t /\ null_solution (A + t *: B) x y.

(* (27)-(30) and (31)-(34), with c > 0 and g for gamma. *)
Definition mcp A B c t x y g :=
  [/\ (A + t *: B) *m x = y, \sum_i s x i 0 = c + g, f y = 0 &
      complementary (s x) (s y) /\ [/\ 0 <= t, 0 <= g & t * g = 0]].

Definition free_block T : 'M_nf := ulsubmx T.

Lemma free_rows T x : f (T *m x) = free_block T *m f x + ursubmx T *m s x.
Proof. by rewrite -{1}[T]submxK -{1}[x]vsubmxK mul_block_col col_mxKu. Qed.

Lemma s_scale k (x : 'cV[R]_(nf + ns)) : s (k *: x) = k *: s x.
Proof. by apply/colP=> i; rewrite !mxE. Qed.

Lemma f_scale k (x : 'cV[R]_(nf + ns)) : f (k *: x) = k *: f x.
Proof. by apply/colP=> i; rewrite !mxE. Qed.

(* Some slip particle slips. *)
Lemma something_slips T x y : regular (free_block T) -> null_solution T x y -> s x != 0.
Proof.
move=> reg [x0 yE fy0 _]; apply: contraNneq x0 => sx0.
have fx0 : f x = 0.
  by apply: reg; have := free_rows T x; rewrite yE fy0 sx0 mulmx0 addr0 => <-.
by apply/eqP; rewrite -[x]vsubmxK; apply/col_mx_zero.
Qed.

Lemma mcp_of_solution A B c t x y :
  0 < c -> regular (free_block (A + t *: B)) -> eigenproblem A B t x y ->
  exists2 k, 0 < k & mcp A B c t (k *: x) (k *: y) 0.
Proof.
move=> c0 reg [t0 sol]; have sx := something_slips reg sol.
case: sol => _ yE fy0 comp; have [sx0 _ _] := comp.

have total0 : 0 < \sum_i s x i 0.
  rewrite lt_neqAle sumr_ge0 ?andbT // eq_sym psumr_eq0 //; apply: contra sx => /allP all0.
  by apply/eqP/colP=> i; rewrite [RHS]mxE; apply/eqP/all0/mem_index_enum.

exists (c / \sum_i s x i 0); first exact: divr_gt0.
split; rewrite ?s_scale ?f_scale ?fy0 ?scaler0 ?addr0 //; first by rewrite -scalemxAr yE.
  by under eq_bigr do rewrite mxE; rewrite -mulr_sumr divfK ?gt_eqF.
split; last by rewrite mulr0.
by apply: complementary_scale => //; rewrite divr_ge0 // ltW.
Qed.

(* No hypothesis is needed for the way back. *)
Lemma solution_of_mcp A B c t x y g : 0 < c -> mcp A B c t x y g -> eigenproblem A B t x y.
Proof.
move=> c0 [yE total fy [comp [t0 g0 _]]]; split=> //; split=> //.
apply: contraTneq (ltr_paddr g0 c0) => x0; rewrite -total big1 ?ltxx // => i _.
by rewrite !mxE x0 mxE.
Qed.

Theorem proposition2 K M c :
  0 < c -> (forall t, 0 <= t -> regular (free_block (K + t *: M))) ->
  (exists t x y, eigenproblem K M t x y) <-> (exists t x y g, mcp K M c t x y g).
Proof.
move=> c0 reg; split=> [[t [x [y sol]]]|[t [x [y [g /(solution_of_mcp c0) sol]]]]].
  have [t0 _] := sol; have [k _ mcp_k] := mcp_of_solution c0 (reg t t0) sol.
  by exists t, (k *: x), (k *: y), 0.
by exists t, x, y.
Qed.

Lemma pencil_definite A B t :
  definite (free_block A) -> definite (free_block B) -> 0 <= t ->
  definite (free_block (A + t *: B)).
Proof.
move=> a b t0 x x0.
have -> : free_block (A + t *: B) = free_block A + t *: free_block B.
  by apply/matrixP=> i j; rewrite !mxE.
rewrite /dot mulmxDl mulmxDr mxE ltr_paddr ?a // -scalemxAl -scalemxAr mxE.
by apply: mulr_ge0 => //; apply/ltW/b.
Qed.

Corollary proposition2_definite K M c :
  0 < c -> definite (free_block K) -> definite (free_block M) ->
  (exists t x y, eigenproblem K M t x y) <-> (exists t x y g, mcp K M c t x y g).
Proof.
move=> c0 k m; apply: proposition2 => // t t0.
exact/definite_regular/pencil_definite.
Qed.

Theorem proposition1 K0 K1 c :
  0 < c -> regular (free_block K0) -> usubmx K1 = 0 ->
  (exists t x y, eigenproblem K0 K1 t x y) <-> (exists t x y g, mcp K0 K1 c t x y g).
Proof.
move=> c0 reg f_rows; apply: proposition2 => // t _.
suff -> : free_block (K0 + t *: K1) = free_block K0 by [].
apply/matrixP=> i j; have /matrixP/(_ i (lshift ns j)) := f_rows.
by rewrite /free_block /ulsubmx !mxE => ->; rewrite mulr0 addr0.
Qed.

Lemma dot_blocks x y : dot x y = dot (f x) (f y) + dot (s x) (s y).
Proof.
rewrite !dotE big_split_ord /=; congr (_ + _); apply: eq_bigr => i _; by rewrite !mxE.
Qed.

(* x'Tx = x'y = 0 *)
Lemma form_vanishes T x y : null_solution T x y -> dot x (T *m x) = 0.
Proof. by case=> _ -> fy [_ _ sy]; rewrite dot_blocks fy sy /dot mulmx0 mxE addr0. Qed.

Theorem remark1 K0 K1 t x y : definite K0 -> eigenproblem K0 K1 t x y -> 0 < t.
Proof.
move=> k [t0 sol]; rewrite lt_neqAle t0 andbT; apply: contraTneq isT => t_zero.
have [x0 _ _ _] := sol; have := k _ x0; move/form_vanishes: sol.
by rewrite -t_zero scale0r addr0 => ->; rewrite ltxx.
Qed.

Theorem remark1_gamma K0 K1 c t x y g : 0 < c -> definite K0 -> mcp K0 K1 c t x y g -> g = 0.
Proof.
move=> c0 k sol; have := remark1 k (solution_of_mcp c0 sol).
case: sol => _ _ _ [_ [_ _ /eqP]].
by rewrite mulf_eq0 => /orP[/eqP->|/eqP//]; rewrite ltxx.
Qed.

Theorem necessary_condition_19 K M t x y :
  definite K -> semidefinite M -> ~ eigenproblem K M t x y.
Proof.
move=> k m [t0 sol]; have [x0 _ _ _] := sol; have := k _ x0; move/form_vanishes: sol.
rewrite /dot mulmxDl mulmxDr mxE -scalemxAl -scalemxAr [X in _ + X]mxE => /eqP.
by rewrite addr_eq0 => /eqP->; rewrite oppr_gt0 ltNge mulr_ge0 //; apply: m.
Qed.

End Eigenproblem.

(* The conditions (9) for free, slip and fixed degrees of freedom. *)
Section Mechanics.

Variables nf ns nd : nat.
Notation all_dofs := (nf + (ns + (ns + nd)))%N.

(* G = lambda^2 M + K, the signs S_p = sign(r_Tp), the friction factors, the geometric stiffnesses,
   which are 0 on flat obstacles, and the friction mu. *)
Variables (G : 'M[R]_all_dofs) (sign factor geometric : 'I_ns -> R) (mu : R).
Hypothesis sign_squared : forall i, sign i * sign i = 1.

Notation v_f v := (usubmx v).
Notation v_T v := (usubmx (dsubmx v)).
Notation v_N v := (usubmx (dsubmx (dsubmx v))).
Notation v_d v := (dsubmx (dsubmx (dsubmx v))).

Definition S : 'M[R]_ns := diag_mx (\row_i sign i).
Definition C : 'M[R]_ns := diag_mx (\row_i factor i).

Definition turning i := (1 + (factor i * mu) ^+ 2) * geometric i.

Definition cone (v w : 'cV[R]_all_dofs) i :=
  sign i * v_T w i 0 + mu * (factor i * v_N w i 0) + turning i * (sign i * v_T v i 0).

Definition conditions_9 (v w : 'cV[R]_all_dofs) :=
  [/\ v != 0, G *m v = w, v_f w = 0, v_N v = 0 /\ v_d v = 0 &
      forall i, [/\ sign i * v_T v i 0 <= 0, cone v w i <= 0 &
                    cone v w i * (sign i * v_T v i 0) = 0]].

Notation G_ff := (ulsubmx G).
Notation G_fT := (lsubmx (ursubmx G)).
Notation G_Tf := (usubmx (dlsubmx G)).
Notation G_TT := (ulsubmx (drsubmx G)).
Notation G_Nf := (usubmx (dsubmx (dlsubmx G))).
Notation G_NT := (usubmx (lsubmx (dsubmx (drsubmx G)))).

(* (15), (16); C is the identity without friction factors. *)
Definition G0 := block_mx G_ff (- (G_fT *m S)) (- (S *m G_Tf)) (S *m G_TT *m S).
Definition G1 := block_mx 0 0 (- (C *m G_Nf)) (C *m G_NT *m S) : 'M[R]_(nf + ns).
Definition turning_matrix : 'M[R]_ns := diag_mx (\row_i turning i).
Definition G_star := G0 + mu *: G1 + block_mx 0 0 0 turning_matrix.

(* (10), read from right to left: v_f = x_f, v_T = -S x_T, v_N = 0, v_d = 0. *)
Definition motion (x : 'cV[R]_(nf + ns)) : 'cV[R]_all_dofs :=
  col_mx (usubmx x) (col_mx (- (S *m dsubmx x)) (col_mx 0 0)).

Lemma S_squared : S *m S = 1%:M.
Proof.
apply/matrixP=> i j; rewrite mul_diag_mx !mxE; case: eqP => [->|_].
  by rewrite ?mulr1n sign_squared.
by rewrite mulr0n mulr0.
Qed.

Lemma S_mul n (v : 'M[R]_(ns, n)) i j : (S *m v) i j = sign i * v i j.
Proof. by rewrite mul_diag_mx !mxE. Qed.

Lemma C_mul n (v : 'M[R]_(ns, n)) i j : (C *m v) i j = factor i * v i j.
Proof. by rewrite mul_diag_mx !mxE. Qed.

Lemma turning_mul n (v : 'M[R]_(ns, n)) i j : (turning_matrix *m v) i j = turning i * v i j.
Proof. by rewrite mul_diag_mx !mxE. Qed.

(* (11): the rows of G* x are w_f and -(S w_T + mu C w_N) + diag(turning) x_s. *)
Lemma reaction_rows x (w := G *m motion x) :
  G_star *m x = col_mx (v_f w) (- (S *m v_T w + mu *: (C *m v_N w)) + turning_matrix *m dsubmx x).
Proof.
rewrite /G_star mulmxDl -{2}[x]vsubmxK mul_block_col !mul0mx !add0r.
rewrite -[in RHS](addr0 (v_f w)) -add_col_mx; congr (_ + _).
rewrite -{1}[x]vsubmxK /w /G0 /G1 /motion.
set a := usubmx x; set b := dsubmx x.

have blocks : G = block_mx G_ff (row_mx G_fT (rsubmx (ursubmx G)))
  (col_mx G_Tf (col_mx G_Nf (dsubmx (dsubmx (dlsubmx G)))))
  (block_mx G_TT (ursubmx (drsubmx G))
    (col_mx G_NT (dsubmx (lsubmx (dsubmx (drsubmx G))))) (drsubmx (drsubmx G))).
  rewrite -[LHS]submxK; congr block_mx; rewrite ?hsubmxK ?vsubmxK //.
  by rewrite -[LHS]submxK; congr block_mx; rewrite vsubmxK.

rewrite [in RHS]blocks mul_block_col mul_row_col mul_col_mx mul_block_col.
rewrite !col_mx0 !mulmx0 !addr0 add_col_mx.
rewrite !mul_col_mx !add_col_mx; do 4 rewrite ?col_mxKu ?col_mxKd.
rewrite scale_block_mx !scaler0 add_block_mx mul_block_col !addr0.
congr col_mx; first by rewrite mulNmx mulmxN mulmxA.

rewrite !(mulmxDl, mulmxDr, mulmxN, mulNmx, opprD, opprK, scalerDr, scalerN, mulmxA).
by rewrite -!scalemxAl addrACA.
Qed.

Lemma motion_zero x : (motion x == 0) = (x == 0).
Proof.
rewrite /motion !col_mx_eq0 !eqxx !andbT oppr_eq0 -{3}[x]vsubmxK col_mx_eq0; congr (_ && _).
apply/eqP/eqP=> [Sx|->]; last by rewrite mulmx0.
by rewrite -[LHS]mul1mx -S_squared -mulmxA Sx mulmx0.
Qed.

(* (12)-(14) for x if and only if (9) for the motion of x. *)
Theorem reduction x y :
  null_solution G_star x y <-> conditions_9 (motion x) (G *m motion x) /\ y = G_star *m x.
Proof.
have vT i : sign i * v_T (motion x) i 0 = - dsubmx x i 0.
  by rewrite /motion col_mxKd col_mxKu mxE S_mul mulrN mulrA sign_squared mul1r.
have vN : v_N (motion x) = 0 by rewrite /motion !col_mxKd col_mxKu.
have vd : v_d (motion x) = 0 by rewrite /motion !col_mxKd.
have yf : usubmx (G_star *m x) = v_f (G *m motion x) by rewrite reaction_rows col_mxKu.
have yT i : dsubmx (G_star *m x) i 0 = - cone (motion x) (G *m motion x) i.
  rewrite /cone vT mulrN opprD opprK reaction_rows col_mxKd.
  set a := v_T (G *m _); set b := v_N (G *m _); rewrite mxE turning_mul; congr (_ + _).
  by rewrite mxE [X in - X = _]mxE S_mul; congr (- (_ + _)); rewrite mxE C_mul.

split.
  case=> x0 <- fy /complementaryP[a b c]; split=> //; split; rewrite ?motion_zero -?yf //.
  move=> i; rewrite vT oppr_le0 -oppr_ge0 -yT; split=> //; rewrite ?a ?b //.
  by rewrite mulrN -mulNr -yT mulrC c.

case=> -[x0 _ fw _ H] ->; split=> //; rewrite -?motion_zero ?yf //.
apply/complementaryP; split=> i; have [a b c] := H i.
- by rewrite -oppr_le0 -vT.
- by rewrite yT oppr_ge0.
by rewrite yT -[dsubmx x i 0]opprK -vT mulrNN mulrC.
Qed.

(* Every solution of (9) is the motion of some x. *)
Theorem reduction_onto v w : conditions_9 v w -> exists x, v = motion x.
Proof.
case=> _ _ _ [vN vd] _; exists (col_mx (v_f v) (- (S *m v_T v))).
rewrite /motion col_mxKu col_mxKd mulmxN opprK mulmxA S_squared mul1mx.
rewrite -[LHS]vsubmxK -[X in col_mx _ X]vsubmxK.
by rewrite -[X in col_mx _ (col_mx _ X)]vsubmxK vN vd.
Qed.

End Mechanics.

End Reduction.
