//! Somebody has sent you a certificate. Whoever made it, and however: check it. This needs neither
//! solver nor search:
//!
//! ```text
//! cargo run --release --no-default-features --example check_certificate
//! ```

use mceip::{Certificate, Problem, check};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = "spec/examples/certificates";
    let problem = Problem::read(format!("{folder}/exact.problem.json"))?;
    let text = std::fs::read_to_string(format!("{folder}/exact.json"))?;

    let certificate = Certificate::from_json(&text)?;
    let accepted = check(&problem, &certificate)?;
    for claim in accepted.claims {
        println!("proved: a solution with support {:?}", claim.support);
    }

    // A certificate names its problem: it proves nothing about another one.
    let other = Problem::read("spec/examples/fold.json")?;
    match check(&other, &certificate) {
        Err(rejected) => println!("rejected: {rejected}"),
        Ok(_) => println!("accepted"),
    }
    Ok(())
}
