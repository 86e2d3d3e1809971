//! `mceip completions SHELL` and `mceip man FOLDER`: completions of a shell and manual pages.
//!
//! Both are made from the definitions of the options, which `--help` prints too, so that they name
//! the same ones.

use super::Cli;
use super::common::{CliError, exit, print};
use super::output::Folder;
use clap::CommandFactory as _;
use clap_complete::Shell;
use std::path::PathBuf;

#[derive(clap::Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

#[derive(clap::Args)]
pub(super) struct ManArgs {
    /// Where the pages are written, mceip.1 and one for each command; it is made if it is missing
    folder: PathBuf,
}

/// Prints the completions of a shell.
pub(super) fn completions(args: &CompletionsArgs) -> Result<u8, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "mceip", &mut script);

    print(&String::from_utf8_lossy(&script))?;
    Ok(exit::DONE)
}

/// Writes the manual pages.
pub(super) fn man(args: &ManArgs) -> Result<u8, CliError> {
    let folder = Folder::prepare("man", &args.folder, &[])?;

    // A page names its own options with those of the whole program.
    let mut program = Cli::command().disable_help_subcommand(true);
    program.build();

    write_page(&program, "mceip", &folder)?;
    for command in program.get_subcommands() {
        write_page(command, &format!("mceip-{}", command.get_name()), &folder)?;
    }

    Ok(exit::DONE)
}

/// Writes the page of a command as `name`.1.
fn write_page(command: &clap::Command, name: &str, folder: &Folder) -> Result<(), CliError> {
    // The title is the name of the file, so that `man mceip-solve` says which page it shows.
    let title = name.to_uppercase();
    let page = clap_mangen::Man::new(command.clone()).title(title);

    let mut text = Vec::new();
    let name = format!("{name}.1");
    page.render(&mut text)
        .map_err(|e| CliError::write(&name, &e))?;
    folder.write(&name, &text)
}
