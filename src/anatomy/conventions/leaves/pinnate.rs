//! A frond of single lines: leaflets close together on both sides of a rachis, as a fern's.
//!
//! The rachis is the longest line of a group. All other lines are its leaflets: nearly straight, each from the rachis outward and
//! toward its tip, side by side, much shorter than the rachis, and shorter toward its tip than in its middle. Each becomes a blade along its line.
//!
//! A bare tree has fewer twigs, of which some carry others, and those of a fir point down or stand about an upright trunk
//! ([`conifer`](crate::anatomy::conventions::trees::conifer) comes first there). Hairs and ticks are shorter beside their line.
//!
//! Limits: leaflets on one side only, several fronds that touch.

use crate::anatomy::conventions::flowers::rays::blade;
use crate::anatomy::conventions::page::{Line, Page, even, median};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Fewest leaflets of each side, and most lines of a group.
const LEAFLETS: (usize, usize) = (4, 120);
/// Least chord of the rachis and of a leaflet over their lengths.
const STRAIGHT: (f32, f32) = (0.7, 0.85);
/// How near a leaflet begins to the rachis, as a share of its length; length of one at most and of the middle one at least, as shares
/// of the rachis'.
const AT: f32 = 0.2;
const LENGTH: (f32, f32) = (0.5, 0.07);
/// Least cosine between a leaflet and the way of the rachis to its tip.
const FORWARD: f32 = -0.2;
/// Widest gap between neighbours on one side, in middle gaps, and the middle gap, as a share of the middle leaflet.
const GAPS: (f32, f32) = (3.0, 0.7);
/// Length of the last three leaflets of a side, as a share of the middle one, at most.
const TAPERS: f32 = 0.85;
/// How far a rachis that is no fir's trunk is from straight and upright: most chord over its length, and least lean, as a slope.
const NO_TRUNK: (f32, f32) = (0.975, 0.3);
/// Half the width of a leaflet in gaps, as a share of its length at most, and its points.
const HALF: (f32, f32) = (0.5, 0.16);
const POINTS: usize = 12;
/// Log-odds, and of a rachis that stands upright.
const SCORE: (f32, f32) = (8.5, 3.0);

/// Proposes a frond for each group of lines that is one.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let is_many = |group: &&Vec<usize>| (2 * LEAFLETS.0 + 1..=LEAFLETS.1).contains(&group.len());
    out.extend(page.groups.iter().filter(is_many).filter_map(|group| frond(page, group)));
}

/// A line from the rachis outward.
struct Leaflet {
    points: Vec<Vec2>,
    length: f32,
    /// Where along the rachis it begins, pixels from its foot.
    root: f32,
    /// On which side: 1 to the left of the way to the tip, seen with y up.
    side: f32,
}

fn frond(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let length = |i: &usize| page.lines[*i].length;
    let number = group.iter().copied().max_by(|a, b| length(a).total_cmp(&length(b)))?;
    let rachis = &page.lines[number];
    if rachis.ends().0.distance(rachis.ends().1) < STRAIGHT.0 * rachis.length {
        return None;
    }
    let others = || group.iter().copied().filter(|i| *i != number);
    let along = |way: &[Vec2]| -> Option<Vec<Leaflet>> {
        others().map(|i| Leaflet::new(&page.lines[i], way, rachis.length)).collect()
    };
    let mut way = rachis.points.clone();
    let leaflets = along(&way).filter(|all| are_pinnate(all)).or_else(|| {
        way.reverse();
        along(&way).filter(|all| are_pinnate(all))
    })?;
    let (foot, tip) = (way[0], way[way.len() - 1]);
    let is_trunk = rachis.length * NO_TRUNK.0 < foot.distance(tip)
        && (tip.x - foot.x).abs() < NO_TRUNK.1 * (tip.y - foot.y).abs();
    let score = if is_trunk { SCORE.1 } else { SCORE.0 };
    let gap = middle_gap(&leaflets, 1.0).max(middle_gap(&leaflets, -1.0));
    let blades = leaflets.iter().map(|leaflet| leaflet.blade(gap));
    let parts = std::iter::once(Made::new(Tool::Branch, way)).chain(blades).collect();
    Some(Hypothesis {
        uses: group.to_vec(),
        score: score * page.weight(rachis.size().length()),
        parts,
        solids: Vec::new(),
        reading: Reading::Leaf,
        habit: None,
    })
}

impl Leaflet {
    /// A line as a leaflet of a rachis from its foot to its tip.
    fn new(line: &Line, way: &[Vec2], long: f32) -> Option<Self> {
        let nearest = |p: Vec2| polyline::nearest(way, p);
        let mut points = line.points.clone();
        let (first, last) = (nearest(points[0])?, nearest(points[points.len() - 1])?);
        let (gap, root) = if first.0 < last.0 {
            first
        } else {
            points.reverse();
            last
        };
        let chord = points[points.len() - 1] - points[0];
        let at = way.len() - 1;
        let k = ((root / long * at as f32) as usize).min(at);
        let forward = (way[(k + 2).min(at)] - way[k.saturating_sub(2)]).normalize_or_zero();
        let is_one = gap < AT * line.length
            && first.0.max(last.0) > 0.4 * line.length
            && chord.length() > STRAIGHT.1 * line.length
            && line.length < LENGTH.0 * long
            && chord.normalize_or_zero().dot(forward) > FORWARD;
        is_one.then(|| Self { length: line.length, root, side: forward.perp_dot(chord).signum(), points })
    }

    /// Its blade where leaflets are so far apart.
    fn blade(&self, gap: f32) -> Made {
        let half = (HALF.0 * gap).min(HALF.1 * self.length);
        Made::new(Tool::Leaf, blade(&even(&self.points, POINTS), half))
    }
}

/// Whether leaflets stand close together on both sides and become shorter toward the tip.
fn are_pinnate(leaflets: &[Leaflet]) -> bool {
    let long = median(&mut leaflets.iter().map(|leaflet| leaflet.length).collect::<Vec<_>>());
    let reach = leaflets.iter().map(|leaflet| leaflet.root).fold(0.0, f32::max);
    let is_row = |side: f32| {
        let mut row: Vec<&Leaflet> = leaflets.iter().filter(|leaflet| leaflet.side == side).collect();
        row.sort_by(|a, b| a.root.total_cmp(&b.root));
        if row.len() < LEAFLETS.0 {
            return false;
        }
        let middle = middle_gap(leaflets, side);
        let widest = row.windows(2).map(|pair| pair[1].root - pair[0].root).fold(0.0, f32::max);
        let last = row[row.len() - 3..].iter().map(|leaflet| leaflet.length).sum::<f32>() / 3.0;
        middle < GAPS.1 * long && widest < GAPS.0 * middle && last < TAPERS * long
    };
    long > LENGTH.1 * reach && is_row(1.0) && is_row(-1.0)
}

/// The middle distance of neighbours on a side, pixels; 0 of fewer than two.
fn middle_gap(leaflets: &[Leaflet], side: f32) -> f32 {
    let mut roots: Vec<f32> =
        leaflets.iter().filter(|leaflet| leaflet.side == side).map(|leaflet| leaflet.root).collect();
    roots.sort_by(f32::total_cmp);
    let mut gaps: Vec<f32> = roots.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if gaps.is_empty() { 0.0 } else { median(&mut gaps) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// A rachis that leans or stands upright, with so many leaflets on each side, of lengths along it.
    fn frond(lean: f32, count: usize, length: impl Fn(f32) -> f32) -> Vec<Vec<Vec2>> {
        let at = |t: f32| Vec2::new(lean * 200.0 * t * t, -200.0 * t);
        let leaflet = |side: f32, t: f32| {
            let way = (at(t + 0.01) - at(t)).normalize();
            let out = (way + side * way.perp()).normalize() * length(t);
            line(&[at(t).into(), (at(t) + out).into()])
        };
        let share = |k: usize| 0.15 + 0.8 * k as f32 / count as f32;
        let rachis = (0..=40).map(|k| at(k as f32 / 40.0)).collect();
        let leaflets = (0..count).flat_map(|k| [1.0, -1.0].map(|side| leaflet(side, share(k))));
        std::iter::once(rachis).chain(leaflets).collect()
    }

    #[test]
    fn leaflets_along_a_bent_rachis_are_blades_of_a_frond() {
        let found = read(&frond(0.8, 12, |t| 60.0 * (1.05 - t)));
        let [fern] = &found[..] else { panic!("{} fronds", found.len()) };
        assert_eq!((fern.uses.len(), fern.parts.len()), (25, 25));
        assert!(fern.parts[1..].iter().all(|part| part.tool == Tool::Leaf));
        let upright = read(&frond(0.0, 12, |t| 60.0 * (1.05 - t)));
        assert!(upright[0].score < 0.5 * fern.score, "as likely a fir");
    }

    #[test]
    fn twigs_hairs_and_twigs_on_twigs_are_no_leaflets() {
        assert!(read(&frond(0.8, 3, |t| 60.0 * (1.05 - t))).is_empty(), "few");
        assert!(read(&frond(0.8, 12, |_| 40.0)).is_empty(), "as long at the tip");
        assert!(read(&frond(0.8, 12, |t| 12.0 * (1.05 - t))).is_empty(), "hairs");
        let mut twigs = frond(0.8, 12, |t| 60.0 * (1.05 - t));
        let on_twig = twigs[1][twigs[1].len() / 2];
        twigs.push(line(&[on_twig.into(), (on_twig + Vec2::new(12.0, -30.0)).into()]));
        assert!(read(&twigs).is_empty());
    }
}
