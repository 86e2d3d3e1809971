(* Positive definite integer matrices, shown by a factor.

   Let S be a symmetric integer matrix and G = L D L' with a diagonal D >= 0.  The matrix S is
   *covered* by the factor L if the remainder E = S - G is diagonally dominant,

       E_ii >= sum_(j != i) |E_ij|   for every i,

   and *strictly* covered if > holds in place of >=.

   Theorem [covered_form]: if S is covered, then z' S z >= 0 for every vector z; if it is strictly
   covered, then z' S z > 0 for every z != 0.

   The factor is a witness that somebody else found; no root is taken and nothing is divided.  It
   comes in two shapes: dense rows with weights (for orders below 130), and rows that begin at
   their first entry, without weights (for hundreds of degrees of freedom).  The theorem asks only
   that the products of rows are those of a Gram matrix.

   Page: spec/certificates.md, 5.14 ("S is covered by L"), 5.9, 5.10.
   Rust: crates/check/src/cover/psd.rs, enclosed_definite.rs. *)

From Mceip Require Import Base Integers Sums.

(* Sums, conjunctions and maps over a list whose elements are counted from k. *)
Fixpoint sum_from T (f : nat -> T -> Z) (k : nat) (l : seq T) : Z :=
  if l is x :: l' then (f k x + sum_from f k.+1 l')%Z else 0%Z.

Fixpoint all_from T (f : nat -> T -> bool) (k : nat) (l : seq T) : bool :=
  if l is x :: l' then f k x && all_from f k.+1 l' else true.

Fixpoint map_from T U (f : nat -> T -> U) (k : nat) (l : seq T) : seq U :=
  if l is x :: l' then f k x :: map_from f k.+1 l' else [::].

Section Checker.

Local Open Scope Z_scope.

(* T: what names a row of S; U: a row of the factor. *)
Variables (T U : Type) (s : T -> T -> Z) (product : U -> U -> Z).

Definition remainder (a b : T * U) := s a.1 b.1 - product a.2 b.2.

Definition off_diagonal (rows : seq (T * U)) i a :=
  sum_from (fun j b => if j == i then 0 else Z.abs (remainder a b)) 0 rows.

Definition covered (strict : bool) (rows : seq (T * U)) :=
  all_from (fun i a => if strict then off_diagonal rows i a <? remainder a a
                       else off_diagonal rows i a <=? remainder a a) 0 rows.

(* Dense rows with weights. *)
Fixpoint weighted_dot (w a b : seq Z) : Z :=
  match w, a, b with
  | u :: w', x :: a', y :: b' => u * (x * y) + weighted_dot w' a' b'
  | _, _, _ => 0
  end.

Fixpoint dot (a b : seq Z) : Z :=
  match a, b with x :: a', y :: b' => x * y + dot a' b' | _, _ => 0 end.

(* A row that begins with entry number a.1; the entries before it are 0. *)
Definition late_row := (nat * seq Z)%type.

Definition late_dot (a b : late_row) : Z :=
  if (a.1 <= b.1)%N then dot (drop (b.1 - a.1) a.2) b.2 else dot a.2 (drop (a.1 - b.1) b.2).

End Checker.

Section Lists.

Variable R : realFieldType.

Lemma toR_sum_from T (d : T) f l a :
  toR (sum_from f a l) = \sum_(j <- iota a (size l)) toR (f j (nth d l (j - a))) :> R.
Proof.
elim: l a => [|x l IH] a; first by rewrite big_nil.
rewrite /= big_cons toRD IH subnn; congr (_ + _).
apply: sum_eq => j; rewrite mem_iota => /andP[aj _].
by rewrite -(subnSK aj).
Qed.

Lemma all_from_nth T (d : T) f l a :
  all_from f a l -> forall j, (j < size l)%N -> f (a + j)%N (nth d l j).
Proof.
elim: l a => [|x l IH] a //= /andP[h1 h2] [|j] jl; first by rewrite addn0.
by rewrite /= -addSnnS; apply: IH.
Qed.

Lemma nth_map_from T U (d : T) (e : U) f l a j :
  (j < size l)%N -> nth e (map_from f a l) j = f (a + j)%N (nth d l j).
Proof.
elim: l a j => [|x l IH] a [|j] //= jl; first by rewrite addn0.
by rewrite IH // addSnnS.
Qed.

Lemma size_map_from T U (f : nat -> T -> U) l a : size (map_from f a l) = size l.
Proof. by elim: l a => //= x l IH a; rewrite IH. Qed.

Lemma toR_dot n a b : (size a <= n)%N ->
  toR (dot a b) = \sum_(k <- iota 0 n) toR (nth 0%Z a k) * toR (nth 0%Z b k) :> R.
Proof.
elim: a b n => [|x a IH] b n.
  by move=> _; rewrite sum_zero // => k _; rewrite nth_nil mul0r.
case: n => // n sn; rewrite /= big_cons; case: b => [|y b] /=.
  by rewrite toR0 mulr0 add0r sum_zero // => k _; rewrite nth_nil mulr0.
by rewrite toRD toRM (IH _ n) // (sum_shift 1).
Qed.

Lemma toR_weighted_dot n w a b : (size w <= n)%N ->
  toR (weighted_dot w a b) =
  \sum_(k <- iota 0 n) toR (nth 0%Z w k) * (toR (nth 0%Z a k) * toR (nth 0%Z b k)) :> R.
Proof.
elim: w a b n => [|u w IH] a b n.
  by move=> _; rewrite sum_zero // => k _; rewrite nth_nil mul0r.
case: n => // n sn; rewrite /= big_cons; case: a => [|x a] /=.
  by rewrite toR0 mul0r mulr0 add0r sum_zero // => k _; rewrite nth_nil mul0r mulr0.
case: b => [|y b] /=.
  by rewrite toR0 !mulr0 add0r sum_zero // => k _; rewrite nth_nil !mulr0.
by rewrite toRD !toRM (IH _ _ n) // (sum_shift 1).
Qed.

Definition late_entry (a : late_row) k : Z :=
  if (k < a.1)%N then 0%Z else nth 0%Z a.2 (k - a.1).

Lemma toR_late_dot_one_first n c a b f : (f + size a <= n)%N ->
  toR (dot a (drop c b)) = \sum_(k <- iota 0 n)
    (if (k < f)%N then 0 else toR (nth 0%Z a (k - f)) * toR (nth 0%Z b (c + (k - f)))) :> R.
Proof.
move=> le_n; have fn : n = (f + (n - f))%N by rewrite subnKC // (leq_trans _ le_n) // leq_addr.
rewrite fn iotaD big_cat /= add0n sum_zero ?add0r; last first.
  by move=> k; rewrite mem_iota => /andP[_ ->].
rewrite (@toR_dot (n - f)); last by rewrite -(leq_add2l f) -fn.
rewrite [RHS]sum_shift; apply: eq_bigr => k _.
by rewrite ltnNge leq_addr /= addKn nth_drop.
Qed.

Lemma dotC a b : dot a b = dot b a.
Proof. by elim: a b => [|x l IH] [|y m] //=; rewrite IH Z.mul_comm. Qed.

Lemma toR_late_dot n a b : (a.1 + size a.2 <= n)%N -> (b.1 + size b.2 <= n)%N ->
  toR (late_dot a b) =
  \sum_(k <- iota 0 n) toR (late_entry a k) * toR (late_entry b k) :> R.
Proof.
move=> le_a le_b; rewrite /late_dot; case: leqP => ab.
  rewrite dotC (toR_late_dot_one_first _ _ le_b); apply: eq_bigr => k _; rewrite /late_entry.
  case: ltnP => kb; first by rewrite toR0 mulr0.
  by rewrite ltnNge (leq_trans ab kb) /= mulrC addnC addnBA // subnK // addnC.
rewrite (toR_late_dot_one_first _ _ le_a); apply: eq_bigr => k _; rewrite /late_entry.
case: ltnP => ka; first by rewrite toR0 mul0r.
by rewrite ltnNge (leq_trans (ltnW ab) ka) /= addnC addnBA ?(ltnW ab) // subnK // addnC.
Qed.

End Lists.

(* Diagonal dominance. *)
Section Dominance.

Variable R : realFieldType.

Definition off_entry (E : nat -> nat -> R) i j : R := if j == i then 0 else `|E i j|.

(* Each product z_i E_ij z_j is at least -|E_ij| (z_i^2 + z_j^2) / 2. *)
Lemma dominance (l : seq nat) (E : nat -> nat -> R) (z : nat -> R) : uniq l ->
  \sum_(i <- l) z i ^+ 2 *
     (2%:R * E i i - \sum_(j <- l) (off_entry E i j + off_entry E j i)) <=
  2%:R * \sum_(i <- l) \sum_(j <- l) z i * E i j * z j.
Proof.
move=> U.

have -> : \sum_(i <- l) z i ^+ 2 *
            (2%:R * E i i - \sum_(j <- l) (off_entry E i j + off_entry E j i)) =
          2%:R * (\sum_(i <- l) E i i * z i ^+ 2) -
          \sum_(i <- l) \sum_(j <- l) off_entry E i j * (z i ^+ 2 + z j ^+ 2).
  rewrite mulr_sumr.
  under [X in _ = _ - X]eq_bigr do (under eq_bigr do rewrite mulrDr; rewrite big_split /=).
  rewrite [in RHS]big_split /= [X in _ = _ - (_ + X)]exchange_big /=.
  rewrite -big_split /= -sumrN -big_split /=; apply: eq_bigr => i _.
  rewrite mulrBr -!mulr_suml -mulrDl -big_split /= [z i ^+ 2 * \sum_(j <- l) _]mulrC.
  by rewrite [z i ^+ 2 * _]mulrC mulrA.

have -> : \sum_(i <- l) \sum_(j <- l) z i * E i j * z j =
          \sum_(i <- l) E i i * z i ^+ 2 +
          \sum_(i <- l) \sum_(j <- l) (if j == i then 0 else z i * E i j * z j).
  rewrite -big_split /= big_seq [RHS]big_seq; apply: eq_bigr => i il.
  rewrite [LHS](bigD1_seq i) //= [X in _ = _ + X](bigD1_seq i) //= eqxx add0r.
  by congr (_ + _); [rewrite mulrAC mulrC expr2 | apply: eq_bigr => j /negbTE->].

rewrite mulrDr ler_add2l -subr_ge0 opprK mulr_sumr -big_split /=; apply: sum_ge0 => i _.
rewrite mulr_sumr -big_split /=; apply: sum_ge0 => j _; rewrite /off_entry.
case: ifP => _; first by rewrite mul0r mulr0 addr0.

have [e|e] := ger0P (E i j).
  have -> : 2%:R * (z i * E i j * z j) + E i j * (z i ^+ 2 + z j ^+ 2) =
            E i j * (z i + z j) ^+ 2.
    by rewrite sqrrD -mulr_natl; ring.
  by rewrite mulr_ge0 // sqr_ge0.
have -> : 2%:R * (z i * E i j * z j) + - E i j * (z i ^+ 2 + z j ^+ 2) =
          - E i j * (z i - z j) ^+ 2.
  by rewrite sqrrB -mulr_natl; ring.
by rewrite mulr_ge0 ?sqr_ge0 // oppr_ge0 ltW.
Qed.

End Dominance.

Section Sound.

Variables (R : realFieldType) (T U : Type) (d : T * U).
Variables (s : T -> T -> Z) (product : U -> U -> Z) (rows : seq (T * U)).
Notation n := (size rows).
Notation row i := (nth d rows i).

(* The products of rows are entries of L D L' with D >= 0. *)
Definition gram := exists N (weight : nat -> R) (factor : nat -> nat -> R),
  (forall k, k \in iota 0 N -> 0 <= weight k) /\
  forall i j, (i < n)%N -> (j < n)%N -> toR (product (row i).2 (row j).2) =
    \sum_(k <- iota 0 N) weight k * (factor i k * factor j k).

Definition symmetric_rows := forall i j, (i < n)%N -> (j < n)%N ->
  s (row i).1 (row j).1 = s (row j).1 (row i).1.

Definition form (z : nat -> R) :=
  \sum_(i <- iota 0 n) \sum_(j <- iota 0 n) z i * toR (s (row i).1 (row j).1) * z j.

Theorem covered_form strict z :
  gram -> symmetric_rows -> covered s product strict rows ->
  0 <= form z /\ (strict -> (exists2 i, i \in iota 0 n & z i != 0) -> 0 < form z).
Proof.
move=> [N [weight [factor [w0 gramE]]]] sym C.
pose E i j : R := toR (remainder s product (row i) (row j)).
have lt_n i : i \in iota 0 n -> (i < n)%N by rewrite mem_iota.

(* z' S z is a sum of squares plus z' E z. *)
have split_form : form z =
    \sum_(k <- iota 0 N) weight k * (\sum_(i <- iota 0 n) z i * factor i k) ^+ 2 +
    \sum_(i <- iota 0 n) \sum_(j <- iota 0 n) z i * E i j * z j.
  have -> : \sum_(k <- iota 0 N) weight k * (\sum_(i <- iota 0 n) z i * factor i k) ^+ 2 =
            \sum_(i <- iota 0 n) \sum_(j <- iota 0 n)
              z i * (\sum_(k <- iota 0 N) weight k * (factor i k * factor j k)) * z j.
    under eq_bigr do rewrite expr2 mulr_suml mulr_sumr.
    rewrite exchange_big; apply: eq_bigr => i _.
    under eq_bigr do rewrite mulr_sumr mulr_sumr.
    rewrite exchange_big; apply: eq_bigr => j _.
    by rewrite mulr_sumr mulr_suml; apply: eq_bigr => k _; ring.
  rewrite -big_split; apply: sum_eq => i /lt_n Hi; rewrite -big_split.
  apply: sum_eq => j /lt_n Hj.
  by rewrite /= -gramE // /E /remainder toRB; move: (z i) (z j) (toR _) (toR _) => *; ring.

have squares : 0 <= \sum_(k <- iota 0 N) weight k *
                      (\sum_(i <- iota 0 n) z i * factor i k) ^+ 2.
  by apply: sum_ge0 => k Hk; rewrite mulr_ge0 ?w0 ?sqr_ge0.

(* The rows of E. *)
have symE i j : (i < n)%N -> (j < n)%N -> E i j = E j i.
  move=> Hi Hj; rewrite /E /remainder !toRB sym //; congr (_ - _); rewrite !gramE //.
  by apply: eq_bigr => k _; rewrite [factor i k * _]mulrC.

have dom i : i \in iota 0 n ->
    let gap := 2%:R * E i i -
               \sum_(j <- iota 0 n) (off_entry E i j + off_entry E j i) in
    0 <= gap /\ (strict -> 0 < gap).
  move=> Hi gap; have := all_from_nth d C (lt_n _ Hi); rewrite add0n.
  have offE : \sum_(j <- iota 0 n) (off_entry E i j + off_entry E j i) =
              2%:R * toR (off_diagonal s product rows i (row i)).
    rewrite (toR_sum_from R d) mulr_sumr; apply: sum_eq => j Hj.
    rewrite subn0 /off_entry [i == j]eq_sym; case: eqP => _; first by rewrite addr0 mulr0.
    by rewrite (symE j i) ?lt_n // toR_abs mulr_natl mulr2n.
  rewrite /gap offE -mulrBr pmulr_rge0 ?ltr0n // pmulr_rgt0 ?ltr0n //.
  rewrite subr_ge0 subr_gt0 /E toR_le toR_lt; case: (strict) => [lt|le]; last by split.
  by split=> //; apply/Z.leb_spec0/Z.lt_le_incl/Z.ltb_spec0.

have D := dominance E z (iota_uniq 0 n).
have term i : i \in iota 0 n -> 0 <= z i ^+ 2 *
    (2%:R * E i i - \sum_(j <- iota 0 n) (off_entry E i j + off_entry E j i)).
  by move=> Hi; rewrite mulr_ge0 ?sqr_ge0 //; have [] := dom _ Hi.

rewrite split_form; split.
  rewrite addr_ge0 // -(@pmulr_rge0 _ 2%:R) ?ltr0n // (le_trans _ D) //.
  exact: sum_ge0.

move=> st [i Hi zi]; rewrite ltr_paddl // -(@pmulr_rgt0 _ 2%:R) ?ltr0n // (lt_le_trans _ D) //.
apply: sum_gt0 => //; exists i => //.
by rewrite mulr_gt0 ?exprn_even_gt0 //; have [_] := dom _ Hi; apply.
Qed.

End Sound.

(* Both shapes of a factor are Gram matrices. *)
Section Shapes.

Variables (R : realFieldType) (T : Type).

Lemma weighted_gram (w : seq Z) (d : T * seq Z) rows :
  all (fun u => 0 <=? u)%Z w -> @gram R T (seq Z) d (weighted_dot w) rows.
Proof.
move=> /allP w0; exists (size w), (fun k => toR (nth 0%Z w k)).
exists (fun i k => toR (nth 0%Z (nth d rows i).2 k)); split=> [k|i j _ _].
  by rewrite mem_iota => lt_k; rewrite toR_ge0; apply/w0/mem_nth.
exact: toR_weighted_dot.
Qed.

Lemma late_gram (m : Z) (d : T * late_row) rows :
  (0 <=? m)%Z -> @gram R T late_row d (fun a b => (m * late_dot a b)%Z) rows.
Proof.
move=> m0; pose width (a : late_row) := (a.1 + size a.2)%N.
pose N := (\max_(i < size rows) width (nth d rows i).2)%N.
exists N, (fun=> toR m), (fun i k => toR (late_entry (nth d rows i).2 k)).
split=> [k _|i j Hi Hj]; first by rewrite toR_ge0.

have le_N k : (k < size rows)%N -> (width (nth d rows k).2 <= N)%N.
  by move=> lt_k; apply: (leq_bigmax (Ordinal lt_k)).
by rewrite toRM (toR_late_dot R (le_N _ Hi) (le_N _ Hj)) mulr_sumr.
Qed.

End Shapes.

(* The form of things that numbers name: item i stands where i stands in l. *)
Section Lists.

Variables (R : realFieldType) (T U : Type) (dT : T) (dU : U).
Variables (s : T -> T -> Z) (product : U -> U -> Z) (strict : bool).
Variables (l : seq nat) (items : seq T) (rows : seq U) (item : nat -> T) (x : nat -> R).
Hypotheses (size_items : size items = size l) (size_rows : size rows == size l).
Hypothesis itemE : forall k, (k < size l)%N -> nth dT items k = item (nth 0%N l k).
Hypothesis grams : gram R (dT, dU) product (zip items rows).
Hypothesis sym : forall i j, i \in l -> j \in l -> s (item i) (item j) = s (item j) (item i).
Hypothesis checked : covered s product strict (zip items rows).

Notation listed := (\sum_(i <- l) \sum_(j <- l) x i * toR (s (item i) (item j)) * x j).

Lemma covered_list :
  0 <= listed /\ (strict -> (exists2 i, i \in l & x i != 0) -> 0 < listed).
Proof.
have sz : size (zip items rows) = size l by rewrite size_zip size_items (eqP size_rows) minnn.
have rowE k : (k < size l)%N -> (nth (dT, dU) (zip items rows) k).1 = item (nth 0%N l k).
  by move=> lt_k; rewrite nth_zip ?size_items ?(eqP size_rows) //= itemE.
have [|form0 form1] := covered_form (fun k => x (nth 0%N l k)) grams _ checked.
  by move=> i j; rewrite sz => lt_i lt_j; rewrite !rowE // sym ?mem_nth.

have -> : listed = form (dT, dU) s (zip items rows) (fun k => x (nth 0%N l k)).
  rewrite /form sz (big_nth 0%N) /index_iota subn0; apply: sum_eq => i; rewrite mem_iota => /= lt_i.
  rewrite (big_nth 0%N) /index_iota subn0; apply: sum_eq => j; rewrite mem_iota => /= lt_j.
  by rewrite !rowE.
split=> // st [i il xi]; apply: form1 => //; exists (index i l); last by rewrite nth_index.
by rewrite mem_iota sz /= index_mem.
Qed.

Variables (idx : seq nat) (M : nat -> nat -> R) (c : R).
Hypotheses (uniq_idx : uniq idx) (uniq_l : uniq l) (inside : {subset l <= idx}) (c0 : 0 < c).
Hypothesis off : forall i, i \in idx -> i \notin l -> x i = 0.
Hypothesis below : forall i j, i \in l -> j \in l ->
  x i * toR (s (item i) (item j)) * x j <= x i * (c * (M i j + M j i)) * x j.

Notation quadratic := (\sum_(i <- idx) \sum_(j <- idx) x i * M i j * x j).

Lemma covered_quadratic :
  0 <= quadratic /\ (strict -> (exists2 i, i \in idx & x i != 0) -> 0 < quadratic).
Proof.
have over (f : nat -> R) : (forall i, x i = 0 -> f i = 0) ->
  \sum_(i <- idx) f i = \sum_(i <- l) f i.
  by move=> f0; apply: sum_subset => // i Hi out; apply/f0/off.
have [form0 form1] := covered_list; have c2 : 0 < 2%:R * c by rewrite mulr_gt0 ?ltr0n.

have le : listed <= 2%:R * c * quadratic.
  have transposed : \sum_(i <- idx) \sum_(j <- idx) x i * M j i * x j = quadratic.
    rewrite exchange_big; apply: eq_bigr => i _; apply: eq_bigr => j _ /=.
    by move: (x i) (x j) (M _ _) => *; ring.
  have -> : 2%:R * c * quadratic = c * (quadratic + quadratic).
    by move: quadratic => *; ring.
  rewrite -{2}transposed -big_split !mulr_sumr over => [|i xi]; last first.
    by rewrite /= !sum_zero ?addr0 ?mulr0 // => j _; rewrite xi !mul0r.
  apply: sum_le => i Hi; rewrite -big_split !mulr_sumr over => [|j xj]; last first.
    by rewrite /= xj !mulr0 addr0 !mulr0.
  apply: sum_le => j Hj; apply: le_trans (below Hi Hj) _; rewrite le_eqVlt; apply/orP; left.
  by apply/eqP; rewrite /=; move: (x i) (x j) (M _ _) (M _ _) => *; ring.
split; first by rewrite -(pmulr_rge0 _ c2) (le_trans form0).
move=> st [i Hi xi]; rewrite -(pmulr_rgt0 _ c2) (lt_le_trans _ le) //; apply: form1 => //.
by exists i => //; apply: contraNT xi => /(off Hi)->.
Qed.

End Lists.
