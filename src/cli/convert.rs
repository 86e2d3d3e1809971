//! `mceip convert`: a problem file from a model of one's own.
//!
//! Input: K and M (Matrix Market, or CalculiX), a table of contact states and mu. Output: the
//! MCEIP-lambda2 problem as `mceip-problem/1`; with loads in place of states, a body under loads as
//! `mceip-loads/1`, whose states `mceip path` finds. What is changed on the way (directions in
//! doubles become rational rotations, rounded matrices symmetric) is printed and stands in the
//! comment of the file. Figures of the model follow, with warnings of what looks wrong
//! (`Plausibility`); a problem file keeps the warnings, so that `analyze` repeats them, until they
//! are accepted.

use super::common::{CliError, exit, friction_of, positive_number, print, text};
use super::output::Output;
use mceip_engine::report::counted;
use mceip_exact::{Rational, Sparse, to_f64};
use mceip_model::file::{
    LoadsFile, read_matrix_market, read_particles, read_printed_radius, write_loads, write_problem,
};
use mceip_model::{
    Body, ContactState, Coordinates, LoadedBody, LoadedParts, Particle, Problem, Radii, System,
    Unknown, Window,
};
use mceip_paper::calculix::{read_dofs, read_triangle};
use mceip_paper::{
    Asymmetry, ContactTable, Frame, NodeTable, Plausibility, PlausibilityInput, angle_in_degrees,
    asymmetry, make_frames_exact, read_candidates, read_contacts, read_nodes, read_steps,
    rows_alone, symmetric_part,
};
use num_traits::One as _;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// Arguments of `convert`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// K: Matrix Market, or the .sti file of CalculiX (then --dof too).
    #[arg(long, value_name = "FILE")]
    stiffness: PathBuf,
    /// M: Matrix Market, or the .mas file of CalculiX. With --loads it may be left out.
    #[arg(long, value_name = "FILE", required_unless_present = "loads")]
    mass: Option<PathBuf>,
    /// The .dof file of CalculiX: contacts then name dofs as node.direction.
    #[arg(long, value_name = "FILE")]
    dof: Option<PathBuf>,
    /// Contact states: CSV (columns in spec/tutorial.md), or a JSON list of particles as in
    /// mceip-problem/1. With --loads: CSV of the contact candidates, without states, with gaps.
    #[arg(long, value_name = "FILE")]
    contacts: PathBuf,
    /// Loads in place of contact states: CSV (columns in spec/loads.md), or an input file of
    /// CalculiX with *CLOAD. Writes a body under loads, for `mceip path`.
    #[arg(long, value_name = "FILE", conflicts_with = "displacements")]
    loads: Option<PathBuf>,
    /// With --loads: the last step grows until nothing more happens.
    #[arg(long, requires = "loads")]
    endless: bool,
    /// Coefficient of friction. With --loads it may be left out.
    #[arg(
        long,
        value_name = "MU",
        alias = "mu",
        allow_hyphen_values = true,
        required_unless_present = "loads"
    )]
    friction: Option<String>,
    /// Displacements of the equilibrium, to hold K u against the reactions of the table: a number
    /// for each row of K, one a line, or a Matrix Market file with one column.
    #[arg(long, value_name = "FILE")]
    displacements: Option<PathBuf>,
    /// Where the nodes are: CSV (columns in spec/tutorial.md). The directions of contacts are held
    /// against them, and `analyze --report` draws the body. Names of particles are then kept too.
    #[arg(long, value_name = "FILE")]
    coordinates: Option<PathBuf>,
    /// Take the mean of K and its transpose, and of M and its, where they differ by rounding (1e-12
    /// of the largest entry). The comment in the problem file says so.
    #[arg(long)]
    symmetrize: bool,
    /// The numbers of K and M are known to half a unit of their last digit: the problem stands for
    /// all bodies within that (spec/robust.md). Matrix Market only.
    #[arg(long, conflicts_with_all = ["loads", "within"])]
    as_printed: bool,
    /// The numbers of K and M are known to this share of each, as 0.001.
    #[arg(long, value_name = "SHARE", conflicts_with = "loads")]
    within: Option<String>,
    /// The coefficient of friction of each slip particle is known to this share, as 0.1, each by
    /// itself.
    #[arg(long, value_name = "SHARE", conflicts_with = "loads")]
    friction_within: Option<String>,
    /// Leave the warnings out of the file: they have been looked at, and the model is meant so.
    #[arg(long, conflicts_with = "strict")]
    accept_warnings: bool,
    /// Refuse a model with a warning: no file, exit code 2.
    #[arg(long)]
    strict: bool,
    /// Name for the problem.
    #[arg(long)]
    name: Option<String>,
    /// The problem file to write; it appears whole or not at all.
    #[arg(long, value_name = "OUT")]
    out: PathBuf,
}

/// Reads the model and writes the problem, or the body under loads.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let friction = args.friction.as_deref();
    let friction = friction.map(|mu| friction_of("friction", mu)).transpose()?;
    let mut inputs: Vec<&Path> = vec![&args.stiffness, &args.contacts];
    inputs.extend(args.mass.as_deref());
    inputs.extend(args.loads.as_deref());
    inputs.extend(args.dof.as_deref());
    inputs.extend(args.displacements.as_deref());
    inputs.extend(args.coordinates.as_deref());
    let output = Output::prepare("out", &args.out, &inputs)?;

    let model = Model::read(args)?;
    match (&args.loads, friction) {
        (Some(loads), friction) => write_body(args, model, loads, friction, &output),
        (None, Some(friction)) => write_states(args, model, friction, &output),
        (None, None) => {
            let expected = "a coefficient of friction, or --loads";
            Err(CliError::option("friction", expected, "none"))
        }
    }
}

/// The matrices of the model.
struct Model {
    stiffness: Sparse,
    mass: Option<Sparse>,
    indices: DofIndices,
    /// What is not as it was given.
    changes: Vec<String>,
}

impl Model {
    fn read(args: &Args) -> Result<Model, CliError> {
        let names = args.dof.as_deref().map(read_dof_names).transpose()?;
        let mut changes = Vec::new();
        let stiffness = read_matrix("K", &args.stiffness, names.as_ref())?;
        let mass = args.mass.as_deref();
        let mass = mass.map(|mass| read_matrix("M", mass, names.as_ref()));
        let mass = mass.transpose()?;

        let stiffness = symmetric("K", stiffness, args.symmetrize, &mut changes)?;
        let mass = match mass {
            Some(mass) => Some(symmetric("M", mass, args.symmetrize, &mut changes)?),
            None => None,
        };
        if let Some(names) = &names
            && names.len() != stiffness.rows()
        {
            let expected = "a line for each row of K";
            return Err(CliError::option("dof", expected, &names.len().to_string()));
        }
        Ok(Model {
            indices: DofIndices {
                names,
                order: stiffness.rows(),
            },
            stiffness,
            mass,
            changes,
        })
    }
}

/// Writes the problem of given contact states.
fn write_states(
    args: &Args,
    model: Model,
    friction: Rational,
    output: &Output,
) -> Result<u8, CliError> {
    let Model {
        stiffness,
        mass,
        indices,
        mut changes,
    } = model;
    let mut contacts = read_states(&args.contacts, &friction, &indices)?;
    changes.extend(directions(&contacts.particles));
    if let Some(share) = &args.friction_within {
        let share = share_of("friction-within", share)?;
        contacts
            .particles
            .iter_mut()
            .for_each(|p| within(p, &share));
    }
    let radii = radii(args, &stiffness, mass.as_ref())?;
    let displacements = match &args.displacements {
        Some(path) => Some(read_displacements(path, indices.order)?),
        None => None,
    };

    let alone = rows_alone(&stiffness);
    let system = System::new(stiffness, mass, Some(friction), contacts.particles)?;
    let system = system.with_radii(radii)?;
    let coordinates = match &args.coordinates {
        Some(path) => {
            let table = read_node_table(path, &indices)?;
            let placed = Coordinates::new(table.nodes, table.edges, &system);
            Some(placed.map_err(|source| CliError::file(path, source))?)
        }
        None => None,
    };
    let slip = system.slip_particles().len();
    let dofs = system.dofs();
    let plausibility = Plausibility::new(&PlausibilityInput {
        system: &system,
        rows_alone: &alone,
        places: None,
        reactions: &contacts.reactions,
        asks_for_reactions: true,
        displacements: displacements.as_deref(),
        coordinates: coordinates.as_ref(),
        dof_names: indices.names.as_ref(),
    });

    let mut problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?;
    problem.name = args.name.clone();
    problem.coordinates = coordinates;
    problem.warnings = kept_warnings(args, &plausibility)?;
    problem.comment = comment(&changes);

    output.write(&format!("{}\n", write_problem(&problem)))?;
    let particles = counted(slip, "particle");
    let what = format!("{dofs} degrees of freedom, {particles} in impending slip");
    say_written(args, &what, &changes, &plausibility)
}

/// How far K and M may be off, as the options say.
fn radii(args: &Args, stiffness: &Sparse, mass: Option<&Sparse>) -> Result<Radii, CliError> {
    if let Some(share) = &args.within {
        let share = share_of("within", share)?;
        return Ok(Radii {
            stiffness: Some(Radii::relative(stiffness, &share)),
            mass: mass.map(|mass| Radii::relative(mass, &share)),
        });
    }
    if !args.as_printed {
        return Ok(Radii::NONE);
    }

    let printed = |what, path: &Path| {
        let source = text(what, path)?;
        if !source.starts_with("%%") {
            let expected = "Matrix Market files, of which the digits are known";
            return Err(CliError::option("as-printed", expected, "another format"));
        }
        let radius = read_printed_radius(what, &source).map_err(|e| CliError::file(path, e))?;
        Ok(larger_of_mirrors(&radius))
    };
    Ok(Radii {
        stiffness: Some(printed("K", &args.stiffness)?),
        mass: args
            .mass
            .as_deref()
            .map(|mass| printed("M", mass))
            .transpose()?,
    })
}

/// Each entry and its mirror at the larger of the two.
fn larger_of_mirrors(radius: &Sparse) -> Sparse {
    let mirror = radius.transpose();
    let all = radius.entries().chain(mirror.entries());
    let mut larger: BTreeMap<(usize, usize), Rational> = BTreeMap::new();
    for (i, j, r) in all {
        let entry = larger.entry((i, j)).or_default();
        *entry = r.max(entry).clone();
    }

    let entries = larger.into_iter().map(|((i, j), r)| (i, j, r));
    Sparse::from_entries(radius.rows(), radius.cols(), entries)
}

/// A share of less than 1.
fn share_of(option: &'static str, given: &str) -> Result<Rational, CliError> {
    let share = positive_number(given).filter(|share| *share < Rational::one());
    share.ok_or_else(|| CliError::option(option, "a share between 0 and 1, as 0.001", given))
}

/// The friction factor of a slip particle within a share of what it is.
fn within(particle: &mut Particle, share: &Rational) {
    if let ContactState::Slip { .. } = particle.state {
        let factor = &particle.friction_factor;
        let off = factor * share;
        particle.friction_factor_range = Some([factor - &off, factor + &off]);
    }
}

/// Writes a body under loads.
fn write_body(
    args: &Args,
    model: Model,
    loads: &Path,
    friction: Option<Rational>,
    output: &Output,
) -> Result<u8, CliError> {
    let Model {
        stiffness,
        mass,
        indices,
        mut changes,
    } = model;
    let contacts = text("the contact candidates", &args.contacts)?;
    if contacts.trim_start().starts_with('[') {
        let expected = "a CSV table of candidates with --loads";
        return Err(CliError::option("contacts", expected, "JSON"));
    }
    let candidates = read_candidates(&contacts, &|name| indices.index(name));
    let candidates = candidates.map_err(|e| CliError::other_file(&args.contacts, e))?;
    let steps = text("the loads", loads)?;
    let steps = read_steps(&steps, &|name| indices.index(name));
    let mut steps = steps.map_err(|e| CliError::other_file(loads, e))?;
    if let Some(last) = steps.last_mut() {
        last.is_endless = args.endless;
    }

    let alone = rows_alone(&stiffness);
    let body = LoadedBody::new(LoadedParts {
        stiffness,
        mass,
        friction,
        candidates,
        held: Vec::new(),
        steps,
    })?;
    changes.extend(directions(body.system().particles()));
    let coordinates = match &args.coordinates {
        Some(path) => {
            let table = read_node_table(path, &indices)?;
            let placed = Coordinates::under_loads(table.nodes, table.edges, &body);
            Some(placed.map_err(|source| CliError::file(path, source))?)
        }
        None => None,
    };

    let dof_names = indices.names.map(|names| not_held(names, body.places()));
    let plausibility = Plausibility::new(&PlausibilityInput {
        system: body.system(),
        rows_alone: &alone,
        places: Some(body.places()),
        reactions: &vec![None; body.gaps().len()],
        asks_for_reactions: false,
        displacements: None,
        coordinates: coordinates.as_ref(),
        dof_names: dof_names.as_ref(),
    });

    let file = LoadsFile {
        name: args.name.clone(),
        comment: comment(&changes),
        warnings: kept_warnings(args, &plausibility)?,
        body,
        coordinates,
    };
    output.write(&format!("{}\n", write_loads(&file)))?;
    let dofs = file.body.system().dofs();
    let candidates = counted(file.body.gaps().len(), "contact candidate");
    let steps = counted(file.body.steps().len(), "load step");
    let what = format!("{dofs} degrees of freedom that are not held, {candidates}, {steps}");
    say_written(args, &what, &changes, &plausibility)
}

/// The names of the degrees of freedom that are not held, in the order without the others.
fn not_held(names: DofNames, places: &[Option<usize>]) -> DofNames {
    let names = names.into_iter();
    names
        .filter_map(|(name, given)| Some((name, places[given]?)))
        .collect()
}

fn comment(changes: &[String]) -> Option<String> {
    (!changes.is_empty()).then(|| changes.join(" "))
}

/// The warnings that go into the file.
///
/// # Errors
/// [`CliError::Strict`]: there is one, and none is to be.
fn kept_warnings(args: &Args, plausibility: &Plausibility) -> Result<Vec<String>, CliError> {
    let warnings = plausibility.warnings.clone();
    match (args.strict, args.accept_warnings) {
        (true, _) if !warnings.is_empty() => Err(CliError::Strict { warnings }),
        (_, true) => Ok(Vec::new()),
        _ => Ok(warnings),
    }
}

/// Says what was written, what was changed on the way, and what looks wrong.
fn say_written(
    args: &Args,
    what: &str,
    changes: &[String],
    plausibility: &Plausibility,
) -> Result<u8, CliError> {
    let place = args.out.display();
    print(&format!("{place}: {what}\n"))?;
    for change in changes {
        print(&format!("{change}\n"))?;
    }
    for (name, found) in &plausibility.table {
        print(&format!("    {name}: {found}\n"))?;
    }
    for warning in &plausibility.warnings {
        print(&format!("WARNING: {warning}.\n"))?;
    }

    let count = counted(plausibility.warnings.len(), "warning");
    let repeats = match args.loads {
        None => "analyze",
        Some(_) => "path",
    };
    if args.accept_warnings {
        print(&format!("{count} accepted; not in the file.\n"))?;
    } else if !plausibility.warnings.is_empty() {
        print(&format!(
            "{count} written into the file: `mceip {repeats}` repeats what --accept-warnings would \
             leave out.\n"
        ))?;
    }
    Ok(exit::DONE)
}

/// The matrix, or where it is symmetric up to rounding and `symmetrize` is given, its symmetric
/// part.
///
/// # Errors
/// A matrix that is symmetric up to rounding, without `symmetrize`. Others are judged by `System`.
fn symmetric(
    what: &'static str,
    matrix: Sparse,
    symmetrize: bool,
    changes: &mut Vec<String>,
) -> Result<Sparse, CliError> {
    if asymmetry(&matrix) != Asymmetry::Rounding {
        return Ok(matrix);
    }
    if !symmetrize {
        return Err(CliError::RoundedSymmetry { what });
    }

    changes.push(format!(
        "{what} is the mean of the given matrix and its transpose."
    ));
    Ok(symmetric_part(&matrix))
}

/// A sentence for each direction of an obstacle, with the numbers of its particles.
fn directions(particles: &[Particle]) -> Vec<String> {
    let mut of_frame: Vec<(&Frame, Vec<String>)> = Vec::new();
    for (number, particle) in particles.iter().enumerate() {
        let Some(frame) = &particle.frame else {
            continue;
        };
        match of_frame.iter_mut().find(|(known, _)| *known == frame) {
            Some((_, numbers)) => numbers.push(number.to_string()),
            None => of_frame.push((frame, vec![number.to_string()])),
        }
    }

    let mut sentences = Vec::new();
    for (frame, numbers) in of_frame {
        let angle = angle_in_degrees(frame);
        let [c, s] = &frame[0];
        let numbers = numbers.join(" ");
        sentences.push(format!(
            "Tangent of particles {numbers}: turned by {angle:.10} degrees, ({c}, {s})."
        ));
    }

    sentences
}

/// The names of degrees of freedom in a table of contacts.
struct DofIndices {
    /// Those of CalculiX, `node.direction`; without them a name is an index.
    names: Option<DofNames>,
    /// Number of degrees of freedom.
    order: usize,
}

type DofNames = HashMap<String, usize>;

impl DofIndices {
    /// The index of a name, from 0.
    fn index(&self, name: &str) -> Option<usize> {
        match &self.names {
            Some(names) => names.get(name).copied(),
            None => name.parse().ok().filter(|dof| *dof < self.order),
        }
    }
}

/// The contact states: a JSON list of particles, or else a table.
fn read_states(
    path: &Path,
    friction: &Rational,
    indices: &DofIndices,
) -> Result<ContactTable, CliError> {
    let contacts = text("the contacts", path)?;
    let is_json = contacts.trim_start().starts_with('[');
    if is_json {
        let read = read_particles(&contacts);
        let mut particles = read.map_err(|source| CliError::file(path, source))?;
        make_frames_exact(&mut particles);
        let reactions = vec![None; particles.len()];
        return Ok(ContactTable {
            particles,
            reactions,
        });
    }

    let read = read_contacts(&contacts, friction, &|name| indices.index(name));
    read.map_err(|e| CliError::other_file(path, e))
}

fn read_node_table(path: &Path, indices: &DofIndices) -> Result<NodeTable, CliError> {
    let source = text("the coordinates", path)?;
    let table = read_nodes(&source, &|name| indices.index(name));
    table.map_err(|e| CliError::other_file(path, e))
}

/// A displacement for each of `order` degrees of freedom: plain numbers, or Matrix Market.
fn read_displacements(path: &Path, order: usize) -> Result<Vec<f64>, CliError> {
    let source = text("the displacements", path)?;
    let values = if source.starts_with("%%") {
        let matrix = read_matrix_market("u", &source).map_err(|e| CliError::file(path, e))?;
        if matrix.cols() != 1 {
            let got = format!("a matrix with {} columns", matrix.cols());
            return Err(CliError::displacements(path, order, got));
        }
        first_column(&matrix)
    } else {
        plain_numbers(&source).map_err(|got| CliError::displacements(path, order, got))?
    };

    if values.len() != order {
        let got = format!("{} numbers", values.len());
        return Err(CliError::displacements(path, order, got));
    }
    Ok(values)
}

fn first_column(matrix: &Sparse) -> Vec<f64> {
    let column = (0..matrix.rows()).map(|row| to_f64(&matrix.get(row, 0)));
    column.collect()
}

/// The numbers of a text.
///
/// # Errors
/// The first word that is not a finite number.
fn plain_numbers(text: &str) -> Result<Vec<f64>, String> {
    let mut numbers = Vec::new();
    for word in text.split_whitespace() {
        match word.parse::<f64>() {
            Ok(number) if number.is_finite() => numbers.push(number),
            _ => {
                let shown: String = word.chars().filter(|c| !c.is_control()).take(60).collect();
                return Err(format!("{shown:?}"));
            }
        }
    }

    Ok(numbers)
}

fn read_dof_names(path: &Path) -> Result<DofNames, CliError> {
    let source = text("the degrees of freedom", path)?;
    read_dofs(&source).map_err(|e| CliError::other_file(path, e))
}

/// A Matrix Market file by its banner; else a triangle of CalculiX, whose order .dof knows.
fn read_matrix(
    what: &'static str,
    path: &Path,
    dofs: Option<&DofNames>,
) -> Result<Sparse, CliError> {
    let source = text(what, path)?;
    match dofs {
        Some(names) if !source.starts_with("%%") => {
            read_triangle(&source, names.len()).map_err(|e| CliError::other_file(path, e))
        }
        _ => read_matrix_market(what, &source).map_err(|e| CliError::file(path, e)),
    }
}
