//! Long work beside an interpreter that stays awake.
//!
//! The work runs on a thread of its own without the interpreter's lock. This thread takes the lock
//! twenty times a second, calls the listener with the last progress, and asks for signals: Ctrl-C,
//! and an exception of the listener, end the work at its next step.

use mceip::{Cancel, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// How long signals and progress wait.
const TICK: Duration = Duration::from_millis(50);

/// The last progress of the work, as the listener gets it.
type Latest = Mutex<Option<(String, u64, Option<u64>)>>;

/// What the work reports to.
pub(crate) type Hear<'a> = &'a (dyn Fn(&Progress<'_>) + Sync);

/// Runs `work` and returns its result, or the exception that ended it.
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
    let waiting = thread::current();

    thread::scope(|scope| {
        let worker = scope.spawn(|| {
            let result = work(&cancel, &hear);
            waiting.unpark();
            result
        });

        let mut exception = None;
        while !worker.is_finished() {
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
            (None, Err(_)) => Err(PyRuntimeError::new_err("a fault of mceip: a thread panicked")),
        }
    })
}

/// Asks for signals and tells the listener what has been heard.
fn attend(py: Python<'_>, listener: Option<&Py<PyAny>>, latest: &Latest) -> PyResult<()> {
    py.check_signals()?;

    let heard = latest
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .take();
    if let (Some(listener), Some(heard)) = (listener, heard) {
        listener.call1(py, heard)?;
    }
    Ok(())
}
