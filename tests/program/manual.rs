//! `mceip completions` and `mceip man` name every command and its options; colours and `--quiet`.
//!
//! The truth is the list of commands that `mceip --help` prints. A command that one of them leaves
//! out fails here.
#![cfg(feature = "cli")]

use crate::common::{example, exits, read, run};

/// The names of the commands, from the help.
fn commands() -> Vec<String> {
    let help = exits(0, "--help");
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
        let script = exits(0, &format!("completions {shell}"));

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
    exits(0, &format!("man {}", folder.to_str().unwrap()));
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
    let unknown = run("completions cmd");
    assert_eq!(unknown.code, Some(2));
    assert!(unknown.stderr.contains("cmd"));

    let file = tempfile::NamedTempFile::new().unwrap();
    let refused = run(&format!("man {}", file.path().to_str().unwrap()));
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.starts_with("mceip: cannot write"));
}

/// What `complete` prints on the fold with this variable of the environment.
fn printed_with(variable: &str, value: &str, options: &[&str]) -> String {
    let fold = example("fold");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(["complete", &fold])
        .args(options)
        .env_remove("NO_COLOR")
        .env_remove("CLICOLOR_FORCE")
        .env(variable, value)
        .output()
        .unwrap();

    assert_eq!(output.status.code(), Some(0));
    String::from_utf8(output.stdout).unwrap()
}

/// Not in pipes, unless it is asked for; never in JSON.
#[test]
fn verdicts_are_in_colour_where_it_is_wanted() {
    let plain = printed_with("NO_COLOR", "1", &[]);
    assert!(plain.contains("\nCOMPLETE: 2 solutions"), "{plain}");
    assert_eq!(printed_with("CLICOLOR", "1", &[]), plain);
    assert_eq!(printed_with("CLICOLOR", "0", &[]), plain);

    let coloured = printed_with("CLICOLOR_FORCE", "1", &[]);
    let verdict = "\u{1b}[1m\u{1b}[32mCOMPLETE\u{1b}[0m: 2 solutions";
    assert!(coloured.contains(verdict), "{coloured:?}");
    assert_eq!(
        coloured
            .replace("\u{1b}[1m\u{1b}[32m", "")
            .replace("\u{1b}[0m", ""),
        plain
    );

    let json = printed_with("CLICOLOR_FORCE", "1", &["--json"]);
    assert!(!json.contains('\u{1b}'), "{json:?}");
}

#[test]
fn quiet_is_an_option_of_every_command() {
    let fold = example("fold");
    let plain = exits(0, &format!("complete {fold}"));
    assert_eq!(exits(0, &format!("--quiet complete {fold}")), plain);
    assert_eq!(exits(0, &format!("complete {fold} --quiet")), plain);
}
