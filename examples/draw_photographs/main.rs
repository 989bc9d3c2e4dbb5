//! Petal, leaf and bark from photographs, stage by stage, `cargo run --release --example draw_photographs FOLDER`: figures 1, 3
//! and 4 of Huai and Zhou (2012) with photographs that the program paints itself.
//!
//! For each of `petal` and `leaf` it writes the photograph, the outline on it with base and tip, the constrained Delaunay
//! triangulation of the blade over its texture, the texture, and a drawing; for `bark` the photograph, alone and repeated, the tile, alone and
//! repeated, and a drawing.

mod panel;
mod scene;

use anyhow::Context;
use glam::Vec2;
use panel::Panel;
use penstemon::model::{BladeMeshParams, TriangulationScratch, triangulation_input};
use penstemon::photo::{BarkPhoto, BladeKind, BladePhoto, PhotoParams};
use penstemon::picture::decode::Rgba;
use penstemon::plant::{Blade, BladeForm, RestSurface};
use penstemon::sketch::json;
use scene::Lying;
use std::path::{Path, PathBuf};

const SIZE: (u32, u32) = (880, 1000);
const LINE: [u8; 3] = [20, 90, 220];
const MARK: [u8; 3] = [230, 60, 20];

fn main() -> anyhow::Result<()> {
    let folder = PathBuf::from(std::env::args().nth(1).context("name a folder for the pictures")?);
    std::fs::create_dir_all(&folder)?;
    let petal = scene::photograph(
        SIZE,
        &scene::petal(),
        &Lying { base: Vec2::new(380.0, 880.0), length: 740.0, deg: 12.0 },
    );
    blade(&folder, "petal", (&petal, BladeKind::Petal, 9), &PhotoParams::default())?;
    let leaf = scene::photograph(
        SIZE,
        &scene::leaf(),
        &Lying { base: Vec2::new(480.0, 930.0), length: 830.0, deg: -9.0 },
    );
    blade(&folder, "leaf", (&leaf, BladeKind::Leaf, 7), &PhotoParams::for_leaves())?;
    let photograph = scene::bark((1000, 880));
    let bark = BarkPhoto::of_photograph(&photograph, &PhotoParams::default())?;
    println!("bark: seam {:.2}, {:.2} before", bark.seam, bark.seam_before);
    write(&folder, "bark-1-photograph", &photograph)?;
    write(&folder, "bark-2-repeated", &four(&photograph))?;
    write(&folder, "bark-3-tile", &bark.texture)?;
    write(&folder, "bark-4-four-tiles", &four(&bark.texture))?;
    std::fs::write(folder.join("bark.penstemon"), json::write(&bark.drawing()?))?;
    Ok(())
}

fn blade(
    folder: &Path,
    name: &str,
    (photograph, kind, copies): (&Rgba, BladeKind, u32),
    params: &PhotoParams,
) -> anyhow::Result<()> {
    let photo = BladePhoto::of_photograph(photograph, None, params)?;
    let Rgba { width, height, .. } = photo.texture;
    println!(
        "{name}: {} points, {} creases, texture {width}×{height}, remarks {:?}",
        photo.outline.len(),
        photo.cleaned.creases,
        photo.remarks
    );
    write(folder, &format!("{name}-1-photograph"), photograph)?;
    let mut traced = Panel::of(photograph);
    traced.closed(&photo.outline, 4.0, LINE);
    traced.line(photo.base, photo.tip, 2.0, MARK);
    for end in [photo.base, photo.tip] {
        traced.dot(end, 11.0, MARK);
    }
    write(folder, &format!("{name}-2-outline"), &traced.picture)?;
    write(folder, &format!("{name}-3-triangles"), &triangles(&photo)?)?;
    write(folder, &format!("{name}-4-texture"), &photo.texture)?;
    std::fs::write(
        folder.join(format!("{name}.penstemon")),
        json::write(&photo.drawing((photograph, params), kind, copies)?),
    )?;
    Ok(())
}

/// The blade in its plane: its texture as its UV lays it there, and its triangulation.
fn triangles(photo: &BladePhoto) -> anyhow::Result<Rgba> {
    let mut panel = Panel::blank(SIZE);
    let (low, high) = photo
        .template
        .outline()
        .iter()
        .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
    let scale = 900.0 / (high - low).y.max((high - low).x * 1.15);
    let middle = 0.5 * (low + high);
    let half = 0.5 * Vec2::new(SIZE.0 as f32, SIZE.1 as f32);
    let on_panel = |p: Vec2| half + (p - middle) * Vec2::new(scale, -scale);
    let in_plane = |at: Vec2| middle + (at - half) / Vec2::new(scale, -scale);
    let outline: Vec<Vec2> = photo.template.outline().iter().map(|p| on_panel(*p)).collect();
    let texture = &photo.texture;
    panel.fill(&outline, |at| {
        let uv = photo.uv.uv(in_plane(at));
        let size = Vec2::new(texture.width as f32, texture.height as f32);
        let texel = (Vec2::new(uv.x, 1.0 - uv.y) * size).min(size - 1.0).as_uvec2();
        let [r, g, b, _] = texture.pixels.as_chunks::<4>().0[(texel.y * texture.width + texel.x) as usize];
        [r, g, b]
    });
    let blade = Blade {
        template: &photo.template,
        base: glam::Vec3::ZERO,
        u: glam::Vec3::X,
        v: glam::Vec3::Y,
        rest: RestSurface::Plane,
        form: BladeForm::default(),
    };
    let graph = triangulation_input(&blade, &BladeMeshParams::default()).context("no area")?;
    let size = (high - low).max_element();
    let faces =
        graph.triangulate(&mut TriangulationScratch::default()).context("the outline crosses itself")?;
    for face in &faces {
        let [a, b, c] = face.map(|i| on_panel(graph.points[i as usize] * size));
        for (from, to) in [(a, b), (b, c), (c, a)] {
            panel.line(from, to, 1.3, LINE);
        }
    }
    println!("  {} faces", faces.len());
    Ok(panel.picture)
}

/// A tile beside and above itself.
fn four(tile: &Rgba) -> Rgba {
    let row = |y: u32| &tile.pixels[(4 * y * tile.width) as usize..][..4 * tile.width as usize];
    let pixels = (0..2 * tile.height).flat_map(|y| [row(y % tile.height); 2].concat()).collect();
    Rgba { width: 2 * tile.width, height: 2 * tile.height, pixels }
}

fn write(folder: &Path, name: &str, picture: &Rgba) -> anyhow::Result<()> {
    let path = folder.join(name).with_extension("png");
    std::fs::write(&path, picture.to_png()?).with_context(|| format!("cannot write {}", path.display()))
}
