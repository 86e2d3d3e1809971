//! Claims beside a cover: in its list, in an open region, in a family; and pairs of which one half
//! is forged.
//!
//! A certificate may hold claims and a cover at once. Each has to be judged by its own obligations:
//! a checker that lets a true half vouch for a false one accepts the two forgeries.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{Certificate, Claim, ExactSolution, Node, RootOutcome};

pub fn beside(cases: &mut Cases) {
    let problem = fold("15/8", Some("17/8"));
    let proved = cover(
        &problem,
        fold_tree(root_node(AROUND_TWO, RootOutcome::Solution)),
    );
    let true_claim = exact(&[0, 1], &[-2, 1], ["2", "2"], &[&["2"], &["1"]]);

    cases.accept(
        "beside-listed",
        "a claim that no leaf refers to, in the list of the cover",
        &problem,
        &with_claim(&true_claim, &proved),
    );

    let open = cover(&problem, vec![Node::Open]);
    cases.undecided(
        "beside-open",
        "a claim in a region that the cover leaves open",
        &problem,
        &with_claim(&true_claim, &open),
    );

    let cone_pencil = pencil(&[&["-2", "0"], &["0", "-2"]], I2, &[]);
    let cone = window(cone_pencil, "0", Some("4"));
    let in_the_cone = exact(&[0, 1], &[-2, 1], ["2", "2"], &[&["3"], &["1"]]);
    cases.accept(
        "beside-family",
        "a claim in a cone of solutions",
        &cone,
        &with_claim(&in_the_cone, &completed(&cone)),
    );

    let false_claim = exact(&[0, 1], &[-17, 8], ["17/8", "17/8"], &[&["2"], &["1"]]);
    cases.reject(
        "beside-false-claim",
        "YNotZero",
        "a false claim beside a true cover: the claim is to blame",
        &problem,
        &with_claim(&false_claim, &proved),
    );

    let false_cover = cover(
        &problem,
        fold_tree(root_node(AROUND_TWO, RootOutcome::Absent)),
    );

    cases.reject(
        "beside-false-cover",
        "Cover.SignChange",
        "a true claim beside a cover that leaves it out: the cover is to blame",
        &problem,
        &with_claim(&true_claim, &false_cover),
    );
}

/// The claim comes last, so that leaves which refer to a claim still name theirs.
fn with_claim(claim: &ExactSolution, cover: &Certificate) -> Certificate {
    let mut both = cover.clone();
    both.claims.push(Claim::ExactSolution(claim.clone()));
    both
}
