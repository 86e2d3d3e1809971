//! The switch, the listener and the keeper that every question of the front door can be given.

use mceip_engine::run::{Cancel, Keeper, Kept, OnProgress, OnProof, Progress, Watch};
use std::ops::ControlFlow;
use std::time::Duration;

/// How a question is watched while it is worked on.
#[derive(Default)]
pub(super) struct Watched<'a> {
    cancel: Cancel,
    on_progress: Option<Box<OnProgress<'a>>>,
    keeping: Option<(Duration, Box<OnProof<'a>>)>,
}

impl<'a> Watched<'a> {
    /// Takes the switch that ends the work.
    pub(super) fn cancel(&mut self, cancel: &Cancel) {
        self.cancel = cancel.clone();
    }

    /// Takes the listener.
    pub(super) fn on_progress(&mut self, hear: impl Fn(&Progress<'_>) + Sync + 'a) {
        self.on_progress = Some(Box::new(hear));
    }

    /// Takes the keeper of what is proved meanwhile, and how often it is asked for.
    pub(super) fn keep(&mut self, every: Duration, keep: impl Fn(&Kept<'_>) + Sync + 'a) {
        self.keeping = Some((every, Box::new(keep)));
    }

    /// All of them, as the engine takes them.
    pub(super) fn watch(&self) -> Watch<'_> {
        let watch = match &self.on_progress {
            Some(hear) => Watch::new(&self.cancel, hear.as_ref()),
            None => Watch::silent(&self.cancel),
        };

        let keeping = self.keeping.as_ref();
        watch.kept_by(keeping.map(|(every, keep)| Keeper::new(*every, keep.as_ref())))
    }
}

/// Goes on as long as the work is not cancelled.
pub(super) fn unless_cancelled(watch: &Watch<'_>) -> ControlFlow<()> {
    if watch.is_cancelled() {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

/// Gives a question the switch and the listener; `$kept` says what an early end leaves of it.
macro_rules! watched_question {
    ($Question:ident, $kept:literal) => {
        impl<'a> $Question<'a> {
            #[doc = concat!("The switch that ends the work early; ", $kept, ".")]
            pub fn cancel(mut self, cancel: &mceip_engine::run::Cancel) -> Self {
                self.watched.cancel(cancel);
                self
            }

            /// Hears what is being done.
            pub fn on_progress(
                mut self,
                hear: impl Fn(&mceip_engine::run::Progress<'_>) + Sync + 'a,
            ) -> Self {
                self.watched.on_progress(hear);
                self
            }
        }
    };
}
pub(super) use watched_question;
