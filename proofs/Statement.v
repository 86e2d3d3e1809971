(* Statements about a problem, and what they mean.

   The program prints a statement only if [answer] of Verdict.v gives it, and then it is true
   ([answer_sound]).  Whoever reads this file knows what has been proved; it uses the problem as it
   is written (Rational.v), regions and places of values (Tree.v, Signs.v), and at infinity the
   pencil of a system (Points.v).

   A problem is a pencil, an eigenvalue problem, a mechanical system, a plain mixed complementarity
   problem or a body under loads.  Pencils and systems have *solutions*: a value t >= 0 and a
   vector, x of a pencil or a motion v of a system.  The motion satisfies the conditions (9), for
   values of lambda^2 and mu:

       w = (K + lambda^2 M) v,    v != 0,    v = 0 at particles that stick,
       w = 0 at degrees of freedom of no particle in contact,

   for each slip particle, with its friction factor c, its sign S and its geometric stiffness g,

       n'v = 0,    S t'v <= 0,    s <= 0,    s S t'v = 0,
       s = S t'w + c mu n'w + (1 + c^2 mu^2) g S t'v,

   where g is the curvature of the obstacle times the normal reaction at equilibrium, 0 where the
   obstacle is flat; and for each particle with zero reaction the lines of [zero_reaction]
   (ZeroReaction.v).

   On curved obstacles (9) is about rates: a solution says that the motion linearised about the
   equilibrium grows.  g belongs to the equilibrium at one friction, so statements about an interval
   of friction, about all loads and about stability are of flat obstacles ([flat_body]).

   An eigenvalue problem is a pencil of which the value t may have either sign, or a quadratic
   problem, about A + t B + t^2 C.  Statements speak of its solutions with t <= 0 as of those of
   (A, -B) or (A, -B, C), whose value is -t: in windows, intervals, regions and places stands -t
   for t ([BelowZero], [below_zero_semantics]).

   A body with radii stands for its *members*; a statement about it is about each of them
   ([given_member], [member_moves]).

   A body under loads has *equilibria*: displacements u with reactions that satisfy (1), (5) and (7)
   ([in_equilibrium]).  While a load grows, a system moves at the rates of [rates_under].

   An equilibrium is *stable* if its small motions lose energy as [stable_at] says: the hypothesis
   of the theorem of stability, whose part about time is not in this file.

   Vectors that are positive multiples of each other are one solution.  Each complementarity
   variable has a *rate* (x_i; how fast a particle slips or opens) and a *row* (y_i), of which one
   is 0.  [meaning] says for each kind of statement what it means in a real closed field.

   Pages: spec/certificates.md, 5.1, 5.2, 5.15, 5.20, 5.23; spec/zero-reaction.md, Z.1;
   spec/curvature.md, K.1. *)

From Mceip Require Import Base Integers Sums Tree Cover Pencil System Signs Support Families
  ZeroReaction PlainMcp Points Rational.

(* Each solution listed lies in the region that is yielded for it.  Every other one belongs to a
   family or lies in an open region. *)
Record solution_set := SolutionSet {
  solutions_in : seq yield;
  families_of_set : seq family;
  open_regions : seq region }.

(* A solution with a value between these ends, with this support.  Off the support the rows are 0 at
   biactive variables, and positive elsewhere. *)
Record asserted := Asserted {
  asserted_from : point;
  asserted_to : point;
  asserted_support : seq nat;
  asserted_biactive : seq nat }.

(* The contact state of a candidate at an equilibrium: not in contact; it sticks, at this tangential
   displacement; in impending slip, S the sign of its tangential reaction; in contact without
   reaction. *)
Inductive stated := Apart | SticksAt of rational | SlipsWith of Z | WithoutReaction.

Inductive statement :=
  (* Each of these solutions exists, with its value in the window. *)
  | EachExists of point & point & seq asserted
  (* All solutions in the window. *)
  | AllInWindow of point & point & solution_set
  (* All solutions at infinity. *)
  | AllAtInfinity of solution_set
  (* No solution for a friction between these two and lambda^2 >= 0; of a body with radii, of no
     member. *)
  | NoneForFriction of point & point
  (* A solution with some lambda^2 >= 0 for each friction between these two; of each member. *)
  | OneForEachFriction of point & point
  (* In these contact states, for each friction between these two, at most one motion of the
     quasi-static rate problem, whatever load grows. *)
  | OneMotionOfRates of point & point
  (* In these contact states the equilibrium is stable, for each friction between these two. *)
  | StableForFriction of point & point
  (* Each of these points solves the plain problem. *)
  | PointsSolve of seq mcp_point
  (* With this friction, and so much of each load, an equilibrium with the candidates in these
     states. *)
  | InEquilibrium of rational & seq rational & seq stated
  (* Of an eigenvalue problem, about its solutions with values t <= 0: for t stands -t. *)
  | BelowZero of statement
  (* Of an eigenvalue problem: all solutions with -a <= t <= b, those with t <= 0, for which -t
     stands, and those with t >= 0. *)
  | AllOfBothSigns of point & point & solution_set & solution_set.

Definition opposite (a : point) : point := (- a.1, a.2)%Z.

(* In one of the sets each solution has a value other than 0. *)
Definition told_apart (below above : solution_set) :=
  let positive (y : yield) := (0 <? (yield_from y).1)%Z in
  all positive (solutions_in below) || all positive (solutions_in above).

Section Meaning.

Variable R : rcfType.
Implicit Types (t mu : R) (v : nat -> R).

(* What a problem asks for.  Complementarity variables have numbers; rates and rows are given by
   their positions among them. *)
Record semantics := Semantics {
  variables : seq nat;
  solves : R -> (nat -> R) -> Prop;
  same : (nat -> R) -> (nat -> R) -> Prop;
  rate : (nat -> R) -> nat -> R;
  row : R -> (nat -> R) -> nat -> R;
  (* Of a system on flat obstacles whose unknown is lambda^2: the motion satisfies (9) at lambda^2
     and mu. *)
  moves_at : option (R -> R -> (nat -> R) -> Prop);
  (* Pencils of which the solutions at infinity are those of the problem. *)
  has_pencil : pencil -> Prop;
  (* Of a plain problem. *)
  solved_by : option ((nat -> R) -> Prop) }.

(* v' is a positive multiple of v, in its first n components. *)
Definition multiples n v v' := exists2 f, 0 < f & forall i, i \in iota 0 n -> v' i = f * v i.

Definition fraction (q : rational) : R := toR q.1 / toR q.2.

(* An entry of a matrix. *)
Definition given_entry (rows : seq rational_row) i j : R :=
  \sum_(e <- nth [::] rows i) (if e.1 == j then fraction e.2 else 0).

(* Row i of (A + t B) x. *)
Definition product n (a b : seq rational_row) t v i : R :=
  \sum_(j <- iota 0 n) (given_entry a i j + t * given_entry b i j) * v j.

(* What vectors x of n variables, of which these numbers are complementary, solve with values t of
   either sign. *)
Section Values.

Variables (n : nat) (numbers : seq nat) (solved : R -> (nat -> R) -> Prop).
Variable y : R -> (nat -> R) -> nat -> R.

(* The solutions with t >= 0; this pencil has those at infinity. *)
Definition from_zero_semantics Q := Semantics numbers (fun t x => 0 <= t /\ solved t x)
  (multiples n) (fun x j => x (nth 0%N numbers j)) (fun t x j => y t x (nth 0%N numbers j)) None
  (fun Q' => exists c, scaled c (GivenPencil Q) = Some (PencilProblem Q')) None.

End Values.

(* The solutions with t <= 0, for which s = -t stands. *)
Definition below_zero_semantics n numbers (solved : R -> (nat -> R) -> Prop)
    (y : R -> (nat -> R) -> nat -> R) Q :=
  from_zero_semantics n numbers (fun s => solved (- s)) (fun s => y (- s)) Q.

Section Pencil.

Variable Q : rational_pencil.

Notation y t x i := (product (given_order Q) (given_a Q) (given_b Q) t x i).
Notation numbers := (complementarity (GivenPencil Q)).

(* The value t may have either sign. *)
Definition eigenvalue_solves t x :=
  [/\ exists2 i, i \in iota 0 (given_order Q) & x i != 0,
      forall i, i \in given_free Q -> y t x i = 0 &
      forall i, i \in numbers -> [/\ 0 <= x i, 0 <= y t x i & x i * y t x i = 0]].

Definition pencil_semantics :=
  from_zero_semantics (given_order Q) numbers eigenvalue_solves (fun t x i => y t x i) Q.

Definition negative_semantics := below_zero_semantics (given_order Q) numbers eigenvalue_solves
  (fun t x i => y t x i) (reflected Q).

End Pencil.

Section Quadratic.

Variable q : rational_quadratic.

Notation n := (quadratic_order q).

(* Row i of (A + t B + t^2 C) x. *)
Definition quadratic_product t v i : R := \sum_(j <- iota 0 n)
  (given_entry (quadratic_a q) i j + t * given_entry (quadratic_b q) i j +
   t ^+ 2 * given_entry (quadratic_c q) i j) * v j.

(* The value t may have either sign. *)
Definition quadratic_solves t x :=
  (exists2 i, i \in iota 0 n & x i != 0) /\
  forall i, i \in iota 0 n ->
    [/\ 0 <= x i, 0 <= quadratic_product t x i & x i * quadratic_product t x i = 0].

Definition quadratic_semantics :=
  from_zero_semantics n (iota 0 n) quadratic_solves quadratic_product (linearized q).

Definition negative_quadratic_semantics := below_zero_semantics n (iota 0 n) quadratic_solves
  quadratic_product (linearized (reflected_quadratic q)).

End Quadratic.

Notation nobody := (GivenParticle 0 0 NotInContact ((0, 1), (0, 1)) ((0, 1), (0, 1)) 0 (0, 1))%Z.

Section System.

Variables (B : rational_system) (u : unknown).

(* w_d *)
Definition force_of lambda2 v d :=
  product (degrees B) (given_stiffness B) (given_mass B) lambda2 v d.

(* t'f and n'f at a particle; the normal has length 1. *)
Definition tangential p (f : nat -> R) :=
  fraction (frame_tangent p).1 * f (first_of p) + fraction (frame_tangent p).2 * f (second_of p).

Definition normal_to p (f : nat -> R) := toR (into_obstacle p) *
  (fraction (frame_normal p).1 * f (first_of p) + fraction (frame_normal p).2 * f (second_of p)).

(* S t'w + c mu n'w + (1 + c^2 mu^2) g S t'v *)
Definition cone_of lambda2 mu v p := let w := force_of lambda2 v in
  toR (sign p) * tangential p w + fraction (factor_of p) * mu * normal_to p w +
  (1 + (fraction (factor_of p) * mu) ^+ 2) * fraction (geometric_of p) *
  (toR (sign p) * tangential p v).

Definition slip_at j := nth nobody (slipping B) j.
Definition zero_at j := nth nobody (with_zero B) j.

(* (9) *)
Definition motion_conditions lambda2 mu v :=
  let w := force_of lambda2 v in
  [/\ exists2 d, d \in iota 0 (degrees B) & v d != 0,
      forall d, d \in iota 0 (degrees B) ->
        d \in dofs_of [seq p <- given_particles B | sticks p] -> v d = 0,
      forall d, d \in iota 0 (degrees B) -> d \notin held B -> w d = 0,
      forall j, (j < size (slipping B))%N -> let p := slip_at j in
        [/\ normal_to p v = 0, toR (sign p) * tangential p v <= 0, cone_of lambda2 mu v p <= 0 &
            cone_of lambda2 mu v p * (toR (sign p) * tangential p v) = 0] &
      forall j, (j < size (with_zero B))%N -> let p := zero_at j in
        zero_reaction (fraction (factor_of p) * mu) (normal_to p v) (tangential p v)
                      (normal_to p w) (tangential p w)].

(* The motion of the body, quasi-static and in these contact states, while a load grows at the rate
   f: (9) with w = K v - f, without v != 0. *)
Definition rates_under (f : nat -> R) mu v :=
  let w d := force_of 0 v d - f d in
  [/\ forall d, d \in iota 0 (degrees B) ->
        d \in dofs_of [seq p <- given_particles B | sticks p] -> v d = 0,
      forall d, d \in iota 0 (degrees B) -> d \notin held B -> w d = 0 &
      forall j, (j < size (slipping B))%N -> let p := slip_at j in
        let slide := toR (sign p) * tangential p v in
        let cone := toR (sign p) * tangential p w + fraction (factor_of p) * mu * normal_to p w in
        [/\ normal_to p v = 0, slide <= 0, cone <= 0 & cone * slide = 0]].

(* Of a body on flat obstacles without particles of zero reaction, with friction. *)
Definition one_motion_of_rates mu := [/\ with_zero B = [::], flat_body B, 0 < mu &
  forall f v v', rates_under f mu v -> rates_under f mu v' ->
    forall d, d \in iota 0 (degrees B) -> v d = v' d].

(* Small motions about the equilibrium: displacements v, velocities r and accelerations a of the
   degrees of freedom.  M a; the slide of each slip particle in its direction; and for forces f how
   far its reaction is from the cone. *)
Definition inertia_of a d :=
  \sum_(j <- iota 0 (degrees B)) given_entry (given_mass B) d j * a j.

Definition slide v j := - (toR (sign (slip_at j)) * tangential (slip_at j) v).

Definition cone_margin mu (f : nat -> R) j := let p := slip_at j in
  - (toR (sign p) * tangential p f + fraction (factor_of p) * mu * normal_to p f).

Definition inner_product (v f : nat -> R) := \sum_(d <- iota 0 (degrees B)) v d * f d.

Notation sliding := (iota 0 (size (slipping B))).

(* What sticks does not move, and slip particles keep their contact. *)
Definition admissible v :=
  (forall d, d \in iota 0 (degrees B) ->
     d \in dofs_of [seq p <- given_particles B | sticks p] -> v d = 0) /\
  (forall j, j \in sliding -> normal_to (slip_at j) v = 0).

Definition free_of_forces (f : nat -> R) :=
  forall d, d \in iota 0 (degrees B) -> d \notin held B -> f d = 0.

(* The laws at an instant of a motion that begins in contact.  A particle whose margin is not 0
   rests, so that its acceleration is 0 too, but for instants of measure 0. *)
Definition at_an_instant mu v r a := let f d := force_of 0 v d + inertia_of a d in
  [/\ admissible v, admissible r, admissible a, free_of_forces f &
      forall j, j \in sliding ->
        [/\ 0 <= slide r j, 0 <= cone_margin mu f j, slide r j * cone_margin mu f j = 0 &
            slide a j * cone_margin mu f j = 0]].

(* u follows the slip particles of v without inertia. *)
Definition carried u v :=
  [/\ admissible u, free_of_forces (force_of 0 u) &
      forall j, j \in sliding -> slide u j = slide v j].

(* There are a form Q, slopes b >= 0 and drifts theta >= 0 with

       x'Q x - (b'x)^2 / 4 > 0   for x >= 0, x != 0,
       T_ij >= Q_ij + theta_i,   where T x are the margins of what is carried with the slides x,

   and for each small motion v = u + e, r = w + g with u carried by v and w by r, at any instant,

       r'M a + g'K e <= sum_i y_i (- (T x)_i + theta_i sum_j |x_j| + b_i sqrt (e'K e)),

   x the slides of v and y those of r.  The left side is the derivative of (r'M r + e'K e)/2. *)
Definition loses_energy mu (form : nat -> nat -> R) (slope drift : nat -> R) :=
  [/\ forall i j, i \in sliding -> j \in sliding -> form i j = form j i,
      forall i, i \in sliding -> 0 <= slope i /\ 0 <= drift i,
      forall x, (forall i, i \in sliding -> 0 <= x i) ->
        (exists2 i, i \in sliding & x i != 0) ->
        0 < \sum_(i <- sliding) \sum_(j <- sliding) x i * form i j * x j -
            (\sum_(i <- sliding) slope i * x i) ^+ 2 / 4%:R,
      forall u, carried u u -> (forall j, j \in sliding -> 0 <= slide u j) ->
        forall i, i \in sliding ->
        \sum_(j <- sliding) (form i j + drift i) * slide u j <= cone_margin mu (force_of 0 u) i &
      forall v r a u w e g, at_an_instant mu v r a -> carried u v -> carried w r ->
        (forall d, e d = v d - u d) -> (forall d, g d = r d - w d) ->
        inner_product r (inertia_of a) + inner_product g (force_of 0 e) <=
        \sum_(i <- sliding) slide r i *
          (- cone_margin mu (force_of 0 u) i + drift i * (\sum_(j <- sliding) `|slide v j|) +
           slope i * Num.sqrt (inner_product e (force_of 0 e)))].

(* Energy is positive, and so its derivative is as above. *)
Definition definite_energy := exists m k,
  [/\ 0 < m, 0 < k,
      forall v, admissible v -> m * inner_product v v <= inner_product v (inertia_of v),
      forall v, admissible v -> (forall j, j \in sliding -> slide v j = 0) ->
        k * inner_product v v <= inner_product v (force_of 0 v) &
      forall v w, admissible v -> admissible w ->
        inner_product v (inertia_of w) = inner_product w (inertia_of v) /\
        inner_product v (force_of 0 w) = inner_product w (force_of 0 v)].

Definition stable_at mu := [/\ with_zero B = [::], flat_body B, definite_energy &
  exists form slope drift, loses_energy mu form slope drift].

(* A member: symmetric matrices k and m within the radii, and a positive friction factor of each
   slip particle within its ends. *)
Definition given_member radii (k m : nat -> nat -> R) (c : nat -> R) :=
  [/\ forall d e, d \in iota 0 (degrees B) -> e \in iota 0 (degrees B) ->
        k d e = k e d /\ m d e = m e d,
      forall d e, d \in iota 0 (degrees B) -> e \in iota 0 (degrees B) ->
        `|k d e - given_entry (given_stiffness B) d e| <=
        given_entry (radii_of_stiffness radii) d e,
      forall d e, d \in iota 0 (degrees B) -> e \in iota 0 (degrees B) ->
        `|m d e - given_entry (given_mass B) d e| <= given_entry (radii_of_mass radii) d e &
      forall j, (j < size (slipping B))%N ->
        let range := nth ((0, 1), (0, 1))%Z (factor_ranges radii) j in
        0 < c j /\ fraction range.1 <= c j <= fraction range.2].

(* (9) for a member of a body on flat obstacles without particles of zero reaction. *)
Definition member_moves (k m : nat -> nat -> R) (c : nat -> R) lambda2 mu v :=
  let w d := \sum_(e <- iota 0 (degrees B)) (k d e + lambda2 * m d e) * v e in
  [/\ exists2 d, d \in iota 0 (degrees B) & v d != 0,
      forall d, d \in iota 0 (degrees B) ->
        d \in dofs_of [seq p <- given_particles B | sticks p] -> v d = 0,
      forall d, d \in iota 0 (degrees B) -> d \notin held B -> w d = 0 &
      forall j, (j < size (slipping B))%N -> let p := slip_at j in
        let slide := toR (sign p) * tangential p v in
        let cone := toR (sign p) * tangential p w + c j * mu * normal_to p w in
        [/\ normal_to p v = 0, slide <= 0, cone <= 0 & cone * slide = 0]].

Definition lambda2_at t := if u is Lambda2 _ _ then t else 0.
Definition friction_at t := if u is Lambda2 m q then fraction (m, q) else t.

Definition system_solves t v := 0 <= t /\ motion_conditions (lambda2_at t) (friction_at t) v.

(* -S t'v of the slip particles; behind them gap -n'v, and of t'v the positive and the negative
   part. *)
Definition rate_of v j :=
  let k := (j - size (slipping B))%N in
  let p := zero_at (k %/ 3) in
  let slide := tangential p v in
  if (j < size (slipping B))%N then - (toR (sign (slip_at j)) * tangential (slip_at j) v)
  else nth 0 [:: - normal_to p v; if 0 < slide then slide else 0;
                 if slide < 0 then - slide else 0] (k %% 3).

(* -s of the slip particles; -n'w, t'w - c mu n'w, -t'w - c mu n'w *)
Definition row_of t v j :=
  let k := (j - size (slipping B))%N in
  let p := zero_at (k %/ 3) in
  let w := force_of (lambda2_at t) v in
  let friction := fraction (factor_of p) * friction_at t * normal_to p w in
  if (j < size (slipping B))%N then - cone_of (lambda2_at t) (friction_at t) v (slip_at j)
  else nth 0 [:: - normal_to p w; tangential p w - friction; - tangential p w - friction]
         (k %% 3).

Definition system_semantics := Semantics (complementarity (GivenSystem B u)) system_solves
  (multiples (degrees B)) rate_of row_of
  (if u is Lambda2 _ _ then if flat_body B then Some motion_conditions else None else None)
  (fun Q => exists c q, scaled c (GivenSystem B u) = Some q /\ pencil_of_integral q = Q) None.

End System.

(* z solves a plain problem with F = M z + q. *)
Definition solves_given (rows : seq rational_mcp_row) (z : nat -> R) :=
  forall i, (i < size rows)%N ->
  let r := nth (RationalMcpRow [::] (0, 1)%Z None None) rows i in
  let F := \sum_(j <- iota 0 (size rows))
             given_entry [seq given_m r | r <- rows] i j * z j + fraction (given_q r) in
  [/\ above (given_lower r) (z i), below (given_upper r) (z i),
      ~ meets (given_upper r) (z i) -> 0 <= F & ~ meets (given_lower r) (z i) -> F <= 0].

Section Loads.

Variables (B : rational_body) (mu : rational) (amounts : seq rational) (states : seq stated).
Implicit Types u r : nat -> R.

(* The sum of the amounts of all loads, at a degree of freedom. *)
Definition applied (part : load -> rational_row) (d : nat) : R :=
  \sum_(l <- iota 0 (size (loads B)))
    fraction (nth (0, 1)%Z amounts l) * given_entry [seq part l | l <- loads B] l d.

Definition is_held (d : nat) :=
  (d \in held_still B) || has (fun l => d \in [seq e.1 | e <- displacements_of l]) (loads B).

Definition displaced u :=
  forall d, d \in iota 0 (body_degrees B) -> is_held d -> u d = applied displacements_of d.

(* r = K u - f *)
Definition reaction_of u d : R :=
  \sum_(j <- iota 0 (body_degrees B)) given_entry (body_stiffness B) d j * u j
  - applied forces_of d.

Definition state_at j := nth Apart states j.
Definition candidate_at j := nth (Candidate nobody (0, 1)%Z) (candidates B) j.
Definition is_apart s := if s is Apart then true else false.

(* Is this a degree of freedom of a candidate in contact? *)
Definition touched (d : nat) :=
  has (fun c => ~~ is_apart c.2 && (d \in dofs_of [:: particle_of c.1]))
    (zip (candidates B) states).

(* (5) where nothing touches *)
Definition balanced r :=
  forall d, d \in iota 0 (body_degrees B) -> ~~ is_held d -> ~~ touched d -> r d = 0.

(* (1), (7) *)
Definition in_state (c : candidate) s u r : Prop :=
  let p := particle_of c in
  let gap := fraction (gap_of c) in
  let pressure := - normal_to p r in
  let bound := fraction mu * fraction (factor_of p) * pressure in
  match s with
  | Apart => normal_to p u < gap
  | SticksAt place => [/\ normal_to p u = gap, tangential p u = fraction place, 0 < pressure &
                          `|tangential p r| < bound]
  | SlipsWith sign => [/\ normal_to p u = gap, 0 < pressure, `|tangential p r| = bound &
                          0 < toR sign * tangential p r]
  | WithoutReaction => [/\ normal_to p u = gap, normal_to p r = 0 & tangential p r = 0]
  end.

Definition in_equilibrium u := let r := reaction_of u in
  [/\ displaced u, balanced r & forall j, (j < size (candidates B))%N ->
      in_state (candidate_at j) (state_at j) u r].

Definition has_equilibrium :=
  [/\ 0 < fraction mu, size amounts = size (loads B), size states = size (candidates B) &
      exists u, in_equilibrium u].

End Loads.

Definition semantics_of p :=
  match p with
  | GivenPencil Q | GivenEigenvalue Q => pencil_semantics Q
  | GivenQuadratic q => quadratic_semantics q
  | GivenSystem B u => system_semantics B u
  | GivenPlain rows => Semantics [::] (fun _ _ => False) (fun _ _ => False) (fun _ _ => 0)
      (fun _ _ _ => 0) None (fun _ => False) (Some (solves_given rows))
  | GivenMembers _ _ | GivenLoads _ => Semantics [::] (fun _ _ => False) (fun _ _ => False)
      (fun _ _ => 0) (fun _ _ _ => 0) None (fun _ => False) None
  end.

Section Statements.

Variable P : semantics.

(* The value lies between the ends of the region; moving variables have positive rates, those at
   rest the rate 0. *)
Definition lies_in_region r t v := in_region (size (variables P)) t (rate P v) r.

Definition belongs_to (f : family) t v :=
  lies_in_region f.1 t v /\ in_place (held_place f.2) t.

(* Which variables move, and which of the others have rows that are 0. *)
Definition has_signs (support biactive : seq nat) t v := forall j, (j < size (variables P))%N ->
  let i := nth 0%N (variables P) j in
  [/\ i \in support -> 0 < rate P v j, i \notin support -> rate P v j = 0,
      i \notin support -> i \in biactive -> row P t v j = 0 &
      i \notin support -> i \notin biactive -> 0 < row P t v j].

Definition asserted_holds lo hi a := exists t v,
  [/\ solves P t v, between t lo hi, between t (asserted_from a) (asserted_to a) &
      has_signs (asserted_support a) (asserted_biactive a) t v].

(* As many different solutions as listed, one in each region. *)
Definition different_solutions lo hi (c : solution_set) (l : seq (R * (nat -> R))) :=
  [/\ size l = size (solutions_in c),
      forall m, List.In m l -> solves P m.1 m.2 /\ between m.1 lo hi,
      List.Forall2 (fun y m => between m.1 (yield_from y) (yield_to y) /\
                               lies_in_region (yield_region y) m.1 m.2) (solutions_in c) l &
      List.ForallOrdPairs (fun m m' => ~ (m'.1 = m.1 /\ same P m.2 m'.2)) l].

Definition is_among (c : solution_set) (l : seq (R * (nat -> R))) t v :=
  [\/ exists2 m, List.In m l & t = m.1 /\ same P m.2 v,
      exists2 f, List.In f (families_of_set c) & belongs_to f t v |
      exists2 r, List.In r (open_regions c) & lies_in_region r t v].

Definition all_solutions_are lo hi (c : solution_set) := exists2 l,
  different_solutions lo hi c l &
  forall t v, solves P t v -> between t lo hi -> is_among c l t v.

(* Each value of the place has a solution of the family, and only one if the place is alone. *)
Definition family_exists (f : family) :=
  is_place R (held_place f.2) /\
  forall t, in_place (held_place f.2) t ->
    (exists v, solves P t v /\ lies_in_region f.1 t v) /\
    (held_alone f.2 -> forall v v', solves P t v -> lies_in_region f.1 t v ->
       solves P t v' -> lies_in_region f.1 t v' -> same P v v').

End Statements.

(* Solutions with t <= 0, at -t, and with t >= 0; both, with t of either sign. *)
Section BothSigns.

Variables (negative positive : semantics) (solved : R -> (nat -> R) -> Prop).

(* All solutions of an eigenvalue problem with -a <= t <= b.  If the sets are told apart, none of
   them is listed in both. *)
Definition all_of_both_signs_are a b (below above : solution_set) := exists l l',
  [/\ different_solutions negative zero a below l, different_solutions positive zero b above l',
      told_apart below above -> forall m m', List.In m l -> List.In m' l' -> - m.1 <> m'.1 &
      forall t x, solved t x -> between t (opposite a) b ->
        is_among negative below l (- t) x \/ is_among positive above l' t x].

Definition both_signs_mean a b (below above : solution_set) :=
  [/\ all_of_both_signs_are a b below above,
      forall f, List.In f (families_of_set below) -> family_exists negative f &
      forall f, List.In f (families_of_set above) -> family_exists positive f].

End BothSigns.

(* Solutions at infinity of a pencil (Points.v); in regions and families their value is 0. *)
Section Infinity.

Variable Q : pencil.

Definition infinite_in r x := in_region (size (slip Q)) 0 (slip_of Q x : nat -> R) r.

Definition infinite_solutions_are (c : solution_set) :=
  exists l : seq (nat -> R),
    [/\ size l = size (solutions_in c), forall x, List.In x l -> at_infinity Q x,
        List.Forall2 (fun y x => infinite_in (yield_region y) x) (solutions_in c) l,
        List.ForallOrdPairs (fun x x' => ~ proportional Q x x') l &
        forall x, at_infinity Q x ->
          [\/ exists2 x', List.In x' l & proportional Q x' x,
              exists2 f, List.In f (families_of_set c) &
                infinite_in f.1 x /\ in_place (held_place f.2) (0 : R) |
              exists2 r, List.In r (open_regions c) & infinite_in r x]].

Definition infinite_family_exists (f : family) :=
  (exists x, at_infinity Q x /\ infinite_in f.1 x) /\
  (held_alone f.2 -> forall x x', at_infinity Q x -> infinite_in f.1 x ->
     at_infinity Q x' -> infinite_in f.1 x' -> proportional Q x x').

End Infinity.

Definition meaning_in (P : semantics) s :=
  match s with
  | EachExists lo hi l => List.Forall (asserted_holds P lo hi) l
  | AllInWindow lo hi c => all_solutions_are P lo hi c /\
      forall f, List.In f (families_of_set c) -> family_exists P f
  | AllAtInfinity c => exists Q, [/\ has_pencil P Q, infinite_solutions_are Q c &
      forall f, List.In f (families_of_set c) -> infinite_family_exists Q f]
  | NoneForFriction from bound => if moves_at P is Some moves then
      forall mu t v, between mu from bound -> 0 <= t -> moves t mu v -> False else False
  | OneForEachFriction from bound => if moves_at P is Some moves then
      forall mu, between mu from bound -> exists t v, 0 <= t /\ moves t mu v else False
  | PointsSolve points => if solved_by P is Some solved then
      points <> [::] /\ forall z, List.In z points -> solved (point_value R z) else False
  | OneMotionOfRates _ _ | StableForFriction _ _ | InEquilibrium _ _ _ | BelowZero _
  | AllOfBothSigns _ _ _ _ => False
  end.

Definition meaning p s :=
  match p, s with
  | GivenSystem B _, OneMotionOfRates from bound =>
      forall mu, between mu from bound -> one_motion_of_rates B mu
  | GivenSystem B _, StableForFriction from bound =>
      forall mu, between mu from bound -> 0 < mu -> stable_at B mu
  | GivenMembers B radii, NoneForFriction from bound => with_zero B = [::] /\ flat_body B /\
      forall k m c, given_member B radii k m c ->
      forall mu t v, between mu from bound -> 0 <= t -> member_moves B k m c t mu v -> False
  | GivenMembers B radii, OneForEachFriction from bound => with_zero B = [::] /\ flat_body B /\
      forall k m c, given_member B radii k m c ->
      forall mu, between mu from bound -> exists t v, 0 <= t /\ member_moves B k m c t mu v
  | GivenMembers _ _, _ => False
  | GivenLoads B, InEquilibrium mu amounts states => has_equilibrium B mu amounts states
  | GivenEigenvalue Q, BelowZero s => meaning_in (negative_semantics Q) s
  | GivenEigenvalue Q, AllOfBothSigns a b below above =>
      both_signs_mean (negative_semantics Q) (pencil_semantics Q) (eigenvalue_solves Q) a b
        below above
  | GivenQuadratic q, BelowZero s => meaning_in (negative_quadratic_semantics q) s
  | GivenQuadratic q, AllOfBothSigns a b below above =>
      both_signs_mean (negative_quadratic_semantics q) (quadratic_semantics q) (quadratic_solves q)
        a b below above
  | _, _ => meaning_in (semantics_of p) s
  end.

End Meaning.
