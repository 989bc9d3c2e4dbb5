//! Which pixels a triangle covers, row by row.
//!
//! The share that each corner has in a point grows evenly along a row, so the pixels where no share is negative are found from the
//! row's first. A pixel is covered if its middle is.

use glam::{USizeVec2, Vec2, Vec3};

/// Calls with the index of each pixel of a picture of this width and height that a triangle covers, and with the shares of its corners
/// there. Corners are in pixels, x right, y down, and may lie outside.
pub(super) fn covered([a, b, c]: [Vec2; 3], size: USizeVec2, mut each: impl FnMut(usize, Vec3)) {
    let twice = (b - a).perp_dot(c - a);
    if twice == 0.0 || !twice.is_finite() {
        return;
    }
    let most = size.as_vec2();
    let low = a.min(b).min(c).clamp(Vec2::ZERO, most).floor().as_usizevec2();
    let high = a.max(b).max(c).clamp(Vec2::ZERO, most).ceil().as_usizevec2();
    let shares_at = |p: Vec2| {
        Vec3::new((b - p).perp_dot(c - p), (c - p).perp_dot(a - p), (a - p).perp_dot(b - p)) / twice
    };
    let step = Vec3::new(b.y - c.y, c.y - a.y, a.y - b.y) / twice;
    for y in low.y..high.y {
        let first = shares_at(Vec2::new(low.x as f32 + 0.5, y as f32 + 0.5));
        let (from, to) = positive(first, step, (high.x - low.x) as f32);
        // Rounding may add a pixel at either end, not take one.
        for x in from as usize..(to + 1.0) as usize {
            let shares = first + step * x as f32;
            if shares.min_element() >= 0.0 {
                each(y * size.x + low.x + x, shares);
            }
        }
    }
}

/// The first and the last whole number of steps, from 0 and below `count`, after which nothing may be negative; the last is less
/// than the first where there is none.
fn positive(first: Vec3, step: Vec3, count: f32) -> (f32, f32) {
    let (mut from, mut to) = (0.0f32, count - 1.0);
    for k in 0..3 {
        let root = -first[k] / step[k];
        if step[k] > 0.0 {
            from = from.max((root - 0.01).ceil());
        } else if step[k] < 0.0 {
            to = to.min((root + 0.01).floor());
        } else if first[k] < 0.0 {
            to = -1.0;
        }
    }
    (from, to)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The same, every pixel asked.
    fn asked([a, b, c]: [Vec2; 3], size: USizeVec2) -> Vec<usize> {
        let is_inside = |i: &usize| {
            let p = Vec2::new((i % size.x) as f32 + 0.5, (i / size.x) as f32 + 0.5);
            let signs = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(p - from));
            signs.iter().all(|s| *s > 1e-3) || signs.iter().all(|s| *s < -1e-3)
        };
        (0..size.element_product()).filter(is_inside).collect()
    }

    proptest! {
        #[test]
        fn every_pixel_inside_is_covered(corners in prop::array::uniform6(-5.0f32..25.0)) {
            let [ax, ay, bx, by, cx, cy] = corners;
            let corners = [Vec2::new(ax, ay), Vec2::new(bx, by), Vec2::new(cx, cy)];
            let (mut found, size) = (Vec::new(), USizeVec2::new(20, 16));
            covered(corners, size, |pixel, shares| {
                assert!((shares.element_sum() - 1.0).abs() < 1e-2);
                found.push(pixel);
            });
            prop_assert!(found.is_sorted() && found.iter().all(|pixel| *pixel < 320));
            prop_assert!(asked(corners, size).iter().all(|pixel| found.binary_search(pixel).is_ok()));
        }
    }

    #[test]
    fn two_triangles_of_a_square_cover_all_of_it() {
        let [a, b, c, d] = [(2.0, 2.0), (8.0, 2.0), (8.0, 8.0), (2.0, 8.0)].map(Vec2::from);
        let mut count = [0; 100];
        for corners in [[a, b, c], [a, c, d]] {
            covered(corners, USizeVec2::splat(10), |pixel, _| count[pixel] += 1);
        }
        assert!(
            count
                .iter()
                .enumerate()
                .all(|(i, n)| (*n > 0) == ((2..8).contains(&(i % 10)) && (2..8).contains(&(i / 10))))
        );
    }
}
