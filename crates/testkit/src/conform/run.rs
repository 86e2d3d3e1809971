//! All cases through a foreign program, in parallel; the outcome does not depend on the number of
//! threads.
//!
//! Input: a plan (cases, limits, threads) and a command. Output: the outcome of each case, in the
//! order of the plan. Called by `mceip conform`.

use super::case::{Case, Difficulty, Draft, Group};
use super::certified::Completeness;
use super::flag::{Flag, FlagChoice};
use super::groups::random_draft;
use super::judge::{Judgement, Label, judge_until};
use super::lines::LineProgram;
use super::process::{ProcessEnding, ProcessLimits, run_once};
use crate::error::TestkitError;
use crate::generators::random_order;
use mceip_engine::run::{Progress, Watch, in_threads};
use mceip_model::file::write_problem;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// What to run.
#[derive(Debug, Clone)]
pub struct ConformPlan {
    /// Cases of the pack.
    pub groups: Vec<Group>,
    /// Send the cases in an order drawn from the seed, under names that say nothing?
    pub anonymous: bool,
    /// Random cases besides.
    pub random: usize,
    /// Their seed, and that of the order of anonymous cases.
    pub seed: u64,
    /// Send reduced pencils in place of mechanical systems.
    pub as_pencil: bool,
    /// Which cases.
    pub choice: FlagChoice,
    /// Does the program answer many problems, a line each, or is it started for each?
    pub by_lines: bool,
    /// Limits of one answer.
    pub limits: ProcessLimits,
    /// Threads; `None`: all cores.
    pub threads: Option<usize>,
}

/// What came of one case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseOutcome {
    /// The case.
    pub id: String,
    /// Digest of the problem as it was sent.
    pub problem_sha256: String,
    /// What it is about.
    pub flags: BTreeSet<Flag>,
    /// How hard it has been found to be.
    pub difficulty: Option<Difficulty>,
    /// What is known of its answer where the plain oracle has not made it.
    pub completeness: Option<Completeness>,
    /// Parts of its answer.
    pub expected: usize,
    /// What the program did.
    pub judgement: Judgement,
    /// Seconds that it took, with its start where it was started for the case.
    pub seconds: f64,
}

/// Runs every case of the plan through the command, on the plan's threads, and judges what it
/// prints. Outcomes come in the order of the plan; cases not reached before an interrupt are left
/// out.
///
/// # Errors
/// [`TestkitError`] if the command does not start, or a problem is beyond the plain oracle.
pub fn run(
    plan: &ConformPlan,
    command: &[String],
    watch: &Watch<'_>,
) -> Result<Vec<CaseOutcome>, TestkitError> {
    let fixed: Vec<&Draft> = plan.groups.iter().flat_map(|g| &g.drafts).collect();
    let total = fixed.len() + plan.random;
    let run = Run {
        plan,
        fixed,
        command,
        watch,
        total,
        finished: AtomicUsize::new(0),
        has_answered: AtomicBool::new(false),
        idle: Mutex::new(Vec::new()),
    };

    // The cases in the order in which they are sent.
    let sent = if plan.anonymous {
        let mut rng = ChaCha8Rng::seed_from_u64(plan.seed);
        random_order(&mut rng, total)
    } else {
        (0..total).collect()
    };

    // One case per task: they take very different times.
    let outcomes = in_threads(plan.threads, || {
        sent.par_iter()
            .with_max_len(1)
            .enumerate()
            .map(|(place, k)| Ok((*k, run.outcome(*k, place)?)))
            .collect::<Result<Vec<_>, TestkitError>>()
    })?;

    let mut in_order: Vec<Option<CaseOutcome>> = vec![None; total];
    for (k, outcome) in outcomes {
        in_order[k] = outcome;
    }
    Ok(in_order.into_iter().flatten().collect())
}

/// A judgement, and the seconds that the program took.
struct TimedJudgement {
    judgement: Judgement,
    seconds: f64,
}

/// A run at work, shared by its threads.
struct Run<'a> {
    plan: &'a ConformPlan,
    /// The cases of the pack; the random ones come after them.
    fixed: Vec<&'a Draft>,
    command: &'a [String],
    watch: &'a Watch<'a>,
    total: usize,
    finished: AtomicUsize,
    /// Has the command printed anything for a case?
    has_answered: AtomicBool,
    /// Programs that answer line by line and wait for a problem; at most one for each thread.
    idle: Mutex<Vec<LineProgram<'a>>>,
}

impl Run<'_> {
    /// What comes of the `k`-th case, sent as the one at this place. `None` for a case that the
    /// plan leaves out or that was interrupted.
    fn outcome(&self, k: usize, place: usize) -> Result<Option<CaseOutcome>, TestkitError> {
        if self.watch.is_cancelled() {
            return Ok(None);
        }

        let case = match self.case(k) {
            Ok(case) => case,
            // What was cancelled is no answer.
            Err(_) if self.watch.is_cancelled() => return Ok(None),
            Err(error) => return Err(error),
        };
        let timed = if self.plan.choice.takes(&case.flags) {
            self.judgement(&case, place)?
        } else {
            None
        };

        let finished = self.finished.fetch_add(1, Ordering::Relaxed) + 1;
        let progress = Progress::of("cases", finished, self.total);
        self.watch.report(&progress);

        Ok(timed.map(|timed| CaseOutcome {
            problem_sha256: case.problem().sha256(),
            difficulty: case.difficulty,
            completeness: case.completeness(),
            expected: case.parts(),
            id: case.id,
            flags: case.flags,
            judgement: timed.judgement,
            seconds: timed.seconds,
        }))
    }

    /// The `k`-th case with its answer.
    fn case(&self, k: usize) -> Result<Case, TestkitError> {
        if let Some(draft) = self.fixed.get(k) {
            return Case::answer(draft, self.plan.as_pencil, self.watch);
        }

        let draft = random_draft(k - self.fixed.len(), self.plan.seed)
            .map_err(|e| TestkitError::problem(&format!("random case {k}"), e))?;
        Case::answer(&draft, self.plan.as_pencil, self.watch)
    }

    /// Sends the case to the program and judges how it ends. `None` if it was interrupted.
    fn judgement(&self, case: &Case, place: usize) -> Result<Option<TimedJudgement>, TestkitError> {
        let input = if self.plan.anonymous {
            write_problem(&case.problem_named(format!("problem {}", place + 1)))
        } else {
            write_problem(case.problem())
        };
        if self.plan.by_lines {
            return self.judgement_by_lines(case, &input);
        }

        self.timed(case, || {
            run_once(self.command, &input, &self.plan.limits, self.watch)
        })
    }

    /// The same with a program that answers line by line: one that waits, or one started for the
    /// case. What is not right of one that waited may be left of the case before it, so the case is
    /// asked of a new program, whose answer counts.
    fn judgement_by_lines(
        &self,
        case: &Case,
        input: &str,
    ) -> Result<Option<TimedJudgement>, TestkitError> {
        let waiting = lock(&self.idle).pop();
        let mut program =
            waiting.unwrap_or_else(|| LineProgram::new(self.command, self.plan.limits));

        let mut timed = self.timed(case, || program.ask(input, self.watch))?;
        let falls_short = |timed: &TimedJudgement| timed.judgement.label != Label::Correct;
        if program.has_answered_before() && timed.as_ref().is_some_and(falls_short) {
            program.renew();
            timed = self.timed(case, || program.ask(input, self.watch))?;
        }
        lock(&self.idle).push(program);

        Ok(timed)
    }

    /// Asks, and judges how that ended; the time is that of the program alone.
    fn timed(
        &self,
        case: &Case,
        ask: impl FnOnce() -> Result<ProcessEnding, TestkitError>,
    ) -> Result<Option<TimedJudgement>, TestkitError> {
        let begun = Instant::now();
        let ending = ask()?;
        let seconds = begun.elapsed().as_secs_f64();

        let judgement = self.judged(case, ending);
        Ok(judgement.map(|judgement| TimedJudgement { judgement, seconds }))
    }

    /// What is known of a program that has not answered in time, beside the time.
    ///
    /// Only one that has never answered may wait for the end of its input.
    fn without_an_answer(&self) -> &'static str {
        if !self.plan.by_lines {
            ""
        } else if self.has_answered.load(Ordering::Relaxed) {
            " without a line for this problem; it has answered others"
        } else {
            " without a line: with --lines a program answers each line as it comes, flushes its \
             output and does not read to the end of its input"
        }
    }

    /// The judgement on how the program ended. `None` if it was interrupted.
    fn judged(&self, case: &Case, ending: ProcessEnding) -> Option<Judgement> {
        let limits = &self.plan.limits;
        let watch = self.watch;
        let judgement = match ending {
            ProcessEnding::Interrupted => return None,
            ProcessEnding::TimedOut => {
                let seconds = limits.time.as_secs_f64();
                let how = self.without_an_answer();
                Judgement::new(
                    Label::TimedOut,
                    format!("still running after {seconds} s{how}"),
                )
            }
            ProcessEnding::TooLong => {
                let bytes = limits.output;
                Judgement::new(
                    Label::Malformed,
                    format!("more than {bytes} bytes on stdout"),
                )
            }
            ProcessEnding::Ended {
                code: Some(0 | 3),
                stdout,
                ..
            } => match String::from_utf8(stdout) {
                Ok(text) => {
                    if !text.is_empty() {
                        self.has_answered.store(true, Ordering::Relaxed);
                    }
                    let begun = Instant::now();
                    let is_over = || begun.elapsed() > limits.time || watch.is_cancelled();
                    judge_until(case, &text, &is_over)
                }
                Err(_) => Judgement::new(Label::Malformed, "stdout is no UTF-8"),
            },
            ProcessEnding::Ended {
                code, complaint, ..
            } => crashed(code, &complaint),
        };

        // What an interrupt has cut short says nothing about the program.
        let is_cut_short = judgement.label == Label::Undecided && watch.is_cancelled();
        (!is_cut_short).then_some(judgement)
    }
}

/// The programs; a thread that panicked with the lock leaves the list whole.
fn lock<'m, 'a>(idle: &'m Mutex<Vec<LineProgram<'a>>>) -> MutexGuard<'m, Vec<LineProgram<'a>>> {
    idle.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A program that ended by a signal, or with an exit code that says that it failed.
fn crashed(code: Option<i32>, complaint: &str) -> Judgement {
    let mut why = match code {
        Some(code) => format!("exit code {code}"),
        None => "ended by a signal".to_string(),
    };
    if !complaint.is_empty() {
        why += &format!(": {complaint}");
    }
    Judgement::new(Label::Crashed, why)
}
