//! A candidate of the ratio test: the unknown that stops the moving one, and after which step.

/// What stops the moving unknown.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BlockingVariable<T> {
    /// How far the moving unknown gets.
    pub(super) step: T,
    /// Place of the basic unknown that stops it; `None` if it reaches its own bound.
    pub(super) place: Option<usize>,
    /// Is the bound reached an upper one?
    pub(super) at_upper: bool,
}
