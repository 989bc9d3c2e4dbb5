//! Compound leaves of a plant: each leaf becomes leaflets on a rachis where its species says so.
//!
//! A leaf's own outline becomes that of its leaflets, its length that of the whole. So it is for roses, for plants that grow, and for
//! the leaves that fill drawn outlines. A leaf that was drawn keeps its outline: leaflets of the species' own outline stand
//! along its middle, and each is as long as the outline has room for, so that their tips are the outline.
//!
//! Limits: where leaves are very many their stalks are left out, then some of their leaflets, then some of them. The rachis of a
//! leaf that was drawn bowed is bowed, but its leaflets are not turned with it; leaflets whose foot would lie outside of the outline are left out.

use super::looks::LeafLook;
use crate::geom::simple_loop::crossings_at;
use crate::leaf::compound::{Compound, LeafPose, Leaflet};
use crate::plant::{
    Blade, Detail, Organ, OrganKind, OrganPart, Plant, RestSurface, Role, Shape, Template, TemplateId,
};
use crate::random::{mix, stream, unit};
use glam::{Vec2, Vec3};
use rand::RngExt;

/// Leaves up to which stalks are made.
const MOST_STALKS: usize = 1500;
/// Leaflets of a plant, about; where its leaves would have more, each has fewer, and if that does not help some leaves are
/// left out and the others are larger.
const MOST_LEAFLETS: f32 = 60_000.0;
/// How much larger these are at most.
const LARGER: f32 = 1.6;
/// Leaflets from which on those of drawn leaves are of reduced detail.
const MANY_LEAFLETS: f32 = 500.0;
/// Longest stalk below the leaflets of a drawn leaf, share of its length: who draws a leaf draws its blade.
const DRAWN_STALK: f32 = 0.06;
/// How much longer or shorter than by its place a leaflet may become so that it reaches a drawn outline.
const FITTED: (f32, f32) = (0.2, 3.0);

/// Divides the leaves of a plant.
pub(super) fn divide(plant: &mut Plant, look: &LeafLook, seed: u64) {
    let Some(compound) = &look.compound else { return };
    let whole = plant.organs.iter().filter(|organ| is_whole(organ, compound)).count();
    let has_stalks = whole <= MOST_STALKS;
    let kept = |compound: &Compound| (MOST_LEAFLETS / (whole as f32 * compound.mean_count())).min(1.0);
    let compound = &compound.with_fewer(kept(compound));
    let kept = kept(compound);
    let larger = kept.powf(-0.5).min(LARGER);
    let organs = std::mem::take(&mut plant.organs);
    let is_rich = whole as f32 * compound.mean_count() > MANY_LEAFLETS;
    let detail = if is_rich { Detail::Reduced } else { Detail::Moderate };
    let mut of_drawn = None;
    let mut divided = Divided { out: Vec::with_capacity(organs.len()), compound, has_stalks, seed };
    for organ in organs {
        match &organ.shape {
            Shape::Blade(blade) if is_whole(&organ, compound) && organ.origin.is_drawn() => {
                let new = || Template::new(look.outline.points(), Vec::new(), 1.0, detail);
                let leaflet = *of_drawn.get_or_insert_with(|| plant.templates.add(new()));
                divided.add_drawn(&organ, blade, &plant.templates[blade.template], leaflet);
            }
            Shape::Blade(blade) if is_whole(&organ, compound) => {
                if kept < 1.0 && unit(mix(name_of(blade.base), seed)) >= kept {
                    continue;
                }
                let blade = &Blade { u: blade.u * larger, v: blade.v * larger, ..blade.clone() };
                divided.add(&organ, blade, plant.templates[blade.template].length());
            }
            _ => divided.out.push(organ),
        }
    }
    plant.organs = divided.out;
    if of_drawn.is_some() {
        plant.drop_unused_templates();
    }
}

/// Whether an organ is a leaf that is divided.
fn is_whole(organ: &Organ, compound: &Compound) -> bool {
    let is_flat = matches!(&organ.shape, Shape::Blade(blade) if blade.rest == RestSurface::Plane);
    let may_be = compound.drawn || !organ.origin.is_drawn();
    organ.kind() == OrganKind::Leaf && may_be && organ.flower.is_none() && is_flat
}

/// The organs of a plant whose leaves are divided.
struct Divided<'a> {
    out: Vec<Organ>,
    compound: &'a Compound,
    has_stalks: bool,
    seed: u64,
}

impl Divided<'_> {
    /// Adds the parts of a leaf that nobody drew; its leaflets are copies of its own template.
    fn add(&mut self, whole: &Organ, blade: &Blade, template_length: f32) {
        let Some(pose) = pose_of(blade, template_length) else { return };
        let parts = self.compound.leaf(&pose, self.count(blade));
        self.add_stalk(whole, parts.rachis, parts.radius);
        let leaflets = parts.leaflets.into_iter().chain(parts.stipules);
        self.out
            .extend(leaflets.map(|leaflet| organ(whole, blade, (blade.template, template_length), leaflet)));
    }

    /// The same for a leaf that was drawn, whose leaflets are copies of a template of length 1.
    fn add_drawn(&mut self, whole: &Organ, blade: &Blade, template: &Template, leaflet: TemplateId) {
        let Some(pose) = pose_of(blade, template.length()) else { return };
        let stalk = self.compound.stalk.min(DRAWN_STALK);
        let flat = Compound { droop: 0.0, stalk, stipules: 0.0, ..self.compound.clone() };
        let parts = flat.leaf(&pose, self.count(blade));
        let outline = template.outline();
        let bowed = |place: Vec3| {
            let flat = in_plane(place - blade.base, blade);
            place + blade.u * middle(flat.y, outline).unwrap_or(0.0)
        };
        let before = self.out.len();
        self.add_stalk(whole, parts.rachis.into_iter().map(bowed).collect(), parts.radius);
        let first = self.out.len();
        let bowed = parts.leaflets.into_iter().map(|part| Leaflet { base: bowed(part.base), ..part });
        let fitted = bowed.filter_map(|part| fitted(&part, blade, outline));
        self.out.extend(fitted.map(|part| organ(whole, blade, (leaflet, 1.0), part)));
        if self.out.len() == first {
            // An outline that no leaflet stands in stays the leaf that it was.
            self.out.truncate(before);
            self.out.push(whole.clone());
        }
    }

    fn count(&self, blade: &Blade) -> u32 {
        self.compound.count(stream(self.seed, "leaflets", name_of(blade.base)).random_range(0.0..1.0f32))
    }

    fn add_stalk(&mut self, whole: &Organ, points: Vec<Vec3>, radius: f32) {
        if self.has_stalks {
            let shape = Shape::Filament { points, radius, head: Vec2::ZERO };
            let role = Role { part: OrganPart::Petiole, ..whole.role };
            self.out.push(Organ { role, shape, ..whole.clone() });
        }
    }
}

fn pose_of(blade: &Blade, template_length: f32) -> Option<LeafPose> {
    let (v, face) = (blade.v.try_normalize()?, blade.u.cross(blade.v).try_normalize()?);
    let length = template_length * blade.v.length();
    Some(LeafPose { base: blade.base, u: v.cross(face), v, length })
}

/// A leaflet of a leaf as an organ, a copy of a template of this length.
fn organ(whole: &Organ, blade: &Blade, (template, length): (TemplateId, f32), leaflet: Leaflet) -> Organ {
    let Leaflet { base, u, v } = leaflet;
    let shape = Shape::Blade(Blade { template, base, u: u / length, v: v / length, ..blade.clone() });
    Organ { role: Role { part: OrganPart::Leaf, ..whole.role }, shape, ..whole.clone() }
}

/// The leaflet as long as the outline of its leaf has room for; `None` if its foot lies outside of that.
fn fitted(leaflet: &Leaflet, blade: &Blade, outline: &[Vec2]) -> Option<Leaflet> {
    let (foot, way) = (in_plane(leaflet.base - blade.base, blade), in_plane(leaflet.v, blade));
    let room = room(foot, way, outline)?.clamp(FITTED.0, FITTED.1);
    Some(Leaflet { base: leaflet.base, u: leaflet.u * room, v: leaflet.v * room })
}

/// A vector of a blade's plane by its u and v.
fn in_plane(vector: Vec3, blade: &Blade) -> Vec2 {
    let Blade { u, v, .. } = blade;
    let (uu, uv, vv) = (u.length_squared(), u.dot(*v), v.length_squared());
    let (along_u, along_v) = (vector.dot(*u), vector.dot(*v));
    Vec2::new(along_u * vv - along_v * uv, along_v * uu - along_u * uv) / (uu * vv - uv * uv)
}

/// Half way between the outermost points of an outline at a height; `None` where it does not reach.
fn middle(height: f32, outline: &[Vec2]) -> Option<f32> {
    let wide = crossings_at(outline, height);
    let wide = wide.fold((f32::MAX, f32::MIN), |(low, high), x| (low.min(x), high.max(x)));
    (wide.0 <= wide.1).then_some(0.5 * (wide.0 + wide.1))
}

/// How many times `way` leads from a point to the outline around it; `None` from outside.
fn room(from: Vec2, way: Vec2, outline: &[Vec2]) -> Option<f32> {
    let ahead = outline.iter().cycle().skip(1);
    let crossing = |(a, b): (&Vec2, &Vec2)| {
        let (edge, off) = (*b - *a, *a - from);
        let across = way.perp_dot(edge);
        let (share, times) = (off.perp_dot(way) / across, off.perp_dot(edge) / across);
        // Half-open, so that a corner is crossed once.
        ((0.0..1.0).contains(&share) && times > 0.0).then_some(times)
    };
    let crossings: Vec<f32> = outline.iter().zip(ahead).filter_map(crossing).collect();
    let nearest = crossings.iter().copied().reduce(f32::min);
    nearest.filter(|_| crossings.len() % 2 == 1)
}

/// What tells a leaf from others, whatever their number: its place to a tenth of a millimetre.
fn name_of(place: Vec3) -> u64 {
    let mixed = |key: u64, x: f32| mix(key, (x * 1e4).round() as i64 as u64);
    place.to_array().into_iter().fold(1, mixed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{BladeForm, Detail, Origin, Provenance, Template};

    fn plant(origin: Origin) -> Plant {
        let outline = vec![Vec2::ZERO, Vec2::new(0.3, 0.5), Vec2::Y, Vec2::new(-0.3, 0.5)];
        let mut plant = Plant::default();
        let template = plant.templates.add(Template::new(outline, Vec::new(), 1.0, Detail::Reduced));
        let (rest, form) = (RestSurface::Plane, BladeForm::default());
        let blade = Blade { template, base: Vec3::Y, u: Vec3::X * 0.1, v: Vec3::Y * 0.1, rest, form };
        let role = Role::of(OrganPart::Leaf);
        plant.organs.push(Organ { role, origin, branch: None, flower: None, shape: Shape::Blade(blade) });
        plant
    }

    fn look() -> LeafLook {
        toml::from_str("materials = \"leaf\"\ncompound = { leaflets = [5] }").unwrap()
    }

    #[test]
    fn a_leaf_becomes_a_rachis_and_its_leaflets() {
        let mut plant = plant(Origin::Generated);
        divide(&mut plant, &look(), 1);
        let kinds: Vec<OrganKind> = plant.organs.iter().map(Organ::kind).collect();
        assert_eq!(kinds.iter().filter(|kind| **kind == OrganKind::Leaf).count(), 5);
        assert_eq!(kinds[0], OrganKind::Petiole);
        assert_eq!(plant.check_invariants(), Ok(()));
    }

    #[test]
    fn plants_of_very_many_leaves_have_no_more_leaflets_than_they_may() {
        let mut many = plant(Origin::Generated);
        let leaf = many.organs[0].clone();
        many.organs = (0..30_000)
            .map(|k| {
                let mut leaf = leaf.clone();
                leaf.shape.translate(Vec3::new(k as f32 * 0.01, 0.0, 0.0));
                leaf
            })
            .collect();
        divide(&mut many, &look(), 1);
        let leaflets = many.organs.len() as f32;
        assert!((leaflets / MOST_LEAFLETS - 1.0).abs() < 0.05, "{leaflets}");
        let Shape::Blade(blade) = &many.organs[0].shape else { unreachable!("a leaf is a blade") };
        assert!(blade.v.length() > 0.0 && many.check_invariants() == Ok(()));
    }

    #[test]
    fn leaflets_of_a_drawn_leaf_reach_its_outline() {
        let mut drawn = plant(Provenance::default().record(Some(1)));
        divide(&mut drawn, &look(), 1);
        assert_eq!(drawn.check_invariants(), Ok(()));
        let tips = drawn.organs.iter().filter_map(|organ| match &organ.shape {
            Shape::Blade(blade) => Some((blade.base + blade.v - Vec3::Y) / 0.1),
            _ => None,
        });
        let tips: Vec<Vec3> = tips.collect();
        assert_eq!(tips.len(), 5);
        for tip in tips {
            let half_width = 0.6 * tip.y.min(1.0 - tip.y);
            assert!((tip.x.abs() - half_width).abs() < 1e-4 && tip.z.abs() < 1e-6, "{tip}");
        }
    }

    #[test]
    fn a_bowed_leaf_has_leaflets_on_both_sides() {
        let mut bowed = plant(Provenance::default().record(Some(1)));
        let outline = [(0.0, 0.0), (0.35, 0.3), (0.4, 0.6), (0.0, 1.0), (0.1, 0.6), (0.1, 0.3)];
        let outline = outline.into_iter().map(Vec2::from).collect();
        let template = bowed.templates.add(Template::new(outline, Vec::new(), 1.0, Detail::Full));
        let Shape::Blade(blade) = &mut bowed.organs[0].shape else { unreachable!("a leaf is a blade") };
        blade.template = template;
        bowed.drop_unused_templates();
        divide(&mut bowed, &look(), 1);
        let leaflets = bowed.organs.iter().filter(|organ| organ.kind() == OrganKind::Leaf).count();
        assert_eq!((leaflets, bowed.check_invariants()), (5, Ok(())));
    }

    #[test]
    fn drawn_leaves_that_are_not_to_be_divided_and_leaves_of_other_species_stay() {
        let drawn = plant(Provenance::default().record(Some(1)));
        let mut divided = drawn.clone();
        let whole = toml::from_str("materials = \"leaf\"\ncompound = { leaflets = [5], drawn = false }");
        divide(&mut divided, &whole.unwrap(), 1);
        assert_eq!(divided, drawn);
        let mut simple = plant(Origin::Generated);
        divide(&mut simple, &toml::from_str("materials = \"leaf\"").unwrap(), 1);
        assert_eq!(simple, plant(Origin::Generated));
    }
}
