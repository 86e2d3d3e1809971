//! Four unknowns and two solutions, at one of which Newton's matrix is singular.
//!
//! Kojima and Shindo 1986, "Extension of Newton and quasi-Newton methods to systems of PC1
//! equations", Journal of the Operations Research Society of Japan 29; `kojshin` of MCPLIB. The
//! solutions are (sqrt(6)/2, 0, 0, 1/2), where z_3 and F_3 are both zero, and (1, 0, 3, 0).
//!
//!     cargo run --example kojima_shindo

use mceip_mcp::mcp::{FunctionMcp, check_jacobian};
use mceip_mcp::solver::{Options, solve};
use std::error::Error;

/// The solution at which z_3 = F_3 = 0.
pub const DEGENERATE: [f64; 4] = [1.224_744_871_391_589, 0.0, 0.0, 0.5];

/// The other one.
pub const REGULAR: [f64; 4] = [1.0, 0.0, 3.0, 0.0];

/// 0 <= z and 0 <= F(z), one of them zero in each component.
pub fn problem() -> FunctionMcp<'static> {
    let infinity = f64::INFINITY;
    FunctionMcp::new(vec![0.0; 4], vec![infinity; 4], |z, f| {
        let [a, b, c, d] = [z[0], z[1], z[2], z[3]];
        f[0] = 3.0 * a * a + 2.0 * a * b + 2.0 * b * b + c + 3.0 * d - 6.0;
        f[1] = 2.0 * a * a + a + b * b + 10.0 * c + 2.0 * d - 2.0;
        f[2] = 3.0 * a * a + a * b + 2.0 * b * b + 2.0 * c + 9.0 * d - 9.0;
        f[3] = a * a + 3.0 * b * b + 2.0 * c + 3.0 * d - 3.0;
    })
    .with_jacobian(|z, j| {
        let [a, b] = [z[0], z[1]];
        let rows = [
            [6.0 * a + 2.0 * b, 2.0 * a + 4.0 * b, 1.0, 3.0],
            [4.0 * a + 1.0, 2.0 * b, 10.0, 2.0],
            [6.0 * a + b, a + 4.0 * b, 2.0, 9.0],
            [2.0 * a, 6.0 * b, 2.0, 3.0],
        ];
        for (row, entries) in rows.iter().enumerate() {
            for (col, value) in entries.iter().enumerate() {
                j[(row, col)] = *value;
            }
        }
    })
}

/// Solves from several starts; an error where a run ends elsewhere than at one of the solutions.
pub fn main() -> Result<(), Box<dyn Error>> {
    let problem = problem();
    check_jacobian(&problem, &[1.0, 2.0, 3.0, 4.0])?;

    let mut seen = [false; 2];
    for start in [
        [0.0; 4],
        [1.0; 4],
        [1.0, 0.0, 1.0, 0.0],
        [0.0, 5.0, 0.0, 5.0],
    ] {
        let outcome = solve(&problem, &start, &Options::default())?;
        println!("{start:?} -> {:?}", outcome.point);

        let solution = [DEGENERATE, REGULAR].iter().position(|solution| {
            let mut pairs = solution.iter().zip(&outcome.point);
            pairs.all(|(expected, found)| (expected - found).abs() < 1e-5)
        });
        match solution {
            Some(k) => seen[k] = true,
            None => return Err(format!("no solution from {start:?}: {outcome:?}").into()),
        }
    }

    if seen == [true, true] {
        Ok(())
    } else {
        Err("only one of the two solutions was found".into())
    }
}
