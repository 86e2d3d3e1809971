//! `mceip block --loads`: the block and its loading as a file for `mceip path`.

use super::args::Args;
use super::scale::cells_of;
use crate::cli::common::{CliError, exit, number, print};
use crate::cli::job::Job;
use crate::cli::output::Output;
use crate::front::left_behind_if;
use mceip_exact::Rational;
use mceip_model::file::write_loads;
use mceip_paper::{BlockModel, Loading, MeshKind, Plane};
use num_traits::Signed as _;
use std::path::Path;

/// Writes the file.
pub(super) fn run(args: &Args, file: &Path) -> Result<u8, CliError> {
    let model = model(args)?;
    let until = args.until.as_deref();
    let loading = Loading {
        friction: number("mu", &args.mu)?,
        force: number("force", &args.force)?,
        until: until.map(|text| number("until", text)).transpose()?,
    };
    let output = Output::prepare("loads", file, &[])?;

    let job = Job::begin("pressing the block until its normal force is reached");
    let loads = left_behind_if(&|| job.is_cancelled(), move || model.loads(&loading));
    job.end();
    let Some(loads) = loads else {
        return Ok(exit::INTERRUPTED);
    };

    let loads = loads?;
    output.write(&format!("{}\n", write_loads(&loads)))?;
    let place = file.display();
    let name = loads.name.as_deref().unwrap_or_default();
    let system = loads.body.system();
    print(&format!(
        "{place}: {name}; {} degrees of freedom, {} contact candidates\n",
        system.dofs(),
        system.particles().len()
    ))?;
    Ok(exit::DONE)
}

/// The block that the options describe.
fn model(args: &Args) -> Result<BlockModel, CliError> {
    let paper = BlockModel::of_the_paper();

    let mesh = args.mesh.to_ascii_lowercase();
    let mesh = MeshKind::ALL.into_iter().find(|m| m.word() == mesh);
    let expected = "crossed, union-jack, slash or backslash";
    let mesh = mesh.ok_or_else(|| CliError::option("mesh", expected, &args.mesh))?;

    let plane = args.plane.to_ascii_lowercase();
    let plane = Plane::ALL.into_iter().find(|p| p.word() == plane);
    let expected = "stress or strain";
    let plane = plane.ok_or_else(|| CliError::option("plane", expected, &args.plane))?;

    let cells = cells_of(&args.cells);
    let expected = "NXxNY, such as 20x10";
    let cells = cells.ok_or_else(|| CliError::option("cells", expected, &args.cells))?;

    let height = number("height", &args.height)?;
    if !height.is_positive() {
        return Err(CliError::option("height", "a number > 0", &args.height));
    }
    let cell_length = part(&paper.length(), cells.0);
    let cell_height = part(&height, cells.1);

    Ok(BlockModel {
        cells,
        cell: (cell_length, cell_height),
        mesh,
        plane,
        mass: args.mass(),
        ..paper
    })
}

/// One of n equal parts; for n = 0, which the model refuses, the whole.
fn part(whole: &Rational, n: usize) -> Rational {
    whole / Rational::from_integer(n.max(1).into())
}
