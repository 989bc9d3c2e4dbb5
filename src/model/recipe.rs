//! What the mesh of a part depends on, written down: two parts with equal recipes have equal meshes.
//!
//! A recipe is a row of words: what kind of part it is, then the bits of every number that its meshing reads, lists with
//! their lengths first. Names, parents, materials and places in a list are left out, for they do not shape a mesh; nor
//! are parameters in it, for they are the same for the whole plant. Structures are taken apart by all their fields, so
//! that the compiler asks about a new one. A blade of a template names the template's triangulation instead of telling
//! its outline; any other blade's outline is known by its address, for stages before keep what they made, too. Whoever keeps
//! a recipe holds these outlines, so that nothing else comes to lie there.

use super::limbs::Twig;
use super::piece::Piece;
use crate::plant::{Blade, Branch, Cone, RestSurface, Shape};
use crate::random::mix;
use glam::{Vec2, Vec3};
use std::sync::Arc;

/// A row of words, used again for every part.
#[derive(Debug, Default)]
pub(super) struct Recipe {
    words: Vec<u32>,
    /// Outlines that are named by their addresses.
    outlines: Vec<Arc<[Vec2]>>,
}

/// A recipe that is kept.
#[derive(Debug)]
pub(super) struct WrittenRecipe {
    words: Box<[u32]>,
    _outlines: Box<[Arc<[Vec2]>]>,
}

impl PartialEq for WrittenRecipe {
    fn eq(&self, other: &Self) -> bool {
        self.words == other.words
    }
}

impl Recipe {
    /// Begins anew with the kind of part.
    fn begin(&mut self, kind: u32) -> &mut Self {
        self.words.clear();
        self.outlines.clear();
        self.word(kind)
    }

    /// The recipe of branches that are one surface and whose tolerances are shares of `unit` metres.
    pub(super) fn wood<'a>(&mut self, twigs: impl Iterator<Item = Twig<'a>>, unit: f32) {
        self.begin(0).real(unit);
        for Twig { branch, parent, slot } in twigs {
            self.word(parent.map_or(u32::MAX, |parent| parent as u32)).length(slot).limb(branch);
        }
    }

    /// The recipe of the outline and the length that blades of one template have in common.
    pub(super) fn template(&mut self, blade: &Blade) {
        self.begin(1).real(blade.length).outline(blade);
    }

    /// The recipe of the shape of a blade that stands at the origin, by the name of its triangulation.
    pub(super) fn shape(&mut self, standing: &Blade, template: u64) {
        self.begin(3).blade(standing, Some(template));
    }

    /// The recipe of pieces of organs that are one part, a group for each material; blades come with the name of their
    /// triangulation where that is shared.
    pub(super) fn organs<'a, Group>(&mut self, groups: impl Iterator<Item = Group>)
    where
        Group: Iterator<Item = (&'a Shape, Piece, Option<u64>)>,
    {
        self.begin(2);
        let mut slots = 0;
        for (slot, pieces) in groups.enumerate() {
            slots = slot + 1;
            for (shape, piece, template) in pieces {
                self.length(slot).word(u32::from(piece == Piece::Head));
                match shape {
                    Shape::Blade(blade) => self.blade(blade, template),
                    solid => self.solid(solid),
                };
            }
        }
        // A mesh tells where each material begins, also of those that only copies have.
        self.length(slots);
    }

    /// The recipe, to be kept.
    pub(super) fn written(&self) -> WrittenRecipe {
        WrittenRecipe { words: self.words.as_slice().into(), _outlines: self.outlines.as_slice().into() }
    }

    /// Whether a recipe that is kept says the same.
    pub(super) fn is(&self, kept: &WrittenRecipe) -> bool {
        *self.words == *kept.words
    }

    /// A number that tells nearly all recipes apart.
    pub(super) fn hash(&self) -> u64 {
        let pairs =
            self.words.chunks(2).map(|pair| u64::from(pair[0]) << 32 | pair.get(1).map_or(0, |&w| w.into()));
        pairs.fold(self.words.len() as u64, mix)
    }

    fn limb(&mut self, branch: &Branch) -> &mut Self {
        let Branch { origin: _, parent: _, level: _, points, radii, role: _ } = branch;
        self.points(points).length(radii.len());
        self.words.extend(radii.iter().map(|radius| radius.to_bits()));
        self
    }

    fn outline(&mut self, blade: &Blade) -> &mut Self {
        self.plane(&blade.outline).curl(&blade.curl)
    }

    fn curl(&mut self, curl: &[f32]) -> &mut Self {
        self.length(curl.len());
        self.words.extend(curl.iter().map(|curl| curl.to_bits()));
        self
    }

    fn address(&mut self, outline: &Arc<[Vec2]>) -> &mut Self {
        let address = outline.as_ptr().addr() as u64;
        self.outlines.push(Arc::clone(outline));
        self.word(address as u32).word((address >> 32) as u32).length(outline.len())
    }

    fn blade(&mut self, blade: &Blade, template: Option<u64>) -> &mut Self {
        let Blade { outline: _, curl: _, base, u, v, length, rest, form, template: _ } = blade;
        match template {
            Some(name) => self.word(4).word(name as u32).word((name >> 32) as u32),
            None => self.word(5).address(&blade.outline).curl(&blade.curl),
        };
        self.point(*base).point(*u).point(*v).real(*length);
        match rest {
            RestSurface::Plane => self.word(0),
            RestSurface::Cone { cone, hint } => {
                let Cone { apex, axis, opening_rad, height } = cone;
                self.word(1).point(*apex).point(*axis).real(*opening_rad).real(*height).real(*hint)
            }
        };
        self.words.extend(form.to_row().map(f32::to_bits));
        self
    }

    fn solid(&mut self, shape: &Shape) -> &mut Self {
        match shape {
            // Blades need to know their triangulation.
            Shape::Blade(_) => self.word(0),
            Shape::Dome { base, axis, radius, height } => {
                self.word(1).point(*base).point(*axis).real(*radius).real(*height)
            }
            Shape::Filament { points, radius, head } => {
                self.word(2).points(points).real(*radius).real(head.x).real(head.y)
            }
            Shape::Lathe { base, axis, profile } => self.word(3).point(*base).point(*axis).plane(profile),
        }
    }

    fn word(&mut self, word: u32) -> &mut Self {
        self.words.push(word);
        self
    }

    fn length(&mut self, count: usize) -> &mut Self {
        self.word(count as u32)
    }

    fn real(&mut self, value: f32) -> &mut Self {
        self.word(value.to_bits())
    }

    fn point(&mut self, point: Vec3) -> &mut Self {
        self.words.extend(point.to_array().map(f32::to_bits));
        self
    }

    fn points(&mut self, points: &[Vec3]) -> &mut Self {
        self.length(points.len());
        self.words.extend(points.iter().flat_map(|p| p.to_array().map(f32::to_bits)));
        self
    }

    fn plane(&mut self, points: &[Vec2]) -> &mut Self {
        self.length(points.len());
        self.words.extend(points.iter().flat_map(|p| p.to_array().map(f32::to_bits)));
        self
    }
}
