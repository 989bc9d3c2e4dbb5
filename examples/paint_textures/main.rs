//! Paints the textures that the program ships, `cargo run --release --example paint_textures [FOLDER]`.
//!
//! Without a folder they go to `assets/textures`. Everything is procedural and from fixed seeds, so every run writes
//! the same bytes. Blade pictures map u across and v from base (bottom row) to tip; bark tiles both ways; discs are
//! seen from above.

mod bark;
mod catalogue;
mod color;
mod disc;
mod indexed_image;
mod leaf;
mod noise;
mod petal;
mod petals;

use anyhow::Context;
use std::path::PathBuf;

fn main() -> anyhow::Result<()> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/textures");
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| default.to_owned()));
    std::fs::create_dir_all(&folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    for texture in catalogue::all() {
        let path = folder.join(texture.name).with_extension("png");
        let bytes = texture.picture().to_png()?;
        std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}
