//! Replays the fuzz corpus and the regressions on stable, without a fuzzer.
#![cfg(feature = "testkit")]

use mceip_testkit::floors::Starts;
use mceip_testkit::targets::{self, Counter, TARGETS};
use std::path::{Path, PathBuf};

fn fuzz() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz")
}

fn replay(target: &str) {
    let (_, body) = TARGETS.iter().find(|t| t.0 == target).unwrap();
    let (mut count, mut bytes) = (0, 0);
    for folder in ["corpus", "regressions"] {
        let Ok(files) = std::fs::read_dir(fuzz().join(folder).join(target)) else {
            continue;
        };
        for file in files {
            let path = file.unwrap().path();
            println!("{}", path.display()); // shown when the body panics
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
    assert!(
        counter.shortfalls().is_empty(),
        "{:?}",
        counter.shortfalls()
    );
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

/// Every target has its three lines of glue, its entry for cargo, and a replay above.
#[test]
fn every_target_is_built_and_replayed() {
    let (cargo, this) = (
        std::fs::read_to_string(fuzz().join("Cargo.toml")).unwrap(),
        include_str!("fuzz_replay.rs"),
    );
    for (name, _) in TARGETS {
        let glue = std::fs::read_to_string(fuzz().join(format!("fuzz_targets/{name}.rs"))).unwrap();
        assert!(
            glue.lines().count() == 3 && glue.contains(&format!("targets::{name}(data)")),
            "{name}"
        );
        assert!(
            cargo.contains(&format!("name = \"{name}\""))
                && this.contains(&format!("replay(\"{name}\")")),
            "{name}"
        );
    }
    assert_eq!(cargo.matches("[[bin]]").count(), TARGETS.len());
}

/// The seeds of `corpus/certificate_reader`: `cargo test --test campaign -- --ignored
/// fuzz_replay::`.
#[test]
#[ignore = "writes the corpus"]
fn write_the_certificates() {
    for (k, text) in targets::certificate_seeds().into_iter().enumerate() {
        std::fs::write(
            fuzz().join(format!("corpus/certificate_reader/seed-{k}.json")),
            &text,
        )
        .unwrap();
        // Near misses, so that the fuzzer starts on both sides.
        for (m, (from, to)) in [
            ("\"1\"", "\"-1\""),
            ("[0]", "[1]"),
            ("\"0\"", "\"1\""),
            ("solution", "solutions"),
        ]
        .into_iter()
        .enumerate()
        {
            let near = text.replacen(from, to, 1);
            if near != text && text.len() < 20_000 {
                std::fs::write(
                    fuzz().join(format!("corpus/certificate_reader/near-{k}-{m}.json")),
                    near,
                )
                .unwrap();
            }
        }
    }
}
