(* mceip-verified PROBLEM CERTIFICATE [--window a,b | --infinity]

   Exit codes: 0 accepted, 1 rejected, 2 malformed, 3 undecided: the verified statement leaves
   regions open, 4 not verified: the certificate has evidence that the kernel has no theorem for,
   or no witness was found.

   A verdict with the word VERIFIED is printed only after a function of the kernel returned true for
   the problem and the window that were read. *)

exception Rejected of string

let time = Sys.getenv_opt "MCEIP_VERIFIED_TIMES" <> None

let timed name f =
  let start = Sys.time () in
  let result = f () in
  if time then Printf.eprintf "%s: %.3f s\n%!" name (Sys.time () -. start);
  result

(* Larger claims are answered with "not verified", so that every file ends in short time. *)
let size_of (e : Certificate.exact) polynomials =
  let bits q = Z.numbits (Q.num q) + Z.numbits (Q.den q) in
  let longest = List.fold_left (fun m p -> max m (List.length p)) 0 polynomials in
  let degree = List.length e.polynomial in
  let top = List.fold_left (List.fold_left (fun m v -> max m (bits v)))
      (bits (fst e.value) + bits (snd e.value))
      (List.map Q.of_bigint e.polynomial :: polynomials) in
  let size = (degree + longest) * top in
  if degree > 512 || longest > 512 || size > 1 lsl 17 || (longest - degree) * top > 1 lsl 13 then
    Problem.not_verified "a claim beyond the limits of this program";
  size

let largest_enclosed = 1_024

let entries = List.fold_left (fun n row -> n + List.length row) 0

let work_of (problem : Problem.t) (pencil : Kernel.pencil) = function
  | Certificate.Exact e ->
    let size = size_of e e.x in
    pencil.order * size * size
  | Lifted l ->
    let polynomials = l.motion.x @ l.forces in
    let size = size_of l.motion polynomials in
    List.length polynomials * size * size
  | Enclosed e ->
    let m = List.length pencil.free + List.length e.box_support in
    if m > largest_enclosed then
      Problem.not_verified "an enclosed solution of more than %d active variables"
        largest_enclosed;
    (1 + pencil.order + entries pencil.rows_a + entries pencil.rows_b + m * m / 8) * m * 128

(* The same for a box with zero reaction, whose pencil is that of the kernel. *)
let zero_box_work (zero : Kernel.zero_system) (e : Certificate.enclosed) =
  let system = zero.without_zero in
  let frees = List.length system.free_dofs in
  let variables = frees + List.length system.particles + 3 * List.length zero.zero_particles in
  if List.exists (fun i -> i < frees || i >= variables) e.box_support then
    raise (Rejected "a box that does not fit the pencil");
  let m = system.dofs + List.length e.box_support in
  if m > largest_enclosed then
    Problem.not_verified "an enclosed solution of more than %d active variables" largest_enclosed;
  let entries = 4 * (entries system.stiffness + entries system.mass + system.dofs) in
  (1 + system.dofs + entries + m * m / 8) * m * 128

let limit_work (problem : Problem.t) pencil claims =
  let n = pencil.Kernel.order in
  let size = match problem.question with
    | Mechanical (system, _) when
        List.exists (function Certificate.Lifted _ -> true | _ -> false) claims ->
      system.dofs * system.dofs + entries system.stiffness + entries system.mass
    | _ -> n * n + entries pencil.rows_a + entries pencil.rows_b in
  if claims <> [] && size > 1 lsl 22 then
    Problem.not_verified "claims about more than 2,048 variables";
  let total = List.fold_left (fun sum claim -> sum + work_of problem pencil claim) 0 claims in
  if total > 1 lsl 36 then Problem.not_verified "claims beyond the limits of this program"

let rec ascending = function a :: (b :: _ as rest) -> a < b && ascending rest | _ -> true

let in_window (certificate : Certificate.t) (a, b) =
  let lo, hi = certificate.window in
  if Q.lt a lo || (match hi with Some h -> Q.gt b h | None -> false) then
    raise (Rejected "a claim outside the window")

let refuse_unless accepted = if not accepted then raise (Rejected "the kernel refuses a claim")

(* The kernel's claim has the support and the interval of the certificate. *)
let states (claim : Kernel.claim) (e : Certificate.exact) =
  let over p = Q.make p claim.claim_denominator in
  Z.sign claim.claim_denominator > 0
  && Q.equal (over claim.claim_from) (fst e.value) && Q.equal (over claim.claim_to) (snd e.value)
  && claim.support = e.support && claim.biactive = e.biactive

let verify_exact (problem : Problem.t) pencil (e : Certificate.exact) =
  if List.length e.x <> pencil.Kernel.order then raise (Rejected "a claim with too few components");
  let claim = Elaborate.claim_of pencil e in
  refuse_unless (states claim e);
  refuse_unless (match problem.question with
      | Raw pencil -> Kernel.check_claim pencil claim
      | Mechanical (system, unknown) -> Kernel.check_system_claim system unknown claim);
  lazy (Kernel.ExactClaim claim)

let verify_lifted (problem : Problem.t) pencil (l : Certificate.lifted) =
  match problem.question with
  | Raw _ -> raise (Rejected "a lifted solution of a pencil")
  | Mechanical (system, unknown) ->
    if List.length l.motion.x <> system.dofs || List.length l.forces <> system.dofs then
      raise (Rejected "a motion with too few or too many components");
    if List.exists (fun i -> List.mem i l.motion.support) l.motion.biactive then
      raise (Rejected "a biactive variable of the support");
    let factor = Z.divexact problem.common system.unit_length in
    let claim = Elaborate.lifted_of system unknown factor l in
    refuse_unless (states claim.motion_claim l.motion);
    refuse_unless (Kernel.check_lifted system unknown claim);
    lazy (Kernel.ExactClaim (Elaborate.claim_of pencil (Elaborate.exact_of_lifted system l)))

(* The interval of values of a box of a problem with so many free variables. *)
let value_of_box (e : Certificate.enclosed) free_number =
  let active = free_number + List.length e.box_support in
  if e.box_support = [] || not (ascending e.box_support)
  || List.length e.center <> active + 1 || List.length e.radius <> active + 1
  || List.exists (fun r -> Q.sign r <= 0) e.radius then
    raise (Rejected "a box that does not fit the pencil");
  let center = List.nth e.center active and radius = List.nth e.radius active in
  Q.sub center radius, Q.add center radius

(* The interval that is proved lies in that of the claim. *)
let verify_enclosed (problem : Problem.t) pencil (certificate : Certificate.t)
    (e : Certificate.enclosed) =
  if List.exists (fun i -> i >= pencil.Kernel.order || List.mem i pencil.free) e.box_support then
    raise (Rejected "a box that does not fit the pencil");
  let value = value_of_box e (List.length pencil.free) in
  in_window certificate value;
  match Elaborate.enclosed_claim_of pencil e with
  | None -> raise (Elaborate.No_witness "an enclosed solution")
  | Some claim ->
    let low = Problem.value_of claim.box_from and high = Problem.value_of claim.box_to in
    refuse_unless (claim.box_support = e.box_support && Q.geq low (fst value)
                   && Q.leq high (snd value));
    let accepted = match problem.question with
      | Raw pencil -> Kernel.check_enclosed_claim pencil claim
      | Mechanical (system, unknown) -> Kernel.check_system_enclosed system unknown claim in
    if not accepted then raise (Elaborate.No_witness "an enclosed solution");
    claim, (low, high)

let check_root certificate (e : Certificate.exact) =
  in_window certificate e.value;
  if not (ascending e.support && ascending e.biactive) then
    raise (Rejected "a claim whose lists are not ascending")

(* Each claim: its support has a solution with a value in its interval, which is in the window.
   With it comes the same claim about the pencil, for root leaves that refer to it. *)
let verify_claim (problem : Problem.t) pencil (certificate : Certificate.t) claim =
  match claim with
  | Certificate.Exact e ->
    check_root certificate e;
    verify_exact problem pencil e, (e.value, e.support)
  | Lifted l ->
    check_root certificate l.motion;
    verify_lifted problem pencil l, (l.motion.value, l.motion.support)
  | Enclosed e ->
    let claim, value = verify_enclosed problem pencil certificate e in
    lazy (Kernel.BoxClaim claim), (value, e.box_support)

(* The work for a motion of so many degrees of freedom with these polynomials, which are written
   with one denominator. *)
let motion_work dofs (e : Certificate.exact) polynomials =
  let beyond () = Problem.not_verified "a claim beyond the limits of this program" in
  let size = size_of e polynomials in
  let longest = List.fold_left (fun m p -> max m (List.length p)) 0 polynomials in
  let extended common q =
    let common = Z.lcm common (Q.den q) in
    if Z.numbits common > 1 lsl 17 then beyond ();
    common in
  let common = List.fold_left (List.fold_left extended) Z.one polynomials in
  let size = size + (List.length e.polynomial + longest) * Z.numbits common in
  if size > 1 lsl 18 then beyond ();
  2 * dofs * size * size

let limit_motions works =
  if List.fold_left (+) 0 works > 1 lsl 36 then
    Problem.not_verified "claims beyond the limits of this program"

(* An enclosed claim with particles in contact with zero reaction.  The interval that is proved lies
   in that of the claim. *)
let verify_zero_box (certificate : Certificate.t) (zero : Kernel.zero_system) unknown
    (e : Certificate.enclosed) =
  let value = value_of_box e (List.length zero.without_zero.free_dofs) in
  in_window certificate value;
  let refuse () = raise (Elaborate.No_witness "an enclosed solution") in
  match Elaborate.zero_enclosed_of zero unknown e with
  | None -> refuse ()
  | Some claim ->
    let low = Problem.value_of claim.box_from and high = Problem.value_of claim.box_to in
    refuse_unless (Q.geq low (fst value) && Q.leq high (snd value));
    if not (Kernel.check_zero_enclosed zero unknown e.box_support claim) then refuse ();
    (low, high), e.box_support

let verify_plain document certificate_path =
  let problem = Plain.read document in
  let digest, points = Plain.read_points certificate_path in
  if digest <> problem.digest then
    raise (Rejected ("the digest of the problem is " ^ problem.digest));
  if points = [] then raise (Rejected "no point");
  let n = List.length problem.rows in
  if List.exists (fun z -> List.length z <> n) points then
    raise (Rejected "a point of the wrong length");
  Plain.limit_work problem points;
  let accepted = Kernel.check_mcp problem.rows (List.map (Plain.point_of n) points) in
  if not accepted then raise (Rejected "the kernel refuses a point");
  Sentences.points problem.digest;
  0

(* Print the accepted question and its witness as a Coq file instead of the verdict. *)
let as_coq = ref false

let print_coq (problem : Problem.t) elimination tree lo hi found =
  match problem.question with
  | Raw _ -> Problem.not_verified "Coq files are made for mechanical systems"
  | Mechanical (system, unknown) ->
    Coq.print system unknown elimination tree lo hi (List.length found)

(* Does the tree refer to claims? *)
let needs_claims (certificate : Certificate.t) =
  List.exists (fun (p : Certificate.piece) -> List.exists (function
      | Certificate.Root { outcome = Claim _; _ } -> true
      | _ -> false) p.tree) certificate.pieces

(* What is to be verified of a complete set. *)
type question = {
  problem : Problem.t;
  pencil : Kernel.pencil;
  certificate : Certificate.t;
  slip : int array;
  slip_list : int list;
  lo : Kernel.point;
  hi : Kernel.point;
  known_claims : Kernel.solution_claim list }

(* What the kernel says after it has accepted a tree. *)
type cover = {
  yielded : Kernel.yield list;
  families : Kernel.family list;
  still_open : Kernel.region list;
  solutions : Kernel.yield list option Lazy.t;
  print_coq : Kernel.yield list -> unit }

let known q = Array.of_list (Kernel.known_solutions q.pencil q.known_claims)

(* The tree of the certificate.  Support leaves stand beside it, one for each region that the tree
   leaves open, or none where it stays open; a support leaf whose region holds nothing is closed by
   [nothing]. *)
let elaborate q ~leaf ~left_open ~nothing =
  let supports = ref [] in
  let undecided s = supports := s :: !supports; Kernel.Leaf left_open in
  let factor i =
    if List.mem i q.pencil.Kernel.free then q.problem.common else q.problem.slip_common in
  let leaf piece region = function
    | Certificate.Open -> undecided None
    | Support s ->
      (match Supports.support_leaf q.pencil factor region s with
       | Some l -> undecided (Some l)
       | None -> nothing region)
    | node -> leaf piece region node in
  let tree = timed "elaboration" (fun () ->
      Elaborate.build_pieces q.slip leaf q.certificate.window q.certificate.pieces) in
  tree, List.rev !supports

let tree_refused = Rejected "the kernel refuses the tree"
let refuse_tree_unless accepted = if not accepted then raise tree_refused

(* Free rows that do not depend on the unknown: any anchor serves for all pieces. [check] gives the
   claims, the elimination, the tree and the support leaves to the kernel. *)
let constant_cover q eliminate check refuse =
  let certificate = q.certificate and problem = q.problem in
  let anchor = match certificate.pieces with p :: _ -> p.anchor | [] -> 0 in
  let elimination, enclosed = timed "condensation" (fun () ->
      let e = eliminate q.pencil q.slip_list problem.common problem.slip_common
          certificate.condensation anchor in
      e, Kernel.condensed (Kernel.blocks_of q.pencil) e) in
  let context =
    { Elaborate.pencil = q.pencil; slip = q.slip; enclosed;
      doubles = Elaborate.doubles_of enclosed; known = known q;
      weights = Elaborate.row_weights q.pencil problem.common problem.slip_common } in
  let tree, supports =
    elaborate q ~leaf:(fun _ -> Elaborate.build_leaf context) ~left_open:Kernel.Undecided
      ~nothing:(fun region -> Elaborate.build_leaf context region (Farkas [])) in
  if not (timed "kernel" (fun () -> check q.known_claims elimination tree supports)) then
    raise refuse;
  { yielded = Kernel.found q.pencil q.known_claims tree q.lo q.hi;
    families = Kernel.families tree q.lo q.hi supports;
    still_open = Kernel.still_open tree q.lo q.hi supports;
    solutions = lazy (Kernel.all_solutions q.pencil q.known_claims tree q.lo q.hi supports);
    print_coq = print_coq problem elimination tree q.lo q.hi }

let verify_constant q =
  constant_cover q Elaborate.elimination (fun claims elimination tree supports ->
      match q.problem.question with
      | Raw pencil -> Kernel.check_families pencil claims tree q.lo q.hi supports elimination
      | Mechanical (system, unknown) ->
        Kernel.check_system_families system unknown claims elimination tree q.lo q.hi supports)
    tree_refused

(* A window that is one value: the pencil there.  Claims that the tree refers to are to hold of
   it. *)
let verify_point check q =
  let pencil = Kernel.point_pencil q.pencil q.lo in
  let times = Z.mul (snd q.lo) in
  let problem =
    { q.problem with question = Raw pencil; common = times q.problem.common;
                     slip_common = times q.problem.slip_common } in
  let refuse = Elaborate.No_witness "a window that is one value" in
  let known claim =
    try Lazy.force (fst (verify_claim problem pencil q.certificate claim))
    with Rejected _ -> raise refuse in
  let known_claims = if q.known_claims = [] then [] else List.map known q.certificate.claims in
  constant_cover { q with problem; pencil; known_claims }
    (Elaborate.elimination_at (Problem.value_of q.lo) q.pencil) check refuse

let verify_value q =
  verify_point (fun claims elimination tree supports -> match q.problem.question with
      | Raw pencil -> Kernel.check_at_value pencil q.lo claims elimination tree supports
      | Mechanical (system, unknown) ->
        Kernel.check_system_at_value system unknown q.lo claims elimination tree supports) q

(* Condensation about anchors, or leaves that speak of the whole pencil only. *)
let verify_varying q =
  let certificate = q.certificate and problem = q.problem in
  let varying = timed "condensation" (fun () ->
      Elaborate.varying_of q.pencil q.slip_list problem.common problem.slip_common (known q)
        certificate.condensation certificate.pieces) in
  let tree, supports =
    elaborate q ~leaf:(Elaborate.varying_leaf varying) ~left_open:Kernel.LeftOpen
      ~nothing:(Elaborate.whole_of varying "support") in
  let anchoring = varying.anchoring in
  refuse_tree_unless (timed "kernel" (fun () -> match problem.question with
      | Raw pencil ->
        Kernel.check_varying_families pencil q.known_claims anchoring tree q.lo q.hi supports
      | Mechanical (system, unknown) ->
        Kernel.check_system_varying system unknown q.known_claims anchoring tree q.lo q.hi
          supports));
  { yielded = Kernel.varying_found q.pencil q.known_claims tree q.lo q.hi;
    families = Kernel.varying_families tree q.lo q.hi supports;
    still_open = Kernel.varying_still_open tree q.lo q.hi supports;
    solutions = lazy (Kernel.varying_solutions q.pencil q.known_claims tree q.lo q.hi supports);
    print_coq = (fun _ -> Problem.not_verified "as a Coq file: condensation about anchors") }

(* Claims about a system with particles in contact with zero reaction.  Of an exact or lifted claim
   the kernel checks the motion and its forces. *)
let verify_zero_claims (problem : Problem.t) (certificate : Certificate.t)
    (zero : Kernel.zero_system) unknown =
  let system = zero.without_zero in
  let variables = List.length system.free_dofs + List.length system.particles
                  + 3 * List.length zero.zero_particles in
  let factor = Z.divexact problem.common system.unit_length in
  let size = system.dofs * system.dofs + entries system.stiffness + entries system.mass in
  if size > 1 lsl 22 then Problem.not_verified "claims about more than 2,048 variables";
  let work_as_given = function
    | Certificate.Enclosed e -> zero_box_work zero e
    | Exact e ->
      if List.length e.x <> variables then raise (Rejected "a claim with too few components");
      motion_work system.dofs e e.x
    | Lifted l ->
      if List.length l.motion.x <> system.dofs || List.length l.forces <> system.dofs then
        raise (Rejected "a motion with too few or too many components");
      motion_work system.dofs l.motion (l.motion.x @ l.forces) in
  limit_motions (List.map work_as_given certificate.claims);

  let motion = function
    | Certificate.Exact e -> Either.Left (Elaborate.lifted_of_exact zero unknown factor e)
    | Lifted l -> Left l
    | Enclosed e -> Right e in
  let claims = List.map motion certificate.claims in
  limit_motions (List.map (fun (l : Certificate.lifted) ->
      motion_work system.dofs l.motion (l.motion.x @ l.forces))
      (fst (List.partition_map Fun.id claims)));

  let verify_motion (l : Certificate.lifted) =
    check_root certificate l.motion;
    if List.exists (fun i -> List.mem i l.motion.support) l.motion.biactive then
      raise (Rejected "a biactive variable of the support");
    let claim = Elaborate.zero_of zero unknown factor l in
    refuse_unless (states claim.lifted_part.motion_claim l.motion);
    refuse_unless (Kernel.check_zero zero unknown claim);
    l.motion.value, l.motion.support in
  let verify = Either.fold ~left:verify_motion ~right:(verify_zero_box certificate zero unknown) in
  timed "claims" (fun () -> List.map verify claims)

(* A complete set of such a system.  A branch on one half of v_T that moves puts the other half at
   rest; the tree of the kernel has a region more, in which both move.  Beside each region that it
   leaves undecided stands a box, a support leaf, or nothing. *)
let elaborate_zero q (zero : Kernel.zero_system) unknown ~leaf ~left_open ~nothing =
  let beside = ref [] in
  let put item = beside := item :: !beside in
  let undecided item = put item; Kernel.Leaf left_open in
  let gaps = Kernel.gap zero 0 in
  let other_half k (region : Kernel.region) =
    let i = q.slip.(k) - gaps in
    let other = if i < 0 then 0 else match i mod 3 with 1 -> 1 | 2 -> -1 | _ -> 0 in
    if other = 0 || Kernel.state_of region (k + other) = Kernel.Resting then None
    else Some (k + other, fun () -> undecided (None, None)) in
  let factor i =
    if List.mem i q.pencil.Kernel.free then q.problem.common else q.problem.slip_common in
  let leaf piece region = function
    | Certificate.Open -> undecided (None, None)
    | Support s ->
      (match Supports.support_leaf q.pencil factor region s with
       | Some l -> undecided (None, Some l)
       | None -> nothing region)
    | node -> leaf ~put_box:(fun box -> put (Some box, None)) piece region node in
  let tree = timed "elaboration" (fun () ->
      Elaborate.build_pieces ~other_half q.slip leaf q.certificate.window q.certificate.pieces) in
  tree, List.rev !beside

(* A gap and one half of a particle move: the row of the other half vanishes, and a box is asked
   for. *)
let opens q (zero : Kernel.zero_system) (region : Kernel.region) =
  let moves i = Kernel.state_of region (i - q.slip.(0)) = Kernel.Moving in
  let opens = List.exists (fun j ->
      moves (Kernel.gap zero j) && (moves (Kernel.right zero j) || moves (Kernel.left zero j)))
      (List.init (List.length zero.zero_particles) Fun.id) in
  if opens && zero.without_zero.dofs + Array.length q.slip > largest_enclosed then
    Problem.not_verified "a root of more than %d active variables where a particle opens"
      largest_enclosed;
  opens

(* The boxes, and the support leaves of the regions without a box. *)
let boxes_and_supports beside =
  List.map fst beside,
  List.filter_map (function None, s -> Some s | Some _, _ -> None) beside

type zero_cover = {
  zero_yielded : Kernel.yield list;
  zero_found : Kernel.yield list option Lazy.t;
  zero_families : Kernel.family list;
  zero_open : Kernel.region list }

let verify_zero_constant q zero unknown =
  let certificate = q.certificate and problem = q.problem in
  let anchor = match certificate.pieces with p :: _ -> p.anchor | [] -> 0 in
  let elimination, enclosed = timed "condensation" (fun () ->
      let e = Elaborate.elimination q.pencil q.slip_list problem.common problem.slip_common
          certificate.condensation anchor in
      e, Kernel.condensed (Kernel.blocks_of q.pencil) e) in
  let context =
    { Elaborate.pencil = q.pencil; slip = q.slip; enclosed;
      doubles = Elaborate.doubles_of enclosed; known = known q;
      weights = Elaborate.row_weights q.pencil problem.common problem.slip_common } in
  let leaf ~put_box _ region = function
    | Certificate.Root ({ outcome = Solution; _ } as r) when opens q zero region ->
      Elaborate.pinned_box_tree context zero unknown region r put_box
    | node -> Elaborate.build_leaf context region node in
  let tree, beside =
    elaborate_zero q zero unknown ~leaf ~left_open:Kernel.Undecided
      ~nothing:(fun region -> Elaborate.build_leaf context region (Farkas [])) in
  let boxes, supports = boxes_and_supports beside in
  refuse_tree_unless (timed "kernel" (fun () ->
      Kernel.check_zero_complete zero unknown q.known_claims elimination tree q.lo q.hi boxes supports));
  { zero_yielded = Kernel.found q.pencil q.known_claims tree q.lo q.hi;
    zero_found =
      lazy (Kernel.zero_solutions zero unknown q.known_claims tree q.lo q.hi boxes supports);
    zero_families = Kernel.zero_families tree q.lo q.hi boxes supports;
    zero_open = Kernel.zero_still_open zero tree q.lo q.hi boxes supports }

let verify_zero_varying q zero unknown =
  let certificate = q.certificate and problem = q.problem in
  let varying = timed "condensation" (fun () ->
      Elaborate.varying_of q.pencil q.slip_list problem.common problem.slip_common (known q)
        certificate.condensation certificate.pieces) in
  let leaf ~put_box piece region = function
    | Certificate.Root ({ outcome = Solution; _ } as r) when opens q zero region ->
      Elaborate.pinned_about_tree varying piece zero unknown region r put_box
    | node -> Elaborate.varying_leaf varying piece region node in
  let tree, beside =
    elaborate_zero q zero unknown ~leaf ~left_open:Kernel.LeftOpen
      ~nothing:(Elaborate.whole_of varying "support") in
  let boxes, supports = boxes_and_supports beside in
  refuse_tree_unless (timed "kernel" (fun () ->
      Kernel.check_zero_varying zero unknown q.known_claims varying.anchoring tree q.lo q.hi boxes
        supports));
  { zero_yielded = Kernel.varying_found q.pencil q.known_claims tree q.lo q.hi;
    zero_found =
      lazy (Kernel.zero_varying_solutions zero unknown q.known_claims tree q.lo q.hi boxes
              supports);
    zero_families = Kernel.zero_varying_families tree q.lo q.hi boxes supports;
    zero_open = Kernel.zero_varying_open zero tree q.lo q.hi boxes supports }

(* A claim as one of the split pencil, for the root leaves that refer to it. *)
let zero_claim pencil claim =
  let known = match claim with
    | Certificate.Exact e -> Some (Kernel.ExactClaim (Elaborate.claim_of pencil e))
    | Enclosed e ->
      Option.map (fun c -> Kernel.BoxClaim c) (Elaborate.enclosed_claim_of pencil e)
    | Lifted _ ->
      Problem.not_verified "a root leaf beside a lifted claim, with zero reaction" in
  match known with
  | Some known when Kernel.check_solution_claim pencil known -> known
  | _ -> raise (Elaborate.No_witness "a claim of a root, with zero reaction")

let depends_on_value pencil (certificate : Certificate.t) =
  not (Kernel.free_rows_constant pencil)
  || pencil.free <> [] && not (List.exists Elaborate.needs_anchor certificate.pieces)

(* Every other solution may lie in a region that is left open. *)
let exit_code left_open = if left_open = [] then 0 else 3

let limit_yields yielded families =
  if List.length yielded > 10_000 then
    Problem.not_verified "more than 10,000 regions with a solution";
  if List.length families > 10_000 then Problem.not_verified "more than 10,000 families"

let verify_zero (problem : Problem.t) (certificate : Certificate.t) (zero : Kernel.zero_system)
    unknown =
  let shown = verify_zero_claims problem certificate zero unknown in
  let report_claims () = List.iter (Sentences.claim problem) shown in
  if certificate.pieces = [] then begin
    Sentences.claims_only problem certificate.window;
    report_claims ();
    0
  end
  else begin
    let pencil = timed "pencil" (fun () -> Kernel.zero_pencil zero unknown) in
    let slip_list = Kernel.slip pencil in
    let slip = Array.of_list slip_list in
    if Array.length slip > 300 then
      Problem.not_verified "more than 300 complementarity variables";
    let lo = Problem.point_of (fst certificate.window) in
    let hi = Problem.upper_point (snd certificate.window) in
    let known_claims =
      if needs_claims certificate then List.map (zero_claim pencil) certificate.claims else [] in
    let q = { problem; pencil; certificate; slip; slip_list; lo; hi; known_claims } in
    let cover =
      if depends_on_value pencil certificate then verify_zero_varying q zero unknown
      else verify_zero_constant q zero unknown in
    limit_yields cover.zero_yielded cover.zero_families;
    match Lazy.force cover.zero_found with
    | None ->
      Problem.not_verified "regions that may hold the same solution, or a value beside the window"
    | Some found ->
      let families = cover.zero_families and left_open = cover.zero_open in
      Sentences.cover problem certificate.window slip (List.rev found) families left_open;
      report_claims ();
      exit_code left_open
  end

(* The context of a statement about an interval of mu; rejects a problem that has none. *)
let context_of_friction (problem : Problem.t) digest condensation (low, high) tail =
  if digest <> problem.digest then
    raise (Rejected ("the digest of the problem is " ^ problem.digest));
  let zero = match problem.question with
    | Raw _ -> raise (Rejected "a mechanical system was expected")
    | (Mechanical _ | Zero_reaction _) when problem.unknown <> "lambda2" ->
      raise (Rejected "the unknown is not the problem's")
    | Zero_reaction (zero, _) -> zero
    | Mechanical (without_zero, _) -> { Kernel.without_zero; zero_particles = [] } in
  let system = zero.without_zero in
  if Q.sign high <= 0 then raise (Rejected "the interval of friction ends at zero or below");
  if Q.sign low < 0 || Q.geq low high then
    raise (Rejected "the interval of friction is empty, a point, or begins below zero");
  if (condensation <> None) <> (system.free_dofs <> []) then
    raise (Rejected "a condensation is given exactly if there are free variables");

  let slip_list = Kernel.slip (Kernel.part_plain zero) in
  if List.length slip_list > 300 then
    Problem.not_verified "more than 300 complementarity variables";
  let slip_factor = Z.mul problem.common system.unit_length in
  let context =
    { Critical.zero; slip = Array.of_list slip_list; free_factor = problem.common; slip_factor;
      tail; mu_low = Problem.point_of low; mu_high = Problem.point_of high } in
  context, slip_list

(* No solution of a system for mu in [from, below] and lambda^2 >= 0. *)
let verify_critical (problem : Problem.t) (certificate : Certificate.critical) =
  let condensation = certificate.critical_condensation in
  let context, slip_list = context_of_friction problem certificate.critical_digest condensation
      (certificate.at_least, certificate.below)
      (Option.bind condensation (fun c -> c.friction_tail)) in
  let zero = context.zero in
  let plain = Kernel.part_plain zero and friction = Kernel.part_friction zero in
  let pieces = certificate.critical_pieces in
  let without_free_variables () =
    let elimination =
      Some (Critical.trivial_elimination plain friction slip_list context.slip_factor) in
    let parts = timed "condensation" (fun () -> Kernel.condensed_parts zero elimination) in
    let tree = timed "elaboration" (fun () ->
        Critical.build context (Critical.leaf_of_parts context parts) Kernel.BoxHalves pieces) in
    timed "kernel" (fun () ->
        Kernel.check_critical zero elimination tree context.mu_low context.mu_high) in
  let about_anchors condensation =
    let anchored = timed "condensation" (fun () ->
        Critical.anchored_of context plain friction slip_list condensation
          (Critical.anchors_of_boxes pieces)) in
    let tree = timed "elaboration" (fun () ->
        Critical.join
          (Critical.build context (Critical.anchored_leaf context anchored)
             (Kernel.WithoutAnchor Kernel.BoxHalves) pieces)) in
    timed "kernel" (fun () ->
        Kernel.check_anchored_critical zero anchored.anchoring tree context.mu_low
          context.mu_high) in
  refuse_tree_unless (match condensation with
      | None -> without_free_variables ()
      | Some condensation -> about_anchors condensation);
  Sentences.absent problem context.mu_low context.mu_high;
  0

(* A solution of a system with some lambda^2 >= 0 for each mu in [from, to]. *)
let verify_presence (problem : Problem.t) (certificate : Certificate.presence) =
  let context, slip_list = context_of_friction problem certificate.presence_digest
      certificate.presence_condensation (certificate.presence_from, certificate.presence_to) None in
  let zero = context.zero in
  let plain = Kernel.part_plain zero and friction = Kernel.part_friction zero in
  let pieces = certificate.presence_pieces in
  let anchored = timed "condensation" (fun () -> match certificate.presence_condensation with
      | None -> Presence.anchored_without_free context plain friction slip_list
      | Some condensation ->
        Critical.anchored_of context plain friction slip_list condensation
          (Presence.anchors_of_pieces pieces)) in
  let kernel_pieces = timed "elaboration" (fun () -> Presence.build context anchored pieces) in
  refuse_tree_unless (timed "kernel" (fun () ->
      Kernel.check_presence zero anchored.anchoring kernel_pieces context.mu_low
        context.mu_high));
  Sentences.present problem context.mu_low context.mu_high;
  0

let pencil_of (problem : Problem.t) = timed "pencil" (fun () -> match problem.question with
    | Raw pencil -> pencil
    | Mechanical (system, unknown) -> Kernel.pencil_of system unknown
    | Zero_reaction _ -> Problem.not_verified "infinity with zero reaction")

(* Claims and a complete set of a problem with this pencil. *)
let verify_pencil (problem : Problem.t) pencil (certificate : Certificate.t) cover_of say =
  let slip_list = Kernel.slip pencil in
  let slip = Array.of_list slip_list in
  if certificate.pieces <> [] && Array.length slip > 300 then
    Problem.not_verified "more than 300 complementarity variables";
  let lo = Problem.point_of (fst certificate.window) in
  let hi = Problem.upper_point (snd certificate.window) in
  let claims = timed "claims" (fun () ->
      limit_work problem pencil certificate.claims;
      List.map (verify_claim problem pencil certificate) certificate.claims) in
  let report_claims () = List.iter (fun (_, said) -> Sentences.claim problem said) claims in

  if certificate.pieces = [] then begin
    Sentences.claims_only problem certificate.window;
    report_claims ();
    0
  end
  else begin
    (* The kernel is given the claims that the tree refers to, in their places. *)
    let known_claims =
      if needs_claims certificate then List.map (fun (claim, _) -> Lazy.force claim) claims
      else [] in
    let question = { problem; pencil; certificate; slip; slip_list; lo; hi; known_claims } in
    let cover = cover_of question in
    limit_yields cover.yielded cover.families;
    match Lazy.force cover.solutions with
    | None ->
      Problem.not_verified "regions that may hold the same solution, or a value beside the window"
    | Some found when !as_coq -> cover.print_coq found; 0
    | Some found ->
      let families = cover.families and left_open = cover.still_open in
      say slip (List.rev found) families left_open report_claims;
      exit_code left_open
  end

let require_question (problem : Problem.t) (certificate : Certificate.t) =
  if certificate.digest <> problem.digest then
    raise (Rejected ("the digest of the problem is " ^ problem.digest));
  if certificate.unknown <> problem.unknown then
    raise (Rejected "the unknown is not the problem's")

let require_window holds wanted (certificate : Certificate.t) =
  if not holds then
    raise (Rejected (Printf.sprintf "window: expected %s, got %s" wanted
                       (Sentences.show_window certificate.window)))

let verify_complete demanded (problem : Problem.t) (certificate : Certificate.t) =
  require_question problem certificate;
  if certificate.pieces = [] && certificate.claims = [] then raise (Rejected "no claim");
  Option.iter (fun window ->
      require_window (Sentences.covers certificate.window window)
        ("one that covers " ^ Sentences.show_window window) certificate) demanded;
  match problem.question with
  | Zero_reaction (system, unknown) -> verify_zero problem certificate system unknown
  | Raw _ | Mechanical _ ->
    let cover_of q =
      if not (depends_on_value q.pencil certificate) then verify_constant q
      else if q.lo = q.hi then verify_value q
      else verify_varying q in
    verify_pencil problem (pencil_of problem) certificate cover_of
      (fun slip found families left_open report_claims ->
         Sentences.cover problem certificate.window slip found families left_open;
         report_claims ())

(* All solutions at infinity: the certificate is one of the reversed problem, over [0, 0].  The
   kernel forms the reverse of the pencil. *)
let verify_infinity (problem : Problem.t) (certificate : Certificate.t) =
  let pencil = pencil_of problem in
  let reversed = Problem.reversed problem pencil in
  require_question reversed certificate;
  if certificate.pieces = [] then raise (Rejected "no complete set");
  require_window (certificate.window = reversed.window) "[0, 0]" certificate;
  let cover_of = verify_point (Kernel.check_infinity pencil) in
  verify_pencil reversed (pencil_of reversed) certificate cover_of
    (fun slip found families left_open _ ->
       Sentences.at_infinity problem slip found families left_open)

(* a,b with 0 <= a <= b; b may be inf or empty. *)
let window_of text =
  let bad () = Json.malformed "--window: a,b with 0 <= a <= b was expected (b may be inf)" in
  match List.map String.trim (String.split_on_char ',' text) with
  | [a; b] ->
    let lo = Json.rational_of_spelling a in
    let hi = if b = "" || b = "inf" then None else Some (Json.rational_of_spelling b) in
    if Q.sign lo < 0 || (match hi with Some h -> Q.lt h lo | None -> false) then bad ();
    lo, hi
  | _ -> bad ()

(* What is asked of the certificate, beside its problem. *)
type demand = Anything | Window of (Q.t * Q.t option) | Infinity

let refuse_window demanded kind =
  let option = match demanded with
    | Anything -> None
    | Window _ -> Some "--window"
    | Infinity -> Some "--infinity" in
  Option.iter (fun option ->
      Json.malformed "%s: expected it with mceip-certificate/1 only, got %s" option kind) option

let verify_eigenproblem demanded document problem_path certificate_path =
  let problem = timed "problem" (fun () -> Problem.read problem_path document) in
  match timed "certificate" (fun () -> Certificate.read certificate_path) with
  | Complete certificate ->
    (match demanded with
     | Infinity -> verify_infinity problem certificate
     | Window window -> verify_complete (Some window) problem certificate
     | Anything -> verify_complete None problem certificate)
  | Critical certificate ->
    refuse_window demanded "mceip-critical/1";
    verify_critical problem certificate
  | Presence certificate ->
    refuse_window demanded "mceip-presence/1";
    verify_presence problem certificate

let verify demanded problem_path certificate_path =
  Elaborate.start_anew ();
  Supports.work := 0;
  Critical.kept := [];
  let demanded = demanded () in
  let document = Json.read problem_path in
  if Plain.is_plain document then begin
    refuse_window demanded "a plain problem";
    verify_plain document certificate_path
  end
  else verify_eigenproblem demanded document problem_path certificate_path

(* The exit code for a problem and a certificate, after the verdict has been printed. *)
let answer ?(demanded = fun () -> Anything) problem certificate =
  let say code text = print_endline text; code in
  let not_verified what = say 4 ("NOT VERIFIED: " ^ what) in
  try verify demanded problem certificate with
  | Rejected reason -> say 1 ("REJECTED: " ^ reason)
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
  match Sys.argv with
  | [| _; "--lines" |] -> answer_lines ()
  | [| _; "--coq"; problem; certificate |] -> as_coq := true; exit (answer problem certificate)
  | [| _; problem; certificate |] -> exit (answer problem certificate)
  | [| _; problem; certificate; "--window"; window |] ->
    exit (answer ~demanded:(fun () -> Window (window_of window)) problem certificate)
  | [| _; problem; certificate; "--infinity" |] ->
    exit (answer ~demanded:(fun () -> Infinity) problem certificate)
  | _ ->
    prerr_endline "usage: mceip-verified PROBLEM CERTIFICATE [--window a,b | --infinity]"; exit 2
