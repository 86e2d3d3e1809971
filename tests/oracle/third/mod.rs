//! A second enumeration of the solutions of (24)-(26), to compare the first one with.
//!
//! It takes another way at every step: determinants by Laplace expansion over all minors, roots by
//! Descartes' rule ([`poly`]), null spaces by Gauss elimination over Q(alpha) ([`field`]), and
//! extreme rays by trying all sets of active constraints. It shares no line and no number type with
//! `mceip_exact` and `mceip_oracle`, so that a fault there has no twin here.
//!
//! The pencil is A + t B with y = (A + t B) x. Of the complementarity variables x_i >= 0, y_i >= 0
//! and x_i y_i = 0, of the free ones y_i = 0. A support is the set of the complementarity variables
//! with x_i > 0. `tests/oracle/third_opinion.rs` does the comparison.

pub mod field;
pub mod poly;

use dashu_ratio::RBig;
use field::Alpha;
use poly::{Polynomial, add, integer, multiply, negate, nonnegative_roots, squarefree, trim};

/// A pencil of small integers.
pub struct Third {
    pub a: Vec<Vec<i64>>,
    pub b: Vec<Vec<i64>>,
    pub free: Vec<usize>,
}

/// The values at which a pencil can have solutions.
pub struct Spectrum {
    /// All distinct roots >= 0 of the determinants that are not identically zero.
    pub values: Vec<Alpha>,
    /// The supports whose determinant is identically zero.
    pub singular: Vec<Vec<usize>>,
}

/// A solution that is an extreme ray of the cone of its support.
#[derive(Debug, Clone)]
pub struct Ray {
    pub x: Vec<Polynomial>,
    pub slip: Vec<usize>,
    pub y_zero: Vec<usize>,
}

impl Ray {
    /// The complementarity variables with x_i = y_i = 0.
    pub fn biactive(&self) -> Vec<usize> {
        without(&self.y_zero, &self.slip)
    }

    /// Does the ray belong to the closed cone x_i = 0 off the support, y_i = 0 on it?
    fn is_in_cone_of(&self, support: &[usize]) -> bool {
        let x_fits = is_subset(&self.slip, support);
        let y_fits = is_subset(support, &self.y_zero);
        x_fits && y_fits
    }
}

/// The cone of a support that two or more rays span.
#[derive(Clone)]
pub struct SpannedCone {
    pub support: Vec<usize>,
    /// Indices into the list of rays that the cone was made from.
    pub rays: Vec<usize>,
}

impl Third {
    /// The complementarity variables.
    pub fn slips(&self) -> Vec<usize> {
        let all: Vec<usize> = (0..self.a.len()).collect();
        without(&all, &self.free)
    }

    pub fn supports(&self) -> Vec<Vec<usize>> {
        subsets(&self.slips())
    }

    /// The entry of A + t B as a polynomial in t.
    fn entry(&self, i: usize, j: usize) -> Polynomial {
        let constant = integer(self.a[i][j]);
        let linear = integer(self.b[i][j]);
        trim(vec![constant, linear])
    }

    fn with_free(&self, set: &[usize]) -> Vec<usize> {
        [&self.free[..], set].concat()
    }

    /// The determinant of the pencil on the free variables and a support.
    ///
    /// By Laplace expansion: the minors of the first k rows, for all sets of k columns, from the
    /// minors of the first k - 1 rows. A set of columns is a bit pattern.
    pub fn determinant(&self, support: &[usize]) -> Polynomial {
        let active = self.with_free(support);
        let order = active.len();
        let mut minors = vec![Polynomial::new(); 1 << order];
        minors[0] = vec![integer(1)];

        for columns in 1usize..1 << order {
            minors[columns] = self.minor(&active, columns, &minors);
        }
        minors[(1 << order) - 1].clone()
    }

    /// The minor of a set of k columns and the first k rows, expanded by its last row: `minors` has
    /// those of all smaller sets.
    fn minor(&self, active: &[usize], columns: usize, minors: &[Polynomial]) -> Polynomial {
        let last_row = columns.count_ones() as usize - 1;
        let mut minor = Polynomial::new();
        let mut place = 0;

        for column in 0..active.len() {
            if columns >> column & 1 == 0 {
                continue;
            }
            let entry = self.entry(active[last_row], active[column]);
            let smaller_minor = &minors[columns & !(1 << column)];
            let term = multiply(&entry, smaller_minor);

            let is_even = (last_row - place).is_multiple_of(2);
            let signed_term = if is_even { term } else { negate(&term) };
            minor = add(&minor, &signed_term);
            place += 1;
        }
        minor
    }

    pub fn spectrum(&self) -> Spectrum {
        let mut values: Vec<Alpha> = Vec::new();
        let mut singular = Vec::new();

        for support in self.supports() {
            if self.with_free(&support).is_empty() {
                continue;
            }
            let determinant = self.determinant(&support);
            if determinant.is_empty() {
                singular.push(support);
                continue;
            }

            let p = squarefree(&determinant);
            for bracket in nonnegative_roots(&determinant) {
                let mut new = Alpha::new(&p, bracket);
                let mut known = values.iter();
                if !known.any(|old| new.is_root_in(&old.p, &old.lo, &old.hi)) {
                    values.push(new);
                }
            }
        }
        Spectrum { values, singular }
    }

    /// Every extreme ray of every support's cone at alpha.
    ///
    /// These are supports J and sets E off J such that x = 0 off J, y = 0 on J and y = 0 on E leave
    /// one line, with x > 0 on J and y > 0 on the rest.
    pub fn rays(&self, alpha: &mut Alpha) -> Vec<Ray> {
        self.rays_without(alpha, &[])
    }

    /// Free variables that can be set to zero by adding a line, one for each dimension of the space
    /// of lines. Along a line x_s = 0 and y = 0.
    fn lines(&self, alpha: &mut Alpha) -> Vec<usize> {
        let lines = self.null_space(alpha, &[], &self.slips(), &[]);
        let mut representatives = Vec::new();

        for own in 0..lines.len() {
            let mut free = self.free.iter().copied();
            representatives.extend(free.find(|&variable| is_only_in(variable, &lines, own)));
        }
        representatives
    }

    /// [`Third::rays`] among the vectors with zeros at some of the free variables.
    fn rays_without(&self, alpha: &mut Alpha, zeros: &[usize]) -> Vec<Ray> {
        let mut found = Vec::new();

        for support in self.supports() {
            let kernel_dimension = self.null_space(alpha, &support, &[], zeros).len();
            if kernel_dimension == 0 {
                continue;
            }
            if kernel_dimension == 1 {
                self.rays_of_line(alpha, &support, None, zeros, &mut found);
                continue;
            }

            let off_support = without(&self.slips(), &support);
            for active in subsets(&off_support) {
                self.rays_of_line(alpha, &support, Some(&active), zeros, &mut found);
            }
        }
        found
    }

    /// Appends the rays of a support, if the active constraints of y leave one line.
    ///
    /// With `active` given, these must be all the zeros of y off the support; without, none is
    /// asked for and any may occur.
    fn rays_of_line(
        &self,
        alpha: &mut Alpha,
        support: &[usize],
        active: Option<&[usize]>,
        zeros: &[usize],
        found: &mut Vec<Ray>,
    ) {
        let kernel = self.null_space(alpha, support, active.unwrap_or(&[]), zeros);
        let [x] = &kernel[..] else {
            return;
        };

        let opposite: Vec<Polynomial> = x.iter().map(|p| negate(p)).collect();
        for direction in [x.clone(), opposite] {
            let Some(ray) = self.ray(alpha, support, direction) else {
                continue;
            };
            if active.is_none_or(|active| ray.biactive() == active) {
                found.push(ray);
            }
        }
    }

    /// The vectors x with x = 0 off the support and at `zeros`, y = 0 on the support, on the free
    /// variables and at `active`.
    fn null_space(
        &self,
        alpha: &mut Alpha,
        support: &[usize],
        active: &[usize],
        zeros: &[usize],
    ) -> Vec<Vec<Polynomial>> {
        let columns = without(&self.with_free(support), zeros);
        let rows = [&self.with_free(support)[..], active].concat();

        let mut matrix = Vec::new();
        for &row in &rows {
            let mut entries = Vec::new();
            for &column in &columns {
                entries.push(alpha.reduce(&self.entry(row, column)));
            }
            matrix.push(entries);
        }

        let mut basis = Vec::new();
        for vector in alpha.null_space(matrix, columns.len()) {
            let mut x = vec![Polynomial::new(); self.a.len()];
            for (&column, component) in columns.iter().zip(vector) {
                x[column] = component;
            }
            basis.push(x);
        }
        basis
    }

    /// Row i of (A + t B) x.
    fn y(&self, i: usize, x: &[Polynomial]) -> Polynomial {
        let mut sum = Polynomial::new();
        for (j, component) in x.iter().enumerate() {
            let product = multiply(&self.entry(i, j), component);
            sum = add(&sum, &product);
        }
        sum
    }

    /// The ray of x, if x solves the problem with exactly this support.
    fn ray(&self, alpha: &mut Alpha, support: &[usize], x: Vec<Polynomial>) -> Option<Ray> {
        let mut y_zero = Vec::new();

        for i in self.slips() {
            let sign_of_x = alpha.sign(&x[i]);
            let sign_of_y = alpha.sign(&self.y(i, &x));

            let in_support = support.contains(&i);
            let slips = sign_of_x > 0 && sign_of_y == 0;
            if sign_of_y < 0 || (in_support && !slips) {
                return None;
            }
            if sign_of_y == 0 {
                y_zero.push(i);
            }
        }

        Some(Ray {
            x,
            slip: support.to_vec(),
            y_zero,
        })
    }

    /// The maximal cones of two or more rays.
    pub fn cones(
        &self,
        alpha: &mut Alpha,
        rays: &[Ray],
        supports: &[Vec<usize>],
    ) -> Vec<SpannedCone> {
        let mut cones = Vec::new();

        for support in supports {
            let mut members = Vec::new();
            for (index, ray) in rays.iter().enumerate() {
                if ray.is_in_cone_of(support) {
                    members.push(index);
                }
            }
            let spanning: Vec<&Ray> = members.iter().map(|&index| &rays[index]).collect();
            if members.len() > 1 && fill(&spanning, support) && !is_line(alpha, &spanning) {
                cones.push(SpannedCone {
                    support: support.clone(),
                    rays: members,
                });
            }
        }

        let mut maximal = cones.clone();
        maximal.retain(|cone| is_maximal(cone, &cones));
        maximal
    }

    /// Does a solution with exactly this support exist at alpha? Some sum of rays has it.
    pub fn exists(&self, alpha: &mut Alpha, support: &[usize]) -> bool {
        let lines = self.lines(alpha);
        let rays = self.rays_without(alpha, &lines);

        let mut in_cone: Vec<&Ray> = rays.iter().collect();
        in_cone.retain(|ray| ray.is_in_cone_of(support));
        if in_cone.is_empty() && lines.is_empty() {
            return false;
        }
        fill(&in_cone, support)
    }
}

/// Does the variable occur in one of the vectors and in no other?
///
/// Gauss leaves one basis vector for each free column: 1 there, 0 at the others'.
fn is_only_in(variable: usize, vectors: &[Vec<Polynomial>], own: usize) -> bool {
    let mut numbered = vectors.iter().enumerate();
    numbered.all(|(k, vector)| vector[variable].is_empty() == (k != own))
}

/// Is each variable of the support positive in one of the rays?
fn fill(rays: &[&Ray], support: &[usize]) -> bool {
    let mut variables = support.iter();
    variables.all(|i| rays.iter().any(|ray| ray.slip.contains(i)))
}

/// Are these two rays x and -x? They are a line, not a cone of two dimensions.
fn is_line(alpha: &mut Alpha, rays: &[&Ray]) -> bool {
    let &[first, second] = rays else {
        return false;
    };
    let opposite: Vec<Polynomial> = first.x.iter().map(|p| negate(p)).collect();
    same_ray(alpha, &opposite, &second.x)
}

/// Does no cone of another support contain the rays of this one?
fn is_maximal(cone: &SpannedCone, cones: &[SpannedCone]) -> bool {
    let mut others = cones.iter().filter(|other| other.support != cone.support);
    !others.any(|other| is_subset(&cone.rays, &other.rays))
}

fn is_subset(small: &[usize], large: &[usize]) -> bool {
    small.iter().all(|i| large.contains(i))
}

/// The elements of `set` that are not in `removed`, in their order.
fn without(set: &[usize], removed: &[usize]) -> Vec<usize> {
    let mut kept = set.to_vec();
    kept.retain(|i| !removed.contains(i));
    kept
}

/// All subsets; the k-th element of `set` belongs to those whose number has bit k.
pub fn subsets(set: &[usize]) -> Vec<Vec<usize>> {
    let mut all = Vec::new();

    for pattern in 0..1usize << set.len() {
        let mut subset = Vec::new();
        for (bit, &element) in set.iter().enumerate() {
            if pattern >> bit & 1 == 1 {
                subset.push(element);
            }
        }
        all.push(subset);
    }
    all
}

/// Do two vectors agree up to a positive factor?
pub fn same_ray(alpha: &mut Alpha, u: &[Polynomial], v: &[Polynomial]) -> bool {
    let Some(k) = (0..u.len()).find(|&k| !alpha.is_zero(&u[k])) else {
        return false;
    };

    for i in 0..u.len() {
        let difference = add(&multiply(&u[k], &v[i]), &negate(&multiply(&u[i], &v[k])));
        if !alpha.is_zero(&difference) {
            return false;
        }
    }
    alpha.sign(&u[k]) == alpha.sign(&v[k])
}

/// The rational number as a value to test at.
pub fn rational_value(numerator: i64, denominator: i64) -> Alpha {
    Alpha::rational(RBig::from(numerator) / RBig::from(denominator))
}
