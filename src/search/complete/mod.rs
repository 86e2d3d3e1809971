//! All solutions in a window, with a certificate that there are no others.
//!
//! The search works in doubles and writes a certificate of kind *complete set*; the checker decides.
//! What it reports is what the checker accepted: solutions, and regions that stay open.

mod game;
mod root;
mod tree;
mod view;
mod witness;

use crate::candidate::Candidate;
use crate::certificate::{Certificate, Claim, CompleteSet, Node, Piece, RootOutcome};
use crate::certify::{certificate, certify};
use crate::check::{AcceptedCover, Rejected, check};
use crate::exact::Rational;
use crate::model::file::Number;
use crate::model::{ModelError, Pencil, Problem};
use crate::reduction::reduce;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use tree::{Item, Region, Search, Watch, short};
use view::View;

/// How to search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Pieces into which the window is cut before the search; the work is shared out by piece.
    pub pieces: usize,
    /// Nodes that one piece may use before the rest of it is left open.
    pub nodes_per_piece: usize,
}

impl Default for Options {
    fn default() -> Self {
        Options { pieces: 16, nodes_per_piece: 2_000_000 }
    }
}

/// How far a search has come.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Progress {
    /// Share of the search space that has been dealt with, 0 to 1.
    pub share: f64,
    /// Leaves so far.
    pub leaves: u64,
    /// Solutions met so far.
    pub solutions: u64,
}

/// What a search has proved.
#[derive(Debug, Clone)]
pub struct Completed {
    /// The certificate; [`check`] has accepted it.
    pub certificate: Certificate,
    /// What the checker read off it.
    pub cover: AcceptedCover,
}

impl Completed {
    /// Is nothing left open?
    pub fn is_complete(&self) -> bool {
        self.cover.open.is_empty()
    }
}

/// Why there is no certificate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompleteError {
    /// The problem was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// No complementarity variables.
    #[error("complete: expected at least one slip variable, got none")]
    NothingSlips,
    /// The checker refused what the search wrote: a defect of this program.
    #[error("complete: the checker rejects the search's certificate (please report this): {0}")]
    Rejected(#[from] Rejected),
}

/// Searches the problem's window. `stop` ends the search early, what is not done is left open.
///
/// The certificate does not depend on the number of threads.
///
/// # Errors
/// [`CompleteError`].
pub fn complete(
    problem: &Problem,
    options: &Options,
    stop: &AtomicBool,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Completed, CompleteError> {
    let reduced = reduce(problem)?;
    let pencil = &reduced.pencil;
    if pencil.slip().is_empty() {
        return Err(CompleteError::NothingSlips);
    }
    let view = View::of(pencil);
    let watch = Shares { stop, progress, state: Mutex::new(Progress::default()) };
    let skeleton = cuts(problem, &view, options.pieces);
    let found = run(problem, pencil, &view, &skeleton, options, &watch);
    let certificate = assemble(problem, skeleton, found);
    let accepted = check(problem, &certificate)?;
    let cover = accepted.cover.ok_or(CompleteError::NothingSlips)?;
    Ok(Completed { certificate, cover })
}

/// Counts shares as pieces report them.
struct Shares<'a> {
    stop: &'a AtomicBool,
    progress: &'a (dyn Fn(Progress) + Sync),
    state: Mutex<Progress>,
}

impl Watch for Shares<'_> {
    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn closed(&self, share: f64, solution: bool) {
        // A poisoned lock means that a thread panicked; its count is still good.
        let mut state = self.state.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        state.share += share;
        state.leaves += 1;
        state.solutions += u64::from(solution);
        (self.progress)(*state);
    }
}

/// Ends of the pieces, the last one the window's: equal steps of theta between short numbers.
fn cuts(problem: &Problem, view: &View, pieces: usize) -> Vec<Option<Rational>> {
    let (min, max) = (problem.window().min(), problem.window().max());
    let (a, b) = (view.theta(crate::exact::to_f64(min)), view.theta(max.map_or(f64::INFINITY, crate::exact::to_f64)));
    let step = (b - a) / pieces.max(1) as f64;
    let mut ends: Vec<Option<Rational>> = Vec::new();
    for k in 1..pieces {
        let (theta, slack) = (a + step * k as f64, 0.2 * step);
        let (v, low) = (view.value(theta), view.value(theta - slack));
        let cut = short(v, v - low);
        let rises = cut.as_ref().is_some_and(|c| c > ends.last().and_then(Option::as_ref).unwrap_or(min) && max.is_none_or(|m| c < m));
        if rises {
            ends.push(cut);
        }
    }
    ends.push(max.cloned());
    ends
}

/// Searches each piece; pieces are independent, so their order and thread do not matter.
fn run(
    problem: &Problem,
    pencil: &Pencil,
    view: &View,
    skeleton: &[Option<Rational>],
    options: &Options,
    watch: &Shares<'_>,
) -> Vec<Vec<Item>> {
    let window = problem.window();
    let certify_at = |value: f64, x: &[f64]| certify(pencil, window, &Candidate { value, x: x.to_vec() }).ok();
    let one = |k: usize| {
        let lo = if k == 0 { window.min().clone() } else { skeleton[k - 1].clone().unwrap_or_else(|| window.min().clone()) };
        let region = Region::whole(lo, skeleton[k].clone(), view.order());
        let mut search = Search {
            view,
            expansion: &view.expansions[0],
            certify: &certify_at,
            watch,
            budget: options.nodes_per_piece,
            items: Vec::new(),
            window: (window.min().clone(), window.max().cloned()),
        };
        search.region(&region, 1.0 / skeleton.len() as f64);
        search.items
    };
    (0..skeleton.len()).map(one).collect()
}

/// Numbers the claims that leaves refer to and writes the certificate.
fn assemble(problem: &Problem, skeleton: Vec<Option<Rational>>, found: Vec<Vec<Item>>) -> Certificate {
    let mut claims: Vec<Claim> = Vec::new();
    let mut pieces = Vec::new();
    for (max, items) in skeleton.into_iter().zip(found) {
        let tree = items.into_iter().map(|item| match item {
            Item::Node(node) => node,
            Item::Claimed(mut root, claim) => {
                let number = claims.iter().position(|c| *c == *claim).unwrap_or_else(|| {
                    claims.push(*claim);
                    claims.len() - 1
                });
                root.outcome = RootOutcome::Claim(number);
                Node::Root(root)
            }
        });
        pieces.push(Piece { max: max.map(Number), anchor: None, tree: tree.collect() });
    }
    Certificate { complete_set: Some(CompleteSet { condensation: None, pieces }), ..certificate(problem, claims) }
}
