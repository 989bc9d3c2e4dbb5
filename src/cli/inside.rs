//! `--inside` of `grow`: the volume that a plant is to fill, a closed mesh or a simple body in words.
//!
//! Simple bodies stand on the ground over the origin. A mesh stays where it was modelled, in metres, y up; the trunk rises
//! to it from the ground.

use crate::growth::MAX_MESH_BYTES;
use crate::growth::{Envelope, Field, Simulation, Solid};
use crate::input;
use crate::pipeline::SetupError;
use anyhow::{Context, Result, ensure};
use glam::Vec3;
use std::path::Path;
use std::sync::Arc;

/// Least and largest extent of a volume along an axis, metres: of what plants are.
const EXTENT: (f32, f32) = (0.01, 150.0);
/// Farthest corner from the origin along an axis, metres.
const FARTHEST: f32 = 1000.0;
/// Share of a volume from which it counts as filled.
pub const FILLED: f32 = 0.5;
/// How the argument may be written.
const FORMS: &str = "write it as the path of an .obj file, box:2x3x2 or ellipsoid:2x3x2 (width, height, depth in \
                     metres) or sphere:1.5 (radius in metres)";

/// The volume of an argument of `--inside`.
///
/// # Errors
/// A body that is written wrong, a file that cannot be read, or a mesh that is no volume for a plant.
pub fn volume(text: &str) -> Result<Envelope> {
    let volume = match text.split_once(':') {
        Some(("box", sizes)) => sized(sizes).map(|size| {
            let half = Vec3::new(0.5 * size.x, 0.0, 0.5 * size.z);
            Envelope::Box { low: -half, high: half.with_y(size.y) }
        }),
        Some(("ellipsoid", sizes)) => {
            sized(sizes).map(|size| Envelope::Ellipsoid { centre: Vec3::Y * 0.5 * size.y, radii: 0.5 * size })
        }
        Some(("sphere", radius)) => {
            number(radius).map(|radius| Envelope::Sphere { centre: Vec3::Y * radius, radius })
        }
        _ if is_obj(text) => Some(Envelope::Solid(Arc::new(solid(text)?))),
        _ => None,
    };
    let volume = volume.with_context(|| format!("--inside {text}: {FORMS}"))?;
    if let Some((low, high)) = volume.bounds() {
        check_size(&format!("--inside {text}"), low, high)?;
    }
    Ok(volume)
}

/// Share of a volume that a plant fills, by the markers of space in it that it occupies.
pub fn filled(simulation: &Simulation) -> f32 {
    match simulation.field() {
        Field::Space(markers) => markers.occupied().count() as f32 / markers.len().max(1) as f32,
        Field::Light(_) => 1.0,
    }
}

/// Whether a plant has any room in its volume.
///
/// # Errors
/// [`SetupError::NoRoom`] where it has none.
pub fn check_room(simulation: &Simulation) -> Result<(), SetupError> {
    match simulation.field() {
        Field::Space(markers) if markers.is_empty() => Err(SetupError::NoRoom),
        _ => Ok(()),
    }
}

/// Whether an argument is the name of an OBJ file.
pub(super) fn is_obj(text: &str) -> bool {
    Path::new(text).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"))
}

/// A size in metres.
pub(super) fn number(text: &str) -> Option<f32> {
    text.parse().ok().filter(|x: &f32| x.is_finite() && *x > 0.0)
}

/// `2x3x2` as width, height and depth.
fn sized(text: &str) -> Option<Vec3> {
    let sizes: Vec<f32> = text.split('x').map(number).collect::<Option<_>>()?;
    <[f32; 3]>::try_from(sizes).ok().map(Vec3::from_array)
}

fn solid(path: &str) -> Result<Solid> {
    let context = || format!("--inside {path}");
    let bytes = input::read(Path::new(path), MAX_MESH_BYTES as u64).with_context(context)?;
    // Names and comments may be in any encoding; all that counts is plain.
    Solid::from_obj(&String::from_utf8_lossy(&bytes), path).context("--inside")
}

/// Whether a volume has the size of plants; `argument` is how it was given.
///
/// # Errors
/// One that is too small, too large or too far away.
pub(super) fn check_size(argument: &str, low: Vec3, high: Vec3) -> Result<()> {
    let size = high - low;
    ensure!(size.min_element() >= EXTENT.0, out_of_scale(argument, size));
    check_largest(argument, low, high)?;
    check_place(argument, low, high)
}

/// Whether a part of a volume is no larger than plants.
///
/// # Errors
/// One that is.
pub(super) fn check_largest(argument: &str, low: Vec3, high: Vec3) -> Result<()> {
    let size = high - low;
    ensure!(size.max_element() <= EXTENT.1, out_of_scale(argument, size));
    Ok(())
}

fn out_of_scale(argument: &str, size: Vec3) -> String {
    let (least, most) = EXTENT;
    let [width, height, depth] = size.to_array();
    format!(
        "{argument}: the volume is {width} × {height} × {depth} m, but each of these must be {least} to {most}: scale it, one \
         unit of a mesh is a metre"
    )
}

/// Whether a body is not too far away; `argument` is how it was given.
///
/// # Errors
/// One that is.
pub(super) fn check_place(argument: &str, low: Vec3, high: Vec3) -> Result<()> {
    let far = low.abs().max(high.abs()).max_element();
    ensure!(
        far <= FARTHEST,
        "{argument}: it reaches {far} m from the origin, more than {FARTHEST} m; move it to the origin"
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::Outcome;
    use crate::growth::flipped;
    use crate::pipeline::{self, Cache, Seed};
    use crate::species::Species;

    /// A closed ring about the y axis, its middle line of radius `major`, as an OBJ file.
    fn torus(major: f32, minor: f32, up: f32) -> String {
        let (around, across) = (32, 16);
        let angle = |k: usize, of: usize| k as f32 / of as f32 * std::f32::consts::TAU;
        let mut text = String::from("# a ring, grün\n");
        for i in 0..around {
            for k in 0..across {
                let ((s, c), (t, d)) = (angle(i, around).sin_cos(), angle(k, across).sin_cos());
                let r = major + minor * d;
                text += &format!("v {} {} {}\n", r * c, up + minor * t, r * s);
            }
        }
        let at = |i: usize, k: usize| (i % around) * across + k % across + 1;
        for i in 0..around {
            for k in 0..across {
                text += &format!("f {} {} {} {}\n", at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
            }
        }
        text
    }

    fn message(text: &str) -> String {
        crate::cli::one_line(&volume(text).unwrap_err())
    }

    #[test]
    fn bodies_stand_on_the_ground() {
        for text in ["box:2x3x1", "ellipsoid:2x3x1", "sphere:1.5"] {
            let (low, high) = volume(text).unwrap().bounds().unwrap();
            assert!(low.y == 0.0 && high.y == 3.0 && low.x == -high.x && low.z == -high.z, "{text}");
        }
    }

    #[test]
    fn what_is_no_volume_is_one_clear_message() {
        for wrong in
            ["box:2x3", "box:2x3x0", "box:2x3xnan", "sphere:-1", "cube:1x1x1", "shape.stl", "", "sphere:"]
        {
            assert!(message(wrong).contains("write it as"), "{}", message(wrong));
        }
        assert!(
            message("sphere:200").contains("scale it")
                && message("box:0.001x0.001x0.001").contains("scale it")
        );
        assert!(message("no-such-file.obj").contains("--inside no-such-file.obj: "));
        let folder = tempfile::tempdir().unwrap();
        let file = |text: &str| {
            let path = folder.path().join("shape.obj");
            std::fs::write(&path, text).unwrap();
            message(path.to_str().unwrap())
        };
        let ring = torus(1.0, 0.3, 1.0);
        let open = ring.rsplit_once("\nf ").unwrap().0;
        for (text, expected) in [
            ("", "there is no face"),
            (open, "the mesh is open: 4 edges"),
            (&flipped(&ring), "flip its normals"),
            ("f 1 2 3\n", "shape.obj"),
            (&torus(1000.0, 100.0, 0.0), "scale it"),
            (&torus(1.0, 0.3, 5000.0), "move it to the origin"),
        ] {
            let message = file(text);
            assert!(message.contains(expected) && !message.contains('\n'), "{expected}: {message}");
        }
    }

    #[test]
    fn a_volume_out_of_scale_is_not_filled() {
        let species = Species::built_in("hazel").unwrap();
        let params = pipeline::params_of_species(&species, &[]).unwrap();
        let volume = Some(Arc::new(volume("box:100x100x100").unwrap()));
        let mut cache = Cache::default();
        let seed = Seed { number: 3, volume, ..Seed::default() };
        pipeline::build_with(&mut cache, &seed, &species, &params, &|| false).unwrap();
        assert!(filled(cache.seed.simulation().unwrap()) < 0.1);
    }

    #[test]
    fn a_volume_too_thin_for_anything_is_refused() {
        let species = Species::built_in("hazel").unwrap();
        let params = pipeline::params_of_species(&species, &[]).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("slanting.obj");
        // A tetrahedron, its extent a metre each way, whose fourth corner lies `deep` under the middle of the others.
        let grown = |deep: f32| {
            let fourth = Vec3::splat(2.0 / 3.0 - deep);
            let text = format!(
                "v 1 1 0\nv 0 1 1\nv 1 0 1\nv {} {} {}\nf 1 2 3\nf 2 1 4\nf 3 2 4\nf 1 3 4\n",
                fourth.x, fourth.y, fourth.z
            );
            std::fs::write(&path, text).unwrap();
            let volume = Some(Arc::new(volume(path.to_str().unwrap()).unwrap()));
            let mut cache = Cache::default();
            let seed = Seed { number: 3, age: Some(3.0), volume, ..Seed::default() };
            pipeline::build_with(&mut cache, &seed, &species, &params, &|| false).unwrap();
            check_room(cache.seed.simulation().unwrap())
        };
        let refused = grown(2e-7).err().unwrap();
        assert!(matches!(refused, SetupError::NoRoom), "{refused}");
        assert!(refused.to_string().contains("too thin") && refused.to_string().contains("make it thicker"));
        assert!(grown(0.3).is_ok(), "a thicker one has room");
    }

    #[test]
    fn a_plant_fills_a_volume_and_stays_inside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ring.OBJ");
        std::fs::write(&path, torus(1.0, 0.35, 1.5)).unwrap();
        let species = Species::built_in("box").unwrap();
        let params = pipeline::params_of_species(&species, &[]).unwrap();
        for text in [path.to_str().unwrap(), "box:1.5x1.5x1.5"] {
            let volume = Arc::new(volume(text).unwrap());
            let mut cache = Cache::default();
            let seed = Seed { number: 3, volume: Some(volume.clone()), ..Seed::default() };
            let grown = pipeline::build_with(&mut cache, &seed, &species, &params, &|| false).unwrap();
            let simulation = cache.seed.simulation().unwrap();
            assert_eq!(grown.growth.unwrap().outcome, Outcome::Growing, "{text}");
            assert!(filled(simulation) > FILLED, "{text}: {}", filled(simulation));
            simulation.check_envelope().unwrap();
            let leaves = &grown.plant.organs;
            assert!(leaves.len() > 1000, "{text}: {} leaves", leaves.len());
            // Leaves stand on the bark, and shoots may cut a corner by a quarter of an internode.
            let near = 0.25 * simulation.habit().internode + 0.01;
            let inside = |p: Vec3| {
                let around = [Vec3::ZERO, Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
                around.iter().any(|d| volume.contains(p + d * near))
            };
            let out = leaves.iter().filter(|leaf| !inside(leaf.base())).count();
            assert_eq!(out, 0, "{text}: of {} leaves", leaves.len());
            // All eight corners of the volume's box, or quarters of the ring, are grown into.
            let (low, high) = volume.bounds().unwrap();
            let middle = low.midpoint(high);
            for corner in 0..4 {
                let part =
                    |p: Vec3| (p.x > middle.x) == (corner % 2 == 0) && (p.z > middle.z) == (corner / 2 == 0);
                let here = leaves.iter().filter(|leaf| part(leaf.base())).count();
                assert!(here * 8 > leaves.len(), "{text}: {here} of {} leaves", leaves.len());
            }
        }
    }
}
