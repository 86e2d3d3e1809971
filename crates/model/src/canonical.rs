//! The canonical form of a problem, and of a body under loads, and its digest.
//!
//! Mathematical fields only, matrices inlined, entries sorted, rationals in lowest terms; no name,
//! comment, warning or window, and no reaction (it is checked when read, and changes nothing after
//! that).
//!
//! The digest is SHA-256 (FIPS 180-4) of that text. Two problems with one digest are, for all that
//! anybody can do, the same mathematical problem; so a certificate that names the digest is bound
//! to its matrices. `spec/formats.md` specifies the text, so that other programs can write it.

use super::{
    Body, ContactState, Direction, LoadedBody, Particle, Pencil, Problem, QuadraticPencil, Radii,
    System,
};
use mceip_exact::Sparse;
use num_traits::{One as _, Zero as _};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;

/// The canonical text: one fact per line, as `spec/formats.md` lists them.
pub(super) fn text(problem: &Problem) -> String {
    let mut out = String::new();
    line(&mut out, "mceip-canonical/1");
    line(&mut out, &format!("unknown {}", problem.unknown().word()));

    match problem.body() {
        Body::Pencil(pencil) => write_pencil(&mut out, pencil),
        Body::Quadratic(quadratic) => write_quadratic(&mut out, quadratic),
        Body::System(system) => write_system(&mut out, system),
    }

    out
}

/// The canonical text of a body under loads: the system without its held dofs and without mu, all
/// candidates stuck, then their gaps and the loads. Names, and what the loads are called, play no
/// part; mu is stated with what is proved of the body.
pub(super) fn loads_text(body: &LoadedBody) -> String {
    let mut out = String::new();
    line(&mut out, "mceip-canonical-loads/1");
    write_body(&mut out, body.system());

    for gap in body.gaps() {
        line(&mut out, &format!("gap {gap}"));
    }
    for load in body.loads() {
        line(&mut out, "load");
        for (dof, value) in load.iter().enumerate() {
            if !value.is_zero() {
                line(&mut out, &format!("{dof} {value}"));
            }
        }
    }

    out
}

/// SHA-256 of a text in lower-case hexadecimal.
pub fn sha256(text: &str) -> String {
    let digest = Sha256::digest(text.as_bytes());

    let mut hexadecimal = String::with_capacity(64);

    for byte in digest.iter() {
        let _ = write!(hexadecimal, "{byte:02x}"); // writing to a String cannot fail
    }

    hexadecimal
}

fn write_pencil(out: &mut String, pencil: &Pencil) {
    line(out, "pencil");

    let mut free = String::from("free");
    for index in pencil.free() {
        let _ = write!(free, " {index}"); // writing to a String cannot fail
    }

    line(out, &free);

    write_matrix(out, "a", pencil.a());
    write_matrix(out, "b", pencil.b());
}

fn write_quadratic(out: &mut String, quadratic: &QuadraticPencil) {
    line(out, "pencil");
    line(out, "free");
    for (name, matrix) in ["a", "b", "c"].into_iter().zip(quadratic.coefficients()) {
        write_matrix(out, name, matrix);
    }
}

fn write_system(out: &mut String, system: &System) {
    line(out, "system");
    if let Some(mu) = system.friction() {
        line(out, &format!("friction {mu}"));
    }

    write_body(out, system);
}

/// All of a system but mu.
fn write_body(out: &mut String, system: &System) {
    for particle in system.particles() {
        write_particle(out, particle);
    }

    write_matrix(out, "stiffness", system.stiffness());
    if let Some(mass) = system.mass() {
        write_matrix(out, "mass", mass);
    }

    let Radii { stiffness, mass } = system.radii();
    if let Some(radius) = stiffness {
        write_matrix(out, "stiffness_radius", radius);
    }
    if let Some(radius) = mass {
        write_matrix(out, "mass_radius", radius);
    }
}

fn write_particle(out: &mut String, particle: &Particle) {
    let sign = match particle.state {
        ContactState::Slip { sign } => format!(" {sign}"),
        ContactState::Free | ContactState::Stick | ContactState::Zero => String::new(),
    };

    let Particle {
        tangential,
        normal,
        state,
        // These two are in the directions below.
        normal_direction: _,
        frame: _,
        friction_factor,
        friction_factor_range,
        // It counts by the geometric stiffness below.
        curvature: _,
        // These two are no part of the question.
        reaction: _,
        name: _,
    } = particle;
    let state = state.word();
    line(
        out,
        &format!("particle {tangential} {normal} {state}{sign}"),
    );

    write_direction(out, "tangent", &particle.tangent());
    write_direction(out, "normal", &particle.into_obstacle());

    // The factor 1 is not written: a problem without factors has the text it always had.
    if !friction_factor.is_one() {
        line(out, &format!("friction_factor {friction_factor}"));
    }
    if let Some([lo, hi]) = friction_factor_range {
        line(out, &format!("friction_factor_range {lo} {hi}"));
    }

    let geometric_stiffness = particle.geometric_stiffness();
    if !geometric_stiffness.is_zero() {
        line(out, &format!("geometric_stiffness {geometric_stiffness}"));
    }
}

fn write_direction(out: &mut String, name: &str, direction: &Direction) {
    let mut text = String::from(name);
    for (dof, coefficient) in direction {
        let _ = write!(text, " {dof} {coefficient}"); // writing to a String cannot fail
    }
    line(out, &text);
}

fn write_matrix(out: &mut String, name: &str, m: &Sparse) {
    line(out, &format!("{name} {} {}", m.rows(), m.cols()));
    for (i, j, entry) in m.entries() {
        let _ = writeln!(out, "{i} {j} {entry}"); // writing to a String cannot fail
    }
}

fn line(out: &mut String, text: &str) {
    out.push_str(text);
    out.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Unknown, Window};
    use mceip_exact::{rational, whole};

    fn problem(v: mceip_exact::Rational, unknown: Unknown) -> Problem {
        let a = Sparse::from_entries(1, 1, [(0, 0, v)]);
        let pencil = Pencil::new(a, Sparse::identity(1), vec![]).unwrap();
        Problem::new(Body::Pencil(pencil), unknown, Window::all()).unwrap()
    }

    #[test]
    fn a_system_is_spelt_out_with_its_directions() {
        let frame = Some([
            [rational(3, 5), rational(4, 5)],
            [rational(-4, 5), rational(3, 5)],
        ]);
        let slip = Particle {
            frame,
            normal_direction: -1,
            ..Particle::plain(0, 1, ContactState::Slip { sign: -1 })
        };

        let particles = vec![slip, Particle::plain(3, 2, ContactState::Stick)];
        let system =
            System::new(Sparse::identity(4), None, Some(rational(1, 2)), particles).unwrap();
        let p = Problem::new(Body::System(system), Unknown::Mu, Window::all()).unwrap();
        let head = "mceip-canonical/1\nunknown mu\nsystem\nfriction 1/2\n\
                    particle 0 1 slip -1\ntangent 0 3/5 1 4/5\nnormal 0 4/5 1 -3/5\n\
                    particle 3 2 stick\ntangent 3 1\nnormal 2 1\nstiffness 4 4\n0 0 1\n";
        assert!(text(&p).starts_with(head), "{}", text(&p));
    }

    #[test]
    fn digest_binds_the_mathematics_and_nothing_else() {
        let p = problem(rational(-1, 2), Unknown::Lambda2);
        assert_eq!(
            text(&p),
            "mceip-canonical/1\nunknown lambda2\npencil\nfree\na 1 1\n0 0 -1/2\nb 1 1\n0 0 1\n"
        );

        assert_eq!(p.canonical_text(), text(&p));
        let narrower = p
            .clone()
            .named("x")
            .with_window(Window::new(whole(1), None).unwrap());
        assert_eq!(p.sha256(), narrower.sha256());
        assert_ne!(
            p.sha256(),
            problem(rational(-1, 3), Unknown::Lambda2).sha256()
        );

        assert_ne!(p.sha256(), problem(rational(-1, 2), Unknown::Mu).sha256());
    }
}
