//! Where on a path the body is held by rounding alone: an opinion in doubles, on which nothing
//! rests.
//!
//! A body whose supports do not hold it has, with candidates open, a motion that takes no force.
//! In a K of doubles this motion has a stiffness of the last digits, and an exact path goes on with
//! displacements that mean nothing. What is looked at is the smallest eigenvalue of the rows and
//! columns of the condensed stiffness C that can move, beside the largest of C.
#![allow(clippy::float_arithmetic)]

use super::contact::{Contact, open_components};
use super::loading_path::LoadingPath;
use super::stretch::Stretch;
use mceip_model::ContactState;
use nalgebra::DMatrix;

impl Contact {
    /// The stretches in whose states the body is held by rounding alone, in order: the stiffness
    /// against motions of the candidates that can move there is below 1e-10 of the largest. Such a
    /// body can move without force, but for the last digits of K.
    pub fn held_by_rounding(&self, path: &LoadingPath) -> Vec<usize> {
        let order = 2 * self.nodes();
        let stiffness = self.rows_f64();
        if stiffness.iter().flatten().any(|entry| !entry.is_finite()) {
            return Vec::new(); // no opinion on what doubles cannot hold
        }
        let stiffness = DMatrix::from_fn(order, order, |i, j| stiffness[i][j]);
        let all = stiffness.symmetric_eigenvalues();
        let least_allowed = HELD * all.amax();
        // No part has a smaller eigenvalue than the whole.
        if all.min() >= least_allowed {
            return Vec::new();
        }

        let is_loose = |stretch: &Stretch| {
            let movable = movable(&stretch.states);
            if movable.is_empty() {
                return false;
            }
            let part = stiffness.select_rows(&movable).select_columns(&movable);
            part.symmetric_eigenvalues().min() < least_allowed
        };
        let stretches = path.stretches.iter().enumerate();
        let loose = stretches.filter(|(_, stretch)| is_loose(stretch));
        loose.map(|(k, _)| k).collect()
    }
}

/// The components of w that nothing holds in these states.
fn movable(states: &[ContactState]) -> Vec<usize> {
    let mut movable = open_components(states);
    for (node, state) in states.iter().enumerate() {
        if matches!(state, ContactState::Slip { .. }) {
            movable.push(2 * node);
        }
    }

    movable
}

/// Less of the largest stiffness than this is rounding: entries in doubles have 16 digits, and the
/// sums of an assembly lose some of them.
const HELD: f64 = 1e-10;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LoadSteps, LoadingPath};
    use mceip_exact::{Rational, rational, whole};
    use std::ops::ControlFlow;

    /// One candidate, stiff along the floor, with this stiffness normal to it, is pulled off.
    fn loose_stretches(normal: Rational) -> Vec<usize> {
        let stiffness = vec![vec![whole(1), whole(0)], vec![whole(0), normal]];
        let contact = Contact::plain(stiffness, vec![vec![whole(0), whole(-1)]]);
        let steps = LoadSteps::new(whole(1), vec![Some(whole(1))]);
        let follow = LoadingPath::follow(&contact, &steps, &|_| ControlFlow::Continue(()));
        contact.held_by_rounding(&follow.unwrap())
    }

    #[test]
    fn a_stiffness_of_last_digits_holds_nothing() {
        assert_eq!(loose_stretches(rational(1, 1_000_000_000_000_000)), [0]);
        assert!(loose_stretches(rational(1, 1_000_000_000)).is_empty());
    }
}
