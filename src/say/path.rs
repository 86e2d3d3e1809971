//! Loading paths in words and as JSON: amounts of loads, states, causes of events and ends, and the
//! stretches for programs.

use super::stretches::table_of;
use super::{number_text, warnings_text};
use crate::front::LoadPath;
use mceip_engine::report::{counted, fixed_decimals};
use mceip_exact::to_f64;
use mceip_model::{ContactState, Particle};
use mceip_path::{Bound, Equilibrium, Event, LoadingPath, LoadingPathEnd, RateSolutions, Stretch};
use serde_json::{Value, json};

/// The path: its stretches as a table, why it ends, whether it is the only one.
pub(crate) fn text_of(followed: &LoadPath) -> String {
    let path = followed.as_path();
    let file = followed.loads().as_file();
    let name = file.name.as_deref().unwrap_or("a body under loads");
    let mu = number_text(&path.steps.friction);
    let warnings = warnings_text(&file.warnings);
    let candidates = followed.loads().candidates();
    let table = table_of(path, &followed.loads().step_names(), candidates);
    let end = end_text(path, candidates);
    let headline = not_carried_text(followed);

    let doubts = doubts_text(followed);
    let verified = if path.stretches.is_empty() {
        ""
    } else {
        "every event is an exact rational number; (1), (2), (5), (7) verified exactly at both \
         ends of each stretch; "
    };
    let mut out = format!(
        "{name}; mu = {mu}; from and to: how much of the step's load is applied\n\
         {headline}{warnings}{doubts}{LETTERS}\n\
         {table}\n\
         {verified}{end}\n"
    );
    out += &continuations_text(followed.continuations());
    if followed.is_in_doubles() {
        out += &format!("{}\n", of_which_body(true));
    }

    out
}

/// What makes one doubt the data, a line each: stretches in which rounding alone holds the body, a
/// body that touches nothing.
pub(crate) fn doubts_text(followed: &LoadPath) -> String {
    let mut out = String::new();
    let stretches = followed.held_by_rounding();
    if !stretches.is_empty() {
        out += &format!(
            "WARNING: in the contact states of stretch {} nothing but the last digits of the \
             stiffness holds the body: it can move without force, and what is computed there means \
             nothing. {LOOK_AT}\n",
            runs(stretches)
        );
    }

    let stretches = followed.as_path().stretches.iter();
    out + &apart_text(stretches.map(Stretch::equilibrium_states))
}

/// A warning where all of these equilibria touch nothing: no answer about them says much.
pub(crate) fn apart_text<'a>(equilibria: impl Iterator<Item = &'a [ContactState]>) -> String {
    let mut equilibria = equilibria.peekable();
    let is_none = equilibria.peek().is_none();
    let is_free = |state: &ContactState| *state == ContactState::Free;
    if is_none || !equilibria.all(|states| states.iter().all(is_free)) {
        return String::new();
    }

    format!("WARNING: no candidate is in contact in any of these equilibria. {LOOK_AT}\n")
}

/// What makes a body fly off, or its path end at once.
const LOOK_AT: &str = "Look at the supports of the body, at the signs of the loads, at the \
    normals of the candidates (normal_direction), at which degree of freedom is tangential and \
    which normal, and at the order of the steps: a body that only contact holds has to be pressed \
    on first.";

/// What the letters mean by which contact states are shown.
pub(crate) const LETTERS: &str = "nodes in order: . stick, < impending slip against its tangent (S \
    = 1), > along it (S = -1), o free, z in contact without reaction";

/// A line of its own where the loads cannot grow to their end, empty elsewhere.
pub(crate) fn not_carried_text(followed: &LoadPath) -> String {
    let path = followed.as_path();
    let LoadingPathEnd::NoContinuation { causes, why } = &path.end else {
        return String::new();
    };
    let last = path.stretches.last();
    let Some((stretch, stop)) = last.and_then(|last| Some((last, last.stop.as_ref()?))) else {
        return String::new();
    };
    if causes.is_empty() || !why.is_proved() {
        return String::new();
    }

    let step = followed.loads().step_names()[stretch.step];
    let amount = amount_text(stop);
    let causes = causes_text(causes, followed.loads().candidates());
    format!(
        "THE LOADS ARE NOT CARRIED: at {amount} of {step} ({causes}) no quasi-static equilibrium \
         follows\n"
    )
}

/// Why the path ends.
pub(crate) fn end_text(path: &LoadingPath, candidates: &[Particle]) -> String {
    match &path.end {
        LoadingPathEnd::NoFurtherEvent if path.slides() => {
            "the body slides: no state changes any more".into()
        }
        LoadingPathEnd::NoFurtherEvent => "no further event: no state changes any more".into(),
        LoadingPathEnd::AllApplied => "all loads are applied".into(),
        LoadingPathEnd::Interrupted => "INTERRUPTED".into(),
        LoadingPathEnd::NoContinuation { causes, why } => {
            // A step that cannot begin is a mistake in the data more often than mechanics.
            let remedy = if causes.is_empty() {
                format!(". {LOOK_AT}")
            } else {
                String::new()
            };
            let causes = causes_text(causes, candidates);
            if why.is_proved() {
                format!("the quasi-static path ends ({causes}): {why}{remedy}")
            } else {
                format!("UNDECIDED ({causes}): {why}{remedy}")
            }
        }
    }
}

/// A candidate by its name, or by its number from 1.
pub(crate) fn candidate_name(candidates: &[Particle], node: usize) -> String {
    match &candidates[node].name {
        Some(name) => name.clone(),
        None => format!("node {}", node + 1),
    }
}

/// The bounds that are reached at an event, candidate by candidate.
pub(crate) fn causes_text(causes: &[Bound], candidates: &[Particle]) -> String {
    if causes.is_empty() {
        return "the step begins".into();
    }

    let mut reached = Vec::new();
    for bound in causes {
        let who = candidate_name(candidates, bound.node());
        let text = format!("{who}: {}", bound.word());
        // At the tip of the cone both its sides are reached.
        if !reached.contains(&text) {
            reached.push(text);
        }
    }

    reached.join(", ")
}

/// The stretches for programs.
pub(crate) fn json_of(
    path: &LoadingPath,
    steps: &[&str],
    continuations: &[RateSolutions],
) -> Vec<Value> {
    let mut out = Vec::with_capacity(path.stretches.len());
    for (stretch, continuations) in path.stretches.iter().zip(continuations) {
        out.push(stretch_json(stretch, steps[stretch.step], continuations));
    }

    out
}

fn stretch_json(stretch: &Stretch, step: &str, continuations: &RateSolutions) -> Value {
    let [stick, against, along, free] = stretch.counts();
    let stop = stretch.stop.as_ref();

    json!({
        "step": step,
        "from": to_f64(stretch.start.amount()),
        "to": stop.map(|stop| to_f64(stop.amount())),
        "states": states_json(&stretch.states),
        "equilibrium_states": states_json(stretch.equilibrium_states()),
        "stick": stick,
        "slip-": against,
        "slip+": along,
        "free": free,
        "zero": stretch.count(ContactState::Zero),
        "start": equilibrium_json(&stretch.start),
        "stop": stop.map(equilibrium_json),
        "event": event_json(&stretch.begin),
        "continuations": continuations_json(continuations),
    })
}

/// `null` where not every set of states was tried.
fn continuations_json(continuations: &RateSolutions) -> Value {
    match continuations {
        RateSolutions::NotTried | RateSolutions::NotExamined => Value::Null,
        RateSolutions::OneForEveryLoad => json!({ "one_for_every_load": true }),
        RateSolutions::Listed { states, singular } => {
            let states: Vec<_> = states.iter().map(|states| states_json(states)).collect();
            json!({
                "one_for_every_load": false,
                "states": states,
                "singular_sets": singular,
            })
        }
    }
}

/// Of which body a path is.
pub(crate) fn of_which_body(is_in_doubles: bool) -> &'static str {
    if is_in_doubles {
        "the path is that of the body condensed in doubles, which differs from the given one by \
         rounding"
    } else {
        "the path is that of the body as it is given, condensed exactly"
    }
}

/// Whether the path is the only one, in words.
pub(crate) fn continuations_text(all: &[RateSolutions]) -> String {
    let numbered = |is_it: &dyn Fn(&RateSolutions) -> bool| -> Vec<usize> {
        (0..all.len()).filter(|&k| is_it(&all[k])).collect()
    };
    let every = numbered(&|one| *one == RateSolutions::OneForEveryLoad);
    let here = numbered(&|one| *one != RateSolutions::OneForEveryLoad && one.is_one());

    let mut out = String::new();
    if !every.is_empty() {
        out += &format!(
            "one way to go on, whatever load grows, at the beginning of stretch {}: all \
             determinants of the rate problem are positive there\n",
            runs(&every)
        );
    }
    if !here.is_empty() {
        let stretches = runs(&here);
        out += &format!(
            "one way to go on under these loads at the beginning of stretch {stretches}\n"
        );
    }
    for (k, one) in all.iter().enumerate().filter(|(_, one)| !one.is_one()) {
        out += &format!("{}\n", several_text(k, one));
    }

    out
}

/// Where there is not one continuation, or where that is not known.
fn several_text(stretch: usize, continuations: &RateSolutions) -> String {
    let not_known = "NOT KNOWN whether there is another way to go on at the beginning of stretch";
    let (states, singular) = match continuations {
        RateSolutions::OneForEveryLoad => return String::new(), // told with the others
        RateSolutions::Listed { states, singular } => (states, singular),
        RateSolutions::NotTried => {
            return format!("{not_known} {stretch}: too many sets of states to try all");
        }
        RateSolutions::NotExamined => return format!("{not_known} {stretch}: not examined"),
    };

    let mut ways = Vec::with_capacity(states.len());
    for (k, states) in states.iter().enumerate() {
        let letters: String = states.iter().map(|state| state.letter()).collect();
        ways.push(format!("{k}: {letters}"));
    }
    let ways = ways.join(", ");
    let count = counted(states.len(), "way");
    let another = match states.len() {
        0 | 1 => String::new(),
        _ => format!("; `mceip path --take {stretch}=K` takes another"),
    };
    let several =
        format!("{count} to go on at the beginning of stretch {stretch} ({ways}{another})");
    match singular {
        0 => several,
        _ => format!(
            "{several}; more are NOT EXCLUDED: in {} of states the body can move without force",
            counted(*singular, "set")
        ),
    }
}

/// Numbers as runs: 0 to 3, 5.
fn runs(numbers: &[usize]) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &number in numbers {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => runs.push((number, number)),
        }
    }

    let words = runs.iter().map(|(first, last)| match last - first {
        0 => first.to_string(),
        1 => format!("{first}, {last}"),
        _ => format!("{first} to {last}"),
    });
    words.collect::<Vec<_>>().join(", ")
}

fn event_json(event: &Event) -> Value {
    let causes: Vec<Value> = event.causes.iter().map(cause_json).collect();
    let mut changes = Vec::new();
    for change in &event.changes {
        changes.push(json!({
            "node": change.node + 1,
            "from": change.from.directed_word(),
            "to": change.to.directed_word(),
        }));
    }

    json!({
        "causes": causes,
        "changes": changes,
        "tried": event.tried,
    })
}

fn cause_json(bound: &Bound) -> Value {
    json!({ "node": bound.node() + 1, "what": bound.word() })
}

fn equilibrium_json(at: &Equilibrium) -> Value {
    let (tangential, normal) = at.resultants();
    let mut reactions = Vec::new();
    for (r_t, r_n) in at.reactions_f64() {
        reactions.push(json!([r_t, r_n]));
    }

    // The fraction of the exact amount fills pages: its size stands for it.
    let bits = at.amount().numer().bits() + at.amount().denom().bits();

    json!({
        "amount_bits": bits,
        "states": states_json(at.contact_states()),
        "resultant_T": to_f64(&tangential),
        "resultant_N": to_f64(&normal),
        "reactions_T_N": reactions,
    })
}

/// What each candidate does at the beginning and at the end of each stretch, a line each, as CSV.
///
/// `number` counts the candidates from 1, `stretch` the stretches from 0; `amount` is how much of
/// the step's load is applied. `state` is that of the equilibrium at this end of the stretch.
/// Displacements and reactions are in the directions of the candidate and in the units of the file:
/// u_T and r_T along its tangent, u_N and r_N into the obstacle, r_N <= 0 in contact.
pub(crate) fn reactions_csv(followed: &LoadPath) -> String {
    let candidates = followed.loads().candidates();
    let names = followed.loads().step_names();
    let mut out = String::from("stretch,step,amount,number,candidate,state,u_T,u_N,r_T,r_N\n");

    for (k, stretch) in followed.as_path().stretches.iter().enumerate() {
        let step = csv_field(names[stretch.step]);
        let ends = [Some(&stretch.start), stretch.stop.as_ref()];
        for at in ends.into_iter().flatten() {
            let amount = to_f64(at.amount());
            let reactions = at.reactions_f64();
            for (node, (r_t, r_n)) in reactions.into_iter().enumerate() {
                let number = node + 1;
                let candidate = csv_field(&candidate_name(candidates, node));
                let state = at.contact_states()[node].directed_word();
                let (u_t, u_n) = at.displacement(node);
                let (u_t, u_n) = (to_f64(&u_t), to_f64(&u_n));
                out += &format!(
                    "{k},{step},{amount},{number},{candidate},{state},{u_t},{u_n},{r_t},{r_n}\n"
                );
            }
        }
    }

    out
}

/// A text as a field of CSV, quoted as in RFC 4180.
fn csv_field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}

/// The amount of the growing load at an equilibrium.
pub(crate) fn amount_text(at: &Equilibrium) -> String {
    fixed_decimals(at.amount(), 9)
}

/// The states in words.
pub(crate) fn states_json(states: &[ContactState]) -> Vec<&'static str> {
    states.iter().map(|state| state.directed_word()).collect()
}
