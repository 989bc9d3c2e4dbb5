//! A petal or leaf from a photograph: outline and texture.
//!
//! ```text
//! photograph ─► smaller ─► distance from the border's colour, Otsu ─► largest region ─► coverage ─► contour ─┐
//!               alpha, where there is any, is the coverage ──────────────────────────────────────►            │
//! texture ◄─ painted in the blade's own UV ◄─ cleaned ◄─ upright in the blade's plane ◄─ base and tip ◄───────┘
//! ```
//!
//! Under a traced stroke the stroke is the contour, and base and tip are those that its reading has.

use super::background::{self, CutoutParams};
use super::clean::{self, Cleaned};
use super::contour;
use super::coverage::{coverage, shrunk as mask_shrunk};
use super::ends;
use super::error::{PhotoError, PhotoRemark};
use super::lab::{Lab, lab_of};
use super::mask::{Largest, largest_region, share_on_edge};
use super::raster::Raster;
use super::shrink::shrunk;
use super::texture::{self, Source};
use super::windows::{window_max, window_means};
use super::{PhotoParams, polygon};
use crate::geom::polyline::bounds;
use crate::geom::simple_loop;
use crate::model::{BladeMeshParams, BladeUv};
use crate::picture::decode::Rgba;
use crate::plant::{Detail, Template};
use glam::{UVec2, Vec2};

/// Least side of a photograph, pixels.
pub(super) const LEAST_SIDE: u32 = 16;
/// Least area of what is cut out, pixels and share of the photograph.
const LEAST_AREA: (usize, f32) = (60, 5e-4);
/// Share of an outline along the photograph's edge from which it is no outline any more.
const CUT_OFF: f32 = 0.2;
/// Share of the strongest difference near by up to which a pixel is mixed.
const MIXED: f32 = 0.4;
/// Alpha from which a pixel is there, and share of pixels without it that makes alpha a mask.
const ALPHA: (u8, f32) = (128, 0.005);

/// What comes of a photograph of a petal or leaf. Places are pixels of the photograph as it was given.
#[derive(Clone, Debug, PartialEq)]
pub struct BladePhoto {
    /// The outline, clockwise, from the base on; first point not repeated.
    pub outline: Vec<Vec2>,
    /// Where it grows from.
    pub base: Vec2,
    /// Its other end.
    pub tip: Vec2,
    /// The outline in the blade's plane, base at the origin and tip at v 1.
    pub template: Template,
    /// How the texture lies on it.
    pub uv: BladeUv,
    /// The picture, in which the blade's UV holds: base below, tip above.
    pub texture: Rgba,
    /// What was cleaned.
    pub cleaned: Cleaned,
    /// What is odd about the photograph.
    pub remarks: Vec<PhotoRemark>,
}

/// An outline that was traced over a picture; places are its pixels.
#[derive(Clone, Copy, Debug)]
pub struct Traced<'a> {
    /// The outline, in either direction.
    pub outline: &'a [Vec2],
    /// Where the petal or leaf grows from.
    pub base: Vec2,
    /// Its other end.
    pub tip: Vec2,
    /// Whether the picture shows the blade's back.
    pub from_behind: bool,
}

/// What was cut out of a photograph that was scaled down.
struct Cut {
    contour: Vec<Vec2>,
    mask: Raster<bool>,
}

/// How a blade lies on a photograph.
#[derive(Clone, Copy, Debug)]
struct Pose {
    base: Vec2,
    /// Pixels for a length of v and u.
    along: Vec2,
    across: Vec2,
}

impl Pose {
    fn new(base: Vec2, tip: Vec2, from_behind: bool) -> Self {
        let along = tip - base;
        // On a photograph that stands upright, with y down, v points up and u to the right.
        let right = along.perp();
        Self { base, along, across: if from_behind { -right } else { right } }
    }

    fn place(&self, p: Vec2) -> Vec2 {
        self.base + self.across * p.x + self.along * p.y
    }

    fn plane(&self, at: Vec2) -> Vec2 {
        let off = at - self.base;
        Vec2::new(off.dot(self.across), off.dot(self.along)) / self.along.length_squared()
    }
}

impl BladePhoto {
    /// Cuts the largest thing out of a photograph; `ends` are base and tip where the artist gives them.
    ///
    /// # Errors
    /// A photograph of which nothing can be cut out.
    pub fn of_photograph(
        picture: &Rgba,
        ends: Option<[Vec2; 2]>,
        params: &PhotoParams,
    ) -> Result<Self, PhotoError> {
        let (small, factor) = usable(picture, params.cutout.side)?;
        let scale = factor as f32;
        let lab = lab_of(&small);
        let mut remarks = Vec::new();
        let Cut { contour, mask } = cut_out(&small, &lab, &params.cutout, &mut remarks)?;
        let given = ends.map(|ends| ends.map(|place| place / scale));
        let refused = PhotoError::BadEnds { width: picture.width, height: picture.height };
        let [base, tip] = ends::ends(&contour, given, lab.size()).ok_or(refused)?;
        let pose = Pose::new(contour[base], contour[tip], false);
        let tolerance = params.cutout.tolerance * size_of(&contour);
        let turned: Vec<Vec2> = contour[base..].iter().chain(&contour[..base]).copied().collect();
        let tip = (tip + contour.len() - base) % contour.len();
        let outline = contour::simplified(&turned, &[0, tip], tolerance);
        let photo = Photo { lab, mask, scale, inset: params.texture.inset };
        photo.finish(&outline, pose, params, remarks)
    }

    /// Takes what lies under a traced outline. Its base is the origin of the blade's plane, the outline the template's.
    ///
    /// # Errors
    /// An outline that encloses nothing or does not lie over the picture.
    pub fn under_outline(
        picture: &Rgba,
        traced: &Traced<'_>,
        params: &PhotoParams,
    ) -> Result<Self, PhotoError> {
        let (small, factor) = usable(picture, params.cutout.side)?;
        let scale = factor as f32;
        let outline: Vec<Vec2> = traced.outline.iter().map(|p| *p / scale).collect();
        let pose = Pose::new(traced.base / scale, traced.tip / scale, traced.from_behind);
        let area = simple_loop::signed_area(outline.iter().copied()).abs();
        let is_usable = outline.len() >= 3 && area > 0.0 && outline.iter().all(|p| p.is_finite());
        if !(is_usable && pose.along.length_squared() > 0.0 && pose.along.is_finite()) {
            return Err(PhotoError::NoOutline);
        }
        let size = UVec2::new(small.width, small.height);
        let mask = polygon::filled(&outline, size);
        let seen = mask.cells().iter().filter(|is_in| **is_in).count() as f32;
        if seen < 0.02 * area || (seen as usize) < LEAST_AREA.0 / 2 {
            return Err(PhotoError::BesidePicture);
        }
        let beside = 100.0 * (1.0 - seen / area);
        let remarks = (beside >= 3.0).then_some(PhotoRemark::PartlyBeside { share: beside });
        let photo = Photo { lab: lab_of(&small), mask, scale, inset: params.texture.traced_inset };
        photo.finish(&outline, pose, params, remarks.into_iter().collect())
    }
}

/// A photograph on which a blade was found.
struct Photo {
    lab: Raster<Lab>,
    mask: Raster<bool>,
    /// Pixels of the photograph as it was given for one of these.
    scale: f32,
    /// How far from the margin colours are trusted, as a share of the size.
    inset: f32,
}

impl Photo {
    fn finish(
        &self,
        outline: &[Vec2],
        pose: Pose,
        params: &PhotoParams,
        remarks: Vec<PhotoRemark>,
    ) -> Result<BladePhoto, PhotoError> {
        let plane: Vec<Vec2> = outline.iter().map(|p| pose.plane(*p)).collect();
        let template = Template::new(plane, Vec::new(), 1.0, Detail::Full);
        let uv = BladeUv::new(&template, &BladeMeshParams::default()).ok_or(PhotoError::NoOutline)?;
        let size = size_of(outline);
        let (low, extent) = self.window(outline)?;
        let mut lab = self.lab.cropped(low, extent);
        let mask = self.mask.cropped(low, extent);
        let trusted = trusted(&mask, self.inset * size);
        let cleaned = clean::clean(&mut lab, &trusted, size, &params.clean);
        let source = Source { lab: &lab, trusted: &trusted, scale: pose.along.length() };
        let place = |p: Vec2| pose.place(p) - low.as_vec2();
        let texture = texture::paint(&source, (&uv, template.outline()), place, &params.texture);
        let whole = |p: Vec2| p * self.scale;
        Ok(BladePhoto {
            outline: outline.iter().map(|p| whole(*p)).collect(),
            base: whole(pose.base),
            tip: whole(pose.place(Vec2::Y)),
            template,
            uv,
            texture,
            cleaned,
            remarks,
        })
    }

    /// The part of the photograph that the outline lies in, with a little around it.
    fn window(&self, outline: &[Vec2]) -> Result<(UVec2, UVec2), PhotoError> {
        let last = self.lab.size().as_vec2();
        let (low, high) = bounds(outline.iter().copied());
        let low = (low.floor() - 4.0).clamp(Vec2::ZERO, last);
        let high = (high.ceil() + 4.0).clamp(Vec2::ZERO, last);
        let extent = (high - low).as_uvec2();
        if extent.min_element() == 0 { Err(PhotoError::BesidePicture) } else { Ok((low.as_uvec2(), extent)) }
    }
}

/// The mask without its margin, or as much of that as leaves anything.
fn trusted(mask: &Raster<bool>, inset: f32) -> Raster<bool> {
    let mut by = (inset.round() as usize).max(2);
    while by > 0 {
        let inner = mask_shrunk(mask, by);
        if inner.cells().contains(&true) {
            return inner;
        }
        by /= 2;
    }
    mask.clone()
}

/// A photograph of at least [`LEAST_SIDE`] pixels each way, scaled down.
pub(super) fn usable(picture: &Rgba, side: u32) -> Result<(std::borrow::Cow<'_, Rgba>, u32), PhotoError> {
    let Rgba { width, height, .. } = *picture;
    if width.min(height) < LEAST_SIDE {
        return Err(PhotoError::TooSmall { width, height, least: LEAST_SIDE });
    }
    let (small, factor) = shrunk(picture, side);
    let (narrow, low) = (small.width, small.height);
    if narrow.min(low) < LEAST_SIDE {
        return Err(PhotoError::TooSmall { width, height, least: LEAST_SIDE * factor });
    }
    Ok((small, factor))
}

/// Contour and mask of the largest thing on a photograph.
fn cut_out(
    picture: &Rgba,
    lab: &Raster<Lab>,
    params: &CutoutParams,
    remarks: &mut Vec<PhotoRemark>,
) -> Result<Cut, PhotoError> {
    let alpha = alpha_of(picture);
    let (distance, threshold, pale) = match alpha {
        Some(alpha) => (alpha, 0.5, 0.5),
        None => {
            let split = background::split(lab, params);
            if split.contrast < params.contrast {
                return Err(PhotoError::OneColour { contrast: split.contrast, least: params.contrast });
            }
            (split.distance, split.threshold, split.pale)
        }
    };
    let core = distance.map(|d| *d > threshold);
    let is_in = with_pale(&distance, &core, pale);
    let Largest { mask, area, count } = largest_region(&is_in, &core).ok_or(PhotoError::NothingThere)?;
    if area < LEAST_AREA.0.max((LEAST_AREA.1 * mask.cells().len() as f32) as usize) {
        return Err(PhotoError::NothingThere);
    }
    if count > 1 {
        remarks.push(PhotoRemark::Several { count });
    }
    let on_edge = share_on_edge(&mask);
    if on_edge > CUT_OFF {
        return Err(PhotoError::CutOff { share: 100.0 * on_edge });
    }
    if on_edge > 0.0 {
        remarks.push(PhotoRemark::TouchesEdge);
    }
    let contour = contour::largest(&coverage(&distance, pale, &mask)).ok_or(PhotoError::NothingThere)?;
    Ok(Cut { contour, mask })
}

/// The core with what is pale. Grain is not, which its surroundings tell, nor are pixels in which background and something
/// strong are mixed.
fn with_pale(distance: &Raster<f32>, core: &Raster<bool>, pale: f32) -> Raster<bool> {
    let (mean, most) = (window_means(distance, 1), window_max(distance, 2));
    let is_in = |i: usize| {
        let d = distance.cells()[i];
        core.cells()[i] || (d.min(mean.cells()[i]) > pale && d > MIXED * most.cells()[i])
    };
    Raster::new(distance.width(), (0..distance.cells().len()).map(is_in).collect())
}

/// Alpha as a mask, where the picture has one that says something.
fn alpha_of(picture: &Rgba) -> Option<Raster<f32>> {
    let pixels = picture.pixels.as_chunks::<4>().0;
    let absent = pixels.iter().filter(|[.., a]| *a < ALPHA.0).count();
    let says_something = absent as f32 >= ALPHA.1 * pixels.len() as f32;
    says_something.then(|| {
        Raster::new(picture.width as usize, pixels.iter().map(|[.., a]| f32::from(*a) / 255.0).collect())
    })
}

/// The larger extent of a line.
fn size_of(line: &[Vec2]) -> f32 {
    let (low, high) = bounds(line.iter().copied());
    (high - low).max_element()
}

#[cfg(test)]
#[path = "blade_photo_tests.rs"]
mod tests;
