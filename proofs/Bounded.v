(* Sparse matrices bounded from below.

   A matrix S is given by sparse rows; it need not be symmetric.  Numbers c > 0, d >= 0, m >= 0 and
   a factor L with rows that begin at their first entry are witness of z'Sz >= (d/c) z'z: the matrix
   c (S + S') - 2 d I is covered by 2 m L L' (Covered.v).

   The checker makes the rows of S' once ([transposed]).  It writes out each row of
   c (S + S') - 2 d I and walks along it and the rows of L together; no numbers of columns are
   compared (Places.v says why).

   Theorem [bounded_rows_sound]: c z'S z >= d z'z for every z.  [lookup_transposed]: the entries of
   S'.  [symmetric_lookup]: rows that pass [symmetric_rows_sparse] are those of a symmetric matrix.

   Page: spec/certificates.md, 5.14 (sigma).  Rust: crates/check/src/cover/psd.rs. *)

From Mceip Require Import Base Integers Sums Covered.

(* A sparse row: column and entry.  Entries of one column are summed. *)
Definition sparse_row := seq (nat * Z).

Definition lookup (row : sparse_row) (j : nat) : Z :=
  foldr (fun entry sum => if entry.1 == j then (entry.2 + sum)%Z else sum) 0%Z row.

Definition times_row (c : Z) (row : sparse_row) : sparse_row := [seq (e.1, c * e.2)%Z | e <- row].

Lemma lookup_times c row j : lookup (times_row c row) j = (c * lookup row j)%Z.
Proof.
elim: row => [|e row IH] /=; first by rewrite Z.mul_0_r.
by case: eqP => _; rewrite IH // Z.mul_add_distr_l.
Qed.

Lemma lookup_cat row row' j : lookup (row ++ row') j = (lookup row j + lookup row' j)%Z.
Proof. by elim: row => //= e row IH; case: eqP => _; rewrite IH // Z.add_assoc. Qed.

(* c, d, m and L: c (S + S') - 2 d I is covered by 2 m L L'. *)
Record form_bound := FormBound {
  bound_times : Z;
  bound_at : Z;
  gram_times : Z;
  gram_rows : seq late_row }.

Section Checker.

Local Open Scope Z_scope.

(* The entries of the rows, from number i on, at their columns; for n columns. *)
Fixpoint columns_from n i (rows : seq sparse_row) : seq sparse_row :=
  if rows is row :: rows' then
    foldr (fun e table => set_nth [::] table e.1 ((i, e.2) :: nth [::] table e.1))
      (columns_from n i.+1 rows') row
  else nseq n [::].

(* The rows of the transposed matrix, which is square. *)
Definition transposed (rows : seq sparse_row) := columns_from (size rows) 0 rows.

Definition doubled_rows (rows : seq sparse_row) :=
  [seq r.1 ++ r.2 | r <- zip rows (transposed rows)].

(* A row with its entries at all columns. *)
Definition spread (row : sparse_row) : seq Z :=
  foldr (fun e dense => set_nth 0 dense e.1 (e.2 + nth 0 dense e.1)) [::] row.

(* Row i of c S - d I. *)
Definition shifted_row c d i (row : sparse_row) : sparse_row :=
  (i, - d) :: times_row c row.

(* An entry (j, _) of row i is compared with entry i of row j. *)
Definition symmetric_rows_sparse (rows : seq sparse_row) :=
  all_from (fun i row => all (fun e => lookup row e.1 =? lookup (nth [::] rows e.1) i) row) 0 rows.

(* The sum of |S_ij - m a b_j| over all j, for a row of S that is written out. *)
Fixpoint distance (m : Z) (row : seq Z) (a : late_row) (factor : seq late_row) : Z :=
  if factor is b :: factor' then
    Z.abs (head 0 row - m * late_dot a b) + distance m (behead row) a factor'
  else 0.

(* The sum over all j is at most twice the term of the diagonal, so that the others together are at
   most this term. *)
Definition row_bounded c d m (factor : seq late_row) i (r : sparse_row * late_row) :=
  let row := spread (shifted_row c d i r.1) in
  distance m row r.2 factor <=? 2 * (nth 0 row i - m * late_dot r.2 r.2).

Definition bounded_rows n (rows : seq sparse_row) (b : form_bound) :=
  [&& 0 <? bound_times b, 0 <=? bound_at b, 0 <=? gram_times b, size rows == n,
      size (gram_rows b) == n &
      all_from (row_bounded (bound_times b) (2 * bound_at b) (2 * gram_times b) (gram_rows b)) 0
        (zip (doubled_rows rows) (gram_rows b))].

End Checker.

Lemma nth_spread row j : nth 0%Z (spread row) j = lookup row j.
Proof.
elim: row => [|e row IH] /=; first by rewrite nth_nil.
by rewrite nth_set_nth /= eq_sym -IH; case: eqP => [->|].
Qed.

Lemma lookup_shifted c d i row j :
  lookup (shifted_row c d i row) j = (c * lookup row j - (if i == j then d else 0))%Z.
Proof.
by rewrite /= lookup_times; case: eqP => _; [rewrite Z.add_comm | rewrite Z.sub_0_r].
Qed.

Lemma all_from_intro T (d : T) (f : nat -> T -> bool) l a :
  (forall j, (j < size l)%N -> f (a + j)%N (nth d l j)) -> all_from f a l.
Proof.
elim: l a => //= x l IH a ok; have := ok 0%N; rewrite addn0 => -> //=.
by apply: IH => j lt_j; rewrite addSnnS; apply: (ok j.+1).
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

Section Transposed.

Variable n : nat.

Lemma lookup_columns i rows j k : lookup (nth [::] (columns_from n i rows) j) k =
  if (i <= k)%N then lookup (nth [::] rows (k - i)) j else 0%Z.
Proof.
elim: rows i => [|row rows IH] i /=.
  by rewrite nth_nseq !if_same nth_nil if_same.
have -> table : lookup (nth [::] (foldr (fun e t =>
      set_nth [::] t e.1 ((i, e.2) :: nth [::] t e.1)) table row) j) k =
    ((if i == k then lookup row j else 0) + lookup (nth [::] table j) k)%Z.
  elim: row => [|e row IHr] /=; first by rewrite if_same.
  rewrite nth_set_nth /=; case: (eqVneq j e.1) => [je|ne]; last by rewrite IHr.
  by rewrite /= -je IHr; case: eqP => _; rewrite ?Z.add_assoc.
rewrite IH; case: (ltngtP i k) => [lt|lt|->]; last by rewrite subnn Z.add_0_r.
  by rewrite -(subnSK lt) /=.
by [].
Qed.

Lemma columns_range i rows j :
  all (fun e => e.1 < i + size rows)%N (nth [::] (columns_from n i rows) j).
Proof.
elim: rows i => [|row rows IH] i /=; first by rewrite nth_nseq if_same.
elim: row => [|e row IHr] /=; first by rewrite addnS -addSn IH.
rewrite nth_set_nth /=; case: eqP => [je|_] //=.
by rewrite -je IHr andbT -[X in (X < _)%N]addn0 ltn_add2l.
Qed.

Lemma size_columns i rows : all (all (fun e => e.1 < n)%N) rows ->
  size (columns_from n i rows) = n.
Proof.
elim: rows i => [|row rows IH] i /=; first by rewrite size_nseq.
case/andP => + /IH; elim: row => [_ ->//|e row IHr] /= /andP[lt_e range] size_n.
by rewrite size_set_nth IHr //; apply/maxn_idPr.
Qed.

Lemma size_columns_ge i rows : (n <= size (columns_from n i rows))%N.
Proof.
elim: rows i => [|row rows IH] i /=; first by rewrite size_nseq.
by elim: row => //= e row IHr; rewrite size_set_nth leq_max IHr orbT.
Qed.

End Transposed.

Lemma lookup_transposed rows j k :
  lookup (nth [::] (transposed rows) j) k = lookup (nth [::] rows k) j.
Proof. by rewrite lookup_columns subn0. Qed.

Lemma transposed_range rows j : all (fun e => e.1 < size rows)%N (nth [::] (transposed rows) j).
Proof. exact: columns_range. Qed.

Lemma size_transposed rows : all (all (fun e => e.1 < size rows)%N) rows ->
  size (transposed rows) = size rows.
Proof. exact: size_columns. Qed.

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

Lemma size_doubled : size (doubled_rows rows) = n.
Proof. by rewrite size_map size_zip (minn_idPl (size_columns_ge _ _ _)) size_bounded. Qed.

Lemma lookup_doubled i k : (i < n)%N -> lookup (nth [::] (doubled_rows rows) i) k =
  (lookup (nth [::] rows i) k + lookup (nth [::] rows k) i)%Z.
Proof.
rewrite -size_doubled size_map => lt_i; rewrite (nth_map ([::], [::])) //.
by rewrite nth_zip_cond lt_i lookup_cat lookup_transposed.
Qed.

Definition shifted_entry (r s : nat * sparse_row) : Z :=
  (bound_times b * lookup r.2 s.1 - (if r.1 == s.1 then 2 * bound_at b else 0))%Z.

Notation product := (fun r s => 2 * gram_times b * late_dot r s)%Z.
Notation both := (zip (zip fi (doubled_rows rows)) (gram_rows b)).
Notation none := ((0%N, [::] : sparse_row), (0%N, [::] : seq Z)).

Lemma size_both : size both = n.
Proof.
case/and5P: checked => _ _ _ _ /andP[/eqP size_g _].
by rewrite !size_zip size_iota size_doubled size_g !minnn.
Qed.

Lemma nth_both i : (i < n)%N ->
  nth none both i = ((i, nth [::] (doubled_rows rows) i), nth (0%N, [::]) (gram_rows b) i).
Proof.
case/and5P: checked => _ _ _ _ /andP[/eqP size_g _] lt_i.
by rewrite !nth_zip ?size_zip ?size_iota ?size_doubled ?size_g ?minnn // nth_iota.
Qed.

Lemma toR_distance m row a factor :
  toR (distance m row a factor) = \sum_(j <- iota 0 (size factor))
    toR (Z.abs (nth 0 row j - m * late_dot a (nth (0%N, [::]) factor j))%Z) :> R.
Proof.
elim: factor row => [|r factor IH] row; first by rewrite big_nil.
rewrite /= big_cons toRD IH (sum_shift 1) nth0; congr (_ + _).
by apply: eq_bigr => j _; rewrite nth_behead.
Qed.

Lemma rows_covered : covered shifted_entry product false both.
Proof.
have sb := size_both; rewrite /covered; apply: (all_from_intro (d := none)) => i.
rewrite sb add0n => lt_i.
case/and5P: checked => _ _ _ _ /andP[/eqP size_g bounds]; have size_n := size_doubled.
rewrite nth_both //; set r := nth [::] (doubled_rows rows) i; set g := nth _ (gram_rows b) i.
have := all_from_nth ([::], (0%N, [::])) bounds (j := i).
rewrite size_zip size_n size_g minnn add0n nth_zip ?size_n ?size_g // -/r -/g => /(_ lt_i).
rewrite /row_bounded -[(r, g).1]/r -[(r, g).2]/g nth_spread lookup_shifted -!(toR_le R) toRM.
set rest := off_diagonal _ _ _ _ _; pose e := remainder shifted_entry product (i, r, g) (i, r, g).
rewrite -[(_ - _ - _)%Z]/e.

(* The sum over all j is that over the others and the term of the diagonal. *)
have rowE j : nth 0%Z (spread (shifted_row (bound_times b) (2 * bound_at b) i r)) j =
    (bound_times b * lookup r j - (if i == j then 2 * bound_at b else 0))%Z.
  by rewrite nth_spread lookup_shifted.
have -> : toR (distance (2 * gram_times b)
                 (spread (shifted_row (bound_times b) (2 * bound_at b) i r)) g (gram_rows b)) =
          toR rest + `|toR e| :> R.
  rewrite toR_distance size_g /rest /off_diagonal (toR_sum_from R none) sb.
  move: (spread _) rowE => row rowE.
  have in_i : i \in fi by rewrite mem_iota.
  rewrite (bigD1_seq i) ?iota_uniq //= [in RHS](bigD1_seq i) ?iota_uniq //= eqxx toR0 add0r.
  rewrite addrC -toR_abs rowE; congr (_ + _).
  rewrite big_seq_cond [RHS]big_seq_cond; apply: eq_bigr => j /andP[].
  rewrite mem_iota add0n /= => lt_j /negbTE->.
  by rewrite subn0 nth_both // rowE.
move=> le; rewrite -(ler_add2r `|toR e|) (le_trans le) //.
by rewrite [toR 2]/(1 + 1) mulrDl mul1r ler_add2l ler_norm.
Qed.

Theorem bounded_rows_sound (z : nat -> R) :
  toR (bound_at b) * (\sum_(k <- fi) z k ^+ 2) <=
  toR (bound_times b) * (\sum_(i <- fi) \sum_(k <- fi) z i * row_entry i k * z k).
Proof.
have m0 : (0 <=? 2 * gram_times b)%Z.
  by case/and5P: checked => _ _ m0 _ _; move: m0; clear; lia.
have sE i j : (i < n)%N -> (j < n)%N ->
    shifted_entry (nth none both i).1 (nth none both j).1 =
    (bound_times b * (lookup (nth [::] rows i) j + lookup (nth [::] rows j) i) -
     (if i == j then 2 * bound_at b else 0))%Z.
  by move=> Hi Hj; rewrite !nth_both // -lookup_doubled.
have sym : symmetric_rows none shifted_entry both.
  by move=> i j; rewrite size_both => Hi Hj; rewrite !sE // eq_sym Z.add_comm.
have [form0 _] := covered_form (strict := false) z (late_gram R none both m0) sym rows_covered.

move: form0; rewrite /form size_both.
have -> : \sum_(i <- fi) \sum_(j <- fi)
            z i * toR (shifted_entry (nth none both i).1 (nth none both j).1) * z j =
          (toR (bound_times b) * (\sum_(i <- fi) \sum_(k <- fi) z i * row_entry i k * z k) -
           toR (bound_at b) * (\sum_(k <- fi) z k ^+ 2)) *+ 2.
  have -> : \sum_(k <- fi) z k ^+ 2 =
            \sum_(i <- fi) \sum_(j <- fi) (if i == j then z i * z j else 0).
    apply: sum_eq => i Hi; rewrite (bigD1_seq i) ?iota_uniq //= eqxx big1 ?addr0 //.
    by move=> j /negbTE; rewrite eq_sym => ->.
  have swap : \sum_(i <- fi) \sum_(k <- fi) z i * row_entry i k * z k =
              \sum_(i <- fi) \sum_(k <- fi) z i * row_entry k i * z k.
    rewrite exchange_big; apply: eq_bigr => i _; apply: eq_bigr => k _.
    by rewrite mulrAC [z k * _]mulrC mulrAC.
  rewrite mulr2n {1}swap !mulr_sumr -!sumrB -big_split.
  apply: sum_eq => i; rewrite mem_iota add0n /= => Hi.
  rewrite !mulr_sumr -!sumrB -big_split; apply: sum_eq => j; rewrite mem_iota add0n /= => Hj.
  rewrite sE // toRB toRM toRD; move: (toR (lookup _ _)) (toR (lookup _ _)) => f g.
  have two : toR (2 * bound_at b) = 2%:R * toR (bound_at b) :> R by rewrite toRM.
  by case: eqP => _; rewrite ?two ?toR0; move: (toR _) (toR _) => *; ring.
by rewrite pmulrn_lge0 // subr_ge0.
Qed.

End Sound.
