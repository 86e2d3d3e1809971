(* Definite leaves: a quadratic form with weights that is positive on the region.

   For a solution x' D T(t) x = sum_i d_i x_i y_i = 0 for every diagonal matrix D.  Let S_e be the
   integer matrix, over the variables that may move,

       S_e,ij = d_i center_e,ij - |d_i| radius_e,ij + d_j center_e,ji - |d_j| radius_e,ji ;

   since x >= 0, x' S_e x <= 2 x' D T_e x for the pencil at the end e.  The weights d_i are integers
   of any sign: 1 for `positive_definite`, -1 for `negative_definite`, those of the file for
   `weighted_definite`.

   Theorem [definite_sound]: if S_e is strictly covered by a factor (Covered.v) at the lower end,
   and at the upper end (covered without "strictly" if that end is infinity), then the region has
   no solution.  [box_definite_sound]: weights that exclude the solutions of two pencils alike
   exclude those of their combinations (Enclosed.v, box solutions).

   Page: spec/certificates.md, 5.9.  There the radius is taken off the diagonal by its row sums;
   taking it off entry by entry, as here, is enough because x >= 0.
   Rust: crates/check/src/cover/definite.rs, enclosed_definite.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered.

Record factor := Factor { weights : seq Z; factor_rows : matrix }.

Section Checker.

(* The diagonal D; a weight that is missing is 1. *)
Variables (P : enclosed) (d : seq Z).
Local Open Scope Z_scope.

(* The variables that may move. *)
Definition active (r : region) := [seq i <- indices P | ~~ is_resting (state_of r i)].

Definition weighted_entry e i j :=
  nth 1 d i * center P e i j - Z.abs (nth 1 d i) * radius P e i j.

Definition symmetric_part e i j := weighted_entry e i j + weighted_entry e j i.

Definition definite_end (strict : bool) e r f :=
  [&& all (fun w => 0 <=? w) (weights f), size (factor_rows f) == size (active r) &
      covered (symmetric_part e) (weighted_dot (weights f)) strict
        (zip (active r) (factor_rows f))].

Definition definite r low high :=
  definite_end true (lower r) r low && definite_end (0 <? (upper r).2) (upper r) r high.

End Checker.

Definition weight_of (R : realFieldType) (d : seq Z) i : R := toR (nth 1%Z d i).

Section Sound.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Variables (d : seq Z) (r : region) (x : nat -> R).
Hypotheses (x0 : forall i, i \in indices P -> 0 <= x i) (ag : agrees (size_of P) r x).

Notation weight := (weight_of R d).

(* x' D T_e x *)
Definition quadratic e :=
  \sum_(i <- indices P) \sum_(j <- indices P) x i * (weight i * T_end A B e i j) * x j.

Lemma weighted_entry_le e i j :
  0 <= toR e.1 :> R -> 0 <= toR e.2 :> R -> i \in indices P -> j \in indices P ->
  toR (weighted_entry P d e i j) <= weight i * T_end A B e i j.
Proof.
move=> p q Hi Hj; rewrite toRB !toRM toR_abs ler_subl_addr -ler_subl_addl -mulrBr.
by rewrite (le_trans (ler_norm _)) // normrM ler_wpmul2l // distrC; apply: T_end_enclosed.
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
  0 <= toR e.1 :> R -> 0 <= toR e.2 :> R -> definite_end P d strict e r f ->
  0 <= quadratic e /\
  (strict -> (exists2 i, i \in indices P & x i != 0) -> 0 < quadratic e).
Proof.
move=> p q /and3P[w0 sz C].
apply: (covered_quadratic (dT := 0%N) (dU := [::]) (item := id) (c := 1) _ sz _
  (weighted_gram R _ _ w0) _ C); rewrite ?filter_uniq ?iota_uniq ?ltr01 //.
- by move=> *; apply: Z.add_comm.
- exact: active_indices.
- exact: zero_unless_active.
move=> i j /active_indices Hi /active_indices Hj.
by rewrite mul1r toRD ler_wpmul2r ?ler_wpmul2l ?x0 // ler_add // weighted_entry_le.
Qed.

End Sound.

Section Leaf.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Notation form d t x :=
  (\sum_(i <- indices P) weight_of R d i * (x i * image P A B t x i)).

(* x' D T(t) x is a combination of the forms at the ends. *)
Lemma form_between d lo hi t x : ordered lo hi -> between t lo hi ->
  0 < quadratic P A B d x lo -> 0 <= quadratic P A B d x hi ->
  ((0 <? hi.2)%Z -> 0 < quadratic P A B d x hi) -> 0 < form d t x.
Proof.
move=> O W low high0 high1; have [a [b [a0 b0 Tab pos]]] := T_between A B O W.
have -> : form d t x = a * quadratic P A B d x lo + b * quadratic P A B d x hi.
  rewrite /quadratic !mulr_sumr -big_split; apply: eq_bigr => i _.
  rewrite /image !mulr_sumr -big_split; apply: eq_bigr => j _ /=; rewrite Tab.
  by move: (weight_of _ _ _) (x i) (x j) (T_end _ _ _ _ _) (T_end _ _ _ _ _) => *; ring.
exact: ends_gt0 O a0 b0 pos low high0 high1.
Qed.

Lemma definite_image d r low high t x : ordered (lower r) (upper r) ->
  between t (lower r) (upper r) -> definite P d r low high ->
  (forall i, i \in indices P -> 0 <= x i) -> agrees (size_of P) r x ->
  (exists2 i, i \in indices P & x i != 0) -> 0 < form d t x.
Proof.
move=> O W /andP[L H] x0 ag nonzero; have [p q p' q'] := ordered_ge0 R O.
have [_ low1] := definite_end_sound E x0 ag p q L.
have [high0 high1] := definite_end_sound E x0 ag p' q' H.
exact: form_between O W (low1 isT nonzero) high0 (fun st => high1 st nonzero).
Qed.

Theorem definite_sound d r low high t x :
  ordered (lower r) (upper r) -> definite P d r low high -> in_region_of P t x r ->
  solves P A B t x -> False.
Proof.
move=> O ok [W ag] [_ nonzero rows].
have := definite_image O W ok _ ag nonzero; rewrite sum_zero ?ltxx => [pos|i /rows[_ _ ->]].
  by suff : false by []; apply: pos => i /rows[].
by rewrite mulr0.
Qed.

End Leaf.

(* The same weights for the enclosed pencils at both ends of an interval of another parameter. *)
Definition box_definite P P' r d (f f' : factor * factor) :=
  definite P d r f.1 f.2 && definite P' d r f'.1 f'.2.

Theorem box_definite_sound (R : realFieldType) P P' (A B A' B' : nat -> nat -> R) r t a b x
    d f f' : encloses P A B -> encloses P' A' B' -> size_of P' = size_of P ->
  ordered (lower r) (upper r) -> between t (lower r) (upper r) -> agrees (size_of P) r x ->
  0 <= a -> 0 <= b -> 0 < a \/ 0 < b -> box_solution P P' A B A' B' t a b x ->
  box_definite P P' r d f f' -> False.
Proof.
move=> E E' same O W ag a0 b0 ab [nonzero compl] /andP[low high].
have x0 i : i \in indices P -> 0 <= x i by case/compl.
have l := definite_image E O W low x0 ag nonzero.
have h : 0 < \sum_(i <- indices P) weight_of R d i * (x i * image P' A' B' t x i).
  by rewrite -(same_indices same); apply: (definite_image E' O W high);
     rewrite ?(same_indices same) ?same.
have := combination_gt0 a0 b0 ab l h.
rewrite !mulr_sumr -big_split /= sum_zero ?ltxx // => i Hi.
rewrite !(mulrCA _ (weight_of _ _ _)) -mulrDr !(mulrCA _ (x i)) -mulrDr.
by case: (compl i Hi) => _ _; rewrite /box_image => ->; rewrite mulr0.
Qed.
