//! The complete search against the oracle: same set, or honestly undecided.
#![cfg(feature = "testkit")]
#![allow(clippy::unwrap_used)]

use mceip::model::Problem;
use mceip::oracle::{Enumeration, enumerate};
use mceip::reduction::reduce;
use mceip::search::complete::{Completed, Options, complete};
use mceip::testkit::{Instance, degenerate, random_pencils, table1_grid};
use std::sync::atomic::AtomicBool;

fn search(problem: &Problem) -> Completed {
    complete(problem, &Options::default(), &AtomicBool::new(false), &|_| {}).unwrap()
}

fn truth(problem: &Problem) -> Enumeration {
    enumerate(&reduce(problem).unwrap().pencil, problem.window()).unwrap()
}

/// Every solution of the cover is one of the oracle's and, if nothing is open, the other way round.
fn agree(label: &str, completed: &Completed, truth: &Enumeration) {
    let found = &completed.cover.solutions;
    for s in found {
        let matches = truth.solutions.iter().filter(|t| {
            let mut value = t.value.clone();
            t.slip == s.support
                && value.cmp_rational(s.value.lo()) != std::cmp::Ordering::Less
                && value.cmp_rational(s.value.hi()) != std::cmp::Ordering::Greater
        });
        assert_eq!(matches.count(), 1, "{label}: {s:?} against the oracle");
    }
    if completed.is_complete() {
        assert_eq!(found.len(), truth.solutions.len(), "{label}: {found:?}");
    }
}

/// Share of instances that stay undecided.
fn campaign(instances: &[Instance]) -> f64 {
    let mut undecided = 0;
    for i in instances {
        let completed = search(&i.problem);
        agree(&i.label, &completed, &truth(&i.problem));
        if !completed.is_complete() {
            undecided += 1;
            let o = &completed.cover.open;
            println!(
                "undecided: {}: {} open, first moving {:?} undecided {:?} in [{}, {:?}]",
                i.label,
                o.len(),
                o[0].moving,
                o[0].undecided,
                o[0].min,
                o[0].max.as_ref().map(ToString::to_string)
            );
        }
    }
    println!("{undecided} of {} undecided", instances.len());
    undecided as f64 / instances.len().max(1) as f64
}

fn without_free(list: Vec<Instance>) -> Vec<Instance> {
    list.into_iter().filter(|i| reduce(&i.problem).unwrap().pencil.free().is_empty()).collect()
}

#[test]
fn random_pencils_are_completed() {
    assert!(campaign(&without_free(random_pencils(200, 5).unwrap())) < 0.01);
}

#[test]
fn the_two_particles_are_completed() {
    assert!(campaign(&table1_grid().unwrap()[..120]) < 0.2);
}

#[test]
fn degenerate_pencils_are_completed_or_left_open() {
    assert!(campaign(&without_free(degenerate().unwrap())) <= 1.0);
}
