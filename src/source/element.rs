//! The linear (P1) triangle: exact stiffness and mass in plane stress.

use crate::exact::{Rational, rational, whole};
use num_traits::One;

/// A linearly elastic material in plane stress, with the body's thickness.
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
        Material { young: whole(5), poisson: rational(12, 25), thickness: rational(48, 5), density: rational(12, 10_000_000_000) }
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
pub(super) fn stiffness(p: &[Point; 3], material: &Material) -> Vec<Vec<Rational>> {
    let one = Rational::one();
    let nu = &material.poisson;
    let factor = &material.young / (&one - nu * nu);
    let (d11, d12, d33) = (factor.clone(), &factor * nu, &factor * (&one - nu) / whole(2));
    let scale = &material.thickness / (whole(2) * twice_area(p)); // t / 4A
    let b: Vec<Rational> = (0..3).map(|a| &p[(a + 1) % 3].1 - &p[(a + 2) % 3].1).collect();
    let c: Vec<Rational> = (0..3).map(|a| &p[(a + 2) % 3].0 - &p[(a + 1) % 3].0).collect();
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
    (0..6).map(|i| (0..6).map(|j| entry(i, j)).collect()).collect()
}

/// Mass coupling of vertices a and b in each direction, t.
pub(super) fn mass(p: &[Point; 3], material: &Material, kind: MassKind, a: usize, b: usize) -> Rational {
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
        [(whole(0), whole(0)), (whole(4), whole(0)), (whole(1), whole(3))]
    }

    #[test]
    fn reference_triangle_by_hand() {
        // E = 1, nu = 0, t = 1 on (0,0), (1,0), (0,1): D = diag(1, 1, 1/2), A = 1/2.
        let unit = Material { young: whole(1), poisson: whole(0), thickness: whole(1), density: whole(1) };
        let k = stiffness(&[(whole(0), whole(0)), (whole(1), whole(0)), (whole(0), whole(1))], &unit);
        assert_eq!((k[0][0].clone(), k[0][1].clone()), (rational(3, 4), rational(1, 4)));
        assert_eq!((k[2][2].clone(), k[2][3].clone(), k[3][3].clone()), (rational(1, 2), whole(0), rational(1, 4)));
        assert_eq!(k[1][2], whole(0)); // D12 c_1 b_2 + D33 b_1 c_2 = 0 + (1/2)(-1)(0)
        assert_eq!(k[0][5], whole(0));
    }

    #[test]
    fn symmetric_and_blind_to_rigid_motions() {
        let (p, m) = (triangle(), Material::polyurethane());
        let k = stiffness(&p, &m);
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
        assert_ne!(k[0].iter().zip(&stretch).map(|(a, b)| a * b).sum::<Rational>(), whole(0));
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
}
