//! Leaves of grown plants: where they stand on young wood, and the outlines that they are copies of.
//!
//! An outline is drawn with the leaf's base at the origin and its tip at (0, 1); its right half is a table, mirrored.
//! Compound and needled shoots are one outline with many teeth, so that a crown stays light.
//!
//! Sizes and directions may change with the plant's age. All leaves have those of the age that is shown, which change
//! without a jump. Numbers of leaves and the wood that has any may not: leaves would come and go at their full size.

use super::arrangement::Arrangement;
use super::schedule::Schedule;
use glam::Vec2;

crate::parameter_choice! {
    /// The outline of a leaf, or of a shoot's needles.
    pub enum LeafShape {
        /// Egg-shaped, widest below the middle: apple, cherry.
        Ovate = "ovate",
        /// Widest above the middle.
        Obovate = "obovate",
        /// Narrow, with the widest place low: willow.
        Lanceolate = "lanceolate",
        /// Elliptic with parallel sides: olive, box.
        Elliptic = "elliptic",
        /// Triangle with a long tip: birch, poplar.
        Deltoid = "deltoid",
        /// Round lobes on both sides: oak.
        Lobed = "lobed",
        /// Five pointed lobes from one place: maple.
        Palmate = "palmate",
        /// Three pointed lobes, broad at the base: ivy.
        ThreeLobed = "three_lobed",
        /// Many narrow needles from one place.
        Tuft = "tuft",
        /// A feather of leaflets, or of needles.
        Feather = "feather",
        /// Of few corners: a leaflet of a compound leaf, or a whole shoot whose picture is cut out: ash, walnut, spruce, linden.
        Leaflet = "leaflet",
        /// A flat spray of scales.
        Scale = "scale",
    }
}

/// Right halves of the outlines, base and tip left out: (half width, height), shares of the length at width 1.
fn right_half(shape: LeafShape) -> &'static [(f32, f32)] {
    match shape {
        LeafShape::Ovate => &[(0.36, 0.12), (0.5, 0.38), (0.32, 0.75)],
        LeafShape::Obovate => &[(0.2, 0.2), (0.45, 0.55), (0.4, 0.84)],
        LeafShape::Lanceolate => &[(0.4, 0.15), (0.5, 0.38), (0.3, 0.72)],
        LeafShape::Elliptic => &[(0.36, 0.14), (0.5, 0.5), (0.36, 0.86)],
        LeafShape::Deltoid => &[(0.46, 0.1), (0.48, 0.26), (0.2, 0.64)],
        LeafShape::Lobed => {
            &[(0.16, 0.14), (0.34, 0.3), (0.22, 0.42), (0.5, 0.62), (0.3, 0.74), (0.32, 0.92)]
        }
        LeafShape::Palmate => &[(0.34, 0.06), (0.22, 0.26), (0.5, 0.52), (0.16, 0.56)],
        LeafShape::ThreeLobed => &[(0.34, 0.02), (0.5, 0.34), (0.26, 0.46), (0.16, 0.72)],
        LeafShape::Tuft => &[
            (0.34, 0.16),
            (0.07, 0.14),
            (0.5, 0.46),
            (0.06, 0.28),
            (0.4, 0.76),
            (0.05, 0.44),
            (0.18, 0.94),
            (0.03, 0.55),
        ],
        LeafShape::Feather => &[
            (0.42, 0.12),
            (0.05, 0.18),
            (0.5, 0.34),
            (0.05, 0.4),
            (0.5, 0.58),
            (0.05, 0.62),
            (0.38, 0.82),
            (0.05, 0.84),
        ],
        LeafShape::Leaflet => &[(0.48, 0.28), (0.4, 0.66)],
        LeafShape::Scale => &[(0.3, 0.15), (0.12, 0.24), (0.5, 0.5), (0.16, 0.56), (0.32, 0.84)],
    }
}

/// The closed outline of a leaf of length 1 and the given width, counter-clockwise, base first.
pub(crate) fn outline(shape: LeafShape, width: f32) -> Vec<Vec2> {
    let half = right_half(shape);
    let at = |side: f32, &(x, y): &(f32, f32)| Vec2::new(side * x * width, y);
    let right = half.iter().map(|p| at(1.0, p));
    let left = half.iter().rev().map(|p| at(-1.0, p));
    std::iter::once(Vec2::ZERO).chain(right).chain([Vec2::Y]).chain(left).collect()
}

crate::parameters! {
    /// Leaves on young wood.
    pub struct LeafHabit {
        /// Length of a leaf with its stalk; 0 for a bare plant.
        length: Schedule = 0.08, 0.0..=3.0, "metres";
        /// Width of a leaf as a share of its length.
        width: Schedule = 0.6, 0.01..=3.0, "";
        /// Leaves along one internode.
        per_internode: u32 = 2, 0..=40, "";
        /// More leaves at the end of every shoot.
        at_tip: u32 = 2, 0..=40, "";
        /// How many years wood carries leaves.
        years: f32 = 2.0, 0.0..=50.0, "years";
        /// Angle between a leaf and its shoot.
        angle: Schedule = 55.0, 0.0..=170.0, "degrees";
        /// How far leaves hang down.
        droop: Schedule = 0.15, -2.0..=2.0, "";
        /// Random change of direction.
        scatter: Schedule = 0.3, 0.0..=2.0, "";
        /// Random change of length, up to.
        vary: Schedule = 0.25, 0.0..=0.9, "";
        /// How far leaves turn their face to the sky: 0 not at all, 1 wholly.
        face_up: Schedule = 0.6, 0.0..=1.0, "";
        /// Thickest wood that carries leaves, in diameters of the thinnest.
        thickest: f32 = 4.0, 1.0..=1000.0, "";
        choices:
        /// Outline of leaves that nobody drew.
        shape: LeafShape = LeafShape::Ovate;
        others:
        /// How leaves stand around their shoot; as the buds do if left out.
        arrangement: Option<Arrangement> = None;
    }
}

/// Sizes and directions of the leaves of one age; fields as in [`LeafHabit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafPose {
    /// Metres.
    pub length: f32,
    /// Share of the length.
    pub width: f32,
    /// Radians.
    pub angle_rad: f32,
    /// Weight of down.
    pub droop: f32,
    /// Random change of direction.
    pub scatter: f32,
    /// Random change of length.
    pub vary: f32,
    /// Turn of the face to the sky.
    pub face_up: f32,
}

impl LeafHabit {
    /// The leaves of a plant of this age in years.
    pub fn at(&self, age: f32) -> LeafPose {
        LeafPose {
            length: self.length.at(age),
            width: self.width.at(age),
            angle_rad: self.angle.at(age).to_radians(),
            droop: self.droop.at(age),
            scatter: self.scatter.at(age),
            vary: self.vary.at(age),
            face_up: self.face_up.at(age),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::simple_loop::{make_simple, signed_area};

    #[test]
    fn outlines_are_simple_and_counter_clockwise() {
        use LeafShape as S;
        let all = [
            S::Ovate,
            S::Obovate,
            S::Lanceolate,
            S::Elliptic,
            S::Deltoid,
            S::Lobed,
            S::Palmate,
            S::Tuft,
            S::Feather,
            S::Leaflet,
            S::Scale,
        ];
        for shape in all {
            let points = outline(shape, 0.7);
            assert!(signed_area(points.iter().copied()) > 0.0, "{shape:?}");
            assert_eq!(make_simple(points.clone(), |p| *p, |a, b, t| a.lerp(*b, t)), points, "{shape:?}");
        }
    }
}
