//! Claims beside a cover: in its list, in an open region, in a family; and pairs of which one half
//! is forged.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{Certificate, Claim, ExactSolution, Node, RootOutcome};
use mceip_model::file::write_problem;
use serde_json::{Value, json};

const AROUND: (&str, &str) = ("31/16", "33/16");

pub fn beside(cases: &mut Cases) {
    let p = fold("15/8", Some("17/8"));
    let proved = cover(&p, fold_tree(root_node(AROUND, RootOutcome::Solution)));
    let true_claim = exact(&[0, 1], &[-2, 1], ("2", "2"), &[&["2"], &["1"]]);
    // At the end, so that leaves which refer to a claim still name theirs.
    let with = |claim: &ExactSolution, cover: &Certificate| {
        let mut c = cover.clone();
        c.claims.push(Claim::ExactSolution(claim.clone()));
        c
    };
    cases.accept(
        "beside-listed",
        "a claim that no leaf refers to, in the list of the cover",
        &p,
        &with(&true_claim, &proved),
    );

    let open = with(&true_claim, &cover(&p, vec![Node::Open]));
    let problem: Value = serde_json::from_str(&write_problem(&p)).unwrap();
    let certificate: Value = serde_json::from_str(&open.to_json()).unwrap();
    let file = json!({ "verdict": "undecided", "problem": problem, "certificate": certificate });
    cases.push(
        "accept",
        "beside-open",
        file,
        "a claim in a region that the cover leaves open",
    );

    let at_two = exact(&[0, 1], &[-2, 1], ("2", "2"), &[&["3"], &["1"]]);
    let mass: &[&[&str]] = &[&["1", "0"], &["0", "1"]];
    let cone = window(
        pencil(&[&["-2", "0"], &["0", "-2"]], mass, &[]),
        "0",
        Some("4"),
    );
    cases.accept(
        "beside-family",
        "a claim in a cone of solutions",
        &cone,
        &with(&at_two, &completed(&cone)),
    );

    let false_claim = exact(&[0, 1], &[-17, 8], ("17/8", "17/8"), &[&["2"], &["1"]]);
    let note = "a false claim beside a true cover: the claim is to blame";
    cases.reject(
        "beside-false-claim",
        "YNotZero",
        note,
        &p,
        &with(&false_claim, &proved),
    );
    let forged = cover(&p, fold_tree(root_node(AROUND, RootOutcome::Absent)));
    let note = "a true claim beside a cover that leaves it out: the cover is to blame";
    cases.reject(
        "beside-false-cover",
        "Cover.SignChange",
        note,
        &p,
        &with(&true_claim, &forged),
    );
}
