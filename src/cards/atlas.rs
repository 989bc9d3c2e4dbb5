//! The pictures of a plant's shoots in one: a column for each, the wide side in the upper row and the narrow one in the lower. Each stands
//! in the left lower corner of its square.
//!
//! What nothing covers has the mean colour, so that smaller copies of the picture have no dark margins. Shoots that are painted are
//! kept from one build to the next by everything of theirs, and so is the file of the picture, by the shoots in it.

use super::clusters::Cluster;
use super::frame::{Frame, Side};
use super::picture::{Cell, Drawing, Painted};
use super::surfaces::{Look, Surfaces};
use crate::kept::{Kept, Same, Use};
use crate::model::PlantRecipe;
use crate::picture::{Picture, decode::Rgba};
use crate::plant::{FinishedPlant, Shape};
use crate::srgb::srgb_from_linear;
use glam::{Vec2, Vec3, Vec4};
use rayon::prelude::*;
use std::sync::Arc;

/// What is painted, kept from one build to the next.
#[derive(Debug)]
pub struct Cache {
    /// None where a build was given up.
    shoots: Kept<ShootKey, Option<Arc<Painted>>>,
    pictures: Kept<Vec<Same<Painted>>, Option<Picture>>,
}

impl Default for Cache {
    fn default() -> Self {
        Self { shoots: Kept::default().of_large_things(), pictures: Kept::default() }
    }
}

impl Cache {
    /// A cache for a single build.
    pub fn for_one_build() -> Self {
        Self { shoots: Kept::for_one_call().of_large_things(), pictures: Kept::for_one_call() }
    }

    /// Forgets all that is kept.
    pub fn clear(&mut self) {
        self.shoots.keep_only(|_| false);
        self.pictures.keep_only(|_| false);
    }

    /// How many shoots are kept.
    pub fn len(&self) -> usize {
        self.shoots.len()
    }

    /// Whether none are kept.
    pub fn is_empty(&self) -> bool {
        self.shoots.is_empty()
    }
}

/// All that decides how a shoot is painted.
#[derive(Debug, PartialEq, Eq, Hash)]
struct ShootKey {
    surface: PlantRecipe,
    looks: Vec<Look>,
    frame: [u32; 18],
    pixels: u32,
    share: u32,
}

/// The pictures of shoots in one.
pub(super) struct Atlas {
    pub(super) picture: Picture,
    /// The shoots that were drawn.
    painted: Vec<Arc<Painted>>,
    /// Width and height of the square of each.
    pixels: u32,
}

impl Atlas {
    /// Draws some of the clusters. None where nothing of them is seen, and once `stop` says yes.
    pub(super) fn draw(
        cache: &mut Cache,
        (surfaces, drawing): (&Surfaces<'_>, Drawing),
        (framed, shown): (&[(Cluster, Frame)], &[usize]),
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let shoot = |&shown: &usize| {
            let (cluster, frame) = &framed[shown];
            (surfaces.excerpt(cluster), *frame)
        };
        let shoots: Vec<(FinishedPlant, Frame)> = shown.par_iter().map(shoot).collect();
        let key = |(excerpt, frame): &(FinishedPlant, Frame), _| ShootKey {
            surface: PlantRecipe::of(excerpt),
            looks: surfaces.looks().to_vec(),
            frame: frame.bits(),
            pixels: drawing.pixels,
            share: drawing.share.to_bits(),
        };
        let paint = |(excerpt, frame): &(FinishedPlant, Frame)| {
            Painted::new(surfaces, (excerpt, frame), drawing, stop).map(Arc::new)
        };
        let painted = cache.shoots.made_where(&shoots, key, |_, painted| painted.is_some(), paint);
        let painted: Vec<Arc<Painted>> = painted.iter().cloned().collect::<Option<_>>()?;
        let same = |painted: &Vec<Arc<Painted>>, used: Use| {
            painted.iter().map(|painted| Same::of(painted, used)).collect()
        };
        let file = |painted: &Vec<Arc<Painted>>| {
            let row = |side: usize| painted.iter().map(move |painted| &painted.cells[side]);
            let cells: Vec<&Cell> = row(0).chain(row(1)).collect();
            Picture::new(grid(&cells, painted.len(), drawing.pixels as usize)?.to_png().ok()?).ok()
        };
        let picture = cache.pictures.made(std::slice::from_ref(&painted), same, file).first();
        Some(Self { picture: picture.cloned().flatten()?, painted, pixels: drawing.pixels })
    }

    /// The card of a cluster from a side, with the picture of a shoot.
    pub(super) fn card(&self, frame: &Frame, shoot: usize, side: Side) -> Shape {
        let (base, u, v) = frame.of_shape(&self.painted[shoot].frame).card(side);
        Shape::Card { base, u, v, window: self.window(shoot, side), is_whole: frame.is_whole() }
    }

    /// The part of the picture that shows a shoot from a side.
    fn window(&self, shoot: usize, side: Side) -> [Vec2; 2] {
        let (columns, row) = (self.painted.len() as f32, usize::from(side == Side::Narrow));
        let low = Vec2::new(shoot as f32 / columns, if side == Side::Wide { 0.5 } else { 0.0 });
        let share = self.painted[shoot].cells[row].size.as_vec2() / self.pixels as f32;
        [low, low + share * Vec2::new(1.0 / columns, 0.5)]
    }
}

/// The cells in rows from the top, so many in each, every one in the left lower corner of a square of this side; `None` if all are
/// empty.
pub(super) fn grid(cells: &[&Cell], columns: usize, side: usize) -> Option<Rgba> {
    let all = || cells.iter().flat_map(|cell| &cell.pixels);
    let weight: f32 = all().map(|pixel| pixel.w).sum();
    if weight <= 0.0 {
        return None;
    }
    let mean = encoded(all().map(|pixel| pixel.truncate() * pixel.w).sum::<Vec3>() / weight);
    let (width, height) = (side * columns, side * cells.len().div_ceil(columns));
    let pixel = |i: usize| {
        let (x, y) = (i % width, i / width);
        // From the left lower corner.
        let (right, up) = (x % side, side - 1 - y % side);
        let cell = cells.get(y / side * columns + x / side);
        let there = cell.filter(|cell| right < cell.size.x && up < cell.size.y);
        let pixel =
            there.map_or(Vec4::ZERO, |cell| cell.pixels[(cell.size.y - 1 - up) * cell.size.x + right]);
        let [r, g, b] = if pixel.w > 0.0 { encoded(pixel.truncate()) } else { mean };
        [r, g, b, (255.0 * pixel.w).round() as u8]
    };
    let pixels = (0..width * height).into_par_iter().with_min_len(1 << 12).flat_map_iter(pixel).collect();
    Some(Rgba { width: width as u32, height: height as u32, pixels })
}

fn encoded(colour: Vec3) -> [u8; 3] {
    colour.to_array().map(|c| (255.0 * srgb_from_linear(c.clamp(0.0, 1.0))).round() as u8)
}
