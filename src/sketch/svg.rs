//! SVG as Inkscape, Krita, drawing and icon programs and hands write it: whatever is painted, filled or stroked, is
//! strokes, in document order, by its outline; a path with several subpaths gives several strokes.
//!
//! The canvas is the page in CSS pixels (96 per inch), so that units, `viewBox`, nested viewports and transforms are all
//! resolved here. Curves become polylines within [`TOLERANCE`] of the drawing's diagonal. Attributes, style sheets and
//! inheritance decide what is painted; what has neither fill nor stroke is not, nor what is hidden, and a rectangle
//! without stroke that covers the page is paper. `data-tool`, or the label or id of the nearest group that names a tool,
//! says what a stroke was drawn as. Pressure and tilt are unknown to SVG: strokes have the neutral ones, but for
//! polylines with `data-pressure`, a list of one number per point, which [`write()`] adds. Not read: text, images (a
//! remark counts what was left out), stroke width, clipping, markers and what a fill hides.
//! Source: SVG 1.1 second edition, chapters 5 to 9 and 11.

mod guard;
mod naming;
mod path_data;
mod pressure;
mod shapes;
mod style;
mod style_sheet;
mod viewport;
mod walk;
mod write;

pub use write::write;

use self::walk::Outline;
use super::draft::{Draft, DraftStroke, Flaw};
use super::error::{Fault, Place};
use super::warnings::Warnings;
use super::{StrokePoint, limits};
use crate::quote;
use glam::vec2;
use kurbo::{PathEl, Point, Rect};
use roxmltree::{Document, ParsingOptions};

/// Largest distance between a curve and its polyline, as a fraction of the drawing's diagonal.
pub const TOLERANCE: f64 = 2e-5;

/// Parses an SVG document.
///
/// # Errors
/// Text that is no XML or no SVG, too much of anything, coordinates out of range, an unknown `data-tool`.
pub(super) fn parse(text: &str, warnings: &mut Warnings) -> Result<Draft, Flaw> {
    guard::check(text).map_err(|fault| (Place::default(), fault))?;
    let options =
        ParsingOptions { allow_dtd: true, nodes_limit: limits::MAX_SVG_NODES as u32, entity_resolver: None };
    let document = Document::parse_with_options(text, options).map_err(|error| xml_flaw(&error, text))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err((Place::default(), Fault::NotADrawing { found: "it is XML, but its root is not <svg>" }));
    }
    let page = viewport::Viewport::of_page(root, warnings);
    let css = style_sheet::text_of(&document).map_err(|fault| (Place::default(), fault))?;
    let sheet = style_sheet::StyleSheet::parse(&css);
    let outlines = walk::outlines(&document, &page, &sheet, warnings)?;
    Ok(Draft { canvas: page.canvas, strokes: flattened(&outlines)?, ..Draft::default() })
}

fn xml_flaw(error: &roxmltree::Error, text: &str) -> Flaw {
    let lines = text.bytes().filter(|b| *b == b'\n').count() + 1;
    let last_line = text.rsplit('\n').next().unwrap_or_default();
    let end = (lines, last_line.chars().count() + 1);
    let found = (error.pos().row as usize, error.pos().col as usize);
    match error {
        roxmltree::Error::UnexpectedEndOfStream | roxmltree::Error::UnclosedRootNode => {
            (Place::at(end.0, end.1), Fault::Truncated)
        }
        _ if found == end => (Place::at(end.0, end.1), Fault::Truncated),
        roxmltree::Error::NodesLimitReached => {
            (Place::default(), Fault::TooMany { what: "SVG elements", limit: limits::MAX_SVG_NODES })
        }
        _ => {
            let full = error.to_string();
            let message = full.strip_suffix(&format!(" at {}", error.pos())).unwrap_or(&full);
            (
                Place::at(found.0, found.1),
                Fault::Malformed(format!("this is not well-formed XML: {}", quote::name(message))),
            )
        }
    }
}

/// Every subpath as a stroke.
fn flattened(outlines: &[Outline]) -> Result<Vec<DraftStroke>, Flaw> {
    let extent =
        outlines.iter().map(|o| o.path.control_box()).reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO);
    // Below f32 there is nothing to resolve, and kurbo divides by the square of the tolerance.
    let tolerance = (extent.size().to_vec2().hypot() * TOLERANCE).max(f64::from(f32::MIN_POSITIVE));
    let mut room = limits::MAX_POINTS;
    let mut strokes = Vec::new();
    for outline in outlines {
        // A subpath of one element is a move after which nothing was drawn.
        for subpath in outline.path.subpaths().filter(|elements| elements.len() > 1) {
            let mut points = polyline(subpath, tolerance, room);
            if let Some(pressures) = &outline.pressures {
                points.truncate(pressures.len());
                points.iter_mut().zip(pressures).for_each(|(point, pressure)| point.pressure = *pressure);
            }
            let too_many = |what, limit| Err((Place::default(), Fault::TooMany { what, limit }));
            if points.len() > room {
                return too_many("points", limits::MAX_POINTS);
            }
            if strokes.len() == limits::MAX_STROKES {
                return too_many("strokes", limits::MAX_STROKES);
            }
            room -= points.len();
            strokes.push(DraftStroke { id: None, tool: outline.tool, points, brush: None });
        }
    }
    Ok(strokes)
}

/// The subpath as samples; stops soon after `most` of them.
fn polyline(subpath: &[PathEl], tolerance: f64, most: usize) -> Vec<StrokePoint> {
    let mut positions: Vec<Point> = Vec::with_capacity(subpath.len());
    for &element in subpath {
        if positions.len() > most {
            break;
        }
        match (element, positions.last().copied()) {
            (PathEl::MoveTo(p) | PathEl::LineTo(p), _) => positions.push(p),
            (PathEl::ClosePath, Some(last)) => {
                positions.extend(positions.first().copied().filter(|p| *p != last))
            }
            (curve, Some(last)) => kurbo::flatten([PathEl::MoveTo(last), curve], tolerance, |piece| {
                if let PathEl::LineTo(p) = piece {
                    positions.push(p);
                }
            }),
            (_, None) => {}
        }
    }
    positions.into_iter().map(|p| StrokePoint::at(vec2(p.x as f32, p.y as f32))).collect()
}
