//! How finely receptacles, fruits, anthers and pots are made: by their size, and by how many there are.
//!
//! A tree has thousands of cherries of which none is seen by itself; with the sides of a single one they would have most of its triangles.
//! Bodies are counted in crowds: small domes and heads of filaments together, everything lathed or large with those of its own
//! part, so that a pot beside a thousand apples stays round. Of more than so many each has half, of very many a quarter of the sides and
//! rows, and its profile keeps the few points that enclose the most. Stalks of very many are straight.
//!
//! Limits: how near a body is seen is not known here; whoever wants fruits finer sets their sides.

use crate::plant::{Organ, OrganPart, Plant, Shape};
use glam::Vec2;

crate::parameters! {
    /// How finely receptacles, fruits and pots are modelled.
    pub struct SolidParams {
        /// Sides of domes, fruits and pots; large ones have 8 at least.
        sides: u32 = 14, 3..=128, "";
        /// Rows of a dome between edge and top.
        dome_rows: u32 = 4, 1..=64, "";
        /// Sides of filaments.
        filament_sides: u32 = 3, 3..=16, "";
        /// Sides of anthers and stigmas.
        head_sides: u32 = 5, 3..=32, "";
        /// Rows of anthers and stigmas from pole to pole.
        head_rows: u32 = 3, 2..=32, "";
    }
}

/// Bodies of this radius and more, metres, have at least so many sides: with fewer the disc of a sunflower is seen as a polygon, while a
/// coarse plant may have hundreds of florets whose receptacles need none.
const LARGE: (f32, u32) = (12e-3, 8);
/// Of more bodies and heads than these smaller ones have half, then a quarter as many sides and rows: a tree in blossom has a receptacle
/// and anthers for each of its thousands of flowers, of which none is seen by itself.
const MANY: [usize; 2] = [1000, 2000];
/// The same for lathed or large ones of one kind, cherries and cones: a pot beside them is not of their kind.
const MANY_OF_A_KIND: [usize; 2] = [250, 2000];
/// Most points of a profile, with its ends, of half and of a quarter of the sides.
const PROFILE: [usize; 2] = [6, 4];
/// How finely a body is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Fineness {
    /// One of very many.
    Quarter,
    /// One of many.
    Half,
    /// As the parameters say.
    Whole,
    /// Large: with more sides at least.
    Large,
}

impl Fineness {
    /// How many sides, rows, or other parts there are, of so many usual ones.
    fn of(self, usual: u32, fewest: u32) -> u32 {
        let share = match self {
            Self::Quarter => 4,
            Self::Half => 2,
            Self::Whole | Self::Large => return usual,
        };
        usual.div_ceil(share).max(fewest).min(usual)
    }

    /// Sides of domes and lathed bodies.
    pub(super) fn sides(self, params: &SolidParams) -> u32 {
        match self {
            Self::Large => params.sides.max(LARGE.1),
            Self::Whole | Self::Half => self.of(params.sides, 5),
            Self::Quarter => self.of(params.sides, 4),
        }
    }

    /// A profile of so many points at most that enclose the most.
    pub(super) fn profile(self, mut profile: Vec<Vec2>) -> Vec<Vec2> {
        let most = match self {
            Self::Quarter => PROFILE[1],
            Self::Half => PROFILE[0],
            Self::Whole | Self::Large => return profile,
        };
        let enclosed = |w: &[Vec2]| (w[1] - w[0]).perp_dot(w[2] - w[0]).abs();
        while profile.len() > most {
            let least = profile.windows(3).map(enclosed).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            let Some((before, _)) = least else { break };
            profile.remove(before + 1);
        }
        profile
    }

    /// Rows of domes.
    pub(super) fn dome_rows(self, params: &SolidParams) -> u32 {
        self.of(params.dome_rows, 2)
    }

    /// Sides and rows of heads.
    pub(super) fn head(self, params: &SolidParams) -> [u32; 2] {
        [self.of(params.head_sides, 3), self.of(params.head_rows, 2)]
    }
}

/// How finely the bodies of a plant are made, by how large they are and how many there are.
#[derive(Clone, Debug, Default)]
pub(super) struct Finenesses {
    /// Small domes, and filaments with heads.
    small: usize,
    /// Filaments without heads.
    bare: usize,
    /// Lathed and large bodies of each part.
    of_a_kind: Vec<(OrganPart, usize)>,
}

/// What a body is counted with.
enum Crowd {
    Small,
    Bare,
    /// Those of its part, and whether it is large.
    OfAKind(bool),
}

impl Finenesses {
    pub(super) fn of(plant: &Plant) -> Self {
        let mut counts = Self::default();
        for organ in &plant.organs {
            let part = organ.role.part;
            match crowd(&organ.shape) {
                None => {}
                Some(Crowd::Small) => counts.small += 1,
                Some(Crowd::Bare) => counts.bare += 1,
                Some(Crowd::OfAKind(_)) => match counts.of_a_kind.iter_mut().find(|(of, _)| *of == part) {
                    Some((_, count)) => *count += 1,
                    None => counts.of_a_kind.push((part, 1)),
                },
            }
        }
        counts
    }

    /// That of an organ's body, of a filament and its head.
    pub(super) fn at(&self, organ: &Organ) -> Fineness {
        let of_a_kind = || self.of_a_kind.iter().find(|(part, _)| *part == organ.role.part);
        let (count, [many, very_many], usual) = match crowd(&organ.shape) {
            None => return Fineness::Whole,
            Some(Crowd::Small) => (self.small, MANY, Fineness::Whole),
            Some(Crowd::Bare) => (self.bare, MANY, Fineness::Whole),
            Some(Crowd::OfAKind(is_large)) => {
                let usual = if is_large { Fineness::Large } else { Fineness::Whole };
                (of_a_kind().map_or(0, |(_, count)| *count), MANY_OF_A_KIND, usual)
            }
        };
        match count {
            count if count > very_many => Fineness::Quarter,
            count if count > many => Fineness::Half,
            _ => usual,
        }
    }
}

/// What a body is counted with; `None` of what is none.
fn crowd(shape: &Shape) -> Option<Crowd> {
    match shape {
        Shape::Dome { radius, .. } if *radius < LARGE.0 => Some(Crowd::Small),
        Shape::Dome { .. } => Some(Crowd::OfAKind(true)),
        Shape::Lathe { profile, .. } => Some(Crowd::OfAKind(widest(profile) >= LARGE.0)),
        Shape::Filament { head, .. } if head.x > 0.0 => Some(Crowd::Small),
        Shape::Filament { .. } => Some(Crowd::Bare),
        Shape::Blade(_) | Shape::Card { .. } | Shape::Spike { .. } => None,
    }
}

/// The largest radius of a profile.
pub(super) fn widest(profile: &[Vec2]) -> f32 {
    profile.iter().map(|point| point.x.abs()).fold(0.0, f32::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Origin, Role};
    use glam::Vec3;

    fn fruits(count: usize) -> Plant {
        let profile = [(0.0, 0.0), (0.6, 0.1), (1.0, 0.8), (0.9, 1.2), (0.5, 1.6), (0.2, 1.8), (0.0, 1.9)];
        let lathe = |size: f32| Shape::Lathe {
            base: Vec3::ZERO,
            axis: Vec3::Y,
            profile: profile.iter().map(|p| Vec2::from(*p) * size).collect(),
        };
        let organ = |part, shape| Organ {
            role: Role::of(part),
            origin: Origin::Generated,
            branch: None,
            flower: None,
            shape,
        };
        let fruit = organ(OrganPart::Fruit, lathe(0.04));
        let pot = organ(OrganPart::Pot, lathe(0.2));
        let organs = std::iter::repeat_n(fruit, count).chain([pot]).collect();
        Plant { organs, ..Plant::default() }
    }

    #[test]
    fn of_very_many_fruits_each_is_light_and_the_pot_beside_them_is_round() {
        let params = SolidParams::default();
        let mut last = usize::MAX;
        for count in [1, MANY_OF_A_KIND[0] + 1, MANY_OF_A_KIND[1] + 1] {
            let plant = fruits(count);
            let finenesses = Finenesses::of(&plant);
            let size = |organ: &Organ| {
                let Shape::Lathe { profile, .. } = &organ.shape else { panic!("a lathed body") };
                let fineness = finenesses.at(organ);
                fineness.sides(&params) as usize * fineness.profile(profile.clone()).len()
            };
            let (fruit, pot) = (size(&plant.organs[0]), size(&plant.organs[count]));
            assert!(2 * fruit <= last, "{fruit} after {last}");
            last = fruit;
            assert_eq!(pot, 14 * 7);
        }
        assert_eq!(last, 4 * 4);
    }
}
