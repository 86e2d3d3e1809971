//! Exact arithmetic: rationals, matrices over Q, integer polynomials, real algebraic numbers.
//!
//! Everything here is decided without floats. `double` is the one file that converts to and from
//! them. The crates that decide (`oracle`, `check`) build on this one and on `model` alone.
//!
//! Numbers: `ratio` and `rational` (Q, and its spelling), `interval` (closed intervals over Q),
//! `quadratic` (a + b sqrt d), `decimal` and `double` (for people and for solvers).
//!
//! Matrices over Q: `sparse` and `dense`, `definite` and `definite_short` (is a matrix positive
//! definite?), `modular` and `prime` (Schur complements of large matrices, modulo primes).
//!
//! The unknown t: `poly` and `poly_gcd` (`Z[t]`), `roots` (isolation of real roots), `algebraic`
//! (signs at a root), `kernel` and `cofactor` (of A + tB), `cone` (polyhedral cones at a root).
#![deny(clippy::float_arithmetic)]

mod algebraic;
mod cofactor;
mod cone;
mod decimal;
mod definite;
mod definite_short;
mod dense;
mod dominance;
mod double;
mod interval;
mod kernel;
mod modular;
mod poly;
mod poly_gcd;
mod prime;
mod quadratic;
mod ratio;
mod rational;
mod roots;
mod sparse;

pub use algebraic::{Algebraic, Sign, simplest_between};
pub use cofactor::first_row_cofactors;
pub use cone::{Generators, cone_generators, dot};
pub use decimal::{
    enclosing_decimals, nearest_decimal, ratio_to_decimal, to_decimal, upper_decimal, without_zeros,
};
pub use definite::{
    DefiniteError, Minor, NotDefinite, first_minor_not_positive, positive_definite,
};
pub use dense::Dense;
pub use dominance::{Dominance, MachineRow, machine_definite};
pub use double::{enclosing_doubles, from_f64, to_f64, truncated};
pub use interval::Interval;
pub use kernel::{
    determinant, generic_kernel, kernel_and_free_columns_at, kernel_at, minors, row_echelon_at,
    submatrix,
};
pub use modular::{CondenseError, Residues, schur_complement};
pub use poly::Poly;
pub use prime::{Field, primes};
pub use quadratic::Quadratic;
pub use ratio::Rational;
pub use rational::{
    Integer, MAX_EXPONENT, MAX_SPELLING, NumberError, cleared, common_denominator, parse, rational,
    whole,
};
pub use roots::{nonnegative_roots, roots_in};
pub use sparse::Sparse;
