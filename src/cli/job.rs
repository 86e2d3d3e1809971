//! The run of a subcommand as its user meets it: one line on the terminal, and Ctrl-C.

use super::common::{CliError, aside, exit, print};
use indicatif::ProgressBar;
use mceip_engine::run::{Cancel, Progress, Watch};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The switch of the run under way, if it has something to keep before it ends.
static RUN: OnceLock<Cancel> = OnceLock::new();

/// Takes over interrupts and requests to end. A run that has something to keep is asked to stop,
/// and says so: the step that is under way may be long. Where there is none, and the second time,
/// the process ends.
pub(super) fn hear_interrupts() {
    // Fails only if a handler exists already: then the default behaviour stays.
    let _ = ctrlc::set_handler(|| {
        match RUN.get() {
            Some(run) if !run.request() => {
                aside("mceip: stopping, what is found is kept; a second interrupt ends at once");
                return;
            }
            Some(_) => {}
            None => aside("mceip: interrupted before it was done"),
        }
        std::process::exit(i32::from(exit::INTERRUPTED));
    });
}

/// The switch that an interrupt sets.
pub(super) fn interrupt() -> Cancel {
    let run = RUN.get_or_init(Cancel::new).clone();
    hear_interrupts();
    run
}

/// Time between two writes of what a long search has proved.
pub(super) const CHECKPOINT: Duration = Duration::from_secs(60);

/// Set once, before the command runs.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// Shows no progress in this process.
pub(super) fn be_quiet() {
    IS_QUIET.store(true, Ordering::Relaxed);
}

/// Is progress to stay unseen?
pub(super) fn is_quiet() -> bool {
    IS_QUIET.load(Ordering::Relaxed)
}

/// A run that Ctrl-C ends, with what has been found kept.
pub(super) struct Job {
    cancel: Cancel,
    line: ProgressBar,
}

impl Job {
    /// Begins, with a line on stderr if that is a terminal and `--quiet` is not given.
    pub(super) fn begin(what: &str) -> Job {
        Job::with_line(what, interrupt())
    }

    /// Begins work that has nothing to keep before it is done, such as a check: an interrupt ends
    /// the process.
    pub(super) fn begin_with_nothing_to_keep(what: &str) -> Job {
        hear_interrupts();
        Job::with_line(what, Cancel::new())
    }

    fn with_line(what: &str, cancel: Cancel) -> Job {
        let line = if is_quiet() {
            ProgressBar::hidden()
        } else {
            ProgressBar::new_spinner()
        };
        line.enable_steady_tick(Duration::from_millis(200));
        line.set_message(what.to_string());

        Job { cancel, line }
    }

    /// What Ctrl-C sets.
    pub(super) fn cancel(&self) -> &Cancel {
        &self.cancel
    }

    /// Has the user asked the run to end?
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancel.is_requested()
    }

    /// Writes what is being done.
    pub(super) fn say(&self, text: impl ToString) {
        self.line.set_message(text.to_string());
    }

    /// Prints a line on stderr above the one that is shown.
    pub(super) fn note(&self, text: &str) {
        self.line.suspend(|| aside(text));
    }

    /// Prints on stdout above the line that is shown.
    pub(super) fn print(&self, text: &str) -> Result<(), CliError> {
        self.line.suspend(|| print(text))
    }

    /// Does work that hears Ctrl-C and whose progress is shown.
    pub(super) fn watched<T>(&self, work: impl FnOnce(&Watch<'_>) -> T) -> T {
        let show = |progress: &Progress<'_>| self.say(progress);
        work(&Watch::new(&self.cancel, &show))
    }

    /// Takes the line away, so that results can be printed.
    pub(super) fn end(&self) {
        self.line.finish_and_clear();
    }
}

/// Does a check, which Ctrl-C ends without a verdict.
pub(super) fn decided<T>(check: impl FnOnce() -> T) -> T {
    let job = Job::begin_with_nothing_to_keep("checking");
    let verdict = check();
    job.end();
    verdict
}

impl Drop for Job {
    fn drop(&mut self) {
        self.end();
    }
}
