//! The worked examples of `spec/certificates.md`: the checker gives the verdict that the page
//! states, and every JSON block of the page stands in one of the files.
//!
//! The truth is the checker, and the files of `spec/examples/certificates` for the page. A block
//! that was changed on the page alone, or a kind of evidence without an example, fails here.

use crate::{read, root};
use mceip_check::Provable;
use mceip_check::certificate::{
    Certificate, CriticalCertificate, PresenceCertificate, StabilityCertificate,
};
use mceip_exact::rational;
use mceip_model::Problem;
use mceip_model::file::read_problem;
use std::collections::BTreeSet;

/// The files of the examples, in the repository.
const FOLDER: &str = "spec/examples/certificates";

/// The text of the file of an example.
fn text_of(file: &str) -> String {
    read(format!("{FOLDER}/{file}"))
}

/// What the checker says is proved by the certificate of an example.
fn accepted<C: Provable<Subject = Problem>>(name: &str) -> C::Accepted {
    let problem = text_of(&format!("{name}.problem.json"));
    let problem = read_problem(&problem, &root().join(FOLDER)).unwrap();
    let certificate = C::read(&text_of(&format!("{name}.json"))).unwrap();

    let checked = certificate.check(&problem);
    checked.unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The names of the examples: each has a problem and a certificate.
fn names() -> BTreeSet<String> {
    let files = std::fs::read_dir(root().join(FOLDER)).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());

    names
        .filter_map(|name| name.strip_suffix(".problem.json").map(str::to_string))
        .collect()
}

/// Kinds of evidence that the certificate of an example contains.
const EVIDENCE: [&str; 21] = [
    "\"exact_solution\"",
    "\"lifted_solution\"",
    "\"enclosed_solution\"",
    "\"farkas\"",
    "\"positive_definite\"",
    "\"weighted_definite\"",
    "\"ldl\"",
    "\"root\"",
    "\"support\": {",
    "\"tail\"]",
    "\"open\"",
    "\"condensation\"",
    "\"reversed\"",
    "\"infinity\"",
    "\"z\"",
    "\"friction\": \"1/2\"",
    "\"left_friction\"",
    "\"regular\"",
    "\"mceip-presence/1\"",
    "\"mceip-stability/1\"",
    "\"symmetric\"",
];

#[test]
fn the_checker_gives_each_example_its_verdict() {
    let names = names();
    let others = ["mcp", "critical", "presence", "stability"];
    let is_other = |name: &str| others.iter().any(|other| name.starts_with(other));
    for name in names.iter().filter(|name| !is_other(name)) {
        let accepted = accepted::<Certificate>(name);

        let open = accepted.cover.map_or(0, |cover| cover.open.len());
        assert_eq!(open, usize::from(name == "open"), "{name}");
    }

    assert!(names.len() > 15);
}

#[test]
fn the_checker_accepts_each_absence_below_a_friction() {
    for (name, below) in [
        ("critical", rational(3, 4)),
        ("critical-free", rational(1, 1)),
        ("critical-regular", rational(1, 1)),
    ] {
        let accepted = accepted::<CriticalCertificate>(name);
        assert_eq!(accepted.below, below, "{name}");
    }
}

#[test]
fn the_checker_accepts_each_presence_on_an_interval_of_friction() {
    for (name, from, to) in [
        ("presence", rational(5, 4), rational(2, 1)),
        ("presence-fold", rational(2, 1), rational(5, 2)),
        ("presence-free", rational(3, 1), rational(7, 2)),
    ] {
        let accepted = accepted::<PresenceCertificate>(name);
        assert_eq!((accepted.from, accepted.to), (from, to), "{name}");
    }
}

#[test]
fn the_checker_accepts_each_stability_on_an_interval_of_friction() {
    for (name, to) in [("stability", 1), ("stability-free", 2)] {
        let accepted = accepted::<StabilityCertificate>(name);
        assert_eq!(
            (accepted.from, accepted.to),
            (rational(0, 1), rational(to, 1)),
            "{name}"
        );
        assert!(accepted.is_of_every_motion, "{name}");
    }
}

#[cfg(feature = "solver")]
#[test]
fn the_plain_problem_has_the_solution_of_the_page() {
    use mceip_engine::lcp::{judge, read_mcp, read_solution};

    let problem = read_mcp(&text_of("mcp.problem.json")).unwrap();
    let solution = read_solution(&text_of("mcp.json")).unwrap();
    assert!(judge(&problem, &solution).is_ok());
}

#[test]
fn every_kind_of_evidence_has_an_example() {
    let all: Vec<String> = names()
        .iter()
        .map(|name| text_of(&format!("{name}.json")))
        .collect();

    for kind in EVIDENCE {
        assert!(all.iter().any(|text| text.contains(kind)), "{kind}");
    }
}

/// Text without blanks: the page breaks lines where the file does not.
fn dense(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
}

#[test]
fn every_block_of_the_page_stands_in_a_file() {
    let page = read("spec/certificates.md");
    let files: Vec<String> = names()
        .iter()
        .map(|name| dense(&text_of(&format!("{name}.json"))))
        .collect();

    let mut blocks = 0;
    for part in page.split("```json\n").skip(1) {
        let block = dense(part.split("```").next().unwrap());
        assert!(files.iter().any(|file| file.contains(&block)), "{part}");

        blocks += 1;
    }

    for name in names() {
        assert!(
            page.contains(&format!("(`{name}`")),
            "{name} is not in the page"
        );
    }

    assert!(blocks > 15, "{blocks}");
}
