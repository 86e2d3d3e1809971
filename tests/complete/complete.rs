//! The complete search on the families of the testkit.
//!
//! The truth is the exact enumerator: the search must list the same set, and close every instance.
#![cfg(feature = "testkit")]

use mceip_model::Pencil;
use mceip_model::reduction::reduce;
use mceip_testkit::{
    Instance, compare_complete, degenerate, enumerated, random_pencils, table1_grid,
};

fn pencil_of(instance: &Instance) -> Pencil {
    reduce(&instance.problem).unwrap().pencil
}

/// Is the instance closed? A disagreement with the enumerator fails the test.
fn is_closed(instance: &Instance) -> bool {
    let problem = &instance.problem;
    let truth = enumerated(problem);

    match compare_complete(problem, &truth) {
        Ok(is_closed) => is_closed,
        Err(disagreement) => panic!("{}: {disagreement}", instance.label),
    }
}

fn assert_all_closed(instances: &[Instance]) {
    let mut undecided = Vec::new();
    for instance in instances {
        if !is_closed(instance) {
            undecided.push(&instance.label);
        }
    }
    assert!(undecided.is_empty(), "{undecided:?}");
}

fn without_free_variables(mut instances: Vec<Instance>) -> Vec<Instance> {
    instances.retain(|instance| pencil_of(instance).free().is_empty());
    instances
}

#[test]
fn random_pencils_are_completed() {
    let instances = without_free_variables(random_pencils(200, 5).unwrap());
    assert!(instances.len() > 80);
    assert_all_closed(&instances);
}

/// On, just below and just above every threshold.
#[test]
fn the_two_particles_are_completed() {
    let mut instances = table1_grid().unwrap();
    instances.truncate(120);
    assert_all_closed(&instances);
}

/// Double roots, wide kernels, singular supports: closed as well.
#[test]
fn degenerate_instances_are_completed() {
    let instances = without_free_variables(degenerate().unwrap());
    assert!(instances.len() > 5);
    assert_all_closed(&instances);
}
