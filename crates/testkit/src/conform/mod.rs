//! Conformance: problems with complete exact answers for other people's implementations, in the
//! manner of Wycheproof.
//!
//! ```text
//! groups, tier2 -> drafts -> cases (answer by the plain oracle, or certified; flags; wrong
//!                       |            answers) -> pack files
//!                       +-> foreign program (stdin: problem, stdout: mceip-solutions/1)
//!                             |
//!                             +-> judge -> labels per flag
//! ```
//!
//! The pack in `spec/conformance-pack/` is what [`pack_files`] writes, byte for byte;
//! `mceip conform` needs no files. Tier 2 is in `spec/conformance-pack-2/`. The pages:
//! `spec/conform.md`.

mod case;
mod certified;
mod compare;
mod eigenvalues;
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
mod tier2;
mod wrong;

pub use case::{Case, CaseAnswer, Difficulty, Draft, Group};
pub use certified::{CertifiedAnswer, Completeness};
pub use compare::{ConformComparison, ConformRun, ProfileSteps, measured_difficulty};
pub use flag::{Flag, FlagChoice};
pub use groups::{groups, random_draft};
pub use judge::{Judgement, Label, judge_report};
pub use pack::{
    CasePack, INDEX_FORMAT, PACK_FORMAT, PACK_VERSION, PackName, pack_files, read_pack,
};
pub use process::{ProcessEnding, ProcessLimits, run_once};
pub use run::{CaseOutcome, ConformPlan, run};
pub use summary::{ConformScore, RUN_FORMAT, RunHead, Summary, summarise};
pub use tier2::tier2;
pub use wrong::{Bug, WrongAnswer};
