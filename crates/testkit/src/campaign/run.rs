//! The run: waves of instances in parallel, added up in their order.

use super::engine::{Engine, Finding, Judgement, judge};
use super::family::{Case, Id, case};
use super::replay::Replay;
use super::shrink;
use super::state::State;
use crate::disagreement::Disagreement;
use mceip_engine::run::Cancel;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// When a campaign ends by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// So many instances of each family, in all; with a state that has some of them, the rest.
    Count(u64),
    /// So long, this time.
    For(Duration),
}

/// What is told while a campaign runs.
pub enum Event<'a> {
    /// A wave is done: what is in the state will not be lost.
    Wave(&'a State),
    /// A disagreement, already shrunk.
    Disagreement(&'a Replay),
}

/// A campaign: engines and a limit. What it runs over is in the [`State`].
pub struct Campaign<'a> {
    /// The engines, each held against the plain enumerator.
    pub engines: &'a [Box<dyn Engine>],
    /// When it ends.
    pub limit: Limit,
}

/// Instances between two looks at the clock. They take milliseconds each, so a wave takes about a
/// second.
const WAVE: u64 = 40;

impl Campaign<'_> {
    /// Runs from `state` on until the limit, or until it is cancelled; a wave that has begun is
    /// finished. The state for [`Limit::Count`] does not depend on the number of threads.
    pub fn run(&self, mut state: State, cancel: &Cancel, hear: &mut dyn FnMut(Event<'_>)) -> State {
        let begun = Instant::now();
        let count = state.families.len() as u64;

        loop {
            let left = match self.limit {
                Limit::Count(each) => (each * count).saturating_sub(state.done),
                Limit::For(time) if begun.elapsed() >= time => 0,
                Limit::For(_) => WAVE,
            };

            if left == 0 || cancel.is_requested() {
                return state;
            }

            let wave: Vec<Id> = (state.done..state.done + left.min(WAVE))
                .map(|k| state.id(k))
                .collect();
            let judged: Vec<(Option<Case>, Judgement)> =
                wave.par_iter().map(|id| self.judge(id)).collect(); // in order

            for (id, (case, judgement)) in wave.iter().zip(judged) {
                state.tallies[(state.done % count) as usize].add(id, &judgement);
                state.done += 1;

                for finding in case
                    .iter()
                    .flat_map(|c| self.replays(c, &judgement.findings))
                {
                    hear(Event::Disagreement(&finding));
                }
            }

            hear(Event::Wave(&state));
        }
    }

    fn judge(&self, id: &Id) -> (Option<Case>, Judgement) {
        let refused = |reason: String| {
            let disagreement = Disagreement::Refused {
                engine: "generator",
                reason,
            };

            Judgement {
                findings: vec![Finding {
                    engine: "generator".into(),
                    disagreement,
                }],
                ..Judgement::default()
            }
        };

        match case(id) {
            Ok(Ok(case)) => {
                let judgement = judge(&case, self.engines);
                (Some(case), judgement)
            }
            Ok(Err(e)) => (None, refused(e.to_string())),
            Err(e) => (None, refused(e.to_string())),
        }
    }

    /// One replay per engine and kind.
    fn replays(&self, case: &Case, findings: &[Finding]) -> Vec<Replay> {
        let first = |k: usize| findings[..k].iter().all(|f| f.kind() != findings[k].kind());
        let kinds = (0..findings.len())
            .filter(|&k| first(k))
            .map(|k| &findings[k]);

        kinds
            .map(|finding| {
                let (small, says) = shrink(case, finding, self.engines);
                Replay::new((case, finding), (&small, &says))
            })
            .collect()
    }
}
