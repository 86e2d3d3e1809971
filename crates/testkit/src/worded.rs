//! Enumerations with a word and a note for each variant, both written once.

/// An enumeration whose variants have a word for files and a note for people.
macro_rules! worded {
    ($(#[$doc:meta])* $name:ident: $($variant:ident $word:literal $note:literal,)+) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[derive(serde::Serialize, serde::Deserialize)]
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
    };
}
