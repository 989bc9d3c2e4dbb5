//! `penstemon photo PICTURE -o OUT`: a petal, leaf or bark from a photograph; a whole plant is in `photo_plant`.

use super::common::{self, place, rounded};
use super::params;
use super::photo_plant::{self, PlantArgs, Written};
use crate::atomic::write_group_atomically;
use crate::file_system::System;
use crate::input::Sources;
use crate::params::{Overrides, Parameters as _};
use crate::photo::{BarkPhoto, BladeKind, BladePhoto, PhotoParams, picture_of};
use crate::picture::Picture;
use crate::picture::decode::Rgba;
use crate::sketch::{Sketch, json};
use anyhow::{Context, Result, bail, ensure};
use glam::Vec2;
use serde_json::{Value, json as object};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Arguments of `photo`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The photograph: PNG or JPEG. What is on it lies on a plain ground of another colour, or its alpha says where it is; a whole plant
    /// may stand before anything.
    #[arg(required_unless_present = "params")]
    pub picture: Option<PathBuf>,
    /// What is written: .png is the texture, of a plant its mask; .svg the outline; .penstemon a drawing with both, or of a plant with crowns
    /// and trunk over the photograph; may be given again.
    #[arg(short, long = "out", value_name = "FILE", required_unless_present = "params")]
    pub out: Vec<PathBuf>,
    /// What is on it.
    #[arg(long, default_value = "petal")]
    pub kind: Kind,
    /// Where it grows from, pixels from the photograph's upper left corner; left out, where it is narrowest near the lower edge.
    #[arg(long, value_name = "X,Y", value_parser = place, requires = "tip")]
    pub base: Option<Vec2>,
    /// Its other end, in the same way.
    #[arg(long, value_name = "X,Y", value_parser = place, requires = "base")]
    pub tip: Option<Vec2>,
    /// How many petals the drawn flower has, or leaves the stem: 5 petals, 1 leaf.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=40))]
    pub copies: Option<u32>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub whole: PlantArgs,
    /// Any parameter by its path, for instance clean.contrast=0.5; may be given again. --params lists them.
    #[arg(long = "set", value_name = "PARAM=VALUE")]
    pub assignments: Vec<String>,
    /// Print every parameter that --set can change: path, value, unit, range and meaning.
    #[arg(long)]
    pub params: bool,
    /// Print places, sizes, times and bytes written as one JSON object.
    #[arg(long)]
    pub stats: bool,
}

/// What is on a photograph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Kind {
    /// A petal.
    Petal,
    /// A leaf.
    Leaf,
    /// Bark that fills the photograph.
    Bark,
    /// A whole plant before its surroundings: crowns to grow into, trunk and colours.
    Plant,
}

/// What can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Output {
    Texture,
    Outline,
    Drawing,
}

fn output_of(path: &Path, kind: Kind) -> Result<Output> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("png") => Ok(Output::Texture),
        Some("svg") if kind == Kind::Bark => {
            bail!("{}: bark has no outline; write .png or .penstemon", path.display())
        }
        Some("svg") => Ok(Output::Outline),
        Some("penstemon") => Ok(Output::Drawing),
        _ => bail!(
            "{}: what is to be written? .png is the texture, .svg the outline, .penstemon a drawing with both",
            path.display()
        ),
    }
}

/// What came of a photograph of a part.
enum Made {
    Blade(Box<BladePhoto>, BladeKind),
    Bark(BarkPhoto),
}

/// Runs `photo`.
///
/// # Errors
/// A photograph that cannot be used, an output that cannot be written.
pub fn run(args: &Args) -> Result<ExitCode> {
    let usual = if args.kind == Kind::Leaf { PhotoParams::for_leaves() } else { PhotoParams::default() };
    if args.params {
        let all: Vec<String> = usual.describe().iter().map(params::line).collect();
        common::print(&all.join("\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    check(args)?;
    let mut overrides = Overrides::over(&usual);
    for assignment in &args.assignments {
        overrides.set_text(assignment).with_context(|| format!("--set {assignment}"))?;
    }
    let params: PhotoParams = overrides.finish()?;
    let path = args.picture.as_deref().context("which photograph?")?;
    let named = || path.display().to_string();
    let mut sources = Sources::default();
    sources.add(path);
    sources.spare(args.out.iter().map(PathBuf::as_path))?;
    let begun = Instant::now();
    let (picture, pixels) = Picture::read_with_pixels(path).with_context(named)?;
    let read_ms = begun.elapsed().as_secs_f64() * 1e3;
    let written = match args.kind {
        Kind::Plant => photo_plant::written((&picture, &pixels), (&args.whole, &args.out), &params),
        _ => written(&pixels, args, &params),
    };
    let written = written.with_context(named)?;
    written.remarks.iter().for_each(|remark| tracing::warn!("{}: {remark}", path.display()));
    if args.stats {
        let mut stats = written.stats;
        stats["photograph"] = object!([pixels.width, pixels.height]);
        stats["read_ms"] = rounded(read_ms);
        stats["made_ms"] = rounded(written.made_ms);
        stats["bytes"] = written.bytes.into();
        common::print(&stats.to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Refuses what does not go together, before anything is read.
fn check(args: &Args) -> Result<()> {
    if args.kind != Kind::Plant {
        ensure!(
            !args.whole.is_given(),
            "--outline, --plant, --around, --trunk and --species are for whole plants; add --kind plant, or leave them out"
        );
        return args.out.iter().try_for_each(|out| output_of(out, args.kind).map(|_| ()));
    }
    ensure!(
        args.base.is_none() && args.copies.is_none(),
        "a whole plant has neither --base and --tip nor --copies; leave them out"
    );
    photo_plant::check(&args.whole, &args.out)
}

fn written(pixels: &Rgba, args: &Args, params: &PhotoParams) -> Result<Written> {
    let outputs = args.out.iter().map(|out| output_of(out, args.kind)).collect::<Result<Vec<_>>>()?;
    let begun = Instant::now();
    let made = make(pixels, args, params)?;
    let made_ms = begun.elapsed().as_secs_f64() * 1e3;
    let remarks = match &made {
        Made::Blade(photo, _) => photo.remarks.iter().map(ToString::to_string).collect(),
        Made::Bark(_) => Vec::new(),
    };
    let bytes = write(args, &outputs, &made, (pixels, params))?;
    Ok(Written { remarks, stats: stats(&made), bytes, made_ms })
}

fn make(pixels: &Rgba, args: &Args, params: &PhotoParams) -> Result<Made> {
    let ends = args.base.zip(args.tip).map(|(base, tip)| [base, tip]);
    let kind = match args.kind {
        Kind::Petal => BladeKind::Petal,
        Kind::Leaf => BladeKind::Leaf,
        Kind::Bark => {
            ensure!(ends.is_none(), "bark has neither base nor tip; leave --base and --tip out");
            return Ok(Made::Bark(BarkPhoto::of_photograph(pixels, params)?));
        }
        Kind::Plant => bail!("a whole plant is no part of one"),
    };
    Ok(Made::Blade(Box::new(BladePhoto::of_photograph(pixels, ends, params)?), kind))
}

fn write(args: &Args, outputs: &[Output], made: &Made, of: (&Rgba, &PhotoParams)) -> Result<usize> {
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    for (path, output) in args.out.iter().zip(outputs) {
        let bytes = match output {
            Output::Texture => picture_of(texture_of(made))?.bytes().to_vec(),
            Output::Drawing => json::write(&drawing_of(made, args.copies, of)?).into_bytes(),
            Output::Outline => match made {
                Made::Blade(photo, kind) => svg(photo, *kind, of.0).into_bytes(),
                Made::Bark(_) => bail!("bark has no outline"),
            },
        };
        files.push((path.clone(), bytes));
    }
    let group: Vec<(PathBuf, &[u8])> = files.iter().map(|(path, bytes)| (path.clone(), &bytes[..])).collect();
    write_group_atomically(&System, &group)?;
    Ok(files.iter().map(|(_, bytes)| bytes.len()).sum())
}

fn texture_of(made: &Made) -> &Rgba {
    match made {
        Made::Blade(photo, _) => &photo.texture,
        Made::Bark(bark) => &bark.texture,
    }
}

fn drawing_of(made: &Made, copies: Option<u32>, of: (&Rgba, &PhotoParams)) -> Result<Sketch> {
    Ok(match made {
        Made::Blade(photo, kind) => {
            let usual = if *kind == BladeKind::Petal { 5 } else { 1 };
            photo.drawing(of, *kind, copies.unwrap_or(usual))?
        }
        Made::Bark(bark) => bark.drawing()?,
    })
}

/// The outline over the photograph, as a drawing that lies exactly on it.
fn svg(photo: &BladePhoto, kind: BladeKind, pixels: &Rgba) -> String {
    let (width, height, tool) = (pixels.width, pixels.height, kind.tool().name());
    let mut path = String::new();
    for (i, p) in photo.outline.iter().enumerate() {
        // Writing to text cannot fail.
        let _ = write!(path, "{}{:.2} {:.2}", if i == 0 { "M" } else { " L" }, p.x, p.y);
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n  \
         <path data-tool=\"{tool}\" fill=\"none\" stroke=\"black\" d=\"{path} Z\"/>\n</svg>\n"
    )
}

fn stats(made: &Made) -> Value {
    let texture = texture_of(made);
    let mut stats = object!({ "texture": [texture.width, texture.height] });
    match made {
        Made::Blade(photo, kind) => {
            let place = |p: Vec2| object!([rounded(p.x.into()), rounded(p.y.into())]);
            stats["kind"] = kind.tool().name().into();
            stats["base"] = place(photo.base);
            stats["tip"] = place(photo.tip);
            stats["outline_points"] = photo.outline.len().into();
            stats["creases"] = photo.cleaned.creases.into();
            stats["lightness"] = object!(photo.cleaned.lightness.map(|l| rounded(l.into())));
        }
        Made::Bark(bark) => {
            stats["kind"] = "bark".into();
            stats["seam"] = rounded(bark.seam.into());
            stats["seam_before"] = rounded(bark.seam_before.into());
        }
    }
    stats
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_say_what_is_written() {
        let of = |name: &str, kind| output_of(Path::new(name), kind).ok();
        assert_eq!(of("a.PNG", Kind::Bark), Some(Output::Texture));
        assert_eq!(of("a.svg", Kind::Leaf), Some(Output::Outline));
        assert_eq!(of("a.penstemon", Kind::Petal), Some(Output::Drawing));
        assert_eq!(
            (of("a.svg", Kind::Bark), of("a.glb", Kind::Leaf), of("a", Kind::Leaf)),
            (None, None, None)
        );
    }
}
