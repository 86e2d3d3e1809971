//! From what the enumeration met to what it holds, and the order of an answer.

use super::cone;
use super::enumeration::Enumeration;
use super::integer_pencil::IntegerPencil;
use super::range;
use mceip_exact::Algebraic;
use mceip_model::RealWindow;
use std::cmp::Ordering;

impl Enumeration {
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
    pub fn describe<'a>(
        &mut self,
        pencil: impl Into<IntegerPencil<'a>>,
        window: impl Into<RealWindow>,
    ) {
        self.describe_new(&pencil.into(), &window.into());
        self.finish();
    }

    /// Describes what was named since the last time.
    pub(super) fn describe_new(&mut self, pencil: &IntegerPencil<'_>, window: &RealWindow) {
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

/// A value and a set of slip variables: what a list of solutions is sorted by.
pub(super) type ListPlace<'a> = (&'a Algebraic, &'a [usize]);

/// By value, then by slip set. The comparison refines copies, the numbers stay as they are.
pub(super) fn compare_places(a: ListPlace<'_>, b: ListPlace<'_>) -> Ordering {
    let by_value = a.0.clone().cmp_exact(&mut b.0.clone());
    by_value.then_with(|| a.1.cmp(b.1))
}
