(* Plain mixed complementarity problems, mceip-mcp/1 (spec/formats.md). Trusted. *)

open Json

type t = { digest : string; rows : Kernel.rational_mcp_row list }

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

  let bound = Option.map Problem.point_of in
  let sparse row =
    List.filter (fun (_, (p, _)) -> Z.sign p <> 0)
      (List.mapi (fun j v -> j, Problem.point_of v) row) in
  { digest;
    rows = List.map (fun (m, q, l, u) ->
        { Kernel.given_m = sparse m; given_q = Problem.point_of q; given_lower = bound l;
          given_upper = bound u }) rows }
