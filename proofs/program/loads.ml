(* Bodies under loads, mceip-loads/1 (spec/formats.md): the body as it is written, and its digest,
   which is that of the body without its held degrees of freedom. Trusted. *)

open Json

type t = { digest : string; body : Kernel.rational_body }

let read_candidate order item =
  let field = fields ["tangential"; "normal"] ("gap" :: Problem.directions) item in
  let gap = match field "gap" with Null -> Q.zero | v -> rational v in
  Problem.read_directions order field Kernel.Sticking, gap

let read_values order key step =
  List.map (fun pair -> match list pair with
      | [d; v] -> index order d, rational v
      | _ -> malformed "a value is [dof, number]") (list_or_none key step)

let read_step order step =
  let field = fields [] ["name"; "forces"; "displacements"; "endless"] step in
  (match field "name" with Null -> () | v -> ignore (text v));
  let is_endless = match field "endless" with
    | Null | Bool false -> false
    | Bool true -> true
    | _ -> malformed "endless" in
  (read_values order "forces" step, read_values order "displacements" step), is_endless

(* The load of a step on the kept degrees of freedom: forces, and what displacements exert. *)
let eliminated (k : Problem.matrix) place (forces, displacements) =
  let load = Hashtbl.create 16 in
  let add (d, v) =
    if place.(d) >= 0 then
      let sum = Option.value (Hashtbl.find_opt load place.(d)) ~default:Q.zero in
      Hashtbl.replace load place.(d) (Q.add sum v) in
  List.iter add forces;
  List.iter (fun (d, v) ->
      List.iter (fun (e, entry) -> add (e, Q.neg (Q.mul entry v))) k.entries.(d)) displacements;
  List.filter (fun (_, v) -> Q.sign v <> 0)
    (List.sort compare (List.of_seq (Hashtbl.to_seq load)))

let without_held (m : Problem.matrix) place kept : Problem.matrix =
  let row d =
    List.filter_map (fun (e, v) -> if place.(e) >= 0 then Some (place.(e), v) else None)
      m.entries.(d) in
  { rows = List.length kept; cols = List.length kept;
    entries = Array.of_list (List.map row kept) }

let read path document =
  let field = fields ["format"; "system"; "steps"] ["name"; "comment"; "coordinates"; "warnings"]
      document in
  List.iter (fun key -> match field key with
      | Null -> () | v -> ignore (text v)) ["name"; "comment"];
  let system = field "system" in
  let part = fields ["stiffness"; "candidates"] ["mass"; "friction"; "held"] system in
  let k, m, _ = Problem.read_body (Filename.dirname path) part in
  let order = k.rows in
  let candidates = List.map (read_candidate order) (list (part "candidates")) in
  let steps, endless = List.split (List.map (read_step order) (list (field "steps"))) in
  let points = List.map (fun (d, v) -> d, Problem.point_of v) in
  let body =
    { Kernel.body_degrees = order; body_stiffness = Problem.rational_rows k;
      candidates = List.map (fun ((_, particle_of), gap) ->
          { Kernel.particle_of; gap_of = Problem.point_of gap }) candidates;
      held_still = List.map (index order) (list_or_none "held" system);
      loads = List.map (fun (forces, displacements) ->
          { Kernel.forces_of = points forces; displacements_of = points displacements }) steps } in

  let kept = List.filter (fun d -> not (Kernel.is_held body d)) (List.init order Fun.id) in
  let place = Array.make order (-1) in
  List.iteri (fun i d -> place.(d) <- i) kept;
  let gaps = List.map snd candidates and loads = List.map (eliminated k place) steps in
  Demands.check_loads body gaps steps endless loads;
  let particle ((framed, (p : Kernel.given_particle)), _) =
    framed, { p with first_of = place.(p.first_of); second_of = place.(p.second_of) } in
  let without m = without_held m place kept in
  let text =
    ["mceip-canonical-loads/1"]
    @ Problem.body_lines
      (List.map (fun c -> Problem.describe_particle (particle c)) candidates) (without k) (Option.map without m)
    @ List.map (fun gap -> "gap " ^ Q.to_string gap) gaps
    @ List.concat_map (fun load ->
        "load" :: List.map (fun (d, v) -> Printf.sprintf "%d %s" d (Q.to_string v)) load) loads in
  { digest = Problem.digest_of text; body }
