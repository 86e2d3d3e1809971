//! A Nash-Cournot equilibrium: how much does each firm produce that sets its own quantity and knows
//! what the price will be?
//!
//! Firm i has the marginal cost c_i + (s_i z_i)^(1 / beta_i). The market takes Q = sum z at the
//! price p(Q) = (5000 / Q)^(1 / gamma), so that one more unit earns p(Q) + z_i p'(Q). In the
//! equilibrium z_i >= 0, and what one more unit costs less what it earns,
//!
//!     F_i(z) = c_i + (s_i z_i)^(1 / beta_i) - p(Q) + z_i p(Q) / (gamma Q),
//!
//! is zero for every firm that produces and not negative for one that does not.
//!
//! Five firms: Murphy, Sherali and Soyster 1982, "A mathematical programming approach for
//! determining oligopolistic market equilibrium", Mathematical Programming 24. Ten firms: Harker
//! 1988, "Accelerating the convergence of the diagonalization and projection algorithms for
//! finite-dimensional variational inequalities", Mathematical Programming 41; `nash` of MCPLIB.
//!
//!     cargo run --example nash_cournot

use mceip_mcp::mcp::{FunctionMcp, check_jacobian};
use mceip_mcp::solver::{Options, solve};
use std::error::Error;

/// Firms, the market, and the published equilibrium.
pub struct Market {
    /// What this market is called.
    pub name: &'static str,
    /// The cost of the first unit, c_i.
    pub cost: &'static [f64],
    /// The elasticity of supply, beta_i.
    pub elasticity: &'static [f64],
    /// The scale of the quantity in the marginal cost, s_i, the same for all firms.
    pub scale: f64,
    /// The elasticity of demand, gamma.
    pub gamma: f64,
    /// The productions in equilibrium, as printed.
    pub published: &'static [f64],
    /// Half a unit in the last place of what is printed, and a little more.
    pub digits: f64,
}

/// The two markets.
pub const MARKETS: [Market; 2] = [
    Market {
        name: "five firms",
        cost: &[10.0, 8.0, 6.0, 4.0, 2.0],
        elasticity: &[1.2, 1.1, 1.0, 0.9, 0.8],
        scale: 0.2,
        gamma: 1.1,
        published: &[36.93, 41.82, 43.71, 42.66, 39.18],
        digits: 6e-3,
    },
    Market {
        name: "ten firms",
        cost: &[5.0, 3.0, 8.0, 5.0, 1.0, 3.0, 7.0, 4.0, 6.0, 3.0],
        elasticity: &[1.2, 1.0, 0.9, 0.6, 1.5, 1.0, 0.7, 1.1, 0.95, 0.75],
        scale: 10.0,
        gamma: 1.2,
        published: &[
            7.4415, 4.0978, 2.5906, 0.9354, 17.949, 4.0978, 1.3047, 5.5901, 3.2222, 1.6771,
        ],
        digits: 6e-5,
    },
];

impl Market {
    /// The price at which the market takes this quantity.
    fn price(&self, quantity: f64) -> f64 {
        (5000.0 / quantity).powf(1.0 / self.gamma)
    }

    /// The equilibrium as a complementarity problem, with its Jacobian.
    pub fn problem(&self) -> FunctionMcp<'_> {
        let firms = self.cost.len();
        let infinity = f64::INFINITY;

        let function = move |z: &[f64], f: &mut [f64]| {
            let quantity: f64 = z.iter().sum();
            let price = self.price(quantity);
            for i in 0..firms {
                let power = 1.0 / self.elasticity[i];
                let marginal_cost = self.cost[i] + (self.scale * z[i]).powf(power);
                f[i] = marginal_cost - price + z[i] * price / (self.gamma * quantity);
            }
        };

        FunctionMcp::new(vec![0.0; firms], vec![infinity; firms], function).with_jacobian(
            move |z, j| {
                let quantity: f64 = z.iter().sum();
                let price = self.price(quantity);
                let slope = -price / (self.gamma * quantity);
                let bend = slope / quantity * (-1.0 / self.gamma - 1.0);

                for i in 0..firms {
                    for k in 0..firms {
                        j[(i, k)] = -slope - z[i] * bend;
                    }
                    let power = 1.0 / self.elasticity[i];
                    let of_cost = power * self.scale * (self.scale * z[i]).powf(power - 1.0);
                    j[(i, i)] += of_cost - slope;
                }
            },
        )
    }
}

/// Solves both markets; an error where a production differs from the published one.
pub fn main() -> Result<(), Box<dyn Error>> {
    for market in &MARKETS {
        let problem = market.problem();
        let start = vec![1.0; market.cost.len()];
        check_jacobian(&problem, &start)?;

        let outcome = solve(&problem, &start, &Options::default())?;
        println!("{}: {:.4?}", market.name, outcome.point);

        let mut pairs = outcome.point.iter().zip(market.published);
        if !pairs.all(|(found, printed)| (found - printed).abs() < market.digits) {
            return Err(format!("expected {:?}, got {outcome:?}", market.published).into());
        }
    }
    Ok(())
}
