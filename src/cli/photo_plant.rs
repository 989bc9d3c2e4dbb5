//! `penstemon photo PICTURE --kind plant -o OUT`: a whole plant from a photograph, as crowns to grow into.

use super::common::{place, rounded};
use crate::atomic::write_group_atomically;
use crate::file_system::System;
use crate::photo::plant::{Marks, PlantColours, PlantPhoto, PlantPicture, TrunkLine};
use crate::photo::{PhotoParams, picture_of};
use crate::picture::Picture;
use crate::picture::decode::Rgba;
use crate::sketch::json;
use crate::species::Species;
use anyhow::{Context, Result, bail, ensure};
use glam::Vec2;
use serde_json::{Value, json as object};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What was written, and what there is to say of it.
pub(super) struct Written {
    /// What is odd about the photograph.
    pub(super) remarks: Vec<String>,
    /// Places and sizes.
    pub(super) stats: Value,
    /// Bytes of all files.
    pub(super) bytes: usize,
    /// How long it took to make, without reading and writing.
    pub(super) made_ms: f64,
}

/// What only whole plants have.
#[derive(Debug, clap::Args)]
pub struct PlantArgs {
    /// Of a plant: a loose line around it, pixels from the photograph's upper left corner; nothing beyond is taken.
    #[arg(long, value_name = "'X,Y X,Y…'", value_parser = line)]
    outline: Option<Line>,
    /// Of a plant: a line on it; may be given again.
    #[arg(long, value_name = "'X,Y X,Y…'", value_parser = line)]
    plant: Vec<Line>,
    /// Of a plant: a line on what is around it; may be given again.
    #[arg(long, value_name = "'X,Y X,Y…'", value_parser = line)]
    around: Vec<Line>,
    /// Of a plant: its trunk, from the foot up; it is moved onto the edges that it has on the photograph. Left out, it is found below the
    /// crown.
    #[arg(long, value_name = "'X,Y X,Y…'", value_parser = line)]
    trunk: Option<Line>,
    /// Of a plant: the species of the drawing; oak for one with a trunk, hazel for one without.
    #[arg(long, value_name = "SPECIES")]
    species: Option<String>,
}

/// A line in pixels.
#[derive(Clone, Debug, PartialEq)]
struct Line(Vec<Vec2>);

/// `X,Y X,Y…`, in pixels.
fn line(text: &str) -> Result<Line, String> {
    let places: Vec<Vec2> = text.split_whitespace().map(place).collect::<Result<_, _>>()?;
    if places.is_empty() {
        Err("write it as X,Y X,Y…, for instance '320,610 330,480'".to_owned())
    } else {
        Ok(Line(places))
    }
}

impl PlantArgs {
    /// Whether any of it was given.
    pub(super) fn is_given(&self) -> bool {
        let lines = [&self.plant, &self.around].iter().any(|lines| !lines.is_empty());
        lines || self.outline.is_some() || self.trunk.is_some() || self.species.is_some()
    }

    fn marks(&self) -> Marks {
        let lines = |lines: &[Line]| lines.iter().map(|line| line.0.clone()).collect();
        let outline = self.outline.as_ref().map(|outline| outline.0.clone());
        Marks { outline, plant: lines(&self.plant), around: lines(&self.around) }
    }
}

/// A plant that was found.
struct Plant {
    found: PlantPhoto,
    species: Species,
}

/// Finds the plant on a photograph.
fn find(pixels: &Rgba, args: &PlantArgs, params: &PhotoParams) -> Result<Plant> {
    let picture = PlantPicture::new(pixels, &params.plant)?;
    let mut found = picture.find(&args.marks(), &params.plant)?;
    if let Some(trunk) = &args.trunk {
        picture.give_trunk(&mut found, &trunk.0, &params.snap);
    }
    let species =
        Species::built_in(args.species.as_deref().unwrap_or(found.usual_species())).context("--species")?;
    Ok(Plant { found, species })
}

/// Finds a plant and writes what is wanted of it.
pub(super) fn written(
    (photograph, pixels): (&Picture, &Rgba),
    (args, outputs): (&PlantArgs, &[PathBuf]),
    params: &PhotoParams,
) -> Result<Written> {
    let begun = Instant::now();
    let plant = find(pixels, args, params)?;
    let made_ms = begun.elapsed().as_secs_f64() * 1e3;
    let bytes = plant.write(outputs, photograph)?;
    let remarks = plant.found.remarks.iter().map(ToString::to_string).collect();
    Ok(Written { remarks, stats: plant.stats(), bytes, made_ms })
}

/// Refuses names of files that nothing can be written to and lines that are none, before anything is searched.
pub(super) fn check(args: &PlantArgs, outputs: &[PathBuf]) -> Result<()> {
    let places = |line: &Option<Line>| line.as_ref().map_or(usize::MAX, |line| line.0.len());
    ensure!(places(&args.outline) >= 3, "--outline: a line around a plant has at least three places");
    ensure!(places(&args.trunk) >= 2, "--trunk: a trunk has at least two places");
    outputs.iter().try_for_each(|path| ending(path).map(|_| ()))
}

impl Plant {
    /// Writes mask, outlines and drawing, by the endings of the names; the number of bytes.
    fn write(&self, outputs: &[PathBuf], photograph: &Picture) -> Result<usize> {
        let bytes = |path: &PathBuf| -> Result<(PathBuf, Vec<u8>)> {
            let bytes = match ending(path)? {
                Output::Mask => picture_of(&self.found.mask_picture())?.bytes().to_vec(),
                Output::Outlines => self.svg().into_bytes(),
                Output::Drawing => {
                    json::write(&self.found.drawing(photograph.clone(), &self.species)?).into_bytes()
                }
            };
            Ok((path.clone(), bytes))
        };
        let files: Vec<(PathBuf, Vec<u8>)> = outputs.iter().map(bytes).collect::<Result<_>>()?;
        let group: Vec<(PathBuf, &[u8])> =
            files.iter().map(|(path, bytes)| (path.clone(), &bytes[..])).collect();
        write_group_atomically(&System, &group)?;
        Ok(files.iter().map(|(_, bytes)| bytes.len()).sum())
    }

    /// Crowns and trunk over the photograph, as a drawing that lies exactly on it.
    fn svg(&self) -> String {
        let (width, height) = (self.found.size.x, self.found.size.y);
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n"
        );
        let crowns = self.found.crown.iter().map(|line| ("crown", &line.points, " Z"));
        let trunk = self.found.trunk.iter().map(|trunk| ("branch", &trunk.points, ""));
        for (tool, points, end) in crowns.chain(trunk) {
            let mut path = String::new();
            for (i, p) in points.iter().enumerate() {
                // Writing to text cannot fail.
                let _ = write!(path, "{}{:.1} {:.1}", if i == 0 { "M" } else { " L" }, p.x, p.y);
            }
            let _ = writeln!(
                text,
                "  <path data-tool=\"{tool}\" fill=\"none\" stroke=\"black\" d=\"{path}{end}\"/>"
            );
        }
        text + "</svg>\n"
    }

    /// What was found, in numbers.
    fn stats(&self) -> Value {
        let found = &self.found;
        let holes = found.crown.iter().filter(|line| line.is_hole).count();
        let points: usize = found.crown.iter().map(|line| line.points.len()).sum();
        object!({
            "kind": "plant",
            "share": rounded(found.share.into()),
            "crowns": found.crown.len() - holes,
            "holes": holes,
            "crown_points": points,
            "trunk": found.trunk.as_ref().map(trunk_stats),
            "colours": colours(&found.colours),
            "species": self.species.name,
        })
    }
}

fn trunk_stats(trunk: &TrunkLine) -> Value {
    let place = |p: Vec2| object!([rounded(p.x.into()), rounded(p.y.into())]);
    let ends = [trunk.points.first(), trunk.points.last()].map(|p| p.copied().map(place));
    object!({ "foot": ends[0], "top": ends[1], "width": rounded(trunk.usual_width().into()) })
}

/// Colours as `#rrggbb`.
fn colours(colours: &PlantColours) -> Value {
    let hex = |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}");
    object!({
        "leaf": hex(colours.leaf),
        "leaf_dark": hex(colours.leaf_dark),
        "leaf_light": hex(colours.leaf_light),
        "bark": colours.bark.map(hex),
    })
}

/// What can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Output {
    Mask,
    Outlines,
    Drawing,
}

fn ending(path: &Path) -> Result<Output> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("png") => Ok(Output::Mask),
        Some("svg") => Ok(Output::Outlines),
        Some("penstemon") => Ok(Output::Drawing),
        _ => bail!(
            "{}: what is to be written? .png is the mask, .svg crowns and trunk, .penstemon a drawing of them over the photograph",
            path.display()
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_places_with_spaces_between() {
        assert_eq!(line("3,4  5,6.5"), Ok(Line(vec![Vec2::new(3.0, 4.0), Vec2::new(5.0, 6.5)])));
        for text in ["", " ", "3 4", "3,4;5,6", "1,2 nan,3"] {
            assert!(line(text).is_err(), "{text}");
        }
    }

    #[test]
    fn endings_say_what_is_written() {
        let of = |name: &str| ending(Path::new(name)).ok();
        assert_eq!(
            (of("a.PNG"), of("a.svg"), of("a.penstemon"), of("a.glb")),
            (Some(Output::Mask), Some(Output::Outlines), Some(Output::Drawing), None)
        );
    }
}
