//! Forged covers: each falsehood is rejected for its own reason. (Random mutations:
//! `complete_mutants.rs`.)
//!
//! The covers are those that `complete` writes for generated problems, so that the forgeries meet
//! the trees of the program and not only those made by hand for `spec/corpus`. Where a forgery may
//! be true by luck, an acceptance is compared with the exact enumerator.
#![cfg(feature = "testkit")]

use crate::cover::{
    NodePlace, condensed, disagreements, fold, node_at, plain, proved, set, trees, truth,
};
use mceip_check::certificate::{Certificate, Condensation, Node, Root, RootOutcome};
use mceip_check::{CoverFault, Reason, Rejected, audit, check};
use mceip_exact::{Integer, Rational, rational, whole};
use mceip_model::file::Number;
use mceip_model::reduction::reduce;
use mceip_model::{Problem, Unknown, Window};
use mceip_oracle::Enumeration;
use mceip_testkit::{degenerate, known, mechanical_pencil};

/// The first node that fits, and where it is.
#[track_caller]
fn first(certificate: &Certificate, fits: fn(&Node) -> bool) -> (NodePlace, Node) {
    for (place, node) in trees(certificate) {
        if fits(node) {
            return (place, node.clone());
        }
    }
    panic!("the certificate has no such node")
}

fn is_solution_leaf(node: &Node) -> bool {
    matches!(node, Node::Root(root) if root.outcome == RootOutcome::Solution)
}

fn is_branch(node: &Node) -> bool {
    matches!(node, Node::Branch(_))
}

fn is_farkas(node: &Node) -> bool {
    matches!(node, Node::Farkas(_))
}

/// The fault for which the checker rejects a changed copy.
#[track_caller]
fn fault_of(
    problem: &Problem,
    good: &Certificate,
    change: impl FnOnce(&mut Certificate),
) -> CoverFault {
    let mut forged = good.clone();
    change(&mut forged);

    match check(problem, &forged) {
        Err(Rejected {
            reason: Reason::Cover { fault, .. },
            ..
        }) => fault,
        verdict => panic!("{verdict:?}"),
    }
}

/// The tree of a piece.
fn tree(certificate: &mut Certificate, piece: usize) -> &mut Vec<Node> {
    &mut set(certificate).pieces[piece].tree
}

#[track_caller]
fn assert_true(problem: &Problem, accepted: mceip_check::Accepted, truth: &Enumeration) {
    let wrong = disagreements(&accepted.cover.unwrap(), truth);
    assert_eq!(wrong, Vec::<String>::new(), "{}", problem.canonical_text());
}

#[test]
fn another_problem_or_unknown_is_named() {
    let (problem, certificate) = plain();

    let other = mechanical_pencil(6, Unknown::Mu, 5).unwrap();
    let reason = check(&other, &certificate).unwrap_err().reason;
    assert!(matches!(reason, Reason::Digest { .. }), "{reason}");

    let other_unknown = Certificate {
        unknown: Unknown::Lambda2,
        ..certificate
    };
    let reason = check(&problem, &other_unknown).unwrap_err().reason;
    assert!(matches!(reason, Reason::Unknown { .. }), "{reason}");
}

#[test]
fn trees_that_do_not_cover_are_rejected() {
    let (problem, certificate) = plain();

    let pieces = certificate.complete_set.as_ref().unwrap().pieces.len();
    for piece in 0..pieces {
        let fault = fault_of(&problem, &certificate, |forged| {
            tree(forged, piece).pop();
        });
        assert_eq!(fault, CoverFault::Truncated { regions: 1 });

        let fault = fault_of(&problem, &certificate, |forged| {
            tree(forged, piece).push(Node::Open);
        });
        assert_eq!(fault, CoverFault::Trailing);

        let fault = fault_of(&problem, &certificate, |forged| {
            tree(forged, piece).clear();
        });
        assert!(matches!(fault, CoverFault::Truncated { .. }), "{fault:?}");
    }

    pieces_that_do_not_cover(&problem, &certificate);
    cuts_outside(&problem, &certificate);
    branches_that_are_none(&problem, &certificate);
}

/// Pieces: the last missing, in the wrong order, standing still, none at all.
fn pieces_that_do_not_cover(problem: &Problem, certificate: &Certificate) {
    let changes: [fn(&mut Certificate); 4] = [
        |forged| {
            set(forged).pieces.pop();
        },
        |forged| set(forged).pieces.swap(0, 1),
        |forged| set(forged).pieces[1].max = set(forged).pieces[0].max.clone(),
        |forged| set(forged).pieces.clear(),
    ];

    for change in changes {
        let fault = fault_of(problem, certificate, change);
        assert!(matches!(fault, CoverFault::PieceEnd { .. }), "{fault:?}");
    }
}

/// A cut at an end of its interval or outside leaves a hole or a half that is none.
fn cuts_outside(problem: &Problem, certificate: &Certificate) {
    let (place, _) = first(certificate, |node| matches!(node, Node::Split(_)));
    let pieces = &certificate.complete_set.as_ref().unwrap().pieces;
    let has_upper_end = pieces[place.piece].max.is_some();

    let mut outside = vec![whole(0), whole(-1)];
    if has_upper_end {
        outside.push(whole(1_000_000_000));
    }

    for value in outside {
        let fault = fault_of(problem, certificate, |forged| {
            *node_at(forged, place) = Node::Split(Number(value));
        });
        assert!(matches!(fault, CoverFault::Cut { .. }), "{fault:?}");
    }
}

/// A variable decided twice, and one that is none.
fn branches_that_are_none(problem: &Problem, certificate: &Certificate) {
    let (place, branch) = first(certificate, is_branch);

    let fault = fault_of(problem, certificate, |forged| {
        tree(forged, place.piece).insert(place.node, branch);
    });
    assert!(matches!(fault, CoverFault::Branch { .. }), "{fault:?}");

    let fault = fault_of(problem, certificate, |forged| {
        *node_at(forged, place) = Node::Branch(6);
    });
    assert!(
        matches!(fault, CoverFault::Branch { index: 6 }),
        "{fault:?}"
    );
}

/// What an audit opens is what `check` refuses one by one, and it opens nothing else.
#[test]
fn an_audit_opens_exactly_the_leaves_that_fail() {
    let (problem, certificate) = plain();
    let nothing_refused = check(&problem, &certificate).map(|accepted| (accepted, Vec::new()));
    assert_eq!(audit(&problem, &certificate), nothing_refused);

    // Every third Farkas leaf without weights.
    let leaves = trees(&certificate);
    let farkas = leaves.iter().filter(|(_, node)| is_farkas(node));
    let forged_places: Vec<NodePlace> = farkas.map(|(place, _)| *place).step_by(3).collect();
    assert!(forged_places.len() > 1);

    let mut forged = certificate.clone();
    for &place in &forged_places {
        *node_at(&mut forged, place) = Node::Farkas(vec![0; 6]);
    }

    let (accepted, refused) = audit(&problem, &forged).unwrap();
    let expected: Vec<(usize, usize)> = forged_places
        .iter()
        .map(|place| (place.piece, place.node))
        .collect();
    assert_eq!(refused, expected);

    // The same leaves called open.
    for &place in &forged_places {
        *node_at(&mut forged, place) = Node::Open;
    }

    assert_eq!(accepted, check(&problem, &forged).unwrap());
    assert_eq!(accepted.cover.unwrap().open.len(), forged_places.len());

    // A hole in the tree is not mended.
    tree(&mut forged, 0).pop();
    assert!(audit(&problem, &forged).is_err());
}

#[test]
fn an_enlarged_window_is_not_covered() {
    let all = mechanical_pencil(6, Unknown::Mu, 4).unwrap();
    let own_window = Window::new(rational(1, 2), Some(whole(3))).unwrap();
    let problem = all.clone().with_window(own_window);
    let certificate = proved(&problem);

    for max in [None, Some(whole(4)), Some(whole(2))] {
        let window = Window::new(rational(1, 2), max).unwrap();
        let fault = fault_of(&problem, &certificate, |forged| forged.window = window);
        assert!(matches!(fault, CoverFault::PieceEnd { .. }), "{fault:?}");
    }

    // Downwards the first piece grows: its reasons hold there or not, and it is said which window
    // is proved.
    let below = Certificate {
        window: Window::new(whole(0), Some(whole(3))).unwrap(),
        ..certificate
    };
    let wide = all.with_window(below.window.clone());
    if let Ok(accepted) = check(&wide, &below) {
        assert_true(&wide, accepted, &truth(&wide));
    }
}

#[test]
fn false_farkas_and_definite_leaves_are_rejected() {
    let (problem, certificate) = plain();
    false_weights(&problem, &certificate);
    negative_weights(&problem, &certificate);

    let definite = definite_leaves_turned(&problem, &certificate);
    let moved = exchange_weights(&problem, &certificate);
    assert!(definite > 0, "{definite} definite");
    assert!(
        moved.count > 4 && moved.refused > moved.count / 2,
        "{} of {} refused",
        moved.refused,
        moved.count
    );
}

fn false_weights(problem: &Problem, certificate: &Certificate) {
    let (place, leaf) = first(certificate, is_farkas);
    let Node::Farkas(weights) = leaf else {
        unreachable!()
    };

    let fault = fault_of(problem, certificate, |forged| {
        *node_at(forged, place) = Node::Farkas(weights[1..].to_vec());
    });
    let is_short = matches!(
        fault,
        CoverFault::Length {
            expected: 6,
            got: 5,
            ..
        }
    );
    assert!(is_short, "{fault:?}");

    let fault = fault_of(problem, certificate, |forged| {
        *node_at(forged, place) = Node::Farkas(vec![0; 6]);
    });
    assert!(matches!(fault, CoverFault::NotStrict), "{fault:?}");
}

/// At the root of a tree nothing is known to move: every negative weight is off the moving set.
fn negative_weights(problem: &Problem, certificate: &Certificate) {
    let (place, _) = first(certificate, is_branch);

    let fault = fault_of(problem, certificate, |forged| {
        *tree(forged, place.piece) = vec![Node::Farkas(vec![1, 1, -1, 1, 1, 1])];
    });
    assert_eq!(fault, CoverFault::NegativeWeight { index: 2, got: -1 });

    let fault = fault_of(problem, certificate, |forged| {
        *tree(forged, place.piece) = vec![Node::Farkas(vec![1; 6])];
    });
    assert!(matches!(fault, CoverFault::NotNegative { .. }), "{fault:?}");
}

/// Calls each positive definite leaf negative definite and the other way round. How many there are.
fn definite_leaves_turned(problem: &Problem, certificate: &Certificate) -> usize {
    let mut count = 0;
    for (place, node) in trees(certificate) {
        let turned = match node {
            Node::PositiveDefinite => Node::NegativeDefinite,
            Node::NegativeDefinite => Node::PositiveDefinite,
            _ => continue,
        };
        let fault = fault_of(problem, certificate, |forged| {
            *node_at(forged, place) = turned;
        });
        assert!(matches!(fault, CoverFault::NotDefinite { .. }), "{fault:?}");
        count += 1;
    }
    count
}

/// How many leaves were exchanged, and how many of these forgeries were refused.
#[derive(Default)]
struct Exchanged {
    count: usize,
    refused: usize,
}

/// A reason from another leaf: refused, or by luck a reason here too.
fn exchange_weights(problem: &Problem, certificate: &Certificate) -> Exchanged {
    let truth = truth(problem);
    let mut leaves = trees(certificate);
    leaves.retain(|(_, node)| is_farkas(node));

    let mut exchanged = Exchanged::default();
    for (&(place, own), (_, other)) in leaves.iter().zip(leaves.iter().rev()) {
        if own == *other {
            continue;
        }
        let mut forged = certificate.clone();
        *node_at(&mut forged, place) = (*other).clone();

        exchanged.count += 1;
        match check(problem, &forged) {
            Ok(accepted) => assert_true(problem, accepted, &truth),
            Err(rejected) => {
                assert_false_weights(&rejected.reason, place);
                exchanged.refused += 1;
            }
        }
    }
    exchanged
}

/// The weights at this place are the fault.
fn assert_false_weights(reason: &Reason, place: NodePlace) {
    let Reason::Cover { piece, node, fault } = reason else {
        panic!("{reason}")
    };
    assert_eq!(*piece, Some(place.piece));
    assert_eq!(*node, Some(place.node));

    let is_of_weights = matches!(
        fault,
        CoverFault::NotNegative { .. } | CoverFault::NegativeWeight { .. }
    );
    assert!(is_of_weights, "{fault:?}");
}

/// A certificate and one of its leaves that lists a solution.
struct Listed {
    problem: Problem,
    certificate: Certificate,
    place: NodePlace,
    root: Root,
}

impl Listed {
    fn plain() -> Self {
        let (problem, certificate) = plain();
        let (place, leaf) = first(&certificate, is_solution_leaf);
        let Node::Root(root) = leaf else {
            unreachable!()
        };

        Listed {
            problem,
            certificate,
            place,
            root: *root,
        }
    }

    /// The fault for which the checker rejects a change of the leaf.
    #[track_caller]
    fn fault_of(&self, change: impl FnOnce(&mut Root)) -> CoverFault {
        let mut root = self.root.clone();
        change(&mut root);
        fault_of(&self.problem, &self.certificate, |forged| {
            *node_at(forged, self.place) = Node::Root(Box::new(root));
        })
    }
}

#[test]
fn false_root_leaves_are_rejected() {
    let listed = Listed::plain();
    false_outcomes(&listed);
    false_intervals(&listed);
    false_witnesses(&listed);
    leaves_at_the_root_of_a_tree(&listed);
    no_solutions_called_solutions(&listed);
}

fn false_outcomes(listed: &Listed) {
    let fault = listed.fault_of(|root| root.outcome = RootOutcome::Absent);
    assert!(matches!(fault, CoverFault::SignChange), "{fault:?}");

    // Every x of a solution is positive and every y not negative.
    for i in 0..6 {
        let fault = listed.fault_of(|root| root.outcome = RootOutcome::NegativeX(i));
        assert!(matches!(fault, CoverFault::Sign { .. }), "{fault:?}");

        let fault = listed.fault_of(|root| root.outcome = RootOutcome::NegativeY(i));
        assert!(matches!(fault, CoverFault::Sign { .. }), "{fault:?}");
    }

    let fault = listed.fault_of(|root| root.outcome = RootOutcome::Claim(0));
    assert_eq!(fault, CoverFault::NotTheClaim { claim: 0 });
}

/// An interval beside the value, of no width, reversed, outside the window.
fn false_intervals(listed: &Listed) {
    let [a, b] = listed.root.interval.clone().map(|end| end.0);
    let width: Rational = &b - &a;
    let beside = [&b + &width, &b + &width * whole(2)].map(Number);
    let fault = listed.fault_of(|root| root.interval = beside);
    assert!(
        matches!(fault, CoverFault::NoSignChange { .. }),
        "{fault:?}"
    );

    let changes: [fn(&mut Root); 3] = [
        |root| root.interval[1] = root.interval[0].clone(),
        |root| root.interval.reverse(),
        |root| root.interval[0] = Number(whole(-1)),
    ];

    for change in changes {
        let fault = listed.fault_of(change);
        assert!(matches!(fault, CoverFault::Interval { .. }), "{fault:?}");
    }
}

fn false_witnesses(listed: &Listed) {
    let fault = listed.fault_of(|root| root.pivot = 6);
    assert_eq!(fault, CoverFault::Pivot { index: 6 });

    let moves_alone = listed.root.right.is_empty();
    if moves_alone {
        return;
    }

    let fault = listed.fault_of(|root| {
        root.right.pop();
    });
    assert!(matches!(fault, CoverFault::Length { .. }), "{fault:?}");

    let fault = listed.fault_of(|root| {
        for entry in root.inverse.iter_mut().flatten() {
            *entry = Integer::from(0);
        }
    });
    assert!(matches!(fault, CoverFault::NotRegular { .. }), "{fault:?}");

    let fault = listed.fault_of(|root| {
        for component in &mut root.right {
            *component = -component.clone() * 8;
        }
    });
    let is_of_signs = matches!(
        fault,
        CoverFault::NotMonotone | CoverFault::NoSignChange { .. } | CoverFault::Sign { .. }
    );
    assert!(is_of_signs, "{fault:?}");
}

/// Where indices are open, and where there is no condensation's tail.
fn leaves_at_the_root_of_a_tree(listed: &Listed) {
    let root = Node::Root(Box::new(listed.root.clone()));
    let fault = fault_of(&listed.problem, &listed.certificate, |forged| {
        *tree(forged, 0) = vec![root];
    });
    assert!(matches!(fault, CoverFault::RootTooEarly), "{fault:?}");

    let fault = fault_of(&listed.problem, &listed.certificate, |forged| {
        *tree(forged, 0) = vec![Node::Tail];
    });
    assert!(matches!(fault, CoverFault::Hypothesis { .. }), "{fault:?}");
}

/// What is no solution is not made one.
fn no_solutions_called_solutions(listed: &Listed) {
    for (place, node) in trees(&listed.certificate) {
        let Node::Root(root) = node else { continue };
        let is_none = matches!(
            root.outcome,
            RootOutcome::NegativeX(_) | RootOutcome::NegativeY(_) | RootOutcome::Absent
        );
        if !is_none {
            continue;
        }

        let mut called_solution = root.clone();
        called_solution.outcome = RootOutcome::Solution;
        let fault = fault_of(&listed.problem, &listed.certificate, |forged| {
            *node_at(forged, place) = Node::Root(called_solution);
        });
        let is_expected = matches!(
            fault,
            CoverFault::Sign { .. } | CoverFault::NoSignChange { .. } | CoverFault::Interval { .. }
        );
        assert!(is_expected, "{fault:?}");
    }
}

/// Support {0, 1} has lambda^2 = 2 and 3: a leaf over both with the witness of one.
#[test]
fn a_root_leaf_that_hides_a_second_solution_is_rejected() {
    let window = Window::new(rational(3, 2), Some(rational(7, 2))).unwrap();
    let problem = fold(window);
    let certificate = proved(&problem);
    let (_, root) = first(&certificate, is_solution_leaf);

    // The tree itself is right: with the leaf left open it is accepted.
    let mut open = certificate.clone();
    make_one_piece(&mut open, Node::Open);
    let cover = check(&problem, &open).unwrap().cover.unwrap();
    assert_eq!(cover.open.len(), 1);
    assert_eq!(cover.open[0].moving, [0, 1]);

    let fault = fault_of(&problem, &certificate, |forged| {
        make_one_piece(forged, root);
    });
    let is_expected = matches!(
        fault,
        CoverFault::NotMonotone | CoverFault::NotRegular { .. }
    );
    assert!(is_expected, "{fault:?}");
}

/// One piece over [3/2, 7/2], in which {0, 1} has the given leaf.
fn make_one_piece(certificate: &mut Certificate, leaf: Node) {
    let pieces = &mut set(certificate).pieces;
    pieces.truncate(1);
    pieces[0].max = Some(Number(rational(7, 2)));
    pieces[0].tree = vec![
        Node::Branch(0),
        Node::Branch(1),
        Node::PositiveDefinite,
        Node::NegativeDefinite,
        Node::Branch(1),
        Node::PositiveDefinite,
        leaf,
    ];
}

#[test]
fn the_claim_of_another_solution_is_rejected() {
    let mut refused = 0;
    for problem in problems_with_claims() {
        let certificate = proved(&problem);
        for (place, node) in trees(&certificate) {
            let Node::Root(root) = node else { continue };
            let RootOutcome::Claim(own) = root.outcome else {
                continue;
            };

            for other in other_claims(&certificate, own) {
                let mut forged_root = root.clone();
                forged_root.outcome = RootOutcome::Claim(other);
                let mut forged = certificate.clone();
                *node_at(&mut forged, place) = Node::Root(forged_root);
                refused += usize::from(is_refused_for_claim(&problem, &forged, other));
            }
        }
    }

    assert!(refused > 2, "{refused}");
}

/// Degenerate pencils and known ones, without free variables.
fn problems_with_claims() -> Vec<Problem> {
    let instances = degenerate().unwrap();
    let mut problems: Vec<Problem> = instances.into_iter().map(|i| i.problem).collect();
    for n in 2..=4 {
        let known = [known::path(n), known::star(n), known::jordan(n, 2, true)];
        let solved = known.into_iter().filter_map(Result::ok);
        problems.extend(solved.map(|answer| answer.problem));
    }

    problems.retain(|problem| reduce(problem).unwrap().pencil.free().is_empty());
    problems
}

/// The claims of a certificate that say something else than this one, and the first number that is
/// no claim.
fn other_claims(certificate: &Certificate, own: usize) -> Vec<usize> {
    let claims = &certificate.claims;
    let mut others: Vec<usize> = (0..claims.len())
        .filter(|&claim| claims[claim] != claims[own])
        .collect();
    others.push(claims.len());
    others
}

/// A solution with another support may have a null vector of this leaf too: then the forgery is
/// accepted, and nothing is lost.
fn is_refused_for_claim(problem: &Problem, forged: &Certificate, claim: usize) -> bool {
    match check(problem, forged) {
        Ok(accepted) => {
            assert_true(problem, accepted, &truth(problem));
            false
        }
        Err(rejected) => {
            let Reason::Cover { fault, .. } = rejected.reason else {
                panic!("{}", rejected.reason)
            };
            assert_eq!(fault, CoverFault::NotTheClaim { claim });
            true
        }
    }
}

fn condensation(certificate: &mut Certificate) -> &mut Condensation {
    set(certificate).condensation.as_mut().unwrap()
}

#[test]
fn a_false_condensation_is_rejected() {
    let (problem, certificate) = condensed();
    false_hypotheses(&problem, &certificate);
    false_anchors(&problem, &certificate);

    let fault = fault_of(&problem, &certificate, |forged| {
        set(forged).condensation = None;
    });
    let is_missing = matches!(fault, CoverFault::Condensation { expected: true });
    assert!(is_missing, "{fault:?}");

    // Where nothing is free there is nothing to condense.
    let (plain, own) = plain();
    let foreign = certificate.complete_set.unwrap().condensation;
    let fault = fault_of(&plain, &own, |forged| set(forged).condensation = foreign);
    let is_idle = matches!(fault, CoverFault::Condensation { expected: false });
    assert!(is_idle, "{fault:?}");
}

fn false_hypotheses(problem: &Problem, certificate: &Certificate) {
    for sigma in [whole(0), whole(-1), whole(1_000_000)] {
        let fault = fault_of(problem, certificate, |forged| {
            condensation(forged).sigma = Number(sigma);
        });
        assert!(matches!(fault, CoverFault::Hypothesis { .. }), "{fault:?}");
    }

    let fault = fault_of(problem, certificate, |forged| {
        condensation(forged).stiffness_factor.rows[0].edit(|row| row[0] = Integer::from(0));
    });
    assert!(matches!(fault, CoverFault::Hypothesis { .. }), "{fault:?}");

    let fault = fault_of(problem, certificate, |forged| {
        condensation(forged).stiffness_factor.rows.pop();
    });
    let is_expected = matches!(
        fault,
        CoverFault::Length { .. } | CoverFault::Hypothesis { .. }
    );
    assert!(is_expected, "{fault:?}");
}

fn false_anchors(problem: &Problem, certificate: &Certificate) {
    let fault = fault_of(problem, certificate, |forged| {
        condensation(forged).anchors.clear();
    });
    assert!(matches!(fault, CoverFault::Anchor { .. }), "{fault:?}");

    let fault = fault_of(problem, certificate, |forged| {
        set(forged).pieces[0].anchor = None;
    });
    let is_missing = matches!(fault, CoverFault::Anchor { got: None, .. });
    assert!(is_missing, "{fault:?}");

    let fault = fault_of(problem, certificate, |forged| {
        set(forged).pieces[0].anchor = Some(99);
    });
    let is_out_of_range = matches!(fault, CoverFault::Anchor { got: Some(99), .. });
    assert!(is_out_of_range, "{fault:?}");

    // A wrong column widens the enclosure: no leaf that needs it holds any more.
    let fault = fault_of(problem, certificate, |forged| {
        let anchor = &mut condensation(forged).anchors[0];
        anchor.right[0].rows[0].edit(|row| {
            for entry in row {
                *entry += Integer::from(1) << 80;
            }
        });
    });
    let is_of_the_tree = matches!(
        fault,
        CoverFault::PieceEnd { .. } | CoverFault::Truncated { .. } | CoverFault::Trailing
    );
    assert!(!is_of_the_tree, "{fault:?}");
}
