//! A whole plant as pictures from many sides, for where it is small: of each copy one is shown, that from the side nearest to the
//! viewer's.
//!
//! The sides are eight around at three heights, and the one from above. Each picture is on a card square to its side, before the plant, so
//! that no ground hides any of it. The pictures of a plant are one.
//!
//! Limits: between two sides the plant is up to 23 degrees turned from where it should be. Its shadow is that of the card.

use super::atlas::grid;
use super::picture::{Cell, Drawing};
use super::sky::Sky;
use super::surfaces::{self, Triangle};
use crate::model::Model;
use crate::picture::Picture;
use crate::plant::Shape;
use glam::{Vec2, Vec3};
use rayon::prelude::*;
use std::f32::consts::TAU;

/// How many sides there are around a plant, and how high each row of them is, degrees.
const AROUND: usize = 8;
const HEIGHTS: [f32; 3] = [5.0, 32.0, 60.0];
/// Pictures beside one another: five rows of five.
const COLUMNS: usize = 5;
/// How much larger a card is than what it shows, share of its extent.
const MARGIN: f32 = 0.02;

/// A plant as it is seen from one side.
pub(super) struct View {
    /// Toward the viewer, of length 1.
    pub(super) toward: Vec3,
    /// Its card.
    pub(super) card: Shape,
}

/// The sides from which plants are seen.
fn sides() -> impl Iterator<Item = Vec3> {
    let around = HEIGHTS.into_iter().flat_map(|height| {
        let (up, level) = height.to_radians().sin_cos();
        (0..AROUND).map(move |i| {
            let (sin, cos) = (TAU * i as f32 / AROUND as f32).sin_cos();
            Vec3::new(level * sin, up, level * cos)
        })
    });
    around.chain([Vec3::Y])
}

/// The picture of a model from all sides, at most so many pixels wide and high from each, and the cards that show it; none of a model
/// without surfaces.
pub(super) fn painted(model: &Model, pixels: u32) -> Option<(Picture, Vec<View>)> {
    let surfaces = surfaces::of_materials(&model.materials);
    let triangles = surfaces::triangles_of(&model.flattened(), |material| &surfaces[material]);
    if triangles.is_empty() {
        return None;
    }
    let sky = Sky::over(&triangles);
    let drawing = Drawing { pixels, share: 1.0 };
    let cards: Vec<(Vec3, [Vec3; 3])> = sides().map(|toward| (toward, around(&triangles, toward))).collect();
    let paint = |(_, [base, u, v]): &(Vec3, [Vec3; 3])| {
        Cell::painted(&triangles, Some(&sky), (*base, *u, *v), drawing)
    };
    let cells: Vec<Cell> = cards.par_iter().map(paint).collect();
    let all: Vec<&Cell> = cells.iter().collect();
    let picture = Picture::new(grid(&all, COLUMNS, pixels as usize)?.to_png().ok()?).ok()?;
    let squares = Vec2::new(COLUMNS as f32, cells.len().div_ceil(COLUMNS) as f32);
    let view = |(i, &(toward, [base, u, v])): (usize, &(Vec3, [Vec3; 3]))| {
        let (column, row) = ((i % COLUMNS) as f32, (i / COLUMNS) as f32);
        let low = Vec2::new(column, squares.y - 1.0 - row) / squares;
        let window = [low, low + cells[i].size.as_vec2() / pixels as f32 / squares];
        View { toward, card: Shape::Card { base, u, v, window, is_whole: false } }
    };
    let views = cards.iter().enumerate().map(view).collect();
    Some((picture, views))
}

/// The card square to a side: the middle of its lower edge, its width and its height. It touches the foremost point.
fn around(triangles: &[Triangle<'_>], toward: Vec3) -> [Vec3; 3] {
    let right = Vec3::Y.cross(toward).try_normalize().unwrap_or(Vec3::X);
    let up = toward.cross(right);
    let corners = triangles.iter().flat_map(|triangle| &triangle.corners);
    let seen =
        corners.map(|corner| Vec3::new(corner.at.dot(right), corner.at.dot(up), corner.at.dot(toward)));
    let (low, high) =
        seen.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    let margin = (MARGIN * (high - low)).max(Vec3::splat(f32::MIN_POSITIVE.sqrt()));
    let (low, high) = (low - margin, high + margin);
    let base = right * low.x.midpoint(high.x) + up * low.y + toward * high.z;
    [base, right * (high.x - low.x), up * (high.y - low.y)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Mesh, Part, PartKind};
    use crate::picture::decode::Rgba;
    use crate::plant::Material;
    use std::sync::Arc;

    #[test]
    fn a_model_is_seen_from_all_sides_as_wide_as_it_is() {
        let points = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.5, 1.0]].map(Vec3::from);
        let mesh = Mesh::faceted(&points, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        let part = Part::alone("pyramid", PartKind::Wood, 0, Arc::new(mesh));
        let model = Model { parts: vec![part], materials: vec![Material::plain("stone", [0.5; 3])] };
        let (picture, views) = painted(&model, 48).unwrap();
        let Rgba { width, height, pixels } = picture.pixels().unwrap();
        assert_eq!((width, height, views.len()), (5 * 48, 5 * 48, 25));
        for (i, View { toward, card }) in views.iter().enumerate() {
            let Shape::Card { base, u, v, window: [low, high], .. } = card else { panic!("no card") };
            assert!(u.cross(*v).normalize().dot(*toward) > 0.999 && base.is_finite(), "{i}");
            // Something of the plant reaches to each edge of its window.
            let size = Vec2::new(width as f32, height as f32);
            let (from, to) = ((*low * size).as_usizevec2(), (*high * size).as_usizevec2());
            let is_seen =
                |x: usize, up: usize| pixels[4 * ((height as usize - 1 - up) * width as usize + x) + 3] > 0;
            let columns: Vec<usize> =
                (from.x..to.x).filter(|x| (from.y..to.y).any(|up| is_seen(*x, up))).collect();
            let rows: Vec<usize> =
                (from.y..to.y).filter(|up| (from.x..to.x).any(|x| is_seen(x, *up))).collect();
            assert!(columns[0] <= from.x + 2 && rows[0] <= from.y + 2, "{i}");
            assert!(columns.last() >= Some(&(to.x - 3)) && rows.last() >= Some(&(to.y - 3)), "{i}");
        }
        assert!(painted(&Model::default(), 48).is_none());
    }
}
