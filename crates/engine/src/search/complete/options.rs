//! The options of a complete search: pieces, nodes, threads, and the part of one run.

/// How to search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CompleteOptions {
    /// Pieces into which the window is cut before the search; the work is shared out by piece.
    pub pieces: usize,
    /// Nodes that one piece may use before the rest of it is left open.
    pub nodes_per_piece: usize,
    /// Threads, all cores if not given. The certificate does not depend on it.
    pub threads: Option<usize>,
    /// The part of the pieces to search; the others are left open.
    pub shard: Option<Shard>,
}

/// Every `count`-th piece from `index` on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which part, from 0.
    pub index: usize,
    /// Parts in all.
    pub count: usize,
}

impl Default for CompleteOptions {
    fn default() -> Self {
        CompleteOptions {
            pieces: 16,
            nodes_per_piece: 2_000_000,
            threads: None,
            shard: None,
        }
    }
}
