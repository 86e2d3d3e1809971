//! An engineer's question: K and M of a body in contact are at hand, and one contact particle is
//! about to slip. Can the equilibrium diverge at mu = 1.5, and from which friction on?
//!
//! ```text
//! cargo run --release --example engineer
//! ```

use mceip::{ContactState, Matrix, Particle, Problem};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A particle on two springs, one of them oblique; degrees of freedom: tangential, normal.
    let stiffness = Matrix::from_rows(&[[2.0, 1.5], [1.5, 2.0]])?;
    let mass = Matrix::identity(2);
    let contact = Particle::plain(0, 1, ContactState::Slip { sign: -1 });

    let friction = "1.5".parse()?;
    let problem = Problem::from_matrices(stiffness, mass, friction, vec![contact])?;
    let answer = problem.analyze().run()?;

    for sentence in answer.sentences() {
        println!("{}", sentence.text);
    }
    Ok(())
}
