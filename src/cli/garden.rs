//! `penstemon garden SPEC.toml -o OUT` or `penstemon garden SPECIES… --area WxD -o OUT`: a garden of plants that are copies of a few.

use super::common::{self, Assignments, Setup, SetupOptions, Stages};
use super::studio::{self, Size, Viewpoint, check_names, check_size, is_picture, open_species};
use super::walk::{self, Walk};
use crate::atomic;
use crate::budget::GardenBudget;
use crate::formats::read::{Loaded, ReadFormat, load};
use crate::formats::write::{self, Surfaces, Takes};
use crate::garden::crowding::{self, Crowded};
use crate::garden::plan::Plan;
use crate::garden::spec::KindFields;
use crate::garden::stock::Individual;
use crate::garden::{
    Garden, GardenSpec, KindSpec, Origin, Outline, Place, Seen, Share, Stock, TileSet, surface,
};
use crate::input::Sources;
use crate::model::Model;
use crate::picture::Picture;
use crate::pipeline::{self, Clock, FEWEST_TRIANGLES, Form, Grower, triangles_of_each};
use crate::plant::{FinishedPlant, Material, Plant, Provenance, Texture};
use crate::quote;
use crate::render::{PictureOptions, Renderer};
use crate::species::Species;
use anyhow::{Context as _, Result, bail, ensure};
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// The number that decides what the tiles are like.
const TILES: u64 = 1;

/// Arguments of `garden`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// A garden's own file (.toml), or what grows: species by name or by file, drawings (.penstemon, .json, .svg), models (.glb, .obj).
    #[arg(required = true, value_name = "SPEC|PLANT")]
    pub what: Vec<String>,
    /// Where the garden goes: .glb, .obj (with .mtl and textures), .png for a picture, .json for a list of places; may be given
    /// again.
    #[arg(short, long = "out", value_name = "FILE", required = true)]
    pub out: Vec<PathBuf>,
    /// Ground that is planted, metres from left to right and from front to back.
    #[arg(long, value_name = "WxD")]
    pub area: Option<Outline>,
    /// Plants in a square metre.
    #[arg(long, value_name = "N")]
    pub density: Option<f32>,
    /// Least distance between two plants, metres; left out, as large as the density allows.
    #[arg(long, value_name = "METRES")]
    pub spacing: Option<f32>,
    /// Seed of where plants stand.
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Individuals of each kind, of which its plants are copies.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=256))]
    pub variants: Option<u32>,
    /// Only a share of the plants, without the ground: the third of 64 is 3/64. Those of all shares, one after the other, are those of the
    /// whole garden.
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Share>,
    /// What the individuals are made of and how fine they are; left out, as fine as their number and that of the plants allows.
    /// --triangles goes before.
    #[arg(long, value_name = "DETAIL")]
    pub detail: Option<Detail>,
    /// How GLB files have the plants: as `nodes` that share meshes, for every program, or as tables of EXT_mesh_gpu_instancing, `gpu`.
    #[arg(long, value_name = "FORM", default_value = "nodes")]
    pub instances: common::Instances,
    /// From where pictures are taken.
    #[arg(long, value_enum, default_value_t = Viewpoint::ThreeQuarter)]
    pub view: Viewpoint,
    /// Pictures on a walk along the longest path, or through the garden, this many; a picture file gets a number before its ending.
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=3600),
        conflicts_with = "view"
    )]
    pub walk: Option<u32>,
    /// Width and height of pictures in pixels.
    #[arg(long, value_name = "WxH", default_value = "1600x900")]
    pub size: Size,
    /// In pictures a lawn under the sky, instead of paper; walks always have it.
    #[arg(long)]
    pub outdoors: bool,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub assignments: Assignments,
    /// Print times, counts and bytes written as one JSON object.
    #[arg(long)]
    pub stats: bool,
}

impl Args {
    /// How pictures are taken.
    fn options(&self) -> PictureOptions {
        let background = studio::background(false, self.outdoors || self.walk.is_some());
        PictureOptions { width: self.size.width, height: self.size.height, background }
    }

    /// Whether nothing is written but pictures and lists.
    fn takes_pictures_alone(&self) -> bool {
        let is_model = |out: &PathBuf| {
            !is_picture(out) && write::format_of(out).is_ok_and(|format| format.takes() != Takes::Plant)
        };
        !self.out.iter().any(is_model)
    }

    /// All files that will be written.
    fn files(&self) -> Vec<PathBuf> {
        let of = |out: &PathBuf| match self.walk.filter(|_| is_picture(out)) {
            Some(count) => walk::pictures(out, count),
            None => vec![out.clone()],
        };
        self.out.iter().flat_map(of).collect()
    }
}

/// How fine individuals are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Detail {
    /// As fine as each is by itself.
    Full,
    /// As coarse as each can be with all its flowers, trees with about 2000 triangles; many small flowers as cards.
    Reduced,
    /// With cards of leaves, flowers and thin twigs, and as many triangles as the number of plants allows.
    Card,
    /// Each two crossing pictures of it, of 8 triangles.
    Billboards,
}

impl Detail {
    fn form(self) -> Form {
        match self {
            Self::Full | Self::Reduced => Form::Whole,
            Self::Card => Form::Cards,
            Self::Billboards => Form::Billboards,
        }
    }
}

/// Runs `garden`.
///
/// # Errors
/// A garden or a kind of plants that cannot be used, an output that cannot be written.
pub fn run(args: &Args) -> Result<ExitCode> {
    check_names(&args.out)?;
    ensure!(
        args.walk.is_none() || args.out.iter().any(|out| is_picture(out)),
        "--walk takes pictures; add a picture file, such as -o walk.png"
    );
    let (spec, folder) = spec(args)?;
    let mut sources = Sources::default();
    args.what.iter().for_each(|what| sources.add(Path::new(what)));
    spec.files(&folder).iter().for_each(|file| sources.add(file));
    sources.spare(args.files().iter().map(PathBuf::as_path))?;
    let mut clock = Clock::default();
    let tiles = clock.time("tiles", || TileSet::new(spec.colours, TILES));
    let mut plan = spec.plan(&tiles, &folder)?;
    warn(&spec, &tiles);
    let form = args.detail.map_or(Form::default(), Detail::form);
    let with = (&args.assignments.all()[..], form);
    let growers = spec.plants.iter().map(|kind| grower(kind, &folder, with, &mut sources));
    let mut growers = growers.collect::<Result<Vec<Grower>>>()?;
    for (number, grower) in growers.iter_mut().enumerate() {
        if let (Some(feet), Grower::Species { before, .. }) = (plan.before_wall_of(number), grower) {
            *before = Some(feet);
        }
    }
    for (kind, grower) in plan.kinds.iter_mut().zip(&growers) {
        kind.variants = grower.variants(kind.variants);
    }
    let individuals: usize = plan.kinds.iter().map(|kind| kind.variants as usize).sum();
    let most = GardenBudget::GARDEN.variants;
    ensure!(
        individuals <= most,
        "{individuals} individuals are more than the {most} of a garden; choose fewer variants"
    );
    sources.spare(args.files().iter().map(PathBuf::as_path))?;
    let places = clock.time("places", || match args.shard {
        None => plan.places(&tiles),
        Some(share) => plan.places_of(&tiles, share),
    })?;
    check_outputs(args, places.len())?;
    // Pictures have coarser forms for far plants, so near ones may be as fine as those of a garden of few.
    let of = if args.takes_pictures_alone() { 1.0 } else { plan.plants(&tiles)? };
    let usual = usual_triangles(args.detail, of, individuals);
    let stock = clock.time("individuals", || {
        growers.iter_mut().for_each(|grower| grower.fit(usual));
        let variants: Vec<u32> = plan.kinds.iter().map(|kind| kind.variants).collect();
        stock(&spec, &growers, (&variants, args.out.iter().any(|out| is_picture(out))))
    })?;
    let ground = clock.time("ground", || match args.shard {
        None => surface::slab(&plan, spec.ground.cover),
        Some(_) => None,
    });
    let walls = if args.shard.is_none() { std::mem::take(&mut plan.walls) } else { Vec::new() };
    let garden = Arc::new(Garden { stock, places, ground, walls });
    warn_of_missing(&garden, args.shard);
    warn_of_crowded(&garden);
    let bytes = clock.time("files", || write_all(args, &plan, &garden, &sources))?;
    if args.stats {
        common::print(&stats(&garden, &tiles, clock.take(), bytes).to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The garden that the arguments say, and the folder of the files that it names.
fn spec(args: &Args) -> Result<(GardenSpec, PathBuf)> {
    let is_toml =
        |what: &str| Path::new(what).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    let (mut spec, folder) = match &args.what[..] {
        [file] if is_toml(file) => {
            let folder = Path::new(file).parent().unwrap_or(Path::new(""));
            (GardenSpec::read(Path::new(file))?, folder.to_owned())
        }
        kinds => {
            let plants = kinds.iter().map(|kind| KindSpec::of(origin(kind))).collect();
            (GardenSpec { plants, ..GardenSpec::default() }, PathBuf::new())
        }
    };
    spec.area = args.area.clone().or(spec.area);
    spec.seed = args.seed.unwrap_or(spec.seed);
    spec.variants = args.variants.unwrap_or(spec.variants);
    for (option, given, own, most) in [
        ("--density", args.density, &mut spec.density, 1e12),
        ("--spacing", args.spacing, &mut spec.spacing, 1e4),
    ] {
        if let Some(given) = given {
            ensure!(given > 0.0 && given <= most, "{option} {given}: write a number above 0, to {most}");
            *own = given;
        }
    }
    Ok((spec, folder))
}

/// What a word of the command line names.
fn origin(word: &str) -> Origin {
    let ending = Path::new(word).extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("penstemon" | "json" | "svg") => Origin::Drawing(word.to_owned()),
        _ if ReadFormat::of(Path::new(word)).is_some() => Origin::Model(word.to_owned()),
        _ => Origin::Species(word.to_owned()),
    }
}

fn warn(spec: &GardenSpec, tiles: &TileSet) {
    if spec.colours == 1 {
        tracing::warn!(
            "with one colour all tiles are the same, so the garden repeats itself every {:.0} spacings; choose 3 colours",
            tiles.side()
        );
    }
    if let Some(sum) = spec.uneven_shares() {
        tracing::warn!(
            "the shares of the plants sum to {sum}, not to 1; they are weighed against each other"
        );
    }
}

/// How many triangles an individual has of which nothing is said, in a garden of about so many plants.
fn usual_triangles(detail: Option<Detail>, plants: f64, individuals: usize) -> u32 {
    match detail {
        Some(Detail::Full) => u32::MAX,
        Some(Detail::Reduced) => FEWEST_TRIANGLES,
        _ => triangles_of_each(plants.round() as usize, individuals),
    }
}

/// Says which kinds have no plant in the garden.
fn warn_of_missing(garden: &Garden, shard: Option<Share>) {
    match shard {
        Some(share) if garden.places.is_empty() => {
            tracing::warn!("share {} of {} has no plants", share.number(), share.of());
        }
        Some(_) => {}
        None => {
            let kinds = garden.stock.kinds.iter().zip(garden.plants_of_each_kind());
            for (kind, _) in kinds.filter(|(_, plants)| *plants == 0) {
                tracing::warn!(
                    "no plant of {} has found room; give it more ground, a larger share or a smaller spacing",
                    kind.name
                );
            }
        }
    }
}

/// Says which trees stand in each other.
fn warn_of_crowded(garden: &Garden) {
    for Crowded { kind, width, plants: [close, all] } in crowding::crowded(garden) {
        tracing::warn!(
            "{close} of {all} plants of {kind} stand in the crown of another: their crowns are {width:.1} m wide; choose a smaller \
             density or a larger spacing"
        );
    }
}

/// What makes a kind of plants; adds the files that it comes from.
fn grower(
    kind: &KindSpec,
    folder: &Path,
    (all, form): (&[String], Form),
    sources: &mut Sources,
) -> Result<Grower> {
    let KindSpec { origin, fields } = kind;
    let name = origin.name();
    let KindFields { triangles, age, seed, .. } = *fields;
    let triangles = (triangles > 0).then(|| format!("model.budget.triangles={triangles}"));
    let assignments: Vec<String> =
        fields.set.iter().cloned().chain(triangles).chain(all.iter().cloned()).collect();
    match origin {
        Origin::Species(_) => {
            let own = folder.join(name);
            let species =
                open_species(if name.ends_with(".toml") { own.to_str().unwrap_or(name) } else { name })?;
            if !species.makes_itself() {
                let known: BTreeSet<&str> =
                    Species::growing_or_roses().into_iter().chain(Species::blooming()).collect();
                let known = known.into_iter().collect::<Vec<_>>().join(", ");
                bail!(
                    "plants of the species `{}` are only drawn: plant a drawing of one; those that need none are {known}",
                    quote::name(name)
                );
            }
            if age.is_some() && species.growth.is_none() {
                bail!("{name}: only plants that grow have years; leave out `age`");
            }
            if let (Some(wall), None) = (&fields.wall, &species.growth) {
                bail!(
                    "{name}: only plants that grow know of walls; leave out `wall = \"{}\"`, or choose one that climbs, such as ivy or clematis",
                    quote::name(wall)
                );
            }
            species.picture_files().for_each(|picture| sources.add(picture));
            let params =
                pipeline::params_of_species(&species, &assignments).with_context(|| name.to_owned())?;
            let (species, params) = (Box::new(species), Box::new(params));
            Ok(Grower::Species { species, params, age, first_seed: u64::from(seed), form, before: None })
        }
        Origin::Drawing(_) => {
            let assignments = Assignments::of(assignments);
            let options = SetupOptions { species: None, seed: None, assignments, textures: Vec::new() };
            let setup = Setup::open(&folder.join(name), &options)?;
            setup.species.picture_files().for_each(|picture| sources.add(picture));
            let Setup { sketch, species, params, .. } = setup;
            let (sketch, species, params) = (sketch.into(), species.into(), params.into());
            Ok(Grower::Drawing { sketch, species, params, form })
        }
        Origin::Model(_) => Ok(Grower::Model(Box::new(model(&folder.join(name), sources)?))),
    }
}

/// A finished model with its pictures inside.
fn model(path: &Path, sources: &mut Sources) -> Result<Model> {
    let Loaded { mut model, embedded, files, warnings } = load(path)?;
    files.iter().for_each(|file| sources.add(file));
    warnings.iter().for_each(|warning| tracing::warn!("{}: {warning}", path.display()));
    for Material { texture, .. } in &mut model.materials {
        if let Some(bytes) = texture.as_ref().and_then(|texture| embedded.get(texture)) {
            let picture = Picture::new(bytes.to_vec()).with_context(|| path.display().to_string())?;
            *texture = Some(Texture::Own(picture));
        }
    }
    Ok(model)
}

/// Builds the individuals of all kinds.
fn stock(spec: &GardenSpec, growers: &[Grower], (variants, with_coarser): (&[u32], bool)) -> Result<Stock> {
    let mut stock = Stock::default();
    for ((kind, grower), variants) in spec.plants.iter().zip(growers).zip(variants) {
        let name = kind.origin.name();
        stock.add(name, grower.grow_all(*variants, with_coarser), kind.fields.height);
        let Some(made) = stock.kinds.last() else { continue };
        made.remarks.iter().for_each(|remark| tracing::warn!("{name}: {remark}"));
        ensure!(
            made.individuals.iter().all(|individual| individual.triangle_count() > 0),
            "{name}: an individual of it has no faces, so nothing would stand in its places; look at it by itself first"
        );
        let most = GardenBudget::GARDEN.variant_triangles;
        ensure!(
            stock.triangle_count() <= most,
            "{name}: the individuals have more than the {most} triangles that all of a garden may have; choose fewer variants, or fewer \
             --triangles"
        );
    }
    Ok(stock)
}

/// Refuses outputs that so many plants make too large, as far as that is known before any is built.
fn check_outputs(args: &Args, plants: usize) -> Result<()> {
    let most = GardenBudget::GARDEN.nodes;
    let has_glb =
        args.out.iter().any(|out| write::format_of(out).is_ok_and(|format| format.takes() == Takes::Copies));
    ensure!(
        plants <= most || !has_glb || args.instances == common::Instances::Gpu,
        "{plants} plants are more nodes than the {most} that a GLB file gets; write --instances gpu, or choose fewer plants"
    );
    Ok(())
}

/// Writes the garden to all files; returns the number of bytes.
fn write_all(args: &Args, plan: &Plan, garden: &Arc<Garden>, sources: &Sources) -> Result<usize> {
    args.out.iter().try_for_each(|out| {
        check_size(out, if is_picture(out) { garden.fewest_triangles() } else { garden.triangle_count() })
    })?;
    let mut whole: Option<Model> = None;
    let plant = FinishedPlant::new(Plant::default(), &[], |_| Material::plain("plant", [0.5; 3]));
    let provenance = Provenance::default();
    let plant = (&plant, &provenance);
    let mut bytes = 0;
    for out in &args.out {
        let is_list = write::format_of(out).is_ok_and(|format| format.takes() == Takes::Plant);
        if garden.places.is_empty() && !is_list {
            tracing::warn!("{} is not written: nothing would be in it", out.display());
            continue;
        }
        if is_picture(out) {
            let seen = Seen::with_garden(Cow::Owned(Model::default()), garden);
            bytes += match args.walk {
                Some(count) => write_walk(args, out, (plan, garden, seen), count)?,
                None => write_picture(args, out, seen)?,
            };
            continue;
        }
        bytes += match write::format_of(out)?.takes() {
            Takes::Plant => {
                let list = garden.list();
                atomic::write_atomically(out, &list)?;
                list.len()
            }
            Takes::Copies => write::export_instanced(
                out,
                (&garden.instanced(), args.instances.form()),
                plant,
                &common::built_in_texture,
                sources,
            )?,
            Takes::Triangles => {
                let model = whole.get_or_insert_with(|| garden.model());
                common::export(std::slice::from_ref(out), (plant, Surfaces::from(&*model)), None, sources)?
            }
        };
    }
    Ok(bytes)
}

/// Takes pictures on a walk through the garden; returns their size in bytes.
fn write_walk(
    args: &Args,
    out: &Path,
    (plan, garden, seen): (&Plan, &Garden, Seen<'_>),
    count: u32,
) -> Result<usize> {
    let paths = plan.paths.iter().map(|path| path.points().to_vec());
    let line = walk::longest(paths, seen.bounds().unwrap_or_default());
    let individuals = garden.stock.kinds.iter().flat_map(|kind| &kind.individuals);
    let highest = individuals.map(Individual::height).fold(0.0, f32::max);
    let mut renderer = Renderer::new()?;
    let mut scene = renderer.upload(seen, &studio::texture).with_context(|| out.display().to_string())?;
    Walk { line, ground: &|at| plan.ground.height(at), highest, count }.write(
        &mut renderer,
        &mut scene,
        out,
        &args.options(),
    )
}

/// Takes a picture of the garden; returns its size in bytes.
fn write_picture(args: &Args, out: &Path, seen: Seen<'_>) -> Result<usize> {
    let options = args.options();
    let png = studio::picture(seen, args.view.view(), &options).with_context(|| out.display().to_string())?;
    atomic::write_atomically(out, &png)?;
    Ok(png.len())
}

fn stats(garden: &Garden, tiles: &TileSet, stages: Stages, bytes: usize) -> Value {
    let ms = |time: std::time::Duration| (time.as_secs_f64() * 1e6).round() / 1e3;
    let kinds = garden.stock.kinds.iter().zip(garden.plants_of_each_kind());
    let kinds: Map<String, Value> = kinds.map(|(kind, plants)| (kind.name.clone(), plants.into())).collect();
    let heights = garden.places.iter().map(|Place { at, .. }| at.y);
    let (low, high) =
        heights.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    json!({
        "total_ms": ms(stages.iter().map(|stage| stage.1).sum()),
        "stages": stages.iter().map(|&(name, time)| (name.to_owned(), ms(time).into())).collect::<Map<_, Value>>(),
        "plants": garden.places.len(),
        "kinds": kinds,
        "individuals": garden.stock.individual_count(),
        "triangles_of_individuals": garden.stock.triangle_count(),
        "triangles": garden.triangle_count(),
        "ground": [low, high],
        "tiles": tiles.len(),
        "relaxed_to": tiles.relaxed_to(),
        "relative_radius": tiles.relative_radius(),
        "bytes": bytes,
    })
}

#[cfg(test)]
#[path = "garden_tests.rs"]
mod tests;
