//! Where a plant beside the drawn one stands in the world, and how large it is there.
//!
//! Foot and height are said in canvas pixels, so that all plants of a drawing keep their places and sizes to one another
//! whatever size the drawing has in the world.

use crate::plant::{FinishedPlant, Plant, WorldFromCanvas};
use crate::sketch::{Canvas, PlacedPlant};
use glam::{Vec2, Vec3};
use std::ops::Range;

/// Scales beyond which a plant is left out, either way: numbers of its surfaces would lose their digits.
const LARGEST_SCALE: f32 = 1e3;
/// Heights of a plant that it may stand away from the world's origin, for the same reason.
const FARTHEST: f32 = 30.0;

/// A plant beside the drawn one, as it stands in the world among all branches and organs.
#[derive(Clone, Debug, PartialEq)]
pub struct BuiltBeside {
    /// Its branches.
    pub branches: Range<usize>,
    /// Its organs.
    pub organs: Range<usize>,
    /// Where it stands, metres.
    pub foot: Vec3,
    /// How high its wood and the feet of its organs reach above that, metres.
    pub height: f32,
}

/// Size and place of one plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placing {
    /// Where it stands, metres.
    foot: Vec3,
    /// How high it is, metres; none for its own height.
    height: Option<f32>,
}

impl Placing {
    /// That of a plant in the world of a drawing.
    pub(super) fn new(plant: &PlacedPlant, world: &WorldFromCanvas) -> Self {
        Self { foot: world.point(plant.foot), height: plant.height.map(|height| height * world.scale) }
    }

    /// Whether the plant can stand there; one that has not come up yet can.
    pub(super) fn fits(&self, plant: &Plant) -> bool {
        let (height, scale) = (height_of(plant), self.scale(plant));
        let is_near = self.foot.abs().max_element() <= FARTHEST * scale * height;
        height == 0.0 || (is_near && (1.0 / LARGEST_SCALE..=LARGEST_SCALE).contains(&scale))
    }

    /// Puts the plant there, which stands at the world's origin.
    pub(super) fn place(&self, plant: &mut FinishedPlant) {
        plant.scale_and_move(self.scale(plant), self.foot);
    }

    /// Where it stands, metres.
    pub(super) fn foot(&self) -> Vec3 {
        self.foot
    }

    fn scale(&self, plant: &Plant) -> f32 {
        let height = height_of(plant);
        self.height.filter(|_| height > 0.0).map_or(1.0, |wanted| wanted / height)
    }
}

/// Height of a plant above its foot, metres: of its wood and of where its organs stand.
fn height_of(plant: &Plant) -> f32 {
    height_above(0.0, plant)
}

/// The same of one that stands at this height, metres.
pub(super) fn height_above(ground: f32, plant: &Plant) -> f32 {
    let wood = plant.branches.iter().flat_map(|branch| branch.points.iter().map(|point| point.y));
    let all = wood.chain(plant.organs.iter().map(|organ| organ.base().y));
    all.map(|y| y - ground).fold(0.0, f32::max)
}

/// The world of a drawing of which nothing was built: the sheet is as high as the drawn plant would be, and the ground is its
/// lower edge.
pub(super) fn world_of_sheet(sheet: Canvas, height: f32) -> WorldFromCanvas {
    WorldFromCanvas { scale: height / sheet.height, origin: Vec2::new(0.5 * sheet.width, sheet.height) }
}
