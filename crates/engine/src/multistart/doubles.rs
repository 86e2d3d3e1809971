//! Can the MCP of a pencil be stated in doubles?
//!
//! The embedding scales A and B together, the variables and the unknown. Where that does not bring
//! all entries within the doubles, the MCP has an infinity, and no run can start. Called by the
//! searches before their first run.

use super::error::SearchError;
use crate::magnitude::decimal_order;
use crate::reduction::{Embedding, Side};
use mceip_exact::{Sparse, to_f64};
use mceip_model::{Admissible, Window, ZeroVariables};

/// Refuses a pencil or a window with numbers that doubles cannot carry.
///
/// # Errors
/// [`SearchError::BeyondDoubles`], naming the number furthest from 1.
pub(super) fn require_doubles(
    admissible: &Admissible<'_>,
    zero: &[ZeroVariables],
    window: &Window,
) -> Result<(), SearchError> {
    if !to_f64(window.min()).is_finite() {
        return Err(SearchError::BeyondDoubles {
            place: "window".into(),
            exponent: decimal_order(window.min()),
        });
    }

    let embedding = Embedding::with_zero(admissible, zero, Side::Above(0.0));
    if embedding.is_finite() {
        return Ok(());
    }

    let pencil = admissible.pencil();
    let of_a = furthest_entry("A", pencil.a());
    let of_b = furthest_entry("B", pencil.b());
    let furthest = of_a.into_iter().chain(of_b);
    let furthest = furthest.max_by_key(|(_, exponent)| exponent.abs());
    match furthest {
        Some((place, exponent)) => Err(SearchError::BeyondDoubles { place, exponent }),
        None => Ok(()),
    }
}

/// The entry of a matrix that is furthest from 1, and its decimal order of magnitude.
fn furthest_entry(name: &str, matrix: &Sparse) -> Option<(String, i64)> {
    let entries = matrix.entries();
    let orders = entries.map(|(row, col, v)| (format!("{name}[{row}][{col}]"), decimal_order(v)));
    orders.max_by_key(|(_, exponent)| exponent.abs())
}
