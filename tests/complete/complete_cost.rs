//! `spec/figures/complete-cost.svg` is drawn from the table beside it, which `cargo bench --bench
//! complete -- cost` measures; a small mesh is measured here as there. With `MCEIP_DRAW=1` the
//! figure is drawn anew.
#![cfg(all(feature = "testkit", feature = "picture"))]

use crate::cost::{CSV, HEAD, Run, SVG, picture, read};
use mceip::check::check;
use mceip::reduction::reduce;
use mceip::run::Watch;
use mceip::search::complete::{Options, complete};
use mceip::testkit::refined_block;

#[test]
fn the_figure_is_that_of_the_table() {
    let runs = read(&std::fs::read_to_string(CSV).unwrap()).unwrap();
    if std::env::var_os("MCEIP_DRAW").is_some() {
        std::fs::write(SVG, picture(&runs).to_svg()).unwrap();
    }
    assert_eq!(
        std::fs::read_to_string(SVG).unwrap(),
        picture(&runs).to_svg()
    );
    // What the figure is about: one solution each, every set closed up to 80 nodes, the orders of
    // the issue among them.
    assert!(
        runs.iter()
            .all(|r| r.solutions == 1 && (r.slip > 80 || r.open == 0) && r.check < r.complete),
        "{runs:?}"
    );
    for (case, slip) in [("all slip", 40), ("all slip", 80), ("a tenth stuck", 70)] {
        assert!(
            runs.iter().any(|r| r.case == case && r.slip >= slip),
            "{case} {slip}"
        );
    }
}

#[test]
fn a_table_of_another_shape_is_refused() {
    let run = Run {
        case: "a".into(),
        slip: 1,
        free: 2,
        complete: 0.5,
        check: 0.25,
        leaves: 3,
        solutions: 1,
        open: 0,
        kilobytes: 4,
    };
    assert_eq!(
        read(&format!("# a comment\n{HEAD}\n{}\n", run.line())),
        Some(vec![run.clone()])
    );
    assert_eq!(read(&run.line()), None);
    assert_eq!(read(&format!("{HEAD}\n{},9\n", run.line())), None);
    assert_eq!(
        read(&format!("{HEAD}\n{}\n", run.line().replace(",2,", ",two,"))),
        None
    );
}

/// The smallest mesh of the figure: closed, and its counts are those of the table.
#[test]
fn the_smallest_mesh_is_as_in_the_table() {
    let problem = refined_block(10, false).unwrap();
    let pencil = reduce(&problem).unwrap().pencil;
    let found = complete(&problem, &Options::default(), &Watch::nobody()).unwrap();
    let cover = check(&problem, &found.certificate).unwrap().cover.unwrap();
    let runs = read(&std::fs::read_to_string(CSV).unwrap()).unwrap();
    let listed = runs
        .iter()
        .find(|r| r.case == "all slip" && r.slip == pencil.slip().len())
        .unwrap();
    assert_eq!(
        (cover.solutions.len(), cover.open.len()),
        (listed.solutions, listed.open)
    );
    assert_eq!(pencil.free().len(), listed.free);
}
