//! From numbers to places on paper: linear, logarithmic, and logarithmic with a zero; round ticks.

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
    /// From `values.0` at `places.0` to `values.1` at `places.1`. Values that are not finite,
    /// equal, in the wrong order, or not positive under a logarithm are replaced by the nearest
    /// that make an axis.
    pub fn new(spread: Spread, values: (f64, f64), places: (f64, f64)) -> Scale {
        let finite = |v: f64, instead: f64| if v.is_finite() { v } else { instead };
        let (mut low, mut high) = (finite(values.0, 0.0), finite(values.1, 1.0));
        if spread == Spread::Log {
            high = if high > 0.0 { high } else { 1.0 };
            low = if low > 0.0 { low } else { high / 10.0 };
        }
        if low >= high {
            (low, high) = if spread == Spread::Log {
                (high / 2.0, high * 2.0)
            } else {
                (high - 0.5, high + 0.5)
            };
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
        let (low, high) = (self.bend(self.values.0), self.bend(self.values.1));
        self.places.0 + (self.bend(value) - low) / (high - low) * (self.places.1 - self.places.0)
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
        let ticks = match self.spread {
            Spread::Linear => linear_ticks(self.values, wanted),
            Spread::Log => decades(self.values, wanted),
            Spread::LogWithZero { unit } => {
                let mut all = decades((unit.max(self.values.0), self.values.1), wanted);
                all.insert(0, 0.0);
                all
            }
        };
        ticks.into_iter().filter(|t| self.shows(*t)).collect()
    }

    fn bend(&self, value: f64) -> f64 {
        match self.spread {
            Spread::Linear => value,
            Spread::Log => value.ln(),
            Spread::LogWithZero { unit } => (value / unit).asinh(),
        }
    }
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn linear_ticks((low, high): (f64, f64), wanted: usize) -> Vec<f64> {
    let rough = (high - low) / wanted.max(1) as f64;
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|s| s * power)
        .find(|s| *s >= rough)
        .unwrap_or(10.0 * power);
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last).map(|k| k as f64 * step).collect()
}

/// Powers of ten; every few of them on a long axis, with 2 and 5 between them on a short one.
fn decades((low, high): (f64, f64), wanted: usize) -> Vec<f64> {
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let count = (last - first + 1).max(1) as usize;
    let every = count.div_ceil(wanted.max(1)).max(1);
    let parts: &[f64] = if 3 * count <= wanted {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let decade = |e: i32| parts.iter().map(move |p| p * 10f64.powi(e));
    (first..=last).step_by(every).flat_map(decade).collect()
}

/// A tick's label: plain from 0.001 to 9999, a power of ten beyond.
pub(super) fn label(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".into();
    }
    if (0.001..10_000.0).contains(&size) {
        return super::markup::short_to(value, 4);
    }
    let exponent = size.log10().floor() as i32;
    let mantissa = value / 10f64.powi(exponent);
    let power: String = exponent.to_string().chars().map(superscript).collect();
    let mantissa = super::markup::short_to(mantissa, 2);
    if mantissa == "1" {
        format!("10{power}")
    } else {
        format!("{mantissa}\u{b7}10{power}")
    }
}

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

    #[test]
    fn places_follow_the_spread() {
        let linear = Scale::new(Spread::Linear, (0.0, 10.0), (100.0, 300.0));
        assert_eq!(
            [0.0, 5.0, 10.0, 99.0].map(|v| linear.place(v)),
            [100.0, 200.0, 300.0, 300.0]
        );
        let log = Scale::new(Spread::Log, (1.0, 100.0), (300.0, 100.0));
        assert!((log.place(10.0) - 200.0).abs() < 0.001);
        let zero = Scale::new(
            Spread::LogWithZero { unit: 1.0 },
            (0.0, 10_000.0),
            (0.0, 1.0),
        );
        assert_eq!(zero.place(0.0), 0.0);
        // One decade is as long as the next one, far above the unit.
        let decade = |v: f64| zero.place(10.0 * v) - zero.place(v);
        assert!((decade(100.0) - decade(1000.0)).abs() < 0.001);
        assert!(!linear.shows(10.5) && linear.shows(10.0));
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(
            Scale::new(Spread::Linear, (0.0, 6.2), (0.0, 1.0)).ticks(6),
            [0.0, 2.0, 4.0, 6.0]
        );
        assert_eq!(
            Scale::new(Spread::Log, (1.5, 20_000.0), (0.0, 1.0)).ticks(6),
            [10.0, 100.0, 1000.0, 10_000.0]
        );
        assert_eq!(
            Scale::new(Spread::Log, (1.0, 9.0), (0.0, 1.0)).ticks(8),
            [1.0, 2.0, 5.0]
        );
        assert_eq!(
            Scale::new(
                Spread::LogWithZero { unit: 10.0 },
                (0.0, 1000.0),
                (0.0, 1.0)
            )
            .ticks(3),
            [0.0, 10.0, 100.0, 1000.0]
        );
    }

    #[test]
    fn odd_ranges_make_an_axis_all_the_same() {
        for values in [
            (1.0, 1.0),
            (f64::NAN, f64::INFINITY),
            (3.0, -2.0),
            (0.0, 0.0),
            (-5.0, -5.0),
        ] {
            for spread in [
                Spread::Linear,
                Spread::Log,
                Spread::LogWithZero { unit: 1.0 },
            ] {
                let scale = Scale::new(spread, values, (0.0, 100.0));
                assert!(
                    scale.place(1.0).is_finite() && (0.0..=100.0).contains(&scale.place(2.0)),
                    "{values:?} {spread:?}"
                );
                assert!(scale.ticks(5).len() < 30);
            }
        }
    }

    #[test]
    fn labels_are_short() {
        let labels = [0.0, 0.25, 1.5, 1000.0, 100_000.0, 250_000.0, 0.00001].map(label);
        assert_eq!(
            labels,
            [
                "0",
                "0.25",
                "1.5",
                "1000",
                "10\u{2075}",
                "2.5\u{b7}10\u{2075}",
                "10\u{207b}\u{2075}"
            ]
            .map(String::from)
        );
    }
}
