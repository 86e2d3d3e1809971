//! Forged covers: each falsehood is rejected for its own reason. (Random mutations:
//! `complete_mutants.rs`.)
#![cfg(feature = "testkit")]

use crate::cover::{condensed, disagreements, fold, plain, proved, set, trees, truth};
use mceip_check::certificate::{Certificate, Node, RootOutcome};
use mceip_check::{CoverFault, Reason, Rejected, audit, check};
use mceip_engine::reduction::reduce;
use mceip_exact::{Integer, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Problem, Unknown, Window};
use mceip_testkit::{degenerate, known, mechanical_pencil};

/// Piece and position of the first node that fits.
#[track_caller]
fn first(certificate: &Certificate, fits: impl Fn(&Node) -> bool) -> (usize, usize) {
    trees(certificate)
        .find(|(_, node)| fits(node))
        .expect("the certificate has such a node")
        .0
}

fn is_root(outcome: impl Fn(&RootOutcome) -> bool) -> impl Fn(&Node) -> bool {
    move |node| matches!(node, Node::Root(r) if outcome(&r.outcome))
}

/// Applies `forge` to a copy; the checker must say `expected`.
#[track_caller]
fn rejected(
    problem: &Problem,
    certificate: &Certificate,
    forge: impl FnOnce(&mut Certificate),
    expected: impl Fn(&CoverFault) -> bool,
) {
    let mut forged = certificate.clone();
    forge(&mut forged);
    match check(problem, &forged) {
        Err(Rejected {
            reason: Reason::Cover { fault, .. },
            ..
        }) if expected(&fault) => {}
        verdict => panic!("{verdict:?}"),
    }
}

#[test]
fn another_problem_or_unknown_is_named() {
    let (problem, certificate) = plain();
    let other = mechanical_pencil(6, Unknown::Mu, 5).unwrap();
    assert!(matches!(
        check(&other, &certificate),
        Err(Rejected {
            reason: Reason::Digest { .. },
            ..
        })
    ));
    let unknown = Certificate {
        unknown: Unknown::Lambda2,
        ..certificate
    };
    assert!(matches!(
        check(&problem, &unknown),
        Err(Rejected {
            reason: Reason::Unknown { .. },
            ..
        })
    ));
}

#[test]
fn trees_that_do_not_cover_are_rejected() {
    let (problem, certificate) = plain();
    let no = |forge: &dyn Fn(&mut Certificate), expected: &dyn Fn(&CoverFault) -> bool| {
        rejected(&problem, &certificate, forge, expected)
    };
    for p in 0..set(&mut certificate.clone()).pieces.len() {
        no(&|c| drop(set(c).pieces[p].tree.pop()), &|f| {
            matches!(f, CoverFault::Truncated { regions: 1 })
        });
        no(&|c| set(c).pieces[p].tree.push(Node::Open), &|f| {
            matches!(f, CoverFault::Trailing)
        });
        no(&|c| set(c).pieces[p].tree.clear(), &|f| {
            matches!(f, CoverFault::Truncated { .. })
        });
    }
    // Pieces: the last missing, in the wrong order, standing still, none at all.
    no(&|c| drop(set(c).pieces.pop()), &|f| {
        matches!(f, CoverFault::PieceEnd { .. })
    });
    no(&|c| set(c).pieces.swap(0, 1), &|f| {
        matches!(f, CoverFault::PieceEnd { .. })
    });
    no(
        &|c| set(c).pieces[1].max = set(c).pieces[0].max.clone(),
        &|f| matches!(f, CoverFault::PieceEnd { .. }),
    );
    no(&|c| set(c).pieces.clear(), &|f| {
        matches!(f, CoverFault::PieceEnd { .. })
    });
    // A cut at an end of its interval or outside leaves a hole or a half that is none.
    let (p, k) = first(&certificate, |n| matches!(n, Node::Split(_)));
    for at in [whole(0), whole(-1), whole(1_000_000_000)] {
        let is_last = certificate.complete_set.as_ref().unwrap().pieces[p]
            .max
            .is_none();
        if !(is_last && at > whole(1)) {
            no(
                &|c| set(c).pieces[p].tree[k] = Node::Split(Number(at.clone())),
                &|f| matches!(f, CoverFault::Cut { .. }),
            );
        }
    }
    let (p, k) = first(&certificate, |n| matches!(n, Node::Branch(_)));
    let Node::Branch(index) = set(&mut certificate.clone()).pieces[p].tree[k].clone() else {
        unreachable!()
    };
    no(
        &|c| set(c).pieces[p].tree.insert(k, Node::Branch(index)),
        &|f| matches!(f, CoverFault::Branch { .. }),
    );
    no(&|c| set(c).pieces[p].tree[k] = Node::Branch(6), &|f| {
        matches!(f, CoverFault::Branch { index: 6 })
    });
}

/// What an audit opens is what `check` refuses one by one, and it opens nothing else.
#[test]
fn an_audit_opens_exactly_the_leaves_that_fail() {
    let (problem, certificate) = plain();
    assert_eq!(
        audit(&problem, &certificate),
        check(&problem, &certificate).map(|accepted| (accepted, Vec::new()))
    );
    let weights: Vec<(usize, usize)> = trees(&certificate)
        .filter(|(_, n)| matches!(n, Node::Farkas(_)))
        .map(|(at, _)| at)
        .step_by(3)
        .collect();
    assert!(weights.len() > 1);
    let mut forged = certificate.clone();
    weights
        .iter()
        .for_each(|&(p, k)| set(&mut forged).pieces[p].tree[k] = Node::Farkas(vec![0; 6]));
    let (accepted, refused) = audit(&problem, &forged).unwrap();
    assert_eq!(refused, weights);
    refused
        .iter()
        .for_each(|&(p, k)| set(&mut forged).pieces[p].tree[k] = Node::Open);
    assert_eq!(accepted, check(&problem, &forged).unwrap());
    assert_eq!(accepted.cover.unwrap().open.len(), weights.len());
    // A hole in the tree is not mended.
    drop(set(&mut forged).pieces[0].tree.pop());
    assert!(audit(&problem, &forged).is_err());
}

#[test]
fn an_enlarged_window_is_not_covered() {
    let all = mechanical_pencil(6, Unknown::Mu, 4).unwrap();
    let problem = all
        .clone()
        .with_window(Window::new(rational(1, 2), Some(whole(3))).unwrap());
    let certificate = proved(&problem);
    for max in [None, Some(whole(4)), Some(whole(2))] {
        let window = Window::new(rational(1, 2), max).unwrap();
        rejected(
            &problem,
            &certificate,
            |c| c.window = window,
            |f| matches!(f, CoverFault::PieceEnd { .. }),
        );
    }
    // Downwards the first piece grows: its reasons hold there or not, and it is said which window
    // is proved.
    let below = Certificate {
        window: Window::new(whole(0), Some(whole(3))).unwrap(),
        ..certificate
    };
    let wide = all.with_window(below.window.clone());
    if let Ok(accepted) = check(&wide, &below) {
        assert_eq!(
            disagreements(&accepted.cover.unwrap(), &truth(&wide)),
            Vec::<String>::new()
        );
    }
}

#[test]
fn false_farkas_and_definite_leaves_are_rejected() {
    let (problem, certificate) = plain();
    let no = |forge: &dyn Fn(&mut Certificate), expected: &dyn Fn(&CoverFault) -> bool| {
        rejected(&problem, &certificate, forge, expected)
    };
    let (p, k) = first(&certificate, |n| matches!(n, Node::Farkas(_)));
    let Node::Farkas(w) = set(&mut certificate.clone()).pieces[p].tree[k].clone() else {
        unreachable!()
    };
    let with =
        |w: Vec<i64>| move |c: &mut Certificate| set(c).pieces[p].tree[k] = Node::Farkas(w.clone());
    no(&with(w[1..].to_vec()), &|f| {
        matches!(
            f,
            CoverFault::Length {
                expected: 6,
                got: 5,
                ..
            }
        )
    });
    no(&with(vec![0; 6]), &|f| matches!(f, CoverFault::NotStrict));
    // At the root of a tree nothing is known to move: every negative weight is off the moving set.
    let (q, _) = first(&certificate, |n| matches!(n, Node::Branch(_)));
    no(
        &|c| set(c).pieces[q].tree = vec![Node::Farkas(vec![1, 1, -1, 1, 1, 1])],
        &|f| matches!(f, CoverFault::NegativeWeight { index: 2, got: -1 }),
    );
    no(
        &|c| set(c).pieces[q].tree = vec![Node::Farkas(vec![1; 6])],
        &|f| matches!(f, CoverFault::NotNegative { .. }),
    );
    let (mut definite, mut moved, mut refused) = (0, 0, 0);
    let leaves: Vec<((usize, usize), Node)> =
        trees(&certificate).map(|(at, n)| (at, n.clone())).collect();
    let truth = truth(&problem);
    for ((p, k), node) in &leaves {
        let other = match node {
            Node::PositiveDefinite => Node::NegativeDefinite,
            Node::NegativeDefinite => Node::PositiveDefinite,
            _ => continue,
        };
        no(&|c| set(c).pieces[*p].tree[*k] = other.clone(), &|f| {
            matches!(f, CoverFault::NotDefinite { .. })
        });
        definite += 1;
    }
    // A reason from another leaf: refused, or by luck a reason here too.
    let weights: Vec<&((usize, usize), Node)> = leaves
        .iter()
        .filter(|(_, n)| matches!(n, Node::Farkas(_)))
        .collect();
    for (a, b) in weights
        .iter()
        .zip(weights.iter().rev())
        .filter(|(a, b)| a.1 != b.1)
    {
        let mut forged = certificate.clone();
        let (p, k) = a.0;
        set(&mut forged).pieces[p].tree[k] = b.1.clone();
        moved += 1;
        match check(&problem, &forged) {
            Ok(accepted) => assert_eq!(
                disagreements(&accepted.cover.unwrap(), &truth),
                Vec::<String>::new()
            ),
            Err(Rejected {
                reason: Reason::Cover { piece, node, fault },
                ..
            }) => {
                assert_eq!((piece, node), (Some(p), Some(k)));
                assert!(
                    matches!(
                        fault,
                        CoverFault::NotNegative { .. } | CoverFault::NegativeWeight { .. }
                    ),
                    "{fault:?}"
                );
                refused += 1;
            }
            Err(e) => panic!("{e}"),
        }
    }
    assert!(
        definite > 0 && moved > 4 && refused > moved / 2,
        "{definite} definite, {refused} of {moved} refused"
    );
}

#[test]
fn false_root_leaves_are_rejected() {
    let (problem, certificate) = plain();
    let (p, k) = first(&certificate, is_root(|o| *o == RootOutcome::Solution));
    let forge = |change: &dyn Fn(&mut mceip_check::certificate::Root),
                 expected: &dyn Fn(&CoverFault) -> bool| {
        let change = |c: &mut Certificate| match &mut set(c).pieces[p].tree[k] {
            Node::Root(root) => change(root),
            _ => unreachable!(),
        };
        rejected(&problem, &certificate, change, expected);
    };
    let Node::Root(true_root) = set(&mut certificate.clone()).pieces[p].tree[k].clone() else {
        unreachable!()
    };
    forge(&|r| r.outcome = RootOutcome::Absent, &|f| {
        matches!(f, CoverFault::SignChange)
    });
    // Every x of a solution is positive and every y not negative.
    for i in 0..6 {
        forge(&|r| r.outcome = RootOutcome::NegativeX(i), &|f| {
            matches!(f, CoverFault::Sign { .. })
        });
        forge(&|r| r.outcome = RootOutcome::NegativeY(i), &|f| {
            matches!(f, CoverFault::Sign { .. })
        });
    }
    forge(&|r| r.outcome = RootOutcome::Claim(0), &|f| {
        matches!(f, CoverFault::NotTheClaim { claim: 0 })
    });
    // An interval beside the value, of no width, reversed, outside the window.
    let [a, b] = [
        true_root.interval[0].0.clone(),
        true_root.interval[1].0.clone(),
    ];
    let width = &b - &a;
    let beside = [Number(&b + &width), Number(&b + &width * whole(2))];
    forge(&|r| r.interval = beside.clone(), &|f| {
        matches!(f, CoverFault::NoSignChange { .. })
    });
    forge(&|r| r.interval[1] = r.interval[0].clone(), &|f| {
        matches!(f, CoverFault::Interval { .. })
    });
    forge(&|r| r.interval.reverse(), &|f| {
        matches!(f, CoverFault::Interval { .. })
    });
    forge(&|r| r.interval[0] = Number(whole(-1)), &|f| {
        matches!(f, CoverFault::Interval { .. })
    });
    forge(&|r| r.pivot = 6, &|f| {
        matches!(f, CoverFault::Pivot { index: 6 })
    });
    if !true_root.right.is_empty() {
        forge(&|r| drop(r.right.pop()), &|f| {
            matches!(f, CoverFault::Length { .. })
        });
        forge(
            &|r| {
                r.inverse
                    .iter_mut()
                    .flatten()
                    .for_each(|v| *v = Integer::from(0))
            },
            &|f| matches!(f, CoverFault::NotRegular { .. }),
        );
        forge(
            &|r| r.right.iter_mut().for_each(|v| *v = -v.clone() * 8),
            &|f| {
                matches!(
                    f,
                    CoverFault::NotMonotone
                        | CoverFault::NoSignChange { .. }
                        | CoverFault::Sign { .. }
                )
            },
        );
    }
    // Where indices are open, and where there is no condensation's tail.
    rejected(
        &problem,
        &certificate,
        |c| set(c).pieces[0].tree = vec![Node::Root(true_root.clone())],
        |f| matches!(f, CoverFault::RootTooEarly),
    );
    rejected(
        &problem,
        &certificate,
        |c| set(c).pieces[0].tree = vec![Node::Tail],
        |f| matches!(f, CoverFault::Hypothesis { .. }),
    );
    // What is no solution is not made one.
    let negative: Vec<(usize, usize)> = trees(&certificate)
        .filter(|(_, n)| {
            is_root(|o| {
                matches!(
                    o,
                    RootOutcome::NegativeX(_) | RootOutcome::NegativeY(_) | RootOutcome::Absent
                )
            })(n)
        })
        .map(|(at, _)| at)
        .collect();
    for (p, k) in negative {
        let flip = |c: &mut Certificate| {
            if let Node::Root(r) = &mut set(c).pieces[p].tree[k] {
                r.outcome = RootOutcome::Solution;
            }
        };
        rejected(&problem, &certificate, flip, |f| {
            matches!(
                f,
                CoverFault::Sign { .. }
                    | CoverFault::NoSignChange { .. }
                    | CoverFault::Interval { .. }
            )
        });
    }
}

/// Support {0, 1} has lambda^2 = 2 and 3: a leaf over both with the witness of one.
#[test]
fn a_root_leaf_that_hides_a_second_solution_is_rejected() {
    let problem = fold(Window::new(rational(3, 2), Some(rational(7, 2))).unwrap());
    let certificate = proved(&problem);
    let (p, k) = first(&certificate, is_root(|o| *o == RootOutcome::Solution));
    let root = set(&mut certificate.clone()).pieces[p].tree[k].clone();
    let tree = |root: Node| {
        let rest = [
            Node::Branch(0),
            Node::Branch(1),
            Node::PositiveDefinite,
            Node::NegativeDefinite,
            Node::Branch(1),
            Node::PositiveDefinite,
        ];
        rest.into_iter().chain([root]).collect::<Vec<_>>()
    };
    let one_piece = |root: Node| {
        move |c: &mut Certificate| {
            set(c).pieces.truncate(1);
            set(c).pieces[0].max = Some(Number(rational(7, 2)));
            set(c).pieces[0].tree = tree(root);
        }
    };
    // The tree itself is right: with the leaf left open it is accepted.
    let mut open = certificate.clone();
    one_piece(Node::Open)(&mut open);
    let cover = check(&problem, &open).unwrap().cover.unwrap();
    assert_eq!(
        (cover.open.len(), cover.open[0].moving.as_slice()),
        (1, &[0, 1][..])
    );
    rejected(&problem, &certificate, one_piece(root), |f| {
        matches!(f, CoverFault::NotMonotone | CoverFault::NotRegular { .. })
    });
}

#[test]
fn the_claim_of_another_solution_is_rejected() {
    let mut met = 0;
    let mut list: Vec<Problem> = degenerate()
        .unwrap()
        .into_iter()
        .map(|i| i.problem)
        .collect();
    list.extend(
        (2..=4)
            .flat_map(|n| [known::path(n), known::star(n), known::jordan(n, 2, true)])
            .filter_map(Result::ok)
            .map(|k| k.problem),
    );
    for problem in list
        .into_iter()
        .filter(|p| reduce(p).unwrap().pencil.free().is_empty())
    {
        let certificate = proved(&problem);
        let claimed: Vec<((usize, usize), usize)> = trees(&certificate)
            .filter_map(|(at, n)| match n {
                Node::Root(r) => match r.outcome {
                    RootOutcome::Claim(c) => Some((at, c)),
                    _ => None,
                },
                _ => None,
            })
            .collect();
        for ((p, k), own) in claimed {
            for claim in 0..=certificate.claims.len() {
                let is_other = claim == certificate.claims.len()
                    || certificate.claims[claim] != certificate.claims[own];
                if claim == own || !is_other {
                    continue;
                }
                let change = |c: &mut Certificate| match &mut set(c).pieces[p].tree[k] {
                    Node::Root(r) => r.outcome = RootOutcome::Claim(claim),
                    _ => unreachable!(),
                };
                let mut forged = certificate.clone();
                change(&mut forged);
                match check(&problem, &forged) {
                    // A solution with another support may have a null vector of this leaf too: then
                    // nothing is lost.
                    Ok(accepted) => assert_eq!(
                        disagreements(&accepted.cover.unwrap(), &truth(&problem)),
                        Vec::<String>::new()
                    ),
                    Err(Rejected {
                        reason:
                            Reason::Cover {
                                fault: CoverFault::NotTheClaim { claim: c },
                                ..
                            },
                        ..
                    }) => {
                        assert_eq!(c, claim);
                        met += 1;
                    }
                    Err(e) => panic!("{e}"),
                }
            }
        }
    }
    assert!(met > 2, "{met}");
}

#[test]
fn a_false_condensation_is_rejected() {
    let (problem, certificate) = condensed();
    fn of(c: &mut Certificate) -> &mut mceip_check::certificate::Condensation {
        set(c).condensation.as_mut().unwrap()
    }
    let no = |forge: &dyn Fn(&mut Certificate), expected: &dyn Fn(&CoverFault) -> bool| {
        rejected(&problem, &certificate, forge, expected)
    };
    no(&|c| set(c).condensation = None, &|f| {
        matches!(f, CoverFault::Condensation { expected: true })
    });
    for sigma in [whole(0), whole(-1), whole(1_000_000)] {
        no(&|c| of(c).sigma = Number(sigma.clone()), &|f| {
            matches!(f, CoverFault::Hypothesis { .. })
        });
    }
    no(
        &|c| of(c).stiffness_factor.rows[0][0] = Integer::from(0),
        &|f| matches!(f, CoverFault::Hypothesis { .. }),
    );
    no(&|c| drop(of(c).stiffness_factor.rows.pop()), &|f| {
        matches!(f, CoverFault::Length { .. } | CoverFault::Hypothesis { .. })
    });
    no(&|c| of(c).anchors.clear(), &|f| {
        matches!(f, CoverFault::Anchor { .. })
    });
    no(&|c| set(c).pieces[0].anchor = None, &|f| {
        matches!(f, CoverFault::Anchor { got: None, .. })
    });
    no(&|c| set(c).pieces[0].anchor = Some(99), &|f| {
        matches!(f, CoverFault::Anchor { got: Some(99), .. })
    });
    // A wrong column widens the enclosure: no leaf that needs it holds any more.
    no(
        &|c| {
            of(c).anchors[0].right[0].rows[0]
                .iter_mut()
                .for_each(|v| *v += Integer::from(1) << 80)
        },
        &|f| {
            !matches!(
                f,
                CoverFault::PieceEnd { .. } | CoverFault::Truncated { .. } | CoverFault::Trailing
            )
        },
    );
    // Where nothing is free there is nothing to condense.
    let (plain, own) = plain();
    let condensation = certificate.complete_set.clone().unwrap().condensation;
    rejected(
        &plain,
        &own,
        |c| set(c).condensation = condensation,
        |f| matches!(f, CoverFault::Condensation { expected: false }),
    );
}
