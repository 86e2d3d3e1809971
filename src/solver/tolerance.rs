//! Every tolerance of the solver's arithmetic, with unit, basis and reason.

/// Smallest pivot, relative to the largest entry of the entering direction. Unit: none.
/// Basis: eps^(2/3); smaller pivots lose more than half the digits of the basis inverse.
pub(super) const PIVOT: f64 = 1e-11;

/// Width of a tie in the ratio test, relative to 1 + the step. Unit: that of t.
/// Basis: a few hundred units of rounding after the pivots between two refactorisations.
pub(super) const TIE: f64 = 1e-12;

/// Pivots between refactorisations of the basis. Basis: product-form updates lose about a bit each
/// in the worst case met; 24 leave half a double.
pub(super) const REFACTOR_EVERY: usize = 24;

/// Largest |B B^-1 - I| entry after a refactorisation that is taken as regular. Unit: none.
pub(super) const REGULAR: f64 = 1e-6;

/// Proximal perturbations tried when the linearisation's starting basis is singular, relative to the
/// largest entry of the Jacobian. Basis: PATH's own ladder starts near eps^(1/2) and grows.
pub(super) const PROXIMAL: [f64; 4] = [0.0, 1e-8, 1e-5, 1e-2];

/// Required decrease per unit of t in the non-monotone test, the usual Armijo fraction.
pub(super) const ARMIJO: f64 = 1e-4;

/// Smallest t the search along the path goes back to: 2^-12. Below it a step is no progress.
pub(super) const SMALLEST_STEP: f64 = 1.0 / 4096.0;

/// A ray or cycle that has passed this t is still worth its end point. Basis: the merit falls with
/// (1 - t)^2 along the linearised path.
pub(super) const USEFUL_T: f64 = 0.05;
