//! The condensed MCEIP-mu pencil of any contact state, from the one condensation of the path: only
//! the free contact nodes are left to eliminate.
//!
//! For v_T = 1 at one slip node, with the free nodes following, the condensed stiffness C gives the
//! reactions at all slip nodes. Their tangential parts are a column of C_TT, their normal parts one
//! of C_NT, where the free nodes are eliminated from both. With the diagonal matrices S of slip
//! signs and c of friction factors, A = S C_TT S and B = c C_NT S. The reports of the loading path
//! call this for every stretch, `unique` for the states about its beginning.

use super::contact::{Contact, Load};
use super::error::PathError;
use super::linear::{ContactEquations, Displacements, Images, no_reaction};
use mceip_exact::{Integer, Rational, Sparse, cleared, common_denominator};
use mceip_model::{ContactState, ModelError, Pencil};
use num_integer::Integer as _;
use num_traits::Zero;

/// Makes condensed pencils; keeps what they share.
pub struct Pencils<'a> {
    pub(super) contact: &'a Contact,
    pub(super) images: Images,
}

/// A node in impending slip, and its sign S.
struct SlipNode {
    node: usize,
    sign: Integer,
}

impl Contact {
    /// A maker of condensed pencils for many states of this body.
    pub fn pencils(&self) -> Pencils<'_> {
        Pencils {
            contact: self,
            images: Images::default(),
        }
    }
}

impl Pencils<'_> {
    /// A + mu B of order n_s, exactly (16): variables x = -S v_T of the slip nodes, left to right.
    /// The same matrices as `mceip_engine::reduction::condense` of the state's MCEIP-mu problem.
    ///
    /// # Errors
    /// [`PathError::Model`] for a number of states other than that of candidates, no slip node, or
    /// a node in contact without a reaction; [`PathError::SingularFreeNodes`].
    pub fn of(&mut self, states: &[ContactState]) -> Result<Pencil, PathError> {
        self.require_a_state_for_each_node(states)?;
        if slip_nodes(states).is_empty() {
            return Err(ModelError::NothingSlips.into());
        }

        let moved = self.reactions(states).ok_or(PathError::SingularFreeNodes)?;
        let scale = SharedDenominator::of(&moved.denominator, &moved.reactions);

        let order = moved.slip.len();
        let mut a = Vec::with_capacity(order * order);
        let mut b = Vec::with_capacity(order * order);
        for (i, at) in moved.slip.iter().enumerate() {
            let factor = &self.contact.friction_factors()[at.node];
            for j in 0..order {
                let [tangential, normal] = moved.entry(i, j);
                a.push((i, j, scale.value(&tangential)));
                b.push((i, j, scale.value(&normal) * factor));
            }
        }

        Ok(Pencil::new(
            Sparse::from_entries(order, order, a),
            Sparse::from_entries(order, order, b),
            Vec::new(),
        )?)
    }

    /// A positive multiple of T(mu) = A + mu B, in integers; of order 0 where nothing slips. `None`
    /// if the stiffness of the free nodes is singular.
    ///
    /// # Errors
    /// As [`Pencils::of`], but for states in which nothing slips.
    pub(super) fn at(
        &mut self,
        mu: &Rational,
        states: &[ContactState],
    ) -> Result<Option<Vec<Vec<Integer>>>, PathError> {
        self.require_a_state_for_each_node(states)?;
        let Some(moved) = self.reactions(states) else {
            return Ok(None);
        };
        let factors = self.contact.friction_factors();
        let coefficients: Vec<Rational> =
            moved.slip.iter().map(|at| mu * &factors[at.node]).collect();
        let denominator = common_denominator(&coefficients);

        let order = moved.slip.len();
        let mut matrix = Vec::with_capacity(order);
        for (i, mu) in coefficients.iter().enumerate() {
            let mu = cleared(mu, &denominator);
            let mut row = Vec::with_capacity(order);
            for j in 0..order {
                let [tangential, normal] = moved.entry(i, j);
                row.push(tangential * &denominator + normal * &mu);
            }
            matrix.push(row);
        }

        Ok(Some(matrix))
    }

    /// Reactions for v_T = 1 at each slip node in turn, over a common denominator. `None` if the
    /// stiffness of the free nodes is singular, also where nothing slips.
    fn reactions(&mut self, states: &[ContactState]) -> Option<SlipReactions> {
        let slip = slip_nodes(states);
        let moved = self.move_each(&slip, states)?;
        Some(SlipReactions {
            reactions: moved.w.iter().map(|w| self.contact.times(w)).collect(),
            denominator: moved.denominator * self.contact.denominator(),
            slip,
        })
    }

    fn require_a_state_for_each_node(&self, states: &[ContactState]) -> Result<(), ModelError> {
        let nodes = self.contact.nodes();
        if states.len() != nodes {
            return Err(ModelError::Shape {
                equation: "E9",
                what: "contact states",
                expected_rows: nodes,
                expected_cols: 1,
                rows: states.len(),
                cols: 1,
            });
        }

        match states.iter().position(|state| *state == ContactState::Zero) {
            Some(particle) => Err(ModelError::ZeroReaction { particle }),
            None => Ok(()),
        }
    }

    /// Displacements for v_T = 1 at each slip node in turn; free nodes follow without reactions.
    /// `None` if their stiffness is singular: where nothing slips, one load is imposed to notice
    /// that.
    fn move_each(&mut self, slip: &[SlipNode], states: &[ContactState]) -> Option<Displacements> {
        let mut active = Vec::new();
        for (node, state) in states.iter().enumerate() {
            if *state == ContactState::Free {
                active.extend([2 * node, 2 * node + 1]);
            }
        }

        let equations = active.iter().map(|&i| no_reaction(i)).collect();
        let mut imposed = Vec::with_capacity(slip.len().max(1));
        for node in slip {
            imposed.push(self.contact.unit(Load::Held(node.node)));
        }
        if slip.is_empty() {
            imposed.push(self.contact.unit(Load::Gaps));
        }

        let equations = ContactEquations {
            contact: self.contact,
            active,
            equations,
            imposed,
        };
        equations.solve(&mut self.images)
    }
}

/// The reactions for v_T = 1 at each slip node in turn.
struct SlipReactions {
    slip: Vec<SlipNode>,
    /// Numerators, by the node that moves.
    reactions: Vec<Vec<Integer>>,
    /// Positive.
    denominator: Integer,
}

impl SlipReactions {
    /// Numerators of S C_TT S and of C_NT S.
    fn entry(&self, i: usize, j: usize) -> [Integer; 2] {
        let at = &self.slip[i];
        let moving = &self.slip[j];
        let reactions = &self.reactions[j];
        let tangential = &reactions[2 * at.node] * &at.sign * &moving.sign;
        let normal = &reactions[2 * at.node + 1] * &moving.sign;
        [tangential, normal]
    }
}

fn slip_nodes(states: &[ContactState]) -> Vec<SlipNode> {
    let mut slip = Vec::new();
    for (node, state) in states.iter().enumerate() {
        if let ContactState::Slip { sign } = *state {
            let sign = Integer::from(sign);
            slip.push(SlipNode { node, sign });
        }
    }

    slip
}

/// A common denominator, and the factor that it shares with all numerators: dividing it out first
/// halves the numbers whose fractions are then reduced one by one.
struct SharedDenominator {
    denominator: Integer,
    shared: Integer,
}

impl SharedDenominator {
    fn of(denominator: &Integer, numerators: &[Vec<Integer>]) -> SharedDenominator {
        let mut shared = denominator.clone();
        for numerator in numerators.iter().flatten() {
            // A long gcd only while it still changes. (Zero is a multiple of everything.)
            if !(numerator % &shared).is_zero() {
                shared = shared.gcd(numerator);
            }
        }

        SharedDenominator {
            denominator: denominator / &shared,
            shared,
        }
    }

    fn value(&self, numerator: &Integer) -> Rational {
        Rational::new(numerator / &self.shared, self.denominator.clone())
    }
}
