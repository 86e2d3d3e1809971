//! The campaign: equal for any number of threads, resumable, in parts; and engines that are wrong
//! on purpose, whose faults are reported, shrunk, written and replayed.
//!
//! The truth is known by construction: an engine that forgets solutions must be reported, and the
//! project's own engines must not. A campaign that compares nothing, or loses what it found, fails.
#![cfg(feature = "testkit")]

use mceip_engine::run::Cancel;
use mceip_model::{Body, Pencil, Window};
use mceip_oracle::{Enumeration, enumerate};
use mceip_testkit::Corner;
use mceip_testkit::campaign::{
    Campaign, CampaignCase, CampaignEvent, CampaignLimit, Engine, Enumerator, FAMILIES, Finding,
    Id, Replay, State, case, judge, shrink, smaller, standard,
};
use std::collections::BTreeSet;

fn names(list: &[&str]) -> Vec<String> {
    list.iter().map(ToString::to_string).collect()
}

fn all_families() -> Vec<String> {
    FAMILIES.iter().map(|f| f.0.to_string()).collect()
}

/// The end of a campaign, and the replay files that it wrote.
struct Outcome {
    state: State,
    replays: Vec<Replay>,
}

/// Runs so many instances of each family from a state.
fn run(engines: &[Box<dyn Engine>], state: State, count: u64) -> Outcome {
    let mut replays = Vec::new();
    let campaign = Campaign {
        engines,
        limit: CampaignLimit::Count(count),
    };
    let state = campaign.run(state, &Cancel::new(), &mut |event| {
        if let CampaignEvent::Disagreement(replay) = event {
            replays.push(replay.clone());
        }
    });

    Outcome { state, replays }
}

/// An engine that enumerates and then changes its answer.
fn wrong(
    name: &'static str,
    change: impl Fn(Enumeration) -> Enumeration + Sync + 'static,
) -> Vec<Box<dyn Engine>> {
    let answer = move |pencil: &Pencil, window: &Window| match enumerate(pencil, window) {
        Ok(enumeration) => Ok(Some(change(enumeration))),
        Err(error) => Err(error.to_string()),
    };
    vec![Box::new(Enumerator { name, answer })]
}

/// An instance of seed 1.
fn instance(family: &str, index: u64) -> CampaignCase {
    let id = Id {
        family: family.into(),
        seed: 1,
        index,
    };

    case(&id).unwrap().unwrap()
}

/// A new campaign that is not divided into parts.
fn whole_campaign(seed: u64, families: Vec<String>) -> State {
    State::new(seed, (0, 1), families)
}

#[test]
fn every_family_is_clean_and_reaches_its_corners() {
    let Outcome { state, replays } = run(&standard(1), whole_campaign(1, all_families()), 2);
    assert!(replays.is_empty(), "{replays:#?}");
    assert_eq!(state.disagreements(), 0);
    assert_eq!(state.instances(), 2 * FAMILIES.len() as u64);

    let closed: u64 = state.tallies.iter().map(|tally| tally.closed).sum();
    let forgeries: u64 = state.tallies.iter().map(|tally| tally.forgeries).sum();
    assert!(closed > 20, "{closed}");
    assert!(forgeries > 500, "{forgeries}");

    // Corners by the enumerator alone.
    let state = run(&[], whole_campaign(2, all_families()), 24).state;
    let mut reached: BTreeSet<String> = BTreeSet::new();

    for tally in &state.tallies {
        reached.extend(tally.corners.keys().cloned());
    }

    for corner in Corner::ALL {
        let name = format!("{corner:?}");
        assert!(reached.contains(&name), "{name} not reached");
    }
}

#[test]
fn the_number_of_threads_and_of_parts_changes_nothing() {
    let families = names(&["table1-near", "digits", "degenerate", "known"]);

    let by_one = state_with_threads(1, &families);
    let by_four = state_with_threads(4, &families);
    assert_eq!(by_one, by_four);

    // The instances of two parts are those of the whole.
    let whole = instances_of_part((0, 1), &families, 16);
    let first = instances_of_part((0, 2), &families, 8);
    let second = instances_of_part((1, 2), &families, 8);
    let both: BTreeSet<String> = first.union(&second).cloned().collect();

    assert_eq!(both, whole);
    assert!(first.is_disjoint(&second));
}

/// The state file of a campaign by so many threads.
fn state_with_threads(threads: usize, families: &[String]) -> String {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    let new = whole_campaign(4, families.to_vec());

    pool.install(|| run(&standard(1), new, 4).state.to_json())
}

/// The names of the first instances of a part: its number from 0, and how many parts there are.
fn instances_of_part(part: (u64, u64), families: &[String], count: u64) -> BTreeSet<String> {
    let state = State::new(4, part, families.to_vec());
    (0..count).map(|k| state.id(k).to_string()).collect()
}

#[test]
fn a_campaign_goes_on_from_its_state_file() {
    let families = names(&["planted", "zeros"]);
    let new = whole_campaign(3, families.clone());

    let first = run(&[], new.clone(), 3).state;
    let resumed = new.clone().resumed(&first.to_json()).unwrap();
    assert!(resumed.is_bound());
    assert_eq!(resumed.to_json(), first.to_json());

    let continued = run(&[], resumed, 8).state;
    let at_once = run(&[], new.clone(), 8).state;
    assert_eq!(continued.to_json(), at_once.to_json());

    // Another campaign's state is refused, and so is what is no state.
    for (other, word) in [
        (whole_campaign(9, families.clone()), "seed 9, got 3"),
        (State::new(3, (1, 2), families), "shard"),
        (whole_campaign(3, names(&["planted"])), "families"),
    ] {
        let message = other.resumed(&first.to_json()).unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    }

    assert!(new.resumed("{}").is_err());

    // A stopped campaign has done nothing more.
    let campaign = Campaign {
        engines: &[],
        limit: CampaignLimit::Count(8),
    };
    let stopped = campaign.run(first.clone(), &Cancel::requested(), &mut |_| {});

    assert_eq!(stopped, first);
}

/// An enumerator that forgets solutions whose value is a repeated root.
#[test]
fn a_dropped_repeated_root_is_reported_shrunk_written_and_replayed() {
    let engines = wrong("drops repeated roots", |mut enumeration| {
        enumeration.solutions.retain(|s| s.multiplicity < 2);
        enumeration
    });

    let new = whole_campaign(1, names(&["degenerate"]));
    let Outcome { state, replays } = run(&engines, new, 24);

    // The double root on the full support comes once in twelve.
    assert!(state.disagreements() >= 2);
    assert_eq!(state.disagreements(), replays.len());

    for replay in &replays {
        let again = Replay::from_json(&replay.to_json()).unwrap();
        assert_eq!(&again, replay);

        let case = again.case().unwrap();
        let found = judge(&case, &engines).findings;
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].disagreement.to_string(), replay.disagreement);

        // The engine is wrong, not the instance: the project's own engines agree.
        assert!(judge(&case, &standard(1)).findings.is_empty());

        let file_name = replay.file_name();
        assert!(file_name.starts_with("degenerate-1-"), "{file_name}");
        assert!(file_name.ends_with("enumerators.json"), "{file_name}");
    }
}

/// Any solution at all is enough for this one: it must shrink to one variable and one-digit
/// numbers.
#[test]
fn shrinking_goes_to_the_smallest_instance() {
    let engines = wrong("forgets the last solution", |mut enumeration| {
        enumeration.solutions.pop();
        enumeration
    });

    for family in ["elements", "states", "digits", "table1"] {
        let drawn = (0..20)
            .map(|index| instance(family, index))
            .find(|case| !judge(case, &engines).findings.is_empty())
            .unwrap();
        let finding: Finding = judge(&drawn, &engines).findings.remove(0);

        let (small, same_finding) = shrink(&drawn, &finding, &engines);

        assert_eq!(same_finding.kind(), finding.kind());
        assert_eq!(judge(&small, &engines).findings, [same_finding]);

        match (small.instance.problem.body(), drawn.instance.problem.body()) {
            (Body::Pencil(pencil), Body::Pencil(_)) => {
                assert_eq!(pencil.order(), 1, "{family}");
                for (_, _, entry) in pencil.a().entries().chain(pencil.b().entries()) {
                    assert!(entry.numer().bits() <= 1, "{pencil:?}");
                    assert_eq!(entry.denom().bits(), 1, "{pencil:?}");
                }
            }
            // A system stays a system: one particle in impending slip.
            (Body::System(system), Body::System(_)) => {
                assert_eq!(system.particles().len(), 1, "{family}");
                assert_eq!(system.slip_particles().len(), 1, "{family}");
            }
            _ => panic!("{family}: shrinking changed the structure"),
        }
    }
}

#[test]
fn smaller_cases_are_smaller_and_keep_the_closed_form_only_with_its_data() {
    let drawn = instance("table1", 0);
    let list = smaller(&drawn);

    let mut with_closed_form = 0;
    for case in &list {
        assert_ne!(case.instance.problem, drawn.instance.problem);

        // Where the closed form stays, it is that of the problem: the pipeline agrees.
        if case.instance.closed_form.is_some() {
            assert!(judge(case, &standard(1)).findings.is_empty());
            with_closed_form += 1;
        }
    }

    assert!(with_closed_form > 0);
    assert!(with_closed_form < list.len());

    for case in smaller(&list[0]) {
        assert_eq!(case.id, drawn.id);
    }
}

#[test]
fn wrong_answers_known_by_construction_and_panics_are_disagreements() {
    let mut planted = (0..20)
        .map(|index| instance("planted", index))
        .find(|case| case.expected.planted.is_some())
        .unwrap();

    assert!(judge(&planted, &standard(1)).findings.is_empty());

    let (value, ..) = planted.expected.planted.as_mut().unwrap();
    *value += mceip_exact::rational(1, 1_000_000_007);
    contradicts_the_known_answer(&planted);

    let mut pareto = instance("pareto", 2);
    pareto.expected.count = Some(22);
    contradicts_the_known_answer(&pareto);

    let mut known = instance("known", 3);
    known.expected.answer.as_mut().unwrap().solutions.pop();
    contradicts_the_known_answer(&known);

    let engines = wrong("panics", |_| panic!("on purpose"));
    let found = judge(&known, &engines).findings;
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].kind(), ("panics", "panic"));
    assert!(found[0].disagreement.to_string().contains("on purpose"));
}

#[track_caller]
fn contradicts_the_known_answer(case: &CampaignCase) {
    let findings = judge(case, &standard(1)).findings;
    assert_eq!(findings[0].kind(), ("known answer", "known-answer"));
}

#[test]
fn an_instance_is_named_by_three_numbers() {
    for (name, _, _) in FAMILIES {
        let drawn = instance(name, 7);
        let problem = &drawn.instance.problem;
        let again = instance(name, 7);

        assert_eq!(*problem, again.instance.problem, "{name}");
        assert_eq!(drawn.id.to_string(), format!("{name}:1:7"));

        let mut others = (0..6).map(|index| instance(name, index));
        let one_differs = others.any(|other| other.instance.problem != *problem);
        assert!(one_differs, "{name}");
    }

    let unknown_family = Id {
        family: "nothing".into(),
        seed: 1,
        index: 0,
    };

    assert!(case(&unknown_family).is_err());
}

#[test]
fn malformed_replays_are_refused() {
    let engines = wrong("forgets everything", |_| Enumeration::default());
    let outcome = run(&engines, whole_campaign(1, names(&["pareto"])), 1);
    let text = outcome.replays[0].to_json();

    assert!(Replay::from_json(&text).is_ok());

    let other_version = text.replace("mceip-replay/1", "mceip-replay/2");
    assert!(Replay::from_json(&other_version).is_err());

    let other_field = text.replace("\"engine\"", "\"motor\"");
    assert!(Replay::from_json(&other_field).is_err());

    let no_problem = text.replace("\"mceip-problem/1\"", "1");
    let replay = Replay::from_json(&no_problem).unwrap();
    assert!(replay.case().is_err());
}
