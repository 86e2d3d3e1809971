//! The pack as files: one per group and an index with counts and digests, byte for byte the same
//! each time.

use super::case::{Case, Draft, Group};
use super::error::ConformError;
use super::flag::Flag;
use super::wrong::Bug;
use mceip_model::file::{from_json, read_problem, read_text, require_format, write_problem};
use rayon::prelude::*;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

/// The format of a group of cases.
pub const PACK_FORMAT: &str = "mceip-pack/1";
/// The format of the index.
pub const INDEX_FORMAT: &str = "mceip-pack-index/1";

/// The files of the pack, name and content: groups in order, then `index.json`.
///
/// # Errors
/// [`ConformError`] for a problem beyond the plain oracle.
pub fn pack_files(groups: &[Group]) -> Result<Vec<(String, String)>, ConformError> {
    let mut files = Vec::new();
    let mut entries = Vec::new();
    let (mut flags, mut bugs): (BTreeMap<Flag, usize>, BTreeMap<Bug, usize>) = Default::default();
    let mut total = 0;

    for group in groups {
        let cases: Vec<Case> = group
            .drafts
            .par_iter()
            .map(|d| Case::answer(d, false))
            .collect::<Result<_, _>>()?;

        let lines: Vec<(String, Vec<Bug>)> = cases.par_iter().map(case_line).collect();
        cases
            .iter()
            .flat_map(|c| &c.flags)
            .for_each(|f| *flags.entry(*f).or_default() += 1);

        lines
            .iter()
            .flat_map(|l| &l.1)
            .for_each(|b| *bugs.entry(*b).or_default() += 1);
        total += cases.len();

        let wrong: usize = lines.iter().map(|l| l.1.len()).sum();
        let text = group_text(group, &lines.into_iter().map(|l| l.0).collect::<Vec<_>>());
        let file = format!("{}.json", group.name);

        entries.push(json!({
            "file": file,
            "comment": group.comment,
            "cases": cases.len(),
            "wrong": wrong,
            "sha256": hex(&text),
        }));

        files.push((file, text));
    }

    let flags: Map<String, Value> = flags
        .iter()
        .map(|(f, n)| (f.word().into(), json!({ "cases": n, "note": f.note() })))
        .collect();

    let bugs: Map<String, Value> = bugs
        .iter()
        .map(|(b, n)| {
            (
                b.word().into(),
                json!({ "count": n, "label": b.expected().word(), "reason": b.reason() }),
            )
        })
        .collect();

    let index = json!({
        "format": INDEX_FORMAT,
        "cases": total,
        "groups": entries,
        "flags": flags,
        "bugs": bugs,
    });

    files.push(("index.json".into(), format!("{index:#}\n")));
    Ok(files)
}

fn hex(text: &str) -> String {
    Sha256::digest(text.as_bytes())
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// One case per line, so that differences can be read.
fn group_text(group: &Group, lines: &[String]) -> String {
    let head = |key: &str, value: &str| format!("{}: {},\n", json!(key), json!(value));
    let (format, name, comment) = (
        head("format", PACK_FORMAT),
        head("group", &group.name),
        head("comment", &group.comment),
    );

    format!(
        "{{\n{format}{name}{comment}\"cases\": [\n{}\n]\n}}\n",
        lines.join(",\n")
    )
}

fn case_line(case: &Case) -> (String, Vec<Bug>) {
    let wrong = case.wrong_answers();
    let bugs = wrong.iter().map(|w| w.bug).collect();

    // Our own writer's JSON.
    let problem: Value = serde_json::from_str(&write_problem(&case.problem)).unwrap_or_default();
    let wrong: Vec<Value> = wrong
        .into_iter()
        .map(|w| {
            json!({
                "bug": w.bug.word(),
                "label": w.bug.expected().word(),
                "reason": w.bug.reason(),
                "report": w.report,
            })
        })
        .collect();

    let flags: Vec<&str> = case.flags.iter().map(|f| f.word()).collect();
    let line = json!({
        "id": case.id,
        "comment": case.comment,
        "flags": flags,
        "problem": problem,
        "answer": case.answer_json(),
        "wrong": wrong,
    });

    (line.to_string(), bugs)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawIndex {
    #[serde(rename = "format")]
    _format: String,
    groups: Vec<RawEntry>,
    #[serde(rename = "cases")]
    _cases: usize,
    #[serde(rename = "flags")]
    _flags: Value,
    #[serde(rename = "bugs")]
    _bugs: Value,
}

#[derive(Deserialize)]
struct RawEntry {
    file: String,
    sha256: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawGroup {
    #[serde(rename = "format")]
    _format: String,
    group: String,
    comment: String,
    cases: Vec<RawCase>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCase {
    id: String,
    comment: String,
    flags: Vec<String>,
    problem: Value,
    answer: Value,
    #[serde(rename = "wrong")]
    _wrong: Value,
}

/// Reads a pack from a folder by its index. Nothing in it is believed: digests are compared,
/// answers are found again by the plain oracle and compared when a case is answered
/// ([`Case::answer`]), see `expected`.
///
/// # Errors
/// [`ConformError`]: unreadable or of another version, a digest, a problem, or an answer that
/// differs.
pub fn read_pack(folder: &Path) -> Result<Vec<Group>, ConformError> {
    let at = |place: &str, source| ConformError::Problem {
        place: place.to_string(),
        source,
    };
    let index =
        read_text("the index", &folder.join("index.json")).map_err(|e| at("index.json", e))?;
    require_format(&index, INDEX_FORMAT).map_err(|e| at("index.json", e))?;

    let index: RawIndex = from_json(&index).map_err(|e| at("index.json", e))?;
    index
        .groups
        .iter()
        .map(|entry| read_group(folder, entry))
        .collect()
}

fn read_group(folder: &Path, entry: &RawEntry) -> Result<Group, ConformError> {
    let at = |source| ConformError::Problem {
        place: entry.file.clone(),
        source,
    };
    let plain = entry
        .file
        .chars()
        .all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));

    if !plain || entry.file.starts_with('.') {
        let (path, problem) = (
            entry.file.chars().take(80).collect(),
            "expected a name beside the index".into(),
        );
        return Err(at(mceip_model::ModelError::Unreadable {
            what: "a group",
            path,
            problem,
        }));
    }

    let text = read_text("a group", &folder.join(&entry.file)).map_err(at)?;
    let got = hex(&text);

    if got != entry.sha256 {
        return Err(ConformError::Digest {
            file: entry.file.clone(),
            expected: entry.sha256.chars().take(80).collect(),
            got,
        });
    }

    require_format(&text, PACK_FORMAT).map_err(at)?;
    let raw: RawGroup = from_json(&text).map_err(at)?;

    let drafts = raw
        .cases
        .par_iter()
        .map(read_case)
        .collect::<Result<_, _>>()?;

    Ok(Group {
        name: raw.group,
        comment: raw.comment,
        drafts,
    })
}

fn read_case(raw: &RawCase) -> Result<Draft, ConformError> {
    let at = |source| ConformError::Problem {
        place: raw.id.clone(),
        source,
    };

    let flag = |word: &String| {
        let got = || word.chars().take(60).collect();
        Flag::of_word(word).ok_or_else(|| ConformError::Flag {
            case: raw.id.clone(),
            got: got(),
        })
    };

    let flags: Vec<Flag> = raw.flags.iter().map(flag).collect::<Result<_, _>>()?;

    // Files beside the pack are not read: its problems are inlined.
    let problem = read_problem(&raw.problem.to_string(), Path::new("/nonexistent")).map_err(at)?;
    let flags = flags.into_iter().filter(|f| f.is_given()).collect();

    let draft = Draft {
        id: raw.id.clone(),
        comment: raw.comment.clone(),
        flags,
        problem,
    };

    let case = Case::answer(&draft, false)?;
    if case.answer_json() != raw.answer {
        return Err(ConformError::Answer { case: draft.id });
    }

    Ok(draft)
}
