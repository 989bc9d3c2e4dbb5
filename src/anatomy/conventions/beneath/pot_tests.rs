//! Pots of one stroke or several with plants in them, and what only looks like them.

use super::*;
use crate::anatomy::conventions::line;

fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
    crate::anatomy::conventions::read_by(propose, lines)
}

fn body() -> Vec<Vec2> {
    line(&[(-25.0, -40.0), (-18.0, 0.0), (18.0, 0.0), (25.0, -40.0)])
}

fn stem() -> Vec<Vec2> {
    line(&[(0.0, -30.0), (2.0, -110.0)])
}

fn ellipse(middle: Vec2, half: Vec2) -> Vec<Vec2> {
    (0..=60).map(|k| middle + half * Vec2::from_angle(std::f32::consts::TAU * k as f32 / 60.0)).collect()
}

#[test]
fn a_box_with_a_stem_in_it_is_a_pot_of_its_drawn_profile() {
    let found = read(&[stem(), body()]);
    assert_eq!(found.len(), 1);
    assert_eq!((&found[0].uses[..], found[0].parts.len()), (&[1][..], 0));
    let solid = &found[0].solids[0];
    let (top, bottom) = (solid.profile[0], solid.profile[solid.profile.len() - 1]);
    assert!(solid.axis.abs() < 0.5, "{}", solid.axis);
    assert!((top.x - 25.0).abs() < 1.5 && (bottom.x - 18.0).abs() < 1.5, "{top} {bottom}");
    assert!((top.y + 40.0).abs() < 2.0 && bottom.y.abs() < 2.0, "{top} {bottom}");
}

#[test]
fn bottom_and_sides_may_be_drawn_by_themselves() {
    let sides = [line(&[(-18.0, 1.0), (-25.0, -40.0)]), line(&[(25.0, -39.0), (19.0, 0.0)])];
    let bottom = line(&[(-18.0, 0.0), (18.0, 0.0)]);
    let found = read(&[stem(), bottom, sides[0].clone(), sides[1].clone()]);
    assert_eq!(found.first().map(|pot| &pot.uses[..]), Some(&[1, 2, 3][..]));
}

#[test]
fn two_flowers_on_the_ground_are_no_sides_and_a_bed_is_no_pot() {
    let flower = |x: f32| [line(&[(x, 0.0), (x, -90.0)]), ellipse(Vec2::new(x, -105.0), Vec2::splat(15.0))];
    let row = [flower(-80.0), flower(0.0), flower(80.0)].concat();
    assert!(read(&[row.clone(), vec![line(&[(-85.0, 0.0), (85.0, 0.0)])]].concat()).is_empty());
    let bed = line(&[(-120.0, -40.0), (120.0, -40.0), (120.0, 30.0), (-120.0, 30.0), (-120.0, -40.0)]);
    assert!(read(&[row, vec![bed.clone()]].concat()).is_empty());
    assert_eq!(read(&[flower(0.0).to_vec(), vec![bed]].concat()).len(), 1, "a trough");
}

#[test]
fn a_band_at_its_upper_edge_belongs_to_it() {
    let rim = ellipse(Vec2::new(0.0, -42.0), Vec2::new(27.0, 6.0));
    let found = read(&[stem(), body(), rim]);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].uses, [1, 2]);
}

#[test]
fn a_bowl_has_a_level_edge_and_a_round_bottom() {
    let arc = (0..=30).map(|k| {
        Vec2::new(-25.0, -40.0) * Vec2::from_angle(std::f32::consts::PI * k as f32 / 30.0) - Vec2::Y * 40.0
    });
    let bowl: Vec<Vec2> = arc.chain([Vec2::new(-25.0, -40.0)]).map(|p| Vec2::new(p.x, -80.0 - p.y)).collect();
    assert_eq!(read(&[stem(), bowl]).len(), 1);
}

#[test]
fn without_a_plant_it_is_none() {
    assert!(read(&[body()]).is_empty());
    let beside = line(&[(60.0, -30.0), (62.0, -110.0)]);
    assert!(read(&[body(), beside]).is_empty());
}

#[test]
fn a_trunk_below_a_crown_and_a_stalk_below_a_cap_are_none() {
    assert!(read(&[body(), ellipse(Vec2::new(0.0, -80.0), Vec2::new(60.0, 45.0))]).is_empty());
    let cap = line(&[(-60.0, -40.0), (-40.0, -80.0), (40.0, -80.0), (60.0, -40.0), (-60.0, -40.0)]);
    assert!(read(&[body(), cap]).is_empty());
}

#[test]
fn a_leaf_with_a_stalk_is_none() {
    let blade = ellipse(Vec2::new(0.0, -40.0), Vec2::new(30.0, 40.0));
    assert!(read(&[blade.clone(), line(&[(0.0, -10.0), (0.0, 40.0)])]).is_empty());
    assert!(read(&[blade, line(&[(0.0, -75.0), (0.0, -140.0)])]).is_empty(), "round below");
}

#[test]
fn a_table_below_it_does_not_matter_but_a_stem_does() {
    let table = line(&[(-90.0, 12.0), (90.0, 12.0)]);
    assert_eq!(read(&[stem(), body(), table]).len(), 1);
    assert!(read(&[stem(), body(), line(&[(0.0, 0.0), (1.0, 60.0)])]).is_empty());
}

#[test]
fn an_open_stroke_with_an_end_that_goes_too_far_is_cut_at_its_edge() {
    let long = line(&[(-25.0, -40.0), (25.0, -42.0), (18.0, 0.0), (-18.0, 0.0), (-26.0, -62.0)]);
    let found = read(&[stem(), long]);
    let [pot] = &found[..] else { panic!("{} pots", found.len()) };
    assert!((pot.solids[0].profile[0].y + 41.0).abs() < 4.0, "{}", pot.solids[0].profile[0]);
}

#[test]
fn one_side_below_an_elliptic_rim_is_a_pot_with_two() {
    let rim = ellipse(Vec2::new(0.0, -42.0), Vec2::new(27.0, 9.0));
    let side = line(&[(-26.0, -36.0), (-18.0, 0.0), (16.0, 1.0)]);
    let found = read(&[stem(), rim, side.clone()]);
    let [pot] = &found[..] else { panic!("{} pots", found.len()) };
    assert_eq!(pot.uses, [1, 2]);
    let solid = &pot.solids[0];
    assert!(solid.axis.abs() < 1.5, "{}", solid.axis);
    assert!(solid.profile.iter().all(|p| (15.0..29.0).contains(&p.x)), "{:?}", solid.profile);
    assert!(read(&[stem(), side]).is_empty(), "without a rim");
}

#[test]
fn soil_patterns_and_saucers_belong_to_it() {
    let soil = line(&[(-23.0, -38.0), (0.0, -43.0), (23.0, -38.0)]);
    let pattern = line(&[(-20.0, -20.0), (-10.0, -12.0), (0.0, -20.0), (10.0, -12.0), (20.0, -20.0)]);
    let saucer = line(&[(-26.0, 0.0), (-20.0, 7.0), (20.0, 7.0), (26.0, 0.0), (-26.0, 0.0)]);
    let found = read(&[stem(), body(), soil, pattern, saucer]);
    assert_eq!(found.first().map(|pot| &pot.uses[..]), Some(&[1, 2, 3, 4][..]));
}

#[test]
fn leaves_may_lean_over_the_edge_and_stand_over_its_corners() {
    let leaf = |tip: (f32, f32)| {
        let (tip, root) = (Vec2::from(tip), Vec2::new(0.0, -41.0));
        let side = 0.15 * (tip - root).perp();
        let middle = root.midpoint(tip);
        page_line(&[root, middle + side, tip, middle - side, root])
    };
    let leaves = [leaf((-80.0, -60.0)), leaf((0.0, -130.0)), leaf((85.0, -58.0)), leaf((40.0, -120.0))];
    let pot = line(&[(-25.0, -40.0), (-18.0, 0.0), (18.0, 0.0), (25.0, -40.0), (-25.0, -40.0)]);
    assert_eq!(read(&[&leaves[..], &[pot]].concat()).first().map(|pot| &pot.uses[..]), Some(&[4][..]));
    let sides = [line(&[(-18.0, 1.0), (-25.0, -40.0)]), line(&[(25.0, -39.0), (19.0, 0.0)])];
    let bottom = line(&[(-18.0, 0.0), (18.0, 0.0)]);
    let parts = [bottom, sides[0].clone(), sides[1].clone()];
    assert_eq!(read(&[&leaves[..], &parts[..]].concat()).first().map(|pot| pot.uses.len()), Some(3));
}

#[test]
fn a_zigzag_below_a_flower_is_no_pot() {
    let zigzag = (0..=16).map(|k| Vec2::new(15.0 * k as f32 - 120.0, if k % 2 == 1 { -30.0 } else { 5.0 }));
    assert!(read(&[line(&[(0.0, -10.0), (2.0, -150.0)]), zigzag.collect()]).is_empty());
}

fn page_line(places: &[Vec2]) -> Vec<Vec2> {
    crate::anatomy::conventions::page::even(places, 80)
}

#[test]
fn a_hill_is_no_pot() {
    let hill = (0..=26).map(|k| 10.0 * k as f32).map(|x| Vec2::new(x, -60.0 + 0.0035 * (x - 130.0).powi(2)));
    let blade = |x: f32| line(&[(x, -58.0), (x + 4.0, -110.0)]);
    assert!(read(&[hill.collect(), blade(110.0), blade(130.0), blade(150.0)]).is_empty());
}

/// A vase with a belly: bottom, both sides and mouth.
fn vase() -> Vec<Vec<Vec2>> {
    let side = |sign: f32| {
        line(&[(22.0 * sign, 0.0), (34.0 * sign, -60.0), (18.0 * sign, -110.0), (19.0 * sign, -145.0)])
    };
    vec![line(&[(-22.0, 0.0), (22.0, 1.0)]), side(-1.0), side(1.0), line(&[(-19.0, -145.0), (19.0, -144.0)])]
}

#[test]
fn a_vase_of_four_lines_may_be_slender_and_hold_stems_beside_its_sides() {
    let stems = [-12.0, 0.0, 12.0].map(|x| line(&[(x, -140.0), (6.0 * x, -230.0)]));
    let found = read(&[vase(), stems.to_vec()].concat());
    assert_eq!(found.first().map(|pot| &pot.uses[..]), Some(&[0, 1, 2, 3][..]));
    let widest = found[0].solids[0].profile.iter().map(|p| p.x).fold(0.0, f32::max);
    assert!((widest - 34.0).abs() < 3.0, "{widest}");
}

#[test]
fn half_circles_on_a_level_line_are_no_sides() {
    let arc = |x: f32, sign: f32| {
        (0..=30)
            .map(|k| std::f32::consts::PI * k as f32 / 30.0)
            .map(move |a| Vec2::new(x + 30.0 * sign * a.sin(), -30.0 + 30.0 * a.cos()))
    };
    let top = line(&[(-30.0, -62.0), (-10.0, -95.0), (12.0, -95.0), (30.0, -62.0)]);
    let bush =
        [line(&[(-40.0, 0.0), (40.0, 0.0)]), arc(-40.0, -1.0).collect(), arc(40.0, 1.0).collect(), top];
    assert!(read(&bush).is_empty());
}

#[test]
fn blades_may_fill_the_mouth_and_fronds_on_a_trunk_hang() {
    let blade = |x: f32, lean: f32| {
        line(&[
            (x, -40.0),
            (x - 4.0 + lean, -90.0),
            (x + 2.0 * lean, -120.0),
            (x + 4.0 + lean, -85.0),
            (x, -40.0),
        ])
    };
    let blades = [(-23.0, -20.0), (-8.0, -8.0), (8.0, 8.0), (23.0, 20.0)].map(|(x, lean)| blade(x, lean));
    assert_eq!(read(&[&blades[..], &[body()]].concat()).len(), 1);
    let frond = |x: f32| line(&[(x, -40.0), (3.0 * x, -60.0), (4.5 * x, -5.0), (3.5 * x, -50.0), (x, -40.0)]);
    let fronds = [-23.0, -8.0, 8.0, 23.0].map(frond);
    assert!(read(&[&fronds[..], &[body()]].concat()).is_empty());
}

#[test]
fn what_is_wider_than_a_pot_with_a_rim_may_stand_in_it_and_a_bell_is_none() {
    let ball: Vec<Vec2> = (0..=40)
        .map(|k| 0.7 + 4.9 * k as f32 / 40.0)
        .map(|a| Vec2::new(38.0 * -a.sin(), -74.0 + 38.0 * a.cos()))
        .collect();
    let rim = line(&[(-28.0, -46.0), (28.0, -46.0), (28.0, -38.0), (-28.0, -38.0), (-28.0, -46.0)]);
    assert_eq!(read(&[ball.clone(), body(), rim]).first().map(|pot| &pot.uses[..]), Some(&[1, 2][..]));
    assert!(read(&[ball, body()]).is_empty(), "a crown on a trunk");
    let bell = line(&[(0.0, -40.0), (-18.0, -28.0), (-22.0, 0.0), (22.0, 0.0), (18.0, -28.0), (0.0, -40.0)]);
    let pedicel = line(&[(0.0, -60.0), (2.0, -36.0)]);
    let crook = line(&[(-60.0, 120.0), (-50.0, -20.0), (0.0, -60.0), (60.0, -70.0)]);
    assert!(read(&[pedicel, crook, bell]).is_empty());
}

#[test]
fn stems_that_trail_over_its_edge_are_a_plant_and_fronds_on_a_trunk_are_not() {
    let stem = |sign: f32| {
        line(&[(12.0, -40.0), (22.0, -52.0), (40.0, -30.0), (42.0, 60.0)].map(|(x, y)| (sign * x, y)))
    };
    let leaf =
        |x: f32, y: f32| line(&[(x, y), (x + 10.0, y - 8.0), (x + 18.0, y), (x + 8.0, y + 5.0), (x, y)]);
    let vines = [stem(-1.0), stem(1.0), leaf(42.0, 20.0), leaf(-42.0, 40.0)];
    assert_eq!(read(&[&vines[..], &[body()]].concat()).first().map(|pot| &pot.uses[..]), Some(&[4][..]));
    let trunk = line(&[(-18.0, -40.0), (-22.0, 0.0), (22.0, 0.0), (18.0, -40.0)]);
    assert!(read(&[&vines[..], &[trunk]].concat()).is_empty());
}
