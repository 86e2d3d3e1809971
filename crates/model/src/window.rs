//! The closed window in which values of the unknown are wanted: of lambda^2 and mu one of
//! non-negative numbers, of an eigenvalue any.

use super::ModelError;
use mceip_exact::Rational;
use num_traits::{Signed as _, Zero};
use std::cmp::Ordering;
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
}

/// "[0, 5/2]" or "[0, infinity)".
impl fmt::Display for Window {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        RealWindow::from(self).fmt(f)
    }
}

/// The closed window [min, max] of real numbers; no min means -infinity, no max infinity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RealWindow {
    min: Option<Rational>,
    max: Option<Rational>,
}

/// "[-1, 5/2]" or "(-infinity, infinity)".
impl fmt::Display for RealWindow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.min {
            Some(min) => write!(f, "[{min}, ")?,
            None => write!(f, "(-infinity, ")?,
        }
        match &self.max {
            Some(max) => write!(f, "{max}]"),
            None => write!(f, "infinity)"),
        }
    }
}

impl RealWindow {
    /// The real line.
    pub const ALL: RealWindow = RealWindow {
        min: None,
        max: None,
    };

    /// The window [min, max].
    ///
    /// # Errors
    /// [`ModelError::RealWindow`] if min is above max, or max below 0.
    pub fn new(min: Option<Rational>, max: Option<Rational>) -> Result<RealWindow, ModelError> {
        let window = RealWindow { min, max };
        let RealWindow { min, max } = &window;
        let is_empty = matches!((min, max), (Some(min), Some(max)) if min > max);
        let ends_below_zero = max.as_ref().is_some_and(Rational::is_negative);
        if is_empty || ends_below_zero {
            let text = |end: &Option<Rational>| end.as_ref().map(ToString::to_string);
            return Err(ModelError::RealWindow {
                min: text(min).unwrap_or_else(|| "-infinity".into()),
                max: text(max).unwrap_or_else(|| "infinity".into()),
                ends_below_zero,
            });
        }

        Ok(window)
    }

    /// The values -s with s in `negative`, and those of `window`, which begins where they end.
    pub(super) fn joined(negative: Option<&Window>, window: &Window) -> RealWindow {
        RealWindow {
            min: match negative {
                Some(negative) => negative.max.as_ref().map(|max| -max),
                None => Some(window.min.clone()),
            },
            max: window.max.clone(),
        }
    }

    /// The values that are not negative.
    pub(super) fn non_negative(&self) -> Window {
        let min = self.min.clone().unwrap_or_else(Rational::zero);
        Window {
            min: min.max(Rational::zero()),
            max: self.max.clone(),
        }
    }

    /// The s >= 0 with -s in the window, if some value of it is negative.
    pub(super) fn negative(&self) -> Option<Window> {
        if self.min.as_ref().is_some_and(|min| !min.is_negative()) {
            return None;
        }

        Some(Window {
            min: Rational::zero(),
            max: self.min.as_ref().map(|min| -min),
        })
    }

    /// The -s with s in the window.
    pub fn reflection(window: &Window) -> RealWindow {
        RealWindow {
            min: window.max.as_ref().map(|max| -max),
            max: Some(-&window.min),
        }
    }

    /// The windows of statements about the -s with s in `negative` and about the values in
    /// `window`: one where 0 joins them.
    pub fn of_parts(negative: Option<&Window>, window: Option<&Window>) -> Vec<RealWindow> {
        match (negative, window) {
            (Some(negative), Some(window)) if negative.min.is_zero() && window.min.is_zero() => {
                vec![RealWindow::joined(Some(negative), window)]
            }
            (negative, window) => {
                let negative = negative.map(RealWindow::reflection);
                negative
                    .into_iter()
                    .chain(window.map(RealWindow::from))
                    .collect()
            }
        }
    }

    /// Does this window hold every value of the other one?
    pub fn covers(&self, other: &RealWindow) -> bool {
        let reaches = |mine: &Option<Rational>, theirs: &Option<Rational>, side| {
            let Some(mine) = mine else { return true };
            theirs
                .as_ref()
                .is_some_and(|theirs| mine.cmp(theirs) != side)
        };

        let reaches_down = reaches(&self.min, &other.min, Ordering::Greater);
        reaches_down && reaches(&self.max, &other.max, Ordering::Less)
    }

    /// Lower end, `None` for -infinity.
    pub fn min(&self) -> Option<&Rational> {
        self.min.as_ref()
    }

    /// Upper end, `None` for infinity.
    pub fn max(&self) -> Option<&Rational> {
        self.max.as_ref()
    }
}

impl From<&RealWindow> for RealWindow {
    fn from(window: &RealWindow) -> RealWindow {
        window.clone()
    }
}

impl From<&Window> for RealWindow {
    fn from(window: &Window) -> RealWindow {
        RealWindow::joined(None, window)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    #[test]
    fn a_window_covers_its_parts() {
        let window = |min: i64, max: Option<i64>| {
            let window = Window::new(whole(min), max.map(whole)).unwrap();
            RealWindow::from(&window)
        };
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

    fn real(min: Option<i64>, max: Option<i64>) -> RealWindow {
        RealWindow::new(min.map(whole), max.map(whole)).unwrap()
    }

    /// [-3, 5] is [0, 5] and, with the sign changed, [0, 3].
    #[test]
    fn a_real_window_has_a_part_on_each_side_of_zero() {
        let window = |min: i64, max: Option<i64>| Window::new(whole(min), max.map(whole)).unwrap();
        for (both, above, below) in [
            (
                real(Some(-3), Some(5)),
                window(0, Some(5)),
                Some(window(0, Some(3))),
            ),
            (
                real(None, Some(0)),
                window(0, Some(0)),
                Some(window(0, None)),
            ),
            (real(Some(0), None), window(0, None), None),
            (real(Some(2), Some(2)), window(2, Some(2)), None),
            (RealWindow::ALL, Window::all(), Some(Window::all())),
        ] {
            assert_eq!(
                (both.non_negative(), both.negative()),
                (above.clone(), below.clone())
            );
            assert_eq!(RealWindow::joined(below.as_ref(), &above), both);
            assert_eq!(RealWindow::of_parts(below.as_ref(), Some(&above)), [both]);
        }

        // With a gap at 0 there are two, and one alone is on its side.
        let apart = RealWindow::of_parts(Some(&window(1, Some(3))), Some(&window(0, None)));
        let below = || RealWindow {
            min: Some(whole(-3)),
            max: Some(whole(-1)),
        };
        assert_eq!(apart, [below(), real(Some(0), None)]);
        assert_eq!(
            RealWindow::of_parts(Some(&window(1, Some(3))), None),
            [below()]
        );
        assert!(RealWindow::of_parts(None, None).is_empty());
    }

    #[test]
    fn real_windows_cover_their_parts() {
        let both = real(Some(-3), Some(5));
        assert!(RealWindow::ALL.covers(&both) && !both.covers(&RealWindow::ALL));
        assert!(both.covers(&real(Some(-3), Some(0))) && both.covers(&real(Some(5), Some(5))));
        assert!(!both.covers(&real(Some(-4), Some(0))) && !both.covers(&real(Some(0), Some(6))));
        assert!(!both.covers(&real(None, Some(0))) && !both.covers(&real(Some(0), None)));
    }

    #[test]
    fn real_windows_that_are_empty_or_end_below_zero_are_refused() {
        let refused = |min: Option<i64>, max: i64| {
            let refused = RealWindow::new(min.map(whole), Some(whole(max)));
            matches!(refused, Err(ModelError::RealWindow { .. }))
        };
        assert!(refused(Some(3), 2) && refused(Some(-3), -2) && refused(None, -1));
        assert!(!refused(Some(-3), 0) && !refused(None, 0));
    }
}
