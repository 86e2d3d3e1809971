(* Support leaves: what one support holds at every value of an interval.

   In a region every variable is decided: moving (x_i > 0, hence y_i = 0) or resting (x_i = 0); with
   the free variables the moving ones are active.  The leaf divides the interval of the region into
   places: values (roots of polynomials), the open intervals between neighbouring values, and what
   lies above the last value.  T(t) = A + t B is the whole pencil.  Each place has a reason, a list
   of polynomials in t with signs that hold at each t of the place (Signs.v):

     Refuted w     w_i >= 0 for i resting; (w'T)_j = 0 for j free, (w'T)_j <= 0 for j moving and
                   < 0 for some of these.  For a solution 0 <= w'y = w'Tx < 0: there is none.
     Solved x      x_i > 0 for i moving, x_i = 0 for i resting; with y = T x, y_i = 0 for i active,
                   y_i >= 0 for i resting: a solution at each t of the place.
       alone, k    for each active j other than k there is l with (l'T)_j > 0, and one with
                   (l'T)_j < 0, where (l'T)_i = 0 for every active i but j and k; for i resting
                   l_i = 0, or l_i >= 0 and y_i = 0.  Then for each solution z

                       (l'T)_j z_j + (l'T)_k z_k = l'T z >= 0,     with equality for z = x,

                   so z_j / z_k is bounded by x_j / x_k from both sides: z is a multiple of x.

   Theorem [support_covers]: every solution in the region has its value in a place that is solved.
   [support_holds]: at each value of such a place there is a solution in the region, and any two are
   multiples of each other if the place is called alone.

   Page: spec/certificates.md, 5.12.  Rust: crates/check/src/cover/support.rs. *)

From Mceip Require Import Base Lists Integers Sums Tree Enclosed Existence Condensation Pencil Claim
  Signs.

Inductive claimed_sign := IsZero | IsPositive | IsNegative.

(* A sign with its evidence. *)
Definition signed := (claimed_sign * sign_evidence)%type.

(* One polynomial for each variable of the pencil. *)
Definition poly_vector := seq polynomial.

Record refutation := Refutation {
  row_weights : poly_vector;
  weight_signs : seq signed;
  column_signs : seq signed }.

Record bound := Bound { bounded : nat; bound_signs : refutation }.

Record branch := SolvedBy {
  branch_x : poly_vector;
  x_signs : seq signed;
  y_signs : seq signed;
  alone_by : option (nat * seq bound) }.

Inductive reason := Refuted of refutation | Solved of branch.

Inductive chain :=
  | Stop
  | Last of reason
  | Next of reason & value & reason & chain.

Record support_leaf := SupportLeaf {
  first_value : value;
  first_reason : reason;
  further : chain }.

(* Solutions at each value of a place. *)
Record holding := Holding { held_place : place; held_alone : bool }.

Section Checker.

Local Open Scope Z_scope.

Definition shows pl g (c : signed) :=
  match c.1 with
  | IsZero => zero_in pl g c.2
  | IsPositive => positive_in pl g c.2
  | IsNegative => positive_in pl (scale_poly (-1) g) c.2
  end.

Definition is_zero (c : signed) := if c.1 is IsZero then true else false.
Definition is_positive (c : signed) := if c.1 is IsPositive then true else false.
Definition is_negative (c : signed) := if c.1 is IsNegative then true else false.

Definition sign_at (signs : seq signed) i := nth (IsZero, Identity) signs i.

Variables (Q : pencil) (r : region).
Notation indices := (iota 0 (order Q)).

(* The role of variable i in the region. *)
Definition is_free (i : nat) := i \in free Q.
Definition moves (i : nat) := ~~ is_free i && is_moving (state_of r (index i (slip Q))).
Definition rests (i : nat) := ~~ is_free i && is_resting (state_of r (index i (slip Q))).
Definition is_active (i : nat) := is_free i || moves i.

Definition decided_region := all (fun i => is_active i || rests i) indices.

Definition component_of (x : poly_vector) i := nth [::] x i.

(* p T_ij *)
Definition times_entry i j p := mul_poly [:: lookup (row_a Q i) j; lookup (row_b Q i) j] p.
Arguments times_entry : simpl never.

(* (w'T)_j *)
Definition column_poly (w : poly_vector) j : polynomial :=
  foldr (fun i sum =>
           if component_of w i is [::] then sum
           else add_poly (times_entry i j (component_of w i)) sum) [::] indices.

Section Place.

Variable pl : place.

Definition check_refutation (f : refutation) :=
  [&& all (fun i => ~~ rests i ||
        ~~ is_negative (sign_at (weight_signs f) i) &&
        shows pl (component_of (row_weights f) i) (sign_at (weight_signs f) i)) indices,
      all (fun j => ~~ is_active j ||
        [&& ~~ is_positive (sign_at (column_signs f) j),
            ~~ is_free j || is_zero (sign_at (column_signs f) j) &
            shows pl (column_poly (row_weights f) j) (sign_at (column_signs f) j)]) indices &
      has (fun j => moves j && is_negative (sign_at (column_signs f) j)) indices].

Definition check_branch (b : branch) :=
  [&& columns_in_order Q,
      has moves indices,
      all (fun i => ~~ moves i ||
        is_positive (sign_at (x_signs b) i) &&
        shows pl (component_of (branch_x b) i) (sign_at (x_signs b) i)) indices,
      all (fun i => ~~ rests i ||
        is_zero (sign_at (x_signs b) i) &&
        shows pl (component_of (branch_x b) i) (sign_at (x_signs b) i)) indices &
      all (fun i => [&& ~~ is_negative (sign_at (y_signs b) i),
                        ~~ is_active i || is_zero (sign_at (y_signs b) i) &
                        shows pl (row_poly Q (branch_x b) i) (sign_at (y_signs b) i)]) indices].

Definition check_bound (b : branch) (k : nat) (o : bound) :=
  let f := bound_signs o in
  [&& is_active (bounded o), (bounded o < order Q)%N,
      all (fun i => ~~ rests i ||
        [&& ~~ is_negative (sign_at (weight_signs f) i),
            is_zero (sign_at (weight_signs f) i) || is_zero (sign_at (y_signs b) i) &
            shows pl (component_of (row_weights f) i) (sign_at (weight_signs f) i)]) indices &
      all (fun j => [|| ~~ is_active j, j == k |
        ((j == bounded o) || is_zero (sign_at (column_signs f) j)) &&
        shows pl (column_poly (row_weights f) j) (sign_at (column_signs f) j)]) indices].

Definition own_sign (o : bound) := sign_at (column_signs (bound_signs o)) (bounded o).

Definition check_alone (b : branch) :=
  if alone_by b is Some (k, bounds) then
    [&& moves k, (k < order Q)%N, all (check_bound b k) bounds &
        all (fun j => [|| ~~ is_active j, j == k |
          has (fun o => (bounded o == j) && is_positive (own_sign o)) bounds &&
          has (fun o => (bounded o == j) && is_negative (own_sign o)) bounds]) indices]
  else true.

(* The place lies in the interval of the region, and its ends are in order. *)
Definition inside :=
  let above v := (lower r).1 * value_den v <=? value_from v * (lower r).2 in
  let below v := value_to v * (upper r).2 <=? (upper r).1 * value_den v in
  match pl with
  | PointAt v => above v && below v
  | Between v v' =>
      [&& above v, below v' & value_to v * value_den v' <? value_from v' * value_den v]
  | Above v => above v && ((upper r).2 =? 0)
  end.

Definition check_reason (e : reason) :=
  place_checked pl &&
  match e with
  | Refuted f => check_refutation f
  | Solved b => [&& inside, check_branch b & check_alone b]
  end.

End Place.

Fixpoint chain_places (v : value) (c : chain) : seq (place * reason) :=
  match c with
  | Stop => [::]
  | Last e => [:: (Above v, e)]
  | Next e v' e' c' => (Between v v', e) :: (PointAt v', e') :: chain_places v' c'
  end.

Definition leaf_places (l : support_leaf) :=
  (PointAt (first_value l), first_reason l) :: chain_places (first_value l) (further l).

Fixpoint reaches_end (v : value) (c : chain) :=
  match c with
  | Stop => (0 <? (upper r).2) && ((upper r).1 * value_den v <=? value_from v * (upper r).2)
  | Last _ => true
  | Next _ v' _ c' => reaches_end v' c'
  end.

Definition check_support (l : support_leaf) :=
  [&& wellformed Q, decided_region,
      value_to (first_value l) * (lower r).2 <=? (lower r).1 * value_den (first_value l),
      reaches_end (first_value l) (further l) &
      all (fun pe => check_reason pe.1 pe.2) (leaf_places l)].

End Checker.

(* The places where there are solutions. *)
Definition holding_of (pe : place * reason) : option holding :=
  if pe.2 is Solved b then Some (Holding pe.1 (isSome (alone_by b))) else None.

Definition holdings (l : support_leaf) := pmap holding_of (leaf_places l).

Section Sound.

Variables (R : rcfType) (Q : pencil) (r : region).
Notation indices := (iota 0 (order Q)).

(* t is well described: the values at the ends of a place exist. *)
Definition is_place (pl : place) :=
  match pl with
  | PointAt v => exists s : R, is_value v s /\ forall t, in_place pl t <-> t = s
  | Between v v' => exists s s' : R,
      [/\ is_value v s, is_value v' s', s < s' & forall t, in_place pl t <-> s < t < s']
  | Above v => exists2 s : R, is_value v s & forall t, in_place pl t <-> s < t
  end.

Definition solution_in (t : R) x := solution Q t x /\ in_region (size (slip Q)) t (slip_of Q x) r.

Definition multiple_of (x x' : nat -> R) :=
  exists2 f, 0 < f & forall i, i \in indices -> x' i = f * x i.

(* What is said about a place with solutions. *)
Definition holds (h : holding) :=
  is_place (held_place h) /\
  forall t : R, in_place (held_place h) t ->
    (exists x, solution_in t x) /\
    (held_alone h -> forall x x', solution_in t x -> solution_in t x' -> multiple_of x x').

Lemma in_place_at v (s t : R) : check_value v -> is_value v s ->
  in_place (PointAt v) t <-> t = s.
Proof. by move=> ok is_s; split=> [/(value_unique ok is_s)|->]. Qed.

Lemma below_value v (s t : R) : check_value v -> is_value v s ->
  (forall u, is_value v u -> t < u) <-> t < s.
Proof. by move=> ok is_s; split=> [|ts u /(value_unique ok is_s)<-]; [apply|]. Qed.

Lemma above_value v (s t : R) : check_value v -> is_value v s ->
  (forall u, is_value v u -> u < t) <-> s < t.
Proof. by move=> ok is_s; split=> [|ts u /(value_unique ok is_s)<-]; [apply|]. Qed.

Hypothesis wf : wellformed Q.
Hypothesis decided : decided_region Q r.

Definition holds_sign (c : signed) (u : R) :=
  match c.1 with IsZero => u = 0 | IsPositive => 0 < u | IsNegative => u < 0 end.

Lemma negative_one (u : R) : toR (-1)%Z * u = - u.
Proof. by rewrite -[(-1)%Z]/(Z.opp 1) toRN toR1 mulN1r. Qed.

Lemma shows_sound pl g c (t : R) : place_checked pl -> in_place pl t -> shows pl g c ->
  holds_sign c (eval g t).
Proof.
rewrite /shows /holds_sign => ok at_t; case: c => -[] e /= shown.
- exact: zero_sound shown at_t.
- exact: positive_sound ok shown at_t.
by have := positive_sound ok shown at_t; rewrite eval_scale negative_one oppr_gt0.
Qed.

Lemma is_zeroE c u : is_zero c -> holds_sign c u -> u = 0.
Proof. by case: c => -[]. Qed.

Lemma is_positiveE c u : is_positive c -> holds_sign c u -> 0 < u.
Proof. by case: c => -[]. Qed.

Lemma is_negativeE c u : is_negative c -> holds_sign c u -> u < 0.
Proof. by case: c => -[]. Qed.

Lemma not_negativeE c u : ~~ is_negative c -> holds_sign c u -> 0 <= u.
Proof. by rewrite /holds_sign; case: c => -[] e //= _; [move=> -> | move/ltW]. Qed.

Lemma not_positiveE c u : ~~ is_positive c -> holds_sign c u -> u <= 0.
Proof. by rewrite /holds_sign; case: c => -[] e //= _; [move=> -> | move/ltW]. Qed.

(* Roles and positions. *)
Lemma role i : i \in indices -> is_free Q i \/ moves Q r i \/ rests Q r i.
Proof. by move/(allP decided); rewrite /is_active -orbA => /or3P[]; tauto. Qed.

Lemma slip_position i : i \in indices -> ~~ is_free Q i ->
  (index i (slip Q) < size (slip Q))%N /\ nth 0%N (slip Q) (index i (slip Q)) = i.
Proof.
move=> Hi nf; have : i \in slip Q by rewrite mem_filter Hi nf.
by move=> i_in; rewrite index_mem nth_index.
Qed.

Lemma moving_positive (x : nat -> R) i : agrees (size (slip Q)) r (slip_of Q x) -> i \in indices ->
  moves Q r i -> 0 < x i.
Proof.
move=> ag Hi /andP[nf mv]; have [lt_i eq_i] := slip_position Hi nf.
by have := ag _ lt_i; rewrite /slip_of eq_i; move: mv; case: (state_of r _).
Qed.

Lemma resting_zero (x : nat -> R) i : agrees (size (slip Q)) r (slip_of Q x) -> i \in indices ->
  rests Q r i -> x i = 0.
Proof.
move=> ag Hi /andP[nf mv]; have [lt_i eq_i] := slip_position Hi nf.
by have := ag _ lt_i; rewrite /slip_of eq_i; move: mv; case: (state_of r _).
Qed.

Lemma agrees_roles (x : nat -> R) :
  (forall i, i \in indices -> moves Q r i -> 0 < x i) ->
  (forall i, i \in indices -> rests Q r i -> x i = 0) -> agrees (size (slip Q)) r (slip_of Q x).
Proof.
move=> mv rs j lt_j; have i_in := mem_nth 0%N lt_j; have Hi := slip_indices i_in.
move: (mv _ Hi) (rs _ Hi); rewrite /moves /rests /slip_of index_uniq ?uniq_slip //.
have -> : is_free Q (nth 0%N (slip Q) j) = false.
  by move: i_in; rewrite mem_filter => /andP[/negbTE].
by case: (state_of r j) => //= [_ H|H _]; apply: H.
Qed.

Lemma solution_roles (t : R) x i : solution Q t x -> agrees (size (slip Q)) r (slip_of Q x) ->
  i \in indices ->
  (is_active Q r i -> reaction Q t x i = 0) /\ (rests Q r i -> 0 <= reaction Q t x i).
Proof.
case=> _ _ rows_f rows_s ag Hi; split=> [/orP[/rows_f//|mv]|/andP[nf _]].
  have xi := moving_positive ag Hi mv; case/andP: mv => nf _.
  have [|_ _ /eqP] := rows_s i; first by rewrite mem_filter nf.
  by rewrite mulf_eq0 (gt_eqF xi) => /eqP.
by have [|_ ->] := rows_s i; first by rewrite mem_filter nf.
Qed.

Section AtValue.

Variables (pl : place) (t : R).
Hypotheses (ok : place_checked pl) (at_t : in_place pl t).

Definition value_at (w : poly_vector) i : R := eval (component_of w i) t.

Lemma column_polyE w j : eval (column_poly Q w j) t =
  \sum_(i <- indices) value_at w i * (a_entry R Q i j + t * b_entry R Q i j).
Proof.
rewrite /column_poly; elim: indices => [|i l IH] /=; first by rewrite big_nil.
rewrite big_cons -IH /value_at; case e: (component_of w i) => [|c p].
  by rewrite /= mul0r add0r.
rewrite eval_add /times_entry eval_mul -e; congr (_ + _).
rewrite mulrC /a_entry /b_entry; congr (_ * _).
by rewrite /= mulr0 addr0.
Qed.

(* w'y = (w'T) x *)
Lemma weighted_reaction w (x : nat -> R) :
  \sum_(i <- indices) value_at w i * reaction Q t x i =
  \sum_(j <- indices) eval (column_poly Q w j) t * x j.
Proof.
rewrite /reaction.
under eq_bigr do rewrite mulr_sumr.
rewrite exchange_big; apply: eq_bigr => j _; rewrite column_polyE mulr_suml.
by apply: eq_bigr => i _; rewrite mulrA.
Qed.

Lemma refutation_sound f x : check_refutation Q r pl f -> ~ solution_in t x.
Proof.
case/and3P=> /allP weight_ok /allP column_ok some [sol [_ ag]].
have wy : 0 <= \sum_(i <- indices) value_at (row_weights f) i * reaction Q t x i.
  apply: sum_ge0 => i Hi; have [y0 y_ge0] := solution_roles sol ag Hi.
  have := weight_ok _ Hi; case: (role Hi) => [fr _|[mv _|rs]].
  - by rewrite y0 ?mulr0 // /is_active fr.
  - by rewrite y0 ?mulr0 // /is_active mv orbT.
  rewrite rs /= => /andP[sg shown]; rewrite mulr_ge0 // ?y_ge0 //.
  exact: not_negativeE sg (shows_sound ok at_t shown).
suff : \sum_(j <- indices) eval (column_poly Q (row_weights f) j) t * x j < 0.
  by rewrite -weighted_reaction ltNge wy.
have column j : j \in indices -> is_active Q r j ->
    [/\ ~~ is_positive (sign_at (column_signs f) j),
        ~~ is_free Q j || is_zero (sign_at (column_signs f) j) &
        holds_sign (sign_at (column_signs f) j) (eval (column_poly Q (row_weights f) j) t)].
  by move=> Hj act; have := column_ok _ Hj; rewrite act => /and3P[np fz /(shows_sound ok at_t)].
apply: sum_lt0 => [j Hj|].
  case: (role Hj) => [fr|[mv|/(resting_zero ag Hj)->]]; last by rewrite mulr0.
    have [|_ + sg] := column _ Hj; first by rewrite /is_active fr.
    by rewrite fr /= => /is_zeroE/(_ sg)->; rewrite mul0r.
  have [|np _ sg] := column _ Hj; first by rewrite /is_active mv orbT.
  by rewrite mulr_le0_ge0 ?(not_positiveE np sg) // ltW // (moving_positive ag Hj mv).
case/hasP: some => j Hj /andP[mv neg]; exists j => //.
have [|_ _ sg] := column _ Hj; first by rewrite /is_active mv orbT.
by rewrite pmulr_llt0 ?(moving_positive ag Hj mv) // (is_negativeE neg sg).
Qed.

Section Branch.

Variable b : branch.
Hypothesis branch_ok : check_branch Q r pl b.
Notation x := (value_at (branch_x b)).

Lemma row_polyE i : eval (row_poly Q (branch_x b) i) t = reaction Q t x i.
Proof. by case/and5P: branch_ok => cols _ _ _ _; apply: Claim.row_polyE. Qed.

Lemma branch_moving i : i \in indices -> moves Q r i -> 0 < x i.
Proof.
case/and5P: branch_ok => _ _ /allP mv _ _ Hi m; have := mv _ Hi.
by rewrite m => /andP[pos /(shows_sound ok at_t)]; apply: is_positiveE.
Qed.

Lemma branch_resting i : i \in indices -> rests Q r i -> x i = 0.
Proof.
case/and5P: branch_ok => _ _ _ /allP rs _ Hi m; have := rs _ Hi.
by rewrite m => /andP[zero /(shows_sound ok at_t)]; apply: is_zeroE.
Qed.

Lemma branch_agrees : agrees (size (slip Q)) r (slip_of Q x).
Proof. exact: agrees_roles branch_moving branch_resting. Qed.

Lemma branch_reaction i : i \in indices ->
  [/\ 0 <= reaction Q t x i, is_active Q r i -> reaction Q t x i = 0 &
      is_zero (sign_at (y_signs b) i) -> reaction Q t x i = 0].
Proof.
case/and5P: branch_ok => _ _ _ _ /allP ys Hi; rewrite -row_polyE.
have /and3P[nn act /(shows_sound ok at_t) sg] := ys _ Hi.
split; first exact: not_negativeE nn sg.
  by move=> a; apply: is_zeroE sg; move: act; rewrite a.
by move=> z; apply: is_zeroE z sg.
Qed.

Lemma branch_solution : 0 <= t -> solution Q t x.
Proof.
move=> t0; case/and5P: (branch_ok) => _ /hasP[k Hk mk] _ _ _; split=> //.
- by exists k => //; rewrite gt_eqF // branch_moving.
- move=> i fr; have [_ zero _] := branch_reaction (free_indices wf fr).
  by apply: zero; rewrite /is_active /is_free fr.
move=> i Hi; have Hi' := slip_indices Hi; have [y0 zero _] := branch_reaction Hi'.
case: (role Hi') => [fr|[mv|rs]].
- by move: Hi; rewrite mem_filter -/(is_free Q i) fr.
- by rewrite zero ?mulr0 ?lexx ?(ltW (branch_moving Hi' mv)) // /is_active mv orbT.
by rewrite (branch_resting Hi' rs) mul0r lexx.
Qed.

Variables (k : nat) (bounds : seq bound).
Hypotheses (alone : alone_by b = Some (k, bounds)) (alone_ok : check_alone Q r pl b).

Lemma pivot_ok : k \in indices /\ moves Q r k.
Proof.
by move: alone_ok; rewrite /check_alone alone => /and4P[mk lt_k _ _]; rewrite mem_iota.
Qed.

(* The sum (w'T) z over the two columns that are left. *)
Lemma two_columns (c z : nat -> R) j : j \in indices -> j != k ->
  (forall i, i \in indices -> i != j -> i != k -> c i * z i = 0) ->
  \sum_(i <- indices) c i * z i = c j * z j + c k * z k.
Proof.
move=> Hj jk zero; have [Hk _] := pivot_ok.
rewrite (bigD1_seq j) ?iota_uniq //=; congr (_ + _).
rewrite -big_filter (bigD1_seq k) ?filter_uniq ?iota_uniq //=; last first.
  by rewrite mem_filter eq_sym jk.
rewrite -[RHS]addr0; congr (_ + _); rewrite big_seq_cond big1 // => i.
by rewrite mem_filter => /andP[/andP[ij Hi] ik]; apply: zero.
Qed.

(* c (x_k z_j - x_j z_k) >= 0 *)
Lemma bound_sound o z : List.In o bounds -> bounded o != k -> solution_in t z ->
  0 <= eval (column_poly Q (row_weights (bound_signs o)) (bounded o)) t *
       (x k * z (bounded o) - x (bounded o) * z k).
Proof.
move=> o_in jk [sol [_ ag]]; set l := row_weights _; set j := bounded o.
have [Hk mk] := pivot_ok.
move: alone_ok; rewrite /check_alone alone => /and4P[_ _ bounds_ok _].
have := all_In bounds_ok o_in.
rewrite /check_bound -/j -/l => /and4P[act_j lt_j /allP rest_ok /allP columns_ok].
have Hj : j \in indices by rewrite mem_iota.
pose c i := eval (column_poly Q l i) t; rewrite -/(c j).
have zero u : (forall i, i \in indices -> rests Q r i -> u i = 0) ->
    forall i, i \in indices -> i != j -> i != k -> c i * u i = 0.
  move=> u0 i Hi ij ik; have := columns_ok _ Hi; rewrite (negbTE ij) (negbTE ik) /=.
  case: (role Hi) => [fr|[mv|/(u0 _ Hi)->]]; last by rewrite mulr0.
    by rewrite /is_active fr /= => /andP[z0 /(shows_sound ok at_t)/(is_zeroE z0)]; rewrite /c => ->;
       rewrite mul0r.
  by rewrite /is_active mv orbT /= => /andP[z0 /(shows_sound ok at_t)/(is_zeroE z0)];
     rewrite /c => ->; rewrite mul0r.
have eq_x : c j * x j + c k * x k = 0.
  rewrite -(two_columns Hj jk (zero x branch_resting)) -weighted_reaction.
  apply: sum_zero => i Hi; have [y0 act_y zero_y] := branch_reaction Hi.
  case: (role Hi) => [fr|[mv|rs]].
  - by rewrite act_y ?mulr0 // /is_active fr.
  - by rewrite act_y ?mulr0 // /is_active mv orbT.
  have := rest_ok _ Hi; rewrite rs /= => /and3P[_ /orP[z0|/zero_y->] shown].
    by rewrite /value_at (is_zeroE z0 (shows_sound ok at_t shown)) mul0r.
  by rewrite mulr0.
have ge_z : 0 <= c j * z j + c k * z k.
  rewrite -(two_columns Hj jk (zero z (fun i => @resting_zero z i ag))) -weighted_reaction.
  apply: sum_ge0 => i Hi; have [act_y ge_y] := solution_roles sol ag Hi.
  case: (role Hi) => [fr|[mv|rs]].
  - by rewrite act_y ?mulr0 // /is_active fr.
  - by rewrite act_y ?mulr0 // /is_active mv orbT.
  have := rest_ok _ Hi; rewrite rs /= => /and3P[nn _ shown].
  by rewrite mulr_ge0 ?ge_y // (not_negativeE nn (shows_sound ok at_t shown)).
have xk := branch_moving Hk mk.
have -> : c j * (x k * z j - x j * z k) =
          x k * (c j * z j + c k * z k) - z k * (c j * x j + c k * x k).
  by move: (c j) (c k) (x k) (x j) (z j) (z k) => *; ring.
by rewrite eq_x mulr0 subr0 mulr_ge0 // ltW.
Qed.

Lemma alone_sound z : solution_in t z -> multiple_of x z.
Proof.
move=> sol; have [_ [_ ag]] := sol; have [Hk mk] := pivot_ok.
have xk := branch_moving Hk mk; have zk := moving_positive ag Hk mk.
exists (z k / x k); first exact: divr_gt0.
suff same i : i \in indices -> x k * z i = x i * z k.
  move=> i Hi; apply: (mulfI (lt0r_neq0 xk)); rewrite same //.
  by rewrite [RHS]mulrA [x k * (_ / _)]mulrC divfK ?gt_eqF // mulrC.
move=> Hi; have [->|ik] := eqVneq i k; first by rewrite mulrC.
have [act|nact] := boolP (is_active Q r i); last first.
  have rs : rests Q r i.
    by have := role Hi; move: nact; rewrite /is_active negb_or => /andP[/negP ? /negP ?]; tauto.
  by rewrite (branch_resting Hi rs) (resting_zero ag Hi rs) mulr0 mul0r.
have := alone_ok; rewrite /check_alone alone => /and4P[_ _ bounds_ok /allP/(_ _ Hi)].
rewrite act (negbTE ik) /= => /andP[up down].
have own o : List.In o bounds -> bounded o = i ->
    holds_sign (own_sign o) (eval (column_poly Q (row_weights (bound_signs o)) i) t).
  move=> o_in eq_i; have := all_In bounds_ok o_in.
  case/and4P=> _ _ _ /allP/(_ _ Hi).
  by rewrite act (negbTE ik) /own_sign eq_i eqxx /= => /(shows_sound ok at_t).
have bound_i o : List.In o bounds -> bounded o = i -> bounded o != k by move=> _ ->.
have [o o_in /andP[/eqP eq_o pos]] := has_In up.
have [o' o'_in /andP[/eqP eq_o' neg]] := has_In down.
have le1 := bound_sound o_in (bound_i _ o_in eq_o) sol.
have le2 := bound_sound o'_in (bound_i _ o'_in eq_o') sol.
move: le1 le2; rewrite eq_o eq_o' pmulr_rge0 ?(is_positiveE pos (own _ o_in eq_o)) //.
rewrite nmulr_rge0 ?(is_negativeE neg (own _ o'_in eq_o')) // subr_ge0 subr_le0 => le1 le2.
by apply/eqP; rewrite eq_le le1 le2.
Qed.

End Branch.

End AtValue.

Lemma multiple_of_trans (x z z' : nat -> R) : multiple_of x z -> multiple_of x z' ->
  multiple_of z z'.
Proof.
case=> f f0 eq_z [f' f'0 eq_z']; exists (f' / f); first exact: divr_gt0.
by move=> i Hi; rewrite eq_z' // eq_z // mulrA divfK // gt_eqF.
Qed.

(* The point p/q is at most, at least, the value. *)
Lemma above_point (p q : Z) v (s : R) : 0 <= toR q :> R -> 0 < toR (value_den v) :> R ->
  (p * value_den v <= value_from v * q)%Z -> is_value v s -> toR p <= s * toR q.
Proof.
move=> q0 d0 le [as_ _ _]; rewrite -(ler_pmul2r d0) -toRM.
apply: (@le_trans _ _ (toR (value_from v * q)%Z)); first by rewrite toR_le; apply/Z.leb_spec0.
rewrite toRM [s * _]mulrC -mulrA mulrC [s * _]mulrC; exact: ler_wpmul2l.
Qed.

Lemma below_point (p q : Z) v (s : R) : 0 <= toR q :> R -> 0 < toR (value_den v) :> R ->
  (value_to v * q <= p * value_den v)%Z -> is_value v s -> s * toR q <= toR p.
Proof.
move=> q0 d0 le [_ sb _]; rewrite -(ler_pmul2r d0) -toRM.
apply: (@le_trans _ _ (toR (value_to v * q)%Z)); last by rewrite toR_le; apply/Z.leb_spec0.
rewrite toRM [s * _]mulrC -mulrA mulrC [s * _]mulrC; exact: ler_wpmul2r.
Qed.

Lemma before_sound v v' t (s : R) : 0 < toR (value_den v) :> R -> 0 < toR (value_den v') :> R ->
  (value_to v * value_den v' <? value_from v' * value_den v)%Z ->
  toR (value_den v) * t <= toR (value_to v) ->
  toR (value_from v') <= toR (value_den v') * s -> t < s.
Proof.
move=> d0 d0' lt tb as_; rewrite -(ltr_pmul2l (mulr_gt0 d0 d0')).
apply: (@le_lt_trans _ _ (toR (value_to v * value_den v')%Z)).
  by rewrite toRM mulrAC ler_pmul2r.
apply: (@lt_le_trans _ _ (toR (value_from v' * value_den v)%Z)); first by rewrite toR_lt.
by rewrite toRM [toR (value_den v) * _]mulrC mulrAC ler_pmul2r.
Qed.

Lemma ends_apart v v' (s s' : R) : check_value v -> check_value v' ->
  (value_to v * value_den v' <? value_from v' * value_den v)%Z ->
  is_value v s -> is_value v' s' -> s < s'.
Proof.
move=> ok ok' lt [_ sb _] [as' _ _].
have [_ _ d0 _] := value_parts R ok; have [_ _ d0' _] := value_parts R ok'.
exact: before_sound d0 d0' lt sb as'.
Qed.

Hypothesis O : ordered (lower r) (upper r).

Lemma inside_sound pl : place_checked pl -> inside r pl ->
  is_place pl /\ forall t : R, in_place pl t -> between t (lower r) (upper r).
Proof.
have [p0 q0 p0' q0'] := ordered_ge0 R O.
case: pl => [v|v v'|v] /=.
- move=> ok /andP[/Z.leb_spec0 lo /Z.leb_spec0 hi]; have [_ _ d0 _] := value_parts R ok.
  have [s is_s] := value_exists R ok; split.
    by exists s; split=> // t; apply: in_place_at.
  by move=> t at_t; split; [apply: above_point lo at_t | apply: below_point hi at_t].
- case/andP=> ok ok' /and3P[/Z.leb_spec0 lo /Z.leb_spec0 hi lt].
  have [_ _ d0 _] := value_parts R ok; have [_ _ d0' _] := value_parts R ok'.
  have [s is_s] := value_exists R ok; have [s' is_s'] := value_exists R ok'.
  split.
    exists s, s'; split=> //; first exact: ends_apart lt is_s is_s'.
    move=> t; rewrite (above_value t ok is_s) (below_value t ok' is_s').
    by split=> [[-> ->]|/andP[]].
  move=> t [/(_ _ is_s) st /(_ _ is_s') ts']; split.
    by apply: le_trans (above_point q0 d0 lo is_s) _; rewrite ler_wpmul2r // ltW.
  by apply: le_trans (below_point q0' d0' hi is_s'); rewrite ler_wpmul2r // ltW.
move=> ok /andP[/Z.leb_spec0 lo /Z.eqb_spec q'_eq]; have [_ _ d0 _] := value_parts R ok.
have [s is_s] := value_exists R ok; split.
  by exists s => // t; apply: above_value.
move=> t /(_ _ is_s) st; split; last by rewrite q'_eq toR0 mulr0.
by apply: le_trans (above_point q0 d0 lo is_s) _; rewrite ler_wpmul2r // ltW.
Qed.

Lemma reason_holds pl e h : check_reason Q r pl e -> holding_of (pl, e) = Some h -> holds h.
Proof.
case: e => // b /andP[ok /and3P[ins branch_ok alone_ok]] [<-].
have [is_pl bt] := inside_sound ok ins; split=> //= t at_t.
have sol x : solution_in t x ->
    isSome (alone_by b) -> multiple_of (value_at t (branch_x b)) x.
  move=> sol_x; case alone: (alone_by b) => [[k bounds]|] // _.
  exact: (alone_sound ok at_t branch_ok alone alone_ok sol_x).
split.
  exists (value_at t (branch_x b)); split.
    exact: (branch_solution ok at_t branch_ok (between_ge0 O (bt _ at_t))).
  by split; [apply: bt | apply: (branch_agrees ok at_t branch_ok)].
by move=> al x x' /sol/(_ al) mx /sol/(_ al); apply: multiple_of_trans.
Qed.

Lemma chain_covers v c (t s : R) :
  all (fun pe => check_reason Q r pe.1 pe.2) (chain_places v c) -> reaches_end r v c ->
  check_value v -> is_value v s -> s < t -> between t (lower r) (upper r) ->
  exists2 pe, List.In pe (chain_places v c) & in_place pe.1 t.
Proof.
elim: c v s => [|e|e v' e' c IH] v s /=.
- move=> _ /andP[q0 /Z.leb_spec0 hi] ok is_s st [_ tu].
  have [_ _ d0 _] := value_parts R ok; rewrite -(@toR_gt0 R) in q0.
  have := above_point (ltW q0) d0 hi is_s; rewrite leNgt => /negP[].
  by apply: lt_le_trans tu; rewrite ltr_pmul2r.
- move=> _ _ ok is_s st _; exists (Above v, e); first by left.
  exact/(above_value t ok is_s).
case/and3P=> /andP[/andP[ok ok'] _] _ others ends _ is_s st bt.
have [s' is_s'] := value_exists R ok'.
case: (ltrgtP t s') => [ts'|s't|->].
- exists (Between v v', e); first by left.
  by split; [apply/(above_value t ok is_s) | apply/(below_value t ok' is_s')].
- have [pe pe_in at_pe] := IH _ _ others ends ok' is_s' s't bt.
  by exists pe => //; right; right.
by exists (PointAt v', e') => //; right; left.
Qed.

End Sound.

Section Leaf.

Variables (R : rcfType) (Q : pencil) (r : region) (l : support_leaf).
Hypothesis O : ordered (lower r) (upper r).
Hypothesis checked : check_support Q r l.

Lemma in_holdings h : List.In h (holdings l) <->
  exists2 pe, List.In pe (leaf_places l) & holding_of pe = Some h.
Proof. exact: in_pmap. Qed.

Theorem support_covers (t : R) x : solution_in Q r t x ->
  exists2 h, List.In h (holdings l) & in_place (held_place h) t.
Proof.
move=> sol; have [_ [bt _]] := sol.
case/and5P: checked => wf dec /Z.leb_spec0 start ends reasons.
have ok : check_value (first_value l) by case/andP: reasons => /andP[].
have [p0 q0 _ _] := ordered_ge0 R O; have [_ _ d0 _] := value_parts R ok.
have [s is_s] := value_exists R ok.
have st : s <= t.
  case: bt => lo _; have := le_trans (below_point q0 d0 start is_s) lo.
  by case/and5P: O => _ + _ _ _; rewrite -(@toR_gt0 R) => q_gt0; rewrite ler_pmul2r.
have [pe pe_in at_pe] : exists2 pe, List.In pe (leaf_places l) & in_place pe.1 t.
  move: st; rewrite le_eqVlt => /orP[/eqP <-|st].
    by exists (PointAt (first_value l), first_reason l); first by left.
  have later : all (fun pe => check_reason Q r pe.1 pe.2)
                 (chain_places (first_value l) (further l)) by case/andP: reasons.
  have [pe pe_in at_pe] := chain_covers later ends ok is_s st bt.
  by exists pe => //; right.
have := all_In reasons pe_in; case: pe pe_in at_pe => pl [f|b] pe_in at_pl /andP[ok_pl /=].
  by move=> ref; case: (refutation_sound dec ok_pl at_pl ref sol).
move=> _; exists (Holding pl (isSome (alone_by b))) => //; apply/in_holdings.
by exists (pl, Solved b).
Qed.

Theorem support_holds h : List.In h (holdings l) -> holds R Q r h.
Proof.
case/in_holdings=> -[pl e] pe_in eq; case/and5P: checked => wf dec _ _ reasons.
have reason_ok : check_reason Q r pl e := all_In reasons pe_in.
exact: (reason_holds R wf dec O reason_ok eq).
Qed.

End Leaf.
