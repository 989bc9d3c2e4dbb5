//! Blades of grass: a zigzag, or lines side by side that stand on one level.
//!
//! Every line is cut into its [`spikes`](super::spikes) above the ground. A zigzag is a line with [`TEETH`] sharp tips at
//! least, one more if it is closed by a line along the ground, most of which are drawn one after the other to one side. Lines side by side are upright and their feet at about one level;
//! arcs that lean to a common tip are one blade. Every spike becomes one blade, as wide as it was drawn up to [`HALF`], and
//! its root is led down to the lowest foot, on which all stand.
//!
//! What speaks against grass: something that stands below it, which would be a trunk, a stem or a pot, and an outline
//! around it. Rounded tips are lobes of a crown. A blade may be drawn as a narrow closed loop beside others.
//!
//! Limits: tips are those above the ground, so grass that lies is not found; nor is the upper edge of a lawn that has less
//! than [`TEETH`] tips.

use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::shapes::spikes::{Spike, joined, spikes};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::region::Region;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::f32::consts::PI;

/// Fewest tips with both flanks of a zigzag.
const TEETH: usize = 3;
/// Least height of a tip over the notches beside it, as a share of the line's height.
const PROMINENCE: f32 = 0.1;
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
/// Least size of an outline around a zigzag, in its sizes, and least share of the zigzag's points in it.
const AROUND: (f32, f32) = (0.8, 0.7);
/// Share of the length of all strokes that stands side by side.
const MOST_OF_ALL: f32 = 0.8;
/// Most zigzags that are looked at.
const MOST_ZIGZAGS: usize = 200;
/// Fewest lines and blades side by side.
const LINES: usize = 3;
const BLADES: usize = 4;
/// Half width of a blade at most, as a share of its length.
const HALF: f32 = 0.09;
/// How far from level the feet of blades may be, as a share of the middle height of the blades.
const LEVEL: f32 = 0.4;

/// Proposes one hypothesis for each zigzag, and one for all lines that stand side by side.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let zigzags = (0..page.lines.len()).filter_map(|i| Some((i, zigzag(&page.lines[i])?)));
    // Each of them is held against all lines, so their number is limited.
    let stand = |(i, _): &(usize, Vec<Spike>)| !stands_on_something(page, *i) && !is_inside_another(page, *i);
    out.extend(zigzags.take(MOST_ZIGZAGS).filter(stand).map(|(i, teeth)| {
        let score = 2.0 + 0.25 * teeth.len().min(12) as f32;
        grass(vec![i], score, &teeth)
    }));
    out.extend(tuft(page));
}

/// Height above the ground, but for a constant.
fn height(p: Vec2) -> f32 {
    -p.y
}

/// A line as spikes above the ground.
fn upright_spikes(line: &Line) -> Vec<Spike> {
    spikes(&line.points, height, PROMINENCE * line.size().y)
}

/// The teeth of a line, if it is a zigzag.
fn zigzag(line: &Line) -> Option<Vec<Spike>> {
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
    let lowest = line.points.iter().filter(|p| p.y > line.bounds.1.y - 0.12 * line.size().y).map(|p| p.x);
    let (left, right) = lowest.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, r), x| (l.min(x), r.max(x)));
    right - left > 0.6 * line.size().x
}

/// Whether most tips come one after the other to the left, or to the right.
fn goes_to_one_side(teeth: &[Spike]) -> bool {
    let steps = teeth.len() - 1;
    let to_right = teeth.windows(2).filter(|pair| pair[1].tip().x > pair[0].tip().x).count();
    5 * to_right.max(steps - to_right) >= 4 * steps
}

/// Whether a line begins at the height of a zigzag's feet or among its teeth and goes on below: a trunk, a stem, a pot.
fn stands_on_something(page: &Page, index: usize) -> bool {
    let (low, high) = page.lines[index].bounds;
    let height = high.y - low.y;
    let is_below = |other: &Line| {
        let across = other.bounds.1.x.min(high.x) - other.bounds.0.x.max(low.x);
        across >= 0.0 && other.bounds.1.y > high.y + 0.35 * height && !is_ground(other)
    };
    page.lines.iter().enumerate().any(|(i, other)| i != index && is_below(other))
}

/// Whether a line is level and may be the ground.
fn is_ground(line: &Line) -> bool {
    line.size().y < 0.15 * line.size().x
}

/// Whether one of the other lines goes around most of a zigzag, which then is foliage in it.
fn is_inside_another(page: &Page, index: usize) -> bool {
    let zigzag = &page.lines[index];
    let goes_around = |other: &Line| {
        let size = other.size();
        let is_large = size.cmpgt(AROUND.0 * zigzag.size()).all() && other.solidity() > 0.5;
        is_large && {
            let hull = Region::new(other.hull.clone());
            let inside = zigzag.points.iter().filter(|p| hull.contains(**p)).count();
            inside as f32 > AROUND.1 * zigzag.points.len() as f32
        }
    };
    page.lines.iter().enumerate().any(|(i, other)| i != index && goes_around(other))
}

/// All lines that stand side by side, if they are most of the drawing.
fn tuft(page: &Page) -> Option<Hypothesis> {
    let upright: Vec<usize> =
        (0..page.lines.len()).filter(|i| !page.is_apart(*i) && is_upright(&page.lines[*i])).collect();
    let length: f32 = upright.iter().map(|i| page.lines[*i].length).sum();
    let ground: f32 = page.lines.iter().filter(|line| is_ground(line)).map(|line| line.length).sum();
    if upright.len() < LINES || length < MOST_OF_ALL * (page.length - ground) {
        return None;
    }
    let of_line = |&i: &usize| upright_spikes(&page.lines[i]).into_iter().map(move |spike| (spike, i));
    let all: Vec<(Spike, usize)> = upright.iter().flat_map(of_line).collect();
    let (single, double): (Vec<_>, Vec<_>) = all.into_iter().partition(|(spike, _)| spike.flanks.len() == 1);
    let mut blades = joined(single, |tip| tip.x);
    blades.extend(double.into_iter().map(|(spike, line)| (spike, vec![line])));
    if blades.len() < BLADES || !stand_level(&blades) {
        return None;
    }
    let mut uses: Vec<usize> = blades.iter().flat_map(|blade| blade.1.clone()).collect();
    uses.sort_unstable();
    uses.dedup();
    let spikes: Vec<Spike> = blades.into_iter().map(|blade| blade.0).collect();
    // Blades beside a zigzag belong to it.
    let score = 1.9 + 0.25 * spikes.len().min(12) as f32 + 0.05 * uses.len() as f32;
    Some(grass(uses, score, &spikes))
}

/// Whether a line may be a blade or a zigzag of blades by itself: higher than wide, or sharp.
fn is_upright(line: &Line) -> bool {
    let teeth = upright_spikes(line);
    let mut angles: Vec<f32> = teeth.iter().filter_map(|tooth| tooth.angle(TIP_SHARE)).collect();
    let is_steep = line.size().y > 0.6 * line.size().x * (1.0 / teeth.len().max(1) as f32);
    let is_narrow = line.openness > CLOSED || line.area < NARROW * line.length * line.length;
    is_steep && is_narrow && !teeth.is_empty() && (angles.is_empty() || median(&mut angles) < SHARP)
}

/// Whether most blades stand at one level, and none far below, as a trunk would.
fn stand_level(blades: &[(Spike, Vec<usize>)]) -> bool {
    let mut feet: Vec<f32> = blades.iter().map(|blade| blade.0.foot().y).collect();
    let mut heights: Vec<f32> = blades.iter().map(|blade| blade.0.foot().y - blade.0.tip().y).collect();
    let (level, height) = (median(&mut feet), median(&mut heights));
    let even = feet.iter().filter(|foot| (**foot - level).abs() < LEVEL * height).count();
    5 * even >= 4 * feet.len() && feet.iter().all(|foot| foot - level < height)
}

/// One blade for each spike, all on one level.
fn grass(uses: Vec<usize>, score: f32, spikes: &[Spike]) -> Hypothesis {
    let feet = spikes.iter().flat_map(|spike| &spike.flanks).map(|flank| flank[flank.len() - 1].y);
    let ground = feet.fold(f32::NEG_INFINITY, f32::max);
    let blade = |spike: &Spike| {
        let (low, along) = spike.lower_end();
        let down = (ground - low.y).max(0.0);
        let aside = (along.x / along.y.max(f32::MIN_POSITIVE)).clamp(-0.5, 0.5) * down;
        Made::new(Tool::Leaf, spike.blade(low + Vec2::new(aside, down), HALF))
    };
    let parts = spikes.iter().map(blade).collect();
    Hypothesis { uses, score, parts, solids: Vec::new(), reading: Reading::Grass, habit: Some(Habit::Grass) }
}

fn median(values: &mut [f32]) -> f32 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    fn zigzag(teeth: usize, lowest: f32) -> Vec<Vec2> {
        let height = |k: usize| if k % 2 == 1 { -40.0 } else { lowest - 2.0 * (k % 3) as f32 };
        (0..=2 * teeth).map(|k| Vec2::new(9.0 * k as f32, height(k))).collect()
    }

    fn roots(grass: &Hypothesis) -> Vec<Vec2> {
        grass
            .parts
            .iter()
            .map(|part| part.points[0].position.midpoint(part.points[part.points.len() - 1].position))
            .collect()
    }

    #[test]
    fn a_zigzag_is_a_blade_for_each_tip_on_one_ground() {
        let found = read(&[zigzag(5, 0.0)]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].parts.len(), found[0].habit), (5, Some(Habit::Grass)));
        assert!(found[0].parts.iter().all(|part| part.tool == Tool::Leaf));
        let roots = roots(&found[0]);
        assert!(roots.iter().all(|root| (root.y - roots[0].y).abs() < 0.5), "{roots:?}");
        assert!(roots.windows(2).all(|pair| (pair[1].x - pair[0].x - 18.0).abs() < 4.0), "{roots:?}");
    }

    #[test]
    fn a_zigzag_that_is_closed_along_the_ground_is_grass_and_a_crown_with_spikes_is_none() {
        let mut closed = zigzag(5, 0.0);
        closed.extend([Vec2::new(85.0, 3.0), Vec2::new(5.0, 4.0), Vec2::new(0.0, 0.0)]);
        assert_eq!(read(&[closed.clone()]).first().map(|grass| grass.parts.len()), Some(5));
        closed.splice(11.., [Vec2::new(90.0, 150.0), Vec2::new(0.0, 150.0), Vec2::new(0.0, 0.0)]);
        assert!(read(&[closed]).is_empty());
    }

    #[test]
    fn lines_side_by_side_are_blades_and_arcs_that_meet_are_one() {
        let line = |x: f32| vec![Vec2::new(x, 0.0), Vec2::new(x + 4.0, -50.0)];
        let arcs = [
            vec![Vec2::new(90.0, 1.0), Vec2::new(92.0, -30.0), Vec2::new(100.0, -50.0)],
            vec![Vec2::new(112.0, 0.0), Vec2::new(108.0, -30.0), Vec2::new(101.0, -50.0)],
        ];
        let found = read(&[line(0.0), line(25.0), line(50.0), arcs[0].clone(), arcs[1].clone()]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].parts.len(), &found[0].uses[..]), (4, &[0, 1, 2, 3, 4][..]));
    }

    #[test]
    fn feet_at_many_levels_are_no_grass() {
        let line = |k: usize| {
            vec![
                Vec2::new(20.0 * k as f32, -30.0 * k as f32),
                Vec2::new(20.0 * k as f32 + 4.0, -30.0 * k as f32 - 40.0),
            ]
        };
        assert!(read(&(0..6).map(line).collect::<Vec<_>>()).is_empty());
    }

    #[test]
    fn round_lobes_are_no_grass() {
        let lobe = |k: usize| {
            (0..=20).map(move |i| {
                Vec2::new(20.0 * k as f32, 0.0) + 10.0 * Vec2::from_angle(PI + PI * i as f32 / 20.0)
            })
        };
        assert!(read(&[(0..5).flat_map(lobe).collect()]).is_empty());
    }

    #[test]
    fn a_zigzag_on_a_trunk_or_in_an_outline_is_no_grass() {
        let trunk = vec![Vec2::new(45.0, -5.0), Vec2::new(45.0, 80.0)];
        assert!(read(&[zigzag(5, 0.0), trunk]).is_empty());
        let around: Vec<Vec2> =
            (0..=40).map(|k| Vec2::new(45.0, -20.0) + 90.0 * Vec2::from_angle(0.157 * k as f32)).collect();
        assert!(read(&[zigzag(5, 0.0), around]).is_empty());
        let ground = vec![Vec2::new(-20.0, 4.0), Vec2::new(120.0, 5.0)];
        assert_eq!(read(&[zigzag(5, 0.0), ground]).len(), 1);
    }

    #[test]
    fn a_closed_tuft_is_a_blade_for_each_tip_and_a_star_is_none() {
        let tips = [(-45.0, -50.0), (-28.0, -75.0), (0.0, -90.0), (30.0, -70.0), (48.0, -48.0)];
        let notches = [(-22.0, -25.0), (-9.0, -22.0), (9.0, -22.0), (22.0, -25.0)];
        let mut tuft = vec![Vec2::new(-20.0, 0.0)];
        for (k, tip) in tips.into_iter().enumerate() {
            tuft.push(tip.into());
            tuft.extend(notches.get(k).map(|notch| Vec2::from(*notch)));
        }
        tuft.extend([Vec2::new(20.0, 0.0), Vec2::new(-20.0, 0.0)]);
        assert_eq!(read(&[tuft]).first().map(|grass| grass.parts.len()), Some(5));
        let corner = |k: usize| {
            (if k.is_multiple_of(2) { 50.0 } else { 22.0 }) * Vec2::from_angle(PI * k as f32 / 5.0)
        };
        assert!(read(&[(0..=10).map(corner).collect()]).is_empty());
    }

    #[test]
    fn a_long_row_may_have_blunt_tips_and_a_short_one_not() {
        let row = |waves: usize| -> Vec<Vec2> {
            (0..=24 * waves)
                .map(|k| k as f32 / 24.0)
                .map(|t| Vec2::new(12.0 * t, -10.0 * (PI * t).sin().abs()))
                .collect()
        };
        assert_eq!(read(&[row(12)]).len(), 1);
        assert!(read(&[row(4)]).is_empty());
    }

    #[test]
    fn a_zigzag_in_an_arch_that_is_open_below_is_no_grass() {
        let arch: Vec<Vec2> = (0..=40)
            .map(|k| Vec2::new(45.0, 5.0) + 62.0 * Vec2::from_angle(PI + 0.0785 * k as f32))
            .collect();
        assert!(read(&[zigzag(5, 0.0), arch]).is_empty());
    }
}
