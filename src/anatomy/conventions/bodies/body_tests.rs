//! Cacti in the ways in which people draw them, and what is none.

use super::*;
use crate::anatomy::conventions::line;
use crate::sketch::Tool;
use std::f32::consts::PI;

fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
    crate::anatomy::conventions::read_above(
        crate::anatomy::conventions::beneath::ground::propose,
        propose,
        lines,
    )
}

/// Numbers of branches of the bodies that are found.
fn limbs(lines: &[Vec<Vec2>]) -> Vec<usize> {
    read(lines).iter().map(|body| body.parts.len()).collect()
}

fn column() -> Vec<Vec2> {
    line(&[(-10.0, 60.0), (-10.0, -60.0), (-5.0, -68.0), (5.0, -68.0), (10.0, -60.0), (10.0, 60.0)])
}

/// A column with an arm on each side in one line, from its left foot to its right one.
fn saguaro() -> Vec<Vec2> {
    let left = [
        (-10.0, 60.0),
        (-10.0, 10.0),
        (-34.0, 10.0),
        (-38.0, 5.0),
        (-38.0, -35.0),
        (-34.0, -40.0),
        (-26.0, -40.0),
        (-22.0, -35.0),
        (-22.0, -8.0),
        (-10.0, -8.0),
        (-10.0, -60.0),
        (-5.0, -68.0),
    ];
    let right = left.iter().rev().map(|p| (-p.0, p.1));
    line(&left.into_iter().chain(right).collect::<Vec<_>>())
}

#[test]
fn a_column_that_is_open_below_is_a_body_as_thick_as_drawn() {
    let bodies = read(&[column()]);
    assert_eq!(bodies.len(), 1);
    let [trunk] = &bodies[0].parts[..] else { panic!("{} parts", bodies[0].parts.len()) };
    assert_eq!(trunk.tool, Tool::Branch);
    let middle = trunk.points[trunk.points.len() / 2];
    let half = middle.pressure * trunk.half_width.unwrap();
    assert!((half - 10.0).abs() < 1.5 && middle.position.x.abs() < 1.5, "{half} at {}", middle.position);
}

#[test]
fn arms_are_branches_of_their_own_and_the_column_comes_first() {
    let bodies = read(&[saguaro()]);
    assert_eq!(bodies.len(), 1);
    assert_eq!(bodies[0].parts.len(), 3);
    let tips = bodies[0].parts.iter().map(|part| part.points[part.points.len() - 1].position.x);
    let sides: Vec<i32> = tips.map(|x| if x.abs() < 10.0 { 0 } else { x.signum() as i32 }).collect();
    assert!(sides[0] == 0 && sides[1] * sides[2] == -1, "{sides:?}");
}

#[test]
fn an_outline_may_be_several_strokes_with_gaps() {
    let whole = crate::anatomy::conventions::page::even(&saguaro(), 300);
    let mut middle = whole[104..200].to_vec();
    middle.reverse();
    assert_eq!(limbs(&[whole[..100].to_vec(), middle, whole[204..].to_vec()]), [3]);
}

#[test]
fn arms_may_be_outlines_of_their_own_or_single_lines() {
    let arm = line(&[
        (9.0, -4.0),
        (30.0, -4.0),
        (30.0, -30.0),
        (36.0, -36.0),
        (42.0, -30.0),
        (42.0, 10.0),
        (9.0, 10.0),
    ]);
    assert_eq!(limbs(&[column(), arm]), [2]);
    let wire = line(&[(11.0, 0.0), (30.0, 0.0), (36.0, -6.0), (36.0, -40.0)]);
    let bodies = read(&[column(), wire]);
    assert_eq!(bodies.len(), 1);
    assert_eq!(bodies[0].uses, [0, 1]);
    let arm = &bodies[0].parts[1];
    let half = arm.points[arm.points.len() / 2].pressure * arm.half_width.unwrap();
    assert!((3.0..10.0).contains(&half), "{half}");
}

#[test]
fn spines_ribs_and_the_ground_belong_to_it_but_flowers_do_not() {
    let mut lines = vec![saguaro(), line(&[(-60.0, 61.0), (60.0, 60.0)]), line(&[(0.0, 50.0), (0.0, -50.0)])];
    lines.extend([-20.0, 0.0, 20.0, 40.0].map(|y| line(&[(6.0, y), (16.0, y - 4.0)])));
    let bodies = read(&lines);
    assert_eq!(bodies.len(), 1);
    assert_eq!(
        (bodies[0].parts.len(), &bodies[0].uses[..]),
        (3, &[0, 2, 3, 4, 5, 6][..]),
        "the ground is by itself"
    );
    let ring =
        |x: f32| (0..=20).map(|k| Vec2::new(x, -72.0) + 4.0 * Vec2::from_angle(0.3142 * k as f32)).collect();
    let bodies = read(&[saguaro(), ring(-4.0), ring(4.0), ring(0.0)]);
    assert_eq!(bodies[0].uses, [0]);
}

#[test]
fn what_was_not_finished_is_closed_as_wide_as_the_rest() {
    // Up to the tip of the right arm, and no farther.
    let whole = saguaro();
    let half: Vec<Vec2> = whole[..whole.len() - 4].to_vec();
    let bodies = read(&[half]);
    assert_eq!(bodies.len(), 1);
    assert_eq!(bodies[0].parts.len(), 3);
    let foot = bodies[0].parts[0].points[0];
    assert!(foot.position.x.abs() < 5.0 && foot.position.y > 50.0, "{}", foot.position);
}

#[test]
fn leaves_closed_columns_and_half_leaves_are_none() {
    let side = |k: usize| {
        let t = k as f32 / 40.0;
        let (side, up) = if t < 1.0 { (1.0, t) } else { (-1.0, 2.0 - t) };
        Vec2::new(side * 25.0 * (PI * up).sin(), -120.0 * up)
    };
    assert!(read(&[(0..=80).map(side).collect()]).is_empty());
    assert!(read(&[(0..=60).map(side).collect()]).is_empty());
    let mut closed = column();
    closed.push(closed[0]);
    assert!(read(&[closed]).is_empty(), "a blade");
}

#[test]
fn crowns_on_trunks_and_forked_stalks_with_lobes_are_none() {
    let crown = |lobes: f32| -> Vec<Vec2> {
        let mut outline = line(&[(-14.0, 60.0), (-12.0, -20.0)]);
        outline.extend((0..=120).map(|k| {
            let angle = 0.35 + (std::f32::consts::TAU - 0.7) * k as f32 / 120.0;
            let reach = 36.0 + 9.0 * (0.5 * lobes * angle).sin().abs();
            Vec2::new(0.0, -55.0) + reach * Vec2::new(-1.3 * angle.sin(), angle.cos())
        }));
        outline.extend(line(&[(12.0, -20.0), (14.0, 60.0)]));
        outline
    };
    for lobes in [3.0, 5.0, 8.0] {
        assert!(read(&[crown(lobes)]).is_empty(), "{lobes} lobes");
    }
}

#[test]
fn arms_may_be_pointed_leave_at_any_height_and_be_open_arcs_at_a_closed_column() {
    let mut outline =
        line(&[(-10.0, 60.0), (-10.0, 35.0), (-34.0, 35.0), (-42.0, -12.0), (-26.0, 15.0), (-10.0, 15.0)]);
    outline.extend(line(&[
        (-10.0, -60.0),
        (0.0, -70.0),
        (10.0, -60.0),
        (10.0, -38.0),
        (24.0, -38.0),
        (24.0, -62.0),
    ]));
    outline.extend(line(&[(38.0, -62.0), (38.0, -24.0), (10.0, -22.0), (10.0, 60.0)]));
    assert_eq!(limbs(&[outline]), [3]);
    let mut closed = column();
    closed.push(closed[0]);
    let ear = |side: f32, low: f32| {
        let arc = |k: i32| {
            let angle = 0.35 * (k - 5) as f32;
            let (along, aside) = (20.0 + 16.0 * angle.cos(), 7.0 * angle.sin());
            let at = Vec2::new(0.8 * along + 0.6 * aside, 0.8 * aside - 0.6 * along);
            Vec2::new(side * (6.0 + at.x), low + at.y)
        };
        let mut ear = vec![Vec2::new(side * 9.0, low - 12.0)];
        ear.extend((0..=10).map(arc));
        ear.push(Vec2::new(side * 9.0, low + 6.0));
        ear
    };
    assert_eq!(limbs(&[closed, ear(-1.0, 10.0), ear(1.0, -5.0)]), [3]);
}

#[test]
fn a_closed_column_with_spines_across_its_outline_is_a_body() {
    let oval: Vec<Vec2> =
        (0..=60).map(|k| Vec2::from_angle(0.1047 * k as f32) * Vec2::new(24.0, 55.0)).collect();
    let spine = |k: i32| {
        let out = Vec2::from_angle(-0.2 - 0.45 * k as f32);
        line(&[(20.0 * out.x, 46.0 * out.y), (42.0 * out.x, 74.0 * out.y)])
    };
    let mut lines = vec![oval];
    assert!(read(&lines).is_empty(), "a blade");
    lines.extend((0..7).map(spine));
    let bodies = read(&lines);
    assert_eq!(bodies.len(), 1);
    assert_eq!((bodies[0].parts.len(), bodies[0].uses.len()), (1, 8));
}

#[test]
fn half_an_outline_is_a_body_by_the_arm_on_it() {
    let arm = [
        (-10.0, 60.0),
        (-10.0, 12.0),
        (-34.0, 10.0),
        (-38.0, 5.0),
        (-38.0, -35.0),
        (-34.0, -40.0),
        (-26.0, -40.0),
        (-22.0, -35.0),
        (-22.0, -8.0),
        (-10.0, -8.0),
        (-10.0, -60.0),
    ];
    let bodies = read(&[line(&arm)]);
    assert_eq!(bodies.len(), 1);
    assert_eq!(bodies[0].parts.len(), 2);
    let top = bodies[0].parts[0].points.last().unwrap().position;
    assert!(
        top.x > -10.0 && top.y < -50.0,
        "the column is on the other side of the line than the gap: {top}"
    );
}

#[test]
fn straight_stems_side_by_side_are_none() {
    let stem = |foot: f32, tip: f32, top: f32| line(&[(foot, 60.0), (tip, top)]);
    assert!(read(&[stem(-12.0, -10.0, -70.0), stem(0.0, 2.0, -60.0), stem(14.0, 16.0, -5.0)]).is_empty());
}

#[test]
fn pointed_blades_and_caps_are_none() {
    // Three blades that grow from one place.
    let tuft = line(&[
        (-6.0, 40.0),
        (-50.0, -10.0),
        (-8.0, 14.0),
        (0.0, -70.0),
        (8.0, 14.0),
        (50.0, -10.0),
        (6.0, 40.0),
    ]);
    assert!(read(&[tuft]).is_empty());
    let mut cap = line(&[(-9.0, 60.0), (-9.0, -20.0), (-60.0, -22.0)]);
    cap.extend((0..=20).map(|k| {
        let angle = PI * k as f32 / 20.0;
        Vec2::new(-60.0 * angle.cos(), -22.0 - 26.0 * angle.sin())
    }));
    cap.extend(line(&[(9.0, -20.0), (9.0, 60.0)]));
    assert!(read(&[cap]).is_empty());
}

#[test]
fn slender_blades_from_one_place_are_no_body() {
    let blade = |tip: Vec2| {
        let side = 0.1 * tip.perp();
        crate::anatomy::conventions::page::even(
            &[Vec2::ZERO, 0.5 * tip + side, tip, 0.5 * tip - side, Vec2::ZERO],
            80,
        )
    };
    let tips = [(-90.0, -60.0), (-40.0, -110.0), (10.0, -120.0), (60.0, -100.0), (95.0, -50.0)];
    assert!(read(&tips.map(|tip| blade(Vec2::from(tip)))).is_empty());
}

#[test]
fn spines_that_begin_at_the_outline_are_spines() {
    let mut lines = vec![column()];
    lines.extend((0..8).map(|k| {
        let (side, y) = (if k % 2 == 0 { 1.0 } else { -1.0 }, -50.0 + 13.0 * k as f32);
        line(&[(side * 10.0, y), (side * 32.0, y - 8.0)])
    }));
    let bodies = read(&lines);
    assert_eq!(bodies.len(), 1);
    assert_eq!((bodies[0].parts.len(), bodies[0].uses.len()), (1, 9));
}

#[test]
fn what_has_strokes_in_it_and_stands_on_a_line_is_a_leaf_with_its_veins() {
    let mut closed = saguaro();
    closed.push(closed[0]);
    let mut lines = vec![closed];
    lines.extend((0..6).map(|k| line(&[(-4.0, 40.0 - 14.0 * k as f32), (4.0, 36.0 - 14.0 * k as f32)])));
    assert_eq!(read(&lines).len(), 1);
    lines.push(line(&[(0.0, 61.0), (1.0, 110.0)]));
    assert!(read(&lines).is_empty());
}

#[test]
fn an_outline_up_to_the_underside_of_its_second_arm_is_as_thick_below_as_above() {
    let whole = saguaro();
    let right = whole.iter().rposition(|p| p.x > 10.5 && p.y > 9.0).unwrap();
    let bodies = read(&[whole[..=right].to_vec()]);
    assert_eq!(bodies.len(), 1);
    let trunk = &bodies[0].parts[0];
    let half = trunk.points[2].pressure * trunk.half_width.unwrap();
    assert!((half - 10.0).abs() < 2.5, "{half}");
}

#[test]
fn a_zigzag_closed_along_the_ground_is_none() {
    let teeth = (0..=10).map(|k| Vec2::new(12.0 * k as f32, if k % 2 == 1 { -40.0 } else { 0.0 }));
    let closed: Vec<Vec2> = teeth.chain([Vec2::new(0.0, 3.0)]).collect();
    assert!(read(&[closed]).is_empty());
}

#[test]
fn boughs_by_their_outlines_with_twigs_are_a_bare_tree() {
    let side = |sign: f32| line(&[(12.0 * sign, 90.0), (10.0 * sign, 0.0), (70.0 * sign, -80.0)]);
    let crotch = line(&[(-66.0, -92.0), (0.0, -16.0), (66.0, -92.0)]);
    let twig = |x: f32, to: (f32, f32)| line(&[(x, -70.0), to]);
    let twigs =
        [twig(-55.0, (-100.0, -60.0)), twig(55.0, (100.0, -60.0)), line(&[(-30.0, -52.0), (-25.0, -100.0)])];
    let found = read(&[&[side(-1.0), side(1.0), crotch], &twigs[..]].concat());
    let tree = found.iter().find(|body| body.reading == Reading::BareTree).expect("a tree");
    assert!(tree.parts.len() >= 4 && tree.parts.iter().all(|part| part.tool == Tool::Branch));
    assert_eq!(tree.habit, Some(Habit::Tree));
    let saguaro = read(&[saguaro()]);
    assert_eq!(saguaro[0].reading, Reading::Cactus);
}

#[test]
fn long_lines_side_by_side_in_a_column_that_is_open_below_are_its_ribs() {
    let wide = line(&[
        (-40.0, 90.0),
        (-44.0, -60.0),
        (-25.0, -100.0),
        (0.0, -112.0),
        (25.0, -100.0),
        (44.0, -60.0),
        (40.0, 90.0),
    ]);
    let rib = |x: f32| line(&[(x, 88.0), (1.1 * x, -20.0), (0.6 * x, -90.0)]);
    let bodies = read(&[wide, rib(-24.0), rib(24.0)]);
    assert_eq!(bodies.first().map(|body| body.uses.clone()), Some(vec![0, 1, 2]));
}
