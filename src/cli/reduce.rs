//! `mceip reduce`: the pencil of a mechanical system as a problem file.

use super::common::{CliError, exit, load, print};
use mceip_engine::reduction::{Variable, condense, reduce};
use mceip_model::file::write_problem;
use mceip_model::{Admissible, Body, Problem};
use std::path::PathBuf;

/// Arguments of `reduce`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// For unknown mu: eliminate the free variables as well, exactly.
    #[arg(long)]
    condense: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let reduced = reduce(&problem)?;
    let (pencil, what) = if args.condense {
        let admissible = Admissible::new(&reduced.pencil, problem.unknown())?;
        (condense(&admissible)?, "condensed to its slip variables")
    } else {
        let what = if matches!(problem.body(), Body::System(_)) {
            "reduced by (10)-(16)"
        } else {
            "given as a pencil, nothing to reduce;"
        };
        (reduced.pencil, what)
    };
    let variables: Vec<String> = reduced
        .variables
        .iter()
        .map(|v| match v {
            Variable::Free { dof } => format!("v[{dof}]"),
            Variable::Slip { sign, tangent, .. } => {
                let terms: Vec<String> = tangent
                    .iter()
                    .map(|(dof, c)| {
                        format!("{} v[{dof}]", -c * mceip_exact::whole(i64::from(*sign)))
                    })
                    .collect();
                terms.join(" + ")
            }
        })
        .filter(|_| !args.condense)
        .collect();
    let mut out = Problem::new(
        Body::Pencil(pencil),
        problem.unknown(),
        problem.window().clone(),
    )?;
    out.name = problem.name.clone();
    let x = if variables.is_empty() {
        String::new()
    } else {
        format!("; x = ({})", variables.join(", "))
    };
    out.comment = Some(format!("{what} from problem {}{x}", problem.sha256()));
    print(&format!("{}\n", write_problem(&out)))?;
    Ok(exit::DONE)
}
