(* A null vector exists where a determinant changes its sign.

   The entries of T(t) are polynomials in t; J, K and k as in Root.v.  Let T be regular on K for
   every t of [a, b].  Then for each t there is exactly one vector with x_k = v_k whose rows K
   vanish, and row k of it is

       phi(t) = v_k det T_JJ(t) / det T_KK(t).

   Theorem [polynomial_null_vector]: if phi(a) and phi(b) have opposite signs, then T(t) has a null
   vector with x_k = v_k for some t in [a, b].  [family_null_vector]: the same for T(t) of which a
   multiple has polynomials as entries; [null_vector_exists]: for T(t) = A + t B.

   R is a real closed field here: a polynomial that changes its sign has a root.  det T_KK has no
   root in [a, b], so det T_JJ changes its sign; it has a root t, and T_JJ(t) has a kernel.

   Page: spec/certificates.md, 5.11 ("why it is sound").
   Rust: crates/check/src/cover/root.rs (outcome "solution"). *)

From Mceip Require Import Base Integers Sums Tree Enclosed Root.

Section Roots.

Variable R : rcfType.

Lemma root_between (p : {poly R}) a b : a <= b -> p.[a] * p.[b] <= 0 ->
  exists2 c, a <= c <= b & root p c.
Proof.
move=> ab sign; have [pa|pa] := lerP p.[a] 0.
  have [pb|pb] := lerP 0 p.[b]; first by apply: poly_ivt; rewrite ?pa.
  have pa0 : p.[a] = 0 by apply/eqP; rewrite eq_le pa -(nmulr_rle0 _ pb) mulrC.
  by exists a; rewrite ?lexx //; apply/rootP.
have pb : p.[b] <= 0 by rewrite -(pmulr_rle0 _ pa).
have [c cab /rootP rc] : exists2 c, a <= c <= b & root (- p) c.
  by apply: poly_ivt => //; rewrite !hornerN oppr_le0 oppr_ge0 pb ltW.
by exists c => //; apply/rootP; move: rc; rewrite hornerN => /eqP; rewrite oppr_eq0 => /eqP.
Qed.

End Roots.

(* A square system over a list of indices K. *)
Section Lists.

Variables (R : fieldType) (K : seq nat).
Hypothesis uniq_K : uniq K.
Notation m := (size K).

(* A column as a function of indices. *)
Definition at_index (v : 'cV[R]_m) j := \sum_(i < m) v i 0 * (nth 0%N K i == j)%:R.

Lemma at_indexE v (i : 'I_m) : at_index v (nth 0%N K i) = v i 0.
Proof.
rewrite /at_index (bigD1 i) //= eqxx mulr1 big1 ?addr0 // => j ji.
by rewrite nth_uniq // -val_eqE /= in ji *; rewrite (negbTE ji) mulr0.
Qed.

Lemma sum_ordinals (f : nat -> R) : \sum_(j <- K) f j = \sum_(i < m) f (nth 0%N K i).
Proof. by rewrite (big_nth 0%N) big_mkord. Qed.

Definition block (M : nat -> nat -> R) := \matrix_(i < m, j < m) M (nth 0%N K i) (nth 0%N K j).

Lemma block_mul M v i :
  (block M *m v) i 0 = \sum_(j <- K) M (nth 0%N K i) j * at_index v j.
Proof. by rewrite sum_ordinals mxE; apply: eq_bigr => j _; rewrite mxE at_indexE. Qed.

Definition injective_on (M : nat -> nat -> R) := forall z,
  (forall l, l \in K -> \sum_(j <- K) M l j * z j = 0) -> forall i, i \in K -> z i = 0.

Lemma block_kernel M (v : 'cV[R]_m) : injective_on M -> block M *m v = 0 -> v = 0.
Proof.
move=> inj Mv; apply/colP=> i; rewrite mxE -at_indexE; apply: (inj (at_index v)).
  by move=> l /(nthP 0%N)[i' li <-]; rewrite -(block_mul M v (Ordinal li)) Mv mxE.
exact: mem_nth.
Qed.

Lemma block_det M : injective_on M -> \det (block M) != 0.
Proof.
move=> inj; rewrite -det_tr; apply/negP=> /det0P[v v0 vM].
have : block M *m v^T = 0 by rewrite -[block M]trmxK -trmx_mul vM trmx0.
by move/(block_kernel inj)/(congr1 trmx); rewrite trmxK trmx0 => v_eq0; rewrite v_eq0 eqxx in v0.
Qed.

End Lists.

Section Exist.

Variable R : rcfType.
Variables (poly_entry : nat -> nat -> {poly R}) (J K : seq nat) (k : nat) (vk : R).
Hypotheses (K_J : forall j, (j \in K) = (j \in J) && (j != k)).
Hypotheses (k_J : k \in J) (uniq_J : uniq J) (uniq_K : uniq K).
Hypothesis vk0 : 0 < vk.

Definition poly_at t i j := (poly_entry i j).[t].
Notation T := poly_at.
Notation m := (size K).

(* T on K, T on J with k in the first place, and both as matrices of polynomials in t. *)
Definition T_K t := block K (T t).

Definition T_J t : 'M[R]_(1 + m) :=
  block_mx (T t k k)%:M (\row_j T t k (nth 0%N K j)) (\col_i T t (nth 0%N K i) k) (T_K t).

Definition poly_K := \matrix_(i < m, j < m) poly_entry (nth 0%N K i) (nth 0%N K j).

Definition poly_J : 'M[{poly R}]_(1 + m) :=
  block_mx (poly_entry k k)%:M (\row_j poly_entry k (nth 0%N K j))
           (\col_i poly_entry (nth 0%N K i) k) poly_K.

Lemma poly_entryE t i j : horner_eval t (poly_entry i j) = T t i j.
Proof. by []. Qed.

Lemma det_K t : (\det poly_K).[t] = \det (T_K t).
Proof.
rewrite -[LHS]/(horner_eval t _) -det_map_mx; congr (\det _).
by apply/matrixP=> i j; rewrite !mxE; exact: poly_entryE.
Qed.

Lemma det_J t : (\det poly_J).[t] = \det (T_J t).
Proof.
rewrite -[LHS]/(horner_eval t _) -det_map_mx /poly_J map_block_mx.
congr (\det (block_mx _ _ _ _)); apply/matrixP=> i j; rewrite !mxE; try exact: poly_entryE.
by rewrite !ord1 !mulr1n; exact: poly_entryE.
Qed.

(* The vector with x_k = vk whose rows K vanish. *)
Definition null_column t : 'cV[R]_m :=
  - (invmx (T_K t) *m \col_i T t (nth 0%N K i) k) *m vk%:M.

Definition extend (v : 'cV[R]_m) j := if j == k then vk else at_index v j.

Definition poly_row t x l := \sum_(j <- J) T t l j * x j.
Notation row := poly_row.

Lemma row_extend t v l : row t (extend v) l = T t l k * vk + \sum_(j <- K) T t l j * at_index v j.
Proof.
rewrite /row (sum_pivot K_J k_J uniq_J uniq_K) /extend eqxx; congr (_ + _).
rewrite big_seq [RHS]big_seq; apply: eq_bigr => j.
by rewrite K_J => /andP[_ /negbTE->].
Qed.

Lemma null_column_rows t l : injective_on K (T t) -> l \in K ->
  row t (extend (null_column t)) l = 0.
Proof.
move=> inj /(nthP 0%N)[i li <-].
have unit_K : T_K t \in unitmx by rewrite unitmxE unitfE block_det.
rewrite row_extend -(block_mul uniq_K (T t) (null_column t) (Ordinal li)).
rewrite /null_column mulmxA mulmxN mulKVmx // mulNmx mul_mx_scalar.
by rewrite 2!mxE [X in _ - _ * X]mxE /=; ring.
Qed.

(* Cramer's rule for phi. *)
Lemma det_phi t : injective_on K (T t) ->
  \det (T_J t) * vk = row t (extend (null_column t)) k * \det (T_K t).
Proof.
move=> inj; have unit_K : T_K t \in unitmx by rewrite unitmxE unitfE block_det.
have -> : \det (T_J t) * vk = \det (T_J t *m block_mx vk%:M 0 (null_column t) 1%:M).
  by rewrite det_mulmx det_lblock det_scalar1 det1 mulr1.
rewrite mulmx_block !mulmx0 !mulmx1 !add0r.
have -> : (\col_i T t (nth 0%N K i) k) *m vk%:M + T_K t *m null_column t = 0.
  by rewrite /null_column mulmxA mulmxN mulKVmx // mulNmx subrr.
rewrite det_ublock det_mx11; congr (_ * _); rewrite row_extend mxE; congr (_ + _).
  by rewrite mxE big_ord1 !mxE !mulr1n.
by rewrite sum_ordinals mxE; apply: eq_bigr => j _; rewrite mxE at_indexE.
Qed.

Theorem polynomial_null_vector a b :
  a <= b -> (forall t, a <= t <= b -> injective_on K (T t)) ->
  (forall x y, x k = vk -> y k = vk ->
     (forall l, l \in K -> row a x l = 0) -> (forall l, l \in K -> row b y l = 0) ->
     row a x k * row b y k < 0) ->
  exists t x, [/\ a <= t <= b, x k = vk & forall l, l \in J -> row t x l = 0].
Proof.
move=> ab inj opposite; have inj_a : injective_on K (T a) by apply: inj; rewrite lexx.
have inj_b : injective_on K (T b) by apply: inj; rewrite ab lexx.
have extend_k v : extend v k = vk by rewrite /extend eqxx.
have phi_opposite := opposite _ _ (extend_k (null_column a)) (extend_k (null_column b))
  (fun l => null_column_rows inj_a) (fun l => null_column_rows inj_b).

(* det T_KK keeps its sign, det T_JJ does not. *)
have same_sign : 0 < \det (T_K a) * \det (T_K b).
  rewrite ltNge; apply/negP; rewrite -!det_K => /(root_between ab)[c cab /rootP].
  rewrite det_K => /eqP; apply/negP; apply: block_det => //; exact: inj.
have [t tab root_t] : exists2 t, a <= t <= b & root (\det poly_J) t.
  apply: root_between => //; rewrite !det_J -(pmulr_lle0 _ (mulr_gt0 vk0 vk0)) mulrACA.
  by rewrite det_phi // det_phi // mulrACA pmulr_lle0 // ltW.

(* A kernel vector of T_JJ(t), scaled. *)
have inj_t := inj _ tab; move: root_t => /rootP; rewrite det_J -det_tr => /eqP/det0P[v v0 vT].
have {vT}Tv : T_J t *m v^T = 0 by rewrite -[T_J t]trmxK -trmx_mul vT trmx0.
pose w := v^T; have w0 : w != 0.
  by apply: contra v0 => /eqP/(congr1 trmx); rewrite trmxK trmx0 => /eqP.
move: Tv; rewrite -/w -[w]vsubmxK mul_block_col => /eqP.
rewrite col_mx_eq0 => /andP[/eqP row_k /eqP rows_K].

have wk : usubmx w 0 0 != 0.
  apply: contra w0 => /eqP wk0.
  have up0 : usubmx w = 0 by apply/colP=> i; rewrite ord1 wk0 mxE.
  move: rows_K; rewrite up0 mulmx0 add0r => /(block_kernel uniq_K inj_t) down0.
  by rewrite -[w]vsubmxK up0 down0 col_mx0.
pose c := vk / usubmx w 0 0.
have cw : c * usubmx w 0 0 = vk by rewrite /c divfK.

exists t, (extend (c *: dsubmx w)); split=> // l lJ.
have scaled j : at_index (c *: dsubmx w) j = c * at_index (dsubmx w) j.
  by rewrite /at_index mulr_sumr; apply: eq_bigr => i _; rewrite mxE mulrA.
have -> : row t (extend (c *: dsubmx w)) l =
          c * (T t l k * usubmx w 0 0 + \sum_(j <- K) T t l j * at_index (dsubmx w) j).
  rewrite row_extend -cw mulrDr mulr_sumr; congr (_ + _); first by rewrite mulrCA mulrA.
  by apply: eq_bigr => j _; rewrite scaled mulrCA.
suff -> : T t l k * usubmx w 0 0 + \sum_(j <- K) T t l j * at_index (dsubmx w) j = 0.
  by rewrite mulr0.

have [->|lk] := eqVneq l k.
  have := congr1 (fun M : 'cV_1 => M 0 0) row_k.
  rewrite [X in _ = X]mxE mxE => e; rewrite -[RHS]e; congr (_ + _).
    by rewrite mul_scalar_mx [RHS]mxE.
  by rewrite sum_ordinals mxE; apply: eq_bigr => j _; rewrite mxE at_indexE.
have : l \in K by rewrite K_J lJ.
case/(nthP 0%N)=> i li <-; have := congr1 (fun M : 'cV_m => M (Ordinal li) 0) rows_K.
rewrite [X in _ = X]mxE mxE (block_mul uniq_K (T t) _ (Ordinal li)) => e; rewrite -[RHS]e.
by congr (_ + _); rewrite [RHS]mxE big_ord1 [X in _ = X * _]mxE.
Qed.

(* The same for a family F, with d(t) F(t) = T(t) and d(t) not 0. *)
Theorem family_null_vector (F : R -> nat -> nat -> R) (d : {poly R}) a b :
  a <= b -> (forall t, a <= t <= b -> d.[t] != 0) ->
  (forall t i j, a <= t <= b -> i \in J -> j \in J -> T t i j = d.[t] * F t i j) ->
  (forall t, a <= t <= b -> injective_on K (F t)) ->
  (forall x y, x k = vk -> y k = vk ->
     (forall l, l \in K -> \sum_(j <- J) F a l j * x j = 0) ->
     (forall l, l \in K -> \sum_(j <- J) F b l j * y j = 0) ->
     (\sum_(j <- J) F a k j * x j) * (\sum_(j <- J) F b k j * y j) < 0) ->
  exists t x, [/\ a <= t <= b, x k = vk & forall l, l \in J -> \sum_(j <- J) F t l j * x j = 0].
Proof.
move=> ab d0 TE inj opposite; have K_sub l : l \in K -> l \in J by rewrite K_J => /andP[].
have rowE t x l : a <= t <= b -> l \in J -> row t x l = d.[t] * \sum_(j <- J) F t l j * x j.
  by move=> tt lJ; rewrite /row mulr_sumr; apply: sum_eq => j jJ; rewrite TE // mulrA.
have zero t x l : a <= t <= b -> l \in J -> row t x l = 0 -> \sum_(j <- J) F t l j * x j = 0.
  by move=> tt lJ; rewrite rowE // => /eqP; rewrite mulf_eq0 (negbTE (d0 t tt)) => /eqP.
have [at_a at_b] : (a <= a <= b) /\ (a <= b <= b) by rewrite !lexx ab.
have [|x y xk yk rows_x rows_y|t [x [tt xk rows]]] := polynomial_null_vector ab.
- move=> t tt z rows; apply: (inj t tt) => l lK; apply: (mulfI (d0 t tt)).
  rewrite mulr0 -[RHS](rows l lK) mulr_sumr; apply: sum_eq => j jK.
  by rewrite TE ?K_sub // mulrA.
- rewrite !rowE // mulrACA pmulr_rlt0; first by apply: opposite => // l lK; apply: zero; auto.
  by rewrite ltNge; apply/negP=> /(root_between ab)[t tt /rootP]; apply/eqP/d0.
by exists t, x; split=> // l lJ; apply: zero; auto.
Qed.

End Exist.

(* The same for a pencil. *)
Section Linear.

Variable R : rcfType.
Variables (A B : nat -> nat -> R) (J K : seq nat) (k : nat) (vk : R).
Hypotheses (K_J : forall j, (j \in K) = (j \in J) && (j != k)).
Hypotheses (k_J : k \in J) (uniq_J : uniq J) (uniq_K : uniq K).
Hypothesis vk0 : 0 < vk.

Notation T := (T A B).

Definition row t x l := \sum_(j <- J) T t l j * x j.

Definition linear_entry i j : {poly R} := (A i j)%:P + (B i j)%:P * 'X.

Lemma linear_entryE t i j : poly_at linear_entry t i j = T t i j.
Proof. by rewrite /poly_at /linear_entry /Enclosed.T !hornerE mulrC. Qed.

Theorem null_vector_exists a b :
  a <= b -> (forall t, a <= t <= b -> injective_on K (T t)) ->
  (forall x y, x k = vk -> y k = vk ->
     (forall l, l \in K -> row a x l = 0) -> (forall l, l \in K -> row b y l = 0) ->
     row a x k * row b y k < 0) ->
  exists t x, [/\ a <= t <= b, x k = vk & forall l, l \in J -> row t x l = 0].
Proof.
move=> ab.
apply: (family_null_vector (poly_entry := linear_entry) K_J k_J
  uniq_J uniq_K vk0 (d := 1)) => // t *.
  by rewrite hornerC oner_neq0.
by rewrite hornerC mul1r linear_entryE.
Qed.

(* A vector on the left of T at a point, if the rows K vanish. *)
Lemma left_pivot (u : nat -> R) e t x : toR e.1 = t * toR e.2 ->
  (forall l, l \in K -> row t x l = 0) ->
  \sum_(l <- J) u l * (\sum_(j <- J) T_end A B e l j * x j) = u k * (toR e.2 * row t x k).
Proof.
move=> e1 rows; have rowE l : \sum_(j <- J) T_end A B e l j * x j = toR e.2 * row t x l.
  rewrite /row mulr_sumr; apply: eq_bigr => j _; rewrite /T_end e1 /Enclosed.T.
  by move: (A _ _) (B _ _) (x _) => *; ring.
rewrite (sum_pivot K_J k_J uniq_J uniq_K) rowE [X in _ + X]sum_zero ?addr0 // => l lK.
by rewrite rowE rows // !mulr0.
Qed.

End Linear.

(* Opposite signs of multiples. *)
Lemma opposite_products (R : realFieldType) (u q q' s s' : R) : 0 < u -> 0 < q -> 0 < q' ->
  u * (q * s) < 0 /\ 0 < u * (q' * s') \/ 0 < u * (q * s) /\ u * (q' * s') < 0 -> s * s' < 0.
Proof.
move=> u0 q0 q0'; rewrite !(pmulr_rlt0 _ u0, pmulr_rgt0 _ u0, pmulr_rlt0 _ q0, pmulr_rgt0 _ q0,
  pmulr_rlt0 _ q0', pmulr_rgt0 _ q0').
by case=> -[a b]; [rewrite nmulr_rlt0 | rewrite pmulr_rlt0].
Qed.
