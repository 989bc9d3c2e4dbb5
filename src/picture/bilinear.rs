//! What lies between the middles of pixels.

use glam::{UVec2, Vec2};

/// The four pixels around a place and how much each counts, for bilinear interpolation; pixels beyond the edge are those at
/// the edge.
pub fn around(size: UVec2, at: Vec2) -> [(usize, f32); 4] {
    let last = size.as_vec2() - 1.0;
    let place = (at - 0.5).clamp(Vec2::ZERO, last);
    let low = place.floor().min((last - 1.0).max(Vec2::ZERO));
    let share = place - low;
    let (x, y, width) = (low.x as usize, low.y as usize, size.x as usize);
    let (right, down) = ((x + 1).min(width - 1), (y + 1).min(size.y as usize - 1));
    let [a, b] = [1.0 - share, share];
    [
        (y * width + x, a.x * a.y),
        (y * width + right, b.x * a.y),
        (down * width + x, a.x * b.y),
        (down * width + right, b.x * b.y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_pixels_all_count_their_share() {
        let size = UVec2::new(4, 3);
        for at in [(0.5, 0.5), (1.2, 1.9), (3.9, 2.9), (-5.0, 7.0)].map(Vec2::from) {
            let sum: f32 = around(size, at).iter().map(|(_, share)| share).sum();
            assert!((sum - 1.0).abs() < 1e-6 && around(size, at).iter().all(|(i, _)| *i < 12));
        }
        assert_eq!(around(size, Vec2::new(2.5, 1.5)).iter().find(|(_, s)| *s == 1.0), Some(&(6, 1.0)));
        assert_eq!(around(UVec2::ONE, Vec2::ZERO)[0], (0, 1.0));
    }
}
