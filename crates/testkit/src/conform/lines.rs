//! One foreign program for many cases: a problem per line in, a report per line out.
//!
//! For programs that take long to start. The time limit holds for each answer, the first one from
//! the start of the program. A program that hangs or prints too much is killed. One that has ended,
//! or has printed more than the line it was asked for, is started anew for the next case. Whether
//! that is noticed in time depends on the machine; so an answer of a program that has answered
//! before may be what another case has left behind ([`LineProgram::has_answered_before`]), and
//! `run` takes it for the answer only if it is right.

use super::process::{
    GRACE, PipeReader, ProcessEnding, ProcessLimits, SLICE, kill, spawn, telling_line,
};
use crate::error::TestkitError;
use mceip_engine::run::Watch;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::process::{Child, ChildStdin, ChildStdout};
use std::sync::mpsc::{
    Receiver, RecvTimeoutError, Sender, SyncSender, TryRecvError, channel, sync_channel,
};
use std::time::Instant;
use wait_timeout::ChildExt as _;

/// A program that answers line by line; not running before the first question.
pub(super) struct LineProgram<'a> {
    command: &'a [String],
    limits: ProcessLimits,
    running: Option<Running>,
    has_answered_before: bool,
}

/// A program that has been started, with a thread for each of its streams.
struct Running {
    child: Child,
    questions: Sender<String>,
    answers: Receiver<Answer>,
    complaint: PipeReader,
}

/// What comes from stdout.
enum Answer {
    /// A line, without its end.
    Line(Vec<u8>),
    /// More than allowed without an end of line.
    TooLong,
}

impl<'a> LineProgram<'a> {
    pub(super) fn new(command: &'a [String], limits: ProcessLimits) -> LineProgram<'a> {
        LineProgram {
            command,
            limits,
            running: None,
            has_answered_before: false,
        }
    }

    /// Was the last question asked of a program that had answered others?
    pub(super) fn has_answered_before(&self) -> bool {
        self.has_answered_before
    }

    /// Ends the program: the next question goes to a new one.
    pub(super) fn renew(&mut self) {
        if let Some(running) = self.running.take() {
            running.stop();
        }
    }

    /// Sends a problem and waits for the line that answers it.
    ///
    /// # Errors
    /// [`TestkitError::Start`] if the program does not start.
    pub(super) fn ask(
        &mut self,
        problem: &str,
        watch: &Watch<'_>,
    ) -> Result<ProcessEnding, TestkitError> {
        let start = Instant::now();
        let mut running = self.waiting()?;

        // One line; a JSON text has line ends between tokens only. Where the program has ended,
        // the answer tells.
        let _ = running.questions.send(problem.replace('\n', " "));

        let ending = running.answer(start, &self.limits, watch);
        match ending {
            Some(answered @ ProcessEnding::Ended { .. }) => {
                self.running = Some(running);
                Ok(answered)
            }
            Some(cut_off) => {
                running.stop();
                Ok(cut_off)
            }
            None => Ok(running.ended()),
        }
    }

    /// The program that answered last, if it waits for a question, or a new one.
    fn waiting(&mut self) -> Result<Running, TestkitError> {
        if let Some(mut running) = self.running.take() {
            let is_silent = matches!(running.answers.try_recv(), Err(TryRecvError::Empty));
            if is_silent && !running.has_ended() {
                self.has_answered_before = true;
                return Ok(running);
            }
            running.stop();
        }

        self.has_answered_before = false;
        Running::start(self.command, self.limits.output)
    }
}

impl Drop for LineProgram<'_> {
    fn drop(&mut self) {
        self.renew();
    }
}

impl Running {
    fn start(command: &[String], longest: u64) -> Result<Running, TestkitError> {
        let mut child = spawn(command)?;
        let (questions, to_send) = channel();
        // One line waits at most: a program that prints without end is held up.
        let (send, answers) = sync_channel(1);

        if let Some(stdin) = child.stdin.take() {
            std::thread::spawn(move || write_lines(stdin, &to_send));
        }
        if let Some(stdout) = child.stdout.take() {
            std::thread::spawn(move || read_lines(stdout, longest, &send));
        }
        let complaint = PipeReader::of_stderr(&mut child);

        Ok(Running {
            child,
            questions,
            answers,
            complaint,
        })
    }

    /// Waits for a line. `None` where the program has closed its stdout, or has ended.
    fn answer(
        &mut self,
        start: Instant,
        limits: &ProcessLimits,
        watch: &Watch<'_>,
    ) -> Option<ProcessEnding> {
        loop {
            let left = limits.time.saturating_sub(start.elapsed());
            match self.answers.recv_timeout(left.min(SLICE)) {
                Ok(Answer::Line(stdout)) => return Some(answered(stdout)),
                Ok(Answer::TooLong) => return Some(ProcessEnding::TooLong),
                Err(RecvTimeoutError::Disconnected) => return None,
                Err(RecvTimeoutError::Timeout) if watch.is_cancelled() => {
                    return Some(ProcessEnding::Interrupted);
                }
                Err(RecvTimeoutError::Timeout) if left.is_zero() => {
                    return Some(ProcessEnding::TimedOut);
                }
                Err(RecvTimeoutError::Timeout) if self.has_ended() => return self.last_line(),
                Err(RecvTimeoutError::Timeout) => (),
            }
        }
    }

    /// Has the program ended? What it left behind may hold its stdout.
    fn has_ended(&mut self) -> bool {
        matches!(self.child.try_wait(), Ok(Some(_)))
    }

    /// The line that a program has printed just before its end.
    fn last_line(&self) -> Option<ProcessEnding> {
        match self.answers.recv_timeout(GRACE) {
            Ok(Answer::Line(stdout)) => Some(answered(stdout)),
            Ok(Answer::TooLong) => Some(ProcessEnding::TooLong),
            Err(_) => None,
        }
    }

    /// The program has given no answer and closed its stdout, or ended: its exit code and its
    /// complaint. One that goes on without its stdout has printed no report, as with code 0.
    fn ended(mut self) -> ProcessEnding {
        let code = match self.child.wait_timeout(GRACE) {
            Ok(Some(status)) => status.code(),
            Ok(None) => Some(0),
            Err(_) => None,
        };
        kill(&mut self.child);

        ProcessEnding::Ended {
            code,
            stdout: Vec::new(),
            complaint: telling_line(&self.complaint.received()),
        }
    }

    fn stop(mut self) {
        kill(&mut self.child);
    }
}

/// A line as the output of a program that ended well.
fn answered(stdout: Vec<u8>) -> ProcessEnding {
    ProcessEnding::Ended {
        code: Some(0),
        stdout,
        complaint: String::new(),
    }
}

/// Writes each question as a line, until the program or the run ends.
fn write_lines(mut stdin: ChildStdin, questions: &Receiver<String>) {
    for question in questions {
        let sent = writeln!(stdin, "{question}").and_then(|()| stdin.flush());
        if sent.is_err() {
            return;
        }
    }
}

/// Passes on each line, until the program ends, nobody listens, or a line is too long.
fn read_lines(stdout: ChildStdout, longest: u64, answers: &SyncSender<Answer>) {
    let mut stdout = BufReader::new(stdout);
    loop {
        let mut line = Vec::new();
        let read = stdout.by_ref().take(longest).read_until(b'\n', &mut line);
        let is_whole = line.ends_with(b"\n");

        let answer = match read {
            Err(_) | Ok(0) => return,
            Ok(count) if count as u64 == longest && !is_whole => Answer::TooLong,
            Ok(_) => {
                line.truncate(line.len() - usize::from(is_whole));
                Answer::Line(line)
            }
        };
        if answers.send(answer).is_err() {
            return;
        }
    }
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use super::*;
    use mceip_engine::run::Cancel;

    fn shell(script: &str) -> Vec<String> {
        vec!["sh".to_owned(), "-c".into(), script.into()]
    }

    fn limits() -> ProcessLimits {
        ProcessLimits {
            time: std::time::Duration::from_millis(2000),
            output: 1000,
        }
    }

    fn line(text: &str) -> ProcessEnding {
        answered(text.as_bytes().to_vec())
    }

    /// The endings of these questions, one after the other.
    fn endings(script: &str, questions: &[&str]) -> Vec<ProcessEnding> {
        let command = shell(script);
        let mut program = LineProgram::new(&command, limits());
        let ask = |question: &&str| program.ask(question, &Watch::nobody()).unwrap();
        questions.iter().map(ask).collect()
    }

    #[test]
    fn one_program_answers_line_by_line() {
        let script = "n=0; while read -r line; do n=$((n + 1)); echo \"$n $line\"; done";
        let found = endings(script, &["a", "b\nb", "c"]);
        assert_eq!(found, ["1 a", "2 b b", "3 c"].map(line));
    }

    #[test]
    fn a_program_that_fails_is_started_anew() {
        // It answers once, then ends with a complaint.
        let script = "read -r line; echo \"$line\"; read -r line; echo oops >&2; exit 7";
        let found = endings(script, &["a", "b", "c"]);
        let ended = ProcessEnding::Ended {
            code: Some(7),
            stdout: Vec::new(),
            complaint: "oops".into(),
        };
        assert_eq!(found, [line("a"), ended, line("c")]);

        // It hangs on one question, and prints without end on another.
        let script = "while read -r line; do case $line in
            hang) sleep 100;; long) yes | tr -d '\\n';; *) echo \"$line\";; esac; done";
        let found = endings(script, &["a", "hang", "b", "long", "c"]);
        let expected = [
            line("a"),
            ProcessEnding::TimedOut,
            line("b"),
            ProcessEnding::TooLong,
            line("c"),
        ];
        assert_eq!(found, expected);
    }

    /// More lines than asked for, or an end after an answer: the next question goes to a new
    /// program.
    #[test]
    fn surplus_lines_do_not_answer_the_next_question() {
        let pause = std::time::Duration::from_millis(700);
        for script in [
            "while read -r line; do echo \"$line\"; echo more; done",
            "read -r line; echo \"$line\"; exec yes",
            "read -r line; echo \"$line\"",
            "read -r line; echo \"$line\"; sleep 100 & exit 0",
        ] {
            let command = shell(script);
            let mut program = LineProgram::new(&command, limits());
            for question in ["a", "b", "c"] {
                let ending = program.ask(question, &Watch::nobody()).unwrap();
                assert_eq!(ending, line(question), "{script}");
                std::thread::sleep(pause);
            }
        }
    }

    /// It ends while something it has started holds its stdout; it closes its stdout and goes on.
    #[test]
    fn a_program_without_an_answer_is_not_waited_for() {
        let start = Instant::now();
        let no_answer = |code| ProcessEnding::Ended {
            code: Some(code),
            stdout: Vec::new(),
            complaint: String::new(),
        };
        let patient = ProcessLimits {
            time: std::time::Duration::from_secs(60),
            output: 1000,
        };

        for (script, code) in [("sleep 100 & exit 5", 5), ("exec 1<&-; sleep 100", 0)] {
            let command = shell(script);
            let ending = LineProgram::new(&command, patient).ask("a", &Watch::nobody());
            assert_eq!(ending.unwrap(), no_answer(code), "{script}");
        }
        assert!(start.elapsed().as_secs() < 30);
    }

    #[test]
    fn an_interrupt_ends_a_wait_and_a_missing_program_is_named() {
        let sleep = shell("sleep 100");
        let stopped = Cancel::requested();
        let mut program = LineProgram::new(&sleep, limits());
        let ending = program.ask("a", &Watch::silent(&stopped)).unwrap();
        assert_eq!(ending, ProcessEnding::Interrupted);

        let nothing = ["/nowhere/solver".to_owned()];
        let refused = LineProgram::new(&nothing, limits()).ask("a", &Watch::nobody());
        assert!(matches!(refused, Err(TestkitError::Start { .. })));
    }
}
