// SPDX-License-Identifier: Apache-2.0
//! Handles of msq: cloning adds a reference, dropping removes one.

/// Declares a handle type over an opaque type of msq. Objects of msq are immutable and may be used
/// by any number of threads at once, so handles are `Send` and `Sync`.
macro_rules! handle {
    ($(#[$doc:meta])* $name:ident, $raw:ident, $retain:ident, $release:ident) => {
        $(#[$doc])*
        pub struct $name(std::ptr::NonNull<sys::$raw>);

        unsafe impl Send for $name {}
        unsafe impl Sync for $name {}

        impl $name {
            /// The handle of the C ABI, for calls of `msq_sys`. It lives as long as this object.
            pub fn as_ptr(&self) -> *mut sys::$raw {
                self.0.as_ptr()
            }

            /// Takes over the reference that a constructor of the C ABI returned.
            ///
            /// # Safety
            /// The pointer is a valid handle, and its reference is given up by the caller.
            pub unsafe fn from_raw(raw: *mut sys::$raw) -> $name {
                $name(std::ptr::NonNull::new(raw).expect("a handle of msq"))
            }

            #[allow(dead_code)]
            pub(crate) fn make(
                create: impl FnOnce(*mut *mut sys::$raw) -> sys::msq_status,
            ) -> crate::Result<$name> {
                let mut raw = std::ptr::null_mut();
                crate::check(create(&mut raw))?;
                Ok(unsafe { $name::from_raw(raw) })
            }
        }

        impl Clone for $name {
            fn clone(&self) -> $name {
                unsafe { sys::$retain(self.as_ptr()) };
                $name(self.0)
            }
        }

        impl Drop for $name {
            fn drop(&mut self) {
                unsafe { sys::$release(self.as_ptr()) };
            }
        }

        impl std::fmt::Debug for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                write!(f, concat!(stringify!($name), "({:p})"), self.0)
            }
        }
    };
}

/// A definition of the C ABI with its defaults.
macro_rules! definition {
    ($init:ident, $kind:ident) => {{
        let mut def = std::mem::MaybeUninit::<sys::$kind>::zeroed();
        unsafe {
            crate::check(sys::$init(def.as_mut_ptr(), std::mem::size_of::<sys::$kind>()))?;
            def.assume_init()
        }
    }};
}

/// Fills in a report of the C ABI.
macro_rules! report {
    ($kind:ident, $call:expr) => {{
        let mut report: sys::$kind = unsafe { std::mem::zeroed() };
        report.struct_size = std::mem::size_of::<sys::$kind>() as u32;
        #[allow(clippy::redundant_closure_call)]
        crate::check(unsafe { ($call)(&mut report as *mut sys::$kind) })?;
        report
    }};
}
