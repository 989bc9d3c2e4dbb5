//! How a species grows: the section `[growth]` of a species file.
//!
//! Lengths of the model are in internodes where nothing else is said, so that one number, the length of an internode,
//! scales the whole plant.
//!
//! A number may change with age, see [`Schedule`], where it is asked for anew: each year, where it takes part in that
//! year's decisions (directions and angles, lengths of new internodes, supply and its sharing, flowering, shedding), or
//! at the age shown, where it is how leaves look ([`LeafHabit`]). What has grown stays as it grew. The others hold for
//! the plant as a whole:
//! - units and scales: `height`, `internode`, `fineness`, `tip`. All lengths are counted in them.
//! - what the plant begins with: `stems`, `stem_lean`, the crown, and the fields of light and space, which keep the same
//!   voxels and markers for all ages.
//! - the pipe model: `pipe`, `pipe_leaf`, `flare`. Wood of all ages is one sum, and with another exponent it would
//!   shrink.
//! - counts and caps: `shoot`, `laterals`, `flower_cluster` and the leaves' numbers. What is whole cannot change
//!   gradually.
//! - ages and times: `flower_age`, `bud_life`, `shed_after`, `dead_years`, `flower_years`, and the years that wood has leaves.

use super::arrangement::Arrangement;
use super::leaf::LeafHabit;
use super::schedule::Schedule;
use crate::params::{ParamValue as _, Range};
use serde::{Deserialize, Deserializer, Serialize};

crate::parameter_choice! {
    /// What buds compete for.
    pub enum Resource {
        /// Light, by shadows through voxels (eq. 2.2).
        Light = "light",
        /// Space, by markers (eq. 2.1).
        Space = "space",
    }
}

crate::parameter_choice! {
    /// How the resource is shared out.
    pub enum Control {
        /// The extended Borchert–Honda model (eq. 2.4).
        BorchertHonda = "borchert_honda",
        /// The priority model (eqs. 2.5, 2.6).
        Priority = "priority",
    }
}

crate::parameter_choice! {
    /// Where buds find more light (001 §2.2).
    pub enum Toward {
        /// Along the negative gradient of the shadow: away from what darkens them.
        Gradient = "gradient",
        /// In the lightest of the voxels next to their own: into gaps.
        Least = "least",
    }
}

crate::parameters! {
    /// Shadows, eq. 2.2.
    pub struct LightHabit {
        /// Width of a voxel.
        voxel: f32 = 1.5, 0.25..=20.0, "internodes";
        /// Full light C.
        full: f32 = 1.0, 0.05..=100.0, "";
        /// Shadow a of one node in its own voxel.
        darkening: f32 = 0.12, 0.001..=10.0, "";
        /// How shadow fades from layer to layer below: divided by b.
        falloff: f32 = 1.6, 1.01..=20.0, "";
        /// Layers q_max that a shadow reaches down.
        depth: u32 = 6, 0..=24, "voxels";
        /// How far to the side a shadow falls with each layer down: light comes from the other side.
        slant: f32 = 0.0, 0.0..=2.0, "voxels";
        /// The side that slanting light comes from: 0 is the right, 90 the front.
        side: f32 = 0.0, -180.0..=180.0, "degrees";
        choices:
        /// Where buds find more light.
        toward: Toward = Toward::Gradient;
    }
}

crate::parameters! {
    /// Markers of space.
    pub struct SpaceHabit {
        /// Radius ρ of the space that a node occupies.
        occupancy: f32 = 1.6, 0.1..=20.0, "internodes";
        /// Radius r in which a bud perceives space.
        perception: f32 = 4.0, 0.2..=40.0, "internodes";
        /// Opening angle θ of the cone in which a bud perceives space.
        angle: f32 = 100.0, 5.0..=360.0, "degrees";
        /// Markers in a ball of the perception's radius.
        markers: f32 = 60.0, 1.0..=5000.0, "";
    }
}

/// A crown's radius over its height, both as shares from 0 to 1: piecewise linear as a [`Schedule`], over height for age.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Profile(Schedule);

impl<'de> Deserialize<'de> for Profile {
    fn deserialize<D: Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
        Schedule::read(source, &Range::new("profile", 0.0, 1.0)).map(Self)
    }
}

crate::parameters! {
    /// A crown that the species keeps within, turned about the trunk.
    pub struct CrownHabit {
        /// Height of the grown plant.
        height: f32 = 8.0, 0.01..=150.0, "metres";
        /// Width of the grown plant.
        width: f32 = 6.0, 0.01..=150.0, "metres";
        /// How uneven the crown is.
        lumps: f32 = 0.15, 0.0..=0.6, "";
        others:
        /// Radius over height, both from 0 to 1, as a list of pairs.
        profile: Profile = Profile(Schedule::constant(1.0));
    }
}

crate::parameters! {
    /// How a climbing species holds on to what stands beside it, or to the ground where nothing does.
    pub struct ClimbHabit {
        /// Distance from which shoots go to a support.
        reach: f32 = 1.5, 0.01..=50.0, "metres";
        /// Weight of the way to a support out of reach of the wood.
        hold: Schedule = 0.8, 0.0..=10.0, "";
        /// Distance of the wood from its support.
        gap: f32 = 0.015, 0.0..=1.0, "metres";
        /// Length of a shoot without support before it hangs; at twice the length it ends.
        free: f32 = 0.4, 0.0..=20.0, "metres";
        /// Weight of turning around a support, for twining species: above 0 counter-clockwise as it rises, seen from above.
        twine: Schedule = 0.0, -10.0..=10.0, "";
    }
}

crate::parameters! {
    /// How a species grows.
    pub struct Habit {
        /// Age at which the species is shown when none is asked for.
        age: u32 = 25, 1..=1000, "years";
        /// Height of a grown plant: the scale against which drawn crowns are fitted.
        height: f32 = 8.0, 0.01..=150.0, "metres";
        /// Length of an ordinary internode.
        internode: f32 = 0.15, 0.001..=5.0, "metres";
        /// How fine wood and leaves are in a drawn crown: 2 is twice as fine.
        fineness: f32 = 1.0, 0.2..=4.0, "";
        /// Length of internodes on each further order of branching, as a share of the order below.
        shorter: Schedule = 0.92, 0.2..=1.5, "";
        /// Most internodes that one bud grows in a year.
        shoot: u32 = 6, 1..=60, "";
        /// Number of trunks.
        stems: u32 = 1, 1..=30, "";
        /// How far several trunks lean out.
        stem_lean: f32 = 25.0, 0.0..=85.0, "degrees";
        /// Buds in a whorl.
        laterals: u32 = 4, 1..=20, "";
        /// Angle between one bud and the next around the axis.
        divergence: Schedule = 137.5, 0.0..=360.0, "degrees";
        /// Angle between an axis and its lateral buds.
        branching: Schedule = 50.0, 0.0..=175.0, "degrees";
        /// Random change of that angle, up to.
        branching_spread: Schedule = 8.0, 0.0..=90.0, "degrees";
        /// Share of the nodes that have lateral buds.
        ramification: Schedule = 1.0, 0.0..=1.0, "";
        /// Weight α of the direction so far.
        straightness: Schedule = 1.0, 0.0..=10.0, "";
        /// Weight β of the best direction.
        seeking: Schedule = 0.4, 0.0..=10.0, "";
        /// Weight γ of up on trunks; below 0 they droop.
        lift: Schedule = 0.2, -10.0..=10.0, "";
        /// Weight γ of up on branches.
        lift_branch: Schedule = 0.1, -10.0..=10.0, "";
        /// Weight γ of up on the branches of branches.
        lift_twig: Schedule = 0.05, -10.0..=10.0, "";
        /// Weight of staying level, for branches in tiers.
        level: Schedule = 0.0, 0.0..=10.0, "";
        /// Weight of a random direction.
        wander: Schedule = 0.12, 0.0..=10.0, "";
        /// Weight of the direction in which the wind blows.
        wind: Schedule = 0.0, 0.0..=2.0, "";
        /// Where the wind blows to: 0 is the right, 90 the front.
        wind_toward: f32 = 0.0, -180.0..=180.0, "degrees";
        /// Resource that a plant makes of what its buds earn, α of eq. 2.4.
        supply: Schedule = 2.0, 0.0..=20.0, "";
        /// Share λ of the continuing axis on trunks, eq. 2.4: above 0.5 a leader, below a shrub. For species of the Borchert–Honda model.
        lambda: Schedule = 0.5, 0.0..=1.0, "";
        /// Share λ on branches. For species of the Borchert–Honda model.
        lambda_branch: Schedule = 0.5, 0.0..=1.0, "";
        /// Share κ of the queue over which the weight falls, eq. 2.6: small makes one leader. For species of the priority model.
        kappa: Schedule = 0.5, 0.0..=1.0, "";
        /// Weight ω_max of the first in the queue. For species of the priority model.
        omega_max: Schedule = 1.0, 0.001..=10.0, "";
        /// Weight ω_min of the last in the queue. For species of the priority model.
        omega_min: Schedule = 0.006, 0.0..=10.0, "";
        /// Years that a bud waits before it is aborted.
        bud_life: u32 = 4, 0..=100, "years";
        /// Age from which weak shoots end in flowers, and lateral buds flower.
        flower_age: f32 = 10.0, 0.0..=1000.0, "years";
        /// Share of the weak shoots that end in flowers.
        flowering: Schedule = 0.0, 0.0..=1.0, "";
        /// Share of the lateral buds without a shoot that flower instead, each year.
        flowering_side: Schedule = 0.0, 0.0..=1.0, "";
        /// Resource below which a shoot is weak.
        flower_below: Schedule = 1.0, 0.0..=20.0, "";
        /// Years in which one place flowers.
        flower_years: u32 = 1, 1..=100, "years";
        /// Flowers at one place.
        flower_cluster: u32 = 1, 1..=30, "";
        /// Resource per internode below which a branch is shed.
        shed: Schedule = 0.1, 0.0..=10.0, "";
        /// Years that a branch has before it may be shed.
        shed_after: u32 = 3, 0..=100, "years";
        /// Years that dead wood stays before it falls, for each centimetre of its thickness.
        dead_years: f32 = 0.0, 0.0..=10.0, "years/cm";
        /// Height below which branches of the trunk are shed.
        bole: Schedule = 0.0, 0.0..=100.0, "metres";
        /// Least height of a branch above the ground.
        clearance: Schedule = 0.0, 0.0..=100.0, "metres";
        /// Diameter of the thinnest wood.
        tip: f32 = 0.006, 0.0005..=0.5, "metres";
        /// Exponent n of the pipe model, eq. 2.7.
        pipe: f32 = 2.3, 1.5..=4.0, "";
        /// What each internode adds to the pipes, in tips.
        pipe_leaf: f32 = 0.12, 0.0..=10.0, "";
        /// How much a trunk widens at its foot.
        flare: f32 = 0.5, 0.0..=4.0, "";
        /// Whether the apical bud stands first in the queue of the priority model.
        apical_first: bool = true, 0..=1, "";
        choices:
        /// How buds stand around the axis: one after the other in a spiral, left and right in turn, in pairs, or in rings at the end of each year's shoot.
        arrangement: Arrangement = Arrangement::Spiral;
        /// Model by which the resource is shared out.
        control: Control = Control::BorchertHonda;
        /// What buds compete for.
        resource: Resource = Resource::Light;
        sections:
        /// Light.
        light: LightHabit = LightHabit::default();
        /// Space.
        space: SpaceHabit = SpaceHabit::default();
        /// A crown that the species keeps within.
        crown: Option<CrownHabit> = None;
        /// How it climbs.
        climb: Option<ClimbHabit> = None;
        /// Leaves.
        leaf: LeafHabit = LeafHabit::default();
    }
}

impl Habit {
    /// The same plant at another size: every length times `factor`.
    pub fn scaled(&self, factor: f32) -> Self {
        let mut habit = self.clone();
        habit.height *= factor;
        habit.internode *= factor;
        habit.tip *= factor;
        habit.dead_years /= factor;
        habit.leaf.length = habit.leaf.length.times(factor);
        (habit.bole, habit.clearance) = (habit.bole.times(factor), habit.clearance.times(factor));
        if let Some(crown) = &mut habit.crown {
            (crown.height, crown.width) = (crown.height * factor, crown.width * factor);
        }
        if let Some(climb) = &mut habit.climb {
            (climb.reach, climb.gap, climb.free) =
                (climb.reach * factor, climb.gap * factor, climb.free * factor);
        }
        habit
    }
}

impl CrownHabit {
    /// (height, radius) in metres, from the ground up; the profile's heights are shares of the height.
    pub fn radii(&self) -> Vec<(f32, f32)> {
        const STEPS: u32 = 48;
        let at = |k: u32| {
            let share = k as f32 / STEPS as f32;
            (share * self.height, 0.5 * self.width * self.profile.0.at(share))
        };
        (0..=STEPS).map(at).collect()
    }
}
