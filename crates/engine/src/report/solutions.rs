//! `mceip-solutions/1`, and the same for people.

use super::listed::Listed;
use super::table::Table;
use crate::candidate::SOLUTIONS_FORMAT;
use crate::reduction::{Reduced, Variable};
use mceip_check::{AcceptedCover, OpenRegion, SolutionFamily};
use mceip_exact::{Integer, Interval, Poly, enclosing_decimals, to_decimal};
use mceip_model::{Body, Problem};
use mceip_oracle::{End, Enumeration, Piece, SupportRange};
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
        Some(e) if !(e.wide.is_empty() && e.continua.is_empty()) => {
            Listed::of_enumeration(report.problem, report.reduced, e)
        }
        _ => report.solutions.clone(),
    }
}

/// The report as JSON.
pub fn solutions_json(report: &Report<'_>) -> Value {
    let ranges = |e: &Enumeration| e.ranges.iter().map(range).collect::<Vec<_>>();
    let undescribed = |e: &Enumeration| {
        e.undescribed
            .iter()
            .map(|u| json!({ "support": u.support, "reason": u.to_string() }))
            .collect()
    };
    let mut out = json!({
        "format": SOLUTIONS_FORMAT,
        "problem_sha256": report.problem.sha256(),
        "unknown": report.problem.unknown().word(),
        "claim": report.claim.word(),
        "evidence": report.evidence,
        "solutions": entries(report).iter().map(listed).collect::<Vec<_>>(),
        "continua": report.enumeration.map_or_else(Vec::new, ranges),
    });
    let open: Vec<Value> = report.enumeration.map_or_else(Vec::new, undescribed);
    if !open.is_empty() {
        out["undescribed"] = json!(open);
    }
    if let Some(cover) = report.cover {
        out["families"] = cover.families.iter().map(family).collect();
        out["open"] = cover.open.iter().map(region).collect();
    }
    if let Body::System(_) = report.problem.body() {
        out["variables"] = report.reduced.variables.iter().map(variable).collect();
    }
    out
}

/// A family of a cover: its support, and decimals that enclose the ends of its values.
fn family(f: &SolutionFamily) -> Value {
    let ends = |v: &Interval| <[String; 2]>::from(enclosing_decimals(v, 15));
    json!({
        "slip": f.support,
        "from": ends(&f.from),
        "to": f.to.as_ref().map(ends),
        "one_value": f.is_point,
        "one_solution_each": f.is_alone,
    })
}

/// A region that a cover leaves open.
fn region(r: &OpenRegion) -> Value {
    let max = r.max.as_ref().map(ToString::to_string);
    json!({ "min": r.min.to_string(), "max": max, "moving": r.moving, "undecided": r.undecided })
}

/// A support with the intervals of values at which it has a solution.
fn range(r: &SupportRange) -> Value {
    let kernel: Vec<Vec<Vec<String>>> = r
        .kernel
        .iter()
        .map(|v| v.iter().map(|p| coefficients(p.coeffs())).collect())
        .collect();
    json!({
        "slip": r.support,
        "intervals": r.pieces.iter().map(interval).collect::<Vec<_>>(),
        "kernel": kernel,
    })
}

fn interval(piece: &Piece) -> Value {
    let end = |e: &End| {
        let (polynomial, ends) = (
            coefficients(e.value.poly().coeffs()),
            [e.value.interval().lo(), e.value.interval().hi()],
        );
        let exact = json!({ "polynomial": polynomial, "interval": ends.map(ToString::to_string) });
        json!({ "value": decimal(e), "included": e.included, "exact": exact })
    };
    json!({ "from": end(&piece.from), "to": piece.to.as_ref().map(end) })
}

fn decimal(end: &End) -> String {
    to_decimal(
        &mut end.value.clone(),
        &Poly::from_ints(&[0, 1]),
        super::listed::DIGITS,
    )
}

fn coefficients(c: &[Integer]) -> Vec<String> {
    c.iter().map(ToString::to_string).collect()
}

fn listed(s: &Listed) -> Value {
    let mut out = json!({
        "value": s.value,
        "slip": s.slip,
        "biactive": s.biactive,
        "x": s.x,
        "y": s.y,
        "kernel_dimension": s.kernel_dimension,
    });
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
fn variable(v: &Variable) -> Value {
    match v {
        Variable::Free { dof } => json!({ "free": dof }),
        Variable::Slip { sign, tangent, .. } => {
            let tangent: Vec<Value> = tangent
                .iter()
                .map(|(dof, c)| json!([dof, c.to_string()]))
                .collect();
            json!({ "slip": { "sign": sign, "tangent": tangent } })
        }
    }
}

/// The report for people.
pub fn solutions_text(report: &Report<'_>) -> String {
    // All of x where that fits a line, else the slip variables.
    let order = report.reduced.pencil.order();
    let slip = if order <= SHORT {
        (0..order).collect()
    } else {
        report.reduced.pencil.slip()
    };
    let what = if order <= SHORT {
        "x (e'x_s = 1)"
    } else {
        "x (slip variables, e'x_s = 1)"
    };
    let mut table = Table::new(&[report.problem.unknown().word(), "slip", "biactive", what]);
    for s in &report.solutions {
        let x: Vec<String> = slip.iter().map(|&i| short(&s.x[i])).collect();
        table.row(vec![
            s.value.clone(),
            format!("{:?}", s.slip),
            format!("{:?}", s.biactive),
            x.join(" "),
        ]);
    }
    let mut out = if report.solutions.is_empty() {
        String::new()
    } else {
        table.to_string() + &meaning(report, &slip)
    };
    if let Some(e) = report.enumeration {
        out += &degenerate(report, e, &slip);
    }
    out += &format!(
        "{} solution{}: {}\n",
        report.solutions.len(),
        if report.solutions.len() == 1 { "" } else { "s" },
        report.evidence
    );
    out
}

/// Cones and continua, and what lies outside the propositions.
fn degenerate(report: &Report<'_>, e: &Enumeration, printed: &[usize]) -> String {
    let mut out = String::new();
    let vector = |x: &[String]| {
        printed
            .iter()
            .map(|&i| short(&x[i]))
            .collect::<Vec<_>>()
            .join(" ")
    };
    for cone in &e.cones {
        let listed = Listed::of_cone(report.problem, report.reduced, cone);
        out += &format!(
            "cone of dimension {} at {}, slip {:?}: combinations of\n",
            cone.dimension, listed.value, cone.slip
        );
        let Some(c) = listed.cone else { continue };
        c.rays
            .iter()
            .for_each(|r| out += &format!("  ray {}\n", vector(&r.x)));
        c.lineality
            .iter()
            .for_each(|l| out += &format!("  line {} (either sign)\n", vector(l)));
    }
    for r in &e.ranges {
        let text: Vec<String> = r.pieces.iter().map(interval_text).collect();
        out += &format!(
            "continuum: slip {:?} has solutions for every value in {}\n",
            r.support,
            text.join(", ")
        );
    }
    e.undescribed.iter().for_each(|u| out += &format!("{u}\n"));
    if e.is_outside_propositions() {
        out += "some solutions have x_s = 0: outside Propositions 1 and 2 (K_ff or M_ff is not \
                definite)\n";
    }
    out
}

fn interval_text(piece: &Piece) -> String {
    let from = format!(
        "{}{}",
        if piece.from.included { "[" } else { "(" },
        short(&decimal(&piece.from))
    );
    match &piece.to {
        Some(to) => format!(
            "{from}, {}{}",
            short(&decimal(to)),
            if to.included { "]" } else { ")" }
        ),
        None => format!("{from}, infinity)"),
    }
}

/// Largest order whose x is printed in full.
const SHORT: usize = 8;

/// What the printed variables of a system stand for: dofs, and particles by their dof and S.
fn meaning(report: &Report<'_>, printed: &[usize]) -> String {
    let one = |i: &usize| match report.reduced.variables.get(*i)? {
        Variable::Free { dof } => Some(format!("x[{i}] = v[{dof}]")),
        Variable::Slip { sign, tangent, .. } => {
            let dof = tangent.first().map_or(0, |d| d.0);
            Some(format!(
                "x[{i}] = -S v_T of the particle at dof {dof}, S = {sign:+}"
            ))
        }
    };
    let lines: Vec<String> = printed.iter().filter_map(one).collect();
    if lines.is_empty() {
        String::new()
    } else {
        format!("where {}\n", lines.join(", "))
    }
}

/// A decimal cut to eight significant characters for a table.
fn short(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(v) => format!("{v:.6}"),
        Err(_) => text.to_string(),
    }
}
