//! Long work beside an interpreter that stays awake.
//!
//! The work runs on a thread of its own, and the caller's thread waits without the interpreter's
//! lock, so that other threads of Python go on. It takes the lock twenty times a second, hands the
//! last progress to the listener, and asks for signals: Ctrl-C, and an exception of the listener,
//! end the work at its next step.

use mceip::{Cancel, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// How long signals and progress wait.
const TICK: Duration = Duration::from_millis(50);

/// A line of text, the steps done, and the steps in all where they are known.
type Heard = (String, u64, Option<u64>);

/// The last progress that the listener has not been told.
type Latest = Mutex<Option<Heard>>;

/// What the work reports to.
pub(crate) type Hear<'a> = &'a (dyn Fn(&Progress<'_>) + Sync);

/// Runs `work` and returns its result.
///
/// # Errors
/// The exception that ended it: of a signal, or of the listener.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    listener: Option<&Py<PyAny>>,
    work: impl FnOnce(&Cancel, Hear<'_>) -> T + Send,
) -> PyResult<T> {
    let cancel = Cancel::new();
    let latest = Latest::default();
    let hear = |progress: &Progress<'_>| {
        let heard = (progress.to_string(), progress.done, progress.total);
        *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(heard);
    };
    let is_done = AtomicBool::new(false);
    let waiting = thread::current();

    thread::scope(|scope| {
        let worker = scope.spawn(|| {
            let result = work(&cancel, &hear);
            is_done.store(true, Ordering::Release);
            waiting.unpark();
            result
        });

        let mut exception = None;
        // A thread that has panicked is finished, and has not said that it is done.
        while !is_done.load(Ordering::Acquire) && !worker.is_finished() {
            py.detach(|| thread::park_timeout(TICK));

            if exception.is_none()
                && let Err(raised) = attend(py, listener, &latest)
            {
                cancel.request();
                exception = Some(raised);
            }
        }

        let result = worker.join();
        match (exception, result) {
            (Some(exception), _) => Err(exception),
            (None, Ok(result)) => Ok(result),
            (None, Err(_)) => Err(PyRuntimeError::new_err(
                "a fault of mceip: a thread panicked",
            )),
        }
    })
}

/// Asks for signals, and tells the listener what has been heard.
fn attend(py: Python<'_>, listener: Option<&Py<PyAny>>, latest: &Latest) -> PyResult<()> {
    py.check_signals()?;

    let mut latest = latest.lock().unwrap_or_else(PoisonError::into_inner);
    let heard = latest.take();
    drop(latest); // the listener may take long, and the work reports on

    if let (Some(listener), Some(heard)) = (listener, heard) {
        listener.call1(py, heard)?;
    }
    Ok(())
}
