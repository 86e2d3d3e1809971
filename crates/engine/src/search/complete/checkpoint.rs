//! Certificates of a search that is still going on, so that little is lost where the process ends.
//!
//! The tree of a piece is found in preorder, so that what a search has found of it at any moment is
//! the beginning of a tree; with an open leaf for each region that is still to come it is a whole
//! one. From time to time a thread beside the search asks for these beginnings ([`Snapshots`]). The
//! search of each piece hands over a copy at its next node, and goes on. The certificate made of
//! them is read by the checker, and what that accepts goes to the keeper of the run
//! ([`Keeper`](crate::run::Keeper)). The search itself, and so its certificate, stays the same.
//!
//! Called by `rounds`; `tree` and `splice` hand over the copies.

use super::audited::audited;
use super::region::Item;
use super::splice::numbered;
use crate::analysis::ProofCertificate;
use crate::run::{Keeper, Kept};
use mceip_check::Proved;
use mceip_check::certificate::{Certificate, Claim, CompleteSet, Node};
use mceip_model::Problem;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Time that the pieces have to hand over their trees. One that is at work on a long node keeps its
/// last copy in the certificate.
const TIME_TO_ANSWER: Duration = Duration::from_secs(1);

/// Times as long as a certificate takes to be checked that the search goes on without another: a
/// kill loses twice that time, where it is more than the time between two certificates.
const RARELY: u32 = 1;

/// The beginning of a tree that replaces that of a piece.
struct Beginning {
    items: Vec<Item>,
    /// Nodes of the earlier tree in whose place the items are; the others follow as they were.
    replaced: usize,
}

/// The beginnings of the trees of all pieces, as far as they were handed over.
pub(super) struct Snapshots {
    /// How often they were asked for.
    asked: AtomicUsize,
    pieces: Mutex<Vec<Option<Beginning>>>,
}

impl Snapshots {
    /// Of so many pieces; nothing is handed over before it is asked for.
    pub(super) fn new(pieces: usize) -> Snapshots {
        Snapshots {
            asked: AtomicUsize::new(0),
            pieces: Mutex::new((0..pieces).map(|_| None).collect()),
        }
    }

    /// Asks the search of each piece for its tree.
    fn ask(&self) {
        self.asked.fetch_add(1, Ordering::Relaxed);
    }

    /// How often the trees were asked for.
    fn times_asked(&self) -> usize {
        self.asked.load(Ordering::Relaxed)
    }

    /// Takes over the tree of a piece.
    fn hand_over(&self, piece: usize, beginning: Beginning) {
        self.lock()[piece] = Some(beginning);
    }

    /// A thread that panicked with the lock leaves the list whole.
    fn lock(&self) -> MutexGuard<'_, Vec<Option<Beginning>>> {
        self.pieces.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The cover with the trees that were handed over, its claims appended to the list.
    fn cover(&self, earlier: &CompleteSet, claims: &mut Vec<Claim>) -> CompleteSet {
        let beginnings = self.lock();
        let mut pieces = Vec::with_capacity(earlier.pieces.len());
        for (piece, beginning) in earlier.pieces.iter().zip(beginnings.iter()) {
            let Some(beginning) = beginning else {
                pieces.push(piece.clone());
                continue;
            };

            let mut items = beginning.items.clone();
            let rest = piece.tree.iter().skip(beginning.replaced);
            items.extend(rest.cloned().map(Item::Node));
            pieces.push(numbered(piece, items, claims));
        }

        CompleteSet {
            condensation: earlier.condensation.clone(),
            pieces,
        }
    }
}

/// Hands over copies of the tree of one piece, when they are asked for.
pub(super) struct Copier<'a> {
    snapshots: &'a Snapshots,
    piece: usize,
    /// Nodes of the earlier tree that the items so far, and the search of the leaf at hand,
    /// replace.
    replaced: usize,
    /// Items before the search of the leaf at hand.
    begun: usize,
    /// How often copies had been asked for when the last one was handed over.
    answered: usize,
}

impl<'a> Copier<'a> {
    pub(super) fn new(snapshots: &'a Snapshots, piece: usize) -> Copier<'a> {
        Copier {
            snapshots,
            piece,
            replaced: 0,
            begun: 0,
            answered: 0,
        }
    }

    /// The leaf at this place of the earlier tree is about to be searched.
    pub(super) fn begin(&mut self, place: usize, items: &[Item]) {
        self.replaced = place + 1;
        self.begun = items.len();
    }

    /// Hands over a copy if it has been asked for since the last one.
    pub(super) fn answer(&mut self, items: &[Item]) {
        let asked = self.snapshots.times_asked();
        if asked == self.answered {
            return;
        }

        self.answered = asked;
        let mut items = items.to_vec();
        made_whole(&mut items, self.begun);
        let replaced = self.replaced;
        self.snapshots
            .hand_over(self.piece, Beginning { items, replaced });
    }

    /// Hands over the whole tree, which replaces the earlier one of so many nodes.
    pub(super) fn finish(self, items: &[Item], earlier_nodes: usize) {
        let beginning = Beginning {
            items: items.to_vec(),
            replaced: earlier_nodes,
        };
        self.snapshots.hand_over(self.piece, beginning);
    }
}

/// Makes a tree whole whose nodes from `begun` on are the beginning of a tree: each region that is
/// still to come gets an open leaf.
fn made_whole(items: &mut Vec<Item>, begun: usize) {
    let mut to_come = 1;
    for item in &items[begun..] {
        match item {
            Item::Node(Node::Split(_) | Node::Branch(_)) => to_come += 1,
            _ => to_come -= 1,
        }
    }

    let open = std::iter::repeat_with(|| Item::Node(Node::Open));
    items.extend(open.take(to_come));
}

/// What the certificates of a search under way are made of.
pub(super) struct Checkpoints<'a> {
    pub(super) problem: &'a Problem,
    pub(super) keeper: Keeper<'a>,
    /// The cover before the search, and the claims that it names.
    pub(super) set: &'a CompleteSet,
    pub(super) claims: &'a [Claim],
    pub(super) snapshots: &'a Snapshots,
}

impl Checkpoints<'_> {
    /// Does the work, and meanwhile keeps what it has proved from time to time.
    pub(super) fn during<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        // The receiver hears of the end when the sender is dropped, also by a panic.
        let (at_work, end) = channel::<()>();
        std::thread::scope(|scope| {
            scope.spawn(|| self.keep_until(end));
            let found = work();
            drop(at_work);
            found
        })
    }

    fn keep_until(&self, end: Receiver<()>) {
        let mut wait = self.keeper.every;
        while !has_ended(&end, wait) {
            self.snapshots.ask();
            if has_ended(&end, TIME_TO_ANSWER.min(self.keeper.every)) {
                return;
            }

            let begun = Instant::now();
            self.keep();
            wait = self.keeper.every.max(RARELY * begun.elapsed());
        }
    }

    /// Keeps a certificate of what was handed over, if the checker accepts it.
    fn keep(&self) {
        let mut claims = self.claims.to_vec();
        let set = self.snapshots.cover(self.set, &mut claims);
        let certificate = Certificate {
            complete_set: Some(set),
            ..Certificate::of_claims(self.problem, claims)
        };

        // What is refused as a whole here is searched again in the rounds to come.
        if let Ok(audited) = audited(certificate, self.problem) {
            keep_solutions(&self.keeper, self.problem, &audited.proved);
        }
    }
}

/// Hands over what a search has proved so far.
pub(super) fn keep_solutions(keeper: &Keeper<'_>, problem: &Problem, proved: &Proved<Certificate>) {
    keeper.hand_over(&Kept {
        name: "",
        problem,
        certificate: &ProofCertificate::Solutions(proved.clone()),
    });
}

/// Has the work ended before so much time is over?
fn has_ended(end: &Receiver<()>, wait: Duration) -> bool {
    !matches!(end.recv_timeout(wait), Err(RecvTimeoutError::Timeout))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Watch;
    use crate::search::complete::{CompleteOptions, Completed, complete, resume};
    use mceip_check::check;
    use mceip_exact::Sparse;
    use mceip_model::{Body, Pencil, Unknown, Window};

    fn split() -> Item {
        Item::Node(Node::Branch(0))
    }

    fn leaf() -> Item {
        Item::Node(Node::Tail)
    }

    /// The kinds of a tree's nodes: inner, leaf, open.
    fn kinds(items: &[Item]) -> String {
        let kind = |item: &Item| match item {
            Item::Node(Node::Branch(_)) => 'b',
            Item::Node(Node::Open) => 'o',
            _ => 'l',
        };
        items.iter().map(kind).collect()
    }

    #[test]
    fn a_beginning_gets_an_open_leaf_for_each_region_to_come() {
        for (begun, items, whole) in [
            (0, vec![], "o"),
            (0, vec![split()], "boo"),
            (0, vec![split(), leaf()], "blo"),
            (0, vec![split(), split(), leaf(), leaf()], "bbllo"),
            (0, vec![split(), leaf(), leaf()], "bll"),
            // What stands before is a beginning of the earlier tree, whose rest follows.
            (2, vec![split(), leaf()], "blo"),
            (1, vec![split(), split()], "bboo"),
        ] {
            let mut items = items;
            made_whole(&mut items, begun);
            assert_eq!(kinds(&items), whole);
        }
    }

    /// The complete graph: a solution for each of the 2^n - 1 supports.
    fn graph(vertices: usize) -> Problem {
        let row = |i: usize| (0..vertices).map(|j| i64::from(i != j)).collect::<Vec<_>>();
        let rows: Vec<Vec<i64>> = (0..vertices).map(row).collect();
        let rows: Vec<&[i64]> = rows.iter().map(Vec::as_slice).collect();
        let minus_one = mceip_exact::whole(-1);
        let b =
            Sparse::zeros(vertices, vertices).add_scaled(&minus_one, &Sparse::identity(vertices));
        let pencil = Pencil::new(Sparse::from_ints(&rows), b, vec![]).unwrap();
        Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all()).unwrap()
    }

    /// What a search keeps while it goes on, and what it has found at its end.
    fn kept(problem: &Problem, earlier: Option<&Certificate>) -> (Vec<Certificate>, Completed) {
        let kept = Mutex::new(Vec::new());
        let keep = |proved: &Kept<'_>| {
            let text = proved.certificate.file().unwrap();
            let certificate = Certificate::from_json(&text).unwrap();
            kept.lock().unwrap().push(certificate);
        };
        let keeper = Keeper::new(Duration::from_millis(1), &keep);
        let watch = Watch::nobody().kept_by(Some(keeper));

        let options = CompleteOptions::default();
        let completed = match earlier {
            None => complete(problem, &options, &watch),
            Some(earlier) => resume(problem, earlier, &options, &watch),
        };
        (kept.into_inner().unwrap(), completed.unwrap())
    }

    /// Solutions that the checker reads off a certificate, and regions left open.
    #[track_caller]
    fn accepted(problem: &Problem, certificate: &Certificate) -> [usize; 2] {
        let cover = check(problem, certificate).unwrap().cover.unwrap();
        [cover.solutions.len(), cover.open.len()]
    }

    #[test]
    fn what_is_kept_is_accepted_and_loses_nothing_of_an_earlier_certificate() {
        let problem = graph(8);
        let (parts, completed) = kept(&problem, None);
        let alone = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();
        assert_eq!(completed.proved, alone.proved);
        assert_eq!(completed.cover.solutions.len(), 255);

        let is_part = |part: &&Certificate| accepted(&problem, part)[1] > 0;
        let parts: Vec<&Certificate> = parts.iter().filter(is_part).collect();
        let Some(part) = parts.get(parts.len() / 2) else {
            panic!("no certificate was kept")
        };

        let [known, _] = accepted(&problem, part);
        let (later, completed) = kept(&problem, Some(part));
        assert_eq!(completed.cover.solutions.len(), 255);
        for certificate in &later {
            let [solutions, _] = accepted(&problem, certificate);
            assert!(solutions >= known, "{solutions} of {known}");
        }
    }
}
