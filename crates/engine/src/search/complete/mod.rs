//! All solutions in a window, with a certificate that there are no others.
//!
//! The search works in doubles and writes a certificate of kind *complete set*; the checker
//! decides. What it reports is what the checker accepted: solutions, and regions that stay open. A
//! certificate with open regions is also the checkpoint: [`resume`] goes on with it, [`merge`]
//! joins parts.

mod decided;
mod error;
pub(crate) mod game;
mod leaf;
mod merge;
mod options;
mod pieces;
mod precise;
mod region;
mod shares;
mod splice;
mod tree;

pub use error::CompleteError;
pub use merge::merge;
pub use options::{Options, Shard};

use crate::certify::certificate;
use crate::reduction::reduce;
use crate::run::Watch;
use mceip_check::certificate::{Certificate, CompleteSet, Node, Piece};
use mceip_check::{
    Accepted, AcceptedClaim, AcceptedCover, CoverFault, Reason, Rejected, audit, check,
};
use mceip_model::file::Number;
use mceip_model::{Pencil, Problem};
use pieces::prepared::Prepared;
use shares::Shares;
use splice::Chosen;
use std::collections::BTreeSet;

/// What a search has proved.
#[derive(Debug, Clone)]
pub struct Completed {
    /// The certificate; [`check`] has accepted it.
    pub certificate: Certificate,
    /// What the checker read off it.
    pub cover: AcceptedCover,
    /// x of each solution of the cover over all variables of the pencil, e'x_s = 1, in doubles.
    pub x: Vec<Vec<f64>>,
}

impl Completed {
    /// Is nothing left open? There may be families beside the solutions
    /// ([`AcceptedCover::is_plain_list`]).
    pub fn is_complete(&self) -> bool {
        self.cover.open.is_empty()
    }

    /// The solutions with their x.
    pub fn solutions(&self) -> impl Iterator<Item = (&AcceptedClaim, &[f64])> {
        self.cover
            .solutions
            .iter()
            .zip(self.x.iter().map(Vec::as_slice))
    }
}

/// Searches the problem's window. A search that is cancelled leaves open what is not done. Progress
/// counts leaves, and the share of the search space that they close.
///
/// # Errors
/// [`CompleteError`].
///
/// ```
/// use mceip_exact::{whole, Sparse};
/// use mceip_model::{Body, Pencil, Problem, Unknown, Window};
/// use mceip_engine::search::complete::{complete, Options};
/// use mceip_engine::run::Watch;
/// // The fold of spec/errata.md: lambda^2 = 2 and 3 and nothing else in [0, infinity).
/// let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
/// let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
/// let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
/// let found = complete(&problem, &Options::default(), &Watch::nobody()).unwrap();
/// assert!(found.is_complete());
/// assert_eq!(found.cover.solutions.len(), 2);
/// assert!(found.cover.solutions[0].value.contains(&whole(2)));
/// ```
pub fn complete(
    problem: &Problem,
    options: &Options,
    watch: &Watch<'_>,
) -> Result<Completed, CompleteError> {
    let pencil = reduce(problem)?.pencil;
    let mut prepared = Prepared::new(problem, &pencil, options.pieces)?;
    if options.shard.is_none()
        && let Some(node) = leaf::ldl::leaf(&pencil, problem.window())
    {
        let piece = Piece {
            max: problem.window().max().cloned().map(Number),
            anchor: None,
            tree: vec![node],
        };
        let set = CompleteSet {
            pieces: vec![piece],
            ..prepared.open_set()
        };
        let mut certificate = Certificate {
            complete_set: Some(set),
            ..certificate(problem, Vec::new())
        };
        let (accepted, refused) = audited(problem, &mut certificate)?;
        if refused.is_empty() {
            return completed(&pencil, &prepared, certificate, accepted);
        }
    }
    if prepared.is_expanded() {
        // A first search finds where the solutions are, so that the enclosure is tight there.
        let scout = Options {
            shard: None,
            ..*options
        };
        let quiet = Shares::new(watch.quiet());
        let (set, look) = (prepared.open_set(), prepared.scout());
        let found = in_threads(options.threads, || {
            splice::all(problem, &pencil, &look, &set, &scout, &Chosen::All, &quiet)
        });
        let mut values: Vec<f64> = found.into_iter().flat_map(|f| f.met).collect();
        values.sort_by(f64::total_cmp);
        prepared = prepared.refined(problem, &pencil, &values);
    }
    let start = Certificate {
        complete_set: Some(prepared.open_set()),
        ..certificate(problem, Vec::new())
    };
    run(problem, &pencil, prepared, start, options, watch)
}

/// Goes on with a certificate that leaves regions open: only these are searched.
///
/// # Errors
/// [`CompleteError`]; among them a certificate of another problem, unknown or window, and one
/// without a complete set.
pub fn resume(
    problem: &Problem,
    earlier: &Certificate,
    options: &Options,
    watch: &Watch<'_>,
) -> Result<Completed, CompleteError> {
    let pencil = reduce(problem)?.pencil;
    error::same_problem(problem, earlier)?;
    check(problem, earlier)?;
    let set = earlier
        .complete_set
        .as_ref()
        .ok_or(CompleteError::NoCompleteSet)?;
    let prepared = Prepared::again(&pencil, set)?;
    run(problem, &pencil, prepared, earlier.clone(), options, watch)
}

/// Rounds of a search whose leaves were refused, each more cautious than the one before.
const CAUTIOUS_ROUNDS: usize = 2;

/// Refused leaves up to which exact arithmetic is asked.
const MAX_REFUSED: usize = 200;

fn run(
    problem: &Problem,
    pencil: &Pencil,
    mut prepared: Prepared,
    mut certificate: Certificate,
    options: &Options,
    watch: &Watch<'_>,
) -> Result<Completed, CompleteError> {
    let search = |prepared: &Prepared,
                  certificate: &mut Certificate,
                  chosen: &Chosen,
                  shares: &Shares<'_>| {
        let set = certificate
            .complete_set
            .take()
            .ok_or(CompleteError::NoCompleteSet)?;
        let found = in_threads(options.threads, || {
            splice::all(problem, pencil, prepared, &set, options, chosen, shares)
        });
        let claims = &mut certificate.claims;
        let pieces = set
            .pieces
            .iter()
            .zip(found)
            .map(|(piece, found)| splice::numbered(piece, found.items, claims))
            .collect();
        certificate.complete_set = Some(CompleteSet {
            condensation: set.condensation,
            pieces,
        });
        audited(problem, certificate)
    };
    let (mut accepted, mut refused) = search(
        &prepared,
        &mut certificate,
        &Chosen::All,
        &Shares::new(*watch),
    )?;
    // What was refused is open now: that alone is searched again, with more caution, and what still
    // is refused exactly.
    for _ in 0..CAUTIOUS_ROUNDS {
        if refused.is_empty() || watch.is_cancelled() || !prepared.beware() {
            break;
        }
        (accepted, refused) = search(
            &prepared,
            &mut certificate,
            &Chosen::Again(refused),
            &Shares::new(watch.quiet()),
        )?;
    }
    if !refused.is_empty() && refused.len() <= MAX_REFUSED && !watch.is_cancelled() {
        (accepted, _) = search(
            &prepared,
            &mut certificate,
            &Chosen::Exactly(refused),
            &Shares::new(watch.quiet()),
        )?;
    }
    if !watch.is_cancelled()
        && let Some((longer, closed)) =
            with_long_numbers(problem, pencil, &prepared, &certificate, &accepted)
    {
        (certificate, accepted) = (longer, closed);
    }
    completed(pencil, &prepared, certificate, accepted)
}

/// The certificate in which long numbers decide open regions, if fewer stay open according to the
/// checker.
fn with_long_numbers(
    problem: &Problem,
    pencil: &Pencil,
    prepared: &Prepared,
    certificate: &Certificate,
    accepted: &Accepted,
) -> Option<(Certificate, Accepted)> {
    let open = |accepted: &Accepted| accepted.cover.as_ref().map_or(0, |c| c.open.len());
    if open(accepted) == 0 {
        return None;
    }
    let mut longer = precise::closed(problem, pencil, prepared, certificate)?;
    let (again, _) = audited(problem, &mut longer).ok()?;
    (open(&again) < open(accepted)).then_some((longer, again))
}

/// What is reported is what the checker accepted.
fn completed(
    pencil: &Pencil,
    prepared: &Prepared,
    certificate: Certificate,
    accepted: Accepted,
) -> Result<Completed, CompleteError> {
    let cover = accepted.cover.ok_or(CompleteError::NoCompleteSet)?;
    let exact = |s: &AcceptedClaim| leaf::support::shape(&certificate, pencil, s);
    let x = cover
        .solutions
        .iter()
        .map(|s| exact(s).unwrap_or_else(|| prepared.shape(pencil, s)))
        .collect();
    Ok(Completed {
        certificate,
        cover,
        x,
    })
}

/// Lets the checker read the certificate. A leaf whose witness doubles have judged too well is left
/// open, and so is a tail. Also returned: the places of such leaves.
fn audited(
    problem: &Problem,
    certificate: &mut Certificate,
) -> Result<(Accepted, BTreeSet<(usize, usize)>), CompleteError> {
    // Every round opens the tail or solutions of one support, so that this comes to an end.
    let (accepted, refused) = loop {
        match audit(problem, certificate) {
            Ok(audited) => break audited,
            Err(rejected) => without_refused(certificate, rejected)?,
        }
    };
    for &(piece, node) in &refused {
        let leaf = certificate
            .complete_set
            .as_mut()
            .and_then(|set| set.pieces.get_mut(piece))
            .and_then(|p| p.tree.get_mut(node));
        leaf.into_iter().for_each(|leaf| *leaf = Node::Open);
    }
    Ok((accepted, refused.into_iter().collect()))
}

/// Opens the leaves of a tree that yield solutions of the support; how many.
fn open_solutions(tree: &mut [Node], support: &[usize]) -> usize {
    // What moves in the regions still to come; of a branch the resting side comes first.
    let mut moving: Vec<Vec<usize>> = vec![Vec::new()];
    let mut opened = 0;
    for node in tree {
        let mut here = moving.pop().unwrap_or_default();
        match node {
            Node::Split(_) => moving.extend([here.clone(), here]),
            Node::Branch(index) => {
                let rest = here.clone();
                here.push(*index);
                moving.extend([here, rest]);
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

/// Opens what is refused as a whole, the tail or solutions that cannot be told apart, else says why
/// there is no certificate.
fn without_refused(certificate: &mut Certificate, rejected: Rejected) -> Result<(), CompleteError> {
    let Some(set) = certificate.complete_set.as_mut() else {
        return Err(rejected.into());
    };
    match &rejected.reason {
        // Proved in doubles that rounding has misled: the scales of the rows differ too much.
        Reason::Cover { piece: None, .. }
            if set
                .condensation
                .as_mut()
                .is_some_and(|c| c.tail.take().is_some()) =>
        {
            let tails = set
                .pieces
                .iter_mut()
                .flat_map(|p| &mut p.tree)
                .filter(|n| matches!(n, Node::Tail));
            tails.for_each(|n| *n = Node::Open);
            Ok(())
        }
        // Solutions of one support so near each other that their leaves cannot tell which are the
        // same.
        Reason::Cover {
            piece: None,
            fault: CoverFault::Ambiguous { support },
            ..
        } => {
            let opened: usize = set
                .pieces
                .iter_mut()
                .map(|piece| open_solutions(&mut piece.tree, support))
                .sum();
            if opened > 0 {
                Ok(())
            } else {
                Err(rejected.into())
            }
        }
        // The free block is definite in doubles and not provably so.
        Reason::Cover {
            piece: None,
            fault: CoverFault::Hypothesis { expected, row },
            ..
        } => Err(CompleteError::Hypothesis {
            expected,
            row: *row,
        }),
        _ => Err(rejected.into()),
    }
}

/// Runs in a pool of the wanted size, or in the default one.
fn in_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> T {
    match threads.map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build()) {
        Some(Ok(pool)) => pool.install(work),
        // Without a pool of one's own the default one does the same work.
        _ => work(),
    }
}
