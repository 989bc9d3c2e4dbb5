//! Lobes as the artist has them: strokes in space, where they are moved, what is changed of their surface.
//!
//! Plain data; [`shape`](super::shape) makes surfaces of it, [`text`](super::text) reads it from files.

use glam::{EulerRot, Quat, Vec3};

/// A stroke in space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpaceStroke {
    /// Whether it is a loop; left open, its ends decide.
    pub closed: Option<bool>,
    /// Its samples, metres.
    pub points: Vec<Vec3>,
}

/// How the strokes of a lobe become a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// As the strokes suggest.
    #[default]
    Auto,
    /// Strips between strokes, one after the other.
    Loft,
    /// Two open strokes are profiles: circles between them.
    Turned,
    /// Open strokes span a sheet, which gets a thickness.
    Sheet,
}

/// Where a lobe stands: it is scaled and turned about the middle of its surface's box, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// How far it is moved, metres.
    pub shift: Vec3,
    /// Turns about x, then y, then z, degrees.
    pub turn_deg: Vec3,
    /// How many times as large.
    pub scale: f32,
}

impl Default for Pose {
    fn default() -> Self {
        Self { shift: Vec3::ZERO, turn_deg: Vec3::ZERO, scale: 1.0 }
    }
}

impl Pose {
    /// A point of a lobe with this middle, as the lobe stands.
    pub fn place(&self, p: Vec3, middle: Vec3) -> Vec3 {
        middle + self.shift + self.turn() * ((p - middle) * self.scale)
    }

    fn turn(&self) -> Quat {
        let [x, y, z] = self.turn_deg.to_array().map(f32::to_radians);
        Quat::from_euler(EulerRot::ZYX, z, y, x)
    }
}

/// How far a vertex of a lobe's surface is moved, in the frame of the surface there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offset {
    /// The vertex of the surface as it is without offsets.
    pub vertex: u32,
    /// Along the surface's two tangents and its normal, metres.
    pub by: Vec3,
}

/// A lobe.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lobe {
    /// What it is called.
    pub name: String,
    /// Its strokes, in the order in which they were drawn.
    pub strokes: Vec<SpaceStroke>,
    /// How they become a surface.
    pub form: Form,
    /// Whether the strokes already stand in their order along the lobe.
    pub in_order: bool,
    /// What is changed of the surface, each vertex once.
    pub deform: Vec<Offset>,
    /// Where it stands.
    pub pose: Pose,
    /// Whether it is taken away from the others instead of added.
    pub negative: bool,
    /// Whether it is left out.
    pub off: bool,
}

/// Wood that is drawn with the lobes.
#[derive(Clone, Debug, PartialEq)]
pub struct Trunk {
    /// From its foot on, metres.
    pub points: Vec<Vec3>,
    /// Radius at its foot, metres.
    pub radius: f32,
}

/// A crown: lobes, and the wood that carries them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Crown {
    /// The lobes.
    pub lobes: Vec<Lobe>,
    /// Drawn wood; without any a trunk is found.
    pub trunks: Vec<Trunk>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_turns_about_the_middle_and_moves() {
        let pose = Pose { shift: Vec3::Y, turn_deg: Vec3::new(0.0, 90.0, 0.0), scale: 2.0 };
        let placed = pose.place(Vec3::new(2.0, 0.0, 0.0), Vec3::X);
        assert!(placed.distance(Vec3::new(1.0, 1.0, -2.0)) < 1e-5, "{placed}");
        assert_eq!(Pose::default().place(Vec3::ONE, Vec3::X), Vec3::ONE);
    }
}
