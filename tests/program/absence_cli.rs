//! `certify` from outside on what is no solution: the refusal, the proof in a file, and `check` on
//! it.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};

fn root(path: &str) -> String {
    format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))
}

fn report(folder: &Folder, solutions: &str) -> String {
    folder.write(
        "report.json",
        &format!(r#"{{"format":"mceip-solutions/1","solutions":{solutions}}}"#),
    )
}

/// lambda^2 = 2 and 3 are the only solutions.
#[test]
fn a_refusal_comes_with_a_certificate_of_absence() {
    let folder = Folder::new();
    let fold = root("spec/examples/fold.json");
    let (file, out) = (
        report(&folder, r#"[{"value":2.5,"x":[0.6,0.4]}]"#),
        folder.path("absent.json"),
    );
    let o = mceip(&[
        "certify",
        &fold,
        &file,
        "--absence-radius",
        "0.25",
        "--out",
        &out,
    ]);
    let said = String::from_utf8_lossy(&o.stderr);
    assert_eq!(o.status.code(), Some(1), "{said}");
    assert!(
        said.contains("REFUSED: no solution with lambda2 in [2.25, 2.75] (proved)"),
        "{said}"
    );
    let checked = mceip(&["check", &fold, &out]);
    let said = String::from_utf8_lossy(&checked.stdout);
    assert_eq!(checked.status.code(), Some(0), "{said}");
    assert!(
        said.starts_with("ABSENT in [9/4, 11/4]: no solution") && said.lines().count() == 1,
        "{said}"
    );
    // The same proof does not hold for another problem.
    assert_eq!(
        mceip(&["check", &root("spec/examples/two-particles.json"), &out])
            .status
            .code(),
        Some(1)
    );
}

#[test]
fn several_refusals_go_to_a_folder() {
    let folder = Folder::new();
    let fold = root("spec/examples/fold.json");
    let list = r#"[{"value":2,"x":[2,1]},{"value":2.5,"x":[1,1]},{"value":3,"x":[1,1]},{"value":-1,"x":[1,1]}]"#;
    let (file, proofs, out) = (
        report(&folder, list),
        folder.path("proofs"),
        folder.path("out.json"),
    );
    let o = mceip(&["certify", &fold, &file, "--absence", &proofs, "--out", &out]);
    let said = String::from_utf8_lossy(&o.stderr);
    assert_eq!(o.status.code(), Some(1), "{said}");
    assert!(
        said.contains(
            "solution 2 (value 3): REFUSED: with lambda2 in [2.9996, 3.0004] there is only"
        ),
        "{said}"
    );
    assert!(
        said.contains("outside the problem's window")
            && said.contains("1 distinct solutions certified, 3 of 4 disproved, 0 undecided")
    );
    assert_eq!(mceip(&["check", &fold, &out]).status.code(), Some(0));
    let absent = mceip(&["check", &fold, &format!("{proofs}/absence-1.json")]);
    assert!(String::from_utf8_lossy(&absent.stdout).starts_with("ABSENT in ["));
    let other = mceip(&["check", &fold, &format!("{proofs}/absence-2.json")]);
    assert!(String::from_utf8_lossy(&other.stdout).contains("COMPLETE: 1 solution"));
    assert!(!std::path::Path::new(&format!("{proofs}/absence-3.json")).exists());
}

/// A pencil that is singular on {0, 1}: every value is one, a family that is no absence.
#[test]
fn what_is_neither_is_undecided() {
    let folder = Folder::new();
    let problem = r#"{"format":"mceip-problem/1","unknown":"mu","pencil":{"a":[[1,-1],[-1,1]],"b":[[0,0],[0,0]]}}"#;
    let problem = folder.write("singular.json", problem);
    let o = mceip(&[
        "certify",
        &problem,
        &report(&folder, r#"[{"value":1,"x":[1,0]}]"#),
    ]);
    let said = String::from_utf8_lossy(&o.stderr);
    assert_eq!(o.status.code(), Some(3), "{said}");
    assert!(
        said.contains("undecided: support [0]")
            && said.contains("families of solutions lie with mu in ["),
        "{said}"
    );
    for radius in ["0", "-1", "x"] {
        refused(
            &[
                "certify",
                &problem,
                &folder.path("report.json"),
                "--absence-radius",
                radius,
            ],
            &["--absence-radius"],
        );
    }
}

#[test]
fn lifted_claims_are_written_and_checked() {
    let folder = Folder::new();
    for name in ["two-particles", "oblique", "two-particles-mu"] {
        let problem = root(&format!("spec/examples/{name}.json"));
        let listed = mceip(&["enumerate", &problem, "--json"]);
        let listed = folder.write("listed.json", &String::from_utf8_lossy(&listed.stdout));
        let out = folder.path("lifted.json");
        assert_eq!(
            mceip(&["certify", &problem, &listed, "--lifted", "--out", &out])
                .status
                .code(),
            Some(0)
        );
        assert!(
            std::fs::read_to_string(&out)
                .unwrap()
                .contains("\"lifted_solution\"")
        );
        assert_eq!(mceip(&["check", &problem, &out]).status.code(), Some(0));
    }
}

/// Entries from 1e-400 to 1e400: an exact decision of a support takes minors of thousands of bits
/// and as many halvings. `certify` did not end on this file; such supports stay open.
#[test]
fn numbers_of_every_magnitude_stay_undecided_at_once() {
    let folder = Folder::new();
    let problem = folder.write(
        "problem.json",
        r#"{"format": "mceip-problem/1", "unknown": "mu", "pencil": {
            "a": [["3", "1e308", "1", "-3"], ["2", "3", "-1e-400", ".5"],
                  ["-1", "-3", "0", "0"], ["7", ".5", "-1", "9"]],
            "b": [["1", "-1e400", "1e300", "0"],
                  ["-3", "1.7976931348623159e308", "1", "1e300"],
                  ["-1", "3", "3", "2.2250738585072014e-308"], ["0", "1e-400", "0", "0"]],
            "free": [3]}}"#,
    );
    let file = report(&folder, r#"[{"value": 0, "x": [1, 1, 2, 0]}]"#);

    let started = std::time::Instant::now();
    let o = mceip(&["certify", &problem, &file]);

    let said = String::from_utf8_lossy(&o.stderr);
    assert_eq!(o.status.code(), Some(3), "{said}");
    assert!(said.contains("regions stay open"), "{said}");
    assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
}
