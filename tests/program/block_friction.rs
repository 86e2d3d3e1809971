//! What is proved over the friction of the block with 17 slip nodes: the figure and the table of
//! `spec/paper-examples.md`, 7.5.
#![cfg(feature = "cli")]

use crate::common::{contains_all, exits, read, read_json, repository};
use crate::program::Folder;
use serde_json::json;

const FIGURE: &str = "spec/figures/block-friction.svg";
const PAGE: &str = "spec/paper-examples.md";

/// What the figure has of each range, and what a summary has of each row of the table.
const RANGES: [[&str; 2]; 3] = [
    ["stable", "0"],
    ["absent", "0.07125"],
    ["present", "1.7048058"],
];
const SENTENCES: [&str; 5] = [
    "stable for every mu above 0 up to 0.07125",
    "no such motion below mu = 1.70479011, and there is one at some mu up to 1.70480434",
    "present for every mu from 1.70480586 to 2.96123886",
    "at any mu above 0 up to 1.6977539",
    "at every mu from 1.71252442 to 2.13468664",
];

#[test]
fn the_figure_has_the_ranges_of_the_table() {
    let figure = read(&repository(FIGURE));
    let page = read(&repository(PAGE));
    let section = page.split("## 7.5").nth(1).unwrap();

    for [verdict, from] in RANGES {
        let range = format!("<g class=\"range {verdict} proved\" data-from=\"{from}");
        assert!(figure.contains(&range), "{range}");
    }
    assert!(figure.contains("every body within the radii of the data: 1.6978 to 1.7125"));

    for sentence in SENTENCES {
        let numbers = sentence.split([' ', ',']).filter(|word| word.contains('.'));
        for number in numbers {
            assert!(section.contains(number), "{number}");
        }
    }
}

#[test]
#[ignore = "half a minute in the dev profile"]
fn analyze_draws_the_figure_and_says_the_numbers() {
    let folder = Folder::new();
    let written = folder.path("block");
    let figures = folder.path("figures");
    exits(0, &format!("block --state 17 --lumped --write {written}"));

    let file = format!("{written}/block-17-slip.json");
    let mut problem = read_json(&file);
    problem["system"]["radii"] = json!({"stiffness": {"absolute": "5e-5"}});
    std::fs::write(&file, problem.to_string()).unwrap();
    let said = exits(
        0,
        &format!("analyze {file} --friction 1.1 --samples 0 --figures {figures}"),
    );

    contains_all(&said, &SENTENCES);
    let drawn = read(&format!("{figures}/presence.svg"));
    assert_eq!(drawn, read(&repository(FIGURE)));
}
