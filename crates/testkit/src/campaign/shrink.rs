//! Smaller instances that still disagree: fewer particles and variables, simpler numbers, the same
//! structure.

use super::engine::{Engine, Finding, judge};
use super::expected::Expected;
use super::family::Case;
use crate::families::Instance;
use mceip_exact::{Rational, Sparse, whole};
use mceip_model::{Body, ModelError, Pencil, Problem, System, Window};
use mceip_oracle::TwoParticles;
use mceip_paper::two_particles;
use num_traits::{One, Signed, Zero};

/// Instances tried for one disagreement, at most: each costs a run of the engines.
pub const MAX_TRIES: usize = 400;

/// Shrinks a case as long as `engines` still find a disagreement of this engine and kind, and
/// returns it with what it then says. What is known by construction goes with the first change of
/// the problem itself.
pub fn shrink(case: &Case, finding: &Finding, engines: &[Box<dyn Engine>]) -> (Case, Finding) {
    let (mut best, mut says) = (case.clone(), finding.clone());
    let mut tries = MAX_TRIES;
    let mut improved = true;

    while improved && tries > 0 {
        improved = false;
        for candidate in smaller(&best) {
            if tries == 0 {
                break;
            }

            tries -= 1;
            let again = judge(&candidate, engines)
                .findings
                .into_iter()
                .find(|f| f.kind() == says.kind());

            if let Some(again) = again {
                (best, says, improved) = (candidate, again, true);
                break;
            }
        }
    }

    (best, says)
}

/// Cases next to this one and smaller, the boldest first. Every one has fewer variables, or fewer
/// entries and features, or shorter numbers, so that shrinking ends.
pub fn smaller(case: &Case) -> Vec<Case> {
    let problem = &case.instance.problem;
    let mut out: Vec<Case> = case
        .instance
        .closed_form
        .iter()
        .flat_map(simpler_data)
        .filter_map(|d| with_data(case, d).ok())
        .collect();

    let bodies = match problem.body() {
        Body::Pencil(p) => pencils(p)
            .into_iter()
            .flatten()
            .map(Body::Pencil)
            .collect::<Vec<_>>(),
        Body::System(s) => systems(s).into_iter().flatten().map(Body::System).collect(),
    };

    let with = |body: Body, window: &Window| Problem::new(body, problem.unknown(), window.clone());
    out.extend(
        bodies
            .into_iter()
            .filter_map(|b| with(b, problem.window()).ok())
            .map(|p| changed(case, p)),
    );

    if *problem.window() != Window::all() {
        out.push(changed(case, problem.clone().with_window(Window::all())));
    }

    let size = size(case);

    // What drops nothing but the closed form is the same problem.
    out.retain(|c| self::size(c) < size && c.instance.problem != *problem);
    out
}

/// Order, entries and features, bits of all numbers.
fn size(case: &Case) -> (usize, usize, u64) {
    let problem = &case.instance.problem;
    let bits = |m: &Sparse| m.entries().map(|e| bits(e.2)).sum::<u64>();
    let windowed = usize::from(*problem.window() != Window::all());

    let data = case
        .instance
        .closed_form
        .iter()
        .flat_map(|d| [&d.c, &d.s, &d.k, &d.m, &d.mu])
        .map(self::bits)
        .sum::<u64>();

    match problem.body() {
        Body::Pencil(p) => (
            p.order(),
            p.a().entries().count() + p.b().entries().count() + windowed,
            bits(p.a()) + bits(p.b()) + data,
        ),
        Body::System(s) => {
            let mass = s.mass().map_or(0, |m| m.entries().count());
            let odd = |p: &mceip_model::Particle| {
                usize::from(p.frame.is_some()) + usize::from(p.normal_direction < 0)
            };

            let features = s.stiffness().entries().count()
                + mass
                + s.particles().iter().map(odd).sum::<usize>()
                + windowed;

            (
                s.dofs(),
                features,
                bits(s.stiffness())
                    + s.mass().map_or(0, bits)
                    + s.friction().map_or(0, self::bits)
                    + data,
            )
        }
    }
}

fn bits(v: &Rational) -> u64 {
    v.numer().bits() + v.denom().bits()
}

fn changed(case: &Case, problem: Problem) -> Case {
    let instance = Instance {
        problem,
        closed_form: None,
        ..case.instance.clone()
    };

    Case {
        id: case.id.clone(),
        instance,
        expected: Expected::default(),
    }
}

fn with_data(case: &Case, data: TwoParticles) -> Result<Case, ModelError> {
    let problem = Problem::new(
        Body::System(two_particles(&data)?),
        case.instance.problem.unknown(),
        Window::all(),
    )?;

    let instance = Instance {
        problem,
        closed_form: Some(data),
        ..case.instance.clone()
    };

    Ok(Case {
        id: case.id.clone(),
        instance,
        expected: Expected::default(),
    })
}

fn simpler_data(d: &TwoParticles) -> Vec<TwoParticles> {
    let (c, s) = (mceip_exact::rational(3, 5), mceip_exact::rational(4, 5));
    let mut out = vec![TwoParticles { c, s, ..d.clone() }];

    out.push(TwoParticles {
        k: Rational::one(),
        ..d.clone()
    });
    out.push(TwoParticles {
        m: Rational::one(),
        ..d.clone()
    });

    out.extend(
        simpler(&d.mu)
            .into_iter()
            .filter(Signed::is_positive)
            .map(|mu| TwoParticles { mu, ..d.clone() }),
    );

    out
}

/// 0 is left to the caller: 1 or -1, the integer part, half as many digits.
fn simpler(v: &Rational) -> Vec<Rational> {
    let part = |v: &Rational| v.trunc();
    let halved = {
        let shift = v.denom().bits() / 2;
        let scale = mceip_exact::Integer::one() << shift;
        Rational::new(
            (v * Rational::from_integer(scale.clone())).to_integer(),
            scale,
        )
    };

    let high = {
        let shift = v.numer().bits() / 2;
        Rational::from_integer((v.to_integer() >> shift) << shift)
    };

    [v.signum(), part(v), halved, high]
        .into_iter()
        .filter(|w| !w.is_zero() && bits(w) < bits(v))
        .collect()
}

type Tried<T> = Vec<Result<T, ModelError>>;

fn pencils(p: &Pencil) -> Tried<Pencil> {
    let n = p.order();
    let mut out: Tried<Pencil> = Vec::new();

    for drop in 0..n {
        let keep: Vec<usize> = (0..n).filter(|i| *i != drop).collect();
        let free = (0..keep.len())
            .filter(|&k| p.free().contains(&keep[k]))
            .collect();

        out.push(Pencil::new(
            p.a().submatrix(&keep, &keep),
            p.b().submatrix(&keep, &keep),
            free,
        ));
    }

    out.extend(
        changes(p.a(), false)
            .into_iter()
            .map(|a| Pencil::new(a, p.b().clone(), p.free().to_vec())),
    );

    out.extend(
        changes(p.b(), false)
            .into_iter()
            .map(|b| Pencil::new(p.a().clone(), b, p.free().to_vec())),
    );

    out
}

fn systems(s: &System) -> Tried<System> {
    let rebuild = |k: Sparse, m: Option<Sparse>, particles| {
        System::new(k, m, s.friction().cloned(), particles)
    };
    let mut out: Tried<System> = Vec::new();

    // A particle with its dofs, or a dof of no particle.
    let owned = |d: usize| {
        s.particles()
            .iter()
            .position(|p| p.tangential == d || p.normal == d)
    };

    let groups = (0..s.particles().len())
        .map(|k| vec![s.particles()[k].tangential, s.particles()[k].normal]);
    let lone = (0..s.dofs())
        .filter(|&d| owned(d).is_none())
        .map(|d| vec![d]);

    for group in groups.chain(lone) {
        let keep: Vec<usize> = (0..s.dofs()).filter(|d| !group.contains(d)).collect();
        let place = |d: usize| keep.iter().position(|k| *k == d);

        let particles = s.particles().iter().filter_map(|p| {
            let (tangential, normal) = (place(p.tangential)?, place(p.normal)?);
            Some(mceip_model::Particle {
                tangential,
                normal,
                ..p.clone()
            })
        });

        let cut = |m: &Sparse| m.submatrix(&keep, &keep);
        out.push(rebuild(
            cut(s.stiffness()),
            s.mass().map(cut),
            particles.collect(),
        ));
    }

    for k in 0..s.particles().len() {
        let with = |change: &dyn Fn(&mut mceip_model::Particle)| {
            let mut particles = s.particles().to_vec();
            change(&mut particles[k]);
            rebuild(s.stiffness().clone(), s.mass().cloned(), particles)
        };

        out.extend([
            with(&|p| p.frame = None),
            with(&|p| p.normal_direction = 1),
            with(&|p| p.reaction = None),
        ]);
    }

    for mu in s.friction().into_iter().flat_map(simpler) {
        out.push(System::new(
            s.stiffness().clone(),
            s.mass().cloned(),
            Some(mu),
            s.particles().to_vec(),
        ));
    }

    out.extend(
        changes(s.stiffness(), true)
            .into_iter()
            .map(|k| rebuild(k, s.mass().cloned(), s.particles().to_vec())),
    );

    if let Some(m) = s.mass() {
        out.extend(
            changes(m, true)
                .into_iter()
                .map(|m| rebuild(s.stiffness().clone(), Some(m), s.particles().to_vec())),
        );
    }

    out
}

/// The matrix with one entry (and its mirror image, if it is to stay symmetric) zero or
/// simpler, zeros first.
fn changes(m: &Sparse, symmetric: bool) -> Vec<Sparse> {
    let mut out = Vec::new();
    for (i, j, v) in m.entries().filter(|e| !symmetric || e.0 <= e.1) {
        for new in [whole(0)].into_iter().chain(simpler(v)) {
            let here = |r: usize, c: usize| (r, c) == (i, j) || (symmetric && (c, r) == (i, j));
            let entries = m
                .entries()
                .map(|(r, c, old)| (r, c, if here(r, c) { new.clone() } else { old.clone() }));

            out.push((
                Sparse::from_entries(m.rows(), m.cols(), entries),
                new.is_zero(),
            ));
        }
    }

    out.sort_by_key(|(_, zeroed)| !zeroed);
    out.into_iter().map(|(m, _)| m).collect()
}
