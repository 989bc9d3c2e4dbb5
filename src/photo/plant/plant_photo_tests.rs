//! Tests of plants found on painted photographs, whose plants are known pixel by pixel.

use super::super::scene::{GREEN, RED, Scene};
use super::*;
use crate::geom::simple_loop::area;

const SIZE: UVec2 = UVec2::new(480, 520);
const MIDDLE: Vec2 = Vec2::new(240.0, 210.0);
const HALF: Vec2 = Vec2::new(130.0, 140.0);
const FOOT: Vec2 = Vec2::new(240.0, 470.0);

fn tree(seed: u64, meadow: bool, colour: glam::Vec3) -> Scene {
    let mut scene = Scene::new(SIZE, seed, meadow);
    scene.tree(FOOT, MIDDLE, HALF, None, colour);
    scene
}

fn find(photograph: &Rgba, marks: &Marks) -> Result<PlantPhoto, PhotoError> {
    PlantPhoto::of_photograph(photograph, marks, &PlantParams::default())
}

/// Keeps pictures where someone wants to look at them: in the folder named by `PENSTEMON_PICTURES`.
fn keep(name: &str, scene: &Scene, photograph: &Rgba, found: &PlantPhoto) {
    let Some(folder) = std::env::var_os("PENSTEMON_PICTURES") else { return };
    let folder = std::path::Path::new(&folder);
    std::fs::write(folder.join(format!("{name}-photo.png")), photograph.to_png().unwrap()).unwrap();
    let mut pixels = photograph.pixels.clone();
    for (i, pixel) in pixels.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        let (x, y) = (i as u32 % photograph.width, i as u32 / photograph.width);
        let is_in = found.contains(x, y);
        let is_rim = x > 0 && found.contains(x - 1, y) != is_in || y > 0 && found.contains(x, y - 1) != is_in;
        if is_rim {
            *pixel = [255, 0, 255, 255];
        } else if is_in != scene.truth.cells()[i] {
            pixel[0] = 255;
        }
    }
    let picture = Rgba { pixels, ..*photograph };
    std::fs::write(std::path::Path::new(&folder).join(format!("{name}.png")), picture.to_png().unwrap())
        .unwrap();
}

#[test]
fn trees_before_sky_and_ground_are_found_without_marks() {
    for (name, seed, meadow, colour, grain) in [
        ("field", 1, false, GREEN, 20.0),
        ("meadow", 2, true, GREEN, 20.0),
        ("autumn", 3, true, RED, 20.0),
        ("dark", 4, true, GREEN * 0.5, 40.0),
    ] {
        let mut scene = tree(seed, meadow, colour);
        let photograph = scene.photograph(grain);
        let found = find(&photograph, &Marks::default()).unwrap();
        keep(name, &scene, &photograph, &found);
        let agreement = scene.agreement(|x, y| found.contains(x, y));
        assert!(agreement >= 0.9, "{name}: {agreement}");
        assert!(found.remarks.is_empty(), "{name}: {:?}", found.remarks);
        let trunk = found.trunk.unwrap_or_else(|| panic!("{name}: no trunk"));
        assert!(trunk.points[0].distance(FOOT) < 20.0, "{name}: {}", trunk.points[0]);
        assert!(found.crown.iter().filter(|line| !line.is_hole).count() == 1, "{name}");
        let around = area(&found.crown[0].points) / (std::f32::consts::PI * HALF.x * HALF.y);
        assert!((0.9..1.15).contains(&around), "{name}: {around}");
    }
}

#[test]
fn lines_choose_between_two_plants_and_an_outline_leaves_one_out() {
    let mut scene = Scene::new(UVec2::new(700, 400), 5, true);
    scene.tree(Vec2::new(500.0, 370.0), Vec2::new(500.0, 170.0), Vec2::new(120.0, 110.0), None, GREEN);
    let right = scene.truth.map(|is_in| *is_in);
    scene.truth = right.map(|_| false);
    scene.tree(Vec2::new(190.0, 365.0), Vec2::new(190.0, 190.0), Vec2::new(95.0, 100.0), None, GREEN);
    let left = std::mem::replace(&mut scene.truth, right);
    let photograph = scene.photograph(20.0);
    let found = find(&photograph, &Marks::default()).unwrap();
    keep("two", &scene, &photograph, &found);
    assert_eq!(found.remarks, [PhotoRemark::SeveralPlants { count: 2 }]);
    assert!(scene.agreement(|x, y| found.contains(x, y)) > 0.9);
    scene.truth = left;
    let line = vec![Vec2::new(170.0, 170.0), Vec2::new(210.0, 200.0)];
    let marked = find(&photograph, &Marks { plant: vec![line], ..Marks::default() }).unwrap();
    let outline = [(60.0, 40.0), (330.0, 40.0), (330.0, 390.0), (60.0, 390.0)].map(Vec2::from).to_vec();
    let outlined = find(&photograph, &Marks { outline: Some(outline), ..Marks::default() }).unwrap();
    for (name, found) in [("two-marked", marked), ("two-outlined", outlined)] {
        keep(name, &scene, &photograph, &found);
        assert!(found.remarks.is_empty(), "{name}");
        let agreement = scene.agreement(|x, y| found.contains(x, y));
        assert!(agreement > 0.9, "{name}: {agreement}");
    }
}

#[test]
fn a_gap_in_the_crown_is_a_hole() {
    let mut scene = Scene::new(SIZE, 6, true);
    scene.tree(FOOT, MIDDLE, HALF, Some((Vec2::new(280.0, 190.0), 34.0)), GREEN);
    let photograph = scene.photograph(20.0);
    let found = find(&photograph, &Marks::default()).unwrap();
    keep("hole", &scene, &photograph, &found);
    let holes: Vec<&Loop> = found.crown.iter().filter(|line| line.is_hole).collect();
    assert_eq!(holes.len(), 1);
    let share = area(&holes[0].points) / (std::f32::consts::PI * 34.0 * 34.0);
    assert!((0.7..1.1).contains(&share), "{share}");
    assert!(scene.agreement(|x, y| found.contains(x, y)) > 0.9);
}

#[test]
fn a_plant_that_hardly_stands_out_is_found_with_marks() {
    // A green crown before a wood as green as itself.
    let mut scene = Scene::new(SIZE, 7, true);
    for i in 0..scene.light.cells().len() {
        let grain = 0.7 + 0.25 * ((i * 2_654_435_761) % 97) as f32 / 97.0;
        if scene.light.middle(i).y < 300.0 {
            scene.light.cells_mut()[i] = glam::Vec3::new(105.0, 150.0, 75.0) * grain;
        }
    }
    scene.tree(FOOT, MIDDLE, HALF, None, GREEN * 0.8);
    let photograph = scene.photograph(20.0);
    let outline: Vec<Vec2> = (0..40)
        .map(|k| {
            let angle = std::f32::consts::TAU * k as f32 / 40.0;
            Vec2::new(240.0, 275.0) + Vec2::new(165.0, 225.0) * Vec2::from_angle(angle)
        })
        .collect();
    let marks = Marks {
        outline: Some(outline),
        plant: vec![vec![Vec2::new(160.0, 200.0), Vec2::new(320.0, 200.0)], vec![FOOT, MIDDLE]],
        around: vec![vec![Vec2::new(100.0, 400.0), Vec2::new(190.0, 400.0)]],
    };
    let found = find(&photograph, &marks).unwrap();
    keep("wood", &scene, &photograph, &found);
    let agreement = scene.agreement(|x, y| found.contains(x, y));
    assert!(agreement > 0.85, "{agreement}");
}

#[test]
fn photographs_without_a_plant_are_refused_with_the_remedy() {
    let empty = Scene::new(SIZE, 8, true).photograph(20.0);
    let mut everywhere = Scene::new(SIZE, 9, true);
    everywhere.tree(FOOT, 0.5 * SIZE.as_vec2(), SIZE.as_vec2(), None, GREEN);
    let everywhere = everywhere.photograph(20.0);
    let grey = Rgba { width: 60, height: 60, pixels: vec![128; 14_400] };
    for (name, photograph) in [("empty", &empty), ("everywhere", &everywhere), ("grey", &grey)] {
        let error = find(photograph, &Marks::default()).map(|found| found.share).unwrap_err();
        let is_remedied = error.to_string().contains("draw a loose outline");
        assert!(is_remedied, "{name}: {error}");
    }
    let dot = Rgba { width: 1, height: 1, pixels: vec![255; 4] };
    assert!(find(&dot, &Marks::default()).unwrap_err().to_string().contains("1×1"));
    // A line on the plant that leaves nothing to its surroundings.
    let all = (0..520).step_by(2).map(|y| vec![Vec2::new(-9.0, y as f32), Vec2::new(500.0, y as f32)]);
    let marks = Marks { plant: all.collect(), ..Marks::default() };
    assert!(matches!(
        find(&everywhere, &marks),
        Err(PhotoError::AllPlant { .. } | PhotoError::NoPlant { .. })
    ));
}

#[test]
fn alpha_says_what_is_there_and_the_same_photograph_gives_the_same_plant() {
    let mut scene = tree(10, true, GREEN);
    let mut photograph = scene.photograph(20.0);
    let found = find(&photograph, &Marks::default()).unwrap();
    let again = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let again = again.install(|| find(&photograph, &Marks::default()).unwrap());
    assert_eq!((&found.crown, &found.trunk, found.colours), (&again.crown, &again.trunk, again.colours));
    for (pixel, is_in) in photograph.pixels.as_chunks_mut::<4>().0.iter_mut().zip(scene.truth.cells()) {
        pixel[3] = if *is_in { 255 } else { 0 };
    }
    let cut_out = find(&photograph, &Marks::default()).unwrap();
    assert!(scene.agreement(|x, y| cut_out.contains(x, y)) > 0.98);
}

#[test]
fn a_large_photograph_is_outlined_in_its_own_pixels() {
    let mut scene = Scene::new(UVec2::new(1300, 1400), 11, true);
    scene.tree(Vec2::new(650.0, 1300.0), Vec2::new(650.0, 560.0), Vec2::new(350.0, 380.0), None, GREEN);
    let photograph = scene.photograph(20.0);
    let found = find(&photograph, &Marks::default()).unwrap();
    assert!(scene.agreement(|x, y| found.contains(x, y)) > 0.9);
    let mask = found.mask_picture();
    assert_eq!((mask.width, mask.height), (1300, 1400));
    let trunk = found.trunk.as_ref().unwrap();
    assert!(trunk.points[0].distance(Vec2::new(650.0, 1300.0)) < 50.0, "{}", trunk.points[0]);
    let strokes = found.strokes(5, |place| place);
    assert!(strokes[0].id == 5 && strokes.len() == found.crown.len() + 1);
    assert_eq!(strokes[0].points.first(), strokes[0].points.last());
}

#[test]
fn any_picture_and_any_marks_end_in_a_plant_or_an_error() {
    let mut dice = super::super::scene::Dice(77);
    for round in 0..60 {
        let mut roll = |most: f32| dice.roll() * most;
        let (width, height) = (16 + roll(60.0) as u32, 16 + roll(60.0) as u32);
        let kind = round % 4;
        let pixels = (0..width * height).flat_map(|i| {
            let flat = [(i / width * 3) as u8, 120, 60];
            let [r, g, b] = if kind == 0 { flat } else { [0; 3].map(|_: u8| roll(256.0) as u8) };
            [r, g, b, if kind == 3 { roll(256.0) as u8 } else { 255 }]
        });
        let photograph = Rgba { width, height, pixels: pixels.collect() };
        let extremes = [f32::NAN, f32::INFINITY, -1e30, 0.0, 7.5, 33.0, 1e9];
        let mut line = |most: usize| -> Vec<Vec2> {
            let mut place = || extremes[(dice.roll() * 6.99) as usize];
            (0..most).map(|_| Vec2::new(place(), place())).collect()
        };
        let marks = Marks {
            outline: (round % 3 == 0).then(|| line(5)),
            plant: vec![line(round % 5), line(2)],
            around: vec![line(3)],
        };
        let params = PlantParams { side: 64, rounds: 2, hole: 0.0, ..PlantParams::default() };
        let picture = PlantPicture::new(&photograph, &params).unwrap();
        for marks in [marks, Marks::default()] {
            if let Ok(mut found) = picture.find(&marks, &params) {
                picture.give_trunk(&mut found, &line(3), &SnapParams::default());
                let places = found.crown.iter().flat_map(|line| &line.points);
                assert!(places.clone().all(|p| p.is_finite() && p.x <= width as f32 && p.y <= height as f32));
                assert!((1.0..=95.0).contains(&found.share));
            }
        }
    }
}
