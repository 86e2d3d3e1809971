(* Definite leaves: a quadratic form that has one sign on the region.

   For a solution x' T(t) x = x' y = 0.  Let S_e be the integer matrix, over the variables that may
   move,

       S_e,ij = +- (center_e,ij + center_e,ji) - radius_e,ij - radius_e,ji ;

   since x >= 0, x' S_e x <= +- 2 x' T_e x for the pencil at the end e.

   Theorem [definite_sound]: if S_e is strictly covered by a factor (Covered.v) at the lower end,
   and at the upper end (covered without "strictly" if that end is infinity), then the region has
   no solution.  [box_definite_sound]: a sign that excludes the solutions of two pencils alike
   excludes those of their combinations (Enclosed.v, box solutions).

   Page: spec/certificates.md, 5.9.  There the radius is taken off the diagonal by its row sums;
   taking it off entry by entry, as here, is enough because x >= 0.
   Rust: crates/check/src/cover/definite.rs, enclosed_definite.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered.

Record factor := Factor { weights : seq Z; factor_rows : matrix }.

Section Checker.

Variables (P : enclosed) (negative : bool).
Local Open Scope Z_scope.

(* The variables that may move. *)
Definition active (r : region) := [seq i <- indices P | ~~ is_resting (state_of r i)].

Definition symmetric_part e i j :=
  (if negative then - center P e i j - center P e j i else center P e i j + center P e j i)
  - radius P e i j - radius P e j i.

Definition definite_end (strict : bool) e r f :=
  [&& all (fun w => 0 <=? w) (weights f), size (factor_rows f) == size (active r) &
      covered (symmetric_part e) (weighted_dot (weights f)) strict
        (zip (active r) (factor_rows f))].

Definition definite r low high :=
  definite_end true (lower r) r low && definite_end (0 <? (upper r).2) (upper r) r high.

End Checker.

Lemma symmetric_part_sym P negative e i j :
  symmetric_part P negative e i j = symmetric_part P negative e j i.
Proof.
rewrite /symmetric_part; move: (center P e i j) (center P e j i) => a b.
move: (radius P e i j) (radius P e j i) => c d.
by case: negative; lia.
Qed.

Section Sound.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Variables (negative : bool) (r : region) (x : nat -> R).
Hypotheses (x0 : forall i, i \in indices P -> 0 <= x i) (ag : agrees (size_of P) r x).

Notation rows f := (zip (active P r) (factor_rows f)).

Definition sign : R := if negative then -1 else 1.

(* x' T_e x *)
Definition quadratic e :=
  \sum_(i <- indices P) \sum_(j <- indices P) x i * T_end A B e i j * x j.

Lemma near_sum (u v a b c d : R) : `|a - u| <= c -> `|b - v| <= d ->
  u + v - c - d <= a + b /\ - u - v - c - d <= - (a + b).
Proof.
rewrite !ler_distl => /andP[lo_a hi_a] /andP[lo_b hi_b].
have -> : u + v - c - d = (u - c) + (v - d) by ring.
have -> : - u - v - c - d = - ((u + c) + (v + d)) by ring.
by rewrite ler_opp2; split; apply: ler_add.
Qed.

Lemma symmetric_part_le e i j :
  0 <= toR e.1 :> R -> 0 <= toR e.2 :> R -> i \in indices P -> j \in indices P ->
  toR (symmetric_part P negative e i j) <= sign * (T_end A B e i j + T_end A B e j i).
Proof.
move=> p q Hi Hj.
have [plus minus] := near_sum (T_end_enclosed E Hi Hj p q) (T_end_enclosed E Hj Hi p q).
rewrite /symmetric_part /sign !toRB; case: (negative).
  by rewrite toRB toRN mulN1r.
by rewrite toRD mul1r.
Qed.

Lemma zero_unless_active i : i \in indices P -> i \notin active P r -> x i = 0.
Proof.
move=> Hi; rewrite mem_filter Hi andbT negbK => rest.
by have := agrees_at ag Hi; move: rest; case: (state_of r i).
Qed.

Lemma active_indices i : i \in active P r -> i \in indices P.
Proof. by rewrite mem_filter => /andP[]. Qed.

(* x' S_e x, written with the positions of the list of active variables. *)
Lemma definite_end_sound strict e f :
  0 <= toR e.1 :> R -> 0 <= toR e.2 :> R -> definite_end P negative strict e r f ->
  0 <= sign * quadratic e /\
  (strict -> (exists2 i, i \in indices P & x i != 0) -> 0 < sign * quadratic e).
Proof.
move=> p q /and3P[w0 sz C].
apply: (covered_quadratic (dT := 0%N) (dU := [::]) (item := id) (c := 1) _ sz _
  (weighted_gram R _ _ w0) _ C); rewrite ?filter_uniq ?iota_uniq ?ltr01 //.
- by move=> *; apply: symmetric_part_sym.
- exact: active_indices.
- exact: zero_unless_active.
move=> i j /active_indices Hi /active_indices Hj.
by rewrite mul1r ler_wpmul2r ?x0 // ler_wpmul2l ?x0 // symmetric_part_le.
Qed.

End Sound.

Section Leaf.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

(* x'T(t)x is a combination of the forms at the ends. *)
Lemma form_between sg lo hi t x : ordered lo hi -> between t lo hi ->
  0 < sg * quadratic P A B x lo -> 0 <= sg * quadratic P A B x hi ->
  ((0 <? hi.2)%Z -> 0 < sg * quadratic P A B x hi) ->
  0 < sg * \sum_(i <- indices P) x i * image P A B t x i.
Proof.
move=> O W low high0 high1; have [a [b [a0 b0 Tab pos]]] := T_between A B O W.
have -> : sg * (\sum_(i <- indices P) x i * image P A B t x i) =
    a * (sg * quadratic P A B x lo) + b * (sg * quadratic P A B x hi).
  rewrite !(mulrCA _ sg) -mulrDr; congr (_ * _).
  rewrite /quadratic !mulr_sumr -big_split; apply: eq_bigr => i _.
  rewrite /image !mulr_sumr -big_split; apply: eq_bigr => j _ /=; rewrite Tab.
  by move: (x i) (x j) (T_end _ _ _ _ _) (T_end _ _ _ _ _) => *; ring.
exact: ends_gt0 O a0 b0 pos low high0 high1.
Qed.

Lemma definite_image negative r low high t x : ordered (lower r) (upper r) ->
  between t (lower r) (upper r) -> definite P negative r low high ->
  (forall i, i \in indices P -> 0 <= x i) -> agrees (size_of P) r x ->
  (exists2 i, i \in indices P & x i != 0) ->
  0 < sign R negative * \sum_(i <- indices P) x i * image P A B t x i.
Proof.
move=> O W /andP[L H] x0 ag nonzero; have [p q p' q'] := ordered_ge0 R O.
have [_ low1] := definite_end_sound E x0 ag p q L.
have [high0 high1] := definite_end_sound E x0 ag p' q' H.
exact: form_between O W (low1 isT nonzero) high0 (fun st => high1 st nonzero).
Qed.

Theorem definite_sound negative r low high t x :
  ordered (lower r) (upper r) -> definite P negative r low high -> in_region_of P t x r ->
  solves P A B t x -> False.
Proof.
move=> O ok [W ag] [_ nonzero rows].
have := definite_image O W ok _ ag nonzero; rewrite sum_zero ?mulr0 ?ltxx => [pos|i /rows[]//].
by suff : false by []; apply: pos => i /rows[].
Qed.

End Leaf.

(* One sign for the enclosed pencils at both ends of an interval of another parameter. *)
Definition box_definite P P' r negative (f f' : factor * factor) :=
  definite P negative r f.1 f.2 && definite P' negative r f'.1 f'.2.

Theorem box_definite_sound (R : realFieldType) P P' (A B A' B' : nat -> nat -> R) r t a b x
    negative f f' : encloses P A B -> encloses P' A' B' -> size_of P' = size_of P ->
  ordered (lower r) (upper r) -> between t (lower r) (upper r) -> agrees (size_of P) r x ->
  0 <= a -> 0 <= b -> 0 < a \/ 0 < b -> box_solution P P' A B A' B' t a b x ->
  box_definite P P' r negative f f' -> False.
Proof.
move=> E E' same O W ag a0 b0 ab [nonzero compl] /andP[low high].
have x0 i : i \in indices P -> 0 <= x i by case/compl.
have l := definite_image E O W low x0 ag nonzero.
have h : 0 < sign R negative * \sum_(i <- indices P) x i * image P' A' B' t x i.
  by rewrite -(same_indices same); apply: (definite_image E' O W high);
     rewrite ?(same_indices same) ?same.
have pos := combination_gt0 a0 b0 ab l h.
suff zero : a * (sign R negative * \sum_(i <- indices P) x i * image P A B t x i) +
            b * (sign R negative * \sum_(i <- indices P) x i * image P' A' B' t x i) = 0.
  by rewrite zero ltxx in pos.
rewrite !(mulrCA _ (sign R negative)) -mulrDr !mulr_sumr -big_split /= sum_zero ?mulr0 // => i Hi.
by rewrite !(mulrCA _ (x i)) -mulrDr; case: (compl i Hi).
Qed.
