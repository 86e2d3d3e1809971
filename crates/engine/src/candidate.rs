//! A claimed solution in doubles, untrusted: what solvers and reports hand to `certify`.

/// The format of solution reports.
pub const SOLUTIONS_FORMAT: &str = "mceip-solutions/1";

/// A claimed solution: a value of the unknown and x over the variables of the pencil.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The value of lambda^2 or mu.
    pub value: f64,
    /// x, in any positive scale.
    pub x: Vec<f64>,
}
