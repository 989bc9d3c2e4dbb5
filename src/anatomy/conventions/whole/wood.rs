//! Plain trees, bushes and palms: a crown is what the lines above the trunk enclose.
//!
//! Limits: crowns are one area; fronds that cannot be told apart are no palm.

use super::plain::Plain;
use super::view::{self, View};
use crate::anatomy::conventions::page::Line;
use crate::anatomy::conventions::shapes::spikes::spikes;
use crate::anatomy::conventions::trees::{bush::stems, evidence, trunk::Trunk};
use crate::anatomy::conventions::tufts::frond_crown::Crown;
use crate::anatomy::conventions::{Habit, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Fewest fronds, and least share of what is drawn about a palm's trunk that they are.
const FRONDS: usize = 3;
const EXPLAINED: f32 = 0.4;
/// How many places above a palm's trunk may be its top, and how far apart, as a share of the height.
const TOPS: usize = 5;
const HIGHER: f32 = 0.06;
/// Distance from the trunk's middle at which lines beside it are fronds, in its least half widths.
const BESIDE: f32 = 3.0;
/// Least change of distance from the top that makes a tip, and least distance of tips, as shares of the farthest, and half width of
/// a frond at most, as a share of its length.
const PROMINENCE: f32 = 0.15;
const SHORTEST: f32 = 0.35;
const HALF: f32 = 0.15;

/// A crown that stands on the ground.
pub(super) fn bush(view: &View) -> Option<Plain> {
    if !encloses(view) {
        return None;
    }
    let outline = view::outline(&view.all())?;
    let mut parts = stems(&outline, polyline::bounds(outline.iter().copied()));
    parts.push(Made::new(Tool::Crown, outline));
    Some(Plain { uses: view.own.clone(), parts, reading: Reading::Bush, habit: Some(Habit::Bush) })
}

/// A crown on a trunk.
pub(super) fn tree(view: &View) -> Option<Plain> {
    let trunk = view.stalk().filter(|_| encloses(view))?;
    let outline = view::outline(&view.above(&trunk))?;
    let parts = vec![trunk.centre_line(&outline), Made::new(Tool::Crown, outline)];
    Some(Plain { uses: view.own.clone(), parts, reading: Reading::Tree, habit: Some(Habit::Tree) })
}

/// Fronds on a trunk, whose top is where most of what is drawn comes together.
pub(super) fn palm(view: &View) -> Option<Plain> {
    let trunk = view.stalk()?;
    let begin = trunk.sill.0.midpoint(trunk.sill.1);
    let top = |k: usize| begin - Vec2::new(0.0, HIGHER * k as f32 * view.rows.height());
    let about = |top: Vec2| (top, Crown::about(top, &around(view, &trunk, top)));
    let (top, crown) =
        (0..TOPS).map(top).map(about).max_by(|a, b| a.1.explained.total_cmp(&b.1.explained))?;
    let mut parts = if crown.fronds.len() >= FRONDS && crown.explained > EXPLAINED {
        crown.hypothesis(top, None).parts
    } else {
        tips(&around(view, &trunk, top), top)
    };
    if parts.len() < FRONDS {
        return None;
    }
    parts.insert(0, trunk.centre_line(&[top]));
    Some(Plain { uses: view.own.clone(), parts, reading: Reading::Fronds, habit: Some(Habit::Palm) })
}

/// Stretches of lines that are not the sides of a trunk that ends so high, with the numbers of their lines.
fn around(view: &View, trunk: &Trunk, top: Vec2) -> Vec<(Vec<Vec2>, usize)> {
    let is_free = |p: &Vec2| p.y < top.y || (p.x - top.x).abs() > BESIDE * trunk.narrow;
    let stretches = |(line, number): (&&Line, &usize)| {
        let runs = line.points.chunk_by(|a, b| is_free(a) == is_free(b));
        let free =
            runs.filter(|run| run.len() > 2 && is_free(&run[0]) && run.iter().any(|p| p.y < trunk.top));
        free.map(|run| (run.to_vec(), *number)).collect::<Vec<_>>()
    };
    view.lines.iter().zip(&view.own).flat_map(stretches).collect()
}

/// A frond from `top` for every tip of some lines that is far from there.
fn tips(runs: &[(Vec<Vec2>, usize)], top: Vec2) -> Vec<Made> {
    let reach = |points: &[Vec2]| points.iter().map(|p| p.distance(top)).fold(0.0, f32::max);
    let farthest = runs.iter().map(|run| reach(&run.0)).fold(0.0, f32::max);
    let of_run = |run: &(Vec<Vec2>, usize)| spikes(&run.0, |p| p.distance(top), PROMINENCE * farthest);
    let all = runs.iter().flat_map(of_run).filter(|spike| spike.tip().distance(top) > SHORTEST * farthest);
    all.map(|spike| Made::new(Tool::Leaf, spike.blade(top, HALF))).collect()
}

/// Whether lines enclose something: those of branches do not.
fn encloses(view: &View) -> bool {
    evidence::has_outline(&view.lines, view.rows.width_and_height())
        && !evidence::has_blades(&view.lines, view.rows.width_and_height())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use crate::anatomy::conventions::page::{Page, even};
    use std::f32::consts::TAU;

    fn read(read: fn(&View) -> Option<Plain>, lines: &[Vec<Vec2>]) -> Option<Plain> {
        let page = Page::of_lines(lines);
        View::of(&page, (0..page.lines.len()).collect()).and_then(|view| read(&view))
    }

    /// Bows around a middle, with gaps between them.
    fn bows() -> Vec<Vec<Vec2>> {
        let bow = |k: usize| {
            let angle = |i: usize| TAU * (k as f32 + 0.9 * i as f32 / 20.0) / 5.0;
            let bulge = |i: usize| 50.0 + 14.0 * (0.5 * TAU * i as f32 / 20.0).sin();
            (0..=20).map(|i| Vec2::new(0.0, -150.0) + bulge(i) * Vec2::from_angle(angle(i))).collect()
        };
        (0..5).map(bow).collect()
    }

    #[test]
    fn bows_with_gaps_are_a_bush_and_on_two_sides_a_tree() {
        assert_eq!(read(bush, &bows()).unwrap().parts.last().unwrap().tool, Tool::Crown);
        let sides = [-8.0, 8.0].map(|x| line(&[(x, -95.0), (x, 0.0)]));
        let tree = read(tree, &[bows(), sides.to_vec()].concat()).unwrap();
        assert_eq!((tree.uses.len(), tree.parts.len(), tree.parts[0].tool), (7, 2, Tool::Branch));
        let half = tree.parts[0].half_width.unwrap();
        assert!((6.0..12.0).contains(&half), "{half}");
    }

    #[test]
    fn branches_enclose_no_crown() {
        let twig = |x: f32, y: f32| line(&[(0.0, -60.0), (x, y)]);
        let lines = [line(&[(0.0, 0.0), (0.0, -60.0)]), twig(-50.0, -120.0), twig(50.0, -130.0)];
        assert!(read(tree, &lines).is_none() && read(bush, &lines).is_none());
    }

    #[test]
    fn arcs_about_the_top_of_a_trunk_are_fronds() {
        let frond = |x: f32| {
            let place = |t: f32| Vec2::new(x * t, -150.0 - 90.0 * t * (1.0 - 0.7 * t));
            even(&(0..=10).map(|k| place(0.1 * k as f32)).collect::<Vec<_>>(), 30)
        };
        let trunk = [-5.0, 5.0].map(|x| line(&[(x, -145.0), (x, 0.0)])).to_vec();
        let fronds = [-90.0, -50.0, 45.0, 95.0].map(frond).to_vec();
        let palm = read(palm, &[trunk.clone(), fronds].concat()).unwrap();
        assert_eq!(palm.parts.iter().filter(|part| part.tool == Tool::Leaf).count(), 4);
        assert!(read(super::palm, &[trunk, vec![frond(60.0)]].concat()).is_none(), "one frond");
    }
}
