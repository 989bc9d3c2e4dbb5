//! A full flower from its numbers: rings, their curves one inside of the other, a patch for every petal.
//!
//! It is made once in a frame of its own, reach 1, axis y, and put where it is wanted: the many florets of an
//! inflorescence are copies of few flowers.

use super::arrangement::{self, Levels, Ring};
use super::layers::{Aestivation, LayerShape, Layers};
use super::outline::PetalOutline;
use super::profile::{self, Lay, Line};
use crate::geom::simple_loop::crossings_at;
use crate::plant::ring_curve::STEPS;
use crate::plant::ring_sheet::{BETWEEN, FARTHEST, room_for_levels, span_of};
use crate::plant::{Blade, BladeForm, Level, RestSurface, RingCurve, RingSheet, Template};
use glam::{Quat, Vec2, Vec3};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Distance between petals that lie on each other, in thicknesses.
const CLEAR: f32 = 2.2;
/// Outlines into which those from the outermost to the innermost petals are divided.
const OUTLINES: u32 = 6;
/// How far petals reach around that do not cover each other, in sectors.
const BESIDE: f32 = 0.48;
/// Petals that would be narrower than this share of their outline are not formed.
const NO_ROOM: f32 = 0.12;
/// Share of the way from the axis to the outermost ring that rings may fill.
const ROOM: f32 = 0.75;
/// How much of its sector a valvate petal fills.
const FILLED: f32 = 0.985;

/// A flower in its own frame: centre at the origin, axis y, reach 1.
#[derive(Clone, Debug)]
pub struct FullFlower {
    /// Templates of its petals.
    pub templates: Vec<Arc<Template>>,
    /// Its petals, outermost first.
    pub petals: Vec<FullPetal>,
    /// Angle between the axis and the innermost petals, radians: what stands in the middle stays within.
    pub inner_opening_rad: f32,
    /// The same of the outermost petals.
    pub outer_opening_rad: f32,
    /// Height at which the middle stands.
    pub core_height: f32,
    /// Size of what stands in the middle against that in bloom.
    pub core_size: f32,
}

/// One of its petals.
#[derive(Clone, Debug)]
pub struct FullPetal {
    /// Place of its template among those of the flower.
    pub template: usize,
    /// Share of the way from the outermost to the innermost layer.
    pub inward: f32,
    /// Its pose in the frame of the flower, patch and form.
    pub blade: Blade<()>,
}

/// Where a flower stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Its centre, metres.
    pub centre: Vec3,
    /// Unit direction in which it opens.
    pub axis: Vec3,
    /// Unit direction across the axis of the petal at azimuth 0.
    pub side: Vec3,
    /// Distance from the centre to the tips in bloom, metres.
    pub reach: f32,
}

impl Pose {
    /// A blade of a flower in this pose, as a copy of another template.
    pub fn placed<T>(&self, blade: &Blade<()>, template: T) -> Blade<T> {
        let third = self.side.cross(self.axis);
        let turned = |v: Vec3| (self.side * v.x + self.axis * v.y + third * v.z) * self.reach;
        let mut placed = blade.with_template(template);
        placed.base = self.centre + turned(blade.base);
        (placed.u, placed.v) = (turned(blade.u), turned(blade.v));
        placed
    }
}

/// A ring with its curve.
struct Laid<'a> {
    ring: &'a Ring,
    shape: LayerShape,
    outline: PetalOutline,
    /// Half the width of its petals at equal steps from foot to tip, shares of their length.
    half_widths: [f32; STEPS + 1],
    line: Line,
    levels: Levels,
    half_span_rad: f32,
    farthest_rad: f32,
    /// Room that its petals need, share of the reach.
    gap: f32,
}

/// The flower that these numbers describe. `own` is the outline of its petals in place of the numbers' own, of length 1.
pub fn full_flower(layers: &Layers, own: Option<&Arc<Template>>, seed: u64) -> FullFlower {
    let rings = arrangement::rings(layers, seed);
    let laid = lay(layers, own, &rings, seed);
    let curve = |k: usize| {
        let inside = laid.get(k + inside_by(layers, laid[k].half_span_rad));
        Arc::new(profile::curve(&laid[k].line, laid[k].shape.length, inside.map(|inside| &inside.line)))
    };
    let curves: Vec<Arc<RingCurve>> = (0..laid.len()).map(curve).collect();
    let (templates, template_of) = templates(layers, own);
    let petals = laid.iter().zip(&curves);
    let petals = petals.flat_map(|(laid, curve)| petals_of(layers, laid, curve, &template_of)).collect();
    let opening = |curve: Option<&Arc<RingCurve>>| {
        let chord = curve.map_or(Vec2::X, |curve| curve.chord());
        chord.x.atan2(chord.y).clamp(0.05, 1.55)
    };
    FullFlower {
        templates,
        petals,
        inner_opening_rad: opening(curves.last()),
        outer_opening_rad: opening(curves.first()),
        core_height: layers.rise,
        core_size: laid
            .last()
            .map_or(1.0, |laid| layers.bud_size + (1.0 - layers.bud_size) * laid.shape.open),
    }
}

/// How many rings further in the one stands that first bounds the petals of a ring: the next, in spirals the first that
/// stands above them.
fn inside_by(layers: &Layers, half_span_rad: f32) -> usize {
    match layers.aestivation {
        Aestivation::Spiral => petals_between(layers.spiral_t, half_span_rad),
        _ => 1,
    }
}

/// Distance of two rings at their feet, whose petals lie a gap apart further up.
fn at_foot(layers: &Layers, gap: f32) -> f32 {
    const SHARE: f32 = 0.3;
    const LEAST: f32 = 1.6;
    match layers.aestivation {
        Aestivation::Spiral => SHARE * gap,
        _ => (SHARE * gap).max(LEAST * layers.thickness).min(gap),
    }
}

/// Angle between the petals of a spiral that touch at their feet, radians.
fn nearest_at_foot(layers: &Layers, gap: f32) -> f32 {
    let touching = (BETWEEN * layers.thickness / at_foot(layers, gap).max(1e-6)).clamp(1.0, 34.0) as usize;
    (1..=touching).map(|k| angle_between(layers.spiral_t, k)).fold(std::f32::consts::PI, f32::min)
}

/// Angle between a petal of a spiral and the one formed so many later, radians.
fn angle_between(t: u32, later: usize) -> f32 {
    let angle = (arrangement::divergence_rad(t) * later as f32).rem_euclid(std::f32::consts::TAU);
    angle.min(std::f32::consts::TAU - angle)
}

/// How many petals of a spiral later one stands above another that spans so far.
fn petals_between(t: u32, half_span_rad: f32) -> usize {
    (1..=13).find(|k| angle_between(t, *k) < 2.0 * half_span_rad).unwrap_or(13)
}

/// Lays the curves of all rings, each inside of the one before.
fn lay<'a>(layers: &Layers, own: Option<&Arc<Template>>, rings: &'a [Ring], seed: u64) -> Vec<Laid<'a>> {
    let mut laid: Vec<Laid<'_>> =
        rings.iter().zip(0..).map(|(ring, k)| free(layers, own, ring, seed ^ k)).collect();
    tighten(&mut laid);
    // What a ring leaves free about the axis: room for all rings inside of it, and for its own petals side by side.
    let mut inside = 0.0;
    let mut nearest = vec![0.0; laid.len()];
    for (laid, nearest) in laid.iter().zip(&mut nearest).rev() {
        *nearest = f32::max(inside, 0.5 * layers.thickness * laid.ring.places.len() as f32);
        inside += laid.gap;
    }
    for k in 0..laid.len() {
        let (before, after) = laid.split_at_mut(k);
        let outside = before.last().map(|outside| (&outside.line, outside.gap, at_foot(layers, outside.gap)));
        let of = &mut after[0];
        let (foot, nearest) = (of.line[0], nearest[k]);
        of.line = profile::lay(&Lay { shape: &of.shape, foot, nearest, outside });
    }
    laid
}

/// Brings rings closer together where they are more than find room between the axis and the outermost of them: petals that
/// have no room to cover each other stand side by side.
fn tighten(laid: &mut [Laid<'_>]) {
    let widest = |laid: &Laid<'_>| laid.line.iter().map(|point| point.x).fold(0.0, f32::max);
    let needed: f32 = laid.iter().map(|laid| laid.gap).sum();
    let room = ROOM * laid.first().map_or(0.0, widest);
    if needed > room {
        laid.iter_mut().for_each(|laid| laid.gap *= room / needed);
    }
}

/// A ring as it would stand without the others.
fn free<'a>(layers: &Layers, own: Option<&Arc<Template>>, ring: &'a Ring, seed: u64) -> Laid<'a> {
    let shape = layers.shape_at(ring.layer);
    let mut outline = layers.outline_at(ring.inward);
    if let Some(own) = own {
        outline.width = 2.0 * half_width(own);
    }
    let radius = layers.receptacle + (layers.core - layers.receptacle) * ring.inward;
    let foot = Vec2::new(radius.max(1e-3), layers.rise * ring.inward);
    let line = profile::lay(&Lay { shape: &shape, foot, nearest: 0.0, outside: None });
    let curve = profile::curve(&line, shape.length, None);
    let half_widths = std::array::from_fn(|k| match own {
        Some(own) => half_width_at(own, k as f32 / STEPS as f32),
        None => outline.half_width(k as f32 / STEPS as f32),
    });
    let count = ring.places.len();
    let farthest_rad = farthest_around(layers, count);
    let half_span_rad = span_of(&curve, &half_widths).min(farthest_rad);
    // Turned and grown as far as they may be.
    let reaches = half_span_rad * (1.0 + layers.shrink_vary) + layers.turn_vary_deg.to_radians();
    let levels = arrangement::levels(layers.aestivation, count, reaches, seed);
    let gap = CLEAR
        * layers.thickness
        * match layers.aestivation {
            Aestivation::Spiral => 2.0 / petals_between(layers.spiral_t, half_span_rad) as f32,
            _ => 1.0 + levels.stacked as f32,
        };
    Laid { ring, shape, outline, half_widths, line, levels, half_span_rad, farthest_rad, gap }
}

/// How far around the petals of a ring reach to each side at most: where there are many, nearly to the middle of the next one.
fn farthest_around(layers: &Layers, petals: usize) -> f32 {
    let sector = std::f32::consts::TAU / petals.max(1) as f32;
    match layers.aestivation {
        Aestivation::Spiral => FARTHEST,
        // Each of a few has a level of its own, and may cover more than its next neighbours.
        _ if petals <= arrangement::FEW => FARTHEST,
        _ => {
            // Turned and grown as far as they may be, they still cover their next neighbours only.
            let free = 0.97 * sector - layers.turn_vary_deg.to_radians();
            FARTHEST.min((free / (1.0 + layers.shrink_vary)).max(0.4 * sector))
        }
    }
}

fn half_width(template: &Template) -> f32 {
    let widest = template.outline().iter().map(|point| point.x.abs()).fold(0.0, f32::max);
    (widest / template.length()).max(0.01)
}

/// Half the width of an outline at a share of its length, share of the length.
fn half_width_at(template: &Template, share: f32) -> f32 {
    let crossings = crossings_at(template.outline(), share * template.length());
    crossings.map(f32::abs).fold(0.0, f32::max) / template.length()
}

/// The templates of a flower, and which of them the petals have that stand a share of the way inward.
fn templates(layers: &Layers, own: Option<&Arc<Template>>) -> (Vec<Arc<Template>>, impl Fn(f32) -> usize) {
    let several = own.is_none() && layers.inner.is_some() && layers.count > 1;
    let count = if several { OUTLINES.min(layers.count) } else { 1 };
    let last = (count - 1) as f32;
    let of = |k: u32| Arc::new(layers.outline_at(if last > 0.0 { k as f32 / last } else { 0.0 }).template());
    let templates = own.map_or_else(|| (0..count).map(of).collect(), |own| vec![own.clone()]);
    (templates, move |inward: f32| (inward * last).round() as usize)
}

/// The petals of a ring, none where there is no room for them between the others. Those that differ in nothing but their
/// azimuth share a sheet.
fn petals_of(
    layers: &Layers,
    laid: &Laid<'_>,
    curve: &Arc<RingCurve>,
    template_of: &impl Fn(f32) -> usize,
) -> Vec<FullPetal> {
    let Laid { ring, shape, levels, .. } = laid;
    let form = BladeForm {
        twist: 0.0,
        bend_quartic: 0.0,
        bend_quadratic: 0.0,
        cup: 0.0,
        fold: 0.0,
        ruffle: (layers.ruffle * shape.open).min(calm(laid, curve)),
        ruffle_waves: layers.ruffle_waves,
        thickness: (layers.thickness / shape.length).clamp(0.001, 0.1),
    };
    let any = sheet_of(layers, laid, curve);
    if any.unfolded() < NO_ROOM {
        return Vec::new();
    }
    let mut known: BTreeMap<[u32; 4], Arc<RingSheet>> = BTreeMap::new();
    let petal = |(place, level): (&arrangement::Place, &Level)| {
        let key = [place.size, place.tilt, level.height, level.slope].map(f32::to_bits);
        let own = || RingSheet { size: place.size, tilt: place.tilt, level: *level, ..any.clone() };
        let sheet = known.entry(key).or_insert_with(|| Arc::new(own())).clone();
        let turned = |flat: Vec2| Quat::from_rotation_y(place.azimuth_rad) * Vec3::new(flat.x, flat.y, 0.0);
        let (length, base) = (curve.length(), turned(curve.spot(0.0).at));
        let (v, face) = (turned(curve.chord()), turned(curve.chord().perp()));
        let (u, v) = (v.cross(face) * length, v * length);
        let blade = Blade { template: (), base, u, v, rest: RestSurface::Ring(sheet), form };
        FullPetal { template: template_of(ring.inward), inward: ring.inward, blade }
    };
    ring.places.iter().zip(&levels.of).map(petal).collect()
}

/// Highest waves of the petals of a ring that leave those of their neighbours alone, share of their length.
fn calm(laid: &Laid<'_>, curve: &RingCurve) -> f32 {
    const OF_THE_ROOM: f32 = 0.08;
    OF_THE_ROOM * laid.levels.apart.max(0.3) * curve.spot(1.0).room / curve.length()
}

/// The sheet of a petal of a ring that does not differ from others.
fn sheet_of(layers: &Layers, laid: &Laid<'_>, curve: &Arc<RingCurve>) -> RingSheet {
    let Laid { ring, shape, outline, half_widths, levels, half_span_rad, farthest_rad, .. } = laid;
    let (sector, half_span_rad) = (ring.sector_rad(), half_span_rad.max(1e-3));
    let narrowed = match layers.aestivation {
        Aestivation::Valvate => (FILLED * 0.5 * sector / half_span_rad).min(1.0),
        _ => 1.0,
    };
    let (free, needed) = match layers.aestivation {
        Aestivation::Spiral => (nearest_at_foot(layers, laid.gap), BETWEEN * layers.thickness),
        _ => (sector, room_for_levels(layers.thickness, levels.apart)),
    };
    let beside = BESIDE * free - layers.turn_vary_deg.to_radians();
    RingSheet {
        curve: curve.clone(),
        size: 1.0,
        tilt: 0.0,
        level: Level { height: 0.0, slope: 0.0 },
        apart: levels.apart,
        half_width: 0.5 * outline.width,
        half_widths: *half_widths,
        narrowed,
        covered: ((2.0 * half_span_rad - sector) / half_span_rad).clamp(0.0, 1.0),
        cup: shape.cup,
        half_span_rad,
        farthest_rad: *farthest_rad,
        beside_rad: beside.max(0.15 * free),
        needed,
    }
}
