// SPDX-License-Identifier: Apache-2.0
//! Arrays that cross the C ABI.
use std::slice;

use crate::{Error, Result};

/// An array of C. It may be NULL if it is empty.
///
/// # Safety
/// As of `slice::from_raw_parts`, if the array is not empty.
pub(crate) unsafe fn elements<'a, T>(data: *const T, count: usize) -> &'a [T] {
    if count == 0 {
        return &[];
    }
    slice::from_raw_parts(data, count)
}

/// As `elements`, to be written.
///
/// # Safety
/// As of `slice::from_raw_parts_mut`, if the array is not empty.
pub(crate) unsafe fn elements_mut<'a, T>(data: *mut T, count: usize) -> &'a mut [T] {
    if count == 0 {
        return &mut [];
    }
    slice::from_raw_parts_mut(data, count)
}

/// The number of samples of a grid. None: over 2^64 - 1.
pub(crate) fn product(counts: [u64; 3]) -> Option<u64> {
    counts.iter().try_fold(1u64, |all, count| all.checked_mul(*count))
}

/// The values that fill writes. It gets memory for count values, and writes all if it succeeds.
pub(crate) fn filled<T>(count: u64, fill: impl FnOnce(*mut T) -> Result<()>) -> Result<Vec<T>> {
    let too_many = || Error::memory(format!("there is no memory for {count} values"));
    let length = usize::try_from(count).map_err(|_| too_many())?;
    let mut values = Vec::new();
    values.try_reserve_exact(length).map_err(|_| too_many())?;
    fill(values.as_mut_ptr())?;
    unsafe { values.set_len(length) };
    Ok(values)
}
