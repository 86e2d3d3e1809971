(* What the program says of statements that are true: the verdict line and the sentences under it.
   They name the question and the supports as `mceip check` does.  Trusted.

   The verdict line names the question: the window, the unknown, the friction of a problem whose
   unknown is lambda2, and the digest; and it says where the window is not all of the problem's.
   Everything else is printed from statements that the kernel's [answer] gave. *)

let show_point (p, q) = if Z.sign q = 0 then "infinity" else Q.to_string (Q.make p q)

(* A window has no end where it is infinite. *)
let show_window (lo, hi) =
  Option.fold lo ~none:"(-infinity" ~some:(fun q -> "[" ^ Q.to_string q) ^ ", "
  ^ Option.fold hi ~none:"infinity)" ~some:(fun q -> Q.to_string q ^ "]")

let show_list indices = "[" ^ String.concat ", " (List.map string_of_int indices) ^ "]"

(* Of an eigenvalue problem: statements about values below 0 have -t for t. *)
type side = Above | Below

(* The values t of a side between these ends. *)
let values side (lo, hi) = match side with
  | Above -> lo, hi
  | Below -> Q.neg hi, Q.neg lo

let on_side side (lo, hi) = match side with
  | Above -> Some lo, hi
  | Below -> Option.map Q.neg hi, Some (Q.neg lo)

let window_of lo hi =
  Problem.value_of lo, if Z.sign (snd hi) = 0 then None else Some (Problem.value_of hi)

let show_interval ?(side = Above) lo hi = show_window (on_side side (window_of lo hi))

(* One window in place of two that meet at 0. *)
let join = function
  | [(lo, Some q); (Some q', hi)] when Q.sign q = 0 && Q.sign q' = 0 -> [lo, hi]
  | windows -> windows

(* Does one of the windows contain this one? *)
let covers windows (lo', hi') =
  let reaches leq ends ends' = match ends, ends' with
    | None, _ -> true
    | Some _, None -> false
    | Some e, Some e' -> leq e e' in
  List.exists (fun (lo, hi) -> reaches Q.leq lo lo' && reaches Q.geq hi hi') windows

let verdict word statement named = Printf.printf "%s, VERIFIED: %s (%s)" word statement named

(* The name of a question about one friction. *)
let name_of (problem : Problem.t) =
  let friction = match problem.friction with
    | None -> ""
    | Some mu -> Printf.sprintf "friction %s, " (Q.to_string mu) in
  Printf.sprintf "%s, %sproblem %s" problem.unknown friction problem.digest

(* The verdict on a statement about solutions in windows of the problem. *)
let verdict_in_windows (problem : Problem.t) windows word statement =
  verdict word statement (name_of problem);
  if not (covers windows problem.window) then
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

let claims_only problem windows =
  verdict_in_windows problem windows "ACCEPTED"
    (Printf.sprintf "claims, each has a solution in %s; nothing said about others"
       (String.concat " or " (List.map show_window windows)))

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

let claim (problem : Problem.t) side (claim : Kernel.asserted) =
  Printf.printf "claim: %s in %s, support %s\n" problem.unknown
    (show_interval ~side claim.asserted_from claim.asserted_to)
    (show_list claim.asserted_support)

(* The variables of a region in this state, as positions among the complementarity variables. *)
let in_state state (region : Kernel.region) =
  List.filter_map Fun.id
    (List.mapi (fun i s -> if s = state then Some i else None) region.states)

let moving = in_state Kernel.Moving
let resting = in_state Kernel.Resting

let decimals side lo hi =
  let lo, hi = values side (Problem.value_of lo, Problem.value_of hi) in
  Printf.sprintf "[%s, %s]" (Decimal.lower lo) (Decimal.upper hi)

let show_value side (v : Kernel.value) =
  let first = Problem.value_of (Kernel.start_of v) in
  if Z.equal v.value_from v.value_to then Q.to_string (fst (values side (first, first)))
  else "a value in " ^ decimals side (Kernel.start_of v) (Kernel.end_of v)

let show_place unknown side place =
  let show = show_value side in
  match place, side with
  | Kernel.PointAt v, _ -> Printf.sprintf "%s = %s" unknown (show v)
  | Between (v, v'), Above | Between (v', v), Below ->
    Printf.sprintf "every %s between %s and %s" unknown (show v) (show v')
  | Above v, Above -> Printf.sprintf "every %s above %s" unknown (show v)
  | Above v, Below -> Printf.sprintf "every %s below %s" unknown (show v)

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

let is_closed (all : Kernel.solution_set) = all.open_regions = []

let union sets =
  let all part = List.concat_map part sets in
  { Kernel.solutions_in = all (fun (s : Kernel.solution_set) -> s.solutions_in);
    families_of_set = all (fun (s : Kernel.solution_set) -> s.families_of_set);
    open_regions = all (fun (s : Kernel.solution_set) -> s.open_regions) }

let is_empty (all : Kernel.solution_set) = all.solutions_in = [] && all.families_of_set = []

(* How many solutions in each place, whether there are families, and where every other solution is.
   The families are not counted: one may be cut into several by the leaves of the tree. *)
let count_and_others sets =
  let count (place, (all : Kernel.solution_set)) =
    let number = match List.length all.solutions_in with
      | 0 when is_empty all -> "no solution"
      | 1 -> "1 solution"
      | n -> Printf.sprintf "%d solutions" n in
    let families_too = if all.families_of_set = [] then "" else " and families of them" in
    Printf.sprintf "%s%s %s" number families_too place in
  let others = if List.for_all (fun (_, all) -> is_empty all) sets then "" else ", and no other" in
  let left_open (_, (all : Kernel.solution_set)) = List.length all.open_regions in
  let outside = match List.fold_left (+) 0 (List.map left_open sets) with
    | 0 -> ""
    | 1 -> " outside 1 open region"
    | n -> Printf.sprintf " outside %d open regions" n in
  String.concat ", " (List.map count sets) ^ others ^ outside

(* Every other solution may lie in a region that is left open. *)
let word_of sets = if List.for_all is_closed sets then "ACCEPTED" else "UNDECIDED"
let exit_code sets = if List.for_all is_closed sets then 0 else 3

let names slip positions = show_list (List.map (fun i -> slip.(i)) positions)

(* The supports in a region: the variables that move there, and any of those not decided. *)
let supports slip region =
  let certain = "support " ^ names slip (moving region) in
  let decided = moving region @ resting region in
  let is_undecided i = not (List.mem i decided) in
  match List.filter is_undecided (List.init (Array.length slip) Fun.id) with
  | [] -> certain
  | undecided -> certain ^ " and any of " ^ names slip undecided

(* Lists are in the order of the values t. *)
let ascending side l = match side with Above -> l | Below -> List.rev l

let say_set unknown slip (side, _, (all : Kernel.solution_set)) =
  List.iter (fun (y : Kernel.yield) ->
      Printf.printf "solution: %s in %s, support %s\n" unknown
        (decimals side y.yield_from y.yield_to)
        (names slip (moving y.yield_region))) (ascending side (List.rev all.solutions_in));
  List.iter (fun (region, (h : Kernel.holding)) ->
      Printf.printf "family: %s, support %s, %s at each\n" (show_place unknown side h.held_place)
        (names slip (moving region))
        (if h.held_alone then "one solution" else "a solution"))
    (ascending side (listed_once all.families_of_set));
  List.iteri (fun k (r : Kernel.region) ->
      if k < shown_regions then
        Printf.printf "open: %s in %s, %s\n" unknown (show_interval ~side r.lower r.upper)
          (supports slip r))
    (ascending side all.open_regions);
  let more = List.length all.open_regions - shown_regions in
  if more > 0 then Printf.printf "open: %d more regions (see the certificate)\n" more

let at_infinity (problem : Problem.t) slip (all : Kernel.solution_set) =
  verdict (word_of [all]) (count_and_others ["at infinity", all]) (name_of problem);
  print_newline ();
  List.iter (fun (y : Kernel.yield) ->
      Printf.printf "solution: at infinity, support %s\n" (names slip (moving y.yield_region)))
    (List.rev all.solutions_in);
  List.iter (fun (region, (h : Kernel.holding)) ->
      Printf.printf "family: at infinity, support %s, %s\n" (names slip (moving region))
        (if h.held_alone then "one solution" else "a solution"))
    (listed_once all.families_of_set);
  List.iter (fun r -> Printf.printf "open: at infinity, %s\n" (supports slip r))
    all.open_regions;
  exit_code [all]

(* What statements say of solutions, with the side and the window: claims, and sets. *)

let both_sides each statements =
  List.filter_map (function
      | Kernel.BelowZero s -> each Below s
      | _ -> None) statements
  @ List.filter_map (each Above) statements

let claims_of = both_sides (fun side -> function
    | Kernel.EachExists (lo, hi, claims) -> Some (side, (lo, hi), claims)
    | _ -> None)

let sets_of statements =
  let parts = function
    | Kernel.AllOfBothSigns (a, b, below, above) ->
      [Kernel.BelowZero (AllInWindow (Kernel.zero, a, below)); AllInWindow (Kernel.zero, b, above)]
    | s -> [s] in
  both_sides (fun side -> function
      | Kernel.AllInWindow (lo, hi, set) -> Some (side, (lo, hi), set)
      | _ -> None) (List.concat_map parts statements)

(* The windows in which all solutions are known or, where there are none, those of the claims. *)
let windows statements =
  let of_parts parts = List.map (fun (side, (lo, hi), _) -> on_side side (window_of lo hi)) parts in
  let of_both = function
    | Kernel.AllOfBothSigns (a, b, _, _) ->
      Some (fst (on_side Below (window_of Kernel.zero a)), snd (window_of Kernel.zero b))
    | _ -> None in
  match List.find_map of_both statements, sets_of statements with
  | Some window, _ -> [window]
  | None, [] -> join (of_parts (claims_of statements))
  | None, sets -> of_parts sets

(* Sets are counted together where no solution is in two of them.  The exit code. *)
let say_sets (problem : Problem.t) slip windows sets =
  let all = List.map (fun (_, _, set) -> set) sets in
  let together = match all with
    | [_] -> true
    | [below; above] -> Kernel.told_apart below above
    | _ -> invalid_arg "statements of one certificate" in
  let of_side (side, (lo, hi), set) = "in " ^ show_interval ~side lo hi, set in
  let counts = match windows with
    | [window] when together -> count_and_others ["in " ^ show_window window, union all]
    | [_] -> count_and_others (List.map of_side sets) ^ "; one with the value 0 would count twice"
    | _ -> count_and_others (List.map of_side sets) in
  verdict_in_windows problem windows (word_of all) counts;
  List.iter (say_set problem.unknown slip) sets;
  exit_code all

(* Prints statements that are true: claims, those of another kind, or both.  The exit code. *)
let say (problem : Problem.t) statements =
  let slip = Array.of_list (Kernel.complementarity problem.given) in
  let claims = claims_of statements and sets = sets_of statements in
  let code = match statements with
    | _ when sets <> [] -> say_sets problem slip (windows statements) sets
    | _ when claims <> [] -> claims_only problem (windows statements); 0
    | [AllAtInfinity all] -> at_infinity problem slip all
    | [NoneForFriction (low, high)] -> absent problem low high; 0
    | [OneForEachFriction (low, high)] -> present problem low high; 0
    | [StableForFriction (low, high)] -> stable problem low high; 0
    | _ -> invalid_arg "statements of one certificate" in
  List.iter (fun (side, _, claims) -> List.iter (claim problem side) claims) claims;
  code
