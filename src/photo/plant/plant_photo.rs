//! A plant from a photograph, step by step: scaled down, found, chosen among others, outlined, taken apart, its colours.
//!
//! What depends on the photograph alone is made once ([`PlantPicture`]), so that a window can find the plant again after every mark.
//!
//! Limits: as those of the steps; a photograph has at least [`LEAST_SIDE`] pixels each way.

use super::super::error::{PhotoError, PhotoRemark};
use super::super::lab::{Lab, lab_of};
use super::super::raster::Raster;
use super::super::shrink::shrunk;
use super::edges::Edges;
use super::loops::{Loop, loops};
use super::marks::{self, Known, Marks};
use super::parts::{Parts, TrunkLine, parts};
use super::regions::{chosen, narrowed, widened};
use super::tint::{PlantColours, colours};
use super::{PlantParams, SnapParams, segment, snap};
use crate::geom::polyline;
use crate::picture::decode::Rgba;
use glam::{UVec2, Vec2};

/// Least width and height of a photograph.
const LEAST_SIDE: u32 = 16;
/// Shares of a photograph between which a plant is believed, percent.
const BELIEVED: (f32, f32) = (1.0, 95.0);
/// Share of a photograph that is transparent from which its alpha says where the plant is.
const TRANSPARENT: f32 = 0.005;
/// Least contrast between a plant and its surroundings, nats.
const CONTRAST: f32 = 2.0;
/// Least part of a crown that gets an outline of its own, as a share of the plant's area.
const LEAST_LOOP: f32 = 0.004;
/// Half the width of what is too thin to be foliage, as a share of the crown's size.
const THIN: f32 = 0.012;
/// Share of a crown that foliage takes at least.
const MOSTLY: f32 = 0.7;
/// Width of a trunk whose sides are not seen, as a share of its length.
const USUAL_WIDTH: f32 = 0.08;
/// Distance to the rim within which pixels may show surroundings, pixels of the grid.
const RIM: usize = 1;

/// A photograph, made ready to find plants on it.
#[derive(Clone, Debug)]
pub struct PlantPicture {
    size: UVec2,
    factor: u32,
    lab: Raster<Lab>,
    /// Where alpha says that something is.
    alpha: Option<Raster<bool>>,
    edges: Edges,
}

/// A plant that was found on a photograph. Places are in pixels of the photograph, x right, y down.
#[derive(Clone, Debug)]
pub struct PlantPhoto {
    /// Width and height of the photograph.
    pub size: UVec2,
    /// Outlines of all of the plant, largest first.
    pub outline: Vec<Loop>,
    /// Outlines of its crown, largest first.
    pub crown: Vec<Loop>,
    /// Its trunk, from the foot into the crown.
    pub trunk: Option<TrunkLine>,
    /// Its colours.
    pub colours: PlantColours,
    /// Share of the photograph that is plant, percent.
    pub share: f32,
    /// What is odd about it.
    pub remarks: Vec<PhotoRemark>,
    mask: Raster<bool>,
    factor: u32,
}

impl PlantPicture {
    /// Makes a photograph ready.
    ///
    /// # Errors
    /// One of too few pixels.
    pub fn new(photograph: &Rgba, params: &PlantParams) -> Result<Self, PhotoError> {
        let size = UVec2::new(photograph.width, photograph.height);
        if size.min_element() < LEAST_SIDE {
            return Err(PhotoError::TooSmall { width: size.x, height: size.y, least: LEAST_SIDE });
        }
        let (small, factor) = shrunk(photograph, params.side);
        let lab = lab_of(&small);
        let alpha = small.pixels.as_chunks::<4>().0.iter().map(|pixel| pixel[3] >= 128);
        let alpha = Raster::new(lab.width(), alpha.collect::<Vec<bool>>());
        let open = alpha.cells().iter().filter(|is_in| !**is_in).count() as f32;
        let alpha = (open > TRANSPARENT * alpha.cells().len() as f32).then_some(alpha);
        let edges = Edges::of(&lab);
        Ok(Self { size, factor, lab, alpha, edges })
    }

    /// Width and height of the photograph in pixels.
    pub fn size_px(&self) -> UVec2 {
        self.size
    }

    /// Finds the plant.
    ///
    /// # Errors
    /// A photograph on which none is found, or that is nothing but plant.
    pub fn find(&self, marks: &Marks, params: &PlantParams) -> Result<PlantPhoto, PhotoError> {
        let known = marks::known(marks, (self.lab.size(), self.factor), params);
        let found = self.found(&known, marks.is_empty(), params)?;
        let is_marked = |i: usize| known.is_marked.cells()[i] && known.is_plant.cells()[i] == Some(true);
        let nothing = PhotoError::NoPlant { share: 0.0, least: BELIEVED.0 };
        let plant = chosen(&found, is_marked, params).ok_or_else(|| nothing.clone())?;
        let area = plant.mask.cells().iter().filter(|is_in| **is_in).count() as f32;
        let share = 100.0 * area / plant.mask.cells().len() as f32;
        if share < BELIEVED.0 {
            return Err(PhotoError::NoPlant { share, least: BELIEVED.0 });
        }
        if share > BELIEVED.1 {
            return Err(PhotoError::AllPlant { share, most: BELIEVED.1 });
        }
        let Parts { crown, trunk_mask, trunk } = parts(&plant.mask, params);
        let colours = colours(&self.lab, &inner(&crown), &inner(&trunk_mask)).ok_or(nothing)?;
        let tolerance = params.tolerance * extent(&plant.mask);
        let outlined = |mask: &Raster<bool>| self.outlined(mask, LEAST_LOOP * area, tolerance);
        let mut remarks = Vec::new();
        if plant.count > 1 && !plant.is_marked {
            remarks.push(PhotoRemark::SeveralPlants { count: plant.count });
        }
        Ok(PlantPhoto {
            size: self.size,
            outline: outlined(&plant.mask),
            crown: outlined(&bodies(&crown)),
            trunk: trunk.map(|trunk| trunk.scaled(self.factor as f32)),
            colours,
            share,
            remarks,
            mask: plant.mask,
            factor: self.factor,
        })
    }

    /// Moves a trunk that was drawn over the photograph onto the edges on both of its sides; `None` where they are not seen.
    pub fn snapped(&self, line: &[Vec2], params: &SnapParams) -> Option<TrunkLine> {
        let scale = 1.0 / self.factor as f32;
        let line: Vec<Vec2> = line.iter().map(|p| *p * scale).collect();
        Some(snap::snapped(&self.edges, &line, params)?.scaled(self.factor as f32))
    }

    /// Gives a plant the trunk that was drawn, moved onto its edges, or as it was drawn where they are not seen.
    pub fn give_trunk(&self, plant: &mut PlantPhoto, line: &[Vec2], params: &SnapParams) {
        let trunk = self.snapped(line, params).unwrap_or_else(|| {
            plant.remarks.push(PhotoRemark::TrunkAsDrawn);
            let usual = plant.trunk.as_ref().map(TrunkLine::usual_width);
            let width = usual.unwrap_or(USUAL_WIDTH * polyline::length(line));
            TrunkLine { points: line.to_vec(), widths: vec![width; line.len()] }
        });
        plant.trunk = Some(trunk);
    }

    /// What has the plant's colours, or what alpha says.
    fn found(
        &self,
        known: &Known,
        is_unmarked: bool,
        params: &PlantParams,
    ) -> Result<Raster<bool>, PhotoError> {
        if let Some(alpha) = &self.alpha {
            let mut found = alpha.clone();
            for (i, cell) in found.cells_mut().iter_mut().enumerate() {
                *cell &= !known.is_outside[i];
            }
            return Ok(found);
        }
        let found = segment::plant(&self.lab, known, params);
        let found = found.ok_or(PhotoError::NoPlant { share: 0.0, least: BELIEVED.0 })?;
        // Whoever marks a plant sees one.
        if is_unmarked && found.contrast < CONTRAST {
            return Err(PhotoError::SameColours);
        }
        Ok(found.mask)
    }

    fn outlined(&self, mask: &Raster<bool>, least: f32, tolerance: f32) -> Vec<Loop> {
        let mut found = loops(mask, least, tolerance);
        for place in found.iter_mut().flat_map(|line| &mut line.points) {
            *place = (*place * self.factor as f32).min(self.size.as_vec2());
        }
        found
    }
}

impl PlantPhoto {
    /// Finds the plant on a photograph.
    ///
    /// # Errors
    /// As [`PlantPicture::new`] and [`PlantPicture::find`].
    pub fn of_photograph(photograph: &Rgba, marks: &Marks, params: &PlantParams) -> Result<Self, PhotoError> {
        PlantPicture::new(photograph, params)?.find(marks, params)
    }

    /// Whether a pixel of the photograph belongs to the plant.
    pub fn contains(&self, x: u32, y: u32) -> bool {
        self.mask[((x / self.factor) as usize, (y / self.factor) as usize)]
    }

    /// The mask as a picture of the photograph's size: the plant white, all else black.
    pub fn mask_picture(&self) -> Rgba {
        let UVec2 { x: width, y: height } = self.size;
        let pixel = |i: u32| if self.contains(i % width, i / width) { [255; 4] } else { [0, 0, 0, 255] };
        Rgba { width, height, pixels: (0..width * height).flat_map(pixel).collect() }
    }
}

/// A crown without what is thin: single branches below and beside foliage. Where all of it is thin, all of it.
fn bodies(crown: &Raster<bool>) -> Raster<bool> {
    let reach = (THIN * extent(crown)).round().max(1.0) as usize;
    // What hangs on a body keeps its own shape near it.
    let near = widened(&narrowed(crown, reach), reach + 2);
    let bodies =
        Raster::new(crown.width(), near.cells().iter().zip(crown.cells()).map(|(a, b)| *a && *b).collect());
    let count = |mask: &Raster<bool>| mask.cells().iter().filter(|is_in| **is_in).count() as f32;
    if count(&bodies) >= MOSTLY * count(crown) { bodies } else { crown.clone() }
}

/// A mask without its rim, where that leaves anything.
fn inner(mask: &Raster<bool>) -> Raster<bool> {
    let inner = narrowed(mask, RIM);
    if inner.cells().contains(&true) { inner } else { mask.clone() }
}

/// The longer side of what a mask holds, pixels.
fn extent(mask: &Raster<bool>) -> f32 {
    let places = (0..mask.cells().len()).filter(|i| mask.cells()[*i]).map(|i| mask.middle(i));
    let (low, high) = polyline::bounds(places);
    (high - low).max_element().max(0.0)
}

#[cfg(test)]
#[path = "plant_photo_tests.rs"]
mod tests;
