//! Blocks of supports in parallel, in an order that does not depend on the number of threads.

use super::coefficients::Coefficients;
use super::filter::{Desk, Filters};
use super::floats::Floats;
use super::integral::Integral;
use super::minors::Minors;
use super::signs::Signs;
use super::{MAX_BITS, MAX_FREE, MAX_SLIP, ScreenError, Statistics};
use crate::exact::primes;
use crate::model::{Pencil, Window};
use crate::oracle::{Enumeration, examine_support};
use rayon::prelude::*;
use std::ops::{ControlFlow, Range};

/// Supports of a block: 2^9 share all but 9 elimination steps, and a block's values fit the cache.
const BLOCK_BITS: usize = 9;
/// Blocks between two calls of the progress function, per thread.
const BLOCKS_PER_THREAD: usize = 4;

/// A pencil prepared for screening.
#[derive(Debug)]
pub struct Screen<'a> {
    pencil: &'a Pencil,
    window: &'a Window,
    filters: Filters,
    minors: Vec<Minors>,
}

/// What a run over a range of supports found.
#[derive(Debug, Clone, Default)]
pub struct Part {
    /// The supports examined, as bit sets over the complementarity variables (bit k: the k-th).
    pub range: Range<u64>,
    /// What they hold, as found: [`Enumeration::describe`] completes and sorts it once all parts are in.
    pub enumeration: Enumeration,
    /// The supports that hold something, ascending.
    pub holders: Vec<u64>,
    /// How many supports each filter settled.
    pub statistics: Statistics,
}

impl<'a> Screen<'a> {
    /// Prepares a pencil: bounds, primes, condensation.
    ///
    /// # Errors
    /// [`ScreenError::TooLarge`].
    pub fn new(pencil: &'a Pencil, window: &'a Window) -> Result<Self, ScreenError> {
        let too_large = |what, limit: u64, got: u64| if got > limit { Err(ScreenError::TooLarge { what, limit, got }) } else { Ok(()) };
        too_large("slip variables", MAX_SLIP as u64, pencil.slip().len() as u64)?;
        too_large("free variables", MAX_FREE as u64, pencil.free().len() as u64)?;
        let integral = Integral::of(pencil);
        let all = (1 << integral.slip) - 1;
        too_large("bits of a determinant's coefficients", MAX_BITS, coefficient_bits(pencil))?;
        let points = integral.degree(all) + 1;
        // Rows have at least 0 bits, so no support needs more than the rows of all.
        let count = Coefficients::primes_for((0..integral.a.len()).map(|i| integral.row_bits(i)).sum());
        let minors: Vec<Minors> = primes().take(count).map(|p| Minors::new(&integral, p, points)).collect();
        let filters =
            Filters { floats: Floats::of(pencil, window), signs: Signs::of(&integral), coefficients: Coefficients::new(&minors), integral };
        Ok(Screen { pencil, window, filters, minors })
    }

    /// Number of supports, 2^n_s.
    pub fn supports(&self) -> u64 {
        1 << self.filters.integral.slip
    }

    /// Were the free variables eliminated exactly, for every value of the unknown at once?
    pub fn is_condensed(&self) -> bool {
        self.filters.floats.condensed
    }

    /// Examines the supports of a range. `progress` hears how many are done; breaking ends the run
    /// with a shorter range, and everything found in it.
    ///
    /// # Errors
    /// [`ScreenError::Range`] for a range that is reversed or reaches beyond [`Screen::supports`].
    pub fn run(&self, range: Range<u64>, mut progress: impl FnMut(&Part) -> ControlFlow<()>) -> Result<Part, ScreenError> {
        let total = self.supports();
        if range.start > range.end || range.end > total {
            return Err(ScreenError::Range { start: range.start, end: range.end, total });
        }
        let low_bits = BLOCK_BITS.min(self.filters.integral.slip);
        let mut part = Part { range: range.start..range.start, ..Part::default() };
        part.enumeration.supports_total = total;
        let blocks: Vec<u64> = (range.start >> low_bits..range.end.div_ceil(1 << low_bits)).collect();
        for wave in blocks.chunks(BLOCKS_PER_THREAD * rayon::current_num_threads()) {
            let results: Vec<Part> = wave
                .par_iter()
                .map(|&high| {
                    let first = high << low_bits;
                    self.block(high, low_bits, first.max(range.start)..(first + (1 << low_bits)).min(range.end))
                })
                .collect(); // in the order of the blocks
            results.into_iter().for_each(|r| part.append(r));
            if progress(&part).is_break() {
                break;
            }
        }
        Ok(part)
    }

    /// The supports of one block that are in the range.
    fn block(&self, high: u64, low_bits: usize, range: Range<u64>) -> Part {
        let mut values = vec![Vec::new(); self.minors.len()];
        for (k, minors) in self.minors.iter().enumerate() {
            // The k-th prime matters only for supports that k primes do not prove.
            let from_bits = Coefficients::bits_beyond(k);
            minors.block(high, low_bits, from_bits, &mut values[k]);
        }
        let points = self.minors.first().map_or(0, |m| m.points.len());
        let mut desk = Desk::default();
        let mut part = Part { range: range.clone(), ..Part::default() };
        for mask in range {
            let sub = (mask & ((1 << low_bits) - 1)) as usize;
            let verdict = self.filters.judge(mask, |k| &values[k][sub * points..][..points], &mut desk);
            verdict.count(&mut part.statistics);
            if !verdict.is_empty() && examine_one(self.pencil, self.window, mask, &mut part.enumeration) {
                part.holders.push(mask);
            }
            part.enumeration.supports_done += 1;
        }
        part
    }
}

/// The oracle's exact code on each of the supports, in parallel, put together in their order; the
/// first support that holds nothing, if there is one. Counters are left to the caller.
///
/// # Errors
/// The support that holds nothing: whoever listed it was wrong.
pub fn examine_exactly(pencil: &Pencil, window: &Window, supports: &[u64]) -> Result<Enumeration, u64> {
    let examine = |&mask: &u64| {
        let mut part = Part::default();
        if examine_one(pencil, window, mask, &mut part.enumeration) { Ok(part) } else { Err(mask) }
    };
    let parts: Vec<Result<Part, u64>> = supports.par_iter().map(examine).collect();
    let mut all = Part::default();
    for part in parts {
        all.append(part?);
    }
    Ok(all.enumeration)
}

/// The oracle's exact code on one support; did it find anything?
pub fn examine_one(pencil: &Pencil, window: &Window, mask: u64, found: &mut Enumeration) -> bool {
    let count = |e: &Enumeration| e.solutions.len() + e.wide.len() + e.continua.len();
    let before = count(found);
    examine_support(pencil, &support(pencil, mask), window, found);
    count(found) > before
}

/// A bound of the bits of every coefficient of every support's determinant.
pub fn coefficient_bits(pencil: &Pencil) -> u64 {
    let integral = Integral::of(pencil);
    (0..integral.a.len()).map(|i| integral.row_bits(i)).sum::<f64>().ceil() as u64
}

/// The variables of a support given as a bit set over the complementarity variables.
pub fn support(pencil: &Pencil, mask: u64) -> Vec<usize> {
    pencil.slip().into_iter().enumerate().filter(|(k, _)| mask >> k & 1 == 1).map(|(_, i)| i).collect()
}

impl Part {
    /// The next part, where this one ends.
    fn append(&mut self, next: Part) {
        self.range.end = next.range.end;
        self.enumeration.solutions.extend(next.enumeration.solutions);
        self.enumeration.wide.extend(next.enumeration.wide);
        self.enumeration.continua.extend(next.enumeration.continua);
        self.enumeration.supports_done += next.enumeration.supports_done;
        self.holders.extend(next.holders);
        self.statistics += next.statistics;
    }
}
