(* What the format of problems demands of a system and no statement needs: symmetric matrices,
   reactions that agree with the states, particles apart (spec/formats.md, mceip-problem/1).

   Not trusted: these functions refuse, and do nothing else. *)

open Json

(* A square matrix with the entries of its rows. *)
let symmetric rows cols entries =
  rows = cols &&
  (let table = Array.map (fun row -> Hashtbl.of_seq (List.to_seq row)) entries in
   let same = ref true in
   Array.iteri (fun i row ->
       List.iter (fun (j, v) ->
           match Hashtbl.find_opt table.(j) i with
           | Some w when Q.equal v w -> ()
           | _ -> same := false) row) entries;
   !same)

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

let apart dofs =
  if List.length (List.sort_uniq compare dofs) < List.length dofs then
    malformed "a degree of freedom in two particles"
