//! Solution files of plain LCPs and MCPs: each line of the definition kept, and broken by as little
//! as it takes.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::Cases;
use mceip_engine::lcp::{read_mcp, write_solution};
use mceip_exact::parse;
use serde_json::{Value, json};

/// z = (5/6, 1/2, 1, 2): F_0 = z_0 + z_1 / 3 - 1 = 0 inside, F_1 = 2 z_1 - z_2 = 0 free, F_2 = q_2
/// - 2 z_2 <= 0 at the upper bound of [0, 1] for q_2 <= 2, and F_3 of any sign at equal bounds.
fn every_bound(q2: &str) -> Value {
    json!({
        "format": "mceip-mcp/1",
        "m": [[1, "1/3", 0, 0], [0, 2, -1, 0], [0, 0, -2, 0], [1, 0, 0, 0]],
        "q": [-1, 0, q2, "-1/7"],
        "lower": [0, null, 0, 2],
        "upper": [null, null, 1, 2],
    })
}

fn lcp() -> Value {
    json!({ "format": "mceip-mcp/1", "m": [["0.2", "0.1"], ["1/10", "2/10"]], "q": ["-0.5", "-0.6"] })
}

/// The solution file that names the digest of the problem.
fn of(problem: &Value, points: &[&[&str]]) -> Value {
    let problem = read_mcp(&problem.to_string()).unwrap();
    let points: Vec<Vec<_>> = points
        .iter()
        .map(|z| z.iter().map(|v| parse(v).unwrap()).collect())
        .collect();
    serde_json::from_str(&write_solution(&problem, &points)).unwrap()
}

pub fn plain(cases: &mut Cases) {
    let (lcp, bounds, degenerate) = (
        lcp(),
        every_bound("2"),
        json!({ "format": "mceip-mcp/1", "m": [[1, 1], [1, 1]], "q": [-1, -1] }),
    );
    let line = json!({ "format": "mceip-mcp/1", "m": [[-1]], "q": [1], "upper": [3] });
    let accepted: [(&str, &str, &Value, &[&[&str]]); 5] = [
        ("lcp", "both between their bounds", &lcp, &[&["4/3", "7/3"]]),
        (
            "bounds",
            "between, free, upper and equal bounds",
            &bounds,
            &[&["5/6", "1/2", "1", "2"]],
        ),
        (
            "degenerate",
            "one of a segment of solutions, an end of it, and the other",
            &degenerate,
            &[&["1/3", "2/3"], &["1", "0"], &["0", "1"]],
        ),
        (
            "biactive",
            "z = F = 0",
            &json!({ "format": "mceip-mcp/1", "m": [[1]], "q": [0] }),
            &[&["0"]],
        ),
        (
            "three",
            "lower bound, between, upper bound: three points in one file",
            &line,
            &[&["0"], &["1"], &["3"]],
        ),
    ];
    for (name, note, problem, points) in accepted {
        let file = json!({ "verdict": "accepted", "problem": problem, "certificate": of(problem, points) });
        cases.push("accept", &format!("mcp-{name}"), file, note);
    }
    let mut reject = |name: &str, reason: &str, note: &str, problem: &Value, certificate: Value| {
        let file = json!({ "verdict": "rejected", "reason": reason, "problem": problem, "certificate": certificate });
        cases.push("reject", &format!("mcp-{name}"), file, note);
    };
    reject(
        "other-problem",
        "Digest",
        "the solution of another problem",
        &every_bound("1.999"),
        of(&bounds, &[&["5/6", "1/2", "1", "2"]]),
    );
    reject(
        "no-point",
        "NoClaims",
        "no point proves nothing",
        &lcp,
        of(&lcp, &[]),
    );
    reject(
        "short",
        "Length",
        "one component missing",
        &lcp,
        of(&lcp, &[&["4/3"]]),
    );
    reject(
        "long",
        "Length",
        "one component too many",
        &lcp,
        of(&lcp, &[&["4/3", "7/3", "0"]]),
    );
    reject(
        "below-lower",
        "Bounds",
        "z_0 = -1e-30",
        &degenerate,
        of(
            &degenerate,
            &[&["-1e-30", "1.000000000000000000000000000001"]],
        ),
    );
    reject(
        "above-upper",
        "Bounds",
        "z = 3 + 1e-30",
        &line,
        of(&line, &[&["3.000000000000000000000000000001"]]),
    );
    reject(
        "off-equal-bounds",
        "Bounds",
        "z_3 = 2 - 1e-30 where both bounds are 2",
        &bounds,
        {
            of(
                &bounds,
                &[&["5/6", "1/2", "1", "1.999999999999999999999999999999"]],
            )
        },
    );
    reject(
        "between-1e-30",
        "Sign",
        "F_0 of the size 1e-31 between the bounds",
        &lcp,
        {
            of(
                &lcp,
                &[&[
                    "1.333333333333333333333333333333",
                    "2.333333333333333333333333333333",
                ]],
            )
        },
    );
    reject(
        "free-row",
        "Sign",
        "F_1 = 1/1000 at a free unknown",
        &bounds,
        of(&bounds, &[&["5/6", "1001/2000", "1", "2"]]),
    );
    let negative = json!({ "format": "mceip-mcp/1", "m": [[1]], "q": ["-1e-30"] });
    reject(
        "lower-negative-1e-30",
        "Sign",
        "F = -1e-30 at the lower bound: no double sees it",
        &negative,
        of(&negative, &[&["0"]]),
    );
    let positive = every_bound("2.000000000000000000000000000001");
    reject(
        "upper-positive-1e-30",
        "Sign",
        "F_2 = 1e-30 at the upper bound",
        &positive,
        of(&positive, &[&["5/6", "1/2", "1", "2"]]),
    );
    reject(
        "second-false",
        "Sign",
        "the first point is a solution, the second is none",
        &line,
        of(&line, &[&["1"], &["1/2"]]),
    );
    reject(
        "rounded",
        "Sign",
        "1.3333333333333333 for 4/3",
        &lcp,
        of(&lcp, &[&["1.3333333333333333", "2.3333333333333335"]]),
    );
    let infeasible = json!({ "format": "mceip-mcp/1", "m": [[-1]], "q": [-1] });
    reject(
        "infeasible",
        "Sign",
        "a point far out on the ray of a problem without a solution",
        &infeasible,
        of(&infeasible, &[&["1e6"]]),
    );
    hostile(cases);
    malformed(cases, &lcp);
}

/// 64 unknowns, any z solves; one component of 99,999 digits is more than will be multiplied.
fn hostile(cases: &mut Cases) {
    let n = 64;
    let problem = json!({ "format": "mceip-mcp/1", "m": vec![vec![0; n]; n], "q": vec![0; n], "lower": vec![Value::Null; n] });
    let mut point = vec!["0"; n];
    point[0] = "1";
    let text = of(&problem, &[&point])
        .to_string()
        .replacen("[\"1\"", "[\"1@\"", 1);
    let file = json!({ "verdict": "rejected", "reason": "TooLarge", "problem": problem, "certificate_text": text,
        "repeat": { "mark": "@", "unit": "7", "count": 99_999 } });
    cases.push(
        "reject",
        "mcp-hostile-size",
        file,
        "one component of 100,000 digits of 64",
    );
}

fn malformed(cases: &mut Cases, problem: &Value) {
    let text = of(problem, &[&["4/3", "7/3"]]).to_string();
    let mut add = |name: &str, note: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from} not in {text}");
        let file = json!({ "verdict": "malformed", "problem": problem, "certificate_text": text.replacen(from, to, 1) });
        cases.push("malformed", &format!("mcp-{name}"), file, note);
    };
    add(
        "other-format",
        "a certificate of an eigenproblem",
        "mceip-mcp-solution/1",
        "mceip-certificate/1",
    );
    add(
        "version",
        "version 2",
        "mceip-mcp-solution/1",
        "mceip-mcp-solution/2",
    );
    add(
        "flat",
        "a point where a list of points belongs",
        "[[\"4/3\",\"7/3\"]]",
        "[\"4/3\",\"7/3\"]",
    );
    add("nan", "NaN as a number", "\"4/3\"", "NaN");
    add("null", "no number", "\"4/3\"", "null");
    add("zero-denominator", "4/0", "\"4/3\"", "\"4/0\"");
    add(
        "gigabyte",
        "ten bytes that spell a gigabyte",
        "\"4/3\"",
        "\"1e999999999\"",
    );
    add(
        "unknown-field",
        "a field that might mean something",
        "\"z\":",
        "\"trust\":true,\"z\":",
    );
    add(
        "duplicate-key",
        "z twice, the first one empty",
        "\"z\":",
        "\"z\":[],\"z\":",
    );
    add(
        "no-digest",
        "no digest",
        "\"problem_sha256\":",
        "\"digest\":",
    );
    add(
        "truncated",
        "the last brackets missing",
        "\"7/3\"]]}",
        "\"7/3\"",
    );
}
