//! `mceip completions` and `mceip man`: both name every command and its options.
//!
//! The truth is the list of commands that `mceip --help` prints. A command that one of them leaves
//! out fails here.
#![cfg(feature = "cli")]

use crate::common::{exits, read, run};

/// The names of the commands, from the help.
fn commands() -> Vec<String> {
    let help = exits(0, &["--help"]);
    let section = help.split("Commands:").nth(1).unwrap();
    let list = section.split("Options:").next().unwrap();

    // A name stands at two blanks; lines that go on stand further right.
    let names = list
        .lines()
        .filter_map(|line| line.strip_prefix("  "))
        .filter(|line| !line.starts_with(' '));
    names
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .map(str::to_string)
        .collect()
}

#[test]
fn completions_know_every_command_and_option() {
    assert!(commands().len() > 14);

    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = exits(0, &["completions", shell]);

        for command in commands() {
            assert!(script.contains(&command), "{shell}: {command}");
        }
        assert!(script.contains("certificate"), "{shell}: an option");
    }
}

#[test]
fn there_is_a_manual_page_for_every_command() {
    let scratch = tempfile::tempdir().unwrap();
    let folder = scratch.path().join("new/man1");
    exits(0, &["man", folder.to_str().unwrap()]);
    let page = |name: &str| read(folder.join(format!("{name}.1")).to_str().unwrap());

    let program = page("mceip");
    assert!(program.starts_with(".ie"), "roff: {program}");
    assert!(program.contains(".TH MCEIP 1"));

    for command in commands() {
        assert!(
            program.contains(&format!("mceip\\-{command}(1)")),
            "{command}"
        );
        assert!(
            page(&format!("mceip-{command}")).contains(".SH OPTIONS"),
            "{command}"
        );
    }
    assert!(page("mceip-complete").contains("certificate"));
}

#[test]
fn an_unknown_shell_and_a_file_in_the_place_of_the_folder_are_refused() {
    let unknown = run(&["completions", "cmd"]);
    assert_eq!(unknown.code, Some(2));
    assert!(unknown.stderr.contains("cmd"));

    let file = tempfile::NamedTempFile::new().unwrap();
    let refused = run(&["man", file.path().to_str().unwrap()]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.starts_with("mceip: cannot write"));
}
