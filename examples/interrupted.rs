//! A long search that is ended early and taken up again: nothing that was proved is lost.
//!
//! ```text
//! cargo run --release --example interrupted
//! ```

use mceip::{Cancel, Error, Problem, Progress};

fn main() -> Result<(), Error> {
    let problem = Problem::read("spec/examples/oblique.json")?;

    let cancel = Cancel::new();
    let end_after_two_leaves = |progress: &Progress<'_>| {
        println!("{progress}");
        if progress.done >= 2 {
            cancel.request();
        }
    };
    let part = problem
        .complete()
        .threads(1)
        .cancel(&cancel)
        .on_progress(end_after_two_leaves)
        .run()?;
    println!("ended with {} regions open", part.open().len());

    let all = problem.complete().resume(part.certificate()).run()?;
    println!(
        "complete: {}, {} solutions",
        all.is_complete(),
        all.solutions().len()
    );
    Ok(())
}
