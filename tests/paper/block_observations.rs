//! The observations of section 5 on the block, over meshes, planes and ratios H/L.
#![cfg(feature = "testkit")]

use mceip_engine::run::Watch;
use mceip_engine::search::complete::{Options, complete};
use mceip_engine::search::levels::Levels;
use mceip_exact::{Rational, rational, to_f64, whole};
use mceip_model::{Body, ContactState, Problem, Unknown, Window};
use mceip_paper::path::{Contact, Interval, Loading, LoadingPath, PathEnd};
use mceip_paper::{Block, BlockModel, MassKind, MeshKind, Plane};
use std::ops::ControlFlow;
use std::time::Instant;

/// What one state of a path has: slip nodes, and (mu, slip nodes that move) of its MCEIP-mu set.
struct State {
    slip: usize,
    all_left: bool,
    set: Vec<(f64, usize)>,
    complete: bool,
}

/// The observations on one block.
struct Observed {
    dofs: usize,
    slides: bool,
    end: &'static str,
    states: Vec<State>,
    /// Levels of lambda^2 and the all-slip mu there, for the last state.
    above: Vec<(f64, Option<f64>)>,
}

impl Observed {
    fn of(model: &BlockModel) -> Observed {
        let block = Block::new(model).unwrap();
        let contact = Contact::of(&block).unwrap();
        let path = LoadingPath::follow(&contact, &Loading::of_the_paper(), &|_, _| {
            ControlFlow::Continue(())
        })
        .unwrap();
        let mut pencils = contact.pencils();
        let slips = |i: &&Interval| i.counts()[1] + i.counts()[2] > 0;
        let state = |i: &Interval| {
            let problem = Problem::new(
                Body::Pencil(pencils.of(&i.states).unwrap()),
                Unknown::Mu,
                Window::all(),
            )
            .unwrap();
            let found = complete(&problem, &Options::default(), &Watch::nobody()).unwrap();
            let set = found
                .cover
                .solutions
                .iter()
                .map(|s| (to_f64(&s.value.mid()), s.support.len()))
                .collect();
            State {
                slip: i.counts()[1] + i.counts()[2],
                all_left: i.counts()[2] == 0,
                set,
                complete: found.is_complete(),
            }
        };
        let end = match &path.end {
            PathEnd::NoFurtherEvent if path.slides() => "slides",
            PathEnd::NoFurtherEvent => "some stick for ever",
            PathEnd::NoContinuation { proved: true, .. } => "no continuation (proved)",
            PathEnd::NoContinuation { .. } => "no continuation (undecided)",
            _ => "other",
        };
        let states = path.intervals.iter().filter(slips).map(state).collect();
        let last = path.intervals.iter().rfind(slips); // the path may end with every node stuck
        Observed {
            dofs: block.stiffness.rows(),
            slides: path.slides() && path.end == PathEnd::NoFurtherEvent,
            end,
            states,
            above: last.map_or_else(Vec::new, |i| above(&block, &i.states)),
        }
    }

    fn last(&self) -> &State {
        self.states.last().unwrap()
    }

    /// The all-slip mu of the last state.
    fn all_slip(&self) -> Option<f64> {
        self.last()
            .set
            .iter()
            .find(|s| s.1 == self.last().slip)
            .map(|s| s.0)
    }

    /// States after the short stretches in which a corner slips to the right.
    fn left(&self) -> impl Iterator<Item = &State> {
        self.states.iter().filter(|s| s.all_left)
    }

    /// The smallest number of slip nodes with a solution, and whether every larger one has one too.
    fn onset(&self) -> Option<(usize, bool)> {
        let first = self
            .left()
            .filter(|s| !s.set.is_empty())
            .map(|s| s.slip)
            .min()?;
        Some((
            first,
            self.left().all(|s| s.slip < first || !s.set.is_empty()),
        ))
    }

    /// Does the smallest mu never rise as the path goes on and a slip node is added?
    fn falls(&self) -> bool {
        let least: Vec<(usize, f64)> = self
            .left()
            .filter_map(|s| s.set.first().map(|v| (s.slip, v.0)))
            .collect();
        least
            .windows(2)
            .all(|p| p[1].0 <= p[0].0 || p[1].1 < p[0].1)
    }

    /// "In average": rank correlation (Kendall) of mu and the slip nodes that get stuck, over the
    /// smallest mu of all states.
    fn stuck_at_higher_mu(&self) -> Option<f64> {
        let points: Vec<(f64, usize)> = self
            .left()
            .filter_map(|s| s.set.first().map(|v| (v.0, s.slip - v.1)))
            .collect();
        let (mut sum, mut pairs) = (0i64, 0i64);
        for (i, a) in points.iter().enumerate() {
            for b in points[..i].iter().filter(|b| b.1 != a.1) {
                pairs += 1;
                sum += if (a.0 > b.0) == (a.1 > b.1) { 1 } else { -1 };
            }
        }
        (pairs > 0).then(|| sum as f64 / pairs as f64)
    }

    /// Is there an all-slip solution with lambda^2 > 0 at some mu above the last one, rising with
    /// it?
    fn grows_above(&self) -> bool {
        let mu: Option<Vec<f64>> = std::iter::once(self.all_slip())
            .chain(self.above.iter().map(|a| a.1))
            .collect();
        mu.is_some_and(|mu| mu.windows(2).all(|p| p[0] < p[1]))
    }
}

/// The smallest all-slip mu on three levels of lambda^2 (1/s^2), in doubles.
fn above(block: &Block, states: &[ContactState]) -> Vec<(f64, Option<f64>)> {
    let slip = states
        .iter()
        .filter(|s| matches!(s, ContactState::Slip { .. }))
        .count();
    let levels = Levels::new(&block.system(states, None).unwrap()).unwrap();
    let at = |lambda2: f64| {
        let (found, _) = levels
            .at(lambda2)
            .unwrap()
            .solutions(&Watch::nobody())
            .unwrap();
        (
            lambda2,
            found
                .iter()
                .filter(|s| s.support.len() == slip)
                .map(|s| s.mu)
                .min_by(f64::total_cmp),
        )
    };
    [1e4, 1e5, 1e6].map(at).to_vec()
}

fn row(model: &BlockModel, ratio: &Rational, seen: &Observed, seconds: f64) -> String {
    let yes = |b: bool| if b { "yes" } else { "NO" };
    let number = |v: Option<f64>| v.map_or("none".into(), |v| format!("{v:.6}"));
    let least = seen.last().set.first().map(|s| s.0);
    let onset = seen.onset().map_or("never".into(), |(n, on)| {
        format!("{n}{}", if on { "" } else { " (gaps)" })
    });
    format!(
        "| {} | {} | {ratio} | {} x {} | {} | {} | {} | {onset} | {} | {} | {} | {} | {} | {} | \
         {:.0} |",
        model.mesh.word(),
        model.plane.word(),
        model.cells.0,
        model.cells.1,
        seen.dofs,
        seen.last().slip,
        seen.end,
        number(least),
        number(seen.all_slip()),
        seen.last().set.len(),
        yes(seen.falls()),
        seen.stuck_at_higher_mu()
            .map_or("-".into(), |t| format!("{t:+.2}")),
        yes(seen.grows_above()).to_string()
            + if seen.states.iter().all(|s| s.complete) {
                ""
            } else {
                " (open)"
            },
        seconds
    )
}

fn model(mesh: MeshKind, plane: Plane, columns: usize, ratio: &Rational) -> BlockModel {
    let rows = (ratio * Rational::from_integer(columns.into())).to_integer();
    let rows: usize = rows.to_string().parse().unwrap();
    let cell = whole(80) / Rational::from_integer(columns.into());
    BlockModel {
        mesh,
        plane,
        cells: (columns, rows),
        cell: (cell.clone(), cell),
        mass: MassKind::Lumped,
        ..BlockModel::of_the_paper()
    }
}

/// Small blocks, quick: the observations hold on the crossed mesh, and a rising mu would be seen.
#[test]
fn observations_on_a_small_crossed_block() {
    let seen = Observed::of(&model(MeshKind::Crossed, Plane::Stress, 8, &rational(1, 2)));
    assert!(
        seen.slides && seen.grows_above() && seen.falls(),
        "{}",
        row(
            &model(MeshKind::Crossed, Plane::Stress, 8, &rational(1, 2)),
            &rational(1, 2),
            &seen,
            0.0
        )
    );
    assert_eq!(seen.last().set.len(), 1);
    assert!(
        seen.onset()
            .is_some_and(|(n, on)| on && n > 1 && n < seen.last().slip)
    );
    let state = |slip, mu| State {
        slip,
        all_left: true,
        set: vec![(mu, slip)],
        complete: true,
    };
    let rising = Observed {
        states: vec![state(3, 2.0), state(4, 5.0)],
        above: vec![(1.0, Some(4.0))],
        ..seen
    };
    assert!(!rising.falls() && !rising.grows_above());
}

/// `cargo test --release --test paper -- --ignored --nocapture block_observations::`: the table of
/// spec/measurements.md, D.6.
#[test]
#[ignore = "minutes in the release profile"]
fn observations_over_meshes_planes_and_ratios() {
    println!(
        "| mesh | plane | H/L | cells | dofs | slip nodes at the end | end of the path | slip \
         nodes from which solutions exist | smallest mu at the end | all-slip mu | solutions at \
         the end | mu falls | stuck at higher mu | grows above | s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (mesh, plane) in MeshKind::ALL
        .into_iter()
        .flat_map(|m| Plane::ALL.map(|p| (m, p)))
    {
        for ratio in [rational(1, 4), rational(1, 2), whole(1), whole(2)] {
            let columns = if ratio > whole(1) { 12 } else { 16 };
            let (model, start) = (model(mesh, plane, columns, &ratio), Instant::now());
            let seen = Observed::of(&model);
            println!(
                "{}",
                row(&model, &ratio, &seen, start.elapsed().as_secs_f64())
            );
            let sets = seen.left().map(|s| {
                format!(
                    "{}: {:?}",
                    s.slip,
                    s.set
                        .iter()
                        .map(|v| (format!("{:.4e}", v.0), v.1))
                        .take(3)
                        .collect::<Vec<_>>()
                )
            });
            println!(
                "<!-- slip nodes: (mu, nodes that slip), the three smallest\n{}\n-->",
                sets.collect::<Vec<_>>().join("\n")
            );
            assert!(
                seen.states.iter().all(|s| s.complete),
                "every MCEIP-mu set is closed"
            );
        }
    }
}
