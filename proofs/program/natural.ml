(* Coq's natural numbers as OCaml's int (Extraction.v).  Trusted.

   A result is either that of Coq or there is none: each function raises [Invalid_argument] where a
   number is negative or reaches 2^60, so that no sum overflows and no index of a witness passes for
   another number.  The program then answers "not verified".  Equality needs no such care. *)

let limit = 1 lsl 60

let beyond () = invalid_arg "a number below zero or from 2^60 on"

let is_natural n = n >= 0 && n < limit [@@inline]

let succ n = if is_natural n then n + 1 else beyond () [@@inline]

(* Of a number that is not zero. *)
let before n = if is_natural n then n - 1 else beyond () [@@inline]

let add n m = if is_natural n && is_natural m then n + m else beyond () [@@inline]

let sub n m =
  if not (is_natural n && is_natural m) then beyond () else if n > m then n - m else 0 [@@inline]

let mul n m =
  if not (is_natural n && is_natural m) || (n > 0 && m > limit / n) then beyond () else n * m
