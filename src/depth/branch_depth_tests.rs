//! Branches in space: still the drawing from the front, spread, no longer than allowed, the same every time.

use super::*;
use crate::anatomy::Sample;
use proptest::prelude::*;

fn branch(parent: Option<usize>, attached_at: f32, level: u32, line: &[Vec2]) -> FlatBranch {
    let sample = |&position: &Vec2| Sample { position, pressure: 0.5, tilt_deg: Vec2::ZERO };
    let key = attached_at.to_bits().into();
    FlatBranch {
        stroke: None,
        key,
        line: line.iter().map(sample).collect(),
        half_width: None,
        parent,
        attached_at,
        level,
    }
}

/// A trunk 400 px high with `count` children, alternately left and right.
fn alternating(count: usize) -> Vec<FlatBranch> {
    let trunk: Vec<_> = (0..=20).map(|i| Vec2::new(300.0, 500.0 - 20.0 * i as f32)).collect();
    let mut all = vec![branch(None, 0.0, 0, &trunk)];
    for k in 0..count {
        let at = 60.0 + 320.0 * k as f32 / count as f32;
        let base = Vec2::new(300.0, 500.0 - at);
        let side = if k % 2 == 0 { -1.0 } else { 1.0 };
        let line: Vec<_> = (0..=10).map(|i| base + Vec2::new(side * 8.0, -6.0) * i as f32).collect();
        all.push(branch(Some(0), at, 1, &line));
    }
    all
}

fn length(branch: &FlatBranch, depths: &[f32]) -> f32 {
    let points: Vec<_> = branch.line.iter().zip(depths).map(|(s, &z)| s.position.extend(z)).collect();
    polyline::length(&points)
}

fn drawn_length(branch: &FlatBranch) -> f32 {
    length(branch, &vec![0.0; branch.line.len()])
}

fn depths(branches: &[FlatBranch]) -> Vec<Vec<f32>> {
    branch_depths(branches, &BranchDepthParams::default(), 1)
}

#[test]
fn eight_children_use_all_quadrants_around_the_trunk() {
    for seed in 0..20 {
        let all = alternating(8);
        let depths = branch_depths(&all, &BranchDepthParams::default(), seed);
        let mut quadrants = [0; 4];
        for (b, z) in all.iter().zip(&depths).skip(1) {
            let sideways = b.line[10].position.x - b.line[0].position.x;
            quadrants[usize::from(sideways > 0.0) * 2 + usize::from(z[10] > z[0])] += 1;
        }
        assert!(quadrants.iter().all(|&n| n >= 1), "seed {seed}: {quadrants:?}");
    }
}

#[test]
fn neighbours_on_one_side_stand_apart() {
    let depths = depths(&alternating(8));
    let rises: Vec<f32> = (1..9).map(|i| (depths[i][10] / 100.0).atan().to_degrees()).collect();
    for side in 0..2 {
        let mut angles: Vec<f32> = rises.iter().copied().skip(side).step_by(2).collect();
        angles.sort_by(f32::total_cmp);
        assert!(angles[3] - angles[0] > 40.0, "{angles:?}");
    }
}

#[test]
fn trunks_stay_in_the_drawing_plane() {
    let mut all = alternating(5);
    all.push(branch(None, 0.0, 0, &[Vec2::new(600.0, 500.0), Vec2::new(620.0, 200.0)]));
    let depths = depths(&all);
    assert!(depths[0].iter().chain(&depths[6]).all(|&z| z == 0.0));
}

#[test]
fn children_start_at_their_parents_depth() {
    let mut all = alternating(2);
    let base = all[1].line[5].position;
    all.push(branch(Some(1), 50.0, 2, &[base, base + Vec2::new(-5.0, -40.0)]));
    let depths = depths(&all);
    assert!((depths[3][0] - depths[1][5]).abs() < 1e-3);
    assert!(depths[1][0] == 0.0);
}

#[test]
fn an_only_child_leaves_the_plane_by_chance_alone() {
    let all = alternating(1);
    let still = BranchDepthParams { jitter: 0.0, ..BranchDepthParams::default() };
    assert!(branch_depths(&all, &still, 1)[1].iter().all(|z| z.abs() < 1e-3));
    assert!(depths(&all)[1][10].abs() < 50.0);
}

#[test]
fn a_new_stroke_does_not_move_the_branches_of_other_parents() {
    let mut all = alternating(6);
    let before = depths(&all);
    all.push(branch(Some(3), 40.0, 2, &[Vec2::ZERO, Vec2::new(30.0, 10.0)]));
    assert_eq!(before[..], depths(&all)[..7]);
}

#[test]
fn resisting_stretch_flattens_the_plant() {
    let all = alternating(12);
    let reach = |stretch| {
        let params = BranchDepthParams { stretch, jitter: 0.0, ..BranchDepthParams::default() };
        branch_depths(&all, &params, 1).iter().flatten().map(|z| z.abs()).fold(0.0, f32::max)
    };
    assert!(reach(10.0) < 0.7 * reach(0.5), "{} and {}", reach(10.0), reach(0.5));
}

#[test]
fn nothing_gives_nothing() {
    assert!(depths(&[]).is_empty());
    let odd = vec![branch(Some(7), 5.0, 0, &[]), branch(Some(0), -3.0, 1, &[Vec2::ONE; 4])];
    assert!(depths(&odd).iter().flatten().all(|&z| z == 0.0));
}

fn random_tree() -> impl Strategy<Value = Vec<FlatBranch>> {
    let twig =
        (any::<prop::sample::Index>(), 0.0..1.0f32, prop::collection::vec((-60..60i32, -60..60i32), 1..12));
    prop::collection::vec(twig, 0..60).prop_map(|twigs| {
        let mut all =
            vec![branch(None, 0.0, 0, &[Vec2::ZERO, Vec2::new(3.0, -200.0), Vec2::new(0.0, -400.0)])];
        for (parent, share, steps) in twigs {
            let parent = parent.index(all.len());
            let run = arc_lengths(&all[parent]);
            let at = share * run[run.len() - 1];
            let values =
                |f: fn(Vec2) -> f32| all[parent].line.iter().map(|s| f(s.position)).collect::<Vec<_>>();
            let mut p =
                Vec2::new(interpolated(&run, &values(|v| v.x), at), interpolated(&run, &values(|v| v.y), at));
            let mut line = vec![p];
            for (x, y) in steps {
                p += Vec2::new(x as f32, y as f32);
                line.push(p);
            }
            let level = all[parent].level + 1;
            all.push(branch(Some(parent), at, level, &line));
        }
        all
    })
}

proptest! {
    #[test]
    fn no_branch_is_stretched_too_far(
        all in random_tree(), seed in any::<u64>(), max_stretch in 1.0..4.0f32, max_angle in 0.0..80.0f32,
    ) {
        let params = BranchDepthParams { max_stretch, max_angle, ..BranchDepthParams::default() };
        let depths = branch_depths(&all, &params, seed);
        for (b, z) in all.iter().zip(&depths) {
            prop_assert_eq!(b.line.len(), z.len());
            prop_assert!(z.iter().all(|z| z.is_finite()));
            // The tolerance covers the rounding of depths in f32 far from the plane.
            prop_assert!(length(b, z) <= max_stretch * drawn_length(b) * 1.001 + 0.01);
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_bytes(all in random_tree(), seed in any::<u64>()) {
        let params = BranchDepthParams::default();
        prop_assert_eq!(branch_depths(&all, &params, seed), branch_depths(&all, &params, seed));
    }
}
