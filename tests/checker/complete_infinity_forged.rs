//! Forged covers of the last interval: what the checker accepts is true, and most of it it rejects.
#![cfg(feature = "testkit")]

use crate::cover::{disagreements, family_disagreements, truth};
use mceip::certificate::{Anchor, Certificate, CompleteSet, Node, RootOutcome};
use mceip::check::check;
use mceip::exact::{Integer, rational, whole};
use mceip::model::file::Number;
use mceip::model::{Body, Problem, Unknown, Window};
use mceip::run::Watch;
use mceip::search::complete::{Options, complete};
use mceip::testkit::generators::tails::{Mass, tails};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn set(c: &mut Certificate) -> &mut CompleteSet {
    c.complete_set.as_mut().unwrap()
}

fn anchor(k: usize, change: impl Fn(&mut Anchor)) -> impl Fn(&mut CompleteSet) {
    move |s: &mut CompleteSet| {
        s.condensation
            .as_mut()
            .into_iter()
            .for_each(|c| change(&mut c.anchors[k]))
    }
}

/// The forgeries that a certificate has room for, each with a name.
fn forgeries(good: &Certificate, order: usize) -> Vec<(String, Certificate)> {
    let mut out = Vec::new();
    let mut forge = |name: String, change: &dyn Fn(&mut CompleteSet)| {
        let mut c = good.clone();
        change(set(&mut c));
        if c != *good {
            out.push((name, c));
        }
    };
    let own = good.complete_set.as_ref().unwrap();
    let reversed: Vec<usize> = own
        .condensation
        .iter()
        .flat_map(|c| c.anchors.iter().enumerate())
        .filter(|(_, a)| a.reversed)
        .map(|(k, _)| k)
        .collect();
    for &k in &reversed {
        forge("flag".into(), &anchor(k, |a| a.reversed = false));
        forge(
            "center".into(),
            &anchor(k, |a| {
                a.center = Number(&a.center.0 * whole(3) + rational(1, 7))
            }),
        );
        forge(
            "right".into(),
            &anchor(k, |a| {
                a.right[0].rows[0]
                    .iter_mut()
                    .for_each(|v| *v = -v.clone() + Integer::from(1))
            }),
        );
        forge(
            "left".into(),
            &anchor(k, |a| {
                a.left[0].rows[0]
                    .iter_mut()
                    .for_each(|v| *v = -v.clone() + Integer::from(1))
            }),
        );
        forge("mass".into(), &|s| {
            s.condensation
                .as_mut()
                .into_iter()
                .for_each(|c| c.mass_sigma = Number(&c.mass_sigma.0 * whole(1000)))
        });
        // Every piece by the reversed anchor, and the reversed pieces by the first one.
        forge("all reversed".into(), &|s| {
            s.pieces.iter_mut().for_each(|p| p.anchor = Some(k))
        });
        forge("none reversed".into(), &|s| {
            s.pieces
                .iter_mut()
                .filter(|p| p.anchor == Some(k))
                .for_each(|p| p.anchor = Some(0))
        });
    }
    // The last piece: leaves exchanged, dropped, or given another outcome.
    let last = own.pieces.len() - 1;
    for (i, node) in own.pieces[last].tree.iter().enumerate() {
        let with = |leaf: Node| move |s: &mut CompleteSet| s.pieces[last].tree[i] = leaf.clone();
        match node {
            Node::Split(_) | Node::Branch(_) => continue,
            Node::Root(root) => {
                let changed = |outcome: RootOutcome| {
                    let mut root = root.clone();
                    root.outcome = outcome;
                    Node::Root(root)
                };
                forge(format!("absent {i}"), &with(changed(RootOutcome::Absent)));
                forge(
                    format!("solution {i}"),
                    &with(changed(RootOutcome::Solution)),
                );
                for x in [[1, 1, 1, 1, 1, 1], [0; 6], [2, -1, 3, 0, 1, 0]] {
                    let x: Vec<Integer> = x[..order].iter().map(|&v| Integer::from(v)).collect();
                    forge(
                        format!("infinity {i}"),
                        &with(changed(RootOutcome::Infinity(x))),
                    );
                }
            }
            _ => {}
        }
        for other in own
            .pieces
            .iter()
            .flat_map(|p| &p.tree)
            .filter(|n| !matches!(n, Node::Split(_) | Node::Branch(_)))
            .take(4)
        {
            forge(format!("leaf {i}"), &with(other.clone()));
        }
    }
    // A window that reaches further down.
    let mut wider = good.clone();
    wider.window = Window::new(whole(0), None).unwrap();
    out.push(("window".into(), wider));
    out
}

#[test]
fn what_is_accepted_of_forged_tails_is_true() {
    let [rejected, accepted, reversed] = judged(&[0, 1, 2, 3, 4, 6, 7]);
    assert!(
        rejected > 50 && rejected > accepted && reversed >= 10,
        "{rejected} {accepted} {reversed}"
    );
}

/// `cargo test --release --test checker -- --ignored --nocapture complete_infinity_forged::`
#[test]
#[ignore = "a minute in the dev profile"]
fn what_is_accepted_of_many_forged_tails_is_true() {
    let [rejected, accepted, reversed] = judged(&(0..12).collect::<Vec<_>>());
    assert!(
        rejected > 1000 && rejected > accepted && reversed >= 10,
        "{rejected} {accepted} {reversed}"
    );
}

/// Rejected and accepted forgeries, and those of a reversed anchor.
fn judged(cases: &[usize]) -> [usize; 3] {
    let (mut rejected, mut accepted, mut reversed) = (0, 0, 0);
    for &k in cases {
        let started = std::time::Instant::now();
        let mut rng = ChaCha8Rng::seed_from_u64(91_000 + k as u64);
        let mass = [Mass::Coupled, Mass::Indefinite, Mass::Partial][k % 3];
        let pencil = tails(&mut rng, 2 + k % 3, k / 3 % 3, mass).unwrap();
        let order = pencil.order();
        let window = Window::new(rational(rng.random_range(1..40), 8), None).unwrap();
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap();
        let good = complete(
            &problem,
            &Options {
                pieces: 4,
                ..Options::default()
            },
            &Watch::nobody(),
        )
        .unwrap()
        .certificate;
        let whole_line = problem.clone().with_window(Window::all());
        let (here, everywhere) = (truth(&problem), truth(&whole_line));
        for (name, forged) in forgeries(&good, order) {
            let (problem, truth) = if forged.window == *problem.window() {
                (&problem, &here)
            } else {
                (&whole_line, &everywhere)
            };
            match check(problem, &forged) {
                Err(_) => rejected += 1,
                Ok(verdict) => {
                    let cover = verdict.cover.unwrap();
                    assert_eq!(
                        disagreements(&cover, truth),
                        Vec::<String>::new(),
                        "{k} {mass:?}: {name}"
                    );
                    if !truth.is_plain_list() {
                        assert_eq!(
                            family_disagreements(problem, &cover),
                            Vec::<String>::new(),
                            "{k} {mass:?}: {name}"
                        );
                    }
                    accepted += 1;
                }
            }
            reversed += usize::from(["flag", "center", "right", "left"].contains(&name.as_str()));
        }
        println!("{k} {mass:?} order {order}: {:?}", started.elapsed());
    }
    println!(
        "{rejected} rejected, {accepted} accepted, all true; {reversed} forged reversed anchors"
    );
    [rejected, accepted, reversed]
}
