//! The picture in which a blade's own UV holds: painted texel by texel from the photograph, and its colour led on outward.
//!
//! Every texel asks the blade which point of its plane it shows (`BladeUv::point`) and the photograph what is there. Pixels
//! near the contour are mixed with the background, so they are not trusted: there and for some texels around the blade the
//! nearest trusted colour is taken, and beyond that the mean one, so that neither a smaller copy of the picture nor a margin
//! that the mesh leaves a little brings the background in.

use super::lab::{Lab, srgb_of};
use super::polygon;
use super::raster::Raster;
use crate::model::BladeUv;
use crate::picture::around;
use crate::picture::decode::Rgba;
use glam::{UVec2, Vec2};
use rayon::prelude::*;

crate::parameters! {
    /// The texture that is made of a photograph.
    pub struct TextureParams {
        /// Longest side of the texture; a smaller photograph gives a smaller one.
        side: u32 = 1024, 16..=4096, "texels";
        /// How far colour is led on around the petal or leaf; beyond that is its mean colour. Eight texels keep what is
        /// beside it out; blades of other outlines reach farther.
        padding: u32 = 4096, 0..=4096, "texels";
        /// How near to the margin colours are not trusted, in which background may be mixed.
        inset: f32 = 0.004, 0.0..=0.1, "of the size";
        /// The same for outlines that were traced by hand over a picture.
        traced_inset: f32 = 0.012, 0.0..=0.1, "of the size";
    }
}

/// Least side of a texture.
const LEAST: f32 = 4.0;

/// A photograph and how the blade lies on it.
pub(super) struct Source<'a> {
    /// Its colours.
    pub(super) lab: &'a Raster<Lab>,
    /// Which pixels show nothing but the blade.
    pub(super) trusted: &'a Raster<bool>,
    /// Pixels in a length of the blade's plane.
    pub(super) scale: f32,
}

/// Paints the picture of a blade; `outline` is its outline, `place` where a point of its plane lies on the photograph.
pub(super) fn paint(
    source: &Source<'_>,
    (uv, outline): (&BladeUv, &[Vec2]),
    place: impl Fn(Vec2) -> Vec2 + Sync,
    params: &TextureParams,
) -> Rgba {
    let whole = uv.extent() * source.scale;
    let shrink = (params.side as f32 / whole.max_element()).min(1.0);
    let size = (whole * shrink).round().clamp(Vec2::splat(LEAST), Vec2::splat(params.side as f32)).as_uvec2();
    // Where several pixels become one texel all of them are looked at.
    let looks = (1.0 / shrink).ceil().clamp(1.0, 4.0) as u32;
    let texel = |i: usize| sampled(source, size, i, looks, |at| place(uv.point(at)));
    let count = size.x as usize * size.y as usize;
    let seen: Vec<Option<Lab>> = (0..count).into_par_iter().with_min_len(1 << 10).map(texel).collect();
    let on_texture = |p: &Vec2| {
        let at = uv.uv(*p);
        Vec2::new(at.x, 1.0 - at.y) * size.as_vec2()
    };
    let inside = polygon::filled(&outline.iter().map(on_texture).collect::<Vec<_>>(), size);
    led_on(&Raster::new(size.x as usize, seen), &inside, params.padding)
}

/// The colour of one texel, where the photograph can be trusted.
fn sampled(
    source: &Source<'_>,
    size: UVec2,
    texel: usize,
    looks: u32,
    place: impl Fn(Vec2) -> Vec2,
) -> Option<Lab> {
    let corner = Vec2::new((texel % size.x as usize) as f32, (texel / size.x as usize) as f32);
    let photo = source.lab.size();
    let (mut sum, mut weight) = (Lab::ZERO, 0.0);
    for look in 0..looks * looks {
        let within = (Vec2::new((look % looks) as f32, (look / looks) as f32) + 0.5) / looks as f32;
        let at = (corner + within) / size.as_vec2();
        let place = place(Vec2::new(at.x, 1.0 - at.y));
        if place.cmplt(Vec2::ZERO).any() || place.cmpgt(photo.as_vec2()).any() {
            continue;
        }
        for (pixel, share) in around(photo, place) {
            if source.trusted.cells()[pixel] {
                sum += source.lab.cells()[pixel] * share;
                weight += share;
            }
        }
    }
    (weight >= 0.5 * (looks * looks) as f32).then(|| sum / weight)
}

/// The finished picture: what was not seen gets the nearest colour that was, or far from the blade the mean one.
fn led_on(seen: &Raster<Option<Lab>>, inside: &Raster<bool>, padding: u32) -> Rgba {
    let known: Vec<Lab> = seen.cells().iter().copied().flatten().collect();
    let sum =
        known.iter().fold([0.0f64; 3], |sum, colour| std::array::from_fn(|c| sum[c] + f64::from(colour[c])));
    let mean = Lab::from(sum.map(|c| (c / known.len().max(1) as f64) as f32));
    let nearest = nearest_of(&seen.map(Option::is_some));
    let to_blade = nearest_of(inside);
    let near = (padding as f32 + 0.5) * (padding as f32 + 0.5);
    let colour = |i: usize| {
        let is_near = |found: Option<usize>| {
            found.is_some_and(|k| seen.middle(k).distance_squared(seen.middle(i)) <= near)
        };
        let led = nearest.cells()[i].filter(|_| inside.cells()[i] || is_near(to_blade.cells()[i]));
        seen.cells()[i].or_else(|| led.and_then(|k| seen.cells()[k])).unwrap_or(mean)
    };
    let texel = |i: usize| {
        let [r, g, b] = srgb_of(colour(i));
        [r, g, b, 255]
    };
    let pixels = (0..seen.cells().len()).into_par_iter().with_min_len(1 << 12).flat_map_iter(texel).collect();
    Rgba { width: seen.width() as u32, height: seen.height() as u32, pixels }
}

/// For every pixel the nearest one that is set, itself if it is; `None` where none is. Two passes that hand the nearest on from
/// neighbour to neighbour (Danielsson 1980), which is off by a fraction of a pixel at most.
fn nearest_of(set: &Raster<bool>) -> Raster<Option<usize>> {
    let (width, height) = (set.width(), set.height());
    let mut nearest = Raster::new(
        width,
        set.cells().iter().enumerate().map(|(i, is_set)| is_set.then_some(i)).collect::<Vec<_>>(),
    );
    let take = |nearest: &mut Raster<Option<usize>>, (x, y): (usize, usize), (dx, dy): (isize, isize)| {
        let (Some(fx), Some(fy)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else { return };
        if fx >= width || fy >= height {
            return;
        }
        let (i, offered) = (y * width + x, nearest[(fx, fy)]);
        let away = |k: usize| set.middle(k).distance_squared(set.middle(i));
        if offered.is_some_and(|k| nearest.cells()[i].is_none_or(|known| away(k) < away(known))) {
            nearest.cells_mut()[i] = offered;
        }
    };
    for y in 0..height {
        for x in 0..width {
            for from in [(-1, 0), (0, -1), (-1, -1), (1, -1)] {
                take(&mut nearest, (x, y), from);
            }
        }
        (0..width).rev().for_each(|x| take(&mut nearest, (x, y), (1, 0)));
    }
    for y in (0..height).rev() {
        for x in (0..width).rev() {
            for from in [(1, 0), (0, 1), (1, 1), (-1, 1)] {
                take(&mut nearest, (x, y), from);
            }
        }
        (0..width).for_each(|x| take(&mut nearest, (x, y), (-1, 0)));
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn the_nearest_is_found_from_everywhere() {
        let mut set = Raster::filled(UVec2::new(37, 23), false);
        let places = [(3, 4), (30, 20), (18, 2)];
        places.iter().for_each(|place| set[*place] = true);
        let nearest = nearest_of(&set);
        for i in 0..set.cells().len() {
            let away = |k: usize| set.middle(k).distance(set.middle(i));
            let least = places.iter().map(|(x, y)| away(y * 37 + x)).fold(f32::MAX, f32::min);
            assert!(away(nearest.cells()[i].unwrap()) < least + 0.5);
        }
        assert!(nearest_of(&Raster::filled(UVec2::ONE, false)).cells()[0].is_none());
    }

    #[test]
    fn colour_goes_on_around_the_blade_and_the_mean_beyond() {
        let mut seen = Raster::filled(UVec2::new(60, 40), None);
        let mut inside = Raster::filled(UVec2::new(60, 40), false);
        for y in 0..40 {
            for x in 20..40 {
                inside[(x, y)] = true;
                if (22..38).contains(&x) {
                    seen[(x, y)] = Some(Vec3::new(if x < 30 { 30.0 } else { 70.0 }, 0.0, 0.0));
                }
            }
        }
        let picture = led_on(&seen, &inside, 8);
        let at = |x: usize| picture.pixels[4 * (20 * 60 + x)];
        let [dark, light] = [srgb_of(Vec3::new(30.0, 0.0, 0.0))[0], srgb_of(Vec3::new(70.0, 0.0, 0.0))[0]];
        let mean = srgb_of(Vec3::new(50.0, 0.0, 0.0))[0];
        assert_eq!([at(20), at(12), at(11), at(0)], [dark, dark, mean, mean]);
        assert_eq!([at(39), at(47), at(48)], [light, light, mean]);
    }
}
