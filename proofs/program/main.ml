(* mceip-verified PROBLEM CERTIFICATE

   Exit codes: 0 accepted, 1 rejected, 2 malformed, 3 not verified: the certificate has evidence
   that the kernel has no theorem for, or no witness was found.

   The verdict "accepted" is printed only after a function of the kernel returned true for the
   problem and the window that were read; the window and the list of solutions are printed from the
   arguments and the result of that function. *)

exception Rejected of string

let show_point (p, q) = if Z.sign q = 0 then "infinity" else Q.to_string (Q.make p q)

let show_decimal rounded (p, q) =
  if Z.sign q = 0 then "infinity" else rounded (Q.make p q)

(* The moving variables of a region, as positions among the complementarity variables. *)
let moving (region : Kernel.region) =
  List.filter_map Fun.id
    (List.mapi (fun i s -> if s = Kernel.Moving then Some i else None) region.states)

let resting (region : Kernel.region) =
  List.filter_map Fun.id
    (List.mapi (fun i s -> if s = Kernel.Resting then Some i else None) region.states)

let show_interval lo hi =
  Printf.sprintf "[%s, %s%s" (show_point lo) (show_point hi)
    (if Z.sign (snd hi) = 0 then ")" else "]")

let shown_regions = 20

(* Prints what the theorem [system_number] says of the solutions found and the regions left open;
   the exit code. *)
let report slip lo hi found left_open =
  let names positions = String.concat " " (List.map (fun i -> string_of_int slip.(i)) positions) in
  let window = show_interval lo hi and count = List.length found in
  if left_open = [] then
    Printf.printf "ACCEPTED, VERIFIED: %s in %s\n"
      (match count with
       | 0 -> "no solution"
       | 1 -> "exactly one solution"
       | _ -> Printf.sprintf "exactly %d solutions" count) window
  else
    Printf.printf "UNDECIDED, VERIFIED: %s in %s lies in one of %d open region(s)\n"
      (match count with
       | 0 -> "every solution"
       | 1 -> "one solution; every other one"
       | _ -> Printf.sprintf "%d solutions; every other one" count)
      window (List.length left_open);
  List.iter (fun (y : Kernel.yield) ->
      Printf.printf "solution: value in [%s, %s], moving %s\n"
        (show_decimal Decimal.lower y.yield_from) (show_decimal Decimal.upper y.yield_to)
        (names (moving y.yield_region))) found;
  List.iteri (fun k (r : Kernel.region) ->
      if k < shown_regions then
        Printf.printf "open: values in %s, moving {%s}, at rest {%s}\n"
          (show_interval r.lower r.upper) (names (moving r)) (names (resting r))
      else if k = shown_regions then Printf.printf "open: more regions\n") left_open;
  if left_open = [] then 0 else 3

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

(* Larger claims are answered with "not verified", so that every file ends in short time. *)
let work_of (pencil : Kernel.pencil) (e : Certificate.exact) =
  let bits q = Z.numbits (Q.num q) + Z.numbits (Q.den q) in
  let longest = List.fold_left (fun m p -> max m (List.length p)) 0 e.x in
  let degree = List.length e.polynomial in
  let top = List.fold_left (List.fold_left (fun m v -> max m (bits v)))
      (bits (fst e.value) + bits (snd e.value)) (List.map Q.of_bigint e.polynomial :: e.x) in
  let size = (degree + longest) * top in
  if degree > 512 || longest > 512 || size > 1 lsl 17 || (longest - degree) * top > 1 lsl 13 then
    Problem.not_verified "a claim beyond the limits of this program";
  pencil.order * size * size

let limit_work pencil claims =
  let entries = List.fold_left (fun n row -> n + List.length row) 0 in
  let n = pencil.Kernel.order in
  if claims <> [] && n * n + entries pencil.rows_a + entries pencil.rows_b > 1 lsl 22 then
    Problem.not_verified "claims about more than 2,048 variables";
  let total = List.fold_left (fun sum e -> sum + work_of pencil e) 0 claims in
  if total > 1 lsl 36 then Problem.not_verified "claims beyond the limits of this program"

(* Each claim: its support has a solution with a value in its interval, which is in the window. *)
let verify_claim (problem : Problem.t) pencil (certificate : Certificate.t)
    (e : Certificate.exact) =
  let a, b = e.value and lo, hi = certificate.window in
  if Q.lt a lo || (match hi with Some h -> Q.gt b h | None -> false) then
    raise (Rejected "a claim outside the window");
  if List.length e.x <> pencil.Kernel.order then raise (Rejected "a claim with too few components");
  let rec ascending = function a :: (b :: _ as rest) -> a < b && ascending rest | _ -> true in
  if not (ascending e.support && ascending e.biactive) then
    raise (Rejected "a claim whose lists are not ascending");
  let claim = Elaborate.claim_of pencil e in
  let accepted = match problem.question with
    | Raw pencil -> Kernel.check_claim pencil claim
    | Mechanical (system, unknown) -> Kernel.check_system_claim system unknown claim in
  if not accepted then raise (Rejected "the kernel refuses a claim");
  claim, fun () ->
    Printf.printf "claim: a solution with a value in [%s, %s], support %s\n" (Q.to_string a)
      (Q.to_string b) (String.concat " " (List.map string_of_int e.support))

(* Print the accepted question and its witness as a Coq file instead of the verdict. *)
let as_coq = ref false

let print_coq (problem : Problem.t) elimination tree lo hi found =
  match problem.question with
  | Raw _ -> Problem.not_verified "Coq files are made for mechanical systems"
  | Mechanical (system, unknown) ->
    Coq.print system unknown elimination tree lo hi (List.length found)

let verify problem_path certificate_path =
  let problem = timed "problem" (fun () -> Problem.read problem_path) in
  let certificate = timed "certificate" (fun () -> Certificate.read certificate_path) in
  if certificate.digest <> problem.digest then
    raise (Rejected ("the digest of the problem is " ^ problem.digest));
  if certificate.unknown <> problem.unknown then
    raise (Rejected "the unknown is not the problem's");
  if certificate.pieces = [] && certificate.claims = [] then raise (Rejected "no claim");

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

  let claims = timed "claims" (fun () ->
      limit_work pencil certificate.claims;
      List.map (verify_claim problem pencil certificate) certificate.claims) in
  let report_claims () = List.iter (fun (_, print) -> print ()) claims in

  let whole_only =
    pencil.free <> []
    && List.for_all (fun (p : Certificate.piece) -> only_whole p.tree) certificate.pieces in
  if certificate.pieces = [] then begin
    Printf.printf "ACCEPTED, VERIFIED: %d solution(s) claimed, nothing said about others\n"
      (List.length claims);
    report_claims ();
    0
  end
  else if whole_only then begin
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
    let code = report slip lo hi [] [] in
    report_claims ();
    code
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
    (* The kernel is given the claims that the tree refers to, in their places. *)
    let needed = List.exists (fun (p : Certificate.piece) -> List.exists (function
        | Certificate.Root { outcome = Claim _; _ } -> true
        | _ -> false) p.tree) certificate.pieces in
    let claims = if needed then List.map fst claims else [] in
    let known = Array.of_list (Kernel.known_solutions pencil claims) in
    let context =
      { Elaborate.pencil; slip; enclosed; doubles = Elaborate.doubles_of enclosed; known } in
    let tree = timed "elaboration" (fun () ->
        Elaborate.build_pieces slip (fun _ -> Elaborate.build_leaf context)
          certificate.window certificate.pieces) in
    let accepted = timed "kernel" (fun () -> match problem.question with
        | Raw pencil -> Kernel.check_complete pencil claims elimination tree lo hi
        | Mechanical (system, unknown) ->
          Kernel.check_system system unknown claims elimination tree lo hi) in
    if not accepted then raise (Rejected "the kernel refuses the tree");
    if List.length (Kernel.found pencil claims tree lo hi) > 10_000 then
      Problem.not_verified "more than 10,000 regions with a solution";
    match Kernel.solutions_found pencil claims tree lo hi with
    | None ->
      Problem.not_verified "regions that may hold the same solution, or a value beside the window"
    | Some found when !as_coq -> print_coq problem elimination tree lo hi found; 0
    | Some found ->
      let code = report slip lo hi (List.rev found) (Kernel.left_open tree lo hi) in
      report_claims ();
      code
  end

(* The exit code for a problem and a certificate, after the verdict has been printed. *)
let answer problem certificate =
  let say code text = print_endline text; code in
  try verify problem certificate with
  | Rejected reason -> say 1 ("REJECTED: " ^ reason)
  | Json.Malformed reason -> say 2 ("MALFORMED: " ^ reason)
  | Sys_error reason -> say 2 reason
  | Stack_overflow | Out_of_memory -> say 3 "NOT VERIFIED: the memory of this program"
  | Problem.Not_verified kind -> say 3 ("NOT VERIFIED: " ^ kind)
  | Elaborate.No_witness what -> say 3 ("NOT VERIFIED: no witness for " ^ what)

(* For tests with many files: each line of stdin has the paths of a problem and a certificate,
   without blanks; after what is printed for them comes a line "exit CODE". *)
let answer_lines () =
  try
    while true do
      match String.split_on_char ' ' (input_line stdin) with
      | [problem; certificate] -> Printf.printf "exit %d\n%!" (answer problem certificate)
      | _ -> prerr_endline "a line has two paths"; exit 2
    done
  with End_of_file -> ()

let () =
  match Sys.argv with
  | [| _; "--lines" |] -> answer_lines ()
  | [| _; "--coq"; problem; certificate |] -> as_coq := true; exit (answer problem certificate)
  | [| _; problem; certificate |] -> exit (answer problem certificate)
  | _ ->
    prerr_endline "usage: mceip-verified PROBLEM CERTIFICATE"; exit 2
