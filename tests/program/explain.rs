//! `mceip explain`: terms, equations, departures, reasons of rejection.
//!
//! The truth is the pages of the book: each answer is compared with words that stand there. A page
//! that the program no longer finds, or a paragraph that ends too early, changes them.
#![cfg(feature = "cli")]

use std::process::{Command, Output};

fn explain(term: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mceip"))
        .arg("explain")
        .args(term.split_whitespace())
        .output()
        .unwrap()
}

/// The text for a term that is known.
#[track_caller]
fn explained(term: &str) -> String {
    let output = explain(term);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_term_of_the_glossary() {
    let text = explained("impending slip");

    assert!(text.starts_with("impending slip (spec/glossary.md)\n  contact state s"));
}

/// `lumped, consistent mass` is one row for two terms, and `MCEIP-λ²` is not on every keyboard.
#[test]
fn a_term_is_found_by_a_part_and_in_ascii() {
    assert!(explained("lumped").contains("diagonal mass matrix"));
    assert!(explained("mceip-lambda2").contains("(12)-(14)"));
}

#[test]
fn an_equation_by_its_number_or_id() {
    let text = explained("(13)");

    assert!(text.starts_with("E13 (spec/reduction.md)\n  y_f = 0."));
    assert_eq!(explained("13"), text);
    assert_eq!(explained("e13"), text);
}

/// (16) and (9) are longer than one line.
#[test]
fn an_equation_is_explained_to_its_end() {
    assert!(explained("16").contains("M1 = [[0, 0], [-M_{Ns,f}, 0]]"));

    let divergence = explained("9");
    assert!(divergence.contains("S v_Ts <= 0"));
    assert!(divergence.trim_end().ends_with("never says \"stable\"."));
}

#[test]
fn a_departure_from_the_paper() {
    let text = explained("X4");

    assert!(text.starts_with("X4 (spec/errata.md)\n  Equation (9), the lines of the s particles"));
    assert!(text.contains("DIFFERENCE"));
}

/// O1 has no paragraph of that name: its first one is printed.
#[test]
fn an_observation_without_a_departure() {
    assert!(explained("O1").contains("no rational mu satisfies (mu s)^2 = c^2 + 2"));
}

#[test]
fn a_reason_of_rejection_with_and_without_its_prefix() {
    let text = explained("Cover.Truncated");

    assert!(text.contains("A tree ends before all of its regions are closed (5.6)."));
    assert_eq!(explained("truncated"), text);
}

/// `Length` is a reason of claims and of covers.
#[test]
fn a_name_with_two_meanings_has_both() {
    let text = explained("length");

    assert!(text.contains("Length (spec/reasons.md)"));
    assert!(text.contains("Cover.Length (spec/reasons.md)"));
}

#[test]
fn no_markdown_is_left() {
    let text = explained("contact state");

    assert!(text.contains("chapter 1, 1.2"), "{text}");
    assert!(!text.contains("]("), "{text}");
}

#[test]
fn an_unknown_word_is_refused_with_what_is_near() {
    let output = explain("biactiv");
    let message = String::from_utf8(output.stderr).unwrap();

    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    assert_eq!(
        message,
        "mceip: no page explains \"biactiv\"; near it are: biactive; biactive set; Biactive\n"
    );
}

#[test]
fn without_a_term_all_names_are_listed() {
    let text = explained("");

    for name in ["  support", "  E16", "  X9", "  Cover.OutOfBudget"] {
        assert!(text.lines().any(|line| line == name), "{name}");
    }
}
