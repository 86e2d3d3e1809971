//! Tolerances of the integration, with unit, basis and reason. None decides a truth: nothing that
//! this crate says is proved.

/// Slip velocity or impulse below which a sign is put down to rounding in the problem of a step.
/// Unit: share of the largest entry of the two vectors. Basis: sums of some hundred terms.
pub(crate) const STEP_SIGN: f64 = 1e-13;

/// Pivot of the matrix of a step, scaled to ones on its diagonal, within which its sign is not
/// decided. Unit: none. Basis: Schur complements of order 20 in doubles keep 1e-13 of entries of
/// order one; the elimination of the free coordinates loses the digits of its condition, below 1e3.
pub(crate) const MINOR: f64 = 1e-9;

/// Rounding of a run, relative to the forces that cancel in it, before that of each step is added.
/// Unit: none. Basis: some hundred roundings of 2^-53. Reason: with alpha'' = lambda^2 alpha the
/// forces K v are larger than lambda^2 M v by the square of frequency over growth rate, and their
/// rounding acts in every step.
pub(crate) const ROUNDING: f64 = 1e-13;

/// Share of a displacement beside v up to which a motion is along v. Unit: elastic norm. Basis: the
/// discrete motion keeps v exactly, rounding apart; other motions that grow faster than the mode
/// enlarge that rounding by exp of their rate times the time.
pub(crate) const BESIDE: f64 = 1e-6;

/// What a motion beside v may change of alpha, as a multiple of its share. Unit: none. Basis: alpha
/// is read off along v; another motion at an angle of 6 degrees to v changes it by ten times what
/// it has across v.
pub(crate) const OF_BESIDE: f64 = 10.0;

/// Stated error of alpha beyond which a run along a mode says nothing. Unit: share of alpha. Basis:
/// the leading term (h lambda)^2 lambda t / 12 tells the error while it is small.
pub(crate) const UNRESOLVED: f64 = 5e-2;

/// Difference of the growth rates of a run in steps of h and of h/2 up to which the steps resolve
/// it. Unit: share of the rate. Basis: the rate of a smooth growth has the relative error
/// (h lambda)^2 / 12; where frequencies that take part are not resolved it changes by half.
pub(crate) const SAME_RATE: f64 = 5e-2;

/// Turn of the displacement within the last quarter of a run up to which its direction counts as
/// constant. Unit: distance of unit vectors in the elastic norm. Basis: a run that has grown along
/// one direction for several times 1/lambda turns by exp of minus that; flutter and stick-slip turn
/// by about one.
pub(crate) const TURN: f64 = 1e-3;
