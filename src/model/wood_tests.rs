//! Joints at every angle and thickness, crowds, stubs, ends: always one closed surface.

use super::super::disjoint_sets::DisjointSets;
use super::*;
use crate::model::crossing::crossing_faces;
use crate::model::tube::{self, TubeParams};
use crate::plant::{Origin, Role, StemBase, WoodPart};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn branch(from: Vec3, direction: Vec3, length: f32, radius: f32) -> Branch {
    let steps = 0..=10u8;
    let point = |k: u8| from + direction.normalize() * (length * f32::from(k) / 10.0);
    let radii = steps.clone().map(|k| radius * (1.0 - 0.06 * f32::from(k))).collect();
    Branch {
        origin: Origin::Generated,
        parent: None,
        level: 0,
        points: steps.map(point).collect(),
        radii,
        role: Role::of(WoodPart::Stem),
    }
}

fn joined(branches: &[(Branch, Option<usize>)]) -> Mesh {
    let twigs: Vec<WoodBranch<&Branch>> =
        branches.iter().map(|(branch, parent)| WoodBranch { branch, parent: *parent, slot: 0 }).collect();
    let look = |branch: &Branch| tube::look(branch, &TubeParams::default(), 3.0);
    let mesh = mesh(&twigs, look, &mut WoodScratch::default());
    mesh.check_invariants().unwrap();
    mesh
}

fn surfaces(mesh: &Mesh) -> usize {
    let mut sets = DisjointSets::new(mesh.points.len());
    for triangle in &mesh.triangles {
        let [a, b, c] = mesh.point_triangle(*triangle);
        sets.join(a, b, false);
        sets.join(b, c, false);
    }
    (0..mesh.points.len() as u32).filter(|i| sets.root(*i) == *i).count()
}

#[test]
fn barks_of_several_kinds_are_one_surface_and_faces_stand_by_bark() {
    let limbs = [trunk().0, branch(Vec3::Y, Vec3::X, 1.0, 0.04), branch(Vec3::Y * 1.3, -Vec3::X, 1.0, 0.04)];
    let twig = |k: usize, slot| WoodBranch { branch: &limbs[k], parent: (k > 0).then_some(0), slot };
    let look = |branch: &Branch| tube::look(branch, &TubeParams::default(), 3.0);
    let mesh = mesh(&[twig(0, 0), twig(1, 1), twig(2, 0)], look, &mut WoodScratch::default());
    mesh.check_invariants().unwrap();
    assert_eq!((surfaces(&mesh), mesh.breaks.len()), (1, 1));
    let (first, second) = mesh.triangles.split_at(mesh.breaks[0] as usize);
    let reach = |faces: &[[u32; 3]], side: f32| {
        let xs = faces.iter().flat_map(|face| mesh.corners(*face)).map(|p| side * p.x);
        xs.fold(f32::NEG_INFINITY, f32::max)
    };
    assert!(reach(first, 1.0) < 0.2 && reach(first, -1.0) > 0.9, "trunk and the branch to the left");
    assert!(reach(second, 1.0) > 0.9 && reach(second, -1.0) < 0.05, "the branch to the right");
}

fn trunk() -> (Branch, Option<usize>) {
    (branch(Vec3::ZERO, Vec3::Y, 2.0, 0.1), None)
}

#[test]
fn at_any_angle_and_thickness_a_branch_grows_out_of_the_trunks_bark() {
    for degrees in [10.0f32, 20.0, 45.0, 70.0, 90.0, 120.0, 150.0] {
        for thickness in [0.1, 0.3, 0.6, 1.0, 1.6] {
            let direction = Vec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.2);
            let twig = branch(Vec3::Y * 0.9, direction, 1.5, 0.07 * thickness);
            let mesh = joined(&[trunk(), (twig, Some(0))]);
            assert_eq!(surfaces(&mesh), 1, "{degrees} degrees, {thickness} of the trunk");
            assert!(
                mesh.points.iter().any(|p| p.x > 0.15),
                "{degrees} degrees, {thickness}: nothing comes out"
            );
        }
    }
}

#[test]
fn nothing_is_left_of_the_bark_inside_a_joint() {
    let twig = branch(Vec3::Y, Vec3::X, 1.0, 0.05);
    let mesh = joined(&[trunk(), (twig, Some(0))]);
    let inside = |p: &Vec3| p.x > 0.05 && p.x < 0.12 && p.with_x(0.0).distance(Vec3::Y) < 0.02;
    assert!(!mesh.points.iter().any(inside));
}

#[test]
fn a_branch_that_stays_inside_is_not_seen_and_hands_on_what_it_carries() {
    let stub = branch(Vec3::Y, Vec3::X, 0.05, 0.02);
    let twig = branch(Vec3::new(0.04, 1.0, 0.0), Vec3::X, 0.5, 0.01);
    let alone = joined(&[trunk(), (stub.clone(), Some(0))]);
    assert!(alone.points.iter().all(|p| p.x < 0.11));
    let mesh = joined(&[trunk(), (stub, Some(0)), (twig, Some(1))]);
    assert_eq!(surfaces(&mesh), 1);
    assert!(mesh.points.iter().any(|p| p.x > 0.5));
}

#[test]
fn a_whorl_finds_room_around_its_trunk() {
    let around = |k: u8| Vec3::new((0.6 * f32::from(k)).cos(), 0.4, (0.6 * f32::from(k)).sin());
    let mut branches = vec![trunk()];
    branches.extend((0..10).map(|k| (branch(Vec3::Y, around(k), 0.8, 0.02), Some(0))));
    assert_eq!(surfaces(&joined(&branches)), 1);
}

#[test]
fn a_twig_at_the_very_end_or_the_very_foot_is_joined_too() {
    for height in [0.0, 2.0] {
        let twig = branch(Vec3::Y * height, Vec3::new(1.0, 0.3, 0.0), 0.8, 0.03);
        assert_eq!(surfaces(&joined(&[trunk(), (twig, Some(0))])), 1, "at {height} m");
    }
}

#[test]
fn random_trees_are_one_surface() {
    for seed in 0..24 {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut branches = vec![trunk()];
        for _ in 0..120 {
            let on = random.random_range(0..branches.len());
            let (parent, share) = (branches[on].0.clone(), random.random_range(1..=9));
            let turn = |random: &mut Pcg64Mcg| random.random_range(-1.0..1.0f32);
            let along = parent.points[10] - parent.points[0];
            let direction =
                along.normalize() + Vec3::new(turn(&mut random), turn(&mut random), turn(&mut random)) * 1.5;
            let (length, radius) =
                (along.length() * random.random_range(0.3..0.7), parent.radii[share] * 0.6);
            branches.push((branch(parent.points[share], direction, length, radius), Some(on)));
        }
        assert_eq!(surfaces(&joined(&branches)), 1, "seed {seed}");
    }
}

#[test]
fn normals_look_outward_and_bark_is_not_stretched_on_a_plain_stem() {
    let mesh = joined(&[trunk()]);
    for vertex in &mesh.vertices {
        let out = mesh.points[vertex.point as usize].with_y(0.0);
        assert!(
            out.length() < 0.01 || vertex.normal.y.abs() > 0.5 || vertex.normal.dot(out.normalize()) > 0.8
        );
    }
}

#[test]
fn quality_gives_more_sides_and_rings_of_one_closed_surface() {
    let mut bent = branch(Vec3::Y, Vec3::X, 1.5, 0.05);
    bent.points.iter_mut().for_each(|p| p.y += 0.1 * (4.0 * p.x).sin());
    let limbs = [trunk().0, bent];
    let faces = |quality: f32| {
        let params = TubeParams { quality, ..TubeParams::default() };
        let twigs = [0, 1].map(|k| WoodBranch { branch: &limbs[k], parent: (k > 0).then_some(0), slot: 0 });
        let mesh = mesh(&twigs, |branch| tube::look(branch, &params, 3.0), &mut WoodScratch::default());
        mesh.check_invariants().unwrap();
        assert_eq!(surfaces(&mesh), 1, "quality {quality}");
        mesh.triangles.len()
    };
    let counts = [0.25, 0.5, 1.0, 2.0, 4.0].map(faces);
    assert!(counts.windows(2).all(|w| w[1] as f32 > 1.4 * w[0] as f32), "{counts:?}");
}

#[test]
fn a_branch_on_the_end_of_another_goes_on_with_it() {
    for (thickness, turn) in [(0.9, 0.0f32), (0.6, 0.5), (0.2, 0.8), (0.9, 1.0)] {
        let end = Vec3::Y * 2.0;
        let onward = branch(end, Vec3::new(turn.sin(), turn.cos(), 0.0), 1.0, 0.04 * thickness);
        let beside = branch(end - Vec3::Y * 0.05, Vec3::new(-1.0, 0.5, 0.2), 0.8, 0.02 * thickness);
        let mesh = joined(&[trunk(), (onward.clone(), Some(0)), (beside, Some(0))]);
        assert_eq!(
            (surfaces(&mesh), crossing_faces(&mesh)),
            (1, Some(0)),
            "{thickness} thick, turned by {turn}"
        );
        let reaches = |p: Vec3| mesh.points.iter().any(|q| q.distance(p) < 0.04);
        assert!(reaches(onward.points[10]) && reaches(Vec3::new(-0.7, 2.3, 0.1)), "both are seen");
    }
}

#[test]
fn what_goes_on_from_the_end_of_another_has_its_own_bark() {
    let limbs = [trunk().0, branch(Vec3::Y * 2.0, Vec3::Y, 1.0, 0.03)];
    let twig = |k: usize| WoodBranch { branch: &limbs[k], parent: (k > 0).then_some(0), slot: k };
    let look = |branch: &Branch| tube::look(branch, &TubeParams::default(), 3.0);
    let mesh = mesh(&[twig(0), twig(1)], look, &mut WoodScratch::default());
    let (first, second) = mesh.triangles.split_at(mesh.breaks[0] as usize);
    let heights = |faces: &[[u32; 3]]| {
        let heights = faces.iter().flat_map(|face| mesh.corners(*face)).map(|p| p.y);
        heights.fold((f32::INFINITY, 0.0f32), |(low, high), y| (low.min(y), high.max(y)))
    };
    assert!(heights(first).1 < 2.1 && heights(second).0 > 1.9, "{:?}, {:?}", heights(first), heights(second));
}

#[test]
fn a_trunk_drawn_in_two_pieces_stands_on_the_lower_one() {
    let lower = branch(Vec3::ZERO, -Vec3::Y, 1.0, 0.08);
    let mesh = joined(&[trunk(), (lower, Some(0)), (branch(Vec3::Y * 0.01, Vec3::X, 0.5, 0.03), Some(0))]);
    assert_eq!((surfaces(&mesh), crossing_faces(&mesh)), (1, Some(0)));
    assert!(mesh.points.iter().any(|p| p.y < -0.95));
}

/// Stalks of herbs leave one another where both still are inside of what they stand on.
#[test]
fn a_branch_that_leaves_beside_the_foot_of_its_parent_is_led_to_free_bark() {
    for height in [0.0, 0.02, 0.06, 0.1] {
        let stem = branch(Vec3::ZERO, Vec3::Y, 1.0, 0.02);
        let first = branch(Vec3::Y * 0.05, Vec3::new(0.5, 1.0, 0.0), 0.8, 0.015);
        let second =
            branch(Vec3::new(0.5, 1.0, 0.0) * height + Vec3::Y * 0.05, Vec3::new(1.0, 0.6, 0.1), 0.5, 0.012);
        let mesh = joined(&[(stem, None), (first, Some(0)), (second, Some(1))]);
        assert_eq!((surfaces(&mesh), crossing_faces(&mesh)), (1, Some(0)), "{height} m along its parent");
    }
}

/// So many stems of one radius on their common base, which lean outward by this share of their height.
fn bush(count: usize, radius: f32, lean: f32) -> Vec<(Branch, Option<usize>)> {
    let base = StemBase::below(Vec3::ZERO, std::iter::repeat_n(radius, count));
    let stem = |below: &[(Vec3, f32)], foot: Vec3, lean: Vec3| {
        let mut stem = branch(foot, Vec3::Y + lean, 1.5, radius);
        stem.points.splice(0..0, below.iter().map(|(at, _)| *at));
        stem.radii.splice(0..0, below.iter().map(|(_, radius)| *radius));
        stem
    };
    let top = base.to_top();
    let others = base.to_sides(0.3, count - 1).map(|side| {
        let lean = lean * side.with_y(0.0).normalize();
        (stem(&[(base.start(side), radius)], side, lean), Some(0))
    });
    std::iter::once((stem(&base.skeleton(top), top, Vec3::ZERO), None)).chain(others).collect()
}

#[test]
fn the_base_of_a_bush_has_bark_for_every_joint() {
    for (lean, most) in [(0.3, 25), (1.0, 30), (2.0, 30)] {
        for count in 2..=most {
            let mesh = joined(&bush(count, 0.02, lean));
            assert_eq!((surfaces(&mesh), crossing_faces(&mesh)), (1, Some(0)), "{count} stems, lean {lean}");
        }
    }
}

/// A branch on one straight line, thinner toward its end.
fn retraced(places: &[f32], radius: f32) -> Branch {
    let line = Vec3::new(0.62963945, -0.44135604, 0.63934296);
    let foot = Vec3::new(0.0, -0.36887163, -0.26782367);
    let radii = (0..places.len()).map(|k| radius * (1.0 - 0.2 * k as f32 / places.len() as f32)).collect();
    Branch {
        points: places.iter().map(|place| foot + line * *place).collect(),
        radii,
        ..branch(Vec3::ZERO, Vec3::Y, 1.0, radius)
    }
}

#[test]
fn a_branch_that_goes_out_and_back_and_out_again_on_one_line_is_sound() {
    let points = [
        Vec3::new(0.0, -0.36887163, -0.26782367),
        Vec3::new(0.62963945, -0.8102273, 0.3715193),
        Vec3::new(0.06354135, -0.4132873, -0.20299292),
        Vec3::new(1.2592789, -1.251583, 1.0108622),
    ];
    let radii = vec![0.000135, 0.000102, 0.000069, 0.000036];
    let found = Branch { points: points.to_vec(), radii, ..branch(Vec3::ZERO, Vec3::Y, 1.0, 1.0) };
    joined(&[(found, None)]);
    for places in [
        &[0.0, 1.0, 0.1, 2.0][..],
        &[0.0, 1.0, 0.0, 1.0],
        &[0.0, 1.0, 0.0, 1.0, 0.0, 1.0],
        &[0.0, 2.0, 1.0, 2.0, 1.0, 3.0],
    ] {
        for radius in [1e-5, 1e-4, 1e-3, 0.01, 0.1] {
            let again = retraced(places, radius);
            let even = Branch { radii: vec![radius; places.len()], ..again.clone() };
            for branch in [again, even] {
                joined(&[(branch.clone(), None)]);
                let look = tube::look(&branch, &TubeParams::default(), 3.0);
                let mesh = tube::branch(&branch, look, &mut tube::TubeScratch::default());
                assert_eq!(mesh.check_invariants(), Ok(()), "{places:?} {radius}");
            }
        }
    }
}
