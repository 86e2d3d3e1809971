//! SIGINT to a run of the program that is at work.
#![allow(dead_code, missing_docs, unreachable_pub)]

use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// Longer than a start takes on a machine with other work.
const LONGEST_START: Duration = Duration::from_secs(60);

/// Sends SIGINT once the program catches it, and after `at_work` more.
#[track_caller]
pub fn interrupt(child: &Child, at_work: Duration) {
    let start = Instant::now();
    while !catches_interrupt(child.id()) && start.elapsed() < LONGEST_START {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(at_work);

    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(kill.success());
}

/// Has the process a handler for SIGINT (number 2, so bit 1 of `SigCgt`, proc(5))? Where there is
/// no such file: yes, after a second.
fn catches_interrupt(process: u32) -> bool {
    let Ok(status) = std::fs::read_to_string(format!("/proc/{process}/status")) else {
        std::thread::sleep(Duration::from_secs(1));
        return true;
    };

    let mask = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    let mask = mask.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok());
    mask.is_some_and(|mask| mask & 0b10 != 0)
}
