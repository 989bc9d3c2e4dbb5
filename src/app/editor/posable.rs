//! Which part of the plant a pointer means, for the tool that poses parts.
//!
//! A leaf on a twig, say, is four things at once: the leaf, the twig, the bough and the trunk. What is hit comes first, then what
//! that stands on, down to the trunk: a tap chooses the first of them, another tap the next.

use super::Editor;
use crate::model::pick::Element;
use crate::modelling::{OrganGroup, PartFrame};
use crate::plant::{Branch, Origin, Shape};
use crate::sketch::PartName;
use glam::Vec3;

/// Length from which an organ is seen large, points.
const LARGE: f64 = 48.0;

/// A part that has a name.
pub(super) struct Posable<'a> {
    /// Where it begins, metres.
    pub(super) base: Vec3,
    /// What a new pose of it starts from.
    pub(super) frame: PartFrame,
    /// What it is.
    pub(super) part: Part<'a>,
}

/// What a part is.
pub(super) enum Part<'a> {
    /// A branch, as it was posed: a drawn one without what grew from it.
    Branch(&'a Branch),
    /// A leaf, a flower, a petal, a fruit or a pot.
    Organs(OrganGroup),
}

impl Editor {
    /// The part of a name; none where the plant has none.
    pub(super) fn posable(&self, name: PartName) -> Option<Posable<'_>> {
        let built = self.built()?;
        let (names, posed) = (&built.names, &built.wood.posed);
        let is_it = |branch: &&Branch| names.of(branch.origin) == Some(name);
        let drawn = built.wood.branches(&built.plant).map(|(_, branch)| branch).find(is_it);
        if let Some(branch) = drawn.or_else(|| built.plant.branches.iter().find(is_it)) {
            let base = *branch.points.first()?;
            return Some(Posable { base, frame: posed.frame(branch), part: Part::Branch(branch) });
        }
        let group = OrganGroup::all(&built.plant, names, |known| known == name).pop()?;
        let frame = group.frame(&built.plant, names, posed);
        Some(Posable { base: group.base, frame, part: Part::Organs(group) })
    }

    /// The names of what is hit and of all that carries it, down to the trunk; none of plants beside the drawn one.
    pub(super) fn parts_under(&self, hit: Element) -> Vec<PartName> {
        let Some(built) = self.built() else { return Vec::new() };
        if super::picking::place_of(hit, &built.beside).is_some() {
            return Vec::new();
        }
        let names = &built.names;
        let (mut parts, branch) = match hit {
            Element::Branch(branch) => (Vec::new(), Some(branch)),
            Element::Organ(index) => {
                let organ = &built.plant.organs[index];
                let flower = organ.flower.map(|flower| built.plant.flowers[flower].origin);
                let origins = flower.into_iter().chain([organ.origin]);
                (origins.filter_map(|origin| names.of(origin)).collect(), organ.branch)
            }
        };
        let down = std::iter::successors(branch, |branch| built.plant.branches[*branch].parent);
        parts.extend(down.filter_map(|branch| names.of(built.plant.branches[branch].origin)));
        parts.dedup();
        parts
    }

    /// Whether a drag on what is hit means the organ itself: one that somebody drew, or that is seen large, and not what carries
    /// it as on the leaves of a crown.
    pub(super) fn is_organ_meant(&self, hit: Element) -> bool {
        let (Element::Organ(index), Some(built)) = (hit, self.built()) else { return false };
        let organ = &built.plant.organs[index];
        let petals = || built.plant.organs.iter().filter(|petal| petal.flower == organ.flower);
        let is_drawn = organ.origin.is_drawn()
            || (organ.flower.is_some() && petals().any(|petal| petal.origin.is_drawn()));
        let length = match (organ.flower, &organ.shape) {
            (Some(flower), _) => built.plant.flowers[flower].reach,
            (None, Shape::Blade(blade)) => blade.v.length() * built.plant.templates[blade.template].length(),
            (None, _) => 0.0,
        };
        let seen = self.seen_length(organ.base(), length).unwrap_or(0.0);
        is_drawn || seen >= LARGE * self.plant.pixels_per_point()
    }

    /// The strokes that drew a part: those of the petals of a flower, or that of which a copy of another part has the name; none of what
    /// grew.
    pub(super) fn strokes_of(&self, name: PartName) -> Vec<u64> {
        let (Some(built), Some(Posable { part, .. })) = (self.built(), self.posable(name)) else {
            return Vec::new();
        };
        let stroke = |origin: Origin| built.provenance.stroke(origin);
        let mut strokes: Vec<u64> = match part {
            Part::Branch(branch) => stroke(branch.origin).into_iter().collect(),
            Part::Organs(group) => {
                group.organs.iter().filter_map(|organ| stroke(built.plant.organs[*organ].origin)).collect()
            }
        };
        if let (true, PartName::Stroke(stroke)) = (strokes.is_empty(), name) {
            strokes.push(stroke);
        }
        strokes.sort_unstable();
        strokes.dedup();
        strokes
    }
}
