(* Quadratic eigenvalue problems, and their linear form.

   A solution of the quadratic problem (A, B, C) is a value t and a vector x != 0 with

       0 <= x,   0 <= y,   x_i y_i = 0,   y = (A + t B + t^2 C) x.

   For t >= 0 it is a pencil of order 2 n in x and z = x / (1 + t), of which z is free
   ([linearized], Rational.v): its last rows say (1 + t) z = x, and its first are y / (1 + t).

   Theorems [linearized_solution], [solution_of_linearized]: for t >= 0 the solutions of both
   correspond one to one.
   Theorem [linearized_equivalent]: what is said of the linear form is said of the solutions of the
   quadratic problem with t >= 0.
   Theorem [reflected_quadratic_equivalent]: what is said of (A, -B, C) is said of the solutions of
   (A, B, C) with t <= 0, -t in place of t.

   Page: spec/certificates.md, 5.2 (Quadratic problems). *)

From Mceip Require Import Base Lists Integers Sums Tree Cover Condensation Pencil Signs Rational
  Statement Integral Reflection.

Section Quadratic.

Variables (R : rcfType) (q : rational_quadratic).
Implicit Types (t s : R) (x : nat -> R).

Notation n := (quadratic_order q).
Notation L := (linearized q).
Notation a := (given_entry R (quadratic_a q)).
Notation b := (given_entry R (quadratic_b q)).
Notation c := (given_entry R (quadratic_c q)).

(* Entries of the linear form. *)

Lemma row_within (row : rational_row) j :
  row_entry [seq e <- row | (e.1 < n)%N] j = if (j < n)%N then row_entry row j else 0 :> R.
Proof.
rewrite big_filter; case: ifPn => [lt_j|ge_j].
  rewrite [RHS](bigID (fun e => (e.1 < n)%N)) /= [X in _ + X]big1 ?addr0 // => e.
  by case: eqP => // ->; rewrite lt_j.
by apply: big1 => e lt_e; case: eqP => // eq; rewrite -eq lt_e in ge_j.
Qed.

Lemma row_behind (row : rational_row) j :
  row_entry [seq ((n + e.1)%N, e.2) | e <- row] j =
  if (n <= j)%N then row_entry row (j - n)%N else 0 :> R.
Proof.
rewrite big_map; case: ifPn => [ge_j|lt_j]; last first.
  by apply: big1 => e _ /=; case: eqP => // eq; rewrite -eq leq_addr in lt_j.
by apply: eq_bigr => e _ /=; rewrite -{1}(subnKC ge_j) eqn_add2l.
Qed.

Definition entriesE := (big_cat, opposite_row_entry, row_behind, row_within).

Lemma linear_x i j : (i < n)%N -> (j < n)%N ->
  given_entry R (given_a L) i j = b i j - c i j /\ given_entry R (given_b L) i j = c i j.
Proof.
move=> lt_i lt_j; rewrite /given_entry !nth_cat !size_map size_iota lt_i.
rewrite !(nth_map 0%N) ?size_iota // nth_iota // !entriesE lt_j leqNgt lt_j /=.
by rewrite addr0.
Qed.

Lemma linear_z i j : (i < n)%N -> (j < n)%N ->
  given_entry R (given_a L) i (n + j)%N = a i j - b i j + c i j /\
  given_entry R (given_b L) i (n + j)%N = 0.
Proof.
move=> lt_i lt_j; rewrite /given_entry !nth_cat !size_map size_iota lt_i.
rewrite !(nth_map 0%N) ?size_iota // nth_iota // !entriesE leq_addr addKn lt_j.
by rewrite ltnNge leq_addr /= oppr0 !add0r addrA.
Qed.

Lemma linear_free i j : (i < n)%N -> given_entry R (given_a L) (n + i)%N j =
  (if j == (n + i)%N then 1 else 0) - (if j == i then 1 else 0) /\
  given_entry R (given_b L) (n + i)%N j = if j == (n + i)%N then 1 else 0.
Proof.
move=> lt_i; rewrite /given_entry !nth_cat !size_map size_iota ltnNge leq_addr addKn /=.
rewrite !(nth_map 0%N) ?size_iota // nth_iota // !big_cons !big_nil /= /fraction /=.
have -> : toR (-1)%Z = -1 :> R by exact: (toRN R 1).
rewrite toR1 ![_ == j]eq_sym divr1 invr1 mulr1 !addr0 add0n addrC; split=> //.
by case: (j == i); rewrite ?oppr0.
Qed.

(* Rows of the linear form. *)

Notation y' t x i := (product (n + n) (given_a L) (given_b L) t x i).

Lemma halves (f : nat -> R) : \sum_(j <- iota 0 (n + n)) f j =
  \sum_(j <- iota 0 n) f j + \sum_(j <- iota 0 n) f (n + j)%N.
Proof. by rewrite iotaD big_cat add0n -{2}[n]addn0 iotaDl big_map. Qed.

Lemma one_term (f : nat -> R) i : (i < n + n)%N ->
  \sum_(j <- iota 0 (n + n)) (if j == i then f j else 0) = f i.
Proof.
move=> lt_i; rewrite (bigD1_seq i) ?mem_iota ?iota_uniq //= eqxx big1 ?addr0 //.
by move=> j /negbTE->.
Qed.

Lemma free_row t x i : (i < n)%N -> y' t x (n + i)%N = (1 + t) * x (n + i)%N - x i.
Proof.
move=> lt_i; rewrite -(one_term (fun j => (1 + t) * x j) (i := n + i)) ?ltn_add2l //.
rewrite -(one_term x (i := i)) ?ltn_addr // -sumrB; apply: eq_bigr => j _.
have [-> ->] := linear_free j lt_i.
by case: (j == (n + i)%N); case: (j == i) => /=; move: (x j) => ?; ring.
Qed.

Lemma one_t_gt0 t : 0 <= t -> 0 < 1 + t.
Proof. by move=> t0; rewrite ltr_paddr ?ltr01. Qed.

Lemma inverse_gt0 t : 0 <= t -> 0 < (1 + t)^-1.
Proof. by move/one_t_gt0; rewrite invr_gt0. Qed.

Lemma form_row t x i : 0 <= t -> (i < n)%N ->
  (forall j, j \in iota 0 n -> x (n + j)%N = x j / (1 + t)) ->
  y' t x i = quadratic_product q t x i / (1 + t).
Proof.
move=> t0 lt_i z_is; rewrite /product halves -big_split /quadratic_product mulr_suml /=.
apply: sum_eq => j j_in; have lt_j : (j < n)%N by move: j_in; rewrite mem_iota.
have [-> ->] := linear_x lt_i lt_j; have [-> ->] := linear_z lt_i lt_j.
rewrite z_is //; move: (a i j) (b i j) (c i j) => *; field.
by rewrite gt_eqF // one_t_gt0.
Qed.

(* The numbers of x_i and of z_i. *)
Lemma in_halves i : i \in iota 0 n -> i \in iota 0 (n + n) /\ (n + i)%N \in iota 0 (n + n).
Proof. by rewrite !mem_iota !add0n /= ltn_add2l => lt_i; rewrite ltn_addr. Qed.

Lemma number_of_z i : (n <= i)%N -> i \in iota 0 (n + n) -> (i - n)%N \in iota 0 n.
Proof. by move=> ge_i; rewrite !mem_iota !add0n /= ltn_subLR. Qed.

(* x and z *)
Definition with_z t x i := if (i < n)%N then x i else x (i - n)%N / (1 + t).

Lemma with_z_x t x i : i \in iota 0 n -> with_z t x i = x i.
Proof. by rewrite mem_iota /with_z add0n /= => ->. Qed.

Lemma with_z_z t x i : with_z t x (n + i)%N = x i / (1 + t).
Proof. by rewrite /with_z ltnNge leq_addr addKn. Qed.

(* The free rows demand this z. *)
Lemma z_of_rows t x : 0 <= t -> (forall i, i \in iota n n -> y' t x i = 0) ->
  forall i, i \in iota 0 (n + n) -> x i = with_z t x i.
Proof.
move=> t0 rows i; rewrite mem_iota add0n /= /with_z => lt_i; case: ltnP => // ge_i.
have /eqP : y' t x (n + (i - n))%N = 0 by apply: rows; rewrite subnKC // mem_iota ge_i.
have nz : 1 + t != 0 by rewrite gt_eqF // one_t_gt0.
rewrite free_row ?ltn_subLR // subr_eq0 subnKC // => /eqP <-.
by field.
Qed.

Lemma linear_numbers : [seq i <- iota 0 (n + n) | i \notin iota n n] = iota 0 n.
Proof.
rewrite iotaD filter_cat add0n [X in _ ++ X](eq_in_filter (a2 := pred0)); last by move=> i /= ->.
rewrite filter_pred0 cats0 (eq_in_filter (a2 := predT)) ?filter_predT // => i.
by rewrite !mem_iota add0n /= => lt_i; rewrite leqNgt lt_i.
Qed.

(* Solutions correspond one to one. *)
Theorem linearized_solution t x : 0 <= t ->
  quadratic_solves q t x -> eigenvalue_solves L t (with_z t x).
Proof.
move=> t0 [[i i_in xi] rows]; have z_is j : j \in iota 0 n ->
    with_z t x (n + j)%N = with_z t x j / (1 + t) by move=> j_in; rewrite with_z_z with_z_x.
split=> [|j|j].
- by have [in_x _] := in_halves i_in; exists i; rewrite ?with_z_x.
- rewrite mem_iota => /andP[ge_j lt_j]; rewrite -(subnKC ge_j).
  have lt_k : (j - n < n)%N by rewrite ltn_subLR.
  rewrite free_row // z_is ?mem_iota //; field.
  by rewrite gt_eqF // one_t_gt0.
rewrite /= linear_numbers => j_in; rewrite form_row //; last by move: j_in; rewrite mem_iota.
have -> : quadratic_product q t (with_z t x) j = quadratic_product q t x j.
  by apply: sum_eq => k k_in; rewrite with_z_x.
by rewrite with_z_x // mulrC; apply/(complementary_scaled _ _ (inverse_gt0 t0))/rows.
Qed.

Theorem solution_of_linearized t x : 0 <= t -> eigenvalue_solves L t x ->
  quadratic_solves q t x /\ forall i, i \in iota 0 (n + n) -> x i = with_z t x i.
Proof.
move=> t0 [[i i_in xi] free rows]; have z_is := z_of_rows t0 free; split=> //.
split=> [|j j_in].
  have [lt_i|ge_i] := ltnP i n; first by exists i; rewrite ?mem_iota.
  exists (i - n)%N; first exact: number_of_z.
  apply: contraNneq xi => x0.
  by rewrite z_is // /with_z ltnNge ge_i x0 mul0r.
rewrite /= linear_numbers in rows; have := rows j j_in.
rewrite form_row ?(mulrC (quadratic_product _ _ _ _)) => [|//||k k_in].
- by move=> /(complementary_scaled _ _ (inverse_gt0 t0)).
- by move: j_in; rewrite mem_iota.
by have [in_x in_z] := in_halves k_in; rewrite (z_is _ in_z) with_z_z.
Qed.

Theorem linearized_equivalent :
  equivalent_by with_z (quadratic_semantics R q) (pencil_semantics R L).
Proof.
split; rewrite /= ?linear_numbers ?size_iota //.
- by move=> t x [t0 /(linearized_solution t0)].
- by move=> t x [t0 /(solution_of_linearized t0)[]].
- by move=> t x j lt_j; rewrite with_z_x // mem_nth // size_iota.
- by move=> t x x'; split=> -[f f0 eq]; exists f => // i i_in; rewrite eq // with_z_x.
- by move=> t x x'; split=> -[f f0 eq]; exists f => // i i_in; rewrite -eq // with_z_x.
- move=> t x x' [t0 /(solution_of_linearized t0)[_ z_is]].
  case=> _ /(solution_of_linearized t0)[_ z_is'].
  split=> -[f f0 eq]; exists f => // i i_in; last by apply: eq; have [] := in_halves i_in.
  rewrite z_is // z_is' // /with_z; have [lt_i|ge_i] := ltnP i n.
    by rewrite eq // mem_iota.
  by rewrite eq ?mulrA //; apply: number_of_z.
- by move=> x j _; exists 1; rewrite ?ltr01 // mul1r.
move=> t x j [t0 /(solution_of_linearized t0)[_ z_is]] lt_j.
exists (1 + t)^-1; first exact: inverse_gt0.
rewrite nth_iota // form_row // => [|k k_in]; first exact: mulrC.
by have [in_x in_z] := in_halves k_in; rewrite (z_is _ in_z) with_z_z.
Qed.

End Quadratic.

Theorem reflected_quadratic_equivalent (R : rcfType) q :
  equivalent (negative_quadratic_semantics R q) (quadratic_semantics R (reflected_quadratic q)).
Proof.
have rowsE (s : R) x i : quadratic_product q (- s) x i =
    quadratic_product (reflected_quadratic q) s x i.
  by apply: eq_bigr => j _; rewrite opposite_entry mulrN mulNr sqrrN.
apply: same_rows_equivalent => // s x.
by split=> -[nonzero rows]; split=> // i i_in; [rewrite -rowsE | rewrite rowsE]; apply: rows.
Qed.
