//! Values that stand in JSON in one form and no other.
//!
//! By itself serde reads a struct from a list of its fields too, and a word of an enum from an
//! object `{"word": null}`. [`Object`], [`Word`] and [`WordOrKind`] refuse that, so that a file has
//! one spelling and every reader of the format, in whatever language, accepts the same files.

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, IntoDeserializer, MapAccess, Visitor};
use std::marker::PhantomData;

/// A value read from a JSON object only.
///
/// ```
/// use mceip_model::file::Object;
/// #[derive(serde::Deserialize)]
/// struct Window { min: u8, max: u8 }
/// let read = |text| serde_json::from_str::<Object<Window>>(text).map(|w| (w.0.min, w.0.max));
/// assert_eq!(read(r#"{"min": 1, "max": 2}"#).unwrap(), (1, 2));
/// assert!(read("[1, 2]").is_err() && serde_json::from_str::<Window>("[1, 2]").is_ok());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Object<T>(pub T);

/// A value read from a JSON string only: a word of an enum without data.
///
/// ```
/// use mceip_model::file::Word;
/// #[derive(Debug, PartialEq, serde::Deserialize)]
/// #[serde(rename_all = "lowercase")]
/// enum State {
///     Free,
///     Stick,
/// }
/// let read = |text| serde_json::from_str::<Word<State>>(text).map(|w| w.0);
/// assert_eq!(read(r#""stick""#).unwrap(), State::Stick);
/// assert!(
///     read(r#"{"stick": null}"#).is_err()
///         && serde_json::from_str::<State>(r#"{"stick": null}"#).is_ok()
/// );
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Word<T>(pub T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Word<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        T::deserialize(word.into_deserializer()).map(Word)
    }
}

/// A value of an enum whose variants without data stand in JSON as words, and those with data as
/// objects with one key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WordOrKind<T>(pub T);

/// An enum that [`WordOrKind`] reads.
pub trait HasWords {
    /// Is the variant one without data?
    fn is_word(&self) -> bool;
}

impl<'de, T: Deserialize<'de> + HasWords> Deserialize<'de> for WordOrKind<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de> + HasWords> Visitor<'de> for Either<T> {
            type Value = T;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a word, or an object with one key")
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<T, E> {
                T::deserialize(word.into_deserializer())
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
                let value = T::deserialize(MapAccessDeserializer::new(map))?;
                if value.is_word() {
                    return Err(A::Error::custom(
                        "expected a word, got an object with that key",
                    ));
                }

                Ok(value)
            }
        }

        let value = deserializer.deserialize_any(Either(PhantomData))?;
        Ok(WordOrKind(value))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MapOnly<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for MapOnly<T> {
            type Value = T;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map))
            }
        }

        deserializer
            .deserialize_map(MapOnly(PhantomData))
            .map(Object)
    }
}
