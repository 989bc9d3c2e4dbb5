//! Dots in a crown: its foliage is sparser around them (001 §3.4, fig. 3.10).
//!
//! A dot is a stroke that is hardly larger than a point, drawn with the crown's tool or with none, whose middle lies inside of a
//! crown's outline. Each thins the crown within a share of the crown's diagonal.

use super::Part;
use super::reading::Reading;
use crate::geom::polyline;
use crate::geom::region::Region;
use crate::sketch::{Remark, StrokeId, Tool};
use glam::Vec2;
use std::sync::Arc;

/// Largest diagonal of a dot, as a share of the crown's.
const DOT: f32 = 0.035;
/// How far around it foliage is sparser, as a share of the crown's diagonal.
const REACH: f32 = 0.06;

/// Most dots of a drawing, the first.
const MOST: usize = 256;

/// Where a crown is sparse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinSpot {
    /// The dot.
    pub stroke: StrokeId,
    /// Its middle, canvas pixels.
    pub middle: Vec2,
    /// How far it reaches, canvas pixels.
    pub radius: f32,
}

/// The dots in the crowns of a drawing.
pub(super) fn find(readings: &[Arc<Reading>]) -> Vec<ThinSpot> {
    let is_crown = |r: &&Arc<Reading>| r.part == Part::Crown;
    let extent = |r: &Reading| polyline::bounds(r.samples.iter().map(|s| s.position));
    let largest = readings.iter().filter(is_crown).map(|r| size(extent(r))).fold(0.0, f32::max);
    // Most drawings have none: then no outline need be looked at.
    let may_be_dot = |r: &Reading| is_small(r) && size(extent(r)) <= DOT * largest;
    if !readings.iter().any(|r| may_be_dot(r)) {
        return Vec::new();
    }
    let whole = readings.iter().filter(is_crown).filter(|r| size(extent(r)) > DOT * largest);
    let crowns: Vec<(Region, f32)> = whole
        .map(|r| (Region::new(r.samples.iter().map(|s| s.position).collect()), size(extent(r))))
        .collect();
    let spot = |r: &Arc<Reading>| {
        let (low, high) = extent(r);
        let middle = low.midpoint(high);
        let around = crowns.iter().filter(|(crown, _)| crown.contains(middle));
        let diagonal = around.map(|(_, diagonal)| *diagonal).reduce(f32::min)?;
        let is_dot = is_small(r) && size((low, high)) <= DOT * diagonal;
        is_dot.then_some(ThinSpot { stroke: r.id, middle, radius: REACH * diagonal })
    };
    readings.iter().filter_map(spot).take(MOST).collect()
}

fn size((low, high): (Vec2, Vec2)) -> f32 {
    low.distance(high)
}

/// Whether a stroke says nothing else.
fn is_small(r: &Reading) -> bool {
    let says_nothing = matches!(r.warning, Some(Remark::TooShort | Remark::EmptyCrown));
    matches!(r.tool, Tool::Auto | Tool::Crown) && (says_nothing || r.part == Part::Crown)
}
