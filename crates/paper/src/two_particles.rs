//! The structure of Fig. 1 as a mechanical system with four degrees of freedom.

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
    let TwoParticles {
        c,
        s,
        k,
        m,
        mu,
        signs,
    } = data;
    let (p, one) = (c * c + Rational::one(), Rational::one());
    let n = s * s + &one;
    let cs = c * s;
    let rows = [
        (0, 0, p.clone()),
        (0, 1, -&cs),
        (0, 2, -&one),
        (1, 1, n.clone()),
        (2, 2, p),
        (2, 3, cs),
        (3, 3, n),
    ];
    let mirrored = rows.into_iter().flat_map(|(i, j, v)| {
        let mirror = (i != j).then(|| (j, i, k * &v));
        [(i, j, k * v)].into_iter().chain(mirror)
    });
    let stiffness = Sparse::from_entries(4, 4, mirrored);
    let mass = Sparse::zeros(4, 4).add_scaled(m, &Sparse::identity(4));
    let particle =
        |i: usize, sign: i8| Particle::plain(2 * i, 2 * i + 1, ContactState::Slip { sign });
    System::new(
        stiffness,
        Some(mass),
        Some(mu.clone()),
        vec![particle(0, signs.0), particle(1, signs.1)],
    )
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
        .map(|(c, s, h)| (whole(c) / whole(h), whole(s) / whole(h)))
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
            let data = TwoParticles {
                c: rational(3, 5),
                s: rational(4, 5),
                k: whole(7),
                m: whole(2),
                mu: whole(3),
                signs,
            };
            let problem = Problem::new(
                Body::System(two_particles(&data).unwrap()),
                Unknown::Lambda2,
                Window::all(),
            )
            .unwrap();
            let pencil = reduce(&problem).unwrap().pencil;
            let (p, q) = (rational(34, 25), rational(36, 25));
            let (s1, s2) = (whole(signs.0.into()), whole(signs.1.into()));
            assert_eq!(pencil.a().get(0, 0), whole(7) * (&p - &q * &s1));
            assert_eq!(pencil.a().get(1, 1), whole(7) * (&p + &q * &s2));
            assert_eq!(pencil.a().get(0, 1), -whole(7) * &s1 * &s2);
            assert_eq!(
                *pencil.b(),
                Sparse::zeros(2, 2).add_scaled(&whole(2), &Sparse::identity(2))
            );
        }
    }

    #[test]
    fn angles_lie_on_the_unit_circle() {
        assert!(
            pythagorean_angles()
                .iter()
                .all(|(c, s)| c * c + s * s == Rational::one())
        );
    }
}
