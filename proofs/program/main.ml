(* mceip-verified PROBLEM CERTIFICATE

   Exit codes: 0 accepted, 1 rejected, 2 malformed, 3 not verified: the certificate has evidence
   that the kernel has no theorem for, or no witness was found.

   The verdict "accepted" is printed only after a function of the kernel returned true for the
   problem and the window that were read; the window and the list of solutions are printed from the
   arguments and the result of that function. *)

exception Rejected of string

let show_point (p, q) = if Z.sign q = 0 then "infinity" else Q.to_string (Q.make p q)

let show_decimal (p, q) =
  if Z.sign q = 0 then "infinity" else Printf.sprintf "%.12g" (Q.to_float (Q.make p q))

(* The moving variables of a region, as positions among the complementarity variables. *)
let moving (region : Kernel.region) =
  List.filter_map Fun.id
    (List.mapi (fun i s -> if s = Kernel.Moving then Some i else None) region.states)

(* No two of the regions can hold the same solution. *)
let apart (r1, (c1 : Kernel.isolation)) (r2, (c2 : Kernel.isolation)) =
  let less (p, q) (p', q') = Z.lt (Z.mul p q') (Z.mul p' q) in
  moving r1 <> moving r2 || less c1.to_point c2.from_point || less c2.to_point c1.from_point

let rec all_apart = function
  | [] -> true
  | x :: rest -> List.for_all (apart x) rest && all_apart rest

let report slip lo hi found =
  let window = Printf.sprintf "[%s, %s%s" (show_point lo) (show_point hi)
      (if Z.sign (snd hi) = 0 then ")" else "]") in
  let count = List.length found in
  let sentence =
    if count = 0 then "no solution"
    else if not (all_apart found) then
      Printf.sprintf "%d regions, each with exactly one solution, and no other solution" count
    else if count = 1 then "exactly one solution"
    else Printf.sprintf "exactly %d solutions" count in
  Printf.printf "ACCEPTED, VERIFIED: %s in %s\n" sentence window;
  List.iter (fun (region, (c : Kernel.isolation)) ->
      Printf.printf "solution: value in [%s, %s], moving %s\n" (show_decimal c.from_point)
        (show_decimal c.to_point)
        (String.concat " " (List.map (fun i -> string_of_int slip.(i)) (moving region)))) found

let time = Sys.getenv_opt "MCEIP_VERIFIED_TIMES" <> None

let timed name f =
  let start = Sys.time () in
  let result = f () in
  if time then Printf.eprintf "%s: %.3f s\n%!" name (Sys.time () -. start);
  result

let rec only_whole = function
  | [] -> true
  | (Certificate.Ldl | Tail | Split _ | Branch _) :: rest -> only_whole rest
  | _ -> false

let verify problem_path certificate_path =
  let problem = timed "problem" (fun () -> Problem.read problem_path) in
  let certificate = timed "certificate" (fun () -> Certificate.read certificate_path) in
  if certificate.digest <> problem.digest then
    raise (Rejected ("the digest of the problem is " ^ problem.digest));
  if certificate.unknown <> problem.unknown then raise (Rejected "the unknown is not the problem's");
  if certificate.pieces = [] then raise (Rejected "no claim");

  let pencil = timed "pencil" (fun () -> match problem.question with
      | Raw pencil -> pencil
      | Mechanical (system, unknown) -> Kernel.pencil_of system unknown) in
  let slip_list = Obj.magic (Kernel.slip pencil) in
  let slip = Array.of_list slip_list in
  if Array.length slip > 300 then Problem.not_verified "more than 300 complementarity variables";
  let lo = Elaborate.point_of (fst certificate.window) in
  let hi = Elaborate.upper_point (snd certificate.window) in
  let common = match problem.question with
    | Mechanical (_, Lambda2 (_, q)) -> Z.mul q problem.common
    | _ -> problem.common in

  let whole_only = pencil.free <> []
                   && List.for_all (fun (p : Certificate.piece) -> only_whole p.tree) certificate.pieces in
  if whole_only then begin
    (* Definite leaves of the whole pencil; free rows may depend on t. *)
    let leaf _ region _ = match Elaborate.whole_leaf pencil region with
      | Some w -> Kernel.Leaf w
      | None -> Elaborate.no_witness "ldl or tail" in
    let tree = timed "elaboration" (fun () ->
        Elaborate.build_pieces slip leaf certificate.window certificate.pieces) in
    let accepted = timed "kernel" (fun () -> match problem.question with
        | Raw pencil -> Kernel.check_excluded pencil tree lo hi
        | Mechanical (system, unknown) -> Kernel.check_system_excluded system unknown tree lo hi) in
    if not accepted then raise (Rejected "the kernel refuses the tree");
    report slip lo hi []
  end
  else begin
    if not (Kernel.free_rows_constant pencil) then
      Problem.not_verified "free rows that depend on the unknown";
    let anchor = match List.sort_uniq compare (List.map (fun (p : Certificate.piece) -> p.anchor)
                                                 certificate.pieces) with
      | [a] -> a
      | _ when pencil.free = [] -> 0
      | _ -> Problem.not_verified "several anchors" in
    let elimination, enclosed = timed "condensation" (fun () ->
        let e = Elaborate.elimination pencil slip_list common certificate.condensation anchor in
        e, Kernel.condensed (Kernel.blocks_of pencil) e) in
    let context = { Elaborate.pencil; slip; enclosed; doubles = Elaborate.doubles_of enclosed } in
    let tree = timed "elaboration" (fun () ->
        Elaborate.build_pieces slip (fun _ -> Elaborate.build_leaf context)
          certificate.window certificate.pieces) in
    let accepted = timed "kernel" (fun () -> match problem.question with
        | Raw pencil -> Kernel.check_complete pencil elimination tree lo hi
        | Mechanical (system, unknown) ->
          Kernel.check_system system unknown elimination tree lo hi) in
    if not accepted then raise (Rejected "the kernel refuses the tree");
    report slip lo hi (Kernel.found tree lo hi)
  end

let () =
  let finish code text = print_endline text; exit code in
  match Sys.argv with
  | [| _; problem; certificate |] ->
    (try verify problem certificate with
     | Rejected reason -> finish 1 ("REJECTED: " ^ reason)
     | Json.Malformed reason -> finish 2 ("MALFORMED: " ^ reason)
     | Sys_error reason -> finish 2 reason
     | Problem.Not_verified kind -> finish 3 ("NOT VERIFIED: " ^ kind)
     | Elaborate.No_witness what -> finish 3 ("NOT VERIFIED: no witness for " ^ what))
  | _ ->
    prerr_endline "usage: mceip-verified PROBLEM CERTIFICATE"; exit 2
