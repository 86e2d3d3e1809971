//! The run: waves of instances in parallel, added up in their order.
//!
//! Input: the engines, a limit, and a state to go on from. Output: the state with the instances
//! that were judged. The caller hears of every wave, so that it can write the state to a file, and
//! of every disagreement, already shrunk. Called by `mceip campaign`.

use super::engine::{CaseFindings, Engine, Finding, judge};
use super::family::{CampaignCase, Id, case};
use super::replay::Replay;
use super::shrink;
use super::state::State;
use crate::disagreement::Disagreement;
use mceip_engine::run::Cancel;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// When a campaign ends by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CampaignLimit {
    /// So many instances of each family, in all; with a state that has some of them, the rest.
    Count(u64),
    /// So long, this time.
    For(Duration),
}

/// What is told while a campaign runs.
pub enum CampaignEvent<'a> {
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
    pub limit: CampaignLimit,
}

/// Instances between two looks at the clock. They take milliseconds each, so a wave takes about a
/// second.
const WAVE: u64 = 40;

impl Campaign<'_> {
    /// Runs from `state` on until the limit, or until it is cancelled; a wave that has begun is
    /// finished. The state for [`CampaignLimit::Count`] does not depend on the number of threads.
    pub fn run(
        &self,
        mut state: State,
        cancel: &Cancel,
        hear: &mut dyn FnMut(CampaignEvent<'_>),
    ) -> State {
        let begun = Instant::now();
        let count = state.families.len() as u64;

        loop {
            let left = match self.limit {
                CampaignLimit::Count(each) => (each * count).saturating_sub(state.done),
                CampaignLimit::For(time) if begun.elapsed() >= time => 0,
                CampaignLimit::For(_) => WAVE,
            };

            if left == 0 || cancel.is_requested() {
                return state;
            }

            let wave: Vec<Id> = (state.done..state.done + left.min(WAVE))
                .map(|k| state.id(k))
                .collect();
            // Results come in the order of the wave.
            let judged: Vec<JudgedCase> = wave.par_iter().map(|id| self.judge(id)).collect();

            for (id, judged) in wave.iter().zip(judged) {
                let family = (state.done % count) as usize;
                state.tallies[family].add(id, &judged.judgement);
                state.done += 1;

                for replay in self.replays(&judged) {
                    hear(CampaignEvent::Disagreement(&replay));
                }
            }

            hear(CampaignEvent::Wave(&state));
        }
    }

    /// Makes the instance and judges it. An instance that the generator refuses is a disagreement.
    fn judge(&self, id: &Id) -> JudgedCase {
        match case(id) {
            Ok(Ok(case)) => {
                let judgement = judge(&case, self.engines);
                JudgedCase {
                    case: Some(case),
                    judgement,
                }
            }
            Ok(Err(e)) => JudgedCase::refused(&e),
            Err(e) => JudgedCase::refused(&e),
        }
    }

    /// One replay per engine and kind.
    fn replays(&self, judged: &JudgedCase) -> Vec<Replay> {
        let Some(case) = &judged.case else {
            return Vec::new();
        };

        let findings = &judged.judgement.findings;
        let mut out = Vec::new();
        for (k, finding) in findings.iter().enumerate() {
            let is_known = findings[..k].iter().any(|f| f.kind() == finding.kind());
            if is_known {
                continue;
            }

            let (small, says) = shrink(case, finding, self.engines);
            out.push(Replay::new((case, finding), (&small, &says)));
        }
        out
    }
}

/// An instance of a wave, and what came of it.
struct JudgedCase {
    /// `None` if the generator refused to make it.
    case: Option<CampaignCase>,
    judgement: CaseFindings,
}

impl JudgedCase {
    /// An instance that the generator refused to make: a disagreement.
    fn refused(reason: &dyn std::fmt::Display) -> JudgedCase {
        let finding = Finding {
            engine: "generator".into(),
            disagreement: Disagreement::refused("generator", reason),
        };

        JudgedCase {
            case: None,
            judgement: CaseFindings {
                findings: vec![finding],
                ..CaseFindings::default()
            },
        }
    }
}
