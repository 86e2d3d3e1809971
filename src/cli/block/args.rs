//! The arguments of `mceip block`.

use crate::cli::common::CliError;
use mceip_paper::{MassKind, PublishedState};
use std::path::PathBuf;

/// Arguments of `block`.
#[derive(clap::Args)]
pub(in crate::cli) struct Args {
    /// Only this state: 15 or 17 (nodes in impending slip).
    #[arg(long, conflicts_with = "loads")]
    pub(super) state: Option<u8>,
    /// Lumped instead of consistent mass (plays no part in MCEIP-mu).
    #[arg(long)]
    pub(super) lumped: bool,
    /// Write problem files and certificates into this folder.
    #[arg(long, value_name = "FOLDER", conflicts_with = "loads")]
    pub(super) write: Option<PathBuf>,
    /// Write the block and its loading (press, then move to the left) as `mceip-loads/1`, input of
    /// `mceip path`, instead.
    #[arg(long, value_name = "OUT.json")]
    pub(super) loads: Option<PathBuf>,
    /// Coefficient of friction of the loading.
    #[arg(
        long,
        default_value = "1.1",
        requires = "loads",
        allow_hyphen_values = true
    )]
    pub(super) mu: String,
    /// Normal force at the end of the pressing, N.
    #[arg(
        long,
        default_value = "55",
        requires = "loads",
        allow_hyphen_values = true
    )]
    pub(super) force: String,
    /// Motion at which to stop, mm (default: the last event).
    #[arg(long, requires = "loads", allow_hyphen_values = true)]
    pub(super) until: Option<String>,
    /// Triangulation of the loaded block: crossed, union-jack, slash, backslash.
    #[arg(long, default_value = "crossed", requires = "loads")]
    pub(super) mesh: String,
    /// Cells along and across the contact side of the loaded block (80 mm long).
    #[arg(long, default_value = "20x10", requires = "loads")]
    pub(super) cells: String,
    /// Height of the loaded block, mm.
    #[arg(
        long,
        default_value = "40",
        requires = "loads",
        allow_hyphen_values = true
    )]
    pub(super) height: String,
    /// Plane stress or strain of the loaded block: stress, strain.
    #[arg(long, default_value = "stress", requires = "loads")]
    pub(super) plane: String,
    /// A refinement study instead: the paper's block with NXxNY cells, 17 of every 20 contact nodes
    /// in impending slip, condensed in doubles by one sparse Cholesky; several with commas.
    #[arg(
        long,
        value_name = "NXxNY",
        value_delimiter = ',',
        conflicts_with_all = ["loads", "state"]
    )]
    pub(super) scale: Vec<String>,
    /// MCEIP-lambda2 at this friction (several with commas), by sparse condensation and many
    /// starts: of the published states, or of the meshes of --scale; each solution certified where
    /// the mesh is small enough.
    #[arg(long, value_name = "MU", value_delimiter = ',', conflicts_with_all = ["loads", "write"])]
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
