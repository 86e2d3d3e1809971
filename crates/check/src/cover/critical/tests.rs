//! The corners of boxes against the Schur complement in rational numbers, for a system with two
//! free degrees of freedom, an oblique particle and a consistent mass.

use super::super::budget::WorkBudget;
use super::super::context::corners;
use super::super::ends::{EndMatrix, Ends};
use super::super::region::Region;
use super::*;
use crate::certificate::{CriticalAnchor, CriticalCondensation, Factor, IntegerMatrix};
use crate::pencil::Rows;
use mceip_exact::{Integer, Rational, Sparse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{ContactState, Particle, Radii, System};
use num_traits::{One, Signed};

type Dense = Vec<Vec<Rational>>;

/// A symmetric matrix of order 6 with entries from -3 to 3 over `denominator`, and `diagonal` added
/// to its diagonal.
fn symmetric(diagonal: i64, denominator: i64) -> Sparse {
    let mut entries = Vec::new();
    for i in 0..6 {
        for j in 0..6 {
            let digit = (3 * i.min(j) + 5 * i.max(j)) % 7;
            let value = rational(digit as i64 - 3, denominator);
            let shift = whole(if i == j { diagonal } else { 0 });
            entries.push((i, j, value + shift));
        }
    }
    Sparse::from_entries(6, 6, entries)
}

fn parts() -> FrictionParts {
    parts_of(&system(symmetric(20, 1), symmetric(5, 3)))
}

fn parts_of(system: &System) -> FrictionParts {
    FrictionParts::of(system, system.mass().unwrap())
}

fn system(stiffness: Sparse, mass: Sparse) -> System {
    let oblique = Particle {
        frame: Some([
            [rational(3, 5), rational(4, 5)],
            [rational(-4, 5), rational(3, 5)],
        ]),
        ..Particle::plain(0, 1, ContactState::Slip { sign: 1 })
    };
    let along_the_axes = Particle {
        normal_direction: -1,
        ..Particle::plain(4, 5, ContactState::Slip { sign: -1 })
    };
    let particles = vec![oblique, along_the_axes];
    System::new(stiffness, Some(mass), Some(whole(1)), particles).unwrap()
}

/// The same with radii of all data, and one of two factors within [1/2, 3/2].
fn system_with_radii() -> System {
    let mut particles = system(symmetric(20, 1), symmetric(5, 3))
        .particles()
        .to_vec();
    particles[1].friction_factor_range = Some([rational(1, 2), rational(3, 2)]);
    let stiffness = symmetric(20, 1);
    let mass = symmetric(5, 3);
    let radii = Radii {
        stiffness: Some(Radii::relative(&stiffness, &rational(1, 50))),
        mass: Some(Radii::absolute(&mass, &rational(1, 100))),
    };
    let system = System::new(stiffness, Some(mass), Some(whole(1)), particles).unwrap();
    system.with_radii(radii).unwrap()
}

/// A member at a corner of what the radii allow, which the digits of `choice` pick.
fn member(of: &System, choice: usize) -> System {
    let corner = |matrix: &Sparse, radius: &Option<Sparse>| {
        let mut entries = Vec::new();
        for (i, j, r) in radius.iter().flat_map(Sparse::entries) {
            let digit = (choice + i.min(j) * 5 + i.max(j) * (choice % 4 + 1)) % 3;
            entries.push((i, j, r * whole(digit as i64 - 1)));
        }
        let off = Sparse::from_entries(6, 6, entries);
        matrix.add_scaled(&whole(1), &off)
    };

    let mut particles = of.as_given().particles().to_vec();
    if let Some([lo, hi]) = of.particles()[1].friction_factor_range.clone() {
        particles[1].friction_factor = if choice.is_multiple_of(2) { lo } else { hi };
    }
    let stiffness = corner(of.stiffness(), &of.radii().stiffness);
    let mass = corner(of.mass().unwrap(), &of.radii().mass);
    System::new(stiffness, Some(mass), Some(whole(1)), particles).unwrap()
}

/// The columns `free` or `slip` of the row as a matrix at t, exact, times the factor of the row.
fn block(rows: &Rows, of_free_rows: bool, of_free_columns: bool, t: &Rational) -> Dense {
    let mut block = Dense::new();
    for (i, row) in rows.rows.iter().enumerate() {
        if rows.is_free[i] != of_free_rows {
            continue;
        }

        let mut dense = vec![whole(0); rows.order()];
        for (j, a, b) in row {
            let value = Rational::from_integer(a.clone()) + t * Rational::from_integer(b.clone());
            dense[*j] = value;
        }
        let columns = (0..rows.order()).filter(|&j| rows.is_free[j] == of_free_columns);
        block.push(columns.map(|j| dense[j].clone()).collect());
    }
    block
}

/// F^-1 C for F of order 2.
fn solve(f: &Dense, c: &Dense) -> Dense {
    let determinant = &f[0][0] * &f[1][1] - &f[0][1] * &f[1][0];
    let mut solution = Dense::new();
    for (i, other) in [(0, 1), (1, 0)] {
        let row = (0..c[0].len())
            .map(|j| (&f[other][other] * &c[i][j] - &f[i][other] * &c[other][j]) / &determinant);
        solution.push(row.collect());
    }
    solution
}

/// T_ss - T_sf F^-1 T_fs of a part, rows times their factors.
fn schur(rows: &Rows, t: &Rational) -> Dense {
    let mut schur = block(rows, false, false, t);
    let sf = block(rows, false, true, t);
    let w = solve(&block(rows, true, true, t), &block(rows, true, false, t));

    for (row, sf_row) in schur.iter_mut().zip(&sf) {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry -= &sf_row[0] * &w[0][j] + &sf_row[1] * &w[1][j];
        }
    }
    schur
}

/// Entries in units of 2^-`exponent`, rounded down.
fn rounded(matrix: &Dense, exponent: u32) -> IntegerMatrix {
    let unit = Rational::from_integer(Integer::one() << exponent);
    let row = |row: &Vec<Rational>| {
        row.iter()
            .map(|v| (v * &unit).floor().to_integer())
            .collect()
    };
    IntegerMatrix {
        exponent,
        rows: matrix.iter().map(row).collect::<Vec<_>>().into(),
    }
}

/// F^-1 T_sf' of a part at t, with the rows as given.
fn left(rows: &Rows, t: &Rational) -> Dense {
    let sf = block(rows, false, true, t);
    let slip_factors = rows
        .factor
        .iter()
        .zip(&rows.is_free)
        .filter(|(_, free)| !**free);
    let factors: Vec<Rational> = slip_factors
        .map(|(factor, _)| Rational::from_integer(factor.clone()))
        .collect();
    let transposed: Dense = (0..2)
        .map(|k| (0..2).map(|i| &sf[i][k] / &factors[i]).collect())
        .collect();

    // The free rows have one factor in common.
    let mut f = block(rows, true, true, t);
    for (row, factor) in f.iter_mut().zip(&rows.factor) {
        for entry in row {
            *entry /= Rational::from_integer(factor.clone());
        }
    }
    solve(&f, &transposed)
}

/// Constants at the center, and one anchor for 1/t with nothing at all.
fn condensation(parts: &FrictionParts, center: &Rational, exponent: u32) -> CriticalCondensation {
    let plain = &parts.plain;
    let right = solve(
        &block(plain, true, true, center),
        &block(plain, true, false, center),
    );
    let factor = |diagonal: i64| Factor {
        first: vec![0, 0],
        rows: vec![
            vec![Integer::from(diagonal)].into(),
            vec![0.into(), diagonal.into()].into(),
        ],
        exponent: 0,
    };

    CriticalCondensation {
        sigma: Number(whole(6)),
        stiffness_factor: factor(3),
        mass_sigma: Number(whole(1)),
        mass_factor: Some(factor(1)),
        anchors: vec![
            CriticalAnchor {
                center: Number(center.clone()),
                reversed: false,
                right: vec![rounded(&right, exponent)],
                left: Some(vec![rounded(&left(plain, center), exponent)]),
                left_friction: vec![rounded(&left(&parts.friction, center), exponent)],
            },
            CriticalAnchor {
                center: Number(whole(0)),
                reversed: true,
                right: vec![],
                left: Some(vec![]),
                left_friction: vec![],
            },
        ],
        tail: None,
    }
}

fn boxed(t: [Rational; 2], friction: [Rational; 2]) -> Region {
    let [lo, hi] = t.map(Rc::new);
    Region::new(lo, Some(hi), Some(friction.map(Rc::new)), 2)
}

/// Centers and radii.
type Enclosure = [Dense; 2];

fn enclosures(ends: &[Ends]) -> Vec<Enclosure> {
    let of_corner = |corner: EndMatrix<'_>| {
        let in_units_of_one = |matrix: &Vec<Vec<Integer>>| -> Dense {
            let entry = |v: &Integer| Rational::new(v.clone(), corner.scale.clone());
            matrix
                .iter()
                .map(|row| row.iter().map(entry).collect())
                .collect()
        };
        [&corner.matrix.m, &corner.matrix.r].map(in_units_of_one)
    };
    corners(ends).into_iter().map(of_corner).collect()
}

/// The largest radius of the combination of the corners with these shares of the upper end and of
/// the higher friction; `None` where T(t, mu), scaled, does not lie within it.
fn radius_about(
    corners: &[Enclosure],
    [upper, higher]: [&Rational; 2],
    truth: &Dense,
    row_units: &[Rational],
) -> Option<Rational> {
    let mut widest = whole(0);
    for i in 0..2 {
        for j in 0..2 {
            let mut center = whole(0);
            let mut radius = whole(0);
            for (corner, at) in corners.iter().zip(0..4) {
                let of_t = if at % 2 == 1 {
                    upper.clone()
                } else {
                    whole(1) - upper
                };
                let of_mu = if at / 2 == 1 {
                    higher.clone()
                } else {
                    whole(1) - higher
                };
                let share = of_t * of_mu;
                center += &share * &corner[0][i][j];
                radius += &share * &corner[1][i][j];
            }

            let error = (&truth[i][j] / &row_units[i] - center).abs();
            if error > radius {
                return None;
            }
            widest = widest.max(radius);
        }
    }
    Some(widest)
}

/// 2^b_i of the slip rows, by the entries of both parts that `pick` takes.
fn row_units(
    parts: &FrictionParts,
    pick: impl Fn(&(usize, Integer, Integer)) -> u64,
) -> Vec<Rational> {
    let mut units = Vec::new();
    for i in 0..4 {
        if parts.plain.is_free[i] {
            continue;
        }
        let both = parts.plain.rows[i].iter().chain(&parts.friction.rows[i]);
        let bits = both.map(&pick).max().unwrap();
        units.push(Rational::from_integer(Integer::one() << bits));
    }
    units
}

/// The values of t of these tests.
fn interval() -> [Rational; 2] {
    [rational(1, 3), rational(9, 7)]
}

/// T0 + mu T1 of parts, condensed at t, its rows times `factors`.
fn condensed_at(parts: &FrictionParts, t: &Rational, mu: &Rational, factors: &[Integer]) -> Dense {
    let mut sum = schur(&parts.plain, t);
    let friction = schur(&parts.friction, t);
    let own = slip_factors(&parts.plain);
    for (i, row) in sum.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry += mu * &friction[i][j];
            *entry *= Rational::new(factors[i].clone(), own[i].clone());
        }
    }
    sum
}

fn slip_factors(rows: &Rows) -> Vec<Integer> {
    let slip = rows.complementarity_variables().into_iter();
    slip.map(|i| rows.factor[i].clone()).collect()
}

/// Both parts about the anchor with this number.
fn context<'a>(
    parts: &'a FrictionParts,
    condensation: &CriticalCondensation,
    window: &'a Window,
    anchor: usize,
) -> Context<'a> {
    let both = [&parts.plain, &parts.friction];
    let [lo, hi] = interval();
    let pencil = PencilParts {
        rows: &both,
        radii: parts.radii.as_ref(),
        pieces: &[AnchoredPiece {
            anchor: Some(anchor),
            lo,
            hi: Some(hi),
        }],
    };
    let anchors = anchors(pencil, Some(condensation)).unwrap();
    let mut context = Context::new(pencil, anchors.as_ref(), window, 1);
    context.use_anchor(anchors.as_ref(), Some(anchor)).unwrap();
    context
}

/// The largest radius at 25 places of a box of `parts`; `None` where what the parts of one of
/// `members` give at one of them is outside.
fn radius_about_members(
    parts: &FrictionParts,
    members: &[FrictionParts],
    condensation: &CriticalCondensation,
    anchor: usize,
) -> Option<Rational> {
    let [lo, hi] = interval();
    let (low, high) = (rational(2, 11), rational(5, 3));
    let shares = [0, 1, 3, 5, 8].map(|k| rational(k, 8));

    let window = Window::all();
    let context = context(parts, condensation, &window, anchor);
    let at = boxed([lo.clone(), hi.clone()], [low.clone(), high.clone()]);
    let corners = enclosures(&context.ends(&at).unwrap());
    let is_reversed = anchor == 1;
    let units = row_units(
        parts,
        |(_, a, b)| if is_reversed { b.bits() } else { a.bits() },
    );
    let factors = slip_factors(&parts.plain);

    let mut widest = whole(0);
    for share in &shares {
        for higher in &shares {
            let t = if is_reversed {
                ((whole(1) - share) / &lo + share / &hi).recip()
            } else {
                &lo + share * (&hi - &lo)
            };
            let mu = &low + higher * (&high - &low);
            for member in members {
                let mut truth = condensed_at(member, &t, &mu, &factors);
                if is_reversed {
                    truth.iter_mut().flatten().for_each(|entry| *entry /= &t);
                }
                let radius = radius_about(&corners, [share, higher], &truth, &units)?;
                widest = widest.max(radius);
            }
        }
    }
    Some(widest)
}

#[test]
fn the_corners_enclose_the_schur_complement() {
    // Rounded well and hardly, and far from the center.
    for (center, exponent) in [(rational(4, 5), 40), (rational(4, 5), 2), (whole(7), 30)] {
        let condensation = condensation(&parts(), &center, exponent);
        for anchor in [0, 1] {
            let widest = radius_about_members(&parts(), &[parts()], &condensation, anchor).unwrap();
            if exponent == 40 && anchor == 0 {
                assert!(widest < rational(1, 20), "{widest}");
            }
        }
    }
}

/// Corners of what the radii allow lie within the enlarged enclosures, and not within those of the
/// body as given.
#[test]
fn the_corners_enclose_every_member() {
    let system = system_with_radii();
    let parts = parts_of(&system);
    let members: Vec<FrictionParts> = (0..9).map(|k| parts_of(&member(&system, k))).collect();

    for (center, exponent) in [(rational(4, 5), 40), (rational(4, 5), 2), (whole(7), 30)] {
        let condensation = condensation(&parts, &center, exponent);
        for anchor in [0, 1] {
            let widest = radius_about_members(&parts, &members, &condensation, anchor).unwrap();
            if exponent == 40 && anchor == 0 {
                assert!(widest < rational(1, 2), "{widest}");
            }
        }
    }
}

/// Each of the radii counts: without it there is a member outside.
#[test]
fn no_radius_may_be_forgotten() {
    let all = system_with_radii();
    let with = |radii: Radii, has_factors: bool| {
        let mut system = all.clone().with_radii(radii).unwrap();
        if !has_factors {
            system = system
                .as_given()
                .with_radii(system.radii().clone())
                .unwrap();
        }
        system
    };
    let Radii { stiffness, mass } = all.radii().clone();
    let none = None;

    for system in [
        with(
            Radii {
                stiffness,
                mass: none.clone(),
            },
            false,
        ),
        with(
            Radii {
                stiffness: none,
                mass,
            },
            false,
        ),
        with(Radii::NONE, true),
    ] {
        let parts = parts_of(&system);
        let condensation = condensation(&parts, &rational(4, 5), 40);
        let members: Vec<FrictionParts> = (0..9).map(|k| parts_of(&member(&system, k))).collect();
        let radius_about = |parts| radius_about_members(parts, &members, &condensation, 0);
        assert!(radius_about(&parts).is_some());

        let forgetful = parts_of(&system.middle());
        assert_eq!(radius_about(&forgetful), None);
    }
}

/// An anchor that serves an unbounded piece has no reach.
#[test]
fn a_piece_without_end_is_refused_where_there_are_radii() {
    let parts = parts_of(&system_with_radii());
    let condensation = condensation(&parts, &rational(4, 5), 40);
    let both = [&parts.plain, &parts.friction];
    let [lo, hi] = interval();
    let zero = whole(0);
    for (anchor, lo, hi, is_bounded) in [
        (0, &lo, Some(&hi), true),
        (0, &lo, None, false),
        (1, &lo, None, true),
        (1, &zero, Some(&hi), false),
    ] {
        let pencil = PencilParts {
            rows: &both,
            radii: parts.radii.as_ref(),
            pieces: &[AnchoredPiece {
                anchor: Some(anchor),
                lo: lo.clone(),
                hi: hi.cloned(),
            }],
        };
        let anchors = anchors(pencil, Some(&condensation)).unwrap().unwrap();
        let refused = anchors.expand(anchor).err();
        let is_refused = matches!(refused, Some(CoverFault::Unbounded { .. }));
        assert_eq!(is_refused, !is_bounded, "{anchor} {refused:?}");
    }
}

/// Matrices count once for all boxes that share them.
#[test]
fn boxes_count_their_matrices_once() {
    let parts = parts();
    let condensation = condensation(&parts, &rational(4, 5), 40);
    let window = Window::all();
    let mut context = context(&parts, &condensation, &window, 0);
    let at = || {
        let t = [rational(1, 3), rational(9, 7)];
        boxed(t, [rational(2, 11), rational(5, 3)])
    };
    let before = context.matrix_budget.left();

    let first = at();
    assert_eq!(context.affordable(&first), Ok(()));
    assert!(context.ends(&first).is_ok());
    let cost = before - context.matrix_budget.left();
    assert!(cost > 0);

    // A box that differs in its states alone costs no more.
    let [resting, moving] = first.branch(2, &[2, 3], None).unwrap();
    for sibling in [resting, moving] {
        assert_eq!(context.affordable(&sibling), Ok(()));
    }
    assert_eq!(context.matrix_budget.left(), before - cost);

    context.matrix_budget = WorkBudget::matrices(cost - 1);
    let refused = context.affordable(&at());
    assert!(matches!(refused, Err(CoverFault::TooLarge { .. })));
}
