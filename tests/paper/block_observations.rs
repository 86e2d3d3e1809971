//! The observations of section 5 on the block, over meshes, planes and ratios H/L.
//!
//! Each state of a loading path has its complete MCEIP-mu set, proved. The observations (mu falls
//! as slip nodes are added, lambda^2 grows above the smallest mu) are questions to these sets. That
//! the questions can be answered with no is shown on made-up data.
#![cfg(feature = "testkit")]

use crate::paper_path::{path_of, slip_nodes};
use mceip_engine::reduction::SparseCondensation;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_engine::search::levels::level_solutions;
use mceip_exact::{Rational, rational, to_f64, whole};
use mceip_model::{Body, ContactState, Pencil, Problem, Unknown, Window};
use mceip_paper::{Block, BlockModel, MassKind, MeshKind, Plane};
use mceip_path::{LoadingPathEnd, Stretch};
use std::time::Instant;

/// A solution of MCEIP-mu.
struct Solution {
    mu: f64,
    /// How many slip nodes move.
    moving: usize,
}

/// What one state of a path has.
struct State {
    /// The number of slip nodes.
    slip: usize,
    /// Does every slip node slip to the left?
    all_left: bool,
    /// The MCEIP-mu set, by mu.
    set: Vec<Solution>,
    /// Is the set proved to be complete?
    complete: bool,
}

/// The observations on one block.
struct Observed {
    dofs: usize,
    slides: bool,
    end: &'static str,
    states: Vec<State>,
    /// The all-slip mu of the last state on rising levels of lambda^2.
    above: Vec<Option<f64>>,
}

impl State {
    fn of(stretch: &Stretch, pencil: Pencil) -> State {
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all()).unwrap();
        let found = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();

        let mut set = Vec::new();
        for solution in &found.cover.solutions {
            set.push(Solution {
                mu: to_f64(&solution.value.mid()),
                moving: solution.support.len(),
            });
        }

        let [_, _, right, _] = stretch.counts();
        State {
            slip: slip_nodes(stretch),
            all_left: right == 0,
            set,
            complete: found.is_complete(),
        }
    }

    fn smallest(&self) -> Option<&Solution> {
        self.set.first()
    }
}

impl Observed {
    fn of(model: &BlockModel) -> Observed {
        let block = Block::new(model).unwrap();
        let contact = block.contact_side().unwrap();
        let path = path_of(&contact);

        // The path may end with every node stuck: then the last state with slip nodes counts.
        let mut pencils = contact.pencils();
        let mut states = Vec::new();
        let mut above = Vec::new();

        for stretch in path.stretches.iter().filter(|i| slip_nodes(i) > 0) {
            let pencil = pencils.of(&stretch.states).unwrap();
            states.push(State::of(stretch, pencil));
        }

        if let Some(last) = path.stretches.iter().rfind(|i| slip_nodes(i) > 0) {
            above = all_slip_above(&block, &last.states);
        }

        let end = match &path.end {
            LoadingPathEnd::NoFurtherEvent if path.slides() => "slides",
            LoadingPathEnd::NoFurtherEvent => "some stick for ever",
            LoadingPathEnd::NoContinuation { why, .. } if why.is_proved() => {
                "no continuation (proved)"
            }
            LoadingPathEnd::NoContinuation { .. } => "no continuation (undecided)",
            _ => "other",
        };

        Observed {
            dofs: block.stiffness.rows(),
            slides: path.slides() && path.end == LoadingPathEnd::NoFurtherEvent,
            end,
            states,
            above,
        }
    }

    fn last(&self) -> &State {
        self.states.last().unwrap()
    }

    /// The all-slip mu of the last state.
    fn all_slip(&self) -> Option<f64> {
        let last = self.last();
        let all_slip = last.set.iter().find(|s| s.moving == last.slip);
        all_slip.map(|solution| solution.mu)
    }

    /// States after the short stretches in which a corner slips to the right.
    fn left(&self) -> impl Iterator<Item = &State> {
        self.states.iter().filter(|s| s.all_left)
    }

    /// From which number of slip nodes on there are solutions.
    fn onset(&self) -> Option<Onset> {
        let solvable = self.left().filter(|state| !state.set.is_empty());
        let slip = solvable.map(|state| state.slip).min()?;
        let without_gaps = self
            .left()
            .all(|state| state.slip < slip || !state.set.is_empty());

        Some(Onset { slip, without_gaps })
    }

    /// Does the smallest mu never rise as the path goes on and a slip node is added?
    fn falls(&self) -> bool {
        let solvable: Vec<&State> = self.left().filter(|state| !state.set.is_empty()).collect();

        solvable.windows(2).all(|pair| {
            let a_node_is_added = pair[1].slip > pair[0].slip;
            let mu_falls = pair[1].set[0].mu < pair[0].set[0].mu;
            !a_node_is_added || mu_falls
        })
    }

    /// "In average": rank correlation (Kendall) of mu and the slip nodes that get stuck, over the
    /// smallest mu of all states.
    fn stuck_at_higher_mu(&self) -> Option<f64> {
        struct Point {
            mu: f64,
            stuck: usize,
        }

        let mut points: Vec<Point> = Vec::new();
        for state in self.left() {
            if let Some(smallest) = state.smallest() {
                points.push(Point {
                    mu: smallest.mu,
                    stuck: state.slip - smallest.moving,
                });
            }
        }

        let mut pairs = 0i64;
        let mut concordant_minus_discordant = 0i64;

        for (i, a) in points.iter().enumerate() {
            for b in &points[..i] {
                if a.stuck == b.stuck {
                    continue;
                }

                let is_concordant = (a.mu > b.mu) == (a.stuck > b.stuck);
                concordant_minus_discordant += if is_concordant { 1 } else { -1 };
                pairs += 1;
            }
        }
        (pairs > 0).then(|| concordant_minus_discordant as f64 / pairs as f64)
    }

    /// Is there an all-slip solution with lambda^2 > 0 at some mu above the last one, rising with
    /// it?
    fn grows_above(&self) -> bool {
        let at_zero = std::iter::once(self.all_slip());
        let levels = at_zero.chain(self.above.iter().copied());
        let mu: Option<Vec<f64>> = levels.collect();

        mu.is_some_and(|mu| mu.windows(2).all(|pair| pair[0] < pair[1]))
    }
}

/// From which number of slip nodes on there are solutions.
struct Onset {
    /// The smallest number of slip nodes with a solution.
    slip: usize,
    /// Has every larger number a solution too?
    without_gaps: bool,
}

/// The smallest all-slip mu on three levels of lambda^2 (1/s^2), in doubles.
fn all_slip_above(block: &Block, states: &[ContactState]) -> Vec<Option<f64>> {
    let is_slip = |state: &&ContactState| matches!(state, ContactState::Slip { .. });
    let slip = states.iter().filter(is_slip).count();
    let system = block.system(states, None).unwrap();
    let condensation = SparseCondensation::of_system(&system).unwrap();

    let mut smallest = Vec::new();
    for lambda2 in [1e4, 1e5, 1e6] {
        let level = condensation.at(lambda2).unwrap();
        let (found, _) = level_solutions(&level, &Watch::nobody()).unwrap();
        let all_slip = found.iter().filter(|s| s.support.len() == slip);
        smallest.push(all_slip.map(|s| s.mu).min_by(f64::total_cmp));
    }
    smallest
}

fn yes_or_no(answer: bool) -> &'static str {
    if answer { "yes" } else { "NO" }
}

fn number(value: Option<f64>) -> String {
    value.map_or("none".into(), |value| format!("{value:.6}"))
}

/// A row of the table of spec/log/2026-11-21-meshes.md (spec/measurements.md, D.6).
fn row(model: &BlockModel, ratio: &Rational, seen: &Observed, seconds: f64) -> String {
    let smallest_mu = seen.last().smallest().map(|solution| solution.mu);
    let onset = match seen.onset() {
        None => "never".to_string(),
        Some(onset) if onset.without_gaps => format!("{}", onset.slip),
        Some(onset) => format!("{} (gaps)", onset.slip),
    };
    let correlation = match seen.stuck_at_higher_mu() {
        None => "-".to_string(),
        Some(tau) => format!("{tau:+.2}"),
    };
    let all_closed = seen.states.iter().all(|state| state.complete);
    let open = if all_closed { "" } else { " (open)" };

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
        number(smallest_mu),
        number(seen.all_slip()),
        seen.last().set.len(),
        yes_or_no(seen.falls()),
        correlation,
        yes_or_no(seen.grows_above()).to_string() + open,
        seconds
    )
}

fn model(mesh: MeshKind, plane: Plane, columns: usize, ratio: &Rational) -> BlockModel {
    let columns_exact = Rational::from_integer(columns.into());
    let rows_exact = (ratio * &columns_exact).to_integer();
    let rows: usize = rows_exact.to_string().parse().unwrap();
    let cell = whole(80) / columns_exact;

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
    let ratio = rational(1, 2);
    let model = model(MeshKind::Crossed, Plane::Stress, 8, &ratio);
    let seen = Observed::of(&model);

    let row = row(&model, &ratio, &seen, 0.0);
    assert!(seen.slides, "{row}");
    assert!(seen.grows_above(), "{row}");
    assert!(seen.falls(), "{row}");
    assert_eq!(seen.last().set.len(), 1);

    let onset = seen.onset().unwrap();
    assert!(onset.without_gaps);
    assert!(onset.slip > 1 && onset.slip < seen.last().slip);

    let rising = Observed {
        states: vec![with_one_solution(3, 2.0), with_one_solution(4, 5.0)],
        above: vec![Some(4.0)],
        ..seen
    };

    assert!(!rising.falls());
    assert!(!rising.grows_above());
}

/// A state with so many slip nodes and one solution, in which all of them move.
fn with_one_solution(slip: usize, mu: f64) -> State {
    State {
        slip,
        all_left: true,
        set: vec![Solution { mu, moving: slip }],
        complete: true,
    }
}

/// `cargo test --release --test paper -- --ignored --nocapture block_observations::`: the table of
/// spec/log/2026-11-21-meshes.md (spec/measurements.md, D.6).
#[test]
#[ignore = "minutes in the release profile"]
fn observations_over_meshes_planes_and_ratios() {
    println!(
        "| mesh | plane | H/L | cells | dofs | slip nodes at the end | end of the path | slip \
         nodes from which solutions exist | smallest mu at the end | all-slip mu | solutions at \
         the end | mu falls | stuck at higher mu | grows above | s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");

    for mesh in MeshKind::ALL {
        for plane in Plane::ALL {
            for ratio in [rational(1, 4), rational(1, 2), whole(1), whole(2)] {
                observe(mesh, plane, &ratio);
            }
        }
    }
}

/// Prints a row of the table and the sets behind it.
fn observe(mesh: MeshKind, plane: Plane, ratio: &Rational) {
    let columns = if *ratio > whole(1) { 12 } else { 16 };
    let model = model(mesh, plane, columns, ratio);
    let start = Instant::now();
    let seen = Observed::of(&model);
    let seconds = start.elapsed().as_secs_f64();
    println!("{}", row(&model, ratio, &seen, seconds));

    println!("<!-- slip nodes: (mu, nodes that slip), the three smallest");
    for state in seen.left() {
        let smallest: Vec<(String, usize)> = state
            .set
            .iter()
            .take(3)
            .map(|solution| (format!("{:.4e}", solution.mu), solution.moving))
            .collect();
        println!("{}: {smallest:?}", state.slip);
    }

    println!("-->");

    assert!(
        seen.states.iter().all(|state| state.complete),
        "every MCEIP-mu set is closed"
    );
}
