//! `spec/schemas/`: what the readers take and what the program writes, held against the JSON
//! Schemas. The schemas say more or less than the readers only where `spec/conform.md` says so.
//!
//! Readers and schemas are two descriptions of one format, each the truth for the other. Thousands
//! of damaged files go to both; a field that one of them forgets is accepted by one side alone.
#![cfg(feature = "cli")]

use crate::common::{example, exits, pencil_problem, read_json, repository, run};
use crate::corpus_reader::{Entry, MALFORMED, entries, entry};
use crate::json_places::places;
use crate::program::Folder;
use jsonschema::Validator;
use mceip_check::certificate::{
    Certificate, CriticalCertificate, EquilibriumCertificate, PresenceCertificate,
    StabilityCertificate,
};
use mceip_engine::foreign::{BadPoint, ForeignError, ForeignReport};
use mceip_engine::lcp::{FileError, read_mcp, read_solution};
use mceip_model::ModelError;
use mceip_model::file::{read_loads, read_problem};
use mceip_model::reduction::reduce;
use serde_json::{Value, json};
use std::fmt::{Debug, Display};
use std::path::{Path, PathBuf};

fn root(path: &str) -> PathBuf {
    repository(path).into()
}

fn schema(name: &str) -> Validator {
    let text = std::fs::read_to_string(root(&format!("spec/schemas/{name}.json"))).unwrap();
    let schema: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );

    // References lead to schemas in the same folder.
    let folder = format!("file://{}/", root("spec/schemas").display());
    jsonschema::draft202012::options()
        .with_base_uri(format!("{folder}{name}.json"))
        .with_retriever(OfTheFolder)
        .build(&schema)
        .unwrap()
}

/// Reads what a schema refers to, files only.
struct OfTheFolder;

impl jsonschema::Retrieve for OfTheFolder {
    fn retrieve(
        &self,
        uri: &jsonschema::Uri<String>,
    ) -> Result<Value, Box<dyn std::error::Error + Send + Sync>> {
        let text = std::fs::read_to_string(uri.path().as_str())?;
        Ok(serde_json::from_str(&text)?)
    }
}

/// Fails with the errors that the schema finds in the value.
#[track_caller]
fn valid(validator: &Validator, value: &Value, what: &str) {
    let mut errors = Vec::new();
    for error in validator.iter_errors(value) {
        errors.push(format!("{error} at {}", error.instance_path));
    }

    assert!(errors.is_empty(), "{what}: {errors:?}");
}

/// The JSON files of a folder, by name.
fn json_files(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root(folder)).unwrap();
    let mut list: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    list.retain(|path| {
        path.extension()
            .is_some_and(|extension| extension == "json")
    });
    list.sort();

    list
}

/// The schemas themselves are schemas.
#[test]
fn every_schema_is_one() {
    let list = json_files("spec/schemas");
    assert!(list.len() >= 8);

    for path in list {
        let schema = read_json(&path);
        let is_valid = jsonschema::meta::is_valid(&schema);
        assert!(is_valid, "{}", path.display());
    }
}

#[test]
fn examples_and_written_files_are_valid() {
    let problems = schema("mceip-problem-1");

    for path in json_files("spec/examples") {
        let file = path.display().to_string();
        let example = read_json(&path);

        if example["format"] != "mceip-problem/1" {
            continue;
        }

        valid(&problems, &example, &file);
        if !example["system"]["radii"].is_null() {
            continue; // a set of bodies has no pencil
        }

        let reduced = serde_json::from_str(&run(&format!("reduce {file}")).stdout).unwrap();
        valid(&problems, &reduced, &format!("reduce {file}"));

        what_is_written_for_a_problem_is_valid(&file);
    }
}

/// Bodies under loads: what the reader takes the schema takes, and of damaged files neither.
#[test]
fn bodies_under_loads_are_valid() {
    let loads = schema("mceip-loads-1");
    let file = root("spec/examples/loads.json");
    let text = std::fs::read_to_string(&file).unwrap();
    valid(&loads, &read_json(&file), "loads.json");

    for (from, to) in [
        ("loads/1", "loads/2"),
        ("\"gap\": 0.05", "\"gaps\": 0.05"),
        ("\"gap\": 0.05", "\"state\": \"stick\""),
        ("\"normal_direction\": -1", "\"normal_direction\": 2"),
        ("[6, -1]", "[6]"),
        ("[6, -1]", "[\"6\", -1]"),
        ("[6, -1]", "[6, true]"),
        ("\"steps\"", "\"loads\""),
        ("\"candidates\"", "\"particles\""),
        (
            "\"displacements\": [[6, 0]",
            "\"until\": 1, \"displacements\": [[6, 0]",
        ),
    ] {
        let damaged = text.replace(from, to);
        assert_ne!(damaged, text, "{from}");
        let value: Value = serde_json::from_str(&damaged).unwrap();
        assert!(!loads.is_valid(&value), "schema: {from} -> {to}");
        assert!(
            read_loads(&damaged, Path::new(".")).is_err(),
            "reader: {from} -> {to}"
        );
    }
}

/// The solutions and certificates of all commands that write them.
fn what_is_written_for_a_problem_is_valid(problem: &str) {
    let solutions = schema("mceip-solutions-1");
    let certificates = schema("mceip-certificate-1");

    let listed = run(&format!("enumerate {problem} --json")).stdout;
    let listed = serde_json::from_str(&listed).unwrap();
    valid(&solutions, &listed, &format!("enumerate {problem}"));

    for command in ["solve", "complete"] {
        let folder = Folder::new();
        let certificate = folder.path("c.json");
        let what = format!("{command} {problem}");

        let found = run(&format!("{what} --json --certificate {certificate}"));
        let found = serde_json::from_str(&found.stdout).unwrap();
        valid(&solutions, &found, &what);
        valid(&certificates, &read_json(Path::new(&certificate)), &what);
    }
}

/// The first line of a trace is a JSON object.
#[track_caller]
fn trace_is_valid(trace: &str) {
    let text = std::fs::read_to_string(trace).unwrap();
    let first = text.lines().next().unwrap();
    let head = serde_json::from_str(first).unwrap();

    valid(&schema("mceip-trace-1"), &head, first);
}

#[test]
fn traces_and_plain_problems_are_valid() {
    let folder = Folder::new();
    let trace = folder.path("trace.txt");
    exits(0, &format!("solve {} --trace {trace}", example("fold")));

    trace_is_valid(&trace);

    let mcp = schema("mceip-mcp-1");
    let plain = json!({
        "format": "mceip-mcp/1",
        "m": [[2, 1], [1, 2]],
        "q": [-5, "-6"],
        "lower": [null, 0],
        "upper": [3, null],
    });

    valid(&mcp, &plain, "mcp");

    let problem = folder.write("mcp.json", &plain.to_string());

    let solution = folder.path("z.json");
    exits(0, &format!("solve {problem} --certificate {solution}"));

    let solution = read_json(Path::new(&solution));
    valid(
        &schema("mceip-mcp-solution-1"),
        &solution,
        "solution of an mcp",
    );

    let listed = run(&format!("solve {problem} --all --json --trace {trace}"));
    let listed = serde_json::from_str(&listed.stdout).unwrap();
    valid(
        &schema("mceip-mcp-solutions-1"),
        &listed,
        "solutions of an mcp",
    );

    trace_is_valid(&trace);

    for bad in [
        json!({ "format": "mceip-mcp/1", "m": [["nan"]], "q": [-5] }),
        json!({ "format": "mceip-mcp/1", "m": [[1]], "q": [1], "z": 0 }),
    ] {
        assert!(!mcp.is_valid(&bad), "{bad}");
        assert!(read_mcp(&bad.to_string()).is_err(), "{bad}");
    }
}

/// The pack, the index, and every problem, answer and wrong answer in it.
#[test]
fn the_pack_is_valid() {
    let problems = schema("mceip-problem-1");
    let solutions = schema("mceip-solutions-1");
    let pack = schema("mceip-pack-1");
    let index = schema("mceip-pack-index-1");
    let mut cases = 0;

    let mut files = json_files("spec/conformance-pack");
    files.extend(json_files("spec/conformance-pack-2"));
    for path in files {
        let file = read_json(&path);
        if file["format"] == "mceip-pack-index/1" {
            valid(&index, &file, "index");
            continue;
        }

        valid(&pack, &file, &path.display().to_string());
        for case in file["cases"].as_array().unwrap() {
            let id = case["id"].as_str().unwrap();
            valid(&problems, &case["problem"], id);
            valid(&solutions, &case["answer"], id);

            for wrong in case["wrong"].as_array().unwrap() {
                valid(&solutions, &wrong["report"], id);
            }

            cases += 1;
        }
    }

    assert!(cases > 200, "{cases}");
}

/// Runs that are committed, and one that is made.
#[test]
fn runs_of_conform_are_valid() {
    let runs = schema("mceip-conform-1");
    for rival in ["semismooth-newton", "siconos"] {
        let path = root(&format!("spec/rivals/tier2-{rival}.json"));
        valid(&runs, &read_json(&path), rival);
    }

    let made = run("conform --only window_end --json -- true").stdout;
    let mut made: Value = serde_json::from_str(&made).unwrap();
    valid(&runs, &made, "a run");
    made["results"][0]["label"] = json!("perfect");
    assert!(!runs.is_valid(&made));
}

/// Is this a complaint about the shape of the file, which the schema must share?
fn of_shape(error: &ModelError) -> bool {
    matches!(
        error,
        ModelError::Json { .. }
            | ModelError::Format { .. }
            | ModelError::Body { .. }
            | ModelError::Sign { .. }
    )
}

/// Each malformed file: refused by the schema as well, or (`meaning`) only by what the numbers
/// mean.
#[test]
fn malformed_problems_are_invalid_or_wrong_in_meaning() {
    let meaning = [
        "curvature-factor-range",
        "curvature-factor-range-beside",
        "curvature-flat-reaction-zero",
        "curvature-flat-stick",
        "curvature-free",
        "curvature-mu",
        "curvature-radii-mass",
        "curvature-radii-stiffness",
        "curvature-reaction-positive",
        "curvature-reaction-zero",
        "curvature-reactions-differ",
        "curvature-stick",
        "curvature-zero",
        "friction-factor-zero",
        "friction-zero",
        "index-out-of-range",
        "mass-not-definite",
        "missing-market-file",
        "non-symmetric",
        "not-square",
        "particle-twice",
        "quadratic-not-square",
        "quadratic-other-order",
        "ragged",
        "reaction-outside-cone",
        "window-negative",
        "window-reversed",
    ];
    let problems = schema("mceip-problem-1");
    let mut seen = 0;

    for path in json_files("tests/malformed") {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        let error = read_problem(&text, Path::new("/nonexistent")).unwrap_err();
        let value = serde_json::from_str::<Value>(&text);
        let accepted = value.is_ok_and(|value| problems.is_valid(&value));

        // A duplicate key is gone before a schema sees the value: the reader is stricter by nature.
        let stricter = ["duplicate-key", "curvature-duplicate"].contains(&name.as_str());
        let of_meaning = meaning.contains(&name.as_str());
        assert_eq!(accepted, stricter || of_meaning, "{name}: {error}");

        if accepted && !stricter {
            assert!(!of_shape(&error), "{name}: {error}");
        }

        seen += usize::from(accepted && !stricter);
    }

    assert_eq!(seen, meaning.len());
}

/// Every place of a file replaced by values of other kinds, left out, or with an unknown field in
/// it.
fn damaged(file: &Value) -> Vec<Value> {
    let places = places(file, &|_| true);
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

    let mut list = Vec::new();
    for (k, place) in places.iter().enumerate().skip(1) {
        for turn in 0..3 {
            let replacement = &replacements[(3 * k + turn) % replacements.len()];
            let mut copy = file.clone();
            *copy.pointer_mut(place).unwrap() = replacement.clone();
            list.push(copy);
        }

        let mut without = file.clone();
        let (parent, last) = place.rsplit_once('/').unwrap();

        match without.pointer_mut(parent).unwrap() {
            Value::Object(fields) => drop(fields.remove(last)),
            Value::Array(items) => drop(items.remove(last.parse().unwrap())),
            _ => unreachable!(),
        }

        list.push(without);

        let mut with_unknown_field = file.clone();
        if let Value::Object(fields) = with_unknown_field.pointer_mut(place).unwrap() {
            fields.insert("stranger".into(), json!(1));
            list.push(with_unknown_field);
        }

        let mut list_for_object = file.clone();
        let target = list_for_object.pointer_mut(place).unwrap();

        if let Value::Object(fields) = target {
            *target = fields.values().cloned().collect();
            list.push(list_for_object);
        }
    }
    list
}

/// A problem with every form that a matrix may have, and its window.
fn problem_with_all_forms() -> Value {
    json!({
        "format": "mceip-problem/1",
        "unknown": "mu",
        "name": null,
        "comment": "c",
        "window": { "min": 0, "max": null },
        "pencil": {
            "a": { "dense": [[1]], "read_as": "f64" },
            "b": { "rows": 1, "cols": 1, "symmetric": true, "entries": [[0, 0, "1/2"]] },
            "free": [0],
        },
    })
}

/// The two particles with coordinates and warnings.
fn problem_with_coordinates() -> Value {
    let mut problem = read_json(repository("spec/examples/two-particles.json"));
    problem["coordinates"] = json!({
        "nodes": [[0, 1, 0, "1/3"], [2, 3, "1e-3", 0], [null, null, 1, 1]],
        "edges": [[0, 1]],
        "particles": ["left", ""],
    });
    problem["warnings"] = json!(["the rows of K sum to zero to 1e-5 only", ""]);
    problem
}

/// The reader of problems and the schema agree on the shape of thousands of damaged files.
#[test]
fn the_reader_of_problems_and_the_schema_agree() {
    let problems = schema("mceip-problem-1");
    let market = json!({ "a": { "matrix_market": "a.mtx" }, "b": [[1]] });
    let market = serde_json::from_str(&pencil_problem("mu", market)).unwrap();
    let files = [
        read_json(repository("spec/examples/two-particles.json")),
        problem_with_coordinates(),
        read_json(repository("spec/examples/oblique.json")),
        read_json(repository("spec/examples/fold.json")),
        problem_with_all_forms(),
        market,
    ];
    let mut accepted = 0;
    let mut wrong_in_meaning = 0;
    let mut wrong_in_shape = 0;

    for copy in files.iter().flat_map(damaged) {
        let valid = problems.is_valid(&copy);
        let text = copy.to_string();

        match read_problem(&text, &root("spec/examples")) {
            Ok(_) => {
                assert!(valid, "read, and invalid: {text}");
                accepted += 1;
            }
            // What is wrong in shape comes before what is wrong in meaning only within one step of
            // the reader.
            Err(error) if valid => {
                assert!(!of_shape(&error), "refused ({error}), and valid: {text}");
                wrong_in_meaning += 1;
            }
            Err(_) => wrong_in_shape += 1,
        }
    }

    assert!(accepted > 40, "{accepted}");
    assert!(wrong_in_meaning > 30, "{wrong_in_meaning}");
    assert!(wrong_in_shape > 400, "{wrong_in_shape}");
}

/// Every certificate of the corpus that is read is valid, and a support leaf that is none is not.
#[test]
fn the_corpus_is_valid() {
    let certificates = schema("mceip-certificate-1");
    let critical = schema("mceip-critical-1");
    let presence = schema("mceip-presence-1");
    let stability = schema("mceip-stability-1");
    let equilibrium = schema("mceip-equilibrium-1");
    let loads = schema("mceip-loads-1");
    let mcp = schema("mceip-mcp-1");
    let mcp_solution = schema("mceip-mcp-solution-1");

    let mut plain = 0;
    let mut leaves = 0;

    for Entry {
        name, file, code, ..
    } in entries()
    {
        if code == MALFORMED {
            if name.starts_with("malformed/support-leaf-") {
                support_leaf_is_invalid(&certificates, &name, &file);
                leaves += 1;
            }
            continue;
        }

        let is_plain = file["problem"]["format"] == "mceip-mcp/1";
        let is_loads = file["problem"]["format"] == "mceip-loads/1";
        if is_loads {
            valid(&loads, &file["problem"], &name);
        }
        if is_plain {
            valid(&mcp, &file["problem"], &name);
            plain += 1;
        }

        let format = &file["certificate"]["format"];
        let its_schema = if is_plain {
            &mcp_solution
        } else if format == "mceip-critical/1" {
            &critical
        } else if format == "mceip-presence/1" {
            &presence
        } else if format == "mceip-stability/1" {
            &stability
        } else if is_loads {
            &equilibrium
        } else {
            &certificates
        };

        if let Some(certificate) = file.get("certificate") {
            valid(its_schema, certificate, &name);
        }
    }

    assert!(plain >= 19, "{plain}");

    assert!(leaves >= 8, "{leaves}");
}

fn support_leaf_is_invalid(certificates: &Validator, name: &str, file: &Value) {
    let text = file["certificate_text"].as_str().unwrap();
    let certificate = serde_json::from_str(text).unwrap();

    // That 1/2 is no integer follows from its meaning: a schema cannot divide.
    let of_meaning = name == "malformed/support-leaf-coefficient-fraction";
    let is_valid = certificates.is_valid(&certificate);
    assert_eq!(is_valid, of_meaning, "{name}");
}

/// How many files a schema took and refused.
#[derive(Debug, Default)]
struct Tally {
    valid: usize,
    invalid: usize,
}

impl Tally {
    fn count(&mut self, is_valid: bool) {
        if is_valid {
            self.valid += 1;
        } else {
            self.invalid += 1;
        }
    }

    /// Of each damaged copy the schema says what it has to; `expected`: whether it has to take the
    /// text, and what the reader answers.
    fn agree(
        &mut self,
        schema: &Validator,
        files: &[Value],
        expected: impl Fn(&str) -> (bool, String),
    ) {
        for copy in files.iter().flat_map(damaged) {
            let is_valid = schema.is_valid(&copy);
            let (expected, read) = expected(&copy.to_string());
            assert_eq!(is_valid, expected, "{copy}: {read}");
            self.count(is_valid);
        }
    }
}

/// A schema has to take what is read, and what is refused for its meaning alone.
fn taken_unless<T: Debug, E: Debug>(
    read: Result<T, E>,
    is_of_meaning: impl Fn(&E) -> bool,
) -> (bool, String) {
    let is_taken = read.as_ref().err().is_none_or(is_of_meaning);
    (is_taken, format!("{read:?}"))
}

/// The same for foreign reports and certificates, whose readers check shapes only.
#[test]
fn the_readers_of_reports_and_certificates_agree_with_the_schemas() {
    let mut tally = Tally::default();

    damaged_reports_agree(&mut tally);
    damaged_certificates_agree(&mut tally);
    damaged_frictions_agree(&mut tally);
    damaged_equilibria_agree(&mut tally);

    assert!(tally.invalid > 50, "{tally:?}");
    assert!(tally.valid > 5, "{tally:?}");
}

fn damaged_reports_agree(tally: &mut Tally) {
    let solutions = schema("mceip-solutions-1");
    let text = std::fs::read_to_string(example("fold")).unwrap();
    let problem = read_problem(&text, &root("spec/examples")).unwrap();
    let reduced = reduce(&problem).unwrap();
    let interval = json!({ "from": { "value": "0", "included": true }, "to": null });

    let report = json!({
        "format": "mceip-solutions/1",
        "problem_sha256": problem.sha256(),
        "solutions": [{ "value": 1, "x": ["1/2", 3] }],
        "continua": [{ "slip": [0], "intervals": [interval] }],
    });

    tally.agree(&solutions, &[report], |text| {
        let read = ForeignReport::read(text, &problem, &reduced);
        let expected = match &read {
            // A solution without x is judged by itself; the schema wants one in each.
            Ok(report) => !has_a_solution_without_vector(report),
            // 1e400 is a number and no double; digests are not of the shape.
            Err(ForeignError::File(ModelError::Number { .. })) => true,
            Err(ForeignError::Digest { .. }) => true,
            Err(_) => false,
        };
        (expected, format!("{read:?}"))
    });
}

fn has_a_solution_without_vector(report: &ForeignReport) -> bool {
    let mut bad_points = report.solutions.iter().filter_map(|s| s.as_ref().err());
    bad_points.any(|bad| matches!(bad, BadPoint::NoVector { .. }))
}

fn damaged_certificates_agree(tally: &mut Tally) {
    let schema = schema("mceip-certificate-1");
    let folder = Folder::new();
    let written = folder.path("c.json");

    exits(
        0,
        &format!("complete {} --certificate {written}", example("fold")),
    );

    let mut certificates = vec![read_json(Path::new(&written))];
    for name in [
        "one-support-cone",
        "one-support-alone-by-inequalities",
        "one-support-free",
        "absence-ldl-interval",
        "lifted",
    ] {
        certificates.push(entry(&format!("accept/{name}")).file["certificate"].take());
    }

    for copy in certificates.iter().flat_map(damaged) {
        let is_valid = schema.is_valid(&copy);
        let read = Certificate::from_json(&copy.to_string());

        // The schema is open for kinds of claims and nodes; it must take all that is read.
        assert!(is_valid || read.is_err(), "read, and invalid: {copy}");
        tally.count(is_valid);
    }
}

/// Absence, presence and stability on an interval of friction: the schemas list every kind of node.
fn damaged_frictions_agree(tally: &mut Tally) {
    // That -1/2 is no integer follows from its meaning: a schema cannot divide.
    let is_of_meaning = |e: &dyn Display| e.to_string().contains("expected an integer");
    let example = |name: &str| {
        read_json(repository(&format!(
            "spec/examples/certificates/{name}.json"
        )))
    };

    let absences = ["critical", "critical-free"].map(example);
    tally.agree(&schema("mceip-critical-1"), &absences, |text| {
        taken_unless(CriticalCertificate::from_json(text), |e| is_of_meaning(e))
    });

    let presences = ["presence", "presence-fold", "presence-free"].map(example);
    tally.agree(&schema("mceip-presence-1"), &presences, |text| {
        taken_unless(PresenceCertificate::from_json(text), |e| is_of_meaning(e))
    });

    let stabilities = ["stability", "stability-free"].map(example);
    tally.agree(&schema("mceip-stability-1"), &stabilities, |text| {
        taken_unless(StabilityCertificate::from_json(text), |e| is_of_meaning(e))
    });
}

/// Contact states under loads.
fn damaged_equilibria_agree(tally: &mut Tally) {
    let is_of_meaning = |e: &dyn Display| e.to_string().contains("expected an integer");
    let accepted = |name: &str| {
        let file = read_json(root(&format!("spec/corpus/accept/equilibrium-{name}.json")));
        file["certificate"].clone()
    };

    let certificates = ["stick", "slip-box", "zero", "free"].map(accepted);
    tally.agree(&schema("mceip-equilibrium-1"), &certificates, |text| {
        taken_unless(EquilibriumCertificate::from_json(text), |e| {
            is_of_meaning(e)
        })
    });
}

/// Plain problems and their solution files.
#[test]
fn the_readers_of_plain_problems_agree_with_the_schemas() {
    let mut tally = Tally::default();

    // Lengths that do not fit and crossed bounds are of the meaning.
    let problem = read_json(repository("spec/examples/bounded-mcp.json"));
    tally.agree(&schema("mceip-mcp-1"), &[problem], |text| {
        taken_unless(read_mcp(text), |e| matches!(e, FileError::Mcp(_)))
    });

    let solution = json!({
        "format": "mceip-mcp-solution/1",
        "problem_sha256": "ab",
        "z": [["4/3", 2], [1, "-0.5"]],
    });
    tally.agree(&schema("mceip-mcp-solution-1"), &[solution], |text| {
        taken_unless(read_solution(text), |_| false)
    });

    assert!(tally.invalid > 50, "{tally:?}");
    assert!(tally.valid > 20, "{tally:?}");
}
