//! `penstemon lobes FILE.json -o OUT`: the closed surfaces of lobes that are drawn in space; and `--lobes` of `grow`, which fills them.

use super::{common, inside};
use crate::formats::write::{self, Takes};
use crate::growth::{Envelope, Lobes, lead_into};
use crate::input::Sources;
use crate::lobes::{self, Crown, Remesh, Shaped, text};
use crate::model::{Mesh, Model, Part, PartKind};
use crate::pipeline::Clock;
use crate::plant::{Branch, FinishedPlant, Material, Plant, Provenance};
use crate::quote;
use anyhow::{Context, Result, anyhow, ensure};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// Colours of lobes that are added and of those that are taken away.
const COLOURS: [[f32; 3]; 2] = [[0.22, 0.36, 0.14], [0.45, 0.12, 0.08]];

/// Arguments of `lobes`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Lobes as strokes in space (.json, see docs/lobes.md).
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Where the surfaces go: .obj or .glb, a part for each lobe; may be given again.
    #[arg(short, long = "out", value_name = "FILE", required = true)]
    pub out: Vec<PathBuf>,
    /// Print times, counts and bytes written as one JSON object.
    #[arg(long)]
    pub stats: bool,
}

/// Runs `lobes`.
///
/// # Errors
/// Lobes that cannot be made, an output that cannot be written.
pub fn run(args: &Args) -> Result<ExitCode> {
    for out in &args.out {
        let format = write::format_of(out)?;
        ensure!(
            format.takes() != Takes::Plant,
            "{}: lobes are surfaces, not a plant; write .obj or .glb",
            out.display()
        );
    }
    let mut sources = Sources::default();
    sources.add(&args.file);
    sources.spare(args.out.iter().map(PathBuf::as_path))?;
    let mut clock = Clock::default();
    let crown = text::read(&args.file)?;
    let shaped = clock.time("lobes", || shaped(&crown, &args.file))?;
    let model = clock.time("model", || model(&shaped));
    let plant = FinishedPlant::new(Plant::default(), &[], |_| Material::plain("plant", [0.5; 3]));
    let provenance = Provenance::default();
    let bytes = common::export(&args.out, ((&plant, &provenance), (&model).into()), None, &sources)?;
    if args.stats {
        let mut stats = common::stats(&clock.take(), &model, bytes);
        let of = |lobe: &Shaped| {
            json!({
                "triangles": lobe.surface.triangles.len(),
                "volume": lobe.surface.signed_volume(),
                "negative": lobe.negative,
            })
        };
        stats["lobes"] =
            shaped.iter().map(|lobe| (lobe.name.clone(), of(lobe))).collect::<serde_json::Map<_, _>>().into();
        common::print(&stats.to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The lobes of a file, and what is to be said of them on stderr.
fn shaped(crown: &Crown, file: &Path) -> Result<Vec<Shaped>> {
    let shaped = lobes::shape_all(crown, &Remesh::default()).map_err(|(place, name, fault)| {
        anyhow!("{}: lobe {} `{}`: {fault}", file.display(), place + 1, quote::name(&name))
    })?;
    for lobe in &shaped {
        for remark in &lobe.remarks {
            tracing::warn!("{}: lobe `{}`: {remark}", file.display(), quote::name(&lobe.name));
        }
    }
    ensure!(!shaped.is_empty(), "{}: every lobe is off; switch one on", file.display());
    Ok(shaped)
}

/// The surfaces as a model, a part for each lobe.
fn model(shaped: &[Shaped]) -> Model {
    let part = |lobe: &Shaped| {
        let mesh = Mesh::smooth(lobe.surface.points.clone(), &lobe.surface.triangles);
        Part::alone(lobe.name.as_str(), PartKind::Wood, usize::from(lobe.negative), Arc::new(mesh))
    };
    let [added, taken] = COLOURS;
    Model {
        parts: shaped.iter().map(part).collect(),
        materials: vec![Material::plain("lobe", added), Material::plain("negative_lobe", taken)],
    }
}

/// The union of the lobes of a file as a volume, and the wood that grows into it.
///
/// # Errors
/// Lobes that cannot be made, or are no volume for a plant.
pub fn volume(file: &Path) -> Result<(Envelope, Vec<Branch>)> {
    let crown = text::read(file).context("--lobes")?;
    let shaped = shaped(&crown, file).context("--lobes")?;
    // One that is too large by itself need not be joined to the others first.
    for lobe in shaped.iter().filter(|lobe| !lobe.negative) {
        let (low, high) = lobe.surface.bounds();
        let argument = format!("--lobes {}: lobe `{}`", file.display(), quote::name(&lobe.name));
        inside::check_largest(&argument, low, high)?;
    }
    let union = Lobes::new(&shaped).with_context(|| format!("--lobes {}", file.display()))?;
    ensure!(
        !union.parts().is_empty(),
        "--lobes {}: there is nothing to fill: every lobe is negative, or what is left of the others is; add a lobe that is not",
        file.display()
    );
    let (low, high) = union.bounds();
    inside::check_size(&format!("--lobes {}", file.display()), low, high)?;
    let wood = lead_into(&crown.trunks, &union);
    Ok((Envelope::Lobes(Arc::new(union)), wood))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{Cli, Verb};
    use clap::Parser;

    const RING: &str = r#"{"points": [[1,1,0],[0.7,1,0.7],[0,1,1],[-0.7,1,0.7],[-1,1,0],[-0.7,1,-0.7],[0,1,-1],[0.7,1,-0.7],[1,1,0]]}"#;

    fn parse(line: &str) -> Args {
        match Cli::try_parse_from(line.split_whitespace()).unwrap().verb {
            Some(Verb::Lobes(args)) => args,
            other => panic!("{other:?}"),
        }
    }

    fn written(folder: &Path, lobes: &str) -> PathBuf {
        let file = folder.join("crown.json");
        let text = format!("{{\"format\": \"penstemon-lobes\", \"version\": 1, \"lobes\": [{lobes}]}}");
        std::fs::write(&file, text).unwrap();
        file
    }

    #[test]
    fn surfaces_are_written_as_named_parts() {
        let folder = tempfile::tempdir().unwrap();
        let file = written(folder.path(), &format!("{{\"name\": \"top\", \"strokes\": [{RING}]}}"));
        let out = folder.path().join("top.obj");
        run(&parse(&format!("penstemon lobes {} -o {}", file.display(), out.display()))).unwrap();
        assert!(std::fs::read_to_string(&out).unwrap().lines().any(|line| line.ends_with("top")));
        let over = format!("penstemon lobes {0} -o {0}", file.display());
        assert!(crate::cli::one_line(&run(&parse(&over)).unwrap_err()).contains("json"));
    }

    #[test]
    fn what_cannot_be_filled_is_one_clear_message() {
        let folder = tempfile::tempdir().unwrap();
        let message =
            |lobes: &str| crate::cli::one_line(&volume(&written(folder.path(), lobes)).unwrap_err());
        let lobe = |rest: &str| format!("{{\"strokes\": [{RING}]{rest}}}");
        for (lobes, expected) in [
            (lobe(", \"negative\": true"), "nothing to fill"),
            (lobe(", \"off\": true"), "switch one on"),
            (lobe(", \"pose\": {\"move\": [0, -9, 0]}"), "below the ground"),
            (lobe(", \"pose\": {\"move\": [0, 9, 0], \"scale\": 200}"), "scale it"),
            ("{\"strokes\": []}".to_owned(), "no stroke"),
        ] {
            let message = message(&lobes);
            assert!(message.contains(expected) && message.starts_with("--lobes"), "{expected}: {message}");
        }
    }
}
