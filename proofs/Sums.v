(* Sums over lists of indices in an ordered field.

   Rules for signs and absolute values of a sum over a list, and the element of a list with the
   largest absolute value.

   Page: none; elementary facts that all chapters use. *)

From Mceip Require Import Base Integers.

Section Sums.

Variable R : realFieldType.
Implicit Types (l : seq nat) (f g x : nat -> R).

Lemma sum_ge0 l f : (forall i, i \in l -> 0 <= f i) -> 0 <= \sum_(i <- l) f i.
Proof. by move=> f0; rewrite big_seq sumr_ge0. Qed.

Lemma sum_le l f g :
  (forall i, i \in l -> f i <= g i) -> \sum_(i <- l) f i <= \sum_(i <- l) g i.
Proof. by move=> fg; rewrite !big_seq ler_sum. Qed.

Lemma sum_eq l f g :
  (forall i, i \in l -> f i = g i) -> \sum_(i <- l) f i = \sum_(i <- l) g i.
Proof. by move=> fg; rewrite !big_seq; apply: eq_bigr. Qed.

Lemma sum_zero l f : (forall i, i \in l -> f i = 0) -> \sum_(i <- l) f i = 0.
Proof. by move=> f0; rewrite big_seq big1. Qed.

Lemma sum_norm l f : `|\sum_(i <- l) f i| <= \sum_(i <- l) `|f i|.
Proof. exact: ler_norm_sum. Qed.

(* A sum of terms at most 0, one of them negative, is negative. *)
Lemma sum_lt0 l f :
  (forall i, i \in l -> f i <= 0) -> (exists2 i, i \in l & f i < 0) -> \sum_(i <- l) f i < 0.
Proof.
elim: l => [|a l IH] f_le0 [i]; first by rewrite in_nil.

have tail_le0 j : j \in l -> f j <= 0 by move=> jl; apply: f_le0; rewrite inE jl orbT.
have head_le0 : f a <= 0 by apply: f_le0; rewrite inE eqxx.
have sum_le0 : \sum_(j <- l) f j <= 0.
  by rewrite -oppr_ge0 -sumrN big_seq sumr_ge0 // => j jl; rewrite oppr_ge0 tail_le0.

rewrite inE big_cons => /orP[/eqP-> fa|il fi]; first by apply: ltr_naddr.
by apply: ltr_naddl => //; apply: IH => //; exists i.
Qed.

(* A sum of terms at least 0, one of them positive, is positive. *)
Lemma sum_gt0 l f :
  (forall i, i \in l -> 0 <= f i) -> (exists2 i, i \in l & 0 < f i) -> 0 < \sum_(i <- l) f i.
Proof.
move=> f0 [i il fi]; rewrite -oppr_lt0 -sumrN; apply: sum_lt0 => [j jl|].
  by rewrite oppr_le0 f0.
by exists i => //; rewrite oppr_lt0.
Qed.

(* A sum over the members where the terms do not vanish. *)
Lemma sum_support l (p : pred nat) f : (forall i, i \in l -> ~~ p i -> f i = 0) ->
  \sum_(i <- l) f i = \sum_(i <- [seq i <- l | p i]) f i.
Proof.
move=> f0; rewrite big_filter [RHS]big_mkcond; apply: sum_eq => i Hi.
by case: ifPn => // /f0->.
Qed.

Lemma sum_subset l l' f : uniq l -> uniq l' -> {subset l' <= l} ->
  (forall i, i \in l -> i \notin l' -> f i = 0) -> \sum_(i <- l) f i = \sum_(i <- l') f i.
Proof.
move=> u u' inside f0; rewrite (sum_support f0); apply: perm_big; apply: uniq_perm => [||i] //.
  exact: filter_uniq.
by rewrite mem_filter; apply: andb_idr => /inside.
Qed.

(* A sum over a list that starts at a, as a sum over a list that starts at 0. *)
Lemma sum_shift a n f : \sum_(k <- iota a n) f k = \sum_(k <- iota 0 n) f (a + k)%N.
Proof.
rewrite (_ : iota a n = map (addn a) (iota 0 n)) ?big_map //.
by rewrite -iotaDl addn0.
Qed.

(* Some entry of a non-empty list has the largest absolute value. *)
Lemma largest l x : l != [::] -> exists2 i, i \in l & forall j, j \in l -> `|x j| <= `|x i|.
Proof.
elim: l => // a l IH _; have [->|l0] := eqVneq l [::].
  by exists a; rewrite ?mem_head // => j; rewrite inE => /eqP->.

have [i il largest_i] := IH l0; have [a_le|a_gt] := lerP `|x a| `|x i|.
  by exists i; rewrite ?inE ?il ?orbT // => j; rewrite inE => /orP[/eqP->|/largest_i].
exists a; rewrite ?mem_head // => j; rewrite inE => /orP[/eqP->//|/largest_i h].
exact: le_trans h (ltW a_gt).
Qed.

(* If every bound Z > eps on |x| can be improved, then |x| <= eps. *)
Lemma contraction l x c eps :
  0 < c ->
  (forall Z, eps < Z -> (forall j, j \in l -> `|x j| <= Z) ->
     forall i, i \in l -> c * `|x i| < c * Z) ->
  forall i, i \in l -> `|x i| <= eps.
Proof.
move=> c0 improve i il; have l0 : l != [::] by apply: contraTneq il => ->.
have [m ml largest_m] := largest x l0.

rewrite leNgt; apply/negP=> eps_lt.
by have := improve _ (lt_le_trans eps_lt (largest_m _ il)) largest_m _ ml; rewrite ltxx.
Qed.

(* Combinations a A + b B with weights that are not negative and not both 0. *)
Lemma combination_gt0 (a b A B : R) :
  0 <= a -> 0 <= b -> 0 < a \/ 0 < b -> 0 < A -> 0 < B -> 0 < a * A + b * B.
Proof.
move=> a0 b0 [a_gt0|b_gt0] A0 B0.
  by apply: ltr_paddr; [apply: mulr_ge0 => //; apply: ltW | apply: mulr_gt0].
by apply: ltr_paddl; [apply: mulr_ge0 => //; apply: ltW | apply: mulr_gt0].
Qed.

Lemma combination_lt (a b A B U V : R) :
  0 <= a -> 0 <= b -> 0 < a \/ 0 < b -> `|A| < U -> `|B| < V ->
  `|a * A + b * B| < a * U + b * V.
Proof.
move=> a0 b0 ab AU BV; apply: (@le_lt_trans _ _ (a * `|A| + b * `|B|)).
  by rewrite (le_trans (ler_norm_add _ _)) // !normrM (ger0_norm a0) (ger0_norm b0).
rewrite -subr_gt0 (_ : _ - _ = a * (U - `|A|) + b * (V - `|B|)); last by ring.
by apply: combination_gt0; rewrite ?subr_gt0.
Qed.

(* A positive factor of a row. *)
Lemma complementary_scaled (c x y : R) : 0 < c ->
  [/\ 0 <= x, 0 <= c * y & x * (c * y) = 0] <-> [/\ 0 <= x, 0 <= y & x * y = 0].
Proof.
move=> c0; rewrite pmulr_rge0 // mulrCA; split=> -[x0 y0 xy]; split=> //.
  by move/eqP: xy; rewrite mulf_eq0 gt_eqF //= => /eqP.
by rewrite xy mulr0.
Qed.

End Sums.
