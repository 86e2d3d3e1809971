(* Complete sets of solutions of a pencil: the main theorem about certificates of pencils.

   The checker gets a pencil, a window [lo, hi] of values (hi may be infinity), claims (exact or
   enclosed) that root leaves may refer to, a witness for the elimination of the free variables, and
   a tree.  The tree yields regions, each with an interval of a value; it may leave regions
   undecided.

   Theorem [complete_sound]: if the check succeeds, then
     1. each solution with a value in the window lies in a region yielded or in an undecided one;
     2. each region yielded has exactly one solution up to a positive factor, and its value lies in
        the interval yielded with it.
   [complete_none]: nothing yielded or undecided, no solution in the window.

   Theorem [complete_number]: if moreover [solutions_found] gives a list of N yields, then there are
   N solutions with a value in the window, one for each of them and no two of them equal, and every
   other solution in the window lies in an undecided region.  [complete_exactly]: with nothing
   undecided there are exactly these N solutions.

   Claims and cover are about the same pencil, so they agree.  Theorem [claim_place]: a claim that
   is checked, with its interval in the window, has a solution that lies in a region yielded, with
   its value in the interval yielded, or in an undecided region.  The checker need not look for the
   places of claims.

   Theorem [excluded_sound]: for pencils whose free rows depend on t a tree may use definite leaves
   of the whole pencil only; if the check succeeds, the window has no solution.

   Page: spec/certificates.md, 5.6, 5.14, 5.15.
   Rust: crates/check/src/lib.rs, cover/mod.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Definite Root RootLeaf Pinned
  Cover Number Condensation Pencil Whole Claim EnclosedClaim.

(* A claim about the pencil: with polynomials, or in a box. *)
Inductive solution_claim := ExactClaim of claim | BoxClaim of enclosed_claim.

Section Checker.

Variables (Q : pencil) (claims : seq solution_claim).

(* Positions among the complementarity variables. *)
Definition positions (l : seq nat) := [seq index i (slip Q) | i <- l].

Definition claimed_support k :=
  match k with ExactClaim e => support e | BoxClaim b => box_support b end.

Definition claimed_biactive k :=
  match k with ExactClaim e => biactive e | BoxClaim _ => [::] end.

Definition claimed_from k : point :=
  match k with ExactClaim e => (claim_from e, claim_denominator e) | BoxClaim b => box_from b end.

Definition claimed_to k : point :=
  match k with ExactClaim e => (claim_to e, claim_denominator e) | BoxClaim b => box_to b end.

(* What a claim says about its solution. *)
Definition known_of k := Known (claimed_from k) (claimed_to k)
  (positions (claimed_support k)) (positions (claimed_biactive k)).

Definition check_solution_claim k :=
  match k with ExactClaim e => check_claim Q e | BoxClaim b => check_enclosed_claim Q b end.

Definition known_solutions := [seq known_of k | k <- claims].

(* On the moving set of r, x is a null vector of the pencil with these rows at free variables and
   those of B at the others: x_k != 0, and x vanishes where r rests. *)
Definition check_null (free_row : nat -> sparse_row) (r : region) (k : nat) (x : seq Z) :=
  let at_slip j := nth 0%Z x (nth 0%N (slip Q) j) in
  [&& columns_in_order Q, negb (at_slip k =? 0)%Z,
      all (fun i => sparse_dot (free_row i) x =? 0)%Z (free Q) &
      all (fun j => if is_moving (state_of r j)
                    then (sparse_dot (row_b Q (nth 0%N (slip Q) j)) x =? 0)%Z
                    else (at_slip j =? 0)%Z) (iota 0 (size (slip Q)))].

(* A null vector at infinity; the rows of A and B at free variables are those of A. *)
Definition check_limit r k x := (k < size (slip Q))%N && check_null (row_a Q) r k x.

Variables (w : elimination) (tr : tree (leaf whole)) (lo hi : point).

(* The blocks are an argument, so that they are computed once. *)
Definition check_blocks (D : blocks) :=
  [&& wellformed Q, free_rows_constant Q, check_elimination D w, all check_solution_claim claims &
      check_cover (condensed D w) known_solutions (check_whole Q) check_limit tr lo hi].

Definition check_complete := check_blocks (blocks_of Q).

(* What the tree yields, and what it leaves open. *)
Definition found := yields (enclosed_order (size (slip Q))) known_solutions tr (window lo hi).
Definition left_open := undecided tr (window lo hi).

(* The yields with different solutions. *)
Definition solutions_found := distinct_yields (size (slip Q)) lo hi found.

End Checker.

Definition check_excluded Q (tr : tree whole) lo hi :=
  wellformed Q && check_tree (size (slip Q)) (check_whole Q) tr (window lo hi).

Section Sound.

Variables (R : rcfType) (Q : pencil).

(* The solution (t, x) lies in a region. *)
Definition lies_in (r : region) (t : R) x := in_region (size (slip Q)) t (slip_of Q x) r.

Definition one_solution_in := has_one (solution Q) (proportional Q) lies_in.

Lemma proportional_sym (x x' : nat -> R) : proportional Q x x' -> proportional Q x' x.
Proof.
case=> f f0 scaled; exists f^-1; first by rewrite invr_gt0.
by move=> i Hi; rewrite scaled // mulKf // gt_eqF.
Qed.

Lemma proportional_trans (x y z : nat -> R) :
  proportional Q x y -> proportional Q y z -> proportional Q x z.
Proof.
case=> f f0 xy [g g0 yz]; exists (g * f); first exact: mulr_gt0.
by move=> i Hi; rewrite yz // xy // mulrA.
Qed.

Lemma proportional_slip (x x' : nat -> R) : proportional Q x x' ->
  exists2 f, 0 < f & forall j, (j < size (slip Q))%N -> slip_of Q x' j = f * slip_of Q x j.
Proof.
case=> f f0 scaled; exists f => // j lt_j.
by apply/scaled/slip_indices/mem_nth.
Qed.

Lemma mem_positions (l : seq nat) j : (j < size (slip Q))%N -> all (fun i => i \in slip Q) l ->
  (j \in positions Q l) = (nth 0%N (slip Q) j \in l).
Proof.
move=> lt_j /allP in_slip; apply/mapP/idP => [[i il ->]|jl].
  by rewrite nth_index // in_slip.
by exists (nth 0%N (slip Q) j) => //; rewrite index_uniq // uniq_slip.
Qed.

(* (t, x) is a solution as q says. *)
Definition known_solution (q : known) (t : R) x :=
  [/\ between t (known_from q) (known_to q), solution Q t x &
      forall j, (j < size (slip Q))%N ->
        [/\ j \in known_support q -> 0 < slip_of Q x j,
            j \notin known_support q -> slip_of Q x j = 0 &
            j \notin known_support q -> j \in known_biactive q ->
              reaction Q t x (nth 0%N (slip Q) j) = 0]].

(* Such a solution lies in one of the regions. *)
Definition known_in q (ys : seq yield) (rs : seq region) := exists t x, known_solution q t x /\
  ((exists2 y, List.In y ys & between t (yield_from y) (yield_to y) /\
                              lies_in (yield_region y) t x) \/ in_some lies_in rs t x).

(* The solution of a claim. *)
Lemma claimed_slip k : check_solution_claim Q k ->
  all (fun i => i \in slip Q) (claimed_support k) /\
  all (fun i => i \in slip Q) (claimed_biactive k).
Proof.
case: k => [e|b] /=; last by case/and5P=> _ _ _ _ /and3P[].
by case/and5P=> _ _ _ _ /and3P[]; rewrite all_cat => /andP[].
Qed.

Theorem solution_claim_sound k : check_solution_claim Q k -> exists (t : R) x,
  [/\ between t (claimed_from k) (claimed_to k), solution Q t x &
      forall i, i \in slip Q ->
        [/\ i \in claimed_support k -> 0 < x i, i \notin claimed_support k -> x i = 0,
            i \notin claimed_support k -> i \in claimed_biactive k -> reaction Q t x i = 0 &
            i \notin claimed_support k -> i \notin claimed_biactive k -> 0 < reaction Q t x i]].
Proof.
case: k => [e|b] /= ok.
  have [t [x [from_t t_to sol signs]]] := claim_sound R ok.
  by exists t, x; split=> //; rewrite /between /= ![t * _]mulrC.
have [t [x [bt sol pos zero _]]] := enclosed_claim_sound R ok.
exists t, x; split=> // i Hi; split=> // [|out|out _]; first exact: pos.
  by have [] := zero _ Hi out.
by have [] := zero _ Hi out.
Qed.

Lemma claim_known k : check_solution_claim Q k -> exists t x, known_solution (known_of Q k) t x.
Proof.
move=> ok; have [in_s in_b] := claimed_slip ok.
have [t [x [bt sol signs]]] := solution_claim_sound ok.
exists t, x; split=> // j lt_j; have [pos zero biact _] := signs _ (mem_nth 0%N lt_j).
by rewrite !mem_positions.
Qed.

(* Where the known solution lies in a cover. *)
Lemma known_place q lo hi (ys : seq yield) (rs : seq region) :
  covers (solution Q) (proportional Q) lies_in lo hi ys (in_some lies_in rs) ->
  (exists t x, known_solution q t x) -> within (known_from q, known_to q) (lo, hi) ->
  known_in q ys rs.
Proof.
move=> [every each] [t [x known]] inside; exists t, x; split=> //; have [bt sol _] := known.
have [[y y_in reg]|in_open] := every t x sol (within_between inside bt); last by right.
left; exists y => //; have [t' [x' [bt' _ _ uniq]]] := each y y_in.
by have [eq_t _] := uniq t x sol reg; split=> //; rewrite eq_t.
Qed.

Section Complete.

Variables (claims : seq solution_claim).
Variables (w : elimination) (tr : tree (leaf whole)) (lo hi : point).
Hypothesis checked : check_complete Q claims w tr lo hi.

Notation D := (blocks_of Q).
Notation P := (condensed D w).
Notation A := (A_condensed R D w).
Notation B := (B_condensed R D w).
Notation ns := (size (slip Q)).
Notation solves := (solves P A B).
Notation found := (found Q claims tr lo hi).
Notation left_open := (left_open tr lo hi).

Lemma parts :
  [/\ wellformed Q, free_rows_constant Q, stiffness_positive D w, shapes D w &
      check_cover P (known_solutions Q claims) (check_whole Q) (check_limit Q) tr lo hi].
Proof. by case/and5P: checked => ? ? /andP[]. Qed.

Lemma claims_checked n k : (n < size claims)%N -> check_solution_claim Q (nth k claims n).
Proof. by case/and5P: checked => _ _ _ /(all_nthP k) all_k _; apply: all_k. Qed.

Lemma condensed_solution t x : solution Q t x ->
  solves t (slip_of Q x) /\
  forall k, k \in iota 0 (size (free Q)) -> free_of Q x k = free_part D (slip_of Q x) k.
Proof.
have [wf con pos shp _] := parts.
by move/(pencil_blocks wf con)/(condensation_exact pos shp).
Qed.

Lemma whole_solution t xs : solves t xs -> exists x,
  solution Q t x /\ forall j, (j < ns)%N -> slip_of Q x j = xs j.
Proof.
have [wf con pos shp _] := parts => sol.
exists (join Q (free_part D xs) xs); split; last by move=> j; apply: slip_of_join.
by apply: (join_solution wf con); apply/(condensation_exact pos shp).
Qed.

Lemma lies_in_ext r t (x : nat -> R) xs :
  (forall j, (j < ns)%N -> slip_of Q x j = xs j) -> in_region ns t xs r <-> lies_in r t x.
Proof.
move=> same; rewrite /lies_in; split=> -[bt ag]; split=> // j lt_j; have := ag j lt_j;
  by rewrite same.
Qed.

Lemma whole_leaf_sound r wl (t : R) xs :
  ordered (lower r) (upper r) -> check_whole Q r wl -> in_region ns t xs r ->
  solves t xs -> False.
Proof.
move=> O ok reg /whole_solution[x [sol same]]; have [wf _ _ _ _] := parts.
have [bt ag] := (lies_in_ext r t same).1 reg.
exact: (whole_sound wf O ok bt ag sol).
Qed.

Lemma encloses_condensed : encloses P A B.
Proof. by have [_ _ pos shp _] := parts; apply: condensation_encloses. Qed.

(* A row of the condensed pencil is a positive multiple of a row of the pencil. *)
Lemma condensed_row t x j : (j < ns)%N ->
  (forall k, k \in iota 0 (size (free Q)) -> free_of Q x k = free_part D (slip_of Q x) k) ->
  image P A B t (slip_of Q x) j =
  scale_of R w j * toR (unit_of w) ^+ 2 * reaction Q t x (nth 0%N (slip Q) j).
Proof.
by have [wf con _ _ _] := parts; apply: condensed_reaction.
Qed.

Lemma known_sound n : (n < size (known_solutions Q claims))%N ->
  exists t x, is_known P A B (known_at (known_solutions Q claims) n) t x.
Proof.
rewrite size_map => lt_n; pose k0 := ExactClaim (Claim [::] 0 0 0 [::] [::] [::] [::] [::]).
rewrite /known_at (nth_map k0) //; set k := nth k0 claims n.
have [t [x [bt sol signs]]] := claim_known (claims_checked k0 lt_n).
have [sol_s free_x] := condensed_solution sol.
exists t, (slip_of Q x); split=> // j; rewrite mem_iota add0n /= => lt_j.
have [pos zero biact] := signs _ lt_j; split=> // ns' nb.
by rewrite condensed_row // biact // mulr0.
Qed.

Lemma limit_sound r k x : check_limit Q r k x -> exists2 xs : nat -> R,
  xs k != 0 & forall l, l \in moving P r -> \sum_(j <- moving P r) B l j * xs j = 0.
Proof.
case/andP=> lt_k /and4P[cols xk /allP free0 /allP slip0]; have [wf con pos shp _] := parts.
pose X i : R := toR (nth 0%Z x i).
have ca i := (columns_in_rows cols i).1; have cb i := (columns_in_rows cols i).2.

(* The free part of X is what the free rows demand. *)
have free_X : forall k', k' \in iota 0 (size (free Q)) ->
    free_of Q X k' = free_part D (slip_of Q X) k'.
  apply: (free_part_of_rows wf con pos (t := 0)) => i /free0 /Z.eqb_spec zero.
  rewrite /reaction -[RHS](toR0 R) -zero (toR_sparse_dot R x (ca _)); apply: eq_bigr => j _.
  by rewrite mul0r addr0.

(* B X vanishes in the moving rows: the difference of the images at 1 and at 0. *)
have image_B l : l \in moving P r -> \sum_(j <- indices P) B l j * slip_of Q X j = 0.
  move=> lJ; have lt_l : (l < ns)%N by have := moving_indices lJ; rewrite mem_iota add0n.
  have -> : \sum_(j <- indices P) B l j * slip_of Q X j =
            image P A B 1 (slip_of Q X) l - image P A B 0 (slip_of Q X) l.
    rewrite /image -sumrB; apply: eq_bigr => j _; rewrite /Enclosed.T.
    by move: (A l j) (B l j) (slip_of Q X j) => *; ring.
  rewrite !condensed_row // -mulrBr.
  have -> : reaction Q 1 X (nth 0%N (slip Q) l) - reaction Q 0 X (nth 0%N (slip Q) l) =
            toR (sparse_dot (row_b Q (nth 0%N (slip Q) l)) x).
    rewrite (toR_sparse_dot R x (cb _)) /reaction -sumrB; apply: eq_bigr => j _.
    rewrite /b_entry /X; move: (a_entry R Q _ j) (toR (lookup _ j)) (toR (nth 0%Z x j)) => *.
    by ring.
  have := slip0 l (moving_indices lJ).
  by move: lJ; rewrite mem_filter => /andP[-> _] /Z.eqb_spec->; rewrite toR0 mulr0.

exists (slip_of Q X) => [|l lJ]; first by rewrite /slip_of /X toR_eq0.
rewrite -[RHS](image_B l lJ) [RHS](sum_support (p := fun j => is_moving (state_of r j))) //.
move=> j Hj /negbTE rest; have := slip0 j Hj; rewrite rest => /Z.eqb_spec zero.
by rewrite /slip_of /X zero toR0 mulr0.
Qed.

Theorem complete_sound :
  covers (solution Q) (proportional Q) lies_in lo hi found (in_some lies_in left_open).
Proof.
have [wf con pos shp cover] := parts.
have [every each] := cover_sound encloses_condensed known_sound whole_leaf_sound limit_sound cover.
split=> [t x /condensed_solution[sol _] bt|y in_found]; first exact: every t _ sol bt.

have [t [xs [bt sol reg uniq]]] := each _ in_found.
exists t, (join Q (free_part D xs) xs).
have same j : (j < ns)%N -> slip_of Q (join Q (free_part D xs) xs) j = xs j.
  by move=> lt_j; apply: slip_of_join.
split=> //.
- by apply: (join_solution wf con); apply/(condensation_exact pos shp).
- exact/(lies_in_ext _ _ same).

move=> t' x' /condensed_solution[sol' free'] reg'.
have [-> [f f0 scaled]] := uniq _ _ sol' reg'.
split=> //; exists f => // i Hi; case/orP: (free_or_slip Hi) => /(nthP 0%N)[k lt_k <-].
  rewrite -[LHS]/(free_of Q x' k) -[X in _ = f * X]/(free_of Q _ k) free' ?mem_iota //.
  rewrite free_of_join // /free_part mulrN mulr_sumr; congr (- _); apply: sum_eq => j Hj.
  by rewrite scaled // mulrCA.
rewrite -[LHS]/(slip_of Q x' k) -[X in _ = f * X]/(slip_of Q _ k) same //.
by apply: scaled; rewrite mem_iota.
Qed.

Corollary complete_none : found = [::] -> left_open = [::] ->
  forall (t : R) x, solution Q t x -> between t lo hi -> False.
Proof.
by move=> none no_open; have := complete_sound; rewrite none no_open; apply: covers_none.
Qed.

Theorem claim_place k : check_solution_claim Q k ->
  within (known_from (known_of Q k), known_to (known_of Q k)) (lo, hi) ->
  known_in (known_of Q k) found left_open.
Proof. by move/claim_known; apply: known_place complete_sound. Qed.

Theorem complete_number ys : solutions_found Q claims tr lo hi = Some ys ->
  all_listed (solution Q) (proportional Q) lies_in lo hi ys (in_some lies_in left_open).
Proof.
exact: (distinct_listed proportional_slip proportional_sym proportional_trans complete_sound).
Qed.

Corollary complete_exactly ys :
  solutions_found Q claims tr lo hi = Some ys -> left_open = [::] ->
  all_listed (solution Q) (proportional Q) lies_in lo hi ys no_other.
Proof.
by move=> /complete_number + no_open; apply: listed_weaken => t x; rewrite no_open => -[].
Qed.

End Complete.

Theorem excluded_sound tr lo hi : check_excluded Q tr lo hi ->
  forall t (x : nat -> R), solution Q t x -> between t lo hi -> False.
Proof.
case/andP=> wf checked t x sol bt; have [_ _ _ rows_s] := sol.
have x0 j : (j < size (slip Q))%N -> 0 <= slip_of Q x j.
  by move=> lt_j; have [] := rows_s _ (mem_nth 0%N lt_j).
have start : in_region (size (slip Q)) t (slip_of Q x) (window lo hi).
  by split=> // i _; rewrite /state_of nth_nil.
have [[r w] _ [[bt' ag] O ok]] := every_point_reaches_a_leaf checked x0 start.
exact: (whole_sound wf O ok bt' ag sol).
Qed.

End Sound.
