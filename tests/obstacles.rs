//! Plants among walls and trellises: wood passes nothing, trees turn away, climbing species hold on.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use glam::Vec3;
use penstemon::growth::{Limits, Obstacles, Simulation};
use penstemon::pipeline::{self, Built, Cache, Seed};
use penstemon::plant::{Blade, OrganKind, Shape};
use penstemon::species::Species;
use std::path::Path;
use std::sync::Arc;

/// A wall behind the plant; its front stands at z = −`behind`.
fn wall(width: f32, height: f32, behind: f32) -> Arc<Obstacles> {
    Arc::new(Obstacles::wall(Vec3::new(width, height, 0.2)).moved(Vec3::Z * (-behind - 0.1)))
}

fn grown(name: &str, age: f32, obstacles: Option<Arc<Obstacles>>) -> (Simulation, Built) {
    let species = Species::built_in(name).unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let seed = Seed { number: 3, age: Some(age), obstacles, ..Seed::default() };
    let mut cache = Cache::default();
    let built = pipeline::build_with(&mut cache, &seed, &species, &params, &|| false).unwrap();
    (cache.seed.simulation().unwrap().clone(), built)
}

/// Internodes that pass through an obstacle, and all.
fn passing(simulation: &Simulation, obstacles: &Obstacles) -> (usize, usize) {
    let nodes = &simulation.tree().nodes;
    let internodes =
        || (0..nodes.at.len()).filter_map(|i| Some((nodes.at.get(nodes.parent[i] as usize)?, nodes.at[i])));
    (internodes().filter(|(from, to)| obstacles.crosses(**from, *to)).count(), internodes().count())
}

fn leaves(built: &Built) -> impl Iterator<Item = &Blade> {
    let leaves = built.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Leaf);
    leaves.filter_map(|leaf| match &leaf.shape {
        Shape::Blade(blade) => Some(blade),
        _ => None,
    })
}

fn middle_of_leaves(built: &Built) -> Vec3 {
    leaves(built).map(|leaf| leaf.base).sum::<Vec3>() / leaves(built).count().max(1) as f32
}

fn height(built: &Built) -> f32 {
    leaves(built).map(|leaf| leaf.base.y).fold(0.0, f32::max)
}

#[test]
fn no_wood_passes_an_obstacle_and_no_leaf_either() {
    let trellis = Arc::new(Obstacles::trellis(3.0, 2.5).moved(Vec3::Z * -0.4));
    for (name, age, obstacles) in [
        ("oak", 14.0, wall(6.0, 3.0, 0.7)),
        ("box", 12.0, wall(3.0, 1.0, 0.3)),
        ("hazel", 12.0, trellis.clone()),
        ("ivy", 14.0, wall(3.0, 1.5, 0.2)),
        ("clematis", 8.0, trellis),
    ] {
        let (simulation, built) = grown(name, age, Some(obstacles.clone()));
        let (passing, all) = passing(&simulation, &obstacles);
        assert!(passing == 0 && all > 300, "{name}: {passing} of {all}");
        let through = |leaf: &&Blade| obstacles.crosses(leaf.base, leaf.base + leaf.v);
        let count = leaves(&built).count();
        let through = leaves(&built).filter(through).count();
        assert!(through == 0 && count > 100, "{name}: {through} of {count} leaves");
        // Wood is bent aside and rounded where it stands thick; a trunk that was thicker than its way may touch.
        let pieces = || built.plant.branches.iter().flat_map(|branch| branch.points.windows(2));
        let through = pieces().filter(|w| obstacles.crosses(w[0], w[1])).count();
        assert!(through * 100 <= pieces().count(), "{name}: {through} of {} pieces", pieces().count());
    }
}

#[test]
fn a_tree_turns_away_from_a_wall_and_grows_over_it() {
    let (_, alone) = grown("oak", 14.0, None);
    let obstacles = wall(8.0, 2.5, 0.6);
    let (_, beside) = grown("oak", 14.0, Some(obstacles));
    assert!(height(&beside) > 2.5 + 0.5, "{}", height(&beside));
    let turned = middle_of_leaves(&beside).z - middle_of_leaves(&alone).z;
    assert!(turned > 0.2, "{turned}");
}

#[test]
fn ivy_covers_a_wall_its_leaves_before_it_and_facing_away() {
    let obstacles = wall(3.0, 2.5, 0.2);
    let (_, built) = grown("ivy", 14.0, Some(obstacles.clone()));
    let all = leaves(&built).count();
    let near = leaves(&built).filter(|leaf| obstacles.is_within(0.1, leaf.base)).count();
    assert!(near * 100 >= all * 85, "{near} of {all} leaves at the wall");
    let front = |leaf: &&Blade| (0.3..2.2).contains(&leaf.base.y) && leaf.base.z > -0.2 && leaf.base.z < -0.1;
    let faces = |leaf: &&Blade| leaf.u.cross(leaf.v).normalize().z.abs() > 0.5;
    let (front, facing) =
        (leaves(&built).filter(front).count(), leaves(&built).filter(front).filter(faces).count());
    assert!(front > 300 && facing * 10 >= front * 9, "{facing} of {front} leaves face away from it");
    // A square decimetre of the middle of the wall is covered where a leaf begins within it or next to it.
    let covered = |x: i32, y: i32| {
        let at = Vec3::new(x as f32 * 0.1, 0.6 + y as f32 * 0.1, -0.2);
        leaves(&built).any(|leaf| leaf.base.distance(at) < 0.15)
    };
    let squares = (-5..=5).flat_map(|x| (0..10).map(move |y| (x, y)));
    let count = squares.filter(|(x, y)| covered(*x, *y)).count();
    assert!(count >= 90, "{count} of 110 square decimetres");
}

#[test]
fn ivy_without_a_wall_covers_the_ground() {
    let (_, built) = grown("ivy", 10.0, None);
    let low = leaves(&built).filter(|leaf| leaf.base.y < 0.15).count();
    let all = leaves(&built).count();
    assert!(all > 300 && low * 10 >= all * 9, "{low} of {all}");
}

#[test]
fn clematis_climbs_its_trellis_and_flowers_there() {
    let trellis = Arc::new(Obstacles::trellis(1.5, 2.0).moved(Vec3::Z * -0.2));
    let (_, with) = grown("clematis", 9.0, Some(trellis.clone()));
    let (_, without) = grown("clematis", 9.0, None);
    assert!(height(&with) > 1.5 && height(&without) < 0.8, "{} {}", height(&with), height(&without));
    assert!(with.plant.flowers.len() > 10, "{} flowers", with.plant.flowers.len());
    let points = || with.plant.branches.iter().flat_map(|branch| &branch.points);
    let near = points().filter(|p| trellis.is_within(0.25, **p)).count();
    assert!(near * 10 >= points().count() * 8, "{near} of {}", points().count());
}

#[test]
fn a_plant_among_obstacles_goes_back_and_grows_the_same_again() {
    for name in ["oak", "ivy"] {
        let habit = Species::built_in(name).unwrap().growth.unwrap();
        let begin = || Simulation::new(&habit, 5, Limits::default()).among(wall(4.0, 2.0, 0.5));
        let mut once = begin();
        once.grow_to(9, &|| false);
        let mut again = begin();
        again.grow_to(7, &|| false);
        again.rewind(3);
        again.grow_to(9, &|| false);
        assert_eq!(once.tree(), again.tree(), "{name}");
        assert_eq!(once.steps(), again.steps(), "{name}");
        // One that was there before it stood among them is forgotten.
        let mut late = Simulation::new(&habit, 5, Limits::default());
        late.grow_to(4, &|| false);
        let mut late = late.among(wall(4.0, 2.0, 0.5));
        late.grow_to(9, &|| false);
        assert_eq!(once.tree(), late.tree(), "{name}");
    }
}

#[test]
fn a_plant_that_fills_a_volume_leaves_room_for_an_obstacle() {
    let species = Species::built_in("box").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let volume =
        penstemon::growth::Envelope::Box { low: Vec3::new(-0.8, 0.0, -0.8), high: Vec3::new(0.8, 1.4, 0.8) };
    let obstacles = wall(3.0, 2.0, 0.2);
    let seed = Seed {
        number: 3,
        volume: Some(Arc::new(volume)),
        obstacles: Some(obstacles.clone()),
        ..Seed::default()
    };
    let mut cache = Cache::default();
    let built = pipeline::build_with(&mut cache, &seed, &species, &params, &|| false).unwrap();
    assert_eq!(passing(cache.seed.simulation().unwrap(), &obstacles).0, 0);
    // Leaves stand on the bark.
    let behind = leaves(&built).filter(|leaf| leaf.base.z < -0.21).count();
    let before = leaves(&built).count() - behind;
    assert!(before > 500 && behind == 0, "{behind} leaves behind the wall of {before}");
}

#[test]
fn a_drawing_grows_up_the_wall_that_its_parameters_put_behind_it() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches/tree_willow.penstemon");
    let (sketch, _) = penstemon::sketch::read::read(&file).unwrap();
    let ivy = Species::built_in("ivy").unwrap();
    let params = |behind: &str| {
        let set =
            ["obstacle.kind=wall", "obstacle.width=6", "growth.years=6", "depth.world.height=1.5", behind];
        pipeline::params_of(&sketch, &ivy, &set.map(str::to_owned)).unwrap()
    };
    let mut cache = Cache::default();
    let mut near = Vec::new();
    // With one cache, as in the window: each is as if it were the first.
    for behind in ["obstacle.behind=0.3", "obstacle.behind=30", "obstacle.behind=0.3"] {
        let params = params(behind);
        let built = pipeline::build_with(&mut cache, &sketch, &ivy, &params, &|| false).unwrap();
        let fresh = pipeline::build(&sketch, &ivy, &params);
        assert_eq!(built.model, fresh.model, "{behind}");
        let obstacles = built.obstacles.clone().unwrap();
        near.push(leaves(&built).filter(|leaf| obstacles.is_within(0.08, leaf.base)).count());
        let seen = pipeline::seen(&built);
        assert_eq!(seen.model.parts.len(), built.model.parts.len() + 1);
    }
    assert!(near[0] > 100 && near[1] == 0 && near[2] == near[0], "{near:?}");
}
