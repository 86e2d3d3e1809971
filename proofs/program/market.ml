(* Matrix Market files, and rounding to doubles (spec/formats.md, "mceip-problem/1"). Trusted.

   A file is read exactly: each value is the rational that its spelling means. *)

open Json

type t = { rows : int; cols : int; symmetric : bool; entries : (int * int * Q.t) list }

let largest_side = 1_000_000

(* A regular file beside or below the folder, and no link out of it. *)
let path_beside folder name =
  let parts = String.split_on_char '/' (String.map (fun c -> if c = '\\' then '/' else c) name) in
  if name = "" || not (Filename.is_relative name) || List.mem ".." parts then
    malformed "a matrix file must be beside or below the problem file";
  let path = Filename.concat folder name in
  try
    let real = Unix.realpath path and root = Unix.realpath folder in
    let prefix = if root = "/" then root else root ^ "/" in
    if (Unix.stat real).st_kind <> S_REG || not (String.starts_with ~prefix real) then
      malformed "no regular file beside the problem: %s" name;
    real
  with Unix.Unix_error _ | Sys_error _ | Invalid_argument _ ->
    malformed "no such file beside the problem: %s" name

(* Lines end in LF or CR LF. *)
let lines_of text =
  let lines = String.split_on_char '\n' text in
  let rec strip = function
    | [] -> []
    | [last] -> [last]
    | line :: rest ->
      let n = String.length line in
      let line = if n > 0 && line.[n - 1] = '\r' then String.sub line 0 (n - 1) else line in
      line :: strip rest in
  strip lines

let words_of line =
  String.split_on_char ' ' (String.map (fun c -> if c = '\t' then ' ' else c) line)
  |> List.filter (fun word -> word <> "")

(* A size, or an index from 1: digits alone. *)
let place word =
  let digits = String.for_all (fun c -> c >= '0' && c <= '9') word in
  match if digits then int_of_string_opt ("0u" ^ word) else None with
  | Some i when i >= 0 -> i
  | _ -> malformed "Matrix Market: %S is no size or index" word

let parse text =
  if not (valid_utf8 text) then malformed "Matrix Market: no UTF-8";
  let head, body = match lines_of text with
    | [] -> malformed "Matrix Market: no header"
    | head :: rest ->
      words_of (String.lowercase_ascii head),
      List.filter (fun words -> words <> [])
        (List.map words_of
           (List.filter (fun line -> line = "" || line.[0] <> '%') rest)) in
  let coordinate, symmetric = match head with
    | ["%%matrixmarket"; "matrix"; ("coordinate" | "array" as layout);
       ("real" | "integer" | "double"); ("general" | "symmetric" as symmetry)] ->
      layout = "coordinate", symmetry = "symmetric"
    | _ -> malformed "Matrix Market: header" in
  let sizes, body = match body with
    | sizes :: body -> List.map place sizes, body
    | [] -> malformed "Matrix Market: no size line" in
  let rows, cols, count = match sizes with
    | [rows; cols; count] when coordinate -> rows, cols, Some count
    | [rows; cols] when not coordinate -> rows, cols, None
    | _ -> malformed "Matrix Market: size line" in
  if rows > largest_side || cols > largest_side then malformed "Matrix Market: too large";
  if symmetric && rows <> cols then malformed "Matrix Market: not square";

  let lines = List.length body in
  let expected = match count with
    | Some count -> count
    | None -> if symmetric then rows * (rows + 1) / 2 else rows * cols in
  if lines <> expected then malformed "Matrix Market: number of entries";

  let index side word =
    let i = place word in
    if i < 1 || i > side then malformed "Matrix Market: the index %d is out of range" i;
    i - 1 in
  let position = ref (0, 0) in
  (* Values of an array run down the columns, from the diagonal on if symmetric. *)
  let next_position () =
    let i, j = !position in
    position := if i + 1 < rows then i + 1, j else (if symmetric then j + 1 else 0), j + 1;
    i, j in
  let entry = function
    | [i; j; v] when coordinate ->
      let i = index rows i and j = index cols j in
      if symmetric && i < j then malformed "Matrix Market: the lower triangle was expected";
      i, j, rational_of_spelling v
    | [v] when not coordinate ->
      let i, j = next_position () in
      i, j, rational_of_spelling v
    | _ -> malformed "Matrix Market: an entry" in
  { rows; cols; symmetric; entries = List.rev (List.rev_map entry body) }

let read folder name =
  let path = path_beside folder name in
  let text =
    try
      let channel = open_in_bin path in
      Fun.protect ~finally:(fun () -> close_in channel)
        (fun () -> really_input_string channel (in_channel_length channel))
    with Sys_error _ | End_of_file -> malformed "%s cannot be read" name in
  parse text

(* ---------- the nearest double, ties to even *)

let nearest_double q =
  if Q.sign q = 0 then q
  else begin
    let p = Z.abs (Q.num q) and d = Q.den q in
    (* q / 2^s, rounded down to m, and the rest *)
    let divided s =
      if s >= 0 then Z.ediv_rem p (Z.shift_left d s), Z.shift_left d s
      else Z.ediv_rem (Z.shift_left p (-s)) d, d in
    let lowest = -1074 in
    let first = max lowest (Z.numbits p - Z.numbits d - 53) in
    let (m, _), _ = divided first in
    let s = if Z.numbits m > 53 then first + 1 else first in
    let (m, rest), unit = divided s in
    let twice = Z.compare (Z.shift_left rest 1) unit in
    let m = if twice > 0 || (twice = 0 && Z.is_odd m) then Z.succ m else m in
    if Z.numbits m + s > 1024 then malformed "a number beyond the doubles";
    let size =
      if s >= 0 then Q.of_bigint (Z.shift_left m s) else Q.make m (Z.shift_left Z.one (-s)) in
    if Q.sign q < 0 then Q.neg size else size
  end
