//! Somebody has sent you a certificate. Whoever made it, and however: check it.
//!
//! ```text
//! cargo run --release --example check_certificate
//! ```

use mceip::{Certificate, Problem, check};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let problem = Problem::read("spec/examples/fold.json")?;
    // Theirs would be a file.
    let text = problem.complete().run()?.certificate().to_json();

    let certificate = Certificate::from_json(&text)?;
    let accepted = check(&problem, &certificate)?;
    println!(
        "{} solutions proved",
        accepted.cover.map_or(0, |c| c.solutions.len())
    );

    // A certificate names its problem: it proves nothing about another one.
    let other = Problem::read("spec/examples/two-particles.json")?;
    match check(&other, &certificate) {
        Err(rejected) => println!("rejected: {rejected}"),
        Ok(_) => println!("accepted"),
    }
    Ok(())
}
