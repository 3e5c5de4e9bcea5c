// SPDX-License-Identifier: Apache-2.0
//! Contexts and jobs.
use std::ffi::CStr;
use std::os::raw::{c_char, c_void};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::ptr;

use crate::error::forget;
use crate::{check, sys, Result};

handle!(
    /// Threads, cell cache and memory limit that objects share.
    Context, msq_context, msq_context_retain, msq_context_release
);

handle!(
    /// Progress and cancellation of one long call; another thread may cancel it.
    Job, msq_job, msq_job_retain, msq_job_release
);

type Warning = Box<dyn Fn(i32, &str) + Send + Sync>;

/// Settings of a context.
#[derive(Default)]
pub struct ContextOptions {
    /// Threads per call; 0: one per core.
    pub threads: u32,
    /// Size of the cell cache in bytes; None: the default of msq.
    pub cache_bytes: Option<u64>,
    /// Limit of the memory accounted to the context; 0: none.
    pub memory_limit: u64,
    /// Receives warnings: an `MSQ_WARNING_*` and the message. It must not panic.
    pub warning: Option<Warning>,
}

unsafe extern "C" fn warn(user: *mut c_void, code: i32, message: *const c_char) {
    let warning = &*(user as *const Warning);
    let message = CStr::from_ptr(message).to_string_lossy();
    let _ = catch_unwind(AssertUnwindSafe(|| warning(code, &message)));
}

unsafe extern "C" fn forget_warning(user: *mut c_void) {
    forget::<Warning>(user);
}

impl Context {
    pub fn new() -> Result<Context> {
        Context::with(ContextOptions::default())
    }

    pub fn with(options: ContextOptions) -> Result<Context> {
        let mut def = definition!(msq_context_def_init, msq_context_def);
        def.threads = options.threads;
        if let Some(bytes) = options.cache_bytes {
            def.cache_bytes = bytes;
        }
        def.memory_limit = options.memory_limit;
        let mut user = ptr::null_mut();
        if let Some(warning) = options.warning {
            user = Box::into_raw(Box::new(warning));
            def.warning = Some(warn);
            def.warning_user = user as *mut c_void;
            def.warning_release = Some(forget_warning);
        }
        let made = Context::make(|raw| unsafe { sys::msq_context_create(&def, raw) });
        if made.is_err() && !user.is_null() {
            unsafe { forget_warning(user as *mut c_void) };
        }
        made
    }

    pub fn memory(&self) -> Result<sys::msq_memory_report> {
        Ok(report!(msq_memory_report, |r| sys::msq_context_memory(self.as_ptr(), r)))
    }

    pub fn cache_stats(&self) -> Result<sys::msq_cache_report> {
        Ok(report!(msq_cache_report, |r| sys::msq_cache_stats(self.as_ptr(), r)))
    }

    pub fn clear_cache(&self) -> Result<()> {
        check(unsafe { sys::msq_cache_clear(self.as_ptr()) })
    }
}

impl Job {
    pub fn new() -> Result<Job> {
        Job::make(|raw| unsafe { sys::msq_job_create(raw) })
    }

    pub fn cancel(&self) -> Result<()> {
        check(unsafe { sys::msq_job_cancel(self.as_ptr()) })
    }

    /// 0 to 1.
    pub fn progress(&self) -> Result<f64> {
        let mut fraction = 0.0;
        check(unsafe { sys::msq_job_progress(self.as_ptr(), &mut fraction) })?;
        Ok(fraction)
    }
}

/// The job of a call, or NULL.
pub(crate) fn raw_job(job: Option<&Job>) -> *mut sys::msq_job {
    job.map_or(ptr::null_mut(), Job::as_ptr)
}
