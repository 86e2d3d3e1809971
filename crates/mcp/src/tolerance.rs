//! Tolerances of the linear algebra and of finite differences, with unit, basis and reason. None
//! decides a truth. Those of the solver stand in `solver/tolerance.rs`.

/// Largest difference of mirrored entries of a symmetric matrix in doubles, relative to the larger
/// of their diagonal entries. Unit: none. Basis: element matrices round by a few units in the last
/// place (8, `doubles` of `mceip-paper` tests it); data printed with twelve digits or fewer should
/// be mirrored first.
pub(crate) const ASYMMETRY: f64 = 1e-13;

/// Smallest pivot of a sparse Cholesky factor, relative to the diagonal entry of the matrix. Unit:
/// none. Basis: sums of some hundred terms round to 1e-14; a singular matrix leaves pivots of that
/// size and either sign, an elastic body that is held leaves above 1e-6.
pub(crate) const SINGULAR_PIVOT: f64 = 1e-13;

/// Step of a finite difference, relative to max(1, |z_i|). Unit: that of z. Basis: eps^(1/3), at
/// which truncation, of second order, and rounding of F are of the same size.
pub(crate) const DIFFERENCE_STEP: f64 = 6e-6;

/// Relative difference up to which a given entry of F' agrees with differences. Unit: none.
/// Basis: they are good for eps^(2/3), about 4e-11, where F is smooth at the scale of the step.
pub(crate) const DIFFERENCE_AGREEMENT: f64 = 1e-6;

/// An entry disagrees beyond this times its doubt: what halved steps and rounding of F change.
/// Unit: none. Basis: halved steps leave a quarter of the error; F rounds by more than its last
/// place where its terms cancel.
pub(crate) const DIFFERENCE_DOUBT: f64 = 10.0;
