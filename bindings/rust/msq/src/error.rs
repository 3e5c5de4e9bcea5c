// SPDX-License-Identifier: Apache-2.0
//! Statuses as errors, and panics of closures carried through calls of msq.
use std::any::Any;
use std::ffi::CStr;
use std::fmt;
use std::os::raw::c_void;
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::{Mutex, PoisonError};

use crate::sys;

/// A call of msq failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    status: sys::msq_status,
    host_code: i32,
    message: String,
}

/// The result of calls that may fail.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// One of `msq_sys::MSQ_E_*`.
    pub fn status(&self) -> sys::msq_status {
        self.status
    }

    /// With `MSQ_E_HOST`: the code that a closure returned as its error. 0 also means that a closure
    /// wrote an invalid value.
    pub fn host_code(&self) -> i32 {
        self.host_code
    }

    /// What is wrong, with the offending value and its limit.
    pub fn message(&self) -> &str {
        &self.message
    }

    pub(crate) fn argument(message: String) -> Error {
        Error { status: sys::MSQ_E_ARGUMENT, host_code: 0, message }
    }

    pub(crate) fn memory(message: String) -> Error {
        Error { status: sys::MSQ_E_MEMORY, host_code: 0, message }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let name = unsafe { CStr::from_ptr(sys::msq_status_name(self.status)) };
        write!(f, "{}: {}", name.to_string_lossy(), self.message)
    }
}

impl std::error::Error for Error {}

/// The first code that stands for a `Stop`. The others are below it.
const FIRST_CODE: i32 = -(1 << 30);

/// How a closure stopped a call, where msq cannot carry the closure's own code.
enum Stop {
    Panic(Box<dyn Any + Send>),
    /// 0, which is no error for msq, or one of the codes from `FIRST_CODE` on.
    Code(i32),
}

/// Stops on their way through C, each under a code of its own, by which the call that it makes fail
/// finds it. Closures that stop one call on several threads leave those that the call does not
/// report, so the oldest give way.
struct Stops {
    last_code: i32,
    kept: Vec<(i32, Stop)>,
}

const MAX_STOPS: usize = 256;

static STOPS: Mutex<Stops> = Mutex::new(Stops { last_code: FIRST_CODE, kept: Vec::new() });

impl Stops {
    /// Returns the code, and the stop that gives way.
    fn keep(&mut self, stop: Stop) -> (i32, Option<(i32, Stop)>) {
        let oldest = (self.kept.len() == MAX_STOPS).then(|| self.kept.remove(0));
        self.last_code = if self.last_code == i32::MIN { FIRST_CODE } else { self.last_code - 1 };
        self.kept.push((self.last_code, stop));
        (self.last_code, oldest)
    }

    fn take(&mut self, code: i32) -> Option<Stop> {
        let at = self.kept.iter().rposition(|(kept, _)| *kept == code)?;
        Some(self.kept.remove(at).1)
    }
}

fn keep(stop: Stop) -> i32 {
    // What gives way is dropped without the lock: the drop of a panic's value may call msq.
    let (code, _oldest) = STOPS.lock().unwrap_or_else(PoisonError::into_inner).keep(stop);
    code
}

fn take(code: i32) -> Option<Stop> {
    STOPS.lock().unwrap_or_else(PoisonError::into_inner).take(code)
}

/// Runs a closure for msq, and returns the code that msq takes.
pub(crate) fn guarded(run: impl FnOnce() -> std::result::Result<(), i32>) -> i32 {
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(())) => 0,
        Ok(Err(code)) if code == 0 || code <= FIRST_CODE => keep(Stop::Code(code)),
        Ok(Err(code)) => code,
        Err(panic) => keep(Stop::Panic(panic)),
    }
}

/// Drops what a definition boxed. A panic of its drop ends here: no call reports it.
pub(crate) unsafe fn forget<T>(user: *mut c_void) {
    let _ = catch_unwind(AssertUnwindSafe(|| drop(Box::from_raw(user as *mut T))));
}

/// The result of a call of msq on this thread. Resumes the panic of a closure that stopped it.
pub fn check(status: sys::msq_status) -> Result<()> {
    if status == sys::MSQ_OK {
        return Ok(());
    }
    let host_code = if status == sys::MSQ_E_HOST { unsafe { sys::msq_error_host_code() } } else { 0 };
    match take(host_code) {
        Some(Stop::Panic(panic)) => resume_unwind(panic),
        Some(Stop::Code(code)) => {
            let message = format!("a closure returned the error {code}");
            Err(Error { status, host_code: code, message })
        }
        None => {
            let message = unsafe { CStr::from_ptr(sys::msq_error_message()) };
            Err(Error { status, host_code, message: message.to_string_lossy().into_owned() })
        }
    }
}
