//! An answer brought to its end: wide kernels and singular supports described, cones inside others
//! left out, everything in canonical order.

use super::enumeration::Enumeration;
use super::integral::Integral;
use super::{cone, range};
use mceip_exact::Algebraic;
use mceip_model::{Pencil, Window};

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
