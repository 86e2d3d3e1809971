(* No solution below a friction, for free rows that depend on t: condensation about anchors.

   Continues Critical.v.  An anchor (Anchor.v) has one center, unit, W and factors of rows, and a V
   for each part; it may be reversed (Varying.v).  A leaf is

     AboutAnchor n g tr  evidence of Critical.v for both parts, condensed about anchor n with the
                         grain g over the interval of the box; in the tree tr the position u in
                         this interval stands in place of t;
     WithoutAnchor l     a leaf of Critical.v that needs no enclosures; of a problem with radii one
                         about the rows as they are ([check_exact]).

   Over the box both local pencils are near lines, and their rows have one positive factor, so the
   local pencil at mu is a combination of those at both ends of the interval of mu.

   Theorem [zero_anchored_critical_absent]: if the check succeeds, then for every mu in
   [from, bound] and every t >= 0 no motion satisfies the conditions (9) with lambda^2 = t and mu.
   [anchored_critical_absent]: the same without particles in contact with zero reaction.

   Page: spec/certificates.md, 5.18, with 5.14.
   Rust: crates/check/src/cover/critical.rs, condensed.rs, expanded.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Farkas Covered Definite Signed Pinned
  Cover Condensation Pencil Whole Complete System Norms Elimination Series Anchor AnchorLeaf Varying
  ZeroReaction ZeroPencil Boxes Regular Critical.

Record box_anchor := BoxAnchor {
  reversed_anchor : bool;
  plain_anchor : anchor;
  friction_left : seq matrix }.

Record box_anchoring := BoxAnchoring {
  stiffness_below : form_bound;
  mass_below : form_bound;
  box_anchors : seq box_anchor }.

Inductive anchored_box_leaf :=
  | AboutAnchor of nat & Z & tree critical_leaf
  | WithoutAnchor of critical_leaf.

(* Members of a body: radii of the rows of both parts, and the share by which the friction rows of
   each slip particle may differ, as numerators over one unit. *)
Record part_radii := PartRadii {
  plain_radii : seq sparse_row * seq sparse_row;
  friction_radii : seq sparse_row * seq sparse_row;
  friction_shares : seq Z;
  share_unit : Z }.

(* Enclosures of the same pencil with each row multiplied by a number within its share of 1. *)
Definition widened (radii : option part_radii) (P : enclosed) : enclosed :=
  if radii is Some rad then
    let ix := iota 0 (size_of P) in
    let wider (center radius : matrix) : matrix :=
      [seq (let share := nth 0%Z (friction_shares rad) i in
            [seq (let r := entry radius i j in
                  r + divide_up (share * (Z.abs (entry center i j) + r)) (share_unit rad))%Z
            | j <- ix]) | i <- ix] in
    Enclosed (size_of P) (center_a P) (center_b P) (wider (center_a P) (radius_a P))
      (wider (center_b P) (radius_b P))
  else P.

(* The entries of a part with their radii, for all variables, the first rows times a factor. *)
Definition exact_part first factor (Q : pencil) (radii : seq sparse_row * seq sparse_row) :=
  let ix := iota 0 (order Q) in
  let times (i : nat) (v : Z) : Z := if (i < first)%N then (factor * v)%Z else v in
  let table (rows : seq sparse_row) : matrix :=
    [seq [seq times i (lookup (nth [::] rows i) j) | j <- ix] | i <- ix] in
  Enclosed (order Q) (table (rows_a Q)) (table (rows_b Q)) (table radii.1) (table radii.2).

(* Free rows have no share. *)
Definition radii_of_all nf (radii : part_radii) : part_radii :=
  PartRadii (plain_radii radii) (friction_radii radii) (nseq nf 0%Z ++ friction_shares radii)
    (share_unit radii).

Definition swapped_radii (radii : option (seq sparse_row * seq sparse_row)) :=
  omap (fun rad => (rad.2, rad.1)) radii.

Section Checker.

Variables (z : zero_system) (radii : option part_radii).

Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).
Notation ns := (slip_number z).

Definition friction_anchor a (other : seq matrix) : anchor :=
  Anchor (anchor_center a) (anchor_unit a) (anchor_right a) other (anchor_scale a).

Definition expand_part Q rad (reverse : bool) a : option anchor_family :=
  if reverse then expand_member (swap_pencil Q) (swapped_radii rad) a else expand_member Q rad a.

Definition expand_box (b : box_anchor) : option (anchor_family * anchor_family) :=
  if expand_part Q0 (omap plain_radii radii) (reversed_anchor b) (plain_anchor b) is Some fam then
    if expand_part Q1 (omap friction_radii radii) (reversed_anchor b)
         (friction_anchor (plain_anchor b) (friction_left b)) is Some fam'
    then Some (fam, fam') else None
  else None.

(* A leaf about the enclosures P, P' of both parts; [halves] says that right and left of a particle
   both move. *)
Definition check_local_leaf (halves : region -> bool) (P P' : enclosed) (r : region)
    (low high : point) (l : critical_leaf) :=
  if l is BoxHalves then halves r else check_parts P P' r low high l.

(* The local pencil of a part over [lo, hi]. *)
Definition local_part low_a low_b a fam lo hi grain :=
  local_pencil ns a low_a low_b fam lo hi false grain.

Definition check_about low_a low_b (b : box_anchor) (fams : anchor_family * anchor_family) grain
    (r : region) (low high : point) (tr : tree critical_leaf) :=
  let a := plain_anchor b in
  let a' := friction_anchor a (friction_left b) in
  [&& proper_interval a low_a low_b (lower r) (upper r), (0 <? grain)%Z,
      size (series_z fams.1) == size (series_z fams.2) &
      check_boxes ns (check_local_leaf (both_halves z)
          (local_part low_a low_b a fams.1 (lower r) (upper r) grain)
          (widened radii (local_part low_a low_b a' fams.2 (lower r) (upper r) grain)))
        tr (local_region r) low high].

(* A leaf about the entries of both parts: the form of all variables, or without free ones any.  The
   free rows are the same in both parts, so the first part has them alone. *)
Definition check_exact (rad : part_radii) (r : region) (low high : point) (l : critical_leaf) :=
  let nf := size (free Q0) in
  let P' := widened (Some (radii_of_all nf rad)) (exact_part nf 0 Q1 (friction_radii rad)) in
  if l is BoxSigned factor f f' then
    let P := exact_part nf factor Q0 (plain_radii rad) in
    (0 <=? factor)%Z && box_signed (mixed low P P') (mixed high P P') r f f'
  else nilp (free Q0) && check_parts (exact_part 0 0 Q0 (plain_radii rad)) P' r low high l.

Variable w : box_anchoring.

Definition no_box_anchor := BoxAnchor false (Anchor zero 0 [::] [::] [::]) [::].

Definition box_expansions := [seq expand_box b | b <- box_anchors w].

Definition check_anchored_box (families : seq (option (anchor_family * anchor_family)))
    (r : region) (low high : point) (l : anchored_box_leaf) :=
  match l with
  | AboutAnchor n grain tr' =>
      let b := nth no_box_anchor (box_anchors w) n in
      if nth None families n is Some fams then
        if reversed_anchor b then
          (0 <? (lower r).1)%Z &&
          check_about (mass_below w) (stiffness_below w) b fams grain (swap_region r) low high tr'
        else check_about (stiffness_below w) (mass_below w) b fams grain r low high tr'
      else false
  | WithoutAnchor l =>
      if radii is Some rad then check_exact rad r low high l else check_whole_leaf z r low high l
  end.

Definition both_bounded :=
  let plain := omap plain_radii radii in
  let friction := omap friction_radii radii in
  [&& bounded_rows (size (free Q0)) (lowered_block Q0 row_a plain) (stiffness_below w),
      bounded_rows (size (free Q0)) (lowered_block Q0 row_b plain) (mass_below w),
      bounded_rows (size (free Q1)) (lowered_block Q1 row_a friction) (stiffness_below w) &
      bounded_rows (size (free Q1)) (lowered_block Q1 row_b friction) (mass_below w)].

Definition check_anchored_critical (tr : tree anchored_box_leaf) (from bound : point) :=
  let families := box_expansions in
  [&& zero_wellformed z Mu, nilp (box_anchors w) || both_bounded &
      check_boxes ns (check_anchored_box families) tr (window zero infinity) from bound].

End Checker.

(* Numbers within the shares of 1. *)
Definition within_shares (R : rcfType) (radii : option part_radii) n (g : nat -> R) :=
  if radii is Some rad then 0 < toR (share_unit rad) :> R /\ forall i, (i < n)%N ->
    `|g i - 1| * toR (share_unit rad) <= toR (nth 0%Z (friction_shares rad) i)
  else forall i, (i < n)%N -> g i = 1.

Lemma widened_encloses (R : rcfType) radii P (A B : nat -> nat -> R) g :
  within_shares radii (size_of P) g -> encloses P A B ->
  encloses (widened radii P) (fun i j => g i * A i j) (fun i j => g i * B i j).
Proof.
case: radii => [rad|] /= near E i j Hi Hj; last first.
  by have [na nb] := E i j Hi Hj; rewrite near ?mul1r //; rewrite mem_iota in Hi.
have [unit0 {}near] := near; have [na nb] := E i j Hi Hj.
have lt_i : (i < size_of P)%N by rewrite mem_iota in Hi.
have lt_j : (j < size_of P)%N by rewrite mem_iota in Hj.
have := near i lt_i; set share := nth 0%Z _ _ => g_near.
have wider (x : R) c r : `|x - toR c| <= toR r ->
    `|g i * x - toR c| <= toR (r + divide_up (share * (Z.abs c + r)) (share_unit rad))%Z.
  move=> close; rewrite (_ : g i * x - toR c = (x - toR c) + (g i - 1) * x); last by ring.
  rewrite toRD (le_trans (ler_norm_add _ _)) // ler_add // normrM.
  have x_le : `|x| <= toR (Z.abs c + r)%Z.
    rewrite toRD toR_abs -[x in `|x|](subrK (toR c)) addrC.
    by rewrite (le_trans (ler_norm_add _ _)) // ler_add.
  apply: (@le_trans _ _ (`|g i - 1| * toR (Z.abs c + r)%Z)); first by rewrite ler_wpmul2l.
  have sum0 : 0 <= toR (Z.abs c + r)%Z :> R by apply: le_trans x_le.
  apply: le_trans (divide_up_real R _ _); last by rewrite -(toR_gt0 R).
  by rewrite ler_pdivl_mulr // toRM mulrAC ler_wpmul2r.
have entryE (f : nat -> nat -> Z) :
    entry [seq [seq f i j | j <- iota 0 (size_of P)] | i <- iota 0 (size_of P)] i j = f i j.
  by rewrite /entry (nth_map 0%N) ?size_iota // (nth_map 0%N) ?size_iota // !nth_iota.
by split; rewrite entryE; apply: wider.
Qed.

Definition rows_times (R : rcfType) first (factor : Z) (A : nat -> nat -> R) i j :=
  if (i < first)%N then toR factor * A i j else A i j.

Lemma exact_encloses (R : rcfType) first factor Q (A B : nat -> nat -> R) radii :
  (0 <=? factor)%Z -> within_radii Q A B radii ->
  encloses (exact_part first factor Q radii) (rows_times first factor A)
    (rows_times first factor B).
Proof.
rewrite -(toR_ge0 R) => c0 near i j Hi Hj; have [na nb] := near i j Hi Hj.
have tableE rows :
    entry [seq [seq (if (i < first)%N then factor * lookup (nth [::] rows i) j
                     else lookup (nth [::] rows i) j)%Z
               | j <- iota 0 (order Q)] | i <- iota 0 (order Q)] i j =
    (if (i < first)%N then factor * lookup (nth [::] rows i) j else lookup (nth [::] rows i) j)%Z.
  move: Hi Hj; rewrite !mem_iota !add0n => lt_i lt_j.
  by rewrite /entry (nth_map 0%N) ?size_iota // (nth_map 0%N) ?size_iota // !nth_iota.
rewrite /exact_part /= !tableE /rows_times; case: ifP => // _.
by rewrite !toRM -!mulrBr !normrM (ger0_norm c0) !ler_wpmul2l.
Qed.

Lemma size_widened radii P : size_of (widened radii P) = size_of P.
Proof. by case: radii. Qed.

(* A member of one part over the interval of an anchor. *)
Section Part.

Variables (R : rcfType) (Q : pencil) (A B : nat -> nat -> R) (a : anchor) (fam : anchor_family).
Variables (low_a low_b : form_bound) (lo hi : point) (grain : Z) (t : R) (x : nat -> R).
Hypothesis ready : prepared_member Q A B a fam low_a low_b lo hi.
Hypothesis grain0 : (0 <? grain)%Z.
Hypothesis bt : between t lo hi.
Notation y := (member_reaction (order Q) A B t x).
Hypothesis rows_f : forall i, i \in free Q -> y i = 0.

Notation u := (u_of lo hi t).
Notation P := (local_pencil (size (slip Q)) a low_a low_b fam lo hi false grain).

Lemma free_at_u k : k \in iota 0 (size (free Q)) ->
  free_of Q x k = free_values Q A B a lo hi u (slip_of Q x) k.
Proof.
have [u0 _] := u_of_between ready bt.
by move: k; apply/(free_values_rows ready x u0); rewrite (t_of_u ready).
Qed.

Lemma part_line : exists A' B', encloses P A' B' /\
  forall i, (i < size (slip Q))%N -> image P A' B' u (slip_of Q x) i =
    row_factor_at R a fam lo hi grain i * y (nth 0%N (slip Q) i).
Proof.
have [u0 u1] := u_of_between ready bt.
have [A' [B' [E on]]] := local_line ready grain0 u0 u1; exists A', B'; split=> // i lt_i.
rewrite -[X in member_reaction _ _ _ X _ _](t_of_u ready t).
rewrite -(local_image grain ready false u0 lt_i free_at_u).
by apply: sum_eq => j Hj; rewrite on // mem_iota.
Qed.

End Part.

(* A box with an anchor, for members of two pencils that differ in their slip rows; the second is
   multiplied by g. *)
Section About.

Variables (R : rcfType) (n : nat) (fr : seq nat) (ra rb ra' rb' : seq sparse_row).
Notation Q := (Pencil n ra rb fr).
Notation Q' := (Pencil n ra' rb' fr).
Variables (A B A' B' : nat -> nat -> R) (radii : option part_radii) (g : nat -> R).
Variables (a : anchor) (other : seq matrix) (fam fam' : anchor_family) (low_a low_b : form_bound).
Notation a' := (friction_anchor a other).
Variables (grain : Z) (r : region) (low high : point) (t mu : R) (x : nat -> R).
Hypothesis ready : prepared_member Q A B a fam low_a low_b (lower r) (upper r).
Hypothesis ready' : prepared_member Q' A' B' a' fam' low_a low_b (lower r) (upper r).
Hypotheses (grain0 : (0 <? grain)%Z) (same_size : size (series_z fam) = size (series_z fam')).
Hypothesis shares : within_shares radii (size (slip Q)) g.
Hypothesis bm : between mu low high.
Hypothesis bt : between t (lower r) (upper r).
Hypothesis ag : agrees (size (slip Q)) r (slip_of Q x).
Hypothesis nonzero : exists2 i, i \in iota 0 n & x i != 0.
Notation y := (member_reaction n A B t x).
Notation y' := (member_reaction n A' B' t x).
Hypothesis rows_f : forall i, i \in fr -> y i = 0.
Hypothesis rows_f' : forall i, i \in fr -> y' i = 0.
Hypothesis signs : forall k, (k < size (slip Q))%N -> let i := nth 0%N (slip Q) k in
  let row := y i + mu * (g k * y' i) in [/\ 0 <= x i, 0 <= row & x i * row = 0].
Variable halves : region -> bool.
Hypothesis halves_absent : forall r',
  halves r' -> agrees (size (slip Q)) r' (slip_of Q x) -> False.

Notation lo := (lower r).
Notation hi := (upper r).
Notation P := (local_pencil (size (slip Q)) a low_a low_b fam lo hi false grain).
Notation P' := (local_pencil (size (slip Q)) a' low_a low_b fam' lo hi false grain).

Lemma same_factor i :
  row_factor_at R a' fam' lo hi grain i = row_factor_at R a fam lo hi grain i.
Proof.
rewrite /row_factor_at; congr (_ * (_ * toR _ * _) * _); rewrite /power_z.
by apply: substituted_power_size; rewrite !size_map same_size.
Qed.

Theorem about_absent tr : check_boxes (size (slip Q))
  (check_local_leaf halves P (widened radii P')) tr (local_region r) low high -> False.
Proof.
have [u0 u1] := u_of_between ready bt.
have lt_ns i : i \in indices P -> (i < size (slip Q))%N by rewrite mem_iota.
have x0 i : (i < size (slip Q))%N -> 0 <= slip_of Q x i.
  by move=> lt_i; have [] := signs lt_i.
have start : in_region (size (slip Q)) (u_of lo hi t) (slip_of Q x) (local_region r).
  by split=> //; rewrite /between /= toR0 toR1 !mulr1.
move=> /box_reaches_a_leaf/(_ x0 start bm)[r1 [low1 [high1 [l [_ [[bu ag1] bm1 O1 Om1 leaf_ok]]]]]].
have {leaf_ok} ok : check_parts P (widened radii P') r1 low1 high1 l.
  by case: l leaf_ok => //= both; have := halves_absent both ag1.
have [C [D [E imageE]]] := part_line ready grain0 bt rows_f.
have [C' [D' [E' imageE']]] := part_line ready' grain0 bt rows_f'.
apply: (parts_absent (r := r1) (t := u_of lo hi t) E (widened_encloses (P := P') shares E')
  (size_widened radii P') O1 Om1 bu bm1
  (xs := slip_of Q x) (factor := row_factor_at R a fam lo hi grain)
  (row := fun i => y (nth 0%N (slip Q) i))
  (row' := fun i => g i * y' (nth 0%N (slip Q) i)) _ _ _ _ _ _ ok) => //.
- by move=> i /lt_ns lt_i; apply: (row_factor_gt0_ ready grain0).
- by move=> i /lt_ns; apply: imageE.
- move=> i /lt_ns lt_i; transitivity (g i * image P' C' D' (u_of lo hi t) (slip_of Q x) i).
    rewrite /image (same_indices (size_widened radii P')) mulr_sumr; apply: eq_bigr => j _.
    rewrite /Enclosed.T; move: (C' i j) (D' i j) (g i) (slip_of Q x j) => *; ring.
  by rewrite -same_factor mulrCA; congr (_ * _); apply: imageE'.
- have part := free_at_u ready bt rows_f.
  by case: (slip_part_nonzero part nonzero) => j Hj xj; exists j.
by move=> i /lt_ns lt_i; apply: signs.
Qed.

End About.

Lemma swap_member (R : rcfType) n (A B : nat -> nat -> R) t x i : t != 0 ->
  member_reaction n B A t^-1 x i = t^-1 * member_reaction n A B t x i.
Proof.
move=> t0; rewrite /member_reaction mulr_sumr; apply: eq_bigr => j _.
by rewrite mulrA mulrDr mulrA mulVf // mul1r [X in X * _]addrC.
Qed.

(* The same in 1/t. *)
Theorem about_reversed_absent (R : rcfType) n fr ra rb ra' rb' (A B A' B' : nat -> nat -> R) radii
    (g : nat -> R) a other fam fam' low_a low_b grain
    r low high (t mu : R) x (halves : region -> bool) tr
    (Q := Pencil n ra rb fr) (Q' := Pencil n ra' rb' fr) (y := member_reaction n A B t x)
    (y' := member_reaction n A' B' t x) :
  prepared_member (swap_pencil Q) B A a fam low_a low_b (swap (upper r)) (swap (lower r)) ->
  prepared_member (swap_pencil Q') B' A' (friction_anchor a other) fam' low_a low_b
    (swap (upper r)) (swap (lower r)) -> (0 <? grain)%Z ->
  size (series_z fam) = size (series_z fam') -> within_shares radii (size (slip Q)) g ->
  between mu low high -> 0 < t -> between t (lower r) (upper r) ->
  agrees (size (slip Q)) r (slip_of Q x) ->
  (exists2 i, i \in iota 0 n & x i != 0) ->
  (forall i, i \in fr -> y i = 0) -> (forall i, i \in fr -> y' i = 0) ->
  (forall k, (k < size (slip Q))%N -> let i := nth 0%N (slip Q) k in
     let row := y i + mu * (g k * y' i) in [/\ 0 <= x i, 0 <= row & x i * row = 0]) ->
  (forall r', halves r' -> agrees (size (slip Q)) r' (slip_of Q x) -> False) ->
  check_boxes (size (slip Q)) (check_local_leaf halves
      (local_pencil (size (slip Q)) a low_a low_b fam (swap (upper r)) (swap (lower r)) false grain)
      (widened radii (local_pencil (size (slip Q)) (friction_anchor a other) low_a low_b fam'
         (swap (upper r)) (swap (lower r)) false grain))) tr (local_region r) low high -> False.
Proof.
move=> ready ready' grain0 same_size shares bm t_gt0 bt ag nonzero rows rows' signs apart.
have tn0 := lt0r_neq0 t_gt0; have ti : 0 < t^-1 by rewrite invr_gt0.
apply: (@about_absent R n fr rb ra rb' ra' B A B' A' radii g a other fam fam' low_a low_b grain
  (swap_region r) low high t^-1 mu x ready ready' grain0 same_size shares bm
  (swap_between t_gt0 bt) ag nonzero _ _ _ halves apart).
- by move=> i Hi; rewrite swap_member // [member_reaction _ _ _ _ _ _]rows // mulr0.
- by move=> i Hi; rewrite swap_member // [member_reaction _ _ _ _ _ _]rows' // mulr0.
move=> k Hk i row; rewrite /row !swap_member // [g k * (_ * _)]mulrCA [mu * (_ * _)]mulrCA -mulrDr.
exact/(complementary_scaled _ _ ti)/signs.
Qed.

Lemma swapped_below_a Q rad low :
  bounded_rows (size (free Q)) (lowered_block Q row_b rad) low ->
  bounded_rows (size (free (swap_pencil Q)))
    (lowered_block (swap_pencil Q) row_a (swapped_radii rad)) low.
Proof. by case: rad. Qed.

Lemma swapped_below_b Q rad low :
  bounded_rows (size (free Q)) (lowered_block Q row_a rad) low ->
  bounded_rows (size (free (swap_pencil Q)))
    (lowered_block (swap_pencil Q) row_b (swapped_radii rad)) low.
Proof. by case: rad. Qed.

(* A box of a body: members of both parts, x the variables of a motion. *)
Section Body.

Variables (R : rcfType) (z : zero_system) (radii : option part_radii) (w : box_anchoring).
Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).
Notation wfQ := (zero_pencil_wellformed z (Lambda2 0 1)).
Hypothesis bounds : both_bounded z radii w.

Variables (A B A' B' : nat -> nat -> R).

(* A member of a pencil within the radii, if there are any. *)
Definition member_of Q rad (A B : nat -> nat -> R) :=
  if rad is Some rd then within_radii Q A B rd else A = a_entry R Q /\ B = b_entry R Q.

Hypothesis in_plain : member_of Q0 (omap plain_radii radii) A B.
Hypothesis in_friction : member_of Q1 (omap friction_radii radii) A' B'.

Lemma member_prepared Q rad (C D : nat -> nat -> R) a fam low_a low_b lo hi : wellformed Q ->
  member_of Q rad C D -> expand_member Q rad a = Some fam ->
  bounded_rows (size (free Q)) (lowered_block Q row_a rad) low_a ->
  bounded_rows (size (free Q)) (lowered_block Q row_b rad) low_b ->
  proper_interval a low_a low_b lo hi -> prepared_member Q C D a fam low_a low_b lo hi.
Proof.
case: rad => [rd|] wf /=; last first.
  rewrite /expand_member; case=> -> ->; case ex: (expand Q a) => [f|] // [<-] ba bb proper.
  exact: prepared_ready (prepare ex wf ba bb proper).
by move=> near ex ba bb proper; apply: (member_ready wf near ex).
Qed.

Lemma member_swapped Q rad (C D : nat -> nat -> R) :
  member_of Q rad C D -> member_of (swap_pencil Q) (swapped_radii rad) D C.
Proof.
case: rad => [rd|] /=; last by case=> -> ->.
by move=> near i j Hi Hj; have [] := near i j Hi Hj.
Qed.

Section Box.

Variables (t mu : R) (g : nat -> R) (x : nat -> R).
Notation y := (member_reaction (order Q0) A B t x).
Notation y' := (member_reaction (order Q0) A' B' t x).
Hypothesis shares : within_shares radii (size (slip Q0)) g.
Hypothesis nonzero : exists2 i, i \in iota 0 (order Q0) & x i != 0.
Hypothesis rows_f : forall i, i \in free Q0 -> y i = 0.
Hypothesis rows_f' : forall i, i \in free Q0 -> y' i = 0.
Hypothesis signs : forall k, (k < size (slip Q0))%N -> let i := nth 0%N (slip Q0) k in
  let row := y i + mu * (g k * y' i) in [/\ 0 <= x i, 0 <= row & x i * row = 0].
Hypothesis both_absent : forall r',
  both_halves z r' -> agrees (size (slip Q0)) r' (slip_of Q0 x) -> False.
Variables (r : region) (low high : point).
Hypotheses (O : ordered (lower r) (upper r)) (Om : ordered low high).
Hypotheses (bt : between t (lower r) (upper r)) (bm : between mu low high).
Hypothesis ag : agrees (size (slip Q0)) r (slip_of Q0 x).

Lemma member_box_absent n grain e :
  check_anchored_box z radii w (box_expansions z radii w) r low high (AboutAnchor n grain e) ->
  False.
Proof.
rewrite /=; case fams_n: (nth None (box_expansions z radii w) n) => [fams|//].
have lt_n : (n < size (box_anchors w))%N.
  by rewrite ltnNge; apply/negP => l; rewrite nth_default ?size_map in fams_n.
have /and4P[ba0 bb0 ba1 bb1] := bounds; move: fams_n; rewrite (nth_map no_box_anchor) //.
case: (nth no_box_anchor (box_anchors w) n) => reverse a other; rewrite /expand_box /=.
case ex0: (expand_part Q0 _ reverse a) => [fam|//].
case ex1: (expand_part Q1 _ reverse (friction_anchor a other)) => [fam'|//] [<-].
case: reverse ex0 ex1 => ex0 ex1; last first.
  rewrite /check_about /local_part -(size_slips z (Lambda2 0 1)).
  case/and4P=> /= proper grain0 /eqP same_size ok.
  have ready := member_prepared wfQ in_plain ex0 ba0 bb0 proper.
  have ready' := member_prepared (Q := Q1) wfQ in_friction ex1 ba1 bb1 proper.
  exact: (about_absent ready ready' grain0 same_size shares bm bt ag nonzero rows_f rows_f' signs
    both_absent ok).
rewrite /check_about /local_part -(size_slips z (Lambda2 0 1)) => /andP[lo0].
case/and4P=> /= proper grain0 /eqP same_size ok.
have ready := member_prepared (Q := swap_pencil Q0) wfQ (member_swapped in_plain) ex0
  (swapped_below_a bb0) (swapped_below_b ba0) proper.
have ready' := member_prepared (Q := swap_pencil Q1) wfQ (member_swapped in_friction) ex1
  (swapped_below_a bb1) (swapped_below_b ba1) proper.
exact: (about_reversed_absent ready ready' grain0 same_size shares bm (between_gt0 O lo0 bt) bt ag
  nonzero rows_f rows_f' signs both_absent ok).
Qed.

(* Without free variables: the entries of the parts with their radii. *)
Lemma exact_parts_absent rad l : radii = Some rad -> free Q0 = [::] ->
  check_parts (exact_part 0 0 Q0 (plain_radii rad))
    (widened radii (exact_part 0 0 Q1 (friction_radii rad))) r low high l -> False.
Proof.
move=> some no_free ok.
move: (in_plain) (in_friction) (shares); rewrite {1 2 3}some /= => near near' near_g.
have all_slip : slip Q0 = indices (exact_part 0 0 Q0 (plain_radii rad)).
  rewrite /slip (_ : free Q0 = [::]) // (eq_filter (a2 := predT)) ?filter_predT //.
have n_slip : size (slip Q0) = order Q0 by rewrite all_slip size_iota.
have slip_at k : (k < order Q0)%N -> nth 0%N (slip Q0) k = k.
  by move=> lt_k; rewrite all_slip nth_iota.
have {}near_g : within_shares radii (size_of (exact_part 0 0 Q1 (friction_radii rad))) g.
  by move: near_g; rewrite some n_slip.
have E := exact_encloses (first := 0) (factor := 0%Z) isT near.
have E' := exact_encloses (first := 0) (factor := 0%Z) isT near'.
apply: (parts_absent (r := r) (t := t) (mu := mu) E (widened_encloses near_g E')
  (size_widened radii _) O Om bt bm
  (xs := x) (factor := fun=> 1) (row := y) (row' := fun i => g i * y' i) _ _ _ _ _ _ ok) => //.
- move: ag; rewrite n_slip => ag' k lt_k; have := ag' k lt_k.
  by rewrite /slip_of slip_at.
- by move=> i _; apply: ltr01.
- by move=> i _; rewrite mul1r.
- move=> i _; rewrite mul1r /image (same_indices (size_widened radii _)) /member_reaction mulr_sumr.
  apply: eq_bigr => j _; rewrite /Enclosed.T /rows_times /=.
  by move: (A' i j) (B' i j) (g i) (x j) => *; ring.
move=> k; rewrite mem_iota add0n /= => lt_k; have := signs (k := k).
by rewrite n_slip slip_at //; apply.
Qed.

End Box.

End Body.

Section Sound.

Variables (R : rcfType) (z : zero_system) (w : box_anchoring).
Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).

Hypothesis wf : zero_wellformed z Mu.
Notation wfQ := (zero_pencil_wellformed z (Lambda2 0 1)).
Hypothesis bounds : nilp (box_anchors w) || both_bounded z None w.

Variables (t mu : R) (v : nat -> R).
Hypotheses (mu0 : 0 <= mu) (sat : conditions_9z z t mu v).
Notation x := (zero_variables_of z v).
Variables (r : region) (low high : point).
Hypotheses (O : ordered (lower r) (upper r)) (Om : ordered low high).
Hypotheses (bt : between t (lower r) (upper r)) (bm : between mu low high).
Hypothesis ag : agrees (slip_number z) r (slip_of Q0 x).

Lemma both_absent r' : both_halves z r' -> agrees (size (slip Q0)) r' (slip_of Q0 x) -> False.
Proof. by move=> both ag'; apply: both_not_split ag' both (split_variables _). Qed.

Lemma anchored_box_absent l :
  check_anchored_box z None w (box_expansions z None w) r low high l -> False.
Proof.
case: l => [n grain e|l] ok; last exact: (whole_leaf_absent wf mu0 sat O Om bt bm ag ok).
have bounded : both_bounded z None w.
  case/orP: bounds => [/nilP none|//]; move: ok.
  by rewrite /= /box_expansions none /= nth_nil.
have ag' : agrees (size (slip Q0)) r (slip_of Q0 x) by rewrite size_slips.
apply: (member_box_absent bounded (conj erefl erefl) (conj erefl erefl) (t := t) (mu := mu)
  (g := fun=> 1) _ (motion_variables wf sat) (free_row_at wf sat (0, 1)%Z)
  (free_row_at wf sat (1, 0)%Z) _ both_absent O bt bm ag' ok) => // k lt_k i row.
by rewrite /row mul1r; apply: (slip_conditions wf sat); apply: mem_nth.
Qed.

End Sound.

Theorem zero_anchored_critical_absent (R : rcfType) z w tr from bound :
  check_anchored_critical z None w tr from bound ->
  forall (t mu : R) v, 0 <= t -> between mu from bound -> conditions_9z z t mu v -> False.
Proof.
case/and3P=> wf bounds boxes t mu v t0 bm sat; have [x0 start] := motion_start wf t0 sat.
have [r [low [high [l [_ [[bt ag] bm' O Om ok]]]]]] := box_reaches_a_leaf boxes x0 start bm.
exact: (anchored_box_absent wf bounds (between_ge0 Om bm') sat O Om bt bm' ag ok).
Qed.

Corollary anchored_critical_absent (R : rcfType) s w tr from bound :
  check_anchored_critical (ZeroSystem s [::]) None w tr from bound ->
  forall (t mu : R) v, 0 <= t -> between mu from bound -> conditions_9 s t mu v -> False.
Proof.
move=> checked t mu v t0 bm /no_zero_particles.
exact: (zero_anchored_critical_absent checked t0 bm).
Qed.
