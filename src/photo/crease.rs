//! Creases of a petal: found, and painted over.
//!
//! A crease is a straight line of another lightness, long against the petal and thin. Thin things stand out in the difference
//! between lightness and its morphological closing (dark lines) or opening (light ones) by a square that is wider than they
//! are; connected ones among them that are long enough, thin enough and straight are creases. Veins are many and curved:
//! what does not stand out from the usual line on this petal stays. A crease is filled from its rim inward, ring by ring,
//! each pixel with the mean of its known neighbours, and smoothed.
//!
//! Limits: a single straight vein with as much contrast as a crease is taken for one; for leaves, whose midribs are that,
//! this stage is left out unless it is asked for.

use super::background::quantile;
use super::lab::Lab;
use super::mask::labelled;
use super::raster::Raster;
use super::windows::window_max;
use glam::Vec2;

/// How far a line must stand out from what is usual on the petal: a multiple of what so large a share of it does not exceed.
/// Creases cover less than the rest of it, veins more.
const UNUSUAL: (f32, f32) = (2.0, 0.92);
/// Share of the line's width by which it is painted over beyond what was found.
const WIDER: f32 = 0.12;
/// Times that what was painted over is smoothed.
const SMOOTHINGS: usize = 12;

/// What a crease is.
#[derive(Clone, Copy, Debug)]
pub(super) struct CreaseSize {
    /// Least length, pixels.
    pub(super) length: f32,
    /// Greatest width, pixels.
    pub(super) width: f32,
    /// Least difference of lightness.
    pub(super) depth: f32,
}

/// Paints creases over, where `trusted` says what belongs to the petal; gives their number.
pub(super) fn remove(lab: &mut Raster<Lab>, trusted: &Raster<bool>, size: CreaseSize) -> usize {
    let reach = (0.5 * size.width).ceil().max(1.0) as usize;
    let lightness = lab.map(|colour| colour.x);
    let stands_out = thin_lines(&lightness, trusted, reach);
    let inside = stands_out.cells().iter().zip(trusted.cells()).filter(|(_, is_in)| **is_in);
    let usual = quantile(inside.map(|(out, _)| *out).collect(), UNUSUAL.1);
    let least = size.depth.max(UNUSUAL.0 * usual);
    let lines = stands_out.map(|out| *out > least);
    let (labels, areas) = labelled(&lines, 8);
    let creases = straight_ones(&labels, &areas, size);
    let count = creases.iter().filter(|is_crease| **is_crease).count();
    if count > 0 {
        let found = labels.map(|label| *label > 0 && creases[*label as usize - 1]);
        let wider = grown(&found, (WIDER * size.width).ceil().max(1.0) as usize);
        paint_over(lab, &wider, trusted);
    }
    count
}

/// How much every pixel differs from its surroundings as part of something thinner than the square.
fn thin_lines(lightness: &Raster<f32>, trusted: &Raster<bool>, reach: usize) -> Raster<f32> {
    let masked = |other: f32| {
        let cells = lightness.cells().iter().zip(trusted.cells());
        Raster::new(lightness.width(), cells.map(|(l, is_in)| if *is_in { *l } else { other }).collect())
    };
    let negative = |raster: &Raster<f32>| raster.map(|v| -v);
    // What lies outside neither hides nor makes a line.
    let only_inside = |raster: Raster<f32>, other: f32| {
        let cells = raster.cells().iter().zip(trusted.cells());
        Raster::new(raster.width(), cells.map(|(v, is_in)| if *is_in { *v } else { other }).collect())
    };
    let closing = |raster: &Raster<f32>| {
        let dilated = only_inside(window_max(raster, reach), f32::INFINITY);
        negative(&window_max(&negative(&dilated), reach))
    };
    let dark = closing(&masked(f32::NEG_INFINITY));
    let light = negative(&closing(&negative(&masked(f32::INFINITY))));
    let cells = (0..lightness.cells().len()).map(|i| {
        let l = lightness.cells()[i];
        let out = (dark.cells()[i] - l).max(l - light.cells()[i]);
        if trusted.cells()[i] && out.is_finite() { out } else { 0.0 }
    });
    Raster::new(lightness.width(), cells.collect())
}

/// Sums over the pixels of a region.
#[derive(Clone, Copy, Default)]
struct Moments {
    count: f64,
    sum: [f64; 2],
    squares: [f64; 3],
}

/// Which regions are long, thin and straight.
fn straight_ones(labels: &Raster<u32>, areas: &[usize], size: CreaseSize) -> Vec<bool> {
    let mut moments = vec![Moments::default(); areas.len()];
    let numbered = || labels.cells().iter().enumerate().filter(|(_, label)| **label > 0);
    for (i, label) in numbered() {
        let [x, y] = labels.middle(i).to_array().map(f64::from);
        let of = &mut moments[*label as usize - 1];
        of.count += 1.0;
        of.sum = [of.sum[0] + x, of.sum[1] + y];
        of.squares = [of.squares[0] + x * x, of.squares[1] + x * y, of.squares[2] + y * y];
    }
    let axes: Vec<(Vec2, Vec2, f32)> = moments.iter().map(axis).collect();
    let mut reaches = vec![(f32::INFINITY, f32::NEG_INFINITY); areas.len()];
    for (i, label) in numbered() {
        let region = *label as usize - 1;
        let (middle, along, _) = axes[region];
        let place = (labels.middle(i) - middle).dot(along);
        let (low, high) = reaches[region];
        reaches[region] = (low.min(place), high.max(place));
    }
    let is_crease = |region: usize| {
        let length = reaches[region].1 - reaches[region].0 + 1.0;
        let width = areas[region] as f32 / length;
        length >= size.length && width <= size.width && axes[region].2 <= 0.5 * size.width
    };
    (0..areas.len()).map(is_crease).collect()
}

/// Middle and direction of a region, and how far its pixels are from that line, root mean square.
fn axis(of: &Moments) -> (Vec2, Vec2, f32) {
    let middle = of.sum.map(|sum| sum / of.count);
    let xx = of.squares[0] / of.count - middle[0] * middle[0];
    let xy = of.squares[1] / of.count - middle[0] * middle[1];
    let yy = of.squares[2] / of.count - middle[1] * middle[1];
    let spread = (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    let turn = 0.5 * (2.0 * xy).atan2(xx - yy);
    let least = (0.5 * (xx + yy) - spread).max(0.0);
    (Vec2::from(middle.map(|c| c as f32)), Vec2::from_angle(turn as f32), least.sqrt() as f32)
}

/// The region and all that is so near to it.
fn grown(is_in: &Raster<bool>, by: usize) -> Raster<bool> {
    window_max(&is_in.map(|is_in| f32::from(u8::from(*is_in))), by).map(|v| *v > 0.5)
}

/// Fills what is to be painted over from what is around it.
fn paint_over(lab: &mut Raster<Lab>, over: &Raster<bool>, trusted: &Raster<bool>) {
    let mut known: Vec<bool> =
        over.cells().iter().zip(trusted.cells()).map(|(over, is_in)| *is_in && !over).collect();
    let all: Vec<usize> = (0..known.len()).filter(|i| over.cells()[*i] && trusted.cells()[*i]).collect();
    let mut open = all.clone();
    while !open.is_empty() {
        let mean = |i: usize| {
            let near = lab.neighbours(i, 8).filter(|n| known[*n]);
            let (sum, count) = near.fold((Lab::ZERO, 0.0), |(sum, n), k| (sum + lab.cells()[k], n + 1.0));
            (count > 0.0).then(|| sum / count)
        };
        let ring: Vec<(usize, Lab)> = open.iter().filter_map(|i| Some((*i, mean(*i)?))).collect();
        if ring.is_empty() {
            return;
        }
        for (i, colour) in ring {
            lab.cells_mut()[i] = colour;
            known[i] = true;
        }
        open.retain(|i| !known[*i]);
    }
    for _ in 0..SMOOTHINGS {
        let mean = |i: usize| {
            let near = lab.neighbours(i, 4).filter(|n| known[*n]);
            let (sum, count) =
                near.fold((lab.cells()[i], 1.0), |(sum, n), k| (sum + lab.cells()[k], n + 1.0));
            sum / count
        };
        let smoothed: Vec<Lab> = all.iter().map(|i| mean(*i)).collect();
        all.iter().zip(smoothed).for_each(|(i, colour)| lab.cells_mut()[*i] = colour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, Vec3};

    const SIZE: CreaseSize = CreaseSize { length: 30.0, width: 4.0, depth: 4.0 };

    /// A petal that grows lighter upward, with lines of another lightness: from, to, half width, how much lighter.
    fn petal(lines: &[(Vec2, Vec2, f32, f32)]) -> Raster<Lab> {
        let mut lab = Raster::filled(UVec2::splat(200), Vec3::ZERO);
        for i in 0..lab.cells().len() {
            let at = lab.middle(i);
            let mut colour = Vec3::new(70.0 - 0.1 * at.y, 30.0, 0.0);
            for (from, to, half, by) in lines {
                let along = *to - *from;
                let share = ((at - *from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                if at.distance(*from + along * share) < *half {
                    colour.x += by;
                }
            }
            lab.cells_mut()[i] = colour;
        }
        lab
    }

    fn worst(a: &Raster<Lab>, b: &Raster<Lab>) -> f32 {
        a.cells().iter().zip(b.cells()).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
    }

    #[test]
    fn creases_go_dark_and_light_ones() {
        let (a, b) = (Vec2::new(60.0, 50.0), Vec2::new(130.0, 140.0));
        for by in [-18.0, 15.0] {
            let mut lab = petal(&[(a, b, 1.4, by)]);
            let all = lab.map(|_| true);
            assert_eq!(remove(&mut lab, &all, SIZE), 1);
            assert!(worst(&lab, &petal(&[])) < 2.5, "{}", worst(&lab, &petal(&[])));
        }
    }

    #[test]
    fn what_is_short_or_broad_or_bent_or_one_of_many_stays() {
        let line = |x: f32, from: f32, to: f32| (Vec2::new(x, from), Vec2::new(x, to), 1.4, -15.0);
        let short = vec![line(100.0, 90.0, 110.0)];
        let broad = vec![(Vec2::new(100.0, 50.0), Vec2::new(100.0, 150.0), 6.0, -15.0)];
        let bent = (0..12).map(|k| Vec2::new(100.0, 100.0) + 40.0 * Vec2::from_angle(0.25 * k as f32));
        let bent: Vec<Vec2> = bent.collect();
        let bent: Vec<_> = bent.windows(2).map(|w| (w[0], w[1], 1.4, -15.0)).collect();
        let many: Vec<_> = (0..24).map(|k| line(10.0 + 7.0 * k as f32, 20.0, 180.0)).collect();
        for lines in [short, broad, bent, many] {
            let mut lab = petal(&lines);
            let all = lab.map(|_| true);
            assert_eq!(remove(&mut lab, &all, SIZE), 0, "{} lines", lines.len());
            assert_eq!(lab, petal(&lines));
        }
    }

    #[test]
    fn lines_beside_the_petal_and_its_edge_are_none() {
        let mut lab = petal(&[(Vec2::new(30.0, 10.0), Vec2::new(30.0, 190.0), 1.4, -30.0)]);
        let mut trusted = lab.map(|_| false);
        for i in 0..trusted.cells().len() {
            trusted.cells_mut()[i] = trusted.middle(i).distance(Vec2::splat(110.0)) < 70.0;
        }
        assert_eq!(remove(&mut lab, &trusted, SIZE), 0);
    }
}
