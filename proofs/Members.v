(* Bodies known up to radii: no member has a solution below a friction, or each has one.

   A system has radii: of the entries of K and of M, and for each slip particle a share, by which
   its friction factor may differ from the given one.  A *member* has symmetric matrices within the
   radii and factors within the shares; a share is a numerator over one unit.

   With the motion v(x) of System.v and for each row p the form p'(K + t M) v(x), a member differs
   from the system, entry by entry, by at most the form of absolute values |p|'(R_K + t R_M) |v|
   ([part_within]); its friction rows have a factor besides.  So Anchor.v and CriticalAnchors.v
   speak of its rows.

   Theorem [members_absent]: if the check succeeds, then no member has a motion with (9) for t >= 0
   and mu in [from, bound].  [members_present]: each has one for every mu in [from, bound].

   Page: spec/certificates.md, 5.22.  Rust: crates/check/src/cover/spread.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Bounded Signed Cover Condensation Pencil
  Complete System Series Anchor AnchorLeaf ZeroReaction ZeroPencil Boxes Critical CriticalAnchors
  PresenceAnchors.

Record system_radii := SystemRadii {
  stiffness_radii : seq sparse_row;
  mass_radii : seq sparse_row;
  factor_shares : seq Z;
  factor_unit : Z }.

Section Checker.

Variables (s : system) (rad : system_radii).
Local Open Scope Z_scope.

Notation z := (ZeroSystem s [::]).

Definition absolute_table : seq sparse_row :=
  [seq [seq (e.1, Z.abs e.2) | e <- row] | row <- zero_table z].

(* m n + q S t *)
Definition part_direction m q p := direction (q * sign_of p) m p.

Definition radius_form (rows : seq sparse_row) m q i : sparse_row :=
  if (i < free_number s)%N then nth [::] rows (nth 0%N (free_dofs s) i)
  else let p := particle s (i - free_number s) in
       let e := part_direction m q p in
       at_both (nth [::] rows) p (Z.abs e.1, Z.abs e.2).

Definition radius_rows rows m q : seq sparse_row :=
  [seq table_row absolute_table (radius_form rows m q i) | i <- iota 0 (order (part_plain z))].

Definition radii_of_parts : part_radii :=
  PartRadii (radius_rows (stiffness_radii rad) 0 1, radius_rows (mass_radii rad) 0 1)
    (radius_rows (stiffness_radii rad) 1 0, radius_rows (mass_radii rad) 1 0)
    (factor_shares rad) (factor_unit rad).

Definition radii_wellformed :=
  [&& 0 <? factor_unit rad, columns_in_range s (stiffness_radii rad) &
      columns_in_range s (mass_radii rad)].

Definition check_members_absent w tr from bound :=
  [&& radii_wellformed, both_bounded z (Some radii_of_parts) w &
      check_anchored_critical z (Some radii_of_parts) w tr from bound].

Definition check_members_present w pieces from bound :=
  radii_wellformed && check_presence z (Some radii_of_parts) w pieces from bound.

End Checker.

Section Sound.

Variables (R : rcfType) (s : system) (rad : system_radii).
Notation z := (ZeroSystem s [::]).
Hypothesis wf_mu : zero_wellformed z Mu.
Hypothesis wf_rad : radii_wellformed s rad.

Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation all_dofs := (iota 0 (dofs s)).
Notation L := (toR (unit_length s) : R).
Notation Q0 := (part_plain z).
Notation Q1 := (part_friction z).
Notation radii := (Some (radii_of_parts s rad)).
Notation n := (order Q0).
Implicit Types (v x : nat -> R) (k m : nat -> nat -> R).

Let wf : zero_wellformed z (Lambda2 0 1) := zero_wellformed_plain wf_mu.
Let wf_s : system_wellformed s (Lambda2 0 1) := wf_system wf.

(* Forces of a matrix. *)
Definition forced k v d := \sum_(j <- all_dofs) k d j * v j.

Definition part_row a b k v i :=
  if (i < nf)%N then forced k v (nth 0%N (free_dofs s) i)
  else let p := particle s (i - nf) in - along (part_direction a b p) p (forced k v).

Definition basis (j i : nat) : R := if i == j then 1 else 0.
Definition part_entry a b k i j := part_row a b k (zero_motion z (basis j)) i.

Lemma order_parts : n = (nf + ns)%N.
Proof. by rewrite /= muln0 addn0. Qed.

Lemma forced_same k v v' : (forall d, d \in all_dofs -> v d = v' d) -> forced k v =1 forced k v'.
Proof. by move=> same d; apply: sum_eq => j Hj; rewrite same. Qed.

Lemma part_row_same a b k v v' i :
  (forall d, d \in all_dofs -> v d = v' d) -> part_row a b k v i = part_row a b k v' i.
Proof. by move=> same; rewrite /part_row /along !(forced_same k same). Qed.

Lemma row_value_basis (row : sparse_row) j : row_value row (basis j) = toR (lookup row j).
Proof.
elim: row => [|e row IH]; first by rewrite row_value_nil toR0.
rewrite /row_value big_cons -/(row_value row _) IH /basis /=.
by case: eqP => _; rewrite ?toRD ?mulr1 ?mulr0 ?add0r.
Qed.

Lemma motion_basis j d : zero_motion z (basis j) d = toR (lookup (nth [::] (zero_table z) d) j).
Proof. exact: row_value_basis. Qed.

Lemma motion_sum x d : zero_motion z x d = \sum_(j <- iota 0 n) zero_motion z (basis j) d * x j.
Proof.
have range : all (fun e => e.1 < n)%N (nth [::] (zero_table z) d).
  by apply/allP => c /table_small.
rewrite -[LHS]/(row_value _ x) /row_value -(sum_lookup x range).
by apply: eq_bigr => j _; rewrite motion_basis.
Qed.

Lemma forced_sum k x d :
  forced k (zero_motion z x) d = \sum_(j <- iota 0 n) forced k (zero_motion z (basis j)) d * x j.
Proof.
rewrite /forced; under eq_bigr do rewrite motion_sum mulr_sumr.
rewrite exchange_big; apply: eq_bigr => j _; rewrite mulr_suml; apply: eq_bigr => e _.
by rewrite mulrA.
Qed.

Lemma part_row_sum a b k x i :
  part_row a b k (zero_motion z x) i = \sum_(j <- iota 0 n) part_entry a b k i j * x j.
Proof.
rewrite /part_entry /part_row; case: ifP => _; first exact: forced_sum.
rewrite /along !forced_sum !mulr_sumr -big_split -sumrN; apply: eq_bigr => j _ /=.
by move: (forced _ _ _) (forced _ _ _) (toR _) (toR _) (x j) => *; ring.
Qed.

Lemma part_reaction a b k m t x i :
  member_reaction n (part_entry a b k) (part_entry a b m) t x i =
  part_row a b k (zero_motion z x) i + t * part_row a b m (zero_motion z x) i.
Proof.
rewrite !part_row_sum mulr_sumr -big_split; apply: eq_bigr => j _ /=.
by rewrite mulrDl mulrA.
Qed.

Lemma along_part a b p f : along (part_direction a b p) p f =
  toR b * (toR (sign_of p) * along (tangent p) p f) + toR a * along (normal p) p f :> R.
Proof.
rewrite /along /part_direction /direction /= !toRD !toRM.
by move: (f _) (f _) => *; ring.
Qed.

(* The system itself. *)
Lemma own_reaction a b t x i : (i < n)%N -> reaction (zero_pencil z (Lambda2 a b)) t x i =
  part_row a b (k_entry R s) (zero_motion z x) i +
  t * part_row a b (m_entry R s) (zero_motion z x) i.
Proof.
have forceE d : force s t (zero_motion z x) d = forced (k_entry R s) (zero_motion z x) d +
    t * forced (m_entry R s) (zero_motion z x) d by exact: forceE.
rewrite order_parts /part_row => lt_i; case: ltnP => [lt_f|ge_f].
  by rewrite (zero_free_reaction wf).
rewrite -{1}(subnKC ge_f) (slip_part wf) ?ltn_subLR //= flat_turning; last first.
  by apply: flat_particle; rewrite ?ltn_subLR //; apply: (zero_wellformed_flat wf_mu).
rewrite toR0 mul0r addr0 /part_direction /direction /along /=.
rewrite !forceE !toRD !toRM.
by move: (forced _ _ _) (forced _ _ _) (forced _ _ _) (forced _ _ _) => *; ring.
Qed.

Lemma own_entries a b i j : (i < n)%N -> (j < n)%N -> let Q := zero_pencil z (Lambda2 a b) in
  a_entry R Q i j = part_entry a b (k_entry R s) i j /\
  b_entry R Q i j = part_entry a b (m_entry R s) i j.
Proof.
move=> lt_i lt_j Q.
have at_t t : a_entry R Q i j + t * b_entry R Q i j =
    part_entry a b (k_entry R s) i j + t * part_entry a b (m_entry R s) i j.
  rewrite -(own_reaction a b t (basis j) lt_i) /reaction (bigD1_seq j) ?iota_uniq ?mem_iota //=.
  by rewrite /basis eqxx mulr1 big1 ?addr0 // => l /negbTE->; rewrite mulr0.
have eq_a : a_entry R Q i j = part_entry a b (k_entry R s) i j.
  by have := at_t 0; rewrite !mul0r !addr0.
by split=> //; have := at_t 1; rewrite eq_a !mul1r => /addrI.
Qed.

(* Absolute values. *)
Lemma lookup_absolute (row : sparse_row) j :
  `|toR (lookup row j) : R| <= toR (lookup [seq (e.1, Z.abs e.2) | e <- row] j).
Proof.
elim: row => [|e row IH] /=; first by rewrite toR0 normr0.
by case: eqP => _ //; rewrite !toRD toR_abs (le_trans (ler_norm_add _ _)) // ler_add.
Qed.

Definition far j d : R := toR (lookup (nth [::] (absolute_table s) d) j).

Lemma motion_far j d : `|zero_motion z (basis j) d| <= far j d.
Proof.
rewrite motion_basis /far; have [l|l] := ltnP d (size (zero_table z)).
  by rewrite (nth_map [::]) //; apply: lookup_absolute.
have l' : (size (absolute_table s) <= d)%N by rewrite size_map.
by rewrite !(nth_default [::]) //; apply: (lookup_absolute [::]).
Qed.

Section Near.

Variables (rows : seq sparse_row) (k k0 : nat -> nat -> R).
Hypothesis range : columns_in_range s rows.
Hypothesis near : forall d e, d \in all_dofs -> e \in all_dofs ->
  `|k d e - k0 d e| <= toR (lookup (nth [::] rows d) e).

Lemma forced_near j d : d \in all_dofs ->
  `|forced k (zero_motion z (basis j)) d - forced k0 (zero_motion z (basis j)) d| <=
  row_value (nth [::] rows d) (far j).
Proof.
move=> Hd; have in_range : all (fun e => e.1 < dofs s)%N (nth [::] rows d).
  have [l|l] := ltnP d (size rows); last by rewrite nth_default.
  by apply: (allP range); apply: mem_nth.
rewrite /row_value -(sum_lookup _ in_range) -sumrB; apply: le_trans (sum_norm _ _) _.
apply: sum_le => e He.
rewrite -mulrBl normrM; apply: (@le_trans _ _ (`|k d e - k0 d e| * far j e)).
  by rewrite ler_wpmul2l // motion_far.
by rewrite ler_wpmul2r ?near // (le_trans (normr_ge0 _) (motion_far j e)).
Qed.

Lemma part_near a b i j : (i < n)%N ->
  `|part_entry a b k i j - part_entry a b k0 i j| <=
  toR (lookup (nth [::] (radius_rows s rows a b) i) j).
Proof.
move=> lt_i; rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n -row_value_basis.
rewrite row_value_table.
have -> : row_value (radius_form s rows a b i) (table_motion (absolute_table s) (basis j)) =
    row_value (radius_form s rows a b i) (far j).
  by apply: eq_bigr => e _; congr (_ * _); apply: row_value_basis.
rewrite order_parts in lt_i; rewrite /part_entry /part_row /radius_form; case: ltnP => [lt_f|ge_f].
  by apply: forced_near; apply: (free_dof_in wf_s).
have lt_j : (i - nf < ns)%N by rewrite ltn_subLR.
have [first second] := (first_dof_in wf_s lt_j, second_dof_in wf_s lt_j).
rewrite (row_value_both (nth [::] rows)) /along /= !toR_abs.
set v := zero_motion z (basis j); set p := particle s _.
have -> : - (toR (part_direction a b p).1 * forced k v (first_dof p) +
             toR (part_direction a b p).2 * forced k v (second_dof p)) -
    - (toR (part_direction a b p).1 * forced k0 v (first_dof p) +
       toR (part_direction a b p).2 * forced k0 v (second_dof p)) =
    - (toR (part_direction a b p).1 * (forced k v (first_dof p) - forced k0 v (first_dof p)) +
       toR (part_direction a b p).2 * (forced k v (second_dof p) - forced k0 v (second_dof p))).
  by move: (forced _ _ _) (forced _ _ _) (forced _ _ _) (forced _ _ _) => *; ring.
rewrite normrN (le_trans (ler_norm_add _ _)) // !normrM.
by rewrite ler_add // ler_wpmul2l // forced_near.
Qed.

End Near.

(* Members. *)
Variables (k m : nat -> nat -> R) (g : nat -> R).

Definition is_member :=
  [/\ forall d e, d \in all_dofs -> e \in all_dofs -> k d e = k e d,
      forall d e, d \in all_dofs -> e \in all_dofs -> m d e = m e d,
      forall d e, d \in all_dofs -> e \in all_dofs ->
        `|k d e - k_entry R s d e| <= toR (lookup (nth [::] (stiffness_radii rad) d) e) /\
        `|m d e - m_entry R s d e| <= toR (lookup (nth [::] (mass_radii rad) d) e) &
      forall j, (j < ns)%N ->
        `|g j - 1| * toR (factor_unit rad) <= toR (nth 0%Z (factor_shares rad) j)].

(* (9) for the member. *)
Definition member_conditions lambda2 mu v :=
  let w d := forced k v d + lambda2 * forced m v d in
  [/\ exists2 d, d \in all_dofs & v d != 0,
      forall d, d \in all_dofs -> d \notin moving_dofs s -> v d = 0,
      forall d, d \in free_dofs s -> w d = 0 &
      forall j, (j < ns)%N -> let p := particle s j in
        let cone := toR (sign_of p) * along (tangent p) p w + mu * (g j * along (normal p) p w) in
        [/\ along (normal p) p v = 0, slip_rate v p <= 0, cone <= 0 & cone * slip_rate v p = 0]].

Hypothesis member : is_member.

Lemma part_within a b (Q := zero_pencil z (Lambda2 a b)) : within_radii Q
  (part_entry a b k) (part_entry a b m)
  (radius_rows s (stiffness_radii rad) a b, radius_rows s (mass_radii rad) a b).
Proof.
have /and3P[_ range_k range_m] := wf_rad; have [_ _ near _] := member.
move=> i j; rewrite !mem_iota !add0n => lt_i lt_j.
have [-> ->] := own_entries a b lt_i lt_j.
by split; apply: part_near => // d e Hd He; have [] := near d e Hd He.
Qed.

Lemma member_plain : member_of Q0 (omap plain_radii radii) (part_entry 0 1 k) (part_entry 0 1 m).
Proof. exact: part_within. Qed.

Lemma member_friction :
  member_of Q1 (omap friction_radii radii) (part_entry 1 0 k) (part_entry 1 0 m).
Proof. exact: part_within. Qed.

Lemma slip_size : size (slip Q0) = ns.
Proof. by rewrite (size_slips z (Lambda2 0 1)) /slip_number muln0 addn0. Qed.

Lemma member_shares : within_shares radii (size (slip Q0)) g.
Proof.
have /and3P[u0 _ _] := wf_rad; have [_ _ _ near] := member; rewrite slip_size; split=> //.
by rewrite toR_gt0.
Qed.

Lemma slip_at_number j : (j < ns)%N -> nth 0%N (slip Q0) j = (nf + j)%N.
Proof. by move=> lt_j; rewrite zero_slips nth_iota // /slip_number muln0 addn0. Qed.

(* Rows at a motion. *)
Section At.

Variables (t mu : R) (x v : nat -> R).
Hypothesis same : forall d, d \in all_dofs -> zero_motion z x d = v d.
Notation w := (fun d => forced k v d + t * forced m v d).

Lemma row_at a b i : member_reaction n (part_entry a b k) (part_entry a b m) t x i =
  if (i < nf)%N then w (nth 0%N (free_dofs s) i)
  else let p := particle s (i - nf) in - along (part_direction a b p) p w.
Proof.
rewrite part_reaction !(part_row_same _ _ _ _ same) /part_row; case: ifP => // _.
by rewrite /along; move: (toR _) (toR _) (forced _ _ _) (forced _ _ _) (forced _ _ _) (forced _ _ _)
  => *; ring.
Qed.

Lemma slip_row_at j : (j < ns)%N -> let p := particle s j in
  member_reaction n (part_entry 0 1 k) (part_entry 0 1 m) t x (nf + j)%N +
  mu * (g j * member_reaction n (part_entry 1 0 k) (part_entry 1 0 m) t x (nf + j)%N) =
  - (toR (sign_of p) * along (tangent p) p w + mu * (g j * along (normal p) p w)).
Proof.
move=> lt_j p; rewrite !row_at ltnNge leq_addr /= addKn -/p !along_part toR0 toR1.
by move: (along _ _ _) (along _ _ _) => *; ring.
Qed.

End At.

(* A leaf about the entries of both parts. *)
Section Exact.

Notation A := (part_entry 0 1 k).
Notation B := (part_entry 0 1 m).
Notation A' := (part_entry 1 0 k).
Notation B' := (part_entry 1 0 m).
Notation rd := (radii_of_parts s rad).
Variables (t mu : R) (x : nat -> R).
Notation y := (member_reaction n A B t x).
Notation y' := (member_reaction n A' B' t x).
Hypothesis nonzero : exists2 i, i \in iota 0 n & x i != 0.
Hypothesis rows : forall i, i \in free Q0 -> y i = 0.
Hypothesis signs : forall j, (j < size (slip Q0))%N -> let i := nth 0%N (slip Q0) j in
  let row := y i + mu * (g j * y' i) in [/\ 0 <= x i, 0 <= row & x i * row = 0].
Variables (r : region) (low high : point).
Hypotheses (O : ordered (lower r) (upper r)) (Om : ordered low high).
Hypotheses (bt : between t (lower r) (upper r)) (bm : between mu low high).
Hypothesis ag : agrees (size (slip Q0)) r (slip_of Q0 x).

Definition factor_of_row i : R := if (i < nf)%N then 1 else g (i - nf).

Lemma free_size : size (free Q0) = nf.
Proof. by rewrite size_iota. Qed.

Lemma shares_of_all : within_shares (Some (radii_of_all (size (free Q0)) rd)) n factor_of_row.
Proof.
have [u0 near] := member_shares; split=> // i; rewrite order_parts free_size /factor_of_row => lt_i.
rewrite nth_cat size_nseq; case: ltnP => [lt_f|ge_f].
  by rewrite subrr normr0 mul0r nth_nseq lt_f toR0.
by apply: near; rewrite slip_size ltn_subLR.
Qed.

Lemma row_product c i : (i < n)%N ->
  x i * ((if (i < nf)%N then toR c * y i else y i) +
         mu * (factor_of_row i * if (i < nf)%N then 0 else y' i)) = 0.
Proof.
rewrite /factor_of_row => lt_n; have lt_i : (i < nf + ns)%N by rewrite -order_parts.
case: ltnP => [lt_f|ge_f].
  have in_free : i \in free Q0 by rewrite mem_iota.
  by rewrite rows // !mulr0 addr0 mulr0.
have lt_j : (i - nf < ns)%N by rewrite ltn_subLR.
have := signs (j := (i - nf)%N); rewrite slip_size slip_at_number // subnKC // => /(_ lt_j).
by case.
Qed.

Lemma signed_absent c f f' (nf' := size (free Q0)) (P := exact_part nf' c Q0 (plain_radii rd))
    (P' := widened (Some (radii_of_all nf' rd)) (exact_part nf' 0 Q1 (friction_radii rd))) :
  (0 <=? c)%Z -> box_signed (mixed low P P') (mixed high P P') r f f' -> False.
Proof.
move=> c0; have E := exact_encloses (first := nf') c0 member_plain.
have E' := widened_encloses (P := exact_part _ _ Q1 _) shares_of_all
  (exact_encloses (first := nf') (factor := 0%Z) isT member_friction).
have same : size_of P' = size_of P by [].
have [a [b [a0 b0 [one val] [ab _]]]] := weights_of_ends Om bm.
have [l1 l2 h1 h2] := ordered_ge0 R Om.
have El := mixed_encloses E E' same l1 l2; have Eh := mixed_encloses E E' same h1 h2.
move=> ok; apply: (box_signed_sound El Eh (erefl _) O bt a0 b0 ab nonzero ok).
apply: sum_zero => i; rewrite mem_iota add0n => /= lt_i.
rewrite /box_image !image_mixed // -[RHS](row_product c lt_i); congr (x i * _).
set row := if (i < nf)%N then toR c * y i else y i; set row' := if (i < nf)%N then 0 else y' i.
have -> : image P (rows_times nf' c A) (rows_times nf' c B) t x i = row.
  rewrite /image /T /rows_times /row /nf' free_size; case: ifP => _ //.
  rewrite /member_reaction mulr_sumr; apply: eq_bigr => j _.
  by move: (A i j) (B i j) (toR c) (x j) => *; ring.
have -> : image P' (fun i j => factor_of_row i * rows_times nf' 0 A' i j)
    (fun i j => factor_of_row i * rows_times nf' 0 B' i j) t x i = factor_of_row i * row'.
  rewrite /image /T /rows_times /row' /nf' free_size toR0; case: ifP => _.
    by rewrite mulr0 sum_zero // => j _; rewrite !mul0r !mulr0 addr0 mul0r.
  rewrite /member_reaction mulr_sumr; apply: eq_bigr => j _.
  by move: (A' i j) (B' i j) (factor_of_row i) (x j) => *; ring.
rewrite -[X in X + mu * _]mul1r -one -val.
by move: row (factor_of_row i * row') => *; ring.
Qed.

Lemma exact_absent l : check_exact z (radii_of_parts s rad) r low high l -> False.
Proof.
rewrite /check_exact; case is_signed: l => [v|d f f'|v|a b|c f f'|]; last 2 first.
- by case/andP; apply: signed_absent.
- by case/andP.
all: rewrite -is_signed => /andP[/nilP no_free]; rewrite no_free.
all: have -> : radii_of_all (size [::]) rd = rd by case: rd.
all: exact: (exact_parts_absent member_plain member_friction member_shares nonzero signs O Om bt bm
  ag (erefl _) no_free).
Qed.

End Exact.

Theorem members_absent w tr from bound : check_members_absent s rad w tr from bound ->
  forall t mu v, 0 <= t -> between mu from bound -> member_conditions t mu v -> False.
Proof.
case/and3P=> _ bounds /and3P[_ _ boxes] t mu v t0 bm sat; have [nonzero rest rows slips] := sat.
pose x := zero_variables_of z v.
have same d : d \in all_dofs -> zero_motion z x d = v d.
  apply: (motion_of_zero_variables wf).
    by move=> e He; rewrite /moving_with_zero cats0; apply: rest.
  by move=> j /slips[].
have L2 : 0 < L ^+ 2 by rewrite exprn_gt0 // (unit_length_gt0 R wf_s).
have signs j : (j < size (slip Q0))%N -> let i := nth 0%N (slip Q0) j in
    let row := member_reaction n (part_entry 0 1 k) (part_entry 0 1 m) t x i +
      mu * (g j * member_reaction n (part_entry 1 0 k) (part_entry 1 0 m) t x i) in
    [/\ 0 <= x i, 0 <= row & x i * row = 0].
  rewrite slip_size => lt_j i row; rewrite /row /i slip_at_number // (slip_row_at t mu same lt_j).
  have [_ rate cone product] := slips j lt_j.
  have -> : x (nf + j)%N = - (slip_rate v (particle s j) / L ^+ 2).
    by rewrite /x /zero_variables_of ltn_add2l lt_j /variables_of ltnNge leq_addr /= addKn.
  split; rewrite ?oppr_ge0 //; first by rewrite pmulr_lle0 ?invr_gt0.
  rewrite mulrNN; set c := _ + _ in product *.
  by rewrite mulrAC [_ * c]mulrC product mul0r.
have free_rows a b i : i \in free Q0 ->
    member_reaction n (part_entry a b k) (part_entry a b m) t x i = 0.
  rewrite mem_iota add0n /= => lt_i; rewrite (row_at t same) lt_i.
  by apply: rows; apply: mem_nth.
have x_nonzero : exists2 i, i \in iota 0 n & x i != 0.
  have [d Hd vd] := nonzero; apply/hasP; apply: contraNT vd => /hasPn none.
  rewrite -same // motion_sum sum_zero // => j Hj.
  by have := none j Hj; rewrite negbK => /eqP->; rewrite mulr0.
have x0 j : (j < slip_number z)%N -> 0 <= slip_of Q0 x j.
  by rewrite -(size_slips z (Lambda2 0 1)) => lt_j; have [] := signs j lt_j.
have start : in_region (slip_number z) t (slip_of Q0 x) (window zero infinity).
  split; last by move=> i _; rewrite /state_of nth_nil.
  by rewrite /between /= toR0 toR1 mulr1 mulr0 ler01.
have [r [low [high [l [_ [[bt ag] bm' O Om ok]]]]]] := box_reaches_a_leaf boxes x0 start bm.
have ag' : agrees (size (slip Q0)) r (slip_of Q0 x).
  by move: ag; rewrite -(size_slips z (Lambda2 0 1)).
case: l ok => [a grain e|l] ok.
  apply: (member_box_absent bounds member_plain member_friction member_shares x_nonzero
    (free_rows 0%Z 1%Z) (free_rows 1%Z 0%Z) signs _ O bt bm' ag' ok) => //.
exact: (exact_absent x_nonzero (free_rows 0%Z 1%Z) signs O Om bt bm' ag' ok).
Qed.

Theorem members_present w pieces from bound : check_members_present s rad w pieces from bound ->
  forall mu, between mu from bound -> exists t v, 0 <= t /\ member_conditions t mu v.
Proof.
case/andP=> _ checked mu bm; have /and4P[_ bounds _ _] := checked.
have same_rows i j : i \in free Q0 -> part_entry 1 0 k i j = part_entry 0 1 k i j /\
    part_entry 1 0 m i j = part_entry 0 1 m i j.
  by rewrite mem_iota add0n /= => lt_i; rewrite /part_entry /part_row lt_i.
have [p [t [x [_ [t0 ag nonzero rows signs]]]]] :=
  member_present bounds member_plain member_friction member_shares same_rows checked bm.
have same d : d \in all_dofs -> zero_motion z x d = motion s x d.
  move=> Hd; have [moves|rests] := boolP (d \in moving_dofs s).
    exact: (zero_motion_moving wf).
  rewrite zero_motion_rest ?motion_zero //.
  by rewrite /moving_with_zero cats0.
exists t, (motion s x); split=> //; split.
- apply/(motion_nonzero wf_s); case: nonzero => i Hi xi; exists i => //.
  by rewrite -order_parts.
- by move=> d _; apply: motion_zero.
- move=> d /(nthP 0%N)[i lt_i <-]; have := rows i; rewrite mem_iota add0n => /(_ lt_i).
  by rewrite (row_at t same) lt_i.
move=> j lt_j; have lt_slip : (j < size (slip Q0))%N by rewrite slip_size.
have := signs j lt_slip; cbv zeta; rewrite slip_at_number // (slip_row_at t mu same lt_j) oppr_ge0.
case=> x0 cone product; have L2 : 0 < L ^+ 2 by rewrite exprn_gt0 // (unit_length_gt0 R wf_s).
rewrite (slip_motion wf_s) //; split=> //; first exact: (normal_motion wf_s).
  by rewrite oppr_le0 mulr_ge0 // ltW.
set c := _ + _ in cone product *.
have {}product : x (nf + j)%N * c = 0 by apply/eqP; rewrite -oppr_eq0 -mulrN product.
by rewrite mulrN mulrCA [c * _]mulrC product mulr0 oppr0.
Qed.

End Sound.
