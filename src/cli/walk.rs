//! Walks: pictures on the way along a path, or across where there is none.

use super::common;
use crate::atomic;
use crate::geom::polyline;
use crate::render::{ModelDrawData, PictureOptions, Renderer, walk};
use anyhow::{Context, Result, ensure};
use glam::{Vec2, Vec3};
use std::path::{Path, PathBuf};

/// How far beside the middle a walk without a path leads, shares of the width: in the middle stands the plant.
const ASIDE: f32 = 0.2;

/// How far through the scene it leads: at the end something is still to be seen.
const THROUGH: f32 = 0.6;
/// A scene that is less than twice as deep as high, as a single plant is, is only approached: from so far away to so near, in its heights.
/// Nearer one would look over it.
const BEFORE: f32 = 2.5;
const UP_TO: f32 = 1.2;

/// A walk.
pub(super) struct Walk<'a> {
    /// Where it leads, x and z in metres.
    pub(super) line: Vec<Vec2>,
    /// How high the ground is there.
    pub(super) ground: &'a dyn Fn(Vec2) -> f32,
    /// How high the highest plant is.
    pub(super) highest: f32,
    /// How many pictures are taken on the way.
    pub(super) count: u32,
}

/// The longest of some lines that has any length; without such a line one straight into what lies between these corners,
/// or up to it.
pub(super) fn longest(lines: impl Iterator<Item = Vec<Vec2>>, (low, high): (Vec3, Vec3)) -> Vec<Vec2> {
    let with_length = lines.map(|line| (polyline::length(&line), line));
    let longest = with_length.filter(|(length, _)| *length > 0.0).max_by(|a, b| a.0.total_cmp(&b.0));
    longest.map_or_else(|| straight(low, high), |(_, line)| line)
}

/// Straight into what lies between two corners, or up to it.
fn straight(low: Vec3, high: Vec3) -> Vec<Vec2> {
    let x = low.x.midpoint(high.x) + ASIDE * (high.x - low.x);
    let (depth, height) = (high.z - low.z, high.y - low.y);
    let (from, to) = match depth > 2.0 * height {
        true => (high.z, high.z - THROUGH * depth),
        false => (high.z + BEFORE * height, high.z + UP_TO * height),
    };
    vec![Vec2::new(x, from), Vec2::new(x, to)]
}

/// Where the pictures of a walk go.
pub(super) fn pictures(out: &Path, count: u32) -> Vec<PathBuf> {
    (0..count as usize).map(|i| common::numbered(out, i)).collect()
}

impl Walk<'_> {
    /// Writes the pictures; returns their size in bytes.
    ///
    /// # Errors
    /// A scene without extent, pictures that cannot be drawn or written.
    pub(super) fn write(
        &self,
        renderer: &mut Renderer,
        scene: &mut ModelDrawData,
        out: &Path,
        options: &PictureOptions,
    ) -> Result<usize> {
        let eye = walk::eye_height(self.highest);
        let cameras = walk::along(&self.line, self.count as usize, eye, self.ground);
        ensure!(!cameras.is_empty(), "{}: there is nothing to walk along; paint a path", out.display());
        let mut bytes = 0;
        let drawn = renderer.pictures_by(scene, &cameras, options);
        for (path, picture) in pictures(out, self.count).iter().zip(drawn) {
            let png = picture.with_context(|| path.display().to_string())?.to_png()?;
            atomic::write_atomically(path, &png)?;
            bytes += png.len();
        }
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_path_is_walked_or_straight_through() {
        let bounds = (Vec3::new(-5.0, 0.0, -3.0), Vec3::new(5.0, 2.0, 3.0));
        let paths = [vec![Vec2::ZERO, Vec2::X], vec![Vec2::ZERO, 4.0 * Vec2::Y], vec![Vec2::ONE]];
        assert_eq!(longest(paths.clone().into_iter(), bounds), paths[1]);
        let across = longest(paths.into_iter().skip(2), bounds);
        assert!(across[0] == Vec2::new(2.0, 3.0) && across[1].distance(Vec2::new(2.0, -0.6)) < 1e-4);
        let one = longest(std::iter::empty(), (Vec3::new(-0.5, 0.0, -0.2), Vec3::new(0.5, 1.0, 0.2)));
        assert!(one[0].distance(Vec2::new(0.2, 2.7)) < 1e-4 && one[1].distance(Vec2::new(0.2, 1.4)) < 1e-4);
        let names = pictures(Path::new("a/walk.png"), 2);
        assert_eq!(names, [Path::new("a/walk-000.png"), Path::new("a/walk-001.png")]);
    }
}
