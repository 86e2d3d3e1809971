//! The arguments of `mceip block`.

use crate::cli::common::CliError;
use mceip_paper::{MassKind, PublishedState};
use std::path::PathBuf;

/// Arguments of `block`.
#[derive(clap::Args)]
#[command(
    group = clap::ArgGroup::new("loading").args(["path", "report", "pictures"]).multiple(true)
)]
pub(in crate::cli) struct Args {
    /// Only this state: 15 or 17 (nodes in impending slip).
    #[arg(long, conflicts_with = "loading")]
    pub(super) state: Option<u8>,
    /// Lumped instead of consistent mass (plays no part in MCEIP-mu).
    #[arg(long)]
    pub(super) lumped: bool,
    /// Write problem files and certificates into this folder.
    #[arg(long, value_name = "FOLDER", conflicts_with = "loading")]
    pub(super) write: Option<PathBuf>,
    /// The quasi-static loading path instead: press, then move to the left, event by event.
    #[arg(long)]
    pub(super) path: bool,
    /// Coefficient of friction of the path.
    #[arg(
        long,
        default_value = "1.1",
        requires = "loading",
        allow_hyphen_values = true
    )]
    pub(super) mu: String,
    /// Normal force at the end of the pressing, N.
    #[arg(
        long,
        default_value = "55",
        requires = "loading",
        allow_hyphen_values = true
    )]
    pub(super) force: String,
    /// Motion at which to stop, mm (default: the last event).
    #[arg(long, requires = "loading", allow_hyphen_values = true)]
    pub(super) until: Option<String>,
    /// For each stretch with slip the complete set of MCEIP-mu, proved.
    #[arg(long, requires = "loading")]
    pub(super) complete: bool,
    /// With --complete: check these sets on K itself instead of the exactly condensed pencil
    /// (slower).
    #[arg(long, requires = "loading")]
    pub(super) uncondensed: bool,
    /// With --complete: from which mu the necessary condition (19) or (20) holds.
    #[arg(long, requires = "loading")]
    pub(super) conditions: bool,
    /// With --complete: at these mu (one or more, by commas) the complete set of MCEIP-lambda2,
    /// with growth rates.
    #[arg(
        long,
        requires = "loading",
        value_name = "MU",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub(super) at_mu: Vec<String>,
    /// With --complete --json: the mode of each solution over all degrees of freedom.
    #[arg(long, requires = "loading")]
    pub(super) modes: bool,
    /// The path, every state's answers and pictures as one HTML file (implies --path --complete
    /// --conditions).
    #[arg(long, value_name = "OUT.html")]
    pub(super) report: Option<PathBuf>,
    /// The pictures as SVG files in this folder, as PNG too in a build with the feature png
    /// (implies --path --complete --conditions).
    #[arg(long, value_name = "FOLDER")]
    pub(super) pictures: Option<PathBuf>,
    /// Compare the path with ordinary incremental stepping, this many mm a step.
    #[arg(
        long,
        requires = "loading",
        value_name = "MM",
        allow_hyphen_values = true
    )]
    pub(super) step: Option<String>,
    /// Triangulation of the path's block: crossed, union-jack, slash, backslash.
    #[arg(long, default_value = "crossed", requires = "loading")]
    pub(super) mesh: String,
    /// Cells along and across the contact side of the path's block (80 mm long).
    #[arg(long, default_value = "20x10", requires = "loading")]
    pub(super) cells: String,
    /// Height of the path's block, mm.
    #[arg(
        long,
        default_value = "40",
        requires = "loading",
        allow_hyphen_values = true
    )]
    pub(super) height: String,
    /// Plane stress or strain: stress, strain.
    #[arg(long, default_value = "stress", requires = "loading")]
    pub(super) plane: String,
    /// A refinement study instead: the paper's block with NXxNY cells, 17 of every 20 contact nodes
    /// in impending slip, condensed in doubles by one sparse Cholesky; several with commas.
    #[arg(
        long,
        value_name = "NXxNY",
        value_delimiter = ',',
        conflicts_with_all = ["path", "state"]
    )]
    pub(super) scale: Vec<String>,
    /// MCEIP-lambda2 at this friction (several with commas), by sparse condensation and many
    /// starts: of the published states, or of the meshes of --scale; each solution certified where
    /// the mesh is small enough.
    #[arg(long, value_name = "MU", value_delimiter = ',', conflicts_with_all = ["path", "write"])]
    pub(super) lambda2: Vec<String>,
    /// Starts of --lambda2.
    #[arg(long, default_value_t = 22, requires = "lambda2")]
    pub(super) starts: usize,
    /// Seed of the starts of --lambda2.
    #[arg(long, default_value_t = 1, requires = "lambda2")]
    pub(super) seed: u64,
    /// Print JSON.
    #[arg(long)]
    pub(super) json: bool,
}

impl Args {
    /// The mass matrix that is asked for.
    pub(super) fn mass(&self) -> MassKind {
        if self.lumped {
            MassKind::Lumped
        } else {
            MassKind::Consistent
        }
    }
}

/// The published state named by --state, or both.
pub(super) fn published(state: Option<u8>) -> Result<Vec<PublishedState>, CliError> {
    match state {
        None => Ok(PublishedState::ALL.to_vec()),
        Some(15) => Ok(vec![PublishedState::FifteenSlip]),
        Some(17) => Ok(vec![PublishedState::SeventeenSlip]),
        Some(other) => Err(CliError::Option {
            option: "state",
            expected: "15 or 17",
            got: other.to_string(),
        }),
    }
}
