//! The pencil on the complementarity variables in doubles, row for row in the scale of the checker.
//!
//! Without free variables the view is A + tB, one expansion that holds for every value. With free
//! variables it is the Schur complement about each anchor of the condensation. The search measures
//! intervals by theta = t / (scale + t), which maps [0, infinity] to [0, 1].

use super::expansion::Expansion;
use super::matrix::{SquareMatrix, largest_entry, zeros};
use crate::search::complete::region::{SearchRegion, support};
use mceip_check::certificate::VariableState;
use mceip_exact::{Integer, Rational, cleared, common_denominator, to_f64};
use mceip_model::{Pencil, ZeroVariables};
use num_traits::One;

/// The pencil on the complementarity variables: one polynomial matrix, or several about their
/// centres.
#[derive(Clone)]
pub(crate) struct View {
    /// Complementarity variables by position.
    pub(crate) index: Vec<usize>,
    /// Scale of the unknown: |A| / |B|.
    pub(crate) scale: f64,
    /// One per anchor; at least one.
    pub(crate) expansions: Vec<Expansion>,
    /// The variables of the particles in contact with zero reaction, by their numbers.
    pub(crate) zero: Vec<ZeroVariables>,
}

impl View {
    /// The view of a pencil without free variables.
    pub(crate) fn of(pencil: &Pencil) -> View {
        let order = pencil.order();
        let mut a = zeros(order);
        let mut b = zeros(order);

        for i in 0..order {
            let factor = row_factor(pencil, i);
            for (j, v) in pencil.a().row(i) {
                a[i][*j] = to_f64(&(v * &factor));
            }

            for (j, v) in pencil.b().row(i) {
                b[i][*j] = to_f64(&(v * &factor));
            }
        }

        let expansion = Expansion::linear(a, b);
        View {
            index: (0..order).collect(),
            scale: scale_of(&expansion.coefficients),
            expansions: vec![expansion],
            zero: Vec::new(),
        }
    }

    /// The part of a region in which the variable at this position has this state. Where it is a
    /// half of v_T of a particle with zero reaction and moves, the other half is at rest.
    pub(crate) fn part(
        &self,
        region: &SearchRegion,
        position: usize,
        state: VariableState,
    ) -> SearchRegion {
        let mut part = region.clone();
        part.states[position] = state;
        if state == VariableState::InSupport
            && let Some(other) = self.other_half(position)
        {
            part.states[other] = VariableState::AtZero;
        }

        part
    }

    /// The position of the other half of v_T, if this one is of a particle with zero reaction.
    pub(crate) fn other_half(&self, position: usize) -> Option<usize> {
        let variable = self.index[position];
        for zero in &self.zero {
            if variable == zero.right {
                return self.position(zero.left);
            }
            if variable == zero.left {
                return self.position(zero.right);
            }
        }

        None
    }

    /// A half of v_T that is undecided as the other one is. No leaf closes such a region: the
    /// vector that is 1 at both halves and 0 elsewhere solves at every value
    /// (`spec/zero-reaction.md`, Z.3).
    pub(crate) fn undecided_half(&self, states: &[VariableState]) -> Option<usize> {
        self.zero.iter().find_map(|zero| {
            let right = self.position(zero.right)?;
            let left = self.position(zero.left)?;
            let is_open = [right, left].map(|half| states[half] == VariableState::Undecided);
            (is_open == [true, true]).then_some(left)
        })
    }

    /// The variables at rest of which y = 0 follows from y = 0 on the support.
    pub(crate) fn vanishing(&self, states: &[VariableState]) -> Vec<usize> {
        let support = self.variables(&support(states));
        let of_each = self.zero.iter().map(|zero| zero.vanishing(&support));
        of_each.flatten().collect()
    }

    /// The expansion of a piece with this anchor. Without a condensation there is one, and anchors
    /// are ignored.
    pub(crate) fn expansion(&self, anchor: Option<usize>) -> &Expansion {
        let named = anchor.and_then(|k| self.expansions.get(k));
        named.unwrap_or(&self.expansions[0])
    }

    /// Number of complementarity variables.
    pub(crate) fn order(&self) -> usize {
        self.index.len()
    }

    /// Position of a variable of the pencil, if it is a complementarity variable.
    pub(crate) fn position(&self, variable: usize) -> Option<usize> {
        let mut variables = self.index.iter();
        variables.position(|&i| i == variable)
    }

    /// The variables of the pencil at these positions.
    pub(crate) fn variables(&self, positions: &[usize]) -> Vec<usize> {
        let mut variables = Vec::with_capacity(positions.len());
        for &position in positions {
            variables.push(self.index[position]);
        }

        variables
    }

    /// Place of t in [0, 1]: t / (scale + t).
    pub(crate) fn theta(&self, t: f64) -> f64 {
        if t.is_infinite() {
            1.0
        } else {
            t / (self.scale + t)
        }
    }

    /// The value with this theta.
    pub(crate) fn value(&self, theta: f64) -> f64 {
        self.scale * theta / (1.0 - theta)
    }
}

/// What the checker multiplies row i by: denominators cleared, largest entry of A below one.
pub(crate) fn row_factor(pencil: &Pencil, i: usize) -> Rational {
    common_row_factor(&[pencil], &[], i)
}

/// The same for several pencils whose rows i are multiplied by one factor; it clears the
/// denominators of their radii as well.
pub(crate) fn common_row_factor(pencils: &[&Pencil], radii: &[&Pencil], i: usize) -> Rational {
    let of_a = pencils.iter().flat_map(|pencil| pencil.a().row(i));
    let all = pencils.iter().chain(radii);
    let entries = all.flat_map(|pencil| pencil.a().row(i).iter().chain(pencil.b().row(i)));
    let clear = common_denominator(entries.map(|(_, v)| v));

    let mut bits = 1;
    for (_, v) in of_a {
        bits = cleared(v, &clear).bits().max(bits);
    }

    Rational::new(clear, Integer::one() << bits)
}

/// Ratio of the largest entries of the first two coefficients, 1 where that says nothing.
pub(crate) fn scale_of(coefficients: &[SquareMatrix]) -> f64 {
    let a = largest_entry(&coefficients[0]);
    let b = largest_entry(&coefficients[1]);
    if a > 0.0 && b > 0.0 && (a / b).is_finite() {
        a / b
    } else {
        1.0
    }
}
