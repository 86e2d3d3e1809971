//! `mceip-solutions/1`, and the same for people.

use super::{Listed, Table};
use crate::candidate::SOLUTIONS_FORMAT;
use crate::model::{Body, Problem};
use crate::oracle::Enumeration;
use crate::reduction::{Reduced, Variable};
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
    /// Is the list complete? Only the enumerator may say so.
    pub complete: bool,
    /// What stands behind the claim.
    pub evidence: String,
    /// The enumerator's run, for what is only reported.
    pub enumeration: Option<&'a Enumeration>,
}

/// The report as JSON.
pub fn solutions_json(report: &Report<'_>) -> Value {
    let wide = |e: &Enumeration| -> Vec<Value> {
        let item = |w: &crate::oracle::WideKernel| {
            let value = crate::exact::to_decimal(&mut w.value.clone(), &crate::exact::Poly::from_ints(&[0, 1]), super::listed::DIGITS);
            json!({ "value": value, "support": w.support, "kernel_dimension": w.dimension })
        };
        e.wide.iter().map(item).collect()
    };
    let mut out = json!({
        "format": SOLUTIONS_FORMAT,
        "problem_sha256": report.problem.sha256(),
        "unknown": report.problem.unknown().word(),
        "claim": if report.complete { "complete" } else { "solutions" },
        "evidence": report.evidence,
        "solutions": report.solutions.iter().map(listed).collect::<Vec<_>>(),
        "continua": report.enumeration.map_or_else(Vec::new, |e| e.continua.clone()),
        "wide_kernels": report.enumeration.map_or_else(Vec::new, wide),
    });
    if let Body::System(_) = report.problem.body() {
        out["variables"] = report.reduced.variables.iter().map(variable).collect();
    }
    out
}

fn listed(s: &Listed) -> Value {
    let mut out = json!({
        "value": s.value, "slip": s.slip, "biactive": s.biactive, "x": s.x, "y": s.y, "kernel_dimension": 1,
    });
    if let Some((polynomial, interval)) = &s.exact {
        let polynomial: Vec<String> = polynomial.iter().map(ToString::to_string).collect();
        let interval: Vec<String> = interval.iter().map(ToString::to_string).collect();
        out["exact"] = json!({ "polynomial": polynomial, "interval": interval });
    }
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
            let tangent: Vec<Value> = tangent.iter().map(|(dof, c)| json!([dof, c.to_string()])).collect();
            json!({ "slip": { "sign": sign, "tangent": tangent } })
        }
    }
}

/// The report for people.
pub fn solutions_text(report: &Report<'_>) -> String {
    // All of x where that fits a line, else the slip variables.
    let order = report.reduced.pencil.order();
    let slip = if order <= SHORT { (0..order).collect() } else { report.reduced.pencil.slip() };
    let what = if order <= SHORT { "x (e'x_s = 1)" } else { "x (slip variables, e'x_s = 1)" };
    let mut table = Table::new(&[report.problem.unknown().word(), "slip", "biactive", what]);
    for s in &report.solutions {
        let x: Vec<String> = slip.iter().map(|&i| short(&s.x[i])).collect();
        table.row(vec![s.value.clone(), format!("{:?}", s.slip), format!("{:?}", s.biactive), x.join(" ")]);
    }
    let mut out = if report.solutions.is_empty() { String::new() } else { table.to_string() + &meaning(report, &slip) };
    if let Some(e) = report.enumeration {
        for w in &e.wide {
            out +=
                &format!("wide kernel: support {:?}, dimension {}: may hold a cone of solutions, not described\n", w.support, w.dimension);
        }
        for c in &e.continua {
            out += &format!("singular pencil: support {c:?}: every value is an eigenvalue of it, not described\n");
        }
    }
    out += &format!("{} solution{}: {}\n", report.solutions.len(), if report.solutions.len() == 1 { "" } else { "s" }, report.evidence);
    out
}

/// Largest order whose x is printed in full.
const SHORT: usize = 8;

/// What the printed variables of a system stand for: dofs, and particles by their dof and S.
fn meaning(report: &Report<'_>, printed: &[usize]) -> String {
    let one = |i: &usize| match report.reduced.variables.get(*i)? {
        Variable::Free { dof } => Some(format!("x[{i}] = v[{dof}]")),
        Variable::Slip { sign, tangent, .. } => {
            let dof = tangent.first().map_or(0, |d| d.0);
            Some(format!("x[{i}] = -S v_T of the particle at dof {dof}, S = {sign:+}"))
        }
    };
    let lines: Vec<String> = printed.iter().filter_map(one).collect();
    if lines.is_empty() { String::new() } else { format!("where {}\n", lines.join(", ")) }
}

/// A decimal cut to eight significant characters for a table.
fn short(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(v) => format!("{v:.6}"),
        Err(_) => text.to_string(),
    }
}
