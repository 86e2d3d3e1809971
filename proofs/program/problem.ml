(* Problems: the file mceip-problem/1, its digest, and the rational problem that the kernel is given
   (Rational.v). Trusted. *)

open Json

(* What the kernel has no theorem for. *)
exception Not_verified of string

let not_verified fmt = Printf.ksprintf (fun text -> raise (Not_verified text)) fmt

type matrix = { rows : int; cols : int; entries : (int * Q.t) list array }

type t = {
  unknown : string;
  friction : Q.t option;  (* where the unknown is lambda2 and the problem is a system *)
  window : Q.t option * Q.t option;  (* without an end where it is infinite *)
  digest : string;
  given : Kernel.problem }

let matrix_of_table rows cols table =
  { rows; cols;
    entries = Array.map (fun row ->
        List.sort compare (List.filter (fun (_, v) -> Q.sign v <> 0)
          (Hashtbl.fold (fun j v rest -> (j, v) :: rest) row []))) table }

let read_dense item =
  let lines = List.map list (list item) in
  let rows = List.length lines in
  let cols = match lines with [] -> 0 | line :: _ -> List.length line in
  let table = Array.init rows (fun _ -> Hashtbl.create 16) in
  List.iteri (fun i line ->
      if List.length line <> cols then malformed "a matrix with lines of different lengths";
      List.iteri (fun j v -> Hashtbl.replace table.(i) j (rational v)) line) lines;
  matrix_of_table rows cols table

let read_sparse field symmetric =
  let rows = counter (field "rows") and cols = counter (field "cols") in
  if rows < 0 || cols < 0 || rows > 1_000_000 || cols > 1_000_000 then malformed "a matrix size";
  let table = Array.init rows (fun _ -> Hashtbl.create 16) in
  let put i j v =
    if Hashtbl.mem table.(i) j then malformed "a matrix entry is given twice";
    Hashtbl.replace table.(i) j v in
  List.iter (fun item ->
      match list item with
      | [i; j; v] ->
        let i = index rows i and j = index cols j and v = rational v in
        put i j v;
        if symmetric && i <> j then begin
          if i >= cols || j >= rows then malformed "a symmetric matrix is not square";
          put j i v
        end
      | _ -> malformed "an entry is [i, j, v]") (list (field "entries"));
  matrix_of_table rows cols table

let read_market folder name =
  let file = Market.read folder name in
  let table = Array.init file.rows (fun _ -> Hashtbl.create 16) in
  let put i j v =
    if Hashtbl.mem table.(i) j then malformed "a matrix entry is given twice";
    Hashtbl.replace table.(i) j v in
  List.iter (fun (i, j, v) ->
      put i j v;
      if file.symmetric && i <> j then put j i v) file.entries;
  matrix_of_table file.rows file.cols table

(* Each entry rounded to the nearest double. *)
let as_doubles m =
  let round row =
    List.filter (fun (_, v) -> Q.sign v <> 0)
      (List.map (fun (j, v) -> (j, Market.nearest_double v)) row) in
  { m with entries = Array.map round m.entries }

let read_matrix folder = function
  | List _ as item -> read_dense item
  | Object members as item ->
    let field = fields []
        ["dense"; "rows"; "cols"; "entries"; "matrix_market"; "symmetric"; "read_as"] item in
    let reading = match field "read_as" with
      | Null | String "exact" -> Fun.id
      | String "f64" -> as_doubles
      | _ -> malformed "read_as" in
    let symmetric = match List.assoc_opt "symmetric" members with
      | None -> false
      | Some (Bool b) -> b
      | Some _ -> malformed "symmetric" in
    let given = List.filter (fun key -> field key <> Null)
        ["dense"; "rows"; "cols"; "entries"; "matrix_market"] in
    reading (match given with
        | ["dense"] when not symmetric -> read_dense (field "dense")
        | ["rows"; "cols"; "entries"] -> read_sparse field symmetric
        | ["matrix_market"] when not symmetric -> read_market folder (text (field "matrix_market"))
        | _ -> malformed "one way to give a matrix was expected")
  | _ -> malformed "a matrix was expected"

(* Values as fractions of integers, as the kernel has them. *)
let point_of q = Q.num q, Q.den q
let upper_point = function Some q -> point_of q | None -> Kernel.infinity
let value_of (p, q) = Q.make p q

(* Of an eigenvalue problem the window may begin below 0, or have no beginning. *)
let read_window ~eigenvalue item =
  let field = if item = Null then fun _ -> Null else fields [] ["min"; "max"] item in
  let end_of key = match field key with Null -> None | v -> Some (rational v) in
  let lo = end_of "min" and hi = end_of "max" in
  let first = Option.value lo ~default:Q.zero in
  let ends_below q = Option.fold hi ~none:false ~some:(fun h -> Q.lt h q) in
  if ends_below first || ends_below Q.zero || (Q.sign first < 0 && not eigenvalue) then
    malformed "%s" (if eigenvalue then "min <= max, 0 <= max" else "0 <= min <= max");
  (if eigenvalue then lo else Some first), hi

(* The lines of a matrix as one text. *)
let canonical_matrix name m =
  let entries = List.concat (List.mapi (fun i row ->
      List.map (fun (j, v) -> Printf.sprintf "%d %d %s" i j (Q.to_string v)) row)
      (Array.to_list m.entries)) in
  [String.concat "\n" (Printf.sprintf "%s %d %d" name m.rows m.cols :: entries)]

let digest_of lines = Sha256.hex (String.concat "" (List.map (fun line -> line ^ "\n") lines))

let canonical unknown lines = ["mceip-canonical/1"; "unknown " ^ unknown] @ lines

let pencil_lines ?c free a b =
  ["pencil"; String.concat " " ("free" :: List.map string_of_int free)]
  @ canonical_matrix "a" a @ canonical_matrix "b" b
  @ (match c with Some c -> canonical_matrix "c" c | None -> [])

let rational_rows m =
  List.map (List.map (fun (j, v) -> j, point_of v)) (Array.to_list m.entries)

let read_pencil folder unknown item =
  let field = fields ["a"; "b"] ["free"; "c"] item in
  let a = read_matrix folder (field "a") and b = read_matrix folder (field "b") in
  let c = match field "c" with Null -> None | c -> Some (read_matrix folder c) in
  let n = a.rows in
  if n = 0 || List.exists (fun m -> m.rows <> n || m.cols <> n) (a :: b :: Option.to_list c) then
    malformed "a, b and c must be square, of one order";
  let free = List.map (index n) (list_or_none "free" item) in
  let sorted = List.sort_uniq compare free in
  if List.length sorted < List.length free then malformed "an index of free twice";
  if unknown = "eigenvalue" && free <> [] then malformed "free: no index for eigenvalue";
  let given_a = rational_rows a and given_b = rational_rows b in
  let pencil = { Kernel.given_order = n; given_a; given_b; given_free = sorted } in
  let given = match c with
    | Some c when unknown = "eigenvalue" ->
      Kernel.GivenQuadratic { quadratic_order = n; quadratic_a = given_a; quadratic_b = given_b;
                              quadratic_c = rational_rows c }
    | Some _ -> malformed "c: expected it with the unknown eigenvalue only, got %s" unknown
    | None when unknown = "eigenvalue" -> GivenEigenvalue pencil
    | None -> GivenPencil pencil in
  pencil_lines ?c sorted a b, given, None

let plain_frame = (Q.one, Q.zero), (Q.zero, Q.one)

let read_frame item =
  match List.map (fun row -> List.map rational (list row)) (list item) with
  | [[a; b]; [c; d]] ->
    let unit = Q.add (Q.mul a a) (Q.mul b b) in
    if not (Q.equal a d && Q.equal b (Q.neg c) && Q.equal unit Q.one) then
      malformed "a frame that is no rotation";
    (a, b), (c, d)
  | _ -> malformed "a frame has two rows of two numbers"

let planar (a, b) = point_of a, point_of b

let unit_of what = function
  | Null -> None
  | v ->
    (match counter v with
     | 1 -> Some 1
     | -1 -> Some (-1)
     | _ -> malformed "%s is 1 or -1" what)

let directions = ["normal_direction"; "frame"; "friction_factor"; "name"]

(* A particle in this state, with the word whether it has a frame, which the digest shows. *)
let read_directions order field contact_of =
  (match field "name" with Null -> () | v -> ignore (text v));
  let friction_factor = match field "friction_factor" with Null -> Q.one | v -> rational v in
  if Q.sign friction_factor <= 0 then malformed "friction_factor must be positive";
  let t = index order (field "tangential") and n = index order (field "normal") in
  let into = Option.value (unit_of "normal_direction" (field "normal_direction")) ~default:1 in
  let framed = field "frame" <> Null in
  let tangent, normal = if framed then read_frame (field "frame") else plain_frame in
  framed, { Kernel.first_of = t; second_of = n; contact_of; frame_tangent = planar tangent;
            frame_normal = planar normal; into_obstacle = Z.of_int into;
            factor_of = point_of friction_factor }

let describe_particle (framed, (p : Kernel.given_particle)) =
  let components sign (a, b) =
    List.map (fun (d, c) -> Printf.sprintf " %d %s" d (Q.to_string c))
      (List.filter (fun (_, c) -> framed || Q.sign c <> 0)
         (List.map (fun (d, c) -> d, Q.mul (Q.of_bigint sign) (value_of c))
            [p.first_of, a; p.second_of, b])) in
  let state = match p.contact_of with
    | NotInContact -> "free"
    | Sticking -> "stick"
    | Slipping (sign, _) -> "slip " ^ Z.to_string sign
    | ZeroInContact -> "zero" in
  let factor = value_of p.factor_of in
  [ Printf.sprintf "particle %d %d %s" p.first_of p.second_of state;
    String.concat "" ("tangent" :: components Z.one p.frame_tangent);
    String.concat "" ("normal" :: components p.into_obstacle p.frame_normal) ]
  @ (if Q.equal factor Q.one then [] else ["friction_factor " ^ Q.to_string factor])

(* The geometric stiffness of a particle, curvature times normal reaction. *)
let read_curvature state reaction = function
  | Null -> Q.zero
  | curvature ->
    let field = fields ["value"; "normal_reaction"] [] curvature in
    let value = rational (field "value") in
    let normal = rational (field "normal_reaction") in
    Demands.check_curvature state normal reaction;
    Q.mul value normal

let read_particle order mu item =
  let field =
    fields ["tangential"; "normal"; "state"]
      ("sign" :: "reaction" :: "friction_factor_range" :: "curvature" :: directions) item in
  let state = text (field "state") in
  let sign = unit_of "sign" (field "sign") in
  if (sign <> None) <> (state = "slip") then malformed "sign: exactly for slip";
  let sign = Option.value sign ~default:0 in
  let geometric = read_curvature state (field "reaction") (field "curvature") in
  let contact = match state with
    | "free" -> Kernel.NotInContact
    | "stick" -> Sticking
    | "slip" -> Slipping (Z.of_int sign, point_of geometric)
    | "zero" -> ZeroInContact
    | _ -> malformed "the state %S" state in
  let framed, particle = read_directions order field contact in
  let factor = value_of particle.factor_of in
  (match field "reaction" with
   | Null -> ()
   | v -> Demands.check_reaction (Option.map (Q.mul factor) mu) state sign v);
  let text = describe_particle (framed, particle) in
  let bent = if Q.sign geometric = 0 then []
    else ["geometric_stiffness " ^ Q.to_string geometric] in
  (* Members have factors between both ends; the particle has their mean. *)
  match field "friction_factor_range" with
  | Null -> (text @ bent, particle), None
  | ends ->
    (match List.map rational (list ends) with
     | [lo; hi] when Q.sign lo >= 0 && Q.lt lo hi && Q.leq lo factor && Q.leq factor hi ->
       let mean = Q.div (Q.add lo hi) (Q.of_int 2) in
       let range = Printf.sprintf "friction_factor_range %s %s" (Q.to_string lo) (Q.to_string hi) in
       (text @ [range] @ bent, { particle with factor_of = point_of mean }), Some (lo, hi)
     | _ -> malformed "friction_factor_range: 0 <= lo < hi, the factor between")

(* Stiffness, mass and friction. *)
let read_body folder field =
  let k = read_matrix folder (field "stiffness") in
  let m = match field "mass" with Null -> None | v -> Some (read_matrix folder v) in
  let mu = match field "friction" with Null -> None | v -> Some (rational v) in
  (match mu with Some q when Q.sign q <= 0 -> malformed "friction must be positive" | _ -> ());
  List.iter (fun x ->
      if x.rows <> k.rows || not (Demands.symmetric x.rows x.cols x.entries) then
        malformed "stiffness and mass must be symmetric, of one order") (k :: Option.to_list m);
  k, m, mu

let body_lines particles k m =
  List.concat particles @ canonical_matrix "stiffness" k
  @ (match m with Some m -> canonical_matrix "mass" m | None -> [])

(* The radius of a matrix; entries that are 0 are left out. *)
let read_radius folder matrix item =
  let each f = { matrix with entries = Array.map (fun row ->
      List.filter (fun (_, r) -> Q.sign r <> 0) (List.map (fun (j, v) -> j, f v) row))
      matrix.entries } in
  let radius = match item with
    | Null -> each (fun _ -> Q.zero)
    | Object ["absolute", r] -> let r = rational r in each (fun _ -> r)
    | Object ["relative", r] -> let r = rational r in each (fun v -> Q.mul r (Q.abs v))
    | Object ["matrix", given] -> read_matrix folder given
    | _ -> malformed "a radius is absolute, relative or a matrix" in
  if radius.rows <> matrix.rows || not (Demands.symmetric radius.rows radius.cols radius.entries)
  || Array.exists (List.exists (fun (_, r) -> Q.sign r < 0)) radius.entries then
    malformed "a radius that is not symmetric, of another order or negative";
  radius

let some_radius m = Array.exists (fun row -> row <> []) m.entries

let radius_lines name m = if some_radius m then canonical_matrix name m else []

let read_system folder unknown item =
  let field = fields ["stiffness"; "particles"] ["mass"; "friction"; "radii"] item in
  let k, m, mu = read_body folder field in
  let radii = match field "radii" with
    | Null -> fun _ -> Null
    | given -> fields [] ["stiffness"; "mass"] given in
  let radius_k = read_radius folder k (radii "stiffness") in
  let radius_m = match m with
    | Some m -> read_radius folder m (radii "mass")
    | None when radii "mass" = Null -> { k with entries = [||] }
    | None -> malformed "a radius of a mass that is not given" in
  if unknown = "lambda2" && (m = None || mu = None) then
    malformed "lambda2 needs mass and friction";

  let particles, ranges =
    List.split (List.map (read_particle k.rows mu) (list (field "particles"))) in
  let given_particles = List.map snd particles in
  Demands.apart (List.concat_map (fun (p : Kernel.given_particle) -> [p.first_of; p.second_of])
                   given_particles);
  if not (List.exists Kernel.slips given_particles) then malformed "no slip particle";

  let text =
    ["system"] @ (match mu with Some q -> ["friction " ^ Q.to_string q] | None -> [])
    @ body_lines (List.map fst particles) k m
    @ radius_lines "stiffness_radius" radius_k @ radius_lines "mass_radius" radius_m in

  let system =
    { Kernel.degrees = k.rows; given_stiffness = rational_rows k;
      given_mass = (match m with Some m -> rational_rows m | None -> []);
      given_particles } in
  let exact = not (some_radius radius_k || some_radius radius_m)
              && List.for_all (fun range -> range = None) ranges in
  if not exact && List.exists Kernel.zeroes given_particles then
    malformed "radii beside a particle in state zero";
  let curved = not (Kernel.flat_body system) in
  if curved && unknown = "mu" then malformed "the unknown mu of a curved system";
  if curved && not exact then malformed "radii or friction_factor_range of a curved system";
  let members () =
    let ends (p : Kernel.given_particle) = function
      | Some (lo, hi) -> point_of lo, point_of hi
      | None -> p.factor_of, p.factor_of in
    let slipping = List.filter (fun (p, _) -> Kernel.slips p)
        (List.combine given_particles ranges) in
    { Kernel.radii_of_stiffness = rational_rows radius_k;
      radii_of_mass = rational_rows radius_m;
      factor_ranges = List.map (fun (p, range) -> ends p range) slipping } in
  match unknown, mu with
  | _ when not exact ->
    let friction = if unknown = "lambda2" then mu else None in
    text, Kernel.GivenMembers (system, members ()), friction
  | "lambda2", Some q -> text, Kernel.GivenSystem (system, Lambda2 (Q.num q, Q.den q)), mu
  | _ -> text, GivenSystem (system, Mu), None

let read path document =
  if not (has_format "mceip-problem/1" document) then
    malformed "format: mceip-problem/1 was expected";
  let field = fields ["format"; "unknown"]
      ["window"; "pencil"; "system"; "name"; "comment"; "coordinates"; "warnings"]
      document in
  List.iter (fun key -> match field key with
      | Null -> () | v -> ignore (text v)) ["name"; "comment"];
  let unknown = text (field "unknown") in
  let eigenvalue = unknown = "eigenvalue" in
  if unknown <> "lambda2" && unknown <> "mu" && not eigenvalue then
    malformed "unknown is lambda2, mu or eigenvalue";
  let window = read_window ~eigenvalue (field "window") in
  let folder = Filename.dirname path in
  let lines, given, friction = match field "pencil", field "system" with
    | pencil, Null when pencil <> Null -> read_pencil folder unknown pencil
    | Null, system when system <> Null && not eigenvalue -> read_system folder unknown system
    | _ -> malformed "exactly one of pencil and system; a pencil for eigenvalue" in
  let digest = digest_of (canonical unknown lines) in
  { unknown; friction; window; digest; given }
