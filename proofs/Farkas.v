(* Farkas leaves: a vector of integers that excludes every solution in a region.

   Let w be integers with w_i >= 0 unless variable i moves, and let

       c_e(j) = sum_i w_i center_e,ij + |w_i| radius_e,ij      for both ends e of the interval.

   Theorem [farkas_sound]: if c_e(j) <= 0 for each j that may move and both ends, and either each
   such j is strict or some moving j is strict, then the region has no solution.  An index j is
   strict if c_e(j) < 0 at the lower end and, unless that end is infinity, at the upper end.

   [box_farkas_sound]: a vector that does so for two pencils alike excludes the solutions of their
   combinations (Enclosed.v, box solutions).

   Reason: 0 <= w' y = w' T(t) x = sum_j c(j) x_j, and the last sum is negative.

   Page: spec/certificates.md, 5.8, 5.18.  Rust: crates/check/src/cover/farkas.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed.

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

(* The same for the enclosed pencils at both ends of an interval of another parameter. *)
Section Both.

Variables (P P' : enclosed) (r : region) (w : seq Z).

Definition strict_in_both j := strict_column P r w j && strict_column P' r w j.

Definition box_farkas :=
  [&& signs_of_weights P r w, columns_at_most_zero P r w, columns_at_most_zero P' r w &
      all (fun j => is_resting (state_of r j) || strict_in_both j) (indices P)
      || has (fun j => is_moving (state_of r j) && strict_in_both j) (indices P)].

End Both.

Section Sound.

Variables (R : realFieldType) (r : region) (w : seq Z) (t : R).
Hypotheses (O : ordered (lower r) (upper r)) (W : between t (lower r) (upper r)).
Notation weight i := (toR (nth 0%Z w i) : R).

Section Columns.

Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Lemma column_bound_sound e j :
  j \in indices P -> 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  \sum_(i <- indices P) weight i * T_end A B e i j <= toR (column_bound P w e j).
Proof.
move=> Hj p q; rewrite toR_sum; apply: sum_le => i Hi; rewrite toRD !toRM toR_abs.
rewrite -ler_subl_addl -mulrBr (le_trans (ler_norm _)) // normrM ler_wpmul2l //.
exact: T_end_enclosed.
Qed.

Definition weighted_column j : R := \sum_(i <- indices P) weight i * T A B t i j.

Lemma weighted_image (x : nat -> R) :
  \sum_(i <- indices P) weight i * image P A B t x i =
  \sum_(j <- indices P) weighted_column j * x j.
Proof.
under eq_bigr do rewrite /image mulr_sumr.
rewrite exchange_big; apply: eq_bigr => j _; rewrite mulr_suml.
by apply: eq_bigr => i _; rewrite mulrA.
Qed.

Lemma column_sign j : columns_at_most_zero P r w -> j \in indices P ->
  ~~ is_resting (state_of r j) ->
  weighted_column j <= 0 /\ (strict_column P r w j -> weighted_column j < 0).
Proof.
move=> /allP columns Hj /negbTE may_move.
have [a [b [a0 b0 Tab [ab a_gt0]]]] := T_between A B O W.
have [p q p' q'] := ordered_ge0 R O.

have c_le : weighted_column j <=
    a * toR (column_bound P w (lower r) j) + b * toR (column_bound P w (upper r) j).
  apply: le_trans (ler_add (ler_wpmul2l a0 (column_bound_sound Hj p q))
                           (ler_wpmul2l b0 (column_bound_sound Hj p' q'))).
  rewrite !mulr_sumr -big_split /= le_eqVlt; apply/orP; left; apply/eqP/eq_bigr => i _.
  by rewrite Tab mulrDr !mulrA ![_ * weight _]mulrC.

have := columns _ Hj; rewrite may_move /= => /andP[l h].
have l0 : toR (column_bound P w (lower r) j) <= 0 :> R by rewrite toR_le0.
have h0 : toR (column_bound P w (upper r) j) <= 0 :> R by rewrite toR_le0.
split=> [|/andP[sl sh]]; apply: (le_trans c_le) || apply: (le_lt_trans c_le).
  by rewrite -[0]addr0 ler_add // mulr_ge0_le0.
have sl0 : toR (column_bound P w (lower r) j) < 0 :> R by rewrite toR_lt0.
have [ap|na] := boolP (0 < a); first by rewrite ltr_naddr ?mulr_ge0_le0 // pmulr_rlt0.
have bp : 0 < b by case: ab => // ap; rewrite ap in na.
rewrite ltr_naddl ?mulr_ge0_le0 // pmulr_rlt0 // toR_lt0.
by case/orP: sh => // /Z.eqb_spec z; rewrite (a_gt0 z) in na.
Qed.

End Columns.

Variables (P P' : enclosed) (A B A' B' : nat -> nat -> R).
Hypotheses (E : encloses P A B) (E' : encloses P' A' B') (same : size_of P' = size_of P).

Variables (a b : R) (x : nat -> R).
Hypothesis ag : agrees (size_of P) r x.
Hypotheses (a0 : 0 <= a) (b0 : 0 <= b) (ab : 0 < a \/ 0 < b).
Hypothesis sol : box_solution P P' A B A' B' t a b x.

Notation box_image := (box_image P P' A B A' B' t a b x).

Theorem box_farkas_sound : box_farkas P P' r w -> False.
Proof.
case/and4P=> /allP signs low high strict; have [[i0 Hi0 xi0] compl] := sol.
pose c j := a * weighted_column P A B j + b * weighted_column P' A' B' j.

have wy : 0 <= \sum_(i <- indices P) weight i * box_image i.
  apply: sum_ge0 => i Hi; have [x0 y0 xy] := compl _ Hi.
  have := signs _ Hi; have := agrees_at ag Hi.
  case: (state_of r i) => /=; try by move=> _ wi; rewrite mulr_ge0 // toR_ge0.
  by move=> xp _; move/eqP: xy; rewrite mulf_eq0 gt_eqF //= => /eqP->; rewrite mulr0.

have wy_columns : \sum_(i <- indices P) weight i * box_image i = \sum_(j <- indices P) c j * x j.
  transitivity (a * (\sum_(i <- indices P) weight i * image P A B t x i) +
                b * (\sum_(i <- indices P) weight i * image P' A' B' t x i)).
    rewrite !mulr_sumr -big_split; apply: eq_bigr => i _ /=.
    by rewrite mulrDr !(mulrCA (weight i)).
  rewrite weighted_image -(same_indices same) weighted_image (same_indices same) !mulr_sumr.
  by rewrite -big_split; apply: eq_bigr => j _; rewrite /c mulrDl !mulrA.

have c_sign j : j \in indices P -> ~~ is_resting (state_of r j) ->
    c j <= 0 /\ (strict_in_both P P' r w j -> c j < 0).
  move=> Hj may_move; have Hj' : j \in indices P' by rewrite (same_indices same).
  have [l l_strict] := column_sign E low Hj may_move.
  have [h h_strict] := column_sign E' high Hj' may_move.
  split; first by rewrite -[0]addr0 ler_add // mulr_ge0_le0.
  move=> /andP[/l_strict l1 /h_strict h1]; rewrite /c.
  by rewrite -oppr_gt0 opprD -!mulrN; apply: combination_gt0; rewrite ?oppr_gt0.

have term j : j \in indices P -> c j * x j <= 0.
  move=> Hj; have [x0 _ _] := compl _ Hj; have := agrees_at ag Hj; have := c_sign j Hj.
  case: (state_of r j) => /= [/(_ isT)[cj _] _|_ ->|/(_ isT)[cj _] _]; last 1 first.
  - exact: mulr_le0_ge0.
  - exact: mulr_le0_ge0.
  by rewrite mulr0.

have strict_term j : j \in indices P -> 0 < x j -> strict_in_both P P' r w j -> c j * x j < 0.
  move=> Hj xj sj; have := agrees_at ag Hj; have := c_sign j Hj; rewrite pmulr_llt0 //.
  case: (state_of r j) => /= [/(_ isT)[_ cj] _|_ z|/(_ isT)[_ cj] _]; try exact: cj.
  by rewrite z ltxx in xj.

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

Theorem farkas_sound (R : realFieldType) P (A B : nat -> nat -> R) r w t x : encloses P A B ->
  ordered (lower r) (upper r) -> farkas P r w -> in_region_of P t x r ->
  solves P A B t x -> False.
Proof.
move=> E O /and3P[signs columns strict] [W ag] /solves_box sol.
apply: (box_farkas_sound O W E E (erefl _) ag ler01 (lexx 0) (or_introl ltr01) sol (w := w)).
by rewrite /box_farkas signs columns; under eq_all do rewrite /strict_in_both andbb;
   under eq_has do rewrite /strict_in_both andbb.
Qed.
