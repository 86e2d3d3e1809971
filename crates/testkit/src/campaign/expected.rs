//! What is known of an instance by construction, and an instance as a family makes it.

use crate::families::{Corner, Instance};
use mceip_exact::Rational;
use mceip_model::Problem;
use mceip_oracle::Enumeration;

/// What is known of an instance by construction.
#[derive(Debug, Clone, Default)]
pub struct Expected {
    /// The whole answer.
    pub answer: Option<Enumeration>,
    /// How many solutions there are.
    pub count: Option<usize>,
    /// A solution: the value and x over all variables of the pencil.
    pub planted: Option<(Rational, Vec<Rational>)>,
}

/// An instance as a family makes it. Its label is set by [`super::case`].
#[derive(Debug, Clone)]
pub struct Made {
    /// The problem, with Table 1's data and the corners known by construction.
    pub instance: Instance,
    /// What else is known by construction.
    pub expected: Expected,
}

impl Made {
    /// An instance of whose answer nothing is known.
    pub(super) fn new(problem: Problem, corners: Vec<Corner>) -> Made {
        Made {
            instance: Instance::new(String::new(), problem, corners),
            expected: Expected::default(),
        }
    }
}

impl From<Instance> for Made {
    fn from(instance: Instance) -> Made {
        Made {
            instance,
            expected: Expected::default(),
        }
    }
}
