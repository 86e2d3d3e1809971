//! `tests/transcripts`: what the program prints. A page is run in a folder of its own from top to
//! bottom, and has to be what comes out:
//!
//! - a code block with a name, such as "```json report.json", is written to that file;
//! - in a block "```console" a line `$ mceip ...` is a command, split at blanks; what follows is
//!   its text on stdout, its lines on stderr after `! `, and `? 2` for its exit code if that is not
//!   0;
//! - at the end of a command `> report.json` puts its stdout into a file;
//! - `[ROOT]` is the repository. A line `...` stands for any lines, `[..]` for any part of a line.
//!
//! A certificate that a command has written is read back and has to be accepted, on every page.
//!
//! `SNAPSHOTS=overwrite cargo test --test data transcripts` rewrites what differs; read the change
//! before it is committed.

use crate::program;
use libtest_mimic::{Failed, Trial};
use snapbox::filter::NormalizeToExpected;
use snapbox::{Assert, Data};
use std::path::Path;

/// The repository.
const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A test for each page: `transcripts::explain`.
pub(crate) fn tests() -> Vec<Trial> {
    let mut tests = Vec::new();
    for file in std::fs::read_dir(Path::new(ROOT).join("tests/transcripts")).unwrap() {
        let path = file.unwrap().path();
        let name = format!("transcripts::{}", path.file_stem().unwrap().display());
        tests.push(Trial::test(name, move || is_what_comes_out(&path)));
    }

    assert!(!tests.is_empty());
    tests.push(Trial::test(
        "transcripts::name_every_malformed_file",
        || {
            every_malformed_file_is_read();
            Ok(())
        },
    ));
    tests
}

fn every_malformed_file_is_read() {
    let page = std::fs::read_to_string(Path::new(ROOT).join("tests/transcripts/malformed.md"));
    let page = page.unwrap();

    for file in std::fs::read_dir(Path::new(ROOT).join("tests/malformed")).unwrap() {
        let name = file.unwrap().file_name();
        let path = format!("[ROOT]/tests/malformed/{}\n", name.display());
        assert!(page.contains(&path), "{path}");
    }
}

fn is_what_comes_out(path: &Path) -> Result<(), Failed> {
    let page = std::fs::read_to_string(path).unwrap();
    assert!(page.contains("\n$ mceip "), "a page without a command");

    let expected = Data::read_from(path, None).raw();
    let assert = Assert::new().action_env("SNAPSHOTS");
    assert.try_eq(None, run(&page).into(), expected)?;
    Ok(())
}

/// The page with what its commands print, in the words of the page as far as these stand for it.
fn run(page: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let mut out = String::new();
    let mut block: Option<Block> = None;

    for line in page.lines() {
        if let Some(open) = &mut block {
            if line == "```" {
                out += &open.text(folder.path());
                block = None;
            } else {
                push(&mut open.lines, line);
                continue;
            }
        } else {
            block = line.strip_prefix("```").map(Block::new);
        }
        push(&mut out, line);
    }

    assert!(block.is_none(), "a code block without an end");
    out
}

fn push(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

/// A code block.
struct Block {
    is_console: bool,
    /// The name of the file that it is written to.
    file: Option<String>,
    lines: String,
}

impl Block {
    /// From what follows the backquotes: a language, and a name.
    fn new(information: &str) -> Block {
        let name = information.split_once(' ').map(|(_, name)| name.into());
        Block {
            is_console: information == "console",
            file: name,
            lines: String::new(),
        }
    }

    /// The lines of the block, commands run and a file written.
    fn text(&self, folder: &Path) -> String {
        if let Some(file) = &self.file {
            std::fs::write(folder.join(file), &self.lines).unwrap();
        }
        if !self.is_console {
            let has_command = self.lines.lines().any(|line| line.starts_with("$ mceip "));
            assert!(
                !has_command,
                "a command that is not run: a block without `console`"
            );
            return self.lines.clone();
        }

        let mut text = String::new();
        for part in self.lines.split("$ mceip ").skip(1) {
            let (command, expected) = part.split_once('\n').unwrap();
            push(&mut text, &format!("$ mceip {command}"));
            text += &in_the_words_of(expected, printed(command, folder));
        }
        text
    }
}

/// The text with what `expected` leaves open in place of what it stands for.
fn in_the_words_of(expected: &str, text: String) -> String {
    let expected = Data::text(expected);
    let filter = NormalizeToExpected::new().redact();
    filter.normalize(Data::text(text), &expected).to_string()
}

/// What a command prints in this folder, as it stands on a page.
fn printed(command: &str, folder: &Path) -> String {
    let (command, file) = match command.split_once(" > ") {
        None => (command, None),
        Some((command, file)) => (command, Some(folder.join(file))),
    };
    let command = command.replace("[ROOT]", ROOT);
    let arguments: Vec<&str> = command.split(' ').collect();
    let output = program::mceip_in(folder, &arguments);

    let mut text = String::new();
    match file {
        Some(file) => std::fs::write(file, &output.stdout).unwrap(),
        None => text += &String::from_utf8(output.stdout).unwrap(),
    }
    for line in String::from_utf8(output.stderr).unwrap().lines() {
        text += &format!("! {line}\n");
    }
    match output.status.code() {
        Some(0) => {}
        code => text += &format!("? {}\n", code.unwrap()),
    }
    text.replace(ROOT, "[ROOT]")
}
