//! What the artist marked of a photograph, on the grid of pixels on which the plant is searched.
//!
//! A loose outline says that the plant is nowhere but within it; lines on the plant and around it say what the pixels
//! under them are. Later marks win over the outline, those on the plant over those around it. Without an outline that leaves something
//! out, the border of the picture is taken for surroundings, but for the middle of its lower side: there sky and ground are seen, while a trunk
//! may leave the picture below.

use super::super::polygon;
use super::super::raster::Raster;
use super::PlantParams;
use super::regions::widened;
use glam::{UVec2, Vec2};

/// Width of a marked line, pixels of the grid.
const LINE: f32 = 3.0;
/// How far beyond an outline colours of surroundings are learned, as a share of the longer side.
const NEAR: f32 = 0.05;
/// Share of a picture's width on both sides along which its lower edge shows surroundings.
const CORNER: f32 = 0.2;
/// Least share of a picture that an outline leaves out, so that it says something of the surroundings.
const LEFT_OUT: f32 = 0.005;

/// What an artist marked, in pixels of the photograph, x right, y down.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// A loose closed line around the plant; nothing beyond it is plant.
    pub outline: Option<Vec<Vec2>>,
    /// Lines on the plant.
    pub plant: Vec<Vec<Vec2>>,
    /// Lines on what is around it.
    pub around: Vec<Vec<Vec2>>,
}

impl Marks {
    /// Whether nothing is marked.
    pub fn is_empty(&self) -> bool {
        self.outline.is_none() && self.plant.is_empty() && self.around.is_empty()
    }
}

/// What is known of every pixel before anything is searched.
pub(super) struct Known {
    /// Whether a pixel is plant; `None` where that is not known.
    pub(super) is_plant: Raster<Option<bool>>,
    /// Whether a line on the plant or around it runs there.
    pub(super) is_marked: Raster<bool>,
    /// How many columns on both sides of the picture are its border; `None` where an outline says what is around.
    pub(super) band: Option<usize>,
    /// Whether a pixel is not far from where the plant may be: farther away, other plants have the colours of this one.
    pub(super) is_near: Raster<bool>,
    /// Whether a pixel lies beyond the outline or under a line around the plant.
    pub(super) is_outside: Vec<bool>,
}

/// The marks on a grid of which each pixel is so many of the photograph's.
pub(super) fn known(marks: &Marks, (size, factor): (UVec2, u32), params: &PlantParams) -> Known {
    let scale = 1.0 / factor as f32;
    let scaled = |line: &Vec<Vec2>| line.iter().map(|p| *p * scale).collect::<Vec<Vec2>>();
    let outline = marks.outline.as_ref().map(|outline| polygon::filled(&scaled(outline), size));
    let count = |within: &Raster<bool>| within.cells().iter().filter(|is_in| !**is_in).count() as f32;
    let outline = outline.filter(|within| count(within) >= LEFT_OUT * within.cells().len() as f32);
    let (mut is_plant, is_near) = match &outline {
        Some(within) => {
            let reach = (NEAR * size.max_element() as f32).ceil() as usize;
            (within.map(|is_in| (!is_in).then_some(false)), widened(within, reach))
        }
        None => (border(size, params.border), Raster::filled(size, true)),
    };
    let mut is_outside: Vec<bool> = match &outline {
        Some(within) => within.cells().iter().map(|is_in| !is_in).collect(),
        None => vec![false; is_near.cells().len()],
    };
    let mut is_marked = Raster::filled(size, false);
    for (lines, label) in [(&marks.around, false), (&marks.plant, true)] {
        for line in lines {
            for pixel in under(&scaled(line), size) {
                is_plant.cells_mut()[pixel] = Some(label);
                is_marked.cells_mut()[pixel] = true;
                is_outside[pixel] = !label;
            }
        }
    }
    let band = outline.is_none().then(|| band(size, params.border) as usize);
    Known { is_plant, is_marked, band, is_near, is_outside }
}

/// Width of the border, pixels.
fn band(size: UVec2, share: f32) -> u32 {
    ((share * size.min_element() as f32).round() as u32).max(1)
}

/// The border as surroundings.
fn border(size: UVec2, share: f32) -> Raster<Option<bool>> {
    let band = band(size, share);
    let mut known = Raster::filled(size, None);
    let width = size.x as usize;
    for (i, cell) in known.cells_mut().iter_mut().enumerate() {
        let (x, y) = ((i % width) as u32, (i / width) as u32);
        let is_below = y + band >= size.y && x.min(size.x - 1 - x) as f32 <= CORNER * size.x as f32;
        if y < band || x < band || x + band >= size.x || is_below {
            *cell = Some(false);
        }
    }
    known
}

/// Pixels under a line, each once and in order; of what lies beside the picture none.
fn under(line: &[Vec2], size: UVec2) -> Vec<usize> {
    let limit = size.as_vec2();
    let mut pixels = Vec::new();
    let mut dab = |at: Vec2| {
        let reach = 0.5 * LINE;
        let low = (at - reach).clamp(Vec2::ZERO, limit).as_uvec2();
        let high = (at + reach).ceil().clamp(Vec2::ZERO, limit).as_uvec2();
        for y in low.y..high.y {
            for x in low.x..high.x {
                if (Vec2::new(x as f32, y as f32) + 0.5).distance(at) <= reach {
                    pixels.push((y * size.x + x) as usize);
                }
            }
        }
    };
    // Marks may be given far beside the picture; a step for each pixel is then too many.
    let far = 4.0 * limit.max_element();
    let near = |p: &Vec2| p.clamp(Vec2::splat(-far), Vec2::splat(2.0 * far));
    if let Some(first) = line.first() {
        dab(near(first));
    }
    for (a, b) in line.iter().zip(line.iter().skip(1)) {
        let (a, b) = (near(a), near(b));
        let steps = a.distance(b).ceil().max(1.0) as u32;
        (1..=steps).for_each(|k| dab(a.lerp(b, k as f32 / steps as f32)));
    }
    pixels.sort_unstable();
    pixels.dedup();
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(known: &Known) -> Vec<String> {
        let letter = |cell: &Option<bool>| cell.map_or('?', |is_plant| if is_plant { 'P' } else { '.' });
        let cells = known.is_plant.cells();
        cells.chunks(known.is_plant.width()).map(|row| row.iter().map(letter).collect()).collect()
    }

    #[test]
    fn without_an_outline_the_border_is_surroundings_but_for_the_lower_side() {
        let at = (UVec2::new(6, 4), 1);
        let known_of = |marks: &Marks| text(&known(marks, at, &PlantParams::default()));
        assert_eq!(known_of(&Marks::default()), ["......", ".????.", ".????.", "..??.."]);
        // An outline around all of it leaves nothing out.
        let all = [(-9.0, -9.0), (20.0, -9.0), (20.0, 20.0), (-9.0, 20.0)].map(Vec2::from).to_vec();
        let marks = Marks { outline: Some(all), ..Marks::default() };
        assert_eq!(known_of(&marks), known_of(&Marks::default()));
    }

    #[test]
    fn lines_say_what_is_under_them_and_the_plant_wins() {
        let line = |a: (f32, f32), b: (f32, f32)| vec![Vec2::from(a) * 2.0, Vec2::from(b) * 2.0];
        let square = [(2.0, 2.0), (20.0, 2.0), (20.0, 20.0), (2.0, 20.0)].map(Vec2::from).to_vec();
        let marks = Marks {
            outline: Some(square),
            plant: vec![line((4.5, -50.0), (4.5, 2.5))],
            around: vec![line((0.0, 8.5), (9.0, 8.5)), line((4.5, 2.5), (4.5, 2.5)), Vec::new()],
        };
        let known = known(&marks, (UVec2::new(10, 10), 2), &PlantParams::default());
        let rows = text(&known);
        assert_eq!((&rows[0][..], &rows[2][..], &rows[8][..]), ("...PPP....", ".??PPP????", ".........."));
        assert!(known.is_marked[(4, 1)] && !known.is_marked[(0, 1)]);
    }
}
