(* The integral problem means the same as the given one.

   The kernel computes with integers ([scaled], Rational.v).  Its entries are multiples of the given
   ones by one positive factor, and so are its tangents and normals; solutions stay, and so do the
   signs of rates and rows.

   Two problems are *equivalent* if they have the same solutions, with the same signs of rates and
   rows; what is said of the one then holds of the other ([equivalent_meaning]).  The vectors of one
   may have more components.

   Theorem [scaled_equivalent]: if the integral problem is wellformed, it has the solutions, the
   rates and the rows of the given problem, the latter up to positive factors.
   Theorem [scaled_meaning]: a statement that holds of the integral problem holds of the given one.

   Page: spec/certificates.md, 5.1. *)

From Mceip Require Import Base Integers Sums Tree Cover Bounded Condensation Pencil System Signs
  Support Families ZeroReaction ZeroPencil PlainMcp Points Rational Statement.

(* Degrees of freedom of particles. *)

Definition touches d p := (first_of p == d) || (second_of p == d).

Lemma in_dofs l d : (d \in dofs_of l) = has (touches d) l.
Proof.
rewrite /dofs_of mem_cat; elim: l => //= p l IH; rewrite !inE -IH ![d == _]eq_sym /touches.
by case: (first_of p == d); case: (second_of p == d); rewrite ?orbT.
Qed.

(* No degree of freedom of p is one of l. *)
Lemma dofs_cons p l d : uniq (dofs_of (p :: l)) ->
  uniq (dofs_of l) /\ (touches d p -> d \notin dofs_of l).
Proof.
have -> : uniq (dofs_of (p :: l)) = uniq (first_of p :: second_of p :: dofs_of l).
  apply: perm_uniq; rewrite /dofs_of /= perm_cons perm_sym.
  by rewrite -cat1s -[X in perm_eq _ X]/(_ ++ ([:: _] ++ _)) perm_catCA.
rewrite /= inE negb_or => /andP[/andP[_ out1] /andP[out2 u]]; split=> //.
by case/orP=> /eqP<-.
Qed.

Lemma dofs_apart (P P' : pred given_particle) l d : (forall p, P p -> P' p = false) ->
  uniq (dofs_of l) -> has (touches d) (filter P l) -> has (touches d) (filter P' l) = false.
Proof.
move=> apart; elim: l => //= p l IH /(dofs_cons d)[u out].
have sub (Q : pred given_particle) : has (touches d) (filter Q l) -> d \in dofs_of l.
  rewrite in_dofs; elim: {IH u out} l => //= q l IH.
  by case: (Q q) => /=; case: (touches d q) => //=.
case: (boolP (P p)) => Pp /=.
  rewrite apart //; case: (boolP (touches d p)) => [/out no _|_ /=]; last exact: IH.
  by apply/negbTE/negP => /sub; rewrite (negbTE no).
move=> has_l; have in_l := sub _ has_l; case: (P' p) => /=; last exact: IH.
by case: (boolP (touches d p)) => [/out|_ /=]; [rewrite in_l | exact: IH].
Qed.

Lemma held_kinds B d : (d \in held B) =
  [|| d \in dofs_of [seq p <- given_particles B | sticks p], d \in dofs_of (slipping B) |
      d \in dofs_of (with_zero B)].
Proof.
rewrite /held /slipping /with_zero !in_dofs; elim: (given_particles B) => //= p l.
move=> IH; rewrite /in_contact /sticks /slips /zeroes; case: (contact_of p) => [||sg|] /=;
  by rewrite ?IH; case: (touches d p) => /=; rewrite ?orbT.
Qed.

Lemma moving_scaled c B d : (d \in moving_with_zero (scaled_zero_system c B)) =
  [|| (d \in iota 0 (degrees B)) && (d \notin held B), d \in dofs_of (slipping B) |
      d \in dofs_of (with_zero B)].
Proof.
rewrite /moving_with_zero /moving_dofs /zero_dofs /first_dofs /second_dofs /= -!map_comp.
by rewrite !mem_cat mem_filter /held !mem_cat [_ && (d \in iota _ _)]andbC -!orbA.
Qed.

Lemma stick_scaled c B d : exact_system c B -> d \in iota 0 (degrees B) ->
  (d \notin moving_with_zero (scaled_zero_system c B)) =
  (d \in dofs_of [seq p <- given_particles B | sticks p]).
Proof.
case/and5P=> _ _ _ _ /andP[u _] d_in; rewrite moving_scaled d_in /= held_kinds.
case: (boolP (d \in dofs_of (filter _ _))) => [stuck|] /=; last first.
  by rewrite orNb.
rewrite in_dofs in stuck; rewrite ![d \in dofs_of _]in_dofs /slipping /with_zero.
have no_slip : has (touches d) [seq p <- given_particles B | slips p] = false.
  by apply: dofs_apart u stuck => p; rewrite /sticks /slips; case: (contact_of p).
have no_zero : has (touches d) [seq p <- given_particles B | zeroes p] = false.
  by apply: dofs_apart u stuck => p; rewrite /sticks /zeroes; case: (contact_of p).
by rewrite no_slip no_zero.
Qed.

Lemma system_slips s u : slip (pencil_of s u) = iota (free_number s) (size (particles s)).
Proof. exact: slip_iota. Qed.

Section Equivalence.

Variable R : rcfType.
Implicit Types (t mu : R) (v : nat -> R).

(* -s at a slip particle. *)
Definition slip_row s u t v j := - cone s (lambda2_of u t) (mu_of u t) v (particle s j).

(* Behind the slip particles, the rows of gap, right and left of each z particle. *)
Definition z_row z u t v i :=
  let s := without_zero z in
  let k := (i - size (particles s))%N in
  let p := zero_particle z (k %/ 3) in
  let w := force s (lambda2_of u t) v in
  let pressure := mu_of u t * along (normal p) p w in
  if (i < size (particles s))%N then slip_row s u t v i
  else nth 0 [:: - along (normal p) p w; along (tangent p) p w - pressure;
                 - along (tangent p) p w - pressure] (k %% 3).

Definition integral_semantics q : semantics R :=
  let numbers := slip (pencil_of_integral q) in
  match q with
  | PencilProblem Q =>
      Semantics numbers (solution Q) (proportional Q) (fun x j => x (nth 0%N numbers j))
        (fun t x j => reaction Q t x (nth 0%N numbers j)) None (eq Q) None
  | SystemProblem s u =>
      Semantics numbers (satisfies_9 s u) (same_motion s)
        (fun v j => variables_of s v (nth 0%N numbers j)) (slip_row s u)
        (if u is Lambda2 _ _ then if flat s then Some (conditions_9 s) else None else None)
        (eq (pencil_of s u)) None
  | ZeroProblem z u =>
      Semantics numbers (satisfies_9z z u) (same_motion (without_zero z))
        (fun v j => zero_variables_of z v (nth 0%N numbers j)) (z_row z u)
        (if u is Lambda2 _ _
         then if flat (without_zero z) then Some (conditions_9z z) else None else None)
        (eq (zero_pencil z u)) None
  | PlainProblem m =>
      Semantics [::] (fun _ _ => False) (fun _ _ => False) (fun _ _ => 0) (fun _ _ _ => 0) None
        (fun _ => False) (Some (solves_plain m))
  end.

Definition same_sign (x y : R) := exists2 f, 0 < f & y = f * x.

Lemma sign_scaled f x : 0 < f -> same_sign x (f * x).
Proof. by exists f. Qed.

Lemma sign_gt0 x y : same_sign x y -> (0 < x) = (0 < y).
Proof. by case=> f f0 ->; rewrite pmulr_rgt0. Qed.

Lemma sign_0 x y : same_sign x y -> x = 0 <-> y = 0.
Proof.
case=> f f0 ->; split=> [->|/eqP]; first by rewrite mulr0.
by rewrite mulf_eq0 gt_eqF //= => /eqP.
Qed.

Definition same_property T (P P' : option T) (same : T -> T -> Prop) :=
  match P, P' with Some p, Some p' => same p p' | None, None => True | _, _ => False end.

(* The solutions of P' are those of P, [lift] of them: P' may have more components, which P does not
   look at. *)
Record equivalent_by (lift : R -> (nat -> R) -> nat -> R) (P P' : semantics R) : Prop :=
  Equivalent {
  same_variables : variables P = variables P';
  solves_lifted : forall t v, solves P t v -> solves P' t (lift t v);
  solves_given : forall t v, solves P' t v -> solves P t v;
  rates_lifted : forall t v j, (j < size (variables P))%N -> rate P (lift t v) j = rate P v j;
  lifted_same : forall t v v', same P (lift t v) v' <-> same P v v';
  same_lifted : forall t v v', same P v' (lift t v) <-> same P v' v;
  same_multiples : forall t v v', solves P' t v -> solves P' t v' -> same P v v' <-> same P' v v';
  same_rates : forall v j, (j < size (variables P))%N -> same_sign (rate P v j) (rate P' v j);
  same_rows : forall t v j, solves P' t v -> (j < size (variables P))%N ->
    same_sign (row P t v j) (row P' t v j);
  same_moves : same_property (moves_at P) (moves_at P')
    (fun m m' => forall lambda2 mu v, m lambda2 mu v <-> m' lambda2 mu v);
  same_pencils : forall Q, has_pencil P' Q -> has_pencil P Q;
  same_points : same_property (solved_by P) (solved_by P')
    (fun s s' => forall z, s z <-> s' z) }.

Definition equivalent := equivalent_by (fun=> id).

Section Meaning.

Variables (lift : R -> (nat -> R) -> nat -> R) (P P' : semantics R).
Hypothesis E : equivalent_by lift P P'.

Lemma equivalent_region r t v : lies_in_region P r t v <-> lies_in_region P' r t v.
Proof.
rewrite /lies_in_region /in_region /agrees -(same_variables E).
split=> -[bt signs]; split=> // i lt_i; have := signs i lt_i; have sg := same_rates E v lt_i;
  case: (state_of r i) => //.
- by move/(sign_0 sg).
- by rewrite (sign_gt0 sg).
- by move/(sign_0 sg).
by rewrite (sign_gt0 sg).
Qed.

Lemma lifted_region r t v : lies_in_region P' r t (lift t v) <-> lies_in_region P r t v.
Proof.
apply: (iff_trans (iff_sym (equivalent_region r t (lift t v)))).
by split=> -[bt signs]; split=> // i lt_i; have := signs i lt_i; rewrite (rates_lifted E).
Qed.

Lemma equivalent_asserted lo hi a : asserted_holds P' lo hi a -> asserted_holds P lo hi a.
Proof.
case=> t [v [sol bt bt' signs]]; exists t, v; split=> //; first exact: (solves_given E).
move=> j lt_j; have := signs j; rewrite -(same_variables E) => /(_ lt_j)[pos zero bia free].
have sg := same_rates E v lt_j; have sg' := same_rows E sol lt_j.
split=> [/pos|/zero|out /(bia out)|out /(free out)].
- by rewrite (sign_gt0 sg).
- by move/(sign_0 sg).
- by move/(sign_0 sg').
by rewrite (sign_gt0 sg').
Qed.

(* [all_solutions_are], with one other beside the list. *)
Lemma solutions_are (S : semantics R) lo hi c : all_solutions_are S lo hi c <->
  all_listed (solves S) (same S) (lies_in_region S) lo hi (solutions_in c)
    (unlisted (lies_in_region S) (families_of_set c) (open_regions c)).
Proof.
split=> [[l [sz sols vals pairs] every]|[l [sz sols vals pairs every]]]; exists l;
  try by split.
  split=> // t v sol bt.
  by case: (every t v sol bt) => ?; [left | right; left | right; right].
move=> t v sol bt.
by case: (every t v sol bt) => [|[]] ?; [apply: Or31 | apply: Or32 | apply: Or33].
Qed.

Lemma equivalent_solutions lo hi c : all_solutions_are P' lo hi c -> all_solutions_are P lo hi c.
Proof.
move=> /solutions_are listed; apply/solutions_are.
apply: (listed_transfer (good := solves P') (f := id) _ _ _ _ _ listed) => //.
- by move=> t v _ /(solves_given E).
- by move=> r t v _ /equivalent_region.
- by move=> t v v' sol sol' /(same_multiples E sol sol').
move=> t v /(solves_lifted E) sol; exists (lift t v); split=> //.
  by move=> v' sol' /(same_multiples E sol' sol)/(same_lifted E).
case=> [[f f_in [reg at_t]]|[r r_in reg]]; [left | right].
  by exists f => //; split=> //; apply/lifted_region.
by exists r => //; apply/lifted_region.
Qed.

Lemma equivalent_family f : family_exists P' f -> family_exists P f.
Proof.
case=> is_pl each; split=> // t /each[[v [sol reg]] alone]; split.
  by exists v; split; [apply: (solves_given E) | apply/equivalent_region].
move=> al v1 v2 /(solves_lifted E) sol1 /lifted_region reg1.
move=> /(solves_lifted E) sol2 /lifted_region reg2.
apply/(lifted_same E t)/(same_lifted E t)/(same_multiples E sol1 sol2).
exact: (alone al).
Qed.

Lemma equivalent_meaning s : meaning_in P' s -> meaning_in P s.
Proof.
case: s => [lo hi l|lo hi c|c|from bound|from bound|//|//|points|//|//|//] /=.
- by move=> hold; apply: List.Forall_impl hold => a; apply: equivalent_asserted.
- by case=> all each; split=> [|f /each]; [apply: equivalent_solutions|apply: equivalent_family].
- by case=> Q [is_Q all each]; exists Q; split=> //; apply: (same_pencils E).
- have := same_moves E; case: (moves_at P) (moves_at P') => [m|] [m'|] //= iff absent mu t v bm t0.
  by move/iff; apply: absent.
- have := same_moves E; case: (moves_at P) (moves_at P') => [m|] [m'|] //= iff present mu bm.
  by have [t [v [t0 sat]]] := present mu bm; exists t, v; split=> //; apply/iff.
have := same_points E; case: (solved_by P) (solved_by P') => [m|] [m'|] //= iff [some each].
by split=> // z /each /iff.
Qed.

End Meaning.

(* Scaled numbers. *)

Lemma scaled_fraction m q : exact m q -> toR (scaled_entry m q) = toR m * fraction R q.
Proof.
case/andP=> q0 /Z.eqb_spec eq; have q0R : 0 < toR q.2 :> R by rewrite toR_gt0.
by rewrite /fraction mulrA -toRM -eq toRM mulrAC mulfV ?mul1r // gt_eqF.
Qed.

Lemma scaled_lookup m row j : all (fun e => exact m e.2) row ->
  toR (lookup (scaled_row m row) j) =
  toR m * \sum_(e <- row) (if e.1 == j then fraction R e.2 else 0).
Proof.
elim: row => [|e row IH] /=; first by rewrite big_nil mulr0 toR0.
case/andP=> /scaled_fraction ex /IH rest; rewrite big_cons mulrDr -rest.
by case: ifP => _; rewrite ?toRD ?ex // mulr0 add0r.
Qed.

Lemma scaled_matrix m rows i j : exact_rows m rows ->
  toR (lookup (nth [::] [seq scaled_row m row | row <- rows] i) j) =
  toR m * given_entry R rows i j.
Proof.
rewrite /given_entry; elim: rows i => [|row rows IH] [|i] /=;
  rewrite ?nth_nil ?big_nil ?mulr0 ?toR0 //.
  by case/andP=> ex _; apply: scaled_lookup.
by case/andP=> _; apply: IH.
Qed.

Lemma scaled_product m n a b t v i : exact_rows m a -> exact_rows m b ->
  \sum_(j <- iota 0 n)
    (toR (lookup (nth [::] [seq scaled_row m row | row <- a] i) j) +
     t * toR (lookup (nth [::] [seq scaled_row m row | row <- b] i) j)) * v j =
  toR m * product n a b t v i.
Proof.
move=> ex_a ex_b; rewrite /product mulr_sumr; apply: sum_eq => j _.
by rewrite !scaled_matrix //; move: (toR _) (given_entry _ _ _) => *; ring.
Qed.

(* Pencils. *)

Lemma pencil_equivalent Q c : exact_pencil c Q ->
  equivalent (pencil_semantics R Q) (integral_semantics (PencilProblem (scaled_pencil c Q))).
Proof.
move=> ex; have /and3P[m0 ex_a ex_b] := ex.
have m0R : 0 < toR (entry_scale c) :> R by rewrite toR_gt0.
have reactionE t x i : reaction (scaled_pencil c Q) t x i =
    toR (entry_scale c) * product (given_order Q) (given_a Q) (given_b Q) t x i.
  exact: scaled_product.
split=> //=.
- move=> t x [t0 [nonzero rows_f rows_s]]; split=> // i i_in.
    by rewrite reactionE rows_f // mulr0.
  by rewrite reactionE; apply/(complementary_scaled _ _ m0R)/rows_s.
- move=> t x [t0 nonzero rows_f rows_s]; do 2!split=> //; move=> i i_in.
    have /eqP := rows_f i i_in; rewrite reactionE mulf_eq0 gt_eqF //= => /eqP.
    by [].
  by have := rows_s i i_in; rewrite reactionE => /(complementary_scaled _ _ m0R).
- by move=> v j _; exists 1; rewrite ?ltr01 // mul1r.
- by move=> t v j _ _; exists (toR (entry_scale c)).
by move=> _ <-; exists c; rewrite /= ex.
Qed.

(* Systems. *)

Section System.

Variables (B : rational_system) (u : unknown) (c : scales).
Hypothesis ex : exact_system c B.

Notation s := (scaled_system c B).
Notation z := (scaled_zero_system c B).
Notation C := (toR (entry_scale c) : R).
Notation L := (toR (length_scale c) : R).
Notation nobody := (GivenParticle 0 0 NotInContact ((0, 1), (0, 1)) ((0, 1), (0, 1)) 0 (0, 1))%Z.

Lemma scales_gt0 : 0 < C /\ 0 < L.
Proof. by case/and5P: ex => m0 l0 _ _ _; rewrite !toR_gt0. Qed.

Lemma force_scaled lambda2 v d : force s lambda2 v d = C * force_of B lambda2 v d.
Proof. by case/and5P: ex => _ _ ex_k ex_m _; apply: scaled_product. Qed.

Lemma slip_scaled j : (j < size (slipping B))%N ->
  particle s j = scaled_particle c (slip_at B j) /\ exact_particle c (slip_at B j).
Proof.
move=> lt_j; split; first by rewrite /particle (nth_map nobody).
case/and5P: ex => _ _ _ _ /and3P[_ /(all_nthP nobody) all_s _]; exact: all_s.
Qed.

Lemma zero_scaled j : (j < size (with_zero B))%N ->
  zero_particle z j = scaled_particle c (zero_at B j) /\ exact_particle c (zero_at B j).
Proof.
move=> lt_j; split; first by rewrite /zero_particle (nth_map nobody).
case/and5P: ex => _ _ _ _ /and3P[_ _ /(all_nthP nobody) all_z]; exact: all_z.
Qed.

Section Particle.

Variable p : given_particle.
Hypothesis ex_p : exact_particle c p.

Notation k := (scaled_particle c p).

Lemma factor_gt0 : 0 < fraction R (factor_of p).
Proof.
by case/and5P: ex_p => _ _ f0 d0 _; rewrite divr_gt0 // toR_gt0.
Qed.

Lemma tangent_scaled f : along (tangent k) k f = L * tangential p f.
Proof.
case/and5P: ex_p => /andP[ex1 ex2] _ _ _ _.
by rewrite /along /= !scaled_fraction // /tangential mulrDr !mulrA.
Qed.

Lemma normal_scaled f : along (normal k) k f =
  L * fraction R (factor_of p) * normal_to p f.
Proof.
case/and5P: ex_p => _ /andP[ex1 ex2] _ d0 /and4P[n1 n2 _ _].
rewrite /along /= !scaled_fraction // /normal_to /fraction /= !toRM.
have nz d : (0 <? d)%Z -> toR d != 0 :> R by move=> pos; rewrite gt_eqF // toR_gt0.
move: (nz _ d0) (nz _ n1) (nz _ n2); move: (f _) (f _); do 7 move: (toR _) => ?.
by move=> *; field; apply/and3P; split.
Qed.

(* (1 + c^2 mu^2) g *)
Lemma turning_scaled mu : turning_at s mu k =
  C * ((1 + (fraction R (factor_of p) * mu) ^+ 2) * fraction R (geometric_of p)).
Proof.
case/and5P: ex_p => _ _ _ d0 /and4P[_ _ /Z.eqb_spec/(congr1 (@toR R)) unit_normal ex_g].
have [_ /lt0r_neq0 L0] := scales_gt0.
have {}d0 : toR (factor_of p).2 != 0 :> R by rewrite gt_eqF // toR_gt0.
rewrite /turning_at (scaled_fraction ex_g); move: unit_normal.
rewrite /normal_of_length -[normal k]/(scaled_planar c (long_normal p)).
move: (inner _ _) => nn; rewrite !toRM /fraction => unit_normal.
have -> : toR nn = L ^+ 2 * (toR (factor_of p).1 / toR (factor_of p).2) ^+ 2.
  apply: (mulIf (mulf_neq0 d0 d0)); rewrite [LHS]unit_normal.
  by field.
rewrite -[unit_length s]/(length_scale c); move: (toR _ / toR (geometric_of p).2) => g.
by field; rewrite d0 L0.
Qed.

End Particle.

Lemma flat_cone lambda2 mu v j : flat_body B -> (j < size (slipping B))%N ->
  let p := slip_at B j in let w := force_of B lambda2 v in cone_of B lambda2 mu v p =
  toR (sign p) * tangential p w + fraction R (factor_of p) * mu * normal_to p w.
Proof.
move=> /(all_nthP nobody) flat_each /flat_each/Z.eqb_spec flat_p p w.
by rewrite /cone_of [fraction R (geometric_of _)]/fraction flat_p toR0 !mul0r mulr0 mul0r addr0.
Qed.

Lemma flat_scaled : flat s = flat_body B.
Proof.
rewrite /flat /flat_body all_map; case/and5P: ex => c0 _ _ _ /and3P[_ + _].
elim: (slipping B) => //= p l IH /andP[ex_p /IH->]; congr (_ && _).
have /and5P[_ _ _ _ /and4P[_ _ _ /andP[d0 /Z.eqb_spec eq]]] := ex_p.
by apply/Z.eqb_spec/Z.eqb_spec; move: c0 d0 eq; clear; nia.
Qed.

(* The conditions (9). *)

Lemma slip_rate_scaled v p : exact_particle c p ->
  slip_rate v (scaled_particle c p) = L * (toR (sign p) * tangential p v).
Proof. by move=> ex_p; rewrite /slip_rate tangent_scaled // mulrCA. Qed.

Lemma cone_scaled lambda2 mu v p : exact_particle c p ->
  cone s lambda2 mu v (scaled_particle c p) = C * L * cone_of B lambda2 mu v p.
Proof.
move=> ex_p; rewrite /cone turning_scaled // slip_rate_scaled // tangent_scaled //.
rewrite normal_scaled // /cone_of; move: (toR (sign p) * tangential p v) => slide.
rewrite /tangential /normal_to !force_scaled /=.
by ring.
Qed.

Lemma normal_force_scaled lambda2 v p : exact_particle c p ->
  along (normal (scaled_particle c p)) (scaled_particle c p) (force s lambda2 v) =
  L * fraction R (factor_of p) * (C * normal_to p (force_of B lambda2 v)).
Proof.
move=> ex_p; rewrite normal_scaled // /normal_to !force_scaled.
by ring.
Qed.

Lemma tangent_force_scaled lambda2 v p : exact_particle c p ->
  along (tangent (scaled_particle c p)) (scaled_particle c p) (force s lambda2 v) =
  L * (C * tangential p (force_of B lambda2 v)).
Proof.
move=> ex_p; rewrite tangent_scaled // /tangential !force_scaled.
by ring.
Qed.

(* Rates of lengths l and f l, forces of lengths a l and a f l. *)
Lemma zero_reaction_scaled (l f a mu v_N v_T w_N w_T : R) : 0 < l -> 0 < f -> 0 < a ->
  zero_reaction mu (l * f * v_N) (l * v_T) (l * f * (a * w_N)) (l * (a * w_T)) <->
  zero_reaction (f * mu) v_N v_T w_N w_T.
Proof.
move=> l0 f0 a0; have lf0 := mulr_gt0 l0 f0; have la0 := mulr_gt0 l0 a0.
have cancel b : 0 < b -> forall x y : R, x = b * y -> x = 0 <-> y = 0.
  move=> b0 x y ->; split=> [/eqP|->]; last by rewrite mulr0.
  by rewrite mulf_eq0 gt_eqF //= => /eqP.
have product : v_N * w_N = 0 <-> l * f * v_N * (l * f * (a * w_N)) = 0.
  by symmetry; apply: (cancel _ (mulr_gt0 (mulr_gt0 lf0 lf0) a0)); ring.
have coneE : `|l * (a * w_T)| + mu * (l * f * (a * w_N)) = l * a * (`|w_T| + f * mu * w_N).
  by rewrite !normrM (gtr0_norm l0) (gtr0_norm a0); move: `|w_T| => b; ring.
have slideE : `|l * v_T| * (l * (a * w_T)) - mu * (l * v_T) * (l * f * (a * w_N)) =
    l * l * a * (`|v_T| * w_T - f * mu * v_T * w_N).
  by rewrite normrM (gtr0_norm l0); move: `|v_T| => b; ring.
have slide : `|v_T| * w_T = f * mu * v_T * w_N <->
    `|l * v_T| * (l * (a * w_T)) = mu * (l * v_T) * (l * f * (a * w_N)).
  have zero_diff (x y : R) : x = y <-> x - y = 0.
    by split=> [->|/eqP]; [rewrite subrr | rewrite subr_eq0 => /eqP].
  apply: (iff_trans (zero_diff _ _)); apply: iff_sym; apply: (iff_trans (zero_diff _ _)).
  exact: (cancel _ (mulr_gt0 (mulr_gt0 l0 l0) a0)) slideE.
rewrite /zero_reaction coneE !(pmulr_rle0 _ lf0) (pmulr_rle0 _ a0) (pmulr_rle0 _ la0).
by split=> -[vN wN /product vw cone /slide slip]; split.
Qed.

Lemma conditions_scaled lambda2 mu v :
  motion_conditions B lambda2 mu v <-> conditions_9z z lambda2 mu v.
Proof.
have [C0 L0] := scales_gt0.
have force0 d : force s lambda2 v d = 0 <-> force_of B lambda2 v d = 0.
  rewrite force_scaled; split=> [/eqP|->]; last by rewrite mulr0.
  by rewrite mulf_eq0 gt_eqF //= => /eqP.
have slip j : (j < size (slipping B))%N -> let k := particle s j in let p := slip_at B j in
    [/\ along (normal k) k v = 0, slip_rate v k <= 0, cone s lambda2 mu v k <= 0 &
        cone s lambda2 mu v k * slip_rate v k = 0] <->
    [/\ normal_to p v = 0, toR (sign p) * tangential p v <= 0, cone_of B lambda2 mu v p <= 0 &
        cone_of B lambda2 mu v p * (toR (sign p) * tangential p v) = 0].
  move=> lt_j k p; have [eq_k ex_p] := slip_scaled lt_j; rewrite /k eq_k -/p.
  have LF0 := mulr_gt0 L0 (factor_gt0 ex_p); have CL0 := mulr_gt0 C0 L0.
  rewrite slip_rate_scaled // cone_scaled // normal_scaled //.
  rewrite (pmulr_rle0 _ L0) (pmulr_rle0 _ CL0).
  have zero b : 0 < b -> forall x : R, b * x = 0 <-> x = 0.
    move=> b0 x; split=> [/eqP|->]; last by rewrite mulr0.
    by rewrite mulf_eq0 gt_eqF //= => /eqP.
  have prod : C * L * cone_of B lambda2 mu v p * (L * (toR (sign p) * tangential p v)) = 0 <->
      cone_of B lambda2 mu v p * (toR (sign p) * tangential p v) = 0.
    by rewrite mulrACA; apply: zero (mulr_gt0 CL0 L0) _.
  by split=> -[/(zero _ LF0) n r k_le /prod pr]; split.
have zero j : (j < size (with_zero B))%N -> let k := zero_particle z j in let p := zero_at B j in
    let w := force s lambda2 v in
    zero_reaction mu (along (normal k) k v) (along (tangent k) k v)
      (along (normal k) k w) (along (tangent k) k w) <->
    zero_reaction (fraction R (factor_of p) * mu) (normal_to p v) (tangential p v)
      (normal_to p (force_of B lambda2 v)) (tangential p (force_of B lambda2 v)).
  move=> lt_j k p w; have [eq_k ex_p] := zero_scaled lt_j; rewrite /k eq_k -/p /w.
  rewrite normal_force_scaled // tangent_force_scaled // normal_scaled // tangent_scaled //.
  exact: zero_reaction_scaled (factor_gt0 ex_p) C0.
split=> -[nonzero rest free slips zeros]; split=> //=.
- by move=> d d_in; rewrite (stick_scaled ex) //; apply: rest.
- move=> d; rewrite mem_filter => /andP[out d_in]; apply/force0.
  exact: free.
- by move=> j; rewrite size_map => lt_j; apply/(slip j lt_j); apply: slips.
- by move=> j; rewrite size_map => lt_j; apply/(zero j lt_j); apply: zeros.
- by move=> d d_in stuck; apply: rest => //; rewrite (stick_scaled ex).
- by move=> d d_in out; apply/force0/free; rewrite mem_filter out.
- by move=> j lt_j; apply/(slip j lt_j); apply: slips; rewrite size_map.
by move=> j lt_j; apply/(zero j lt_j); apply: zeros; rewrite size_map.
Qed.

Lemma numbers_scaled : slip (zero_pencil z u) = complementarity (GivenSystem B u).
Proof. by rewrite zero_slips /slip_number /free_number /= size_filter !size_map. Qed.

Lemma slip_rate_same v j : system_wellformed s u -> (j < size (slipping B))%N ->
  same_sign (rate_of B v j) (variables_of s v (free_number s + j)%N).
Proof.
move=> wf lt_j; have [_ L0] := scales_gt0; have [eq_k ex_p] := slip_scaled lt_j.
rewrite /variables_of ltnNge leq_addr /= addKn eq_k slip_rate_scaled // /rate_of lt_j.
exists L^-1; first by rewrite invr_gt0.
by field; rewrite gt_eqF.
Qed.

Lemma slip_row_same t v j : (j < size (slipping B))%N ->
  same_sign (row_of B u t v j) (slip_row s u t v j).
Proof.
move=> lt_j; have [C0 L0] := scales_gt0; have [eq_k ex_p] := slip_scaled lt_j.
rewrite /slip_row eq_k cone_scaled // /row_of lt_j -mulrN.
by apply: sign_scaled; apply: mulr_gt0.
Qed.

(* The variables gap, right and left of the z particle q. *)
Lemma zero_number j : (size (slipping B) <= j)%N ->
  (free_number s + j = gap z ((j - size (slipping B)) %/ 3) + (j - size (slipping B)) %% 3)%N.
Proof.
move=> ge_j; rewrite /gap /= size_map -addnA -addnA [(3 * _)%N]mulnC -divn_eq.
by rewrite subnKC.
Qed.

Lemma zero_rate_same v j : zero_wellformed z u ->
  (j < size (slipping B) + 3 * size (with_zero B))%N ->
  same_sign (rate_of B v j) (zero_variables_of z v (free_number s + j)%N).
Proof.
move=> wf lt_j; have [_ L0] := scales_gt0.
have [lt_s|ge_s] := ltnP j (size (slipping B)).
  rewrite /zero_variables_of ltn_add2l size_map lt_s.
  by apply: slip_rate_same => //; case/and4P: wf.
rewrite zero_number // /rate_of ltnNge ge_s /=; set q := (_ %/ 3)%N.
have lt_q : (q < size (with_zero B))%N by rewrite /q ltn_divLR // mulnC ltn_subLR.
have lt_z : (q < size (zero_particles z))%N by rewrite size_map.
have [eq_k ex_p] := zero_scaled lt_q; have F0 := factor_gt0 ex_p.
have [gapE rightE leftE] := variables_at v lt_z.
have [f f0 normalE] := along_normal wf v lt_z.
have slideE : along (tangent (zero_particle z q)) (zero_particle z q) v / L ^+ 2 =
    L^-1 * tangential (zero_at B q) v.
  by rewrite eq_k tangent_scaled //; field; rewrite gt_eqF.
have Li0 : 0 < L^-1 by rewrite invr_gt0.
have : (((j - size (slipping B)) %% 3) < 3)%N by rewrite ltn_mod.
case: (_ %% 3)%N => [|[|[|]]] // _ /=.
- rewrite addn0 gapE; rewrite {1 2}eq_k normal_scaled // in normalE.
  exists (L * fraction R (factor_of (zero_at B q)) / (f * L ^+ 2)).
    by apply: divr_gt0; apply: mulr_gt0 => //; apply: exprn_gt0.
  apply: (mulfI (lt0r_neq0 f0)); rewrite mulrN mulrA -normalE.
  rewrite -[unit_length _]/(length_scale c).
  by field; apply/andP; rewrite !gt_eqF.
- rewrite addn1 -[(gap z q).+1]/(right z q) rightE slideE pmulr_rgt0 //.
  by exists L^-1 => //; case: ifP; rewrite ?mulr0.
rewrite addn2 -[(gap z q).+2]/(left z q) leftE slideE pmulr_rlt0 // -mulrN.
by exists L^-1 => //; case: ifP; rewrite ?mulr0.
Qed.

Lemma friction_scaled t : friction_at u t = mu_of u t :> R.
Proof. by rewrite /friction_at /mu_of; case: (u). Qed.

Lemma zero_row_same t v j : (j < size (slipping B) + 3 * size (with_zero B))%N ->
  same_sign (row_of B u t v j) (z_row z u t v j).
Proof.
move=> lt_j; have [C0 L0] := scales_gt0.
rewrite /z_row size_map; have [lt_s|ge_s] := ltnP j (size (slipping B)).
  exact: slip_row_same.
rewrite /row_of ltnNge ge_s /=; set q := (_ %/ 3)%N.
have lt_q : (q < size (with_zero B))%N by rewrite /q ltn_divLR // mulnC ltn_subLR.
have [eq_k ex_p] := zero_scaled lt_q; have F0 := factor_gt0 ex_p.
rewrite eq_k normal_force_scaled // tangent_force_scaled //.
rewrite -[lambda2_of u t]/(lambda2_at u t) -friction_scaled.
have : (((j - size (slipping B)) %% 3) < 3)%N by rewrite ltn_mod.
case: (_ %% 3)%N => [|[|[|]]] // _ /=.
- exists (L * fraction R (factor_of (zero_at B q)) * C); first by do 2?apply: mulr_gt0.
  by ring.
- by exists (L * C); [apply: mulr_gt0 | ring].
by exists (L * C); [apply: mulr_gt0 | ring].
Qed.

Lemma solves_scaled t v : system_solves B u t v <-> satisfies_9z z u t v.
Proof.
rewrite /system_solves /satisfies_9z friction_scaled.
by split=> -[t0 /conditions_scaled sat].
Qed.

Lemma zero_equivalent : zero_wellformed z u -> ~~ nilp (with_zero B) ->
  equivalent (system_semantics R B u) (integral_semantics (ZeroProblem z u)).
Proof.
move=> wf some; split=> //=; rewrite ?numbers_scaled //.
- by move=> t v /solves_scaled.
- by move=> t v /solves_scaled.
- move=> v j; rewrite size_iota => lt_j; rewrite nth_iota // -size_filter.
  exact: zero_rate_same.
- by move=> t v j _; rewrite size_iota => lt_j; apply: zero_row_same.
- rewrite /same_property flat_scaled; case: (u) => // *; case: (flat_body B) => // *.
  exact: conditions_scaled.
by move=> Q <-; exists c, (ZeroProblem z u); rewrite ex (negbTE some).
Qed.

Hypothesis no_zero : with_zero B = [::].

Lemma without_zero_scaled : z = ZeroSystem s [::].
Proof. by rewrite /scaled_zero_system no_zero. Qed.

Lemma system_numbers : slip (pencil_of s u) = complementarity (GivenSystem B u).
Proof.
by rewrite system_slips /free_number /complementarity no_zero /= size_filter size_map muln0 addn0.
Qed.

Lemma system_equivalent : system_wellformed s u ->
  equivalent (system_semantics R B u) (integral_semantics (SystemProblem s u)).
Proof.
move=> wf; split=> //=; rewrite ?system_numbers /complementarity ?no_zero ?muln0 ?addn0 //.
- move=> t v /solves_scaled; rewrite /satisfies_9z without_zero_scaled => -[t0].
  by move=> /no_zero_particles sat; apply/satisfies_9E.
- move=> t v /satisfies_9E[t0 sat]; apply/solves_scaled; rewrite /satisfies_9z without_zero_scaled.
  by split=> //; apply/no_zero_particles.
- move=> v j; rewrite size_iota => lt_j; rewrite nth_iota // -size_filter.
  exact: slip_rate_same.
- by move=> t v j _; rewrite size_iota => lt_j; apply: slip_row_same.
- rewrite /same_property flat_scaled; case: (u) => // _ _; case: (flat_body B) => // lambda2 mu v.
  rewrite conditions_scaled without_zero_scaled; exact: no_zero_particles.
by move=> Q <-; exists c, (SystemProblem s u); rewrite ex.
Qed.

End System.

(* Plain problems. *)

Lemma plain_equivalent rows c : (0 <? entry_scale c)%Z -> all (exact_mcp_row c) rows ->
  equivalent (semantics_of R (GivenPlain rows))
    (integral_semantics (PlainProblem [seq scaled_mcp_row c r | r <- rows])).
Proof.
move=> m0 ex; split=> //= z.
have m0R : 0 < toR (entry_scale c) :> R by rewrite toR_gt0.
have exact_m : exact_rows (entry_scale c) [seq given_m r | r <- rows].
  by rewrite /exact_rows all_map; apply: sub_all ex => r /andP[].
suff iff i : (i < size rows)%N -> let none := RationalMcpRow [::] (0, 1)%Z None None in
    plain_function [seq scaled_mcp_row c r | r <- rows] z i =
    toR (entry_scale c) * (\sum_(j <- iota 0 (size rows))
      given_entry R [seq given_m r | r <- rows] i j * z j + fraction R (given_q (nth none rows i))).
  have rowE i : (i < size rows)%N -> mcp_row_at [seq scaled_mcp_row c r | r <- rows] i =
      scaled_mcp_row c (nth (RationalMcpRow [::] (0, 1)%Z None None) rows i).
    by move=> lt_i; rewrite /mcp_row_at (nth_map (RationalMcpRow [::] (0, 1)%Z None None)).
  split=> sol i lt_i.
    rewrite size_map in lt_i; have [a b up low] := sol i lt_i.
    by rewrite /= iff // rowE // pmulr_rge0 // pmulr_rle0.
  have := sol i; rewrite size_map => /(_ lt_i); rewrite /= iff // rowE // pmulr_rge0 //.
  by rewrite pmulr_rle0.
move=> lt_i none; rewrite /plain_function size_map mulrDr mulr_sumr; congr (_ + _).
  apply: sum_eq => j _; rewrite mulrA -scaled_matrix // -map_comp.
  congr (toR (lookup _ _) * _).
  by rewrite /mcp_row_at !(nth_map none).
rewrite /mcp_row_at (nth_map none) //= scaled_fraction //.
by have /(all_nthP none)/(_ _ lt_i)/andP[] := ex.
Qed.

End Equivalence.

Definition integral_wellformed q :=
  match q with
  | SystemProblem s u => system_wellformed s u
  | ZeroProblem z u => zero_wellformed z u
  | _ => true
  end.

Theorem scaled_equivalent (R : rcfType) c p q : scaled c p = Some q -> integral_wellformed q ->
  equivalent (semantics_of R p) (integral_semantics R q).
Proof.
case: p => [Q|//|//|B u|//|rows|//] /=; case: ifP => // ex [<-].
- by move=> _; apply: pencil_equivalent.
- case: ifP => [/nilP none|some] wf; first exact: system_equivalent.
  by apply: zero_equivalent; rewrite ?some.
by case/andP: ex => m0 ex _; apply: plain_equivalent.
Qed.

Theorem scaled_meaning (R : rcfType) c p q s : scaled c p = Some q -> integral_wellformed q ->
  meaning_in (integral_semantics R q) s -> meaning R p s.
Proof.
move=> is_q wf holds; have : meaning_in (semantics_of R p) s.
  by apply: equivalent_meaning holds; apply: scaled_equivalent is_q wf.
by case: p is_q => [Q|//|//|B u|B radii|rows|B] //; case: s {holds}.
Qed.
