(* Complete sets for pencils whose free rows depend on the value: condensation about anchors.

   The checker gets a pencil, a window [lo, hi] (hi may be infinity), factors that bound A_ff and
   B_ff from below, a list of anchors (Anchor.v), and a tree.  A leaf is either evidence about the
   whole pencil (Whole.v) or names one of the anchors and has evidence about the pencil that is
   condensed about it.

   An anchor may be *reversed*: it expands in s = 1/t the pencil with A and B exchanged, which for
   t > 0 has the same solutions, y divided by t ([swap_solution]).  A region [lo, hi] with lo > 0 is
   [1/hi, 1/lo] there; an infinite end becomes 0, which is 1/t for no t.

   Theorem [varying_sound]: if the check succeeds, then
     1. each solution with a value in the window lies in the region of something yielded;
     2. each region yielded has exactly one solution up to a positive factor, and its value lies
        between from and to.
   [varying_none]: nothing yielded, no solution in the window.  [varying_one]: one thing yielded,
   exactly one solution in the window.  [system_varying], [system_varying_none],
   [system_varying_one]: the same for the motions of a mechanical system with (9).

   Page: spec/certificates.md, 5.6, 5.14.
   Rust: crates/check/src/cover/condensed.rs, expanded.rs, family.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Covered Definite Root RootLeaf.
From Mceip Require Import Condensation Pencil Whole Complete System Series Anchor AnchorLeaf.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

(* Bounds of A_ff and of B_ff; anchors, each with "is it reversed". *)
Record anchoring := Anchoring {
  stiffness_bound : form_bound;
  mass_bound : form_bound;
  anchors : seq (bool * anchor) }.

(* The number of an anchor, the grain of its local pencil, evidence; or evidence about the whole
   pencil, its free rows multiplied by a positive integer. *)
Inductive varying_leaf :=
  | OfAnchor of nat & Z & local_leaf
  | OfWhole of Z & whole.

(* The pencil with its free rows multiplied by c. *)
Definition scale_free c Q :=
  let scaled (row : nat -> sparse_row) :=
    [seq if i \in free Q then times c (row i) else row i | i <- iota 0 (order Q)] in
  Pencil (order Q) (scaled (row_a Q)) (scaled (row_b Q)) (free Q).

Definition swap_pencil Q := Pencil (order Q) (rows_b Q) (rows_a Q) (free Q).

Definition swap_point (e : point) : point := (e.2, e.1).

Definition swap_region r := Region (swap_point (upper r)) (swap_point (lower r)) (states r).

Definition swap_isolation (c : isolation) : isolation :=
  Isolation (pivot c) (vector c) (swap_point (to_point c)) (swap_point (from_point c))
    (wide_box c) (narrow_box c) (unique c) (left_vector c).

Definition swap_leaf l := if l is LocalRoot c o then LocalRoot (swap_isolation c) o else l.

Section Checker.

Variables (Q : pencil) (w : anchoring).

Definition expand_anchor (ra : bool * anchor) : option family :=
  if ra.1 then expand (swap_pencil Q) ra.2 else expand Q ra.2.

Definition no_anchor := (false, Anchor zero 0 [::] [::] [::]).

(* The value of a root is finite. *)
Definition finite_root l := if l is LocalRoot c _ then (0 <? (to_point c).2)%Z else true.

Definition check_varying_leaf ns (families : seq (option family)) (r : region)
    (l : varying_leaf) :=
  match l with
  | OfWhole c e => (0 <? c)%Z && check_whole (scale_free c Q) r e
  | OfAnchor n grain e =>
      let: (reverse, a) := nth no_anchor (anchors w) n in
      if nth None families n is Some fam then
        if reverse then
          [&& (0 <? (lower r).1)%Z, finite_root e &
              check_anchored ns a (mass_bound w) (stiffness_bound w) fam
                (swap_point (upper r)) (swap_point (lower r)) (swap_region r) grain (swap_leaf e)]
        else
          check_anchored ns a (stiffness_bound w) (mass_bound w) fam
            (lower r) (upper r) r grain e
      else false
  end.

Definition families_of := [seq expand_anchor ra | ra <- anchors w].

Definition check_varying (tr : tree varying_leaf) (lo hi : point) :=
  let families := families_of in
  let ns := size (slip Q) in
  [&& wellformed Q, bounded_rows (size (free Q)) (ff_block Q (row_a Q)) (stiffness_bound w),
      bounded_rows (size (free Q)) (ff_block Q (row_b Q)) (mass_bound w) &
      check_tree ns (check_varying_leaf ns families) tr (Region lo hi [::])].

Definition varying_yield (rl : region * varying_leaf) : option (region * isolation) :=
  if rl.2 is OfAnchor _ _ (LocalRoot c Solution) then Some (rl.1, c) else None.

Definition varying_found (tr : tree varying_leaf) (lo hi : point) :=
  pmap varying_yield (leaves tr (Region lo hi [::])).

End Checker.

Definition check_system_varying s u w tr lo hi :=
  system_wellformed s u && check_varying (pencil_of s u) w tr lo hi.

Lemma in_pmap_ T U (f : T -> option U) (l : seq T) y :
  List.In y (pmap f l) <-> exists2 x, List.In x l & f x = Some y.
Proof.
elim: l => [|a l IH] /=; first by split=> [|[]].
case fa: (f a) => [b|] /=.
  split=> [[<-|/IH[x xl fx]]|[x [<-|xl] fx]].
  - by exists a => //; left.
  - by exists x => //; right.
  - by left; move: fx; rewrite fa => -[].
  - by right; apply/IH; exists x.
split=> [/IH[x xl fx]|[x [ax|xl] fx]].
- by exists x => //; right.
- by move: fx; rewrite -ax fa.
- by apply/IH; exists x.
Qed.

Section ScaleFree.

Variables (R : rcfType) (Q : pencil) (c : Z).
Hypothesis wf : wellformed Q.

Lemma scaled_reaction (t : R) x i : i \in iota 0 (order Q) ->
  reaction (scale_free c Q) t x i =
  (if i \in free Q then toR c else 1) * reaction Q t x i.
Proof.
move=> Hi; have lt_i : (i < order Q)%N by move: Hi; rewrite mem_iota.
rewrite /reaction mulr_sumr; apply: eq_bigr => j _.
rewrite /a_entry /b_entry ![row_a (scale_free c Q) i]/row_a ![row_b (scale_free c Q) i]/row_b /=.
rewrite !(nth_map 0%N) ?size_iota // nth_iota // add0n.
case: ifP => _; last by rewrite mul1r.
by rewrite !lookup_times; move: (toR _) (toR _) (toR _) (x j) => *; ring.
Qed.

Lemma scaled_solution (t : R) x : solution Q t x -> solution (scale_free c Q) t x.
Proof.
case=> t0 nz rows_f rows_s; split=> //.
  move=> i Hi; rewrite scaled_reaction; last exact: (free_indices wf).
  by rewrite rows_f // mulr0.
move=> i Hi; rewrite scaled_reaction; last exact: (slip_indices (Q := Q)).
have /negbTE-> : i \notin free Q by move: Hi; rewrite mem_filter => /andP[].
by rewrite mul1r; apply: rows_s.
Qed.

End ScaleFree.

Section Swap.

Variables (R : rcfType) (Q : pencil).
Implicit Types (t s : R) (x : nat -> R).

Lemma swap_reaction t x i : t != 0 ->
  reaction (swap_pencil Q) t^-1 x i = t^-1 * reaction Q t x i.
Proof.
move=> t0; rewrite /reaction mulr_sumr; apply: eq_bigr => j _.
rewrite -[a_entry R (swap_pencil Q) i j]/(b_entry R Q i j).
rewrite -[b_entry R (swap_pencil Q) i j]/(a_entry R Q i j).
by rewrite mulrA mulrDr mulrA mulVf // mul1r [X in X * _]addrC.
Qed.

Lemma swap_solution t x : 0 < t -> solution Q t x <-> solution (swap_pencil Q) t^-1 x.
Proof.
move=> t_gt0; have t0 := lt0r_neq0 t_gt0; have i0 : 0 < t^-1 by rewrite invr_gt0.
split=> -[_ nz rows_f rows_s]; split=> //; rewrite ?invr_ge0 ?(ltW t_gt0) //.
- by move=> i Hi; rewrite swap_reaction // rows_f // mulr0.
- move=> i Hi; have [x0 y0 xy] := rows_s i Hi; rewrite swap_reaction // pmulr_rge0 //.
  by split=> //; rewrite mulrCA xy mulr0.
- move=> i Hi; have := rows_f i Hi; rewrite swap_reaction // => /eqP.
  by rewrite mulf_eq0 gt_eqF //= => /eqP.
move=> i Hi; have := rows_s i Hi; rewrite swap_reaction // pmulr_rge0 // mulrCA.
by case=> x0 y0 /eqP; rewrite mulf_eq0 [t^-1 == 0]gt_eqF //= => /eqP.
Qed.

Lemma swap_between t (lo hi : point) : 0 < t -> between t lo hi ->
  between t^-1 (swap_point hi) (swap_point lo).
Proof.
move=> t0 [lo_t t_hi]; split; rewrite /swap_point /=.
  by rewrite mulrC ler_pdivl_mulr // mulrC.
by rewrite mulrC ler_pdivr_mulr // mulrC.
Qed.

End Swap.

Section Sound.

Variables (R : rcfType) (Q : pencil) (w : anchoring) (tr : tree varying_leaf) (lo hi : point).
Hypothesis checked : check_varying Q w tr lo hi.

Notation ns := (size (slip Q)).
Notation found := (varying_found tr lo hi).

Lemma varying_parts :
  [/\ wellformed Q, bounded_rows (size (free Q)) (ff_block Q (row_a Q)) (stiffness_bound w),
      bounded_rows (size (free Q)) (ff_block Q (row_b Q)) (mass_bound w) &
      check_tree ns (check_varying_leaf Q w ns (families_of Q w)) tr (Region lo hi [::])].
Proof. by case/and4P: checked. Qed.

Definition one_solution_within (r : region) (c : isolation) := exists (t : R) x,
  [/\ between t (from_point c) (to_point c), solution Q t x, lies_in Q r t x &
      forall t' x', solution Q t' x' -> lies_in Q r t' x' -> t' = t /\ proportional Q x x'].

Lemma family_at n fam : nth None (families_of Q w) n = Some fam ->
  expand_anchor Q (nth no_anchor (anchors w) n) = Some fam.
Proof.
have [l|l] := ltnP n (size (anchors w)); first by rewrite (nth_map no_anchor).
by rewrite nth_default // size_map.
Qed.

Lemma check_anchored_proper ns' a low_a low_b fam lo' hi' r grain l :
  check_anchored ns' a low_a low_b fam lo' hi' r grain l ->
  proper_interval a low_a low_b lo' hi' /\ (0 <? grain)%Z.
Proof. by case/and3P. Qed.

Lemma leaf_excludes r l (t : R) x : check_varying_leaf Q w ns (families_of Q w) r l ->
  ordered (lower r) (upper r) -> varying_yield (r, l) = None ->
  solution Q t x -> lies_in Q r t x -> False.
Proof.
have [wf ba bb _] := varying_parts; case: l => [n grain e|c e] /=; last first.
  case/andP=> _ ok O _ sol [bt ag].
  exact: (whole_sound (Q := scale_free c Q) wf O ok bt ag (scaled_solution c wf sol)).
case anchor_n: (nth no_anchor (anchors w) n) => [reverse a].
case fam_n: (nth None (families_of Q w) n) => [fam|//].
have expanded := family_at fam_n; rewrite anchor_n /expand_anchor /= in expanded.
case: reverse expanded {anchor_n} => expanded ok O none sol [bt ag].
  case/and3P: ok => lo0 _ ok; have [proper grain0] := check_anchored_proper ok.
  have l1 : 0 < toR (lower r).1 :> R by rewrite toR_gt0.
  have l2 : 0 < toR (lower r).2 :> R by case/and5P: O => _ ? _ _ _; rewrite toR_gt0.
  have t0 : 0 < t by rewrite -(pmulr_lgt0 _ l2); apply: lt_le_trans (proj1 bt).
  apply: (anchored_excludes (Q := swap_pencil Q) wf expanded bb ba proper grain0 ok
            (t := t^-1) (x := x)) => //.
  - by move: none; case: (e) => //= c [].
  - exact: (swap_solution Q x t0).1.
  exact: swap_between.
have [proper grain0] := check_anchored_proper ok; case: r ok O none bt ag proper.
move=> lo' hi' st ok O none bt ag proper.
apply: (anchored_excludes wf expanded ba bb proper grain0 ok _ sol bt ag).
by move: none; case: (e) => //= c [].
Qed.

Lemma leaf_yields r l r' c : check_varying_leaf Q w ns (families_of Q w) r l ->
  ordered (lower r) (upper r) -> varying_yield (r, l) = Some (r', c) ->
  r' = r /\ one_solution_within r c.
Proof.
have [wf ba bb _] := varying_parts; case: l => [n grain e|k e] //=.
rewrite /varying_yield /=; case: e => // c' [] //= + O [<- <-].
case anchor_n: (nth no_anchor (anchors w) n) => [reverse a].
case fam_n: (nth None (families_of Q w) n) => [fam|//].
have expanded := family_at fam_n; rewrite anchor_n /expand_anchor /= in expanded.
case: r O => lo' hi' st /= O; case: reverse expanded {anchor_n} => expanded ok; split=> //.
  case/and3P: ok => lo0 to0 ok; have [proper grain0] := check_anchored_proper ok.
  have l1 : 0 < toR lo'.1 :> R by rewrite toR_gt0.
  have l2 : 0 < toR lo'.2 :> R by case/and5P: O => _ ? _ _ _; rewrite toR_gt0.
  have t2 : 0 < toR (to_point c').2 :> R by rewrite toR_gt0.
  have [s [x [bt sol [reg ag] uniq]]] :=
    anchored_yields (Q := swap_pencil Q) R wf expanded bb ba proper grain0 ok.
  have s0 : 0 < s.
    have s_ge0 : 0 <= s by case: sol.
    rewrite lt_neqAle s_ge0 andbT eq_sym; apply: contraTneq t2 => s_zero.
    by case: bt; rewrite /= s_zero mul0r -leNgt.
  have si : s^-1^-1 = s := invrK s.
  have i0 : 0 < s^-1 by rewrite invr_gt0.
  exists s^-1, x; split.
  - by have := swap_between s0 bt; rewrite /swap_point /= -!surjective_pairing.
  - by apply/(swap_solution Q x i0); rewrite si.
  - by split=> //; have := swap_between s0 reg; rewrite /swap_point /= -!surjective_pairing.
  move=> t' x' sol' [bt' ag'].
  have t0 : 0 < t' by rewrite -(pmulr_lgt0 _ l2); apply: lt_le_trans (proj1 bt').
  have [ts prop] := uniq _ x' ((swap_solution Q x' t0).1 sol') (swap_between t0 bt') ag'.
  by split=> //; rewrite -ts invrK.
have [proper grain0] := check_anchored_proper ok.
have [t [x [bt sol [reg ag] uniq]]] := anchored_yields R wf expanded ba bb proper grain0 ok.
by exists t, x; split=> // t' x' sol' [bt' ag']; apply: uniq.
Qed.

Theorem varying_sound :
  (forall (t : R) x, solution Q t x -> between t lo hi ->
     exists2 rc, List.In rc found & lies_in Q rc.1 t x) /\
  (forall rc, List.In rc found -> one_solution_within rc.1 rc.2).
Proof.
have [wf ba bb ok_tree] := varying_parts; split=> [t x sol bt|[r c] in_found].
  have [_ _ _ rows_s] := sol.
  have x0 j : (j < ns)%N -> 0 <= slip_of Q x j.
    by move=> lt_j; have [] := rows_s _ (mem_nth 0%N lt_j).
  have start : in_region ns t (slip_of Q x) (Region lo hi [::]).
    by split=> // i _; rewrite /state_of nth_nil.
  have [[r l] in_leaves [reg O ok]] := every_point_reaches_a_leaf ok_tree x0 start.
  case yields_l: (varying_yield (r, l)) => [[r' c]|].
    have [r'E _] := leaf_yields ok O yields_l.
    exists (r', c); last by rewrite r'E.
    apply/in_pmap_; exists (r, l) => //.
  by case: (leaf_excludes ok O yields_l sol reg).
have [[r0 l0] in_leaves yields_l] := (in_pmap_ varying_yield _ _).1 in_found.
have [O ok] := leaves_are_checked ok_tree in_leaves.
have [r'E one] := leaf_yields ok O yields_l.
by rewrite /= r'E; exact: one.
Qed.

Corollary varying_none : found = [::] ->
  forall (t : R) x, solution Q t x -> between t lo hi -> False.
Proof. by move=> none t x sol bt; have [rc] := varying_sound.1 t x sol bt; rewrite none. Qed.

Corollary varying_one rc : found = [:: rc] -> exists (t : R) x,
  [/\ between t (from_point rc.2) (to_point rc.2), solution Q t x &
    forall t' x', solution Q t' x' -> between t' lo hi -> t' = t /\ proportional Q x x'].
Proof.
move=> one; have [|t [x [bt sol reg uniq]]] := varying_sound.2 rc; first by rewrite one; left.
exists t, x; split=> // t' x' sol' bt'; apply: uniq => //.
by have [rc' + reg'] := varying_sound.1 t' x' sol' bt'; rewrite one => -[->|].
Qed.

End Sound.

Section Main.

Variables (R : rcfType) (s : system) (u : unknown).
Variables (w : anchoring) (tr : tree varying_leaf) (lo hi : point).
Hypothesis checked : check_system_varying s u w tr lo hi.

Theorem system_varying :
  (forall (t : R) v, satisfies_9 s u t v -> between t lo hi ->
     exists2 rc, List.In rc (varying_found tr lo hi) & motion_in s u rc.1 t v) /\
  (forall rc, List.In rc (varying_found tr lo hi) -> exists (t : R) v,
     [/\ between t (from_point rc.2) (to_point rc.2), satisfies_9 s u t v &
      forall t' v', satisfies_9 s u t' v' -> motion_in s u rc.1 t' v' ->
        t' = t /\ same_motion s v v']).
Proof.
case/andP: checked => wf varying; have [every each] := varying_sound R varying.
split=> [t v sat bt|rc in_found].
  exact: every (solution_of_motion wf sat) bt.

have [t [x [bt sol _ uniq]]] := each _ in_found.
exists t, (motion s x); split=> //; first exact/(system_pencil wf).
move=> t' v' sat' reg'; have [-> prop] := uniq _ _ (solution_of_motion wf sat') reg'.
have [f f0 scaled] := motion_proportional prop.
by split=> //; exists f => // d Hd; rewrite -scaled (system_onto wf sat').
Qed.

Corollary system_varying_none : varying_found tr lo hi = [::] ->
  forall (t : R) v, satisfies_9 s u t v -> between t lo hi -> False.
Proof. by move=> none t v sat bt; have [rc] := system_varying.1 t v sat bt; rewrite none. Qed.

Corollary system_varying_one rc : varying_found tr lo hi = [:: rc] -> exists (t : R) v,
  [/\ between t (from_point rc.2) (to_point rc.2), satisfies_9 s u t v &
   forall t' v', satisfies_9 s u t' v' -> between t' lo hi -> t' = t /\ same_motion s v v'].
Proof.
move=> one; have [|t [v [bt sat uniq]]] := system_varying.2 rc; first by rewrite one; left.
exists t, v; split=> // t' v' sat' bt'; apply: uniq => //.
by have [rc' + reg'] := system_varying.1 t' v' sat' bt'; rewrite one => -[->|].
Qed.

End Main.
