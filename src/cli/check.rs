//! `mceip check`: a certificate or somebody's solutions against a problem, one verdict.
//!
//! The formats of the files decide what is done. A certificate, of solutions and complete sets, of
//! absence below a friction, of presence or of stability in an interval of friction, or of contact
//! states, goes to the checker, which accepts or rejects it. Somebody's solutions are certified and
//! checked one by one, or refuted ([`foreign`]). A solution file of a plain LCP or MCP is evaluated
//! exactly ([`plain`]).

pub(super) mod plain;

use super::common::{CliError, exit, load, parse_window, print, text};
use super::job::{Job, decided};
use super::path::read_loads_of;
use crate::say::path::LETTERS;
use crate::say::{self, number_text, window_text};
use mceip_check::certificate::{
    CERTIFICATE_FORMAT, CRITICAL_FORMAT, Certificate, CriticalCertificate, EQUILIBRIUM_FORMAT,
    EquilibriumCertificate, PRESENCE_FORMAT, PresenceCertificate, STABILITY_FORMAT,
    StabilityCertificate,
};
use mceip_check::{
    Accepted, AcceptedAbsence, AcceptedClaim, AcceptedCover, AcceptedEquilibrium, AcceptedPresence,
    AcceptedStability, Place, Provable, Rejected, check, with_short_numbers,
};
use mceip_engine::candidate::SOLUTIONS_FORMAT;
use mceip_engine::foreign::{Effort, ForeignError, ForeignReport, ForeignVerdict, judge};
use mceip_engine::lcp::MCP_FORMAT;
use mceip_engine::lean::{HasAnchors, LEAN_FORMAT, elaborate, skeleton};
use mceip_engine::report::counted;
use mceip_engine::run::Progress;
use mceip_engine::signs::BothSigns;
use mceip_engine::tolerance::{AGREEMENT, AGREEMENT_RANGE, FINEST_AGREEMENT, VALUE_RADIUS};
use mceip_exact::{enclosing_decimals, parse, to_f64};
use mceip_model::file::{LOADS_FORMAT, Object, from_json, require_format};
use mceip_model::{LoadedBody, ModelError, Problem, RealWindow, Unknown};
use num_traits::Zero;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Arguments of `check`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1), a body under loads (mceip-loads/1), or a plain LCP or MCP
    /// (mceip-mcp/1).
    file: PathBuf,
    /// Certificate (mceip-certificate/1, mceip-critical/1, mceip-presence/1, mceip-stability/1; of
    /// a body under loads mceip-equilibrium/1), the lean form of one (mceip-lean/1), or somebody's
    /// solutions (mceip-solutions/1): each of those is certified and checked, or refuted. Of a
    /// plain problem: its solution file (mceip-mcp-solution/1).
    certificate: PathBuf,
    /// Demand a certificate whose window covers the closed window a,b (b empty or inf: no upper
    /// end; of eigenvalues a empty or -inf: no lower end); one that does not is rejected.
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Of somebody's solutions: the relative error up to which a value and x (scaled to largest
    /// |x_i| = 1) agree with the proven solution [default: 1e-6].
    #[arg(long, value_name = "ERROR")]
    tolerance: Option<String>,
}

/// Judges the second file and prints the verdict.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let stdin = Path::new("-");
    if args.file == stdin && args.certificate == stdin {
        let expected = "only one of the two files to be stdin";
        return Err(CliError::option("certificate", expected, "-"));
    }

    let tolerance = args.tolerance.as_deref().map(parse_tolerance).transpose()?;

    let problem = text("the problem", &args.file)?;
    if require_format(&problem, MCP_FORMAT).is_ok() {
        refuse_options(args, "a plain problem")?;
        return plain::verdict(&args.file, &problem, &args.certificate);
    }

    if require_format(&problem, LOADS_FORMAT).is_ok() {
        refuse_options(args, EQUILIBRIUM_FORMAT)?;
        let loads = read_loads_of(&problem, &args.file)?;
        let source = text("the certificate", &args.certificate)?;
        let certificate: EquilibriumCertificate = read(args, &source)?;
        return verdict(&certificate, loads.body(), equilibrium_text);
    }

    let problem = load(&args.file, None)?;
    let source = text("the certificate", &args.certificate)?;
    if require_format(&source, SOLUTIONS_FORMAT).is_ok() {
        refuse_window(args, SOLUTIONS_FORMAT)?;
        return foreign(args, &problem, &source, tolerance.unwrap_or(AGREEMENT));
    }

    refuse_unnamed_report(&source).map_err(|e| CliError::other_file(&args.certificate, e))?;

    let is_lean = require_format(&source, LEAN_FORMAT).is_ok();
    let source = if is_lean {
        skeleton(&source).map_err(|e| CliError::other_file(&args.certificate, e))?
    } else {
        source
    };
    let given = AnchoredSource {
        args,
        problem: &problem,
        source: &source,
        is_lean,
    };

    if require_format(&source, CRITICAL_FORMAT).is_ok() {
        refuse_options(args, CRITICAL_FORMAT)?;
        return given.judged(|certificate: &CriticalCertificate| {
            verdict(certificate, &problem, absence_text)
        });
    }

    if require_format(&source, PRESENCE_FORMAT).is_ok() {
        refuse_options(args, PRESENCE_FORMAT)?;
        return given.judged(|certificate: &PresenceCertificate| {
            verdict(certificate, &problem, presence_text)
        });
    }

    if require_format(&source, STABILITY_FORMAT).is_ok() {
        refuse_options(args, STABILITY_FORMAT)?;
        let certificate: StabilityCertificate = read(args, &source)?;
        return verdict(&certificate, &problem, stability_text);
    }

    refuse_tolerance(args, CERTIFICATE_FORMAT)?;
    let demanded = args.window.as_deref();
    let demanded = demanded.map(|text| parse_window(text, problem.unknown()));
    let demanded = demanded.transpose()?;
    given.judged(
        |certificate: &Certificate| match decided(|| check(&problem, certificate)) {
            Ok(accepted) => say_accepted(&problem, certificate, &accepted, demanded.as_ref()),
            Err(rejected) => say_rejected(&rejected),
        },
    )
}

/// Refuses a list of solutions whose format is missing or misspelt as what it is.
fn refuse_unnamed_report(source: &str) -> Result<(), ModelError> {
    #[derive(Deserialize)]
    struct SolutionsField {
        solutions: Option<IgnoredAny>,
    }

    let field: Result<Object<SolutionsField>, ModelError> = from_json(source);
    let lists_solutions = field.is_ok_and(|Object(field)| field.solutions.is_some());
    if !lists_solutions {
        return Ok(());
    }

    let certificates = [
        CERTIFICATE_FORMAT,
        CRITICAL_FORMAT,
        PRESENCE_FORMAT,
        STABILITY_FORMAT,
        LEAN_FORMAT,
    ];
    let mut certificates = certificates.into_iter();
    if certificates.any(|format| require_format(source, format).is_ok()) {
        return Ok(());
    }
    require_format(source, SOLUTIONS_FORMAT)
}

/// A certificate with anchors, as a file has it or as a lean file leaves it to be made anew.
struct AnchoredSource<'a> {
    args: &'a Args,
    problem: &'a Problem,
    source: &'a str,
    is_lean: bool,
}

impl AnchoredSource<'_> {
    /// The verdict on the certificate, with what a lean file leaves out made anew.
    fn judged<C: HasAnchors>(
        &self,
        verdict: impl FnOnce(&C) -> Result<u8, CliError>,
    ) -> Result<u8, CliError> {
        let mut certificate: C = read(self.args, self.source)?;
        if self.is_lean {
            let job = Job::begin_with_nothing_to_keep("making W and V anew");
            let made = job.watched(|watch| elaborate(self.problem, &mut certificate, watch));
            job.end();
            if let Err(e) = made {
                return say_rejected(&e);
            }
        }

        verdict(&certificate)
    }
}

fn read<C: Provable>(args: &Args, source: &str) -> Result<C, CliError> {
    C::read(source).map_err(|e| CliError::file(&args.certificate, e))
}

fn say_rejected(why: &impl std::fmt::Display) -> Result<u8, CliError> {
    print(&format!("REJECTED: {why}\n"))?;
    Ok(exit::REJECTED)
}

/// The verdict on a certificate of a kind that leaves nothing open; `proved` says what an accepted
/// one has proved.
fn verdict<C: Provable>(
    certificate: &C,
    subject: &C::Subject,
    proved: fn(&C::Subject, &C::Accepted) -> String,
) -> Result<u8, CliError> {
    let checked = decided(|| {
        let accepted = certificate.check(subject)?;
        Ok::<_, Rejected>(proved(subject, &accepted))
    });
    match checked {
        Ok(text) => {
            print(&text)?;
            Ok(exit::DONE)
        }
        Err(rejected) => say_rejected(&rejected),
    }
}

/// No solution below a friction.
fn absence_text(problem: &Problem, accepted: &AcceptedAbsence) -> String {
    let AcceptedAbsence {
        from,
        below,
        leaves,
        is_of_every_member,
    } = accepted;
    let of = members(*is_of_every_member);
    let digest = problem.sha256();
    let leaves = counted(*leaves, "leaf");
    let evidence = format!("lambda2, problem {digest}, {leaves} accepted");
    // At mu = 0 a slip particle may slide both ways, of which (9) has one.
    let begin = if from.is_zero() { "(" } else { "[" };
    let [from, below] = [from, below].map(number_text);
    let window = format!("friction in {begin}{from}, {below}], lambda2 in [0, infinity)");
    format!("ABSENT for {window}: no solution{of} ({evidence})\n")
}

/// Of which bodies something is said.
fn members(is_of_every_member: bool) -> &'static str {
    if is_of_every_member {
        ", for every body within the radii of the data"
    } else {
        ""
    }
}

/// Contact states under loads, and the digests of the eigenproblems that certificates about these
/// states name.
fn equilibrium_text(body: &LoadedBody, accepted: &AcceptedEquilibrium) -> String {
    let AcceptedEquilibrium {
        friction,
        amounts,
        states,
    } = accepted;
    let letters: String = states.iter().map(|state| state.letter()).collect();
    let amounts: Vec<String> = amounts.iter().map(number_text).collect();

    let mut digests = format!("loads {}", body.sha256());
    for unknown in [Unknown::Mu, Unknown::Lambda2] {
        // None where nothing slips, or without a mass.
        if let Ok(problem) = body.problem(states, friction, unknown) {
            digests += &format!("; its {} problem {}", unknown.word(), problem.sha256());
        }
    }

    format!(
        "EQUILIBRIUM: under the loads times {}, with friction {}, there is one in the contact \
         states {letters} ({LETTERS}; {digests})\n",
        amounts.join(", "),
        number_text(friction)
    )
}

/// A solution in an interval of friction.
fn presence_text(problem: &Problem, accepted: &AcceptedPresence) -> String {
    let AcceptedPresence {
        from,
        to,
        pieces,
        is_of_every_member,
    } = accepted;
    let of = members(*is_of_every_member);
    let digest = problem.sha256();
    let pieces = counted(*pieces, "piece");
    let evidence = format!("lambda2, problem {digest}, {pieces} accepted");
    let [from, to] = [from, to].map(number_text);
    format!(
        "PRESENT for every friction in [{from}, {to}]: a solution with lambda2 >= 0{of} \
         ({evidence})\n"
    )
}

/// Stability in an interval of friction.
fn stability_text(problem: &Problem, accepted: &AcceptedStability) -> String {
    let AcceptedStability {
        from,
        to,
        is_of_every_motion,
    } = accepted;
    let digest = problem.sha256();
    // The theorem speaks of mu > 0.
    let begin = if from.is_zero() { "(" } else { "[" };
    let [from, to] = [from, to].map(number_text);
    let which = if *is_of_every_motion {
        "motions that begin"
    } else {
        "motions that keep to the contact states and begin"
    };
    format!(
        "STABLE for every friction in {begin}{from}, {to}]: {which} near an equilibrium in these \
         contact states, in contact, stay near it (problem {digest})\n"
    )
}

/// Refuses the options that say nothing about a file of this kind.
fn refuse_options(args: &Args, kind: &str) -> Result<(), CliError> {
    refuse_window(args, kind)?;
    refuse_tolerance(args, kind)
}

/// Refuses --window, which says nothing about a file of this kind.
fn refuse_window(args: &Args, kind: &str) -> Result<(), CliError> {
    match args.window {
        None => Ok(()),
        Some(_) => {
            let expected = "it with a certificate only";
            Err(CliError::option("window", expected, kind))
        }
    }
}

/// Refuses --tolerance, which says nothing about a file of this kind.
fn refuse_tolerance(args: &Args, kind: &str) -> Result<(), CliError> {
    match args.tolerance {
        None => Ok(()),
        Some(_) => {
            let expected = "it with somebody's solutions only";
            Err(CliError::option("tolerance", expected, kind))
        }
    }
}

/// A relative error between [`FINEST_AGREEMENT`] and [`VALUE_RADIUS`], where solutions are looked
/// for.
fn parse_tolerance(given: &str) -> Result<f64, CliError> {
    let range = FINEST_AGREEMENT..=VALUE_RADIUS;
    let tolerance = parse(given).ok().map(|value| to_f64(&value));
    let within = tolerance.filter(|value| range.contains(value));
    within.ok_or_else(|| CliError::option("tolerance", AGREEMENT_RANGE, given))
}

/// Prints what an accepted certificate has proved: its claims, its cover, and the verdict with its
/// window.
fn say_accepted(
    problem: &Problem,
    certificate: &Certificate,
    accepted: &Accepted,
    demanded: Option<&RealWindow>,
) -> Result<u8, CliError> {
    let windows = certificate.windows();
    let cover = accepted.cover.as_ref();
    let mut out = String::new();
    let negative = certificate.negative.as_ref();
    let mut claimed = BTreeSet::new();
    for (k, claim) in accepted.claims.iter().enumerate() {
        // A claim has a place in the complete set of its part.
        let is_negative = k >= certificate.claims.len();
        let has_set = if is_negative {
            negative.is_some_and(|part| part.complete_set.is_some())
        } else {
            certificate.complete_set.is_some()
        };
        let cover = cover.filter(|_| has_set);
        let place = cover.and_then(|cover| cover.place_of(claim));
        if let Some(Place::Solution(solution)) = place {
            claimed.insert(solution);
        }
        out += &claim_text(problem, claim, place);
    }
    if let Some(cover) = cover
        && !accepted.claims.is_empty()
        && claimed.len() < cover.solutions.len()
    {
        let others = counted(cover.solutions.len() - claimed.len(), "solution");
        out += &format!("without a claim, proved by the cover alone: {others} of the list below\n");
    }

    let mut code = exit::DONE;
    match cover {
        None => out += &claims_verdict(problem, &windows, accepted.claims.len()),
        Some(cover) if cover.proves_absence() => {
            out += &absence_verdict(problem, &windows, cover);
            if accepted.has_unique_rates {
                out += UNIQUE;
            }
        }
        Some(cover) => {
            out += &cover_verdict(problem, &windows, cover);
            if !cover.open.is_empty() {
                code = exit::UNDECIDED;
            }
        }
    }

    if let Some(demanded) = demanded
        && !windows.iter().any(|window| window.covers(demanded))
    {
        code = exit::REJECTED;
        let expected = window_text(demanded);
        let got = windows_text(&windows);
        let why = format!("window: expected one that covers {expected}, got {got}");
        out += &format!("REJECTED: {}\n", with_short_numbers(&why));
    }

    print(&out)?;
    Ok(code)
}

/// The verdict on a certificate without a cover.
fn claims_verdict(problem: &Problem, windows: &[RealWindow], count: usize) -> String {
    let digest = problem.sha256();
    let smaller = smaller_text(windows, problem);
    let window = windows_text(windows);
    let claims = counted(count, "claim");
    format!("ACCEPTED: {claims} proved for problem {digest} in {window}{smaller}\n")
}

/// The verdict on a cover that proves that there is no solution.
fn absence_verdict(problem: &Problem, windows: &[RealWindow], cover: &AcceptedCover) -> String {
    let word = problem.unknown().word();
    let digest = problem.sha256();
    let leaves = counted(cover.leaves, "leaf");
    let smaller = smaller_text(windows, problem);
    let evidence = format!("{word}, problem {digest}, {leaves} accepted");
    let window = windows_text(windows);

    format!("ABSENT in {window}: no solution ({evidence}){smaller}\n")
}

/// What is said where the rates are proved to be the only ones.
const UNIQUE: &str = "UNIQUE: T(mu) is a P-matrix there, so in these contact states the rates are \
    the only ones, whatever load grows\n";

/// What a cover holds, and the verdict on it.
fn cover_verdict(problem: &Problem, windows: &[RealWindow], cover: &AcceptedCover) -> String {
    let window = windows_text(windows);
    let solutions = say::cover::text(problem, &window, cover);

    let verdict = if cover.open.is_empty() {
        "ACCEPTED"
    } else {
        "ACCEPTED as undecided"
    };

    let digest = problem.sha256();
    let smaller = smaller_text(windows, problem);
    format!("{solutions}{verdict} for problem {digest} in {window}{smaller}\n")
}

/// A proved claim, and its place in the cover beside it.
fn claim_text(problem: &Problem, claim: &AcceptedClaim, place: Option<Place>) -> String {
    let word = problem.unknown().word();
    let (lo, hi) = enclosing_decimals(&claim.value, 17);
    let support = say::support_text(problem, &claim.support);
    let proved = format!("{word} in [{lo}, {hi}], {support}");

    match place {
        None => format!("solution: {proved}\n"),
        Some(Place::Solution(k)) => {
            format!("claim: {proved}; solution {} of the list below\n", k + 1)
        }
        Some(Place::Family(k)) => format!("claim: {proved}; in family {} below\n", k + 1),
        Some(Place::Open(k)) => format!("claim: {proved}; in open region {} below\n", k + 1),
    }
}

/// "[0, 2.5]", or "[-2, -1] and [0, 2.5]".
fn windows_text(windows: &[RealWindow]) -> String {
    let windows: Vec<String> = windows.iter().map(window_text).collect();
    windows.join(" and ")
}

/// Says that the certificate speaks of a part of the problem's window only.
fn smaller_text(certified: &[RealWindow], problem: &Problem) -> String {
    let wanted = problem.real_window();
    if certified.iter().any(|window| window.covers(&wanted)) {
        return String::new();
    }

    let wanted = window_text(wanted);
    format!("; NOT the whole window {wanted} of the problem")
}

/// One line per solution of a foreign report; the exit code is that of the worst.
fn foreign(args: &Args, problem: &Problem, source: &str, tolerance: f64) -> Result<u8, CliError> {
    let signs = BothSigns::of(problem)?;
    let report = match ForeignReport::read(source, problem, &signs.own().reduced) {
        Ok(report) => report,
        Err(e @ ForeignError::Digest { .. }) => {
            print(&format!("REJECTED: {e}\n"))?;
            return Ok(exit::REJECTED);
        }
        Err(e) => return Err(CliError::other_file(&args.certificate, e)),
    };

    let job = Job::begin_with_nothing_to_keep("judging");
    let mut is_undecided = report.solutions.is_empty();
    let mut is_rejected = false;
    let mut effort = Effort::default();
    for (k, reported) in report.solutions.iter().enumerate() {
        job.say(Progress::of("judging", k, report.solutions.len()));
        let line = match reported {
            Ok(reported) => {
                let verdict = judge(&signs, reported, tolerance, &mut effort);
                is_undecided |= matches!(verdict, ForeignVerdict::Undecided { .. });
                is_rejected |= matches!(
                    verdict,
                    ForeignVerdict::Rejected(_) | ForeignVerdict::Inaccurate { .. }
                );
                verdict.line(problem, reported.candidate.value)
            }
            Err(bad) => {
                is_rejected = true;
                format!("REJECTED: {bad}")
            }
        };
        job.print(&format!("{line}\n"))?; // an interrupt leaves what was judged
    }
    job.end();

    if report.solutions.is_empty() {
        let nothing = "UNDECIDED: the report lists no solution; that there is none is not checked \
                       here (see mceip complete)\n";
        print(nothing)?;
    }

    Ok(if is_rejected {
        exit::REJECTED
    } else if is_undecided {
        exit::UNDECIDED
    } else {
        exit::DONE
    })
}
