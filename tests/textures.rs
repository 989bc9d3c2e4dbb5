//! The shipped textures are what their painter paints.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

#[path = "../examples/paint_textures/bark.rs"]
mod bark;
#[path = "../examples/paint_textures/catalogue.rs"]
mod catalogue;
#[path = "../examples/paint_textures/color.rs"]
mod color;
#[path = "../examples/paint_textures/disc.rs"]
mod disc;
#[path = "../examples/paint_textures/flesh.rs"]
mod flesh;
#[path = "../examples/paint_textures/fruit.rs"]
mod fruit;
#[path = "../examples/paint_textures/indexed_image.rs"]
mod indexed_image;
#[path = "../examples/paint_textures/leaf.rs"]
mod leaf;
#[path = "../examples/paint_textures/leafy_shoot.rs"]
mod leafy_shoot;
#[path = "../examples/paint_textures/needles.rs"]
mod needles;
#[path = "../examples/paint_textures/noise.rs"]
mod noise;
#[path = "../examples/paint_textures/petal.rs"]
mod petal;
#[path = "../examples/paint_textures/petals.rs"]
mod petals;
#[path = "../examples/paint_textures/shoots.rs"]
mod shoots;
#[path = "../examples/paint_textures/tree_bark.rs"]
mod tree_bark;

use penstemon::species::{builtin_texture, builtin_textures::texture_names};

#[test]
fn every_shipped_texture_has_a_painter() {
    let mut painted: Vec<String> = catalogue::all().iter().map(|t| format!("{}.png", t.name)).collect();
    painted.sort_unstable();
    assert_eq!(painted, texture_names());
}

/// One of each family: painting all of them would take half a minute.
#[test]
fn painting_again_gives_the_same_bytes() {
    for name in ["petal_mallow", "leaf_oxalis", "bark_cherry", "disc_green", "shoot_spruce", "shoot_oak"] {
        let texture = catalogue::all().into_iter().find(|t| t.name == name).unwrap();
        let painted = texture.picture().to_png().unwrap();
        assert!(Some(&painted[..]) == builtin_texture(&format!("{name}.png")), "paint {name} again");
    }
}

/// Width, height and colours of a shipped texture without holes.
fn shipped(name: &str) -> (usize, usize, Vec<[u8; 3]>) {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(builtin_texture(name).unwrap()));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb, "{name}");
    (info.width as usize, info.height as usize, bytes.as_chunks::<3>().0.to_vec())
}

#[test]
fn bark_tiles_in_both_directions() {
    for name in
        ["bark_fissured", "bark_plated", "bark_birch", "bark_palm", "bark_bamboo", "stem_green", "terracotta"]
    {
        let (w, h, colors) = shipped(&format!("{name}.png"));
        let at = |x: usize, y: usize| colors[y * w + x];
        let step = |a: [u8; 3], b: [u8; 3]| (0..3).map(|k| a[k].abs_diff(b[k]) as usize).sum::<usize>();
        let across = |x: usize, next: usize| (0..h).map(|y| step(at(x, y), at(next, y))).sum::<usize>();
        let along = |y: usize, next: usize| (0..w).map(|x| step(at(x, y), at(x, next))).sum::<usize>();
        let roughest_across = (1..w).map(|x| across(x - 1, x)).max().unwrap();
        let roughest_along = (1..h).map(|y| along(y - 1, y)).max().unwrap();
        assert!(across(w - 1, 0) <= roughest_across, "{name} has a seam from left to right");
        assert!(along(h - 1, 0) <= roughest_along, "{name} has a seam from top to bottom");
    }
}
