//! The closed window in which values of the unknown are wanted.

use super::ModelError;
use mceip_exact::Rational;
use num_traits::{Signed, Zero};
use std::fmt;

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
        Window {
            min: Rational::zero(),
            max: None,
        }
    }

    /// Lower end.
    pub fn min(&self) -> &Rational {
        &self.min
    }

    /// Upper end, `None` for infinity.
    pub fn max(&self) -> Option<&Rational> {
        self.max.as_ref()
    }

    /// Does this window hold every value of the other one?
    pub fn covers(&self, other: &Window) -> bool {
        let reaches_up = match (&self.max, &other.max) {
            (None, _) => true,
            (Some(_), None) => false,
            (Some(mine), Some(theirs)) => mine >= theirs,
        };

        self.min <= other.min && reaches_up
    }
}

/// "[0, 5/2]" or "[0, infinity)".
impl fmt::Display for Window {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.max {
            Some(max) => write!(f, "[{}, {max}]", self.min),
            None => write!(f, "[{}, infinity)", self.min),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    #[test]
    fn a_window_covers_its_parts() {
        let window = |min: i64, max: Option<i64>| Window::new(whole(min), max.map(whole)).unwrap();
        let (closed, half_line) = (window(1, Some(3)), window(1, None));

        for part in [
            window(1, Some(3)),
            window(2, Some(3)),
            window(1, Some(1)),
            window(3, Some(3)),
        ] {
            assert!(closed.covers(&part) && half_line.covers(&part), "{part:?}");
        }

        for more in [
            window(0, Some(3)),
            window(1, Some(4)),
            window(4, Some(5)),
            window(1, None),
        ] {
            assert!(!closed.covers(&more), "{more:?}");
        }

        assert!(half_line.covers(&half_line) && !half_line.covers(&window(0, Some(2))));
    }

    #[test]
    fn a_window_reads_as_an_interval() {
        let closed = Window::new(rational(1, 2), Some(whole(3))).unwrap();

        assert_eq!(closed.to_string(), "[1/2, 3]");
        assert_eq!(Window::all().to_string(), "[0, infinity)");
    }

    #[test]
    fn empty_and_negative_windows_are_refused() {
        assert!(Window::new(whole(1), Some(whole(1))).is_ok());
        assert!(Window::new(whole(2), Some(whole(1))).is_err());
        assert!(Window::new(whole(-1), None).is_err());
    }
}
