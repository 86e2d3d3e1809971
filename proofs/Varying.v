(* Complete sets for pencils whose free rows depend on the value: condensation about anchors.

   The checker gets a pencil, a window [lo, hi] (hi may be infinity), claims (Complete.v),
   factors that bound A_ff and B_ff from below, a list of anchors (Anchor.v), and a tree.  A leaf is

     OfAnchor n g h e     evidence e about the pencil that is condensed about anchor n, with the
                          grain g, over the interval h, which contains that of the region and may
                          reach beyond it (Cover.v);
     OfClaim n g h c k    at most one solution, that of claim k;
     OfLimit n g h c x    at most one null vector, and that one at infinity;
     OfWhole w            evidence about the whole pencil (Whole.v);
     LeftOpen             nothing is said about the region.

   An anchor may be *reversed*: it expands in s = 1/t the pencil with A and B exchanged, which for
   t > 0 has the same solutions, y divided by t ([swap_solution]).  A region [lo, hi] with lo > 0 is
   [1/hi, 1/lo] there; an infinite end becomes 0, which is 1/t for no t.

   Theorem [varying_sound]: if the check succeeds, then
     1. each solution with a value in the window lies in a region yielded or in one left open;
     2. each region yielded has exactly one solution up to a positive factor, and its value lies in
        the interval yielded with it.
   [varying_none]: nothing yielded or left open, no solution in the window.  [varying_place]: where
   the solution of a claim lies.

   Page: spec/certificates.md, 5.6, 5.11, 5.14, 5.15.
   Rust: crates/check/src/cover/condensed.rs, expanded.rs, family.rs, root.rs. *)

From Mceip Require Import Base Lists Integers Sums Tree Enclosed Covered Definite Root RootLeaf
  Pinned Cover Number Condensation Pencil Whole Claim Complete System Series Anchor AnchorLeaf.

(* Bounds of A_ff and of B_ff; anchors, each with "is it reversed". *)
Record anchoring := Anchoring {
  stiffness_bound : form_bound;
  mass_bound : form_bound;
  anchors : seq (bool * anchor) }.

Inductive varying_leaf :=
  | OfAnchor of nat & Z & interval & local_leaf
  | OfClaim of nat & Z & interval & pinning & nat
  | OfLimit of nat & Z & interval & pinning & seq Z
  | OfWhole of whole
  | LeftOpen.

Definition swap_pencil Q := Pencil (order Q) (rows_b Q) (rows_a Q) (free Q).

Definition swap_region r := Region (swap (upper r)) (swap (lower r)) (states r).

Definition swap_isolation (c : isolation) : isolation :=
  Isolation (pivot c) (vector c) (swap (to_point c)) (swap (from_point c))
    (wide_box c) (narrow_box c) (unique c) (left_vector c).

Definition swap_leaf l := if l is LocalRoot c o then LocalRoot (swap_isolation c) o else l.

Definition swap_known q :=
  Known (swap (known_to q)) (swap (known_from q)) (known_support q) (known_biactive q).

Section Checker.

Variables (Q : pencil) (claims : seq solution_claim) (w : anchoring).

Notation ns := (size (slip Q)).

Definition expand_anchor (ra : bool * anchor) : option anchor_family :=
  if ra.1 then expand (swap_pencil Q) ra.2 else expand Q ra.2.

Definition no_anchor := (false, Anchor zero 0 [::] [::] [::]).

Definition expansions := [seq expand_anchor ra | ra <- anchors w].

(* The value of a root is finite. *)
Definition finite_root l := if l is LocalRoot c _ then (0 <? (to_point c).2)%Z else true.

(* A check for the region, or for the region of s, with the bounds of both blocks. *)
Definition at_anchor (families : seq (option anchor_family)) n (r : region)
    (check : bool -> anchor -> form_bound -> form_bound -> anchor_family -> region -> bool) :=
  let: (reverse, a) := nth no_anchor (anchors w) n in
  if nth None families n is Some fam then
    if reverse then
      (0 <? (lower r).1)%Z && check true a (mass_bound w) (stiffness_bound w) fam (swap_region r)
    else check false a (stiffness_bound w) (mass_bound w) fam r
  else false.

Definition leaf_at grain e (reverse : bool) a low_a low_b fam (r : region) :=
  (~~ reverse || finite_root e) &&
  check_anchored ns a low_a low_b fam (lower r) (upper r) r grain
    (if reverse then swap_leaf e else e).

Definition claim_at grain c q (reverse : bool) a low_a low_b fam (r : region) :=
  (~~ reverse || (0 <? (known_from q).1)%Z) &&
  check_anchored_claim ns a low_a low_b fam (lower r) (upper r) r grain c
    (if reverse then swap_known q else q).

Definition limit_at grain c x (reverse : bool) a low_a low_b fam (r : region) :=
  [&& reverse, ((lower r).1 =? 0)%Z, check_null Q (row_b Q) r (pin_pivot c) x &
      check_anchored_limit ns a low_a low_b fam (lower r) (upper r) r grain c].

Definition check_varying_leaf (families : seq (option anchor_family)) (solutions : seq known)
    (r : region) (l : varying_leaf) :=
  match l with
  | OfAnchor n grain h e =>
      reaches r h && at_anchor families n (extended r h) (leaf_at grain e)
  | OfClaim n grain h c k =>
      [&& reaches r h, (k < size solutions)%N &
          at_anchor families n (extended r h) (claim_at grain c (known_at solutions k))]
  | OfLimit n grain h c x =>
      reaches r h && at_anchor families n (extended r h) (limit_at grain c x)
  | OfWhole e => check_whole Q r e
  | LeftOpen => true
  end.

Definition bounds_hold :=
  bounded_rows (size (free Q)) (ff_block Q (row_a Q)) (stiffness_bound w) &&
  bounded_rows (size (free Q)) (ff_block Q (row_b Q)) (mass_bound w).

Definition check_varying (tr : tree varying_leaf) (lo hi : point) :=
  let families := expansions in
  let solutions := known_solutions Q claims in
  [&& wellformed Q, nilp (anchors w) || bounds_hold, all (check_solution_claim Q) claims &
      check_tree ns (check_varying_leaf families solutions) tr (window lo hi)].

Definition claim_yield (r : region) (q : known) : option yield :=
  if supports_region (enclosed_order ns) r q then Some (Yield r (known_from q) (known_to q))
  else None.

Definition varying_yield (rl : region * varying_leaf) : option yield :=
  match rl.2 with
  | OfAnchor _ _ h (LocalRoot c Solution) =>
      Some (Yield (extended rl.1 h) (from_point c) (to_point c))
  | OfClaim _ _ h _ k => claim_yield (extended rl.1 h) (known_at (known_solutions Q claims) k)
  | _ => None
  end.

Definition varying_found (tr : tree varying_leaf) (lo hi : point) :=
  pmap varying_yield (leaves tr (window lo hi)).

Definition varying_open (tr : tree varying_leaf) (lo hi : point) :=
  pmap (fun rl => if rl.2 is LeftOpen then Some rl.1 else None) (leaves tr (window lo hi)).

End Checker.

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
move=> t_gt0; have i0 : 0 < t^-1 by rewrite invr_gt0.
apply: iff_sym; apply: (solution_scaled (c := fun=> t^-1)) => // [|i _].
  by rewrite invr_ge0.
by apply: swap_reaction; rewrite gt_eqF.
Qed.

Lemma swap_between t (lo hi : point) : 0 < t -> between t lo hi ->
  between t^-1 (swap hi) (swap lo).
Proof.
move=> t0 [lo_t t_hi]; split; rewrite /swap /=.
  by rewrite mulrC ler_pdivl_mulr // mulrC.
by rewrite mulrC ler_pdivr_mulr // mulrC.
Qed.

End Swap.

Section Sound.

Variables (R : rcfType) (Q : pencil) (claims : seq solution_claim) (w : anchoring).
Variables (tr : tree varying_leaf) (lo hi : point).
Hypothesis checked : check_varying Q claims w tr lo hi.

Notation ns := (size (slip Q)).
Notation solutions := (known_solutions Q claims).
Notation found := (varying_found Q claims tr lo hi).
Notation left_open := (varying_open tr lo hi).
Notation check_leaf := (check_varying_leaf Q w (expansions Q w) solutions).

Lemma varying_parts :
  [/\ wellformed Q, nilp (anchors w) || bounds_hold Q w, all (check_solution_claim Q) claims &
      check_tree ns check_leaf tr (window lo hi)].
Proof. by case/and4P: checked. Qed.

Lemma known_exists k : (k < size solutions)%N ->
  exists (t : R) x, known_solution Q (known_at solutions k) t x.
Proof.
have [_ _ ok _] := varying_parts; rewrite size_map => lt_k.
pose k0 := ExactClaim (Claim.Claim [::] 0 0 0 [::] [::] [::] [::] [::]).
rewrite /known_at (nth_map k0) //; apply: claim_known.
by move/all_nthP: ok; apply.
Qed.

Lemma at_anchorP n r check : at_anchor w (expansions Q w) n r check ->
  bounds_hold Q w /\ exists reverse a fam, [/\ expand_anchor Q (reverse, a) = Some fam,
    reverse -> (0 <? (lower r).1)%Z &
    if reverse then check true a (mass_bound w) (stiffness_bound w) fam (swap_region r)
    else check false a (stiffness_bound w) (mass_bound w) fam r].
Proof.
have [_ bounds _ _] := varying_parts; rewrite /at_anchor.
case anchor_n: (nth no_anchor (anchors w) n) => [reverse a].
case fam_n: (nth None (expansions Q w) n) => [fam|//] ok.
have lt_n : (n < size (anchors w))%N.
  by rewrite ltnNge; apply/negP => l; rewrite nth_default ?size_map in fam_n.
split; first by case/orP: bounds => // /nilP none; rewrite none in lt_n.
exists reverse, a, fam; move: fam_n; rewrite (nth_map no_anchor) // anchor_n.
by case: reverse {anchor_n} ok => [/andP[]|].
Qed.

Lemma swap_known_solution q (t : R) x : 0 < t ->
  known_solution Q q t x -> known_solution (swap_pencil Q) (swap_known q) t^-1 x.
Proof.
move=> t0 [bt sol signs]; split; first exact: swap_between.
  exact/(swap_solution Q x t0).
move=> j lt_j; have [pos zero biact] := signs j lt_j; split=> // nj bj.
by rewrite swap_reaction ?gt_eqF // biact // mulr0.
Qed.

Definition excluded r := forall (t : R) x, solution Q t x -> lies_in Q r t x -> False.

Lemma root_excludes grain e n r : ordered (lower r) (upper r) -> ~~ wants_slopes e ->
  at_anchor w (expansions Q w) n r (leaf_at Q grain e) -> excluded r.
Proof.
move=> O tight /at_anchorP[/andP[ba bb] [reverse [a [fam [expanded lo0 ok]]]]] t x sol [bt ag].
have [wf _ _ _] := varying_parts; rewrite /expand_anchor /= in expanded.
case: reverse expanded lo0 ok => expanded lo0 /andP[_ ok].
  have t0 := between_gt0 O (lo0 isT) bt; case/and3P: (ok) => proper grain0 _.
  apply: (anchored_excludes (Q := swap_pencil Q) (And5 wf expanded bb ba proper) grain0 ok
            (t := t^-1) (x := x)) => //.
  - by case: (e) tight => //= c [].
  - exact: (swap_solution Q x t0).1.
  exact: swap_between.
case/and3P: (ok) => proper grain0 _.
case: r O ok bt ag proper {lo0} => lo' hi' st O ok bt ag proper.
exact: (anchored_excludes (And5 wf expanded ba bb proper) grain0 ok tight sol bt ag).
Qed.

Lemma root_yields grain c n r : ordered (lower r) (upper r) ->
  at_anchor w (expansions Q w) n r (leaf_at Q grain (LocalRoot c Solution)) ->
  one_solution_in R Q (Yield r (from_point c) (to_point c)).
Proof.
move=> O /at_anchorP[/andP[ba bb] [reverse [a [fam [expanded lo0 ok]]]]].
have [wf _ _ _] := varying_parts; rewrite /expand_anchor /= in expanded.
case: r O ok lo0 => lo' hi' st /= O ok lo0; case: reverse expanded lo0 ok => expanded lo0 /andP[].
  move=> /= to0 ok; case/and3P: (ok) => proper grain0 _.
  have {}lo0 := lo0 isT; have t2 : 0 < toR (to_point c).2 :> R by rewrite toR_gt0.
  have [s [x [bt sol [reg ag] uniq]]] :=
    anchored_yields (Q := swap_pencil Q) R (And5 wf expanded bb ba proper) grain0 ok.
  have s0 : 0 < s.
    have s_ge0 : 0 <= s by case: sol.
    rewrite lt_neqAle s_ge0 andbT eq_sym; apply: contraTneq t2 => s_zero.
    by case: bt; rewrite /= s_zero mul0r -leNgt.
  have si : s^-1^-1 = s := invrK s.
  have i0 : 0 < s^-1 by rewrite invr_gt0.
  exists s^-1, x; split.
  - by have := swap_between s0 bt; rewrite /swap /= -!surjective_pairing.
  - by apply/(swap_solution Q x i0); rewrite si.
  - by split=> //; have := swap_between s0 reg; rewrite /swap /= -!surjective_pairing.
  move=> t' x' sol' [bt' ag'].
  have t0 : 0 < t' := between_gt0 O lo0 bt'.
  have [ts prop] := uniq _ x' ((swap_solution Q x' t0).1 sol') (swap_between t0 bt') ag'.
  by split=> //; rewrite -ts invrK.
move=> _ ok; case/and3P: (ok) => proper grain0 _.
have [t [x [bt sol [reg ag] uniq]]] :=
  anchored_yields R (And5 wf expanded ba bb proper) grain0 ok.
by exists t, x; split=> // t' x' sol' [bt' ag']; apply: uniq.
Qed.

Section Claimed.

Variables (grain : Z) (c : pinning) (q : known) (n : nat) (r : region).
Hypothesis O : ordered (lower r) (upper r).
Hypothesis ok : at_anchor w (expansions Q w) n r (claim_at Q grain c q).
Hypothesis known_q : exists (t : R) x, known_solution Q q t x.

Lemma known_gt0 (t : R) x : (0 <? (known_from q).1)%Z -> known_solution Q q t x -> 0 < t.
Proof.
move=> f0 [[from_t _] [t0 _ _ _] _]; rewrite lt_neqAle t0 andbT; apply/eqP => t_zero.
move: from_t; rewrite -t_zero mul0r leNgt; case/negP.
by rewrite toR_gt0.
Qed.

Lemma claim_beside : ~~ supports_region (enclosed_order ns) r q -> excluded r.
Proof.
move=> beside t x sol [bt ag]; have [t0 [x0 known0]] := known_q.
have [/andP[ba bb] [reverse [a [fam [expanded lo0 at_a]]]]] := at_anchorP ok.
have [wf _ _ _] := varying_parts; rewrite /expand_anchor /= in expanded.
case: r O bt ag at_a lo0 beside => lo' hi' st /= O' bt ag at_a lo0 beside.
case: reverse expanded lo0 at_a => expanded lo0 /andP[] /=.
  move=> from0 at_a; have t_gt0 : 0 < t := between_gt0 O' (lo0 isT) bt.
  case/and3P: (at_a) => proper grain0 _.
  have known' := swap_known_solution (known_gt0 from0 known0) known0.
  exact: (anchored_beside (Q := swap_pencil Q) (And5 wf expanded bb ba proper) grain0 at_a
    known' beside ((swap_solution Q x t_gt0).1 sol) (swap_between t_gt0 bt) ag).
move=> _ at_a; case/and3P: (at_a) => proper grain0 _.
exact: (anchored_beside (And5 wf expanded ba bb proper) grain0 at_a known0 beside sol bt ag).
Qed.

Lemma claim_yields : supports_region (enclosed_order ns) r q ->
  one_solution_in R Q (Yield r (known_from q) (known_to q)).
Proof.
move=> supports; have [t [x known0]] := known_q; have [btk sol _] := known0.
have [/andP[ba bb] [reverse [a [fam [expanded lo0 at_a]]]]] := at_anchorP ok.
have [wf _ _ _] := varying_parts; rewrite /expand_anchor /= in expanded.
case: r O at_a lo0 supports => lo' hi' st /= O' at_a lo0 supports.
case: reverse expanded lo0 at_a => expanded lo0 /andP[] /=.
  move=> from0 at_a; case/and3P: (at_a) => proper grain0 _.
  have t0 := known_gt0 from0 known0; have i0 : 0 < t^-1 by rewrite invr_gt0.
  have [bt ag uniq] := anchored_claimed (Q := swap_pencil Q)
    (And5 wf expanded bb ba proper) grain0 at_a (swap_known_solution t0 known0) supports.
  exists t, x; split=> //.
    split=> //; have := swap_between i0 bt.
    by rewrite invrK /swap /= -!surjective_pairing.
  move=> t' x' sol' [bt' ag'].
  have t0' : 0 < t' := between_gt0 O' (lo0 isT) bt'.
  have [ts prop] := uniq _ x' ((swap_solution Q x' t0').1 sol') (swap_between t0' bt') ag'.
  by split=> //; rewrite -[t']invrK ts invrK.
move=> _ at_a; case/and3P: (at_a) => proper grain0 _.
have [bt ag uniq] := anchored_claimed (And5 wf expanded ba bb proper) grain0 at_a known0 supports.
by exists t, x; split=> // t' x' sol' [bt' ag']; apply: uniq.
Qed.

End Claimed.

Lemma limit_excludes grain c x n r : ordered (lower r) (upper r) ->
  at_anchor w (expansions Q w) n r (limit_at Q grain c x) -> excluded r.
Proof.
move=> O /at_anchorP[/andP[ba bb] [reverse [a [fam [expanded lo0 ok]]]]] t y sol [bt ag].
have [wf _ _ _] := varying_parts; rewrite /expand_anchor /= in expanded.
case: reverse expanded lo0 ok => expanded lo0 /and4P[] // _ /Z.eqb_spec lo_zero dir ok.
case/and3P: (ok) => proper grain0 _; have t0 := between_gt0 O (lo0 isT) bt.
case/and4P: dir => cols xk /allP free0 /allP slip0.
pose X i : R := toR (nth 0%Z x i).
have cb i := (columns_in_rows cols i).2.
have rowE i : reaction (swap_pencil Q) (toR (upper r).2 / toR (upper r).1) X i =
    toR (sparse_dot (row_b Q i) x) :> R.
  have -> : toR (upper r).2 = 0 :> R.
    by rewrite -[(upper r).2]/(lower (swap_region r)).1 lo_zero toR0.
  rewrite mul0r (toR_sparse_dot R x (cb _)) /reaction; apply: eq_bigr => j _.
  by rewrite mul0r addr0.
have [] : t^-1 = 0 -> False by apply/eqP; rewrite invr_eq0 gt_eqF.
have -> : t^-1 = toR (upper r).2 / toR (upper r).1.
  apply: (anchored_limit (Q := swap_pencil Q) (x := X) (And5 wf expanded bb ba proper) grain0
    ok _ _ _ ((swap_solution Q y t0).1 sol) (swap_between t0 bt) ag).
  - by move=> i /free0 /Z.eqb_spec zero; rewrite rowE zero toR0.
  - move=> j lt_j; have := slip0 j; rewrite mem_iota add0n => /(_ lt_j) /=.
    by case: ifP => _ /Z.eqb_spec zero; [rewrite rowE zero toR0 | rewrite /slip_of /X zero toR0].
  by rewrite /slip_of /X toR_eq0.
by rewrite -[(upper r).2]/(lower (swap_region r)).1 lo_zero toR0 mul0r.
Qed.

(* A leaf excludes every solution, or it yields, or it is left open. *)
Lemma leaf_sound r l (t : R) x : ordered (lower r) (upper r) -> check_leaf r l ->
  solution Q t x -> lies_in Q r t x ->
  (exists2 y, varying_yield Q claims (r, l) = Some y & lies_in Q (yield_region y) t x) \/
  l = LeftOpen.
Proof.
have [wf _ _ _] := varying_parts; move=> O ok sol reg; case: l ok; last by right.
- move=> n grain h e /andP[rh at_a]; have Oh : ordered h.1 h.2 by case/and3P: rh.
  have {}reg := in_extended O rh reg; case slopes: (wants_slopes e); last first.
    by case: (root_excludes (r := extended r h) Oh (negbT slopes) at_a sol reg).
  left; case: e slopes {at_a} => // c [] // _.
  by exists (Yield (extended r h) (from_point c) (to_point c)).
- move=> n grain h c k /and3P[rh lt_k at_a]; have Oh : ordered h.1 h.2 by case/and3P: rh.
  have {}reg := in_extended O rh reg; left; rewrite /varying_yield /claim_yield.
  case: ifP => [_|/negbT beside].
    by exists (Yield (extended r h) (known_from (known_at solutions k))
                     (known_to (known_at solutions k))).
  by case: (claim_beside (r := extended r h) Oh at_a (known_exists lt_k) beside sol reg).
- move=> n grain h c z /andP[rh at_a]; have Oh : ordered h.1 h.2 by case/and3P: rh.
  by case: (limit_excludes (r := extended r h) Oh at_a sol (in_extended O rh reg)).
move=> e ok; have [bt ag] := reg.
by case: (whole_sound wf O ok bt ag sol).
Qed.

Lemma claim_yieldP r q y : claim_yield Q r q = Some y ->
  supports_region (enclosed_order ns) r q /\ y = Yield r (known_from q) (known_to q).
Proof. by rewrite /claim_yield; case: ifP => // ok [<-]. Qed.

Lemma yield_sound r l y : ordered (lower r) (upper r) -> check_leaf r l ->
  varying_yield Q claims (r, l) = Some y -> one_solution_in R Q y.
Proof.
move=> O; case: l => // [n grain h [w'|b f f'|a|c []]|n grain h c k] //.
  case/andP=> rh at_a [<-]; have Oh : ordered h.1 h.2 by case/and3P: rh.
  exact: (root_yields (r := extended r h) Oh at_a).
case/and3P=> rh lt_k at_a; have Oh : ordered h.1 h.2 by case/and3P: rh.
case/claim_yieldP=> supports ->.
exact: (claim_yields (r := extended r h) Oh at_a (known_exists lt_k) supports).
Qed.

Theorem varying_sound :
  covers (solution Q) (proportional Q) (lies_in Q) lo hi found
    (in_some (R := R) (lies_in Q) left_open).
Proof.
have [_ _ _ ok_tree] := varying_parts; split=> [t x sol bt|y].
  have [_ _ _ rows_s] := sol.
  have x0 j : (j < ns)%N -> 0 <= slip_of Q x j.
    by move=> lt_j; have [] := rows_s _ (mem_nth 0%N lt_j).
  have start : in_region ns t (slip_of Q x) (window lo hi).
    by split=> // i _; rewrite /state_of nth_nil.
  have [[r l] in_leaves [reg O ok]] := every_point_reaches_a_leaf ok_tree x0 start.
  have [[y yields_y reg_y]|l_open] := leaf_sound O ok sol reg.
    by left; exists y => //; apply/in_pmap; exists (r, l).
  by right; exists r => //; apply/in_pmap; exists (r, l); rewrite // l_open.
case/in_pmap=> -[r l] in_leaves yields_y.
have [O ok] := leaves_are_checked ok_tree in_leaves.
exact: yield_sound O ok yields_y.
Qed.

Corollary varying_none : found = [::] -> left_open = [::] ->
  forall (t : R) x, solution Q t x -> between t lo hi -> False.
Proof. by move=> none no_open; have := varying_sound; rewrite none no_open; apply: covers_none. Qed.

Theorem varying_place k : check_solution_claim Q k ->
  within (known_from (known_of Q k), known_to (known_of Q k)) (lo, hi) ->
  known_in R Q (known_of Q k) found left_open.
Proof. by move/(claim_known R); apply: known_place varying_sound. Qed.

End Sound.
