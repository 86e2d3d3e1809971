//! `mceip check` and `spec/checker.py` read the same problem files and refuse the same ones.
//!
//! The certificate is one that every problem rejects, so that the exit code tells whether the
//! problem was read. What has to be read follows from `spec/formats.md`.
#![cfg(feature = "cli")]

use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

const READ: i32 = 1;
const REFUSED: i32 = 2;

/// A certificate that every problem rejects, because it speaks of another one: exit 1 if the
/// problem can be read.
fn stray_certificate() -> Value {
    json!({
        "format": "mceip-certificate/1",
        "problem_sha256": "0".repeat(64),
        "unknown": "mu",
        "window": { "min": "0", "max": null },
        "claims": [],
    })
}

/// Both programs read the problem, or both refuse it.
fn assert_verdict(folder: &Path, problem: &Value, expected: i32, what: &str) {
    let problem_file = folder.join("problem.json");
    let certificate_file = folder.join("certificate.json");
    std::fs::write(&problem_file, problem.to_string()).unwrap();
    std::fs::write(&certificate_file, stray_certificate().to_string()).unwrap();

    let ours = Command::new(env!("CARGO_BIN_EXE_mceip"))
        .arg("check")
        .args([&problem_file, &certificate_file])
        .output()
        .unwrap();
    assert_eq!(
        ours.status.code(),
        Some(expected),
        "mceip check, {what}: {}",
        String::from_utf8_lossy(&ours.stderr)
    );

    let checker = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/checker.py");
    let theirs = Command::new("python3")
        .arg(checker)
        .args([&problem_file, &certificate_file])
        .output()
        .unwrap();
    assert_eq!(
        theirs.status.code(),
        Some(expected),
        "checker.py, {what}: {}",
        String::from_utf8_lossy(&theirs.stderr)
    );
}

/// A problem whose matrix A is in a Matrix Market file.
fn market_problem(file: &str) -> Value {
    let matrix = json!({ "matrix_market": file });
    json!({
        "format": "mceip-problem/1",
        "unknown": "mu",
        "pencil": { "a": matrix, "b": [["1"]], "free": [] },
    })
}

/// The matrix [-6] with this separator between the words.
fn market(separator: &str) -> String {
    format!("%%MatrixMarket matrix coordinate real general\n1 1 1\n1{separator}1{separator}-6\n")
}

/// Blanks and tabs part the words of a Matrix Market file; other control characters and wide blanks
/// do not.
#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn words_of_a_matrix_market_file() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        (" ", READ),
        ("\t", READ),
        (" \t ", READ),
        ("\u{1c}", REFUSED),
        ("\u{1f}", REFUSED),
        ("\u{b}", REFUSED),
        ("\u{a0}", REFUSED),
    ];

    for (separator, expected) in cases {
        std::fs::write(folder.path().join("a.mtx"), market(separator)).unwrap();
        assert_verdict(
            folder.path(),
            &market_problem("a.mtx"),
            expected,
            &format!("{separator:?}"),
        );
    }
}

/// A link may stand for a file of the folder or below it, never for one outside.
#[test]
#[cfg(unix)]
fn links_out_of_the_folder() {
    use std::os::unix::fs::symlink;

    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("inner");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(outer.path().join("outside.mtx"), market(" ")).unwrap();
    std::fs::write(folder.join("inside.mtx"), market(" ")).unwrap();
    symlink(folder.join("inside.mtx"), folder.join("good.mtx")).unwrap();
    symlink(outer.path().join("outside.mtx"), folder.join("bad.mtx")).unwrap();

    assert_verdict(
        &folder,
        &market_problem("good.mtx"),
        READ,
        "a link within the folder",
    );
    assert_verdict(
        &folder,
        &market_problem("bad.mtx"),
        REFUSED,
        "a link out of the folder",
    );
}

/// A system of six degrees of freedom with unit stiffness.
fn system(particles: Value) -> Value {
    let mut identity = vec![vec!["0"; 6]; 6];
    for (i, row) in identity.iter_mut().enumerate() {
        row[i] = "1";
    }

    json!({
        "format": "mceip-problem/1",
        "unknown": "mu",
        "system": { "stiffness": identity, "particles": particles },
    })
}

/// The friction factor of a particle is a positive number, its name a text.
#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn friction_factors_and_names_of_a_particle() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("friction_factor", json!(null), READ),
        ("friction_factor", json!("1"), READ),
        ("friction_factor", json!("3/2"), READ),
        ("friction_factor", json!(0.25), READ),
        ("friction_factor", json!(0), REFUSED),
        ("friction_factor", json!("-1/2"), REFUSED),
        ("friction_factor", json!("rough"), REFUSED),
        ("friction_factor", json!("NaN"), REFUSED),
        ("friction_factor", json!([1]), REFUSED),
        ("friction_factor", json!(true), REFUSED),
        ("name", json!(null), READ),
        ("name", json!("heel"), READ),
        ("name", json!(""), READ),
        ("name", json!(1), REFUSED),
        ("name", json!(["heel"]), REFUSED),
        ("label", json!("heel"), REFUSED),
    ];

    for (field, value, expected) in cases {
        let mut slip = json!({ "tangential": 0, "normal": 1, "state": "slip", "sign": 1 });
        let what = format!("{field} {value}");
        slip[field] = value;
        assert_verdict(folder.path(), &system(json!([slip])), expected, &what);
    }
}

/// No degree of freedom belongs to two particles, free ones included, and one particle has to be in
/// impending slip.
#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn particles_of_a_system() {
    let folder = tempfile::tempdir().unwrap();
    let slip = json!({ "tangential": 0, "normal": 1, "state": "slip", "sign": 1 });
    let free = json!({ "tangential": 2, "normal": 3, "state": "free" });
    let stick = json!({ "tangential": 4, "normal": 5, "state": "stick" });
    let crossed = json!({ "tangential": 3, "normal": 4, "state": "free" });

    let cases = [
        (json!([slip, free, stick]), READ, "three particles"),
        (json!([slip, free, free]), REFUSED, "a free particle twice"),
        (
            json!([slip, free, crossed]),
            REFUSED,
            "two free particles that share a dof",
        ),
        (
            json!([slip, crossed, stick]),
            REFUSED,
            "a free and a sticking particle that share a dof",
        ),
        (
            json!([free, stick]),
            REFUSED,
            "no particle in impending slip",
        ),
    ];

    for (particles, expected, what) in cases {
        assert_verdict(folder.path(), &system(particles), expected, what);
    }
}

/// Warnings of `convert` stand beside the mathematics; a field that means nothing does not.
#[test]
fn warnings_of_a_problem() {
    let folder = tempfile::tempdir().unwrap();
    let problem = system(json!([{ "tangential": 0, "normal": 1, "state": "slip", "sign": 1 }]));

    for (field, expected) in [("warnings", READ), ("warning", REFUSED)] {
        let mut with_field = problem.clone();
        with_field[field] = json!(["the normal points into the body", ""]);
        assert_verdict(folder.path(), &with_field, expected, field);
    }
}

/// A radius is one number or a symmetric matrix that is not negative, of a matrix that is given.
#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn radii_of_a_system() {
    let folder = tempfile::tempdir().unwrap();
    let none_coupled = json!({ "rows": 6, "cols": 6, "entries": [] });
    let coupled = |i, j, radius| json!({ "rows": 6, "cols": 6, "symmetric": true, "entries": [[i, j, radius]] });
    let one_sided = json!({ "rows": 6, "cols": 6, "entries": [[0, 1, "1/2"]] });

    let cases = [
        (json!(null), READ),
        (json!({}), READ),
        (json!([]), REFUSED),
        (json!({ "friction": 1 }), REFUSED),
        (json!({ "stiffness": null }), READ),
        (json!({ "stiffness": 1 }), REFUSED),
        (json!({ "stiffness": {} }), REFUSED),
        (json!({ "stiffness": { "absolute": "1/100" } }), READ),
        (json!({ "stiffness": { "absolute": 0 } }), READ),
        (json!({ "stiffness": { "absolute": 100 } }), READ),
        (json!({ "stiffness": { "absolute": -1 } }), REFUSED),
        (json!({ "stiffness": { "absolute": [1] } }), REFUSED),
        (json!({ "stiffness": { "relative": 1e-3 } }), READ),
        (json!({ "stiffness": { "relative": "-1/2" } }), REFUSED),
        (
            json!({ "stiffness": { "absolute": 1, "relative": "1/2" } }),
            REFUSED,
        ),
        (json!({ "stiffness": { "matrix": none_coupled } }), READ),
        (
            json!({ "stiffness": { "matrix": coupled(1, 0, "1/2") } }),
            READ,
        ),
        (
            json!({ "stiffness": { "matrix": coupled(1, 0, "-1/2") } }),
            REFUSED,
        ),
        (json!({ "stiffness": { "matrix": one_sided } }), REFUSED),
        (json!({ "stiffness": { "matrix": [[1]] } }), REFUSED),
        (json!({ "mass": { "absolute": 1 } }), REFUSED),
        (json!({ "mass": null }), READ),
    ];

    let slip = json!({ "tangential": 0, "normal": 1, "state": "slip", "sign": 1 });
    for (radii, expected) in cases {
        let mut problem = system(json!([slip]));
        let what = format!("radii {radii}");
        problem["system"]["radii"] = radii;
        assert_verdict(folder.path(), &problem, expected, &what);
    }
}

/// The interval of a friction factor holds the factor, and no particle of such a problem is in
/// contact without a reaction.
#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn intervals_of_friction_factors() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        (json!(null), READ),
        (json!(["1/2", "3/2"]), READ),
        (json!([0, 1]), READ),
        (json!([1, 2]), READ),
        (json!([1, 1]), REFUSED),
        (json!([2, 1]), REFUSED),
        (json!([-1, 1]), REFUSED),
        (json!([2, 3]), REFUSED),
        (json!([0, 1, 2]), REFUSED),
        (json!([0, null]), REFUSED),
        (json!("1/2"), REFUSED),
    ];

    let slip = json!({ "tangential": 0, "normal": 1, "state": "slip", "sign": 1 });
    for state in ["slip", "stick", "zero"] {
        for (range, expected) in &cases {
            let mut particles = json!([slip, { "tangential": 2, "normal": 3, "state": state }]);
            if state == "slip" {
                particles[1]["sign"] = json!(-1);
            }
            let what = format!("{state}, range {range}");
            particles[1]["friction_factor_range"] = range.clone();
            let is_beside_zero = state == "zero" && !range.is_null();
            let expected = if is_beside_zero { REFUSED } else { *expected };
            assert_verdict(folder.path(), &system(particles), expected, &what);
        }
    }
}
