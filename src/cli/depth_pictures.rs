//! `penstemon inspect SKETCH --depth DIR`: what the network sees of a drawing and what it answers, as grey pictures of 16 bits.
//!
//! `sees_*.png` are the channels of its picture, `half_depth.png`, `error.png`, `stray.png` and `away.png` its answer: 0 is nothing, 65535
//! half the picture's side.

use super::common::Setup;
use crate::anatomy::Anatomy;
use crate::atomic::write_group_atomically;
use crate::depth;
use crate::file_system::System;
use crate::learned_depth::{DepthField, Memory, picture};
use anyhow::{Context as _, Result};
use std::path::{Path, PathBuf};

/// Writes the pictures of a drawing into a folder, which is made where it is missing.
///
/// # Errors
/// A drawing without a crown, or a folder that cannot be written to.
pub(super) fn write(folder: &Path, setup: &Setup, anatomy: &Anatomy) -> Result<()> {
    let (learned, trunk) = (&setup.params.depth.learned, setup.params.depth.world.trunk);
    let mut memory = Memory::default();
    let field = depth::learned::field_of(&mut memory, anatomy, Some(&setup.species.name), trunk, learned);
    let field = field.context(
        "no depth was asked for: the drawing has no crown, depth.learned.… are 0, or this program was built without weights; draw a crown",
    )?;
    tracing::info!("believed by {:.2}", field.belief());
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let seen = memory.picture().map_or(&[][..], picture::Picture::channels);
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    for (name, channel) in SEEN.iter().zip(seen.chunks_exact(picture::SIDE * picture::SIDE)) {
        files.push((folder.join(format!("sees_{name}.png")), grey(channel, 1.0)?));
    }
    for (name, cells) in answers(&field) {
        files.push((folder.join(format!("{name}.png")), grey(cells, 1.0 / picture::DEEPEST)?));
    }
    let group: Vec<(PathBuf, &[u8])> = files.iter().map(|(path, bytes)| (path.clone(), &bytes[..])).collect();
    Ok(write_group_atomically(&System, &group)?)
}

/// Channels of the picture that are written; directions and places are left out.
const SEEN: [&str; 3] = ["crown", "inflated", "wood"];

fn answers(field: &DepthField) -> [(&'static str, &[f32]); 4] {
    let answer = field.answer();
    [
        ("half_depth", &answer.half_depth),
        ("error", &answer.error),
        ("stray", &answer.stray),
        ("away", &answer.away),
    ]
}

/// A square picture of numbers, of which `1 / scale` is white.
fn grey(cells: &[f32], scale: f32) -> Result<Vec<u8>> {
    let side = cells.len().isqrt() as u32;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let value = |cell: &f32| ((cell * scale).clamp(0.0, 1.0) * 65535.0).round() as u16;
    let pixels: Vec<u8> = cells.iter().flat_map(|cell| value(cell).to_be_bytes()).collect();
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(bytes)
}
