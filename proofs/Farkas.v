(* Farkas leaves: a vector of integers that excludes every solution in a region.

   Let w be integers with w_i >= 0 unless variable i moves, and let

       c_e(j) = sum_i w_i center_e,ij + |w_i| radius_e,ij      for both ends e of the interval.

   Theorem [farkas_sound]: if c_e(j) <= 0 for each j that may move and both ends, and either each
   such j is strict or some moving j is strict, then the region has no solution.  An index j is
   strict if c_e(j) < 0 at the lower end and, unless that end is infinity, at the upper end.

   Reason: 0 <= w' y = w' T(t) x = sum_j c(j) x_j, and the last sum is negative.

   Page: spec/certificates.md, 5.8.  Rust: crates/check/src/cover/farkas.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Section Checker.

Variables (P : enclosed) (r : region) (w : seq Z).
Local Open Scope Z_scope.

Notation weight i := (nth 0 w i).

Definition column_bound e j :=
  sumZ (indices P) (fun i => weight i * center P e i j + Z.abs (weight i) * radius P e i j).

Definition strict_column j :=
  (column_bound (lower r) j <? 0) && (((upper r).2 =? 0) || (column_bound (upper r) j <? 0)).

Definition signs_of_weights :=
  all (fun i => is_moving (state_of r i) || (0 <=? weight i)) (indices P).

Definition columns_at_most_zero :=
  all (fun j => is_resting (state_of r j) ||
         (column_bound (lower r) j <=? 0) && (column_bound (upper r) j <=? 0)) (indices P).

Definition every_column_strict :=
  all (fun j => is_resting (state_of r j) || strict_column j) (indices P).

Definition some_moving_column_strict :=
  has (fun j => is_moving (state_of r j) && strict_column j) (indices P).

Definition farkas :=
  [&& signs_of_weights, columns_at_most_zero &
      every_column_strict || some_moving_column_strict].

End Checker.

Section Sound.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Variables (r : region) (w : seq Z).
Notation weight i := (toR (nth 0%Z w i) : R).

Lemma column_bound_sound e j :
  j \in indices P -> 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  \sum_(i <- indices P) weight i * T_end A B e i j <= toR (column_bound P w e j).
Proof.
move=> Hj p q; rewrite toR_sum; apply: sum_le => i Hi; rewrite toRD !toRM toR_abs.
rewrite -ler_subl_addl -mulrBr (le_trans (ler_norm _)) // normrM ler_wpmul2l //.
exact: T_end_enclosed.
Qed.

Theorem farkas_sound t x :
  ordered (lower r) (upper r) -> farkas P r w -> in_region_of P t x r ->
  solves P A B t x -> False.
Proof.
move=> O /and3P[/allP signs /allP columns strict] [W ag] [_ [i0 Hi0 xi0] compl].
have [a [b [a0 b0 Tab [ab a_gt0]]]] := T_between A B O W.
have [p q p' q'] := ordered_ge0 R O.

(* w'y is not negative. *)
have wy : 0 <= \sum_(i <- indices P) weight i * image P A B t x i.
  apply: sum_ge0 => i Hi; have [x0 y0 xy] := compl _ Hi.
  have := signs _ Hi; have := agrees_at ag Hi.
  case: (state_of r i) => /=; try by move=> _ wi; rewrite mulr_ge0 // toR_ge0.
  by move=> xp _; move/eqP: xy; rewrite mulf_eq0 gt_eqF //= => /eqP->; rewrite mulr0.

(* w'y is the sum of c(j) x_j. *)
pose c j := \sum_(i <- indices P) weight i * T A B t i j.
have wy_columns : \sum_(i <- indices P) weight i * image P A B t x i =
                  \sum_(j <- indices P) c j * x j.
  under eq_bigr do rewrite /image mulr_sumr.
  rewrite exchange_big; apply: eq_bigr => j _; rewrite mulr_suml.
  by apply: eq_bigr => i _; rewrite mulrA.

have c_le j : j \in indices P ->
    c j <= a * toR (column_bound P w (lower r) j) + b * toR (column_bound P w (upper r) j).
  move=> Hj; apply: le_trans (ler_add (ler_wpmul2l a0 (column_bound_sound Hj p q))
                                      (ler_wpmul2l b0 (column_bound_sound Hj p' q'))).
  rewrite !mulr_sumr -big_split /= le_eqVlt; apply/orP; left; apply/eqP/eq_bigr => i _.
  by rewrite Tab mulrDr !mulrA ![_ * weight _]mulrC.

(* No term is positive. *)
have term j : j \in indices P -> c j * x j <= 0.
  move=> Hj; have [x0 _ _] := compl _ Hj; have := columns _ Hj; have := agrees_at ag Hj.
  have le0 : (column_bound P w (lower r) j <=? 0)%Z && (column_bound P w (upper r) j <=? 0)%Z ->
             c j * x j <= 0.
    move=> /andP[l h]; rewrite mulr_le0_ge0 // (le_trans (c_le _ Hj)) //.
    by rewrite -[0]addr0 ler_add // mulr_ge0_le0 // toR_le0.
  by case: (state_of r j) => //= -> _; rewrite mulr0.

(* A strict term with x_j > 0 is negative. *)
have strict_term j : j \in indices P -> 0 < x j -> strict_column P r w j -> c j * x j < 0.
  move=> Hj xj /andP[l h]; rewrite pmulr_llt0 // (le_lt_trans (c_le _ Hj)) //.
  have h0 : toR (column_bound P w (upper r) j) <= 0 :> R.
    rewrite toR_le0; have := columns _ Hj; have := agrees_at ag Hj.
    by case: (state_of r j) => /= [_ /andP[]|z|_ /andP[]] //; rewrite z ltxx in xj.
  have l0 : toR (column_bound P w (lower r) j) < 0 :> R by rewrite toR_lt0.
  have [ap|na] := boolP (0 < a); first by rewrite ltr_naddr ?mulr_ge0_le0 // pmulr_rlt0.
  have bp : 0 < b by case: ab => // ap; rewrite ap in na.
  rewrite ltr_naddl ?mulr_ge0_le0 // ?(ltW l0) // pmulr_rlt0 // toR_lt0.
  by case/orP: h => // /Z.eqb_spec z; rewrite (a_gt0 z) in na.

suff : \sum_(j <- indices P) c j * x j < 0 by rewrite -wy_columns ltNge wy.
apply: sum_lt0 => //; case/orP: strict => [/allP every|/hasP[j Hj /andP[moving sj]]].
  have [x0 _ _] := compl _ Hi0.
  exists i0 => //; apply: strict_term => //; first by rewrite lt_neqAle eq_sym xi0.
  have := every _ Hi0; have := agrees_at ag Hi0.
  by case: (state_of r i0) => //= z; rewrite z eqxx in xi0.
exists j => //; apply: strict_term => //; have := agrees_at ag Hj.
by move: moving; case: (state_of r j).
Qed.

End Sound.
