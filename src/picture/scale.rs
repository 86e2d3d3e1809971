//! From numbers to places on paper: linear, logarithmic, and logarithmic with a zero; round ticks.
//!
//! With the function f of the spread (v, ln v or asinh(v / unit)) the number v lies at
//!
//! ```text
//! p_0 + (f(v) - f(v_0)) / (f(v_1) - f(v_0)) (p_1 - p_0),
//! ```
//!
//! v_0 and v_1 the numbers at the ends of the axis, p_0 and p_1 their places in px.

use super::markup::short_to;

/// How numbers are spread over an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spread {
    /// Evenly.
    Linear,
    /// By their logarithm; all must be positive.
    Log,
    /// Like [`Spread::Log`] well above `unit`, evenly below it, zero included: asinh(v / `unit`).
    LogWithZero {
        /// Where it turns from even to logarithmic, > 0.
        unit: f64,
    },
}

/// An axis: the numbers it shows and where its ends lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    spread: Spread,
    values: (f64, f64),
    places: (f64, f64),
}

impl Scale {
    /// From `values.0` at `places.0` to `values.1` at `places.1`.
    ///
    /// Values that make no axis are replaced by the nearest that do: those that are not finite,
    /// equal, in the wrong order, or not positive under a logarithm.
    pub fn new(spread: Spread, values: (f64, f64), places: (f64, f64)) -> Scale {
        let is_log = spread == Spread::Log;
        let mut low = finite_or(values.0, 0.0);
        let mut high = finite_or(values.1, 1.0);

        if is_log {
            high = if high > 0.0 { high } else { 1.0 };
            low = if low > 0.0 { low } else { high / 10.0 };
        }

        if low >= high {
            let middle = high;
            low = if is_log { middle / 2.0 } else { middle - 0.5 };
            high = if is_log { middle * 2.0 } else { middle + 0.5 };
        }

        Scale {
            spread,
            values: (low, high),
            places,
        }
    }

    /// The place of a number; numbers beyond an end lie at that end.
    pub fn place(&self, value: f64) -> f64 {
        let value = value.clamp(self.values.0, self.values.1);
        let low = self.spread_out(self.values.0);
        let high = self.spread_out(self.values.1);

        let length = self.places.1 - self.places.0;
        self.places.0 + (self.spread_out(value) - low) / (high - low) * length
    }

    /// Does the axis show this number?
    pub fn shows(&self, value: f64) -> bool {
        (self.values.0..=self.values.1).contains(&value)
    }

    /// Where its ends lie.
    pub fn places(&self) -> (f64, f64) {
        self.places
    }

    /// Round numbers on the axis, about `wanted` of them.
    pub fn ticks(&self, wanted: usize) -> Vec<f64> {
        let (low, high) = self.values;
        let ticks = match self.spread {
            Spread::Linear => linear_ticks(low, high, wanted),
            Spread::Log => decades(low, high, wanted),
            Spread::LogWithZero { unit } => {
                let mut all = decades(unit.max(low), high, wanted);
                all.insert(0, 0.0);
                all
            }
        };

        ticks.into_iter().filter(|t| self.shows(*t)).collect()
    }

    /// The function of a number that grows evenly along the axis.
    fn spread_out(&self, value: f64) -> f64 {
        match self.spread {
            Spread::Linear => value,
            Spread::Log => value.ln(),
            Spread::LogWithZero { unit } => (value / unit).asinh(),
        }
    }
}

/// The smallest and the largest of some positive numbers; without any, infinity and 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Extent {
    /// The extent of these numbers.
    pub(super) fn of(numbers: impl Iterator<Item = f64>) -> Extent {
        let mut low = f64::INFINITY;
        let mut high: f64 = 0.0;
        for number in numbers {
            low = low.min(number);
            high = high.max(number);
        }

        Extent { low, high }
    }
}

fn finite_or(value: f64, instead: f64) -> f64 {
    if value.is_finite() { value } else { instead }
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn linear_ticks(low: f64, high: f64, wanted: usize) -> Vec<f64> {
    let rough_step = (high - low) / wanted.max(1) as f64;
    let power = 10f64.powf(rough_step.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|s| s * power)
        .find(|s| *s >= rough_step)
        .unwrap_or(10.0 * power);

    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// Powers of ten; every few of them on a long axis, with 2 and 5 between them on a short one.
fn decades(low: f64, high: f64, wanted: usize) -> Vec<f64> {
    let first = low.log10().floor() as i32;
    let last = high.log10().ceil() as i32;
    let count = (last - first + 1).max(1) as usize;
    let every = count.div_ceil(wanted.max(1)).max(1);
    let has_room = 3 * count <= wanted;
    let parts: &[f64] = if has_room { &[1.0, 2.0, 5.0] } else { &[1.0] };

    let mut ticks = Vec::new();
    for exponent in (first..=last).step_by(every) {
        for part in parts {
            ticks.push(part * 10f64.powi(exponent));
        }
    }

    ticks
}

/// A tick's label: plain from 0.001 to 9999, a power of ten beyond.
pub(super) fn label(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }

    let size = value.abs();
    if (0.001..10_000.0).contains(&size) {
        return short_to(value, 4);
    }

    let exponent = size.log10().floor() as i32;
    let mantissa = short_to(value / 10f64.powi(exponent), 2);
    let power: String = exponent.to_string().chars().map(superscript).collect();

    if mantissa == "1" {
        format!("10{power}")
    } else {
        format!("{mantissa}\u{b7}10{power}")
    }
}

/// A digit or the minus sign, raised.
fn superscript(c: char) -> char {
    match c {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        d => d
            .to_digit(10)
            .and_then(|d| char::from_u32(0x2070 + d))
            .unwrap_or(c),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT_LENGTH: (f64, f64) = (0.0, 1.0);

    #[test]
    fn places_follow_the_spread() {
        let linear = Scale::new(Spread::Linear, (0.0, 10.0), (100.0, 300.0));
        let places = [0.0, 5.0, 10.0, 99.0].map(|v| linear.place(v));
        assert_eq!(places, [100.0, 200.0, 300.0, 300.0]);
        assert!(linear.shows(10.0));
        assert!(!linear.shows(10.5));

        let log = Scale::new(Spread::Log, (1.0, 100.0), (300.0, 100.0));
        assert!((log.place(10.0) - 200.0).abs() < 0.001);
    }

    /// Far above the unit each decade is as long as the next one.
    #[test]
    fn a_logarithmic_axis_may_have_a_zero() {
        let spread = Spread::LogWithZero { unit: 1.0 };
        let scale = Scale::new(spread, (0.0, 10_000.0), UNIT_LENGTH);
        assert_eq!(scale.place(0.0), 0.0);

        let from_100 = scale.place(1000.0) - scale.place(100.0);
        let from_1000 = scale.place(10_000.0) - scale.place(1000.0);
        assert!((from_100 - from_1000).abs() < 0.001);
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let linear = Scale::new(Spread::Linear, (0.0, 6.2), UNIT_LENGTH);
        assert_eq!(linear.ticks(6), [0.0, 2.0, 4.0, 6.0]);

        let log = Scale::new(Spread::Log, (1.5, 20_000.0), UNIT_LENGTH);
        assert_eq!(log.ticks(6), [10.0, 100.0, 1000.0, 10_000.0]);

        let one_decade = Scale::new(Spread::Log, (1.0, 9.0), UNIT_LENGTH);
        assert_eq!(one_decade.ticks(8), [1.0, 2.0, 5.0]);

        let spread = Spread::LogWithZero { unit: 10.0 };
        let with_zero = Scale::new(spread, (0.0, 1000.0), UNIT_LENGTH);
        assert_eq!(with_zero.ticks(3), [0.0, 10.0, 100.0, 1000.0]);
    }

    #[test]
    fn odd_ranges_make_an_axis_all_the_same() {
        let ranges = [
            (1.0, 1.0),
            (f64::NAN, f64::INFINITY),
            (3.0, -2.0),
            (0.0, 0.0),
            (-5.0, -5.0),
        ];
        let spreads = [
            Spread::Linear,
            Spread::Log,
            Spread::LogWithZero { unit: 1.0 },
        ];

        for values in ranges {
            for spread in spreads {
                let scale = Scale::new(spread, values, (0.0, 100.0));

                let case = format!("{values:?} {spread:?}");
                assert!(scale.place(1.0).is_finite(), "{case}");
                assert!((0.0..=100.0).contains(&scale.place(2.0)), "{case}");
                assert!(scale.ticks(5).len() < 30, "{case}");
            }
        }
    }

    #[test]
    fn labels_are_short() {
        let labels = [0.0, 0.25, 1.5, 1000.0, 100_000.0, 250_000.0, 0.00001].map(label);

        assert_eq!(labels[..4], ["0", "0.25", "1.5", "1000"]);
        assert_eq!(labels[4], "10\u{2075}");
        assert_eq!(labels[5], "2.5\u{b7}10\u{2075}");
        assert_eq!(labels[6], "10\u{207b}\u{2075}");
    }
}
