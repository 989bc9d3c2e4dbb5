//! `penstemon render`: a picture of a sketch or a model, a turntable of pictures, or the drawing itself.

use super::common::{self, BuildOptions, Setup};
use super::studio::{self, Size};
use super::walk::{self, Walk};
use crate::atomic;
use crate::formats::read::{Embedded, Loaded, ReadFormat, load};
use crate::formats::textures::{self, fetch};
use crate::garden::Seen;
use crate::garden::painted::simplified;
use crate::input::Sources;
use crate::pipeline;
use crate::plant::Texture;
use crate::render::{Direction, PictureOptions, Projection, RenderedImage, Renderer, View};
use crate::sketch::{GardenTool, Sketch};
use anyhow::{Context as _, Result, bail, ensure};
use std::borrow::Cow;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// What is seen, and from where.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ViewName {
    /// As it was drawn.
    Front,
    /// From its right.
    Side,
    /// From above.
    Top,
    /// From the front right and a little above.
    ThreeQuarter,
    /// Not the plant but the drawing, as ink on paper.
    Drawing,
}

impl ViewName {
    /// The direction of the camera; that of the drawing from the front.
    pub fn direction(self) -> Direction {
        match self {
            ViewName::Front | ViewName::Drawing => Direction::Front,
            ViewName::Side => Direction::Side,
            ViewName::Top => Direction::Top,
            ViewName::ThreeQuarter => Direction::ThreeQuarter,
        }
    }
}

/// Arguments of `penstemon render`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Sketch (.penstemon, .svg) or model (.obj, .glb).
    input: PathBuf,
    /// The picture, a PNG file; the pictures of a turntable get a number before the ending.
    #[arg(short, long, value_name = "OUT.png")]
    out: PathBuf,
    /// Width and height of each picture in pixels.
    #[arg(long, value_name = "WxH", default_value = "1200x900")]
    size: Size,
    /// From where the plant is seen.
    #[arg(long, value_enum, default_value_t = ViewName::Front)]
    view: ViewName,
    /// Without perspective, exactly level from front and side.
    #[arg(long)]
    orthographic: bool,
    /// Pictures all around the plant, this many.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=3600), conflicts_with = "with_drawing")]
    turntable: Option<u32>,
    /// Pictures on a walk along the longest path that is painted in the sketch's garden, or through the scene, this many.
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=3600),
        conflicts_with_all = ["with_drawing", "turntable", "view", "orthographic"]
    )]
    walk: Option<u32>,
    /// Only the plant: no paper, no shadow on it.
    #[arg(long, conflicts_with = "with_drawing")]
    transparent: bool,
    /// On a lawn under the sky, instead of paper; walks always are.
    #[arg(long, conflicts_with = "transparent")]
    outdoors: bool,
    /// Puts the drawing to the left of the plant, each of the given size.
    #[arg(long)]
    with_drawing: bool,
    #[command(flatten)]
    build: BuildOptions,
}

impl Args {
    fn options(&self) -> PictureOptions {
        let background = studio::background(self.transparent, self.outdoors || self.walk.is_some());
        PictureOptions { width: self.size.width, height: self.size.height, background }
    }

    /// The pictures that will be written.
    fn pictures(&self) -> Vec<PathBuf> {
        match self.turntable.or(self.walk) {
            Some(count) => walk::pictures(&self.out, count),
            None => vec![self.out.clone()],
        }
    }

    fn first_view(&self) -> View {
        let projection = if self.orthographic { Projection::Orthographic } else { Projection::Perspective };
        View { direction: self.view.direction(), projection, turn_deg: 0.0 }
    }
}

/// Runs the verb.
///
/// # Errors
/// What went wrong, ready to be shown.
pub fn run(args: &Args) -> Result<ExitCode> {
    if args.view == ViewName::Drawing {
        return render_drawing(args);
    }
    let scene = Scene::open(args)?;
    scene.sources.spare(args.pictures().iter().map(PathBuf::as_path))?;
    let mut renderer = Renderer::new()?;
    tracing::debug!("drawn by {}", renderer.adapter());
    let bytes = match &scene.drawn {
        Some(drawn) if args.with_drawing => {
            let drawing = renderer.drawing(drawn, &args.options())?;
            let plant =
                renderer.picture(scene.seen.clone(), &scene.textures(), &args.first_view(), &args.options());
            let plant = plant.with_context(|| args.input.display().to_string())?;
            write(&args.out, &drawing.beside(&plant))?
        }
        _ => render_views(args, &scene, &mut renderer)?,
    };
    if args.build.stats {
        common::print(&common::stats(&scene.stages, scene.seen.clone(), bytes).to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes the drawing alone; no plant is built.
fn render_drawing(args: &Args) -> Result<ExitCode> {
    if args.with_drawing || args.turntable.is_some() || args.transparent || args.outdoors || args.build.stats
    {
        bail!(
            "`--view drawing` shows the drawing alone; leave out --with-drawing, --turntable, --transparent, --outdoors and --stats"
        );
    }
    if ReadFormat::of(&args.input).is_some() {
        bail!(no_drawing(&args.input));
    }
    let (sketch, sources) = common::open_sketch(&args.input)?;
    sources.spare([args.out.as_path()])?;
    write(&args.out, &Renderer::new()?.drawing(&sketch, &args.options())?)?;
    Ok(ExitCode::SUCCESS)
}

/// Writes the pictures of a model that `args` ask for and returns their size in bytes.
fn render_views(args: &Args, scene: &Scene, renderer: &mut Renderer) -> Result<usize> {
    let of_input = || args.input.display().to_string();
    let mut uploaded = renderer.upload(scene.seen.clone(), &scene.textures()).with_context(of_input)?;
    if let Some(count) = args.walk {
        return scene.walk(count).write(renderer, &mut uploaded, &args.out, &args.options());
    }
    let views: Vec<View> = args.first_view().turntable(args.turntable.unwrap_or(1)).collect();
    let mut bytes = 0;
    let pictures = renderer.pictures(&mut uploaded, &views, &args.options());
    for (path, picture) in args.pictures().iter().zip(pictures) {
        bytes += write(path, &picture.with_context(of_input)?)?;
    }
    Ok(bytes)
}

fn write(path: &Path, picture: &RenderedImage) -> Result<usize> {
    let bytes = picture.to_png()?;
    atomic::write_atomically(path, &bytes)?;
    Ok(bytes.len())
}

fn no_drawing(path: &Path) -> String {
    format!("{} is a model; only a sketch has a drawing to show", path.display())
}

/// What a picture is made of.
struct Scene {
    seen: Seen<'static>,
    /// Pictures inside a model file.
    embedded: Embedded,
    /// Where the plant was drawn.
    drawn: Option<Sketch>,
    /// What it took to read or build it.
    stages: common::Stages,
    /// The files that it comes from.
    sources: Sources,
}

impl Scene {
    /// Opens a model file, or builds the plant of a sketch.
    fn open(args: &Args) -> Result<Self> {
        if ReadFormat::of(&args.input).is_some() {
            return Self::read(args);
        }
        let setup = Setup::open(&args.input, &args.build.setup)?;
        let built = setup.build(&args.input);
        let (seen, stages) = (pipeline::seen(&built).into_owned(), built.stages);
        let Setup { sketch, mut sources, .. } = setup;
        textures::files(&seen.model.materials).for_each(|picture| sources.add(picture));
        Ok(Self { seen, embedded: Embedded::default(), drawn: Some(sketch), stages, sources })
    }

    fn read(args: &Args) -> Result<Self> {
        let given = args.build.setup.given();
        let path = args.input.display();
        ensure!(
            given.is_empty(),
            "{path} is a model and drawn as it is; leave out {}, of use for a sketch only",
            given.join(", ")
        );
        ensure!(!args.with_drawing, no_drawing(&args.input));
        let begin = Instant::now();
        let Loaded { model, embedded, files, warnings } = load(&args.input)?;
        let stages = vec![("read", begin.elapsed())];
        let mut sources = Sources::default();
        sources.add(&args.input);
        files.iter().for_each(|file| sources.add(file));
        for warning in warnings {
            tracing::warn!("{path}: {warning}");
        }
        let seen = Seen { model: Cow::Owned(model), crowd: None };
        Ok(Self { seen, embedded, drawn: None, stages, sources })
    }

    /// A walk along the garden's longest path, or through the scene.
    fn walk(&self, count: u32) -> Walk<'_> {
        let bounds = self.seen.bounds().unwrap_or_default();
        let garden = self.drawn.iter().flat_map(|sketch| sketch.garden.iter());
        let paths = garden.filter(|stroke| stroke.tool == GardenTool::Path).map(|stroke| {
            simplified(&stroke.points, stroke.radius).iter().map(|point| point.at).collect::<Vec<_>>()
        });
        let line = walk::longest(paths, bounds);
        Walk { line, ground: &|_| 0.0, highest: bounds.1.y, count }
    }

    /// The files of the textures.
    fn textures(&self) -> impl Fn(&Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> {
        |texture| match self.embedded.get(texture) {
            Some(bytes) => Ok(bytes.to_vec().into()),
            None => Ok(fetch(texture, &common::built_in_texture)?),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{Cli, Verb};
    use crate::render::Background;
    use clap::Parser;

    fn parse(line: &str) -> Result<Args, clap::Error> {
        match Cli::try_parse_from(line.split_whitespace())?.verb {
            Some(Verb::Render(args)) => Ok(args),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn arguments_become_a_view_and_options() {
        let args =
            parse("penstemon render a.obj -o b.png --view three-quarter --size 8x6 --transparent").unwrap();
        assert_eq!(
            args.options(),
            PictureOptions { width: 8, height: 6, background: Background::Transparent }
        );
        assert_eq!(args.first_view().direction, Direction::ThreeQuarter);
        assert_eq!(args.first_view().projection, Projection::Perspective);
    }

    #[test]
    fn what_excludes_each_other_is_wrong_usage() {
        for options in [
            "--turntable 0",
            "--turntable 3 --with-drawing",
            "--transparent --with-drawing",
            "--view up",
            "--walk 3 --view top",
            "--walk 0",
            "--outdoors --transparent",
        ] {
            assert!(parse(&format!("penstemon render a -o b {options}")).is_err(), "{options}");
        }
        let drawing = parse("penstemon render a -o b --view drawing --turntable 3").unwrap();
        assert!(run(&drawing).unwrap_err().to_string().contains("--turntable"));
    }
}
