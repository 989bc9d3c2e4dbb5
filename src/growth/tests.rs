//! Tests of whole plants.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use super::*;
use crate::budget::Budget;
use crate::growth::habit::{Arrangement, Control, CrownHabit, Resource, SpaceHabit, Toward};
use crate::growth::resource::priority::{self, Priority};
use crate::growth::resource::vigour::Flow;
use crate::growth::tree::NONE;
use crate::params::{Overrides, Parameters as _};
use crate::plant::{Branch, Plant, Provenance, Role, WoodPart};
use crate::random::{mix, unit};
use glam::{Vec2, Vec3};
use proptest::prelude::*;
use std::sync::Arc;

const LIMITS: Limits = Limits {
    internodes: 20_000,
    markers: 50_000,
    voxels: 4 << 20,
    steps: 2_000_000_000,
    ..Limits::within(&Budget::PLANT)
};

fn never() -> bool {
    false
}

fn lit() -> Habit {
    let mut habit = Habit { internode: 0.3, shed: 0.02.into(), ..Habit::default() };
    habit.light.darkening = 0.04;
    habit
}

fn spacious() -> Habit {
    let space = SpaceHabit { markers: 300.0, ..SpaceHabit::default() };
    Habit {
        resource: Resource::Space,
        internode: 0.25,
        height: 5.0,
        shed: 0.0.into(),
        space,
        ..Habit::default()
    }
}

fn grown(habit: &Habit, age: u16) -> Simulation {
    let mut simulation = Simulation::new(habit, 3, LIMITS);
    simulation.grow_to(age, &never);
    simulation.tree().check_invariants().unwrap();
    simulation
}

/// Sum of what the buds earn and sum of what they get.
fn earned_and_got(tree: &Tree, share_out: impl Fn(&mut Flow, &[f32])) -> (f32, f32) {
    let q: Vec<f32> = tree.open.iter().map(|b| (unit(mix(9, u64::from(*b))) * 1.4 - 0.4).max(0.0)).collect();
    let mut flow = Flow::default();
    flow.gather(tree, &q);
    share_out(&mut flow, &q);
    (q.iter().sum(), flow.bud.iter().sum())
}

#[test]
fn both_vigour_models_give_out_exactly_what_was_earned() {
    let simulation = grown(&lit(), 9);
    let tree = simulation.tree();
    assert!(tree.open.len() > 100);
    for lambda in [0.0, 0.3, 0.5, 0.9, 1.0] {
        let (earned, got) = earned_and_got(tree, |flow, q| flow.share_out(tree, q, 2.0, |_| lambda));
        assert!((got - 2.0 * earned).abs() < 1e-3 * earned, "λ {lambda}: {got} of {earned}");
    }
    for kappa in [0.0, 0.1, 0.25, 0.5, 1.0] {
        for (apical_first, most, least) in [
            (false, 1.0, 0.006),
            (true, 1.0, 0.006),
            (false, 1.0, 0.0),
            (true, 0.001, 0.0),
            (true, 10.0, 10.0),
        ] {
            let rule = Priority { kappa, most, least, apical_first };
            let (earned, got) =
                earned_and_got(tree, |flow, q| priority::share_out(flow, tree, q, 1.5, |_| rule));
            assert!((got - 1.5 * earned).abs() < 1e-3 * earned, "{rule:?}: {got} of {earned}");
        }
    }
}

#[test]
fn what_a_node_occupies_no_other_has_and_nobody_is_left_out() {
    let simulation = grown(&spacious(), 12);
    let Field::Space(markers) = simulation.field() else { panic!("no markers") };
    let (tree, habit) = (simulation.tree(), simulation.habit());
    let radius = habit.space.occupancy * habit.internode;
    assert!(tree.len() > 200 && markers.occupied().count() > 1000);
    for (at, owner) in markers.occupied() {
        assert!(tree.nodes.at[owner as usize].distance(at) <= radius * 1.0001);
    }
    for free in markers.free() {
        assert!(tree.nodes.at.iter().all(|node| node.distance(free) > radius));
    }
}

/// The outline of a heart.
pub(super) fn heart() -> Vec<Vec2> {
    let at = |k: i32| {
        let t = k as f32 / 60.0 * std::f32::consts::TAU;
        let y = 13.0 * t.cos() - 5.0 * (2.0 * t).cos() - 2.0 * (3.0 * t).cos() - (4.0 * t).cos();
        Vec2::new(16.0 * t.sin().powi(3), y + 20.0) * 0.15
    };
    (0..60).map(at).collect()
}

#[test]
fn no_branch_leaves_its_envelope() {
    let centre = Vec3::Y * 4.0;
    let solid = "v 0 0 0\nv 3 0 0\nv 0 0 3\nv 0 6 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
    let volumes = [
        Envelope::Box { low: Vec3::new(-1.0, 1.0, -1.0), high: Vec3::new(2.0, 4.0, 1.0) },
        Envelope::Sphere { centre, radius: 2.0 },
        Envelope::Ellipsoid { centre, radii: Vec3::new(1.0, 3.0, 2.0) },
        Envelope::Solid(Arc::new(Solid::from_obj(solid, "tetrahedron").unwrap())),
        Envelope::Inflated(Arc::new(Inflated::new(vec![heart()], 1.0).unwrap())),
    ];
    for volume in volumes {
        let mut simulation = Simulation::in_envelope(&spacious(), volume.clone(), 5, LIMITS);
        simulation.grow_to(14, &never);
        simulation.check_envelope().unwrap();
        assert!(simulation.tree().len() > 300, "{} nodes in {volume:?}", simulation.tree().len());
        let plant = plant_at(&simulation, 14.0).plant;
        plant.check_invariants().unwrap();
    }
    let crown = CrownHabit { height: 4.0, width: 3.0, ..CrownHabit::default() };
    let own = grown(&Habit { crown: Some(crown), ..lit() }, 14);
    own.check_envelope().unwrap();
    assert!(own.tree().nodes.at.iter().all(|p| p.y <= 4.0));
}

#[test]
fn any_number_of_threads_grows_the_same_tree() {
    for habit in [lit(), spacious()] {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| plant_at(&grown(&habit, 12), 11.5))
        };
        assert_eq!(on(1), on(8));
    }
}

#[test]
fn going_back_and_on_gives_the_same_tree() {
    for habit in [Habit { shed: 0.1.into(), flowering: 0.3.into(), flower_age: 5.0, ..lit() }, spacious()] {
        let straight = grown(&habit, 12);
        let mut wandering = grown(&habit, 7);
        let at_seven = wandering.tree().clone();
        wandering.grow_to(11, &never);
        assert_eq!(plant_at(&wandering, 7.0), plant_at(&grown(&habit, 7), 7.0), "ages are kept");
        wandering.rewind(7);
        assert_eq!(*wandering.tree(), at_seven);
        wandering.rewind(2);
        wandering.grow_to(12, &never);
        assert_eq!(wandering.tree(), straight.tree());
    }
}

#[test]
fn a_year_that_is_stopped_did_not_happen() {
    let mut simulation = grown(&lit(), 6);
    let before = simulation.tree().clone();
    assert_eq!(simulation.step(&|| true), Outcome::Stopped);
    assert_eq!((simulation.age(), simulation.tree()), (6, &before));
    for habit in [lit(), spacious()] {
        let whole = grown(&habit, 10);
        let mut simulation = grown(&habit, 9);
        let before = simulation.tree().clone();
        let mut stops = 0;
        // Stopped at its first question, at its second and so on, until the year goes through.
        while simulation.age() == 9 {
            let asked = std::cell::Cell::new(0);
            let stop = || asked.replace(asked.get() + 1) == stops;
            if simulation.step(&stop) == Outcome::Stopped {
                assert_eq!((simulation.age(), simulation.tree()), (9, &before));
            }
            stops += 1;
        }
        assert!(stops > 5 && simulation.tree() == whole.tree(), "{stops} stops");
    }
}

/// Length of the trunk's axis over the mean length of its laterals with all they carry.
fn leader_to_laterals(simulation: &Simulation) -> f32 {
    let nodes = &simulation.tree().nodes;
    let (mut trunk, mut rest, mut laterals) = (0.0, 0.0, 0.0);
    for i in 0..simulation.tree().len() {
        if nodes.parent[i] == NONE {
            continue;
        }
        let length = nodes.at[i].distance(nodes.at[nodes.parent[i] as usize]);
        if nodes.order[i] == 0 {
            trunk += length
        } else {
            rest += length
        }
        laterals += f32::from(u8::from(nodes.order[i] == 1 && simulation.tree().begins_lateral(i)));
    }
    trunk * laterals / f32::max(rest, 1e-6)
}

#[test]
fn lambda_and_kappa_move_the_leader_monotonically() {
    let plain = Habit { wander: 0.0.into(), shed: 0.0.into(), shoot: 60, ..lit() };
    let lambda = [0.42, 0.46, 0.5, 0.54, 0.58].map(|lambda: f32| {
        let habit = Habit { lambda: lambda.into(), lambda_branch: lambda.into(), ..plain.clone() };
        leader_to_laterals(&grown(&habit, 6))
    });
    assert!(lambda.is_sorted() && lambda[4] > 1.5 * lambda[0], "{lambda:?}");
    // Up to 0.35 a leader takes all, in short queues by the same weights.
    let kappa = [0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0].map(|kappa: f32| {
        let habit = Habit { control: Control::Priority, kappa: kappa.into(), ..plain.clone() };
        leader_to_laterals(&grown(&habit, 6))
    });
    assert!(kappa[2..].iter().rev().is_sorted() && kappa[3] > 1.5 * kappa[6], "{kappa:?}");
    assert!(kappa[..3].iter().all(|leader| *leader > 1.5 * kappa[3]), "{kappa:?}");
}

/// Lateral buds of each node of the trunk above its foot.
fn laterals_of_the_trunk(simulation: &Simulation) -> Vec<usize> {
    let tree = simulation.tree();
    let of = |i: usize| {
        (0..tree.buds.node.len()).filter(move |b| tree.buds.node[*b] == i as u32 && !tree.buds.apical[*b])
    };
    let trunk = (1..tree.len()).filter(|i| tree.nodes.order[*i] == 0);
    trunk.map(|i| of(i).count()).collect()
}

#[test]
fn ramification_is_the_share_of_nodes_with_buds() {
    let grown_with = |ramification: f32| {
        let habit = Habit { ramification: ramification.into(), shoot: 60, lambda: 0.9.into(), ..lit() };
        grown(&habit, 30)
    };
    let bare = grown_with(0.0);
    assert!(bare.tree().len() > 20 && bare.tree().nodes.order.iter().all(|order| *order == 0), "a whip");
    assert!(laterals_of_the_trunk(&bare).iter().all(|count| *count == 0));
    let share = |ramification| {
        let counts = laterals_of_the_trunk(&grown_with(ramification));
        counts.iter().filter(|count| **count > 0).count() as f32 / counts.len() as f32
    };
    assert!((share(0.5) - 0.5).abs() < 0.2 && share(1.0) == 1.0, "{} {}", share(0.5), share(1.0));
}

#[test]
fn whorls_stand_at_the_end_of_each_year_s_shoot() {
    let habit = Habit { arrangement: Arrangement::Whorl, laterals: 5, lambda: 0.8.into(), shoot: 4, ..lit() };
    let simulation = grown(&habit, 9);
    let tree = simulation.tree();
    let trunk: Vec<usize> = (1..tree.len()).filter(|i| tree.nodes.order[*i] == 0).collect();
    for (k, count) in laterals_of_the_trunk(&simulation).iter().enumerate() {
        let ends = trunk.get(k + 1).is_none_or(|next| tree.nodes.born[*next] > tree.nodes.born[trunk[k]]);
        assert_eq!(*count, if ends { 5 } else { 0 }, "node {k} of the trunk");
    }
    assert!(trunk.len() > 12);
}

#[test]
fn schedules_change_one_plant_with_its_age() {
    let late = Schedule::new(vec![(0.0, 0.3), (5.0, 0.3), (6.0, -2.0)], -10.0, 10.0).unwrap();
    let drooping = Habit { lift: 0.3.into(), lift_branch: late.clone(), lift_twig: late, ..lit() };
    let simulation = grown(&drooping, 9);
    let nodes = &simulation.tree().nodes;
    let mean_rise = |years: std::ops::RangeInclusive<u16>| {
        let of = |i: &usize| nodes.order[*i] > 0 && years.contains(&nodes.born[*i]);
        let rises = (1..nodes.at.len())
            .filter(of)
            .map(|i| (nodes.at[i] - nodes.at[nodes.parent[i] as usize]).normalize().y);
        let all: Vec<f32> = rises.collect();
        all.iter().sum::<f32>() / all.len() as f32
    };
    assert!(mean_rise(1..=5) > 0.3 && mean_rise(8..=9) < -0.2, "{} {}", mean_rise(1..=5), mean_rise(8..=9));
}

#[test]
fn caps_end_growth_with_a_message() {
    let mad = Habit { supply: 20.0.into(), shoot: 60, shed: 0.0.into(), ..lit() };
    let small = Limits { internodes: 500, ..LIMITS };
    let mut simulation = Simulation::new(&mad, 1, small);
    let outcome = simulation.grow_to(1000, &never);
    assert_eq!(outcome, Outcome::TooManyInternodes(500));
    assert!(simulation.tree().len() <= 500 && outcome.to_string().contains("500 internodes"));
    let mut simulation = Simulation::new(&mad, 1, Limits { voxels: 20_000, ..LIMITS });
    assert!(matches!(simulation.grow_to(1000, &never), Outcome::TooLarge(20_000)));
    plant_at(&simulation, 1000.0).plant.check_invariants().unwrap();
    let mut simulation = Simulation::new(&spacious(), 1, Limits { steps: 0, ..LIMITS });
    let outcome = simulation.grow_to(1000, &never);
    assert_eq!((outcome, simulation.age(), simulation.tree().len()), (Outcome::TooManySteps(0), 0, 1));
    let dark = Habit { supply: 0.0.into(), ..lit() };
    assert_eq!(Simulation::new(&dark, 1, LIMITS).grow_to(100, &never), Outcome::Finished);
}

#[test]
fn a_cap_on_work_ends_growth_at_the_same_internode_however_slow_the_machine_is() {
    for habit in [Habit { shed: 0.1.into(), ..lit() }, spacious()] {
        let whole = grown(&habit, 12);
        let capped = || Simulation::new(&habit, 3, Limits { steps: whole.steps() / 2, ..LIMITS });
        let mut quick = capped();
        let outcome = quick.grow_to(12, &never);
        assert!(matches!(outcome, Outcome::TooManySteps(_)), "{outcome:?}");
        assert!(outcome.to_string().contains("steps of computation"));
        assert!((4..12).contains(&quick.age()), "{} years", quick.age());
        // On one thread, with a pause at every question, with a year that is stopped and years that are gone back.
        let mut slow = capped();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let pause = || {
            std::thread::sleep(std::time::Duration::from_micros(50));
            false
        };
        assert_eq!(pool.install(|| slow.grow_to(12, &pause)), outcome);
        assert_eq!((slow.age(), slow.tree(), slow.steps()), (quick.age(), quick.tree(), quick.steps()));
        slow.rewind(2);
        assert_eq!(slow.step(&|| true), Outcome::Stopped);
        assert_eq!(slow.grow_to(12, &never), outcome);
        assert_eq!((slow.age(), slow.tree(), slow.steps()), (quick.age(), quick.tree(), quick.steps()));
        assert_eq!(slow.step(&never), outcome, "it has ended");
    }
}

fn drawn() -> Plant {
    let branch = |parent, points: Vec<Vec3>, radius| Branch {
        origin: Provenance::default().record(Some(1)),
        parent,
        level: 0,
        radii: vec![radius; points.len()],
        points,
        role: Role::of(WoodPart::Stem),
    };
    Plant {
        branches: vec![
            branch(None, vec![Vec3::ZERO, Vec3::Y, Vec3::new(0.2, 2.5, 0.0)], 0.1),
            branch(Some(0), vec![Vec3::new(0.05, 1.4, 0.0), Vec3::new(-1.5, 2.2, 0.3)], 0.05),
        ],
        ..Plant::default()
    }
}

#[test]
fn drawn_branches_are_grown_on() {
    let mut simulation = Simulation::from_skeleton(&lit(), &drawn(), Envelope::Free, 2, LIMITS);
    let before = simulation.tree().clone();
    before.check_invariants().unwrap();
    for end in [Vec3::new(0.2, 2.5, 0.0), Vec3::new(-1.5, 2.2, 0.3)] {
        assert!(
            before.nodes.at.iter().any(|p| p.distance(end) < 1e-4),
            "the end of a branch stays where it was drawn"
        );
    }
    simulation.grow_to(6, &never);
    let tree = simulation.tree();
    tree.check_invariants().unwrap();
    assert!(tree.len() > 3 * before.len() && tree.nodes.at[..before.len()] == before.nodes.at[..]);
    let plant = plant_at(&simulation, 6.0).plant;
    assert!(plant.branches[0].radii.iter().take(3).all(|r| *r >= 0.099), "{:?}", plant.branches[0].radii);
    let empty = Plant { branches: Vec::new(), ..drawn() };
    let mut seed = Simulation::from_skeleton(&lit(), &empty, Envelope::Free, 2, LIMITS);
    assert!(seed.grow_to(5, &never).may_go_on() && seed.tree().len() > 10);
}

#[test]
fn wood_only_ever_thickens_and_ages_flow_into_each_other() {
    let simulation = grown(&Habit { shed: 0.1.into(), ..lit() }, 12);
    let tree = simulation.tree();
    let mut last = vec![0.0; tree.len()];
    for tenth in 10..=120 {
        let now = at_age::diameter::diameters(tree, simulation.habit(), tenth as f32 / 10.0);
        for (i, (before, now)) in last.iter().zip(&now).enumerate() {
            assert!(now + 1e-6 >= *before, "node {i} shrinks from {before} to {now} at {tenth}");
        }
        last = now;
    }
    let top = |age: f32| {
        let points = plant_at(&simulation, age).plant.branches.into_iter().flat_map(|b| b.points);
        points.map(|p| p.y).fold(0.0, f32::max)
    };
    assert!(top(5.0) < top(5.5) && top(5.5) < top(6.0));
}

#[test]
fn keys_ranges_and_schedules_are_checked() {
    let fault = |text: &str| toml::from_str::<Habit>(text).unwrap_err().message().to_owned();
    assert!(fault("lamda = 0.5").contains("did you mean `lambda`?"));
    assert!(fault("lambda = 1.5").contains("1.5 is outside 0 to 1"));
    assert!(fault("pipe = nan").contains("outside"));
    assert!(fault("lambda = [[0, 0.5], [0, 0.6]]").contains("ages must rise"));
    assert!(fault("lambda = []").contains("empty schedule"));
    assert!(fault("[light]\nvoxels = 2").contains("did you mean `voxel`?"));
    assert!(fault("arrangement = \"sprial\"").contains("spiral"));
    assert!(fault("shoot = 2.5").contains("integer") || fault("shoot = 2.5").contains("u32"));
    let habit: Habit =
        toml::from_str("lambda = [[0, 0.6], [10, 0.4]]\nshoot = 7\n[leaf]\nshape = \"tuft\"").unwrap();
    assert_eq!((habit.lambda.at(5.0), habit.shoot, habit.leaf.shape), (0.5, 7, habit::LeafShape::Tuft));
    assert_eq!(habit.pipe, Habit::default().pipe);
}

#[test]
fn every_default_lies_in_its_range() {
    let habit = Habit { crown: Some(CrownHabit::default()), ..Habit::default() };
    for d in habit.describe() {
        assert!((d.min..=d.max).contains(&(d.default as f32 as f64)), "{d:?}");
    }
}

#[test]
fn both_ends_of_every_range_can_be_set_and_nothing_else_changes() {
    let lambda = Schedule::new(vec![(0.0, 0.6), (7.3, 0.41)], 0.0, 1.0).unwrap();
    let habit = Habit { crown: Some(CrownHabit::default()), lambda, ..Habit::default() };
    assert_eq!(Overrides::over(&habit).finish::<Habit>().unwrap(), habit);
    for known in habit.describe() {
        for end in [known.min, known.max] {
            let value = known.kind.written(end);
            let mut overrides = Overrides::over(&habit);
            overrides.set_text(&format!("{}={value}", known.path)).unwrap();
            let set: Habit = overrides.finish().unwrap_or_else(|e| panic!("{}: {e}", known.path));
            for (now, before) in set.describe_at(30.0).iter().zip(habit.describe_at(30.0)) {
                let expected = if now.path == known.path { end } else { before.default };
                assert!((now.default - expected).abs() <= 1e-6 * expected.abs(), "{now:?} is not {expected}");
            }
        }
    }
}

/// A number in the middle or at an end of a range.
fn any_in(min: f32, max: f32) -> impl Strategy<Value = f32> {
    prop_oneof![min..=max, Just(min), Just(max)]
}

prop_compose! {
    fn any_habit()(
        a in (any_in(0.001, 5.0), any_in(0.2, 1.5), 1u32..60, 1u32..8, any_in(0.0, 85.0), 1u32..20),
        b in (any_in(0.0, 175.0), any_in(0.0, 1.0), any_in(0.0, 10.0), any_in(0.0, 10.0), any_in(-10.0, 10.0)),
        c in (any_in(0.0, 20.0), any_in(0.0, 1.0), any_in(0.0, 1.0), any_in(0.0, 2.0), any_in(0.0, 2.0)),
        d in (any_in(0.25, 20.0), any_in(0.001, 10.0), any_in(1.01, 20.0), 0u32..24, any_in(1.5, 4.0)),
        e in (any_in(0.1, 20.0), any_in(0.2, 40.0), any_in(5.0, 360.0), any_in(1.0, 5000.0)),
        kind in (0usize..4, any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()),
    ) -> Habit {
        let arrangements = [Arrangement::Spiral, Arrangement::Alternate, Arrangement::Opposite, Arrangement::Whorl];
        let mut habit = Habit {
            internode: a.0, shorter: a.1.into(), shoot: a.2, stems: a.3, stem_lean: a.4, laterals: a.5,
            branching: b.0.into(), ramification: b.1.into(), straightness: b.2.into(), seeking: b.3.into(),
            lift: b.4.into(), lift_branch: (-b.4).into(), wander: b.3.into(),
            supply: c.0.into(), lambda: c.1.into(), kappa: c.2.into(), shed: c.3.into(), bole: c.4.into(), pipe: d.4,
            flowering: c.2.into(), flower_age: 3.0,
            arrangement: arrangements[kind.0],
            control: if kind.1 { Control::Priority } else { Control::BorchertHonda },
            resource: if kind.2 { Resource::Space } else { Resource::Light },
            crown: kind.3.then(CrownHabit::default),
            space: SpaceHabit { occupancy: e.0, perception: e.1, angle: e.2, markers: e.3 },
            ..Habit::default()
        };
        (habit.light.voxel, habit.light.darkening, habit.light.falloff, habit.light.depth) = (d.0, d.1, d.2, d.3);
        habit.light.toward = if kind.4 { Toward::Least } else { Toward::Gradient };
        habit
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn whatever_a_species_says_the_plant_is_sound_and_within_its_caps(habit in any_habit(), seed: u64, age in 0u16..14) {
        let limits = Limits { internodes: 2500, markers: 5000, voxels: 1 << 20, ..LIMITS };
        let mut simulation = Simulation::new(&habit, seed, limits);
        simulation.grow_to(age, &never);
        prop_assert_eq!(simulation.tree().check_invariants(), Ok(()));
        prop_assert_eq!(simulation.check_envelope(), Ok(()));
        prop_assert!(simulation.tree().len() <= limits.internodes.max(habit.stems as usize));
        match simulation.field() {
            Field::Light(shadow) => prop_assert!(shadow.len() <= limits.voxels),
            Field::Space(markers) => prop_assert!(markers.len() <= limits.markers),
        }
        let plant = plant_at(&simulation, f32::from(age) - 0.4).plant;
        prop_assert_eq!(plant.check_invariants(), Ok(()));
        simulation.rewind(age / 2);
        prop_assert_eq!(simulation.tree().check_invariants(), Ok(()));
    }
}
