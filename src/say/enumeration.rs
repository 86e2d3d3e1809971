//! What an enumeration has examined, in words.

use mceip_engine::report::counted;
use mceip_oracle::{Enumeration, ModeList};

/// What the enumeration has examined.
pub(crate) fn of_supports(found: &Enumeration) -> String {
    let done = found.supports_done;
    let total = counted(found.supports_total, "support");
    let how = "every one by exact arithmetic";

    if !found.is_finished() {
        format!("the plain enumeration was interrupted after {done} of {total}: {how}")
    } else if found.is_complete_list() {
        format!("complete, by the plain enumeration of {total}: {how}")
    } else {
        format!(
            "all {total} examined by the plain enumeration: {how}; what is named \
             without a description is left open"
        )
    }
}

/// What the enumeration of modes has examined.
pub(crate) fn of_modes(found: &ModeList) -> String {
    let done = found.choices;
    let total = counted(found.choices_total, "choice");
    let how = "every one by exact arithmetic";

    if !found.is_finished() {
        format!("the plain enumeration was interrupted after {done} of {total} of modes: {how}")
    } else if found.is_complete_list() {
        format!("complete, by the plain enumeration of {total} of modes: {how}")
    } else {
        let open = found.degenerate.len();
        format!(
            "all {total} of modes examined by the plain enumeration: {how}; of {open} \
             of them, which are singular, the solutions are not listed"
        )
    }
}
