//! Plane stress and plane strain.

/// What the body does out of its plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plane {
    /// No stress out of the plane (thin bodies; the paper's block).
    Stress,
    /// No strain out of the plane (long bodies).
    Strain,
}

impl Plane {
    /// Both.
    pub const ALL: [Plane; 2] = [Plane::Stress, Plane::Strain];

    /// `stress` or `strain`.
    pub fn word(self) -> &'static str {
        match self {
            Plane::Stress => "stress",
            Plane::Strain => "strain",
        }
    }

    /// The ratios nu that an elastic body can have; nu = 1/2 (incompressible) has no displacement
    /// form in plane strain.
    pub(super) fn poisson_range(self) -> &'static str {
        match self {
            Plane::Stress => "-1 < nu <= 1/2",
            Plane::Strain => "-1 < nu < 1/2",
        }
    }
}
