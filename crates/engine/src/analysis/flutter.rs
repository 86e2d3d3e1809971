//! A warning from doubles: complex lambda^2 of the all-slip pencil at mu. They lie outside (8).

use crate::reduction::MuFamily;
use crate::tolerance::FLUTTER_ANGLE;
use mceip_exact::{Rational, Sparse, to_f64};
use mceip_mcp::linear::{eigenvalues, solve};

/// Complex lambda^2 of (lambda^2 M* + K*) x = 0 with every slip particle slipping.
#[derive(Debug, Clone, PartialEq)]
pub struct Flutter {
    /// lambda^2 = re + i im with im > 0, by descending growth rate.
    pub eigenvalues: Vec<(f64, f64)>,
    /// Largest growth rate Re lambda of them, in 1/s, 0 without any.
    pub growth_rate: f64,
    /// Im lambda of that one, rad/s.
    pub frequency: f64,
}

/// Order beyond which the dense eigenproblem is not tried.
const LARGEST_ORDER: usize = 2500;

/// `None` beyond the largest order, without a mass, or where doubles fail.
pub(super) fn flutter(family: &MuFamily, mu: &Rational) -> Option<Flutter> {
    let mass = family.mass.as_ref()?;
    if family.stiffness.order() > LARGEST_ORDER {
        return None;
    }
    let dense = |at_zero: &Sparse, slope: &Sparse| -> Vec<Vec<f64>> {
        let m = at_zero.add_scaled(mu, slope);
        (0..m.rows())
            .map(|i| {
                let mut row = vec![0.0; m.cols()];
                m.row(i).iter().for_each(|(j, v)| row[*j] = to_f64(v));
                row
            })
            .collect()
    };
    let k = dense(family.stiffness.a(), family.stiffness.b());
    let m = dense(mass.a(), mass.b());
    let n = k.len();
    let columns: Vec<Vec<f64>> = (0..n).map(|j| (0..n).map(|i| -k[i][j]).collect()).collect();
    let solved = solve(&m, &columns)?;
    let rows: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| solved[j][i]).collect())
        .collect();
    let all = eigenvalues(&rows)?;
    let mut complex: Vec<(f64, f64)> = all
        .into_iter()
        .filter(|(re, im)| *im > FLUTTER_ANGLE * re.hypot(*im))
        .collect();
    complex.sort_by(|p, q| root(*q).0.total_cmp(&root(*p).0).then(p.1.total_cmp(&q.1)));
    let (growth_rate, frequency) = complex.first().map_or((0.0, 0.0), |z| root(*z));
    Some(Flutter {
        eigenvalues: complex,
        growth_rate,
        frequency,
    })
}

/// The square root with positive real part.
fn root((re, im): (f64, f64)) -> (f64, f64) {
    let size = re.hypot(im);
    // |z| + re without cancellation where re < 0.
    let growth = if re >= 0.0 {
        (0.5 * (size + re)).sqrt()
    } else {
        0.5 * im.abs() / (0.5 * (size - re)).sqrt()
    };
    (growth, 0.5 * im / growth)
}
