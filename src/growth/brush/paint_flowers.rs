//! Flowers painted on the wood that a brush sweeps: at the ends of branches, and on stalks along them.
//!
//! A plant that has a drawn flower gets copies of that, petal by petal; if it has several, of each in turn. Otherwise they are
//! buds that the species opens. Each is known by its branch and its place there.

use super::Furnish;
use super::places::{Place, places};
use crate::geom::GOLDEN_RAD;
use crate::growth::at_age::{PlantAtAge, wood_names};
use crate::plant::{Branch, FlowerBud, GrownId, Motion, Origin, Plant, Provenance};
use crate::random::{Choice, mix};
use glam::{IVec3, Quat, Vec3};
use std::collections::HashMap;
use std::f32::consts::{PI, TAU};

/// Steps from flower to flower at density 1, in sizes of a flower.
const STEP: f32 = 2.4;
/// Length of a stalk, in sizes of its flower, and its radius.
const STALK: (f32, f32) = (0.8, 0.045);
/// Share of its branch's radius that a stalk may have.
const NARROWER: f32 = 0.8;
/// How far flowers leave a side by chance, radians.
const SPREAD_RAD: f32 = 0.6;
/// How stalks leave: the weights of the way along the branch, and of up.
const LEAVING: (f32, f32) = (0.5, 0.5);
/// Least distance between two flowers, in sizes of one.
const APART: f32 = 1.3;
/// Sides of a branch that are tried for a stalk.
const SIDES: u32 = 6;
/// How much smaller or larger copies are.
const VARY: f32 = 0.12;

/// A drawn flower, by its place, with the organs that are its parts.
struct Drawn {
    flower: usize,
    organs: Vec<usize>,
}

/// Places that flowers have, in cells as wide as two of them stand apart: one that is too near is in a cell beside.
struct Room {
    apart: f32,
    taken: HashMap<IVec3, Vec<Vec3>>,
}

impl Room {
    fn cell(&self, at: Vec3) -> IVec3 {
        (at / self.apart).floor().as_ivec3()
    }

    /// Takes a place, unless one so near is taken; whether it was free.
    fn take(&mut self, at: Vec3) -> bool {
        let cell = self.cell(at);
        let around = (0..27).map(|k| cell.saturating_add(IVec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)));
        let mut near = around.filter_map(|cell| self.taken.get(&cell)).flatten();
        let is_free = near.all(|other| other.distance(at) >= self.apart);
        if is_free {
            self.taken.entry(cell).or_default().push(at);
        }
        is_free
    }
}

/// Where a flower is to stand.
struct Seat {
    branch: usize,
    at: Vec3,
    axis: Vec3,
    name: u64,
}

impl Furnish<'_> {
    /// Paints flowers; those without a drawn one to be copied are buds of a size, metres, and look. Whether there are any.
    pub fn flowers(&self, to: &mut PlantAtAge, provenance: &Provenance, (size, look): (f32, usize)) -> bool {
        let drawn = drawn(&to.plant);
        let reach = |drawn: &Drawn| to.plant.flowers[drawn.flower].reach;
        let size = drawn.iter().map(reach).reduce(f32::max).unwrap_or(size);
        if size.is_nan() || size <= 0.0 {
            return false;
        }
        let seats = self.seats(to, provenance, size);
        let is_any = !seats.is_empty();
        for (nth, seat) in seats.into_iter().enumerate() {
            let Some(drawn) = drawn.get(nth % drawn.len().max(1)) else {
                to.buds.buds.push(FlowerBud { look, ..bud(&seat, size) });
                continue;
            };
            copy(&mut to.plant, drawn, &seat);
        }
        is_any
    }

    /// Where flowers are to stand: at free ends, and on stalks, which the plant gets.
    fn seats(&self, to: &mut PlantAtAge, provenance: &Provenance, size: f32) -> Vec<Seat> {
        let names = wood_names::names_of_wood(&to.plant.branches, provenance);
        let name =
            |branch: usize, step: u64| mix(mix(Choice::NAME_OF_BUD.key(self.seed), names[branch]), step);
        let mut room = Room { apart: APART * size, taken: HashMap::new() };
        let of_flowers = to.plant.flowers.iter().map(|flower| flower.cone.apex);
        of_flowers.chain(to.buds.buds.iter().map(|bud| bud.base)).for_each(|at| {
            room.take(at);
        });
        let mut seats = Vec::new();
        for (branch, wood) in to.plant.branches.iter().enumerate() {
            let [.., before, at] = wood.points.as_slice() else { continue };
            let Some(axis) = (*at - *before).try_normalize() else { continue };
            if seats.len() < self.most && self.swept.contains(*at) && room.take(*at) {
                seats.push(Seat { branch, at: *at, axis, name: name(branch, u64::MAX) });
            }
        }
        for place in places(&to.plant, self.swept, STEP * size / self.density) {
            let name = name(place.branch, place.step.into());
            let mut sides =
                (0..SIDES).map(|side| stalk(&to.plant, &place, turn(place.step, side, name), size));
            let free = sides.find(|stalk| stalk.points.last().is_some_and(|end| room.take(*end)));
            let Some(stalk) = free.filter(|_| seats.len() < self.most) else { continue };
            let [.., before, at] = stalk.points.as_slice() else { continue };
            let (at, axis) = (*at, (*at - *before).normalize_or(place.way));
            seats.push(Seat { branch: to.plant.branches.len(), at, axis, name });
            to.plant.branches.push(stalk);
        }
        seats
    }
}

/// The flowers that somebody drew.
fn drawn(plant: &Plant) -> Vec<Drawn> {
    let mut drawn: Vec<Drawn> =
        (0..plant.flowers.len()).map(|flower| Drawn { flower, organs: Vec::new() }).collect();
    for (index, organ) in plant.organs.iter().enumerate() {
        organ.flower.into_iter().for_each(|flower| drawn[flower].organs.push(index));
    }
    drawn.retain(|flower| flower.organs.iter().any(|organ| plant.organs[*organ].origin.is_drawn()));
    drawn
}

/// How far about its branch a flower leaves it from the plane of the sheet, radians: to the left and the right in turn, and where there is
/// no room to other sides.
fn turn(step: u32, side: u32, name: u64) -> f32 {
    let turn = match side {
        0 | 1 => PI * ((step + side) % 2) as f32,
        side => GOLDEN_RAD * side as f32,
    };
    turn + SPREAD_RAD * Choice::LEAF_AROUND.signed(name)
}

/// The stalk of a flower to a side of a branch.
fn stalk(plant: &Plant, place: &Place, turn: f32, size: f32) -> Branch {
    let parent = &plant.branches[place.branch];
    let around = place.across(turn);
    let leaving = (around + place.way * LEAVING.0).normalize_or(around);
    let ending = (leaving + Vec3::Y * LEAVING.1).normalize_or(leaving);
    let (half, radius) = (0.5 * STALK.0 * size, (STALK.1 * size).min(NARROWER * place.radius));
    // It begins inside of the branch.
    let first = place.at + leaving * (half + place.radius);
    let points = vec![place.at, first, first + ending * half];
    let (origin, role) = (Origin::Generated, parent.role);
    Branch {
        origin,
        parent: Some(place.branch),
        level: parent.level + 1,
        points,
        radii: vec![radius; 3],
        role,
    }
}

fn bud(seat: &Seat, size: f32) -> FlowerBud {
    let &Seat { branch, at, axis, name } = seat;
    let (u, v) = (axis.any_orthonormal_vector() * size, axis * size);
    FlowerBud {
        origin: Origin::Grown(GrownId(name)),
        branch: Some(branch),
        base: at,
        u,
        v,
        look: 0,
        open: 1.0,
    }
}

/// Adds a copy of a drawn flower.
fn copy(plant: &mut Plant, drawn: &Drawn, seat: &Seat) {
    let mut flower = plant.flowers[drawn.flower].clone();
    let roll = Quat::from_axis_angle(seat.axis, TAU * Choice::FLOWER_BUD.unit(seat.name));
    let motion = Motion {
        turn: (roll * Quat::from_rotation_arc(flower.cone.axis, seat.axis)).normalize(),
        from: flower.cone.apex,
        to: seat.at,
        size: 1.0 + VARY * Choice::LEAF_LENGTH.signed(seat.name),
    };
    flower.move_by(&motion);
    (flower.origin, flower.branch) = (Origin::Grown(GrownId(seat.name)), Some(seat.branch));
    let index = plant.flowers.len();
    plant.flowers.push(flower);
    for organ in &drawn.organs {
        let mut organ = plant.organs[*organ].clone();
        organ.move_by(&motion);
        (organ.origin, organ.branch, organ.flower) = (Origin::Generated, Some(seat.branch), Some(index));
        plant.organs.push(organ);
    }
}
