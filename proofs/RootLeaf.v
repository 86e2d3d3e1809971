(* Root leaves: at most one solution in a decided region, and what it is.

   T(t) need not be linear in t: where the free rows of a pencil depend on t, the condensed matrix
   is a quotient of polynomials.  Over one region it is known by an enclosed pencil P of the kind of
   Enclosed.v, in two ways:

   - *near a line*: for each t there is a pencil A + t B that P encloses with T(t) = A + t B;
   - *near chords*: for each two t and t' there is a pencil A + t B that P encloses, with
     T(t) = A + t B and T(t') = A + t' B.

   Near a line is enough for every leaf that excludes: a solution of T at t is one of A + t B, and
   the theorems about leaves hold for all A and B that P encloses ([line_solution]).

   Two kinds of evidence about a decided region with a moving variable.

   - *isolated*: the box and the uniqueness of Root.v on the interval of the region, and a sign
     change of phi between two points from < to of it (Existence.v).  Then T has exactly one null
     vector with x_k = V_k in the region, its value t lies in [from, to], and |x - V| <= eps.
     The outcome says which:
       solution      V_j > eps for every j in K and y_i > 0 for every resting i: [solution_sound],
                     the region has exactly one solution, up to a positive factor;
                     [curved_solution], if T is near chords there and f(t) T(t) is a matrix of
                     polynomials with f(t) != 0 (existence is that of Existence.v for f T,
                     uniqueness that of Root.v for the chord through both values);
       negative x_i  V_i < -eps for a moving i: [negative_x_sound], no solution;
       negative y_i  y_i < 0 for a resting i: [negative_y_sound], no solution.
   - *absent*: the box alone, and a vector u such that u' T_e x has one sign at both ends for every
     x of the box.  It is 0 for a null vector: [absent_sound], no solution.  The interval may end
     at infinity.

   Page: spec/certificates.md, 5.7, 5.11 (steps 4 and 5), 5.14.
   Rust: crates/check/src/cover/root.rs, root/, family.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Root Existence.

Record isolation := Isolation {
  pivot : nat;
  vector : seq Z;
  from_point : point;
  to_point : point;
  wide_box : box;
  narrow_box : box;
  unique : uniqueness;
  left_vector : seq Z }.

Inductive outcome := Solution | NegativeX of nat | NegativeY of nat.

Record absence := Absence {
  absent_pivot : nat;
  absent_vector : seq Z;
  absent_box : box;
  absent_left : seq Z }.

Section Checker.

Variables (P : enclosed) (r : region).
Local Open Scope Z_scope.

Definition moving := [seq i <- indices P | is_moving (state_of r i)].
Definition others k := [seq i <- moving | i != k].

Definition decided :=
  all (fun i => is_resting (state_of r i) || is_moving (state_of r i)) (indices P).

Definition point_le (a b : point) := a.1 * b.2 <=? b.1 * a.2.

Section Signs.

Variables (k : nat) (v : seq Z).

(* u' T_e x for x in the box *)
Definition left_center u e :=
  sum_center moving v (product_center P moving [:: u] e 0%N).
Definition left_radius u eps e :=
  sum_radius moving k v (product_center P moving [:: u] e 0%N)
    (product_radius P moving [:: u] e 0%N) eps.

Definition left_negative u eps e := left_center u e + left_radius u eps e <? 0.
Definition left_positive u eps e := 0 <? left_center u e - left_radius u eps e.

(* (T_e x)_i for x in the box *)
Definition row_center e i := sum_center moving v (center P e i).
Definition row_radius eps e i := sum_radius moving k v (center P e i) (radius P e i) eps.

Definition row_positive eps e i := 0 <? row_center e i - row_radius eps e i.
Definition row_negative eps e i := row_center e i + row_radius eps e i <? 0.

End Signs.

Section Isolated.

Variable c : isolation.

Notation k := (pivot c).
Notation v := (vector c).
Notation eps := (width (narrow_box c)).
Notation positive := (left_positive k v (left_vector c) eps).
Notation negative := (left_negative k v (left_vector c) eps).

Definition interval_inside :=
  [&& ordered (from_point c) (to_point c), 0 <? (to_point c).2,
      point_le (lower r) (from_point c) & point_le (to_point c) (upper r)].

Definition sign_change :=
  (0 <? nth 0 (left_vector c) k) &&
  (negative (from_point c) && positive (to_point c) ||
   positive (from_point c) && negative (to_point c)).

Definition isolated :=
  [&& decided, k \in moving, 0 <? nth 0 v k, interval_inside, sign_change,
      check_box P moving (others k) v (wide_box c) (lower r) (upper r),
      check_box P moving (others k) v (narrow_box c) (from_point c) (to_point c) &
      check_unique P moving k v (unique c) (width (wide_box c)) (lower r) (upper r)].

Definition both_ends (f : point -> bool) := f (from_point c) && f (to_point c).

Definition solution_signs :=
  all (fun j => eps <? nth 0 v j) (others k) &&
  all (fun i => is_moving (state_of r i) || both_ends (fun e => row_positive k v eps e i))
    (indices P).

Definition outcome_signs o :=
  match o with
  | Solution => solution_signs
  | NegativeX i => (i \in others k) && (nth 0 v i <? - eps)
  | NegativeY i =>
      [&& i \in indices P, ~~ is_moving (state_of r i) &
          both_ends (fun e => row_negative k v eps e i)]
  end.

Definition check_root o := isolated && outcome_signs o.

End Isolated.

Definition check_absent (c : absence) :=
  let k := absent_pivot c in
  let v := absent_vector c in
  let eps := width (absent_box c) in
  [&& decided, k \in moving, 0 <? nth 0 v k,
      check_box P moving (others k) v (absent_box c) (lower r) (upper r) &
      left_positive k v (absent_left c) eps (lower r) &&
      left_positive k v (absent_left c) eps (upper r) ||
      left_negative k v (absent_left c) eps (lower r) &&
      left_negative k v (absent_left c) eps (upper r)].

End Checker.

Lemma sum_moving (R : realFieldType) P r (f : nat -> R) :
  (forall j, j \in indices P -> j \notin moving P r -> f j = 0) ->
  \sum_(j <- indices P) f j = \sum_(j <- moving P r) f j.
Proof.
by move=> f0; apply: sum_support => j Hj still; apply: f0; rewrite // mem_filter negb_and still.
Qed.

Section Sound.

Variable R : rcfType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Variable r : region.
Hypotheses (O : ordered (lower r) (upper r)) (D : decided P r).

Notation T := (T A B).
Notation T_end := (T_end A B).
Notation solves := (solves P A B).
Notation J := (moving P r).
Notation K := (others P r).
Notation null_vector := (null_vector A B J).

Lemma moving_indices j : j \in J -> j \in indices P.
Proof. by rewrite mem_filter => /andP[]. Qed.

Lemma others_moving k j : (j \in K k) = (j \in J) && (j != k).
Proof. by rewrite mem_filter andbC. Qed.

Lemma uniq_moving : uniq J.
Proof. by rewrite filter_uniq // iota_uniq. Qed.

Lemma uniq_others k : uniq (K k).
Proof. by rewrite !filter_uniq // iota_uniq. Qed.

Lemma moving_or_resting i : i \in indices P -> (i \in J) || is_resting (state_of r i).
Proof. by move=> Hi; have := allP D _ Hi; rewrite mem_filter Hi andbT orbC. Qed.

Lemma combination_of_weights t lo hi : ordered lo hi -> between t lo hi ->
  exists a b, combination A B t lo hi a b /\ a * toR lo.2 + b * toR hi.2 = 1.
Proof.
move=> o bt; have [a [b [a0 b0 [one val] [ab _]]]] := weights_of_ends o bt.
exists a, b; split=> //; split=> // i j.
by rewrite /T /T_end -{1}[A i j]mul1r -one -{1}val !mulrDr !mulrDl !mulrA addrACA.
Qed.

Lemma zero_off_J (x : nat -> R) i : agrees (size_of P) r x -> i \in indices P -> i \notin J ->
  x i = 0.
Proof.
move=> ag Hi iJ; have := moving_or_resting Hi; rewrite (negbTE iJ) /=.
by have := agrees_at ag Hi; case: state_of.
Qed.

(* A solution of the region moves exactly on J, and is a null vector there. *)
Lemma solution_on_J t x : solves t x -> in_region_of P t x r ->
  [/\ forall j, j \in J -> 0 < x j, forall i, i \in indices P -> i \notin J -> x i = 0 &
      null_vector t x].
Proof.
move=> [_ _ compl] [_ ag].
have positive j : j \in J -> 0 < x j.
  by rewrite mem_filter => /andP[m /(agrees_at ag)]; move: m; case: state_of.
have zero i : i \in indices P -> i \notin J -> x i = 0 by apply: zero_off_J.
split=> // l lJ; have [_ _ /eqP] := compl _ (moving_indices lJ).
rewrite mulf_eq0 gt_eqF ?positive //= => /eqP; rewrite /image => row_zero.
by rewrite -[RHS]row_zero (sum_moving (r := r)) // => i Hi nm; rewrite zero ?mulr0.
Qed.

Lemma scaled_solution k V t x : k \in J -> (0 <? V)%Z -> solves t x -> in_region_of P t x r ->
  exists2 f, 0 < f & f * x k = toR V /\ null_vector t (fun j => f * x j).
Proof.
move=> kJ V0 sol reg; have [positive _ null] := solution_on_J sol reg.
have xk := positive _ kJ; exists (toR V / x k); first by rewrite divr_gt0 // toR_gt0.
split=> [|l lJ]; first by rewrite divfK // gt_eqF.
by under eq_bigr do rewrite mulrCA; rewrite -mulr_sumr null // mulr0.
Qed.

Lemma null_rows_K t x k : null_vector t x ->
  forall l, l \in K k -> \sum_(j <- J) T t l j * x j = 0.
Proof. by move=> null l; rewrite others_moving => /andP[lJ _]; apply: null. Qed.

(* Values of u' T_e x and (T_e x)_i over the box. *)
Section Signs.

Variables (k : nat) (v : seq Z) (eps : Z) (x : nat -> R).
Hypotheses (kJ : k \in J) (eps0 : 0 <= toR eps :> R) (boxed_x : boxed (K k) k v eps x).

Variable e : point.
Hypotheses (e1 : 0 <= toR e.1 :> R) (e2 : 0 <= toR e.2 :> R).

Definition row_at i := \sum_(j <- J) T_end e i j * x j.

Lemma row_near i : i \in indices P ->
  `|row_at i - toR (row_center P r v e i)| <= toR (row_radius P r k v eps e i).
Proof.
move=> Hi; apply: (sum_enclosed (@others_moving k)) => // j jJ.
by apply: T_end_enclosed => //; apply: moving_indices.
Qed.

Lemma row_positive_sound i : i \in indices P -> row_positive P r k v eps e i -> 0 < row_at i.
Proof.
move=> Hi; rewrite /row_positive -(@toR_gt0 R) toRB => pos; have := row_near Hi.
by rewrite ler_distl => /andP[+ _]; apply: lt_le_trans.
Qed.

Lemma row_negative_sound i : i \in indices P -> row_negative P r k v eps e i -> row_at i < 0.
Proof.
move=> Hi; rewrite /row_negative -(@toR_lt0 R) toRD => neg; have := row_near Hi.
by rewrite ler_distl => /andP[_]; move/le_lt_trans; apply.
Qed.

Definition left_at (u : seq Z) := \sum_(l <- J) toR (nth 0%Z u l) * row_at l.

Lemma left_near u :
  `|left_at u - toR (left_center P r v u e)| <= toR (left_radius P r k v u eps e).
Proof.
have -> : left_at u =
    \sum_(j <- J) (\sum_(l <- J) toR (entry [:: u] 0 l) * T_end e l j) * x j.
  rewrite /left_at /row_at; under eq_bigr do rewrite mulr_sumr.
  rewrite exchange_big; apply: eq_bigr => j _; rewrite mulr_suml.
  by apply: eq_bigr => l _; rewrite mulrA.
apply: (sum_enclosed (@others_moving k)) => // j jJ.
by apply: product_enclosed => //; [apply: moving_indices | apply: moving_indices].
Qed.

Lemma left_positive_sound u : left_positive P r k v u eps e -> 0 < left_at u.
Proof.
rewrite /left_positive -(@toR_gt0 R) toRB => pos; have := left_near u.
by rewrite ler_distl => /andP[+ _]; apply: lt_le_trans.
Qed.

Lemma left_negative_sound u : left_negative P r k v u eps e -> left_at u < 0.
Proof.
rewrite /left_negative -(@toR_lt0 R) toRD => neg; have := left_near u.
by rewrite ler_distl => /andP[_]; move/le_lt_trans; apply.
Qed.

End Signs.

(* T(t) x is a combination of T_e x at the ends. *)
Lemma row_combination t lo hi a b x i : combination A B t lo hi a b ->
  \sum_(j <- J) T t i j * x j = a * row_at x lo i + b * row_at x hi i.
Proof.
case=> _ _ _ Tab; rewrite /row_at !mulr_sumr -big_split /=; apply: eq_bigr => j _.
by rewrite Tab mulrDl !mulrA.
Qed.

(* Absent *)
Theorem absent_sound c t x : check_absent P r c -> in_region_of P t x r -> solves t x -> False.
Proof.
case/and5P=> _ kJ vk B2 signs reg sol.
have [f f0 [xk null]] := scaled_solution kJ vk sol reg.
have [a [b [comb one]]] := combination_of_weights O (proj1 reg).
have [p q p' q'] := ordered_ge0 R O.

set k := absent_pivot c in kJ vk B2 signs xk; set v := absent_vector c in vk B2 signs xk.
pose z j := f * x j.
have boxed_z : boxed (K k) k v (width (absent_box c)) z.
  split=> //; apply: (box_sound E moving_indices (@others_moving k) kJ uniq_moving
    (uniq_others k) B2 comb p q p' q' xk); exact: null_rows_K.
have eps0 : 0 <= toR (width (absent_box c)) :> R by case/and3P: B2; rewrite toR_ge0.

(* a u' T_lo z + b u' T_hi z = u' T(t) z = 0 *)
have zero : a * left_at z (lower r) (absent_left c) + b * left_at z (upper r) (absent_left c) = 0.
  rewrite /left_at !mulr_sumr -big_split /= sum_zero // => l lJ.
  by rewrite !(mulrCA _ (toR _)) -mulrDr -(row_combination _ _ comb) null // mulr0.
have [a0 b0 ab _] := comb.
case/orP: signs => /andP[s1 s2].
  have := combination_gt0 a0 b0 ab (left_positive_sound kJ eps0 boxed_z p q s1)
                                   (left_positive_sound kJ eps0 boxed_z p' q' s2).
  by rewrite zero ltxx.
have n1 := left_negative_sound kJ eps0 boxed_z p q s1.
have n2 := left_negative_sound kJ eps0 boxed_z p' q' s2.
rewrite -oppr_gt0 in n1; rewrite -oppr_gt0 in n2.
by have := combination_gt0 a0 b0 ab n1 n2; rewrite !mulrN -opprD zero oppr0 ltxx.
Qed.

(* Isolated *)
Section Isolated.

Variable c : isolation.
Hypothesis L : isolated P r c.

Notation k := (pivot c).
Notation v := (vector c).
Notation eps := (width (narrow_box c)).

Lemma isolated_parts :
  [/\ k \in J, (0 <? nth 0%Z v k)%Z, interval_inside r c & sign_change P r c] /\
  [/\ check_box P J (K k) v (wide_box c) (lower r) (upper r),
      check_box P J (K k) v (narrow_box c) (from_point c) (to_point c) &
      check_unique P J k v (unique c) (width (wide_box c)) (lower r) (upper r)].
Proof. by case/and5P: L => _ a b i /and4P[s w n u]. Qed.

Lemma eps_ge0 : 0 <= toR eps :> R.
Proof. by case: isolated_parts => _ [_ /and3P[? _ _] _]; rewrite toR_ge0. Qed.

Lemma inside_region (t : R) :
  between t (from_point c) (to_point c) -> between t (lower r) (upper r).
Proof.
case: isolated_parts => [[_ _ /and4P[o to2 lo_from to_hi] _] _] [from_t t_to].
have f2 : 0 < toR (from_point c).2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
have {}to2 : 0 < toR (to_point c).2 :> R by rewrite toR_gt0.
have lo2 : 0 < toR (lower r).2 :> R by case/and5P: O => _ ? _ _ _; rewrite toR_gt0.
have hi2 : 0 <= toR (upper r).2 :> R by case/and5P: O => _ _ _ ? _; rewrite toR_ge0.

split.
  rewrite -(ler_pmul2r f2); apply: (@le_trans _ _ (toR (from_point c).1 * toR (lower r).2)).
    by rewrite -!toRM toR_le.
  by rewrite mulrAC ler_pmul2r.
rewrite -(ler_pmul2r to2); apply: (@le_trans _ _ (toR (to_point c).1 * toR (upper r).2)).
  by rewrite mulrAC ler_wpmul2r.
by rewrite -!toRM toR_le.
Qed.

Lemma row_of_solution t x : forall i,
  image P A B t (fun j => if j \in J then x j else 0) i = \sum_(j <- J) T t i j * x j.
Proof.
move=> i; rewrite /image (sum_moving (r := r)) => [|j _ /negbTE->]; last exact: mulr0.
by apply: eq_big_seq => j ->.
Qed.

End Isolated.

End Sound.

(* A family that need not be linear. *)
Section Curved.

Variable R : rcfType.
Variables (P : enclosed) (T : R -> nat -> nat -> R).

Definition family_image t (x : nat -> R) i := \sum_(j <- indices P) T t i j * x j.

Definition family_solves t (x : nat -> R) :=
  [/\ 0 <= t, exists2 i, i \in indices P & x i != 0 &
      forall i, i \in indices P ->
        [/\ 0 <= x i, 0 <= family_image t x i & x i * family_image t x i = 0]].

Definition on_pencil A B (t : R) := forall i j, i \in indices P -> j \in indices P ->
  T t i j = Enclosed.T A B t i j.

Definition near_line t := exists A B, encloses P A B /\ on_pencil A B t.

Definition near_chord t t' := exists A B, [/\ encloses P A B, on_pencil A B t & on_pencil A B t'].

Lemma chord_line t t' : near_chord t t' -> near_line t.
Proof. by case=> A [B [E on _]]; exists A, B. Qed.

Lemma pencil_solution A B t x : on_pencil A B t -> family_solves t x <-> solves P A B t x.
Proof.
move=> on; have imageE i : i \in indices P -> family_image t x i = image P A B t x i.
  by move=> Hi; apply: sum_eq => j Hj; rewrite on.
by split=> -[t0 nz rows]; split=> // i Hi; have := rows i Hi; rewrite imageE.
Qed.

Lemma line_solution t x : near_line t -> family_solves t x ->
  exists A B, encloses P A B /\ solves P A B t x.
Proof. by case=> A [B [E on]] /(pencil_solution x on) sol; exists A, B. Qed.

Section Solution.

Variables (r : region) (c : isolation).
Hypotheses (O : ordered (lower r) (upper r)) (L : isolated P r c).
Hypothesis chords : forall t t', between t (lower r) (upper r) -> between t' (lower r) (upper r) ->
  near_chord t t'.

Variables (f : {poly R}) (N : nat -> nat -> {poly R}).
Hypothesis f_regular : forall t, between t (lower r) (upper r) -> f.[t] != 0.
Hypothesis N_family : forall t i j, between t (lower r) (upper r) ->
  i \in indices P -> j \in indices P -> (N i j).[t] = f.[t] * T t i j.

Notation J := (moving P r).
Notation K := (others P r).
Notation k := (pivot c).
Notation v := (vector c).
Notation eps := (width (narrow_box c)).

Let D : decided P r.
Proof. by case/and5P: L. Qed.

Lemma inside (t : R) : between t (from_point c) (to_point c) -> between t (lower r) (upper r).
Proof. exact: (inside_region (R := R) O L (t := t)). Qed.

Lemma line_at (t : R) : between t (lower r) (upper r) -> near_line t.
Proof. by move=> bt; apply: (chord_line (chords bt bt)). Qed.

Definition family_row t (x : nat -> R) l := \sum_(j <- J) T t l j * x j.

Lemma pencil_row A B t x l : on_pencil A B t -> l \in J ->
  family_row t x l = row A B J t x l.
Proof.
by move=> on lJ; apply: sum_eq => j jJ; rewrite on //; apply: (moving_indices (r := r)).
Qed.

Lemma family_exists : exists t x,
  [/\ between t (from_point c) (to_point c), boxed (K k) k v eps x &
      forall l, l \in J -> family_row t x l = 0].
Proof.
have [[kJ vk inside_c change] [_ narrow _]] := isolated_parts L.
case/and4P: inside_c => o to2 _ _; have [p q p' q'] := ordered_ge0 R o.
have vk0 : 0 < toR (nth 0%Z v k) :> R by rewrite toR_gt0.
have F2 : 0 < toR (from_point c).2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
have T2 : 0 < toR (to_point c).2 :> R by rewrite toR_gt0.
have eps0 : 0 <= toR eps :> R := eps_ge0 R L.
have [tab e1 e2 betweenE] := ends_of R o to2.
set ta := _ / _ in tab e1 betweenE; set tb := _ / _ in tab e2 betweenE.
have K_sub l : l \in K k -> l \in J by rewrite others_moving => /andP[].

(* Regular on K, and boxed. *)
have inj t : ta <= t <= tb -> injective_on (K k) (T t).
  move=> /betweenE bt z rows; have [A [B [E on]]] := line_at (inside bt).
  have [a [b [comb _]]] := combination_of_weights A B o bt.
  apply: (regular_sound E (@moving_indices P r) (@others_moving P r k) (uniq_others P r k)
            narrow comb p q p' q') => l lK.
  rewrite -[RHS](rows l lK); apply: sum_eq => j jK.
  by rewrite on //; apply/moving_indices/K_sub.
have boxed_at A B t x : encloses P A B -> on_pencil A B t -> ta <= t <= tb ->
    x k = toR (nth 0%Z v k) ->
    (forall l, l \in K k -> family_row t x l = 0) -> boxed (K k) k v eps x.
  move=> E on /betweenE bt xk rows; have [a [b [comb _]]] := combination_of_weights A B o bt.
  split=> //; apply: (box_sound E (@moving_indices P r) (@others_moving P r k) kJ
    (uniq_moving P r) (uniq_others P r k) narrow comb p q p' q' xk) => l lK.
  by rewrite -[RHS](rows l lK) (pencil_row _ on) //; apply: K_sub.

case/andP: change => uk change; have {}uk : 0 < toR (nth 0%Z (left_vector c) k) :> R.
  by rewrite toR_gt0.
have left_k A B e t x : on_pencil A B t -> toR e.1 = t * toR e.2 ->
    (forall l, l \in K k -> family_row t x l = 0) ->
    left_at P A B r x e (left_vector c) =
      toR (nth 0%Z (left_vector c) k) * (toR e.2 * family_row t x k).
  move=> on e1' rows; rewrite (pencil_row _ on) //; apply: (left_pivot (@others_moving P r k)
    kJ (uniq_moving P r) (uniq_others P r k)) => // l lK.
  by rewrite -(pencil_row _ on) ?rows ?K_sub.

have [|||t [x [tt xk rows]]] := family_null_vector (poly_entry := N) (F := T) (d := f)
    (@others_moving P r k) kJ (uniq_moving P r) (uniq_others P r k) vk0 tab _ _ inj.
- by move=> t /betweenE/inside/f_regular.
- by move=> t i j /betweenE/inside bt iJ jJ; apply: N_family;
    rewrite // (moving_indices iJ, moving_indices jJ).
- move=> x y xk yk rows_x rows_y.
  have at_a : ta <= ta <= tb by rewrite lexx.
  have at_b : ta <= tb <= tb by rewrite lexx andbT.
  have [A [B [E on]]] := line_at (inside (betweenE _ at_a)).
  have [A' [B' [E' on']]] := line_at (inside (betweenE _ at_b)).
  have bx := boxed_at _ _ _ _ E on at_a xk rows_x.
  have by_ := boxed_at _ _ _ _ E' on' at_b yk rows_y.
  apply: (opposite_products uk F2 T2).
  rewrite -(left_k _ _ _ _ _ on e1 rows_x) -(left_k _ _ _ _ _ on' e2 rows_y).
  case/orP: change => /andP[s1 s2]; [left | right]; split.
  + exact: (left_negative_sound E kJ eps0 bx p q s1).
  + exact: (left_positive_sound E' kJ eps0 by_ p' q' s2).
  + exact: (left_positive_sound E kJ eps0 bx p q s1).
  exact: (left_negative_sound E' kJ eps0 by_ p' q' s2).

exists t, x; split=> //; first exact: betweenE.
have [A [B [E on]]] := line_at (inside (betweenE _ tt)).
by apply: (boxed_at A B t) => // l lK; apply/rows/K_sub.
Qed.

(* Every solution of the region is that null vector: by the chord through both values. *)
Lemma family_unique t x t' x' : between t (from_point c) (to_point c) ->
  boxed (K k) k v eps x -> (forall l, l \in J -> family_row t x l = 0) ->
  in_region_of P t' x' r -> family_solves t' x' ->
  t' = t /\ exists2 g, 0 < g & forall j, j \in J -> g * x' j = x j.
Proof.
move=> bt bx rows reg'; have [[kJ vk _ _] [wide _ uniq]] := isolated_parts L.
have [p q p' q'] := ordered_ge0 R O.
have [A [B [E on1 on2]]] := chords (inside bt) (proj1 reg').
move/(pencil_solution x' on2)=> sol'.
have [g g_gt0 [xk' null']] := scaled_solution D kJ vk sol' reg'.
have [a [b [comb one]]] := combination_of_weights A B O (inside bt).
have [a' [b' [comb' _]]] := combination_of_weights A B O (proj1 reg').
have bx' : boxed (K k) k v (width (wide_box c)) (fun j => g * x' j).
  split=> //; apply: (box_sound E (@moving_indices P r) (@others_moving P r k) kJ
    (uniq_moving P r) (uniq_others P r k) wide comb' p q p' q' xk'); exact: null_rows_K.
have null l : l \in J -> \sum_(j <- J) Enclosed.T A B t l j * x j = 0.
  by move=> lJ; rewrite -[RHS](rows l lJ) (pencil_row _ on1).
have [tt xx] := unique_sound E (@moving_indices P r) (@others_moving P r k) kJ (uniq_moving P r)
  (uniq_others P r k) uniq p q p' q' comb one bx' (proj1 bx) null null'.
by split=> //; exists g => // j jJ; rewrite xx.
Qed.

Theorem curved_solution : solution_signs P r c ->
  exists t x, [/\ between t (from_point c) (to_point c), family_solves t x, in_region_of P t x r &
    forall t' x', family_solves t' x' -> in_region_of P t' x' r ->
      t' = t /\ exists2 g, 0 < g & forall i, i \in indices P -> x' i = g * x i].
Proof.
case/andP=> /allP x_signs /allP y_signs.
have [[kJ vk /and4P[o to2 _ _] _] _] := isolated_parts L.
have [p q p' q'] := ordered_ge0 R o.
have eps0 : 0 <= toR eps :> R := eps_ge0 R L.
have [t [x [bt bx rows]]] := family_exists.
pose s j := if j \in J then x j else 0.
have [A [B [E on]]] := line_at (inside bt).

have positive j : j \in J -> 0 < x j.
  move=> jJ; have [->|jk] := eqVneq j k; first by rewrite (proj1 bx) toR_gt0.
  have jK : j \in K k by rewrite others_moving jJ.
  have := (proj2 bx) _ jK; rewrite ler_distl => /andP[+ _]; apply: lt_le_trans.
  by rewrite subr_gt0 toR_lt; apply: x_signs.

have t0 : 0 <= t.
  have f2 : 0 < toR (from_point c).2 :> R by case/and5P: o => _ ? _ _ _; rewrite toR_gt0.
  by rewrite -(pmulr_lge0 _ f2); apply: le_trans (proj1 bt).

have region_s : in_region_of P t s r.
  split; first exact: inside.
  move=> i lt_i; have Hi : i \in indices P by rewrite mem_iota.
  have iJ : (i \in J) = is_moving (state_of r i) by rewrite mem_filter Hi andbT.
  rewrite /s iJ; have := moving_or_resting D Hi; rewrite iJ.
  by have := positive i; rewrite iJ; case: (state_of r i) => //= h _; apply: h.

exists t, s; split=> //.
- apply/(pencil_solution s on); split=> //.
    by exists k; [apply: (moving_indices (r := r)) | rewrite /s kJ gt_eqF // positive].
  move=> i Hi; rewrite row_of_solution /s; have [iJ|iJ] := boolP (i \in J).
    by rewrite -/(row A B J t x i) -(pencil_row _ on) // rows // mulr0 lexx ltW // positive.
  rewrite mul0r lexx; split=> //; apply: ltW.
  have [a [b [comb _]]] := combination_of_weights A B o bt; have [a0 b0 ab _] := comb.
  rewrite (row_combination P r x i comb).
  have not_moving : is_moving (state_of r i) = false.
    by move: iJ; rewrite mem_filter Hi andbT => /negbTE.
  have := y_signs _ Hi; rewrite not_moving /= => /andP[y1 y2].
  apply: combination_gt0 => //; first exact: (row_positive_sound E kJ eps0 bx p q Hi y1).
  exact: (row_positive_sound E kJ eps0 bx p' q' Hi y2).

move=> t' x' sol' reg'; have [tt [g g0 scaled]] := family_unique bt bx rows reg' sol'.
split=> //; exists g^-1 => [|i Hi]; first by rewrite invr_gt0.
rewrite /s; have [iJ|iJ] := boolP (i \in J); first by rewrite -scaled // mulKf // gt_eqF.
by rewrite (zero_off_J D (proj2 reg')) // mulr0.
Qed.

End Solution.

End Curved.

(* A pencil is such a family, with f = 1. *)
Section Pencil.

Variable R : rcfType.
Variables (P : enclosed) (A B : nat -> nat -> R).
Hypothesis E : encloses P A B.

Variables (r : region) (c : isolation).
Hypotheses (O : ordered (lower r) (upper r)) (L : isolated P r c).

Notation T := (T A B).
Notation solves := (solves P A B).
Notation J := (moving P r).
Notation K := (others P r).
Notation null_vector := (null_vector A B J).
Notation k := (pivot c).
Notation v := (vector c).
Notation eps := (width (narrow_box c)).

Let D : decided P r.
Proof. by case/and5P: L. Qed.

Let chords (t t' : R) : between t (lower r) (upper r) -> between t' (lower r) (upper r) ->
  near_chord P T t t'.
Proof. by exists A, B. Qed.

Let one_regular (t : R) : between t (lower r) (upper r) -> (1 : {poly R}).[t] != 0.
Proof. by rewrite hornerC oner_neq0. Qed.

Let entries (t : R) i j : between t (lower r) (upper r) -> i \in indices P -> j \in indices P ->
  (linear_entry A B i j).[t] = (1 : {poly R}).[t] * T t i j.
Proof. by rewrite hornerC mul1r -linear_entryE. Qed.

Theorem isolated_exists : exists t x,
  [/\ between t (from_point c) (to_point c), boxed (K k) k v eps x & null_vector t x].
Proof. exact: (family_exists O L chords one_regular entries). Qed.

Theorem isolated_unique t x t' x' :
  between t (from_point c) (to_point c) -> boxed (K k) k v eps x -> null_vector t x ->
  in_region_of P t' x' r -> solves t' x' ->
  t' = t /\ exists2 f, 0 < f & forall j, j \in J -> f * x' j = x j.
Proof. exact: (family_unique O L chords). Qed.

Theorem solution_sound : solution_signs P r c ->
  exists t x, [/\ between t (from_point c) (to_point c), solves t x, in_region_of P t x r &
    forall t' x', solves t' x' -> in_region_of P t' x' r ->
      t' = t /\ exists2 f, 0 < f & forall i, i \in indices P -> x' i = f * x i].
Proof. exact: (curved_solution O L chords one_regular entries). Qed.

Theorem negative_x_sound i t x : i \in K k -> (nth 0%Z v i <? - eps)%Z ->
  in_region_of P t x r -> solves t x -> False.
Proof.
move=> iK neg reg sol; have [t' [x' [bt bx null]]] := isolated_exists.
have [_ [f f0 scaled]] := isolated_unique bt bx null reg sol.
have iJ : i \in J by move: iK; rewrite others_moving => /andP[].
have [positive _ _] := solution_on_J D sol reg.
have := (proj2 bx) _ iK; rewrite ler_distl => /andP[_].
rewrite -scaled //; apply/negP; rewrite -ltNge.
apply: (@lt_trans _ _ 0); last by rewrite mulr_gt0 // positive.
by rewrite -toRD toR_lt0; move: neg; clear; lia.
Qed.

Theorem negative_y_sound i t x : i \in indices P -> ~~ is_moving (state_of r i) ->
  both_ends c (fun e => row_negative P r k v eps e i) ->
  in_region_of P t x r -> solves t x -> False.
Proof.
move=> Hi not_moving /andP[n1 n2] reg sol; have [t' [x' [bt bx null]]] := isolated_exists.
have [tt [f f0 scaled]] := isolated_unique bt bx null reg sol.
have [[kJ _ /and4P[o _ _ _] _] _] := isolated_parts L.
have [p q p' q'] := ordered_ge0 R o.
have [_ zero _] := solution_on_J D sol reg.
have [_ _ compl] := sol; have [_ + _] := compl _ Hi; apply/negP; rewrite -ltNge.

have imageE : f * image P A B t x i = \sum_(j <- J) T t i j * x' j.
  rewrite /image mulr_sumr (sum_moving (r := r)) => [|j Hj jJ]; last by rewrite zero ?mulr0.
  by apply: eq_big_seq => j jJ; rewrite -scaled // mulrCA.
rewrite -(pmulr_rlt0 _ f0) imageE tt.
have [a [b [comb _]]] := combination_of_weights A B o bt; have [a0 b0 ab _] := comb.
rewrite (row_combination P r x' i comb) -oppr_gt0 opprD -!mulrN.
apply: combination_gt0 => //; rewrite oppr_gt0.
  exact: (row_negative_sound E kJ (eps_ge0 R L) bx p q Hi n1).
exact: (row_negative_sound E kJ (eps_ge0 R L) bx p' q' Hi n2).
Qed.

End Pencil.
