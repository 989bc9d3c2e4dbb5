//! `penstemon bloom SPECIES -o OUT`: a full flower on its stem, as far open as asked for, or opening frame by frame.

use super::common;
use super::studio::{Outputs, PictureArgs, Studio, check_names, open_species};
use crate::input::Sources;
use crate::pipeline::{self, Bloom, Built, Cache};
use crate::plant::OrganKind;
use crate::species::Species;
use anyhow::{Context, Result, ensure};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `bloom`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// A species with full flowers, by name or by the path of its .toml file.
    #[arg(required_unless_present = "list")]
    pub species: Option<String>,
    /// Where the flower goes: .glb, .obj (with .mtl and textures), .json, or .png for a picture; may be given again.
    #[arg(short, long = "out", value_name = "FILE", required_unless_present = "list")]
    pub out: Vec<PathBuf>,
    /// How far it has opened: 0 bud, 1 full bloom.
    #[arg(long, value_name = "X")]
    pub open: Option<f32>,
    /// The flower opening in this many steps, from a bud to --open, each in a file with a number before the ending: an
    /// animation.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=3600))]
    pub frames: Option<u16>,
    /// Seed of everything random.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Petals in GLB as copies of a few meshes; `nodes` for every program, `gpu` for those that read EXT_mesh_gpu_instancing.
    #[arg(long, value_name = "FORM")]
    pub instances: Option<common::Instances>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub pictures: PictureArgs,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub assignments: common::Assignments,
    /// Print times, counts and bytes written as one JSON object.
    #[arg(long)]
    pub stats: bool,
    /// Print the names of the built-in species with full flowers, one a line.
    #[arg(long)]
    pub list: bool,
}

/// Runs `bloom`.
///
/// # Errors
/// A species that cannot be used or has no full flowers, an output that cannot be written.
pub fn run(args: &Args) -> Result<ExitCode> {
    if args.list {
        common::print(&Species::blooming().join("\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    check_names(&args.out)?;
    let name = args.species.as_deref().context("which species?")?;
    let species = open_species(name)?;
    pipeline::check_blooms(&species)?;
    let mut sources = Sources::default();
    sources.add(Path::new(name));
    species.picture_files().for_each(|picture| sources.add(picture));
    sources.spare(args.out.iter().map(PathBuf::as_path))?;
    if let Some(open) = args.open {
        ensure!((0.0..=1.0).contains(&open), "--open {open}: write a number from 0 (bud) to 1 (full bloom)");
    }
    let mut bed = Bed { name, args, species: &species, cache: Cache::default() };
    let open = args.open.unwrap_or(1.0);
    let built = bed.grow(open)?;
    let outputs =
        Outputs { outs: &args.out, instances: args.instances, sources: &sources, pictures: args.pictures };
    let mut studio = Studio::new(&outputs, &built)?;
    let bytes = match args.frames {
        None => studio.write(&built, &Path::to_owned)?,
        Some(frames) => {
            let mut bytes = 0;
            for frame in 1..=frames {
                let built = bed.grow(open * f32::from(frame - 1) / f32::from(frames - 1))?;
                bytes += studio.write(&built, &|out| common::numbered(out, usize::from(frame)))?;
            }
            bytes
        }
    };
    if args.stats {
        let mut stats = common::stats(&built.stages, &built.model, bytes);
        let petals = built.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal).count();
        stats["petals"] = petals.into();
        stats["flowers"] = built.plant.flowers.len().into();
        common::print(&stats.to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A species whose flower is made at several openings.
struct Bed<'a> {
    name: &'a str,
    args: &'a Args,
    species: &'a Species,
    cache: Cache,
}

impl Bed<'_> {
    /// The flower at an opening.
    fn grow(&mut self, open: f32) -> Result<Built> {
        let mut assignments = self.args.assignments.all();
        assignments.push(format!("flower.open={open}"));
        let params = pipeline::params_of_species(self.species, &assignments);
        let params = params.with_context(|| self.name.to_owned())?;
        let bloom = Bloom { number: self.args.seed };
        let built = pipeline::build_with(&mut self.cache, &bloom, self.species, &params, &|| false);
        let built = built.context("nothing stops it")?;
        for warning in &built.remarks {
            tracing::warn!("{}: {warning}", self.name);
        }
        Ok(built)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{Cli, Verb};
    use clap::Parser;

    fn parse(line: &str) -> Result<Args, clap::Error> {
        match Cli::try_parse_from(line.split_whitespace())?.verb {
            Some(Verb::Bloom(args)) => Ok(args),
            other => panic!("{other:?}"),
        }
    }

    fn message(line: &str) -> String {
        crate::cli::one_line(&run(&parse(line).unwrap()).unwrap_err())
    }

    #[test]
    fn faults_are_reported_before_anything_is_written() {
        assert!(message("penstemon bloom peonny -o a.glb").contains("did you mean `peony`?"));
        assert!(message("penstemon bloom birch -o a.glb").contains("[flowers.layers]"));
        assert!(message("penstemon bloom peony -o a.xyz").contains("xyz"));
        assert!(message("penstemon bloom peony --open 2 -o a.glb").contains("--open"));
        let set = |what: &str| message(&format!("penstemon bloom peony --set {what} -o a.glb"));
        assert!(set("flower.layers.cuont=3").contains("did you mean `flower.layers.count`?"));
        assert!(set("flower.layers.shrink=1.5").contains("outside 0.3 to 1"));
    }

    #[test]
    fn frames_are_the_flower_opening() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path().display();
        let line = format!("penstemon bloom peony --frames 3 -o {here}/a.json -o {here}/a.glb");
        run(&parse(&line).unwrap()).unwrap();
        let read = |frame: u32| std::fs::read(folder.path().join(format!("a-{frame:03}.glb"))).unwrap();
        assert!(read(1) != read(2) && read(2) != read(3));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 6);
    }
}
