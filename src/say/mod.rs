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
use mceip_model::{Body, Problem, RealWindow};

/// What looked wrong when a file was made, a line each.
pub(crate) fn warnings_text(warnings: &[String]) -> String {
    let mut out = String::new();
    for warning in warnings {
        let printable = warning.replace(char::is_control, " ");
        out += &format!("WARNING of convert: {printable}.\n");
    }

    out
}

/// A number as a decimal where a short one is exact, else as a fraction.
pub(crate) fn number_text(value: &Rational) -> String {
    let decimal = nearest_decimal(value, 17);
    if parse(&decimal).is_ok_and(|read| read == *value) {
        decimal
    } else {
        value.to_string()
    }
}

/// "[0, 2.5]" or "[0, infinity)".
pub(crate) fn window_text(window: impl Into<RealWindow>) -> String {
    let window = window.into();
    range_text(window.min(), window.max())
}

/// The same of a part of a window; no end is infinity.
pub(crate) fn range_text(min: Option<&Rational>, max: Option<&Rational>) -> String {
    let min = min.map_or_else(
        || "(-infinity".into(),
        |min| format!("[{}", number_text(min)),
    );
    let max = max.map_or_else(
        || "infinity)".into(),
        |max| format!("{}]", number_text(max)),
    );
    format!("{min}, {max}")
}

/// "support [0, 2]", the variables of a support; where all of them belong to particles with names,
/// "support [0, 2] (heel, toe)".
pub(crate) fn support_text(problem: &Problem, support: &[usize]) -> String {
    let numbers = format!("support {support:?}");
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
