//! Gardens from their text to files: the same bytes on any number of threads, sizes of files, and what comes back.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use penstemon::budget::GardenBudget;
use penstemon::formats::write::{self, InstanceForm, Scene, Surfaces, format_of};
use penstemon::garden::{Garden, GardenSpec, Stock, TileSet, surface};
use penstemon::input::Sources;
use penstemon::pipeline::{self, Built, Form, Grower};
use penstemon::plant::{FinishedPlant, Material, Plant, Provenance};
use penstemon::sketch::{self, GardenPlant, GardenTool, Sketch};
use penstemon::species::Species;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::Path;

const BED: &str = "area = [[-3, -2], [3, -2], [3, 2], [0, 1], [-3, 2]]\nspacing = 0.35\nseed = 5\nvariants = 3\n\
                   [[plants]]\nspecies = \"rose\"\nshare = 0.6\nspacing = 0.6\n[[plants]]\nspecies = \"daisy\"\nshare = 0.4\n\
                   [[paths]]\npoints = [[-3, 0], [3, 0.5]]\nwidth = 0.5\n[ground]\ncover = \"lawn\"\n";

fn garden(text: &str, triangles: u32) -> Garden {
    garden_of(text, triangles, Form::Whole)
}

fn garden_of(text: &str, triangles: u32, form: Form) -> Garden {
    let spec = GardenSpec::from_toml(text, "bed.toml").unwrap();
    let tiles = TileSet::new(spec.colours, 1);
    let plan = spec.plan(&tiles, Path::new("")).unwrap();
    let mut stock = Stock::default();
    for (number, (kind, of_plan)) in spec.plants.iter().zip(&plan.kinds).enumerate() {
        let species = Box::new(Species::built_in(kind.origin.name()).unwrap());
        let params = Box::new(pipeline::params_of_species(&species, &[]).unwrap());
        let (age, before) = (kind.fields.age, plan.before_wall_of(number));
        let mut grower = Grower::Species { species, params, age, first_seed: 1, form, before };
        grower.fit(triangles);
        stock.add(kind.origin.name(), grower.grow_all(of_plan.variants, false), 0.0);
    }
    let places = plan.places(&tiles).unwrap();
    Garden { stock, places, ground: surface::slab(&plan, spec.ground.cover), walls: plan.walls }
}

fn glb(garden: &Garden, form: InstanceForm) -> Vec<u8> {
    let plant = FinishedPlant::new(Plant::default(), &[], |_| Material::plain("plant", [0.5; 3]));
    let (provenance, instanced) = (Provenance::default(), garden.instanced());
    let built_in = |name: &str| penstemon::species::builtin_texture(name).map(Cow::Borrowed);
    let scene = Scene::new(&instanced.model, (&plant, &provenance), &built_in, Cow::Borrowed("bed")).unwrap();
    let scene = scene.with_instances(&instanced.groups, form).unwrap();
    format_of(Path::new("bed.glb")).unwrap().encode(&scene).unwrap().bytes
}

const IVY: &str = "area = \"8x4\"\nspacing = 1.5\n[[walls]]\nname = \"north\"\nline = [[-3, -1], [3, -1]]\nheight = 1.2\n\
                   [[plants]]\nspecies = \"ivy\"\nwall = \"north\"\nage = 6\n[[plants]]\nspecies = \"tulip\"\nspacing = 0.3\n";

#[test]
fn what_climbs_has_grown_before_its_wall_and_nothing_stands_in_it() {
    let garden = garden(IVY, 20_000);
    let [ivy, tulips] = [0, 1].map(|kind| garden.places.iter().filter(move |place| place.kind == kind));
    let ivy: Vec<_> = ivy.collect();
    assert_eq!(ivy.iter().map(|place| place.variant).collect::<BTreeSet<u32>>().len(), 8);
    for place in ivy {
        let individual = &garden.stock.kinds[0].individuals[place.variant as usize];
        let points = individual.surfaces.iter().flat_map(|surface| &surface.mesh.points);
        let (mut highest, mut inside, mut all, mut far) = (0.0_f32, 0, 0, 0);
        for point in points.map(|point| place.at + place.rotation * *point * place.scale) {
            let from_middle = (point.z + 1.0).abs();
            highest = highest.max(point.y);
            all += 1;
            inside += usize::from(from_middle < 0.1 && point.y < 1.1 && point.x.abs() < 2.9);
            far += usize::from(from_middle > 0.6);
        }
        assert!(highest > 0.4, "it climbs: {highest}");
        assert!(
            inside * 50 < all && far * 20 < all,
            "{inside} within the wall, {far} away from it, of {all}"
        );
    }
    let mut count = 0;
    for place in tulips {
        assert!((place.at.z + 1.0).abs() >= 0.2 || place.at.x.abs() > 3.2, "{}", place.at);
        count += 1;
    }
    assert!(count > 100);
    let model = garden.model();
    assert_eq!(model.check_invariants(), Ok(()));
    assert_eq!(model.parts.iter().filter(|part| part.name.starts_with("wall")).count(), 1);
}

#[test]
fn the_same_garden_has_the_same_bytes_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let garden = garden(BED, 1500);
            [glb(&garden, InstanceForm::Nodes), glb(&garden, InstanceForm::Gpu), garden.list()]
        })
    };
    let one = on(1);
    assert!(one == on(2), "other bytes on two threads");
    assert!(one[1].len() < one[0].len(), "a table is smaller than nodes");
}

#[test]
fn what_is_written_comes_back_with_every_plant() {
    let garden = garden(BED, 1500);
    assert!(garden.places.len() > 20 && garden.plants_of_each_kind().iter().all(|count| *count > 2));
    for form in [InstanceForm::Nodes, InstanceForm::Gpu] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bed.glb");
        std::fs::write(&path, glb(&garden, form)).unwrap();
        let back = penstemon::formats::read::load(&path).unwrap();
        assert_eq!(back.model.triangle_count(), garden.triangle_count(), "{form:?}");
        let (found, made) = (back.model.bounds().unwrap(), garden.model().bounds().unwrap());
        assert!(found.0.distance(made.0) < 1e-3 && found.1.distance(made.1) < 1e-3, "{found:?} {made:?}");
    }
}

#[test]
fn a_file_of_ten_thousand_roses_has_at_most_forty_megabytes() {
    let text = "area = \"60x40\"\ndensity = 4.3\n[[plants]]\nspecies = \"rose\"\n";
    let garden = garden(text, pipeline::triangles_of_each(10_000, 16));
    assert!((10_000..11_000).contains(&garden.places.len()), "{}", garden.places.len());
    assert_eq!(garden.stock.individual_count(), 16);
    assert!(garden.stock.triangle_count() < GardenBudget::GARDEN.variant_triangles);
    let bytes = glb(&garden, InstanceForm::Nodes).len();
    assert!(bytes <= 40_000_000, "{bytes}");
}

#[test]
fn gardens_of_cards_and_of_pictures_have_few_triangles_and_come_back() {
    let text = "area = \"12x9\"\nspacing = 0.9\nvariants = 2\n[[plants]]\nspecies = \"rose\"\n";
    let whole = garden(text, 700);
    let of_each = |garden: &Garden| garden.triangle_count() / garden.places.len();
    for (form, most) in [(Form::Cards, 750), (Form::Billboards, 10)] {
        let garden = garden_of(text, 700, form);
        assert_eq!(garden.places.len(), whole.places.len(), "plants stand where they stood");
        assert!(of_each(&garden) <= most && of_each(&garden) < of_each(&whole), "{}", of_each(&garden));
        let heights = |garden: &Garden| garden.stock.kinds[0].individuals[0].height();
        assert!((heights(&garden) / heights(&whole) - 1.0).abs() < 0.15, "{form:?}");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bed.glb");
        std::fs::write(&path, glb(&garden, InstanceForm::Nodes)).unwrap();
        let back = penstemon::formats::read::load(&path).unwrap();
        assert_eq!(back.model.triangle_count(), garden.triangle_count(), "{form:?}");
        assert!(back.model.materials.iter().any(|material| material.cut_out), "{form:?}");
    }
}

/// The drawing whose garden is on the README's picture, with another garden where one is given.
fn painted(change: impl FnOnce(&mut Sketch)) -> (Sketch, Built) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/painted_garden.penstemon");
    let mut sketch = sketch::read(&path).unwrap().0;
    change(&mut sketch);
    let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
    let built = pipeline::build(&sketch, &species, &params);
    (sketch, built)
}

#[test]
fn a_painted_garden_has_what_was_painted_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| painted(|_| ()).1)
    };
    let built = on(1);
    let other = on(2);
    assert_eq!((&built.model, &built.garden), (&other.model, &other.garden));
    assert_eq!(built.remarks, []);
    let garden = built.garden.unwrap();
    let names: Vec<&str> = garden.stock.kinds.iter().map(|kind| kind.name.as_str()).collect();
    assert_eq!(names, ["drawn", "lavender", "peony", "marigold", "rose", "box"]);
    let counts = garden.plants_of_each_kind();
    assert!(counts.iter().all(|count| *count > 1) && counts[5] == 2, "two shrubs were tapped: {counts:?}");
    assert!(garden.triangle_count() <= GardenBudget::PAINTED_TRIANGLES + 100_000);
    // The box stands alone and is fine, lavender stands by the hundred.
    let of = |kind: usize| garden.stock.kinds[kind].individuals[0].triangle_count();
    assert!(of(5) > 10_000 && of(1) < 2000, "{} {}", of(5), of(1));
}

#[test]
fn a_painted_garden_leaves_with_its_plant() {
    let few = |sketch: &mut Sketch| {
        let bed = sketch
            .garden
            .iter()
            .filter(|stroke| stroke.tool != GardenTool::Plants(GardenPlant::species("lavender")));
        sketch.garden = bed.cloned().collect();
        sketch.params.insert("garden.triangles".into(), 4000.into());
    };
    let (_, built) = painted(few);
    let garden = built.garden.as_deref().unwrap();
    let all = built.model.triangle_count() + garden.triangle_count();
    let folder = tempfile::tempdir().unwrap();
    let [glb, obj] = ["a.glb", "a.obj"].map(|name| folder.path().join(name));
    let surfaces = Surfaces { garden: Some(garden), ..(&built.model).into() };
    let built_in = |name: &str| penstemon::species::builtin_texture(name).map(Cow::Borrowed);
    let plant = (&built.plant, &built.provenance);
    let paths = [glb.clone(), obj.clone()];
    write::export_all(&paths, surfaces, plant, &built_in, None, &Sources::default()).unwrap();
    for path in [&glb, &obj] {
        let back = penstemon::formats::read::load(path).unwrap();
        assert_eq!(back.model.triangle_count(), all, "{}", path.display());
        let (found, made) = (back.model.bounds().unwrap(), pipeline::seen(&built).bounds().unwrap());
        assert!(found.0.distance(made.0) < 1e-3 && found.1.distance(made.1) < 1e-3, "{found:?} {made:?}");
    }
    let size = |path: &Path| std::fs::metadata(path).unwrap().len();
    assert!(size(&glb) < size(&obj) / 3, "plants are copies: {} and {} bytes", size(&glb), size(&obj));
    let alone = [folder.path().join("b.glb")];
    write::export_all(&alone, &built.model, plant, &built_in, None, &Sources::default()).unwrap();
    assert!(size(&alone[0]) < size(&glb));
}
