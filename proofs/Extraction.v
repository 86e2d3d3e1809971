(* Extraction of the checker to OCaml.

   Integers (Z) become zarith's arbitrary-precision integers, natural numbers become OCaml's int
   with the functions of program/natural.ml, and the equality test of natural numbers becomes that
   of int.
   These three mappings are part of the trusted base (README.md).  Everything else is Coq's
   extraction of the functions whose soundness System.v, Complete.v, Families.v, Varying.v, Claim.v,
   Lifted.v, EnclosedClaim.v, PlainMcp.v, ZeroReaction.v, ZeroEnclosed.v, ZeroComplete.v,
   Critical.v, CriticalAnchors.v, PresenceAnchors.v and Points.v prove. *)

From Coq Require Import ZArith.
From Coq Require Import ExtrOcamlBasic ExtrOcamlZBigInt.
From mathcomp Require Import all_ssreflect.
From Mceip Require Import Integers Tree Enclosed Farkas Covered Definite Root RootLeaf Pinned Cover.
From Mceip Require Import Number Condensation Pencil Whole Complete Claim System ZeroReaction.
From Mceip Require Import ZeroEnclosed.
From Mceip Require Import Lifted EnclosedClaim PlainMcp Signs Support Families.
From Mceip Require Import Series Anchor AnchorLeaf Varying Boxes Regular.
From Mceip Require Import Critical CriticalAnchors Presence PresenceAnchors.
From Mceip Require Import ZeroPencil ZeroComplete Points.

Extract Inductive nat => int [ "0" "Natural.succ" ]
  "(fun zero next n -> if n = 0 then zero () else next (Natural.before n))".
Extract Inlined Constant plus => "Natural.add".
Extract Inlined Constant minus => "Natural.sub".
Extract Inlined Constant mult => "Natural.mul".
Extract Inlined Constant ssrnat.eqn => "(fun (a : int) (b : int) -> a = b)".
Extract Inlined Constant Nat.eqb => "(fun (a : int) (b : int) -> a = b)".

(* Varying.v has a field with this name. *)
Extraction Inline Condensation.stiffness_bound.

Set Extraction AccessOpaque.

Extraction "kernel.ml"
  check_zero check_zero_enclosed support_pencil slipping_variables
  sliding_poly pressure_poly right_poly left_poly
  check_complete check_solution_claim check_system check_claim check_system_claim
  check_lifted check_enclosed_claim check_system_enclosed check_mcp
  reaction_poly found left_open solutions_found pencil_of blocks_of
  condensed slip zero infinity window check_leaf check_tree check_whole check_end
  stiffness_positive shapes wellformed free_rows_constant system_wellformed
  symmetric_part definite_end farkas check_absent check_root pinned check_claimed check_infinite
  active moving members member_form defect residual check_unique decide
  check_families check_system_families all_solutions families still_open check_supports
  check_support column_poly row_poly positive_on check_value low_on high_on zero_poly scale_poly
  check_varying_families check_system_varying varying_found varying_solutions varying_families
  varying_still_open check_local expansions expand_anchor local_pencil local_point local_known
  local_region proper_interval bounded_rows ff_block swap_pencil
  check_critical condensed_parts part_plain part_friction pencil_at mixed
  check_anchored_critical box_expansions friction_anchor check_parts freed
  box_regular regular_order restricted combine_rows
  check_presence check_piece check_presence_piece presence_inside presence_edge rest_row rows_at sign_at
  corner_center corner_radius
  zero_pencil check_zero_complete zero_solutions zero_families zero_still_open
  check_zero_varying zero_varying_solutions zero_varying_families zero_varying_open both_halves
  point_pencil check_at_value check_system_at_value reverse_pencil check_infinity.
