//! The loading path of the block: its laws against the uncondensed K, its states against the paper.
//!
//! The path is computed on the condensed contact side. The truth is elimination in fractions on the
//! whole K, the model's own check of (7), and the two states that the paper prints. A wrong
//! condensation, a wrong sign or a missed event contradicts one of them.
#![cfg(feature = "solver")]

use crate::elimination::solve;
use crate::paper_path::{BlockPath, PAPER_PATH, PaperPath, follow_contact};
use mceip_engine::reduction::condense;
use mceip_exact::{Rational, rational, whole};
use mceip_model::file::{read_loads, write_loads};
use mceip_model::reduction::reduce;
use mceip_model::{
    Admissible, ContactState, ModelError, Particle, Pencil, Reaction, System, Unknown,
};
use mceip_paper::{Block, BlockModel, Loading, MeshKind, Plane, PublishedState};
use mceip_path::{
    Bound, Contact, Equilibrium, Finder, LoadSteps, LoadingPath, LoadingPathEnd, PathError, Stretch,
};
use std::ops::ControlFlow;

fn follow(block: &Block, loading: &Loading) -> BlockPath {
    let contact = block.contact_side().unwrap();
    follow_contact(&contact, loading).unwrap()
}

fn block(nx: usize, ny: usize, mesh: MeshKind, plane: Plane) -> Block {
    let cells = BlockModel::of_the_paper().with_cells(nx, ny);
    let model = BlockModel {
        mesh,
        plane,
        ..cells
    };

    Block::new(&model).unwrap()
}

/// The loading of the paper with another coefficient of friction.
fn paper(mu: Rational) -> Loading {
    Loading {
        friction: mu,
        ..Loading::of_the_paper()
    }
}

/// The whole block under the contact displacements of an equilibrium, by plain elimination in
/// fractions on the uncondensed K: forces vanish inside, and are the reactions on the contact side.
fn equilibrium_of_the_whole_block(block: &Block, stretch: &Stretch, depth: &Rational) {
    let at = &stretch.start;
    let given = contact_displacements(block, at, depth);
    let inside: Vec<usize> = (0..given.len()).filter(|&i| given[i].is_none()).collect();
    let displacement = complete_displacement(block, &given, &inside);

    let force = block.stiffness.times(&displacement);

    for (k, &node) in block.contact.iter().enumerate() {
        let (tangential, normal) = at.reaction(k);
        assert_eq!(force[2 * node], tangential);
        assert_eq!(-&force[2 * node + 1], normal);
    }

    assert!(inside.iter().all(|&i| force[i] == whole(0)));
}

/// The displacements of the contact nodes relative to the glued side; `None` for all other degrees
/// of freedom. The coordinate y points away from the obstacle, the normal displacement towards it.
fn contact_displacements(
    block: &Block,
    at: &Equilibrium,
    depth: &Rational,
) -> Vec<Option<Rational>> {
    let mut given: Vec<Option<Rational>> = vec![None; block.stiffness.rows()];
    for (k, &node) in block.contact.iter().enumerate() {
        let (tangential, normal) = at.displacement(k);
        given[2 * node] = Some(tangential + at.amount());
        given[2 * node + 1] = Some(depth - normal);
    }
    given
}

/// Solves K_ii w_i = -K_ic w_c for the degrees of freedom inside, by elimination.
fn complete_displacement(
    block: &Block,
    given: &[Option<Rational>],
    inside: &[usize],
) -> Vec<Rational> {
    // Each row of the system with its right side at the end.
    let mut rows: Vec<Vec<Rational>> = Vec::new();
    for &i in inside {
        let mut row: Vec<Rational> = Vec::new();
        for &j in inside {
            row.push(block.stiffness.get(i, j));
        }

        let mut force = whole(0);
        for (j, value) in given.iter().enumerate() {
            if let Some(value) = value {
                force += block.stiffness.get(i, j) * value;
            }
        }

        row.push(-force);
        rows.push(row);
    }

    let inner = solve(rows).unwrap();
    let mut displacement: Vec<Option<Rational>> = given.to_vec();
    for (&i, w) in inside.iter().zip(inner) {
        displacement[i] = Some(w);
    }
    displacement.into_iter().flatten().collect()
}

#[test]
fn equilibria_are_those_of_the_uncondensed_block() {
    let block = block(3, 1, MeshKind::Crossed, Plane::Stress);

    for mu in [rational(11, 10), rational(3, 10)] {
        let path = follow(&block, &paper(mu));
        let count = path.motion.stretches.len();
        assert!(path.motion.slides(), "{count}");
        assert!(count >= 4, "{count}");

        for stretch in &path.motion.stretches {
            equilibrium_of_the_whole_block(&block, stretch, &path.depth);
        }

        assert_eq!(
            path.pressed.resultants(),
            (whole(0), whole(-55)),
            "pressed symmetrically until N = 55"
        );
    }
}

/// The mean of the reactions at both ends of a stretch.
fn middle_reaction(stretch: &Stretch, k: usize) -> Reaction {
    let (start_tangential, start_normal) = stretch.start.reaction(k);
    let (stop_tangential, stop_normal) = stretch.stop.as_ref().unwrap().reaction(k);
    Reaction {
        tangential: (start_tangential + stop_tangential) / whole(2),
        normal: (start_normal + stop_normal) / whole(2),
    }
}

/// The system with the reactions in the middle of a stretch and these states. The model refuses
/// states that contradict the reactions.
fn system_in_the_middle(
    block: &Block,
    mu: &Rational,
    stretch: &Stretch,
    states: &[ContactState],
) -> Result<System, ModelError> {
    let mut particles = Vec::new();
    for (k, &state) in states.iter().enumerate() {
        let tangential = 2 * block.contact[k];
        particles.push(Particle {
            normal_direction: -1,
            reaction: Some(middle_reaction(stretch, k)),
            ..Particle::plain(tangential, tangential + 1, state)
        });
    }
    System::new(block.stiffness.clone(), None, Some(mu.clone()), particles)
}

/// Reactions in the middle of each stretch go through the model's own check of (7), states and
/// signs; with a wrong sign they do not.
#[test]
fn states_and_reactions_satisfy_7_in_the_middle_of_each_stretch() {
    let block = block(6, 3, MeshKind::Backslash, Plane::Strain);
    let mu = rational(11, 10);
    let path = follow(&block, &paper(mu.clone()));
    let mut left = 0;
    let mut right = 0;

    for stretch in path.motion.stretches.iter().filter(|i| i.stop.is_some()) {
        assert!(system_in_the_middle(&block, &mu, stretch, &stretch.states).is_ok());

        for (k, state) in stretch.states.iter().enumerate() {
            let ContactState::Slip { sign } = *state else {
                continue;
            };
            if sign > 0 {
                left += 1;
            } else {
                right += 1;
            }

            for wrong in [ContactState::Slip { sign: -sign }, ContactState::Stick] {
                let mut states = stretch.states.clone();
                states[k] = wrong;
                assert!(system_in_the_middle(&block, &mu, stretch, &states).is_err());
            }
        }
    }

    assert!(left > 5 && right > 0, "{left} {right}");
}

/// How far a node is from a bound: the distance to the side of the cone, the pressure, or the gap.
fn distance_to_bound(bound: &Bound, at: &Equilibrium, friction: &Rational) -> Rational {
    let (tangential, normal) = at.reaction(bound.node());
    let (_, normal_displacement) = at.displacement(bound.node());

    match bound {
        Bound::Cone { sign, .. } => -friction * normal - tangential * whole((*sign).into()),
        Bound::Pressure { .. } => -normal,
        _ => -normal_displacement,
    }
}

/// The bound that an event names is zero there and was not before; stretches join.
#[test]
fn events_are_located_exactly() {
    let block = block(6, 3, MeshKind::Backslash, Plane::Strain);
    let loading = paper(rational(11, 10));
    let path = follow(&block, &loading);
    let mut by_pressure = 0;
    let mut by_another_bound = 0;

    for pair in path.motion.stretches.windows(2) {
        let [before, after] = pair else {
            unreachable!()
        };
        let stop = before.stop.as_ref().unwrap();
        let start = &after.start;

        assert_eq!(stop.amount(), start.amount());
        assert!(before.start.amount() < stop.amount());

        for k in 0..7 {
            assert!(stop.reaction(k) == start.reaction(k));
            assert!(stop.displacement(k) == start.displacement(k));
        }

        for bound in &after.begin.causes {
            if matches!(bound, Bound::Pressure { .. }) {
                by_pressure += 1;
            } else {
                by_another_bound += 1;
            }

            let at_the_event = distance_to_bound(bound, stop, &loading.friction);
            let at_the_start = distance_to_bound(bound, &before.start, &loading.friction);
            assert_eq!(at_the_event, whole(0));
            assert!(at_the_start > whole(0));
        }

        let mut stretches = path.motion.stretches.iter();
        let index = stretches.position(|i| i.start.amount() == before.start.amount());
        assert_eq!(path.motion.ending(index.unwrap()), Some(&after.begin));
        assert!(!after.begin.changes.is_empty());
        assert_eq!(after.begin.finder, Finder::ActiveSet);
    }

    assert!(by_another_bound > 4, "{by_another_bound}");
    assert!(by_pressure > 1, "{by_pressure}");
    assert!(
        path.motion.stretches[0].counts()[2] > 0,
        "pressing an oblique mesh makes the corner slip to the right"
    );
}

#[test]
fn a_range_an_interrupt_and_refusals() {
    let contact = block(2, 1, MeshKind::Slash, Plane::Stress)
        .contact_side()
        .unwrap();
    let standard = Loading::of_the_paper();

    let until = rational(1, 10);
    let limited = Loading {
        until: Some(until.clone()),
        ..Loading::of_the_paper()
    };
    let short = follow_contact(&contact, &limited).unwrap().motion;
    let last_stop = short.stretches.last().unwrap().stop.as_ref().unwrap();

    assert_eq!(short.end, LoadingPathEnd::AllApplied);
    assert_eq!(last_stop.amount(), &until);

    let steps = standard.steps(&contact).unwrap();
    let stopped = LoadingPath::follow(&contact, &steps, &|at| stop_at(1, at.stretch)).unwrap();
    assert_eq!(stopped.end, LoadingPathEnd::Interrupted);
    assert_eq!(stopped.stretches.len(), 1);

    let whole_path = follow_contact(&contact, &standard).unwrap();
    assert!(whole_path.motion.stretches.len() > 1);
    assert!(!stopped.slides());
    assert!(whole_path.motion.slides());

    for (loading, word) in not_positive() {
        let error = loading.steps(&contact).unwrap_err();
        assert!(
            matches!(&error, PathError::NotPositive { what, .. } if what.contains(word)),
            "{error}"
        );
    }
}

/// The file of the block is the block: the path of what is read is that in mm and N, with the
/// pressing and the motion as its two steps.
#[test]
fn the_block_as_a_file_has_the_same_path() {
    let model = BlockModel::of_the_paper().with_cells(4, 2);
    let loading = Loading::of_the_paper();
    let expected = follow(&Block::new(&model).unwrap(), &loading);

    let written = write_loads(&model.loads(&loading).unwrap());
    let file = read_loads(&written, std::path::Path::new(".")).unwrap();
    let body = file.body;
    assert_eq!(body.system().friction(), Some(&loading.friction));
    assert_eq!(file.coordinates.unwrap().nodes().len(), 15 + 8);

    let contact = Contact::condense(body.system(), body.gaps(), body.loads()).unwrap();
    let steps = LoadSteps::new(loading.friction, vec![Some(whole(1)), None]);
    let path = LoadingPath::follow(&contact, &steps, &|_| ControlFlow::Continue(())).unwrap();

    let (press, motion) = path.stretches.split_first().unwrap();
    let pressed = press.stop.as_ref().unwrap();
    assert_eq!(pressed.resultants(), (whole(0), whole(-55)));
    assert_eq!(motion.len(), expected.motion.stretches.len());
    for (stretch, expected) in motion.iter().zip(&expected.motion.stretches) {
        assert_eq!(stretch.states, expected.states);
        assert_eq!(stretch.start.amount(), expected.start.amount());
        for node in 0..contact.nodes() {
            assert_eq!(stretch.start.reaction(node), expected.start.reaction(node));
            assert_eq!(
                stretch.start.displacement(node),
                expected.start.displacement(node)
            );
        }
    }
}

/// Progress that interrupts when `last` is reached.
fn stop_at(last: usize, index: usize) -> ControlFlow<()> {
    if index == last {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

/// Loadings with a number that is not positive, and a word of the refusal.
fn not_positive() -> [(Loading, &'static str); 3] {
    let no_friction = paper(whole(0));
    let pulled = Loading {
        force: whole(-55),
        ..Loading::of_the_paper()
    };
    let no_range = Loading {
        until: Some(whole(0)),
        ..Loading::of_the_paper()
    };

    [
        (no_friction, "friction"),
        (pulled, "force"),
        (no_range, "range"),
    ]
}

/// With much friction the wedge jams: a node sticks for ever, reactions grow without bound.
#[test]
fn a_jammed_block_does_not_slide() {
    let block = block(6, 3, MeshKind::Crossed, Plane::Stress);
    let path = follow(&block, &paper(whole(10)));
    assert_eq!(path.motion.end, LoadingPathEnd::NoFurtherEvent);
    assert!(!path.motion.slides());

    let last = path.motion.stretches.last().unwrap();
    assert!(last.stop.is_none());
    assert!(last.states.contains(&ContactState::Stick));

    let [_, left, _, _] = last.counts();
    let unknown = block
        .problem(&last.states, None)
        .map(|problem| problem.unknown());
    assert_eq!(unknown.ok(), (left > 0).then_some(Unknown::Mu));
}

/// With mu = 5 the corner reaches its cone and can then neither stick nor slip (nor open): all sets
/// of states are refused exactly. Found by a sweep over meshes and mu; what was found is kept.
#[test]
fn a_path_may_end_without_continuation() {
    let block = block(8, 4, MeshKind::Crossed, Plane::Strain);
    let path = follow(&block, &paper(whole(5)));
    assert_eq!(path.motion.stretches.len(), 1);
    assert!(!path.motion.slides());

    let LoadingPathEnd::NoContinuation { causes, why } = &path.motion.end else {
        panic!("{:?}", path.motion.end)
    };

    assert_eq!(causes, &[Bound::Cone { node: 8, sign: -1 }]);
    assert!(why.is_proved());

    let stop = path.motion.stretches[0].stop.as_ref().unwrap();
    let (tangential, normal) = stop.reaction(8);
    assert_eq!(
        -tangential,
        whole(-5) * normal,
        "on the left side of the cone"
    );

    // The condensed slip equation of that node has the wrong sign: S_TT - mu S_NT < 0.
    let mut states = vec![ContactState::Stick; 9];
    states[8] = ContactState::Slip { sign: -1 };
    let contact = block.contact_side().unwrap();
    let pencil = contact.pencils().of(&states).unwrap();
    let slip_stiffness = pencil.a().get(0, 0) + whole(5) * pencil.b().get(0, 0);

    assert!(slip_stiffness < whole(0));
}

/// Found by the same sweep: an opened node comes back into contact and must slip at once; the
/// active set returns to sets it has tried and Lemke ends on a ray, so the states are found by
/// trying all.
#[test]
fn a_gap_that_closes_is_passed_too() {
    let block = block(8, 4, MeshKind::UnionJack, Plane::Stress);
    let loading = Loading {
        until: Some(whole(15)),
        ..paper(whole(5))
    };

    let path = follow(&block, &loading);

    let closing: Vec<&Stretch> = path
        .motion
        .stretches
        .iter()
        .filter(|stretch| stretch.begin.causes == [Bound::Gap { node: 4 }])
        .collect();

    assert_eq!(closing.len(), 1);
    assert_eq!(path.motion.end, LoadingPathEnd::AllApplied);

    let closing = closing[0];
    assert_eq!(closing.begin.finder, Finder::Enumeration);
    assert_eq!(closing.states[4], ContactState::Slip { sign: 1 });
    assert_eq!(closing.start.displacement(4).1, whole(0));
    assert_eq!(closing.start.reaction(4), (whole(0), whole(0)));

    let (_, normal_at_the_end) = closing.stop.as_ref().unwrap().reaction(4);
    assert!(normal_at_the_end < whole(0));
}

const SLIPS_LEFT: ContactState = ContactState::Slip { sign: 1 };
const SLIPS_RIGHT: ContactState = ContactState::Slip { sign: -1 };

/// Through (10)-(16) and the uncondensed K.
fn condensed_by_reduction(block: &Block, states: &[ContactState]) -> Pencil {
    let problem = block.problem(states, None).unwrap();
    let reduced = reduce(&problem).unwrap().pencil;
    condense(&Admissible::new(&reduced, Unknown::Mu).unwrap()).unwrap()
}

/// Two ways to the same exact matrices: through (10)-(16) and the uncondensed K, and from C.
#[test]
fn pencils_are_those_of_the_reduction() {
    let stick = ContactState::Stick;
    let free = ContactState::Free;
    let states = [
        vec![stick, SLIPS_LEFT, SLIPS_LEFT, SLIPS_LEFT, free],
        vec![free, SLIPS_LEFT, SLIPS_RIGHT, stick, SLIPS_RIGHT],
        vec![SLIPS_LEFT; 5],
    ];
    let block = block(4, 2, MeshKind::UnionJack, Plane::Strain);
    let contact = block.contact_side().unwrap();
    let mut pencils = contact.pencils();

    for states in &states {
        let expected = condensed_by_reduction(&block, states);
        assert_eq!(pencils.of(states).unwrap(), expected);
    }

    assert!(matches!(
        pencils.of(&states[0][1..]),
        Err(PathError::Model(ModelError::Shape { .. }))
    ));
    assert!(matches!(
        pencils.of(&[stick; 5]),
        Err(PathError::Model(ModelError::NothingSlips))
    ));
}

/// 800 elements. The path is computed, and only then compared with the paper.
#[test]
fn both_published_states_lie_on_the_path() {
    let PaperPath { block, path, .. } = &*PAPER_PATH;
    assert!(path.slides());

    let seventeen = path.stretches_with(&PublishedState::SeventeenSlip.states());
    let fifteen = path.stretches_with(&PublishedState::FifteenSlip.states());
    let final_stretch = path.stretches.len() - 1;

    assert_eq!(seventeen, vec![final_stretch], "the final state");
    assert_eq!(fifteen.len(), 1);

    // The corner node slips to the right in one short stretch, which steps of 0.01 mm may miss.
    let right: Vec<usize> = (0..path.stretches.len())
        .filter(|&k| path.stretches[k].counts()[2] > 0)
        .collect();

    assert_eq!(right, vec![1]);

    let short = &path.stretches[1];
    assert_eq!(short.states[20], ContactState::Slip { sign: -1 });

    let length = short.stop.as_ref().unwrap().amount() - short.start.amount();
    assert!(length < rational(1, 100));

    // "11 or more nodes": the number of slip nodes takes every value on the way.
    let slips: Vec<usize> = path.stretches.iter().map(|i| i.counts()[1]).collect();
    assert!((2..=17).all(|n| slips.contains(&n)), "{slips:?}");

    // "Spreading from right to left": stick on the left, then slip to the left, then free, and
    // the stick nodes become fewer.
    for k in 2..path.stretches.len() {
        let states = &path.stretches[k].states;
        let stuck = leading_stick_nodes(states);
        let stuck_before = leading_stick_nodes(&path.stretches[k - 1].states);

        assert!(stuck <= stuck_before, "stretch {k}");

        let slip_left = ContactState::Slip { sign: 1 };
        let after_stick = states.iter().skip(stuck);
        let slipping = after_stick.take_while(|state| **state == slip_left);

        assert_eq!(slipping.count(), slips[k], "stretch {k}");
    }

    let on_the_path = block
        .problem(&path.stretches[fifteen[0]].states, None)
        .unwrap();
    let published = PublishedState::FifteenSlip.problem(block).unwrap();
    assert_eq!(on_the_path.sha256(), published.sha256());
}

/// How many nodes stick, counted from the left until one does not.
fn leading_stick_nodes(states: &[ContactState]) -> usize {
    states
        .iter()
        .take_while(|state| **state == ContactState::Stick)
        .count()
}

/// The target: path with all events and the condensed pencil of every state within 5 s besides the
/// condensation. `cargo test --release --test paper -- --ignored --nocapture under_five_seconds`
#[test]
#[ignore = "a measurement, for the release profile"]
fn path_and_every_pencil_take_under_five_seconds() {
    use std::time::Instant;

    let block = Block::new(&BlockModel::of_the_paper()).unwrap();
    let start = Instant::now();
    let contact = block.contact_side().unwrap();
    let condensed = start.elapsed();

    let start = Instant::now();
    let path = follow_contact(&contact, &Loading::of_the_paper()).unwrap();
    let followed = start.elapsed();

    let mut pencils = contact.pencils();
    let mut orders = Vec::new();

    for stretch in &path.motion.stretches {
        let [_, left, right, _] = stretch.counts();
        if left + right > 0 {
            orders.push(pencils.of(&stretch.states).unwrap().order());
        }
    }

    let all = start.elapsed();
    println!(
        "condensation {condensed:?}; path {followed:?}; path and pencils of orders {orders:?} \
         {all:?}"
    );

    let mut event_bits = Vec::new();
    for stretch in &path.motion.stretches {
        let motion = stretch.start.amount();
        event_bits.push((motion.numer().bits(), motion.denom().bits()));
    }

    println!("bits: S {}, events {event_bits:?}", contact.bits());
    assert!(all.as_secs_f64() < 5.0);
}

/// The condensation takes about a minute.
#[cfg(all(unix, feature = "cli"))]
#[test]
fn an_interrupt_ends_the_condensation() {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_mceip"));
    let child = command
        .args(["block", "--loads", "/dev/null", "--cells", "40x20"])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();

    crate::interrupt::interrupt(&child, std::time::Duration::from_millis(500));

    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(output.stdout.is_empty());
}
