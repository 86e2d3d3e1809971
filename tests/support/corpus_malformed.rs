//! Files that say nothing that could be judged: exit 2, one line, bounded time and memory. Long
//! ones are spelt short: `certificate_text` with `mark` replaced by `count` copies of `unit`.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{Claim, Node};
use mceip_model::file::write_problem;
use serde_json::{Value, json};

pub fn malformed(cases: &mut Cases) {
    let (p, good) = root_two();
    let problem: Value = serde_json::from_str(&write_problem(&p)).unwrap();
    let text = claims(&p, Claim::ExactSolution(good)).to_json();
    let mut add = |name: &str, note: &str, text: String, repeat: Option<(&str, usize)>| {
        let mut file =
            json!({ "verdict": "malformed", "problem": problem, "certificate_text": text });
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
    add(
        "truncated",
        "cut in the middle",
        text[..text.len() / 2].into(),
        None,
    );
    add(
        "truncated-by-one",
        "the last brace missing",
        text[..text.len() - 1].into(),
        None,
    );
    add(
        "trailing",
        "two certificates in one file",
        format!("{text}{text}"),
        None,
    );
    add("list", "a list of certificates", format!("[{text}]"), None);
    let note = "500 coefficients of 5,000 digits for 3 kB: an exponent beyond 400";
    add(
        "hostile-exponent",
        note,
        swap("\"polynomial\":[", "\"polynomial\":[@"),
        Some(("1e5000,", 500)),
    );
    add(
        "wrong-version",
        "version 2",
        swap("mceip-certificate/1", "mceip-certificate/2"),
        None,
    );
    add(
        "wrong-format",
        "a solution report",
        swap("mceip-certificate/1", "mceip-solutions/1"),
        None,
    );
    add(
        "no-format",
        "no version at all",
        swap("\"format\":\"mceip-certificate/1\",", ""),
        None,
    );
    add(
        "duplicate-key",
        "claims twice, the second one empty",
        swap("\"claims\":", "\"claims\":[],\"claims\":"),
        None,
    );
    add(
        "duplicate-key-inside",
        "support twice",
        swap("\"support\":[0,1]", "\"support\":[0,1],\"support\":[0]"),
        None,
    );
    add(
        "unknown-field",
        "a field that might mean something",
        swap("\"claims\":", "\"trust\":true,\"claims\":"),
        None,
    );
    add(
        "unknown-field-inside",
        "the same in a claim",
        swap("\"support\":", "\"trust\":true,\"support\":"),
        None,
    );
    add(
        "unknown-claim",
        "a kind of a later version",
        swap("exact_solution", "oracle_says_so"),
        None,
    );
    add(
        "claims-missing",
        "no list of claims",
        swap("\"claims\":", "\"complete_set\":"),
        None,
    );
    add(
        "window-missing",
        "no window",
        swap("\"window\":", "\"complete_set\":"),
        None,
    );
    add(
        "window-reversed",
        "min > max",
        swap("\"max\":null", "\"max\":\"-1\""),
        None,
    );
    add(
        "window-negative",
        "min < 0",
        swap("\"min\":\"0\"", "\"min\":\"-1\""),
        None,
    );
    add(
        "unknown-word",
        "an unknown that is none",
        swap("\"lambda2\"", "\"lambda\""),
        None,
    );
    add(
        "support-negative",
        "index -1",
        swap("\"support\":[0,1]", "\"support\":[-1,1]"),
        None,
    );
    add(
        "support-string",
        "an index as a string",
        swap("\"support\":[0,1]", "\"support\":[\"0\",1]"),
        None,
    );
    add(
        "support-fraction",
        "index 0.5",
        swap("\"support\":[0,1]", "\"support\":[0.5,1]"),
        None,
    );
    add(
        "support-no-list",
        "a number for a list",
        swap("\"support\":[0,1]", "\"support\":1"),
        None,
    );
    add(
        "polynomial-fraction",
        "a coefficient that is no integer",
        swap("\"-1\"", "\"-1.5\""),
        None,
    );
    add(
        "polynomial-object",
        "an object for a list",
        swap("\"polynomial\":[", "\"polynomial\":{\"0\":[").replacen(
            "\"interval\"",
            "}\"interval\"",
            1,
        ),
        None,
    );
    add("interval-short", "one end", swap("\"2/5\",", ""), None);
    add(
        "interval-long",
        "three ends",
        swap("\"2/5\",", "\"2/5\",\"2/5\","),
        None,
    );
    add("interval-null", "no end", swap("\"2/5\"", "null"), None);
    add("zero-denominator", "2/0", swap("\"2/5\"", "\"2/0\""), None);
    add("nan", "NaN as a number", swap("\"2/5\"", "NaN"), None);
    add(
        "nan-string",
        "NaN as a string",
        swap("\"2/5\"", "\"NaN\""),
        None,
    );
    add(
        "infinity",
        "an infinite end",
        swap("\"1/2\"", "\"inf\""),
        None,
    );
    add(
        "gigabyte-integer",
        "ten bytes that spell a gigabyte",
        swap("\"-1\"", "\"1e999999999\""),
        None,
    );
    add(
        "gigabyte-number",
        "the same as a JSON number",
        swap("\"-1\"", "1e999999999"),
        None,
    );
    add(
        "gigabyte-fraction",
        "the same below the point",
        swap("\"2/5\"", "\"1e-999999999\""),
        None,
    );
    add(
        "exponent-5001",
        "one beyond the limit",
        swap("\"1/2\"", "\"1e5001\""),
        None,
    );
    add(
        "digits-100001",
        "one digit beyond the limit",
        swap("\"1/2\"", "\"@\""),
        Some(("7", 100_001)),
    );
    add(
        "deep",
        "a hundred thousand brackets",
        swap("\"claims\":", "\"claims\":@"),
        Some(("[", 100_000)),
    );
    add(
        "deep-objects",
        "a hundred thousand objects",
        "@".into(),
        Some(("{\"format\":", 100_000)),
    );
    let plain = fold("15/8", Some("17/8"));
    let problem: Value = serde_json::from_str(&write_problem(&plain)).unwrap();
    let text = cover(
        &plain,
        vec![Node::Split(q("2")), Node::Farkas(vec![1, 2]), Node::Open],
    )
    .to_json();
    let mut add = |name: &str, note: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from} not in {text}");
        let file = json!({ "verdict": "malformed", "problem": problem, "certificate_text": text.replacen(from, to, 1) });
        cases.push("malformed", name, file, note);
    };
    add(
        "leaf-unknown",
        "a leaf that is none",
        "\"open\"",
        "\"closed\"",
    );
    add(
        "leaf-with-data",
        "a word with a value",
        "\"open\"",
        "{\"open\":1}",
    );
    add(
        "leaf-two-kinds",
        "two kinds in one node",
        "{\"split\":\"2\"}",
        "{\"split\":\"2\",\"branch\":0}",
    );
    add(
        "branch-string",
        "an index as a string",
        "{\"split\":\"2\"}",
        "{\"branch\":\"0\"}",
    );
    add(
        "farkas-65-bits",
        "a weight beyond 64 bits",
        "[1,2]",
        "[1,9223372036854775808]",
    );
    add(
        "farkas-string",
        "a weight as a string",
        "[1,2]",
        "[1,\"2\"]",
    );
    add(
        "farkas-fraction",
        "a weight that is no integer",
        "[1,2]",
        "[1,2.5]",
    );
    add(
        "pieces-object",
        "an object for a list",
        "\"pieces\":[",
        "\"pieces\":{\"0\":[",
    );
    add(
        "piece-without-max",
        "a piece that does not end",
        "\"max\":\"17/8\",\"tree\"",
        "\"tree\"",
    );
}

/// The grammar of numbers, words and keys (spec/formats.md, Spelling): what two readers have read
/// differently.
pub fn spelling(cases: &mut Cases) {
    let (p, good) = root_two();
    let problem: Value = serde_json::from_str(&write_problem(&p)).unwrap();
    let text = claims(&p, Claim::ExactSolution(good)).to_json();
    let swap = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from} not in {text}");
        text.replacen(from, to, 1)
    };
    let numbers = [
        ("\"2/5\"", "\".4\""),
        ("\"1/2\"", "\"+5.E-0001\""),
        ("\"-1\"", "-1.000e+0"),
        ("\"2\"", "\"-14/-7\""),
        ("\"1\"", "\"1.\""),
    ];
    let spelt = numbers
        .iter()
        .fold(text.clone(), |text, (from, to)| swap(&text, from, to));
    let note = "points without digits beside them, signs, leading zeros, a negative denominator: \
                numbers all the same";
    cases.push(
        "accept",
        "spelling-numbers",
        json!({ "verdict": "accepted", "problem": problem, "certificate_text": spelt }),
        note,
    );

    let mut add = |name: &str, note: &str, from: &str, to: &str| {
        let file = json!({ "verdict": "malformed", "problem": problem, "certificate_text": swap(&text, from, to) });
        cases.push("malformed", &format!("spelling-{name}"), file, note);
    };
    add("blanks", "blanks around a number", "\"2/5\"", "\" 2/5 \"");
    add(
        "newline",
        "a line end after a number",
        "\"2/5\"",
        "\"2/5\\n\"",
    );
    add(
        "no-break-space",
        "a blank of Unicode",
        "\"2/5\"",
        "\"2/5\\u00a0\"",
    );
    add(
        "blank-inside",
        "a blank beside the stroke",
        "\"2/5\"",
        "\"2 /5\"",
    );
    add(
        "arabic-digit",
        "a digit that is not ASCII",
        "\"2/5\"",
        "\"\\u0662/5\"",
    );
    add("hexadecimal", "0x", "\"-1\"", "\"0x1\"");
    add("underscore", "1_0", "\"-1\"", "\"-1_0\"");
    add("two-strokes", "p/q/r", "\"2/5\"", "\"2/5/1\"");
    add("two-signs", "a sign too many", "\"-1\"", "\"+-1\"");
    add("point-alone", "a point and no digit", "\"-1\"", "\".\"");
    add(
        "exponent-empty",
        "an exponent without digits",
        "\"-1\"",
        "\"-1e\"",
    );
    add(
        "exponent-fraction",
        "an exponent that is no integer",
        "\"-1\"",
        "\"-1e0.0\"",
    );
    add(
        "decimal-quotient",
        "a quotient of decimals",
        "\"2/5\"",
        "\"0.4/1\"",
    );
    add("json-plus", "a JSON number with a plus sign", "\"2\"", "+2");
    add(
        "json-zero",
        "a JSON number that begins with 0",
        "\"2\"",
        "02",
    );
    add(
        "json-point",
        "a JSON number that ends with a point",
        "\"2\"",
        "2.",
    );
    add(
        "minus-zero",
        "the index -0",
        "\"support\":[0,1]",
        "\"support\":[-0,1]",
    );
    add(
        "index-point",
        "the index 1.0",
        "\"support\":[0,1]",
        "\"support\":[0,1.0]",
    );
    add(
        "index-exponent",
        "the index 1e0",
        "\"support\":[0,1]",
        "\"support\":[0,1e0]",
    );
    add(
        "index-65-bits",
        "an index beyond 64 bits",
        "\"support\":[0,1]",
        "\"support\":[0,18446744073709551616]",
    );
    add(
        "byte-order-mark",
        "a byte order mark",
        "{\"format\"",
        "\u{feff}{\"format\"",
    );
    add(
        "private-key",
        "an object that a reader takes for a number",
        "\"2/5\"",
        "{\"$serde_json::private::Number\":\"0.4\"}",
    );
    let escaped = "{\"\\u0024serde_json::private::Number\":\"0.4\"}";
    add(
        "private-key-escaped",
        "the same spelt with an escape",
        "\"2/5\"",
        escaped,
    );
    add(
        "word-object",
        "a word as an object",
        "\"lambda2\"",
        "{\"lambda2\":null}",
    );
    add(
        "escaped-duplicate",
        "a key twice, once with an escape",
        "\"claims\":",
        "\"cl\\u0061ims\":[],\"claims\":",
    );
    add(
        "claims-null",
        "null for a list",
        "\"biactive\":[]",
        "\"biactive\":null",
    );
    add(
        "digest-number",
        "a number for a digest",
        "\"problem_sha256\":\"",
        "\"problem_sha256\":1,\"problem_sha256\":\"",
    );
    add(
        "surrogate",
        "half of a character",
        "\"problem_sha256\":\"",
        "\"problem_sha256\":\"\\ud800",
    );
    let first = "\"claims\":[";
    let false_one = "{\"exact_solution\":{\"support\":[0],\"biactive\":[],\"polynomial\":[\"-7\",\"1\"],\"interval\":[\"1\",\"2\"],\"x\":[[]]}},";
    add(
        "after-a-false-claim",
        "a false claim, then one without shape",
        first,
        &format!("{first}{false_one}{{\"exact_solution\":{{}}}},"),
    );

    let plain = fold("15/8", Some("17/8"));
    let problem: Value = serde_json::from_str(&write_problem(&plain)).unwrap();
    let around = ("31/16", "33/16");
    let tree = fold_tree(root_node(
        around,
        mceip_check::certificate::RootOutcome::Solution,
    ));
    let solved = cover(&plain, tree).to_json();
    let open = cover(&plain, vec![Node::Open]).to_json();
    let mut add = |name: &str, note: &str, text: &str, from: &str, to: &str| {
        let file = json!({ "verdict": "malformed", "problem": problem, "certificate_text": swap(text, from, to) });
        cases.push("malformed", &format!("spelling-{name}"), file, note);
    };
    add(
        "open-object",
        "a leaf that is a word, as an object",
        &open,
        "\"open\"",
        "{\"open\":null}",
    );
    add(
        "outcome-object",
        "an outcome that is a word, as an object",
        &solved,
        "\"solution\"",
        "{\"solution\":null}",
    );
    add(
        "outcome-word",
        "an outcome that is an object, as a word",
        &solved,
        "\"solution\"",
        "\"infinity\"",
    );
    add(
        "pivot-minus-zero",
        "the pivot -0",
        &solved,
        "\"pivot\":0",
        "\"pivot\":-0",
    );
    add(
        "exponent-33-bits",
        "an exponent beyond 32 bits",
        &solved,
        "\"exponent\":20",
        "\"exponent\":4294967296",
    );
    add(
        "after-a-false-leaf",
        "a false leaf, then one that is none",
        &solved,
        "{\"farkas\":[0,0]}",
        "{\"farkas\":[1]},{\"farkas\":[\"1\"]}",
    );
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
    add(
        "hostile-degree",
        "degree 10^6",
        "\"polynomial\":[",
        "\"polynomial\":[@",
        "0,",
        1_000_000,
    );
    add(
        "hostile-degree-x",
        "x of degree 10^6",
        "\"x\":[[",
        "\"x\":[[@",
        "1,",
        1_000_000,
    );
    let digits = format!("{},", "7".repeat(5000));
    let note = "500 coefficients of 5,000 digits, spelt out";
    add(
        "hostile-size-spelt",
        note,
        "\"polynomial\":[",
        "\"polynomial\":[@",
        &digits,
        500,
    );
}
