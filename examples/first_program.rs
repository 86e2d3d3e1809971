//! Read a problem, find solutions, find all of them with a proof, check the proof.
//!
//! ```text
//! cargo run --release --example first_program
//! ```

use mceip::{Error, Problem, check};

fn main() -> Result<(), Error> {
    let problem = Problem::read("spec/examples/fold.json")?;

    let found = problem.solve().starts(22).run()?;
    for solution in &found.solutions {
        println!("found {solution}");
    }

    let all = problem.complete().run()?;
    println!(
        "in all {}, complete: {}",
        all.solutions().len(),
        all.is_complete()
    );

    check(&problem, all.certificate())?;
    println!("the certificate is accepted");
    Ok(())
}
