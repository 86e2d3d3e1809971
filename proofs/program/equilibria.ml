(* Evidence for an equilibrium in given contact states, from its certificate (certificates.md, 5.20;
   Equilibrium.v).

   The claim is about the pencil of the statement: displacements left open, in units of s, then s,
   which is 1 in a box, then a variable for each inequality, which is 0.  Here they become
   displacements u of all degrees of freedom, exact ones or the center of a box, with an approximate
   inverse of the equations.  Untrusted. *)

open Certificate

let value_of, point_of = Problem.(value_of, point_of)
let rejected fmt = Printf.ksprintf (fun text -> raise (Evidence.Rejected text)) fmt

let sum = List.fold_left Q.add Q.zero

type question = {
  body : Kernel.rational_body;
  certificate : equilibrium;
  states : (Kernel.candidate * Kernel.stated) list;
  is_held : bool array;
  untouched : int list }  (* dofs, not held, of no candidate in contact *)

let question_of (body : Kernel.rational_body) (certificate : equilibrium) =
  if Q.sign certificate.mu <= 0 then rejected "the friction is not positive";
  if List.length certificate.amounts <> List.length body.loads then
    rejected "amounts: expected one for each load";
  if List.length certificate.stated <> List.length body.candidates then
    rejected "candidates: expected a state for each";
  let degrees = List.init body.body_degrees Fun.id in
  let is_held = Array.of_list (List.map (Kernel.is_held body) degrees) in
  { body; certificate; is_held; states = List.combine body.candidates certificate.stated;
    untouched = List.filter (fun d ->
        not (is_held.(d) || Kernel.touched body certificate.stated d)) degrees }

let slides = function Kernel.SlipsWith _ | WithoutReaction -> true | Apart | SticksAt _ -> false

(* How many inequalities the pencil of the statement has for a state. *)
let inequalities_of = function Kernel.SticksAt _ -> 3 | Apart | SlipsWith _ | WithoutReaction -> 1

(* The number of the variable s. *)
let load_of q =
  List.length q.untouched + List.length (List.filter (fun (_, s) -> slides s) q.states)

(* The variables of the inequalities that are to vanish: those of candidates in state zero. *)
let zeros_of q =
  let number = ref (load_of q + 1) in
  List.concat_map (fun (_, state) ->
      let first = !number in
      number := first + inequalities_of state;
      if state = Kernel.WithoutReaction then [first] else []) q.states

(* u with these values of what is left open. *)
let displacements q values =
  let u = Array.make q.body.body_degrees Q.zero in
  List.iter2 (fun (l : Kernel.load) amount ->
      List.iter (fun (d, v) -> u.(d) <- Q.add u.(d) (Q.mul amount (value_of v)))
        l.displacements_of) q.body.loads q.certificate.amounts;
  let rest = ref values in
  let next () = match !rest with
    | value :: others -> rest := others; value
    | [] -> rejected "a claim that does not fit the states" in
  List.iter (fun d -> u.(d) <- next ()) q.untouched;
  List.iter (fun ((c : Kernel.candidate), state) ->
      let p = c.particle_of in
      let place along_tangent =
        let component (tangent, normal) =
          Q.add (Q.mul along_tangent (value_of tangent))
            (Q.mul (Q.mul (Q.of_bigint p.into_obstacle) (value_of c.gap_of)) (value_of normal)) in
        u.(p.first_of) <- component (fst p.frame_tangent, fst p.frame_normal);
        u.(p.second_of) <- component (snd p.frame_tangent, snd p.frame_normal) in
      match state with
      | Kernel.Apart -> ()
      | SticksAt at -> place (value_of at)
      | SlipsWith _ | WithoutReaction -> place (next ())) q.states;
  u

(* The values of what is left open at u: the inverse of [displacements]. *)
let open_values q u =
  List.map (fun d -> u.(d)) q.untouched
  @ List.filter_map (fun ((c : Kernel.candidate), state) ->
      let p = c.particle_of in
      let along (a, b) =
        Q.add (Q.mul (value_of a) u.(p.first_of)) (Q.mul (value_of b) u.(p.second_of)) in
      if slides state then Some (along p.frame_tangent) else None) q.states

let rec split_at n l = match l with
  | x :: rest when n > 0 -> let front, back = split_at (n - 1) rest in x :: front, back
  | _ -> [], l

(* Numerators over their common denominator, which follows them. *)
let over_common u =
  let common = Array.fold_left (fun c v -> Z.lcm c (Q.den v)) Z.one u in
  List.map (fun v -> Q.num (Q.mul v (Q.of_bigint common))) (Array.to_list u) @ [common]

(* The value of a pencil of a statement is 1. *)
let exact q (e : exact) =
  let load = load_of q in
  let inequalities = List.fold_left (fun n (_, state) -> n + inequalities_of state) 0 q.states in
  ignore (Evidence.size_of e e.x);
  let low, high = e.value in
  if Z.sign (List.fold_left Z.add Z.zero e.polynomial) <> 0 || Q.gt low Q.one || Q.lt high Q.one
  then rejected "the value is not 1";
  if e.support <> [load] then rejected "the support is not the variable of the loads";
  if e.biactive <> zeros_of q then
    rejected "the rows that vanish are not those of the candidates in state zero";
  if List.length e.x <> load + 1 + inequalities then rejected "x: expected one for each variable";
  match split_at load (List.map sum e.x) with
  | values, s :: others when Q.sign s > 0 && List.for_all (fun v -> Q.sign v = 0) others ->
    Kernel.ExactAt (over_common (displacements q (List.map (fun v -> Q.div v s) values)))
  | _ -> rejected "signs of x"

(* Degrees of freedom of a body with a box. *)
let largest_box = 2_048

(* The center of a box has this many bits behind the point. *)
let center_bits = 256

let doubles row = List.map (fun (d, v) -> d, Q.to_float (value_of v)) row

(* The rows as a square matrix of doubles, each divided by its largest entry. *)
let matrix_of n rows =
  let table = Array.make_matrix n n 0.0 in
  List.iteri (fun i row ->
      List.iter (fun (d, v) ->
          if d < n then table.(i).(d) <- table.(i).(d) +. v) (doubles row)) rows;
  let sizes = Array.map (Array.fold_left (fun m v -> max m (abs_float v)) 1e-300) table in
  Array.mapi (fun i row -> Array.map (fun v -> v /. sizes.(i)) row) table, sizes

(* A box around the solution of the equations near u; the kernel multiplies them by a common
   factor. *)
let box_about n common eqs u =
  let integral = List.map (Kernel.scaled_row common) eqs in
  let table, sizes = matrix_of n eqs in
  let y, exponent = match Elaborate.rounded_inverse table with
    | Some inverse -> inverse
    | None -> raise (Elaborate.No_witness "an equilibrium in a box") in
  let unit = Elaborate.two_to center_bits in
  let center = Array.init (n + 1) (fun d ->
      if d = n then unit
      else let v = u.(d) in Z.fdiv (Z.mul (Q.num v) unit) (Q.den v)) in
  let residuals () =
    let vector = Array.to_list center in
    List.mapi (fun i row ->
        let residual = Kernel.sparse_dot row vector in
        residual, Q.to_float (Q.make residual common) /. sizes.(i)) integral in

  (* Each step gains the digits that the inverse has. *)
  let inverse = Array.map (Array.map (fun z -> ldexp (Z.to_float z) (-exponent))) y in
  for _ = 1 to 8 do
    let scaled = Array.of_list (List.map snd (residuals ())) in
    Array.iteri (fun j row ->
        let correction = ref 0.0 in
        Array.iteri (fun i v -> correction := !correction +. v *. scaled.(i)) row;
        center.(j) <- Z.sub center.(j) (Elaborate.round_scaled !correction 0)) inverse
  done;

  (* Half of what the diagonal of the product is about. *)
  let margin = ldexp 0.5 exponent in
  let width = List.fold_left (fun w (_, scaled) ->
      max w (Float.ceil (abs_float scaled /. margin))) 1.0 (residuals ()) in
  center, List.map Array.to_list (Array.to_list y), Z.of_float width

(* Is an inequality positive all over the box of the claim (5.5)?  Its slopes are those along what
   is left open and s; [at_rest] is u where nothing that is open is displaced and s is 1. *)
let holds_in_box q at_rest center radius row =
  let n = q.body.body_degrees in
  let form = Array.make (n + 1) Q.zero in
  List.iter (fun (d, v) -> form.(d) <- Q.add form.(d) (value_of v)) row;
  let given = sum (form.(n) :: List.mapi (fun d v -> Q.mul form.(d) v) (Array.to_list at_rest)) in
  let slopes = open_values q form @ [given] in
  Q.gt (sum (List.map2 Q.mul slopes center))
    (sum (List.map2 (fun slope r -> Q.mul (Q.abs slope) r) slopes radius))

let enclosed q common eqs ineqs (e : enclosed) =
  let load = load_of q and n = q.body.body_degrees in
  if n > largest_box then
    Problem.not_verified "a box of more than %d degrees of freedom" largest_box;
  if e.box_support <> [load] then rejected "the support is not the variable of the loads";
  if zeros_of q <> [] then rejected "a box with a candidate in state zero";
  if List.length e.center <> load + 2 || List.length e.radius <> load + 2
  || List.exists (fun r -> Q.sign r <= 0) e.radius then rejected "a box that does not fit";
  let active l = fst (split_at (load + 1) l) in
  let values = fst (split_at load e.center) in
  let at_rest = displacements q (List.map (fun _ -> Q.zero) values) in
  if not (List.for_all (holds_in_box q at_rest (active e.center) (active e.radius)) ineqs) then
    rejected "an inequality does not hold in the box";
  let center, y, width = box_about n common eqs (displacements q values) in

  let unit = Elaborate.two_to center_bits in
  let found = Array.map (fun z -> Q.make z unit) (Array.sub center 0 n) in
  List.iter2 (fun v (center, radius) ->
      if Q.gt (Q.abs (Q.sub v center)) radius then rejected "no equilibrium in the box")
    (open_values q found @ [Q.one; Q.one]) (List.combine e.center e.radius);
  Kernel.BoxAround (Array.to_list center, y, width)

(* The factor of the rows, and the evidence. *)
let evidence (problem : Loads.t) (certificate : equilibrium) =
  if certificate.loads_digest <> problem.digest then
    rejected "the digest of the loads is %s" problem.digest;
  let q = question_of problem.body certificate in
  let mu = point_of certificate.mu and amounts = List.map point_of certificate.amounts in
  let eqs = Kernel.equations q.body mu amounts certificate.stated in
  let ineqs = Kernel.inequalities q.body mu amounts certificate.stated in
  let common = Scaling.of_rows (Scaling.of_rows Z.one eqs) ineqs in
  let witness = match certificate.equilibrium_claim with
    | Exact e -> exact q e
    | Enclosed e -> enclosed q common eqs ineqs e
    | Lifted _ -> rejected "a lifted solution of a body under loads" in
  { Kernel.entry_scale = common; length_scale = Z.one },
  Kernel.Equilibrium (mu, amounts, certificate.stated, witness)
