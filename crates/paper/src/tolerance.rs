//! Tolerances of the loading path and of results read from other programs, with unit, basis and
//! reason. None decides a truth.

/// Sizes of displacements and reactions, relative to the largest of the step, that incremental
/// stepping takes for zero. Unit: none. Basis: the condensed equations have condition numbers below
/// 1e5, so rounding stays below 1e-10; signs below that are not worth a change of state.
pub(crate) const STEP_SIGN: f64 = 1e-10;

/// Relative distance from the friction cone within which a reaction of a finite-element program
/// counts as on it (numerator, denominator). Unit: none. Basis: such programs iterate on contact to
/// 1e-3 to 1e-6 of the reaction; states are given, the reaction only guards against a wrong sign or
/// another mu.
pub(crate) const CONE_SLACK: (i64, i64) = (1, 1000);
