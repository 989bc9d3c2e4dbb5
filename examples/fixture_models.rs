//! Writes small hand-made models, clean and broken, for `tests/interop.sh`.
//!
//! `cargo run --example fixture_models -- FOLDER`. Files whose names begin with `broken_` have one kind of defect each,
//! so that the program and the judges of others can be seen to agree on what is wrong, not only on what is right.

#[path = "../tests/common/mod.rs"]
mod common;

use glam::Vec3;
use penstemon::formats::write::export;
use penstemon::model::{Mesh, Vertex};
use std::path::Path;
use std::sync::Arc;

type Damage = fn(&mut Mesh);

const DAMAGES: [(&str, Damage); 6] = [
    ("hole", |leaf| leaf.triangles.truncate(leaf.triangles.len() - 1)),
    ("flipped", |leaf| leaf.triangles[3].swap(0, 1)),
    ("duplicate", |leaf| leaf.triangles.push(leaf.triangles[7])),
    ("bow_tie", |leaf| {
        let (front, back) = (leaf.vertices[0].point, leaf.vertices.iter().position(|v| v.normal.z < -0.9));
        if let Some(back) = back {
            leaf.vertices[back].point = front;
        }
    }),
    ("fin", |leaf| {
        let point = leaf.points.len() as u32;
        let top = leaf.points[0] + Vec3::Z * 0.01;
        leaf.points.push(top);
        let [a, b, _] = leaf.triangles[0];
        leaf.triangles.push([a, b, leaf.vertices.len() as u32]);
        leaf.vertices.push(Vertex { point, ..leaf.vertices[0] });
    }),
    ("collapsed", |leaf| {
        let [a, b, _] = leaf.point_triangle(leaf.triangles[0]);
        leaf.points[a as usize] = leaf.points[b as usize];
    }),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("name a folder")?;
    let folder = Path::new(&folder);
    let ((model, plant), provenance) = (common::two_specimens(), common::provenance());
    let plant = (&plant, &provenance);
    for name in ["clean.obj", "clean.glb"] {
        export(&folder.join(name), &model, plant, &common::textures)?;
    }
    for (name, damage) in DAMAGES {
        let mut model = model.clone();
        damage(Arc::make_mut(&mut model.parts[2].mesh));
        export(&folder.join(format!("broken_{name}.obj")), &model, plant, &common::textures)?;
    }
    Ok(())
}
