//! `mceip block --lambda2`: what stands behind a growth rate, below and above 3,000 degrees of
//! freedom.
#![cfg(feature = "cli")]

use crate::common::{exits, exits_with_json};

/// By one start on a mesh.
const ONE_START: &str = "block --lambda2 2 --starts 1 --scale";

#[test]
fn a_mesh_too_large_to_certify_has_a_backward_error() {
    let text = exits(3, &format!("{ONE_START} 40x20"));
    assert!(text.contains("UNCERTIFIED: more than 3000 dofs; backward error "));

    let listed = exits_with_json(3, &format!("{ONE_START} 40x20 --json"));
    let solution = &listed["lambda2"][0]["solutions"][0];
    assert_eq!(solution["certified"], false);
    assert_eq!(solution["reason"], "more than 3000 dofs");
    let error = solution["backward_error"].as_str().unwrap();
    let error: f64 = error.parse().unwrap();
    assert!(0.0 < error && error < 1e-12, "{error}");
}

#[test]
fn a_certified_solution_has_none() {
    let listed = exits_with_json(0, &format!("{ONE_START} 6x3 --json"));

    let solution = &listed["lambda2"][0]["solutions"][0];
    assert_eq!(solution["certified"], true);
    assert!(solution["backward_error"].is_null());
}
