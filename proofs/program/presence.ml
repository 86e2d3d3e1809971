(* The elaborator of mceip-presence/1: from its pieces to those of the kernel. Untrusted.

   Inverses and null vectors are computed anew, for a box from the mean of its corners and for an
   edge from the mean of the two corners there.  Where the kernel refuses them the interval of mu is
   halved. *)

open Certificate
open Elaborate
open Critical

(* Without free variables: an anchor without matrices, in a unit that leaves the rounding small. *)
let anchored_without_free c (plain : Kernel.pencil) friction slip =
  let bound = { trivial_bound with Kernel.bound_at = Z.one } in
  let anchor =
    { Kernel.reversed_anchor = false;
      plain_anchor =
        { Kernel.anchor_center = Kernel.zero; anchor_unit = two_to 64; anchor_right = [];
          anchor_left = []; anchor_scale = common_scales plain friction slip c.slip_factor };
      friction_left = [] } in
  let anchoring =
    { Kernel.stiffness_below = bound; mass_below = bound; box_anchors = [anchor] } in
  { plain_pencil = plain; anchoring;
    families = Array.of_list (Kernel.box_expansions c.system anchoring); numbers = [] }

let anchors_of_pieces pieces =
  List.sort_uniq compare (List.map (fun piece -> piece.piece_anchor) pieces)

(* All witnesses for some of the corners. *)
let candidates places numbers =
  let corners = List.filter (fun (n, _) -> List.mem n numbers) places.corners in
  let s = mean_of (List.map (doubles_at places) corners) in
  List.filter_map (fun weights -> regular_by places weights corners s) [By_vector; Uniform]

let witness parts k region box =
  match places_of parts k region box with
  | None -> None
  | Some places ->
    let mixed e = Kernel.mixed e (fst parts) (snd parts) in
    let low = mixed box.low and high = mixed box.high in
    let starts = candidates places [0; 2] and finishes = candidates places [1; 3] in
    List.find_map (fun presence_box ->
        List.find_map (fun presence_start ->
            List.find_map (fun presence_finish ->
                let w = { Kernel.presence_box; presence_start; presence_finish } in
                if Kernel.check_presence_piece low high region w then Some w else None)
              finishes) starts) (candidates places [0; 1; 2; 3])

(* The pieces of the kernel for one of the file, which begins at [from]. *)
let rec divide c v depth n k box =
  let found = match local_parts c v n box.region with
    | None -> None
    | Some (parts, grain) ->
      spend_box (Array.length c.slip) box;
      let region = { local_unit with states = box.region.states } in
      Option.map (fun w -> w, grain) (witness parts k region box) in
  match found with
  | Some (piece_witness, piece_grain) ->
    [{ Kernel.piece_end = box.high; piece_region = box.region; piece_anchor = n; piece_grain;
       piece_witness }]
  | None ->
    if depth = 0 then no_witness "a piece of presence";
    let first, second, _ = cut_box box Along_friction in
    let first = divide c v (depth - 1) n k first in
    first @ divide c v (depth - 1) n k second

let build c v pieces =
  if List.length pieces > 10_000 then no_witness "more than 10,000 pieces";
  let number piece =
    if v.numbers = [] then 0
    else match List.assoc_opt piece.piece_anchor v.numbers with
      | Some n -> n
      | None -> no_witness "a piece names no anchor" in
  let of_piece low piece =
    let moving = List.map (position c.slip) piece.piece_support in
    let state j = if List.mem j moving then Kernel.Moving else Kernel.Resting in
    let states = List.init (Array.length c.slip) state in
    let lower, upper = piece.piece_interval in
    if Q.sign lower < 0 || Q.geq lower upper then no_witness "an interval of a piece";
    let region = { Kernel.lower = point_of lower; upper = point_of upper; states } in
    let box = { region; low; high = point_of piece.piece_to } in
    divide c v 4 (number piece) (position c.slip piece.piece_pivot) box in
  let rec all low = function
    | [] -> []
    | piece :: rest ->
      if Q.leq piece.piece_to (value_of low) then no_witness "the end of a piece";
      let first = of_piece low piece in
      List.rev_append (List.rev first) (all (point_of piece.piece_to) rest) in
  all c.mu_low pieces
