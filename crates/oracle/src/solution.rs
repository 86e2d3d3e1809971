//! What the enumerator finds: solutions by their exact support, cones, ranges, and what it met on
//! the way.
//!
//! A [`Solution`] is t and x with y = (A + tB) x, up to one positive factor. t is an algebraic
//! number, the entries of x and y are integer polynomials to be evaluated at it; so every question
//! about a solution is a sign of a polynomial at an algebraic number.
//!
//! An [`Enumeration`] collects them. It is filled in two steps: `plain` names what it meets
//! (kernels of more than one dimension, singular supports), [`Enumeration::describe`] says what
//! these hold.

use super::integer_pencil::IntegerPencil;
use super::{Cone, SupportRange, Undescribed, cone, range};
use mceip_exact::{Algebraic, Poly, Sign, ratio_to_decimal, to_decimal};
use mceip_model::{Pencil, Window};
use std::cmp::Ordering;

/// One solution of (12)-(14) or (21)-(23), up to the positive factor that x and y share.
///
/// x and y are integer polynomials to be evaluated at `value`; each entry of y carries the scale
/// of its (positively scaled) row, so only its sign is meaningful against the given matrices.
#[derive(Debug, Clone)]
pub struct Solution {
    /// t: lambda^2 or mu.
    pub value: Algebraic,
    /// How often `value` is a root of the determinant of its support; 0 where that vanishes
    /// identically.
    pub multiplicity: usize,
    /// Indices of complementarity variables with x_i > 0, ascending.
    pub slip: Vec<usize>,
    /// Indices of complementarity variables with x_i = y_i = 0, ascending.
    pub biactive: Vec<usize>,
    /// x over all variables of the pencil.
    pub x: Vec<Poly>,
    /// Positive multiple of y_i for each variable of the pencil.
    pub y: Vec<Poly>,
}

impl Solution {
    /// Is x_s = 0? The hypotheses of Propositions 1 and 2 (K_ff, for lambda^2 also M_ff, definite)
    /// exclude such solutions, so they occur for raw pencils only, and the MCP does not find them.
    pub fn is_free_only(&self) -> bool {
        self.slip.is_empty()
    }

    /// The value as a decimal with `digits` correctly rounded significant digits.
    pub fn decimal(&self, digits: usize) -> String {
        let t = Poly::from_ints(&[0, 1]);
        to_decimal(&mut self.value.clone(), &t, digits)
    }

    /// x scaled to e'x_s = 1 (l1 norm 1 where x_s = 0), each entry correctly rounded.
    ///
    /// `constrained` lists the complementarity variables of the pencil.
    pub fn x_decimals(&self, constrained: &[usize], digits: usize) -> Vec<String> {
        let mut value = self.value.clone();
        let norm = self.normaliser(constrained);
        self.x
            .iter()
            .map(|x_i| ratio_to_decimal(&mut value, x_i, &norm, digits))
            .collect()
    }

    /// The polynomial whose value x is divided by: e'x_s, or the l1 norm for free-only solutions.
    ///
    /// `constrained` lists the complementarity variables of the pencil.
    pub fn normaliser(&self, constrained: &[usize]) -> Poly {
        let mut norm = Poly::default();

        if !self.is_free_only() {
            for &i in constrained {
                norm += &self.x[i];
            }
            return norm;
        }

        let mut value = self.value.clone();
        for x_i in &self.x {
            if value.sign_of(x_i) == Sign::Negative {
                norm += &-x_i;
            } else {
                norm += x_i;
            }
        }
        norm
    }
}

/// A support and value whose kernel has more than one dimension, as met; [`Enumeration::cones`] and
/// [`Enumeration::solutions`] say what it holds.
#[derive(Debug, Clone)]
pub struct WideKernel {
    /// The value.
    pub value: Algebraic,
    /// The complementarity variables assumed to slip.
    pub support: Vec<usize>,
    /// Dimension of the kernel.
    pub dimension: usize,
}

/// Everything the enumerator found in the window, in canonical order: by value, then by slip set.
#[derive(Debug, Clone, Default)]
pub struct Enumeration {
    /// Solutions that are the only ones with their value and support.
    pub solutions: Vec<Solution>,
    /// Maximal cones of dimension > 1.
    pub cones: Vec<Cone>,
    /// Supports that have a solution for whole intervals of values, by support.
    pub ranges: Vec<SupportRange>,
    /// Singular supports left undescribed, by support.
    pub undescribed: Vec<Undescribed>,
    /// Kernels of dimension > 1 that were met.
    pub wide: Vec<WideKernel>,
    /// Supports whose pencil is singular: every t is an eigenvalue of them.
    pub continua: Vec<Vec<usize>>,
    /// Supports examined.
    pub supports_done: u64,
    /// Supports there are: 2^n_s.
    pub supports_total: u64,
    /// How many of `wide` and of `continua` have been described.
    pub described: (usize, usize),
}

impl Enumeration {
    /// Were all supports examined?
    pub fn is_finished(&self) -> bool {
        self.supports_done == self.supports_total
    }

    /// Is this the complete answer: all supports examined, and everything met described?
    pub fn is_complete_list(&self) -> bool {
        self.is_finished()
            && self.described == (self.wide.len(), self.continua.len())
            && self.undescribed.is_empty()
    }

    /// Is the answer a plain list: nothing but `solutions`?
    pub fn is_plain_list(&self) -> bool {
        self.is_complete_list() && self.cones.is_empty() && self.ranges.is_empty()
    }

    /// Is there a solution with x_s = 0, which Propositions 1 and 2 exclude by their hypotheses?
    pub fn is_outside_propositions(&self) -> bool {
        self.solutions.iter().any(Solution::is_free_only)
            || self
                .cones
                .iter()
                .any(|cone| cone.slip.is_empty() || !cone.lineality.is_empty())
            || self.ranges.iter().any(|range| range.support.is_empty())
    }

    /// Dimension of the kernel that a listed solution comes from: 1 unless it was met as a wide
    /// kernel.
    pub fn kernel_dimension(&self, solution: &Solution) -> usize {
        self.wide
            .iter()
            .find(|kernel| {
                kernel.support == solution.slip && equal_values(&kernel.value, &solution.value)
            })
            .map_or(1, |kernel| kernel.dimension)
    }

    /// One answer from the answers for disjoint sets of supports of one pencil and window.
    pub fn merge(parts: impl IntoIterator<Item = Enumeration>) -> Enumeration {
        let mut all = Enumeration::default();
        for part in parts {
            all.solutions.extend(part.solutions);
            all.cones.extend(part.cones);
            all.ranges.extend(part.ranges);
            all.undescribed.extend(part.undescribed);
            all.wide.extend(part.wide);
            all.continua.extend(part.continua);

            all.supports_done += part.supports_done;
            all.supports_total = all.supports_total.max(part.supports_total);
            all.described.0 += part.described.0;
            all.described.1 += part.described.1;
        }
        all.finish();
        all
    }

    /// Describes the wide kernels and singular supports named in `wide` and `continua` and not yet
    /// described, and puts everything into canonical order. [`super::enumerate`] has done it; who
    /// fills an answer by hand (solutions of kernels of dimension 1, `wide`, `continua`) calls it
    /// at the end.
    pub fn describe(&mut self, pencil: &Pencil, window: &Window) {
        self.describe_new(&IntegerPencil::of(pencil), window);
        self.finish();
    }

    /// Describes what was named since the last time.
    pub(super) fn describe_new(&mut self, pencil: &IntegerPencil<'_>, window: &Window) {
        for k in self.described.0..self.wide.len() {
            let kernel = self.wide[k].clone();
            cone::describe(pencil, &kernel, self);
        }
        for k in self.described.1..self.continua.len() {
            let support = self.continua[k].clone();
            range::describe(pencil, &support, window, self);
        }
        // `range::describe` names further wide kernels, together with their description.
        self.described = (self.wide.len(), self.continua.len());
    }

    /// Leaves out cones inside others and puts everything into canonical order.
    pub(super) fn finish(&mut self) {
        cone::keep_maximal(&mut self.cones);

        self.solutions
            .sort_by(|a, b| compare_places((&a.value, &a.slip), (&b.value, &b.slip)));
        self.cones
            .sort_by(|a, b| compare_places((&a.value, &a.slip), (&b.value, &b.slip)));
        self.wide
            .sort_by(|a, b| compare_places((&a.value, &a.support), (&b.value, &b.support)));

        self.ranges.sort_by(|a, b| a.support.cmp(&b.support));
        self.undescribed.sort_by(|a, b| a.support.cmp(&b.support));
        self.continua.sort();
    }
}

/// Are two numbers equal? The comparison refines copies, the numbers stay as they are.
pub(super) fn equal_values(a: &Algebraic, b: &Algebraic) -> bool {
    a.clone().equals(&mut b.clone())
}

/// A value and a set of slip variables: what a list of solutions is sorted by.
type Place<'a> = (&'a Algebraic, &'a [usize]);

/// By value, then by slip set. The comparison refines copies, the numbers stay as they are.
fn compare_places(a: Place<'_>, b: Place<'_>) -> Ordering {
    let by_value = a.0.clone().cmp_exact(&mut b.0.clone());
    by_value.then_with(|| a.1.cmp(b.1))
}
