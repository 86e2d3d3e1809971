(* The complementarity eigenproblem of a pencil, and its blocks.

   A pencil (A, B) of order n has sparse integer rows; [free] lists its free variables, all others
   are complementarity variables.  A solution is a value t >= 0 and a vector x != 0 with

       y = (A + t B) x,   y_i = 0 for free i,   x_i >= 0, y_i >= 0, x_i y_i = 0 for the others.

   This is the definition that the theorems about certificates speak of.  Rows may have been
   multiplied by positive integers, so that their entries are integers.

   Theorem [pencil_blocks]: if the rows of B at free variables are zero, then x is a solution if and
   only if its free and its complementarity part solve the pencil in blocks (Condensation.v).
   [join_solution]: each solution of the blocks comes from a solution of the pencil.

   Page: spec/certificates.md, 5.1.  Rust: crates/check/src/pencil.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Places Condensation.

Record pencil := Pencil {
  order : nat;
  rows_a : seq sparse_row;
  rows_b : seq sparse_row;
  free : seq nat }.

Section Checker.

Local Open Scope Z_scope.

Variable Q : pencil.

(* The complementarity variables, ascending. *)
Definition slip : seq nat := [seq i <- iota 0 (order Q) | i \notin free Q].

Definition row_a i := nth [::] (rows_a Q) i.
Definition row_b i := nth [::] (rows_b Q) i.

Definition wellformed := uniq (free Q) && all (fun i => i < order Q)%N (free Q).

Definition free_rows_constant :=
  all (fun i => all (fun e => e.2 =? 0) (row_b i)) (free Q).

(* The entries of a row at the columns that have a place, numbered by their places. *)
Definition restrict (place : seq (option nat)) (row : sparse_row) : sparse_row :=
  pmap (fun e => omap (fun k => (k, e.2)) (nth None place e.1)) row.

Definition blocks_by place (columns : seq nat) : blocks :=
  let lookups row l := [seq lookup row j | j <- l] in
  Blocks (size (free Q)) (size columns)
    [seq restrict place (row_a i) | i <- free Q]
    [seq [seq lookup (row_a i) j | i <- free Q] | j <- columns]
    [seq lookups (row_a i) (free Q) | i <- columns]
    [seq lookups (row_b i) (free Q) | i <- columns]
    [seq lookups (row_a i) columns | i <- columns]
    [seq lookups (row_b i) columns | i <- columns].

Definition blocks_of : blocks := blocks_by (places (free Q)) slip.

End Checker.

(* The first variables are free. *)
Lemma slip_iota n m ra rb : slip (Pencil (n + m) ra rb (iota 0 n)) = iota n m.
Proof.
rewrite /slip /= iotaD filter_cat add0n.
rewrite (eq_in_filter (a2 := pred0)) ?filter_pred0; last by move=> i /= ->.
rewrite (eq_in_filter (a2 := predT)) ?filter_predT // => i; rewrite !mem_iota => /andP[ge _].
by rewrite add0n /= -leqNgt.
Qed.

Section Real.

Variables (R : rcfType) (Q : pencil).
Notation indices := (iota 0 (order Q)).

Definition a_entry i j : R := toR (lookup (row_a Q i) j).
Definition b_entry i j : R := toR (lookup (row_b Q i) j).

(* y_i *)
Definition reaction t (x : nat -> R) i :=
  \sum_(j <- indices) (a_entry i j + t * b_entry i j) * x j.

Definition solution t (x : nat -> R) :=
  [/\ 0 <= t, exists2 i, i \in indices & x i != 0,
      forall i, i \in free Q -> reaction t x i = 0 &
      forall i, i \in slip Q -> [/\ 0 <= x i, 0 <= reaction t x i & x i * reaction t x i = 0]].

(* x' is a positive multiple of x. *)
Definition proportional (x x' : nat -> R) :=
  exists2 f, 0 < f & forall i, i \in iota 0 (order Q) -> x' i = f * x i.

Hypothesis wf : wellformed Q.

Lemma free_indices i : i \in free Q -> i \in indices.
Proof. by case/andP: wf => _ /allP lt /lt; rewrite mem_iota. Qed.

Lemma slip_indices i : i \in slip Q -> i \in indices.
Proof. by rewrite mem_filter => /andP[]. Qed.

Lemma free_or_slip i : i \in indices -> (i \in free Q) || (i \in slip Q).
Proof. by move=> Hi; rewrite mem_filter Hi andbT orbN. Qed.

Lemma uniq_free : uniq (free Q).
Proof. by case/andP: wf. Qed.

Lemma uniq_slip : uniq (slip Q).
Proof. by rewrite filter_uniq // iota_uniq. Qed.

Lemma sum_free_slip (f : nat -> R) :
  \sum_(i <- indices) f i = \sum_(i <- free Q) f i + \sum_(i <- slip Q) f i.
Proof.
rewrite -big_cat; apply: perm_big; apply: uniq_perm; rewrite ?iota_uniq //.
  rewrite cat_uniq uniq_free uniq_slip andbT /=; apply/hasPn => i.
  by rewrite mem_filter => /andP[].
move=> i; rewrite mem_cat; apply/idP/idP; first exact: free_or_slip.
by case/orP; [apply: free_indices | apply: slip_indices].
Qed.

(* A sum over the elements of a list as a sum over their positions. *)
Lemma sum_positions (l : seq nat) (f : nat -> R) :
  \sum_(i <- l) f i = \sum_(k <- iota 0 (size l)) f (nth 0%N l k).
Proof. by rewrite (big_nth 0%N) /index_iota subn0. Qed.

Lemma lookup_restrict row k : (k < size (free Q))%N ->
  lookup (restrict (places (free Q)) row) k = lookup row (nth 0%N (free Q) k).
Proof.
move=> Hk; elim: row => //= e row IH; rewrite /restrict /= nth_places.
case: ifP => [e_in|e_out] /=; rewrite -/(restrict _ row) IH.
  case: eqP => [<-|n1]; first by rewrite nth_index // eqxx.
  by case: eqP => // eq; case: n1; rewrite eq index_uniq // uniq_free.
by case: eqP => // eq; rewrite eq mem_nth in e_out.
Qed.

Lemma restrict_range l row : all (fun e => e.1 < size l)%N (restrict (places l) row).
Proof.
elim: row => //= e row; rewrite /restrict /= nth_places.
by case: ifP => //= e_in ->; rewrite index_mem e_in.
Qed.

(* The two parts of a vector. *)
Definition free_of (x : nat -> R) k := x (nth 0%N (free Q) k).
Definition slip_of (x : nat -> R) j := x (nth 0%N (slip Q) j).

(* If the free variables are combinations of the others, then not all of these are 0. *)
Lemma slip_part_nonzero (c : nat -> nat -> R) x :
  (forall k, k \in iota 0 (size (free Q)) ->
     free_of x k = - \sum_(j <- iota 0 (size (slip Q))) c j k * slip_of x j) ->
  (exists2 i, i \in indices & x i != 0) ->
  exists2 j, j \in iota 0 (size (slip Q)) & slip_of x j != 0.
Proof.
move=> part [i Hi xi]; apply/hasP; apply: contraNT xi => /hasPn none.
have zero j : j \in iota 0 (size (slip Q)) -> slip_of x j = 0.
  by move/none; rewrite negbK => /eqP.
apply/eqP; case/orP: (free_or_slip Hi) => /(nthP 0%N)[k lt_k <-].
  rewrite -[LHS]/(free_of x k) part ?mem_iota // sum_zero ?oppr0 // => j Hj.
  by rewrite zero // mulr0.
by apply: zero; rewrite mem_iota.
Qed.

Hypothesis constant : free_rows_constant Q.

Lemma b_entry_free i j : i \in free Q -> b_entry i j = 0.
Proof.
move=> Hi; have /allP zero := allP constant _ Hi; rewrite /b_entry.
suff -> : lookup (row_b Q i) j = 0%Z by [].
elim: (row_b Q i) zero => //= e row IH zero.
have e0 : e.2 = 0%Z by apply/Z.eqb_spec/zero; rewrite inE eqxx.
by rewrite IH ?e0; [case: eqP | move=> e' He'; apply: zero; rewrite inE He' orbT].
Qed.

Lemma reaction_free t x k : (k < size (free Q))%N ->
  reaction t x (nth 0%N (free Q) k) = free_row (blocks_of Q) (free_of x) (slip_of x) k.
Proof.
move=> Hk; rewrite /reaction /free_row sum_free_slip.
rewrite (sum_positions (free Q)) (sum_positions (slip Q)); congr (_ + _).
  apply: sum_eq => j; rewrite mem_iota add0n /= => Hj.
  by rewrite b_entry_free ?mem_nth // mulr0 addr0 /F (nth_map 0%N) // lookup_restrict.
apply: sum_eq => j; rewrite mem_iota add0n /= => Hj.
rewrite b_entry_free ?mem_nth // mulr0 addr0 /at_ /row_of.
by rewrite (nth_map 0%N) // (nth_map 0%N).
Qed.

Lemma reaction_slip t x i : (i < size (slip Q))%N ->
  reaction t x (nth 0%N (slip Q) i) = slip_row (blocks_of Q) t (free_of x) (slip_of x) i.
Proof.
move=> Hi; rewrite /reaction /slip_row sum_free_slip.
rewrite (sum_positions (free Q)) (sum_positions (slip Q)); congr (_ + _).
  apply: sum_eq => j; rewrite mem_iota add0n /= => Hj.
  by rewrite /at_ /row_of !(nth_map 0%N).
apply: sum_eq => j; rewrite mem_iota add0n /= => Hj.
by rewrite /entry !(nth_map 0%N).
Qed.

Theorem pencil_blocks t x :
  solution t x <-> block_solution (blocks_of Q) t (free_of x) (slip_of x).
Proof.
split=> [[t0 [i Hi xi] rows_f rows_s]|[t0 nonzero rows_f rows_s]].
  split=> //.
  - case/orP: (free_or_slip Hi) => /(nthP 0%N)[k lt_k eq_i].
      by left; exists k; rewrite ?mem_iota // /free_of eq_i.
    by right; exists k; rewrite ?mem_iota // /slip_of eq_i.
  - move=> k; rewrite mem_iota add0n /= => Hk.
    by rewrite -(reaction_free t) // rows_f // mem_nth.
  move=> j; rewrite mem_iota add0n /= => Hj.
  by rewrite -reaction_slip //; apply: rows_s; rewrite mem_nth.

split=> //.
- case: nonzero => -[k]; rewrite mem_iota add0n /= => Hk xk.
    by exists (nth 0%N (free Q) k) => //; apply/free_indices/mem_nth.
  by exists (nth 0%N (slip Q) k) => //; apply/slip_indices/mem_nth.
- move=> i /(nthP 0%N)[k Hk <-]; rewrite reaction_free //.
  by apply: rows_f; rewrite mem_iota.
move=> i /(nthP 0%N)[j Hj <-]; rewrite reaction_slip //.
by apply: rows_s; rewrite mem_iota.
Qed.

(* The free part is what the free rows demand, and the other rows are condensed ones. *)
Lemma free_part_of_rows w t x : stiffness_positive (blocks_of Q) w ->
  (forall i, i \in free Q -> reaction t x i = 0) -> forall k, k \in iota 0 (size (free Q)) ->
  free_of x k = free_part (blocks_of Q) (slip_of x) k.
Proof.
move=> pos rows; apply/(free_rows_vanish pos) => k; rewrite mem_iota add0n => lt_k.
by rewrite -(reaction_free t) // rows // mem_nth.
Qed.

Lemma condensed_reaction w t x j : (j < size (slip Q))%N ->
  (forall k, k \in iota 0 (size (free Q)) -> free_of x k = free_part (blocks_of Q) (slip_of x) k) ->
  image (condensed (blocks_of Q) w) (A_condensed R (blocks_of Q) w) (B_condensed R (blocks_of Q) w)
    t (slip_of x) j =
  scale_of R w j * toR (unit_of w) ^+ 2 * reaction t x (nth 0%N (slip Q) j).
Proof.
move=> lt_j part; rewrite (condensed_image (D := blocks_of Q) (xs := slip_of x) w t part).
  by rewrite -reaction_slip.
by rewrite mem_iota.
Qed.

(* The way back from the parts to a vector. *)
Definition join (xf xs : nat -> R) i :=
  if i \in free Q then xf (index i (free Q)) else xs (index i (slip Q)).

Lemma free_of_join xf xs k : (k < size (free Q))%N -> free_of (join xf xs) k = xf k.
Proof. by move=> Hk; rewrite /free_of /join mem_nth // index_uniq // uniq_free. Qed.

Lemma slip_of_join xf xs j : (j < size (slip Q))%N -> slip_of (join xf xs) j = xs j.
Proof.
move=> Hj; have := mem_nth 0%N Hj; rewrite mem_filter => /andP[/negbTE not_free _].
by rewrite /slip_of /join not_free index_uniq // uniq_slip.
Qed.

Theorem join_solution t xf xs :
  block_solution (blocks_of Q) t xf xs -> solution t (join xf xs).
Proof.
have ef k : k \in iota 0 (size (free Q)) -> free_of (join xf xs) k = xf k.
  by rewrite mem_iota add0n => Hk; apply: free_of_join.
have es j : j \in iota 0 (size (slip Q)) -> slip_of (join xf xs) j = xs j.
  by rewrite mem_iota add0n => Hj; apply: slip_of_join.
have free_rowE i : free_row (blocks_of Q) (free_of (join xf xs)) (slip_of (join xf xs)) i =
                   free_row (blocks_of Q) xf xs i.
  by rewrite /free_row; congr (_ + _); apply: eq_big_seq => j Hj; rewrite ?ef ?es.
have slip_rowE i : slip_row (blocks_of Q) t (free_of (join xf xs)) (slip_of (join xf xs)) i =
                   slip_row (blocks_of Q) t xf xs i.
  by rewrite /slip_row; congr (_ + _); apply: eq_big_seq => j Hj; rewrite ?ef ?es.

case=> t0 nonzero rows_f rows_s; apply/pencil_blocks; split=> //.
- by case: nonzero => -[i Hi xi]; [left | right]; exists i; rewrite ?ef ?es.
- by move=> i Hi; rewrite free_rowE rows_f.
by move=> i Hi; rewrite slip_rowE es //; apply: rows_s.
Qed.

End Real.

(* Rows with positive factors. *)
Lemma solution_scaled (R : rcfType) Q Q' (t t' : R) x (c : nat -> R) :
  order Q' = order Q -> free Q' = free Q -> (0 <= t') = (0 <= t) -> (forall i, 0 < c i) ->
  (forall i, i \in free Q ++ slip Q -> reaction Q' t' x i = c i * reaction Q t x i) ->
  solution Q' t' x <-> solution Q t x.
Proof.
move=> same_order same_free same_sign c0 rows.
rewrite /solution /slip same_order same_free same_sign -/(slip Q).
have free_in i : i \in free Q -> i \in free Q ++ slip Q by rewrite mem_cat => ->.
have slip_in i : i \in slip Q -> i \in free Q ++ slip Q by rewrite mem_cat orbC => ->.
split=> -[t0 nonzero rows_f rows_s]; split=> // i Hi.
- have /eqP := rows_f i Hi; rewrite rows ?free_in //.
  by rewrite mulf_eq0 gt_eqF //= => /eqP.
- by have := rows_s i Hi; rewrite rows ?slip_in // => /(complementary_scaled _ _ (c0 i)).
- by rewrite rows ?free_in // rows_f // mulr0.
by rewrite rows ?slip_in //; apply/(complementary_scaled _ _ (c0 i))/rows_s.
Qed.
