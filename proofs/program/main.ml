(* mceip-verified PROBLEM CERTIFICATE [--window a,b | --infinity]
   mceip-verified --coq PROBLEM CERTIFICATE [--window a,b | --infinity]

   Exit codes: 0 accepted, 1 rejected, 2 malformed, 3 undecided: the verified statement leaves
   regions open, 4 not verified: the certificate has evidence that the kernel has no theorem for,
   or no witness was found.

   A verdict with the word VERIFIED is printed only for statements that the kernel's [answer] gave
   for the problem that was read; [answer_sound] (Verdict.v) says that they are true.  Trusted. *)

(* What is asked of the certificate, beside its problem. *)
type demand = Anything | Window of (Q.t option * Q.t option) | Infinity

let prove given scales make =
  let evidence = make () in
  match Evidence.timed "kernel" (fun () -> Kernel.answer given scales evidence) with
  | Proved statement -> evidence, statement
  | refused -> raise (Evidence.refusal evidence refused)

(* Print a Coq file instead of the verdict.  Then the exit code is 0 for open regions as well. *)
let as_coq = ref false

(* What is printed of what has been proved.  The exit code. *)
let tell given digest scales proved say =
  if !as_coq then (Coq.print given digest scales proved; 0) else say (List.map snd proved)

let answers demanded (statements : Kernel.statement list) =
  match demanded, statements with
  | Anything, _ | Infinity, [AllAtInfinity _] -> true
  | Window window, _ -> Sentences.(covers (windows statements) window)
  | Infinity, _ -> false

(* Proves all parts, then prints.  The exit code. *)
let verify_parts demanded (problem : Problem.t) (integers : Scaling.t) parts =
  let proved = List.map (prove problem.given integers.scales) parts in
  if not (answers demanded (List.map snd proved)) then
    raise (Evidence.Rejected "the statement does not answer what is demanded");
  tell problem.given problem.digest integers.scales proved (Sentences.say problem)

(* The rates of a body, beside the verdict on a cover, which nothing that happens here changes. *)
let say_rates (problem : Problem.t) (integers : Scaling.t) certificate =
  let prove evidence = evidence, Kernel.answer problem.given integers.scales evidence in
  match Option.map prove (Evidence.rates integers certificate) with
  | Some (evidence, Proved (OneMotionOfRates _ as rates)) when !as_coq ->
    Coq.print_part "rates" (evidence, rates)
  | Some (_, Proved (OneMotionOfRates (lo, hi))) -> Sentences.one_motion_of_rates lo hi
  | _ | exception _ -> ()

let refuse_window demanded kind =
  let option = match demanded with
    | Anything -> None
    | Window _ -> Some "--window"
    | Infinity -> Some "--infinity" in
  Option.iter (fun option ->
      Json.malformed "%s: expected it with mceip-certificate/1 only, got %s" option kind) option

let window_shape =
  "a,b with 0 <= a <= b (b may be inf); for eigenvalue a <= b and 0 <= b (a may be -inf)"

let refuse_negative_window (problem : Problem.t) (lo, _) =
  let below_zero = Option.fold lo ~none:true ~some:(fun q -> Q.sign q < 0) in
  if below_zero && problem.unknown <> "eigenvalue" then
    Json.malformed "--window: expected %s" window_shape

let verify_eigenproblem demanded document problem_path certificate_path =
  let problem = Evidence.timed "problem" (fun () -> Problem.read problem_path document) in
  let certificate =
    Evidence.timed "certificate" (fun () -> Certificate.read certificate_path) in
  let integers = Scaling.of_problem problem in
  let code = verify_parts demanded problem integers (match certificate, demanded with
      | Complete certificate, Infinity -> Evidence.infinity integers certificate
      | Complete certificate, Window window ->
        refuse_negative_window problem window;
        Evidence.require_window (Sentences.covers (Evidence.windows certificate) window)
          ("one that covers " ^ Sentences.show_window window) certificate;
        Evidence.complete integers certificate
      | Complete certificate, Anything -> Evidence.complete integers certificate
      | Critical certificate, _ ->
        refuse_window demanded "mceip-critical/1";
        [Evidence.absence integers certificate]
      | Presence certificate, _ ->
        refuse_window demanded "mceip-presence/1";
        [Evidence.presence integers certificate]
      | Stability certificate, _ ->
        refuse_window demanded "mceip-stability/1";
        [Evidence.stability integers certificate]
      | Equilibrium _, _ ->
        Json.malformed "format: mceip-equilibrium/1 is about a body under loads, mceip-loads/1") in
  (match certificate, demanded with
   | Complete certificate, (Anything | Window _) when code = 0 ->
     say_rates problem integers certificate
   | _ -> ());
  code

let verify_plain document certificate_path =
  let problem = Plain.read document in
  let given = Kernel.GivenPlain problem.rows and scales = Scaling.of_plain problem.rows in
  let proved = prove given scales (fun () -> Evidence.plain problem certificate_path) in
  tell given problem.digest scales [proved] (fun _ -> Sentences.points problem.digest; 0)

let verify_loads problem_path document certificate_path =
  let problem = Loads.read problem_path document in
  match Certificate.read certificate_path with
  | Equilibrium certificate ->
    let given = Kernel.GivenLoads problem.body in
    let scales, evidence = Equilibria.evidence problem certificate in
    tell given problem.digest scales [prove given scales (fun () -> evidence)] (function
        | [InEquilibrium (mu, amounts, states)] ->
          Sentences.equilibrium problem.digest (mu, amounts, states); 0
        | _ -> invalid_arg "a statement of another kind")
  | _ -> Json.malformed "format: mceip-equilibrium/1 was expected"

(* a,b with a <= b and 0 <= b; a may be -inf or empty, b may be inf or empty. *)
let window_of text =
  let bad () = Json.malformed "--window: expected %s" window_shape in
  match List.map String.trim (String.split_on_char ',' text) with
  | [a; b] ->
    let lo = if a = "" || a = "-inf" then None else Some (Json.rational_of_spelling a) in
    let hi = if b = "" || b = "inf" then None else Some (Json.rational_of_spelling b) in
    if Option.fold hi ~none:false ~some:(fun h ->
        Q.sign h < 0 || Option.fold lo ~none:false ~some:(Q.lt h)) then bad ();
    lo, hi
  | _ -> bad ()

let verify demanded problem_path certificate_path =
  Evidence.start_anew ();
  let demanded = demanded () in
  let document = Json.read problem_path in
  if Json.has_format "mceip-mcp/1" document then begin
    refuse_window demanded "a plain problem";
    verify_plain document certificate_path
  end
  else if Json.has_format "mceip-loads/1" document then begin
    refuse_window demanded "a body under loads";
    verify_loads problem_path document certificate_path
  end
  else verify_eigenproblem demanded document problem_path certificate_path

(* The exit code for a problem and a certificate, after the verdict has been printed. *)
let answer ?(demanded = fun () -> Anything) problem certificate =
  let say code text = print_endline text; code in
  let not_verified what = say 4 ("NOT VERIFIED: " ^ what) in
  try verify demanded problem certificate with
  | Evidence.Rejected reason -> say 1 ("REJECTED: " ^ reason)
  | Json.Malformed reason -> say 2 ("MALFORMED: " ^ reason)
  | Sys_error reason -> say 2 ("MALFORMED: " ^ reason)
  | Stack_overflow | Out_of_memory -> not_verified "the memory of this program"
  | Problem.Not_verified kind -> not_verified kind
  | Elaborate.No_witness what -> not_verified ("no witness for " ^ what)
  | Invalid_argument what | Failure what -> not_verified ("a fault of this program: " ^ what)
  | Not_found | Division_by_zero | Match_failure _ -> not_verified "a fault of this program"

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
  let arguments = match List.tl (Array.to_list Sys.argv) with
    | "--coq" :: rest -> as_coq := true; rest
    | all -> all in
  match arguments with
  | ["--lines"] -> answer_lines ()
  | [problem; certificate] -> exit (answer problem certificate)
  | [problem; certificate; "--window"; window] ->
    exit (answer ~demanded:(fun () -> Window (window_of window)) problem certificate)
  | [problem; certificate; "--infinity"] ->
    exit (answer ~demanded:(fun () -> Infinity) problem certificate)
  | _ ->
    prerr_endline "usage: mceip-verified PROBLEM CERTIFICATE [--window a,b | --infinity]";
    prerr_endline "       mceip-verified --coq PROBLEM CERTIFICATE [--window a,b | --infinity]";
    exit 2
