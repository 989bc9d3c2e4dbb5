//! Draws the reference sketches and writes them to `assets/sketches/` and `tests/fixtures/sketches/`.
//!
//! ```text
//! cargo run --example draw_sketches [FOLDER]
//! ```
//!
//! With a folder, everything goes there instead, side by side, for looking at before it replaces what is committed.
//! The drawings are made by rule from a fixed seed: the same program writes the same bytes.

mod drawing;

use std::path::{Path, PathBuf};

fn main() -> std::io::Result<()> {
    let elsewhere = std::env::args_os().nth(1).map(PathBuf::from);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for drawn in drawing::all() {
        let folder = elsewhere.clone().unwrap_or_else(|| root.join(drawn.folder));
        std::fs::create_dir_all(&folder)?;
        std::fs::write(folder.join(drawn.file_name()), drawn.sheet.to_json())?;
    }
    Ok(())
}
