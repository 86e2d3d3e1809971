//! The walk through the trees of a cover: the region of each node is computed, each leaf has its
//! proof checked.
//!
//! A tree is written in preorder. The walk keeps the regions that are still to be closed on a
//! stack. A node takes the region on top: a cut or a branch puts two in its place, whose union is
//! the region that was taken; a leaf proves what its region holds. A tree that ends exactly when
//! the stack is empty has therefore accounted for every (support, value) of its piece.
//!
//! Where one half of v_T of a particle with zero reaction moves, a branch puts the other one at
//! rest: what is covered are the motions, each with at most one of them.
//!
//! Matrices of a region are computed once for all regions of one interval, and their work is taken
//! from the budget of the file.

use super::budget::WorkBudget;
use super::condensed::Anchors;
use super::ends::Ends;
use super::family::Family;
use super::fault::CoverFault;
use super::proved::{AcceptedSolution, Found, OpenRegion, SolutionFamily};
use super::region::{Region, State};
use super::short::Short;
use super::sign_budget::SignBudget;
use super::support::Held;
use super::{definite, farkas, infinity, ldl, root, support};
use crate::certificate::{Node, Piece, Root, RootOutcome, Support};
use crate::pencil::Rows;
use crate::{AcceptedClaim, LeafPlace};
use mceip_exact::{Interval, Rational};
use mceip_model::Window;
use std::rc::Rc;

/// What a walk reads, what it has found, and what is left of the budgets of the file.
pub(super) struct Walk<'a> {
    pub(super) rows: &'a Rows,
    /// Where there are free variables.
    pub(super) anchors: Option<Anchors<'a>>,
    pub(super) family: Family,
    /// The complementarity variables: positions in states and matrices to indices of the problem.
    pub(super) index: Vec<usize>,
    pub(super) window: &'a Window,
    /// No solution has a value at or above this.
    pub(super) tail: Option<&'a Rational>,
    /// The claims of the certificate, all accepted.
    pub(super) claims: &'a [AcceptedSolution<'a>],
    pub(super) found: Vec<Found>,
    pub(super) families: Vec<SolutionFamily>,
    pub(super) open: Vec<OpenRegion>,
    pub(super) leaves: usize,
    /// For the signs of support leaves.
    pub(super) sign_budget: SignBudget,
    pub(super) definite_budget: WorkBudget,
    pub(super) matrix_budget: WorkBudget,
    /// Where leaves that fail are noted (piece, node), if they are to be left open.
    pub(super) refused: Option<&'a mut Vec<LeafPlace>>,
}

/// A fault and the number of the node at which it was found.
pub(super) struct NodeFault {
    pub(super) node: usize,
    pub(super) fault: CoverFault,
}

impl Walk<'_> {
    /// Walks the tree of the piece with this number, which begins at `lo`.
    pub(super) fn piece(
        &mut self,
        number: usize,
        lo: &Rational,
        piece: &Piece,
    ) -> Result<(), NodeFault> {
        let mut stack = vec![Region {
            lo: Rc::new(lo.clone()),
            hi: piece.max.as_ref().map(|n| Rc::new(n.0.clone())),
            states: vec![State::Undecided; self.index.len()],
            matrices: Rc::default(),
        }];

        for (k, node) in piece.tree.iter().enumerate() {
            let at_node = |fault| NodeFault { node: k, fault };
            let region = stack.pop().ok_or(at_node(CoverFault::Trailing))?;

            match node {
                // The region on top of the stack is the next one.
                Node::Split(at) => {
                    let [lower, upper] = region.split(&at.0).map_err(at_node)?;
                    stack.extend([upper, lower]);
                }
                Node::Branch(index) => {
                    let other_half = self.rows.other_half(*index);
                    let parts = region.branch(*index, &self.index, other_half);
                    let [at_zero, in_support] = parts.map_err(at_node)?;
                    stack.extend([in_support, at_zero]);
                }
                _ => {
                    let verdict = self.leaf(&region, piece.anchor, node);
                    self.settle(&region, verdict, (number, k))
                        .map_err(at_node)?;
                }
            }
        }

        if stack.is_empty() {
            return Ok(());
        }

        Err(NodeFault {
            node: piece.tree.len(),
            fault: CoverFault::Truncated {
                regions: stack.len(),
            },
        })
    }

    /// Passes on the verdict on a leaf, or leaves the region of one that fails open and notes
    /// where.
    fn settle(
        &mut self,
        region: &Region,
        verdict: Result<(), CoverFault>,
        place: LeafPlace,
    ) -> Result<(), CoverFault> {
        match (&verdict, self.refused.as_mut()) {
            (Err(_), Some(refused)) => {
                refused.push(place);
                self.open.push(self.open_region(region));
                Ok(())
            }
            _ => verdict,
        }
    }

    /// Checks the proof of a leaf and keeps what it yields.
    fn leaf(
        &mut self,
        region: &Region,
        anchor: Option<usize>,
        node: &Node,
    ) -> Result<(), CoverFault> {
        self.leaves += 1;

        match node {
            Node::Split(_) | Node::Branch(_) => Ok(()), // these are no leaves
            Node::Open => {
                self.open.push(self.open_region(region));
                Ok(())
            }
            Node::Tail => region.is_in_tail(self.tail),
            Node::Farkas(w) => self.farkas(region, anchor, w),
            Node::PositiveDefinite => self.definite(region, anchor, 1),
            Node::NegativeDefinite => self.definite(region, anchor, -1),
            Node::Ldl(factors) => ldl::check(self.rows, region, &self.index, factors),
            Node::Support(leaf) => self.support(region, leaf),
            Node::Root(root) => {
                let found = self.root(region, anchor, root)?;
                self.found.extend(found);
                Ok(())
            }
        }
    }

    fn farkas(&self, region: &Region, anchor: Option<usize>, w: &[i64]) -> Result<(), CoverFault> {
        self.affordable(region, anchor)?;
        let short = self.short(region, anchor);
        farkas::farkas(
            region,
            short.as_deref(),
            || self.ends(region, anchor),
            &self.index,
            w,
        )
    }

    pub(super) fn definite(
        &self,
        region: &Region,
        anchor: Option<usize>,
        sign: i8,
    ) -> Result<(), CoverFault> {
        self.spend_definite(region)?;
        self.affordable(region, anchor)?;
        let short = self.short(region, anchor);
        definite::definite(
            region,
            short.as_deref(),
            || {
                if short.is_some() {
                    self.spend_definite(region)?; // a second time
                }
                self.ends(region, anchor)
            },
            &self.index,
            sign,
        )
    }

    /// A definite leaf costs the cube of the number of variables that may be in the support, and
    /// that twice where short numbers were tried in vain.
    pub(super) fn spend_definite(&self, region: &Region) -> Result<(), CoverFault> {
        let order = region.possible_support().len() as u64;
        self.definite_budget.spend(order.saturating_pow(3))
    }

    /// Checks a support leaf. Isolated single solutions are listed, the others are families.
    fn support(&mut self, region: &Region, leaf: &Support) -> Result<(), CoverFault> {
        let support = self.problem_indices(region.support());
        let held = support::check(self.rows, region, &self.index, leaf, &self.sign_budget)?;

        for Held {
            from,
            to,
            is_point,
            is_alone,
            hull,
        } in held
        {
            let support = support.clone();
            match hull {
                Some(hull) if is_alone => self.found.push(Found {
                    solution: AcceptedClaim {
                        support,
                        value: from,
                    },
                    hull,
                }),
                _ => self.families.push(SolutionFamily {
                    support,
                    from,
                    to,
                    is_point,
                    is_alone,
                }),
            }
        }

        Ok(())
    }

    /// Checks a root leaf, and returns the solution in it, if there is one.
    pub(super) fn root(
        &self,
        region: &Region,
        anchor: Option<usize>,
        leaf: &Root,
    ) -> Result<Option<Found>, CoverFault> {
        let value = self.root_interval(leaf)?;
        self.is_meant_for(region, anchor, &leaf.outcome)?;

        // Uniqueness is proved over the hull of the region's interval and the root's.
        let hull_lo = region.lo.as_ref().min(value.lo());
        let hull_hi = region.hi.as_deref().map(|hi| hi.max(value.hi()));
        // What is the only one up to infinity is the only one up to b.
        let hull_end = hull_hi.unwrap_or(value.hi());
        let hull =
            Interval::new(hull_lo.clone(), hull_end.clone()).ok_or_else(|| outside_window(leaf))?;

        self.spend_matrix(anchor, hull_lo, hull_hi)?;
        let wide = self.family.hull_ends(anchor, hull_lo, hull_hi)?;
        let narrow = || {
            self.spend_matrix(anchor, value.lo(), Some(value.hi()))?;
            self.family.ends(anchor, value.lo(), Some(value.hi()))
        };
        let support = self.problem_indices(region.support());
        let vanishing = self.rows.vanishing(&support);
        root::check(region, &wide, narrow, &self.index, &vanishing, leaf)?;

        match &leaf.outcome {
            RootOutcome::Absent | RootOutcome::NegativeX(_) | RootOutcome::NegativeY(_) => Ok(None),
            RootOutcome::Solution => Ok(Some(Found {
                solution: AcceptedClaim { support, value },
                hull,
            })),
            RootOutcome::Claim(claim) => {
                let known = self.claim_of_leaf(*claim, &support, &value)?;
                let is_here = known.support == support;
                Ok(is_here.then(|| Found {
                    solution: known.clone(),
                    hull,
                }))
            }
            RootOutcome::Infinity(x) => {
                let is_infinite = region.hi.is_none();
                let is_reversed = self.family.is_reversed(anchor);
                infinity::null_vector(self.rows, &support, is_infinite, is_reversed, x)?;
                Ok(None)
            }
        }
    }

    /// The interval of a root leaf: within the window, and a point only where the outcome needs no
    /// change of sign.
    fn root_interval(&self, leaf: &Root) -> Result<Interval, CoverFault> {
        let [a, b] = &leaf.interval;
        let value = Interval::new(a.0.clone(), b.0.clone()).ok_or_else(|| outside_window(leaf))?;

        let may_be_point = matches!(
            leaf.outcome,
            RootOutcome::Claim(_) | RootOutcome::Absent | RootOutcome::Infinity(_)
        );
        let is_below = value.lo() < self.window.min();
        let is_above = self.window.max().is_some_and(|max| value.hi() > max);
        if is_below || is_above || (value.is_point() && !may_be_point) {
            return Err(outside_window(leaf));
        }

        Ok(value)
    }

    /// Refuses outcomes that need a narrow interval on a chord: over a half line without a reversed
    /// anchor only `absent`, `infinity` and `claim` are read.
    fn is_meant_for(
        &self,
        region: &Region,
        anchor: Option<usize>,
        outcome: &RootOutcome,
    ) -> Result<(), CoverFault> {
        let is_chord = region.hi.is_none() && !self.family.is_reversed(anchor);

        let outcome = match outcome {
            RootOutcome::Solution => "solution",
            RootOutcome::NegativeX(_) => "negative_x",
            RootOutcome::NegativeY(_) => "negative_y",
            RootOutcome::Absent | RootOutcome::Claim(_) | RootOutcome::Infinity(_) => return Ok(()),
        };

        if is_chord {
            return Err(CoverFault::OutcomeOnHalfLine { outcome });
        }

        Ok(())
    }

    /// The claim with this number, whose x is a null vector of the leaf's block at a value in the
    /// leaf's interval.
    ///
    /// That is so if x is zero off the leaf's support and y is zero on it: the claim's support is
    /// part of the leaf's, and the rest of the leaf's support is biactive.
    fn claim_of_leaf(
        &self,
        claim: usize,
        support: &[usize],
        interval: &Interval,
    ) -> Result<&AcceptedClaim, CoverFault> {
        let not_the_claim = CoverFault::NotTheClaim { claim };
        let Some(known) = self.claims.get(claim) else {
            return Err(not_the_claim);
        };
        let own = &known.claim.support;
        let value = &known.claim.value;

        let is_part = !own.is_empty() && own.iter().all(|i| support.contains(i));
        let is_null = support
            .iter()
            .all(|i| own.contains(i) || known.biactive.contains(i));
        let is_inside = value.lo() >= interval.lo() && value.hi() <= interval.hi();

        if is_part && is_null && is_inside {
            Ok(&known.claim)
        } else {
            Err(not_the_claim)
        }
    }

    /// The matrices at the ends of the region's interval, computed once for all regions of it.
    pub(super) fn ends(
        &self,
        region: &Region,
        anchor: Option<usize>,
    ) -> Result<Rc<Ends>, CoverFault> {
        let compute = || self.family.ends(anchor, &region.lo, region.hi.as_deref());
        region.matrices.ends(compute)
    }

    /// The same in short numbers, where there are such.
    pub(super) fn short(&self, region: &Region, anchor: Option<usize>) -> Option<Rc<[Short; 2]>> {
        region.matrices.short(|| {
            let short = self.family.short(anchor, &region.lo, region.hi.as_deref());
            if short.is_some() || matches!(self.family, Family::Linear(_)) {
                return short;
            }

            self.ends(region, anchor).ok()?.short()
        })
    }

    /// Demands that the matrices of the region are small enough to be computed, and counts them
    /// once an interval.
    pub(super) fn affordable(
        &self,
        region: &Region,
        anchor: Option<usize>,
    ) -> Result<(), CoverFault> {
        let lo = &region.lo;
        let hi = region.hi.as_deref();
        self.family.affordable(anchor, lo, hi)?;

        let work = self.family.matrix_work(anchor, lo, hi);
        region.matrices.count(&self.matrix_budget, work)
    }

    /// Counts what the matrices of an interval cost.
    fn spend_matrix(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<(), CoverFault> {
        let cost = self.family.matrix_work(anchor, lo, hi);
        self.matrix_budget.spend(cost)
    }

    fn open_region(&self, region: &Region) -> OpenRegion {
        let undecided = region.positions(|state| state == State::Undecided);
        OpenRegion {
            min: Rational::clone(&region.lo),
            max: region.hi.as_deref().cloned(),
            moving: self.problem_indices(region.support()),
            undecided: self.problem_indices(undecided),
        }
    }

    /// Positions among the complementarity variables to indices of the problem.
    fn problem_indices(&self, positions: Vec<usize>) -> Vec<usize> {
        positions.into_iter().map(|p| self.index[p]).collect()
    }
}

fn outside_window(leaf: &Root) -> CoverFault {
    let [a, b] = &leaf.interval;
    CoverFault::Interval {
        a: a.0.clone(),
        b: b.0.clone(),
    }
}
