(* Extraction of the checker to OCaml.

   Integers (Z) become zarith's arbitrary-precision integers, natural numbers become OCaml's int
   with the functions of program/natural.ml, and the equality test of natural numbers becomes that
   of int.
   These three mappings are part of the trusted base (README.md).  Everything else is Coq's
   extraction of [answer], whose soundness Verdict.v proves, and of functions that the elaborator
   uses. *)

From Coq Require Import ZArith.
From Coq Require Import ExtrOcamlBasic ExtrOcamlZBigInt.
From mathcomp Require Import all_ssreflect.
From Mceip Require Import Integers Tree Enclosed Farkas Covered Definite Signed Root RootLeaf.
From Mceip Require Import Pinned Cover Number Condensation Pencil Whole Complete Claim System ZeroReaction.
From Mceip Require Import Lifted EnclosedClaim PlainMcp Signs Support Families.
From Mceip Require Import Series Anchor AnchorLeaf Varying Covers Boxes Regular.
From Mceip Require Import Critical CriticalAnchors Presence PresenceAnchors.
From Mceip Require Import ZeroPencil ZeroEnclosed ZeroComplete Points Rational Statement
  Integral Members Radii Equilibrium Unique Stability Stable Verdict.

Extract Inductive nat => int [ "0" "Natural.succ" ]
  "(fun zero next n -> if n = 0 then zero () else next (Natural.before n))".
(* The functions of ExtrOcamlZBigInt, written where they are called. *)
Extract Inlined Constant Z.add => "Big_int_Z.add_big_int".
Extract Inlined Constant Z.sub => "Big_int_Z.sub_big_int".
Extract Inlined Constant Z.mul => "Big_int_Z.mult_big_int".
Extract Inlined Constant Z.opp => "Big_int_Z.minus_big_int".
Extract Inlined Constant Z.abs => "Big_int_Z.abs_big_int".
Extract Inlined Constant Z.max => "Big_int_Z.max_big_int".
Extract Inlined Constant Z.eqb => "Big_int_Z.eq_big_int".

(* Parts of the definitions of these in Coq.  The program does not call them. *)
Extract Inlined Constant Pos.succ => "Big_int_Z.succ_big_int".
Extract Inlined Constant Pos.add => "Big_int_Z.add_big_int".
Extract Inlined Constant Pos.add_carry =>
  "(fun p q -> Big_int_Z.(succ_big_int (add_big_int p q)))".
Extract Inlined Constant Pos.mul => "Big_int_Z.mult_big_int".
Extract Inlined Constant Pos.eqb => "Big_int_Z.eq_big_int".
Extract Inlined Constant Pos.pred_double => "(fun p -> Big_int_Z.(pred_big_int (add_big_int p p)))".
Extract Inlined Constant Z.double => "(fun z -> Big_int_Z.add_big_int z z)".
Extract Inlined Constant Z.succ_double => "(fun z -> Big_int_Z.(succ_big_int (add_big_int z z)))".
Extract Inlined Constant Z.pred_double => "(fun z -> Big_int_Z.(pred_big_int (add_big_int z z)))".
Extract Inlined Constant Z.pos_sub => "Big_int_Z.sub_big_int".
Extract Inlined Constant Z.pos_div_eucl => "Big_int_Z.quomod_big_int".
Extract Inlined Constant Z.div_eucl => "Big_int_Z.quomod_big_int".

Extract Inlined Constant plus => "Natural.add".
Extract Inlined Constant minus => "Natural.sub".
Extract Inlined Constant mult => "Natural.mul".
Extract Inlined Constant ssrnat.eqn => "(fun (a : int) (b : int) -> a = b)".
Extract Inlined Constant Nat.eqb => "(fun (a : int) (b : int) -> a = b)".

Set Extraction AccessOpaque.
(* Lines of about the length of the other files. *)
Set Printing Width 96.

Extraction "kernel.ml"
  answer integral_answer scaled flat flat_body geometric_of slips slipping with_zero long_normal
  complementarity signed_pencils zero_system_of pencil_of_integral support_pencil
  sliding_poly pressure_poly right_poly left_poly check_solution_claim reaction_poly
  regions_found families_of regions_open zero_undecided pencil_of blocks_of condensed slip zero
  infinity window check_whole check_end
  free_rows_constant symmetric_part definite_end farkas check_absent check_root pinned
  check_claimed check_infinite active moving members member_form defect residual check_unique
  decide check_support column_poly row_poly positive_on check_value low_on high_on
  zero_poly scale_poly check_local expansions local_pencil
  local_point proper_interval swap_pencil condensed_parts part_plain part_friction pencil_at
  mixed box_expansions friction_anchor check_parts box_regular restricted combine_rows
  check_presence_piece presence_inside presence_edge zero_pencil point_pencil reverse_pencil is_held
  is_apart applied_row equations
  inequalities scaled_row signed_part check_given_rates check_given_stable mu_pencil k_rows kappa_in
  width_bound check_members_absent radii_of_parts scaled_radii widened exact_part radii_of_all
  signed_end check_radii_absent told_apart.
