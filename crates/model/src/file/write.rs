//! Writing a problem file, and a file of a body under loads: what `reduce`, `convert`, `block` and
//! the generators hand to other programs.
//!
//! Every number is written as an exact string, matrices as sparse entries, so that reading the file
//! gives an equal problem or body with the same digest.

use super::{LOADS_FORMAT, LoadsFile, Number, PROBLEM_FORMAT, write_matrix_market};
use crate::LoadedBody;
use crate::{
    Body, ContactState, Coordinates, Particle, Pencil, Problem, QuadraticPencil, Radii, RealWindow,
    System,
};
use mceip_exact::{Rational, Sparse};
use num_traits::{One as _, Zero as _};
use serde_json::{Map, Value, json};

/// The problem as `mceip-problem/1`, matrices inlined as sparse entries.
pub fn write_problem(problem: &Problem) -> String {
    let mut out = write_head(&Head {
        format: PROBLEM_FORMAT,
        name: problem.name.as_deref(),
        comment: problem.comment.as_deref(),
        warnings: &problem.warnings,
        coordinates: problem.coordinates.as_ref(),
    });
    out.insert("unknown".into(), json!(problem.unknown().word()));
    out.insert("window".into(), write_window(&problem.real_window()));

    match problem.body() {
        Body::Pencil(pencil) => out.insert("pencil".into(), write_pencil(pencil)),
        Body::Quadratic(quadratic) => out.insert("pencil".into(), write_quadratic(quadratic)),
        Body::System(system) => out.insert("system".into(), write_system(system)),
    };

    Value::Object(out).to_string()
}

/// The problem as `problem.json` and the Matrix Market files that it names: the names and contents
/// of files for one folder. Read from there it has the digest of `problem`.
pub fn write_problem_beside_matrices(problem: &Problem) -> Vec<(&'static str, String)> {
    let (part, matrices) = match problem.body() {
        Body::Pencil(pencil) => (
            "pencil",
            vec![("a", "A.mtx", pencil.a()), ("b", "B.mtx", pencil.b())],
        ),
        Body::Quadratic(quadratic) => {
            let [a, b, c] = quadratic.coefficients();
            let matrices = vec![("a", "A.mtx", a), ("b", "B.mtx", b), ("c", "C.mtx", c)];
            ("pencil", matrices)
        }
        Body::System(system) => {
            let mut matrices = vec![("stiffness", "K.mtx", system.stiffness())];
            matrices.extend(system.mass().map(|mass| ("mass", "M.mtx", mass)));
            ("system", matrices)
        }
    };

    // Our own writer's JSON is read without error.
    let mut out: Value = serde_json::from_str(&write_problem(problem)).unwrap_or_default();
    let mut files = Vec::new();
    for (field, file, matrix) in matrices {
        out[part][field] = json!({ "matrix_market": file });
        files.push((file, write_matrix_market(matrix)));
    }

    files.push(("problem.json", format!("{out:#}\n")));
    files
}

/// The body and its loads as `mceip-loads/1`. The held dofs are eliminated: what they exert is
/// written as forces.
pub fn write_loads(file: &LoadsFile) -> String {
    let mut out = write_head(&Head {
        format: LOADS_FORMAT,
        name: file.name.as_deref(),
        comment: file.comment.as_deref(),
        warnings: &file.warnings,
        coordinates: file.coordinates.as_ref(),
    });
    let mut system = write_matrices(file.body.system());
    system.insert("candidates".into(), write_candidates(&file.body));
    out.insert("system".into(), Value::Object(system));
    out.insert("steps".into(), write_steps(&file.body));

    Value::Object(out).to_string()
}

/// What both kinds of files begin with.
struct Head<'a> {
    format: &'static str,
    name: Option<&'a str>,
    comment: Option<&'a str>,
    warnings: &'a [String],
    coordinates: Option<&'a Coordinates>,
}

fn write_head(head: &Head<'_>) -> Map<String, Value> {
    let mut out = Map::new();
    out.insert("format".into(), json!(head.format));
    if let Some(name) = head.name {
        out.insert("name".into(), json!(name));
    }

    if let Some(comment) = head.comment {
        out.insert("comment".into(), json!(comment));
    }

    if !head.warnings.is_empty() {
        out.insert("warnings".into(), json!(head.warnings));
    }

    if let Some(coordinates) = head.coordinates {
        out.insert("coordinates".into(), write_coordinates(coordinates));
    }

    out
}

fn write_candidates(body: &LoadedBody) -> Value {
    let particles = body.system().particles().iter();
    let mut candidates = Vec::new();
    for (particle, gap) in particles.zip(body.gaps()) {
        let mut candidate = write_directions(particle);
        candidate.insert("gap".into(), json!(gap.to_string()));
        candidates.push(Value::Object(candidate));
    }

    Value::Array(candidates)
}

fn write_steps(body: &LoadedBody) -> Value {
    let mut steps = Vec::new();
    for (step, load) in body.steps().iter().zip(body.loads()) {
        let mut forces = Vec::new();
        for (dof, force) in load.iter().enumerate() {
            if !force.is_zero() {
                forces.push(json!([dof, Number(force.clone())]));
            }
        }
        steps.push(json!({
            "name": step.name,
            "forces": forces,
            "endless": step.is_endless,
        }));
    }

    Value::Array(steps)
}

/// A matrix as `{rows, cols, entries}` with exact entries.
pub fn write_sparse(m: &Sparse) -> Value {
    let entries: Vec<Value> = m
        .entries()
        .map(|(i, j, entry)| json!([i, j, Number(entry.clone())]))
        .collect();
    json!({ "rows": m.rows(), "cols": m.cols(), "entries": entries })
}

fn write_window(window: &RealWindow) -> Value {
    let [min, max] = [window.min(), window.max()].map(|end| end.map(Rational::to_string));
    json!({ "min": min, "max": max })
}

fn write_coordinates(coordinates: &Coordinates) -> Value {
    let mut nodes = Vec::new();
    for node in coordinates.nodes() {
        let [along_x, along_y] = node.dofs;
        let [x, y] = node.place.each_ref().map(Rational::to_string);
        nodes.push(json!([along_x, along_y, x, y]));
    }

    let mut out = Map::new();
    out.insert("nodes".into(), json!(nodes));
    if !coordinates.edges().is_empty() {
        out.insert("edges".into(), json!(coordinates.edges()));
    }
    if !coordinates.prescribed().is_empty() {
        let mut prescribed = Vec::new();
        for moved in coordinates.prescribed() {
            let [x, y] = moved.by.each_ref().map(Rational::to_string);
            prescribed.push(json!([moved.step, moved.node, x, y]));
        }
        out.insert("prescribed".into(), json!(prescribed));
    }

    Value::Object(out)
}

fn write_pencil(pencil: &Pencil) -> Value {
    json!({
        "a": write_sparse(pencil.a()),
        "b": write_sparse(pencil.b()),
        "free": pencil.free(),
    })
}

fn write_quadratic(quadratic: &QuadraticPencil) -> Value {
    let [a, b, c] = quadratic.coefficients().map(write_sparse);
    json!({ "a": a, "b": b, "c": c })
}

fn write_system(system: &System) -> Value {
    let mut out = write_matrices(system);
    let particles = system.particles().iter().map(write_particle).collect();
    out.insert("particles".into(), particles);

    Value::Object(out)
}

/// K, M, their radii and mu.
fn write_matrices(system: &System) -> Map<String, Value> {
    let mut out = Map::new();
    out.insert("stiffness".into(), write_sparse(system.stiffness()));
    if let Some(mass) = system.mass() {
        out.insert("mass".into(), write_sparse(mass));
    }

    if let Some(mu) = system.friction() {
        out.insert("friction".into(), json!(mu.to_string()));
    }

    if !system.radii().is_none() {
        out.insert("radii".into(), write_radii(system.radii()));
    }

    out
}

fn write_radii(radii: &Radii) -> Value {
    let Radii { stiffness, mass } = radii;
    let mut out = Map::new();
    for (field, radius) in [("stiffness", stiffness), ("mass", mass)] {
        if let Some(radius) = radius {
            out.insert(field.into(), json!({ "matrix": write_sparse(radius) }));
        }
    }

    Value::Object(out)
}

fn write_particle(particle: &Particle) -> Value {
    let mut out = write_directions(particle);
    out.insert("state".into(), json!(particle.state.word()));
    if let ContactState::Slip { sign } = particle.state {
        out.insert("sign".into(), json!(sign));
    }

    if let Some(reaction) = &particle.reaction {
        let numbers = json!({
            "normal": reaction.normal.to_string(),
            "tangential": reaction.tangential.to_string(),
        });
        out.insert("reaction".into(), numbers);
    }
    if let Some(curvature) = &particle.curvature {
        let numbers = json!({
            "value": curvature.value.to_string(),
            "normal_reaction": curvature.normal_reaction.to_string(),
        });
        out.insert("curvature".into(), numbers);
    }

    Value::Object(out)
}

/// Name, dofs, directions and friction factor: what a particle has in common with a candidate.
fn write_directions(particle: &Particle) -> Map<String, Value> {
    let mut out = Map::new();
    if let Some(name) = &particle.name {
        out.insert("name".into(), json!(name));
    }
    out.insert("tangential".into(), json!(particle.tangential));
    out.insert("normal".into(), json!(particle.normal));
    out.insert("normal_direction".into(), json!(particle.normal_direction));

    if let Some(frame) = &particle.frame {
        let rows = frame
            .each_ref()
            .map(|row| row.each_ref().map(Rational::to_string));
        out.insert("frame".into(), json!(rows));
    }

    if !particle.friction_factor.is_one() {
        let factor = particle.friction_factor.to_string();
        out.insert("friction_factor".into(), json!(factor));
    }
    if let Some(range) = &particle.friction_factor_range {
        let ends = range.each_ref().map(Rational::to_string);
        out.insert("friction_factor_range".into(), json!(ends));
    }

    out
}
