//! The loading path of the block: its laws against the uncondensed K, its events against stepping,
//! its states against the paper.
#![cfg(feature = "solver")]

use mceip_exact::{Rational, rational, to_f64, whole};
use mceip_model::{ContactState, Particle, Reaction, System, Unknown};
use mceip_paper::path::{
    Bound, Comparison, Contact, Finder, Interval, Loading, LoadingPath, PathEnd, PathError,
    step_path,
};
use mceip_paper::{Block, BlockModel, MeshKind, Plane, PublishedState};
use std::ops::ControlFlow;

fn follow(block: &Block, loading: &Loading) -> LoadingPath {
    LoadingPath::follow(&Contact::of(block).unwrap(), loading, &|_, _| {
        ControlFlow::Continue(())
    })
    .unwrap()
}

fn go_on(_: usize) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn block(nx: usize, ny: usize, mesh: MeshKind, plane: Plane) -> Block {
    Block::new(&BlockModel {
        mesh,
        plane,
        ..BlockModel::of_the_paper().with_cells(nx, ny)
    })
    .unwrap()
}

fn paper(mu: Rational) -> Loading {
    Loading {
        friction: mu,
        ..Loading::of_the_paper()
    }
}

/// The whole block under the contact displacements of an equilibrium, by plain elimination in
/// fractions on the uncondensed K: forces vanish inside, and are the reactions on the contact side.
fn equilibrium_of_the_whole_block(block: &Block, interval: &Interval, depth: &Rational) {
    let n = block.stiffness.rows();
    let at = &interval.start;
    let mut w: Vec<Option<Rational>> = vec![None; n]; // relative to the glued side
    for (k, &node) in block.contact.iter().enumerate() {
        let (t, normal) = at.displacement(k);
        w[2 * node] = Some(t + at.motion());
        w[2 * node + 1] = Some(depth - normal); // y points away from the obstacle
    }
    let inside: Vec<usize> = (0..n).filter(|&i| w[i].is_none()).collect();
    let known = |i: usize| -> Rational {
        (0..n)
            .filter_map(|j| w[j].as_ref().map(|v| block.stiffness.get(i, j) * v))
            .sum()
    };
    let mut m: Vec<Vec<Rational>> = inside
        .iter()
        .map(|&i| {
            inside
                .iter()
                .map(|&j| block.stiffness.get(i, j))
                .chain([-known(i)])
                .collect()
        })
        .collect();
    for k in 0..m.len() {
        for i in (0..m.len()).filter(|&i| i != k) {
            let factor = &m[i][k] / &m[k][k];
            for j in k..=inside.len() {
                let update = &factor * &m[k][j];
                m[i][j] -= update;
            }
        }
    }
    for (k, &i) in inside.iter().enumerate() {
        w[i] = Some(m[k].last().unwrap() / &m[k][k]);
    }
    let w: Vec<Rational> = w.into_iter().flatten().collect();
    let force = block.stiffness.times(&w);
    for (k, &node) in block.contact.iter().enumerate() {
        let (t, normal) = at.reaction(k);
        assert_eq!((&force[2 * node], -&force[2 * node + 1]), (&t, normal));
    }
    assert!(inside.iter().all(|&i| force[i] == whole(0)));
}

#[test]
fn equilibria_are_those_of_the_uncondensed_block() {
    let block = block(3, 1, MeshKind::Crossed, Plane::Stress);
    for mu in [rational(11, 10), rational(3, 10)] {
        let path = follow(&block, &paper(mu));
        assert!(
            path.slides() && path.intervals.len() >= 4,
            "{}",
            path.intervals.len()
        );
        for interval in &path.intervals {
            equilibrium_of_the_whole_block(&block, interval, &path.depth);
        }
        assert_eq!(
            path.pressed.resultants(),
            (whole(0), whole(-55)),
            "pressed symmetrically until N = 55"
        );
    }
}

/// Reactions in the middle of each stretch go through the model's own check of (7), states and
/// signs; with a wrong sign they do not.
#[test]
fn states_and_reactions_satisfy_7_in_the_middle_of_each_stretch() {
    let block = block(6, 3, MeshKind::Backslash, Plane::Strain);
    let mu = rational(11, 10);
    let path = follow(&block, &paper(mu.clone()));
    let mut slips = [0, 0];
    for interval in path.intervals.iter().filter(|i| i.stop.is_some()) {
        let middle = |k: usize| {
            let (a, b) = (
                interval.start.reaction(k),
                interval.stop.as_ref().unwrap().reaction(k),
            );
            Reaction {
                tangential: (a.0 + b.0) / whole(2),
                normal: (a.1 + b.1) / whole(2),
            }
        };
        let system = |states: &[ContactState]| {
            let particle = |k: usize| Particle {
                normal_direction: -1,
                reaction: Some(middle(k)),
                ..Particle::plain(2 * block.contact[k], 2 * block.contact[k] + 1, states[k])
            };
            System::new(
                block.stiffness.clone(),
                None,
                Some(mu.clone()),
                (0..states.len()).map(particle).collect(),
            )
        };
        assert!(system(&interval.states).is_ok());
        for (k, state) in interval.states.iter().enumerate() {
            if let ContactState::Slip { sign } = state {
                slips[usize::from(*sign < 0)] += 1;
                let mut wrong = interval.states.clone();
                wrong[k] = ContactState::Slip { sign: -sign };
                assert!(system(&wrong).is_err());
                wrong[k] = ContactState::Stick;
                assert!(system(&wrong).is_err());
            }
        }
    }
    assert!(slips[0] > 5 && slips[1] > 0, "{slips:?}");
}

/// The bound that an event names is zero there and was not before; stretches join.
#[test]
fn events_are_located_exactly() {
    let block = block(6, 3, MeshKind::Backslash, Plane::Strain);
    let loading = paper(rational(11, 10));
    let path = follow(&block, &loading);
    let mut kinds = [0; 2];
    for pair in path.intervals.windows(2) {
        let (stop, start) = (pair[0].stop.as_ref().unwrap(), &pair[1].start);
        assert_eq!(stop.motion(), start.motion());
        assert!(pair[0].start.motion() < stop.motion());
        assert!((0..7).all(|k| stop.reaction(k) == start.reaction(k)
            && stop.displacement(k) == start.displacement(k)));
        for bound in &pair[1].begin.causes {
            let value = |at: &mceip_paper::path::Equilibrium| {
                let ((t, n), gap) = (at.reaction(bound.node()), -at.displacement(bound.node()).1);
                match bound {
                    Bound::Cone { sign, .. } => -&loading.friction * n - t * whole((*sign).into()),
                    Bound::Pressure { .. } => -n,
                    _ => gap,
                }
            };
            kinds[usize::from(matches!(bound, Bound::Pressure { .. }))] += 1;
            assert_eq!(value(stop), whole(0));
            assert!(value(&pair[0].start) > whole(0));
        }
        let k = path
            .intervals
            .iter()
            .position(|i| i.start.motion() == pair[0].start.motion())
            .unwrap();
        assert_eq!(path.ending(k), Some(&pair[1].begin));
        assert!(!pair[1].begin.changes.is_empty() && pair[1].begin.finder == Finder::ActiveSet);
    }
    assert!(kinds[0] > 4 && kinds[1] > 1, "{kinds:?}");
    assert!(
        path.intervals[0].counts()[2] > 0,
        "pressing an oblique mesh makes the corner slip to the right"
    );
}

#[test]
fn stepping_finds_the_same_path_but_for_short_stretches() {
    let contact = Contact::of(&block(8, 4, MeshKind::Crossed, Plane::Stress)).unwrap();
    let loading = Loading::of_the_paper();
    let path = LoadingPath::follow(&contact, &loading, &|_, _| ControlFlow::Continue(())).unwrap();
    let last = to_f64(path.intervals.last().unwrap().start.motion());
    let compare = |h: Rational| {
        let count = (last / to_f64(&h)) as usize + 10;
        Comparison::of(
            &path,
            &step_path(&contact, &loading, &h, count, &go_on).unwrap(),
        )
    };
    let fine = compare(rational(1, 1000));
    assert_eq!((fine.skipped, fine.other_states), (vec![], vec![]));
    // Unit N, of 55. No node turns round within a step here, and then backward Euler is exact at
    // the end of the step, over events too: what is left is rounding (seen: 1e-13).
    assert!(fine.reaction < 1e-9, "{}", fine.reaction);
    let coarse = compare(rational(1, 10));
    assert!(!coarse.skipped.is_empty(), "short stretches are skipped");
    let moved = Loading {
        friction: rational(12, 10),
        ..loading.clone()
    };
    let other = Comparison::of(
        &path,
        &step_path(&contact, &moved, &rational(1, 100), 300, &go_on).unwrap(),
    );
    assert!(
        other.reaction > 0.1,
        "another friction is another path: {}",
        other.reaction
    );
}

#[test]
fn a_range_an_interrupt_and_refusals() {
    let contact = Contact::of(&block(2, 1, MeshKind::Slash, Plane::Stress)).unwrap();
    let go = |loading: &Loading| {
        LoadingPath::follow(&contact, loading, &|_, _| ControlFlow::Continue(()))
    };
    let until = rational(1, 10);
    let short = go(&Loading {
        until: Some(until.clone()),
        ..Loading::of_the_paper()
    })
    .unwrap();
    assert_eq!(
        (
            short.end,
            short
                .intervals
                .last()
                .unwrap()
                .stop
                .as_ref()
                .unwrap()
                .motion()
        ),
        (PathEnd::Range, &until)
    );
    let stopped = LoadingPath::follow(&contact, &Loading::of_the_paper(), &|k, _| {
        if k == 1 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let stopped = stopped.unwrap();
    assert_eq!(
        (&stopped.end, stopped.intervals.len()),
        (&PathEnd::Interrupted, 1)
    );
    let whole_path = go(&Loading::of_the_paper()).unwrap();
    assert!(whole_path.intervals.len() > 1 && !stopped.slides() && whole_path.slides());
    for (loading, word) in [
        (paper(whole(0)), "friction"),
        (
            Loading {
                force: whole(-55),
                ..Loading::of_the_paper()
            },
            "force",
        ),
        (
            Loading {
                until: Some(whole(0)),
                ..Loading::of_the_paper()
            },
            "range",
        ),
    ] {
        let error = go(&loading).unwrap_err();
        assert!(
            matches!(&error, PathError::NotPositive { what, .. } if what.contains(word)),
            "{error}"
        );
        assert!(step_path(&contact, &loading, &whole(1), 1, &go_on).is_err() || word == "range");
    }
    assert!(step_path(&contact, &Loading::of_the_paper(), &whole(0), 1, &go_on).is_err());
    let third = |step: usize| {
        if step == 3 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    assert_eq!(
        step_path(&contact, &Loading::of_the_paper(), &until, 9, &third)
            .unwrap()
            .len(),
        3,
        "pressing and two steps"
    );
}

/// With much friction the wedge jams: a node sticks for ever, reactions grow without bound.
#[test]
fn a_jammed_block_does_not_slide() {
    let block = block(6, 3, MeshKind::Crossed, Plane::Stress);
    let path = follow(&block, &paper(whole(10)));
    assert_eq!(
        (&path.end, path.slides()),
        (&PathEnd::NoFurtherEvent, false)
    );
    let last = path.intervals.last().unwrap();
    assert!(last.stop.is_none() && last.states.contains(&ContactState::Stick));
    assert_eq!(
        last.problem(&block, None).map(|p| p.unknown()).ok(),
        last.counts()[1].gt(&0).then_some(Unknown::Mu)
    );
}

/// With mu = 5 the corner reaches its cone and can then neither stick nor slip (nor open): all sets
/// of states are refused exactly. Found by a sweep over meshes and mu; what was found is kept.
#[test]
fn a_path_may_end_without_continuation() {
    let block = block(8, 4, MeshKind::Crossed, Plane::Strain);
    let path = follow(&block, &paper(whole(5)));
    assert_eq!(path.intervals.len(), 1);
    let PathEnd::NoContinuation { causes, proved, .. } = &path.end else {
        panic!("{:?}", path.end)
    };
    assert_eq!(
        (causes, *proved, path.slides()),
        (&vec![Bound::Cone { node: 8, sign: -1 }], true, false)
    );
    let (t, n) = path.intervals[0].stop.as_ref().unwrap().reaction(8);
    assert_eq!(-t, whole(-5) * n, "on the left side of the cone");
    // The condensed slip equation of that node has the wrong sign: S_TT - mu S_NT < 0.
    let mut states = vec![ContactState::Stick; 9];
    states[8] = ContactState::Slip { sign: -1 };
    let pencil = Contact::of(&block).unwrap().pencils().of(&states).unwrap();
    assert!(pencil.a().get(0, 0) + whole(5) * pencil.b().get(0, 0) < whole(0));
}

/// Found by the same sweep: an opened node comes back into contact and must slip at once; the
/// active set goes round in circles and Lemke ends on a ray, so the states are found by trying all.
#[test]
fn a_gap_that_closes_is_passed_too() {
    let block = block(8, 4, MeshKind::UnionJack, Plane::Stress);
    let loading = Loading {
        until: Some(whole(15)),
        ..paper(whole(5))
    };
    let path = follow(&block, &loading);
    let closing: Vec<&Interval> = path
        .intervals
        .iter()
        .filter(|i| i.begin.causes == [Bound::Gap { node: 4 }])
        .collect();
    assert_eq!((closing.len(), &path.end), (1, &PathEnd::Range));
    assert_eq!(
        (closing[0].begin.finder, closing[0].states[4]),
        (Finder::Enumeration, ContactState::Slip { sign: 1 })
    );
    assert_eq!(
        (
            closing[0].start.displacement(4).1,
            closing[0].start.reaction(4)
        ),
        (whole(0), (whole(0), whole(0)))
    );
    assert!(closing[0].stop.as_ref().unwrap().reaction(4).1 < whole(0));
}

/// 800 elements. The path is computed, and only then compared with the paper.
#[test]
fn both_published_states_lie_on_the_path() {
    let block = Block::new(&BlockModel::of_the_paper()).unwrap();
    let path = follow(&block, &Loading::of_the_paper());
    assert!(path.slides());
    let at = |state: PublishedState| path.stretches_with(&state.states());
    assert_eq!(
        at(PublishedState::SeventeenSlip),
        vec![path.intervals.len() - 1],
        "the final state"
    );
    assert_eq!(at(PublishedState::FifteenSlip).len(), 1);
    // The corner node slips to the right in one short stretch, which steps of 0.01 mm may miss.
    let right: Vec<usize> = (0..path.intervals.len())
        .filter(|&k| path.intervals[k].counts()[2] > 0)
        .collect();
    assert_eq!(right, vec![1]);
    assert_eq!(
        path.intervals[1].states[20],
        ContactState::Slip { sign: -1 }
    );
    let short = &path.intervals[1];
    assert!(short.stop.as_ref().unwrap().motion() - short.start.motion() < rational(1, 100));
    // "11 or more nodes": the number of slip nodes takes every value on the way.
    let slips: Vec<usize> = path.intervals.iter().map(|i| i.counts()[1]).collect();
    assert!((2..=17).all(|n| slips.contains(&n)), "{slips:?}");
    // "Spreading from right to left": stick on the left, then slip to the left, then free, and
    // stick only shrinks.
    let stick = |k: &usize| {
        path.intervals[*k]
            .states
            .iter()
            .take_while(|s| **s == ContactState::Stick)
            .count()
    };
    for k in 2..path.intervals.len() {
        assert!(stick(&k) <= stick(&(k - 1)), "stretch {k}");
        let rest = path.intervals[k].states.iter().skip(stick(&k));
        assert_eq!(
            rest.take_while(|s| **s == ContactState::Slip { sign: 1 })
                .count(),
            slips[k],
            "stretch {k}"
        );
    }
    let problem = path.intervals[at(PublishedState::FifteenSlip)[0]]
        .problem(&block, None)
        .unwrap();
    assert_eq!(
        problem.sha256(),
        PublishedState::FifteenSlip
            .problem(&block)
            .unwrap()
            .sha256()
    );
}

/// The target: path with all events and the condensed pencil of every state within 5 s besides the
/// condensation. `cargo test --release --test paper -- --ignored --nocapture under_five_seconds`
#[test]
#[ignore = "a measurement, for the release profile"]
fn path_and_every_pencil_take_under_five_seconds() {
    use std::time::Instant;
    let block = Block::new(&BlockModel::of_the_paper()).unwrap();
    let start = Instant::now();
    let contact = Contact::of(&block).unwrap();
    let condensed = start.elapsed();
    let start = Instant::now();
    let path = LoadingPath::follow(&contact, &Loading::of_the_paper(), &|_, _| {
        ControlFlow::Continue(())
    })
    .unwrap();
    let followed = start.elapsed();
    let mut pencils = contact.pencils();
    let made = path
        .intervals
        .iter()
        .filter(|i| i.counts()[1] + i.counts()[2] > 0)
        .map(|i| pencils.of(&i.states).unwrap());
    let orders: Vec<usize> = made.map(|p| p.order()).collect();
    let all = start.elapsed();
    println!(
        "condensation {condensed:?}; path {followed:?}; path and pencils of orders {orders:?} \
         {all:?}"
    );
    let bits = |r: &Rational| (r.numer().bits(), r.denom().bits());
    println!(
        "bits: S {}, events {:?}",
        contact.bits(),
        path.intervals
            .iter()
            .map(|i| bits(i.start.motion()))
            .collect::<Vec<_>>()
    );
    assert!(all.as_secs_f64() < 5.0);
}

#[cfg(feature = "cli")]
mod cli {
    use std::process::{Command, Output};

    fn block(args: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_mceip"))
            .arg("block")
            .args(args)
            .output()
            .unwrap()
    }

    #[test]
    fn path_is_listed_as_text_and_json() {
        let args = ["--path", "--cells", "4x2", "--step", "0.01"];
        let text = block(&args);
        assert_eq!(text.status.code(), Some(0));
        let text = String::from_utf8(text.stdout).unwrap();
        assert!(
            text.contains("<<<<o") && text.contains("pressure vanishes") && text.contains("slides"),
            "{text}"
        );
        assert!(
            text.contains("stepping:") && text.contains("stretches none"),
            "{text}"
        );
        let json: serde_json::Value =
            serde_json::from_slice(&block(&[&args[..], &["--json"]].concat()).stdout).unwrap();
        let intervals = json["intervals"].as_array().unwrap();
        assert_eq!((intervals.len(), json["slides"].as_bool()), (7, Some(true)));
        assert_eq!(intervals[6]["to_mm"], serde_json::Value::Null);
        assert_eq!(intervals[1]["event"]["causes"][0]["node"], 5);
        assert_eq!(intervals[1]["states"][4], "slip left");
        let normal = intervals[0]["start"]["resultant_N_N"].as_f64().unwrap();
        assert_eq!(normal, -55.0, "correctly rounded from the exact -55");
        assert_eq!(
            json["stepping"]["other_states"].as_array().unwrap().len(),
            0
        );
    }

    #[cfg(unix)]
    #[test]
    fn an_interrupt_ends_the_condensation() {
        let mut command = Command::new(env!("CARGO_BIN_EXE_mceip"));
        let child = command
            .args(["block", "--path", "--cells", "40x20"])
            .stdout(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_secs(1)); // of a minute or so
        assert!(
            Command::new("kill")
                .args(["-INT", &child.id().to_string()])
                .status()
                .unwrap()
                .success()
        );
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130));
        assert!(output.stdout.is_empty());
    }

    #[test]
    fn bad_options_are_one_line_and_exit_2() {
        for (args, word) in [
            (&["--path", "--cells", "0x3"][..], "0 x 3"),
            (&["--path", "--cells", "20"], "--cells"),
            (&["--path", "--cells", "99999999x99999999"], "at most"),
            (&["--path", "--mesh", "hexagonal"], "union-jack"),
            (&["--path", "--plane", "shell"], "strain"),
            (&["--path", "--cells", "2x1", "--mu", "-1"], "friction"),
            (&["--path", "--cells", "2x1", "--mu", "much"], "--mu"),
            (&["--path", "--cells", "2x1", "--force", "0"], "force"),
            (&["--path", "--cells", "2x1", "--height", "0"], "height"),
            (&["--path", "--cells", "2x1", "--step", "0"], "--step"),
            (&["--path", "--cells", "2x1", "--step", "1e-9"], "--step"),
            (&["--mu", "2"], "--path"),
            (&["--path", "--state", "15"], "--state"),
        ] {
            let out = block(args);
            let err = String::from_utf8_lossy(&out.stderr).into_owned();
            assert_eq!(out.status.code(), Some(2), "{args:?}: {err}");
            assert!(
                out.stdout.is_empty() && err.lines().count() == 1 && err.contains(word),
                "{args:?}: {err}"
            );
        }
    }
}
