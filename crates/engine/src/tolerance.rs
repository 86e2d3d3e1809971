//! Every tolerance on doubles of this crate, each with its unit and the measurement or reason on
//! which it is based.
//!
//! None of them decides a truth: they steer guesses that exact arithmetic then confirms or not. The
//! tolerances of the solver's own arithmetic are in `crates/mcp/src/solver/tolerance.rs`.

use std::ops::RangeInclusive;

/// Thresholds at which x_i, relative to max x_s, is guessed to be positive. Unit: none. Basis: the
/// block's lambda^2 mode has a true component of 6e-11 of its norm, and reports of six digits have
/// noise of 1e-6; so several guesses are tried and the exact signs decide. Last every component as
/// given: near a threshold true components are smaller than any bound (`near:1:122` of the
/// campaign).
pub const SUPPORT_GUESSES: [f64; 6] = [1e-9, 1e-6, 1e-4, 1e-12, 1e-3, 0.0];

/// A claim whose value is so near to that of a candidate, relative to it, is of the solution that
/// is meant, where it has every positive component of the candidate; else other supports are tried
/// too, and the nearest value is taken. Unit: none. Basis: candidates that have converged have nine
/// digits and more.
pub(crate) const MEANT_VALUE: f64 = 1e-9;

/// The same where small components of the candidate were left out: the value as given. Unit: none.
/// Basis: four units in the last place, two for the candidate's rounding and two for the middle of
/// the claim's enclosure; values 1e-14 apart are told apart.
pub(crate) const GIVEN_VALUE: f64 = 4.0 * f64::EPSILON;

/// A reported solution that is certified by nothing is inaccurate, and not wrong, where one of the
/// complete answer is within this many times [`VALUE_RADIUS`] and [`X_RADIUS`]. Unit: none. Basis:
/// a digit is missing; at two digits the pack's own wrong answers (one per cent off) begin.
pub const NEAR_RADII: f64 = 10.0;

/// How far from a candidate's value a root is looked for, relative to 1 + |value|. Unit: none.
/// Basis: reports carry six digits or more, but at a double root a residual of 1e-10 leaves an
/// error of 1e-5 times the square root of the condition (seen: 3e-5). The nearest root is taken,
/// and x must agree as well.
pub const VALUE_RADIUS: f64 = 1e-4;

/// Largest distance between candidate and certified x, both at largest |x_i| = 1. Unit: none.
/// Basis: like [`VALUE_RADIUS`], with the eigenvector's condition on top; a larger distance means
/// the certified solution is another one than the candidate.
pub const X_RADIUS: f64 = 1e-3;

/// Upper bound of the error of a distance of two vectors in doubles, both at largest |x_i| = 1.
/// Unit: none. Basis: two quotients, each rounded three times at most, are 6 times 2^-53 apart.
pub const DISTANCE_ROUNDING: f64 = 1e-15;

/// Share of a radius that the left side of Krawczyk's inequality may take where radii are proposed.
/// Unit: none. Basis: the checker asks for less than all of it; the rest is for what doubles do not
/// see.
pub const KRAWCZYK_MARGIN: f64 = 0.75;

/// Error of a sum of products in doubles, relative to the sum of their moduli. Unit: none. Basis: a
/// few thousand terms.
pub const KRAWCZYK_NOISE: f64 = 1e-13;

/// Bits of the largest entry of a Krawczyk preconditioner. Basis: 40 bits keep |I - YJ| below 1e-3
/// for the block (804 unknowns), and each bit costs 80 kB of certificate there.
pub const PRECONDITIONER_BITS: i32 = 40;

/// Bits of the contraction that rounding the preconditioner may take. Basis: 2^-10 is the 1e-3 of
/// [`PRECONDITIONER_BITS`]; more of them cost size, fewer the proof.
pub const PRECONDITIONER_LOSS_BITS: u32 = 10;

/// Two runs ended at the same point if value (relative to 1 + |value|) and x (l1 norm 1) agree to
/// this. Unit: none. Basis: runs stop at residuals of 1e-10; the later one is counted as repeated.
pub const SAME_POINT: f64 = 1e-9;

/// A closed curve has come back to the solution it left if it meets a point this near to it,
/// relative to 1 + |z_i|. Unit: none. Basis: ten times what the solver calls the same point of a
/// curve.
pub const SAME_CURVE_POINT: f64 = 1e-5;

/// Distance of a zeta window from the value it excludes, relative to 1 + |value|. Unit: none.
/// Basis: far above the accuracy of a run, so that the value itself is not found again; solutions
/// closer together than this are left to the plain starts.
pub const WINDOW_GAP: f64 = 1e-7;

/// Smallest pivot of the matrix game. Unit: that of the equilibrated columns (largest entry 1).
/// Basis: rounding of a simplex run of a few hundred pivots stays below 1e-10.
pub const GAME_PIVOT: f64 = 1e-9;

/// Margin by which a witness of the complete search must hold before it is rounded. Unit: that of
/// the equilibrated columns. Basis: rounding to 2^-40 and doubles' 1e-16 stay far below; the
/// trees of random pencils do not change between 1e-6 and 1e-8.
pub const WITNESS_MARGIN: f64 = 1e-7;

/// Margin at which a game is no longer played for a larger one. Unit: as [`WITNESS_MARGIN`]. Basis:
/// weights of 8 bits, the shortest, keep a margin of 1/256.
pub const ENOUGH_MARGIN: f64 = 4e-3;

/// The least gain in value of a part that counts where divisions are compared by the product of
/// both gains. Unit: as [`WITNESS_MARGIN`]. Basis: the rounding of a value; with zero in its place
/// a product could not tell divisions apart that gain on one side only.
pub const LEAST_GAIN: f64 = 1e-12;

/// Smallest pivot, relative to the largest entry, at which a symmetric part is offered as definite.
/// Unit: none. Basis: the checker takes off order 2^-32 of the largest entry, 6e-8 at order 272;
/// with 1e-6 the L-shaped body of 2,416 degrees of freedom takes 1,540 nodes in place of 510.
pub const DEFINITE_PIVOT: f64 = 1e-7;

/// A pivot below minus this says that a symmetric matrix is not semidefinite, so that exact factors
/// of it are not tried. Unit: the largest diagonal entry. Basis: rounding of an elimination of
/// order 48 stays below 1e-13; a smaller one would only try in vain now and then.
pub const SEMIDEFINITE_PIVOT: f64 = 1e-9;

/// Width below which an interval is no longer cut. Unit: share of the line of theta = t / (s + t).
/// Basis: what is still undecided on 1e-8 of the line is degenerate (a double root, a biactive
/// index): there branching and exact solutions help, cutting does not.
pub const NARROW: f64 = 1e-8;

/// The same where every index is decided and only cutting is left. Unit: as [`WITNESS_MARGIN`].
/// Basis: a thousand times the rounding of a product of a few dozen terms; near a double root the
/// margin falls with the square of the distance, and this bounds what stays open there.
pub const THIN_MARGIN: f64 = 1e-11;

/// Error of an entry of the condensed pencil in doubles. Unit: that of rows whose largest entry of
/// A is below one. Basis: sums of about a thousand terms. Where it is too small the checker refuses
/// the leaf, which then stays open; a larger one could not tell the sign of the block's smallest
/// component.
pub const CONDENSATION_NOISE: f64 = 5e-14;

/// What is added to a matrix game's entries beyond making them positive, relative to the largest.
/// Unit: none. Basis: a value that is not close to zero keeps the tableau's pivots well scaled.
pub const GAME_SHIFT: f64 = 1e-3;

/// Half widths tried for the interval of a root, narrowest first, relative to its value. Unit:
/// none. Basis: a root in doubles is good to 1e-15 times its condition, which for the block is
/// below 1e3.
pub const ROOT_HALF_WIDTHS: [f64; 5] = [1e-13, 1e-12, 1e-11, 1e-9, 1e-7];

/// Part of |I - Y T'| < 1 and of P epsilon that a regular leaf of the search keeps in reserve.
/// Unit: relative. Basis: a thousand times what doubles lose of sums of a few hundred terms, and
/// far below what a box is cut by.
pub const REGULAR_MARGIN: f64 = 1e-9;

/// Rounding of one sum of a few terms in doubles. Unit: relative. Basis: a few times 2^-53.
pub const ROUNDING: f64 = 1e-15;

/// Part of the distance to an interval's ends that stays open around a null vector that is not
/// provably alone. Unit: none. Basis: small enough that the rest of the interval closes (a double
/// root's margin falls with the square), large enough for doubles.
pub const DEGENERATE_PART: f64 = 1e-3;

/// Distance, relative to the value, within which the x of an accepted solution is looked for. Unit:
/// none. Basis: far wider than the accepted interval; what is found is held against it.
pub const SAME_ROOT: f64 = 1e-6;

/// Distance from the accepted value at which a null vector in doubles is that of another one. Unit:
/// of the value and of the scale of T. Basis: simple values come with 1e-15 times their condition.
pub const SAME_VALUE: f64 = 1e-12;

/// Where the search for a definite tail begins, relative to |A| / |B|. Unit: none. Basis: low
/// frequencies of meshes of a million elements; it doubles from there.
pub const TAIL_START: f64 = 1e-6;

/// The same on a condensed pencil, once its radius has been taken off. Unit: as [`WITNESS_MARGIN`].
/// Basis: a thousand times what the checker's exact condensation and the one in doubles differ by.
pub const CONDENSED_MARGIN: f64 = 1e-9;

/// Radii, relative to 1 + |value|, within which a refused candidate is proved to have no solution
/// near it, largest first. Unit: none. Basis: the first is [`VALUE_RADIUS`], where certification
/// looks; the smaller ones are for windows that another, degenerate solution keeps open.
pub const ABSENCE_RADII: [f64; 3] = [VALUE_RADIUS, 1e-7, 1e-10];

/// Width of the enclosure of a root that ends definiteness, relative: 2^-this. Unit: none. Basis:
/// 17 digits can be printed.
pub const BRACKET_BITS: u32 = 64;

/// First distance before the proposed end of definiteness at which it is tried to be proved,
/// relative: 2^-this, widening by 4. Unit: none. Basis: on meshes of 2,416 degrees of freedom
/// doubles find the end to some 1e-11 of it. Reason: 9 digits are printed, and each distance that
/// is too small costs an exact LDL'.
pub const BRACKET_START_BITS: u32 = 32;

/// Sine of the angle in the complex plane from which an eigenvalue lambda^2 of a large matrix in
/// doubles counts as complex. Unit: none. Basis: in doubles a double eigenvalue splits by 1e-8, a
/// triple one by 1e-5, times what the condition of M costs; growth below a ten-thousandth of the
/// frequency is less than any damping.
pub const FLUTTER_ANGLE: f64 = 1e-4;

/// Change of a matrix in doubles that counts as rounding where complex lambda^2 are told from real
/// ones. Unit: share of what solving with M* adds up in each entry, |M*^-1| |M*| |A|, times the
/// order; of a large matrix share of its largest entry. Basis: some fifty times what solving with
/// M* and the iteration for eigenvalues leave. Reason: a pair that such a change can make real is
/// not called flutter.
pub const FLUTTER_ROUNDING: f64 = 1e-14;

/// Sizes of numbers that a sentence prints with six decimals; others get six digits and an
/// exponent. Unit: none. Reason: below, six decimals have two digits at most; above, doubles do not
/// tell whole numbers apart.
pub const WITH_SIX_DECIMALS: RangeInclusive<f64> = 1e-4..=1e15;

/// Imaginary part, relative to the largest eigenvalue, up to which an eigenvalue of the QR
/// algorithm is offered as real, and the residual up to which Newton's method then keeps it. Unit:
/// none. Basis: simple eigenvalues come with 1e-13 times their condition, below 1e4 for condensed
/// meshes.
pub const REAL_EIGENVALUE: f64 = 1e-9;

/// Share of the way from lo to infinity (in lo / t) that a null vector's value in doubles may be
/// off infinity, before the exact null vector there is asked for. Unit: none. Basis: roots are good
/// to 1e-12; where it asks in vain nothing is lost.
pub const AT_INFINITY: f64 = 1e-6;

/// alpha up to which a point (alpha, beta) of the unit circle is the one at infinity, where t =
/// beta / alpha is no value. Unit: none. Basis: a solution at infinity was met at alpha from 1e-18
/// to 3e-17 (random pencil 163 of `verify`), within the rounding of coordinates of order one.
pub const CIRCLE_END: f64 = 1e-13;

/// Relative error up to which a reported value, and x scaled to largest |x_i| = 1, agree with the
/// proven solution, if `check --tolerance` does not say otherwise. Unit: none. Basis: a program
/// that solves in doubles and prints seven digits reaches it where the condition is below 1e9; a
/// wrong component or value of the size of its own error bars does not pass.
pub const AGREEMENT: f64 = 1e-6;

/// The smallest error that `check --tolerance` may ask for. Unit: relative. Basis: a few roundings
/// of doubles, in which reports are compared.
pub const FINEST_AGREEMENT: f64 = 1e-15;

/// What `check --tolerance` takes, in words: from [`FINEST_AGREEMENT`] to [`VALUE_RADIUS`].
pub const AGREEMENT_RANGE: &str = "a number from 1e-15 to 1e-4";

/// Values below this share of the scale of values, min_i (|A||x|)_i / (|B||x|)_i, have their errors
/// measured relative to that share. Unit: none. Basis: with [`AGREEMENT`] a value 0 may be reported
/// as 1e-13 of the scale, some hundred times what rounding A and B to doubles moves it; lambda^2
/// just above a threshold is 1e-7 of the largest one on an ordinary mesh (1.3e3 beside 1e10), and
/// must have its digits still.
pub const VALUE_FLOOR: f64 = 1e-7;

/// Probability below which a count under its floor is not put down to chance. Unit: none. Reason: a
/// run judges at most 60 rates, and the true rates lie two points above the floors, so that fewer
/// than one sound run in a hundred fails, while a solver that finds nothing fails after three
/// instances.
pub const CHANCE: f64 = 1e-4;

/// Relative distance up to which the end of a run of PATH's own sequence counts as a proved value
/// of a block state. Unit: none. Reason: runs stop at residuals of 1e-10, and values of one state
/// lie apart by more than a part in a thousand.
pub const PATH_VALUE: f64 = 1e-8;

/// Distance from the lower end of the window up to which a solution shares the anchor of that end.
/// Unit: of the end + the lowest frequency of the free variables. Basis: W and V lack the third
/// power of it and the remainder the sixth, which is below the rounding of doubles. Reason: two
/// anchors so near one another would cut the pieces beside a threshold without need.
pub(crate) const SHARED_ANCHOR: f64 = 1e-3;

/// First step along a branch in (lambda^2, mu). Unit: of lambda^2 + the lowest frequency. Reason:
/// small beside the distance over which a condensed matrix changes; the steps double.
pub(crate) const BRANCH_STEP: f64 = 1e-3;

/// Width to which the place of a fold is narrowed. Unit: of lambda^2. Basis: mu changes with the
/// square of it there, which is the rounding of doubles.
pub(crate) const FOLD_WIDTH: f64 = 1e-7;

/// Distance beyond a kink at which the neighbouring support is looked at. Unit: of lambda^2 + the
/// lowest frequency. Basis: a thousand times what doubles misplace a kink by.
pub(crate) const KINK_SIDE: f64 = 1e-6;

/// Largest Newton step of a converged point of a branch. Unit: of the point. Basis: a hundred times
/// the rounding of doubles; the method is quadratic.
pub(crate) const NEWTON_CONVERGED: f64 = 1e-13;

/// Values of x_i and y_i above minus this count as not negative along a branch. Unit: none, with
/// e'x = 1 and rows of largest entry one. Basis: rounding of a solve with a well-conditioned block;
/// exact arithmetic decides about the point that is certified.
pub(crate) const SIGN_NOISE: f64 = 1e-11;

/// How far from a minimum of mu the lambda^2 at which it is certified may lie. Unit: of lambda^2.
/// Basis: at a fold mu changes with the square of it, beside a kink in proportion; both stay below
/// a tenth of the gap that is aimed at.
pub(crate) const SHORT_VALUE: f64 = 1e-8;

/// Half widths of the windows in which a solution known in doubles is certified, in this order.
/// Unit: of mu. Basis: a simple eigenvalue is good to 1e-15 times its condition. Reason: the
/// condensation may leave the neighbourhood of the solution open in the first window; the second
/// leaves that out, the third is for values that doubles know badly.
pub(crate) const NARROW_WINDOWS: [f64; 3] = [1e-9, 1e-11, 1e-6];

/// Gap between the bounds of the critical mu beyond which the user is told that more boxes may
/// help. Unit: of mu. Basis: what is aimed at for large bodies, 1e-5.
pub const WIDE_CRITICAL_GAP: f64 = 1.1e-5;

/// Part of the inequalities of a piece of presence that doubles keep in reserve. Unit: relative.
/// Basis: a thousand times what doubles lose of sums of a few hundred terms.
pub(crate) const PRESENCE_MARGIN: f64 = 1e-9;

/// The shortest stretch of mu on which presence is proved, and the shortest that is left out where
/// a support changes. Unit: of mu. Reason: each halving of it costs two pieces at every such place.
pub(crate) const LEAST_STRETCH: f64 = 1e-6;

/// How far above the smallest solution presence is tried to be proved. Unit: of mu. Basis: the gap
/// that is aimed at for the critical mu is of this size.
pub(crate) const PRESENCE_START: f64 = 1e-6;

/// How far an anchor serves at which presence failed for want of precision. Unit: of lambda^2 + the
/// lowest frequency. Basis: on the L-shaped body of 172 degrees of freedom 0.1 proves more than 0.2
/// and 0.3.
pub(crate) const PRESENCE_NEAR: f64 = 0.1;

/// The shortest interval of presence that is worth a certificate. Unit: of mu. Reason: a file for
/// each of them.
pub(crate) const LEAST_INTERVAL: f64 = 1e-4;

/// How far above the smallest solution the first sample of mu lies. Unit: of mu. Reason: nearer to
/// the threshold a complete search takes longer and decides less; the critical mu itself is
/// certified apart.
pub(crate) const ABOVE_CRITICAL: f64 = 1e-3;

/// Gap between absence and solution that is looked at first. Unit: of mu. Reason: cheap, and meets
/// solutions that are still unknown.
pub(crate) const FIRST_GAP: f64 = 1e-2;

/// Gaps that are aimed at, until one is proved. Unit: of mu. Reason: the first two are what is
/// asked of small and of large bodies, with a tenth for the rounding of the bound; the others are
/// better than nothing.
pub(crate) const CRITICAL_GAPS: [f64; 5] = [8e-7, 8e-6, 1e-3, 3e-2, 0.3];

/// How much smaller than the known one a mu in doubles must be to be worth a certificate. Unit: of
/// mu. Basis: a tenth of what the last of [`CRITICAL_GAPS`] would notice.
pub(crate) const SMALLER_FRICTION: f64 = 1e-8;

/// How near an anchor is used where the remainders of coarse ones stand in the way, and by what
/// share nearer where its own do; and the least. Unit: of lambda^2 + the lowest frequency. Basis:
/// the remainder falls with the sixth power of it.
pub(crate) const FIRST_NEAR: f64 = 0.1;
pub(crate) const NEARER: f64 = 0.3;
pub(crate) const LEAST_NEAR: f64 = 2e-3;

/// The smallest mu at which stability is tried, and the share to which the largest one with a proof
/// is sought. Unit: of mu; itself. Reason: what is proved is printed with four digits.
pub(crate) const LEAST_STABLE: f64 = 1e-6;
pub(crate) const STABLE_END: f64 = 1e-4;

/// What is taken off T for rounding in a proof of stability; the next, should the checker refuse.
/// Unit: the largest entry of K_ss. Basis: sums in doubles of some hundred terms.
pub(crate) const STABLE_MARGINS: [f64; 3] = [1e-10, 1e-8, 1e-6];

/// The smallest pivot of a matrix taken for definite, and the smallest eigenvalue of projections
/// onto definite ones. Unit: of a diagonal of 1. Reason: the checker decides on what is written.
pub(crate) const LEAST_PIVOT: f64 = 1e-8;
pub(crate) const LEAST_EIGENVALUE: f64 = 1e-5;

/// How near to a value the centre of its long anchor has to be. Unit: the value, at least the scale
/// of values. Basis: 2^-50; the coefficients of W have 50 bits less from power to power.
pub(crate) const NEAR_ANCHOR: f64 = 9e-16;

/// Components of a guess at a solution below this are not in its support. Unit: the largest one.
/// Basis: a guess is a start for Newton's method, and a kink is crossed where the support is wrong.
pub(crate) const GUESS_SUPPORT: f64 = 1e-3;

/// Newton's decrement at which a centre of the barrier of weights is reached. Unit: that of the
/// barrier, a sum of logarithms. Basis: below 1/4 the method converges quadratically.
pub(crate) const NEWTON_DECREMENT: f64 = 1e-2;
