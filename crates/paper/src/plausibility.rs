//! What a conversion shows of K, M and the contact states, so that a wrong unit, an exchanged file
//! or a wrong numbering is seen before an analysis.
//!
//! | what | how | what it warns of |
//! |---|---|---|
//! | diagonals, sum of M | largest and smallest entries, e'Me | |
//! | lowest frequencies | K_ff v = omega^2 M_ff v, the contacts held | |
//! | signs | K cancels along e = (1, ..., 1), row by row, M adds up | K and M exchanged |
//! | balance of rows | \|K e\| is zero but near supports | entries of few digits |
//! | masses of a node | one diagonal entry of M for both its dofs | numbers from 1 |
//! | reactions | K u at the contacts, where u is given | numbers from 1, another step or sign |
//! | cones | \|r_T\| over mu \|r_N\| | |
//!
//! All in doubles, all for a reader: nothing here changes the problem or refuses it.
#![allow(clippy::float_arithmetic)]

use crate::contacts::TableReaction;
use crate::doubles::DoubleMatrix;
use crate::frequencies::lowest_frequencies;
use crate::tolerance::{BALANCED_ROWS, CONE_SLACK, EQUAL_MASSES, NEAR_SUPPORTS, REACTION_MISMATCH};
use mceip_exact::{Sparse, to_f64};
use mceip_model::{ContactState, Particle, System};

/// What the figures are made of.
pub struct PlausibilityInput<'a> {
    /// The body, with M and mu.
    pub system: &'a System,
    /// For each particle, the reaction that the table of contacts gives.
    pub reactions: &'a [Option<TableReaction>],
    /// The displacements of the equilibrium, one for each degree of freedom.
    pub displacements: Option<&'a [f64]>,
    /// Does the table name degrees of freedom by numbers, so that it may count from 1?
    pub counts_dofs: bool,
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
        found.look_at_rows(&stiffness);

        if let Some(mass) = input.system.mass() {
            let mass = in_doubles(mass);
            let sum = sum_of_entries(&mass);
            let range = range_of_diagonal(&mass);
            found.figure("M", format!("{range}, sum of all entries {}", number(sum)));
            found.look_at_signs(&stiffness, &mass);
            found.look_at_frequencies(input.system, &stiffness, &mass);
            if input.counts_dofs {
                found.look_at_masses(input.system.particles(), &diagonal(&mass));
            }
        }

        found.look_at_cones(input);
        found.look_at_reactions(input, &stiffness);
        found
    }

    fn figure(&mut self, name: &'static str, text: String) {
        self.table.push((name, text));
    }

    /// A body without supports does not resist a translation: the rows of K away from supports sum
    /// to zero, to rounding. Half of the rows are taken to be away from supports.
    fn look_at_rows(&mut self, stiffness: &DoubleMatrix) {
        let Some(balance) = median_balance(stiffness) else {
            return;
        };
        if balance > NEAR_SUPPORTS {
            return;
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

    /// Along a translation the entries of K cancel, row by row, and those of M add up.
    fn look_at_signs(&mut self, stiffness: &DoubleMatrix, mass: &DoubleMatrix) {
        let mass_cancels = median_balance(mass).is_some_and(|balance| balance <= NEAR_SUPPORTS);
        if mass_cancels && coherence(stiffness) > coherence(mass) {
            self.warnings.push(
                "the entries of K add up and those of M cancel, as if the files of K and M were \
                 exchanged"
                    .to_owned(),
            );
        }
    }

    fn look_at_frequencies(
        &mut self,
        system: &System,
        stiffness: &DoubleMatrix,
        mass: &DoubleMatrix,
    ) {
        let held = held_dofs(system);
        let frequencies = lowest_frequencies(&without(stiffness, &held), &without(mass, &held));
        let text = match frequencies {
            None => "not found in doubles".to_owned(),
            Some(values) if values.is_empty() => "none, every degree of freedom is held".to_owned(),
            Some(values) => {
                let printed: Vec<String> = values.into_iter().map(number).collect();
                let values = printed.join(", ");
                format!("{values} cycles per unit of time (contacts held; Hz for seconds)")
            }
        };

        self.figure("lowest frequencies", text);
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
            let text = format!("|r_T| is mu |r_N|, but for at most {error:.0e} of it");
            self.figure("reactions, slip", text);
        }
        if let Some((ratio, index)) = stick {
            let text = format!("|r_T| at most {ratio:.4} mu |r_N| (particle {index})");
            self.figure("reactions, stick", text);

            let (numerator, denominator) = CONE_SLACK;
            let slack = numerator as f64 / denominator as f64;
            if ratio > 1.0 - slack {
                self.warnings.push(format!(
                    "particle {index} sticks with |r_T| = mu |r_N| up to {slack:.0e} of it: on the \
                     friction cone it is about to slip, and with state slip the answers differ"
                ));
            }
        }
    }

    /// (1) at rest: K u is the reaction at a contact without other loads.
    fn look_at_reactions(&mut self, input: &PlausibilityInput<'_>, stiffness: &DoubleMatrix) {
        let Some(displacements) = input.displacements else {
            return;
        };
        let forces = stiffness.times(displacements);

        let Some(as_given) = mismatch(input, &forces, 0) else {
            self.warnings.push(
                "the reactions are not compared with K u, since no CSV table gives one other than \
                 zero: without them nothing shows a wrong state, angle or direction of slip"
                    .into(),
            );
            return;
        };
        let text = format!("differ by {as_given:.0e} of the largest");
        self.figure("reactions against K u", text);
        if as_given <= REACTION_MISMATCH {
            return;
        }

        let one_less = mismatch(input, &forces, 1);
        if input.counts_dofs && one_less.is_some_and(|m| m <= REACTION_MISMATCH) {
            self.warnings.push(format!(
                "the reactions are those of K u where every number is one less: {COUNT_FROM_ZERO}"
            ));
        } else {
            self.warnings.push(format!(
                "the reactions differ from K u by {as_given:.0e} of the largest: another step, \
                 another sign, loads at the contacts, or K written with few digits"
            ));
        }
    }
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
fn number(value: f64) -> String {
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

    format!("diagonal {} to {}", number(smallest), number(largest))
}

fn sum_of_entries(matrix: &DoubleMatrix) -> f64 {
    matrix.entries.iter().map(|(_, _, value)| value).sum()
}

/// |e'Ae| over the sum of the sizes of the entries: 1 where all have one sign.
fn coherence(matrix: &DoubleMatrix) -> f64 {
    let sizes: f64 = matrix.entries.iter().map(|(_, _, value)| value.abs()).sum();
    sum_of_entries(matrix).abs() / sizes
}

/// The median over the rows that are not empty of |sum of the row| over the sum of the sizes of its
/// entries.
fn median_balance(matrix: &DoubleMatrix) -> Option<f64> {
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
    balances.get(balances.len() / 2).copied()
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
