//! The free variables eliminated: the certificate's condensation and the f64 view of it.

use crate::search::complete::error::CompleteError;
use crate::search::complete::pieces::anchor::{COARSE, CONSTANT, FINE, centers, expand, expansion};
use crate::search::complete::pieces::blocks::{Blocks, lowest_frequency};
use crate::search::complete::pieces::skyline::Skyline;
use crate::search::complete::pieces::view::{Expansion, View, scale};
use crate::search::complete::pieces::{massless, reverse};
use crate::tolerance::TAIL_START;
use mceip_check::certificate::{Anchor, Condensation, Factor, IntegerMatrix, Tail};
use mceip_exact::{Integer, Rational, Sparse, from_f64, to_f64};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};

/// The condensation, its view and the interval of each anchor (upper ends; the last one open).
pub(crate) struct Condensed {
    pub(crate) condensation: Condensation,
    pub(crate) view: View,
    pub(crate) ends: Vec<f64>,
    /// Smallest eigenvalue of (A_ff, B_ff); zero where F does not depend on the unknown.
    pub(crate) base: f64,
    /// From where the reversed anchor, the last one, is used; up to infinity.
    pub(crate) beyond: Option<Rational>,
}

/// Condenses a pencil with free variables.
///
/// # Errors
/// [`CompleteError::NotDefinite`] where A_ff is not symmetric positive definite (in doubles) or
/// B_ff is indefinite.
pub(crate) fn condense(pencil: &Pencil, window: &Window) -> Result<Condensed, CompleteError> {
    let blocks = Blocks::of(pencil);
    for (what, asymmetric) in ["A_ff", "B_ff"].into_iter().zip(blocks.asymmetry) {
        if let Some(i) = asymmetric {
            return Err(CompleteError::NotDefinite {
                what,
                index: blocks.free[i],
            });
        }
    }
    let not_definite = |what| CompleteError::NotDefinite {
        what,
        index: blocks.free[0],
    };
    let plain = blocks
        .stiffness
        .cholesky()
        .ok_or_else(|| not_definite("A_ff"))?;
    let bound = blocks
        .stiffness
        .below_spectrum()
        .ok_or_else(|| not_definite("A_ff"))?;
    let sigma = short_below(0.8 * bound).ok_or_else(|| not_definite("A_ff"))?;
    let slack = 0.2 * bound;
    let factor = blocks
        .stiffness
        .shifted(-to_f64(&sigma) - slack)
        .cholesky()
        .ok_or_else(|| not_definite("A_ff"))?;
    let (mass_sigma, mass_factor) = mass_bound(
        &blocks.mass,
        &pencil.b().submatrix(&blocks.free, &blocks.free),
    )
    .map_err(|()| not_definite("B_ff"))?;
    let tail = if window.max().is_none() && !blocks.mass_is_zero {
        tail(pencil)
    } else {
        None
    };
    let from = |t: &Tail| to_f64(&t.from.0);
    let beyond = if window.max().is_none() && !blocks.mass_is_zero {
        reverse::beyond(pencil, [&sigma, &mass_sigma])
    } else {
        None
    };
    // A tail that begins further out (or does not) is left to the reversed pencil.
    let beyond = beyond.filter(|b| tail.as_ref().is_none_or(|t| from(t) > to_f64(&b.from)));
    let tail = if beyond.is_some() { None } else { tail };
    let top = beyond
        .as_ref()
        .map(|b| to_f64(&b.from))
        .or(tail.as_ref().map(from))
        .or(window.max().map(to_f64))
        .unwrap_or(f64::INFINITY);
    let base = if blocks.mass_is_zero {
        0.0
    } else {
        lowest_frequency(&blocks, &plain)
    };
    let (centers, ends) = centers(base, to_f64(window.min()), top);
    let mut anchors = Vec::new();
    let mut expansions = Vec::new();
    let precision = if blocks.mass_is_zero {
        CONSTANT
    } else {
        COARSE
    };
    for center in centers {
        let bounds = [to_f64(&sigma), to_f64(&mass_sigma)];
        let (anchor, expansion) = expand(pencil, &blocks, &center, bounds, precision)
            .ok_or_else(|| not_definite("A_ff + t B_ff"))?;
        anchors.push(anchor);
        expansions.push(expansion);
    }
    let beyond = beyond.map(|b| {
        anchors.push(b.anchor);
        expansions.push(b.expansion);
        b.from
    });
    let stiffness_factor = factor.rounded(slack);
    let condensation = Condensation {
        sigma: Number(sigma),
        stiffness_factor,
        mass_sigma: Number(mass_sigma),
        mass_factor,
        anchors,
        tail,
    };
    let view = View {
        index: blocks.slip.clone(),
        scale: scale(&expansions[0].z),
        expansions,
    };
    Ok(Condensed {
        condensation,
        view,
        ends,
        base,
        beyond,
    })
}

/// tau and the factor of B_ff - tau I; no factor where the block is diagonal.
fn mass_bound(mass: &Skyline, given: &Sparse) -> Result<(Rational, Option<Factor>), ()> {
    if mass.is_diagonal() {
        let least = mass.smallest_diagonal();
        return Ok((short_below(least).unwrap_or_default(), None));
    }
    // Without mass in some rows the bound is zero.
    let Some(bound) = mass.below_spectrum() else {
        return massless::factor(given)
            .map(|f| (Rational::default(), Some(f)))
            .ok_or(());
    };
    let tau = short_below(0.8 * bound).ok_or(())?;
    let slack = 0.2 * bound;
    Ok((
        tau.clone(),
        Some(
            mass.shifted(-to_f64(&tau) - slack)
                .cholesky()
                .ok_or(())?
                .rounded(slack),
        ),
    ))
}

/// Doublings from a millionth of |A| / |B| until the symmetric part is to be definite.
const TAIL_DOUBLINGS: i32 = 60;

/// Where the symmetric part of the whole pencil becomes definite, with its proof.
fn tail(pencil: &Pencil) -> Option<Tail> {
    let (a, b) = (
        Skyline::symmetric(pencil.a()),
        Skyline::symmetric(pencil.b()),
    );
    let mass_factor = match b.is_diagonal() {
        true => None,
        false => Some(massless::factor(pencil.b())?),
    };
    let start = a.largest() / b.largest() * TAIL_START;
    // Where sym(B) is positive definite, doubling comes to an end.
    let from = (0..TAIL_DOUBLINGS)
        .map(|k| start * f64::from(k).exp2())
        .find(|t| a.combine(*t, &b, 0.0).cholesky().is_some())?;
    let from = short_below(1.25 * from)?;
    let s = a.combine(to_f64(&from), &b, 0.0);
    let slack = s.below_spectrum()?;
    let factor = s.shifted(-slack).cholesky()?.rounded(slack);
    Some(Tail {
        from: Number(from),
        factor,
        mass_factor,
    })
}

/// Anchors about further values, appended to a condensation and its view.
pub(crate) fn refine(
    pencil: &Pencil,
    condensation: &mut Condensation,
    view: &mut View,
    values: &[f64],
) {
    let blocks = Blocks::of(pencil);
    let bounds = [
        to_f64(&condensation.sigma.0),
        to_f64(&condensation.mass_sigma.0),
    ];
    for value in values {
        let expanded = from_f64(*value)
            .ok()
            .and_then(|c| expand(pencil, &blocks, &c, bounds, FINE));
        if let Some((anchor, expansion)) = expanded {
            condensation.anchors.push(anchor);
            view.expansions.push(expansion);
        }
    }
}

/// The view that a certificate's condensation gives.
pub(crate) fn view_of(pencil: &Pencil, condensation: &Condensation) -> View {
    let blocks = Blocks::of(pencil);
    let bounds = [
        to_f64(&condensation.sigma.0),
        to_f64(&condensation.mass_sigma.0),
    ];
    let side = |list: &[IntegerMatrix]| {
        list.iter()
            .map(|m| columns_of(m, blocks.slip.len()))
            .collect::<Vec<_>>()
    };
    let one = |a: &Anchor| match reverse::swapped(pencil).filter(|_| a.reversed) {
        None => expansion(
            pencil,
            &blocks,
            to_f64(&a.center.0),
            bounds,
            &side(&a.right),
            &side(&a.left),
        ),
        Some(swapped) => {
            let [sigma, tau] = bounds;
            let (c, blocks) = (to_f64(&a.center.0), Blocks::of(&swapped));
            Expansion {
                reversed: true,
                ..expansion(
                    &swapped,
                    &blocks,
                    c,
                    [tau, sigma],
                    &side(&a.right),
                    &side(&a.left),
                )
            }
        }
    };
    let expansions: Vec<Expansion> = condensation.anchors.iter().map(one).collect();
    View {
        index: blocks.slip.clone(),
        scale: expansions.first().map_or(1.0, |e| scale(&e.z)),
        expansions,
    }
}

/// The columns of a rounded matrix, in doubles.
fn columns_of(m: &IntegerMatrix, cols: usize) -> Vec<Vec<f64>> {
    let entry = |v: &Integer| to_f64(&Rational::new(v.clone(), Integer::from(1) << m.exponent));
    (0..cols)
        .map(|j| m.rows.iter().map(|row| entry(&row[j])).collect())
        .collect()
}

/// A short number at most v, within a sixteenth of it.
fn short_below(v: f64) -> Option<Rational> {
    if !(v > 0.0 && v.is_finite()) {
        return None;
    }
    let unit = (v.log2().floor() - 4.0).exp2();
    from_f64((v / unit).floor() * unit).ok()
}
