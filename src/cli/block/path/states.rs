//! What is proved of each state of the loading path: the complete MCEIP-mu set, the conditions
//! (17)-(20), and at chosen mu the complete MCEIP-lambda2 set, each solution with its mode.

use crate::cli::common::CliError;
use crate::picture::Mark;
use mceip_check::AcceptedClaim;
use mceip_engine::analysis::conditions::{Necessary, approximately};
use mceip_engine::reduction::{Variable, mu_family, reduce};
use mceip_engine::report::Table;
use mceip_engine::run::{Progress, Watch};
use mceip_engine::search::complete::{Completed, Options, complete};
use mceip_engine::search::levels::{Levels, mode};
use mceip_exact::{Rational, enclosing_decimals, to_f64};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_paper::Block;
use mceip_paper::path::{Contact, Interval, LoadingPath};
use serde_json::{Value, json};

/// What is asked of the states.
pub(super) struct Wanted<'a> {
    /// Check each MCEIP-mu set on K itself instead of the exactly condensed pencil.
    pub(super) uncondensed: bool,
    /// Conditions (19), (20).
    pub(super) conditions: bool,
    /// Coefficients of friction at which MCEIP-lambda2 is solved.
    pub(super) at: &'a [Rational],
    /// Modes over all degrees of freedom.
    pub(super) modes: bool,
}

/// A stretch and what was proved of it.
pub(super) struct State {
    pub(super) stretch: usize,
    pub(super) slip: usize,
    /// MCEIP-mu over [0, infinity).
    pub(super) thresholds: Set,
    pub(super) necessary: Option<Necessary>,
    /// MCEIP-lambda2 over [0, infinity), for each mu asked for.
    pub(super) growing: Vec<(Rational, Set)>,
}

/// A set of solutions with what stays open beside it.
pub(super) struct Set {
    pub(super) solutions: Vec<Mode>,
    pub(super) open: usize,
    pub(super) leaves: usize,
}

/// A certified solution.
pub(super) struct Mode {
    pub(super) claim: AcceptedClaim,
    pub(super) value: f64,
    /// Slip nodes that move, counted from 0 among the slip nodes.
    pub(super) moving: Vec<usize>,
    /// v over all degrees of freedom, if asked for.
    pub(super) displacement: Option<Vec<f64>>,
}

/// The states in which a node slips, until the work is cancelled.
pub(super) fn of(
    (block, contact, path): (&Block, &Contact, &LoadingPath),
    wanted: &Wanted<'_>,
    watch: &Watch<'_>,
) -> Result<Vec<State>, CliError> {
    let mut pencils = contact.pencils();
    let mut states = Vec::new();
    for (stretch, interval) in path.intervals.iter().enumerate() {
        let [_, left, right, _] = interval.counts();
        if left + right == 0 || watch.is_cancelled() {
            continue;
        }
        watch.report(&Progress::stage(&format!(
            "stretch {stretch}: all solutions"
        )));
        let thresholds = if wanted.uncondensed {
            on_the_whole(block, interval, None, wanted.modes, &watch.quiet())?
        } else {
            condensed(
                block,
                interval,
                pencils.of(&interval.states)?,
                wanted.modes,
                &watch.quiet(),
            )?
        };
        let mut state = State {
            stretch,
            slip: left + right,
            thresholds,
            necessary: None,
            growing: Vec::new(),
        };
        if wanted.conditions && !watch.is_cancelled() {
            watch.report(&Progress::stage(&format!(
                "stretch {stretch}: necessary condition"
            )));
            state.necessary = Some(Necessary::of(&mu_family(
                &block.system(&interval.states, None)?,
            )?)?);
        }
        for mu in wanted.at.iter().take_while(|_| !watch.is_cancelled()) {
            watch.report(&Progress::stage(&format!(
                "stretch {stretch}: growth rates at mu = {}",
                to_f64(mu)
            )));
            state.growing.push((
                mu.clone(),
                on_the_whole(block, interval, Some(mu), wanted.modes, &watch.quiet())?,
            ));
        }
        states.push(state);
    }
    Ok(states)
}

/// The set of the exactly condensed pencil, which is that of the state's problem. // E16
fn condensed(
    block: &Block,
    interval: &Interval,
    pencil: Pencil,
    modes: bool,
    watch: &Watch<'_>,
) -> Result<Set, CliError> {
    let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all())?;
    let found = complete(&problem, &Options::default(), watch)?;
    let level = if modes && found.solutions().next().is_some() {
        let levels = Levels::new(&block.system(&interval.states, None)?)?;
        let level = levels.at(0.0)?;
        Some((levels, level))
    } else {
        None
    };
    Ok(Set::of(&found, 0, |x| {
        level.as_ref().map(|(levels, level)| levels.mode(level, x))
    }))
}

/// The set of the state's problem as it is: MCEIP-mu, or MCEIP-lambda2 at a given mu.
fn on_the_whole(
    block: &Block,
    interval: &Interval,
    mu: Option<&Rational>,
    modes: bool,
    watch: &Watch<'_>,
) -> Result<Set, CliError> {
    let problem = interval.problem(block, mu.cloned())?;
    let found = complete(&problem, &Options::default(), watch)?;
    let reduced = reduce(&problem)?;
    let free = reduced
        .variables
        .iter()
        .filter(|v| matches!(v, Variable::Free { .. }))
        .count();
    Ok(Set::of(&found, free, |x| {
        modes.then(|| mode(&reduced.variables, x, block.stiffness.rows()))
    }))
}

impl Set {
    fn of(
        found: &Completed,
        free: usize,
        displacement: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Set {
        let mode = |(claim, x): (&AcceptedClaim, &[f64])| Mode {
            claim: claim.clone(),
            value: to_f64(&claim.value.mid()),
            moving: claim
                .support
                .iter()
                .filter_map(|i| i.checked_sub(free))
                .collect(),
            displacement: displacement(x),
        };
        Set {
            solutions: found.solutions().map(mode).collect(),
            open: found.cover.open.len() + found.cover.families.len(),
            leaves: found.cover.leaves,
        }
    }
}

impl State {
    /// mu from which on the necessary condition holds: the middle of its enclosure. `None` if not
    /// asked for, or if it never holds.
    pub(super) fn necessary_from(&self) -> Option<f64> {
        let necessary = self.necessary.as_ref()?;
        let ends = [Some(&necessary.stiffness), necessary.mass.as_ref()];
        ends.into_iter()
            .flatten()
            .filter_map(|u| u.end())
            .map(approximately)
            .min_by(f64::total_cmp)
    }

    /// The equation that says so: (20) for a mass matrix M* that does not depend on mu.
    pub(super) fn necessary_equation(&self) -> &'static str {
        if self.necessary.as_ref().is_some_and(|n| n.mass_is_constant) {
            "(20)"
        } else {
            "(19)"
        }
    }

    /// Do all slip nodes slip in this mode: does it satisfy (17)-(18)? // E17, E18
    pub(super) fn is_all_slip(&self, mode: &Mode) -> bool {
        mode.moving.len() == self.slip
    }

    /// Is anything left open?
    pub(super) fn is_open(&self) -> bool {
        self.thresholds.open > 0 || self.growing.iter().any(|(_, s)| s.open > 0)
    }

    /// The marks of a mode.
    pub(super) fn marks(&self, path: &LoadingPath, mode: &Mode) -> Vec<Mark> {
        Mark::of_mode(&path.intervals[self.stretch].states, &mode.moving)
    }
}

impl Mode {
    /// The value, enclosed to this many digits.
    pub(super) fn enclosure(&self, digits: usize) -> String {
        let (lo, hi) = enclosing_decimals(&self.claim.value, digits);
        if lo == hi {
            lo
        } else {
            format!("[{lo}, {hi}]")
        }
    }
}

/// The solutions of a set in words.
pub(super) fn values(set: &Set, name: &str, digits: usize) -> String {
    let one = |m: &Mode| {
        format!(
            "{name} in {}, {} slipping",
            m.enclosure(digits),
            m.moving.len()
        )
    };
    let all: Vec<String> = set.solutions.iter().map(one).collect();
    if all.is_empty() {
        "none".into()
    } else {
        all.join("; ")
    }
}

/// What is proved of a set.
pub(super) fn verdict(set: &Set) -> String {
    if set.open == 0 {
        "complete, proved".into()
    } else {
        format!("{} regions open", set.open)
    }
}

/// A table for people.
pub(super) fn text_of(states: &[State], path: &LoadingPath) -> String {
    let mut table = Table::new(&[
        "#",
        "nodes",
        "slip",
        "MCEIP-mu solutions in [0, infinity)",
        "leaves",
        "verdict",
        "necessary condition",
    ]);
    for s in states {
        let necessary = match (&s.necessary, s.necessary_from()) {
            (None, _) => "".into(),
            (_, None) => "never holds".into(),
            (_, Some(mu)) => format!("{} from mu = {mu:.9} on", s.necessary_equation()),
        };
        let set = &s.thresholds;
        let picture = path.intervals[s.stretch].picture();
        let row = [
            s.stretch.to_string(),
            picture,
            s.slip.to_string(),
            values(set, "mu", 10),
            set.leaves.to_string(),
            verdict(set),
            necessary,
        ];
        table.row(row.to_vec());
    }
    let mut out = format!("\n{table}\n");
    if states.iter().any(|s| !s.growing.is_empty()) {
        let mut table = Table::new(&[
            "#",
            "mu",
            "lambda^2 (1/s^2)",
            "growth rate lambda (1/s)",
            "slipping",
            "verdict",
        ]);
        for (s, mu, set) in states
            .iter()
            .flat_map(|s| s.growing.iter().map(move |(mu, set)| (s, mu, set)))
        {
            let (stretch, mu) = (s.stretch.to_string(), mu.to_string());
            if set.solutions.is_empty() {
                table.row(
                    [&stretch, &mu, "none", "", "", &verdict(set)]
                        .map(String::from)
                        .to_vec(),
                );
            }
            for m in &set.solutions {
                let (slipping, rate) = (
                    format!("{} of {}", m.moving.len(), s.slip),
                    format!("{:.6}", m.value.max(0.0).sqrt()),
                );
                table.row(vec![
                    stretch.clone(),
                    mu.clone(),
                    m.enclosure(10),
                    rate,
                    slipping,
                    verdict(set),
                ]);
            }
        }
        out += &format!("{table}\n");
    }
    out
}

/// The same for programs.
pub(super) fn json_of(states: &[State], path: &LoadingPath) -> Value {
    states.iter().map(|s| state_json(s, path)).collect()
}

fn state_json(s: &State, path: &LoadingPath) -> Value {
    let interval = &path.intervals[s.stretch];
    let motion = |e: &mceip_paper::path::Equilibrium| to_f64(e.motion());
    let all_slip = |set: &Set| set.solutions.iter().any(|m| s.is_all_slip(m));
    let growing = |(mu, set): &(Rational, Set)| {
        let solution = |m: &Mode| {
            let mut out = mode_json(s, m, "lambda2");
            out["growth_rate_per_s"] = json!(m.value.max(0.0).sqrt());
            out
        };
        json!({
            "mu": mu.to_string(),
            "solutions": set.solutions.iter().map(solution).collect::<Vec<_>>(),
            "complete": set.open == 0,
            "leaves": set.leaves,
            "all_slip": all_slip(set),
        })
    };
    let set = &s.thresholds;
    let mut out = json!({
        "stretch": s.stretch, "slip": s.slip, "nodes": interval.picture(),
        "from_mm": motion(&interval.start), "to_mm": interval.stop.as_ref().map(motion),
        "solutions": set.solutions.iter().map(|m| mode_json(s, m, "mu")).collect::<Vec<_>>(),
        "complete": set.open == 0, "leaves": set.leaves,
        "static_threshold": set.solutions.first().map(|m| m.value),
        "all_slip": all_slip(set), // (17)-(18) at lambda = 0 for some mu
        "lambda2": s.growing.iter().map(growing).collect::<Vec<_>>(),
    });
    if let Some(n) = &s.necessary {
        let end = |u: &mceip_engine::analysis::conditions::DefiniteUntil| {
            u.end().map(|e| [to_f64(e.lo()), to_f64(e.hi())])
        };
        out["necessary"] = json!({
            "equation": s.necessary_equation(),
            "holds_from": s.necessary_from(),
            "stiffness_definite_until": end(&n.stiffness),
            "mass_semidefinite_until": n.mass.as_ref().and_then(end),
        });
    }
    out
}

fn mode_json(s: &State, m: &Mode, name: &str) -> Value {
    let (lo, hi) = enclosing_decimals(&m.claim.value, 15);
    let mut out = json!({
        name: m.value,
        "enclosure": [lo, hi],
        "slipping": m.moving.len(),
        "moving": m.moving,
        "all_slip": s.is_all_slip(m),
    });
    if let Some(v) = &m.displacement {
        out["mode"] = json!(v);
    }
    out
}
