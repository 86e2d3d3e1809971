//! `mceip campaign`: every family through every engine, for seconds or for days.

mod summary;

use super::common::{CliError, exit, print, require_threads, text};
use super::job::interrupt;
use super::output::Output;
use crate::testkit::campaign::{
    Campaign, Event, FAMILIES, Limit, Replay, State, UnknownFamily, judge, standard,
};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
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
    #[arg(long, value_name = "FILE", conflicts_with_all = ["seconds", "count", "state", "shard", "families"])]
    replay: Option<PathBuf>,
    /// Threads (default: all cores).
    #[arg(long)]
    threads: Option<usize>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    if let Some(path) = &args.replay {
        return replay(args, path);
    }
    let limit = match (args.seconds, args.count) {
        (Some(s), _) => Limit::For(Duration::from_secs(s)),
        (None, count) => Limit::Count(count.unwrap_or_default()),
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
    let mut keeper = Keeper {
        args,
        saved: Instant::now(),
        failed: None,
    };
    let mut hear = |event: Event<'_>| {
        match event {
            Event::Wave(state) => {
                bars.show(state);
                keeper.keep(state, false);
            }
            Event::Disagreement(replay) => keeper.write(replay, &bars),
        }
        if keeper.failed.is_some() {
            cancel.request(); // what cannot be kept need not be computed
        }
    };
    let state = in_threads(args.threads, || campaign.run(state, &cancel, &mut hear));
    keeper.keep(&state, true);
    bars.all.clear().unwrap_or_default(); // a terminal that has gone away
    print(&if args.json {
        format!("{}\n", summary::json_of(&state))
    } else {
        summary::text_of(&state)
    })?;
    if let Some(e) = keeper.failed {
        return Err(e);
    }
    Ok(match (state.disagreements(), cancel.is_requested()) {
        (0, false) => exit::DONE,
        (0, true) => exit::INTERRUPTED,
        _ => exit::REJECTED,
    })
}

/// The state to go on from: the file's, or a new one.
fn start(args: &Args) -> Result<State, CliError> {
    let all = || FAMILIES.iter().map(|f| f.0.to_string()).collect();
    let families: Vec<String> = if args.families.is_empty() {
        all()
    } else {
        args.families.clone()
    };
    for (k, name) in families.iter().enumerate() {
        if !FAMILIES.iter().any(|f| f.0 == name) || families[..k].contains(name) {
            return Err(UnknownFamily { name: name.clone() }.into());
        }
    }
    if let Some(path) = &args.state {
        Output::prepare("state", path, &[])?; // known to be writable before the work starts
    }
    let new = State::new(args.seed, shard(args.shard.as_deref())?, families);
    match &args.state {
        Some(path) if path.exists() => {
            new.resumed(&text("the campaign's state", path)?)
                .map_err(|source| CliError::State {
                    path: path.display().to_string(),
                    source,
                })
        }
        _ => Ok(new),
    }
}

fn shard(given: Option<&str>) -> Result<(u64, u64), CliError> {
    let Some(given) = given else {
        return Ok((0, 1));
    };
    let bad = || CliError::Option {
        option: "shard",
        expected: "i/n with 1 <= i <= n",
        got: given.chars().take(60).collect(),
    };
    let (i, n) = given.split_once('/').ok_or_else(bad)?;
    let (i, n) = (
        i.parse::<u64>().map_err(|_| bad())?,
        n.parse::<u64>().map_err(|_| bad())?,
    );
    if i >= 1 && i <= n {
        Ok((i - 1, n))
    } else {
        Err(bad())
    }
}

/// Judges a replay file: exit 1 if anything disagrees still.
fn replay(args: &Args, path: &Path) -> Result<u8, CliError> {
    let bad = |source| CliError::Replay {
        path: path.display().to_string(),
        source,
    };
    let replay = Replay::from_json(&text("the replay file", path)?).map_err(bad)?;
    let judged = judge(&replay.case().map_err(bad)?, &standard(replay.seed));
    print(&if args.json {
        format!("{}\n", summary::replay_json(&replay, &judged))
    } else {
        summary::replay_text(&replay, &judged)
    })?;
    Ok(if judged.findings.is_empty() {
        exit::DONE
    } else {
        exit::REJECTED
    })
}

/// Runs in a pool of the wanted size, or in the default one.
fn in_threads(threads: Option<usize>, work: impl FnOnce() -> State + Send) -> State {
    match threads.map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build()) {
        Some(Ok(pool)) => pool.install(work),
        // Without a pool of one's own the default one does the same work.
        _ => work(),
    }
}

/// Writes the state now and then and at the end, and replays at once.
struct Keeper<'a> {
    args: &'a Args,
    saved: Instant,
    failed: Option<CliError>,
}

/// Time between two writes of the state.
const SAVE_EVERY: Duration = Duration::from_secs(5);

impl Keeper<'_> {
    fn keep(&mut self, state: &State, last: bool) {
        let Some(path) = &self.args.state else { return };
        if last || self.saved.elapsed() >= SAVE_EVERY {
            self.saved = Instant::now();
            let written =
                Output::prepare("state", path, &[]).and_then(|o| o.write(&state.to_json()));
            self.failed = self.failed.take().or(written.err());
        }
    }

    fn write(&mut self, replay: &Replay, bars: &Bars) {
        let folder = &self.args.replays;
        let path = folder.join(replay.file_name());
        let made =
            std::fs::create_dir_all(folder).map_err(|e| CliError::write(folder.display(), &e));
        let written = made
            .and_then(|()| Output::prepare("replays", &path, &[]))
            .and_then(|o| o.write(&replay.to_json()));
        bars.say(&format!(
            "DISAGREEMENT {}: {}",
            path.display(),
            replay.disagreement
        ));
        self.failed = self.failed.take().or(written.err());
    }
}

/// One bar per family on stderr, drawn only on a terminal.
struct Bars {
    all: MultiProgress,
    each: Vec<ProgressBar>,
}

impl Bars {
    fn new(state: &State, limit: Limit) -> Bars {
        let all = MultiProgress::new();
        let style = match limit {
            Limit::Count(_) => {
                ProgressStyle::with_template("{msg:14} [{bar:30}] {pos}/{len} {per_sec}")
            }
            Limit::For(_) => ProgressStyle::with_template("{msg:14} {pos} {per_sec} {elapsed}"),
        };
        let each = state.families.iter().map(|name| {
            let bar = all.add(match limit {
                Limit::Count(n) => ProgressBar::new(n),
                Limit::For(_) => ProgressBar::no_length(),
            });
            if let Ok(style) = &style {
                bar.set_style(style.clone());
            }
            bar.with_message(name.clone())
        });
        Bars {
            each: each.collect(),
            all,
        }
    }

    fn show(&self, state: &State) {
        self.each
            .iter()
            .zip(&state.tallies)
            .for_each(|(bar, t)| bar.set_position(t.instances));
    }

    /// A line on stderr, beside the bars or without them.
    fn say(&self, line: &str) {
        if self.all.is_hidden() {
            eprintln!("{line}");
        } else {
            let _ = self.all.println(line); // a terminal that has gone away
        }
    }
}
