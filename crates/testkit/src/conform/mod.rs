//! Conformance: problems with complete exact answers for other people's implementations, in the
//! manner of Wycheproof.
//!
//! ```text
//! groups -> drafts -> cases (plain oracle: complete answer, flags, wrong answers) -> pack files
//!                       |
//!                       +-> foreign program (stdin: problem, stdout: mceip-solutions/1)
//!                             |
//!                             +-> judge -> labels per flag
//! ```
//!
//! The pack in `spec/conformance-pack/` is what [`pack_files`] writes, byte for byte;
//! `mceip conform` needs no files. The pages: `spec/conform.md`.

mod case;
mod flag;
mod groups;
mod judge;
mod lines;
mod nearest;
mod pack;
mod process;
mod run;
mod spectrum;
mod summary;
mod wrong;

pub use case::{Case, Draft, Group};
pub use flag::Flag;
pub use groups::{groups, random_draft};
pub use judge::{Judgement, Label, judge_report};
pub(crate) use pack::sha256_of;
pub use pack::{INDEX_FORMAT, PACK_FORMAT, pack_files, read_pack};
pub use process::{Ending, Limits, run_once};
pub use run::{Outcome, Plan, run};
pub use summary::{Summary, summarise};
pub use wrong::{Bug, WrongAnswer};
