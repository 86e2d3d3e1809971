//! The pencil of a problem, formed by the checker itself, independently of `reduction`.
//!
//! For a system the change of variables is read as two families of vectors over the degrees of
//! freedom: v = T x (columns of T: e_dof for a free dof, -S t for a slip particle, equation (10))
//! and y = P' w (columns of P: e_dof, or -(S t + mu n), equation (11)). Then y = P'(K + l M) T x.
//! No block formula (16) is used: that is what `reduction` does, and tests hold the two equal.

use mceip_exact::{Integer, Rational, Sparse, common_denominator};
use mceip_model::{Body, Direction, Problem, System, Unknown};
use std::collections::BTreeMap;

/// One row of A + tB with denominators cleared: (column, coefficient in A, coefficient in B).
pub(super) type Row = Vec<(usize, Integer, Integer)>;

/// The rows of the pencil, each multiplied by a positive integer, and the free variables.
pub(super) struct Rows {
    pub(super) rows: Vec<Row>,
    /// The integer each row was multiplied by.
    pub(super) factor: Vec<Integer>,
    pub(super) is_free: Vec<bool>,
}

impl Rows {
    pub(super) fn of(problem: &Problem) -> Rows {
        match problem.body() {
            Body::Pencil(p) => {
                let (rows, factor) = (0..p.order())
                    .map(|i| merge(p.a().row(i), p.b().row(i)))
                    .unzip();
                Rows {
                    rows,
                    factor,
                    is_free: (0..p.order())
                        .map(|i| p.free().binary_search(&i).is_ok())
                        .collect(),
                }
            }
            Body::System(s) => of_system(s, problem.unknown()),
        }
    }

    /// B + sA: the same solutions at s = 1 / t.
    pub(super) fn reversed(&self) -> Rows {
        let swapped = |row: &Row| {
            row.iter()
                .map(|(j, a, b)| (*j, b.clone(), a.clone()))
                .collect()
        };
        Rows {
            rows: self.rows.iter().map(swapped).collect(),
            factor: self.factor.clone(),
            is_free: self.is_free.clone(),
        }
    }

    pub(super) fn order(&self) -> usize {
        self.rows.len()
    }
}

/// Joins a row of A and a row of B and clears denominators: the row and its multiplier.
fn merge(a: &[(usize, Rational)], b: &[(usize, Rational)]) -> (Row, Integer) {
    let factor = common_denominator(a.iter().chain(b).map(|(_, v)| v));
    let integral = |v: &Rational| v.numer() * (&factor / v.denom());
    let mut row: BTreeMap<usize, (Integer, Integer)> = BTreeMap::new();
    for (j, v) in a {
        row.entry(*j).or_default().0 += integral(v);
    }
    for (j, v) in b {
        row.entry(*j).or_default().1 += integral(v);
    }
    (
        row.into_iter().map(|(j, (a, b))| (j, a, b)).collect(),
        factor,
    )
}

fn of_system(s: &System, unknown: Unknown) -> Rows {
    let one = Rational::from_integer(1.into());
    let free: Vec<usize> = s.free_dofs();
    // Columns of T; columns of P without friction, and its friction part.
    let mut t: Vec<Direction> = free.iter().map(|&d| vec![(d, one.clone())]).collect();
    let mut p_plain = t.clone();
    let mut p_friction: Vec<Direction> = vec![Vec::new(); free.len()];
    for (particle, sign) in s.slip_particles() {
        let minus_s = Rational::from_integer((-sign).into());
        t.push(scale(&particle.tangent(), &minus_s)); // E10: v_T = -S x
        p_plain.push(scale(&particle.tangent(), &minus_s)); // E11: y = -(S w_T + mu w_N)
        p_friction.push(scale(&particle.into_obstacle(), &-&one));
    }
    // Transposed T: for each dof, the variables that move it.
    let mut moves: Vec<Vec<(usize, Rational)>> = vec![Vec::new(); s.dofs()];
    for (j, column) in t.iter().enumerate() {
        for (dof, c) in column {
            moves[*dof].push((j, c.clone()));
        }
    }
    let product = |p: &Direction, m: &Sparse| -> Vec<(usize, Rational)> {
        let mut row: BTreeMap<usize, Rational> = BTreeMap::new();
        for (d, p_d) in p {
            for (e, m_de) in m.row(*d) {
                for (j, t_ej) in &moves[*e] {
                    *row.entry(*j).or_default() += p_d * m_de * t_ej;
                }
            }
        }
        row.into_iter().collect()
    };
    let k = s.stiffness();
    let (rows, factor) = p_plain
        .iter()
        .zip(&p_friction)
        .map(
            |(plain, friction)| match (unknown, s.mass(), s.friction()) {
                (Unknown::Lambda2, Some(m), Some(mu)) => {
                    let p: Direction = plain.iter().cloned().chain(scale(friction, mu)).collect();
                    merge(&product(&p, k), &product(&p, m))
                }
                // MCEIP-mu: the friction part is the coefficient of the unknown.
                _ => merge(&product(plain, k), &product(friction, k)),
            },
        )
        .unzip();
    let is_free = (0..t.len()).map(|i| i < free.len()).collect();
    Rows {
        rows,
        factor,
        is_free,
    }
}

fn scale(d: &Direction, factor: &Rational) -> Direction {
    d.iter().map(|(dof, c)| (*dof, c * factor)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};
    use mceip_model::reduction::reduce;
    use mceip_model::{ContactState, Particle, Window};

    /// An oblique particle (3/5, 4/5), one along the axes and two free degrees of freedom: the
    /// block formulas (16) of `reduction` give the same pencil.
    #[test]
    fn the_pencil_is_that_of_the_blocks() {
        let (r, w) = (rational, whole);
        let slip = |sign| ContactState::Slip { sign };
        let frame = [[r(3, 5), r(4, 5)], [r(-4, 5), r(3, 5)]];
        let oblique = Particle {
            frame: Some(frame),
            ..Particle::plain(0, 1, slip(1))
        };
        let plain = Particle {
            normal_direction: -1,
            ..Particle::plain(4, 5, slip(-1))
        };
        let symmetric = |diagonal: i64, scale: i64| {
            let entry = |i: usize, j: usize| {
                let v = r(((3 * i.min(j) + 5 * i.max(j)) % 7) as i64 - 3, scale);
                if i == j { v + w(diagonal) } else { v }
            };
            let entries = (0..6)
                .flat_map(|i| (0..6).map(move |j| (i, j)))
                .map(|(i, j)| (i, j, entry(i, j)));
            Sparse::from_entries(6, 6, entries.collect::<Vec<_>>())
        };
        let system = System::new(
            symmetric(40, 1),
            Some(symmetric(9, 3)),
            Some(r(2, 7)),
            vec![oblique, plain],
        )
        .unwrap();
        for unknown in [Unknown::Lambda2, Unknown::Mu] {
            let problem =
                Problem::new(Body::System(system.clone()), unknown, Window::all()).unwrap();
            let (rows, pencil) = (Rows::of(&problem), reduce(&problem).unwrap().pencil);
            assert_eq!(rows.order(), pencil.order());
            for (i, row) in rows.rows.iter().enumerate() {
                assert_eq!(rows.is_free[i], pencil.free().contains(&i));
                for (m, which) in [(pencil.a(), 0), (pencil.b(), 1)] {
                    let scaled: Vec<(usize, Rational)> = m
                        .row(i)
                        .iter()
                        .map(|(j, v)| (*j, v * Rational::from_integer(rows.factor[i].clone())))
                        .collect();
                    let own = row.iter().map(|(j, a, b)| {
                        (
                            *j,
                            Rational::from_integer(if which == 0 { a.clone() } else { b.clone() }),
                        )
                    });
                    assert_eq!(own.filter(|(_, v)| *v != w(0)).collect::<Vec<_>>(), scaled);
                }
            }
        }
    }
}
