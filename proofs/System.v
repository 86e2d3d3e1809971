(* From stiffness, mass, contact states and signs to a pencil.

   A mechanical system has [dofs] degrees of freedom, sparse rows of K and M (multiplied by one
   positive integer each), a list of free degrees of freedom, and slip particles: the tangential
   and the normal degree of freedom, the sign S_p of the tangential reaction, and the direction of
   the normal (1 into the obstacle, -1 away from it).  All other degrees of freedom do not move.

   [conditions_9] are the conditions (9) for such a system, for values of lambda^2 and mu:

       w = (K + lambda^2 M) v,   v != 0,   w_f = 0,   v = 0 at what does not move,
       S v_T <= 0,   S w_T + mu w_N <= 0,   (S w_T + mu w_N)(S v_T) = 0   for each slip particle.

   The unknown is mu with lambda = 0, or lambda^2 with mu given as a fraction.

   Theorem [system_pencil]: x solves the pencil that is computed here if and only if the motion
   v(x), that is v_f = x_f and v_T = -S x_T, satisfies (9).  [system_onto]: every motion that
   satisfies (9) is v(x) for some x.

   Theorem [system_complete]: the main theorem for mechanical systems.  If the check succeeds, each
   motion with (9) and its value in the window lies in a region yielded or left undecided, and each
   region yielded
   has exactly one, up to a positive factor.  [system_none]: none.  [system_number],
   [system_exactly]: how many there are, as in Complete.v.

   [system_claim]: an exact solution claim about the pencil gives a motion with (9).

   The pencil is in the order of spec/certificates.md: free degrees of freedom, then slip
   particles.  Frames and particles at zero reaction are not covered.

   Page: spec/certificates.md, 5.1; spec/reduction.md.  Rust: crates/check/src/pencil.rs. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra zify ssrZ ring.
From Mceip Require Import Integers Sums Tree Enclosed Covered Definite Root RootLeaf Cover.
From Mceip Require Import Number Condensation Pencil Whole Claim Complete.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.

Delimit Scope Z_scope with Z.
Local Open Scope ring_scope.

Record slip_particle := SlipParticle {
  tangential : nat;
  normal : nat;
  sign_of : Z;
  direction : Z }.

Record system := System {
  dofs : nat;
  stiffness : seq sparse_row;
  mass : seq sparse_row;
  free_dofs : seq nat;
  particles : seq slip_particle }.

(* Mu: the unknown is mu.  Lambda2 p q: the unknown is lambda^2, and mu = p/q. *)
Inductive unknown := Mu | Lambda2 of Z & Z.

Section Checker.

Variables (s : system) (u : unknown).
Local Open Scope Z_scope.

Notation nobody := (SlipParticle 0 0 0 0).

Definition free_number := size (free_dofs s).
Definition tangentials := [seq tangential p | p <- particles s].
Definition moving_dofs := free_dofs s ++ tangentials.
Definition particle j := nth nobody (particles s) j.

Definition k_row d := nth [::] (stiffness s) d.
Definition m_row d := nth [::] (mass s) d.

(* The column of the pencil to which a degree of freedom belongs, and the factor it gets. *)
Definition column d : option (nat * Z) :=
  if d \in free_dofs s then Some (index d (free_dofs s), 1)
  else if d \in tangentials then
    let j := index d tangentials in Some ((free_number + j)%N, - sign_of (particle j))
  else None.

Definition columns (row : sparse_row) : sparse_row :=
  pmap (fun e => omap (fun c => (c.1, c.2 * e.2)) (column e.1)) row.

Definition multiple c (row : sparse_row) : sparse_row := [seq (e.1, c * e.2) | e <- row].

Definition free_row_b d := if u is Lambda2 _ _ then columns (m_row d) else [::].

Definition slip_row_a p :=
  match u with
  | Mu => multiple (- sign_of p) (columns (k_row (tangential p)))
  | Lambda2 m q => multiple (- (q * sign_of p)) (columns (k_row (tangential p))) ++
                   multiple (- (m * direction p)) (columns (k_row (normal p)))
  end.

Definition slip_row_b p :=
  match u with
  | Mu => multiple (- direction p) (columns (k_row (normal p)))
  | Lambda2 m q => multiple (- (q * sign_of p)) (columns (m_row (tangential p))) ++
                   multiple (- (m * direction p)) (columns (m_row (normal p)))
  end.

Definition pencil_of : pencil := Pencil (free_number + size (particles s))
  ([seq columns (k_row d) | d <- free_dofs s] ++ [seq slip_row_a p | p <- particles s])
  ([seq free_row_b d | d <- free_dofs s] ++ [seq slip_row_b p | p <- particles s])
  (iota 0 free_number).

Definition columns_in_range (rows : seq sparse_row) :=
  all (fun row => all (fun e => e.1 < dofs s)%N row) rows.

Definition system_wellformed :=
  [&& uniq moving_dofs, all (fun d => d < dofs s)%N moving_dofs,
      all (fun p => sign_of p * sign_of p =? 1) (particles s),
      all (fun p => normal p \notin moving_dofs) (particles s),
      columns_in_range (stiffness s) && columns_in_range (mass s) &
      if u is Lambda2 _ q then 0 <? q else true].

Definition check_system claims w tr lo hi :=
  system_wellformed && check_complete pencil_of claims w tr lo hi.

Definition check_system_excluded tr lo hi :=
  system_wellformed && check_excluded pencil_of tr lo hi.

Definition check_system_claim k := system_wellformed && check_claim pencil_of k.

End Checker.

Section Sound.

Variables (R : rcfType) (s : system) (u : unknown).
Implicit Types (t : R) (x v : nat -> R).
Notation all_dofs := (iota 0 (dofs s)).
Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation variables := (iota 0 (nf + ns)).
Notation Q := (pencil_of s u).

Definition k_entry d j : R := toR (lookup (k_row s d) j).
Definition m_entry d j : R := toR (lookup (m_row s d) j).

(* w_d *)
Definition force lambda2 (v : nat -> R) d :=
  \sum_(j <- all_dofs) (k_entry d j + lambda2 * m_entry d j) * v j.

(* S w_T + mu w_N *)
Definition cone lambda2 mu v p :=
  toR (sign_of p) * force lambda2 v (tangential p) +
  mu * (toR (direction p) * force lambda2 v (normal p)).

Definition conditions_9 lambda2 mu (v : nat -> R) :=
  [/\ exists2 d, d \in all_dofs & v d != 0,
      forall d, d \in all_dofs -> d \notin moving_dofs s -> v d = 0,
      forall d, d \in free_dofs s -> force lambda2 v d = 0 &
      forall j, (j < ns)%N -> let p := particle s j in
        [/\ toR (sign_of p) * v (tangential p) <= 0, cone lambda2 mu v p <= 0 &
            cone lambda2 mu v p * (toR (sign_of p) * v (tangential p)) = 0]].

(* (9) with the unknown t >= 0. *)
Definition satisfies_9 t v :=
  0 <= t /\ match u with
            | Mu => conditions_9 0 t v
            | Lambda2 m q => conditions_9 t (toR m / toR q) v
            end.

(* (10) *)
Definition motion (x : nat -> R) d :=
  if column s d is Some (j, c) then toR c * x j else 0.

Hypothesis wf : system_wellformed s u.

Lemma uniq_moving_dofs : uniq (moving_dofs s).
Proof. by case/andP: wf. Qed.

Lemma moving_dof_in d : d \in moving_dofs s -> d \in all_dofs.
Proof. by case/and3P: wf => _ /allP lt _ /lt; rewrite mem_iota. Qed.

Lemma sign_squared j : (j < ns)%N -> toR (sign_of (particle s j)) ^+ 2 = 1 :> R.
Proof.
move=> lt_j; case/and4P: wf => _ _ /(all_nthP (SlipParticle 0 0 0 0)) /(_ _ lt_j) sq _.
by move: sq => /Z.eqb_spec; rewrite expr2 -toRM => ->.
Qed.

Lemma rows_in_range d :
  all (fun e => e.1 < dofs s)%N (k_row s d) /\ all (fun e => e.1 < dofs s)%N (m_row s d).
Proof.
case/and5P: wf => _ _ _ _ /andP[/andP[/allP k /allP m] _]; rewrite /k_row /m_row.
split.
  by have [l|l] := ltnP d (size (stiffness s)); [apply/k/mem_nth | rewrite nth_default].
by have [l|l] := ltnP d (size (mass s)); [apply/m/mem_nth | rewrite nth_default].
Qed.

Lemma tangential_particle j : (j < ns)%N ->
  tangential (particle s j) = nth 0%N (tangentials s) j.
Proof. by move=> lt_j; rewrite /tangentials (nth_map (SlipParticle 0 0 0 0)). Qed.

Lemma column_free k : (k < nf)%N -> column s (nth 0%N (free_dofs s) k) = Some (k, 1%Z).
Proof.
move=> lt_k; rewrite /column mem_nth // index_uniq //.
by have := uniq_moving_dofs; rewrite cat_uniq => /and3P[].
Qed.

Lemma column_slip j : (j < ns)%N ->
  column s (tangential (particle s j)) = Some ((nf + j)%N, (- sign_of (particle s j))%Z).
Proof.
move=> lt_j; have := uniq_moving_dofs; rewrite cat_uniq => /and3P[_ /hasPn disjoint uniq_t].
have lt_t : (j < size (tangentials s))%N by rewrite size_map.
rewrite tangential_particle // /column mem_nth // index_uniq //.
by rewrite ifF //; apply/negbTE/disjoint/mem_nth.
Qed.

Lemma column_in_range d j c : column s d = Some (j, c) -> (j < nf + ns)%N.
Proof.
rewrite /column; case: ifP => [d_free [<- _]|_].
  by rewrite (leq_trans _ (leq_addr _ _)) // index_mem.
by case: ifP => // d_slip [<- _]; rewrite ltn_add2l -(size_map tangential) index_mem.
Qed.

Lemma columns_in_pencil row : all (fun e => e.1 < nf + ns)%N (columns s row).
Proof.
elim: row => //= e row; rewrite /columns /=; case col: (column s e.1) => [[j c]|] //= ->.
by rewrite (column_in_range col).
Qed.

(* A row of K or M on the motion of x is its row of columns on x. *)
Lemma row_motion row x : all (fun e => e.1 < dofs s)%N row ->
  \sum_(j <- variables) toR (lookup (columns s row) j) * x j =
  \sum_(d <- all_dofs) toR (lookup row d) * motion x d.
Proof.
move=> range; rewrite (sum_lookup _ range) (sum_lookup _ (columns_in_pencil row)).
elim: row {range} => [|e row IH]; first by rewrite !big_nil.
rewrite big_cons -IH /columns /= /motion; case: (column s e.1) => [[j c]|] /=.
  by rewrite big_cons /= toRM mulrA [toR c * _]mulrC.
by rewrite mulr0 add0r.
Qed.

Lemma lookup_multiple c row j :
  toR (lookup (multiple c row) j) = toR c * toR (lookup row j) :> R.
Proof.
elim: row => [|e row IH] /=; first by rewrite toR0 mulr0.
by case: eqP => _ //; rewrite !toRD toRM IH mulrDr.
Qed.

Lemma lookup_cat row1 row2 j :
  toR (lookup (row1 ++ row2) j) = toR (lookup row1 j) + toR (lookup row2 j) :> R.
Proof.
elim: row1 => [|e row IH] /=; first by rewrite toR0 add0r.
by case: eqP => _ //; rewrite !toRD IH addrA.
Qed.

(* Products of rows of K and M with v. *)
Definition k_product (v : nat -> R) d := \sum_(j <- all_dofs) k_entry d j * v j.
Definition m_product (v : nat -> R) d := \sum_(j <- all_dofs) m_entry d j * v j.

Lemma forceE lambda2 v d : force lambda2 v d = k_product v d + lambda2 * m_product v d.
Proof.
rewrite /force /k_product /m_product mulr_sumr -big_split /=; apply: eq_bigr => j _.
by rewrite mulrDl mulrA.
Qed.

Lemma k_product_columns x d :
  \sum_(j <- variables) toR (lookup (columns s (k_row s d)) j) * x j = k_product (motion x) d.
Proof. by rewrite row_motion //; case: (rows_in_range d). Qed.

Lemma m_product_columns x d :
  \sum_(j <- variables) toR (lookup (columns s (m_row s d)) j) * x j = m_product (motion x) d.
Proof. by rewrite row_motion //; case: (rows_in_range d). Qed.

(* y_i in terms of both rows. *)
Lemma reactionE t x i : reaction Q t x i =
  \sum_(j <- variables) toR (lookup (row_a Q i) j) * x j +
  t * \sum_(j <- variables) toR (lookup (row_b Q i) j) * x j.
Proof.
rewrite /reaction mulr_sumr -big_split /=; apply: eq_bigr => j _.
by rewrite mulrDl mulrA.
Qed.

Definition lambda2_of (t : R) := if u is Lambda2 _ _ then t else 0.
Definition mu_of (t : R) := if u is Lambda2 m q then toR m / toR q else t.

(* The positive number by which a slip row was multiplied. *)
Definition row_factor : R := if u is Lambda2 _ q then toR q else 1.

Lemma row_factor_gt0 : 0 < row_factor.
Proof.
rewrite /row_factor; case: u wf => [_|m q /and5P[_ _ _ _ /andP[_]]]; first exact: ltr01.
by rewrite toR_gt0.
Qed.

Lemma free_reaction t x k : (k < nf)%N ->
  reaction Q t x k = force (lambda2_of t) (motion x) (nth 0%N (free_dofs s) k).
Proof.
move=> lt_k; rewrite reactionE forceE /row_a /row_b /= !nth_cat !size_map lt_k.
rewrite !(nth_map 0%N) // k_product_columns; congr (_ + _).
rewrite /free_row_b /lambda2_of; case: (u) => [|m q].
  by rewrite mul0r sum_zero ?mulr0 // => j _; rewrite toR0 mul0r.
by rewrite m_product_columns.
Qed.

Lemma sum_multiple c row (x : nat -> R) :
  \sum_(j <- variables) toR (lookup (multiple c row) j) * x j =
  toR c * \sum_(j <- variables) toR (lookup row j) * x j.
Proof. by rewrite mulr_sumr; apply: eq_bigr => j _; rewrite lookup_multiple mulrA. Qed.

Lemma sum_cat row1 row2 (x : nat -> R) :
  \sum_(j <- variables) toR (lookup (row1 ++ row2) j) * x j =
  \sum_(j <- variables) toR (lookup row1 j) * x j + \sum_(j <- variables) toR (lookup row2 j) * x j.
Proof. by rewrite -big_split; apply: eq_bigr => j _; rewrite lookup_cat mulrDl. Qed.

Lemma slip_reaction t x j : (j < ns)%N ->
  reaction Q t x (nf + j)%N =
  - (row_factor * cone (lambda2_of t) (mu_of t) (motion x) (particle s j)).
Proof.
move=> lt_j; rewrite reactionE /cone !forceE /row_a /row_b /= !nth_cat !size_map.
rewrite ltnNge leq_addr /= addKn !(nth_map (SlipParticle 0 0 0 0)) // -/(particle s j).
set p := particle s j; rewrite /slip_row_a /slip_row_b /lambda2_of /mu_of.
have := row_factor_gt0; rewrite /row_factor; case: (u) => [_|m q q0].
  rewrite !sum_multiple !k_product_columns !toRN.
  move: (k_product _ _) (k_product _ _) (m_product _ _) (m_product _ _) => k1 k2 m1 m2.
  by move: (toR _) (toR _) => *; ring.
rewrite !sum_cat !sum_multiple !k_product_columns !m_product_columns !toRN !toRM.
move: (k_product _ _) (k_product _ _) (m_product _ _) (m_product _ _) => k1 k2 m1 m2.
move: (toR (sign_of p)) (toR (direction p)) => sg dir.
by field; exact: lt0r_neq0.
Qed.

Lemma free_variable i : (i \in free Q) = (i < nf)%N.
Proof. by rewrite mem_iota. Qed.

Lemma slip_variable i : i \in slip Q -> exists2 j, (j < ns)%N & i = (nf + j)%N.
Proof.
rewrite mem_filter !mem_iota !add0n /= -leqNgt => /andP[ge lt].
by exists (i - nf)%N; [rewrite -(ltn_add2l nf) subnKC | rewrite subnKC].
Qed.

Lemma slip_variable_in j : (j < ns)%N -> (nf + j)%N \in slip Q.
Proof. by move=> lt_j; rewrite mem_filter !mem_iota !add0n /= -leqNgt leq_addr ltn_add2l. Qed.

Lemma motion_free x k : (k < nf)%N -> motion x (nth 0%N (free_dofs s) k) = x k.
Proof. by move=> lt_k; rewrite /motion column_free // toR1 mul1r. Qed.

Lemma motion_slip x j : (j < ns)%N ->
  toR (sign_of (particle s j)) * motion x (tangential (particle s j)) = - x (nf + j)%N.
Proof.
by move=> lt_j; rewrite /motion column_slip // toRN mulNr mulrN mulrA -expr2 sign_squared ?mul1r.
Qed.

Lemma motion_zero x d : d \notin moving_dofs s -> motion x d = 0.
Proof.
rewrite mem_cat negb_or => /andP[/negbTE not_free /negbTE not_slip].
by rewrite /motion /column not_free not_slip.
Qed.

Lemma motion_nonzero x :
  (exists2 i, i \in variables & x i != 0) <-> (exists2 d, d \in all_dofs & motion x d != 0).
Proof.
split=> [[i]|[d _]].
  rewrite mem_iota add0n /= => lt_i xi; have [lt_nf|ge_nf] := ltnP i nf.
    exists (nth 0%N (free_dofs s) i); last by rewrite motion_free.
    by apply: moving_dof_in; rewrite mem_cat mem_nth.
  have lt_j : (i - nf < ns)%N by rewrite -(ltn_add2l nf) subnKC.
  exists (tangential (particle s (i - nf))).
    apply: moving_dof_in; rewrite mem_cat tangential_particle //.
    by rewrite [X in _ || X]mem_nth ?orbT // size_map.
  apply: contraNneq xi => vd; have := motion_slip x lt_j.
  by rewrite vd mulr0 subnKC // => /esym/eqP; rewrite oppr_eq0.
rewrite /motion; case col: (column s d) => [[j c]|]; last by rewrite eqxx.
rewrite mulf_eq0 negb_or => /andP[_ xj]; exists j => //.
by rewrite mem_iota add0n; apply: column_in_range col.
Qed.

Lemma satisfies_9E t v :
  satisfies_9 t v <-> 0 <= t /\ conditions_9 (lambda2_of t) (mu_of t) v.
Proof. by rewrite /satisfies_9 /lambda2_of /mu_of; case: (u). Qed.

Theorem system_pencil t x : solution Q t x <-> satisfies_9 t (motion x).
Proof.
rewrite satisfies_9E; have c0 := row_factor_gt0.
split=> [[t0 nonzero rows_f rows_s]|[t0 [nonzero _ rows_f rows_s]]].
  split=> //; split; first exact/motion_nonzero.
  - by move=> d _; apply: motion_zero.
  - move=> d /(nthP 0%N)[k lt_k <-]; rewrite -free_reaction // rows_f //.
    by rewrite free_variable.
  move=> j lt_j p; have [x0 + +] := rows_s _ (slip_variable_in lt_j).
  rewrite slip_reaction // motion_slip // oppr_ge0 oppr_le0 mulrN => y0 xy.
  split=> //; first by rewrite -(pmulr_rle0 _ c0).
  apply: (mulfI (lt0r_neq0 c0)); rewrite mulr0 -[RHS]xy.
  by move: (cone _ _ _ _) (x _) => *; ring.

split=> //; first exact/motion_nonzero.
  by move=> i; rewrite free_variable => lt_i; rewrite free_reaction // rows_f // mem_nth.
move=> i /slip_variable[j lt_j ->]; have := rows_s _ lt_j.
rewrite slip_reaction //= motion_slip // oppr_le0 => -[x0 y0 xy]; split=> //.
  by rewrite oppr_ge0 pmulr_rle0.
by rewrite mulrN -mulNr mulrCA [- x _ * _]mulrC xy mulr0.
Qed.

(* x from v *)
Definition variables_of (v : nat -> R) i :=
  if (i < nf)%N then v (nth 0%N (free_dofs s) i)
  else let p := particle s (i - nf) in - (toR (sign_of p) * v (tangential p)).

Theorem system_onto t v : satisfies_9 t v ->
  forall d, d \in all_dofs -> motion (variables_of v) d = v d.
Proof.
rewrite satisfies_9E => -[_ [_ at_rest _ _]] d Hd.
have [d_in|d_out] := boolP (d \in moving_dofs s); last by rewrite motion_zero // at_rest.
move: d_in; rewrite mem_cat => /orP[/(nthP 0%N)[k lt_k <-]|].
  by rewrite motion_free // /variables_of lt_k.
case/(nthP 0%N)=> j; rewrite size_map => lt_j; rewrite -tangential_particle // => <-.
have sq := sign_squared lt_j.
have nz : toR (sign_of (particle s j)) != 0 :> R.
  by apply: contra_eqN sq => /eqP->; rewrite expr0n eq_sym oner_eq0.
apply: (mulfI nz); rewrite motion_slip // /variables_of ltnNge leq_addr /= addKn.
exact: opprK.
Qed.

(* (9) speaks of degrees of freedom only. *)
Lemma satisfies_9_ext t v v' : (forall d, d \in all_dofs -> v d = v' d) ->
  satisfies_9 t v -> satisfies_9 t v'.
Proof.
move=> same; rewrite !satisfies_9E => -[t0 [[d Hd vd] at_rest rows_f rows_s]].
have forceE' l d' : force l v d' = force l v' d'.
  by apply: sum_eq => j Hj; rewrite same.
split=> //; split; first by exists d; rewrite -?same.
- by move=> d' Hd' out; rewrite -same // at_rest.
- by move=> d' /rows_f; rewrite forceE'.
move=> j lt_j; have := rows_s _ lt_j; rewrite /= /cone !forceE' same //.
apply: moving_dof_in; rewrite mem_cat tangential_particle //.
by rewrite [X in _ || X]mem_nth ?orbT // size_map.
Qed.

Lemma solution_of_motion t v : satisfies_9 t v -> solution Q t (variables_of v).
Proof.
move=> sat; apply/system_pencil; apply: (satisfies_9_ext _ sat) => d Hd.
by rewrite (system_onto sat).
Qed.

Lemma variables_of_motion x i : i \in variables -> variables_of (motion x) i = x i.
Proof.
rewrite mem_iota add0n /= => lt_i; rewrite /variables_of.
have [lt_nf|ge_nf] := ltnP i nf; first exact: motion_free.
by rewrite motion_slip ?opprK ?subnKC // -(ltn_add2l nf) subnKC.
Qed.

Lemma motion_proportional x x' :
  proportional Q x x' ->
  exists2 f, 0 < f & forall d, motion x' d = f * motion x d.
Proof.
case=> f f0 scaled; exists f => // d; rewrite /motion.
case col: (column s d) => [[j c]|]; last by rewrite mulr0.
by rewrite scaled; [rewrite mulrCA | rewrite mem_iota add0n; apply: column_in_range col].
Qed.

End Sound.

Section Main.

Variables (R : rcfType) (s : system) (u : unknown).
Implicit Types (t : R) (x v : nat -> R).
Notation all_dofs := (iota 0 (dofs s)).

(* v' is a positive multiple of v. *)
Definition same_motion (v v' : nat -> R) :=
  exists2 f, 0 < f & forall d, d \in all_dofs -> v' d = f * v d.

(* The motion (t, v) lies in a region. *)
Definition motion_in r t (v : nat -> R) :=
  lies_in (pencil_of s u) r t (variables_of s v).

Variables (claims : seq claim).
Variables (w : elimination) (tr : tree (leaf whole)) (lo hi : point).
Hypothesis checked : check_system s u claims w tr lo hi.

Notation Q := (pencil_of s u).
Notation found := (found Q claims tr lo hi).
Notation left_open := (left_open tr lo hi).

Lemma lies_in_motion r t x : lies_in Q r t x -> motion_in r t (motion s x).
Proof.
have [wf _] := andP checked; case=> bt ag; split=> // j lt_j; have := ag j lt_j.
rewrite /slip_of (variables_of_motion wf) //.
exact: (slip_indices (Q := Q) (mem_nth 0%N lt_j)).
Qed.

Lemma proportional_motion x x' : proportional Q x x' -> same_motion (motion s x) (motion s x').
Proof.
by move/motion_proportional=> [f f0 scaled]; exists f.
Qed.

(* x and x' give one motion only if they are proportional. *)
Lemma motion_injective x x' : same_motion (motion s x) (motion s x') -> proportional Q x x'.
Proof.
have [wf _] := andP checked; case=> f f0 scaled; exists f => // i Hi.
rewrite -(variables_of_motion wf x' Hi) -(variables_of_motion wf x Hi) /variables_of.
case: ifP => [lt_i|ge_i]; first by rewrite scaled // (moving_dof_in wf) // mem_cat mem_nth.
have lt_j : (i - free_number s < size (particles s))%N.
  move: Hi; rewrite mem_iota add0n /= => lt_i.
  by rewrite -(ltn_add2l (free_number s)) subnKC // leqNgt ge_i.
rewrite scaled ?mulrN 1?mulrCA //; apply: (moving_dof_in wf).
by rewrite mem_cat tangential_particle // [X in _ || X]mem_nth ?orbT // size_map.
Qed.

Theorem system_complete :
  (forall t v, satisfies_9 s u t v -> between t lo hi ->
     (exists2 y, List.In y found & motion_in (yield_region y) t v) \/
     (exists2 r, List.In r left_open & motion_in r t v)) /\
  (forall y, List.In y found -> exists (t : R) v,
     [/\ between t (yield_from y) (yield_to y), satisfies_9 s u t v,
         motion_in (yield_region y) t v &
      forall t' v', satisfies_9 s u t' v' -> motion_in (yield_region y) t' v' ->
        t' = t /\ same_motion v v']).
Proof.
case/andP: (checked) => wf complete; have [every each] := complete_sound R complete.
split=> [t v sat bt|y in_found]; first exact: every (solution_of_motion wf sat) bt.

have [t [x [bt sol reg uniq]]] := each _ in_found.
exists t, (motion s x); split=> //; [exact/(system_pencil wf) | exact: lies_in_motion |].
move=> t' v' sat' reg'; have [-> prop] := uniq _ _ (solution_of_motion wf sat') reg'.
have [f f0 scaled] := motion_proportional prop.
by split=> //; exists f => // d Hd; rewrite -scaled (system_onto wf sat').
Qed.

Corollary system_none : found = [::] -> left_open = [::] ->
  forall (t : R) v, satisfies_9 s u t v -> between t lo hi -> False.
Proof.
move=> none closed t v sat bt; have [[y]|[r]] := system_complete.1 t v sat bt.
  by rewrite none.
by rewrite closed.
Qed.

Theorem system_number ys : solutions_found Q claims tr lo hi = Some ys ->
  exists l : seq (R * (nat -> R)),
    [/\ size l = size ys,
        forall m, List.In m l -> satisfies_9 s u m.1 m.2 /\ between m.1 lo hi,
        List.Forall2 (fun y m => between m.1 (yield_from y) (yield_to y) /\
                                 motion_in (yield_region y) m.1 m.2) ys l,
        List.ForallOrdPairs (fun m m' => ~ (m'.1 = m.1 /\ same_motion m.2 m'.2)) l &
        forall t v, satisfies_9 s u t v -> between t lo hi ->
          (exists2 m, List.In m l & t = m.1 /\ same_motion m.2 v) \/
          (exists2 r, List.In r left_open & motion_in r t v)].
Proof.
case/andP: (checked) => wf complete; case/(complete_number R complete).
move=> l [sz sols vals pairs every].
exists [seq (p.1, motion s p.2) | p <- l]; split=> //.
- by rewrite size_map.
- move=> m /List.in_map_iff[p [<- /sols[sol bt]]]; split=> //=; exact/(system_pencil wf).
- elim: vals => [|y p ys' l' [bt reg] _ IH] /=; constructor=> //.
  by split=> //; apply: lies_in_motion.
- elim: pairs => [|p l' different _ IH] /=; constructor=> //.
  apply/List.Forall_forall => m /List.in_map_iff[p' [<- p'_in]] /= [eq_t /motion_injective prop].
  by have /List.Forall_forall/(_ _ p'_in) := different; apply.
move=> t v sat bt; have [[p p_in [-> prop]]|] := every t _ (solution_of_motion wf sat) bt.
  left; exists (p.1, motion s p.2); first by apply/List.in_map_iff; exists p.
  split=> //=; have [f f0 scaled] := motion_proportional prop.
  by exists f => // d Hd; rewrite -scaled (system_onto wf sat).
by right.
Qed.

Corollary system_exactly ys :
  solutions_found Q claims tr lo hi = Some ys -> left_open = [::] ->
  exists l : seq (R * (nat -> R)),
    [/\ size l = size ys,
        forall m, List.In m l -> satisfies_9 s u m.1 m.2 /\ between m.1 lo hi,
        List.Forall2 (fun y m => between m.1 (yield_from y) (yield_to y) /\
                                 motion_in (yield_region y) m.1 m.2) ys l,
        List.ForallOrdPairs (fun m m' => ~ (m'.1 = m.1 /\ same_motion m.2 m'.2)) l &
        forall t v, satisfies_9 s u t v -> between t lo hi ->
          exists2 m, List.In m l & t = m.1 /\ same_motion m.2 v].
Proof.
move=> number closed; have [l [sz sols vals pairs every]] := system_number number.
exists l; split=> // t v sat bt; have [//|[r]] := every t v sat bt.
by rewrite closed.
Qed.

End Main.

Theorem system_excluded (R : rcfType) s u tr lo hi : check_system_excluded s u tr lo hi ->
  forall (t : R) v, satisfies_9 s u t v -> between t lo hi -> False.
Proof.
case/andP=> wf excluded t v sat.
exact: (excluded_sound (R := R) excluded (solution_of_motion wf sat)).
Qed.

Theorem system_claim (R : rcfType) s u k : check_system_claim s u k -> exists (t : R) v,
  [/\ toR (claim_from k) <= toR (claim_denominator k) * t,
      toR (claim_denominator k) * t <= toR (claim_to k) & satisfies_9 s u t v].
Proof.
case/andP=> wf /(@claim_sound R)[t [x [at_from at_to sol _]]].
by exists t, (motion s x); split=> //; apply/(system_pencil wf).
Qed.
