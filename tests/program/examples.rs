//! The programs of `examples/` run and say what their text promises.
//!
//! Their problem has the solutions lambda^2 = 2 and 3; a program that no longer compiles, fails, or
//! prints something else is noticed.
#![cfg(feature = "cli")]

use std::process::Command;

/// What an example prints.
fn output(example: &str) -> String {
    let run = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--example", example])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&run.stderr);

    assert!(run.status.success(), "{example}: {complaint}");
    String::from_utf8(run.stdout).unwrap()
}

#[test]
fn the_first_program_is_short_and_finds_both_solutions() {
    let source = include_str!("../../examples/first_program.rs");
    let body = source.split_once("fn main").unwrap().1;
    let statements = body
        .lines()
        .filter(|line| line.trim_end().ends_with([';', '{']));

    assert!(statements.count() <= 10);
    assert_eq!(
        output("first_program"),
        "found lambda2 = 2, support [0, 1]\nfound lambda2 = 3, support [0, 1]\n\
         in all 2, complete: true\nthe certificate is accepted\n"
    );
}

#[test]
fn the_engineer_gets_an_answer_with_its_evidence() {
    let said = output("engineer");

    assert!(said.contains("divergence"), "{said}");
}

#[test]
fn a_good_point_is_proved_and_a_wrong_one_is_not() {
    let said = output("certify_yours");

    assert!(said.contains("proved: lambda2 = 2"), "{said}");
    assert!(said.contains("not proved: "), "{said}");
}

#[test]
fn a_certificate_is_accepted_for_its_problem_alone() {
    let said = output("check_certificate");

    assert!(
        said.starts_with(
            "proved: a solution with support [0, 1]
rejected: digest"
        ),
        "{said}"
    );
}

#[test]
fn an_interrupted_search_is_taken_up_again() {
    let said = output("interrupted");

    assert!(said.contains("regions open"), "{said}");
    assert!(said.ends_with("complete: true, 1 solutions\n"), "{said}");
}
