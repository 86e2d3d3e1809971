//! Problems of any size whose complete answer is known in closed form, with the reason why.
//!
//! The answers are built from theorems, never by an enumerator: values by their polynomials, x by
//! formulas, cones by combinatorics. Only the isolation of the largest root uses `exact`. A
//! solution with support J of (A - tI) x = y, A >= 0, is by Perron and Frobenius the largest
//! eigenvalue of the block A_JJ with its positive eigenvector.
//!
//! Input: a size. Output: a problem over [0, infinity) and its complete answer.
//! Called by the campaign's family `known`, the conformance pack and the tests of the enumerators.

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

impl Known {
    fn new(
        name: String,
        closed_form: &'static str,
        pencil: Pencil,
        expected: Enumeration,
    ) -> Result<Known, ModelError> {
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())?;
        Ok(Known {
            problem: problem.named(name.clone()),
            name,
            closed_form,
            expected,
        })
    }
}

/// Path with `n` vertices: (A - tI) x = y, A its adjacency matrix. Solutions are the connected
/// sub-paths; k vertices have t = 2 cos(pi / (k + 1)), x_j = U_(j-1)(t / 2) (Perron vector, the
/// only positive one).
///
/// # Errors
/// [`ModelError::Empty`] for n = 0.
pub fn path(n: usize) -> Result<Known, ModelError> {
    let mut parts = Vec::new();
    for length in 1..=n {
        for start in 0..=n - length {
            parts.push(Part::path((start..start + length).collect()));
        }
    }

    let graph = Graph {
        vertices: n,
        edges: path_edges(n),
    };
    graph.known(
        format!("path {n}"),
        "2 cos(pi/(k+1)) for each sub-path of k vertices",
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

    let mut parts = Vec::new();
    for length in 1..n {
        for start in 0..n {
            let arc = (start..start + length).map(|i| i % n);
            parts.push(Part::path(arc.collect()));
        }
    }
    parts.push(Part::constant((0..n).collect(), 2));

    let mut edges = path_edges(n);
    edges.push((0, n - 1));
    let graph = Graph { vertices: n, edges };
    graph.known(
        format!("cycle {n}"),
        "2 cos(pi/(k+1)) for each arc of k < n vertices, 2 for the cycle",
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
    for set in nonempty_subsets(leaves) {
        parts.push(Part::centre_with_leaves(&set));
    }

    let graph = Graph {
        vertices: leaves + 1,
        edges: (1..=leaves).map(|leaf| (0, leaf)).collect(),
    };
    graph.known(
        format!("star {leaves}"),
        "sqrt k for the centre with k leaves, 0 for each vertex",
        parts,
    )
}

/// Complete graph: every one of the 2^n - 1 supports, k vertices with t = k - 1, x = (1, ..., 1).
/// No cones.
///
/// # Errors
/// [`ModelError::Empty`] for n = 0.
pub fn complete_graph(n: usize) -> Result<Known, ModelError> {
    let mut parts = Vec::new();
    for set in nonempty_subsets(n) {
        let value = set.len() as i64 - 1;
        parts.push(Part::constant(set, value));
    }

    let mut edges = Vec::new();
    for i in 0..n {
        for j in 0..i {
            edges.push((j, i));
        }
    }

    let graph = Graph { vertices: n, edges };
    graph.known(
        format!("complete graph {n}"),
        "k - 1 for each set of k vertices",
        parts,
    )
}

/// tI - A with A the adjacency matrix of the path: an irreducible Z-matrix pencil, whose only
/// solution is all slip with the Perron root (every smaller support has a neighbour with y < 0).
///
/// # Errors
/// [`ModelError::Empty`] for n = 0.
pub fn z_matrix(n: usize) -> Result<Known, ModelError> {
    let pencil = z_matrix_pencil(n)?;
    let all_slip = Part::path((0..n).collect());
    let expected = answer(vec![all_slip.solution(n, &[])], Vec::new(), n);
    Known::new(
        format!("irreducible Z-matrix {n}"),
        "2 cos(pi/(n+1)), all slip",
        pencil,
        expected,
    )
}

/// The pencil of [`z_matrix`], of any order.
///
/// # Errors
/// [`ModelError::Empty`] for n = 0.
pub(crate) fn z_matrix_pencil(n: usize) -> Result<Pencil, ModelError> {
    let minus_adjacency = symmetric(n, &path_edges(n), -1);
    Pencil::new(minus_adjacency, Sparse::identity(n), vec![])
}

/// tI - diag(d): e_i at each d_i >= 0; equal entries span a cone.
///
/// # Errors
/// [`ModelError::Empty`] without entries.
pub fn diagonal(d: &[Rational]) -> Result<Known, ModelError> {
    let n = d.len();
    let minus_d = d.iter().enumerate().map(|(i, v)| (i, i, -v));
    let a = Sparse::from_entries(n, n, minus_d);
    let pencil = Pencil::new(a, Sparse::identity(n), vec![])?;

    let mut rays = Vec::new();
    let mut cones = Vec::new();
    for i in 0..n {
        let is_in_the_window = *d[i].numer() >= 0.into();
        if !is_in_the_window {
            continue;
        }
        rays.push(diagonal_ray(d, i));

        let equal: Vec<usize> = (0..n).filter(|&j| d[j] == d[i]).collect();
        let is_first = equal[0] == i;
        if equal.len() > 1 && is_first {
            let group = equal.iter().map(|&j| diagonal_ray(d, j)).collect();
            cones.push(cone(group, complement(n, &equal)));
        }
    }

    let expected = answer(rays, cones, n);
    Known::new(format!("diagonal {n}"), "the entries", pencil, expected)
}

/// The solution e_i at d_i of [`diagonal`]: y = 0, so all other indices are biactive.
fn diagonal_ray(d: &[Rational], i: usize) -> Solution {
    let value = Algebraic::rational(d[i].clone());
    unit_vector(d.len(), i, value, complement(d.len(), &[i]))
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
    let a = Sparse::from_entries(n, n, diagonal.chain(shift));
    let pencil = Pencil::new(a, Sparse::identity(n), vec![])?;

    if !positive {
        let only = jordan_ray(n, d, 0);
        return Known::new(
            format!("Jordan block {n}, -"),
            "d, e_0 alone",
            pencil,
            answer(vec![only], Vec::new(), n),
        );
    }

    let rays: Vec<Solution> = (0..n).map(|j| jordan_ray(n, d, j)).collect();
    let mut cones = Vec::new();
    for set in maximal_families(n, &|i, j| i.abs_diff(j) > 1) {
        if set.len() > 1 {
            let members = set.iter().map(|&j| rays[j].clone()).collect();
            cones.push(cone(members, jordan_biactive(n, &set)));
        }
    }

    let expected = answer(rays, cones, n);
    Known::new(format!("Jordan block {n}, +"), "d", pencil, expected)
}

/// The solution e_j at d of [`jordan`].
fn jordan_ray(n: usize, d: u32, j: usize) -> Solution {
    let value = Algebraic::rational(whole(d.into()));
    unit_vector(n, j, value, jordan_biactive(n, &[j]))
}

/// Biactive indices of a solution of [`jordan`] with this support: y_i = s x_(i+1) is zero for all
/// but the predecessors of positive entries.
fn jordan_biactive(n: usize, support: &[usize]) -> Vec<usize> {
    (0..n)
        .filter(|i| !support.contains(i) && !support.contains(&(i + 1)))
        .collect()
}

/// A connected set of vertices with its Perron root (the largest root of `polynomial`) and vector.
struct Part {
    vertices: Vec<usize>,
    polynomial: Poly,
    /// The components of the Perron vector at `vertices`, as polynomials in the root.
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

    /// The centre 0 of a star with k of its leaves (counted from 0): t^2 = k, x = (t; 1, ..., 1).
    fn centre_with_leaves(leaves: &[usize]) -> Part {
        let mut vertices = vec![0];
        let mut x = vec![Poly::from_ints(&[0, 1])];
        for leaf in leaves {
            vertices.push(leaf + 1);
            x.push(Poly::from_ints(&[1]));
        }

        Part {
            vertices,
            polynomial: Poly::from_ints(&[-(leaves.len() as i64), 0, 1]),
            x,
        }
    }

    /// As a solution; `biactive` is known to the caller.
    fn solution(&self, n: usize, biactive: &[usize]) -> Solution {
        // The Perron root is >= 0 and the largest real root; every polynomial here has such a root.
        let value = nonnegative_roots(&self.polynomial)
            .pop()
            .unwrap_or_else(|| Algebraic::rational(Rational::default()));

        let mut x = vec![Poly::default(); n];
        for (&vertex, component) in self.vertices.iter().zip(&self.x) {
            x[vertex] = component.clone();
        }

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

/// A graph without loops; each edge stands once, in either direction.
struct Graph {
    vertices: usize,
    edges: Vec<(usize, usize)>,
}

impl Graph {
    /// Is there an edge between the two vertices?
    fn is_edge(&self, i: usize, j: usize) -> bool {
        self.edges.contains(&(i, j)) || self.edges.contains(&(j, i))
    }

    /// Vertices outside the set that have no neighbour in it: there y = 0 for x on the set.
    fn untouched(&self, set: &[usize]) -> Vec<usize> {
        (0..self.vertices)
            .filter(|i| !set.contains(i) && !set.iter().any(|&j| self.is_edge(*i, j)))
            .collect()
    }

    /// Do the two sets have no vertex in common, and no edge between them?
    fn are_apart(&self, p: &[usize], q: &[usize]) -> bool {
        for &i in p {
            for &j in q {
                if i == j || self.is_edge(i, j) {
                    return false;
                }
            }
        }
        true
    }

    /// (A - tI) x = y with A the adjacency matrix and `parts` all connected sets of vertices.
    ///
    /// Perron and Frobenius give each connected set one solution (y >= 0 off it because A >= 0),
    /// and sets that are not adjacent and share the root a cone.
    fn known(
        &self,
        name: String,
        closed_form: &'static str,
        parts: Vec<Part>,
    ) -> Result<Known, ModelError> {
        let n = self.vertices;
        let minus = Sparse::from_entries(n, n, (0..n).map(|i| (i, i, whole(-1))));
        let pencil = Pencil::new(symmetric(n, &self.edges, 1), minus, vec![])?;

        let rays: Vec<Solution> = parts
            .iter()
            .map(|p| p.solution(n, &self.untouched(&p.vertices)))
            .collect();

        let mut polynomials: Vec<&Poly> = parts.iter().map(|p| &p.polynomial).collect();
        polynomials.sort_by_key(|p| p.coeffs().to_vec());
        polynomials.dedup();

        let mut cones = Vec::new();
        for polynomial in polynomials {
            let members: Vec<usize> = (0..parts.len())
                .filter(|&k| parts[k].polynomial == *polynomial)
                .collect();
            cones.extend(self.cones_of(&members, &parts, &rays));
        }

        Known::new(name, closed_form, pencil, answer(rays, cones, n))
    }

    /// The cones of the parts `members`, which share one root.
    fn cones_of(&self, members: &[usize], parts: &[Part], rays: &[Solution]) -> Vec<Cone> {
        let sets: Vec<&[usize]> = members.iter().map(|&k| &parts[k].vertices[..]).collect();
        let families = maximal_families(sets.len(), &|k, l| self.are_apart(sets[k], sets[l]));

        let mut out = Vec::new();
        for family in families {
            if family.len() < 2 {
                continue;
            }

            let set: Vec<usize> = family.iter().flat_map(|&k| sets[k].to_vec()).collect();
            let generators = family.iter().map(|&k| rays[members[k]].clone()).collect();
            out.push(cone(generators, self.untouched(&set)));
        }
        out
    }
}

/// The edges of the path 0, 1, ..., n - 1.
fn path_edges(n: usize) -> Vec<(usize, usize)> {
    (1..n).map(|i| (i - 1, i)).collect()
}

/// The symmetric matrix with `entry` at each edge.
fn symmetric(n: usize, edges: &[(usize, usize)], entry: i64) -> Sparse {
    let mut entries = Vec::new();
    for &(i, j) in edges {
        entries.push((i, j, whole(entry)));
        entries.push((j, i, whole(entry)));
    }
    Sparse::from_entries(n, n, entries)
}

/// All maximal sets of pairwise compatible members (Bron and Kerbosch 1973, without pivoting).
fn maximal_families(count: usize, compatible: &dyn Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut families = CliqueSearch {
        compatible,
        found: Vec::new(),
    };
    families.grow(&[], &(0..count).collect::<Vec<_>>(), Vec::new());
    families.found
}

/// The state of the algorithm of Bron and Kerbosch.
struct CliqueSearch<'a> {
    compatible: &'a dyn Fn(usize, usize) -> bool,
    found: Vec<Vec<usize>>,
}

impl CliqueSearch<'_> {
    /// Finds all maximal sets that hold `chosen`, members of `open`, and nothing else. `open` and
    /// `done` are compatible with all of `chosen`; sets with a member of `done` were found before.
    fn grow(&mut self, chosen: &[usize], open: &[usize], mut done: Vec<usize>) {
        if open.is_empty() && done.is_empty() {
            self.found.push(chosen.to_vec());
        }

        for (k, &member) in open.iter().enumerate() {
            let larger = [chosen, &[member]].concat();
            let still_open = self.compatible_with(member, &open[k + 1..]);
            let still_done = self.compatible_with(member, &done);
            self.grow(&larger, &still_open, still_done);

            done.push(member);
        }
    }

    /// The members of the list that are compatible with one.
    fn compatible_with(&self, member: usize, list: &[usize]) -> Vec<usize> {
        list.iter()
            .copied()
            .filter(|&other| (self.compatible)(other, member))
            .collect()
    }
}

/// The non-empty subsets of 0 to n - 1, in the order of their bit masks.
fn nonempty_subsets(n: usize) -> Vec<Vec<usize>> {
    (1..1usize << n)
        .map(|mask| (0..n).filter(|i| mask >> i & 1 == 1).collect())
        .collect()
}

/// The numbers 0 to n - 1 that are not in the set.
fn complement(n: usize, set: &[usize]) -> Vec<usize> {
    (0..n).filter(|i| !set.contains(i)).collect()
}

/// The solution x = e_i.
fn unit_vector(n: usize, i: usize, value: Algebraic, biactive: Vec<usize>) -> Solution {
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

/// The complete answer of a problem of order n without free variables, in canonical order.
fn answer(solutions: Vec<Solution>, cones: Vec<Cone>, n: usize) -> Enumeration {
    let total = 1u64 << n;
    let answer = Enumeration {
        solutions,
        cones,
        supports_done: total,
        supports_total: total,
        ..Enumeration::default()
    };

    // Merging puts it into canonical order.
    Enumeration::merge([answer])
}
