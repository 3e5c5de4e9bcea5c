// SPDX-License-Identifier: Apache-2.0
//! Structures that fill a shape.
use std::ffi::CString;

use crate::context::{raw_job, Context, Job};
use crate::field::{Field, Param};
use crate::{check, sys, Error, Result};

handle!(
    /// What fills a shape at one scale.
    Structure, msq_structure, msq_structure_retain, msq_structure_release
);

/// Cells whose size varies along one axis of the grid. The number of cells per unit length is linear
/// between positions and constant beyond them.
#[derive(Clone, Debug, Default)]
pub struct Period {
    /// 0 to 2.
    pub axis: i32,
    /// Coordinates along the axis, from the origin of the grid, in ascending order.
    pub positions: Vec<f64>,
    /// The size of the cells at each position.
    pub cell_sizes: Vec<f64>,
}

impl Period {
    /// Valid as long as this period.
    fn raw(&self) -> Result<sys::msq_period_def> {
        if self.positions.len() != self.cell_sizes.len() {
            return Err(Error::argument(format!(
                "period has {} positions and {} cell_sizes; it must have as many of both",
                self.positions.len(),
                self.cell_sizes.len()
            )));
        }
        let mut def = definition!(msq_period_def_init, msq_period_def);
        def.axis = self.axis;
        def.positions = self.positions.as_ptr();
        def.cell_sizes = self.cell_sizes.as_ptr();
        def.count = self.positions.len() as u64;
        Ok(def)
    }
}

/// Cells around the z axis of the grid, or around its origin, or by a map of samples. `cell_size[0]`
/// is their size outwards.
#[derive(Clone, Debug, Default)]
pub struct Warp {
    /// Cells in a whole turn.
    pub count: u32,
    /// Cells from pole to pole, around the origin. None: cells around the axis.
    pub count_polar: Option<u32>,
    pub inner_radius: f64,
    /// None: no limit.
    pub outer_radius: Option<f64>,
    /// Around the axis: cells around from cell to cell outwards, and along the axis.
    pub shear_outwards: f64,
    pub shear_along: f64,
    /// The coordinates of cells by samples (`Field::grid`) on one grid. All else is then 0 or None.
    pub map: Option<[Field; 3]>,
}

impl Warp {
    /// Cells by a map: fields of samples (`Field::grid`) on one grid.
    pub fn sampled(u: Field, v: Field, w: Field) -> Warp {
        Warp { map: Some([u, v, w]), ..Warp::default() }
    }

    /// Valid as long as this warp.
    fn raw(&self) -> Result<sys::msq_warp_def> {
        let mut def = definition!(msq_warp_def_init, msq_warp_def);
        if let Some([u, v, w]) = &self.map {
            def.kind = sys::MSQ_WARP_SAMPLED;
            (def.u, def.v, def.w) = (u.as_ptr(), v.as_ptr(), w.as_ptr());
        }
        def.shear_outwards = self.shear_outwards;
        def.shear_along = self.shear_along;
        if let Some(count_polar) = self.count_polar {
            def.kind = sys::MSQ_WARP_SPHERICAL;
            def.count_polar = count_polar;
        }
        def.count = self.count;
        def.inner_radius = self.inner_radius;
        def.outer_radius = self.outer_radius.unwrap_or(0.0);
        Ok(def)
    }
}

fn pointer<T>(def: &Option<T>) -> *const T {
    def.as_ref().map_or(std::ptr::null(), |def| def as *const T)
}

/// A lattice of struts. Lengths are in model units.
#[derive(Clone, Debug)]
pub struct Lattice {
    pub origin: [f64; 3],
    pub cell_size: [f64; 3],
    /// An `MSQ_UNIT_CELL_*` other than CUSTOM.
    pub unit_cell: i32,
    pub radius: Param,
    pub period: Option<Period>,
    pub warp: Option<Warp>,
}

impl Lattice {
    /// Cells of one size on all axes.
    pub fn new(unit_cell: i32, cell_size: f64, radius: impl Into<Param>) -> Lattice {
        Lattice {
            origin: [0.0; 3],
            cell_size: [cell_size; 3],
            unit_cell,
            radius: radius.into(),
            period: None,
            warp: None,
        }
    }
}

/// A functional structure, such as a gyroid. Lengths are in model units.
#[derive(Clone, Debug)]
pub struct Functional {
    pub origin: [f64; 3],
    pub cell_size: [f64; 3],
    /// An `MSQ_FUNCTIONAL_*`: network or sheet.
    pub kind: i32,
    /// An `MSQ_FUNCTION_*`.
    pub function: i32,
    /// The text, if function is EXPRESSION.
    pub expression: Option<String>,
    /// Value of the function at the surface.
    pub level: Param,
    /// Mean thickness of a sheet, instead of the level. 0: the level is used.
    pub thickness: Param,
    pub period: Option<Period>,
    pub warp: Option<Warp>,
}

impl Functional {
    /// The points where a function is at most a level. function: an `MSQ_FUNCTION_*` other than EXPRESSION.
    pub fn network(function: i32, cell_size: f64, level: impl Into<Param>) -> Functional {
        Functional {
            origin: [0.0; 3],
            cell_size: [cell_size; 3],
            kind: sys::MSQ_FUNCTIONAL_NETWORK,
            function,
            expression: None,
            level: level.into(),
            thickness: Param::default(),
            period: None,
            warp: None,
        }
    }

    /// The points where an expression of x, y and z is at most a level. x, y and z are angles: they
    /// go from 0 to 2 pi along each axis of a cell.
    pub fn expression(text: &str, cell_size: f64, level: impl Into<Param>) -> Functional {
        Functional {
            expression: Some(text.to_string()),
            ..Functional::network(sys::MSQ_FUNCTION_EXPRESSION, cell_size, level)
        }
    }

    /// A wall of a mean thickness along the zeros of a function. function: an `MSQ_FUNCTION_*` other
    /// than EXPRESSION.
    pub fn sheet(function: i32, cell_size: f64, thickness: impl Into<Param>) -> Functional {
        Functional {
            kind: sys::MSQ_FUNCTIONAL_SHEET,
            thickness: thickness.into(),
            ..Functional::network(function, cell_size, 0.0)
        }
    }
}

/// A Voronoi foam. Lengths are in model units; the defaults are those of msq.
#[derive(Clone, Debug)]
pub struct Foam {
    pub origin: [f64; 3],
    pub cell_size: [f64; 3],
    pub radius: Param,
    /// None: the default of msq.
    pub jitter: Option<f64>,
    pub seed: u64,
    /// None: one seed per cell.
    pub density: Option<Param>,
    /// Thickness of walls, for closed cells. 0: struts alone.
    pub wall_thickness: Param,
    /// Radius of the holes in the walls. 0: none.
    pub vent_radius: Param,
    /// How much longer the cells of the foam are along each axis of the grid.
    pub stretch: [f64; 3],
    /// The greatest radius of the seeds' spheres; above 0, cells are those of a Laguerre tessellation.
    pub weight: f64,
    pub period: Option<Period>,
    pub warp: Option<Warp>,
}

impl Foam {
    /// Cells of one size on all axes.
    pub fn new(cell_size: f64, radius: impl Into<Param>) -> Foam {
        Foam {
            origin: [0.0; 3],
            cell_size: [cell_size; 3],
            radius: radius.into(),
            jitter: None,
            seed: 0,
            density: None,
            wall_thickness: Param::default(),
            vent_radius: Param::default(),
            stretch: [1.0; 3],
            weight: 0.0,
            period: None,
            warp: None,
        }
    }
}

impl Structure {
    pub fn foam(context: &Context, foam: &Foam) -> Result<Structure> {
        let mut def = definition!(msq_foam_def_init, msq_foam_def);
        let period = foam.period.as_ref().map(Period::raw).transpose()?;
        let warp = foam.warp.as_ref().map(Warp::raw).transpose()?;
        def.grid.origin = foam.origin;
        def.grid.cell_size = foam.cell_size;
        def.radius = foam.radius.raw();
        if let Some(jitter) = foam.jitter {
            def.jitter = jitter;
        }
        def.seed = foam.seed;
        if let Some(density) = &foam.density {
            def.density = density.raw();
        }
        def.wall_thickness = foam.wall_thickness.raw();
        def.vent_radius = foam.vent_radius.raw();
        def.stretch = foam.stretch;
        def.weight = foam.weight;
        def.period = pointer(&period);
        def.warp = pointer(&warp);
        Structure::make(|raw| unsafe { sys::msq_structure_foam(context.as_ptr(), &def, raw) })
    }

    pub fn lattice(context: &Context, lattice: &Lattice) -> Result<Structure> {
        let mut def = definition!(msq_lattice_def_init, msq_lattice_def);
        let period = lattice.period.as_ref().map(Period::raw).transpose()?;
        let warp = lattice.warp.as_ref().map(Warp::raw).transpose()?;
        def.unit_cell = lattice.unit_cell;
        def.grid.origin = lattice.origin;
        def.grid.cell_size = lattice.cell_size;
        def.radius = lattice.radius.raw();
        def.period = pointer(&period);
        def.warp = pointer(&warp);
        Structure::make(|raw| unsafe { sys::msq_structure_lattice(context.as_ptr(), &def, raw) })
    }

    pub fn functional(context: &Context, functional: &Functional) -> Result<Structure> {
        let text = functional
            .expression
            .as_ref()
            .map(|text| CString::new(text.as_str()))
            .transpose()
            .map_err(|_| Error::argument("the expression has a zero byte".to_string()))?;
        let mut def = definition!(msq_functional_def_init, msq_functional_def);
        let period = functional.period.as_ref().map(Period::raw).transpose()?;
        let warp = functional.warp.as_ref().map(Warp::raw).transpose()?;
        def.function = functional.function;
        def.kind = functional.kind;
        def.expression = text.as_ref().map_or(std::ptr::null(), |text| text.as_ptr());
        def.grid.origin = functional.origin;
        def.grid.cell_size = functional.cell_size;
        def.level = functional.level.raw();
        def.thickness = functional.thickness.raw();
        def.period = pointer(&period);
        def.warp = pointer(&warp);
        Structure::make(|raw| unsafe { sys::msq_structure_functional(context.as_ptr(), &def, raw) })
    }

    /// Named plates of one thickness: plate_cell is an `MSQ_PLATE_CELL_*`.
    pub fn plate_lattice(
        context: &Context,
        plate_cell: i32,
        cell_size: [f64; 3],
        thickness: impl Into<Param>,
    ) -> Result<Structure> {
        let thickness = thickness.into();
        let mut def = definition!(msq_plate_lattice_def_init, msq_plate_lattice_def);
        def.plate_cell = plate_cell;
        def.grid.cell_size = cell_size;
        def.thickness = thickness.raw();
        Structure::make(|raw| unsafe {
            sys::msq_structure_plate_lattice(context.as_ptr(), &def, raw)
        })
    }

    /// A spinodal network: a sum of `count` waves, solid where it is at most the level of a volume
    /// fraction. cone_angles: half-angles in degrees; [90, 0, 0] for all directions.
    pub fn waves(
        context: &Context,
        wavelength: f64,
        count: u32,
        seed: u64,
        cone_angles: [f64; 3],
        volume_fraction: f64,
    ) -> Result<Structure> {
        let mut def = definition!(msq_waves_def_init, msq_waves_def);
        def.count = count;
        def.seed = seed;
        def.cone_angles = cone_angles;
        def.grid.cell_size = [wavelength; 3];
        def.volume_fraction = volume_fraction;
        Structure::make(|raw| unsafe { sys::msq_structure_waves(context.as_ptr(), &def, raw) })
    }

    /// operation: an `MSQ_BOOLEAN_*`.
    pub fn boolean(operation: i32, structures: &[&Structure]) -> Result<Structure> {
        let raws: Vec<*const sys::msq_structure> =
            structures.iter().map(|structure| structure.as_ptr() as *const _).collect();
        Structure::make(|raw| unsafe {
            sys::msq_structure_boolean(operation, raws.as_ptr(), raws.len() as u64, raw)
        })
    }

    /// Becomes b as the fraction, 0 to 1, grows.
    pub fn blend(a: &Structure, b: &Structure, fraction: impl Into<Param>) -> Result<Structure> {
        let fraction = fraction.into();
        Structure::make(|raw| unsafe {
            sys::msq_structure_blend(a.as_ptr(), b.as_ptr(), &fraction.raw(), raw)
        })
    }

    /// With fillets of a radius. operation: an `MSQ_BOOLEAN_*`.
    pub fn smooth_boolean(
        operation: i32,
        a: &Structure,
        b: &Structure,
        radius: impl Into<Param>,
    ) -> Result<Structure> {
        let radius = radius.into();
        Structure::make(|raw| unsafe {
            sys::msq_structure_smooth_boolean(
                operation,
                a.as_ptr(),
                b.as_ptr(),
                &radius.raw(),
                raw,
            )
        })
    }

    /// Finite struts of one radius between nodes.
    pub fn beams(
        context: &Context,
        nodes: &[[f64; 3]],
        beams: &[[u32; 2]],
        radius: f64,
        job: Option<&Job>,
    ) -> Result<Structure> {
        let mut def = definition!(msq_beams_def_init, msq_beams_def);
        def.coordinate_type = sys::MSQ_FLOAT64;
        def.nodes = nodes.as_ptr() as *const _;
        def.node_count = nodes.len() as u64;
        def.beams = beams.as_ptr() as *const u32;
        def.beam_count = beams.len() as u64;
        def.radius = radius;
        Structure::make(|raw| unsafe {
            sys::msq_structure_beams(context.as_ptr(), &def, raw, raw_job(job))
        })
    }

    /// The parameter (radius, level) at which the structure has a volume fraction.
    pub fn calibrate(&self, context: &Context, target: f64, job: Option<&Job>) -> Result<f64> {
        let report = report!(msq_calibration_report, |r| sys::msq_structure_calibrate(
            context.as_ptr(),
            self.as_ptr(),
            std::ptr::null(),
            target,
            std::ptr::null_mut(),
            std::ptr::null_mut(),
            0,
            r,
            raw_job(job)
        ));
        Ok(report.parameter)
    }

    pub fn hash(&self) -> Result<[u8; 16]> {
        let mut hash = [0; 16];
        check(unsafe { sys::msq_structure_hash(self.as_ptr(), hash.as_mut_ptr()) })?;
        Ok(hash)
    }
}
