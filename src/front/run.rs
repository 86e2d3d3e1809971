//! The switch and the listener that every question of the front door can be given.

use mceip_engine::run::{Cancel, OnProgress, Progress, Watch};

/// How a question is watched while it is worked on.
#[derive(Default)]
pub(super) struct Watched<'a> {
    cancel: Cancel,
    on_progress: Option<Box<OnProgress<'a>>>,
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

    /// Both, as the engine takes them.
    pub(super) fn watch(&self) -> Watch<'_> {
        match &self.on_progress {
            Some(hear) => Watch::new(&self.cancel, hear.as_ref()),
            None => Watch::silent(&self.cancel),
        }
    }
}
