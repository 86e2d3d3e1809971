//! One instance through every engine: closed form, enumerator, solver, certificate, checker.
//!
//! The plain enumerator's answer is what the others are compared with:
//!
//! * Table 1 in closed form lists the same solutions.
//! * Lifted solutions satisfy each line of (9).
//! * Its solutions are certified and accepted; each forgery of them is rejected.
//! * The complete search proves the same set, or leaves regions open.
//! * What the solver finds and certifies is in it.
//! * The verified checker, if there is one, refuses no certificate that was accepted.
//!
//! Input: an instance and how to treat it. Output: counts and disagreements; each disagreement is a
//! bug. Called by `verify`, by the campaign and by the fuzz targets.

use super::completed::compare_within;
use super::disagreement::Disagreement;
use super::families::{Corner, Instance};
use super::floors::{Coverage, Starts};
use super::forge::forgeries;
use super::interior::{INTERIOR_STARTS, from_interior, path_options};
use super::verified::{VerifiedChecker, VerifiedCounts};
use mceip_check::certificate::{Certificate, Claim};
use mceip_check::{Proved, check};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::Certifier;
use mceip_engine::multistart::{
    MultistartFound, Origin, Search, SearchError, exact_value, integer_x, multistart, support,
};
use mceip_engine::run::Watch;
use mceip_exact::{Algebraic, Quadratic, Rational, Sign};
use mceip_model::reduction::{check_lines, lift, reduce};
use mceip_model::{Admissible, Body, Problem, Reduced};
use mceip_oracle::{
    ClosedSolution, Enumeration, GivenPencil, IntegerPencil, Solution, enumerate, table1,
};
use num_traits::Signed;

/// What came of one instance.
#[derive(Debug, Clone, Default)]
pub struct InstanceReport {
    /// Label of the instance.
    pub label: String,
    /// Solutions the enumerator lists.
    pub oracle: usize,
    /// Of these, found by the solver and certified. On Table 1 those found from interior starts
    /// alone, because starts of the search are solutions themselves.
    pub found: usize,
    /// What each kind of start led to; empty where the solver was not run.
    pub reached: Vec<Reached>,
    /// Certificates accepted (of the enumerator's and the solver's solutions).
    pub accepted: usize,
    /// Candidates of the solver that stayed uncertified, with the reason.
    pub uncertified: Vec<String>,
    /// Does the enumerator report a wide kernel or a singular pencil?
    pub degenerate: bool,
    /// Was the solver run (the hypotheses of Propositions 1 and 2 hold)?
    pub solved: bool,
    /// Forgeries tried, all rejected for the stated reason unless listed below.
    pub forgeries: usize,
    /// Corners reached, observed or by construction.
    pub corners: Vec<Corner>,
    /// Pivots of the solver.
    pub pivots: usize,
    /// Did the complete search close the instance? (Otherwise it left regions open.)
    pub completed: bool,
    /// Verdicts of the verified checker; all zero without one.
    pub verified: VerifiedCounts,
    /// What went wrong.
    pub disagreements: Vec<Disagreement>,
}

impl InstanceReport {
    /// Coverage of each kind of start over this one instance: empty if the solver was not run or
    /// nothing is to be found.
    pub fn coverage(&self) -> Vec<(Starts, Coverage)> {
        let mut out = Vec::new();
        if self.oracle == 0 {
            return out;
        }

        for reached in &self.reached {
            let mut coverage = Coverage::default();
            coverage.count(reached.first, reached.found == self.oracle);
            out.push((reached.starts, coverage));
        }

        out
    }
}

/// What one kind of start led to on an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reached {
    /// From where.
    pub starts: Starts,
    /// Did the first start lead to a solution?
    pub first: bool,
    /// Solutions of the enumerator's list that were found.
    pub found: usize,
}

/// What is asked for the solutions of a problem: [`multistart`], [`from_interior`], or one that is
/// wrong on purpose.
pub type SearchFunction =
    fn(&Problem, &Reduced, &Search, &Watch<'_>) -> Result<MultistartFound, SearchError>;

/// How an instance is treated.
#[derive(Debug, Clone)]
pub struct Treatment {
    /// How the solver searches.
    pub search: Search,
    /// The search for solutions.
    pub solver: SearchFunction,
    /// Runs from interior starts, for instances of Table 1.
    pub interior: SearchFunction,
    /// Nodes per piece of the complete search.
    pub nodes: usize,
    /// The verified checker, to which each accepted certificate is given.
    pub verified: Option<VerifiedChecker>,
}

impl Treatment {
    /// The project's own search and solver, and nodes for small instances.
    pub fn of(search: &Search) -> Treatment {
        Treatment {
            search: search.clone(),
            solver: multistart,
            interior: from_interior,
            nodes: super::completed::NODES,
            verified: None,
        }
    }

    /// The same with another solver in both places.
    #[must_use]
    pub fn with_solver(self, solver: SearchFunction) -> Treatment {
        Treatment {
            solver,
            interior: solver,
            ..self
        }
    }
}

/// Runs every engine on an instance and compares them.
pub fn compare(instance: &Instance, search: &Search) -> InstanceReport {
    compare_by(instance, &Treatment::of(search))
}

/// [`compare`] with a treatment of one's own.
pub fn compare_by(instance: &Instance, treatment: &Treatment) -> InstanceReport {
    let mut report = InstanceReport {
        label: instance.label.clone(),
        corners: instance.corners.clone(),
        ..InstanceReport::default()
    };

    match engines(&instance.problem) {
        Ok((reduced, oracle)) => compare_with(instance, &reduced, &oracle, treatment, &mut report),
        Err(disagreement) => report.disagreements.push(disagreement),
    }

    report
}

/// Coverage alone: enumerator and solver, without closed form, lift, complete search, certificates
/// of the enumerator's solutions and forgeries. By this the floors are measured.
///
/// # Errors
/// [`Disagreement`] if an engine refuses the instance.
pub fn coverage_of(
    instance: &Instance,
    treatment: &Treatment,
) -> Result<InstanceReport, Disagreement> {
    let (reduced, oracle) = engines(&instance.problem)?;
    let mut report = InstanceReport {
        label: instance.label.clone(),
        oracle: oracle.solutions.len(),
        ..InstanceReport::default()
    };

    run_solver(instance, &reduced, &oracle, treatment, &mut report);
    Ok(report)
}

/// [`compare_by`] where the enumerator's answer is at hand.
pub(super) fn compare_with(
    instance: &Instance,
    reduced: &Reduced,
    oracle: &Enumeration,
    treatment: &Treatment,
    report: &mut InstanceReport,
) {
    let problem = &instance.problem;
    report.oracle = oracle.solutions.len();
    report.degenerate = !(oracle.wide.is_empty() && oracle.continua.is_empty());
    report.corners.extend(observed(oracle));

    if let Some(data) = &instance.closed_form {
        compare_closed_form(oracle, &table1(data), report);
    }

    check_lifts(problem, reduced, oracle, report);
    let claims = certify_oracle(problem, reduced, oracle, report);
    let verified = treatment.verified.as_ref();
    submit(problem, claims, verified, report);

    match compare_within(problem, oracle, treatment.nodes) {
        Ok(Some(completed)) => {
            report.completed = completed.is_complete();
            submit_verified(problem, completed.proved.certificate(), verified, report);
        }
        Ok(None) => {}
        Err(disagreement) => report.disagreements.push(disagreement),
    }

    run_solver(instance, reduced, oracle, treatment, report);
}

/// The solver on an instance that fulfils the hypotheses of Proposition 1 or 2; on Table 1 also
/// from interior starts.
fn run_solver(
    instance: &Instance,
    reduced: &Reduced,
    oracle: &Enumeration,
    treatment: &Treatment,
    report: &mut InstanceReport,
) {
    let problem = &instance.problem;
    let pencil = &reduced.pencil;
    if Admissible::new(pencil, problem.unknown()).is_err() {
        return;
    }

    report.solved = true;

    let interior = Search {
        starts: INTERIOR_STARTS,
        ..treatment.search.clone()
    };
    let path = Search {
        curves: false,
        options: path_options(),
        ..interior.clone()
    };

    let mut runs = vec![(Starts::Search, treatment.solver, treatment.search.clone())];
    if instance.closed_form.is_some() {
        runs.push((Starts::Interior, treatment.interior, interior));
        runs.push((Starts::Path, treatment.interior, path));
    }

    let answered = Answered {
        problem,
        reduced,
        oracle,
        verified: treatment.verified.as_ref(),
    };
    for (starts, solver, search) in runs {
        match solver(problem, reduced, &search, &Watch::nobody()) {
            Ok(found) => compare_found(&answered, starts, found, report),
            Err(e) => report
                .disagreements
                .push(Disagreement::refused("solver", &e)),
        }
    }
}

/// The reduction and the enumerator's answer; of a quadratic pencil that on the pencil as it is
/// given.
pub(super) fn engines(problem: &Problem) -> Result<(Reduced, Enumeration), Disagreement> {
    let reduced = reduce(problem).and_then(Reduced::without_zero);
    let reduced = reduced.map_err(|e| Disagreement::refused("reduction", &e))?;

    let oracle = enumerate(IntegerPencil::of(problem, &reduced), problem.window());
    let oracle = oracle.map_err(|e| Disagreement::refused("enumerator", &e))?;

    Ok((reduced, oracle))
}

/// Corners that the enumerator's answer shows.
pub(super) fn observed(oracle: &Enumeration) -> Vec<Corner> {
    let mut corners = Vec::new();
    let solutions = &oracle.solutions;

    if solutions.iter().any(|s| !s.biactive.is_empty()) {
        corners.push(Corner::Biactive);
    }

    if solutions.iter().any(|s| s.multiplicity > 1) {
        corners.push(Corner::Repeated);
    }

    if solutions.iter().any(has_value_zero) {
        corners.push(Corner::ZeroValue);
    }

    if !oracle.wide.is_empty() {
        corners.push(Corner::WideKernel);
    }

    if !oracle.continua.is_empty() {
        corners.push(Corner::Singular);
    }

    corners
}

/// Is the value 0?
fn has_value_zero(solution: &Solution) -> bool {
    let mut value = solution.value.clone();
    value.cmp_rational(&Rational::default()).is_eq()
}

/// Same solutions in value, support and direction of x? Decided in Q(sqrt d).
fn compare_closed_form(
    oracle: &Enumeration,
    closed: &[ClosedSolution],
    report: &mut InstanceReport,
) {
    let mut all_match = true;
    for c in closed {
        let same = |s: &&Solution| s.slip == c.slip && equals(s, c);
        let count = oracle.solutions.iter().filter(same).count();
        all_match &= count == 1;
    }

    if !all_match || closed.len() != oracle.solutions.len() {
        report.disagreements.push(Disagreement::ClosedForm {
            closed: closed.len(),
            enumerated: oracle.solutions.len(),
        });
    }
}

/// Is the closed form's number the root isolated by the enumerator, with the same ratio of x?
fn equals(s: &Solution, c: &ClosedSolution) -> bool {
    let interval = s.value.interval();
    let is_root = c.value.eval(s.value.poly()).sign() == Sign::Zero;
    let is_isolated_root = is_root && c.value.within(interval.lo(), interval.hi());

    // x_1 X_2 - x_2 X_1 = 0 with the polynomials of the enumerator evaluated at the closed form's
    // number.
    let x_1 = same_field(&c.value.eval(&s.x[0]), &c.x[0]);
    let x_2 = same_field(&c.value.eval(&s.x[1]), &c.x[1]);
    let minus_one = Rational::from_integer((-1).into());
    let second_product = x_2.mul(&c.x[0]).scale(&minus_one);
    let cross = x_1.mul(&c.x[1]).add(&second_product);

    is_isolated_root && cross.sign() == Sign::Zero
}

/// A number of Q carries no radicand of its own: give it the other's.
fn same_field(x: &Quadratic, other: &Quadratic) -> Quadratic {
    x.as_rational()
        .map_or_else(|| x.clone(), |a| other.embed(a))
}

/// The lift of each of the enumerator's solutions satisfies every line of (9).
fn check_lifts(
    problem: &Problem,
    reduced: &Reduced,
    oracle: &Enumeration,
    report: &mut InstanceReport,
) {
    let Body::System(system) = problem.body() else {
        return;
    };

    for (index, s) in oracle.solutions.iter().enumerate() {
        let lifted = lift(system, problem.unknown(), &reduced.variables, &s.x);
        if let Err(line) = check_lines(system, problem.unknown(), &lifted, &mut s.value.clone()) {
            report.disagreements.push(Disagreement::Lift {
                index,
                line: line.to_string(),
            });
        }
    }
}

/// The candidate that a solver in doubles would report for this solution: value and x by way of
/// 17-digit decimals.
pub fn in_doubles(solution: &Solution, slip: &[usize]) -> Candidate {
    let x = solution.x_decimals(slip, 17);
    Candidate {
        value: double(&solution.decimal(17)),
        x: x.iter().map(|text| double(text)).collect(),
    }
}

/// The double nearest to a decimal of our own, which parses.
fn double(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}

/// The enumerator's own solutions, through 17-digit decimals, must be certifiable.
fn certify_oracle(
    problem: &Problem,
    reduced: &Reduced,
    oracle: &Enumeration,
    report: &mut InstanceReport,
) -> Vec<Claim> {
    let slip = reduced.pencil.slip();
    let certifier = Certifier::new(problem, &reduced.pencil);
    let mut claims = Vec::new();

    for (index, s) in oracle.solutions.iter().enumerate() {
        let Candidate { value, x } = in_doubles(s, &slip);
        match certifier.certify(&Candidate::given(problem, value, x)) {
            Ok(claim) => claims.push(claim),
            // A singular support has a root everywhere: its value, if irrational, cannot be told
            // from doubles.
            Err(reason) if s.multiplicity == 0 => report
                .uncertified
                .push(format!("solution {index}, singular support: {reason}")),
            Err(reason) => report.disagreements.push(Disagreement::OracleNotCertified {
                index,
                reason: reason.to_string(),
            }),
        }
    }

    claims
}

/// Counts the claims of an accepted certificate, if it is the same when it is read back, and sends
/// it to the verified checker.
fn submit_file(
    problem: &Problem,
    file: &Proved<Certificate>,
    verified: Option<&VerifiedChecker>,
    report: &mut InstanceReport,
) {
    match file.file() {
        Ok(_) => {
            report.accepted += file.certificate().claims.len();
            submit_verified(problem, file.certificate(), verified, report);
        }
        Err(e) => report.disagreements.push(Disagreement::Rejected {
            reason: e.to_string(),
        }),
    }
}

/// Sends claims to the checkers, and forgeries of them.
fn submit(
    problem: &Problem,
    claims: Vec<Claim>,
    verified: Option<&VerifiedChecker>,
    report: &mut InstanceReport,
) {
    if claims.is_empty() {
        return;
    }

    let certificate = Certificate::of_claims(problem, claims.clone());
    match Proved::claims(problem, claims) {
        Ok(files) => {
            for file in &files {
                submit_file(problem, file, verified, report);
            }
        }
        Err(e) => report.disagreements.push(Disagreement::Rejected {
            reason: e.to_string(),
        }),
    }

    for forgery in forgeries(&certificate) {
        report.forgeries += 1;
        let got = match check(problem, &forgery.certificate) {
            Ok(_) => "accepted".to_string(),
            Err(e) if (forgery.expected)(&e.reason) => continue,
            Err(e) => format!("rejected for another reason: {e}"),
        };

        report.disagreements.push(Disagreement::Forgery {
            name: forgery.name,
            got,
        });
    }
}

/// Sends a certificate that the checker has accepted to the verified checker, if there is one.
fn submit_verified(
    problem: &Problem,
    certificate: &Certificate,
    verified: Option<&VerifiedChecker>,
    report: &mut InstanceReport,
) {
    let Some(verified) = verified else {
        return;
    };

    let refusal = report.verified.submit(verified, problem, certificate);
    if let Some(reason) = refusal {
        let disagreement = Disagreement::VerifiedChecker { reason };
        report.disagreements.push(disagreement);
    }
}

/// A problem, its pencil, the enumerator's answer, and the verified checker.
struct Answered<'a> {
    problem: &'a Problem,
    reduced: &'a Reduced,
    oracle: &'a Enumeration,
    verified: Option<&'a VerifiedChecker>,
}

/// What the solver certified is in the enumerator's answer.
fn compare_found(
    answered: &Answered<'_>,
    starts: Starts,
    found: MultistartFound,
    report: &mut InstanceReport,
) {
    let oracle = answered.oracle;
    report.pivots += found.pivots;

    if starts == Starts::Search {
        for u in &found.uncertified {
            let said = format!("value {:e}: {}", u.candidate.value, u.reason);
            report.uncertified.push(said);
        }
    }

    let mut claims = Vec::new();
    let mut hit = vec![false; oracle.solutions.len()];
    let mut first = false;

    for c in found.certified {
        let is_first = c.run == 0 && c.origin == Origin::Start;
        match place(oracle, &c.claim) {
            Some(index) => {
                hit[index] = true;
                first |= is_first;
            }
            // In a cone, or in the range of a singular pencil.
            None if is_described(answered, &c.claim) => first |= is_first,
            None => report.disagreements.push(Disagreement::NotInOracle {
                support: support(&c.claim).to_vec(),
            }),
        }

        claims.push(c.claim);
    }

    let count = hit.iter().filter(|h| **h).count();
    report.reached.push(Reached {
        starts,
        first,
        found: count,
    });

    if starts != Starts::Path {
        report.found = count; // on Table 1 the interior starts come after the search
    }

    if starts == Starts::Search {
        submit(answered.problem, claims, answered.verified, report);
    }
}

/// The enumerator's solution with this support and value.
fn place(oracle: &Enumeration, claim: &Claim) -> Option<usize> {
    oracle
        .solutions
        .iter()
        .position(|s| s.slip == support(claim) && same_value(&s.value, claim))
}

/// Is the value the claim's exact one, or does it lie in the claim's box?
fn same_value(value: &Algebraic, claim: &Claim) -> bool {
    if let Some(mut exact) = exact_value(claim) {
        return exact.equals(&mut value.clone());
    }
    let Claim::EnclosedSolution(c) = claim else {
        return false;
    };

    // The value is the last unknown of the box.
    let (Some(center), Some(radius)) = (c.center.last(), c.radius.last()) else {
        return false;
    };
    let mut value = value.clone();
    value.refine_to(&(&radius.0 / Rational::from_integer(16.into())));
    let distance = (value.interval().mid() - &center.0).abs();
    distance <= radius.0
}

/// Does the enumerator's answer hold the claimed solution? Exactly for exact claims; a box stands
/// for an isolated solution, for which its support must have been met as wide or singular.
fn is_described(answered: &Answered<'_>, claim: &Claim) -> bool {
    let oracle = answered.oracle;
    if let (Claim::ExactSolution(c), Some(value)) = (claim, exact_value(claim)) {
        let given = GivenPencil::of(answered.problem, answered.reduced);
        // Without z of the linear form of a quadratic pencil.
        let x = &integer_x(c)[..given.order()];
        return oracle.contains(given, &value, x);
    }

    let support = support(claim);
    let is_wide = oracle
        .wide
        .iter()
        .any(|w| w.support == support && same_value(&w.value, claim));
    is_wide || oracle.continua.iter().any(|c| c == support)
}
