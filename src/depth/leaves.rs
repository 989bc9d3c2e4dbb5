//! Leaves in space: attached at their branch's depth and turned to the light (000 §4.3, 002 §5.3).
//!
//! The papers lay every leaf flat into the plane across the sunlight and then turn it by two angles with random
//! change, which leaves little of what was drawn: from the front most leaves are seen edge-on. Here the drawn axis
//! stays: the tip keeps its place on the sheet and moves only toward the viewer or away by a seeded angle (the papers'
//! ±30°), so a leaf keeps its side of the branch; and the blade rolls about that axis toward the light by a share.
//! Generated leaves, which nobody drew, turn more freely.
//!
//! Pen tilt (no paper has it): the pen stands on the leaf like its normal. A pen held upright leaves things to the
//! light; a tilted pen leans the leaf.

use super::outline::{BladeFrame, CurlParams, DrawnBlade, outline_of};
use crate::anatomy::{Copy, FlatBlade};
use crate::kept::{Kept, Use};
use crate::plant::{Blade, BladeForm, Detail, RestSurface, Template, TemplateId, Templates, WorldFromCanvas};
use crate::random::stream;
use glam::{Quat, Vec2, Vec3};
use rand::RngExt;
use rayon::prelude::*;
use std::sync::Arc;

crate::parameters! {
    /// How leaves turn.
    pub struct LeafParams {
        /// How far leaves roll from facing the viewer (0) to facing the light (1).
        light_seeking: f32 = 0.35, 0.0..=1.0, "";
        /// Random turn of a drawn leaf's axis toward or away from the viewer, up to.
        scatter: f32 = 30.0, 0.0..=80.0, "degrees";
        /// The same for generated leaves.
        generated_scatter: f32 = 60.0, 0.0..=80.0, "degrees";
        /// Random roll of generated leaves about their axis, up to.
        roll: f32 = 50.0, 0.0..=180.0, "degrees";
        /// How much pen tilt leans leaves; 0 switches it off.
        tilt_gain: f32 = 1.0, 0.0..=2.0, "";
    }
}

/// Where light comes from when nothing else is said: above, a little toward the viewer.
const LIGHT: Vec3 = Vec3::new(0.0, 0.95, 0.31);

/// World direction of the viewer.
const VIEWER: Vec3 = Vec3::Z;

/// Poses the leaves of one plant.
pub struct LeafPoser<'a> {
    /// How the drawing maps to the world.
    pub world: WorldFromCanvas,
    /// Seed of everything random.
    pub seed: u64,
    /// How leaves turn.
    pub params: &'a LeafParams,
    /// What pressure does to them.
    pub curl: &'a CurlParams,
}

impl LeafPoser<'_> {
    /// A drawn leaf whose root lies at the world depth `depth`.
    pub fn drawn(&self, flat: &FlatBlade, depth: f32) -> Blade<Arc<Template>> {
        let params = self.params;
        let mut rng = stream(self.seed, "leaf pose", flat.key());
        let frame = BladeFrame::new(flat, &self.world, false);
        let (mut outline, curl) = outline_of(flat, &frame, &self.world, self.curl);
        let away = (params.scatter * rng.random_range(-1.0..1.0f32)).to_radians();
        let light = params.light_seeking * rng.random_range(0.6..1.0f32);
        let normal = VIEWER.lerp(LIGHT, light) + lean(flat, params);
        let (u, v) = across(frame.v.extend(away.tan()).normalize(), normal);
        // The tip keeps its place on the sheet, so a leaf that turns out of it is longer than drawn.
        let stretch = 1.0 / away.cos();
        for p in &mut outline {
            p.y *= stretch;
        }
        let length = self.world.vector(flat.axis()).length() * stretch;
        let base = self.world.point(flat.root).with_z(depth);
        let form = BladeForm::default();
        let template = Arc::new(Template::new(outline, curl, length, Detail::Full));
        Blade { template, base, u, v, rest: RestSurface::Plane, form }
    }

    /// A copied leaf at `base`: a template of length 1 under an affine map that takes its tip to the leaf's.
    pub fn copied(&self, flat: &FlatBlade, copy: Copy, template: TemplateId, base: Vec3) -> Blade {
        let params = self.params;
        let mut rng = stream(self.seed, "leaf pose", flat.key());
        let drawn = self.world.vector(flat.axis());
        let away = (params.generated_scatter * rng.random_range(-1.0..1.0f32)).to_radians();
        let axis = (drawn.normalize_or(Vec3::Y) * away.cos()).with_z(away.sin());
        let (u, v) = across(axis, VIEWER.lerp(LIGHT, params.light_seeking));
        let roll = (params.roll * rng.random_range(-1.0..1.0f32)).to_radians();
        let u = Quat::from_axis_angle(v, roll) * u;
        let length = drawn.length();
        Blade {
            template,
            base,
            u: u * length * copy.aspect,
            v: v * length,
            rest: RestSurface::Plane,
            form: BladeForm::default(),
        }
    }
}

/// Drawn leaves from one drawing to the next, all posed with the same parameters.
#[derive(Debug, Default)]
pub struct Leaves(Kept<LeafKey, Blade<Arc<Template>>>);

/// Everything that a drawn leaf is posed from but the parameters.
#[derive(Debug, PartialEq, Eq, Hash)]
struct LeafKey {
    leaf: DrawnBlade,
    /// The seed and the name of its random stream.
    chance: [u64; 2],
    /// The depth of its foot, and how the drawing maps to the world.
    place: [u32; 4],
}

impl Leaves {
    /// For a single drawing, of which nothing is kept.
    pub fn for_one_build() -> Self {
        Self(Kept::for_one_call())
    }

    /// Poses leaves, each at its foot, in their order, and puts their templates behind those of a plant; `outlines` are those
    /// that leaves are copies of. Copies are posed anew: there are many, and each is posed in no time.
    pub fn pose(
        &mut self,
        leaves: &[(&FlatBlade, Vec3)],
        outlines: &[Arc<[Vec2]>],
        poser: &LeafPoser<'_>,
        templates: &mut Templates,
    ) -> Vec<Blade> {
        let WorldFromCanvas { scale, origin } = poser.world;
        let key = |(leaf, foot): &(&FlatBlade, Vec3), used: Use| LeafKey {
            leaf: DrawnBlade::of(leaf, used),
            chance: [poser.seed, leaf.key()],
            place: [foot.z, scale, origin.x, origin.y].map(f32::to_bits),
        };
        let drawn: Vec<(&FlatBlade, Vec3)> =
            leaves.iter().filter(|(leaf, _)| leaf.copy_of.is_none()).copied().collect();
        let drawn = self.0.made(&drawn, key, |(leaf, foot)| poser.drawn(leaf, foot.z));
        let known = copied_templates(leaves, outlines, templates);
        let copied: Vec<Option<Blade>> = leaves
            .par_iter()
            .with_min_len(64)
            .map(|(leaf, foot)| {
                let copy = leaf.copy_of?;
                Some(poser.copied(leaf, copy, known[copy.template as usize]?, *foot))
            })
            .collect();
        let mut drawn =
            drawn.iter().map(|blade| blade.with_template(templates.add(Arc::clone(&blade.template))));
        copied.into_iter().filter_map(|blade| blade.or_else(|| drawn.next())).collect()
    }
}

/// Puts the outlines that leaves are copies of behind the templates of a plant; gives the place of each that is used.
fn copied_templates(
    leaves: &[(&FlatBlade, Vec3)],
    outlines: &[Arc<[Vec2]>],
    templates: &mut Templates,
) -> Vec<Option<TemplateId>> {
    let mut is_used = vec![false; outlines.len()];
    leaves
        .iter()
        .filter_map(|(leaf, _)| leaf.copy_of)
        .for_each(|copy| is_used[copy.template as usize] = true);
    let template = |outline: &[Vec2]| Template::new(outline.to_vec(), Vec::new(), 1.0, Detail::Reduced);
    let of_used =
        |(outline, is_used): (&Arc<[Vec2]>, bool)| is_used.then(|| templates.add(template(outline)));
    outlines.iter().zip(is_used).map(of_used).collect()
}

/// Unit vectors across and along the unit `axis` such that across × along comes as near as it can to `normal`.
fn across(axis: Vec3, normal: Vec3) -> (Vec3, Vec3) {
    (axis.cross(normal).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector()), axis)
}

/// What the pen's mean tilt adds to the normal of a leaf.
fn lean(flat: &FlatBlade, params: &LeafParams) -> Vec3 {
    let count = flat.outline.len().max(1) as f32;
    let tilt = flat.outline.iter().map(|s| s.tilt_deg).sum::<Vec2>() / count;
    let slope = |degrees: f32| degrees.clamp(-75.0, 75.0).to_radians().tan();
    params.tilt_gain * Vec3::new(slope(tilt.x), -slope(tilt.y), 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::Sample;

    const WORLD: WorldFromCanvas = WorldFromCanvas { scale: 0.001, origin: Vec2::ZERO };

    fn leaf(tilt: Vec2) -> FlatBlade {
        let points = [(0.0, 0.0), (50.0, -10.0), (100.0, -60.0), (40.0, -40.0)];
        let outline = points.map(|p| Sample { tilt_deg: tilt, ..Sample::neutral(Vec2::from(p)) }).into();
        FlatBlade {
            stroke: Some(1),
            outline,
            root: Vec2::ZERO,
            tip: Vec2::new(100.0, -60.0),
            copy_of: None,
            attachment: None,
        }
    }

    fn posed(flat: &FlatBlade, seed: u64, params: &LeafParams) -> Blade<Arc<Template>> {
        LeafPoser { world: WORLD, seed, params, curl: &CurlParams::default() }.drawn(flat, 0.02)
    }

    #[test]
    fn the_tip_keeps_its_place_on_the_sheet() {
        for seed in 0..20 {
            let blade = posed(&leaf(Vec2::ZERO), seed, &LeafParams::default());
            let tip = blade.tip_at_rest();
            assert!(tip.truncate().distance(Vec2::new(0.1, 0.06)) < 1e-5, "{tip}");
            assert_eq!(blade.base.z, 0.02);
        }
    }

    #[test]
    fn leaves_turn_to_the_light() {
        let facing = |light_seeking: f32| {
            let params = LeafParams { light_seeking, scatter: 0.0, ..Default::default() };
            let blade = posed(&leaf(Vec2::ZERO), 3, &params);
            blade.u.cross(blade.v)
        };
        assert!(facing(0.0).z > 0.99);
        assert!(facing(0.9).y > facing(0.3).y && facing(0.3).y > 0.05);
    }

    #[test]
    fn a_tilted_pen_leans_the_leaf() {
        let params = LeafParams { scatter: 0.0, light_seeking: 0.0, ..Default::default() };
        let blade = posed(&leaf(Vec2::new(-40.0, 0.0)), 3, &params);
        assert!(blade.u.cross(blade.v).x < -0.2);
        let off = LeafParams { tilt_gain: 0.0, ..params };
        assert!(posed(&leaf(Vec2::new(-40.0, 0.0)), 3, &off).u.cross(Vec3::Z).length() > 0.99);
    }

    #[test]
    fn copies_reach_from_root_to_length() {
        let outline = vec![Vec2::ZERO, Vec2::new(0.2, 0.5), Vec2::Y, Vec2::new(-0.2, 0.5)];
        let mut templates = Templates::default();
        let template = templates.add(Template::new(outline, Vec::new(), 1.0, Detail::Reduced));
        let copy = Copy { template: 0, aspect: 1.1, key: 9 };
        let base = Vec3::new(0.3, 0.2, 0.1);
        let (params, curl) = (&LeafParams::default(), &CurlParams::default());
        let blade =
            LeafPoser { world: WORLD, seed: 1, params, curl }.copied(&leaf(Vec2::ZERO), copy, template, base);
        assert_eq!(blade.template, template);
        assert!((templates.resolve(&blade).tip_at_rest().distance(base) - 0.1166).abs() < 1e-3);
    }
}
