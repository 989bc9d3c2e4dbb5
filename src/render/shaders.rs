//! The WGSL sources, put together from their shared beginnings.

/// Joins files of `shaders/` into one module.
macro_rules! wgsl {
    ($($file:literal),+) => {
        concat!($(include_str!(concat!("../../shaders/", $file, ".wgsl")), "\n"),+)
    };
}

pub(super) const SURFACE: &str = wgsl!("frame", "light", "material", "placement", "surface");
pub(super) const SHADOW: &str = wgsl!("material", "placement", "shadow");
pub(super) const GROUND: &str = wgsl!("frame", "light", "full_screen", "ground");
pub(super) const INK: &str = wgsl!("ink");
pub(super) const MIPMAP: &str = wgsl!("full_screen", "mipmap");
pub(super) const PRESENT: &str = wgsl!("full_screen", "present");
pub(super) const PAPER: &str = wgsl!("canvas", "full_screen", "paper");
pub(super) const REFERENCE: &str = wgsl!("canvas", "reference");
pub(super) const STROKE: &str = wgsl!("canvas", "stroke");
pub(super) const DEBUG: &str = wgsl!("frame", "placement", "debug");
pub(super) const OVERLAY: &str = wgsl!("frame", "overlay");

#[cfg(test)]
mod tests {
    use super::*;
    use wgpu::naga::{front::wgsl, valid};

    const MODULES: [(&str, &str); 11] = [
        ("surface", SURFACE),
        ("shadow", SHADOW),
        ("ground", GROUND),
        ("ink", INK),
        ("mipmap", MIPMAP),
        ("present", PRESENT),
        ("debug", DEBUG),
        ("overlay", OVERLAY),
        ("paper", PAPER),
        ("reference", REFERENCE),
        ("stroke", STROKE),
    ];

    #[test]
    fn every_module_is_valid() {
        for (name, source) in MODULES {
            let module =
                wgsl::parse_str(source).unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(source)));
            let mut validator =
                valid::Validator::new(valid::ValidationFlags::all(), valid::Capabilities::empty());
            validator.validate(&module).unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(source)));
            assert!(!module.entry_points.is_empty(), "{name} has no entry point");
        }
    }

    #[test]
    fn every_file_is_part_of_a_module() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(MODULES.iter().any(|(_, source)| source.contains(&text)), "{} is unused", path.display());
        }
    }
}
