//! Structural mutants of certificate files: changes of the JSON text's tree, with no knowledge of
//! what a field means.
//!
//! The draws know only what JSON shows: numbers, lists, nodes with an outcome or a tree. They reach
//! combinations that nobody would forge by hand, and as the two checkers read the same text, a
//! difference between them shows whatever the mutant means.
#![allow(dead_code, missing_docs, unreachable_pub)]

use crate::json_places::places;
use mceip_exact::{Rational, parse, rational};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};

/// Changes one to three things. `pool` lends nodes of other covers.
pub fn mutate(certificate: &mut Value, pool: &[Value], rng: &mut ChaCha8Rng) {
    for _ in 0..rng.random_range(1..=3) {
        match rng.random_range(0..10) {
            0 => change_window(certificate, rng),
            1 => change_outcome(certificate, rng),
            2 | 3 => exchange_node(certificate, pool, rng),
            4 | 5 => change_list(certificate, rng),
            _ => change_number(certificate, rng),
        }
    }
}

fn draw<'a>(list: &'a [String], rng: &mut ChaCha8Rng) -> Option<&'a String> {
    if list.is_empty() {
        None
    } else {
        Some(&list[rng.random_range(0..list.len())])
    }
}

fn as_number(value: &Value) -> Option<Rational> {
    value.as_str().and_then(|text| parse(text).ok())
}

/// A rational, an end of a window as a rule: not an integer.
fn draw_rational(rng: &mut ChaCha8Rng) -> Rational {
    let denominators = [1, 2, 3, 7, 1000];
    let denominator = denominators[rng.random_range(0..5)];

    let largest = 9 * denominator;
    rational(rng.random_range(0..=largest), denominator)
}

fn change_number(certificate: &mut Value, rng: &mut ChaCha8Rng) {
    if rng.random_range(0..4) == 0 {
        change_index(certificate, rng);
    } else {
        change_rational(certificate, rng);
    }
}

/// Indices and counts are JSON numbers.
fn change_index(certificate: &mut Value, rng: &mut ChaCha8Rng) {
    let indices = places(certificate, &Value::is_number);
    let Some(place) = draw(&indices, rng) else {
        return;
    };
    let Some(value) = certificate.pointer_mut(place) else {
        return;
    };

    let old = value.as_i64().unwrap_or(0);
    let candidates = [old + 1, old - 1, 0, 2 * old, -old];
    *value = json!(candidates[rng.random_range(0..5)]);
}

/// Rational numbers are spelt in strings.
fn change_rational(certificate: &mut Value, rng: &mut ChaCha8Rng) {
    let rationals = places(certificate, &|value| as_number(value).is_some());
    let Some(place) = draw(&rationals, rng) else {
        return;
    };
    let Some(other) = draw(&rationals, rng) else {
        return;
    };

    let lent = certificate.pointer(other).cloned();
    let Some(value) = certificate.pointer_mut(place) else {
        return;
    };
    let Some(old) = as_number(value) else { return };
    let is_integer = old.is_integer();

    let new = match rng.random_range(0..8) {
        0 => -old,
        1 => lent.as_ref().and_then(as_number).unwrap_or(old),
        2 => old + rational(1, 1),
        3 => old * rational(1000, 1),
        4 => old * rational(1, 1000),
        5 => draw_rational(rng),
        // So little that doubles do not see it.
        6 => old + rational(1, 10).pow(rng.random_range(0..=30)),
        _ => old * rational(rng.random_range(1..=9), rng.random_range(1..=9)),
    };
    // Most integers of a file have to stay some, or it cannot be read.
    let new = if is_integer && rng.random_range(0..8) != 0 {
        new.round()
    } else {
        new
    };
    *value = json!(new.to_string());
}

/// Drops, doubles or exchanges items of a list.
fn change_list(certificate: &mut Value, rng: &mut ChaCha8Rng) {
    let lists = places(certificate, &is_filled_list);
    let Some(place) = draw(&lists, rng) else {
        return;
    };
    let Some(Value::Array(items)) = certificate.pointer_mut(place) else {
        return;
    };

    let first = rng.random_range(0..items.len());
    let second = rng.random_range(0..items.len());

    match rng.random_range(0..3) {
        0 => {
            items.remove(first);
        }
        1 => items.insert(second, items[first].clone()),
        _ => items.swap(first, second),
    }
}

fn is_filled_list(value: &Value) -> bool {
    value.as_array().is_some_and(|items| !items.is_empty())
}

/// Another window, with the ends of the cover moved along; every third time with those left as they
/// are.
fn change_window(certificate: &mut Value, rng: &mut ChaCha8Rng) {
    let min = draw_rational(rng);
    let max = if rng.random_range(0..2) == 0 {
        json!(null)
    } else {
        json!((&min + draw_rational(rng)).to_string())
    };

    let is_min = rng.random_range(0..2) == 0;
    if is_min {
        certificate["window"]["min"] = json!(min.to_string());
        return;
    }

    certificate["window"]["max"] = max.clone();
    let pieces = certificate.pointer_mut("/complete_set/pieces");
    let Some(Value::Array(pieces)) = pieces else {
        return;
    };
    let Some(last) = pieces.last_mut() else {
        return;
    };
    if rng.random_range(0..3) != 0 {
        last["max"] = max;
    }
}

/// Another outcome of a root leaf, or an interval at the ends of the window.
fn change_outcome(certificate: &mut Value, rng: &mut ChaCha8Rng) {
    let window = certificate["window"].clone();
    let roots = places(certificate, &|v| v.get("outcome").is_some());
    let Some(root) = draw(&roots, rng).and_then(|at| certificate.pointer_mut(at)) else {
        return;
    };

    let index = rng.random_range(0..4);
    match rng.random_range(0..8) {
        0 => root["outcome"] = json!("solution"),
        1 => root["outcome"] = json!("absent"),
        2 => root["outcome"] = json!({ "negative_x": index }),
        3 => root["outcome"] = json!({ "negative_y": index }),
        4 => root["outcome"] = json!({ "claim": index }),
        5 => {
            let x = (0..rng.random_range(1..=5)).map(|_| rng.random_range(-1..=2).to_string());
            root["outcome"] = json!({ "infinity": x.collect::<Vec<String>>() });
        }
        6 => set_end(root, 0, window["min"].clone()),
        _ if window["max"].is_null() => set_end(root, 1, json!(draw_rational(rng).to_string())),
        _ => set_end(root, 1, window["max"].clone()),
    }
}

/// Sets one end of a leaf's interval, if an earlier mutation left it that end.
fn set_end(leaf: &mut Value, end: usize, to: Value) {
    if let Some(place) = leaf.pointer_mut(&format!("/interval/{end}")) {
        *place = to;
    }
}

/// A node of a tree by another one, of this or of another cover; every fourth time the nodes behind
/// it go too, and what follows them is closed by what is left over.
fn exchange_node(certificate: &mut Value, pool: &[Value], rng: &mut ChaCha8Rng) {
    let trees = places(certificate, &|v| v.get("tree").is_some());
    let Some(piece) = draw(&trees, rng).and_then(|at| certificate.pointer_mut(at)) else {
        return;
    };
    let Some(tree) = piece["tree"].as_array_mut().filter(|tree| !tree.is_empty()) else {
        return;
    };

    let at = rng.random_range(0..tree.len());
    let own = tree[rng.random_range(0..tree.len())].clone();
    let node = match rng.random_range(0..4) {
        0 => own,
        1 => json!("open"),
        2 => json!(["positive_definite", "negative_definite", "tail"][rng.random_range(0..3)]),
        _ if !pool.is_empty() => pool[rng.random_range(0..pool.len())].clone(),
        _ => return,
    };

    let is_cut = rng.random_range(0..4) == 0;
    let count = if is_cut { rng.random_range(1..=4) } else { 1 };
    let end = (at + count).min(tree.len());
    tree.splice(at..end, [node]);
}
