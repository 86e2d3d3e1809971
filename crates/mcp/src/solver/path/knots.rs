//! The breakpoints of a path, one after the other in storage that is kept. The path is linear
//! between them. Written by `walk`, read through `record`.

/// t, z and the multipliers w - v at each breakpoint.
#[derive(Debug, Clone)]
pub(in super::super) struct Knots<T = f64> {
    /// Number of unknowns.
    n: usize,
    t: Vec<T>,
    /// The points, one after the other.
    z: Vec<T>,
    #[cfg(test)]
    multiplier: Vec<T>,
}

impl<T> Default for Knots<T> {
    fn default() -> Self {
        Knots {
            n: 0,
            t: Vec::new(),
            z: Vec::new(),
            #[cfg(test)]
            multiplier: Vec::new(),
        }
    }
}

impl<T: Clone> Knots<T> {
    /// No breakpoints, of `n` unknowns.
    pub(super) fn clear(&mut self, n: usize) {
        self.n = n;
        self.t.clear();
        self.z.clear();
        #[cfg(test)]
        self.multiplier.clear();
    }

    /// One more. Multipliers are kept for the tests of the path equation only.
    #[cfg_attr(not(test), allow(unused_variables))]
    pub(super) fn push(&mut self, t: T, z: &[T], multiplier: &[T]) {
        self.t.push(t);
        self.z.extend_from_slice(z);
        #[cfg(test)]
        self.multiplier.extend_from_slice(multiplier);
    }

    /// Their number.
    pub(in super::super) fn len(&self) -> usize {
        self.t.len()
    }

    /// t at a breakpoint.
    pub(in super::super) fn t(&self, k: usize) -> &T {
        &self.t[k]
    }

    /// z at a breakpoint.
    pub(in super::super) fn z(&self, k: usize) -> &[T] {
        let begin = k * self.n;
        &self.z[begin..begin + self.n]
    }

    /// w - v at a breakpoint.
    #[cfg(test)]
    pub(super) fn multiplier(&self, k: usize) -> &[T] {
        let begin = k * self.n;
        &self.multiplier[begin..begin + self.n]
    }

    /// Puts the last breakpoint at t.
    pub(super) fn set_last_t(&mut self, t: T) {
        if let Some(last) = self.t.last_mut() {
            *last = t;
        }
    }

    /// Takes those of another path.
    pub(super) fn copy_from(&mut self, other: &Knots<T>) {
        self.n = other.n;
        self.t.clone_from(&other.t);
        self.z.clone_from(&other.z);
        #[cfg(test)]
        self.multiplier.clone_from(&other.multiplier);
    }
}
