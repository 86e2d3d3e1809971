(* Evidence for the kernel, from a problem and its certificate.

   What is demanded of a certificate and is no part of a statement is checked here: the digest, the
   unknown, claims in the window.  The kernel refuses evidence that proves nothing, so this file is
   not trusted. *)

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

let work_of (pencil : Kernel.pencil) = function
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

let limit_work (problem : Scaling.t) pencil claims =
  let n = pencil.Kernel.order in
  let size = match problem.question with
    | Kernel.SystemProblem (system, _) when
        List.exists (function Certificate.Lifted _ -> true | _ -> false) claims ->
      system.dofs * system.dofs + entries system.stiffness + entries system.mass
    | _ -> n * n + entries pencil.rows_a + entries pencil.rows_b in
  if claims <> [] && size > 1 lsl 22 then
    Problem.not_verified "claims about more than 2,048 variables";
  let total = List.fold_left (fun sum claim -> sum + work_of pencil claim) 0 claims in
  if total > 1 lsl 36 then Problem.not_verified "claims beyond the limits of this program"

let rec ascending = function a :: (b :: _ as rest) -> a < b && ascending rest | _ -> true

let in_window (certificate : Certificate.t) (a, b) =
  let lo, hi = certificate.window in
  if Q.lt a lo || (match hi with Some h -> Q.gt b h | None -> false) then
    raise (Rejected "a claim outside the window")

let no_witness what = Elaborate.No_witness what

(* A refusal of the part for values below 0. *)
let of_negative = function
  | Rejected reason -> Rejected ("negative: " ^ reason)
  | other -> other

(* The verdict where the kernel refuses evidence. *)
let rec refusal (evidence : Kernel.evidence) (answer : Kernel.answered) =
  match evidence, answer with
  | _, NotToldApart ->
    Problem.Not_verified "regions that may hold the same solution, or a value beside the window"
  | ClaimsIn (_, _, claims), ClaimRefused k ->
    (match List.nth claims k with
     | OfPencil (BoxClaim _) | OfZeroBox _ -> no_witness "an enclosed solution"
     | _ -> Rejected "the kernel refuses a claim")
  | (CoverOf (_, _, CoverAtValue _) | CoverAtInfinity _), _ ->
    no_witness "a window that is one value"
  | ClaimsIn _, _ -> Rejected "the kernel refuses a claim"
  | Points _, _ -> Rejected "the kernel refuses a point"
  | Equilibrium (_, _, _, BoxAround _), _ -> no_witness "an equilibrium in a box"
  | Equilibrium _, _ -> Rejected "the kernel refuses the equilibrium"
  | Stable _, _ -> Rejected "the kernel refuses the evidence of stability"
  | Reflected part, _ -> of_negative (refusal part answer)
  | _ -> Rejected "the kernel refuses the tree"

let window_of (certificate : Certificate.t) =
  Problem.point_of (fst certificate.window), Problem.upper_point (snd certificate.window)

(* Of each claim: its evidence, and the same claim about the pencil, for root leaves that refer to
   it. *)

let exact_evidence (pencil : Kernel.pencil) (e : Certificate.exact) =
  if List.length e.x <> pencil.order then raise (Rejected "a claim with too few components");
  let claim = Kernel.ExactClaim (Elaborate.claim_of pencil e) in
  Kernel.OfPencil claim, lazy claim

let fits_motion dofs (l : Certificate.lifted) =
  if List.length l.motion.x <> dofs || List.length l.forces <> dofs then
    raise (Rejected "a motion with too few or too many components")

let not_twice (l : Certificate.lifted) =
  if List.exists (fun i -> List.mem i l.motion.support) l.motion.biactive then
    raise (Rejected "a biactive variable of the support")

let lifted_evidence (problem : Scaling.t) pencil (l : Certificate.lifted) =
  match problem.question with
  | Kernel.SystemProblem (system, unknown) ->
    fits_motion system.dofs l;
    not_twice l;
    let factor = Z.divexact problem.common system.unit_length in
    let zero = { Kernel.without_zero = system; zero_particles = [] } in
    Kernel.OfMotion (Elaborate.zero_of zero unknown factor l),
    lazy (Kernel.ExactClaim (Elaborate.claim_of pencil (Elaborate.exact_of_lifted system l)))
  | _ -> raise (Rejected "a lifted solution of a pencil")

(* The interval of values of a box of a problem with so many free variables. *)
let value_of_box (e : Certificate.enclosed) free_number =
  let active = free_number + List.length e.box_support in
  if e.box_support = [] || not (ascending e.box_support)
  || List.length e.center <> active + 1 || List.length e.radius <> active + 1
  || List.exists (fun r -> Q.sign r <= 0) e.radius then
    raise (Rejected "a box that does not fit the pencil");
  let center = List.nth e.center active and radius = List.nth e.radius active in
  Q.sub center radius, Q.add center radius

(* The interval that is proved has to lie in that of the claim. *)
let box_of value = function
  | None -> raise (no_witness "an enclosed solution")
  | Some (claim : Kernel.enclosed_claim) ->
    let low = Problem.value_of claim.box_from and high = Problem.value_of claim.box_to in
    if not (Q.geq low (fst value) && Q.leq high (snd value)) then
      raise (Rejected "the kernel refuses a claim");
    claim

let enclosed_evidence pencil (certificate : Certificate.t) (e : Certificate.enclosed) =
  if List.exists (fun i -> i >= pencil.Kernel.order || List.mem i pencil.free) e.box_support then
    raise (Rejected "a box that does not fit the pencil");
  let value = value_of_box e (List.length pencil.free) in
  in_window certificate value;
  let claim = Kernel.BoxClaim (box_of value (Elaborate.enclosed_claim_of pencil e)) in
  Kernel.OfPencil claim, lazy claim

let check_root certificate (e : Certificate.exact) =
  in_window certificate e.value;
  if not (ascending e.support && ascending e.biactive) then
    raise (Rejected "a claim whose lists are not ascending")

let claim_evidence problem pencil certificate = function
  | Certificate.Exact e ->
    check_root certificate e;
    exact_evidence pencil e
  | Lifted l ->
    check_root certificate l.motion;
    lifted_evidence problem pencil l
  | Enclosed e -> enclosed_evidence pencil certificate e

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

(* An enclosed claim with particles in contact with zero reaction. *)
let zero_box (certificate : Certificate.t) (zero : Kernel.zero_system) unknown
    (e : Certificate.enclosed) =
  let value = value_of_box e (List.length zero.without_zero.free_dofs) in
  in_window certificate value;
  Kernel.OfZeroBox (box_of value (Elaborate.zero_enclosed_of zero unknown e))

(* The points of an mceip-mcp-solution/1 (spec/certificates.md, 5.17). *)
let read_points path =
  let open Json in
  let document = Json.read path in
  (match document with
   | Object members when List.assoc_opt "format" members = Some (String "mceip-mcp-solution/1") ->
     ()
   | _ -> malformed "format: mceip-mcp-solution/1 was expected");
  let field = fields ["format"; "problem_sha256"; "z"] [] document in
  let digest = text (field "problem_sha256") in
  digest, List.map (fun point -> List.map rational (list point)) (list (field "z"))

(* A point with one denominator, within the limits of 5.17. *)
let point_of n z =
  let limit = min (1 lsl 19) ((1 lsl 24) / max n 1) in
  let common = List.fold_left (fun c v ->
      if Z.numbits c > limit then c else Z.lcm c (Q.den v)) Z.one z in
  if Z.numbits common > limit then Problem.not_verified "a point beyond the limits";
  let numerators = List.map (fun v -> Z.mul (Q.num v) (Z.divexact common (Q.den v))) z in
  let longest = List.fold_left (fun m v -> max m (Z.numbits v)) 0 numerators in
  if Z.numbits common + longest > limit then Problem.not_verified "a point beyond the limits";
  { Kernel.numerators; denominator = common }

(* The kernel finds an entry of z in as many steps as its index. *)
let limit_points problem points =
  let n = List.length problem in
  let entries = List.fold_left (fun e (r : Kernel.rational_mcp_row) -> e + List.length r.given_m) n
      problem in
  if List.length points * entries * n > 1 lsl 30 then
    Problem.not_verified "a plain problem beyond the limits of this program"

let plain (problem : Plain.t) certificate_path =
  let digest, points = read_points certificate_path in
  if digest <> problem.digest then
    raise (Rejected ("the digest of the problem is " ^ problem.digest));
  if points = [] then raise (Rejected "no point");
  let n = List.length problem.rows in
  if List.exists (fun z -> List.length z <> n) points then
    raise (Rejected "a point of the wrong length");
  limit_points problem.rows points;
  Kernel.Points (List.map (point_of n) points)

(* A claim as one of this pencil. *)
let known_claim pencil = function
  | Certificate.Exact e -> Some (Kernel.ExactClaim (Elaborate.claim_of pencil e))
  | Enclosed e ->
    Option.map (fun c -> Kernel.BoxClaim c) (Elaborate.enclosed_claim_of pencil e)
  | Lifted _ -> None

(* Does the tree refer to claims? *)
let needs_claims (certificate : Certificate.t) =
  List.exists (fun (p : Certificate.piece) -> List.exists (function
      | Certificate.Root { outcome = Claim _; _ } -> true
      | _ -> false) p.tree) certificate.pieces

(* What is to be verified of a complete set. *)
type question = {
  problem : Scaling.t;
  pencil : Kernel.pencil;
  certificate : Certificate.t;
  slip : int array;
  slip_list : int list;
  lo : Kernel.point;
  hi : Kernel.point;
  known_claims : Kernel.solution_claim list }

let limit_yields ?boxes q cover supports =
  let undecided = match boxes with
    | Some boxes -> Kernel.zero_undecided cover q.lo q.hi boxes
    | None -> Kernel.regions_open cover q.lo q.hi in
  if List.length (Kernel.regions_found q.pencil q.known_claims cover q.lo q.hi) > 10_000 then
    Problem.not_verified "more than 10,000 regions with a solution";
  if List.length (Kernel.families_of undecided supports) > 10_000 then
    Problem.not_verified "more than 10,000 families"

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

(* Free rows that do not depend on the unknown: any anchor serves for all pieces. *)
let eliminated q eliminate =
  let certificate = q.certificate and problem = q.problem in
  let anchor = match certificate.pieces with p :: _ -> p.anchor | [] -> 0 in
  eliminate q.pencil q.slip_list problem.common problem.slip_common certificate.condensation anchor

let enclosed_by q elimination = Kernel.condensed (Kernel.blocks_of q.pencil) elimination

let condense q eliminate =
  let problem = q.problem in
  let elimination, enclosed = timed "condensation" (fun () ->
      let e = eliminated q eliminate in
      e, enclosed_by q e) in
  let context =
    { Elaborate.pencil = q.pencil; slip = q.slip; enclosed;
      doubles = Elaborate.doubles_of enclosed; known = known q;
      weights = Elaborate.row_weights q.pencil problem.common problem.slip_common } in
  elimination, context

let constant_cover q eliminate =
  let elimination, context = condense q eliminate in
  let tree, supports =
    elaborate q ~leaf:(fun _ -> Elaborate.build_leaf context) ~left_open:Kernel.Undecided
      ~nothing:(fun _ -> Kernel.Leaf (Kernel.Farkas [])) in
  let cover = Kernel.Eliminated (elimination, tree) in
  limit_yields q cover supports;
  cover, supports

let of_constant q =
  let cover, supports = constant_cover q Elaborate.elimination in
  Kernel.CoverOf (q.lo, q.hi, CoverInWindow (q.known_claims, cover, [], supports))

(* A window that is one value: the pencil there.  Claims that the tree refers to are to hold of
   it. *)

let at_value q =
  let pencil = Kernel.point_pencil q.pencil q.lo in
  let times = Z.mul (snd q.lo) in
  let problem =
    { q.problem with question = PencilProblem pencil; common = times q.problem.common;
                     slip_common = times q.problem.slip_common } in
  let known claim = match known_claim pencil claim with
    | Some known -> known
    | None -> raise (no_witness "a window that is one value") in
  let known_claims = if q.known_claims = [] then [] else List.map known q.certificate.claims in
  let cover, supports =
    constant_cover { q with problem; pencil; known_claims }
      (Elaborate.elimination_at (Problem.value_of q.lo) q.pencil) in
  known_claims, cover, supports

let of_value q =
  let claims, cover, supports = at_value q in
  Kernel.CoverOf (q.lo, q.hi, CoverAtValue (claims, cover, supports))

(* Condensation about anchors, or leaves that speak of the whole pencil only. *)
let condense_about q =
  let certificate = q.certificate and problem = q.problem in
  timed "condensation" (fun () ->
      Elaborate.varying_of q.pencil q.slip_list problem.common problem.slip_common (known q)
        certificate.condensation certificate.pieces)

let of_varying q =
  let varying = condense_about q in
  let tree, supports =
    elaborate q ~leaf:(Elaborate.varying_leaf varying) ~left_open:Kernel.LeftOpen
      ~nothing:(Elaborate.whole_of varying "support") in
  let cover = Kernel.Anchored (varying.anchoring, tree) in
  limit_yields q cover supports;
  Kernel.CoverOf (q.lo, q.hi, CoverInWindow (q.known_claims, cover, [], supports))

(* Claims about a system with particles in contact with zero reaction.  Of an exact or lifted claim
   the kernel checks the motion and its forces. *)
let zero_claims (problem : Scaling.t) (certificate : Certificate.t) (zero : Kernel.zero_system)
    unknown =
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
      fits_motion system.dofs l;
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

  let of_motion (l : Certificate.lifted) =
    check_root certificate l.motion;
    not_twice l;
    Kernel.OfMotion (Elaborate.zero_of zero unknown factor l) in
  List.map (Either.fold ~left:of_motion ~right:(zero_box certificate zero unknown)) claims

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
let zero_cover q cover beside =
  let boxes = List.map fst beside in
  let supports = List.filter_map (function None, s -> Some s | Some _, _ -> None) beside in
  limit_yields ~boxes q cover supports;
  Kernel.CoverOf (q.lo, q.hi, CoverInWindow (q.known_claims, cover, boxes, supports))

let of_zero_constant q zero unknown =
  let elimination, context = condense q Elaborate.elimination in
  let leaf ~put_box _ region = function
    | Certificate.Root ({ outcome = Solution; _ } as r) when opens q zero region ->
      Elaborate.pinned_box_tree context zero unknown region r put_box
    | node -> Elaborate.build_leaf context region node in
  let tree, beside =
    elaborate_zero q zero unknown ~leaf ~left_open:Kernel.Undecided
      ~nothing:(fun _ -> Kernel.Leaf (Kernel.Farkas [])) in
  zero_cover q (Eliminated (elimination, tree)) beside

let of_zero_varying q zero unknown =
  let varying = condense_about q in
  let leaf ~put_box piece region = function
    | Certificate.Root ({ outcome = Solution; _ } as r) when opens q zero region ->
      Elaborate.pinned_about_tree varying piece zero unknown region r put_box
    | node -> Elaborate.varying_leaf varying piece region node in
  let tree, beside =
    elaborate_zero q zero unknown ~leaf ~left_open:Kernel.LeftOpen
      ~nothing:(Elaborate.whole_of varying "support") in
  zero_cover q (Anchored (varying.anchoring, tree)) beside

(* A claim as one of the split pencil, for the root leaves that refer to it. *)
let zero_claim pencil claim =
  (match claim with
   | Certificate.Lifted _ ->
     Problem.not_verified "a root leaf beside a lifted claim, with zero reaction"
   | _ -> ());
  match known_claim pencil claim with
  | Some known when Kernel.check_solution_claim pencil known -> known
  | _ -> raise (no_witness "a claim of a root, with zero reaction")

let depends_on_value pencil (certificate : Certificate.t) =
  not (Kernel.free_rows_constant pencil)
  || pencil.free <> [] && not (List.exists Elaborate.needs_anchor certificate.pieces)

let question_of problem pencil certificate known_claims =
  let slip_list = Kernel.slip pencil in
  let slip = Array.of_list slip_list in
  if Array.length slip > 300 then
    Problem.not_verified "more than 300 complementarity variables";
  let lo, hi = window_of certificate in
  { problem; pencil; certificate; slip; slip_list; lo; hi; known_claims }

(* What makes the evidence of the claims and of the cover, where there are some. *)
type parts = { of_claims : (unit -> Kernel.evidence) option;
               of_cover : (unit -> Kernel.evidence) option }

let list_of parts = List.filter_map Fun.id [parts.of_claims; parts.of_cover]

let parts (certificate : Certificate.t) claims cover =
  let claims () = timed "claims" (fun () ->
      let lo, hi = window_of certificate in
      Kernel.ClaimsIn (lo, hi, claims ())) in
  { of_claims = if certificate.claims = [] then None else Some claims;
    of_cover = if certificate.pieces = [] then None else Some cover }

let zero_parts (problem : Scaling.t) (certificate : Certificate.t) zero unknown =
  let cover () =
    let pencil = timed "pencil" (fun () -> Kernel.zero_pencil zero unknown) in
    let q = question_of problem pencil certificate
        (if needs_claims certificate then List.map (zero_claim pencil) certificate.claims
         else []) in
    if depends_on_value pencil certificate then of_zero_varying q zero unknown
    else of_zero_constant q zero unknown in
  parts certificate (fun () -> zero_claims problem certificate zero unknown) cover

(* Radii are refused by name directly after the digest. *)
let require_one_body (problem : Scaling.t) digest =
  if digest = problem.digest && problem.members <> None then
    raise (Rejected "radii: this kind of certificate speaks of one body")

(* The context of a statement about an interval of mu; rejects a problem that has none. *)
let context_of_friction (problem : Scaling.t) digest condensation (low, high) tail =
  if digest <> problem.digest then
    raise (Rejected ("the digest of the problem is " ^ problem.digest));
  let zero = match problem.question, Kernel.zero_system_of problem.question with
    | _, Some zero -> zero
    | (SystemProblem _ | ZeroProblem _), None ->
      raise (Rejected "the unknown is not the problem's")
    | _ -> raise (Rejected "a mechanical system was expected") in
  let system = zero.without_zero in
  if not (Kernel.flat system) then
    raise (Rejected "curved: this kind of certificate speaks of flat obstacles");
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
    { Critical.zero; radii = Option.map (fun (m : Scaling.members) -> m.radii) problem.members;
      slip = Array.of_list slip_list; free_factor = problem.common; slip_factor;
      tail; mu_low = Problem.point_of low; mu_high = Problem.point_of high } in
  context, slip_list

(* No solution of a system for mu in [from, below] and lambda^2 >= 0. *)
let absence (problem : Scaling.t) (certificate : Certificate.critical) () =
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
    Kernel.ByElimination (elimination, tree) in
  let about_anchors condensation =
    let anchored = timed "condensation" (fun () ->
        Critical.anchored_of context plain friction slip_list condensation
          (Critical.anchors_of_boxes pieces)) in
    let tree = timed "elaboration" (fun () ->
        Critical.join
          (Critical.build context (Critical.anchored_leaf context anchored)
             (Kernel.WithoutAnchor Kernel.BoxHalves) pieces)) in
    Kernel.ByAnchors (anchored.anchoring, tree) in
  let of_members (members : Scaling.members) =
    let build leaf =
      timed "elaboration" (fun () ->
          Critical.join
            (Critical.build context leaf (Kernel.WithoutAnchor Kernel.BoxHalves) pieces)) in
    let anchoring, tree = match condensation with
      | None ->
        let parts = Critical.exact_parts context members.radii Z.zero in
        let scales = Critical.common_scales plain friction slip_list context.slip_factor in
        Critical.nothing_bounded [], build (Critical.member_leaf_without_free context parts scales)
      | Some condensation ->
        let anchored = timed "condensation" (fun () ->
            Critical.anchored_of context plain friction slip_list condensation
              (Critical.anchors_of_boxes pieces)) in
        anchored.anchoring, build (Critical.anchored_leaf context anchored) in
    Kernel.MembersAbsence (context.mu_low, context.mu_high, members.shares, members.share_unit,
                           anchoring, tree) in
  match problem.members, condensation with
  | Some members, _ -> of_members members
  | None, None -> Kernel.Absence (context.mu_low, context.mu_high, without_free_variables ())
  | None, Some condensation ->
    Kernel.Absence (context.mu_low, context.mu_high, about_anchors condensation)

(* A solution of a system with some lambda^2 >= 0 for each mu in [from, to]. *)
let presence (problem : Scaling.t) (certificate : Certificate.presence) () =
  let context, slip_list = context_of_friction problem certificate.presence_digest
      certificate.presence_condensation (certificate.presence_from, certificate.presence_to) None in
  let zero = context.zero in
  let plain = Kernel.part_plain zero and friction = Kernel.part_friction zero in
  let pieces = certificate.presence_pieces in
  let anchored = timed "condensation" (fun () -> match certificate.presence_condensation with
      | None -> Critical.anchored_without_free context plain friction slip_list
      | Some condensation ->
        Critical.anchored_of context plain friction slip_list condensation
          (Presence.anchors_of_pieces pieces)) in
  let kernel_pieces = timed "elaboration" (fun () -> Presence.build context anchored pieces) in
  match problem.members with
  | None -> Kernel.Presence (context.mu_low, context.mu_high, anchored.anchoring, kernel_pieces)
  | Some members ->
    Kernel.MembersPresence (context.mu_low, context.mu_high, members.shares, members.share_unit,
                            anchored.anchoring, kernel_pieces)

(* What shows that an equilibrium is stable for mu in [from, to]. *)
let stability (problem : Scaling.t) (certificate : Certificate.stability) () =
  require_one_body problem certificate.stable_digest;
  let context, _ = context_of_friction problem certificate.stable_digest
      certificate.stable_condensation (certificate.stable_from, certificate.stable_to) None in
  if context.zero.zero_particles <> [] then raise (Rejected "a particle in state zero");
  if Q.sign certificate.stable_mass_sigma <= 0 then raise (Rejected "mass_sigma is not positive");
  let positive (c : Certificate.stability_condensation) =
    if Q.sign c.stable_sigma <= 0 then raise (Rejected "sigma is not positive") in
  Option.iter positive certificate.stable_condensation;
  if certificate.stable_mass_factor = None
  && not (Stability.diagonal_mass context.zero.without_zero) then
    raise (Rejected "a mass that is not diagonal needs mass_factor");
  timed "elaboration" (fun () ->
      Stability.build context.zero.without_zero problem.common certificate)

let pencil_of (problem : Scaling.t) =
  timed "pencil" (fun () -> Kernel.pencil_of_integral problem.question)

(* The claims and the cover of a problem without particles of zero reaction. *)
let pencil_parts (problem : Scaling.t) (certificate : Certificate.t) cover_of =
  let pencil = pencil_of problem in
  if certificate.pieces <> [] && List.length (Kernel.slip pencil) > 300 then
    Problem.not_verified "more than 300 complementarity variables";
  let claims = lazy (
    limit_work problem pencil certificate.claims;
    List.map (claim_evidence problem pencil certificate) certificate.claims) in
  (* The kernel is given the claims that the tree refers to, in their places. *)
  let cover () =
    cover_of (question_of problem pencil certificate
                (if needs_claims certificate then
                   List.map (fun (_, known) -> Lazy.force known) (Lazy.force claims)
                 else [])) in
  parts certificate (fun () -> List.map fst (Lazy.force claims)) cover

let require_question (problem : Scaling.t) (certificate : Certificate.t) =
  if certificate.digest <> problem.digest then
    raise (Rejected ("the digest of the problem is " ^ problem.digest));
  if certificate.unknown <> problem.unknown then
    raise (Rejected "the unknown is not the problem's")

(* The windows of the certificate of which [Sentences.windows] will speak. *)
let windows (certificate : Certificate.t) =
  let sides = List.map (fun c -> Sentences.Below, c) (Option.to_list certificate.negative)
              @ [Above, certificate] in
  let has_cover (_, (c : Certificate.t)) = c.pieces <> [] in
  let has_claims (_, (c : Certificate.t)) = c.claims <> [] in
  let said = if List.exists has_cover sides then List.filter has_cover sides
    else List.filter has_claims sides in
  Sentences.join (List.map (fun (side, (c : Certificate.t)) ->
      Sentences.on_side side c.window) said)

let require_window holds wanted certificate =
  if not holds then
    raise (Rejected (Printf.sprintf "window: expected %s, got %s" wanted
                       (String.concat " and "
                          (List.map Sentences.show_window (windows certificate)))))

let start_anew () =
  Elaborate.start_anew ();
  Supports.work := 0;
  Critical.kept := []

(* Of an eigenvalue problem: each part has limits of its own.  Covers of both parts that begin at 0
   become one statement. *)
let of_both_signs (above : parts) (below : parts) ~meet =
  let anew make () = start_anew (); make () in
  let anew_below make () = try anew make () with refused -> raise (of_negative refused) in
  let each above below =
    List.map anew (Option.to_list above)
    @ List.map (fun make () -> Kernel.Reflected (anew_below make ())) (Option.to_list below) in
  each above.of_claims below.of_claims
  @ (match above.of_cover, below.of_cover with
      | Some cover, Some cover_below when meet ->
        [fun () ->
           let part = anew cover () in
           Kernel.OfBothSigns (anew_below cover_below (), part)]
      | cover, cover_below -> each cover cover_below)

(* The parts of the evidence, each as a function that makes it. *)
let complete (problem : Scaling.t) (certificate : Certificate.t) =
  require_one_body problem certificate.digest;
  require_question problem certificate;
  if windows certificate = [] then raise (Rejected "no claim");
  let cover_of q =
    if not (depends_on_value q.pencil certificate) then of_constant q
    else if q.lo = q.hi then of_value q
    else of_varying q in
  match problem.question, certificate.negative with
  | ZeroProblem (zero, unknown), _ -> list_of (zero_parts problem certificate zero unknown)
  | _, None -> list_of (pencil_parts problem certificate cover_of)
  | _, Some negative ->
    let begins_at_zero (c : Certificate.t) = Q.sign (fst c.window) = 0 in
    of_both_signs (pencil_parts problem certificate cover_of)
      (pencil_parts (Scaling.reflected problem) negative cover_of)
      ~meet:(begins_at_zero certificate && begins_at_zero negative)

(* Where the leaves of a cover say that T(mu) is positive definite, for a body with friction and
   without particles of zero reaction: a factor at both ends of the window. *)
let rates (problem : Scaling.t) (certificate : Certificate.t) =
  let is_definite (p : Certificate.piece) = match p.tree with
    | [Definite Identity] | [Ldl] -> true
    | [Definite (Weighted d)] -> List.for_all (fun w -> Z.sign w > 0) d
    | _ -> false in
  match problem.question with
  | SystemProblem (_, Mu) when certificate.pieces <> [] && Q.sign (fst certificate.window) > 0
                               && List.for_all is_definite certificate.pieces ->
    let q = question_of problem (pencil_of problem) certificate [] in
    let elimination = eliminated q Elaborate.elimination in
    let scale = elimination.Kernel.row_scale in
    (* Positive weights are factors of rows.  The rows of `ldl` are not scaled. *)
    let factors (p : Certificate.piece) = match p.tree with
      | [Definite (Weighted d)] ->
        List.map2 Z.mul scale (Elaborate.one_for_each (List.length scale) d)
      | [Ldl] -> List.map (fun _ -> Z.one) scale
      | _ -> scale in
    let by row_scale =
      let elimination = { elimination with Kernel.row_scale } in
      Option.map (fun ends -> Kernel.DefiniteRates (q.lo, q.hi, elimination, ends))
        (Elaborate.signed_ends (enclosed_by q elimination) q.lo q.hi) in
    List.find_map by (List.sort_uniq compare (List.map factors certificate.pieces))
  | _ -> None

(* All solutions at infinity: the certificate is one of the reversed problem, over [0, 0].  Claims
   are about this problem. *)
let infinity (problem : Scaling.t) (certificate : Certificate.t) =
  if problem.members <> None then
    raise (Rejected "radii: this kind of certificate speaks of one body");
  (match problem.question with
   | ZeroProblem _ -> Problem.not_verified "infinity with zero reaction"
   | _ -> ());
  if problem.unknown = "eigenvalue" then
    Problem.not_verified "infinity with the unknown eigenvalue";
  let reversed = Scaling.reversed problem (pencil_of problem) in
  require_question reversed certificate;
  if certificate.pieces = [] then raise (Rejected "no complete set");
  require_window (certificate.window = (Q.zero, Some Q.zero)) "[0, 0]" certificate;
  let cover_of q =
    let claims, cover, supports = at_value q in
    Kernel.CoverAtInfinity (claims, cover, supports) in
  let prove_claims make =
    let evidence = make () in
    match Kernel.integral_answer reversed.question evidence with
    | Proved _ -> ()
    | answer -> raise (refusal evidence answer) in
  match pencil_parts reversed certificate cover_of with
  | { of_claims = Some claims; of_cover = Some cover } ->
    [fun () -> prove_claims claims; cover ()]
  | parts -> list_of parts
