//! Grass in the ways in which people draw it, and what is none.

use super::*;
use crate::geom::simple_loop;
use crate::sketch::StrokePoint;
use std::f32::consts::PI;

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
fn lines_that_lean_far_are_blades_and_stand_on_a_ground_line() {
    let line = |x: f32| vec![Vec2::new(x, 0.0), Vec2::new(x + 45.0, -25.0), Vec2::new(x + 48.0, -22.0)];
    let lines: Vec<Vec<Vec2>> = (0..5).map(|k| line(30.0 * k as f32)).collect();
    assert_eq!(read(&lines).first().map(|grass| grass.parts.len()), Some(5));
    let level = |y: f32| vec![vec![Vec2::new(-20.0, y), Vec2::new(190.0, y + 1.0)]];
    let found = read(&[lines.clone(), level(3.0)].concat());
    assert_eq!((found[0].parts.len(), found[0].uses.len()), (5, 6));
    assert!(read(&[lines, level(-90.0), level(-120.0)].concat()).is_empty(), "bars are no ground");
}

#[test]
fn an_arch_that_stands_by_itself_is_as_wide_as_drawn_and_a_tooth_is_not() {
    let arch = |x: f32| {
        let corners = [(0.0, 0.0), (-4.0, -40.0), (14.0, -90.0), (34.0, -45.0), (30.0, 0.0)];
        corners.map(|(dx, y)| Vec2::new(x + dx, y)).to_vec()
    };
    let widest = |found: &[Hypothesis]| {
        let area = |points: &[StrokePoint]| {
            simple_loop::area(&points.iter().map(|p| p.position).collect::<Vec<_>>())
        };
        found[0].parts.iter().map(|part| area(&part.points)).fold(0.0, f32::max)
    };
    let arches = read(&(0..4).map(|k| arch(60.0 * k as f32)).collect::<Vec<_>>());
    assert_eq!(arches[0].parts.len(), 4);
    assert!(widest(&arches) > 1200.0, "{}", widest(&arches));
    let zigzag = (0..9).map(|k| Vec2::new(20.0 * k as f32, if k % 2 == 0 { 0.0 } else { -90.0 })).collect();
    assert!(widest(&read(&[zigzag])) < 1200.0);
}

#[test]
fn the_ground_that_goes_on_from_a_zigzag_is_no_blade() {
    let mut drawn = zigzag(5, 0.0);
    drawn.push(Vec2::new(190.0, -14.0));
    assert_eq!(read(&[drawn])[0].parts.len(), 5);
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
    let corner =
        |k: usize| (if k.is_multiple_of(2) { 50.0 } else { 22.0 }) * Vec2::from_angle(PI * k as f32 / 5.0);
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
    let arch: Vec<Vec2> =
        (0..=40).map(|k| Vec2::new(45.0, 5.0) + 62.0 * Vec2::from_angle(PI + 0.0785 * k as f32)).collect();
    assert!(read(&[zigzag(5, 0.0), arch]).is_empty());
}

#[test]
fn a_long_row_may_go_up_a_slope_and_its_blades_stay_as_long_as_drawn() {
    let blade = |k: usize| {
        let x = 18.0 * k as f32;
        vec![Vec2::new(x, -0.1 * x), Vec2::new(x + 3.0, -0.1 * x - 20.0)]
    };
    let row: Vec<Vec<Vec2>> = (0..14).map(blade).collect();
    let found = read(&row);
    assert_eq!(found.first().map(|grass| grass.parts.len()), Some(14));
    let roots = roots(&found[0]);
    assert!(roots.windows(2).all(|pair| (pair[0].y - pair[1].y - 1.8).abs() < 0.5), "{roots:?}");
    let steep: Vec<Vec<Vec2>> =
        row.iter().map(|blade| blade.iter().map(|p| Vec2::new(p.x, p.y - 0.4 * p.x)).collect()).collect();
    assert!(read(&steep).is_empty(), "twigs at a stem");
}

#[test]
fn a_flower_among_blades_is_none_of_them() {
    let blade = |k: usize| vec![Vec2::new(20.0 * k as f32, 0.0), Vec2::new(20.0 * k as f32 + 3.0, -25.0)];
    let blades: Vec<Vec<Vec2>> = (0..6).map(blade).collect();
    assert_eq!(read(&blades).len(), 1);
    let stem = vec![Vec2::new(50.0, 0.0), Vec2::new(53.0, -200.0)];
    assert!(read(&[blades, vec![stem]].concat()).is_empty());
}

#[test]
fn blades_on_a_drawn_hill_stand_at_its_foot() {
    let hill = |x: f32| -60.0 + 0.0035 * (x - 130.0).powi(2);
    let line: Vec<Vec2> = (0..=26).map(|k| 10.0 * k as f32).map(|x| Vec2::new(x, hill(x))).collect();
    let blade = |k: usize| {
        let x = 12.0 + 29.0 * k as f32;
        vec![Vec2::new(x, hill(x)), Vec2::new(x + 4.0, hill(x) - 50.0)]
    };
    let found = read(&[vec![line], (0..9).map(blade).collect()].concat());
    assert_eq!(
        found.iter().map(|grass| (grass.uses.len(), grass.parts.len())).collect::<Vec<_>>(),
        [(10, 9)]
    );
    let roots = roots(&found[0]);
    assert!(roots.iter().all(|root| (root.y - roots[0].y).abs() < 3.0), "{roots:?}");
}

#[test]
fn the_rest_of_a_lawn_and_ticks_below_it_are_no_trunk() {
    let edge = zigzag(6, 0.0);
    let (first, last) = (edge[0], edge[edge.len() - 1]);
    let below = Vec2::new(0.0, 40.0);
    let rest = vec![first, first + below, last + below, last];
    assert_eq!(read(&[edge.clone(), rest])[0].uses, [0, 1]);
    let tick = |x: f32| vec![Vec2::new(x, 10.0), Vec2::new(x + 8.0, 22.0)];
    assert_eq!(read(&[edge, tick(20.0), tick(60.0)])[0].uses, [0]);
}

#[test]
fn a_row_of_ticks_is_one_lawn_and_no_tufts() {
    let tick = |k: usize| {
        let x = 34.0 * k as f32;
        vec![Vec2::new(x - 9.0, -60.0), Vec2::new(x, 0.0), Vec2::new(x + 10.0, -66.0)]
    };
    let ticks: Vec<Vec<Vec2>> = (0..7).map(tick).collect();
    assert_eq!(read(&ticks)[0].uses.len(), 7);
    assert!(
        crate::anatomy::conventions::read_by(crate::anatomy::conventions::tufts::tuft::propose, &ticks)
            .is_empty()
    );
}

#[test]
fn boughs_that_hang_from_a_trunk_are_no_grass() {
    let bough = |(x, foot): (f32, f32)| {
        let at = |share: f32, y: f32| (share * x, y);
        crate::anatomy::conventions::line(&[at(0.12, 190.0), at(0.8, 80.0), at(0.98, 110.0), (x, foot)])
    };
    let ends = [(-132.0, 310.0), (-94.0, 255.0), (-61.0, 256.0), (-27.0, 295.0)];
    let boughs: Vec<Vec<Vec2>> =
        ends.iter().flat_map(|(x, y)| [bough((*x, *y)), bough((-*x, *y - 8.0))]).collect();
    assert!(!read(&boughs).is_empty(), "without a trunk they may be");
    let sides = [-18.0, 20.0].map(|x| vec![Vec2::new(x, 386.0), Vec2::new(0.9 * x, 197.0)]);
    assert!(read(&[boughs, sides.to_vec()].concat()).is_empty());
}

#[test]
fn lines_that_hang_from_an_arch_are_no_grass_and_those_on_a_hill_are() {
    let arch = |k: usize| {
        Vec2::new(100.0, 0.0) + Vec2::new(120.0, 50.0) * Vec2::from_angle(PI + PI * k as f32 / 40.0)
    };
    let arch: Vec<Vec2> = (0..=40).map(arch).collect();
    let at = |x: f32| 50.0 * (1.0 - ((x - 100.0) / 120.0).powi(2)).sqrt();
    let hanging = |x: f32| vec![Vec2::new(x, 8.0 - at(x)), Vec2::new(x + 2.0, 110.0)];
    let upright = |x: f32| vec![Vec2::new(x, -at(x)), Vec2::new(x + 6.0, -at(x) - 70.0)];
    let places = [10.0, 35.0, 65.0, 100.0, 135.0, 165.0, 190.0];
    let with = |lines: [Vec<Vec2>; 7]| read(&[std::slice::from_ref(&arch), &lines[..]].concat());
    assert!(with(places.map(hanging)).is_empty());
    assert_eq!(with(places.map(upright)).len(), 1);
}
