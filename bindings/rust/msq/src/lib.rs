// SPDX-License-Identifier: Apache-2.0
//! msq: lattices, TPMS and Voronoi foams inside a part without meshing them.
//!
//! The crate is a thin, safe layer over the C ABI. Handles clone and drop references. Errors are
//! `Result`s. Closures may return an error code of the host, which stops the call; a panic of a
//! closure goes on in the thread that called msq. What this layer has no function for is reached by
//! `as_ptr` and the crate `msq_sys`.
pub use msq_sys as sys;

#[macro_use]
mod handle;
mod array;
mod context;
mod document;
mod error;
mod field;
mod model;
mod shape;
mod slicer;
mod structure;

pub use context::{Context, ContextOptions, Job};
pub use document::Document;
pub use error::{check, Error, Result};
pub use field::{Field, Param, ValuesFn};
pub use model::{Grid, MeshSlab, Model};
pub use shape::Shape;
pub use slicer::{Layer, LayerView, Plan, Slicer};
pub use structure::{Foam, Functional, Lattice, Period, Structure, Warp};

/// Version of the loaded library: major * 10000 + minor * 100 + patch.
pub fn version() -> u32 {
    unsafe { sys::msq_version() }
}
