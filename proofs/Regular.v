(* The leaf `regular`: a decided box whose matrix has no null vector.

   In a decided box every variable rests or moves.  J is the list of the moving ones, k (the pivot)
   one of them and the first of J, K the others, m their number.  A solution of the box has
   sum_(j in J) T_ij x_j = 0 for every i in J, and x_k > 0.

   T is a combination of the matrices T_c of the corners of the box, with weights that are not
   negative and not all 0.  The checker has integer matrices M_c and R_c, |T_c - M_c| <= R_c, and
   the witness: integer vectors U and V over J, V_k > 0, an integer matrix Y over K, a unit u_c > 0
   for each corner, an integer eps and a sign s.  It asks for each corner that

     1. for each row i in K, with the radii included,
            d_i = sum_(j in K) |u_c I - Y M_c|_ij < u_c   and   d_i eps + |(Y M_c V)_i| <= u_c eps;
     2. s h_c > g_c + P_c eps, where h_c = U' M_c V, g_c = |U|' R_c |V| and P_c is the sum over K of
        the absolute values of U' M_c, radii included.

   Let a = x_k / V_k and z = x - a V, which vanishes at k.  By 1 |z_j| <= a eps ([near_null]).  For
   each corner then s U' T_c x >= a (s h_c - g_c - P_c eps) > 0 ([sign_at_corner]); but the
   combination of the T_c x is 0.  So there is no such x ([no_null_vector]), and the box has no
   solution ([box_regular_sound]).

   Each corner has a unit of its own, so the ends of the interval need no common denominator and one
   of them may be at infinity.  The page asks that the largest P_c times the largest eps is less
   than s h_c - g_c; 2 follows from it.

   Page: spec/certificates.md, 5.18.  Rust: crates/check/src/cover/critical.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Root RootLeaf Claim Series Boxes.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

(* U and V begin with the component at the pivot; rows and columns of Y are those of K. *)
Record regular := Regular {
  regular_pivot : nat;
  regular_inverse : matrix;
  regular_units : seq Z;
  regular_left : seq Z;
  regular_right : seq Z;
  regular_width : Z;
  regular_minus : bool }.

Section Checker.

Local Open Scope Z_scope.

(* The sum of the rows, each times a number. *)
Definition combine_rows (c : seq Z) (rows : matrix) : seq Z :=
  foldr (fun e sum => add_poly (scale_poly e.1 e.2) sum) [::] (zip c rows).

Variables (m : nat) (w : regular).

Notation eps := (regular_width w).

(* p'V and the sum over K of |p_j| + r_j. *)
Definition against_right (p : seq Z) :=
  sumZ (iota 0 m.+1) (fun j => nth 0 p j * nth 0 (regular_right w) j).
Definition against_radius (r : seq Z) :=
  sumZ (iota 0 m.+1) (fun j => nth 0 r j * Z.abs (nth 0 (regular_right w) j)).
Definition off_pivot (u : Z) (i : nat) (p r : seq Z) :=
  sumZ (iota 0 m) (fun j => Z.abs (unit_entry u i j - nth 0 p j.+1) + nth 0 r j.+1).

Definition regular_row (M Rd : matrix) (u : Z) (i : nat) :=
  let y := nth [::] (regular_inverse w) i in
  let p := combine_rows y (behead M) in
  let r := combine_rows [seq Z.abs c | c <- y] (behead Rd) in
  contracts u eps (off_pivot u i p r) (Z.abs (against_right p) + against_radius r).

Definition regular_sign (M Rd : matrix) :=
  let p := combine_rows (regular_left w) M in
  let r := combine_rows [seq Z.abs c | c <- regular_left w] Rd in
  let h := against_right p in
  against_radius r + off_pivot 0 0 p r * eps <? (if regular_minus w then - h else h).

Definition regular_corner (M Rd : matrix) (u : Z) :=
  [&& 0 <? u, all (regular_row M Rd u) (iota 0 m) & regular_sign M Rd].

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
Notation eps := (toR (regular_width w) : R).

Hypothesis sizes : forall c, c \in cs -> size (M c) = m.+1 /\ size (Rd c) = m.+1.
Hypothesis near : forall c i j, c \in cs -> (i < m.+1)%N -> (j < m.+1)%N ->
  `|T c i j - toR (entry (M c) i j)| <= toR (entry (Rd c) i j).
Hypothesis checked : forall c, c \in cs -> regular_corner m w (M c) (Rd c) (unit_at c).
Hypothesis weight0 : forall c, c \in cs -> 0 <= weight c.
Hypothesis weight_gt0 : exists2 c, c \in cs & 0 < weight c.
Hypothesis null : forall i, (i < m.+1)%N ->
  \sum_(c <- cs) weight c * (\sum_(j <- J) T c i j * x j) = 0.
Hypotheses (V_gt0 : 0 < V 0%N) (x_gt0 : 0 < x 0%N).

Let a : R := x 0%N / V 0%N.
Let z l : R := x l.+1 - a * V l.+1.

Lemma scale_of_null_gt0 : 0 < a.
Proof. exact: divr_gt0. Qed.

(* A row over J, applied to x = a V + z. *)
Lemma row_of_null (p : nat -> R) :
  \sum_(j <- J) p j * x j = a * (\sum_(j <- J) p j * V j) + \sum_(j <- K) p j.+1 * z j.
Proof.
rewrite !sum_first mulrDr mulr_sumr -addrA -big_split /=; congr (_ + _).
  by rewrite mulrCA /a divfK // gt_eqF.
by apply: eq_bigr => j _; rewrite /z; ring.
Qed.

(* A combination of the rows in l. *)
Lemma combined_rows (f : nat -> R) c (l : seq nat) (g : nat -> nat) :
  \sum_(i <- l) f i * (\sum_(j <- J) T c (g i) j * x j) =
  \sum_(j <- J) (\sum_(i <- l) f i * T c (g i) j) * x j.
Proof.
under eq_bigr do rewrite mulr_sumr.
rewrite exchange_big; apply: eq_bigr => j _; rewrite mulr_suml.
by apply: eq_bigr => i _; rewrite mulrA.
Qed.

Lemma combined_null (f : nat -> R) (l : seq nat) (g : nat -> nat) :
  (forall i, i \in l -> (g i < m.+1)%N) ->
  \sum_(c <- cs) weight c * (\sum_(i <- l) f i * (\sum_(j <- J) T c (g i) j * x j)) = 0.
Proof.
move=> lt_g; under eq_bigr do rewrite mulr_sumr.
rewrite exchange_big /=; apply: sum_zero => i il.
under eq_bigr do rewrite mulrCA.
by rewrite -mulr_sumr null ?mulr0 // lt_g.
Qed.

Section Row.

Variables (c i : nat).
Hypotheses (cs_c : c \in cs) (lt_i : (i < m)%N).

Let y := nth [::] (regular_inverse w) i.
Let p := combine_rows y (behead (M c)).
Let r := combine_rows [seq Z.abs e | e <- y] (behead (Rd c)).
Let G j : R := \sum_(l <- K) Y i l * T c l.+1 j.
Let u := unit_at c.
Let d := off_pivot m u i p r.
Let res := (Z.abs (against_right m w p) + against_radius m w r)%Z.

Lemma row_near j : j \in J -> `|G j - toR (nth 0%Z p j)| <= toR (nth 0%Z r j).
Proof.
rewrite mem_iota add0n => /= lt_j; have [sM sR] := sizes cs_c.
apply: (combine_near y (T := fun l j => T c l.+1 j)) => [||l lt_l]; rewrite ?size_behead ?sM ?sR //.
by rewrite /entry !nth_behead; apply: near.
Qed.

Lemma row_bound_at Z : (forall l, l \in K -> `|z l| <= Z) ->
  `|toR u * z i - \sum_(l <- K) Y i l * (\sum_(j <- J) T c l.+1 j * x j)| <=
  toR d * Z + a * toR res.
Proof.
move=> z_le; rewrite combined_rows row_of_null.
have iK : i \in K by rewrite mem_iota.
have -> : toR u * z i - (a * (\sum_(j <- J) G j * V j) + \sum_(j <- K) G j.+1 * z j) =
    \sum_(j <- K) (toR (unit_entry u i j) - G j.+1) * z j - a * (\sum_(j <- J) G j * V j).
  under [X in _ = X - _]eq_bigr do rewrite mulrBl.
  by rewrite sumrB (sum_unit _ _ (iota_uniq 0 m) iK) opprD addrA addrAC.
apply: le_trans (ler_norm_sub _ _) _; apply: ler_add.
  apply: (row_bound (G := fun j => nth 0%Z p j.+1) (r := fun j => nth 0%Z r j.+1)) z_le => j.
  by rewrite mem_iota add0n => /= lt_j; apply: row_near; rewrite mem_iota.
rewrite normrM gtr0_norm ?scale_of_null_gt0 // ler_pmul2l ?scale_of_null_gt0 //.
exact: (constant_bound (G := nth 0%Z p) (r := nth 0%Z r)) row_near.
Qed.

Lemma row_contracts Z : a * eps < Z -> toR d * Z + a * toR res < toR u * Z.
Proof.
move=> lt_Z; have /and3P[_ /allP rows _] := checked cs_c.
have := rows i; rewrite mem_iota => /(_ lt_i)/andP[lt le].
move: lt le; rewrite -(@toR_lt R) -(@toR_le R) toRD !toRM -/d -/res => lt le.
rewrite -subr_gt0 (_ : _ - _ = (toR u - toR d) * (Z - a * eps) +
  a * (toR u * eps - (toR d * eps + toR res))); last by ring.
apply: ltr_paddr; last by apply: mulr_gt0; rewrite subr_gt0.
by apply: mulr_ge0; rewrite ?subr_ge0 // ltW ?scale_of_null_gt0.
Qed.

End Row.

(* x is near a multiple of V. *)
Lemma near_null l : l \in K -> `|z l| <= a * eps.
Proof.
pose total := \sum_(c <- cs) weight c * toR (unit_at c).
have unit_gt0 c : c \in cs -> 0 < toR (unit_at c) :> R.
  by move=> /checked/and3P[u0 _ _]; rewrite toR_gt0.
have total_gt0 : 0 < total.
  apply: sum_gt0 => [c Hc|]; first by rewrite mulr_ge0 ?weight0 // ltW ?unit_gt0.
  by have [c Hc w_gt0] := weight_gt0; exists c => //; rewrite mulr_gt0 ?unit_gt0.
apply: (contraction total_gt0) => Z lt_Z z_le i; rewrite mem_iota add0n => /= lt_i.
pose f c := toR (unit_at c) * z i - \sum_(l <- K) Y i l * (\sum_(j <- J) T c l.+1 j * x j).
have f_lt c : c \in cs -> `|f c| < toR (unit_at c) * Z.
  by move=> Hc; apply: le_lt_trans (row_bound_at Hc lt_i z_le) (row_contracts Hc lt_i lt_Z).
have sum_f : total * z i = \sum_(c <- cs) weight c * f c.
  under eq_bigr do rewrite mulrBr mulrA.
  rewrite sumrB combined_null ?subr0 ?mulr_suml // => l'.
  by rewrite mem_iota add0n.
rewrite -{1}(gtr0_norm total_gt0) -normrM sum_f; apply: le_lt_trans (sum_norm _ _) _.
rewrite /total mulr_suml -subr_gt0 -sumrB; apply: sum_gt0 => [c Hc|].
  by rewrite subr_ge0 normrM ger0_norm ?weight0 // -mulrA ler_wpmul2l ?weight0 // ltW ?f_lt.
have [c Hc w_gt0] := weight_gt0; exists c => //.
by rewrite subr_gt0 normrM gtr0_norm // -mulrA ltr_pmul2l // f_lt.
Qed.

Let s : R := if regular_minus w then -1 else 1.

Lemma sign_at_corner c : c \in cs ->
  0 < s * (\sum_(i <- J) U i * (\sum_(j <- J) T c i j * x j)).
Proof.
move=> Hc; have /and3P[_ _] := checked Hc; rewrite /regular_sign.
set p := combine_rows _ (M c); set r := combine_rows _ (Rd c); set h := against_right m w p.
rewrite -(@toR_lt R) toRD toRM => lt_h.
pose G j : R := \sum_(i <- J) U i * T c i j.
have nearG j : j \in J -> `|G j - toR (nth 0%Z p j)| <= toR (nth 0%Z r j).
  rewrite mem_iota add0n => /= lt_j; have [sM sR] := sizes Hc.
  by apply: (combine_near (regular_left w) (T := T c)) => // l lt_l; apply: near.

rewrite (combined_rows (fun i => U i) c J id) row_of_null -/G mulrDr.
have zero_unit j : unit_entry 0 0 j = 0%Z by rewrite /unit_entry; case: eqP.
have off : `|\sum_(j <- K) G j.+1 * z j| <= toR (off_pivot m 0 0 p r) * (a * eps).
  rewrite -normrN -sumrN.
  have -> : \sum_(j <- K) - (G j.+1 * z j) =
            \sum_(j <- K) (toR (unit_entry 0 0 j) - G j.+1) * z j.
    by apply: eq_bigr => j _; rewrite zero_unit toR0 sub0r mulNr.
  apply: (row_bound (G := fun j => nth 0%Z p j.+1) (r := fun j => nth 0%Z r j.+1)) near_null => j.
  by rewrite mem_iota add0n => /= lt_j; apply: nearG; rewrite mem_iota.
have at_v : `|\sum_(j <- J) G j * V j - toR h| <= toR (against_radius m w r).
  rewrite /h /against_right /against_radius !toR_sum -sumrB.
  apply: le_trans (sum_norm _ _) _; apply: sum_le => j Hj.
  by rewrite !toRM toR_abs -mulrBl normrM ler_wpmul2r // nearG.

have s1 : `|s| = 1 by rewrite /s; case: ifP; rewrite ?normrN normr1.
have sh : s * toR h = toR (if regular_minus w then - h else h)%Z.
  by rewrite /s; case: ifP => _; rewrite ?toRN ?mulN1r ?mul1r.
have at_least (e b : R) : `|e| <= b -> - b <= s * e.
  move=> le; apply: (@le_trans _ _ (- `|e|)); first by rewrite ler_opp2.
  by rewrite ler_oppl (le_trans (ler_norm _)) // normrN normrM s1 mul1r.
have a0 := scale_of_null_gt0.
have low_off := at_least _ _ off; have low_v := at_least _ _ at_v.
have pos : 0 < a * (s * toR h - (toR (against_radius m w r) + toR (off_pivot m 0 0 p r) * eps)).
  by rewrite mulr_gt0 // subr_gt0 sh.
apply: lt_le_trans pos _.
have -> : s * (a * (\sum_(j <- J) G j * V j)) + s * (\sum_(j <- K) G j.+1 * z j) =
    a * (s * toR h + s * (\sum_(j <- J) G j * V j - toR h)) + s * (\sum_(j <- K) G j.+1 * z j).
  by congr (_ + _); move: (\sum_(j <- J) _) (toR h) => *; ring.
have -> : a * (s * toR h - (toR (against_radius m w r) + toR (off_pivot m 0 0 p r) * eps)) =
    a * (s * toR h + - toR (against_radius m w r)) + - (toR (off_pivot m 0 0 p r) * (a * eps)).
  by move: (toR h) (toR (against_radius _ _ _)) (toR (off_pivot _ _ _ _ _)) => *; ring.
by rewrite ler_add // ler_wpmul2l ?ler_add2l // ltW.
Qed.

Theorem no_null_vector : False.
Proof.
pose f c := s * (\sum_(i <- J) U i * (\sum_(j <- J) T c i j * x j)).
have : 0 < \sum_(c <- cs) weight c * f c.
  apply: sum_gt0 => [c Hc|]; first by rewrite mulr_ge0 ?weight0 // ltW ?sign_at_corner.
  by have [c Hc w_gt0] := weight_gt0; exists c => //; rewrite mulr_gt0 ?sign_at_corner.
under eq_bigr do rewrite mulrCA.
by rewrite -mulr_sumr (@combined_null (fun i => U i) J id) ?mulr0 ?ltxx // => i; rewrite mem_iota.
Qed.

End Corners.

Section BoxChecker.

Variables (P P' : enclosed) (r : region) (w : regular).

(* The moving variables, the pivot first. *)
Definition regular_order : seq nat := regular_pivot w :: others P r (regular_pivot w).

Definition restricted (l : seq nat) (f : nat -> nat -> Z) : matrix :=
  [seq [seq f i j | j <- l] | i <- l].

Definition box_corner (Q : enclosed) (l : seq nat) (e : point) (n : nat) :=
  regular_corner (size l).-1 w (restricted l (center Q e)) (restricted l (radius Q e))
    (nth 0%Z (regular_units w) n).

(* P and P' are the enclosed pencils at both ends of the interval of mu. *)
Definition box_regular :=
  let l := regular_order in
  [&& decided P r, regular_pivot w \in moving P r, (0 <? nth 0%Z (regular_right w) 0)%Z &
      [&& box_corner P l (lower r) 0, box_corner P l (upper r) 1,
          box_corner P' l (lower r) 2 & box_corner P' l (upper r) 3]].

End BoxChecker.

Lemma size_restricted l f : size (restricted l f) = size l.
Proof. exact: size_map. Qed.

Lemma entry_restricted l f i j : (i < size l)%N -> (j < size l)%N ->
  entry (restricted l f) i j = f (nth 0%N l i) (nth 0%N l j).
Proof. by move=> lt_i lt_j; rewrite /entry /restricted (nth_map 0%N) // (nth_map 0%N). Qed.

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
Notation l := (regular_order P r w).
Notation at_place i := (nth 0%N l i).

Lemma order_moving j : j \in l -> j \in indices P /\ is_moving (state_of r j).
Proof.
case/and4P: checked => _ k_J _ _ Hj; suff: j \in moving P r by rewrite mem_filter => /andP[].
by move: Hj; rewrite inE mem_filter => /orP[/eqP->|/andP[]].
Qed.

Lemma sum_order (f : nat -> R) :
  \sum_(j <- indices P) f j * x j = \sum_(j <- iota 0 (size l)) f (at_place j) * x (at_place j).
Proof.
case/and4P: checked => /allP dec k_J _ _.
have K_J j : (j \in others P r k) = (j \in moving P r) && (j != k) by rewrite mem_filter andbC.
have uJ : uniq (moving P r) by rewrite filter_uniq ?iota_uniq.
have uK : uniq (others P r k) by rewrite filter_uniq.
transitivity (\sum_(j <- moving P r) f j * x j).
  rewrite big_filter [RHS]big_mkcond big_seq [RHS]big_seq; apply: eq_bigr => j Hj.
  have := dec j Hj; have := agrees_at ag Hj; case: (state_of r j) => //= -> _.
  by rewrite mulr0.
rewrite (sum_pivot K_J k_J uJ uK) -(big_cons _ _ k _ xpredT (fun j => f j * x j)).
by rewrite (big_nth 0%N) /index_iota subn0.
Qed.

Lemma image_order (Q : enclosed) (C D : nat -> nat -> R) f g i : size_of Q = size_of P ->
  (forall i j, T C D t i j = f * T_end C D (lower r) i j + g * T_end C D (upper r) i j) ->
  image Q C D t x i =
  f * (\sum_(j <- iota 0 (size l)) T_end C D (lower r) i (at_place j) * x (at_place j)) +
  g * (\sum_(j <- iota 0 (size l)) T_end C D (upper r) i (at_place j) * x (at_place j)).
Proof.
move=> sQ Tab; rewrite /image /indices sQ sum_order !mulr_sumr -big_split.
by apply: eq_bigr => j _; rewrite Tab mulrDl !mulrA.
Qed.

Theorem box_regular_sound : False.
Proof.
case/and4P: (checked) => _ k_J v_gt0 /and4P[c0 c1 c2 c3].
have [f [g [f0 g0 Tab [fg _]]]] := T_between A B O W.
have [f' [g' [f0' g0' Tab' [fg' _]]]] := T_between A' B' O W.
have [p q p' q'] := ordered_ge0 R O; have [_ compl] := sol.
pose pencil c := if (c < 2)%N then P else P'.
pose e c := if odd c then upper r else lower r.
pose matrix_at c := if (c < 2)%N then T_end A B (e c) else T_end A' B' (e c).
pose weight c := nth 0 [:: a * f; a * g; b * f'; b * g'] c.
have e1 c : 0 <= toR (e c).1 :> R by rewrite /e; case: odd.
have e2 c : 0 <= toR (e c).2 :> R by rewrite /e; case: odd.
have four (h : nat -> R) :
    \sum_(c <- [:: 0; 1; 2; 3]%N) h c = h 0%N + (h 1%N + (h 2%N + h 3%N)).
  by rewrite !big_cons big_nil addr0.
have sl : size l = (size l).-1.+1 by [].
apply: (@no_null_vector R (size l).-1 w [:: 0; 1; 2; 3]%N
  (fun c => restricted l (center (pencil c) (e c))) (fun c => restricted l (radius (pencil c) (e c)))
  (fun c => nth 0%Z (regular_units w) c)
  (fun c i j => matrix_at c (at_place i) (at_place j)) weight (fun j => x (at_place j))).
- by move=> c _; rewrite !size_restricted.
- move=> c i j _; rewrite -sl => lt_i lt_j; rewrite !entry_restricted //.
  have [Hi _] := order_moving (mem_nth 0%N lt_i); have [Hj _] := order_moving (mem_nth 0%N lt_j).
  rewrite /matrix_at /pencil; case: ifP => _; first exact: T_end_enclosed.
  by apply: T_end_enclosed => //; rewrite /indices same.
- by move=> c; rewrite !inE => /or4P[] /eqP->.
- by move=> c; rewrite !inE => /or4P[] /eqP->; apply: mulr_ge0.
- case: ab fg fg' => [a_gt0 [f_gt0|g_gt0] _|b_gt0 _ [f_gt0|g_gt0]].
  + by exists 0%N => //; apply: mulr_gt0.
  + by exists 1%N => //; apply: mulr_gt0.
  + by exists 2%N => //; apply: mulr_gt0.
  by exists 3%N => //; apply: mulr_gt0.
- move=> i; rewrite -sl => lt_i.
  have [Hi mv] := order_moving (mem_nth 0%N lt_i).
  have [_ _ xy] := compl _ Hi; have := agrees_at ag Hi.
  move: mv xy; case: (state_of r _) => // _ xy xi_gt0.
  have {xy} : box_image P P' A B A' B' t a b x (at_place i) = 0.
    by move/eqP: xy; rewrite mulf_eq0 gt_eqF // => /eqP.
  rewrite /box_image (image_order _ (erefl _) Tab) (image_order _ same Tab') => zero.
  by rewrite -[RHS]zero four !mulrDr -!addrA !mulrA.
- by rewrite toR_gt0.
move: k_J; rewrite mem_filter => /andP[mv Hk].
by have := agrees_at ag Hk; move: mv; case: (state_of r k).
Qed.

End BoxSound.
