//! Lines cut into what tapers to a tip: blades of grass above their ground, fronds about the top of a trunk.
//!
//! How far points are from the base, a height above the ground or a distance from a place, goes up and down along a line. A
//! [`Spike`] is one local maximum with the flanks on its two sides, as far as the next minima; an end of a line that is a maximum
//! has one flank only. Changes below a prominence are the hand's. Two flanks of different lines whose ends meet are one spike.
//!
//! The blade of a spike runs in the middle between its flanks, which are paired by arc length from the tip down, and goes on
//! to its root. It is as wide as its flanks are apart, within limits that the caller gives; narrower toward the root, where
//! flanks of neighbours touch, but blades have necks.

use crate::geom::polyline;
use glam::Vec2;

/// Points of a blade's centre line.
const POINTS: usize = 24;
/// Distance between the ends of a line that is closed, as a share of its length.
const CLOSED: f32 = 0.03;
/// How far the ends of two flanks may be apart for one tip, as a share of the shorter.
const MEETING: f32 = 0.16;
/// Most that an arc turns, radians.
const ARC: f32 = 5.0;
/// Angle from which on a tip is blunt, radians.
const BLUNT: f32 = 1.6;
/// Widest angle of a fold, and where it is measured, as a share of the shorter flank.
const FOLD: (f32, f32) = (1.0, 0.12);
/// Flanks whose lengths differ by more are paired as far down as the shorter goes.
const ALIKE: f32 = 0.6;
/// Most width of an arch near its foot, in its widths halfway up.
const ARCH: f32 = 1.15;
/// Half width of a blade that one line stands for, as a share of its length.
const LINE_HALF: f32 = 0.035;
/// Where a blade is widest, as a share of its length, and the share of that width at its root.
const WIDEST: (f32, f32) = (0.3, 0.4);

/// Something with a tip.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spike {
    /// One or two flanks, from the tip down.
    pub flanks: Vec<Vec<Vec2>>,
}

/// Indices of alternating extremes of a sequence of heights, each at least `prominence` from the next; and whether the first is
/// low. Nothing where the heights do not change by as much.
pub(crate) fn extremes(heights: &[f32], prominence: f32) -> (Vec<usize>, bool) {
    let (mut low, mut high) = (0, 0);
    let mut found = Vec::new();
    let (mut rises, mut begins_low) = (None, false);
    for (i, &height) in heights.iter().enumerate() {
        if height > heights[high] {
            high = i;
        }
        if height < heights[low] {
            low = i;
        }
        if rises != Some(true) && height - heights[low] >= prominence {
            begins_low |= rises.is_none();
            found.push(low);
            (rises, high) = (Some(true), i);
        } else if rises != Some(false) && heights[high] - height >= prominence {
            found.push(high);
            (rises, low) = (Some(false), i);
        }
    }
    match rises {
        Some(true) => found.push(high),
        Some(false) => found.push(low),
        None => {}
    }
    (found, begins_low)
}

/// The spikes of a line, in its order; of a closed one from its lowest point on.
pub(crate) fn spikes(points: &[Vec2], height: impl Fn(Vec2) -> f32, prominence: f32) -> Vec<Spike> {
    let closed = closed_from_below(points, &height);
    let points = closed.as_deref().unwrap_or(points);
    let heights: Vec<f32> = points.iter().map(|p| height(*p)).collect();
    let (found, begins_low) = extremes(&heights, prominence);
    let first_tip = usize::from(begins_low);
    let flanks = |k: usize| {
        let before = k.checked_sub(1).map(|b| points[found[b]..=found[k]].iter().rev().copied().collect());
        let after = found.get(k + 1).map(|a| points[found[k]..=*a].to_vec());
        Spike { flanks: before.into_iter().chain(after).collect() }
    };
    (first_tip..found.len()).step_by(2).map(flanks).collect()
}

fn is_closed(points: &[Vec2]) -> bool {
    let ends = points.first().zip(points.last());
    ends.is_some_and(|(first, last)| first.distance(*last) <= CLOSED * polyline::length(points))
}

/// A line whose ends meet, beginning at its lowest point and ending there again.
pub(crate) fn closed_from_below(points: &[Vec2], height: impl Fn(Vec2) -> f32) -> Option<Vec<Vec2>> {
    if !is_closed(points) {
        return None;
    }
    let lowest = points.iter().enumerate().min_by(|a, b| height(*a.1).total_cmp(&height(*b.1)))?.0;
    let mut turned = points.to_vec();
    turned.rotate_left(lowest);
    turned.push(turned[0]);
    Some(turned)
}

/// Spikes in the order of `key`, those with one flank joined in twos where their tips meet, with the numbers of their lines.
pub(crate) fn joined(mut spikes: Vec<(Spike, usize)>, key: impl Fn(Vec2) -> f32) -> Vec<(Spike, Vec<usize>)> {
    spikes.sort_by(|a, b| key(a.0.tip()).total_cmp(&key(b.0.tip())));
    let mut is_taken = vec![false; spikes.len()];
    let mut out = Vec::new();
    for i in 0..spikes.len() {
        if std::mem::replace(&mut is_taken[i], true) {
            continue;
        }
        let (spike, line) = &spikes[i];
        let near = i + 1..spikes.len().min(i + 5);
        let partners = near.filter(|j| !is_taken[*j] && spikes[*j].1 != *line && spike.meets(&spikes[*j].0));
        let gap = |j: &usize| spike.tip().distance(spikes[*j].0.tip());
        let partner = partners.min_by(|a, b| gap(a).total_cmp(&gap(b)));
        out.push(match partner {
            Some(j) => {
                is_taken[j] = true;
                let flanks = vec![spike.flanks[0].clone(), spikes[j].0.flanks[0].clone()];
                (Spike { flanks }, vec![*line, spikes[j].1])
            }
            None => (spike.clone(), vec![*line]),
        });
    }
    out
}

impl Spike {
    /// The farthest point from the base.
    pub(crate) fn tip(&self) -> Vec2 {
        let sum: Vec2 = self.flanks.iter().map(|flank| flank[0]).sum();
        sum / self.flanks.len() as f32
    }

    /// Middle of the lower ends of its flanks.
    pub(crate) fn foot(&self) -> Vec2 {
        let sum: Vec2 = self.flanks.iter().map(|flank| flank[flank.len() - 1]).sum();
        sum / self.flanks.len() as f32
    }

    /// Distance from foot to tip of the longer flank.
    pub(crate) fn reach(&self) -> f32 {
        let chord = |flank: &Vec<Vec2>| flank[0].distance(flank[flank.len() - 1]);
        self.flanks.iter().map(chord).fold(0.0, f32::max)
    }

    /// Length of its flanks together.
    pub(crate) fn length(&self) -> f32 {
        self.flanks.iter().map(|flank| polyline::length(flank)).sum()
    }

    /// Angle between the two flanks, measured from the tip at a share of the shorter flank, radians; none with one flank.
    pub(crate) fn angle(&self, share: f32) -> Option<f32> {
        let [a, b] = &self.flanks[..] else { return None };
        let away = share * polyline::length(a).min(polyline::length(b));
        Some((at(a, away) - self.tip()).angle_to(at(b, away) - self.tip()).abs())
    }

    /// The spike of something that bends back toward the base: where it is blunt, its tip is the far end of the line that it is
    /// cut from, or the sharp fold of that if it is closed.
    pub(crate) fn hanging(self, line: &[Vec2], base: Vec2, deep: f32) -> Self {
        let ([a, b], Some(angle)) = (&self.flanks[..], self.angle(FOLD.1)) else { return self };
        if angle < BLUNT {
            return self;
        }
        let whole: Vec<Vec2> = a.iter().rev().chain(b.iter().skip(1)).copied().collect();
        let far = deep * self.tip().distance(base);
        let is_far = |p: Vec2| p.distance(base) > far;
        let (first, last) = (line[0], line[line.len() - 1]);
        if is_closed(line) {
            let window = ((FOLD.1 * a.len().min(b.len()) as f32) as usize).max(2);
            let turn = |k: usize| (whole[k - window] - whole[k]).angle_to(whole[k + window] - whole[k]).abs();
            let inner = (window..whole.len().saturating_sub(window)).filter(|k| is_far(whole[*k]));
            let fold = inner.min_by(|j, k| turn(*j).total_cmp(&turn(*k))).filter(|k| turn(*k) < FOLD.0);
            let cut = |k: usize| vec![whole[..=k].iter().rev().copied().collect(), whole[k..].to_vec()];
            return fold.map(|k| Self { flanks: cut(k) }).unwrap_or(self);
        }
        if whole[0] == first && is_far(first) && !is_far(whole[whole.len() - 1]) {
            return Self { flanks: vec![whole] };
        }
        if whole[whole.len() - 1] == last && is_far(last) && !is_far(whole[0]) {
            return Self { flanks: vec![whole.into_iter().rev().collect()] };
        }
        self
    }

    /// Whether the flanks run straight or bend to one side, turning no more than `against` to the other, and two of them run side
    /// by side, `widest` of the reach apart.
    pub(crate) fn is_slender(&self, widest: f32, against: f32) -> bool {
        let apart = || self.rows().iter().filter_map(|row| row.1).sum::<f32>() / POINTS as f32;
        self.flanks.iter().all(|flank| is_arc(flank, against)) && apart() < widest * self.reach()
    }

    /// Whether two single flanks end in one tip, toward which they come together.
    fn meets(&self, other: &Spike) -> bool {
        let ([a], [b]) = (&self.flanks[..], &other.flanks[..]) else { return false };
        let reach = self.reach().min(other.reach());
        let gap = a[0].distance(b[0]);
        // Apart at the foot, or in the middle of a blade whose sides meet there again.
        let apart = |share: f32| even_at(a, share).distance(even_at(b, share));
        gap < MEETING * reach && gap < 0.7 * apart(1.0).max(apart(0.5))
    }

    /// Middle and half distance of the flanks from below to the tip, as far down as both go; no distance where there is one.
    fn rows(&self) -> Vec<(Vec2, Option<f32>)> {
        let lengths: Vec<f32> = self.flanks.iter().map(|flank| polyline::length(flank)).collect();
        let shortest = lengths.iter().copied().fold(f32::INFINITY, f32::min);
        let length = |k: usize| if lengths[k] * ALIKE > shortest { shortest } else { lengths[k] };
        let mut first = even_to(&self.flanks[0], length(0));
        first.reverse();
        let Some(flank) = self.flanks.get(1) else { return first.into_iter().map(|p| (p, None)).collect() };
        let mut second = even_to(flank, length(1));
        second.reverse();
        first.iter().zip(&second).map(|(a, b)| (a.midpoint(*b), Some(0.5 * a.distance(*b)))).collect()
    }

    /// Whether its flanks do not come apart toward the foot: the outline of a blade that is open below.
    pub(crate) fn is_arch(&self) -> bool {
        let rows = self.rows();
        let half = |k: usize| rows[k].1.unwrap_or(0.0);
        half(POINTS / 8) < ARCH * half(POINTS / 2)
    }

    /// Where the middle of its flanks ends below, and the direction in which it goes there from the tip, not of unit length.
    pub(crate) fn lower_end(&self) -> (Vec2, Vec2) {
        let low = self.rows()[0].0;
        (low, low - self.tip())
    }

    /// The outline of a blade from `root` to the tip and back, at most `most` of its length wide to each side.
    pub(crate) fn blade(&self, root: Vec2, most: f32) -> Vec<Vec2> {
        let mut rows = self.rows();
        rows.insert(0, (root, rows[0].1));
        let centre: Vec<Vec2> = rows.iter().map(|row| row.0).collect();
        let arcs = polyline::arc_lengths(centre.iter().copied());
        let length = arcs[arcs.len() - 1];
        let row = |k: usize| {
            let share = k as f32 / (POINTS - 1) as f32;
            let (i, t) = polyline::locate(&arcs, share * length);
            let drawn = rows[i].1.zip(rows[i + 1].1).map(|(a, b)| (a + t * (b - a)) / length);
            (polyline::interpolate(&centre, (i, t)), half_width(drawn, share, most) * length)
        };
        let even: Vec<(Vec2, f32)> = (0..POINTS).map(row).collect();
        let side = |k: usize, sign: f32| {
            let along = even[(k + 1).min(POINTS - 1)].0 - even[k.saturating_sub(1)].0;
            even[k].0 + sign * even[k].1 * along.normalize_or_zero().perp()
        };
        (0..POINTS).map(|k| side(k, 1.0)).chain((0..POINTS).rev().map(|k| side(k, -1.0))).collect()
    }
}

/// Half width of a blade at a share of its length, as a share of that: what was drawn, none for a single line.
fn half_width(drawn: Option<f32>, share: f32, most: f32) -> f32 {
    let root = WIDEST.1 + (1.0 - WIDEST.1) * (share / WIDEST.0).min(1.0);
    let above = ((share - WIDEST.0) / (1.0 - WIDEST.0)).max(0.0);
    let taper = (1.0 - above * above) * root;
    let line = LINE_HALF * taper;
    drawn.map_or(line, |drawn| (drawn * root).min(most * taper).max(0.5 * line))
}

/// Whether a flank is straight or bends to one side; near its foot it may lead around the base.
fn is_arc(flank: &[Vec2], against: f32) -> bool {
    let upper = even_to(flank, 0.8 * polyline::length(flank));
    let turns = upper.windows(3).map(|w| (w[1] - w[0]).angle_to(w[2] - w[1]));
    let (to_left, to_right) =
        turns.fold((0.0, 0.0), |(l, r), turn: f32| (l + turn.max(0.0), r - turn.min(0.0)));
    to_left.max(to_right) < ARC.max(against) && to_left.min(to_right) < against
}

/// The first so many pixels of a line at [`POINTS`] even steps.
fn even_to(points: &[Vec2], length: f32) -> Vec<Vec2> {
    let arcs = polyline::arc_lengths(points.iter().copied());
    let at = |k: usize| polyline::locate(&arcs, length * k as f32 / (POINTS - 1) as f32);
    (0..POINTS).map(|k| polyline::interpolate(points, at(k))).collect()
}

/// The point of a line after a share of its points.
fn even_at(points: &[Vec2], share: f32) -> Vec2 {
    points[(share * (points.len() - 1) as f32) as usize]
}

/// The point of a line so far from its beginning.
fn at(points: &[Vec2], arc: f32) -> Vec2 {
    let arcs = polyline::arc_lengths(points.iter().copied());
    polyline::interpolate(points, polyline::locate(&arcs, arc))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn up(p: Vec2) -> f32 {
        -p.y
    }

    fn zigzag() -> Vec<Vec2> {
        let corners: Vec<Vec2> =
            (0..7).map(|k| Vec2::new(10.0 * k as f32, if k % 2 == 0 { 0.0 } else { -40.0 })).collect();
        crate::anatomy::conventions::page::even(&corners, 300)
    }

    #[test]
    fn a_zigzag_has_a_spike_for_each_tip() {
        let found = spikes(&zigzag(), up, 5.0);
        assert_eq!(found.len(), 3);
        assert!(found.iter().all(|spike| spike.flanks.len() == 2));
        assert!(found[1].tip().distance(Vec2::new(30.0, -40.0)) < 1.0, "{}", found[1].tip());
        assert!(found[1].foot().distance(Vec2::new(30.0, 0.0)) < 1.0, "{}", found[1].foot());
        assert!(found[1].angle(0.3).is_some_and(|angle| (angle - 2.0 * 0.25_f32.atan()).abs() < 0.05));
    }

    #[test]
    fn ripples_are_no_spikes() {
        let ripples: Vec<Vec2> = (0..100).map(|k| Vec2::new(k as f32, (k as f32 * 0.7).sin())).collect();
        assert!(spikes(&ripples, up, 3.0).is_empty());
    }

    #[test]
    fn a_closed_line_has_no_single_flanks_wherever_it_begins() {
        for begin in [0, 30, 77, 140] {
            let mut points = zigzag();
            let (first, last) = (points[0], points[points.len() - 1]);
            points.extend((1..100).map(|k| last.lerp(first, k as f32 / 100.0) + Vec2::Y));
            points.rotate_left(begin);
            points.push(points[0]);
            let found = spikes(&points, up, 5.0);
            assert_eq!(
                found.iter().map(|spike| spike.flanks.len()).collect::<Vec<_>>(),
                [2, 2, 2],
                "{begin}"
            );
        }
    }

    #[test]
    fn arcs_that_meet_in_a_tip_are_one() {
        let arc = |foot: f32| vec![Vec2::new(0.0, -40.0), Vec2::new(0.7 * foot, -20.0), Vec2::new(foot, 0.0)];
        let single = |foot: f32| Spike { flanks: vec![arc(foot)] };
        let met = joined(vec![(single(-8.0), 3), (single(8.0), 5)], |tip| tip.x);
        assert_eq!(met.len(), 1);
        assert_eq!((met[0].0.flanks.len(), &met[0].1[..]), (2, &[3, 5][..]));
        let far = Spike { flanks: vec![arc(8.0).iter().map(|p| p + Vec2::X * 20.0).collect()] };
        assert_eq!(joined(vec![(single(-8.0), 3), (far, 5)], |tip| tip.x).len(), 2);
    }

    #[test]
    fn a_blade_goes_from_its_root_to_its_tip_and_back_and_is_as_wide_as_drawn() {
        let spike = &spikes(&zigzag(), up, 5.0)[1];
        let root = Vec2::new(30.0, 10.0);
        let outline = spike.blade(root, 0.5);
        assert!(outline[0].midpoint(outline[outline.len() - 1]).distance(root) < 0.5);
        assert!(outline[POINTS - 1].distance(spike.tip()) < 1.5, "{}", outline[POINTS - 1]);
        let at = |y: f32| {
            outline.iter().filter(|p| (p.y - y).abs() < 1.2).map(|p| (p.x - 30.0).abs()).fold(0.0, f32::max)
        };
        assert!((at(-20.0) - 5.0).abs() < 1.0, "{}", at(-20.0));
        let thin = spike.blade(root, 0.05);
        let widest = thin.iter().map(|p| (p.x - 30.0).abs()).fold(0.0, f32::max);
        assert!(widest < 0.05 * 50.0 + 0.1, "{widest}");
    }

    #[test]
    fn what_winds_is_not_slender() {
        let wavy: Vec<Vec2> = (0..80).map(|k| Vec2::new(4.0 * (k as f32 * 0.4).sin(), -(k as f32))).collect();
        assert!(!Spike { flanks: vec![wavy] }.is_slender(0.3, 1.2));
        let arc: Vec<Vec2> = (0..80).map(|k| 50.0 * Vec2::from_angle(k as f32 * 0.03)).collect();
        assert!(Spike { flanks: vec![arc] }.is_slender(0.3, 1.2));
    }

    #[test]
    fn the_tip_of_what_hangs_is_its_far_end_or_its_fold() {
        // Up and over: farthest from the base before its end.
        let over = |k: usize| Vec2::new(1.5 * k as f32, -60.0 * (k as f32 * 0.045).sin());
        let line: Vec<Vec2> = (0..=60).map(over).collect();
        let away = |p: Vec2| p.length();
        let found = spikes(&line, away, 4.0);
        let tip = |line: &[Vec2]| {
            let all = spikes(line, away, 4.0).into_iter().map(|spike| spike.hanging(line, Vec2::ZERO, 0.5));
            all.map(|spike| (spike.tip(), spike.flanks.len())).collect::<Vec<_>>()
        };
        assert_eq!(found.len(), 1);
        assert_eq!(tip(&line), [(line[60], 1)]);
        let inner = line.iter().rev().skip(1).map(|p| 0.85 * *p + Vec2::new(0.0, 4.0 * p.length() / 90.0));
        let closed: Vec<Vec2> = line.iter().copied().chain(inner).collect();
        let hanging = tip(&closed);
        assert!(
            hanging.len() == 1 && hanging[0].1 == 2 && hanging[0].0.distance(line[60]) < 8.0,
            "{hanging:?}"
        );
    }
}
