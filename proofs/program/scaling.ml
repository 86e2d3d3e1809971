(* The positive integers that make a problem integral, and the integral problem that the kernel
   forms with them (Rational.v).

   A wrong choice is refused by the kernel, so this file is not trusted. *)

(* The integral radii; of each slip particle its share, over one unit. *)
type members = { radii : Kernel.part_radii; shares : Z.t list; share_unit : Z.t }

type t = {
  unknown : string;
  digest : string;
  scales : Kernel.scales;
  question : Kernel.integral;  (* of an eigenvalue problem, for its values t >= 0 *)
  below : Kernel.integral option;  (* of one for its values t <= 0, -t in place of t *)
  members : members option;  (* of a body with radii; the question is then about the middle *)
  common : Z.t;  (* the factor of the entries; for a system, of those of the free rows *)
  slip_common : Z.t }  (* the factor of the entries of the complementarity rows *)

let denominator = List.fold_left (fun common q -> Z.lcm common (Q.den (Problem.value_of q)))

let of_rows = List.fold_left (fun common row -> denominator common (List.map snd row))

let scaled scales given =
  match Kernel.scaled scales given with
  | Some question -> question
  | None -> invalid_arg "factors that do not make the problem integral"

(* (hi - lo) / (hi + lo) *)
let share (lo, hi) =
  let lo = Problem.value_of lo and hi = Problem.value_of hi in
  Q.div (Q.sub hi lo) (Q.add hi lo)

let members_of scales question (radii : Kernel.rational_radii) =
  let exact = List.map share radii.factor_ranges in
  let share_unit = List.fold_left (fun common q -> Z.lcm common (Q.den q)) Z.one exact in
  let shares = List.map (fun q -> Z.mul (Q.num q) (Z.divexact share_unit (Q.den q))) exact in
  match question with
  | Kernel.SystemProblem (system, _) ->
    let scaled = Kernel.scaled_radii scales radii shares share_unit in
    { radii = Kernel.radii_of_parts system scaled; shares; share_unit }
  | _ -> invalid_arg "radii of another problem"

(* The geometric stiffness g, and (1 + c^2 mu^2) g in the row that is multiplied by the denominator
   of mu (System.v, turns_exactly). *)
let curvature_of unknown (p : Kernel.given_particle) =
  let geometric = Problem.value_of (Kernel.geometric_of p) in
  let turning = match unknown with
    | Kernel.Mu -> Q.zero
    | Lambda2 (m, q) ->
      let slope = Q.mul (Problem.value_of p.factor_of) (Q.make m q) in
      Q.mul (Q.of_bigint q) (Q.mul (Q.add Q.one (Q.mul slope slope)) geometric) in
  List.map Problem.point_of [geometric; turning]

let of_problem (problem : Problem.t) =
  let given, radii, more = match problem.given with
    | GivenMembers (s, radii) ->
      let unknown = match problem.friction with
        | Some q -> Kernel.Lambda2 (Q.num q, Q.den q)
        | None -> Mu in
      Kernel.GivenSystem (s, unknown), Some radii, radii.radii_of_stiffness @ radii.radii_of_mass
    | given -> given, None, [] in
  let given, below = match Kernel.signed_pencils given with
    | Some (above, below) -> Kernel.GivenPencil above, Some (Kernel.GivenPencil below)
    | None -> given, None in
  let scales, friction = match given with
    | GivenPencil p ->
      { Kernel.entry_scale = of_rows (of_rows Z.one p.given_a) p.given_b;
        length_scale = Z.one }, Z.one
    | GivenSystem (s, unknown) ->
      let planar common (a, b) = denominator common [a; b] in
      let length common (p : Kernel.given_particle) =
        planar (planar common p.frame_tangent) (Kernel.long_normal p) in
      let curvatures = List.concat_map (curvature_of unknown) (Kernel.slipping s) in
      { entry_scale =
          denominator (of_rows (of_rows (of_rows Z.one s.given_stiffness) s.given_mass) more)
            curvatures;
        length_scale = List.fold_left length Z.one (Kernel.slipping s @ Kernel.with_zero s) },
      (match unknown with Mu -> Z.one | Lambda2 (_, q) -> q)
    | GivenEigenvalue _ | GivenQuadratic _ | GivenMembers _ | GivenPlain _ | GivenLoads _ ->
      invalid_arg "no eigenproblem" in
  let length = scales.length_scale in
  let common = Z.mul scales.entry_scale length in
  let question = scaled scales given in
  { unknown = problem.unknown; digest = problem.digest; scales; question;
    below = Option.map (scaled scales) below;
    members = Option.map (members_of scales question) radii; common;
    slip_common = Z.mul common (Z.mul length friction) }

let of_plain rows =
  let row common (r : Kernel.rational_mcp_row) =
    denominator common (r.given_q :: List.map snd r.given_m) in
  { Kernel.entry_scale = List.fold_left row Z.one rows; length_scale = Z.one }

(* The reversed problem (certificates.md, 5.15, Infinity) of one with this pencil. *)
let reversed problem (pencil : Kernel.pencil) =
  let reverse = Kernel.reverse_pencil pencil in
  let matrix rows =
    let table = Array.init pencil.order (fun _ -> Hashtbl.create 16) in
    List.iteri (fun i row ->
        let factor = if List.mem i pencil.free then problem.common else problem.slip_common in
        List.iter (fun (j, v) ->
            let sum = Option.value (Hashtbl.find_opt table.(i) j) ~default:Q.zero in
            Hashtbl.replace table.(i) j (Q.add sum (Q.make v factor))) row) rows;
    Problem.matrix_of_table pencil.order pencil.order table in
  let lines =
    Problem.pencil_lines pencil.free (matrix reverse.rows_a) (matrix reverse.rows_b) in
  { problem with digest = Problem.(digest_of (canonical problem.unknown lines));
                 question = PencilProblem reverse }

(* The reflected problem (certificates.md, 5.2, Values below 0) of an eigenvalue problem. *)
let reflected problem = match problem.below with
  | Some question -> { problem with question }
  | None -> invalid_arg "values below 0 of a system"
