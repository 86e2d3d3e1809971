//! Propositions 1 and 2 both ways, the Remark, and the zeta window, between oracle and embedding.
#![cfg(feature = "testkit")]

use mceip_engine::multistart::{Search, multistart};
use mceip_engine::reduction::{Embedding, Side, reduce};
use mceip_exact::{to_f64, whole};
use mceip_mcp::mcp::Mcp;
use mceip_mcp::solver::{Options, Residuals, solve};
use mceip_model::{Admissible, Unknown, Window};
use mceip_oracle::enumerate;
use mceip_testkit::{Instance, mechanical, random_pencils};

fn instances() -> Vec<Instance> {
    random_pencils(40, 11)
        .unwrap()
        .into_iter()
        .chain(mechanical(20, 11).unwrap())
        .collect()
}

/// "Only if": every solution of the eigenproblem, normalised, solves the MCP with gamma = 0.
#[test]
fn solutions_of_the_eigenproblem_solve_the_mcp() {
    let mut count = 0;
    for instance in instances() {
        let pencil = reduce(&instance.problem).unwrap().pencil;
        let embedding = Embedding::new(
            &Admissible::new(&pencil, instance.problem.unknown()).unwrap(),
            Side::Above(0.0),
        );
        for s in enumerate(&pencil, &Window::all()).unwrap().solutions {
            let x: Vec<f64> = s
                .x_decimals(&pencil.slip(), 17)
                .iter()
                .map(|v| v.parse().unwrap())
                .collect();
            let z = embedding.point(s.decimal(17).parse().unwrap(), &x);
            let r = Residuals::at(&embedding, &z);
            // Basis: 17-digit data of order one in units of the scaled pencil.
            assert!(
                r.minimum_map < 1e-9 && r.normal_map < 1e-9,
                "{}: {r:?}",
                instance.label
            );
            let mut off = z.clone();
            off[0] += 0.1;
            assert!(
                Residuals::at(&embedding, &off).minimum_map > 1e-6,
                "{}",
                instance.label
            );
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}

/// "If": what solves the MCP is certified as a solution of the eigenproblem, or reported.
#[test]
fn solutions_of_the_mcp_are_certified_or_reported() {
    for instance in instances() {
        let pencil = reduce(&instance.problem).unwrap().pencil;
        let admissible = Admissible::new(&pencil, instance.problem.unknown()).unwrap();
        let found = multistart(&instance.problem, &admissible, &Search::default()).unwrap();
        let reached = found
            .terminations
            .iter()
            .filter(|(t, _)| t.reached_tolerance())
            .map(|(_, n)| n)
            .sum::<usize>();
        assert_eq!(
            reached,
            found.certified.len() + found.uncertified.len() + found.repeated + found.outside,
            "{}",
            instance.label
        );
    }
}

/// The Remark: K0 definite makes every MCEIP-mu value positive.
#[test]
fn mu_is_positive_when_k0_is_definite() {
    for instance in instances()
        .iter()
        .filter(|i| i.problem.unknown() == Unknown::Mu)
    {
        let pencil = reduce(&instance.problem).unwrap().pencil;
        let at_zero = enumerate(&pencil, &Window::new(whole(0), Some(whole(0))).unwrap()).unwrap();
        assert!(
            at_zero.solutions.is_empty() && at_zero.wide.is_empty(),
            "{}",
            instance.label
        );
    }
}

/// zeta = t - t0 finds only values above t0, zeta = t0 - t only values below.
#[test]
fn windows_keep_to_their_side() {
    let mut sides = [0, 0];
    for instance in instances() {
        let pencil = reduce(&instance.problem).unwrap().pencil;
        let admissible = Admissible::new(&pencil, instance.problem.unknown()).unwrap();
        let values: Vec<f64> = enumerate(&pencil, &Window::all())
            .unwrap()
            .solutions
            .iter()
            .map(|s| to_f64(&s.value.interval().mid()))
            .collect();
        let Some(&origin) = values.first() else {
            continue;
        };
        for (k, side) in [Side::Above(origin * 0.5), Side::Below(origin * 1.5)]
            .into_iter()
            .enumerate()
        {
            let embedding = Embedding::new(&admissible, side);
            for start in embedding.starts(6, 3) {
                let outcome = solve(&embedding, &start, &Options::default()).unwrap();
                if outcome.termination.reached_tolerance() {
                    let value = embedding.candidate(&outcome.point).value;
                    let slack = 1e-9 * (1.0 + origin);
                    assert!(if k == 0 {
                        value >= origin * 0.5 - slack
                    } else {
                        value <= origin * 1.5 + slack
                    });
                    sides[k] += 1;
                }
            }
        }
    }
    assert!(sides[0] > 10 && sides[1] > 10, "{sides:?}");
}

/// c only sets the scale of x; gamma vanishes wherever t > 0.
#[test]
fn the_constant_c_scales_x_and_nothing_else() {
    let mut count = 0;
    for instance in instances() {
        let pencil = reduce(&instance.problem).unwrap().pencil;
        let one = Embedding::new(
            &Admissible::new(&pencil, instance.problem.unknown()).unwrap(),
            Side::Above(0.0),
        );
        assert!(one.clone().with_c(0.0).is_none() && one.clone().with_c(f64::NAN).is_none());
        let five = one.clone().with_c(5.0).unwrap();
        for s in enumerate(&pencil, &Window::all()).unwrap().solutions {
            let x: Vec<f64> = s
                .x_decimals(&pencil.slip(), 17)
                .iter()
                .map(|v| v.parse().unwrap())
                .collect();
            let z = five.point(s.decimal(17).parse().unwrap(), &x);
            assert!(Residuals::at(&five, &z).minimum_map < 1e-8 && five.gamma(&z).abs() < 1e-12);
            assert!((one.gamma(&z) - 4.0).abs() < 1e-12);
            // The point of the other constant is no solution: e'x_s = c is asked for. // E28, E33
            let other = one.point(s.decimal(17).parse().unwrap(), &x);
            assert!(
                Residuals::at(&five, &other).minimum_map > 1e-3,
                "{}",
                instance.label
            );
            let outcome = solve(&five, &z, &Options::default()).unwrap();
            assert!(outcome.termination.reached_tolerance());
            let (a, b) = (
                five.candidate(&outcome.point),
                one.candidate(&one.point(s.decimal(17).parse().unwrap(), &x)),
            );
            assert!((a.value - b.value).abs() <= 1e-7 * (1.0 + b.value));
            assert!(
                a.x.iter()
                    .zip(&b.x)
                    .all(|(p, q)| (p - 5.0 * q).abs() < 1e-6),
                "{}",
                instance.label
            );
            count += 1;
        }
    }
    assert!(count > 20);
}

/// Section 4: neither problem is monotone. With F(x, t) = ((A + tB) x, e'x_s - c), points (0, t +
/// L) and (s e_i, t) have (F - F)'(z - z) = s^2 (A + tB)_ii - s L, negative for small s.
#[test]
fn neither_mcp_is_monotone() {
    for instance in instances() {
        let pencil = reduce(&instance.problem).unwrap().pencil;
        let mcp = Embedding::new(
            &Admissible::new(&pencil, instance.problem.unknown()).unwrap(),
            Side::Above(0.0),
        );
        let n = mcp.dimension() - 1;
        let at = |slip: f64, zeta: f64| {
            let mut z = vec![0.0; n + 1];
            (z[pencil.slip()[0]], z[n]) = (slip, zeta);
            let mut f = vec![0.0; n + 1];
            mcp.function(&z, &mut f);
            (z, f)
        };
        let product = |s: f64| {
            let ((z, f), (w, g)) = (at(0.0, 1.0), at(s, 0.0));
            (0..=n).map(|i| (f[i] - g[i]) * (z[i] - w[i])).sum::<f64>()
        };
        assert!(
            (1..60).any(|k| product(0.5f64.powi(k)) < 0.0),
            "{}",
            instance.label
        );
    }
}
