//! `mceip certify`: somebody's floats to certificates, of existence or of absence.

use super::common::{CliError, exit, load, print, text};
use super::job::Job;
use super::output::Output;
use crate::candidate::Candidate;
use crate::certificate::{Certificate, Claim};
use crate::certify::{Certifier, NotCertified, certificate, lifted, sift};
use crate::exact::{Interval, Rational, enclosing_decimals, parse};
use crate::foreign::{ForeignError, ForeignReport};
use crate::model::{Body, Pencil, Problem, System, Unknown};
use crate::multistart::same;
use crate::reduction::reduce;
use crate::search::complete::{CompleteError, Completed};
use crate::search::near::{Near, near};
use num_traits::Signed;
use std::path::PathBuf;

/// Arguments of `certify`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Solution report (mceip-solutions/1); of each solution only `value` and `x` are used, of a
    /// mechanical system `v` where there is no `x`. A `problem_sha256` in it must be the problem's.
    report: PathBuf,
    /// Write the certificate here instead of to stdout.
    #[arg(long)]
    out: Option<PathBuf>,
    /// For a mechanical system: state exact solutions as (v, w) over all degrees of freedom, each
    /// line of (9) checkable.
    #[arg(long)]
    lifted: bool,
    /// A solution that cannot be certified: prove what lies within this distance of its value.
    /// Default: 1e-4 (1 + |value|), then smaller ones, until a proof is found.
    #[arg(long, value_name = "R", allow_hyphen_values = true)]
    absence_radius: Option<String>,
    /// Write the proof for refused solution K to DIR/absence-K.json.
    #[arg(long, value_name = "DIR")]
    absence: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let output = args
        .out
        .as_ref()
        .map(|path| Output::prepare("out", path, &[&args.file, &args.report]))
        .transpose()?;
    let reduced = reduce(&problem)?;
    let report = match ForeignReport::read(&text("the report", &args.report)?, &problem, &reduced) {
        Ok(report) => report,
        Err(e @ ForeignError::Digest { .. }) => {
            eprintln!("rejected: {e}");
            return Ok(exit::REJECTED);
        }
        Err(source) => {
            return Err(CliError::Foreign {
                path: args.report.display().to_string(),
                source,
            });
        }
    };
    let candidates = candidates(report)?;
    let radius = args
        .absence_radius
        .as_deref()
        .map(parse_radius)
        .transpose()?;
    let outputs = absence_outputs(args, candidates.len())?;
    let job = Job::begin("certifying");
    let mut judged = judge(
        &problem,
        &reduced.pencil,
        &candidates,
        radius.as_ref(),
        &job,
    );
    job.end();
    if let (true, Body::System(system)) = (args.lifted, problem.body()) {
        judged.lift(&problem, system);
    }
    let (disproved, undecided) = (
        judged.count(Verdict::Disproved),
        judged.count(Verdict::Undecided),
    );
    eprintln!(
        "{} distinct solutions certified, {disproved} of {} disproved, {undecided} undecided",
        judged.claims.len() + judged.refused.len() - disproved - undecided,
        candidates.len()
    );
    for r in &judged.refused {
        if let (Some(proof), Some(path)) = (&r.proof, outputs.get(r.index)) {
            Output::prepare("absence", path, &[&args.file, &args.report])?
                .write(&proof.to_json())?;
        }
    }
    if let Some(certificate) = judged.answer(&problem, candidates.len()) {
        match output {
            Some(output) => output.write(&certificate.to_json())?,
            None => print(&format!("{}\n", certificate.to_json()))?,
        }
    }
    Ok(match () {
        () if job.is_cancelled() => exit::INTERRUPTED,
        () if disproved > 0 => exit::REJECTED,
        () if undecided > 0 || candidates.is_empty() => exit::UNDECIDED,
        () => exit::DONE,
    })
}

/// The points of a report, all of which must be vectors of the problem.
fn candidates(report: ForeignReport) -> Result<Vec<Candidate>, CliError> {
    let mut candidates = Vec::new();
    for reported in report.solutions {
        candidates.push(reported?.candidate);
    }
    Ok(candidates)
}

/// What became of a report: distinct claims that the checker has accepted, and the rest.
#[derive(Default)]
struct Judged {
    claims: Vec<Claim>,
    refused: Vec<Refused>,
}

/// An exact claim as one about the system, (v, w) over all its degrees of freedom.
fn as_lifted(system: &System, unknown: Unknown, claim: Claim) -> Claim {
    match claim {
        Claim::ExactSolution(c) => Claim::LiftedSolution(lifted(system, unknown, &c)),
        other => other,
    }
}

impl Judged {
    /// Lifts the exact claims to the system. A lifted claim is another one than was accepted, so
    /// the checker sees it too.
    fn lift(&mut self, problem: &Problem, system: &System) {
        let claims = std::mem::take(&mut self.claims);
        let lifted = claims
            .into_iter()
            .map(|claim| as_lifted(system, problem.unknown(), claim))
            .collect();

        let sifted = sift(problem, lifted);
        self.claims = sifted.accepted;
        for (index, reason) in sifted.refused {
            let text = format!("undecided: the checker refuses the lifted claim: {reason}");
            eprintln!("claim {index}: {text}");
            self.refused.push(Refused {
                index,
                verdict: Verdict::Undecided,
                text,
                proof: None,
            });
        }
    }

    fn count(&self, verdict: Verdict) -> usize {
        self.refused.iter().filter(|r| r.verdict == verdict).count()
    }

    /// The certificate of all claims; for a report of one solution its proof is the answer,
    /// whichever way it went.
    fn answer(self, problem: &Problem, reported: usize) -> Option<Certificate> {
        if !self.claims.is_empty() {
            return Some(certificate(problem, self.claims));
        }
        self.refused
            .into_iter()
            .find_map(|r| r.proof)
            .filter(|_| reported == 1)
    }
}

/// Certifies one after the other and says what becomes of each, until interrupted.
fn judge(
    problem: &Problem,
    pencil: &Pencil,
    candidates: &[Candidate],
    radius: Option<&Rational>,
    job: &Job,
) -> Judged {
    let certifier = Certifier::new(problem, pencil);
    let mut judged = Judged::default();
    for (k, candidate) in candidates.iter().enumerate() {
        if job.is_cancelled() {
            job.note(&format!(
                "solution {k}: interrupted before it was looked at"
            ));
            break;
        }
        match certifier.certify(candidate) {
            Ok(claim) if judged.claims.iter().any(|c| same(c, &claim)) => {
                job.note(&format!(
                    "solution {k} (value {}): listed before",
                    candidate.value
                ));
            }
            Ok(claim) => judged.claims.push(claim),
            Err(reason) => {
                let r = Refused::of(problem, candidate, radius, &reason, job);
                job.note(&format!(
                    "solution {k} (value {}): {}",
                    candidate.value, r.text
                ));
                judged.refused.push(Refused { index: k, ..r });
            }
        }
    }
    judged
}

/// Where the proofs of absence go, by index in the report; none without `--absence`.
fn absence_outputs(args: &Args, count: usize) -> Result<Vec<PathBuf>, CliError> {
    let Some(folder) = &args.absence else {
        return Ok(Vec::new());
    };
    std::fs::create_dir_all(folder).map_err(|e| CliError::write(folder.display(), &e))?;
    Ok((0..count)
        .map(|k| folder.join(format!("absence-{k}.json")))
        .collect())
}

fn parse_radius(text: &str) -> Result<Rational, CliError> {
    let bad = || CliError::Option {
        option: "absence-radius",
        expected: "a number > 0",
        got: text.chars().take(60).collect(),
    };
    parse(text)
        .ok()
        .filter(Rational::is_positive)
        .ok_or_else(bad)
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    /// Not a solution, proved.
    Disproved,
    /// A solution after all: the complete set near its value lists it.
    Present,
    Undecided,
}

/// A solution of the report that has no certificate of its own.
struct Refused {
    index: usize,
    verdict: Verdict,
    /// For people, one line.
    text: String,
    /// The complete set near its value.
    proof: Option<Certificate>,
}

impl Refused {
    fn of(
        problem: &Problem,
        candidate: &Candidate,
        radius: Option<&Rational>,
        reason: &NotCertified,
        job: &Job,
    ) -> Refused {
        job.say("no certificate: looking for a proof that there is no solution nearby");
        let found = job.watched(|watch| near(problem, candidate, radius, watch));
        let with = |verdict, text, proof: Completed| Refused {
            index: 0,
            verdict,
            text,
            proof: Some(proof.certificate),
        };
        match found {
            Ok(Near::OutsideWindow) => {
                let text = "REFUSED: its value lies outside the problem's window".into();
                Refused {
                    index: 0,
                    verdict: Verdict::Disproved,
                    text,
                    proof: None,
                }
            }
            Ok(Near::Absent(c)) => with(
                Verdict::Disproved,
                format!("REFUSED: no solution {} (proved)", interval(problem, &c)),
                c,
            ),
            Ok(Near::Others(c)) => {
                let list: Vec<String> = c
                    .cover
                    .solutions
                    .iter()
                    .map(|s| {
                        let (lo, hi) = enclosing_decimals(&s.value, 15);
                        format!("[{lo}, {hi}] with slip {:?}", s.support)
                    })
                    .collect();
                let text = format!(
                    "REFUSED: {} there is only {} (proved), with another x: {reason}",
                    interval(problem, &c),
                    list.join(", ")
                );
                with(Verdict::Disproved, text, c)
            }
            Ok(Near::Present(c)) => with(
                Verdict::Present,
                format!("certified: listed by a cover {}", interval(problem, &c)),
                c,
            ),
            Ok(Near::Open(c)) => {
                let text = format!(
                    "undecided: {reason}; {} regions stay open and {} families of solutions lie {}",
                    c.cover.open.len(),
                    c.cover.families.len(),
                    interval(problem, &c)
                );
                Refused {
                    index: 0,
                    verdict: Verdict::Undecided,
                    text,
                    proof: None,
                }
            }
            Err(e) => Refused::undecided(reason, &e),
        }
    }

    fn undecided(reason: &NotCertified, why: &CompleteError) -> Refused {
        Refused {
            index: 0,
            verdict: Verdict::Undecided,
            text: format!("undecided: {reason}; no proof of absence either: {why}"),
            proof: None,
        }
    }
}

/// "with lambda2 in [a, b]".
fn interval(problem: &Problem, proved: &Completed) -> String {
    let window = &proved.certificate.window;
    let max = window
        .max()
        .map_or_else(|| "infinity)".into(), |max| format!("{}]", decimal(max)));
    format!(
        "with {} in [{}, {max}",
        problem.unknown().word(),
        decimal(window.min())
    )
}

/// The ends of such a window are short decimals, or those of the problem's window: exact where 17
/// digits suffice.
fn decimal(v: &Rational) -> String {
    let (lo, hi) = enclosing_decimals(&Interval::point(v.clone()), 17);
    match lo == hi {
        true if lo.contains('.') && !lo.contains('e') => {
            lo.trim_end_matches('0').trim_end_matches('.').into()
        }
        true => lo,
        false => v.to_string(),
    }
}
