//! The elimination again, with polynomial matrices of rationals as the module's heading writes it,
//! on a pencil whose rows have different denominators and lengths; and hypotheses that hold or fail
//! by a hair.

use super::super::expanded::Expanded;
use super::*;
use crate::certificate::Tail;
use mceip_exact::{Sparse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};

/// Variables 0 and 2 are free, 1 and 3 slip.
const FREE: [usize; 2] = [0, 2];
const SLIP: [usize; 2] = [1, 3];

type Dense = [[Rational; 4]; 4];

/// A_ff = [[4, 2], [2, 5]] + I / 2, B_ff = [[1, 1], [1, 2]] + I / 3.
fn pencil() -> (Dense, Dense) {
    let a = [
        [rational(9, 2), rational(7, 3), whole(2), rational(-4, 5)],
        [rational(5, 11), whole(31), rational(-3, 11), whole(2)],
        [whole(2), rational(-1, 7), rational(11, 2), whole(3)],
        [rational(900, 13), whole(-77), whole(41), rational(1234, 13)],
    ];
    let b = [
        [rational(4, 3), rational(1, 2), whole(1), whole(0)],
        [whole(3), rational(2, 11), rational(-5, 11), whole(7)],
        [whole(1), whole(-2), rational(7, 3), rational(1, 7)],
        [whole(0), rational(3, 13), whole(6), whole(5)],
    ];
    (a, b)
}

/// [`pencil`] with the skew parts [[0, 3], [-3, 0]] and [[0, -5], [5, 0]] in A_ff and B_ff.
fn skew_pencil() -> (Dense, Dense) {
    let (mut a, mut b) = pencil();
    a[0][2] += whole(3);
    a[2][0] -= whole(3);
    b[0][2] -= whole(5);
    b[2][0] += whole(5);
    (a, b)
}

fn rows((a, b): &(Dense, Dense)) -> Rows {
    let sparse = |m: &Dense| {
        let entries = (0..4)
            .flat_map(|i| (0..4).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, m[i][j].clone()));
        Sparse::from_entries(4, 4, entries.collect::<Vec<_>>())
    };
    let pencil = Pencil::new(sparse(a), sparse(b), FREE.to_vec()).unwrap();
    Rows::of(&Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap())
}

fn integers(list: &[[i64; 2]]) -> Vec<IntegerRow> {
    list.iter()
        .map(|row| row.map(Integer::from).into_iter().collect())
        .collect()
}

fn matrix(exponent: u32, rows: [[i64; 2]; 2]) -> IntegerMatrix {
    IntegerMatrix {
        exponent,
        rows: integers(&rows).into(),
    }
}

/// W and V of up to three coefficients, any numbers: the identity holds for all.
fn anchor(right: usize, left: usize) -> Anchor {
    let w = [
        matrix(3, [[7, -9], [4, 13]]),
        matrix(5, [[-3, 8], [15, -6]]),
        matrix(4, [[2, 5], [-7, 1]]),
    ];
    let v = [
        matrix(2, [[5, 3], [-2, 6]]),
        matrix(4, [[9, -11], [1, 4]]),
        matrix(1, [[1, -1], [3, 2]]),
    ];
    Anchor {
        center: Number(rational(3, 4)),
        reversed: false,
        right: w[..right].to_vec(),
        left: v[..left].to_vec(),
    }
}

fn lower(rows: [&[i64]; 2], exponent: u32) -> Factor {
    Factor {
        first: vec![0, 0],
        rows: rows.map(|r| r.iter().map(|&v| v.into()).collect()).to_vec(),
        exponent,
    }
}

fn condensation(anchors: Vec<Anchor>) -> Condensation {
    Condensation {
        sigma: Number(rational(1, 2)),
        stiffness_factor: lower([&[4], &[2, 4]], 1),
        mass_sigma: Number(rational(1, 3)),
        mass_factor: Some(lower([&[4], &[4, 4]], 2)),
        anchors,
        tail: None,
    }
}

/// A matrix of polynomials in d, coefficient by coefficient.
type Poly = Vec<[[Rational; 2]; 2]>;

fn zero() -> [[Rational; 2]; 2] {
    Default::default()
}

fn block(p: &(Dense, Dense), rows: [usize; 2], cols: [usize; 2], center: &Rational) -> Poly {
    let (mut constant, mut slope) = (zero(), zero());
    for i in 0..2 {
        for j in 0..2 {
            let (a, b) = (&p.0[rows[i]][cols[j]], &p.1[rows[i]][cols[j]]);
            (constant[i][j], slope[i][j]) = (a + center * b, b.clone());
        }
    }
    vec![constant, slope]
}

fn transposed(p: &Poly) -> Poly {
    p.iter()
        .map(|m| {
            [
                [m[0][0].clone(), m[1][0].clone()],
                [m[0][1].clone(), m[1][1].clone()],
            ]
        })
        .collect()
}

fn true_values(list: &[IntegerMatrix]) -> Poly {
    let of = |m: &IntegerMatrix, i: usize, j: usize| {
        Rational::new(m.rows[i].at(j).into_owned(), Integer::one() << m.exponent)
    };
    list.iter()
        .map(|m| [[of(m, 0, 0), of(m, 0, 1)], [of(m, 1, 0), of(m, 1, 1)]])
        .collect()
}

/// a - b c
fn less(a: &Poly, b: &Poly, c: &Poly) -> Poly {
    let mut out = a.clone();
    out.resize(a.len().max(b.len() + c.len()), zero());
    for (k, b) in b.iter().enumerate() {
        for (m, c) in c.iter().enumerate() {
            for i in 0..2 {
                for j in 0..2 {
                    out[k + m][i][j] -= &b[i][0] * &c[0][j] + &b[i][1] * &c[1][j];
                }
            }
        }
    }
    out
}

fn rational_of(v: &Integer) -> Rational {
    Rational::from_integer(v.clone())
}

/// The norms of the columns of `p`, whose column j is multiplied by factor[j], rounded up to
/// units of 2^-32.
fn column_norms(p: &Poly, k: usize, factor: &[Rational; 2]) -> Vec<Integer> {
    let Some(m) = p.get(k) else {
        return vec![Integer::zero(); 2];
    };
    let of = |j: usize| {
        let square: Rational = (0..2).map(|f| &m[f][j] * &factor[j]).map(|v| &v * &v).sum();
        assert!(square.is_integer());
        let square = square.to_integer() << 64u32;
        let root = square.sqrt();
        if &root * &root == square {
            root
        } else {
            root + 1
        }
    };
    vec![of(0), of(1)]
}

fn check_expansion(p: &(Dense, Dense), anchor: &Anchor) {
    let rows = rows(p);
    let condensation = condensation(vec![anchor.clone()]);
    let anchors = of(PencilParts::exact(&[&rows]), &condensation).unwrap();
    let e: Expanded = anchors.expand(0).unwrap().remove(0);
    let center = &anchor.center.0;
    let (w, v) = (true_values(&anchor.right), true_values(&anchor.left));
    let [ff, fs, sf, ss] = [(FREE, FREE), (FREE, SLIP), (SLIP, FREE), (SLIP, SLIP)]
        .map(|(i, j)| block(p, i, j, center));
    let (r, l) = (
        less(&fs, &ff, &w),
        less(&transposed(&sf), &transposed(&ff), &v),
    );
    let mut high = r.clone();
    high.iter_mut().take(w.len()).for_each(|m| *m = zero());
    let z = less(&less(&ss, &sf, &w), &transposed(&v), &high);
    let factor = SLIP.map(|i| rational_of(&rows.factor[i]));
    let bits = SLIP.map(|i| rows.rows[i].iter().map(|(_, a, _)| a.bits()).max().unwrap());
    assert_ne!(bits[0], bits[1]);
    let row = |i: usize| &factor[i] / rational_of(&(Integer::one() << bits[i]));
    for k in 0..z.len().max(e.z.len()) {
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let expected = z.get(k).map_or_else(Rational::zero, |m| &m[i][j] * row(i));
            let got = e.z.get(k).map_or_else(Rational::zero, |m| {
                Rational::new(m[i][j].clone(), e.unit.clone())
            });
            assert_eq!(got, expected, "Z_{k}[{i}][{j}]");
        }
    }
    // |l|, |r| and |V| in their units.
    let exponent = |list: &[IntegerMatrix]| list.iter().map(|m| m.exponent).max().unwrap_or(0);
    let (e_w, e_v) = (exponent(&anchor.right), exponent(&anchor.left));
    let common = rational_of(
        &FREE
            .iter()
            .fold(Integer::one(), |c, &i| c.lcm(&rows.factor[i])),
    ) * rational_of(center.denom());
    let two = |e: u32| rational_of(&(Integer::one() << e));
    let units_r = [&common * two(e_w), &common * two(e_w)];
    let units_l = [0, 1].map(|i| &common * two(e_v) * &factor[i]);
    let units_v = [0, 1].map(|i| two(e_v) * &factor[i]);
    for k in 0..6 {
        let of = |list: &[Vec<Integer>]| {
            list.get(k)
                .cloned()
                .unwrap_or_else(|| vec![Integer::zero(); 2])
        };
        assert_eq!(of(&e.left), column_norms(&l, k, &units_l), "l_{k}");
        assert_eq!(of(&e.right), column_norms(&r, k, &units_r), "r_{k}");
        assert_eq!(of(&e.v), column_norms(&v, k, &units_v), "v_{k}");
        let rounding = if k < w.len() {
            column_norms(&r, k, &units_r)
        } else {
            vec![Integer::zero(); 2]
        };
        assert_eq!(of(&e.rounding), rounding, "rounding_{k}");
    }
    // Rows of the pencil are cut to [0, 1): l' F^-1 r <= |l||r| / sigma and V'r, out of their units
    // into those.
    for i in 0..2 {
        let cut = two(e_w + e_v) * rational_of(&(Integer::one() << bits[i])) * two(64);
        assert_eq!(
            e.weight[i],
            (rational(1, 2) * &common * &common * &cut).recip()
        );
        assert_eq!(e.rounding_weight[i], (&common * cut).recip());
    }
    assert_eq!((&e.center, &e.gain), (center, &rational(2, 3)));
    // The largest row or column of B_ff, over sigma.
    let slope = &ff[1];
    let sums = [(0, 1), (1, 0)].map(|(i, j)| {
        let row = slope[i][i].abs() + slope[i][j].abs();
        let column = slope[i][i].abs() + slope[j][i].abs();
        row.max(column)
    });
    assert_eq!(Some(e.drift), sums.into_iter().max().map(|s| s * whole(2)));
}

#[test]
fn the_expansion_is_that_of_the_identity() {
    for right in 0..=3 {
        for left in 0..=3 {
            check_expansion(&pencil(), &anchor(right, left));
            check_expansion(&skew_pencil(), &anchor(right, left));
        }
    }
}

/// Two anchors of two free and two slip variables, W and V of one coefficient each: 2^30 and 2^12
/// for each of 16 integers. An expansion takes 4 entries of two coefficients, each of 512 bits more
/// than the anchor's limit counts.
#[test]
fn expansions_spend_a_budget_of_memory() {
    let condensation = condensation(vec![anchor(1, 1), anchor(1, 1)]);
    let rows = rows(&pencil());
    let anchors = of(PencilParts::exact(&[&rows]), &condensation).unwrap();
    let before = anchors.memory.left();
    assert_eq!(before, (1 << 30) + (16 << 12));

    // Exponents 3 + 2, entries of 4 + 3 bits, a center of 2 + 3; the pencil and its free rows.
    let blocks = IntegralBlocks::of(&rows, &row_bits(&[&rows]));
    let bits = 5 + 7 + 5 + blocks.longest + blocks.common.bits();
    let cost = 4 * 2 * (512 + bits);
    assert!(anchors.expand(1).is_ok());
    assert_eq!(anchors.memory.left(), before - cost);

    let short = Anchors {
        memory: WorkBudget::matrices(cost - 1),
        ..of(PencilParts::exact(&[&rows]), &condensation).unwrap()
    };
    assert!(matches!(short.expand(0), Err(CoverFault::TooLarge { .. })));
    assert!(matches!(anchors.expand(2), Err(CoverFault::Anchor { .. })));
}

/// Expansions of more than eight coefficients, or longer exponents, are not multiplied out.
#[test]
fn degrees_and_exponents_have_a_limit() {
    let of = |count: usize, exponent: u32| {
        let list = (0..count)
            .map(|_| matrix(exponent, [[1, 0], [0, 1]]))
            .collect();
        super::of(
            PencilParts::exact(&[&rows(&pencil())]),
            &condensation(vec![Anchor {
                left: list,
                ..anchor(1, 0)
            }]),
        )
        .map(|_| ())
    };
    assert_eq!([of(8, 0), of(1, 4096)], [Ok(()), Ok(())]);
    assert_eq!(
        of(9, 0),
        Err(CoverFault::TooLarge {
            what: "degree",
            limit: 8,
            got: 9
        })
    );
    assert_eq!(
        of(1, 4097),
        Err(CoverFault::TooLarge {
            what: "exponent",
            limit: 4096,
            got: 4097
        })
    );
}

#[test]
fn blocks_are_definite_beyond_sigma_and_tau_only() {
    let verdict =
        |p: &(Dense, Dense), c: &Condensation| of(PencilParts::exact(&[&rows(p)]), c).map(|_| ());
    let c = condensation(vec![]);
    assert_eq!(verdict(&pencil(), &c), Ok(()));
    let hair = rational(1, 1000);
    for i in FREE {
        let (mut less_a, mut less_b, mut more) = (pencil(), pencil(), pencil());
        less_a.0[i][i] -= &hair;
        less_b.1[i][i] -= &hair;
        more.0[i][i] += &hair;
        more.1[i][i] += &hair;
        let fault = |expected, row| Err(CoverFault::Hypothesis { expected, row });
        let row = usize::from(i == 2);
        assert_eq!(
            verdict(&less_a, &c),
            fault("A_ff - sigma I positive semidefinite", row)
        );
        assert_eq!(
            verdict(&less_b, &c),
            fault("B_ff - mass_sigma I positive semidefinite", row)
        );
        assert_eq!(verdict(&more, &c), Ok(()));
    }
    let mut larger = condensation(vec![]);
    larger.sigma.0 += &hair;
    assert!(verdict(&pencil(), &larger).is_err());
    let mut larger = condensation(vec![]);
    larger.mass_sigma.0 += hair;
    assert!(verdict(&pencil(), &larger).is_err());
}

/// F is symmetric if A_ff and B_ff are; an entry that is there and zero needs no mirror image.
#[test]
fn a_free_block_that_is_not_symmetric_is_seen() {
    let one = || Integer::one();
    let with = |entry: Option<(i64, i64)>| {
        let mut first: Row = vec![(0, one(), one())];
        first.extend(entry.map(|(a, b)| (1, a.into(), b.into())));
        let rows = Rows {
            halves: vec![],
            rows: vec![first, vec![(1, one(), one())]],
            factor: vec![one(), one()],
            is_free: vec![true, true],
        };
        IntegralBlocks::of(&rows, &row_bits(&[&rows])).is_symmetric()
    };
    assert_eq!([with(None), with(Some((0, 0)))], [true, true]);
    assert_eq!(
        [with(Some((1, 0))), with(Some((0, 1))), with(Some((1, 1)))],
        [false, false, false]
    );
}

/// A skew part of the free block leaves its form as it is. One entry alone does not: a hair in A_ff
/// or B_ff is half a hair in the symmetric part, and the bounds are exact.
#[test]
fn the_symmetric_part_of_the_free_block_is_bounded() {
    let verdict =
        |p: &(Dense, Dense)| of(PencilParts::exact(&[&rows(p)]), &condensation(vec![])).map(|_| ());
    assert_eq!(verdict(&skew_pencil()), Ok(()));

    for (k, l) in [(0, 2), (2, 0)] {
        for (in_a, expected) in [
            (true, "A_ff - sigma I positive semidefinite"),
            (false, "B_ff - mass_sigma I positive semidefinite"),
        ] {
            let mut p = skew_pencil();
            let m = if in_a { &mut p.0 } else { &mut p.1 };
            m[k][l] += rational(1, 10);
            assert_eq!(
                verdict(&p),
                Err(CoverFault::Hypothesis { expected, row: 0 })
            );
        }
    }
}

/// A + 3/2 B = [[4, 2], [2, 5]] + c diag(1, 10/11), with a skew part; B = [[1, 1], [1, 2]] + d I,
/// likewise.
fn tail_rows(c: &Rational, d: &Rational) -> Rows {
    let mut b = [[whole(1), rational(1, 3)], [rational(5, 3), whole(2)]];
    let mut a = [[whole(4), rational(2, 7)], [rational(26, 7), whole(5)]];
    for i in 0..2 {
        b[i][i] += d;
        a[i][i] += c * if i == 0 { whole(1) } else { rational(10, 11) };
        for j in 0..2 {
            a[i][j] -= &b[i][j] * rational(3, 2);
        }
    }
    let sparse = |m: &[[Rational; 2]; 2]| {
        let entries = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| (i, j, m[i][j].clone()));
        Sparse::from_entries(2, 2, entries)
    };
    let pencil = Pencil::new(sparse(&a), sparse(&b), vec![0]).unwrap();
    Rows::of(&Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap())
}

#[test]
fn a_tail_begins_where_the_symmetric_part_is_definite() {
    let of = |c: Rational, d: Rational| {
        let claim = Tail {
            from: Number(rational(3, 2)),
            factor: lower([&[2], &[1, 2]], 0),
            mass_factor: Some(lower([&[2], &[2, 2]], 1)),
        };
        let rows = tail_rows(&c, &d);
        tail(
            &rows,
            None,
            &claim.from.0,
            &claim.factor,
            claim.mass_factor.as_ref(),
        )
    };
    let (hair, none) = (rational(1, 1000), whole(0));
    assert_eq!(
        [
            of(hair.clone(), none.clone()),
            of(hair.clone(), hair.clone())
        ],
        [Ok(()), Ok(())]
    );
    let fault = |expected| Err(CoverFault::Hypothesis { expected, row: 0 });
    assert_eq!(
        of(none.clone(), none.clone()),
        fault("sym(A + from B) positive definite")
    );
    assert_eq!(of(-&hair, none), fault("sym(A + from B) positive definite"));
    assert_eq!(
        of(hair.clone(), -hair),
        fault("sym(B) positive semidefinite")
    );
}

/// 2^20 entries of one coefficient: 512 bits of exponents, center, pencil and anchor together, and
/// none beyond.
#[test]
fn an_expansion_has_a_largest_size() {
    let blocks = |longest: u64| {
        let one = Integer::from(1); // of one bit
        IntegralBlocks {
            free: 1,
            slip: 1024,
            longest,
            common: one,
            of_t: LinearBlocks::default(),
            factor: vec![],
            bits: vec![],
        }
    };
    let anchor = Anchor {
        center: Number(rational(5, 2)),
        reversed: false,
        right: vec![],
        left: vec![],
    }; // 3 + 2 bits
    let size = |longest: u64, exponent: u32| {
        let polynomial = |exponent: u32, entry_bits: u64| MatrixPolynomial {
            coefficients: vec![],
            exponent,
            entry_bits,
        };
        let w = polynomial(exponent, 3);
        let v = polynomial(0, 1);
        blocks(longest).affordable(&anchor.center.0, &w, &v)
    };

    assert_eq!([size(500, 2), size(300, 202)], [Ok(512), Ok(512)]);
    let refused = CoverFault::TooLarge {
        what: "bits of an anchor's expansion",
        limit: 1 << 29,
        got: 513 << 20,
    };
    assert_eq!(
        [size(501, 2), size(500, 3)],
        [Err(refused.clone()), Err(refused)]
    );
}
