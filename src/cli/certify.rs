//! `mceip certify`: somebody's floats to certificates, of existence or of absence.
//!
//! Each point of a report is certified as a solution. Where that fails, all solutions near its
//! value are searched: the complete set proves that the point is none, or lists it after all.

use super::common::{CliError, aside, exit, load, positive, print, text};
use super::job::Job;
use super::output::{self, Output};
use crate::say::window_text;
use mceip_check::certificate::{Certificate, Claim};
use mceip_check::{AcceptedClaim, AcceptedCover, ClaimChecker, Proved};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{Certifier, NotCertified, lifted, of_both_signs, of_negative_values};
use mceip_engine::foreign::{BadPoint, ForeignError, ForeignReport, Reported};
use mceip_engine::multistart::{exact_value, is_about, same_x};
use mceip_engine::report::counted;
use mceip_engine::search::complete::Completed;
use mceip_engine::search::near::{Near, near};
use mceip_engine::signs::{BothSigns, OfSign};
use mceip_exact::{Algebraic, Rational, enclosing_decimals};
use mceip_model::{Body, Problem, RealWindow, System, Unknown};
use std::path::{Path, PathBuf};

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

/// Certifies the points of a report and writes the certificate.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let inputs = [args.file.as_path(), args.report.as_path()];
    let output = Output::prepare_if("out", args.out.as_deref(), &inputs)?;
    let signs = BothSigns::of(&problem)?;
    let report = text("the report", &args.report)?;
    let report = match ForeignReport::read(&report, &problem, &signs.own().reduced) {
        Ok(report) => report,
        Err(e @ ForeignError::Digest { .. }) => {
            aside(&format!("rejected: {e}"));
            return Ok(exit::REJECTED);
        }
        Err(e) => return Err(CliError::other_file(&args.report, e)),
    };

    let points = report.solutions;
    let radius = args.absence_radius.as_deref();
    let radius = radius
        .map(|given| positive("absence-radius", given))
        .transpose()?;
    if let Some(folder) = &args.absence {
        output::make(folder)?;
    }

    let job = Job::begin("certifying");
    let own = Certifying::on(signs.own(), radius.as_ref(), &job);
    let reflected = signs.reflected();
    let reflected = reflected.map(|side| Certifying::on(side, radius.as_ref(), &job));
    let mut judged = Judged::default();
    let mut negative = Judged::default();

    for (index, point) in points.iter().enumerate() {
        if job.is_cancelled() {
            job.note(&format!(
                "solutions from {index} on: interrupted before they were looked at"
            ));
            break;
        }

        let reported = match point {
            Ok(reported) => reported,
            // What is no vector has no side to be looked for.
            Err(bad) => {
                judged.add_no_vector(&job, index, bad);
                continue;
            }
        };
        let Some(reflected) = &reflected else {
            own.judge(&mut judged, index, reported);
            continue;
        };
        match Sought::of(&signs, [&own, reflected], &reported.candidate) {
            Sought::Own => own.judge(&mut judged, index, reported),
            Sought::Reflected => reflected.judge(&mut negative, index, reported),
            Sought::Both(reasons) => {
                let of_sides = [&mut judged, &mut negative];
                judge_on_both([&own, reflected], of_sides, index, reported, &reasons)?;
            }
        }
    }
    judged.leave_out_claimed();
    negative.leave_out_claimed();
    job.end();
    if let Body::System(system) = problem.body()
        && args.lifted
    {
        judged.lift(&problem, system);
    }

    negative.leave_out_zeros_of(&judged);
    let mut files = Proved::claims(&problem, judged.take_claims())?;
    if let Some(reflected) = signs.reflected() {
        let below = Proved::claims(&reflected.problem, negative.take_claims())?;
        files = of_both_signs(&problem, files, below)?;
        judged.add_negative(&problem, negative)?;
    }
    if let Some(folder) = &args.absence {
        judged.write_proofs(folder, &inputs)?;
    }
    match output {
        Some(output) => judged.write(output, &files, points.len())?,
        None => judged.print(&files, points.len())?,
    }

    let certified: usize = files.iter().map(|file| file.accepted().claims.len()).sum();
    judged.say_counts(certified, points.len());
    let code = judged.exit_code(points.len());
    Ok(if job.is_cancelled() {
        exit::INTERRUPTED
    } else {
        code
    })
}

/// On which side of 0 a point is looked for.
enum Sought {
    /// Among the values of the problem itself.
    Own,
    /// Among those of its reflection.
    Reflected,
    /// On both: next to 0, and not certified on either, the problem's first, for these reasons.
    Both(Box<[NotCertified; 2]>),
}

impl Sought {
    fn of(
        signs: &BothSigns,
        [own, reflected]: [&Certifying<'_>; 2],
        candidate: &Candidate,
    ) -> Sought {
        let on = |side: &OfSign| {
            if side.problem.is_reflected() {
                Sought::Reflected
            } else {
                Sought::Own
            }
        };
        let certify = |side: &OfSign| {
            let by = if side.problem.is_reflected() {
                reflected
            } else {
                own
            };
            by.certifier.certify(&side.candidate(candidate))
        };

        let (likelier, other) = signs.near(candidate);
        let Some(other) = other else {
            return on(likelier);
        };
        match (certify(likelier), certify(other)) {
            (Ok(_), _) => on(likelier),
            (_, Ok(_)) => on(other),
            (Err(here), Err(there)) => Sought::Both(Box::new(match on(likelier) {
                Sought::Reflected => [there, here],
                _ => [here, there],
            })),
        }
    }
}

/// What becomes of a point next to 0 that is not certified on either side: it is no solution only
/// if it is none on both. The problem and what is judged of it come first, then the reflection.
fn judge_on_both(
    [own, reflected]: [&Certifying<'_>; 2],
    [judged, negative]: [&mut Judged; 2],
    index: usize,
    reported: &Reported,
    reasons: &[NotCertified; 2],
) -> Result<(), CliError> {
    let job = own.job;
    let value = reported.candidate.value;
    let [why_above, why_below] = reasons;
    let above = own.look_nearby(&own.side.candidate(&reported.candidate), why_above);
    if above.verdict == ExaminationVerdict::Present {
        judged.add(job, index, value, above);
        return Ok(());
    }
    let below = reflected.look_nearby(&reflected.side.candidate(&reported.candidate), why_below);
    if below.verdict == ExaminationVerdict::Present {
        negative.add(job, index, value, below);
        return Ok(());
    }

    let neither = above.and_below(&own.side.problem, below)?;
    judged.add(job, index, value, neither);
    Ok(())
}

/// What became of a report: distinct claims that the checker has accepted, and the rest.
#[derive(Default)]
struct Judged {
    certified: Vec<ClaimedPoint>,
    refused: Vec<Refused>,
}

/// A solution of the report that has a certificate of its own.
struct ClaimedPoint {
    /// Its place in the report, from 0.
    index: usize,
    claim: Claim,
    /// What the checker has read off the claim.
    verdict: AcceptedClaim,
}

/// A solution of the report that has no certificate of its own.
struct Refused {
    /// Its place in the report, from 0.
    index: usize,
    finding: Examination,
}

/// What was found about a solution that has no certificate of its own.
struct Examination {
    verdict: ExaminationVerdict,
    /// For people, one line.
    text: String,
    /// The complete set near its value.
    proof: Option<Proved<Certificate>>,
    /// The solution of that set, where it is one.
    solution: Option<AcceptedClaim>,
}

impl Examination {
    /// Are the solutions of two findings one? Surely so if that of one lies in the window of the
    /// other's cover and can be no other solution there.
    fn is_of_one_solution_with(&self, other: &Examination) -> bool {
        self.lists_solution_of(other) || other.lists_solution_of(self)
    }

    fn lists_solution_of(&self, other: &Examination) -> bool {
        let (Some(proof), Some(own), Some(others)) = (&self.proof, &self.solution, &other.solution)
        else {
            return false;
        };

        let window = &proof.certificate().window;
        let begins_within = others.value.lo() >= window.min();
        let ends_within = window.max().is_none_or(|max| others.value.hi() <= max);
        let listed = proof.accepted().cover.iter().flat_map(|c| &c.solutions);
        let possible: Vec<&AcceptedClaim> = listed.filter(|one| may_be_one(one, others)).collect();
        begins_within && ends_within && possible == [own]
    }

    /// What is found of a point next to 0 that is present on neither side.
    fn and_below(self, problem: &Problem, below: Examination) -> Result<Examination, CliError> {
        let is_undecided = |finding: &Examination| finding.verdict == ExaminationVerdict::Undecided;
        let verdict = if is_undecided(&self) || is_undecided(&below) {
            ExaminationVerdict::Undecided
        } else {
            ExaminationVerdict::Disproved
        };
        let proof = match (self.proof, below.proof) {
            (Some(above), Some(below)) => Some(above.with_negative(problem, below)?),
            // One side alone proves nothing of the point.
            _ => None,
        };
        Ok(Examination {
            verdict,
            text: format!("{}; {}", self.text, below.text),
            proof,
            solution: None,
        })
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ExaminationVerdict {
    /// Not a solution, proved.
    Disproved,
    /// A solution after all: the complete set near its value lists it.
    Present,
    Undecided,
}

impl Judged {
    /// Lifts the exact claims to the system. A lifted claim is another one than was accepted, so
    /// the checker sees it too.
    fn lift(&mut self, problem: &Problem, system: &System) {
        let checker = ClaimChecker::new(problem);
        for ClaimedPoint { index, claim, .. } in std::mem::take(&mut self.certified) {
            let claim = as_lifted(system, problem.unknown(), claim);
            match checker.verdict(problem.window(), &claim) {
                Ok(verdict) => self.certified.push(ClaimedPoint {
                    index,
                    claim,
                    verdict,
                }),
                Err(reason) => {
                    let text = format!("undecided: the checker refuses the lifted claim: {reason}");
                    aside(&format!("solution {index}: {text}"));
                    let finding = Examination {
                        verdict: ExaminationVerdict::Undecided,
                        text,
                        proof: None,
                        solution: None,
                    };
                    self.refused.push(Refused { index, finding });
                }
            }
        }
    }

    fn take_claims(&mut self) -> Vec<Claim> {
        let certified = std::mem::take(&mut self.certified).into_iter();
        certified.map(|point| point.claim).collect()
    }

    fn count(&self, verdict: ExaminationVerdict) -> usize {
        let refused = self.refused.iter();
        refused.filter(|r| r.finding.verdict == verdict).count()
    }

    /// Adds what became of the points with values below 0. What is proved of the reflected problem
    /// is said of the given one.
    fn add_negative(&mut self, problem: &Problem, negative: Judged) -> Result<(), CliError> {
        for mut refused in negative.refused {
            if let Some(proof) = refused.finding.proof {
                let said = of_negative_values(problem, proof.into_certificate());
                refused.finding.proof = Some(Proved::new(problem, said)?);
            }
            self.refused.push(refused);
        }
        self.refused.sort_by_key(|refused| refused.index);
        Ok(())
    }

    /// Says that what is no vector of the problem is no solution.
    fn add_no_vector(&mut self, job: &Job, index: usize, bad: &BadPoint) {
        let finding = Examination {
            verdict: ExaminationVerdict::Disproved,
            text: format!("REFUSED: {bad}"),
            proof: None,
            solution: None,
        };
        job.note(&format!("solution {index}: {}", finding.text));
        self.refused.push(Refused { index, finding });
    }

    /// Says what is found of a solution without a claim, and keeps it unless it was listed before.
    fn add(&mut self, job: &Job, index: usize, value: f64, finding: Examination) {
        if self.has(&finding) {
            job.note(&format!("solution {index} (value {value}): listed before"));
            return;
        }

        let text = &finding.text;
        job.note(&format!("solution {index} (value {value}): {text}"));
        self.refused.push(Refused { index, finding });
    }

    /// Is the solution of a finding claimed, or listed by an earlier cover?
    fn has(&self, finding: &Examination) -> bool {
        let mut earlier = self.refused.iter();
        self.is_claimed(finding) || earlier.any(|r| r.finding.is_of_one_solution_with(finding))
    }

    fn is_claimed(&self, finding: &Examination) -> bool {
        let Some(solution) = &finding.solution else {
            return false;
        };

        let mut certified = self.certified.iter();
        certified.any(|point| is_about(&point.verdict, exact_value(&point.claim), solution))
    }

    /// Is this claim about a solution that has one already?
    fn has_claim(&self, claim: &Claim) -> bool {
        let mut certified = self.certified.iter();
        certified.any(|point| same_x(&point.claim, claim))
    }

    /// Takes out solutions with the value 0 that the other side has: both sides have that value.
    fn leave_out_zeros_of(&mut self, other: &Judged) {
        let is_zero = |mut value: Algebraic| value.cmp_rational(&Rational::default()).is_eq();
        self.certified.retain(|point| {
            let has_value_zero = exact_value(&point.claim).is_some_and(is_zero);
            !(has_value_zero && other.has_claim(&point.claim))
        });
    }

    /// Takes out what a cover lists of a solution that a later point of the report has claimed.
    fn leave_out_claimed(&mut self) {
        let refused = std::mem::take(&mut self.refused);
        let rest = refused.into_iter().filter(|r| !self.is_claimed(&r.finding));
        self.refused = rest.collect();
    }

    /// Says what became of so many reported solutions, of which `claimed` have claims of their own.
    fn say_counts(&self, claimed: usize, reported: usize) {
        let disproved = self.count(ExaminationVerdict::Disproved);
        let undecided = self.count(ExaminationVerdict::Undecided);
        let certified = claimed + self.count(ExaminationVerdict::Present);
        let certified = counted(certified, "distinct solution");
        aside(&format!(
            "{certified} certified, {disproved} of {reported} disproved, \
             {undecided} undecided"
        ));
    }

    /// Writes the proof for each refused solution K that has one to absence-K.json.
    fn write_proofs(&self, folder: &Path, inputs: &[&Path]) -> Result<(), CliError> {
        for refused in &self.refused {
            if let Some(proof) = &refused.finding.proof {
                let path = folder.join(format!("absence-{}.json", refused.index));
                let output = Output::prepare("absence", &path, inputs)?;
                output.write(&proof.file()?)?;
            }
        }

        Ok(())
    }

    /// The exit code of a run that was not interrupted.
    fn exit_code(&self, reported: usize) -> u8 {
        if self.count(ExaminationVerdict::Disproved) > 0 {
            exit::REJECTED
        } else if self.count(ExaminationVerdict::Undecided) > 0 || reported == 0 {
            exit::UNDECIDED
        } else {
            exit::DONE
        }
    }

    /// Writes the certificates of all claims.
    fn write(
        &self,
        output: Output,
        files: &[Proved<Certificate>],
        reported: usize,
    ) -> Result<(), CliError> {
        match self.only_proof(files, reported) {
            Some(proof) => output.write(&proof.file()?),
            None if files.is_empty() => Ok(()),
            None => output.write_proved(files),
        }
    }

    /// Prints them, one a line.
    fn print(&self, files: &[Proved<Certificate>], reported: usize) -> Result<(), CliError> {
        if let Some(proof) = self.only_proof(files, reported) {
            return print(&format!("{}\n", proof.file()?));
        }

        for file in files {
            print(&format!("{}\n", file.file()?))?;
        }

        Ok(())
    }

    /// For a report of one solution, its proof is the answer, whichever way it went.
    fn only_proof(
        &self,
        files: &[Proved<Certificate>],
        reported: usize,
    ) -> Option<&Proved<Certificate>> {
        let mut proofs = self.refused.iter().filter_map(|r| r.finding.proof.as_ref());
        let is_only = files.is_empty() && reported == 1;
        proofs.next().filter(|_| is_only)
    }
}

/// Do the values and the supports of two solutions leave room for one?
fn may_be_one(first: &AcceptedClaim, second: &AcceptedClaim) -> bool {
    let is_apart = first.value.hi() < second.value.lo() || second.value.hi() < first.value.lo();
    first.support == second.support && !is_apart
}

/// An exact claim as one about the system, (v, w) over all its degrees of freedom.
fn as_lifted(system: &System, unknown: Unknown, claim: Claim) -> Claim {
    match claim {
        Claim::ExactSolution(c) => Claim::LiftedSolution(lifted(system, unknown, &c)),
        other => other,
    }
}

/// What is needed to judge a point.
struct Certifying<'a> {
    side: &'a OfSign,
    certifier: Certifier<'a>,
    /// How far from its value absence is to be proved, if the user has said it.
    radius: Option<&'a Rational>,
    job: &'a Job,
}

impl<'a> Certifying<'a> {
    fn on(side: &'a OfSign, radius: Option<&'a Rational>, job: &'a Job) -> Certifying<'a> {
        Certifying {
            side,
            certifier: Certifier::new(&side.problem, &side.reduced.pencil),
            radius,
            job,
        }
    }

    /// Certifies a point of the report, or says what becomes of it.
    fn judge(&self, judged: &mut Judged, index: usize, reported: &Reported) {
        let value = reported.candidate.value;
        let candidate = &self.side.candidate(&reported.candidate);
        match self.certifier.certify_with_verdict(candidate) {
            Ok((claim, _)) if judged.has_claim(&claim) => {
                self.job
                    .note(&format!("solution {index} (value {value}): listed before"));
            }
            Ok((claim, verdict)) => judged.certified.push(ClaimedPoint {
                index,
                claim,
                verdict,
            }),
            Err(reason) => {
                let finding = self.look_nearby(candidate, &reason);
                judged.add(self.job, index, value, finding);
            }
        }
    }

    /// Searches for all solutions near a point that was not certified for this reason.
    fn look_nearby(&self, candidate: &Candidate, reason: &NotCertified) -> Examination {
        let problem = &self.side.problem;
        self.job
            .say("no certificate: looking for a proof that there is no solution nearby");
        let found = self
            .job
            .watched(|watch| near(problem, candidate, self.radius, watch));

        match found {
            Ok(Near::OutsideWindow) => Examination {
                verdict: ExaminationVerdict::Disproved,
                text: "REFUSED: its value lies outside the problem's window".into(),
                proof: None,
                solution: None,
            },
            Ok(Near::Absent(proved)) => Examination {
                verdict: ExaminationVerdict::Disproved,
                text: format!(
                    "REFUSED: no solution {} (proved)",
                    interval(problem, &proved)
                ),
                proof: Some(proved.proved),
                solution: None,
            },
            Ok(Near::Others(proved)) => Examination {
                verdict: ExaminationVerdict::Disproved,
                text: format!(
                    "REFUSED: {} there is only {} (proved), with another x: {reason}",
                    interval(problem, &proved),
                    solutions_text(problem, &proved.cover)
                ),
                proof: Some(proved.proved),
                solution: None,
            },
            Ok(Near::Present(proved, solution)) => Examination {
                verdict: ExaminationVerdict::Present,
                text: format!(
                    "certified: listed by a cover {}",
                    interval(problem, &proved)
                ),
                proof: Some(proved.proved),
                solution: Some(solution),
            },
            Ok(Near::Open(searched)) => Examination {
                verdict: ExaminationVerdict::Undecided,
                text: format!(
                    "undecided: {reason}; left {}: {} and {} of solutions{}",
                    interval(problem, &searched),
                    counted(searched.cover.open.len(), "open region"),
                    counted(searched.cover.families.len(), "family"),
                    if searched.has_every_x() {
                        ""
                    } else {
                        ", and solutions whose x is not known"
                    }
                ),
                proof: None,
                solution: None,
            },
            Err(why) => Examination {
                verdict: ExaminationVerdict::Undecided,
                text: format!("undecided: {reason}; no proof of absence either: {why}"),
                proof: None,
                solution: None,
            },
        }
    }
}

/// "[1.5, 1.6] with support [0, 1]", with commas between several.
fn solutions_text(problem: &Problem, cover: &AcceptedCover) -> String {
    let mut solutions = Vec::new();
    for solution in &cover.solutions {
        let mut solution = solution.clone();
        if problem.is_reflected() {
            solution = solution.reflected();
        }
        let (lo, hi) = enclosing_decimals(&solution.value, 15);
        let support = &solution.support;
        solutions.push(format!("[{lo}, {hi}] with support {support:?}"));
    }

    solutions.join(", ")
}

/// "with lambda2 in [a, b]".
fn interval(problem: &Problem, proved: &Completed) -> String {
    let word = problem.unknown().word();
    let window = &proved.proved.certificate().window;
    let window = if problem.is_reflected() {
        RealWindow::reflection(window)
    } else {
        window.into()
    };
    format!("with {word} in {}", window_text(window))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_model::file::read_problem;
    use mceip_model::reduction::reduce;

    const PROBLEM: &str = include_str!("../../spec/examples/two-particles.json");

    /// The claim with a polynomial of which its value is no root.
    fn wrong_claim(claim: &Claim) -> Claim {
        let Claim::ExactSolution(mut wrong) = claim.clone() else {
            panic!("an exact claim")
        };
        wrong.polynomial.reverse();
        Claim::ExactSolution(wrong)
    }

    #[test]
    fn a_refused_lifted_claim_has_its_place_in_the_report() {
        let problem = read_problem(PROBLEM, Path::new(".")).unwrap();
        let Body::System(system) = problem.body() else {
            panic!("a system")
        };
        let pencil = reduce(&problem).unwrap().pencil;
        let candidate = Candidate {
            value: 1.48,
            x: vec![0.5, 0.5],
        };
        let certifier = Certifier::new(&problem, &pencil);
        let (claim, verdict) = certifier.certify_with_verdict(&candidate).unwrap();

        let mut judged = Judged::default();
        for (index, claim) in [(0, claim.clone()), (4, wrong_claim(&claim))] {
            let verdict = verdict.clone();
            judged.certified.push(ClaimedPoint {
                index,
                claim,
                verdict,
            });
        }
        judged.lift(&problem, system);

        let [kept] = &judged.certified[..] else {
            panic!("one point is kept")
        };
        assert_eq!(kept.index, 0);
        assert!(matches!(kept.claim, Claim::LiftedSolution(_)));
        let places: Vec<usize> = judged.refused.iter().map(|r| r.index).collect();
        assert_eq!(places, [4]);
    }
}
