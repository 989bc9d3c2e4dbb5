//! Which plants of a crowd a camera sees, and how wide they are in its picture: judged by the spheres around them.
//!
//! Turning the camera changes no width, so that a plant does not change its form while one looks around.

use super::camera::Camera;
use super::orbit::OrbitCamera;
use glam::{Vec3, Vec4, Vec4Swizzles as _};

/// Nearer than this share of a sphere's radius its width grows no more.
const NEAREST: f32 = 0.1;

/// A camera that takes pictures of some height.
pub struct Sight {
    /// Left, right, lower, upper and near side of what is seen: the distances of a point inside of them are above 0.
    sides: [Vec4; 5],
    /// Position with w = 1, or direction to the viewer with w = 0.
    eye: Vec4,
    /// Pixels of a metre: a metre away, or everywhere for parallel rays.
    pixels: f32,
}

impl Sight {
    /// A camera around something in this box, which takes pictures of so many pixels in width and height.
    pub fn of(camera: &OrbitCamera, bounds: (Vec3, Vec3), [width, height]: [u32; 2]) -> Self {
        Self::new(&camera.camera(bounds, width as f32 / height.max(1) as f32), height)
    }

    /// A camera that takes pictures of so many pixels in height.
    pub(super) fn new(camera: &Camera, height: u32) -> Self {
        let rows = camera.clip_from_world.transpose();
        let [x, y, z, w] = [rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis];
        Self {
            sides: [w + x, w - x, w + y, w - y, z]
                .map(|side| side / side.xyz().length().max(f32::MIN_POSITIVE)),
            eye: camera.eye,
            pixels: y.xyz().length() * height as f32 / 2.0,
        }
    }

    /// Whether anything of a sphere may be seen.
    pub(super) fn sees(&self, centre: Vec3, radius: f32) -> bool {
        let centre = centre.extend(1.0);
        self.sides.iter().all(|side| side.dot(centre) > -radius)
    }

    /// Where the viewer is from a place: the direction, of length 1.
    pub(super) fn viewer_from(&self, place: Vec3) -> Vec3 {
        (self.eye.xyz() - place * self.eye.w).normalize_or(Vec3::Y)
    }

    /// How wide a sphere is in the picture, pixels, as its nearest point shows it.
    pub(super) fn width(&self, centre: Vec3, radius: f32) -> f32 {
        let width = 2.0 * radius * self.pixels;
        if self.eye.w == 0.0 {
            return width;
        }
        let nearest = centre.distance(self.eye.xyz()) - radius;
        width / nearest.max(NEAREST * radius).max(f32::MIN_POSITIVE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    /// Somebody at the origin, 1.6 m above the ground, who looks along -z.
    fn sight() -> Sight {
        let camera = OrbitCamera::at_eye(Vec2::ZERO, 1.6, Vec2::NEG_Y, 0.0);
        Sight::new(&camera.camera((Vec3::splat(-50.0), Vec3::splat(50.0)), 1.5), 900)
    }

    #[test]
    fn what_is_behind_or_beside_is_not_seen() {
        let sight = sight();
        let sees = |x, y, z| sight.sees(Vec3::new(x, y, z), 0.5);
        assert!(sees(0.0, 1.0, -8.0) && sees(5.0, 1.0, -8.0) && sees(0.0, 1.0, -0.3));
        assert!(
            !sees(0.0, 1.0, 2.0)
                && !sees(20.0, 1.0, -8.0)
                && !sees(0.0, 30.0, -8.0)
                && !sees(-20.0, 1.0, -8.0)
        );
    }

    #[test]
    fn what_is_twice_as_far_or_half_as_large_is_half_as_wide() {
        let sight = sight();
        let width = |away: f32, radius| sight.width(Vec3::new(0.0, 1.6, -away - radius), radius);
        assert!((width(8.0, 1.0) / width(4.0, 1.0) - 0.5).abs() < 1e-4);
        assert!((width(4.0, 1.0) / width(4.0, 0.5) - 2.0).abs() < 1e-4);
        // The view of 58 degrees shows 4.43 m at a distance of 4 m.
        assert!((width(4.0, 1.0) - 900.0 * 2.0 / 4.434).abs() < 1.0, "{}", width(4.0, 1.0));
        assert_eq!(sight.width(Vec3::new(0.0, 1.6, 0.0), 1.0), sight.width(Vec3::new(0.0, 1.6, -0.5), 1.0));
        let (left, right) = (Vec3::new(-3.0, 1.6, -4.0), Vec3::new(5.0, 1.6, 0.0));
        assert!(
            (sight.width(left, 1.0) - sight.width(right, 1.0)).abs() < 1e-2,
            "wherever it is in the picture"
        );
    }
}
