//! One view of the scene as the shaders read it.

use super::camera::Camera;
use super::look::Background;
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};

/// How far the open lawn lies below the ground of a garden, metres: its edge is seen, and neither shines through the other.
const SUNK: f32 = 0.005;

/// `Frame` in `frame.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct FrameUniform {
    clip_from_world: Mat4,
    world_from_clip: Mat4,
    eye: Vec4,
    backdrop_centre: Vec4,
    backdrop_edge: Vec4,
    foot: Vec4,
}

impl FrameUniform {
    /// A model inside `bounds` seen by `camera`; the ground touches the model's lowest point. Outdoors it is just below the model's own
    /// `ground`, if it has some.
    pub(super) fn new(
        camera: &Camera,
        bounds: (Vec3, Vec3),
        (background, ground): (Background, Option<f32>),
    ) -> Self {
        let (lo, hi) = bounds;
        let (centre, edge) = background.colours();
        let own = ground.filter(|_| background == Background::Outdoors);
        let height = own.map_or(lo.y, |ground| (ground - SUNK).max(lo.y));
        let foot = ((lo + hi) / 2.0).with_y(height);
        Self {
            clip_from_world: camera.clip_from_world,
            world_from_clip: camera.clip_from_world.inverse(),
            eye: camera.eye,
            backdrop_centre: centre.extend(height),
            backdrop_edge: edge.extend(f32::from(u8::from(background == Background::Outdoors))),
            foot: foot.extend(1.6 * (hi - lo).length().max(1e-6)),
        }
    }

    /// An empty sheet of paper: a level parallel camera, which sees no ground.
    pub(super) fn paper() -> Self {
        let camera = Camera { clip_from_world: Mat4::IDENTITY, eye: Vec4::Z };
        Self::new(&camera, (Vec3::ZERO, Vec3::ZERO), (Background::Paper, None))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outdoors_the_lawn_lies_just_below_the_ground_of_a_garden() {
        let bounds = (Vec3::new(-1.0, -0.25, -1.0), Vec3::ONE);
        let camera = Camera { clip_from_world: Mat4::IDENTITY, eye: Vec4::Z };
        let height = |background, ground| FrameUniform::new(&camera, bounds, (background, ground)).foot.y;
        assert_eq!(height(Background::Outdoors, Some(0.0)), -SUNK);
        assert_eq!(height(Background::Paper, Some(0.0)), -0.25);
        assert_eq!(height(Background::Outdoors, None), -0.25);
    }
}
