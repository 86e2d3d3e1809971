//! The places in a JSON text's tree, as JSON pointers.
#![allow(unreachable_pub)]

use serde_json::Value;

/// Pointers to all values that satisfy a condition, in the file's order, each list and object ahead
/// of what is in it.
pub fn places(value: &Value, wanted: &dyn Fn(&Value) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    add_places(value, String::new(), wanted, &mut found);
    found
}

fn add_places(value: &Value, at: String, wanted: &dyn Fn(&Value) -> bool, found: &mut Vec<String>) {
    if wanted(value) {
        found.push(at.clone());
    }

    match value {
        Value::Object(fields) => {
            for (key, field) in fields {
                add_places(field, format!("{at}/{key}"), wanted, found);
            }
        }
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                add_places(item, format!("{at}/{index}"), wanted, found);
            }
        }
        _ => {}
    }
}
