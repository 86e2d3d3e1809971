//! `spec/fold.md` and its figure: the fold of `spec/errata.md`, X9, as a body.
//!
//! With u = 1 + t and t = lambda^2 its solutions are the roots of
//!
//! ```text
//!     3 mu^2 - 4 u mu + u (u + 1) = 0,
//! ```
//!
//! which are real from u = 3 on. The smaller root is least at u = (3 + 2 sqrt 3) / 2, where
//! mu = 1 + sqrt(3) / 2.
//!
//! The figure is drawn from these roots, which the enumerator must confirm, and from
//! the bound that the page prints, which must lie below the fold. With `MCEIP_DRAW=1` the figure is
//! drawn anew.
#![cfg(feature = "cli")]

use crate::common::{example, exits_with_json, read};
use crate::program::Folder;
use mceip::picture::{Branches, ChartPoint, Picture, branch_picture};
use mceip_exact::{Rational, from_f64, rational, to_f64, whole};
use mceip_model::file::read_problem_file;
use mceip_model::{System, Unknown, Window};
use mceip_oracle::Enumeration;
use mceip_testkit::{at_lambda2, solutions_of, system_of};
use std::path::Path;

const PAGE: &str = "spec/fold.md";
const FIGURE: &str = "spec/figures/fold.svg";

/// The bound that the page prints, and the solution above it.
const ABSENT_BELOW: f64 = 1.86602389;
const SOLUTION: f64 = 1.86602541;

/// Levels of lambda^2 that are drawn: 2 + 2 s^2 with s from 0 to 1 in as many steps, so that they
/// are dense where both branches begin.
const LEVELS: u32 = 48;

/// The largest mu that is drawn.
const LARGEST_MU: f64 = 2.35;

/// Both solutions at a level of lambda^2 of at least 2: mu by the closed form.
fn roots(lambda2: f64) -> [f64; 2] {
    let u = 1.0 + lambda2;
    let half_distance = (u * (u - 3.0)).sqrt();
    [
        (2.0 * u - half_distance) / 3.0,
        (2.0 * u + half_distance) / 3.0,
    ]
}

fn point(mu: f64, lambda2: f64) -> ChartPoint {
    ChartPoint {
        mu,
        lambda2,
        support: vec![0, 1],
    }
}

fn picture() -> Picture {
    let mut levels = Vec::new();
    for k in 0..=LEVELS {
        let step = f64::from(k) / f64::from(LEVELS);
        let lambda2 = 2.0 + 2.0 * step * step;
        let drawn = roots(lambda2).into_iter().filter(|mu| *mu <= LARGEST_MU);
        levels.push(drawn.map(|mu| point(mu, lambda2)).collect());
    }

    let branches = Branches {
        levels,
        certified: vec![point(2.0, 2.0), point(2.0, 3.0)],
        absent_below: Some(ABSENT_BELOW),
    };
    branch_picture(
        "A fold: two solutions are born at \u{3bb}\u{b2} > 0",
        &branches,
    )
}

/// The body of the page.
pub(crate) fn fold_body() -> System {
    let problem = read_problem_file(Path::new(&example("fold-body"))).unwrap();
    system_of(&problem).clone()
}

#[test]
fn the_figure_is_the_closed_form() {
    let drawn = picture().to_svg();
    if std::env::var_os("MCEIP_DRAW").is_some() {
        std::fs::write(FIGURE, &drawn).unwrap();
    }

    assert_eq!(read(FIGURE), drawn);
}

/// The MCEIP-mu of a system at a fixed lambda^2, by the enumerator.
pub(crate) fn enumerate_at(system: &System, lambda2: &Rational, window: &Window) -> Enumeration {
    solutions_of(at_lambda2(system, lambda2).unwrap(), Unknown::Mu, window)
}

/// MCEIP-mu of K + lambda^2 M: two solutions from lambda^2 = 2 on, none below.
#[test]
fn the_enumerator_confirms_the_closed_form() {
    let system = fold_body();
    for k in 0..10 {
        let lambda2 = rational(2 * k + 1, 4);
        let found = enumerate_at(&system, &lambda2, &Window::all());

        if lambda2 < whole(2) {
            assert!(found.solutions.is_empty(), "{lambda2}");
            continue;
        }

        let expected = roots(to_f64(&lambda2));
        assert_eq!(found.solutions.len(), 2, "{lambda2}");
        for (solution, mu) in found.solutions.iter().zip(expected) {
            let value: f64 = solution.decimal(17).parse().unwrap();
            assert!((value - mu).abs() < 1e-14, "{lambda2}: {value} {mu}");
        }
    }
}

/// The page prints what the program prints: the bounds, on both sides of the fold, within 1e-6.
#[test]
fn the_page_prints_what_the_program_says() {
    let page = read(PAGE);
    let problem = example("fold-body");
    let folder = Folder::new();
    let proofs = folder.path("proofs");

    let command = format!("analyze {problem} --json --samples 4 --certificates {proofs}");
    let report = exits_with_json(0, &command);

    let summary = report["summary"].as_str().unwrap();
    let quoted: Vec<&str> = page.lines().filter_map(|l| l.strip_prefix("> ")).collect();
    let page_in_one_line = quoted.join(" ");
    assert!(page_in_one_line.contains(summary), "{summary}");
    assert!(summary.contains(&ABSENT_BELOW.to_string()), "{summary}");
    assert!(summary.contains(&SOLUTION.to_string()), "{summary}");

    // The fold is the root of 4 mu^2 - 8 mu + 1 above 1.
    let polynomial = |mu: f64| {
        let mu = from_f64(mu).unwrap();
        whole(4) * &mu * &mu - whole(8) * &mu + whole(1)
    };
    assert!(polynomial(ABSENT_BELOW) < whole(0));
    assert!(polynomial(SOLUTION) > whole(0));
    const { assert!((SOLUTION - ABSENT_BELOW) / SOLUTION <= 1e-6) };
}

/// The range below the bound is proved, so is presence where a certificate says so; what is only
/// sampled says so.
#[test]
fn ranges_say_what_is_proved_and_what_is_sampled() {
    let folder = Folder::new();
    let proofs = folder.path("proofs");
    let problem = example("two-particles");
    let command = format!("analyze {problem} --json --samples 5 --certificates {proofs}");
    let report = exits_with_json(0, &command);

    let ranges = report["ranges"].as_array().unwrap();
    assert_eq!(ranges[0]["verdict"], "absent");
    assert_eq!(ranges[0]["proved"], true);
    assert_eq!(ranges[0]["from"], "0");
    assert_eq!(ranges[0]["to"], report["critical"]["absent_below"]);

    for range in &ranges[1..] {
        let kind = if range["proved"] == true {
            "certificate"
        } else {
            "measured"
        };
        assert_eq!(range["verdict"], "present");
        assert_eq!(range["evidence"]["kind"], kind);
    }

    let sentences = report["sentences"].as_array().unwrap();
    for sentence in sentences.iter().filter(|s| s["topic"] == "ranges") {
        let text = sentence["text"].as_str().unwrap();
        let kind = sentence["evidence"]["kind"].as_str().unwrap();
        assert_eq!(text.contains("sampled"), kind == "measured", "{text}");
    }
}
