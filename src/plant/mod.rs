//! The waist: one plain description of a plant, wherever it came from.
//!
//! A [`Plant`] is a tree of [`Branch`]es (3D skeleton polylines with radii), the [`Flower`]s on them and the
//! [`Organ`]s of both; blades among those are copies of the plant's [`Templates`]. World space: metres, y up, z toward the viewer, right-handed. It knows no drawing, no
//! triangles and nobody else in the program; what only the drawing knows is its [`Provenance`], which stands beside it.
//!
//! Each branch and organ has a [`Role`], which says what it is. Applying a species makes a [`FinishedPlant`] of it, in
//! which every role has a material.
//!
//! Topological order is an invariant: a branch's parent stands before it. [`Plant::check_invariants`] says all of them.

mod assembly;
pub mod blade;
pub mod cone;
mod cut;
pub mod finished;
pub mod flower_bud;
pub mod invariants;
pub mod junction;
pub mod material;
pub mod motion;
pub mod order;
mod organ_kind;
pub mod patch;
pub mod petal_frame;
pub mod provenance;
pub mod ring_curve;
pub mod ring_sheet;
pub mod role;
pub mod stem_base;
pub mod template;
mod templates;

pub use blade::{Blade, BladeForm, ResolvedBlade, RestSurface};
pub use cone::Cone;
pub use cut::Cut;
pub use finished::FinishedPlant;
pub use flower_bud::{FlowerBud, FlowerBuds};
pub use material::{Material, Texture};
pub use motion::Motion;
pub use organ_kind::{OrganClass, OrganForm, OrganKind};
pub use patch::{BezierPatch, Sheet};
pub use petal_frame::PetalFrame;
pub use provenance::{Continued, DrawnId, GrownId, Origin, Provenance, WorldFromCanvas};
pub use ring_curve::RingCurve;
pub use ring_sheet::{Level, RingSheet};
pub use role::{OrganPart, PlantPart, Role, WoodPart};
pub use stem_base::StemBase;
pub use template::{Detail, Template, TemplateId};
pub use templates::Templates;

use crate::geom::polyline;
use glam::{Vec2, Vec3};

/// One branch: a skeleton from its base to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Whether it was drawn.
    pub origin: Origin,
    /// Index of the branch that carries it; always smaller than its own.
    pub parent: Option<usize>,
    /// Branching order: 0 for trunks, and for the stems of a bush, which stand on a base that the first of them runs through
    /// ([`StemBase`]); for all others one more than their parent's.
    pub level: u32,
    /// Skeleton in metres, base first, at least two points, no two consecutive ones equal. It begins inside of the parent.
    pub points: Vec<Vec3>,
    /// Radius in metres at each point, positive.
    pub radii: Vec<f32>,
    /// What it is.
    pub role: Role<WoodPart>,
}

impl Branch {
    /// Whether it is one of the stems of a bush, but not the first, which runs through their base.
    pub fn is_basal_stem(&self) -> bool {
        self.level == 0 && self.parent.is_some()
    }

    /// The place on its axis that is nearest to a point, with its radius there, metres.
    pub fn axis_at(&self, p: Vec3) -> (Vec3, f32) {
        let on = |(k, ends): (usize, &[Vec3])| {
            let share = polyline::nearest_share(ends[0], ends[1], p, Vec3::dot);
            (ends[0].lerp(ends[1], share), self.radii[k] + (self.radii[k + 1] - self.radii[k]) * share)
        };
        let places = self.points.windows(2).enumerate().map(on);
        let nearest = places.min_by(|a, b| a.0.distance_squared(p).total_cmp(&b.0.distance_squared(p)));
        nearest.unwrap_or((self.points.first().copied().unwrap_or(p), f32::MIN_POSITIVE))
    }
}

/// Pose of one flower: the cone on which its petals stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Flower {
    /// What it is known by: its petals may be drawn, it as a whole is not.
    pub origin: Origin,
    /// The branch that ends in it.
    pub branch: Option<usize>,
    /// Apex, axis and opening of the petals' cone; the apex is the flower's centre.
    pub cone: Cone,
    /// Radius of the flower's centre in metres: where petals meet the receptacle.
    pub centre_radius: f32,
    /// Distance from the centre to the petals' tips in metres.
    pub reach: f32,
    /// Number of the flower among those of its plant, copies that of what they are copies of; applied, a species makes it the index
    /// of its look among the species' flowers.
    pub look: usize,
}

/// Shape and pose of an organ.
#[derive(Clone, Debug, PartialEq)]
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
    /// A filament with a swollen end, whose role is [`Role::of_head`].
    Filament {
        /// Skeleton in metres, base first, at least two points.
        points: Vec<Vec3>,
        /// Radius of the filament, metres.
        radius: f32,
        /// Radius and half length of the ellipsoid at its end, metres; zero for none.
        head: Vec2,
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
    /// A rectangle with a part of a picture: foliage that is seen from afar.
    Card {
        /// Middle of its lower edge, metres.
        base: Vec3,
        /// From its left to its right edge, metres.
        u: Vec3,
        /// From its lower to its upper edge, metres; square to `u`.
        v: Vec3,
        /// Left lower and right upper corner of its part of the picture, each 0 to 1 from the picture's left lower corner.
        window: [Vec2; 2],
        /// Whether it shows a whole plant, whose light comes from above, instead of a shoot, which may look any way.
        is_whole: bool,
    },
    /// A cone with an elliptic foot, bent toward its tip: a thorn.
    Spike {
        /// Middle of the foot, metres.
        base: Vec3,
        /// The tip, metres.
        tip: Vec3,
        /// Unit vector across the axis in which the foot is `foot.x` long to each side.
        side: Vec3,
        /// Half the length and half the width of the foot, metres, positive.
        foot: Vec2,
        /// How far the tip lies aside of where the foot points, metres.
        hook: Vec3,
    },
}

/// One organ of the plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Organ {
    /// What it is.
    pub role: Role<OrganPart>,
    /// Whether it was drawn.
    pub origin: Origin,
    /// The branch it grows on.
    pub branch: Option<usize>,
    /// The flower it belongs to.
    pub flower: Option<usize>,
    /// Shape and pose.
    pub shape: Shape,
}

impl Shape {
    /// Moves all of it.
    pub fn translate(&mut self, by: Vec3) {
        match self {
            Self::Blade(blade) => blade.translate(by),
            Self::Dome { base, .. } | Self::Lathe { base, .. } | Self::Card { base, .. } => *base += by,
            Self::Spike { base, tip, .. } => {
                *base += by;
                *tip += by;
            }
            Self::Filament { points, .. } => points.iter_mut().for_each(|point| *point += by),
        }
    }
}

impl Organ {
    /// The kind of organ that its role belongs to.
    pub fn kind(&self) -> OrganKind {
        self.role.part.kind()
    }

    /// Where the organ is attached: the pivot of its node in exported files.
    pub fn base(&self) -> Vec3 {
        match &self.shape {
            Shape::Blade(blade) => blade.base,
            Shape::Dome { base, .. }
            | Shape::Lathe { base, .. }
            | Shape::Card { base, .. }
            | Shape::Spike { base, .. } => *base,
            Shape::Filament { points, .. } => points.first().copied().unwrap_or(Vec3::ZERO),
        }
    }
}

/// A plant, or the several plants of one drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plant {
    /// Skeleton, parents before children.
    pub branches: Vec<Branch>,
    /// Flowers, in the order in which they were understood.
    pub flowers: Vec<Flower>,
    /// Everything that is not wood.
    pub organs: Vec<Organ>,
    /// What blades are copies of; each has a copy.
    pub templates: Templates,
}

impl Plant {
    /// The role of every branch, then of every piece of the organs, with repetitions.
    pub fn roles(&self) -> impl Iterator<Item = Role> {
        let of_organs = self.organs.iter().flat_map(|organ| {
            let head = matches!(organ.shape, Shape::Filament { .. }).then(|| organ.role.of_head());
            std::iter::once(organ.role).chain(head).map(Role::from)
        });
        self.branches.iter().map(|branch| branch.role.into()).chain(of_organs)
    }

    /// For each branch the index of its trunk, the branch without parent that it stands on.
    pub fn trunks(&self) -> Vec<usize> {
        let mut trunk = Vec::with_capacity(self.branches.len());
        for (i, branch) in self.branches.iter().enumerate() {
            trunk.push(branch.parent.map_or(i, |p| trunk[p]));
        }
        trunk
    }
}
