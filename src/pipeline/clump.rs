//! Several flowers or inflorescences that one plant sends up from the ground: each leans outward, the farther the more, and
//! differs in size and in its seed.
//!
//! Limits: stems know nothing of each other; where many stand close together their leaves and flowers pass through each other.

use crate::geom::GOLDEN_RAD;
use crate::plant::{FlowerBud, FlowerBuds, Motion, Plant};
use crate::random::{mix, stream};
use crate::species::looks::ClumpLook;
use glam::{Quat, Vec3};
use rand::RngExt;

/// The plant of a clump. `one` makes the stem of a seed, whose foot is at the origin.
///
/// # Errors
/// The first of `one`.
pub(super) fn grow<E>(
    look: &ClumpLook,
    seed: u64,
    one: impl Fn(u64) -> Result<(Plant, FlowerBuds), E>,
) -> Result<(Plant, FlowerBuds), E> {
    // A stem alone is upright and as large as its species says.
    let (mut plant, mut all) = one(seed)?;
    if look.stems <= 1 {
        return Ok((plant, all));
    }
    let rng = &mut stream(seed, "stems of a clump", 0);
    let turned = rng.random_range(0.0..std::f32::consts::TAU);
    for k in 1..look.stems {
        let outward = (k as f32 / (look.stems - 1) as f32).sqrt();
        let aside = Quat::from_rotation_y(turned + GOLDEN_RAD * k as f32);
        let lean = (look.lean_deg * outward * rng.random_range(0.7..1.1)).to_radians();
        let motion = Motion {
            turn: aside * Quat::from_rotation_z(-lean) * aside.inverse(),
            from: Vec3::ZERO,
            to: aside * Vec3::X * (look.spread * outward),
            size: 1.0 - look.vary * rng.random_range(0.0..1.0_f32),
        };
        let (mut stem, buds) = one(mix(seed, u64::from(k)))?;
        move_by(&mut stem, &motion);
        let branches = plant.branches.len();
        plant.append(stem);
        all.is_thinned |= buds.is_thinned;
        all.buds.extend(buds.buds.into_iter().map(|mut bud| {
            bud.move_by(&motion);
            FlowerBud { branch: bud.branch.map(|index| index + branches), ..bud }
        }));
    }
    Ok((plant, all))
}

/// Moves what a stem consists of before its flowers open.
fn move_by(stem: &mut Plant, motion: &Motion) {
    for branch in &mut stem.branches {
        branch.points.iter_mut().for_each(|point| *point = motion.point(*point));
        branch.radii.iter_mut().for_each(|radius| *radius *= motion.size);
    }
    stem.organs.iter_mut().for_each(|organ| organ.move_by(motion));
}
