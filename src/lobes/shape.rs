//! A lobe's surface from its strokes: all stages in a row.
//!
//! strokes → smooth, matched → [`loft`](super::loft) → [`untangled`](super::untangle) → [`remesh`](super::remesh) → [`deform`](super::deform) → posed → above the ground
//!
//! Pure: the same lobe gives the same surface on any number of threads. Every surface is closed, manifold and wound outward.

use super::deform::deform;
use super::lobe::{Crown, Lobe};
use super::loft::{Lack, Lofted, loft};
use super::remark::{Fault, Remark};
use super::remesh::{Remesh, remesh};
use super::stroke::{self, Smooth};
use super::surface::Surface;
use super::untangle::{above, is_clean, untangled};

/// Most strokes of a lobe.
pub const MOST_STROKES: usize = 256;
/// How far a lobe may reach below the ground without being cut, as a share of its size: what hands do not see.
const SUNK: f32 = 1e-3;

/// A lobe that was made.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaped {
    /// What it is called.
    pub name: String,
    /// Its surface, metres.
    pub surface: Surface,
    /// Whether it is taken away from the others.
    pub negative: bool,
    /// What there is to know of it.
    pub remarks: Vec<Remark>,
}

/// Makes every lobe that is not switched off.
///
/// # Errors
/// The first lobe that cannot be made, by its place and name.
pub fn shape_all(crown: &Crown, params: &Remesh) -> Result<Vec<Shaped>, (usize, String, Fault)> {
    let used = crown.lobes.iter().enumerate().filter(|(_, lobe)| !lobe.off);
    used.map(|(k, lobe)| shape(lobe, params).map_err(|fault| (k, lobe.name.clone(), fault))).collect()
}

/// Makes a lobe.
///
/// # Errors
/// Why it cannot be made.
pub fn shape(lobe: &Lobe, params: &Remesh) -> Result<Shaped, Fault> {
    let mut remarks = Vec::new();
    let mut surface = undeformed(lobe, params, &mut remarks)?;
    if !lobe.deform.is_empty() {
        let count = deform(&mut surface, &lobe.deform);
        if count > 0 {
            remarks.push(Remark::LostOffsets { count });
        }
        surface = clean(surface, params, &mut remarks)?;
    }
    let (low, high) = surface.bounds();
    let middle = low.midpoint(high);
    surface.points.iter_mut().for_each(|p| *p = lobe.pose.place(*p, middle));
    let surface = above_ground(surface, lobe.negative, params, &mut remarks)?;
    Ok(Shaped { name: lobe.name.clone(), surface, negative: lobe.negative, remarks })
}

/// The surface of a lobe where it was drawn, before anything of it was changed: what offsets are counted by.
///
/// # Errors
/// Why it cannot be made.
pub fn undeformed(lobe: &Lobe, params: &Remesh, remarks: &mut Vec<Remark>) -> Result<Surface, Fault> {
    let lofted = from_strokes(lobe, remarks)?;
    let (surface, anew) = untangled(lofted.surface).ok_or(Fault::Flat)?;
    if anew {
        remarks.push(Remark::Untangled);
    }
    Ok(even(surface, lofted.of_grid || anew, params, remarks))
}

/// The surface between the strokes of a lobe, before it is untangled and remeshed: closed, but it may cross itself or be inside
/// out.
///
/// # Errors
/// Why there is none.
pub fn lofted(lobe: &Lobe) -> Result<Surface, Fault> {
    from_strokes(lobe, &mut Vec::new()).map(|lofted| lofted.surface)
}

fn from_strokes(lobe: &Lobe, remarks: &mut Vec<Remark>) -> Result<Lofted, Fault> {
    let count = lobe.strokes.len();
    if count > MOST_STROKES {
        return Err(Fault::TooManyStrokes { count, most: MOST_STROKES });
    }
    let (mut smooth, mut numbers): (Vec<Smooth>, Vec<usize>) = (Vec::new(), Vec::new());
    for (stroke, number) in lobe.strokes.iter().zip(1..) {
        let Some(line) = stroke::smooth(stroke) else {
            remarks.push(Remark::NoLength { stroke: number });
            continue;
        };
        if line.was_cut {
            remarks.push(Remark::Cut { stroke: number });
        }
        smooth.push(line);
        numbers.push(number);
    }
    let lofted = loft(&stroke::matched(&smooth), lobe.form, lobe.in_order).map_err(|lack| match lack {
        Lack::Strokes => Fault::NoStrokes,
        Lack::SecondStroke => Fault::OneOpenStroke,
        Lack::Profiles => Fault::NoProfiles,
    })?;
    remarks.extend(lofted.left_out.iter().map(|k| Remark::LeftOut { stroke: numbers[*k] }));
    Ok(lofted)
}

/// The surface with even triangles, where these leave it clean; one that comes from a grid has no creases.
fn even(surface: Surface, of_grid: bool, params: &Remesh, remarks: &mut Vec<Remark>) -> Surface {
    let crease_deg = if of_grid { 180.0 } else { params.crease_deg };
    match remesh(&surface, &Remesh { crease_deg, ..*params }) {
        Some(even) if even.signed_volume() > 0.0 && is_clean(&even) => even,
        _ => {
            remarks.push(Remark::Uneven);
            surface
        }
    }
}

/// A surface that was changed, made anew where it crosses itself.
fn clean(surface: Surface, params: &Remesh, remarks: &mut Vec<Remark>) -> Result<Surface, Fault> {
    let (surface, anew) = untangled(surface).ok_or(Fault::Flat)?;
    if !anew {
        return Ok(surface);
    }
    if !remarks.contains(&Remark::Untangled) {
        remarks.push(Remark::Untangled);
    }
    Ok(even(surface, true, params, remarks))
}

/// What of a lobe is above the ground. One that is taken away from others may reach below it.
fn above_ground(
    surface: Surface,
    negative: bool,
    params: &Remesh,
    remarks: &mut Vec<Remark>,
) -> Result<Surface, Fault> {
    let (low, high) = surface.bounds();
    if negative || low.y >= -SUNK * (high - low).max_element() {
        return Ok(surface);
    }
    remarks.push(Remark::Clipped);
    let part = above(&surface, 0.0).ok_or(Fault::Buried)?;
    Ok(even(part, true, params, remarks))
}
