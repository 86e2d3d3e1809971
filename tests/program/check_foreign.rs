//! `mceip check PROBLEM REPORT`: somebody's solutions accepted, refuted or left undecided, in one
//! line each.
//!
//! The problems are solved by hand or by the enumerator, so the right verdict of each point is
//! known. Points lie on both sides of each tolerance; a verdict that is too mild or too strict, or
//! a point that costs too much, fails.
#![cfg(feature = "cli")]

use crate::common::{
    contains_all, example, exits, exits_with_json, pencil_problem, read, run, solutions_text,
};
use crate::program::{Folder, mceip, refused};
use serde_json::{Value, json};
use std::io::Write as _;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// The verdict of `check`.
#[derive(Debug)]
struct Checked {
    code: i32,
    text: String,
}

impl Checked {
    /// The verdict has this exit code, begins with these words and has those.
    #[track_caller]
    fn says(&self, code: i32, start: &str, words: &[&str]) {
        assert_eq!(self.code, code, "{}", self.text);
        assert!(self.text.starts_with(start), "{start}: {}", self.text);
        contains_all(&self.text, words);
    }
}

/// Runs `check` on a report with these solutions.
fn check(problem: &str, solutions: &str) -> Checked {
    let folder = Folder::new();
    let report = folder.write("r.json", &solutions_text(solutions));
    let run = run(&["check", problem, &report]);

    Checked {
        code: run.code.unwrap(),
        text: run.stdout,
    }
}

/// The verdicts, in words, on a report of `tests/edges`.
fn verdicts_on(name: &str) -> Vec<String> {
    let [problem, report] =
        ["problem", "report"].map(|kind| format!("tests/edges/{name}-{kind}.json"));
    let checked = run(&["check", &problem, &report]);
    let words = checked.stdout.lines().map(|line| {
        let word = line.split(':').next();
        word.unwrap_or_default().to_string()
    });
    words.collect()
}

/// A free component is 5,000 times as large as the slip component. At largest |x_i| = 1 these x are
/// right to 2e-7 and better; at e'x_s = 1 the same digits are off by more than 1e-3.
#[test]
fn x_is_compared_in_the_scale_of_the_format() {
    assert_eq!(verdicts_on("repn"), ["ACCEPTED"; 7]);
}

/// The slip component is 3e-8 of the free one. Where it is reported as zero or below, by less than
/// 1e-6, the report has other positive components than the solution near it: nothing is refuted.
#[test]
fn a_tiny_component_reported_as_zero_is_undecided() {
    let verdicts = verdicts_on("repz");

    assert_eq!(verdicts[..3], ["ACCEPTED"; 3]);
    assert_eq!(verdicts[3..7], ["UNDECIDED"; 4]);
    assert_eq!(verdicts[7..], ["ACCEPTED"]);
}

/// Solutions of the enumerator, each as it is, with errors of 3e-7 and 3e-6 of the value, with one
/// of 1e-3 of it, with errors of 3e-7, 3e-6 and just 1e-3 of one component of x, as -x, and in
/// scales of 1e200 and 1e-200. What is within 1e-3 in x is near and not refuted.
#[test]
fn what_is_near_in_x_is_inaccurate_and_not_refuted() {
    let of_one_solution = [
        "ACCEPTED",
        "ACCEPTED",
        "INACCURATE",
        "REJECTED",
        "ACCEPTED",
        "INACCURATE",
        "INACCURATE",
        "REJECTED",
        "ACCEPTED",
        "ACCEPTED",
    ];

    let verdicts = verdicts_on("near-in-x");

    assert_eq!(verdicts.len(), 31);
    for of_this_one in verdicts[..30].chunks(10) {
        assert_eq!(of_this_one, of_one_solution);
    }
    assert_eq!(verdicts[30], "REJECTED");
}

/// The value is off, and every digit of x is right: the verdict does not name a worst component.
#[test]
fn a_verdict_says_which_part_agrees() {
    let fold = example("fold");

    let value_is_off = check(&fold, &point("2.00001", "[2,1]"));

    value_is_off.says(1, "INACCURATE", &["x agrees to 15 or more digits"]);
    assert!(!value_is_off.text.contains("is worst"));
}

/// A list of one solution.
fn point(value: &str, x: &str) -> String {
    format!(r#"[{{"value":{value},"x":{x}}}]"#)
}

#[test]
fn one_line_for_each_solution() {
    let fold = example("fold");
    let good = r#"{"value":2.00000,"x":[0.666667,0.333333]}"#;
    let accepted = "ACCEPTED: lambda2 = 2 exists with support {0, 1}; proved; its value agrees to \
                    15 or more digits, x to 6 digits\n";

    let checked = check(&fold, &format!("[{good}]"));
    assert_eq!(checked.code, 0);
    assert_eq!(checked.text, accepted);

    let wrong_value = check(&fold, &point("2.5", "[0.666667,0.333333]"));
    wrong_value.says(
        1,
        "REJECTED: lambda2 = 2.5: no solution",
        &["there is none at all"],
    );

    let wrong_x = check(&fold, &point("2", "[0.333333,0.666667]"));
    wrong_x.says(1, "", &["1 found with another x"]);

    let negative = check(&fold, &point("-1", "[1,1]"));
    negative.says(1, "", &[]);

    let zero = check(&fold, &point("2", "[0,0]"));
    zero.says(1, "", &["x != 0"]);

    let good_and_wrong = check(&fold, &format!(r#"[{good},{{"value":7,"x":[1,1]}}]"#));
    good_and_wrong.says(1, "ACCEPTED", &["\nREJECTED"]);
    assert_eq!(good_and_wrong.text.lines().count(), 2);

    let nothing = check(&fold, "[]");
    nothing.says(3, "UNDECIDED", &[]);
}

/// v over the dofs of a system, with and without a rate into the obstacle.
#[test]
fn a_mode_in_physical_dofs() {
    let system = example("two-particles");
    let listed = exits_with_json(0, &["enumerate", &system, "--json"]);

    for solution in listed["solutions"].as_array().unwrap() {
        let value = &solution["value"];
        let v = solution["v"].as_array().unwrap();
        let digits: Vec<&str> = v.iter().map(|entry| entry.as_str().unwrap()).collect();

        let as_listed = json!([{ "value": value, "v": v }]);
        check(&system, &as_listed.to_string()).says(0, "ACCEPTED: lambda2 = ", &[]);

        let mut lifted = v.clone();
        lifted[1] = json!("0.5");
        let lifted = json!([{ "value": value, "v": lifted }]);
        check(&system, &lifted.to_string()).says(1, "REJECTED: E9: v[1]", &[]);

        let turned: Vec<String> = digits.iter().map(|entry| entry.replace('-', "+")).collect();
        let turned = json!([{ "value": value, "v": turned }]);
        let checked = check(&system, &turned.to_string());

        if digits.iter().any(|entry| entry.starts_with('-')) {
            checked.says(1, "", &[]);
        }
    }

    vectors_of_wrong_length_are_rejected(&system);
    files_that_are_no_report_are_refused(&system);
}

#[track_caller]
fn vectors_of_wrong_length_are_rejected(system: &str) {
    let cases: [(&str, &[&str]); 4] = [
        (
            r#"[{"value":1,"v":[1,0]}]"#,
            &["solutions[0]", "v with 4", "got 2"],
        ),
        (
            r#"[{"value":1,"x":[1]}]"#,
            &["solutions[0]", "x with 2", "got 1"],
        ),
        (r#"[{"value":1}]"#, &["x or v"]),
        (r#"[{"value":1e399,"x":[1,1]}]"#, &["solutions[0].value"]),
    ];

    for (solutions, words) in cases {
        check(system, solutions).says(1, "REJECTED: ", words);
    }

    let v_of_a_pencil = check(&example("fold"), r#"[{"value":1,"v":[1,1]}]"#);
    v_of_a_pencil.says(1, "", &["expected x"]);
}

#[track_caller]
fn files_that_are_no_report_are_refused(system: &str) {
    let folder = Folder::new();
    let unread = folder.write("u.json", &solutions_text(&point("\"two\"", "[1,1]")));
    refused(&["check", &example("fold"), &unread], &["two"]);

    let of_another_problem = folder.write(
        "o.json",
        r#"{"format":"mceip-solutions/1","problem_sha256":"00","solutions":[]}"#,
    );
    let text = exits(1, &["check", system, &of_another_problem]);

    assert!(
        text.starts_with("REJECTED: the report names another"),
        "{text}"
    );
}

/// A point that fits nothing is judged by itself; the others are judged as if it were not there.
#[test]
fn a_bad_point_does_not_refuse_the_report() {
    let good = r#"{"value":2,"x":[2,1]}"#;

    for bad in [
        r#"{"value":2,"x":[2,1,0]}"#,
        r#"{"value":2,"x":[0,0]}"#,
        r#"{"value":2}"#,
        r#"{"value":1e400,"x":[2,1]}"#,
    ] {
        let checked = check(&example("fold"), &format!("[{good},{bad},{good}]"));

        let lines = checked.text.lines();
        let verdicts: Vec<&str> = lines.map(|line| line.split(':').next().unwrap()).collect();
        assert_eq!(checked.code, 1, "{bad}: {checked:?}");
        assert_eq!(
            verdicts,
            ["ACCEPTED", "REJECTED", "ACCEPTED"],
            "{bad}: {checked:?}"
        );
    }
}

/// On both sides of the tolerance, in the value and in x; the fold has lambda^2 = 2 with x = (2,
/// 1).
#[test]
fn a_report_agrees_up_to_the_tolerance() {
    let fold = example("fold");

    for (value, x) in [
        ("2.0000019", "[2,1]"),
        ("1.9999981", "[2,1]"),
        ("2", "[2,1.0000019]"),
        ("2", "[6000,3000.005]"),
    ] {
        check(&fold, &point(value, x)).says(0, "ACCEPTED: ", &[]);
    }

    for (value, x) in [
        ("2.0000021", "[2,1]"),
        ("1.9999979", "[2,1]"),
        ("2", "[2,1.0000021]"),
        ("2", "[6000,3000.006]"),
        ("2.0001", "[2,1]"),
        ("2", "[2,1.001]"),
    ] {
        check(&fold, &point(value, x)).says(1, "INACCURATE: ", &[]);
    }

    let inaccurate = check(&fold, &point("2.0001", "[2,1.001]"));
    contains_all(
        &inaccurate.text,
        &[
            "INACCURATE: lambda2 = 2.0001: lambda2 = 2 exists with support {0, 1}, \
             x = (1.000000000, 0.500000000)",
            "error of the value 5.0e-5",
            "x[1] is worst: expected 0.500000000, got 0.500500000, error 5.0e-4",
            "allowed 1e-6",
        ],
    );
}

/// x = (1, 0.001) is not (1, 0), which is the solution of diag(t - 1, t + 1); noise below the
/// tolerance is.
#[test]
fn a_component_that_should_be_zero() {
    let folder = Folder::new();
    let pencil = json!({ "a": [[-1, 0], [0, 1]], "b": [[1, 0], [0, 1]] });
    let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

    for small in ["0", "9e-7", "-9e-7"] {
        check(&problem, &point("1", &format!("[1,{small}]"))).says(0, "", &[]);
    }

    for large in ["1.1e-6", "-1.1e-6", "0.0009"] {
        let checked = check(&problem, &point("1", &format!("[1,{large}]")));
        checked.says(1, "", &["x[1] is worst: expected 0.000000000"]);
    }
}

/// Errors of the value 0 are measured by 1e-7 max|A| / max|B|: a thousand times larger values, a
/// thousand times more room.
#[test]
fn a_value_at_zero_has_the_scale_of_its_problem() {
    let folder = Folder::new();

    // t = 0 with x = (1, 1), on rows with |A||x| = 2 scale and |B||x| = 1.
    for (scale, inside, outside) in [(1, "1.9e-13", "2.1e-13"), (1000, "1.9e-10", "2.1e-10")] {
        let a = json!([[scale, -scale], [-scale, scale]]);
        let pencil = json!({ "a": a, "b": [[1, 0], [0, 1]] });
        let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

        check(&problem, &point("0", "[1,1]")).says(0, "", &[]);
        check(&problem, &point(inside, "[1,1]")).says(0, "", &[]);
        check(&problem, &point(outside, "[1,1]")).says(1, "", &[]);
    }
}

/// Where A vanishes on a solution's own rows nothing says what is small: only 0 is 0.
#[test]
fn a_value_without_a_scale_is_exact() {
    let folder = Folder::new();
    let pencil = json!({ "a": [["0", "0"], ["0", "1e14"]], "b": [[1, 0], [0, 1]] });
    let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

    check(&problem, &point("0", "[1,0]")).says(0, "", &[]);
    check(&problem, &point("1e-13", "[1,0]")).says(1, "", &[]);
    check(&problem, &point("9e-5", "[1,0]")).says(1, "", &[]);
}

/// `--tolerance` moves the border, within what doubles and the radius of certification allow.
#[test]
fn the_tolerance_is_an_option() {
    let folder = Folder::new();
    let fold = example("fold");
    let solutions = point("2.00001", "[2,1]");
    let report = folder.write("r.json", &solutions_text(&solutions));

    for (tolerance, expected) in [
        ("1e-5", 0),
        ("0.0000051", 0),
        ("4.9e-6", 1),
        ("1e-9", 1),
        ("1e-4", 0),
    ] {
        exits(
            expected,
            &["check", &fold, &report, "--tolerance", tolerance],
        );
    }

    for bad in ["0", "-1", "1", "2e-4", "1e-16", "small"] {
        refused(
            &["check", &fold, &report, &format!("--tolerance={bad}")],
            &["--tolerance", "from 1e-15 to 1e-4"],
        );
    }

    refused(
        &["check", &fold, &report, "--window", "0,1"],
        &["--window", "certificate only"],
    );
}

/// v in physical degrees of freedom: a rate of 1e-4 into the obstacle is no rounding.
#[test]
fn a_rate_off_the_constraints_counts_like_a_component() {
    let system = example("two-particles");
    let listed = exits_with_json(0, &["enumerate", &system, "--json"]);
    let solution = &listed["solutions"][0];

    for (rate, expected) in [("1e-9", 0), ("1e-4", 1), ("0.5", 1)] {
        let mut v = solution["v"].as_array().unwrap().clone();
        v[1] = json!(rate);
        let report = json!([{ "value": solution["value"], "v": v }]);

        let checked = check(&system, &report.to_string());

        assert_eq!(checked.code, expected, "{rate}: {checked:?}");
        assert!(
            checked.code == 0 || checked.text.contains("v[1]"),
            "{checked:?}"
        );
    }
}

/// At relative distances 1e-6 to 1e-12 of a threshold: below it the residual of t = 0 is as small,
/// and nothing exists; on it the same report is right, and above it the solution is near and is not
/// 0.
#[test]
fn near_a_threshold() {
    let folder = Folder::new();

    for power in 6..=12 {
        let distance = format!("1e-{power}");

        // (d + t) x = y has no solution for d > 0.
        let below = folder.write("below.json", &shifted(&distance));
        check(&below, &point("0", "[1,0]")).says(1, "REJECTED", &[]);
        check(&below, &point(&format!("\"{distance}\""), "[1,0]")).says(1, "", &[]);

        // For d <= 0 it has the solution t = -d.
        let above = folder.write("above.json", &shifted(&format!("-{distance}")));
        check(&above, &point("0", "[1,0]")).says(1, "INACCURATE", &[]);
        check(&above, &point(&format!("\"{distance}\""), "[1,0]")).says(0, "", &[]);
    }
}

/// The problem (d + t) x0 = y0, x0 + (3 + t) x1 = y1.
fn shifted(d: &str) -> String {
    let pencil = json!({ "a": [[d, "0"], ["1", "3"]], "b": [["1", "0"], ["0", "1"]] });
    pencil_problem("lambda2", pencil)
}

/// Runs the program with a text on stdin.
fn run_with_input(args: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();

    // A program that refuses its options closes the pipe before it has read all.
    let mut stdin = child.stdin.take().unwrap();
    _ = stdin.write_all(input.as_bytes());
    drop(stdin);

    child.wait_with_output().unwrap()
}

/// A problem or a report on stdin.
#[test]
fn stdin_is_a_file() {
    let fold = example("fold");
    let problem = read(&fold);

    let enumerated = run_with_input(&["enumerate", "-"], &problem);
    assert_eq!(enumerated.stdout, mceip(&["enumerate", &fold]).stdout);

    let solved = run_with_input(&["solve", "-", "--starts", "4"], &problem);
    assert_eq!(solved.status.code(), Some(0));

    let report = solutions_text(&point("3", "[3,1.5]"));
    let checked = run_with_input(&["check", &fold, "-"], &report);
    assert_eq!(checked.status.code(), Some(1));

    let bad = run_with_input(&["enumerate", "-"], "{");
    let message = String::from_utf8(bad.stderr).unwrap();
    assert_eq!(bad.status.code(), Some(2));
    assert!(message.starts_with("mceip: -: line 1"), "{message}");

    let twice = run_with_input(&["check", "-", "-"], &report);
    assert_eq!(twice.status.code(), Some(2));
}

/// A diagonal matrix as a sparse one of a problem file.
fn diagonal(order: usize, value: &str) -> Value {
    let entries: Vec<Value> = (0..order).map(|i| json!([i, i, value])).collect();
    json!({ "rows": order, "cols": order, "entries": entries })
}

/// Ten slip variables and a determinant with coefficients of 670 bits: each false point costs the
/// sum over k of C(10, k) k^5 ((1 + 670 k / 640)^2 + 3) products of words, and a report may spend
/// 2^30.
#[test]
fn a_report_has_a_largest_effort() {
    let folder = Folder::new();
    let pencil = json!({ "a": diagonal(10, "-1e20"), "b": diagonal(10, "1"), "free": [] });
    let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));
    let false_point = json!({ "value": 5, "x": [1, 0, 0, 0, 0, 0, 0, 0, 0, 0] });
    let report = json!(vec![false_point; 4]);

    let checked = check(&problem, &report.to_string());

    let lines: Vec<&str> = checked.text.lines().collect();
    assert_eq!(checked.code, 1, "{checked:?}");
    assert_eq!(lines.len(), 4, "{checked:?}");

    for line in &lines[..2] {
        assert!(
            line.starts_with("REJECTED: lambda2 = 5: no solution"),
            "{line}"
        );
    }

    for line in &lines[2..] {
        assert!(line.starts_with("UNDECIDED"), "{line}");
        assert!(line.contains("454430720 were needed"), "{line}");
        // (1e20 - 5) / (1e20 + 5), rounded up.
        assert!(line.ends_with("; backward error 1"), "{line}");
    }
}

/// The verdict of a check that must end within 5 s.
#[track_caller]
fn check_within_five_seconds(problem: &str, solutions: &str) -> Checked {
    let begun = Instant::now();
    let checked = check(problem, solutions);
    let elapsed = begun.elapsed();

    assert!(elapsed < Duration::from_secs(5), "{elapsed:?}");
    checked
}

/// A dense pencil with 35 free variables and 45 points that are near nothing: a report of 5 kB
/// within 5 s.
#[test]
fn points_near_nothing_cost_little() {
    let order = 40;
    let mut a = vec![vec![0; order]; order];

    for i in 0..order {
        for j in 0..order {
            a[i][j] = ((7 * i + 11 * j + i * j) % 6) as i64 - 2;
        }
    }

    let free: Vec<usize> = (5..order).collect();
    let pencil = json!({ "a": a, "b": diagonal(order, "1"), "free": free });
    let folder = Folder::new();
    let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

    let mut points = Vec::new();
    for k in 0..45 {
        let x: Vec<usize> = (0..order).map(|i| (i * k + i) % 4).collect();
        points.push(json!({ "value": k, "x": x }));
    }

    let checked = check_within_five_seconds(&problem, &json!(points).to_string());

    assert!(checked.code == 3 || checked.code == 1, "{checked:?}");
    assert_eq!(checked.text.lines().count(), 45, "{checked:?}");
    assert!(!checked.text.contains("ACCEPTED"), "{checked:?}");
}

/// Two equal rows of A and of B: every support with both has a determinant that is zero for all
/// values. Describing them took more than a minute.
#[test]
fn supports_that_are_singular_everywhere_are_not_enumerated() {
    let order = 9;
    let mut a = vec![vec![0; order]; order];
    let mut b = vec![vec![0; order]; order];

    for i in 0..order {
        for j in 0..order {
            let row = i.max(1); // row 0 is row 1
            a[i][j] = ((5 * row + 3 * j + 2 * row * j) % 7) as i64 - 3;
            b[i][j] = ((4 * row + 5 * j + 3 * row * j) % 7) as i64 - 3;
        }
    }

    let pencil = json!({ "a": a, "b": b, "free": [] });
    let folder = Folder::new();
    let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

    let checked = check_within_five_seconds(&problem, &point("1", "[1,1,1,1,1,1,1,1,1]"));

    assert_eq!(checked.code, 3, "{checked:?}");
    assert!(checked.text.contains("were needed"), "{checked:?}");
}

/// A value or an entry beyond doubles leaves the box without a preconditioner of bounded length:
/// undecided, at once.
#[test]
fn numbers_beyond_doubles_cost_little() {
    let folder = Folder::new();
    let a = json!({ "rows": 4, "cols": 4, "entries": [[1, 3, "1e400"]] });
    let pencil = json!({ "a": a, "b": diagonal(4, "1"), "free": [0] });
    let problem = folder.write("p.json", &pencil_problem("mu", pencil));

    let solutions = point("\"1e308\"", r#"["1","1","1","2"]"#);
    let checked = check_within_five_seconds(&problem, &solutions);

    assert!(checked.code == 3 || checked.code == 1, "{checked:?}");
}

/// A dense pencil of order 12 with numbers from 1e-99 to 1e99: enumerating 16 supports would take a
/// minute, and is not begun.
#[test]
fn long_determinants_are_not_enumerated() {
    let folder = Folder::new();
    let mut dense: Vec<Vec<String>> = Vec::new();

    for i in 0..12 {
        let mut row = Vec::new();
        for j in 0..12 {
            let digit = 1 + (3 * i + 5 * j) % 9;
            let exponent = (37 * i + 59 * j + i * j) % 199;
            let sign = if (i + j) % 2 == 0 { "-" } else { "" };
            row.push(format!("{digit}e{sign}{exponent}"));
        }
        dense.push(row);
    }

    let free: Vec<usize> = (4..12).collect();
    let pencil = json!({ "a": dense, "b": dense, "free": free });
    let problem = folder.write("p.json", &pencil_problem("mu", pencil));

    let solutions = point("3", "[1,1,1,1,1,1,1,1,1,1,1,1]");
    let checked = check_within_five_seconds(&problem, &solutions);

    assert_eq!(checked.code, 3, "{checked:?}");
}

/// One stiff variable that takes no part in a solution does not make a wrong value of that solution
/// right.
#[test]
fn a_stiff_variable_elsewhere_excuses_nothing() {
    let folder = Folder::new();

    for (value, reported) in [
        ("1", "1.0001"),
        ("1e-9", "1e-4"),
        ("1e-9", "2e-8"),
        ("1e-20", "9e-5"),
    ] {
        let a = json!([[format!("-{value}"), "0"], ["0", "1e14"]]);
        let pencil = json!({ "a": a, "b": [["1", "0"], ["0", "1"]], "free": [] });
        let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

        let wrong = check(&problem, &point(reported, "[1,0]"));
        assert_eq!(wrong.code, 1, "{value} reported as {reported}: {wrong:?}");
        let right = check(&problem, &point(value, "[1,0]"));
        assert_eq!(right.code, 0, "{value}: {right:?}");
    }
}

/// x may be given in any scale: it is scaled before it is rounded. A value that doubles hold with
/// few digits is none.
#[test]
fn numbers_below_the_normal_doubles() {
    let folder = Folder::new();
    let a = json!([["-3", "1"], ["1", "-3"]]);
    let pencil = json!({ "a": a, "b": [["1", "0"], ["0", "1"]], "free": [] });
    let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

    // The solution is x = (1, 1) at 2, in any scale.
    for x in ["5e-324", "1e-390", "1e390"] {
        let report = json!([{ "value": "2", "x": [x, x] }]);
        check(&problem, &report.to_string()).says(0, "ACCEPTED", &[]);
    }

    // Rounded before it is scaled, this would be the smallest double twice.
    let uneven = json!([{ "value": "2", "x": ["2.6e-324", "7.3e-324"] }]);
    check(&problem, &uneven.to_string()).says(1, "REJECTED", &[]);

    let tiny_value = json!([{ "value": "7.3e-324", "x": ["1", "1"] }]);
    check(&problem, &tiny_value.to_string()).says(
        1,
        "",
        &["solutions[0].value: expected 0 or a number between"],
    );
}
