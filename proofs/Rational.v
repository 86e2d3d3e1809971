(* Problems as they are written, with rational numbers, and the integers that the kernel computes
   with.

   A pencil is multiplied by one positive integer, and so is the *linear form* of a quadratic
   problem, a pencil in which t^2 does not occur; the stiffness and the mass of a system by one, its
   tangents and normals by another.  Any such integers serve by which all entries become
   integers ([scaled_entry], [exact]).  Free are the degrees of freedom of no particle that is in
   contact.  The tangent and the normal of a particle are the rows of its frame; the normal points
   into the obstacle, and its length is the friction factor.  A particle that slips has the
   geometric stiffness of its obstacle, 0 where this is flat; its integer is in the unit of the
   stiffness.

   Integral.v proves that the integral problem means the same.

   A body under loads has candidates for contact in place of particles; its degrees of freedom are
   those of the file, the held ones among them.

   Pages: spec/formats.md (mceip-problem/1, mceip-mcp/1, mceip-loads/1); spec/certificates.md,
   5.1. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect.
From Mceip Require Import Integers Bounded Pencil System ZeroReaction ZeroPencil PlainMcp.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Delimit Scope Z_scope with Z.

(* Numerator and denominator. *)
Definition rational := (Z * Z)%type.

(* Columns and entries; the entries at one column are added. *)
Definition rational_row := seq (nat * rational).

Record rational_pencil := RationalPencil {
  given_order : nat;
  given_a : seq rational_row;
  given_b : seq rational_row;
  given_free : seq nat }.

Definition opposite_row (row : rational_row) : rational_row :=
  [seq (e.1, (- e.2.1, e.2.2))%Z | e <- row].

(* (A, -B) *)
Definition reflected Q :=
  RationalPencil (given_order Q) (given_a Q) [seq opposite_row row | row <- given_b Q]
    (given_free Q).

(* A + t B + t^2 C, where no variable is free. *)
Record rational_quadratic := RationalQuadratic {
  quadratic_order : nat;
  quadratic_a : seq rational_row;
  quadratic_b : seq rational_row;
  quadratic_c : seq rational_row }.

(* (A, -B, C) *)
Definition reflected_quadratic q :=
  RationalQuadratic (quadratic_order q) (quadratic_a q)
    [seq opposite_row row | row <- quadratic_b q] (quadratic_c q).

(* For t >= 0 a quadratic problem of order n is a pencil of order 2 n, of x and z = x / (1 + t):

       [ B - C   A - B + C ]       [ C   0 ]
       [  -I         I     ]  + t  [ 0   I ].

   Columns of the given matrices that are no variables count for nothing. *)
Definition linearized q :=
  let n := quadratic_order q in
  let numbers := iota 0 n in
  let row (m : seq rational_row) i := [seq e <- nth [::] m i | e.1 < n] in
  let behind (r : rational_row) : rational_row := [seq (n + e.1, e.2) | e <- r] in
  let a := row (quadratic_a q) in
  let b := row (quadratic_b q) in
  let c := row (quadratic_c q) in
  RationalPencil (n + n)
    ([seq b i ++ opposite_row (c i) ++ behind (a i ++ opposite_row (b i) ++ c i) | i <- numbers] ++
     [seq [:: (i, (- 1, 1)%Z); (n + i, (1, 1)%Z)] | i <- numbers])
    ([seq c i | i <- numbers] ++ [seq [:: (n + i, (1, 1)%Z)] | i <- numbers])
    (iota n n).

(* The state before the event; a particle that slips has the sign S of its tangential reaction, and
   the geometric stiffness g. *)
Inductive contact := NotInContact | Sticking | Slipping of Z & rational | ZeroInContact.

Record given_particle := GivenParticle {
  first_of : nat;
  second_of : nat;
  contact_of : contact;
  frame_tangent : rational * rational;
  frame_normal : rational * rational;
  into_obstacle : Z;  (* 1 or -1 *)
  factor_of : rational }.

Record rational_system := RationalSystem {
  degrees : nat;
  given_stiffness : seq rational_row;
  given_mass : seq rational_row;
  given_particles : seq given_particle }.

(* Radii of the entries of both matrices, and for each slip particle the ends of its friction
   factor: the system stands for all bodies within them. *)
Record rational_radii := RationalRadii {
  radii_of_stiffness : seq rational_row;
  radii_of_mass : seq rational_row;
  factor_ranges : seq (rational * rational) }.

(* A row (M_i, q_i) with its bounds. *)
Record rational_mcp_row := RationalMcpRow {
  given_m : rational_row;
  given_q : rational;
  given_lower : option rational;
  given_upper : option rational }.

(* What may come into contact, and its distance from the obstacle in the unloaded body.  A particle
   of this kind has no state of its own: nothing looks at [contact_of]. *)
Record candidate := Candidate { particle_of : given_particle; gap_of : rational }.

(* Forces, and displacements of degrees of freedom that are held. *)
Record load := Load { forces_of : rational_row; displacements_of : rational_row }.

(* Held are the degrees of freedom of the list and those that a load displaces. *)
Record rational_body := RationalBody {
  body_degrees : nat;
  body_stiffness : seq rational_row;
  candidates : seq candidate;
  held_still : seq nat;
  loads : seq load }.

Inductive problem :=
  | GivenPencil of rational_pencil
  (* With values of either sign. *)
  | GivenEigenvalue of rational_pencil
  (* The same with t^2. *)
  | GivenQuadratic of rational_quadratic
  | GivenSystem of rational_system & unknown
  | GivenMembers of rational_system & rational_radii
  | GivenPlain of seq rational_mcp_row
  | GivenLoads of rational_body.

(* The same with integers, as the kernel has it. *)
Inductive integral :=
  | PencilProblem of pencil
  | SystemProblem of system & unknown
  | ZeroProblem of zero_system & unknown
  | PlainProblem of mcp.

(* Factors of the matrices, and of tangents and normals. *)
Record scales := Scales { entry_scale : Z; length_scale : Z }.

Section Particles.

Variable B : rational_system.

Definition sticks p := if contact_of p is Sticking then true else false.
Definition slips p := if contact_of p is Slipping _ _ then true else false.
Definition zeroes p := if contact_of p is ZeroInContact then true else false.
Definition in_contact p := if contact_of p is NotInContact then false else true.

Definition sign p := if contact_of p is Slipping s _ then s else 0%Z.
Definition geometric_of p := if contact_of p is Slipping _ g then g else (0, 1)%Z.

Definition slipping := [seq p <- given_particles B | slips p].
Definition with_zero := [seq p <- given_particles B | zeroes p].

(* The obstacles are flat. *)
Definition flat_body := all (fun p => (geometric_of p).1 =? 0)%Z slipping.

Definition dofs_of (l : seq given_particle) :=
  [seq first_of p | p <- l] ++ [seq second_of p | p <- l].

Definition held := dofs_of [seq p <- given_particles B | in_contact p].

End Particles.

Section Scaling.

Local Open Scope Z_scope.

Variable c : scales.

Definition scaled_entry (m : Z) (q : rational) : Z := m * q.1 / q.2.

Definition exact m (q : rational) := (0 <? q.2) && (q.2 * scaled_entry m q =? m * q.1).

Definition scaled_row m (row : rational_row) := [seq (e.1, scaled_entry m e.2) | e <- row].
Definition exact_rows m (rows : seq rational_row) := all (all (fun e => exact m e.2)) rows.

(* The normal into the obstacle, with the friction factor as its length. *)
Definition long_normal p : rational * rational :=
  let component (n : rational) :=
    (into_obstacle p * ((factor_of p).1 * n.1), (factor_of p).2 * n.2) in
  (component (frame_normal p).1, component (frame_normal p).2).

Definition scaled_planar (e : rational * rational) : planar :=
  (scaled_entry (length_scale c) e.1, scaled_entry (length_scale c) e.2).

Definition exact_planar (e : rational * rational) :=
  exact (length_scale c) e.1 && exact (length_scale c) e.2.

(* The normal has the length 1. *)
Definition normal_of_length p := let n := scaled_planar (long_normal p) in
  inner n n * ((factor_of p).2 * (factor_of p).2) =?
  length_scale c * length_scale c * ((factor_of p).1 * (factor_of p).1).

Definition exact_particle p :=
  [&& exact_planar (frame_tangent p), exact_planar (long_normal p), 0 <? (factor_of p).1,
      0 <? (factor_of p).2 &
      [&& 0 <? (frame_normal p).1.2, 0 <? (frame_normal p).2.2, normal_of_length p &
          exact (entry_scale c) (geometric_of p)]].

Definition scaled_particle p := SlipParticle (first_of p) (second_of p)
  (scaled_planar (frame_tangent p)) (scaled_planar (long_normal p)) (sign p)
  (scaled_entry (entry_scale c) (geometric_of p)).

Definition scaled_system B := System (degrees B)
  [seq scaled_row (entry_scale c) row | row <- given_stiffness B]
  [seq scaled_row (entry_scale c) row | row <- given_mass B]
  [seq d <- iota 0 (degrees B) | d \notin held B]
  [seq scaled_particle p | p <- slipping B] (length_scale c).

Definition scaled_zero_system B :=
  ZeroSystem (scaled_system B) [seq scaled_particle p | p <- with_zero B].

(* No degree of freedom of two particles. *)
Definition exact_system B :=
  [&& 0 <? entry_scale c, 0 <? length_scale c, exact_rows (entry_scale c) (given_stiffness B),
      exact_rows (entry_scale c) (given_mass B), uniq (dofs_of (given_particles B)) &
      all exact_particle (slipping B) && all exact_particle (with_zero B)].

Definition scaled_pencil Q := Pencil (given_order Q)
  [seq scaled_row (entry_scale c) row | row <- given_a Q]
  [seq scaled_row (entry_scale c) row | row <- given_b Q] (given_free Q).

Definition exact_pencil Q :=
  [&& 0 <? entry_scale c, exact_rows (entry_scale c) (given_a Q) &
      exact_rows (entry_scale c) (given_b Q)].

Definition scaled_mcp_row r := McpRow (scaled_row (entry_scale c) (given_m r))
  (scaled_entry (entry_scale c) (given_q r)) (given_lower r) (given_upper r).

Definition exact_mcp_row r :=
  exact (entry_scale c) (given_q r) && all (fun e => exact (entry_scale c) e.2) (given_m r).

(* The integral problem, if these factors make it one.  Equilibrium.v makes integers of a body under
   loads; for an eigenvalue problem stands one of its pencils ([signed_pencils]). *)
Definition scaled p : option integral :=
  match p with
  | GivenPencil Q =>
      if exact_pencil Q then Some (PencilProblem (scaled_pencil Q)) else None
  | GivenSystem B u =>
      if exact_system B
      then Some (if nilp (with_zero B) then SystemProblem (scaled_system B) u
                 else ZeroProblem (scaled_zero_system B) u)
      else None
  | GivenPlain rows =>
      if (0 <? entry_scale c) && all exact_mcp_row rows
      then Some (PlainProblem [seq scaled_mcp_row r | r <- rows]) else None
  | GivenEigenvalue _ | GivenQuadratic _ | GivenMembers _ _ | GivenLoads _ => None
  end.

End Scaling.

(* Of an eigenvalue problem: the pencils whose solutions are its solutions with t >= 0, and with
   t <= 0 at -t. *)
Definition signed_pencils p : option (rational_pencil * rational_pencil) :=
  match p with
  | GivenEigenvalue Q => Some (Q, reflected Q)
  | GivenQuadratic q => Some (linearized q, linearized (reflected_quadratic q))
  | _ => None
  end.

(* The pencil of an integral problem, by (12)-(14) for a system. *)
Definition pencil_of_integral q : pencil :=
  match q with
  | PencilProblem Q => Q
  | SystemProblem s u => pencil_of s u
  | ZeroProblem z u => zero_pencil z u
  | PlainProblem _ => Pencil 0 [::] [::] [::]
  end.

(* The complementarity variables of a problem, by their numbers in this pencil: one for each slip
   particle, then gap, right and left of each z particle. *)
Definition complementarity p : seq nat :=
  match p with
  | GivenPencil Q | GivenEigenvalue Q => [seq i <- iota 0 (given_order Q) | i \notin given_free Q]
  | GivenQuadratic q => iota 0 (quadratic_order q)
  | GivenSystem B _ =>
      iota (count (fun d => d \notin held B) (iota 0 (degrees B)))
        (size (slipping B) + 3 * size (with_zero B))
  | GivenMembers _ _ | GivenPlain _ | GivenLoads _ => [::]
  end.
