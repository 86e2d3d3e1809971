//! What is known of an instance by construction, and an instance as a family makes it.

use crate::families::Instance;
use mceip_exact::Rational;
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

pub(super) type Made = (Instance, Expected);
