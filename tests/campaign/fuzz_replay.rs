//! Replays the fuzz corpus and the regressions on the stable compiler, without a fuzzer.
//!
//! The truth is in the bodies of the fuzz targets, which compare the engine with the oracle and
//! panic on a difference. The floors of coverage notice a solver that finds fewer solutions than it
//! did.
#![cfg(feature = "testkit")]

use mceip_testkit::floors::Starts;
use mceip_testkit::targets::{self, Counter, TARGETS};
use std::path::{Path, PathBuf};

fn fuzz() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz")
}

fn replay(target: &str) {
    let (_, body) = TARGETS.iter().find(|t| t.0 == target).unwrap();
    let mut count = 0;
    let mut bytes = 0;

    for folder in ["corpus", "regressions"] {
        let Ok(files) = std::fs::read_dir(fuzz().join(folder).join(target)) else {
            continue;
        };
        for file in files {
            let path = file.unwrap().path();

            // Shown when the body panics.
            println!("{}", path.display());

            let data = std::fs::read(&path).unwrap();
            body(&data);
            count += 1;
            bytes += data.len();
        }
    }

    assert!(count >= 20, "{target}: only {count} inputs");
    assert!(
        bytes < 250_000,
        "{target}: {bytes} bytes of corpus, minimise it (cargo fuzz cmin)"
    );
}

/// The corpus has at least so many solvable inputs, and the solver found as much of them as the
/// floor asks for.
fn held_against_its_floor(counter: &Counter, least: u64) {
    let seen = counter.seen();
    println!("{seen:?}");
    assert!(seen.coverage[&Starts::Search].solvable >= least, "{seen:?}");

    let shortfalls = counter.shortfalls();
    assert!(shortfalls.is_empty(), "{shortfalls:?}");
}

#[test]
fn problem_reader() {
    replay("problem_reader");
}

#[test]
fn certificate_reader() {
    replay("certificate_reader");
}

#[test]
fn hostile_report() {
    replay("hostile_report");
}

#[test]
fn checker_against_forgeries() {
    replay("checker_against_forgeries");
}

#[test]
fn solver_against_oracle() {
    replay("solver_against_oracle");
    held_against_its_floor(&targets::SMALL_PENCILS, 10);
}

#[test]
fn mechanical_systems() {
    replay("mechanical_systems");
    held_against_its_floor(&targets::SYSTEMS, 10);
}

#[test]
fn two_particle_problems() {
    replay("two_particle_problems");
    held_against_its_floor(&targets::TWO_PARTICLES, 10);
}

#[test]
fn complete_against_plain() {
    replay("complete_against_plain");
}

#[test]
fn exact_against_naive() {
    replay("exact_against_naive");
}

/// Every target has a file of three lines that calls it, its entry for cargo, and a replay above.
#[test]
fn every_target_is_built_and_replayed() {
    let manifest = std::fs::read_to_string(fuzz().join("Cargo.toml")).unwrap();
    let this_file = include_str!("fuzz_replay.rs");

    for (name, _) in TARGETS {
        let file = fuzz().join(format!("fuzz_targets/{name}.rs"));
        let program = std::fs::read_to_string(file).unwrap();
        assert_eq!(program.lines().count(), 3, "{name}");
        assert!(
            program.contains(&format!("targets::{name}(data)")),
            "{name}"
        );

        assert!(manifest.contains(&format!("name = \"{name}\"")), "{name}");
        assert!(this_file.contains(&format!("replay(\"{name}\")")), "{name}");
    }

    assert_eq!(manifest.matches("[[bin]]").count(), TARGETS.len());
}

/// The seeds of `corpus/certificate_reader`: `cargo test --test campaign -- --ignored
/// fuzz_replay::`.
#[test]
#[ignore = "writes the corpus"]
fn write_the_certificates() {
    let folder = fuzz().join("corpus/certificate_reader");
    let changes = [
        ("\"1\"", "\"-1\""),
        ("[0]", "[1]"),
        ("\"0\"", "\"1\""),
        ("solution", "solutions"),
    ];

    for (k, text) in targets::certificate_seeds().into_iter().enumerate() {
        std::fs::write(folder.join(format!("seed-{k}.json")), &text).unwrap();

        // Certificates with one change, so that the fuzzer starts with rejected ones too.
        for (m, (from, to)) in changes.into_iter().enumerate() {
            let changed = text.replacen(from, to, 1);
            if changed != text && text.len() < 20_000 {
                std::fs::write(folder.join(format!("near-{k}-{m}.json")), changed).unwrap();
            }
        }
    }
}
