//! The program `mceip`: arguments, one library call, an exit code.

fn main() -> std::process::ExitCode {
    mceip::cli::main()
}
