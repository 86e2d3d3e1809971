//! Dense and sparse factorisations in doubles.
//!
//! | file | what |
//! |---|---|
//! | `dense` | dense factorisations, the kernels of a front, sparse LU: the one file that names faer |
//! | `symmetric` | sparse symmetric matrices |
//! | `dissection` | nested dissection: the order of elimination |
//! | `analysis` | which fronts there are, and who passes what to whom |
//! | `multifrontal` | Cholesky factors and Schur complements, front by front |

mod analysis;
mod dense;
mod dissection;
mod multifrontal;
mod symmetric;

pub use analysis::Analysis;
pub use dense::{SparseLu, definite_eigenvalues, eigenvalues, inverse, solve};
pub use multifrontal::{NotDefinite, SchurFactor};
pub use symmetric::{Symmetric, SymmetricError};
