//! Short names: what stands beside the markers where there is little room, each another one.

use std::collections::BTreeMap;

/// What stands for letters that are left out.
const CUT: char = '\u{2026}';

/// The names in at most so many letters, at least 4: a longer one is cut at its end; where two
/// would then be alike, in the middle, so far back that they differ; and where that does not help,
/// as for one name twice, it ends with its number from 1.
pub(super) fn short_names(names: &[String], letters: usize) -> Vec<String> {
    let letters = letters.max(4);
    let mut short: Vec<String> = names
        .iter()
        .map(|name| ending_with(name, 0, letters))
        .collect();

    for ending in 1..=letters - 2 {
        let alike = alike(&short);
        for &k in &alike {
            short[k] = ending_with(&names[k], ending, letters);
        }
        if alike.is_empty() {
            return short;
        }
    }

    for k in alike(&short) {
        let number = (k + 1).to_string();
        let kept = letters.saturating_sub(number.chars().count() + 1);
        let beginning: String = names[k].chars().take(kept).collect();
        short[k] = format!("{beginning}{CUT}{number}");
    }
    short
}

/// The name, or its beginning and so many of its last letters.
fn ending_with(name: &str, ending: usize, letters: usize) -> String {
    let count = name.chars().count();
    if count <= letters {
        return name.into();
    }

    let beginning: String = name.chars().take(letters - 1 - ending).collect();
    let end: String = name.chars().skip(count - ending).collect();
    format!("{beginning}{CUT}{end}")
}

/// Those that another one is equal to.
fn alike(names: &[String]) -> Vec<usize> {
    let mut count: BTreeMap<&str, usize> = BTreeMap::new();
    for name in names {
        *count.entry(name).or_default() += 1;
    }

    let is_alike = |k: &usize| count.get(names[*k].as_str()) > Some(&1);
    (0..names.len()).filter(is_alike).collect()
}

#[cfg(test)]
mod tests {
    use super::short_names;

    fn short(names: &[&str]) -> Vec<String> {
        let names: Vec<String> = names.iter().map(|name| name.to_string()).collect();
        short_names(&names, 10)
    }

    #[test]
    fn no_two_names_are_cut_alike() {
        let expected = [
            "contact-\u{2026}1",
            "contact-\u{2026}2",
            "contact-a\u{2026}",
            "7",
        ];
        let names = ["contact-node-1", "contact-node-2", "contact-actual", "7"];
        assert_eq!(short(&names), expected);

        let expected = ["contact\u{2026}01", "contact\u{2026}11"];
        assert_eq!(short(&["contact-node-01", "contact-node-11"]), expected);
        let expected = ["the same\u{2026}1", "the same\u{2026}2", "another"];
        assert_eq!(
            short(&["the same name", "the same name", "another"]),
            expected
        );
        assert_eq!(short(&["heel", "heel"]), ["heel\u{2026}1", "heel\u{2026}2"]);
    }

    #[test]
    fn names_with_room_stay() {
        assert_eq!(short(&["heel", "ten letter"]), ["heel", "ten letter"]);
        assert_eq!(short(&["eleven lett"]), ["eleven le\u{2026}"]);
        assert!(short(&[]).is_empty());
    }
}
