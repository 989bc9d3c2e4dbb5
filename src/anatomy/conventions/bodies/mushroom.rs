//! A mushroom: a smooth cap, broad below, on a thick stalk.
//!
//! It is what a tree would be ([`trunk`](super::trunk)) but for its crown, which has no notches, is wider than high and nearly as
//! wide at its foot as anywhere. Stalk and cap become one body of revolution: a branch up the middle, as thick at each height as
//! was drawn. A zigzag of grass across its foot is not part of it. Limits: caps that lean are made upright.

use crate::anatomy::conventions::page::{Line, Page, notches};
use crate::anatomy::conventions::shapes::outline::width_at;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, smooth_contour};
use crate::anatomy::conventions::shapes::teeth::is_row_of_teeth;
use crate::anatomy::conventions::trees::evidence;
use crate::anatomy::conventions::trees::evidence::ramp;
use crate::anatomy::conventions::trees::stacked::stacked;
use crate::anatomy::conventions::trees::tilted;
use crate::anatomy::conventions::trees::trunk::{Rows, Trunk};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::sketch::Reading;
use glam::Vec2;

/// Least width of a cap, in its heights, and where it speaks for one most.
const WIDE: (f32, f32) = (0.95, 1.8);
/// Width near the foot of a cap that is no wider than this, in its heights, least, as a share of its width.
const DOME: (f32, f32, f32) = (1.15, 0.08, 0.9);
/// Height above the cap's foot, as a share of its height, and least width there, as a share of its width.
const BROAD: (f32, f32) = (0.25, 0.7);
/// Where the rim of a cap is: least distance from its middle, as a share of its width, and most height above its foot.
const RIM: (f32, f32) = (0.36, 0.6);
/// Fewest caps that are looked at one by one, and most; how far below a cap its stalk begins at most and ends at least, as a share of the
/// cap's height.
const CAPS: (usize, usize) = (2, 24);
const UNDER: f32 = 0.3;
/// Widest line of a stalk, as a share of the cap's width: petals side by side are as wide as one another.
const NARROWER: f32 = 0.7;
/// Least length of a line that is both sides of a stalk, in diagonals of its bounds.
const SIDES: f32 = 1.5;
/// Fewest notches of a line that draws the lobes of a crown.
const LOBES: usize = 4;
/// Thinnest stalk, as a share of the cap's width.
const STALK: f32 = 0.08;
/// Least width of a cap, as a share of the whole.
const WHOLE: f32 = 0.85;
/// Least width of a hole in a trunk, in half widths of that.
const HOLLOW: f32 = 0.4;
/// Least hull of a scribble, as a share of the whole's bounds.
const SCRIBBLE: f32 = 0.1;
/// How wide gaps of the outline are closed, in cells of the silhouette.
const BRIDGE: i32 = 10;
/// Points of the cap's outline, and rows of the cap.
const POINTS: (usize, usize) = (160, 24);
/// Height above the cap's foot, as a share of its height, and width there, as a share of its own, that ovals have, and that with a level
/// underside.
const FLAT: (f32, (f32, f32)) = (0.15, (0.7, 0.88));
/// Log-odds of a mushroom, and more for the widest caps, for those with a level underside, and for those that lean.
const SCORE: (f32, f32, f32, f32) = (2.9, 1.0, 1.4, -0.3);

/// Proposes mushrooms, one for each group of lines at most.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let stacked = stacked(page);
    let in_grass = in_grass(page);
    let under_caps = under_caps(page);
    let groups =
        page.groups.iter().chain(&page.wide_groups).chain(&stacked).chain(&in_grass).chain(&under_caps);
    out.extend(groups.filter_map(|group| mushroom(page, group)));
}

/// Groups of lines that touch one another where a zigzag of grass runs across their feet, without that.
fn in_grass(page: &Page) -> Vec<Vec<usize>> {
    let rows: Vec<usize> =
        (0..page.lines.len()).filter(|i| !page.is_apart(*i) && is_row_of_teeth(&page.lines[*i])).collect();
    if rows.is_empty() { Vec::new() } else { page.groups_without(rows.into_iter()) }
}

/// Each of several caps with what stands under it: mushrooms that touch one another.
fn under_caps(page: &Page) -> Vec<Vec<usize>> {
    let is_cap = |i: &usize| {
        let line = &page.lines[*i];
        line.is_closed_and_solid() && line.size().x > WIDE.0 * line.size().y
    };
    let caps: Vec<usize> = (0..page.lines.len()).filter(|i| !page.is_apart(*i)).filter(is_cap).collect();
    if !(CAPS.0..=CAPS.1).contains(&caps.len()) {
        return Vec::new();
    }
    let under = |cap: usize| {
        let ((low, high), size) = (page.lines[cap].bounds, page.lines[cap].size());
        let stands = |i: &usize| {
            let (from, to) = page.lines[*i].bounds;
            let (width, height) = (to.x - from.x, to.y - from.y);
            from.x > low.x
                && to.x < high.x
                && width < height.min(NARROWER * size.x)
                && (low.y + 0.4 * size.y..high.y + UNDER * size.y).contains(&from.y)
                && to.y > high.y + UNDER * size.y
        };
        let stalk = (0..page.lines.len()).filter(|i| *i != cap && !page.is_apart(*i)).filter(stands);
        let mut all: Vec<usize> = stalk.chain([cap]).collect();
        all.sort_unstable();
        // A single line is a petal's stem.
        let has_sides =
            |i: &usize| *i != cap && page.lines[*i].length > SIDES * page.lines[*i].size().length();
        (all.len() > 2 || all.iter().any(has_sides)).then_some(all)
    };
    caps.into_iter().filter_map(under).collect()
}

fn mushroom(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let size = Rows::new(&lines)?.width_and_height();
    // Foliage is scribbled, caps are not.
    let is_scribble = |line: &&Line| line.is_scribble() && line.hull_area > SCRIBBLE * size.x * size.y;
    if !evidence::has_outline(&lines, size) || lines.iter().any(is_scribble) {
        return None;
    }
    let as_drawn = of_lines(&lines).map(|found| (found, 0.0));
    let turned = tilted::turned(&lines, of_lines, |found| found.score).map(|(mut found, angle)| {
        found.score += SCORE.3;
        (found, angle)
    });
    let better = |best: (Found, f32), it: (Found, f32)| if it.0.score > best.0.score { it } else { best };
    let (found, angle) = as_drawn.into_iter().chain(turned).reduce(better)?;
    let outline: Vec<Vec2> = found.outline.into_iter().map(|p| tilted::turned_by(p, -angle)).collect();
    Some(Hypothesis {
        uses: page.with_what_is_inside(group, &outline),
        score: found.score,
        parts: vec![tilted::turned_back(found.whole, angle)],
        solids: Vec::new(),
        reading: Reading::Mushroom,
        habit: Some(Habit::Mushroom),
    })
}

/// A mushroom: stalk and cap in one, the outline of its cap, and how likely it is.
struct Found {
    whole: Made,
    outline: Vec<Vec2>,
    score: f32,
}

/// The mushroom that lines draw which stands upright.
fn of_lines(lines: &[&Line]) -> Option<Found> {
    let trunk = Rows::new(lines)?.trunk()?;
    let above: Vec<Vec<Vec2>> = lines.iter().flat_map(|line| line.above(trunk.top)).collect();
    let sill = [trunk.sill.0, trunk.sill.1];
    let silhouette = Silhouette::new(above.iter().map(Vec::as_slice).chain([sill.as_slice()]), BRIDGE);
    let outline = smooth_contour(&silhouette.contour(), POINTS.0, 1);
    let cap = Cap::new(&outline)?;
    let bounds = lines.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(left, right), line| {
        (left.min(line.bounds.0.x), right.max(line.bounds.1.x))
    });
    // Where the cap meets the stalk there may be notches, and at its rim, if it is seen from below.
    let middle = 0.5 * (cap.low.x + cap.high.x);
    let is_free = |place: &Vec2| {
        let height = (cap.high.y - place.y) / cap.height();
        let is_at_rim = (place.x - middle).abs() > RIM.0 * cap.width() && height < RIM.1;
        height > BROAD.0 && !is_at_rim
    };
    let wide = cap.width() / cap.height();
    let is_cap = trunk.is_sharp
        && !lines.iter().any(|line| is_hollow(line, &trunk))
        && !notches(&outline).iter().any(is_free)
        && above.iter().all(|line| notches(line).len() < LOBES)
        && cap.width() > WHOLE * (bounds.1 - bounds.0)
        && (wide > DOME.0 || wide > WIDE.0 && cap.half_at(DOME.1) > DOME.2 * 0.5 * cap.width())
        && cap.half_at(BROAD.0) > BROAD.1 * 0.5 * cap.width()
        && trunk.narrow > STALK * 0.5 * cap.width()
        && silhouette.share_inside(above.iter().flatten()) > 0.9;
    let whole = is_cap.then(|| whole(&trunk, &cap))?;
    let flat = ramp(cap.half_at(FLAT.0) / (0.5 * cap.width()), FLAT.1);
    Some(Found { whole, score: SCORE.0 + SCORE.1 * ramp(wide, WIDE) + SCORE.2 * flat, outline })
}

/// A cap of this outline on a stalk, as one branch.
pub(crate) fn on_stalk(stalk: &Trunk, outline: &[Vec2]) -> Option<Made> {
    Some(whole(stalk, &Cap::new(outline)?))
}

/// Whether a line is a hole in a trunk: a ring on the stalk, below the cap.
fn is_hollow(line: &Line, trunk: &Trunk) -> bool {
    line.is_closed_and_solid()
        && line.bounds.0.y > trunk.top
        && line.size().x > HOLLOW * trunk.narrow
        && (line.middle().x - trunk.axis()).abs() < trunk.narrow
}

/// A cap by the ends of its rows.
struct Cap<'a> {
    outline: &'a [Vec2],
    low: Vec2,
    high: Vec2,
}

impl<'a> Cap<'a> {
    fn new(outline: &'a [Vec2]) -> Option<Self> {
        let first = *outline.first()?;
        let (low, high) = outline.iter().fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)));
        (high.y > low.y).then_some(Self { outline, low, high })
    }

    fn width(&self) -> f32 {
        self.high.x - self.low.x
    }

    fn height(&self) -> f32 {
        self.high.y - self.low.y
    }

    /// Half width at a share of its height, from below.
    fn half_at(&self, share: f32) -> f32 {
        let y = self.high.y - share * self.height();
        0.5 * width_at(self.outline, y)
    }
}

/// Stalk and cap as one branch from the ground to the top, with its half widths as pressure. The axis of the cap is plumb, since
/// sections across a bent one would tilt its rim; a stalk that stands beside it leans toward it.
fn whole(trunk: &Trunk, cap: &Cap) -> Made {
    let middle = 0.5 * (cap.low.x + cap.high.x);
    let stalk: Vec<(Vec2, f32)> = trunk.rows().iter().copied().filter(|row| row.0.y > cap.high.y).collect();
    let aside = stalk.last().map_or(0.0, |row| middle - row.0.x);
    let last = stalk.len().max(2) - 1;
    let leaning = stalk.iter().enumerate().map(|(i, (place, half))| {
        let share = i as f32 / last as f32;
        (*place + Vec2::new(aside * share * share * (3.0 - 2.0 * share), 0.0), *half)
    });
    let round = (0..=POINTS.1).map(|k| {
        // Denser toward foot and top, where the cap is round.
        let share = 0.5 - 0.5 * (std::f32::consts::PI * (k as f32 + 0.2) / (POINTS.1 as f32 + 0.4)).cos();
        (Vec2::new(middle, cap.high.y - share * cap.height()), cap.half_at(share))
    });
    Made::thick(leaning.chain(round))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[&[(f32, f32)]]) -> Vec<Hypothesis> {
        let lines: Vec<Vec<Vec2>> = lines.iter().map(|places| line(places)).collect();
        crate::anatomy::conventions::read_as_drawn(propose, &lines)
    }

    const CAP: [(f32, f32); 9] = [
        (-12.0, -40.0),
        (-50.0, -42.0),
        (-48.0, -62.0),
        (-30.0, -82.0),
        (0.0, -90.0),
        (30.0, -82.0),
        (48.0, -62.0),
        (50.0, -42.0),
        (12.0, -40.0),
    ];
    const STALK: [(f32, f32); 4] = [(-12.0, -38.0), (-12.0, 20.0), (12.0, 20.0), (12.0, -38.0)];

    #[test]
    fn a_smooth_cap_on_a_stalk_is_one_body_of_revolution() {
        let mushrooms = read(&[&CAP, &STALK]);
        assert_eq!(mushrooms.len(), 1);
        let [whole] = &mushrooms[0].parts[..] else { panic!("{} parts", mushrooms[0].parts.len()) };
        let half_at = |y: f32| {
            let near = whole
                .points
                .iter()
                .min_by(|a, b| (a.position.y - y).abs().total_cmp(&(b.position.y - y).abs()));
            near.unwrap().pressure * whole.half_width.unwrap()
        };
        assert!((half_at(0.0) - 12.0).abs() < 2.0, "stalk {}", half_at(0.0));
        assert!(half_at(-50.0) > 42.0, "cap {}", half_at(-50.0));
        assert!(half_at(-90.0) < 25.0, "top {}", half_at(-90.0));
    }

    #[test]
    fn the_underside_of_a_cap_may_be_seen() {
        let ellipse: Vec<(f32, f32)> = (0..=60)
            .map(|k| {
                let angle = std::f32::consts::TAU * k as f32 / 60.0;
                (50.0 * angle.cos(), -52.0 + 14.0 * angle.sin())
            })
            .collect();
        // The dome comes down inside of the rim.
        let dome: Vec<(f32, f32)> = (0..=40)
            .map(|k| {
                let angle = std::f32::consts::PI * k as f32 / 40.0;
                (-44.0 * angle.cos(), -60.0 - 34.0 * angle.sin())
            })
            .collect();
        assert_eq!(read(&[&dome, &ellipse, &STALK]).len(), 1);
        let scribble: Vec<(f32, f32)> = (0..400)
            .map(|k| 0.31 * k as f32)
            .map(|t| (48.0 * t.cos(), -62.0 + 24.0 * (1.37 * t).sin()))
            .collect();
        assert!(read(&[&dome, &ellipse, &STALK, &scribble]).is_empty(), "foliage");
    }

    #[test]
    fn a_flat_cap_may_have_a_thin_stalk_and_is_sure() {
        let wide: Vec<(f32, f32)> = CAP.iter().map(|p| (1.8 * p.0, -40.0 + 0.7 * (p.1 + 40.0))).collect();
        let thin: Vec<(f32, f32)> = STALK.iter().map(|p| (0.7 * p.0, p.1)).collect();
        let high: Vec<(f32, f32)> = CAP.iter().map(|p| (p.0, -40.0 + 1.4 * (p.1 + 40.0))).collect();
        let (flat, high) = (read(&[&wide, &thin]), read(&[&high, &STALK]));
        assert_eq!((flat.len(), high.len()), (1, 1));
        assert!(flat[0].score > high[0].score);
    }

    #[test]
    fn a_mushroom_that_leans_is_one_and_a_level_underside_speaks_for_it() {
        let leaning = |points: &[(f32, f32)]| -> Vec<(f32, f32)> {
            points.iter().map(|p| Vec2::from_angle(0.12).rotate(Vec2::from(*p)).into()).collect()
        };
        assert_eq!(read(&[&leaning(&CAP), &leaning(&STALK)]).len(), 1);
        let oval: Vec<(f32, f32)> = (0..=60)
            .map(|k| {
                let angle = std::f32::consts::TAU * k as f32 / 60.0;
                (50.0 * angle.sin(), -65.0 + 25.0 * angle.cos())
            })
            .collect();
        let (level, oval) = (read(&[&CAP, &STALK]), read(&[&oval, &STALK]));
        assert!(oval.first().is_none_or(|oval| oval.score < level[0].score));
    }

    #[test]
    fn a_round_crown_is_none() {
        let crown: Vec<(f32, f32)> = (0..=60)
            .map(|k| {
                let angle = std::f32::consts::TAU * k as f32 / 60.0;
                (42.0 * angle.sin(), -78.0 + 42.0 * angle.cos())
            })
            .collect();
        assert!(read(&[&crown, &STALK]).is_empty());
    }

    #[test]
    fn the_axis_of_a_cap_is_plumb_where_its_stalk_stands_aside() {
        let stalk: Vec<(f32, f32)> = STALK.iter().map(|p| (p.0 + 14.0, p.1)).collect();
        let found = read(&[&CAP, &stalk]);
        let points = &found[0].parts[0].points;
        let (foot, top) = (points[0].position, points[points.len() - 1].position);
        assert!((foot.x - 14.0).abs() < 2.0, "the foot stays where it was drawn: {foot}");
        let cap: Vec<_> = points.iter().filter(|p| p.position.y < -45.0).collect();
        assert!(cap.len() > 5 && cap.iter().all(|p| (p.position.x - top.x).abs() < 0.5));
    }

    #[test]
    fn a_zigzag_of_grass_across_the_feet_is_no_part_of_mushrooms() {
        let beside =
            |x: f32, places: &[(f32, f32)]| places.iter().map(|p| (p.0 + x, p.1)).collect::<Vec<_>>();
        let teeth: Vec<(f32, f32)> =
            (0..60).map(|k| (-90.0 + 6.0 * k as f32, if k % 2 == 0 { 22.0 } else { 12.0 })).collect();
        let (cap, stalk) = (beside(150.0, &CAP), beside(150.0, &STALK));
        let mushrooms = read(&[&CAP, &STALK, &teeth, &cap, &stalk]);
        let uses: Vec<&[usize]> = mushrooms.iter().map(|mushroom| &mushroom.uses[..]).collect();
        assert_eq!(uses, [&[0, 1][..], &[3, 4][..]]);
    }

    #[test]
    fn mushrooms_that_touch_one_another_are_read_one_by_one_and_petals_on_stems_are_none() {
        let moved =
            |places: &[(f32, f32)], by: f32| places.iter().map(|p| (p.0 + by, p.1)).collect::<Vec<_>>();
        let closed: Vec<(f32, f32)> = CAP.iter().chain(&CAP[..1]).copied().collect();
        let (left, right) = (moved(&closed, -50.0), moved(&closed, 50.0));
        let (under_left, under_right) = (moved(&STALK, -50.0), moved(&STALK, 50.0));
        let uses: Vec<Vec<usize>> =
            read(&[&left, &under_left, &right, &under_right]).into_iter().map(|it| it.uses).collect();
        assert!(uses.contains(&vec![0, 1]) && uses.contains(&vec![2, 3]), "{uses:?}");
        let stem = |x: f32| vec![(x, -38.0), (x + 1.0, 20.0)];
        assert!(read(&[&left, &stem(-50.0), &right, &stem(50.0)]).is_empty());
    }
}
