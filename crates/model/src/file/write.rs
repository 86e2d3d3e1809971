//! Writing a problem file: what `reduce`, `block` and the generators hand to other programs.

use super::{Number, PROBLEM_FORMAT};
use crate::{Body, ContactState, Particle, Problem};
use mceip_exact::Sparse;
use serde_json::{Map, Value, json};

/// The problem as `mceip-problem/1`, matrices inlined as sparse entries.
pub fn write_problem(problem: &Problem) -> String {
    let mut out = Map::new();
    out.insert("format".into(), json!(PROBLEM_FORMAT));
    for (key, text) in [("name", &problem.name), ("comment", &problem.comment)] {
        if let Some(text) = text {
            out.insert(key.into(), json!(text));
        }
    }
    out.insert("unknown".into(), json!(problem.unknown().word()));
    let window = problem.window();
    let max = window.max().map(|m| m.to_string());
    out.insert(
        "window".into(),
        json!({ "min": window.min().to_string(), "max": max }),
    );
    match problem.body() {
        Body::Pencil(p) => {
            out.insert(
                "pencil".into(),
                json!({ "a": write_sparse(p.a()), "b": write_sparse(p.b()), "free": p.free() }),
            );
        }
        Body::System(s) => {
            let mut system = Map::new();
            system.insert("stiffness".into(), write_sparse(s.stiffness()));
            if let Some(m) = s.mass() {
                system.insert("mass".into(), write_sparse(m));
            }
            if let Some(mu) = s.friction() {
                system.insert("friction".into(), json!(mu.to_string()));
            }
            system.insert(
                "particles".into(),
                s.particles().iter().map(particle).collect(),
            );
            out.insert("system".into(), Value::Object(system));
        }
    }
    Value::Object(out).to_string()
}

/// A matrix as `{rows, cols, entries}` with exact entries.
pub fn write_sparse(m: &Sparse) -> Value {
    let entries: Vec<Value> = m
        .entries()
        .map(|(i, j, v)| json!([i, j, Number(v.clone())]))
        .collect();
    json!({ "rows": m.rows(), "cols": m.cols(), "entries": entries })
}

fn particle(p: &Particle) -> Value {
    let mut out = Map::new();
    out.insert("tangential".into(), json!(p.tangential));
    out.insert("normal".into(), json!(p.normal));
    out.insert("state".into(), json!(p.state.word()));
    if let ContactState::Slip { sign } = p.state {
        out.insert("sign".into(), json!(sign));
    }
    out.insert("normal_direction".into(), json!(p.normal_direction));
    if let Some(frame) = &p.frame {
        let rows: Vec<Vec<String>> = frame
            .iter()
            .map(|r| r.iter().map(ToString::to_string).collect())
            .collect();
        out.insert("frame".into(), json!(rows));
    }
    if let Some(r) = &p.reaction {
        out.insert(
            "reaction".into(),
            json!({ "normal": r.normal.to_string(), "tangential": r.tangential.to_string() }),
        );
    }
    Value::Object(out)
}
