(* Enclosed solution claims: a solution in a box.

   A claim names a support and an interval [from, to] of values.  The active variables J are the
   free ones and those of the support; k is one of the support (the pivot), K = J without k.  V is
   an integer vector on J, Y an integer matrix on K, W >= 0 an integer, u an integer vector on J.
   T_e is the matrix q A + p B at an end e = (p, q) of the interval.

   1. Regular.  At both ends e and for each row i of K, with G = T_e Y (K rows, K columns),

          sum_j |G_ij| < 2 G_ii,        |(T_e V)_i| <= (2 G_ii - sum_j |G_ij|) W.

      So G is dominated by its diagonal for each t of the interval: T(t) is regular on K, and the
      vector with x_k = V_k whose rows K vanish differs from V by at most

          eps_i = W N_i,        N_i = sum_j |Y_ij|.

   2. Sign change.  u' T_e V exceeds sum_j |u' T_e|_j eps_j in absolute value at both ends, with
      opposite signs, and u_k > 0.  So det T_JJ(t) has a root in the interval.

   3. Signs.  V_j > eps_j on the support, and (T_e V)_i > sum_j |T_e|_ij eps_j at both ends for
      every other complementarity variable i.

   4. At most one.  For two null vectors (t, x), (t', x') with x_k = x'_k = V_k and t != t'

          T(t) d = -B x',        d = (x - x') / (t - t'),        d_k = 0.

      If |(B x')_i| <= (2 G_ii - sum_j |G_ij|) W' for i in K, then |d_j| <= W' N_j as in 1; so
      |u' B x'| = |u' T(t) d| <= W' sum_j |u' T(t)|_j N_j.  The check is that this is false for
      every x' within eps of V.

   Y stands on the right, so a product with the sparse rows of A and B costs order^2 times the
   entries of a row; there are two of them.  There is no condensation: B may have entries in the
   free rows.  No fixed point theorem is needed: the existence of a solution is a change of sign of
   a polynomial, which has a root over every real closed field.

   Theorem [enclosed_claim_sound]: if the claim is checked, then the pencil has a solution with this
   support, its value between from and to, and y_i > 0 off the support; and it is the only solution
   with this support and a value in the interval, up to a positive factor.

   Page: spec/certificates.md, 5.5.  Rust: crates/check/src/enclosed_solution.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Root Existence RootLeaf
  Condensation Pencil Claim.

(* The vectors have an entry, the matrix a row for each variable of the pencil; the rows of Y have
   an entry for each variable of K, in its order, and are empty off K. *)
Record enclosed_claim := EnclosedClaim {
  box_support : seq nat;
  box_from : point;
  box_to : point;
  box_pivot : nat;
  box_center : seq Z;
  right_inverse : matrix;
  box_width : Z;
  rate_width : Z;  (* W' *)
  left_null : seq Z }.

Section Checker.

Local Open Scope Z_scope.

(* The same for a sparse row x. *)
Definition scatter (c : Z) (row : sparse_row) (y : seq Z) : seq Z :=
  foldr (fun e y => set_nth 0 y e.1 (c * e.2 + nth 0 y e.1)) y row.

(* The sum of |entry| w_j over a row. *)
Definition absolute_dot (row : sparse_row) (w : seq Z) : Z :=
  foldr (fun e sum => Z.abs e.2 * nth 0 w e.1 + sum) 0 row.

(* q a + p b at the end (p, q). *)
Definition at_end (e : point) (a b : Z) := e.2 * a + e.1 * b.
Definition row_at_end (e : point) (a b : seq Z) := add_multiple e.2 a (add_multiple e.1 b [::]).

Variables (Q : pencil) (c : enclosed_claim).

Notation Y := (right_inverse c).
Notation V := (box_center c).
Notation W := (box_width c).
Notation W' := (rate_width c).
Notation u := (left_null c).

Definition box_active i := (i \in free Q) || (i \in box_support c).
Definition active_list := [seq i <- iota 0 (order Q) | box_active i].
Definition pivot_removed := [seq i <- active_list | i != box_pivot c].

(* [l] is K, which is computed once. *)
Definition inverse_vanishes_off (l : seq nat) :=
  all (fun j => (j \in l) || (norm1 (nth [::] Y j) =? 0)) (iota 0 (order Q)).

Definition vanishes_elsewhere :=
  all (fun j => box_active j || (nth 0 V j =? 0)) (iota 0 (order Q)) &&
  inverse_vanishes_off pivot_removed.

Notation times_inverse := (combine_row Y).

Definition margin (g : seq Z) p := 2 * nth 0 g p - norm1 g.

(* [rate] is a bound of |(B x)_i| for x within eps of V. *)
Definition dominated p (g : seq Z) (residual rate : Z) :=
  [&& 0 <? margin g p, Z.abs residual <=? margin g p * W & rate <=? margin g p * W'].

Definition dominated_at e p (ga gb : seq Z) (ra rb rate : Z) :=
  dominated p (row_at_end e ga gb) (at_end e ra rb) (e.2 * rate).

Definition dominated_ends p ga gb ra rb rate :=
  dominated_at (box_from c) p ga gb ra rb rate && dominated_at (box_to c) p ga gb ra rb rate.

(* Row p of the list K is row i of the pencil. *)
Definition regular_row eps p i :=
  dominated_ends p (times_inverse (row_a Q i)) (times_inverse (row_b Q i))
    (sparse_dot (row_a Q i) V) (sparse_dot (row_b Q i) V)
    (Z.abs (sparse_dot (row_b Q i) V) + absolute_dot (row_b Q i) eps).

(* N and eps *)
Definition norms : seq Z := [seq norm1 row | row <- Y].
Definition widths : seq Z := [seq norm1 row * W | row <- Y].

(* u' A and u' B on J, for the rows of A and B. *)
Definition left_times (rows : nat -> sparse_row) : seq Z :=
  foldr (fun i sum => scatter (nth 0 u i) (rows i) sum) [::] active_list.

Definition left_value (rows : nat -> sparse_row) : Z :=
  sumZ active_list (fun i => nth 0 u i * sparse_dot (rows i) V).

Definition weighted_norm (l eps : seq Z) : Z :=
  sumZ pivot_removed (fun j => Z.abs (nth 0 l j) * nth 0 eps j).

Definition above_radius eps la lb va vb e :=
  weighted_norm (row_at_end e la lb) eps <? at_end e va vb.
Definition below_radius eps la lb va vb e :=
  at_end e va vb + weighted_norm (row_at_end e la lb) eps <? 0.

Definition opposite_signs eps la lb va vb :=
  below_radius eps la lb va vb (box_from c) && above_radius eps la lb va vb (box_to c) ||
  above_radius eps la lb va vb (box_from c) && below_radius eps la lb va vb (box_to c).

Definition determinant_changes_sign eps :=
  (0 <? nth 0 u (box_pivot c)) &&
  opposite_signs eps (left_times (row_a Q)) (left_times (row_b Q))
    (left_value (row_a Q)) (left_value (row_b Q)).

Definition one_root_at eps la lb vb e :=
  weighted_norm (row_at_end e la lb) norms * W' <?
  e.2 * (Z.abs vb - weighted_norm lb eps).

Definition one_root_between eps la lb vb :=
  one_root_at eps la lb vb (box_from c) && one_root_at eps la lb vb (box_to c).

Definition one_root eps :=
  one_root_between eps (left_times (row_a Q)) (left_times (row_b Q)) (left_value (row_b Q)).

Definition reaction_positive eps e i :=
  at_end e (absolute_dot (row_a Q i) eps) (absolute_dot (row_b Q i) eps) <?
  at_end e (sparse_dot (row_a Q i) V) (sparse_dot (row_b Q i) V).

Definition box_signs eps :=
  [&& 0 <? nth 0 V (box_pivot c),
      all (fun j => nth 0 eps j <? nth 0 V j) (box_support c) &
      all (fun i => (i \in box_support c) ||
                    reaction_positive eps (box_from c) i && reaction_positive eps (box_to c) i)
        (slip Q)].

Definition check_enclosed_claim :=
  [&& wellformed Q, columns_in_order Q, ordered (box_from c) (box_to c), 0 <? (box_to c).2,
      box_pivot c \in box_support c, all (fun i => i \in slip Q) (box_support c),
      vanishes_elsewhere, 0 <=? W, 0 <=? W', all_from (regular_row widths) 0 pivot_removed,
      determinant_changes_sign widths, one_root widths & box_signs widths].

End Checker.

(* A matrix dominated by its diagonal. *)
Section Dominant.

Variables (R : realFieldType) (m : nat) (G : 'M[R]_m) (g : 'I_m -> R).
Hypotheses (g0 : forall p, 0 < g p).
Hypothesis dominant : forall p, g p <= G p p *+ 2 - \sum_q `|G p q|.

Lemma dominant_bound (w r : 'cV[R]_m) W : 0 <= W ->
  (forall p, `|r p 0| <= g p * W) -> G *m w = r -> forall p, `|w p 0| <= W.
Proof.
move=> W0 r_le Gw p0.
have [p _ largest] := @arg_maxP _ _ _ p0 xpredT (fun p => `|w p 0|) isT.
have largest_p q : `|w q 0| <= `|w p 0| by apply: largest.
apply: le_trans (largest_p p0) _; rewrite -(ler_pmul2l (g0 p)); apply: le_trans (r_le p).

have row : r p 0 = G p p * w p 0 + \sum_(q | q != p) G p q * w q 0.
  by rewrite -Gw mxE (bigD1 p).
have rest : `|\sum_(q | q != p) G p q * w q 0| <= (\sum_(q | q != p) `|G p q|) * `|w p 0|.
  rewrite (le_trans (ler_norm_sum _ _ _)) // mulr_suml ler_sum // => q _.
  by rewrite normrM ler_wpmul2l // largest_p.
have below : g p <= `|G p p| - \sum_(q | q != p) `|G p q|.
  apply: le_trans (dominant p) _; rewrite (bigD1 p) //= mulr2n opprD addrA ler_add2r.
  by rewrite ler_subl_addr ler_add // ler_norm.
apply: le_trans (ler_wpmul2r (normr_ge0 (w p 0)) below) _.
rewrite mulrBl -normrM ler_subl_addr.
have -> : G p p * w p 0 = r p 0 - \sum_(q | q != p) G p q * w q 0 by rewrite row addrK.
exact: le_trans (ler_norm_sub _ _) (ler_add (lexx _) rest).
Qed.

Lemma dominant_unit : G \in unitmx.
Proof.
rewrite unitmxE unitfE -det_tr; apply/negP=> /det0P[v v0 vG].
have Gv : G *m v^T = 0 by rewrite -[G]trmxK -trmx_mul vG trmx0.
have small p : `|(0 : 'cV[R]_m) p 0| <= g p * 0 by rewrite mxE normr0 mulr0.
have zero := dominant_bound (lexx 0) small Gv.
case/negP: v0; apply/eqP/rowP=> p; rewrite [RHS]mxE.
by have := zero p; rewrite mxE normr_le0 => /eqP.
Qed.

End Dominant.

Section Lists.

Variable R : realFieldType.
Local Notation Rz := (toR : Z -> R).

Lemma nth_row_at_end e a b p :
  nth 0%Z (row_at_end e a b) p = at_end e (nth 0%Z a p) (nth 0%Z b p).
Proof. by rewrite !nth_add_multiple nth_nil Z.add_0_r. Qed.

Lemma nth_scatter a row y j :
  nth 0%Z (scatter a row y) j = (a * lookup row j + nth 0 y j)%Z.
Proof.
elim: row => [|e row IH] /=; first by rewrite Z.mul_0_r.
rewrite nth_set_nth /= eq_sym; case: eqP => [->|_]; rewrite IH //.
by move: (nth _ _ _) (lookup _ _) => n l; ring.
Qed.

Lemma toR_at_end e a b : Rz (at_end e a b) = toR e.2 * toR a + toR e.1 * toR b.
Proof. by rewrite toRD !toRM. Qed.

Lemma norm1_nonneg l : (0 <=? norm1 l)%Z.
Proof. by elim: l => //= a l; lia. Qed.

Lemma norm1_ge l m : \sum_(p < m) `|Rz (nth 0%Z l p)| <= Rz (norm1 l).
Proof.
elim: m l => [|m IH] [|a l]; rewrite ?big_ord0 ?toR_ge0 ?norm1_nonneg //=.
  by rewrite big1 // => i _; rewrite nth_nil toR0 normr0.
by rewrite big_ord_recl toRD toR_abs ler_add2l; apply: IH.
Qed.

Lemma toR_sparse_sum n row (x : seq Z) : all (fun e => e.1 < n)%N row ->
  Rz (sparse_dot row x) = \sum_(j <- iota 0 n) toR (lookup row j) * toR (nth 0%Z x j).
Proof. exact: toR_sparse_dot. Qed.

Lemma absolute_sum_ge row (w : seq Z) (d : nat -> R) :
  all (fun e => `|d e.1| <= toR (nth 0%Z w e.1)) row ->
  `|\sum_(e <- row) toR e.2 * d e.1| <= Rz (absolute_dot row w).
Proof.
elim: row => [|e row IH] /= => [_|/andP[small rest]]; first by rewrite big_nil normr0 toR0.
rewrite big_cons toRD toRM toR_abs (le_trans (ler_norm_add _ _)) // ler_add ?IH // normrM.
by rewrite ler_wpmul2l.
Qed.

Lemma absolute_dot_ge n row (w : seq Z) (d : nat -> R) : all (fun e => e.1 < n)%N row ->
  (forall j, j \in iota 0 n -> `|d j| <= toR (nth 0%Z w j)) ->
  `|\sum_(j <- iota 0 n) toR (lookup row j) * d j| <= Rz (absolute_dot row w).
Proof.
move=> range small; rewrite sum_lookup //; apply: absolute_sum_ge; apply: sub_all range => e lt_e.
by rewrite small // mem_iota.
Qed.

End Lists.

Section Sound.

Variables (R : rcfType) (Q : pencil) (c : enclosed_claim).
Hypothesis checked : check_enclosed_claim Q c.

Notation variables := (iota 0 (order Q)).
Notation J := (active_list Q c).
Notation K := (pivot_removed Q c).
Notation k := (box_pivot c).
Notation times_inverse := (combine_row (right_inverse c)).
Notation V j := (toR (nth 0%Z (box_center c) j) : R).
Notation Y j p := (toR (nth 0%Z (nth [::] (right_inverse c) j) p) : R).
Notation W := (toR (box_width c) : R).
Notation W' := (toR (rate_width c) : R).
Notation N j := (toR (norm1 (nth [::] (right_inverse c) j)) : R).
Notation eps j := (toR (nth 0%Z (widths c) j) : R).
Notation A := (a_entry R Q).
Notation B := (b_entry R Q).
Notation T := (Enclosed.T A B).
Notation T_end := (Enclosed.T_end A B).
Notation m := (size K).

Lemma enclosed_parts :
  [/\ wellformed Q, columns_in_order Q, ordered (box_from c) (box_to c) & (0 <? (box_to c).2)%Z] /\
  [/\ k \in box_support c, forall i, i \in box_support c -> i \in slip Q,
      vanishes_elsewhere Q c & 0 <= W] /\
  [/\ all_from (regular_row Q c (widths c)) 0 K, determinant_changes_sign Q c (widths c) &
      box_signs Q c (widths c)].
Proof.
case/and5P: checked => wf cols o to2 /and5P[ks /allP sup van w /and5P[_ reg det _ signs]].
by split=> //; split=> //; split=> //; rewrite toR_ge0.
Qed.

Lemma uniqueness_parts : 0 <= W' /\ one_root Q c (widths c).
Proof. by case/and5P: checked => _ _ _ _ /and5P[_ _ _ _ /and5P[? _ _ ? _]]; rewrite toR_ge0. Qed.

Lemma active_mem i : (i \in J) = (i \in variables) && box_active Q c i.
Proof. by rewrite mem_filter andbC. Qed.

Lemma active_variables i : i \in J -> i \in variables.
Proof. by rewrite active_mem => /andP[]. Qed.

Lemma removed_active j : (j \in K) = (j \in J) && (j != k).
Proof. by rewrite mem_filter andbC. Qed.

Lemma removed_variables j : j \in K -> j \in variables.
Proof. by rewrite removed_active => /andP[/active_variables]. Qed.

Lemma uniq_active : uniq J.
Proof. by rewrite filter_uniq // iota_uniq. Qed.

Lemma uniq_removed : uniq K.
Proof. by rewrite !filter_uniq // iota_uniq. Qed.

Lemma support_active j : j \in box_support c -> j \in J.
Proof.
have [_ [[_ sup _ _] _]] := enclosed_parts => j_s.
by rewrite active_mem /box_active j_s orbT andbT; apply/slip_indices/sup.
Qed.

Lemma free_active i : i \in free Q -> i \in J.
Proof.
have [[wf _ _ _] _] := enclosed_parts => i_f.
by rewrite active_mem /box_active i_f andbT; apply: free_indices.
Qed.

Lemma slip_active i : i \in slip Q -> (i \in J) = (i \in box_support c).
Proof.
move=> Hi; rewrite active_mem slip_indices //= /box_active.
by move: Hi; rewrite mem_filter => /andP[/negbTE->].
Qed.

Lemma pivot_active : k \in J.
Proof. by have [_ [[? _ _ _] _]] := enclosed_parts; apply: support_active. Qed.

Lemma columns i :
  all (fun e => e.1 < order Q)%N (row_a Q i) /\ all (fun e => e.1 < order Q)%N (row_b Q i).
Proof. by have [[_ cols _ _] _] := enclosed_parts; apply: columns_in_rows. Qed.

(* V vanishes off J, Y and eps off K. *)
Lemma center_elsewhere j : j \in variables -> j \notin J -> V j = 0.
Proof.
have [_ [[_ _ /andP[/allP van _] _] _]] := enclosed_parts => Hj.
by have := van _ Hj; rewrite active_mem Hj /= => /orP[->|/Z.eqb_spec->].
Qed.

Lemma norm_elsewhere j : j \in variables -> j \notin K ->
  norm1 (nth [::] (right_inverse c) j) = 0%Z.
Proof.
have [_ [[_ _ /andP[_ /allP van] _] _]] := enclosed_parts => Hj out.
by have := van _ Hj; rewrite (negbTE out) => /Z.eqb_spec.
Qed.

Lemma inverse_elsewhere j p : j \in variables -> j \notin K -> Y j p = 0.
Proof.
move=> Hj out; apply/eqP; rewrite -normr_eq0 eq_le normr_ge0 andbT.
have := @norm1_ge R (nth [::] (right_inverse c) j) p.+1; rewrite norm_elsewhere // toR0.
by apply: le_trans; rewrite (bigD1 ord_max) //= ler_addl sumr_ge0.
Qed.

Lemma width_norm j : eps j = N j * W.
Proof.
have [l|l] := ltnP j (size (right_inverse c)); first by rewrite (nth_map [::]) // toRM.
by rewrite !nth_default ?size_map //= toR0 mul0r.
Qed.

Lemma width_ge0 j : 0 <= eps j.
Proof.
have [_ [[_ _ _ W0] _]] := enclosed_parts.
by rewrite width_norm mulr_ge0 // toR_ge0 norm1_nonneg.
Qed.

(* Sums over all variables as sums over J and K. *)
Lemma sum_over_J (f : nat -> R) : (forall j, j \in variables -> j \notin J -> f j = 0) ->
  \sum_(j <- variables) f j = \sum_(j <- J) f j.
Proof.
move=> f0; apply: sum_support => j Hj out; apply: f0 => //.
by rewrite active_mem Hj.
Qed.

Lemma sum_over_K (f : nat -> R) : (forall j, j \in variables -> j \notin K -> f j = 0) ->
  \sum_(j <- variables) f j = \sum_(j <- K) f j.
Proof.
move=> f0; rewrite sum_over_J => [|j Hj out]; last first.
  by apply: f0 => //; rewrite removed_active (negbTE out).
rewrite (sum_pivot removed_active pivot_active uniq_active uniq_removed) f0 ?add0r //.
  exact: active_variables pivot_active.
by rewrite removed_active eqxx andbF.
Qed.

(* T_e V and T_e Y *)
Lemma center_row e i :
  toR (at_end e (sparse_dot (row_a Q i) (box_center c)) (sparse_dot (row_b Q i) (box_center c))) =
  \sum_(j <- J) T_end e i j * V j.
Proof.
have [ca cb] := columns i; rewrite toR_at_end !(toR_sparse_sum R _ _ (n := order Q)) //.
rewrite !sum_over_J; try by move=> j Hj out; rewrite center_elsewhere ?mulr0.
rewrite !mulr_sumr -big_split; apply: eq_bigr => j _ /=.
by rewrite /Enclosed.T_end mulrDl !mulrA.
Qed.

Lemma times_inverseE row p : all (fun e => e.1 < order Q)%N row ->
  toR (nth 0%Z (times_inverse row) p) = \sum_(j <- K) toR (lookup row j) * Y j p.
Proof.
move=> range; rewrite -sum_over_K => [|j Hj out]; last by rewrite inverse_elsewhere ?mulr0.
by rewrite sum_lookup // nth_combine_row.
Qed.

Definition product_row e i :=
  row_at_end e (times_inverse (row_a Q i)) (times_inverse (row_b Q i)).

Lemma product_rowE e i p :
  toR (nth 0%Z (product_row e i) p) = \sum_(j <- K) T_end e i j * Y j p.
Proof.
have [ca cb] := columns i; rewrite nth_row_at_end toR_at_end !times_inverseE //.
rewrite !mulr_sumr -big_split; apply: eq_bigr => j _ /=.
by rewrite /Enclosed.T_end mulrDl !mulrA.
Qed.

Definition rate_bound i : Z :=
  (Z.abs (sparse_dot (row_b Q i) (box_center c)) + absolute_dot (row_b Q i) (widths c))%Z.

(* The row in the place p of K is dominated at both ends. *)
Lemma row_dominated (p : 'I_m) : let i := nth 0%N K p in
  dominated c p (product_row (box_from c) i)
    (at_end (box_from c) (sparse_dot (row_a Q i) (box_center c))
                         (sparse_dot (row_b Q i) (box_center c)))
    ((box_from c).2 * rate_bound i) &&
  dominated c p (product_row (box_to c) i)
    (at_end (box_to c) (sparse_dot (row_a Q i) (box_center c))
                       (sparse_dot (row_b Q i) (box_center c)))
    ((box_to c).2 * rate_bound i).
Proof.
have [_ [_ [reg _ _]]] := enclosed_parts.
by have := all_from_nth 0%N reg (ltn_ord p).
Qed.

Definition margin_at e (p : 'I_m) : R := toR (margin (product_row e (nth 0%N K p)) p).

(* For t between the ends, T(t) is a combination of T_e with weights a and b. *)
Section Between.

Variables (t a b : R).
Hypothesis comb : combination A B t (box_from c) (box_to c) a b.

Definition product_matrix : 'M[R]_m :=
  \matrix_(p, q) \sum_(j <- K) T t (nth 0%N K p) j * Y j q.

Definition margin_between p := a * margin_at (box_from c) p + b * margin_at (box_to c) p.

Lemma product_combination p q : product_matrix p q =
  a * toR (nth 0%Z (product_row (box_from c) (nth 0%N K p)) q) +
  b * toR (nth 0%Z (product_row (box_to c) (nth 0%N K p)) q).
Proof.
have [_ _ _ Tab] := comb; rewrite mxE !product_rowE !mulr_sumr -big_split.
by apply: eq_bigr => j _ /=; rewrite Tab mulrDl !mulrA.
Qed.

Lemma margin_gt0 p : 0 < margin_between p.
Proof.
have [a0 b0 ab _] := comb; have /andP[/and3P[g1 _ _] /and3P[g2 _ _]] := row_dominated p.
by apply: combination_gt0; rewrite ?toR_gt0.
Qed.

Lemma margin_dominant p :
  margin_between p <= product_matrix p p *+ 2 - \sum_q `|product_matrix p q|.
Proof.
have [a0 b0 _ _] := comb; rewrite product_combination.
set f := product_row (box_from c) _; set h := product_row (box_to c) _.
have norms : \sum_q `|product_matrix p q| <= a * toR (norm1 f) + b * toR (norm1 h).
  apply: (@le_trans _ _ (\sum_(q < m) (a * `|toR (nth 0%Z f q) : R| +
                                       b * `|toR (nth 0%Z h q) : R|))).
    apply: ler_sum => q _; rewrite product_combination (le_trans (ler_norm_add _ _)) //.
    by rewrite !normrM (ger0_norm a0) (ger0_norm b0).
  by rewrite big_split -!mulr_sumr ler_add // ler_wpmul2l // norm1_ge.
apply: le_trans (ler_sub (lexx _) norms).
rewrite /margin_between /margin_at /margin -/f -/h !toRB !toRM.
have two : toR 2%Z = 2%:R :> R by [].
rewrite two mulr2n; move: (toR (nth _ _ _)) (toR (nth _ _ _)) (toR (norm1 f)) (toR (norm1 h)).
by move=> *; rewrite le_eqVlt; apply/orP; left; apply/eqP; ring.
Qed.

Lemma residual_le (p : 'I_m) : `|\sum_(j <- J) T t (nth 0%N K p) j * V j| <= margin_between p * W.
Proof.
have [a0 b0 _ Tab] := comb; have /andP[/and3P[_ r1 _] /and3P[_ r2 _]] := row_dominated p.
move: r1 r2; rewrite -!(@toR_le R) !toR_abs !center_row !toRM => r1 r2.
have -> : \sum_(j <- J) T t (nth 0%N K p) j * V j =
    a * (\sum_(j <- J) T_end (box_from c) (nth 0%N K p) j * V j) +
    b * (\sum_(j <- J) T_end (box_to c) (nth 0%N K p) j * V j).
  by rewrite !mulr_sumr -big_split; apply: eq_bigr => j _ /=; rewrite Tab mulrDl !mulrA.
rewrite (le_trans (ler_norm_add _ _)) // !normrM (ger0_norm a0) (ger0_norm b0).
by rewrite /margin_between mulrDl -!mulrA ler_add // ler_wpmul2l.
Qed.

Definition inverse_matrix : 'M[R]_m := \matrix_(p, q) Y (nth 0%N K p) q.

Lemma product_block : block K (T t) *m inverse_matrix = product_matrix.
Proof.
apply/matrixP=> p q; rewrite !mxE sum_ordinals; apply: eq_bigr => l _.
by rewrite !mxE.
Qed.

(* The solution of a system with the matrix T on K. *)
Lemma solution_bound (d r : nat -> R) w' : 0 <= w' ->
  (forall p : 'I_m, `|r (nth 0%N K p)| <= margin_between p * w') ->
  (forall i, i \in K -> \sum_(j <- K) T t i j * d j = r i) ->
  forall i, i \in K -> `|d i| <= N i * w'.
Proof.
move=> w0 r_le rows i iK.
have unit_G : product_matrix \in unitmx.
  exact: dominant_unit margin_gt0 margin_dominant.
have unit_Y : inverse_matrix \in unitmx.
  by move: unit_G; rewrite -product_block unitmx_mul => /andP[].
pose dv := \col_(p < m) d (nth 0%N K p); pose w := invmx inverse_matrix *m dv.
have Yw : inverse_matrix *m w = dv by rewrite /w mulKVmx.

have Gw : product_matrix *m w = \col_p r (nth 0%N K p).
  rewrite -product_block -mulmxA Yw; apply/colP=> p; rewrite !mxE.
  rewrite -rows ?mem_nth // sum_ordinals; apply: eq_bigr => l _.
  by rewrite !mxE.
have w_le : forall p, `|w p 0| <= w'.
  by apply: (dominant_bound margin_gt0 margin_dominant w0 _ Gw) => p; rewrite mxE.

move: iK => /(nthP 0%N)[p lt_p <-].
have -> : d (nth 0%N K p) = (inverse_matrix *m w) (Ordinal lt_p) 0 by rewrite Yw mxE.
rewrite mxE (le_trans (ler_norm_sum _ _ _)) //.
apply: (@le_trans _ _ (\sum_(q < m) `|Y (nth 0%N K p) q| * w')).
  by apply: ler_sum => q _; rewrite normrM mxE ler_wpmul2l.
by rewrite -mulr_suml ler_wpmul2r ?norm1_ge.
Qed.

(* A vector whose rows K are f times those of V. *)
Lemma difference_bound d f : 0 <= f ->
  (forall i, i \in K -> \sum_(j <- K) T t i j * d j = f * \sum_(j <- J) T t i j * V j) ->
  forall i, i \in K -> `|d i| <= f * eps i.
Proof.
move=> f0 rows i iK; have [_ [[_ _ _ W0] _]] := enclosed_parts.
rewrite width_norm mulrCA; move: i iK; apply: (solution_bound _ _ rows); first exact: mulr_ge0.
by move=> p; rewrite normrM (ger0_norm f0) mulrCA ler_wpmul2l // residual_le.
Qed.

End Between.


Lemma combined t : between t (box_from c) (box_to c) ->
  exists a b, combination A B t (box_from c) (box_to c) a b.
Proof.
have [[_ _ o _] _] := enclosed_parts => bt.
by have [a [b [comb _]]] := combination_of_weights A B o bt; exists a, b.
Qed.

(* T(t) is regular on K, and the vector with x_k = V_k whose rows K vanish is near V. *)
Lemma regular_on_K t : between t (box_from c) (box_to c) -> injective_on K (T t).
Proof.
move=> /combined[a [b comb]] z rows i iK; apply/eqP; rewrite -normr_le0 -(mul0r (eps i)).
apply: (difference_bound comb (lexx 0)) => // l lK.
by rewrite rows // mul0r.
Qed.

Definition near (x : nat -> R) :=
  x k = V k /\ forall j, j \in variables -> `|x j - V j| <= eps j.

(* x on the active variables, 0 elsewhere *)
Definition on_active (x : nat -> R) j := if j \in J then x j else 0.

Lemma near_center t x : between t (box_from c) (box_to c) -> x k = V k ->
  (forall l, l \in K -> row A B J t x l = 0) -> near (on_active x).
Proof.
move=> /combined[a [b comb]] xk rows; split=> [|j Hj]; first by rewrite /on_active pivot_active.
rewrite /on_active; have [jJ|jJ] := boolP (j \in J); last first.
  by rewrite center_elsewhere // subr0 normr0 width_ge0.
have [->|jk] := eqVneq j k; first by rewrite xk subrr normr0 width_ge0.
have jK : j \in K by rewrite removed_active jJ.
rewrite distrC -(mul1r (eps j)); move: j jK {Hj jJ jk}.
apply: (difference_bound comb ler01) => i iK; have := rows _ iK; rewrite /row mul1r.
rewrite !(sum_pivot removed_active pivot_active uniq_active uniq_removed) xk => zero.
under eq_bigr do rewrite mulrBr; rewrite sumrB.
move/eqP: zero; rewrite addr_eq0 => /eqP->.
exact: addrC.
Qed.

(* The value of u' T_e x for x near V is u' T_e V up to the radius. *)
Definition left_at e (x : nat -> R) :=
  \sum_(i <- J) toR (nth 0%Z (left_null c) i) * \sum_(j <- J) T_end e i j * x j.

Definition left_row_at e := row_at_end e (left_times Q c (row_a Q)) (left_times Q c (row_b Q)).

Lemma left_timesE rows j : toR (nth 0%Z (left_times Q c rows) j) =
  \sum_(i <- J) toR (nth 0%Z (left_null c) i) * toR (lookup (rows i) j) :> R.
Proof.
rewrite /left_times; elim: J => [|i l IH] /=; first by rewrite big_nil nth_nil.
by rewrite nth_scatter toRD toRM big_cons IH.
Qed.

Lemma left_rowE e j : toR (nth 0%Z (left_row_at e) j) =
  \sum_(i <- J) toR (nth 0%Z (left_null c) i) * T_end e i j.
Proof.
rewrite nth_row_at_end toR_at_end !left_timesE !mulr_sumr -big_split.
apply: eq_bigr => i _ /=; rewrite /Enclosed.T_end /a_entry /b_entry.
by move: (toR (nth _ _ _)) (toR (lookup _ _)) (toR (lookup _ _)) => *; ring.
Qed.

Lemma left_near e x : near x ->
  `|left_at e x - toR (at_end e (left_value Q c (row_a Q)) (left_value Q c (row_b Q)))| <=
  toR (weighted_norm Q c (left_row_at e) (widths c)).
Proof.
case=> xk near_x.
have -> : toR (at_end e (left_value Q c (row_a Q)) (left_value Q c (row_b Q))) =
          left_at e (fun j => V j).
  rewrite toR_at_end /left_value !toR_sum !mulr_sumr -big_split; apply: eq_bigr => i _ /=.
  rewrite -center_row toR_at_end !toRM.
  by move: (toR (nth _ _ _)) (toR (sparse_dot _ _)) (toR (sparse_dot _ _)) => *; ring.
have -> : left_at e x - left_at e (fun j => V j) =
          \sum_(j <- K) toR (nth 0%Z (left_row_at e) j) * (x j - V j).
  rewrite /left_at -sumrB.
  transitivity (\sum_(j <- J) toR (nth 0%Z (left_row_at e) j) * (x j - V j)); last first.
    rewrite (sum_pivot removed_active pivot_active uniq_active uniq_removed).
    by rewrite xk subrr mulr0 add0r.
  under [RHS]eq_bigr do rewrite left_rowE mulr_suml.
  rewrite [RHS]exchange_big; apply: eq_bigr => i _ /=.
  rewrite -mulrBr -sumrB mulr_sumr; apply: eq_bigr => j _.
  by rewrite -mulrBr mulrA.
rewrite toR_sum (le_trans (sum_norm _ _)) //; apply: sum_le => j jK.
by rewrite normrM toRM toR_abs ler_wpmul2l // near_x // removed_variables.
Qed.

Lemma left_positive e x : near x ->
  above_radius Q c (widths c) (left_times Q c (row_a Q)) (left_times Q c (row_b Q))
    (left_value Q c (row_a Q)) (left_value Q c (row_b Q)) e -> 0 < left_at e x.
Proof.
move=> /(left_near e); rewrite ler_distl => /andP[lo _].
by move=> above; apply: lt_le_trans lo; rewrite subr_gt0 toR_lt.
Qed.

Lemma left_negative e x : near x ->
  below_radius Q c (widths c) (left_times Q c (row_a Q)) (left_times Q c (row_b Q))
    (left_value Q c (row_a Q)) (left_value Q c (row_b Q)) e -> left_at e x < 0.
Proof.
move=> /(left_near e); rewrite ler_distl => /andP[_ hi].
by move=> below; apply: le_lt_trans hi _; rewrite -toRD toR_lt0.
Qed.

(* At an end u' T_e x is u_k times row k. *)
Lemma left_row e t x : toR e.1 = t * toR e.2 -> (forall l, l \in K -> row A B J t x l = 0) ->
  left_at e (on_active x) = toR (nth 0%Z (left_null c) k) * (toR e.2 * row A B J t x k).
Proof.
move=> e1 rows; rewrite -(left_pivot removed_active pivot_active uniq_active uniq_removed
  (fun l => toR (nth 0%Z (left_null c) l)) e1 rows).
by apply: eq_bigr => l _; congr (_ * _); apply: sum_eq => j jJ; rewrite /on_active jJ.
Qed.

Lemma null_vector_near : exists t x,
  [/\ between t (box_from c) (box_to c), near (on_active x) &
      forall l, l \in J -> row A B J t x l = 0].
Proof.
have [[_ _ o to2] [_ [_ change signs]]] := enclosed_parts.
have F2 : 0 < toR (box_from c).2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
have T2 : 0 < toR (box_to c).2 :> R by rewrite toR_gt0.
have vk : 0 < V k by case/and3P: signs; rewrite toR_gt0.
have [tab e1 e2 betweenE] := ends_of R o to2.
set ta := _ / _ in tab e1 betweenE; set tb := _ / _ in tab e2 betweenE.
have inj t : ta <= t <= tb -> injective_on K (T t) by move=> /betweenE; apply: regular_on_K.

case/andP: change => uk change; have {}uk : 0 < toR (nth 0%Z (left_null c) k) :> R.
  by rewrite toR_gt0.
have [|t [x [tt xk rows]]] :=
    null_vector_exists removed_active pivot_active uniq_active uniq_removed vk tab inj.
  move=> x y xk yk rows_x rows_y.
  have near_x := near_center (betweenE _ (introT andP (conj (lexx ta) tab))) xk rows_x.
  have near_y := near_center (betweenE _ (introT andP (conj tab (lexx tb)))) yk rows_y.
  apply: (opposite_products uk F2 T2); rewrite -(left_row e1 rows_x) -(left_row e2 rows_y).
  case/orP: change => /andP[s1 s2]; [left | right]; split.
  - exact: (left_negative near_x s1).
  - exact: (left_positive near_y s2).
  - exact: (left_positive near_x s1).
  exact: (left_negative near_y s2).

exists t, x; split=> //; first exact: betweenE.
by apply: (near_center (betweenE _ tt) xk) => l; rewrite removed_active => /andP[/rows].
Qed.

Lemma reaction_on_active t x i : reaction Q t (on_active x) i = row A B J t x i.
Proof.
rewrite /reaction sum_over_J => [|j _ /negbTE out]; last by rewrite /on_active out mulr0.
by apply: sum_eq => j jJ; rewrite /on_active jJ.
Qed.

(* y_i at an end for x near V *)
Lemma reaction_end e i x : 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R -> near x ->
  (forall j, j \in variables -> j \notin J -> x j = 0) ->
  reaction_positive Q c (widths c) e i -> 0 < \sum_(j <- J) T_end e i j * x j.
Proof.
move=> p q [_ near_x] off; rewrite /reaction_positive -(@toR_lt R) center_row toR_at_end => lt.
have [ca cb] := columns i.
have da := @absolute_dot_ge R _ _ (widths c) (fun j => x j - V j) ca near_x.
have db := @absolute_dot_ge R _ _ (widths c) (fun j => x j - V j) cb near_x.
rewrite -subr_gt0 in lt; apply: lt_le_trans lt _.
rewrite ler_subl_addr -ler_subl_addl -sumrB.
have -> : \sum_(j <- J) (T_end e i j * V j - T_end e i j * x j) =
    - (toR e.2 * (\sum_(j <- variables) toR (lookup (row_a Q i) j) * (x j - V j)) +
       toR e.1 * (\sum_(j <- variables) toR (lookup (row_b Q i) j) * (x j - V j))).
  rewrite !sum_over_J; try by move=> j Hj out; rewrite off // center_elsewhere // subrr mulr0.
  rewrite !mulr_sumr -big_split -sumrN; apply: eq_bigr => j _ /=.
  rewrite /Enclosed.T_end /a_entry /b_entry.
  by move: (toR (lookup _ _)) (toR (lookup _ _)) (x j) (V j) => *; ring.
rewrite (le_trans (ler_norm _)) // normrN (le_trans (ler_norm_add _ _)) // !normrM.
by rewrite (ger0_norm p) (ger0_norm q) ler_add // ler_wpmul2l.
Qed.

(* The value of (B x)_i and of u' B x for x near V *)
Lemma rate_row x i : near x -> (forall j, j \in variables -> j \notin J -> x j = 0) ->
  `|\sum_(j <- J) B i j * x j| <= toR (rate_bound i).
Proof.
move=> [_ near_x] off; have [_ cb] := columns i.
have db := @absolute_dot_ge R _ _ (widths c) (fun j => x j - V j) cb near_x.
have -> : \sum_(j <- J) B i j * x j = toR (sparse_dot (row_b Q i) (box_center c)) +
    \sum_(j <- variables) toR (lookup (row_b Q i) j) * (x j - V j).
  rewrite (toR_sparse_sum R _ cb) -big_split sum_over_J /=; last first.
    by move=> j Hj out; rewrite off // center_elsewhere // subrr mulr0 addr0.
  by apply: eq_bigr => j _; rewrite -mulrDr addrC subrK.
by rewrite (le_trans (ler_norm_add _ _)) // toRD toR_abs ler_add2l.
Qed.

Lemma rate_left x : near x ->
  toR (Z.abs (left_value Q c (row_b Q)) -
       weighted_norm Q c (left_times Q c (row_b Q)) (widths c))%Z <=
  `|\sum_(i <- J) toR (nth 0%Z (left_null c) i) * \sum_(j <- J) B i j * x j|.
Proof.
move=> near_x; have := left_near (1%Z, 0%Z) near_x.
set s := \sum_(i <- J) _; have -> : left_at (1%Z, 0%Z) x = s.
  apply: eq_bigr => i _; congr (_ * _); apply: eq_bigr => j _.
  by rewrite /Enclosed.T_end toR0 toR1 mul0r add0r mul1r.
have -> : left_row_at (1%Z, 0%Z) = add_multiple 0 (left_times Q c (row_a Q))
    (add_multiple 1 (left_times Q c (row_b Q)) [::]) by [].
rewrite toR_at_end toR0 toR1 mul0r add0r mul1r.
have -> : toR (weighted_norm Q c (add_multiple 0 (left_times Q c (row_a Q))
    (add_multiple 1 (left_times Q c (row_b Q)) [::])) (widths c)) =
    toR (weighted_norm Q c (left_times Q c (row_b Q)) (widths c)) :> R.
  rewrite !toR_sum; apply: eq_bigr => j _; rewrite !nth_add_multiple nth_nil.
  by rewrite Z.mul_0_l Z.add_0_l Z.mul_1_l Z.add_0_r.
move=> le; rewrite toRB toR_abs ler_subl_addr; apply: le_trans (ler_add (lexx _) le).
rewrite distrC addrC; apply: le_trans (ler_norm_add _ _).
by rewrite subrK.
Qed.

(* At most one null vector with x_k = V_k. *)
Lemma one_null_vector t t' x x' :
  between t (box_from c) (box_to c) -> between t' (box_from c) (box_to c) ->
  x k = V k -> x' k = V k ->
  (forall l, l \in J -> row A B J t x l = 0) -> (forall l, l \in J -> row A B J t' x' l = 0) ->
  t' = t /\ forall j, j \in J -> x j = x' j.
Proof.
move=> bt bt' xk xk' null null'; have [[_ _ o _] _] := enclosed_parts.
have [p q p' q'] := ordered_ge0 R o; have [W0 one] := uniqueness_parts.
have [a [b [comb unit]]] := combination_of_weights A B o bt; have [a0 b0 ab Tab] := comb.
have in_J l : l \in K -> l \in J by rewrite removed_active => /andP[].

(* T(t) (x - x') = - (t - t') B x' *)
have difference l : l \in J -> \sum_(j <- K) T t l j * (x j - x' j) =
    - ((t - t') * \sum_(j <- J) B l j * x' j).
  move=> lJ; apply/eqP; rewrite -addr_eq0; apply/eqP.
  transitivity (row A B J t x l - row A B J t' x' l); last by rewrite null // null' // subrr.
  transitivity (\sum_(j <- J) T t l j * (x j - x' j) + (t - t') * \sum_(j <- J) B l j * x' j).
    congr (_ + _); rewrite (sum_pivot removed_active pivot_active uniq_active uniq_removed).
    by rewrite xk xk' subrr mulr0 add0r.
  rewrite /row mulr_sumr -big_split -sumrB; apply: eq_bigr => j _ /=.
  by rewrite /Enclosed.T; move: (A _ _) (B _ _) (x _) (x' _) => *; ring.

have tt : t' = t.
  apply/eqP; apply/negPn/negP => ne; have dt0 : t - t' != 0 by rewrite subr_eq0 eq_sym.
  have near_x' := near_center bt' xk' (fun l lK => null' l (in_J l lK)).
  have off j : j \in variables -> j \notin J -> on_active x' j = 0.
    by move=> _ /negbTE out; rewrite /on_active out.
  have sumE i : \sum_(j <- J) B i j * on_active x' j = \sum_(j <- J) B i j * x' j.
    by apply: sum_eq => j jJ; rewrite /on_active jJ.
  pose d j := (x j - x' j) / (t - t').
  have d_rows l : l \in J -> \sum_(j <- K) T t l j * d j = - \sum_(j <- J) B l j * x' j.
    move=> lJ; rewrite /d; under eq_bigr do rewrite mulrA; rewrite -mulr_suml difference //.
    by rewrite mulNr mulrAC divff ?mul1r.

  (* |d_j| <= W' N_j *)
  have d_le : forall j, j \in K -> `|d j| <= N j * W'.
    apply: (solution_bound comb (r := fun l => - \sum_(j <- J) B l j * x' j) W0) => [i|l lK].
      rewrite normrN -sumE; apply: le_trans (rate_row _ near_x' off) _.
      have /andP[/and3P[_ _ r1] /and3P[_ _ r2]] := row_dominated i.
      move: r1 r2; rewrite -!(@toR_le R) !toRM => r1 r2.
      rewrite -[X in X <= _]mul1r -unit /margin_between !mulrDl -!mulrA.
      by rewrite ler_add // ler_wpmul2l.
    exact: d_rows (in_J l lK).

  (* u' T(t) d + u' B x' = 0 *)
  pose l_at e j : R := toR (nth 0%Z (left_row_at e) j).
  have sum_l : \sum_(i <- J) (toR (nth 0%Z (left_null c) i) * (\sum_(j <- J) B i j * x' j)) =
      - (\sum_(j <- K) (a * l_at (box_from c) j + b * l_at (box_to c) j) * d j).
    transitivity (- (\sum_(i <- J) toR (nth 0%Z (left_null c) i) *
                                    (\sum_(j <- K) T t i j * d j))).
      by rewrite -sumrN; apply: sum_eq => i iJ; rewrite d_rows // mulrN opprK.
    congr (- _); under eq_bigr do rewrite mulr_sumr; rewrite exchange_big; apply: eq_bigr => j _.
    rewrite /l_at !left_rowE !mulr_sumr -big_split mulr_suml; apply: eq_bigr => i _ /=.
    by rewrite Tab; move: (toR _) (T_end _ _ _) (T_end _ _ _) (d _) => *; ring.
  have := rate_left near_x'; under eq_bigr do rewrite sumE.
  rewrite sum_l normrN leNgt => /negP; apply.
  have norm_at e : toR (weighted_norm Q c (left_row_at e) (norms c)) * W' =
      \sum_(j <- K) `|l_at e j| * (N j * W').
    rewrite toR_sum mulr_suml; apply: eq_bigr => j _; rewrite toRM toR_abs -mulrA.
    congr (_ * (_ * _)); have [l|l] := ltnP j (size (right_inverse c)).
      by rewrite (nth_map [::]).
    by rewrite !nth_default ?size_map.
  move: one => /andP[]; rewrite /one_root_at -!(@toR_lt R) !toRM -!/(left_row_at _) !norm_at.
  set low := toR (Z.abs _ - _)%Z => one_from one_to.
  apply: (@le_lt_trans _ _ (a * (\sum_(j <- K) `|l_at (box_from c) j| * (N j * W')) +
                            b * (\sum_(j <- K) `|l_at (box_to c) j| * (N j * W')))).
    rewrite !mulr_sumr -big_split (le_trans (sum_norm _ _)) //; apply: sum_le => j jK /=.
    have -> : a * (`|l_at (box_from c) j| * (N j * W')) + b * (`|l_at (box_to c) j| * (N j * W')) =
              (a * `|l_at (box_from c) j| + b * `|l_at (box_to c) j|) * (N j * W').
      by rewrite [RHS]mulrDl !mulrA.
    rewrite normrM; apply: ler_pmul; rewrite ?d_le //.
    by rewrite (le_trans (ler_norm_add _ _)) // !normrM (ger0_norm a0) (ger0_norm b0).
  rewrite -[X in _ < X]mul1r -unit mulrDl -!mulrA -subr_gt0 opprD addrACA -!mulrBr.
  by apply: combination_gt0; rewrite ?subr_gt0.

split=> // j jJ; have [->|jk] := eqVneq j k; first by rewrite xk xk'.
apply/eqP; rewrite -subr_eq0; apply/eqP.
apply: (regular_on_K bt (z := fun j => x j - x' j)); last by rewrite removed_active jJ.
by move=> l lK; rewrite difference ?in_J // tt subrr mul0r oppr0.
Qed.

(* A solution with this support is a null vector. *)
Lemma solution_null t x :
  solution Q t x -> (forall i, i \in slip Q -> i \in box_support c -> 0 < x i) ->
  (forall i, i \in slip Q -> i \notin box_support c -> x i = 0) ->
  [/\ forall l, l \in J -> row A B J t x l = 0, 0 < x k &
      forall i, i \in variables -> i \notin J -> x i = 0].
Proof.
have [_ [[ks sup _ _] _]] := enclosed_parts; case=> _ _ rows_f rows_s pos zero.
have off i : i \in variables -> i \notin J -> x i = 0.
  move=> Hi out; case/orP: (free_or_slip Hi) => [/free_active|Hs]; first by rewrite (negbTE out).
  by apply: zero => //; rewrite -slip_active.
split=> // [i iJ|]; last by apply: pos => //; apply: sup.
have -> : row A B J t x i = reaction Q t x i.
  by rewrite /reaction sum_over_J // => j Hj out; rewrite off // mulr0.
have := iJ; rewrite active_mem => /andP[_ /orP[/rows_f //|i_s]].
have [_ _ /eqP] := rows_s _ (sup _ i_s); rewrite mulf_eq0 gt_eqF ?pos ?sup //=.
by move/eqP.
Qed.

Theorem enclosed_claim_sound : exists (t : R) x,
  [/\ between t (box_from c) (box_to c), solution Q t x,
      forall i, i \in slip Q -> i \in box_support c -> 0 < x i,
      forall i, i \in slip Q -> i \notin box_support c -> x i = 0 /\ 0 < reaction Q t x i &
      forall t' x', solution Q t' x' -> between t' (box_from c) (box_to c) ->
        (forall i, i \in slip Q -> i \in box_support c -> 0 < x' i) ->
        (forall i, i \in slip Q -> i \notin box_support c -> x' i = 0) ->
        t' = t /\ exists2 f, 0 < f & forall i, i \in variables -> x' i = f * x i].
Proof.
have [[wf _ o to2] [[ks sup _ _] [_ _ signs]]] := enclosed_parts.
have [t [x [bt near_x rows]]] := null_vector_near.
have [p q p' q'] := ordered_ge0 R o; have [a [b comb]] := combined bt.
case/and3P: signs => vk /allP on /allP off.
have xE j : j \in J -> on_active x j = x j by rewrite /on_active => ->.

have positive j : j \in box_support c -> 0 < on_active x j.
  move=> j_s; have lt := on _ j_s.
  have := (proj2 near_x) _ (active_variables (support_active j_s)).
  by rewrite ler_distl => /andP[lo _]; apply: lt_le_trans lo; rewrite subr_gt0 toR_lt.
have zero i : i \in variables -> i \notin J -> on_active x i = 0.
  by move=> _ /negbTE out; rewrite /on_active out.
have zero_rows i : i \in J -> reaction Q t (on_active x) i = 0.
  by move=> iJ; rewrite reaction_on_active rows.
have reaction_off i : i \in slip Q -> i \notin box_support c ->
    0 < reaction Q t (on_active x) i.
  move=> Hi out; have := off _ Hi; rewrite (negbTE out) /= => /andP[y1 y2].
  have r1 := reaction_end p q near_x zero y1; have r2 := reaction_end p' q' near_x zero y2.
  have [a0 b0 ab Tab] := comb; rewrite reaction_on_active /row.
  have -> : \sum_(j <- J) T t i j * x j =
      a * (\sum_(j <- J) T_end (box_from c) i j * on_active x j) +
      b * (\sum_(j <- J) T_end (box_to c) i j * on_active x j).
    rewrite !mulr_sumr -big_split; apply: sum_eq => j jJ /=.
    by rewrite xE // Tab mulrDl !mulrA.
  exact: combination_gt0.

exists t, (on_active x); split=> //.
- split.
  + have f2 : 0 < toR (box_from c).2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
    by rewrite -(pmulr_lge0 _ f2); apply: le_trans (proj1 bt).
  + exists k; first exact: active_variables pivot_active.
    by rewrite gt_eqF // positive.
  + by move=> i /free_active/zero_rows.
  move=> i Hi; have [i_s|out] := boolP (i \in box_support c).
    by rewrite zero_rows ?support_active // mulr0 ltW ?positive.
  rewrite zero ?slip_indices ?slip_active // mul0r lexx.
  by split=> //; apply/ltW/reaction_off.
- by move=> i _; apply: positive.
- move=> i Hi out; rewrite zero ?slip_indices ?slip_active //.
  by split=> //; apply: reaction_off.

(* Any other one, scaled, is near V as well. *)
move=> t' x' sol' bt' pos' zero'; have [null' xk' off'] := solution_null sol' pos' zero'.
pose f := V k / x' k; have f0 : 0 < f by rewrite divr_gt0 // toR_gt0.
have fk : f * x' k = V k by rewrite divfK // gt_eqF.
have null_f l : l \in J -> row A B J t' (fun j => f * x' j) l = 0.
  move=> lJ; rewrite -[RHS](mulr0 f) -(null' l lJ) /row mulr_sumr.
  by apply: eq_bigr => j _; rewrite mulrCA.
have xk : on_active x k = V k by case: near_x.
have x_null l : l \in J -> row A B J t (on_active x) l = 0.
  by move=> lJ; rewrite -(rows _ lJ); apply: sum_eq => j /xE->.
have [-> xx] := one_null_vector bt bt' xk fk x_null null_f.
split=> //; exists f^-1 => [|i Hi]; first by rewrite invr_gt0.
have [iJ|iJ] := boolP (i \in J); last by rewrite zero // mulr0 off'.
by rewrite xx // mulKf // gt_eqF.
Qed.

End Sound.
