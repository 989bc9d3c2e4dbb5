//! The union of lobes as a volume: inside of any that is added and of none that is taken away.
//!
//! What hangs together and how deep it is, is known by a raster of [`RASTER`] cells along the longest side: wood is led into every part
//! of it.
//!
//! Source: 001 §5.1 grows into several lobes and does not say what counts as inside. Limits: parts that hang together by less than
//! a cell count as separate; what is smaller than a cell as none.

use super::mesh_text::MeshError;
use super::solid::Solid;
use crate::lobes::Shaped;
use glam::Vec3;
use rayon::prelude::*;

/// Cells along the longest side of the raster.
const RASTER: usize = 64;
/// Share of a part's largest depth from which a place counts as well inside.
const WELL_INSIDE: f32 = 0.6;
/// Share of the whole below which a part counts as none, too small for a shoot.
const SPECK: f32 = 1e-3;

/// Lobes together.
#[derive(Debug)]
pub struct Lobes {
    added: Vec<Solid>,
    taken: Vec<Solid>,
    low: Vec3,
    high: Vec3,
    cell: f32,
    size: [usize; 3],
    /// The part of each cell, from 1; 0 outside.
    part_of_cell: Vec<u16>,
    parts: Vec<Part>,
    volume: f32,
}

/// A part of the union that hangs together.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Cubic metres, by the raster.
    pub volume: f32,
    /// Places well inside of it, each with its distance from the outside.
    pub places: Vec<(Vec3, f32)>,
}

impl Lobes {
    /// The union of lobes; without any that is added it is nowhere.
    ///
    /// # Errors
    /// A surface that is no volume; those that are shaped by [`crate::lobes::shape`] are.
    pub fn new(shaped: &[Shaped]) -> Result<Self, MeshError> {
        let (mut added, mut taken) = (Vec::new(), Vec::new());
        for lobe in shaped {
            let surface = &lobe.surface;
            let solid = Solid::new(surface.points.clone(), surface.triangles.clone(), &lobe.name)?;
            if lobe.negative { taken.push(solid) } else { added.push(solid) }
        }
        let bounds = added.iter().map(Solid::bounds);
        let (low, high) = bounds.reduce(|(l, h), (low, high)| (l.min(low), h.max(high))).unwrap_or_default();
        let cell = ((high - low).max_element() / RASTER as f32).max(f32::MIN_POSITIVE);
        let size = (high - low).to_array().map(|side| (side / cell).ceil() as usize + 2);
        let (part_of_cell, parts) = (Vec::new(), Vec::new());
        let mut lobes = Self { added, taken, low, high, cell, size, part_of_cell, parts, volume: 0.0 };
        lobes.find_parts();
        Ok(lobes)
    }

    /// Whether a point lies inside.
    pub fn contains(&self, p: Vec3) -> bool {
        self.added.iter().any(|solid| solid.contains(p)) && !self.taken.iter().any(|solid| solid.contains(p))
    }

    /// Smallest and largest corner.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        (self.low, self.high)
    }

    /// Cubic metres, by the raster.
    pub fn volume(&self) -> f32 {
        self.volume
    }

    /// Triangles that are asked about one point, at most.
    pub fn triangles_over_a_point(&self) -> u64 {
        self.added.iter().chain(&self.taken).map(Solid::triangles_over_a_point).sum()
    }

    /// What hangs together, in the order of the raster.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Length of a cell of the raster.
    pub fn cell(&self) -> f32 {
        self.cell
    }

    /// The part in which a point lies.
    pub fn part_at(&self, p: Vec3) -> Option<usize> {
        let q = (p - self.low) / self.cell + 1.0;
        let [w, h, d] = self.size;
        let size = Vec3::new(w as f32, h as f32, d as f32);
        if !(q.cmpge(Vec3::ZERO).all() && q.cmplt(size).all()) {
            return None;
        }
        let cell = (q.z as usize * h + q.y as usize) * w + q.x as usize;
        (self.part_of_cell[cell] as usize).checked_sub(1)
    }

    fn middle(&self, i: usize) -> Vec3 {
        let [w, h, _] = self.size;
        let at = [i % w, i / w % h, i / (w * h)].map(|k| k as f32 - 0.5);
        self.low + Vec3::from_array(at) * self.cell
    }

    /// The six cells beside one that is not on the rim.
    fn beside(&self, i: usize) -> [usize; 6] {
        let (w, layer) = (self.size[0], self.size[0] * self.size[1]);
        [i - 1, i + 1, i - w, i + w, i - layer, i + layer]
    }

    fn find_parts(&mut self) {
        let [w, h, d] = self.size;
        let is_rim = |i: usize| {
            let at = [i % w, i / w % h, i / (w * h)];
            at.iter().zip([w, h, d]).any(|(k, count)| *k == 0 || *k + 1 == count)
        };
        let this: &Self = self;
        let inside: Vec<bool> =
            (0..w * h * d).into_par_iter().map(|i| !is_rim(i) && this.contains(this.middle(i))).collect();
        let depth = self.depths(&inside);
        let cubic = self.cell.powi(3);
        self.volume = inside.iter().filter(|i| **i).count() as f32 * cubic;
        let (mut part_of_cell, mut parts) = (vec![0u16; inside.len()], Vec::new());
        for first in 0..inside.len() {
            if !inside[first] || part_of_cell[first] != 0 {
                continue;
            }
            let cells = self.spread(first, &inside, &mut part_of_cell);
            if cells.len() as f32 * cubic < SPECK * self.volume || parts.len() + 2 >= usize::from(u16::MAX) {
                continue;
            }
            let number = parts.len() as u16 + 1;
            cells.iter().for_each(|i| part_of_cell[*i] = number);
            let deepest = cells.iter().map(|i| depth[*i]).max().unwrap_or(1);
            let well = cells.iter().filter(|i| f32::from(depth[**i]) >= WELL_INSIDE * f32::from(deepest));
            let places = well.map(|i| (self.middle(*i), (f32::from(depth[*i]) - 0.5) * self.cell)).collect();
            parts.push(Part { volume: cells.len() as f32 * cubic, places });
        }
        part_of_cell.iter_mut().filter(|part| **part == u16::MAX).for_each(|part| *part = 0);
        (self.part_of_cell, self.parts) = (part_of_cell, parts);
    }

    /// The cells that hang together with one; all of them are marked as seen.
    fn spread(&self, first: usize, inside: &[bool], seen: &mut [u16]) -> Vec<usize> {
        let mut cells = vec![first];
        seen[first] = u16::MAX;
        let mut next = 0;
        while next < cells.len() {
            for near in self.beside(cells[next]) {
                if inside[near] && seen[near] == 0 {
                    seen[near] = u16::MAX;
                    cells.push(near);
                }
            }
            next += 1;
        }
        cells
    }

    /// Steps from each cell to the outside.
    fn depths(&self, inside: &[bool]) -> Vec<u16> {
        let mut depth: Vec<u16> = inside.iter().map(|i| if *i { u16::MAX } else { 0 }).collect();
        let on_edge = |i: &usize| inside[*i] && self.beside(*i).iter().any(|near| !inside[*near]);
        let mut front: Vec<usize> = (0..inside.len()).filter(on_edge).collect();
        front.iter().for_each(|i| depth[*i] = 1);
        let mut steps = 1;
        while !front.is_empty() {
            steps += 1;
            let mut further = Vec::new();
            for i in front {
                for near in self.beside(i) {
                    if inside[near] && depth[near] == u16::MAX {
                        depth[near] = steps;
                        further.push(near);
                    }
                }
            }
            front = further;
        }
        depth
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::lobes::{Lobe, Remesh, SpaceStroke, shape};
    use std::f32::consts::TAU;

    /// A ball, by its outline.
    pub(crate) fn ball(name: &str, middle: Vec3, radius: f32, negative: bool) -> Shaped {
        let at = |k: u32| {
            let (sin, cos) = (k as f32 / 60.0 * TAU).sin_cos();
            middle + Vec3::new(cos, sin, 0.0) * radius
        };
        let strokes = vec![SpaceStroke { closed: Some(true), points: (0..60).map(at).collect() }];
        let lobe = Lobe { name: name.to_owned(), strokes, negative, ..Lobe::default() };
        shape(&lobe, &Remesh { fineness: 20.0, ..Remesh::default() }).unwrap()
    }

    #[test]
    fn inside_of_any_and_of_none_that_is_taken_away() {
        let (left, right) = (Vec3::new(-2.0, 3.0, 0.0), Vec3::new(2.0, 3.0, 0.0));
        let lobes = Lobes::new(&[
            ball("a", left, 1.0, false),
            ball("b", right, 1.0, false),
            ball("c", right, 0.5, true),
        ]);
        let lobes = lobes.unwrap();
        assert!(lobes.contains(left) && !lobes.contains(right) && lobes.contains(right + Vec3::Y * 0.8));
        assert!(!lobes.contains(Vec3::Y * 3.0) && !lobes.contains(Vec3::NAN));
        assert_eq!(lobes.parts().len(), 2);
        assert_ne!(lobes.part_at(left), lobes.part_at(right + Vec3::Y * 0.8));
        assert!(lobes.part_at(left).is_some() && lobes.part_at(Vec3::Y).is_none());
        let expected = 4.0 / 3.0 * std::f32::consts::PI * (2.0 - 0.125);
        assert!((lobes.volume() / expected - 1.0).abs() < 0.08, "{} of {expected}", lobes.volume());
        for (place, depth) in lobes.parts().iter().flat_map(|part| &part.places) {
            assert!(lobes.contains(*place) && *depth > 0.0);
        }
    }

    #[test]
    fn without_anything_added_there_is_nowhere() {
        let none = Lobes::new(&[ball("c", Vec3::Y * 2.0, 1.0, true)]).unwrap();
        assert!(!none.contains(Vec3::Y * 2.0) && none.parts().is_empty());
        assert!(Lobes::new(&[]).unwrap().parts().is_empty());
    }
}
