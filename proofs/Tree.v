(* The tree of a cover: its leaves reach every solution of the window.

   A point is a pair of integers (p, q) with q >= 0: the value p/q, or infinity for (1, 0).
   A region is an interval [lower, upper] of values t together with a state for each
   complementarity variable: open (nothing known), resting (x_i = 0) or moving (x_i > 0).

   A *box* is a region together with an interval [low, high] of a second parameter mu (Boxes.v).  A
   tree divides a box: "Split t" cuts the interval of t, "CutFriction m" that of mu; "Branch i"
   decides whether variable i rests or moves; a leaf is a piece of evidence about its box.  A tree
   of regions is one whose evidence does not look at mu.

   Theorem [box_reaches_a_leaf]: if the tree is checked, then each (t, mu, x) with x >= 0 in the box
   of the root lies in the box of a leaf, and the evidence of that leaf has been checked for that
   box.  [every_point_reaches_a_leaf]: the same of regions.

   The theorem does not ask that (t, x) solves anything; what a leaf proves is the matter of
   Cover.v.  The proof is an induction over the tree.

   Pages: spec/certificates.md, 5.6 (trees), 5.18.
   Rust: crates/check/src/cover/walk.rs, region.rs, critical.rs. *)

From Mceip Require Import Base Lists Integers.

Definition point := (Z * Z)%type.

Definition zero : point := (0%Z, 1%Z).
Definition infinity : point := (1%Z, 0%Z).

Definition same_point (a b : point) := (a.1 =? b.1)%Z && (a.2 =? b.2)%Z.

Lemma same_point_eq a b : same_point a b -> a = b.
Proof. by case: a b => [p q] [p' q'] /andP[/Z.eqb_spec /= -> /Z.eqb_spec /= ->]. Qed.

Inductive state := Open | Resting | Moving.

Definition is_resting s := if s is Resting then true else false.
Definition is_moving s := if s is Moving then true else false.

Record region := Region { lower : point; upper : point; states : seq state }.

(* A variable without an entry in the list is open. *)
Definition state_of (r : region) i := nth Open (states r) i.

Definition decide i s (r : region) :=
  Region (lower r) (upper r) (set_nth Open (states r) i s).

Definition below t (r : region) := Region (lower r) t (states r).
Definition above t (r : region) := Region t (upper r) (states r).

(* 0 <= lo <= hi; lo is finite, hi may be infinity. *)
Definition ordered (lo hi : point) :=
  [&& (0 <=? lo.1)%Z, (0 <? lo.2)%Z, (0 <=? hi.1)%Z, (0 <=? hi.2)%Z,
      (0 <? hi.1 + hi.2)%Z & (lo.1 * hi.2 <=? hi.1 * lo.2)%Z].

Section Tree.

Variable leaf : Type.

Inductive tree :=
  | Split of point & tree & tree
  | CutFriction of point & tree & tree
  | Branch of nat & tree & tree
  | Leaf of leaf.

(* n is the number of complementarity variables. *)
Variable n : nat.

Section Boxes.

(* The check of a leaf. *)
Variable evidence : region -> point -> point -> leaf -> bool.

Fixpoint check_boxes (tr : tree) (r : region) (low high : point) : bool :=
  match tr with
  | Split t tr1 tr2 =>
      [&& ordered (lower r) t, ordered t (upper r),
          check_boxes tr1 (below t r) low high & check_boxes tr2 (above t r) low high]
  | CutFriction m tr1 tr2 =>
      [&& ordered low m, ordered m high, check_boxes tr1 r low m & check_boxes tr2 r m high]
  | Branch i tr1 tr2 =>
      [&& (i < n)%N, check_boxes tr1 (decide i Resting r) low high &
          check_boxes tr2 (decide i Moving r) low high]
  | Leaf l => [&& ordered (lower r) (upper r), ordered low high & evidence r low high l]
  end.

End Boxes.

Definition check_tree (evidence : region -> leaf -> bool) tr r :=
  check_boxes (fun r' _ _ => evidence r') tr r zero zero.

Fixpoint leaves (tr : tree) (r : region) : seq (region * leaf) :=
  match tr with
  | Split t tr1 tr2 => leaves tr1 (below t r) ++ leaves tr2 (above t r)
  | CutFriction _ tr1 tr2 => leaves tr1 r ++ leaves tr2 r
  | Branch i tr1 tr2 =>
      leaves tr1 (decide i Resting r) ++ leaves tr2 (decide i Moving r)
  | Leaf l => [:: (r, l)]
  end.

Lemma leaves_are_checked evidence tr r : check_tree evidence tr r ->
  forall rl, List.In rl (leaves tr r) ->
  ordered (lower rl.1) (upper rl.1) /\ evidence rl.1 rl.2.
Proof.
rewrite /check_tree; move: zero {2}zero.
elim: tr r => [t tr1 IH1 tr2 IH2|m tr1 IH1 tr2 IH2|i tr1 IH1 tr2 IH2|l] r low high /=.
- by case/and4P=> _ _ c1 c2 rl /in_cat_or[]; [apply: IH1 c1 rl | apply: IH2 c2 rl].
- by case/and4P=> _ _ c1 c2 rl /in_cat_or[]; [apply: IH1 c1 rl | apply: IH2 c2 rl].
- by case/and3P=> _ c1 c2 rl /in_cat_or[]; [apply: IH1 c1 rl | apply: IH2 c2 rl].
- by move=> /and3P[? _ ?] rl [<-|].
Qed.

Section Sound.

Variable R : realFieldType.
Implicit Types (t : R) (x : nat -> R).

(* lo <= t <= hi, without division. *)
Definition between t (lo hi : point) :=
  toR lo.1 <= t * toR lo.2 /\ t * toR hi.2 <= toR hi.1.

Definition agrees (r : region) x := forall i, (i < n)%N ->
  match state_of r i with Open => True | Resting => x i = 0 | Moving => 0 < x i end.

Definition in_region t x (r : region) := between t (lower r) (upper r) /\ agrees r x.

Lemma agrees_decide i s r x : (i < n)%N -> agrees r x ->
  match s with Open => True | Resting => x i = 0 | Moving => 0 < x i end ->
  agrees (decide i s r) x.
Proof.
move=> lt_i ag xi j lt_j; rewrite /state_of /decide /= nth_set_nth /=.
by case: eqP => [->|_] //; apply: ag.
Qed.

Theorem box_reaches_a_leaf evidence tr r low high t (mu : R) x :
  check_boxes evidence tr r low high -> (forall i, (i < n)%N -> 0 <= x i) ->
  in_region t x r -> between mu low high ->
  exists r' low' high' l, List.In (r', l) (leaves tr r) /\
    [/\ in_region t x r', between mu low' high', ordered (lower r') (upper r'),
        ordered low' high' & evidence r' low' high' l].
Proof.
move=> + x0; pose reached rs := exists r' low' high' l, List.In (r', l) rs /\
  [/\ in_region t x r', between mu low' high', ordered (lower r') (upper r'),
      ordered low' high' & evidence r' low' high' l].
have either a b : reached a \/ reached b -> reached (a ++ b).
  by case=> -[r' [low' [high' [l [l_in ok]]]]]; exists r', low', high', l; split=> //;
    apply/in_cat_or; [left | right].
rewrite -/(reached _).
elim: tr r low high => [c tr1 IH1 tr2 IH2|c tr1 IH1 tr2 IH2|i tr1 IH1 tr2 IH2|l] r low high /=.

(* A cut: t or mu lies on one side of it. *)
- case/and4P=> _ _ c1 c2 [[lo_t t_hi] ag] m_in; apply: either.
  case: (lerP (t * toR c.2) (toR c.1)) => t_c; [left; apply: IH1 c1 _ m_in | right].
    by split.
  by apply: IH2 c2 _ m_in; split=> //; split=> //; apply: ltW.
- case/and4P=> _ _ c1 c2 reg [lo_m m_hi]; apply: either.
  case: (lerP (mu * toR c.2) (toR c.1)) => m_c; [left | right].
    by apply: IH1 c1 reg _; split.
  by apply: IH2 c2 reg _; split=> //; apply: ltW.

(* Branch: x_i is zero or positive. *)
- case/and3P=> lt_i c1 c2 [bt ag] m_in; apply: either.
  have [xi|xi] := eqVneq (x i) 0; [left | right].
    by apply: IH1 c1 _ m_in; split=> //; apply: agrees_decide.
  apply: IH2 c2 _ m_in; split=> //; apply: agrees_decide => //.
  by rewrite lt_neqAle eq_sym xi x0.

(* Leaf. *)
by case/and3P=> o o' e reg m_in; exists r, low, high, l; split; [left | split].
Qed.

Theorem every_point_reaches_a_leaf evidence tr r t x :
  check_tree evidence tr r -> (forall i, (i < n)%N -> 0 <= x i) -> in_region t x r ->
  exists2 rl, List.In rl (leaves tr r) &
    [/\ in_region t x rl.1, ordered (lower rl.1) (upper rl.1) & evidence rl.1 rl.2].
Proof.
move=> ok x0 reg; have zero_in : between 0 zero zero by rewrite /between /= toR0 mul0r.
have [r' [_ [_ [l [l_in [reg' _ O _ ok']]]]]] := box_reaches_a_leaf ok x0 reg zero_in.
by exists (r', l).
Qed.

End Sound.

End Tree.

(* The interval of a region is a convex combination of its ends, with weights a and b that do not
   depend on the matrices: 1 = a lo.2 + b hi.2 and t = a lo.1 + b hi.1. *)
Section Ends.

Variable R : realFieldType.
Implicit Types (t : R).

Lemma ordered_ge0 lo hi : ordered lo hi ->
  [/\ 0 <= toR lo.1 :> R, 0 <= toR lo.2 :> R, 0 <= toR hi.1 :> R & 0 <= toR hi.2 :> R].
Proof. by case/and5P=> a b c d e; split; rewrite toR_ge0; lia. Qed.

Lemma weights_of_ends t lo hi : ordered lo hi -> between t lo hi ->
  exists a b, [/\ 0 <= a, 0 <= b,
    a * toR lo.2 + b * toR hi.2 = 1 /\ a * toR lo.1 + b * toR hi.1 = t &
    (0 < a \/ 0 < b) /\ (hi.2 = 0%Z -> 0 < a)].
Proof.
case: lo hi => [p q] [p' q'] /and5P[/= p0 q0 p'0 q'0 /andP[pos le]] [/= lo_t t_hi].
have Q0 : 0 < toR q :> R by rewrite toR_gt0.

have [eq|neq] := eqVneq (p * q')%Z (p' * q)%Z.
(* A window of one point. *)
  have q'_gt0 : (0 <? q')%Z by nia.
  have Q'0 : 0 < toR q' :> R by rewrite toR_gt0.
  have eqR : toR p * toR q' = toR p' * toR q :> R by rewrite -!toRM eq.
  exists (toR q)^-1, 0; split; rewrite ?invr_ge0 ?(ltW Q0) //.
    rewrite !mul0r !addr0 mulVf ?gt_eqF //; split=> //.
    apply: (mulIf (lt0r_neq0 Q0)); rewrite mulrAC mulVf ?gt_eqF // mul1r.
    apply/eqP; rewrite eq_le lo_t /= -(ler_pmul2r Q'0) eqR mulrAC.
    by rewrite ler_pmul2r.
  by split=> [|z]; [left|]; rewrite ?invr_gt0 //; move: q'_gt0; rewrite z.

(* An interval with two ends. *)
pose d : R := toR p' * toR q - toR p * toR q'.
have d0 : 0 < d.
  rewrite /d -!toRM subr_gt0 toR_lt; apply/Z.ltb_spec0; move/eqP: neq; move/Z.leb_spec0: le.
  by clear; lia.
pose a := (toR p' - t * toR q') / d; pose b := (t * toR q - toR p) / d.
have a0 : 0 <= a by apply: divr_ge0; [rewrite subr_ge0 | exact: ltW].
have b0 : 0 <= b by apply: divr_ge0; [rewrite subr_ge0 | exact: ltW].
have one : a * toR q + b * toR q' = 1.
  rewrite /a /b /d; field; exact: lt0r_neq0 d0.
have val : a * toR p + b * toR p' = t.
  rewrite /a /b /d; field; exact: lt0r_neq0 d0.
exists a, b; split=> //; split=> [|z].
  move: a0 b0 one; rewrite !le_eqVlt; case/orP=> [/eqP<-|]; last by left.
  by case/orP=> [/eqP<-|]; [rewrite !mul0r addr0 => /esym/eqP; rewrite oner_eq0 | right].
rewrite /= in z; rewrite /a z toR0 mulr0 subr0 divr_gt0 //.
by move: d0; rewrite /d z toR0 mulr0 subr0 pmulr_lgt0.
Qed.

Lemma between_ge0 t lo hi : ordered lo hi -> between t lo hi -> 0 <= t.
Proof.
case/and5P=> p0 q0 _ _ _ [le _]; rewrite -(@toR_ge0 R) in p0; rewrite -(@toR_gt0 R) in q0.
by rewrite -(pmulr_lge0 _ q0); apply: le_trans le.
Qed.

Lemma between_gt0 t lo hi : ordered lo hi -> (0 <? lo.1)%Z -> between t lo hi -> 0 < t.
Proof.
case/and5P=> _ q0 _ _ _ + [le _]; rewrite -(@toR_gt0 R) in q0; rewrite -(@toR_gt0 R) => p0.
by rewrite -(pmulr_lgt0 _ q0); apply: lt_le_trans le.
Qed.

(* The ends as numbers. *)
Lemma ends_of lo hi (a := toR lo.1 / toR lo.2 : R) (b := toR hi.1 / toR hi.2 : R) :
  ordered lo hi -> (0 <? hi.2)%Z ->
  [/\ a <= b, toR lo.1 = a * toR lo.2, toR hi.1 = b * toR hi.2 &
      forall t, a <= t <= b -> between t lo hi].
Proof.
case/and5P=> _ lo2 _ _ /andP[_ le] hi2; rewrite -(@toR_gt0 R) in lo2; rewrite -(@toR_gt0 R) in hi2.
split=> [|||t]; rewrite /a /b ?divfK ?gt_eqF //.
  by rewrite ler_pdivr_mulr // mulrAC ler_pdivl_mulr // -!toRM toR_le.
by rewrite ler_pdivr_mulr // ler_pdivl_mulr // => /andP[].
Qed.

Lemma finite_end lo hi : ordered lo hi -> hi.2 <> 0%Z -> (0 <? hi.2)%Z.
Proof. by case/and5P=> _ _ _ + _; move: hi.2 => q; lia. Qed.

(* With these weights: a combination of two values, of which that at infinity may be 0. *)
Lemma ends_gt0 lo hi (a b low high : R) : ordered lo hi -> 0 <= a -> 0 <= b ->
  (0 < a \/ 0 < b) /\ (hi.2 = 0%Z -> 0 < a) -> 0 < low -> 0 <= high ->
  ((0 <? hi.2)%Z -> 0 < high) -> 0 < a * low + b * high.
Proof.
move=> O a0 b0 [ab a_gt0] low1 high0 high1.
have a_part : 0 < a -> 0 < a * low + b * high.
  by move=> a_pos; apply: ltr_paddr; [apply: mulr_ge0 | apply: mulr_gt0].
case: ab => [//|b_pos]; have [/a_gt0//|finite] := eqVneq hi.2 0%Z.
have finite' := finite_end O (elimN eqP finite).
by apply: ltr_paddl; [apply: mulr_ge0 => //; apply: ltW | apply: mulr_gt0 => //; apply: high1].
Qed.

End Ends.
