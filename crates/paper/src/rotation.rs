//! Rational rotations: the directions of an oblique obstacle, given as an angle or in doubles.
//!
//! A problem file wants the frame of a particle as an exact rotation
//!
//! ```text
//! [ c  s]        c = (1 - q^2) / (1 + q^2),   s = 2 q / (1 + q^2),   q = tan(angle / 2)
//! [-s  c]
//! ```
//!
//! which is rational if q is. An engineer has degrees, a normal or a matrix of doubles. Here q is
//! the fraction of least denominator near enough, so that 0.6 and 0.8 become 3/5 and 4/5. The
//! rotation is exact; which one it is, doubles decide.
#![allow(clippy::float_arithmetic)]

use crate::tolerance::{HALF_TANGENT, ROUNDED_FRAME};
use mceip_exact::{Rational, from_f64, rational, simplest_between, to_f64, whole};
use mceip_model::Particle;
use num_traits::One;

/// Rows: the directions of the tangent and of the normal in those of the two dofs.
pub type Frame = [[Rational; 2]; 2];

/// The rotation whose tangent has the direction (x, y); none if that is no direction.
///
/// Its angle differs from that of (x, y) by at most 3e-12.
pub(crate) fn rotation_along(x: f64, y: f64) -> Option<Frame> {
    let length = x.hypot(y);
    if !length.is_normal() {
        return None;
    }

    // Half a turn takes the left half plane to the right one, where |q| <= 1.
    let is_left = x < 0.0;
    let side = if is_left { -1.0 } else { 1.0 };
    let cosine = side * x / length;
    let sine = side * y / length;
    let half_tangent = from_f64(sine / (1.0 + cosine)).ok()?;

    let (numerator, denominator) = HALF_TANGENT;
    let slack = rational(numerator, denominator);
    let q = simplest_between(&(&half_tangent - &slack), &(&half_tangent + &slack));

    let one = Rational::one();
    let square = &q * &q;
    let back = whole(if is_left { -1 } else { 1 });
    let scale = back / (&one + &square);
    let c = (&one - &square) * &scale;
    let s = whole(2) * &q * &scale;

    let minus_s = -&s;
    Some([[c.clone(), s], [minus_s, c]])
}

/// The rotation by an angle in degrees, counterclockwise; none if it is not finite.
pub(crate) fn rotation_by_degrees(angle: f64) -> Option<Frame> {
    let radians = angle.to_radians();
    rotation_along(radians.cos(), radians.sin())
}

/// The angle of a frame in degrees, in (-180, 180].
pub fn angle_in_degrees(frame: &Frame) -> f64 {
    let [c, s] = &frame[0];
    to_f64(s).atan2(to_f64(c)).to_degrees()
}

/// Puts a rational rotation in the place of each frame that is a rotation within the rounding of
/// doubles, and not exactly. Others stay as they are.
pub fn make_frames_exact(particles: &mut [Particle]) {
    for particle in particles {
        if let Some(frame) = &particle.frame
            && !is_rotation(frame)
            && let Some(exact) = nearby_rotation(frame)
        {
            particle.frame = Some(exact);
        }
    }
}

fn is_rotation([[a, b], [c, d]]: &Frame) -> bool {
    let numbers = [a * a + b * b, c * c + d * d, a * d - b * c];
    numbers.iter().all(One::is_one)
}

/// The rotation along the first row of a frame that is one within the rounding of doubles.
fn nearby_rotation(frame: &Frame) -> Option<Frame> {
    let [[a, b], [c, d]] = frame;
    let [a, b, c, d] = [a, b, c, d].map(to_f64);

    let deviations = [
        a * a + b * b - 1.0,
        c * c + d * d - 1.0,
        a * d - b * c - 1.0,
    ];
    let is_near = deviations.iter().all(|e| e.abs() <= ROUNDED_FRAME);
    if is_near { rotation_along(a, b) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_model::ContactState;

    #[test]
    fn quarter_turns_and_pythagorean_directions_are_exact() {
        for (degrees, [c, s]) in [
            (0.0, [1, 0]),
            (90.0, [0, 1]),
            (180.0, [-1, 0]),
            (-90.0, [0, -1]),
        ] {
            let frame = rotation_by_degrees(degrees).unwrap();
            assert_eq!(frame[0], [whole(c), whole(s)], "{degrees}");
        }

        let frame = rotation_along(-0.6, 0.8).unwrap();
        assert_eq!(frame[0], [rational(-3, 5), rational(4, 5)]);
        assert_eq!(frame[1], [rational(-4, 5), rational(-3, 5)]);
    }

    #[test]
    fn every_angle_has_a_rotation_within_the_slack() {
        for tenth in -1799..=1800 {
            let degrees = f64::from(tenth) / 10.0;
            let frame = rotation_by_degrees(degrees).unwrap();

            assert!(is_rotation(&frame), "{degrees}");
            let error = (angle_in_degrees(&frame) - degrees).to_radians();
            assert!(error.abs() < 3e-12, "{degrees}: {error:e}");
        }
    }

    #[test]
    fn what_is_no_direction_has_no_rotation() {
        assert_eq!(rotation_along(0.0, 0.0), None);
        assert_eq!(rotation_along(f64::NAN, 1.0), None);
        assert_eq!(rotation_by_degrees(f64::INFINITY), None);
    }

    /// A frame in doubles is made exact; one that is no rotation is left for the reader to refuse.
    #[test]
    fn frames_in_doubles_are_made_exact() {
        let with = |rows: [[f64; 2]; 2]| Particle {
            frame: Some(rows.map(|row| row.map(|v| from_f64(v).unwrap()))),
            ..Particle::plain(0, 1, ContactState::Stick)
        };
        let (s, c) = 0.5_f64.sin_cos();
        let stretched = [[c, s], [-s, c * (1.0 + 1e-6)]];
        let mirrored = [[c, s], [s, -c]];
        let mut particles = [
            with([[c, s], [-s, c]]),
            with(stretched),
            with(mirrored),
            Particle::plain(0, 1, ContactState::Stick),
        ];
        let before = particles.clone();

        make_frames_exact(&mut particles);

        let frame = particles[0].frame.as_ref().unwrap();
        assert!(is_rotation(frame));
        assert!((to_f64(&frame[0][1]) - s).abs() < 3e-12);
        assert_eq!(particles[1..], before[1..]);
    }

    /// An exact rotation is not exchanged for a simpler one near by: here q = 1/3 + 1e-15.
    #[test]
    fn exact_frames_stay() {
        let q = rational(1, 3) + rational(1, 1_000_000_000_000_000);
        let one = whole(1);
        let scale = (&one + &q * &q).recip();
        let c = (&one - &q * &q) * &scale;
        let s = whole(2) * &q * &scale;
        let exact = Particle {
            frame: Some([[c.clone(), s.clone()], [-s, c]]),
            ..Particle::plain(0, 1, ContactState::Stick)
        };
        let mut particles = [exact.clone()];

        make_frames_exact(&mut particles);

        assert_eq!(particles, [exact]);
    }
}
