(* The elaborator of support leaves: signs of polynomials with evidence. Untrusted.

   A support leaf of a certificate gives points, cells and reasons.  The kernel asks for evidence
   for each sign at each place (Signs.v): a quotient and a remainder at a point; in a cell a factor
   at each end and cuts between.  Intervals of points are bisected until the signs can be told. *)

open Certificate
open Elaborate

exception No_sign

(* Evidence at several precisions: the number of bisections. *)
let precisions = [0; 12; 40; 120]

let cuts_deep = 24
let cuts_in_all = 200

(* Work of the file, about in products of words. *)
let work_limit = 1 lsl 31
let work = ref 0

let beyond () = Problem.not_verified "support leaves beyond the limits of this program"

let spend units =
  work := !work + units;
  if !work > work_limit || units < 0 then beyond ()

let longest p = List.fold_left (fun m z -> max m (bits z)) 1 p
let negate = List.map Z.neg

let rec strip_zeros = function z :: rest when Z.sign z = 0 -> strip_zeros rest | p -> p

(* The sign of p(n/d), from the integer d^k p(n/d), k the degree. *)
let sign_of_poly p t =
  let n = Q.num t and d = Q.den t in
  let value, _ = List.fold_left (fun (sum, power) c ->
      Z.add (Z.mul sum n) (Z.mul c power), Z.mul power d) (Z.zero, Z.one) (List.rev p) in
  Z.sign value

(* c g = p q + r in integers, r shorter than p; constant terms first. *)
let divide_integers g p =
  let p = Array.of_list (List.rev (strip_zeros (List.rev p))) in
  let m = Array.length p in
  if m = 0 then no_witness "a polynomial that is zero";
  let r = Array.of_list g in
  let n = Array.length r in
  let q = Array.make (max 0 (n - m + 1)) Z.zero in
  let lead = p.(m - 1) in
  let factor = ref Z.one in
  for k = n - m downto 0 do
    let top = r.(k + m - 1) in
    if Z.sign top <> 0 then begin
      let common = Z.gcd top lead in
      let up = Z.abs (Z.divexact lead common) in
      let c = Z.divexact (Z.mul up top) lead in
      if not (Z.equal up Z.one) then begin
        Array.iteri (fun i v -> if i < k + m then r.(i) <- Z.mul up v) r;
        Array.iteri (fun i v -> q.(i) <- Z.mul up v) q;
        factor := Z.mul up !factor
      end;
      q.(k) <- Z.add q.(k) c;
      for i = 0 to m - 1 do r.(k + i) <- Z.sub r.(k + i) (Z.mul c p.(i)) done
    end
  done;
  !factor, Array.to_list q, List.rev (strip_zeros (List.rev (Array.to_list r)))

let words n = 1 + n / 64

let spend_evaluation p extra =
  let c = List.length p in
  spend (c * c * words (longest p + c * extra))

(* The products of [Kernel.positive_on]. *)
let spend_substitution p extra =
  let c = List.length p in
  spend (c * c * words (longest p + c * extra) * (1 + words extra / 4))

(* ---------- values *)

let bits_of_value (v : Kernel.value) = bits v.value_to + bits v.value_den

let value_from_interval p (a, b) =
  let d = Z.lcm (Q.den a) (Q.den b) in
  let over q = Q.num (Q.mul q (Q.of_bigint d)) in
  { Kernel.value_poly = p; value_from = over a; value_to = over b; value_den = d }

let bisect p (a, b) =
  let m = half a b in
  match sign_of_poly p m with
  | 0 -> (m, m)
  | s -> if s < 0 then (m, b) else (a, m)

(* p rises at its root in the interval. *)
let value_of_point precision (point : place_point) =
  let a, b = point.point_interval in
  if Q.sign a < 0 || Q.gt a b then no_witness "a point of a support leaf";
  let p = point.point_polynomial in
  spend_evaluation p (bits (Q.num b) + bits (Q.den b) + bits (Q.den a));
  let p = if Q.equal a b || sign_of_poly p b > 0 then p else negate p in
  let rec refine n (a, b) =
    let v = value_from_interval p (a, b) in
    if Q.equal a b || n <= 0 && Kernel.check_value v then v
    else if n < -60 then no_witness "a point of a support leaf"
    else begin
      spend_evaluation p (bits_of_value v);
      refine (n - 1) (bisect p (a, b))
    end in
  refine precision (a, b)

(* ---------- signs *)

let spend_division g p =
  let n = List.length g and m = List.length p in
  let steps = max 0 (n - m + 1) in
  let w = words (longest g + steps * (longest p + 64)) in
  spend (steps * m * w * w)

let sign_at_value (v : Kernel.value) g =
  let p = v.value_poly in
  spend_division g p;
  let multiplier, quotient, rest = divide_integers g p in
  let red = { Kernel.multiplier; quotient; rest } in
  spend_evaluation red.rest (bits_of_value v);
  let on f = f v.value_from v.value_to v.value_den red.rest in
  if Kernel.zero_poly red.rest then Kernel.IsZero, Kernel.Remainder red
  else if Z.sign (on Kernel.low_on) > 0 then IsPositive, Remainder red
  else if Z.sign (on Kernel.high_on) < 0 then
    IsNegative, Remainder { red with quotient = negate red.quotient; rest = negate red.rest }
  else raise No_sign

let no_near = { Kernel.near_multiplier = Z.one; near_power = 0; near_cofactor = [] }

(* c g = p^i h with h > 0 on the interval of v. *)
let near_value (v : Kernel.value) p g =
  if Kernel.rational v then no_near
  else begin
    let rec divided factor i h =
      spend_division h v.value_poly;
      match divide_integers h p with
      | c, (_ :: _ as quotient), [] -> divided (Z.mul c factor) (i + 1) quotient
      | _ -> factor, i, h in
    let c, i, h = divided Z.one 0 g in
    spend_evaluation h (bits_of_value v);
    if Z.sign (Kernel.low_on v.value_from v.value_to v.value_den h) <= 0 then raise No_sign;
    { near_multiplier = c; near_power = i; near_cofactor = h }
  end

(* Cuts between which g > 0 is seen. *)
let cuts_of g lower upper =
  let count = ref 0 in
  let size (p, q) = bits p + bits q in
  let rec cover first l u depth =
    spend_substitution g (size l + size u);
    if Kernel.positive_on first l u g then []
    else begin
      incr count;
      if depth = 0 || !count > cuts_in_all then raise No_sign;
      let m = if finite u then half (value_of l) (value_of u)
        else Q.add (Q.mul (value_of l) (Q.of_int 2)) Q.one in
      if sign_of_poly g m <= 0 then raise No_sign;
      let cut = point_of m in
      let below = cover first l cut (depth - 1) in
      below @ cut :: cover false cut u (depth - 1)
    end in
  cover true lower upper cuts_deep

let sign_in_cell (v : Kernel.value) (next : Kernel.value option) g =
  let lower = Kernel.end_of v in
  let upper = match next with Some v' -> Kernel.start_of v' | None -> Kernel.infinity in
  let inside = match next with
    | Some _ -> half (value_of lower) (value_of upper)
    | None -> Q.add (value_of lower) Q.one in
  let positive, sign = match sign_of_poly g inside with
    | 0 -> raise No_sign
    | s -> if s > 0 then g, Kernel.IsPositive else negate g, Kernel.IsNegative in
  let after = near_value v v.value_poly positive in
  let before = match next with
    | Some v' -> near_value v' (negate v'.value_poly) positive
    | None -> no_near in
  sign, Kernel.Parts (after, cuts_of positive lower upper, before)

let sign_in place g =
  if Kernel.zero_poly g then Kernel.IsZero, Kernel.Identity
  else match place with
    | Kernel.PointAt v -> sign_at_value v g
    | Between (v, v') -> sign_in_cell v (Some v') g
    | Above v -> sign_in_cell v None g

(* ---------- reasons *)

type roles = {
  pencil : Kernel.pencil;
  scales : Z.t array;  (* of the rows: f_i over the factor of the kernel's row *)
  moves : bool array;
  rests : bool array;
  active : bool array }

let unknown_sign = Kernel.IsZero, Kernel.Identity

let signs_where mask f = List.init (Array.length mask) (fun i ->
    if mask.(i) then f i else unknown_sign)

(* w over the rows of the kernel. *)
let over_rows roles w =
  if List.length w <> roles.pencil.Kernel.order then no_witness "a vector of a support leaf";
  List.mapi (fun i p -> List.map (Z.mul roles.scales.(i)) p) w

let weights_with_signs roles place wanted w =
  let components = Array.of_list w in
  { Kernel.row_weights = w;
    weight_signs = signs_where roles.rests (fun i -> sign_in place components.(i));
    column_signs = signs_where wanted (fun j ->
        sign_in place (Kernel.column_poly roles.pencil w j)) }

let refuted roles place w =
  let f = weights_with_signs roles place roles.active w in
  let has sign = List.exists (fun (s, _) -> s = sign) in
  if has Kernel.IsPositive f.column_signs && not (has Kernel.IsNegative f.column_signs) then
    weights_with_signs roles place roles.active (List.map negate w)
  else f

let bounds_of roles place pivot (j, l) =
  let l = over_rows roles l in
  let wanted = Array.mapi (fun i active -> active && i <> pivot) roles.active in
  let bound l = { Kernel.bounded = j; bound_signs = weights_with_signs roles place wanted l } in
  let no_weight = List.for_all Fun.id
      (List.mapi (fun i p -> not roles.rests.(i) || Kernel.zero_poly p) l) in
  if no_weight then [bound l; bound (List.map negate l)] else [bound l]

let solved roles place x alone =
  if List.length x <> roles.pencil.Kernel.order then no_witness "a vector of a support leaf";
  let x = List.mapi (fun i p -> if roles.rests.(i) then [] else p) x in
  let components = Array.of_list x in
  { Kernel.branch_x = x;
    x_signs = signs_where roles.moves (fun i -> sign_in place components.(i));
    y_signs = List.init roles.pencil.order (fun i ->
        sign_in place (Kernel.row_poly roles.pencil x i));
    alone_by = Option.map (fun (pivot, rows) ->
        pivot, List.concat_map (bounds_of roles place pivot) rows) alone }

let reason_in roles reasons place number =
  if number >= Array.length reasons then no_witness "a reason that is not there";
  match reasons.(number) with
  | Nothing w -> Kernel.Refuted (refuted roles place (over_rows roles w))
  | Something (x, alone) -> Kernel.Solved (solved roles place x alone)

(* ---------- leaves *)

let rec chain_of reason v points cells = match points, cells with
  | [], [] -> Kernel.Stop
  | [], [cell] -> Kernel.Last (reason (Kernel.Above v) cell)
  | (v', number) :: points, cell :: cells ->
    let own = reason (Kernel.Between (v, v')) cell in
    let next = reason (Kernel.PointAt v') number in
    Kernel.Next (own, v', next, chain_of reason v' points cells)
  | _ -> no_witness "the cells of a support leaf"

let attempt roles (leaf : support_leaf) precision =
  let points = List.map (fun point -> value_of_point precision point, point.point_reason)
      leaf.points in
  match points with
  | [] -> no_witness "a support leaf without points"
  | (first_value, number) :: points ->
    let reason = reason_in roles (Array.of_list leaf.reasons) in
    { Kernel.first_value; first_reason = reason (Kernel.PointAt first_value) number;
      further = chain_of reason first_value points leaf.cells }

(* The limits of 5.16 for one leaf, and the products with the pencil. *)
let limit order (leaf : support_leaf) =
  let vectors = List.concat_map (function
      | Nothing w -> [w]
      | Something (x, alone) ->
        x :: (match alone with Some (_, rows) -> List.map snd rows | None -> [])) leaf.reasons in
  let polynomials =
    List.map (fun point -> point.point_polynomial) leaf.points @ List.concat vectors in
  let count = List.fold_left (fun sum p -> sum + List.length p) 0 polynomials in
  let ends = List.concat_map (fun point ->
      let a, b = point.point_interval in
      [bits (Q.num a) + bits (Q.den a); bits (Q.num b) + bits (Q.den b)]) leaf.points in
  let top = List.fold_left (fun m p -> max m (longest p)) (List.fold_left max 1 ends) polynomials in
  let places = List.length leaf.points + List.length leaf.cells in
  if List.exists (fun p -> List.length p > 256) polynomials || (count + places) * top > 1 lsl 23
  then beyond ();
  let vectors = List.length vectors in
  if order > 300 || places > 4096 then beyond ();
  spend (places * places * words top);
  spend (places * vectors * order * order * (order + 64))

(* [factor i]: the factor of row i of the kernel's pencil. *)
let roles_of (pencil : Kernel.pencil) factor (region : Kernel.region) =
  let n = pencil.order in
  let rows_a = Array.of_list pencil.rows_a and rows_b = Array.of_list pencil.rows_b in
  let divisor i =
    let sums row =
      let table = Hashtbl.create 16 in
      List.iter (fun (j, v) ->
          let sum = Option.value (Hashtbl.find_opt table j) ~default:Z.zero in
          Hashtbl.replace table j (Z.add sum v)) row;
      Hashtbl.fold (fun _ v rest -> v :: rest) table [] in
    List.fold_left Z.gcd (factor i) (sums rows_a.(i) @ sums rows_b.(i)) in
  let divisors = Array.init n divisor in
  let common = Array.fold_left Z.lcm Z.one divisors in
  let mask f = Array.init n f in
  { pencil; scales = Array.map (Z.divexact common) divisors;
    moves = mask (Kernel.moves pencil region); rests = mask (Kernel.rests pencil region);
    active = mask (Kernel.is_active pencil region) }

(* The kernel's support leaf; None if nothing moves, so that the region holds nothing. *)
let support_leaf pencil factor region (leaf : support_leaf) =
  if not (Kernel.decided_region pencil region) then no_witness "a support leaf too early";
  let roles = roles_of pencil factor region in
  if not (Array.mem true roles.moves) then None
  else begin
    limit pencil.order leaf;
    let found = List.find_map (fun precision ->
        match attempt roles leaf precision with
        | l when Kernel.check_support pencil region l -> Some l
        | _ -> None
        | exception No_sign -> None) precisions in
    match found with Some l -> Some l | None -> no_witness "support"
  end
