// SPDX-License-Identifier: Apache-2.0
//! Runs the vectors through the crate: see tests/vectors/protocol.py.
use std::{env, error, fs};

use msq::{sys, Context, Document, Model};

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn bits(value: f64) -> String {
    format!("{:016x}", value.to_bits())
}

fn print_hash(model: &Model) -> msq::Result<()> {
    match model.hash() {
        Ok(hash) => println!("hash {}", hex(&hash)),
        Err(error) if error.status() == sys::MSQ_E_UNSUPPORTED => println!("hash -"),
        Err(error) => return Err(error),
    }
    Ok(())
}

fn print_case(document: &Document, points: &[u8]) -> msq::Result<()> {
    println!("title {}", document.title()?);
    let model = document.model()?;
    print_hash(&model)?;
    let number = |at: usize| f64::from_ne_bytes(points[at..at + 8].try_into().unwrap());
    let points: Vec<[f64; 3]> = (0..points.len() / 24)
        .map(|i| [number(24 * i), number(24 * i + 8), number(24 * i + 16)])
        .collect();
    let inside = model.membership(&points, None)?;
    println!("inside {}", inside.iter().map(u8::to_string).collect::<String>());
    let distances: Vec<_> = model.distance(&points, None)?.into_iter().map(bits).collect();
    println!("distance {}", distances.join(" "));
    let slicer = document.slicer()?;
    let plan = slicer.info()?;
    println!("plan {} {} {}", plan.width, plan.height, plan.layer_count);
    slicer.run(
        0,
        plan.layer_count,
        |layer| {
            println!("layer {} {} {}", layer.index, bits(layer.z), hex(layer.data));
            Ok(())
        },
        None,
    )
}

fn main() -> std::result::Result<(), Box<dyn error::Error>> {
    let context = Context::new()?;
    let arguments: Vec<String> = env::args().skip(1).collect();
    for pair in arguments.chunks_exact(2) {
        println!("case");
        match Document::from_json(&context, &fs::read_to_string(&pair[0])?, None) {
            Ok(document) => print_case(&document, &fs::read(&pair[1])?)?,
            Err(error) => println!("refused {error}"),
        }
    }
    Ok(())
}
