//! Files that say nothing that could be judged: exit 2, one line, bounded time and memory. Long
//! ones are spelt short: `certificate_text` with `mark` replaced by `count` copies of `unit`.
//!
//! Each file is the text of an accepted certificate with one change, by which the text leaves the
//! grammar of `spec/formats.md`. A reader that is more lenient than the grammar accepts or rejects
//! the file, and exits with 0 or 1.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{Claim, Node, RootOutcome};
use mceip_model::Problem;
use serde_json::json;

/// `root_two` and the text of its certificate, which is accepted.
fn accepted() -> (Problem, String) {
    let (problem, claim) = root_two();
    let text = claims(&problem, Claim::ExactSolution(claim)).to_json();
    (problem, text)
}

fn push_repeated(cases: &mut Cases, name: &str, note: &str, repeated: &Repeated<'_>) {
    let (problem, _) = accepted();
    let file = json!({
        "verdict": "malformed",
        "problem": problem_json(&problem),
        "certificate_text": repeated.text,
        "repeat": { "mark": "@", "unit": repeated.unit, "count": repeated.count },
    });

    cases.push("malformed", name, file, note);
}

pub fn malformed(cases: &mut Cases) {
    let (problem, text) = accepted();

    no_certificate(cases);
    cases.misspelt("", &problem, &text, &FRAME);
    cases.misspelt("", &problem, &text, &VALUES);
    repeated(cases);

    let window = fold("15/8", Some("17/8"));
    let tree = vec![Node::Split(q("2")), farkas(&[1, 2]), Node::Open];
    let text = cover(&window, tree).to_json();
    cases.misspelt("", &window, &text, &NODES);
}

/// Texts that are not one JSON object with the right brackets.
fn no_certificate(cases: &mut Cases) {
    let (problem, text) = accepted();
    let middle = text.len() / 2;
    let before_last = text.len() - 1;
    let as_object = replaced(&text, "\"polynomial\":[", "\"polynomial\":{\"0\":[");

    let texts = [
        ("empty", "no byte", String::new()),
        ("not-json", "prose", "t is about 0.41".into()),
        ("truncated", "cut in the middle", text[..middle].into()),
        (
            "truncated-by-one",
            "the last brace missing",
            text[..before_last].into(),
        ),
        (
            "trailing",
            "two certificates in one file",
            format!("{text}{text}"),
        ),
        ("list", "a list of certificates", format!("[{text}]")),
        (
            "polynomial-object",
            "an object for a list",
            as_object.replacen("\"interval\"", "}\"interval\"", 1),
        ),
    ];

    for (name, note, text) in texts {
        cases.malformed(name, note, &problem, &text);
    }
}

/// Short files that spell long texts.
fn repeated(cases: &mut Cases) {
    let (_, text) = accepted();

    let long_numbers = Repeated {
        text: replaced(&text, "\"polynomial\":[", "\"polynomial\":[@"),
        unit: "1e5000,",
        count: 500,
    };

    push_repeated(
        cases,
        "hostile-exponent",
        "500 coefficients of 5,000 digits for 3 kB: an exponent beyond 400",
        &long_numbers,
    );

    let many_digits = Repeated {
        text: replaced(&text, "\"1/2\"", "\"@\""),
        unit: "7",
        count: 100_001,
    };

    push_repeated(
        cases,
        "digits-100001",
        "one digit beyond the limit",
        &many_digits,
    );

    let brackets = Repeated {
        text: replaced(&text, "\"claims\":", "\"claims\":@"),
        unit: "[",
        count: 100_000,
    };

    push_repeated(cases, "deep", "a hundred thousand brackets", &brackets);

    let objects = Repeated {
        text: "@".into(),
        unit: "{\"format\":",
        count: 100_000,
    };

    push_repeated(
        cases,
        "deep-objects",
        "a hundred thousand objects",
        &objects,
    );
}

/// The fields of a certificate, and which of them there are.
const FRAME: [Misspelling; 13] = [
    Misspelling {
        name: "wrong-version",
        note: "version 2",
        from: "mceip-certificate/1",
        to: "mceip-certificate/2",
    },
    Misspelling {
        name: "wrong-format",
        note: "a solution report",
        from: "mceip-certificate/1",
        to: "mceip-solutions/1",
    },
    Misspelling {
        name: "no-format",
        note: "no version at all",
        from: "\"format\":\"mceip-certificate/1\",",
        to: "",
    },
    Misspelling {
        name: "duplicate-key",
        note: "claims twice, the second one empty",
        from: "\"claims\":",
        to: "\"claims\":[],\"claims\":",
    },
    Misspelling {
        name: "duplicate-key-inside",
        note: "support twice",
        from: "\"support\":[0,1]",
        to: "\"support\":[0,1],\"support\":[0]",
    },
    Misspelling {
        name: "unknown-field",
        note: "a field that might mean something",
        from: "\"claims\":",
        to: "\"trust\":true,\"claims\":",
    },
    Misspelling {
        name: "unknown-field-inside",
        note: "the same in a claim",
        from: "\"support\":",
        to: "\"trust\":true,\"support\":",
    },
    Misspelling {
        name: "unknown-claim",
        note: "a kind of a later version",
        from: "exact_solution",
        to: "oracle_says_so",
    },
    Misspelling {
        name: "claims-missing",
        note: "no list of claims",
        from: "\"claims\":",
        to: "\"complete_set\":",
    },
    Misspelling {
        name: "window-missing",
        note: "no window",
        from: "\"window\":",
        to: "\"complete_set\":",
    },
    Misspelling {
        name: "window-reversed",
        note: "min > max",
        from: "\"max\":null",
        to: "\"max\":\"-1\"",
    },
    Misspelling {
        name: "window-negative",
        note: "min < 0",
        from: "\"min\":\"0\"",
        to: "\"min\":\"-1\"",
    },
    Misspelling {
        name: "unknown-word",
        note: "an unknown that is none",
        from: "\"lambda2\"",
        to: "\"lambda\"",
    },
];

/// What stands in the fields of a claim.
const VALUES: [Misspelling; 16] = [
    Misspelling {
        name: "support-negative",
        note: "index -1",
        from: "\"support\":[0,1]",
        to: "\"support\":[-1,1]",
    },
    Misspelling {
        name: "support-string",
        note: "an index as a string",
        from: "\"support\":[0,1]",
        to: "\"support\":[\"0\",1]",
    },
    Misspelling {
        name: "support-fraction",
        note: "index 0.5",
        from: "\"support\":[0,1]",
        to: "\"support\":[0.5,1]",
    },
    Misspelling {
        name: "support-no-list",
        note: "a number for a list",
        from: "\"support\":[0,1]",
        to: "\"support\":1",
    },
    Misspelling {
        name: "polynomial-fraction",
        note: "a coefficient that is no integer",
        from: "\"-1\"",
        to: "\"-1.5\"",
    },
    Misspelling {
        name: "interval-short",
        note: "one end",
        from: "\"2/5\",",
        to: "",
    },
    Misspelling {
        name: "interval-long",
        note: "three ends",
        from: "\"2/5\",",
        to: "\"2/5\",\"2/5\",",
    },
    Misspelling {
        name: "interval-null",
        note: "no end",
        from: "\"2/5\"",
        to: "null",
    },
    Misspelling {
        name: "zero-denominator",
        note: "2/0",
        from: "\"2/5\"",
        to: "\"2/0\"",
    },
    Misspelling {
        name: "nan",
        note: "NaN as a number",
        from: "\"2/5\"",
        to: "NaN",
    },
    Misspelling {
        name: "nan-string",
        note: "NaN as a string",
        from: "\"2/5\"",
        to: "\"NaN\"",
    },
    Misspelling {
        name: "infinity",
        note: "an infinite end",
        from: "\"1/2\"",
        to: "\"inf\"",
    },
    Misspelling {
        name: "gigabyte-integer",
        note: "ten bytes that spell a gigabyte",
        from: "\"-1\"",
        to: "\"1e999999999\"",
    },
    Misspelling {
        name: "gigabyte-number",
        note: "the same as a JSON number",
        from: "\"-1\"",
        to: "1e999999999",
    },
    Misspelling {
        name: "gigabyte-fraction",
        note: "the same below the point",
        from: "\"2/5\"",
        to: "\"1e-999999999\"",
    },
    Misspelling {
        name: "exponent-5001",
        note: "one beyond the limit",
        from: "\"1/2\"",
        to: "\"1e5001\"",
    },
];

/// The nodes of a cover that splits [15/8, 17/8] at 2.
const NODES: [Misspelling; 9] = [
    Misspelling {
        name: "leaf-unknown",
        note: "a leaf that is none",
        from: "\"open\"",
        to: "\"closed\"",
    },
    Misspelling {
        name: "leaf-with-data",
        note: "a word with a value",
        from: "\"open\"",
        to: "{\"open\":1}",
    },
    Misspelling {
        name: "leaf-two-kinds",
        note: "two kinds in one node",
        from: "{\"split\":\"2\"}",
        to: "{\"split\":\"2\",\"branch\":0}",
    },
    Misspelling {
        name: "branch-string",
        note: "an index as a string",
        from: "{\"split\":\"2\"}",
        to: "{\"branch\":\"0\"}",
    },
    Misspelling {
        name: "farkas-65-bits",
        note: "a weight beyond 64 bits",
        from: "[1,2]",
        to: "[1,9223372036854775808]",
    },
    Misspelling {
        name: "farkas-string",
        note: "a weight as a string",
        from: "[1,2]",
        to: "[1,\"2\"]",
    },
    Misspelling {
        name: "farkas-fraction",
        note: "a weight that is no integer",
        from: "[1,2]",
        to: "[1,2.5]",
    },
    Misspelling {
        name: "pieces-object",
        note: "an object for a list",
        from: "\"pieces\":[",
        to: "\"pieces\":{\"0\":[",
    },
    Misspelling {
        name: "piece-without-max",
        note: "a piece that does not end",
        from: "\"max\":\"17/8\",\"tree\"",
        to: "\"tree\"",
    },
];

/// Spellings of the numbers of `root_two` that are unusual and allowed.
const ALLOWED: [(&str, &str); 5] = [
    ("\"2/5\"", "\".4\""),
    ("\"1/2\"", "\"+5.E-0001\""),
    ("\"-1\"", "-1.000e+0"),
    ("\"2\"", "\"-14/-7\""),
    ("\"1\"", "\"1.\""),
];

/// A claim with the right shape that is false: no root of t - 7 lies in [1, 2].
const FALSE_CLAIM: &str = "{\"exact_solution\":{\"support\":[0],\"biactive\":[],\
                           \"polynomial\":[\"-7\",\"1\"],\"interval\":[\"1\",\"2\"],\"x\":[[]]}},";

/// The grammar of numbers, words and keys (spec/formats.md, Spelling): what two readers have read
/// differently.
pub fn spelling(cases: &mut Cases) {
    let (problem, text) = accepted();

    let mut respelt = text.clone();
    for (from, to) in ALLOWED {
        respelt = replaced(&respelt, from, to);
    }

    let file = json!({
        "verdict": "accepted",
        "problem": problem_json(&problem),
        "certificate_text": respelt,
    });

    cases.push(
        "accept",
        "spelling-numbers",
        file,
        "points without digits beside them, signs, leading zeros, a negative denominator: numbers \
         all the same",
    );

    cases.misspelt("spelling-", &problem, &text, &NUMBERS);
    cases.misspelt("spelling-", &problem, &text, &WORDS_AND_KEYS);

    // A reader that judges while it reads answers before it meets the second claim.
    let list = "\"claims\":[";
    let two_claims = format!("{list}{FALSE_CLAIM}{{\"exact_solution\":{{}}}},");
    cases.malformed(
        "spelling-after-a-false-claim",
        "a false claim, then one without shape",
        &problem,
        &replaced(&text, list, &two_claims),
    );

    let window = fold("15/8", Some("17/8"));
    let open = cover(&window, vec![Node::Open]).to_json();
    cases.misspelt("spelling-", &window, &open, &OPEN_LEAF);

    let tree = fold_tree(root_node(AROUND_TWO, RootOutcome::Solution));
    let solved = cover(&window, tree).to_json();
    cases.misspelt("spelling-", &window, &solved, &ROOT_LEAF);
}

/// Spellings of numbers that are not allowed.
const NUMBERS: [Misspelling; 18] = [
    Misspelling {
        name: "blanks",
        note: "blanks around a number",
        from: "\"2/5\"",
        to: "\" 2/5 \"",
    },
    Misspelling {
        name: "newline",
        note: "a line end after a number",
        from: "\"2/5\"",
        to: "\"2/5\\n\"",
    },
    Misspelling {
        name: "no-break-space",
        note: "a blank of Unicode",
        from: "\"2/5\"",
        to: "\"2/5\\u00a0\"",
    },
    Misspelling {
        name: "blank-inside",
        note: "a blank beside the stroke",
        from: "\"2/5\"",
        to: "\"2 /5\"",
    },
    Misspelling {
        name: "arabic-digit",
        note: "a digit that is not ASCII",
        from: "\"2/5\"",
        to: "\"\\u0662/5\"",
    },
    Misspelling {
        name: "hexadecimal",
        note: "0x",
        from: "\"-1\"",
        to: "\"0x1\"",
    },
    Misspelling {
        name: "underscore",
        note: "1_0",
        from: "\"-1\"",
        to: "\"-1_0\"",
    },
    Misspelling {
        name: "two-strokes",
        note: "p/q/r",
        from: "\"2/5\"",
        to: "\"2/5/1\"",
    },
    Misspelling {
        name: "two-signs",
        note: "a sign too many",
        from: "\"-1\"",
        to: "\"+-1\"",
    },
    Misspelling {
        name: "point-alone",
        note: "a point and no digit",
        from: "\"-1\"",
        to: "\".\"",
    },
    Misspelling {
        name: "exponent-empty",
        note: "an exponent without digits",
        from: "\"-1\"",
        to: "\"-1e\"",
    },
    Misspelling {
        name: "exponent-fraction",
        note: "an exponent that is no integer",
        from: "\"-1\"",
        to: "\"-1e0.0\"",
    },
    Misspelling {
        name: "decimal-quotient",
        note: "a quotient of decimals",
        from: "\"2/5\"",
        to: "\"0.4/1\"",
    },
    Misspelling {
        name: "json-plus",
        note: "a JSON number with a plus sign",
        from: "\"2\"",
        to: "+2",
    },
    Misspelling {
        name: "json-zero",
        note: "a JSON number that begins with 0",
        from: "\"2\"",
        to: "02",
    },
    Misspelling {
        name: "json-point",
        note: "a JSON number that ends with a point",
        from: "\"2\"",
        to: "2.",
    },
    Misspelling {
        name: "private-key",
        note: "an object that a reader takes for a number",
        from: "\"2/5\"",
        to: "{\"$serde_json::private::Number\":\"0.4\"}",
    },
    Misspelling {
        name: "private-key-escaped",
        note: "the same spelt with an escape",
        from: "\"2/5\"",
        to: "{\"\\u0024serde_json::private::Number\":\"0.4\"}",
    },
];

/// Indices, words, keys and characters that are not allowed.
const WORDS_AND_KEYS: [Misspelling; 10] = [
    Misspelling {
        name: "minus-zero",
        note: "the index -0",
        from: "\"support\":[0,1]",
        to: "\"support\":[-0,1]",
    },
    Misspelling {
        name: "index-point",
        note: "the index 1.0",
        from: "\"support\":[0,1]",
        to: "\"support\":[0,1.0]",
    },
    Misspelling {
        name: "index-exponent",
        note: "the index 1e0",
        from: "\"support\":[0,1]",
        to: "\"support\":[0,1e0]",
    },
    Misspelling {
        name: "index-65-bits",
        note: "an index beyond 64 bits",
        from: "\"support\":[0,1]",
        to: "\"support\":[0,18446744073709551616]",
    },
    Misspelling {
        name: "byte-order-mark",
        note: "a byte order mark",
        from: "{\"format\"",
        to: "\u{feff}{\"format\"",
    },
    Misspelling {
        name: "word-object",
        note: "a word as an object",
        from: "\"lambda2\"",
        to: "{\"lambda2\":null}",
    },
    Misspelling {
        name: "escaped-duplicate",
        note: "a key twice, once with an escape",
        from: "\"claims\":",
        to: "\"cl\\u0061ims\":[],\"claims\":",
    },
    Misspelling {
        name: "claims-null",
        note: "null for a list",
        from: "\"biactive\":[]",
        to: "\"biactive\":null",
    },
    Misspelling {
        name: "digest-number",
        note: "a number for a digest",
        from: "\"problem_sha256\":\"",
        to: "\"problem_sha256\":1,\"problem_sha256\":\"",
    },
    Misspelling {
        name: "surrogate",
        note: "half of a character",
        from: "\"problem_sha256\":\"",
        to: "\"problem_sha256\":\"\\ud800",
    },
];

/// Changes of an open leaf.
const OPEN_LEAF: [Misspelling; 1] = [Misspelling {
    name: "open-object",
    note: "a leaf that is a word, as an object",
    from: "\"open\"",
    to: "{\"open\":null}",
}];

/// Changes of a tree whose last leaf is a root leaf.
const ROOT_LEAF: [Misspelling; 5] = [
    Misspelling {
        name: "outcome-object",
        note: "an outcome that is a word, as an object",
        from: "\"solution\"",
        to: "{\"solution\":null}",
    },
    Misspelling {
        name: "outcome-word",
        note: "an outcome that is an object, as a word",
        from: "\"solution\"",
        to: "\"infinity\"",
    },
    Misspelling {
        name: "pivot-minus-zero",
        note: "the pivot -0",
        from: "\"pivot\":0",
        to: "\"pivot\":-0",
    },
    Misspelling {
        name: "exponent-33-bits",
        note: "an exponent beyond 32 bits",
        from: "\"exponent\":20",
        to: "\"exponent\":4294967296",
    },
    Misspelling {
        name: "after-a-false-leaf",
        note: "a false leaf, then one that is none",
        from: "{\"farkas\":[0,0]}",
        to: "{\"farkas\":[1]},{\"farkas\":[\"1\"]}",
    },
];

/// Small files that ask for much: rejected, with the limit named.
pub fn hostile(cases: &mut Cases) {
    let (_, text) = accepted();
    let long_polynomial = replaced(&text, "\"polynomial\":[", "\"polynomial\":[@");
    let long_component = replaced(&text, "\"x\":[[", "\"x\":[[@");
    let five_thousand_digits = format!("{},", "7".repeat(5000));

    let degree = Repeated {
        text: long_polynomial.clone(),
        unit: "0,",
        count: 1_000_000,
    };

    push_too_large(cases, "hostile-degree", "degree 10^6", &degree);

    let degree_of_x = Repeated {
        text: long_component,
        unit: "1,",
        count: 1_000_000,
    };

    push_too_large(cases, "hostile-degree-x", "x of degree 10^6", &degree_of_x);

    let size = Repeated {
        text: long_polynomial,
        unit: &five_thousand_digits,
        count: 500,
    };

    push_too_large(
        cases,
        "hostile-size-spelt",
        "500 coefficients of 5,000 digits, spelt out",
        &size,
    );
}

fn push_too_large(cases: &mut Cases, name: &str, note: &str, repeated: &Repeated<'_>) {
    let (problem, _) = accepted();
    cases.too_large([name, "TooLarge", note], &problem, repeated);
}
