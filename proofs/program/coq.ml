(* An accepted question and its witness as a Coq file, in which Coq's own evaluation repeats the
   check (Examples.v, README.md). Not trusted: Coq accepts the file or it does not. *)

let integer z = if Z.sign z < 0 then "(" ^ Z.to_string z ^ ")" else Z.to_string z
open Kernel

let number n = string_of_int n ^ "%nat"
let list show items = "[:: " ^ String.concat "; " (List.map show items) ^ "]"
let pair show show' (a, b) = "(" ^ show a ^ ", " ^ show' b ^ ")"
let term words = "(" ^ String.concat " " words ^ ")"

let point = pair integer integer
let interval = pair point point
let integers = list integer
let matrix = list integers
(* Numbers of rows and columns are written as integers: a natural number has a constructor for each
   of its units. *)
let place n = string_of_int n
let sparse_rows rows = term ["rows"; list (list (pair place integer)) rows]
let late_rows rows = term ["late"; list (pair place integers) rows]

let box b = term ["Box"; matrix b.inverse; integer b.unit_low; integer b.unit_high; integer b.width]

let uniqueness u =
  term ["Uniqueness"; matrix u.system_inverse; integer u.system_unit_low;
        integer u.system_unit_high; integer u.rate]

let isolation (c : isolation) =
  term ["Isolation"; number c.pivot; integers c.vector; point c.from_point; point c.to_point;
        box c.wide_box; box c.narrow_box; uniqueness c.unique; integers c.left_vector]

let pinning p =
  term ["Pinning"; number p.pin_pivot; integers p.pin_vector; box p.pin_box;
        uniqueness p.pin_unique; string_of_bool p.pin_reversed]

let outcome = function
  | Solution -> "Solution"
  | NegativeX i -> term ["NegativeX"; number i]
  | NegativeY i -> term ["NegativeY"; number i]

let absence a =
  term ["Absence"; number a.absent_pivot; integers a.absent_vector; box a.absent_box;
        integers a.absent_left]

let factor f = term ["Factor"; integers f.weights; matrix f.factor_rows]

let whole_factor = function
  | Dense (weights, rows) -> term ["Dense"; integers weights; matrix rows]
  | Late (unit, rows) -> term ["Late"; integer unit; late_rows rows]

let whole_end e = term ["WholeEnd"; integer e.end_scale; whole_factor e.end_factor]

let whole w =
  term ["WholeLeaf"; integers w.whole_weights; whole_end w.low_end; whole_end w.high_end]

(* The first argument of a leaf is the type of the evidence about the whole pencil. *)
let leaf = function
  | Farkas w -> term ["Farkas"; "whole"; integers w]
  | Definite (d, low, high) ->
    term ["Definite"; "whole"; integers d; factor low; factor high]
  | Absent a -> term ["Absent"; "whole"; absence a]
  | Root (i, c, o) -> term ["Root"; "whole"; interval i; isolation c; outcome o]
  | Infinite (i, p, x) -> term ["Infinite"; "whole"; interval i; pinning p; integers x]
  | Whole w -> term ["Whole"; whole w]
  | Claimed _ | Undecided -> Problem.not_verified "as a Coq file: claims and open regions"

let rec tree = function
  | Split (t, low, high) -> term ["Split"; point t; tree low; tree high]
  | CutFriction _ -> invalid_arg "a cut of friction"
  | Branch (i, resting, moving) -> term ["Branch"; number i; tree resting; tree moving]
  | Leaf l -> term ["Leaf"; leaf l]

let elimination w =
  term ["Elimination"; integers w.row_scale; integer w.unit_of; matrix w.right_w;
        matrix w.left_va; matrix w.left_vb; integer w.bound_c; integer w.bound_d;
        integer w.factor_scale; late_rows w.stiffness_factor]

let planar = pair integer integer

let particle p =
  term ["SlipParticle"; number p.first_dof; number p.second_dof; planar p.tangent;
        planar p.normal; integer p.sign_of; integer p.geometric_stiffness]

let system s =
  term ["System"; number s.dofs; sparse_rows s.stiffness; sparse_rows s.mass;
        term ["numbers"; list place s.free_dofs]; list particle s.particles; integer s.unit_length]

let unknown = function
  | Mu -> "Mu"
  | Lambda2 (p, q) -> term ["Lambda2"; integer p; integer q]

(* Definitions and the theorem: exactly so many motions satisfy (9) in the window. *)
let print s u w tr lo hi count =
  let define name kind value = Printf.printf "Definition %s : %s :=\n  %s.\n\n" name kind value in
  define "body" "system" (system s);
  define "asked" "unknown" (unknown u);
  define "lo" "point" (point lo);
  define "hi" "point" (point hi);
  define "eliminated" "elimination" (elimination w);
  define "cover" "tree (leaf whole)" (tree tr);
  Printf.printf "Theorem exactly_%d (R : rcfType) : has_exactly R body asked lo hi %d.\n" count
    count;
  print_string "Proof.\n";
  print_string "apply: (@by_computation _ _ _ eliminated cover); vm_cast_no_check (erefl true).\n";
  print_string "Qed.\n"

let print_answer question (evidence : Kernel.evidence) (statement : Kernel.statement) =
  match question, evidence, statement with
  | Kernel.SystemProblem (system, unknown),
    CoverOf (lo, hi, CoverInWindow (_, Eliminated (elimination, tree), _, _)),
    AllInWindow (_, _, all) ->
    print system unknown elimination tree lo hi (List.length all.solutions_in)
  | SystemProblem _, _, _ -> Problem.not_verified "as a Coq file: condensation about anchors"
  | _ -> Problem.not_verified "Coq files are made for mechanical systems"
