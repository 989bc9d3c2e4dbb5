//! The teeth of a line: what stands above the ground in a zigzag.
//!
//! A line is cut into its [`spikes`](super::spikes) above the ground. A zigzag is a line with [`TEETH`] sharp tips at least, one more if it is
//! closed by a line along the ground, most of which are drawn one after the other to one side. Rounded tips are lobes of a crown.
//!
//! Limits: tips are those above the ground, so what lies is not found.

use super::outline;
use super::spikes::{Spike, spikes};
use crate::anatomy::conventions::page::{Line, median};
use crate::geom::polyline;
use glam::Vec2;
use std::f32::consts::PI;

/// Fewest tips with both flanks of a zigzag.
const TEETH: usize = 3;
/// Least height of a tip over the notches beside it, as a share of the line's height.
const PROMINENCE: f32 = 0.1;
/// Longest hook at a blade's tip, as a share of the blade's length, and least rise of the end of a zigzag that is a blade, over its
/// width.
const HOOK: f32 = 0.2;
const LIES: f32 = 0.3;
/// Where along its flanks the angle of a tip is measured, as a share of the shorter.
const TIP_SHARE: f32 = 0.3;
/// Widest angle of a tip in the middle of all: a right angle is a saw, a half circle has nearly two.
const SHARP: f32 = 0.45 * PI;
/// Tips and width, in heights, of a long row in which they may be as blunt as this: grass in a quick hand.
const ROW: (usize, f32) = (8, 4.0);
const BLUNT: f32 = 0.7 * PI;
/// Least depth of the notch in the middle of all below the highest tip, as a share of the line's height: the edge of a crown
/// has its notches far above its foot.
const DEEP: f32 = 0.35;
/// Fewest tips of an outline that does not run along the ground, and least depth of the notch in the middle of all: a star has its
/// notches farther up.
const TUFT: (usize, f32) = (5, 0.5);
/// Distance between the ends over the diagonal below which a line is an outline.
const CLOSED: f32 = 0.3;
/// Greatest area of a blade drawn as an outline, over the square of its length: a circle has 0.08.
const NARROW: f32 = 0.045;
/// Least width of a zigzag that can be nothing else, in its heights.
const WIDE: f32 = 1.5;

/// Height above the ground, but for a constant.
fn height(p: Vec2) -> f32 {
    -p.y
}

/// A line as spikes above the ground, a single one without a hook at its tip, several without ends that lie along the ground.
pub(crate) fn upright_spikes(line: &Line) -> Vec<Spike> {
    let mut all = spikes(&line.points, height, PROMINENCE * line.size().y);
    let length = |spike: &Spike, flank: usize| polyline::length(&spike.flanks[flank]);
    if let [spike] = &mut all[..]
        && spike.flanks.len() == 2
        && let Some(hook) = (0..2).find(|hook| length(spike, *hook) < HOOK * length(spike, 1 - hook))
    {
        spike.flanks.remove(hook);
    }
    let lies = |spike: &Spike| {
        let way = spike.tip() - spike.foot();
        spike.flanks.len() == 1 && way.y.abs() < LIES * way.x.abs()
    };
    let several = all.len() > 1;
    all.retain(|spike| !(several && lies(spike)));
    all
}

/// Whether a line may be a blade or a zigzag of blades by itself: higher than wide, or sharp.
pub(crate) fn is_upright(line: &Line) -> bool {
    let teeth = upright_spikes(line);
    let mut angles: Vec<f32> = teeth.iter().filter_map(|tooth| tooth.angle(TIP_SHARE)).collect();
    let is_steep = line.size().y > 0.6 * line.size().x * (1.0 / teeth.len().max(1) as f32);
    let is_narrow = line.openness > CLOSED || line.area < NARROW * line.length * line.length;
    is_steep && is_narrow && !teeth.is_empty() && (angles.is_empty() || median(&mut angles) < SHARP)
}

/// Whether a line is a zigzag along the ground, wider than high.
pub(crate) fn is_row_of_teeth(line: &Line) -> bool {
    line.size().x > WIDE * line.size().y && zigzag(line).is_some()
}

/// The teeth of a line, if it is a zigzag.
pub(crate) fn zigzag(line: &Line) -> Option<Vec<Spike>> {
    let teeth = upright_spikes(line);
    let mut angles: Vec<f32> = teeth.iter().filter_map(|tooth| tooth.angle(TIP_SHARE)).collect();
    let is_closed = line.openness < CLOSED;
    if angles.len() < TEETH + usize::from(is_closed) {
        return None;
    }
    let mut notches: Vec<f32> = teeth.iter().map(|tooth| tooth.foot().y).collect();
    let notch = (median(&mut notches) - line.bounds.0.y) / line.size().y;
    let is_tuft = angles.len() >= TUFT.0 && notch > TUFT.1;
    if is_closed && !is_level_below(line) && !is_tuft {
        return None;
    }
    let is_deep = notch > DEEP;
    let size = line.size();
    let is_row = angles.len() >= ROW.0 && size.x > ROW.1 * size.y;
    let widest = if is_row { BLUNT } else { SHARP };
    (is_deep && median(&mut angles) < widest && goes_to_one_side(&teeth)).then_some(teeth)
}

/// Whether the lowest part of an outline runs along the ground.
fn is_level_below(line: &Line) -> bool {
    let (left, right) = outline::foot(&line.points, 0.12);
    right.x - left.x > 0.6 * line.size().x
}

/// Whether most tips come one after the other to the left, or to the right.
fn goes_to_one_side(teeth: &[Spike]) -> bool {
    let steps = teeth.len() - 1;
    let to_right = teeth.windows(2).filter(|pair| pair[1].tip().x > pair[0].tip().x).count();
    5 * to_right.max(steps - to_right) >= 4 * steps
}
