//! All cases through a foreign program, in parallel; the outcome does not depend on the number of
//! threads.

use super::case::{Case, Draft, Group};
use super::error::ConformError;
use super::flag::Flag;
use super::groups::random_draft;
use super::judge::{Judgement, Label, judge_report};
use super::process::{Ending, Limits, run_once};
use mceip_engine::run::{Progress, Watch};
use mceip_model::file::write_problem;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What to run.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Cases of the pack.
    pub groups: Vec<Group>,
    /// Random cases besides.
    pub random: usize,
    /// Their seed.
    pub seed: u64,
    /// Send reduced pencils in place of mechanical systems.
    pub as_pencil: bool,
    /// Only cases with one of these flags; empty: all.
    pub only: Vec<Flag>,
    /// Limits of one run.
    pub limits: Limits,
    /// Threads; `None`: all cores.
    pub threads: Option<usize>,
}

/// What came of one case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// The case.
    pub id: String,
    /// What it is about.
    pub flags: BTreeSet<Flag>,
    /// What the program did.
    pub judgement: Judgement,
}

/// Runs every case of the plan through the command, on the plan's threads, and judges what it
/// prints. Outcomes come in the order of the plan; cases not reached before an interrupt are left
/// out.
///
/// # Errors
/// [`ConformError`] if the command does not start, or a problem is beyond the plain oracle.
pub fn run(
    plan: &Plan,
    command: &[String],
    watch: &Watch<'_>,
) -> Result<Vec<Outcome>, ConformError> {
    let fixed: Vec<&Draft> = plan.groups.iter().flat_map(|g| &g.drafts).collect();
    let total = fixed.len() + plan.random;
    let threads = plan.threads.unwrap_or(0);

    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|_| ConformError::Threads { threads })?;
    let count = AtomicUsize::new(0);

    let one = |k: usize| -> Result<Option<Outcome>, ConformError> {
        if watch.is_cancelled() {
            return Ok(None);
        }

        let case = match fixed.get(k) {
            Some(draft) => Case::answer(draft, plan.as_pencil)?,
            None => {
                let at = |source| ConformError::Problem {
                    place: format!("random case {k}"),
                    source,
                };

                Case::answer(
                    &random_draft(k - fixed.len(), plan.seed).map_err(at)?,
                    plan.as_pencil,
                )?
            }
        };

        let wanted = plan.only.is_empty() || plan.only.iter().any(|f| case.flags.contains(f));
        let outcome = if wanted {
            one_case(case, command, &plan.limits, watch)?
        } else {
            None
        };

        let finished = count.fetch_add(1, Ordering::Relaxed) + 1;
        watch.report(&Progress::of("cases", finished, total));
        Ok(outcome)
    };

    // One case per task: they take very different times.
    let outcomes = pool.install(|| {
        (0..total)
            .into_par_iter()
            .with_max_len(1)
            .map(one)
            .collect::<Result<Vec<_>, _>>()
    })?;

    Ok(outcomes.into_iter().flatten().collect())
}

fn one_case(
    case: Case,
    command: &[String],
    limits: &Limits,
    watch: &Watch<'_>,
) -> Result<Option<Outcome>, ConformError> {
    let judgement = match run_once(command, &write_problem(&case.problem), limits, watch)? {
        Ending::Interrupted => return Ok(None),
        Ending::TimedOut => Judgement::new(
            Label::TimedOut,
            format!("still running after {} s", limits.time.as_secs_f64()),
        ),
        Ending::TooLong => Judgement::new(
            Label::Malformed,
            format!("more than {} bytes on stdout", limits.output),
        ),
        Ending::Ended {
            code: Some(0 | 3),
            stdout,
            ..
        } => match String::from_utf8(stdout) {
            Ok(text) => judge_report(&case, &text),
            Err(_) => Judgement::new(Label::Malformed, "stdout is no UTF-8"),
        },
        Ending::Ended {
            code, complaint, ..
        } => {
            let how = code.map_or_else(
                || "ended by a signal".to_string(),
                |c| format!("exit code {c}"),
            );
            let complaint = if complaint.is_empty() {
                String::new()
            } else {
                format!(": {complaint}")
            };

            Judgement::new(Label::Crashed, how + &complaint)
        }
    };

    Ok(Some(Outcome {
        id: case.id,
        flags: case.flags,
        judgement,
    }))
}
