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
        println!("{name}: {agreement:.3}");
        assert!(agreement >= 0.9, "{name}: {agreement}");
        assert!(found.remarks.is_empty(), "{name}: {:?}", found.remarks);
        let trunk = found.trunk.unwrap_or_else(|| panic!("{name}: no trunk"));
        assert!(trunk.points[0].distance(FOOT) < 20.0, "{name}: {}", trunk.points[0]);
        assert!(found.crown.iter().filter(|line| !line.is_hole).count() == 1, "{name}");
        let around = area(&found.crown[0].points) / (std::f32::consts::PI * HALF.x * HALF.y);
        assert!((0.9..1.15).contains(&around), "{name}: {around}");
    }
}
