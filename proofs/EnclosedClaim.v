(* Enclosed solution claims: a solution in a box.

   A claim names a support and an interval of values.  Its certificate has a box for Krawczyk's
   test; what is checked here is a root leaf (RootLeaf.v) for the whole pencil, with the free
   variables and the support for the moving ones: T(t) without row and column of a pivot is regular
   on the interval, the determinant changes its sign between two points from < to, and the null
   vector lies in a box of integers.  The signs demanded of it are those of the support only:

       x_j > 0 for j in the support,    y_i > 0 for every other complementarity variable i.

   So the existence of a solution is a change of sign of a polynomial, which has a root over every
   real closed field, and no fixed point theorem is needed.  There is no condensation: B may have
   entries in the free rows, and the matrices are as large as the pencil.

   Theorem [enclosed_claim_sound]: if the claim is checked, then the pencil has a solution with this
   support, its value between from and to, and y_i > 0 off the support; and it is the only solution
   with this support and a value in the interval, up to a positive factor.

   Page: spec/certificates.md, 5.5.  Rust: crates/check/src/enclosed_solution.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Root Existence RootLeaf.
From Mceip Require Import Condensation Pencil Whole Complete Claim System.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Record enclosed_claim := EnclosedClaim {
  box_support : seq nat;
  interval_low : point;
  interval_high : point;
  null_box : isolation }.

Section Checker.

Variables (Q : pencil) (k : enclosed_claim).

Notation c := (null_box k).
Notation n := (order Q).

Definition dense (rows : nat -> sparse_row) : matrix :=
  [seq [seq lookup (rows i) j | j <- iota 0 n] | i <- iota 0 n].

(* The pencil without condensation: all variables, radii 0. *)
Definition whole_pencil := Enclosed n (dense (row_a Q)) (dense (row_b Q)) [::] [::].

Definition in_active_block i := (i \in free Q) || (i \in box_support k).

Definition active_region := Region (interval_low k) (interval_high k)
  [seq if in_active_block i then Moving else Resting | i <- iota 0 n].

Notation P := whole_pencil.
Notation r := active_region.

Definition positive_on_support j :=
  (j == pivot c) || (width (narrow_box c) <? nth 0 (vector c) j)%Z.

Definition positive_off_support i :=
  both_ends c (row_positive P r (pivot c) (vector c) (width (narrow_box c)) ^~ i).

Definition check_enclosed_claim :=
  [&& wellformed Q, ordered (interval_low k) (interval_high k), pivot c \in box_support k,
      all (fun i => i \in slip Q) (box_support k), isolated P r c,
      all positive_on_support (box_support k) &
      all (fun i => (i \in box_support k) || positive_off_support i) (slip Q)].

End Checker.

Section Sound.

Variables (R : rcfType) (Q : pencil) (k : enclosed_claim).
Hypothesis checked : check_enclosed_claim Q k.

Notation c := (null_box k).
Notation P := (whole_pencil Q).
Notation r := (active_region Q k).
Notation A := (a_entry R Q).
Notation B := (b_entry R Q).
Notation J := (moving P r).
Notation K := (others P r (pivot c)).
Notation V := (nth 0%Z (vector c)).
Notation eps := (width (narrow_box c)).
Notation variables := (iota 0 (order Q)).

Lemma claim_parts :
  [/\ wellformed Q, ordered (interval_low k) (interval_high k), pivot c \in box_support k &
      forall i, i \in box_support k -> i \in slip Q] /\
  [/\ isolated P r c, forall j, j \in box_support k -> positive_on_support k j &
      forall i, i \in slip Q -> i \notin box_support k -> positive_off_support Q k i].
Proof.
case/and5P: checked => wf o pv /allP sup /and3P[iso /allP on /allP off].
by split; split=> // i Hi /negbTE out; have := off _ Hi; rewrite /= out.
Qed.

Lemma dense_entry rows i j : i \in variables -> j \in variables ->
  entry (dense Q rows) i j = lookup (rows i) j.
Proof.
rewrite !mem_iota !add0n /= => lt_i lt_j; rewrite /entry /dense.
by rewrite (nth_map 0%N) ?size_iota // nth_iota // (nth_map 0%N) ?size_iota // nth_iota.
Qed.

Lemma encloses_whole : encloses P A B.
Proof.
move=> i j Hi Hj; rewrite /= !dense_entry // /entry !nth_nil !toR0.
by rewrite /a_entry /b_entry !subrr normr0.
Qed.

Lemma active_moving i : (i \in J) = (i \in variables) && in_active_block Q k i.
Proof.
rewrite mem_filter andbC; apply: andb_id2l; rewrite mem_iota add0n => /= lt_i.
by rewrite /state_of /= (nth_map 0%N) ?size_iota // nth_iota //; case: in_active_block.
Qed.

Lemma support_moving j : j \in box_support k -> j \in J.
Proof.
have [[_ _ _ sup] _] := claim_parts => j_s.
by rewrite active_moving /in_active_block j_s orbT andbT; apply/slip_indices/sup.
Qed.

Lemma free_moving i : i \in free Q -> i \in J.
Proof.
have [[wf _ _ _] _] := claim_parts => i_f.
by rewrite active_moving /in_active_block i_f andbT; apply: free_indices.
Qed.

Lemma slip_moving i : i \in slip Q -> (i \in J) = (i \in box_support k).
Proof.
move=> Hi; rewrite active_moving slip_indices //= /in_active_block.
by move: Hi; rewrite mem_filter => /andP[/negbTE->].
Qed.

(* x on the active variables, 0 elsewhere *)
Definition on_active (x : nat -> R) j := if j \in J then x j else 0.

Lemma reaction_on_active t x i :
  reaction Q t (on_active x) i = \sum_(j <- J) T A B t i j * x j.
Proof. exact: (row_of_solution P A B r t x i). Qed.

(* A solution with this support is a null vector; it may be scaled to x_k = V_k. *)
Lemma solution_null t x :
  solution Q t x -> (forall i, i \in slip Q -> i \in box_support k -> 0 < x i) ->
  (forall i, i \in slip Q -> i \notin box_support k -> x i = 0) ->
  [/\ null_vector A B J t x, 0 < x (pivot c) & forall i, i \in variables -> i \notin J -> x i = 0].
Proof.
have [[wf _ pv sup] _] := claim_parts; case=> _ _ rows_f rows_s pos zero.
have off i : i \in variables -> i \notin J -> x i = 0.
  move=> Hi out; case/orP: (free_or_slip Hi) => [/free_moving|Hs]; first by rewrite (negbTE out).
  by apply: zero => //; rewrite -slip_moving.
split=> // [i iJ|]; last by apply: pos => //; apply: sup.
have same : reaction Q t x i = \sum_(j <- J) T A B t i j * x j.
  rewrite -reaction_on_active; apply: sum_eq => j Hj; rewrite /on_active.
  by case: ifPn => // /(off _ Hj) ->.
rewrite -same; have := iJ; rewrite active_moving => /andP[_ /orP[/rows_f //|i_s]].
have [_ _ /eqP] := rows_s _ (sup _ i_s); rewrite mulf_eq0 gt_eqF ?pos ?sup //=.
by move/eqP.
Qed.

Theorem enclosed_claim_sound : exists (t : R) x,
  [/\ between t (from_point c) (to_point c), solution Q t x,
      forall i, i \in slip Q -> i \in box_support k -> 0 < x i,
      forall i, i \in slip Q -> i \notin box_support k -> x i = 0 /\ 0 < reaction Q t x i &
      forall t' x', solution Q t' x' -> between t' (interval_low k) (interval_high k) ->
        (forall i, i \in slip Q -> i \in box_support k -> 0 < x' i) ->
        (forall i, i \in slip Q -> i \notin box_support k -> x' i = 0) ->
        t' = t /\ proportional Q x x'].
Proof.
have [[wf O pv sup] [iso on off]] := claim_parts.
have [[kJ vk inside _] [wide _ uniq]] := isolated_parts iso.
case/and4P: inside => o _ _ _; have [p q p' q'] := ordered_ge0 R o.
have [t [x [bt bx null]]] := isolated_exists encloses_whole iso.
have eps0 := eps_ge0 R iso.
have [a [b [comb _]]] := combination_of_weights A B o bt; have [a0 b0 ab _] := comb.

have positive j : j \in box_support k -> 0 < x j.
  move=> j_s; have [jk|jk] := eqVneq j (pivot c); first by rewrite jk (proj1 bx) toR_gt0.
  have jK : j \in K by rewrite others_moving support_moving.
  have := (proj2 bx) _ jK; rewrite ler_distl => /andP[+ _]; apply: lt_le_trans.
  by rewrite subr_gt0 toR_lt; have := on _ j_s; rewrite /positive_on_support (negbTE jk).

have reaction_off i : i \in slip Q -> i \notin box_support k ->
    0 < reaction Q t (on_active x) i.
  move=> Hi out; rewrite reaction_on_active (row_combination P r x i comb).
  have Hv := slip_indices Hi; case/andP: (off _ Hi out) => y1 y2.
  apply: combination_gt0 => //.
    exact: (row_positive_sound encloses_whole kJ eps0 bx p q Hv y1).
  exact: (row_positive_sound encloses_whole kJ eps0 bx p' q' Hv y2).

have zero_rows i : i \in J -> reaction Q t (on_active x) i = 0.
  by move=> iJ; rewrite reaction_on_active null.

exists t, (on_active x); split=> //.
- split.
  + have f2 : 0 < toR (from_point c).2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
    by rewrite -(pmulr_lge0 _ f2); apply: le_trans (proj1 bt).
  + exists (pivot c); first by apply/slip_indices/sup.
    by rewrite /on_active kJ gt_eqF // positive.
  + by move=> i /free_moving/zero_rows.
  move=> i Hi; have [i_s|out] := boolP (i \in box_support k).
    by rewrite zero_rows ?support_moving // mulr0 /on_active support_moving // ltW ?positive.
  by rewrite /on_active slip_moving // (negbTE out) mul0r lexx ltW ?reaction_off.
- by move=> i Hi i_s; rewrite /on_active support_moving ?positive.
- move=> i Hi out; rewrite {1}/on_active slip_moving // (negbTE out).
  by split=> //; apply: reaction_off.

(* Any other one, scaled, lies in the box as well. *)
move=> t' x' sol' bt' pos' zero'; have [null' xk' off'] := solution_null sol' pos' zero'.
pose f := toR (V (pivot c)) / x' (pivot c); have f0 : 0 < f by rewrite divr_gt0 // toR_gt0.
have fk : f * x' (pivot c) = toR (V (pivot c)) by rewrite divfK // gt_eqF.
have null_f : null_vector A B J t' (fun j => f * x' j).
  move=> l lJ; under eq_bigr do rewrite mulrCA.
  by rewrite -mulr_sumr null' // mulr0.
have [w p1 q1 q2] := ordered_ge0 R O.
have [a' [b' [comb' _]]] := combination_of_weights A B O bt'.
have bt_wide := @inside_region R P r O c iso t bt.
have [a2 [b2 [comb2 one2]]] := combination_of_weights A B O bt_wide.
have bx' : boxed K (pivot c) (vector c) (width (wide_box c)) (fun j => f * x' j).
  split=> //; apply: (box_sound encloses_whole (@moving_indices _ r) (@others_moving _ r (pivot c))
    kJ (uniq_moving _ _) (uniq_others _ _ _) wide comb' w p1 q1 q2 fk); exact: null_rows_K.
have [-> xx] := unique_sound encloses_whole (@moving_indices _ r) (@others_moving _ r (pivot c)) kJ
  (uniq_moving _ _) (uniq_others _ _ _) uniq w p1 q1 q2 comb2 one2 bx' (proj1 bx) null null_f.
split=> //; exists f^-1 => [|i Hi]; first by rewrite invr_gt0.
rewrite /on_active; have [iJ|iJ] := boolP (i \in J); last by rewrite mulr0 off'.
by rewrite xx // mulKf // gt_eqF.
Qed.

End Sound.

Definition check_system_enclosed (s : system) (u : unknown) (k : enclosed_claim) :=
  system_wellformed s u && check_enclosed_claim (pencil_of s u) k.

Theorem system_enclosed (R : rcfType) s u k : check_system_enclosed s u k ->
  exists (t : R) v,
    [/\ between t (from_point (null_box k)) (to_point (null_box k)), satisfies_9 s u t v &
        has_support s u (box_support k) [::] t v].
Proof.
case/andP=> wf /(@enclosed_claim_sound R)[t [x [bt sol pos zero _]]].
exists t, (motion s x); split=> //; first exact/(system_pencil wf).
apply: (motion_support wf) => i Hi; split=> //; first exact: pos.
  by move/(zero _ Hi)=> [].
by move/(zero _ Hi)=> [].
Qed.
