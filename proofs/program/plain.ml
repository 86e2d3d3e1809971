(* Plain mixed complementarity problems, mceip-mcp/1, and the points of an mceip-mcp-solution/1
   (spec/certificates.md, 5.17; spec/formats.md). Trusted.

   The kernel gets M and q multiplied by one positive integer, and each point with one common
   denominator. *)

open Json

type t = { digest : string; rows : Kernel.mcp }

let is_plain = function
  | Object members -> List.assoc_opt "format" members = Some (String "mceip-mcp/1")
  | _ -> false

(* n bounds, null for an absent one; a list that is left out means [absent] for each. *)
let read_bounds n absent = function
  | Null -> List.init n (fun _ -> absent)
  | item -> List.map (function Null -> None | v -> Some (rational v)) (list item)

let spelling = function None -> "-" | Some v -> Q.to_string v

let read document =
  let field = fields ["format"; "m"; "q"] ["name"; "comment"; "lower"; "upper"] document in
  List.iter (fun key -> match field key with
      | Null -> () | v -> ignore (text v)) ["name"; "comment"];
  let m = List.map (fun row -> List.map rational (list row)) (list (field "m")) in
  let q = List.map rational (list (field "q")) in
  let n = List.length q in
  let lower = read_bounds n (Some Q.zero) (field "lower") in
  let upper = read_bounds n None (field "upper") in
  if List.exists (fun row -> List.length row <> n) m
  || List.exists (fun length -> length <> n) [List.length m; List.length lower; List.length upper]
  then malformed "m, q, lower and upper must have one length";
  List.iter2 (fun l u -> match l, u with
      | Some l, Some u when Q.gt l u -> malformed "a lower bound above the upper one"
      | _ -> ()) lower upper;

  let rec combine m q l u = match m, q, l, u with
    | m :: ms, q :: qs, l :: ls, u :: us -> (m, q, l, u) :: combine ms qs ls us
    | _ -> [] in
  let rows = combine m q lower upper in
  let line (m, q, l, u) =
    String.concat " " [String.concat " " (List.map Q.to_string m); Q.to_string q; spelling l;
                       spelling u] in
  let lines = "mceip-mcp-canonical/1" :: string_of_int n :: List.map line rows in
  let digest = Sha256.hex (String.concat "" (List.map (fun line -> line ^ "\n") lines)) in

  let common_of = List.fold_left (fun c v -> Z.lcm c (Q.den v)) in
  let common = List.fold_left common_of Z.one (q :: m) in
  let integer v = Q.num (Q.mul v (Q.of_bigint common)) in
  let bound = Option.map (fun v -> Q.num v, Q.den v) in
  let sparse row =
    List.filter (fun (_, v) -> Z.sign v <> 0) (List.mapi (fun j v -> j, integer v) row) in
  { digest;
    rows = List.map (fun (m, q, l, u) ->
        { Kernel.row_m = sparse m; row_q = integer q; lower_bound = bound l;
          upper_bound = bound u }) rows }

let read_points path =
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
let limit_work problem points =
  let n = List.length problem.rows in
  let entries = List.fold_left (fun e (r : Kernel.mcp_row) -> e + List.length r.row_m) n
      problem.rows in
  if List.length points * entries * n > 1 lsl 30 then
    Problem.not_verified "a plain problem beyond the limits of this program"
