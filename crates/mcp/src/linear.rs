//! Dense and sparse factorisations in doubles.
//!
//! A sparse symmetric matrix [F B; B' C] is factored in three steps: `SymbolicAnalysis::new` finds
//! an order of elimination from its pattern, `SymbolicAnalysis::factor` computes the Cholesky
//! factor of F and the Schur complement C - B' F^-1 B, and the `SchurFactor` solves with both. The
//! engine eliminates the unknowns of a body that are free of contact in this way. Nothing here is
//! certified.
//!
//! | file | what |
//! |---|---|
//! | `dense` | dense factorisations, the kernels of a front, sparse LU; only here faer is named |
//! | `symmetric` | sparse symmetric matrices |
//! | `dissection` | nested dissection: the order of elimination |
//! | `analysis` | which fronts there are, and who passes what to whom |
//! | `multifrontal` | Cholesky factors and Schur complements, front by front |

mod analysis;
mod dense;
mod dissection;
mod multifrontal;
mod symmetric;

pub use analysis::SymbolicAnalysis;
pub use dense::{
    Eigenvalue, SparseLu, definite_eigenvalues, eigenvalues, inverse, sensitive_eigenvalues, solve,
};
pub use multifrontal::{PivotNotPositive, SchurFactor};
pub use symmetric::{Symmetric, SymmetricError};
