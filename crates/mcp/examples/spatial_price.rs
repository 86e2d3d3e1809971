//! A spatial price equilibrium with thousands of unknowns and a sparse Jacobian.
//!
//! Regions lie on a grid; each sells to its neighbours (Samuelson 1952; Takayama and Judge 1964).
//! Unknowns are the price p_i >= 0 of each region and the shipment x_k >= 0 of each link k from a
//! region to a neighbour:
//!
//!     0 <= p_i,  0 <= supply(p_i) - demand(p_i) + shipped in - shipped out,  one of them zero,
//!     0 <= x_k,  0 <= p_from + cost(x_k) - p_to,                             one of them zero.
//!
//! Where the price at the end of a link is less than that at its beginning and the cost of the way
//! nothing is shipped; where something is shipped the two are equal.
//!
//!     cargo run --release --example spatial_price                  20 by 30 regions
//!     cargo run --release --example spatial_price -- 100 100
//!     cargo run --release --example spatial_price -- 20 30 dense   the same in a dense matrix

use mceip_mcp::mcp::{FunctionMcp, Mcp, check_jacobian};
use mceip_mcp::solver::{Options, solve};
use std::error::Error;
use std::time::Instant;

/// Regions on a grid, with a link both ways between neighbours.
pub struct Trade {
    /// Number of regions.
    regions: usize,
    /// Region at the beginning and at the end of each link.
    links: Vec<(usize, usize)>,
}

/// What the first unit of a region costs to produce and to ship, and how supply and demand rise
/// and fall: numbers that differ from region to region without a pattern that shows.
fn data(seed: usize, modulus: usize) -> f64 {
    ((seed * 37 + 11) % modulus) as f64 / modulus as f64
}

impl Trade {
    /// A grid of so many regions.
    pub fn new(width: usize, height: usize) -> Trade {
        let mut links = Vec::new();
        for region in 0..width * height {
            if region % width + 1 < width {
                links.extend([(region, region + 1), (region + 1, region)]);
            }
            if region + width < width * height {
                links.extend([(region, region + width), (region + width, region)]);
            }
        }

        Trade {
            regions: width * height,
            links,
        }
    }

    /// Number of prices and shipments.
    pub fn unknowns(&self) -> usize {
        self.regions + self.links.len()
    }

    /// What a region sells at this price, and the derivative.
    fn supply(&self, region: usize, price: f64) -> (f64, f64) {
        let scale = 1.0 + 4.0 * data(region, 17);
        (scale * price * price, 2.0 * scale * price)
    }

    /// What it buys, and the derivative.
    fn demand(&self, region: usize, price: f64) -> (f64, f64) {
        let scale = 1.0 + 20.0 * data(region, 23);
        (scale * (-price).exp(), -scale * (-price).exp())
    }

    /// What shipping one more unit along a link costs, and the derivative.
    fn cost(&self, link: usize, shipped: f64) -> (f64, f64) {
        (0.02 + 0.1 * data(link, 29) + 0.01 * shipped, 0.01)
    }

    /// The problem, with the entries of its Jacobian.
    pub fn problem(&self) -> FunctionMcp<'_> {
        let n = self.unknowns();
        let function = move |z: &[f64], f: &mut [f64]| {
            let (prices, shipments) = z.split_at(self.regions);
            let (balances, gains) = f.split_at_mut(self.regions);

            for (i, balance) in balances.iter_mut().enumerate() {
                *balance = self.supply(i, prices[i]).0 - self.demand(i, prices[i]).0;
            }
            for (k, &(from, to)) in self.links.iter().enumerate() {
                balances[from] -= shipments[k];
                balances[to] += shipments[k];
                gains[k] = prices[from] + self.cost(k, shipments[k]).0 - prices[to];
            }
        };

        FunctionMcp::new(vec![0.0; n], vec![f64::INFINITY; n], function).with_entries(
            move |z, entries| {
                for i in 0..self.regions {
                    let slope = self.supply(i, z[i]).1 - self.demand(i, z[i]).1;
                    entries.push((i, i, slope));
                }
                for (k, &(from, to)) in self.links.iter().enumerate() {
                    let link = self.regions + k;
                    entries.extend([(from, link, -1.0), (to, link, 1.0)]);
                    entries.extend([(link, from, 1.0), (link, to, -1.0)]);
                    entries.push((link, link, self.cost(k, z[link]).1));
                }
            },
        )
    }

    /// The same with a dense Jacobian.
    pub fn dense_problem(&self) -> FunctionMcp<'_> {
        let sparse = self.problem();
        let jacobian = self.problem();
        let n = self.unknowns();

        FunctionMcp::new(vec![0.0; n], vec![f64::INFINITY; n], move |z, f| {
            sparse.function(z, f);
        })
        .with_jacobian(move |z, j| jacobian.jacobian(z, j))
    }

    /// Is this an equilibrium? An error names what is wrong with it.
    pub fn judge(&self, z: &[f64]) -> Result<(), String> {
        let (prices, shipments) = z.split_at(self.regions);
        let mut sold = 0.0;
        let mut bought = 0.0;
        for (i, &price) in prices.iter().enumerate() {
            sold += self.supply(i, price).0;
            bought += self.demand(i, price).0;
        }
        if (sold - bought).abs() > 1e-8 * sold {
            return Err(format!("{sold} are sold, {bought} are bought"));
        }

        for (k, &(from, to)) in self.links.iter().enumerate() {
            let loss = prices[from] + self.cost(k, shipments[k]).0 - prices[to];
            if loss < -1e-8 {
                return Err(format!("one more unit from {from} to {to} gains {}", -loss));
            }
            if shipments[k] > 1e-8 && loss > 1e-8 {
                return Err(format!("a unit from {from} to {to} loses {loss}"));
            }
        }
        Ok(())
    }
}

/// Solves a grid of regions; an error where the end of the run is no equilibrium.
pub fn solve_grid(width: usize, height: usize, is_dense: bool) -> Result<(), Box<dyn Error>> {
    let trade = Trade::new(width, height);
    let problem = if is_dense {
        trade.dense_problem()
    } else {
        trade.problem()
    };
    let mut start = vec![0.0; trade.unknowns()];
    start[..trade.regions].fill(1.0);

    let began = Instant::now();
    let outcome = solve(&problem, &start, &Options::default())?;
    println!(
        "{} unknowns, {:.3} s: {}; {} factorisations, largest residual {:.1e}",
        trade.unknowns(),
        began.elapsed().as_secs_f64(),
        outcome.termination,
        outcome.counters.factorisations,
        outcome.residuals.normal_map,
    );

    trade.judge(&outcome.point)?;
    Ok(())
}

/// Compares the Jacobian with differences on a small grid, and solves one as large as is asked for.
pub fn main() -> Result<(), Box<dyn Error>> {
    let small = Trade::new(3, 2);
    check_jacobian(&small.problem(), &vec![0.7; small.unknowns()])?;

    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let size = |k: usize, default: usize| arguments.get(k).map_or(Ok(default), |text| text.parse());
    let is_dense = arguments.get(2).is_some_and(|word| word == "dense");
    solve_grid(size(0, 20)?, size(1, 30)?, is_dense)
}
