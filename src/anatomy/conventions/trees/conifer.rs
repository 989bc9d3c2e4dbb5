//! A fir: what narrows evenly from a broad foot to a point, in steps.
//!
//! The ends of the level rows of a group of lines ([`Rows`](super::trunk::Rows)) are its two sides, however they were drawn: as a
//! zigzag outline, triangles or arcs one above the other, a zigzag scribble, or lines that slant from a stem. What speaks for a fir is
//! that its width goes down to nothing evenly with the height, about an upright axis, and that both sides have teeth, or are straight
//! above a level foot with a trunk below. The crown is what lies between the sides; the trunk, drawn by one line, by two, or not
//! at all, runs up its middle.
//!
//! Of one that stands behind something a side is enough ([`half_fir`]).
//!
//! Limits: firs that lean by more than a few degrees are not found.

use super::evidence;
use super::half_fir;
use super::trunk::Rows;
use crate::anatomy::conventions::leaves::blade;
use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::shapes::spikes;
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Smallest fir, as a share of the drawing's diagonal, and its width, in heights of its crown.
const SMALLEST: f32 = 0.15;
const WIDTH: (f32, f32) = (0.25, 1.7);
/// Least width where the crown begins, as a share of the widest row, and widest trunk below.
const FOOT: (f32, f32) = (0.5, 0.4);
/// Highest foot of a crown, as a share of the whole height.
const HIGHEST: f32 = 0.5;
/// Farthest that the width at a quarter, the middle and three quarters of the height is from an even taper's, and the width of the
/// topmost tenth at most, as shares of the widest.
const EVEN: f32 = 0.3;
const TIP: f32 = 0.28;
/// Farthest that the axis is from upright and from the middle of the sides, as a share of the width.
const AXIS: f32 = 0.2;
/// Least step outward of a tooth, as a share of half the width, and fewest teeth of a side, its lower corner counted.
const TOOTH: f32 = 0.1;
const TEETH: usize = 2;
/// Width of a row that one line crosses, as a share of the widest; and least reach of a side in the notch between two teeth, as a
/// share of the widest above.
const LINE: f32 = 0.3;
const FILLED: f32 = 0.6;
/// Farthest that straight sides are from straight, as a share of the width.
const STRAIGHT: f32 = 0.06;
/// Half width of a trunk of one line or none, as a share of the whole height, and of any at its top, as a share of its foot.
const TRUNK: (f32, f32) = (0.022, 0.15);
/// Largest group of which single lines are looked at, and least hull of such a line, as a share of the largest.
const MOST_LINES: usize = 12;
const LARGE: f32 = 0.3;
/// Fewest leaves that say that lines are no fir, and their least width, as a share of the whole's: fruit and balls are smaller.
const LEAVES: (usize, f32) = (3, 0.15);
/// What it costs that one side is wider.
const UNEVEN: f32 = 2.0;
/// Log-odds of a fir, and more for each line that it explains; and what it costs that one side is not seen.
const SCORE: (f32, f32) = (4.4, 0.02);
const HALF: f32 = 1.0;

/// Proposes firs, for each group of lines and for single lines in it that are large, with what is below them.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let groups = page.groups.iter().chain(&page.wide_groups);
    out.extend(groups.filter_map(|group| fir(page, group)));
    let several = page.groups.iter().filter(|group| (2..=MOST_LINES).contains(&group.len()));
    out.extend(several.flat_map(|group| single_outlines(page, group)).filter_map(|lines| fir(page, &lines)));
    let numbers = (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    out.extend(numbers.filter_map(|i| half_hidden(page, i)));
}

/// The fir of which a line is one side, with a trunk below it.
fn half_hidden(page: &Page, number: usize) -> Option<Hypothesis> {
    let whole = half_fir::completed(&page.lines[number])?;
    if whole.size().y < SMALLEST * page.diagonal {
        return None;
    }
    let (low, high) = whole.bounds;
    let axis = low.midpoint(high).x;
    let is_trunk = |i: &usize| {
        let line = &page.lines[*i];
        let size = line.size();
        *i != number
            && !page.is_apart(*i)
            && (line.middle().x - axis).abs() < 0.12 * (high.x - low.x)
            && size.x < 0.3 * size.y
            && (line.bounds.0.y - high.y).abs() < 0.1 * (high.y - low.y)
    };
    let trunk = (0..page.lines.len()).find(is_trunk);
    let lines: Vec<&Line> = std::iter::once(&whole).chain(trunk.map(|i| &page.lines[i])).collect();
    let (parts, score) = of_lines(&lines)?;
    let mut uses: Vec<usize> = trunk.into_iter().chain([number]).collect();
    uses.sort_unstable();
    let (reading, habit) = (Reading::Tree, Some(Habit::Conifer));
    Some(Hypothesis { uses, score: score - HALF, parts, solids: Vec::new(), reading, habit })
}

/// Large outlines of a group, each with what lies in it or stands below its middle, as trunks do; no groups that are the whole.
fn single_outlines(page: &Page, group: &[usize]) -> Vec<Vec<usize>> {
    let largest = group.iter().map(|i| page.lines[*i].hull_area).fold(0.0, f32::max);
    let is_crown = |i: &&usize| page.lines[**i].hull_area > LARGE * largest;
    let with_trunk = |i: &usize| -> Vec<usize> {
        let (low, high) = page.lines[*i].bounds;
        let (size, middle) = (high - low, low.midpoint(high));
        let is_below = |k: &usize| {
            let other = &page.lines[*k];
            let aside = (other.middle().x - middle.x).abs();
            other.bounds.0.y > high.y - 0.1 * size.y && aside < 0.15 * size.x && other.size().x < 0.5 * size.x
        };
        let margin = 0.1 * size;
        let is_in_it = |k: &usize| {
            let (l, h) = page.lines[*k].bounds;
            l.cmpgt(low - margin).all() && h.cmplt(high + margin).all()
        };
        group.iter().copied().filter(|k| is_in_it(k) || is_below(k)).collect()
    };
    // What is below another is a tier of the same fir.
    let is_highest = |i: &&usize| {
        let (low, high) = page.lines[**i].bounds;
        let middle = 0.5 * (low.x + high.x);
        let is_above = |other: &Line| {
            let over = other.bounds.0.x < middle && other.bounds.1.x > middle;
            over && other.bounds.0.y < low.y - 0.1 * (high.y - low.y)
        };
        !group.iter().any(|k| k != *i && is_above(&page.lines[*k]))
    };
    let crowns = group.iter().filter(is_crown).filter(is_highest);
    crowns.map(with_trunk).filter(|lines| lines.len() < group.len()).collect()
}

fn fir(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let size = Rows::new(&lines)?.width_and_height();
    if size.y <= SMALLEST * page.diagonal || evidence::has_blades(&lines, size) {
        return None;
    }
    let (parts, score) = of_lines(&lines)?;
    if leaves(page, group, size) >= LEAVES.0 {
        return None;
    }
    let outline: Vec<Vec2> = parts[1].points.iter().map(|p| p.position).collect();
    let uses = page.with_what_is_inside(group, &outline);
    let score = score + SCORE.1 * uses.len() as f32;
    let (reading, habit) = (Reading::Tree, Some(Habit::Conifer));
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit })
}

/// Trunk and crown of the fir that lines draw, and how likely it is.
fn of_lines(lines: &[&Line]) -> Option<(Vec<Made>, f32)> {
    let rows = Rows::new(lines)?;
    let all: Vec<(f32, f32, f32)> = rows.ends().collect();
    let is_fir = |sides: &Sides| sides.narrows() && (sides.has_teeth() || sides.is_straight());
    let sides = Sides::of(&all).filter(is_fir).or_else(|| Sides::of(&hatched(&all)?).filter(is_fir))?;
    let parts = vec![sides.trunk(&rows), Made::new(Tool::Crown, sides.outline())];
    Some((parts, SCORE.0 - UNEVEN * sides.skew()))
}

/// How many lines have a loop on one side of the middle, as leaves on a stem do: tiers of a fir go from side to side.
fn leaves(page: &Page, group: &[usize], whole: Vec2) -> usize {
    let bounds = group.iter().map(|i| page.lines[*i].bounds);
    let (low, high) = bounds.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), line| {
        (low.min(line.0.x), high.max(line.1.x))
    });
    let middle = 0.5 * (low + high);
    let is_leaf = |i: &&usize| {
        blade::of_one(**i, &page.lines[**i]).is_some_and(|blade| {
            let (low, high) = blade.bounds();
            let is_aside = low.x > middle || high.x < middle;
            is_aside && high.x - low.x > LEAVES.1 * whole.x
        })
    };
    group.iter().filter(is_leaf).count()
}

/// Rows with the ends of all that are near, if most are crossed by one line only, as those of a zigzag scribble.
fn hatched(rows: &[(f32, f32, f32)]) -> Option<Vec<(f32, f32, f32)>> {
    let ends = |rows: &[(f32, f32, f32)]| {
        rows.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(l, r), row| (l.min(row.0), r.max(row.1)))
    };
    let whole = ends(rows);
    let is_line = |row: &&(f32, f32, f32)| row.1 - row.0 < LINE * (whole.1 - whole.0);
    if 5 * rows.iter().filter(is_line).count() < 4 * rows.len() {
        return None;
    }
    let reach = rows.len() / 16;
    let near = |i: usize| {
        let (left, right) = ends(&rows[i.saturating_sub(reach)..(i + reach + 1).min(rows.len())]);
        (left, right, rows[i].2)
    };
    Some((0..rows.len()).map(near).collect())
}

/// The two sides of a crown.
struct Sides {
    /// Left end, right end and height of each row, from below.
    rows: Vec<(f32, f32, f32)>,
    /// The widest row's width, pixels.
    width: f32,
    /// Rows of the trunk.
    below: Vec<(f32, f32, f32)>,
}

impl Sides {
    /// What is wide, and everything above.
    fn of(all: &[(f32, f32, f32)]) -> Option<Self> {
        let width = all.iter().map(|row| row.1 - row.0).fold(0.0, f32::max);
        // A line of the ground is as wide as the crown and lies lower.
        let is_wide = |row: &(f32, f32, f32)| row.1 - row.0 > FOOT.0 * width;
        let is_trunk = |row: &(f32, f32, f32)| row.1 - row.0 < FOOT.1 * width;
        let ground = all.iter().take(all.len() / 10).take_while(|row| !is_trunk(row)).count();
        let is_on_ground = ground < all.len() / 20 && all[ground..].iter().take(all.len() / 12).all(is_trunk);
        let from = if is_on_ground { ground } else { 0 };
        let foot = from + all[from..].iter().position(is_wide)?;
        let below: Vec<_> = all[from..foot].to_vec();
        let crown = all[foot..].to_vec();
        let is_crown = (foot as f32) < HIGHEST * all.len() as f32
            && below.iter().all(|row| row.1 - row.0 < FOOT.0 * width);
        let width = crown.iter().map(|row| row.1 - row.0).fold(0.0, f32::max);
        (is_crown && crown.len() > 20).then_some(Self { rows: crown, width, below })
    }

    fn height(&self) -> f32 {
        self.rows[0].2 - self.rows[self.rows.len() - 1].2
    }

    fn middle(&self) -> f32 {
        let widest = self.rows.iter().take(self.rows.len() / 3 + 1);
        let (left, right) =
            widest.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, r), row| (l.min(row.0), r.max(row.1)));
        0.5 * (left + right)
    }

    /// Whether the width goes down to nothing evenly about an upright axis.
    fn narrows(&self) -> bool {
        let count = self.rows.len();
        // Between teeth a row may be narrow: the widest of those above and of a few below counts.
        let widest_from = |share: f32| {
            let from = (share * count as f32) as usize;
            self.rows[from..].iter().map(|row| row.1 - row.0).fold(0.0, f32::max) / self.width
        };
        let is_even =
            [0.25, 0.5, 0.75].iter().all(|share| (widest_from(*share) - (1.0 - share)).abs() < EVEN);
        let tip = self.rows[count - 1];
        let middle = self.middle();
        let is_upright = (0.5 * (tip.0 + tip.1) - middle).abs() < AXIS * self.width;
        let is_symmetric = self.skew() < 2.0 * AXIS;
        let is_of_form = (WIDTH.0..WIDTH.1).contains(&(self.width / self.height()));
        is_even
            && is_upright
            && is_symmetric
            && is_of_form
            && widest_from(0.9) < TIP
            && widest_from(0.0) > 0.99
    }

    /// How much more lies on one side of the apex than on the other, as a share of both.
    fn skew(&self) -> f32 {
        let tip = self.rows[self.rows.len() - 1];
        let middle = 0.5 * (tip.0 + tip.1);
        let add = |(l, r): (f32, f32), row: &(f32, f32, f32)| (l + middle - row.0, r + row.1 - middle);
        let (left, right) = self.rows.iter().fold((0.0, 0.0), add);
        (right - left).abs() / (right + left).max(f32::MIN_POSITIVE)
    }

    /// Whether both sides step outward again and again on their way down.
    fn has_teeth(&self) -> bool {
        let least = TOOTH * 0.5 * self.width;
        let left: Vec<f32> = self.rows.iter().map(|row| -row.0).collect();
        let right: Vec<f32> = self.rows.iter().map(|row| row.1).collect();
        let teeth = [left, right].map(|side| spikes::extremes(&side, least).0.len() / 2);
        teeth.iter().all(|count| *count >= TEETH)
    }

    /// Whether it is a plain triangle on a trunk, with a level foot.
    fn is_straight(&self) -> bool {
        let Some(neck) = self.below.get(self.below.len() / 2) else { return false };
        let count = self.rows.len();
        let (foot, tip) = (self.rows[count / 12], self.rows[count - 1]);
        let away = |k: usize| {
            let share = (k - count / 12) as f32 / (count - 1 - count / 12) as f32;
            let row = self.rows[k];
            let to = |a: f32, b: f32, x: f32| (a + share * (b - a) - x).abs();
            to(foot.0, tip.0, row.0).max(to(foot.1, tip.1, row.1))
        };
        let is_level = foot.1 - foot.0 > 0.85 * self.width && neck.1 - neck.0 < FOOT.1 * self.width;
        is_level && self.below.len() > 5 && (count / 12..count).all(|k| away(k) < STRAIGHT * self.width)
    }

    /// Up the right side and down the left; between lines that slant from a stem twigs fill most of the height.
    fn outline(&self) -> Vec<Vec2> {
        let (mut most, middle) = ((0.0_f32, 0.0_f32), self.middle());
        let mut rows: Vec<(f32, f32, f32)> = self.rows.clone();
        for row in rows.iter_mut().rev() {
            most = (most.0.max(middle - row.0), most.1.max(row.1 - middle));
            (row.0, row.1) = (row.0.min(middle - FILLED * most.0), row.1.max(middle + FILLED * most.1));
        }
        let right = rows.iter().map(|row| Vec2::new(row.1, row.2));
        right.chain(rows.iter().rev().map(|row| Vec2::new(row.0, row.2))).collect()
    }

    /// The trunk, as thick as drawn or thin, and on to near the tip.
    fn trunk(&self, rows: &Rows) -> Made {
        let thin = TRUNK.0 * rows.height();
        let widths = self.below.iter().map(|row| 0.5 * (row.1 - row.0));
        let half = widths.clone().sum::<f32>() / self.below.len().max(1) as f32;
        let half = half.clamp(thin, 0.25 * self.width);
        let foot = self
            .below
            .first()
            .map_or(Vec2::new(self.middle(), self.rows[0].2), |row| Vec2::new(0.5 * (row.0 + row.1), row.2));
        let tip = self.rows[self.rows.len() - 1];
        let top = foot.lerp(Vec2::new(0.5 * (tip.0 + tip.1), tip.2), 0.95);
        Made::thick((0..=24).map(|k| {
            let share = k as f32 / 24.0;
            (foot.lerp(top, share), half * (1.0 + share * (TRUNK.1 - 1.0)))
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    fn triangle(top: f32, foot: f32, half: f32) -> Vec<Vec2> {
        line(&[(0.0, top), (half, foot), (-half, foot), (0.0, top)])
    }

    /// The right side of a fir of three tiers, from its top.
    fn side() -> Vec<Vec2> {
        line(&[(0.0, -150.0), (26.0, -100.0), (13.0, -102.0), (42.0, -50.0), (22.0, -52.0), (60.0, 0.0)])
    }

    fn mirrored(points: &[Vec2]) -> Vec<Vec2> {
        points.iter().map(|p| Vec2::new(-p.x, p.y)).collect()
    }

    fn outline() -> Vec<Vec2> {
        let mut outline = side();
        outline.extend(mirrored(&side()).into_iter().rev());
        outline
    }

    fn foot() -> Vec<Vec2> {
        line(&[(-60.0, 0.0), (60.0, 0.0)])
    }

    fn is_fir(lines: &[Vec<Vec2>]) -> bool {
        let found = read(lines);
        let all: Vec<usize> = (0..lines.len()).collect();
        found.iter().any(|fir| fir.habit == Some(Habit::Conifer) && fir.uses == all)
    }

    #[test]
    fn an_outline_in_steps_is_a_fir_on_a_line_a_box_or_the_ground() {
        let box_below = line(&[(-8.0, 0.0), (-8.0, 30.0), (8.0, 30.0), (8.0, 0.0)]);
        assert!(is_fir(&[outline(), foot(), line(&[(0.0, 0.0), (0.0, 30.0)])]));
        assert!(is_fir(&[outline(), foot(), box_below.clone()]));
        assert!(is_fir(&[outline(), foot()]));
        assert!(is_fir(&[side(), mirrored(&side()), foot(), box_below]));
    }

    #[test]
    fn triangles_and_slanting_lines_one_above_the_other_are_firs() {
        let tiers =
            [triangle(-150.0, -95.0, 25.0), triangle(-115.0, -50.0, 42.0), triangle(-70.0, 0.0, 60.0)];
        let stem = line(&[(0.0, 0.0), (0.0, 30.0)]);
        assert!(is_fir(&[tiers[0].clone(), tiers[1].clone(), tiers[2].clone(), stem]));
        let mut bones = vec![line(&[(0.0, -150.0), (0.0, 40.0)])];
        for k in 0..6 {
            let (reach, y) = (10.0 + 9.0 * k as f32, -135.0 + 28.0 * k as f32);
            bones.extend([-1.0, 1.0].map(|side| line(&[(0.0, y - 12.0), (side * reach, y)])));
        }
        assert!(is_fir(&bones));
    }

    #[test]
    fn the_crown_keeps_its_tiers_and_the_trunk_is_as_thick_as_drawn() {
        let trunk = line(&[(-8.0, 0.0), (-8.0, 30.0), (8.0, 30.0), (8.0, 0.0)]);
        let found = read(&[outline(), foot(), trunk]);
        let [trunk, crown] = &found[0].parts[..] else { panic!("{} parts", found[0].parts.len()) };
        assert_eq!((trunk.tool, crown.tool), (Tool::Branch, Tool::Crown));
        assert!((trunk.half_width.unwrap() - 8.0).abs() < 1.5, "{:?}", trunk.half_width);
        assert!(trunk.points[0].position.y > 25.0 && trunk.points[24].position.y < -130.0);
        let reach = |y: f32| {
            let near = crown.points.iter().filter(|p| (p.position.y - y).abs() < 2.5);
            near.map(|p| p.position.x).fold(0.0, f32::max)
        };
        assert!(reach(-52.0) > 36.0 && reach(-47.0) < 32.0, "{} {}", reach(-52.0), reach(-47.0));
    }

    #[test]
    fn of_two_firs_that_touch_each_is_one() {
        let beside = outline().iter().map(|p| Vec2::new(0.8 * p.x + 95.0, 0.8 * p.y)).collect();
        let stem = line(&[(0.0, 0.0), (0.0, 30.0)]);
        let found = read(&[outline(), beside, stem]);
        assert!(
            found.iter().any(|fir| fir.uses == [0, 2]),
            "{:?}",
            found.iter().map(|f| &f.uses).collect::<Vec<_>>()
        );
    }

    #[test]
    fn drops_leaves_and_zigzags_of_grass_are_no_firs() {
        let drop: Vec<Vec2> = (0..=80)
            .map(|k| k as f32 * std::f32::consts::TAU / 80.0)
            .map(|t| {
                Vec2::new(40.0 * t.sin() * (0.5 * t).sin().powi(2), -60.0 * (0.5 * t).cos().powi(2).sqrt())
            })
            .collect();
        assert!(read(&[drop, line(&[(0.0, 0.0), (0.0, 40.0)])]).is_empty());
        let grass: Vec<Vec2> =
            (0..12).map(|k| Vec2::new(9.0 * k as f32, if k % 2 == 0 { 0.0 } else { -40.0 })).collect();
        assert!(read(&[grass]).is_empty());
        assert!(read(&[triangle(-100.0, 0.0, 50.0)]).is_empty());
    }
}
