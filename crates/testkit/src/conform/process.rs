//! One run of a foreign program: problem in, report out, bounded in time and memory.
//!
//! The problem goes to stdin, the report comes from stdout. A program that hangs, prints without
//! end, reads nothing or leaves children behind is killed with its process group. Called by `run`
//! for each case of the plan.

use crate::error::TestkitError;
use mceip_engine::run::Watch;
use std::io::{ErrorKind, Read, Write as _};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use wait_timeout::ChildExt as _;

/// What a run may use.
#[derive(Debug, Clone, Copy)]
pub struct ProcessLimits {
    /// Time for one problem.
    pub time: Duration,
    /// Bytes on stdout.
    pub output: u64,
}

impl Default for ProcessLimits {
    fn default() -> Self {
        ProcessLimits {
            time: Duration::from_secs(10),
            output: 16 << 20,
        }
    }
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ProcessEnding {
    /// It ended by itself: exit code (`None`: by a signal), stdout, the beginning of stderr.
    Ended {
        /// Exit code.
        code: Option<i32>,
        /// What it printed.
        stdout: Vec<u8>,
        /// The telling line of what it complained.
        complaint: String,
    },
    /// Still running at the end of its time; it has been killed.
    TimedOut,
    /// More on stdout than allowed; it has been killed.
    TooLong,
    /// The run was interrupted from outside; it has been killed.
    Interrupted,
}

/// How often the time and the interrupt are looked at.
pub(super) const SLICE: Duration = Duration::from_millis(50);
/// Time for the rest of the output once the program has ended: a grandchild may hold the pipe.
pub(super) const GRACE: Duration = Duration::from_millis(500);
/// Bytes of stderr kept.
const COMPLAINT: u64 = 4096;

/// Runs `command` (program and arguments) with `input` on its stdin.
///
/// # Errors
/// [`TestkitError::Start`] if it does not start.
pub fn run_once(
    command: &[String],
    input: &str,
    limits: &ProcessLimits,
    watch: &Watch<'_>,
) -> Result<ProcessEnding, TestkitError> {
    let start = Instant::now();
    let mut child = spawn(command)?;
    let too_long = Arc::new(AtomicBool::new(false));
    feed(&mut child, input);

    let pipe = child.stdout.take();
    let stdout = PipeReader(pipe.map(|pipe| drain(pipe, limits.output, Some(too_long.clone()))));
    let stderr = PipeReader::of_stderr(&mut child);
    let ended = wait(&mut child, start, limits, watch, &too_long);
    kill(&mut child); // and whatever it has left behind

    let stdout = stdout.received();
    let complaint = stderr.received();
    if too_long.load(Ordering::Relaxed) {
        return Ok(ProcessEnding::TooLong);
    }

    Ok(match ended {
        Ok(status) => ProcessEnding::Ended {
            code: status.code(),
            stdout,
            complaint: telling_line(&complaint),
        },
        Err(ending) => ending,
    })
}

/// Starts the program in a process group of its own, with pipes for all three streams.
pub(super) fn spawn(command: &[String]) -> Result<Child, TestkitError> {
    let (program, arguments) = match command.split_first() {
        Some((program, arguments)) => (program.as_str(), arguments),
        None => ("", &[][..]),
    };

    let mut build = Command::new(program);
    build
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());

    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt as _;
        build.process_group(0); // so that its children end with it
    }

    build.spawn().map_err(|e| TestkitError::Start {
        command: program.to_string(),
        reason: e.kind(),
    })
}

/// A pipe that a thread reads to its end.
pub(super) struct PipeReader(Option<Drain>);

/// What a thread has read of a pipe, and the word that it is done.
struct Drain {
    kept: Arc<Mutex<Vec<u8>>>,
    done: Receiver<()>,
}

impl PipeReader {
    /// Of what a program complains.
    pub(super) fn of_stderr(child: &mut Child) -> PipeReader {
        let pipe = child.stderr.take();
        PipeReader(pipe.map(|pipe| drain(pipe, COMPLAINT, None)))
    }

    /// What was read; of a pipe that something left behind holds open, what came in the time of
    /// grace.
    pub(super) fn received(self) -> Vec<u8> {
        let Some(Drain { kept, done }) = self.0 else {
            return Vec::new();
        };
        // An error: the thread is gone, or the time is over.
        let _ = done.recv_timeout(GRACE);
        std::mem::take(&mut kept.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Writes the problem from a thread of its own: a program that reads nothing must not stop us. One
/// that closes its stdin early is no error.
fn feed(child: &mut Child, input: &str) {
    let Some(mut stdin) = child.stdin.take() else {
        return;
    };

    let text = input.to_string();
    std::thread::spawn(move || {
        // A closed pipe: the program did not want the rest.
        let _ = stdin.write_all(text.as_bytes());
    });
}

/// Reads a pipe to its end, keeps the first `limit` bytes. With a flag, more than that sets it and
/// ends the reading; without one, the rest is read and dropped.
fn drain(
    mut pipe: impl Read + Send + 'static,
    limit: u64,
    too_long: Option<Arc<AtomicBool>>,
) -> Drain {
    let (send, done) = channel();
    let kept = Arc::new(Mutex::new(Vec::new()));
    let shared = kept.clone();
    std::thread::spawn(move || {
        let mut left = limit;
        let mut buffer = [0u8; 1 << 14];

        // What was read until an error is kept.
        loop {
            let count = match pipe.read(&mut buffer) {
                Err(e) if e.kind() == ErrorKind::Interrupted => continue,
                Err(_) | Ok(0) => break,
                Ok(count) => count,
            };

            let taken = count.min(usize::try_from(left).unwrap_or(usize::MAX));
            left -= taken as u64;
            let mut kept = shared.lock().unwrap_or_else(PoisonError::into_inner);
            kept.extend_from_slice(&buffer[..taken]);
            drop(kept);

            if let Some(flag) = &too_long
                && taken < count
            {
                flag.store(true, Ordering::Relaxed);
                break;
            }
        }

        // Nobody listens if the time of grace is over.
        let _ = send.send(());
    });

    Drain { kept, done }
}

/// Waits until the program ends, its time is over, it prints too much, or the run is interrupted.
fn wait(
    child: &mut Child,
    start: Instant,
    limits: &ProcessLimits,
    watch: &Watch<'_>,
    too_long: &AtomicBool,
) -> Result<ExitStatus, ProcessEnding> {
    loop {
        let left = limits.time.saturating_sub(start.elapsed());
        match child.wait_timeout(left.min(SLICE)) {
            Ok(Some(status)) => return Ok(status),
            Err(_) => return Err(ProcessEnding::Interrupted), // the child cannot be waited for
            Ok(None) if too_long.load(Ordering::Relaxed) => return Err(ProcessEnding::TooLong),
            Ok(None) if watch.is_cancelled() => return Err(ProcessEnding::Interrupted),
            Ok(None) if left.is_zero() => return Err(ProcessEnding::TimedOut),
            Ok(None) => {}
        }
    }
}

/// Kills the program and its group, and waits for it, so that nothing is left.
pub(super) fn kill(child: &mut Child) {
    #[cfg(unix)]
    {
        let group = rustix::process::Pid::from_child(child);
        // A group that has ended already is no error.
        let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
    }
    let _ = child.kill();
    let _ = child.wait();
}

/// The line of a complaint that says what is wrong: the first one that is not blank, of a Python
/// traceback the last. At most 200 characters of it, without control characters.
pub(super) fn telling_line(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let first = lines.next().unwrap_or_default();
    let line = if first.starts_with("Traceback") {
        lines.next_back().unwrap_or(first)
    } else {
        first
    };

    line.chars().filter(|c| !c.is_control()).take(200).collect()
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use super::*;
    use mceip_engine::run::Cancel;

    /// Runs a shell script that is sent a megabyte.
    fn run_script(script: &str, limits: &ProcessLimits) -> ProcessEnding {
        let command = ["sh".to_string(), "-c".into(), script.into()];
        let input = "x".repeat(1 << 20); // more than a pipe holds
        run_once(&command, &input, limits, &Watch::nobody()).unwrap()
    }

    fn quick() -> ProcessLimits {
        ProcessLimits {
            time: Duration::from_millis(400),
            output: 1000,
        }
    }

    fn ended(code: i32, stdout: &str) -> ProcessEnding {
        ProcessEnding::Ended {
            code: Some(code),
            stdout: stdout.as_bytes().to_vec(),
            complaint: String::new(),
        }
    }

    #[test]
    fn hostile_programs_are_survived() {
        let long = ProcessLimits::default();

        // A program that reads everything, one that closes its stdin, one that kills itself.
        assert_eq!(
            run_script("wc -c | tr -d ' '", &long),
            ended(0, "1048576\n")
        );
        assert_eq!(
            run_script("echo a; exec 0<&-; exit 7", &long),
            ended(7, "a\n")
        );
        let killed = run_script("echo oops >&2; kill -9 $$", &long);
        let ProcessEnding::Ended {
            code, complaint, ..
        } = killed
        else {
            panic!("{killed:?}")
        };
        assert_eq!(code, None);
        assert_eq!(complaint, "oops");

        // Programs that do not end.
        assert_eq!(run_script("sleep 100", &quick()), ProcessEnding::TimedOut);
        let pipeline = run_script("sleep 100 | sleep 100", &quick());
        assert_eq!(pipeline, ProcessEnding::TimedOut);

        // Programs that print without end, to stdout and to stderr.
        let start = Instant::now();
        assert_eq!(run_script("yes", &long), ProcessEnding::TooLong);
        let noisy = run_script("yes >&2 & sleep 0.1; kill $!; echo done", &long);
        assert!(matches!(noisy, ProcessEnding::Ended { code: Some(0), .. }));

        // A grandchild that holds the pipe open for long.
        let parent = run_script("sleep 100 & echo done", &long);
        let ProcessEnding::Ended { code, stdout, .. } = parent else {
            panic!("{parent:?}")
        };
        assert_eq!(code, Some(0));
        assert_eq!(stdout, b"done\n");

        // One that has left the process group, which is not killed.
        let daemon = run_script("setsid sleep 5 & echo done", &long);
        let ProcessEnding::Ended { code, stdout, .. } = daemon else {
            panic!("{daemon:?}")
        };
        assert_eq!(code, Some(0));
        assert_eq!(stdout, b"done\n");
        let passed = start.elapsed();
        assert!(passed < Duration::from_secs(8), "{passed:?}");
    }

    #[test]
    fn the_telling_line_is_the_first_or_the_last_of_a_traceback() {
        let traceback = b"Traceback (most recent call last):\n  File x\nKeyError: 'pencil'\n\n";
        assert_eq!(telling_line(traceback), "KeyError: 'pencil'");
        assert_eq!(telling_line(b"\nfatal: no\nmore\n"), "fatal: no");
        assert_eq!(telling_line(b"Traceback\n"), "Traceback");
        assert_eq!(telling_line(b""), "");
    }

    #[test]
    fn an_interrupt_ends_a_run_and_a_missing_program_is_named() {
        let stopped = Cancel::requested();
        let sleep = ["sleep".to_string(), "100".into()];

        assert_eq!(
            run_once(
                &sleep,
                "",
                &ProcessLimits::default(),
                &Watch::silent(&stopped)
            )
            .unwrap(),
            ProcessEnding::Interrupted
        );

        let nothing = ["/nowhere/solver".to_string()];
        let refused = run_once(
            &nothing,
            "",
            &ProcessLimits::default(),
            &Watch::silent(&stopped),
        );
        let Err(TestkitError::Start { command, .. }) = refused else {
            panic!("{refused:?}")
        };
        assert_eq!(command, "/nowhere/solver");
    }
}
