//! What `enumerate` prints and writes where the answer is more than a list; decimals of any length.
#![cfg(feature = "solver")]

use mceip_engine::reduction::reduce;
use mceip_engine::report::{Claimed, Listed, Report, solutions_json, solutions_text};
use mceip_exact::{Integer, Poly, Rational, Sparse, nonnegative_roots, parse, to_decimal};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::enumerate;
use serde_json::{Value, json};

/// JSON and text for a pencil.
fn printed(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> (Value, String) {
    let pencil = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap();
    let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
    let reduced = reduce(&problem).unwrap();
    let found = enumerate(&reduced.pencil, problem.window()).unwrap();
    let solutions = found
        .solutions
        .iter()
        .map(|s| Listed::of_solution(&problem, &reduced, s))
        .collect();
    let claim = Claimed::complete_if(found.is_complete_list());
    let report = Report {
        problem: &problem,
        reduced: &reduced,
        solutions,
        claim,
        evidence: "test".into(),
        enumeration: Some(&found),
        cover: None,
    };
    (solutions_json(&report), solutions_text(&report))
}

#[test]
fn cones_stand_among_the_solutions_with_their_rays() {
    let (json, text) = printed(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[]);
    assert_eq!(json["claim"], "complete");
    let slips: Vec<&Value> = json["solutions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| &s["slip"])
        .collect();
    assert_eq!(slips, [&json!([0]), &json!([0, 1]), &json!([1])]);
    let cone = &json["solutions"][1];
    assert_eq!(
        (
            &cone["kernel_dimension"],
            &cone["cone_dimension"],
            &cone["x"]
        ),
        (&json!(2), &json!(2), &json!(["0.5", "0.5"]))
    );
    assert_eq!(
        cone["rays"],
        json!([{ "slip": [0], "biactive": [1], "x": ["1", "0"], "y": ["0", "0"] }, { "slip": [1], "biactive": [0], "x": ["0", "1"], "y": ["0", "0"] }])
    );
    assert_eq!(
        (
            &json["solutions"][0]["kernel_dimension"],
            &json["solutions"][0]["rays"]
        ),
        (&json!(1), &Value::Null)
    );
    assert!(
        text.contains("cone of dimension 2 at 1, slip [0, 1]")
            && text.contains("ray 1.000000 0.000000"),
        "{text}"
    );
}

#[test]
fn continua_are_written_with_their_ends() {
    // {0, 1}: x = (2 - t, 1) while y_2 = (t - 1)(2 - t) >= 0.
    let (json, text) = printed(
        &[&[1, -2, 1], &[2, -4, 3], &[-1, 0, 9]],
        &[&[0, 1, 0], &[0, 2, 0], &[1, 0, 0]],
        &[],
    );
    assert_eq!(json["claim"], "complete");
    let continuum = &json["continua"][0];
    assert_eq!(continuum["slip"], json!([0, 1]));
    let ends = &continuum["intervals"][0];
    assert_eq!(
        (&ends["from"]["value"], &ends["from"]["included"]),
        (&json!("1"), &json!(true))
    );
    assert_eq!(
        (&ends["to"]["value"], &ends["to"]["included"]),
        (&json!("2"), &json!(false))
    );
    assert_eq!(continuum["kernel"].as_array().unwrap().len(), 1);
    assert!(
        text.contains(
            "continuum: slip [0, 1] has solutions for every value in [1.000000, 2.000000)"
        ),
        "{text}"
    );
}

#[test]
fn lines_are_named_as_outside_the_propositions() {
    let (json, text) = printed(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[0]);
    assert_eq!(json["solutions"].as_array().unwrap().len(), 3); // x_f, -x_f, the half-plane
    let cone = json["solutions"]
        .as_array()
        .unwrap()
        .iter()
        .find(|s| s.get("rays").is_some())
        .unwrap();
    assert_eq!(
        (&cone["lineality"], &cone["rays"][0]["x"]),
        (&json!([["1", "0"]]), &json!(["0", "1"]))
    );
    assert!(
        text.contains("line 1.000000 0.000000 (either sign)")
            && text.contains("outside Propositions 1 and 2"),
        "{text}"
    );
}

/// Any number of digits is the correct rounding: |value - decimal| is at most half a unit in the
/// last place.
#[test]
fn decimals_are_correctly_rounded_at_any_length() {
    let t = Poly::from_ints(&[0, 1]);
    for (poly, root) in [
        (&[-2, 0, 1][..], 0),
        (&[-1, -1, 0, 0, 0, 1][..], 0),
        (&[1, -10, 0, 3][..], 1),
    ] {
        let mut number = nonnegative_roots(&Poly::from_ints(poly)).remove(root);
        for digits in [1, 2, 16, 17, 50, 300] {
            let printed: Rational = parse(&to_decimal(&mut number, &t, digits)).unwrap();
            // 0.1 <= value < 10 here: with one leading digit the last place is 10^-(digits - 1), or
            // one lower below 1.
            let places = digits as u32
                - u32::from(
                    number
                        .clone()
                        .cmp_rational(&Rational::from_integer(1.into()))
                        .is_ge(),
                );
            let half = Rational::new(1.into(), Integer::from(10).pow(places) * 2);
            assert!(
                number.cmp_rational(&(&printed - &half)).is_ge()
                    && number.cmp_rational(&(&printed + &half)).is_le(),
                "{poly:?} {digits}"
            );
        }
    }
}
