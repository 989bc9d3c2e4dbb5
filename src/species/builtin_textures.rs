//! The textures that are part of the program.

use include_dir::{Dir, include_dir};

static TEXTURES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/textures");

/// The bytes of a built-in texture, a PNG file, by its file name such as `petal_daisy.png`.
pub fn builtin_texture(name: &str) -> Option<&'static [u8]> {
    TEXTURES.get_file(name).map(|file| file.contents())
}

/// File names of all built-in textures, sorted.
pub fn texture_names() -> Vec<&'static str> {
    names(&TEXTURES)
}

/// Names of the files in a folder of the program, sorted.
pub(super) fn names(dir: &'static Dir<'static>) -> Vec<&'static str> {
    let mut names: Vec<_> = dir.files().filter_map(|file| file.path().to_str()).collect();
    names.sort_unstable();
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::species::Species;

    #[test]
    fn every_texture_is_used_and_decodes() {
        let used: Vec<String> = Species::all()
            .into_iter()
            .flat_map(|name| std::mem::take(&mut Species::built_in(name).unwrap().materials).into_values())
            .filter_map(|look| look.built_in_texture().map(str::to_owned))
            .collect();
        for name in texture_names() {
            assert!(used.iter().any(|u| u == name), "{name} is not used by any species");
            let bytes = builtin_texture(name).unwrap();
            let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
            assert!(reader.info().width >= 128 && reader.info().height >= 128, "{name}");
        }
        let total: usize = texture_names().iter().map(|name| builtin_texture(name).unwrap().len()).sum();
        assert!(total <= 7 << 20, "textures take {total} bytes");
    }
}
