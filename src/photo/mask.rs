//! Which pixels are the petal: the connected region with the most in it, its holes filled.

use super::raster::Raster;

/// The largest region, and how many come near it.
pub(super) struct Largest {
    /// Whether a pixel belongs to it.
    pub(super) mask: Raster<bool>,
    /// Pixels in it, holes included.
    pub(super) area: usize,
    /// Regions of at least [`COMPARABLE`] of its size, itself among them.
    pub(super) count: usize,
}

/// Share of the largest region's area from which another one is a thing of its own and no speck.
const COMPARABLE: f32 = 0.2;

/// The region, of pixels that share an edge, which has the most pixels of `core` in it; `None` where none has any.
pub(super) fn largest_region(is_in: &Raster<bool>, core: &Raster<bool>) -> Option<Largest> {
    let (labels, areas) = labelled(is_in, 4);
    let mut areas = vec![0usize; areas.len()];
    let cores = labels.cells().iter().zip(core.cells()).filter(|(label, is_core)| **label > 0 && **is_core);
    cores.for_each(|(label, _)| areas[*label as usize - 1] += 1);
    // The first of equally large ones.
    let best = areas.iter().enumerate().rev().max_by_key(|(_, area)| **area);
    let (best, most) = best.filter(|(_, most)| **most > 0)?;
    let count = areas.iter().filter(|area| **area as f32 >= COMPARABLE * *most as f32).count();
    let mask = filled(&labels.map(|label| *label == best as u32 + 1));
    let area = mask.cells().iter().filter(|is_in| **is_in).count();
    Some(Largest { mask, area, count })
}

/// Numbers regions from 1, in the order of their first pixels; 0 is outside. Also their areas. Neighbours are 4 or 8.
pub(super) fn labelled(is_in: &Raster<bool>, neighbours: usize) -> (Raster<u32>, Vec<usize>) {
    let mut labels = Raster::filled(is_in.size(), 0u32);
    let (mut areas, mut open) = (Vec::new(), Vec::new());
    for start in 0..is_in.cells().len() {
        if !is_in.cells()[start] || labels.cells()[start] != 0 {
            continue;
        }
        let label = areas.len() as u32 + 1;
        labels.cells_mut()[start] = label;
        open.push(start);
        let mut area = 0;
        while let Some(pixel) = open.pop() {
            area += 1;
            for next in is_in.neighbours(pixel, neighbours) {
                if is_in.cells()[next] && labels.cells()[next] == 0 {
                    labels.cells_mut()[next] = label;
                    open.push(next);
                }
            }
        }
        areas.push(area);
    }
    (labels, areas)
}

/// The region with what it encloses: all that the picture's edge does not reach without crossing it.
fn filled(mask: &Raster<bool>) -> Raster<bool> {
    let (width, height) = (mask.width(), mask.height());
    let mut outside = mask.map(|_| false);
    let edge = (0..width).flat_map(|x| [x, (height - 1) * width + x]);
    let edge = edge.chain((0..height).flat_map(|y| [y * width, y * width + width - 1]));
    let mut open: Vec<usize> = Vec::new();
    let mut reach = |pixel: usize, open: &mut Vec<usize>| {
        if !mask.cells()[pixel] && !std::mem::replace(&mut outside.cells_mut()[pixel], true) {
            open.push(pixel);
        }
    };
    edge.for_each(|pixel| reach(pixel, &mut open));
    while let Some(pixel) = open.pop() {
        mask.neighbours(pixel, 8).for_each(|next| reach(next, &mut open));
    }
    outside.map(|is_outside| !is_outside)
}

/// Share of a region's outermost pixels that lie on the edge of the picture.
pub(super) fn share_on_edge(mask: &Raster<bool>) -> f32 {
    let (width, height) = (mask.width(), mask.height());
    let (mut rim, mut on_edge) = (0u32, 0u32);
    for pixel in (0..mask.cells().len()).filter(|pixel| mask.cells()[*pixel]) {
        let (x, y) = (pixel % width, pixel / width);
        let is_on_edge = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
        let is_rim = is_on_edge || mask.neighbours(pixel, 4).any(|next| !mask.cells()[next]);
        rim += u32::from(is_rim);
        on_edge += u32::from(is_on_edge);
    }
    on_edge as f32 / rim.max(1) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(rows: &[&str]) -> Raster<bool> {
        Raster::new(rows[0].len(), rows.iter().flat_map(|row| row.bytes().map(|c| c == b'#')).collect())
    }

    #[test]
    fn the_largest_is_taken_with_its_holes() {
        let rows = ["##..####", "##..#..#", "....#.##", ".#..###."];
        let found = largest_region(&mask(&rows), &mask(&rows)).unwrap();
        assert_eq!(found.mask, mask(&["....####", "....####", "....####", "....###."]));
        assert_eq!((found.area, found.count), (15, 2));
        let none = mask(&["...", "..."]);
        assert!(
            largest_region(&none, &none).is_none() && largest_region(&mask(&["##.", "..."]), &none).is_none()
        );
    }

    #[test]
    fn what_is_pale_goes_with_the_core_that_it_hangs_on() {
        let (pale, core) = (
            mask(&["####.##", "###..##", ".......", "#######"]),
            mask(&["###....", "##....#", ".......", "......."]),
        );
        let found = largest_region(&pale, &core).unwrap();
        assert_eq!(found.mask, mask(&["####...", "###....", ".......", "......."]));
        assert_eq!((found.area, found.count), (7, 2));
    }

    #[test]
    fn a_gap_across_a_corner_is_no_way_out_and_no_way_in() {
        let ring = mask(&["###.", "#.#.", "##.#", "...."]);
        let found = largest_region(&ring, &ring).unwrap();
        assert_eq!(found.mask, mask(&["###.", "#.#.", "##..", "...."]));
    }

    #[test]
    fn what_lies_on_the_edge_is_counted() {
        assert_eq!(share_on_edge(&mask(&["....", ".##.", ".##.", "...."])), 0.0);
        assert_eq!(share_on_edge(&mask(&["...", "###", "..."])), 2.0 / 3.0);
    }
}
