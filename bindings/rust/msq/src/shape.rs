// SPDX-License-Identifier: Apache-2.0
//! Coarse shapes.
use std::ffi::CString;
use std::path::Path;
use std::ptr;

use crate::context::{raw_job, Context, Job};
use crate::{sys, Error, Result};

handle!(
    /// A coarse solid.
    Shape, msq_shape, msq_shape_retain, msq_shape_release
);

impl Shape {
    /// Reads a mesh file in millimetres.
    pub fn from_file(context: &Context, path: impl AsRef<Path>, job: Option<&Job>) -> Result<Shape> {
        let path = path.as_ref();
        let text = path.to_str().and_then(|text| CString::new(text).ok()).ok_or_else(|| {
            Error::argument(format!("the path {path:?} is not UTF-8, or has a zero byte"))
        })?;
        Shape::make(|raw| unsafe {
            sys::msq_shape_from_file(context.as_ptr(), text.as_ptr(), ptr::null(), raw, raw_job(job))
        })
    }

    /// Reads the bytes of a mesh file in millimetres. format: an `MSQ_FORMAT_*` other than AUTO.
    pub fn from_memory(
        context: &Context,
        bytes: &[u8],
        format: i32,
        job: Option<&Job>,
    ) -> Result<Shape> {
        let mut def = definition!(msq_file_def_init, msq_file_def);
        def.format = format;
        Shape::make(|raw| unsafe {
            sys::msq_shape_from_memory(
                context.as_ptr(),
                bytes.as_ptr() as *const _,
                bytes.len() as u64,
                &def,
                raw,
                raw_job(job),
            )
        })
    }

    pub fn from_mesh(
        context: &Context,
        vertices: &[[f64; 3]],
        triangles: &[[u32; 3]],
    ) -> Result<Shape> {
        let mut def = definition!(msq_mesh_def_init, msq_mesh_def);
        def.coordinate_type = sys::MSQ_FLOAT64;
        def.vertices = vertices.as_ptr() as *const _;
        def.vertex_count = vertices.len() as u64;
        def.triangles = triangles.as_ptr() as *const u32;
        def.triangle_count = triangles.len() as u64;
        Shape::make(|raw| unsafe { sys::msq_shape_from_mesh(context.as_ptr(), &def, raw) })
    }

    pub fn cuboid(context: &Context, min: [f64; 3], max: [f64; 3]) -> Result<Shape> {
        Shape::make(|raw| unsafe {
            sys::msq_shape_from_box(context.as_ptr(), min.as_ptr(), max.as_ptr(), raw)
        })
    }

    pub fn sphere(context: &Context, center: [f64; 3], radius: f64) -> Result<Shape> {
        Shape::make(|raw| unsafe {
            sys::msq_shape_from_sphere(context.as_ptr(), center.as_ptr(), radius, raw)
        })
    }

    pub fn cylinder(context: &Context, from: [f64; 3], to: [f64; 3], radius: f64) -> Result<Shape> {
        Shape::make(|raw| unsafe {
            sys::msq_shape_from_cylinder(context.as_ptr(), from.as_ptr(), to.as_ptr(), radius, raw)
        })
    }

    pub fn all_space(context: &Context) -> Result<Shape> {
        Shape::make(|raw| unsafe { sys::msq_shape_all_space(context.as_ptr(), raw) })
    }

    /// matrix: three rows of four.
    pub fn placed(&self, matrix: [[f64; 4]; 3]) -> Result<Shape> {
        Shape::make(|raw| unsafe {
            sys::msq_shape_placed(self.as_ptr(), matrix.as_ptr() as *const f64, raw)
        })
    }

    pub fn offset(&self, distance: f64) -> Result<Shape> {
        Shape::make(|raw| unsafe { sys::msq_shape_offset(self.as_ptr(), distance, raw) })
    }

    /// operation: an `MSQ_BOOLEAN_*`.
    pub fn boolean(operation: i32, shapes: &[&Shape]) -> Result<Shape> {
        let raws: Vec<*const sys::msq_shape> =
            shapes.iter().map(|shape| shape.as_ptr() as *const _).collect();
        Shape::make(|raw| unsafe {
            sys::msq_shape_boolean(operation, raws.as_ptr(), raws.len() as u64, raw)
        })
    }

    pub fn info(&self) -> Result<sys::msq_shape_report> {
        Ok(report!(msq_shape_report, |r| sys::msq_shape_info(self.as_ptr(), r)))
    }
}
