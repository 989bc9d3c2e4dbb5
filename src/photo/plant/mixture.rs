//! What colours a thing has: a mixture of a few normal distributions in Lab.
//!
//! A first mixture is found by splitting: the part that is spread most is cut across its widest direction, at its mean
//! (Orchard and Bouman, *Color quantization of images*, 1991), so that no random start decides. It is fitted again by giving every
//! colour to the part under which it is likeliest, as in GrabCut (Rother, Kolmogorov and Blake 2004). Sums run in the
//! order of the pixels, in double precision: the same picture gives the same numbers.
//!
//! Limits: parts are never narrower than [`GRAIN`], so that a painted, even colour is no point of infinite density.

use super::super::lab::Lab;
use crate::geom::principal_axes::principal_axes;
use glam::{DMat3, DVec3, Mat3, Vec3};

/// Least spread of a part along any direction, ΔE.
const GRAIN: f64 = 1.5;
/// Colours by which the first mixture is found, at most about so many.
const SAMPLES: usize = 4096;

/// One normal distribution.
#[derive(Clone, Copy, Debug)]
struct Part {
    mean: Vec3,
    /// The inverse of its covariance.
    inverse: Mat3,
    /// What is the same for all colours of the cost: of its share and its volume.
    constant: f32,
}

impl Part {
    fn cost(&self, colour: Lab) -> f32 {
        let off = colour - self.mean;
        self.constant + 0.5 * off.dot(self.inverse * off)
    }
}

/// Sums over the colours of one part.
#[derive(Clone, Copy, Default)]
struct Sums {
    weight: f64,
    sum: DVec3,
    squares: DMat3,
}

impl Sums {
    fn add(&mut self, colour: Lab, weight: f32) {
        let (colour, weight) = (colour.as_dvec3(), f64::from(weight));
        let weighted = colour * weight;
        self.weight += weight;
        self.sum += weighted;
        self.squares += DMat3::from_cols(weighted * colour.x, weighted * colour.y, weighted * colour.z);
    }

    /// The distribution of this share of `total`; `None` of hardly any colours.
    fn part(&self, total: f64) -> Option<Part> {
        if self.weight < 4.0 {
            return None;
        }
        let mean = self.sum / self.weight;
        let outer = DMat3::from_cols(mean * mean.x, mean * mean.y, mean * mean.z);
        let covariance =
            self.squares * (1.0 / self.weight) - outer + DMat3::from_diagonal(DVec3::splat(GRAIN * GRAIN));
        let constant = 0.5 * covariance.determinant().max(1e-9).ln() - (self.weight / total).ln();
        Some(Part {
            mean: mean.as_vec3(),
            inverse: covariance.inverse().as_mat3(),
            constant: constant as f32,
        })
    }
}

/// The colours of a thing.
#[derive(Clone, Debug)]
pub(super) struct Mixture(Vec<Part>);

impl Mixture {
    /// The mixture of colours, each with how much it counts, of at most so many distributions; `None` of too few.
    pub(super) fn of(colours: &[(Lab, f32)], most: usize) -> Option<Self> {
        let sampled: Vec<(Lab, f32)> =
            colours.iter().step_by((colours.len() / SAMPLES).max(1)).copied().collect();
        let mut groups = vec![sampled];
        while groups.len() < most {
            let spread = |group: &Vec<(Lab, f32)>| spread(group);
            let widest =
                (0..groups.len()).max_by(|a, b| spread(&groups[*a]).total_cmp(&spread(&groups[*b])))?;
            let Some((low, high)) = halves(&groups[widest]) else { break };
            groups[widest] = low;
            groups.push(high);
        }
        let sums = groups.iter().map(|group| {
            let mut sums = Sums::default();
            group.iter().for_each(|(colour, weight)| sums.add(*colour, *weight));
            sums
        });
        let first = Self::from_sums(&sums.collect::<Vec<_>>())?;
        Some(first.fitted(colours).unwrap_or(first))
    }

    fn from_sums(sums: &[Sums]) -> Option<Self> {
        let total = sums.iter().map(|sums| sums.weight).sum();
        let parts: Vec<Part> = sums.iter().filter_map(|sums| sums.part(total)).collect();
        (!parts.is_empty()).then_some(Self(parts))
    }

    /// The same parts, moved to the colours that are theirs; `None` of too few.
    pub(super) fn fitted(&self, colours: &[(Lab, f32)]) -> Option<Self> {
        let mut sums = vec![Sums::default(); self.0.len()];
        colours.iter().for_each(|(colour, weight)| sums[self.likeliest(*colour)].add(*colour, *weight));
        Self::from_sums(&sums)
    }

    fn likeliest(&self, colour: Lab) -> usize {
        let cost = |k: usize| self.0[k].cost(colour);
        (1..self.0.len()).fold(0, |best, k| if cost(k) < cost(best) { k } else { best })
    }

    /// How unlikely a colour is: minus the logarithm of its density, up to a constant that all mixtures share.
    pub(super) fn cost(&self, colour: Lab) -> f32 {
        self.0.iter().map(|part| part.cost(colour)).fold(f32::INFINITY, f32::min)
    }
}

/// How much a group is spread in all, by its weight.
fn spread(group: &[(Lab, f32)]) -> f32 {
    let weight: f32 = group.iter().map(|(_, weight)| weight).sum();
    let mean =
        group.iter().map(|(colour, weight)| colour * *weight).sum::<Vec3>() / weight.max(f32::MIN_POSITIVE);
    group.iter().map(|(colour, weight)| weight * colour.distance_squared(mean)).sum()
}

/// Colours with how much each counts.
type Group = Vec<(Lab, f32)>;

/// A group in two, across its widest direction; `None` where all of it is one colour.
fn halves(group: &[(Lab, f32)]) -> Option<(Group, Group)> {
    let colours: Vec<Vec3> = group.iter().map(|(colour, _)| *colour).collect();
    let (middle, [along, ..]) = principal_axes(&colours);
    let (low, high): (Vec<_>, Vec<_>) =
        group.iter().partition(|(colour, _)| (colour - middle).dot(along) < 0.0);
    (low.len() > 4 && high.len() > 4).then_some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_of_a_thing_are_likelier_than_others() {
        let colour = |k: usize| {
            let grain = Vec3::new((k % 7) as f32 - 3.0, (k % 5) as f32 - 2.0, (k % 3) as f32 - 1.0);
            [Vec3::new(30.0, -20.0, 25.0), Vec3::new(70.0, 5.0, -20.0)][k % 2] + grain
        };
        let colours: Vec<(Lab, f32)> = (0..1000).map(|k| (colour(k), 1.0)).collect();
        let mixture = Mixture::of(&colours, 5).unwrap();
        let cost = |l, a, b| mixture.cost(Vec3::new(l, a, b));
        assert!(cost(30.0, -20.0, 25.0) < 8.0 && cost(70.0, 5.0, -20.0) < 8.0);
        assert!(cost(50.0, -8.0, 3.0) > 20.0, "what lies between is neither");
        assert!(Mixture::of(&colours[..2], 5).is_none());
    }

    #[test]
    fn one_even_colour_is_a_narrow_part() {
        let mixture = Mixture::of(&[(Vec3::new(50.0, 0.0, 0.0), 1.0); 50], 5).unwrap();
        assert!(mixture.cost(Vec3::new(50.0, 0.0, 0.0)) + 10.0 < mixture.cost(Vec3::new(60.0, 0.0, 0.0)));
    }
}
