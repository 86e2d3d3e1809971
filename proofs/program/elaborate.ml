(* The elaborator: from the tree of a certificate to the tree of the kernel. Untrusted.

   It computes, in doubles and then rounded to integers, the witnesses that the kernel asks for: a
   factor at each end of a definite leaf, approximate inverses and widths for a root leaf.  If a
   witness is wrong, the kernel refuses it; nothing that is done here can make a false statement
   accepted.  [No_witness] means that no witness was found for a leaf. *)

open Certificate

exception No_witness of string

let no_witness fmt = Printf.ksprintf (fun text -> raise (No_witness text)) fmt

let two_to k = Z.shift_left Z.one k
let point_of, upper_point, value_of = Problem.(point_of, upper_point, value_of)
let bits z = Z.numbits (Z.abs z)

(* ---------- matrices of doubles *)

let cholesky s =
  let n = Array.length s in
  let l = Array.make_matrix n n 0.0 in
  let ok = ref true in
  for i = 0 to n - 1 do
    if !ok then
      for j = 0 to i do
        let sum = ref s.(i).(j) in
        for k = 0 to j - 1 do sum := !sum -. l.(i).(k) *. l.(j).(k) done;
        if i = j && (!sum <= 0.0 || Float.is_nan !sum) then ok := false
        else if i = j then l.(i).(i) <- sqrt !sum
        else if !ok then l.(i).(j) <- !sum /. l.(j).(j)
      done
  done;
  if !ok then Some l else None

let inverse s =
  let n = Array.length s in
  let x = Array.init n (fun i -> Array.init (2 * n) (fun j ->
      if j < n then s.(i).(j) else if j - n = i then 1.0 else 0.0)) in
  let regular = ref true in
  for c = 0 to n - 1 do
    if !regular then begin
      let p = ref c in
      for i = c + 1 to n - 1 do
        if abs_float x.(i).(c) > abs_float x.(!p).(c) then p := i
      done;
      if x.(!p).(c) = 0.0 || Float.is_nan x.(!p).(c) then regular := false
      else begin
        let row = x.(!p) in
        x.(!p) <- x.(c);
        let d = row.(c) in
        x.(c) <- Array.map (fun v -> v /. d) row;
        for i = 0 to n - 1 do
          let g = x.(i).(c) in
          if i <> c && g <> 0.0 then
            for j = c to 2 * n - 1 do x.(i).(j) <- x.(i).(j) -. g *. x.(c).(j) done
        done
      end
    end
  done;
  if !regular then Some (Array.map (fun row -> Array.sub row n n) x) else None

let largest s =
  Array.fold_left (fun m row -> Array.fold_left (fun m v -> max m (abs_float v)) m row) 0.0 s

let round_scaled v k =
  if Float.is_nan v || Float.is_integer v && v = 0.0 then Z.zero
  else if Float.abs v = infinity then no_witness "an overflow"
  else
    let mantissa, exponent = Float.frexp v in
    let z = Z.of_float (Float.ldexp mantissa 53) in
    let shift = exponent - 53 + k in
    if shift >= 0 then Z.shift_left z shift
    else if shift < -2000 then Z.zero
    else Z.shift_right (Z.add z (two_to (-shift - 1))) (-shift)

(* ---------- factors of integer matrices *)

(* Rows L with L L' a little below the integer matrix s. *)
let factor_rows strict s =
  let n = Array.length s in
  let top = Array.fold_left (fun m row -> Array.fold_left (fun m v -> max m (bits v)) m row) 0 s in
  if top = 0 then (if strict && n > 0 then None else Some (Array.make_matrix n n Z.zero))
  else begin
    let shift = let k = max 0 (top - 900) in k + (k land 1) in
    let f = Array.map (Array.map (fun v -> Z.to_float (Z.shift_right v shift))) s in
    let scale = largest f in
    let rec attempt = function
      | [] -> None
      | margin :: rest ->
        let x = Array.mapi (fun i row ->
            Array.mapi (fun j v -> if i = j then v -. margin v else v) row) f in
        match cholesky x with
        | Some l -> Some (Array.map (Array.map (fun v -> round_scaled v (shift / 2))) l)
        | None -> attempt rest in
    let of_largest d _ = d *. scale and of_own d v = d *. v in
    (* Weights give rows of different orders of magnitude; then each has a margin of its own. *)
    attempt (List.map of_largest [1e-4; 1e-6; 1e-7; 1e-8; 1e-9; 1e-10; 1e-11; 1e-12; 1e-13]
             @ List.map of_own [1e-3; 1e-6; 1e-9])
  end

let late_row row =
  let n = Array.length row in
  let first = ref 0 in
  while !first < n && Z.sign row.(!first) = 0 do incr first done;
  (!first, Array.to_list (Array.sub row !first (n - !first)))

(* Exact L D L' of a rational symmetric matrix, with D >= 0. *)
let exact_ldl s =
  let n = Array.length s in
  let l = Array.init n (fun i -> Array.init n (fun j -> if i = j then Q.one else Q.zero)) in
  let d = Array.make n Q.zero in
  let ok = ref true in
  for j = 0 to n - 1 do
    if !ok then begin
      let sum = ref s.(j).(j) in
      for k = 0 to j - 1 do sum := Q.sub !sum (Q.mul d.(k) (Q.mul l.(j).(k) l.(j).(k))) done;
      d.(j) <- !sum;
      if Q.sign !sum < 0 then ok := false;
      for i = j + 1 to n - 1 do
        let sum = ref s.(i).(j) in
        for k = 0 to j - 1 do sum := Q.sub !sum (Q.mul d.(k) (Q.mul l.(i).(k) l.(j).(k))) done;
        if Q.sign d.(j) > 0 then l.(i).(j) <- Q.div !sum d.(j)
        else if Q.sign !sum <> 0 then ok := false
      done
    end
  done;
  if !ok then Some (l, d) else None

(* Ways to a factor of a form of n rows: the scale of the form, weights (none: 1) and rows.
   [form c] is c times the form. *)
let ways_with_scale strict n form =
  let rounded () =
    let c = two_to 112 in
    Option.map (fun rows -> (c, None, rows)) (factor_rows strict (form c)) in
  (* 2^k S - I for a strict end, S for a weak one. *)
  let exact k () =
    let s = Array.mapi (fun i row -> Array.mapi (fun j v ->
        let v = Z.shift_left v k in
        Q.of_bigint (if strict && i = j then Z.pred v else v)) row) (form Z.one) in
    Option.map (fun (l, d) ->
        let common = Array.fold_left (fun c v -> Z.lcm c (Q.den v)) Z.one in
        let cl = Array.fold_left (fun c row -> Z.lcm c (common row)) Z.one l and cd = common d in
        let times c v = Q.num (Q.mul v (Q.of_bigint c)) in
        let weights = Array.to_list (Array.map (times cd) d) in
        let scale = Z.mul (two_to k) (Z.mul cd (Z.mul cl cl)) in
        (scale, Some weights, Array.map (Array.map (times cl)) l))
      (exact_ldl s) in
  let shifts = if strict then [0; 8; 24; 60; 120; 300; 1000] else [0] in
  rounded :: (if n > 128 then [] else List.map exact shifts)

(* The first of the ways that the kernel accepts. *)
let first_accepted make accepted ways =
  let attempt way = match way () with
    | None -> None
    | Some found -> let w = make found in if accepted w then Some w else None in
  List.find_map attempt ways

let integer_rows rows = Array.to_list (Array.map Array.to_list rows)

let whole_end pencil weights strict e region =
  let members = Array.of_list (Kernel.members pencil weights region) in
  let n = Array.length members in
  let form c = Array.init n (fun i -> Array.init n (fun j ->
      Kernel.member_form c e members.(i) members.(j))) in
  let make (end_scale, weights, rows) =
    let end_factor = match weights with
      | None -> Kernel.Late (Z.one, Array.to_list (Array.map late_row rows))
      | Some weights -> Kernel.Dense (weights, integer_rows rows) in
    { Kernel.end_scale; end_factor } in
  first_accepted make (Kernel.check_end pencil weights strict e region)
    (ways_with_scale strict n form)

(* Weights that undo the factors by which the rows were made integers. *)
let row_weights (pencil : Kernel.pencil) common slip_common =
  if Z.equal common slip_common then []
  else
    List.init pencil.order (fun i ->
        if List.mem i pencil.free then Z.divexact slip_common common else Z.one)

(* For the kernel a weight that is missing is 1. *)
let opposite n = function
  | [] -> List.init n (fun _ -> Z.minus_one)
  | weights -> List.map Z.neg weights

(* A leaf of the whole pencil, definite with these weights. *)
let weighted_whole_leaf pencil weights (region : Kernel.region) =
  let finite = Z.sign (snd region.upper) > 0 in
  match whole_end pencil weights true region.lower region with
  | None -> None
  | Some low_end ->
    match whole_end pencil weights finite region.upper region with
    | None -> None
    | Some high_end -> Some { Kernel.whole_weights = weights; low_end; high_end }

(* With these weights, or with their opposites. *)
let whole_leaf (pencil : Kernel.pencil) weights region =
  match weighted_whole_leaf pencil weights region with
  | Some w -> Some w
  | None -> weighted_whole_leaf pencil (opposite pencil.order weights) region

(* The work of the search for witnesses: a file ends in bounded time. *)
let work = ref 0

let spend order =
  work := !work + 1_000 + order * order * order;
  if !work > 1 lsl 32 then no_witness "limits of this program"

(* ---------- leaves of the condensed pencil *)

(* Weights of a file: one for each of the n complementarity variables. *)
let one_for_each n weights =
  if List.compare_length_with weights n <> 0 then no_witness "a list of weights of another length";
  weights

(* The weights of the kernel, times 2^k: a factor common to all changes nothing, and makes the
   rounding of the factor of a form small beside the least weight. *)
let diagonal_weights n k = function
  | Identity -> List.init n (fun _ -> two_to k)
  | Opposite -> List.init n (fun _ -> Z.neg (two_to k))
  | Weighted d -> List.map (fun w -> Z.shift_left w k) (one_for_each n d)

(* Ways to a factor of a form, as weights and rows: one in doubles. *)
let ways_in_doubles strict s =
  let with_ones rows = (List.map (fun _ -> Z.one) rows, rows) in
  [fun () -> Option.map (fun rows -> with_ones (integer_rows rows)) (factor_rows strict s)]

(* L D L' of the form less 2^-margin of its largest entry, rounded.  L and D need some 4 margin bits
   in all, so the weights are multiplied by 2^exact_bits. *)
let exact_bits = 2_048
let exact_order = 12

let ways_in_fractions s =
  let n = Array.length s in
  let top = Array.fold_left (Array.fold_left (fun m v -> max m (bits v))) 0 s in
  let at_margin margin () =
    spend (4 * n);
    let lower i j v = if i = j then Z.sub v (two_to (max 0 (top - margin))) else v in
    let lowered = Array.mapi (fun i row ->
        Array.mapi (fun j v -> Q.of_bigint (lower i j v)) row) s in
    let digits = margin + 64 in
    let rounded shift v = Z.fdiv (Z.shift_left (Q.num v) shift) (Q.den v) in
    let weight v = Z.shift_right (rounded 0 v) (2 * digits) in
    Option.map (fun (l, d) ->
        let rows = Array.map (Array.map (rounded digits)) l in
        (Array.to_list (Array.map weight d), integer_rows rows))
      (exact_ldl lowered) in
  if n > exact_order then [] else List.map at_margin [16; 64; 128; 256; 400]

(* Weights and, for each of these pencils, factors at both ends. *)
let definite_factors pencils diagonal (region : Kernel.region) =
  let by k ways =
    let order = (List.hd pencils).Kernel.size_of in
    let d = diagonal_weights order k diagonal in
    let factors (p : Kernel.enclosed) =
      let active = Array.of_list (Kernel.active p region) in
      let factor strict e =
        let entry i j = Kernel.symmetric_part p d e i j in
        let s = Array.map (fun i -> Array.map (entry i) active) active in
        first_accepted (fun (weights, factor_rows) -> { Kernel.weights; factor_rows })
          (Kernel.definite_end p d strict e region) (ways strict s) in
      match factor true region.lower with
      | None -> None
      | Some low ->
        let is_finite = Z.sign (snd region.upper) > 0 in
        Option.map (fun high -> (low, high)) (factor is_finite region.upper) in
    let found = List.map factors pencils in
    if List.mem None found then None else Some (d, List.filter_map Fun.id found) in
  match by 64 ways_in_doubles with
  | Some found -> Some found
  | None -> by exact_bits (fun strict s -> ways_in_doubles strict s @ ways_in_fractions s)

let definite_leaf p diagonal region =
  match definite_factors [p] diagonal region with
  | Some (d, [low, high]) -> Some (Kernel.Definite (d, low, high))
  | _ -> None

(* Factors of the forms at both ends for vectors of any signs (Signed.v). *)
let signed_ends (p : Kernel.enclosed) lo hi =
  let n = p.size_of in
  let at strict e =
    let form c = Array.init n (fun i -> Array.init n (fun j ->
        Z.mul c (Kernel.signed_part p e i j))) in
    let make (scale, weights, rows) =
      let weights = Option.value weights ~default:(List.init n (fun _ -> Z.one)) in
      scale, { Kernel.weights; factor_rows = integer_rows rows } in
    first_accepted make (Kernel.signed_end p strict e)
      (ways_with_scale strict n form) in
  match at true lo, at (Z.sign (snd hi) > 0) hi with
  | Some low, Some high -> Some (low, high)
  | _ -> None

(* T(t) in doubles, and B. *)
type doubles = { a : float array array; b : float array array }

let doubles_of (p : Kernel.enclosed) =
  let convert m = Array.of_list (List.map (fun row -> Array.of_list (List.map Z.to_float row)) m) in
  { a = convert p.center_a; b = convert p.center_b }

let at f t i j = f.a.(i).(j) +. t *. f.b.(i).(j)

let middle lo hi = Q.to_float (Q.div (Q.add lo hi) (Q.of_int 2))

(* An n x n table with the given block. *)
let table n rows cols block =
  let t = Array.make_matrix n n Z.zero in
  Array.iteri (fun i r -> Array.iteri (fun j c -> t.(r).(c) <- block.(i).(j)) cols) rows;
  Array.to_list (Array.map Array.to_list t)

let precision = 50

(* Y and the exponent of the unit: Y S is about 2^exponent I. *)
let rounded_inverse s =
  let _, top = Float.frexp (max (largest s) 1e-300) in
  match inverse (Array.map (Array.map (fun v -> Float.ldexp v (-top))) s) with
  | None -> None
  | Some y -> Some (Array.map (Array.map (fun v -> round_scaled v precision)) y, top + precision)

let box_of (p : Kernel.enclosed) f j_list k_list v (e1, e2) t =
  let k = Array.of_list k_list in
  spend (Array.length k);
  let s = Array.map (fun i -> Array.map (fun j -> at f t i j) k) k in
  let y = if k = [||] then Some ([||], 60) else rounded_inverse s in
  match y with
  | None -> None
  | Some (_, exponent) when exponent < 0 -> None
  | Some (y, exponent) ->
    let y = table p.size_of k k y in
    let unit_at e =
      if Z.sign (snd e) > 0 then Z.mul (two_to exponent) (snd e) else two_to exponent in
    let widths = List.concat_map (fun e ->
        let u = unit_at e in
        List.map (fun i ->
            let gap = Z.sub u (Kernel.defect p k_list y u e i) in
            if Z.sign gap <= 0 then None
            else Some (Z.cdiv (Kernel.residual p j_list k_list v y e i) gap)) k_list) [e1; e2] in
    if List.mem None widths then None
    else
      let width = List.fold_left Z.max Z.zero (List.filter_map Fun.id widths) in
      Some { Kernel.inverse = y; unit_low = unit_at e1; unit_high = unit_at e2; width }

(* Null vectors of T(t) on both sides, 1 at the pivot, in units of 2^-52. *)
let null_vectors n f j_list k t =
  let others = Array.of_list (List.filter (fun j -> j <> k) j_list) in
  let block = Array.map (fun i -> Array.map (fun j -> at f t i j) others) others in
  match inverse block with
  | None -> None
  | Some y ->
    let unit = 52 in
    let right = Array.make n Z.zero and left = Array.make n Z.zero in
    right.(k) <- two_to unit; left.(k) <- two_to unit;
    Array.iteri (fun a i ->
        let r = ref 0.0 and l = ref 0.0 in
        Array.iteri (fun b j ->
            r := !r -. y.(a).(b) *. at f t j k;
            l := !l -. at f t k j *. y.(b).(a)) others;
        right.(i) <- round_scaled !r unit;
        left.(i) <- round_scaled !l unit) others;
    Some (Array.to_list right, Array.to_list left)

let unique_of (p : Kernel.enclosed) f j_list k v eps (e1, e2) t =
  let j = Array.of_list j_list in
  let v_float = Array.of_list (List.map Z.to_float v) in
  let h = Array.map (fun l ->
      Array.fold_left (fun s c -> s +. f.b.(l).(c) *. v_float.(c)) 0.0 j) j in
  let size_h = Array.fold_left (fun m x -> max m (abs_float x)) 0.0 h in
  let size_t = Array.fold_left (fun m l -> Array.fold_left (fun m c ->
      if c = k then m else max m (abs_float (at f t l c))) m j) 0.0 j in
  let balanced =
    if size_h = 0.0 then 0
    else if size_t = 0.0 then 0
    else max 0 (snd (Float.frexp size_h) - snd (Float.frexp size_t)) in
  let attempt w =
    spend (Array.length j);
    if w < 0 then None
    else
      let s = Array.mapi (fun a l -> Array.map (fun c ->
          if c = k then Float.ldexp h.(a) (-w) else at f t l c) j) j in
      match rounded_inverse s with
      | None -> None
      | Some (_, exponent) when exponent < 0 -> None
      | Some (y, exponent) ->
        let unit_at e =
          if Z.sign (snd e) > 0 then Z.mul (two_to (w + exponent)) (snd e) else Z.one in
        let u = { Kernel.system_inverse = table p.size_of j j y; system_unit_low = unit_at e1;
                  system_unit_high = unit_at e2; system_rate = two_to w } in
        if Kernel.check_unique p j_list k v u eps e1 e2 then Some u else None in
  let rec search = function
    | [] -> None
    | d :: rest -> (match attempt (balanced + d) with Some u -> Some u | None -> search rest) in
  search [0; 2; -2; 4; -4; 6; -6; 8; -8; 11; -11; 14; -14; 18; -18; 22; -22; 28; -28; 36; -36]

let finite (_, q) = Z.sign q > 0

let smaller a b = if Q.lt b a then b else a
let larger a b = if Q.lt a b then b else a

(* The smallest interval with that of the region and [a, b]. *)
let hull (region : Kernel.region) (a, b) =
  point_of (smaller (value_of region.lower) a),
  if finite region.upper then point_of (larger (value_of region.upper) b) else region.upper

(* The vectors of a root leaf, over all complementarity variables. *)
let spread n j_list k exponent l =
  let others = List.filter (fun j -> j <> k) j_list in
  if List.length l <> List.length others then None
  else begin
    let v = Array.make n Z.zero in
    v.(k) <- two_to exponent;
    List.iter2 (fun i x -> v.(i) <- x) others l;
    Some (Array.to_list v)
  end

let isolated_leaf ?ends p f (region : Kernel.region) (r : root) outcome =
  let j_list = Kernel.moving p region in
  if not (finite region.upper) then None
  else begin
    let a, b = r.interval in
    let wide = hull region r.interval in
    let narrow = Option.value ends ~default:(point_of a, point_of b) in
    let extended = Kernel.extended region wide in
    let center = middle (value_of (fst wide)) (value_of (snd wide)) in
    let pivots = r.pivot :: List.filter (fun j -> j <> r.pivot) j_list in
    let pivots = if ends = None then pivots else List.filteri (fun i _ -> i < 3) pivots in
    let attempt k =
      let k_list = List.filter (fun j -> j <> k) j_list in
      let n = p.Kernel.size_of in
      let own = Option.to_list (null_vectors n f j_list k (middle a b)) in
      let given =
        if k <> r.pivot then None
        else match spread n j_list k r.exponent r.right, spread n j_list k r.exponent r.left with
          | Some right, Some left -> Some (right, left)
          | _ -> None in
      List.find_map (fun (v, left) ->
          match box_of p f j_list k_list v wide center,
                box_of p f j_list k_list v narrow (middle a b) with
          | Some wide_box, Some narrow_box ->
            (match unique_of p f j_list k v wide_box.width wide center with
             | None -> None
             | Some unique ->
               let c = { Kernel.pivot = k; vector = v; from_point = fst narrow;
                         to_point = snd narrow; wide_box; narrow_box; unique;
                         left_vector = left } in
               if Kernel.check_root p extended c outcome then Some (Kernel.Root (wide, c, outcome))
               else None)
          | _ -> None) (Option.to_list given @ own) in
    List.find_map attempt pivots
  end

(* A region with at most one null vector, near v: boxes and uniqueness over the interval [wide]. *)
let pinning_of p f j_list k v wide center =
  let k_list = List.filter (fun j -> j <> k) j_list in
  match box_of p f j_list k_list v wide center with
  | None -> None
  | Some box ->
    Option.map (fun unique ->
        { Kernel.pin_pivot = k; pin_vector = v; pin_box = box; pin_unique = unique;
          pin_reversed = false })
      (unique_of p f j_list k v box.width wide center)

(* The same for an interval [lo, infinity), with s = 1/t in [0, 1/lo] and A and B exchanged. *)
let reversed_pinning_of p f j_list k v (lower, upper) =
  if Z.sign (fst lower) <= 0 then None
  else begin
    let ends = (Kernel.swap upper, Kernel.swap lower) in
    let center = Q.to_float (Q.div (Q.inv (value_of lower)) (Q.of_int 2)) in
    Option.map (fun (c : Kernel.pinning) ->
        let box = c.pin_box in
        { c with
          Kernel.pin_box = { box with Kernel.unit_low = box.unit_high; unit_high = box.unit_low };
          pin_reversed = true })
      (pinning_of (Kernel.reversed p) { a = f.b; b = f.a } j_list k v ends center)
  end

(* The region of a claim: at most one null vector, that of the known solution. *)
let claimed_leaf p f (region : Kernel.region) (r : root) number (q : Kernel.known) =
  let j_list = Kernel.moving p region and n = p.Kernel.size_of in
  let value = (value_of q.known_from, value_of q.known_to) in
  let wide = hull region value in
  let extended = Kernel.extended region wide in
  let pivots = List.filter (fun j -> List.mem j q.known_support) j_list in
  let first, others = List.partition (fun k -> k = r.pivot) pivots in
  let attempt k =
    let own = Option.map fst (null_vectors n f j_list k (middle (fst value) (snd value))) in
    let given = if k = r.pivot then spread n j_list k r.exponent r.right else None in
    List.find_map (fun v ->
        let pinning =
          if finite (snd wide) then
            pinning_of p f j_list k v wide (middle (value_of (fst wide)) (value_of (snd wide)))
          else reversed_pinning_of p f j_list k v wide in
        match pinning with
        | Some c when Kernel.check_claimed p extended c q ->
          Some (Kernel.Claimed (wide, c, number))
        | _ -> None) (Option.to_list given @ Option.to_list own) in
  List.find_map attempt (first @ others)

(* The region of a limit: at most one null vector, that at infinity. [x] is over the pencil, [at]
   are its components at the complementarity variables. *)
let limit_pinning p (region : Kernel.region) at pin accepted =
  let j_list = Kernel.moving p region in
  let size k = Z.abs at.(k) in
  let pivots = List.sort (fun k l -> Z.compare (size l) (size k))
      (List.filter (fun k -> Z.sign at.(k) <> 0) j_list) in
  let attempt k =
    let sign = Z.of_int (Z.sign at.(k)) in
    let shift = max 0 (52 - bits at.(k)) in
    let v = Array.to_list (Array.map (fun z -> Z.shift_left (Z.mul sign z) shift) at) in
    match pin j_list k v with
    | Some c when accepted c -> Some c
    | _ -> None in
  List.find_map attempt pivots

let infinite_leaf p f (region : Kernel.region) x at =
  let wide = (region.lower, region.upper) in
  Option.map (fun c -> Kernel.Infinite (wide, c, x))
    (limit_pinning p region at (fun j_list k v -> reversed_pinning_of p f j_list k v wide)
       (Kernel.check_infinite p region))

let absent_leaf p f (region : Kernel.region) =
  let j_list = Kernel.moving p region in
  let lo = value_of region.lower in
  let t = if finite region.upper then middle lo (value_of region.upper) else Q.to_float lo in
  let attempt k =
    let k_list = List.filter (fun j -> j <> k) j_list in
    match null_vectors p.Kernel.size_of f j_list k t with
    | None -> None
    | Some (v, left) ->
      match box_of p f j_list k_list v (region.lower, region.upper) t with
      | None -> None
      | Some box ->
        let c = { Kernel.absent_pivot = k; absent_vector = v; absent_box = box;
                  absent_left = left } in
        if Kernel.check_absent p region c then Some (Kernel.Absent c) else None in
  List.find_map attempt j_list

(* A decided interval without a null vector, in pieces. *)
let rec absent_tree p f depth (region : Kernel.region) =
  let ways = [ (fun () -> absent_leaf p f region); (fun () -> definite_leaf p Identity region);
               (fun () -> definite_leaf p Opposite region) ] in
  match List.find_map (fun way -> way ()) ways with
  | Some leaf -> Kernel.Leaf leaf
  | None ->
    if depth = 0 then no_witness "absent";
    let lo = value_of region.lower in
    let cut =
      if finite region.upper then Q.div (Q.add lo (value_of region.upper)) (Q.of_int 2)
      else Q.add (Q.mul lo (Q.of_int 4)) Q.one in
    let cut = point_of cut in
    let first = absent_tree p f (depth - 1) { region with upper = cut } in
    Kernel.Split (cut, first, absent_tree p f (depth - 1) { region with lower = cut })

let half x y = Q.div (Q.add x y) (Q.of_int 2)

(* Between x and y, k times as near to y. *)
let weighted k x y = Q.div (Q.add x (Q.mul (Q.of_int k) y)) (Q.of_int (k + 1))

(* A null vector in [a, b]: in one leaf, or between two intervals that [absent] closes.  [a, b] may
   reach beyond the region, or lie beside it.  Cuts are
   [weight] times as near to [a, b] as to the region's end. *)
let rec narrow_tree ~absent ~weight what depth attempt (a, b) (region : Kernel.region) =
  match attempt region with
  | Some leaf -> Kernel.Leaf leaf
  | None ->
    if depth = 0 then no_witness "%s" what;
    let lo = value_of region.lower in
    let beside = Q.lt b lo || finite region.upper && Q.gt a (value_of region.upper) in
    if beside then absent region
    else begin
      let low = if Q.gt a lo then Some (point_of (weighted weight lo a)) else None in
      let high =
        if not (finite region.upper) then Some (point_of (Q.add (Q.mul b (Q.of_int 2)) Q.one))
        else
          let hi = value_of region.upper in
          if Q.lt b hi then Some (point_of (weighted weight hi b)) else None in
      if low = None && high = None then no_witness "%s" what;
      let lower = Option.value low ~default:region.lower in
      let upper = Option.value high ~default:region.upper in
      let inner =
        narrow_tree ~absent ~weight what (depth - 1) attempt (a, b) { region with lower; upper } in
      let inner = match high with
        | None -> inner
        | Some cut -> Kernel.Split (cut, inner, absent { region with lower = cut }) in
      match low with
      | None -> inner
      | Some cut -> Kernel.Split (cut, absent { region with upper = cut }, inner)
    end

let root_tree p f region r outcome =
  let attempt region = isolated_leaf p f region r outcome in
  narrow_tree ~absent:(absent_tree p f 12) ~weight:1 "root" 8 attempt r.interval region

let value_of_known (q : Kernel.known) = (value_of q.known_from, value_of q.known_to)

let claim_tree p f region r number (q : Kernel.known) =
  let attempt region = claimed_leaf p f region r number q in
  narrow_tree ~absent:(absent_tree p f 12) ~weight:1 "a claimed root" 12 attempt
    (value_of_known q) region

(* A null vector at infinity: in one leaf, or behind an interval that [absent] closes. *)
let rec infinite_tree ~absent depth attempt (region : Kernel.region) =
  match attempt region with
  | Some leaf -> Kernel.Leaf leaf
  | None ->
    if depth = 0 then no_witness "a root at infinity";
    let cut = point_of (Q.add (Q.mul (value_of region.lower) (Q.of_int 4)) Q.one) in
    let beyond = infinite_tree ~absent (depth - 1) attempt { region with lower = cut } in
    Kernel.Split (cut, absent { region with upper = cut }, beyond)

(* ---------- trees *)

type context = {
  pencil : Kernel.pencil;
  weights : Z.t list;  (* of the rows, for whole leaves *)
  slip : int array;
  enclosed : Kernel.enclosed;
  doubles : doubles;
  known : Kernel.known array }  (* the claims *)

let position slip i =
  let rec search k =
    if k = Array.length slip then no_witness "the index %d names nothing" i
    else if slip.(k) = i then k else search (k + 1) in
  search 0

(* The components of x at the complementarity variables. *)
let at_slip slip x =
  let components = Array.of_list x in
  Array.map (fun i -> components.(i)) slip

let build_leaf c (region : Kernel.region) node =
  let p = c.enclosed and f = c.doubles in
  let leaf what = function Some l -> Kernel.Leaf l | None -> no_witness "%s" what in
  let whole () =
    Option.map (fun w -> Kernel.Whole w) (whole_leaf c.pencil c.weights region) in
  match node with
  | Farkas w -> Kernel.Leaf (Kernel.Farkas (one_for_each p.size_of w))
  | Definite diagonal ->
    (match definite_leaf p diagonal region, diagonal with
     | Some l, _ -> Kernel.Leaf l
     | None, Weighted _ -> no_witness "definite"
     | None, (Identity | Opposite) -> leaf "definite" (whole ()))
  | Ldl -> leaf "ldl" (whole ())
  | Tail -> leaf "tail" (whole ())
  | Root r ->
    let r = { r with pivot = position c.slip r.pivot } in
    (match r.outcome with
     | Absent -> absent_tree p f 12 region
     | Solution -> root_tree p f region r Kernel.Solution
     | Negative_x i -> root_tree p f region r (Kernel.NegativeX (position c.slip i))
     | Negative_y i -> root_tree p f region r (Kernel.NegativeY (position c.slip i))
     | Claim number ->
       if number < 0 || number >= Array.length c.known then no_witness "a claim that is not there";
       claim_tree p f region r number c.known.(number)
     | Infinity x ->
       if List.length x <> c.pencil.Kernel.order || finite region.upper then
         no_witness "a root at infinity";
       let at = at_slip c.slip x in
       infinite_tree ~absent:(absent_tree p f 12) 12
         (fun region -> infinite_leaf p f region x at) region)
  | Open -> Kernel.Leaf Kernel.Undecided
  | Split _ | Branch _ | Support _ -> assert false

(* The nodes of a piece in preorder; [leaf] makes a tree of a leaf.  [other_half] gives the variable
   that rests where another one moves, and makes the tree of the region where both move. *)
let build_piece ?(other_half = fun _ _ -> None) slip leaf nodes (region : Kernel.region) =
  let rec build depth (region : Kernel.region) nodes =
    if depth > 2_000 then no_witness "a tree of more than 2,000 levels";
    match nodes with
    | [] -> no_witness "a tree ends too early"
    | Split t :: rest ->
      let t = point_of t in
      let first, rest = build (depth + 1) { region with upper = t } rest in
      let second, rest = build (depth + 1) { region with lower = t } rest in
      Kernel.Split (t, first, second), rest
    | Branch i :: rest ->
      let i = position slip i in
      let first, rest = build (depth + 1) (Kernel.decide i Kernel.Resting region) rest in
      let moving = Kernel.decide i Kernel.Moving region in
      (match other_half i region with
       | None ->
         let second, rest = build (depth + 1) moving rest in
         Kernel.Branch (i, first, second), rest
       | Some (other, both) ->
         let second, rest = build (depth + 1) (Kernel.decide other Kernel.Resting moving) rest in
         let both = both () in
         Kernel.Branch (i, first, Kernel.Branch (other, second, both)), rest)
    | node :: rest -> leaf region node, rest in
  match build 0 region nodes with
  | tree, [] -> tree
  | _ -> no_witness "a tree has a node too many"

(* The pieces of a window as one tree. *)
let build_pieces ?other_half slip leaf (lo, _) pieces =
  if List.length pieces > 10_000 then no_witness "more than 10,000 pieces";
  let rec build lower = function
    | [] -> no_witness "a complete set without pieces"
    | piece :: rest ->
      let upper = upper_point piece.max in
      let tree =
        build_piece ?other_half slip (leaf piece) piece.tree { Kernel.lower; upper; states = [] } in
      if rest = [] then tree else Kernel.Split (upper, tree, build upper rest) in
  build (point_of lo) pieces

(* ---------- condensation *)

(* W_k and V_k have a row for each free variable and a column for each other one. *)
let require_shape free others (a : anchor) =
  let fits (_, rows) =
    List.compare_length_with rows free = 0
    && List.for_all (fun row -> List.compare_length_with row others = 0) rows in
  if not (List.for_all fits (a.right @ a.left)) then
    no_witness "an anchor with matrices of another shape"

let transpose columns rows =
  let rows = Array.of_list (List.map Array.of_list rows) in
  List.init columns (fun j -> Array.to_list (Array.map (fun row -> row.(j)) rows))

(* The rows of a factor, each with the column where it begins. *)
let rows_from (factor : factor_rows) =
  if List.length factor.first <> List.length factor.rows then
    no_witness "a factor with rows missing";
  List.combine factor.first factor.rows

(* f_i / 2^b_i for each slip row, as positive integers in a common unit. *)
let row_scales (pencil : Kernel.pencil) slip common =
  let rows_a = Array.of_list pencil.rows_a and rows_b = Array.of_list pencil.rows_b in
  (* A row of a system has two parts, so a column may stand in it twice. *)
  let summed row =
    let sums = Hashtbl.create 64 in
    List.iter (fun (j, v) ->
        let sum = Option.value (Hashtbl.find_opt sums j) ~default:Z.zero in
        Hashtbl.replace sums j (Z.add sum v)) row;
    Hashtbl.fold (fun j v rest -> (j, v) :: rest) sums [] in
  let scales = List.map (fun i ->
      let a = summed rows_a.(i) and b = summed rows_b.(i) in
      let entries = List.map snd a @ List.map snd b in
      let g = List.fold_left Z.gcd common entries in
      let f = Z.divexact common g in
      let longest = List.fold_left (fun m (_, v) ->
          max m (bits (Z.divexact (Z.mul f v) common))) 1 a in
      (f, longest)) slip in
  let top = List.fold_left (fun m (_, b) -> max m b) 1 scales in
  List.map (fun (f, b) -> Z.shift_left f (top - b)) scales

(* A matrix in units of 2^-k, with the least k: units of 2^-900 for zeros leave no double finite. *)
let shortened (k, rows) =
  let zeros = List.fold_left (List.fold_left (fun m z ->
      if Z.sign z = 0 then m else min m (Z.trailing_zeros z))) k rows in
  (k - zeros, List.map (List.map (fun z -> Z.shift_right z zeros)) rows)

let elimination (pencil : Kernel.pencil) slip common slip_common
    (condensation : condensation option) anchor =
  let ns = List.length slip and nf = List.length pencil.free in
  let row_scale = row_scales pencil slip slip_common in
  if nf = 0 then
    let none = List.init ns (fun _ -> []) in
    { Kernel.row_scale; unit_of = two_to 56; right_w = none; left_va = none; left_vb = none;
      bound_c = Z.one; bound_d = Z.one; factor_scale = Z.zero; stiffness_factor = [] }
  else match condensation with
    | None -> no_witness "a condensation is missing"
    | Some c ->
      let a = match List.nth_opt c.anchors anchor with
        | Some a when bits (Q.num a.center) + bits (Q.den a.center) > 2_048 ->
          Problem.not_verified "a center of more than 2,048 bits"
        | Some a when not a.reversed -> a
        | _ -> no_witness "an anchor of a linear family" in
      require_shape nf ns a;
      let right = List.map shortened a.right and left = List.map shortened a.left in
      let e = List.fold_left (fun m (k, _) -> max m k) 56 (right @ left) in
      let columns (k, rows) =
        transpose ns (List.map (List.map (fun z -> Z.shift_left z (e - k))) rows) in
      let zero = List.init ns (fun _ -> List.init nf (fun _ -> Z.zero)) in
      let nth l k = match List.nth_opt l k with Some m -> columns m | None -> zero in
      (* V(t) = left_0 + (t - center) left_1 as V_a + t V_b; V need not be exact. *)
      let ratio = Z.divexact slip_common common in
      let left_vb = List.map (List.map (Z.mul ratio)) (nth left 1) in
      let shifted v0 v1 =
        Z.sub (Z.mul ratio v0) (Z.fdiv (Z.mul (Q.num a.center) v1) (Q.den a.center)) in
      let left_va = List.map2 (List.map2 shifted) (nth left 0) left_vb in
      let power = two_to (2 * c.factor.exponent) in
      { Kernel.row_scale; unit_of = two_to e; right_w = nth right 0;
        left_va; left_vb;
        bound_c = Z.mul power (Q.den c.sigma);
        bound_d = Z.mul common (Z.mul power (Q.num c.sigma));
        factor_scale = Z.mul common (Q.den c.sigma);
        stiffness_factor = rows_from c.factor }

(* The sum of (t - center)^k M_k, in units of 2^-60. *)
let matrix_at t center matrices =
  let step = Q.sub t center in
  let exact (k, rows) =
    List.map (List.map (fun z -> Q.make z (two_to k))) rows in
  let rounded v = Z.fdiv (Z.shift_left (Q.num v) 60) (Q.den v) in
  match List.rev_map exact matrices with
  | [] -> []
  | last :: others ->
    let add = List.map2 (List.map2 (fun sum v -> Q.add (Q.mul step sum) v)) in
    [60, List.map (List.map rounded) (List.fold_left add last others)]

(* The elimination for the pencil at the value t (Points.v); the factors of its rows are [common]
   and [slip_common].  The rows are scaled as those of the given pencil.  At 0 the factor of the
   certificate serves. *)
let elimination_at t given (pencil : Kernel.pencil) slip common slip_common condensation number =
  let at_value (a : anchor) =
    let there = matrix_at t a.center in
    { a with center = t; right = there a.right; left = there a.left } in
  let moved (c : condensation) = match List.nth_opt c.anchors number with
    | Some a when not a.reversed -> require_shape (List.length pencil.free) (List.length slip) a;
      { c with anchors = [at_value a] }
    | _ -> no_witness "an anchor of a linear family" in
  let e = elimination pencil slip common slip_common (Option.map moved condensation) 0 in
  let e = { e with row_scale = row_scales given slip (Z.divexact slip_common (Q.den t)) } in
  if Q.sign t = 0 || pencil.free = [] then e
  else begin
    let frees = Array.of_list pencil.free in
    let rows = Array.of_list pencil.rows_a in
    let c = two_to 112 in
    let entry i j =
      Z.mul (two_to 111) (Z.add (Kernel.lookup rows.(i) j) (Kernel.lookup rows.(j) i)) in
    let form = Array.map (fun i -> Array.map (entry i) frees) frees in
    let diagonal = Array.to_list (Array.mapi (fun i row -> row.(i)) form) in
    let least = List.fold_left Z.min (List.hd diagonal) diagonal in
    (* The largest of these bounds below which the form is. *)
    let rec bounded k =
      if k > 60 then no_witness "a factor of the free rows";
      spend (Array.length frees);
      let d = Z.shift_right least k in
      let lowered = Array.mapi (fun i row ->
          Array.mapi (fun j v -> if i = j then Z.sub v d else v) row) form in
      match factor_rows true lowered with
      | Some factor when Z.sign d > 0 -> d, factor
      | _ -> bounded (k + 1) in
    let bound_d, factor = bounded 1 in
    { e with bound_c = c; bound_d; factor_scale = Z.one;
             stiffness_factor = Array.to_list (Array.map late_row factor) }
  end

(* ---------- condensation about anchors *)

type varying = {
  whole_pencil : Kernel.pencil;
  slip_list : int array;
  anchoring : Kernel.anchoring;
  expansions : Kernel.anchor_family option list;
  claims : Kernel.known array;
  weights : Z.t list;  (* of the rows, for leaves of the whole pencil *)
  uniform_factor : Z.t;
  tail : (Q.t * factor_rows) option;
  numbers : (int * int) list  (* anchors of the certificate, as numbers of the anchoring *) }

(* Factors of the free rows and of the others: the given pencil times them is that of the kernel. *)
let form_bound nf free_factor (sigma : Q.t) (factor : factor_rows option) =
  match factor with
  | Some f ->
    let power = two_to (2 * f.exponent) in
    { Kernel.bound_times = Z.mul power (Q.den sigma);
      bound_at = Z.mul free_factor (Z.mul power (Q.num sigma));
      gram_times = Z.mul free_factor (Q.den sigma);
      gram_rows = rows_from f }
  | None ->
    { Kernel.bound_times = Q.den sigma; bound_at = Z.mul free_factor (Q.num sigma);
      gram_times = Z.zero; gram_rows = List.init nf (fun _ -> (0, [])) }

let kernel_anchor (pencil : Kernel.pencil) slip_list free_factor slip_factor (a : anchor) =
  let e = List.fold_left (fun m (k, _) -> max m k) 0 (a.right @ a.left) in
  let shifted factor (k, rows) =
    List.map (List.map (fun z -> Z.mul factor (Z.shift_left z (e - k)))) rows in
  let ratio = Z.divexact slip_factor free_factor in
  let scaled = if a.reversed then Kernel.swap_pencil pencil else pencil in
  a.reversed, { Kernel.anchor_center = point_of a.center; anchor_unit = two_to e;
                anchor_right = List.map (shifted Z.one) a.right;
                anchor_left = List.map (shifted ratio) a.left;
                anchor_scale = row_scales scaled slip_list slip_factor }

let needs_anchor (piece : piece) =
  List.exists (function
      | Farkas _ | Definite _ | Root _ -> true
      | Ldl | Tail | Open | Support _ | Split _ | Branch _ -> false) piece.tree

let trivial_bound = { Kernel.bound_times = Z.one; bound_at = Z.zero; gram_times = Z.zero;
                      gram_rows = [] }

(* For trees whose leaves speak of the whole pencil. *)
let without_anchors pencil slip_list free_factor slip_factor tail =
  { whole_pencil = pencil; slip_list = Array.of_list slip_list; expansions = []; claims = [||];
    anchoring = { Kernel.stiffness_bound = trivial_bound; mass_bound = trivial_bound;
                  anchors = [] };
    weights = row_weights pencil free_factor slip_factor; uniform_factor = slip_factor; tail;
    numbers = [] }

(* What expansions about anchors may cost.  The ten anchors of the block, with six matrices of 786 x
   17 entries each, count 111 million.  The kernel's square roots take the square of the length. *)
let limit_anchors nf ns anchors =
  if nf > 2_000 then Problem.not_verified "more than 2,000 free variables that depend on the value";
  let work, roots = List.fold_left (fun (work, roots) (a : anchor) ->
      let matrices = 1 + List.length a.right + List.length a.left in
      let exponent = List.fold_left (fun m (e, _) -> max m e) 0 (a.right @ a.left) in
      require_shape nf ns a;
      let center = bits (Q.num a.center) + bits (Q.den a.center) in
      require_shape nf ns a;
      if center > 2_048 then Problem.not_verified "a center of more than 2,048 bits";
      let length = 64 + exponent + center in
      work + matrices * matrices * nf * ns * ns * (1 + exponent / 256),
      roots + matrices * ns * length * length) (0, 0) anchors in
  if work > 400_000_000 || roots > 1 lsl 33 then
    Problem.not_verified "anchors beyond the limits of this program"

let with_anchors (pencil : Kernel.pencil) slip_list free_factor slip_factor claims
    (condensation : condensation option) pieces =
  let c = match condensation with Some c -> c | None -> no_witness "a condensation is missing" in
  let nf = List.length pencil.free and ns = List.length slip_list in
  let used = List.sort_uniq compare
      (List.filter_map (fun (p : piece) -> if needs_anchor p then Some p.anchor else None)
         pieces) in
  let given k = match List.nth_opt c.anchors k with
    | Some a -> a
    | None -> no_witness "a piece names no anchor" in
  limit_anchors nf ns (List.map given used);
  let anchoring = {
    Kernel.stiffness_bound = form_bound nf free_factor c.sigma (Some c.factor);
    mass_bound = form_bound nf free_factor c.mass_sigma c.mass_factor;
    anchors = List.map (fun k ->
        kernel_anchor pencil slip_list free_factor slip_factor (given k)) used } in
  { whole_pencil = pencil; slip_list = Array.of_list slip_list; anchoring;
    expansions = Kernel.expansions pencil anchoring; claims;
    weights = row_weights pencil free_factor slip_factor; uniform_factor = slip_factor;
    tail = c.tail;
    numbers = List.mapi (fun i k -> (k, i)) used }

let varying_of pencil slip_list free_factor slip_factor claims condensation pieces =
  if List.exists needs_anchor pieces then
    with_anchors pencil slip_list free_factor slip_factor claims condensation pieces
  else
    without_anchors pencil slip_list free_factor slip_factor
      (Option.bind condensation (fun (c : condensation) -> c.tail))

let local_unit = { Kernel.lower = (Z.zero, Z.one); upper = (Z.one, Z.one); states = [] }

(* The interval of a region for an anchor, and the bounds of its two blocks. *)
let interval_for v n (region : Kernel.region) =
  let reverse, a = List.nth v.anchoring.anchors n in
  let stiffness = v.anchoring.stiffness_bound and mass = v.anchoring.mass_bound in
  if reverse then
    (a, mass, stiffness, Kernel.swap region.upper, Kernel.swap region.lower)
  else (a, stiffness, mass, region.lower, region.upper)

(* What local pencils may cost together: entries, coefficients and words. *)
let spent = ref 0

let spend_local ns (a : Kernel.anchor) (region : Kernel.region) fam =
  let point_bits (p, q) = bits p + bits q in
  let words = 1 + (point_bits region.lower + point_bits region.upper
                   + point_bits a.anchor_center) / 64 in
  let length = List.length fam.Kernel.series_z in
  spent := !spent + ns * ns * length * length * words;
  if !spent > 1 lsl 30 then Problem.not_verified "regions beyond the limits of this program"

(* The pencil over [0, 1], with entries of some 160 bits, and its grain. *)
let new_local_pencil v n region slopes =
  match List.nth v.expansions n with
  | None -> None
  | Some fam ->
    let _, anchor = List.nth v.anchoring.anchors n in
    spend_local (Array.length v.slip_list) anchor region fam;
    let a, low_a, low_b, lo, hi = interval_for v n region in
    if not (Kernel.proper_interval a low_a low_b lo hi) then None
    else begin
      let ns = Array.length v.slip_list in
      let make grain = Kernel.local_pencil ns a low_a low_b fam lo hi slopes grain in
      let exact = make Z.one in
      let top = List.fold_left (List.fold_left (fun m z -> max m (bits z))) 0
          (exact.center_a @ exact.center_b) in
      let grain = two_to (max 0 (top - 160)) in
      let p = make grain in
      Some (p, doubles_of p, grain)
    end

(* The leaves of a branched interval share it; the last few are kept. *)
let kept = ref []

let local_pencil v n (region : Kernel.region) slopes =
  let key = (n, slopes, region.lower, region.upper) in
  match List.assoc_opt key !kept with
  | Some found -> found
  | None ->
    let found = new_local_pencil v n region slopes in
    kept := (key, found) :: List.filteri (fun i _ -> i < 7) !kept;
    found

(* The evidence of [make] for a region, with its local pencil. *)
let anchored v n (region : Kernel.region) slopes make =
  match local_pencil v n region slopes with
  | None -> None
  | Some (p, f, grain) ->
    let unit_region = { local_unit with states = region.states } in
    Option.map (fun leaf -> leaf grain) (make p f unit_region)

(* Nothing is left over from another file. *)
let start_anew () = work := 0; spent := 0; kept := []

let is_reversed v n = fst (List.nth v.anchoring.anchors n)

let checked p unit_region e =
  match e with
  | Some e when Kernel.check_local p unit_region e -> Some e
  | _ -> None

let local_of = function
  | Kernel.Farkas w -> Some (Kernel.LocalFarkas w)
  | Kernel.Definite (d, low, high) -> Some (Kernel.LocalDefinite (d, low, high))
  | Kernel.Absent c -> Some (Kernel.LocalAbsent c)
  | Kernel.Root (_, c, o) -> Some (Kernel.LocalRoot (c, o))
  | _ -> None

let by_local v n (region : Kernel.region) make =
  anchored v n region false (fun p f r ->
      Option.map (fun e grain ->
          Kernel.OfAnchor (n, grain, (region.lower, region.upper), e))
        (checked p r (make p f r)))

let by_farkas v n w region =
  let w = one_for_each (Array.length v.slip_list) w in
  by_local v n region (fun _ _ _ -> Some (Kernel.LocalFarkas w))

let by_definite v n diagonal region =
  by_local v n region (fun p _ r -> Option.bind (definite_leaf p diagonal r) local_of)

let by_absent v n region =
  by_local v n region (fun p f r -> Option.bind (absent_leaf p f r) local_of)

(* [a, b] as values of u. *)
let local_ends v n region (a, b) =
  let _, _, _, lo, hi = interval_for v n region in
  let ends =
    if is_reversed v n then Kernel.swap b, Kernel.swap a else a, b in
  Kernel.local_point lo hi (fst ends), Kernel.local_point lo hi (snd ends)

let by_root v n (r : root) outcome (region : Kernel.region) =
  let a, b = r.interval in
  let wide = hull region r.interval in
  let region = Kernel.extended region wide in
  let _, _, _, lo, hi = interval_for v n region in
  let ends = local_ends v n region (point_of a, point_of b) in
  if Z.sign (snd (fst ends)) <= 0 || Z.sign (snd (snd ends)) <= 0 then None
  else
    let interval = (value_of (fst ends), value_of (snd ends)) in
    let placed = function
      | Kernel.LocalRoot (c, o) ->
        Kernel.LocalRoot ({ c with from_point = point_of a; to_point = point_of b }, o)
      | e -> e in
    anchored v n region (outcome = Kernel.Solution) (fun p f unit_region ->
        let found = isolated_leaf ~ends p f unit_region { r with interval } outcome in
        Option.map (fun e grain -> Kernel.OfAnchor (n, grain, wide, placed e))
          (checked p unit_region (Option.bind found local_of)))

(* The region of a claim. *)
let by_claim v n (r : root) number (q : Kernel.known) (region : Kernel.region) =
  let wide = hull region (value_of_known q) in
  let region = Kernel.extended region wide in
  let ends = local_ends v n region (q.known_from, q.known_to) in
  if Z.sign (snd (fst ends)) <= 0 || Z.sign (snd (snd ends)) <= 0 then None
  else
    let local = { q with known_from = fst ends; known_to = snd ends } in
    anchored v n region true (fun p f unit_region ->
        match claimed_leaf p f unit_region r number local with
        | Some (Kernel.Claimed (_, c, _)) ->
          Some (fun grain -> Kernel.OfClaim (n, grain, wide, c, number))
        | _ -> None)

(* The region of a null vector at infinity, for a reversed anchor. *)
let by_limit v n x at (region : Kernel.region) =
  if not (is_reversed v n) || finite region.upper then None
  else
    anchored v n region true (fun p f unit_region ->
        let pin j_list k v =
          pinning_of p f j_list k v (unit_region.lower, unit_region.upper) 0.5 in
        Option.map (fun c grain ->
            Kernel.OfLimit (n, grain, (region.lower, region.upper), c, x))
          (limit_pinning p unit_region at pin (Kernel.pinned p unit_region)))

let cut_of (region : Kernel.region) =
  let lo = value_of region.lower in
  if finite region.upper then half lo (value_of region.upper)
  else if Q.sign lo = 0 then Q.one
  else Q.mul lo (Q.of_int 2)

(* One of the ways closes the region, or its halves are closed. *)
let rec close what depth ways (region : Kernel.region) =
  match List.find_map (fun way -> way region) ways with
  | Some leaf -> Kernel.Leaf leaf
  | None ->
    if depth = 0 then no_witness "%s" what;
    let cut = point_of (cut_of region) in
    let first = close what (depth - 1) ways { region with upper = cut } in
    Kernel.Split (cut, first, close what (depth - 1) ways { region with lower = cut })

let absent_ways v n = [ by_absent v n; by_definite v n Identity; by_definite v n Opposite ]

(* The radii of a local pencil fall with the square of the width: cuts are much nearer. *)
let varying_narrow v n what attempt interval region =
  narrow_tree ~absent:(close "absent" 12 (absent_ways v n)) ~weight:15 what 12 attempt interval
    region

(* The factor of the certificate for sym(A + from B); nothing for sym(B), which is diagonal. *)
let tail_leaf v (region : Kernel.region) =
  match v.tail with
  | Some (from, f) when Q.equal from (value_of region.lower) && not (finite region.upper) ->
    let power = two_to (2 * f.exponent) and two = Z.of_int 2 in
    let low = Z.mul two (Z.mul v.uniform_factor (snd region.lower)) in
    let rows = rows_from f in
    let w = { Kernel.whole_weights = v.weights;
              low_end = { Kernel.end_scale = power; end_factor = Kernel.Late (low, rows) };
              high_end = { Kernel.end_scale = Z.one;
                           end_factor = Kernel.Late (Z.zero, List.map (fun _ -> (0, [])) rows) } }
    in
    if Kernel.check_whole v.whole_pencil region w then Some w else None
  | _ -> None

let whole_of v what region =
  let given = if what = "tail" then tail_leaf v region else None in
  let found = match given with
    | Some w -> Some w
    | None -> whole_leaf v.whole_pencil v.weights region in
  match found with
  | Some w -> Kernel.Leaf (Kernel.OfWhole w)
  | None -> no_witness "%s" what

let varying_leaf v (piece : piece) (region : Kernel.region) node =
  let n = Option.value (List.assoc_opt piece.anchor v.numbers) ~default:0 in
  match node with
  | Farkas w -> close "farkas" 6 [by_farkas v n w] region
  | Definite diagonal -> close "definite" 6 [by_definite v n diagonal] region
  | Ldl -> whole_of v "ldl" region
  | Tail -> whole_of v "tail" region
  | Root r ->
    let r = { r with pivot = position v.slip_list r.pivot } in
    let narrow outcome =
      varying_narrow v n "root" (by_root v n r outcome) r.interval region in
    (match r.outcome with
     | Absent -> close "absent" 12 (absent_ways v n) region
     | Solution -> narrow Kernel.Solution
     | Negative_x i -> narrow (Kernel.NegativeX (position v.slip_list i))
     | Negative_y i -> narrow (Kernel.NegativeY (position v.slip_list i))
     | Claim number ->
       if number < 0 || number >= Array.length v.claims then
         no_witness "a claim that is not there";
       let q = v.claims.(number) in
       varying_narrow v n "a claimed root" (by_claim v n r number q) (value_of_known q) region
     | Infinity x ->
       if List.length x <> v.whole_pencil.Kernel.order || finite region.upper then
         no_witness "a root at infinity";
       infinite_tree ~absent:(close "absent" 12 (absent_ways v n)) 12
         (by_limit v n x (at_slip v.slip_list x)) region)
  | Open -> Kernel.Leaf Kernel.LeftOpen
  | Split _ | Branch _ | Support _ -> assert false

(* ---------- exact solution claims *)

(* (c, q, r) with c g = p q + r and r shorter than p, constant terms first; c a power of the
   leading coefficient of p in size. *)
let divide g p =
  let p = Array.of_list (strip_integers p) and r = Array.of_list (strip_integers g) in
  let m = Array.length p and n = Array.length r in
  if m = 0 then no_witness "a polynomial that is zero";
  let lead = p.(m - 1) in
  let size = Z.abs lead in
  let q = Array.make (max 0 (n - m + 1)) Z.zero in
  let c = ref Z.one in
  for k = n - m downto 0 do
    let top = r.(k + m - 1) in
    if Z.sign top <> 0 then begin
      let factor = if Z.sign lead > 0 then top else Z.neg top in
      if not (Z.equal size Z.one) then begin
        for i = 0 to k + m - 1 do r.(i) <- Z.mul size r.(i) done;
        Array.iteri (fun i v -> q.(i) <- Z.mul size v) q;
        c := Z.mul size !c
      end;
      q.(k) <- Z.add q.(k) factor;
      for i = 0 to m - 1 do r.(k + i) <- Z.sub r.(k + i) (Z.mul factor p.(i)) done
    end
  done;
  !c, Array.to_list q, strip_integers (Array.to_list r)

(* The witness of g modulo p, without a common factor. *)
let reduction modulus g =
  let c, quotient, rest = divide g modulus in
  let common = List.fold_left (fun d v -> if Z.equal d Z.one then d else Z.gcd d v) c
      (rest @ quotient) in
  let over = List.map (fun v -> Z.divexact v common) in
  { Kernel.multiplier = Z.divexact c common; quotient = over quotient; rest = over rest }

(* Polynomials with integer coefficients, multiplied by one positive integer. *)
let common_of = List.fold_left (List.fold_left (fun c v -> Z.lcm c (Q.den v)))
let integer_polynomials common =
  List.map (List.map (fun v -> Q.num (Q.mul v (Q.of_bigint common))))

let bare_claim (e : exact) components =
  let a, b = e.value in
  let d = Z.lcm (Q.den a) (Q.den b) in
  let over q = Q.num (Q.mul q (Q.of_bigint d)) in
  { Kernel.modulus = e.polynomial; claim_from = over a; claim_to = over b;
    claim_denominator = d; support = e.support; biactive = e.biactive; components;
    component_reductions = []; reaction_reductions = [] }

let claim_of (pencil : Kernel.pencil) (e : exact) =
  let components = integer_polynomials (common_of Z.one e.x) e.x in
  let bare = bare_claim e components in
  { bare with
    component_reductions = List.map (reduction e.polynomial) components;
    reaction_reductions = List.init pencil.order (fun i ->
        reduction e.polynomial (Kernel.reaction_poly pencil bare i)) }

(* [factor] is that of K and M in the system. *)
let lifted_of (system : Kernel.system) unknown factor (l : lifted) =
  let common = common_of (common_of Z.one l.motion.x) l.forces in
  let v = integer_polynomials common l.motion.x in
  let w = integer_polynomials (Z.mul factor common) l.forces in
  let reduce = reduction l.motion.polynomial in
  let bare = { Kernel.motion_claim = bare_claim l.motion v; forces = w; force_reductions = [];
               balance_reductions = []; normal_reductions = []; rate_reductions = [];
               cone_reductions = [] } in
  let particles make = List.map (fun p -> reduce (make p)) system.particles in
  { bare with
    motion_claim = { bare.motion_claim with component_reductions = List.map reduce v };
    force_reductions = List.map reduce w;
    balance_reductions = List.init system.dofs (fun d ->
        reduce (Kernel.balance_poly system unknown bare d));
    normal_reductions = particles (Kernel.normal_poly bare);
    rate_reductions = particles (Kernel.rate_poly bare);
    cone_reductions = particles (Kernel.cone_poly system unknown bare) }

let rec add_polynomials p q = match p, q with
  | a :: p, b :: q -> Q.add a b :: add_polynomials p q
  | rest, [] | [], rest -> rest

(* The solution of the pencil whose motion is that of the claim: x_d = v_d, x_p = -S t'v. *)
let exact_of_lifted (system : Kernel.system) (l : lifted) =
  let v = Array.of_list l.motion.x in
  let times c = List.map (Q.mul c) in
  let slip (p : Kernel.slip_particle) =
    let factor c = Q.make (Z.neg (Z.mul p.sign_of c)) system.unit_length in
    let first, second = p.tangent in
    add_polynomials (times (factor first) v.(p.first_dof))
      (times (factor second) v.(p.second_dof)) in
  { l.motion with
    x = List.map (fun d -> v.(d)) system.free_dofs @ List.map slip system.particles }

(* ---------- claims with particles in contact with zero reaction *)

let zero_of (system : Kernel.zero_system) unknown factor (l : lifted) =
  let lifted_part = lifted_of system.without_zero unknown factor l in
  let bare = { Kernel.lifted_part; opening_reductions = []; pressure_reductions = [];
               sliding_reductions = []; right_reductions = []; left_reductions = [] } in
  let particles make =
    List.map (fun p -> reduction l.motion.polynomial (make p)) system.zero_particles in
  { bare with
    opening_reductions = particles (Kernel.normal_poly lifted_part);
    pressure_reductions = particles (Kernel.pressure_poly bare);
    sliding_reductions = particles (Kernel.sliding_poly bare);
    right_reductions = particles (Kernel.right_poly system unknown bare);
    left_reductions = particles (Kernel.left_poly system unknown bare) }

(* The motion of x: v = -S t x of a slip particle, v = -n x_gap + t (x_right - x_left) of one with
   zero reaction, n the unit normal. *)
let motion_of_variables (zero : Kernel.zero_system) x =
  let system = zero.without_zero in
  let v = Array.make system.dofs [] in
  let put d c p = v.(d) <- add_polynomials v.(d) (List.map (Q.mul c) p) in
  let put_along (p : Kernel.slip_particle) (first, second) sign polynomial =
    put p.first_dof (Q.make (Z.mul sign first) system.unit_length) polynomial;
    put p.second_dof (Q.make (Z.mul sign second) system.unit_length) polynomial in

  List.iteri (fun i d -> put d Q.one x.(i)) system.free_dofs;
  let slips = List.length system.free_dofs in
  List.iteri (fun j (p : Kernel.slip_particle) ->
      put_along p p.tangent (Z.neg p.sign_of) x.(slips + j)) system.particles;
  let gaps = slips + List.length system.particles in
  List.iteri (fun j (p : Kernel.slip_particle) ->
      let gap = gaps + 3 * j in
      let t1, t2 = p.tangent and n1, n2 = p.normal in
      let turned = Z.neg t2, t1 in
      let side = Z.sign (Z.add (Z.mul n1 (fst turned)) (Z.mul n2 (snd turned))) in
      put_along p turned (Z.of_int (-side)) x.(gap);
      put_along p p.tangent Z.one x.(gap + 1);
      put_along p p.tangent Z.minus_one x.(gap + 2)) zero.zero_particles;
  v

(* The motion of x and its forces. *)
let lifted_of_exact (zero : Kernel.zero_system) unknown factor (e : exact) =
  let system = zero.without_zero in
  let v = motion_of_variables zero (Array.of_list e.x) in

  (* Forces in integers: v times one denominator, K and M times [factor]. *)
  let motion = Array.to_list v in
  let common = common_of Z.one motion in
  let integral = Array.of_list (integer_polynomials common motion) in
  let product row =
    List.fold_left (fun sum (j, c) ->
        Kernel.add_poly sum (Kernel.scale_poly c integral.(j))) [] row in
  let over = List.map (fun c -> Q.make c (Z.mul factor common)) in
  let forces = match unknown with
    | Kernel.Mu -> List.map product system.stiffness
    | Lambda2 _ ->
      List.map2 (fun k m -> Kernel.add_poly (product k) (Z.zero :: product m))
        system.stiffness system.mass in
  { motion = { e with x = motion }; forces = List.map over forces }

(* ---------- enclosed solution claims *)

(* The active rows and columns of a pencil in doubles, row p divided by 2^exponents.(p). *)
type active_block = { variables : int array; block : doubles; exponents : int array }

let active_block (pencil : Kernel.pencil) variables t =
  let m = Array.length variables in
  let position = Array.make pencil.order (-1) in
  Array.iteri (fun p i -> position.(i) <- p) variables;
  let dense rows =
    let rows = Array.of_list rows in
    Array.map (fun i ->
        let row = Array.make m 0.0 in
        List.iter (fun (j, v) ->
            let p = position.(j) in
            if p >= 0 then row.(p) <- row.(p) +. Z.to_float v) rows.(i);
        row) variables in
  let a = dense pencil.rows_a and b = dense pencil.rows_b in
  let exponents = Array.init m (fun p ->
      let norm = ref 0.0 in
      Array.iteri (fun q v -> norm := !norm +. Float.abs (v +. t *. b.(p).(q))) a.(p);
      if Float.is_nan !norm || !norm = infinity then no_witness "an overflow";
      snd (Float.frexp (max !norm 1e-300))) in
  let divided = Array.mapi (fun p row ->
      Array.map (fun v -> Float.ldexp v (- exponents.(p))) row) in
  { variables; block = { a = divided a; b = divided b }; exponents }

(* The inverse of T(t) without row and column k, and the null vectors with the component 1 there. *)
type null_pair = { others : int array; reciprocal : float array array;
                   right : float array; left : float array }

let null_pair f k t =
  let m = Array.length f.a in
  spend m;
  let others = Array.of_list (List.filter (fun j -> j <> k) (List.init m Fun.id)) in
  Option.map (fun y ->
      let right = Array.make m 1.0 and left = Array.make m 1.0 in
      Array.iteri (fun p i ->
          let r = ref 0.0 and l = ref 0.0 in
          Array.iteri (fun q j ->
              r := !r -. y.(p).(q) *. at f t j k;
              l := !l -. at f t k j *. y.(q).(p)) others;
          right.(i) <- !r;
          left.(i) <- !l) others;
      { others; reciprocal = y; right; left })
    (inverse (Array.map (fun i -> Array.map (fun j -> at f t i j) others) others))

(* Steps of Newton's method for u' T(t) x with both null vectors at t. *)
let rec newton f k count t =
  if count = 0 then t
  else match null_pair f k t with
    | None -> t
    | Some n ->
      let sum entry =
        let total = ref 0.0 in
        Array.iteri (fun i u -> Array.iteri (fun j x ->
            total := !total +. u *. entry i j *. x) n.right) n.left;
        !total in
      let next = t -. sum (at f t) /. sum (fun i j -> f.b.(i).(j)) in
      if Float.is_nan next || next = t then t else newton f k (count - 1) next

let max_rational = List.fold_left (fun m v -> if Q.gt v m then v else m)

(* The least and the largest exponent of the numbers that are not zero. *)
let exponent_range =
  Array.fold_left (fun (least, most) v ->
      let e = snd (Float.frexp v) in
      if v = 0.0 then (least, most) else (min least e, max most e)) (0, 0)

let enclosed_claim_of (pencil : Kernel.pencil) (e : enclosed) =
  let n = pencil.order in
  let active = List.filter (fun i -> List.mem i pencil.free || List.mem i e.box_support)
      (List.init n Fun.id) in
  let variables = Array.of_list active in
  let m = Array.length variables in
  let z = Array.of_list e.center in
  let center = z.(m) and radius = List.nth e.radius m in
  let lowest = Q.sub center radius and highest = Q.add center radius in
  let in_doubles = active_block pencil variables (Q.to_float center) in
  let f = in_doubles.block in

  let over_variables values =
    let v = Array.make n Z.zero in
    Array.iteri (fun p i -> v.(i) <- values p) variables;
    Array.to_list v in
  (* The centre as integers, fine beside the least radius. *)
  let top = max_rational Q.zero (List.map Q.abs (Array.to_list (Array.sub z 0 m))) in
  let least = List.fold_left Q.min (List.hd e.radius) e.radius in
  let given bits =
    let bits = max bits (Z.numbits (Q.to_bigint (Q.div top least)) + 24) in
    if Q.sign top = 0 || bits > 4_000 then None
    else
      let factor = Q.div (Q.of_bigint (two_to bits)) top in
      Some (over_variables (fun p -> Q.to_bigint (Q.mul z.(p) factor))) in

  (* Everything for the pivot in place k and the inverse at t. *)
  let witnesses k t (pair : null_pair) =
    let rows = Array.map exponent_range pair.reciprocal in
    let smallest = Array.fold_left (fun s (_, most) -> min s most) 0 rows in
    let largest = Array.fold_left (fun s (_, most) -> max s most) 0 rows in
    let unit = min 200 (max (bits (Z.of_int m) + 7) (8 - smallest)) in
    let inverse = Array.make n [] in
    Array.iteri (fun p i ->
        inverse.(variables.(i)) <-
          Array.to_list (Array.map (fun v -> round_scaled v unit) pair.reciprocal.(p)))
      pair.others;

    (* u is given for the scaled rows. *)
    let left = Array.mapi (fun p v ->
        Float.ldexp v (in_doubles.exponents.(k) - in_doubles.exponents.(p))) pair.left in
    let left_unit = min 1_000 (60 - fst (exponent_range left)) in
    let left_null = over_variables (fun p -> round_scaled left.(p) left_unit) in
    let center_bits = unit + largest + bits (Z.of_int m) + 60 in
    let own = over_variables (fun p ->
        round_scaled pair.right.(p) (max 60 center_bits - fst (exponent_range pair.right))) in

    let bare = { Kernel.box_support = e.box_support; box_from = Kernel.zero; box_to = Kernel.zero;
                 box_pivot = variables.(k); box_center = own;
                 right_inverse = Array.to_list inverse; box_width = Z.zero; rate_width = Z.zero;
                 left_null } in
    let rows_a = Array.of_list pencil.rows_a and rows_b = Array.of_list pencil.rows_b in
    let products rows = Array.map (fun i ->
        Kernel.combine_row bare.right_inverse rows.(variables.(i))) pair.others in
    let ga = products rows_a and gb = products rows_b in

    let check center (from, upto) =
      let ends = [point_of from; point_of upto] in
      let dots rows = Array.map (fun i -> Kernel.sparse_dot rows.(variables.(i)) center)
          pair.others in
      let ra = dots rows_a and rb = dots rows_b in
      let margins = List.map (fun e ->
          e, Array.mapi (fun p a -> Kernel.margin (Kernel.row_at_end e a gb.(p)) p) ga) ends in
      (* The least integer that is at least all quotients of a bound by its margin. *)
      let quotient bound =
        List.fold_left (fun largest (e, margin) ->
            let largest = ref largest in
            Array.iteri (fun p m -> largest := Z.max !largest (Z.cdiv (bound e p) m)) margin;
            !largest) Z.zero margins in
      if List.exists (fun (_, margin) -> Array.exists (fun m -> Z.sign m <= 0) margin) margins
      then None
      else begin
        let box_width = quotient (fun e p -> Z.abs (Kernel.at_end e ra.(p) rb.(p))) in
        let claim = { bare with Kernel.box_from = List.hd ends; box_to = List.nth ends 1;
                                box_center = center; box_width } in
        let eps = Kernel.widths claim in
        let rates = Array.mapi (fun p i ->
            Z.add (Z.abs rb.(p)) (Kernel.absolute_dot rows_b.(variables.(i)) eps)) pair.others in
        let claim = { claim with
                      Kernel.rate_width = quotient (fun e p -> Z.mul (snd e) rates.(p)) } in
        if Kernel.determinant_changes_sign pencil claim eps && Kernel.one_root pencil claim eps
        && Kernel.box_signs pencil claim eps then Some claim else None
      end in
    check, given center_bits, own in

  (* The interval of the claim, or intervals about a zero in it that is known in doubles. *)
  let about t bits =
    let value = Q.of_float t in
    let size = if t = 0.0 then Q.one else Q.abs value in
    let width = Q.div size (Q.of_bigint (two_to bits)) in
    let from = Q.max lowest (Q.sub value width) and upto = Q.min highest (Q.add value width) in
    if Q.lt from upto then Some (from, upto) else None in
  let attempt k =
    let try_at t intervals =
      if Float.is_nan t || Float.abs t = infinity then None
      else match null_pair f k t with
        | None -> None
        | Some pair ->
          let check, given, own = witnesses k t pair in
          let centers = own :: Option.to_list given in
          List.find_map (fun interval ->
              List.find_map (fun center -> check center interval) centers) intervals in
    let t = Q.to_float center in
    let near t = List.filter_map (about t) [44; 38; 32; 26; 20; 14; 8] in
    match try_at t ((lowest, highest) :: near t) with
    | Some claim -> Some claim
    | None when m > 64 -> None
    | None -> let zero = newton f k 12 t in try_at zero (near zero) in

  let sizes = Array.map Q.abs z in
  let support = List.filter (fun p -> List.mem variables.(p) e.box_support) (List.init m Fun.id) in
  let pivots = List.sort (fun p q -> Q.compare sizes.(q) sizes.(p)) support in
  List.find_map attempt (List.filteri (fun i _ -> i < (if m <= 16 then 3 else 1)) pivots)

(* The box of a claim with zero reaction, as one for the pencil of the kernel. *)
let zero_enclosed_of (zero : Kernel.zero_system) unknown (e : enclosed) =
  enclosed_claim_of (Kernel.support_pencil zero unknown e.box_support) e

(* Root leaves where a gap and a half move: a box for the solution, and a leaf that pins its region.
   [undecided] puts the box beside the region that is left undecided. *)

let opening = "a root where a particle opens"

(* The box at the moving variables [j_list], with these components of x. *)
let opening_claim (pencil : Kernel.pencil) slip (zero : Kernel.zero_system) unknown j_list
    components (a, b) =
  let center = List.map (fun _ -> Q.zero) pencil.free @ components in
  let radius = List.map (fun _ -> Q.one) center in
  let names = List.map (fun k -> slip.(k)) j_list in
  let box = { box_support = names; center = center @ [half a b];
              radius = radius @ [Q.div (Q.sub b a) (Q.of_int 2)] } in
  match zero_enclosed_of zero unknown box with
  | None -> no_witness "%s" opening
  | Some claim ->
    claim, { Kernel.known_from = claim.box_from; known_to = claim.box_to;
                    known_support = j_list; known_biactive = [] }

let pinned_box_tree c zero unknown (region : Kernel.region) (r : root) undecided =
  let p = c.enclosed and f = c.doubles in
  let j_list = Kernel.moving p region in
  let r = { r with pivot = position c.slip r.pivot } in
  if not (List.mem r.pivot j_list) then no_witness "a root without its pivot";
  let a, b = r.interval in
  let components = match null_vectors p.Kernel.size_of f j_list r.pivot (middle a b) with
    | Some (v, _) ->
      let v = Array.of_list v in
      List.map (fun k -> Q.make v.(k) (two_to 52)) j_list
    | None -> no_witness "a root" in
  let box_claim, known =
    opening_claim c.pencil c.slip zero unknown j_list components r.interval in
  let found = ref None in
  let attempt region = match claimed_leaf p f region r 0 known with
    | Some (Kernel.Claimed (box_interval, box_pinning, _)) ->
      found := Some { Kernel.box_interval; near_anchor = 0; near_grain = Z.zero; box_pinning;
                      box_claim };
      Some Kernel.Undecided
    | _ -> None in
  let tree = narrow_tree ~absent:(absent_tree p f 12) ~weight:1 opening 12 attempt
      (value_of_known known) region in
  match !found with
  | Some box -> undecided box; tree
  | None -> no_witness "%s" opening

(* The same about the anchor of a piece. *)
let pinned_about_tree v (piece : piece) zero unknown (region : Kernel.region) (r : root) undecided =
  let n = Option.value (List.assoc_opt piece.anchor v.numbers) ~default:0 in
  let j_list = List.filter (fun k -> Kernel.state_of region k = Kernel.Moving)
      (List.init (Array.length v.slip_list) Fun.id) in
  let r = { r with pivot = position v.slip_list r.pivot } in
  let components = List.map (fun _ -> Q.one) j_list in
  let box_claim, known =
    opening_claim v.whole_pencil v.slip_list zero unknown j_list components r.interval in
  let found = ref None in
  let attempt region = match by_claim v n r 0 known region with
    | Some (Kernel.OfClaim (near_anchor, near_grain, box_interval, box_pinning, _)) ->
      found := Some { Kernel.box_interval; near_anchor; near_grain; box_pinning;
                      box_claim };
      Some Kernel.LeftOpen
    | _ -> None in
  let tree = varying_narrow v n opening attempt (value_of_known known) region in
  match !found with
  | Some box -> undecided box; tree
  | None -> no_witness "%s" opening
