//! Every state of the block's loading path that has a solution: the search by many starts finds it
//! from [0, infinity), without a window and without being told where to look.
//!
//! The truth is the complete sets, proved. A solution that is missed lowers the count of those
//! found; a claim that no solution of the complete set confirms fails at once.
#![cfg(feature = "testkit")]

use crate::paper_path::{path_of, slip_nodes};
use mceip_check::certificate::Claim;
use mceip_engine::multistart::{
    CertifiedCandidate, MultistartFound, Search, exact_value, multistart, support,
};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::to_f64;
use mceip_model::Problem;
use mceip_model::reduction::reduce;
use mceip_paper::{Block, BlockModel, MassKind};

/// Counts over all states with slip nodes.
#[derive(Debug, Default, PartialEq, Eq)]
struct Tally {
    states: usize,
    /// States that have a solution.
    solvable: usize,
    /// Solutions of all states.
    solutions: usize,
    /// Solutions that the search found.
    found: usize,
    pivots: usize,
    factorisations: usize,
}

fn search_the_path(block: &Block, how: &Search) -> Tally {
    let contact = block.contact_side().unwrap();
    let path = path_of(&contact);

    let mut tally = Tally::default();
    for stretch in &path.stretches {
        if slip_nodes(stretch) == 0 {
            continue;
        }

        let problem = block.problem(&stretch.states, None).unwrap();
        let truth = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();
        assert!(truth.is_complete());

        let solutions = &truth.cover.solutions;

        let found = search(&problem, how);
        let mut seen = 0;

        for solution in solutions {
            let value = to_f64(&solution.value.mid());
            let Some(certified) = find(&found, value, &solution.support) else {
                continue;
            };

            println!(
                "{}: mu = {}, run {} ({:?})",
                stretch.picture(),
                certified.candidate.value,
                certified.run,
                certified.origin
            );
            let is_exact = exact_value(&certified.claim).is_some();
            let is_enclosed = matches!(certified.claim, Claim::EnclosedSolution(_));

            assert!(is_exact || is_enclosed);
            seen += 1;
        }

        // Nothing false: each claim is one of the complete set.
        assert_eq!(found.certified.len(), seen, "{}", stretch.picture());
        if seen < solutions.len() {
            let picture = stretch.picture();
            println!("{picture}: {seen} of {} found", solutions.len());
        }

        tally.states += 1;
        tally.solvable += usize::from(!solutions.is_empty());
        tally.solutions += solutions.len();
        tally.found += seen;
        tally.pivots += found.pivots;
        tally.factorisations += found.factorisations;
    }

    println!("{tally:?}");
    tally
}

/// What many starts find for a problem with unknown mu.
fn search(problem: &Problem, how: &Search) -> MultistartFound {
    let reduced = reduce(problem).unwrap();
    multistart(problem, &reduced, how, &Watch::nobody()).unwrap()
}

/// The certified solution with this slip set and, to 1e-6, this value.
fn find<'a>(
    found: &'a MultistartFound,
    value: f64,
    slip: &[usize],
) -> Option<&'a CertifiedCandidate> {
    found.certified.iter().find(|certified| {
        let error = (certified.candidate.value - value).abs();
        support(&certified.claim) == slip && error <= 1e-6 * value
    })
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

    assert!(tally.states >= 6, "{tally:?}");
    assert!(tally.solvable >= 2, "{tally:?}");
    assert_eq!(tally.found, tally.solutions);
}

/// `cargo test --release --test paper -- --ignored --nocapture path_found::`: the paper's block,
/// each of its 23 states.
#[test]
#[ignore = "minutes in the dev profile"]
fn every_solvable_state_of_the_path_is_found() {
    let block = Block::of_the_paper(MassKind::Lumped);

    let tally = search_the_path(&block, &without_windows());

    assert_eq!(tally.states, 23, "{tally:?}");
    assert_eq!(tally.found, tally.solutions, "{tally:?}");

    // None up to nine slip nodes but the corner's at the start; from ten on one each.
    assert_eq!(tally.solvable, 11, "{tally:?}");
    assert_eq!(tally.solutions, 11, "{tally:?}");
}
