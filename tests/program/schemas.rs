//! `spec/schemas/`: what the readers take and what the program writes, held against the JSON
//! Schemas. The schemas say more or less than the readers only where `spec/conform.md` says so.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip};
use jsonschema::Validator;
use mceip_check::certificate::Certificate;
use mceip_engine::foreign::{BadPoint, ForeignError, ForeignReport};
use mceip_engine::lcp::{FileError, read_mcp, read_solution};
use mceip_engine::reduction::reduce;
use mceip_model::ModelError;
use mceip_model::file::read_problem;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn schema(name: &str) -> Validator {
    let text = std::fs::read_to_string(root(&format!("spec/schemas/{name}.json"))).unwrap();
    let schema: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    jsonschema::draft202012::options().build(&schema).unwrap()
}

#[track_caller]
fn valid(validator: &Validator, value: &Value, what: &str) {
    let errors: Vec<String> = validator
        .iter_errors(value)
        .map(|e| format!("{e} at {}", e.instance_path))
        .collect();
    assert!(errors.is_empty(), "{what}: {errors:?}");
}

fn read(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

fn files(folder: &str, extension: &str) -> Vec<PathBuf> {
    let all = std::fs::read_dir(root(folder))
        .unwrap()
        .map(|e| e.unwrap().path());
    let mut list: Vec<PathBuf> = all
        .filter(|p| p.extension().is_some_and(|e| e == extension))
        .collect();
    list.sort();
    list
}

/// The schemas themselves are schemas.
#[test]
fn every_schema_is_one() {
    let list = files("spec/schemas", "json");
    assert!(list.len() >= 8);
    for path in list {
        assert!(
            jsonschema::meta::is_valid(&read(&path)),
            "{}",
            path.display()
        );
    }
}

#[test]
fn examples_and_written_files_are_valid() {
    let (problems, solutions, certificates) = (
        schema("mceip-problem-1"),
        schema("mceip-solutions-1"),
        schema("mceip-certificate-1"),
    );
    let folder = Folder::new();
    for path in files("spec/examples", "json") {
        let file = path.display().to_string();
        let example = read(&path);
        if example["format"] != "mceip-problem/1" {
            continue;
        }
        valid(&problems, &example, &file);
        let certificate = folder.path("c.json");
        for args in [
            &["enumerate", "--json"][..],
            &["solve", "--json", "--certificate", certificate.as_str()],
            &["complete", "--json", "--certificate", certificate.as_str()],
        ] {
            let out = mceip(&[&[args[0], file.as_str()][..], &args[1..]].concat());
            valid(
                &solutions,
                &serde_json::from_slice(&out.stdout).unwrap(),
                &format!("{args:?} {file}"),
            );
            if args.len() > 2 {
                valid(
                    &certificates,
                    &read(Path::new(&certificate)),
                    &format!("{args:?} {file}"),
                );
            }
        }
        let reduced = mceip(&["reduce", &file]);
        valid(
            &problems,
            &serde_json::from_slice(&reduced.stdout).unwrap(),
            &format!("reduce {file}"),
        );
    }
}

#[test]
fn traces_and_plain_problems_are_valid() {
    let folder = Folder::new();
    let example = root("spec/examples/fold.json").display().to_string();
    let trace = folder.path("trace.txt");
    assert_eq!(
        mceip(&["solve", &example, "--trace", &trace]).status.code(),
        Some(0)
    );
    let first = std::fs::read_to_string(&trace)
        .unwrap()
        .lines()
        .next()
        .unwrap()
        .to_string();
    valid(
        &schema("mceip-trace-1"),
        &serde_json::from_str(&first).unwrap(),
        "trace",
    );
    let (mcp, solution) = (schema("mceip-mcp-1"), folder.path("z.json"));
    let plain = json!({ "format": "mceip-mcp/1", "m": [[2, 1], [1, 2]], "q": [-5, "-6"], "lower": [null, 0], "upper": [3, null] });
    valid(&mcp, &plain, "mcp");
    let file = folder.write("mcp.json", &plain.to_string());
    assert_eq!(
        mceip(&["solve", &file, "--certificate", &solution])
            .status
            .code(),
        Some(0)
    );
    valid(
        &schema("mceip-mcp-solution-1"),
        &read(Path::new(&solution)),
        "solution of an mcp",
    );
    let listed = mceip(&["solve", &file, "--all", "--json", "--trace", &trace]);
    valid(
        &schema("mceip-mcp-solutions-1"),
        &serde_json::from_slice(&listed.stdout).unwrap(),
        "solutions of an mcp",
    );
    let first = std::fs::read_to_string(&trace)
        .unwrap()
        .lines()
        .next()
        .unwrap()
        .to_string();
    valid(
        &schema("mceip-trace-1"),
        &serde_json::from_str(&first).unwrap(),
        "trace of an mcp",
    );
    for bad in [
        json!({ "format": "mceip-mcp/1", "m": [["nan"]], "q": [-5] }),
        json!({ "format": "mceip-mcp/1", "m": [[1]], "q": [1], "z": 0 }),
    ] {
        assert!(
            !mcp.is_valid(&bad) && read_mcp(&bad.to_string()).is_err(),
            "{bad}"
        );
    }
}

/// The pack, the index, and every problem, answer and wrong answer in it.
#[test]
fn the_pack_is_valid() {
    let (problems, solutions) = (schema("mceip-problem-1"), schema("mceip-solutions-1"));
    let (pack, index) = (schema("mceip-pack-1"), schema("mceip-pack-index-1"));
    let mut cases = 0;
    for path in files("spec/conformance-pack", "json") {
        let file = read(&path);
        if file["format"] == "mceip-pack-index/1" {
            valid(&index, &file, "index");
            continue;
        }
        valid(&pack, &file, &path.display().to_string());
        for case in file["cases"].as_array().unwrap() {
            let id = case["id"].as_str().unwrap();
            valid(&problems, &case["problem"], id);
            valid(&solutions, &case["answer"], id);
            case["wrong"]
                .as_array()
                .unwrap()
                .iter()
                .for_each(|w| valid(&solutions, &w["report"], id));
            cases += 1;
        }
    }
    assert!(cases > 200, "{cases}");
}

/// Is this a complaint about the shape of the file, which the schema must share?
fn of_shape(e: &ModelError) -> bool {
    use ModelError as E;
    matches!(
        e,
        E::Json { .. }
            | E::Format { .. }
            | E::Body { .. }
            | E::Sign { .. }
            | E::ZeroReactionState { .. }
    )
}

/// Each malformed file: refused by the schema as well, or (`meaning`) only by what the numbers
/// mean.
#[test]
fn malformed_problems_are_invalid_or_wrong_in_meaning() {
    let meaning = [
        "friction-zero",
        "index-out-of-range",
        "mass-not-definite",
        "missing-market-file",
        "non-symmetric",
        "not-square",
        "particle-twice",
        "ragged",
        "reaction-outside-cone",
        "window-negative",
        "window-reversed",
    ];
    let problems = schema("mceip-problem-1");
    let mut seen = 0;
    for path in files("tests/malformed", "json") {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        let error = read_problem(&text, Path::new("/nonexistent")).unwrap_err();
        let accepted = serde_json::from_str::<Value>(&text).is_ok_and(|v| problems.is_valid(&v));
        // A duplicate key is gone before a schema sees the value: the reader is stricter by nature.
        let stricter = name == "duplicate-key";
        assert_eq!(
            accepted,
            stricter || meaning.contains(&name.as_str()),
            "{name}: {error}"
        );
        assert!(
            stricter || !(accepted && of_shape(&error)),
            "{name}: {error}"
        );
        seen += usize::from(accepted && !stricter);
    }
    assert_eq!(seen, meaning.len());
}

/// All places of a value, as JSON pointers.
fn places(value: &Value, at: &str, out: &mut Vec<String>) {
    out.push(at.to_string());
    match value {
        Value::Object(fields) => fields
            .iter()
            .for_each(|(k, v)| places(v, &format!("{at}/{k}"), out)),
        Value::Array(items) => items
            .iter()
            .enumerate()
            .for_each(|(i, v)| places(v, &format!("{at}/{i}"), out)),
        _ => {}
    }
}

/// Every place of a file replaced by values of other kinds, left out, or with a stranger beside it.
fn damaged(file: &Value) -> Vec<Value> {
    let mut spots = Vec::new();
    places(file, "", &mut spots);
    let replacements = [
        json!(null),
        json!(true),
        json!(-1),
        json!("1e400"),
        json!("1e401"),
        json!("x"),
        json!("1/0"),
        json!([]),
        json!({}),
        json!(" +.5 "),
        json!("7/-14"),
    ];
    let mut out = Vec::new();
    for (k, spot) in spots.iter().enumerate().skip(1) {
        for turn in 0..3 {
            let mut copy = file.clone();
            *copy.pointer_mut(spot).unwrap() =
                replacements[(3 * k + turn) % replacements.len()].clone();
            out.push(copy);
        }
        let mut copy = file.clone();
        let (parent, last) = spot.rsplit_once('/').unwrap();
        match copy.pointer_mut(parent).unwrap() {
            Value::Object(fields) => drop(fields.remove(last)),
            Value::Array(items) => drop(items.remove(last.parse().unwrap())),
            _ => unreachable!(),
        }
        out.push(copy);
        let mut copy = file.clone();
        if let Value::Object(fields) = copy.pointer_mut(spot).unwrap() {
            fields.insert("stranger".into(), json!(1));
            out.push(copy);
        }
        // A list of the fields in place of an object.
        let mut copy = file.clone();
        let place = copy.pointer_mut(spot).unwrap();
        if let Value::Object(fields) = place {
            *place = fields.values().cloned().collect();
            out.push(copy);
        }
    }
    out
}

/// The reader of problems and the schema agree on the shape of thousands of damaged files.
#[test]
fn the_reader_of_problems_and_the_schema_agree() {
    let problems = schema("mceip-problem-1");
    let mut count = [0usize; 3];
    let forms = json!({
        "format": "mceip-problem/1", "unknown": "mu", "name": null, "comment": "c", "window": { "min": 0, "max": null },
        "pencil": { "a": { "dense": [[1]], "read_as": "f64" }, "b": { "rows": 1, "cols": 1, "symmetric": true, "entries": [[0, 0, "1/2"]] }, "free": [0] },
    });
    let market = json!({ "format": "mceip-problem/1", "unknown": "mu", "pencil": { "a": { "matrix_market": "a.mtx" }, "b": [[1]] } });
    let examples = ["two-particles", "oblique", "fold"]
        .map(|n| read(&root(&format!("spec/examples/{n}.json"))));
    for file in examples.into_iter().chain([forms, market]) {
        for copy in damaged(&file) {
            let valid = problems.is_valid(&copy);
            let text = copy.to_string();
            match read_problem(&text, &root("spec/examples")) {
                Ok(_) => {
                    assert!(valid, "read, and invalid: {text}");
                    count[0] += 1;
                }
                Err(e) => {
                    // What is wrong in shape comes before what is wrong in meaning only within one
                    // step of the reader.
                    assert!(!(valid && of_shape(&e)), "refused ({e}), and valid: {text}");
                    count[if valid { 1 } else { 2 }] += 1;
                }
            }
        }
    }
    assert!(
        count[0] > 40 && count[1] > 30 && count[2] > 400,
        "read, wrong in meaning, wrong in shape: {count:?}"
    );
}

/// Every certificate of the corpus that is read is valid, and a support leaf that is none is not.
#[test]
fn the_corpus_is_valid() {
    let (certificates, mcp, mcp_solution) = (
        schema("mceip-certificate-1"),
        schema("mceip-mcp-1"),
        schema("mceip-mcp-solution-1"),
    );
    let mut plain = 0;
    for path in files("spec/corpus/accept", "json")
        .iter()
        .chain(&files("spec/corpus/reject", "json"))
    {
        let file = read(path);
        if file["problem"]["format"] == "mceip-mcp/1" {
            valid(&mcp, &file["problem"], &path.display().to_string());
            file.get("certificate")
                .iter()
                .for_each(|c| valid(&mcp_solution, c, &path.display().to_string()));
            plain += 1;
        } else if file.get("certificate").is_some() {
            valid(
                &certificates,
                &file["certificate"],
                &path.display().to_string(),
            );
        }
    }
    assert!(plain >= 19, "{plain}");
    let is_leaf = |p: &&PathBuf| {
        p.file_stem()
            .unwrap()
            .to_string_lossy()
            .starts_with("support-leaf-")
    };
    let malformed = files("spec/corpus/malformed", "json");
    let leaves: Vec<&PathBuf> = malformed.iter().filter(is_leaf).collect();
    assert!(leaves.len() >= 8);
    for path in leaves {
        let text = read(path)["certificate_text"].as_str().unwrap().to_string();
        // Is 1/2 an integer? A schema cannot divide.
        let of_meaning = path.ends_with("support-leaf-coefficient-fraction.json");
        assert_eq!(
            certificates.is_valid(&serde_json::from_str(&text).unwrap()),
            of_meaning,
            "{}",
            path.display()
        );
    }
}

/// The same for foreign reports and certificates, whose readers check shapes only.
#[test]
fn the_readers_of_reports_and_certificates_agree_with_the_schemas() {
    let (solutions, certificates) = (schema("mceip-solutions-1"), schema("mceip-certificate-1"));
    let example = std::fs::read_to_string(root("spec/examples/fold.json")).unwrap();
    let problem = read_problem(&example, &root("spec/examples")).unwrap();
    let reduced = reduce(&problem).unwrap();
    let continua = json!([{ "slip": [0], "intervals": [{ "from": { "value": "0", "included": true }, "to": null }] }]);
    let solutions_of = json!([{ "value": 1, "x": ["1/2", 3] }]);
    let report = json!({ "format": "mceip-solutions/1", "problem_sha256": problem.sha256(), "solutions": solutions_of, "continua": continua });
    let mut count = [0usize; 2];
    for copy in damaged(&report) {
        let (valid, read) = (
            solutions.is_valid(&copy),
            ForeignReport::read(&copy.to_string(), &problem, &reduced),
        );
        // 1e400 is a number and no double; lengths and digests are not of the shape.
        let of_meaning = matches!(
            read,
            Err(ForeignError::File(ModelError::Number { .. }) | ForeignError::Digest { .. })
        );
        // A solution without x is judged by itself; the schema wants one in each.
        let has_no_vector = |bad: &BadPoint| matches!(bad, BadPoint::NoVector { .. });
        let is_bare = read.as_ref().is_ok_and(|r| {
            r.solutions
                .iter()
                .filter_map(|s| s.as_ref().err())
                .any(has_no_vector)
        });
        assert_eq!(
            valid,
            (read.is_ok() && !is_bare) || of_meaning,
            "{copy}: {read:?}"
        );
        count[usize::from(valid)] += 1;
    }
    let folder = Folder::new();
    let file = folder.path("c.json");
    assert_eq!(
        mceip(&[
            "complete",
            &root("spec/examples/fold.json").display().to_string(),
            "--certificate",
            &file
        ])
        .status
        .code(),
        Some(0)
    );
    let corpus = [
        "one-support-cone",
        "one-support-alone-by-inequalities",
        "one-support-free",
        "absence-ldl-interval",
        "lifted",
    ];
    let of_corpus = corpus
        .map(|name| read(&root(&format!("spec/corpus/accept/{name}.json")))["certificate"].take());
    for copy in of_corpus
        .iter()
        .chain([&read(Path::new(&file))])
        .flat_map(damaged)
    {
        let (valid, read) = (
            certificates.is_valid(&copy),
            Certificate::from_json(&copy.to_string()),
        );
        // The schema is open for kinds of claims and nodes; it must take all that is read.
        assert!(valid || read.is_err(), "read, and invalid: {copy}");
        count[usize::from(valid)] += 1;
    }
    assert!(count[0] > 50 && count[1] > 5, "{count:?}");
}

/// Plain problems and their solution files.
#[test]
fn the_readers_of_plain_problems_agree_with_the_schemas() {
    let (mcp, solution) = (schema("mceip-mcp-1"), schema("mceip-mcp-solution-1"));
    let problem = read(&root("spec/examples/bounded-mcp.json"));
    let mut count = [0usize; 2];
    for copy in damaged(&problem) {
        let (valid, read) = (mcp.is_valid(&copy), read_mcp(&copy.to_string()));
        // Lengths that do not fit and crossed bounds are of the meaning.
        assert_eq!(
            valid,
            read.is_ok() || matches!(read, Err(FileError::Mcp(_))),
            "{copy}: {read:?}"
        );
        count[usize::from(valid)] += 1;
    }
    let file = json!({ "format": "mceip-mcp-solution/1", "problem_sha256": "ab", "z": [["4/3", 2], [1, "-0.5"]] });
    for copy in damaged(&file) {
        let (valid, read) = (solution.is_valid(&copy), read_solution(&copy.to_string()));
        assert_eq!(valid, read.is_ok(), "{copy}: {read:?}");
        count[usize::from(valid)] += 1;
    }
    assert!(count[0] > 50 && count[1] > 20, "{count:?}");
}
