//! Laws of the workspace that can be read off manifests and sources: which crate depends on which,
//! which part computes in floats, which test files run, how wide comments are, that no name of a
//! type is declared twice.
//!
//! The truth is the tables of this file. A new dependency, a float in a part that decides, a second
//! elimination or a test file that no binary names differs from its table and fails here.

use crate::{read, root};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The parts that are crates of their own.
const CRATES: [&str; 9] = [
    "exact", "model", "check", "oracle", "mcp", "engine", "paper", "motion", "testkit",
];

/// The crates whose verdicts the others rest on.
const TRUSTED: [&str; 4] = ["exact", "model", "check", "oracle"];

/// Where the sources of a crate are; for any other name those of the package at the top.
fn sources_of(package: &str) -> PathBuf {
    if CRATES.contains(&package) {
        root().join("crates").join(package).join("src")
    } else {
        root().join("src")
    }
}

/// The crate that a part belongs to.
fn package_of(part: &str) -> &str {
    match part {
        "certificate" => "check",
        "solver" | "sparse" | "linear" => "mcp",
        "certify" => "engine",
        _ if CRATES.contains(&part) => part,
        _ => "mceip",
    }
}

/// The folder and the file that a part may consist of.
fn places(part: &str) -> [PathBuf; 2] {
    let package = sources_of(package_of(part));
    let folder = if CRATES.contains(&part) {
        package
    } else {
        package.join(part)
    };
    let file = folder.with_extension("rs");

    [folder, file]
}

/// A Rust file, and its code without the module of unit tests at its end.
struct Source {
    path: PathBuf,
    code: String,
}

/// The Rust files of a part, files of unit tests left out.
fn sources(part: &str) -> Vec<Source> {
    let mut list = Vec::new();
    let mut stack = places(part).to_vec();

    while let Some(path) = stack.pop() {
        let is_of_tests =
            path.ends_with("tests") || (path.ends_with("tests.rs") && is_for_tests(&path));
        if is_of_tests {
            continue;
        }

        if path.is_dir() {
            stack.extend(entries(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") && path.exists() {
            let text = read(&path);
            let code = text.split("#[cfg(test)]\nmod tests").next();
            let code = code.unwrap_or_default().to_string();
            list.push(Source { path, code });
        }
    }

    assert!(!list.is_empty(), "{part} has no sources");
    list
}

/// The paths of all that is in a folder.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().path()).collect()
}

/// The lines of a source that are no comments.
fn code_lines(code: &str) -> impl Iterator<Item = &str> {
    code.lines()
        .filter(|line| !line.trim_start().starts_with("//"))
}

/// Is this file a module of its parent under `cfg(test)`?
fn is_for_tests(path: &Path) -> bool {
    let folder = path.parent().unwrap();
    let candidates = [
        folder.join("mod.rs"),
        folder.with_extension("rs"),
        folder.join("lib.rs"),
    ];
    let parent = candidates.into_iter().find(|file| file.is_file()).unwrap();

    let text = read(parent);
    text.contains("#[cfg(test)]\nmod tests;")
}

/// Each crate with all that its manifest may name. Cargo refuses any use of a crate not named
/// there.
#[rustfmt::skip]
const MAY_DEPEND: [(&str, &str); 10] = [
    ("exact", "num-bigint num-integer num-rational num-traits thiserror"),
    ("model", "mceip-exact num-traits serde serde_json sha2 thiserror"),
    ("check", "mceip-exact mceip-model num-integer num-traits serde serde_json thiserror"),
    ("oracle", "mceip-exact mceip-model num-traits thiserror"),
    // Nothing of friction, nothing exact: useful to anybody with a mixed complementarity problem.
    ("mcp", "faer nalgebra num-traits rand rand_chacha thiserror"),
    ("engine", "mceip-check mceip-exact mceip-mcp mceip-model mceip-oracle nalgebra num-bigint \
                num-integer num-traits rand rand_chacha rayon serde serde_json thiserror"),
    ("paper", "mceip-exact mceip-mcp mceip-model mceip-oracle mceip-path num-traits thiserror"),
    // Independent of all that it is held against: no solver, no search, no oracle.
    // mcp: the states after an event are proposed in doubles and verified exactly.
    ("path", "mceip-exact mceip-mcp mceip-model nalgebra num-integer num-traits thiserror"),
    ("motion", "mceip-exact mceip-model nalgebra rand rand_chacha thiserror"),
    ("testkit", "mceip-check mceip-engine mceip-exact mceip-mcp mceip-model mceip-oracle \
                 mceip-paper num-bigint num-traits rand rand_chacha rayon serde serde_json \
                 tempfile thiserror wait-timeout rustix"),
];

#[test]
fn manifests_follow_the_house() {
    for (name, allowed) in MAY_DEPEND {
        let file = root().join("crates").join(name).join("Cargo.toml");
        let manifest = read(file);
        assert!(
            manifest.contains("[lints]\nworkspace = true"),
            "{name} has lints of its own"
        );

        let named = dependencies(name, &manifest);
        assert_eq!(named.join(" "), allowed, "{name}");
    }

    let crates = entries(&root().join("crates")).len();
    assert_eq!(crates, MAY_DEPEND.len(), "a crate without a row");
}

/// The dependencies that the manifest of a crate names, those for tests left out.
///
/// Fails on a section for another kind of dependency: for build scripts, or a table of its own. The
/// trusted crates have no dependencies for tests either.
#[track_caller]
fn dependencies<'a>(name: &str, manifest: &'a str) -> Vec<&'a str> {
    let lines = manifest.lines().map(str::trim);
    let mut section = "";
    let mut named = Vec::new();

    for line in lines.filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if line.starts_with('[') {
            section = line;
            let is_known = section == "[dependencies]"
                || section == "[target.'cfg(unix)'.dependencies]"
                || (section == "[dev-dependencies]" && !TRUSTED.contains(&name))
                || !section.contains("dependencies");

            assert!(is_known, "{name}: {section}");
        } else if section.ends_with("dependencies]") && section != "[dev-dependencies]" {
            named.push(line.split(['.', ' ', '=']).next().unwrap());
        }
    }

    named
}

/// All Rust files below these folders.
fn rust_files(folders: &[&str]) -> Vec<PathBuf> {
    let mut stack: Vec<PathBuf> = folders.iter().map(|folder| root().join(folder)).collect();
    let mut files = Vec::new();

    while let Some(path) = stack.pop() {
        if path.is_dir() && !path.ends_with("target") {
            stack.extend(entries(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }

    files
}

/// rustfmt leaves comments as they are. Tables and figures aside, they keep to its width.
#[test]
fn comments_have_at_most_a_hundred_columns() {
    let folders = "benches crates examples fuzz python/src src tests";
    let files = rust_files(&folders.split(' ').collect::<Vec<_>>());
    assert!(files.len() > 300, "{} files", files.len());

    let mut too_long = Vec::new();
    for file in files {
        let text = read(&file);
        for (number, line) in text.lines().enumerate() {
            if is_wide_comment(line) {
                too_long.push(format!("{}:{}", file.display(), number + 1));
            }
        }
    }

    assert!(too_long.is_empty(), "{too_long:#?}");
}

/// A line of a comment above 100 columns that is no row of a table and no arrow of a figure.
fn is_wide_comment(line: &str) -> bool {
    let comment = line.trim_start();
    let is_drawn = comment.contains('|') || comment.contains("-->");

    comment.starts_with("//") && line.chars().count() > 100 && !is_drawn
}

#[test]
fn a_wide_comment_would_be_noticed() {
    let wide = "x".repeat(98);
    assert!(is_wide_comment(&format!("// {wide}")));
    assert!(!is_wide_comment(&format!("//{wide}")));
    assert!(!is_wide_comment(&format!("let {wide}")));
    assert!(!is_wide_comment(&format!("//! | {wide} |")));
}

/// The elimination (10)-(16) stands in `model`; what judges it (`check`), the enumerator and the
/// rest of `model` do not use it, nor does the integration in time (`motion`).
#[test]
fn the_elimination_is_not_used_by_what_stands_beside_it() {
    let elimination = sources_of("model").join("reduction");

    for part in ["check", "oracle", "model", "motion"] {
        for source in sources(part) {
            if source.path.starts_with(&elimination) {
                continue;
            }

            let is_used = source.code.lines().map(str::trim).any(uses_the_elimination);
            assert!(!is_used, "{} uses the elimination", source.path.display());
        }
    }
}

/// Does this line of code, without the blanks around it, name the module of the elimination?
fn uses_the_elimination(line: &str) -> bool {
    line.contains("reduction") && !line.starts_with("//") && line != "pub mod reduction;"
}

/// "The few parts of exact it names": numbers, polynomials, intervals, and what proves a matrix
/// definite; nothing that solves.
#[test]
fn the_checker_names_only_what_multiplies_and_compares() {
    const ALLOWED: [&str; 11] = [
        "Dominance",
        "Integer",
        "Interval",
        "MachineRow",
        "Poly",
        "Rational",
        "Sparse",
        "cleared",
        "common_denominator",
        "first_minor_not_positive",
        "machine_definite",
    ];

    let mut named = 0;
    for source in sources("check") {
        for line in code_lines(&source.code) {
            let Some((_, imported)) = line.split_once("mceip_exact::") else {
                continue;
            };

            let words = imported.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            for name in words.filter(|word| !word.is_empty()) {
                let file = source.path.display();
                assert!(ALLOWED.contains(&name), "{file}: check uses exact::{name}");

                named += 1;
            }
        }
    }

    assert!(named > 5);
}

#[test]
fn floats_stay_out_of_the_deciding_rooms() {
    for part in ["exact", "check", "oracle"] {
        for source in sources(part) {
            let name = source.path.file_name().unwrap();
            let converts = part == "exact" && (name == "double.rs" || name == "lib.rs");
            let code: String = code_lines(&source.code).collect();
            let names_a_float = code.contains("f64") || code.contains("f32");

            assert!(
                converts || !names_a_float,
                "{}: names a float type",
                source.path.display()
            );
        }

        let module = read(sources_of(part).join("lib.rs"));
        assert!(
            module.contains("#![deny(clippy::float_arithmetic)]"),
            "{part} does not deny float arithmetic"
        );
    }
}

#[test]
fn faer_stands_behind_one_file_and_tolerances_in_theirs() {
    let mut stack: Vec<PathBuf> = CRATES.iter().map(|package| sources_of(package)).collect();
    stack.push(sources_of("mceip"));
    let mut naming_faer = Vec::new();
    let mut with_tolerances = Vec::new();

    while let Some(path) = stack.pop() {
        if path.ends_with("tests") {
            continue;
        }

        if path.is_dir() {
            stack.extend(entries(&path));
            continue;
        }

        let text = read(&path);
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();

        if code_lines(code).any(|line| line.contains("faer::")) {
            naming_faer.push(name.clone());
        }

        // A float literal with a negative exponent is a tolerance; options.rs has those of PATH.
        if name != "tests.rs" && code_lines(code).any(|line| line.contains("1e-")) {
            with_tolerances.push(name);
        }
    }

    assert_eq!(naming_faer, ["dense.rs"]);

    with_tolerances.sort();
    let tolerances = ["tolerance.rs"; 5];
    assert_eq!(with_tolerances, [&["options.rs"][..], &tolerances].concat());
}

/// The two numbers after `prefix` in the first line of a text that holds it: "1.95" is [1, 95].
fn version_after(text: &str, prefix: &str) -> [u32; 2] {
    let (_, rest) = text.split_once(prefix).unwrap();
    let mut numbers = rest.split(|c: char| !c.is_ascii_digit());
    let mut next = || numbers.next().unwrap().parse().unwrap();
    [next(), next()]
}

/// The manifests, the pages and the image speak of the same Rust.
#[test]
fn one_oldest_rust_is_stated_everywhere() {
    let oldest = version_after(&read("Cargo.toml"), "rust-version = \"");

    assert_eq!(
        version_after(&read("python/Cargo.toml"), "rust-version = \""),
        oldest
    );
    assert_eq!(
        version_after(&read("README.md"), "machine with Rust ("),
        oldest
    );
    assert_eq!(version_after(&read("CONTRIBUTING.md"), "Rust "), oldest);

    let in_the_image = version_after(&read("Dockerfile"), "FROM rust:");
    assert!(in_the_image >= oldest, "{in_the_image:?} and {oldest:?}");
}

/// Names of types that are declared more than once, each with the reason.
const SHARED_NAMES: [(&str, &str); 3] = [
    ("Args", "the arguments of each command: clap reads them"),
    (
        "Problem",
        "the front door's hides the parts of the model's, which it holds",
    ),
    (
        "Solution",
        "the enumerator's own beside the front door's, which the checker has accepted",
    ),
];

/// One idea, one home, one name: whoever writes a second `Region` finds the first one here.
#[test]
fn no_name_of_a_type_is_declared_twice() {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();

    for file in rust_files(&["crates", "src"]) {
        if is_of_tests(&file) {
            continue;
        }

        let text = read(&file);
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
        for (index, line) in code.lines().enumerate() {
            if let Some(name) = declared_type(line) {
                let file = file.strip_prefix(root()).unwrap().display();
                let place = format!("{file}:{}", index + 1);
                places.entry(name.into()).or_default().push(place);
            }
        }
    }

    assert!(places.len() > 1_000, "{} names", places.len());
    places.retain(|_, places| places.len() > 1);

    for (name, reason) in SHARED_NAMES {
        let is_shared = places.remove(name).is_some();
        assert!(is_shared, "{name} ({reason}) is declared once: not shared");
    }
    assert!(places.is_empty(), "declared more than once: {places:#?}");
}

/// Is the file not a source of its crate, or one of unit tests?
fn is_of_tests(file: &Path) -> bool {
    let folders = || file.parent().unwrap().iter();
    let is_source = folders().any(|folder| folder == "src");
    let is_in_tests = folders().any(|folder| folder == "tests");

    !is_source || is_in_tests || (file.ends_with("tests.rs") && is_for_tests(file))
}

/// The name of the type or trait that a line declares. Types of traits (`type Item = ...`), which
/// are indented, are none.
fn declared_type(line: &str) -> Option<&str> {
    let item = line.trim_start();
    let is_indented = item.len() < line.len();
    let item = match item.strip_prefix("pub") {
        Some(rest) if rest.starts_with('(') => rest.split_once(") ")?.1,
        Some(rest) => rest.trim_start(),
        None => item,
    };

    let (kind, rest) = item.split_once(' ')?;
    let declares = match kind {
        "struct" | "enum" | "union" | "trait" => true,
        "type" => !is_indented,
        _ => false,
    };

    let end = rest.find(|c: char| !c.is_alphanumeric())?;
    declares.then_some(&rest[..end])
}

#[test]
fn a_type_declared_in_any_way_would_be_noticed() {
    for line in [
        "struct Region {",
        "pub enum Region {",
        "    pub(super) struct Region;",
        "pub(in crate::search) struct Region<'a> {",
        "pub trait Region: Clone {",
        "pub type Region = Vec<f64>;",
    ] {
        assert_eq!(declared_type(line), Some("Region"), "{line}");
    }

    for line in [
        "    type Region = f64;",
        "// struct Region {",
        "impl Region {",
    ] {
        assert_eq!(declared_type(line), None, "{line}");
    }
}

/// Cargo links the groups of `tests/`; a file that its group does not name would never run.
#[test]
fn every_file_of_a_group_of_tests_is_named_by_it() {
    let mut files = 0;

    for group in entries(&root().join("tests")) {
        let Ok(main) = std::fs::read_to_string(group.join("main.rs")) else {
            continue;
        };

        for file in entries(&group) {
            let module = file.file_stem().unwrap().to_string_lossy().into_owned();
            let is_rust = file.extension().is_some_and(|extension| extension == "rs");

            if !is_rust || module == "main" {
                continue;
            }

            let declaration = format!("mod {module};");
            let is_named = main.lines().any(|line| line.ends_with(&declaration));
            assert!(is_named, "{} is not run", file.display());

            files += 1;
        }
    }

    assert!(files > 50, "{files} files of tests");
}
