//! What is proved lasts: files are on the disk before anything is printed, while a search goes on
//! they are written from time to time, and nobody who reads the output has to be there.
//!
//! A process that is killed leaves at each place a whole file or none. The expected content of a
//! certificate is what `mceip check` accepts; that nothing was lost is told by its parts.
#![cfg(all(feature = "cli", unix))]

use crate::common::{edge, example, exits, problem_text, read, repository, run, started};
use crate::interrupt::interrupt;
use crate::program::Folder;
use mceip_testkit::known;
use std::fs::OpenOptions;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The program, to be run with this command line.
fn program(command: &str) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_mceip"));
    program.args(command.split(' ')).stdin(Stdio::null());
    program
}

/// A device that is always full.
fn full() -> Stdio {
    let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
    full.into()
}

/// The writing end of a pipe whose reader has gone away.
fn closed_pipe() -> Stdio {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    writer.into()
}

/// The exit code of a run whose stdout and stderr go there, and what it says on a stderr that can
/// be read.
fn code(command: &str, stdout: Stdio, stderr: Stdio) -> (Option<i32>, String) {
    let mut program = program(command);
    let output = program.stdout(stdout).stderr(stderr).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    (output.status.code(), said)
}

/// Runs that write a file, FILE, and print, with their exit codes.
fn writers(folder: &Folder) -> Vec<(String, i32)> {
    let fold = example("fold");
    let report = folder.path("report.json");
    std::fs::write(&report, exits(0, &format!("enumerate {fold} --json"))).unwrap();
    let part = folder.path("part.json");
    exits(0, &format!("complete {fold} --certificate {part}"));
    let lcp = folder.write(
        "lcp.json",
        r#"{"format":"mceip-mcp/1","m":[["2","1"],["1","2"]],"q":["-5","-6"]}"#,
    );

    let conform = "conform --case table1-000 --time-limit 5 --markdown FILE -- true";
    vec![
        (format!("complete {fold} --certificate FILE"), 0),
        (format!("solve {fold} --certificate FILE"), 0),
        (format!("solve {fold} --trace FILE"), 0),
        (format!("solve {lcp} --certificate FILE"), 0),
        (format!("certify {fold} {report} --out FILE"), 0),
        (
            format!("merge --problem {fold} {part} --certificate FILE"),
            0,
        ),
        (conform.to_owned(), 1),
    ]
}

/// `complete g20.json --certificate c > /dev/full` ended with exit 2 and without a certificate.
#[test]
fn files_are_written_where_nothing_can_be_printed() {
    let folder = Folder::new();
    for (k, (command, expected)) in writers(&folder).into_iter().enumerate() {
        let files =
            ["plain", "full", "closed", "mute"].map(|name| folder.path(&format!("{name}-{k}")));
        let runs = files.each_ref().map(|file| command.replace("FILE", file));

        let plain = code(&runs[0], Stdio::null(), Stdio::piped());
        assert_eq!(plain.0, Some(expected), "{command}: {}", plain.1);
        let written = std::fs::read_to_string(&files[0]).unwrap();

        // A full disk is an error, but for `certify --out`, which prints nothing.
        let on_full = if command.starts_with("certify") {
            expected
        } else {
            2
        };
        let (got, said) = code(&runs[1], full(), Stdio::piped());
        assert_eq!(got, Some(on_full), "{command}: {said}");
        assert_eq!(said.contains("cannot write stdout"), on_full == 2, "{said}");

        // A reader that has gone away is none.
        let (got, said) = code(&runs[2], closed_pipe(), Stdio::piped());
        assert_eq!(got, Some(expected), "{command}: {said}");
        let (got, _) = code(&runs[3], closed_pipe(), closed_pipe());
        assert_eq!(got, Some(expected), "{command}");

        for file in &files[1..] {
            let again = std::fs::read_to_string(file).unwrap();
            assert_eq!(again, written, "{command} {file}");
        }
    }
}

#[test]
fn errors_that_nobody_reads_are_exit_2_all_the_same() {
    for command in ["complete /nowhere/problem.json", "solve --no-such-option"] {
        assert_eq!(code(command, Stdio::null(), closed_pipe()).0, Some(2));
        assert_eq!(code(command, closed_pipe(), full()).0, Some(2));
    }

    // Points without a certificate are named on stderr.
    let fold = example("fold");
    let certify = format!("certify {fold} {fold}");
    assert_eq!(code(&certify, closed_pipe(), closed_pipe()).0, Some(2));
    assert_eq!(code("--help", full(), full()).0, Some(2));
}

/// A terminal that was closed: the run ended with exit 101, by a panic, and without a certificate.
#[test]
fn a_terminal_that_is_closed_takes_nothing_with_it() {
    let folder = Folder::new();
    let problem = folder.write("graph.json", &graph_text(9));
    let certificate = folder.path("c.json");
    let command = format!("complete {problem} --threads 1 --certificate {certificate}");
    let output = Command::new("python3")
        .args([&edge("hangup.py"), env!("CARGO_BIN_EXE_mceip")])
        .args(command.split(' '))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);

    // A hangup is an interrupt; a machine may be quick enough to finish before.
    assert!(matches!(said.trim(), "130" | "0"), "{said:?} {output:?}");
    assert_accepted(&problem, &certificate);
}

/// The problem of the complete graph: 2^n - 1 solutions, one for each support.
fn graph_text(vertices: usize) -> String {
    problem_text(&known::complete_graph(vertices).unwrap().problem)
}

/// The checker accepts it, as complete or as undecided.
#[track_caller]
fn assert_accepted(problem: &str, certificate: &str) {
    let checked = run(&format!("check {problem} {certificate}"));
    assert!(checked.stdout.contains("ACCEPTED"), "{checked:?}");
    assert!(matches!(checked.code, Some(0 | 3)), "{checked:?}");
}

/// A run that is killed after so many milliseconds, or has ended before.
fn killed_after(command: &str, milliseconds: u64) {
    let mut program = program(command);
    program.stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = program.spawn().unwrap();
    std::thread::sleep(Duration::from_millis(milliseconds));
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Files that are no certificate, no problem, and not left behind under the name of a part.
fn others(folder: &Path) -> Vec<String> {
    let mut others = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let is_part = name.starts_with(".mceip-") && name.ends_with(".part");
        if !is_part && !name.ends_with(".json") {
            others.push(name);
        }
    }
    others
}

/// Kills `complete` after so many milliseconds each time; the certificate is whole, accepted, and
/// gone on with by the next run. Returns how many of the runs had proved something when they ended.
fn complete_is_killed(vertices: usize, moments: &[u64]) -> usize {
    let folder = Folder::new();
    let problem = folder.write("problem.json", &graph_text(vertices));
    let certificate = folder.path("c.json");
    let begin =
        format!("complete {problem} --threads 2 --checkpoint 0.02 --certificate {certificate}");
    let go_on = format!("{begin} --resume {certificate}");
    let mut kept = 0;

    for &moment in moments {
        let exists = Path::new(&certificate).exists();
        killed_after(if exists { &go_on } else { &begin }, moment);
        if Path::new(&certificate).exists() {
            assert_accepted(&problem, &certificate);
            kept += 1;
        }
        assert_eq!(others(Path::new(&folder.path(""))), [""; 0]);
    }

    kept
}

/// Kills `analyze` after so many milliseconds each time: each certificate that is there is accepted
/// for the problem beside it. Returns how many there were.
fn analyze_is_killed(problem: &str, moments: &[u64]) -> usize {
    let mut kept = 0;
    for &moment in moments {
        let folder = Folder::new();
        let proofs = folder.path("proofs");
        killed_after(
            &format!("analyze {problem} --certificates {proofs}"),
            moment,
        );
        if !Path::new(&proofs).exists() {
            continue;
        }

        assert_eq!(others(Path::new(&proofs)), [""; 0]);
        for entry in std::fs::read_dir(&proofs).unwrap() {
            let certificate = entry.unwrap().path().display().to_string();
            if certificate.ends_with(".certificate.json") {
                let problem = certificate.replace(".certificate.", ".problem.");
                let checked = run(&format!("check {problem} {certificate}"));
                assert!(matches!(checked.code, Some(0 | 3)), "{checked:?}");
                kept += 1;
            }
        }
    }

    kept
}

/// Kills `campaign` after so many milliseconds each time: its state is always gone on from.
fn campaign_is_killed(moments: &[u64]) {
    let folder = Folder::new();
    let state = folder.path("state.json");
    let campaign = format!("campaign --family planted --state {state} --count");
    for &moment in moments {
        killed_after(&format!("{campaign} 1000000"), moment);
        exits(0, &format!("{campaign} 1"));
    }
}

#[test]
fn a_search_that_is_killed_has_kept_what_it_had_proved() {
    let kept = complete_is_killed(10, &[30, 400, 600]);
    assert!(kept > 0);
    analyze_is_killed(&example("fold"), &[1]);
    campaign_is_killed(&[150]);
}

#[test]
#[ignore = "takes minutes: kills each long command at fifty moments"]
fn fifty_kills_of_each_long_command_leave_whole_files() {
    // Moments spread evenly over one and a half seconds, in no order.
    let moments: Vec<u64> = (0..50).map(|k| (k * 619) % 1500).collect();
    let body = repository("tests/program/l-body-172.json");
    assert!(complete_is_killed(12, &moments) > 0);
    assert!(analyze_is_killed(&body, &moments) > 0);
    campaign_is_killed(&moments);
}

/// What is written while the search goes on leaves open what is to come, and an interrupt, a
/// hangup or the end write the same file as without it.
#[test]
fn checkpoints_change_nothing_of_the_certificate() {
    let folder = Folder::new();
    let problem = folder.write("problem.json", &graph_text(8));
    let [rare, often] = ["rare.json", "often.json"].map(|name| folder.path(name));
    exits(0, &format!("complete {problem} --certificate {rare}"));
    let run = run(&format!(
        "complete {problem} --certificate {often} --checkpoint 0.001"
    ));

    assert_eq!(run.code, Some(0), "{run:?}");
    assert_eq!(read(&rare), read(&often));

    // A search that is over within a millisecond has not said anything.
    let notes = run.stderr.lines().count();
    assert!(notes <= 1, "{}", run.stderr);
    assert!(
        notes == 0 || run.stderr.contains("--resume"),
        "{}",
        run.stderr
    );
}

/// Files that show the path alone are on the disk while its critical friction is still sought.
#[test]
fn a_path_is_written_before_the_questions_about_it() {
    let folder = Folder::new();
    let [picture, states, reactions] = ["p.svg", "states", "r.csv"].map(|name| folder.path(name));
    let loads = example("own-critical");
    let files = format!("--picture {picture} --states {states} --reactions {reactions}");
    let mut path = started(&format!(
        "path {loads} {files} --own-critical 0.7,1.5 --grid 10000"
    ));

    let begun = Instant::now();
    while !Path::new(&picture).exists() && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(path.try_wait().unwrap().is_none(), "it is at work");
    for file in [picture, format!("{states}/stretch-003.json"), reactions] {
        assert!(Path::new(&file).exists(), "{file}");
    }

    interrupt(&path, Duration::ZERO);
    assert_eq!(path.wait().unwrap().code(), Some(130));
}

/// An interrupt ends a check, which has nothing to keep, with exit 130.
#[test]
fn a_check_answers_an_interrupt() {
    let folder = Folder::new();
    let problem = folder.write("problem.json", &graph_text(11));
    let certificate = folder.path("c.json");
    // Half of the work is enough to check.
    exits(
        3,
        &format!("complete {problem} --shard 1/2 --certificate {certificate}"),
    );

    let check = started(&format!("check {problem} {certificate}"));
    interrupt(&check, Duration::ZERO);
    let output = check.wait_with_output().unwrap();
    let code = output.status.code();
    assert!(matches!(code, Some(130 | 3)), "{output:?}");
    assert_eq!(output.stdout.is_empty(), code == Some(130), "{output:?}");
}

/// So do commands that wait for their input.
#[test]
fn a_command_without_anything_to_keep_answers_an_interrupt() {
    for command in ["reduce -", "check - c.json"] {
        let mut waiting = program(command);
        let mut child = waiting
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // Open until it has ended: it waits for more.
        let stdin = child.stdin.take();
        interrupt(&child, Duration::ZERO);
        assert_eq!(child.wait().unwrap().code(), Some(130), "{command}");
        drop(stdin);
    }
}

/// A trace that cannot be written takes neither the certificate nor the answer along.
#[test]
fn what_cannot_be_written_takes_nothing_else_along() {
    let folder = Folder::new();
    let certificate = folder.path("c.json");
    let problem = example("fold");
    let command = format!("solve {problem} --trace /dev/full --certificate {certificate}");
    let run = run(&command);
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(run.stdout.contains("certified"), "{run:?}");
    exits(0, &format!("check {problem} {certificate}"));
}

/// What `path` cannot write is told once, when it fails.
#[test]
fn an_output_of_path_that_cannot_be_written_is_told_once() {
    let loads = example("own-critical");
    let run = run(&format!("path {loads} --reactions /dev/full"));
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(!run.stdout.is_empty(), "{run:?}");
    assert_eq!(run.stderr.matches("/dev/full").count(), 1, "{run:?}");
}
