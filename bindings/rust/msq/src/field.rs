// SPDX-License-Identifier: Apache-2.0
//! Fields: numbers that vary in space.
use std::ffi::CString;
use std::os::raw::c_void;

use crate::array::{elements, elements_mut, product};
use crate::context::Context;
use crate::error::{forget, guarded};
use crate::{sys, Error, Result};

handle!(
    /// A number at every point of space.
    Field, msq_field, msq_field_retain, msq_field_release
);

/// Writes `values[i]`, the value at `points[i]`. An error stops the call with the host's code.
pub type ValuesFn =
    Box<dyn Fn(&[[f64; 3]], &mut [f64]) -> std::result::Result<(), i32> + Send + Sync>;

unsafe extern "C" fn evaluate(
    user: *mut c_void,
    points: *const f64,
    count: u64,
    values: *mut f64,
) -> i32 {
    let function = &*(user as *const ValuesFn);
    let points = elements(points as *const [f64; 3], count as usize);
    let values = elements_mut(values, count as usize);
    guarded(|| function(points, values))
}

unsafe extern "C" fn forget_values(user: *mut c_void) {
    forget::<ValuesFn>(user);
}

impl Field {
    /// Linear from one plane to the other, constant beyond them.
    pub fn gradient(
        context: &Context,
        from: [f64; 3],
        from_value: f64,
        to: [f64; 3],
        to_value: f64,
    ) -> Result<Field> {
        Field::make(|raw| unsafe {
            let (from, to) = (from.as_ptr(), to.as_ptr());
            sys::msq_field_gradient(context.as_ptr(), from, from_value, to, to_value, raw)
        })
    }

    /// Samples at origin + (i, j, k) * spacing, x fastest, interpolated linearly along each axis and
    /// constant beyond the border. The values are copied.
    pub fn grid(
        context: &Context,
        values: &[f64],
        size: [u64; 3],
        origin: [f64; 3],
        spacing: [f64; 3],
    ) -> Result<Field> {
        if product(size) != Some(values.len() as u64) {
            return Err(Error::argument(format!(
                "there are {} values; size has {} x {} x {}",
                values.len(),
                size[0],
                size[1],
                size[2]
            )));
        }
        let mut def = definition!(msq_grid_field_def_init, msq_grid_field_def);
        def.image.values = values.as_ptr() as *const c_void;
        def.image.value_type = sys::MSQ_FLOAT64;
        def.image.size = size;
        def.image.grid.origin = origin;
        def.image.grid.cell_size = spacing;
        Field::make(|raw| unsafe { sys::msq_field_grid(context.as_ptr(), &def, raw) })
    }

    /// A formula of x, y and z, with values from low to high.
    pub fn expression(context: &Context, formula: &str, low: f64, high: f64) -> Result<Field> {
        let text = CString::new(formula)
            .map_err(|_| Error::argument("the expression has a zero byte".to_string()))?;
        let mut def = definition!(msq_expression_field_def_init, msq_expression_field_def);
        def.expression = text.as_ptr();
        def.low = low;
        def.high = high;
        Field::make(|raw| unsafe { sys::msq_field_expression(context.as_ptr(), &def, raw) })
    }

    /// A closure with values from low to high. lipschitz: no two values differ by more than this
    /// times the distance of their points. concurrent: it may run on several threads at once.
    pub fn host(
        context: &Context,
        low: f64,
        high: f64,
        lipschitz: f64,
        concurrent: bool,
        function: ValuesFn,
    ) -> Result<Field> {
        let mut def = definition!(msq_host_field_def_init, msq_host_field_def);
        def.low = low;
        def.high = high;
        def.lipschitz = lipschitz;
        def.concurrent = i32::from(concurrent);
        def.evaluate = Some(evaluate);
        let user = Box::into_raw(Box::new(function)) as *mut c_void;
        def.user = user;
        def.release = Some(forget_values);
        let made = Field::make(|raw| unsafe { sys::msq_field_host(context.as_ptr(), &def, raw) });
        if made.is_err() {
            unsafe { forget_values(user) };
        }
        made
    }
}

/// A parameter: a number or a field.
#[derive(Clone, Debug)]
pub enum Param {
    Value(f64),
    Field(Field),
}

impl From<f64> for Param {
    fn from(value: f64) -> Param {
        Param::Value(value)
    }
}

impl From<Field> for Param {
    fn from(field: Field) -> Param {
        Param::Field(field)
    }
}

impl Default for Param {
    fn default() -> Param {
        Param::Value(0.0)
    }
}

impl Param {
    /// Valid as long as this parameter.
    pub(crate) fn raw(&self) -> sys::msq_param {
        match self {
            Param::Value(value) => sys::msq_param { value: *value, field: std::ptr::null() },
            Param::Field(field) => sys::msq_param { value: 0.0, field: field.as_ptr() },
        }
    }
}
