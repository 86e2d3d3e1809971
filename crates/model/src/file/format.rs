//! The field `format`, by which a file says what it is: checked before anything else is read. Types
//! that are read or written here do not have it as a field, and complaints about their fields do
//! not list it.

use super::{Object, from_json, from_json_with_unique_keys};
use crate::ModelError;
use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::marker::PhantomData;

/// The name of the field.
const FIELD: &str = "format";

/// A file as it is written.
#[derive(Serialize)]
struct OfFormat<'a, T> {
    format: &'static str,
    #[serde(flatten)]
    content: &'a T,
}

/// The text of a file of this format, on one line.
///
/// The content is a struct of strings, numbers and lists, so that writing it cannot fail.
pub fn to_json_of<T: Serialize>(format: &'static str, content: &T) -> String {
    serde_json::to_string(&OfFormat { format, content }).unwrap_or_default()
}

/// The same with a line for each field, and a line end behind it.
pub fn to_pretty_json_of<T: Serialize>(format: &'static str, content: &T) -> String {
    serde_json::to_string_pretty(&OfFormat { format, content }).unwrap_or_default() + "\n"
}

/// Reads a file of this format, an object: its content is what stands beside `format`.
///
/// # Errors
/// As [`require_format`]; [`ModelError::Json`] where the content is not of its type.
///
/// ```
/// use mceip_model::file::from_json_of;
/// #[derive(serde::Deserialize)]
/// #[serde(deny_unknown_fields)]
/// struct Point { x: u8 }
/// let read = |text| from_json_of::<Point>("point/1", text).map(|point| point.x);
/// assert_eq!(read(r#"{"x": 2, "format": "point/1"}"#), Ok(2));
/// assert!(read(r#"{"x": 2}"#).is_err() && read(r#"{"x": 2, "format": "point/2"}"#).is_err());
/// ```
pub fn from_json_of<'a, T: Deserialize<'a>>(
    format: &'static str,
    text: &'a str,
) -> Result<T, ModelError> {
    require_format(text, format)?;
    let BesideFormat(content) = from_json(text)?;
    Ok(content)
}

/// [`from_json_of`] for content of which a part is kept as it is: no object may have a key twice.
///
/// # Errors
/// As [`from_json_of`].
pub fn from_json_of_with_unique_keys<'a, T: Deserialize<'a>>(
    format: &'static str,
    text: &'a str,
) -> Result<T, ModelError> {
    require_format(text, format)?;
    let BesideFormat(content) = from_json_with_unique_keys(text)?;
    Ok(content)
}

/// Checks the `format` field before anything else, so that another version is named as such.
///
/// # Errors
/// [`ModelError::Json`] if the text is no JSON object, [`ModelError::Format`] for another version.
pub fn require_format(text: &str, expected: &'static str) -> Result<(), ModelError> {
    #[derive(Deserialize)]
    struct FormatHeader {
        format: Option<serde_json::Value>,
    }

    let Object(header): Object<FormatHeader> = from_json(text)?;
    match header.format {
        Some(serde_json::Value::String(s)) if s == expected => Ok(()),
        Some(other) => Err(ModelError::Format {
            expected,
            got: other.to_string().chars().take(60).collect(),
        }),
        None => Err(ModelError::Format {
            expected,
            got: "no format field".into(),
        }),
    }
}

/// What stands in an object beside `format`, which has been checked and stands there once.
struct BesideFormat<T>(T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for BesideFormat<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Fields<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for Fields<T> {
            type Value = T;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
                T::deserialize(MapAccessDeserializer::new(WithoutFormat(map)))
            }
        }

        let content = deserializer.deserialize_map(Fields(PhantomData))?;
        Ok(BesideFormat(content))
    }
}

/// The fields of an object but `format`.
struct WithoutFormat<A>(A);

impl<'de, A: MapAccess<'de>> MapAccess<'de> for WithoutFormat<A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, A::Error> {
        let mut key: Option<String> = self.0.next_key()?;
        while key.as_deref() == Some(FIELD) {
            self.0.next_value::<IgnoredAny>()?;
            key = self.0.next_key()?;
        }

        let key = key.map(|key| seed.deserialize(key.into_deserializer()));
        key.transpose()
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.0.next_value_seed(seed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Point {
        x: u8,
        of: Option<Box<Point>>,
    }

    fn read(text: &str) -> Result<Point, ModelError> {
        from_json_of("point/1", text)
    }

    #[test]
    fn what_is_written_is_read_with_its_format_first() {
        let point = Point { x: 3, of: None };
        let text = to_json_of("point/1", &point);

        assert_eq!(text, r#"{"format":"point/1","x":3,"of":null}"#);
        assert_eq!(read(&text).as_ref(), Ok(&point));
        assert_eq!(read(&to_pretty_json_of("point/1", &point)), Ok(point));
    }

    #[test]
    fn the_format_stands_once_in_the_outermost_object_alone() {
        let escaped = "{\"x\": 3, \"f\\u006frmat\": \"point/1\"}";
        assert_eq!(read(escaped), Ok(Point { x: 3, of: None }));

        for refused in [
            r#"{"format": "point/1", "x": 3, "format": "point/1"}"#,
            r#"{"format": "point/1", "x": 3, "of": {"format": "point/1", "x": 4}}"#,
            r#"{"format": "point/1", "x": 3, "x": 3}"#,
            r#"{"format": "point/1", "x": 3, "y": 3}"#,
            r#"{"format": "point/1", "x": 3} {}"#,
            r#"["point/1", 3]"#,
        ] {
            let is_json = matches!(read(refused), Err(ModelError::Json { .. }));
            assert!(is_json, "{refused}: {:?}", read(refused));
        }
        for other in [
            r#"{"x": 3}"#,
            r#"{"format": null, "x": 3}"#,
            r#"{"format": ["point/1"]}"#,
        ] {
            assert!(
                matches!(read(other), Err(ModelError::Format { .. })),
                "{other}"
            );
        }
    }

    #[test]
    fn complaints_have_the_place_in_the_file() {
        let refused = read("{\"format\": \"point/1\",\n \"y\": 3}");
        let Err(ModelError::Json { location, problem }) = refused else {
            panic!("{refused:?}")
        };

        assert_eq!(location.line, 2);
        assert_eq!(problem, "unknown field `y`, expected `x` or `of`");
    }
}
