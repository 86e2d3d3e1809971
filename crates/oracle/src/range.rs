//! Supports whose pencil is singular: for which values a solution with that support exists.
//!
//! Let V(t) span the kernel of the pencil on f and J over Q(t), and let G(t) hold the rows of V
//! that must be positive (x_J) and those of y = (A + tB) V that must be nonnegative. A solution
//! with support J exists at t exactly if some z has (G z)_J > 0 and G z >= 0 (and V z != 0).
//!
//! Which sign vectors G z takes depends only on the signs of the maximal minors of r independent
//! columns of G, r its rank: the covectors of an oriented matroid are determined by its chirotope
//! (Bjoerner, Las Vergnas, Sturmfels, White and Ziegler, Oriented Matroids, 1993, chapter 3). So
//! nothing changes between neighbouring roots of these minors and of the two minors that say where
//! V is a basis and where the rank is r. Hence the procedure, as in a cylindrical decomposition of
//! the line:
//!
//! 1. the *critical values* are the real roots of all these minors, and 0;
//! 2. one rational sample decides each open interval (*cell*) between, below and above them;
//! 3. each critical value is decided by the cone of its own (`cone`).
//!
//! Input: a support whose determinant vanishes identically, and the window. Called by `solution`.

use super::cone::cone_at;
use super::degenerate::{End, SupportRange, Undescribed, ValueInterval};
use super::enumeration::{Enumeration, WideKernel};
use super::integer_pencil::IntegerPencil;
use mceip_exact::{Algebraic, Poly, Rational, generic_kernel, minors, nonnegative_roots, roots_in};
use mceip_model::RealWindow;
use num_traits::{One as _, Zero as _};
use std::cmp::Ordering;

/// Most minors formed for one support: beyond it the support is named as undescribed.
pub const MAX_MINORS: usize = 4096;

/// Adds what one singular support has: its range of values, and what exists at isolated values
/// only.
pub(super) fn describe(
    pencil: &IntegerPencil<'_>,
    support: &[usize],
    window: &RealWindow,
    found: &mut Enumeration,
) {
    let generic = GenericKernel::of(pencil, support);
    let critical = match critical(pencil, support, &generic) {
        Ok(poly) => poly,
        Err(undescribed) => {
            found.undescribed.push(undescribed);
            return;
        }
    };

    let singular = SingularSupport { pencil, support };
    let extent = singular.extent(&critical);

    let mut pieces = Vec::new();
    let mut single_values = extent.isolated;
    for interval in extent.intervals {
        match clip(interval, window) {
            Some(Clipped::Interval(piece)) => pieces.push(piece),
            Some(Clipped::SingleValue(value)) => single_values.push(value),
            None => {}
        }
    }

    for value in single_values {
        if !is_within(&mut value.clone(), window) {
            continue;
        }
        let dimension = cone_at(pencil, support, &value).kernel_dimension;
        let kernel = WideKernel {
            value,
            support: support.to_vec(),
            dimension,
        };
        super::cone::describe(pencil, &kernel, found);
        if dimension > 1 {
            found.wide.push(kernel);
        }
    }

    if !pieces.is_empty() {
        found.ranges.push(SupportRange {
            support: support.to_vec(),
            pieces,
            kernel: generic.basis,
        });
    }
}

/// The kernel of a support's block over Q(t).
struct GenericKernel {
    /// Vectors over all variables.
    basis: Vec<Vec<Poly>>,
    /// A minor of the block: where it does not vanish, `basis` is a basis of the kernel at t.
    minor: Poly,
}

impl GenericKernel {
    fn of(pencil: &IntegerPencil<'_>, support: &[usize]) -> GenericKernel {
        let active = pencil.active(support);
        let (basis, _, minor) = generic_kernel(pencil.block(&active));
        let basis = basis.iter().map(|v| pencil.extend(&active, v)).collect();
        GenericKernel { basis, minor }
    }
}

/// A squarefree polynomial that vanishes at 0 and wherever the existence of solutions may change:
/// the least common multiple of t, the minor of the basis, the minor of the rank of G and the
/// maximal minors of G.
fn critical(
    pencil: &IntegerPencil<'_>,
    support: &[usize],
    generic: &GenericKernel,
) -> Result<Poly, Undescribed> {
    let mut rows = pencil.inequalities(support, &generic.basis);
    rows.retain(|row| row.iter().any(|entry| !entry.is_zero()));
    let (_, columns, rank_minor) = generic_kernel(rows.clone());

    let count = binomial(rows.len(), columns.len());

    if count > MAX_MINORS {
        return Err(Undescribed {
            support: support.to_vec(),
            minors: count,
            limit: MAX_MINORS,
        });
    }

    let t = Poly::from_ints(&[0, 1]);
    let mut factors = vec![t, generic.minor.clone(), rank_minor];
    factors.extend(minors(&rows, &columns)); // those that do not vanish identically

    let mut multiple = Poly::from_ints(&[1]);
    for factor in factors {
        let factor = factor.squarefree();
        let shared = multiple.gcd(&factor);
        let cofactor = factor.exact_div(&shared).unwrap_or(factor); // exact: the gcd divides
        multiple = &multiple * &cofactor;
    }

    Ok(multiple)
}

/// The number of choices of k among n, k <= n, or a large number instead of an overflow.
fn binomial(n: usize, k: usize) -> usize {
    let mut count: usize = 1;
    for chosen in 0..k {
        count = count.saturating_mul(n - chosen) / (chosen + 1);
    }
    count
}

/// The values at which something exists.
struct ValueSet {
    /// Maximal intervals.
    intervals: Vec<ValueInterval>,
    /// The other values.
    isolated: Vec<Algebraic>,
}

struct SingularSupport<'a> {
    pencil: &'a IntegerPencil<'a>,
    support: &'a [usize],
}

impl SingularSupport<'_> {
    /// Is there a solution with exactly this support at t?
    ///
    /// `slip` of a cone holds every variable that some vector of the cone has positive. The sum of
    /// such vectors is positive on all of them.
    fn exists_at(&self, t: &Algebraic) -> bool {
        let cone = cone_at(self.pencil, self.support, t);
        let is_whole_support = cone.slip == self.support;
        is_whole_support && cone.dimension > 0
    }

    /// Goes up through the critical values and the cells between them.
    fn extent(&self, critical: &Poly) -> ValueSet {
        // 0 is a root. The others are isolated on their side of it, so that how a positive value is
        // enclosed does not depend on the negative ones.
        let zero = Rational::zero();
        let mut below = roots_in(critical, None, Some(&zero));
        below.pop();
        let mut critical = [below, nonnegative_roots(critical)].concat();
        let mut extent = ValueSet {
            intervals: Vec::new(),
            isolated: Vec::new(),
        };

        // The interval that has begun and not yet ended.
        let mut begun: Option<ValueInterval> = None;
        let below_all = critical[0].interval().lo() - Rational::one();
        if self.exists_at(&Algebraic::rational(below_all)) {
            begun = Some(ValueInterval {
                from: None,
                to: None,
            });
        }

        for k in 0..critical.len() {
            let value = critical[k].clone();
            let exists_here = self.exists_at(&value);
            let cell = Algebraic::rational(sample_above(&mut critical, k));
            let exists_above = self.exists_at(&cell);

            if begun.is_some() && exists_here && exists_above {
                continue;
            }
            let end = End {
                value,
                included: exists_here,
            };
            if let Some(interval) = begun.take() {
                extent.intervals.push(ValueInterval {
                    to: Some(end.clone()),
                    ..interval
                });
                // If the cell above has solutions, the value itself has none: the next one begins.
                begun = exists_above.then(|| beginning_at(end));
            } else if exists_above {
                begun = Some(beginning_at(end));
            } else if exists_here {
                extent.isolated.push(end.value);
            }
        }

        extent.intervals.extend(begun);
        extent
    }
}

/// The interval from an end on.
fn beginning_at(end: End) -> ValueInterval {
    ValueInterval {
        from: Some(end),
        to: None,
    }
}

/// A rational number strictly between the k-th critical value and the next (or infinity).
fn sample_above(critical: &mut [Algebraic], k: usize) -> Rational {
    if k + 1 == critical.len() {
        return critical[k].interval().hi() + Rational::one();
    }

    // This ends, because the two numbers differ.
    while critical[k].interval().hi() >= critical[k + 1].interval().lo() {
        critical[k].refine();
        critical[k + 1].refine();
    }

    let below = critical[k].interval().hi();
    let above = critical[k + 1].interval().lo();

    (below + above) / Rational::from_integer(2.into())
}

fn is_within(value: &mut Algebraic, window: &RealWindow) -> bool {
    let is_above_min = window
        .min()
        .is_none_or(|min| value.cmp_rational(min).is_ge());
    let is_below_max = window
        .max()
        .is_none_or(|max| value.cmp_rational(max).is_le());
    is_above_min && is_below_max
}

/// The part of a piece in the closed window.
enum Clipped {
    Interval(ValueInterval),
    /// Solutions at one value are solutions or a cone, and no range.
    SingleValue(Algebraic),
}

/// The part of a piece in the closed window; `None` where they do not meet.
fn clip(mut piece: ValueInterval, window: &RealWindow) -> Option<Clipped> {
    if let Some(min) = window.min() {
        let is_cut = match &mut piece.from {
            Some(from) => from.value.cmp_rational(min) == Ordering::Less,
            None => true,
        };
        if is_cut {
            piece.from = Some(closed_end(min));
        }
    }

    if let Some(max) = window.max() {
        let is_cut = match &mut piece.to {
            Some(to) => to.value.cmp_rational(max) == Ordering::Greater,
            None => true,
        };
        if is_cut {
            piece.to = Some(closed_end(max));
        }
    }

    let (Some(from), Some(to)) = (&mut piece.from, &mut piece.to) else {
        return Some(Clipped::Interval(piece));
    };

    match from.value.cmp_exact(&mut to.value) {
        Ordering::Less => Some(Clipped::Interval(piece)),
        Ordering::Equal if from.included && to.included => {
            Some(Clipped::SingleValue(from.value.clone()))
        }
        Ordering::Equal | Ordering::Greater => None,
    }
}

fn closed_end(value: &Rational) -> End {
    End {
        value: Algebraic::rational(value.clone()),
        included: true,
    }
}
