//! How many supports each filter settled.

use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

/// Supports by what settled them; they add up to the supports examined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Statistics {
    /// Proved empty: the determinant has no root in the window (Bernstein coefficients of one sign).
    pub no_root: u64,
    /// Proved empty: a row whose entries have one sign for all t >= 0.
    pub row_signs: u64,
    /// Proved empty: a Farkas vector for each piece of the window that may hold a root.
    pub farkas: u64,
    /// Examined exactly: a solution, a tie, or too close for doubles.
    pub open: u64,
    /// Examined exactly: the determinant is identically zero.
    pub singular: u64,
}

impl Statistics {
    /// Supports counted.
    pub fn total(&self) -> u64 {
        self.no_root + self.row_signs + self.farkas + self.open + self.singular
    }
}

impl AddAssign for Statistics {
    fn add_assign(&mut self, other: Statistics) {
        self.no_root += other.no_root;
        self.row_signs += other.row_signs;
        self.farkas += other.farkas;
        self.open += other.open;
        self.singular += other.singular;
    }
}

impl std::fmt::Display for Statistics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{} without a root in the window, {} by signs of a row, {} by Farkas vectors, {} singular and {} others exactly",
            self.no_root, self.row_signs, self.farkas, self.singular, self.open
        )
    }
}
