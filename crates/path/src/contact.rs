//! A body seen from its contact side: stiffness and loads condensed to the contact candidates,
//! exactly, in tangential and normal directions; friction; responses to loads.
//!
//! With c the dofs of the candidates, turned into their directions, and i all others,
//!
//! ```text
//! C = K_cc - K_ci K_ii^-1 K_ic,    h = f_c - K_ci K_ii^-1 f_i,    r = C u - sum_l a_l h_l
//! ```
//!
//! for the amounts a_l of the loads f_l. Displacements are counted from where a candidate touches
//! the obstacle, w_N = u_N - gap, so that (1) reads w_N <= 0 for every candidate; the gaps thereby
//! become one more load, of amount 1. All of `path` reads C and h from here.
//!
//! A load with long numbers in common (a depth of pressing with 800 bits) would make every other
//! number long. So h is that of the load divided by its content, and the amounts in w count these:
//! [`Contact::content`] of them are one load.

use super::error::PathError;
use super::load_steps::require_positive;
use mceip_exact::{Integer, Rational, cleared, common_denominator, to_f64};
use mceip_model::{ContactState, ModelError};
use num_traits::{One, Signed, Zero};

/// K and the loads condensed to the contact candidates, as integers over one denominator.
///
/// Component 2k of w is u_T of candidate k, 2k + 1 is u_N minus the gap (positive *into* the
/// obstacle, the paper's direction). Then come the amounts of the loads, so that the reactions are
/// one product: r = \[C, -h_1, -h_2, ...\] w.
#[derive(Debug, Clone)]
pub struct Contact {
    /// \[C, -h_1, -h_2, ...\]: a row for each component of r, a column for each of w.
    rows: Vec<Vec<Integer>>,
    denominator: Integer,
    /// The content c of each load: the load is c times the h in `rows`.
    contents: Vec<Rational>,
    /// Distance of each candidate from the obstacle in the unloaded body, >= 0.
    gaps: Vec<Rational>,
    /// Coefficient of friction of each candidate over mu, > 0.
    friction_factors: Vec<Rational>,
}

/// What a [`Contact`] is made of, in the directions (T, N) of each candidate.
#[derive(Debug, Clone)]
pub struct ContactSide {
    /// C: of order 2 n for n candidates.
    pub stiffness: Vec<Vec<Rational>>,
    /// h of each load over its content: 2 n components.
    pub loads: Vec<Vec<Rational>>,
    /// The content of each load, > 0.
    pub contents: Vec<Rational>,
    /// Distance of each candidate from the obstacle, >= 0.
    pub gaps: Vec<Rational>,
    /// Coefficient of friction of each candidate over mu, > 0.
    pub friction_factors: Vec<Rational>,
}

impl Contact {
    /// Puts the parts over one denominator.
    ///
    /// # Errors
    /// [`PathError::Model`] for parts that do not fit together; [`PathError::NegativeGap`].
    pub fn new(side: ContactSide) -> Result<Contact, PathError> {
        side.require_fitting_shapes()?;

        let mut columns: Vec<Vec<Rational>> = Vec::new();
        for load in &side.loads {
            columns.push(load.iter().map(|h| -h).collect());
        }
        // C u = C w + C gap.
        columns.push(side.forces_of_the_gaps());

        let mut rational = side.stiffness;
        for column in columns {
            for (row, entry) in rational.iter_mut().zip(column) {
                row.push(entry);
            }
        }

        let denominator = common_denominator(rational.iter().flatten());
        let mut rows = Vec::with_capacity(rational.len());
        for row in &rational {
            let numerators = row.iter().map(|entry| cleared(entry, &denominator));
            rows.push(numerators.collect());
        }

        Ok(Contact {
            rows,
            denominator,
            contents: side.contents,
            gaps: side.gaps,
            friction_factors: side.friction_factors,
        })
    }

    /// Number of contact candidates.
    pub fn nodes(&self) -> usize {
        self.rows.len() / 2
    }

    /// Number of loads.
    pub fn loads(&self) -> usize {
        self.columns() - self.rows.len() - 1
    }

    /// The content of a load.
    pub(super) fn content(&self, load: usize) -> &Rational {
        &self.contents[load]
    }

    /// Bits of the common denominator of the condensed stiffness and loads.
    pub fn bits(&self) -> u64 {
        self.denominator.bits()
    }

    /// Components of w: two for each candidate, then the amounts of the loads and of the gaps.
    pub(super) fn columns(&self) -> usize {
        self.rows.first().map_or(0, Vec::len)
    }

    /// Distance of each candidate from the obstacle in the unloaded body.
    pub(super) fn gaps(&self) -> &[Rational] {
        &self.gaps
    }

    /// Coefficient of friction of each candidate over mu.
    pub(super) fn friction_factors(&self) -> &[Rational] {
        &self.friction_factors
    }

    /// The common denominator of C and the loads (positive).
    pub(super) fn denominator(&self) -> &Integer {
        &self.denominator
    }

    /// The numerators of \[C, -h_1, -h_2, ...\], by rows.
    pub(super) fn rows(&self) -> &[Vec<Integer>] {
        &self.rows
    }

    /// \[C, -h_1, -h_2, ...\] in doubles: as [`Contact`] has them.
    pub fn rows_f64(&self) -> Vec<Vec<f64>> {
        let entry = |numerator: &Integer| {
            to_f64(&Rational::new_raw(
                numerator.clone(),
                self.denominator.clone(),
            ))
        };
        let rows = self.rows.iter();
        rows.map(|row| row.iter().map(entry).collect()).collect()
    }

    /// Numerators of r for w.
    pub(super) fn times(&self, w: &[Integer]) -> Vec<Integer> {
        let mut product = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            let mut sum = Integer::zero();
            for (entry, component) in row.iter().zip(w) {
                if !component.is_zero() {
                    sum += entry * component;
                }
            }

            product.push(sum);
        }

        product
    }

    /// The component of w that a load prescribes.
    pub(super) fn component(&self, load: Load) -> usize {
        match load {
            Load::Held(node) => 2 * node,
            Load::Step(step) => self.rows.len() + step,
            Load::Gaps => self.columns() - 1,
        }
    }

    /// w with one unit of a load, and nothing else.
    pub(super) fn unit(&self, load: Load) -> Vec<Integer> {
        let mut unit = vec![Integer::zero(); self.columns()];
        unit[self.component(load)] = Integer::one();
        unit
    }
}

/// The components of w of the candidates that are open, or may open.
pub(super) fn open_components(states: &[ContactState]) -> Vec<usize> {
    let mut open = Vec::new();
    for (node, state) in states.iter().enumerate() {
        if matches!(state, ContactState::Free | ContactState::Zero) {
            open.extend([2 * node, 2 * node + 1]);
        }
    }

    open
}

#[cfg(test)]
impl Contact {
    /// Without gaps, all friction factors 1: what the tests of this crate begin with.
    pub(super) fn plain(stiffness: Vec<Vec<Rational>>, loads: Vec<Vec<Rational>>) -> Contact {
        let nodes = stiffness.len() / 2;
        Contact::new(ContactSide {
            stiffness,
            contents: vec![Rational::one(); loads.len()],
            loads,
            gaps: vec![Rational::zero(); nodes],
            friction_factors: vec![Rational::one(); nodes],
        })
        .unwrap()
    }
}

impl ContactSide {
    fn require_fitting_shapes(&self) -> Result<(), PathError> {
        let order = self.stiffness.len();
        let nodes = self.gaps.len();
        let rows = self.stiffness.iter().map(|row| ("condensed K", row));
        let loads = self.loads.iter().map(|load| ("condensed load", load));
        for (what, row) in rows.chain(loads) {
            require_length(what, row.len(), order)?;
        }
        if nodes == 0 {
            let what = "contact candidates";
            return Err(ModelError::Empty { what }.into());
        }
        require_length("contents of loads", self.contents.len(), self.loads.len())?;
        require_length("gaps", 2 * nodes, order)?;
        require_length("friction factors", self.friction_factors.len(), nodes)?;

        for factor in &self.friction_factors {
            require_positive("friction factor", factor)?;
        }
        for content in &self.contents {
            require_positive("content of a load", content)?;
        }

        match self.gaps.iter().position(Signed::is_negative) {
            None => Ok(()),
            Some(node) => Err(PathError::NegativeGap {
                node,
                got: self.gaps[node].clone(),
            }),
        }
    }

    /// C gap: what it would take to close all gaps by force.
    fn forces_of_the_gaps(&self) -> Vec<Rational> {
        let mut forces = Vec::with_capacity(self.stiffness.len());
        for row in &self.stiffness {
            let mut force = Rational::zero();
            for (node, gap) in self.gaps.iter().enumerate() {
                force += &row[2 * node + 1] * gap;
            }
            forces.push(force);
        }

        forces
    }
}

pub(super) fn require_length(
    what: &'static str,
    got: usize,
    expected: usize,
) -> Result<(), ModelError> {
    if got == expected {
        return Ok(());
    }

    Err(ModelError::Shape {
        equation: "E5",
        what,
        expected_rows: expected,
        expected_cols: 1,
        rows: got,
        cols: 1,
    })
}

/// What is imposed on the body, one unit of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Load {
    /// The load of a step.
    Step(usize),
    /// The candidates stand off the obstacle by their gaps.
    Gaps,
    /// A stuck candidate stands one unit along its tangent from its natural place.
    Held(usize),
}

/// Displacements and reactions of the candidates for one load each: w = `w` / `denominator`,
/// r = `r` / (`denominator` times that of the contact).
pub(super) struct Response {
    pub(super) denominator: Integer,
    /// By load, then by component.
    pub(super) w: Vec<Vec<Integer>>,
    /// By load, then by component.
    pub(super) r: Vec<Vec<Integer>>,
}

/// Displacements and reactions of all candidates, or their rates. Each of the two vectors is given
/// up to a positive factor: only signs and zeros are asked for.
#[derive(Clone, Copy)]
pub(super) struct NodalValues<'a> {
    /// u_T and u_N - gap of each candidate in turn, then amounts of loads.
    pub(super) w: &'a [Integer],
    /// r_T and r_N of each candidate in turn.
    pub(super) r: &'a [Integer],
}

/// The coefficient of friction of each candidate, mu times its factor.
#[derive(Debug, Clone)]
pub(super) struct FrictionCoefficients {
    coefficients: Vec<Rational>,
}

/// Coefficients of r_T and r_N in the condition that a candidate is on the friction cone: a
/// positive multiple of it, in integers.
pub(super) struct ConeRow {
    pub(super) tangential: Integer,
    pub(super) normal: Integer,
}

impl FrictionCoefficients {
    pub(super) fn new(mu: &Rational, contact: &Contact) -> FrictionCoefficients {
        let factors = contact.friction_factors().iter();
        FrictionCoefficients {
            coefficients: factors.map(|factor| mu * factor).collect(),
        }
    }

    /// The coefficient of friction of a candidate.
    pub(super) fn of(&self, node: usize) -> &Rational {
        &self.coefficients[node]
    }

    /// The combination of a slip node's rows that vanishes, r_T + S mu r_N = 0, times the
    /// denominator of its mu. // (7)
    pub(super) fn on_cone(&self, node: usize, sign: i8) -> ConeRow {
        let mu = self.of(node);
        ConeRow {
            tangential: mu.denom().clone(),
            normal: mu.numer() * Integer::from(sign),
        }
    }
}
