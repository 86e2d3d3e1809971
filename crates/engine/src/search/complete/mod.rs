//! All solutions in a window, with a certificate that there are no others.
//!
//! ```text
//!   problem ──► pieces ─────► tree ──────────► leaf/* ──────► check ──► certificate
//!               view and      branch and       one kind of    audited   + solutions
//!               intervals     prune (splice)   evidence each     │
//!                                 ▲                              │ refused or open
//!                                 └────────── rounds ◄───────────┘
//! ```
//!
//! * `pieces` eliminates the free variables, cuts the window into pieces, and encloses T(t) over
//!   intervals.
//! * `tree` divides regions, an interval and a state for each complementarity variable, until a
//!   leaf closes them, and `solutions` says how those with one support are closed; `splice` puts
//!   the nodes into the cover, `shares` counts them.
//! * `leaf` has one file per kind of evidence: `leaf::farkas`, `leaf::definite`, `leaf::ldl`,
//!   `leaf::tail`, `leaf::root`, `leaf::infinity` (a root over a half line),
//!   `leaf::support`.
//! * `checkpoint` keeps what is proved while the search goes on.
//! * `rounds` searches again what the checker refuses (`audited`), at last in long numbers
//!   (`precise`).
//!
//! The search works in doubles and writes a certificate of kind *complete set*; the checker
//! decides. What it reports is what the checker accepted: solutions, and regions that stay open. A
//! certificate with open regions is also the checkpoint: [`resume`] goes on with it, [`merge`]
//! joins parts.

mod accepted_x;
mod audited;
mod checkpoint;
pub mod continua;
pub(crate) mod dyadic;
mod ends_game;
mod error;
pub(crate) mod gains;
pub(crate) mod game;
mod given;
pub(crate) mod leaf;
mod merge;
mod null_vector;
mod options;
pub(crate) mod pieces;
mod precise;
pub(crate) mod region;
pub(crate) mod rounding;
pub(crate) mod rounds;
pub(crate) mod shares;
mod solutions;
pub(crate) mod splice;
mod tableau;
pub(crate) mod tree;

pub use error::CompleteError;
pub use merge::merge;
pub use options::{CompleteOptions, Shard};

use crate::run::{Watch, in_threads};
use accepted_x::{accepted_x, claim_about, support_leaves};
use audited::{Audited, audited};
use checkpoint::keep_solutions;
use given::Given;
use mceip_check::certificate::{Certificate, Claim, CompleteSet, Piece};
use mceip_check::{AcceptedClaim, AcceptedCover, Proved, check};
use mceip_model::file::Number;
use mceip_model::reduction::reduce;
use mceip_model::{Pencil, Problem};
use pieces::anchor::{CLOSER, OF_WINDOW};
use pieces::prepared::Prepared;
use rounds::{Rounds, is_open_below, values_met};

/// What a search has proved.
#[derive(Debug, Clone)]
pub struct Completed {
    /// The certificate.
    pub proved: Proved<Certificate>,
    /// What the checker read off it.
    pub cover: AcceptedCover,
    /// x of each solution of the cover over all variables of the pencil, e'x_s = 1, in doubles; NaN
    /// where it is not known.
    pub x: Vec<Vec<f64>>,
}

impl Completed {
    /// What is reported is what the checker accepted.
    fn new(
        pencil: &Pencil,
        prepared: &Prepared,
        proved: Proved<Certificate>,
    ) -> Result<Completed, CompleteError> {
        let cover = proved.accepted().cover.clone();
        let mut cover = cover.ok_or(CompleteError::NoCompleteSet)?;
        cover.families = continua::joined(&cover.families);
        let leaves = support_leaves(proved.certificate());
        let mut x = Vec::with_capacity(cover.solutions.len());
        for solution in &cover.solutions {
            x.push(accepted_x(&proved, &leaves, prepared, pencil, solution));
        }

        Ok(Completed { proved, cover, x })
    }

    /// Is nothing left open? There may be families beside the solutions
    /// ([`AcceptedCover::is_plain_list`]).
    pub fn is_complete(&self) -> bool {
        self.cover.open.is_empty()
    }

    /// The claim of the certificate that is about a solution of the cover, if it has one.
    pub fn claim_about(&self, solution: &AcceptedClaim) -> Option<&Claim> {
        claim_about(&self.proved, solution)
    }

    /// The variables at zero with y = 0 of a solution of the cover, as its evidence proves them;
    /// `None` where that does not tell. Of a particle with zero reaction that opens and slips, the
    /// half of v_T at rest may be left out.
    pub fn biactive(&self, problem: &Problem, solution: &AcceptedClaim) -> Option<Vec<usize>> {
        let pencil = reduce(problem).ok()?.pencil;
        accepted_x::biactive(&self.proved, &pencil, solution)
    }

    /// Is the x of every solution known?
    pub fn has_every_x(&self) -> bool {
        self.x.iter().flatten().all(|x_i| x_i.is_finite())
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
/// use mceip_engine::search::complete::{complete, CompleteOptions};
/// use mceip_engine::run::Watch;
/// // The fold of spec/errata.md: lambda^2 = 2 and 3 and nothing else in [0, infinity).
/// let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
/// let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
/// let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
/// let found = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();
/// assert!(found.is_complete());
/// assert_eq!(found.cover.solutions.len(), 2);
/// assert!(found.cover.solutions[0].value.contains(&whole(2)));
/// ```
pub fn complete(
    problem: &Problem,
    options: &CompleteOptions,
    watch: &Watch<'_>,
) -> Result<Completed, CompleteError> {
    let pencil = reduce(problem)?.pencil;
    let prepare = |precisions| {
        let prepare = || Prepared::new(problem, &pencil, options.pieces, precisions);
        in_threads(options.threads, prepare)
    };
    let prepared = prepare(OF_WINDOW)?;
    if options.shard.is_none()
        && let Some(completed) = by_definiteness(problem, &pencil, &prepared)?
    {
        return Ok(completed);
    }

    let given = Given::new(problem, &pencil);
    let may_be_closer = prepared.is_expanded()
        && pencil.free().len() <= MOST_FREE_OF_CLOSER
        && options.shard.is_none();
    let found = search(&given, prepared, options, watch)?;
    if !may_be_closer || found.is_complete() || watch.is_cancelled() {
        return Ok(found);
    }

    // What is found stays on the disk until there is something better.
    if let Some(keeper) = watch.keeper() {
        keep_solutions(&keeper, problem, &found.proved);
    }
    let closer = prepare(CLOSER)
        .and_then(|prepared| search(&given, prepared, options, &watch.kept_by(None)));
    Ok(match closer {
        Ok(closer) if closer.is_complete() => closer,
        // Also where longer anchors are beyond a limit of the checker.
        _ => found,
    })
}

/// Searches the whole window.
fn search(
    given: &Given<'_>,
    mut prepared: Prepared,
    options: &CompleteOptions,
    watch: &Watch<'_>,
) -> Result<Completed, CompleteError> {
    if prepared.is_expanded() {
        prepared = with_fine_anchors(given, prepared, options, watch);
    }

    let start = with_set(given.problem, prepared.open_set());
    run(given, prepared, start, options, watch)
}

/// Free variables up to which a window that stays open is searched again with closer anchors, which
/// have nearly three times as many coefficients.
const MOST_FREE_OF_CLOSER: usize = 400;

/// Goes on with a certificate that leaves regions open: only these are searched.
///
/// # Errors
/// [`CompleteError`]; among them a certificate of another problem, unknown or window, and one
/// without a complete set.
pub fn resume(
    problem: &Problem,
    earlier: &Certificate,
    options: &CompleteOptions,
    watch: &Watch<'_>,
) -> Result<Completed, CompleteError> {
    let pencil = reduce(problem)?.pencil;
    error::same_problem(problem, earlier)?;
    check(problem, earlier)?;

    let set = earlier
        .complete_set
        .as_ref()
        .ok_or(CompleteError::NoCompleteSet)?;
    let prepared = Prepared::again(problem, &pencil, set)?;
    let given = Given::new(problem, &pencil);
    run(&given, prepared, earlier.clone(), options, watch)
}

/// Gives fine anchors to the solutions, and to the lower end of the window where the search would
/// stay open next to it.
fn with_fine_anchors(
    given: &Given<'_>,
    coarse: Prepared,
    options: &CompleteOptions,
    watch: &Watch<'_>,
) -> Prepared {
    // Every shard does this for all pieces, so that all shards have the same ones.
    let all_pieces = CompleteOptions {
        shard: None,
        ..*options
    };

    let refined = about_solutions(given, coarse.clone(), &all_pieces, watch);
    if !is_open_below(given, &all_pieces, &refined, watch) {
        return refined;
    }

    match coarse.with_lower_anchor(given.window(), given.pencil) {
        Some(graded) => about_solutions(given, graded, &all_pieces, watch),
        None => refined,
    }
}

/// Gives a fine anchor to each solution that a first search without remainders finds, so that the
/// enclosure is tight there.
fn about_solutions(
    given: &Given<'_>,
    prepared: Prepared,
    options: &CompleteOptions,
    watch: &Watch<'_>,
) -> Prepared {
    let loose = prepared.without_remainders();
    let values = values_met(given, options, &loose, watch);
    prepared.refined(given.problem, given.pencil, &values)
}

/// The answer where the whole window is closed by one definite matrix pencil.
fn by_definiteness(
    problem: &Problem,
    pencil: &Pencil,
    prepared: &Prepared,
) -> Result<Option<Completed>, CompleteError> {
    let Some(leaf) = leaf::ldl::window_leaf(pencil, problem.window()) else {
        return Ok(None);
    };

    let piece = Piece {
        max: problem.window().max().cloned().map(Number),
        anchor: None,
        tree: vec![leaf],
    };

    let set = CompleteSet {
        pieces: vec![piece],
        ..prepared.open_set()
    };

    let Audited { proved, refused } = audited(with_set(problem, set), problem)?;
    if refused.is_empty() {
        Completed::new(pencil, prepared, proved).map(Some)
    } else {
        Ok(None)
    }
}

/// A certificate without claims that has this cover.
fn with_set(problem: &Problem, set: CompleteSet) -> Certificate {
    Certificate {
        complete_set: Some(set),
        ..Certificate::of_claims(problem, Vec::new())
    }
}

/// Searches the open leaves of a certificate, in as many rounds as it takes.
fn run(
    given: &Given<'_>,
    prepared: Prepared,
    certificate: Certificate,
    options: &CompleteOptions,
    watch: &Watch<'_>,
) -> Result<Completed, CompleteError> {
    let mut rounds = Rounds {
        given,
        options,
        prepared,
    };

    let proved = rounds.run(certificate, watch)?.proved;
    Completed::new(given.pencil, &rounds.prepared, proved)
}
