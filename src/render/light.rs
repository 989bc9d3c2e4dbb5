//! The studio's light as the shaders read it: one sun and a dome of sky lamps, each fitted to the model.
//!
//! Every lamp sees the model in parallel projection; its map covers the model's box and a rim of nothing, so that whatever
//! falls outside the map is lit. The sky's lamps stand on a Fibonacci spiral over the hemisphere, evenly by solid angle.
//! Strengths are normalised: level open ground receives [`studio::SKY_RADIANCE`] from the sky. [`LightParams`] is what
//! the artist may change; angles are seen by the viewer, with whom the lamps turn.
//!
//! The sun's colour is that of a black body: the Planckian locus of Kim et al. (US patent 7024034, 2006), relative to the
//! studio's own sun. Limits: one sun, and the sky's colours are the studio's.

use super::camera::Axes;
use super::studio;
use crate::geom::hemisphere::direction;
use crate::parameters;
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec2, Vec3, Vec4};

/// Number of sky lamps; `SKY_LAMPS` in `light.wgsl`.
pub(super) const SKY_LAMPS: usize = 16;
/// Width of the sun's shadow map in texels.
pub(super) const SUN_MAP_SIZE: u32 = 2048;
/// Width of each sky lamp's shadow map in texels.
pub(super) const SKY_MAP_SIZE: u32 = 512;
/// Share of a map's width kept empty on each side.
const RIM: f32 = 0.02;
/// Temperature of the studio's own sun in kelvin.
const STUDIO_SUN_K: f32 = 5500.0;

parameters! {
    /// The light on the plant.
    pub struct LightParams {
        /// Side from which the sun shines, seen by the viewer: 0 from behind the viewer, negative from the left.
        sun_azimuth_deg: f32 = -47.7, -180.0..=180.0, "°";
        /// Height of the sun above the horizon.
        sun_elevation_deg: f32 = 45.3, 5.0..=90.0, "°";
        /// Strength of the sun; 0 switches it off.
        sun_strength: f32 = 1.0, 0.0..=3.0, "";
        /// Colour of the sun: low is warm like a candle, high is cool like the shade.
        sun_temperature_k: f32 = 5500.0, 2000.0..=12000.0, "K";
        /// Width of the sun in the sky: a wider one throws softer shadows.
        sun_width_deg: f32 = 4.0, 0.5..=20.0, "°";
        /// Strength of the light from the whole sky.
        sky_strength: f32 = 1.0, 0.0..=3.0, "";
    }
}

impl LightParams {
    /// Unit vector to the sun in a level viewer's axes.
    fn sun_toward(&self) -> Vec3 {
        let (sin, cos) = self.sun_azimuth_deg.to_radians().sin_cos();
        let (up, level) = self.sun_elevation_deg.to_radians().sin_cos();
        Vec3::new(sin * level, up, cos * level)
    }

    fn sun_radiance(&self) -> Vec3 {
        let tint = black_body(self.sun_temperature_k) / black_body(STUDIO_SUN_K);
        studio::SUN_RADIANCE * tint * self.sun_strength
    }

    /// Tangent of half the angle under which the sun is seen: how fast shadows soften.
    fn sun_spread(&self) -> f32 {
        (self.sun_width_deg / 2.0).to_radians().tan()
    }
}

/// Linear RGB of a black body of unit luminance, 2000 to 12000 K.
fn black_body(kelvin: f32) -> Vec3 {
    let t = 1000.0 / kelvin.clamp(1667.0, 25000.0);
    let polynomial = |c: [f32; 4], x: f32| ((c[0] * x + c[1]) * x + c[2]) * x + c[3];
    let x = if kelvin < 4000.0 {
        polynomial([-0.266_123_9, -0.234_358_9, 0.877_695_6, 0.179_910], t)
    } else {
        polynomial([-3.025_847, 2.107_037_9, 0.222_634_7, 0.240_390], t)
    };
    let y = if kelvin < 2222.0 {
        polynomial([-1.106_381_4, -1.348_110_2, 2.185_558_3, -0.202_196_83], x)
    } else if kelvin < 4000.0 {
        polynomial([-0.954_947_6, -1.374_185_9, 2.091_37, -0.167_488_67], x)
    } else {
        polynomial([3.081_758, -5.873_387, 3.751_13, -0.370_014_83], x)
    };
    let xyz = Vec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let rgb = Vec3::new(
        xyz.dot(Vec3::new(3.2406, -1.5372, -0.4986)),
        xyz.dot(Vec3::new(-0.9689, 1.8758, 0.0415)),
        xyz.dot(Vec3::new(0.0557, -0.2040, 1.0570)),
    );
    rgb.max(Vec3::ZERO)
}

/// One lamp as in `light.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct Lamp {
    /// World to the lamp's map: x and y −1 to 1, z 0 near the lamp to 1.
    pub(super) lamp_from_world: Mat4,
    /// Unit vector to the lamp; w: offset along the normal before a shadow is looked up, metres.
    toward: Vec4,
    radiance: Vec4,
}

impl Lamp {
    /// This lamp in its place, as strong as another.
    pub(super) fn with_radiance_of(self, other: &Self) -> Self {
        Self { radiance: other.radiance, ..self }
    }
}

/// All lamps as in `light.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct LightUniform {
    pub(super) sky: [Lamp; SKY_LAMPS],
    pub(super) sun: Lamp,
    penumbra: Vec4,
    ambient_above: Vec4,
    ambient_below: Vec4,
}

impl LightUniform {
    /// The light on a model inside `bounds`, turned with a level viewer's axes; the sun's map is `sun_map_size` wide.
    pub(super) fn new(bounds: (Vec3, Vec3), viewer: &Axes, params: &LightParams, sun_map_size: u32) -> Self {
        let turned = |v: Vec3| viewer.world_from_view(v.normalize());
        let sun = LampBox::new(bounds, turned(params.sun_toward()));
        let penumbra = Vec2::splat(params.sun_spread() * sun.range) / (2.0 * sun.half);
        let glow_depth = studio::GLOW_DEPTH * (bounds.1 - bounds.0).length();
        let irradiance: Vec3 = (0..SKY_LAMPS).map(sky_toward).map(|d| sky_colour(d) * d.y).sum();
        let sky = std::array::from_fn(|i| {
            let toward = sky_toward(i);
            let radiance = params.sky_strength * studio::SKY_RADIANCE * sky_colour(toward) / irradiance;
            LampBox::new(bounds, turned(toward)).lamp(radiance, SKY_MAP_SIZE)
        });
        Self {
            sky,
            sun: sun.lamp(params.sun_radiance(), sun_map_size),
            penumbra: penumbra.extend(glow_depth).extend(0.0),
            ambient_above: studio::AMBIENT_ABOVE.extend(0.0),
            ambient_below: studio::AMBIENT_BELOW.extend(0.0),
        }
    }

    /// Every lamp with a shadow map, the sky's first.
    pub(super) fn lamps(&self) -> impl Iterator<Item = &Lamp> {
        self.sky.iter().chain(std::iter::once(&self.sun))
    }
}

/// Unit direction of the i-th sky lamp in a level viewer's axes. None is so low that its shadows never end.
fn sky_toward(i: usize) -> Vec3 {
    direction(i, SKY_LAMPS)
}

fn sky_colour(toward: Vec3) -> Vec3 {
    studio::SKY_HORIZON.lerp(Vec3::ONE, toward.y)
}

/// The model's box as a lamp sees it.
struct LampBox {
    right: Vec3,
    up: Vec3,
    toward: Vec3,
    centre: Vec2,
    /// Half width and half height of the map in metres.
    half: Vec2,
    /// Nearest place to the lamp, metres along `toward`.
    near: f32,
    /// Length of the map's depth in metres.
    range: f32,
}

impl LampBox {
    fn new(bounds: (Vec3, Vec3), toward: Vec3) -> Self {
        let (right, up) = toward.any_orthonormal_pair();
        let middle = (bounds.0 + bounds.1) / 2.0;
        let half_box = ((bounds.1 - bounds.0) / 2.0).max(Vec3::splat(1e-6));
        let reach = |axis: Vec3| half_box.dot(axis.abs());
        let range = 2.0 * reach(toward) * (1.0 + 2.0 * RIM);
        Self {
            right,
            up,
            toward,
            centre: Vec2::new(middle.dot(right), middle.dot(up)),
            half: Vec2::new(reach(right), reach(up)) * (1.0 + 2.0 * RIM),
            near: middle.dot(toward) + range / 2.0,
            range,
        }
    }

    fn lamp(&self, radiance: Vec3, map_size: u32) -> Lamp {
        let row = |axis: Vec3, middle: f32, half: f32| (axis / half).extend(-middle / half);
        let lamp_from_world = Mat4::from_cols(
            row(self.right, self.centre.x, self.half.x),
            row(self.up, self.centre.y, self.half.y),
            row(-self.toward, -self.near, self.range),
            Vec4::W,
        )
        .transpose();
        // A texel and a half covers the error of a map that sees the surface at a slant.
        let offset = 1.5 * 2.0 * self.half.max_element() / map_size as f32;
        Lamp { lamp_from_world, toward: self.toward.extend(offset), radiance: radiance.extend(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::camera::View;
    use super::*;

    fn studio_light(bounds: (Vec3, Vec3), view: &View) -> LightUniform {
        LightUniform::new(bounds, &view.level_axes(), &LightParams::default(), SUN_MAP_SIZE)
    }

    #[test]
    fn the_sun_is_warm_when_it_is_cool_in_kelvin() {
        let at = |sun_temperature_k| LightParams { sun_temperature_k, ..Default::default() }.sun_radiance();
        assert!((at(STUDIO_SUN_K) - studio::SUN_RADIANCE).length() < 1e-6);
        let ratios = [2000.0, 3999.0, 4001.0, 5500.0, 12000.0].map(|k| at(k).x / at(k).z.max(1e-6));
        assert!(ratios.is_sorted_by(|a, b| a > b), "{ratios:?}");
        assert!((at(3999.0) - at(4001.0)).length() < 0.02, "no step where the formula changes");
    }

    #[test]
    fn every_lamp_sees_the_whole_box_inside_its_rim() {
        let (lo, hi) = (Vec3::new(-0.3, 0.0, -0.1), Vec3::new(0.5, 2.0, 0.2));
        let view = View { turn_deg: 40.0, ..View::default() };
        let light = studio_light((lo, hi), &view);
        for (n, lamp) in light.lamps().enumerate() {
            for i in 0..8 {
                let corner = Vec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), hi, lo);
                let map = lamp.lamp_from_world.transform_point3(corner);
                assert!(map.x.abs() < 0.99 && map.y.abs() < 0.99, "lamp {n}: {map}");
                assert!((0.005..0.995).contains(&map.z), "lamp {n}: {map}");
            }
        }
    }

    #[test]
    fn open_level_ground_receives_the_sky_as_described() {
        let light = studio_light((Vec3::ZERO, Vec3::ONE), &View::default());
        let ground: Vec3 = light.sky.iter().map(|l| l.radiance.truncate() * l.toward.y).sum();
        assert!((ground - studio::SKY_RADIANCE).length() < 1e-4, "{ground}");
    }

    #[test]
    fn lamps_turn_with_the_viewer() {
        let at = |turn_deg| {
            let view = View { turn_deg, ..View::default() };
            studio_light((Vec3::ZERO, Vec3::ONE), &view).sun.toward.truncate()
        };
        let (front, back) = (at(0.0), at(180.0));
        assert!((front.x + back.x).abs() < 1e-5 && (front.z + back.z).abs() < 1e-5);
        assert!((front.y - back.y).abs() < 1e-5);
    }
}
