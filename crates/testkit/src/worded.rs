//! Enumerations with a word and a note for each variant, both written once.

/// An enumeration whose variants have a word for files and a note for people.
macro_rules! worded {
    ($(#[$doc:meta])* $name:ident: $($variant:ident $word:literal $note:literal,)+) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[derive(serde::Serialize, serde::Deserialize)]
        #[serde(try_from = "String")]
        #[allow(missing_docs, reason = "the note of each is its documentation")]
        pub enum $name { $(#[serde(rename = $word)] $variant,)+ }

        impl $name {
            /// All of them, in the order of tables.
            pub const ALL: &'static [$name] = &[$($name::$variant,)+];

            /// As it stands in files and tables.
            pub fn word(self) -> &'static str {
                match self { $($name::$variant => $word,)+ }
            }

            /// The one with this word.
            pub fn of_word(word: &str) -> Option<$name> {
                $name::ALL.iter().copied().find(|one| one.word() == word)
            }

            /// What it means, in a sentence for people.
            pub fn note(self) -> &'static str {
                match self { $($name::$variant => $note,)+ }
            }
        }

        impl TryFrom<String> for $name {
            type Error = String;

            /// From a string alone: serde's own reader of variants takes `{"word": null}` too.
            fn try_from(word: String) -> Result<$name, String> {
                let words = [$($word,)+].join(", ");
                let expected = || format!("got {word:?}, expected one of {words}");
                $name::of_word(&word).ok_or_else(expected)
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use crate::conform::Difficulty;

    #[test]
    fn a_word_is_read_from_a_string_alone() {
        let read = |text: &str| serde_json::from_str::<Difficulty>(text);
        assert_eq!(read("\"easy\"").unwrap(), Difficulty::Easy);

        let map = read("{\"easy\": null}").unwrap_err().to_string();
        assert!(map.contains("expected a string"), "{map}");
        let other = read("\"simple\"").unwrap_err().to_string();
        let words = "got \"simple\", expected one of easy, medium, hard";
        assert!(other.starts_with(words), "{other}");
    }
}
