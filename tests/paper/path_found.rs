//! Every state of the block's loading path that has a solution: the search finds it from [0,
//! infinity), without a window and without being told where to look. Truth: the complete sets,
//! proved.
#![cfg(feature = "testkit")]

use mceip::exact::to_f64;
use mceip::model::{Admissible, Unknown};
use mceip::multistart::{Search, exact_value, multistart_large, support};
use mceip::reduction::reduce;
use mceip::run::Watch;
use mceip::search::complete::{Options, complete};
use mceip::source::path::{Contact, Loading, LoadingPath};
use mceip::source::{Block, BlockModel, MassKind};
use std::ops::ControlFlow;

/// Of all states with slip nodes: how many, how many have solutions, solutions, those found, work
/// (pivots, factorisations).
#[derive(Debug, Default, PartialEq, Eq)]
struct Tally {
    states: usize,
    solvable: usize,
    solutions: usize,
    found: usize,
    work: (usize, usize),
}

fn search_the_path(block: &Block, how: &Search) -> Tally {
    let contact = Contact::of(block).unwrap();
    let path = LoadingPath::follow(&contact, &Loading::of_the_paper(), &|_, _| {
        ControlFlow::Continue(())
    })
    .unwrap();
    let mut tally = Tally::default();
    for interval in &path.intervals {
        let [_, left, right, _] = interval.counts();
        if left + right == 0 {
            continue;
        }
        let problem = interval.problem(block, None).unwrap();
        let truth = complete(&problem, &Options::default(), &Watch::nobody()).unwrap();
        assert!(truth.is_complete());
        let pencil = reduce(&problem).unwrap().pencil;
        let admissible = Admissible::new(&pencil, Unknown::Mu).unwrap();
        let (found, _) = multistart_large(&problem, &admissible, how, &Watch::nobody()).unwrap();
        let meets = |value: f64, slip: &[usize]| {
            let same = |c: &&mceip::multistart::Certified| {
                support(&c.claim) == slip && (c.candidate.value - value).abs() <= 1e-6 * value
            };
            found.certified.iter().find(same)
        };
        tally.states += 1;
        tally.solvable += usize::from(!truth.cover.solutions.is_empty());
        tally.solutions += truth.cover.solutions.len();
        let seen: Vec<_> = truth
            .cover
            .solutions
            .iter()
            .filter_map(|s| meets(to_f64(&s.value.mid()), &s.support))
            .collect();
        for c in &seen {
            println!(
                "{}: mu = {}, run {} ({:?})",
                interval.picture(),
                c.candidate.value,
                c.run,
                c.origin
            );
            assert!(
                exact_value(&c.claim).is_some()
                    || matches!(c.claim, mceip::certificate::Claim::EnclosedSolution(_))
            );
        }
        // Nothing false: each claim is one of the complete set.
        assert_eq!(found.certified.len(), seen.len(), "{}", interval.picture());
        if seen.len() < truth.cover.solutions.len() {
            println!(
                "{}: {} of {} found",
                interval.picture(),
                seen.len(),
                truth.cover.solutions.len()
            );
        }
        tally.found += seen.len();
        tally.work.0 += found.pivots;
        tally.work.1 += found.factorisations;
    }
    println!("{tally:?}");
    tally
}

/// 22 starts and what follows from them, no window of section 4.
fn without_windows() -> Search {
    Search {
        window_starts: 0,
        ..Search::default()
    }
}

#[test]
fn every_solvable_state_of_a_small_block_is_found() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(8, 4)).unwrap();
    let tally = search_the_path(&block, &without_windows());
    assert!(tally.states >= 6 && tally.solvable >= 2, "{tally:?}");
    assert_eq!(tally.found, tally.solutions);
}

/// `cargo test --release --test paper -- --ignored --nocapture path_found::`: the paper's block,
/// each of its 23 states.
#[test]
#[ignore = "minutes in the dev profile"]
fn every_solvable_state_of_the_path_is_found() {
    let tally = search_the_path(&Block::of_the_paper(MassKind::Lumped), &without_windows());
    assert_eq!(
        (tally.states, tally.found),
        (23, tally.solutions),
        "{tally:?}"
    );
    // None up to nine slip nodes but the corner's at the start; from ten on one each.
    assert_eq!((tally.solvable, tally.solutions), (11, 11), "{tally:?}");
}
