//! The plant among all that has its colours: pieces that lie together, the one that is meant, and holes that are none.
//!
//! Foliage falls into pieces; what lies within a small distance belongs together. Of several plants the marked ones are taken, or else
//! the largest. Specks are left out, gaps smaller than a leaf are filled.

use super::super::coverage::shrunk;
use super::super::mask::labelled;
use super::super::raster::Raster;
use super::PlantParams;

/// How far pieces of one plant lie apart, as a share of the longer side.
const GAP: f32 = 0.008;
/// Share of the plant's area below which a piece is a speck.
const SPECK: f32 = 0.001;
/// Share of the largest plant's area from which another one is counted.
const COMPARABLE: f32 = 0.25;

/// A plant among others.
pub(super) struct Chosen {
    /// Whether a pixel belongs to it.
    pub(super) mask: Raster<bool>,
    /// Plants of comparable size, itself among them.
    pub(super) count: usize,
    /// Whether marks chose it.
    pub(super) is_marked: bool,
}

/// The plant that is meant; `None` where there is none.
pub(super) fn chosen(
    found: &Raster<bool>,
    is_marked: impl Fn(usize) -> bool,
    params: &PlantParams,
) -> Option<Chosen> {
    let reach = (GAP * found.size().max_element() as f32).round().max(1.0) as usize;
    let (labels, groups) = labelled(&widened(found, reach), 8);
    let (mut areas, mut marked) = (vec![0usize; groups.len()], vec![false; groups.len()]);
    for i in (0..found.cells().len()).filter(|i| found.cells()[*i]) {
        let group = labels.cells()[i] as usize - 1;
        areas[group] += 1;
        marked[group] |= is_marked(i);
    }
    let any_marked = marked.contains(&true);
    // The first of equally large ones.
    let largest =
        (0..areas.len()).rev().max_by_key(|group| areas[*group]).filter(|group| areas[*group] > 0)?;
    let is_meant = |group: usize| if any_marked { marked[group] } else { group == largest };
    let count = areas.iter().filter(|area| **area as f32 >= COMPARABLE * areas[largest] as f32).count();
    let mut mask = found.map(|is_in| *is_in);
    for (cell, label) in mask.cells_mut().iter_mut().zip(labels.cells()) {
        *cell &= *label > 0 && is_meant(*label as usize - 1);
    }
    let area = mask.cells().iter().filter(|is_in| **is_in).count() as f32;
    drop_small(&mut mask, true, SPECK * area);
    drop_small(&mut mask, false, params.hole * area);
    Some(Chosen { mask, count, is_marked: any_marked })
}

/// Turns pieces of `side` smaller than that into the other side; open ground, which reaches the edge, stays.
fn drop_small(mask: &mut Raster<bool>, side: bool, least: f32) {
    let (labels, areas) = labelled(&mask.map(|is_in| *is_in == side), if side { 8 } else { 4 });
    let (width, height) = (mask.width(), mask.height());
    let mut stays: Vec<bool> = areas.iter().map(|area| *area as f32 >= least).collect();
    if !side {
        for (i, label) in labels.cells().iter().enumerate().filter(|(_, label)| **label > 0) {
            let (x, y) = (i % width, i / width);
            stays[*label as usize - 1] |= x == 0 || y == 0 || x + 1 == width || y + 1 == height;
        }
    }
    for (cell, label) in mask.cells_mut().iter_mut().zip(labels.cells()) {
        if *label > 0 && !stays[*label as usize - 1] {
            *cell = !side;
        }
    }
}

/// All pixels within a square of half side `reach` around one that is in.
pub(super) fn widened(mask: &Raster<bool>, reach: usize) -> Raster<bool> {
    narrowed(&mask.map(|is_in| !is_in), reach).map(|is_in| !is_in)
}

/// All pixels of which the whole square around them, as far as it lies in the picture, is in.
pub(super) fn narrowed(mask: &Raster<bool>, reach: usize) -> Raster<bool> {
    shrunk(mask, reach)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(rows: &[&str]) -> Raster<bool> {
        Raster::new(rows[0].len(), rows.iter().flat_map(|row| row.bytes().map(|c| c == b'#')).collect())
    }

    fn text(mask: &Raster<bool>) -> Vec<String> {
        let row = |row: &[bool]| row.iter().map(|is_in| if *is_in { '#' } else { '.' }).collect();
        mask.cells().chunks(mask.width()).map(row).collect()
    }

    #[test]
    fn the_largest_is_taken_or_the_marked_one_and_its_small_holes_are_filled() {
        let found = mask(&["####....##", "#.##....##", "####....##", "##.#......"]);
        let params = PlantParams { hole: 0.1, ..PlantParams::default() };
        let largest = chosen(&found, |_| false, &params).unwrap();
        assert_eq!(text(&largest.mask), ["####......", "####......", "####......", "##.#......"]);
        assert_eq!((largest.count, largest.is_marked), (2, false));
        let marked = chosen(&found, |i| i == 9, &params).unwrap();
        assert_eq!(text(&marked.mask), ["........##", "........##", "........##", ".........."]);
        assert!(marked.is_marked && chosen(&mask(&["..."]), |_| true, &params).is_none());
    }

    #[test]
    fn masks_grow_and_shrink_by_squares() {
        let dot = mask(&["......", "..#...", "......", "......"]);
        assert_eq!(text(&widened(&dot, 1)), [".###..", ".###..", ".###..", "......"]);
        assert_eq!(
            text(&narrowed(&widened(&dot, 1), 1)),
            text(&mask(&["..#...", "..#...", "......", "......"]))
        );
    }
}
