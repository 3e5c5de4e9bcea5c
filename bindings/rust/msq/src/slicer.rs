// SPDX-License-Identifier: Apache-2.0
//! Layers.
use std::os::raw::c_void;

use crate::array::{elements, filled};
use crate::context::{raw_job, Job};
use crate::error::guarded;
use crate::model::Model;
use crate::{check, sys, Result};

handle!(
    /// Layers of a model.
    Slicer, msq_slicer, msq_slicer_retain, msq_slicer_release
);

/// How a model is cut into layers.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Size of a pixel in model units.
    pub pitch: f64,
    pub layer_height: f64,
    /// An `MSQ_LAYER_*` with data.
    pub output: i32,
}

/// One layer, valid until the closure returns.
pub struct LayerView<'a> {
    pub index: u64,
    pub z: f64,
    pub width: u32,
    pub height: u32,
    /// Bytes from one row to the next.
    pub stride: usize,
    /// height rows of stride bytes. Contours: empty.
    pub data: &'a [u8],
    /// Number of solid samples.
    pub inside_count: u64,
}

/// One layer of an iterator.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    pub index: u64,
    pub z: f64,
    pub data: Vec<u8>,
}

unsafe extern "C" fn take_layer<F>(user: *mut c_void, layer: *const sys::msq_layer) -> i32
where
    F: FnMut(LayerView) -> std::result::Result<(), i32>,
{
    let (function, layer) = (&mut *(user as *mut F), &*layer);
    let stride = layer.stride as usize;
    guarded(|| {
        function(LayerView {
            index: layer.index,
            z: layer.z,
            width: layer.width,
            height: layer.height,
            stride,
            data: elements(layer.data, stride * layer.height as usize),
            inside_count: layer.inside_count,
        })
    })
}

impl Slicer {
    pub fn new(model: &Model, plan: Plan) -> Result<Slicer> {
        let mut def = definition!(msq_slicer_def_init, msq_slicer_def);
        def.output = plan.output;
        def.pitch = [plan.pitch; 2];
        def.layer_height = plan.layer_height;
        Slicer::make(|raw| unsafe { sys::msq_slicer_create(model.as_ptr(), &def, raw) })
    }

    pub fn info(&self) -> Result<sys::msq_slicer_report> {
        Ok(report!(msq_slicer_report, |r| sys::msq_slicer_info(self.as_ptr(), r)))
    }

    /// Gives count layers from first on to a closure, in ascending order, on this thread. An error
    /// of the closure is the host's code, and stops the run.
    pub fn run<F>(&self, first: u64, count: u64, mut take: F, job: Option<&Job>) -> Result<()>
    where
        F: FnMut(LayerView) -> std::result::Result<(), i32>,
    {
        check(unsafe {
            sys::msq_slicer_run(
                self.as_ptr(),
                first,
                count,
                Some(take_layer::<F>),
                &mut take as *mut F as *mut c_void,
                raw_job(job),
            )
        })
    }

    /// One layer.
    pub fn layer(&self, index: u64, job: Option<&Job>) -> Result<Layer> {
        let bytes = self.info()?.layer_bytes;
        let mut z = 0.0;
        check(unsafe { sys::msq_slicer_layer_z(self.as_ptr(), index, &mut z) })?;
        let data = filled(bytes, |data| {
            check(unsafe { sys::msq_slice_layer(self.as_ptr(), index, data, bytes, raw_job(job)) })
        })?;
        Ok(Layer { index, z, data })
    }

    /// All layers, each made when it is reached.
    pub fn layers(&self) -> Result<impl Iterator<Item = Result<Layer>> + '_> {
        let count = self.info()?.layer_count;
        Ok((0..count).map(move |index| self.layer(index, None)))
    }
}
