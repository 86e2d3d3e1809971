//! Files that say nothing that could be judged: exit 2, one line, bounded time and memory. Long ones are
//! spelt short: `certificate_text` with `mark` replaced by `count` copies of `unit`.
#![allow(missing_docs, unreachable_pub)]

use super::corpus::*;
use mceip::certificate::{Claim, Node};
use mceip::model::file::write_problem;
use serde_json::{Value, json};

pub fn malformed(cases: &mut Cases) {
    let (p, good) = root_two();
    let problem: Value = serde_json::from_str(&write_problem(&p)).unwrap();
    let text = claims(&p, Claim::ExactSolution(good)).to_json();
    let mut add = |name: &str, note: &str, text: String, repeat: Option<(&str, usize)>| {
        let mut file = json!({ "verdict": "malformed", "problem": problem, "certificate_text": text });
        if let Some((unit, count)) = repeat {
            file["repeat"] = json!({ "mark": "@", "unit": unit, "count": count });
        }
        cases.push("malformed", name, file, note);
    };
    let swap = |from: &str, to: &str| {
        assert!(text.contains(from), "{from} not in {text}");
        text.replacen(from, to, 1)
    };
    add("empty", "no byte", String::new(), None);
    add("not-json", "prose", "t is about 0.41".into(), None);
    add("truncated", "cut in the middle", text[..text.len() / 2].into(), None);
    add("truncated-by-one", "the last brace missing", text[..text.len() - 1].into(), None);
    add("trailing", "two certificates in one file", format!("{text}{text}"), None);
    add("list", "a list of certificates", format!("[{text}]"), None);
    let note = "500 coefficients of 5,000 digits for 3 kB: an exponent beyond 400";
    add("hostile-exponent", note, swap("\"polynomial\":[", "\"polynomial\":[@"), Some(("1e5000,", 500)));
    add("wrong-version", "version 2", swap("mceip-certificate/1", "mceip-certificate/2"), None);
    add("wrong-format", "a solution report", swap("mceip-certificate/1", "mceip-solutions/1"), None);
    add("no-format", "no version at all", swap("\"format\":\"mceip-certificate/1\",", ""), None);
    add("duplicate-key", "claims twice, the second one empty", swap("\"claims\":", "\"claims\":[],\"claims\":"), None);
    add("duplicate-key-inside", "support twice", swap("\"support\":[0,1]", "\"support\":[0,1],\"support\":[0]"), None);
    add("unknown-field", "a field that might mean something", swap("\"claims\":", "\"trust\":true,\"claims\":"), None);
    add("unknown-field-inside", "the same in a claim", swap("\"support\":", "\"trust\":true,\"support\":"), None);
    add("unknown-claim", "a kind of a later version", swap("exact_solution", "oracle_says_so"), None);
    add("claims-missing", "no list of claims", swap("\"claims\":", "\"complete_set\":"), None);
    add("window-missing", "no window", swap("\"window\":", "\"complete_set\":"), None);
    add("window-reversed", "min > max", swap("\"max\":null", "\"max\":\"-1\""), None);
    add("window-negative", "min < 0", swap("\"min\":\"0\"", "\"min\":\"-1\""), None);
    add("unknown-word", "an unknown that is none", swap("\"lambda2\"", "\"lambda\""), None);
    add("support-negative", "index -1", swap("\"support\":[0,1]", "\"support\":[-1,1]"), None);
    add("support-string", "an index as a string", swap("\"support\":[0,1]", "\"support\":[\"0\",1]"), None);
    add("support-fraction", "index 0.5", swap("\"support\":[0,1]", "\"support\":[0.5,1]"), None);
    add("support-no-list", "a number for a list", swap("\"support\":[0,1]", "\"support\":1"), None);
    add("polynomial-fraction", "a coefficient that is no integer", swap("\"-1\"", "\"-1.5\""), None);
    add(
        "polynomial-object",
        "an object for a list",
        swap("\"polynomial\":[", "\"polynomial\":{\"0\":[").replacen("\"interval\"", "}\"interval\"", 1),
        None,
    );
    add("interval-short", "one end", swap("\"2/5\",", ""), None);
    add("interval-long", "three ends", swap("\"2/5\",", "\"2/5\",\"2/5\","), None);
    add("interval-null", "no end", swap("\"2/5\"", "null"), None);
    add("zero-denominator", "2/0", swap("\"2/5\"", "\"2/0\""), None);
    add("nan", "NaN as a number", swap("\"2/5\"", "NaN"), None);
    add("nan-string", "NaN as a string", swap("\"2/5\"", "\"NaN\""), None);
    add("infinity", "an infinite end", swap("\"1/2\"", "\"inf\""), None);
    add("gigabyte-integer", "ten bytes that spell a gigabyte", swap("\"-1\"", "\"1e999999999\""), None);
    add("gigabyte-number", "the same as a JSON number", swap("\"-1\"", "1e999999999"), None);
    add("gigabyte-fraction", "the same below the point", swap("\"2/5\"", "\"1e-999999999\""), None);
    add("exponent-5001", "one beyond the limit", swap("\"1/2\"", "\"1e5001\""), None);
    add("digits-100001", "one digit beyond the limit", swap("\"1/2\"", "\"@\""), Some(("7", 100_001)));
    add("deep", "a hundred thousand brackets", swap("\"claims\":", "\"claims\":@"), Some(("[", 100_000)));
    add("deep-objects", "a hundred thousand objects", "@".into(), Some(("{\"format\":", 100_000)));
    let plain = fold("15/8", Some("17/8"));
    let problem: Value = serde_json::from_str(&write_problem(&plain)).unwrap();
    let text = cover(&plain, vec![Node::Split(q("2")), Node::Farkas(vec![1, 2]), Node::Open]).to_json();
    let mut add = |name: &str, note: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from} not in {text}");
        let file = json!({ "verdict": "malformed", "problem": problem, "certificate_text": text.replacen(from, to, 1) });
        cases.push("malformed", name, file, note);
    };
    add("leaf-unknown", "a leaf that is none", "\"open\"", "\"closed\"");
    add("leaf-with-data", "a word with a value", "\"open\"", "{\"open\":1}");
    add("leaf-two-kinds", "two kinds in one node", "{\"split\":\"2\"}", "{\"split\":\"2\",\"branch\":0}");
    add("branch-string", "an index as a string", "{\"split\":\"2\"}", "{\"branch\":\"0\"}");
    add("farkas-65-bits", "a weight beyond 64 bits", "[1,2]", "[1,9223372036854775808]");
    add("farkas-string", "a weight as a string", "[1,2]", "[1,\"2\"]");
    add("farkas-fraction", "a weight that is no integer", "[1,2]", "[1,2.5]");
    add("pieces-object", "an object for a list", "\"pieces\":[", "\"pieces\":{\"0\":[");
    add("piece-without-max", "a piece that does not end", "\"max\":\"17/8\",\"tree\"", "\"tree\"");
}

/// Small files that ask for much: rejected, with the limit named.
pub fn hostile(cases: &mut Cases) {
    let (p, good) = root_two();
    let problem: Value = serde_json::from_str(&write_problem(&p)).unwrap();
    let text = claims(&p, Claim::ExactSolution(good)).to_json();
    let mut add = |name: &str, note: &str, from: &str, to: &str, unit: &str, count: usize| {
        assert!(text.contains(from), "{from} not in {text}");
        let file = json!({ "verdict": "rejected", "reason": "TooLarge", "problem": problem, "certificate_text": text.replacen(from, to, 1),
            "repeat": { "mark": "@", "unit": unit, "count": count } });
        cases.push("reject", name, file, note);
    };
    add("hostile-degree", "degree 10^6", "\"polynomial\":[", "\"polynomial\":[@", "0,", 1_000_000);
    add("hostile-degree-x", "x of degree 10^6", "\"x\":[[", "\"x\":[[@", "1,", 1_000_000);
    let digits = format!("{},", "7".repeat(5000));
    let note = "500 coefficients of 5,000 digits, spelt out";
    add("hostile-size-spelt", note, "\"polynomial\":[", "\"polynomial\":[@", &digits, 500);
}
