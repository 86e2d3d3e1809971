(* Decimals of the ends of an interval, rounded outward: the printed interval contains the exact one.

   About twelve significant digits. *)

let digits = 12

let ten_to k = Z.pow (Z.of_int 10) k

(* The largest k-digit decimal at or below x, or the smallest at or above it: n / 10^k. *)
let scaled up x k =
  let num, den =
    if k >= 0 then Z.mul (Q.num x) (ten_to k), Q.den x
    else Q.num x, Z.mul (Q.den x) (ten_to (-k)) in
  if up then Z.cdiv num den else Z.fdiv num den

(* n / 10^k with a point, for n > 0 and k > 0; zeros at the end are left out. *)
let with_point n k =
  let text = Z.to_string n in
  let text = String.make (max 0 (k + 1 - String.length text)) '0' ^ text in
  let whole = String.sub text 0 (String.length text - k) in
  let last = ref (String.length text) in
  while !last > String.length whole && text.[!last - 1] = '0' do decr last done;
  let fraction = String.sub text (String.length whole) (!last - String.length whole) in
  if fraction = "" then whole else whole ^ "." ^ fraction

let show up x =
  if Q.sign x <= 0 then Q.to_string x
  else begin
    let magnitude = (Z.numbits (Q.num x) - Z.numbits (Q.den x)) * 30103 / 100000 in
    let k = digits - 1 - magnitude in
    let n = scaled up x k in
    if k <= 0 then Z.to_string (Z.mul n (ten_to (-k)))
    else if k <= 40 then with_point n k
    else Printf.sprintf "%se-%d" (Z.to_string n) k
  end

let lower x = if Q.sign x < 0 then "-" ^ show true (Q.neg x) else show false x
let upper x = if Q.sign x < 0 then "-" ^ show false (Q.neg x) else show true x
