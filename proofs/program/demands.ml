(* What the formats demand of a system or a body and no statement needs: symmetric matrices,
   reactions that agree with the states and with the curvature, particles apart (spec/formats.md).

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

(* Of a curved obstacle: a slip particle that is pressed on, as its reaction says, if it has one. *)
let check_curvature state normal reaction =
  if state <> "slip" then malformed "curvature: for slip only";
  if Q.sign normal >= 0 then malformed "curvature: normal_reaction must be negative";
  if reaction <> Null then begin
    let field = fields ["normal"; "tangential"] [] reaction in
    if not (Q.equal normal (rational (field "normal"))) then
      malformed "curvature: normal_reaction is not that of the reaction"
  end

let apart dofs =
  if List.length (List.sort_uniq compare dofs) < List.length dofs then
    malformed "a degree of freedom in two particles"

let beyond_doubles v = not (Float.is_finite (Q.to_float v))

(* Of a body under loads: candidates and steps, of which only the last may be endless; each dof once
   in a list, no force on a held one; gaps and eliminated loads that doubles hold. *)
let check_loads (body : Kernel.rational_body) gaps steps endless loads =
  let once pairs =
    let dofs = List.map fst pairs in
    if List.length (List.sort_uniq compare dofs) < List.length dofs then
      malformed "a degree of freedom twice in a step" in
  let not_held d =
    if Kernel.is_held body d then malformed "a candidate or a force on a held degree of freedom" in
  let dofs = List.concat_map (fun (c : Kernel.candidate) ->
      [c.particle_of.first_of; c.particle_of.second_of]) body.candidates in
  if dofs = [] || steps = [] then malformed "a candidate and a step were expected";
  apart dofs;
  List.iter not_held dofs;
  List.iter (fun (forces, displacements) ->
      once forces;
      once displacements;
      List.iter (fun (d, _) -> not_held d) forces) steps;
  if List.exists Fun.id (List.tl (List.rev endless)) then
    malformed "an endless step before another";
  if List.exists (fun gap -> Q.sign gap < 0) gaps then malformed "a negative gap";
  if List.exists beyond_doubles gaps
  || List.exists (List.exists (fun (_, v) -> beyond_doubles v)) loads then
    malformed "gaps and loads that doubles hold"
