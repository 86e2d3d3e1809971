//! Absence below a friction: a cover of (supports) x [0, infinity) x [from, below].
//!
//! For a mechanical system T(t, mu) = T0(t) + mu T1(t), with t = lambda^2. Trees are those of
//! `walk`, their regions have an interval of mu as well, and their leaves prove that a region holds
//! no solution: `farkas` and `definite` by what is linear in T at the four corners of the region
//! (`context`), `regular` by what is convex in T.
//!
//! *Tail.* Above some t sym(A + tB) of the whole pencil is positive definite, and sym(B) is
//! semidefinite, at mu = `from` and at mu = `below`, so at every mu between. The pencil is that of
//! the system in which the particles with zero reaction are free (`spec/zero-reaction.md`, Z.4).
//!
//! *Members.* Where the data have radii, all this is proved of every member at once: the ends of a
//! region hold the matrices of all of them (`context`).
//!
//! *Zero reaction.* Particles in contact with zero reaction have three variables each, whose rows
//! are affine in mu as well. A branch on one half of v_T puts the other half at rest where the
//! first one moves.

use super::budget;
use super::condensed::{AnchoredPiece, PencilParts};
use super::context::Context;
use super::fault::CoverFault;
use super::walk::{Audit, CoverWalk, FaultAt};
use super::{anchors, condensed};
use crate::certificate::{CriticalCertificate, CriticalTail, Piece};
use crate::pencil::FrictionParts;
use crate::reason::Reason;
use mceip_exact::Rational;
use mceip_model::Window;
use num_traits::Zero as _;
use std::rc::Rc;

/// Checks that the regions cover everything and that each holds no solution. Returns the number of
/// leaves.
///
/// With an audit, leaves that fail are passed over, and what is returned means nothing if the audit
/// was stopped.
pub(crate) fn check(
    parts: &FrictionParts,
    certificate: &CriticalCertificate,
    audit: Option<&Audit<'_>>,
) -> Result<usize, Reason> {
    check_boxes(parts, certificate, audit).map_err(of_boxes)
}

/// The reason of a fault in the boxes of (value, friction).
pub(super) fn of_boxes(at: FaultAt) -> Reason {
    Reason::Boxes {
        piece: at.piece,
        node: at.node,
        fault: at.fault,
    }
}

fn check_boxes(
    parts: &FrictionParts,
    certificate: &CriticalCertificate,
    audit: Option<&Audit<'_>>,
) -> Result<usize, FaultAt> {
    let both = [&parts.plain, &parts.friction];
    let pieces = anchored_pieces(&certificate.pieces);
    let pencil = PencilParts {
        rows: &both,
        radii: parts.radii.as_ref(),
        pieces: &pieces,
    };
    let condensation = certificate.condensation.as_ref();
    let anchors = anchors(pencil, condensation)?;
    let tail = condensation.and_then(|c| c.tail.as_ref());
    if let Some(tail) = tail {
        check_tail(parts.of_tail(), certificate, tail)?;
    }

    let window = Window::all();
    let nodes = budget::nodes(&certificate.pieces);
    let mut context = Context::new(pencil, anchors.as_ref(), &window, nodes);
    context.tail = tail.map(|tail| &tail.from.0);

    let mut walk = CoverWalk::new(context, anchors);
    let friction = [&certificate.from, &certificate.below];
    walk.friction = Some(friction.map(|end| Rc::new(end.clone())));
    walk.audit = audit;
    walk.pieces(&certificate.pieces)?;

    Ok(walk.leaves)
}

/// The pieces, which begin at 0.
fn anchored_pieces(pieces: &[Piece]) -> Vec<AnchoredPiece> {
    let mut lo = Rational::zero();
    let mut list = Vec::with_capacity(pieces.len());
    for piece in pieces {
        let hi = piece.max.as_ref().map(|max| max.0.clone());
        let next = hi.clone().unwrap_or_else(|| lo.clone());
        list.push(AnchoredPiece {
            anchor: piece.anchor,
            lo,
            hi,
        });
        lo = next;
    }

    list
}

/// The whole pencil of these parts is definite from `tail.from` on, at the lowest mu and at the
/// highest, for every member.
fn check_tail(
    parts: &FrictionParts,
    certificate: &CriticalCertificate,
    tail: &CriticalTail,
) -> Result<(), CoverFault> {
    let start = &tail.from.0;
    let ends = [
        (&certificate.from, &tail.factor, &tail.mass_factor),
        (
            &certificate.below,
            &tail.factor_below,
            &tail.mass_factor_below,
        ),
    ];
    for (mu, factor, mass_factor) in ends {
        let rows = parts.at(mu);
        let radius = parts.radius_at(mu);
        condensed::tail(&rows, radius.as_ref(), start, factor, mass_factor.as_ref())?;
    }

    Ok(())
}

#[cfg(test)]
mod tests;
