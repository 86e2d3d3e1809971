(* From a problem and evidence to a statement that is true.

   [answer] makes the problem integral (Rational.v), chooses the check for a kind of evidence and
   puts together what it proves.  The check of an equilibrium makes its own integers.

   Theorem [answer_sound]: if [answer] gives a statement, then it holds in every real closed field,
   in the sense of [meaning] (Statement.v).

   Evidence is what the program's elaborator makes of a certificate; nothing is assumed of it.
   A refusal says which part of the evidence failed.

   Pages: spec/certificates.md, 5.15 to 5.21.  Called by program/main.ml. *)

From Mceip Require Import Base Lists Integers Sums Tree Enclosed Definite Signed Cover Number
  Condensation Pencil Whole Claim EnclosedClaim Complete System Signs Support Families Lifted
  ZeroReaction PlainMcp Varying Covers ZeroPencil ZeroEnclosed ZeroComplete Boxes Critical
  CriticalAnchors Presence PresenceAnchors Points Rational Statement Integral Reflection Quadratic
  Members Radii Equilibrium Unique Stability Stable.

(* A claim about the pencil; a motion with its forces; a box around a motion with particles of zero
   reaction. *)
Inductive claim_evidence :=
  | OfPencil of solution_claim
  | OfMotion of zero_claim
  | OfZeroBox of enclosed_claim.

(* Claims that root leaves refer to; the cover; and beside each region that its tree leaves open a
   box with zero reaction, a support leaf, or nothing. *)
Inductive cover_evidence :=
  | CoverInWindow of seq solution_claim & cover & seq (option pinned_box) &
      seq (option support_leaf)
  (* The window is one value. *)
  | CoverAtValue of seq solution_claim & cover & seq (option support_leaf).

Inductive absence_evidence :=
  | ByElimination of option (elimination * (matrix * matrix)) & tree critical_leaf
  | ByAnchors of box_anchoring & tree anchored_box_leaf.

Inductive evidence :=
  | ClaimsIn of point & point & seq claim_evidence
  | CoverOf of point & point & cover_evidence
  | CoverAtInfinity of seq solution_claim & cover & seq (option support_leaf)
  | Absence of point & point & absence_evidence
  | Presence of point & point & box_anchoring & seq presence_piece
  (* Of a body with radii: an interval of friction, and the shares of the slip particles over one
     unit. *)
  | MembersAbsence of point & point & seq Z & Z & box_anchoring & tree anchored_box_leaf
  | MembersPresence of point & point & seq Z & Z & box_anchoring & seq presence_piece
  (* An interval of friction, the elimination, and a factor at each end. *)
  | DefiniteRates of point & point & elimination & signed_ends
  (* An interval of friction, the elimination, and what stands at both ends. *)
  | Stable of point & point & elimination & stability & stable_end & stable_end
  | Points of seq mcp_point
  (* Friction, amounts and states, and what shows that there is an equilibrium in them. *)
  | Equilibrium of rational & seq rational & seq stated & equilibrium_evidence
  (* Of an eigenvalue problem: about the reflected pencil; a cover of this one and a cover of the
     pencil itself ([signed_pencils]). *)
  | Reflected of evidence
  | OfBothSigns of evidence & evidence.

Inductive answered :=
  | Proved of statement
  (* The first claim that its check refuses, by its place. *)
  | ClaimRefused of nat
  | EvidenceRefused
  (* Regions that may hold the same solution, or a value that may lie beside the window. *)
  | NotToldApart.

Section Claims.

Variable p : integral.

Definition asserted_of k :=
  Asserted (claimed_from k) (claimed_to k) (claimed_support k) (claimed_biactive k).

Definition asserted_motion (c : zero_claim) := let k := motion_claim (lifted_part c) in
  Asserted (claim_from k, claim_denominator k) (claim_to k, claim_denominator k) (support k)
    (biactive k).

(* What a claim asserts, if its check accepts it; Q is the pencil of a problem without particles of
   zero reaction. *)
Definition claim_answer (Q : pencil) (c : claim_evidence) : option asserted :=
  match p, c with
  | PencilProblem _, OfPencil k | SystemProblem _ _, OfPencil k =>
      if check_solution_claim Q k then Some (asserted_of k) else None
  | SystemProblem s u, OfMotion c =>
      if check_zero (ZeroSystem s [::]) u c then Some (asserted_motion c) else None
  | ZeroProblem z u, OfMotion c => if check_zero z u c then Some (asserted_motion c) else None
  | ZeroProblem z u, OfZeroBox c =>
      if check_zero_enclosed z u c
      then Some (Asserted (box_from c) (box_to c) (box_support c)
             (resting_halves z (box_support c))) else None
  | _, _ => None
  end.

Definition in_window lo hi a := within (asserted_from a, asserted_to a) (lo, hi).

(* What the k-th claim and those behind it assert, or the place of one that is refused. *)
Fixpoint all_asserted Q lo hi k (l : seq claim_evidence) : seq asserted + nat :=
  match l with
  | [::] => inl [::]
  | c :: l' =>
      if claim_answer Q c is Some a
      then if in_window lo hi a
           then match all_asserted Q lo hi k.+1 l' with
                | inl said => inl (a :: said)
                | inr refused => inr refused
                end
           else inr k
      else inr k
  end.

Definition claims_answer Q lo hi l :=
  match all_asserted Q lo hi 0 l with
  | inl said => Proved (EachExists lo hi said)
  | inr refused => ClaimRefused refused
  end.

(* Their checks do not look at the shape of a system, nor at the pencil for z particles. *)
Definition answer_claims lo hi l :=
  match p with
  | PencilProblem Q => claims_answer Q lo hi l
  | SystemProblem s u =>
      if system_wellformed s u then claims_answer (pencil_of s u) lo hi l
      else EvidenceRefused
  | ZeroProblem _ _ => claims_answer (Pencil 0 [::] [::] [::]) lo hi l
  | PlainProblem _ => EvidenceRefused
  end.

End Claims.

Definition told (solutions : option (seq yield)) (make : seq yield -> statement) :=
  if solutions is Some ys then Proved (make ys) else NotToldApart.

(* A cover of the pencil Q, without particles of zero reaction. *)
Definition answer_cover Q lo hi (e : cover_evidence) : answered :=
  match e with
  | CoverInWindow claims c _ ls =>
      if check_families Q claims c lo hi ls
      then told (all_solutions Q claims c lo hi ls)
             (fun ys => AllInWindow lo hi
               (SolutionSet ys (families c lo hi ls) (still_open c lo hi ls)))
      else EvidenceRefused
  | CoverAtValue claims c ls =>
      if same_point lo hi && check_at_value Q lo claims c ls
      then told (all_solutions (point_pencil Q lo) claims c lo lo ls)
             (fun ys => AllInWindow lo lo
               (SolutionSet ys (families c lo lo ls) (still_open c lo lo ls)))
      else EvidenceRefused
  end.

Definition answer_zero_cover z u lo hi (e : cover_evidence) : answered :=
  match e with
  | CoverInWindow claims c bs ls =>
      if check_zero_complete z u claims c lo hi bs ls
      then told (zero_solutions z u claims c lo hi bs ls)
             (fun ys => AllInWindow lo hi (SolutionSet ys
               (zero_families c lo hi bs ls) (zero_still_open z c lo hi bs ls)))
      else EvidenceRefused
  | CoverAtValue _ _ _ => EvidenceRefused
  end.

Definition answer_infinity Q claims c ls : answered :=
  if check_infinity Q claims c ls
  then told (all_solutions (point_pencil (reverse_pencil Q) zero) claims c zero zero ls)
         (fun ys => AllAtInfinity
           (SolutionSet ys (families c zero zero ls) (still_open c zero zero ls)))
  else EvidenceRefused.

Definition check_absence z from bound (e : absence_evidence) :=
  match e with
  | ByElimination w tr => check_critical z w tr from bound
  | ByAnchors w tr => check_anchored_critical z None w tr from bound
  end.

(* A system whose unknown is lambda^2. *)
Definition zero_system_of p : option zero_system :=
  match p with
  | SystemProblem s (Lambda2 _ _) => Some (ZeroSystem s [::])
  | ZeroProblem z (Lambda2 _ _) => Some z
  | _ => None
  end.

Definition proved_if checked s := if checked then Proved s else EvidenceRefused.

Definition integral_answer p (e : evidence) : answered :=
  match e, p with
  | ClaimsIn lo hi l, _ => answer_claims p lo hi l
  | CoverOf lo hi c, PencilProblem Q => answer_cover Q lo hi c
  | CoverOf lo hi c, SystemProblem s u =>
      if system_wellformed s u then answer_cover (pencil_of s u) lo hi c else EvidenceRefused
  | CoverOf lo hi c, ZeroProblem z u => answer_zero_cover z u lo hi c
  | CoverAtInfinity _ _ _, PlainProblem _ => EvidenceRefused
  | CoverAtInfinity claims c ls, _ => answer_infinity (pencil_of_integral p) claims c ls
  | Absence from bound a, _ =>
      if zero_system_of p is Some z
      then proved_if (check_absence z from bound a) (NoneForFriction from bound)
      else EvidenceRefused
  | Presence from bound w pieces, _ =>
      if zero_system_of p is Some z
      then proved_if (check_presence z None w pieces from bound) (OneForEachFriction from bound)
      else EvidenceRefused
  | Points points, PlainProblem m => proved_if (check_mcp m points) (PointsSolve points)
  | _, _ => EvidenceRefused
  end.

(* The factors [c] are part of the evidence: any serve that make the problem integral. *)
Definition scaled_answer p c (e : evidence) : answered :=
  if scaled c p is Some q
  then if integral_wellformed q then integral_answer q e else EvidenceRefused
  else EvidenceRefused.

Definition below_zero (a : answered) := if a is Proved s then Proved (BelowZero s) else a.

(* All solutions, where both windows begin at 0. *)
Definition joined (below above : answered) : answered :=
  match below, above with
  | Proved (AllInWindow lo a c), Proved (AllInWindow lo' b c') =>
      if same_point lo zero && same_point lo' zero
      then Proved (AllOfBothSigns a b (nonzero_values c) c')
      else EvidenceRefused
  | NotToldApart, _ | _, NotToldApart => NotToldApart
  | _, _ => EvidenceRefused
  end.

(* Of an eigenvalue problem, by its pencils for t >= 0 and for t <= 0. *)
Definition signed_answer Q Q' c (e : evidence) : answered :=
  match e with
  | Reflected e => below_zero (scaled_answer (GivenPencil Q') c e)
  | OfBothSigns e e' =>
      joined (scaled_answer (GivenPencil Q') c e) (scaled_answer (GivenPencil Q) c e')
  | _ => scaled_answer (GivenPencil Q) c e
  end.

Definition answer p c (e : evidence) : answered :=
  if signed_pencils p is Some (Q, Q') then signed_answer Q Q' c e else
  match p, e with
  | GivenLoads B, Equilibrium mu amounts states w =>
      proved_if (check_equilibrium B mu amounts states (entry_scale c) w)
        (InEquilibrium mu amounts states)
  | GivenMembers B radii, MembersAbsence from bound shares unit w tr =>
      proved_if (check_radii_absent c B radii shares unit w tr from bound)
        (NoneForFriction from bound)
  | GivenMembers B radii, MembersPresence from bound shares unit w pieces =>
      proved_if (check_radii_present c B radii shares unit w pieces from bound)
        (OneForEachFriction from bound)
  | GivenSystem B _, DefiniteRates lo hi w f =>
      proved_if (check_given_rates c B lo hi w f) (OneMotionOfRates lo hi)
  | GivenSystem B _, Stable lo hi w d low high =>
      proved_if (check_given_stable c B w d lo hi low high) (StableForFriction lo hi)
  | _, _ => scaled_answer p c e
  end.

Section Sound.

Variable R : rcfType.
Implicit Types (t : R) (v : nat -> R).

Notation sem q := (integral_semantics R q).
Notation holds_of q s := (meaning_in (sem q) s).

(* Claims. *)

Lemma slip_signs s u sup bi t v j : system_wellformed s u -> (j < size (particles s))%N ->
  has_support s u sup bi t v -> let i := (free_number s + j)%N in
  [/\ i \in sup -> 0 < variables_of s v i, i \notin sup -> variables_of s v i = 0,
      i \notin sup -> i \in bi -> slip_row s u t v j = 0 &
      i \notin sup -> i \notin bi -> 0 < slip_row s u t v j].
Proof.
move=> wf lt_j sup_v; have [neg zero bia cone_neg] := sup_v _ lt_j.
have l2 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0 // (unit_length_gt0 R wf).
rewrite /= /variables_of ltnNge leq_addr /= addKn; split.
- by move/neg => rate_neg; rewrite oppr_gt0 pmulr_llt0 ?invr_gt0.
- by move/zero ->; rewrite mul0r oppr0.
- by move=> out in_bi; rewrite /slip_row bia // oppr0.
by move=> out out_bi; rewrite /slip_row oppr_gt0 cone_neg.
Qed.

Lemma system_signs s u sup bi t v : system_wellformed s u -> has_support s u sup bi t v ->
  has_signs (sem (SystemProblem s u)) sup bi t v.
Proof.
move=> wf sup_v j; rewrite /= system_slips size_iota => lt_j; rewrite nth_iota //.
exact: slip_signs.
Qed.

Lemma zero_signs z u sup bi t v : zero_wellformed z u ->
  has_support (without_zero z) u sup bi t v -> has_zero_support z u sup bi t v ->
  has_signs (sem (ZeroProblem z u)) sup bi t v.
Proof.
move=> wf sup_v sup_z j; rewrite /= size_slips => lt_j; rewrite zero_slips nth_iota //.
set s := without_zero z in sup_v *; set ns := size (particles s).
have i_slip : (free_number s + j)%N \in slip (zero_pencil z u).
  by rewrite zero_slips mem_iota leq_addr ltn_add2l.
have [pos zero] := support_moves wf sup_v sup_z i_slip.
have sign : (free_number s + j)%N \notin sup ->
    row_sign (free_number s + j)%N sup bi (- z_row z u t v j).
  move=> out; rewrite /z_row -/s -/ns; have [lt_s|ge_s] := ltnP j ns.
    have [_ _ zero_row neg_row] := sup_v _ lt_s; rewrite /slip_row opprK /row_sign (negbTE out).
    by case: ifPn => in_bi; [apply: zero_row | apply: neg_row].
  have lt_q : ((j - ns) %/ 3 < size (zero_particles z))%N by rewrite ltn_divLR // mulnC ltn_subLR.
  have [_ pressure _ right_row left_row] := sup_z _ lt_q.
  have -> : (free_number s + j = gap z ((j - ns) %/ 3) + (j - ns) %% 3)%N.
    by rewrite /gap -/s -/ns -addnA [(3 * _)%N]mulnC -divn_eq -addnA subnKC.
  have : ((j - ns) %% 3 < 3)%N by rewrite ltn_mod.
  case: (_ %% 3)%N => [|[|[|]]] // _ /=; rewrite ?addn0 ?addn1 ?addn2 ?opprK //.
    by rewrite opprB addrC.
  by rewrite opprD !opprK.
split=> // out.
  by move=> in_bi; have := sign out; rewrite /row_sign in_bi orbT => /eqP; rewrite oppr_eq0 => /eqP.
by move=> out_bi; have := sign out; rewrite /row_sign (negbTE out) (negbTE out_bi) oppr_lt0.
Qed.

Lemma pencil_claim Q k lo hi : check_solution_claim Q k -> in_window lo hi (asserted_of k) ->
  asserted_holds (sem (PencilProblem Q)) lo hi (asserted_of k).
Proof.
move=> ok inside; have [t [x [bt sol signs]]] := solution_claim_sound R ok.
exists t, x; split=> //; first exact: (within_between inside bt).
by move=> j lt_j; apply: signs; apply: mem_nth.
Qed.

Lemma system_claim_holds s u k lo hi : system_wellformed s u ->
  check_solution_claim (pencil_of s u) k -> in_window lo hi (asserted_of k) ->
  asserted_holds (sem (SystemProblem s u)) lo hi (asserted_of k).
Proof.
move=> wf ok inside; have [t [x [bt sol signs]]] := solution_claim_sound R ok.
exists t, (motion s x); split=> //; first exact/(system_pencil wf).
  exact: (within_between inside bt).
exact/system_signs/motion_support.
Qed.

Definition needs_wellformed p :=
  if p is SystemProblem s u then is_true (system_wellformed s u) else True.

Definition pencil_for_claims p :=
  match p with
  | PencilProblem _ | SystemProblem _ _ => pencil_of_integral p
  | _ => Pencil 0 [::] [::] [::]
  end.

Lemma motion_claim_sound z u c : check_zero z u c -> exists t : R,
  let k := motion_claim (lifted_part c) in let v := v_at (lifted_part c) t in
  [/\ between t (asserted_from (asserted_motion c)) (asserted_to (asserted_motion c)),
      satisfies_9z z u t v, has_support (without_zero z) u (support k) (biactive k) t v &
      has_zero_support z u (support k) (biactive k) t v].
Proof.
move=> /(zero_sound R)[t [[from_t t_to] sat _ sup sup_z]]; exists t; split=> //.
by rewrite /between /= ![t * _]mulrC.
Qed.

Lemma claim_answer_sound p c a lo hi : needs_wellformed p ->
  claim_answer p (pencil_for_claims p) c = Some a -> in_window lo hi a ->
  asserted_holds (sem p) lo hi a.
Proof.
case: p => [Q|s u|z u|m] /= wf; case: c => [k|c|c] //=; case: ifP => // ok [<-] inside.
- exact: pencil_claim.
- exact: system_claim_holds.
- have [t [bt [t0 /no_zero_particles sat] sup _]] := motion_claim_sound ok.
  exists t, (v_at (lifted_part c) t); split; last exact: system_signs.
  - exact/satisfies_9E.
  - exact: (within_between inside bt).
  exact: bt.
- have wf_z : zero_wellformed z u by case/and5P: ok.
  have [t [bt sat sup sup_z]] := motion_claim_sound ok.
  exists t; eexists; split; [exact: sat | exact: (within_between inside bt) | exact: bt |].
  exact: zero_signs.
have wf_z : zero_wellformed z u by case/and4P: ok.
have [t [v [bt sat sup sup_z _]]] := zero_enclosed_sound R ok.
exists t, v; split=> //; first exact: (within_between inside bt).
exact: zero_signs.
Qed.

Lemma claims_sound p lo hi l s : needs_wellformed p ->
  claims_answer p (pencil_for_claims p) lo hi l = Proved s -> holds_of p s.
Proof.
move=> wf; rewrite /claims_answer; case eq: (all_asserted _ _ _ _ _ _) => [said|//] [<-].
rewrite /=.
elim: l 0%N said eq => [|c l IH] k said /=; first by case=> <-.
case eq_a: (claim_answer _ _ _) => [a|//]; case: ifP => // inside.
case eq_l: (all_asserted _ _ _ _ _ _) => [said'|//] [<-]; constructor; last exact: IH eq_l.
exact: claim_answer_sound eq_a inside.
Qed.

Lemma answer_claims_sound p lo hi l s : answer_claims p lo hi l = Proved s -> holds_of p s.
Proof.
case: p => [Q|sys u|z u|m] //=; first exact: (@claims_sound (PencilProblem Q)).
  by case: ifP => // wf; apply: (@claims_sound (SystemProblem sys u)).
exact: (@claims_sound (ZeroProblem z u)).
Qed.

(* Covers. *)

Lemma answer_cover_sound Q lo hi e s : answer_cover Q lo hi e = Proved s ->
  holds_of (PencilProblem Q) s.
Proof.
case: e => [claims c _ ls|claims c ls] /=.
  case: ifP => // ok; rewrite /told; case eq: (all_solutions _ _ _ _ _ _) => [ys|//] [<-] /=.
  by split; [apply/solutions_are; apply: (families_number R ok eq) | apply: (families_hold R ok)].
case: ifP => // /andP[_ ok]; rewrite /told.
case eq: (all_solutions _ _ _ _ _ _) => [ys|//] [<-] /=.
split; first by apply/solutions_are; apply: (point_number R ok eq).
by move=> f /(point_hold R ok)[].
Qed.

(* The motions of a system with this pencil. *)
Lemma system_cover_sound sys u lo hi c s : system_wellformed sys u ->
  answer_cover (pencil_of sys u) lo hi c = Proved s -> holds_of (SystemProblem sys u) s.
Proof.
move=> wf is_s; have := answer_cover_sound is_s.
have [lo' [hi' [set ->]]] : exists lo' hi' set, s = AllInWindow lo' hi' set.
  case: c is_s => [claims c _ ls|claims c ls] /=; case: ifP => // _; rewrite /told;
    case: (X in if X is Some _ then _ else _) => [ys|//] [<-]; do 3 eexists;
    reflexivity.
case=> /solutions_are number each; split; last by move=> f /each; apply: (motions_hold wf).
exact/solutions_are/(motions_number wf number).
Qed.

Lemma zero_cover_sound z u lo hi e s : answer_zero_cover z u lo hi e = Proved s ->
  holds_of (ZeroProblem z u) s.
Proof.
case: e => [claims c bs ls|//] /=; case: ifP => // ok; rewrite /told.
case eq: (zero_solutions _ _ _ _ _ _ _ _) => [ys|//] [<-]; rewrite /=.
split; last exact: (zero_complete_hold R ok eq).
exact/solutions_are/(zero_complete_number R ok eq).
Qed.

Lemma infinity_sound p claims c ls s : (if p is PlainProblem _ then False else True) ->
  answer_infinity (pencil_of_integral p) claims c ls = Proved s -> holds_of p s.
Proof.
move=> is_pencil; rewrite /answer_infinity; case: ifP => // ok; rewrite /told.
case eq: (all_solutions _ _ _ _ _ _) => [ys|//] [<-] /=; exists (pencil_of_integral p); split.
- by case: p is_pencil {ok eq}.
- exact: (infinity_number R ok eq).
by move=> f; apply: (infinity_hold R ok).
Qed.

(* Intervals of friction. *)

Lemma absence_sound z from bound a : check_absence z from bound a ->
  forall (mu : R) t v, between mu from bound -> 0 <= t -> conditions_9z z t mu v -> False.
Proof.
by case: a => w tr /= ok mu t v bm t0; [apply: (zero_critical_absent ok t0 bm) |
  apply: (zero_anchored_critical_absent ok t0 bm)].
Qed.

Lemma absence_flat z from bound a : check_absence z from bound a -> flat (without_zero z).
Proof. by case: a => w tr /= /and3P[/zero_wellformed_flat]. Qed.

Lemma moves_of_system p z : zero_system_of p = Some z -> flat (without_zero z) ->
  exists2 moves, moves_at (sem p) = Some moves &
    forall t mu v, moves t mu v <-> conditions_9z z t mu v.
Proof.
case: p => //= [s [|? ?]|z' [|? ?]] // [<-] /= ->; first exists (conditions_9 (R := R) s) => // *.
  by split=> /no_zero_particles.
by exists (conditions_9z (R := R) z').
Qed.

Lemma integral_sound p e s : integral_answer p e = Proved s -> holds_of p s.
Proof.
case: e =>
  [lo hi l|lo hi c|claims c ls|from bound a|from bound w pieces|? ? ? ? ? ?|? ? ? ? ? ?|? ? ? ?|
   ? ? ? ? ? ?|points|? ? ? ?|?|? ?].
- exact: answer_claims_sound.
- case: p => [Q|sys u|z u|m] //=; first exact: answer_cover_sound.
    by case: ifP => // wf; apply: system_cover_sound.
  exact: zero_cover_sound.
- by case: p => [Q|sys u|z u|m] //; apply: infinity_sound.
- rewrite /= /proved_if; case eq: (zero_system_of p) => [z|] //; case: ifP => // ok [<-] /=.
  have [moves -> iff] := moves_of_system eq (absence_flat ok).
  by move=> mu t v bm t0 /iff; apply: (absence_sound ok).
- rewrite /= /proved_if; case eq: (zero_system_of p) => [z|] //; case: ifP => // ok [<-] /=.
  have is_flat : flat (without_zero z) by case/and4P: ok => /zero_wellformed_flat.
  have [moves -> iff] := moves_of_system eq is_flat => mu bm.
  have [t [v [t0 sat]]] := zero_presence_sound ok bm.
  by exists t, v; split=> //; apply/iff.
- by case: p.
- by case: p.
- by case: p.
- by case: p.
- case: p => // m; rewrite /= /proved_if; case: ifP => // ok [<-] /=.
  split; last exact: plain_mcp_sound.
  by case/and3P: ok => _ some _ none; rewrite none in some.
all: by case: p.
Qed.

Lemma scaled_sound p c e s : scaled_answer p c e = Proved s -> meaning R p s.
Proof.
rewrite /scaled_answer; case is_q: (scaled c p) => [q|] //; case: ifP => // wf /integral_sound.
exact: scaled_meaning is_q wf.
Qed.

(* Of an eigenvalue problem, with both of its pencils. *)
Section Signed.

Variables (n : nat) (numbers : seq nat) (solved : R -> (nat -> R) -> Prop).
Variables (rows : R -> (nat -> R) -> nat -> R) (above below Q Q' : rational_pencil).

Notation semantics_above := (from_zero_semantics n numbers solved rows above).
Notation semantics_below := (below_zero_semantics n numbers solved rows below).

Hypothesis of_above :
  forall s, meaning_in (pencil_semantics R Q) s -> meaning_in semantics_above s.
Hypothesis of_below :
  forall s, meaning_in (pencil_semantics R Q') s -> meaning_in semantics_below s.

Definition signed_meaning s :=
  match s with
  | BelowZero s => meaning_in semantics_below s
  | AllOfBothSigns a b c c' => both_signs_mean semantics_below semantics_above solved a b c c'
  | s => meaning_in semantics_above s
  end.

Lemma joined_sound c e e' s :
  joined (scaled_answer (GivenPencil Q') c e) (scaled_answer (GivenPencil Q) c e') = Proved s ->
  signed_meaning s.
Proof.
case: scaled_answer (@scaled_sound (GivenPencil Q') c e) => [s1|?||];
  case: scaled_answer (@scaled_sound (GivenPencil Q) c e') => [s2|?||] //; try by case: s1.
move=> /(_ _ erefl)/of_above + /(_ _ erefl)/of_below.
case: s1 => //; case: s2 => // lo b all_above lo' a all_below.
move=> [all' each'] [all each] /=; case: ifP => // /andP[/same_point_eq eq /same_point_eq eq'] [<-].
rewrite eq in all; rewrite eq' in all'; split=> //; first exact: both_signs.
by move=> f /in_filter[/each].
Qed.

Lemma signed_sound c e s : signed_answer Q Q' c e = Proved s -> signed_meaning s.
Proof.
have plain : scaled_answer (GivenPencil Q) c e = Proved s -> signed_meaning s.
  by move=> /scaled_sound/of_above; case: s.
case: e plain => [???|???|???|???|????|??????|??????|?????|??????|?|????|e|e e'] // _;
  last exact: joined_sound.
rewrite /= /below_zero; case eq: (scaled_answer _ _ _) => [s'|||] // [<-].
exact: of_below (scaled_sound eq).
Qed.

End Signed.

Theorem answer_sound p c e s : answer p c e = Proved s -> meaning R p s.
Proof.
case: p => [Q|Q|q|B u|B radii|rows|B]; rewrite /answer /signed_pencils; try exact: scaled_sound.
- have of_below s' := equivalent_meaning (reflected_equivalent R Q) (s := s').
  by move=> /(signed_sound (fun=> id) of_below); case: s.
- have of_below s' : meaning_in (pencil_semantics R (linearized (reflected_quadratic q))) s' ->
      meaning_in (negative_quadratic_semantics R q) s'.
    move=> /(equivalent_meaning (linearized_equivalent R (reflected_quadratic q))).
    exact: (equivalent_meaning (reflected_quadratic_equivalent R q)).
  have of_above s' := equivalent_meaning (linearized_equivalent R q) (s := s').
  by move=> /(signed_sound of_above of_below); case: s.
- case: e => [???|???|???|???|????|??????|??????|lo hi w ends|lo hi w d low high|?|????|?|??];
    try exact: scaled_sound.
    by rewrite /= /proved_if; case: ifP => // ok [<-] mu; apply: (rates_sound ok).
  by rewrite /= /proved_if; case: ifP => // ok [<-] mu bm _; apply: (stability_sound ok bm).
- case: e => //= [from bound shares unit w tr|from bound shares unit w pieces]; rewrite /proved_if;
    case: ifP => // ok [<-]; have /andP[ex _] := ok; split; rewrite ?(radii_no_zero ex) //.
    have /and3P[_ _ /and3P[/(radii_flat ex) is_flat _ _]] := (andP ok).2.
    by split=> // k m factor member mu t v; apply: (radii_absent ok member).
  have /andP[_ /and4P[/(radii_flat ex) is_flat _ _ _]] := (andP ok).2.
  by split=> // k m factor member mu; apply: (radii_present ok member).
case: e => //= mu amounts states w; rewrite /proved_if; case: ifP => // ok [<-].
exact: equilibrium_sound ok.
Qed.

End Sound.
