//! The leaves of a tree: one file per kind of evidence, named as the checker's file that reads it.
//!
//! | node of the certificate | made in | checked in `check::cover` |
//! |---|---|---|
//! | `farkas` | [`farkas`] | `farkas` |
//! | `positive_definite`, `negative_definite` | [`definite`] | `definite` |
//! | `weighted_definite` | [`weighted`] | `definite` |
//! | `ldl` | [`ldl`] | `ldl` |
//! | `tail` | [`tail`] | `condensed` (`tail`) |
//! | `root` | [`root`], and `precise` with long numbers | `root` |
//! | `root` over a half line | [`infinity`] | `infinity` |
//! | `support` | [`support`] | `support` |
//! | `regular` | [`regular`] | `regular` |
//! | `open` | `tree` | nothing is proved |
//!
//! A file takes a region with its matrices and gives the node, or nothing where the evidence cannot
//! be had. None of them goes on with the search: that is for `tree`.
//!
//! Who adds a kind of leaf writes
//!
//! - its data: a variant of `Node` in `certificate/cover.rs`, with its word and the formats that
//!   have it (`kind`, `fits`), and the schema in `spec/schemas/`;
//! - its check: one file in `check/cover/` that implements `Leaf`, and a line of `leaf::check`;
//! - its maker: one file here, named in `tree`, which tries the kinds in turn;
//! - its page: a section of chapter 5 with an example, from which `spec/checker.py` follows;
//! - its forgeries: files of the corpus, one for each reason of rejection;
//! - its name for the verified checker: `verified/kinds.rs` of the test kit.

pub(crate) mod definite;
pub(crate) mod farkas;
pub(super) mod infinity;
pub(super) mod ldl;
pub(crate) mod regular;
pub(super) mod root;
pub(super) mod support;
pub(crate) mod tail;
pub(crate) mod weighted;
