//! Where a plant comes from: what only its drawing knows stands here, beside the [`Plant`].
//!
//! A plant knows of each branch and organ no more than its [`Origin`]: whether somebody drew this very one or a rule made
//! it. Models need that, for what was drawn is a part of its own and the rest is gathered; so do growth and species, which
//! let drawn wood stand as it is and may turn generated leaves into flowers. Which stroke it was, and where the drawing
//! lies in the world, is in the [`Provenance`], to which an origin refers. So branches and organs can be put into another
//! order, moved to another plant or left out, and the provenance stays as it is.

use super::Plant;
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Similarity between the drawing and the world: `x_world = (x − origin.x)·scale`, `y_world = (origin.y − y)·scale`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldFromCanvas {
    /// Metres per canvas pixel, positive.
    pub scale: f32,
    /// Canvas position of the world's origin: the ground at the lowest root of the plant.
    pub origin: Vec2,
}

impl Default for WorldFromCanvas {
    /// That of a plant without a drawing: a metre per pixel.
    fn default() -> Self {
        Self { scale: 1.0, origin: Vec2::ZERO }
    }
}

impl WorldFromCanvas {
    /// The world point of a canvas position, in the drawing plane z = 0.
    pub fn point(&self, canvas: Vec2) -> Vec3 {
        self.vector(canvas - self.origin)
    }

    /// Where a place of the canvas that lies so far in front of the sheet, canvas pixels, is in the world, metres.
    pub fn point_in_space(&self, canvas: Vec2, depth: f32) -> Vec3 {
        self.point(canvas).with_z(depth * self.scale)
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

/// Whether somebody drew a branch or an organ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Origin {
    /// A rule made it: growth, the filling of an outline, a species.
    #[default]
    Generated,
    /// It grew on a drawn plant, or is made of drawn parts, and is found again by its name.
    Grown(GrownId),
    /// Somebody drew this very one; the [`Provenance`] knows what with.
    Drawn(DrawnId),
}

/// Name of a branch or organ that grew: a hash of the way of buds that it grew from, the same at every age; or of a flower as a
/// whole, a hash of the strokes of its petals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GrownId(pub u64);

/// A branch that grew and at this age runs on in the line of another one: it is the thicker one where both fork, or the fork
/// is still to grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Continued {
    /// What it is called.
    pub name: GrownId,
    /// The branch in whose line it runs on.
    pub branch: usize,
    /// Where it begins, metres.
    pub from: Vec3,
}

/// Number of a drawn thing in the [`Provenance`] of its plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct DrawnId(u32);

impl DrawnId {
    /// Its place among the drawn things of its plant.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl Origin {
    /// Whether somebody drew it.
    pub fn is_drawn(self) -> bool {
        matches!(self, Self::Drawn(_))
    }
}

/// What only the drawing of a plant knows. That of a plant without a drawing is the default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// How the drawing maps to the world.
    pub world_from_canvas: WorldFromCanvas,
    strokes: Vec<u64>,
}

impl Provenance {
    /// That of a plant of which nothing is drawn yet.
    pub fn new(world_from_canvas: WorldFromCanvas) -> Self {
        Self { world_from_canvas, strokes: Vec::new() }
    }

    /// The origin of what this stroke draws, or of what no stroke draws.
    pub fn record(&mut self, stroke: Option<u64>) -> Origin {
        let Some(stroke) = stroke else { return Origin::Generated };
        self.strokes.push(stroke);
        Origin::Drawn(DrawnId(self.strokes.len() as u32 - 1))
    }

    /// The stroke of each drawn thing, in the order in which they were recorded.
    pub fn strokes(&self) -> &[u64] {
        &self.strokes
    }

    /// Gives the strokes behind everything that is drawn other names.
    pub fn rename(&mut self, name: impl Fn(u64) -> u64) {
        self.strokes.iter_mut().for_each(|stroke| *stroke = name(*stroke));
    }

    /// Id of the stroke that drew what has this origin; none if it was generated.
    pub fn stroke(&self, origin: Origin) -> Option<u64> {
        match origin {
            Origin::Generated | Origin::Grown(_) => None,
            Origin::Drawn(drawn) => self.strokes.get(drawn.index()).copied(),
        }
    }

    /// Id of the stroke that drew a branch, or else the nearest of those that it grows on; none where no stroke stands
    /// behind it.
    pub fn stroke_under(&self, plant: &Plant, branch: Option<usize>) -> Option<u64> {
        let branch_at = |index: Option<usize>| index.and_then(|index| plant.branches.get(index));
        // Parents stand before their children, so this ends.
        let downward = std::iter::successors(branch_at(branch), |found| branch_at(found.parent));
        downward.filter_map(|found| self.stroke(found.origin)).next()
    }

    /// Checks that the drawing's scale is a positive number and that the stroke of everything drawn in the plant is known.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self, plant: &Plant) -> Result<(), String> {
        let scale = self.world_from_canvas.scale;
        if !(scale.is_finite() && scale > 0.0) {
            return Err(format!("scale {scale}"));
        }
        let is_unknown = |origin: Origin| origin.is_drawn() && self.stroke(origin).is_none();
        if let Some(i) = plant.branches.iter().position(|branch| is_unknown(branch.origin)) {
            return Err(format!("branch {i}: drawn by nothing that is known"));
        }
        match plant.organs.iter().position(|organ| is_unknown(organ.origin)) {
            Some(i) => Err(format!("organ {i}: drawn by nothing that is known")),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Branch, Role, WoodPart};

    fn branch(parent: Option<usize>, level: u32, origin: Origin) -> Branch {
        let (points, radii) = (vec![Vec3::ZERO, Vec3::Y], vec![0.1; 2]);
        Branch { origin, parent, level, points, radii, role: Role::of(WoodPart::Stem) }
    }

    #[test]
    fn what_was_generated_stands_on_the_nearest_stroke_below() {
        let mut provenance = Provenance::default();
        let [trunk, bough] = [7, 9].map(|stroke| provenance.record(Some(stroke)));
        let twig = provenance.record(None);
        let branches = vec![
            branch(None, 0, trunk),
            branch(Some(0), 1, bough),
            branch(Some(1), 2, twig),
            branch(None, 0, twig),
        ];
        let plant = Plant { branches, ..Plant::default() };
        assert_eq!(provenance.check_invariants(&plant), Ok(()));
        let under = |branch| provenance.stroke_under(&plant, branch);
        assert_eq!([0, 1, 2, 3, 4].map(|b| under(Some(b))), [Some(7), Some(9), Some(9), None, None]);
        assert_eq!((under(None), twig), (None, Origin::Generated));
    }

    #[test]
    fn what_is_drawn_belongs_to_its_own_drawing() {
        let drawn = Provenance::default().record(Some(1));
        let plant = Plant { branches: vec![branch(None, 0, drawn)], ..Plant::default() };
        assert!(Provenance::default().check_invariants(&plant).unwrap_err().contains("branch 0"));
        let flat = WorldFromCanvas { scale: 0.0, origin: Vec2::ZERO };
        assert!(Provenance::new(flat).check_invariants(&Plant::default()).unwrap_err().contains("scale"));
    }
}
