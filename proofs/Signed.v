(* Definite forms, for vectors of any signs.

   Let S_e be the integer matrix

       S_e,ij = center_e,ij + center_e,ji,     i != j,
       S_e,ii = 2 center_e,ii - sum_j (radius_e,ij + radius_e,ji)

   of an enclosed pencil at the end e of an interval.  x'S_e x <= 2 x'T_e x for every vector x, of
   any signs.

   Theorem [reversed_zero]: if S_e is strictly covered (Covered.v) at both ends (at an infinite end
   covered), no x but 0 has x_i (T(t) x)_i <= 0 for every i.  [box_signed_sound]: forms of two
   pencils, each covered so, exclude a vector at which a combination of both forms is zero.

   Pages: spec/certificates.md, 5.9 ("What more it says"), 5.22 (tail).
   Rust: crates/check/src/cover/enclosed_definite.rs, psd.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Definite.

Section Checker.

Local Open Scope Z_scope.

Definition signed_part (P : enclosed) e (i j : nat) :=
  if i == j
  then 2 * center P e i i - sumZ (indices P) (fun k => radius P e i k + radius P e k i)
  else center P e i j + center P e j i.

(* The factor f covers c S_e. *)
Definition signed_end P strict e (cf : Z * factor) :=
  let: (c, f) := cf in
  [&& 0 <? c, all (fun w => 0 <=? w) (weights f), size (factor_rows f) == size_of P &
      covered (fun i j => c * signed_part P e i j) (weighted_dot (weights f)) strict
        (zip (indices P) (factor_rows f))].

(* Factors with their scales at both ends of an interval. *)
Definition signed_ends := ((Z * factor) * (Z * factor))%type.

Definition signed_between P (lo hi : point) (f : signed_ends) :=
  signed_end P true lo f.1 && signed_end P (0 <? hi.2) hi f.2.

End Checker.

Lemma signed_part_sym P e i j : signed_part P e i j = signed_part P e j i.
Proof. by rewrite /signed_part eq_sym; case: eqP => [->|_] //; rewrite Z.add_comm. Qed.

(* 2 a (t - c) b + r (a^2 + b^2) = ((t - c + r) (a + b)^2 + (c + r - t) (a - b)^2) / 2 *)
Lemma near_product (R : realFieldType) (t c r a b : R) : c - r <= t -> t <= c + r ->
  2%:R * (a * c * b) - r * (a ^+ 2 + b ^+ 2) <= 2%:R * (a * t * b).
Proof.
move=> lo hi; rewrite -subr_ge0 -(@pmulr_rge0 _ 2%:R) ?ltr0n //.
have -> : 2%:R * (2%:R * (a * t * b) - (2%:R * (a * c * b) - r * (a ^+ 2 + b ^+ 2))) =
    (t - (c - r)) * (a + b) ^+ 2 + (c + r - t) * (a - b) ^+ 2 by ring.
by apply: addr_ge0; apply: mulr_ge0; rewrite ?subr_ge0 ?sqr_ge0.
Qed.

Section Form.

Variable R : realFieldType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.
Variable x : nat -> R.

Notation ix := (indices P).
Notation center_of e i j := (toR (center P e i j) : R).
Notation radius_of e i j := (toR (radius P e i j) : R).

(* x'S_e x <= 2 x'T_e x *)
Lemma signed_part_le e : 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  \sum_(i <- ix) \sum_(j <- ix) x i * toR (signed_part P e i j) * x j <=
  2%:R * quadratic P A B [::] x e.
Proof.
move=> p q.
pose near i j := 2%:R * (x i * center_of e i j * x j) - radius_of e i j * (x i ^+ 2 + x j ^+ 2).
have below : \sum_(i <- ix) \sum_(j <- ix) near i j <= 2%:R * quadratic P A B [::] x e.
  rewrite /quadratic mulr_sumr; apply: sum_le => i Hi; rewrite mulr_sumr; apply: sum_le => j Hj.
  have := T_end_enclosed E Hi Hj p q; rewrite ler_distl => /andP[lo hi].
  by rewrite /weight_of nth_nil toR1 mul1r; apply: near_product.
apply: le_trans below; rewrite le_eqVlt; apply/orP; left; apply/eqP.
pose twice i j := x i * (center_of e i j + center_of e j i) * x j.
have radii : \sum_(i <- ix) \sum_(j <- ix) radius_of e i j * (x i ^+ 2 + x j ^+ 2) =
    \sum_(i <- ix) x i ^+ 2 * \sum_(j <- ix) (radius_of e i j + radius_of e j i).
  have -> : \sum_(i <- ix) \sum_(j <- ix) radius_of e i j * (x i ^+ 2 + x j ^+ 2) =
      \sum_(i <- ix) \sum_(j <- ix) radius_of e i j * x i ^+ 2 +
      \sum_(i <- ix) \sum_(j <- ix) radius_of e i j * x j ^+ 2.
    rewrite -big_split; apply: eq_bigr => i _; rewrite -big_split; apply: eq_bigr => j _.
    exact: mulrDr.
  rewrite [X in _ + X = _]exchange_big -big_split; apply: eq_bigr => i _ /=.
  rewrite -big_split mulr_sumr; apply: eq_bigr => j _ /=.
  by rewrite mulrDr ![x i ^+ 2 * _]mulrC.
have centers : \sum_(i <- ix) \sum_(j <- ix) 2%:R * (x i * center_of e i j * x j) =
    \sum_(i <- ix) \sum_(j <- ix) twice i j.
  have split_twice : \sum_(i <- ix) \sum_(j <- ix) twice i j =
      \sum_(i <- ix) \sum_(j <- ix) x i * center_of e i j * x j +
      \sum_(i <- ix) \sum_(j <- ix) x i * center_of e j i * x j.
    rewrite -big_split; apply: eq_bigr => i _; rewrite -big_split; apply: eq_bigr => j _ /=.
    by rewrite /twice mulrDr mulrDl.
  rewrite split_twice [X in _ = _ + X]exchange_big -big_split; apply: eq_bigr => i _ /=.
  rewrite -big_split; apply: eq_bigr => j _ /=.
  by move: (x i) (x j) (center_of _ _ _) => *; ring.
rewrite /near; under [RHS]eq_bigr do rewrite sumrB.
rewrite sumrB centers radii -sumrB; apply: sum_eq => i Hi.
rewrite (bigD1_seq i) ?iota_uniq //= [X in _ = X - _](bigD1_seq i) ?iota_uniq //=.
rewrite addrAC; congr (_ + _); last first.
  by apply: eq_bigr => j /negbTE ne; rewrite /signed_part eq_sym ne toRD.
rewrite /signed_part eqxx toRB toRM toR_sum; under eq_bigr do rewrite toRD.
rewrite /twice [toR 2%Z](_ : _ = 2%:R) //.
by move: (\sum_(j <- ix) _) (x i) (center_of _ _ _) => *; ring.
Qed.

Lemma signed_end_sound strict e cf : 0 <= toR e.1 :> R -> 0 <= toR e.2 :> R ->
  signed_end P strict e cf -> 0 <= quadratic P A B [::] x e /\
  (strict -> (exists2 i, i \in ix & x i != 0) -> 0 < quadratic P A B [::] x e).
Proof.
case: cf => c f p q /and4P[c0 w0 /eqP sz C].
have size_rows : size (factor_rows f) == size ix by rewrite size_iota sz.
have [||form0 form1] := covered_list (dT := 0%N) (dU := [::]) (l := ix) (item := id) x
  (erefl _) size_rows _ (weighted_gram R _ _ w0) _ C => //.
  by move=> i j _ _; rewrite signed_part_sym.
have {}c0 : 0 < toR c :> R by rewrite toR_gt0.
have le := signed_part_le p q.
have c2 : 0 < toR c * 2%:R :> R by rewrite mulr_gt0 ?ltr0n.
have timesE : \sum_(i <- ix) \sum_(j <- ix) x i * toR (c * signed_part P e i j)%Z * x j =
    toR c * \sum_(i <- ix) \sum_(j <- ix) x i * toR (signed_part P e i j) * x j.
  rewrite mulr_sumr; apply: eq_bigr => i _; rewrite mulr_sumr; apply: eq_bigr => j _ /=.
  by rewrite toRM; move: (x i) (x j) (toR c) (toR (signed_part P e i j)) => *; ring.
have {}le : toR c * (\sum_(i <- ix) \sum_(j <- ix) x i * toR (signed_part P e i j) * x j) <=
    toR c * 2%:R * quadratic P A B [::] x e.
  by rewrite -[X in _ <= X]mulrA ler_pmul2l.
rewrite -timesE in le; split; first by rewrite -(pmulr_rge0 _ c2) (le_trans form0).
by move=> st nonzero; rewrite -(pmulr_rgt0 _ c2) (lt_le_trans _ le) // form1.
Qed.

(* x'T(t) x between definite ends. *)
Lemma signed_form t lo hi f : ordered lo hi -> between t lo hi -> signed_between P lo hi f ->
  (exists2 i, i \in ix & x i != 0) -> 0 < \sum_(i <- ix) x i * image P A B t x i.
Proof.
move=> O W /andP[L H] nonzero; have [p q p' q'] := ordered_ge0 R O.
have [_ low1] := signed_end_sound p q L; have [high0 high1] := signed_end_sound p' q' H.
have := form_between O W (low1 isT nonzero) high0 (fun st => high1 st nonzero).
by under eq_bigr do rewrite /weight_of nth_nil toR1 mul1r.
Qed.

(* Between definite ends the pencil has the property of a P-matrix. *)
Lemma reversed_zero t lo hi f : ordered lo hi -> between t lo hi -> signed_between P lo hi f ->
  (forall i, i \in ix -> x i * image P A B t x i <= 0) -> forall i, i \in ix -> x i = 0.
Proof.
move=> O W ok reversed i Hi; have [//|xi] := eqVneq (x i) 0.
have := signed_form O W ok (ex_intro2 _ _ i Hi xi).
by rewrite ltNge -oppr_ge0 -sumrN big_seq sumr_ge0 // => j Hj; rewrite oppr_ge0 reversed.
Qed.

End Form.

(* The same for the enclosed pencils at both ends of an interval of another parameter. *)
Definition box_signed P P' r (f f' : signed_ends) :=
  signed_between P (lower r) (upper r) f && signed_between P' (lower r) (upper r) f'.

Theorem box_signed_sound (R : realFieldType) P P' (A B A' B' : nat -> nat -> R) r t a b x f f' :
  encloses P A B -> encloses P' A' B' -> size_of P' = size_of P ->
  ordered (lower r) (upper r) -> between t (lower r) (upper r) ->
  0 <= a -> 0 <= b -> 0 < a \/ 0 < b -> (exists2 i, i \in indices P & x i != 0) ->
  box_signed P P' r f f' ->
  \sum_(i <- indices P) x i * box_image P P' A B A' B' t a b x i = 0 -> False.
Proof.
move=> E E' same O W a0 b0 ab nonzero /andP[low high] zero.
have l := signed_form E O W low nonzero.
have h : 0 < \sum_(i <- indices P') x i * image P' A' B' t x i.
  by apply: (signed_form E' O W high); rewrite (same_indices same).
have := combination_gt0 a0 b0 ab l h.
rewrite (same_indices same) !mulr_sumr -big_split /=.
rewrite (eq_bigr (fun i => x i * box_image P P' A B A' B' t a b x i)) ?zero ?ltxx // => i _.
by rewrite /box_image mulrDr !(mulrCA _ (x i)).
Qed.
