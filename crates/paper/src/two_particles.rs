//! The structure of Fig. 1 as a mechanical system with four degrees of freedom.
//!
//! Two particles of mass m rest on an obstacle and hang on five springs of stiffness k: for each an
//! inclined one (angle phi, c = cos phi, s = sin phi) and a vertical one, and one between them. The
//! same data give the solutions in closed form (Table 1, `mceip_oracle`), so this is the example on
//! which tests compare solver, search and oracle. Chapter 7 of the book, 7.1.

use mceip_exact::{Rational, Sparse, whole};
use mceip_model::{ContactState, ModelError, Particle, System};
use mceip_oracle::TwoParticles;
use num_traits::One;

/// M = m I and K as printed in section 5, u = (u_T1, u_N1, u_T2, u_N2), both particles in
/// impending slip with reaction signs S1, S2.
///
/// # Errors
/// [`ModelError`] for data outside the hypotheses (mass or friction not positive).
pub fn two_particles(data: &TwoParticles) -> Result<System, ModelError> {
    let TwoParticles { c, s, k, mu, .. } = data;
    let one = Rational::one();
    let tangential = c * c + &one;
    let normal = s * s + &one;
    let coupling = c * s;

    // K / k, the upper triangle.
    let upper = [
        (0, 0, tangential.clone()),
        (0, 1, -&coupling),
        (0, 2, -one),
        (1, 1, normal.clone()),
        (2, 2, tangential),
        (2, 3, coupling),
        (3, 3, normal),
    ];
    let mut entries = Vec::new();
    for (row, column, value) in upper {
        let value = k * value;
        if row != column {
            entries.push((column, row, value.clone()));
        }

        entries.push((row, column, value));
    }

    let stiffness = Sparse::from_entries(4, 4, entries);
    let mass = Sparse::zeros(4, 4).add_scaled(&data.m, &Sparse::identity(4));
    let particles = vec![
        slip_particle(0, data.signs.0),
        slip_particle(1, data.signs.1),
    ];
    System::new(stiffness, Some(mass), Some(mu.clone()), particles)
}

/// Particle `number` (0 or 1) in impending slip.
fn slip_particle(number: usize, sign: i8) -> Particle {
    let tangential = 2 * number;
    let normal = 2 * number + 1;
    Particle::plain(tangential, normal, ContactState::Slip { sign })
}

/// The rational points (cos, sin) used for grids: Pythagorean triples and the two axes.
pub fn pythagorean_angles() -> Vec<(Rational, Rational)> {
    let triples = [
        (3, 4, 5),
        (4, 3, 5),
        (5, 12, 13),
        (12, 5, 13),
        (8, 15, 17),
        (20, 21, 29),
        (0, 1, 1),
        (1, 0, 1),
    ];
    triples
        .map(|(adjacent, opposite, hypotenuse)| {
            let cosine = whole(adjacent) / whole(hypotenuse);
            let sine = whole(opposite) / whole(hypotenuse);
            (cosine, sine)
        })
        .to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;
    use mceip_model::reduction::reduce;
    use mceip_model::{Body, Problem, Unknown, Window};

    /// The 2x2 matrix printed above Table 1, for all four sign patterns.
    #[test]
    fn reduction_gives_the_printed_pencil() {
        for signs in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
            assert_printed_pencil(signs);
        }
    }

    fn assert_printed_pencil(signs: (i8, i8)) {
        let data = TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(7),
            m: whole(2),
            mu: whole(3),
            signs,
        };
        let system = Body::System(two_particles(&data).unwrap());
        let problem = Problem::new(system, Unknown::Lambda2, Window::all()).unwrap();

        let pencil = reduce(&problem).unwrap().pencil;

        let c2_plus_1 = rational(34, 25);
        let mu_c_s = rational(36, 25);
        let s1 = whole(signs.0.into());
        let s2 = whole(signs.1.into());
        let a = pencil.a();
        assert_eq!(a.get(0, 0), whole(7) * (&c2_plus_1 - &mu_c_s * &s1));
        assert_eq!(a.get(1, 1), whole(7) * (&c2_plus_1 + &mu_c_s * &s2));
        assert_eq!(a.get(0, 1), -whole(7) * &s1 * &s2);
        let twice_identity = Sparse::zeros(2, 2).add_scaled(&whole(2), &Sparse::identity(2));
        assert_eq!(*pencil.b(), twice_identity);
    }

    #[test]
    fn angles_lie_on_the_unit_circle() {
        for (cosine, sine) in pythagorean_angles() {
            assert_eq!(&cosine * &cosine + &sine * &sine, Rational::one());
        }
    }
}
