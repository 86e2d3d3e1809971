//! The linear (P1) triangle: exact stiffness and mass in plane stress and plane strain.

use super::error::SourceError;
use super::plane::Plane;
use mceip_exact::{Rational, rational, whole};
use num_traits::{One, Signed};

/// A linearly elastic isotropic material, with the body's thickness.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Material {
    /// Modulus of elasticity E, N/mm^2.
    pub young: Rational,
    /// Poisson's ratio nu.
    pub poisson: Rational,
    /// Thickness, mm.
    pub thickness: Rational,
    /// Density, t/mm^3 (so that N, mm, s, t are consistent).
    pub density: Rational,
}

impl Material {
    /// The polyurethane of section 5: E = 5 MPa, nu = 0.48, 9.6 mm thick, 1.2 kg/dm^3.
    pub fn polyurethane() -> Self {
        Material {
            young: whole(5),
            poisson: rational(12, 25),
            thickness: rational(48, 5),
            density: rational(12, 10_000_000_000),
        }
    }

    /// Refuses what no elastic body is: E, thickness or density not positive, nu out of range.
    ///
    /// # Errors
    /// [`SourceError::NotPositive`], [`SourceError::Poisson`].
    pub fn validate(&self, plane: Plane) -> Result<(), SourceError> {
        for (what, value) in [
            ("E (N/mm^2)", &self.young),
            ("the thickness (mm)", &self.thickness),
            ("the density (t/mm^3)", &self.density),
        ] {
            if !value.is_positive() {
                return Err(SourceError::NotPositive {
                    what,
                    got: value.clone(),
                });
            }
        }
        let (nu, half) = (&self.poisson, rational(1, 2));
        let fits = *nu > whole(-1) && (*nu < half || (plane == Plane::Stress && *nu == half));
        if fits {
            Ok(())
        } else {
            Err(SourceError::Poisson {
                plane,
                got: nu.clone(),
            })
        }
    }

    /// D11 = D22, D12 and D33 of Hooke's law in the plane, N/mm^2.
    pub(super) fn elasticity(&self, plane: Plane) -> [Rational; 3] {
        let one = Rational::one();
        let nu = &self.poisson;
        let shear = &self.young / (whole(2) * (&one + nu));
        match plane {
            Plane::Stress => {
                let factor = &self.young / (&one - nu * nu);
                [factor.clone(), factor * nu, shear]
            }
            Plane::Strain => {
                let factor = &self.young / ((&one + nu) * (&one - whole(2) * nu));
                [&factor * (&one - nu), factor * nu, shear]
            }
        }
    }
}

/// How mass is distributed to the nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MassKind {
    /// rho t A / 12 (1 + delta_ab): the integral of the shape functions' products.
    Consistent,
    /// rho t A / 3 at each node: diagonal.
    Lumped,
}

/// A point of the plane, mm.
pub type Point = (Rational, Rational);

/// Twice the signed area of a triangle, mm^2.
pub(super) fn twice_area(p: &[Point; 3]) -> Rational {
    (&p[1].0 - &p[0].0) * (&p[2].1 - &p[0].1) - (&p[2].0 - &p[0].0) * (&p[1].1 - &p[0].1)
}

/// Element stiffness, 6 x 6 in (u_x, u_y) per vertex, N/mm: t A B'DB with constant strain.
pub(super) fn stiffness(p: &[Point; 3], material: &Material, plane: Plane) -> Vec<Vec<Rational>> {
    let [d11, d12, d33] = material.elasticity(plane);
    let scale = &material.thickness / (whole(2) * twice_area(p)); // t / 4A
    let b: Vec<Rational> = (0..3)
        .map(|a| &p[(a + 1) % 3].1 - &p[(a + 2) % 3].1)
        .collect();
    let c: Vec<Rational> = (0..3)
        .map(|a| &p[(a + 2) % 3].0 - &p[(a + 1) % 3].0)
        .collect();
    let entry = |i: usize, j: usize| {
        let (a, e) = (i / 2, j / 2);
        let value = match (i % 2, j % 2) {
            (0, 0) => &d11 * &b[a] * &b[e] + &d33 * &c[a] * &c[e],
            (0, 1) => &d12 * &b[a] * &c[e] + &d33 * &c[a] * &b[e],
            (1, 0) => &d12 * &c[a] * &b[e] + &d33 * &b[a] * &c[e],
            _ => &d11 * &c[a] * &c[e] + &d33 * &b[a] * &b[e],
        };
        value * &scale
    };
    (0..6)
        .map(|i| (0..6).map(|j| entry(i, j)).collect())
        .collect()
}

/// Mass coupling of vertices a and b in each direction, t.
pub(super) fn mass(
    p: &[Point; 3],
    material: &Material,
    kind: MassKind,
    a: usize,
    b: usize,
) -> Rational {
    let total = &material.density * &material.thickness * twice_area(p) / whole(2);
    match (kind, a == b) {
        (MassKind::Consistent, true) => total / whole(6),
        (MassKind::Consistent, false) => total / whole(12),
        (MassKind::Lumped, true) => total / whole(3),
        (MassKind::Lumped, false) => whole(0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> [Point; 3] {
        [
            (whole(0), whole(0)),
            (whole(4), whole(0)),
            (whole(1), whole(3)),
        ]
    }

    #[test]
    fn reference_triangle_by_hand() {
        // E = 1, nu = 0, t = 1 on (0,0), (1,0), (0,1): D = diag(1, 1, 1/2), A = 1/2.
        let unit = Material {
            young: whole(1),
            poisson: whole(0),
            thickness: whole(1),
            density: whole(1),
        };
        let k = stiffness(
            &[
                (whole(0), whole(0)),
                (whole(1), whole(0)),
                (whole(0), whole(1)),
            ],
            &unit,
            Plane::Stress,
        );
        assert_eq!(
            (k[0][0].clone(), k[0][1].clone()),
            (rational(3, 4), rational(1, 4))
        );
        assert_eq!(
            (k[2][2].clone(), k[2][3].clone(), k[3][3].clone()),
            (rational(1, 2), whole(0), rational(1, 4))
        );
        assert_eq!(k[1][2], whole(0)); // D12 c_1 b_2 + D33 b_1 c_2 = 0 + (1/2)(-1)(0)
        assert_eq!(k[0][5], whole(0));
    }

    #[test]
    fn symmetric_and_blind_to_rigid_motions() {
        for plane in Plane::ALL {
            blind_to_rigid_motions(plane);
        }
    }

    fn blind_to_rigid_motions(plane: Plane) {
        let (p, m) = (triangle(), Material::polyurethane());
        let k = stiffness(&p, &m, plane);
        let rotation: Vec<Rational> = p.iter().flat_map(|(x, y)| [-y, x.clone()]).collect();
        let along_x: Vec<Rational> = (0..6).map(|i| whole(i64::from(i % 2 == 0))).collect();
        for i in 0..6 {
            for j in 0..6 {
                assert_eq!(k[i][j], k[j][i]);
            }
            for motion in [&rotation, &along_x] {
                let force: Rational = k[i].iter().zip(motion).map(|(a, b)| a * b).sum();
                assert_eq!(force, whole(0));
            }
        }
        let stretch: Vec<Rational> = p.iter().flat_map(|(x, _)| [x.clone(), whole(0)]).collect();
        assert_ne!(
            k[0].iter()
                .zip(&stretch)
                .map(|(a, b)| a * b)
                .sum::<Rational>(),
            whole(0)
        );
    }

    #[test]
    fn mass_adds_up_either_way() {
        let (p, m) = (triangle(), Material::polyurethane());
        let total = &m.density * &m.thickness * whole(6);
        for kind in [MassKind::Consistent, MassKind::Lumped] {
            let sum: Rational = (0..9).map(|k| mass(&p, &m, kind, k / 3, k % 3)).sum();
            assert_eq!(sum, total);
        }
    }

    /// Uniaxial stress sigma_x = E in plane stress: strains (1, -nu), D11 - nu D12 = E. In plane
    /// strain with eps_y = -nu/(1-nu): sigma_x = E/(1-nu^2), sigma_y = 0.
    #[test]
    fn uniaxial_stress_in_both_planes() {
        let m = Material::polyurethane();
        let nu = &m.poisson;
        let one = whole(1);
        let [d11, d12, d33] = m.elasticity(Plane::Stress);
        assert_eq!(
            (&d11 - nu * &d12, &d12 - nu * &d11),
            (m.young.clone(), whole(0))
        );
        let [e11, e12, e33] = m.elasticity(Plane::Strain);
        let lateral = nu / (&one - nu);
        assert_eq!(
            (&e11 - &lateral * &e12, &e12 - &lateral * &e11),
            (&m.young / (&one - nu * nu), whole(0))
        );
        assert_eq!(
            (d33.clone(), d33),
            (e33, &m.young / (whole(2) * (one + nu)))
        );
    }

    #[test]
    fn materials_that_do_not_exist_are_refused() {
        let with = |poisson: Rational| Material {
            poisson,
            ..Material::polyurethane()
        };
        let half = rational(1, 2);
        assert_eq!(with(half.clone()).validate(Plane::Stress), Ok(()));
        assert_eq!(
            with(half.clone()).validate(Plane::Strain),
            Err(SourceError::Poisson {
                plane: Plane::Strain,
                got: half
            })
        );
        assert_eq!(with(rational(-99, 100)).validate(Plane::Strain), Ok(()));
        assert!(matches!(
            with(whole(-1)).validate(Plane::Stress),
            Err(SourceError::Poisson { .. })
        ));
        assert!(matches!(
            with(rational(51, 100)).validate(Plane::Stress),
            Err(SourceError::Poisson { .. })
        ));
        let weightless = Material {
            density: whole(0),
            ..Material::polyurethane()
        };
        assert!(matches!(
            weightless.validate(Plane::Stress),
            Err(SourceError::NotPositive {
                what: "the density (t/mm^3)",
                ..
            })
        ));
    }
}
