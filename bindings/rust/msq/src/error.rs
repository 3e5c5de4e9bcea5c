// SPDX-License-Identifier: Apache-2.0
//! Statuses as errors, and panics of closures carried through calls of msq.
use std::any::Any;
use std::ffi::CStr;
use std::fmt;
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::Mutex;

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

    /// With `MSQ_E_HOST`: the code that a closure returned; 0 if it returned an invalid value.
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
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let name = unsafe { CStr::from_ptr(sys::msq_status_name(self.status)) };
        write!(f, "{}: {}", name.to_string_lossy(), self.message)
    }
}

impl std::error::Error for Error {}

/// A panic left a closure: the code that msq carries for it. Others are the host's own codes.
const PANICKED: i32 = i32::MIN;

/// The last panic of a closure. Of closures that panic at the same time, one is resumed.
static PANIC: Mutex<Option<Box<dyn Any + Send>>> = Mutex::new(None);

/// Runs a closure for msq, and returns the code that msq takes.
pub(crate) fn guarded(run: impl FnOnce() -> std::result::Result<(), i32>) -> i32 {
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(())) => 0,
        Ok(Err(code)) => code,
        Err(panic) => {
            if let Ok(mut last) = PANIC.lock() {
                *last = Some(panic);
            }
            PANICKED
        }
    }
}

/// The result of a call of msq on this thread. Resumes the panic of a closure that stopped it.
pub fn check(status: sys::msq_status) -> Result<()> {
    if status == sys::MSQ_OK {
        return Ok(());
    }
    let mut host_code = 0;
    if status == sys::MSQ_E_HOST {
        host_code = unsafe { sys::msq_error_host_code() };
        if host_code == PANICKED {
            let panic = PANIC.lock().ok().and_then(|mut last| last.take());
            resume_unwind(panic.unwrap_or_else(|| Box::new("a closure of msq panicked")));
        }
    }
    let message = unsafe { CStr::from_ptr(sys::msq_error_message()) };
    Err(Error { status, host_code, message: message.to_string_lossy().into_owned() })
}
