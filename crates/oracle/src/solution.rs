//! What the enumerator finds: solutions by their exact support, cones, ranges, and what it met on
//! the way.

use super::degenerate::{Cone, SupportRange, Undescribed};
use super::integral::Integral;
use super::{cone, range};
use mceip_exact::{Algebraic, Poly, ratio_to_decimal, to_decimal};
use mceip_model::{Pencil, Window};

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
        to_decimal(&mut self.value.clone(), &Poly::from_ints(&[0, 1]), digits)
    }

    /// x scaled to e'x_s = 1 (l1 norm 1 where x_s = 0), each entry correctly rounded.
    pub fn x_decimals(&self, constrained: &[usize], digits: usize) -> Vec<String> {
        let mut value = self.value.clone();
        let norm = self.normaliser(constrained);
        self.x
            .iter()
            .map(|p| ratio_to_decimal(&mut value, p, &norm, digits))
            .collect()
    }

    /// The polynomial whose value x is divided by: e'x_s, or the l1 norm for free-only solutions.
    pub fn normaliser(&self, constrained: &[usize]) -> Poly {
        let add = |a: Poly, b: &Poly| &a + b;
        if !self.slip.is_empty() {
            return constrained
                .iter()
                .map(|&i| &self.x[i])
                .fold(Poly::default(), add);
        }
        let mut value = self.value.clone();
        let signed = self.x.iter().map(|p| {
            if value.sign_of(p) == mceip_exact::Sign::Negative {
                -p
            } else {
                p.clone()
            }
        });
        signed.fold(Poly::default(), |a, b| &a + &b)
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
        let lineality = |c: &Cone| c.slip.is_empty() || !c.lineality.is_empty();
        self.solutions.iter().any(Solution::is_free_only)
            || self.cones.iter().any(lineality)
            || self.ranges.iter().any(|r| r.support.is_empty())
    }

    /// Dimension of the kernel that a listed solution comes from: 1 unless it was met as a wide
    /// kernel.
    pub fn kernel_dimension(&self, s: &Solution) -> usize {
        let same =
            |w: &&WideKernel| w.support == s.slip && w.value.clone().equals(&mut s.value.clone());
        self.wide.iter().find(same).map_or(1, |w| w.dimension)
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
            all.described = (
                all.described.0 + part.described.0,
                all.described.1 + part.described.1,
            );
        }
        all.finish();
        all
    }

    /// Describes the wide kernels and singular supports named in `wide` and `continua` and not yet
    /// described, and puts everything into canonical order. [`super::enumerate`] has done it; who
    /// fills an answer by hand (solutions of kernels of dimension 1, `wide`, `continua`) calls it
    /// at the end.
    pub fn describe(&mut self, pencil: &Pencil, window: &Window) {
        self.describe_new(&Integral::of(pencil), window);
        self.finish();
    }

    /// Describes what was named since the last time.
    pub(super) fn describe_new(&mut self, pencil: &Integral<'_>, window: &Window) {
        let (wide, continua) = (self.wide.len(), self.continua.len());
        for k in self.described.0..wide {
            cone::describe(pencil, &self.wide[k].clone(), self);
        }
        for k in self.described.1..continua {
            range::describe(pencil, &self.continua[k].clone(), window, self);
        }
        // Wide kernels named by `range` come with their description.
        self.described = (self.wide.len(), continua);
    }

    /// Leaves out cones inside others and puts everything into canonical order.
    pub(super) fn finish(&mut self) {
        cone::keep_maximal(&mut self.cones);
        let compare = |a: &Algebraic, b: &Algebraic| a.clone().cmp_exact(&mut b.clone());
        self.solutions
            .sort_by(|a, b| compare(&a.value, &b.value).then_with(|| a.slip.cmp(&b.slip)));
        self.cones
            .sort_by(|a, b| compare(&a.value, &b.value).then_with(|| a.slip.cmp(&b.slip)));
        self.wide
            .sort_by(|a, b| compare(&a.value, &b.value).then_with(|| a.support.cmp(&b.support)));
        self.ranges.sort_by(|a, b| a.support.cmp(&b.support));
        self.undescribed.sort_by(|a, b| a.support.cmp(&b.support));
        self.continua.sort();
    }
}
