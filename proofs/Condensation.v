(* Elimination of the free variables behind a rounded inverse.

   A pencil in blocks, f for the free variables and s for the complementarity variables, with no t
   in the free rows:

       [ F    G   ]     z'Fz > 0 for z != 0         y_f = F x_f + G x_s = 0
       [ H(t) D(t)]     H = H_a + t H_b,            y_s = H(t) x_f + D(t) x_s
                        D = D_a + t D_b

   With x_f = -F^-1 G x_s the complementarity rows are those of the condensed pencil
   T(t) = D(t) - H(t) F^-1 G.  F^-1 G is not known; an integer matrix W with F W about u G is, and
   V_a, V_b with F' V about u H'.  With r = u G - F W and l = u H' - F' V,

       u^2 (D - H F^-1 G) = u^2 D - u H W - V' r - l' F^-1 r.

   The last term is the radius: if z'Fz >= (d/c) z'z, then |F^-1 r| <= (c/d) |r| in Euclidean norms,
   so |l' F^-1 r| <= (c/d) |l|_1 |r|_1.  The lower bound d/c is shown by a factor of the symmetric
   part of F (Bounded.v).

   Theorem [condensation_encloses]: the integer matrices computed here enclose the exact condensed
   pencil.  Theorem [condensation_exact]: (x_f, x_s) solves the pencil in blocks if and only if x_s
   solves the condensed one and x_f = -F^-1 G x_s.

   Page: spec/certificates.md, 5.14 (the linear family at center 0).
   Rust: crates/check/src/cover/condensed.rs, expanded.rs, psd.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Root Existence Norms Elimination.
From Mceip Require Export Bounded.

(* Sparse rows of F; one list over the free variables for each column of G and for each row of H_a
   and H_b; dense D_a and D_b. *)
Record blocks := Blocks {
  free_count : nat;
  slip_count : nat;
  ff : seq sparse_row;
  fs : matrix;
  sf_a : matrix;
  sf_b : matrix;
  ss_a : matrix;
  ss_b : matrix }.

(* A positive factor for each row, u, W, V_a, V_b (lists over the free variables, one for each
   complementarity variable), and c, d, m, L with c (F + F') - 2 d I covered by 2 m L L'. *)
Record elimination := Elimination {
  row_scale : seq Z;
  unit_of : Z;
  right_w : matrix;
  left_va : matrix;
  left_vb : matrix;
  bound_c : Z;
  bound_d : Z;
  factor_scale : Z;
  stiffness_factor : seq late_row }.

Section Checker.

Local Open Scope Z_scope.

Definition sparse_dot (row : sparse_row) (x : seq Z) : Z :=
  foldr (fun entry sum => entry.2 * nth 0 x entry.1 + sum) 0 row.

Definition norm1 (l : seq Z) : Z := foldr (fun x sum => Z.abs x + sum) 0 l.

Definition row_of (m : matrix) i := nth [::] m i.

(* The least integer that is at least x / d, for d > 0. *)
Definition divide_up x d := - ((- x) / d).

Variables (D : blocks) (w : elimination).

(* c (F + F') - 2 d I is covered by 2 m L L'. *)
Definition eliminated_bound :=
  FormBound (bound_c w) (bound_d w) (factor_scale w) (stiffness_factor w).

Definition stiffness_positive :=
  [&& 0 <? bound_d w, all (fun row => all (fun entry => entry.1 < free_count D)%N row) (ff D) &
      bounded_rows (free_count D) (ff D) eliminated_bound].

(* u G_j - F X_j for a column j and the rows of F *)
Definition residual_by (rows : seq sparse_row) (G X : matrix) j :=
  let g := row_of G j in
  let x := row_of X j in
  map_from (fun i row => unit_of w * nth 0 g i - sparse_dot row x) 0 rows.

Definition residual_column := residual_by (ff D).

Definition table (f : nat -> nat -> Z) : matrix :=
  [seq [seq f i j | j <- iota 0 (slip_count D)] | i <- iota 0 (slip_count D)].

Definition condensed_center ss sf v (r : matrix) : matrix := table (fun i j =>
  nth 0 (row_scale w) i *
  (unit_of w * unit_of w * entry ss i j - unit_of w * dot (row_of sf i) (row_of (right_w w) j)
   - dot (row_of v i) (row_of r j))).

Definition condensed_radius (norms_l norms_r : seq Z) : matrix := table (fun i j =>
  divide_up (nth 0 (row_scale w) i * (nth 0 norms_l i * nth 0 norms_r j * bound_c w)) (bound_d w)).

Definition condensed : enclosed :=
  let columns rows G X := [seq residual_by rows G X j | j <- iota 0 (slip_count D)] in
  let turned := transposed (ff D) in
  let r := columns (ff D) (fs D) (right_w w) in
  let norms_r := [seq norm1 c | c <- r] in
  let norms_a := [seq norm1 c | c <- columns turned (sf_a D) (left_va w)] in
  let norms_b := [seq norm1 c | c <- columns turned (sf_b D) (left_vb w)] in
  Enclosed (slip_count D)
    (condensed_center (ss_a D) (sf_a D) (left_va w) r)
    (condensed_center (ss_b D) (sf_b D) (left_vb w) r)
    (condensed_radius norms_a norms_r) (condensed_radius norms_b norms_r).

Definition shapes :=
  [&& 0 <? unit_of w,
      all (fun i => 0 <? nth 0 (row_scale w) i) (iota 0 (slip_count D)) &
      all (fun i => all (fun m => size (row_of m i) <= free_count D)%N
             [:: fs D; sf_a D; sf_b D; right_w w; left_va w; left_vb w])
        (iota 0 (slip_count D))].

Definition check_elimination := stiffness_positive && shapes.

End Checker.

Section Lists.

Variable R : realFieldType.

Lemma toR_lookup row j :
  toR (lookup row j) = \sum_(e <- row) (if e.1 == j then toR e.2 else 0) :> R.
Proof.
elim: row => [|e row IH]; rewrite ?big_nil ?big_cons //= -IH.
by case: eqP => _; rewrite ?toRD ?add0r.
Qed.

(* A row times a vector is the sum over its entries. *)
Lemma sum_lookup n (row : sparse_row) (x : nat -> R) : all (fun e => e.1 < n)%N row ->
  \sum_(k <- iota 0 n) toR (lookup row k) * x k = \sum_(e <- row) toR e.2 * x e.1.
Proof.
move=> /allP columns; under eq_bigr do rewrite toR_lookup mulr_suml.
rewrite exchange_big big_seq [RHS]big_seq; apply: eq_bigr => e e_row.
rewrite (bigD1_seq e.1) ?iota_uniq //=; last by rewrite mem_iota add0n; apply: columns.
rewrite eqxx big1 ?addr0 // => k /negbTE; rewrite eq_sym => ->.
by rewrite mul0r.
Qed.

Lemma toR_sparse_dot n row x : all (fun e => e.1 < n)%N row ->
  toR (sparse_dot row x) = \sum_(k <- iota 0 n) toR (lookup row k) * toR (nth 0%Z x k) :> R.
Proof.
move=> columns; rewrite sum_lookup //; elim: row {columns} => [|e row IH].
  by rewrite big_nil.
by rewrite big_cons /= toRD toRM IH.
Qed.

Lemma toR_norm1 l n : (size l <= n)%N ->
  toR (norm1 l) = \sum_(k <- iota 0 n) `|toR (nth 0%Z l k)| :> R.
Proof.
elim: l n => [|x l IH] n; first by move=> _; rewrite sum_zero // => k _; rewrite nth_nil normr0.
case: n => // n sn; rewrite /= big_cons toRD toR_abs (IH n) //; congr (_ + _).
by rewrite (sum_shift 1).
Qed.

End Lists.

Lemma divide_up_ge x d : (0 <? d)%Z -> (x <=? divide_up x d * d)%Z.
Proof.
move=> /Z.ltb_spec0 d0; apply/Z.leb_spec0; rewrite /divide_up.
have := Z.mul_div_le (- x) _ d0; move: ((- x) / d)%Z => q; clear; nia.
Qed.

Section Sound.

Variable R : rcfType.
Variables (D : blocks) (w : elimination).
Notation free_ix := (iota 0 (free_count D)).
Notation slip_ix := (iota 0 (slip_count D)).
Notation u := (toR (unit_of w) : R).

Definition F i k : R := toR (lookup (nth [::] (ff D) i) k).
Definition at_ (m : matrix) j k : R := toR (nth 0%Z (row_of m j) k).
Definition scale_of i : R := toR (nth 0%Z (row_scale w) i).

Definition free_row (xf xs : nat -> R) i :=
  \sum_(k <- free_ix) F i k * xf k + \sum_(j <- slip_ix) at_ (fs D) j i * xs j.

Definition slip_row t (xf xs : nat -> R) i :=
  \sum_(k <- free_ix) (at_ (sf_a D) i k + t * at_ (sf_b D) i k) * xf k +
  \sum_(j <- slip_ix) (toR (entry (ss_a D) i j) + t * toR (entry (ss_b D) i j)) * xs j.

(* A solution of the pencil in blocks. *)
Definition block_solution t (xf xs : nat -> R) :=
  [/\ 0 <= t,
      (exists2 i, i \in free_ix & xf i != 0) \/ (exists2 i, i \in slip_ix & xs i != 0),
      forall i, i \in free_ix -> free_row xf xs i = 0 &
      forall i, i \in slip_ix ->
        [/\ 0 <= xs i, 0 <= slip_row t xf xs i & xs i * slip_row t xf xs i = 0]].

Hypotheses (positive : stiffness_positive D w) (shaped : shapes D w).

Lemma unit_gt0 : 0 < u.
Proof. by case/and3P: shaped => ? _ _; rewrite toR_gt0. Qed.

Lemma rows_bounded : bounded_rows (free_count D) (ff D) (eliminated_bound w).
Proof. by case/and3P: positive. Qed.

Lemma c_gt0 : 0 < toR (bound_c w) :> R.
Proof. exact: (bound_times_gt0 R rows_bounded). Qed.

Lemma d_gt0 : 0 < toR (bound_d w) :> R.
Proof. by case/and3P: positive => ? *; rewrite toR_gt0. Qed.

Lemma scale_gt0 i : i \in slip_ix -> 0 < scale_of i.
Proof. by case/and3P: shaped => _ /allP H _ /H; rewrite /scale_of toR_gt0. Qed.

Lemma size_ff : size (ff D) = free_count D.
Proof. exact: size_bounded rows_bounded. Qed.

Lemma columns_ff i : all (fun e => e.1 < free_count D)%N (nth [::] (ff D) i).
Proof.
case/and3P: positive => _ /allP columns _.
have [l|l] := ltnP i (size (ff D)); last by rewrite nth_default.
by apply/columns/mem_nth.
Qed.

(* c z'Fz >= d z'z *)
Lemma F_bounded (z : nat -> R) :
  toR (bound_d w) * (\sum_(k <- free_ix) z k ^+ 2) <=
  toR (bound_c w) * (\sum_(i <- free_ix) \sum_(k <- free_ix) z i * F i k * z k).
Proof. exact: bounded_rows_sound rows_bounded z. Qed.

Notation s := (toR (bound_d w) / toR (bound_c w) : R).

Let s0 : 0 < s.
Proof. by rewrite divr_gt0 ?c_gt0 ?d_gt0. Qed.

Let below : bounded_below (free_count D) F s.
Proof.
move=> z; rewrite -(ler_pmul2l c_gt0) mulrA [_ * s]mulrC divfK ?gt_eqF ?c_gt0 //.
exact: F_bounded.
Qed.

(* F^-1 G *)
Definition inverse_fs j := solve (free_count D) F (at_ (fs D) j).

(* The exact condensed pencil, its rows multiplied by scale_i u^2. *)
Definition condensed_entry (sf ss : matrix) i j : R :=
  scale_of i * u ^+ 2 *
  (toR (entry ss i j) - \sum_(k <- free_ix) at_ sf i k * inverse_fs j k).

Definition A_condensed := condensed_entry (sf_a D) (ss_a D).
Definition B_condensed := condensed_entry (sf_b D) (ss_b D).

Lemma residual_byE rows (G X : matrix) j i : size rows = free_count D ->
  all (fun e => e.1 < free_count D)%N (nth [::] rows i) -> i \in free_ix ->
  toR (nth 0%Z (residual_by w rows G X j) i) =
  u * at_ G j i - \sum_(k <- free_ix) toR (lookup (nth [::] rows i) k) * at_ X j k.
Proof.
move=> size_r columns; rewrite mem_iota add0n /= => Hi.
rewrite (nth_map_from [::]) ?size_r // add0n toRB toRM.
by rewrite (toR_sparse_dot R _ columns).
Qed.

Lemma residual_columnE (G X : matrix) j i : i \in free_ix ->
  toR (nth 0%Z (residual_column D w G X j) i) =
  u * at_ G j i - \sum_(k <- free_ix) F i k * at_ X j k.
Proof. exact: residual_byE size_ff (columns_ff i). Qed.

Lemma size_residual G X j : size (residual_column D w G X j) = free_count D.
Proof. by rewrite size_map_from size_ff. Qed.

(* The same with F'. *)
Lemma size_turned : size (transposed (ff D)) = free_count D.
Proof. by case/and3P: positive => _ + _; rewrite -size_ff; apply: size_transposed. Qed.

Lemma residual_turnedE (G X : matrix) j i : i \in free_ix ->
  toR (nth 0%Z (residual_by w (transposed (ff D)) G X j) i) =
  u * at_ G j i - \sum_(k <- free_ix) F k i * at_ X j k.
Proof.
move=> Hi; rewrite residual_byE ?size_turned //; last by rewrite -size_ff transposed_range.
by congr (_ - _); apply: eq_bigr => k _; rewrite lookup_transposed.
Qed.

Lemma condensed_near (sf ss v : matrix) i j :
  i \in slip_ix -> j \in slip_ix ->
  (size (row_of sf i) <= free_count D)%N -> (size (row_of v i) <= free_count D)%N ->
  forall r, r = [seq residual_column D w (fs D) (right_w w) j | j <- slip_ix] ->
  `|condensed_entry sf ss i j - toR (entry (condensed_center D w ss sf v r) i j)| <=
  toR (entry (condensed_radius D w
               [seq norm1 c | c <- [seq residual_by w (transposed (ff D)) sf v j | j <- slip_ix]]
               [seq norm1 c | c <- r]) i j).
Proof.
move=> Hi Hj size_sf size_v r Er.
have := Hi; have := Hj; rewrite !mem_iota !add0n /= => lt_j lt_i.
have n_i : nth 0%N slip_ix i = i by rewrite nth_iota.
have n_j : nth 0%N slip_ix j = j by rewrite nth_iota.
have tableE f : entry (table D f) i j = f i j.
  by rewrite /entry /table (nth_map 0%N) ?size_iota // (nth_map 0%N) ?size_iota // n_i n_j.
have r_j : row_of r j = residual_column D w (fs D) (right_w w) j.
  by rewrite /row_of Er (nth_map 0%N) ?size_iota // n_j.
rewrite /condensed_center /condensed_radius !tableE r_j Er -!map_comp.
rewrite !(nth_map 0%N) ?size_iota // n_i n_j /=.

set rr := residual_column D w (fs D) (right_w w) j.
set ll := residual_by w (transposed (ff D)) sf v i.
pose L k : R := toR (nth 0%Z ll k); pose Rr k : R := toR (nth 0%Z rr k).
pose residual := residual_r (free_count D) F (fun k j => at_ (fs D) j k) u
  (fun k j => at_ (right_w w) j k) j.
pose z := solve (free_count D) F residual.
have RE k : k \in free_ix -> residual k = Rr k by move=> Hk; rewrite /Rr residual_columnE.
have Fz k : k \in free_ix -> \sum_(k' <- free_ix) F k k' * z k' = Rr k.
  by move=> Hk; rewrite (solveP s0 below) // RE.

(* The error is scale l' z. *)
have error : condensed_entry sf ss i j -
    toR (nth 0 (row_scale w) i *
         (unit_of w * unit_of w * entry ss i j -
          unit_of w * dot (row_of sf i) (row_of (right_w w) j) - dot (row_of v i) rr))%Z =
    - (scale_of i * \sum_(k <- free_ix) L k * z k).
  have := condensed_residual s0 below (fun k j => at_ (fs D) j k) (at_ sf)
    (fun i j => toR (entry ss i j)) u (fun k j => at_ (right_w w) j k) (fun k i => at_ v i k) i j.
  rewrite -/residual -/z /condensed_entry -[scale_of i * _ * _]mulrA => ->.
  have -> : \sum_(k <- free_ix) residual_l (free_count D) F (at_ sf) u (fun k i => at_ v i k) i k *
      z k = \sum_(k <- free_ix) L k * z k.
    by apply: sum_eq => k Hk; rewrite /L residual_turnedE.
  rewrite toRM !toRB !toRM (toR_dot R _ size_sf) (toR_dot R _ size_v) /approximate -/residual.
  rewrite -/(scale_of i) [X in _ * (_ - _ - X - _)](sum_eq (g := fun k => at_ v i k * Rr k)).
    by move: (\sum_(k <- free_ix) _) (\sum_(k <- free_ix) _) (\sum_(k <- free_ix) _) => *; ring.
  by move=> k Hk; rewrite RE.

rewrite error normrN normrM gtr0_norm ?scale_gt0 //.
have norm_l : toR (norm1 ll) = \sum_(k <- free_ix) `|L k|.
  by rewrite (toR_norm1 R (n := free_count D)) // size_map_from size_turned.
have norm_r : toR (norm1 rr) = \sum_(k <- free_ix) `|Rr k|.
  by rewrite (toR_norm1 R (n := free_count D)) // size_residual.

rewrite -(ler_pmul2r d_gt0); apply: (@le_trans _ _
    (toR (nth 0%Z (row_scale w) i * (norm1 ll * norm1 rr * bound_c w))%Z)); last first.
  rewrite -toRM toR_le; apply: divide_up_ge; by case/and3P: positive.
rewrite !toRM -/(scale_of i) -[X in X <= _]mulrA ler_pmul2l ?scale_gt0 //.
rewrite norm_l norm_r -ler_pdivl_mulr ?d_gt0 //.
apply: le_trans (dot_bound (norm_sum _ L) (norm_of_solution s0 below Fz (norm_sum _ Rr))) _.
by rewrite invf_div !mulrA.
Qed.

Lemma sizes i : i \in slip_ix ->
  forall m, m \in [:: fs D; sf_a D; sf_b D; right_w w; left_va w; left_vb w] ->
  (size (row_of m i) <= free_count D)%N.
Proof. by case/and3P: shaped => _ _ /allP H /H/allP. Qed.

Theorem condensation_encloses : encloses (condensed D w) A_condensed B_condensed.
Proof.
move=> i j Hi Hj; have s := sizes Hi.
by split; apply: condensed_near => //; apply: s; rewrite !inE eqxx ?orbT.
Qed.

(* The free variables of a solution. *)
Definition free_part xs k := - \sum_(j <- slip_ix) inverse_fs j k * xs j.

Lemma free_rows_vanish (xf xs : nat -> R) :
  (forall i, i \in free_ix -> free_row xf xs i = 0) <->
  (forall k, k \in free_ix -> xf k = free_part xs k).
Proof. exact: (Elimination.free_rows_vanish s0 below _ (fun i j => at_ (fs D) j i)). Qed.

Lemma condensed_image t xf xs i :
  (forall k, k \in free_ix -> xf k = free_part xs k) -> i \in slip_ix ->
  image (condensed D w) A_condensed B_condensed t xs i =
  scale_of i * u ^+ 2 * slip_row t xf xs i.
Proof.
move=> H Hi; rewrite /image /slip_row.
have -> : \sum_(k <- free_ix) (at_ (sf_a D) i k + t * at_ (sf_b D) i k) * xf k =
    - \sum_(j <- slip_ix) (\sum_(k <- free_ix) at_ (sf_a D) i k * inverse_fs j k +
                           t * (\sum_(k <- free_ix) at_ (sf_b D) i k * inverse_fs j k)) * xs j.
  under eq_big_seq => k Hk do rewrite H // /free_part mulrN mulr_sumr.
  rewrite sumrN exchange_big; congr (- _); apply: eq_bigr => j _.
  rewrite mulr_sumr -big_split mulr_suml; apply: eq_bigr => k _ /=.
  by move: (at_ _ _ _) (at_ _ _ _) (inverse_fs _ _) (xs _) => *; ring.

rewrite -sumrN -big_split mulr_sumr; apply: eq_bigr => j _ /=.
rewrite /T /A_condensed /B_condensed /condensed_entry.
move: (\sum_(k <- free_ix) at_ (sf_a D) i k * inverse_fs j k) => a.
move: (\sum_(k <- free_ix) at_ (sf_b D) i k * inverse_fs j k) => b.
move: (scale_of i) (toR (unit_of w)) (toR (entry (ss_a D) i j)) => p q e.
by move: (toR (entry (ss_b D) i j)) (xs j) => f x; ring.
Qed.

Lemma factor_gt0 i : i \in slip_ix -> 0 < scale_of i * u ^+ 2.
Proof. by move=> Hi; rewrite mulr_gt0 ?scale_gt0 // exprn_gt0 // unit_gt0. Qed.

Theorem condensation_exact t xf xs :
  block_solution t xf xs <->
  solves (condensed D w) A_condensed B_condensed t xs /\
  forall k, k \in free_ix -> xf k = free_part xs k.
Proof.
split=> [[t0 nonzero /free_rows_vanish xfE rows]|[[t0 nonzero rows] xfE]].
  split=> //; split=> //; last first.
    move=> i Hi; rewrite (condensed_image t xfE Hi).
    exact/(complementary_scaled _ _ (factor_gt0 Hi))/rows.
  case: nonzero => // -[k Hk xk].
  have [/hasP[i Hi xi]|/hasPn all0] := boolP (has (fun i => xs i != 0) slip_ix).
    by exists i.
  move: xk; rewrite xfE // /free_part sum_zero ?oppr0 ?eqxx // => j Hj.
  by have /negPn/eqP-> := all0 _ Hj; rewrite mulr0.

split=> //; first by right.
  exact/free_rows_vanish.
move=> i Hi; apply/(complementary_scaled _ _ (factor_gt0 Hi)).
by rewrite -(condensed_image t xfE Hi); apply: rows.
Qed.

End Sound.
