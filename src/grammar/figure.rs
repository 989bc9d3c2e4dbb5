//! What a grammar draws: stems and the organs on them, as plain data.

use glam::Vec3;
use std::sync::Arc;

/// Stems and organs in metres. The turtle starts at the origin, looking up (+y), with its upper side to the viewer (+z).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// Stems, parents before those that grow on them.
    pub stems: Vec<Stem>,
    /// Organs and solids, in the order in which the turtle comes to them.
    pub items: Vec<Item>,
}

/// A stem: segments that the turtle drew one after another.
#[derive(Clone, Debug, PartialEq)]
pub struct Stem {
    /// The stem that it grows on, always one before it.
    pub parent: Option<usize>,
    /// Its skeleton, foot first: at least two points, no two consecutive ones equal.
    pub points: Vec<Vec3>,
    /// Radius at each point, positive.
    pub radii: Vec<f32>,
}

/// An organ, or a solid, where the turtle placed it.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// The organ's name; `@ball` or `@cylinder` for a solid.
    pub name: Arc<str>,
    /// Its arguments as they were written. Lengths among them become metres by `scale`: radius of a ball, radius and length
    /// of a cylinder that goes from `origin` along `heading`.
    pub args: Vec<f32>,
    /// The stem that it stands on: the one that was drawn last before it, in its bracket or around it.
    pub stem: Option<usize>,
    /// Where the turtle is.
    pub origin: Vec3,
    /// Where it looks.
    pub heading: Vec3,
    /// The turtle's left.
    pub left: Vec3,
    /// Its upper side; heading × left.
    pub up: Vec3,
    /// The product of all scales that hold here.
    pub scale: f32,
    /// Its name for streams of random numbers: the path by which the rules came to it, whatever the seed.
    pub key: u64,
}

impl Figure {
    /// Checks order, numbers and frames.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self) -> Result<(), String> {
        for (i, stem) in self.stems.iter().enumerate() {
            let here = |what: &str| Err(format!("stem {i}: {what}"));
            match stem {
                _ if stem.parent.is_some_and(|parent| parent >= i) => return here("parent stands after it"),
                _ if stem.points.len() < 2 => return here("fewer than two points"),
                _ if stem.points.len() != stem.radii.len() => {
                    return here("points and radii differ in number");
                }
                _ if !stem.points.iter().all(|p| p.is_finite()) => return here("point not finite"),
                _ if stem.points.windows(2).any(|w| w[0] == w[1]) => return here("repeated point"),
                _ if !stem.radii.iter().all(|r| r.is_finite() && *r > 0.0) => {
                    return here("radius not positive");
                }
                _ => {}
            }
        }
        for (i, item) in self.items.iter().enumerate() {
            let here = |what: &str| Err(format!("item {i}: {what}"));
            let axes = [item.heading, item.left, item.up];
            let is_square = axes.iter().all(|axis| axis.is_normalized())
                && item.heading.cross(item.left).abs_diff_eq(item.up, 1e-4);
            match item {
                _ if item.stem.is_some_and(|stem| stem >= self.stems.len()) => {
                    return here("stem out of range");
                }
                _ if !item.origin.is_finite() || !is_square => return here("frame"),
                _ if !item.args.iter().all(|a| a.is_finite()) => return here("argument not finite"),
                _ if !(item.scale.is_finite() && item.scale > 0.0) => return here("scale not positive"),
                _ => {}
            }
        }
        Ok(())
    }
}
