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
//! *Zero reaction.* Particles in contact with zero reaction have three variables each, whose rows
//! are affine in mu as well. A branch on one half of v_T puts the other half at rest where the
//! first one moves.

use super::budget;
use super::context::Context;
use super::fault::CoverFault;
use super::walk::{Audit, CoverWalk, FaultAt};
use super::{anchors, condensed};
use crate::certificate::{CriticalCertificate, CriticalTail};
use crate::pencil::FrictionParts;
use crate::reason::Reason;
use mceip_model::Window;
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
    let condensation = certificate.condensation.as_ref();
    let anchors = anchors(&both, condensation)?;
    let tail = condensation.and_then(|c| c.tail.as_ref());
    if let Some(tail) = tail {
        check_tail(parts.of_tail(), certificate, tail)?;
    }

    let window = Window::all();
    let nodes = budget::nodes(&certificate.pieces);
    let mut context = Context::new(&both, anchors.as_ref(), &window, nodes);
    context.tail = tail.map(|tail| &tail.from.0);

    let mut walk = CoverWalk::new(context, anchors);
    let friction = [&certificate.from, &certificate.below];
    walk.friction = Some(friction.map(|end| Rc::new(end.clone())));
    walk.audit = audit;
    walk.pieces(&certificate.pieces)?;

    Ok(walk.leaves)
}

/// The whole pencil of these parts is definite from `tail.from` on, at the lowest mu and at the
/// highest.
fn check_tail(
    parts: &FrictionParts,
    certificate: &CriticalCertificate,
    tail: &CriticalTail,
) -> Result<(), CoverFault> {
    let start = &tail.from.0;
    let lowest = parts.at(&certificate.from);
    let mass_factor = tail.mass_factor.as_ref();
    condensed::tail(&lowest, start, &tail.factor, mass_factor)?;

    let highest = parts.at(&certificate.below);
    let mass_factor = tail.mass_factor_below.as_ref();
    condensed::tail(&highest, start, &tail.factor_below, mass_factor)
}

#[cfg(test)]
mod tests;
