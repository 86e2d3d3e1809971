//! Tolerances of the linear algebra, with unit, basis and reason. None decides a truth.
//! Those of the solver stand in `solver/tolerance.rs`.

/// Largest difference of mirrored entries of a symmetric matrix in doubles, relative to the larger
/// of their diagonal entries. Unit: none. Basis: element matrices round by a few units in the last
/// place (8, `doubles` of `mceip-paper` tests it); data printed with twelve digits or fewer should
/// be mirrored first.
pub(crate) const ASYMMETRY: f64 = 1e-13;

/// Smallest pivot of a sparse Cholesky factor, relative to the diagonal entry of the matrix. Unit:
/// none. Basis: sums of some hundred terms round to 1e-14; a singular matrix leaves pivots of that
/// size and either sign, an elastic body that is held leaves above 1e-6.
pub(crate) const SINGULAR_PIVOT: f64 = 1e-13;
