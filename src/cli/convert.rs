//! `mceip convert`: a problem file from a model of one's own.

use super::common::{CliError, exit, positive, print, text};
use super::output::Output;
use mceip_exact::Sparse;
use mceip_model::file::{read_matrix_market, read_particles, write_problem};
use mceip_model::{Body, Problem, System, Unknown, Window};
use mceip_paper::calculix::{CalculixError, read_dofs, read_triangle};
use mceip_paper::read_contacts;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Arguments of `convert`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// K: Matrix Market, or the .sti file of CalculiX (then --dof too).
    #[arg(long, value_name = "FILE")]
    stiffness: PathBuf,
    /// M: Matrix Market, or the .mas file of CalculiX.
    #[arg(long, value_name = "FILE")]
    mass: PathBuf,
    /// The .dof file of CalculiX: contacts then name dofs as node.direction.
    #[arg(long, value_name = "FILE")]
    dof: Option<PathBuf>,
    /// Contact states: CSV (columns in spec/tutorial.md), or a JSON list of particles as in
    /// mceip-problem/1.
    #[arg(long, value_name = "FILE")]
    contacts: PathBuf,
    /// Coefficient of friction.
    #[arg(long, value_name = "MU", allow_hyphen_values = true)]
    friction: String,
    /// Name for the problem.
    #[arg(long)]
    name: Option<String>,
    /// The problem file to write; it appears whole or not at all.
    #[arg(long, value_name = "OUT")]
    out: PathBuf,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let friction = positive("friction", &args.friction)?;
    let mut inputs: Vec<&Path> = vec![&args.stiffness, &args.mass, &args.contacts];
    inputs.extend(args.dof.as_deref());
    let output = Output::prepare("out", &args.out, &inputs)?;
    let dofs = args.dof.as_deref().map(names).transpose()?;
    let stiffness = matrix("K", &args.stiffness, dofs.as_ref())?;
    let mass = matrix("M", &args.mass, dofs.as_ref())?;
    let order = stiffness.rows();
    let index = |cell: &str| match &dofs {
        Some(names) => names.get(cell).copied(),
        None => cell.parse::<usize>().ok().filter(|d| *d < order),
    };
    let contacts = text("the contacts", &args.contacts)?;
    let path = || args.contacts.display().to_string();
    let particles = if contacts.trim_start().starts_with('[') {
        read_particles(&contacts).map_err(|source| CliError::File {
            path: path(),
            source,
        })?
    } else {
        read_contacts(&contacts, &friction, &index).map_err(|source| CliError::Contacts {
            path: path(),
            source,
        })?
    };
    let system = System::new(stiffness, Some(mass), Some(friction), particles)?;
    let [slip, dofs] = [system.slip_particles().len(), system.dofs()];
    let mut problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?;
    problem.name = args.name.clone();
    output.write(&format!("{}\n", write_problem(&problem)))?;
    print(&format!(
        "{}: {dofs} degrees of freedom, {slip} particles in impending slip\n",
        args.out.display()
    ))?;
    Ok(exit::DONE)
}

fn names(path: &Path) -> Result<HashMap<String, usize>, CliError> {
    read_dofs(&text("the degrees of freedom", path)?).map_err(|source| calculix(path, source))
}

fn calculix(path: &Path, source: CalculixError) -> CliError {
    CliError::Calculix {
        path: path.display().to_string(),
        source,
    }
}

/// A Matrix Market file by its banner; else a triangle of CalculiX, whose order .dof knows.
fn matrix(
    what: &'static str,
    path: &Path,
    dofs: Option<&HashMap<String, usize>>,
) -> Result<Sparse, CliError> {
    let read = text(what, path)?;
    match dofs {
        Some(names) if !read.starts_with("%%") => {
            read_triangle(&read, names.len()).map_err(|source| calculix(path, source))
        }
        _ => read_matrix_market(what, &read).map_err(|source| CliError::File {
            path: path.display().to_string(),
            source,
        }),
    }
}
