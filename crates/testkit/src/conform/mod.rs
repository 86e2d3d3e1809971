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

/// An enumeration whose variants have a word for files and a note for people.
macro_rules! worded {
    ($(#[$doc:meta])* $name:ident: $($variant:ident $word:literal $note:literal,)+) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[allow(missing_docs, reason = "the note of each is its documentation")]
        pub enum $name { $($variant,)+ }

        impl $name {
            /// All of them, in the order of tables.
            pub const ALL: &'static [$name] = &[$($name::$variant,)+];

            /// As it stands in files.
            pub fn word(self) -> &'static str {
                match self { $($name::$variant => $word,)+ }
            }

            /// The one with this word.
            pub fn of_word(word: &str) -> Option<$name> {
                $name::ALL.iter().copied().find(|one| one.word() == word)
            }

            /// What it means, in a sentence for people.
            pub fn note(self) -> &'static str {
                match self { $($name::$variant => $note,)+ }
            }
        }
    };
}

mod case;
mod certified;
mod compare;
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
pub use flag::Flag;
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
