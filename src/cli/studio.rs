//! What verbs share that make plants: opening a species, how pictures are taken, and writing models and pictures, once or frame
//! by frame.

use super::common;
use crate::atomic;
use crate::budget::GardenBudget;
use crate::formats::textures::fetch;
use crate::formats::write::{self, Surfaces, Takes};
use crate::garden::Seen;
use crate::input::Sources;
use crate::pipeline::{self, Built};
use crate::plant::Texture;
use crate::render::{Background, Direction, ModelDrawData, PictureOptions, Projection, Renderer, View};
use crate::species::Species;
use anyhow::{Context, Result, anyhow, ensure};
use std::borrow::Cow;
use std::error::Error;
use std::path::{Path, PathBuf};

/// A built-in species, or one of the artist's own where the name is that of a file.
pub fn open_species(name: &str) -> Result<Species> {
    let own = name.ends_with(".toml");
    Ok(if own { Species::read(Path::new(name))? } else { Species::built_in(name)? })
}

/// Whether an output is a picture, not a model.
pub fn is_picture(out: &Path) -> bool {
    out.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

/// Says early that an output is neither a model nor a picture.
///
/// # Errors
/// The first whose name does not say a format.
pub fn check_names(outputs: &[PathBuf]) -> Result<()> {
    for out in outputs.iter().filter(|out| !is_picture(out)) {
        write::format_of(out).map_err(|error| anyhow!("{error}; png for a picture"))?;
    }
    Ok(())
}

/// Width and height of a picture in pixels, written `1200x900`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
}

impl std::str::FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let explain =
            || format!("`{text}` is not a size; write it as WIDTHxHEIGHT in pixels, such as 1200x900");
        let (width, height) = text.split_once('x').ok_or_else(explain)?;
        let number = |digits: &str| digits.parse().map_err(|_| explain());
        Ok(Self { width: number(width)?, height: number(height)? })
    }
}

/// Bytes of a triangle in an OBJ file, about.
const OBJ_BYTES: usize = 150;
/// Size from which an OBJ file is warned of, bytes.
const LARGE_OBJ: usize = 100 << 20;

/// From where a plant is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Viewpoint {
    /// As it was drawn.
    Front,
    /// From its right.
    Side,
    /// From above.
    Top,
    /// From the front right and a little above.
    ThreeQuarter,
}

impl Viewpoint {
    /// The camera there, with perspective.
    pub fn view(self) -> View {
        let direction = match self {
            Viewpoint::Front => Direction::Front,
            Viewpoint::Side => Direction::Side,
            Viewpoint::Top => Direction::Top,
            Viewpoint::ThreeQuarter => Direction::ThreeQuarter,
        };
        View { direction, projection: Projection::Perspective, turn_deg: 0.0 }
    }
}

/// How pictures of a plant are taken.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct PictureArgs {
    /// From where pictures are taken.
    #[arg(long, value_enum, default_value_t = Viewpoint::Front)]
    pub view: Viewpoint,
    /// Width and height of pictures in pixels.
    #[arg(long, value_name = "WxH", default_value = "1200x900")]
    pub size: Size,
    /// In pictures only the plant: no paper, no shadow on it.
    #[arg(long)]
    pub transparent: bool,
    /// In pictures a lawn under the sky, instead of paper.
    #[arg(long, conflicts_with = "transparent")]
    pub outdoors: bool,
}

impl PictureArgs {
    /// Their size and background, for the renderer.
    pub fn options(&self) -> PictureOptions {
        let background = background(self.transparent, self.outdoors);
        PictureOptions { width: self.size.width, height: self.size.height, background }
    }
}

/// What plants stand on in pictures.
pub(super) fn background(transparent: bool, outdoors: bool) -> Background {
    match (transparent, outdoors) {
        (true, _) => Background::Transparent,
        (false, true) => Background::Outdoors,
        (false, false) => Background::Paper,
    }
}

/// Where plants go, and how their pictures are taken.
pub struct Outputs<'a> {
    /// Models and pictures.
    pub outs: &'a [PathBuf],
    /// In which form GLB files have copies.
    pub instances: Option<common::Instances>,
    /// The files that the plants come from.
    pub sources: &'a Sources,
    /// How pictures are taken.
    pub pictures: PictureArgs,
}

/// Writes plants, all of whose pictures are framed for one of them.
pub struct Studio<'a> {
    outputs: &'a Outputs<'a>,
    camera: Option<Camera>,
}

struct Camera {
    renderer: Renderer,
    framed_for: ModelDrawData,
}

impl<'a> Studio<'a> {
    /// A studio whose pictures are framed for a plant.
    ///
    /// # Errors
    /// Pictures are wanted and nothing can draw them.
    pub fn new(outputs: &'a Outputs<'a>, framed_for: &Built) -> Result<Self> {
        let camera = outputs.outs.iter().any(|out| is_picture(out)).then(|| {
            let renderer = Renderer::new()?;
            let framed_for = renderer.upload(pipeline::seen(framed_for), &texture)?;
            anyhow::Ok(Camera { renderer, framed_for })
        });
        Ok(Self { outputs, camera: camera.transpose()? })
    }

    /// Writes a plant to files with these names; returns the number of bytes.
    ///
    /// # Errors
    /// A file that cannot be written, a picture that cannot be drawn.
    pub fn write(&mut self, built: &Built, named: &dyn Fn(&Path) -> PathBuf) -> Result<usize> {
        let Outputs { outs, instances, sources, pictures: taken } = self.outputs;
        let (pictures, models): (Vec<PathBuf>, Vec<PathBuf>) =
            outs.iter().map(|out| named(out)).partition(|out| is_picture(out));
        sources.spare(pictures.iter().map(PathBuf::as_path))?;
        let Built { model, plant, provenance, .. } = built;
        let garden = built.garden.as_deref();
        if let Some(garden) = garden {
            models.iter().try_for_each(|out| check_size(out, garden.triangle_count()))?;
        }
        let surfaces = Surfaces { garden, ..model.into() };
        let mut bytes = common::export(&models, ((plant, provenance), surfaces), *instances, sources)?;
        if let Some(camera) = &mut self.camera {
            let png = camera.picture(pipeline::seen(built), taken)?;
            for out in &pictures {
                atomic::write_atomically(out, &png)?;
                bytes += png.len();
            }
        }
        Ok(bytes)
    }
}

impl Camera {
    /// A picture as a PNG file.
    fn picture(&mut self, seen: Seen<'_>, taken: &PictureArgs) -> Result<Vec<u8>> {
        let mut seen = self.renderer.upload(seen, &texture)?.framed_as(&self.framed_for);
        let (views, options) = ([taken.view.view()], taken.options());
        let picture = self.renderer.pictures(&mut seen, &views, &options).next().context("no picture")??;
        Ok(picture.to_png()?)
    }
}

/// A picture as a PNG file, framed for what is seen.
///
/// # Errors
/// Nothing can draw it.
pub fn picture<'s>(seen: impl Into<Seen<'s>>, view: View, options: &PictureOptions) -> Result<Vec<u8>> {
    Ok(Renderer::new()?.picture(seen, &texture, &view, options)?.to_png()?)
}

/// Refuses pictures and files without copies that so many triangles make too large, and warns of large files.
pub(super) fn check_size(out: &Path, triangles: usize) -> Result<()> {
    if is_picture(out) {
        let most = GardenBudget::GARDEN.drawn_triangles;
        ensure!(
            triangles <= most,
            "{}: {triangles} triangles are more than the {most} of a picture; choose a smaller area, fewer --triangles, or --detail card",
            out.display()
        );
        return Ok(());
    }
    if write::format_of(out)?.takes() != Takes::Triangles {
        return Ok(());
    }
    let (most, expected) = (GardenBudget::GARDEN.flat_triangles, triangles * OBJ_BYTES);
    let megabytes = expected >> 20;
    ensure!(
        triangles <= most,
        "{}: OBJ has no copies, so the {triangles} triangles of all plants would be written, about {megabytes} MiB; it gets at most {most}. \
         Write GLB, or choose fewer plants or fewer --triangles",
        out.display()
    );
    if expected > LARGE_OBJ {
        tracing::warn!("{}: OBJ has no copies, so the file will have about {megabytes} MiB", out.display());
    }
    Ok(())
}

/// The file of a texture.
pub(super) fn texture(texture: &Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> {
    Ok(fetch(texture, &common::built_in_texture)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_two_numbers() {
        assert_eq!("1200x900".parse(), Ok(Size { width: 1200, height: 900 }));
        for wrong in ["1200", "x", "12x", "-1x5", "1.5x2", "5000000000x1"] {
            assert!(wrong.parse::<Size>().unwrap_err().contains("1200x900"), "{wrong}");
        }
    }
}
