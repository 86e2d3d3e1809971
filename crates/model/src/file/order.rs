//! The largest order of a matrix, in a file or from a caller.

use crate::ModelError;

/// Largest order of a matrix that is read.
pub const MAX_ORDER: usize = 1_000_000;

/// Refuses absurd sizes before anything is allocated for them.
///
/// # Errors
/// [`ModelError::TooLarge`].
pub fn require_order(what: &'static str, order: usize) -> Result<(), ModelError> {
    if order > MAX_ORDER {
        return Err(ModelError::TooLarge {
            what,
            limit: MAX_ORDER as u64,
            got: order as u64,
        });
    }

    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_order_is_allowed() {
        assert!(require_order("K", MAX_ORDER).is_ok());
        assert!(matches!(
            require_order("K", MAX_ORDER + 1),
            Err(ModelError::TooLarge { what: "K", .. })
        ));
    }
}
