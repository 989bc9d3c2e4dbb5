//! The waist: one plain description of a plant, wherever it came from.
//!
//! A [`Plant`] is a tree of [`Branch`]es (3D skeleton polylines with radii), the [`Flower`]s on them and the
//! [`Organ`]s of both. World space: metres, y up, z toward the viewer, right-handed. It knows no strokes beyond their
//! ids, no triangles and nobody else in the program.
//!
//! Topological order is an invariant: a branch's parent stands before it. [`Plant::check_invariants`] says all of them.

pub mod blade;
pub mod cone;
pub mod invariants;
pub mod junction;
pub mod material;
pub mod organ_kind;

pub use blade::{Blade, BladeForm, RestSurface};
pub use cone::Cone;
pub use material::{Material, Texture};
pub use organ_kind::{OrganClass, OrganForm, OrganKind};

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Similarity between the drawing and the world: `x_world = (x − origin.x)·scale`, `y_world = (origin.y − y)·scale`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldFromCanvas {
    /// Metres per canvas pixel.
    pub scale: f32,
    /// Canvas position of the world's origin: the ground at the lowest root of the plant.
    pub origin: Vec2,
}

impl WorldFromCanvas {
    /// The world point of a canvas position, in the drawing plane z = 0.
    pub fn point(&self, canvas: Vec2) -> Vec3 {
        self.vector(canvas - self.origin)
    }

    /// The world vector of a canvas displacement.
    pub fn vector(&self, canvas: Vec2) -> Vec3 {
        Vec3::new(canvas.x * self.scale, -canvas.y * self.scale, 0.0)
    }

    /// Where a world point appears in the drawing, seen from the front.
    pub fn canvas(&self, world: Vec3) -> Vec2 {
        self.origin + Vec2::new(world.x, -world.y) / self.scale
    }
}

/// One branch: a skeleton from its base to its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Branch {
    /// The stroke that drew it, `None` for a generated twig.
    pub stroke: Option<u64>,
    /// Index of the branch that carries it; always smaller than its own.
    pub parent: Option<usize>,
    /// Distance from the ground: 0 for a trunk or stem, 1 for its children, and so on.
    pub level: u32,
    /// Skeleton in metres, base first, at least two points, no two consecutive ones equal.
    pub points: Vec<Vec3>,
    /// Radius in metres at each point, positive.
    pub radii: Vec<f32>,
    /// Index into [`Plant::materials`].
    pub material: usize,
}

/// Pose of one flower: the cone on which its petals stand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flower {
    /// The branch that ends in it.
    pub branch: Option<usize>,
    /// Apex, axis and opening of the petals' cone; the apex is the flower's centre.
    pub cone: Cone,
    /// Radius of the flower's heart in metres: where petals meet the receptacle.
    pub heart_radius: f32,
    /// Distance from the centre to the petals' tips in metres.
    pub reach: f32,
    /// Index of the flower's look among the species' flowers.
    pub look: usize,
}

/// Shape and pose of an organ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A thin surface inside an outline.
    Blade(Blade),
    /// Part of an ellipsoid standing on `base`, closed underneath.
    Dome {
        /// Centre of the underside, metres.
        base: Vec3,
        /// Unit direction of its top.
        axis: Vec3,
        /// Radius of the underside, metres.
        radius: f32,
        /// Height above the underside, metres.
        height: f32,
    },
    /// A thread with a swollen end.
    Filament {
        /// Skeleton in metres, base first, at least two points.
        points: Vec<Vec3>,
        /// Radius of the thread, metres.
        radius: f32,
        /// Radius and half length of the ellipsoid at its end, metres; zero for none.
        head: Vec2,
        /// Index into [`Plant::materials`] of the head.
        head_material: usize,
    },
    /// A solid of revolution about `axis`: a pot, a fruit.
    Lathe {
        /// Lowest point of the axis, metres.
        base: Vec3,
        /// Unit direction of the axis.
        axis: Vec3,
        /// (radius, height) along the outside from bottom to top and down the inside, metres; first and last radius 0.
        profile: Vec<Vec2>,
    },
}

/// One organ of the plant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Organ {
    /// What it is.
    pub kind: OrganKind,
    /// The stroke that drew it, `None` if generated.
    pub stroke: Option<u64>,
    /// The branch it grows on.
    pub branch: Option<usize>,
    /// The flower it belongs to.
    pub flower: Option<usize>,
    /// Index into [`Plant::materials`].
    pub material: usize,
    /// Shape and pose.
    pub shape: Shape,
}

impl Shape {
    /// Moves all of it.
    pub fn translate(&mut self, by: Vec3) {
        match self {
            Self::Blade(blade) => blade.translate(by),
            Self::Dome { base, .. } | Self::Lathe { base, .. } => *base += by,
            Self::Filament { points, .. } => points.iter_mut().for_each(|point| *point += by),
        }
    }
}

impl Organ {
    /// Where the organ is attached: the pivot of its node in exported files.
    pub fn base(&self) -> Vec3 {
        match &self.shape {
            Shape::Blade(blade) => blade.base(),
            Shape::Dome { base, .. } | Shape::Lathe { base, .. } => *base,
            Shape::Filament { points, .. } => points.first().copied().unwrap_or(Vec3::ZERO),
        }
    }
}

/// A plant, or the several plants of one drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plant {
    /// How the drawing maps to the world.
    pub world_from_canvas: WorldFromCanvas,
    /// Skeleton, parents before children.
    pub branches: Vec<Branch>,
    /// Flowers, in the order in which they were understood.
    pub flowers: Vec<Flower>,
    /// Everything that is not wood.
    pub organs: Vec<Organ>,
    /// The looks that branches and organs refer to.
    pub materials: Vec<Material>,
}

impl Plant {
    /// For each branch the index of its trunk, the branch without parent that it stands on.
    pub fn trunks(&self) -> Vec<usize> {
        let mut trunk = Vec::with_capacity(self.branches.len());
        for (i, branch) in self.branches.iter().enumerate() {
            trunk.push(branch.parent.map_or(i, |p| trunk[p]));
        }
        trunk
    }
}
