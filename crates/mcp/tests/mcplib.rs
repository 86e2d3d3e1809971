//! Problems of the literature that can be written down, most of them in MCPLIB (Dirkse and Ferris
//! 1995, "MCPLIB: a collection of nonlinear mixed complementarity problems", Optimization Methods
//! and Software 5), each with its published solution.
//!
//! A run from each start must end at a solution within the digits that are printed; none is left
//! out. The examples hold some of the problems and are run here.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../examples/kojima_shindo.rs"]
#[allow(unreachable_pub, dead_code, reason = "a program of its own")]
mod kojima_shindo;
#[path = "../examples/nash_cournot.rs"]
#[allow(unreachable_pub, dead_code, reason = "a program of its own")]
mod nash_cournot;
#[path = "../examples/spatial_price.rs"]
#[allow(unreachable_pub, dead_code, reason = "a program of its own")]
mod spatial_price;

use mceip_mcp::mcp::{FunctionMcp, Mcp, check_jacobian};
use mceip_mcp::solver::{
    Curve, CurveEnd, Options, Outcome, Sense, Termination, continuation, solve,
};
use nash_cournot::MARKETS;

const INF: f64 = f64::INFINITY;

#[test]
fn the_examples_find_what_they_expect() {
    kojima_shindo::main().unwrap();
    nash_cournot::main().unwrap();
    spatial_price::solve_grid(20, 30, false).unwrap();
}

/// Runs from each start and hands the ends to `judge`, after the Jacobian was compared at the
/// first start.
fn solve_from(problem: &impl Mcp, starts: &[&[f64]], judge: impl Fn(&[f64]) -> bool) {
    check_jacobian(problem, starts[0]).unwrap();

    for start in starts {
        let outcome = solve(problem, start, &Options::default()).unwrap();
        assert_eq!(
            outcome.termination,
            Termination::ToleranceReached,
            "{start:?}"
        );
        assert!(judge(&outcome.point), "{start:?}: {outcome:?}");
    }
}

/// Is each component this near to the expected one?
fn is_near(point: &[f64], expected: &[f64], digits: f64) -> bool {
    let mut pairs = point.iter().zip(expected);
    point.len() == expected.len() && pairs.all(|(found, wanted)| (found - wanted).abs() < digits)
}

/// Starts for four unknowns.
const STARTS_OF_FOUR: [&[f64]; 7] = [
    &[0.5; 4],
    &[0.0; 4],
    &[1.0; 4],
    &[100.0; 4],
    &[1.0, 0.0, 1.0, 0.0],
    &[1.25, 0.0, 0.0, 0.5],
    &[0.0, 5.0, 0.0, 5.0],
];

#[test]
fn kojshin() {
    let problem = kojima_shindo::problem();
    solve_from(&problem, &STARTS_OF_FOUR, |point| {
        is_near(point, &kojima_shindo::DEGENERATE, 1e-5)
            || is_near(point, &kojima_shindo::REGULAR, 1e-8)
    });
}

/// Josephy 1979, "Newton's method for generalized equations", report 1965 of the Mathematics
/// Research Center, Madison: the problem of Kojima and Shindo with other coefficients in two rows,
/// and one solution.
#[test]
fn josephy() {
    let problem = FunctionMcp::new(vec![0.0; 4], vec![INF; 4], |z, f| {
        kojima_shindo::problem().function(z, f);
        f[1] -= 7.0 * z[2];
        f[2] += 8.0 - 6.0 * z[3];
    })
    .with_jacobian(|z, j| {
        kojima_shindo::problem().jacobian(z, j);
        j[(1, 2)] -= 7.0;
        j[(2, 3)] -= 6.0;
    });

    let solution = kojima_shindo::DEGENERATE;
    solve_from(&problem, &STARTS_OF_FOUR, |point| {
        is_near(point, &solution, 1e-8)
    });
}

#[test]
fn nash() {
    for market in &MARKETS {
        let firms = market.cost.len();
        let starts = [1.0, 0.1, 10.0, 100.0].map(|component| vec![component; firms]);
        let starts = starts.each_ref().map(Vec::as_slice);

        solve_from(&market.problem(), &starts, |point| {
            is_near(point, market.published, market.digits)
        });
    }
}

/// Billups 1995, "Algorithms for complementarity problems and generalized equations", thesis,
/// Madison: made so that descent of every merit is led into a trap, at z = 0 or near 1.
#[test]
fn billups() {
    let problem = FunctionMcp::new(vec![0.0], vec![INF], |z, f| {
        f[0] = (z[0] - 1.0).powi(2) - 1.01;
    })
    .with_jacobian(|z, j| j[(0, 0)] = 2.0 * (z[0] - 1.0));
    let solution = [1.0 + 1.01f64.sqrt()];

    let starts: [&[f64]; 5] = [&[0.5], &[0.0], &[1.0], &[1.5], &[10.0]];
    solve_from(&problem, &starts, |point| is_near(point, &solution, 1e-9));

    let curve: Curve = continuation(&problem, &[0.0], Sense::Down, 9, &Options::default()).unwrap();
    assert_eq!(curve.solutions.len(), 1, "{curve:?}");
    assert_eq!(curve.end, CurveEnd::Ray, "{curve:?}");
}

/// Mathiesen 1987, "An algorithm based on a sequence of linear complementarity problems applied to
/// a Walrasian equilibrium model", Mathematical Programming 37.
///
/// Unknowns are the level y of one activity, which makes a unit of good 1 of a unit each of goods 2
/// and 3, and the prices. The consumer owns `owned` of goods 2 and 3, and spends the share `share`
/// of the income on good 1, the rest on good 2. Prices have no scale; good 2 is the numeraire.
fn walras(share: f64, owned: [f64; 2]) -> FunctionMcp<'static> {
    let lower = vec![0.0, 0.0, 1.0, 0.0];
    let upper = vec![INF, INF, 1.0, INF];

    FunctionMcp::new(lower, upper, move |z, f| {
        let [y, p1, p2, p3] = [z[0], z[1], z[2], z[3]];
        let income = owned[0] * p2 + owned[1] * p3;
        f[0] = p2 + p3 - p1;
        f[1] = y - share * income / p1;
        f[2] = owned[0] - y - (1.0 - share) * income / p2;
        f[3] = owned[1] - y;
    })
}

/// With good 3 scarce: y is all of it, and the market of good 2 gives p_3. With plenty of it
/// p_3 = 0, and y is what the share of the income buys.
#[test]
fn mathiesen() {
    let starts: [&[f64]; 4] = [
        &[1.0, 1.0, 1.0, 1.0],
        &[0.0, 2.0, 1.0, 0.0],
        &[10.0, 10.0, 1.0, 10.0],
        &[3.0, 0.1, 1.0, 5.0],
    ];
    for (share, owned, solution) in [
        (0.9, [5.0, 3.0], [3.0, 6.0, 1.0, 5.0]),
        (0.75, [1.0, 0.5], [0.5, 3.0, 1.0, 2.0]),
        (0.75, [1.0, 2.0], [0.75, 1.0, 1.0, 0.0]),
    ] {
        solve_from(&walras(share, owned), &starts, |point| {
            is_near(point, &solution, 1e-8)
        });
    }
}

/// Colville's first problem, number 86 of Hock and Schittkowski 1981, "Test examples for nonlinear
/// programming codes": minimise e'x + x'C x + sum d_j x_j^3 with A x >= b, x >= 0.
mod colville {
    pub(super) const E: [f64; 5] = [-15.0, -27.0, -36.0, -18.0, -12.0];
    pub(super) const C: [[f64; 5]; 5] = [
        [30.0, -20.0, -10.0, 32.0, -10.0],
        [-20.0, 39.0, -6.0, -31.0, 32.0],
        [-10.0, -6.0, 10.0, -6.0, -10.0],
        [32.0, -31.0, -6.0, 39.0, -20.0],
        [-10.0, 32.0, -10.0, -20.0, 30.0],
    ];
    pub(super) const D: [f64; 5] = [4.0, 8.0, 10.0, 6.0, 2.0];
    pub(super) const A: [[f64; 5]; 10] = [
        [-16.0, 2.0, 0.0, 1.0, 0.0],
        [0.0, -2.0, 0.0, 4.0, 2.0],
        [-3.5, 0.0, 2.0, 0.0, 0.0],
        [0.0, -2.0, 0.0, -4.0, -1.0],
        [0.0, -9.0, -2.0, 1.0, -2.8],
        [2.0, 0.0, -4.0, 0.0, 0.0],
        [-1.0, -1.0, -1.0, -1.0, -1.0],
        [-1.0, -2.0, -3.0, -2.0, -1.0],
        [1.0, 2.0, 3.0, 4.0, 5.0],
        [1.0, 1.0, 1.0, 1.0, 1.0],
    ];
    pub(super) const B: [f64; 10] = [-40.0, -2.0, -0.25, -4.0, -4.0, -1.0, -40.0, -60.0, 5.0, 1.0];

    /// The published minimum, and where it is.
    pub(super) const MINIMUM: f64 = -32.348_678_97;
    pub(super) const X: [f64; 5] = [0.3, 0.333_467_61, 0.4, 0.428_310_10, 0.223_964_87];

    /// e'x + x'C x + sum d_j x_j^3.
    pub(super) fn objective(x: &[f64]) -> f64 {
        let mut sum = 0.0;
        for j in 0..5 {
            sum += E[j] * x[j] + D[j] * x[j].powi(3);
            for k in 0..5 {
                sum += C[j][k] * x[j] * x[k];
            }
        }
        sum
    }

    /// The gradient of the objective: e + 2 C x + 3 d x^2.
    pub(super) fn gradient(x: &[f64], j: usize) -> f64 {
        let product: f64 = (0..5).map(|k| C[j][k] * x[k]).sum();
        E[j] + 2.0 * product + 3.0 * D[j] * x[j] * x[j]
    }

    /// What a constraint leaves of A x >= b.
    pub(super) fn slack(x: &[f64], row: usize) -> f64 {
        let product: f64 = (0..5).map(|k| A[row][k] * x[k]).sum();
        product - B[row]
    }

    /// Component j of A'u.
    pub(super) fn pulled(u: &[f64], j: usize) -> f64 {
        (0..10).map(|row| A[row][j] * u[row]).sum()
    }
}

/// Its optimality conditions: 0 <= x against the gradient less A'u, 0 <= u against A x - b.
#[test]
fn colvncp() {
    let problem = FunctionMcp::new(vec![0.0; 15], vec![INF; 15], |z, f| {
        let (x, u) = z.split_at(5);
        for j in 0..5 {
            f[j] = colville::gradient(x, j) - colville::pulled(u, j);
        }
        for row in 0..10 {
            f[5 + row] = colville::slack(x, row);
        }
    });

    let mut published_start = [0.0; 15];
    published_start[4] = 1.0;
    let starts: [&[f64]; 3] = [&[1.0; 15], &published_start, &[0.0; 15]];
    solve_from(&problem, &starts, |point| {
        let minimum = colville::objective(&point[..5]);
        is_near(&point[..5], &colville::X, 1e-7) && (minimum - colville::MINIMUM).abs() < 1e-7
    });
}

/// The dual, number 117 of the same collection (Colville's second problem): minimise
/// -b'u + y'C y + 2 sum d_j y_j^3 with gradient(y) - A'u >= 0, u, y >= 0. Its optimality conditions
/// have the multipliers v; at the solution y = v = x.
#[test]
fn colvdual() {
    let problem = FunctionMcp::new(vec![0.0; 20], vec![INF; 20], |z, f| {
        let (u, rest) = z.split_at(10);
        let (y, v) = rest.split_at(5);
        for row in 0..10 {
            f[row] = colville::slack(v, row);
        }
        for j in 0..5 {
            let product: f64 = (0..5).map(|k| colville::C[j][k] * (y[k] - v[k])).sum();
            f[10 + j] = 2.0 * product + 6.0 * colville::D[j] * y[j] * (y[j] - v[j]);
            f[15 + j] = colville::gradient(y, j) - colville::pulled(u, j);
        }
    });

    let mut published_start = [0.001; 20];
    published_start[6] = 60.0;
    let starts: [&[f64]; 3] = [&[1.0; 20], &published_start, &[0.0; 20]];
    solve_from(&problem, &starts, |point| {
        is_near(&point[10..15], &colville::X, 1e-7) && is_near(&point[15..], &colville::X, 1e-7)
    });
}

/// Dantzig 1963, "Linear programming and extensions", 3.3: two plants, three markets, in thousands
/// of dollars; as a complementarity problem `transmcp` of the GAMS library. The least cost is
/// 153.675; shipments and prices are not unique.
#[test]
fn transmcp() {
    const CAPACITY: [f64; 2] = [350.0, 600.0];
    const DEMAND: [f64; 3] = [325.0, 300.0, 275.0];
    const MILES: [[f64; 3]; 2] = [[2.5, 1.7, 1.8], [2.5, 1.8, 1.4]];
    const FREIGHT: f64 = 0.09;

    // Shipments by plant, then prices at the plants, then at the markets.
    let problem = FunctionMcp::new(vec![0.0; 11], vec![INF; 11], |z, f| {
        f[6..8].copy_from_slice(&CAPACITY);
        for market in 0..3 {
            f[8 + market] = -DEMAND[market];
        }
        for plant in 0..2 {
            for market in 0..3 {
                let link = 3 * plant + market;
                f[link] = z[6 + plant] + FREIGHT * MILES[plant][market] - z[8 + market];
                f[6 + plant] -= z[link];
                f[8 + market] += z[link];
            }
        }
    });

    let starts: [&[f64]; 3] = [&[1.0; 11], &[0.0; 11], &[100.0; 11]];
    solve_from(&problem, &starts, |point| {
        let costs = point[..6].iter().zip(MILES.as_flattened());
        let total: f64 = costs
            .map(|(shipped, miles)| FREIGHT * miles * shipped)
            .sum();
        (total - 153.675).abs() < 1e-6
    });
}

/// One problem with its sparse Jacobian, and with the same as a dense matrix: the same end.
#[test]
fn sparse_and_dense_jacobians_lead_to_one_end() {
    let trade = spatial_price::Trade::new(6, 5);
    let n = trade.unknowns();
    let sparse = trade.problem();
    let dense = trade.dense_problem();

    let end = |problem: &FunctionMcp<'_>, options: &Options| -> Outcome {
        let outcome = solve(problem, &vec![1.0; n], options).unwrap();
        assert!(outcome.termination.reached_tolerance(), "{outcome:?}");
        trade.judge(&outcome.point).unwrap();
        outcome
    };

    // The whole run, and the paths alone, which are followed in the dense matrix of the entries.
    let paths_alone = Options {
        crash_iteration_limit: 0,
        ..Options::default()
    };
    for options in [Options::default(), paths_alone] {
        let [first, second] = [&sparse, &dense].map(|problem| end(problem, &options));
        assert!(is_near(&first.point, &second.point, 1e-8));
        assert!(is_near(
            &[first.residuals.fischer_gradient],
            &[second.residuals.fischer_gradient],
            1e-8
        ));
    }
}

/// Above 2000 unknowns no dense matrix is made: a problem that Newton on the Fischer-Burmeister
/// system does not solve ends with that reason, one with zeros that leave no diagonal with theirs.
#[test]
fn large_sparse_problems_have_no_paths() {
    const N: usize = 2001;
    let none = FunctionMcp::new(vec![0.0; N], vec![INF; N], |z, f| {
        for (f, z) in f.iter_mut().zip(z) {
            *f = -1.0 - z;
        }
    })
    .with_entries(|_, entries| entries.extend((0..N).map(|i| (i, i, -1.0))));
    let outcome = solve(&none, &vec![1.0; N], &Options::default()).unwrap();
    assert_eq!(
        outcome.termination,
        Termination::TooLargeForPaths {
            order: N,
            limit: 2000
        }
    );
    assert_eq!(outcome.counters.pivots, 0);

    let empty =
        FunctionMcp::new(vec![0.0; N], vec![INF; N], |_, f| f.fill(-1.0)).with_entries(|_, _| {});
    let outcome = solve(&empty, &vec![1.0; N], &Options::default()).unwrap();
    assert_eq!(
        outcome.termination,
        Termination::StructurallySingular { row: 0, col: 0 }
    );
}
