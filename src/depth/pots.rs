//! Drawn pots in the world: turned bodies with earth in them, and the plant's feet on that earth.
//!
//! The outside of a pot is as it was drawn; its wall is thin, and earth fills it to a little below the rim. It stands upright with
//! its axis in the plane of the drawing. Stems that were drawn to end above the earth are led down to it, so that nothing
//! floats; those that end below go on into it.
//!
//! Limits: a pot that was drawn from above stands level all the same.

use crate::anatomy::Anatomy;
use crate::anatomy::conventions::{Solid, SolidKind};
use crate::plant::{Branch, Organ, OrganPart, Origin, Plant, Provenance, Role, Shape, WorldFromCanvas};
use glam::{Vec2, Vec3};

/// Thickness of the wall, as a share of the greatest radius.
const WALL: f32 = 0.07;
/// Heights as shares of the pot's: the edge of the earth, the floor inside below it, how far the earth rises in the middle.
const EARTH: (f32, f32, f32) = (0.88, 0.08, 0.05);
/// How far a stem is led into the earth, as a share of the pot's height.
const INTO: f32 = 0.03;

/// The lowest pot's foot on the canvas: where the ground is.
pub(super) fn foot(anatomy: &Anatomy) -> Option<Vec2> {
    let feet = pots(anatomy).filter_map(|(_, pot)| Some(Vec2::new(pot.axis, pot.profile.last()?.y)));
    feet.max_by(|a, b| a.y.total_cmp(&b.y))
}

/// Adds the drawn pots with their earth, and leads stems to that.
pub(super) fn add(plant: &mut Plant, provenance: &mut Provenance, anatomy: &Anatomy) {
    let world = provenance.world_from_canvas;
    for (stroke, solid) in pots(anatomy) {
        let Some(pot) = Pot::new(solid, &world) else { continue };
        plant.branches.iter_mut().filter(|branch| branch.parent.is_none()).for_each(|stem| pot.lead(stem));
        let origin = provenance.record(Some(stroke));
        plant.organs.push(organ(OrganPart::Pot, origin, pot.shape()));
        plant.organs.push(organ(OrganPart::Soil, Origin::Generated, pot.earth()));
    }
}

/// Pots with the strokes that drew them.
fn pots(anatomy: &Anatomy) -> impl Iterator<Item = (u64, &Solid)> {
    let pots = anatomy.solids.iter().filter(|drawn| drawn.solid.kind == SolidKind::Pot);
    pots.map(|drawn| (drawn.stroke, &drawn.solid))
}

fn organ(part: OrganPart, origin: Origin, shape: Shape) -> Organ {
    Organ { role: Role::of(part), origin, branch: None, flower: None, shape }
}

/// A pot in the world.
struct Pot {
    /// Lowest point of its axis.
    base: Vec3,
    /// Radius and height over the base of its outside, from below, at least two.
    outside: Vec<Vec2>,
    height: f32,
    wall: f32,
}

impl Pot {
    fn new(solid: &Solid, world: &WorldFromCanvas) -> Option<Self> {
        let bottom = solid.profile.last()?.y;
        let base = world.point(Vec2::new(solid.axis, bottom));
        let row = |p: &Vec2| Vec2::new(p.x, bottom - p.y) * world.scale;
        let outside: Vec<Vec2> = solid.profile.iter().rev().map(row).collect();
        let height = outside.last()?.y;
        let widest = outside.iter().map(|p| p.x).fold(0.0, f32::max);
        let narrowest = outside.iter().map(|p| p.x).fold(f32::INFINITY, f32::min);
        let wall = (WALL * widest).min(0.4 * narrowest);
        (height > 0.0 && wall > 0.0).then_some(Self { base, outside, height, wall })
    }

    /// Radius of its outside at a height.
    fn radius(&self, height: f32) -> f32 {
        let above = self.outside.partition_point(|p| p.y < height).clamp(1, self.outside.len() - 1);
        let (a, b) = (self.outside[above - 1], self.outside[above]);
        let share = (height - a.y) / (b.y - a.y).max(f32::MIN_POSITIVE);
        a.x + share.clamp(0.0, 1.0) * (b.x - a.x)
    }

    /// The pot: its outside from below, the rim, and the inside down to below the earth.
    fn shape(&self) -> Shape {
        let floor = (EARTH.0 - EARTH.1) * self.height;
        let inner = |height: f32| Vec2::new(self.radius(height) - self.wall, height);
        let inside = self.outside.iter().rev().map(|p| p.y).take_while(|height| *height > floor);
        let mut profile = vec![Vec2::ZERO];
        profile.extend(&self.outside);
        profile.extend(inside.map(inner));
        profile.extend([inner(floor), Vec2::new(0.0, floor)]);
        Shape::Lathe { base: self.base, axis: Vec3::Y, profile }
    }

    /// The earth, which reaches a little into the wall.
    fn earth(&self) -> Shape {
        let edge = (EARTH.0 - 0.5 * EARTH.1) * self.height;
        let radius = self.radius(edge) - 0.6 * self.wall;
        let height = (0.5 * EARTH.1 + EARTH.2) * self.height;
        Shape::Dome { base: self.base + Vec3::Y * edge, axis: Vec3::Y, radius, height }
    }

    /// Leads a stem that ends above the pot's mouth down into the earth.
    fn lead(&self, stem: &mut Branch) {
        let (Some(&foot), Some(&radius)) = (stem.points.first(), stem.radii.first()) else { return };
        let earth = self.base.y + (EARTH.0 - INTO) * self.height;
        let aside = (foot.x - self.base.x).hypot(foot.z - self.base.z);
        let is_over = aside < self.radius(self.height) && foot.y < self.base.y + 2.0 * self.height;
        if is_over && foot.y > earth {
            stem.points.insert(0, foot.with_y(earth));
            stem.radii.insert(0, radius);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::DrawnSolid;
    use crate::plant::WoodPart;

    /// A pot from 60 to 100 pixels below the top of the sheet, wider above.
    fn anatomy() -> Anatomy {
        let profile = (0..=8).map(|k| Vec2::new(22.0 - k as f32, 60.0 + 5.0 * k as f32)).collect();
        let solid = Solid { kind: SolidKind::Pot, axis: 50.0, profile };
        Anatomy { solids: vec![DrawnSolid { stroke: 7, solid }], ..Anatomy::default() }
    }

    fn stem(x: f32, y: f32) -> Branch {
        let points = vec![Vec3::new(x, y, 0.0), Vec3::new(x, 2.0, 0.0)];
        Branch {
            origin: Origin::Generated,
            parent: None,
            level: 0,
            points,
            radii: vec![0.01; 2],
            role: Role::of(WoodPart::Stem),
        }
    }

    /// The plant of these stems with the drawn pot; a pixel is a centimetre.
    fn potted(stems: Vec<Branch>) -> (Plant, Provenance) {
        let anatomy = anatomy();
        let mut plant = Plant { branches: stems, ..Plant::default() };
        let origin = foot(&anatomy).unwrap();
        let mut provenance = Provenance::new(WorldFromCanvas { scale: 0.01, origin });
        add(&mut plant, &mut provenance, &anatomy);
        assert_eq!(plant.check_invariants(), Ok(()));
        assert_eq!(provenance.check_invariants(&plant), Ok(()));
        (plant, provenance)
    }

    #[test]
    fn the_pot_stands_on_the_ground_as_large_as_drawn() {
        let (plant, provenance) = potted(vec![stem(0.0, 0.3)]);
        let [pot, soil] = &plant.organs[..] else { panic!("{} organs", plant.organs.len()) };
        assert_eq!(provenance.stroke(pot.origin), Some(7));
        let Shape::Lathe { base, profile, .. } = &pot.shape else { panic!("a pot is turned") };
        assert_eq!(*base, Vec3::ZERO);
        let (height, radius) = profile.iter().fold((0.0f32, 0.0f32), |(h, r), p| (h.max(p.y), r.max(p.x)));
        assert!((height - 0.4).abs() < 1e-4 && (radius - 0.22).abs() < 1e-4, "{height} {radius}");
        assert!(profile.windows(2).all(|pair| pair[0] != pair[1]) && profile.iter().all(|p| p.x >= 0.0));
        let Shape::Dome { base, radius, height, .. } = &soil.shape else { panic!("earth is a mound") };
        assert!(base.y > 0.3 && base.y + height < 0.4, "below the rim: {} {height}", base.y);
        assert!((0.18..0.21).contains(radius), "{radius}");
    }

    #[test]
    fn stems_over_the_mouth_are_led_into_the_earth_and_others_stay() {
        let (plant, _) = potted(vec![stem(0.05, 0.5), stem(0.05, 0.2), stem(0.4, 0.5)]);
        let feet: Vec<f32> = plant.branches.iter().map(|branch| branch.points[0].y).collect();
        assert!((0.3..0.36).contains(&feet[0]), "{}", feet[0]);
        assert_eq!(feet[1..], [0.2, 0.5]);
        assert_eq!(plant.branches[0].points.len(), plant.branches[0].radii.len());
    }
}
