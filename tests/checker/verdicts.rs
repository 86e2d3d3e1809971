//! What the checker says of each file of `spec/corpus`, to the last digit: which obligation fails,
//! where, what was expected and what was got; for what is accepted, every value, interval, family
//! and open region that is proved. `tests/verdicts.txt` holds it. A line changes only with a
//! reason; new files of the corpus are added by
//!
//!     cargo test --test checker -- --ignored verdicts::write_the_verdicts

use mceip_check::certificate::Certificate;
use mceip_check::{audit, check};
use mceip_model::Problem;
use mceip_model::file::read_problem;
use serde_json::Value;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

/// The files whose certificates can be read, by name; hostile ones, which repeat a unit, are for
/// `corpus.rs`.
fn cases() -> Vec<(String, Problem, Certificate)> {
    let mut list = Vec::new();
    for kind in ["accept", "reject"] {
        for path in std::fs::read_dir(root().join("spec/corpus").join(kind))
            .unwrap()
            .map(|e| e.unwrap().path())
        {
            let file: Value =
                serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
            // Certificates of another kind.
            let is_plain = file["problem"]["format"] == "mceip-mcp/1";
            if file.get("repeat").is_some() || is_plain {
                continue;
            }
            let name = format!("{kind}/{}", path.file_stem().unwrap().to_str().unwrap());
            let text = file["certificate_text"]
                .as_str()
                .map_or_else(|| file["certificate"].to_string(), String::from);
            list.push((
                name,
                read_problem(&file["problem"].to_string(), Path::new("/")).unwrap(),
                Certificate::from_json(&text).unwrap(),
            ));
        }
    }
    list.sort_by(|a, b| a.0.cmp(&b.0));
    list
}

fn verdicts() -> String {
    let mut text = String::new();
    for (name, problem, certificate) in cases() {
        match check(&problem, &certificate) {
            Ok(accepted) => {
                for (k, claim) in accepted.claims.iter().enumerate() {
                    writeln!(
                        text,
                        "{name}: claim {k}: support {:?} in [{}, {}]",
                        claim.support,
                        claim.value.lo(),
                        claim.value.hi()
                    )
                    .unwrap();
                }
                let Some(cover) = accepted.cover else {
                    continue;
                };
                for s in &cover.solutions {
                    writeln!(
                        text,
                        "{name}: only support {:?} in [{}, {}]",
                        s.support,
                        s.value.lo(),
                        s.value.hi()
                    )
                    .unwrap();
                }
                for f in &cover.families {
                    let (from, to) = (
                        &f.from,
                        f.to.as_ref().map(|t| format!("[{}, {}]", t.lo(), t.hi())),
                    );
                    let kind = (f.is_point, f.is_alone);
                    writeln!(
                        text,
                        "{name}: family {:?} from [{}, {}] to {to:?} (point, alone): {kind:?}",
                        f.support,
                        from.lo(),
                        from.hi()
                    )
                    .unwrap();
                }
                for o in &cover.open {
                    let max = o.max.as_ref().map(ToString::to_string);
                    writeln!(
                        text,
                        "{name}: open [{}, {max:?}] moving {:?} undecided {:?}",
                        o.min, o.moving, o.undecided
                    )
                    .unwrap();
                }
                let said = (cover.leaves, cover.is_plain_list(), cover.proves_absence());
                writeln!(text, "{name}: (leaves, plain list, absence): {said:?}").unwrap();
            }
            Err(rejected) => {
                writeln!(text, "{name}: {}: {rejected}", rejected.reason.name()).unwrap();
                match audit(&problem, &certificate) {
                    Ok((_, refused)) => writeln!(
                        text,
                        "{name}: audit: leaves refused (piece, node): {refused:?}"
                    )
                    .unwrap(),
                    Err(again) => assert_eq!(again, rejected, "{name}"),
                }
            }
        }
    }
    text
}

#[test]
fn every_verdict_is_the_same_to_the_last_digit() {
    let (expected, got) = (
        std::fs::read_to_string(root().join("tests/verdicts.txt")).unwrap(),
        verdicts(),
    );
    let wrong: Vec<String> = expected
        .lines()
        .zip(got.lines())
        .filter(|(e, g)| e != g)
        .map(|(e, g)| format!("expected {e}\n     got {g}"))
        .take(5)
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(expected.lines().count(), got.lines().count());
}

#[test]
#[ignore = "writes tests/verdicts.txt"]
fn write_the_verdicts() {
    std::fs::write(root().join("tests/verdicts.txt"), verdicts()).unwrap();
}
