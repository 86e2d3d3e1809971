//! The figure and the table of what a complete search costs.
//!
//! `spec/figures/complete-cost.svg` is drawn from the table beside it, which `cargo bench --bench
//! complete -- cost` measures. The figure must be that of the table, a table of another shape must
//! be refused, and a small mesh, searched here, must have the counts of its row. With
//! `MCEIP_DRAW=1` the figure is drawn anew.
#![cfg(all(feature = "testkit", feature = "picture"))]

use crate::cost::{CSV, HEAD, Run, SVG, picture, read};
use mceip_check::check;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_model::reduction::reduce;
use mceip_testkit::refined_block;

/// The rows of the table in the repository.
fn runs_of_the_table() -> Vec<Run> {
    let text = std::fs::read_to_string(CSV).unwrap();
    read(&text).unwrap()
}

/// Has the table a run of this case with so many slip nodes?
fn has_run(runs: &[Run], case: &str, slip: usize) -> bool {
    for run in runs {
        if run.case == case && run.slip >= slip {
            return true;
        }
    }
    false
}

#[test]
fn the_figure_is_that_of_the_table() {
    let runs = runs_of_the_table();
    let drawn = picture(&runs).to_svg();
    if std::env::var_os("MCEIP_DRAW").is_some() {
        std::fs::write(SVG, &drawn).unwrap();
    }
    assert_eq!(std::fs::read_to_string(SVG).unwrap(), drawn);

    // What the figure is about: one solution each, every set closed up to 80 nodes, the orders of
    // the issue among them.
    for run in &runs {
        assert_eq!(run.solutions, 1, "{run:?}");
        assert!(run.slip > 80 || run.open == 0, "{run:?}");
        assert!(run.check < run.complete, "{run:?}");
    }
    assert!(has_run(&runs, "all slip", 40));
    assert!(has_run(&runs, "all slip", 80));
    assert!(has_run(&runs, "a tenth stuck", 70));
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
    let line = run.line();
    let line_with_a_word = line.replace(",2,", ",two,");

    let with_a_comment = read(&format!("# a comment\n{HEAD}\n{line}\n"));
    assert_eq!(with_a_comment, Some(vec![run]));

    let without_head = read(&line);
    assert_eq!(without_head, None);
    let with_a_column_more = read(&format!("{HEAD}\n{line},9\n"));
    assert_eq!(with_a_column_more, None);
    let with_a_word_for_a_number = read(&format!("{HEAD}\n{line_with_a_word}\n"));
    assert_eq!(with_a_word_for_a_number, None);
}

/// The smallest mesh of the figure: closed, and its counts are those of the table.
#[test]
fn the_smallest_mesh_is_as_in_the_table() {
    let problem = refined_block(10, false).unwrap();
    let pencil = reduce(&problem).unwrap().pencil;
    let slip = pencil.slip().len();
    let runs = runs_of_the_table();
    let mut rows = runs.iter();
    let row = rows.find(|run| run.case == "all slip" && run.slip == slip);
    let row = row.unwrap();

    let found = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();

    let accepted = check(&problem, found.proved.certificate()).unwrap();
    let cover = accepted.cover.unwrap();
    assert_eq!(cover.solutions.len(), row.solutions);
    assert_eq!(cover.open.len(), row.open);
    assert_eq!(pencil.free().len(), row.free);
}
