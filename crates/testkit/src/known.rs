//! Problems of any size whose complete answer is known in closed form, with the reason why.
//!
//! The answers are built from theorems, never by an enumerator: values by their polynomials, x by
//! formulas, cones by combinatorics. Only the isolation of the largest root uses `exact`.

use mceip_exact::{Algebraic, Poly, Rational, Sparse, nonnegative_roots, whole};
use mceip_model::{Body, ModelError, Pencil, Problem, Unknown, Window};
use mceip_oracle::{Cone, Enumeration, Solution};

/// A problem and its complete answer.
#[derive(Debug, Clone)]
pub struct Known {
    /// Family and size.
    pub name: String,
    /// The values in words.
    pub closed_form: &'static str,
    /// The problem, with all of [0, infinity) as its window.
    pub problem: Problem,
    /// The complete answer. `y` and the multiplicities of its solutions are left empty: they take
    /// no part in equality.
    pub expected: Enumeration,
}

/// Path with `n` vertices: (A - tI) x = y, A its adjacency matrix. Solutions are the connected
/// sub-paths; k vertices have t = 2 cos(pi / (k + 1)), x_j = U_(j-1)(t / 2) (Perron vector, the
/// only positive one).
///
/// # Errors
/// [`ModelError::Empty`] for n = 0.
pub fn path(n: usize) -> Result<Known, ModelError> {
    let parts = (1..=n)
        .flat_map(|k| (0..=n - k).map(move |start| Part::path((start..start + k).collect())))
        .collect();

    graph(
        format!("path {n}"),
        "2 cos(pi/(k+1)) for each sub-path of k vertices",
        n,
        &path_edges(n),
        parts,
    )
}

/// Cycle with `n` >= 3 vertices: its arcs of k < n vertices as for the path, and all of it with t =
/// 2.
///
/// # Errors
/// [`ModelError::Empty`] for n < 3.
pub fn cycle(n: usize) -> Result<Known, ModelError> {
    if n < 3 {
        return Err(ModelError::Empty {
            what: "cycle of fewer than three vertices",
        });
    }

    let arc = |start: usize, k: usize| Part::path((start..start + k).map(|i| i % n).collect());
    let mut parts: Vec<Part> = (1..n)
        .flat_map(|k| (0..n).map(move |start| arc(start, k)))
        .collect();
    parts.push(Part::constant((0..n).collect(), 2));

    let edges: Vec<_> = path_edges(n).into_iter().chain([(0, n - 1)]).collect();
    graph(
        format!("cycle {n}"),
        "2 cos(pi/(k+1)) for each arc of k < n vertices, 2 for the cycle",
        n,
        &edges,
        parts,
    )
}

/// Star with centre 0 and `leaves` leaves: each vertex alone with t = 0; the centre with k leaves:
/// t = sqrt k, x = (t; 1, ..., 1).
///
/// # Errors
/// None for sizes that fit in memory.
pub fn star(leaves: usize) -> Result<Known, ModelError> {
    let mut parts: Vec<Part> = (0..=leaves).map(|v| Part::constant(vec![v], 0)).collect();
    for set in subsets(leaves).into_iter().filter(|s| !s.is_empty()) {
        let k = set.len() as i64;
        let x = [Poly::from_ints(&[0, 1])]
            .into_iter()
            .chain(set.iter().map(|_| Poly::from_ints(&[1])))
            .collect();
        let vertices = [0].into_iter().chain(set.iter().map(|l| l + 1)).collect();

        parts.push(Part {
            vertices,
            polynomial: Poly::from_ints(&[-k, 0, 1]),
            x,
        });
    }

    let edges: Vec<_> = (1..=leaves).map(|l| (0, l)).collect();
    graph(
        format!("star {leaves}"),
        "sqrt k for the centre with k leaves, 0 for each vertex",
        leaves + 1,
        &edges,
        parts,
    )
}

/// Complete graph: every one of the 2^n - 1 supports, k vertices with t = k - 1, x = (1, ..., 1).
/// No cones.
///
/// # Errors
/// [`ModelError::Empty`] for n = 0.
pub fn complete_graph(n: usize) -> Result<Known, ModelError> {
    let parts = subsets(n).into_iter().filter(|s| !s.is_empty()).map(|s| {
        let value = s.len() as i64 - 1;
        Part::constant(s, value)
    });
    let parts = parts.collect();
    let edges: Vec<_> = (0..n).flat_map(|i| (0..i).map(move |j| (j, i))).collect();

    graph(
        format!("complete graph {n}"),
        "k - 1 for each set of k vertices",
        n,
        &edges,
        parts,
    )
}

/// tI - A with A the adjacency matrix of the path: an irreducible Z-matrix pencil, whose only
/// solution is all slip with the Perron root (every smaller support has a neighbour with y < 0).
///
/// # Errors
/// [`ModelError::Empty`] for n = 0.
pub fn z_matrix(n: usize) -> Result<Known, ModelError> {
    let entries = path_edges(n)
        .into_iter()
        .flat_map(|(i, j)| [(i, j, whole(-1)), (j, i, whole(-1))]);
    let pencil = Pencil::new(
        Sparse::from_entries(n, n, entries),
        Sparse::identity(n),
        vec![],
    )?;

    let part = Part::path((0..n).collect());
    let expected = answer(vec![part.solution(n, &[])], Vec::new(), n);
    known(
        format!("irreducible Z-matrix {n}"),
        "2 cos(pi/(n+1)), all slip",
        pencil,
        expected,
    )
}

/// tI - diag(d): e_i at each d_i >= 0; equal entries span a cone.
///
/// # Errors
/// [`ModelError::Empty`] without entries.
pub fn diagonal(d: &[Rational]) -> Result<Known, ModelError> {
    let n = d.len();
    let a = Sparse::from_entries(n, n, d.iter().enumerate().map(|(i, v)| (i, i, -v)));
    let pencil = Pencil::new(a, Sparse::identity(n), vec![])?;
    let others = |set: &[usize]| (0..n).filter(|i| !set.contains(i)).collect::<Vec<_>>();
    let listed = |i: usize| *d[i].numer() >= 0.into();
    let ray = |i: usize| unit(n, i, Algebraic::rational(d[i].clone()), others(&[i]));
    let group = |i: usize| (0..n).filter(|&j| d[j] == d[i]).collect::<Vec<_>>();
    let first_of_many = |i: &usize| listed(*i) && group(*i).len() > 1 && group(*i)[0] == *i;
    let cones = (0..n)
        .filter(first_of_many)
        .map(|i| cone(group(i).into_iter().map(ray).collect(), others(&group(i))));

    let expected = answer(
        (0..n).filter(|&i| listed(i)).map(ray).collect(),
        cones.collect(),
        n,
    );

    known(format!("diagonal {n}"), "the entries", pencil, expected)
}

/// (t - d) I + s N with N the shift x_i <- x_(i+1) and s = 1 or -1 (any other sign counts by its
/// sign): the only value is d >= 0. s = -1: only e_0. s = 1: every e_j, and every set without
/// neighbours a cone.
///
/// # Errors
/// [`ModelError::Empty`] for n = 0.
pub fn jordan(n: usize, d: u32, positive: bool) -> Result<Known, ModelError> {
    let s = whole(if positive { 1 } else { -1 });
    let diagonal = (0..n).map(|i| (i, i, whole(-i64::from(d))));
    let shift = (1..n).map(|i| (i - 1, i, s.clone()));

    let pencil = Pencil::new(
        Sparse::from_entries(n, n, diagonal.chain(shift)),
        Sparse::identity(n),
        vec![],
    )?;

    // y_i = s x_(i+1): zero for all but the predecessor of a positive entry.
    let biactive = |set: &[usize]| {
        (0..n)
            .filter(|i| !set.contains(i) && !set.contains(&(i + 1)))
            .collect::<Vec<_>>()
    };

    let ray = |j: usize| unit(n, j, Algebraic::rational(whole(d.into())), biactive(&[j]));
    if !positive {
        return known(
            format!("Jordan block {n}, -"),
            "d, e_0 alone",
            pencil,
            answer(vec![ray(0)], Vec::new(), n),
        );
    }

    let families = maximal_families(n, &|i, j| i.abs_diff(j) > 1);
    let cones = families
        .into_iter()
        .filter(|f| f.len() > 1)
        .map(|f| cone(f.iter().map(|&j| ray(j)).collect(), biactive(&f)));
    let expected = answer((0..n).map(ray).collect(), cones.collect(), n);

    known(format!("Jordan block {n}, +"), "d", pencil, expected)
}

/// A connected set of vertices with its Perron root (the largest root of `polynomial`) and vector.
struct Part {
    vertices: Vec<usize>,
    polynomial: Poly,
    x: Vec<Poly>,
}

impl Part {
    /// Vertices in the order of a path: characteristic polynomials by p_k = t p_(k-1) - p_(k-2).
    fn path(vertices: Vec<usize>) -> Part {
        let mut p = vec![Poly::from_ints(&[1]), Poly::from_ints(&[0, 1])];
        for k in 2..=vertices.len() {
            p.push(&p[k - 1].shift(1) - &p[k - 2]);
        }

        Part {
            polynomial: p[vertices.len()].clone(),
            x: p[..vertices.len()].to_vec(),
            vertices,
        }
    }

    /// An integer value with x = (1, ..., 1).
    fn constant(vertices: Vec<usize>, value: i64) -> Part {
        Part {
            polynomial: Poly::from_ints(&[-value, 1]),
            x: vec![Poly::from_ints(&[1]); vertices.len()],
            vertices,
        }
    }

    /// As a solution; `biactive` is known to the caller.
    fn solution(&self, n: usize, biactive: &[usize]) -> Solution {
        // The Perron root is >= 0 and the largest real root; every polynomial here has such a root.
        let value = nonnegative_roots(&self.polynomial)
            .pop()
            .unwrap_or_else(|| Algebraic::rational(Rational::default()));
        let mut x = vec![Poly::default(); n];

        self.vertices
            .iter()
            .zip(&self.x)
            .for_each(|(&v, p)| x[v] = p.clone());
        let mut slip = self.vertices.clone();
        slip.sort_unstable();

        Solution {
            value,
            multiplicity: 0,
            slip,
            biactive: biactive.to_vec(),
            x,
            y: Vec::new(),
        }
    }
}

fn path_edges(n: usize) -> Vec<(usize, usize)> {
    (1..n).map(|i| (i - 1, i)).collect()
}

/// (A - tI) x = y for a graph: Perron and Frobenius give each connected set one solution (y >= 0
/// off it because A >= 0), and sets that are not adjacent and share the root a cone.
fn graph(
    name: String,
    closed_form: &'static str,
    n: usize,
    edges: &[(usize, usize)],
    parts: Vec<Part>,
) -> Result<Known, ModelError> {
    let adjacency = edges
        .iter()
        .flat_map(|&(i, j)| [(i, j, whole(1)), (j, i, whole(1))]);
    let minus = Sparse::from_entries(n, n, (0..n).map(|i| (i, i, whole(-1))));
    let pencil = Pencil::new(Sparse::from_entries(n, n, adjacency), minus, vec![])?;
    let adjacent = |i: usize, j: usize| edges.contains(&(i, j)) || edges.contains(&(j, i));

    let untouched = |set: &[usize]| {
        (0..n)
            .filter(|i| !set.contains(i) && !set.iter().any(|&j| adjacent(*i, j)))
            .collect::<Vec<_>>()
    };

    let rays: Vec<Solution> = parts
        .iter()
        .map(|p| p.solution(n, &untouched(&p.vertices)))
        .collect();
    let mut cones = Vec::new();
    let mut polynomials: Vec<&Poly> = parts.iter().map(|p| &p.polynomial).collect();
    polynomials.sort_by_key(|p| p.coeffs().to_vec());
    polynomials.dedup();

    for polynomial in polynomials {
        let members: Vec<usize> = (0..parts.len())
            .filter(|&k| parts[k].polynomial == *polynomial)
            .collect();
        let apart = |k: usize, l: usize| {
            let (p, q) = (&parts[members[k]].vertices, &parts[members[l]].vertices);
            p.iter()
                .all(|&i| q.iter().all(|&j| i != j && !adjacent(i, j)))
        };

        for family in maximal_families(members.len(), &apart)
            .into_iter()
            .filter(|f| f.len() > 1)
        {
            let set: Vec<usize> = family
                .iter()
                .flat_map(|&k| parts[members[k]].vertices.clone())
                .collect();
            cones.push(cone(
                family.iter().map(|&k| rays[members[k]].clone()).collect(),
                untouched(&set),
            ));
        }
    }

    known(name, closed_form, pencil, answer(rays, cones, n))
}

/// All maximal sets of pairwise compatible members (Bron and Kerbosch 1973, without pivoting).
fn maximal_families(count: usize, compatible: &dyn Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    fn grow(
        chosen: &[usize],
        open: Vec<usize>,
        mut done: Vec<usize>,
        ok: &dyn Fn(usize, usize) -> bool,
        out: &mut Vec<Vec<usize>>,
    ) {
        if open.is_empty() && done.is_empty() {
            out.push(chosen.to_vec());
        }

        for (k, &v) in open.iter().enumerate() {
            let with = |list: &[usize]| {
                list.iter()
                    .copied()
                    .filter(|&u| ok(u, v))
                    .collect::<Vec<_>>()
            };

            grow(
                &[chosen, &[v]].concat(),
                with(&open[k + 1..]),
                with(&done),
                ok,
                out,
            );

            done.push(v);
        }
    }

    let mut out = Vec::new();
    grow(&[], (0..count).collect(), Vec::new(), compatible, &mut out);
    out
}

fn subsets(n: usize) -> Vec<Vec<usize>> {
    (0..1usize << n)
        .map(|m| (0..n).filter(|i| m >> i & 1 == 1).collect())
        .collect()
}

fn unit(n: usize, i: usize, value: Algebraic, biactive: Vec<usize>) -> Solution {
    let x = (0..n)
        .map(|j| Poly::from_ints(&[i64::from(i == j)]))
        .collect();

    Solution {
        value,
        multiplicity: 0,
        slip: vec![i],
        biactive,
        x,
        y: Vec::new(),
    }
}

/// The cone of linearly independent rays at one value.
fn cone(mut rays: Vec<Solution>, biactive: Vec<usize>) -> Cone {
    rays.sort_by(|a, b| a.slip.cmp(&b.slip));
    let mut slip: Vec<usize> = rays.iter().flat_map(|r| r.slip.clone()).collect();
    slip.sort_unstable();

    let value = rays.first().map_or_else(
        || Algebraic::rational(Rational::default()),
        |r| r.value.clone(),
    );

    Cone {
        value,
        slip,
        biactive,
        kernel_dimension: rays.len(),
        dimension: rays.len(),
        rays,
        lineality: Vec::new(),
    }
}

fn answer(solutions: Vec<Solution>, cones: Vec<Cone>, n: usize) -> Enumeration {
    let total = 1u64 << n;
    let parts = Enumeration {
        solutions,
        cones,
        supports_done: total,
        supports_total: total,
        ..Enumeration::default()
    };

    Enumeration::merge([parts]) // puts it into canonical order
}

fn known(
    name: String,
    closed_form: &'static str,
    pencil: Pencil,
    expected: Enumeration,
) -> Result<Known, ModelError> {
    let problem =
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())?.named(name.clone());
    Ok(Known {
        name,
        closed_form,
        problem,
        expected,
    })
}
