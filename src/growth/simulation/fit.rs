//! The habit of a plant that fills a given volume: internodes, leaves and wood become as fine as the volume needs.

use crate::growth::habit::Habit;
use crate::growth::volume::{Envelope, Swept};
use glam::Vec3;

/// Internodes that a crown which is grown into is at least high where it is as full as [`FULL`]: drawn crowns need fine
/// wood.
const FINE: f32 = 50.0;
/// Volume of a full crown, as a share of the cube of its size; wood is finer in crowns with thin parts, by the fourth
/// root of their share of it, but not beyond [`FINEST`].
const FULL: f32 = 0.16;
/// Internodes that a crown with thin parts is at most high.
const FINEST: f32 = 125.0;
/// Least and largest length of leaves in a crown, internodes.
const LEAVES: (f32, f32) = (1.8, 3.6);
/// Internodes that grow in a volume of the cube of an internode, about.
const CROWDED: f32 = 0.14;
/// Share of the internodes at a tree's foot that count as pipes, about.
const PIPES: f32 = 0.5;
/// Thickness of a trunk for which none was drawn, as a share of its crown's size.
const TRUNK: f32 = 0.055;
/// Least thickness of the thinnest wood in a crown, as a share of the species'.
const THIN: f32 = 0.2;

/// Least thickness of the thinnest wood in a brush, as a share of the species'.
const THIN_IN_BRUSH: f32 = 0.5;
/// Internodes in one of the species' own, at most: a brush as thin as a hair has no wood as fine as that.
const FINEST_IN_BRUSH: f32 = 12.0;
/// Internodes in a brush's radius at least, however long the plant's leaves are.
const FEWEST_ACROSS: f32 = 2.5;
/// Internodes in a brush's radius, where the species' own are not shorter.
const ACROSS: f32 = 6.0;

/// Volume of a round body as a share of its box's.
const ROUND: f32 = 0.5;

/// The habit as it fills a volume: internodes and leaves short enough for it, wood so thin that the trunk becomes about
/// as thick as it was drawn (`trunk`, metres), buds that seek the volume's space before they follow the species, nothing
/// shed. Phyllotaxis, angles and leaves stay the species' own.
pub(super) fn fitted(habit: &Habit, envelope: &Envelope, trunk: Option<f32>) -> Habit {
    let mut habit = habit.clone();
    if let Some((low, high)) = envelope.bounds() {
        let size = (high - low).max_element();
        if size > 0.0 {
            let volume = volume_of(envelope, high - low);
            let thin = (volume / (FULL * size.powi(3))).clamp(0.0, 1.0).powf(0.25).max(FINE / FINEST);
            let internode = habit.internode.min(size * thin / (FINE * habit.fineness));
            made_fine(&mut habit, internode, volume, trunk.unwrap_or(TRUNK * size));
        }
    }
    seek_space(&mut habit);
    habit
}

/// The habit as it fills what a brush sweeps that has this radius, metres, at neutral pressure: so densely that in a thin
/// stroke shoots have room beside each other, and with leaves as long as those that the plant has, where these are not too long for
/// the brush. `on` is the thickness of what it grows on and the length of the plant's leaves, metres.
pub(in crate::growth) fn fitted_to_brush(
    habit: &Habit,
    (radius, density): (f32, f32),
    swept: &Swept,
    on: (f32, Option<f32>),
) -> Habit {
    let mut habit = habit.clone();
    let (wood, leaf) = on;
    let for_leaves = leaf.map_or(0.0, |length| (length / LEAVES.1).min(radius / FEWEST_ACROSS));
    let usual = habit.internode.min(radius / ACROSS).max(for_leaves);
    let internode = (usual / density.cbrt()).max(habit.internode / FINEST_IN_BRUSH);
    let twig = habit.tip;
    if let Some(length) = leaf {
        habit.leaf.length = habit.leaf.length.clamped_unless_0(length, length);
    }
    made_fine(&mut habit, internode, swept.volume(), wood);
    habit.tip = habit.tip.max(THIN_IN_BRUSH * twig);
    seek_space(&mut habit);
    habit
}

/// Gives a habit this internode and leaves and wood to go with it, in a volume of so many cubic metres that grows from wood so
/// thick.
fn made_fine(habit: &mut Habit, internode: f32, volume: f32, wood: f32) {
    habit.internode = internode;
    // A bare plant stays bare.
    let (short, long) = (LEAVES.0 * internode, LEAVES.1 * internode);
    habit.leaf.length = habit.leaf.length.clamped_unless_0(short, long);
    let pipes = PIPES * CROWDED * volume / internode.powi(3);
    let tip = wood / pipes.max(1.0).powf(1.0 / habit.pipe);
    habit.tip = tip.clamp(THIN * habit.tip, habit.tip);
}

/// Lets buds seek space before they follow the species, and nothing be shed.
fn seek_space(habit: &mut Habit) {
    // What fills a volume stands by itself: a frame for topiary holds it.
    habit.climb = None;
    // An axis that is led on by one lateral after the other, as round the bends of a thin crown, stays as strong.
    habit.shorter = 1.0.into();
    (habit.bole, habit.clearance, habit.shed) = (0.0.into(), 0.0.into(), 0.0.into());
    habit.seeking = habit.seeking.at_least(0.9);
    habit.supply = habit.supply.at_least(4.0);
    habit.shoot = habit.shoot.max(8);
    habit.lambda = habit.lambda.at_least(0.5);
    habit.ramification = habit.ramification.at_least(0.9);
    habit.bud_life = habit.bud_life.max(12);
    habit.leaf.per_internode = habit.leaf.per_internode.max(3);
    habit.leaf.at_tip = habit.leaf.at_tip.max(6);
    for lift in [&mut habit.lift, &mut habit.lift_branch, &mut habit.lift_twig] {
        *lift = lift.times(0.25);
    }
}

/// Cubic metres of an envelope with this extent.
fn volume_of(envelope: &Envelope, extent: Vec3) -> f32 {
    match envelope {
        Envelope::Inflated(inflated) => inflated.volume(),
        Envelope::Solid(solid) => solid.volume(),
        Envelope::Lobes(lobes) => lobes.volume(),
        Envelope::Swept(swept) => swept.volume(),
        Envelope::Box { .. } => extent.element_product(),
        _ => ROUND * extent.element_product(),
    }
}
