(* Certificates: the file mceip-certificate/1, as far as the kernel has theorems for it.

   The window and the digest are part of the statement that is verified.  The tree is only material
   for the elaborator: the kernel checks what the elaborator makes of it. *)

open Json

type outcome =
  | Absent
  | Solution
  | Negative_x of int
  | Negative_y of int
  | Claim of int
  | Infinity of Z.t list

type root = {
  pivot : int;
  interval : Q.t * Q.t;
  left : Z.t list;
  right : Z.t list;
  exponent : int;
  outcome : outcome }

type factor_rows = { first : int list; rows : Z.t list list; exponent : int }

(* A support leaf: polynomials are lists of integers, constant term first. *)
type vector = Z.t list list

type reason =
  | Nothing of vector
  | Something of vector * (int * (int * vector) list) option

type place_point = { point_polynomial : Z.t list; point_interval : Q.t * Q.t; point_reason : int }

type support_leaf = {
  points : place_point list;
  cells : int list;
  reasons : reason list }

(* The diagonal matrix D of a definite leaf: 1, -1, or the weights of the file. *)
type diagonal = Identity | Opposite | Weighted of Z.t list

type node =
  | Split of Q.t
  | Branch of int
  | Farkas of Z.t list
  | Definite of diagonal
  | Ldl
  | Tail
  | Open
  | Root of root
  | Support of support_leaf

type anchor = {
  center : Q.t;
  reversed : bool;
  right : (int * Z.t list list) list;
  left : (int * Z.t list list) list }

type condensation = {
  sigma : Q.t;
  factor : factor_rows;
  mass_sigma : Q.t;
  mass_factor : factor_rows option;
  tail : (Q.t * factor_rows) option;
  anchors : anchor list }

type piece = { max : Q.t option; anchor : int; tree : node list }

type exact = {
  support : int list;
  biactive : int list;
  polynomial : Z.t list;
  value : Q.t * Q.t;
  x : Q.t list list }

(* The motion stands in place of x. *)
type lifted = { motion : exact; forces : Q.t list list }

(* The preconditioner is read and not used. *)
type enclosed = { box_support : int list; center : Q.t list; radius : Q.t list }

type claim = Exact of exact | Lifted of lifted | Enclosed of enclosed

type t = {
  claims : claim list;
  digest : string;
  unknown : string;
  window : Q.t * Q.t option;
  condensation : condensation option;
  pieces : piece list;
  negative : t option  (* of values below 0: about the reflected pencil *) }

(* A file mceip-critical/1.  Its anchors have two left matrices, its tail two factors. *)
type critical_node =
  | CutValue of Q.t
  | CutFriction of Q.t
  | Decide of int
  | BoxFarkas of Z.t list
  | BoxDefinite of diagonal
  | BoxRegular of int  (* the pivot; inverse and vectors are read and not used *)
  | BoxTail

type critical_piece = { box_max : Q.t option; box_anchor : int; box_tree : critical_node list }

type critical_tail = {
  from : Q.t;
  at_zero : factor_rows * factor_rows option;
  at_below : factor_rows * factor_rows option }

type critical_condensation = {
  plain : condensation;
  left_friction : (int * Z.t list list) list list;
  friction_tail : critical_tail option }

type critical = {
  critical_digest : string;
  at_least : Q.t;  (* `from`, 0 if it is absent *)
  below : Q.t;
  critical_condensation : critical_condensation option;
  critical_pieces : critical_piece list }

(* A file mceip-presence/1.  Of the evidence of a piece only the pivot is used. *)
type presence_piece = {
  piece_to : Q.t;
  piece_interval : Q.t * Q.t;
  piece_anchor : int;
  piece_support : int list;
  piece_pivot : int }

type presence = {
  presence_digest : string;
  presence_from : Q.t;
  presence_to : Q.t;
  presence_condensation : critical_condensation option;
  presence_pieces : presence_piece list }

(* A file mceip-stability/1.  A matrix is its exponent and its rows. *)
type stability_condensation = {
  stable_sigma : Q.t;
  stable_factor : factor_rows;
  stable_right : int * Z.t list list;
  stable_friction : int * Z.t list list;
  stable_inertia : (int * Z.t list list) option }

type stability_end = {
  symmetric : Z.t list list;
  bounds : Z.t list;
  end_exponent : int;
  end_factor : factor_rows }

type stability = {
  stable_digest : string;
  stable_from : Q.t;  (* 0 if it is absent *)
  stable_to : Q.t;
  stable_mass_sigma : Q.t;
  stable_mass_factor : factor_rows option;
  stable_condensation : stability_condensation option;
  stable_lower : stability_end;
  stable_upper : stability_end }

(* A file mceip-equilibrium/1, about a body under loads. *)
type equilibrium = {
  loads_digest : string;
  mu : Q.t;
  amounts : Q.t list;
  stated : Kernel.stated list;
  equilibrium_claim : claim }

type file =
  | Complete of t
  | Critical of critical
  | Presence of presence
  | Stability of stability
  | Equilibrium of equilibrium

(* An index that may name nothing.  A negative one is malformed: the kernel has none. *)
let place item =
  let i = counter item in
  if i < 0 then malformed "a negative index";
  i

(* A non-negative exponent within the limits (5.16). *)
let exponent_of item =
  let e = counter item in
  if e < 0 then malformed "a negative exponent";
  if e > 16_384 then Problem.not_verified "an exponent beyond the limits";
  e

let integers item = List.map integer (list item)
let weights item = List.map weight (list item)

let read_root item =
  let field = fields
      ["pivot"; "interval"; "inverse"; "inverse_exponent"; "left"; "right"; "exponent"; "outcome"]
      [] item in
  let outcome = match field "outcome" with
    | String "solution" -> Solution
    | String "absent" -> Absent
    | Object ["negative_x", i] -> Negative_x (place i)
    | Object ["negative_y", i] -> Negative_y (place i)
    | Object ["claim", c] -> Claim (place c)
    | Object ["infinity", x] -> Infinity (integers x)
    | _ -> malformed "an outcome" in
  let interval = match list (field "interval") with
    | [a; b] -> rational a, rational b
    | _ -> malformed "an interval has two ends" in
  { pivot = place (field "pivot"); interval; left = integers (field "left");
    right = integers (field "right"); exponent = exponent_of (field "exponent"); outcome }

let read_vector item = List.map integers (list item)

let read_reason = function
  | Object ["none", w] -> Nothing (read_vector w)
  | Object ["some", body] ->
    let field = fields ["x"] ["alone"] body in
    let alone = match field "alone" with
      | Null -> None
      | item ->
        let field = fields ["pivot"; "rows"] [] item in
        let row item = match list item with
          | [j; l] -> place j, read_vector l
          | _ -> malformed "a row of alone is [j, l]" in
        Some (place (field "pivot"), List.map row (list (field "rows"))) in
    Something (read_vector (field "x"), alone)
  | _ -> malformed "a reason of a support leaf"

let read_support item =
  let field = fields ["points"; "cells"; "reasons"] [] item in
  let point item =
    let field = fields ["polynomial"; "interval"; "reason"] [] item in
    let point_interval = match list (field "interval") with
      | [a; b] -> rational a, rational b
      | _ -> malformed "an interval has two ends" in
    { point_polynomial = integers (field "polynomial"); point_interval;
      point_reason = place (field "reason") } in
  { points = List.map point (list (field "points"));
    cells = List.map place (list (field "cells"));
    reasons = List.map read_reason (list (field "reasons")) }

let read_node = function
  | String "positive_definite" -> Definite Identity
  | String "negative_definite" -> Definite Opposite
  | Object ["weighted_definite", d] -> Definite (Weighted (weights d))
  | String "tail" -> Tail
  | String "open" -> Open
  | Object ["split", t] -> Split (rational t)
  | Object ["branch", i] -> Branch (place i)
  | Object ["farkas", w] -> Farkas (weights w)
  | Object ["ldl", _] -> Ldl
  | Object ["root", r] -> Root (read_root r)
  | Object ["support", s] -> Support (read_support s)
  | _ -> malformed "a node of a tree"

let read_factor item =
  let field = fields ["first"; "rows"; "exponent"] [] item in
  { first = List.map place (list (field "first"));
    rows = List.map integers (list (field "rows")); exponent = exponent_of (field "exponent") }

let read_matrix item =
  let field = fields ["exponent"; "rows"] [] item in
  exponent_of (field "exponent"), List.map integers (list (field "rows"))

let read_coefficients item =
  let l = list item in
  if List.length l > 8 then Problem.not_verified "more than 8 coefficients of an anchor";
  List.map read_matrix l

let read_anchor_fields field =
  let reversed = match field "reversed" with
    | Null | Bool false -> false
    | Bool true -> true
    | _ -> malformed "reversed" in
  { center = rational (field "center"); reversed; right = read_coefficients (field "right");
    left = read_coefficients (field "left") }

let read_anchor item =
  read_anchor_fields (fields ["center"; "right"; "left"] ["reversed"] item)

let read_tail item =
  let field = fields ["from"; "factor"] ["mass_factor"] item in
  rational (field "from"), read_factor (field "factor")

let read_condensation item =
  let field = fields ["sigma"; "stiffness_factor"; "mass_sigma"; "anchors"]
      ["mass_factor"; "tail"] item in
  { sigma = rational (field "sigma"); factor = read_factor (field "stiffness_factor");
    mass_sigma = rational (field "mass_sigma");
    mass_factor = (match field "mass_factor" with Null -> None | f -> Some (read_factor f));
    tail = (match field "tail" with Null -> None | t -> Some (read_tail t));
    anchors = List.map read_anchor (list (field "anchors")) }

(* Trees are long: no recursion over their nodes. *)
let read_tree read item = List.rev (List.rev_map read (list item))

let read_piece item =
  let field = fields ["tree"] ["max"; "anchor"] item in
  { max = (match field "max" with Null -> None | v -> Some (rational v));
    anchor = (match field "anchor" with Null -> 0 | v -> place v);
    tree = read_tree read_node (field "tree") }

(* A polynomial, constant term first, without zeros at its end. *)
let strip is_zero p =
  let rec drop = function c :: rest when is_zero c -> drop rest | p -> p in
  List.rev (drop (List.rev p))

let strip_integers = strip (fun c -> Z.sign c = 0)

let polynomials item =
  List.map (fun p -> strip (fun c -> Q.sign c = 0) (List.map rational (list p))) (list item)

(* The fields that an exact and a lifted solution have in common. *)
let read_exact field x =
  let value = match list (field "interval") with
    | [a; b] -> rational a, rational b
    | _ -> malformed "an interval has two ends" in
  { support = List.map place (list (field "support"));
    biactive = List.map place (list (field "biactive"));
    polynomial = strip_integers (integers (field "polynomial")); value;
    x = polynomials (field x) }

let read_claim = function
  | Object ["exact_solution", body] ->
    Exact (read_exact (fields ["support"; "biactive"; "polynomial"; "interval"; "x"] [] body) "x")
  | Object ["lifted_solution", body] ->
    let field = fields ["support"; "biactive"; "polynomial"; "interval"; "v"; "w"] [] body in
    Lifted { motion = read_exact field "v"; forces = polynomials (field "w") }
  | Object ["enclosed_solution", body] ->
    let field = fields ["support"; "center"; "radius"; "preconditioner"; "exponent"] [] body in
    ignore (List.map integers (list (field "preconditioner")));
    if counter (field "exponent") < 0 then malformed "a negative exponent";
    let rationals key = List.map rational (list (field key)) in
    Enclosed { box_support = List.map place (list (field "support"));
               center = rationals "center"; radius = rationals "radius" }
  | _ -> malformed "a claim is an object with one key"

(* The window of a certificate says where it begins. *)
let read_window = function
  | Object members as item when List.mem_assoc "min" members
                             && List.assoc "min" members <> Null ->
    let lo, hi = Problem.read_window ~eigenvalue:false item in
    Option.get lo, hi
  | _ -> malformed "a window with min was expected"

(* What a file and its part for values below 0 have in common. *)
let read_part digest unknown negative field =
  let window = read_window (field "window") in
  let claims = List.map read_claim (list (field "claims")) in
  let condensation, pieces = match field "complete_set" with
    | Null -> None, []
    | set ->
      let field = fields ["pieces"] ["condensation"] set in
      (match field "condensation" with Null -> None | c -> Some (read_condensation c)),
      List.map read_piece (list (field "pieces")) in
  { claims; digest; unknown; window; condensation; pieces; negative }

let read_complete document =
  let field = fields ["format"; "problem_sha256"; "unknown"; "window"; "claims"]
      ["complete_set"; "negative"] document in
  let digest = text (field "problem_sha256") and unknown = text (field "unknown") in
  let negative = match field "negative" with
    | Null -> None
    | _ when unknown <> "eigenvalue" ->
      malformed "negative: expected it with the unknown eigenvalue only, got %s" unknown
    | part -> Some (read_part digest unknown None
                      (fields ["window"; "claims"] ["complete_set"] part)) in
  read_part digest unknown negative field

let read_critical_condensation ~tail:allowed item =
  let field = fields ["sigma"; "stiffness_factor"; "mass_sigma"; "anchors"]
      ("mass_factor" :: if allowed then ["tail"] else []) item in
  let optional = function Null -> None | f -> Some (read_factor f) in
  let anchor item =
    let field = fields ["center"; "right"; "left_friction"] ["left"; "reversed"] item in
    let left = if field "left" = Null then "right" else "left" in
    let field_of key = field (if key = "left" then left else key) in
    read_anchor_fields field_of, read_coefficients (field "left_friction") in
  let tail item =
    let field = fields ["from"; "factor"; "factor_below"] ["mass_factor"; "mass_factor_below"]
        item in
    { from = rational (field "from");
      at_zero = read_factor (field "factor"), optional (field "mass_factor");
      at_below = read_factor (field "factor_below"), optional (field "mass_factor_below") } in
  let anchors = List.map anchor (list (field "anchors")) in
  let plain =
    { sigma = rational (field "sigma"); factor = read_factor (field "stiffness_factor");
      mass_sigma = rational (field "mass_sigma"); mass_factor = optional (field "mass_factor");
      tail = None; anchors = List.map fst anchors } in
  { plain; left_friction = List.map snd anchors;
    friction_tail = (match field "tail" with Null -> None | t -> Some (tail t)) }

(* The pivot of a regular leaf or of a piece of presence; the rest has to have its shape. *)
let evidence = ["pivot"; "inverse"; "inverse_exponent"; "left"; "right"; "exponent"]

let read_evidence field =
  ignore (List.map integers (list (field "inverse")));
  ignore (List.map integer (list (field "left") @ list (field "right")));
  ignore (exponent_of (field "inverse_exponent") + exponent_of (field "exponent"));
  place (field "pivot")

let read_regular item = BoxRegular (read_evidence (fields evidence [] item))

let read_critical_node = function
  | String "positive_definite" -> BoxDefinite Identity
  | String "negative_definite" -> BoxDefinite Opposite
  | Object ["weighted_definite", d] -> BoxDefinite (Weighted (weights d))
  | String "tail" -> BoxTail
  | Object ["split", t] -> CutValue (rational t)
  | Object ["friction", m] -> CutFriction (rational m)
  | Object ["branch", i] -> Decide (place i)
  | Object ["farkas", w] -> BoxFarkas (weights w)
  | Object ["regular", r] -> read_regular r
  | _ -> malformed "a node of a tree"

let read_critical_piece item =
  let field = fields ["max"; "tree"] ["anchor"] item in
  { box_max = (match field "max" with Null -> None | v -> Some (rational v));
    box_anchor = (match field "anchor" with Null -> 0 | v -> place v);
    box_tree = read_tree read_critical_node (field "tree") }

let read_critical document =
  let field = fields ["format"; "problem_sha256"; "below"; "pieces"] ["from"; "condensation"]
      document in
  let critical_condensation = match field "condensation" with
    | Null -> None
    | c -> Some (read_critical_condensation ~tail:true c) in
  { critical_digest = text (field "problem_sha256");
    at_least = (match field "from" with Null -> Q.zero | q -> rational q);
    below = rational (field "below");
    critical_condensation;
    critical_pieces = List.map read_critical_piece (list (field "pieces")) }

let read_presence_piece item =
  let field = fields ("to" :: "interval" :: "support" :: evidence) ["anchor"] item in
  let piece_interval = match list (field "interval") with
    | [a; b] -> rational a, rational b
    | _ -> malformed "an interval has two ends" in
  { piece_to = rational (field "to"); piece_interval;
    piece_anchor = (match field "anchor" with Null -> 0 | v -> place v);
    piece_support = List.map place (list (field "support")); piece_pivot = read_evidence field }

let read_presence document =
  let field = fields ["format"; "problem_sha256"; "from"; "to"; "pieces"] ["condensation"]
      document in
  let presence_condensation = match field "condensation" with
    | Null -> None
    | c -> Some (read_critical_condensation ~tail:false c) in
  { presence_digest = text (field "problem_sha256"); presence_from = rational (field "from");
    presence_to = rational (field "to"); presence_condensation;
    presence_pieces = List.map read_presence_piece (list (field "pieces")) }

let optional read = function Json.Null -> None | item -> Some (read item)

let read_stability document =
  let field = fields ["format"; "problem_sha256"; "to"; "mass_sigma"; "lower"; "upper"]
      ["from"; "mass_factor"; "condensation"] document in
  let condensation item =
    let field = fields ["sigma"; "stiffness_factor"; "right"; "left_friction"] ["inertia"] item in
    { stable_sigma = rational (field "sigma");
      stable_factor = read_factor (field "stiffness_factor");
      stable_right = read_matrix (field "right");
      stable_friction = read_matrix (field "left_friction");
      stable_inertia = optional read_matrix (field "inertia") } in
  let end_of item =
    let field = fields ["exponent"; "symmetric"; "bounds"; "factor"] [] item in
    { symmetric = List.map integers (list (field "symmetric"));
      bounds = integers (field "bounds"); end_exponent = exponent_of (field "exponent");
      end_factor = read_factor (field "factor") } in
  { stable_digest = text (field "problem_sha256");
    stable_from = Option.value (optional rational (field "from")) ~default:Q.zero;
    stable_to = rational (field "to"); stable_mass_sigma = rational (field "mass_sigma");
    stable_mass_factor = optional read_factor (field "mass_factor");
    stable_condensation = optional condensation (field "condensation");
    stable_lower = end_of (field "lower"); stable_upper = end_of (field "upper") }

let read_state item =
  let state = match item with
    | Object members -> Option.value (List.assoc_opt "state" members) ~default:Null
    | _ -> malformed "a state is an object" in
  let field key = fields ["state"; key] [] item key in
  match state with
  | String "stick" -> Kernel.SticksAt (Problem.point_of (rational (field "tangential")))
  | String "slip" ->
    (match Problem.unit_of "sign" (field "sign") with
     | Some sign -> SlipsWith (Z.of_int sign)
     | None -> malformed "sign is 1 or -1")
  | String "free" -> ignore (fields ["state"] [] item); Apart
  | String "zero" -> ignore (fields ["state"] [] item); WithoutReaction
  | _ -> malformed "a state of a candidate"

let read_equilibrium document =
  let field = fields ["format"; "loads_sha256"; "friction"; "amounts"; "candidates"; "claim"] []
      document in
  { loads_digest = text (field "loads_sha256"); mu = rational (field "friction");
    amounts = List.map rational (list (field "amounts"));
    stated = List.map read_state (list (field "candidates"));
    equilibrium_claim = read_claim (field "claim") }

let read path =
  let document = Json.read path in
  let format = match document with
    | Object members -> List.assoc_opt "format" members
    | _ -> None in
  match format with
  | Some (String "mceip-certificate/1") -> Complete (read_complete document)
  | Some (String "mceip-critical/1") -> Critical (read_critical document)
  | Some (String "mceip-presence/1") -> Presence (read_presence document)
  | Some (String "mceip-stability/1") -> Stability (read_stability document)
  | Some (String "mceip-equilibrium/1") -> Equilibrium (read_equilibrium document)
  | _ -> malformed "a format of a certificate was expected"
