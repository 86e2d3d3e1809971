//! Which bound holds an unknown: on a curve the one it has reached, on Lemke's ray the one it stays
//! at. The sign of its multiplier F_i follows from it. Read by `continuation` and `path/start`.

/// The bound that an unknown is at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ActiveBound {
    /// None: the unknown is strictly inside; its multiplier is zero.
    None,
    /// The lower bound; the multiplier is >= 0.
    Lower,
    /// The upper bound; the multiplier is <= 0.
    Upper,
    /// Both bounds, which are equal; the multiplier has any sign.
    Fixed,
}
