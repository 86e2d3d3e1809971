(* Problems: the file mceip-problem/1, its digest, and the integers given to the kernel. Trusted.

   A pencil is given to the kernel with all entries multiplied by one positive integer; a system
   with K and M multiplied by one positive integer.  Solutions do not change. *)

open Json

(* What the kernel has no theorem for. *)
exception Not_verified of string

let not_verified fmt = Printf.ksprintf (fun text -> raise (Not_verified text)) fmt

type matrix = { rows : int; cols : int; entries : (int * Q.t) list array }

type t = {
  unknown : string;
  friction : Q.t option;  (* where the unknown is lambda2 and the problem is a system *)
  window : Q.t * Q.t option;
  digest : string;
  question : Kernel.problem;
  common : Z.t;  (* the factor of the entries; for a system, of those of the free rows *)
  slip_common : Z.t }  (* the factor of the entries of the complementarity rows *)

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

let read_window item =
  match item with
  | Null -> Q.zero, None
  | _ ->
    let field = fields [] ["min"; "max"] item in
    let lo = match field "min" with Null -> Q.zero | v -> rational v in
    let hi = match field "max" with Null -> None | v -> Some (rational v) in
    if Q.lt lo Q.zero || (match hi with Some h -> Q.lt h lo | None -> false) then
      malformed "0 <= min <= max";
    lo, hi

(* The lines of a matrix as one text. *)
let canonical_matrix name m =
  let entries = List.concat (List.mapi (fun i row ->
      List.map (fun (j, v) -> Printf.sprintf "%d %d %s" i j (Q.to_string v)) row)
      (Array.to_list m.entries)) in
  [String.concat "\n" (Printf.sprintf "%s %d %d" name m.rows m.cols :: entries)]

let digest_of lines = Sha256.hex (String.concat "" (List.map (fun line -> line ^ "\n") lines))

let canonical unknown lines = ["mceip-canonical/1"; "unknown " ^ unknown] @ lines

let pencil_lines free a b =
  ["pencil"; String.concat " " ("free" :: List.map string_of_int free)]
  @ canonical_matrix "a" a @ canonical_matrix "b" b

let common_denominator matrices =
  List.fold_left (fun d m ->
      Array.fold_left (fun d row ->
          List.fold_left (fun d (_, v) -> Z.lcm d (Q.den v)) d row) d m.entries) Z.one matrices

let integer_rows common m =
  List.map (List.map (fun (j, v) -> (j, Q.num (Q.mul v (Q.of_bigint common)))))
    (Array.to_list m.entries)

let read_pencil folder item =
  let field = fields ["a"; "b"] ["free"] item in
  let a = read_matrix folder (field "a") and b = read_matrix folder (field "b") in
  let n = a.rows in
  if n = 0 || a.cols <> n || b.rows <> n || b.cols <> n then
    malformed "a and b must be square, of one order";
  let free = match List.assoc_opt "free" (match item with Object m -> m | _ -> []) with
    | None -> []
    | Some items -> List.map (index n) (list items) in
  let sorted = List.sort_uniq compare free in
  if List.length sorted < List.length free then malformed "an index of free twice";
  let common = common_denominator [a; b] in
  let text = pencil_lines sorted a b in
  let pencil = { Kernel.order = n; rows_a = integer_rows common a;
                 rows_b = integer_rows common b; free = sorted } in
  text, Kernel.PencilProblem pencil, None, common, common

let symmetric m =
  m.rows = m.cols &&
  (let table = Array.map (fun row -> Hashtbl.of_seq (List.to_seq row)) m.entries in
   let same = ref true in
   Array.iteri (fun i row ->
       List.iter (fun (j, v) ->
           match Hashtbl.find_opt table.(j) i with
           | Some w when Q.equal v w -> ()
           | _ -> same := false) row) m.entries;
   !same)

(* The tangent and the normal into the obstacle over the degrees of freedom t and n. *)
type particle = {
  t : int;
  n : int;
  state : string;
  sign : int;
  tangent : Q.t * Q.t;
  normal : Q.t * Q.t;
  framed : bool;
  friction_factor : Q.t }

let plain_frame = (Q.one, Q.zero), (Q.zero, Q.one)

let read_frame item =
  match List.map (fun row -> List.map rational (list row)) (list item) with
  | [[a; b]; [c; d]] ->
    let unit = Q.add (Q.mul a a) (Q.mul b b) in
    if not (Q.equal a d && Q.equal b (Q.neg c) && Q.equal unit Q.one) then
      malformed "a frame that is no rotation";
    (a, b), (c, d)
  | _ -> malformed "a frame has two rows of two numbers"

(* Reactions, where given, must agree with (7), the state and the sign. *)
let check_reaction mu state sign item =
  let field = fields ["normal"; "tangential"] [] item in
  let rn = rational (field "normal") and rt = rational (field "tangential") in
  let bound = Option.map (fun mu -> Q.neg (Q.mul mu rn)) mu in
  let bad = match state with
    | "free" | "zero" -> Q.sign rn <> 0 || Q.sign rt <> 0
    | "slip" -> Q.sign rn >= 0 || Q.sign rt * sign <= 0 ||
                (match bound with Some b -> not (Q.equal (Q.abs rt) b) | None -> false)
    | _ -> Q.sign rn >= 0 || (match bound with Some b -> Q.geq (Q.abs rt) b | None -> false) in
  if bad then malformed "a reaction against (7), the state or the sign"

let read_particle order mu item =
  let field = fields ["tangential"; "normal"; "state"]
      ["sign"; "normal_direction"; "frame"; "friction_factor"; "reaction"] item in
  let friction_factor = match field "friction_factor" with Null -> Q.one | v -> rational v in
  if Q.sign friction_factor <= 0 then malformed "friction_factor must be positive";
  let mu = Option.map (Q.mul friction_factor) mu in
  let t = index order (field "tangential") and n = index order (field "normal") in
  let state = text (field "state") in
  if not (List.mem state ["free"; "stick"; "slip"; "zero"]) then malformed "the state %S" state;
  let unit_of what = function
    | Null -> None
    | v ->
      (match counter v with
       | 1 -> Some 1
       | -1 -> Some (-1)
       | _ -> malformed "%s is 1 or -1" what) in
  let sign = unit_of "sign" (field "sign") in
  if (sign <> None) <> (state = "slip") then malformed "sign: exactly for slip";
  let sign = Option.value sign ~default:0 in
  let into = Option.value (unit_of "normal_direction" (field "normal_direction")) ~default:1 in
  let framed = field "frame" <> Null in
  let tangent, (first, second) = if framed then read_frame (field "frame") else plain_frame in
  (match field "reaction" with Null -> () | v -> check_reaction mu state sign v);
  let normal = Q.mul (Q.of_int into) first, Q.mul (Q.of_int into) second in
  { t; n; state; sign; tangent; normal; framed; friction_factor }

let describe_particle p =
  let components (a, b) =
    List.map (fun (d, c) -> Printf.sprintf " %d %s" d (Q.to_string c))
      (List.filter (fun (_, c) -> p.framed || Q.sign c <> 0) [p.t, a; p.n, b]) in
  [ Printf.sprintf "particle %d %d %s%s" p.t p.n p.state
      (if p.state = "slip" then " " ^ string_of_int p.sign else "");
    String.concat "" ("tangent" :: components p.tangent);
    String.concat "" ("normal" :: components p.normal) ]
  @ (if Q.equal p.friction_factor Q.one then []
     else ["friction_factor " ^ Q.to_string p.friction_factor])

let read_system folder unknown item =
  let field = fields ["stiffness"; "particles"] ["mass"; "friction"] item in
  let k = read_matrix folder (field "stiffness") in
  let m = match field "mass" with Null -> None | v -> Some (read_matrix folder v) in
  let mu = match field "friction" with Null -> None | v -> Some (rational v) in
  (match mu with Some q when Q.sign q <= 0 -> malformed "friction must be positive" | _ -> ());
  let matrices = k :: Option.to_list m in
  List.iter (fun x ->
      if x.rows <> k.rows || not (symmetric x) then
        malformed "stiffness and mass must be symmetric, of one order") matrices;
  if unknown = "lambda2" && (m = None || mu = None) then
    malformed "lambda2 needs mass and friction";

  let particles = List.map (read_particle k.rows mu) (list (field "particles")) in
  let dofs = List.concat_map (fun p -> [p.t; p.n]) particles in
  if List.length (List.sort_uniq compare dofs) < List.length dofs then
    malformed "a degree of freedom in two particles";
  let slips = List.filter (fun p -> p.state = "slip") particles in
  let zeros = List.filter (fun p -> p.state = "zero") particles in
  if slips = [] then malformed "no slip particle";
  let held = Hashtbl.create 64 in
  List.iter (fun p ->
      if p.state <> "free" then begin
        Hashtbl.replace held p.t ();
        Hashtbl.replace held p.n ()
      end) particles;
  let free = List.filter (fun d -> not (Hashtbl.mem held d)) (List.init k.rows Fun.id) in

  let text =
    ["system"] @ (match mu with Some q -> ["friction " ^ Q.to_string q] | None -> [])
    @ List.concat_map describe_particle particles @ canonical_matrix "stiffness" k
    @ (match m with Some m -> canonical_matrix "mass" m | None -> []) in

  let common = common_denominator matrices in
  let friction_normal p = Q.mul p.friction_factor (fst p.normal),
                          Q.mul p.friction_factor (snd p.normal) in
  let unit_length = List.fold_left (fun l p ->
      let normal = friction_normal p in
      List.fold_left (fun l c -> Z.lcm l (Q.den c)) l
        [fst p.tangent; snd p.tangent; fst normal; snd normal]) Z.one (slips @ zeros) in
  let planar (a, b) =
    let integer c = Q.num (Q.mul c (Q.of_bigint unit_length)) in
    integer a, integer b in
  let kernel_particle p =
    { Kernel.first_dof = p.t; second_dof = p.n; tangent = planar p.tangent;
      normal = planar (friction_normal p); sign_of = Z.of_int p.sign } in
  let system = {
    Kernel.dofs = k.rows;
    stiffness = integer_rows common k;
    mass = (match m with Some m -> integer_rows common m | None -> []);
    free_dofs = free;
    particles = List.map kernel_particle slips;
    unit_length } in
  let kind, friction = match unknown, mu with
    | "lambda2", Some q -> Kernel.Lambda2 (Q.num q, Q.den q), Q.den q
    | _ -> Kernel.Mu, Z.one in
  let free_common = Z.mul common unit_length in
  let question =
    if zeros = [] then Kernel.SystemProblem (system, kind)
    else ZeroProblem ({ Kernel.without_zero = system;
                          zero_particles = List.map kernel_particle zeros }, kind) in
  let friction_given = if unknown = "lambda2" then mu else None in
  text, question, friction_given, free_common, Z.mul free_common (Z.mul unit_length friction)

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
    matrix_of_table pencil.order pencil.order table in
  let lines = pencil_lines pencil.free (matrix reverse.rows_a) (matrix reverse.rows_b) in
  { problem with digest = digest_of (canonical problem.unknown lines); question = PencilProblem reverse;
                 friction = None; window = Q.zero, Some Q.zero }

let read path document =
  (match document with
   | Object members ->
     (match List.assoc_opt "format" members with
      | Some (String "mceip-problem/1") -> ()
      | _ -> malformed "format: mceip-problem/1 was expected")
   | _ -> malformed "an object was expected");
  let field = fields ["format"; "unknown"]
      ["window"; "pencil"; "system"; "name"; "comment"; "coordinates"; "warnings"]
      document in
  List.iter (fun key -> match field key with
      | Null -> () | v -> ignore (text v)) ["name"; "comment"];
  let unknown = text (field "unknown") in
  if unknown <> "lambda2" && unknown <> "mu" then malformed "unknown is lambda2 or mu";
  let window = read_window (field "window") in
  let folder = Filename.dirname path in
  let lines, question, friction, common, slip_common = match field "pencil", field "system" with
    | pencil, Null when pencil <> Null -> read_pencil folder pencil
    | Null, system when system <> Null -> read_system folder unknown system
    | _ -> malformed "exactly one of pencil and system" in
  let digest = digest_of (canonical unknown lines) in
  { unknown; friction; window; digest; question; common; slip_common }
