//! The linear (P1) triangle: exact stiffness and mass in plane stress and plane strain.
//!
//! The three shape functions N_a are linear, so strains are constant: B_a = [N_a,x 0; 0 N_a,y;
//! N_a,y N_a,x] for each vertex, stiffness t A B'DB with D of Hooke's law, mass the integral of
//! rho t N_a N_b. Vertices counter-clockwise and a valid material go in. `block` adds the elements
//! up; `doubles` repeats the work in doubles and shares only the material.

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
        let positive = [
            ("E (N/mm^2)", &self.young),
            ("the thickness (mm)", &self.thickness),
            ("the density (t/mm^3)", &self.density),
        ];
        for (what, value) in positive {
            if !value.is_positive() {
                return Err(SourceError::NotPositive {
                    what,
                    got: value.clone(),
                });
            }
        }

        if self.poisson_fits(plane) {
            Ok(())
        } else {
            Err(SourceError::Poisson {
                plane,
                got: self.poisson.clone(),
            })
        }
    }

    /// -1 < nu < 1/2; nu = 1/2 in plane stress only.
    fn poisson_fits(&self, plane: Plane) -> bool {
        let nu = &self.poisson;
        let half = rational(1, 2);
        let compressible = *nu < half;
        let incompressible_in_stress = *nu == half && plane == Plane::Stress;
        *nu > whole(-1) && (compressible || incompressible_in_stress)
    }

    /// Hooke's law in the plane.
    pub(super) fn elasticity(&self, plane: Plane) -> Elasticity {
        let one = Rational::one();
        let nu = &self.poisson;
        let shear = &self.young / (whole(2) * (&one + nu));

        match plane {
            Plane::Stress => {
                let factor = &self.young / (&one - nu * nu);
                Elasticity {
                    d11: factor.clone(),
                    d12: factor * nu,
                    d33: shear,
                }
            }
            Plane::Strain => {
                let factor = &self.young / ((&one + nu) * (&one - whole(2) * nu));
                Elasticity {
                    d11: &factor * (&one - nu),
                    d12: factor * nu,
                    d33: shear,
                }
            }
        }
    }
}

/// The matrix D of Hooke's law in the plane, N/mm^2: D22 = D11, D21 = D12, the others are zero.
pub(super) struct Elasticity {
    pub(super) d11: Rational,
    pub(super) d12: Rational,
    pub(super) d33: Rational,
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
pub type PlanePoint = (Rational, Rational);

/// Twice the signed area of a triangle, mm^2.
pub(super) fn twice_area(p: &[PlanePoint; 3]) -> Rational {
    let [(x0, y0), (x1, y1), (x2, y2)] = p;
    let first_edge = (x1 - x0, y1 - y0);
    let second_edge = (x2 - x0, y2 - y0);
    &first_edge.0 * &second_edge.1 - &second_edge.0 * &first_edge.1
}

/// Element stiffness, 6 x 6 in (u_x, u_y) per vertex, N/mm: t A B'DB with constant strain.
pub(super) fn stiffness(
    p: &[PlanePoint; 3],
    material: &Material,
    plane: Plane,
) -> Vec<Vec<Rational>> {
    let elasticity = material.elasticity(plane);
    let gradients = Gradients::of(p);
    let scale = &material.thickness / (whole(2) * twice_area(p)); // t / 4A

    let mut matrix = vec![vec![whole(0); 6]; 6];
    for a in 0..3 {
        for b in 0..3 {
            let block = gradients.block(a, b, &elasticity);
            for (i, row) in block.iter().enumerate() {
                for (j, value) in row.iter().enumerate() {
                    matrix[2 * a + i][2 * b + j] = value * &scale;
                }
            }
        }
    }

    matrix
}

/// 2A times the derivatives of the three shape functions, mm.
struct Gradients {
    /// By x: y of the next vertex less y of the one after.
    x: [Rational; 3],
    /// By y: x of the vertex after the next less x of the next.
    y: [Rational; 3],
}

impl Gradients {
    fn of(p: &[PlanePoint; 3]) -> Gradients {
        let [(x0, y0), (x1, y1), (x2, y2)] = p;
        Gradients {
            x: [y1 - y2, y2 - y0, y0 - y1],
            y: [x2 - x1, x0 - x2, x1 - x0],
        }
    }

    /// 4 A^2 B_a' D B_b: rows are the force at vertex a in x and y, columns the displacement of
    /// vertex b. B_a maps the displacement to the strains: [N_x, 0; 0, N_y; N_y, N_x].
    fn block(&self, a: usize, b: usize, elasticity: &Elasticity) -> [[Rational; 2]; 2] {
        let Elasticity { d11, d12, d33 } = elasticity;
        let xx = &self.x[a] * &self.x[b];
        let xy = &self.x[a] * &self.y[b];
        let yx = &self.y[a] * &self.x[b];
        let yy = &self.y[a] * &self.y[b];
        [
            [d11 * &xx + d33 * &yy, d12 * &xy + d33 * &yx],
            [d12 * &yx + d33 * &xy, d11 * &yy + d33 * &xx],
        ]
    }
}

/// Mass coupling of vertices a and b in each direction, t.
pub(super) fn mass(
    p: &[PlanePoint; 3],
    material: &Material,
    kind: MassKind,
    a: usize,
    b: usize,
) -> Rational {
    let area = twice_area(p) / whole(2);
    let total = &material.density * &material.thickness * area;
    match kind {
        MassKind::Consistent if a == b => total / whole(6),
        MassKind::Consistent => total / whole(12),
        MassKind::Lumped if a == b => total / whole(3),
        MassKind::Lumped => whole(0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> [PlanePoint; 3] {
        [
            (whole(0), whole(0)),
            (whole(4), whole(0)),
            (whole(1), whole(3)),
        ]
    }

    fn dot(row: &[Rational], vector: &[Rational]) -> Rational {
        row.iter().zip(vector).map(|(a, b)| a * b).sum()
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
        let reference = [
            (whole(0), whole(0)),
            (whole(1), whole(0)),
            (whole(0), whole(1)),
        ];

        let k = stiffness(&reference, &unit, Plane::Stress);

        assert_eq!(k[0][0], rational(3, 4));
        assert_eq!(k[0][1], rational(1, 4));
        assert_eq!(k[2][2], rational(1, 2));
        assert_eq!(k[2][3], whole(0));
        assert_eq!(k[3][3], rational(1, 4));
        assert_eq!(k[1][2], whole(0)); // D12 N_1y N_2x + D33 N_1x N_2y = 0 + (1/2)(-1)(0)
        assert_eq!(k[0][5], whole(0));
    }

    #[test]
    fn symmetric_and_blind_to_rigid_motions() {
        for plane in Plane::ALL {
            blind_to_rigid_motions(plane);
        }
    }

    fn blind_to_rigid_motions(plane: Plane) {
        let points = triangle();
        let k = stiffness(&points, &Material::polyurethane(), plane);

        let mut rotation = Vec::new();
        let mut along_x = Vec::new();
        let mut stretch = Vec::new();
        for (x, y) in &points {
            rotation.extend([-y, x.clone()]);
            along_x.extend([whole(1), whole(0)]);
            stretch.extend([x.clone(), whole(0)]);
        }

        for i in 0..6 {
            for j in 0..6 {
                assert_eq!(k[i][j], k[j][i]);
            }
            assert_eq!(dot(&k[i], &rotation), whole(0));
            assert_eq!(dot(&k[i], &along_x), whole(0));
        }
        assert_ne!(dot(&k[0], &stretch), whole(0));
    }

    #[test]
    fn mass_adds_up_either_way() {
        let points = triangle();
        let material = Material::polyurethane();
        let area = whole(6);
        let total = &material.density * &material.thickness * area;

        for kind in [MassKind::Consistent, MassKind::Lumped] {
            let mut sum = whole(0);
            for a in 0..3 {
                for b in 0..3 {
                    sum += mass(&points, &material, kind, a, b);
                }
            }
            assert_eq!(sum, total);
        }
    }

    /// Uniaxial stress sigma_x = E in plane stress: strains (1, -nu), D11 - nu D12 = E. In plane
    /// strain with eps_y = -nu/(1-nu): sigma_x = E/(1-nu^2), sigma_y = 0.
    #[test]
    fn uniaxial_stress_in_both_planes() {
        let material = Material::polyurethane();
        let young = &material.young;
        let nu = &material.poisson;
        let one = whole(1);

        let stress = material.elasticity(Plane::Stress);
        assert_eq!(&stress.d11 - nu * &stress.d12, *young);
        assert_eq!(&stress.d12 - nu * &stress.d11, whole(0));

        let strain = material.elasticity(Plane::Strain);
        let lateral = nu / (&one - nu);
        assert_eq!(
            &strain.d11 - &lateral * &strain.d12,
            young / (&one - nu * nu)
        );
        assert_eq!(&strain.d12 - &lateral * &strain.d11, whole(0));

        let shear = young / (whole(2) * (one + nu));
        assert_eq!(stress.d33, shear);
        assert_eq!(strain.d33, shear);
    }

    fn with_poisson(poisson: Rational) -> Material {
        Material {
            poisson,
            ..Material::polyurethane()
        }
    }

    #[test]
    fn materials_that_do_not_exist_are_refused() {
        let half = rational(1, 2);
        let incompressible = with_poisson(half.clone());
        assert_eq!(incompressible.validate(Plane::Stress), Ok(()));
        assert_eq!(
            incompressible.validate(Plane::Strain),
            Err(SourceError::Poisson {
                plane: Plane::Strain,
                got: half
            })
        );

        let just_inside = with_poisson(rational(-99, 100));
        assert_eq!(just_inside.validate(Plane::Strain), Ok(()));
        for outside in [whole(-1), rational(51, 100)] {
            assert!(matches!(
                with_poisson(outside).validate(Plane::Stress),
                Err(SourceError::Poisson { .. })
            ));
        }

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
