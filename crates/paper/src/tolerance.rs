//! Tolerances of the loading path and of results read from other programs, with unit, basis and
//! reason. None decides a truth.

/// Relative distance from the friction cone within which a reaction of a finite-element program
/// counts as on it (numerator, denominator). Unit: none. Basis: such programs iterate on contact to
/// 1e-3 to 1e-6 of the reaction; states are given, the reaction only guards against a wrong sign or
/// another mu.
pub(crate) const CONE_SLACK: (i64, i64) = (1, 1000);

/// How far the tangent of half the angle of a rational rotation may be from the one given
/// (numerator, denominator). Unit: none. Basis: an angle in degrees with ten digits and a direction
/// in doubles are known to 1e-12 at best, and its denominators stay below 1e6, so that matrices in
/// these directions stay short.
pub(crate) const HALF_TANGENT: (i64, i64) = (1, 1_000_000_000_000);

/// How far the lengths and the determinant of a frame in doubles may be from 1. Unit: none. Basis:
/// a program that prints nine digits or more is meant; a matrix that is no rotation misses by more.
pub(crate) const ROUNDED_FRAME: f64 = 1e-8;

/// How far an entry of K or M may be from its mirror image, relative to the largest entry, to be
/// called rounding (numerator, denominator). Unit: none. Basis: sums of a hundred doubles in
/// another order differ by 1e-14 of the largest; matrices printed with twelve digits by less than
/// 1e-12.
pub(crate) const ROUNDED_SYMMETRY: (i64, i64) = (1, 1_000_000_000_000);

/// How little the lowest Ritz values may change in a step, relative to themselves, to be taken for
/// eigenvalues. Unit: none. Basis: five digits are printed; the error is of the order of the change
/// where the iteration converges at all.
pub(crate) const RITZ_CHANGE: f64 = 1e-9;

/// Rounding of the projected stiffness, relative to the lowest eigenvalue, above which its digits
/// are not printed. Unit: none. Basis: five digits are printed. Reason: springs of 1e15 beside
/// those of 1 leave one digit of the lowest frequency.
pub(crate) const RITZ_ROUNDING: f64 = 1e-5;

/// Steps of subspace iteration before it is given up. Basis: eight columns for three frequencies
/// settle in 10 to 40 steps on the meshes of this repository.
pub(crate) const RITZ_STEPS: usize = 500;

/// Up to which a row of K, relative to the sizes of its entries, sums to zero by rounding. Unit:
/// none. Basis: matrices with 17 digits give 1e-15, with nine digits 1e-9, with four 1e-4.
pub(crate) const BALANCED_ROWS: f64 = 1e-7;

/// From which the sum of a row of K is one of a row near a support, as in systems of few degrees
/// of freedom, and says nothing about digits. Unit: none. Basis: such a row lacks the stiffness
/// against the support, which is of the size of its other entries.
pub(crate) const NEAR_SUPPORTS: f64 = 1e-2;

/// How many times the other entries of its row together the diagonal entry of K has to be for the
/// row to stand alone. Unit: none. Basis: a row of an element has 1 to 10 in either unit of length,
/// rotations included; a penalty has 1e6 or more, and a unit row no other entry.
pub(crate) const ROW_ALONE: f64 = 1e4;

/// How many times as far apart as beside it two contact nodes are where one is missing between
/// them. Unit: none. Basis: 2 on an even mesh; meshes are graded by less than 1.5 from one element
/// to the next, and two parts of a contact lie farther apart.
pub(crate) const ONE_MISSING: [f64; 2] = [1.6, 2.6];

/// How far from the middle between two contact nodes a node lies that is meant by it, relative to
/// their distance. Unit: none. Basis: on an even mesh it is in the middle.
pub(crate) const IN_THE_MIDDLE: f64 = 0.2;

/// How far the masses of the two degrees of freedom of a node may be from each other, relative.
/// Unit: none. Basis: they are equal but for rounding; nodes of different volume differ by more.
pub(crate) const EQUAL_MASSES: f64 = 1e-9;

/// Lowest and highest first frequency, in cycles per unit of time, that are not asked about. Basis:
/// in seconds, tall buildings have 0.1, steel of a millimetre 1e6. A density in kg/m^3 beside N and
/// mm is wrong by 1e12, its frequencies by 1e6; kg in place of t makes 32, which no bound sees.
pub(crate) const USUAL_FREQUENCIES: [f64; 2] = [1e-2, 1e6];

/// Highest coefficient of friction that is not asked about. Basis: rubber on rough ground has 2,
/// and the least per cent or angle in degrees that anybody means is above 5.
pub(crate) const USUAL_FRICTION: f64 = 5.0;

/// How far a tangent may be turned from the line through neighbouring nodes in contact, in degrees.
/// Basis: on an arc of eight elements to the quarter circle a chord is turned by 6 degrees from the
/// tangent at its end. An angle with the wrong sign is wrong by twice its size, exchanged
/// coordinates of a normal turn it by 90 degrees less twice its angle with x.
pub(crate) const TURNED_TANGENT: f64 = 10.0;

/// Mean cosine of the angle between the normal into the obstacle and the edges to neighbouring
/// nodes from which on the normal points into the body. Unit: none. Basis: at a flat boundary the
/// mean is -0.3 to -0.5 on meshes of triangles and quadrilaterals; with nodes along the boundary
/// alone it is at most 0.17, the sine of 10 degrees, where the boundary bends by less than that.
pub(crate) const INTO_THE_BODY: f64 = 0.17;

/// How far reactions may be from K u, relative to the largest. Unit: none. Basis: finite-element
/// programs iterate on contact to 1e-3 or better; a wrong number or sign misses by about 1.
pub(crate) const REACTION_MISMATCH: f64 = 1e-2;
