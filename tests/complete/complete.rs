//! The complete search against the oracle on the embedded families: same set, and closed where it
//! can be.
#![cfg(feature = "testkit")]

use mceip_engine::reduction::reduce;
use mceip_oracle::enumerate;
use mceip_testkit::{Instance, compare_complete, degenerate, random_pencils, table1_grid};

/// Labels of the instances that stay undecided; a disagreement with the oracle fails the test.
fn undecided(instances: Vec<Instance>) -> Vec<String> {
    let closed = |i: &Instance| {
        let oracle = enumerate(&reduce(&i.problem).unwrap().pencil, i.problem.window()).unwrap();
        compare_complete(&i.problem, &oracle).unwrap_or_else(|d| panic!("{}: {d}", i.label))
    };
    instances
        .into_iter()
        .filter(|i| !closed(i))
        .map(|i| i.label)
        .collect()
}

fn without_free(list: Vec<Instance>) -> Vec<Instance> {
    list.into_iter()
        .filter(|i| reduce(&i.problem).unwrap().pencil.free().is_empty())
        .collect()
}

#[test]
fn random_pencils_are_completed() {
    let instances = without_free(random_pencils(200, 5).unwrap());
    assert!(instances.len() > 80);
    assert_eq!(undecided(instances), Vec::<String>::new());
}

/// On, just below and just above every threshold.
#[test]
fn the_two_particles_are_completed() {
    assert_eq!(
        undecided(table1_grid().unwrap().into_iter().take(120).collect()),
        Vec::<String>::new()
    );
}

/// Double roots, wide kernels, singular supports: closed as well.
#[test]
fn degenerate_instances_are_completed() {
    let instances = without_free(degenerate().unwrap());
    assert!(instances.len() > 5);
    assert_eq!(undecided(instances), Vec::<String>::new());
}
