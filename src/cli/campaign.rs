//! `mceip campaign`: every family through every engine, for seconds or for days.
//!
//! The instances, the engines and what counts as a disagreement are those of `mceip_testkit`. Here
//! the state of a campaign is kept in a file, each disagreement becomes a replay file, and progress
//! is shown. [`summary`] makes the output.

mod summary;

use super::common::{
    CliError, aside, exit, part, print_answer, require_count, require_threads, text,
};
use super::job::{interrupt, is_quiet};
use super::output::{Output, make};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use mceip_engine::run::in_threads;
use mceip_testkit::campaign::{
    Campaign, CampaignEvent, CampaignLimit, FAMILIES, MAX_INSTANCES, Replay, State, family_error,
    judge, standard,
};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Arguments of `campaign`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Run for so many seconds.
    #[arg(long, required_unless_present_any = ["count", "replay"], conflicts_with = "count")]
    seconds: Option<u64>,
    /// Run so many instances of each family; the summary does not depend on the number of threads.
    #[arg(long)]
    count: Option<u64>,
    /// Run these families only (default: all).
    #[arg(long = "family", value_name = "NAME", num_args = 1..)]
    families: Vec<String>,
    /// Seed of all instances.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Run part i of n: every n-th instance of each family.
    #[arg(long, value_name = "I/N")]
    shard: Option<String>,
    /// Keep what was done in this file, and go on from it if it is there.
    #[arg(long)]
    state: Option<PathBuf>,
    /// Write a replay file for each disagreement into this folder.
    #[arg(long, value_name = "FOLDER", default_value = "mceip-replays")]
    replays: PathBuf,
    /// Judge a replay file again; everything else but --json and --seed is ignored.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["seconds", "count", "state", "shard", "families"]
    )]
    replay: Option<PathBuf>,
    /// Threads (default: all cores).
    #[arg(long)]
    threads: Option<usize>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Ten years.
const MAX_SECONDS: u64 = 10 * 365 * 24 * 3600;

/// Runs a campaign, or judges a replay file.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    if let Some(path) = &args.replay {
        return replay(args, path);
    }

    if let Some(seconds) = args.seconds {
        require_count("seconds", seconds, 0..=MAX_SECONDS)?;
    }
    if let Some(count) = args.count {
        require_count("count", count, 0..=MAX_INSTANCES)?;
    }

    let limit = match (args.seconds, args.count) {
        (Some(seconds), _) => CampaignLimit::For(Duration::from_secs(seconds)),
        (None, count) => CampaignLimit::Count(count.unwrap_or_default()),
    };
    let state = start(args)?;
    require_threads(args.threads)?;

    let cancel = interrupt();
    let engines = standard(args.seed);
    let campaign = Campaign {
        engines: &engines,
        limit,
    };
    let bars = Bars::new(&state, limit);
    let mut keeper = StateKeeper {
        args,
        saved: Instant::now(),
        failed: None,
    };
    let mut on_event = |event: CampaignEvent<'_>| {
        match event {
            CampaignEvent::Wave(state) => {
                bars.show(state);
                keeper.keep(state, false);
            }
            CampaignEvent::Disagreement(replay) => keeper.write(replay, &bars),
        }

        // What cannot be kept need not be computed.
        if keeper.failed.is_some() {
            cancel.request();
        }
    };
    let state = in_threads(args.threads, || campaign.run(state, &cancel, &mut on_event));
    keeper.keep(&state, true);

    // A terminal that has gone away is no error.
    bars.all.clear().unwrap_or_default();
    print_answer(
        args.json,
        || summary::json_of(&state),
        || summary::text_of(&state),
    )?;
    if let Some(e) = keeper.failed {
        return Err(e);
    }

    Ok(if state.disagreements() > 0 {
        exit::REJECTED
    } else if cancel.is_requested() {
        exit::INTERRUPTED
    } else {
        exit::DONE
    })
}

/// The state to go on from: the file's, or a new one.
fn start(args: &Args) -> Result<State, CliError> {
    let families = families(args)?;
    // The file is known to be writable before the work starts.
    if let Some(path) = &args.state {
        Output::prepare("state", path, &[])?;
    }

    let part = match &args.shard {
        Some(given) => part("shard", given)?,
        None => (0, 1),
    };
    let part = (part.0 as u64, part.1 as u64);
    let new = State::new(args.seed, part, families);

    match &args.state {
        Some(path) if path.exists() => {
            let earlier = text("the campaign's state", path)?;
            let resumed = new.resumed(&earlier);
            let state = resumed.map_err(|e| CliError::other_file(path, e))?;

            if !state.is_bound() {
                let path = path.display();
                aside(&format!(
                    "mceip: {path}: not bound to its run by a digest (an older version has written \
                     it): its counts are taken as they are"
                ));
            }
            Ok(state)
        }
        _ => Ok(new),
    }
}

/// The families asked for, or all; each must exist and be named once.
fn families(args: &Args) -> Result<Vec<String>, CliError> {
    let families = if args.families.is_empty() {
        FAMILIES.iter().map(|family| family.0.to_string()).collect()
    } else {
        args.families.clone()
    };

    for (k, name) in families.iter().enumerate() {
        let exists = FAMILIES.iter().any(|family| family.0 == name);
        let is_repeated = families[..k].contains(name);
        if !exists || is_repeated {
            return Err(CliError::Family(family_error(name)));
        }
    }

    Ok(families)
}

/// Judges a replay file: exit 1 if anything disagrees still.
fn replay(args: &Args, path: &Path) -> Result<u8, CliError> {
    let source = text("the replay file", path)?;
    let replay = Replay::from_json(&source).map_err(|e| CliError::other_file(path, e))?;
    let case = replay.case().map_err(|e| CliError::other_file(path, e))?;
    let judged = judge(&case, &standard(replay.seed));

    print_answer(
        args.json,
        || summary::replay_json(&replay, &judged),
        || summary::replay_text(&replay, &judged),
    )?;

    Ok(if judged.findings.is_empty() {
        exit::DONE
    } else {
        exit::REJECTED
    })
}

/// Writes the state now and then and at the end, and replays at once.
struct StateKeeper<'a> {
    args: &'a Args,
    saved: Instant,
    /// The first write that failed.
    failed: Option<CliError>,
}

/// Time between two writes of the state.
const SAVE_EVERY: Duration = Duration::from_secs(5);

impl StateKeeper<'_> {
    /// Writes the state if it is time, or if it is the last one.
    fn keep(&mut self, state: &State, is_last: bool) {
        let Some(path) = &self.args.state else {
            return;
        };
        let is_due = is_last || self.saved.elapsed() >= SAVE_EVERY;
        if !is_due {
            return;
        }

        self.saved = Instant::now();
        let output = Output::prepare("state", path, &[]);
        let written = output.and_then(|output| output.write(&state.to_json()));
        self.note(written);
    }

    /// Writes a replay file and says so.
    fn write(&mut self, replay: &Replay, bars: &Bars) {
        let folder = &self.args.replays;
        let path = folder.join(replay.file_name());
        let written = write_replay(folder, &path, replay);

        let place = path.display();
        bars.say(&format!("DISAGREEMENT {place}: {}", replay.disagreement));
        self.note(written);
    }

    fn note(&mut self, written: Result<(), CliError>) {
        self.failed = self.failed.take().or(written.err());
    }
}

fn write_replay(folder: &Path, path: &Path, replay: &Replay) -> Result<(), CliError> {
    make(folder)?;
    Output::prepare("replays", path, &[])?.write(&replay.to_json())
}

/// One bar per family on stderr, drawn only on a terminal.
struct Bars {
    all: MultiProgress,
    each: Vec<ProgressBar>,
}

impl Bars {
    fn new(state: &State, limit: CampaignLimit) -> Bars {
        let template = match limit {
            CampaignLimit::Count(_) => "{msg:14} [{bar:30}] {pos}/{len} {per_sec}",
            CampaignLimit::For(_) => "{msg:14} {pos} {per_sec} {elapsed}",
        };
        let style = ProgressStyle::with_template(template);

        let all = MultiProgress::new();
        if is_quiet() {
            all.set_draw_target(ProgressDrawTarget::hidden());
        }
        let mut each = Vec::new();
        for name in &state.families {
            let bar = all.add(match limit {
                CampaignLimit::Count(n) => ProgressBar::new(n),
                CampaignLimit::For(_) => ProgressBar::no_length(),
            });
            if let Ok(style) = &style {
                bar.set_style(style.clone());
            }

            each.push(bar.with_message(name.clone()));
        }

        Bars { all, each }
    }

    fn show(&self, state: &State) {
        for (bar, tally) in self.each.iter().zip(&state.tallies) {
            bar.set_position(tally.instances);
        }
    }

    /// A line on stderr, beside the bars or without them.
    fn say(&self, line: &str) {
        if self.all.is_hidden() {
            aside(line);
        } else {
            // A terminal that has gone away is no error.
            let _ = self.all.println(line);
        }
    }
}
