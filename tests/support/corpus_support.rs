//! Support leaves: degenerate supports value by value, and a forgery of each fault they have of
//! their own.
//!
//! `complete` writes the accepted ones, so that the corpus holds the leaves of the program beside
//! those made by hand in `corpus_by_leaf.rs`. The forgeries change one leaf of a cover whose other
//! leaves are open.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_by_leaf::{at, member, none, only_member, poly};
use super::corpus_cases::*;
use mceip_check::certificate::{Node, Support};
use mceip_model::Problem;

/// The eigenproblem of A + t I on [0, 4].
fn to_four(a: &[&[&str]]) -> Problem {
    window(pencil(a, I2, &[]), "0", Some("4"))
}

/// Support {0, 1} of diag(t - 1, t - 1) over [0, 4]: at 1 every x > 0, nothing elsewhere.
fn cone() -> Support {
    Support {
        points: vec![at(0, 0), at(1, 1), at(4, 0)],
        cells: vec![0, 0],
        reasons: vec![none(&[&[1], &[]]), member(&[&[1], &[1]])],
    }
}

pub fn supports(cases: &mut Cases) {
    let wide_kernel = to_four(&[&["-1", "0"], &["0", "-1"]]);
    cases.accept(
        "support-cone",
        "a wide kernel at 1, as `complete` writes it: a family beside the list",
        &wide_kernel,
        &completed(&wide_kernel),
    );

    let double_root = to_four(&[&["-1", "1"], &["0", "-1"]]);
    cases.accept(
        "support-double-root",
        "a double root, as `complete` writes it",
        &double_root,
        &completed(&double_root),
    );

    let early = vec![Node::Support(Box::new(cone()))];
    cases.reject(
        "support-early",
        "Cover.SupportTooEarly",
        "a support leaf before the indices are decided",
        &wide_kernel,
        &cover(&wide_kernel, early),
    );

    for forgery in FORGERIES {
        let leaf = forgery.of(&cone());
        let tree = vec![
            Node::Branch(0),
            Node::Open,
            Node::Branch(1),
            Node::Open,
            Node::Support(Box::new(leaf)),
        ];
        let name = format!("support-{}", forgery.name);
        let forged = cover(&wide_kernel, tree);

        cases.reject(&name, forgery.reason, forgery.note, &wide_kernel, &forged);
    }
}

/// Each breaks one obligation of the leaf of {0, 1}.
const FORGERIES: [Forgery<Support>; 11] = [
    Forgery {
        name: "points-swapped",
        reason: "Cover.Point",
        note: "points out of order",
        change: |leaf| leaf.points.swap(0, 1),
    },
    Forgery {
        name: "end-missing",
        reason: "Cover.Point",
        note: "the upper end is no point",
        change: |leaf| {
            leaf.points.pop();
            leaf.cells.pop();
        },
    },
    Forgery {
        name: "no-root",
        reason: "Cover.Point",
        note: "the polynomial does not vanish at its point",
        change: |leaf| leaf.points[1].polynomial = poly(&[-2, 1]),
    },
    Forgery {
        name: "cell-missing",
        reason: "Cover.Length",
        note: "a cell without a reason",
        change: |leaf| {
            leaf.cells.pop();
        },
    },
    Forgery {
        name: "reason-missing",
        reason: "Cover.NoReason",
        note: "a reason that is not there",
        change: |leaf| leaf.points[1].reason = 2,
    },
    Forgery {
        name: "point-hidden",
        reason: "Cover.Place",
        note: "the point with the cone said to hold nothing",
        change: |leaf| leaf.points[1].reason = 0,
    },
    Forgery {
        name: "root-in-cell",
        reason: "Cover.Place",
        note: "a cell that hides the root",
        change: |leaf| {
            leaf.points.remove(1);
            leaf.cells.pop();
        },
    },
    Forgery {
        name: "x-zero",
        reason: "Cover.Place",
        note: "x_1 = 0 on the support",
        change: |leaf| leaf.reasons[1] = member(&[&[1], &[]]),
    },
    Forgery {
        name: "x-negative",
        reason: "Cover.Place",
        note: "x_1 < 0",
        change: |leaf| leaf.reasons[1] = member(&[&[1], &[-1]]),
    },
    Forgery {
        name: "cone-called-ray",
        reason: "Cover.Place",
        note: "a cone said to be one ray",
        change: |leaf| leaf.reasons[1] = only_member(&[&[1], &[1]], 0, vec![]),
    },
    Forgery {
        name: "pivot",
        reason: "Cover.Pivot",
        note: "a pivot that does not move",
        change: |leaf| leaf.reasons[1] = only_member(&[&[1], &[1]], 2, vec![]),
    },
];
