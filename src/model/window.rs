//! The closed window in which values of the unknown are wanted.

use super::ModelError;
use crate::exact::Rational;
use num_traits::{Signed, Zero};

/// The closed window [min, max], 0 <= min; no max means infinity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Window {
    min: Rational,
    max: Option<Rational>,
}

impl Window {
    /// The window [min, max].
    ///
    /// # Errors
    /// [`ModelError::Window`] if min is negative (both unknowns are non-negative) or above max.
    pub fn new(min: Rational, max: Option<Rational>) -> Result<Self, ModelError> {
        if min.is_negative() || max.as_ref().is_some_and(|m| *m < min) {
            let max = max.map_or_else(|| "infinity".into(), |m| m.to_string());
            return Err(ModelError::Window { min, max });
        }
        Ok(Window { min, max })
    }

    /// [0, infinity): all values the paper allows.
    pub fn all() -> Self {
        Window { min: Rational::zero(), max: None }
    }

    /// Lower end.
    pub fn min(&self) -> &Rational {
        &self.min
    }

    /// Upper end, `None` for infinity.
    pub fn max(&self) -> Option<&Rational> {
        self.max.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::whole;

    #[test]
    fn empty_and_negative_windows_are_refused() {
        assert!(Window::new(whole(1), Some(whole(1))).is_ok());
        assert!(Window::new(whole(2), Some(whole(1))).is_err());
        assert!(Window::new(whole(-1), None).is_err());
    }
}
