//! Spikes of an outline that goes round a base, cut at its sharp folds.
//!
//! Fronds that arch over and hang are farthest from their base where they bend, not at their tips, so distances alone
//! ([`spikes`](super::spikes)) find no tip there. But however a frond bends, its outline folds sharply at the tip, outward as the
//! outline as a whole turns about the base; a far end of the line is a tip as well. Between two tips the point nearest to the
//! base is where both have their roots.
//!
//! Limits: round tips are no folds. Cost: linear in the points.

use super::spikes::{Spike, closed_from_below};
use crate::geom::{polyline, simple_loop};
use glam::Vec2;
use std::f32::consts::PI;

/// Widest angle of a tip, and how far from it that is measured, as a share of the greatest distance from the base.
const TIP: (f32, f32) = (1.2, 0.2);
/// Over how many halves of that it is seen to which side the line folds.
const SENSE: usize = 3;
/// Least distance of an end from the base for it to be a tip, as a share of the greatest.
const END: f32 = 0.5;

/// The spikes of a line with even points about a base.
pub(crate) fn folded(points: &[Vec2], base: Vec2) -> Vec<Spike> {
    let away = |p: Vec2| p.distance(base);
    let closed = closed_from_below(points, away);
    let points = closed.as_deref().unwrap_or(points);
    let far = points.iter().map(|p| away(*p)).fold(0.0, f32::max);
    let tips = tips(points, base, far);
    let root = |from: usize, to: usize| {
        (from..=to).min_by(|a, b| away(points[*a]).total_cmp(&away(points[*b]))).unwrap_or(from)
    };
    let last = points.len() - 1;
    let spike = |k: usize| {
        let (tip, before, after) =
            (tips[k], k.checked_sub(1).map_or(0, |b| tips[b]), tips.get(k + 1).copied().unwrap_or(last));
        let left = (tip > 0).then(|| points[root(before, tip)..=tip].iter().rev().copied().collect());
        let right = (tip < last).then(|| points[tip..=root(tip, after)].to_vec());
        let flanks = left.into_iter().chain(right).filter(|flank: &Vec<Vec2>| flank.len() > 2).collect();
        Spike { flanks }
    };
    (0..tips.len()).map(spike).filter(|spike| !spike.flanks.is_empty()).collect()
}

/// Where a line folds outward, and its far ends, ascending.
fn tips(points: &[Vec2], base: Vec2, far: f32) -> Vec<usize> {
    let last = points.len() - 1;
    let step = polyline::length(points) / last.max(1) as f32;
    let window = ((TIP.1 * far / step.max(f32::MIN_POSITIVE)) as usize).max(2);
    let outward = simple_loop::signed_area(points.iter().copied().chain([base])).signum();
    let sharpness = |k: usize| {
        let (before, after) = (k.checked_sub(window)?, Some(k + window).filter(|after| *after <= last)?);
        let [before, here, after] = [before, k, after].map(|k| points[k]);
        Some((k, (here - before).angle_to(after - here).abs()))
    };
    // The two sides of narrow tips cross, so that their turn has no sense, but the area between them has.
    let is_outward = |k: &usize| {
        let reach = SENSE * window / 2;
        let around = &points[k.saturating_sub(reach)..=(k + reach).min(last)];
        outward * simple_loop::signed_area(around.iter().copied()) > 0.0
    };
    let turns: Vec<(usize, f32)> =
        (0..points.len()).filter_map(sharpness).filter(|(_, turn)| *turn > PI - TIP.0).collect();
    // One tip for each run of sharp points.
    let runs = turns.chunk_by(|a, b| b.0 - a.0 <= window);
    let sharpest = runs.filter_map(|run| run.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|tip| tip.0));
    let is_far = |k: &usize| points[*k].distance(base) > END * far;
    let ends = |k: usize| Some(k).filter(is_far);
    ends(0).into_iter().chain(sharpest.filter(is_outward)).chain(ends(last)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::page::even;

    /// A frond that rises from (0, 0), arches over and hangs at one side, in one line there and back.
    fn hanging(side: f32) -> Vec<Vec2> {
        let corners = [(0.0, 0.0), (30.0, -60.0), (70.0, -60.0), (85.0, -10.0), (87.0, 35.0)];
        let back = [(72.0, -5.0), (60.0, -35.0), (35.0, -30.0), (8.0, 0.0)];
        corners.iter().chain(&back).map(|(x, y)| Vec2::new(side * x, *y)).collect()
    }

    #[test]
    fn what_arches_over_and_hangs_ends_at_its_fold() {
        let mut line = hanging(1.0);
        line.extend(hanging(-1.0).into_iter().rev());
        let found = folded(&even(&line, 300), Vec2::new(0.0, 5.0));
        let tips: Vec<Vec2> = found.iter().map(Spike::tip).collect();
        assert_eq!(found.len(), 2, "{tips:?}");
        for (tip, side) in tips.iter().zip([1.0, -1.0]) {
            assert!(tip.distance(Vec2::new(side * 87.0, 35.0)) < 4.0, "{tips:?}");
        }
        assert!(found.iter().all(|spike| spike.flanks.len() == 2 && spike.foot().length() < 15.0));
    }

    #[test]
    fn a_cloud_has_no_folds() {
        let place = |k: usize| {
            let angle = 0.02 * k as f32;
            (50.0 + 8.0 * (4.0 * angle).sin().abs()) * Vec2::from_angle(angle)
        };
        let cloud: Vec<Vec2> = (0..315).map(place).collect();
        assert!(folded(&cloud, Vec2::new(0.0, 60.0)).is_empty());
    }
}
