//! Regions and enclosures of order 2 for the unit tests of leaves.

use super::ball::BallMatrix;
use super::ends::{Ends, LongMatrix};
use super::region::Region;
use crate::certificate::VariableState;
use mceip_exact::{Integer, Rational};
use num_traits::{One, Zero};

pub(super) type Square = [[i64; 2]; 2];

/// The variables' indices in the problem.
pub(super) const INDEX: [usize; 2] = [10, 11];
pub(super) const ZERO: Square = [[0, 0], [0, 0]];
pub(super) const UNDECIDED: [VariableState; 2] = [VariableState::Undecided; 2];

fn matrix(m: Square) -> LongMatrix {
    m.map(|row| row.map(Integer::from).to_vec()).to_vec()
}

pub(super) fn region(states: [VariableState; 2]) -> Region {
    Region {
        states: states.to_vec(),
        ..Region::new(
            Rational::zero().into(),
            Some(Rational::one().into()),
            None,
            0,
        )
    }
}

pub(super) fn ends(m: [Square; 2], r: [Square; 2], infinite: bool) -> Ends {
    Ends {
        at: [0, 1].map(|end| BallMatrix {
            m: matrix(m[end]),
            r: matrix(r[end]),
        }),
        slope: None,
        scale: 1.into(),
        infinite,
    }
}
