(* The elaborator of mceip-critical/1: from its trees of boxes to that of the kernel. Untrusted.

   The factors of definite leaves are computed as those of other certificates (elaborate.ml), for
   the pencils at both ends of the interval of mu. *)

open Certificate
open Elaborate

type box = { region : Kernel.region; low : Kernel.point; high : Kernel.point }

type context = {
  system : Kernel.system;
  slip : int array;
  free_factor : Z.t;  (* of the free rows *)
  slip_factor : Z.t;  (* of the slip rows of both parts *)
  parts : (Kernel.enclosed * Kernel.enclosed) option;  (* without free variables *)
  tail : critical_tail option;
  below : Q.t }

(* f_i / 2^b_i, common to both parts, as positive integers in one unit. *)
let common_scales (plain : Kernel.pencil) (friction : Kernel.pencil) slip factor =
  let beside row = List.map (fun (j, v) -> (j + plain.order, v)) row in
  let both = List.map2 (fun a b -> a @ beside b) in
  row_scales { plain with Kernel.rows_a = both plain.rows_a friction.rows_a;
                          rows_b = both plain.rows_b friction.rows_b } slip factor

(* Without free variables nothing is eliminated: the parts are the given pencils with rows scaled. *)
let trivial_elimination plain friction slip factor =
  let none = List.map (fun _ -> []) slip in
  { Kernel.row_scale = common_scales plain friction slip factor; unit_of = Z.one; right_w = none;
    left_va = none; left_vb = none; bound_c = Z.one; bound_d = Z.one; factor_scale = Z.zero;
    stiffness_factor = [] }, (none, none)

(* The pencil at a friction with the weights of its rows. *)
let whole_pencil c e =
  let pencil = Kernel.pencil_at c.system e in
  pencil, row_weights pencil c.free_factor (Z.mul c.slip_factor (snd e))

let by_whole c negative box =
  let at e =
    let pencil, weights = whole_pencil c e in
    signed_whole_leaf pencil weights negative box.region in
  match at box.low with
  | None -> None
  | Some a -> Option.map (fun b -> Kernel.BoxWhole (a, b)) (at box.high)

let by_parts c negative box =
  match c.parts with
  | None -> None
  | Some (plain, friction) ->
    let at e =
      match definite_leaf (Kernel.mixed e plain friction) negative box.region with
      | Some (Kernel.Definite (_, low, high)) -> Some (low, high)
      | _ -> None in
    match at box.low with
    | None -> None
    | Some f -> Option.map (fun f' -> Kernel.BoxDefinite (negative, f, f')) (at box.high)

(* The factors of the certificate, where the box is that of the tail. *)
let by_tail c box =
  match c.tail with
  | Some tail when Q.equal tail.from (value_of box.region.lower) && not (finite box.region.upper)
                   && Z.sign (fst box.low) = 0 && Q.equal c.below (value_of box.high) ->
    let at e (factor, mass_factor) =
      let pencil, whole_weights = whole_pencil c e in
      let twice = Z.mul (Z.of_int 2) (Z.mul c.slip_factor (snd e)) in
      let covered times f =
        { Kernel.end_scale = two_to (2 * f.exponent);
          end_factor = Kernel.Late (Z.mul twice times, rows_from f) } in
      let no_factor =
        { Kernel.end_scale = Z.one;
          end_factor = Kernel.Late (Z.zero, List.init pencil.order (fun _ -> (0, []))) } in
      let w = { Kernel.whole_weights; whole_negative = false;
                low_end = covered (snd box.region.lower) factor;
                high_end = Option.fold ~none:no_factor ~some:(covered Z.one) mass_factor } in
      if Kernel.check_whole pencil box.region w then Some w else None in
    (match at box.low tail.at_zero with
     | None -> None
     | Some a -> Option.map (fun b -> Kernel.BoxWhole (a, b)) (at box.high tail.at_below))
  | _ -> None

let leaf c box node =
  let found what ways =
    match List.find_map (fun way -> way ()) ways with
    | Some l -> Kernel.BoxLeaf l
    | None -> no_witness "%s" what in
  match node with
  | BoxFarkas w when c.parts <> None -> Kernel.BoxLeaf (Kernel.BoxFarkas w)
  | BoxFarkas _ ->
    Problem.not_verified "Farkas leaves of mceip-critical/1 with free variables"
  | BoxDefinite negative ->
    found "definite"
      [(fun () -> by_parts c negative box); (fun () -> by_whole c negative box)]
  | BoxTail -> found "tail" [(fun () -> by_tail c box); (fun () -> by_whole c false box)]
  | CutValue _ | CutFriction _ | Decide _ -> assert false

(* The nodes of a piece in preorder. *)
let build_piece c nodes box =
  let rec build depth box nodes =
    if depth > 2_000 then no_witness "a tree of more than 2,000 levels";
    let region = box.region in
    let both first second rest =
      let first, rest = build (depth + 1) first rest in
      let second, rest = build (depth + 1) second rest in
      first, second, rest in
    match nodes with
    | [] -> no_witness "a tree ends too early"
    | CutValue t :: rest ->
      let t = point_of t in
      let first, second, rest =
        both { box with region = { region with upper = t } }
          { box with region = { region with lower = t } } rest in
      Kernel.CutValue (t, first, second), rest
    | CutFriction m :: rest ->
      let m = point_of m in
      let first, second, rest = both { box with high = m } { box with low = m } rest in
      Kernel.CutFriction (m, first, second), rest
    | Decide i :: rest ->
      let i = position c.slip i in
      let decided state = { box with region = Kernel.decide i state region } in
      let first, second, rest = both (decided Kernel.Resting) (decided Kernel.Moving) rest in
      Kernel.Decide (i, first, second), rest
    | node :: rest -> leaf c box node, rest in
  match build 0 box nodes with
  | tree, [] -> tree
  | _ -> no_witness "a tree has a node too many"

(* The pieces of [0, infinity) as one tree. *)
let build c pieces =
  if List.length pieces > 10_000 then no_witness "more than 10,000 pieces";
  let rec join lower = function
    | [] -> no_witness "pieces that end before infinity"
    | piece :: rest ->
      if (piece.box_max = None) <> (rest = []) then no_witness "pieces that end before infinity";
      let upper = upper_point piece.box_max in
      let box = { region = { Kernel.lower; upper; states = [] }; low = Kernel.zero;
                  high = point_of c.below } in
      let tree = build_piece c piece.box_tree box in
      if rest = [] then tree else Kernel.CutValue (upper, tree, join upper rest) in
  join Kernel.zero pieces
