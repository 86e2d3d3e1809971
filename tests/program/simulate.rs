//! `mceip simulate` from outside: exit codes, text, `mceip-motion/1`, pictures, refusals.
//!
//! The truth is lambda^2 of Table 1 and of the point on its floor, K* = 2 - 3/2 mu and M* = 1
//! there, and cosh. Another growth, a verdict without its proof, or a motion where a step has
//! several solutions fails.
#![cfg(feature = "cli")]

use crate::common::{example, exits, exits_with_json, read, repository};
use crate::program::Folder;
use roxmltree::Document;
use serde_json::{Value, json};

fn simulate(code: i32, args: &str) -> String {
    exits(code, &format!("simulate {args}"))
}

fn simulate_json(code: i32, args: &str) -> Value {
    exits_with_json(code, &format!("simulate --json {args}"))
}

#[test]
fn certified_modes_grow_as_predicted() {
    let motion = simulate_json(0, &example("two-particles"));

    assert_eq!(motion["format"], "mceip-motion/1");
    let modes = motion["modes"].as_array().unwrap();
    let rates = [37.0_f64, 62.0, 62.0].map(|n| (n / 25.0).sqrt());
    assert_eq!(modes.len(), rates.len());
    for (mode, rate) in modes.iter().zip(rates) {
        assert_eq!(mode["agreement"], "AGREES");
        assert!((mode["order"].as_f64().unwrap() - 2.0).abs() < 0.01);

        let points = mode["points"].as_array().unwrap();
        assert!(points.len() > 100);
        for point in points {
            let [time, predicted, _, fine] = [0, 1, 2, 3].map(|k| point[k].as_f64().unwrap());
            let alpha = (rate * time).cosh();
            assert!((predicted / alpha - 1.0).abs() < 1e-9);
            assert!((fine / alpha - 1.0).abs() < 1e-5);
        }
    }

    for impulse in motion["impulses"].as_array().unwrap() {
        assert_eq!(impulse["class"], "growth along a constant direction");
        assert_eq!(impulse["resolved"], true);
    }
}

/// A mass of 1e-170 in its unit: lambda is 1e85 times as large, and nothing else differs.
#[test]
fn the_unit_of_mass_does_not_matter() {
    let folder = Folder::new();
    let mut problem: Value = serde_json::from_str(&read(&example("point"))).unwrap();
    problem["system"]["mass"] = json!([["1e-170", 0], [0, "1e-170"]]);
    let light = folder.write("light.json", &problem.to_string());

    for (file, rate) in [(example("point"), 0.5), (light, 0.5e85)] {
        let motion = simulate_json(0, &file);
        let mode = &motion["modes"][0];
        assert_eq!(mode["agreement"], "AGREES", "{file}");
        let points = mode["points"].as_array().unwrap();
        let end = points.last().unwrap();
        let [time, predicted] = [0, 1].map(|k| end[k].as_f64().unwrap());
        assert!((predicted / (rate * time).cosh() - 1.0).abs() < 1e-9);
    }
}

/// K* = 0 at mu = 4/3: alpha is linear.
#[test]
fn at_the_threshold_the_departure_is_linear() {
    let motion = simulate_json(0, &format!("{} --friction 4/3", example("point")));

    let mode = &motion["modes"][0];
    assert_eq!(mode["agreement"], "AGREES");
    assert!(mode["order"].is_null());
    let points = mode["points"].as_array().unwrap();
    let end = points.last().unwrap();
    assert!((end[3].as_f64().unwrap() - 2.0).abs() < 1e-9);
}

/// The dots of a picture: time and value.
fn dots(svg: &str) -> Vec<(f64, f64)> {
    let tree = Document::parse(svg).unwrap();
    let is_dot = |node: &roxmltree::Node<'_, '_>| node.attribute("class") == Some("point");
    let mut dots = Vec::new();
    for node in tree.descendants().filter(is_dot) {
        let [x, y] = ["data-x", "data-y"].map(|name| node.attribute(name).unwrap());
        dots.push((x.parse().unwrap(), y.parse().unwrap()));
    }

    dots
}

/// Every dot lies on cosh(rate t), and the last ones have grown.
#[track_caller]
fn dots_lie_on_cosh(svg: &str, rate: f64) {
    let dots = dots(svg);
    assert!(dots.len() >= 20);
    for (time, value) in &dots {
        let alpha = (rate * time).cosh();
        assert!((value / alpha - 1.0).abs() < 1e-4, "{value} at {time}");
    }

    assert!(dots[dots.len() - 1].1 > 10.0);
}

#[test]
fn pictures_show_what_was_integrated() {
    let folder = Folder::new();
    let point = example("point");
    let of_mode = folder.path("mode.svg");
    let of_impulses = folder.path("impulses.svg");

    simulate(0, &format!("{point} --picture {of_mode}"));
    simulate(0, &format!("{point} --friction 1 --picture {of_impulses}"));

    // mu = 3/2: lambda^2 = 1/4.
    dots_lie_on_cosh(&read(&of_mode), 0.5);
    let svg = read(&of_impulses);
    assert!(dots(&svg).is_empty());
    assert_eq!(svg.matches("class=\"series\"").count(), 2);
}

/// The block's 17-slip state at mu = 2; lambda^2 is certified (spec/motion.md).
#[test]
fn the_figure_of_the_book_shows_the_blocks_mode() {
    let figure = read(&repository("spec/figures/motion-17-slip.svg"));

    dots_lie_on_cosh(&figure, 1387.354619);
}
