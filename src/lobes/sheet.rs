//! A lobe from open strokes only: the sheet that they span, made thick.
//!
//! Strokes stand in their order across the sheet, run the same way and have equally many samples; the sheet is ruled between
//! them. It is moved by half of [`THICK`] of its size along its normals to either side, and the rims are joined.
//!
//! Source: 001 §5.2.1 leaves out two open strokes beside each other; the paper only closes loops with them.

use super::stroke::Line;
use super::surface::Surface;
use crate::geom::principal_axes::principal_axes;
use glam::Vec3;

/// Thickness of a sheet as a share of its size.
pub(super) const THICK: f32 = 0.06;
/// Rows between two strokes.
const ROWS: usize = 6;

/// The thick sheet between at least two open strokes.
pub(super) fn sheet(strokes: &[Line]) -> Surface {
    let count = strokes.iter().map(|line| line.points.len()).max().unwrap_or(2).max(6);
    let rows = rows(strokes, count);
    let flat: Vec<Vec3> = rows.iter().flatten().copied().collect();
    let size = extent(&flat);
    let (width, height) = (count, rows.len());
    let normals = normals(&rows);
    let mut surface = Surface::default();
    for side in [0.5, -0.5] {
        surface.points.extend(flat.iter().zip(&normals).map(|(p, n)| p + n * (side * THICK * size)));
    }
    let below = flat.len() as u32;
    let at = |row: usize, k: usize| (row * width + k) as u32;
    for row in 0..height - 1 {
        for k in 0..width - 1 {
            let [a, b, c, d] = [at(row, k), at(row, k + 1), at(row + 1, k + 1), at(row + 1, k)];
            surface.triangles.extend([[a, b, c], [a, c, d]]);
            surface.triangles.extend([[a, c, b], [a, d, c]].map(|t| t.map(|i| i + below)));
        }
    }
    let mut rim: Vec<u32> = (0..width).map(|k| at(0, k)).collect();
    rim.extend((1..height).map(|row| at(row, width - 1)));
    rim.extend((0..width - 1).rev().map(|k| at(height - 1, k)));
    rim.extend((1..height - 1).rev().map(|row| at(row, 0)));
    for (i, a) in rim.iter().enumerate() {
        let b = rim[(i + 1) % rim.len()];
        surface.triangles.extend([[b, *a, a + below], [b, a + below, b + below]]);
    }
    surface
}

fn extent(points: &[Vec3]) -> f32 {
    let all = points.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(*p), h.max(*p)));
    (all.1 - all.0).max_element()
}

/// The rows of the sheet, strokes and what is ruled between them, all with equally many samples and in one sense.
fn rows(strokes: &[Line], count: usize) -> Vec<Vec<Vec3>> {
    let mut lines: Vec<Vec<Vec3>> =
        in_order(strokes).into_iter().map(|k| strokes[k].resampled(count).points).collect();
    for k in 1..lines.len() {
        let (before, line) = (&lines[k - 1], &lines[k]);
        let ends = |x: usize, y: usize| before[0].distance(line[x]) + before[count - 1].distance(line[y]);
        if ends(count - 1, 0) < ends(0, count - 1) {
            lines[k].reverse();
        }
    }
    let mut rows = vec![lines[0].clone()];
    for pair in lines.windows(2) {
        for row in 1..=ROWS {
            let share = row as f32 / ROWS as f32;
            rows.push(pair[0].iter().zip(&pair[1]).map(|(a, b)| a.lerp(*b, share)).collect());
        }
    }
    rows
}

/// Strokes by where their centroids lie along the direction in which these are spread most.
fn in_order(strokes: &[Line]) -> Vec<usize> {
    let centres: Vec<Vec3> = strokes.iter().map(Line::centroid).collect();
    let (_, [axis, ..]) = principal_axes(&centres);
    let mut order: Vec<usize> = (0..strokes.len()).collect();
    order.sort_by(|a, b| centres[*a].dot(axis).total_cmp(&centres[*b].dot(axis)));
    order
}

/// Normals of the sheet's points, by the faces around them.
fn normals(rows: &[Vec<Vec3>]) -> Vec<Vec3> {
    let (height, width) = (rows.len(), rows[0].len());
    let mut normals = Vec::with_capacity(height * width);
    for row in 0..height {
        for k in 0..width {
            let along = rows[row][(k + 1).min(width - 1)] - rows[row][k.saturating_sub(1)];
            let across = rows[(row + 1).min(height - 1)][k] - rows[row.saturating_sub(1)][k];
            normals.push(along.cross(across).normalize_or_zero());
        }
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(z: f32, reversed: bool) -> Line {
        let at = |k: u32| {
            let x = if reversed { 20 - k } else { k } as f32 * 0.1;
            Vec3::new(x, 1.0 + 0.3 * (x * 2.0).sin(), z)
        };
        Line { closed: false, points: (0..=20).map(at).collect() }
    }

    #[test]
    fn a_sheet_is_closed_and_as_thick_as_it_should_be() {
        for strokes in [
            vec![line(0.0, false), line(1.0, true)],
            vec![line(2.0, true), line(0.0, false), line(1.0, true)],
        ] {
            let surface = sheet(&strokes);
            assert_eq!(surface.check_invariants(), Ok(()));
            let area = 2.0 * f64::from(strokes.len() as u32 - 1);
            let volume = surface.signed_volume().abs();
            let expected = area * f64::from(THICK) * 2.0;
            assert!((volume / expected - 1.0).abs() < 0.15, "{volume} of {expected}");
        }
    }
}
