//! Tests of leaves on grown wood.

use super::*;
use crate::growth::at_age::{chains, diameter};
use crate::growth::habit::Habit;
use crate::growth::{Limits, Simulation};

/// A plant of ten years with all that its leaves stand on, as [`Wood`] borrows it.
struct Grown {
    simulation: Simulation,
    chains: Chains,
    at: Vec<Vec3>,
    diameters: Vec<f32>,
    grown: Vec<f32>,
}

const AGE: f32 = 10.0;

impl Grown {
    fn new(habit: &Habit, envelope: Envelope) -> Self {
        let mut simulation = match envelope {
            Envelope::Free => Simulation::new(habit, 3, Limits::default()),
            volume => Simulation::in_envelope(habit, volume, 3, Limits::default()),
        };
        simulation.grow_to(AGE as u16, &|| false);
        let tree = simulation.tree();
        let diameters = diameter::diameters(tree, simulation.habit(), AGE);
        let at = tree.nodes.at.clone();
        let chains = chains::chains(tree, &chains::life(tree, AGE as u16, |_| 0.0), &at, &diameters);
        let grown = vec![1.0; tree.len()];
        Self { chains, at, diameters, grown, simulation }
    }

    fn wood(&self) -> Wood<'_> {
        Wood {
            names: None,
            tree: self.simulation.tree(),
            chains: &self.chains,
            at: &self.at,
            diameters: &self.diameters,
            grown: &self.grown,
            first: 0,
            age: AGE,
            tip: self.simulation.habit().tip,
            arrangement: self.simulation.habit().arrangement,
            seed: 3,
            simulation: &self.simulation,
        }
    }

    /// Nodes that carry leaves of a habit, by how many years they have, and all living nodes.
    fn leafy(&self, leaf: &LeafHabit) -> (Vec<usize>, Vec<usize>) {
        let wood = self.wood();
        let from_end = from_end(&wood);
        let alive: Vec<usize> = (0..wood.tree.len()).filter(|i| wood.chains.of_node[*i] != NONE).collect();
        let leafy = alive.iter().copied().filter(|i| count_of(&wood, leaf, (*i, from_end[*i])) > 0);
        (leafy.collect(), alive)
    }
}

fn habit() -> Habit {
    let mut habit = Habit { internode: 0.3, shed: 0.02.into(), ..Habit::default() };
    habit.light.darkening = 0.04;
    (habit.leaf.per_internode, habit.leaf.at_tip) = (8, 6);
    habit
}

fn bases(leaves: &[Organ]) -> Vec<Vec3> {
    leaves.iter().map(Organ::base).collect()
}

#[test]
fn too_many_leaves_are_thinned_evenly_over_the_whole_crown() {
    let ball = Envelope::Sphere { centre: Vec3::Y * 2.0, radius: 1.5 };
    for envelope in [Envelope::Free, ball] {
        let grown = Grown::new(&habit(), envelope);
        let (wood, leaf) = (grown.wood(), &grown.simulation.habit().leaf);
        let all = bases(&leaves(usize::MAX, &wood, leaf).0);
        assert!(all.len() > 2000, "{}", all.len());
        assert_eq!(bases(&leaves(all.len(), &wood, leaf).0), all);
        let most = all.len() / 3;
        let (few, _) = leaves(most, &wood, leaf);
        assert_eq!(few.len(), most);
        let few = bases(&few);
        let mut rest = all.iter();
        assert!(few.iter().all(|base| rest.any(|b| b == base)), "they are some of all, in order");
        let share = |bases: &[Vec3], part: &dyn Fn(&Vec3) -> bool| {
            bases.iter().filter(|b| part(b)).count() as f32 / bases.len() as f32
        };
        let middle = all.iter().map(|p| p.y).sum::<f32>() / all.len() as f32;
        let parts: [&dyn Fn(&Vec3) -> bool; 4] =
            [&|p| p.y > middle, &|p| p.x > 0.0, &|p| p.z > 0.0, &|p| p.x.hypot(p.z) > 1.0];
        for part in parts {
            let (before, after) = (share(&all, part), share(&few, part));
            assert!((before - after).abs() < 0.04, "{after} instead of {before} in a part of the crown");
        }
        // The youngest wood comes last in the order of nodes.
        let last = &all[all.len() - all.len() / 10..];
        let kept = last.iter().filter(|base| few.contains(base)).count();
        assert!((kept as f32 / last.len() as f32 - 1.0 / 3.0).abs() < 0.05, "{kept} of {}", last.len());
    }
}

#[test]
fn thinned_leaves_are_the_same_on_any_number_of_threads() {
    let grown = Grown::new(&habit(), Envelope::Free);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| leaves(777, &grown.wood(), &grown.simulation.habit().leaf))
    };
    assert_eq!(on(1), on(5));
}

#[test]
fn years_and_thickest_say_which_wood_has_leaves() {
    let grown = Grown::new(&habit(), Envelope::Free);
    let plain = LeafHabit { thickest: 1000.0, ..LeafHabit::default() };
    let wood = grown.wood();
    let ends = from_end(&wood);
    let mut last = 0;
    for years in [0.0, 3.0, 5.0, 50.0] {
        let (leafy, alive) = grown.leafy(&LeafHabit { years, ..plain.clone() });
        for i in alive {
            let expected = years_of(&wood, i) <= years || ends[i] < SHORT;
            assert_eq!(leafy.contains(&i), expected, "{years} years, node {i}");
        }
        assert!(leafy.len() > last, "{years} years: {}", leafy.len());
        last = leafy.len();
    }
    let mut last = 0;
    for thickest in [1.1, 2.0, 1000.0] {
        let (leafy, _) = grown.leafy(&LeafHabit { years: 50.0, thickest, ..plain.clone() });
        assert!(leafy.iter().all(|i| wood.diameters[*i] <= thickest * wood.tip));
        assert!(leafy.len() > last, "up to {thickest}: {}", leafy.len());
        last = leafy.len();
    }
}

#[test]
fn opposite_leaves_stand_in_crossed_pairs() {
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| stand(Arrangement::Opposite, 4, k));
    assert!((b.0 - a.0 - PI).abs() < 1e-6 && (d.0 - c.0 - PI).abs() < 1e-6);
    assert!((c.0 - a.0 - FRAC_PI_2).abs() < 1e-6);
    assert!(a.1 == b.1 && c.1 == d.1 && a.1 < c.1 && c.1 < 1.0);
}
