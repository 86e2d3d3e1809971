//! A problem made of closures: F, and F' dense, by its entries, or not at all.

use super::Mcp;
use nalgebra::DMatrix;

/// Writes F(z) into its second argument.
type FunctionOf<'a> = Box<dyn Fn(&[f64], &mut [f64]) + 'a>;

/// Writes F'(z), every entry, into its second argument.
type JacobianOf<'a> = Box<dyn Fn(&[f64], &mut DMatrix<f64>) + 'a>;

/// Adds the entries of F'(z) to its second argument.
type EntriesOf<'a> = Box<dyn Fn(&[f64], &mut Vec<(usize, usize, f64)>) + 'a>;

/// MCP(F, l, u) with F and its Jacobian from closures. Without a Jacobian it is differentiated by
/// differences. Bounds are checked when a run begins.
///
/// ```
/// use mceip_mcp::mcp::FunctionMcp;
/// use mceip_mcp::solver::{Options, solve};
///
/// // 0 <= z, 0 <= exp(z) - 2, one of them 0: z = ln 2.
/// let problem = FunctionMcp::new(vec![0.0], vec![f64::INFINITY], |z, f| f[0] = z[0].exp() - 2.0)
///     .with_jacobian(|z, j| j[(0, 0)] = z[0].exp());
///
/// let outcome = solve(&problem, &[5.0], &Options::default()).unwrap();
/// assert!((outcome.point[0] - 2f64.ln()).abs() < 1e-10);
/// ```
pub struct FunctionMcp<'a> {
    lower: Vec<f64>,
    upper: Vec<f64>,
    function: FunctionOf<'a>,
    jacobian: Option<JacobianOf<'a>>,
    entries: Option<EntriesOf<'a>>,
}

impl<'a> FunctionMcp<'a> {
    /// The problem with as many unknowns as lower bounds; F writes F(z) into its second argument.
    pub fn new(
        lower: Vec<f64>,
        upper: Vec<f64>,
        function: impl Fn(&[f64], &mut [f64]) + 'a,
    ) -> Self {
        FunctionMcp {
            lower,
            upper,
            function: Box::new(function),
            jacobian: None,
            entries: None,
        }
    }

    /// With the Jacobian as a dense matrix ([`Mcp::jacobian`]), full of zeros when the closure is
    /// called.
    pub fn with_jacobian(mut self, jacobian: impl Fn(&[f64], &mut DMatrix<f64>) + 'a) -> Self {
        self.jacobian = Some(Box::new(jacobian));
        self
    }

    /// With the Jacobian by its entries ([`Mcp::entries`]).
    pub fn with_entries(
        mut self,
        entries: impl Fn(&[f64], &mut Vec<(usize, usize, f64)>) + 'a,
    ) -> Self {
        self.entries = Some(Box::new(entries));
        self
    }
}

impl Mcp for FunctionMcp<'_> {
    fn dimension(&self) -> usize {
        self.lower.len()
    }
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        (self.function)(z, f);
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        match (&self.jacobian, &self.entries) {
            (Some(jacobian), _) => {
                j.fill(0.0);
                jacobian(z, j);
            }
            (None, Some(entries)) => {
                let mut list = Vec::new();
                entries(z, &mut list);
                super::scatter(&list, j);
            }
            (None, None) => super::difference_jacobian(self, z, j),
        }
    }
    fn entries(&self, z: &[f64], list: &mut Vec<(usize, usize, f64)>) -> bool {
        if let Some(entries) = &self.entries {
            entries(z, list);
        }
        self.entries.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    const INF: f64 = f64::INFINITY;

    /// F = (z_0 z_1, z_1^2) with its Jacobian in the three ways.
    #[test]
    fn one_jacobian_in_three_ways() {
        let problem = || {
            FunctionMcp::new(vec![0.0; 2], vec![INF; 2], |z, f| {
                f[0] = z[0] * z[1];
                f[1] = z[1] * z[1];
            })
        };
        let dense = problem().with_jacobian(|z, j| {
            j[(0, 0)] = z[1];
            j[(0, 1)] = z[0];
            j[(1, 1)] = 2.0 * z[1];
        });
        let sparse = problem().with_entries(|z, entries| {
            // Entries of one place add up.
            entries.extend([(0, 0, z[1]), (0, 1, z[0]), (1, 1, z[1]), (1, 1, z[1])]);
        });

        let expected = dmatrix![3.0, 2.0; 0.0, 6.0];
        for (problem, error) in [(dense, 0.0), (sparse, 0.0), (problem(), 1e-9)] {
            let mut j = dmatrix![9.0, 9.0; 9.0, 9.0];
            problem.jacobian(&[2.0, 3.0], &mut j);
            assert!((&j - &expected).amax() <= error, "{j}");
        }
    }

    /// The trait's own default fills a dense matrix from the entries, and refuses those beyond it.
    #[test]
    fn entries_beyond_the_order_leave_no_number() {
        let problem = FunctionMcp::new(vec![0.0], vec![INF], |z, f| f[0] = z[0])
            .with_entries(|_, entries| entries.extend([(0, 0, 1.0), (1, 0, 1.0)]));
        let mut j = dmatrix![7.0];
        problem.jacobian(&[1.0], &mut j);

        assert!(j[(0, 0)].is_nan());
    }
}
