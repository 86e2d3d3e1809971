//! Lets the checker read a certificate, and opens what it refuses.
//!
//! A leaf whose witness doubles have judged too well is left open. What the checker refuses as a
//! whole is opened likewise, where it can be: a tail, and solutions of one support that cannot be
//! told apart. Everything else is the reason why there is no certificate. Called by `complete` and
//! `rounds` after every pass of the search.

use super::error::CompleteError;
use mceip_check::certificate::{Certificate, CompleteSet, Node};
use mceip_check::{CoverFault, LeafPlace, NotAccepted, Proved, Reason};
use mceip_model::Problem;
use std::collections::BTreeSet;

/// A certificate that the checker has accepted.
pub(super) struct Audited {
    pub(super) proved: Proved<Certificate>,
    /// The leaves that it has refused, which are open in the certificate.
    pub(super) refused: BTreeSet<LeafPlace>,
}

impl Audited {
    /// Number of open regions.
    pub(super) fn open_count(&self) -> usize {
        match &self.proved.accepted().cover {
            Some(cover) => cover.open.len(),
            None => 0,
        }
    }
}

/// Lets the checker read the certificate, and opens what it refuses.
///
/// # Errors
/// [`CompleteError`] where the refusal concerns more than leaves, a tail or solutions.
pub(super) fn audited(
    mut certificate: Certificate,
    problem: &Problem,
) -> Result<Audited, CompleteError> {
    // Every round opens the tail or solutions of one support, so that this comes to an end.
    loop {
        match Proved::opened(problem, certificate) {
            Ok((proved, refused)) => {
                let refused = refused.into_iter().collect();
                return Ok(Audited { proved, refused });
            }
            Err(refused) => certificate = open_refused(*refused)?,
        }
    }
}

/// Opens what is refused as a whole, or says why there is no certificate.
fn open_refused(refused: NotAccepted) -> Result<Certificate, CompleteError> {
    let NotAccepted {
        mut certificate,
        rejected,
    } = refused;
    let Some(set) = certificate.complete_set.as_mut() else {
        return Err(rejected.into());
    };

    let Reason::Cover {
        piece: None, fault, ..
    } = &rejected.reason
    else {
        return Err(rejected.into());
    };

    // Proved in doubles that rounding has misled: the scales of the rows differ too much.
    if open_tail(set) {
        return Ok(certificate);
    }

    match fault {
        // Solutions of one support so near each other that their leaves cannot tell which are the
        // same.
        CoverFault::Ambiguous { support } => {
            let mut opened = 0;
            for piece in &mut set.pieces {
                opened += open_solutions(&mut piece.tree, support);
            }

            if opened > 0 {
                Ok(certificate)
            } else {
                Err(rejected.into())
            }
        }
        // The free block is definite in doubles and not provably so.
        CoverFault::Hypothesis { expected, row } => Err(CompleteError::Hypothesis {
            expected,
            row: *row,
        }),
        _ => Err(rejected.into()),
    }
}

/// Takes the tail out of a cover and opens its leaves; was there one?
fn open_tail(set: &mut CompleteSet) -> bool {
    let tail = set.condensation.as_mut().and_then(|c| c.tail.take());
    if tail.is_none() {
        return false;
    }

    for node in set.pieces.iter_mut().flat_map(|piece| &mut piece.tree) {
        if matches!(node, Node::Tail) {
            *node = Node::Open;
        }
    }

    true
}

/// Opens the leaves of a tree that yield solutions of the support; how many.
fn open_solutions(tree: &mut [Node], support: &[usize]) -> usize {
    // The supports of the regions still to come; of a branch the side x_i = 0 comes first.
    let mut waiting: Vec<Vec<usize>> = vec![Vec::new()];
    let mut opened = 0;
    for node in tree {
        let mut here = waiting.pop().unwrap_or_default();
        match node {
            Node::Split(_) => waiting.extend([here.clone(), here]),
            Node::Branch(variable) => {
                let at_zero = here.clone();
                here.push(*variable);
                waiting.extend([here, at_zero]);
            }
            Node::Root(_) | Node::Support(_) => {
                here.sort_unstable();
                if here == support {
                    *node = Node::Open;
                    opened += 1;
                }
            }
            _ => {}
        }
    }

    opened
}
