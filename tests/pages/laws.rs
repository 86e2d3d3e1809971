//! Laws of the workspace that can be read off manifests and sources: who depends on whom, who
//! computes in floats.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

/// The rooms that are crates of their own.
const CRATES: [&str; 8] = [
    "exact", "model", "check", "oracle", "mcp", "engine", "paper", "testkit",
];

/// Those that decide.
const TRUSTED: [&str; 4] = ["exact", "model", "check", "oracle"];

/// Where the sources of a crate are; for any other name those of the package at the top.
fn sources_of(package: &str) -> PathBuf {
    if CRATES.contains(&package) {
        root().join("crates").join(package).join("src")
    } else {
        root().join("src")
    }
}

/// The crate that a room is in.
fn package_of(room: &str) -> &str {
    match room {
        "certificate" => "check",
        "solver" | "sparse" | "linear" => "mcp",
        "certify" => "engine",
        _ if CRATES.contains(&room) => room,
        _ => "mceip",
    }
}

/// The folder and the file a room may consist of.
fn places(room: &str) -> [PathBuf; 2] {
    let package = sources_of(package_of(room));
    let folder = if CRATES.contains(&room) {
        package
    } else {
        package.join(room)
    };
    let file = folder.with_extension("rs");
    [folder, file]
}

fn sources(room: &str) -> Vec<(PathBuf, String)> {
    let mut list = Vec::new();
    let mut stack = places(room).to_vec();
    while let Some(path) = stack.pop() {
        if path.ends_with("tests") || (path.ends_with("tests.rs") && is_for_tests(&path)) {
            continue; // not the code of the room
        }
        if path.is_dir() {
            stack.extend(std::fs::read_dir(&path).unwrap().map(|e| e.unwrap().path()));
        } else if path.extension().is_some_and(|e| e == "rs") && path.exists() {
            let text = std::fs::read_to_string(&path).unwrap();
            let code = text
                .split("#[cfg(test)]\nmod tests")
                .next()
                .unwrap_or_default()
                .to_string();
            list.push((path, code));
        }
    }
    assert!(!list.is_empty(), "room {room} has no sources");
    list
}

/// Is this file a module of its parent under `cfg(test)`?
fn is_for_tests(path: &Path) -> bool {
    let folder = path.parent().unwrap();
    let parent = [folder.join("mod.rs"), folder.with_extension("rs")]
        .into_iter()
        .find(|p| p.is_file())
        .unwrap();
    std::fs::read_to_string(parent)
        .unwrap()
        .contains("#[cfg(test)]\nmod tests;")
}

/// Crate, and all that its manifest may name: Cargo keeps the walls between crates.
const MAY_DEPEND: [(&str, &[&str]); 8] = [
    (
        "exact",
        &[
            "num-bigint",
            "num-integer",
            "num-rational",
            "num-traits",
            "thiserror",
        ],
    ),
    (
        "model",
        &[
            "mceip-exact",
            "num-traits",
            "serde",
            "serde_json",
            "sha2",
            "thiserror",
        ],
    ),
    (
        "check",
        &[
            "mceip-exact",
            "mceip-model",
            "num-integer",
            "num-traits",
            "serde",
            "serde_json",
            "thiserror",
        ],
    ),
    (
        "oracle",
        &["mceip-exact", "mceip-model", "num-traits", "thiserror"],
    ),
    // Nothing of friction, nothing exact: useful to anybody with a mixed complementarity problem.
    (
        "mcp",
        &[
            "faer",
            "nalgebra",
            "num-traits",
            "rand",
            "rand_chacha",
            "thiserror",
        ],
    ),
    (
        "engine",
        &[
            "mceip-check",
            "mceip-exact",
            "mceip-mcp",
            "mceip-model",
            "mceip-oracle",
            "nalgebra",
            "num-bigint",
            "num-integer",
            "num-traits",
            "rand",
            "rand_chacha",
            "rayon",
            "serde",
            "serde_json",
            "sha2",
            "thiserror",
        ],
    ),
    // mcp: the loading path proposes its events in doubles and verifies them exactly.
    (
        "paper",
        &[
            "mceip-exact",
            "mceip-mcp",
            "mceip-model",
            "mceip-oracle",
            "nalgebra",
            "num-integer",
            "num-traits",
            "thiserror",
        ],
    ),
    (
        "testkit",
        &[
            "mceip-check",
            "mceip-engine",
            "mceip-exact",
            "mceip-mcp",
            "mceip-model",
            "mceip-oracle",
            "mceip-paper",
            "num-bigint",
            "num-traits",
            "rand",
            "rand_chacha",
            "rayon",
            "serde",
            "serde_json",
            "sha2",
            "thiserror",
            "wait-timeout",
            "rustix",
        ],
    ),
];

#[test]
fn manifests_follow_the_house() {
    for (name, allowed) in MAY_DEPEND {
        let manifest =
            std::fs::read_to_string(root().join("crates").join(name).join("Cargo.toml")).unwrap();
        assert!(
            manifest.contains("[lints]\nworkspace = true"),
            "{name} has lints of its own"
        );
        let mut section = "";
        let mut named = Vec::new();
        for line in manifest
            .lines()
            .map(str::trim)
            .filter(|l| !l.is_empty() && !l.starts_with('#'))
        {
            if line.starts_with('[') {
                section = line;
                // No other kind of dependency: build, or a table of its own. The trusted crates
                // have none for tests either.
                let is_known = section == "[dependencies]"
                    || section == "[target.'cfg(unix)'.dependencies]"
                    || (section == "[dev-dependencies]" && !TRUSTED.contains(&name))
                    || !section.contains("dependencies");
                assert!(is_known, "{name}: {section}");
            } else if section.ends_with("dependencies]") && section != "[dev-dependencies]" {
                named.push(line.split(['.', ' ', '=']).next().unwrap());
            }
        }
        assert_eq!(named, allowed, "{name}");
    }
    let crates = std::fs::read_dir(root().join("crates")).unwrap().count();
    assert_eq!(crates, MAY_DEPEND.len(), "a crate without a row");
}

/// The elimination (10)-(16) stands in `model`; what judges it (`check`), the enumerator and the
/// rest of `model` do not use it.
#[test]
fn the_elimination_is_not_used_by_what_stands_beside_it() {
    for room in ["check", "oracle", "model"] {
        for (path, code) in sources(room) {
            if path.starts_with(sources_of("model").join("reduction")) {
                continue;
            }
            let uses = |l: &str| {
                l.contains("reduction") && !l.starts_with("//") && l != "pub mod reduction;"
            };
            assert!(
                !code.lines().map(str::trim).any(uses),
                "{} uses the elimination",
                path.display()
            );
        }
    }
}

/// "The few parts of exact it names": numbers, polynomials, intervals; nothing that solves.
#[test]
fn the_checker_names_only_what_multiplies_and_compares() {
    const ALLOWED: [&str; 6] = [
        "Integer",
        "Interval",
        "Poly",
        "Rational",
        "Sparse",
        "common_denominator",
    ];
    let mut named = 0;
    for (path, code) in sources("check") {
        for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
            let Some((_, rest)) = line.split_once("mceip_exact::") else {
                continue;
            };
            for name in rest
                .split(|c: char| !(c.is_alphanumeric() || c == '_'))
                .filter(|n| !n.is_empty())
            {
                assert!(
                    ALLOWED.contains(&name),
                    "{}: check uses exact::{name}",
                    path.display()
                );
                named += 1;
            }
        }
    }
    assert!(named > 5);
}

#[test]
fn floats_stay_out_of_the_deciding_rooms() {
    for room in ["exact", "check", "oracle"] {
        for (path, code) in sources(room) {
            let name = path.file_name().and_then(|n| n.to_str()).unwrap();
            let is_border = room == "exact" && (name == "double.rs" || name == "lib.rs");
            let code: String = code
                .lines()
                .filter(|l| !l.trim_start().starts_with("//"))
                .collect();
            assert!(
                is_border || !(code.contains("f64") || code.contains("f32")),
                "{}: names a float type",
                path.display()
            );
        }
    }
    for room in ["exact", "check", "oracle"] {
        let module = std::fs::read_to_string(sources_of(room).join("lib.rs")).unwrap();
        assert!(
            module.contains("#![deny(clippy::float_arithmetic)]"),
            "{room} does not deny float arithmetic"
        );
    }
}

#[test]
fn faer_stands_behind_one_file_and_tolerances_in_theirs() {
    let mut stack: Vec<PathBuf> = ["mceip"]
        .iter()
        .chain(&CRATES)
        .map(|p| sources_of(p))
        .collect();
    let (mut faer, mut small) = (Vec::new(), Vec::new());
    while let Some(path) = stack.pop() {
        if path.ends_with("tests") {
            continue;
        }
        if path.is_dir() {
            stack.extend(std::fs::read_dir(&path).unwrap().map(|e| e.unwrap().path()));
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let code: Vec<&str> = text
            .split("#[cfg(test)]")
            .next()
            .unwrap_or_default()
            .lines()
            .filter(|l| !l.trim_start().starts_with("//"))
            .collect();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if code.iter().any(|l| l.contains("faer::")) {
            faer.push(name.clone());
        }
        // A float literal with a negative exponent is a tolerance (options.rs: PATH's own).
        if name != "tests.rs" && code.iter().any(|l| l.contains("1e-")) {
            small.push(name);
        }
    }
    assert_eq!(faer, vec!["dense.rs"]);
    small.sort();
    assert_eq!(
        small,
        vec![
            "options.rs",
            "tolerance.rs",
            "tolerance.rs",
            "tolerance.rs",
            "tolerance.rs"
        ]
    );
}

/// Cargo links the groups of `tests/`; a file that its group does not name would never run.
#[test]
fn every_file_of_a_group_of_tests_is_named_by_it() {
    let mut files = 0;
    for group in std::fs::read_dir(root().join("tests"))
        .unwrap()
        .map(|e| e.unwrap().path())
    {
        let Ok(main) = std::fs::read_to_string(group.join("main.rs")) else {
            continue;
        };
        for file in std::fs::read_dir(&group)
            .unwrap()
            .map(|e| e.unwrap().path())
        {
            let module = file.file_stem().unwrap().to_string_lossy().into_owned();
            if file.extension().is_none_or(|e| e != "rs") || module == "main" {
                continue;
            }
            assert!(
                main.lines()
                    .any(|line| line.ends_with(&format!("mod {module};"))),
                "{} is not run",
                file.display()
            );
            files += 1;
        }
    }
    assert!(files > 50, "{files} files of tests");
}
