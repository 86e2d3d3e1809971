//! What an enumeration has examined, in words.

use mceip_oracle::{Enumeration, ModeList};

/// What the enumeration has examined.
pub(crate) fn of_supports(found: &Enumeration) -> String {
    let done = found.supports_done;
    let total = found.supports_total;
    let how = "every one by exact arithmetic";

    if !found.is_finished() {
        format!("the plain enumeration was interrupted after {done} of {total} supports: {how}")
    } else if found.is_complete_list() {
        format!("complete, by the plain enumeration of {total} supports: {how}")
    } else {
        format!(
            "all {total} supports examined by the plain enumeration: {how}; what is named \
             without a description is left open"
        )
    }
}

/// What the enumeration of modes has examined.
pub(crate) fn of_modes(found: &ModeList) -> String {
    let done = found.choices;
    let total = found.choices_total;
    let how = "every one by exact arithmetic";

    if !found.is_finished() {
        format!(
            "the plain enumeration was interrupted after {done} of {total} choices of modes: {how}"
        )
    } else if found.is_complete_list() {
        format!("complete, by the plain enumeration of {total} choices of modes: {how}")
    } else {
        let open = found.degenerate.len();
        format!(
            "all {total} choices of modes examined by the plain enumeration: {how}; of {open} \
             of them, which are singular, the solutions are not listed"
        )
    }
}
