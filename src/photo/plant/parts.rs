//! Crown and trunk of a plant's mask.
//!
//! From the lowest rows upward a tree is narrow as long as it is trunk and becomes wide where its crown begins. The trunk is the run of
//! pixels that goes on from row to row below that height; its middle line and width are smoothed. All the rest is crown.
//!
//! Limits: a trunk that leans by more than about 45°, or stands in foliage or grass as wide as the crown, is not found; the
//! plant is then all crown. Where a trunk forks it ends. Branches within the crown are not seen at all.

use super::super::raster::Raster;
use super::PlantParams;
use glam::Vec2;

/// Share of the plant's height over which widths of rows are averaged.
const SMOOTH: f32 = 0.015;
/// Least height of a trunk, as a share of the plant's.
const LEAST: f32 = 0.06;
/// Share of the plant's height over which it must be wide for the crown to begin.
const STEADY: f32 = 0.03;
/// How many times as wide as the trunk the crown is where it begins.
const WIDENS: f32 = 1.6;
/// How many times as wide as at its narrowest a trunk is where it is a fan of stems.
const SPREADS: f32 = 2.2;
/// How much wider a run may be by the roughness of the cut alone, pixels.
const ROUGH: f32 = 4.0;
/// Share of a trunk's width from which a part that leaves it is a stem and no twig.
const STEM: f32 = 0.35;
/// Share of the plant's height that grass or a shadow at the foot may take, which is skipped.
const FOOT: f32 = 0.05;
/// Distance of the trunk's points, as a share of the plant's height.
const STEP: f32 = 0.02;
/// How far the trunk is led on into the crown, as a share of the crown's height.
const INTO: f32 = 0.2;

/// The middle line of a trunk.
#[derive(Clone, Debug, PartialEq)]
pub struct TrunkLine {
    /// Places from the foot up, pixels.
    pub points: Vec<Vec2>,
    /// The trunk's width at each of them, pixels.
    pub widths: Vec<f32>,
}

impl TrunkLine {
    /// The same with all lengths times `by`.
    pub(super) fn scaled(&self, by: f32) -> Self {
        Self {
            points: self.points.iter().map(|p| *p * by).collect(),
            widths: self.widths.iter().map(|width| width * by).collect(),
        }
    }
}

/// What a plant's mask is made of.
pub(super) struct Parts {
    pub(super) crown: Raster<bool>,
    /// The pixels of the trunk below the crown.
    pub(super) trunk_mask: Raster<bool>,
    /// Its middle line, led on into the crown.
    pub(super) trunk: Option<TrunkLine>,
}

/// Takes a plant apart.
pub(super) fn parts(mask: &Raster<bool>, params: &PlantParams) -> Parts {
    let all_crown = || Parts { crown: mask.clone(), trunk_mask: mask.map(|_| false), trunk: None };
    let Some(rows) = trunk_rows(mask, params) else { return all_crown() };
    let Some(mut runs) = followed(mask, rows.clone()) else { return all_crown() };
    // A crown that begins pointed is as narrow as a trunk at first, but wider than this one.
    runs.truncate(before_spreading(&runs, (STEADY * mask.height() as f32).ceil() as usize));
    let usual = usual_width(&runs);
    runs.truncate(1 + runs.iter().rposition(|run| run_width(run) <= WIDENS * usual).unwrap_or(0));
    let plant = extent(&row_widths(mask)).map_or(0, |(top, bottom)| bottom - top);
    if (runs.len() as f32) < LEAST * plant as f32 {
        return all_crown();
    }
    let rows = rows.end - runs.len()..rows.end;
    let (mut crown, mut trunk_mask) = (mask.clone(), mask.map(|_| false));
    for (y, (from, to)) in rows.clone().rev().zip(&runs) {
        for x in *from..*to {
            crown[(x, y)] = false;
            trunk_mask[(x, y)] = true;
        }
    }
    // Below the crown nothing else stands but what hangs down beside the trunk.
    if !crown.cells().contains(&true) {
        return all_crown();
    }
    let trunk = line(&crown, rows, &runs);
    Parts { crown, trunk_mask, trunk: Some(trunk) }
}

/// Pixels of the mask in each row.
fn row_widths(mask: &Raster<bool>) -> Vec<f32> {
    let rows = mask.cells().chunks_exact(mask.width());
    rows.map(|row| row.iter().filter(|is_in| **is_in).count() as f32).collect()
}

/// First row that has any, and the row after the last.
fn extent(widths: &[f32]) -> Option<(usize, usize)> {
    let top = widths.iter().position(|width| *width > 0.0)?;
    Some((top, widths.len() - widths.iter().rev().position(|width| *width > 0.0)?))
}

/// The rows in which a plant is trunk.
fn trunk_rows(mask: &Raster<bool>, params: &PlantParams) -> Option<std::ops::Range<usize>> {
    let widths = row_widths(mask);
    let (top, bottom) = extent(&widths)?;
    let height = (bottom - top) as f32;
    let reach = (SMOOTH * height).round() as usize;
    let smooth = |y: usize| {
        let (from, to) = (y.saturating_sub(reach).max(top), (y + reach + 1).min(bottom));
        widths[from..to].iter().sum::<f32>() / (to - from).max(1) as f32
    };
    let smoothed: Vec<f32> = (top..bottom).map(smooth).collect();
    let narrow = params.trunk * smoothed.iter().copied().fold(0.0, f32::max);
    let is_wide = |y: usize| smoothed[y - top] > narrow;
    let skipped = (FOOT * height) as usize;
    let foot = (bottom.saturating_sub(skipped + 1)..bottom).rev().find(|y| !is_wide(*y))? + 1;
    let steady = ((STEADY * height) as usize).max(1);
    let begins_crown = |y: &usize| (y.saturating_sub(steady).max(top)..=*y).all(is_wide);
    let crown = (top..foot).rev().find(begins_crown)?;
    let long = (foot - crown - 1) as f32 >= LEAST * height;
    long.then_some(crown + 1..foot)
}

/// The run of pixels that goes on from row to row, from the lowest up: its first column and the one after its last.
fn followed(mask: &Raster<bool>, rows: std::ops::Range<usize>) -> Option<Vec<(usize, usize)>> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for y in rows.rev() {
        let row: Vec<(usize, usize)> = runs_of(mask, y);
        if runs.last().is_some_and(|below| forks(below, &row)) {
            break;
        }
        let next = match runs.last() {
            None => row.into_iter().max_by_key(|(from, to)| to - from),
            Some((from, to)) => {
                let shared = |run: &(usize, usize)| run.1.min(*to) as isize - run.0.max(*from) as isize;
                row.into_iter().max_by_key(shared).filter(|run| shared(run) > -3)
            }
        };
        // A row that the cut left out is as the one below it.
        runs.push(next.or(runs.last().copied())?);
    }
    Some(runs)
}

/// How many runs from the foot up are trunk, before it becomes a fan of stems that stays several times as wide for so many rows.
fn before_spreading(runs: &[(usize, usize)], steady: usize) -> usize {
    let mean = |k: usize| {
        let near = &runs[k.saturating_sub(2)..(k + 3).min(runs.len())];
        near.iter().map(run_width).sum::<f32>() / near.len() as f32
    };
    let mut least = f32::INFINITY;
    for k in 0..runs.len() {
        least = least.min(mean(k));
        let above = &runs[k..(k + steady).min(runs.len())];
        if above.len() == steady && above.iter().all(|run| run_width(run) > SPREADS * least + ROUGH) {
            return k;
        }
    }
    runs.len()
}

/// Whether a trunk whose run is this becomes several stems in the row above it.
fn forks((from, to): &(usize, usize), row: &[(usize, usize)]) -> bool {
    let above = row.iter().filter(|run| run.0 < *to && run.1 > *from);
    above.filter(|run| run_width(run) >= STEM * (to - from) as f32).count() > 1
}

fn run_width((from, to): &(usize, usize)) -> f32 {
    (to - from) as f32
}

/// The width that a quarter of the runs do not exceed: a foot is wider, and so is what spreads.
fn usual_width(runs: &[(usize, usize)]) -> f32 {
    super::super::background::quantile(runs.iter().map(run_width).collect(), 0.25)
}

fn runs_of(mask: &Raster<bool>, y: usize) -> Vec<(usize, usize)> {
    let (mut runs, mut begun) = (Vec::new(), None);
    for x in 0..=mask.width() {
        match (x < mask.width() && mask[(x, y)], begun) {
            (true, None) => begun = Some(x),
            (false, Some(from)) => {
                runs.push((from, x));
                begun = None;
            }
            _ => {}
        }
    }
    runs
}

/// The middle line of a trunk whose runs these are, from the lowest row up, led on into the crown.
fn line(crown: &Raster<bool>, rows: std::ops::Range<usize>, runs: &[(usize, usize)]) -> TrunkLine {
    let crown_rows = extent(&row_widths(crown)).unwrap_or((0, rows.start));
    let height = (rows.end - crown_rows.0.min(rows.start)) as f32;
    let step = ((STEP * height).round() as usize).max(1);
    let mean = |k: usize, of: fn(&(usize, usize)) -> f32| {
        let near = &runs[k.saturating_sub(step)..(k + step + 1).min(runs.len())];
        near.iter().map(of).sum::<f32>() / near.len() as f32
    };
    let at = |k: usize| {
        Vec2::new(mean(k, |(from, to)| 0.5 * (from + to) as f32), rows.end as f32 - k as f32 - 0.5)
    };
    let places: Vec<usize> = (0..runs.len()).step_by(step).chain([runs.len() - 1]).collect();
    let mut points: Vec<Vec2> = places.iter().map(|k| at(*k)).collect();
    let mut widths: Vec<f32> = places.iter().map(|k| mean(*k, |(from, to)| (to - from) as f32)).collect();
    points.dedup();
    widths.truncate(points.len());
    // On into the crown, toward its middle.
    let cells = crown.cells().iter().enumerate().filter(|(_, is_in)| **is_in);
    let (sum, count) = cells.fold((Vec2::ZERO, 0u32), |(sum, n), (i, _)| (sum + crown.middle(i), n + 1));
    let middle = sum / count.max(1) as f32;
    let (top, width) = (points[points.len() - 1], widths[widths.len() - 1]);
    let way = INTO * (rows.start - crown_rows.0.min(rows.start)) as f32;
    let along = (middle - top).normalize_or(Vec2::NEG_Y);
    let steps = (way / step as f32).ceil() as usize;
    for k in 1..=steps {
        points.push(top + along * (way * k as f32 / steps as f32));
        widths.push(width * (1.0 - 0.3 * k as f32 / steps as f32));
    }
    TrunkLine { points, widths }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    /// A round crown on a trunk that leans.
    fn tree(trunk_width: f32) -> Raster<bool> {
        let mut mask = Raster::filled(UVec2::new(200, 300), false);
        for i in 0..mask.cells().len() {
            let at = mask.middle(i);
            let on_trunk = (at.x - 100.0 - 0.1 * (280.0 - at.y)).abs() < 0.5 * trunk_width
                && at.y > 100.0
                && at.y < 280.0;
            mask.cells_mut()[i] = on_trunk || at.distance(Vec2::new(110.0, 100.0)) < 80.0;
        }
        mask
    }

    #[test]
    fn a_tree_has_a_crown_and_a_trunk_with_its_width() {
        let parts = parts(&tree(14.0), &PlantParams::default());
        let trunk = parts.trunk.unwrap();
        assert!(trunk.points[0].distance(Vec2::new(100.0, 280.0)) < 4.0, "{}", trunk.points[0]);
        for (p, width) in trunk.points.iter().zip(&trunk.widths).filter(|(p, _)| p.y > 185.0) {
            assert!((p.x - 100.0 - 0.1 * (280.0 - p.y)).abs() < 1.5, "{p}");
            assert!((width - 14.0).abs() < 2.0, "{width} at {p}");
        }
        let end = trunk.points[trunk.points.len() - 1];
        assert!(end.y < 165.0 && end.distance(Vec2::new(110.0, 100.0)) < 80.0, "{end}");
        let count = parts.crown.cells().iter().filter(|is_in| **is_in).count() as f32;
        assert!((count / (std::f32::consts::PI * 6400.0) - 1.0).abs() < 0.05, "{count}");
    }

    #[test]
    fn a_trunk_ends_where_it_forks() {
        let mut mask = tree(14.0);
        for y in 200..240 {
            let middle = 100.0 + 0.1 * (280.0 - y as f32);
            let half = 0.25 * (240 - y) as f32;
            for x in 60..150 {
                let off = (x as f32 + 0.5 - middle).abs();
                mask[(x, y)] = (half..half + 7.0).contains(&off);
            }
        }
        let trunk = parts(&mask, &PlantParams::default()).trunk.unwrap();
        let width = trunk.widths.iter().copied().fold(0.0, f32::max);
        let visible = trunk.points.iter().filter(|p| p.y > 228.0).count();
        assert!(width < 18.0 && visible >= 5, "{width} {visible}");
    }

    #[test]
    fn a_fan_of_stems_is_trunk_only_at_its_foot() {
        let mut mask = tree(14.0);
        for y in 180..262 {
            let (middle, half) = (100.0 + 0.1 * (280.0 - y as f32), 7.0 + 0.45 * (262 - y) as f32);
            (40..180).for_each(|x| mask[(x, y)] = (x as f32 + 0.5 - middle).abs() < half);
        }
        let trunk = parts(&mask, &PlantParams { trunk: 0.6, ..PlantParams::default() }).trunk.unwrap();
        assert!(trunk.usual_width() < 26.0, "{}", trunk.usual_width());
        assert!((trunk.points[0].x - 100.0).abs() < 4.0 && trunk.points.len() > 3);
    }

    #[test]
    fn a_bush_is_all_crown() {
        let mut mask = Raster::filled(UVec2::new(200, 300), false);
        for i in 0..mask.cells().len() {
            let off = mask.middle(i) - Vec2::new(100.0, 290.0);
            mask.cells_mut()[i] = off.y < 0.0 && (off / Vec2::new(80.0, 150.0)).length() < 1.0;
        }
        let parts = parts(&mask, &PlantParams::default());
        assert!(parts.trunk.is_none() && parts.crown == mask);
        assert!(super::parts(&mask.map(|_| false), &PlantParams::default()).trunk.is_none());
        assert!(super::parts(&tree(90.0), &PlantParams::default()).trunk.is_none());
    }
}
