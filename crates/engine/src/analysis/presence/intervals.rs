//! What stretches of several curves prove together: maximal intervals of mu, and the gaps between.
//!
//! A piece of a certificate stays valid where its interval of mu is cut short, because all its
//! inequalities are convex in mu. So from each mu the stretch that reaches furthest is taken, from
//! where the one before ends. Called by `mod.rs`.

use super::climb::PresenceStretch;

/// Consecutive stretches. Each one counts from where the one before it ends.
pub(super) type Chain = Vec<PresenceStretch>;

/// The maximal intervals that stretches cover, ascending.
pub(super) fn chains(stretches: &[PresenceStretch]) -> Vec<Chain> {
    let mut ascending: Vec<&PresenceStretch> = stretches.iter().collect();
    ascending.sort_by(|p, q| p.low.total_cmp(&q.low));

    let mut chains: Vec<Chain> = Vec::new();
    let mut end = f64::NEG_INFINITY;
    let mut next = 0;
    let mut furthest: Option<&PresenceStretch> = None;
    loop {
        while next < ascending.len() && ascending[next].low <= end {
            let stretch = ascending[next];
            if furthest.is_none_or(|known| stretch.high > known.high) {
                furthest = Some(stretch);
            }
            next += 1;
        }

        match furthest.take().filter(|stretch| stretch.high > end) {
            Some(stretch) => {
                end = stretch.high;
                match chains.last_mut() {
                    Some(chain) => chain.push(stretch.clone()),
                    None => chains.push(vec![stretch.clone()]),
                }
            }
            None => {
                // Nothing begins at or before the end: a gap.
                let Some(stretch) = ascending.get(next) else {
                    return chains;
                };
                end = stretch.low;
                chains.push(Vec::new());
            }
        }
    }
}

/// Where a chain begins and ends.
pub(super) fn extent(chain: &Chain) -> Option<[f64; 2]> {
    Some([chain.first()?.low, chain.last()?.high])
}

/// The parts of [from, to] that no stretch covers.
pub(super) fn gaps(stretches: &[PresenceStretch], from: f64, to: f64) -> Vec<[f64; 2]> {
    let mut gaps = Vec::new();
    let mut reached = from;
    for [low, high] in chains(stretches).iter().filter_map(extent) {
        if low > reached && reached < to {
            gaps.push([reached, low.min(to)]);
        }
        reached = reached.max(high);
    }

    if reached < to {
        gaps.push([reached, to]);
    }

    gaps
}
