//! `mceip-solutions/1`, and the same for people.
//!
//! Input: a [`Report`], which says of its list of solutions how much it claims and why. Output:
//! JSON ([`solutions_json`]) or text ([`solutions_text`]). Called by `mceip solve`, `enumerate` and
//! `complete` and by the conformance pack.

use super::listed::{DIGITS, Listed};
use super::table::Table;
use crate::candidate::SOLUTIONS_FORMAT;
use crate::report::counted;
use mceip_check::{AcceptedCover, OpenRegion, SolutionFamily};
use mceip_exact::{
    Algebraic, Integer, Interval, Poly, Rational, enclosing_decimals, nearest_decimal, parse,
    to_decimal, whole,
};
use mceip_model::{Body, Problem, Reduced, ReducedVariable};
use mceip_oracle::{Cone, End, Enumeration, SupportRange, ValueInterval};
use num_traits::Signed as _;
use serde_json::{Value, json};

/// Solutions with what stands behind them.
#[derive(Debug)]
pub struct Report<'a> {
    /// The problem.
    pub problem: &'a Problem,
    /// Its reduction.
    pub reduced: &'a Reduced,
    /// The solutions.
    pub solutions: Vec<Listed>,
    /// What the list is said to be.
    pub claim: Claimed,
    /// What stands behind the claim.
    pub evidence: String,
    /// The enumerator's run, for what is only reported.
    pub enumeration: Option<&'a Enumeration>,
    /// The accepted cover, for families and open regions.
    pub cover: Option<&'a AcceptedCover>,
}

/// What a list of solutions is said to be. Only the enumerator and an accepted cover may say more
/// than `Solutions`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Claimed {
    /// All that there is.
    Complete,
    /// All that there is, together with the families beside it.
    CompleteWithFamilies,
    /// Solutions; there may be others.
    Solutions,
}

impl Claimed {
    /// `Complete` or `Solutions`.
    pub fn complete_if(is_complete: bool) -> Claimed {
        if is_complete {
            Claimed::Complete
        } else {
            Claimed::Solutions
        }
    }

    /// What an enumeration says of its solutions.
    pub fn of_enumeration(found: &Enumeration) -> Claimed {
        if found.is_plain_list() {
            Claimed::Complete
        } else if found.is_complete_list() {
            Claimed::CompleteWithFamilies
        } else {
            Claimed::Solutions
        }
    }

    /// What an accepted cover proves of its solutions.
    pub fn of_cover(cover: &AcceptedCover) -> Claimed {
        if !cover.open.is_empty() {
            return Claimed::Solutions;
        }

        if cover.is_plain_list() {
            Claimed::Complete
        } else {
            Claimed::CompleteWithFamilies
        }
    }

    /// The word in the file.
    pub fn word(self) -> &'static str {
        match self {
            Claimed::Complete => "complete",
            Claimed::CompleteWithFamilies => "complete_with_families",
            Claimed::Solutions => "solutions",
        }
    }
}

/// Everything to be listed: the solutions, and between them the cones of the enumerator.
fn entries(report: &Report<'_>) -> Vec<Listed> {
    match report.enumeration {
        Some(found) if !(found.wide.is_empty() && found.continua.is_empty()) => {
            Listed::of_enumeration(report.problem, report.reduced, found)
        }
        _ => report.solutions.clone(),
    }
}

/// The report as JSON.
pub fn solutions_json(report: &Report<'_>) -> Value {
    let solutions: Vec<Value> = entries(report).iter().map(listed).collect();
    let mut continua = Vec::new();
    let mut undescribed = Vec::new();
    if let Some(enumeration) = report.enumeration {
        continua.extend(enumeration.ranges.iter().map(range));
        for u in &enumeration.undescribed {
            undescribed.push(json!({ "support": u.support, "reason": u.to_string() }));
        }
    }

    let mut out = json!({
        "format": SOLUTIONS_FORMAT,
        "problem_sha256": report.problem.sha256(),
        "unknown": report.problem.unknown().word(),
        "claim": report.claim.word(),
        "evidence": report.evidence,
        "solutions": solutions,
        "continua": continua,
    });
    if !undescribed.is_empty() {
        out["undescribed"] = json!(undescribed);
    }

    match report.enumeration {
        Some(enumeration) => out["families"] = enumerated_families(enumeration),
        // A list of modes is complete only where no mode has more than single solutions.
        None if report.claim == Claimed::Complete => out["families"] = json!([]),
        None => {}
    }

    if let Some(cover) = report.cover {
        out["families"] = cover.families.iter().map(family).collect();
        out["open"] = cover.open.iter().map(region_json).collect();
    }

    if let Body::System(_) = report.problem.body() {
        out["variables"] = report.reduced.variables.iter().map(variable).collect();
    }

    out
}

/// The cones and ranges of an enumeration as [`family`] writes those of a cover.
fn enumerated_families(found: &Enumeration) -> Value {
    let mut families = Vec::new();
    for cone in &found.cones {
        let value = narrowed(&cone.value);
        families.push(SolutionFamily {
            support: cone.slip.clone(),
            from: Some(value.clone()),
            to: Some(value),
            is_point: true,
            is_alone: false,
        });
    }

    for range in &found.ranges {
        for piece in &range.pieces {
            families.push(SolutionFamily {
                support: range.support.clone(),
                from: piece.from.as_ref().map(|from| narrowed(&from.value)),
                to: piece.to.as_ref().map(|to| narrowed(&to.value)),
                is_point: false,
                is_alone: range.kernel.len() == 1,
            });
        }
    }

    families.iter().map(family).collect()
}

/// An interval about a value that is good for the decimals of [`enclosure`].
fn narrowed(value: &Algebraic) -> Interval {
    let mut value = value.clone();
    value.refine_to(&Rational::new(1.into(), Integer::from(1u64 << 62)));
    value.try_rational();
    value.interval().clone()
}

/// A family of a cover: its support, and decimals that enclose the ends of its values.
fn family(family: &SolutionFamily) -> Value {
    json!({
        "slip": family.support,
        "from": family.from.as_ref().map(enclosure),
        "to": family.to.as_ref().map(enclosure),
        "one_value": family.is_point,
        "one_solution_each": family.is_alone,
    })
}

/// Decimals that enclose a value.
fn enclosure(value: &Interval) -> [String; 2] {
    enclosing_decimals(value, 15).into()
}

/// A region that a cover leaves open.
pub(crate) fn region_json(region: &OpenRegion) -> Value {
    let [min, max] = [&region.min, &region.max].map(|end| end.as_ref().map(ToString::to_string));
    json!({
        "min": min,
        "max": max,
        "moving": region.moving,
        "undecided": region.undecided,
    })
}

/// A support with the intervals of values at which it has a solution.
fn range(range: &SupportRange) -> Value {
    let intervals: Vec<Value> = range.pieces.iter().map(interval).collect();
    let mut kernel = Vec::with_capacity(range.kernel.len());
    for vector in &range.kernel {
        let vector: Vec<Vec<String>> = vector.iter().map(|p| coefficients(p.coeffs())).collect();
        kernel.push(vector);
    }

    json!({
        "slip": range.support,
        "intervals": intervals,
        "kernel": kernel,
    })
}

fn interval(piece: &ValueInterval) -> Value {
    json!({ "from": piece.from.as_ref().map(end), "to": piece.to.as_ref().map(end) })
}

/// An end of an interval of values: in decimals, and exactly.
fn end(end: &End) -> Value {
    let interval = end.value.interval();
    let exact = json!({
        "polynomial": coefficients(end.value.poly().coeffs()),
        "interval": [interval.lo().to_string(), interval.hi().to_string()],
    });
    json!({ "value": decimal(end), "included": end.included, "exact": exact })
}

/// The value of an end in decimals.
fn decimal(end: &End) -> String {
    let t = Poly::from_ints(&[0, 1]);
    to_decimal(&mut end.value.clone(), &t, DIGITS)
}

/// The coefficients of a polynomial, constant first.
pub(crate) fn coefficients(list: &[Integer]) -> Vec<String> {
    list.iter().map(ToString::to_string).collect()
}

/// A solution, or a cone by the mean of its rays.
fn listed(s: &Listed) -> Value {
    let mut out = json!({
        "value": s.value,
        "slip": s.slip,
        "biactive": s.biactive,
        "x": s.x,
        "y": s.y,
    });
    if let Some(dimension) = s.kernel_dimension {
        out["kernel_dimension"] = json!(dimension);
    }

    if let Some(cone) = &s.cone {
        out["cone_dimension"] = json!(cone.dimension);
        out["rays"] = cone.rays.iter().map(ray).collect();
        out["lineality"] = json!(cone.lineality);
    }

    if let Some(ends) = &s.enclosure {
        out["enclosure"] = json!(ends);
    }

    if let Some((polynomial, interval)) = &s.exact {
        let interval: Vec<String> = interval.iter().map(ToString::to_string).collect();
        out["exact"] = json!({ "polynomial": coefficients(polynomial), "interval": interval });
    }

    if let Some((v, w)) = &s.lifted {
        out["v"] = json!(v);
        out["w"] = json!(w);
    }

    out
}

/// An extreme ray of a cone.
fn ray(s: &Listed) -> Value {
    let mut out = json!({ "slip": s.slip, "biactive": s.biactive, "x": s.x, "y": s.y });
    if let Some((v, w)) = &s.lifted {
        out["v"] = json!(v);
        out["w"] = json!(w);
    }
    out
}

/// What a variable stands for.
fn variable(v: &ReducedVariable) -> Value {
    match v {
        ReducedVariable::Free { dof } => json!({ "free": dof }),
        ReducedVariable::Slip { sign, tangent, .. } => {
            let mut terms = Vec::with_capacity(tangent.len());
            for (dof, coefficient) in tangent {
                terms.push(json!([dof, coefficient.to_string()]));
            }
            json!({ "slip": { "sign": sign, "tangent": terms } })
        }
        ReducedVariable::Zero {
            variables, part, ..
        } => json!({ "zero": { "particle": variables.particle, "part": part.word() } }),
    }
}

/// The report for people.
pub fn solutions_text(report: &Report<'_>) -> String {
    let mut out = String::new();
    if !report.solutions.is_empty() {
        out += &table(report).to_string();
        out += &meaning(report);
    }

    if let Some(enumeration) = report.enumeration {
        out += &degenerate(report, enumeration);
    }

    let count = counted(report.solutions.len(), "solution");
    out += &format!("{count}: {}\n", report.evidence);
    out
}

/// Is x short enough to be printed in full?
fn is_short(report: &Report<'_>) -> bool {
    report.reduced.pencil.order() <= SHORT
}

/// The variables whose values are printed: all of them where that fits a line, else the slip
/// variables.
fn printed_variables(report: &Report<'_>) -> Vec<usize> {
    let pencil = &report.reduced.pencil;
    if is_short(report) {
        (0..pencil.order()).collect()
    } else {
        pencil.slip()
    }
}

/// The solutions, one a row.
fn table(report: &Report<'_>) -> Table {
    let title_of_x = if is_short(report) {
        "x (e'x_s = 1)"
    } else {
        "x (complementarity variables, e'x_s = 1)"
    };

    let unknown = report.problem.unknown().word();
    let mut table = Table::new(&[unknown, "support", "biactive", title_of_x]);
    for solution in &report.solutions {
        table.row(vec![
            solution.value.clone(),
            format!("{:?}", solution.slip),
            format!("{:?}", solution.biactive),
            vector_text(report, &solution.x),
        ]);
    }

    table
}

/// The printed components of x.
fn vector_text(report: &Report<'_>, x: &[String]) -> String {
    let printed = printed_variables(report);
    let known = printed.iter().filter_map(|&i| x.get(i));
    let components: Vec<String> = known.map(|x_i| short(x_i)).collect();
    components.join(" ")
}

/// Cones and continua, and what lies outside the propositions.
fn degenerate(report: &Report<'_>, enumeration: &Enumeration) -> String {
    let mut out = String::new();
    for cone in &enumeration.cones {
        out += &cone_text(report, cone);
    }

    for range in &enumeration.ranges {
        let intervals: Vec<String> = range.pieces.iter().map(interval_text).collect();
        out += &format!(
            "continuum: support {:?} has solutions for every value in {}\n",
            range.support,
            intervals.join(", ")
        );
    }

    for undescribed in &enumeration.undescribed {
        out += &format!("{undescribed}\n");
    }

    if enumeration.is_outside_propositions() {
        out += "some solutions have x_s = 0: outside Propositions 1 and 2 (K_ff or M_ff is not \
                definite)\n";
    }

    out
}

/// A cone by its rays and lines.
fn cone_text(report: &Report<'_>, cone: &Cone) -> String {
    let listed = Listed::of_cone(report.problem, report.reduced, cone);
    let mut out = format!(
        "cone of dimension {} at {}, support {:?}: combinations of\n",
        cone.dimension, listed.value, cone.slip
    );
    let Some(listed_cone) = listed.cone else {
        return out;
    };

    for ray in &listed_cone.rays {
        out += &format!("  ray {}\n", vector_text(report, &ray.x));
    }

    for line in &listed_cone.lineality {
        out += &format!("  line {} (either sign)\n", vector_text(report, line));
    }

    out
}

fn interval_text(piece: &ValueInterval) -> String {
    let from = match &piece.from {
        None => "(-infinity".into(),
        Some(from) if from.included => format!("[{}", end_text(from)),
        Some(from) => format!("({}", end_text(from)),
    };
    let to = match &piece.to {
        None => "infinity)".into(),
        Some(to) if to.included => format!("{}]", end_text(to)),
        Some(to) => format!("{})", end_text(to)),
    };

    format!("{from}, {to}")
}

/// Digits of an end that is no short number.
const END_DIGITS: usize = 12;

/// Letters of an exact end, at most.
const LONGEST_END: usize = 24;

/// An end as it is where that is a short number, else where it lies: rounded it would be another.
fn end_text(end: &End) -> String {
    let mut value = end.value.clone();
    value.try_rational();
    if let Some(exact) = value.as_rational() {
        let decimal = nearest_decimal(exact, END_DIGITS);
        let is_exact = parse(&decimal).is_ok_and(|number| number == *exact);
        let text = if is_exact { decimal } else { exact.to_string() };
        if text.len() <= LONGEST_END {
            return text;
        }
    }

    let size = value.interval().hi().abs().min(whole(1));
    value.refine_to(&(size / whole(10_i64.pow(END_DIGITS as u32 + 2))));
    let (lo, hi) = enclosing_decimals(value.interval(), END_DIGITS);
    format!("a value in [{lo}, {hi}]")
}

/// Largest order whose x is printed in full.
const SHORT: usize = 8;

/// What the printed variables of a system stand for: dofs, and particles by their dof and S.
fn meaning(report: &Report<'_>) -> String {
    let mut meanings = Vec::new();
    for i in printed_variables(report) {
        match report.reduced.variables.get(i) {
            None => {}
            Some(ReducedVariable::Free { dof }) => meanings.push(format!("x[{i}] = v[{dof}]")),
            Some(ReducedVariable::Slip { sign, tangent, .. }) => {
                let dof = tangent.first().map_or(0, |(dof, _)| *dof);
                meanings.push(format!(
                    "x[{i}] = -S v_T of the particle at dof {dof}, S = {sign:+}"
                ));
            }
            Some(ReducedVariable::Zero {
                variables, part, ..
            }) => {
                let particle = variables.particle;
                meanings.push(format!("x[{i}] = {} of particle {particle}", part.word()));
            }
        }
    }

    if meanings.is_empty() {
        String::new()
    } else {
        format!("where {}\n", meanings.join(", "))
    }
}

/// A decimal cut to eight significant characters for a table.
fn short(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(v) => format!("{v:.6}"),
        Err(_) => text.to_string(),
    }
}
