(* The leaf `regular`: a decided box whose matrix has no null vector.

   In a decided box every variable rests or moves.  J is the list of the moving ones, k (the pivot)
   one of them and the first of J, K the others, m their number.  A solution of the box has
   sum_(j in J) T_ij x_j = 0 for every i in J, and x_k > 0.

   T is a combination of the matrices T_c of the corners of the box, with weights that are not
   negative and not all 0.  The checker has integer matrices M_c and R_c, |T_c - M_c| <= R_c, and
   the witness: integer vectors U and V over J, V_k > 0, an integer matrix Y over K, a unit u_c > 0
   for each corner, integers e_j > 0 over K and a sign s.  It asks for each corner that

     1. for each row i in K, with the radii included,
            sum_(j in K) |u_c I - Y M_c|_ij e_j + |(Y M_c V)_i| < u_c e_i;
     2. s h_c > g_c + p_c, where h_c = U' M_c V, g_c = |U|' R_c |V| and p_c is the sum over K of
        |U' M_c|_j e_j, radii included.

   Let x_k = a V_k with a >= 0, and let the rows K of T x vanish.  Then |x_j - a V_j| <= a e_j
   ([near_null]); for a = 0 this says that T is regular on K.  If a > 0, then s U' T_c x > 0 for
   each corner ([sign_at_corner]).  For a null vector the combination of the T_c x is 0.  So there
   is none ([no_null_vector]), and the box has no solution ([box_regular_sound]).

   Each corner has a unit of its own, so the ends of the interval need no common denominator and one
   of them may be at infinity.  The page has one number epsilon in place of the e_j, and asks that
   the largest P_c times epsilon is less than s h_c - g_c; 2 follows from it.

   Page: spec/certificates.md, 5.18.  Rust: crates/check/src/cover/critical.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Root RootLeaf Claim Series Boxes.

(* U and V begin with the component at the pivot; rows and columns of Y are those of K. *)
Record regular := Regular {
  regular_pivot : nat;
  regular_inverse : matrix;
  regular_units : seq Z;
  regular_left : seq Z;
  regular_right : seq Z;
  regular_widths : seq Z;
  regular_minus : bool }.

Section Checker.

Local Open Scope Z_scope.

(* The sum of the rows, each times a number. *)
Definition combine_rows (c : seq Z) (rows : matrix) : seq Z :=
  foldr (fun e sum => add_poly (scale_poly e.1 e.2) sum) [::] (zip c rows).

Variables (m : nat) (w : regular).

Notation eps j := (nth 0 (regular_widths w) j).

(* p'V; r'|V|; the sum over K of (|p_j| + r_j) e_j. *)
Definition against_right (p : seq Z) :=
  sumZ (iota 0 m.+1) (fun j => nth 0 p j * nth 0 (regular_right w) j).
Definition against_radius (r : seq Z) :=
  sumZ (iota 0 m.+1) (fun j => nth 0 r j * Z.abs (nth 0 (regular_right w) j)).
Definition off_pivot (u : Z) (i : nat) (p r : seq Z) :=
  sumZ (iota 0 m) (fun j => (Z.abs (unit_entry u i j - nth 0 p j.+1) + nth 0 r j.+1) * eps j).

Definition regular_row (M Rd : matrix) (u : Z) (i : nat) :=
  let y := nth [::] (regular_inverse w) i in
  let p := combine_rows y (behead M) in
  let r := combine_rows [seq Z.abs c | c <- y] (behead Rd) in
  off_pivot u i p r + (Z.abs (against_right p) + against_radius r) <? u * eps i.

Definition regular_rows (M Rd : matrix) (u : Z) :=
  [&& 0 <? u, all (fun i => 0 <? eps i) (iota 0 m) & all (regular_row M Rd u) (iota 0 m)].

(* How far p'x may be from p'V. *)
Definition row_slack (p r : seq Z) := against_radius r + off_pivot 0 0 p r.

Definition regular_sign (M Rd : matrix) :=
  let p := combine_rows (regular_left w) M in
  let r := combine_rows [seq Z.abs c | c <- regular_left w] Rd in
  let h := against_right p in
  row_slack p r <? (if regular_minus w then - h else h).

End Checker.

Section Rows.

Variable R : realFieldType.

Lemma toR_combine c rows j : toR (nth 0%Z (combine_rows c rows) j) =
  \sum_(l <- iota 0 (size rows)) toR (nth 0%Z c l) * toR (entry rows l j) :> R.
Proof.
elim: rows c => [|row rows IH] [|a c]; rewrite /combine_rows /= ?nth_nil ?big_nil //.
  by rewrite toR0 sum_zero // => l _; rewrite nth_nil toR0 mul0r.
rewrite nth_add_poly nth_scale_poly toRD toRM -/(combine_rows c rows) IH big_cons.
by rewrite [X in _ = _ + X]sum_shift.
Qed.

Lemma nth_abs (c : seq Z) l : nth 0%Z [seq Z.abs a | a <- c] l = Z.abs (nth 0%Z c l).
Proof.
have [lt_l|ge_l] := ltnP l (size c); first by rewrite (nth_map 0%Z).
by rewrite !nth_default ?size_map.
Qed.

Lemma combine_near c (M Rd : matrix) (T : nat -> nat -> R) n j :
  size M = n -> size Rd = n ->
  (forall l, (l < n)%N -> `|T l j - toR (entry M l j)| <= toR (entry Rd l j)) ->
  `|\sum_(l <- iota 0 n) toR (nth 0%Z c l) * T l j - toR (nth 0%Z (combine_rows c M) j)| <=
  toR (nth 0%Z (combine_rows [seq Z.abs a | a <- c] Rd) j).
Proof.
move=> sM sR near; rewrite !toR_combine sM sR -sumrB.
apply: le_trans (sum_norm _ _) _; apply: sum_le => l; rewrite mem_iota add0n => /= lt_l.
by rewrite nth_abs toR_abs -mulrBr normrM ler_wpmul2l // near.
Qed.

Lemma sum_first (f : nat -> R) m :
  \sum_(j <- iota 0 m.+1) f j = f 0%N + \sum_(j <- iota 0 m) f j.+1.
Proof. by rewrite /= big_cons sum_shift. Qed.

End Rows.

(* Any number of corners: those in cs. *)
Section Corners.

Variables (R : realFieldType) (m : nat) (w : regular).
Variables (cs : seq nat) (M Rd : nat -> matrix) (unit_at : nat -> Z).
Variables (T : nat -> nat -> nat -> R) (weight : nat -> R) (x : nat -> R).

Notation J := (iota 0 m.+1).
Notation K := (iota 0 m).
Notation V j := (toR (nth 0%Z (regular_right w) j) : R).
Notation U i := (toR (nth 0%Z (regular_left w) i) : R).
Notation Y i l := (toR (nth 0%Z (nth [::] (regular_inverse w) i) l) : R).
Notation eps j := (toR (nth 0%Z (regular_widths w) j) : R).

Hypothesis sizes : forall c, c \in cs -> size (M c) = m.+1 /\ size (Rd c) = m.+1.
Hypothesis near : forall c i j, c \in cs -> (i < m.+1)%N -> (j < m.+1)%N ->
  `|T c i j - toR (entry (M c) i j)| <= toR (entry (Rd c) i j).
Hypothesis checked : forall c, c \in cs -> regular_rows m w (M c) (Rd c) (unit_at c).
Hypothesis weight0 : forall c, c \in cs -> 0 <= weight c.
Hypothesis weight_gt0 : exists2 c, c \in cs & 0 < weight c.

Definition row_at_corner c i := \sum_(j <- J) T c i j * x j.

Hypothesis null : forall i, (i < m)%N -> \sum_(c <- cs) weight c * row_at_corner c i.+1 = 0.

Variable a : R.
Hypotheses (a0 : 0 <= a) (x_pivot : x 0%N = a * V 0%N).

Let z l : R := x l.+1 - a * V l.+1.

Lemma widths_gt0 j : (j < m)%N -> 0 < eps j.
Proof.
have [c Hc _] := weight_gt0; have /and3P[_ /allP e0 _] := checked Hc.
by move=> lt_j; rewrite toR_gt0 e0 // mem_iota.
Qed.

(* A row over J, applied to x = a V + z. *)
Lemma row_of_null (p : nat -> R) :
  \sum_(j <- J) p j * x j = a * (\sum_(j <- J) p j * V j) + \sum_(j <- K) p j.+1 * z j.
Proof.
rewrite !sum_first mulrDr mulr_sumr -addrA -big_split /=; congr (_ + _).
  by rewrite x_pivot mulrCA.
by apply: eq_bigr => j _; rewrite /z; ring.
Qed.

(* A combination of the rows in l. *)
Lemma combined_rows (f : nat -> R) c (l : seq nat) (g : nat -> nat) :
  \sum_(i <- l) f i * row_at_corner c (g i) =
  \sum_(j <- J) (\sum_(i <- l) f i * T c (g i) j) * x j.
Proof.
under eq_bigr do rewrite mulr_sumr.
rewrite exchange_big; apply: eq_bigr => j _; rewrite mulr_suml.
by apply: eq_bigr => i _; rewrite mulrA.
Qed.

Lemma combined_corners (f : nat -> R) (l : seq nat) (g : nat -> nat) :
  \sum_(c <- cs) weight c * (\sum_(i <- l) f i * row_at_corner c (g i)) =
  \sum_(i <- l) f i * (\sum_(c <- cs) weight c * row_at_corner c (g i)).
Proof.
under eq_bigr do rewrite mulr_sumr.
rewrite exchange_big; apply: eq_bigr => i _; rewrite mulr_sumr.
by apply: eq_bigr => c _; rewrite mulrCA.
Qed.

(* The part of a row off the pivot, for |z| <= b e. *)
Lemma off_bound u i (G : nat -> R) (p r : seq Z) b :
  (forall j, j \in J -> `|G j - toR (nth 0%Z p j)| <= toR (nth 0%Z r j)) ->
  (forall l, l \in K -> `|z l| <= b * eps l) ->
  `|\sum_(j <- K) (toR (unit_entry u i j) - G j.+1) * z j| <= b * toR (off_pivot m w u i p r).
Proof.
move=> nearG z_le; rewrite /off_pivot toR_sum mulr_sumr; apply: le_trans (sum_norm _ _) _.
apply: sum_le => j jK; rewrite toRM mulrCA normrM; apply: ler_pmul => //; last exact: z_le.
have jJ : j.+1 \in J by move: jK; rewrite !mem_iota.
have -> : toR (unit_entry u i j) - G j.+1 =
    toR (unit_entry u i j - nth 0 p j.+1)%Z - (G j.+1 - toR (nth 0%Z p j.+1)).
  by rewrite toRB; ring.
by rewrite toRD toR_abs (le_trans (ler_norm_sub _ _)) // ler_add2l nearG.
Qed.

Section Row.

Variables (c i : nat).
Hypotheses (cs_c : c \in cs) (lt_i : (i < m)%N).

Let y := nth [::] (regular_inverse w) i.
Let p := combine_rows y (behead (M c)).
Let r := combine_rows [seq Z.abs e | e <- y] (behead (Rd c)).
Let G j : R := \sum_(l <- K) Y i l * T c l.+1 j.
Let u := unit_at c.
Let d := off_pivot m w u i p r.
Let res := (Z.abs (against_right m w p) + against_radius m w r)%Z.

Lemma row_near j : j \in J -> `|G j - toR (nth 0%Z p j)| <= toR (nth 0%Z r j).
Proof.
rewrite mem_iota add0n => /= lt_j; have [sM sR] := sizes cs_c.
apply: (combine_near y (T := fun l j => T c l.+1 j)) => [||l lt_l]; rewrite ?size_behead ?sM ?sR //.
by rewrite /entry !nth_behead; apply: near.
Qed.

Lemma row_bound_at b : (forall l, l \in K -> `|z l| <= b * eps l) ->
  `|toR u * z i - \sum_(l <- K) Y i l * row_at_corner c l.+1| <= b * toR d + a * toR res.
Proof.
move=> z_le; rewrite combined_rows row_of_null.
have iK : i \in K by rewrite mem_iota.
have -> : toR u * z i - (a * (\sum_(j <- J) G j * V j) + \sum_(j <- K) G j.+1 * z j) =
    \sum_(j <- K) (toR (unit_entry u i j) - G j.+1) * z j - a * (\sum_(j <- J) G j * V j).
  under [X in _ = X - _]eq_bigr do rewrite mulrBl.
  by rewrite sumrB (sum_unit _ _ (iota_uniq 0 m) iK) opprD addrA addrAC.
apply: le_trans (ler_norm_sub _ _) _; apply: ler_add; first exact: off_bound row_near z_le.
rewrite normrM ger0_norm //; apply: ler_wpmul2l => //.
exact: (constant_bound (G := nth 0%Z p) (r := nth 0%Z r)) row_near.
Qed.

Lemma row_contracts b : a < b -> b * toR d + a * toR res < b * (toR u * eps i).
Proof.
move=> lt_b; have /and3P[_ _ /allP rows] := checked cs_c.
have := rows i; rewrite mem_iota => /(_ lt_i).
rewrite /regular_row -/y -/p -/r -/res -/d -/u -(@toR_lt R) toRD toRM => lt.
have res0 : 0 <= toR res :> R.
  exact: le_trans (normr_ge0 _) (constant_bound (nth 0%Z (regular_right w)) row_near).
have b0 : 0 < b by apply: le_lt_trans lt_b.
apply: (@le_lt_trans _ _ (b * (toR d + toR res))).
  by rewrite mulrDr ler_add2l ler_wpmul2r // ltW.
by rewrite ltr_pmul2l.
Qed.

End Row.

(* x is near a V. *)
Lemma near_null l : l \in K -> `|z l| <= a * eps l.
Proof.
move=> lK; pose total := \sum_(c <- cs) weight c * toR (unit_at c).
have unit_gt0 c : c \in cs -> 0 < toR (unit_at c) :> R.
  by move=> /checked/and3P[u0 _ _]; rewrite toR_gt0.
have total_gt0 : 0 < total.
  apply: sum_gt0 => [c Hc|]; first by rewrite mulr_ge0 ?weight0 // ltW ?unit_gt0.
  by have [c Hc w_gt0] := weight_gt0; exists c => //; rewrite mulr_gt0 ?unit_gt0.
have e_gt0 i : i \in K -> 0 < eps i by rewrite mem_iota => lt_i; apply: widths_gt0.
rewrite -ler_pdivr_mulr ?e_gt0 // -[eps l](gtr0_norm (e_gt0 l lK)) -normf_div; move: l lK.
apply: (contraction (x := fun l => z l / eps l) total_gt0) => b lt_b z_le' i iK.
have lt_i : (i < m)%N by move: iK; rewrite mem_iota.
have z_le l : l \in K -> `|z l| <= b * eps l.
  move=> lK; have := z_le' l lK.
  by rewrite normf_div (gtr0_norm (e_gt0 l lK)) ler_pdivr_mulr ?e_gt0.
rewrite normf_div (gtr0_norm (e_gt0 i iK)) mulrA ltr_pdivr_mulr ?e_gt0 //.

pose f c := toR (unit_at c) * z i - \sum_(l <- K) Y i l * row_at_corner c l.+1.
have f_lt c : c \in cs -> `|f c| < toR (unit_at c) * (b * eps i).
  move=> Hc; rewrite mulrCA.
  exact: le_lt_trans (row_bound_at Hc lt_i z_le) (row_contracts Hc lt_i lt_b).
have sum_f : total * z i = \sum_(c <- cs) weight c * f c.
  under eq_bigr do rewrite mulrBr mulrA.
  rewrite sumrB combined_corners [X in _ - X]sum_zero ?subr0 ?mulr_suml // => l.
  by rewrite mem_iota add0n => /= lt_l; rewrite null // mulr0.
rewrite -mulrA -{1}(gtr0_norm total_gt0) -normrM sum_f; apply: le_lt_trans (sum_norm _ _) _.
rewrite /total mulr_suml -subr_gt0 -sumrB; apply: sum_gt0 => [c Hc|].
  by rewrite subr_ge0 normrM ger0_norm ?weight0 // -mulrA ler_wpmul2l ?weight0 // ltW ?f_lt.
have [c Hc w_gt0] := weight_gt0; exists c => //.
by rewrite subr_gt0 normrM gtr0_norm // -mulrA ltr_pmul2l // f_lt.
Qed.

(* A row G near p, applied to x. *)
Lemma row_slack_sound (G : nat -> R) (p r : seq Z) :
  (forall j, j \in J -> `|G j - toR (nth 0%Z p j)| <= toR (nth 0%Z r j)) ->
  `|\sum_(j <- J) G j * x j - a * toR (against_right m w p)| <= a * toR (row_slack m w p r).
Proof.
move=> nearG; rewrite row_of_null addrAC -mulrBr /row_slack [toR (_ + _)%Z]toRD.
rewrite [a * (_ + toR (off_pivot _ _ _ _ _ _))]mulrDr.
apply: le_trans (ler_norm_add _ _) _; apply: ler_add.
  rewrite normrM ger0_norm // ler_wpmul2l // /against_right /against_radius !toR_sum -sumrB.
  apply: le_trans (sum_norm _ _) _; apply: sum_le => j Hj.
  by rewrite !toRM toR_abs -mulrBl normrM ler_wpmul2r // nearG.
have zero_unit j : unit_entry 0 0 j = 0%Z by rewrite /unit_entry; case: eqP.
rewrite -normrN -sumrN.
have -> : \sum_(j <- K) - (G j.+1 * z j) =
          \sum_(j <- K) (toR (unit_entry 0 0 j) - G j.+1) * z j.
  by apply: eq_bigr => j _; rewrite zero_unit toR0 sub0r mulNr.
exact: off_bound nearG near_null.
Qed.

Definition regular_side : R := if regular_minus w then -1 else 1.

Lemma sign_at_corner c : c \in cs -> regular_sign m w (M c) (Rd c) -> 0 < a ->
  0 < regular_side * (\sum_(i <- J) U i * row_at_corner c i).
Proof.
move=> Hc; rewrite /regular_sign.
set p := combine_rows _ (M c); set r := combine_rows _ (Rd c); set h := against_right m w p.
rewrite -(@toR_lt R) => lt_h a_gt0.
pose G j : R := \sum_(i <- J) U i * T c i j.
have nearG j : j \in J -> `|G j - toR (nth 0%Z p j)| <= toR (nth 0%Z r j).
  rewrite mem_iota add0n => /= lt_j; have [sM sR] := sizes Hc.
  by apply: (combine_near (regular_left w) (T := T c)) => // l lt_l; apply: near.
have := row_slack_sound nearG; rewrite (combined_rows (fun i => U i) c J id) -/G -/h.
set S := \sum_(j <- J) _; rewrite ler_distl => /andP[low high].
have : 0 < a * (toR (if regular_minus w then - h else h)%Z - toR (row_slack m w p r)).
  by rewrite mulr_gt0 // subr_gt0.
rewrite /regular_side; case: ifP => _ pos; apply: lt_le_trans pos _.
  by rewrite mulN1r toRN mulrBr mulrN ler_oppr opprB opprK addrC.
by rewrite mul1r mulrBr.
Qed.

(* The sign of the row of the pivot, where the other rows vanish. *)
Lemma sign_of_pivot_row : (forall c, c \in cs -> regular_sign m w (M c) (Rd c)) -> 0 < a ->
  0 < regular_side * (U 0%N * (\sum_(c <- cs) weight c * row_at_corner c 0)).
Proof.
move=> signs a_gt0.
have : 0 < \sum_(c <- cs) weight c *
    (regular_side * (\sum_(i <- J) U i * row_at_corner c i)).
  apply: sum_gt0 => [c Hc|]; first by rewrite mulr_ge0 ?weight0 // ltW ?sign_at_corner ?signs.
  have [c Hc w_gt0] := weight_gt0; exists c => //.
  by rewrite mulr_gt0 // sign_at_corner // signs.
under eq_bigr do rewrite mulrCA.
rewrite -mulr_sumr (combined_corners (fun i => U i) J id) sum_first [X in _ + X]sum_zero ?addr0 //.
by move=> i; rewrite mem_iota add0n => /= lt_i; rewrite null // mulr0.
Qed.

Theorem no_null_vector : (forall c, c \in cs -> regular_sign m w (M c) (Rd c)) -> 0 < a ->
  \sum_(c <- cs) weight c * row_at_corner c 0 = 0 -> False.
Proof. by move=> signs /(sign_of_pivot_row signs) + zero; rewrite zero !mulr0 ltxx. Qed.

End Corners.

Section BoxChecker.

Variables (P P' : enclosed) (r : region).

(* The moving variables, the pivot first. *)
Definition regular_order k : seq nat := k :: others P r k.

Definition restricted (l : seq nat) (f : nat -> nat -> Z) : matrix :=
  [seq [seq f i j | j <- l] | i <- l].

(* P and P' are the enclosed pencils at both ends of the interval of mu.  The corners 0 and 1 are
   those of P at both ends of the interval of t, 2 and 3 those of P'. *)
Definition corner_pencil (c : nat) := if (c < 2)%N then P else P'.
Definition corner_end (c : nat) := if odd c then upper r else lower r.

Definition corner_center l c := restricted l (center (corner_pencil c) (corner_end c)).
Definition corner_radius l c := restricted l (radius (corner_pencil c) (corner_end c)).

Definition rows_at l w c :=
  regular_rows (size l).-1 w (corner_center l c) (corner_radius l c)
    (nth 0%Z (regular_units w) c).

Definition sign_at l w c :=
  regular_sign (size l).-1 w (corner_center l c) (corner_radius l c).

Definition four_corners : seq nat := [:: 0; 1; 2; 3]%N.

Definition box_regular (w : regular) :=
  let l := regular_order (regular_pivot w) in
  [&& decided P r, regular_pivot w \in moving P r, (0 <? nth 0%Z (regular_right w) 0)%Z &
      all (fun c => rows_at l w c && sign_at l w c) four_corners].

End BoxChecker.

Lemma size_restricted l f : size (restricted l f) = size l.
Proof. exact: size_map. Qed.

Lemma entry_restricted l f i j : (i < size l)%N -> (j < size l)%N ->
  entry (restricted l f) i j = f (nth 0%N l i) (nth 0%N l j).
Proof. by move=> lt_i lt_j; rewrite /entry /restricted (nth_map 0%N) // (nth_map 0%N). Qed.

(* The matrix of a box at t and mu: f times that of the low end of mu and g times that of the high
   end, as a combination of the four corners. *)
Section BoxCorners.

Variable R : realFieldType.
Variables (P P' : enclosed) (A B A' B' : nat -> nat -> R).
Hypotheses (E : encloses P A B) (E' : encloses P' A' B') (same : size_of P' = size_of P).

Variables (r : region) (t f g : R).
Hypotheses (O : ordered (lower r) (upper r)) (W : between t (lower r) (upper r)).
Hypotheses (f0 : 0 <= f) (g0 : 0 <= g) (fg : 0 < f \/ 0 < g).

Definition mixed_at i j : R := f * T A B t i j + g * T A' B' t i j.

Definition matrix_at (c : nat) :=
  if (c < 2)%N then T_end A B (corner_end r c) else T_end A' B' (corner_end r c).

Lemma corner_near l c i j : (forall j, j \in l -> j \in indices P) ->
  (i < size l)%N -> (j < size l)%N ->
  `|matrix_at c (nth 0%N l i) (nth 0%N l j) - toR (entry (corner_center P P' r l c) i j)| <=
  toR (entry (corner_radius P P' r l c) i j).
Proof.
move=> sub lt_i lt_j; rewrite !entry_restricted //.
have Hi := sub _ (mem_nth 0%N lt_i); have Hj := sub _ (mem_nth 0%N lt_j).
have [p q p' q'] := ordered_ge0 R O.
have e1 : 0 <= toR (corner_end r c).1 :> R by rewrite /corner_end; case: odd.
have e2 : 0 <= toR (corner_end r c).2 :> R by rewrite /corner_end; case: odd.
rewrite /matrix_at /corner_pencil; case: ifP => _; first exact: T_end_enclosed.
by apply: T_end_enclosed => //; rewrite /indices same.
Qed.

(* Weights of the corners in cs. *)
Definition weights_of_corners (cs : seq nat) (weight : nat -> R) :=
  [/\ forall c, c \in cs -> 0 <= weight c, exists2 c, c \in cs & 0 < weight c &
      forall i j, mixed_at i j = \sum_(c <- cs) weight c * matrix_at c i j].

Lemma box_weights : exists weight, weights_of_corners four_corners weight.
Proof.
have [a [b [a0 b0 Tab [ab _]]]] := T_between A B O W.
have [a' [b' [a0' b0' Tab' [ab' _]]]] := T_between A' B' O W.
exists (nth 0 [:: f * a; f * b; g * a'; g * b']); split.
- by move=> c; rewrite !inE => /or4P[] /eqP->; apply: mulr_ge0.
- case: fg ab ab' => [f_gt0 [a_gt0|b_gt0] _|g_gt0 _ [a_gt0|b_gt0]].
  + by exists 0%N => //; apply: mulr_gt0.
  + by exists 1%N => //; apply: mulr_gt0.
  + by exists 2%N => //; apply: mulr_gt0.
  by exists 3%N => //; apply: mulr_gt0.
move=> i j; rewrite !big_cons big_nil addr0 /mixed_at Tab Tab' !mulrDr -!addrA !mulrA.
by [].
Qed.

Lemma lower_weights : toR (lower r).1 = t * toR (lower r).2 ->
  exists weight, weights_of_corners [:: 0; 2]%N weight.
Proof.
move=> at_t; have q0 : 0 < toR (lower r).2 :> R by case/and5P: O => _ ? _ _ _; rewrite toR_gt0.
have TE C D i j : T C D t i j = (toR (lower r).2)^-1 * T_end C D (lower r) i j :> R.
  by rewrite /T /T_end at_t; field; rewrite gt_eqF.
exists (nth 0 [:: f / toR (lower r).2; 0; g / toR (lower r).2; 0]); split.
- by move=> c; rewrite !inE => /orP[] /eqP->; rewrite divr_ge0 // ltW.
- case: fg => [f_gt0|g_gt0]; first by exists 0%N => //; apply: divr_gt0.
  by exists 2%N => //; apply: divr_gt0.
by move=> i j; rewrite !big_cons big_nil addr0 /mixed_at !TE !mulrA.
Qed.

Lemma upper_weights : (0 <? (upper r).2)%Z -> toR (upper r).1 = t * toR (upper r).2 ->
  exists weight, weights_of_corners [:: 1; 3]%N weight.
Proof.
move=> finite at_t; have q0 : 0 < toR (upper r).2 :> R by rewrite toR_gt0.
have TE C D i j : T C D t i j = (toR (upper r).2)^-1 * T_end C D (upper r) i j :> R.
  by rewrite /T /T_end at_t; field; rewrite gt_eqF.
exists (nth 0 [:: 0; f / toR (upper r).2; 0; g / toR (upper r).2]); split.
- by move=> c; rewrite !inE => /orP[] /eqP->; rewrite divr_ge0 // ltW.
- case: fg => [f_gt0|g_gt0]; first by exists 1%N => //; apply: divr_gt0.
  by exists 3%N => //; apply: divr_gt0.
by move=> i j; rewrite !big_cons big_nil addr0 /mixed_at !TE !mulrA.
Qed.

(* A row of the combination is that of the corners. *)
Lemma row_of_corners cs weight (x : nat -> R) (J : seq nat) (at_place : nat -> nat) i :
  weights_of_corners cs weight ->
  \sum_(j <- J) mixed_at i (at_place j) * x j =
  \sum_(c <- cs) weight c * (\sum_(j <- J) matrix_at c i (at_place j) * x j).
Proof.
case=> _ _ mixedE; under eq_bigr do rewrite mixedE mulr_suml.
rewrite exchange_big /=; apply: eq_bigr => c _; rewrite mulr_sumr.
by apply: eq_bigr => j _; rewrite mulrA.
Qed.

End BoxCorners.

(* The order of the moving variables. *)
Section Order.

Variables (R : realFieldType) (P : enclosed) (r : region) (k : nat).
Hypothesis k_J : k \in moving P r.

Notation l := (regular_order P r k).

Lemma order_moving j : j \in l -> j \in moving P r.
Proof. by rewrite inE mem_filter => /orP[/eqP->|/andP[]]. Qed.

Lemma order_indices j : j \in l -> j \in indices P.
Proof. by move=> /order_moving; rewrite mem_filter => /andP[]. Qed.

Lemma size_order : size l = (size l).-1.+1.
Proof. by []. Qed.

(* A sum over the moving variables, by places. *)
Lemma sum_order (f : nat -> R) :
  \sum_(j <- moving P r) f j = \sum_(j <- iota 0 (size l)) f (nth 0%N l j).
Proof.
have K_J j : (j \in others P r k) = (j \in moving P r) && (j != k) by rewrite mem_filter andbC.
have uJ : uniq (moving P r) by rewrite filter_uniq ?iota_uniq.
have uK : uniq (others P r k) by rewrite filter_uniq.
rewrite (sum_pivot K_J k_J uJ uK) -(big_cons _ _ k _ xpredT f).
by rewrite (big_nth 0%N) /index_iota subn0.
Qed.

(* The same over all variables, if those at rest are 0. *)
Lemma sum_decided (f x : nat -> R) : decided P r ->
  (forall j, j \in indices P -> ~~ is_moving (state_of r j) -> x j = 0) ->
  \sum_(j <- indices P) f j * x j = \sum_(j <- moving P r) f j * x j.
Proof.
by move=> _ rest; apply: sum_support => j Hj /(rest j Hj)->; rewrite mulr0.
Qed.

End Order.

Section BoxSound.

Variable R : realFieldType.
Variables (P P' : enclosed) (A B A' B' : nat -> nat -> R).
Hypotheses (E : encloses P A B) (E' : encloses P' A' B') (same : size_of P' = size_of P).

Variables (r : region) (t a b : R) (x : nat -> R).
Hypotheses (O : ordered (lower r) (upper r)) (W : between t (lower r) (upper r)).
Hypothesis ag : agrees (size_of P) r x.
Hypotheses (a0 : 0 <= a) (b0 : 0 <= b) (ab : 0 < a \/ 0 < b).
Hypothesis sol : box_solution P P' A B A' B' t a b x.

Variable w : regular.
Hypothesis checked : box_regular P P' r w.

Notation k := (regular_pivot w).
Notation l := (regular_order P r k).

Lemma moving_row i : i \in moving P r ->
  \sum_(j <- iota 0 (size l)) mixed_at A B A' B' t a b i (nth 0%N l j) * x (nth 0%N l j) = 0.
Proof.
case/and4P: checked => dec k_J _ _; have [_ compl] := sol.
rewrite mem_filter => /andP[mv Hi]; have [_ _ xy] := compl _ Hi.
have x_gt0 : 0 < x i by have := agrees_at ag Hi; move: mv; case: (state_of r i).
have zero : box_image P P' A B A' B' t a b x i = 0.
  by move/eqP: xy; rewrite mulf_eq0 gt_eqF // => /eqP.
rewrite -[RHS]zero -(sum_order k_J (fun j => mixed_at A B A' B' t a b i j * x j)).
rewrite -sum_decided // => [|j Hj still]; last first.
  have := allP dec j Hj; have := agrees_at ag Hj; move: still.
  by case: (state_of r j).
rewrite /box_image /image (same_indices same) !mulr_sumr -big_split; apply: eq_bigr => j _.
by rewrite /mixed_at mulrDl !mulrA.
Qed.

Theorem box_regular_sound : False.
Proof.
case/and4P: (checked) => dec k_J v_gt0 /allP corners.
have [weight [weight0 weight_gt0 mixedE]] := box_weights A B A' B' O W a0 b0 ab.
have corner_row i : (i < size l)%N -> \sum_(c <- four_corners) weight c *
    (\sum_(j <- iota 0 (size l)) matrix_at A B A' B' r c (nth 0%N l i) (nth 0%N l j) *
       x (nth 0%N l j)) = 0.
  move=> lt_i; have ws := And3 weight0 weight_gt0 mixedE.
  rewrite -(row_of_corners (fun j => x (nth 0%N l j)) _ _ _ ws).
  by apply/moving_row/(order_moving k_J)/mem_nth.
have V0 : 0 < toR (nth 0%Z (regular_right w) 0) :> R by rewrite toR_gt0.
have x0 : 0 < x k.
  by move: k_J; rewrite mem_filter => /andP[mv Hk]; have := agrees_at ag Hk; move: mv;
     case: (state_of r k).
refine (@no_null_vector R (size l).-1 w four_corners (corner_center P P' r l)
  (corner_radius P P' r l) (fun c => nth 0%Z (regular_units w) c)
  (fun c i j => matrix_at A B A' B' r c (nth 0%N l i) (nth 0%N l j)) weight
  (fun j => x (nth 0%N l j)) _ _ _ weight0 weight_gt0 _
  (x k / toR (nth 0%Z (regular_right w) 0)) _ _ _ _ _).
- by move=> c _; rewrite !size_restricted.
- move=> c i j _ lt_i lt_j; apply: corner_near => // j'; exact: order_indices.
- by move=> c /corners/andP[].
- by move=> i lt_i; apply: corner_row.
- by rewrite divr_ge0 // ltW.
- by rewrite divfK ?gt_eqF.
- by move=> c /corners/andP[].
- exact: divr_gt0.
exact: corner_row.
Qed.

End BoxSound.
