//! Complete answers beyond the oracle's reach: floats propose, each discard and each claim is
//! proved.
//!
//! | module | what |
//! |---|---|
//! | [`complete`] | all solutions in a window, with a certificate that there are no others |
//! | [`near`] | what is proved about the solutions near a value that somebody claims |
//! | [`levels`] | mu as a function of lambda^2, level by level |

pub mod complete;
pub mod levels;
pub mod near;
