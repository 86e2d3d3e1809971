//! Complete sets of systems with particles in contact with zero reaction (z), against
//! `enumerate_modes`, which lists all solutions by exact arithmetic.
//!
//! Random systems with one or two s particles, one or two z particles and others beside them. Each
//! solution that the cover yields must be in the list; each of the list must be yielded, or lie in
//! a region that the cover leaves open.
#![cfg(feature = "testkit")]

use crate::cover::disagreements;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_model::reduction::reduce_system;
use mceip_model::{Body, Problem, Window};
use mceip_oracle::{Enumeration, enumerate_modes};
use mceip_testkit::generators::states::ZeroModes;
use mceip_testkit::generators::{states, unknown};
use mceip_testkit::system_of;

/// Number of this family of random systems.
const FAMILY: u64 = 94;

/// Systems of the plain run and of the opt-in run.
const FEW: u64 = 24;
const MANY: u64 = 400;

/// Systems whose cover leaves nothing open, at least, in percent. Measured on 2026-11-23: 400 of
/// 400.
const CLOSED: u64 = 98;

/// What a run has met.
#[derive(Debug, Default)]
struct Met {
    systems: u64,
    closed: u64,
    absent: u64,
    degenerate: u64,
    solutions: u64,
    modes: ZeroModes,
}

fn random_problem(index: u64) -> Problem {
    let system = states::system_with_zero(FAMILY, index, 2, 3).unwrap();
    Problem::new(Body::System(system), unknown(index), Window::all()).unwrap()
}

fn compare(index: u64, met: &mut Met) {
    let problem = random_problem(index);
    let split = reduce_system(system_of(&problem), problem.unknown()).unwrap();
    let all = enumerate_modes(&split, &Window::all());
    if !all.degenerate.is_empty() {
        met.degenerate += 1;
        return;
    }

    let found = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();
    met.systems += 1;
    let truth = Enumeration {
        solutions: all.solutions.clone(),
        ..Enumeration::default()
    };
    assert_eq!(disagreements(&found.cover, &truth), [""; 0], "{index}");
    for yielded in &found.cover.solutions {
        met.modes.count(&split, &yielded.support);
    }

    met.solutions += found.cover.solutions.len() as u64;
    if found.is_complete() {
        met.closed += 1;
        met.absent += u64::from(all.solutions.is_empty());
    } else {
        println!("system {index}: {} regions open", found.cover.open.len());
    }
}

fn run(systems: std::ops::Range<u64>) -> Met {
    let mut met = Met::default();
    for index in systems {
        compare(index, &mut met);
    }

    println!("{met:?}");
    assert!(100 * met.closed >= CLOSED * met.systems, "{met:?}");
    met
}

#[test]
fn complete_sets_with_zero_reaction_are_those_of_the_modes() {
    let met = run(0..FEW);

    assert!(met.solutions >= 5 && met.absent >= 5, "{met:?}");
}

#[test]
#[ignore = "minutes in release"]
fn complete_sets_with_zero_reaction_of_hundreds_of_systems_are_those_of_the_modes() {
    let met = run(FEW..FEW + MANY);

    assert!(met.modes.rarest() >= 10, "{met:?}");
}
