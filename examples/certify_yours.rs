//! Your own solver has printed a point. Is there a solution near it?
//!
//! ```text
//! cargo run --release --example certify_yours
//! ```

use mceip::{Error, Problem};

fn main() -> Result<(), Error> {
    let problem = Problem::read("spec/examples/fold.json")?;

    let good = problem.certify(1.9999999, &[0.66667, 0.33333])?;
    println!("proved: {}", good.solution);
    println!("x = {:?}", good.solution.x);

    match problem.certify(2.5, &[0.5, 0.5]) {
        Err(Error::NotCertified(reason)) => println!("not proved: {reason}"),
        Err(other) => return Err(other),
        Ok(wrong) => println!("proved: {}", wrong.solution),
    }
    Ok(())
}
