//! A struct that stands in JSON as an object and nothing else: by itself serde reads one from a list of its fields too.

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use std::marker::PhantomData;

/// A value read from a JSON object only.
///
/// ```
/// use mceip::model::file::Object;
/// #[derive(serde::Deserialize)]
/// struct Window { min: u8, max: u8 }
/// let read = |text| serde_json::from_str::<Object<Window>>(text).map(|w| (w.0.min, w.0.max));
/// assert_eq!(read(r#"{"min": 1, "max": 2}"#).unwrap(), (1, 2));
/// assert!(read("[1, 2]").is_err() && serde_json::from_str::<Window>("[1, 2]").is_ok());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Object<T>(pub T);

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
        deserializer.deserialize_map(MapOnly(PhantomData)).map(Object)
    }
}
