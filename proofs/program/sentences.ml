(* What the program says of statements that are true: the verdict line and the sentences under it,
   in the words of `mceip check`.  Trusted.

   The verdict line names the question: the window, the unknown, the friction of a problem whose
   unknown is lambda2, and the digest; and it says where the window is not all of the problem's.
   Everything else is printed from statements that the kernel's [answer] gave. *)

let show_point (p, q) = if Z.sign q = 0 then "infinity" else Q.to_string (Q.make p q)

let show_interval lo hi =
  Printf.sprintf "[%s, %s%s" (show_point lo) (show_point hi)
    (if Z.sign (snd hi) = 0 then ")" else "]")

let show_window (lo, hi) = show_interval (Problem.point_of lo) (Problem.upper_point hi)

let show_list indices = "[" ^ String.concat ", " (List.map string_of_int indices) ^ "]"

let window_of lo hi =
  Problem.value_of lo, if Z.sign (snd hi) = 0 then None else Some (Problem.value_of hi)

(* Does the first window contain the second? *)
let covers (lo, hi) (lo', hi') =
  Q.leq lo lo' && (match hi, hi' with
      | None, _ -> true
      | Some _, None -> false
      | Some h, Some h' -> Q.geq h h')

let verdict word statement named = Printf.printf "%s, VERIFIED: %s (%s)" word statement named

(* The name of a question about one friction. *)
let name_of (problem : Problem.t) =
  let friction = match problem.friction with
    | None -> ""
    | Some mu -> Printf.sprintf "friction %s, " (Q.to_string mu) in
  Printf.sprintf "%s, %sproblem %s" problem.unknown friction problem.digest

(* The verdict on a statement about solutions in a window of the problem. *)
let verdict_in_window (problem : Problem.t) lo hi word statement =
  verdict word statement (name_of problem);
  if not (covers (window_of lo hi) problem.window) then
    Printf.printf "; NOT the whole window %s of the problem" (show_window problem.window);
  print_newline ()

(* The verdict on a statement about an interval of friction, whatever that of the problem is. *)
let verdict_for_friction (problem : Problem.t) statement =
  verdict "ACCEPTED" statement (Printf.sprintf "lambda2, problem %s" problem.digest);
  print_newline ()

(* At friction 0 a particle may slide both ways, of which (9) has one: the sentence leaves 0 out. *)
let without_zero low high =
  let closed = show_interval low high in
  if Q.sign (Problem.value_of low) > 0 then closed
  else "(" ^ String.sub closed 1 (String.length closed - 1)

let of_members (problem : Problem.t) = match problem.given with
  | Kernel.GivenMembers _ -> ", for every body within the radii of the data"
  | _ -> ""

let absent problem low high =
  verdict_for_friction problem
    (Printf.sprintf "no solution for friction in %s, lambda2 in %s%s" (without_zero low high)
       (show_interval Kernel.zero Kernel.infinity) (of_members problem))

let stable problem low high =
  verdict_for_friction problem
    (Printf.sprintf "stable for every mu in %s: small motions in these contact states lose energy \
                     as the theorem of stability asks" (without_zero low high))

let present problem low high =
  verdict_for_friction problem
    (Printf.sprintf "a solution with lambda2 >= 0 for every friction in %s%s"
       (show_interval low high) (of_members problem))

let claims_only problem lo hi =
  verdict_in_window problem lo hi "ACCEPTED"
    (Printf.sprintf "claims, each has a solution in %s; nothing said about others"
       (show_interval lo hi))

let points digest =
  verdict "ACCEPTED" "points, each solves the problem; nothing said about others"
    ("problem " ^ digest);
  print_newline ()

let one_motion_of_rates lo hi =
  let frictions =
    if Q.equal (Problem.value_of lo) (Problem.value_of hi) then "at mu = " ^ show_point lo
    else "for every mu in " ^ show_interval lo hi in
  Printf.printf "UNIQUE: %s the rates in these contact states are the only ones, whatever load \
                 grows\n" frictions

(* The contact states of the candidates, in their order. *)
let equilibrium digest (mu, amounts, states) =
  let mark = function
    | Kernel.SticksAt _ -> "."
    | SlipsWith sign -> if Z.sign sign > 0 then "<" else ">"
    | Apart -> "o"
    | WithoutReaction -> "z" in
  verdict "ACCEPTED"
    (Printf.sprintf "under the loads times %s, with friction %s, there is an equilibrium in the \
                     contact states %s"
       (String.concat ", " (List.map show_point amounts)) (show_point mu)
       (String.concat "" (List.map mark states)))
    ("candidates in order: . stick, < impending slip against its tangent (S = 1), > along it \
      (S = -1), o free, z in contact without reaction; loads " ^ digest);
  print_newline ()

let claim (problem : Problem.t) (claim : Kernel.asserted) =
  let show point = Q.to_string (Problem.value_of point) in
  Printf.printf "claim: %s in [%s, %s], slip %s\n" problem.unknown (show claim.asserted_from)
    (show claim.asserted_to) (show_list claim.asserted_support)

(* The variables of a region in this state, as positions among the complementarity variables. *)
let in_state state (region : Kernel.region) =
  List.filter_map Fun.id
    (List.mapi (fun i s -> if s = state then Some i else None) region.states)

let moving = in_state Kernel.Moving
let resting = in_state Kernel.Resting

let show_value (v : Kernel.value) =
  if Z.equal v.value_from v.value_to then show_point (Kernel.start_of v)
  else
    let decimal rounded point = rounded (Problem.value_of point) in
    Printf.sprintf "a value in [%s, %s]" (decimal Decimal.lower (Kernel.start_of v))
      (decimal Decimal.upper (Kernel.end_of v))

let show_place unknown = function
  | Kernel.PointAt v -> Printf.sprintf "%s = %s" unknown (show_value v)
  | Between (v, v') ->
    Printf.sprintf "every %s between %s and %s" unknown (show_value v) (show_value v')
  | Above v -> Printf.sprintf "every %s above %s" unknown (show_value v)

(* Two leaves share the value at their common end: it is listed once, as alone if one says so. *)
let listed_once families =
  let kept = Hashtbl.create 64 in
  let key number (region, (h : Kernel.holding)) = match h.held_place with
    | PointAt v when Kernel.rational v ->
      moving region, Some (Q.to_string (Q.make v.value_from v.value_den)), 0
    | _ -> [], None, number in
  List.iteri (fun number f ->
      let k = key number f in
      match Hashtbl.find_opt kept k with
      | Some (first, (_, (h : Kernel.holding))) ->
        if not h.held_alone then Hashtbl.replace kept k (first, f)
      | None -> Hashtbl.add kept k (number, f)) families;
  List.map snd (List.sort (fun (i, _) (j, _) -> compare i j)
                  (List.of_seq (Hashtbl.to_seq_values kept)))

let shown_regions = 20

(* How many solutions, whether there are families, and where every other solution is.  The families
   are not counted: one may be cut into several by the leaves of the tree. *)
let count_and_others place (all : Kernel.solution_set) =
  let none = all.solutions_in = [] && all.families_of_set = [] in
  let count = match List.length all.solutions_in with
    | 0 when none -> "no solution"
    | 1 -> "1 solution"
    | n -> Printf.sprintf "%d solutions" n in
  let families_too = if all.families_of_set = [] then "" else " and families of them" in
  let others = if none then "" else ", and no other" in
  let outside = match List.length all.open_regions with
    | 0 -> ""
    | 1 -> " outside 1 open region"
    | n -> Printf.sprintf " outside %d open regions" n in
  Printf.sprintf "%s%s %s%s%s" count families_too place others outside

let word_of left_open = if left_open = [] then "ACCEPTED" else "UNDECIDED"

let names slip positions = show_list (List.map (fun i -> slip.(i)) positions)

let cover (problem : Problem.t) slip lo hi (all : Kernel.solution_set) =
  let unknown = problem.unknown in
  verdict_in_window problem lo hi (word_of all.open_regions)
    (count_and_others ("in " ^ show_interval lo hi) all);

  List.iter (fun (y : Kernel.yield) ->
      Printf.printf "solution: %s in [%s, %s], slip %s\n" unknown
        (Decimal.lower (Problem.value_of y.yield_from))
        (Decimal.upper (Problem.value_of y.yield_to))
        (names slip (moving y.yield_region))) (List.rev all.solutions_in);
  List.iter (fun (region, (h : Kernel.holding)) ->
      Printf.printf "family: %s, slip %s, %s at each\n" (show_place unknown h.held_place)
        (names slip (moving region))
        (if h.held_alone then "one solution" else "a solution"))
    (listed_once all.families_of_set);

  let undecided region =
    let decided = moving region @ resting region in
    List.filter (fun i -> not (List.mem i decided)) (List.init (Array.length slip) Fun.id) in
  List.iteri (fun k (r : Kernel.region) ->
      if k < shown_regions then
        Printf.printf "open: %s in %s, moving %s, undecided %s\n" unknown
          (show_interval r.lower r.upper) (names slip (moving r)) (names slip (undecided r)))
    all.open_regions;
  let more = List.length all.open_regions - shown_regions in
  if more > 0 then Printf.printf "open: %d more regions (see the certificate)\n" more

let at_infinity (problem : Problem.t) slip (all : Kernel.solution_set) =
  verdict (word_of all.open_regions) (count_and_others "at infinity" all) (name_of problem);
  print_newline ();
  List.iter (fun (y : Kernel.yield) ->
      Printf.printf "solution: at infinity, slip %s\n" (names slip (moving y.yield_region)))
    (List.rev all.solutions_in);
  List.iter (fun (region, (h : Kernel.holding)) ->
      Printf.printf "family: at infinity, slip %s, %s\n" (names slip (moving region))
        (if h.held_alone then "one solution" else "a solution"))
    (listed_once all.families_of_set);
  List.iter (fun r -> Printf.printf "open: at infinity, moving %s\n" (names slip (moving r)))
    all.open_regions

(* Every other solution may lie in a region that is left open. *)
let exit_code (all : Kernel.solution_set) = if all.open_regions = [] then 0 else 3

(* Prints statements that are true: claims, one of another kind, or both.  The exit code. *)
let say (problem : Problem.t) statements =
  let slip = Array.of_list (Kernel.complementarity problem.given) in
  let beside, statement = match statements with
    | [Kernel.EachExists (_, _, claims); statement] -> claims, statement
    | [statement] -> [], statement
    | _ -> invalid_arg "statements of one certificate" in
  let claims, code = match statement with
    | EachExists (lo, hi, claims) when beside = [] -> claims_only problem lo hi; claims, 0
    | AllInWindow (lo, hi, all) -> cover problem slip lo hi all; beside, exit_code all
    | AllAtInfinity all -> at_infinity problem slip all; beside, exit_code all
    | NoneForFriction (low, high) -> absent problem low high; beside, 0
    | OneForEachFriction (low, high) -> present problem low high; beside, 0
    | StableForFriction (low, high) -> stable problem low high; beside, 0
    | EachExists _ | PointsSolve _ | OneMotionOfRates _ | InEquilibrium _ ->
      invalid_arg "statements of one certificate" in
  List.iter (claim problem) claims;
  code
