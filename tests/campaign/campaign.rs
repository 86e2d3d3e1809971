//! The campaign: equal for any number of threads, resumable, in parts; and engines that are wrong
//! on purpose, seen to be reported, shrunk, written and replayed.
#![cfg(feature = "testkit")]

use mceip::model::{Body, Pencil, Window};
use mceip::oracle::{Enumeration, enumerate};
use mceip::run::Cancel;
use mceip::testkit::Corner;
use mceip::testkit::campaign::{
    Campaign, Case, Engine, Enumerator, Event, FAMILIES, Finding, Id, Limit, Replay, State, case,
    judge, smaller, standard,
};
use std::collections::BTreeSet;

fn names(list: &[&str]) -> Vec<String> {
    list.iter().map(ToString::to_string).collect()
}

fn all_families() -> Vec<String> {
    FAMILIES.iter().map(|f| f.0.to_string()).collect()
}

/// Runs so many instances of each family from a state; also returns the replay files.
fn run(engines: &[Box<dyn Engine>], state: State, count: u64) -> (State, Vec<Replay>) {
    let mut replays = Vec::new();
    let campaign = Campaign {
        engines,
        limit: Limit::Count(count),
    };
    let state = campaign.run(state, &Cancel::new(), &mut |event| {
        if let Event::Disagreement(replay) = event {
            replays.push(replay.clone());
        }
    });
    (state, replays)
}

fn wrong(
    name: &'static str,
    answer: impl Fn(Enumeration) -> Enumeration + Sync + 'static,
) -> Vec<Box<dyn Engine>> {
    let answer = move |p: &Pencil, w: &Window| {
        enumerate(p, w)
            .map(|e| Some(answer(e)))
            .map_err(|e| e.to_string())
    };
    vec![Box::new(Enumerator { name, answer })]
}

fn instance(family: &str, index: u64) -> Case {
    case(&Id {
        family: family.into(),
        seed: 1,
        index,
    })
    .unwrap()
    .unwrap()
}

#[test]
fn every_family_is_clean_and_reaches_its_corners() {
    let (state, replays) = run(&standard(1), State::new(1, (0, 1), all_families()), 2);
    assert!(
        replays.is_empty() && state.disagreements() == 0,
        "{replays:#?}"
    );
    assert_eq!(state.instances(), 2 * FAMILIES.len() as u64);
    assert!(
        state.tallies.iter().map(|t| t.closed).sum::<u64>() > 20
            && state.tallies.iter().map(|t| t.forgeries).sum::<u64>() > 500
    );
    // Corners by the enumerator alone.
    let (state, _) = run(&[], State::new(2, (0, 1), all_families()), 24);
    let reached: BTreeSet<String> = state
        .tallies
        .iter()
        .flat_map(|t| t.corners.keys().cloned())
        .collect();
    use Corner::*;
    for corner in [
        Biactive,
        Repeated,
        ZeroValue,
        WideKernel,
        Singular,
        Threshold,
        OneByOne,
        FreeVariables,
        Oblique,
        Stick,
        CoupledMass,
        NearThreshold,
        IllConditioned,
        HugeScale,
        TinyScale,
        Planted,
        FiniteWindow,
        PointWindow,
        Empty,
    ] {
        assert!(
            reached.contains(&format!("{corner:?}")),
            "{corner:?} not reached"
        );
    }
}

#[test]
fn the_number_of_threads_and_of_parts_changes_nothing() {
    let families = names(&["table1-near", "digits", "degenerate", "known"]);
    let in_pool = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            run(&standard(1), State::new(4, (0, 1), families.clone()), 4)
                .0
                .to_json()
        })
    };
    let one = in_pool(1);
    assert_eq!(one, in_pool(4));
    // The instances of two parts are those of the whole.
    let ids = |shard, count| {
        (0..count)
            .map(|k| State::new(4, shard, families.clone()).id(k).to_string())
            .collect::<BTreeSet<String>>()
    };
    let parts: BTreeSet<String> = ids((0, 2), 8).union(&ids((1, 2), 8)).cloned().collect();
    assert_eq!(parts, ids((0, 1), 16));
    assert!(ids((0, 2), 8).is_disjoint(&ids((1, 2), 8)));
}

#[test]
fn a_campaign_goes_on_from_its_state_file() {
    let new = || State::new(3, (0, 1), names(&["planted", "zeros"]));
    let (first, _) = run(&[], new(), 3);
    let resumed = new().resumed(&first.to_json()).unwrap();
    assert_eq!(resumed, first);
    assert_eq!(run(&[], resumed, 8).0, run(&[], new(), 8).0);
    // Another campaign's state is refused, and so is what is no state.
    let refused = |state: State, word: &str| {
        let message = state.resumed(&first.to_json()).unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    };
    refused(
        State::new(9, (0, 1), names(&["planted", "zeros"])),
        "seed 9, got 3",
    );
    refused(State::new(3, (1, 2), names(&["planted", "zeros"])), "shard");
    refused(State::new(3, (0, 1), names(&["planted"])), "families");
    assert!(new().resumed("{}").is_err());
    // A stopped campaign has done nothing more.
    let campaign = Campaign {
        engines: &[],
        limit: Limit::Count(8),
    };
    assert_eq!(
        campaign.run(first.clone(), &Cancel::requested(), &mut |_| {}),
        first
    );
}

/// An enumerator that forgets solutions whose value is a repeated root.
#[test]
fn a_dropped_repeated_root_is_reported_shrunk_written_and_replayed() {
    let engines = wrong("drops repeated roots", |mut e| {
        e.solutions.retain(|s| s.multiplicity < 2);
        e
    });
    let (state, replays) = run(&engines, State::new(1, (0, 1), names(&["degenerate"])), 24);
    // The double root on the full support comes once in twelve.
    assert!(state.disagreements() >= 2);
    assert_eq!(state.disagreements(), replays.len());
    for replay in &replays {
        let again = Replay::from_json(&replay.to_json()).unwrap();
        assert_eq!(&again, replay);
        let found = judge(&again.case().unwrap(), &engines).findings;
        assert!(found.len() == 1 && found[0].disagreement.to_string() == replay.disagreement);
        // The engine is wrong, not the instance: the project's own engines agree.
        assert!(
            judge(&again.case().unwrap(), &standard(1))
                .findings
                .is_empty()
        );
        assert!(
            replay.file_name().starts_with("degenerate-1-")
                && replay.file_name().ends_with("enumerators.json")
        );
    }
}

/// Any solution at all is enough for this one: it must shrink to one variable and one-digit
/// numbers.
#[test]
fn shrinking_goes_to_the_smallest_instance() {
    let engines = wrong("forgets the last solution", |mut e| {
        e.solutions.pop();
        e
    });
    for family in ["elements", "states", "digits", "table1"] {
        let drawn = (0..20)
            .map(|k| instance(family, k))
            .find(|c| !judge(c, &engines).findings.is_empty())
            .unwrap();
        let finding: Finding = judge(&drawn, &engines).findings.remove(0);
        let (small, says) = mceip::testkit::campaign::shrink(&drawn, &finding, &engines);
        assert_eq!(says.kind(), finding.kind());
        assert_eq!(judge(&small, &engines).findings, [says]);
        match (small.instance.problem.body(), drawn.instance.problem.body()) {
            (Body::Pencil(p), Body::Pencil(_)) => {
                assert_eq!(p.order(), 1, "{family}");
                assert!(
                    p.a()
                        .entries()
                        .chain(p.b().entries())
                        .all(|e| e.2.numer().bits() <= 1 && e.2.denom().bits() == 1),
                    "{p:?}"
                );
            }
            // A system stays a system: one particle in impending slip.
            (Body::System(s), Body::System(_)) => assert_eq!(
                (s.particles().len(), s.slip_particles().len()),
                (1, 1),
                "{family}"
            ),
            _ => panic!("{family}: shrinking changed the structure"),
        }
    }
}

#[test]
fn smaller_cases_are_smaller_and_keep_the_closed_form_only_with_its_data() {
    let drawn = instance("table1", 0);
    let list = smaller(&drawn);
    assert!(
        list.iter().any(|c| c.instance.closed_form.is_some())
            && list.iter().any(|c| c.instance.closed_form.is_none())
    );
    for c in &list {
        assert_ne!(c.instance.problem, drawn.instance.problem);
        // Where the closed form stays, it is that of the problem: the pipeline agrees.
        if c.instance.closed_form.is_some() {
            assert!(judge(c, &standard(1)).findings.is_empty());
        }
    }
    assert!(smaller(&list[0]).iter().all(|c| c.id == drawn.id));
}

#[test]
fn wrong_answers_known_by_construction_and_panics_are_disagreements() {
    let mut planted = (0..20)
        .map(|k| instance("planted", k))
        .find(|c| c.expected.planted.is_some())
        .unwrap();
    assert!(judge(&planted, &standard(1)).findings.is_empty());
    planted.expected.planted.as_mut().unwrap().0 += mceip::exact::rational(1, 1_000_000_007);
    assert_eq!(
        judge(&planted, &standard(1)).findings[0].kind(),
        ("known answer", "known-answer")
    );
    let mut pareto = instance("pareto", 2);
    pareto.expected.count = Some(22);
    assert_eq!(
        judge(&pareto, &standard(1)).findings[0].kind(),
        ("known answer", "known-answer")
    );
    let mut known = instance("known", 3);
    known.expected.answer.as_mut().unwrap().solutions.pop();
    assert_eq!(
        judge(&known, &standard(1)).findings[0].kind(),
        ("known answer", "known-answer")
    );
    let engines = wrong("panics", |_| panic!("on purpose"));
    let found = judge(&known, &engines).findings;
    assert_eq!((found.len(), found[0].kind()), (1, ("panics", "panic")));
    assert!(found[0].disagreement.to_string().contains("on purpose"));
}

#[test]
fn an_instance_is_named_by_three_numbers() {
    for (name, _, _) in FAMILIES {
        let (a, b) = (instance(name, 7), instance(name, 7));
        assert_eq!(a.instance.problem, b.instance.problem, "{name}");
        assert_eq!(a.id.to_string(), format!("{name}:1:7"));
        assert!(
            (0..6).any(|k| instance(name, k).instance.problem != a.instance.problem),
            "{name}"
        );
    }
    assert!(
        case(&Id {
            family: "nothing".into(),
            seed: 1,
            index: 0
        })
        .is_err()
    );
}

#[test]
fn malformed_replays_are_refused() {
    let engines = wrong("forgets everything", |_| Enumeration::default());
    let text = run(&engines, State::new(1, (0, 1), names(&["pareto"])), 1).1[0].to_json();
    assert!(Replay::from_json(&text).is_ok());
    assert!(Replay::from_json(&text.replace("mceip-replay/1", "mceip-replay/2")).is_err());
    assert!(Replay::from_json(&text.replace("\"engine\"", "\"motor\"")).is_err());
    assert!(
        Replay::from_json(&text.replace("\"mceip-problem/1\"", "1"))
            .unwrap()
            .case()
            .is_err()
    );
}
