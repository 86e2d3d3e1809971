(* Symmetric sparse matrices bounded from below.

   A matrix S is given by sparse rows.  Numbers c > 0, d >= 0, m >= 0 and a factor L with rows that
   begin at their first entry are witness of S >= (d/c) I: the matrix c S - d I is covered by
   m L L' (Covered.v).

   The checker looks at the entries that there are, to see that S is symmetric, and writes each row
   of c S - d I out: entry j is then reached in j steps without a comparison (Places.v).

   Theorem [bounded_rows_sound]: c z'S z >= d z'z for every z.  [bounded_lookup_sym]: S is
   symmetric.

   Page: spec/certificates.md, 5.14 (sigma).  Rust: crates/check/src/cover/psd.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Covered.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

(* A sparse row: column and entry.  Entries of one column are summed. *)
Definition sparse_row := seq (nat * Z).

Definition lookup (row : sparse_row) (j : nat) : Z :=
  foldr (fun entry sum => if entry.1 == j then (entry.2 + sum)%Z else sum) 0%Z row.

(* c, d, m and L: c S - d I is covered by m L L'. *)
Record form_bound := FormBound {
  bound_times : Z;
  bound_at : Z;
  gram_times : Z;
  gram_rows : seq late_row }.

Section Checker.

Local Open Scope Z_scope.

(* A row with its entries at all columns. *)
Definition spread (row : sparse_row) : seq Z :=
  foldr (fun e dense => set_nth 0 dense e.1 (e.2 + nth 0 dense e.1)) [::] row.

(* Row i of c S - d I. *)
Definition shifted_row c d i (row : sparse_row) : sparse_row :=
  (i, - d) :: [seq (e.1, c * e.2) | e <- row].

(* An entry (j, _) of row i is compared with entry i of row j. *)
Definition symmetric_rows_sparse (rows : seq sparse_row) :=
  all_from (fun i row => all (fun e => lookup row e.1 =? lookup (nth [::] rows e.1) i) row) 0 rows.

(* A row with its number. *)
Definition numbered := (nat * seq Z)%type.

Definition bounded_rows n (rows : seq sparse_row) (b : form_bound) :=
  let dense i row := (i, spread (shifted_row (bound_times b) (bound_at b) i row)) in
  [&& 0 <? bound_times b, 0 <=? bound_at b, 0 <=? gram_times b, size rows == n,
      size (gram_rows b) == n, symmetric_rows_sparse rows &
      covered (fun r s : numbered => nth 0 r.2 s.1) (fun r s => gram_times b * late_dot r s) false
        (zip (map_from dense 0 rows) (gram_rows b))].

End Checker.

Lemma nth_spread row j : nth 0%Z (spread row) j = lookup row j.
Proof.
elim: row => [|e row IH] /=; first by rewrite nth_nil.
by rewrite nth_set_nth /= eq_sym -IH; case: eqP => [->|].
Qed.

Lemma lookup_shifted c d i row j :
  lookup (shifted_row c d i row) j = (c * lookup row j - (if i == j then d else 0))%Z.
Proof.
have -> : (c * lookup row j)%Z = lookup [seq (e.1, c * e.2)%Z | e <- row] j.
  elim: row => [|e row IH] /=; first by rewrite Z.mul_0_r.
  by rewrite -IH; case: eqP => // _; rewrite Z.mul_add_distr_l.
by rewrite /=; case: eqP => _; [rewrite Z.add_comm | rewrite Z.sub_0_r].
Qed.

(* A column without an entry. *)
Lemma lookup_none (row : sparse_row) j : j \notin [seq e.1 | e <- row] -> lookup row j = 0%Z.
Proof.
by elim: row => //= e row IH; rewrite inE negb_or eq_sym => /andP[/negbTE-> /IH].
Qed.

Lemma symmetric_lookup rows i j : symmetric_rows_sparse rows ->
  (i < size rows)%N -> (j < size rows)%N ->
  lookup (nth [::] rows i) j = lookup (nth [::] rows j) i.
Proof.
move=> sym lt_i lt_j.
have at_entry k m : (k < size rows)%N -> m \in [seq e.1 | e <- nth [::] rows k] ->
    lookup (nth [::] rows k) m = lookup (nth [::] rows m) k.
  move=> lt_k /mapP[e e_in ->]; have /allP/(_ _ e_in)/Z.eqb_spec := all_from_nth [::] sym lt_k.
  by rewrite add0n.
have [/at_entry|out_i] := boolP (j \in [seq e.1 | e <- nth [::] rows i]); first exact.
have [/at_entry ji|out_j] := boolP (i \in [seq e.1 | e <- nth [::] rows j]).
  by rewrite ji.
by rewrite !lookup_none.
Qed.

Section Sound.

Variables (R : realFieldType) (n : nat) (rows : seq sparse_row) (b : form_bound).
Hypothesis checked : bounded_rows n rows b.
Notation fi := (iota 0 n).
Notation row_entry i k := (toR (lookup (nth [::] rows i) k) : R).

Lemma bound_times_gt0 : 0 < toR (bound_times b) :> R.
Proof. by case/and5P: checked => ? *; rewrite toR_gt0. Qed.

Lemma bound_at_ge0 : 0 <= toR (bound_at b) :> R.
Proof. by case/and5P: checked => _ ? *; rewrite toR_ge0. Qed.

Lemma size_bounded : size rows = n.
Proof. by case/and5P: checked => _ _ _ /eqP. Qed.

Lemma bounded_lookup_sym i k : (i < n)%N -> (k < n)%N ->
  lookup (nth [::] rows i) k = lookup (nth [::] rows k) i.
Proof.
by case/and5P: checked => _ _ _ /eqP<- /and3P[_ sym _]; apply: symmetric_lookup.
Qed.

Theorem bounded_rows_sound (z : nat -> R) :
  toR (bound_at b) * (\sum_(k <- fi) z k ^+ 2) <=
  toR (bound_times b) * (\sum_(i <- fi) \sum_(k <- fi) z i * row_entry i k * z k).
Proof.
have lookup_sym_ := bounded_lookup_sym.
case/and5P: checked => _ _ m0 /eqP size_n /and3P[/eqP size_g _ cov].
set both := zip _ (gram_rows b) in cov; set s := fun r s' : numbered => _ in cov.
pose d := ((0%N, [::] : seq Z), (0%N, [::] : seq Z)).
have size_z f : size (map_from f 0 rows : seq numbered) = n by rewrite size_map_from.
have size_b : size both = n by rewrite size_zip size_z size_g minnn.
have rowE i : (i < n)%N -> (nth d both i).1 =
    (i, spread (shifted_row (bound_times b) (bound_at b) i (nth [::] rows i))).
  move=> lt_i; rewrite nth_zip ?size_z ?size_g //=.
  by rewrite (nth_map_from [::]) ?size_n // add0n.

have sE i j : (i < n)%N -> (j < n)%N -> s (nth d both i).1 (nth d both j).1 =
    (bound_times b * lookup (nth [::] rows i) j - (if i == j then bound_at b else 0))%Z.
  by move=> Hi Hj; rewrite !rowE // -lookup_shifted -nth_spread.
have sym : symmetric_rows d s both.
  by move=> i j; rewrite size_b => Hi Hj; rewrite !sE // eq_sym (lookup_sym_ _ _ Hi Hj).
have [form0 _] := covered_form (strict := false) z (late_gram R d both m0) sym cov.

move: form0; rewrite /form size_b.
have -> : \sum_(i <- fi) \sum_(j <- fi) z i * toR (s (nth d both i).1 (nth d both j).1) * z j =
          toR (bound_times b) * (\sum_(i <- fi) \sum_(k <- fi) z i * row_entry i k * z k) -
          toR (bound_at b) * (\sum_(k <- fi) z k ^+ 2).
  have -> : \sum_(k <- fi) z k ^+ 2 =
            \sum_(i <- fi) \sum_(j <- fi) (if i == j then z i * z j else 0).
    apply: sum_eq => i Hi; rewrite (bigD1_seq i) ?iota_uniq //= eqxx big1 ?addr0 //.
    by move=> j /negbTE; rewrite eq_sym => ->.
  rewrite !mulr_sumr -sumrB; apply: sum_eq => i; rewrite mem_iota add0n /= => Hi.
  rewrite !mulr_sumr -sumrB; apply: sum_eq => j; rewrite mem_iota add0n /= => Hj.
  rewrite sE // toRB toRM; move: (toR (lookup _ _)) => f.
  by case: eqP => _; rewrite ?toR0; move: (toR _) (toR _) => *; ring.
by rewrite subr_ge0.
Qed.

End Sound.
