//! Leaf `tail`: above some value the symmetric part of the whole pencil is definite.
//!
//! If sym(A + t0 B) is positive definite and sym(B) positive semidefinite, sym(A + tB) is definite
//! for every t >= t0, and a solution would have 0 < x'(A + tB)x = x'y = 0. The evidence stands in
//! the condensation, once for all pieces above t0; the leaf only refers to it. The checker's side
//! is `check::cover::condensed::tail`.
//!
//! Called while the window is cut into pieces (`pieces::condense`).

use crate::search::complete::dyadic::short_below;
use crate::search::complete::pieces::massless;
use crate::search::complete::pieces::skyline::Skyline;
use crate::tolerance::TAIL_START;
use mceip_check::certificate::{Factor, Tail};
use mceip_exact::{Rational, Sparse, to_f64};
use mceip_model::Pencil;
use mceip_model::file::Number;

/// Doublings from a millionth of |A| / |B| until the symmetric part is to be definite.
const TAIL_DOUBLINGS: i32 = 60;

/// Where the symmetric part of the whole pencil becomes definite, with its proof.
pub(crate) fn tail(pencil: &Pencil) -> Option<Tail> {
    let a = Skyline::symmetric(pencil.a());
    let b = Skyline::symmetric(pencil.b());
    let mass_factor = semidefinite(pencil.b())?;

    // Where sym(B) is positive definite, doubling comes to an end.
    let start = a.largest_diagonal() / b.largest_diagonal() * TAIL_START;
    let definite_from = (0..TAIL_DOUBLINGS)
        .map(|k| start * f64::from(k).exp2())
        .find(|t| a.combine(*t, &b).cholesky().is_some())?;

    let from = short_below(1.25 * definite_from)?;
    Some(Tail {
        factor: definite_at(pencil, &from)?,
        from: Number(from),
        mass_factor,
    })
}

/// The factor that proves sym(A + tB) positive definite at a value t; `None` where it is not.
pub(crate) fn definite_at(pencil: &Pencil, value: &Rational) -> Option<Factor> {
    let a = Skyline::symmetric(pencil.a());
    let b = Skyline::symmetric(pencil.b());
    a.combine(to_f64(value), &b).factor_of_definite()
}

/// The factor that proves sym(B) positive semidefinite, none for a non-negative diagonal; `None`
/// where it is not.
#[allow(
    clippy::option_option,
    reason = "not needed is not the same as not there"
)]
pub(crate) fn semidefinite(b: &Sparse) -> Option<Option<Factor>> {
    if Skyline::symmetric(b).is_diagonal() {
        return Some(None);
    }

    massless::factor(b).map(Some)
}
