//! Cancelling a long run, its progress and its threads.
//!
//! A long search takes a [`Watch`] and asks [`Watch::is_cancelled`] between its steps. What it has
//! found by then is kept and returned; what it has not examined is left open. It calls
//! [`Watch::report`] with its [`Progress`] after each step.

use crate::analysis::ProofCertificate;
use crate::report::counted;
use mceip_model::Problem;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A switch that ends runs early. Clones share its state, so that another thread or a signal
/// handler can keep one.
#[derive(Debug, Clone, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// A switch that is not set.
    pub fn new() -> Cancel {
        Cancel::default()
    }

    /// A switch that is set: a run with it ends at its first step.
    pub fn requested() -> Cancel {
        let cancel = Cancel::new();
        cancel.request();
        cancel
    }

    /// Asks the runs that watch this switch to end. Returns whether somebody had asked before.
    pub fn request(&self) -> bool {
        self.0.swap(true, Ordering::Relaxed)
    }

    /// Has somebody asked?
    pub fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// The most threads that a run may have. More than any machine has use for.
pub const MAX_THREADS: usize = 1024;

/// Bytes of a thread's stack, which take no memory before they are used. A tree is searched node in
/// node, up to some cuts deep for each variable: 1,200 of the largest frames fill 2 MiB.
const STACK: usize = 1 << 27;

/// Runs in a pool of the wanted size, at most [`MAX_THREADS`], or of the default size if none is
/// wanted; in the pool at hand where none is wanted inside one, or it cannot be started. The same
/// work is done in any of them.
///
/// The pool is made for the work: the one that all would share has no threads in a process that was
/// forked after it began, and work would wait for them for ever.
pub fn in_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> T {
    let is_in_pool = rayon::current_thread_index().is_some();
    if threads.is_none() && is_in_pool {
        return work();
    }

    let mut pool = rayon::ThreadPoolBuilder::new().stack_size(STACK);
    if let Some(wanted) = threads {
        pool = pool.num_threads(wanted.min(MAX_THREADS));
    }
    match pool.build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Progress<'a> {
    /// What is being done, in words.
    pub stage: &'a str,
    /// Steps done: runs of the solver, leaves of a tree, instances.
    pub done: u64,
    /// Steps in all, where that is known.
    pub total: Option<u64>,
    /// Part of the search space that has been dealt with, 0 to 1, where that is known.
    pub share: Option<f64>,
    /// Solutions met so far, where they are counted.
    pub solutions: Option<u64>,
}

impl<'a> Progress<'a> {
    /// A stage that has just begun.
    pub fn stage(stage: &'a str) -> Progress<'a> {
        Progress {
            stage,
            ..Progress::default()
        }
    }

    /// `done` steps of `total`.
    pub fn of(stage: &'a str, done: usize, total: usize) -> Progress<'a> {
        Progress {
            stage,
            done: done as u64,
            total: Some(total as u64),
            ..Progress::default()
        }
    }
}

/// One line: "searching: 120 of 600, 45 % of the search space closed, 3 solutions".
impl fmt::Display for Progress<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.stage)?;

        match self.total {
            Some(total) => write!(f, ": {} of {total}", self.done)?,
            None if self.done > 0 => write!(f, ": {}", self.done)?,
            None => {}
        }

        if let Some(share) = self.share {
            write!(f, ", {:.1} % of the search space closed", 100.0 * share)?;
        }

        match self.solutions {
            Some(count) => write!(f, ", {}", counted(count, "solution")),
            None => Ok(()),
        }
    }
}

/// A listener to the progress of a run; it may be called from several threads.
pub type OnProgress<'a> = dyn Fn(&Progress<'_>) + Sync + 'a;

/// What a run has proved so far: a problem, and a certificate for it that the checker has accepted.
#[derive(Debug, Clone, Copy)]
pub struct Kept<'a> {
    /// Which of the problems of the run it is, for files; empty where there is one only.
    pub name: &'a str,
    /// The problem.
    pub problem: &'a Problem,
    /// The certificate. A complete set may leave regions open.
    pub certificate: &'a ProofCertificate,
}

/// A keeper of what a run has proved; it may be called from several threads.
pub type OnProof<'a> = dyn Fn(&Kept<'_>) + Sync + 'a;

/// Who keeps what a run proves before it ends, and how often a search is asked for it.
#[derive(Clone, Copy)]
pub struct Keeper<'a> {
    /// Time between two certificates of one search, at least.
    pub every: Duration,
    on_proof: &'a OnProof<'a>,
}

impl<'a> Keeper<'a> {
    /// A keeper that is called with each certificate.
    pub fn new(every: Duration, on_proof: &'a OnProof<'a>) -> Keeper<'a> {
        Keeper { every, on_proof }
    }

    /// Hands over what is proved, or what a keeper of a part of the run has got.
    pub fn hand_over(&self, kept: &Kept<'_>) {
        (self.on_proof)(kept);
    }
}

/// The switch, the listener and the keeper of a run.
///
/// ```
/// use mceip_engine::run::{Cancel, Progress, Watch};
/// let cancel = Cancel::new();
/// let print = |p: &Progress<'_>| eprintln!("{}: {} steps", p.stage, p.done);
/// let watch = Watch::new(&cancel, &print);
/// cancel.request();
/// assert!(watch.is_cancelled());
/// ```
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    cancel: Option<&'a Cancel>,
    on_progress: &'a OnProgress<'a>,
    keeper: Option<Keeper<'a>>,
}

impl<'a> Watch<'a> {
    /// A run that can be cancelled and reports its progress.
    pub fn new(cancel: &'a Cancel, on_progress: &'a OnProgress<'a>) -> Watch<'a> {
        Watch {
            cancel: Some(cancel),
            on_progress,
            keeper: None,
        }
    }

    /// A run that cannot be cancelled and reports nothing.
    pub fn nobody() -> Watch<'static> {
        Watch {
            cancel: None,
            on_progress: &|_| {},
            keeper: None,
        }
    }

    /// A run that can be cancelled and reports nothing.
    pub fn silent(cancel: &'a Cancel) -> Watch<'a> {
        Watch::new(cancel, &|_| {})
    }

    /// The same switch without the listener: for a part of a run.
    pub fn quiet(self) -> Watch<'a> {
        Watch {
            on_progress: &|_| {},
            ..self
        }
    }

    /// The same switch with another listener: one that passes on what it hears under another name.
    pub fn heard_by<'b>(self, on_progress: &'b OnProgress<'b>) -> Watch<'b>
    where
        'a: 'b,
    {
        Watch {
            on_progress,
            ..self
        }
    }

    /// The same run with this keeper, or with none.
    pub fn kept_by<'b>(self, keeper: Option<Keeper<'b>>) -> Watch<'b>
    where
        'a: 'b,
    {
        Watch { keeper, ..self }
    }

    /// Who keeps what the run proves before it ends.
    pub fn keeper(&self) -> Option<Keeper<'a>> {
        self.keeper
    }

    /// Has somebody asked the run to end?
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(Cancel::is_requested)
    }

    /// Reports how far the run has come.
    pub fn report(&self, progress: &Progress<'_>) {
        (self.on_progress)(progress);
    }
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch")
            .field("is_cancelled", &self.is_cancelled())
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn progress_is_one_line() {
        let leaves = Progress {
            done: 120,
            share: Some(0.4567),
            solutions: Some(1),
            ..Progress::stage("searching")
        };

        assert_eq!(
            leaves.to_string(),
            "searching: 120, 45.7 % of the search space closed, 1 solution"
        );
        assert_eq!(Progress::of("cases", 0, 9).to_string(), "cases: 0 of 9");
        assert_eq!(Progress::stage("reading").to_string(), "reading");
    }

    #[test]
    fn a_watch_hears_its_switch_and_tells_its_listener() {
        let heard = Mutex::new(Vec::new());
        let listener: &OnProgress<'_> = &|progress| {
            let entry = (progress.stage.to_string(), progress.done);
            heard.lock().unwrap().push(entry);
        };
        let cancel = Cancel::new();
        let watch = Watch::new(&cancel, listener);

        let renamed = |progress: &Progress<'_>| {
            watch.report(&Progress {
                stage: "part",
                ..*progress
            });
        };

        watch.report(&Progress::of("search", 3, 7));
        watch
            .heard_by(&renamed)
            .report(&Progress::of("search", 4, 7));
        watch.quiet().report(&Progress::stage("unheard"));
        let before = watch.is_cancelled();
        let first = cancel.clone().request();
        let second = cancel.request();

        assert_eq!(
            *heard.lock().unwrap(),
            [("search".to_string(), 3), ("part".to_string(), 4)]
        );
        assert!(!before && watch.is_cancelled() && watch.quiet().is_cancelled());
        assert!(!first && second);
        assert!(!Watch::nobody().is_cancelled());
    }
}
