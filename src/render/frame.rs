//! One view of the scene as the shaders read it.

use super::camera::Camera;
use super::look::Background;
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};

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
    /// A model inside `bounds` seen by `camera`; the ground touches the model's lowest point.
    pub(super) fn new(camera: &Camera, bounds: (Vec3, Vec3), background: Background) -> Self {
        let (lo, hi) = bounds;
        let (centre, edge) = background.colours();
        let foot = ((lo + hi) / 2.0).with_y(lo.y);
        Self {
            clip_from_world: camera.clip_from_world,
            world_from_clip: camera.clip_from_world.inverse(),
            eye: camera.eye,
            backdrop_centre: centre.extend(lo.y),
            backdrop_edge: edge.extend(f32::from(u8::from(background == Background::Outdoors))),
            foot: foot.extend(1.6 * (hi - lo).length().max(1e-6)),
        }
    }

    /// An empty sheet of paper: a level parallel camera, which sees no ground.
    pub(super) fn paper() -> Self {
        let camera = Camera { clip_from_world: Mat4::IDENTITY, eye: Vec4::Z };
        Self::new(&camera, (Vec3::ZERO, Vec3::ZERO), Background::Paper)
    }
}
