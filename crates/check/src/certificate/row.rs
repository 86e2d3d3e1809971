//! Rows of integers: of matrices and factors that a certificate brings.
//!
//! A certificate of a large body holds millions of integers of some 40 bits. A row whose entries
//! all have at most [`SHORT_BITS`] bits is kept in machine integers, eight bytes an entry; a row
//! with a longer entry is kept in long integers. Which of the two follows from the entries alone.
//! Clones of a row share its entries: an engine has the same matrices in several places.
//! In a file a row is a list of integers, each a string or a number. Used by `cover` (the data) and
//! by the checks of condensations and factors.

use super::Integer;
use mceip_model::file::Number;
use num_traits::ToPrimitive;
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

/// Bits of the entries of a short row, at most: the checker sums products of such entries in 128
/// bits.
const SHORT_BITS: u64 = 62;

/// Integers in a row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IntegerRow(Entries);

#[derive(Debug, Clone, PartialEq, Eq)]
enum Entries {
    /// All of them have at most [`SHORT_BITS`] bits.
    Short(Arc<[i64]>),
    /// One of them is longer.
    Long(Arc<[Integer]>),
}

/// A row to which integers are appended.
enum GrowingRow {
    Short(Vec<i64>),
    Long(Vec<Integer>),
}

impl GrowingRow {
    fn push(&mut self, entry: Integer) {
        match self {
            GrowingRow::Short(row) if entry.bits() <= SHORT_BITS => row.extend(entry.to_i64()),
            GrowingRow::Short(row) => {
                let before = row.drain(..).map(Integer::from);
                *self = GrowingRow::Long(before.chain([entry]).collect());
            }
            GrowingRow::Long(row) => row.push(entry),
        }
    }

    fn into_row(self) -> IntegerRow {
        IntegerRow(match self {
            GrowingRow::Short(row) => Entries::Short(row.into()),
            GrowingRow::Long(row) => Entries::Long(row.into()),
        })
    }
}

impl IntegerRow {
    /// How many integers these are.
    pub fn len(&self) -> usize {
        match &self.0 {
            Entries::Short(row) => row.len(),
            Entries::Long(row) => row.len(),
        }
    }

    /// Is there none?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Bits of the longest integer, 0 if there is none.
    pub fn bits(&self) -> u64 {
        match &self.0 {
            Entries::Short(row) => {
                let magnitudes = row.iter().map(|entry| entry.unsigned_abs());
                let largest = magnitudes.max().unwrap_or(0);
                u64::from(u64::BITS - largest.leading_zeros())
            }
            Entries::Long(row) => row.iter().map(Integer::bits).max().unwrap_or(0),
        }
    }

    /// The integers in order.
    pub fn iter(&self) -> impl Iterator<Item = Cow<'_, Integer>> {
        let (short, long): (&[i64], &[Integer]) = match &self.0 {
            Entries::Short(row) => (row, &[]),
            Entries::Long(row) => (&[], row),
        };
        let short = short.iter().map(|entry| Cow::Owned(Integer::from(*entry)));
        short.chain(long.iter().map(Cow::Borrowed))
    }

    /// The integers as a list.
    pub fn to_vec(&self) -> Vec<Integer> {
        self.iter().map(Cow::into_owned).collect()
    }

    /// The integer at a position.
    ///
    /// # Panics
    /// If there is none.
    pub fn at(&self, position: usize) -> Cow<'_, Integer> {
        match &self.0 {
            Entries::Short(row) => Cow::Owned(Integer::from(row[position])),
            Entries::Long(row) => Cow::Borrowed(&row[position]),
        }
    }

    /// Changes the integers as a list.
    pub fn edit(&mut self, change: impl FnOnce(&mut Vec<Integer>)) {
        let mut list = self.to_vec();
        change(&mut list);
        *self = list.into();
    }

    /// The integers in machine integers, if all have at most [`SHORT_BITS`] bits.
    pub(crate) fn as_short(&self) -> Option<&[i64]> {
        match &self.0 {
            Entries::Short(row) => Some(row),
            Entries::Long(_) => None,
        }
    }
}

impl FromIterator<Integer> for IntegerRow {
    fn from_iter<I: IntoIterator<Item = Integer>>(integers: I) -> IntegerRow {
        let integers = integers.into_iter();
        let capacity = integers.size_hint().0;
        let mut row = GrowingRow::Short(Vec::with_capacity(capacity));
        for entry in integers {
            row.push(entry);
        }

        row.into_row()
    }
}

impl From<Vec<Integer>> for IntegerRow {
    fn from(integers: Vec<Integer>) -> IntegerRow {
        integers.into_iter().collect()
    }
}

impl Serialize for IntegerRow {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.collect_seq(self.iter().map(|entry| entry.to_string()))
    }
}

impl<'de> Deserialize<'de> for IntegerRow {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<IntegerRow, D::Error> {
        d.deserialize_seq(RowVisitor)
    }
}

struct RowVisitor;

impl<'de> Visitor<'de> for RowVisitor {
    type Value = IntegerRow;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of integers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<IntegerRow, A::Error> {
        let mut row = GrowingRow::Short(Vec::new());
        while let Some(number) = list.next_element::<Number>()? {
            row.push(integer(number)?);
        }

        Ok(row.into_row())
    }
}

fn integer<E: Error>(number: Number) -> Result<Integer, E> {
    if number.0.is_integer() {
        return Ok(number.0.to_integer());
    }

    let message = format!("expected an integer, got {}", number.0);
    Err(E::custom(message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::One;

    fn of_bits(bits: u64) -> Integer {
        (Integer::one() << bits) - 1
    }

    #[test]
    fn rows_are_short_up_to_62_bits_and_say_what_they_hold() {
        for (bits, is_short) in [(0, true), (1, true), (62, true), (63, false), (64, false)] {
            for sign in [1, -1] {
                let list = vec![Integer::one(), of_bits(bits) * sign, -Integer::one()];

                let row = IntegerRow::from(list.clone());

                assert_eq!(row.as_short().is_some(), is_short, "{bits}");
                assert_eq!(row.to_vec(), list);
                assert_eq!(row.at(1).into_owned(), list[1]);
                assert_eq!(row.bits(), bits.max(1));
                assert_eq!((row.len(), row.is_empty()), (3, false));
            }
        }

        let none = IntegerRow::from(Vec::new());
        assert_eq!((none.len(), none.is_empty(), none.bits()), (0, true, 0));
    }

    /// A long entry at any place, read from a file: the row is the one made from the list.
    #[test]
    fn files_give_the_rows_that_lists_give() {
        for place in 0..3 {
            let mut list = vec![Integer::from(5), Integer::from(-7), Integer::from(0)];
            list[place] = -of_bits(70);
            let row = IntegerRow::from(list);

            let text = serde_json::to_string(&row).unwrap();
            assert_eq!(serde_json::from_str::<IntegerRow>(&text).unwrap(), row);
        }

        let mixed: IntegerRow = serde_json::from_str("[3, \"-4\", 4e1]").unwrap();
        assert_eq!(
            mixed,
            IntegerRow::from([3, -4, 40].map(Integer::from).to_vec())
        );
    }

    #[test]
    fn what_is_no_integer_is_refused() {
        for text in ["[\"1/2\"]", "[2.5]", "[null]", "{}", "\"3\"", "[[1]]"] {
            assert!(serde_json::from_str::<IntegerRow>(text).is_err(), "{text}");
        }
    }
}
