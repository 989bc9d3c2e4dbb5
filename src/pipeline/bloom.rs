//! The maker of flowers without a drawing: a stem with one flower bud at its end, or an inflorescence with many, several of
//! them where the plant is a clump, and the leaves of the stems. The species opens the buds.

use super::setup::Params;
use super::source::{Bloom, Produced};
use super::stem_leaves;
use super::{clump, figure_plant};
use crate::plant::{Branch, FlowerBud, FlowerBuds, Origin, Plant, Role, WoodPart};
use crate::random::stream;
use crate::sketch::{Remark, Warning};
use crate::species::Species;
use crate::species::looks::BloomLook;
use glam::{Quat, Vec3};
use rand::RngExt;

/// Pieces of a stem.
const PIECES: usize = 10;
/// Radius of a stem at its upper end against that at its foot.
const TAPER: f32 = 0.8;

/// Makes the plant of one flower, or of an inflorescence.
pub(super) fn produce(bloom: &Bloom, (species, params): (&Species, &Params)) -> Produced {
    let flower = &params.flower;
    let one = |seed: u64| match &flower.inflorescence {
        None => Ok(single(&flower.bloom, seed)),
        Some(inflorescence) => {
            inflorescence.draw(seed, flower.open).map(|figure| figure_plant::plant_of(&figure, species))
        }
    };
    let ((mut plant, buds), remarks) = match clump::grow(&flower.clump, bloom.number, one) {
        Ok(made) => (made, Vec::new()),
        Err(error) => {
            let remark = Remark::GrammarStopped { fault: error.to_string() };
            (Default::default(), vec![Warning { stroke: None, remark }])
        }
    };
    stem_leaves::grow(&mut plant, &flower.leaves, species, bloom.number);
    Produced { plant, buds, remarks, obstacles: params.obstacle.beside(Vec3::ZERO), ..Produced::default() }
}

/// One flower on its stem.
fn single(look: &BloomLook, seed: u64) -> (Plant, FlowerBuds) {
    let (stem, axis) = stem(look, seed);
    let end = stem.points[stem.points.len() - 1];
    let u = axis.any_orthonormal_vector() * look.reach;
    let origin = Origin::Generated;
    let bud = FlowerBud { origin, branch: Some(0), base: end, u, v: axis * look.reach, look: 0, open: 1.0 };
    let plant = Plant { branches: vec![stem], ..Plant::default() };
    (plant, FlowerBuds { buds: vec![bud], is_thinned: false })
}

/// A stem that bows aside and ends in the direction in which the flower looks, which is given, too.
fn stem(look: &BloomLook, seed: u64) -> (Branch, Vec3) {
    let rng = &mut stream(seed, "stem of a flower", 0);
    let length = look.stem * look.reach;
    let aside = Quat::from_rotation_y(rng.random_range(-0.5..0.5_f32)) * Vec3::X;
    let axis = Quat::from_rotation_x(look.lean_deg.to_radians()) * Vec3::Y;
    // A cubic from upright at the ground to the flower's axis.
    let top = Vec3::Y * length + aside * (look.bow * length);
    let (start, end) = (Vec3::Y * (1.2 * length), axis * (0.7 * length));
    let point = |k: usize| {
        let t = k as f32 / PIECES as f32;
        let s = 1.0 - t;
        top * (t * t * (1.0 + 2.0 * s)) + start * (t * s * s) - end * (t * t * s)
    };
    let radius = look.stem_radius * look.reach;
    let branch = Branch {
        origin: Origin::Generated,
        parent: None,
        level: 0,
        points: (0..=PIECES).map(point).collect(),
        radii: (0..=PIECES).map(|k| radius * (1.0 + (TAPER - 1.0) * k as f32 / PIECES as f32)).collect(),
        role: Role::of(WoodPart::Stem),
    };
    (branch, axis)
}
