//! The enumeration of (24)-(26) once more, by another route: minors by Laplace expansion, roots by
//! Descartes' rule, null spaces by Gauss over Q(alpha), extreme rays by trying all sets of active
//! constraints.

pub mod field;
pub mod poly;

use dashu_ratio::RBig;
use field::Alpha;
use poly::{P, add, mul, q, scale};

/// A pencil of small integers.
pub struct Third {
    pub a: Vec<Vec<i64>>,
    pub b: Vec<Vec<i64>>,
    pub free: Vec<usize>,
}

/// A solution that is an extreme ray of the cone of its support.
#[derive(Debug, Clone)]
pub struct Ray {
    pub x: Vec<P>,
    pub slip: Vec<usize>,
    pub y_zero: Vec<usize>,
}

impl Third {
    pub fn slips(&self) -> Vec<usize> {
        (0..self.a.len())
            .filter(|i| !self.free.contains(i))
            .collect()
    }

    pub fn supports(&self) -> Vec<Vec<usize>> {
        subsets(&self.slips())
    }

    fn entry(&self, i: usize, j: usize) -> P {
        poly::trim(vec![q(self.a[i][j]), q(self.b[i][j])])
    }

    fn with_free(&self, set: &[usize]) -> Vec<usize> {
        self.free.iter().chain(set).copied().collect()
    }

    /// det of the pencil on the free variables and a support: minors of the first k rows, all
    /// column sets.
    pub fn determinant(&self, support: &[usize]) -> P {
        let active = self.with_free(support);
        let n = active.len();
        let mut minors: Vec<P> = vec![Vec::new(); 1 << n];
        minors[0] = vec![q(1)];
        for set in 1usize..1 << n {
            let row = active[set.count_ones() as usize - 1];
            let mut sum = Vec::new();
            for (place, c) in (0..n).filter(|c| set >> c & 1 == 1).enumerate() {
                let sign = if (set.count_ones() as usize - 1 - place).is_multiple_of(2) {
                    1
                } else {
                    -1
                };
                let term = mul(&self.entry(row, active[c]), &minors[set & !(1 << c)]);
                sum = add(&sum, &scale(&term, &q(sign)));
            }
            minors[set] = sum;
        }
        minors[(1 << n) - 1].clone()
    }

    /// All distinct roots >= 0 of the determinants that are not identically zero; supports whose
    /// are.
    pub fn values(&self) -> (Vec<Alpha>, Vec<Vec<usize>>) {
        let (mut values, mut singular): (Vec<Alpha>, Vec<Vec<usize>>) = (Vec::new(), Vec::new());
        for support in self
            .supports()
            .into_iter()
            .filter(|s| !self.with_free(s).is_empty())
        {
            let det = self.determinant(&support);
            if det.is_empty() {
                singular.push(support);
                continue;
            }
            let p = poly::squarefree(&det);
            for place in poly::roots(&det) {
                let mut new = Alpha::new(&p, place);
                if !values
                    .iter()
                    .any(|old: &Alpha| new.is_root_in(&old.p, &old.lo, &old.hi))
                {
                    values.push(new);
                }
            }
        }
        (values, singular)
    }

    /// Every extreme ray of every support's cone at alpha: supports J and sets E off J such that
    /// x = 0 off J, y = 0 on J and E leaves one line, with x > 0 on J and y > 0 on the rest.
    pub fn rays(&self, alpha: &mut Alpha) -> Vec<Ray> {
        self.rays_without(alpha, &[])
    }

    /// Free variables that can be set to zero by adding a line (x_s = 0 and y = 0 along it), one
    /// for each dimension of the space of lines.
    fn lines(&self, alpha: &mut Alpha) -> Vec<usize> {
        let lines = self.null_space(alpha, &[], &self.slips(), &[]);
        // Gauss leaves one basis vector for each free column: 1 there, 0 at the others'.
        let own = |k: usize| {
            self.free.iter().copied().find(|&f| {
                lines
                    .iter()
                    .enumerate()
                    .all(|(l, v)| v[f].is_empty() == (l != k))
            })
        };
        (0..lines.len()).filter_map(own).collect()
    }

    /// [`Third::rays`] among the vectors with zeros at some of the free variables.
    fn rays_without(&self, alpha: &mut Alpha, zeros: &[usize]) -> Vec<Ray> {
        let mut found = Vec::new();
        for support in self.supports() {
            let off: Vec<usize> = self
                .slips()
                .into_iter()
                .filter(|i| !support.contains(i))
                .collect();
            let width = self.null_space(alpha, &support, &[], zeros).len();
            for extra in subsets(&off)
                .into_iter()
                .filter(|e| width > 1 || (width == 1 && e.is_empty()))
            {
                let kernel = self.null_space(alpha, &support, &extra, zeros);
                let [x] = &kernel[..] else { continue };
                for sign in [1, -1] {
                    let x: Vec<P> = x.iter().map(|p| scale(p, &q(sign))).collect();
                    found.extend(self.ray(
                        alpha,
                        &support,
                        if width > 1 { Some(&extra) } else { None },
                        x,
                    ));
                }
            }
        }
        found
    }

    fn null_space(
        &self,
        alpha: &mut Alpha,
        support: &[usize],
        extra: &[usize],
        zeros: &[usize],
    ) -> Vec<Vec<P>> {
        let columns: Vec<usize> = self
            .with_free(support)
            .into_iter()
            .filter(|j| !zeros.contains(j))
            .collect();
        let rows = self
            .with_free(support)
            .into_iter()
            .chain(extra.iter().copied());
        let m = rows
            .map(|i| {
                columns
                    .iter()
                    .map(|&j| alpha.reduce(&self.entry(i, j)))
                    .collect()
            })
            .collect();
        let kernel = alpha.null_space(m, columns.len());
        let spread = |v: Vec<P>| {
            let mut x = vec![Vec::new(); self.a.len()];
            columns.iter().zip(v).for_each(|(&j, p)| x[j] = p);
            x
        };
        kernel.into_iter().map(spread).collect()
    }

    /// The ray if it has exactly this support and (where it matters) exactly these further zeros of
    /// y.
    fn ray(
        &self,
        alpha: &mut Alpha,
        support: &[usize],
        extra: Option<&Vec<usize>>,
        x: Vec<P>,
    ) -> Option<Ray> {
        let mut y_zero = Vec::new();
        for i in self.slips() {
            let y = (0..x.len()).fold(Vec::new(), |s, j| add(&s, &mul(&self.entry(i, j), &x[j])));
            let (s_x, s_y) = (alpha.sign(&x[i]), alpha.sign(&y));
            let inside = support.contains(&i);
            if s_y < 0 || (inside && (s_x <= 0 || s_y != 0)) {
                return None;
            }
            if s_y == 0 {
                y_zero.push(i);
            }
        }
        let further: Vec<usize> = y_zero
            .iter()
            .copied()
            .filter(|i| !support.contains(i))
            .collect();
        extra.is_none_or(|e| *e == further).then(|| Ray {
            x,
            slip: support.to_vec(),
            y_zero,
        })
    }

    /// The maximal cones of two or more rays, as support and indices into `rays`.
    pub fn cones(
        &self,
        alpha: &mut Alpha,
        rays: &[Ray],
        supports: &[Vec<usize>],
    ) -> Vec<(Vec<usize>, Vec<usize>)> {
        let subset = |a: &[usize], b: &[usize]| a.iter().all(|i| b.contains(i));
        let of = |j: &Vec<usize>| -> Vec<usize> {
            (0..rays.len())
                .filter(|&r| subset(&rays[r].slip, j) && subset(j, &rays[r].y_zero))
                .collect()
        };
        let candidates: Vec<(Vec<usize>, Vec<usize>)> = supports
            .iter()
            .map(|j| (j.clone(), of(j)))
            .filter(|(_, r)| r.len() > 1)
            .collect();
        // x and -x are a line, not a cone of two dimensions.
        let opposite = |r: &[usize], alpha: &mut Alpha| {
            let minus: Vec<P> = rays[r[0]].x.iter().map(|p| scale(p, &q(-1))).collect();
            r.len() == 2 && same_ray(alpha, &minus, &rays[r[1]].x)
        };
        let covered = |j: &[usize], r: &[usize]| {
            j.iter()
                .all(|i| r.iter().any(|&k| rays[k].slip.contains(i)))
        };
        let full: Vec<_> = candidates
            .into_iter()
            .filter(|(j, r)| covered(j, r) && !opposite(r, alpha))
            .collect();
        full.iter()
            .filter(|(j, r)| !full.iter().any(|(k, s)| j != k && subset(r, s)))
            .cloned()
            .collect()
    }

    /// Does a solution with exactly this support exist at alpha? Some sum of rays has it.
    pub fn exists(&self, alpha: &mut Alpha, support: &[usize]) -> bool {
        let lines = self.lines(alpha);
        let rays = self.rays_without(alpha, &lines);
        let subset = |a: &[usize], b: &[usize]| a.iter().all(|i| b.contains(i));
        let on: Vec<&Ray> = rays
            .iter()
            .filter(|r| subset(&r.slip, support) && subset(support, &r.y_zero))
            .collect();
        !(on.is_empty() && lines.is_empty())
            && support
                .iter()
                .all(|i| on.iter().any(|r| r.slip.contains(i)))
    }
}

pub fn subsets(set: &[usize]) -> Vec<Vec<usize>> {
    (0..1usize << set.len())
        .map(|m| {
            set.iter()
                .enumerate()
                .filter(|(k, _)| m >> k & 1 == 1)
                .map(|(_, &i)| i)
                .collect()
        })
        .collect()
}

/// Do two vectors agree up to a positive factor?
pub fn same_ray(alpha: &mut Alpha, u: &[P], v: &[P]) -> bool {
    let Some(k) = (0..u.len()).find(|&k| !alpha.is_zero(&u[k])) else {
        return false;
    };
    (0..u.len())
        .all(|i| alpha.is_zero(&add(&mul(&u[k], &v[i]), &scale(&mul(&u[i], &v[k]), &q(-1)))))
        && alpha.sign(&u[k]) == alpha.sign(&v[k])
}

/// A rational test value.
pub fn at(n: i64, d: i64) -> Alpha {
    Alpha::rational(RBig::from(n) / RBig::from(d))
}
