//! Fruits that a plant bears when their season comes: apples, cherries, berries in umbels, nuts, acorns, cones, keys and pods.
//!
//! A species with `[fruit.set]` sets them where some of its leaves stand, one or a cluster at a place: wood in leaf bears fruit,
//! grown or drawn, whoever made it. From the end of blossom they swell; each ripens and falls at a time of its own within those of
//! its species, from its place and the seed, so that the same fruits go first in every picture of a plant. Where somebody drew
//! fruits there are those and no others.
//!
//! Berries are the heads of filaments, of few triangles each, because a rowan has thousands; everything larger is a body of
//! revolution at the end of its stalk, or flat ([`flat_fruits`](super::flat_fruits)). Either way all of one kind are copies of one shape (`src/model/shapes.rs`).
//!
//! Limits: no wood bends under its fruits, and they may reach into leaves or each other; fallen ones are gone. The papers have none.

use super::flat_fruits::FlatFruit;
use super::fruit_look::{FruitSet, FruitShape};
use super::looks::SeasonLook;
use super::season;
use crate::geom::polyline;
use crate::plant::{GrownId, Organ, OrganKind, OrganPart, Origin, Plant, Provenance, Role, Shape, Templates};
use crate::random::{Choice, mix};
use glam::{Vec2, Vec3};

/// When fruits begin to swell: at the end of blossom.
const SET: f32 = 2.5;
/// Radius of a fruit that begins to swell, against its full one.
const YOUNG: f32 = 0.3;
/// Radius of a stalk, in radii of its full fruit, and where along its length it bends toward where the fruit hangs.
const STALK: (f32, f32) = (0.07, 0.4);
/// How much farther in than the outermost fruits others hang along a shoot, at most: share of the outermost's way.
const INNER: f32 = 0.6;
/// How far stalks of a cluster lean away from its leaf.
const APART: f32 = 1.1;

/// Which of the species' materials a fruit is made of: [`super::cap::UNDERSIDE`] is another.
pub(super) const RIPE: u32 = 0;
/// That of one that has not ripened.
pub(super) const UNRIPE: u32 = 2;

/// (radius, height) from the stalk to the other end, in the largest radius and the whole height.
type Profile = &'static [(f32, f32)];

/// The profile of a body of revolution; none of berries, which are heads of filaments, and of what is flat.
const fn profile(shape: FruitShape) -> Option<Profile> {
    match shape {
        FruitShape::Berry | FruitShape::Key | FruitShape::Wings | FruitShape::Pod => None,
        FruitShape::Ball => Some(&[
            (0.0, 0.02),
            (0.52, 0.03),
            (0.92, 0.27),
            (1.0, 0.53),
            (0.82, 0.8),
            (0.45, 0.96),
            (0.0, 1.0),
        ]),
        FruitShape::Apple => Some(&[
            (0.0, 0.14),
            (0.16, 0.06),
            (0.42, 0.0),
            (0.76, 0.08),
            (0.97, 0.3),
            (0.98, 0.52),
            (0.82, 0.78),
            (0.52, 0.96),
            (0.22, 0.97),
            (0.0, 0.9),
        ]),
        FruitShape::Nut => {
            Some(&[(0.0, 0.0), (0.6, 0.02), (0.96, 0.26), (0.97, 0.5), (0.66, 0.82), (0.0, 1.0)])
        }
        FruitShape::Acorn => Some(&[
            (0.0, 0.0),
            (0.7, 0.03),
            (1.0, 0.28),
            (0.84, 0.36),
            (0.84, 0.62),
            (0.58, 0.88),
            (0.0, 1.0),
        ]),
        FruitShape::Cone => {
            Some(&[(0.0, 0.0), (0.7, 0.05), (1.0, 0.3), (0.86, 0.62), (0.45, 0.92), (0.0, 1.0)])
        }
    }
}

/// The fruits that nobody drew of a plant at a time of the year, at most so many, with the templates of those that are flat; `seed`
/// decides which leaves have some.
pub(super) fn fruits(
    plant: &Plant,
    provenance: &Provenance,
    (look, year): (&FruitSet, &SeasonLook),
    most: usize,
    seed: u64,
) -> (Vec<Organ>, Templates) {
    let mut templates = Templates::default();
    let is_drawn = |organ: &Organ| organ.role.part == OrganPart::Fruit && organ.origin.is_drawn();
    if year.time <= SET || plant.organs.iter().any(is_drawn) {
        return (Vec::new(), templates);
    }
    let flat = FlatFruit::of(look.shape, look.length, &mut templates);
    let seats: Vec<Seat> = plant.organs.iter().filter_map(|organ| seat(plant, organ)).collect();
    let mean = seats.iter().map(|seat| seat.length).sum::<f32>() / seats.len().max(1) as f32;
    let lowest = lowest(plant, &seats, look, mean);
    let share = look.share.min(most as f32 / (seats.len() * look.cluster as usize).max(1) as f32);
    let of_seat = |seat: &Seat| {
        let key = season::key(seat.leaf, provenance, seed);
        let bears = seat.base.y >= lowest && Choice::FRUITS.unit(key) < share;
        // The shoot that a leaf shows is gone with it.
        let along = if season::has_leaf(year, key) { look.along } else { 0.0 };
        let seat = seat.out_along(along * (1.0 - INNER * Choice::FRUIT_ALONG.unit(key)));
        let hanging = |nth| {
            let key = mix(key, nth);
            let course = course(look, year.time, key)?;
            let hanging = Hanging::of(look, mean * look.radius, course, key);
            Some(hanging.organs(flat.as_ref(), &seat, seat.origin(nth)))
        };
        let count = if bears { look.cluster.into() } else { 0 };
        (0..count).filter_map(hanging).flatten().collect::<Vec<_>>()
    };
    let organs: Vec<Organ> = seats.iter().flat_map(of_seat).collect();
    // A plant has no templates that nothing is a copy of.
    let templates = if organs.is_empty() { Templates::default() } else { templates };
    (organs, templates)
}

/// The height of the lowest leaf that may have fruits: as high in the foliage as the species says, and so that none reaches the
/// ground.
fn lowest(plant: &Plant, seats: &[Seat], look: &FruitSet, mean: f32) -> f32 {
    let (low, high) = polyline::bounds(seats.iter().map(|seat| Vec2::splat(seat.base.y)));
    let feet = plant.branches.iter().filter_map(|branch| Some(branch.points.first()?.y));
    let reach = mean * look.radius * (1.0 + look.vary) * (look.stalk + 2.0 * look.length);
    let above_ground = feet.reduce(f32::min).map_or(f32::MIN, |ground| ground + reach);
    above_ground.max(low.y + look.above * (high.y - low.y))
}

/// Where fruits may hang: where a leaf stands.
#[derive(Clone, Copy)]
struct Seat<'a> {
    leaf: &'a Organ,
    base: Vec3,
    /// Unit direction of the leaf.
    out: Vec3,
    /// Length of the leaf, metres.
    length: f32,
}

impl Seat<'_> {
    /// The place so far out along the leaf, against its length.
    fn out_along(self, share: f32) -> Self {
        Self { base: self.base + self.out * (share * self.length), ..self }
    }

    /// What the `nth` fruit there is known by: that of a leaf that grew is found again at another age.
    fn origin(&self, nth: u64) -> Origin {
        match self.leaf.origin {
            Origin::Grown(GrownId(leaf)) => Origin::Grown(GrownId(mix(Choice::NAME_OF_FRUIT.key(leaf), nth))),
            Origin::Generated | Origin::Drawn(_) => Origin::Generated,
        }
    }
}

fn seat<'a>(plant: &Plant, organ: &'a Organ) -> Option<Seat<'a>> {
    let Shape::Blade(blade) = &organ.shape else { return None };
    let out = blade.v.try_normalize().filter(|_| organ.kind() == OrganKind::Leaf)?;
    let length = blade.v.length() * plant.templates[blade.template].length();
    Some(Seat { leaf: organ, base: blade.base, out, length })
}

/// What has become of a fruit.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Course {
    /// Radius, against the full one.
    size: f32,
    is_ripe: bool,
}

/// What has become at a time of the fruit of that key; none of one that has fallen.
fn course(look: &FruitSet, time: f32, key: u64) -> Option<Course> {
    let early = Choice::FRUIT_EARLY.unit(key);
    let within = |[from, to]: [f32; 2]| from + (to - from) * early;
    let has_fallen = look.falls.is_some_and(|falls| time >= within(falls));
    let ripens = within(look.ripe);
    let size = YOUNG + (1.0 - YOUNG) * ((time - SET) / (ripens - SET).max(0.01)).clamp(0.0, 1.0);
    (!has_fallen).then_some(Course { size, is_ripe: time >= ripens })
}

/// A fruit and its stalk, before it has a place.
struct Hanging {
    shape: FruitShape,
    role: Role<OrganPart>,
    /// Metres.
    radius: f32,
    /// Metres.
    height: f32,
    /// Length and radius of the stalk, metres.
    stalk: Vec2,
    /// How the fruit leaves the direction of its leaf.
    aside: Vec3,
    /// How far it hangs: 1 straight down, −1 straight up.
    hang: f32,
}

impl Hanging {
    fn of(look: &FruitSet, radius: f32, course: Course, key: u64) -> Self {
        let full = radius * (1.0 + look.vary * Choice::FRUIT_SIZE.signed(key));
        let variant = if course.is_ripe { RIPE } else { UNRIPE };
        let radius = full * course.size;
        Self {
            shape: look.shape,
            role: Role { variant, ..Role::of(OrganPart::Fruit) },
            radius,
            height: 2.0 * radius * look.length,
            stalk: full * Vec2::new(look.stalk, STALK.0),
            aside: Vec3::from_array(Choice::ASIDE.signs(key)) * APART,
            hang: look.hang,
        }
    }

    /// The stalk's points from where it leaves the wood, and the direction of the fruit at its end.
    fn path(&self, base: Vec3, out: Vec3) -> ([Vec3; 3], Vec3) {
        let leaving = (out + self.aside).normalize_or(out);
        let plumb = Vec3::NEG_Y * self.hang;
        let end = (leaving * (1.0 - self.hang.abs()) + plumb).normalize_or(leaving);
        let bend = base + leaving * (STALK.1 * self.stalk.x);
        ([base, bend, bend + end * ((1.0 - STALK.1) * self.stalk.x)], end)
    }

    /// Its organs at a seat; `flat` are the blades of a flat one.
    fn organs(self, flat: Option<&FlatFruit>, seat: &Seat<'_>, origin: Origin) -> Vec<Organ> {
        let (path, axis) = self.path(seat.base, seat.out);
        let branch = seat.leaf.branch;
        let organ = move |part, shape| {
            let role = Role { part, ..self.role };
            Organ { role, origin, branch, flower: None, shape }
        };
        let thread = |head| Shape::Filament { points: path.to_vec(), radius: self.stalk.y, head };
        let stalk = |head| organ(OrganPart::FruitStalk, thread(head));
        let bodies = match (profile(self.shape), flat) {
            (Some(profile), _) => vec![self.body(profile, path[2], axis)],
            (None, Some(flat)) => flat.blades(path[2], axis, self.aside, self.height),
            (None, None) => return vec![stalk(0.5 * Vec2::new(2.0 * self.radius, self.height))],
        };
        let bare = (self.stalk.x > 0.0).then(|| stalk(Vec2::ZERO));
        bare.into_iter().chain(bodies.into_iter().map(|shape| organ(OrganPart::Fruit, shape))).collect()
    }

    /// The body whose dimple holds the end of the stalk.
    fn body(&self, profile: Profile, end: Vec3, axis: Vec3) -> Shape {
        let dimple = profile.first().map_or(0.0, |point| point.1) * self.height;
        let profile = profile.iter().map(|(r, h)| Vec2::new(r * self.radius, h * self.height)).collect();
        Shape::Lathe { base: end - axis * dimple, axis, profile }
    }
}

#[cfg(test)]
#[path = "fruits_tests.rs"]
mod tests;
