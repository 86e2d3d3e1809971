//! The rows of A and B with denominators cleared, formed by the checker itself.
//!
//! Of a pencil they are the rows given, each multiplied by the least positive integer that makes
//! its entries in A and in B integers. A positive multiple of row i changes y_i by a positive
//! factor, so that (12)-(14) keep their solutions.
//!
//! Of a quadratic pencil A + tB + t^2 C they are those of the pencil of x and z = x / (1 + t), for
//! t >= 0 (`spec/certificates.md`, 5.2):
//!
//! ```text
//!     y / (1 + t) = ((B - C) + t C) x + (A - B + C) z,      0 = (1 + t) z - x
//! ```
//!
//! Of a mechanical system, the change of variables (10), (11) is read as two lists of vectors over
//! the degrees of freedom: v = T x with the columns
//!
//! ```text
//!     e_dof for a free dof,    -S t for a slip particle,                    // (10)
//! ```
//!
//! t its unit tangent, and y = P' w with the columns
//!
//! ```text
//!     e_dof for a free dof,    -(S t + mu n) for a slip particle,           // (11)
//! ```
//!
//! n its unit normal into the obstacle, times the friction factor c of the particle. On a curved
//! obstacle (`spec/curvature.md`) y has (1 + c^2 mu^2) g x more, g the product of its curvature and
//! the normal reaction. A particle in
//! contact with zero reaction has three variables (`spec/zero-reaction.md`, Z.3), with the columns
//!
//! ```text
//!     T:   -n,   t,           -t               P:   -n,   t - mu n,   -t - mu n
//! ```
//!
//! Then w = (K + lambda^2 M) v gives y = P' (K + lambda^2 M) T x. The block formulas (16) are not
//! used: `reduction` in the model crate does that, and a test holds the two equal, so that one
//! mistake cannot be in both.
//!
//! For certificates over a range of mu, [`FrictionParts`] keeps y = P' w without friction and the
//! coefficient of mu apart.
//!
//! Input: a [`Problem`], whose constructor has checked its shape. Every checker of a claim reads
//! the [`Rows`] made here.

use crate::reason::Reason;
use mceip_exact::{Integer, Rational, Sparse, cleared, common_denominator};
use mceip_model::{Body, ContactState, Direction, Particle, Problem, System, Unknown};
use num_traits::{One as _, Signed as _, Zero as _};
use std::collections::BTreeMap;

/// One row of A + tB with denominators cleared: (column, coefficient in A, coefficient in B).
pub(super) type Row = Vec<(usize, Integer, Integer)>;

/// One row of A or of B before that: (column, value).
pub(super) type RationalRow = Vec<(usize, Rational)>;

/// The two variables that v_T of a particle with zero reaction is split into, and its gap.
#[derive(Clone, Copy)]
pub(super) struct Halves {
    /// The particle.
    pub(super) particle: usize,
    /// Its variable -v_N.
    pub(super) gap: usize,
    /// The variable max(v_T, 0).
    pub(super) right: usize,
    /// The variable max(-v_T, 0).
    pub(super) left: usize,
}

/// The rows of the pencil, each multiplied by a positive integer, and the free variables.
#[derive(Clone)]
pub(super) struct Rows {
    pub(super) rows: Vec<Row>,
    /// The integer each row was multiplied by.
    pub(super) factor: Vec<Integer>,
    pub(super) is_free: Vec<bool>,
    /// One entry for each particle with zero reaction.
    pub(super) halves: Vec<Halves>,
}

impl Rows {
    pub(super) fn of(problem: &Problem) -> Rows {
        match problem.body() {
            Body::Pencil(pencil) => {
                let mut rows = Rows::with_capacity(pencil.order());
                for i in 0..pencil.order() {
                    let is_free = pencil.free().binary_search(&i).is_ok();
                    rows.push(pencil.a().row(i), pencil.b().row(i), is_free);
                }

                rows
            }
            Body::Quadratic(quadratic) => {
                let [a, b, c] = quadratic.coefficients();
                of_quadratic(a, b, c)
            }
            Body::System(system) => of_system(system, problem.unknown()),
        }
    }

    /// The rows of the reflected problem: of (A, -B), or of (A, -B, C).
    pub(super) fn reflected(&self, problem: &Problem) -> Rows {
        match problem.body() {
            // Not the rows of (A', -B'): there z would be x / (1 - s).
            Body::Quadratic(quadratic) => {
                let [a, b, c] = quadratic.coefficients();
                of_quadratic(a, &b.negated(), c)
            }
            Body::Pencil(_) | Body::System(_) => {
                let mut reflected = self.clone();
                for (_, _, b) in reflected.rows.iter_mut().flatten() {
                    *b = -&*b;
                }

                reflected
            }
        }
    }

    fn with_capacity(order: usize) -> Rows {
        Rows {
            rows: Vec::with_capacity(order),
            factor: Vec::with_capacity(order),
            is_free: Vec::with_capacity(order),
            halves: Vec::new(),
        }
    }

    /// Joins a row of A and a row of B and clears their denominators.
    fn push(&mut self, a: &[(usize, Rational)], b: &[(usize, Rational)], is_free: bool) {
        let factor = common_denominator(a.iter().chain(b).map(|(_, value)| value));
        self.push_multiple(a, b, factor, is_free);
    }

    /// Joins a row of A and a row of B and multiplies them by a factor that clears their
    /// denominators.
    fn push_multiple(
        &mut self,
        a: &[(usize, Rational)],
        b: &[(usize, Rational)],
        factor: Integer,
        is_free: bool,
    ) {
        let mut entries: BTreeMap<usize, (Integer, Integer)> = BTreeMap::new();
        for (column, value) in a {
            entries.entry(*column).or_default().0 += cleared(value, &factor);
        }

        for (column, value) in b {
            entries.entry(*column).or_default().1 += cleared(value, &factor);
        }

        let row = entries.into_iter().map(|(column, (a, b))| (column, a, b));
        self.rows.push(row.collect());
        self.factor.push(factor);
        self.is_free.push(is_free);
    }

    /// B + sA: the same solutions at s = 1 / t.
    pub(super) fn reversed(&self) -> Rows {
        let mut rows = Vec::with_capacity(self.order());
        for row in &self.rows {
            let exchanged = row.iter().map(|(j, a, b)| (*j, b.clone(), a.clone()));
            rows.push(exchanged.collect());
        }

        Rows {
            rows,
            factor: self.factor.clone(),
            is_free: self.is_free.clone(),
            halves: self.halves.clone(),
        }
    }

    pub(super) fn order(&self) -> usize {
        self.rows.len()
    }

    /// The indices of the complementarity variables.
    pub(super) fn complementarity_variables(&self) -> Vec<usize> {
        (0..self.order()).filter(|&i| !self.is_free[i]).collect()
    }

    /// The variables off a support whose y vanishes with those of the support.
    ///
    /// The rows of a particle with zero reaction satisfy, for every v,
    ///
    /// ```text
    ///     y_right + y_left = (t - c mu n)'w + (-t - c mu n)'w = 2 c mu (-n'w) = 2 c mu y_gap.
    /// ```
    ///
    /// So where the gap and one half are in the support, y = 0 at the other half.
    pub(super) fn vanishing(&self, support: &[usize]) -> Vec<usize> {
        let mut list = Vec::new();
        for halves in &self.halves {
            if !support.contains(&halves.gap) {
                continue;
            }

            match (
                support.contains(&halves.right),
                support.contains(&halves.left),
            ) {
                (true, false) => list.push(halves.left),
                (false, true) => list.push(halves.right),
                _ => {}
            }
        }

        list
    }

    /// The other half of v_T, if the variable is one of a particle with zero reaction.
    pub(super) fn other_half(&self, variable: usize) -> Option<usize> {
        for halves in &self.halves {
            if variable == halves.right {
                return Some(halves.left);
            }
            if variable == halves.left {
                return Some(halves.right);
            }
        }

        None
    }

    /// Refuses evidence that is not defined for particles with zero reaction.
    pub(super) fn without_zero(&self, what: &'static str) -> Result<(), Reason> {
        match self.halves.first() {
            None => Ok(()),
            Some(halves) => Err(Reason::ZeroReaction {
                what,
                particle: halves.particle,
            }),
        }
    }
}

/// The rows of the linear form of A + tB + t^2 C: first those of y / (1 + t), then those of z.
fn of_quadratic(a: &Sparse, b: &Sparse, c: &Sparse) -> Rows {
    let n = a.rows();
    let one = Rational::one();
    let mut rows = Rows::with_capacity(2 * n);
    for i in 0..n {
        let mut constant: BTreeMap<usize, Rational> = BTreeMap::new();
        let mut slope = RationalRow::new();
        for (j, a_ij) in a.row(i) {
            *constant.entry(n + j).or_default() += a_ij;
        }
        for (j, b_ij) in b.row(i) {
            *constant.entry(*j).or_default() += b_ij;
            *constant.entry(n + j).or_default() -= b_ij;
        }
        for (j, c_ij) in c.row(i) {
            *constant.entry(*j).or_default() -= c_ij;
            *constant.entry(n + j).or_default() += c_ij;
            slope.push((*j, c_ij.clone()));
        }

        constant.retain(|_, value| !value.is_zero());
        rows.push(&Vec::from_iter(constant), &slope, false);
    }
    for i in 0..n {
        let x_i = (i, -&one);
        let z_i = (n + i, one.clone());
        rows.push(&[x_i, z_i.clone()], &[z_i], true);
    }

    rows
}

/// The pencils T0 and T1 of a mechanical system with T(t, mu) = T0(t) + mu T1(t) in the rows of
/// complementarity variables.
///
/// The free rows do not depend on mu: they stand in both. Row i of both has the same factor.
pub(super) struct FrictionParts {
    /// Without friction: the rows p'(K + tM) T with the columns p of P at mu = 0.
    pub(super) plain: Rows,
    /// The coefficient of mu: the rows -c n'(K + tM) T of slip particles and of halves of v_T, and
    /// zero in the row of a gap.
    pub(super) friction: Rows,
    /// The same of the system in which the particles with zero reaction are free, if it has any.
    with_zero_free: Option<Box<FrictionParts>>,
    /// How far the members of the problem may be from these, if it is posed on more than one body.
    pub(super) radii: Option<MemberRadii>,
}

/// How far T0 and T1 of a member may be from those in the middle of all members: |p'R T| entry by
/// entry with |p|, R and |T|, and a share of the friction rows.
pub(super) struct MemberRadii {
    /// Each row with the factor of its row in the middle.
    pub(super) plain: Rows,
    pub(super) friction: Rows,
    /// By complementarity variable: the friction row of a member is that row with the data of the
    /// member and the factor in the middle, times 1 + d with |d| at most this.
    pub(super) relative: Vec<Rational>,
}

impl MemberRadii {
    /// Those of T0 and of T1.
    pub(super) fn of_parts(&self) -> [&Rows; 2] {
        [&self.plain, &self.friction]
    }
}

impl FrictionParts {
    /// Those in the middle of all members ([`System::middle`]).
    pub(super) fn of(system: &System, mass: &Sparse) -> FrictionParts {
        if system.is_exact() {
            return FrictionParts::about(system, mass, None);
        }

        let radii = RadiiOfBody::of(system);
        FrictionParts::about(&system.middle(), mass, Some(&radii))
    }

    fn about(system: &System, mass: &Sparse, radii: Option<&RadiiOfBody>) -> FrictionParts {
        let variables = Variables::of(system);
        let stiffness = system.stiffness();
        let order = variables.columns.len();
        let mut parts = FrictionParts {
            plain: Rows::with_capacity(order),
            friction: Rows::with_capacity(order),
            with_zero_free: None,
            radii: radii.map(|radii| MemberRadii {
                plain: Rows::with_capacity(order),
                friction: Rows::with_capacity(order),
                relative: radii.relative.clone(),
            }),
        };
        let magnitudes = variables.trial.magnitudes();

        for (i, plain) in variables.rows.iter().enumerate() {
            let is_free = i < variables.free;
            let friction = if is_free {
                plain
            } else {
                &variables.friction[i]
            };

            let plain_a = variables.reduced(plain, stiffness);
            let plain_b = variables.reduced(plain, mass);
            let friction_a = variables.reduced(friction, stiffness);
            let friction_b = variables.reduced(friction, mass);

            let reach =
                |row: &Direction, radius: &Sparse| magnitudes.reduced(&absolute(row), radius);
            let of_radii = radii.map(
                |RadiiOfBody {
                     stiffness, mass, ..
                 }| {
                    [
                        [reach(plain, stiffness), reach(plain, mass)],
                        [reach(friction, stiffness), reach(friction, mass)],
                    ]
                },
            );

            let middle = [&plain_a, &plain_b, &friction_a, &friction_b];
            let beside = of_radii.iter().flatten().flatten();
            let all = middle.into_iter().chain(beside).flatten();
            let factor = common_denominator(all.map(|(_, value)| value));
            if let (Some(radii), Some([plain, friction])) = (&mut parts.radii, &of_radii) {
                for (rows, [a, b]) in [(&mut radii.plain, plain), (&mut radii.friction, friction)] {
                    rows.push_multiple(a, b, factor.clone(), is_free);
                }
            }
            parts
                .plain
                .push_multiple(&plain_a, &plain_b, factor.clone(), is_free);
            parts
                .friction
                .push_multiple(&friction_a, &friction_b, factor, is_free);
        }

        if !variables.halves.is_empty() {
            let freed = FrictionParts::about(&system.with_zero_free(), mass, radii);
            parts.with_zero_free = Some(Box::new(freed));
        }

        parts.plain.halves = variables.halves.clone();
        parts.friction.halves = variables.halves;
        parts
    }

    /// The parts that a tail is about: particles with zero reaction are free in them.
    pub(super) fn of_tail(&self) -> &FrictionParts {
        self.with_zero_free.as_deref().unwrap_or(self)
    }

    /// The pencil at a friction mu = p/q: q T0 + p T1 in the slip rows, times the denominator of
    /// what the friction row of a member may be off.
    pub(super) fn at(&self, mu: &Rational) -> Rows {
        let [p, q] = [mu.numer(), mu.denom()];
        self.with_slip_rows(&self.plain, q, |i, share| {
            let plain = (&self.plain.rows[i], &(q * share.denom()));
            let friction = (&self.friction.rows[i], &(p * share.denom()));
            sum_of_rows([plain, friction])
        })
    }

    /// How far the pencil of a member at a friction mu may be from [`FrictionParts::at`], row by
    /// row in its units: R0 + mu ((1 + d) R1 + d |T1|), where d is the share of the friction row.
    /// `None` for one body.
    pub(super) fn radius_at(&self, mu: &Rational) -> Option<Rows> {
        let radii = self.radii.as_ref()?;
        let [p, q] = [mu.numer(), mu.denom()];
        Some(self.with_slip_rows(&radii.plain, q, |i, share| {
            let friction = self.friction.rows[i].iter();
            let magnitudes: Row = friction.map(|(j, a, b)| (*j, a.abs(), b.abs())).collect();
            let enlarged = p * (share.denom() + share.numer());
            sum_of_rows([
                (&radii.plain.rows[i], &(q * share.denom())),
                (&radii.friction.rows[i], &enlarged),
                (&magnitudes, &(p * share.numer())),
            ])
        }))
    }

    /// The rows of `plain` with other slip rows, which `row` makes of their number and of the share
    /// of their friction row, times the denominators of that share and of mu.
    fn with_slip_rows(
        &self,
        plain: &Rows,
        denominator: &Integer,
        row: impl Fn(usize, &Rational) -> Row,
    ) -> Rows {
        let mut rows = plain.clone();
        let slip = self.plain.complementarity_variables();
        for (position, i) in slip.into_iter().enumerate() {
            let share = self.share(position);
            rows.rows[i] = row(i, &share);
            rows.factor[i] *= denominator * share.denom();
        }

        rows
    }

    /// The share by which the friction row of a slip variable may be off.
    fn share(&self, slip: usize) -> Rational {
        match &self.radii {
            Some(radii) => radii.relative[slip].clone(),
            None => Rational::from_integer(0.into()),
        }
    }
}

/// The sum of rows, each times a factor.
fn sum_of_rows<const N: usize>(parts: [(&Row, &Integer); N]) -> Row {
    let mut entries: BTreeMap<usize, (Integer, Integer)> = BTreeMap::new();
    for (row, factor) in parts {
        for (column, a, b) in row {
            let entry = entries.entry(*column).or_default();
            entry.0 += a * factor;
            entry.1 += b * factor;
        }
    }

    let row = entries.into_iter().map(|(column, (a, b))| (column, a, b));
    row.collect()
}

/// The rows of y = P' (K + lambda^2 M) T x, or of y = P' K T x with mu as the unknown.
fn of_system(system: &System, unknown: Unknown) -> Rows {
    let variables = Variables::of(system);
    let stiffness = system.stiffness();
    let mut rows = Rows::with_capacity(variables.columns.len());

    for (i, plain) in variables.rows.iter().enumerate() {
        let friction = &variables.friction[i];

        let (a, b) = match (unknown, system.mass(), system.friction()) {
            (Unknown::Lambda2, Some(mass), Some(mu)) => {
                let mut p = plain.clone();
                p.extend(scale(friction, mu));
                let mut of_stiffness: BTreeMap<usize, Rational> =
                    variables.reduced(&p, stiffness).into_iter().collect();
                if let Some(turning) = variables.turning(i, mu) {
                    *of_stiffness.entry(i).or_default() += turning;
                }
                (
                    of_stiffness.into_iter().collect(),
                    variables.reduced(&p, mass),
                )
            }
            // For MCEIP-mu the friction part is the coefficient of the unknown.
            _ => (
                variables.reduced(plain, stiffness),
                variables.reduced(friction, stiffness),
            ),
        };
        rows.push(&a, &b, i < variables.free);
    }

    rows.halves = variables.halves;
    rows
}

/// The changes of variables v = T x and y = P' w.
struct Variables {
    /// The number of free degrees of freedom: these variables come first.
    free: usize,
    /// Columns of T.
    columns: Vec<Direction>,
    /// Columns of P without friction.
    rows: Vec<Direction>,
    /// What friction adds to each column of P, divided by mu.
    friction: Vec<Direction>,
    /// The particles that slip, whose variables follow the free ones.
    slip: Vec<Particle>,
    /// One entry for each particle with zero reaction.
    halves: Vec<Halves>,
    /// T by rows.
    trial: Trial,
}

impl Variables {
    fn of(system: &System) -> Variables {
        let one = Rational::from_integer(1.into());
        let minus_one = -&one;

        let free_dofs: Vec<usize> = system.free_dofs();
        let mut columns: Vec<Direction> =
            free_dofs.iter().map(|&d| vec![(d, one.clone())]).collect();
        let mut rows = columns.clone();
        let mut friction: Vec<Direction> = vec![Vec::new(); free_dofs.len()];

        let mut slip = Vec::new();
        for (particle, sign) in system.slip_particles() {
            slip.push(particle.clone());
            let minus_s = Rational::from_integer((-sign).into());
            columns.push(scale(&particle.tangent(), &minus_s)); // (10): v_T = -S x
            rows.push(scale(&particle.tangent(), &minus_s)); // (11): y = -(S w_T + mu w_N)
            friction.push(scale(&particle.friction_direction(), &minus_one));
        }

        let mut halves = Vec::new();
        for (index, particle) in system.particles().iter().enumerate() {
            if particle.state != ContactState::Zero {
                continue;
            }

            let gap = columns.len();
            halves.push(Halves {
                particle: index,
                gap,
                right: gap + 1,
                left: gap + 2,
            });

            let tangent = particle.tangent();
            let opening = scale(&particle.into_obstacle(), &minus_one);
            let against = scale(&particle.friction_direction(), &minus_one);
            for (column, of_friction) in [
                (opening, Vec::new()),
                (tangent.clone(), against.clone()),
                (scale(&tangent, &minus_one), against),
            ] {
                columns.push(column.clone());
                rows.push(column);
                friction.push(of_friction);
            }
        }

        Variables {
            free: free_dofs.len(),
            trial: Trial::of(&columns, system.dofs()),
            columns,
            rows,
            friction,
            slip,
            halves,
        }
    }

    /// The row p' M T.
    fn reduced(&self, p: &Direction, matrix: &Sparse) -> RationalRow {
        self.trial.reduced(p, matrix)
    }

    /// The factor (1 + c^2 mu^2) g of x_i in row i, where i slips along a curved obstacle.
    fn turning(&self, i: usize, mu: &Rational) -> Option<Rational> {
        let particle = self.slip.get(i.checked_sub(self.free)?)?;
        particle.curvature.as_ref()?;
        Some(turning_stiffness(particle, mu))
    }
}

/// (1 + c^2 mu^2) g, where the reaction of a particle turns along a curved obstacle. The reduction
/// of the model crate forms it by itself.
pub(super) fn turning_stiffness(particle: &Particle, mu: &Rational) -> Rational {
    let friction = mu * &particle.friction_factor;
    (Rational::one() + &friction * &friction) * particle.geometric_stiffness()
}

/// R_K and R_M of a body, and how far its friction factors are from their middle.
struct RadiiOfBody {
    stiffness: Sparse,
    mass: Sparse,
    /// By slip particle.
    relative: Vec<Rational>,
}

impl RadiiOfBody {
    fn of(system: &System) -> RadiiOfBody {
        let order = system.dofs();
        let given = |radius: &Option<Sparse>| match radius {
            Some(radius) => radius.clone(),
            None => Sparse::zeros(order, order),
        };

        let slip = system.slip_particles().into_iter();
        RadiiOfBody {
            stiffness: given(&system.radii().stiffness),
            mass: given(&system.radii().mass),
            relative: slip.map(|(p, _)| p.friction_factor_ball().1).collect(),
        }
    }
}

/// T by rows: for each degree of freedom, the variables that move it and by how much.
pub(super) struct Trial {
    moved_by: Vec<RationalRow>,
}

impl Trial {
    /// From the columns of T, directions over so many degrees of freedom.
    pub(super) fn of(columns: &[Direction], dofs: usize) -> Trial {
        let mut moved_by: Vec<RationalRow> = vec![Vec::new(); dofs];
        for (j, column) in columns.iter().enumerate() {
            for (dof, c) in column {
                moved_by[*dof].push((j, c.clone()));
            }
        }

        Trial { moved_by }
    }

    /// |T|.
    fn magnitudes(&self) -> Trial {
        Trial {
            moved_by: self.moved_by.iter().map(|row| absolute(row)).collect(),
        }
    }

    /// The row p' M T.
    pub(super) fn reduced(&self, p: &Direction, matrix: &Sparse) -> RationalRow {
        let mut row: BTreeMap<usize, Rational> = BTreeMap::new();
        for (d, p_d) in p {
            for (e, m_de) in matrix.row(*d) {
                for (j, t_ej) in &self.moved_by[*e] {
                    *row.entry(*j).or_default() += p_d * m_de * t_ej;
                }
            }
        }

        row.into_iter().collect()
    }
}

/// The absolute values of a direction or a row.
fn absolute(row: &[(usize, Rational)]) -> Vec<(usize, Rational)> {
    row.iter()
        .map(|(index, value)| (*index, value.abs()))
        .collect()
}

/// The direction times a number.
pub(super) fn scale(direction: &Direction, factor: &Rational) -> Direction {
    direction
        .iter()
        .map(|(dof, c)| (*dof, c * factor))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};
    use mceip_model::reduction::reduce;
    use mceip_model::{Curvature, Pencil, QuadraticPencil, Window};

    /// A symmetric matrix of order 6 with entries from -3 to 3 over `denominator`, and `diagonal`
    /// added to its diagonal.
    fn symmetric(diagonal: i64, denominator: i64) -> Sparse {
        let mut entries = Vec::new();
        for i in 0..6 {
            for j in 0..6 {
                let digit = (3 * i.min(j) + 5 * i.max(j)) % 7;
                let value = rational(digit as i64 - 3, denominator);
                let shift = whole(if i == j { diagonal } else { 0 });
                entries.push((i, j, value + shift));
            }
        }
        Sparse::from_entries(6, 6, entries)
    }

    /// An oblique particle (3/5, 4/5), one along the axes with the friction factor 5/3, and two
    /// free degrees of freedom.
    fn system(second: ContactState) -> System {
        let oblique = Particle {
            frame: Some([
                [rational(3, 5), rational(4, 5)],
                [rational(-4, 5), rational(3, 5)],
            ]),
            ..Particle::plain(0, 1, ContactState::Slip { sign: 1 })
        };
        let along_the_axes = Particle {
            normal_direction: -1,
            friction_factor: rational(5, 3),
            ..Particle::plain(4, 5, second)
        };
        System::new(
            symmetric(40, 1),
            Some(symmetric(9, 3)),
            Some(rational(2, 7)),
            vec![oblique, along_the_axes],
        )
        .unwrap()
    }

    /// Demands that row i of `rows` is its factor times row i of the pencil.
    fn assert_row(rows: &Rows, pencil: &Pencil, i: usize) {
        let factor = Rational::from_integer(rows.factor[i].clone());
        let mut a = RationalRow::new();
        let mut b = RationalRow::new();
        for (j, a_j, b_j) in &rows.rows[i] {
            a.push((*j, Rational::from_integer(a_j.clone())));
            b.push((*j, Rational::from_integer(b_j.clone())));
        }
        a.retain(|(_, v)| *v != whole(0));
        b.retain(|(_, v)| *v != whole(0));

        assert_eq!(rows.is_free[i], pencil.free().contains(&i));
        assert_eq!(a, scale(&pencil.a().row(i).to_vec(), &factor));
        assert_eq!(b, scale(&pencil.b().row(i).to_vec(), &factor));
    }

    /// Row i of A and of B without its factor, all columns.
    fn given_row(rows: &Rows, i: usize) -> [Vec<Rational>; 2] {
        let mut given = [vec![whole(0); rows.order()], vec![whole(0); rows.order()]];
        for (j, a, b) in &rows.rows[i] {
            given[0][*j] = Rational::new(a.clone(), rows.factor[i].clone());
            given[1][*j] = Rational::new(b.clone(), rows.factor[i].clone());
        }
        given
    }

    fn sum(u: &[Rational], v: &[Rational]) -> Vec<Rational> {
        u.iter().zip(v).map(|(a, b)| a + b).collect()
    }

    fn times(v: &[Rational], factor: &Rational) -> Vec<Rational> {
        v.iter().map(|entry| entry * factor).collect()
    }

    /// y_right + y_left = 2 c mu y_gap: with mu of the file in A and in B, and with mu as the
    /// unknown, where the gap's row of A is in B. What vanishes follows from it.
    #[test]
    fn the_rows_of_both_halves_add_up_to_that_of_the_gap() {
        let twice_c = rational(10, 3);
        for unknown in [Unknown::Lambda2, Unknown::Mu] {
            let body = Body::System(system(ContactState::Zero));
            let problem = Problem::new(body, unknown, Window::all()).unwrap();
            let rows = Rows::of(&problem);
            let Halves {
                gap, right, left, ..
            } = rows.halves[0];

            let [gap_a, gap_b] = given_row(&rows, gap);
            let [right_a, right_b] = given_row(&rows, right);
            let [left_a, left_b] = given_row(&rows, left);
            let expected = match unknown {
                Unknown::Lambda2 | Unknown::Eigenvalue => {
                    let factor = &twice_c * rational(2, 7);
                    [times(&gap_a, &factor), times(&gap_b, &factor)]
                }
                Unknown::Mu => [times(&gap_a, &whole(0)), times(&gap_a, &twice_c)],
            };
            assert_eq!([sum(&right_a, &left_a), sum(&right_b, &left_b)], expected);

            assert_eq!(rows.vanishing(&[gap, right]), [left]);
            assert_eq!(rows.vanishing(&[gap, left]), [right]);
            assert!(rows.vanishing(&[gap]).is_empty());
            assert!(rows.vanishing(&[right]).is_empty());
        }
    }

    /// With zero reaction: the split form of `reduction`.
    #[test]
    fn the_pencil_is_the_split_form() {
        for unknown in [Unknown::Lambda2, Unknown::Mu] {
            let body = Body::System(system(ContactState::Zero));
            let problem = Problem::new(body, unknown, Window::all()).unwrap();
            let split = reduce(&problem).unwrap();

            let rows = Rows::of(&problem);

            assert_eq!(rows.order(), split.pencil.order());
            for i in 0..rows.order() {
                assert_row(&rows, &split.pencil, i);
            }
            let [halves] = rows.halves[..] else {
                panic!("one particle with zero reaction")
            };
            assert_eq!(halves.particle, 1);
            assert_eq!(halves.gap, split.zero[0].gap);
            assert_eq!(halves.right, split.zero[0].right);
            assert_eq!(halves.left, split.zero[0].left);
        }
    }

    /// A row of A and of B divided by its factor.
    fn as_given(rows: &Rows, i: usize) -> (RationalRow, RationalRow) {
        let mut a = RationalRow::new();
        let mut b = RationalRow::new();
        for (j, a_j, b_j) in &rows.rows[i] {
            a.push((*j, Rational::new(a_j.clone(), rows.factor[i].clone())));
            b.push((*j, Rational::new(b_j.clone(), rows.factor[i].clone())));
        }
        a.retain(|(_, v)| *v != whole(0));
        b.retain(|(_, v)| *v != whole(0));
        (a, b)
    }

    /// T0 + mu T1 is the pencil of the system with the friction mu, whatever that of the file.
    #[test]
    fn the_parts_give_the_pencil_of_every_friction() {
        let of_file = system(ContactState::Slip { sign: -1 });
        let mass = of_file.mass().unwrap();
        let parts = FrictionParts::of(&of_file, mass);
        assert_eq!(parts.plain.factor, parts.friction.factor);

        for mu in [rational(2, 7), whole(1), rational(31, 3)] {
            let particles = of_file.particles().to_vec();
            let stiffness = of_file.stiffness().clone();
            let friction = Some(mu.clone());
            let other = System::new(stiffness, Some(mass.clone()), friction, particles).unwrap();
            let problem =
                Problem::new(Body::System(other), Unknown::Lambda2, Window::all()).unwrap();

            let expected = Rows::of(&problem);
            let rows = parts.at(&mu);
            assert_eq!(rows.is_free, expected.is_free);
            for i in 0..expected.order() {
                assert_eq!(as_given(&rows, i), as_given(&expected, i), "{mu}, row {i}");
            }
        }
    }

    /// Both particles on curved obstacles, one convex and one hollow, beside zero reaction too.
    #[test]
    fn the_pencil_has_what_turns_along_curved_obstacles() {
        for second in [ContactState::Slip { sign: -1 }, ContactState::Zero] {
            let flat = system(second);
            let mut particles = flat.particles().to_vec();
            for (particle, value) in particles.iter_mut().zip([rational(3, 7), whole(-2)]) {
                particle.curvature =
                    matches!(particle.state, ContactState::Slip { .. }).then(|| Curvature {
                        value,
                        normal_reaction: rational(-5, 2),
                    });
            }
            let of = |system: System| {
                Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
            };
            let problem = of(flat.with_particles(particles).unwrap());

            let rows = Rows::of(&problem);
            let pencil = reduce(&problem).unwrap().pencil;
            for i in 0..rows.order() {
                assert_row(&rows, &pencil, i);
            }

            // (1 + (2/7)^2) (3/7) (-5/2), and (1 + (5/3 2/7)^2) (-2) (-5/2).
            let of_flat = reduce(&of(flat)).unwrap().pencil;
            let added = |i: usize| pencil.a().get(i, i) - of_flat.a().get(i, i);
            assert_eq!(added(2), rational(53 * 3 * -5, 49 * 7 * 2));
            if second != ContactState::Zero {
                assert_eq!(added(3), rational(541 * 5, 441));
            }
        }
    }

    /// The linear form that the model makes, of the problem and of its reflection.
    #[test]
    fn the_rows_of_a_quadratic_pencil_are_its_linear_form() {
        let matrix = |seed: i64| {
            let entry = |i: i64, j: i64| rational((seed + 5 * i * i + 3 * j) % 7 - 3, 1 + i);
            let places = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
            let entries = places.map(|(i, j)| (i as usize, j as usize, entry(i, j)));
            Sparse::from_entries(3, 3, entries)
        };
        let quadratic = QuadraticPencil::new(matrix(1), matrix(2), matrix(4)).unwrap();
        let body = Body::Quadratic(quadratic.clone());
        let problem = Problem::new(body, Unknown::Eigenvalue, Window::all()).unwrap();

        let rows = Rows::of(&problem);
        let reflected = rows.reflected(&problem);
        let linear = quadratic.linear_form().unwrap();
        let reflected_form = quadratic.reflected().linear_form().unwrap();
        assert_ne!(linear, reflected_form);
        for (rows, form) in [(rows, linear), (reflected, reflected_form)] {
            assert_eq!(rows.order(), 6);
            for i in 0..6 {
                assert_row(&rows, &form, i);
            }
        }
    }

    /// Without zero reaction.
    #[test]
    fn the_pencil_is_the_reduced_one() {
        for unknown in [Unknown::Lambda2, Unknown::Mu] {
            let body = Body::System(system(ContactState::Slip { sign: -1 }));
            let problem = Problem::new(body, unknown, Window::all()).unwrap();

            let rows = Rows::of(&problem);
            let pencil = reduce(&problem).unwrap().pencil;

            assert_eq!(rows.order(), pencil.order());
            for i in 0..rows.order() {
                assert_row(&rows, &pencil, i);
            }
        }
    }
}
