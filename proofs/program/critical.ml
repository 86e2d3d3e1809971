(* The elaborator of mceip-critical/1: from its trees of boxes to that of the kernel. Untrusted.

   The factors of definite leaves are computed as those of other certificates (elaborate.ml), for
   the pencils at both ends of the interval of mu.  The inverse and the vectors of a regular leaf
   are computed anew, from the mean of the corners: the rows of the kernel's matrices have factors of
   their own. *)

open Certificate
open Elaborate

type box = { region : Kernel.region; low : Kernel.point; high : Kernel.point }

type context = {
  zero : Kernel.zero_system;  (* without particles of zero reaction: an empty list of them *)
  radii : Kernel.part_radii option;  (* of a body that stands for its members *)
  slip : int array;
  free_factor : Z.t;  (* of the free rows *)
  slip_factor : Z.t;  (* of the slip rows of both parts *)
  tail : critical_tail option;
  mu_low : Kernel.point;  (* the interval of the file *)
  mu_high : Kernel.point }

(* f_i / 2^b_i, common to both parts, as positive integers in one unit. *)
let common_scales (plain : Kernel.pencil) (friction : Kernel.pencil) slip factor =
  let beside row = List.map (fun (j, v) -> (j + plain.order, v)) row in
  let both = List.map2 (fun a b -> a @ beside b) in
  row_scales { plain with Kernel.rows_a = both plain.rows_a friction.rows_a;
                          rows_b = both plain.rows_b friction.rows_b } slip factor

(* Without free variables nothing is eliminated: the parts are the given pencils with rows scaled,
   in a unit that leaves the rounding of factors small. *)
let trivial_elimination plain friction slip factor =
  let none = List.map (fun _ -> []) slip in
  { Kernel.row_scale = common_scales plain friction slip factor; unit_of = two_to 56;
    right_w = none; left_va = none; left_vb = none; bound_c = Z.one; bound_d = Z.one; factor_scale = Z.zero;
    stiffness_factor = [] }, (none, none)

(* The pencil at a friction, z particles free, with the weights of its rows. *)
let whole_pencil c e =
  let pencil = Kernel.pencil_at c.zero e in
  pencil, row_weights pencil c.free_factor (Z.mul c.slip_factor (snd e))

(* Weights of complementarity rows alone say nothing of the whole pencil. *)
let by_whole c diagonal box =
  let at times e =
    let pencil, weights = whole_pencil c e in
    spend pencil.order;
    weighted_whole_leaf pencil (times pencil.Kernel.order weights) box.region in
  let with_weights times = match at times box.low with
    | None -> None
    | Some a -> Option.map (fun b -> Kernel.BoxWhole (a, b)) (at times box.high) in
  match diagonal with
  | _ when c.radii <> None -> None
  | Identity -> with_weights (fun _ weights -> weights)
  | Opposite when c.zero.zero_particles = [] -> with_weights opposite
  | Opposite | Weighted _ -> None

(* What the matrices at the corners of a box cost: entries and words. *)
let spend_box ns box =
  let words points = 1 + List.fold_left (fun n (p, q) -> n + bits p + bits q) 0 points / 64 in
  spent := !spent + ns * ns * words [box.region.lower; box.region.upper] * words [box.low; box.high];
  if !spent > 1 lsl 30 then Problem.not_verified "boxes beyond the limits of this program"

(* Factors at the ends of the interval of mu, for the local or the condensed parts. *)
let definite_box (plain, friction) diagonal region box =
  let at e = spend plain.Kernel.size_of; Kernel.mixed e plain friction in
  match definite_factors [at box.low; at box.high] diagonal region with
  | Some (d, [low; high]) -> Some (Kernel.BoxDefinite (d, low, high))
  | _ -> None

(* A corner of a box: the enclosed pencil at an end of the interval of mu, an end of the interval of
   t, and the factor that both ends bring into its matrix. *)
type corner = { enclosed : Kernel.enclosed; end_of_t : Kernel.point; times : Z.t }

let corners_of (plain, friction) (region : Kernel.region) box =
  let at_friction e =
    let enclosed = Kernel.mixed e plain friction in
    let corner end_of_t = { enclosed; end_of_t; times = Z.mul (snd e) (snd end_of_t) } in
    [corner region.lower; corner region.upper] in
  at_friction box.low @ at_friction box.high

let mean_of matrices =
  let share = Q.make Z.one (Z.of_int (List.length matrices)) in
  let add = Array.map2 (Array.map2 Q.add) in
  let sum = List.fold_left add (List.hd matrices) (List.tl matrices) in
  Array.map (Array.map (Q.mul share)) sum

(* For each row the room that a corner leaves for the widths, if these are the weights of [w], and
   the residual that has to fit in. *)
let room_at m (w : Kernel.regular) (center, radius) u =
  let row i y =
    let p = Kernel.combine_rows y (List.tl center) in
    let r = Kernel.combine_rows (List.map Z.abs y) (List.tl radius) in
    let weighted = Z.mul u (List.nth w.regular_widths i) in
    let gap = Z.sub weighted (Kernel.off_pivot m w u i p r) in
    let residual = Z.add (Z.abs (Kernel.against_right m w p)) (Kernel.against_radius m w r) in
    gap, residual in
  List.mapi row w.regular_inverse

(* Widths in proportion to 1 or to the components of the null vector. *)
type weights = Uniform | By_vector

let weights_of weights right =
  List.map (fun v -> match weights with
      | Uniform -> Z.one
      | By_vector -> Z.max Z.one (Z.abs v)) (List.tl right)

(* The widths that the corners allow: the least multiple of the weights, and one part in 2^bits
   more. *)
let with_widths bits m corners (w : Kernel.regular) =
  let rooms = List.concat_map (fun (n, matrices) ->
      room_at m w matrices (List.nth w.regular_units n)) corners in
  if List.exists (fun (gap, _) -> Z.sign gap <= 0) rooms then None
  else
    let ratios = List.map (fun (gap, residual) -> Q.make residual gap) rooms in
    let least = List.fold_left larger Q.zero ratios in
    let wider = Q.mul least (Q.make (Z.succ (two_to bits)) (two_to bits)) in
    let width weight =
      let exact = Q.mul wider (Q.of_bigint weight) in
      Z.succ (Z.fdiv (Q.num exact) (Q.den exact)) in
    Some { w with regular_widths = List.map width w.regular_widths }

(* A corner is given by its number and its matrices over the order of the kernel, where the pivot is
   the first. *)
type places = {
  order : int list;
  units : Z.t list;
  corners : (int * (Kernel.matrix * Kernel.matrix)) list }

let places_of parts k region box =
  let moving = Kernel.moving (fst parts) region in
  if not (List.mem k moving && finite region.Kernel.upper) then None
  else begin
    let order = k :: List.filter (fun j -> j <> k) moving in
    spend (4 * List.length order);
    let corners = corners_of parts region box in
    let matrices n c =
      n, (Kernel.restricted order (Kernel.center c.enclosed c.end_of_t),
          Kernel.restricted order (Kernel.radius c.enclosed c.end_of_t)) in
    let units = List.map (fun c -> c.times) corners in
    Some { order; units; corners = List.mapi matrices corners }
  end

(* The matrix of a corner. *)
let matrix_at places (n, (center, _)) =
  let times = List.nth places.units n in
  let entry z = Q.make z times in
  Array.of_list (List.map (fun row -> Array.of_list (List.map entry row)) center)

(* How exactly a witness is computed: from an inverse in doubles, or with [more] bits beyond these,
   where the margin is too narrow for that. *)
type exactness = Doubles | Beyond_doubles

let scaled bits v = if bits < 0 then Q.div_2exp v (- bits) else Q.mul_2exp v bits
let rounded bits v = let v = scaled bits v in Z.fdiv (Q.num v) (Q.den v)

(* y (2 - s y), rounded: an inverse with twice as many digits (Newton). *)
let newton_step bits s y =
  let m = Array.length s in
  let product a b = Array.init m (fun i -> Array.init m (fun j ->
      List.fold_left Q.add Q.zero (List.init m (fun l -> Q.mul a.(i).(l) b.(l).(j))))) in
  let next v w = scaled (- bits) (Q.of_bigint (rounded bits (Q.sub (Q.add v v) w))) in
  Array.map2 (Array.map2 next) y (product y (product s y))

(* Two steps of Newton make of the 50 bits of an inverse in doubles about 200. *)
let more = function Doubles -> 0 | Beyond_doubles -> 150

(* The witness for some corners by the inverse and the null vectors of s, over the order; a function
   of the weights of its widths. *)
let regular_by exactness places corners s =
  let m = List.length places.order - 1 in
  let block = Array.map (fun row -> Array.sub row 1 m) (Array.sub s 1 m) in
  let more = more exactness in
  let with_inverse (y, exponent) =
    let in_doubles = Array.map (Array.map (fun z -> scaled (- exponent) (Q.of_bigint z))) y in
    let step = newton_step (exponent + more) block in
    let x = match exactness with
      | Doubles -> in_doubles
      | Beyond_doubles -> step (step in_doubles) in
    let unit = max 0 (exponent + more) in
    let row_of row = Array.to_list (Array.map (rounded unit) row) in
    let sum f = List.fold_left Q.add Q.zero (List.init m f) in
    let null f =
      two_to (52 + more) :: List.init m (fun a -> rounded (52 + more) (Q.neg (sum (f a)))) in
    let left = null (fun a b -> Q.mul s.(0).(b + 1) x.(b).(a)) in
    let right = null (fun a b -> Q.mul x.(a).(b) s.(b + 1).(0)) in
    let along = Kernel.combine_rows left (fst (snd (List.hd corners))) in
    let w =
      { Kernel.regular_pivot = List.hd places.order;
        regular_inverse = List.map row_of (Array.to_list x);
        regular_units = List.map (fun z -> Z.shift_left z unit) places.units;
        regular_left = left; regular_right = right; regular_widths = []; regular_minus = false } in
    let w = { w with regular_minus = Z.sign (Kernel.against_right m w along) < 0 } in
    fun weights ->
      with_widths (30 + more) m corners { w with regular_widths = weights_of weights right } in
  let rounded =
    if m = 0 then Some ([||], precision)
    else rounded_inverse (Array.map (Array.map Q.to_float) block) in
  Option.map with_inverse rounded

(* A regular leaf of a decided box; k is a moving variable. *)
let regular_box parts k (region : Kernel.region) box =
  match places_of parts k region box with
  | None -> None
  | Some places ->
    let each = List.map (matrix_at places) places.corners in
    let mixed e = Kernel.mixed e (fst parts) (snd parts) in
    let low = mixed box.low and high = mixed box.high in
    List.find_map (fun s ->
        match Option.bind (regular_by Doubles places places.corners s) (fun by -> by Uniform) with
        | Some w when Kernel.box_regular low high region w -> Some (Kernel.BoxRegular w)
        | _ -> None) (mean_of each :: each)

(* The factors of the certificate, where the box is that of the tail. *)
let by_tail c box =
  match c.tail with
  | Some tail when c.radii = None && Q.equal tail.from (value_of box.region.lower)
                   && not (finite box.region.upper)
                   && box.low = c.mu_low && box.high = c.mu_high ->
    let at e (factor, mass_factor) =
      let pencil, whole_weights = whole_pencil c e in
      let twice = Z.mul (Z.of_int 2) (Z.mul c.slip_factor (snd e)) in
      let covered times f =
        { Kernel.end_scale = two_to (2 * f.exponent);
          end_factor = Kernel.Late (Z.mul twice times, rows_from f) } in
      let no_factor =
        { Kernel.end_scale = Z.one;
          end_factor = Kernel.Late (Z.zero, List.init pencil.order (fun _ -> (0, []))) } in
      let w = { Kernel.whole_weights;
                low_end = covered (snd box.region.lower) factor;
                high_end = Option.fold ~none:no_factor ~some:(covered Z.one) mass_factor } in
      if Kernel.check_whole pencil box.region w then Some w else None in
    (match at box.low tail.at_zero with
     | None -> None
     | Some a -> Option.map (fun b -> Kernel.BoxWhole (a, b)) (at box.high tail.at_below))
  | _ -> None

(* ---------- condensation about anchors *)

(* [numbers]: anchors of the certificate that are used, as numbers of the kernel's. *)
type anchored = {
  plain_pencil : Kernel.pencil;
  anchoring : Kernel.box_anchoring;
  families : (Kernel.anchor_family * Kernel.anchor_family) option array;
  numbers : (int * int) list }

let needs_anchor piece =
  List.exists (function
      | BoxFarkas _ | BoxDefinite _ | BoxRegular _ -> true
      | CutValue _ | CutFriction _ | Decide _ | BoxTail -> false) piece.box_tree

(* An anchor with both left sides in one unit, and of one length. *)
let box_anchor c plain friction slip (a : anchor) left_friction =
  let finest = List.fold_left (fun m (k, _) -> max m k) 0 in
  let e = finest (a.right @ a.left @ left_friction) in
  let ratio = Z.divexact c.slip_factor c.free_factor in
  let shifted factor (k, rows) =
    List.map (List.map (fun z -> Z.mul factor (Z.shift_left z (e - k)))) rows in
  let count = max (List.length a.left) (List.length left_friction) in
  let left l =
    List.map (shifted ratio) l @ List.init (count - List.length l) (fun _ -> []) in
  let turned = if a.reversed then Kernel.swap_pencil else Fun.id in
  { Kernel.reversed_anchor = a.reversed;
    plain_anchor =
      { Kernel.anchor_center = point_of a.center; anchor_unit = two_to e;
        anchor_right = List.map (shifted Z.one) a.right; anchor_left = left a.left;
        anchor_scale = common_scales (turned plain) (turned friction) slip c.slip_factor };
    friction_left = left left_friction }

(* [used]: numbers of the anchors that are needed, each once. *)
let anchored_of c plain friction slip (condensation : critical_condensation) used =
  let given = condensation.plain in
  let nf = List.length plain.Kernel.free and ns = List.length slip in
  let both k = match List.nth_opt given.anchors k, List.nth_opt condensation.left_friction k with
    | Some a, Some l -> a, l
    | _ -> no_witness "a piece names no anchor" in
  let chosen = List.map both used in
  limit_anchors nf ns (List.concat_map (fun ((a : anchor), l) -> [a; { a with left = l }]) chosen);
  let anchoring =
    { Kernel.stiffness_below = form_bound nf c.free_factor given.sigma (Some given.factor);
      mass_below = form_bound nf c.free_factor given.mass_sigma given.mass_factor;
      box_anchors = List.map (fun (a, l) -> box_anchor c plain friction slip a l) chosen } in
  { plain_pencil = plain; anchoring;
    families = Array.of_list (Kernel.box_expansions c.zero c.radii anchoring);
    numbers = List.mapi (fun i k -> (k, i)) used }

let anchors_of_boxes pieces =
  List.sort_uniq compare (List.filter_map (fun piece ->
      if needs_anchor piece then Some piece.box_anchor else None) pieces)

(* An anchor with W and V as power series of F^-1 G about a center, or about infinity. *)
let new_anchor c (plain : Kernel.pencil) (friction : Kernel.pencil) slip center =
  let free = plain.free in
  let nf = List.length free in
  let reversed_anchor = center = None in
  let turned (p : Kernel.pencil) = if reversed_anchor then Kernel.swap_pencil p else p in
  let plain = turned plain and friction = turned friction in
  let center = Option.value center ~default:Q.zero in
  let dense rows is js =
    let rows = Array.of_list rows and places = Hashtbl.create 64 in
    List.iteri (fun place j -> Hashtbl.replace places j place) js;
    let row i =
      let entries = Array.make (List.length js) 0.0 in
      List.iter (fun (j, v) -> match Hashtbl.find_opt places j with
          | Some place -> entries.(place) <- entries.(place) +. Z.to_float v
          | None -> ()) rows.(i);
      entries in
    Array.of_list (List.map row is) in
  let transposed m = Array.init nf (fun j -> Array.map (fun row -> row.(j)) m) in
  let times a b =
    Array.map (fun row -> Array.init (List.length slip) (fun j ->
        let sum = ref 0.0 in
        Array.iteri (fun k v -> sum := !sum +. v *. b.(k).(j)) row;
        !sum)) a in
  let combined f = Array.map2 (Array.map2 f) in
  let at_center = combined (fun a b -> a +. Q.to_float center *. b) in
  spend (4 * nf);
  let slope = dense plain.rows_b free free in
  Option.map (fun y ->
      let series a b =
        let rec more k last =
          if k = 0 then []
          else
            let next = times y (Array.map (Array.map (~-.)) (times slope last)) in
            next :: more (k - 1) next in
        let first = times y (at_center a b) in
        let second = times y (combined (-.) b (times slope first)) in
        let rounded m = Array.map (Array.map (fun v -> round_scaled v 60)) m in
        List.map (fun m -> Array.to_list (Array.map Array.to_list (rounded m)))
          (first :: second :: more 8 second) in
      let left (p : Kernel.pencil) =
        let block rows = transposed (dense rows slip free) in
        series (block p.rows_a) (block p.rows_b) in
      { Kernel.reversed_anchor;
        plain_anchor =
          { Kernel.anchor_center = point_of center; anchor_unit = two_to 60;
            anchor_right = series (dense plain.rows_a free slip) (dense plain.rows_b free slip);
            anchor_left = left plain;
            anchor_scale = common_scales plain friction slip c.slip_factor };
        friction_left = left friction })
    (inverse (at_center (dense plain.rows_a free free) slope))

(* Without free variables there is nothing to bound. *)
let nothing_bounded box_anchors =
  let bound = { trivial_bound with Kernel.bound_at = Z.one } in
  { Kernel.stiffness_below = bound; mass_below = bound; box_anchors }

(* Without free variables: anchors without matrices for t and for 1/t, in a unit that leaves the
   rounding small. *)
let anchored_without_free c (plain : Kernel.pencil) friction slip =
  let anchor reversed_anchor =
    { Kernel.reversed_anchor;
      plain_anchor =
        { Kernel.anchor_center = Kernel.zero; anchor_unit = two_to 64; anchor_right = [];
          anchor_left = []; anchor_scale = common_scales plain friction slip c.slip_factor };
      friction_left = [] } in
  let anchoring = nothing_bounded [anchor false; anchor true] in
  { plain_pencil = plain; anchoring;
    families = Array.of_list (Kernel.box_expansions c.zero c.radii anchoring); numbers = [] }

(* The local pencils of both parts over the interval of a region, and their grain. *)
let new_local_parts ?grain c v n (region : Kernel.region) =
  match v.families.(n) with
  | None -> None
  | Some (family, family') ->
    let b = List.nth v.anchoring.box_anchors n in
    let a = b.plain_anchor in
    let a' = Kernel.friction_anchor a b.friction_left in
    let stiffness = v.anchoring.stiffness_below and mass = v.anchoring.mass_below in
    let low_a, low_b, lo, hi =
      if b.reversed_anchor then
        mass, stiffness, Kernel.swap region.upper, Kernel.swap region.lower
      else stiffness, mass, region.lower, region.upper in
    let ns = Array.length c.slip in
    spend_local ns a region family;
    spend_local ns a' region family';
    if not (Kernel.proper_interval a low_a low_b lo hi) then None
    else begin
      let make grain =
        Kernel.local_pencil ns a low_a low_b family lo hi false grain,
        Kernel.widened c.radii
          (Kernel.local_pencil ns a' low_a low_b family' lo hi false grain) in
      let chosen () =
        let plain, friction = make Z.one in
        let largest (p : Kernel.enclosed) =
          List.fold_left (List.fold_left (fun m z -> max m (bits z))) 0
            (p.center_a @ p.center_b) in
        two_to (max 0 (max (largest plain) (largest friction) - 160)) in
      let grain = match grain with Some g -> g | None -> chosen () in
      Some (make grain, grain)
    end

(* The boxes of an interval share its pencils; the last few are kept. *)
let kept = ref []

let local_parts c v n (region : Kernel.region) =
  let key = (n, region.lower, region.upper) in
  match List.assoc_opt key !kept with
  | Some found -> found
  | None ->
    let found = new_local_parts c v n region in
    kept := (key, found) :: List.filteri (fun i _ -> i < 7) !kept;
    found

(* The evidence of [make] about both parts, condensed about anchor n. *)
let about c v n box make =
  match local_parts c v n box.region with
  | None -> None
  | Some ((plain, friction), grain) ->
    spend_box (Array.length c.slip) box;
    let region = { local_unit with states = box.region.states } in
    match make (plain, friction) region with
    | Some e when Kernel.check_parts plain friction region box.low box.high e ->
      Some (Kernel.AboutAnchor (n, grain, Kernel.Leaf e))
    | _ -> None

let as_whole = function
  | Some (Kernel.BoxWhole _ as l) -> Some (Kernel.WithoutAnchor l)
  | _ -> None

type direction = Along_value | Along_friction

(* Both halves, and the tree that joins theirs. *)
let cut_box box = function
  | Along_value ->
    let cut = point_of (cut_of box.region) in
    let region = box.region in
    { box with region = { region with upper = cut } },
    { box with region = { region with lower = cut } },
    fun first second -> Kernel.Split (cut, first, second)
  | Along_friction ->
    let cut = point_of (half (value_of box.low) (value_of box.high)) in
    { box with high = cut }, { box with low = cut },
    fun first second -> Kernel.CutFriction (cut, first, second)

(* One of the ways closes the box, or its halves are closed: cut in the first of the directions, and
   those halves in the others. *)
let rec close what directions ways box =
  match List.find_map (fun way -> way box) ways, directions with
  | Some l, _ -> Kernel.Leaf l
  | None, [] -> no_witness "%s" what
  | None, direction :: rest ->
    let first, second, both = cut_box box direction in
    let first = close what rest ways first in
    both first (close what rest ways second)

let six_times = List.init 6 (fun _ -> Along_value)

(* Radii are taken where they are largest in an interval, so members need shorter ones. *)
let along_value c =
  if c.radii = None then six_times else List.init 24 (fun _ -> Along_value)
let in_turn = List.concat (List.init 3 (fun _ -> [Along_value; Along_friction]))

let for_each c weights = one_for_each (Array.length c.slip) weights

let no_leaf node =
  match node with
  | CutValue _ | CutFriction _ | Decide _ -> assert false
  | BoxFarkas _ | BoxDefinite _ | BoxRegular _ | BoxTail -> ()

(* The rows of members as they are, with their radii, the free ones in the first part alone. *)
let exact_parts c (radii : Kernel.part_radii) free_factor =
  let plain = Kernel.part_plain c.zero and friction = Kernel.part_friction c.zero in
  let free = List.length plain.free in
  Kernel.exact_part free free_factor plain radii.plain_radii,
  Kernel.widened (Some (Kernel.radii_of_all free radii))
    (Kernel.exact_part free Z.zero friction radii.friction_radii)

(* The tail of a body with radii: its form is positive for all variables.  The factor makes the free
   rows those of the form. *)
let member_tail c radii box =
  let free_factor = Z.divexact c.slip_factor c.free_factor in
  let plain, friction = exact_parts c radii free_factor in
  spend (List.length plain.center_a);
  let ends e = signed_ends (Kernel.mixed e plain friction) box.region.lower box.region.upper in
  match ends box.low with
  | None -> no_witness "tail"
  | Some f ->
    match ends box.high with
    | None -> no_witness "tail"
    | Some f' -> Kernel.Leaf (Kernel.WithoutAnchor (Kernel.BoxSigned (free_factor, f, f')))

let anchored_leaf c v piece box node =
  no_leaf node;
  let number () = match List.assoc_opt piece.box_anchor v.numbers with
    | Some n -> n
    | None -> no_witness "a piece names no anchor" in
  let whole diagonal box = as_whole (by_whole c diagonal box) in
  match node with
  | BoxFarkas w ->
    let w = for_each c w in
    close "farkas" (along_value c) [fun box -> about c v (number ()) box (fun _ _ ->
        Some (Kernel.BoxFarkas w))] box
  | BoxDefinite diagonal ->
    let by_anchor box =
      about c v (number ()) box (fun parts region -> definite_box parts diagonal region box) in
    (match by_anchor box with
     | Some l -> Kernel.Leaf l
     | None ->
       match whole diagonal box with
       | Some l -> Kernel.Leaf l
       | None -> close "definite" (along_value c) [by_anchor] box)
  | BoxRegular pivot ->
    let k = position c.slip pivot in
    close "regular" in_turn [fun box -> about c v (number ()) box (fun parts region ->
        regular_box parts k region box)] box
  | _ ->
    match c.radii with
    | Some radii -> member_tail c radii box
    | None -> close "tail" [] [(fun box -> as_whole (by_tail c box)); whole Identity] box

(* ---------- without free variables *)

let leaf_of_parts c parts _ box node =
  no_leaf node;
  spend_box (Array.length c.slip) box;
  let found what ways =
    match List.find_map (fun way -> way box) ways with
    | Some l -> Kernel.Leaf l
    | None -> no_witness "%s" what in
  match node with
  | BoxFarkas w when parts <> None -> Kernel.Leaf (Kernel.BoxFarkas (for_each c w))
  | BoxDefinite diagonal ->
    let by_parts box =
      Option.bind parts (fun parts -> definite_box parts diagonal box.region box) in
    found "definite" [by_parts; by_whole c diagonal]
  | BoxRegular pivot ->
    let k = position c.slip pivot in
    close "regular" in_turn [fun box ->
        Option.bind parts (fun parts -> regular_box parts k box.region box)] box
  | BoxTail -> found "tail" [by_tail c; by_whole c Identity]
  | _ -> no_witness "a condensation is missing"

(* For members: the weights of the file are those of scaled rows. *)
let member_leaf_without_free c parts scales _ box node =
  no_leaf node;
  spend_box (Array.length c.slip) box;
  let scaled = List.map2 Z.mul scales in
  let closed what directions make =
    let checked box = match make box with
      | Some l when Kernel.check_parts (fst parts) (snd parts) box.region box.low box.high l ->
        Some (Kernel.WithoutAnchor l)
      | _ -> None in
    close what directions [checked] box in
  let definite diagonal box =
    let weights = match diagonal with
      | Identity -> scales
      | Opposite -> opposite (Array.length c.slip) scales
      | Weighted d -> scaled (for_each c d) in
    definite_box parts (Weighted weights) box.region box in
  match node with
  | BoxFarkas w ->
    let w = scaled (for_each c w) in
    closed "farkas" [] (fun _ -> Some (Kernel.BoxFarkas w))
  | BoxDefinite diagonal -> closed "definite" [] (definite diagonal)
  | BoxRegular pivot ->
    let k = position c.slip pivot in
    closed "regular" in_turn (fun box -> regular_box parts k box.region box)
  | _ -> closed "tail" [] (definite Identity)

(* ---------- trees *)

(* Leaves of one interval about one anchor become one leaf: its local pencils are made once.  A
   region in which both halves move needs none. *)
let rec join tree =
  let both inside around first second = match join first, join second with
    | Kernel.Leaf (Kernel.AboutAnchor (n, grain, t)),
      Kernel.Leaf (Kernel.AboutAnchor (n', grain', t')) when n = n' && Z.equal grain grain' ->
      Kernel.Leaf (Kernel.AboutAnchor (n, grain, inside t t'))
    | Kernel.Leaf (Kernel.AboutAnchor (n, grain, t)),
      Kernel.Leaf (Kernel.WithoutAnchor Kernel.BoxHalves) ->
      Kernel.Leaf (Kernel.AboutAnchor (n, grain, inside t (Kernel.Leaf Kernel.BoxHalves)))
    | first, second -> around first second in
  match tree with
  | Kernel.CutFriction (m, first, second) ->
    let cut t t' = Kernel.CutFriction (m, t, t') in
    both cut (fun t t' -> Kernel.CutFriction (m, t, t')) first second
  | Branch (i, first, second) ->
    let decide t t' = Kernel.Branch (i, t, t') in
    both decide (fun t t' -> Kernel.Branch (i, t, t')) first second
  | Split (t, first, second) -> Kernel.Split (t, join first, join second)
  | Leaf _ -> tree

(* The other half of v_T at the particle of the k-th complementarity variable, if that is a half and
   the other one is not at rest in the region. *)
let other_half c k region =
  let i = c.slip.(k) - Kernel.gap c.zero 0 in
  let other = if i < 0 then k else match i mod 3 with 1 -> k + 1 | 2 -> k - 1 | _ -> k in
  if other = k || Kernel.state_of region other = Kernel.Resting then None else Some other

(* The nodes of a piece in preorder.  Where a half moves the other one is at rest; [halves] closes
   the region in which both move. *)
let build_piece c leaf halves nodes box =
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
      Kernel.Split (t, first, second), rest
    | CutFriction m :: rest ->
      let m = point_of m in
      let first, second, rest = both { box with high = m } { box with low = m } rest in
      Kernel.CutFriction (m, first, second), rest
    | Decide i :: rest ->
      let i = position c.slip i in
      let decided states =
        let decide region (j, state) = Kernel.decide j state region in
        { box with region = List.fold_left decide region states } in
      (match other_half c i region with
       | None ->
         let first, second, rest =
           both (decided [i, Kernel.Resting]) (decided [i, Kernel.Moving]) rest in
         Kernel.Branch (i, first, second), rest
       | Some other ->
         let first, second, rest = both (decided [i, Kernel.Resting])
             (decided [i, Kernel.Moving; other, Kernel.Resting]) rest in
         Kernel.Branch (i, first, Kernel.Branch (other, second, Kernel.Leaf halves)), rest)
    | node :: rest -> leaf box node, rest in
  match build 0 box nodes with
  | tree, [] -> tree
  | _ -> no_witness "a tree has a node too many"

(* The pieces of [0, infinity) as one tree. *)
let build c leaf halves pieces =
  if List.length pieces > 10_000 then no_witness "more than 10,000 pieces";
  let rec join lower = function
    | [] -> no_witness "pieces that end before infinity"
    | piece :: rest ->
      if (piece.box_max = None) <> (rest = []) then no_witness "pieces that end before infinity";
      let upper = upper_point piece.box_max in
      let region = { Kernel.lower; upper; states = [] } in
      let box = { region; low = c.mu_low; high = c.mu_high } in
      let tree = build_piece c (leaf piece) halves piece.box_tree box in
      if rest = [] then tree else Kernel.Split (upper, tree, join upper rest) in
  join Kernel.zero pieces
