//! The campaign: instances of named families through all engines pairwise, for seconds or for days.
//!
//! An instance is named by its family, the seed and its index, so that every run, on any number of
//! threads, in any number of parts, sees the same instances. What disagrees is shrunk, and written
//! as a replay file that needs nothing else.
//!
//! ```text
//! family:seed:index -> named (generators) -> engine (judge) -> state (counts)
//!                                               |
//!                                               +-> shrink -> replay file
//! ```
//!
//! Called by `mceip campaign` and by `tests/campaign/`.

mod engine;
mod expected;
mod family;
mod named;
mod replay;
mod run;
mod shrink;
mod state;

pub use engine::{
    CaseFindings, Engine, Enumerator, Finding, KnownAnswer, Pipeline, Truth, judge, standard,
    treatment,
};
pub use expected::{Expected, Made};
pub use family::{CampaignCase, FAMILIES, Id, case, family_error};
pub use replay::{REPLAY_FORMAT, Replay};
pub use run::{Campaign, CampaignEvent, CampaignLimit};
pub use shrink::{MAX_TRIES, shrink, smaller};
pub use state::{MAX_INSTANCES, STATE_FORMAT, State};
