//! Problem files and the files beside them, as they are read from a folder.
//!
//! The truth is the format of problem files: a matrix may stand in a MatrixMarket file beside its
//! problem and nowhere else, and what is wrong is said in words. Each file here is right but for
//! one thing, so that a check left out shows as a file that is accepted.

use mceip_exact::{Integer, whole};
use mceip_model::file::{read_matrix_market, read_problem, read_problem_file, read_text};
use mceip_model::{Body, ModelError, Problem, Unknown};
use std::path::Path;

/// The lower triangle by columns; each entry is 10 times its row plus its column.
const MARKET: &str = "%%MatrixMarket matrix array real symmetric\n3 3\n11\n21\n31\n22\n32\n33\n";

fn is_unreadable(error: &ModelError) -> bool {
    matches!(error, ModelError::Unreadable { .. })
}

#[test]
fn a_matrix_is_read_from_beside_the_problem() {
    let folder = tempfile::tempdir().unwrap();
    let matrix_path = folder.path().join("a.mtx");
    let problem_path = folder.path().join("p.json");
    let problem = r#"{
        "format": "mceip-problem/1",
        "unknown": "mu",
        "pencil": {
            "a": {"matrix_market": "a.mtx"},
            "b": {"matrix_market": "a.mtx"},
            "free": []
        }
    }"#;
    std::fs::write(&problem_path, problem).unwrap();

    // Nothing where the matrix should be.
    let missing = read_problem_file(&problem_path).unwrap_err();
    assert!(is_unreadable(&missing));

    // A folder there.
    std::fs::create_dir(&matrix_path).unwrap();
    let complaint = read_problem_file(&problem_path).unwrap_err().to_string();
    assert!(complaint.contains("expected a regular file"), "{complaint}");
    std::fs::remove_dir(&matrix_path).unwrap();

    // The matrix.
    std::fs::write(&matrix_path, MARKET).unwrap();
    let read = read_problem_file(&problem_path).unwrap();
    let Body::Pencil(pencil) = read.body() else {
        panic!("a pencil")
    };
    assert_eq!(*pencil.a(), read_matrix_market("A", MARKET).unwrap());

    // The matrix in another folder.
    for name in ["../a.mtx", "/a.mtx"] {
        let elsewhere = problem.replace("a.mtx", name);
        let complaint = read_problem(&elsewhere, folder.path()).unwrap_err();
        assert!(complaint.to_string().contains("beside the problem file"));
    }

    assert_eq!(read_text("x", &problem_path).unwrap(), problem);
    let missing = read_text("x", &folder.path().join("none")).unwrap_err();
    assert!(is_unreadable(&missing));
}

#[test]
fn a_symmetric_array_lists_its_lower_triangle_by_columns() {
    let matrix = read_matrix_market("K", MARKET).unwrap();

    for i in 0..3usize {
        for j in 0..3usize {
            let row = i.max(j) as i64 + 1;
            let column = i.min(j) as i64 + 1;
            assert_eq!(matrix.get(i, j), whole(10 * row + column));
        }
    }
}

/// A problem of order 1 with this text for its matrix A.
fn problem_with_a(a: &str) -> String {
    let text = r#"{
        "format": "mceip-problem/1",
        "unknown": "mu",
        "pencil": {"a": MATRIX, "b": [[1]], "free": []}
    }"#;
    text.replace("MATRIX", a)
}

/// What is said of a text that is no problem.
fn complaint_about(text: &str) -> String {
    read_problem(text, Path::new(".")).unwrap_err().to_string()
}

/// What was expected is said in words, and what was got.
#[test]
fn complaints_name_what_was_expected() {
    let expected_forms = "dense rows, or an object with dense, entries or matrix_market";
    let cases = [
        ("7", expected_forms),
        ("[[null]]", "got null"),
        ("[[true]]", "got a boolean"),
        ("[[[1]]]", "got an array"),
        ("[[{}]]", "got an object"),
    ];
    for (a, words) in cases {
        let complaint = complaint_about(&problem_with_a(a));
        assert!(complaint.contains(words), "{a}: {complaint}");
    }

    let complaint = complaint_about("[1]");
    assert!(complaint.contains("an object"), "{complaint}");

    assert_eq!(Unknown::Mu.proposition(), "P1");
    assert_eq!(Unknown::Lambda2.proposition(), "P2");
}

/// Two particles with friction coefficient 1/2. The second has this state and a reaction with this
/// tangential part and the normal part -4.
fn problem_with_reaction(state: &str, tangential: &str) -> Result<Problem, ModelError> {
    let text = r#"{
        "format": "mceip-problem/1",
        "unknown": "mu",
        "system": {
            "stiffness": [[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, 3, 0], [0, 0, 0, 3]],
            "friction": "1/2",
            "particles": [
                {"tangential": 0, "normal": 1, "state": "slip", "sign": 1},
                {
                    "tangential": 2,
                    "normal": 3,
                    STATE,
                    "reaction": {"tangential": "TANGENTIAL", "normal": "-4"}
                }
            ]
        }
    }"#;
    let text = text.replace("STATE", state);
    let text = text.replace("TANGENTIAL", tangential);
    read_problem(&text, Path::new("."))
}

/// mu = 1/2, r_N = -4: the cone is |r_T| <= 2. A reaction at its edge slips, one within sticks.
#[test]
fn a_reaction_fits_the_state_of_its_particle() {
    let slip = r#""state": "slip", "sign": 1"#;
    let stick = r#""state": "stick""#;

    for (state, tangential) in [(slip, "2"), (stick, "1")] {
        let read = problem_with_reaction(state, tangential);
        assert!(read.is_ok(), "{state} {tangential}");
    }

    let contradictions = [(slip, "1"), (slip, "8"), (stick, "2"), (stick, "-7")];
    for (state, tangential) in contradictions {
        let read = problem_with_reaction(state, tangential);
        let is_refused = matches!(
            read,
            Err(ModelError::ReactionContradicts { particle: 1, .. })
        );
        assert!(is_refused, "{state} {tangential}");
    }
}

/// Is a problem with this window accepted?
fn is_window_accepted(min: &str, max: &str) -> bool {
    let text = r#"{
        "format": "mceip-problem/1",
        "unknown": "lambda2",
        "pencil": {"a": [["-1"]], "b": [["1"]], "free": []},
        "window": {"min": "MIN", "max": "MAX"}
    }"#;
    let text = text.replace("MIN", min).replace("MAX", max);
    read_problem(&text, Path::new("/nonexistent")).is_ok()
}

/// A window between two quotients of Fibonacci numbers, 84 kB: a comparison by continued fractions
/// takes a step for each bit of them, and overflowed the stack.
#[test]
fn ends_that_are_long_and_close_are_compared() {
    let mut first = Integer::from(1);
    let mut second = Integer::from(1);
    for _ in 0..100_000 {
        let next = &first + &second;
        first = std::mem::replace(&mut second, next);
    }
    let third = &first + &second;
    let quotient = format!("{second}/{first}");
    let next_quotient = format!("{third}/{second}");

    let in_order = is_window_accepted(&quotient, &next_quotient);
    let in_opposite_order = is_window_accepted(&next_quotient, &quotient);

    assert!(
        in_order != in_opposite_order,
        "one of the two windows is empty: {in_order} {in_opposite_order}"
    );
}
