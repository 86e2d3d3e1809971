//! What is proved of each state of the loading path: the complete MCEIP-mu set, the conditions
//! (17)-(20), and at chosen mu the complete MCEIP-lambda2 set, each solution with its mode.
//!
//! Each stretch of the path with slip gives one contact state. Its MCEIP-mu set is searched on the
//! pencil condensed exactly to the contact nodes, or on request on K itself. The checker has
//! accepted the certificate of every set that is called proved.

use crate::LoadPath;
use crate::cli::common::CliError;
use crate::say::cover::{family_size, family_values};
use mceip_check::{AcceptedClaim, SolutionFamily};
use mceip_engine::analysis::conditions::{DefiniteUntil, Necessary};
use mceip_engine::reduction::{SparseCondensation, mode};
use mceip_engine::report::{Table, counted, six_digits};
use mceip_engine::run::{Progress, Watch};
use mceip_engine::search::complete::continua::joined;
use mceip_engine::search::complete::{CompleteOptions, Completed, complete};
use mceip_exact::{
    Interval, Rational, enclosing_decimals, enclosing_doubles, to_f64, upper_decimal,
};
use mceip_model::reduction::{mu_family, reduce};
use mceip_model::{Body, ContactState, Pencil, Problem, ReducedVariable, System, Unknown, Window};
use mceip_path::{Equilibrium, LoadingPath, Pencils, Stretch};
use serde_json::{Value, json};

/// What is asked of the states.
pub(super) struct Wanted<'a> {
    /// Check each MCEIP-mu set on K itself instead of the exactly condensed pencil.
    pub(super) uncondensed: bool,
    /// Conditions (19), (20).
    pub(super) conditions: bool,
    /// Coefficients of friction at which MCEIP-lambda2 is solved.
    pub(super) at_mu: &'a [Rational],
    /// Modes over all degrees of freedom.
    pub(super) modes: bool,
}

/// A stretch and what was proved of its contact state.
pub(super) struct ProvedState {
    /// Number of the stretch on the path.
    pub(super) stretch: usize,
    /// Number of nodes in impending slip.
    pub(super) slip: usize,
    /// MCEIP-mu over [0, infinity).
    pub(super) thresholds: ProvedSet,
    /// Is a candidate in contact without reaction?
    has_zero: bool,
    /// The necessary condition, if asked for.
    pub(super) necessary: Option<Necessary>,
    /// MCEIP-lambda2 over [0, infinity), for each mu asked for.
    pub(super) growing: Vec<Growing>,
}

/// Where the necessary condition (19) or (20) holds.
pub(super) enum Holds {
    /// From mu = 0 on.
    Always,
    /// From this mu on.
    From {
        /// Below this mu it does not hold.
        not_below: Rational,
        mu: Rational,
    },
    /// For no mu.
    Never,
}

/// MCEIP-lambda2 at a coefficient of friction.
pub(super) struct Growing {
    pub(super) mu: Rational,
    pub(super) set: ProvedSet,
}

/// A set of solutions with what stays open beside it.
pub(super) struct ProvedSet {
    pub(super) solutions: Vec<ProvedMode>,
    /// Solutions that no list holds.
    pub(super) families: Vec<ProvedFamily>,
    /// Number of open regions.
    pub(super) open: usize,
    pub(super) leaves: usize,
}

/// Solutions of one support, at one value or at an interval of values.
pub(super) struct ProvedFamily {
    family: SolutionFamily,
    /// Slip nodes that move.
    slipping: usize,
}

/// A certified solution.
pub(super) struct ProvedMode {
    pub(super) claim: AcceptedClaim,
    /// mu, or lambda^2 in 1/s^2.
    pub(super) value: f64,
    /// Slip nodes that move, counted from 0 among the slip nodes.
    pub(super) moving: Vec<usize>,
    /// v over all degrees of freedom, if asked for.
    pub(super) displacement: Option<Vec<f64>>,
}

/// What is known of the states of a path.
pub(super) struct ExaminedStates {
    /// Those in which a node slips.
    pub(super) proved: Vec<ProvedState>,
    /// Stretches whose state is refused, and why.
    pub(super) refused: Vec<(usize, String)>,
}

/// The states in which a node slips, until the work is cancelled. A state that is refused takes no
/// other along.
pub(super) fn of(followed: &LoadPath, wanted: &Wanted<'_>, watch: &Watch<'_>) -> ExaminedStates {
    let mut pencils = followed.contact().pencils();
    let mut proved = Vec::new();
    let mut refused = Vec::new();
    for (stretch, interval) in followed.as_path().stretches.iter().enumerate() {
        let states = interval.equilibrium_states();
        if watch.is_cancelled() || !states.iter().any(is_slip) {
            continue;
        }

        match examined(followed, stretch, wanted, &mut pencils, watch) {
            Ok(state) => proved.push(state),
            Err(why) => refused.push((stretch, why.to_string())),
        }
    }

    ExaminedStates { proved, refused }
}

/// What is proved of the state of a stretch.
fn examined(
    followed: &LoadPath,
    stretch: usize,
    wanted: &Wanted<'_>,
    pencils: &mut Pencils<'_>,
    watch: &Watch<'_>,
) -> Result<ProvedState, CliError> {
    let body = followed.loads().body().system();
    let states = followed.as_path().stretches[stretch].equilibrium_states();

    say(watch, stretch, "all solutions");
    // The condensed pencil of candidates without reaction is not one of MCEIP-mu.
    let has_zero = states.contains(&ContactState::Zero);
    let thresholds = if wanted.uncondensed || has_zero {
        uncondensed_set(body, states, None, wanted.modes, &watch.quiet())?
    } else {
        let pencil = pencils.of(states)?;
        condensed_set(body, states, pencil, wanted.modes, &watch.quiet())?
    };

    let mut state = ProvedState {
        stretch,
        slip: states.iter().filter(|state| is_slip(state)).count(),
        has_zero,
        thresholds,
        necessary: None,
        growing: Vec::new(),
    };

    if wanted.conditions && !watch.is_cancelled() {
        say(watch, stretch, "necessary condition");
        // Z.4: with the candidates without reaction free.
        let system = body.with_states(states, None)?.with_zero_free();
        state.necessary = Some(Necessary::of(&mu_family(&system)?)?);
    }

    for mu in wanted.at_mu {
        if watch.is_cancelled() {
            break;
        }

        let what = format!("growth rates at mu = {}", to_f64(mu));
        say(watch, stretch, &what);
        let set = uncondensed_set(body, states, Some(mu), wanted.modes, &watch.quiet())?;
        let mu = mu.clone();
        state.growing.push(Growing { mu, set });
    }

    Ok(state)
}

/// Is it impending slip?
pub(super) fn is_slip(state: &ContactState) -> bool {
    matches!(state, ContactState::Slip { .. })
}

fn say(watch: &Watch<'_>, stretch: usize, what: &str) {
    let text = format!("stretch {stretch}: {what}");
    watch.report(&Progress::stage(&text));
}

/// The MCEIP-mu set of the exactly condensed pencil, which is that of the state's problem. // (16)
fn condensed_set(
    body: &System,
    states: &[ContactState],
    pencil: Pencil,
    with_modes: bool,
    watch: &Watch<'_>,
) -> Result<ProvedSet, CliError> {
    let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all())?;
    let found = complete(&problem, &CompleteOptions::default(), watch)?;
    let mut set = ProvedSet::of(&found, 0..states.len());

    if with_modes && !set.solutions.is_empty() {
        let condensation = SparseCondensation::of_system(&body.with_states(states, None)?)?;
        let at_rest = condensation.at(0.0)?;
        for (solution, (_, x)) in set.solutions.iter_mut().zip(found.solutions()) {
            solution.displacement = Some(at_rest.lift(x));
        }
    }

    Ok(set)
}

/// The set of the state's problem as it is: MCEIP-mu, or MCEIP-lambda2 at a given mu.
fn uncondensed_set(
    body: &System,
    states: &[ContactState],
    mu: Option<&Rational>,
    with_modes: bool,
    watch: &Watch<'_>,
) -> Result<ProvedSet, CliError> {
    let unknown = if mu.is_some() {
        Unknown::Lambda2
    } else {
        Unknown::Mu
    };
    let system = body.with_states(states, mu.cloned())?;
    let problem = Problem::new(Body::System(system), unknown, Window::all())?;
    let found = complete(&problem, &CompleteOptions::default(), watch)?;

    let variables = reduce(&problem)?.variables;
    let free = variables
        .iter()
        .filter(|v| matches!(v, ReducedVariable::Free { .. }))
        .count();
    let slip = states.iter().filter(|state| is_slip(state)).count();
    let mut set = ProvedSet::of(&found, free..free + slip);

    if with_modes {
        let dofs = body.dofs();
        for (solution, (_, x)) in set.solutions.iter_mut().zip(found.solutions()) {
            solution.displacement = Some(mode(&variables, x, dofs));
        }
    }

    Ok(set)
}

/// Solutions, and families, of a state that a line of a table lists; those of a report.
const IN_A_LINE: usize = 3;
pub(super) const IN_A_REPORT: usize = 20;

impl ProvedSet {
    /// The set that a search has found, without displacements. `slip` are the variables of the slip
    /// nodes: behind those that are free, before those of candidates without reaction.
    fn of(found: &Completed, slip: std::ops::Range<usize>) -> ProvedSet {
        let mut solutions = Vec::new();
        for (claim, _) in found.solutions() {
            let moving = claim.support.iter().filter(|i| slip.contains(i));
            solutions.push(ProvedMode {
                claim: claim.clone(),
                value: to_f64(&claim.value.mid()),
                moving: moving.map(|i| i - slip.start).collect(),
                displacement: None,
            });
        }

        let families = joined(&found.cover.families).into_iter();
        let families = families.map(|family| ProvedFamily {
            slipping: family.support.iter().filter(|i| slip.contains(i)).count(),
            family,
        });

        ProvedSet {
            solutions,
            families: families.collect(),
            open: found.cover.open.len(),
            leaves: found.cover.leaves,
        }
    }

    /// So many of the solutions in words, each enclosed to this many digits.
    pub(super) fn values(&self, name: &str, digits: usize, listed: usize) -> String {
        if self.is_empty() {
            return "none".into();
        }

        let mut all = Vec::new();
        for solution in self.solutions.iter().take(listed) {
            let enclosure = solution.enclosure(digits);
            let slipping = solution.moving.len();
            all.push(format!("{name} in {enclosure}, {slipping} slipping"));
        }
        let more = self.solutions.len().saturating_sub(listed);
        if more > 0 {
            all.push(format!("{more} more (--json lists them)"));
        }
        if !self.families.is_empty() {
            all.push(self.families_text(name, listed));
        }

        all.join("; ")
    }

    /// So many of the families in words.
    pub(super) fn families_text(&self, name: &str, listed: usize) -> String {
        let mut all = Vec::new();
        for ProvedFamily { family, slipping } in self.families.iter().take(listed) {
            let values = family_values(name, family);
            let size = family_size(family);
            all.push(format!("{values}, {slipping} slipping, {size}"));
        }
        let more = self.families.len().saturating_sub(listed);
        if more > 0 {
            all.push(counted(more, "more family"));
        }

        all.join("; ")
    }

    /// Is no solution proved?
    pub(super) fn is_empty(&self) -> bool {
        self.solutions.is_empty() && self.families.is_empty()
    }

    /// The smallest value of a solution, or what it is not below.
    fn smallest(&self) -> Option<f64> {
        let least = |from: &Option<Interval>| from.as_ref().map_or(0.0, |from| to_f64(from.lo()));
        let families = self.families.iter().map(|f| least(&f.family.from));
        let values = self.solutions.iter().map(|mode| mode.value);
        values.chain(families).min_by(f64::total_cmp)
    }

    /// What is proved of it.
    pub(super) fn verdict(&self) -> String {
        if self.open == 0 {
            "complete, proved".into()
        } else {
            format!("{} open", counted(self.open, "region"))
        }
    }
}

impl ProvedState {
    /// Where the necessary condition holds; `None` if not asked for.
    pub(super) fn necessary_holds(&self) -> Option<Holds> {
        let necessary = self.necessary.as_ref()?;
        let matrices = [Some(&necessary.stiffness), necessary.mass.as_ref()];
        let matrices = matrices.into_iter().flatten();
        let is_at_zero = |until: &&DefiniteUntil| matches!(until, DefiniteUntil::NotAtZero(_));
        if matrices.clone().any(|until| is_at_zero(&until)) {
            return Some(Holds::Always);
        }

        let ends: Vec<&Interval> = matrices.filter_map(DefiniteUntil::end).collect();
        let lowest = ends.iter().map(|end| end.lo()).min();
        let first = ends.iter().map(|end| end.hi()).min();
        Some(match lowest.zip(first) {
            Some((lo, hi)) => Holds::From {
                not_below: lo.clone(),
                mu: hi.clone(),
            },
            None => Holds::Never,
        })
    }

    /// mu > 0 from which on the necessary condition holds.
    pub(super) fn necessary_from(&self) -> Option<f64> {
        match self.necessary_holds()? {
            Holds::From { mu, .. } => Some(enclosing_doubles(&Interval::point(mu))[1]),
            Holds::Always | Holds::Never => None,
        }
    }

    /// The equation that says so: (20) for a mass matrix M* that does not depend on mu, with z
    /// where candidates without reaction are free in it.
    pub(super) fn necessary_equation(&self) -> &'static str {
        let is_constant = |necessary: &Necessary| necessary.mass_is_constant;
        match (
            self.necessary.as_ref().is_some_and(is_constant),
            self.has_zero,
        ) {
            (true, false) => "(20)",
            (true, true) => "(20z)",
            (false, false) => "(19)",
            (false, true) => "(19z)",
        }
    }

    /// From which mu on the necessary condition holds, in words.
    fn necessary_text(&self) -> String {
        let equation = self.necessary_equation();
        match self.necessary_holds() {
            None => String::new(),
            Some(Holds::Always) => format!("{equation} at mu = 0"),
            Some(Holds::Never) => "never holds".into(),
            Some(Holds::From { mu, .. }) => {
                let from = upper_decimal(&mu, 9);
                format!("{equation} from mu = {from} on")
            }
        }
    }

    /// Do all slip nodes slip in this mode: does it satisfy (17)-(18)?
    pub(super) fn is_all_slip(&self, mode: &ProvedMode) -> bool {
        mode.moving.len() == self.slip
    }

    /// Does a solution of this set, one of the state's, satisfy (17)-(18)? `None` where that is not
    /// known.
    pub(super) fn has_all_slip(&self, set: &ProvedSet) -> Option<bool> {
        let has_one = set.solutions.iter().any(|mode| self.is_all_slip(mode))
            || set.families.iter().any(|f| f.slipping == self.slip);
        (has_one || set.open == 0).then_some(has_one)
    }

    /// Is anything left open?
    pub(super) fn is_open(&self) -> bool {
        self.thresholds.open > 0 || self.growing.iter().any(|g| g.set.open > 0)
    }
}

impl ExaminedStates {
    /// Is anything left open, or refused?
    pub(super) fn are_open(&self) -> bool {
        !self.refused.is_empty() || self.proved.iter().any(ProvedState::is_open)
    }

    /// The stretches that are refused, for programs.
    pub(super) fn refused_json(&self) -> Vec<Value> {
        let refused = self.refused.iter();
        let refused = refused.map(|(stretch, why)| json!({ "stretch": stretch, "why": why }));
        refused.collect()
    }
}

impl ProvedMode {
    /// The value, enclosed to this many digits.
    pub(super) fn enclosure(&self, digits: usize) -> String {
        let (lo, hi) = enclosing_decimals(&self.claim.value, digits);
        if lo == hi {
            lo
        } else {
            format!("[{lo}, {hi}]")
        }
    }

    /// lambda, 1/s, of a solution of MCEIP-lambda2.
    pub(super) fn growth_rate(&self) -> f64 {
        self.value.max(0.0).sqrt()
    }
}

/// What the table of thresholds says, and what it does not.
const AT_ZERO: &str = "These are the mu at which divergence begins at lambda = 0, contact states \
    held. With lambda^2 > 0 it may begin at a lower mu: --analyze tells from which on.";

/// The answers as tables for people.
pub(super) fn text_of(examined: &ExaminedStates, path: &LoadingPath) -> String {
    let mut stretches = path.stretches.iter();
    if !stretches.any(|stretch| stretch.equilibrium_states().iter().any(is_slip)) {
        return "\nno candidate is in impending slip: no state to examine\n".into();
    }

    let states = &examined.proved;
    let mut out = String::from("\n");
    if !states.is_empty() {
        out += &format!("{}\n{AT_ZERO}\n\n", thresholds_table(states, path));
    }
    if states.iter().any(|state| !state.growing.is_empty()) {
        out += &format!("{}\n", growing_table(states));
    }
    for refused in &examined.refused {
        out += &format!("{}\n", refused_text(refused));
    }

    out
}

/// That the state of a stretch is refused, and why.
pub(super) fn refused_text((stretch, why): &(usize, String)) -> String {
    format!("NOT EXAMINED: the state of stretch {stretch}: {why}")
}

fn thresholds_table(states: &[ProvedState], path: &LoadingPath) -> Table {
    let mut table = Table::new(&[
        "#",
        "nodes",
        "slip",
        "MCEIP-mu solutions in [0, infinity)",
        "leaves",
        "verdict",
        "necessary condition",
    ]);
    for state in states {
        let set = &state.thresholds;
        table.row(vec![
            state.stretch.to_string(),
            path.stretches[state.stretch].picture(),
            state.slip.to_string(),
            set.values("mu", 10, IN_A_LINE),
            set.leaves.to_string(),
            set.verdict(),
            state.necessary_text(),
        ]);
    }

    table
}

fn growing_table(states: &[ProvedState]) -> Table {
    let mut table = Table::new(&[
        "#",
        "mu",
        "lambda^2 (1/s^2)",
        "growth rate lambda (1/s)",
        "slipping",
        "verdict",
    ]);
    for state in states {
        for growing in &state.growing {
            let stretch = state.stretch.to_string();
            let mu = growing.mu.to_string();
            let verdict = growing.set.verdict();

            for solution in &growing.set.solutions {
                table.row(vec![
                    stretch.clone(),
                    mu.clone(),
                    solution.enclosure(10),
                    six_digits(solution.growth_rate()),
                    format!("{} of {}", solution.moving.len(), state.slip),
                    verdict.clone(),
                ]);
            }

            for ProvedFamily { family, slipping } in &growing.set.families {
                let values = family_values("lambda^2", family);
                let slipping = format!("{slipping} of {}", state.slip);
                let size = family_size(family).into();
                let row = [
                    stretch.clone(),
                    mu.clone(),
                    values,
                    size,
                    slipping,
                    verdict.clone(),
                ];
                table.row(row.to_vec());
            }
            if growing.set.is_empty() {
                let none = "none".into();
                table.row(vec![stretch, mu, none, "".into(), "".into(), verdict]);
            }
        }
    }

    table
}

/// The answers for programs. `places` are the dofs of the system that those of the file are: modes
/// are over those of the file.
pub(super) fn json_of(
    states: &[ProvedState],
    path: &LoadingPath,
    places: &[Option<usize>],
) -> Value {
    let mut out = Vec::new();
    for state in states {
        out.push(state.json(&path.stretches[state.stretch], places));
    }

    Value::Array(out)
}

impl ProvedState {
    fn json(&self, stretch: &Stretch, places: &[Option<usize>]) -> Value {
        let set = &self.thresholds;
        let solutions = set.solutions.iter();
        let solutions: Vec<Value> = solutions
            .map(|mode| self.mode_json(mode, "mu", places))
            .collect();
        let growing = self.growing.iter();
        let growing: Vec<Value> = growing.map(|g| self.growing_json(g, places)).collect();

        let mut out = json!({
            "stretch": self.stretch,
            "slip": self.slip,
            "nodes": stretch.picture(),
            "from": amount(&stretch.start),
            "to": stretch.stop.as_ref().map(amount),
            "solutions": solutions,
            "complete": set.open == 0,
            "leaves": set.leaves,
            "families": families_json(set, "mu"),
            "static_threshold": set.smallest(),
            "all_slip": self.has_all_slip(set), // (17)-(18) at lambda = 0 for some mu
            "lambda2": growing,
        });
        if let Some(necessary) = &self.necessary {
            out["necessary"] = json!({
                "equation": self.necessary_equation(),
                "holds_at_zero": matches!(necessary.stiffness, DefiniteUntil::NotAtZero(_)),
                "holds_from": self.necessary_from(),
                "stiffness_definite_until": end_json(&necessary.stiffness),
                "mass_semidefinite_until": necessary.mass.as_ref().and_then(end_json),
            });
        }

        out
    }

    fn growing_json(&self, growing: &Growing, places: &[Option<usize>]) -> Value {
        let mut solutions = Vec::new();
        for solution in &growing.set.solutions {
            let mut out = self.mode_json(solution, "lambda2", places);
            out["growth_rate_per_s"] = json!(solution.growth_rate());
            solutions.push(out);
        }

        json!({
            "mu": growing.mu.to_string(),
            "solutions": solutions,
            "families": families_json(&growing.set, "lambda2"),
            "complete": growing.set.open == 0,
            "leaves": growing.set.leaves,
            "all_slip": self.has_all_slip(&growing.set),
        })
    }

    /// A solution; `name` is that of its value.
    fn mode_json(&self, mode: &ProvedMode, name: &str, places: &[Option<usize>]) -> Value {
        let (lo, hi) = enclosing_decimals(&mode.claim.value, 15);
        let mut out = json!({
            name: mode.value,
            "enclosure": [lo, hi],
            "slipping": mode.moving.len(),
            "moving": mode.moving,
            "all_slip": self.is_all_slip(mode),
        });
        if let Some(v) = &mode.displacement {
            // A held dof does not move.
            let places = places.iter();
            let v: Vec<f64> = places
                .map(|place| place.map_or(0.0, |dof| v[dof]))
                .collect();
            out["mode"] = json!(v);
        }

        out
    }
}

/// The amount of the growing load at an equilibrium.
fn amount(at: &Equilibrium) -> f64 {
    to_f64(at.amount())
}

/// The enclosure of the mu up to which a matrix is definite, if there is one.
fn end_json(until: &DefiniteUntil) -> Option<[f64; 2]> {
    until.end().map(enclosing_doubles)
}

/// Families in words.
fn families_json(set: &ProvedSet, name: &str) -> Vec<Value> {
    let mut out = Vec::new();
    for ProvedFamily { family, slipping } in &set.families {
        out.push(json!({
            "values": family_values(name, family),
            "slipping": slipping,
            "one_solution_each": family.is_alone,
        }));
    }

    out
}
