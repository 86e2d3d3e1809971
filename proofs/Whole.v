(* Definite leaves of the whole pencil, before any condensation.

   For a solution x' D (A + t B) x = x' D y = 0 for every diagonal matrix D, free variables
   included.  Let S_e, for an end e = (p, q), be the matrix

       c (q (DA + (DA)') + p (DB + (DB)'))        over the free variables and those that may move.

   The rows of A and B are multiples of those given (Pencil.v), not always by one number; with the
   right weights D the matrices are those of the certificate, or their opposites.

   Theorem [whole_sound]: if S_e is strictly covered by a factor at the lower end, and at the upper
   end (covered without "strictly" if that end is infinity), then the region has no solution.
   [whole_image]: x' D (A + t B) x is positive.

   This closes the leaves `ldl` (dense factor with weights) and `tail` (factor whose rows begin at
   their first entry) of a certificate.  An exact L D L' = S gives strict coverage of S after a
   small multiple of the identity is taken off; at infinity, where S may be singular, L D L' = S
   itself covers S.

   Pages: spec/certificates.md, 5.10 and 5.13.
   Rust: crates/check/src/cover/ldl.rs, psd.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Definite Condensation Pencil.

(* Weights and rows; or a multiplier and rows that begin late. *)
Inductive whole_factor :=
  | Dense of seq Z & matrix
  | Late of Z & seq late_row.

Record whole_end := WholeEnd { end_scale : Z; end_factor : whole_factor }.

(* D (a weight that is missing is 1), and a factor at each end. *)
Record whole := WholeLeaf {
  whole_weights : seq Z;
  low_end : whole_end;
  high_end : whole_end }.

(* A variable with its rows of A and B. *)
Definition member := (nat * (sparse_row * sparse_row))%type.

Section Checker.

Variables (Q : pencil) (weight : seq Z).
Local Open Scope Z_scope.

Definition weighted (i : nat) (row : sparse_row) : sparse_row :=
  times_row (nth 1 weight i) row.

Definition may_move (r : region) : seq nat :=
  let columns := slip Q in
  free Q ++ [seq nth 0%N columns j | j <- iota 0 (size columns) & ~~ is_resting (state_of r j)].

Definition members r : seq member :=
  [seq (i, (weighted i (row_a Q i), weighted i (row_b Q i))) | i <- may_move r].

Definition member_entry (e : point) (i j : member) :=
  e.2 * lookup i.2.1 j.1 + e.1 * lookup i.2.2 j.1.

Definition member_form c e (i j : member) := c * (member_entry e i j + member_entry e j i).

Definition check_end (strict : bool) e r (w : whole_end) :=
  (0 <? end_scale w) &&
  match end_factor w with
  | Dense weights rows =>
      [&& all (fun u => 0 <=? u) weights, size rows == size (members r) &
          covered (member_form (end_scale w) e) (weighted_dot weights) strict
            (zip (members r) rows)]
  | Late m rows =>
      [&& 0 <=? m, size rows == size (members r) &
          covered (member_form (end_scale w) e) (fun a b => m * late_dot a b) strict
            (zip (members r) rows)]
  end.

End Checker.

Definition check_whole Q (r : region) (w : whole) :=
  check_end Q (whole_weights w) true (lower r) r (low_end w) &&
  check_end Q (whole_weights w) (0 <? (upper r).2)%Z (upper r) r (high_end w).

Lemma member_form_sym c e i j : member_form c e i j = member_form c e j i.
Proof. by rewrite /member_form Z.add_comm. Qed.

Section Sound.

Variables (R : rcfType) (Q : pencil) (weight : seq Z).
Hypothesis wf : wellformed Q.
Notation indices := (iota 0 (order Q)).

Variables (r : region) (x : nat -> R).
Hypothesis ag : agrees (size (slip Q)) r (slip_of Q x).

Notation weight_of := (weight_of R weight).

Definition end_entry (e : point) i j : R :=
  weight_of i * (toR e.2 * a_entry R Q i j + toR e.1 * b_entry R Q i j).

Definition whole_quadratic e :=
  \sum_(i <- indices) \sum_(j <- indices) x i * end_entry e i j * x j.

Lemma may_move_indices i : i \in may_move Q r -> i \in indices.
Proof.
rewrite mem_cat => /orP[/(free_indices wf)//|/mapP[j]].
by rewrite mem_filter mem_iota add0n => /andP[_ lt_j] ->; apply/slip_indices/mem_nth.
Qed.

Lemma uniq_may_move : uniq (may_move Q r).
Proof.
rewrite cat_uniq (uniq_free wf) /=; apply/andP; split.
  apply/hasPn => i /mapP[j]; rewrite mem_filter mem_iota add0n => /andP[_ lt_j] ->.
  by have := mem_nth 0%N lt_j; rewrite mem_filter => /andP[].
rewrite map_inj_in_uniq ?filter_uniq ?iota_uniq // => i j.
rewrite !mem_filter !mem_iota !add0n => /andP[_ lt_i] /andP[_ lt_j] /eqP.
by rewrite nth_uniq ?uniq_slip // => /eqP.
Qed.

Lemma zero_unless_may_move i : i \in indices -> i \notin may_move Q r -> x i = 0.
Proof.
move=> Hi; rewrite mem_cat negb_or => /andP[not_free].
have : i \in slip Q by have := free_or_slip Hi; rewrite (negbTE not_free).
case/(nthP 0%N)=> j lt_j <- not_listed; have := ag lt_j; rewrite /slip_of.
case state_j: (state_of r j) => // _;
  by move/negP: not_listed; case; apply/mapP; exists j; rewrite // mem_filter mem_iota state_j.
Qed.

Notation nobody := ((0%N, ([::], [::])) : member).

Lemma member_entryE e i j :
  toR (member_entry e (i, (weighted weight i (row_a Q i), weighted weight i (row_b Q i)))
         (j, (weighted weight j (row_a Q j), weighted weight j (row_b Q j)))) = end_entry e i j.
Proof.
rewrite /member_entry !lookup_times toRD !toRM /end_entry /weight_of /a_entry /b_entry.
by move: (toR (nth _ _ _)) (toR (lookup _ _)) (toR (lookup _ _)) => *; ring.
Qed.

(* The integer form is 2 c times the form of the pencil. *)
Lemma covered_end_sound U (d : U) product strict c e (rows : seq U) :
  (0 <? c)%Z -> size rows == size (members Q weight r) ->
  gram R (nobody, d) product (zip (members Q weight r) rows) ->
  covered (member_form c e) product strict (zip (members Q weight r) rows) ->
  0 <= whole_quadratic e /\
  (strict -> (exists2 i, i \in indices & x i != 0) -> 0 < whole_quadratic e).
Proof.
move=> c0 sz gr cov; have szm : size (members Q weight r) = size (may_move Q r) by rewrite size_map.
rewrite szm in sz; pose rows_of i := (weighted weight i (row_a Q i), weighted weight i (row_b Q i)).
apply: (covered_quadratic (item := fun i => (i, rows_of i)) (c := toR c) szm sz _ gr _ cov);
  rewrite ?iota_uniq ?uniq_may_move ?toR_gt0 //.
- by move=> k lt_k; rewrite (nth_map 0%N).
- by move=> *; apply: member_form_sym.
- exact: may_move_indices.
- exact: zero_unless_may_move.
by move=> i j _ _; rewrite /member_form toRM toRD !member_entryE lexx.
Qed.

Lemma check_end_sound strict e w : check_end Q weight strict e r w ->
  0 <= whole_quadratic e /\
  (strict -> (exists2 i, i \in indices & x i != 0) -> 0 < whole_quadratic e).
Proof.
case/andP=> c0; case: (end_factor w) => [weights rows|m rows] /and3P[w0 sz cov].
  exact: (covered_end_sound c0 sz (weighted_gram R (nobody, [::]) _ w0) cov).
exact: (covered_end_sound c0 sz (late_gram R (nobody, (0%N, [::])) _ w0) cov).
Qed.

End Sound.

Lemma whole_image (R : rcfType) Q r w (t : R) x :
  wellformed Q -> ordered (lower r) (upper r) -> check_whole Q r w ->
  between t (lower r) (upper r) -> agrees (size (slip Q)) r (slip_of Q x) ->
  (exists2 i, i \in iota 0 (order Q) & x i != 0) ->
  0 < \sum_(i <- iota 0 (order Q)) weight_of R (whole_weights w) i * (x i * reaction Q t x i).
Proof.
move=> wf O /andP[L H] bt ag nonzero.
have [a [b [a0 b0 [one val] pos]]] := weights_of_ends O bt.
set d := whole_weights w in L H *.
have [low0 low1] := check_end_sound wf ag L.
have [high0 high1] := check_end_sound wf ag H.

have -> : \sum_(i <- iota 0 (order Q)) weight_of R d i * (x i * reaction Q t x i) =
          a * whole_quadratic Q d x (lower r) + b * whole_quadratic Q d x (upper r).
  rewrite /whole_quadratic !mulr_sumr -big_split; apply: eq_bigr => i _.
  rewrite /reaction !mulr_sumr -big_split; apply: eq_bigr => j _ /=.
  rewrite /end_entry -[X in X + t * _]mul1r -one -[in LHS]val.
  by move: (weight_of _ _ _) (x i) (x j) (a_entry _ _ _ _) (b_entry _ _ _ _) => *; ring.

exact: ends_gt0 O a0 b0 pos (low1 isT nonzero) high0 (fun st => high1 st nonzero).
Qed.

Theorem whole_sound (R : rcfType) Q r w (t : R) x :
  wellformed Q -> ordered (lower r) (upper r) -> check_whole Q r w ->
  between t (lower r) (upper r) -> agrees (size (slip Q)) r (slip_of Q x) ->
  solution Q t x -> False.
Proof.
move=> wf O ok bt ag [_ nonzero rows_f rows_s].
have := whole_image wf O ok bt ag nonzero; rewrite sum_zero ?ltxx // => i Hi.
by case/orP: (free_or_slip Hi) => [/rows_f->|/rows_s[_ _ ->]]; rewrite !mulr0.
Qed.
