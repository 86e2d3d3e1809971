(* The elaborator of mceip-stability/1: from its matrices to the integers of the kernel. Untrusted.

   Nothing is computed anew but bounds that follow from the matrices of the file: 2 kappa / m, w,
   and 1 + 1/sigma. *)

open Certificate
open Elaborate

(* The file in the terms of the condensation of a pencil in mu: V(mu) is `right` + mu times
   `left_friction`. *)
let as_condensation (c : stability_condensation) =
  { sigma = c.stable_sigma; factor = c.stable_factor; mass_sigma = Q.zero; mass_factor = None;
    tail = None;
    anchors = [{ center = Q.zero; reversed = false; right = [c.stable_right];
                 left = [c.stable_right; c.stable_friction] }] }

(* A matrix with rows for n variables and a column for each of m others. *)
let require n m rows =
  if List.compare_length_with rows n <> 0
  || not (List.for_all (fun row -> List.compare_length_with row m = 0) rows) then
    no_witness "a matrix of another shape"

let require_factor n (f : factor_rows) =
  if List.compare_length_with f.rows n <> 0 then no_witness "a factor of another order";
  List.iteri (fun i (first, row) ->
      if first > i || List.length row <> i + 1 - first then no_witness "a row of a factor")
    (rows_from f)

(* S = [unit] M - [unit] sigma I is covered by the factor of M - sigma I. *)
let mass_form unit sigma factor n =
  let bound power gram_rows =
    { Kernel.bound_times = Z.mul power (Q.den sigma);
      bound_at = Z.mul unit (Z.mul power (Q.num sigma));
      gram_times = Z.mul unit (Q.den sigma); gram_rows } in
  match factor with
  | None -> bound Z.one (List.init n (fun _ -> 0, []))
  | Some f -> require_factor n f; bound (two_to (2 * f.exponent)) (rows_from f)

let diagonal_mass system =
  let off i row = List.for_all (fun (j, v) -> j = i || Z.sign v = 0) row in
  let summed row = List.map (fun (j, _) -> j, Kernel.lookup row j) row in
  List.for_all Fun.id (List.mapi (fun i row -> off i (summed row)) (Kernel.m_rows system))

let end_of ns (e : stability_end) =
  require ns ns e.symmetric;
  if List.compare_length_with e.bounds ns <> 0 then no_witness "bounds of another length";
  require_factor ns e.end_factor;
  if e.end_exponent > 4_096 then Problem.not_verified "an exponent beyond the limits";
  let unit = two_to e.end_exponent in
  { Kernel.end_form = e.symmetric; end_slope = e.bounds; end_unit = unit;
    end_times = two_to (2 * e.end_factor.exponent); end_gram = Z.mul unit unit;
    end_rows = rows_from e.end_factor }

let build (system : Kernel.system) common (certificate : Certificate.stability) =
  let pencil = Kernel.mu_pencil system in
  let slip = Kernel.slip pencil in
  let ns = List.length slip and nf = List.length pencil.free in
  let unit = Z.mul common system.unit_length in
  let elimination = elimination pencil slip common unit
      (Option.map as_condensation certificate.stable_condensation) 0 in
  let lo = point_of certificate.stable_from and hi = point_of certificate.stable_to in
  Option.iter (fun c -> require_factor nf c.stable_factor) certificate.stable_condensation;

  let gain, gain_unit = match certificate.stable_condensation with
    | Some { stable_inertia = Some (exponent, rows); _ } ->
      require nf ns rows;
      transpose ns rows, two_to exponent
    | _ -> [], Z.one in
  let zero = Z.zero, Z.one in
  let none =
    { Kernel.gain; gain_unit; turn = zero; wide = zero; root = zero;
      mass_form = mass_form unit certificate.stable_mass_sigma certificate.stable_mass_factor
          (nf + ns) } in

  let kappa = Kernel.kappa_in system none (Kernel.k_rows system) pencil.rows_b hi in
  let form = none.mass_form in
  if Z.sign form.bound_at <= 0 || Z.sign elimination.bound_d <= 0 then
    no_witness "a positive lower bound";
  let turn = Q.make (Z.mul (Z.of_int 2) (Z.mul form.bound_times kappa))
      (Z.mul form.bound_at (Z.mul gain_unit (snd hi))) in
  let wide = Q.make (Kernel.width_bound system elimination (Kernel.blocks_of pencil))
      (Z.mul elimination.unit_of elimination.bound_d) in
  let root = match certificate.stable_condensation with
    | Some c -> Q.add Q.one (Q.inv c.stable_sigma)
    | None -> Q.zero in
  let point q = Q.num q, Q.den q in
  let stability = { none with turn = point turn; wide = point wide; root = point root } in
  Kernel.Stable (lo, hi, elimination, stability, end_of ns certificate.stable_lower,
                 end_of ns certificate.stable_upper)
