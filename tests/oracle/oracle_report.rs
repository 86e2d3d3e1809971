//! What `enumerate` prints and writes where the answer is more than a list, and its decimals.
//!
//! The truth are pencils whose cones, ranges and lines are known by hand; the JSON and the text
//! must both name them. Decimals of any length are compared with the exact number they stand for.
#![cfg(feature = "solver")]

use mceip_engine::report::{Claimed, Listed, Report, solutions_json, solutions_text};
use mceip_exact::{
    Algebraic, Integer, Poly, Rational, Sparse, nonnegative_roots, parse, to_decimal, whole,
};
use mceip_model::reduction::reduce;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::enumerate;
use serde_json::{Value, json};

/// The answer for a problem, as it is written and as it is printed.
struct Output {
    json: Value,
    text: String,
}

impl Output {
    fn solutions(&self) -> &[Value] {
        self.json["solutions"].as_array().unwrap()
    }

    fn assert_prints(&self, words: &str) {
        assert!(self.text.contains(words), "{}", self.text);
    }
}

/// Enumerates the solutions of a pencil and reports them.
fn report(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Output {
    let pencil = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap();
    let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
    let reduced = reduce(&problem).unwrap();
    let found = enumerate(&reduced.pencil, problem.window()).unwrap();

    let mut solutions = Vec::new();
    for solution in &found.solutions {
        solutions.push(Listed::of_solution(&problem, &reduced, solution));
    }
    let report = Report {
        problem: &problem,
        reduced: &reduced,
        solutions,
        claim: Claimed::complete_if(found.is_complete_list()),
        evidence: "test".into(),
        enumeration: Some(&found),
        cover: None,
    };

    Output {
        json: solutions_json(&report),
        text: solutions_text(&report),
    }
}

/// (t - 1) I: every x >= 0 solves it at t = 1.
#[test]
fn cones_stand_among_the_solutions_with_their_rays() {
    let output = report(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[]);
    assert_eq!(output.json["claim"], "complete");

    let mut slips = Vec::new();
    for solution in output.solutions() {
        slips.push(&solution["slip"]);
    }
    assert_eq!(slips, [&json!([0]), &json!([0, 1]), &json!([1])]);

    let cone = &output.solutions()[1];
    assert_eq!(cone["kernel_dimension"], json!(2));
    assert_eq!(cone["cone_dimension"], json!(2));
    assert_eq!(cone["x"], json!(["0.5", "0.5"]));
    let rays = json!([
        { "slip": [0], "biactive": [1], "x": ["1", "0"], "y": ["0", "0"] },
        { "slip": [1], "biactive": [0], "x": ["0", "1"], "y": ["0", "0"] },
    ]);
    assert_eq!(cone["rays"], rays);

    let single = &output.solutions()[0];
    assert_eq!(single["kernel_dimension"], json!(1));
    assert_eq!(single["rays"], Value::Null);

    output.assert_prints("cone of dimension 2 at 1, support [0, 1]");
    output.assert_prints("ray 1.000000 0.000000");
}

/// {0, 1}: x = (2 - t, 1) while y_2 = (t - 1)(2 - t) >= 0.
#[test]
fn continua_are_written_with_their_ends() {
    let output = report(
        &[&[1, -2, 1], &[2, -4, 3], &[-1, 0, 9]],
        &[&[0, 1, 0], &[0, 2, 0], &[1, 0, 0]],
        &[],
    );
    assert_eq!(output.json["claim"], "complete");

    let continuum = &output.json["continua"][0];
    assert_eq!(continuum["slip"], json!([0, 1]));
    assert_eq!(continuum["kernel"].as_array().unwrap().len(), 1);

    let from = &continuum["intervals"][0]["from"];
    assert_eq!(from["value"], json!("1"));
    assert_eq!(from["included"], json!(true));
    let to = &continuum["intervals"][0]["to"];
    assert_eq!(to["value"], json!("2"));
    assert_eq!(to["included"], json!(false));

    output.assert_prints("continuum: support [0, 1] has solutions for every value in [1, 2)");
}

/// (t - 1) I with a free variable: x_f, -x_f and the half-plane.
#[test]
fn lines_are_named_as_outside_the_propositions() {
    let output = report(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[0]);
    assert_eq!(output.solutions().len(), 3);

    let mut solutions = output.solutions().iter();
    let half_plane = solutions.find(|s| s.get("rays").is_some()).unwrap();
    assert_eq!(half_plane["lineality"], json!([["1", "0"]]));
    assert_eq!(half_plane["rays"][0]["x"], json!(["0", "1"]));

    output.assert_prints("line 1.000000 0.000000 (either sign)");
    output.assert_prints("outside Propositions 1 and 2");
}

/// Half a unit in the last place of a decimal with this many digits, for 0.1 <= number < 10.
///
/// The last place is 10^-(digits - 1) from 1 on, and one lower below 1.
fn half_unit(number: &Algebraic, digits: u32) -> Rational {
    let is_at_least_one = number.clone().cmp_rational(&whole(1)).is_ge();
    let places = if is_at_least_one { digits - 1 } else { digits };
    Rational::new(1.into(), Integer::from(10).pow(places) * 2)
}

/// Any number of digits is the correct rounding: |value - decimal| is at most half a unit in the
/// last place.
#[test]
fn decimals_are_correctly_rounded_at_any_length() {
    let identity = Poly::from_ints(&[0, 1]);
    let polynomials_and_roots: [(&[i64], usize); 3] = [
        (&[-2, 0, 1], 0),
        (&[-1, -1, 0, 0, 0, 1], 0),
        (&[1, -10, 0, 3], 1),
    ];

    for (coefficients, root) in polynomials_and_roots {
        let poly = Poly::from_ints(coefficients);
        let mut number = nonnegative_roots(&poly).remove(root);

        for digits in [1, 2, 16, 17, 50, 300] {
            let printed = to_decimal(&mut number, &identity, digits);
            let decimal = parse(&printed).unwrap();

            let half = half_unit(&number, digits as u32);
            let above_lower = number.cmp_rational(&(&decimal - &half)).is_ge();
            let below_upper = number.cmp_rational(&(&decimal + &half)).is_le();
            assert!(above_lower && below_upper, "{coefficients:?} {digits}");
        }
    }
}
