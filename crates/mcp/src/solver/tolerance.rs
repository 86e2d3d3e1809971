//! Every tolerance of the solver's arithmetic, with unit, basis and reason. None decides a truth.

/// Smallest pivot, relative to the largest entry of the entering direction (at least 1). Unit:
/// none. Basis: about eps^(2/3); a smaller pivot would cost more than half the digits of the
/// inverse.
pub(super) const PIVOT: f64 = 1e-11;

/// Width of a tie in the ratio test, relative to 1 + the step. Unit: that of the step.
/// Basis: some thousand units of rounding; ties wider than that are left to the exact order.
pub(super) const TIE: f64 = 1e-12;

/// First width of a bound in the EXPAND-like ratio test. Unit: that of z and F. Basis: a thousandth
/// of what is allowed at the end (1e-9 beyond), so that early choices are nearly exact.
pub(super) const EXPAND_WIDTH: f64 = 1e-12;

/// By how much bounds widen with each pivot, and the least step times its pivot. Unit: that of z
/// and F. Basis: a path of 1000 pivots (`minor_iteration_limit`) ends within 1e-9.
pub(super) const EXPAND_STEP: f64 = 1e-12;

/// A row's sign over its bounds is sure if it exceeds this times the size of the row's terms. Unit:
/// none. Basis: a thousand times the rounding of a sum of some hundred terms.
pub(super) const SIGN_SURE: f64 = 1e-10;

/// Two components of lexicographic rows are equal within this, relative to the larger row.
/// Unit: none. Basis: rounding of one row times the first basis.
pub(super) const LEXICOGRAPHIC: f64 = 1e-11;

/// A column of the starting basis is dependent if elimination leaves less than this of it,
/// relative to its own largest entry. Unit: none. Basis: eps^(2/3), like [`PIVOT`].
pub(super) const DEPENDENT: f64 = 1e-11;

/// Largest error of the basic equations, relative to their right-hand side and the values, before
/// the basis is factorised afresh. Unit: none. Basis: 1e5 units of rounding leave ten digits.
pub(super) const DRIFT: f64 = 1e-11;

/// Pivots between two factorisations. Unit: pivots. Basis: product-form updates lose at most about
/// a bit each in the cases met; 25 leave half a double.
pub(super) const REFACTOR_EVERY: usize = 25;

/// How far along a terminating ray its point is taken, relative to 1 + |z|. Unit: none.
/// Basis: "a little": far enough to leave the last breakpoint, near enough for the linearisation.
pub(super) const RAY_STEP: f64 = 0.1;

/// Armijo fraction: decrease required per unit of t, or per unit of predicted decrease.
/// Unit: none. Basis: the usual 1e-4 (Dirkse and Ferris 1995, section 4).
pub(super) const ARMIJO: f64 = 1e-4;

/// Smallest t to which the search goes back along a path: 2^-12. Unit: that of t.
/// Basis: the linear model promises (1 - t)^2 of the merit; below this the promise is under 0.05 %.
pub(super) const SMALLEST_T: f64 = 1.0 / 4096.0;

/// Factor between two trial points of a search. Unit: none. Basis: bisection.
pub(super) const BACKTRACK: f64 = 0.5;

/// Trial steps of a projected-arc search. Unit: trials. Basis: 2^-40 of the first step is rounding.
pub(super) const ARC_TRIALS: usize = 40;

/// First trust radius of unchecked steps, relative to 1 + |x|. Unit: that of z.
/// Basis: unchecked steps may leave a valley, not the neighbourhood of the start.
pub(super) const TRUST: f64 = 10.0;

/// Factor on the trust radius after each unchecked step. Unit: none.
/// Basis: radii sum to a finite length, so unchecked steps alone stay bounded.
pub(super) const TRUST_SHRINK: f64 = 0.5;

/// A Newton step on the Fischer-Burmeister system takes the row of the minimum map for a component
/// one branch of which is this much nearer than the other; the second one, the minimum map itself,
/// by turns after steps that had to be shortened. Unit: none. Basis: a tenth changes the
/// derivatives of phi by under 1 %; measured with it alone, 0.3, 0.01 and 1e-4
/// (spec/measurements.md, D.4).
pub(super) const SEMISMOOTH_NEAR: [f64; 2] = [0.1, 1.0];

/// Smallest step of the search along such a direction. Unit: Newton steps.
/// Basis: measured; with 1/8 in place of 2^-7 most crashes of 20 unknowns end before they converge.
pub(super) const SEMISMOOTH_SMALLEST: f64 = 1.0 / 128.0;

/// Steps over which such a crash must reduce the merit. Unit: steps.
/// Basis: a step now and then gains little before Newton's rate sets in; four in a row do not.
pub(super) const SEMISMOOTH_WINDOW: usize = 4;

/// To what part of itself it must. Unit: none. Basis: a good step is good for 1/4 and less.
pub(super) const SEMISMOOTH_GAIN: f64 = 0.5;

/// Relative reduction of the merit below which a crash step is not worth another. Unit: none.
/// Basis: Newton steps on the right active set gain far more; path steps take over.
pub(super) const CRASH_GAIN: f64 = 1e-2;

/// Smallest step of the crash search. Unit: Newton steps. Basis: 2^-10, then the path is better.
pub(super) const CRASH_SMALLEST: f64 = 1.0 / 1024.0;

/// Proximal term of a singular crash factor: this times sqrt of the merit, at most this, relative
/// to the largest Jacobian entry. Unit: none. Basis: vanishes with the merit, so Newton's rate
/// survives.
pub(super) const CRASH_PROXIMAL: f64 = 1e-2;

/// Least proximal term of a singular crash factor, relative to the largest Jacobian entry.
/// Unit: none. Basis: eps^(1/2), the least that regularises visibly.
pub(super) const CRASH_PROXIMAL_LEAST: f64 = 1e-8;

/// Proximal term of a restart that has one, relative to the largest Jacobian entry, at merits of 1
/// and above; it falls with the root of the merit. Unit: none. Basis: visible, not dominant.
pub(super) const RESTART_PROXIMAL: f64 = 1e-2;

/// By how much restarts move the user's start, relative to 1 + |z_i|. Unit: none.
/// Basis: measured on random pencils; less stays in the same cycle of Newton points.
pub(super) const RESTART_SHIFT: [f64; 2] = [0.3, 1.0];

/// Fraction of a path that a damped restart takes. Unit: that of t. Basis: halving breaks cycles of
/// two and three Newton points; while the merit falls by (1 - 1/2)^2 a step it costs little.
pub(super) const RESTART_FRACTION: f64 = 0.5;

/// A damped restart takes whole paths below this merit relative to its first. Unit: none.
/// Basis: five halvings, then Newton's rate is wanted.
pub(super) const NEAR: f64 = 1e-3;

/// Relative gain of merit below which a projected-gradient step counts as none. Unit: none.
/// Basis: rounding of a sum of squares.
pub(super) const GRADIENT_GAIN: f64 = 1e-12;

/// Factor on the reference of an attempt with free acceptance. Unit: none.
/// Basis: a reference that only a run to infinity would miss; the tenth step still has to pass it.
pub(super) const FREE_REFERENCE: f64 = 1e4;

/// Multipliers of a curve's start are lifted off zero by this, relative to the size of F up to 1.
/// Unit: that of F. Basis: any positive number gives a curve; a tenth keeps events apart.
pub(super) const CURVE_LIFT: f64 = 0.1;

/// Residual of the curve's equations at a corrected point, relative to 1 + |s| |r|. Unit: none.
/// Basis: Newton's last step overshoots it by far; solutions are polished afterwards.
pub(super) const CURVE_RESIDUAL: f64 = 1e-9;

/// To what part of itself a correction's step must bring the residual for its factors to be kept.
/// Unit: none. Basis: three such steps reach [`CURVE_RESIDUAL`] from the size of a usual
/// prediction's, 1e-3 and less.
pub(super) const CURVE_KEPT: f64 = 0.01;

/// Newton steps of one correction. Unit: steps. Basis: more mean that the prediction was too far.
pub(super) const CURVE_STEPS: usize = 6;

/// Least cosine between the tangents before and after a step. Unit: none. Basis: 45 degrees.
pub(super) const CURVE_ANGLE: f64 = 0.7;

/// Where a curve counts as gone to infinity, relative to 1 + |start|. Unit: none.
/// Basis: steps double, so a factor of ten costs three of them; values beyond are left to windows.
pub(super) const CURVE_FAR: f64 = 1e5;

/// A guarded quantity may be this negative, relative to 1 + |s|. Unit: that of z and F.
/// Basis: ten times the residual of a corrected point.
pub(super) const CURVE_FEASIBLE: f64 = 1e-8;

/// First step along a curve. Unit: that of z and s. Basis: a tenth of the start's s.
pub(super) const CURVE_FIRST: f64 = 0.1;

/// Factor on the step after an easy correction. Unit: none. Basis: doubling.
pub(super) const CURVE_GROWTH: f64 = 2.0;

/// Shortest step. Unit: that of z and s. Basis: thousands of events could lie on a unit length.
pub(super) const CURVE_SHORTEST: f64 = 1e-9;

/// A curve that left a solution is closed if it meets a point this near to it, relative to
/// 1 + |z|. Unit: none. Basis: a thousand times the residual of a corrected point.
pub(super) const CURVE_SAME: f64 = 1e-6;

/// Points from which curves are followed after the last restart. Unit: points.
/// Basis: not tuned; a bound on the cost of a failure (twelve curves), after everything else.
pub(super) const CURVE_TRIALS: usize = 6;

/// Factor on the distance of those points from the start after every second one. Unit: none.
/// Basis: 1, 4 and 16 times 1 + |z_i|; a start in a pocket whose curves all run off was left by the
/// second distance (random lambda^2 pencils), never by more points at the first.
pub(super) const CURVE_TRIAL_GROWTH: f64 = 4.0;

/// A curve is closed if it passes its start's s at this share of the step from the start, on the
/// same places. Unit: none. Basis: the error of the chord between two points 45 degrees apart.
pub(super) const CURVE_CLOSED: f64 = 0.05;

/// Order of the largest sparse Jacobian of which a dense matrix is made, for paths and curves.
/// Unit: unknowns. Basis: 32 MB a matrix; a factorisation of that order takes about a second, and a
/// path one for every 25 pivots.
pub(super) const DENSE_ORDER: usize = 2000;

/// Squares above this and below its inverse are safe: a smaller term lost to underflow is below
/// rounding. Unit: none. Basis: the least normal double (2e-308) times 1e32.
pub(super) const SQUARE_SAFE: f64 = 1e-275;

/// Slack of the bound |Phi|_inf^2 <= 2 Psi <= n |Phi|_inf^2 that spares the residuals of points far
/// from the tolerance. Unit: none. Basis: rounding of a sum of squares is far below it.
pub(super) const MERIT_SLACK: f64 = 1.01;
