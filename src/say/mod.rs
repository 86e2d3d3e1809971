//! What the answers are in words: sentences of the results of the front door.
//!
//! The texts are data of no other part: the front door hands over numbers, intervals and counts,
//! and every sentence about them is made here. Called by the front door and the program.

pub(crate) mod cover;
pub(crate) mod enumeration;
pub(crate) mod own_critical;
pub(crate) mod path;
pub(crate) mod path_analysis;
pub(crate) mod search;
pub(crate) mod stretches;

use mceip_exact::{Rational, nearest_decimal, parse};
use mceip_model::{Body, Problem};

/// What looked wrong when a file was made, a line each.
pub(crate) fn warnings_text(warnings: &[String]) -> String {
    let mut out = String::new();
    for warning in warnings {
        let printable = warning.replace(char::is_control, " ");
        out += &format!("WARNING of convert: {printable}.\n");
    }

    out
}

/// A mu as a decimal where it is a short one, else as a fraction.
pub(crate) fn mu_text(mu: &Rational) -> String {
    let decimal = nearest_decimal(mu, 15);
    if parse(&decimal).is_ok_and(|value| value == *mu) {
        decimal
    } else {
        mu.to_string()
    }
}

/// "slip [0, 2]", the variables of a support; where all of them belong to particles with names,
/// "slip [0, 2] (heel, toe)".
pub(crate) fn slip_text(problem: &Problem, support: &[usize]) -> String {
    let numbers = format!("slip {support:?}");
    let Body::System(system) = problem.body() else {
        return numbers;
    };

    // The variables of the slip particles follow the free ones, in the order of the particles.
    let free = system.free_dofs().len();
    let slipping = system.slip_particles();
    let name_of = |variable: &usize| {
        let (particle, _) = slipping.get(variable.checked_sub(free)?)?;
        particle.name.as_deref()
    };
    let names: Option<Vec<&str>> = support.iter().map(name_of).collect();

    match names {
        Some(names) if !names.is_empty() => format!("{numbers} ({})", names.join(", ")),
        _ => numbers,
    }
}

/// "1 warning", "2 warnings", "2 stretches".
pub(crate) fn counted(count: usize, noun: &str) -> String {
    let plural = match noun {
        _ if count == 1 => "",
        noun if noun.ends_with("ch") => "es",
        _ => "s",
    };
    format!("{count} {noun}{plural}")
}
