//! Walking a cover: what one region has computed must not serve another, pieces and tails end where
//! they say, a leaf that refers to a claim refers to the right one. Small covers by hand, each
//! beside its forgery.
//!
//! The pencils have two variables, so that solutions and the definiteness of every region are seen
//! by hand. A checker that carries a half, a bound or a claim from one region to another accepts
//! one of the forgeries.

use mceip_check::certificate::{
    Certificate, Claim, CompleteSet, Condensation, ExactSolution, Factor, Node, Piece, Root,
    RootOutcome, Tail,
};
use mceip_check::{AcceptedCover, CoverFault, Reason, check};
use mceip_exact::{Integer, Sparse, parse, whole};
use mceip_model::file::Number;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};

const I2: [[i64; 2]; 2] = [[1, 0], [0, 1]];

fn number(text: &str) -> Number {
    Number(parse(text).unwrap())
}

fn window(min: &str, max: Option<&str>) -> Window {
    let max = max.map(|text| number(text).0);
    Window::new(number(min).0, max).unwrap()
}

fn sparse(rows: [[i64; 2]; 2]) -> Sparse {
    let places = [(0, 0), (0, 1), (1, 0), (1, 1)];
    Sparse::from_entries(2, 2, places.map(|(i, j)| (i, j, whole(rows[i][j]))))
}

fn problem(a: [[i64; 2]; 2], b: [[i64; 2]; 2], free: &[usize], window: Window) -> Problem {
    let pencil = Pencil::new(sparse(a), sparse(b), free.to_vec()).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
}

fn piece(max: Option<&str>, tree: Vec<Node>) -> Piece {
    Piece {
        max: max.map(number),
        anchor: None,
        tree,
    }
}

/// A complete set of these pieces, without claims and without a condensation.
fn certificate(problem: &Problem, pieces: Vec<Piece>) -> Certificate {
    Certificate {
        problem_sha256: problem.sha256(),
        unknown: problem.unknown(),
        window: problem.window().clone(),
        claims: vec![],
        complete_set: Some(CompleteSet {
            condensation: None,
            pieces,
        }),
    }
}

fn verdict(problem: &Problem, certificate: &Certificate) -> Result<AcceptedCover, CoverFault> {
    match check(problem, certificate) {
        Ok(accepted) => Ok(accepted.cover.unwrap()),
        Err(rejected) => match rejected.reason {
            Reason::Cover { fault, .. } => Err(fault),
            other => panic!("{other}"),
        },
    }
}

/// T = [[1, 0], [0, 2 - t]] on [0, 4], cut at 1 where x_1 rests; the last leaf is that of x_1
/// moving.
fn cut_where_x_1_rests(last: Node) -> Result<AcceptedCover, CoverFault> {
    let window = window("0", Some("4"));
    let problem = problem([[1, 0], [0, 2]], [[0, 0], [0, -1]], &[], window);
    let tree = vec![
        Node::Branch(1),
        Node::Split(number("1")),
        Node::PositiveDefinite,
        Node::PositiveDefinite,
        last,
    ];
    let certificate = certificate(&problem, vec![piece(Some("4"), tree)]);
    verdict(&problem, &certificate)
}

/// T = [[1, 0], [0, 2 - t]] on [0, 4]: with x_1 at rest it is definite everywhere, with x_1 moving
/// only below 2. The cut is made where x_1 rests; were its lower half to stand for the whole
/// interval elsewhere, x_1 = 1 at t = 2 were lost.
#[test]
fn a_half_of_one_region_does_not_stand_for_another() {
    let open = cut_where_x_1_rests(Node::Open).unwrap();
    assert_eq!(open.open.len(), 1);

    let not_definite = CoverFault::NotDefinite {
        leaf: "positive_definite",
        index: 1,
        expected: "> 0",
        end: "upper",
    };
    assert_eq!(
        cut_where_x_1_rests(Node::PositiveDefinite),
        Err(not_definite)
    );

    // The row of the weight is divided by 4.
    let not_negative = CoverFault::NotNegative {
        index: 1,
        end: "upper",
        got: number("1/2").0,
    };
    assert_eq!(
        cut_where_x_1_rests(Node::Farkas(vec![0, -1])),
        Err(not_negative)
    );
}

/// A positive definite pencil, covered by pieces with these upper ends; `None` is infinity.
fn definite_pieces(window: &Window, ends: &[Option<&str>]) -> Result<AcceptedCover, CoverFault> {
    let problem = problem(I2, I2, &[], window.clone());
    let mut pieces = Vec::new();
    for end in ends {
        pieces.push(piece(*end, vec![Node::PositiveDefinite]));
    }
    verdict(&problem, &certificate(&problem, pieces))
}

fn piece_end(expected: &str, got: &str) -> Result<AcceptedCover, CoverFault> {
    Err(CoverFault::PieceEnd {
        expected: expected.into(),
        got: got.into(),
    })
}

#[test]
fn pieces_rise_to_the_end_of_the_window() {
    let above = "a value above 1 within the window";

    let infinite = window("1", None);
    let two = definite_pieces(&infinite, &[Some("2"), None]).unwrap();
    assert_eq!(two.leaves, 2);

    // Of no width, and not the last.
    let no_width = definite_pieces(&infinite, &[Some("1"), None]);
    assert_eq!(no_width, piece_end(above, "1"));
    let falling = definite_pieces(&infinite, &[Some("1/2"), None]);
    assert_eq!(falling, piece_end(above, "1/2"));
    let too_short = definite_pieces(&infinite, &[Some("2")]);
    assert_eq!(too_short, piece_end("infinity", "2"));
    let beyond_infinity = definite_pieces(&infinite, &[None, None]);
    assert_eq!(beyond_infinity, piece_end(above, "infinity"));

    let finite = window("1", Some("3"));
    assert!(definite_pieces(&finite, &[Some("3")]).is_ok());
    assert!(definite_pieces(&finite, &[Some("2"), Some("3")]).is_ok());

    for (first, got) in [(Some("3"), "3"), (Some("4"), "4"), (None, "infinity")] {
        let too_far = definite_pieces(&finite, &[first, Some("3")]);
        assert_eq!(too_far, piece_end(above, got));
    }

    // A window of one point is one piece.
    let point = window("1", Some("1"));
    let one = definite_pieces(&point, &[Some("1")]).unwrap();
    assert!(one.proves_absence());
    let two = definite_pieces(&point, &[Some("1"), Some("1")]);
    assert_eq!(two, piece_end(above, "1"));
}

/// A full factor, all entries of which are the same integer.
fn factor(entry: i64, order: usize) -> Factor {
    Factor {
        first: (0..order).collect(),
        rows: vec![vec![Integer::from(entry)].into(); order],
        exponent: 0,
    }
}

/// The tail of sym(A + B) = 5 I > 4 I.
fn tail_from_one() -> Tail {
    Tail {
        from: number("1"),
        factor: factor(2, 2),
        mass_factor: None,
    }
}

/// Variable 0 is free: A_ff = 4 = sigma. An open piece up to `from`, then a tail leaf.
fn tail_leaf(tail: Option<Tail>, from: &str) -> Result<AcceptedCover, CoverFault> {
    let problem = problem([[4, 0], [0, 4]], I2, &[0], window("0", None));
    let condensation = Condensation {
        sigma: number("4"),
        stiffness_factor: factor(0, 1),
        mass_sigma: number("0"),
        mass_factor: None,
        anchors: vec![],
        tail,
    };

    let below = piece(Some(from), vec![Node::Open]);
    let above = piece(None, vec![Node::Tail]);
    let mut certificate = certificate(&problem, vec![below, above]);
    let set = certificate.complete_set.as_mut().unwrap();
    set.condensation = Some(condensation);
    verdict(&problem, &certificate)
}

/// Variable 0 is free: A_ff = 4 = sigma. sym(A + B) = 5 I > 4 I: nothing lies above 1.
#[test]
fn a_tail_leaf_begins_at_the_tail_or_above() {
    for from in ["1", "2"] {
        let cover = tail_leaf(Some(tail_from_one()), from).unwrap();
        assert_eq!(cover.open.len(), 1);
    }

    let fault = CoverFault::Hypothesis {
        expected: "a tail that begins at or below the region",
        row: 0,
    };
    assert_eq!(tail_leaf(Some(tail_from_one()), "1/2"), Err(fault.clone()));
    assert_eq!(tail_leaf(None, "2"), Err(fault));
}

/// A claim of t = 1, which lies in the interval.
fn claim(support: &[usize], biactive: &[usize], interval: [&str; 2], x: [i64; 2]) -> ExactSolution {
    ExactSolution {
        support: support.to_vec(),
        biactive: biactive.to_vec(),
        polynomial: vec![(-1).into(), 1.into()],
        interval: interval.map(number),
        x: x.map(constant).to_vec(),
    }
}

/// The constant polynomial; zero has no coefficients.
fn constant(value: i64) -> Vec<Number> {
    if value == 0 {
        vec![]
    } else {
        vec![Number(whole(value))]
    }
}

/// An interval around t = 1 in which a leaf is unique.
const AROUND_ONE: [&str; 2] = ["15/16", "17/16"];
/// The claimed value as a point.
const ONE: [&str; 2] = ["1", "1"];

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

/// T = [[t - 1, 0], [c, t - 2]] on [7/8, 9/8], with a tree and a claim to which a leaf refers.
fn claimed(c: i64, claim: ExactSolution, tree: Vec<Node>) -> Result<AcceptedCover, CoverFault> {
    let window = window("7/8", Some("9/8"));
    let problem = problem([[-1, 0], [c, -2]], I2, &[], window);
    let mut certificate = certificate(&problem, vec![piece(Some("9/8"), tree)]);
    certificate.claims = vec![Claim::ExactSolution(claim)];
    verdict(&problem, &certificate)
}

/// The leaf of both variables moving alone.
fn both_moving(c: i64, claim: ExactSolution, leaf: Node) -> Result<AcceptedCover, CoverFault> {
    let tree = vec![
        Node::Branch(0),
        Node::Open,
        Node::Branch(1),
        Node::Open,
        leaf,
    ];
    claimed(c, claim, tree)
}

/// x = (1, 0) at t = 1 is a null vector of both rows if y_1 = c is zero, which a claim says by its
/// biactive set.
#[test]
fn a_claim_leaf_refers_to_a_null_vector_of_its_block() {
    let biactive = claim(&[0], &[1], ONE, [1, 0]);
    let cover = both_moving(0, biactive, leaf(AROUND_ONE, 0, 0)).unwrap();
    assert_eq!(cover.solutions, []);

    // y_1 = 1 > 0: it solves, and is no null vector of both rows. That is (1, 1), of the other
    // support.
    let first_alone = claim(&[0], &[], ONE, [1, 0]);
    assert_eq!(
        both_moving(1, first_alone, leaf(AROUND_ONE, 1, 0)),
        Err(CoverFault::NotTheClaim { claim: 0 })
    );

    let both = claim(&[0, 1], &[], ONE, [1, 1]);
    let cover = both_moving(1, both, leaf(AROUND_ONE, 1, 0)).unwrap();
    assert_eq!(cover.solutions.len(), 1);
    assert_eq!(cover.solutions[0].support, [0, 1]);
}

/// The claimed value lies within the leaf's interval, ends included.
#[test]
fn the_value_of_a_claim_lies_in_the_interval_of_its_leaf() {
    let value = ["31/32", "33/32"];

    for interval in [AROUND_ONE, value] {
        let both = claim(&[0, 1], &[], value, [1, 1]);
        assert!(both_moving(1, both, leaf(interval, 1, 0)).is_ok());
    }

    let elsewhere = [
        ["63/64", "17/16"],
        ["15/16", "65/64"],
        ["17/16", "9/8"],
        ["7/8", "15/16"],
    ];

    for interval in elsewhere {
        let both = claim(&[0, 1], &[], value, [1, 1]);
        assert_eq!(
            both_moving(1, both, leaf(interval, 1, 0)),
            Err(CoverFault::NotTheClaim { claim: 0 })
        );
    }
}

/// The leaf in which only variable 0 moves, with claim 0.
fn first_moving(claim: ExactSolution) -> Result<AcceptedCover, CoverFault> {
    let alone = Root {
        pivot: 0,
        interval: AROUND_ONE.map(number),
        inverse: vec![],
        inverse_exponent: 0,
        left: vec![],
        right: vec![],
        exponent: 0,
        outcome: RootOutcome::Claim(0),
    };
    let tree = vec![
        Node::Branch(0),
        Node::Open,
        Node::Branch(1),
        Node::Root(Box::new(alone)),
        Node::Open,
    ];
    claimed(1, claim, tree)
}

/// A claim that moves more than the leaf does is not its null vector.
#[test]
fn a_claim_moves_nothing_that_rests_in_its_leaf() {
    let cover = first_moving(claim(&[0], &[], ONE, [1, 0])).unwrap();
    assert_eq!(cover.solutions.len(), 1);

    let moves_both = first_moving(claim(&[0, 1], &[], ONE, [1, 1]));
    assert_eq!(moves_both, Err(CoverFault::NotTheClaim { claim: 0 }));
}
