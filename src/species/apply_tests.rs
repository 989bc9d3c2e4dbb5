//! Tests of applying species, on plants built by hand: shut and open flowers, seen from any side, or none at all.

use super::*;
use crate::picture::Picture;
use crate::plant::{Blade, Branch, Cone, Flower, FlowerBud, RestSurface, Template, TemplateId, Texture};
use crate::species::seat::Seat;
use glam::{Quat, Vec2, Vec3};
use proptest::prelude::*;
use std::f32::consts::TAU;
use std::path::Path;

/// Strokes that plants may have here.
const STROKES: u64 = 64;

/// What knows the strokes of these plants, and the origin of what each of them drew.
fn drawn() -> (Provenance, Vec<Origin>) {
    let mut provenance = Provenance::default();
    let origins = (0..STROKES).map(|stroke| provenance.record(Some(stroke))).collect();
    (provenance, origins)
}

fn provenance() -> Provenance {
    drawn().0
}

fn origin(stroke: Option<u64>) -> Origin {
    stroke.map_or(Origin::Generated, |stroke| drawn().1[stroke as usize])
}

/// A new template of a leaf of a length.
fn template(plant: &mut Plant, length: f32, detail: Detail) -> TemplateId {
    let outline = [Vec2::ZERO, Vec2::new(0.3, 0.5), Vec2::Y, Vec2::new(-0.3, 0.5)];
    let outline = outline.map(|point| point * length).to_vec();
    plant.templates.add(Template::new(outline, Vec::new(), length, detail))
}

fn leaf(template: TemplateId, base: Vec3, branch: Option<usize>, stroke: Option<u64>) -> Organ {
    let (rest, form) = (RestSurface::Plane, BladeForm::default());
    let blade = Blade { template, base, u: Vec3::X, v: Vec3::Y, rest, form };
    let (role, origin) = (Role::of(OrganPart::Leaf), origin(stroke));
    Organ { role, origin, branch, flower: None, shape: Shape::Blade(blade) }
}

/// Adds a flower of `petals` petals whose axis is `axis`.
fn add_flower(plant: &mut Plant, at: Vec3, axis: Vec3, opening_rad: f32, centre_radius: f32, petals: u32) {
    let index = plant.flowers.len();
    let reach = 0.04;
    let branch = (!plant.branches.is_empty()).then_some(0);
    let cone = Cone { apex: at, axis, opening_rad, height: reach * opening_rad.cos() };
    let origin = Origin::Generated;
    plant.flowers.push(Flower { origin, branch, cone, centre_radius, reach, look: index });
    let side = axis.any_orthonormal_vector();
    for k in 0..petals {
        let around = Quat::from_axis_angle(axis, TAU * k as f32 / petals as f32) * side;
        let direction = axis * opening_rad.cos() + around * opening_rad.sin();
        let v = Vec3::new(direction.x, direction.y, 0.0).normalize_or(Vec3::Y);
        let rest = RestSurface::Cone { cone, hint: (at + direction * reach).z, sight: Vec3::Z };
        let template = template(plant, 0.9 * reach, Detail::Full);
        let mut petal = leaf(template, at + direction * 0.1 * reach, branch, Some(u64::from(k)));
        petal.role = Role { look: index as u32, ..Role::of(OrganPart::Petal) };
        petal.flower = Some(index);
        if let Shape::Blade(blade) = &mut petal.shape {
            (blade.v, blade.u, blade.rest) = (v, v.cross(Vec3::Z), rest);
        }
        plant.organs.push(petal);
    }
}

fn bare(branches: usize, leaves: usize) -> Plant {
    let branch = |i: usize| Branch {
        origin: origin(Some(i as u64)),
        parent: i.checked_sub(1),
        level: i as u32,
        points: (0..6).map(|k| Vec3::new(0.03 * i as f32, 0.03 * (k + i) as f32, 0.01)).collect(),
        radii: vec![0.003; 6],
        role: Role::of(WoodPart::Stem),
    };
    let mut plant = Plant { branches: (0..branches).map(branch).collect(), ..Plant::default() };
    if leaves > 0 {
        let template = template(&mut plant, 0.02, Detail::Reduced);
        let on = (branches > 0).then_some(0);
        plant.organs = (0..leaves).map(|k| leaf(template, Vec3::Y * 0.01 * k as f32, on, None)).collect();
    }
    plant
}

/// A plant with one flower, half open and turned half to the viewer.
fn flowering() -> Plant {
    let mut plant = bare(2, 6);
    add_flower(&mut plant, Vec3::new(0.0, 0.15, 0.01), Vec3::new(0.2, 0.6, 0.8).normalize(), 1.1, 0.006, 5);
    plant
}

fn finished(plant: &Plant, species: &str, seed: u64) -> FinishedPlant {
    apply(plant.clone(), &FlowerBuds::default(), &provenance(), &Species::built_in(species).unwrap(), seed)
        .plant
}

prop_compose! {
    fn any_plant()(
        branches in 0_usize..4,
        leaves in 0_usize..20,
        flowers in prop::collection::vec(
            (prop::array::uniform3(-1.0..1.0_f32), 0.01..1.57_f32, 0.0..0.08_f32, 0_u32..22), 0..4),
        face_on in any::<bool>(),
    ) -> Plant {
        let mut plant = bare(branches, leaves);
        for (axis, opening, centre, petals) in flowers {
            let axis = if face_on { Vec3::Z } else { Vec3::from(axis).normalize_or(Vec3::Z) };
            add_flower(&mut plant, axis * 0.1, axis, opening, centre, petals);
        }
        plant
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn any_plant_stays_sound_in_any_species(plant in any_plant(), seed in any::<u64>()) {
        plant.check_invariants().unwrap();
        for name in Species::names() {
            let out = finished(&plant, name, seed);
            out.check_invariants().unwrap_or_else(|why| panic!("{name}: {why}"));
            prop_assert!(out == finished(&plant, name, seed), "{} differs from run to run", name);
        }
    }

    #[test]
    fn centres_stay_inside_the_petals(plant in any_plant(), seed in any::<u64>()) {
        for name in ["mallow", "daisy", "balloon_flower", "hepatica_red", "oxalis"] {
            for organ in &finished(&plant, name, seed).organs {
                let Some(Flower { cone, reach, .. }) = organ.flower.map(|f| &plant.flowers[f]) else { continue };
                let angle = |p: Vec3| (p - cone.apex).angle_between(cone.axis);
                match &organ.shape {
                    Shape::Filament { points, .. } => {
                        let tip = points[points.len() - 1];
                        prop_assert!(angle(tip) <= cone.opening_rad.max(0.06) + 0.02, "{name}: {}", angle(tip));
                    }
                    Shape::Dome { base, radius, .. } => {
                        let floor = (*base - cone.apex).dot(cone.axis);
                        prop_assert!(*radius <= floor * cone.opening_rad.clamp(0.05, 1.55).tan() * 1.01 + 1e-6);
                        prop_assert!(*radius <= 0.61 * reach);
                    }
                    _ => {}
                }
            }
        }
    }
}

#[test]
fn what_was_drawn_stays_where_it_was() {
    let plant = flowering();
    for name in Species::names() {
        let out = finished(&plant, name, 7);
        for (before, after) in plant.branches.iter().zip(&out.branches) {
            assert_eq!((&before.points, &before.radii), (&after.points, &after.radii), "{name}");
        }
        let drawn = |plant: &Plant| -> Vec<_> {
            let blades = plant.organs.iter().filter(|organ| organ.origin.is_drawn());
            blades.map(|organ| (organ.origin, organ.base())).collect()
        };
        assert_eq!(drawn(&plant), drawn(&out), "{name}");
    }
}

#[test]
fn the_seed_changes_forms_but_not_numbers() {
    let (a, b) = (finished(&flowering(), "daisy", 1), finished(&flowering(), "daisy", 2));
    assert_ne!(a.organs, b.organs);
    assert_eq!(a.organs.len(), b.organs.len());
}

#[test]
fn a_daisy_has_a_floret_disc_bracts_and_no_filaments() {
    let daisy = finished(&flowering(), "daisy", 1);
    let kinds = |kind| daisy.organs.iter().filter(|organ| organ.kind() == kind).collect::<Vec<_>>();
    assert_eq!(kinds(OrganKind::Sepal).len(), 13);
    assert!(kinds(OrganKind::Stamen).is_empty());
    let disc = kinds(OrganKind::Receptacle)[0];
    assert_eq!(
        daisy.materials()[daisy.material(disc.role)].texture,
        Some(Texture::BuiltIn("disc_daisy.png".into()))
    );
}

#[test]
fn sepals_stand_behind_the_petals_and_between_them() {
    let plant = flowering();
    let cone = plant.flowers[0].cone;
    let mallow = finished(&plant, "mallow", 1);
    let sepals: Vec<_> = mallow.organs.iter().filter(|organ| organ.kind() == OrganKind::Sepal).collect();
    assert_eq!(sepals.len(), 5);
    let side = cone.axis.any_orthonormal_vector();
    for organ in sepals {
        let Shape::Blade(blade) = &organ.shape else { panic!("a sepal is a blade") };
        assert!(blade.v.angle_between(cone.axis) > cone.opening_rad + 0.05);
        let nearest = (0..5).map(|k| {
            let petal = Quat::from_axis_angle(cone.axis, TAU * k as f32 / 5.0) * side;
            petal.angle_between(blade.v.reject_from_normalized(cone.axis))
        });
        assert!(nearest.fold(f32::MAX, f32::min) > 0.5, "a sepal hides behind a petal");
    }
}

#[test]
fn flowers_of_a_bouquet_take_the_looks_in_turn() {
    let mut plant = bare(1, 0);
    for k in 0..4 {
        add_flower(&mut plant, Vec3::X * 0.1 * k as f32, Vec3::Z, 1.2, 0.004, 6);
    }
    let bouquet = finished(&plant, "bouquet", 1);
    assert_eq!(bouquet.flowers.iter().map(|f| f.look).collect::<Vec<_>>(), [0, 1, 2, 0]);
    let petal =
        |flower| bouquet.organs.iter().find(|o| o.flower == Some(flower) && o.kind() == OrganKind::Petal);
    let names: Vec<_> =
        (0..4).map(|f| bouquet.materials()[bouquet.material(petal(f).unwrap().role)].name.as_str()).collect();
    assert_eq!(names, ["rose", "daisy", "hepatica", "rose"]);
}

#[test]
fn an_artists_picture_replaces_every_material_of_its_part_only() {
    let picture = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/reference/small.png"));
    let own = Texture::Own(Picture::read(picture).unwrap());
    let mut rose = Species::built_in("rose").unwrap();
    rose.set_texture("petal", picture).unwrap();
    let plant = apply(flowering(), &FlowerBuds::default(), &provenance(), &rose, 1).plant;
    plant.check_invariants().unwrap();
    for organ in &plant.organs {
        let pictured = plant.materials()[plant.material(organ.role)].texture.as_ref() == Some(&own);
        assert_eq!(pictured, organ.kind() == OrganKind::Petal, "{:?}", organ.kind());
    }
    assert_eq!(plant.materials().iter().filter(|m| m.name == "petal-picture").count(), 1);
}

#[test]
fn inner_petals_of_a_rose_are_more_cupped() {
    let rose = Species::built_in("rose").unwrap();
    let look = &rose.flowers[0].petals;
    let [outer, inner] = [1.0, 0.5].map(|length| petal_form(look, length, 1.0));
    assert_eq!((outer.cup, inner.cup), (look.form.cup, look.inner.unwrap().cup));
}

#[test]
fn a_cherry_tree_blossoms_in_place_of_generated_leaves_only() {
    let mut plant = bare(3, 400);
    let template = template(&mut plant, 0.02, Detail::Full);
    plant.organs.push(leaf(template, Vec3::Y, Some(0), Some(9)));
    let cherry = finished(&plant, "cherry", 5);
    let leaves = cherry.organs.iter().filter(|organ| organ.kind() == OrganKind::Leaf);
    assert!(leaves.clone().any(|leaf| leaf.origin == origin(Some(9))));
    assert_eq!(leaves.count() + cherry.flowers.len(), 401);
    assert!((140..240).contains(&cherry.flowers.len()), "{}", cherry.flowers.len());
    let petals = cherry.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal).count();
    assert_eq!(petals, 5 * cherry.flowers.len());
    let filaments = cherry.organs.iter().filter(|o| matches!(o.shape, Shape::Filament { .. })).count();
    // A plant has 1,500 of them at most, however many its flowers are.
    assert!(filaments > 1000 && filaments <= 1500, "{filaments}");
    cherry.check_invariants().unwrap();
}

#[test]
fn a_tree_of_more_flowers_than_a_plant_may_have_says_so() {
    let species = Species::built_in("cherry").unwrap();
    assert!(!apply(bare(1, 400), &FlowerBuds::default(), &provenance(), &species, 5).is_blossom_thinned);
    let most = crate::budget::Budget::PLANT.blossoms;
    let Applied { plant, is_blossom_thinned } =
        apply(bare(1, 3 * most), &FlowerBuds::default(), &provenance(), &species, 5);
    assert!(is_blossom_thinned);
    assert!((most * 9 / 10..=most * 11 / 10).contains(&plant.flowers.len()), "{}", plant.flowers.len());
}

#[test]
fn buds_that_were_left_out_count_as_flowers_that_do_not_open_where_buds_open() {
    let (u, v) = (Vec3::X * 0.02, Vec3::Y * 0.02);
    let bud =
        FlowerBud { origin: Origin::Generated, branch: Some(0), base: Vec3::Y, u, v, look: 0, open: 1.0 };
    for (name, opens) in [("cherry", true), ("maple", false)] {
        let species = Species::built_in(name).unwrap();
        for is_thinned in [false, true] {
            let buds = FlowerBuds { buds: vec![bud; 3], is_thinned };
            let applied = apply(bare(1, 4), &buds, &provenance(), &species, 5);
            assert_eq!(applied.is_blossom_thinned, is_thinned && opens, "{name}");
            assert_eq!(applied.plant.flowers.len() >= 3, opens, "{name}: {}", applied.plant.flowers.len());
        }
    }
}

#[test]
fn a_drawn_leaf_more_leaves_the_form_of_the_others() {
    let form_of = |plant: &Plant, stroke: u64| {
        let organ = plant.organs.iter().find(|organ| organ.origin == origin(Some(stroke))).unwrap();
        let Shape::Blade(blade) = &organ.shape else { panic!("a leaf is a blade") };
        (blade.form, organ.role)
    };
    for name in ["plant", "maple"] {
        let mut plant = bare(1, 0);
        let template = template(&mut plant, 0.02, Detail::Full);
        let drawn = |height: f32, stroke| leaf(template, Vec3::Y * height, Some(0), Some(stroke));
        plant.organs = [7, 9].map(|stroke| drawn(0.02, stroke)).to_vec();
        let before = finished(&plant, name, 1);
        plant.organs.insert(0, drawn(0.05, 3));
        let after = finished(&plant, name, 1);
        for stroke in [7, 9] {
            assert_eq!(form_of(&before, stroke), form_of(&after, stroke), "{name}: leaf {stroke}");
        }
        assert_ne!(form_of(&after, 7).0, form_of(&after, 9).0, "{name}");
    }
}

#[test]
fn the_pot_stands_below_the_lowest_trunk_and_holds_all_of_it() {
    let mut plant = bare(1, 0);
    plant.branches[0].radii = vec![0.05; 6];
    let potted = finished(&plant, "potted", 1);
    let pots: Vec<_> = potted.organs.iter().filter(|organ| organ.kind() == OrganKind::Pot).collect();
    assert_eq!(pots.len(), 2);
    let foot = plant.branches[0].points[0];
    let Shape::Lathe { base, profile, .. } = &pots[0].shape else { panic!("a pot is turned") };
    assert!((base.x, base.z) == (foot.x, foot.z) && base.y < foot.y);
    assert!(profile.iter().map(|p| p.x).fold(0.0, f32::max) > 0.05);
    let Shape::Dome { base, height, .. } = &pots[1].shape else { panic!("earth is a mound") };
    assert!((base.y..base.y + height).contains(&foot.y));
    assert!(finished(&bare(0, 3), "potted", 1).organs.iter().all(|organ| organ.kind() != OrganKind::Pot));
}

#[test]
fn a_drawn_pot_takes_the_place_of_the_species_own_and_is_of_clay_everywhere() {
    let mut plant = bare(1, 0);
    let profile = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)].map(Vec2::from).to_vec();
    let shape = Shape::Lathe { base: Vec3::ZERO, axis: Vec3::Y, profile };
    let role = Role::of(OrganPart::Pot);
    plant.organs.push(Organ { role, origin: Origin::Generated, branch: None, flower: None, shape });
    for name in ["potted", "plant", "maple"] {
        let plant = finished(&plant, name, 1);
        let pots: Vec<_> = plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Pot).collect();
        assert_eq!(pots.len(), 1, "{name}");
        let material = &plant.materials()[plant.material(pots[0].role)];
        let clay = Texture::BuiltIn("terracotta.png".to_owned());
        assert_eq!((material.name.as_str(), material.texture.as_ref()), ("pot", Some(&clay)), "{name}");
    }
}

#[test]
fn drawn_leaves_of_a_conifer_keep_their_outline_and_grown_ones_are_shoots() {
    let mut plant = bare(1, 0);
    let [drawn, grown] = [Detail::Full, Detail::Reduced].map(|detail| template(&mut plant, 0.2, detail));
    plant.organs = vec![leaf(drawn, Vec3::Y, Some(0), Some(1)), leaf(grown, Vec3::Y, Some(0), None)];
    for species in ["spruce", "linden", "oak"] {
        let plant = finished(&plant, species, 1);
        let cut_out = plant.organs.iter().map(|leaf| plant.materials()[plant.material(leaf.role)].cut_out);
        assert_eq!(cut_out.collect::<Vec<_>>(), [false, true], "{species}");
    }
    let ash = finished(&plant, "ash", 1);
    assert!(ash.materials().iter().all(|material| !material.cut_out));
}

#[test]
fn only_used_materials_are_kept_and_named_once() {
    let maple = finished(&bare(1, 0), "maple", 1);
    let mut names: Vec<_> = maple.materials().iter().map(|m| m.name.clone()).collect();
    names.sort_unstable();
    let all = names.len();
    names.dedup();
    assert_eq!(names.len(), all);
    assert!(!names.contains(&"twig".to_owned()), "{names:?}");
}

#[test]
fn young_branches_are_of_high_order_and_thin() {
    let mut plant = bare(3, 0);
    plant.branches[1].radii.fill(0.0005);
    plant.branches[2].radii.fill(0.002);
    let bark_of = |plant: &Plant, branch: usize| {
        let plant = finished(plant, "maple", 1);
        plant.materials()[plant.material(plant.branches[branch].role)].name.clone()
    };
    assert_eq!(bark_of(&plant, 1), bark_of(&plant, 0), "of the first order");
    assert_eq!(bark_of(&plant, 2), bark_of(&plant, 0), "thick");
    plant.branches[2].radii.fill(0.0005);
    assert_ne!(bark_of(&plant, 2), bark_of(&plant, 0));
}

#[test]
fn a_wide_drawn_centre_widens_the_disc() {
    let radius = |centre_radius| {
        let mut plant = bare(0, 0);
        add_flower(&mut plant, Vec3::ZERO, Vec3::Z, 1.3, centre_radius, 5);
        Seat::new(&plant.flowers[0], Vec3::X, 0.1, 0.5).radius
    };
    assert_eq!(radius(0.0), 0.1 * 0.04);
    assert!(radius(0.01) > 0.01);
    assert!(radius(f32::NAN) > 0.0);
    assert!(radius(1.0) <= 0.6 * 0.04);
}
