//! Files around a problem: read from where they lie, and told from what they are not.

use mceip_exact::Integer;
use mceip_model::file::{read_matrix_market, read_problem, read_problem_file, read_text};
use mceip_model::{Body, ModelError, Unknown};
use std::path::Path;

const MARKET: &str = "%%MatrixMarket matrix array real symmetric\n3 3\n11\n21\n31\n22\n32\n33\n";

#[test]
fn a_matrix_is_read_from_beside_the_problem() {
    let folder = tempfile::tempdir().unwrap();
    let problem = r#"{"format": "mceip-problem/1", "unknown": "mu", "pencil": {"a": {"matrix_market": "a.mtx"}, "b": {"matrix_market": "a.mtx"}, "free": []}}"#;
    let path = folder.path().join("p.json");
    std::fs::write(&path, problem).unwrap();
    let unreadable = |e: ModelError| matches!(e, ModelError::Unreadable { .. });
    assert!(unreadable(read_problem_file(&path).unwrap_err()));
    std::fs::create_dir(folder.path().join("a.mtx")).unwrap();
    let folder_instead = read_problem_file(&path).unwrap_err();
    assert!(
        folder_instead
            .to_string()
            .contains("expected a regular file"),
        "{folder_instead}"
    );
    std::fs::remove_dir(folder.path().join("a.mtx")).unwrap();
    std::fs::write(folder.path().join("a.mtx"), MARKET).unwrap();
    let read = read_problem_file(&path).unwrap();
    let Body::Pencil(pencil) = read.body() else {
        panic!("a pencil")
    };
    assert_eq!(*pencil.a(), read_matrix_market("A", MARKET).unwrap());
    for name in ["../a.mtx", "/a.mtx"] {
        let elsewhere = problem.replace("a.mtx", name);
        assert!(
            read_problem(&elsewhere, folder.path())
                .unwrap_err()
                .to_string()
                .contains("beside the problem file")
        );
    }
    assert_eq!(read_text("x", &path).unwrap(), problem);
    assert!(unreadable(
        read_text("x", &folder.path().join("none")).unwrap_err()
    ));
}

#[test]
fn a_symmetric_array_lists_its_lower_triangle_by_columns() {
    let m = read_matrix_market("K", MARKET).unwrap();
    for i in 0..3usize {
        for j in 0..3usize {
            let (row, column) = (i.max(j) as i64 + 1, i.min(j) as i64 + 1);
            assert_eq!(m.get(i, j), mceip_exact::whole(10 * row + column));
        }
    }
}

/// What was expected is said in words, and what was got.
#[test]
fn complaints_name_what_was_expected() {
    let pencil = |a: &str| {
        format!(
            r#"{{"format": "mceip-problem/1", "unknown": "mu", "pencil": {{"a": {a}, "b": [[1]], "free": []}}}}"#
        )
    };
    let message = |text: &str| read_problem(text, Path::new(".")).unwrap_err().to_string();
    for (a, words) in [
        (
            "7",
            "dense rows, or an object with dense, entries or matrix_market",
        ),
        ("[[null]]", "got null"),
        ("[[true]]", "got a boolean"),
        ("[[[1]]]", "got an array"),
        ("[[{}]]", "got an object"),
    ] {
        let got = message(&pencil(a));
        assert!(got.contains(words), "{a}: {got}");
    }
    assert!(message("[1]").contains("an object"), "{}", message("[1]"));
    assert_eq!(
        [Unknown::Mu.proposition(), Unknown::Lambda2.proposition()],
        ["P1", "P2"]
    );
}

/// mu = 1/2, r_N = -4: the cone is |r_T| <= 2. A reaction at its edge slips, one within sticks.
#[test]
fn a_reaction_fits_the_state_of_its_particle() {
    let of = |state: &str, tangential: &str, normal: &str| {
        let text = format!(
            r#"{{"format": "mceip-problem/1", "unknown": "mu", "system": {{"stiffness": [[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, 3, 0], [0, 0, 0, 3]], "friction": "1/2",
            "particles": [{{"tangential": 0, "normal": 1, "state": "slip", "sign": 1}},
            {{"tangential": 2, "normal": 3, {state}, "reaction": {{"tangential": "{tangential}", "normal": "{normal}"}}}}]}}}}"#
        );
        read_problem(&text, Path::new("."))
    };
    let contradicts = |r: Result<_, ModelError>| {
        matches!(r, Err(ModelError::ReactionContradicts { particle: 1, .. }))
    };
    let (slip, stick) = (r#""state": "slip", "sign": 1"#, r#""state": "stick""#);
    for (state, tangential, fits) in [
        (slip, "2", true),
        (slip, "1", false),
        (slip, "8", false),
        (stick, "1", true),
        (stick, "2", false),
        (stick, "-7", false),
    ] {
        let got = of(state, tangential, "-4");
        assert!(
            if fits {
                got.is_ok()
            } else {
                contradicts(got.map(|_| ()))
            },
            "{state} {tangential}"
        );
    }
}

/// A window between two quotients of Fibonacci numbers, 84 kB: a comparison by continued fractions
/// takes a step for each bit of them, and overflowed the stack.
#[test]
fn ends_that_are_long_and_close_are_compared() {
    let (mut a, mut b) = (Integer::from(1), Integer::from(1));
    for _ in 0..100_000 {
        let next = &a + &b;
        a = std::mem::replace(&mut b, next);
    }
    let next = &a + &b;
    let text = |min: &str, max: &str| {
        format!(
            r#"{{"format": "mceip-problem/1", "unknown": "lambda2", "pencil": {{"a": [["-1"]], "b": [["1"]], "free": []}},
                "window": {{"min": "{min}", "max": "{max}"}}}}"#
        )
    };
    let (one, other) = (format!("{b}/{a}"), format!("{next}/{b}"));

    let read = |min: &str, max: &str| read_problem(&text(min, max), Path::new("/nonexistent"));
    let is_read = [read(&one, &other).is_ok(), read(&other, &one).is_ok()];
    assert!(
        is_read[0] != is_read[1],
        "one of the two windows is empty: {is_read:?}"
    );
}
