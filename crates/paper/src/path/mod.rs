//! The quasi-static loading of section 5: press the glued side CD until the normal resultant is N,
//! then move it to the left.
//!
//! `mceip_path` follows the path; here stands what only the block has: its two loads, the scale of
//! its pressing, and ordinary stepping for comparison. `tests/paper/path_states.rs` proves that the
//! path of the paper's block at mu = 1.1 is the only one.
//!
//! | file | what |
//! |---|---|
//! | `loading` | friction, force and range |
//! | `block_path` | the two loads of a [`crate::Block`], and its path in mm and N |
//! | `step`, `compare` | incremental stepping in doubles, and how far it is from the path |

mod block_path;
mod compare;
mod error;
mod loading;
mod step;

pub use block_path::BlockPath;
pub use compare::Comparison;
pub use error::BlockPathError;
pub use loading::Loading;
pub use step::{Step, step_path};
