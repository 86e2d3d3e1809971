//! The canonical form of a problem and its digest.
//!
//! Mathematical fields only, matrices inlined, entries sorted, rationals in lowest terms; no name,
//! comment or window, and no reaction (it is checked when read, and changes nothing after that).

use super::{Body, ContactState, Problem};
use mceip_exact::Sparse;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;

/// The canonical text: one fact per line, as `spec/formats.md` lists them.
pub(super) fn text(problem: &Problem) -> String {
    let mut out = format!("mceip-canonical/1\nunknown {}\n", problem.unknown().word());
    match problem.body() {
        Body::Pencil(p) => {
            out.push_str("pencil\n");
            let free: Vec<String> = p.free().iter().map(usize::to_string).collect();
            line(
                &mut out,
                &["free".to_string()]
                    .into_iter()
                    .chain(free)
                    .collect::<Vec<_>>()
                    .join(" "),
            );
            matrix(&mut out, "a", p.a());
            matrix(&mut out, "b", p.b());
        }
        Body::System(s) => {
            out.push_str("system\n");
            if let Some(mu) = s.friction() {
                line(&mut out, &format!("friction {mu}"));
            }
            for p in s.particles() {
                let sign = if let ContactState::Slip { sign } = p.state {
                    format!(" {sign}")
                } else {
                    String::new()
                };
                line(
                    &mut out,
                    &format!(
                        "particle {} {} {}{sign}",
                        p.tangential,
                        p.normal,
                        p.state.word()
                    ),
                );
                for (word, direction) in [("tangent", p.tangent()), ("normal", p.into_obstacle())] {
                    let pairs: Vec<String> = direction
                        .iter()
                        .map(|(dof, c)| format!("{dof} {c}"))
                        .collect();
                    line(&mut out, &format!("{word} {}", pairs.join(" ")));
                }
            }
            matrix(&mut out, "stiffness", s.stiffness());
            if let Some(m) = s.mass() {
                matrix(&mut out, "mass", m);
            }
        }
    }
    out
}

/// SHA-256 of the canonical text in lower-case hexadecimal.
pub(super) fn sha256(problem: &Problem) -> String {
    let digest = Sha256::digest(text(problem).as_bytes());
    digest
        .iter()
        .fold(String::with_capacity(64), |mut hex, byte| {
            let _ = write!(hex, "{byte:02x}"); // writing to a String cannot fail
            hex
        })
}

fn line(out: &mut String, text: &str) {
    out.push_str(text);
    out.push('\n');
}

fn matrix(out: &mut String, name: &str, m: &Sparse) {
    line(out, &format!("{name} {} {}", m.rows(), m.cols()));
    for (i, j, v) in m.entries() {
        let _ = writeln!(out, "{i} {j} {v}"); // writing to a String cannot fail
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Pencil, Unknown, Window};
    use mceip_exact::{rational, whole};

    fn problem(v: mceip_exact::Rational, unknown: Unknown) -> Problem {
        let a = Sparse::from_entries(1, 1, [(0, 0, v)]);
        let pencil = Pencil::new(a, Sparse::identity(1), vec![]).unwrap();
        Problem::new(Body::Pencil(pencil), unknown, Window::all()).unwrap()
    }

    #[test]
    fn a_system_is_spelt_out_with_its_directions() {
        use crate::{Particle, System};
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
