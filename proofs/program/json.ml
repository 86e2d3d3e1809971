(* JSON texts with exact numbers (RFC 8259; spec/formats.md, "Spelling"). Trusted.

   A number keeps its spelling.  Duplicate keys, blanks inside numbers, comments and text after the
   value are refused with [Malformed]. *)

exception Malformed of string

type t =
  | Null
  | Bool of bool
  | Number of string
  | String of string
  | List of t list
  | Object of (string * t) list

let malformed fmt = Printf.ksprintf (fun text -> raise (Malformed text)) fmt

(* Well-formed UTF-8 (RFC 3629). *)
let valid_utf8 text =
  let n = String.length text in
  let byte i = Char.code text.[i] in
  let continues i = i < n && byte i land 0xC0 = 0x80 in
  let rec from i =
    if i >= n then true
    else
      let b = byte i in
      if b < 0x80 then from (i + 1)
      else if b >= 0xC2 && b < 0xE0 then continues (i + 1) && from (i + 2)
      else if b >= 0xE0 && b < 0xF0 then
        continues (i + 1) && continues (i + 2)
        && (b <> 0xE0 || byte (i + 1) >= 0xA0) && (b <> 0xED || byte (i + 1) < 0xA0)
        && from (i + 3)
      else if b >= 0xF0 && b < 0xF5 then
        continues (i + 1) && continues (i + 2) && continues (i + 3)
        && (b <> 0xF0 || byte (i + 1) >= 0x90) && (b <> 0xF4 || byte (i + 1) < 0x90)
        && from (i + 4)
      else false in
  from 0

(* One UTF-8 encoded character, for \u escapes. *)
let utf8 buffer code =
  Buffer.add_utf_8_uchar buffer (Uchar.of_int code)

let parse (text : string) : t =
  let length = String.length text in
  let position = ref 0 in
  let peek () = if !position < length then text.[!position] else '\000' in
  let advance () = incr position in
  let rec blanks () =
    match peek () with
    | ' ' | '\t' | '\n' | '\r' when !position < length -> advance (); blanks ()
    | _ -> () in
  let expect c =
    if !position < length && peek () = c then advance ()
    else malformed "%C was expected at byte %d" c !position in
  let hex4 () =
    let code = ref 0 in
    for _ = 1 to 4 do
      let digit = match peek () with
        | '0' .. '9' as c -> Char.code c - 48
        | 'a' .. 'f' as c -> Char.code c - 87
        | 'A' .. 'F' as c -> Char.code c - 55
        | _ -> malformed "a hexadecimal digit was expected at byte %d" !position in
      code := 16 * !code + digit;
      advance ()
    done;
    !code in
  let string_body () =
    expect '"';
    let buffer = Buffer.create 16 in
    let rec loop () =
      if !position >= length then malformed "a string has no end";
      match peek () with
      | '"' -> advance ()
      | '\\' ->
        advance ();
        let c = peek () in
        advance ();
        (match c with
         | '"' | '\\' | '/' -> Buffer.add_char buffer c
         | 'b' -> Buffer.add_char buffer '\b'
         | 'f' -> Buffer.add_char buffer '\012'
         | 'n' -> Buffer.add_char buffer '\n'
         | 'r' -> Buffer.add_char buffer '\r'
         | 't' -> Buffer.add_char buffer '\t'
         | 'u' ->
           let high = hex4 () in
           if high >= 0xD800 && high < 0xDC00 then begin
             expect '\\'; expect 'u';
             let low = hex4 () in
             if low < 0xDC00 || low > 0xDFFF then malformed "half of a character";
             utf8 buffer (0x10000 + ((high - 0xD800) lsl 10) + (low - 0xDC00))
           end
           else if high >= 0xDC00 && high < 0xE000 then malformed "half of a character"
           else utf8 buffer high
         | _ -> malformed "an unknown escape at byte %d" !position);
        loop ()
      | c when Char.code c < 32 -> malformed "a control character in a string"
      | c -> Buffer.add_char buffer c; advance (); loop () in
    loop ();
    Buffer.contents buffer in
  let digits () =
    let start = !position in
    while (match peek () with '0' .. '9' -> true | _ -> false) do advance () done;
    if !position = start then malformed "a digit was expected at byte %d" start in
  let number () =
    let start = !position in
    if peek () = '-' then advance ();
    if peek () = '0' then advance () else digits ();
    if peek () = '.' then (advance (); digits ());
    if peek () = 'e' || peek () = 'E' then begin
      advance ();
      if peek () = '+' || peek () = '-' then advance ();
      digits ()
    end;
    Number (String.sub text start (!position - start)) in
  let word name value =
    let n = String.length name in
    if !position + n <= length && String.sub text !position n = name then begin
      position := !position + n;
      value
    end
    else malformed "a value was expected at byte %d" !position in
  let rec value depth =
    if depth > 200 then malformed "nested too deeply";
    blanks ();
    match peek () with
    | '{' ->
      advance (); blanks ();
      if peek () = '}' then (advance (); Object [])
      else begin
        let rec members seen =
          blanks ();
          let key = string_body () in
          if List.mem_assoc key seen then malformed "the key %S twice" key;
          blanks (); expect ':';
          let seen = (key, value (depth + 1)) :: seen in
          blanks ();
          if peek () = ',' then (advance (); members seen)
          else (expect '}'; Object (List.rev seen)) in
        members []
      end
    | '[' ->
      advance (); blanks ();
      if peek () = ']' then (advance (); List [])
      else begin
        let rec elements seen =
          let seen = value (depth + 1) :: seen in
          blanks ();
          if peek () = ',' then (advance (); elements seen)
          else (expect ']'; List (List.rev seen)) in
        elements []
      end
    | '"' -> String (string_body ())
    | 't' -> word "true" (Bool true)
    | 'f' -> word "false" (Bool false)
    | 'n' -> word "null" Null
    | _ -> number () in
  let result = value 0 in
  blanks ();
  if !position < length then malformed "text after the value, at byte %d" !position;
  if not (valid_utf8 text) then malformed "no UTF-8";
  result

let read path =
  let channel = open_in_bin path in
  let text = Fun.protect ~finally:(fun () -> close_in channel)
      (fun () -> really_input_string channel (in_channel_length channel)) in
  parse text

(* The fields of an object: required ones, optional ones, no others. *)
let fields required optional = function
  | Object members ->
    List.iter (fun (key, _) ->
        if not (List.mem key required || List.mem key optional) then
          malformed "the field %S is unknown" key) members;
    List.iter (fun key ->
        if not (List.mem_assoc key members) then malformed "the field %S is missing" key) required;
    fun key -> (try List.assoc key members with Not_found -> Null)
  | _ -> malformed "an object was expected"

let has_format name = function
  | Object members -> List.assoc_opt "format" members = Some (String name)
  | _ -> false

let list = function List items -> items | _ -> malformed "a list was expected"

(* A list that may be left out; null is no list. *)
let list_or_none key = function
  | Object members -> Option.fold ~none:[] ~some:list (List.assoc_opt key members)
  | _ -> []

let text = function String s -> s | _ -> malformed "a string was expected"

(* A rational: p/q or a decimal, with the limits of the specification. *)
let rational_of_spelling s =
  let bad () = malformed "%S is no number" s in
  let n = String.length s in
  if n = 0 || n > 100_000 then bad ();
  let all_digits a = a <> "" && String.for_all (fun c -> c >= '0' && c <= '9') a in
  let signed a =
    let negative = a <> "" && a.[0] = '-' in
    let has_sign = a <> "" && (a.[0] = '-' || a.[0] = '+') in
    (negative, if has_sign then String.sub a 1 (String.length a - 1) else a) in
  let integer a =
    let negative, body = signed a in
    if not (all_digits body) then bad ();
    let z = Z.of_string_base 10 body in
    if negative then Z.neg z else z in
  match String.index_opt s '/' with
  | Some i ->
    let p = integer (String.sub s 0 i) and q = integer (String.sub s (i + 1) (n - i - 1)) in
    if Z.sign q = 0 then bad ();
    Q.make p q
  | None ->
    let cut = match String.index_opt s 'e', String.index_opt s 'E' with
      | Some i, _ | None, Some i -> Some i
      | None, None -> None in
    let mantissa, exponent = match cut with
      | None -> s, 0
      | Some i ->
        let e = integer (String.sub s (i + 1) (n - i - 1)) in
        if Z.gt (Z.abs e) (Z.of_int 400) then bad ();
        String.sub s 0 i, Z.to_int e in
    let negative, body = signed mantissa in
    let whole, fraction = match String.index_opt body '.' with
      | None -> body, ""
      | Some i -> String.sub body 0 i, String.sub body (i + 1) (String.length body - i - 1) in
    if not (all_digits (whole ^ fraction)) then bad ();
    let z = Z.of_string_base 10 (whole ^ fraction) in
    let power = exponent - String.length fraction in
    let ten k = Z.pow (Z.of_int 10) k in
    let q = if power >= 0 then Q.of_bigint (Z.mul z (ten power)) else Q.make z (ten (-power)) in
    if negative then Q.neg q else q

let rational = function
  | Number s | String s -> rational_of_spelling s
  | _ -> malformed "a number was expected"

let integer item =
  let q = rational item in
  if Z.equal (Q.den q) Z.one then Q.num q else malformed "an integer was expected"

let spelt_as_integer s =
  s <> "-0" && String.for_all (fun c -> c = '-' || (c >= '0' && c <= '9')) s

(* A weight: a JSON number spelt as an integer, of 64 bits. *)
let weight = function
  | Number s when String.length s <= 20 && spelt_as_integer s && Z.fits_int64 (Z.of_string s) ->
    Z.of_string s
  | _ -> malformed "an integer of 64 bits was expected"

(* An index or a size: a JSON number spelt as an integer. *)
let counter = function
  | Number s when spelt_as_integer s ->
    (match int_of_string_opt s with
     | Some i when abs i < Natural.limit -> i
     | _ -> malformed "%s is too large" s)
  | _ -> malformed "an integer was expected"

let index n item =
  let i = counter item in
  if i < 0 || i >= n then malformed "the index %d is out of range" i;
  i
