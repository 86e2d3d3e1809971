//! Walking a cover: what one region has computed must not serve another, pieces and tails end where
//! they say, a leaf that refers to a claim refers to the right one. Small covers by hand, each
//! beside its forgery.

use mceip_check::certificate::{
    Certificate, Claim, CompleteSet, Condensation, ExactSolution, Factor, Node, Piece, Root,
    RootOutcome, Tail,
};
use mceip_check::{AcceptedCover, CoverFault, Reason, check};
use mceip_exact::{Integer, Sparse, parse, whole};
use mceip_model::file::Number;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};

fn number(v: &str) -> Number {
    Number(parse(v).unwrap())
}

fn window(min: &str, max: Option<&str>) -> Window {
    Window::new(number(min).0, max.map(|v| number(v).0)).unwrap()
}

fn problem(a: [[i64; 2]; 2], b: [[i64; 2]; 2], free: &[usize], window: Window) -> Problem {
    let sparse = |m: [[i64; 2]; 2]| {
        Sparse::from_entries(
            2,
            2,
            [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| (i, j, whole(m[i][j]))),
        )
    };
    let pencil = Pencil::new(sparse(a), sparse(b), free.to_vec()).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
}

const I2: [[i64; 2]; 2] = [[1, 0], [0, 1]];

fn piece(max: Option<&str>, tree: Vec<Node>) -> Piece {
    Piece {
        max: max.map(number),
        anchor: None,
        tree,
    }
}

fn verdict(
    p: &Problem,
    claims: &[ExactSolution],
    condensation: Option<Condensation>,
    pieces: Vec<Piece>,
) -> Result<AcceptedCover, CoverFault> {
    let c = Certificate {
        problem_sha256: p.sha256(),
        unknown: p.unknown(),
        window: p.window().clone(),
        claims: claims.iter().cloned().map(Claim::ExactSolution).collect(),
        complete_set: Some(CompleteSet {
            condensation,
            pieces,
        }),
    };
    match check(p, &c) {
        Ok(accepted) => Ok(accepted.cover.unwrap()),
        Err(rejected) => match rejected.reason {
            Reason::Cover { fault, .. } => Err(fault),
            other => panic!("{other}"),
        },
    }
}

fn split(v: &str) -> Node {
    Node::Split(number(v))
}

/// T = [[1, 0], [0, 2 - t]] on [0, 4]: with x_1 at rest it is definite everywhere, with x_1 moving
/// only below 2. The cut is made where x_1 rests; were its lower half to stand for the whole
/// interval elsewhere, x_1 = 1 at t = 2 were lost.
#[test]
fn a_half_of_one_region_does_not_stand_for_another() {
    let p = problem(
        [[1, 0], [0, 2]],
        [[0, 0], [0, -1]],
        &[],
        window("0", Some("4")),
    );
    let tree = |last: Node| {
        vec![piece(
            Some("4"),
            vec![
                Node::Branch(1),
                split("1"),
                Node::PositiveDefinite,
                Node::PositiveDefinite,
                last,
            ],
        )]
    };
    assert_eq!(
        verdict(&p, &[], None, tree(Node::Open)).unwrap().open.len(),
        1
    );
    assert_eq!(
        verdict(&p, &[], None, tree(Node::PositiveDefinite)),
        Err(CoverFault::NotDefinite {
            index: 1,
            end: "upper"
        })
    );
    let farkas = Node::Farkas(vec![0, -1]); // its row is divided by 4
    assert_eq!(
        verdict(&p, &[], None, tree(farkas)),
        Err(CoverFault::NotNegative {
            index: 1,
            end: "upper",
            got: number("1/2").0
        })
    );
}

#[test]
fn pieces_rise_to_the_end_of_the_window() {
    let definite = |max: Option<&str>| piece(max, vec![Node::PositiveDefinite]);
    let infinite = problem(I2, I2, &[], window("1", None));
    let of = |p: &Problem, pieces: &[Option<&str>]| {
        verdict(p, &[], None, pieces.iter().map(|m| definite(*m)).collect())
    };
    assert_eq!(of(&infinite, &[Some("2"), None]).unwrap().leaves, 2);
    let fault = |expected: &str, got: &str| {
        Err(CoverFault::PieceEnd {
            expected: expected.into(),
            got: got.into(),
        })
    };
    let above = "a value above 1 within the window";
    // Of no width, and not the last.
    assert_eq!(of(&infinite, &[Some("1"), None]), fault(above, "1"));
    assert_eq!(of(&infinite, &[Some("1/2"), None]), fault(above, "1/2"));
    assert_eq!(of(&infinite, &[Some("2")]), fault("infinity", "2"));
    assert_eq!(of(&infinite, &[None, None]), fault(above, "infinity"));
    let finite = problem(I2, I2, &[], window("1", Some("3")));
    assert!(of(&finite, &[Some("3")]).is_ok() && of(&finite, &[Some("2"), Some("3")]).is_ok());
    for (first, got) in [(Some("3"), "3"), (Some("4"), "4"), (None, "infinity")] {
        assert_eq!(of(&finite, &[first, Some("3")]), fault(above, got));
    }
    // A window of one point is one piece.
    let point = problem(I2, I2, &[], window("1", Some("1")));
    assert!(of(&point, &[Some("1")]).unwrap().proves_absence());
    assert_eq!(of(&point, &[Some("1"), Some("1")]), fault(above, "1"));
}

/// Variable 0 is free: A_ff = 4 = sigma. sym(A + B) = 5 I > 4 I: nothing lies above 1.
#[test]
fn a_tail_leaf_begins_at_the_tail_or_above() {
    let p = problem([[4, 0], [0, 4]], I2, &[0], window("0", None));
    let factor = |entry: i64, n: usize| Factor {
        first: (0..n).collect(),
        rows: vec![vec![Integer::from(entry)]; n],
        exponent: 0,
    };
    let of = |has_tail: bool, from: &str| {
        let condensation = Condensation {
            sigma: number("4"),
            stiffness_factor: factor(0, 1),
            mass_sigma: number("0"),
            mass_factor: None,
            anchors: vec![],
            tail: has_tail.then(|| Tail {
                from: number("1"),
                factor: factor(2, 2),
                mass_factor: None,
            }),
        };
        verdict(
            &p,
            &[],
            Some(condensation),
            vec![
                piece(Some(from), vec![Node::Open]),
                piece(None, vec![Node::Tail]),
            ],
        )
    };
    for from in ["1", "2"] {
        assert_eq!(of(true, from).unwrap().open.len(), 1);
    }
    let fault = Err(CoverFault::Hypothesis {
        expected: "a tail that begins at or below the region",
        row: 0,
    });
    assert_eq!([of(true, "1/2"), of(false, "2")], [fault.clone(), fault]);
}

fn claim(
    support: &[usize],
    biactive: &[usize],
    interval: [&str; 2],
    x: [&str; 2],
) -> ExactSolution {
    ExactSolution {
        support: support.to_vec(),
        biactive: biactive.to_vec(),
        polynomial: vec![(-1).into(), 1.into()],
        interval: interval.map(number),
        x: x.iter()
            .map(|v| if *v == "0" { vec![] } else { vec![number(v)] })
            .collect(),
    }
}

/// A leaf that refers to claim 0, for both variables moving; `right` and `left` are the other
/// component of the null vectors.
fn leaf(interval: [&str; 2], right: i64, left: i64) -> Node {
    Node::Root(Box::new(Root {
        pivot: 0,
        interval: interval.map(number),
        inverse: vec![vec![(-1).into()]],
        inverse_exponent: 0,
        left: vec![left.into()],
        right: vec![right.into()],
        exponent: 0,
        outcome: RootOutcome::Claim(0),
    }))
}

/// [[t - 1, 0], [c, t - 2]] on [7/8, 9/8], the leaf of both variables moving alone.
fn both_moving(c: i64, claims: &[ExactSolution], leaf: Node) -> Result<AcceptedCover, CoverFault> {
    let p = problem([[-1, 0], [c, -2]], I2, &[], window("7/8", Some("9/8")));
    let tree = vec![
        Node::Branch(0),
        Node::Open,
        Node::Branch(1),
        Node::Open,
        leaf,
    ];
    verdict(&p, claims, None, vec![piece(Some("9/8"), tree)])
}

/// x = (1, 0) at t = 1 is a null vector of both rows if y_1 = c is zero, which a claim says by its
/// biactive set.
#[test]
fn a_claim_leaf_refers_to_a_null_vector_of_its_block() {
    let around = ["15/16", "17/16"];
    let biactive = claim(&[0], &[1], ["1", "1"], ["1", "0"]);
    assert_eq!(
        both_moving(0, &[biactive], leaf(around, 0, 0))
            .unwrap()
            .solutions,
        []
    );
    // y_1 = 1 > 0: it solves, and is no null vector of both rows. That is (1, 1), of the other
    // support.
    let not = Err(CoverFault::NotTheClaim { claim: 0 });
    assert_eq!(
        both_moving(
            1,
            &[claim(&[0], &[], ["1", "1"], ["1", "0"])],
            leaf(around, 1, 0)
        ),
        not
    );
    let both = both_moving(
        1,
        &[claim(&[0, 1], &[], ["1", "1"], ["1", "1"])],
        leaf(around, 1, 0),
    )
    .unwrap();
    assert_eq!(
        both.solutions
            .iter()
            .map(|s| &s.support)
            .collect::<Vec<_>>(),
        [&vec![0, 1]]
    );
}

/// The claimed value lies within the leaf's interval, ends included.
#[test]
fn the_value_of_a_claim_lies_in_the_interval_of_its_leaf() {
    let of = |value: [&str; 2], interval: [&str; 2]| {
        both_moving(
            1,
            &[claim(&[0, 1], &[], value, ["1", "1"])],
            leaf(interval, 1, 0),
        )
        .map(|_| ())
    };
    let not = Err(CoverFault::NotTheClaim { claim: 0 });
    for interval in [["15/16", "17/16"], ["31/32", "33/32"]] {
        assert_eq!(of(["31/32", "33/32"], interval), Ok(()));
    }
    for interval in [
        ["63/64", "17/16"],
        ["15/16", "65/64"],
        ["17/16", "9/8"],
        ["7/8", "15/16"],
    ] {
        assert_eq!(of(["31/32", "33/32"], interval), not);
    }
}

/// A claim that moves more than the leaf does is not its null vector.
#[test]
fn a_claim_moves_nothing_that_rests_in_its_leaf() {
    let p = problem([[-1, 0], [1, -2]], I2, &[], window("7/8", Some("9/8")));
    let mut alone = leaf(["15/16", "17/16"], 0, 0);
    if let Node::Root(root) = &mut alone {
        (root.inverse, root.left, root.right) = (vec![], vec![], vec![]);
    }
    let tree = |leaf: Node| {
        vec![piece(
            Some("9/8"),
            vec![
                Node::Branch(0),
                Node::Open,
                Node::Branch(1),
                leaf,
                Node::Open,
            ],
        )]
    };
    let of = |c: ExactSolution| {
        verdict(&p, &[c], None, tree(alone.clone())).map(|cover| cover.solutions.len())
    };
    assert_eq!(of(claim(&[0], &[], ["1", "1"], ["1", "0"])), Ok(1));
    assert_eq!(
        of(claim(&[0, 1], &[], ["1", "1"], ["1", "1"])),
        Err(CoverFault::NotTheClaim { claim: 0 })
    );
}
