(* From stiffness, mass, contact states and signs to a pencil.

   A mechanical system has [dofs] degrees of freedom, sparse rows of K and M (multiplied by one
   positive integer each), a list of free degrees of freedom, and slip particles.  A slip particle
   has two degrees of freedom, the unit tangent t_p and the normal n_p as vectors over these two
   (frame and normal direction applied), and the sign S_p of the tangential reaction.  The length of
   n_p is the friction factor of the particle: n_p is c_p times the unit normal, so that mu n_p'w is
   c_p mu times the rate of the normal reaction.  All tangents and normals are multiplied by one
   positive integer, [unit_length], so that they are integer vectors.  All other degrees of freedom
   do not move: those of particles that stick.  The obstacle may be curved at a slip particle: then
   it has a geometric stiffness g_p, curvature times normal reaction, in the unit of K; g_p = 0 on a
   flat obstacle.

   [conditions_9] are the conditions (9) for such a system, for values of lambda^2 and mu:

       w = (K + lambda^2 M) v,    v != 0,    w_f = 0,    v = 0 at what does not move,

   and for each slip particle

       n'v = 0,    S t'v <= 0,    s <= 0,    s S t'v = 0,
       s = S t'w + mu n'w + (1 + c^2 mu^2) g S t'v.

   The unknown is mu with lambda = 0, where all obstacles are flat, or lambda^2 with mu given as a
   fraction.

   Theorem [system_pencil]: x solves the pencil that is computed here if and only if the motion
   v(x) = sum_f x_d e_d - sum_p S_p x_p t_p of (10), times unit_length,
   satisfies (9).
   [system_onto]: every motion that satisfies (9) is v(x) for some x.

   Theorem [system_complete]: the main theorem for mechanical systems.  If the check succeeds, each
   motion with (9) and its value in the window lies in a region yielded or left undecided, and each
   region yielded has exactly one, up to a positive factor.  [system_none]: none.  [system_number],
   [system_exactly]: how many there are, as in Complete.v.

   [system_claim]: an exact solution claim about the pencil gives a motion with (9) and with the
   support and the biactive variables of the claim ([has_support]).  [system_enclosed]: the same for
   an enclosed claim, without biactive variables.

   The rows of the pencil are linear forms of the motion ([system_forms]), put into its variables by
   a table ([table_row]).  They are in the order of spec/certificates.md: free degrees of freedom,
   then slip particles.  Particles in contact with zero reaction: ZeroReaction.v.

   Pages: spec/certificates.md, 5.1; spec/reduction.md; spec/curvature.md.
   Rust: crates/check/src/pencil.rs. *)

From Mceip Require Import Base Integers Sums Tree Enclosed Covered Definite Root RootLeaf Cover
  Places Number Condensation Pencil Whole Claim EnclosedClaim Complete.

(* A vector over the two degrees of freedom of a particle. *)
Definition planar := (Z * Z)%type.

(* The tangent has the length [unit_length], the normal this times the friction factor. *)
Record slip_particle := SlipParticle {
  first_dof : nat;
  second_dof : nat;
  tangent : planar;
  normal : planar;
  sign_of : Z;
  geometric_stiffness : Z }.

Record system := System {
  dofs : nat;
  stiffness : seq sparse_row;
  mass : seq sparse_row;
  free_dofs : seq nat;
  particles : seq slip_particle;
  unit_length : Z }.

(* The rows a and b of the linear form (a + t b)'v. *)
Definition linear_form := (sparse_row * sparse_row)%type.

Notation no_form := ([::], [::]).

(* Mu: the unknown is mu.  Lambda2 p q: the unknown is lambda^2, and mu = p/q. *)
Inductive unknown := Mu | Lambda2 of Z & Z.

(* A row of K or M as a row of the pencil: the table has for each degree of freedom the columns to
   which it belongs, and the factors it gets. *)
Definition table_row (table : seq sparse_row) (row : sparse_row) : sparse_row :=
  flatten [seq [seq (c.1, (c.2 * e.2)%Z) | c <- nth [::] table e.1] | e <- row].

Definition pencil_of_forms table order (forms : seq linear_form) free := Pencil order
  [seq table_row table f.1 | f <- forms] [seq table_row table f.2 | f <- forms] free.

Section Checker.

Variables (s : system) (u : unknown).
Local Open Scope Z_scope.

Notation nobody := (SlipParticle 0 0 (0, 0) (0, 0) 0 0).

Definition free_number := size (free_dofs s).
Definition first_dofs := [seq first_dof p | p <- particles s].
Definition second_dofs := [seq second_dof p | p <- particles s].
Definition moving_dofs := free_dofs s ++ first_dofs ++ second_dofs.
Definition particle j := nth nobody (particles s) j.

Definition k_row d := nth [::] (stiffness s) d.
Definition m_row d := nth [::] (mass s) d.

(* The column of the pencil to which a degree of freedom belongs, and the factor it gets. *)
Definition column d : option (nat * Z) :=
  if d \in free_dofs s then Some (index d (free_dofs s), unit_length s)
  else if d \in first_dofs then
    let j := index d first_dofs in
    Some ((free_number + j)%N, - (sign_of (particle j) * (tangent (particle j)).1))
  else if d \in second_dofs then
    let j := index d second_dofs in
    Some ((free_number + j)%N, - (sign_of (particle j) * (tangent (particle j)).2))
  else None.

(* [column] as a table over the degrees of freedom ([nth_column_table]). *)
Definition column_table : seq (option (nat * Z)) :=
  let along part j :=
    ((free_number + j)%N, - (sign_of (particle j) * part (tangent (particle j)))) in
  mark (fun k => (k, unit_length s)) 0 (free_dofs s)
    (mark (along fst) 0 first_dofs (mark (along snd) 0 second_dofs [::])).

(* The same as rows. *)
Definition column_rows : seq sparse_row :=
  [seq if c is Some entry then [:: entry] else [::] | c <- column_table].

Definition multiple c (row : sparse_row) : sparse_row :=
  if c =? 0 then [::] else times_row c row.

(* a t_p + b n_p *)
Definition direction a b p : planar :=
  (a * (tangent p).1 + b * (normal p).1, a * (tangent p).2 + b * (normal p).2).

(* The rows of a matrix at both degrees of freedom of a particle, with these factors. *)
Definition at_both (rows : nat -> sparse_row) p (e : planar) : sparse_row :=
  multiple e.1 (rows (first_dof p)) ++ multiple e.2 (rows (second_dof p)).

(* w_d, and e'w at a particle *)
Definition force_form d : linear_form := (k_row d, if u is Lambda2 _ _ then m_row d else [::]).

Definition pressing_form (e : planar) p : linear_form :=
  (at_both k_row p e, if u is Lambda2 _ _ then at_both m_row p e else [::]).

(* a'b *)
Definition inner (a b : planar) := a.1 * b.1 + a.2 * b.2.

Definition unit_square := unit_length s * unit_length s.

(* (1 + c^2 mu^2) g, times the denominator of mu, if this is an integer ([turns_exactly]); c is the
   length of the normal in units of that of the tangent. *)
Definition turning_numerator m q p :=
  (q * q * unit_square + m * m * inner (normal p) (normal p)) * geometric_stiffness p.

Definition turning p :=
  if u is Lambda2 m q then turning_numerator m q p / (q * unit_square) else 0.

Definition turns_exactly p :=
  if u is Lambda2 m q then q * unit_square * turning p =? turning_numerator m q p
  else geometric_stiffness p =? 0.

(* a t'v *)
Definition sliding_row a p : sparse_row :=
  multiple a [:: (first_dof p, (tangent p).1); (second_dof p, (tangent p).2)].

(* S t'w + mu n'w + (1 + c^2 mu^2) g S t'v, times the denominator of mu *)
Definition cone_form p : linear_form :=
  match u with
  | Mu => (at_both k_row p (direction (sign_of p) 0 p),
           at_both k_row p (direction 0 1 p))
  | Lambda2 m q => (at_both k_row p (direction (q * sign_of p) m p) ++
                    sliding_row (turning p * sign_of p) p,
                    at_both m_row p (direction (q * sign_of p) m p))
  end.

Definition negative (f : linear_form) : linear_form := (multiple (-1) f.1, multiple (-1) f.2).

(* The rows of the pencil, as forms of the motion. *)
Definition system_forms : seq linear_form :=
  [seq force_form d | d <- free_dofs s] ++ [seq negative (cone_form p) | p <- particles s].

Definition pencil_of : pencil :=
  pencil_of_forms column_rows (free_number + size (particles s)) system_forms
    (iota 0 free_number).

Definition columns_in_range (rows : seq sparse_row) :=
  all (fun row => all (fun e => e.1 < dofs s)%N row) rows.

Definition particle_wellformed p :=
  [&& sign_of p * sign_of p =? 1, inner (tangent p) (tangent p) =? unit_square,
      0 <? inner (normal p) (normal p), inner (tangent p) (normal p) =? 0 & turns_exactly p].

Definition system_wellformed :=
  [&& uniq moving_dofs, all (fun d => d < dofs s)%N moving_dofs,
      all particle_wellformed (particles s),
      columns_in_range (stiffness s) && columns_in_range (mass s), 0 <? unit_length s &
      if u is Lambda2 _ q then 0 <? q else true].

Definition check_system claims w tr lo hi :=
  system_wellformed && check_complete pencil_of claims w tr lo hi.

Definition check_system_excluded tr lo hi :=
  system_wellformed && check_excluded pencil_of tr lo hi.

Definition check_system_claim k := system_wellformed && check_claim pencil_of k.

Definition check_system_enclosed k := system_wellformed && check_enclosed_claim pencil_of k.

End Checker.

Arguments turning : simpl never.

(* All obstacles are flat. *)
Definition flat s := all (fun p => geometric_stiffness p =? 0)%Z (particles s).

Lemma flat_particle s j : flat s -> (j < size (particles s))%N ->
  geometric_stiffness (particle s j) = 0%Z.
Proof. by move=> /(all_nthP (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z) each /each/Z.eqb_spec. Qed.

Lemma flat_turning s u p : geometric_stiffness p = 0%Z -> turning s u p = 0%Z.
Proof.
rewrite /turning /turning_numerator => ->; case: u => // m q.
by rewrite Z.mul_0_r Zdiv_0_l.
Qed.

Lemma flat_turns s u p : geometric_stiffness p = 0%Z -> turns_exactly s u p.
Proof.
move=> flat_p; rewrite /turns_exactly /turning_numerator flat_turning // flat_p.
by case: u => // m q; rewrite !Z.mul_0_r.
Qed.

(* For mu = 0/1 and "1/0". *)
Lemma plain_turning s p : (0 <? unit_length s)%Z ->
  turning s (Lambda2 0 1) p = geometric_stiffness p.
Proof.
move=> l0; rewrite /turning /turning_numerator /unit_square.
by rewrite !Z.mul_1_l Z.add_0_r Z.mul_comm Z.div_mul //; move: l0; clear; lia.
Qed.

Lemma friction_turning s p : turning s (Lambda2 1 0) p = 0%Z.
Proof. exact: Zdiv_0_r. Qed.

(* Where mu is the unknown, a wellformed system is flat. *)
Lemma wellformed_flat s : system_wellformed s Mu -> flat s.
Proof. by case/and5P=> _ _ + _ _; apply: sub_all => p /and5P[]. Qed.

Lemma wellformed_plain s : system_wellformed s Mu -> system_wellformed s (Lambda2 0 1).
Proof.
case/and5P=> um moving particles rows /andP[l0 _]; apply/and5P; split; rewrite ?l0 //.
apply: sub_all particles => p /and5P[sq tt nn tn /Z.eqb_spec flat_p].
by apply/and5P; split=> //; apply: flat_turns.
Qed.

Section Forms.

Variable R : rcfType.
Implicit Types (t : R) (x : nat -> R).

Definition lambda2_of u t := if u is Lambda2 _ _ then t else 0.
Definition mu_of u t := if u is Lambda2 m q then toR m / toR q else t.

(* The positive number by which a slip row is multiplied. *)
Definition row_factor u : R := if u is Lambda2 _ q then toR q else 1.

Definition row_value (row : sparse_row) x : R := \sum_(e <- row) toR e.2 * x e.1.

Definition form_value (f : linear_form) t x := row_value f.1 x + t * row_value f.2 x.

Lemma row_value_nil x : row_value [::] x = 0.
Proof. exact: big_nil. Qed.

Lemma row_value_cat a b x : row_value (a ++ b) x = row_value a x + row_value b x.
Proof. exact: big_cat. Qed.

Lemma row_value_multiple c row x : row_value (multiple c row) x = toR c * row_value row x.
Proof.
rewrite /multiple; case: Z.eqb_spec => [->|_]; first by rewrite toR0 mul0r row_value_nil.
rewrite /row_value big_map mulr_sumr; apply: eq_bigr => e _ /=.
by rewrite toRM mulrA.
Qed.

Lemma value_negative f t x : form_value (negative f) t x = - form_value f t x.
Proof.
rewrite /form_value /= !row_value_multiple -[(-1)%Z]/(Z.opp 1) toRN toR1 !mulN1r.
by rewrite mulrN opprD.
Qed.

Lemma form_value_same f t x x' : (forall d, x d = x' d) -> form_value f t x = form_value f t x'.
Proof.
by move=> same; rewrite /form_value /row_value; congr (_ + _ * _); apply: eq_bigr => e _;
  rewrite same.
Qed.

(* The rows of the pencil are the forms at the motion of x. *)
Variables (table : seq sparse_row) (n : nat) (forms : seq linear_form) (fr : seq nat).
Hypothesis small : forall d c, c \in nth [::] table d -> (c.1 < n)%N.

Definition table_motion x d := row_value (nth [::] table d) x.

Lemma row_value_table row x : row_value (table_row table row) x = row_value row (table_motion x).
Proof.
elim: row => [|e row IH]; first by rewrite !row_value_nil.
rewrite /table_row /= row_value_cat -/(table_row _ _) IH [RHS]/row_value big_cons; congr (_ + _).
rewrite /row_value big_map /table_motion /row_value mulr_sumr; apply: eq_bigr => c _ /=.
by rewrite toRM; move: (toR _) (toR _) (x _) => *; ring.
Qed.

Lemma table_row_range row : all (fun e => e.1 < n)%N (table_row table row).
Proof. by apply/allP=> e /flatten_mapP[e' _ /mapP[c /small lt_c ->]]. Qed.

Lemma form_reaction t x i : (i < size forms)%N ->
  reaction (pencil_of_forms table n forms fr) t x i =
  form_value (nth no_form forms i) t (table_motion x).
Proof.
move=> lt_i; rewrite /reaction /a_entry /b_entry /row_a /row_b /= !(nth_map no_form) //.
under eq_bigr do rewrite mulrDl -mulrA; rewrite big_split /= -mulr_sumr.
by rewrite !sum_lookup ?table_row_range // -!/(row_value _ _) !row_value_table.
Qed.

End Forms.

(* A normal is a multiple of the tangent, turned. *)
Lemma orthogonal (R : realFieldType) (t1 t2 n1 n2 l : R) : 0 < l ->
  t1 ^+ 2 + t2 ^+ 2 = l -> 0 < n1 ^+ 2 + n2 ^+ 2 -> t1 * n1 + t2 * n2 = 0 ->
  exists2 k, k != 0 & n1 = - (k * t2) /\ n2 = k * t1.
Proof.
move=> /lt0r_neq0 l0 tt nn tn; pose k := (t1 * n2 - t2 * n1) / l.
have lk : l * k = t1 * n2 - t2 * n1 by rewrite /k mulrC divfK.
have e1 : n1 = - (k * t2).
  apply: (mulfI l0); rewrite mulrN mulrA lk -tt; apply/eqP; rewrite -subr_eq0; apply/eqP.
  by rewrite -[RHS](mulr0 t1) -tn; ring.
have e2 : n2 = k * t1.
  apply: (mulfI l0); rewrite mulrA lk -tt; apply/eqP; rewrite -subr_eq0; apply/eqP.
  by rewrite -[RHS](mulr0 t2) -tn; ring.
exists k => //; apply: contraTneq nn => k0.
by rewrite e1 e2 k0 !mul0r oppr0 expr0n addr0 ltxx.
Qed.

Section Sound.

Variables (R : rcfType) (s : system) (u : unknown).
Implicit Types (t : R) (x v : nat -> R).
Notation all_dofs := (iota 0 (dofs s)).
Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation variables := (iota 0 (nf + ns)).
Notation Q := (pencil_of s u).
Notation table := (column_table s).

Definition k_entry d j : R := toR (lookup (k_row s d) j).
Definition m_entry d j : R := toR (lookup (m_row s d) j).

(* w_d *)
Definition force lambda2 (v : nat -> R) d :=
  \sum_(j <- all_dofs) (k_entry d j + lambda2 * m_entry d j) * v j.

(* Inner product of a direction of particle p with v or w. *)
Definition along (e : planar) (p : slip_particle) (f : nat -> R) :=
  toR e.1 * f (first_dof p) + toR e.2 * f (second_dof p).

(* S t'v; (1 + c^2 mu^2) g; and S t'w + mu n'w + (1 + c^2 mu^2) g S t'v *)
Definition slip_rate v p := toR (sign_of p) * along (tangent p) p v.

Definition turning_at mu p : R :=
  (1 + mu ^+ 2 * (toR (inner (normal p) (normal p)) / toR (unit_length s) ^+ 2)) *
  toR (geometric_stiffness p).

Definition cone lambda2 mu v p :=
  toR (sign_of p) * along (tangent p) p (force lambda2 v) +
  mu * along (normal p) p (force lambda2 v) + turning_at mu p * slip_rate v p.

Definition conditions_9 lambda2 mu (v : nat -> R) :=
  [/\ exists2 d, d \in all_dofs & v d != 0,
      forall d, d \in all_dofs -> d \notin moving_dofs s -> v d = 0,
      forall d, d \in free_dofs s -> force lambda2 v d = 0 &
      forall j, (j < ns)%N -> let p := particle s j in
        [/\ along (normal p) p v = 0, slip_rate v p <= 0, cone lambda2 mu v p <= 0 &
            cone lambda2 mu v p * slip_rate v p = 0]].

(* (9) with the unknown t >= 0. *)
Definition satisfies_9 t v :=
  0 <= t /\ match u with
            | Mu => conditions_9 0 t v
            | Lambda2 m q => conditions_9 t (toR m / toR q) v
            end.

(* The slip particles that slip after the event (support), those at the border of the friction
   cone without slip (biactive), and the others; numbers of the pencil's variables. *)
Definition has_support (support biactive : seq nat) t v := forall j, (j < ns)%N ->
  let p := particle s j in
  [/\ (nf + j)%N \in support -> slip_rate v p < 0,
      (nf + j)%N \notin support -> slip_rate v p = 0,
      (nf + j)%N \notin support -> (nf + j)%N \in biactive ->
        cone (lambda2_of u t) (mu_of u t) v p = 0 &
      (nf + j)%N \notin support -> (nf + j)%N \notin biactive ->
        cone (lambda2_of u t) (mu_of u t) v p < 0].

(* (10) *)
Definition motion (x : nat -> R) d :=
  if column s d is Some (j, c) then toR c * x j else 0.

Hypothesis wf : system_wellformed s u.

Lemma wf_parts :
  [/\ uniq (moving_dofs s), all (fun d => d < dofs s)%N (moving_dofs s),
      forall j, (j < ns)%N -> particle_wellformed s u (particle s j),
      columns_in_range s (stiffness s) && columns_in_range s (mass s) &
      (0 <? unit_length s)%Z].
Proof.
case/and5P: wf => ? ? /(all_nthP (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z) ? ? /andP[? ?].
by split.
Qed.

Lemma moving_dof_in d : d \in moving_dofs s -> d \in all_dofs.
Proof. by have [_ /allP lt _ _ _] := wf_parts; move/lt; rewrite mem_iota. Qed.

Lemma uniq_parts :
  [/\ uniq (free_dofs s), uniq (first_dofs s), uniq (second_dofs s),
      forall d, d \in first_dofs s -> (d \in free_dofs s) = false &
      forall d, d \in second_dofs s -> (d \in free_dofs s) || (d \in first_dofs s) = false].
Proof.
have [+ _ _ _ _] := wf_parts; rewrite /moving_dofs !cat_uniq has_cat negb_or.
case/and3P=> uf /andP[/hasPn f1 /hasPn f2] /and3P[u1 /hasPn d12 u2].
split=> // d d_in; first by apply/negbTE/f1.
by apply/negbTE; rewrite negb_or f2 ?d12.
Qed.

Lemma rows_in_range d :
  all (fun e => e.1 < dofs s)%N (k_row s d) /\ all (fun e => e.1 < dofs s)%N (m_row s d).
Proof.
have [_ _ _ /andP[/allP k /allP m] _] := wf_parts; rewrite /k_row /m_row; split.
  by have [l|l] := ltnP d (size (stiffness s)); [apply/k/mem_nth | rewrite nth_default].
by have [l|l] := ltnP d (size (mass s)); [apply/m/mem_nth | rewrite nth_default].
Qed.

Lemma first_particle j : (j < ns)%N -> first_dof (particle s j) = nth 0%N (first_dofs s) j.
Proof. by move=> lt_j; rewrite (nth_map (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z). Qed.

Lemma second_particle j : (j < ns)%N -> second_dof (particle s j) = nth 0%N (second_dofs s) j.
Proof. by move=> lt_j; rewrite (nth_map (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z). Qed.

Lemma first_in j : (j < ns)%N -> first_dof (particle s j) \in first_dofs s.
Proof. by move=> lt_j; rewrite first_particle // mem_nth // size_map. Qed.

Lemma second_in j : (j < ns)%N -> second_dof (particle s j) \in second_dofs s.
Proof. by move=> lt_j; rewrite second_particle // mem_nth // size_map. Qed.

Lemma column_free k : (k < nf)%N ->
  column s (nth 0%N (free_dofs s) k) = Some (k, unit_length s).
Proof. by move=> lt_k; have [uf _ _ _ _] := uniq_parts; rewrite /column mem_nth ?index_uniq. Qed.

Lemma column_first j : (j < ns)%N -> let p := particle s j in
  column s (first_dof p) = Some ((nf + j)%N, (- (sign_of p * (tangent p).1))%Z).
Proof.
move=> lt_j /=; have [_ u1 _ out _] := uniq_parts.
rewrite /column out ?first_in // first_particle // index_uniq ?size_map //.
Qed.

Lemma column_second j : (j < ns)%N -> let p := particle s j in
  column s (second_dof p) = Some ((nf + j)%N, (- (sign_of p * (tangent p).2))%Z).
Proof.
move=> lt_j /=; have [_ _ u2 _ out] := uniq_parts.
have := out _ (second_in lt_j); rewrite /column => /norP[/negbTE-> /negbTE->].
by rewrite second_in // second_particle // index_uniq ?size_map.
Qed.

Lemma column_in_range d j c : column s d = Some (j, c) -> (j < nf + ns)%N.
Proof.
rewrite /column; case: ifP => [d_free [<- _]|_].
  by rewrite (leq_trans _ (leq_addr _ _)) // index_mem.
case: ifP => [d_in [<- _]|_]; first by rewrite ltn_add2l -(size_map first_dof) index_mem.
by case: ifP => // d_in [<- _]; rewrite ltn_add2l -(size_map second_dof) index_mem.
Qed.

Lemma nth_column_table d : nth None table d = column s d.
Proof. by rewrite !nth_mark nth_nil !add0n. Qed.

Lemma column_rowsE d :
  nth [::] (column_rows s) d = if column s d is Some c then [:: c] else [::].
Proof.
rewrite -nth_column_table; have [lt_d|ge_d] := ltnP d (size (column_table s)).
  by rewrite (nth_map None).
by rewrite !nth_default ?size_map.
Qed.

Lemma table_motionE x d : table_motion (column_rows s) x d = motion x d.
Proof.
rewrite /table_motion column_rowsE /motion; case: (column s d) => [[j c]|].
  by rewrite /row_value big_seq1.
exact: row_value_nil.
Qed.

Lemma lookup_multiple c row j :
  toR (lookup (multiple c row) j) = toR c * toR (lookup row j) :> R.
Proof.
rewrite /multiple; case: Z.eqb_spec => [->|_]; first by rewrite toR0 mul0r.
by rewrite lookup_times toRM.
Qed.

Lemma forceE lambda2 v d : force lambda2 v d =
  \sum_(j <- all_dofs) k_entry d j * v j + lambda2 * \sum_(j <- all_dofs) m_entry d j * v j.
Proof.
rewrite /force mulr_sumr -big_split /=; apply: eq_bigr => j _.
by rewrite mulrDl mulrA.
Qed.

Lemma row_factor_gt0 : 0 < row_factor R u.
Proof.
case/and5P: wf => _ _ _ _ /andP[_]; rewrite /row_factor.
by case: (u) => [_|m q]; [exact: ltr01 | rewrite toR_gt0].
Qed.

Lemma row_value_both rows p e x : row_value (at_both rows p e) x =
  along e p (fun d => row_value (rows d) x).
Proof. by rewrite row_value_cat !row_value_multiple. Qed.

Lemma force_rows lambda2 x d : force lambda2 x d =
  row_value (k_row s d) x + lambda2 * row_value (m_row s d) x.
Proof.
have [k m] := rows_in_range d.
by rewrite forceE /k_entry /m_entry !sum_lookup.
Qed.

Lemma value_force u' d t x : form_value (force_form s u' d) t x = force (lambda2_of u' t) x d.
Proof.
rewrite force_rows /form_value /force_form /lambda2_of; case: u' => [|m q] //=.
by rewrite row_value_nil mulr0 mul0r.
Qed.

Lemma value_pressing u' e p t x :
  form_value (pressing_form s u' e p) t x = along e p (force (lambda2_of u' t) x).
Proof.
rewrite /along !force_rows /form_value /pressing_form /lambda2_of; case: u' => [|m q] /=.
  by rewrite row_value_nil row_value_both /along mulr0 !mul0r !addr0.
rewrite !row_value_both /along.
by move: (toR _) (toR _) (row_value _ _) (row_value _ _) => *; ring.
Qed.

Lemma row_value_sliding a p x : row_value (sliding_row a p) x = toR a * along (tangent p) p x.
Proof. by rewrite row_value_multiple /row_value !big_cons big_nil addr0. Qed.

(* q S t'w + m n'w + q (1 + c^2 mu^2) g S t'v *)
Lemma value_cone_parts m q p t x : form_value (cone_form s (Lambda2 m q) p) t x =
  toR q * (toR (sign_of p) * along (tangent p) p (force t x)) +
  toR m * along (normal p) p (force t x) + toR (turning s (Lambda2 m q) p) * slip_rate x p.
Proof.
rewrite /form_value /cone_form /= row_value_cat row_value_sliding !row_value_both toRM.
rewrite -mulrA -/(slip_rate x p) /along !force_rows /direction !toRD !toRM /=.
move: (slip_rate _ _) (toR (turning _ _ _)) => *.
move: (row_value _ _) (row_value _ _) (row_value _ _) (row_value _ _) => *.
by move: (toR _) (toR _) (toR _) (toR _) (toR _) (toR _) (toR _) => *; ring.
Qed.

Lemma unit_length_gt0 : 0 < toR (unit_length s) :> R.
Proof. by have [_ _ _ _ l0] := wf_parts; rewrite toR_gt0. Qed.

Lemma turningE p t : turns_exactly s u p ->
  toR (turning s u p) = row_factor R u * turning_at (mu_of u t) p :> R.
Proof.
have := lt0r_neq0 row_factor_gt0; have := lt0r_neq0 unit_length_gt0.
rewrite /turns_exactly /turning_numerator /turning_at /row_factor /mu_of.
move: (inner (normal p) (normal p)) (geometric_stiffness p) => nn g.
case: (u) => [|m q] l0 q0 /Z.eqb_spec; first by move->; rewrite toR0 !mulr0.
move/(congr1 (@toR R)); rewrite /unit_square !toRM !toRD !toRM => eq.
apply: (mulfI (mulf_neq0 q0 (mulf_neq0 l0 l0))); rewrite [LHS]eq.
by field; apply/andP.
Qed.

Lemma value_cone p t x : turns_exactly s u p -> form_value (cone_form s u p) t x =
  row_factor R u * cone (lambda2_of u t) (mu_of u t) x p.
Proof.
move=> /(turningE t) turning_t; have := row_factor_gt0.
rewrite /cone mulrDr mulrA -turning_t; rewrite /row_factor /lambda2_of /mu_of.
case: (u) => [|m q] f0; last first.
  have q0 : toR q != 0 :> R by rewrite gt_eqF.
  by rewrite value_cone_parts; move: (along _ _ _) (along _ _ _) => *; field.
rewrite mul1r /along !force_rows /form_value /= !row_value_both /along /direction !toRD !toRM.
rewrite toR0 toR1 mul0r addr0 /=.
move: (row_value _ _) (row_value _ _) (row_value _ _) (row_value _ _) => *.
by move: (toR _) (toR _) (toR _) (toR _) (toR _) => *; ring.
Qed.

Lemma turning_at_flat mu p : geometric_stiffness p = 0%Z -> turning_at mu p = 0.
Proof. by rewrite /turning_at => ->; rewrite toR0 mulr0. Qed.

Lemma particle_turns j : (j < ns)%N -> turns_exactly s u (particle s j).
Proof. by move=> lt_j; have [_ _ /(_ _ lt_j)/and5P[]] := wf_parts. Qed.

Lemma system_form_reaction t x i : (i < nf + ns)%N ->
  reaction Q t x i = form_value (nth no_form (system_forms s u) i) t (motion x).
Proof.
move=> lt_i; rewrite -(form_value_same _ _ (table_motionE x)) form_reaction //; last first.
  by rewrite size_cat !size_map.
move=> d c; rewrite column_rowsE; case col: (column s d) => [[j f]|] //; rewrite inE => /eqP->.
exact: column_in_range col.
Qed.

Lemma free_reaction t x k : (k < nf)%N ->
  reaction Q t x k = force (lambda2_of u t) (motion x) (nth 0%N (free_dofs s) k).
Proof.
move=> lt_k; rewrite system_form_reaction ?ltn_addr // nth_cat size_map lt_k.
by rewrite (nth_map 0%N) // value_force.
Qed.

Lemma slip_reaction t x j : (j < ns)%N ->
  reaction Q t x (nf + j)%N =
  - (row_factor R u * cone (lambda2_of u t) (mu_of u t) (motion x) (particle s j)).
Proof.
move=> lt_j; rewrite system_form_reaction ?ltn_add2l // nth_cat size_map ltnNge leq_addr /= addKn.
rewrite (nth_map (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z) // value_negative value_cone //.
exact: particle_turns.
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

(* What a well-formed particle gives in R. *)
Lemma particle_parts j : (j < ns)%N -> let p := particle s j in
  [/\ toR (sign_of p) ^+ 2 = 1 :> R,
      toR (tangent p).1 ^+ 2 + toR (tangent p).2 ^+ 2 = toR (unit_length s) ^+ 2 :> R,
      0 < toR (normal p).1 ^+ 2 + toR (normal p).2 ^+ 2 :> R &
      toR (tangent p).1 * toR (normal p).1 + toR (tangent p).2 * toR (normal p).2 = 0 :> R].
Proof.
move=> lt_j p; have [_ _ /(_ _ lt_j) + _ _] := wf_parts; rewrite -/p.
case/and5P=> /Z.eqb_spec sq /Z.eqb_spec tt nn /Z.eqb_spec tn _.
move: tt nn tn; rewrite -(@toR_gt0 R) /inner => tt nn tn.
by rewrite !expr2 -!toRM -!toRD sq tt tn.
Qed.

Lemma motion_free x k : (k < nf)%N ->
  motion x (nth 0%N (free_dofs s) k) = toR (unit_length s) * x k.
Proof. by move=> lt_k; rewrite /motion column_free. Qed.

Lemma along_motion e x j : (j < ns)%N -> let p := particle s j in
  along e p (motion x) =
  - (toR (sign_of p) * (toR e.1 * toR (tangent p).1 + toR e.2 * toR (tangent p).2) *
     x (nf + j)%N).
Proof.
move=> lt_j p; rewrite /along /motion column_first // column_second // -/p !toRN !toRM.
by move: (toR _) (toR _) (toR _) (toR _) (toR _) (x _) => *; ring.
Qed.

Lemma normal_motion x j : (j < ns)%N ->
  along (normal (particle s j)) (particle s j) (motion x) = 0.
Proof.
move=> lt_j; rewrite along_motion //; have [_ _ _ tn] := particle_parts lt_j.
by rewrite [_ * toR (tangent _).1]mulrC [_ * toR (tangent _).2]mulrC tn mulr0 mul0r oppr0.
Qed.

Lemma slip_motion x j : (j < ns)%N ->
  slip_rate (motion x) (particle s j) = - (toR (unit_length s) ^+ 2 * x (nf + j)%N).
Proof.
move=> lt_j; rewrite /slip_rate along_motion //; have [sq tt _ _] := particle_parts lt_j.
by rewrite -!expr2 tt mulrN !mulrA -expr2 sq mul1r.
Qed.

Lemma motion_zero x d : d \notin moving_dofs s -> motion x d = 0.
Proof.
rewrite !mem_cat !negb_or => /and3P[/negbTE out_f /negbTE out_1 /negbTE out_2].
by rewrite /motion /column out_f out_1 out_2.
Qed.

Lemma free_dof_in k : (k < nf)%N -> nth 0%N (free_dofs s) k \in all_dofs.
Proof. by move=> lt_k; apply: moving_dof_in; rewrite mem_cat mem_nth. Qed.

Lemma first_dof_in j : (j < ns)%N -> first_dof (particle s j) \in all_dofs.
Proof. by move=> lt_j; apply: moving_dof_in; rewrite !mem_cat first_in ?orbT. Qed.

Lemma second_dof_in j : (j < ns)%N -> second_dof (particle s j) \in all_dofs.
Proof. by move=> lt_j; apply: moving_dof_in; rewrite !mem_cat second_in ?orbT. Qed.

Lemma motion_nonzero x :
  (exists2 i, i \in variables & x i != 0) <-> (exists2 d, d \in all_dofs & motion x d != 0).
Proof.
have l0 := lt0r_neq0 unit_length_gt0.
split=> [[i]|[d _]].
  rewrite mem_iota add0n /= => lt_i xi; have [lt_nf|ge_nf] := ltnP i nf.
    exists (nth 0%N (free_dofs s) i); first exact: free_dof_in.
    by rewrite motion_free // mulf_neq0.
  have lt_j : (i - nf < ns)%N by rewrite -(ltn_add2l nf) subnKC.
  have rate : slip_rate (motion x) (particle s (i - nf)) != 0.
    by rewrite slip_motion // subnKC // oppr_eq0 mulf_neq0 // expf_neq0.
  have [v1|] := eqVneq (motion x (first_dof (particle s (i - nf)))) 0; last first.
    by exists (first_dof (particle s (i - nf))); rewrite ?first_dof_in.
  exists (second_dof (particle s (i - nf))); first exact: second_dof_in.
  by apply: contraNneq rate => v2; rewrite /slip_rate /along v1 v2 !mulr0 addr0 mulr0.
rewrite /motion; case col: (column s d) => [[j c]|]; last by rewrite eqxx.
rewrite mulf_eq0 negb_or => /andP[_ xj]; exists j => //.
by rewrite mem_iota add0n; apply: column_in_range col.
Qed.

Lemma satisfies_9E t v :
  satisfies_9 t v <-> 0 <= t /\ conditions_9 (lambda2_of u t) (mu_of u t) v.
Proof. by rewrite /satisfies_9 /lambda2_of /mu_of; case: (u). Qed.

Theorem system_pencil t x : solution Q t x <-> satisfies_9 t (motion x).
Proof.
rewrite satisfies_9E; have c0 := row_factor_gt0.
have l2 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0 // unit_length_gt0.
split=> [[t0 nonzero rows_f rows_s]|[t0 [nonzero _ rows_f rows_s]]].
  split=> //; split; first exact/motion_nonzero.
  - by move=> d _; apply: motion_zero.
  - move=> d /(nthP 0%N)[k lt_k <-]; rewrite -free_reaction // rows_f //.
    by rewrite free_variable.
  move=> j lt_j p; have [x0 + +] := rows_s _ (slip_variable_in lt_j).
  rewrite slip_reaction // -/p slip_motion // oppr_ge0 oppr_le0 => y0 xy.
  split=> //; first exact: normal_motion.
  - by rewrite pmulr_rge0.
  - by rewrite -(pmulr_rle0 _ c0).
  apply: (mulfI (lt0r_neq0 c0)); rewrite mulr0 -(mulr0 (toR (unit_length s) ^+ 2)) -xy.
  by move: (cone _ _ _ _) (x _) (toR _) => *; ring.

split=> //; first exact/motion_nonzero.
  by move=> i; rewrite free_variable => lt_i; rewrite free_reaction // rows_f // mem_nth.
move=> i /slip_variable[j lt_j ->]; have := rows_s _ lt_j.
rewrite slip_reaction //= slip_motion // oppr_le0 pmulr_rge0 // => -[_ x0 y0 xy]; split=> //.
  by rewrite oppr_ge0 pmulr_rle0.
apply: (mulfI (lt0r_neq0 l2)); rewrite mulr0 -(mulr0 (row_factor R u)) -xy.
by move: (cone _ _ _ _) (x _) (toR _) => *; ring.
Qed.

(* x from v *)
Definition variables_of (v : nat -> R) i :=
  if (i < nf)%N then v (nth 0%N (free_dofs s) i) / toR (unit_length s)
  else - (slip_rate v (particle s (i - nf)) / toR (unit_length s) ^+ 2).

(* A vector of the plane that is perpendicular to n is a multiple of t. *)
Lemma along_tangent (t1 t2 n1 n2 v1 v2 l : R) : 0 < l ->
  t1 ^+ 2 + t2 ^+ 2 = l -> 0 < n1 ^+ 2 + n2 ^+ 2 -> t1 * n1 + t2 * n2 = 0 ->
  n1 * v1 + n2 * v2 = 0 ->
  t1 * (t1 * v1 + t2 * v2) = l * v1 /\ t2 * (t1 * v1 + t2 * v2) = l * v2.
Proof.
move=> l0 tt nn tn nv; have [k k0 [e1 e2]] := orthogonal l0 tt nn tn.
have cross : t1 * v2 - t2 * v1 = 0 by apply: (mulfI k0); rewrite mulr0 -nv e1 e2; ring.
split.
  transitivity ((t1 ^+ 2 + t2 ^+ 2) * v1 + t2 * (t1 * v2 - t2 * v1)); first by ring.
  by rewrite cross mulr0 addr0 tt.
transitivity ((t1 ^+ 2 + t2 ^+ 2) * v2 - t1 * (t1 * v2 - t2 * v1)); first by ring.
by rewrite cross mulr0 subr0 tt.
Qed.

(* A motion along the tangents, and of free degrees of freedom. *)
Lemma motion_at_moving v :
  (forall j, (j < ns)%N -> along (normal (particle s j)) (particle s j) v = 0) ->
  forall d, d \in moving_dofs s -> motion (variables_of v) d = v d.
Proof.
have l0 := lt0r_neq0 unit_length_gt0.
have l2 : toR (unit_length s) ^+ 2 != 0 :> R by rewrite expf_neq0.
move=> tangents d d_in.
have at_particle j : (j < ns)%N -> let p := particle s j in
    motion (variables_of v) (first_dof p) = v (first_dof p) /\
    motion (variables_of v) (second_dof p) = v (second_dof p).
  move=> lt_j p; have nv := tangents _ lt_j; have [sq tt nn tn] := particle_parts lt_j.
  have [v1 v2] := along_tangent (exprn_gt0 2 unit_length_gt0) tt nn tn nv.
  rewrite /motion column_first // column_second // /variables_of ltnNge leq_addr /= addKn -/p.
  have back c w : toR c * along (tangent p) p v = toR (unit_length s) ^+ 2 * w ->
      toR (- (sign_of p * c)) * - (slip_rate v p / toR (unit_length s) ^+ 2) = w.
    move=> eq; apply: (mulfI l2); rewrite -eq -[RHS]mul1r -sq /slip_rate toRN toRM.
    by move: (along _ _ _) (toR c) (toR (sign_of p)) => *; field.
  by split; apply: back; rewrite ?v1 ?v2.

move: d_in; rewrite !mem_cat => /or3P[/(nthP 0%N)[k lt_k <-]||].
- by rewrite motion_free // /variables_of lt_k mulrC divfK.
- case/(nthP 0%N)=> j; rewrite size_map => lt_j; rewrite -first_particle // => <-.
  by case: (at_particle _ lt_j).
case/(nthP 0%N)=> j; rewrite size_map => lt_j; rewrite -second_particle // => <-.
by case: (at_particle _ lt_j).
Qed.

Lemma motion_restored v : (forall d, d \in all_dofs -> d \notin moving_dofs s -> v d = 0) ->
  (forall j, (j < ns)%N -> along (normal (particle s j)) (particle s j) v = 0) ->
  forall d, d \in all_dofs -> motion (variables_of v) d = v d.
Proof.
move=> at_rest tangents d d_all.
have [/(motion_at_moving tangents)//|d_out] := boolP (d \in moving_dofs s).
by rewrite motion_zero // at_rest.
Qed.

Lemma motion_of_variables lambda2 mu v : conditions_9 lambda2 mu v ->
  forall d, d \in all_dofs -> motion (variables_of v) d = v d.
Proof. by case=> _ at_rest _ slips; apply: motion_restored => // j /slips[]. Qed.

Theorem system_onto t v : satisfies_9 t v ->
  forall d, d \in all_dofs -> motion (variables_of v) d = v d.
Proof. by rewrite satisfies_9E => -[_ /motion_of_variables]. Qed.

(* The signs of x and y give the support of the motion. *)
Lemma motion_support support biactive t x :
  (forall i, i \in slip Q ->
     [/\ i \in support -> 0 < x i, i \notin support -> x i = 0,
         i \notin support -> i \in biactive -> reaction Q t x i = 0 &
         i \notin support -> i \notin biactive -> 0 < reaction Q t x i]) ->
  has_support support biactive t (motion x).
Proof.
move=> signs j lt_j p; have [pos zero y_zero y_pos] := signs _ (slip_variable_in lt_j).
have l2 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0 // unit_length_gt0.
have c0 := row_factor_gt0; have yE := slip_reaction t x lt_j; rewrite -/p in yE.
rewrite slip_motion //; split=> [/pos x0|/zero->|out /(y_zero out)|out /(y_pos out)].
- by rewrite oppr_lt0 pmulr_rgt0.
- by rewrite mulr0 oppr0.
- by rewrite yE => /eqP; rewrite oppr_eq0 mulf_eq0 gt_eqF //= => /eqP.
by rewrite yE oppr_gt0 pmulr_rlt0.
Qed.

(* (9) speaks of degrees of freedom only. *)
Lemma conditions_9_ext lambda2 mu v v' : (forall d, d \in all_dofs -> v d = v' d) ->
  conditions_9 lambda2 mu v -> conditions_9 lambda2 mu v'.
Proof.
move=> same [[d Hd vd] at_rest rows_f rows_s].
have forceE' l d' : force l v d' = force l v' d'.
  by apply: sum_eq => j Hj; rewrite same.
split; first by exists d; rewrite -?same.
- by move=> d' Hd' out; rewrite -same // at_rest.
- by move=> d' /rows_f; rewrite forceE'.
move=> j lt_j; have := rows_s _ lt_j.
by rewrite /= /cone /slip_rate /along !forceE' !same ?first_dof_in ?second_dof_in.
Qed.

Lemma satisfies_9_ext t v v' : (forall d, d \in all_dofs -> v d = v' d) ->
  satisfies_9 t v -> satisfies_9 t v'.
Proof.
by move=> same; rewrite !satisfies_9E => -[t0 sat]; split=> //; apply: conditions_9_ext sat.
Qed.

Lemma solution_of_motion t v : satisfies_9 t v -> solution Q t (variables_of v).
Proof.
move=> sat; apply/system_pencil; apply: (satisfies_9_ext _ sat) => d Hd.
by rewrite (system_onto sat).
Qed.

Lemma variables_of_motion x i : i \in variables -> variables_of (motion x) i = x i.
Proof.
have l0 := lt0r_neq0 unit_length_gt0.
rewrite mem_iota add0n /= => lt_i; rewrite /variables_of.
have [lt_nf|ge_nf] := ltnP i nf; first by rewrite motion_free // mulrAC divff // mul1r.
have lt_j : (i - nf < ns)%N by rewrite -(ltn_add2l nf) subnKC.
by rewrite slip_motion // mulNr opprK subnKC // mulrAC divff ?mul1r // expf_neq0.
Qed.

(* The variables of a multiple of a motion. *)
Lemma variables_scaled v v' f i : (forall d, d \in all_dofs -> v' d = f * v d) ->
  i \in variables -> variables_of v' i = f * variables_of v i.
Proof.
move=> scaled; rewrite mem_iota add0n /= => lt_i; rewrite /variables_of.
have [lt_nf|ge_nf] := ltnP i nf; first by rewrite scaled ?mulrA // free_dof_in.
have lt_j : (i - nf < ns)%N by rewrite -(ltn_add2l nf) subnKC.
rewrite mulrN mulrA /slip_rate /along !scaled ?first_dof_in ?second_dof_in //.
by congr (- (_ / _)); move: (v _) (v _) (toR _) (toR _) (toR _) => *; ring.
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

Section Motions.

Hypothesis wf : system_wellformed s u.
Notation Q := (pencil_of s u).

Lemma lies_in_motion r t x : lies_in Q r t x -> motion_in r t (motion s x).
Proof.
case=> bt ag; split=> // j lt_j; have := ag j lt_j.
rewrite /slip_of (variables_of_motion wf) //.
exact: (slip_indices (Q := Q) (mem_nth 0%N lt_j)).
Qed.

(* x and x' give one motion only if they are proportional. *)
Lemma motion_injective x x' : same_motion (motion s x) (motion s x') -> proportional Q x x'.
Proof.
case=> f f0 scaled; exists f => // i Hi.
rewrite -(variables_of_motion wf x' Hi) -(variables_of_motion wf x Hi).
exact: (variables_scaled wf scaled Hi).
Qed.

(* The motions of a list of solutions. *)
Lemma motions_listed lo hi ys (other other' : R -> (nat -> R) -> Prop) :
  (forall t v, other t (variables_of s v) -> other' t v) ->
  all_listed (solution Q) (proportional Q) (lies_in Q) lo hi ys other ->
  all_listed (satisfies_9 s u) same_motion motion_in lo hi ys other'.
Proof.
move=> other_v; apply: (listed_transfer (good := fun _ _ => True) (f := motion s)) => // {ys}.
- by move=> t x _ /(system_pencil wf).
- by move=> r t x _; apply: lies_in_motion.
- by move=> _ x x' _ _; apply: motion_injective.
move=> t v sat; exists (variables_of s v); split; [exact: solution_of_motion | | exact: other_v].
move=> x' _ /motion_proportional[f f0 scaled]; exists f => // d Hd.
by rewrite -scaled (system_onto wf sat).
Qed.

End Motions.

Variables (claims : seq solution_claim).
Variables (w : elimination) (tr : tree (leaf whole)) (lo hi : point).
Hypothesis checked : check_system s u claims w tr lo hi.

Notation Q := (pencil_of s u).
Notation found := (found Q claims tr lo hi).
Notation left_open := (left_open tr lo hi).

Theorem system_complete :
  covers (satisfies_9 s u) same_motion motion_in lo hi found (in_some motion_in left_open).
Proof.
case/andP: (checked) => wf complete; have [every each] := complete_sound R complete.
split=> [t v sat bt|y in_found]; first exact: every (solution_of_motion wf sat) bt.

have [t [x [bt sol reg uniq]]] := each _ in_found.
exists t, (motion s x); split=> //; [exact/(system_pencil wf) | exact: (lies_in_motion wf) |].
move=> t' v' sat' reg'; have [-> prop] := uniq _ _ (solution_of_motion wf sat') reg'.
have [f f0 scaled] := motion_proportional prop.
by split=> //; exists f => // d Hd; rewrite -scaled (system_onto wf sat').
Qed.

Corollary system_none : found = [::] -> left_open = [::] ->
  forall (t : R) v, satisfies_9 s u t v -> between t lo hi -> False.
Proof.
by move=> none no_open; have := system_complete; rewrite none no_open; apply: covers_none.
Qed.

Theorem system_number ys : solutions_found Q claims tr lo hi = Some ys ->
  all_listed (satisfies_9 s u) same_motion motion_in lo hi ys (in_some motion_in left_open).
Proof.
case/andP: (checked) => wf complete /(complete_number R complete).
exact: motions_listed.
Qed.

Corollary system_exactly ys :
  solutions_found Q claims tr lo hi = Some ys -> left_open = [::] ->
  all_listed (satisfies_9 s u) same_motion motion_in lo hi ys no_other.
Proof. by move=> /system_number + no_open; apply: listed_weaken => t v; rewrite no_open => -[]. Qed.

End Main.

Theorem system_excluded (R : rcfType) s u tr lo hi : check_system_excluded s u tr lo hi ->
  forall (t : R) v, satisfies_9 s u t v -> between t lo hi -> False.
Proof.
case/andP=> wf excluded t v sat.
exact: (excluded_sound (R := R) excluded (solution_of_motion wf sat)).
Qed.

Theorem system_claim (R : rcfType) s u k : check_system_claim s u k -> exists (t : R) v,
  [/\ toR (claim_from k) <= toR (claim_denominator k) * t,
      toR (claim_denominator k) * t <= toR (claim_to k), satisfies_9 s u t v &
      has_support s u (support k) (biactive k) t v].
Proof.
case/andP=> wf /(@claim_sound R)[t [x [at_from at_to sol signs]]].
exists t, (motion s x); split=> //; first exact/(system_pencil wf).
exact: motion_support.
Qed.

Theorem system_enclosed (R : rcfType) s u k : check_system_enclosed s u k ->
  exists (t : R) v,
    [/\ between t (box_from k) (box_to k), satisfies_9 s u t v &
        has_support s u (box_support k) [::] t v].
Proof.
case/andP=> wf /(@enclosed_claim_sound R)[t [x [bt sol pos zero _]]].
exists t, (motion s x); split=> //; first exact/(system_pencil wf).
apply: (motion_support wf) => i Hi; split=> //; first exact: pos.
  by move/(zero _ Hi)=> [].
by move/(zero _ Hi)=> [].
Qed.
