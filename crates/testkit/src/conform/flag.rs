//! Flags of cases: what a case is about, and the class of bugs it catches.

use mceip_engine::reduction::Reduced;
use mceip_model::{Body, ContactState, Problem, Unknown};
use mceip_oracle::Enumeration;
use num_traits::Zero;
use std::collections::BTreeSet;

macro_rules! flags {
    ($($name:ident $word:literal $note:literal,)+) => {
        /// What a case is about. All but [`Flag::Threshold`], [`Flag::NearThreshold`],
        /// [`Flag::Fold`] and [`Flag::Random`] are read off the problem and its exact answer.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[allow(missing_docs, reason = "the note of each flag is its documentation")]
        pub enum Flag { $($name,)+ }

        impl Flag {
            /// All flags, in the order of tables.
            pub const ALL: &'static [Flag] = &[$(Flag::$name,)+];

            /// The flag as it stands in files.
            pub fn word(self) -> &'static str {
                match self { $(Flag::$name => $word,)+ }
            }

            /// The class of bugs that cases with this flag catch.
            pub fn note(self) -> &'static str {
                match self { $(Flag::$name => $note,)+ }
            }
        }
    };
}

flags! {
    Lambda2 "lambda2" "A + tB built from K*, M* with the friction given; wrong sign of K1 or M1.",
    Mu "mu" "A + tB built from K0, K1; the friction coefficient of the file used although mu is \
             sought.",
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

impl Flag {
    /// The flag with this word.
    pub fn of_word(word: &str) -> Option<Flag> {
        Flag::ALL.iter().copied().find(|f| f.word() == word)
    }

    /// Can only the maker of a case know it?
    pub(super) fn is_given(self) -> bool {
        matches!(
            self,
            Flag::Threshold | Flag::NearThreshold | Flag::Fold | Flag::Random
        )
    }
}

/// Every flag that the problem and its exact answer show.
pub(super) fn derive(problem: &Problem, reduced: &Reduced, answer: &Enumeration) -> BTreeSet<Flag> {
    let mut flags = BTreeSet::new();
    let mut put = |flag, holds: bool| {
        if holds {
            flags.insert(flag);
        }
    };

    put(Flag::Lambda2, problem.unknown() == Unknown::Lambda2);
    put(Flag::Mu, problem.unknown() == Unknown::Mu);

    let pencil = &reduced.pencil;
    put(Flag::OneByOne, pencil.order() == 1);
    put(Flag::FreeVariables, !pencil.free().is_empty());

    let (large, small) = (
        mceip_exact::whole(100_000),
        mceip_exact::rational(1, 100_000),
    );
    let extreme = |v: &mceip_exact::Rational| {
        !v.is_zero() && (*v > large || -v > large || (*v < small && -v < small))
    };

    put(
        Flag::Scaled,
        pencil
            .a()
            .entries()
            .chain(pencil.b().entries())
            .any(|e| extreme(e.2)),
    );

    match problem.body() {
        Body::Pencil(_) => put(Flag::Pencil, true),
        Body::System(system) => {
            put(Flag::System, true);
            for p in system.particles() {
                put(Flag::Stick, p.state == ContactState::Stick);
                put(Flag::FreeParticle, p.state == ContactState::Free);

                put(
                    Flag::NormalAway,
                    p.normal_direction == -1 && matches!(p.state, ContactState::Slip { .. }),
                );
                put(Flag::Oblique, p.frame.is_some());
            }

            put(
                Flag::CoupledMass,
                system
                    .mass()
                    .is_some_and(|m| m.entries().any(|(i, j, _)| i != j)),
            );
        }
    }

    of_window(problem, answer, &mut put);
    of_answer(reduced, answer, &mut put);
    flags
}

fn of_window(problem: &Problem, answer: &Enumeration, put: &mut impl FnMut(Flag, bool)) {
    let window = problem.window();
    put(
        Flag::Window,
        window.max().is_some() || !window.min().is_zero(),
    );

    let ends = [Some(window.min()).filter(|m| !m.is_zero()), window.max()];
    let values = answer
        .solutions
        .iter()
        .map(|s| &s.value)
        .chain(answer.cones.iter().map(|c| &c.value));

    for mut value in values.cloned() {
        put(
            Flag::WindowEnd,
            ends.iter()
                .flatten()
                .any(|end| value.cmp_rational(end).is_eq()),
        );
    }
}

fn of_answer(reduced: &Reduced, answer: &Enumeration, put: &mut impl FnMut(Flag, bool)) {
    let listed = &answer.solutions;
    let count = listed.len() + answer.cones.len() + answer.ranges.len();
    put(Flag::NoSolution, count == 0);
    put(Flag::ManySolutions, count >= 10);
    put(Flag::WideKernel, !answer.wide.is_empty());
    put(Flag::Cone, !answer.cones.is_empty());
    put(Flag::SingularPencil, !answer.continua.is_empty());
    put(Flag::Continuum, !answer.ranges.is_empty());
    put(Flag::FreeOnly, answer.is_outside_propositions());

    let close = mceip_exact::rational(1, 100);
    for s in listed {
        let mut value = s.value.clone();
        value.try_rational();
        put(Flag::Irrational, value.as_rational().is_none());

        put(
            Flag::ZeroValue,
            value.cmp_rational(&mceip_exact::Rational::zero()).is_eq(),
        );
        put(Flag::RepeatedRoot, s.multiplicity > 1);
        put(Flag::Biactive, !s.biactive.is_empty());
        put(Flag::TinyComponent, tiny(s, &reduced.pencil.slip()));
    }

    for pair in listed.windows(2) {
        let equal = pair[0].value.clone().equals(&mut pair[1].value.clone());
        let gap = &pair[1].value.interval().lo().clone() - pair[0].value.interval().hi();

        let apart = {
            let (mut a, mut b) = (pair[0].value.clone(), pair[1].value.clone());
            a.refine_to(&(&close / mceip_exact::whole(100)));
            b.refine_to(&(&close / mceip_exact::whole(100)));

            b.interval().mid() - a.interval().mid()
        };

        put(Flag::SharedValue, equal);
        put(Flag::CloseValues, !equal && gap < close && apart < close);
    }
}

/// Is a positive component below 1e-3 of e'x_s? By correctly rounded decimals: 0.000... or an
/// exponent.
fn tiny(s: &mceip_oracle::Solution, slip: &[usize]) -> bool {
    let limit = mceip_exact::rational(1, 1000);
    let decimals = s.x_decimals(slip, 17);
    s.slip
        .iter()
        .any(|&i| mceip_exact::parse(&decimals[i]).is_ok_and(|v| v < limit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_distinct_and_read_back() {
        let words: BTreeSet<&str> = Flag::ALL.iter().map(|f| f.word()).collect();
        assert_eq!(words.len(), Flag::ALL.len());

        assert!(
            Flag::ALL
                .iter()
                .all(|f| Flag::of_word(f.word()) == Some(*f) && f.note().ends_with('.'))
        );

        assert_eq!(Flag::of_word("anything"), None);
    }
}
