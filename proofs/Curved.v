(* Regions of a family T(t) that is not linear in t.

   The condensed matrix T(t) of a pencil whose free rows depend on t is a quotient of polynomials.
   Over one region it is known by an enclosed pencil P of the kind of Enclosed.v, in two ways:

   - *near a line*: for each t there is a pencil A + t B that P encloses with T(t) = A + t B;
   - *near chords*: for each two t and t' there is a pencil A + t B that P encloses, with
     T(t) = A + t B and T(t') = A + t' B.

   Near a line is enough for every leaf that excludes: a solution of T at t is one of A + t B, and
   the theorems about leaves hold for all A and B that P encloses ([line_solution]).

   Theorem [curved_solution]: if T is near chords in a region, and f(t) T(t) is a matrix of
   polynomials with f(t) != 0, then a root leaf with the outcome "solution" that is checked for P
   has exactly one solution in the region.  Existence is that of Existence.v for f T; uniqueness is
   that of Root.v for the chord through both values.

   Page: spec/certificates.md, 5.7, 5.11, 5.14.
   Rust: crates/check/src/cover/family.rs, root.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Root Existence RootLeaf.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Section Curved.

Variable R : rcfType.
Variables (P : enclosed) (T : R -> nat -> nat -> R).

Definition family_image t (x : nat -> R) i := \sum_(j <- indices P) T t i j * x j.

Definition family_solves t (x : nat -> R) :=
  [/\ 0 <= t, exists2 i, i \in indices P & x i != 0 &
      forall i, i \in indices P ->
        [/\ 0 <= x i, 0 <= family_image t x i & x i * family_image t x i = 0]].

Definition on_pencil A B (t : R) := forall i j, i \in indices P -> j \in indices P ->
  T t i j = Enclosed.T A B t i j.

Definition near_line t := exists A B, encloses P A B /\ on_pencil A B t.

Definition near_chord t t' := exists A B, [/\ encloses P A B, on_pencil A B t & on_pencil A B t'].

Lemma chord_line t t' : near_chord t t' -> near_line t.
Proof. by case=> A [B [E on _]]; exists A, B. Qed.

Lemma pencil_solution A B t x : on_pencil A B t -> family_solves t x <-> solves P A B t x.
Proof.
move=> on; have imageE i : i \in indices P -> family_image t x i = image P A B t x i.
  by move=> Hi; apply: sum_eq => j Hj; rewrite on.
by split=> -[t0 nz rows]; split=> // i Hi; have := rows i Hi; rewrite imageE.
Qed.

Lemma line_solution t x : near_line t -> family_solves t x ->
  exists A B, encloses P A B /\ solves P A B t x.
Proof. by case=> A [B [E on]] /(pencil_solution x on) sol; exists A, B. Qed.

Section Solution.

Variables (r : region) (c : isolation).
Hypotheses (O : ordered (lower r) (upper r)) (D : decided P r).
Hypothesis checked : check_root P r c Solution.
Hypothesis chords : forall t t', between t (lower r) (upper r) -> between t' (lower r) (upper r) ->
  near_chord t t'.

Variables (f : {poly R}) (N : nat -> nat -> {poly R}).
Hypothesis f_regular : forall t, between t (lower r) (upper r) -> f.[t] != 0.
Hypothesis N_family : forall t i j, between t (lower r) (upper r) ->
  i \in indices P -> j \in indices P -> (N i j).[t] = f.[t] * T t i j.

Notation J := (moving P r).
Notation K := (others P r).
Notation k := (pivot c).
Notation v := (vector c).
Notation eps := (width (narrow_box c)).

Let L : isolated P r c.
Proof. by case/andP: checked. Qed.

Lemma inside (t : R) : between t (from_point c) (to_point c) -> between t (lower r) (upper r).
Proof. exact: (inside_region (R := R) O L (t := t)). Qed.

Lemma line_at (t : R) : between t (lower r) (upper r) -> near_line t.
Proof. by move=> bt; apply: (chord_line (chords bt bt)). Qed.

Definition family_row t (x : nat -> R) l := \sum_(j <- J) T t l j * x j.

Lemma pencil_row A B t x l : on_pencil A B t -> l \in J ->
  family_row t x l = row A B J t x l.
Proof.
by move=> on lJ; apply: sum_eq => j jJ; rewrite on //; apply: (moving_indices (r := r)).
Qed.

Lemma poly_rowE (t : R) x l : between t (lower r) (upper r) -> l \in J ->
  poly_row N J t x l = f.[t] * family_row t x l.
Proof.
move=> bt lJ; rewrite /poly_row mulr_sumr; apply: sum_eq => j jJ.
by rewrite /poly_at N_family // ?mulrA //; apply: (moving_indices (r := r)).
Qed.

Lemma family_exists : exists t x,
  [/\ between t (from_point c) (to_point c), boxed (K k) k v eps x &
      forall l, l \in J -> family_row t x l = 0].
Proof.
have [[kJ vk inside_c change] [_ narrow _]] := isolated_parts L.
case/and4P: inside_c => o to2 _ _; have [p q p' q'] := ordered_ge0 R o.
have vk0 : 0 < toR (nth 0%Z v k) :> R by rewrite toR_gt0.
have F2 : 0 < toR (from_point c).2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
have T2 : 0 < toR (to_point c).2 :> R by rewrite toR_gt0.
have eps0 : 0 <= toR eps :> R := eps_ge0 R L.
pose ta : R := toR (from_point c).1 / toR (from_point c).2.
pose tb : R := toR (to_point c).1 / toR (to_point c).2.

have betweenE t : ta <= t <= tb -> between t (from_point c) (to_point c).
  by rewrite /ta /tb ler_pdivr_mulr // ler_pdivl_mulr // => /andP[].
have tab : ta <= tb.
  rewrite /ta /tb ler_pdivr_mulr // mulrAC ler_pdivl_mulr // -!toRM toR_le.
  by case/and5P: o => _ _ _ _ /andP[].
have K_sub l : l \in K k -> l \in J by rewrite others_moving => /andP[].
have regular_f t : ta <= t <= tb -> f.[t] != 0 by move=> /betweenE/inside/f_regular.

(* Rows of f T that vanish. *)
have rows_T t x l : ta <= t <= tb -> l \in J -> poly_row N J t x l = 0 -> family_row t x l = 0.
  move=> tt lJ; rewrite poly_rowE //; last exact/inside/betweenE.
  by move/eqP; rewrite mulf_eq0 (negbTE (regular_f _ tt)) => /eqP.

(* Regular on K, and boxed. *)
have inj t : ta <= t <= tb -> injective_on (K k) (poly_at N t).
  move=> tt z rows; have bt := betweenE _ tt; have [A [B [E on]]] := line_at (inside bt).
  have [a [b [comb _]]] := combination_of_weights A B o bt.
  apply: (regular_sound E (@moving_indices P r) (@others_moving P r k) (uniq_others P r k)
            narrow comb p q p' q') => l lK.
  have : f.[t] * (\sum_(j <- K k) Enclosed.T A B t l j * z j) = 0.
    have Hl := moving_indices (K_sub _ lK).
    rewrite -[RHS](rows l lK) mulr_sumr; apply: sum_eq => j jK.
    have Hj := moving_indices (K_sub _ jK).
    by rewrite /poly_at (N_family (inside bt)) // on // mulrA.
  by move/eqP; rewrite mulf_eq0 (negbTE (regular_f _ tt)) => /eqP.
have boxed_at A B t x : encloses P A B -> on_pencil A B t -> ta <= t <= tb ->
    x k = toR (nth 0%Z v k) ->
    (forall l, l \in K k -> family_row t x l = 0) -> boxed (K k) k v eps x.
  move=> E on /betweenE bt xk rows; have [a [b [comb _]]] := combination_of_weights A B o bt.
  split=> //; apply: (box_sound E (@moving_indices P r) (@others_moving P r k) kJ
    (uniq_moving P r) (uniq_others P r k) narrow comb p q p' q' xk) => l lK.
  by rewrite -[RHS](rows l lK) (pencil_row _ on) //; apply: K_sub.

case/andP: change => uk change; have {}uk : 0 < toR (nth 0%Z (left_vector c) k) :> R.
  by rewrite toR_gt0.
have left_k A B e t x : on_pencil A B t -> 0 < toR e.2 :> R -> toR e.1 = t * toR e.2 ->
    (forall l, l \in K k -> family_row t x l = 0) ->
    left_at P A B r x e (left_vector c) =
      toR (nth 0%Z (left_vector c) k) * (toR e.2 * family_row t x k).
  move=> on e2 e1 rows; have rowE l : l \in J ->
      row_at P A B r x e l = toR e.2 * family_row t x l.
    move=> lJ; rewrite (pencil_row _ on) // /row_at /row mulr_sumr; apply: eq_bigr => j _.
    by rewrite /T_end e1 /Enclosed.T; move: (A _ _) (B _ _) (x _) => *; ring.
  rewrite /left_at (sum_pivot (@others_moving P r k) kJ (uniq_moving P r) (uniq_others P r k)).
  rewrite [X in _ + X]sum_zero ?addr0 => [|l lK]; first by rewrite rowE.
  by rewrite rowE ?K_sub // rows // !mulr0.

have [|t [x [tt xk rows]]] :=
    polynomial_null_vector (@others_moving P r k) kJ (uniq_moving P r) (uniq_others P r k) vk0
      tab inj.
  have at_a : ta <= ta <= tb by rewrite lexx.
  have at_b : ta <= tb <= tb by rewrite lexx andbT.
  move=> x y xk yk rows_x rows_y.
  have {}rows_x l : l \in K k -> family_row ta x l = 0.
    by move=> lK; apply: rows_T => //; [apply: K_sub | apply: rows_x].
  have {}rows_y l : l \in K k -> family_row tb y l = 0.
    by move=> lK; apply: rows_T => //; [apply: K_sub | apply: rows_y].
  have [A [B [E on]]] := line_at (inside (betweenE _ at_a)).
  have [A' [B' [E' on']]] := line_at (inside (betweenE _ at_b)).
  have bx := boxed_at _ _ _ _ E on at_a xk rows_x.
  have by_ := boxed_at _ _ _ _ E' on' at_b yk rows_y.
  have e1 : toR (from_point c).1 = ta * toR (from_point c).2.
    by rewrite /ta divfK // gt_eqF.
  have e2 : toR (to_point c).1 = tb * toR (to_point c).2 by rewrite /tb divfK // gt_eqF.
  have lx := left_k _ _ _ _ _ on F2 e1 rows_x; have ly := left_k _ _ _ _ _ on' T2 e2 rows_y.
  rewrite !poly_rowE //; try exact/inside/betweenE.

  (* f has the same sign at both points. *)
  have f_same : 0 < f.[ta] * f.[tb].
    rewrite ltNge; apply/negP=> /(root_between tab)[t tt /rootP]; apply/eqP; exact: regular_f.
  rewrite mulrACA pmulr_rlt0 //.
  case/orP: change => /andP[s1 s2].
    have x_neg : family_row ta x k < 0.
      by have := left_negative_sound E kJ eps0 bx p q s1; rewrite lx !pmulr_rlt0.
    have y_pos : 0 < family_row tb y k.
      by have := left_positive_sound E' kJ eps0 by_ p' q' s2; rewrite ly !pmulr_rgt0.
    by rewrite nmulr_rlt0.
  have x_pos : 0 < family_row ta x k.
    by have := left_positive_sound E kJ eps0 bx p q s1; rewrite lx !pmulr_rgt0.
  have y_neg : family_row tb y k < 0.
    by have := left_negative_sound E' kJ eps0 by_ p' q' s2; rewrite ly !pmulr_rlt0.
  by rewrite pmulr_rlt0.

have {}rows l : l \in J -> family_row t x l = 0 by move=> lJ; apply: rows_T => //; apply: rows.
exists t, x; split=> //; first exact: betweenE.
have [A [B [E on]]] := line_at (inside (betweenE _ tt)).
by apply: (boxed_at A B t) => // l lK; apply/rows/K_sub.
Qed.

Theorem curved_solution :
  exists t x, [/\ between t (from_point c) (to_point c), family_solves t x, in_region_of P t x r &
    forall t' x', family_solves t' x' -> in_region_of P t' x' r ->
      t' = t /\ exists2 g, 0 < g & forall i, i \in indices P -> x' i = g * x i].
Proof.
have [[kJ vk /and4P[o to2 _ _] _] [wide _ uniq]] := isolated_parts L.
have [p q p' q'] := ordered_ge0 R o; have [P_ Q_ P' Q'] := ordered_ge0 R O.
have signs : solution_signs P r c by case/andP: checked.
case/andP: signs => /allP x_signs /allP y_signs.
have eps0 : 0 <= toR eps :> R := eps_ge0 R L.
have [t [x [bt bx rows]]] := family_exists.
pose s j := if j \in J then x j else 0.
have [A [B [E on]]] := line_at (inside bt).

have positive j : j \in J -> 0 < x j.
  move=> jJ; have [->|jk] := eqVneq j k; first by rewrite (proj1 bx) toR_gt0.
  have jK : j \in K k by rewrite others_moving jJ.
  have := (proj2 bx) _ jK; rewrite ler_distl => /andP[+ _]; apply: lt_le_trans.
  by rewrite subr_gt0 toR_lt; apply: x_signs.

have t0 : 0 <= t.
  have f2 : 0 < toR (from_point c).2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
  by rewrite -(pmulr_lge0 _ f2); apply: le_trans (proj1 bt).

have region_s : in_region_of P t s r.
  split; first exact: inside.
  move=> i lt_i; have Hi : i \in indices P by rewrite mem_iota.
  have iJ : (i \in J) = is_moving (state_of r i) by rewrite mem_filter Hi andbT.
  rewrite /s iJ; have := moving_or_resting D Hi; rewrite iJ.
  by have := positive i; rewrite iJ; case: (state_of r i) => //= h _; apply: h.

exists t, s; split=> //.
- apply/(pencil_solution s on); split=> //.
    by exists k; [apply: (moving_indices (r := r)) | rewrite /s kJ gt_eqF // positive].
  move=> i Hi; rewrite row_of_solution /s; have [iJ|iJ] := boolP (i \in J).
    by rewrite -/(row A B J t x i) -(pencil_row _ on) // rows // mulr0 lexx ltW // positive.
  rewrite mul0r lexx; split=> //; apply: ltW.
  have [a [b [comb _]]] := combination_of_weights A B o bt; have [a0 b0 ab _] := comb.
  rewrite (row_combination P r x i comb).
  have not_moving : is_moving (state_of r i) = false.
    by move: iJ; rewrite mem_filter Hi andbT => /negbTE.
  have := y_signs _ Hi; rewrite not_moving /= => /andP[y1 y2].
  apply: combination_gt0 => //; first exact: (row_positive_sound E kJ eps0 bx p q Hi y1).
  exact: (row_positive_sound E kJ eps0 bx p' q' Hi y2).

(* The chord through both values. *)
move=> t' x' sol' reg'; have [C [M [E' on1 on2]]] := chords (inside bt) (proj1 reg').
move/(pencil_solution x' on2): sol' => sol'.
have [f0 f0_gt0 [xk' null']] := scaled_solution D kJ vk sol' reg'.
have [a [b [comb one]]] := combination_of_weights C M O (inside bt).
have [a' [b' [comb' _]]] := combination_of_weights C M O (proj1 reg').
have bx' : boxed (K k) k v (width (wide_box c)) (fun j => f0 * x' j).
  split=> //; apply: (box_sound E' (@moving_indices P r) (@others_moving P r k) kJ
    (uniq_moving P r) (uniq_others P r k) wide comb' P_ Q_ P' Q' xk'); exact: null_rows_K.
have null l : l \in J -> \sum_(j <- J) Enclosed.T C M t l j * x j = 0.
  by move=> lJ; rewrite -[RHS](rows l lJ) (pencil_row _ on1).
have [tt xx] := unique_sound E' (@moving_indices P r) (@others_moving P r k) kJ (uniq_moving P r)
  (uniq_others P r k) uniq P_ Q_ P' Q' comb one bx' (proj1 bx) null null'.
split=> //; exists f0^-1 => [|i Hi]; first by rewrite invr_gt0.
rewrite /s; have [iJ|iJ] := boolP (i \in J).
  by rewrite xx // mulKf // gt_eqF.
by have [_ zero _] := solution_on_J D sol' reg'; rewrite zero // mulr0.
Qed.

End Solution.

End Curved.
