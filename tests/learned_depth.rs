//! Learned depth of drawn crowns: it changes how deep they are and nothing that is seen from the front, keeps away from what is no
//! crown, and the marks inside of a crown are heeded.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::crowns::{agreement, build, circle, drawing, ring, stroke};
use glam::{Vec2, Vec3};
use penstemon::depth;
use penstemon::geom::region::Region;
use penstemon::growth::Inflated;
use penstemon::pipeline::Built;
use penstemon::plant::OrganKind;
use penstemon::sketch::{Remark, Sketch, Tool};

const RULES: [&str; 2] = ["depth.learned.crown=0", "depth.learned.branches=0"];

/// A wide, flat crown with small bumps, as people draw umbrella-shaped trees.
fn umbrella() -> Vec<Vec<Vec2>> {
    vec![ring(90, |t| Vec2::new(4.0 * t.cos(), 1.1 * t.sin()) * (1.0 + 0.05 * (7.0 * t).sin()))]
}

/// A block letter E.
fn letter() -> Vec<Vec<Vec2>> {
    let corners =
        [(0, 0), (6, 0), (6, 2), (2, 2), (2, 4), (5, 4), (5, 6), (2, 6), (2, 8), (6, 8), (6, 10), (0, 10)];
    vec![corners.map(|(x, y)| Vec2::new(x as f32, y as f32)).to_vec()]
}

fn leaves(built: &Built) -> impl Iterator<Item = Vec3> + '_ {
    let organs = built.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Leaf);
    organs.map(|organ| organ.base())
}

/// Width and depth of a plant's foliage.
fn extent(built: &Built) -> Vec2 {
    let (low, high) =
        leaves(built).fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)));
    Vec2::new(high.x - low.x, high.z - low.z)
}

#[test]
fn a_flat_crown_is_a_round_plate_and_looks_as_drawn() {
    let sketch = drawing("acacia", &umbrella(), true);
    let (learned, rules) = (build(&sketch, &[]), build(&sketch, &RULES));
    let [deep, flat] = [&learned, &rules].map(|built| extent(built).y / extent(built).x);
    assert!(flat < 0.45 && deep > 1.4 * flat && deep < 1.3, "{deep} as deep as wide, {flat} by rules");
    let ((share, outside), (without, _)) = (agreement(&learned), agreement(&rules));
    assert!(
        share > without - 0.05 && outside <= 0.04,
        "{share} of the front, {without} by rules, {outside} outside"
    );
}

#[test]
fn what_is_no_crown_has_the_depth_of_rules() {
    let sketch = drawing("box", &letter(), true);
    let (learned, rules) = (build(&sketch, &[]), build(&sketch, &RULES));
    assert_eq!(*learned.plant, *rules.plant);
}

/// Two large holes, and dots, drawn into a round crown.
fn with_marks(holes: bool, dots: bool) -> Sketch {
    let mut outlines = vec![circle(Vec2::new(0.0, 3.0), 2.0)];
    if holes {
        outlines.extend([-0.8, 0.8].map(|x| circle(Vec2::new(x, 3.2), 0.45)));
    }
    let mut sketch = drawing("box", &outlines, true);
    if dots {
        // 700 pixels are the crown's height of four metres.
        let canvas = |p: Vec2| Vec2::new(500.0 + p.x * 175.0, 80.0 + (5.0 - p.y) * 175.0);
        for k in 0..24 {
            let at = Vec2::new(-1.1 + 0.42 * (k % 6) as f32, 1.9 + 0.7 * (k / 6) as f32);
            let dot = circle(canvas(at), 3.0);
            sketch.strokes.push(stroke(100 + k, Tool::Crown, dot));
        }
    }
    sketch
}

#[test]
fn holes_stay_open_and_dots_make_a_crown_sparse() {
    let [plain, holes, dots] = [(false, false), (true, false), (true, true)]
        .map(|(holes, dots)| build(&with_marks(holes, dots), &[]));
    let count = |built: &Built| leaves(built).count();
    assert!(
        count(&plain) > count(&holes) && count(&holes) > count(&dots),
        "{} {} {}",
        count(&plain),
        count(&holes),
        count(&dots)
    );
    assert!(
        (count(&dots) as f32) < 0.8 * count(&holes) as f32,
        "{} of {} leaves",
        count(&dots),
        count(&holes)
    );
    let crowns = depth::crowns(&holes.anatomy, &holes.provenance.world_from_canvas);
    assert_eq!(crowns.len(), 3);
    for hole in crowns.into_iter().skip(1).map(Region::new) {
        let (low, high) = hole.bounds().unwrap();
        let open = leaves(&holes)
            .filter(|p| p.truncate().distance(low.midpoint(high)) < 0.4 * (high.x - low.x))
            .count();
        assert_eq!(open, 0, "leaves in a hole");
    }
    let said = |built: &Built| built.remarks.iter().filter(|w| w.remark == Remark::ThinsCrown).count();
    // Four of the 24 lie in the holes.
    assert_eq!((said(&dots), dots.remarks.len(), said(&holes)), (20, 20, 0), "{:?}", dots.remarks);
}

/// Mean angle between what grew and where the arms of a crown lead, degrees.
fn off_the_arms(built: &Built) -> f32 {
    let crowns = depth::crowns(&built.anatomy, &built.provenance.world_from_canvas);
    let drawn: Vec<_> = built.plant.branches.iter().filter(|b| b.origin.is_drawn()).cloned().collect();
    let crown = Inflated::new(crowns, 1.0).unwrap().guided(1.0, &drawn);
    let (mut sum, mut length) = (0.0, 0.0);
    for pair in built.plant.branches.iter().filter(|b| !b.origin.is_drawn()).flat_map(|b| b.points.windows(2))
    {
        let (way, along) = (crown.way(pair[0].midpoint(pair[1])), pair[1] - pair[0]);
        if way != Vec3::ZERO {
            sum += way.angle_between(along) * along.length();
            length += along.length();
        }
    }
    (sum / length).to_degrees()
}

#[test]
fn growth_is_led_along_the_arms_of_a_crown() {
    let arms =
        vec![ring(120, |t| Vec2::from_angle(t) * (1.2 + 0.8 * (5.0 * t + 0.5 * std::f32::consts::PI).cos()))];
    let sketch = drawing("hazel", &arms, true);
    let [free, led] = ["growth.guide=0", "growth.guide=2"].map(|set| build(&sketch, &[set]));
    let (without, with) = (off_the_arms(&free), off_the_arms(&led));
    assert!(with < without - 5.0, "{with}° with a guide, {without}° without");
    assert!(agreement(&led).0 > agreement(&free).0 - 0.1, "{:?} {:?}", agreement(&led), agreement(&free));
}
