//! Places of plants: distances, densities, determinism, what is refused.

use super::super::area::{Area, Path};
use super::super::grey_map::GreyMap;
use super::super::ground::Ground;
use super::super::plan::Variation;
use super::*;
use crate::picture::decode::Rgba;
use glam::Vec3;
use std::collections::BTreeSet;
use std::sync::LazyLock;

static TILES: LazyLock<TileSet> = LazyLock::new(|| TileSet::new(3, 1));

fn kind(share: f32, spacing: f32) -> Kind {
    Kind { share, spacing, variants: 16, map: None, bed: None, stands: Stands::Spread, wall: None }
}

fn plan(size: [f32; 2], kinds: Vec<Kind>) -> Plan {
    Plan {
        seed: 3,
        area: Area::rectangle(size.into()).unwrap(),
        density: None,
        map: None,
        ground: Ground::default(),
        walls: Vec::new(),
        paths: Vec::new(),
        beds: Vec::new(),
        kinds,
        variation: Variation::default(),
    }
}

fn grey(width: u32, greys: &[u8]) -> GreyMap {
    let pixels = greys.iter().flat_map(|&grey| [grey, grey, grey, 255]).collect();
    GreyMap::of(&Rgba { width, height: greys.len() as u32 / width, pixels }).unwrap()
}

/// The least distance between plants that keep these distances, as a share of the mean of theirs.
fn least_share(places: &[Place], plan: &Plan) -> f32 {
    let occupied = plan.occupied(places, plan.area.bounds());
    let mut least = f32::INFINITY;
    for (i, &(at, kept)) in occupied.plants.iter().enumerate() {
        for other in occupied.near(at, plan.widest()).filter(|other| *other as usize != i) {
            let (there, other_kept) = occupied.plants[other as usize];
            least = least.min(there.distance(at) / (0.5 * (kept + other_kept)));
        }
    }
    least
}

#[test]
fn a_million_plants_keep_their_distance_across_all_seams() {
    let tiles = &*TILES;
    let plan = plan([400.0, 400.0], vec![kind(1.0, 0.315)]);
    let places = plan.places(tiles).unwrap();
    assert!(places.len() > 1_000_000, "{}", places.len());
    let least = least_share(&places, &plan);
    assert!((1.0..1.01).contains(&least), "{least}");
    let density = places.len() as f32 / 160_000.0 * 0.315 * 0.315;
    assert!((density / tiles.density() - 1.0).abs() < 0.005, "{density}");
}

#[test]
fn a_garden_is_the_same_on_any_number_of_threads() {
    let tiles = &*TILES;
    let plan = plan([30.0, 20.0], vec![kind(0.6, 0.8), kind(0.4, 0.3)]);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| plan.places(&TILES).unwrap())
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, plan.places(tiles).unwrap());
    let other = Plan { seed: 4, ..plan };
    assert_ne!(one, other.places(tiles).unwrap());
}

#[test]
fn a_larger_area_leaves_the_plants_of_a_smaller_one_where_they_are() {
    let tiles = &*TILES;
    let of = |size| plan(size, vec![kind(0.5, 0.5), kind(0.5, 0.5)]).places(tiles).unwrap();
    let key = |place: &Place| [place.at.x.to_bits(), place.at.z.to_bits(), place.kind, place.variant];
    let larger: BTreeSet<_> = of([20.0, 30.0]).iter().map(key).collect();
    let smaller = of([10.0, 10.0]);
    assert!(smaller.len() > 200 && smaller.iter().all(|place| larger.contains(&key(place))));
}

#[test]
fn kinds_that_need_more_room_have_it_from_all_others() {
    let plan = plan([40.0, 40.0], vec![kind(0.5, 0.3), kind(0.2, 2.0), kind(0.3, 0.7)]);
    let places = plan.places(&TILES).unwrap();
    assert!(least_share(&places, &plan) >= 1.0);
    let count = |kind: u32| places.iter().filter(|place| place.kind == kind).count();
    assert!(count(1) > 30 && count(2) > 200 && count(0) > 1000, "{:?}", [count(0), count(1), count(2)]);
}

#[test]
fn shares_and_densities_are_kept() {
    let tiles = &*TILES;
    let mut plan = plan([60.0, 40.0], vec![kind(0.7, 0.3), kind(0.3, 0.3)]);
    plan.density = Some(4.0);
    let places = plan.places(tiles).unwrap();
    assert!((places.len() as f32 / (4.0 * 2400.0) - 1.0).abs() < 0.02, "{}", places.len());
    let first = places.iter().filter(|place| place.kind == 0).count() as f32 / places.len() as f32;
    assert!((first - 0.7).abs() < 0.015, "{first}");
    let variants: BTreeSet<u32> = places.iter().map(|place| place.variant).collect();
    assert_eq!(variants, (0..16).collect());
    plan.density = Some(8.0);
    let dense = plan.places(tiles).unwrap_err().to_string();
    assert!(dense.contains("room for 7.") && dense.contains("at most 0.28"), "{dense}");
}

#[test]
fn maps_thin_out_and_paths_stay_free() {
    let tiles = &*TILES;
    let mut plan = plan([60.0, 60.0], vec![kind(1.0, 0.3)]);
    plan.map = Some(grey(4, &[0, 85, 170, 255]));
    plan.paths = vec![Path::new(vec![Vec2::new(-30.0, 0.0), Vec2::new(30.0, 0.0)], 2.0).unwrap()];
    let places = plan.places(tiles).unwrap();
    assert!(places.iter().all(|place| place.at.z.abs() >= 1.0 + plan.variation.path_margin - 1e-4));
    let full = tiles.density() / 0.09;
    for (middle, wanted) in [(-15.0, 0.1667), (0.0, 0.5), (15.0, 0.8333)] {
        let near = places.iter().filter(|place| (place.at.x - middle).abs() < 3.0).count();
        let density = near as f32 / (6.0 * (60.0 - 2.2) * full);
        assert!((density - wanted).abs() < 0.03, "{middle}: {density}, wanted {wanted}");
    }
}

/// Each block of 3 r holds some six plants, so its count is a coarse number: what a block is off, in shares of the full density.
#[test]
fn blocks_of_a_density_map_are_off_by_little() {
    let tiles = &*TILES;
    let mut plan = plan([90.0, 90.0], vec![kind(1.0, 0.3)]);
    let rms = |plan: &Plan, wanted: f32, side: f32| {
        let blocks = (88.0 / side) as usize;
        let mut counts = vec![0.0f32; blocks * blocks];
        for place in plan.places(tiles).unwrap() {
            let [x, z] = [place.at.x, place.at.z].map(|along| ((along + 44.0) / side).floor());
            if (0.0..blocks as f32).contains(&x) && (0.0..blocks as f32).contains(&z) {
                counts[z as usize * blocks + x as usize] += 1.0;
            }
        }
        let full = tiles.density() / 0.09 * side * side;
        (counts.iter().map(|count| (count / full - wanted).powi(2)).sum::<f32>() / counts.len() as f32).sqrt()
    };
    for grey_level in [64u8, 128, 191, 255] {
        plan.map = Some(grey(1, &[grey_level]));
        let wanted = f32::from(grey_level) / 255.0;
        assert!(rms(&plan, wanted, 0.9) < 0.19, "{grey_level}: {}", rms(&plan, wanted, 0.9));
        assert!(rms(&plan, wanted, 1.8) < 0.10, "{grey_level}: {}", rms(&plan, wanted, 1.8));
    }
}

#[test]
fn plants_lean_and_follow_the_slope_as_they_may() {
    let tiles = &*TILES;
    let mut plan = plan([20.0, 20.0], vec![kind(1.0, 0.5)]);
    let up = |place: &Place| (place.rotation * Vec3::Y).angle_between(Vec3::Y).to_degrees();
    let places = plan.places(tiles).unwrap();
    let most = places.iter().map(up).fold(0.0, f32::max);
    assert!((3.8..=4.01).contains(&most), "{most}");
    assert!(places.iter().all(|place| (0.88..=1.12).contains(&place.scale)));
    // One up for one along, of which plants follow three tenths of the way.
    plan.ground = Ground::of_map(grey(2, &[0, 255]), [0.0, 10.0], plan.area.bounds());
    plan.variation.lean = 0.0;
    let places = plan.places(tiles).unwrap();
    let inner = || places.iter().filter(|place| place.at.x.abs() < 4.0);
    assert!(inner().all(|place| (place.at.y - (5.0 + place.at.x)).abs() < 1e-3));
    let expected =
        Vec3::Y.lerp(Vec3::new(-1.0, 1.0, 0.0).normalize(), 0.3).angle_between(Vec3::Y).to_degrees();
    assert!(inner().all(|place| (up(place) - expected).abs() < 0.1), "{expected}");
}

#[test]
fn a_spacing_larger_than_the_area_leaves_one_plant() {
    let places = plan([2.0, 2.0], vec![kind(1.0, 5000.0)]).places(&TILES).unwrap();
    assert_eq!(places.len(), 1);
    assert!(places[0].at.length() < 0.2, "{places:?}");
}

#[test]
fn what_cannot_be_is_refused_in_no_time() {
    let tiles = &*TILES;
    let refused = |plan: Plan| plan.places(tiles).unwrap_err().to_string();
    for spacing in [1e-6, 1e-3] {
        assert!(refused(plan([20.0, 20.0], vec![kind(1.0, spacing)])).contains("5000000"), "{spacing}");
    }
    let mut sparse = plan([9000.0, 9000.0], vec![kind(1.0, 0.1)]);
    sparse.density = Some(0.01);
    assert!(refused(sparse).contains("too wide for a spacing of 0.1 m"));
    let mut paved = plan([4.0, 4.0], vec![kind(1.0, 0.5)]);
    paved.paths = vec![Path::new(vec![Vec2::ZERO, Vec2::X], 50.0).unwrap()];
    assert!(refused(paved).contains("leave no ground"));
    let mut black = plan([4.0, 4.0], vec![kind(1.0, 0.5)]);
    black.map = Some(grey(1, &[0]));
    assert!(refused(black).contains("leave no ground"));
}

/// A rectangle between two corners.
fn bed(low: [f32; 2], high: [f32; 2]) -> Area {
    let corners = [[low[0], low[1]], [high[0], low[1]], high, [low[0], high[1]]];
    Area::polygon(corners.map(Vec2::from).to_vec()).unwrap()
}

/// A meadow with a bed of two kinds, rows in another, a hedge across a path, and two trees, one of them on the path.
fn parterre() -> Plan {
    let mut kinds =
        vec![kind(1.0, 0.3), kind(0.5, 0.2), kind(0.5, 0.6), kind(1.0, 0.25), kind(1.0, 0.5), kind(1.0, 3.0)];
    (kinds[1].bed, kinds[2].bed, kinds[3].bed) = (Some(0), Some(0), Some(1));
    kinds[3].stands = Stands::Rows { apart: 1.0, angle: 90.0 };
    kinds[4].stands = Stands::Along(vec![vec![Vec2::new(-9.0, 8.0), Vec2::new(9.0, 8.0)]]);
    kinds[5].stands = Stands::At(vec![Vec2::new(0.25, 0.0), Vec2::new(7.0, -7.0)]);
    let mut plan = plan([20.0, 20.0], kinds);
    plan.beds = vec![bed([-8.0, -8.0], [-2.0, -2.0]), bed([2.0, 2.0], [6.0, 7.0])];
    plan.paths = vec![Path::new(vec![Vec2::new(0.0, -10.0), Vec2::new(0.0, 10.0)], 1.0).unwrap()];
    plan
}

#[test]
fn beds_rows_lines_and_single_plants_keep_to_their_ground() {
    let plan = parterre();
    let places = plan.places(&TILES).unwrap();
    let of = |kind: u32| places.iter().filter(move |place| place.kind == kind).map(flat);
    assert!(of(0).all(|at| !plan.beds.iter().any(|bed| bed.contains(at))));
    assert!(of(1).chain(of(2)).all(|at| plan.beds[0].contains(at)));
    // Half of the bed's 36 square metres for each.
    for (kind, spacing) in [(1, 0.2f32), (2, 0.6)] {
        let share = of(kind).count() as f32 / (TILES.density() * 18.0 / (spacing * spacing));
        assert!((0.55..1.1).contains(&share), "{kind}: {share}");
    }
    // Four rows of twenty, along z.
    let columns: BTreeSet<i32> = of(3).map(|at| (at.x * 100.0).round() as i32).collect();
    assert_eq!((columns, of(3).count()), (BTreeSet::from([250, 350, 450, 550]), 80));
    // Of 37 in the hedge the three on the path and its margin are missing.
    assert_eq!((of(4).count(), of(4).all(|at| at.y == 8.0)), (34, true));
    assert_eq!(of(5).collect::<Vec<_>>().len(), 2, "one by one they stand even on a path");
    let spread: Vec<Place> = places.iter().filter(|place| place.kind < 3).copied().collect();
    assert!(least_share(&spread, &plan) >= 1.0);
    let near_tree = of(0).map(|at| at.distance(Vec2::new(7.0, -7.0))).fold(f32::INFINITY, f32::min);
    assert!((1.65..2.5).contains(&near_tree), "{near_tree}");
    let wanted = plan.plants(&TILES).unwrap() / places.len() as f64;
    assert!((1.0..1.4).contains(&wanted), "about as many as are expected: {wanted}");
    assert_eq!((rows::plants(&plan), rows::spots(&plan)), (80.0 + 37.0 + 2.0, 80.0 + 37.0 + 2.0));
}

#[test]
fn the_shares_of_a_garden_are_all_of_it_in_its_order() {
    let mut open = plan([31.0, 17.0], vec![kind(0.5, 0.3), kind(0.2, 2.0), kind(0.3, 0.7)]);
    open.ground = Ground::of_map(grey(2, &[0, 255]), [0.0, 3.0], open.area.bounds());
    let wide = plan([60.0, 60.0], vec![kind(1.0, 0.3)]);
    let tree = plan([8.0, 8.0], vec![kind(1.0, 30.0)]);
    for (plan, least) in [(open, 1000), (wide, 20_000), (parterre(), 1000), (tree, 1)] {
        let whole = plan.places(&TILES).unwrap();
        assert!(whole.len() >= least);
        for of in [1, 2, 5, 64] {
            let share = |number: u32| {
                let share = format!("{number}/{of}").parse().unwrap();
                plan.places_of(&TILES, share).unwrap()
            };
            let joined: Vec<Place> = (1..=of).flat_map(share).collect();
            assert!(joined == whole, "{of} shares: {} plants of {}", joined.len(), whole.len());
        }
    }
}

#[test]
fn a_bed_that_is_narrower_than_its_distance_has_one_plant() {
    let mut kinds = vec![kind(1.0, 0.5), kind(1.0, 40.0)];
    kinds[1].bed = Some(0);
    let mut plan = plan([10.0, 10.0], kinds);
    plan.beds = vec![bed([1.0, 1.0], [3.0, 3.0])];
    let places = plan.places(&TILES).unwrap();
    let trees: Vec<Vec2> = places.iter().filter(|place| place.kind == 1).map(flat).collect();
    assert!(trees.len() == 1 && plan.beds[0].contains(trees[0]), "{trees:?}");
}

#[test]
fn a_share_of_a_park_that_is_too_large_as_a_whole_is_laid_out_by_itself() {
    let plan = plan([9000.0, 9000.0], vec![kind(1.0, 0.7)]);
    assert!(matches!(plan.places(&TILES), Err(PlanError::TooMany { .. })));
    let share = plan.places_of(&TILES, "5000/9000".parse().unwrap()).unwrap();
    assert!((10_000..14_000).contains(&share.len()), "{}", share.len());
}
