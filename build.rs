//! Which other checkers and rivals this machine can run: tests that need one are ignored, with the
//! reason, where it is missing. With `MCEIP_DEMAND_TOOLS` set those that are demanded count as there,
//! so that a missing one is a failure. In the published package, which has no tests, nothing is
//! looked for.

use std::path::Path;
use std::process::Command;

/// A tool: the cfg that says that it is there, and how to find out.
struct Tool {
    cfg: &'static str,
    is_there: fn() -> bool,
    /// Is it among those that `MCEIP_DEMAND_TOOLS` demands?
    is_demanded: bool,
}

const TOOLS: [Tool; 4] = [
    Tool {
        cfg: "has_python3",
        is_there: || python("pass"),
        is_demanded: true,
    },
    Tool {
        cfg: "has_numpy",
        is_there: || python("import numpy"),
        is_demanded: true,
    },
    Tool {
        cfg: "has_octave",
        is_there: || Command::new("octave-cli").arg("--version").output().is_ok(),
        // Minutes to install.
        is_demanded: false,
    },
    Tool {
        cfg: "has_verified_checker",
        is_there: || Path::new(VERIFIED_CHECKER).exists(),
        is_demanded: true,
    },
];

/// The program that `make -C proofs program` makes.
const VERIFIED_CHECKER: &str = "proofs/mceip-verified";

fn main() {
    println!("cargo::rerun-if-env-changed=MCEIP_DEMAND_TOOLS");
    let is_demanded = std::env::var_os("MCEIP_DEMAND_TOOLS").is_some();
    let has_tests = Path::new("tests").is_dir();
    if !is_demanded {
        println!("cargo::rerun-if-env-changed=PATH");
        println!("cargo::rerun-if-changed={VERIFIED_CHECKER}");
    }

    for tool in TOOLS {
        println!("cargo::rustc-check-cfg=cfg({})", tool.cfg);
        if has_tests && ((is_demanded && tool.is_demanded) || (tool.is_there)()) {
            println!("cargo::rustc-cfg={}", tool.cfg);
        }
    }
}

/// Does Python run this line?
fn python(line: &str) -> bool {
    let output = Command::new("python3").args(["-c", line]).output();
    output.is_ok_and(|output| output.status.success())
}
