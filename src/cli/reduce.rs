//! `mceip reduce`: the pencil of a mechanical system as a problem file.

use super::common::{CliError, exit, load, print};
use mceip_engine::reduction::condense;
use mceip_exact::whole;
use mceip_model::file::write_problem;
use mceip_model::reduction::reduce;
use mceip_model::{
    Admissible, Body, Problem, RealWindow, Reduced, ReducedVariable, Unknown, Window,
};
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

/// Prints the pencil as a problem of its own; its comment says where it comes from.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let reduced = reduce(&problem)?.without_zero()?;
    let comment = comment(args, &problem, &reduced);

    let pencil = if args.condense {
        let admissible = Admissible::new(&reduced.pencil, problem.unknown())?;
        condense(&admissible)?
    } else {
        reduced.pencil
    };

    // The linear form of a quadratic pencil is that of values that are not negative.
    let (unknown, window) = match problem.body() {
        Body::Quadratic(_) => (Unknown::Lambda2, RealWindow::from(problem.window())),
        Body::Pencil(_) | Body::System(_) => (problem.unknown(), problem.real_window()),
    };
    let out = Problem::new(Body::Pencil(pencil), unknown, Window::all())?;
    let mut out = out.with_real_window(&window);
    out.name = problem.name.clone();
    out.comment = Some(comment);

    print(&format!("{}\n", write_problem(&out)))?;
    Ok(exit::DONE)
}

/// Where the pencil comes from and, unless it is condensed, what its variables are.
fn comment(args: &Args, problem: &Problem, reduced: &Reduced) -> String {
    let digest = problem.sha256();
    if args.condense {
        return format!("condensed to its slip variables from problem {digest}");
    }

    let what = match problem.body() {
        Body::System(_) => "reduced by (10)-(16)",
        Body::Pencil(_) => "given as a pencil, nothing to reduce;",
        Body::Quadratic(_) => "linear form for t >= 0: x, and z = x/(1 + t), which is free;",
    };
    let variables: Vec<String> = reduced.variables.iter().map(variable_text).collect();

    if variables.is_empty() {
        format!("{what} from problem {digest}")
    } else {
        let x = variables.join(", ");
        format!("{what} from problem {digest}; x = ({x})")
    }
}

/// A variable of the pencil in terms of the degrees of freedom: v_f, or -S v_T of a slip particle.
fn variable_text(variable: &ReducedVariable) -> String {
    match variable {
        ReducedVariable::Free { dof } => format!("v[{dof}]"),
        ReducedVariable::Slip { sign, tangent, .. } => {
            let sign = whole(i64::from(*sign));
            let mut terms = Vec::new();
            for (dof, component) in tangent {
                terms.push(format!("{} v[{dof}]", -component * &sign));
            }

            terms.join(" + ")
        }
        ReducedVariable::Zero {
            variables, part, ..
        } => format!("{} of particle {}", part.word(), variables.particle),
    }
}
