(* A solution at every friction of an interval.

   A *piece* is a decided box: an interval [t0, t1] of t, an interval [low, high] of mu, the moving
   variables J with the pivot k.  Let T(t, mu) be the matrix at a point of the box, as in Boxes.v.
   The witness has three parts of the kind of Regular.v, with the same pivot:

     box     at the four corners the rows of the check, which enclose the vectors x with x_k = V_k
             whose rows in K vanish: |x_j - V_j| <= e_j.  V_j > e_j, so they are positive.  For each
             variable at rest (T_c x)_i >= 0 for all x of the enclosure, at each corner;
     start   at the corners with t = t0 the rows and the sign, with U_k > 0;
     finish  the same at t = t1, with the other sign.

   Each of the two has enclosures of its own, of a matrix that is T at this t with its rows
   multiplied by positive numbers.  So they may be those of a short interval that begins or ends
   there.

   Theorem [piece_exists]: if the check succeeds, then for each mu in [low, high] there is a t in
   [t0, t1] with a solution in the region.

   For each t the row k of the x with x_k = V_k whose other rows vanish is phi(t).  A multiple of T
   has polynomials as entries, so phi has a root between two values where its signs are opposite
   (Existence.v).  There x is a null vector, it is positive on J, and y_i >= 0 at rest.

   Page: spec/certificates.md, 5.19.  Rust: crates/check/src/cover/presence.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Root Existence RootLeaf Boxes Regular.

Record presence := Presence {
  presence_box : regular;
  presence_start : regular;
  presence_finish : regular }.

Section Checker.

Variables (P P' : enclosed) (r : region) (k : nat).

Notation l := (regular_order P r k).
Notation m := ((size l).-1).

(* (T_c x)_i >= 0 for all x of the enclosure. *)
Definition rest_row (v : regular) (i c : nat) :=
  let p := [seq center (corner_pencil P P' c) (corner_end r c) i j | j <- l] in
  let q := [seq radius (corner_pencil P P' c) (corner_end r c) i j | j <- l] in
  (row_slack m v p q <=? against_right m v p)%Z.

Definition positive_vector (v : regular) :=
  (0 <? nth 0%Z (regular_right v) 0)%Z.

Definition presence_edge (e : regular) (cs : seq nat) :=
  [&& positive_vector e, (0 <? nth 0%Z (regular_left e) 0)%Z &
      all (fun c => rows_at P P' r l e c && sign_at P P' r l e c) cs].

Definition presence_inside (v : regular) :=
  [&& all (rows_at P P' r l v) four_corners,
      all (fun j => nth 0%Z (regular_widths v) j <? nth 0%Z (regular_right v) j.+1)%Z (iota 0 m) &
      all (fun i => is_moving (state_of r i) || all (rest_row v i) four_corners) (indices P)].

End Checker.

(* Enclosures at both ends of the interval of mu, over the interval of t and at its edges. *)
Definition check_presence_piece (inside start finish : enclosed * enclosed) (r : region)
    (w : presence) :=
  let k := regular_pivot (presence_box w) in
  [&& decided inside.1 r, k \in moving inside.1 r, (0 <? (upper r).2)%Z,
      positive_vector (presence_box w) & presence_inside inside.1 inside.2 r k (presence_box w)] &&
  [&& presence_edge start.1 start.2 r k (presence_start w) [:: 0; 2]%N,
      presence_edge finish.1 finish.2 r k (presence_finish w) [:: 1; 3]%N &
      regular_minus (presence_start w) (+) regular_minus (presence_finish w)].

(* What the corners in cs say of a vector x whose rows in K vanish, for the matrix F at t. *)
Section AtCorners.

Variables (R : rcfType) (P P' : enclosed) (r : region) (k : nat).
Hypotheses (same : size_of P' = size_of P) (pivot_moving : k \in moving P r).
Hypothesis O : ordered (lower r) (upper r).

Notation J := (moving P r).
Notation K := (others P r k).
Notation l := (regular_order P r k).
Notation m := ((size l).-1).

Lemma moving_index i : i \in J -> i \in indices P.
Proof. by rewrite mem_filter => /andP[]. Qed.

Lemma others_J i : i \in K -> i \in J.
Proof. by rewrite mem_filter => /andP[]. Qed.

Lemma place_of i : i \in K -> exists2 n, (n < m)%N & nth 0%N l n.+1 = i.
Proof. by move=> /(nthP 0%N)[n lt_n <-]; exists n. Qed.

Lemma place_others n : (n < m)%N -> nth 0%N l n.+1 \in K.
Proof. exact: mem_nth. Qed.

(* Row i of a matrix, applied to a vector over the moving variables. *)
Definition moving_row (F : nat -> nat -> R) (x : nat -> R) i := \sum_(j <- J) F i j * x j.

Variables (v : regular) (cs : seq nat) (t f g : R) (F : nat -> nat -> R) (x : nat -> R) (a : R).
Variables (A B A' B' : nat -> nat -> R) (weight : nat -> R).
Hypotheses (E : encloses P A B) (E' : encloses P' A' B').
Hypothesis on : forall i j, i \in indices P -> j \in indices P ->
  F i j = mixed_at A B A' B' t f g i j.
Hypothesis ws : weights_of_corners A B A' B' r t f g cs weight.
Hypothesis rows_ok : forall c, c \in cs -> rows_at P P' r l v c.
Hypothesis rows : forall i, i \in K -> moving_row F x i = 0.
Hypotheses (a0 : 0 <= a) (x_pivot : x k = a * toR (nth 0%Z (regular_right v) 0)).

Notation T c := (fun i j => matrix_at A B A' B' r c (nth 0%N l i) (nth 0%N l j)).
Notation xs := (fun j => x (nth 0%N l j)).

Lemma corner_rows i : i \in indices P -> moving_row F x i =
  \sum_(c <- cs) weight c *
    (\sum_(j <- iota 0 m.+1) matrix_at A B A' B' r c i (nth 0%N l j) * xs j).
Proof.
move=> Hi; rewrite -(row_of_corners xs _ _ _ ws) -size_order.
rewrite -(sum_order pivot_moving (fun j => mixed_at A B A' B' t f g i j * x j)).
by apply: sum_eq => j jJ; rewrite on // moving_index.
Qed.

Lemma corner_sizes c : c \in cs ->
  size (corner_center P P' r l c) = m.+1 /\ size (corner_radius P P' r l c) = m.+1.
Proof. by move=> _; rewrite !size_restricted. Qed.

Lemma corners_near c i j : c \in cs -> (i < m.+1)%N -> (j < m.+1)%N ->
  `|T c i j - toR (entry (corner_center P P' r l c) i j)| <=
  toR (entry (corner_radius P P' r l c) i j).
Proof.
by move=> _ lt_i lt_j; apply: corner_near => // j'; apply: order_indices pivot_moving _.
Qed.

Lemma null_corner i : (i < m)%N ->
  \sum_(c <- cs) weight c * row_at_corner m (fun c => T c) xs c i.+1 = 0.
Proof.
move=> lt_i; have iK := place_others lt_i.
by rewrite -[RHS](rows iK) corner_rows // moving_index // others_J.
Qed.

Lemma boxed_at n : (n < m)%N ->
  `|x (nth 0%N l n.+1) - a * toR (nth 0%Z (regular_right v) n.+1)| <=
  a * toR (nth 0%Z (regular_widths v) n).
Proof.
case: ws => w0 w_gt0 _ lt_n.
apply: (@near_null R m v cs (corner_center P P' r l) (corner_radius P P' r l)
  (fun c => nth 0%Z (regular_units v) c) (fun c => T c) weight xs corner_sizes corners_near
  rows_ok w0 w_gt0 null_corner a a0 x_pivot).
by rewrite mem_iota.
Qed.

Lemma pivot_sign : (forall c, c \in cs -> sign_at P P' r l v c) -> 0 < a ->
  0 < regular_side R v * (toR (nth 0%Z (regular_left v) 0) * moving_row F x k).
Proof.
case: ws => w0 w_gt0 _ signs a_gt0; rewrite corner_rows ?moving_index ?pivot_moving //.
exact: (@sign_of_pivot_row R m v cs (corner_center P P' r l) (corner_radius P P' r l)
  (fun c => nth 0%Z (regular_units v) c) (fun c => T c) weight xs corner_sizes corners_near
  rows_ok w0 w_gt0 null_corner a a0 x_pivot signs a_gt0).
Qed.

(* A row at rest. *)
Lemma rest_row_ge0 i : i \in indices P ->
  (forall c, c \in cs -> rest_row P P' r k v i c) -> 0 <= moving_row F x i.
Proof.
case: ws => w0 w_gt0 _ Hi rest; rewrite corner_rows //; apply: sum_ge0 => c Hc.
rewrite mulr_ge0 ?w0 //; have := rest c Hc; rewrite /rest_row -(@toR_le R).
set p := map _ l; set q := map _ l => le.
have nearp j : j \in iota 0 m.+1 ->
    `|matrix_at A B A' B' r c i (nth 0%N l j) - toR (nth 0%Z p j)| <= toR (nth 0%Z q j).
  rewrite mem_iota add0n => /= lt_j; have in_l : nth 0%N l j \in l by apply: mem_nth.
  have Hj := order_indices pivot_moving in_l.
  have [p0 q0 p0' q0'] := ordered_ge0 R O.
  have e1 : 0 <= toR (corner_end r c).1 :> R by rewrite /corner_end; case: odd.
  have e2 : 0 <= toR (corner_end r c).2 :> R by rewrite /corner_end; case: odd.
  rewrite !(nth_map 0%N) // /matrix_at /corner_pencil; case: ifP => _.
    exact: T_end_enclosed.
  by apply: T_end_enclosed => //; rewrite /indices same.
have := @row_slack_sound R m v cs (corner_center P P' r l) (corner_radius P P' r l)
  (fun c => nth 0%Z (regular_units v) c) (fun c => T c) weight xs corner_sizes corners_near
  rows_ok w0 w_gt0 null_corner a a0 x_pivot _ p q nearp.
rewrite ler_distl => /andP[low _]; apply: le_trans low.
by rewrite -mulrBr mulr_ge0 // subr_ge0.
Qed.

End AtCorners.

Section Sound.

Variables (R : rcfType) (P P' Ps Ps' Pf Pf' : enclosed).
Hypothesis same : size_of P' = size_of P.
Hypotheses (same_s : size_of Ps = size_of P) (same_s' : size_of Ps' = size_of P).
Hypotheses (same_f : size_of Pf = size_of P) (same_f' : size_of Pf' = size_of P).
Variables (F : R -> nat -> nat -> R) (Fs Ff : nat -> nat -> R).
Variables (r : region) (f g : R).
Hypotheses (O : ordered (lower r) (upper r)).
Hypotheses (f0 : 0 <= f) (g0 : 0 <= g) (fg : 0 < f \/ 0 < g).

Let ta : R := toR (lower r).1 / toR (lower r).2.
Let tb : R := toR (upper r).1 / toR (upper r).2.

(* The matrix G at t is on lines of both enclosures. *)
Definition on_lines (P1 P2 : enclosed) t (G : nat -> nat -> R) := exists A B A' B',
  [/\ encloses P1 A B, encloses P2 A' B' & forall i j, i \in indices P -> j \in indices P ->
      G i j = mixed_at A B A' B' t f g i j].

(* G is F at t, with its rows multiplied by positive numbers. *)
Definition multiple_rows t (G : nat -> nat -> R) := exists2 rho : nat -> R,
  forall i, i \in indices P -> 0 < rho i &
  forall i j, i \in indices P -> j \in indices P -> G i j = rho i * F t i j.

Hypothesis near : forall t, between t (lower r) (upper r) -> on_lines P P' t (F t).
Hypotheses (near_s : on_lines Ps Ps' ta Fs) (near_f : on_lines Pf Pf' tb Ff).
Hypotheses (rows_s : multiple_rows ta Fs) (rows_f : multiple_rows tb Ff).

Variables (d : {poly R}) (N : nat -> nat -> {poly R}).
Hypothesis d_regular : forall t, between t (lower r) (upper r) -> d.[t] != 0.
Hypothesis N_family : forall t i j, between t (lower r) (upper r) ->
  i \in indices P -> j \in indices P -> (N i j).[t] = d.[t] * F t i j.

Variable w : presence.
Hypothesis checked : check_presence_piece (P, P') (Ps, Ps') (Pf, Pf') r w.

Notation k := (regular_pivot (presence_box w)).
Notation J := (moving P r).
Notation K := (others P r k).
Notation l := (regular_order P r k).
Notation m := ((size l).-1).
Notation family_row t := (moving_row P r (F t)).

Lemma pivot_moving : k \in J.
Proof. by case/andP: checked => /and5P[]. Qed.

Let V0 : R := toR (nth 0%Z (regular_right (presence_box w)) 0).

Lemma checked_parts :
  [/\ [/\ decided P r, (0 <? (upper r).2)%Z & 0 < V0],
      forall c, c \in four_corners -> rows_at P P' r l (presence_box w) c,
      forall n, (n < m)%N -> toR (nth 0%Z (regular_widths (presence_box w)) n) <
         toR (nth 0%Z (regular_right (presence_box w)) n.+1) :> R,
      forall i, i \in indices P -> ~~ is_moving (state_of r i) ->
         forall c, c \in four_corners -> rest_row P P' r k (presence_box w) i c &
      [/\ presence_edge Ps Ps' r k (presence_start w) [:: 0; 2]%N,
          presence_edge Pf Pf' r k (presence_finish w) [:: 1; 3]%N &
          regular_minus (presence_start w) (+) regular_minus (presence_finish w)]].
Proof.
case/andP: checked => /and5P[dec _ fin v0 /and3P[/allP rows_ok /allP pos /allP rest]] /and3P[? ? ?].
split=> //; first by split=> //; rewrite toR_gt0.
  by move=> n lt_n; rewrite toR_lt; apply: pos; rewrite mem_iota.
by move=> i Hi still c Hc0; have := rest i Hi; rewrite (negbTE still) orFb => /allP/(_ c Hc0).
Qed.

(* T(t) is regular on K. *)
Lemma family_injective t : between t (lower r) (upper r) -> injective_on K (F t).
Proof.
move=> bt z rows i iK; have [_ rows_ok _ _ _] := checked_parts.
have [A [B [A' [B' [E E' on]]]]] := near bt.
have [weight ws] := box_weights A B A' B' O bt f0 g0 fg.
pose x j := if j == k then 0 else z j.
have x_others j : j \in K -> x j = z j by rewrite mem_filter /x => /andP[/negbTE->].
have K_J j : (j \in K) = (j \in J) && (j != k) by rewrite mem_filter andbC.
have rows_x n : n \in K -> family_row t x n = 0.
  move=> nK; rewrite -[RHS](rows n nK) /moving_row (sum_pivot K_J pivot_moving); last 2 first.
  - by rewrite filter_uniq ?iota_uniq.
  - by rewrite !filter_uniq ?iota_uniq.
  by rewrite {1}/x eqxx mulr0 add0r; apply: sum_eq => j jK; rewrite x_others.
have x_pivot : x k = 0 * toR (nth 0%Z (regular_right (presence_box w)) 0) by rewrite /x eqxx mul0r.
have [n lt_n nE] := place_of iK.
have := boxed_at same pivot_moving O E E' on ws rows_ok rows_x (lexx 0) x_pivot lt_n.
by rewrite nE !mul0r subr0 x_others // normr_le0 => /eqP.
Qed.

(* The sign of phi at both ends. *)
Lemma edge_sign (P1 P2 : enclosed) t (G : nat -> nat -> R) x e cs :
  size_of P1 = size_of P -> size_of P2 = size_of P ->
  on_lines P1 P2 t G -> multiple_rows t G ->
  (forall A B A' B', exists weight, weights_of_corners A B A' B' r t f g cs weight) ->
  presence_edge P1 P2 r k e cs -> 0 < x k -> (forall i, i \in K -> family_row t x i = 0) ->
  0 < regular_side R e * family_row t x k.
Proof.
move=> same1 same2 [A [B [A' [B' [E1 E2 on]]]]] [rho rho0 rowE] weights /and3P[v0 u0 /allP corners].
move=> xk rows; have [weight ws] := weights A B A' B'.
have eqI : indices P1 = indices P by rewrite /indices same1.
have eqJ : moving P1 r = J by rewrite /moving eqI.
have eqK : others P1 r k = K by rewrite /others eqJ.
have scaled i : i \in indices P -> moving_row P1 r G x i = rho i * family_row t x i.
  move=> Hi; rewrite /moving_row eqJ mulr_sumr; apply: sum_eq => j jJ.
  by rewrite rowE ?mulrA // (moving_index jJ).
have k1 : k \in moving P1 r by rewrite eqJ pivot_moving.
have kI : k \in indices P := moving_index pivot_moving.
have V_gt0 : 0 < toR (nth 0%Z (regular_right e) 0) :> R by rewrite toR_gt0.
have x_pivot : x k = x k / toR (nth 0%Z (regular_right e) 0) * toR (nth 0%Z (regular_right e) 0).
  by rewrite divfK // gt_eqF.
have a_gt0 : 0 < x k / toR (nth 0%Z (regular_right e) 0) by apply: divr_gt0.
have rows_ok c : c \in cs -> rows_at P1 P2 r (regular_order P1 r k) e c by move/corners/andP=> [].
have signs c : c \in cs -> sign_at P1 P2 r (regular_order P1 r k) e c by move/corners/andP=> [].
have on1 i j : i \in indices P1 -> j \in indices P1 -> G i j = mixed_at A B A' B' t f g i j.
  by rewrite eqI; apply: on.
have rows1 i : i \in others P1 r k -> moving_row P1 r G x i = 0.
  by rewrite eqK => iK; rewrite scaled ?rows ?mulr0 // (moving_index (others_J iK)).
have same12 : size_of P2 = size_of P1 by rewrite same1.
have := pivot_sign same12 k1 O E1 E2 on1 ws rows_ok rows1 (ltW a_gt0) x_pivot signs a_gt0.
by rewrite scaled // mulrCA pmulr_rgt0 ?toR_gt0 // mulrCA pmulr_rgt0 // rho0.
Qed.

Theorem piece_exists : exists t x, [/\ between t (lower r) (upper r),
  exists2 i, i \in indices P & x i != 0, agrees (size_of P) r x &
  forall i, i \in indices P -> let y := \sum_(j <- indices P) F t i j * x j in
    [/\ 0 <= x i, 0 <= y & x i * y = 0]].
Proof.
have [[dec fin V_gt0] rows_ok pos rest [start finish ne]] := checked_parts.
have [tab ea eb inside] := ends_of R O fin; rewrite -/ta -/tb in tab ea eb inside.
have K_J j : (j \in K) = (j \in J) && (j != k) by rewrite mem_filter andbC.
have uJ : uniq J by rewrite filter_uniq ?iota_uniq.
have uK : uniq K by rewrite filter_uniq.
have [|||t [x [tt xk null]]] := family_null_vector (poly_entry := N) (F := F) (d := d)
    K_J pivot_moving uJ uK V_gt0 tab _ _ (fun t tt => family_injective (inside t tt)).
- by move=> t /inside/d_regular.
- by move=> t i j /inside bt iJ jJ; apply: N_family; rewrite // (moving_index iJ, moving_index jJ).
- move=> x y xk yk rows_x rows_y.
  have sx : 0 < regular_side R (presence_start w) * family_row ta x k.
    apply: (edge_sign same_s same_s' near_s rows_s _ start) => //; last by rewrite xk.
    by move=> A B A' B'; apply: lower_weights.
  have sy : 0 < regular_side R (presence_finish w) * family_row tb y k.
    apply: (edge_sign same_f same_f' near_f rows_f _ finish) => //; last by rewrite yk.
    by move=> A B A' B'; apply: upper_weights.
  move: ne sx sy; rewrite /regular_side.
  case: (regular_minus _); case: (regular_minus _) => // _; rewrite mulN1r mul1r oppr_gt0 => sx sy.
    by rewrite nmulr_rlt0.
  by rewrite pmulr_rlt0.
have bt := inside t tt; pose s j := if j \in J then x j else 0.
have {}null i : i \in J -> family_row t x i = 0 by apply: null.
have rows i : i \in K -> family_row t x i = 0 by move/others_J/null.
have [A [B [A' [B' [E E' on]]]]] := near bt.
have [weight ws] := box_weights A B A' B' O bt f0 g0 fg.
have x_pivot : x k = 1 * toR (nth 0%Z (regular_right (presence_box w)) 0) by rewrite mul1r.
have positive i : i \in J -> 0 < x i.
  move=> iJ; have [->|ik] := eqVneq i k; first by rewrite xk.
  have iK : i \in K by rewrite K_J iJ.
  have [n lt_n <-] := place_of iK.
  have := boxed_at same pivot_moving O E E' on ws rows_ok rows ler01 x_pivot lt_n.
  by rewrite !mul1r ler_distl => /andP[+ _]; apply: lt_le_trans; rewrite subr_gt0 pos.
have s_row i : \sum_(j <- indices P) F t i j * s j = family_row t x i.
  rewrite (sum_decided (P := P) (r := r)) // => [|j Hj still]; last first.
    by rewrite /s mem_filter (negbTE still).
  by apply: sum_eq => j jJ; rewrite /s jJ.
exists t, s; split=> //.
- by exists k; [exact: moving_index pivot_moving | rewrite /s pivot_moving xk gt_eqF].
- move=> j lt_j; have j_in : j \in indices P by rewrite mem_iota.
  rewrite /s mem_filter j_in andbT.
  case state_j: (state_of r j) => //=; apply: positive; rewrite mem_filter j_in andbT.
  by rewrite state_j.
move=> i Hi y; rewrite /y s_row /s; have [iJ|iJ] := boolP (i \in J).
  by rewrite null // mulr0 lexx ltW // positive.
rewrite mul0r lexx; split=> //.
have still : ~~ is_moving (state_of r i) by move: iJ; rewrite mem_filter Hi andbT.
exact: (rest_row_ge0 same pivot_moving O E E' on ws rows_ok rows ler01 x_pivot Hi
  (rest i Hi still)).
Qed.

End Sound.
