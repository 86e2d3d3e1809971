//! What a conversion shows of K, M and the contact states, so that a wrong unit, an exchanged file
//! or a wrong numbering is seen before an analysis.
//!
//! | what | how | what it warns of |
//! |---|---|---|
//! | diagonals, sum of M | largest and smallest entries, e'Me | |
//! | lowest frequencies | K_ff v = omega^2 M_ff v, the contacts held | |
//! | signs | K cancels along e = (1, ..., 1), row by row, M adds up | K and M exchanged |
//! | equality | K is not M | one file given twice |
//! | rows alone | an element couples each row of K with others | supports left in K |
//! | balance of rows | \|K e\| is zero but near supports | entries of few digits |
//! | units | the lowest frequency is between 1e-2 and 1e6 | units that do not fit |
//! | friction | mu is at most 5 | per cent, an angle |
//! | masses of a node | one diagonal entry of M for both its dofs | numbers from 1 |
//! | reactions | one for each slip particle | signs of slip that nothing shows to be right |
//! | reactions | K u at the contacts, where u is given | numbers from 1, another step or sign |
//! | other forces | K u at dofs of no particle | a contact that is missing |
//! | cones | \|r_T\| over mu \|r_N\| | |
//! | directions | `directions`, where the places of the nodes are given | wrong angles, normals |
//! | spacing | `spacing`, where these are given | a contact node that is missing |
//!
//! All in doubles, all for a reader: nothing here changes the problem or refuses it.
#![allow(clippy::float_arithmetic)]

use crate::contacts::TableReaction;
use crate::directions::WrongDirections;
use crate::doubles::DoubleMatrix;
use crate::frequencies::lowest_frequencies;
use crate::lines::shown;
use crate::spacing::WideGap;
use crate::tolerance::{
    BALANCED_ROWS, CONE_SLACK, EQUAL_MASSES, NEAR_SUPPORTS, REACTION_MISMATCH, ROW_ALONE,
    USUAL_FREQUENCIES, USUAL_FRICTION,
};
use mceip_exact::{Sparse, from_f64, to_f64, upper_decimal};
use mceip_model::{ContactState, Coordinates, Direction, Particle, System};
use std::collections::HashMap;

/// What the figures are made of.
pub struct PlausibilityInput<'a> {
    /// The body, with M and mu.
    pub system: &'a System,
    /// The rows of the K that was given which stand alone ([`rows_alone`]).
    pub rows_alone: &'a [usize],
    /// The degree of freedom of the system that each given one is, none for those that are held;
    /// without the list they are the same.
    pub places: Option<&'a [Option<usize>]>,
    /// For each particle, the reaction that the table of contacts gives.
    pub reactions: &'a [Option<TableReaction>],
    /// Whether slip particles without a reaction are named: a table of a finite-element program
    /// can give one for each.
    pub asks_for_reactions: bool,
    /// The displacements of the equilibrium, one for each degree of freedom.
    pub displacements: Option<&'a [f64]>,
    /// Where the nodes are.
    pub coordinates: Option<&'a Coordinates>,
    /// The names by which the table has the degrees of freedom; without them it has their numbers,
    /// and may count from 1.
    pub dof_names: Option<&'a HashMap<String, usize>>,
}

/// Figures of a model, and what looks wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct Plausibility {
    /// Lines of a table: a name and what was found.
    pub table: Vec<(&'static str, String)>,
    /// Sentences about what looks wrong.
    pub warnings: Vec<String>,
}

impl Plausibility {
    /// Looks at a model.
    pub fn new(input: &PlausibilityInput<'_>) -> Plausibility {
        let mut found = Plausibility {
            table: Vec::new(),
            warnings: Vec::new(),
        };

        let stiffness = in_doubles(input.system.stiffness());
        found.figure("K", range_of_diagonal(&stiffness));
        found.look_at_rows(input.system, &stiffness);
        found.look_at_supports(input);

        if input.system.mass() == Some(input.system.stiffness()) {
            let same = "K and M are one matrix, as if one file were given for both";
            found.warnings.push(same.into());
        }
        if let Some(mass) = input.system.mass() {
            let mass = in_doubles(mass);
            let sum = with_five_digits(sum_of_entries(&mass));
            let range = range_of_diagonal(&mass);
            found.figure("M", format!("{range}, sum of all entries {sum}"));
            let are_exchanged = found.look_at_signs(&stiffness, &mass);
            let lowest = found.look_at_frequencies(input.system, &stiffness, &mass);
            if let Some(lowest) = lowest
                && !are_exchanged
            {
                found.look_at_units(lowest);
            }
            if input.dof_names.is_none() {
                found.look_at_masses(input.system.particles(), &diagonal(&mass));
            }
        }

        if let Some(friction) = input.system.friction() {
            found.look_at_friction(to_f64(friction));
        }
        found.look_at_cones(input);
        let forces = input.displacements.map(|u| stiffness.times(u));
        let are_given = found.look_at_missing_reactions(input, forces.as_deref());
        if let Some(forces) = forces {
            let are_from_one = found.look_at_reactions(input, &forces, are_given);
            if !are_from_one {
                found.look_at_other_forces(input, &stiffness, &forces);
            }
        }
        if let Some(coordinates) = input.coordinates {
            found.look_at_directions(input, coordinates);
            found.look_at_spacing(input, coordinates);
        }
        found
    }

    fn figure(&mut self, name: &'static str, text: String) {
        self.table.push((name, text));
    }

    /// A body without supports does not resist a translation: the rows of K away from supports sum
    /// to zero, to rounding. Half of the rows are taken to be away from supports.
    ///
    /// Where all of them do, no support is left, and the body moves without force along an obstacle
    /// on which nothing sticks.
    fn look_at_rows(&mut self, system: &System, stiffness: &DoubleMatrix) {
        let balances = balances(stiffness);
        let Some(balance) = median(&balances) else {
            return;
        };
        if balance > NEAR_SUPPORTS {
            return;
        }

        let states = || system.particles().iter().map(|particle| particle.state);
        let may_slide = states().any(|state| matches!(state, ContactState::Slip { .. }))
            && !states().any(|state| state == ContactState::Stick);
        let is_unsupported = balances.last().is_some_and(|worst| *worst <= BALANCED_ROWS);
        if may_slide && is_unsupported {
            self.warnings.push(
                "every row of K sums to zero, as for a body without supports, and no particle \
                 sticks: the body can be moved without force (leave the degrees of freedom of its \
                 supports out of K and M)"
                    .to_owned(),
            );
        }

        self.figure(
            "rows of K",
            format!("sum to zero to {balance:.0e} (median)"),
        );
        if balance > BALANCED_ROWS {
            self.warnings.push(format!(
                "the rows of K sum to zero to {balance:.0e} only: either K is written with few \
                 digits (write it with 17), or the nodes rest on soft springs"
            ));
        }
    }

    /// A support that a program leaves in K is a row with 1, or with a very stiff spring, on the
    /// diagonal and nothing of that size beside it. The degree of freedom then has a mass and
    /// vibrates in the answers, or its spring hides the digits of the others.
    fn look_at_supports(&mut self, input: &PlausibilityInput<'_>) {
        let mut in_table = vec![false; input.system.dofs()];
        for particle in input.system.particles() {
            in_table[particle.tangential] = true;
            in_table[particle.normal] = true;
        }

        let mut words = Vec::new();
        let mut count = 0;
        for &given in input.rows_alone {
            let of_system = input.places.map_or(Some(given), |places| places[given]);
            let Some(dof) = of_system.filter(|dof| !in_table[*dof]) else {
                continue;
            };
            count += 1;
            if count <= LISTED {
                let place = whereabouts(input, dof);
                let entry = with_five_digits(to_f64(&input.system.stiffness().get(dof, dof)));
                words.push(format!("{entry} at dof {given}{place}"));
            }
        }
        if count == 0 {
            return;
        }

        let list = words.join(", ");
        let more = and_more(count);
        self.warnings.push(format!(
            "K has on its diagonal {list}{more} and nothing of that size beside it: prescribed \
             degrees of freedom seem to be left in K, as unit rows or penalty springs (write K and \
             M without their rows and columns)"
        ));
    }

    /// Along a translation the entries of K cancel, row by row, and those of M add up. True if the
    /// two seem to be exchanged.
    fn look_at_signs(&mut self, stiffness: &DoubleMatrix, mass: &DoubleMatrix) -> bool {
        let balance = median(&balances(mass));
        let mass_cancels = balance.is_some_and(|balance| balance <= NEAR_SUPPORTS);
        let are_exchanged = mass_cancels && coherence(stiffness) > coherence(mass);
        if are_exchanged {
            self.warnings.push(
                "the entries of K add up and those of M cancel, as if the files of K and M were \
                 exchanged"
                    .to_owned(),
            );
        }

        are_exchanged
    }

    /// The lowest frequency, if there is one.
    fn look_at_frequencies(
        &mut self,
        system: &System,
        stiffness: &DoubleMatrix,
        mass: &DoubleMatrix,
    ) -> Option<f64> {
        let held = held_dofs(system);
        let frequencies = lowest_frequencies(&without(stiffness, &held), &without(mass, &held));
        let lowest = frequencies
            .as_ref()
            .and_then(|values| values.first().copied());
        let text = match frequencies {
            None => "not found in doubles".to_owned(),
            Some(values) if values.is_empty() => "none, every degree of freedom is held".to_owned(),
            Some(values) => {
                let printed: Vec<String> = values.into_iter().map(with_five_digits).collect();
                let values = printed.join(", ");
                format!("{values} cycles per unit of time (contacts held; Hz for seconds)")
            }
        };

        self.figure("lowest frequencies", text);
        lowest
    }

    /// A body that vibrates far slower or faster than bodies do has a mass in another unit.
    fn look_at_units(&mut self, lowest: f64) {
        let [slow, fast] = USUAL_FREQUENCIES;
        let unusual = if lowest < slow {
            format!("below {slow:e}")
        } else if lowest > fast {
            format!("above {fast:e}")
        } else {
            return;
        };

        let lowest = with_five_digits(lowest);
        self.warnings.push(format!(
            "the lowest frequency is {lowest} cycles per unit of time, {unusual}: K and M may be \
             in units that do not fit (tonnes belong to N and mm, kg to N and m)"
        ));
    }

    /// Dry contacts have coefficients of friction below 2, and no units.
    fn look_at_friction(&mut self, friction: f64) {
        if friction > USUAL_FRICTION {
            let friction = with_five_digits(friction);
            self.warnings.push(format!(
                "the coefficient of friction is {friction}, above {USUAL_FRICTION}: it is the \
                 tangent of the angle of friction, not the angle and not per cent"
            ));
        }
    }

    /// Both degrees of freedom of a node carry its mass. Where they do not, and those numbered one
    /// less do for every particle, the table counts from 1.
    fn look_at_masses(&mut self, particles: &[Particle], masses: &[f64]) {
        let as_given = particles.iter().all(|p| have_one_mass(p, masses, 0));
        let one_less = particles.iter().all(|p| have_one_mass(p, masses, 1));
        if !as_given && one_less {
            self.warnings.push(format!(
                "tangential and normal dofs of a particle have different masses, and equal ones \
                 where every number is one less: {COUNT_FROM_ZERO}"
            ));
        }
    }

    /// How near the reactions of the table are to the friction cone.
    fn look_at_cones(&mut self, input: &PlausibilityInput<'_>) {
        let mut slip_error: Option<f64> = None;
        let mut stick: Option<(f64, usize)> = None;

        let particles = input.system.particles().iter().zip(input.reactions);
        for (index, (particle, reaction)) in particles.enumerate() {
            let Some(ratio) = reaction.as_ref().and_then(|r| r.cone_ratio) else {
                continue;
            };
            match particle.state {
                ContactState::Slip { .. } => {
                    let error = (ratio - 1.0).abs();
                    slip_error = Some(slip_error.map_or(error, |worst| worst.max(error)));
                }
                ContactState::Stick if stick.is_none_or(|(worst, _)| ratio > worst) => {
                    stick = Some((ratio, index));
                }
                _ => (),
            }
        }

        if let Some(error) = slip_error {
            let error = rounded_up(error, 1);
            let text = format!("|r_T| is mu |r_N|, but for at most {error} of it");
            self.figure("reactions, slip", text);
        }
        if let Some((ratio, index)) = stick {
            let particle = listed(input.system, &[index]);
            let at_most = rounded_up(ratio, 4);
            let text = format!("|r_T| at most {at_most} mu |r_N| ({particle})");
            self.figure("reactions, stick", text);

            let (numerator, denominator) = CONE_SLACK;
            let slack = numerator as f64 / denominator as f64;
            if ratio > 1.0 - slack {
                self.warnings.push(format!(
                    "{particle} sticks with |r_T| = mu |r_N| up to {slack:.0e} of it: on the \
                     friction cone it is about to slip, and with state slip the answers differ"
                ));
            }
        }
    }

    /// The direction of impending slip is against the tangential reaction; without one nothing
    /// shows a wrong sign, but `forces`, K u where displacements are given. True if no reaction is
    /// missing that is asked for.
    fn look_at_missing_reactions(
        &mut self,
        input: &PlausibilityInput<'_>,
        forces: Option<&[f64]>,
    ) -> bool {
        let mut without = Vec::new();
        let particles = input.system.particles().iter().zip(input.reactions);
        for (index, (particle, reaction)) in particles.enumerate() {
            let is_given = reaction.is_some() || particle.reaction.is_some();
            if matches!(particle.state, ContactState::Slip { .. }) && !is_given {
                without.push(index);
            }
        }
        if without.is_empty() || !input.asks_for_reactions {
            return true;
        }

        if let Some(forces) = forces {
            self.look_at_forces_of_slip(input, forces, &without);
            return false;
        }

        let particles = listed(input.system, &without);
        self.warnings.push(format!(
            "{particles}: no reaction is given (reaction_tangential, reaction_normal), so that \
             nothing shows a wrong direction of impending slip, a wrong state or a wrong angle"
        ));
        false
    }

    /// K u at particles that slip and have no reaction in the table: r_T is against the impending
    /// slip, and r_N presses.
    fn look_at_forces_of_slip(
        &mut self,
        input: &PlausibilityInput<'_>,
        forces: &[f64],
        without: &[usize],
    ) {
        let along = |direction: Direction| -> f64 {
            let parts = direction.iter();
            parts.map(|(dof, part)| to_f64(part) * forces[*dof]).sum()
        };
        let mut largest = 0.0_f64;
        let mut of_particles = Vec::with_capacity(without.len());
        for &index in without {
            let particle = &input.system.particles()[index];
            let [tangential, normal] = [particle.tangent(), particle.into_obstacle()].map(along);
            largest = largest.max(tangential.abs()).max(normal.abs());
            of_particles.push((index, particle.state, [tangential, normal]));
        }

        let least = REACTION_MISMATCH * largest;
        let mut along_slip = Vec::new();
        let mut pulled = Vec::new();
        for (index, state, reaction) in of_particles {
            let [tangential, normal] = reaction;
            let is_along_slip = match state {
                ContactState::Slip { sign } => tangential * f64::from(sign) < -least,
                _ => false,
            };
            if normal > least {
                pulled.push((index, reaction));
            } else if is_along_slip {
                along_slip.push((index, reaction));
            }
        }

        let faults = [
            (
                along_slip,
                "r_T against the impending slip (slip+ and slip- exchanged?)",
            ),
            (
                pulled,
                "r_N < 0, which presses (normal_direction, angle, normal_x, normal_y)",
            ),
        ];
        for (particles, expected) in faults {
            let Some((_, reaction)) = particles.first() else {
                continue;
            };
            let indices: Vec<usize> = particles.iter().map(|(index, _)| *index).collect();
            let [r_t, r_n] = reaction.map(with_five_digits);
            let list = listed(input.system, &indices);
            self.warnings.push(format!(
                "{list}: expected {expected}, got from K u r_T = {r_t} along the tangent, r_N = \
                 {r_n} along the normal into the obstacle, at the first of them"
            ));
        }
    }

    /// (1) at rest: K u is the reaction at a contact without other loads. True if the table seems
    /// to count from 1. `are_given` says whether no warning of missing reactions stands already.
    fn look_at_reactions(
        &mut self,
        input: &PlausibilityInput<'_>,
        forces: &[f64],
        are_given: bool,
    ) -> bool {
        let Some(as_given) = mismatch(input, forces, 0) else {
            let silent = "the reactions are not compared with K u, since no CSV table gives one \
                          other than zero: without them nothing shows a wrong state or angle";
            if are_given {
                self.warnings.push(silent.into());
            }
            return false;
        };
        let text = format!("differ by {as_given:.0e} of the largest");
        self.figure("reactions against K u", text);
        if as_given <= REACTION_MISMATCH {
            return false;
        }

        let one_less = mismatch(input, forces, 1);
        let fits_one_less = one_less.is_some_and(|m| m <= REACTION_MISMATCH);
        let are_from_one = input.dof_names.is_none() && fits_one_less;
        if are_from_one {
            self.warnings.push(format!(
                "the reactions are those of K u where every number is one less: {COUNT_FROM_ZERO}"
            ));
        } else {
            self.warnings.push(format!(
                "the reactions differ from K u by {as_given:.0e} of the largest: another step, \
                 another sign, loads at the contacts, or K written with few digits"
            ));
        }

        are_from_one
    }

    /// (5) at rest: K u is zero where there is no contact, no load and no support. What loads there
    /// are is not known here; but few bodies are loaded right beside their contacts.
    fn look_at_other_forces(
        &mut self,
        input: &PlausibilityInput<'_>,
        stiffness: &DoubleMatrix,
        forces: &[f64],
    ) {
        let mut in_table = vec![false; forces.len()];
        for particle in input.system.particles() {
            in_table[particle.tangential] = true;
            in_table[particle.normal] = true;
        }

        let mut largest: f64 = 0.0;
        for (force, is_in_table) in forces.iter().zip(&in_table) {
            if *is_in_table {
                largest = largest.max(force.abs());
            }
        }

        let least = REACTION_MISMATCH * largest;
        let is_large = |dof: &usize| forces[*dof].abs() > least;
        let outside = (0..forces.len()).filter(|dof| !in_table[*dof]);
        let mut others: Vec<usize> = outside.filter(is_large).collect();
        if largest == 0.0 || others.is_empty() {
            return;
        }

        others.sort_by(|a, b| forces[*b].abs().total_cmp(&forces[*a].abs()));
        let list = listed_forces(input, forces, &others);
        self.figure("K u elsewhere", format!("{list} (loads, supports)"));

        let beside = dofs_beside(stiffness, &in_table);
        others.retain(|dof| beside[*dof]);
        if !others.is_empty() {
            let list = listed_forces(input, forces, &others);
            self.warnings.push(format!(
                "K u has {list}, beside the contacts and in no line of their table: a load, a \
                 support, or a contact that is missing"
            ));
        }
    }

    /// Tangents are along the boundary, and normals point out of the body.
    fn look_at_directions(&mut self, input: &PlausibilityInput<'_>, coordinates: &Coordinates) {
        let wrong = WrongDirections::of(input.system, coordinates);

        if !wrong.turned.is_empty() {
            let indices: Vec<usize> = wrong.turned.iter().map(|(index, _)| *index).collect();
            let particles = listed(input.system, &indices);
            let degrees = wrong.turned.iter().map(|(_, degrees)| *degrees);
            let largest = degrees.fold(0.0, f64::max);
            let up_to = if indices.len() > 1 { "up to " } else { "" };
            self.warnings.push(format!(
                "{particles}: the tangent is turned by {up_to}{largest:.1} degrees from the line \
                 through its neighbours (angle, normal_x, normal_y, or the order of the dofs)"
            ));
        }

        if !wrong.into_body.is_empty() {
            let particles = listed(input.system, &wrong.into_body);
            self.warnings.push(format!(
                "{particles}: the normal points into the body (normal_direction, angle, normal_x, \
                 normal_y)"
            ));
        }

        if !wrong.of_two_nodes.is_empty() {
            let particles = listed(input.system, &wrong.of_two_nodes);
            self.warnings.push(format!(
                "{particles}: the tangential and the normal dof move two different nodes"
            ));
        }
    }

    /// The contact nodes of a mesh are about evenly spaced.
    fn look_at_spacing(&mut self, input: &PlausibilityInput<'_>, coordinates: &Coordinates) {
        let gaps = WideGap::all_of(input.system, coordinates);
        let mut words = Vec::new();
        for gap in gaps.iter().take(LISTED) {
            let [x, y] = gap.middle.map(with_five_digits);
            let between = gap.particles.map(|index| {
                let particle = &input.system.particles()[index];
                shown(&particle.name_or(index))
            });
            let [from, to] = between;
            let node = match gap.node {
                Some(node) => format!(", where node {node} is"),
                None => String::new(),
            };
            words.push(format!(
                "between particles {from} and {to}, near x = {x}, y = {y}{node}"
            ));
        }
        if gaps.is_empty() {
            return;
        }

        let more = and_more(gaps.len());
        self.warnings.push(format!(
            "the contact nodes are about twice as far apart as beside it {}{more}: a line of the \
             table of contacts may be missing",
            words.join("; ")
        ));
    }
}

/// The rows of K whose diagonal entry is far larger than all others of the row together: no element
/// couples the degree of freedom with another one. Supports that were left in K are such rows.
pub fn rows_alone(stiffness: &Sparse) -> Vec<usize> {
    let is_alone = |row: &usize| {
        let mut others = 0.0;
        let mut diagonal = 0.0;
        for (column, value) in stiffness.row(*row) {
            let size = to_f64(value).abs();
            if column == row {
                diagonal = size;
            } else {
                others += size;
            }
        }
        diagonal > 0.0 && ROW_ALONE * others <= diagonal
    };

    (0..stiffness.rows()).filter(is_alone).collect()
}

/// How many particles or forces a warning lists.
const LISTED: usize = 5;

/// Particles by their names, or by their indices.
fn listed(system: &System, indices: &[usize]) -> String {
    let mut words = Vec::new();
    for index in indices.iter().take(LISTED) {
        let particle = &system.particles()[*index];
        words.push(shown(&particle.name_or(*index)));
    }

    let plural = if indices.len() == 1 { "" } else { "s" };
    let more = and_more(indices.len());
    format!("particle{plural} {}{more}", words.join(", "))
}

/// The first forces with their degrees of freedom, and where these are, if that is known.
fn listed_forces(input: &PlausibilityInput<'_>, forces: &[f64], dofs: &[usize]) -> String {
    let mut words = Vec::new();
    for &dof in dofs.iter().take(LISTED) {
        let force = with_five_digits(forces[dof]);
        words.push(format!("{force} at dof {dof}{}", whereabouts(input, dof)));
    }

    let more = and_more(dofs.len());
    format!("{}{more}", words.join(", "))
}

fn and_more(count: usize) -> String {
    match count.saturating_sub(LISTED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    }
}

/// The name of a degree of freedom, or else its node and its place, in parentheses.
fn whereabouts(input: &PlausibilityInput<'_>, dof: usize) -> String {
    if let Some(names) = input.dof_names {
        let name = names.iter().find(|(_, index)| **index == dof);
        return name.map_or(String::new(), |(name, _)| format!(" ({})", shown(name)));
    }

    let Some(coordinates) = input.coordinates else {
        return String::new();
    };
    match coordinates.node_of(dof) {
        Some(node) => {
            let [x, y] = coordinates.nodes()[node].place.each_ref().map(to_f64);
            let [x, y] = [x, y].map(with_five_digits);
            format!(" (node {node} at x = {x}, y = {y})")
        }
        None => String::new(),
    }
}

/// Is the degree of freedom coupled with one that has the mark?
fn dofs_beside(matrix: &DoubleMatrix, marked: &[bool]) -> Vec<bool> {
    let mut beside = vec![false; matrix.order];
    for &(row, column, _) in &matrix.entries {
        if marked[column] {
            beside[row] = true;
        }
    }

    beside
}

/// What a reader does about numbers from 1.
const COUNT_FROM_ZERO: &str = "the table of contacts seems to count from 1; count from 0";

fn in_doubles(matrix: &Sparse) -> DoubleMatrix {
    let entries = matrix.entries();
    DoubleMatrix {
        order: matrix.rows(),
        entries: entries.map(|(i, j, value)| (i, j, to_f64(value))).collect(),
    }
}

/// A number with five digits, without a power of ten where it can do without.
pub(crate) fn with_five_digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }

    let exponent = value.abs().log10().floor();
    if !(-3.0..7.0).contains(&exponent) {
        return format!("{value:.4e}");
    }

    let decimals = (4.0 - exponent).max(0.0) as usize;
    format!("{value:.decimals$}")
}

fn diagonal(matrix: &DoubleMatrix) -> Vec<f64> {
    let mut values = vec![0.0; matrix.order];
    for &(row, column, value) in &matrix.entries {
        if row == column {
            values[row] = value;
        }
    }

    values
}

fn range_of_diagonal(matrix: &DoubleMatrix) -> String {
    let values = diagonal(matrix);
    let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);

    format!(
        "diagonal {} to {}",
        with_five_digits(smallest),
        with_five_digits(largest)
    )
}

fn sum_of_entries(matrix: &DoubleMatrix) -> f64 {
    matrix.entries.iter().map(|(_, _, value)| value).sum()
}

/// |e'Ae| over the sum of the sizes of the entries: 1 where all have one sign.
fn coherence(matrix: &DoubleMatrix) -> f64 {
    let sizes: f64 = matrix.entries.iter().map(|(_, _, value)| value.abs()).sum();
    sum_of_entries(matrix).abs() / sizes
}

/// |sum of the row| over the sum of the sizes of its entries, for the rows that are not empty,
/// ascending.
fn balances(matrix: &DoubleMatrix) -> Vec<f64> {
    let mut sums = vec![0.0; matrix.order];
    let mut sizes = vec![0.0; matrix.order];
    for &(row, _, value) in &matrix.entries {
        sums[row] += value;
        sizes[row] += value.abs();
    }

    let mut balances: Vec<f64> = Vec::new();
    for (sum, size) in sums.iter().zip(&sizes) {
        if *size > 0.0 {
            balances.push(f64::abs(*sum) / size);
        }
    }
    balances.sort_by(f64::total_cmp);
    balances
}

fn median(ascending: &[f64]) -> Option<f64> {
    ascending.get(ascending.len() / 2).copied()
}

/// Is the degree of freedom one of a particle in contact?
fn held_dofs(system: &System) -> Vec<bool> {
    let mut held = vec![false; system.dofs()];
    for particle in system.particles() {
        if particle.state != ContactState::Free {
            held[particle.tangential] = true;
            held[particle.normal] = true;
        }
    }

    held
}

/// The matrix without the rows and columns that are held.
fn without(matrix: &DoubleMatrix, held: &[bool]) -> DoubleMatrix {
    let mut place = Vec::with_capacity(held.len());
    let mut order = 0;
    for is_held in held {
        place.push(order);
        order += usize::from(!is_held);
    }

    let mut entries = Vec::new();
    for &(row, column, value) in &matrix.entries {
        if !held[row] && !held[column] {
            entries.push((place[row], place[column], value));
        }
    }

    DoubleMatrix { order, entries }
}

/// Do both degrees of freedom, numbered `less` lower, have one mass?
fn have_one_mass(particle: &Particle, masses: &[f64], less: usize) -> bool {
    let mass = |dof: usize| dof.checked_sub(less).map(|dof| masses[dof]);
    let (Some(tangential), Some(normal)) = (mass(particle.tangential), mass(particle.normal))
    else {
        return false;
    };

    (tangential - normal).abs() <= EQUAL_MASSES * tangential.abs()
}

/// The largest difference between a reaction and the force at its degree of freedom, numbered
/// `less` lower, over the largest reaction; none without a reaction that is not zero.
fn mismatch(input: &PlausibilityInput<'_>, forces: &[f64], less: usize) -> Option<f64> {
    let mut largest = 0.0_f64;
    let mut difference = 0.0_f64;

    let particles = input.system.particles().iter().zip(input.reactions);
    for (particle, reaction) in particles {
        let Some(reaction) = reaction else { continue };
        let dofs = [particle.tangential, particle.normal];
        for (dof, along_dof) in dofs.into_iter().zip(&reaction.along_dofs) {
            let given = to_f64(along_dof);
            let force = forces[dof.checked_sub(less)?];
            largest = largest.max(given.abs());
            // Displacements near the end of the doubles may give no number.
            let apart = (given - force).abs();
            difference = difference.max(if apart.is_nan() { f64::INFINITY } else { apart });
        }
    }

    (largest > 0.0).then(|| difference / largest)
}

/// A decimal with so many significant digits that is not below a number.
fn rounded_up(value: f64, digits: usize) -> String {
    let exact = from_f64(value).unwrap_or_default();
    upper_decimal(&exact, digits)
}
