//! A trunk that was drawn over a photograph, moved to the middle between the two edges that it has there.
//!
//! At many places along the stroke edges are sought across it. Two of them that face each other, one turning dark and one turning
//! light, are a candidate for the trunk's two sides. The row of candidates that leaves the stroke least and changes least from place to
//! place is found by dynamic programming; where no pair is good enough, none is taken, and the trunk is led from the places before to
//! those after. The stroke becomes the middle line, smoothed, and its widths those of the pairs.
//!
//! Limits: two trunks that stand nearer to each other than to the background may become one.

use super::edges::Edges;
use super::parts::TrunkLine;
use crate::geom::polyline::{arc_lengths, interpolate, length, locate};
use glam::Vec2;

crate::parameters! {
    /// How a drawn trunk is moved onto the edges of a photograph.
    pub struct SnapParams {
        /// How far edges are sought on both sides of the stroke.
        reach: f32 = 0.05, 0.005..=0.2, "of the photograph's longer side";
        /// Least share of the stroke along which both edges are seen.
        seen: f32 = 0.4, 0.05..=1.0, "";
    }
}

/// Distance of the places along the stroke, pixels of the grid, and most of them.
const STEP: f32 = 2.0;
const MOST: f32 = 1000.0;
/// Candidates of a place, at most so many.
const CANDIDATES: usize = 12;
/// Least width of a trunk, pixels of the grid.
const THINNEST: f32 = 2.0;
/// What it costs to have no pair, in units of the reach.
const NO_PAIR: f32 = 0.8;
/// What a change from a place to the next costs, against the way off the stroke.
const CHANGE: f32 = 3.0;
/// Cosine of the angle between an edge's gradient and the way across the stroke, at least.
const ACROSS: f32 = 0.75;
/// Places on both sides over which the middle line is averaged.
const SMOOTH: usize = 3;

/// Two edges that face each other: their middle and distance, across the stroke, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair {
    middle: f32,
    width: f32,
}

/// The trunk under a stroke; `None` where its sides are not seen.
pub(super) fn snapped(edges: &Edges, stroke: &[Vec2], params: &SnapParams) -> Option<TrunkLine> {
    let total = length(stroke);
    if !total.is_finite() || total < 4.0 * STEP {
        return None;
    }
    let reach = params.reach * edges.side();
    let arcs = arc_lengths(stroke.iter().copied());
    let count = (total / STEP).min(MOST).ceil() as usize;
    let at = |k: usize| interpolate(stroke, locate(&arcs, total * k as f32 / count as f32));
    let places: Vec<Vec2> = (0..=count).map(at).collect();
    let across = |k: usize| {
        let along = places[(k + 2).min(count)] - places[k.saturating_sub(2)];
        along.perp().normalize_or(Vec2::X)
    };
    let normals: Vec<Vec2> = (0..=count).map(across).collect();
    let candidates: Vec<Vec<Pair>> =
        places.iter().zip(&normals).map(|(place, normal)| pairs(edges, *place, *normal, reach)).collect();
    let row = best_row(&candidates, reach);
    let seen = row.iter().flatten().count() as f32;
    if seen < params.seen * row.len() as f32 {
        return None;
    }
    let pairs = smoothed(&led_on(&row)?);
    let points =
        places.iter().zip(&normals).zip(&pairs).map(|((place, normal), pair)| *place + *normal * pair.middle);
    Some(TrunkLine { points: points.collect(), widths: pairs.iter().map(|pair| pair.width).collect() })
}

/// Candidates at a place, the nearest to the stroke first.
fn pairs(edges: &Edges, place: Vec2, normal: Vec2, reach: f32) -> Vec<Pair> {
    let steps = (2.0 * reach).ceil() as i32;
    let mut found: Vec<(f32, f32)> = Vec::new();
    for k in -steps..=steps {
        let offset = 0.5 * k as f32;
        let Some(gradient) = edges.at(place + normal * offset) else { continue };
        let share = gradient.dot(normal);
        if share.abs() < ACROSS * gradient.length() {
            continue;
        }
        // The same pixel, met again.
        match found.last_mut().filter(|(last, sign)| offset - *last <= 1.5 && *sign == share.signum()) {
            Some((last, _)) => *last = offset,
            None => found.push((offset, share.signum())),
        }
    }
    let mut pairs = Vec::new();
    for (i, (left, from)) in found.iter().enumerate() {
        for (right, to) in &found[i + 1..] {
            if from != to && right - left >= THINNEST {
                pairs.push(Pair { middle: left.midpoint(*right), width: right - left });
            }
        }
    }
    pairs.sort_by(|a, b| (a.middle.abs() + 0.1 * a.width).total_cmp(&(b.middle.abs() + 0.1 * b.width)));
    pairs.truncate(CANDIDATES);
    pairs
}

/// The candidate that is taken at each place, or none.
fn best_row(candidates: &[Vec<Pair>], reach: f32) -> Vec<Option<Pair>> {
    let own = |pair: Option<Pair>| pair.map_or(NO_PAIR, |pair| pair.middle.abs() / reach);
    let change = |a: Option<Pair>, b: Option<Pair>| match (a, b) {
        (Some(a), Some(b)) => CHANGE * ((a.middle - b.middle).abs() + (a.width - b.width).abs()) / reach,
        (None, None) => 0.0,
        _ => 0.5 * CHANGE / reach,
    };
    let options = |k: usize| candidates[k].iter().copied().map(Some).chain([None]);
    let mut costs: Vec<f32> = options(0).map(own).collect();
    let mut back: Vec<Vec<usize>> = vec![Vec::new()];
    for k in 1..candidates.len() {
        let (mut next, mut from) = (Vec::new(), Vec::new());
        for option in options(k) {
            let reached = options(k - 1).zip(&costs).map(|(before, cost)| cost + change(before, option));
            let (best, cost) = reached
                .enumerate()
                .fold((0, f32::INFINITY), |best, (i, cost)| if cost < best.1 { (i, cost) } else { best });
            next.push(cost + own(option));
            from.push(best);
        }
        costs = next;
        back.push(from);
    }
    let mut at = (0..costs.len()).fold(0, |best, i| if costs[i] < costs[best] { i } else { best });
    let mut row: Vec<Option<Pair>> = Vec::with_capacity(candidates.len());
    for k in (0..candidates.len()).rev() {
        row.push(candidates[k].get(at).copied());
        at = back[k].get(at).copied().unwrap_or(0);
    }
    row.reverse();
    row
}

/// Pairs everywhere: between those that were found, and as the nearest one at the ends.
fn led_on(row: &[Option<Pair>]) -> Option<Vec<Pair>> {
    let known: Vec<(usize, Pair)> =
        row.iter().enumerate().filter_map(|(k, pair)| Some((k, (*pair)?))).collect();
    let (first, last) = (known.first()?.1, known.last()?.1);
    let at = |k: usize| {
        let after = known.partition_point(|(place, _)| *place < k);
        match (after.checked_sub(1).map(|before| known[before]), known.get(after)) {
            (Some((from, a)), Some((to, b))) => {
                let share = (k - from) as f32 / (to - from) as f32;
                let between = |a: f32, b: f32| a + (b - a) * share;
                Pair { middle: between(a.middle, b.middle), width: between(a.width, b.width) }
            }
            (None, _) => first,
            _ => last,
        }
    };
    Some((0..row.len()).map(at).collect())
}

fn smoothed(pairs: &[Pair]) -> Vec<Pair> {
    let at = |k: usize| {
        let reach = SMOOTH.min(k).min(pairs.len() - 1 - k);
        let near = &pairs[k - reach..=k + reach];
        let mean = |of: fn(&Pair) -> f32| near.iter().map(of).sum::<f32>() / near.len() as f32;
        Pair { middle: mean(|pair| pair.middle), width: mean(|pair| pair.width) }
    };
    (0..pairs.len()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::raster::Raster;
    use super::*;
    use glam::{UVec2, Vec3};

    /// A dark trunk that bends and tapers, with its middle and width at a height.
    fn trunk(y: f32) -> (f32, f32) {
        (100.0 + 12.0 * (y / 60.0).sin(), 8.0 + 0.06 * y)
    }

    fn picture() -> Edges {
        let mut lab = Raster::filled(UVec2::new(200, 240), Vec3::new(75.0, 0.0, -10.0));
        for i in 0..lab.cells().len() {
            let at = lab.middle(i);
            let (middle, width) = trunk(at.y);
            let grain = ((i * 7919) % 13) as f32 - 6.0;
            // A gap in the lower third, where something as dark stands before it.
            let hidden = (150.0..170.0).contains(&at.y);
            let covered =
                if hidden { 1.0 } else { (0.5 * width - (at.x - middle).abs() + 0.5).clamp(0.0, 1.0) };
            lab.cells_mut()[i].x = 75.0 - 45.0 * covered + grain;
        }
        Edges::of(&lab)
    }

    #[test]
    fn a_stroke_beside_a_trunk_comes_to_its_middle_with_its_width() {
        let edges = picture();
        for off in [-5.0, 0.0, 6.0] {
            let stroke: Vec<Vec2> =
                (0..=40).map(|k| Vec2::new(100.0 + off, 230.0 - 5.0 * k as f32)).collect();
            let params = SnapParams { reach: 0.12, ..SnapParams::default() };
            let found = snapped(&edges, &stroke, &params).unwrap();
            for (p, found) in found.points.iter().zip(&found.widths).skip(4) {
                let (middle, width) = trunk(p.y);
                assert!((p.x - middle).abs() < 2.5, "{off}: {p} and not {middle}");
                assert!((found - width).abs() < 4.0, "{off}: {found} and not {width} at {}", p.y);
            }
        }
    }

    #[test]
    fn where_no_trunk_is_seen_nothing_is_moved() {
        let edges = picture();
        let beside: Vec<Vec2> = (0..=20).map(|k| Vec2::new(20.0, 140.0 - 5.0 * k as f32)).collect();
        assert_eq!(snapped(&edges, &beside, &SnapParams::default()), None);
        assert_eq!(snapped(&edges, &[Vec2::ZERO], &SnapParams::default()), None);
        assert_eq!(snapped(&edges, &[Vec2::NAN; 3], &SnapParams::default()), None);
    }
}
