(* Null vectors of a decided region: where they lie, and that there is at most one.

   In a decided region every variable rests or moves.  J is the list of the moving ones, k (the
   pivot) one of them, K the others.  A *null vector* of T(t) is an x with

       sum_(j in J) T(t)_lj x_j = 0   for every l in J.

   A solution of the region, scaled, is a null vector with x_k = V_k for a fixed integer V_k > 0.
   T_e is the matrix at the end e of an interval (Enclosed.v), Y an integer matrix that
   approximates an inverse, and u_e > 0 a unit for each end.

   1. The box.  If for both ends e and each row i in K

          rho_e,i = sum_(j in K) |u_e I - Y T_e|_ij < u_e     (radii included), and
          rho_e,i eps + |(Y T_e V)_i| <= u_e eps,

      then T(t) without row and column k is regular ([regular_sound]), and every x with x_k = V_k
      whose rows K vanish has |x_i - V_i| <= eps ([box_sound]).

   2. At most one.  Let (t, x) and (t', x') be null vectors of the region.  Then

          T(t) (x - x') + (t - t') B x' = 0,

      a linear system in (t - t', x - x').  If Y approximates the inverse of its matrix, with the
      column of t - t' weighted by 1/w, both are equal ([unique_sound]).  No left null vector is
      needed.

   The units let one proof serve finite ends and an end at infinity.

   Page: spec/certificates.md, 5.11, steps 1 to 3.  Step 3 there (monotone) is replaced by 2.
   Rust: crates/check/src/cover/root.rs, root/. *)

From Mceip Require Import Base Integers Sums Tree Enclosed.

(* Y, u at the lower and at the upper end, eps. *)
Record box := Box { inverse : matrix; unit_low : Z; unit_high : Z; width : Z }.

(* Y, u at both ends, and the weight w. *)
Record uniqueness := Uniqueness {
  system_inverse : matrix; system_unit_low : Z; system_unit_high : Z; system_rate : Z }.

Section Checker.

Variables (P : enclosed) (J K : seq nat) (k : nat) (v : seq Z).
Local Open Scope Z_scope.

Notation V j := (nth 0 v j).

Definition unit_entry (u : Z) (i j : nat) := if j == i then u else 0.

(* Y T_e, sums over the rows in L. *)
Definition product_center L Y e i j := sumZ L (fun l => entry Y i l * center P e l j).
Definition product_radius L Y e i j := sumZ L (fun l => Z.abs (entry Y i l) * radius P e l j).

Definition defect Y u e i :=
  sumZ K (fun j => Z.abs (unit_entry u i j - product_center K Y e i j) +
                   product_radius K Y e i j).

Definition residual Y e i :=
  Z.abs (sumZ J (fun j => product_center K Y e i j * V j)) +
  sumZ J (fun j => product_radius K Y e i j * Z.abs (V j)).

(* rho < u and rho eps + r <= u eps; rho is an argument, so that it is computed once. *)
Definition contracts u eps rho r := (rho <? u) && (rho * eps + r <=? u * eps).

Definition box_row Y u eps e i := contracts u eps (defect Y u e i) (residual Y e i).

Definition box_end b u e := (0 <? u) && all (box_row (inverse b) u (width b) e) K.

Definition check_box b lo hi :=
  [&& 0 <=? width b, box_end b (unit_low b) lo & box_end b (unit_high b) hi].

(* The sum of f_j x_j for f_j within r_j of F_j, x_j within eps of V_j, and x_k = V_k. *)
Definition sum_center (F : nat -> Z) := sumZ J (fun j => F j * V j).
Definition sum_radius (F r : nat -> Z) eps :=
  sumZ J (fun j => r j * Z.abs (V j) + (if j == k then 0 else (Z.abs (F j) + r j) * eps)).

(* The column of t - t': Y B x'. *)
Definition rate_center Y i := sumZ J (fun l => entry Y i l * sum_center (entry (center_b P) l)).
Definition rate_radius Y eps i :=
  sumZ J (fun l => Z.abs (entry Y i l) *
                   sum_radius (entry (center_b P) l) (entry (radius_b P) l) eps).

Definition system_center Y w e i j :=
  if j == k then e.2 * rate_center Y i else w * product_center J Y e i j.
Definition system_radius Y w eps e i j :=
  if j == k then e.2 * rate_radius Y eps i else w * product_radius J Y e i j.

Definition unique_row Y u w eps e i :=
  sumZ J (fun j => Z.abs (unit_entry u i j - system_center Y w e i j) +
                   system_radius Y w eps e i j) <? u.

Definition unique_end c u eps e :=
  (0 <? u) && all (unique_row (system_inverse c) u (system_rate c) eps e) J.

Definition check_unique c eps lo hi :=
  [&& 0 <? system_rate c, 0 <=? eps, unique_end c (system_unit_low c) eps lo &
      unique_end c (system_unit_high c) eps hi].

End Checker.

Section Sound.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Variables (J K : seq nat) (k : nat) (v : seq Z).
Hypotheses (J_indices : forall j, j \in J -> j \in indices P).
Hypotheses (K_J : forall j, (j \in K) = (j \in J) && (j != k)).
Hypotheses (k_J : k \in J) (uniq_J : uniq J) (uniq_K : uniq K).

Notation T := (T A B).
Notation T_end := (T_end A B).
Notation V j := (toR (nth 0%Z v j) : R).

Lemma K_indices j : j \in K -> j \in indices P.
Proof. by rewrite K_J => /andP[/J_indices]. Qed.

Lemma sum_pivot (f : nat -> R) : \sum_(j <- J) f j = f k + \sum_(j <- K) f j.
Proof.
rewrite (bigD1_seq k) //=; congr (_ + _); rewrite -big_filter; apply: perm_big.
by apply: uniq_perm; rewrite ?filter_uniq // => j; rewrite mem_filter K_J andbC.
Qed.

Lemma sum_unit (l : seq nat) u (z : nat -> R) i : uniq l -> i \in l ->
  \sum_(j <- l) toR (unit_entry u i j) * z j = toR u * z i.
Proof.
move=> uniq_l il; rewrite (bigD1_seq i) //= /unit_entry eqxx big1 ?addr0 // => j /negbTE->.
by rewrite mul0r.
Qed.

(* Y T_e lies within its radius of its center. *)
Lemma product_enclosed L Y e i j :
  (forall l, l \in L -> l \in indices P) -> j \in indices P ->
  0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  `|\sum_(l <- L) toR (entry Y i l) * T_end e l j - toR (product_center P L Y e i j)| <=
  toR (product_radius P L Y e i j).
Proof.
move=> L_indices Hj p q; rewrite /product_center /product_radius !toR_sum -sumrB.
rewrite (le_trans (sum_norm _ _)) //; apply: sum_le => l lL.
rewrite !toRM toR_abs -mulrBr normrM; apply: ler_wpmul2l => //.
by apply: T_end_enclosed => //; apply: L_indices.
Qed.

(* A row of u I - G times z, for G known up to a radius. *)
Lemma row_bound (l : seq nat) (g : nat -> R) (G r u : nat -> Z) (z : nat -> R) Z :
  (forall j, j \in l -> `|g j - toR (G j)| <= toR (r j)) ->
  (forall j, j \in l -> `|z j| <= Z) ->
  `|\sum_(j <- l) (toR (u j) - g j) * z j| <=
  toR (sumZ l (fun j => Z.abs (u j - G j) + r j)%Z) * Z.
Proof.
move=> near_G z_le; rewrite toR_sum mulr_suml (le_trans (sum_norm _ _)) //.
apply: sum_le => j jl; rewrite normrM ler_pmul ?normr_ge0 ?z_le // toRD toR_abs toRB.
have -> : toR (u j) - g j = (toR (u j) - toR (G j)) - (g j - toR (G j)) by ring.
by rewrite (le_trans (ler_norm_sub _ _)) // ler_add2l near_G.
Qed.

Lemma constant_bound (l : seq nat) (g : nat -> R) (G r W : nat -> Z) :
  (forall j, j \in l -> `|g j - toR (G j)| <= toR (r j)) ->
  `|\sum_(j <- l) g j * toR (W j)| <=
  toR (Z.abs (sumZ l (fun j => G j * W j)) + sumZ l (fun j => r j * Z.abs (W j)))%Z.
Proof.
move=> near_G; rewrite toRD toR_abs !toR_sum.
have -> : \sum_(j <- l) g j * toR (W j) =
          \sum_(j <- l) toR (G j * W j)%Z + \sum_(j <- l) (g j - toR (G j)) * toR (W j).
  by rewrite -big_split; apply: eq_bigr => j _ /=; rewrite toRM; ring.
rewrite (le_trans (ler_norm_add _ _)) // ler_add2l (le_trans (sum_norm _ _)) //.
by apply: sum_le => j jl; rewrite normrM toRM toR_abs ler_wpmul2r // near_G.
Qed.

(* T(t) as a combination of the ends, with weights a and b. *)
Definition combination t (lo hi : point) (a b : R) :=
  [/\ 0 <= a, 0 <= b, 0 < a \/ 0 < b &
      forall i j, T t i j = a * T_end lo i j + b * T_end hi i j].

Section Box.

Variables (c : box) (lo hi : point) (t a b : R).
Hypotheses (checked : check_box P J K v c lo hi) (comb : combination t lo hi a b).
Hypotheses (lo1 : 0 <= toR lo.1 :> R) (lo2 : 0 <= toR lo.2 :> R).
Hypotheses (hi1 : 0 <= toR hi.1 :> R) (hi2 : 0 <= toR hi.2 :> R).

Notation Y := (inverse c).
Notation eps := (width c).

Let u : R := a * toR (unit_low c) + b * toR (unit_high c).

Lemma units_gt0 : 0 < toR (unit_low c) :> R /\ 0 < toR (unit_high c) :> R.
Proof. by case/and3P: checked => _ /andP[? _] /andP[? _]; rewrite !toR_gt0. Qed.

Lemma unit_gt0 : 0 < u.
Proof.
have [ul uh] := units_gt0; have [a0 b0 ab _] := comb.
exact: combination_gt0.
Qed.

(* (u_e I - Y T_e) z - Y T_e w *)
Definition applied ue e (z w : nat -> R) i :=
  \sum_(j <- K) (toR (unit_entry ue i j) - \sum_(l <- K) toR (entry Y i l) * T_end e l j) * z j -
  \sum_(j <- J) (\sum_(l <- K) toR (entry Y i l) * T_end e l j) * w j.

(* The combination of both ends is u z_i if the rows K of T(t) vanish on z + w. *)
Lemma applied_combination z w i : i \in K ->
  (forall l, l \in K -> \sum_(j <- K) T t l j * z j + \sum_(j <- J) T t l j * w j = 0) ->
  a * applied (unit_low c) lo z w i + b * applied (unit_high c) hi z w i = u * z i.
Proof.
case: comb => _ _ _ Tab iK rows_vanish.

have appliedE ue e : applied ue e z w i = toR ue * z i -
    \sum_(l <- K) toR (entry Y i l) *
      (\sum_(j <- K) T_end e l j * z j + \sum_(j <- J) T_end e l j * w j).
  rewrite /applied; under eq_bigr do rewrite mulrBl.
  rewrite sumrB (sum_unit _ _ uniq_K iK) -addrA -opprD; congr (_ - _).
  under [RHS]eq_bigr do rewrite mulrDr !mulr_sumr.
  rewrite big_split /= exchange_big [X in _ = _ + X]exchange_big /=.
  by congr (_ + _); apply: eq_bigr => j _; rewrite mulr_suml; apply: eq_bigr => l _; rewrite mulrA.

rewrite !appliedE !mulrBr addrACA -opprD !mulrA -mulrDl -/u !mulr_sumr -big_split /=.
rewrite sum_zero ?subr0 // => l lK.
rewrite !(mulrCA _ (toR (entry Y i l))) -mulrDr; apply/eqP; rewrite mulf_eq0; apply/orP; right.
apply/eqP; rewrite -[RHS](rows_vanish _ lK) !mulrDr addrACA !mulr_sumr -!big_split /=.
by congr (_ + _); apply: eq_bigr => j _; rewrite Tab mulrDl !mulrA.
Qed.

Lemma defect_bound ue e z i Z : i \in K -> 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  (forall j, j \in K -> `|z j| <= Z) ->
  `|applied ue e z (fun=> 0) i| <= toR (defect P K Y ue e i) * Z.
Proof.
move=> iK p q z_le; rewrite /applied [X in _ - X]sum_zero ?subr0 => [|j _]; last by rewrite mulr0.
by apply: row_bound z_le => j jK; apply: product_enclosed => //; apply: K_indices.
Qed.

Lemma residual_bound ue e z i Z : i \in K -> 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  (forall j, j \in K -> `|z j| <= Z) ->
  `|applied ue e z (fun j => V j) i| <=
  toR (defect P K Y ue e i) * Z + toR (residual P J K v Y e i).
Proof.
move=> iK p q z_le; rewrite /applied (le_trans (ler_norm_sub _ _)) // ler_add //.
  by apply: row_bound z_le => j jK; apply: product_enclosed => //; apply: K_indices.
apply: constant_bound => j jJ.
by apply: product_enclosed => //; [apply: K_indices | apply: J_indices].
Qed.

(* T(t) without row and column k is regular. *)
Theorem regular_sound z :
  (forall l, l \in K -> \sum_(j <- K) T t l j * z j = 0) -> forall i, i \in K -> z i = 0.
Proof.
move=> rows_vanish i iK; apply/eqP; rewrite -normr_le0; move: i iK.
apply: (contraction unit_gt0) => Z Z0 z_le i iK.
have [a0 b0 ab _] := comb; have [ul uh] := units_gt0.

rewrite -{1}(gtr0_norm unit_gt0) -normrM -(applied_combination (w := fun=> 0) iK); last first.
  move=> l lK; rewrite rows_vanish // add0r sum_zero // => j _; exact: mulr0.
rewrite /u mulrDl -!mulrA; apply: combination_lt => //.
  rewrite (le_lt_trans (defect_bound _ iK lo1 lo2 z_le)) // ltr_pmul2r // toR_lt.
  by case/and3P: checked => _ /andP[_ /allP rows] _; have /andP[] := rows _ iK.
rewrite (le_lt_trans (defect_bound _ iK hi1 hi2 z_le)) // ltr_pmul2r // toR_lt.
by case/and3P: checked => _ _ /andP[_ /allP rows]; have /andP[] := rows _ iK.
Qed.

Theorem box_sound x :
  x k = V k -> (forall l, l \in K -> \sum_(j <- J) T t l j * x j = 0) ->
  forall i, i \in K -> `|x i - V i| <= toR eps.
Proof.
move=> xk rows_vanish.
apply: (contraction (x := fun i => x i - V i) unit_gt0) => Z Z0 z_le i iK.
have [a0 b0 ab _] := comb.

rewrite -{1}(gtr0_norm unit_gt0) -normrM.
rewrite -(applied_combination (z := fun i => x i - V i) (w := fun j => V j) iK); last first.
  move=> l lK; rewrite -[RHS](rows_vanish _ lK) !sum_pivot xk addrCA -big_split /=.
  by congr (_ + _); apply: eq_bigr => j _; ring.

have below ue e : 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R -> box_row P J K v Y ue eps e i ->
    `|applied ue e (fun i => x i - V i) (fun j => V j) i| < toR ue * Z.
  move=> p q /andP[lt le]; rewrite (le_lt_trans (residual_bound _ iK p q z_le)) //.
  move: lt le; rewrite -(@toR_lt R) -(@toR_le R) toRD !toRM.
  set rho := toR (defect _ _ _ _ _ _); set res := toR (residual _ _ _ _ _ _ _) => lt le.
  rewrite -subr_gt0 (_ : _ - _ = (toR ue - rho) * (Z - toR eps) +
                                 (toR ue * toR eps - (rho * toR eps + res))); last by ring.
  by apply: ltr_paddr; [rewrite subr_ge0 | apply: mulr_gt0; rewrite subr_gt0].

rewrite /u mulrDl -!mulrA; apply: combination_lt => //; apply: below => //.
  by case/and3P: checked => _ /andP[_ /allP rows] _; apply: rows.
by case/and3P: checked => _ _ /andP[_ /allP rows]; apply: rows.
Qed.

End Box.

(* x_k = V_k and |x_i - V_i| <= eps elsewhere. *)
Definition boxed eps (x : nat -> R) :=
  x k = V k /\ forall i, i \in K -> `|x i - V i| <= toR eps.

Lemma sum_enclosed (f : nat -> R) (F r : nat -> Z) eps x :
  0 <= toR eps :> R -> boxed eps x ->
  (forall j, j \in J -> `|f j - toR (F j)| <= toR (r j)) ->
  `|\sum_(j <- J) f j * x j - toR (sum_center J v F)| <= toR (sum_radius J k v F r eps).
Proof.
move=> eps0 [xk xK] near_F; rewrite /sum_center /sum_radius !toR_sum -sumrB.
rewrite (le_trans (sum_norm _ _)) //; apply: sum_le => j jJ.
rewrite toRD !toRM toR_abs; case: eqP => [->|/eqP jk].
  by rewrite xk toR0 addr0 -mulrBl normrM ler_wpmul2r // near_F.

rewrite toRM toRD toR_abs.
have -> : f j * x j - toR (F j) * V j =
          (f j - toR (F j)) * V j +
          (toR (F j) * (x j - V j) + (f j - toR (F j)) * (x j - V j)) by ring.
have xj : `|x j - V j| <= toR eps by apply: xK; rewrite K_J jJ.
apply: le_trans (ler_norm_add _ _) _; apply: ler_add; first by rewrite normrM ler_wpmul2r // near_F.
rewrite [X in _ <= X]mulrDl; apply: le_trans (ler_norm_add _ _) _.
apply: ler_add; rewrite normrM; first exact: ler_wpmul2l.
by apply: ler_pmul => //; apply: near_F.
Qed.

Definition null_vector t (x : nat -> R) := forall l, l \in J -> \sum_(j <- J) T t l j * x j = 0.

Section Unique.

Variables (c : uniqueness) (eps : Z) (lo hi : point).
Hypothesis checked : check_unique P J k v c eps lo hi.
Hypotheses (lo1 : 0 <= toR lo.1 :> R) (lo2 : 0 <= toR lo.2 :> R).
Hypotheses (hi1 : 0 <= toR hi.1 :> R) (hi2 : 0 <= toR hi.2 :> R).

Notation Y := (system_inverse c).
Notation w := (system_rate c).

Theorem unique_sound t t' a b x x' :
  combination t lo hi a b -> a * toR lo.2 + b * toR hi.2 = 1 ->
  boxed eps x' -> x k = V k -> null_vector t x -> null_vector t' x' ->
  t = t' /\ forall j, j \in J -> x j = x' j.
Proof.
move=> [a0 b0 ab Tab] one boxed' xk null null'.
case/and4P: checked => w0 eps0 /andP[ul /allP rows_lo] /andP[uh /allP rows_hi].
have {}w0 : 0 < toR w :> R by rewrite toR_gt0.
have {}eps0 : 0 <= toR eps :> R by rewrite toR_ge0.
have {}ul : 0 < toR (system_unit_low c) :> R by rewrite toR_gt0.
have {}uh : 0 < toR (system_unit_high c) :> R by rewrite toR_gt0.

(* The unknowns z, the column Y B x', and the matrix g of the system at an end. *)
pose z j := if j == k then toR w * (t - t') else x j - x' j.
pose h i := \sum_(l <- J) toR (entry Y i l) * \sum_(j <- J) B l j * x' j.
pose g (e : point) i j :=
  if j == k then toR e.2 * h i else toR w * \sum_(l <- J) toR (entry Y i l) * T_end e l j.
pose G := system_center P J k v Y w.
pose r := system_radius P J k v Y w eps.

have near_G e i j : 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R -> i \in J -> j \in J ->
    `|g e i j - toR (G e i j)| <= toR (r e i j).
  move=> p q iJ jJ; rewrite /g /G /r /system_center /system_radius; case: eqP => _.
    rewrite !toRM -mulrBr normrM (ger0_norm q) ler_wpmul2l //.
    rewrite /h /rate_center /rate_radius !toR_sum -sumrB (le_trans (sum_norm _ _)) //.
    apply: sum_le => l lJ; rewrite !toRM toR_abs -mulrBr normrM ler_wpmul2l //.
    by apply: sum_enclosed => // j' j'J; have [_ ->] := E (J_indices lJ) (J_indices j'J).
  rewrite !toRM -mulrBr normrM gtr0_norm // ler_pmul2l //.
  by apply: product_enclosed => //; apply: J_indices.

(* The rows of the system vanish on z. *)
have vanish i : i \in J ->
    a * (\sum_(j <- J) g lo i j * z j) + b * (\sum_(j <- J) g hi i j * z j) = 0.
  move=> iJ; have gz e : \sum_(j <- J) g e i j * z j =
      toR w * \sum_(l <- J) toR (entry Y i l) *
        (toR e.2 * (t - t') * (\sum_(j <- J) B l j * x' j) +
         \sum_(j <- K) T_end e l j * (x j - x' j)).
    rewrite sum_pivot /z /g eqxx.
    under [in RHS]eq_bigr do rewrite mulrDr; rewrite big_split /= mulrDr; congr (_ + _).
      transitivity (toR w * (toR e.2 * (t - t') * h i)); first by ring.
      by congr (_ * _); rewrite /h [LHS]mulr_sumr; apply: eq_bigr => l _; rewrite mulrCA.
    under [in RHS]eq_bigr do rewrite mulr_sumr.
    rewrite [in RHS]exchange_big [in RHS]mulr_sumr /= big_seq [RHS]big_seq.
    apply: eq_bigr => j; rewrite K_J => /andP[_ /negbTE->]; rewrite -mulrA mulr_suml.
    by congr (_ * _); apply: eq_bigr => l _; rewrite mulrA.
  rewrite !gz (mulrCA a) (mulrCA b) -mulrDr !mulr_sumr -big_split /= sum_zero ?mulr0 // => l lJ.
  rewrite (mulrCA a) (mulrCA b) -!mulrDr; set s := \sum_(j <- J) _.
  suff -> : a * (toR lo.2 * (t - t') * s + \sum_(j <- K) T_end lo l j * (x j - x' j)) +
            b * (toR hi.2 * (t - t') * s + \sum_(j <- K) T_end hi l j * (x j - x' j)) = 0.
    by rewrite mulr0.
  rewrite [a * (_ + _)]mulrDr [b * (_ + _)]mulrDr addrACA.
  have -> : a * (toR lo.2 * (t - t') * s) + b * (toR hi.2 * (t - t') * s) = (t - t') * s.
    by rewrite -[RHS]mul1r -one; ring.
  have -> : a * (\sum_(j <- K) T_end lo l j * (x j - x' j)) +
            b * (\sum_(j <- K) T_end hi l j * (x j - x' j)) =
            \sum_(j <- J) T t l j * (x j - x' j).
    rewrite sum_pivot; case: boxed' => -> _; rewrite xk subrr mulr0 add0r.
    by rewrite !mulr_sumr -big_split /=; apply: eq_bigr => j _; rewrite Tab mulrDl !mulrA.
  have -> : \sum_(j <- J) T t l j * (x j - x' j) =
            \sum_(j <- J) T t l j * x j - \sum_(j <- J) T t' l j * x' j - (t - t') * s.
    by rewrite /s mulr_sumr -!sumrB; apply: eq_bigr => j _; rewrite /Enclosed.T; ring.
  by rewrite null // null' // subr0 sub0r addrN.

(* So z = 0. *)
pose u : R := a * toR (system_unit_low c) + b * toR (system_unit_high c).
have u0 : 0 < u by apply: combination_gt0.
have z_zero i : i \in J -> z i = 0.
  move=> iJ; apply/eqP; rewrite -normr_le0; move: i iJ.
  apply: (contraction u0) => Z Z0 z_le i iJ; rewrite -{1}(gtr0_norm u0) -normrM.
  have -> : u * z i =
      a * (\sum_(j <- J) (toR (unit_entry (system_unit_low c) i j) - g lo i j) * z j) +
      b * (\sum_(j <- J) (toR (unit_entry (system_unit_high c) i j) - g hi i j) * z j).
    under [in RHS]eq_bigr do rewrite mulrBl; rewrite sumrB (sum_unit _ _ uniq_J iJ).
    under [X in _ = _ + b * X]eq_bigr do rewrite mulrBl; rewrite sumrB (sum_unit _ _ uniq_J iJ).
    by rewrite !mulrBr addrACA -opprD vanish // subr0 /u mulrDl !mulrA.
  have below ue e : 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
      unique_row P J k v Y ue w eps e i ->
      `|\sum_(j <- J) (toR (unit_entry ue i j) - g e i j) * z j| < toR ue * Z.
    move=> p q lt; have le := row_bound (G := G e i) (r := r e i) (unit_entry ue i)
      (fun j => near_G e i j p q iJ) z_le.
    by apply: le_lt_trans le _; rewrite ltr_pmul2r // toR_lt.
  rewrite /u mulrDl -!mulrA; apply: combination_lt => //; apply: below => //.
    exact: rows_lo.
  exact: rows_hi.

have tt' : t = t'.
  have := z_zero _ k_J; rewrite /z eqxx => /eqP; rewrite mulf_eq0 gt_eqF //= subr_eq0 => /eqP.
  by [].
split=> // j jJ; have [->|jk] := eqVneq j k; first by rewrite xk; case: boxed'.
by have := z_zero _ jJ; rewrite /z (negbTE jk) => /eqP; rewrite subr_eq0 => /eqP.
Qed.

End Unique.

End Sound.
