//! `--obstacle` of `grow`: what stands beside the plant, a mesh or a wall or trellis in words.

use super::inside;
use crate::growth::{MAX_MESH_BYTES, Obstacles};
use crate::input;
use anyhow::{Context, Result};
use glam::Vec3;
use std::path::Path;
use std::sync::Arc;

/// How the argument may be written.
const FORMS: &str = "write it as the path of an .obj file, wall:4x2x0.2 (width, height, depth in metres) or trellis:1.5x2 (width, \
                     height), with its place behind it where it does not stand in the middle: wall:4x2x0.2@0,0,-0.6";

/// All obstacles of the arguments as one; none where there is no argument.
///
/// # Errors
/// An obstacle that is written wrong, a file that cannot be read, or a mesh that cannot be used.
pub(super) fn obstacles(arguments: &[String]) -> Result<Option<Arc<Obstacles>>> {
    let mut all: Option<Obstacles> = None;
    for text in arguments {
        let one = obstacle(text)?;
        let (low, high) = one.bounds();
        inside::check_place(&format!("--obstacle {text}"), low, high)?;
        all = Some(match all {
            Some(others) => others.and(&one),
            None => one,
        });
    }
    Ok(all.map(Arc::new))
}

fn obstacle(text: &str) -> Result<Obstacles> {
    if inside::is_obj(text) {
        let bytes = input::read(Path::new(text), MAX_MESH_BYTES as u64)
            .with_context(|| format!("--obstacle {text}"))?;
        // Names and comments may be in any encoding; all that counts is plain.
        return Obstacles::from_obj(&String::from_utf8_lossy(&bytes), text).context("--obstacle");
    }
    in_words(text).with_context(|| format!("--obstacle {text}: {FORMS}"))
}

fn in_words(text: &str) -> Option<Obstacles> {
    let (body, place) = text.split_once('@').unwrap_or((text, "0,0,0"));
    let place = place.split(',').map(|x| x.parse().ok().filter(|x: &f32| x.is_finite()));
    let place = <[f32; 3]>::try_from(place.collect::<Option<Vec<f32>>>()?).ok()?;
    let (kind, sizes) = body.split_once(':')?;
    let sizes: Vec<f32> = sizes.split('x').map(inside::number).collect::<Option<_>>()?;
    let stands = match (kind, sizes.as_slice()) {
        ("wall", &[width, height, depth]) => Obstacles::wall(Vec3::new(width, height, depth)),
        ("trellis", &[width, height]) if width.max(height) <= MOST_TRELLIS => {
            Obstacles::trellis(width, height)
        }
        _ => return None,
    };
    Some(stands.moved(place.into()))
}

/// Widest and highest trellis, metres: it has slats all over.
const MOST_TRELLIS: f32 = 50.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        crate::cli::one_line(&obstacles(&[text.to_owned()]).unwrap_err())
    }

    #[test]
    fn several_obstacles_stand_where_they_are_put() {
        let wall = ["wall:4x2x0.2@0,0,-0.6", "trellis:1x2@3,0,0"].map(str::to_owned);
        let (low, high) = obstacles(&wall).unwrap().unwrap().bounds();
        assert!((low - Vec3::new(-2.0, 0.0, -0.7)).length() < 1e-5, "{low}");
        assert!((high - Vec3::new(3.5, 2.0, 0.03)).length() < 1e-5, "{high}");
        assert!(obstacles(&[]).unwrap().is_none());
    }

    #[test]
    fn what_is_written_wrong_is_refused_with_how_to_write_it() {
        for wrong in [
            "wall",
            "wall:2x2",
            "wall:0x2x1",
            "trellis:1x2x3",
            "hedge:2x2x2",
            "wall:1x1x1@0,0",
            "wall:1x1x1@a,0,0",
            "trellis:900x2",
        ] {
            let message = message(wrong);
            assert!(message.starts_with(&format!("--obstacle {wrong}: write it as")), "{message}");
        }
        assert!(message("wall:1x1x1@5000,0,0").contains("move it to the origin"));
        assert!(message("no-such-file.obj").contains("--obstacle no-such-file.obj"));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fence.obj");
        std::fs::write(&path, "v 0 0 0\nf 1 1 9\n").unwrap();
        assert!(message(path.to_str().unwrap()).contains("line 2"));
    }
}
