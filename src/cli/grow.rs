//! `penstemon grow SPECIES -o OUT`: a plant that grows by itself, at one age or at many ages one after the other.

use super::lod::{self, Lod};
use super::studio::{Outputs, PictureArgs, Studio, check_names, open_species};
use super::{common, inside, lobes, obstacle, rose};
use crate::growth::{Envelope, Limits, Outcome, Simulation};
use crate::input::Sources;
use crate::pipeline::{self, Ages, Built, Cache, Params, Seed};
use crate::plant::{Branch, OrganKind};
use crate::sketch::Remark;
use crate::species::Species;
use anyhow::{Context, Result, ensure};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// Arguments of `grow`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// A species that grows, by name or by the path of its .toml file.
    #[arg(required_unless_present = "list")]
    pub species: Option<String>,
    /// Where the plant goes: .glb, .obj (with .mtl and textures), .json, or .png for a picture; may be given again.
    #[arg(short, long = "out", value_name = "FILE", required_unless_present = "list")]
    pub out: Vec<PathBuf>,
    /// A volume that the plant fills: a closed mesh in metres (SHAPE.obj), box:2x3x2 or ellipsoid:2x3x2 (width, height,
    /// depth) or sphere:1.5 (radius).
    #[arg(long, value_name = "SHAPE")]
    pub inside: Option<String>,
    /// Lobes that the plant fills: strokes in space (.json, see docs/lobes.md), with its trunks or without.
    #[arg(long, value_name = "FILE", conflicts_with = "inside")]
    pub lobes: Option<PathBuf>,
    /// What stands beside the plant: a mesh in metres, open or closed (WALL.obj), wall:4x2x0.2 (width, height, depth) or trellis:1.5x2
    /// (width, height); @0,0,-0.6 behind it says where. Wood grows around it, climbing species up it. May be given again.
    #[arg(long, value_name = "SHAPE")]
    pub obstacle: Vec<String>,
    /// Age in years, 12.5 for half a year more than 12. Left out, it is the species' own, or with --inside or --lobes when the
    /// volume is full.
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true)]
    pub age: Option<f32>,
    /// The plant at this many ages, evenly up to --age, each in a file with a number before the ending: an animation. With
    /// --over year, and for roses, at as many times of one year.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=3600))]
    pub frames: Option<u16>,
    /// What frames go through.
    #[arg(long, value_enum, default_value_t, requires = "frames")]
    pub over: Over,
    /// Leaves and petals in GLB as copies of a few meshes instead of one large mesh; `nodes` for every program, `gpu` for
    /// those that read EXT_mesh_gpu_instancing.
    #[arg(long, value_name = "FORM")]
    pub instances: Option<common::Instances>,
    /// Levels of detail: hero, game, mobile, or numbers of triangles such as 80000,25000,5000,billboards. GLB holds all of them
    /// (MSFT_lod), of OBJ each has a file.
    #[arg(long, value_name = "LEVELS", conflicts_with = "frames")]
    pub lod: Option<Lod>,
    /// With --lod: capsules around trunk and thick branches beside the finest level, as meshes called UCP_wood_LOD0_01 and so on,
    /// with which games find out what runs into the plant.
    #[arg(long, requires = "lod")]
    pub capsules: bool,
    /// Seed of everything random.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Most internodes of the plant; its years may take as many times more work as it may have more internodes than usual.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=5_000_000))]
    pub max_internodes: Option<u64>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub pictures: PictureArgs,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub assignments: common::Assignments,
    /// Print times, counts and bytes written as one JSON object.
    #[arg(long)]
    pub stats: bool,
    /// Print the names of the built-in species that grow, one a line.
    #[arg(long)]
    pub list: bool,
}

/// What the frames of an animation go through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Over {
    /// The years up to --age.
    #[default]
    Age,
    /// The seasons of one year, from breaking buds to winter, or up to --season where that is
    /// given.
    Year,
}

impl Args {
    fn outputs<'a>(&'a self, sources: &'a Sources) -> Outputs<'a> {
        Outputs { outs: &self.out, instances: self.instances, sources, pictures: self.pictures }
    }

    /// Whether the plant fills a volume.
    fn fills(&self) -> bool {
        self.inside.is_some() || self.lobes.is_some()
    }

    /// The volume that it fills, and the wood that it begins with there.
    fn volume(&self) -> Result<(Option<Arc<Envelope>>, Vec<Branch>)> {
        if let Some(file) = &self.lobes {
            let (volume, wood) = lobes::volume(file)?;
            return Ok((Some(Arc::new(volume)), wood));
        }
        Ok((self.inside.as_deref().map(inside::volume).transpose()?.map(Arc::new), Vec::new()))
    }
}

/// Runs `grow`.
///
/// # Errors
/// A species that cannot be used or does not grow, an output that cannot be written.
pub fn run(args: &Args) -> Result<ExitCode> {
    if args.list {
        common::print(&Species::growing_or_roses().join("\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    check_names(&args.out)?;
    let name = args.species.as_deref().context("which species?")?;
    let species = open_species(name)?;
    let sources = sources_of(args, &species);
    sources.spare(args.out.iter().map(PathBuf::as_path))?;
    if let Some(age) = args.age {
        ensure!((0.0..=10_000.0).contains(&age), "--age {age}: write the years, from 0 to 10000");
    }
    let params =
        pipeline::params_of_species(&species, &args.assignments.all()).with_context(|| name.to_owned())?;
    if params.rose.is_some() {
        check_rose(name, args)?;
        let outputs = args.outputs(&sources);
        let bed =
            rose::Bed { name, species: &species, assignments: &args.assignments.all(), seed: args.seed };
        return rose::run(&bed, &outputs, args.frames, args.stats);
    }
    let usual = species.growth.as_ref().map_or(params.habit.fineness, |habit| habit.fineness);
    if !args.fills() && params.habit.fineness != usual {
        tracing::warn!(
            "{name}: habit.fineness changes only plants that fill a volume; name one with --inside or --lobes"
        );
    }
    let limits = match args.max_internodes {
        Some(most) => Limits::of_internodes(usize::try_from(most)?),
        None => Limits::default(),
    };
    pipeline::check_grows(&species)?;
    let (volume, wood) = args.volume()?;
    let obstacles = obstacle::obstacles(&args.obstacle)?;
    let seed = Seed { number: args.seed, age: args.age, volume, obstacles, wood, limits };
    let mut nursery = Nursery { species: &species, params: params.clone(), seed, cache: Cache::default() };
    let (grown, ages) = nursery.grow(args.age)?;
    inside::check_room(nursery.simulation()?)?;
    warn_of_shortfalls(name, args, &grown, ages, nursery.simulation()?);
    ensure!(!grown.model.parts.is_empty(), "{name}: {}", why_bare(ages));
    let (bytes, levels) = match &args.lod {
        Some(lod) => {
            lod::export(&args.out, (&grown, &params), (lod, args.capsules), args.instances, &sources)?
        }
        None => (write(args, &sources, &grown, &mut nursery)?, Vec::new()),
    };
    if args.stats {
        let mut stats = common::stats(&grown.stages, &grown.model, bytes);
        if !levels.is_empty() {
            stats["levels"] = levels.into();
        }
        stats["internodes"] = nursery.simulation()?.tree().len().into();
        stats["branches"] = grown.plant.branches.len().into();
        let leaves = grown.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Leaf).count();
        stats["leaves"] = leaves.into();
        common::print(&stats.to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Refuses options that a rose does not know.
fn check_rose(name: &str, args: &Args) -> Result<()> {
    ensure!(
        args.age.is_none(),
        "{name}: a rose has seasons, not years; leave out --age, or write --season 3 for hips"
    );
    ensure!(
        args.lod.is_none(),
        "{name}: a rose has no levels of detail yet; leave out --lod, or ask for one level with --triangles"
    );
    ensure!(args.obstacle.is_empty(), "{name}: a rose does not grow around obstacles; leave out --obstacle");
    ensure!(!args.fills(), "{name}: a rose does not fill volumes; leave out --inside and --lobes");
    Ok(())
}

/// A seed with the plant that has grown from it so far.
struct Nursery<'a> {
    species: &'a Species,
    params: Params,
    seed: Seed,
    cache: Cache,
}

impl Nursery<'_> {
    /// The plant at an age, without one at its own.
    fn grow(&mut self, age: Option<f32>) -> Result<(Built, Ages)> {
        self.seed.age = age;
        let built = pipeline::build_with(&mut self.cache, &self.seed, self.species, &self.params, &|| false);
        let built = built.context("nothing stops it")?;
        let ages = built.growth.context("what comes from a seed has grown")?;
        Ok((built, ages))
    }

    fn simulation(&self) -> Result<&Simulation> {
        self.cache.seed.simulation().context("something has grown")
    }
}

/// Says on stderr what the plant lacks, and why.
fn warn_of_shortfalls(name: &str, args: &Args, grown: &Built, ages: Ages, simulation: &Simulation) {
    if ages.outcome != Outcome::Growing {
        tracing::warn!("{name}: {} at the age of {} years", ages.outcome, simulation.age());
    }
    let filled = inside::filled(simulation);
    if args.fills() && args.age.is_none() && filled < inside::FILLED {
        tracing::warn!(
            "{name}: fills only {:.0} % of the volume; choose a smaller one, without parts that hang together by less than \
             a shoot, or longer shoots, for instance --set habit.internode=0.5",
            filled * 100.0
        );
    }
    warn_of_obstacles(name, args, simulation);
    for warning in &grown.remarks {
        let remedy = match warning.remark {
            // Said above, with what to do.
            Remark::GrowthCapped { .. } | Remark::GrownTooLarge { .. } | Remark::GrowthTooCostly { .. } => {
                continue;
            }
            Remark::LeavesThinned { .. } => {
                "; choose fewer leaves, for instance --set habit.leaf.per_internode=1"
            }
            Remark::Coarser { .. } => "; choose a lower --age or coarser surfaces",
            _ => "",
        };
        tracing::warn!("{name}: {warning}{remedy}");
    }
}

/// Says on stderr where an obstacle is in the way of everything, and where what climbs has none.
fn warn_of_obstacles(name: &str, args: &Args, simulation: &Simulation) {
    let (habit, nodes) = (simulation.habit(), &simulation.tree().nodes);
    match (simulation.obstacles(), nodes.at.first()) {
        (Some(obstacles), Some(foot)) if obstacles.is_within(0.5 * habit.internode, *foot) => tracing::warn!(
            "{name}: an obstacle stands where the plant begins; move it, for instance with @0,0,-0.5 behind its size"
        ),
        (None, _) if habit.climb.is_some() && !args.fills() => tracing::warn!(
            "{name}: climbs; without --obstacle, for instance --obstacle wall:3x2x0.2@0,0,-0.3, it covers the ground"
        ),
        _ => {}
    }
}

/// Why nothing is to be seen of a plant, and what to do.
fn why_bare(ages: Ages) -> &'static str {
    match ages.outcome {
        Outcome::Finished => {
            "nothing grew, and no bud is left that ever could; leave out what --set changes of its habit, or choose other \
             values, for instance a higher habit.supply"
        }
        _ => "nothing has grown yet; choose a higher --age",
    }
}

/// Writes the plant, or its frames; returns the number of bytes.
fn write(args: &Args, sources: &Sources, grown: &Built, nursery: &mut Nursery<'_>) -> Result<usize> {
    let outputs = args.outputs(sources);
    // All pictures are framed for the plant that it becomes.
    let mut studio = Studio::new(&outputs, grown)?;
    let Some(frames) = args.frames else { return studio.write(grown, &Path::to_owned) };
    let oldest = args.age.unwrap_or(f32::from(nursery.simulation()?.age()));
    let last_season = common::last_season(nursery.species, &nursery.params);
    let mut bytes = 0;
    for frame in 1..=frames {
        let age = match args.over {
            Over::Age => oldest * f32::from(frame) / f32::from(frames),
            Over::Year => {
                nursery.params.season.time = last_season * f32::from(frame - 1) / f32::from(frames - 1);
                oldest
            }
        };
        let (built, _) = nursery.grow(Some(age))?;
        if built.model.parts.is_empty() {
            tracing::warn!("frame {frame}: nothing has grown yet, so it has no file");
        } else {
            bytes += studio.write(&built, &|out| common::numbered(out, usize::from(frame)))?;
        }
    }
    Ok(bytes)
}

/// The files that a plant is made from.
fn sources_of(args: &Args, species: &Species) -> Sources {
    let mut sources = Sources::default();
    // What is no file is none of them.
    [&args.species, &args.inside].into_iter().flatten().for_each(|file| sources.add(Path::new(file)));
    args.obstacle.iter().for_each(|file| sources.add(Path::new(file)));
    args.lobes.iter().for_each(|file| sources.add(file));
    species.picture_files().for_each(|picture| sources.add(picture));
    sources
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{Cli, Verb};
    use clap::Parser;

    fn parse(line: &str) -> Result<Args, clap::Error> {
        match Cli::try_parse_from(line.split_whitespace())?.verb {
            Some(Verb::Grow(args)) => Ok(args),
            other => panic!("{other:?}"),
        }
    }

    fn message(line: &str) -> String {
        crate::cli::one_line(&run(&parse(line).unwrap()).unwrap_err())
    }

    #[test]
    fn a_species_and_an_output_are_needed() {
        assert!(parse("penstemon grow oak").is_err() && parse("penstemon grow -o a.glb").is_err());
        let args = parse("penstemon grow oak --age 12.5 --seed 3 -o a.glb -o a.obj").unwrap();
        assert_eq!((args.age, args.seed, args.out.len()), (Some(12.5), 3, 2));
        assert!(parse("penstemon grow --list").unwrap().list);
    }

    #[test]
    fn frames_over_a_year_are_one_plant_in_its_seasons() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path().display();
        let line = format!("penstemon grow birch --age 5 --frames 3 --over year -o {here}/a.json");
        run(&parse(&line).unwrap()).unwrap();
        let once = |season: &str| {
            let out = format!("{here}/once.json");
            run(&parse(&format!("penstemon grow birch --age 5 --season {season} -o {out}")).unwrap())
                .unwrap();
            std::fs::read_to_string(out).unwrap()
        };
        for (frame, season) in ["0", "2.5", "5"].iter().enumerate() {
            let frame = std::fs::read_to_string(format!("{here}/a-{:03}.json", frame + 1)).unwrap();
            assert!(frame == once(season), "season {season}");
        }
        assert!(parse("penstemon grow birch --over year -o a.json").is_err(), "without frames");
    }

    #[test]
    fn frames_are_the_plant_at_rising_ages() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path().display();
        let line = format!(
            "penstemon grow hazel --age 3 --frames 3 -o {here}/a.json -o {here}/a.glb -o {here}/a.png"
        );
        run(&parse(&line).unwrap()).unwrap();
        let size = |frame: u32, ending: &str| {
            std::fs::metadata(folder.path().join(format!("a-{frame:03}.{ending}"))).unwrap().len()
        };
        assert!(size(1, "json") < size(2, "json") && size(2, "json") < size(3, "json"));
        assert!(size(1, "glb") < size(2, "glb") && size(2, "glb") < size(3, "glb"));
        let picture = |frame: u32| std::fs::read(folder.path().join(format!("a-{frame:03}.png"))).unwrap();
        assert!(picture(1) != picture(2) && picture(2) != picture(3));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 9);
    }

    #[test]
    fn pictures_are_taken_as_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("a.png");
        let mut taken = Vec::new();
        for view in ["front", "top"] {
            let line = format!(
                "penstemon grow hazel --age 3 --size 64x48 --transparent --view {view} -o {}",
                out.display()
            );
            run(&parse(&line).unwrap()).unwrap();
            let file = std::io::BufReader::new(std::fs::File::open(&out).unwrap());
            let mut reader = png::Decoder::new(file).read_info().unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut pixels).unwrap();
            assert_eq!((info.width, info.height, info.color_type), (64, 48, png::ColorType::Rgba));
            assert_eq!(pixels[3], 0, "the corner is clear");
            taken.push(pixels);
        }
        assert_ne!(taken[0], taken[1]);
    }

    #[test]
    fn obstacles_are_seen_in_pictures_but_are_not_in_files() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path().display();
        std::fs::write(folder.path().join("fence.obj"), "v -2 0 -0.4\nv 2 0 -0.4\nv 0 2 -0.4\nf 1 2 3\n")
            .unwrap();
        let grow = |obstacle: &str, name: &str| {
            let line = format!(
                "penstemon grow ivy --age 4 {obstacle} --size 64x48 -o {here}/{name}.png -o {here}/{name}.glb"
            );
            run(&parse(&line).unwrap()).unwrap();
            ["png", "glb"]
                .map(|ending| std::fs::read(folder.path().join(format!("{name}.{ending}"))).unwrap())
        };
        let [alone, _] = grow("", "alone");
        let [beside, model] = grow(&format!("--obstacle {here}/fence.obj"), "beside");
        assert_ne!(alone, beside);
        assert!(!model.windows(8).any(|bytes| bytes == b"obstacle"));
        let rose = format!("penstemon grow rose --obstacle wall:2x2x0.2 -o {here}/rose.glb");
        assert!(message(&rose).contains("leave out --obstacle"));
        let over = format!("penstemon grow ivy --obstacle {here}/fence.obj -o {here}/fence.obj");
        assert!(message(&over).contains("fence.obj"), "what it is made from stays");
    }

    #[test]
    fn faults_are_reported_before_anything_is_written() {
        assert!(message("penstemon grow oka -o a.glb").contains("did you mean `oak`?"));
        assert!(message("penstemon grow daisy -o a.glb").contains("[growth]"));
        assert!(message("penstemon grow oak -o a.xyz").contains("xyz"));
        assert!(message("penstemon grow oak --age nan -o a.glb").contains("--age"));
        assert!(message("penstemon grow oak --set modle.tube.sides=5 -o a.glb").contains("did you mean"));
    }

    #[test]
    fn habits_are_refused_as_other_parameters_are() {
        let set = |assignment: &str| message(&format!("penstemon grow oak --set {assignment} -o a.glb"));
        assert!(set("habit.lamda=0.7").contains("--set: there is no parameter `habit.lamda`"));
        assert!(set("habit.lamda=0.7").contains("did you mean `habit.lambda`?"));
        assert!(set("habit.lambda=1.5").contains("`habit.lambda` is 1.5, outside 0 to 1"));
        assert!(set("habit.shoot=2.5").contains("whole number"));
        assert!(set("habit.lambda=true").contains("needs a number"));
        assert!(set("habit.apical_first=1").contains("true or false"));
        assert!(set("habit.leaf=3").contains("there is no parameter `habit.leaf`"));
        assert!(
            set("habit.crown.width=3").contains("there is no parameter"),
            "an oak has no crown of its own"
        );
    }
}
