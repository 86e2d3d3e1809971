//! How many of a thing, in words.

use std::fmt::Display;

/// "1 warning", "2 warnings", "2 stretches", "2 families", "2 leaves".
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, noun: &str) -> String {
    if count == N::from(1) {
        return format!("{count} {noun}");
    }

    let ends_in = |ends: &[&str]| ends.iter().any(|end| noun.ends_with(end));
    if ends_in(&["ch", "sh", "s", "x"]) {
        return format!("{count} {noun}es");
    }
    if let Some(stem) = noun.strip_suffix("leaf") {
        return format!("{count} {stem}leaves");
    }
    match noun.strip_suffix('y') {
        Some(stem) if !stem.ends_with(['a', 'e', 'o', 'u']) => format!("{count} {stem}ies"),
        _ => format!("{count} {noun}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nouns_agree_with_their_count() {
        assert_eq!(counted(1, "leaf"), "1 leaf");
        assert_eq!(counted(0_u64, "leaf"), "0 leaves");
        assert_eq!(counted(2_usize, "family"), "2 families");
        assert_eq!(counted(2_usize, "entry"), "2 entries");
        assert_eq!(counted(3, "stretch"), "3 stretches");
        assert_eq!(counted(3, "box"), "3 boxes");
        assert_eq!(counted(3, "way"), "3 ways");
        assert_eq!(counted(2, "distinct solution"), "2 distinct solutions");
    }
}
