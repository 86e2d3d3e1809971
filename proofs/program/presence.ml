(* The elaborator of mceip-presence/1: from its pieces to those of the kernel. Untrusted.

   Inverses and null vectors are computed anew, for a box from the mean of its corners and for an
   edge from the mean of the two corners there.  Where the kernel refuses them the interval of t is
   made shorter, and then that of mu halved. *)

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
    families = Array.of_list (Kernel.box_expansions c.zero anchoring); numbers = [] }

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

(* Row k of T(u, mu) at the x with x_k = 1 whose other rows vanish; in doubles. *)
let pivot_row (plain, friction) order mu =
  let plain = doubles_of plain and friction = doubles_of friction in
  let order = Array.of_list order in
  let m = Array.length order - 1 in
  fun u ->
    let entry i j = at plain u order.(i) order.(j) +. mu *. at friction u order.(i) order.(j) in
    let block = Array.init m (fun i -> Array.init m (fun j -> entry (i + 1) (j + 1))) in
    match if m = 0 then Some [||] else inverse block with
    | None -> Float.nan
    | Some y ->
      let row = ref (entry 0 0) in
      for i = 0 to m - 1 do
        for j = 0 to m - 1 do
          row := !row -. entry 0 (i + 1) *. y.(i).(j) *. entry (j + 1) 0
        done
      done;
      !row

(* The place in [0, 1] where f changes its sign, if it does. *)
let change_of_sign f =
  let rec search a b steps =
    let middle = 0.5 *. (a +. b) in
    if steps = 0 then middle
    else if (f a < 0.0) = (f middle < 0.0) then search middle b (steps - 1)
    else search a middle (steps - 1) in
  let start = f 0.0 and finish = f 1.0 in
  if Float.is_nan start || Float.is_nan finish || (start < 0.0) = (finish < 0.0) then None
  else Some (search 0.0 1.0 50)

let moving_of box =
  let numbered = List.mapi (fun j state -> j, state) box.region.Kernel.states in
  List.filter_map (fun (j, state) -> if state = Kernel.Moving then Some j else None) numbered

(* A shorter interval of t that holds the branch for all mu of the box, with room on both sides. *)
let narrowed c v n k box =
  let reversed = (List.nth v.anchoring.Kernel.box_anchors n).reversed_anchor in
  let turned = if reversed then Kernel.swap else Fun.id in
  let region = box.region in
  match local_parts c v n region with
  | None -> None
  | Some (parts, _) ->
    let order = k :: List.filter (fun j -> j <> k) (moving_of box) in
    spend (50 * List.length order);
    let place e = change_of_sign (pivot_row parts order (Q.to_float (value_of e))) in
    match place box.low, place box.high with
    | Some a, Some b ->
      let room = abs_float (b -. a) +. 1e-6 in
      let start, finish =
        if reversed then turned region.upper, turned region.lower
        else region.lower, region.upper in
      let lower = value_of start and upper = value_of finish in
      let at u =
        if u <= 0.0 then start
        else if u >= 1.0 then finish
        else point_of (Q.add lower (Q.mul (Q.of_float u) (Q.sub upper lower))) in
      let first = turned (at (min a b -. room)) and last = turned (at (max a b +. room)) in
      let lower, upper = if reversed then last, first else first, last in
      Some { box with region = { region with lower; upper } }
    | _ -> None

let attempt c v n k box =
  match local_parts c v n box.region with
  | None -> None
  | Some (parts, grain) ->
    spend_box (Array.length c.slip) box;
    let region = { local_unit with states = box.region.states } in
    let piece piece_witness =
      { Kernel.piece_end = box.high; piece_region = box.region; piece_anchor = n;
        piece_grain = grain; piece_witness } in
    Option.map piece (witness parts k region box)

(* The pieces of the kernel for one of the file. *)
let rec divide c v depth n k box =
  match attempt c v n k box with
  | Some piece -> [piece]
  | None ->
    let shorter = if List.mem k (moving_of box) then narrowed c v n k box else None in
    let box = Option.value shorter ~default:box in
    match if shorter = None then None else attempt c v n k box with
    | Some piece -> [piece]
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
    divide c v 8 (number piece) (position c.slip piece.piece_pivot) box in
  let rec all low = function
    | [] -> []
    | piece :: rest ->
      if Q.leq piece.piece_to (value_of low) then no_witness "the end of a piece";
      let first = of_piece low piece in
      List.rev_append (List.rev first) (all (point_of piece.piece_to) rest) in
  all c.mu_low pieces
