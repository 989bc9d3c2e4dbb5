//! Paints the textures that the program ships, `cargo run --release --example paint_textures [FOLDER [NAME…]]`.
//!
//! Without a folder they go to `assets/textures`; with names only those that have them are painted. Everything is procedural and from
//! fixed seeds, so every run writes the same bytes. Blade pictures map u across and v from base (bottom row) to tip; bark tiles both
//! ways; discs are seen from above.

mod bark;
mod catalogue;
mod color;
mod disc;
mod flesh;
mod fruit;
mod indexed_image;
mod leaf;
mod leafy_shoot;
mod needles;
mod noise;
mod petal;
mod petals;
mod shoots;
mod tree_bark;

use anyhow::Context;
use std::path::PathBuf;

fn main() -> anyhow::Result<()> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/textures");
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or_else(|| default.to_owned()));
    anyhow::ensure!(
        !folder.to_string_lossy().starts_with('-'),
        "give a folder, then names of textures; there are no options"
    );
    let names: Vec<String> = arguments.collect();
    std::fs::create_dir_all(&folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    for texture in catalogue::all().into_iter().filter(|t| wanted(t.name)) {
        let path = folder.join(texture.name).with_extension("png");
        let bytes = texture.picture().to_png()?;
        std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}
