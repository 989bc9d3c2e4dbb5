//! Trees that change: the surface is that of the whole tree in every bit.

use super::*;
use crate::model::tube::{self, TubeParams};
use crate::plant::{Origin, Role, WoodPart};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A branch with the number of the one that carries it, and its bark.
type Grown = (Branch, Option<usize>, usize);

fn branch(from: Vec3, direction: Vec3, length: f32, radius: f32) -> Branch {
    let along = direction.normalize_or(Vec3::Y) * length;
    let bend = along.any_orthogonal_vector() * 0.1;
    let point = |t: f32| from + along * t + bend * (t * (1.0 - t));
    let steps = (0..=10u8).map(|k| f32::from(k) / 10.0);
    Branch {
        origin: Origin::Generated,
        parent: None,
        level: 0,
        points: steps.clone().map(point).collect(),
        radii: steps.map(|t| radius * (1.0 - 0.6 * t)).collect(),
        role: Role::of(WoodPart::Stem),
    }
}

fn tree(seed: u64, count: usize) -> Vec<Grown> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tree = vec![(branch(Vec3::ZERO, Vec3::Y, 2.0, 0.1), None, 0)];
    while tree.len() < count {
        let on = random.random_range(0..tree.len());
        let twig = grown(&tree, on, &mut random);
        tree.push(twig);
    }
    tree
}

/// A branch that grows on another: from its side, from its end or from beside another one.
fn grown(tree: &[Grown], on: usize, random: &mut Pcg64Mcg) -> Grown {
    let parent = &tree[on].0;
    let share = random.random_range(0..=10usize);
    let along = parent.points[10] - parent.points[0];
    let mut turn = || random.random_range(-1.0..1.0f32);
    let direction = along.normalize() + Vec3::new(turn(), turn(), turn()) * 1.3;
    let length = along.length() * random.random_range(0.05..0.7);
    let thickness = random.random_range(0.2..0.9);
    let twig = branch(parent.points[share], direction, length, parent.radii[share] * thickness);
    (twig, Some(on), random.random_range(0..3) / 2)
}

/// A change as a hand makes it.
fn change(tree: &mut Vec<Grown>, (what, which): (u8, usize), random: &mut Pcg64Mcg) {
    let chosen = which % tree.len();
    match what {
        0 => {
            let twig = grown(tree, chosen, random);
            tree.push(twig);
        }
        // One of the middle, so that the numbers of all later ones change.
        1 => {
            let twig = grown(tree, chosen, random);
            tree.insert(chosen + 1, twig);
            for (_, parent, _) in &mut tree[chosen + 2..] {
                *parent = parent.map(|parent| if parent > chosen { parent + 1 } else { parent });
            }
        }
        2 => {
            let (twig, _, _) = &mut tree[chosen];
            let last = twig.points.len() - 1;
            twig.points[last] += Vec3::new(0.02, 0.05, -0.03) * random.random_range(0.1..1.0);
        }
        3 => tree[chosen].0.radii.iter_mut().for_each(|radius| *radius *= 0.9),
        4 => tree[chosen].2 = which % 2,
        // Twins, which only their places tell apart.
        5 => {
            let twin = tree[chosen].clone();
            tree.push((twin.0, twin.1.or(Some(0)), twin.2));
        }
        _ => {
            let is_bare = |i: &usize| *i > 0 && tree.iter().all(|(_, parent, _)| *parent != Some(*i));
            if let Some(bare) = (chosen..tree.len()).chain(0..chosen).find(is_bare) {
                tree.remove(bare);
                for (_, parent, _) in &mut tree[bare..] {
                    *parent = parent.map(|parent| if parent > bare { parent - 1 } else { parent });
                }
            }
        }
    }
}

/// The surface made with a memory and how many of its limbs were taken from the last one.
fn assert_same(memory: &mut WoodMemory, tree: &[Grown], unit: f32) {
    let first = tree[0].2;
    let twig = |(branch, parent, slot): &Grown| {
        let slot = if *slot == first { 0 } else { 1 };
        (branch.clone(), *parent, slot)
    };
    let tree: Vec<Grown> = tree.iter().map(twig).collect();
    let twigs: Vec<WoodBranch<&Branch>> = tree
        .iter()
        .map(|(branch, parent, slot)| WoodBranch { branch, parent: *parent, slot: *slot })
        .collect();
    let look = |branch: &Branch| tube::look(branch, &TubeParams::default(), unit);
    let kept = memory.mesh(&twigs, look, unit, &mut WoodScratch::default());
    let whole = wood::mesh(&twigs, look, &mut WoodScratch::default());
    assert_eq!(*kept, whole);
    let bits = |mesh: &Mesh| -> Vec<u32> {
        let points = mesh.points.iter().flat_map(Vec3::to_array);
        let corners =
            mesh.vertices.iter().flat_map(|v| v.normal.to_array().into_iter().chain(v.uv.to_array()));
        points.chain(corners).map(f32::to_bits).collect()
    };
    assert_eq!(bits(&kept), bits(&whole));
    assert_eq!(kept.check_invariants(), whole.check_invariants());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn a_tree_that_changes_has_the_surface_of_the_whole_tree(
        seed: u64,
        count in 2usize..120,
        changes in prop::collection::vec((0u8..7, 0usize..1000), 1..12),
        is_other_size in 0usize..12,
    ) {
        let mut memory = WoodMemory::default();
        let mut tree = tree(seed, count);
        let mut random = Pcg64Mcg::seed_from_u64(seed ^ 1);
        assert_same(&mut memory, &tree, 3.0);
        for (step, what) in changes.into_iter().enumerate() {
            change(&mut tree, what, &mut random);
            assert_same(&mut memory, &tree, if step == is_other_size { 4.0 } else { 3.0 });
        }
    }
}

/// Only what is near a change is made anew.
#[test]
fn a_twig_that_grows_leaves_most_of_a_tree_alone() {
    let mut tree = tree(7, 600);
    let twigs = |tree: &[Grown]| -> Vec<(Branch, Option<usize>)> {
        tree.iter().map(|(branch, parent, _)| (branch.clone(), *parent)).collect()
    };
    let survey = |tree: &[(Branch, Option<usize>)], memory: &mut WoodMemory| -> usize {
        let twigs: Vec<WoodBranch<&Branch>> =
            tree.iter().map(|(branch, parent)| WoodBranch { branch, parent: *parent, slot: 0 }).collect();
        let look = |branch: &Branch| tube::look(branch, &TubeParams::default(), 3.0);
        let mut limbs = Limbs::default();
        let places = memory.skeletons.places(&twigs);
        limbs.survey(&twigs, look, Some(Earlier { limbs: &memory.limbs, known: &places }));
        let shares = wood_changes::changed(&limbs, &memory.limbs);
        memory.mesh(&twigs, look, 3.0, &mut WoodScratch::default());
        shares.iter().filter(|share| **share != Share::Left).count()
    };
    let mut memory = WoodMemory::default();
    let all = survey(&twigs(&tree), &mut memory);
    assert_eq!(survey(&twigs(&tree), &mut memory), 0, "nothing changed");
    let mut most = 0;
    for index in tree.len() - 20..tree.len() {
        let (twig, _, _) = &mut tree[index];
        *twig.points.last_mut().unwrap() += Vec3::new(0.01, 0.02, -0.01);
        most = most.max(survey(&twigs(&tree), &mut memory));
    }
    assert!(most > 0 && 2 * most < all, "{most} of {all}");
}
