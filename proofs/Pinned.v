(* Regions with at most one null vector: a claimed solution, or none because it is at infinity.

   A region is *pinned* if it is decided and the box and the uniqueness of Root.v hold over its
   interval.  Then it has at most one null vector with x_k = V_k ([pinned_sound]).  Nothing is said
   about existence.

   Over an interval [lo, infinity) with lo > 0 the uniqueness is that of the reversed family: with
   s = 1/t,

       s T(t) = B + s A,      s in (0, 1/lo],

   so A and B and the two numbers of each end are exchanged.  The box needs no change: the matrices
   T_end at both ends are the same.

   Two uses:

   - *claimed*: there is a solution (t, x) of which the support, the biactive set and an interval of
     its value are known, for example from an exact claim (Claim.v).  Its support lies in the
     moving set J, and the rest of J is biactive, so x is a null vector on J.
       If the support is J, the region has exactly one solution: [claimed_sound].
       If not, the region has none, because x_j = 0 for some moving j: [claimed_beside].
   - *infinite*: B has a null vector on J, that is a null vector at s = 0; 0 is not 1/t for any t.
     The region has no solution: [infinite_sound].

   Page: spec/certificates.md, 5.7 (chord), 5.11, outcomes "claim" and "infinity".
   Rust: crates/check/src/cover/root.rs, root/. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Root Existence RootLeaf.

Record pinning := Pinning {
  pin_pivot : nat;
  pin_vector : seq Z;
  pin_box : box;
  pin_unique : uniqueness;
  pin_reversed : bool }.

(* What is known of a solution: an interval of its value, its support, its biactive set. *)
Record known := Known {
  known_from : point;
  known_to : point;
  known_support : seq nat;
  known_biactive : seq nat }.

Definition swap (e : point) : point := (e.2, e.1).

Definition reversed (P : enclosed) :=
  Enclosed (size_of P) (center_b P) (center_a P) (radius_b P) (radius_a P).

Section Checker.

Variables (P : enclosed) (r : region).
Local Open Scope Z_scope.

Definition pinned (c : pinning) :=
  let k := pin_pivot c in
  let v := pin_vector c in
  let eps := width (pin_box c) in
  [&& decided P r, k \in moving P r, 0 <? nth 0 v k,
      check_box P (moving P r) (others P r k) v (pin_box c) (lower r) (upper r) &
      if pin_reversed c then
        (0 <? (lower r).1) &&
        check_unique (reversed P) (moving P r) k v (pin_unique c) eps (swap (upper r))
          (swap (lower r))
      else check_unique P (moving P r) k v (pin_unique c) eps (lower r) (upper r)].

Definition known_inside (q : known) :=
  [&& ordered (known_from q) (known_to q), 0 <? (known_to q).2,
      point_le (lower r) (known_from q) & point_le (known_to q) (upper r)].

Definition check_claimed (c : pinning) (q : known) :=
  [&& pinned c, pin_pivot c \in known_support q, known_inside q,
      all (fun i => i \in moving P r) (known_support q) &
      all (fun i => i \in known_support q ++ known_biactive q) (moving P r)].

(* The support is the whole moving set. *)
Definition supports_region (q : known) := all (fun i => i \in known_support q) (moving P r).

Definition check_infinite (c : pinning) :=
  [&& pinned c, pin_reversed c & (upper r).2 =? 0].

End Checker.

(* One interval within another. *)
Section Intervals.

Variable R : realFieldType.
Local Open Scope ring_scope.

Lemma between_wider (lo hi lo' hi' : point) (t : R) :
  ordered lo hi -> ordered lo' hi' -> point_le lo' lo -> point_le hi hi' ->
  between t lo hi -> between t lo' hi'.
Proof.
move=> o o' le_lo le_hi [lo_t t_hi].
have lo2 : 0 < toR lo.2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
have [_ _ hi1 hi2] := ordered_ge0 R o; have [_ lo2' hi1' hi2'] := ordered_ge0 R o'.
split.
  rewrite -(ler_pmul2r lo2); apply: (@le_trans _ _ (toR lo.1 * toR lo'.2)).
    by rewrite -!toRM toR_le.
  by rewrite mulrAC ler_wpmul2r.

have [hi0|] := eqVneq hi.2 0%Z; last first.
  move=> nz; have pos : 0 < toR hi.2 :> R.
    by rewrite lt_neqAle hi2 andbT eq_sym toR_eq0; apply: contra nz => /Z.eqb_spec ->.
  rewrite -(ler_pmul2r pos); apply: (@le_trans _ _ (toR hi.1 * toR hi'.2)).
    by rewrite mulrAC ler_wpmul2r.
  by rewrite -!toRM toR_le.
have hi'0 : hi'.2 = 0%Z.
  move: o o' le_hi; rewrite /ordered /point_le hi0.
  case/and5P=> _ _ _ _ /andP[/Z.ltb_spec0 p _] /and5P[_ _ _ /Z.leb_spec0 p' _] /Z.leb_spec0.
  by move: p p'; rewrite Z.add_0_r Z.mul_0_r; clear; nia.
by rewrite hi'0 toR0 mulr0.
Qed.

End Intervals.

Section Sound.

Variable R : rcfType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Variable r : region.
Hypothesis O : ordered (lower r) (upper r).

Notation T := (T A B).
Notation T_end := (T_end A B).
Notation solves := (solves P A B).
Notation J := (moving P r).
Notation K := (others P r).
Notation null_vector := (null_vector A B J).

Lemma reversed_encloses : encloses (reversed P) B A.
Proof. by move=> i j Hi Hj; have [? ?] := E Hi Hj. Qed.

Lemma T_end_reversed e i j : Enclosed.T_end B A (swap e) i j = T_end e i j.
Proof. by rewrite /Enclosed.T_end /swap addrC. Qed.

Section Pinned.

Variable c : pinning.
Hypothesis checked : pinned P r c.

Notation k := (pin_pivot c).
Notation v := (pin_vector c).
Notation V := (toR (nth 0%Z v k) : R).
Notation eps := (width (pin_box c)).

Lemma pinned_parts :
  [/\ decided P r, k \in J, (0 <? nth 0%Z v k)%Z &
      check_box P J (K k) v (pin_box c) (lower r) (upper r)].
Proof. by case/and5P: checked. Qed.

Lemma pinned_boxed t x : between t (lower r) (upper r) -> x k = V -> null_vector t x ->
  boxed (K k) k v eps x.
Proof.
have [_ kJ _ wide] := pinned_parts; have [p q p' q'] := ordered_ge0 R O.
move=> bt xk null; have [a [b [comb _]]] := combination_of_weights A B O bt.
split=> //; apply: (box_sound E (@moving_indices P r) (@others_moving P r k) kJ (uniq_moving P r)
  (uniq_others P r k) wide comb p q p' q' xk); exact: null_rows_K.
Qed.

(* A value of the region as a value of the reversed family. *)
Lemma reversed_null t x : t != 0 -> null_vector t x -> Root.null_vector B A J t^-1 x.
Proof.
move=> t0 null l lJ; apply: (mulfI t0); rewrite mulr0 -[RHS](null l lJ) mulr_sumr.
apply: eq_bigr => j _; rewrite mulrA /Enclosed.T mulrDr addrC; congr (_ * _).
by rewrite mulrA divff // mul1r.
Qed.

Lemma reversed_combination t : 0 < t -> between t (lower r) (upper r) ->
  exists a b, combination B A t^-1 (swap (upper r)) (swap (lower r)) a b /\
    a * toR (swap (upper r)).2 + b * toR (swap (lower r)).2 = 1.
Proof.
move=> t0 bt; have [a [b [a0 b0 [one val] [ab _]]]] := weights_of_ends O bt.
have tn : t != 0 by rewrite gt_eqF.
exists (b / t), (a / t); split; last first.
  by rewrite /= -mulrA -[X in _ + X]mulrA ![t^-1 * _]mulrC !mulrA -mulrDl addrC val divff.
split=> [||| i j].
- by apply: divr_ge0 => //; apply: ltW.
- by apply: divr_ge0 => //; apply: ltW.
- by case: ab => ?; [right | left]; apply: divr_gt0.
rewrite !T_end_reversed /Enclosed.T_end /Enclosed.T.
have -> : B i j + t^-1 * A i j =
    (a * toR (lower r).1 + b * toR (upper r).1) / t * B i j +
    (a * toR (lower r).2 + b * toR (upper r).2) / t * A i j.
  by rewrite one val divff // !mul1r.
by move: (t^-1) (A i j) (B i j) => *; ring.
Qed.

Theorem pinned_sound t x t' x' :
  between t (lower r) (upper r) -> between t' (lower r) (upper r) ->
  x k = V -> x' k = V -> null_vector t x -> null_vector t' x' ->
  t = t' /\ forall j, j \in J -> x j = x' j.
Proof.
move=> bt bt' xk xk' null null'; have [_ kJ _ _] := pinned_parts.
have [p q p' q'] := ordered_ge0 R O; have bx' := pinned_boxed bt' xk' null'.
case/and5P: checked => _ _ _ _; case: (pin_reversed c) => [/andP[lo1 uniq]|uniq].
  have t0 := between_gt0 O lo1 bt; have t0' := between_gt0 O lo1 bt'.
  have [a [b [comb one]]] := reversed_combination t0 bt.
  have [eq_inv eq_x] := unique_sound reversed_encloses (@moving_indices P r)
    (@others_moving P r k) kJ (uniq_moving P r) (uniq_others P r k) uniq q' p' q p comb one bx' xk
    (reversed_null (lt0r_neq0 t0) null) (reversed_null (lt0r_neq0 t0') null').
  by split=> //; apply: invr_inj.
have [a [b [comb one]]] := combination_of_weights A B O bt.
exact: (unique_sound E (@moving_indices P r) (@others_moving P r k) kJ (uniq_moving P r)
  (uniq_others P r k) uniq p q p' q' comb one bx' xk null null').
Qed.

End Pinned.

(* A claimed solution *)
Section Claimed.

Variables (c : pinning) (q : known).
Hypothesis checked : check_claimed P r c q.

Notation k := (pin_pivot c).
Notation V := (toR (nth 0%Z (pin_vector c) k) : R).

(* (t, x) is a solution as q says. *)
Definition is_known (q' : known) (t : R) x :=
  [/\ between t (known_from q') (known_to q'), solves t x &
      forall i, i \in indices P ->
        [/\ i \in known_support q' -> 0 < x i, i \notin known_support q' -> x i = 0 &
            i \notin known_support q' -> i \in known_biactive q' -> image P A B t x i = 0]].

Variables (t : R) (x : nat -> R).
Hypothesis solution : is_known q t x.

Lemma claimed_parts :
  [/\ pinned P r c, k \in known_support q, known_inside r q,
      forall i, i \in known_support q -> i \in J &
      forall i, i \in J -> i \in known_support q ++ known_biactive q].
Proof. by case/and5P: checked => ? ? ? /allP ? /allP ?. Qed.

Lemma claimed_between : between t (lower r) (upper r).
Proof.
have [_ _ /and4P[o _ le_lo le_hi] _ _] := claimed_parts; have [bt _ _] := solution.
exact: (between_wider o O le_lo le_hi bt).
Qed.

Lemma claimed_null : null_vector t x.
Proof.
move=> l lJ; have [_ _ _ in_J from_J] := claimed_parts; have [_ sol signs] := solution.
have [_ _ compl] := sol; have Hl := moving_indices lJ.
have zero j : j \in indices P -> j \notin J -> x j = 0.
  move=> Hj jJ; have [_ z _] := signs _ Hj; apply: z.
  by apply: contra jJ; apply: in_J.
have image0 : image P A B t x l = 0.
  have [pos _ biactive] := signs _ Hl; have := from_J _ lJ; rewrite mem_cat.
  have [l_s _|l_s /= l_b] := boolP (l \in known_support q); last exact: biactive.
  have [_ _ /eqP] := compl _ Hl; rewrite mulf_eq0 gt_eqF ?pos //=.
  by move/eqP.
by rewrite -[RHS]image0 /image (sum_moving (r := r)) // => j Hj jJ; rewrite zero ?mulr0.
Qed.

(* Every solution of the region has the value t and, on J, the direction of x. *)
Lemma claimed_unique t' x' : solves t' x' -> in_region_of P t' x' r ->
  t' = t /\ exists2 f, 0 < f & forall j, j \in J -> x' j = f * x j.
Proof.
move=> sol' reg'; have [pin k_s _ in_J _] := claimed_parts; have [D kJ V0 _] := pinned_parts pin.
have [g g0 [xk' null']] := scaled_solution D kJ V0 sol' reg'.
have [_ _ signs] := solution.
have xk : 0 < x k by have [pos _ _] := signs _ (moving_indices kJ); apply: pos.
pose f := V / x k; have f0 : 0 < f by rewrite divr_gt0 // toR_gt0.
have null : null_vector t (fun j => f * x j).
  move=> l lJ; under eq_bigr do rewrite mulrCA; rewrite -mulr_sumr claimed_null //.
  exact: mulr0.
have [|tt xx] := pinned_sound pin claimed_between (proj1 reg') _ xk' null null'.
  by rewrite /f divfK // gt_eqF.
split=> //; exists (f / g) => [|j jJ]; first exact: divr_gt0.
by apply: (mulfI (lt0r_neq0 g0)); rewrite -xx // mulrA mulrCA divff ?mulr1 // gt_eqF.
Qed.

Theorem claimed_sound : supports_region P r q ->
  in_region_of P t x r /\
  forall t' x', solves t' x' -> in_region_of P t' x' r ->
    t' = t /\ exists2 f, 0 < f & forall i, i \in indices P -> x' i = f * x i.
Proof.
move/allP=> J_s; have [pin _ _ in_J _] := claimed_parts; have [D _ _ _] := pinned_parts pin.
have [_ _ signs] := solution.
have zero i : i \in indices P -> i \notin J -> x i = 0.
  move=> Hi iJ; have [_ z _] := signs _ Hi; apply: z.
  by apply: contra iJ; apply: in_J.
split.
  split; first exact: claimed_between.
  move=> i lt_i; have Hi : i \in indices P by rewrite mem_iota.
  have iJ : (i \in J) = is_moving (state_of r i) by rewrite mem_filter Hi andbT.
  have := moving_or_resting D Hi; have := zero _ Hi; have := J_s i; rewrite iJ.
  case: (state_of r i) => //= s _ _.
  by have [pos _ _] := signs _ Hi; apply/pos/s.

move=> t' x' sol' reg'; have [-> [f f0 scaled]] := claimed_unique sol' reg'.
split=> //; exists f => // i Hi; have [iJ|iJ] := boolP (i \in J); first exact: scaled.
by have [_ z _] := solution_on_J D sol' reg'; rewrite zero // mulr0 z.
Qed.

Theorem claimed_beside t' x' : ~~ supports_region P r q ->
  solves t' x' -> in_region_of P t' x' r -> False.
Proof.
case/allPn=> i iJ ns sol' reg'; have [pin _ _ _ _] := claimed_parts.
have [D _ _ _] := pinned_parts pin; have [_ [f _ scaled]] := claimed_unique sol' reg'.
have [positive _ _] := solution_on_J D sol' reg'.
have [_ _ signs] := solution; have [_ zero _] := signs _ (moving_indices iJ).
by have := positive _ iJ; rewrite scaled // zero // mulr0 ltxx.
Qed.

End Claimed.

(* A null vector at infinity *)
Theorem infinite_sound c x t' x' : check_infinite P r c ->
  x (pin_pivot c) != 0 -> (forall l, l \in J -> \sum_(j <- J) B l j * x j = 0) ->
  solves t' x' -> in_region_of P t' x' r -> False.
Proof.
case/and3P=> pin rev /Z.eqb_spec hi2 xk Bx sol' reg'.
have [D kJ V0 _] := pinned_parts pin; set k := pin_pivot c in xk kJ V0.
set V := nth _ _ _ in V0.
have [p q p' q'] := ordered_ge0 R O.
have [g g0 [xk' null']] := scaled_solution D kJ V0 sol' reg'.
have bx' := pinned_boxed pin (proj1 reg') xk' null'.
case/and5P: pin => _ _ _ _; rewrite rev => /andP[lo1 uniq].
have t0 := between_gt0 O lo1 (proj1 reg').

have hi1 : 0 < toR (upper r).1 :> R.
  by case/and5P: O => _ _ _ _ /andP[+ _]; rewrite hi2 Z.add_0_r toR_gt0.
have comb : combination B A 0 (swap (upper r)) (swap (lower r)) (toR (upper r).1)^-1 0.
  split=> [||| i j] //; [by rewrite invr_ge0 ltW | by left; rewrite invr_gt0 |].
  rewrite !T_end_reversed /Enclosed.T_end /Enclosed.T hi2 toR0 !mul0r add0r !addr0.
  by rewrite mulrA mulVf ?mul1r // gt_eqF.
have one : (toR (upper r).1)^-1 * toR (swap (upper r)).2 + 0 * toR (swap (lower r)).2 = 1 :> R.
  by rewrite mul0r addr0 /= mulVf // gt_eqF.

pose f := toR V / x k.
have null : Root.null_vector B A J 0 (fun j => f * x j).
  move=> l lJ; rewrite /Enclosed.T; under eq_bigr do rewrite mul0r addr0 mulrCA.
  by rewrite -mulr_sumr Bx // mulr0.
have fxk : f * x k = toR V by rewrite /f divfK.
have [inv0 _] := unique_sound reversed_encloses (@moving_indices P r)
    (@others_moving P r k) kJ (uniq_moving P r) (uniq_others P r k) uniq q' p' q p comb one bx' fxk
    null (reversed_null (lt0r_neq0 t0) null').
by have := lt0r_neq0 t0; rewrite -invr_eq0 -inv0 eqxx.
Qed.

End Sound.
