//! Flags of cases: what a case is about, and the class of bugs it catches.
//!
//! A few flags only the maker of a case can know; all others are read off the problem and its
//! answer by [`of_enumeration`] and [`of_certified`]. Called by `case` when a draft is answered,
//! and by `summary`, which counts outcomes by flag.

use super::certified::{CertifiedAnswer, Completeness};
use mceip_exact::{Algebraic, Rational, Sparse, parse, rational, whole};
use mceip_model::{Body, ContactState, Problem, Reduced, System, Unknown};
use mceip_oracle::{Enumeration, Solution, ValueInterval};
use num_traits::{Signed, Zero};
use std::collections::BTreeSet;

worded! {
    /// What a case is about. All but [`Flag::Threshold`], [`Flag::NearThreshold`],
    /// [`Flag::Fold`] and [`Flag::Random`] are read off the problem and its exact answer. The note
    /// of a flag is the class of bugs that its cases catch.
    Flag:
    Lambda2 "lambda2" "A + tB built from K*, M* with the friction given; wrong sign of K1 or M1.",
    Mu "mu" "A + tB built from K0, K1; the friction coefficient of the file used although mu is \
             sought.",
    Eigenvalue "eigenvalue" "An eigenvalue complementarity problem: t of either sign, A and B of \
                             any kind.",
    Quadratic "quadratic" "A + tB + t^2 C: C left out, or x of a linear form reported with its \
                           other components.",
    BelowZero "below_zero" "A solution with t < 0 of an eigenvalue problem: lost by a search over \
                            t >= 0.",
    Pencil "pencil" "A pencil given directly: the order of rows and the free set.",
    System "system" "A mechanical system: elimination (10)-(16), order of variables.",
    OneByOne "one_by_one" "Order 1: codes that assume at least two variables.",
    FreeVariables "free_variables" "Variables with y = 0 and no sign, treated as complementarity \
                                    variables or dropped.",
    Stick "stick" "Stick particles kept in the pencil, or their normal dofs.",
    FreeParticle "free_particle" "Particles without contact: both dofs are free.",
    NormalAway "normal_away" "Normal dof positive away from the obstacle: the sign of K_NT, mu \
                              taken for -mu.",
    Oblique "oblique" "Frames: tangent and normal mix two dofs.",
    CoupledMass "coupled_mass" "M couples T and N: M1 does not vanish and mu enters B.",
    NoSolution "no_solution" "Nothing exists: a reported solution is invented (residuals do not \
                              certify).",
    ManySolutions "many_solutions" "Ten or more solutions: a search that ends early.",
    Irrational "irrational" "Values that are no fractions.",
    SharedValue "shared_value" "Several solutions with one value: merged by value although x \
                                differs.",
    CloseValues "close_values" "Two values closer than 10^-2 and not equal: merged by a tolerance.",
    RepeatedRoot "repeated_root" "A multiple root of a determinant: complex or lost eigenvalues in \
                                  floats (error like its square root).",
    ZeroValue "zero_value" "A solution at t = 0: discarded by t > 0, or by a small negative \
                            rounding.",
    Biactive "biactive" "x_i = y_i = 0: lost by y_i > tolerance, or listed once for each of its \
                         supports.",
    TinyComponent "tiny_component" "A positive component below 10^-3 of the largest: cut to zero \
                                    by a tolerance.",
    WideKernel "wide_kernel" "A kernel of dimension > 1: an eigenvector routine returns an \
                              arbitrary basis.",
    Cone "cone" "A cone of solutions: its interior is missed.",
    SingularPencil "singular_pencil" "det(A + tB) vanishes identically on a support: generalised \
                                      eigenvalues are arbitrary.",
    Continuum "continuum" "Solutions for whole intervals of t: listed as isolated values, or \
                           missed.",
    FreeOnly "free_only" "x_s = 0 (outside Propositions 1 and 2): missed by e'x_s = 1.",
    Window "window" "A bounded window: values outside reported, or ends treated as open.",
    WindowEnd "window_end" "A value exactly at an end of the window: the window is closed.",
    Threshold "threshold" "Exactly on a threshold of Table 1: a new solution at lambda^2 = 0.",
    NearThreshold "near_threshold" "At relative distance 10^-9 of a threshold: solutions reported \
                                    where none exist, or lost.",
    Fold "fold" "Pairs of solutions born at a positive value: missed by tracking lambda^2 = 0.",
    Scaled "scaled" "Entries beyond 1e5 or below 10^-5: absolute tolerances.",
    Random "random" "No special structure.",
}

/// Which cases are meant, by their flags.
#[derive(Debug, Clone, Default)]
pub struct FlagChoice {
    /// With one of these; empty: with any flags.
    pub only: Vec<Flag>,
    /// But with none of these.
    pub except: Vec<Flag>,
}

impl FlagChoice {
    /// Is a case with these flags meant?
    pub fn takes(&self, flags: &BTreeSet<Flag>) -> bool {
        let has_one_of = |list: &[Flag]| list.iter().any(|flag| flags.contains(flag));
        (self.only.is_empty() || has_one_of(&self.only)) && !has_one_of(&self.except)
    }
}

impl Flag {
    /// Can only the maker of a case know it?
    pub(super) fn is_given(self) -> bool {
        matches!(
            self,
            Flag::Threshold | Flag::NearThreshold | Flag::Fold | Flag::Random
        )
    }
}

/// Every flag that the problem and its exact answer show.
pub(super) fn of_enumeration(
    problem: &Problem,
    reduced: &Reduced,
    answer: &Enumeration,
) -> BTreeSet<Flag> {
    let mut shown = ShownFlags::of_problem(problem, reduced);
    shown.look_at_window_ends(problem, answer);
    shown.look_at_answer(answer);
    shown.look_at_solutions(&answer.solutions, &reduced.pencil.slip());
    shown.flags
}

/// The flags that the problem and an answer without exact numbers show: of the answer only how
/// many solutions it has.
pub(super) fn of_certified(
    problem: &Problem,
    reduced: &Reduced,
    answer: &CertifiedAnswer,
) -> BTreeSet<Flag> {
    let mut shown = ShownFlags::of_problem(problem, reduced);
    let count = answer.cover.solutions.len();
    let is_all = answer.completeness == Completeness::Proved;
    shown.put(Flag::NoSolution, is_all && count == 0);
    shown.put(Flag::ManySolutions, count >= MANY);
    shown.flags
}

/// So many solutions are many.
const MANY: usize = 10;

/// The flags seen so far.
#[derive(Default)]
struct ShownFlags {
    flags: BTreeSet<Flag>,
}

impl ShownFlags {
    /// What the problem shows, whatever its answer.
    fn of_problem(problem: &Problem, reduced: &Reduced) -> ShownFlags {
        let mut shown = ShownFlags::default();
        shown.look_at_problem(problem);
        match problem.body() {
            Body::Quadratic(quadratic) => {
                shown.look_at_matrices(&quadratic.coefficients());
                shown.put(Flag::Quadratic, true);
            }
            Body::Pencil(_) | Body::System(_) => {
                let pencil = &reduced.pencil;
                shown.look_at_matrices(&[pencil.a(), pencil.b()]);
                shown.put(Flag::FreeVariables, !pencil.free().is_empty());
            }
        }

        let is_bounded = !ends_of_window(problem).is_empty();
        shown.put(Flag::Window, is_bounded);
        shown
    }

    /// Adds the flag if it holds.
    fn put(&mut self, flag: Flag, holds: bool) {
        if holds {
            self.flags.insert(flag);
        }
    }

    fn look_at_problem(&mut self, problem: &Problem) {
        self.put(Flag::Lambda2, problem.unknown() == Unknown::Lambda2);
        self.put(Flag::Mu, problem.unknown() == Unknown::Mu);
        self.put(Flag::Eigenvalue, problem.unknown() == Unknown::Eigenvalue);

        match problem.body() {
            Body::Pencil(_) | Body::Quadratic(_) => self.put(Flag::Pencil, true),
            Body::System(system) => self.look_at_system(system),
        }
    }

    fn look_at_system(&mut self, system: &System) {
        self.put(Flag::System, true);
        for p in system.particles() {
            let slips = matches!(p.state, ContactState::Slip { .. });
            self.put(Flag::Stick, p.state == ContactState::Stick);
            self.put(Flag::FreeParticle, p.state == ContactState::Free);
            self.put(Flag::NormalAway, p.normal_direction == -1 && slips);
            self.put(Flag::Oblique, p.frame.is_some());
        }

        if let Some(mass) = system.mass() {
            let is_coupled = mass.entries().any(|(i, j, _)| i != j);
            self.put(Flag::CoupledMass, is_coupled);
        }
    }

    fn look_at_matrices(&mut self, coefficients: &[&Sparse]) {
        for matrix in coefficients {
            self.put(Flag::OneByOne, matrix.rows() == 1);
            let mut entries = matrix.entries();
            self.put(Flag::Scaled, entries.any(|(_, _, v)| is_extreme(v)));
        }
    }

    fn look_at_window_ends(&mut self, problem: &Problem, answer: &Enumeration) {
        let ends = ends_of_window(problem);
        let of_solutions = answer.solutions.iter().map(|s| &s.value);
        let of_cones = answer.cones.iter().map(|c| &c.value);
        for value in of_solutions.chain(of_cones) {
            let mut value = value.clone();
            let is_end = ends.iter().any(|end| value.cmp_rational(end).is_eq());
            self.put(Flag::WindowEnd, is_end);
        }
    }

    fn look_at_answer(&mut self, answer: &Enumeration) {
        let count = answer.solutions.len() + answer.cones.len() + answer.ranges.len();
        self.put(Flag::NoSolution, count == 0);
        self.put(Flag::ManySolutions, count >= MANY);
        self.put(Flag::WideKernel, !answer.wide.is_empty());
        self.put(Flag::Cone, !answer.cones.is_empty());
        self.put(Flag::SingularPencil, !answer.continua.is_empty());
        self.put(Flag::Continuum, !answer.ranges.is_empty());
        self.put(Flag::FreeOnly, answer.is_outside_propositions());

        let zero = Rational::zero();
        let is_negative = |value: &Algebraic| value.clone().cmp_rational(&zero).is_lt();
        let begins_below_zero = |piece: &ValueInterval| match &piece.from {
            Some(end) => is_negative(&end.value),
            None => true,
        };
        let mut pieces = answer.ranges.iter().flat_map(|range| &range.pieces);
        let has_one_below_zero = answer.cones.iter().any(|cone| is_negative(&cone.value))
            || pieces.any(begins_below_zero);
        self.put(Flag::BelowZero, has_one_below_zero);
    }

    /// Looks at each solution, and at each two that follow each other in order of value.
    fn look_at_solutions(&mut self, listed: &[Solution], slip: &[usize]) {
        for solution in listed {
            let mut value = solution.value.clone();
            value.try_rational();
            self.put(Flag::Irrational, value.as_rational().is_none());

            let from_zero = value.cmp_rational(&Rational::zero());
            self.put(Flag::ZeroValue, from_zero.is_eq());
            self.put(Flag::BelowZero, from_zero.is_lt());
            self.put(Flag::RepeatedRoot, solution.multiplicity > 1);
            self.put(Flag::Biactive, !solution.biactive.is_empty());
            self.put(Flag::TinyComponent, has_tiny_component(solution, slip));
        }

        for pair in listed.windows(2) {
            let lower = &pair[0].value;
            let upper = &pair[1].value;
            let are_equal = lower.clone().equals(&mut upper.clone());
            self.put(Flag::SharedValue, are_equal);
            self.put(Flag::CloseValues, !are_equal && are_close(lower, upper));
        }
    }
}

/// The ends that the problem gives to its window: zero is one only where values below it could be
/// asked for.
fn ends_of_window(problem: &Problem) -> Vec<Rational> {
    let window = problem.real_window();
    let is_given = |min: &&Rational| problem.unknown() == Unknown::Eigenvalue || !min.is_zero();
    let ends = window
        .min()
        .filter(is_given)
        .into_iter()
        .chain(window.max());
    ends.cloned().collect()
}

/// Is the number not zero, and above 1e5 or below 1e-5 in size?
fn is_extreme(v: &Rational) -> bool {
    let size = v.abs();
    !v.is_zero() && (size > whole(100_000) || size < rational(1, 100_000))
}

/// Is upper - lower less than 1/100, by the isolating intervals and by midpoints of intervals of
/// width at most 1e-4?
fn are_close(lower: &Algebraic, upper: &Algebraic) -> bool {
    let close = rational(1, 100);
    let gap = upper.interval().lo() - lower.interval().hi();

    let width = &close / whole(100);
    let mut lower = lower.clone();
    let mut upper = upper.clone();
    lower.refine_to(&width);
    upper.refine_to(&width);
    let distance = upper.interval().mid() - lower.interval().mid();

    gap < close && distance < close
}

/// Is a positive component below 1e-3 of e'x_s? By correctly rounded decimals: 0.000... or an
/// exponent.
fn has_tiny_component(solution: &Solution, slip: &[usize]) -> bool {
    let limit = rational(1, 1000);
    let decimals = solution.x_decimals(slip, 17);
    solution
        .slip
        .iter()
        .any(|&i| parse(&decimals[i]).is_ok_and(|v| v < limit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_meant_by_one_flag_and_left_out_by_another() {
        let fold = BTreeSet::from([Flag::Fold, Flag::Pencil]);
        let choice = |only: &[Flag], except: &[Flag]| FlagChoice {
            only: only.to_vec(),
            except: except.to_vec(),
        };

        assert!(choice(&[], &[]).takes(&fold));
        assert!(choice(&[Flag::Fold, Flag::Mu], &[Flag::Mu]).takes(&fold));
        assert!(!choice(&[Flag::Mu], &[]).takes(&fold));
        assert!(!choice(&[], &[Flag::Pencil]).takes(&fold));
        assert!(!choice(&[Flag::Fold], &[Flag::Fold]).takes(&fold));
    }

    #[test]
    fn words_are_distinct_and_read_back() {
        let words: BTreeSet<&str> = Flag::ALL.iter().map(|f| f.word()).collect();
        assert_eq!(words.len(), Flag::ALL.len());

        for flag in Flag::ALL {
            assert_eq!(Flag::of_word(flag.word()), Some(*flag));
            assert!(flag.note().ends_with('.'), "{flag:?}");
        }
        assert_eq!(Flag::of_word("anything"), None);
    }
}
