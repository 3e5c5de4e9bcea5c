// SPDX-License-Identifier: Apache-2.0
//! The crate against closed forms and against itself.
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Barrier};

use msq::{
    sys, Context, ContextOptions, Document, Field, Foam, Functional, Grid, Job, Lattice, LayerView, Model,
    Period, Plan, Shape, Slicer, Structure, Warp,
};

fn cube(context: &Context) -> Shape {
    Shape::cuboid(context, [0.0; 3], [10.0; 3]).unwrap()
}

fn foam_model(context: &Context) -> Model {
    let foam = Structure::foam(context, &Foam::new(2.0, 0.3)).unwrap();
    Model::new(context, &cube(context), &[&foam]).unwrap()
}

#[test]
fn the_library_is_the_one_of_the_declarations() {
    assert_eq!(msq::version(), sys::MSQ_VERSION);
}

#[test]
fn spheres_have_their_volume() {
    let context = Context::new().unwrap();
    let sphere = Shape::sphere(&context, [0.0; 3], 1.0).unwrap();
    let model = Model::new(&context, &sphere, &[]).unwrap();
    let grid = Grid { origin: [-0.99; 3], spacing: [0.02; 3], counts: [100; 3] };
    let inside: u64 = model.grid_membership(&grid, None).unwrap().iter().map(|x| *x as u64).sum();
    let volume = inside as f64 * 0.02f64.powi(3);
    assert!((volume / (4.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 0.002, "{volume}");
    let distances = model.distance(&[[0.0; 3], [3.0, 0.0, 0.0]], None).unwrap();
    // Bounds, a few rounding errors below the distances.
    assert!((distances[0] + 1.0).abs() < 1e-13 && (distances[1] - 2.0).abs() < 1e-13);
}

#[test]
fn waves_fill_about_the_fraction() {
    let context = Context::new().unwrap();
    for (cones, fraction) in [([90.0, 0.0, 0.0], 0.3), ([0.0, 20.0, 20.0], 0.6)] {
        let waves = Structure::waves(&context, 0.5, 200, 7, cones, fraction).unwrap();
        let model = Model::new(&context, &cube(&context), &[&waves]).unwrap();
        let grid = Grid { origin: [0.1; 3], spacing: [0.2; 3], counts: [50; 3] };
        let inside = model.grid_membership(&grid, None).unwrap();
        let share = inside.iter().map(|x| *x as f64).sum::<f64>() / inside.len() as f64;
        assert!((share - fraction).abs() < 0.03, "{share}");
    }
    let error = Structure::waves(&context, 0.5, 0, 7, [90.0, 0.0, 0.0], 0.5).err().unwrap();
    assert!(error.to_string().contains("count is 0"), "{error}");
}

#[test]
fn plates_fill_their_fraction() {
    let context = Context::new().unwrap();
    let cell = sys::MSQ_PLATE_CELL_CUBIC;
    let plates = Structure::plate_lattice(&context, cell, [2.0; 3], 0.4).unwrap();
    let model = Model::new(&context, &cube(&context), &[&plates]).unwrap();
    let grid = Grid { origin: [0.1; 3], spacing: [0.2; 3], counts: [50; 3] };
    let inside = model.grid_membership(&grid, None).unwrap();
    let share = inside.iter().map(|x| *x as f64).sum::<f64>() / inside.len() as f64;
    assert!((share - (1.0 - 0.8f64.powi(3))).abs() < 0.001, "{share}");
    let error = Structure::plate_lattice(&context, cell, [2.0; 3], 9.0).err().unwrap();
    assert!(error.to_string().contains("thickness reaches 9"), "{error}");
}

/// Points of the cube, and the same after a ninth of a turn about the z axis.
fn turned_points() -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    let (sin, cos) = (2.0 * std::f64::consts::PI / 9.0).sin_cos();
    let at = |i: usize, step: f64| 8.0 * ((i as f64 * step) % 1.0) - 4.0;
    let points: Vec<[f64; 3]> =
        (0..2000).map(|i| [at(i, 0.618), at(i, 0.7549), at(i, 0.5698)]).collect();
    let turned =
        points.iter().map(|[x, y, z]| [cos * x - sin * y, sin * x + cos * y, *z]).collect();
    (points, turned)
}

#[test]
fn cells_are_warped() {
    let context = Context::new().unwrap();
    let ball = Shape::sphere(&context, [0.0; 3], 8.0).unwrap();
    let inside = |structure: Structure, points: &[[f64; 3]]| {
        Model::new(&context, &ball, &[&structure]).unwrap().membership(points, None).unwrap()
    };
    let (points, turned) = turned_points();
    let gyroid = Functional::network(sys::MSQ_FUNCTION_GYROID, 1.5, 0.2);
    let bcc = Lattice::new(sys::MSQ_UNIT_CELL_BCC, 1.5, 0.2);
    for count_polar in [None, Some(5)] {
        let shear_along = if count_polar.is_none() { 0.5 } else { 0.0 };
        let (inner_radius, outer_radius) = (1.0, Some(4.0));
        let warp = Warp { count: 9, count_polar, inner_radius, outer_radius, shear_along, ..Warp::default() };
        let warp = Some(warp);
        let gyroid = Functional { warp: warp.clone(), ..gyroid.clone() };
        let bcc = Lattice { warp, ..bcc.clone() };
        let make = |k| match k {
            0 => Structure::functional(&context, &gyroid).unwrap(),
            _ => Structure::lattice(&context, &bcc).unwrap(),
        };
        for k in 0..2 {
            let here = inside(make(k), &points);
            let differ =
                here.iter().zip(inside(make(k), &turned)).filter(|(a, b)| **a != *b).count();
            assert!(differ < 4 && here.contains(&0) && here.contains(&1), "{differ}");
        }
    }
    let plain = inside(Structure::functional(&context, &gyroid).unwrap(), &points);
    assert_ne!(plain, inside(Structure::functional(&context, &gyroid).unwrap(), &turned));
    let error = Structure::lattice(&context, &Lattice { warp: Some(Warp::default()), ..bcc });
    assert!(error.unwrap_err().to_string().contains("warp.count is 0"));
}

#[test]
fn cells_are_mapped_by_samples() {
    let context = Context::new().unwrap();
    let inside = |warp: Option<Warp>| {
        let grid = Grid { origin: [0.1; 3], spacing: [0.31; 3], counts: [32; 3] };
        let bcc = Lattice { warp, ..Lattice::new(sys::MSQ_UNIT_CELL_BCC, 2.5, 0.4) };
        let structure = Structure::lattice(&context, &bcc)?;
        Model::new(&context, &cube(&context), &[&structure])?.grid_membership(&grid, None)
    };
    let coordinate = |axis: u32, cell_size: f64| {
        let at = |i: u32| f64::from(i / 6u32.pow(axis) % 6);
        let values: Vec<f64> = (0..216).map(|i| (4.0 * at(i) - 5.0) / cell_size).collect();
        Field::grid(&context, &values, [6; 3], [-5.0; 3], [4.0; 3]).unwrap()
    };
    let map = |third| Some(Warp::sampled(coordinate(0, 2.5), coordinate(1, 2.5), third));
    let plain = inside(None).unwrap();
    let differing = |other: Vec<u8>| plain.iter().zip(other).filter(|(a, b)| **a != *b).count();
    assert!(differing(inside(map(coordinate(2, 2.5))).unwrap()) < 8);
    assert!(differing(inside(map(coordinate(2, 4.0))).unwrap()) > 100);
    assert!(inside(map(coordinate(1, 2.5))).unwrap_err().to_string().contains("folds"));
    let few = Field::grid(&context, &[0.0; 7], [2; 3], [0.0; 3], [1.0; 3]);
    assert!(few.unwrap_err().to_string().contains("there are 7 values"));
}

#[test]
fn periods_and_stretches_change_cells() {
    let context = Context::new().unwrap();
    let inside = |structure: Structure| {
        let grid = Grid { origin: [0.1; 3], spacing: [0.31; 3], counts: [32; 3] };
        let model = Model::new(&context, &cube(&context), &[&structure]).unwrap();
        model.grid_membership(&grid, None).unwrap()
    };
    let period = |cell_sizes: &[f64]| {
        let positions = (0..cell_sizes.len()).map(|i| 5.0 * i as f64).collect();
        Some(Period { axis: 0, positions, cell_sizes: cell_sizes.to_vec() })
    };
    let lattice = |period| {
        let bcc = Lattice::new(sys::MSQ_UNIT_CELL_BCC, 2.5, 0.4);
        Structure::lattice(&context, &Lattice { cell_size: [7.0, 2.5, 2.5], period, ..bcc })
    };
    let sheet = |period| {
        let gyroid = Functional::sheet(sys::MSQ_FUNCTION_GYROID, 2.5, 0.4);
        Structure::functional(&context, &Functional { cell_size: [7.0, 2.5, 2.5], period, ..gyroid })
    };
    // Cells of one size by a period are the cells of this size. A few samples are at the surface.
    let bcc = Structure::lattice(&context, &Lattice::new(sys::MSQ_UNIT_CELL_BCC, 2.5, 0.4)).unwrap();
    let (found, wanted) = (inside(lattice(period(&[2.5])).unwrap()), inside(bcc));
    let differ = found.iter().zip(&wanted).filter(|(a, b)| a != b).count();
    assert!(differ < 8 && wanted.contains(&1), "{differ}");
    assert_ne!(inside(lattice(period(&[2.5, 1.5])).unwrap()), wanted);
    assert_ne!(
        inside(sheet(period(&[2.5, 1.5])).unwrap()),
        inside(sheet(period(&[2.5])).unwrap())
    );
    let odd = Period { axis: 0, positions: vec![1.0, 2.0], cell_sizes: vec![1.0] };
    assert!(lattice(Some(odd)).unwrap_err().to_string().contains("2 positions and 1 cell_sizes"));
    assert!(lattice(period(&[])).is_err());
    // Only the proportions of the stretch count.
    let foam = |stretch| {
        inside(Structure::foam(&context, &Foam { stretch, ..Foam::new(2.0, 0.3) }).unwrap())
    };
    assert_eq!(foam([2.0; 3]), foam([1.0; 3]));
    assert_ne!(foam([1.0, 1.0, 3.0]), foam([1.0; 3]));
    let weighted = |weight| {
        inside(Structure::foam(&context, &Foam { weight, ..Foam::new(2.0, 0.3) }).unwrap())
    };
    assert_eq!(weighted(0.0), foam([1.0; 3]));
    assert_ne!(weighted(2.0), foam([1.0; 3]));
    let spaced = |period| {
        inside(Structure::foam(&context, &Foam { period, ..Foam::new(2.0, 0.3) }).unwrap())
    };
    assert_ne!(spaced(period(&[2.0, 1.0])), foam([1.0; 3]));
    let around = |outer_radius| {
        let warp = Some(Warp { count: 12, inner_radius: 3.0, outer_radius, ..Warp::default() });
        Structure::foam(&context, &Foam { warp, ..Foam::new(2.0, 0.3) })
    };
    assert!(inside(around(Some(6.0)).unwrap()).contains(&1));
    assert!(around(None).unwrap_err().to_string().contains("warp.outer_radius is 0"));
}

#[test]
fn smooth_booleans_add_fillets() {
    let context = Context::new().unwrap();
    let grid = Grid { origin: [0.1; 3], spacing: [0.31; 3], counts: [32; 3] };
    let inside = |structure: Structure| {
        let model = Model::new(&context, &cube(&context), &[&structure]).unwrap();
        model.grid_membership(&grid, None).unwrap()
    };
    let bcc = Structure::lattice(&context, &Lattice::new(sys::MSQ_UNIT_CELL_BCC, 2.5, 0.3)).unwrap();
    let sheet = Functional::sheet(sys::MSQ_FUNCTION_GYROID, 2.5, 0.3);
    let sheet = Structure::functional(&context, &sheet).unwrap();
    let union = sys::MSQ_BOOLEAN_UNION;
    let plain = inside(Structure::boolean(union, &[&bcc, &sheet]).unwrap());
    let smooth = inside(Structure::smooth_boolean(union, &bcc, &sheet, 0.4).unwrap());
    assert!(plain.iter().zip(&smooth).all(|(plain, smooth)| plain <= smooth));
    assert_ne!(plain, smooth);
    let error = Structure::smooth_boolean(union, &bcc, &sheet, -1.0).unwrap_err();
    assert!(error.to_string().contains("-1"), "{error}");
}

#[test]
fn sets_points_and_layers_agree() {
    let context = Context::new().unwrap();
    let model = foam_model(&context);
    let plan = Plan { pitch: 0.25, layer_height: 0.5, output: sys::MSQ_LAYER_BYTES };
    let slicer = Slicer::new(&model, plan).unwrap();
    let info = slicer.info().unwrap();
    let mut taken = Vec::new();
    slicer
        .run(0, info.layer_count, |layer| {
            taken.push((layer.index, layer.z, layer.data.to_vec()));
            Ok(())
        }, None)
        .unwrap();
    assert_eq!(taken.len() as u64, info.layer_count);
    for (layer, (index, z, data)) in slicer.layers().unwrap().zip(&taken) {
        let layer = layer.unwrap();
        assert_eq!((layer.index, layer.z, &layer.data), (*index, *z, data));
    }
    let (_, z, data) = &taken[3];
    let mut points = Vec::new();
    for i in 0..info.width as usize {
        points.push([info.origin[0] + i as f64 * info.pitch[0], info.origin[1], *z]);
    }
    let inside = model.membership(&points, None).unwrap();
    let row: Vec<u8> = data[..info.width as usize].iter().map(|byte| (*byte != 0) as u8).collect();
    assert_eq!(inside, row);
    assert_eq!(model.is_inside(points[5]).unwrap(), inside[5] != 0);
}

#[test]
fn layers_of_contours_have_no_data() {
    let context = Context::new().unwrap();
    let text = r#"{"msq_model": 1, "scales": [{"shape": {"box": {"min": [0, 0, 0], "max": [4, 4, 4]}}}],
        "slicing": {"pitch": [0.5, 0.5], "layer_height": 0.5,
                    "outputs": [{"output": "contours", "contours": {"tolerance": 0.1}}]}}"#;
    let document = match Document::from_json(&context, text, None) {
        Err(error) if error.status() == sys::MSQ_E_UNSUPPORTED => return, // a build without JSON
        document => document.unwrap(),
    };
    let slicer = document.slicer().unwrap();
    let mut taken = 0;
    let take = |layer: LayerView| {
        assert!(layer.data.is_empty() && layer.stride == 0);
        taken += 1;
        Ok(())
    };
    slicer.run(0, 8, take, None).unwrap();
    assert_eq!(taken, 8);
    let error = slicer.layer(0, None).unwrap_err();
    assert_eq!(error.status(), sys::MSQ_E_ARGUMENT);
    assert!(error.message().contains("contours"), "{error}");
}

#[test]
fn mesh_files_are_read_from_memory() {
    let context = Context::new().unwrap();
    let file = b"OFF\n4 4 0\n0 0 0\n6 0 0\n0 6 0\n0 0 6\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let shape = Shape::from_memory(&context, file, sys::MSQ_FORMAT_OFF, None).unwrap();
    let info = shape.info().unwrap();
    assert_eq!((info.triangles, info.open_edges), (4, 0));
    let refused = |file: &[u8], format| Shape::from_memory(&context, file, format, None).unwrap_err();
    assert_eq!(refused(file, sys::MSQ_FORMAT_AUTO).status(), sys::MSQ_E_ARGUMENT);
    assert_eq!(refused(&file[..20], sys::MSQ_FORMAT_OFF).status(), sys::MSQ_E_IO);
    assert!(Shape::from_memory(&context, &[], sys::MSQ_FORMAT_OFF, None).is_err());
}

#[test]
fn sizes_that_overflow_are_refused() {
    let context = Context::new().unwrap();
    let error = Field::grid(&context, &[1.0], [u64::MAX, 2, 1], [0.0; 3], [1.0; 3]).unwrap_err();
    assert_eq!(error.status(), sys::MSQ_E_ARGUMENT);
    assert!(error.message().contains("18446744073709551615 x 2 x 1"), "{error}");
    let model = foam_model(&context);
    let refused = |counts| {
        let grid = Grid { origin: [0.0; 3], spacing: [1.0; 3], counts };
        model.grid_membership(&grid, None).unwrap_err().status()
    };
    assert_eq!(refused([1 << 32, 1 << 32, 1]), sys::MSQ_E_ARGUMENT); // 2^64 points
    assert_eq!(refused([1 << 32, 1 << 31, 1]), sys::MSQ_E_MEMORY);
}

#[test]
fn errors_have_status_and_message() {
    let context = Context::new().unwrap();
    let error = Shape::sphere(&context, [0.0; 3], -1.0).unwrap_err();
    assert_eq!(error.status(), sys::MSQ_E_ARGUMENT);
    assert!(error.message().contains("-1"), "{error}");
    let error = Shape::from_file(&context, "no/such.stl", None).unwrap_err();
    assert_eq!(error.status(), sys::MSQ_E_IO);
}

#[test]
fn closures_evaluate_fields_and_are_freed() {
    let freed = Arc::new(AtomicUsize::new(0));
    struct Counted(Arc<AtomicUsize>);
    impl Drop for Counted {
        fn drop(&mut self) {
            self.0.fetch_add(1, Ordering::SeqCst);
        }
    }
    let counted = Counted(freed.clone());
    let context = Context::new().unwrap();
    let radius = Field::host(&context, 0.1, 0.5, 0.04, true, Box::new(move |points, values| {
        let _ = &counted;
        for (point, value) in points.iter().zip(values) {
            *value = 0.1 + 0.04 * point[0].clamp(0.0, 10.0);
        }
        Ok(())
    }))
    .unwrap();
    let same = Field::gradient(&context, [0.0; 3], 0.1, [10.0, 0.0, 0.0], 0.5).unwrap();
    let grid = Grid { origin: [0.1; 3], spacing: [0.5; 3], counts: [20; 3] };
    let mut sets = Vec::new();
    for field in [radius, same] {
        let bcc = Lattice::new(sys::MSQ_UNIT_CELL_BCC, 2.5, field);
        let lattice = Structure::lattice(&context, &bcc).unwrap();
        let model = Model::new(&context, &cube(&context), &[&lattice]).unwrap();
        sets.push(model.grid_membership(&grid, None).unwrap());
    }
    let differ = sets[0].iter().zip(&sets[1]).filter(|(a, b)| a != b).count();
    assert!(differ < 4, "{differ}");
    drop(context);
    assert_eq!(freed.load(Ordering::SeqCst), 1);
}

#[test]
fn codes_and_panics_of_closures_come_through() {
    let context = Context::new().unwrap();
    let model = foam_model(&context);
    let plan = Plan { pitch: 0.5, layer_height: 1.0, output: sys::MSQ_LAYER_BITS };
    let slicer = Slicer::new(&model, plan).unwrap();
    let error = slicer.run(0, 5, |layer| if layer.index == 2 { Err(-7) } else { Ok(()) }, None);
    let error = error.unwrap_err();
    assert_eq!((error.status(), error.host_code()), (sys::MSQ_E_HOST, -7));
    // Also those that msq takes for success, and those of the range in which panics have theirs.
    for code in [0, 1, i32::MAX, -(1 << 30) + 1, -(1 << 30), i32::MIN] {
        let mut calls = 0;
        let mut take = |_: LayerView| {
            calls += 1;
            Err(code)
        };
        let error = slicer.run(0, 5, &mut take, None).unwrap_err();
        assert_eq!((error.status(), error.host_code(), calls), (sys::MSQ_E_HOST, code, 1));
        assert!(error.message().contains(&code.to_string()), "{error}");
    }
    let panic = catch_unwind(AssertUnwindSafe(|| {
        let _ = slicer.run(0, 5, |layer| panic!("layer {}", layer.index), None);
    }));
    assert_eq!(panic.unwrap_err().downcast_ref::<String>().unwrap(), "layer 0");
    slicer.run(0, 5, |_| Ok(()), None).unwrap();
}

#[test]
fn panics_and_codes_come_through_in_their_own_thread() {
    let context = Context::new().unwrap();
    let model = foam_model(&context);
    let plan = Plan { pitch: 1.0, layer_height: 1.0, output: sys::MSQ_LAYER_BITS };
    let slicer = Slicer::new(&model, plan).unwrap();
    let together = Barrier::new(3);
    let run = |take: &dyn Fn() -> std::result::Result<(), i32>| {
        let take = |_: LayerView| {
            together.wait();
            take()
        };
        catch_unwind(AssertUnwindSafe(|| slicer.run(0, 1, take, None)))
    };
    let runs = || 0..2000usize;
    std::thread::scope(|scope| {
        for thread in 0..2usize {
            scope.spawn(move || {
                for i in runs() {
                    // Without a panic's message.
                    let panic = run(&|| resume_unwind(Box::new((thread, i)))).unwrap_err();
                    assert_eq!(panic.downcast_ref(), Some(&(thread, i)));
                }
            });
        }
        for _ in runs() {
            assert_eq!(run(&|| Err(i32::MIN)).unwrap().unwrap_err().host_code(), i32::MIN);
        }
    });
}

#[test]
fn panics_that_no_call_reports_give_way() {
    let context = Context::new().unwrap();
    let freed = Arc::new(());
    let alive = freed.clone();
    let fail = Field::host(&context, 0.1, 0.5, 0.0, true, Box::new(move |_, _| {
        resume_unwind(Box::new(alive.clone()))
    }))
    .unwrap();
    let bcc = Lattice::new(sys::MSQ_UNIT_CELL_BCC, 2.5, fail);
    let lattice = Structure::lattice(&context, &bcc).unwrap();
    let model = Model::new(&context, &cube(&context), &[&lattice]).unwrap();
    let grid = Grid { origin: [0.1; 3], spacing: [0.2; 3], counts: [50; 3] };
    for _ in 0..2000 {
        let run = || model.grid_membership(&grid, None);
        let panic = catch_unwind(AssertUnwindSafe(run)).unwrap_err();
        assert!(panic.is::<Arc<()>>());
    }
    assert!(Arc::strong_count(&freed) < 300, "{} values are kept", Arc::strong_count(&freed));
}

#[test]
fn jobs_cancel() {
    let context = Context::new().unwrap();
    let job = Job::new().unwrap();
    job.cancel().unwrap();
    let error = foam_model(&context).membership(&[[1.0; 3]], Some(&job)).unwrap_err();
    assert_eq!(error.status(), sys::MSQ_E_CANCELLED);
    assert!(job.progress().unwrap() < 1.0);
}

#[test]
fn threads_share_handles() {
    let context = Context::new().unwrap();
    let model = foam_model(&context);
    let grid = Grid { origin: [0.1; 3], spacing: [0.3; 3], counts: [30; 3] };
    let expected = model.grid_membership(&grid, None).unwrap();
    std::thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| assert_eq!(model.clone().grid_membership(&grid, None).unwrap(), expected));
        }
    });
}

#[test]
fn meshes_close() {
    let context = Context::new().unwrap();
    let model = Model::new(&context, &cube(&context), &[]).unwrap();
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    model
        .surface_mesh(1.5, |slab| {
            assert_eq!(slab.first_vertex as usize, vertices.len());
            vertices.extend_from_slice(slab.vertices);
            triangles.extend_from_slice(slab.triangles);
            Ok(())
        }, None)
        .unwrap();
    let mut six = 0.0;
    for [a, b, c] in triangles {
        let [a, b, c]: [[f64; 3]; 3] = [vertices[a as usize], vertices[b as usize], vertices[c as usize]];
        six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    assert!((six / 6.0 - 1000.0).abs() < 1.0, "{six}");
}

#[test]
fn panics_of_the_drop_of_what_closures_hold_end_there() {
    struct Bomb(Arc<AtomicUsize>);
    impl Drop for Bomb {
        fn drop(&mut self) {
            self.0.fetch_add(1, Ordering::SeqCst);
            panic!("in drop");
        }
    }
    let count = Arc::new(AtomicUsize::new(0));
    let (of_field, of_context) = (Bomb(count.clone()), Bomb(count.clone()));
    let options = ContextOptions {
        warning: Some(Box::new(move |_, _| {
            let _ = &of_context;
        })),
        ..ContextOptions::default()
    };
    let context = Context::with(options).unwrap();
    let field = Field::host(&context, 0.0, 1.0, 0.0, true, Box::new(move |_, values| {
        let _ = &of_field;
        values.fill(0.5);
        Ok(())
    }));
    drop(field.unwrap());
    assert_eq!(count.load(Ordering::SeqCst), 1);
    drop(context);
    assert_eq!(count.load(Ordering::SeqCst), 2);
}

#[test]
fn warnings_reach_the_closure_of_the_context() {
    let count = Arc::new(AtomicUsize::new(0));
    let counted = count.clone();
    let options = ContextOptions {
        warning: Some(Box::new(move |code, message| {
            assert_eq!(code, sys::MSQ_WARNING_COARSE_PITCH);
            assert!(message.contains("pixels"), "{message}");
            counted.fetch_add(1, Ordering::SeqCst);
        })),
        ..ContextOptions::default()
    };
    let model = foam_model(&Context::with(options).unwrap());
    let plan = Plan { pitch: 1.0, layer_height: 1.0, output: sys::MSQ_LAYER_BITS };
    Slicer::new(&model, plan).unwrap();
    assert_eq!(count.load(Ordering::SeqCst), 1);
    drop(model);
    assert_eq!(Arc::strong_count(&count), 1);
}
