//! The engineer's answer for one mechanical system at one mu: divergence of the form (8), thresholds,
//! conditions (17)-(20), and the evidence behind each sentence.

pub mod conditions;
