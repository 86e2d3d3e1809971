(* What the program says after the kernel has accepted: the verdict line and the sentences under it,
   in the words of `mceip check`.  Trusted.

   The verdict line names the question: the window, the unknown, the friction of a problem whose
   unknown is lambda2, and the digest; and it says where the window is not all of the problem's.
   Everything is printed from the arguments and the result of a function of the kernel. *)

let show_point (p, q) = if Z.sign q = 0 then "infinity" else Q.to_string (Q.make p q)

let show_interval lo hi =
  Printf.sprintf "[%s, %s%s" (show_point lo) (show_point hi)
    (if Z.sign (snd hi) = 0 then ")" else "]")

let show_window (lo, hi) = show_interval (Problem.point_of lo) (Problem.upper_point hi)

let show_list indices = "[" ^ String.concat ", " (List.map string_of_int indices) ^ "]"

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
let verdict_in_window (problem : Problem.t) window word statement =
  verdict word statement (name_of problem);
  if not (covers window problem.window) then
    Printf.printf "; NOT the whole window %s of the problem" (show_window problem.window);
  print_newline ()

(* The verdict on a statement about an interval of friction, whatever that of the problem is. *)
let verdict_for_friction (problem : Problem.t) statement =
  verdict "ACCEPTED" statement (Printf.sprintf "lambda2, problem %s" problem.digest);
  print_newline ()

(* At friction 0 a particle may slide both ways, of which (9) has one: the sentence leaves 0 out. *)
let absent problem low high =
  let closed = show_interval low high in
  let frictions =
    if Q.sign (Problem.value_of low) > 0 then closed
    else "(" ^ String.sub closed 1 (String.length closed - 1) in
  verdict_for_friction problem
    (Printf.sprintf "no solution for friction in %s, lambda2 in %s" frictions
       (show_interval Kernel.zero Kernel.infinity))

let present problem low high =
  verdict_for_friction problem
    (Printf.sprintf "a solution with lambda2 >= 0 for every friction in %s"
       (show_interval low high))

let claims_only problem window =
  verdict_in_window problem window "ACCEPTED"
    (Printf.sprintf "claims, each has a solution in %s; nothing said about others"
       (show_window window))

let points digest =
  verdict "ACCEPTED" "points, each solves the problem; nothing said about others"
    ("problem " ^ digest);
  print_newline ()

let claim (problem : Problem.t) ((a, b), support) =
  Printf.printf "claim: %s in [%s, %s], slip %s\n" problem.unknown (Q.to_string a) (Q.to_string b)
    (show_list support)

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
let count_and_others place found families left_open =
  let none = found = [] && families = [] in
  let count = match List.length found with
    | 0 when none -> "no solution"
    | 1 -> "1 solution"
    | n -> Printf.sprintf "%d solutions" n in
  let families_too = if families = [] then "" else " and families of them" in
  let others = if none then "" else ", and no other" in
  let outside = match List.length left_open with
    | 0 -> ""
    | 1 -> " outside 1 open region"
    | n -> Printf.sprintf " outside %d open regions" n in
  Printf.sprintf "%s%s %s%s%s" count families_too place others outside

let word_of left_open = if left_open = [] then "ACCEPTED" else "UNDECIDED"

(* What the theorems [system_families_number] and [system_families_hold] say of the solutions
   found, the families and the regions left open. *)
let cover (problem : Problem.t) window slip found families left_open =
  let unknown = problem.unknown in
  let names positions = show_list (List.map (fun i -> slip.(i)) positions) in
  verdict_in_window problem window (word_of left_open)
    (count_and_others ("in " ^ show_window window) found families left_open);

  List.iter (fun (y : Kernel.yield) ->
      Printf.printf "solution: %s in [%s, %s], slip %s\n" unknown
        (Decimal.lower (Problem.value_of y.yield_from))
        (Decimal.upper (Problem.value_of y.yield_to))
        (names (moving y.yield_region))) found;
  List.iter (fun (region, (h : Kernel.holding)) ->
      Printf.printf "family: %s, slip %s, %s at each\n" (show_place unknown h.held_place)
        (names (moving region))
        (if h.held_alone then "one solution" else "a solution")) (listed_once families);

  let undecided region =
    let decided = moving region @ resting region in
    List.filter (fun i -> not (List.mem i decided)) (List.init (Array.length slip) Fun.id) in
  List.iteri (fun k (r : Kernel.region) ->
      if k < shown_regions then
        Printf.printf "open: %s in %s, moving %s, undecided %s\n" unknown
          (show_interval r.lower r.upper) (names (moving r)) (names (undecided r))) left_open;
  let more = List.length left_open - shown_regions in
  if more > 0 then Printf.printf "open: %d more regions (see the certificate)\n" more

(* What the theorems [infinity_number] and [infinity_hold] say of solutions at infinity. *)
let at_infinity (problem : Problem.t) slip found families left_open =
  let names positions = show_list (List.map (fun i -> slip.(i)) positions) in
  verdict (word_of left_open) (count_and_others "at infinity" found families left_open)
    (name_of problem);
  print_newline ();
  List.iter (fun (y : Kernel.yield) ->
      Printf.printf "solution: at infinity, slip %s\n" (names (moving y.yield_region))) found;
  List.iter (fun (region, (h : Kernel.holding)) ->
      Printf.printf "family: at infinity, slip %s, %s\n" (names (moving region))
        (if h.held_alone then "one solution" else "a solution")) (listed_once families);
  List.iter (fun r -> Printf.printf "open: at infinity, moving %s\n" (names (moving r))) left_open
