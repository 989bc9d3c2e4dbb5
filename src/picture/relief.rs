//! A picture as a surface: its light places stand out, its dark ones are grooves.
//!
//! Bark is painted as it looks in even light, where a groove is dark because little light comes into it. So how light a place is says how
//! high it is: the height is the square root of its luminance (CIE Y of linear sRGB), which is about even to the eye, times the
//! `relief`. Slopes are taken with Sobel's filter, which smooths as much as it differentiates, so that the grain of a picture
//! does not become gravel; a large picture is first halved until no side has more than [`MOST_PIXELS`]. The picture repeats, as bark does: beyond an edge lies the opposite one. `shaders/surface.wgsl` finds
//! the same slopes for every pixel of the window.
//!
//! Limits: paint that is light or dark for itself, as lichen or a birch's marks, is taken for height too.

use super::decode::Rgba;
use crate::srgb::linear_from_srgb;
use glam::Vec3;

/// Pixels a side of a normal map, at most: what is finer is grain, and would be most of a plant's file.
const MOST_PIXELS: usize = 512;
/// Steps of slopes, of 255: about 2°, which nobody sees on bark, and a smaller file.
const STEP: f32 = 4.0;

/// The normal map of a picture whose light places are `relief` higher than its dark ones, in widths of the picture: x to the right, y to
/// the picture's top, z out of it, each from −1 to 1 as 0 to 255, as glTF has it. Opaque.
pub fn normal_map(picture: &Rgba, relief: f32) -> Rgba {
    let (mut heights, mut width) = (heights(picture), picture.width as usize);
    while width.max(heights.len() / width.max(1)) > MOST_PIXELS {
        (heights, width) = halved(&heights, width);
    }
    let height = heights.len() / width.max(1);
    let mut pixels = Vec::with_capacity(4 * heights.len());
    for y in 0..height {
        let rows =
            [(y + height - 1) % height, y, (y + 1) % height].map(|row| &heights[row * width..][..width]);
        for x in 0..width {
            let columns = [(x + width - 1) % width, x, (x + 1) % width];
            // Of so many pixels' height a pixel further to the right, and further down.
            let [across, down] = sobel(rows, columns);
            let slope = relief * width as f32;
            let normal = Vec3::new(-across * slope, down * slope, 1.0).normalize();
            // What is level is 128, as in other maps, and not one half less.
            let [r, g, b] =
                (normal * 127.0 / STEP).round().to_array().map(|step| (128.0 + STEP * step) as u8);
            pixels.extend([r, g, b, 255]);
        }
    }
    Rgba { width: width as u32, height: height as u32, pixels }
}

/// Half as many pixels a side, each the mean of four, and their width. A last odd row or column goes, unless it is the only one.
fn halved(heights: &[f32], width: usize) -> (Vec<f32>, usize) {
    let height = heights.len() / width;
    let (columns, rows) = ((width / 2).max(1), (height / 2).max(1));
    let at = |x: usize, y: usize| heights[y.min(height - 1) * width + x.min(width - 1)];
    let mean = |x: usize, y: usize| {
        0.25 * (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1))
    };
    ((0..rows).flat_map(|y| (0..columns).map(move |x| mean(x, y))).collect(), columns)
}

/// How high each pixel is, 0 to 1.
fn heights(picture: &Rgba) -> Vec<f32> {
    let light: [f32; 256] = std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0));
    let height = |&[r, g, b, _]: &[u8; 4]| {
        let [r, g, b] = [r, g, b].map(|byte| light[usize::from(byte)]);
        (0.2126 * r + 0.7152 * g + 0.0722 * b).sqrt()
    };
    picture.pixels.as_chunks::<4>().0.iter().map(height).collect()
}

/// How much higher it becomes from pixel to pixel, to the right and down.
fn sobel(rows: [&[f32]; 3], columns: [usize; 3]) -> [f32; 2] {
    let [[a, b, c], [d, _, e], [f, g, h]] = rows.map(|row| columns.map(|column| row[column]));
    [((c - a) + 2.0 * (e - d) + (h - f)) / 8.0, ((f - a) + 2.0 * (g - b) + (h - c)) / 8.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of 8 × 8 pixels, so light (0 to 255) at each.
    fn picture(light: impl Fn(u32, u32) -> u8) -> Rgba {
        let pixel = |i: u32| [[light(i % 8, i / 8); 3].as_slice(), &[255]].concat();
        Rgba { width: 8, height: 8, pixels: (0..64).flat_map(pixel).collect() }
    }

    fn normal_at(map: &Rgba, x: usize, y: usize) -> Vec3 {
        let pixel = &map.pixels[4 * (8 * y + x)..][..3];
        Vec3::new(f32::from(pixel[0]), f32::from(pixel[1]), f32::from(pixel[2])) / 127.5 - 1.0
    }

    #[test]
    fn an_even_picture_is_flat() {
        let map = normal_map(&picture(|_, _| 90), 0.1);
        assert!(map.pixels.as_chunks::<4>().0.iter().all(|pixel| *pixel == [128, 128, 255, 255]));
    }

    #[test]
    fn the_sides_of_a_dark_groove_lean_into_it() {
        let map = normal_map(&picture(|x, _| if x == 4 { 20 } else { 200 }), 0.1);
        assert!(normal_at(&map, 3, 2).x > 0.2 && normal_at(&map, 5, 2).x < -0.2);
        assert!(normal_at(&map, 1, 2).x.abs() < 0.01 && normal_at(&map, 3, 2).y.abs() < 0.01);
        let map = normal_map(&picture(|_, y| if y == 4 { 20 } else { 200 }), 0.1);
        // The row above the groove leans down, where y is less.
        assert!(normal_at(&map, 2, 3).y < -0.2 && normal_at(&map, 2, 5).y > 0.2);
    }

    #[test]
    fn a_large_picture_has_a_smaller_map_of_the_same_slopes() {
        // Four stripes, whatever the size.
        let striped = |size: u32| {
            let light = |i: u32| if i % size % (size / 4) < size / 8 { 20 } else { 200 };
            let pixel = |i: u32| [[light(i); 3].as_slice(), &[255]].concat();
            Rgba { width: size, height: size, pixels: (0..size * size).flat_map(pixel).collect() }
        };
        let [small, large] = [512, 1024].map(|size| normal_map(&striped(size), 0.05));
        assert_eq!([small.width, small.height, large.width, large.height], [512; 4]);
        assert!(small == large);
        let odd = normal_map(&Rgba { width: 1025, height: 1, pixels: vec![90; 4 * 1025] }, 0.1);
        assert_eq!([odd.width, odd.height, odd.pixels.len() as u32], [512, 1, 4 * 512]);
    }

    #[test]
    fn a_picture_goes_on_beyond_its_edges() {
        let map = normal_map(&picture(|x, _| if x == 0 { 20 } else { 200 }), 0.1);
        assert!(normal_at(&map, 7, 3).x > 0.2);
    }
}
