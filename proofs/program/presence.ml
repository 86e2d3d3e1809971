(* The elaborator of mceip-presence/1: from its pieces to those of the kernel. Untrusted.

   Inverses and null vectors are computed anew, for a box from the mean of its corners and for an
   edge from the mean of the two corners there.  Where the kernel refuses them the branch is located
   at both ends of the interval of mu, and intervals of t about it are tried; then the interval of
   mu is halved.  They need not lie in that of the file: any t >= 0 will do. *)

open Certificate
open Elaborate
open Critical

let anchors_of_pieces pieces =
  List.sort_uniq compare (List.map (fun piece -> piece.piece_anchor) pieces)

(* The number of variables up to which witnesses beyond doubles are tried: their products of
   fractions take long for more. *)
let most_beyond_doubles = 12

(* The first witness for some of the corners that holds. *)
let witness_that holds places numbers =
  let corners = List.filter (fun (n, _) -> List.mem n numbers) places.corners in
  let s = mean_of (List.map (matrix_at places) corners) in
  let holding exactness =
    Option.bind (regular_by exactness places corners s) (fun by ->
        List.find_opt holds (List.filter_map by [By_vector; Uniform])) in
  match holding Doubles with
  | None when List.length places.order <= most_beyond_doubles -> holding Beyond_doubles
  | found -> found

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

(* The value of t on the branch at a friction, in doubles.  The local pencil of an interval is a
   line, so the place that it gives holds only if the sign changes about it for the pencil there as
   well; else a part of the interval is looked for in which the sign changes. *)
let branch_at c v n order e (region : Kernel.region) =
  let reversed = (List.nth v.anchoring.Kernel.box_anchors n).reversed_anchor in
  let turn q = if reversed then Q.inv q else q in
  let mu = Q.to_float (value_of e) in
  let root (lower, upper) =
    let region = { region with Kernel.lower = point_of lower; upper = point_of upper } in
    match local_parts c v n region with
    | None -> None
    | Some (parts, _) ->
      spend (50 * List.length order);
      let start, finish = if reversed then upper, lower else lower, upper in
      let place u =
        let from = turn start in
        turn (Q.add from (Q.mul (Q.of_float u) (Q.sub (turn finish) from))) in
      Option.map place (change_of_sign (pivot_row parts order mu)) in
  let within (lower, upper) (a, b) =
    let rounded q = Q.of_float (Q.to_float q) in
    larger lower (rounded a), smaller upper (rounded b) in
  let rec refine steps (lower, upper) found =
    let part k = Q.div (Q.sub upper lower) (Q.of_int k) in
    let about t = within (lower, upper) (Q.sub t (part 8), Q.add t (part 8)) in
    let quarter i =
      let start = Q.add lower (Q.mul (Q.of_int i) (part 4)) in
      within (lower, upper) (Q.sub start (part 40), Q.add start (Q.add (part 4) (part 40))) in
    let shorter = Option.to_list (Option.map about found) @ List.init 4 quarter in
    let with_root i = if Q.geq (fst i) (snd i) then None else Option.map (fun t -> i, t) (root i) in
    match if steps = 0 then None else List.find_map with_root shorter with
    | Some (interval, t) -> refine (steps - 1) interval (Some t)
    | None -> found in
  let interval = value_of region.lower, value_of region.upper in
  if reversed && Q.sign (fst interval) <= 0 then None else refine 5 interval (root interval)

(* Intervals of t about the branch, the longest first. *)
let about_branch c v n k box =
  let order = k :: List.filter (fun j -> j <> k) (moving_of box) in
  let place e = branch_at c v n order e box.region in
  match place box.low, place box.high with
  | Some a, Some b ->
    let lower = smaller a b and upper = larger a b in
    let width = Q.sub (value_of box.region.upper) (value_of box.region.lower) in
    let gap = Q.div (Q.sub upper lower) (Q.of_int 4) in
    let rec rooms k room =
      if k = 0 || Q.lt room gap then []
      else room :: rooms (k - 1) (Q.div room (Q.of_int 3)) in
    List.map (fun room ->
        let lower = larger Q.zero (Q.sub lower room) and upper = Q.add upper room in
        let lower = point_of lower and upper = point_of upper in
        { box with region = { box.region with lower; upper } })
      (rooms 8 (Q.of_float (Q.to_float width)))
  | _ -> []

(* Intervals at the edge of [lo, hi], for the variable of an anchor: the whole interval, and shorter
   ones, in which the remainders are those of the edge. *)
let lengths lo hi =
  let width = Q.sub hi lo in
  List.map (fun k -> Q.mul width (Q.make Z.one (two_to k))) [0; 4; 12; 40; 130]

let attempt c v n k box =
  let reversed = (List.nth v.anchoring.Kernel.box_anchors n).reversed_anchor in
  let turn (region : Kernel.region) =
    if reversed then { region with lower = Kernel.swap region.upper;
                                   upper = Kernel.swap region.lower }
    else region in
  match local_parts c v n box.region with
  | None -> None
  | Some (parts, grain) ->
    spend_box (Array.length c.slip) box;
    let unit = { local_unit with states = box.region.states } in
    let ends (plain, friction) =
      Kernel.mixed box.low plain friction, Kernel.mixed box.high plain friction in
    let witness parts corners holds =
      Option.bind (places_of parts k unit box) (fun places ->
          witness_that holds places corners) in
    let low, high = ends parts in
    let inside w = Kernel.positive_vector w && Kernel.presence_inside low high unit k w in
    match witness parts [0; 1; 2; 3] inside with
    | None -> None
    | Some presence_box ->
      let over = turn box.region in
      let lo = value_of over.lower and hi = value_of over.upper in
      let edge corners (region : Kernel.region) =
        let parts_there =
          if region = over then Some parts
          else Option.map fst (new_local_parts ~grain c v n (turn region)) in
        Option.bind parts_there (fun parts ->
            let low, high = ends parts in
            let holds w = Kernel.presence_edge low high unit k w corners in
            Option.map (fun w -> region, (low, high), w) (witness parts corners holds)) in
      let start length = edge [0; 2] { over with upper = point_of (Q.add lo length) } in
      let finish length = edge [1; 3] { over with lower = point_of (Q.sub hi length) } in
      match List.find_map start (lengths lo hi), List.find_map finish (lengths lo hi) with
      | Some (first, starts, presence_start), Some (last, finishes, presence_finish) ->
        let w = { Kernel.presence_box; presence_start; presence_finish } in
        if Kernel.check_presence_piece (low, high) starts finishes unit w then
          Some { Kernel.piece_end = box.high; piece_region = box.region; piece_anchor = n;
                 piece_grain = grain; piece_after = first.upper; piece_before = last.lower;
                 piece_witness = w }
        else None
      | _ -> None

(* The pieces of the kernel for one of the file. *)
let rec divide c v depth n k box =
  match attempt c v n k box with
  | Some piece -> [piece]
  | None ->
    let shorter = if List.mem k (moving_of box) then about_branch c v n k box else [] in
    match List.find_map (attempt c v n k) shorter with
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
    divide c v 12 (number piece) (position c.slip piece.piece_pivot) box in
  let rec all low = function
    | [] -> []
    | piece :: rest ->
      if Q.leq piece.piece_to (value_of low) then no_witness "the end of a piece";
      let first = of_piece low piece in
      List.rev_append (List.rev first) (all (point_of piece.piece_to) rest) in
  all c.mu_low pieces
