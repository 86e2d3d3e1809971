//! Why a model of the block is refused: what [`super::Block`], [`super::DoubleBlock`] and
//! [`super::BlockModel::loads`] return for bad data.

use super::plane::Plane;
use mceip_exact::Rational;
use mceip_model::ModelError;
use mceip_path::PathError;

/// A block that cannot be built, or a contact state that does not fit it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// A mesh without a cell.
    #[error("mesh: expected at least 1 x 1 cells, got {nx} x {ny}")]
    NoCells {
        /// Cells along the contact side.
        nx: usize,
        /// Cells across it.
        ny: usize,
    },
    /// A mesh larger than [`super::MAX_CELLS`].
    #[error("mesh: expected at most {limit} cells, got {nx} x {ny}")]
    TooManyCells {
        /// Cells along the contact side.
        nx: usize,
        /// Cells across it.
        ny: usize,
        /// The bound.
        limit: usize,
    },
    /// A length, modulus or density that is zero or negative.
    #[error("block: expected {what} > 0, got {got}")]
    NotPositive {
        /// Which quantity, with its unit.
        what: &'static str,
        /// Its value.
        got: Rational,
    },
    /// Poisson's ratio outside what an elastic body can have.
    #[error(
        "block: expected Poisson's ratio {} in plane {}, got {got}",
        .plane.poisson_range(),
        .plane.word()
    )]
    Poisson {
        /// Plane stress or plane strain.
        plane: Plane,
        /// The ratio given.
        got: Rational,
    },
    /// More nodes in contact than the mesh has on its contact side.
    #[error(
        "contact states: expected at most {nodes} nodes in contact, got {stick} stuck and {slip} \
         in impending slip"
    )]
    TooManyContacts {
        /// Nodes of the contact side.
        nodes: usize,
        /// Stuck nodes asked for.
        stick: usize,
        /// Slip nodes asked for.
        slip: usize,
    },
    /// A loading that cannot be followed.
    #[error(transparent)]
    Loading(#[from] PathError),
    /// What no model can be made of.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// An entry of the assembly in doubles is too large for a double.
    #[error(
        "block in doubles: expected finite {what}, got {got} (units that make numbers overflow)"
    )]
    NotFinite {
        /// Which matrix.
        what: &'static str,
        /// The entry.
        got: String,
    },
}
