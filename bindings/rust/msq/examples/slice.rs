// SPDX-License-Identifier: Apache-2.0
//! Slices a box filled with a foam whose struts thicken with height, and prints each layer's share.
use msq::{sys, Context, Field, Foam, Model, Plan, Shape, Slicer, Structure};

fn main() -> msq::Result<()> {
    let context = Context::new()?;
    let part = Shape::cuboid(&context, [0.0; 3], [20.0, 20.0, 10.0])?;
    let radius = Field::gradient(&context, [0.0; 3], 0.1, [0.0, 0.0, 10.0], 0.4)?;
    let foam = Structure::foam(&context, &Foam::new(2.0, radius))?;
    let model = Model::with_skin(&context, &part, 0.5, &[&foam])?;
    let plan = Plan { pitch: 0.05, layer_height: 1.0, output: sys::MSQ_LAYER_BITS };
    let slicer = Slicer::new(&model, plan)?;
    let layers = slicer.info()?.layer_count;
    slicer.run(0, layers, |layer| {
        let share = layer.inside_count as f64 / (layer.width as f64 * layer.height as f64);
        println!("z = {:5.2} mm: {:5.1} % solid", layer.z, 100.0 * share);
        Ok(())
    }, None)
}
