//! The leaves of a tree: one file per kind of evidence, named as the checker's file that reads it.
//!
//! | node of the certificate | made in | checked in `check::cover` |
//! |---|---|---|
//! | `farkas` | [`farkas`] | `farkas` |
//! | `positive_definite`, `negative_definite` | [`definite`] | `definite` |
//! | `ldl` | [`ldl`] | `ldl` |
//! | `tail` | [`tail`] | `condensed` (`tail`) |
//! | `root` | [`root`], and `precise` with long numbers | `root` |
//! | `root` over a half line | [`infinity`] | `infinity` |
//! | `support` | [`support`] | `support` |
//! | `open` | `tree` | nothing is proved |
//!
//! A file takes a region with its matrices and gives the node, or nothing where the evidence cannot
//! be had. None of them goes on with the search: that is for `tree`.
//!
//! Who adds a kind of leaf writes four places: `certificate/cover.rs` (its data), one file in
//! `check/cover/`, one file here, and chapter 5 of the book. It is then named in `tree`, which
//! tries the kinds in turn, and in the checker's `walk`.

pub(crate) mod definite;
pub(crate) mod farkas;
pub(super) mod infinity;
pub(super) mod ldl;
pub(super) mod root;
pub(super) mod support;
pub(crate) mod tail;
