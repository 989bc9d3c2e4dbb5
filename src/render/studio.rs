//! Every number that decides how pictures look: paper, sun, sky, camera.
//!
//! Colours are linear RGB. Angles are relative to the camera: the studio's lamps turn with the viewer, so that a plant on a
//! turntable is lit the same way from all sides.

use glam::{Vec2, Vec3};

/// Vertical opening of the perspective camera.
pub(super) const FIELD_OF_VIEW_DEG: f32 = 28.0;
/// Share of the picture's half width and half height left free around the plant.
pub(super) const MARGIN: f32 = 0.1;

/// Warm paper where the light falls, toned so that white petals stand out from it, linear.
pub(super) const PAPER_CENTRE: Vec3 = Vec3::new(0.80, 0.745, 0.65);
/// The same paper in the corners, linear.
pub(super) const PAPER_EDGE: Vec3 = Vec3::new(0.62, 0.56, 0.455);
/// Dark sheet for the dark theme where the light falls, linear.
pub(super) const DARK_CENTRE: Vec3 = Vec3::new(0.046, 0.048, 0.052);
/// The same sheet in the corners, linear.
pub(super) const DARK_EDGE: Vec3 = Vec3::new(0.019, 0.020, 0.023);
/// The clear sky overhead and at the horizon, where the ground goes over into it, linear.
pub(super) const OVERHEAD: Vec3 = Vec3::new(0.16, 0.34, 0.66);
/// The horizon.
pub(super) const HORIZON: Vec3 = Vec3::new(0.72, 0.80, 0.84);
/// Colour of ink on paper, linear.
pub(super) const INK: Vec3 = Vec3::new(0.018, 0.016, 0.026);
/// Radius of the pen's line at full pressure, as a share of the drawing's diagonal.
pub(super) const INK_RADIUS: f32 = 0.0032;

/// Colour and strength of the sun. Its place is in [`LightParams`](super::LightParams).
pub(super) const SUN_RADIANCE: Vec3 = Vec3::new(1.18, 1.10, 0.98);

/// Irradiance of the whole open sky on level ground.
pub(super) const SKY_RADIANCE: Vec3 = Vec3::new(0.56, 0.59, 0.63);
/// How much warmer and dimmer the sky is at the horizon than overhead.
pub(super) const SKY_HORIZON: Vec3 = Vec3::new(0.95, 0.85, 0.72);
/// Light from everywhere above, beyond sun and sky; multiplies a material's ambient colour.
pub(super) const AMBIENT_ABOVE: Vec3 = Vec3::new(0.30, 0.30, 0.32);
/// Light thrown back by the paper from below; multiplies a material's ambient colour.
pub(super) const AMBIENT_BELOW: Vec3 = Vec3::new(0.46, 0.41, 0.34);
/// Thickness through which light shines, as a share of the model's size.
pub(super) const GLOW_DEPTH: f32 = 0.006;

/// Camera elevation in degrees for front and side in perspective: enough to see the ground.
pub(super) const LEVEL_ELEVATION_DEG: f32 = 7.0;
/// Azimuth and elevation in degrees of the three-quarter view.
pub(super) const THREE_QUARTER_DEG: Vec2 = Vec2::new(35.0, 22.0);
