//! `penstemon build SKETCH -o OUT`: drawing to plant.

use super::common::{self, BuildOptions, Instances, Setup};
use super::lod::{self, Lod};
use super::studio::{Outputs, PictureArgs, Studio, check_names};
use anyhow::ensure;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `build`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The drawing: .penstemon or .svg.
    pub sketch: PathBuf,
    /// Where the plant goes: .glb, .obj (with .mtl and textures), .json, or .png for a picture; may be given again.
    #[arg(short, long = "out", value_name = "FILE", required = true)]
    pub out: Vec<PathBuf>,
    /// Leaves and petals in GLB as copies of a few meshes instead of one large mesh; `nodes` for every program, `gpu` for
    /// those that read EXT_mesh_gpu_instancing.
    #[arg(long, value_name = "FORM")]
    pub instances: Option<Instances>,
    /// Levels of detail: hero, game, mobile, or numbers of triangles such as 80000,25000,5000,billboards. GLB holds all of them
    /// (MSFT_lod), of OBJ each has a file.
    #[arg(long, value_name = "LEVELS")]
    pub lod: Option<Lod>,
    /// With --lod: capsules around trunk and thick branches beside the finest level, as meshes called UCP_wood_LOD0_01 and so on,
    /// with which games find out what runs into the plant.
    #[arg(long, requires = "lod")]
    pub capsules: bool,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub pictures: PictureArgs,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub options: BuildOptions,
}

/// Runs `build`.
///
/// # Errors
/// A drawing that cannot be read or holds nothing to build, an output that cannot be written.
pub fn run(args: &Args) -> anyhow::Result<ExitCode> {
    check_names(&args.out)?;
    let setup = Setup::open(&args.sketch, &args.options.setup)?;
    setup.sources.spare(args.out.iter().map(PathBuf::as_path))?;
    let built = setup.build(&args.sketch);
    ensure!(
        !built.model.parts.is_empty() || built.garden.is_some(),
        "{}: no stroke is long enough to be a petal, a leaf or a branch; draw something larger",
        args.sketch.display()
    );
    let (bytes, levels) = match &args.lod {
        Some(lod) => lod::export(
            &args.out,
            (&built, &setup.params),
            (lod, args.capsules),
            args.instances,
            &setup.sources,
        )?,
        None => {
            let (outs, instances, sources) = (&args.out[..], args.instances, &setup.sources);
            let outputs = Outputs { outs, instances, sources, pictures: args.pictures };
            (Studio::new(&outputs, &built)?.write(&built, &Path::to_owned)?, Vec::new())
        }
    };
    if args.options.stats {
        let mut stats = common::stats(&built.stages, &built.model, bytes);
        if !levels.is_empty() {
            stats["levels"] = levels.into();
        }
        common::print(&stats.to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{Cli, Verb};
    use clap::Parser;

    #[test]
    fn a_drawing_becomes_a_model_and_a_picture_of_it() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path().display();
        let line = format!(
            "penstemon build assets/sketches/daisy.penstemon --size 64x48 -o {here}/a.glb -o {here}/a.png"
        );
        let Some(Verb::Build(args)) = Cli::try_parse_from(line.split_whitespace()).unwrap().verb else {
            panic!("{line}")
        };
        run(&args).unwrap();
        assert!(std::fs::read(folder.path().join("a.glb")).unwrap().starts_with(b"glTF"));
        assert!(std::fs::read(folder.path().join("a.png")).unwrap().starts_with(b"\x89PNG"));
    }
}
