// SPDX-License-Identifier: Apache-2.0
//! Models and queries.
use std::os::raw::c_void;
use std::ptr;

use crate::array::{elements, filled, product};
use crate::context::{raw_job, Context, Job};
use crate::error::guarded;
use crate::field::Param;
use crate::shape::Shape;
use crate::structure::Structure;
use crate::{check, sys, Result};

handle!(
    /// A shape with the structures that fill it.
    Model, msq_model, msq_model_retain, msq_model_release
);

/// The points of a grid: origin + (i, j, k) * spacing, x fastest.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    pub origin: [f64; 3],
    pub spacing: [f64; 3],
    pub counts: [u64; 3],
}

/// A slab of a preview mesh. Triangles index all vertices so far.
pub struct MeshSlab<'a> {
    pub first_vertex: u64,
    pub vertices: &'a [[f64; 3]],
    pub normals: &'a [[f32; 3]],
    pub triangles: &'a [[u32; 3]],
}

unsafe extern "C" fn take_slab<F>(user: *mut c_void, slab: *const sys::msq_surface_slab) -> i32
where
    F: FnMut(MeshSlab) -> std::result::Result<(), i32>,
{
    let (function, slab) = (&mut *(user as *mut F), &*slab);
    let (vertices, triangles) = (slab.vertex_count as usize, slab.triangle_count as usize);
    guarded(|| {
        function(MeshSlab {
            first_vertex: slab.first_vertex,
            vertices: elements(slab.vertices as *const [f64; 3], vertices),
            normals: elements(slab.normals as *const [f32; 3], vertices),
            triangles: elements(slab.triangles as *const [u32; 3], triangles),
        })
    })
}

impl Model {
    /// A shape, and structures from coarse to fine.
    pub fn new(context: &Context, shape: &Shape, structures: &[&Structure]) -> Result<Model> {
        Model::with_skin(context, shape, 0.0, structures)
    }

    /// As new; the first structure leaves a solid skin of the given thickness under the shape.
    pub fn with_skin(
        context: &Context,
        shape: &Shape,
        skin: impl Into<Param>,
        structures: &[&Structure],
    ) -> Result<Model> {
        let skin = skin.into();
        let none = Param::default();
        let mut scales = vec![sys::msq_scale_def {
            shape: shape.as_ptr(),
            structure: ptr::null(),
            skin: none.raw(),
            material: ptr::null(),
            skin_material: ptr::null(),
        }];
        for (index, structure) in structures.iter().enumerate() {
            scales.push(sys::msq_scale_def {
                shape: ptr::null(),
                structure: structure.as_ptr(),
                skin: if index == 0 { skin.raw() } else { none.raw() },
                material: ptr::null(),
                skin_material: ptr::null(),
            });
        }
        let mut def = definition!(msq_model_def_init, msq_model_def);
        def.scales = scales.as_ptr();
        def.scale_count = scales.len() as u32;
        def.scale_size = std::mem::size_of::<sys::msq_scale_def>() as u32;
        Model::make(|raw| unsafe { sys::msq_model_create(context.as_ptr(), &def, raw) })
    }

    /// Models in order of priority.
    pub fn regions(context: &Context, models: &[&Model]) -> Result<Model> {
        let raws: Vec<*const sys::msq_model> =
            models.iter().map(|model| model.as_ptr() as *const _).collect();
        Model::make(|raw| unsafe {
            sys::msq_model_regions(context.as_ptr(), raws.as_ptr(), raws.len() as u64, raw)
        })
    }

    /// 16 bytes that are equal for equal definitions with equal inputs, on every machine.
    pub fn hash(&self) -> Result<[u8; 16]> {
        let mut hash = [0; 16];
        check(unsafe { sys::msq_model_hash(self.as_ptr(), hash.as_mut_ptr()) })?;
        Ok(hash)
    }

    pub fn bounds(&self) -> Result<([f64; 3], [f64; 3])> {
        let (mut min, mut max) = ([0.0; 3], [0.0; 3]);
        check(unsafe { sys::msq_model_bounds(self.as_ptr(), min.as_mut_ptr(), max.as_mut_ptr()) })?;
        Ok((min, max))
    }

    pub fn is_inside(&self, point: [f64; 3]) -> Result<bool> {
        let mut inside = 0;
        check(unsafe {
            sys::msq_point_membership(self.as_ptr(), point.as_ptr(), ptr::null(), &mut inside)
        })?;
        Ok(inside != 0)
    }

    /// One byte per point, 0 or 1.
    pub fn membership(&self, points: &[[f64; 3]], job: Option<&Job>) -> Result<Vec<u8>> {
        self.set_membership(&array(points)?, points.len() as u64, job)
    }

    /// One byte per point of a grid, 0 or 1, x fastest.
    pub fn grid_membership(&self, grid: &Grid, job: Option<&Job>) -> Result<Vec<u8>> {
        let mut def = definition!(msq_points_def_init, msq_points_def);
        def.kind = sys::MSQ_POINTS_GRID;
        def.origin = grid.origin;
        def.spacing = grid.spacing;
        def.counts = grid.counts;
        let count = product(grid.counts).ok_or_else(|| {
            crate::Error::argument(format!("a grid of {:?} points is too large", grid.counts))
        })?;
        self.set_membership(&def, count, job)
    }

    fn set_membership(
        &self,
        points: &sys::msq_points_def,
        count: u64,
        job: Option<&Job>,
    ) -> Result<Vec<u8>> {
        filled(count, |inside| {
            check(unsafe {
                sys::msq_set_membership(self.as_ptr(), points, ptr::null(), inside, count, raw_job(job))
            })
        })
    }

    /// Signed distances, exact or a lower bound as msq_set_distance says.
    pub fn distance(&self, points: &[[f64; 3]], job: Option<&Job>) -> Result<Vec<f64>> {
        let def = array(points)?;
        let count = points.len() as u64;
        filled(count, |distances| {
            check(unsafe {
                sys::msq_set_distance(self.as_ptr(), &def, ptr::null(), distances, count, raw_job(job))
            })
        })
    }

    /// Triangles of the boundary at a pitch, in slabs. An error of the closure is the host's code.
    pub fn surface_mesh<F>(&self, pitch: f64, mut take: F, job: Option<&Job>) -> Result<()>
    where
        F: FnMut(MeshSlab) -> std::result::Result<(), i32>,
    {
        let mut def = definition!(msq_surface_def_init, msq_surface_def);
        def.pitch = pitch;
        check(unsafe {
            sys::msq_surface_mesh(
                self.as_ptr(),
                &def,
                Some(take_slab::<F>),
                &mut take as *mut F as *mut c_void,
                raw_job(job),
            )
        })
    }
}

/// Valid as long as the points.
fn array(points: &[[f64; 3]]) -> Result<sys::msq_points_def> {
    let mut def = definition!(msq_points_def_init, msq_points_def);
    def.kind = sys::MSQ_POINTS_ARRAY;
    def.coordinate_type = sys::MSQ_FLOAT64;
    def.coordinates = points.as_ptr() as *const _;
    def.count = points.len() as u64;
    Ok(def)
}
