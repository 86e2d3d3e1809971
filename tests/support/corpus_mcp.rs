//! Solution files of plain LCPs and MCPs: each line of the definition kept, and broken by as little
//! as it takes.
//!
//! z solves if lower <= z <= upper, F(z) = m z + q is zero between the bounds, at least zero at the
//! lower and at most zero at the upper one. The points are computed by hand. Deviations of 1e-30
//! are rejected, which a checker that works in doubles would not see.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::{Cases, Misspelling, replaced};
use mceip_engine::lcp::{read_mcp, write_solution};
use mceip_exact::parse;
use serde_json::{Value, json};

type Point = [&'static str];

/// Both unknowns between their bounds at z = (4/3, 7/3).
fn lcp() -> Value {
    json!({
        "format": "mceip-mcp/1",
        "m": [["0.2", "0.1"], ["1/10", "2/10"]],
        "q": ["-0.5", "-0.6"],
    })
}

const LCP_SOLUTION: &Point = &["4/3", "7/3"];

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

const EVERY_BOUND_SOLUTION: &Point = &["5/6", "1/2", "1", "2"];

/// Every point of the segment from (1, 0) to (0, 1) solves.
fn segment() -> Value {
    json!({ "format": "mceip-mcp/1", "m": [[1, 1], [1, 1]], "q": [-1, -1] })
}

/// F = 1 - z on [0, 3]: solved by both bounds and by 1.
fn three_solutions() -> Value {
    json!({ "format": "mceip-mcp/1", "m": [[-1]], "q": [1], "upper": [3] })
}

/// F = z + q of one unknown.
fn one_unknown(q: &str) -> Value {
    json!({ "format": "mceip-mcp/1", "m": [[1]], "q": [q] })
}

/// The solution file that names the digest of the problem.
fn solution(problem: &Value, points: &[&Point]) -> Value {
    let problem = read_mcp(&problem.to_string()).unwrap();

    let mut exact = Vec::new();
    for point in points {
        exact.push(point.iter().map(|text| parse(text).unwrap()).collect());
    }
    serde_json::from_str(&write_solution(&problem, &exact)).unwrap()
}

pub fn plain(cases: &mut Cases) {
    accepted(cases);
    points_beside_the_definition(cases);
    points_off_the_bounds(cases);
    points_of_the_wrong_sign(cases);
    hostile(cases);
    malformed(cases, &lcp());
}

fn accept(cases: &mut Cases, name: &str, note: &str, problem: &Value, points: &[&Point]) {
    let file = json!({
        "verdict": "accepted",
        "problem": problem,
        "certificate": solution(problem, points),
    });

    cases.push("accept", &format!("mcp-{name}"), file, note);
}

/// A solution file and the obligation that it breaks.
struct Rejected {
    name: &'static str,
    reason: &'static str,
    note: &'static str,
    problem: Value,
    solution: Value,
}

impl Rejected {
    fn push(self, cases: &mut Cases) {
        let file = json!({
            "verdict": "rejected",
            "reason": self.reason,
            "problem": self.problem,
            "certificate": self.solution,
        });
        cases.push("reject", &format!("mcp-{}", self.name), file, self.note);
    }
}

/// Points that do not solve the problem.
struct NoSolution {
    name: &'static str,
    reason: &'static str,
    note: &'static str,
    problem: Value,
    points: &'static [&'static Point],
}

impl NoSolution {
    fn push(self, cases: &mut Cases) {
        let rejected = Rejected {
            name: self.name,
            reason: self.reason,
            note: self.note,
            solution: solution(&self.problem, self.points),
            problem: self.problem,
        };
        rejected.push(cases);
    }
}

fn accepted(cases: &mut Cases) {
    accept(
        cases,
        "lcp",
        "both between their bounds",
        &lcp(),
        &[LCP_SOLUTION],
    );

    accept(
        cases,
        "bounds",
        "between, free, upper and equal bounds",
        &every_bound("2"),
        &[EVERY_BOUND_SOLUTION],
    );

    accept(
        cases,
        "degenerate",
        "one of a segment of solutions, an end of it, and the other",
        &segment(),
        &[&["1/3", "2/3"], &["1", "0"], &["0", "1"]],
    );

    accept(
        cases,
        "biactive",
        "z = F = 0",
        &json!({ "format": "mceip-mcp/1", "m": [[1]], "q": [0] }),
        &[&["0"]],
    );

    accept(
        cases,
        "three",
        "lower bound, between, upper bound: three points in one file",
        &three_solutions(),
        &[&["0"], &["1"], &["3"]],
    );
}

/// Files that are refused before a component is looked at.
fn points_beside_the_definition(cases: &mut Cases) {
    let of_another = Rejected {
        name: "other-problem",
        reason: "Digest",
        note: "the solution of another problem",
        problem: every_bound("1.999"),
        solution: solution(&every_bound("2"), &[EVERY_BOUND_SOLUTION]),
    };
    of_another.push(cases);

    let list = [
        NoSolution {
            name: "no-point",
            reason: "NoClaims",
            note: "no point proves nothing",
            problem: lcp(),
            points: &[],
        },
        NoSolution {
            name: "short",
            reason: "Length",
            note: "one component missing",
            problem: lcp(),
            points: &[&["4/3"]],
        },
        NoSolution {
            name: "long",
            reason: "Length",
            note: "one component too many",
            problem: lcp(),
            points: &[&["4/3", "7/3", "0"]],
        },
    ];

    for forged in list {
        forged.push(cases);
    }
}

fn points_off_the_bounds(cases: &mut Cases) {
    let list = [
        NoSolution {
            name: "below-lower",
            reason: "Bounds",
            note: "z_0 = -1e-30",
            problem: segment(),
            points: &[&["-1e-30", "1.000000000000000000000000000001"]],
        },
        NoSolution {
            name: "above-upper",
            reason: "Bounds",
            note: "z = 3 + 1e-30",
            problem: three_solutions(),
            points: &[&["3.000000000000000000000000000001"]],
        },
        NoSolution {
            name: "off-equal-bounds",
            reason: "Bounds",
            note: "z_3 = 2 - 1e-30 where both bounds are 2",
            problem: every_bound("2"),
            points: &[&["5/6", "1/2", "1", "1.999999999999999999999999999999"]],
        },
    ];

    for forged in list {
        forged.push(cases);
    }
}

fn points_of_the_wrong_sign(cases: &mut Cases) {
    let list = [
        NoSolution {
            name: "between-1e-30",
            reason: "Sign",
            note: "F_0 of the size 1e-31 between the bounds",
            problem: lcp(),
            points: &[&[
                "1.333333333333333333333333333333",
                "2.333333333333333333333333333333",
            ]],
        },
        NoSolution {
            name: "free-row",
            reason: "Sign",
            note: "F_1 = 1/1000 at a free unknown",
            problem: every_bound("2"),
            points: &[&["5/6", "1001/2000", "1", "2"]],
        },
        NoSolution {
            name: "lower-negative-1e-30",
            reason: "Sign",
            note: "F = -1e-30 at the lower bound: no double sees it",
            problem: one_unknown("-1e-30"),
            points: &[&["0"]],
        },
        NoSolution {
            name: "upper-positive-1e-30",
            reason: "Sign",
            note: "F_2 = 1e-30 at the upper bound",
            problem: every_bound("2.000000000000000000000000000001"),
            points: &[EVERY_BOUND_SOLUTION],
        },
        NoSolution {
            name: "second-false",
            reason: "Sign",
            note: "the first point is a solution, the second is none",
            problem: three_solutions(),
            points: &[&["1"], &["1/2"]],
        },
        NoSolution {
            name: "rounded",
            reason: "Sign",
            note: "1.3333333333333333 for 4/3",
            problem: lcp(),
            points: &[&["1.3333333333333333", "2.3333333333333335"]],
        },
        NoSolution {
            name: "infeasible",
            reason: "Sign",
            note: "a point far out on the ray of a problem without a solution",
            problem: json!({ "format": "mceip-mcp/1", "m": [[-1]], "q": [-1] }),
            points: &[&["1e6"]],
        },
    ];

    for forged in list {
        forged.push(cases);
    }
}

/// 64 unknowns, any z solves; one component of 99,999 digits is more than will be multiplied.
fn hostile(cases: &mut Cases) {
    let order = 64;
    let problem = json!({
        "format": "mceip-mcp/1",
        "m": vec![vec![0; order]; order],
        "q": vec![0; order],
        "lower": vec![Value::Null; order],
    });

    let mut point = vec!["0"; order];
    point[0] = "1";
    let honest = solution(&problem, &[&point[..]]).to_string();
    let text = honest.replacen("[\"1\"", "[\"1@\"", 1);

    let file = json!({
        "verdict": "rejected",
        "reason": "TooLarge",
        "problem": problem,
        "certificate_text": text,
        "repeat": { "mark": "@", "unit": "7", "count": 99_999 },
    });

    cases.push(
        "reject",
        "mcp-hostile-size",
        file,
        "one component of 100,000 digits of 64",
    );
}

/// Changes of the solution file of `lcp` after which it cannot be read.
const MISSPELLINGS: [Misspelling; 11] = [
    Misspelling {
        name: "other-format",
        note: "a certificate of an eigenproblem",
        from: "mceip-mcp-solution/1",
        to: "mceip-certificate/1",
    },
    Misspelling {
        name: "version",
        note: "version 2",
        from: "mceip-mcp-solution/1",
        to: "mceip-mcp-solution/2",
    },
    Misspelling {
        name: "flat",
        note: "a point where a list of points belongs",
        from: "[[\"4/3\",\"7/3\"]]",
        to: "[\"4/3\",\"7/3\"]",
    },
    Misspelling {
        name: "nan",
        note: "NaN as a number",
        from: "\"4/3\"",
        to: "NaN",
    },
    Misspelling {
        name: "null",
        note: "no number",
        from: "\"4/3\"",
        to: "null",
    },
    Misspelling {
        name: "zero-denominator",
        note: "4/0",
        from: "\"4/3\"",
        to: "\"4/0\"",
    },
    Misspelling {
        name: "gigabyte",
        note: "ten bytes that spell a gigabyte",
        from: "\"4/3\"",
        to: "\"1e999999999\"",
    },
    Misspelling {
        name: "unknown-field",
        note: "a field that might mean something",
        from: "\"z\":",
        to: "\"trust\":true,\"z\":",
    },
    Misspelling {
        name: "duplicate-key",
        note: "z twice, the first one empty",
        from: "\"z\":",
        to: "\"z\":[],\"z\":",
    },
    Misspelling {
        name: "no-digest",
        note: "no digest",
        from: "\"problem_sha256\":",
        to: "\"digest\":",
    },
    Misspelling {
        name: "truncated",
        note: "the last brackets missing",
        from: "\"7/3\"]]}",
        to: "\"7/3\"",
    },
];

fn malformed(cases: &mut Cases, problem: &Value) {
    let text = solution(problem, &[LCP_SOLUTION]).to_string();

    for misspelling in MISSPELLINGS {
        let name = format!("mcp-{}", misspelling.name);
        let file = json!({
            "verdict": "malformed",
            "problem": problem,
            "certificate_text": replaced(&text, misspelling.from, misspelling.to),
        });
        cases.push("malformed", &name, file, misspelling.note);
    }
}
