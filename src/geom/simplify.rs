//! Douglas–Peucker: which points of a chain carry its shape.
//!
//! The farthest point from the chord of a span is kept while it stands out, then both halves are searched. The caller
//! measures, so the same search serves outlines in the plane and skeletons with radii, each with its own tolerance.
//!
//! Limits: a chain that was simple may cross itself afterwards, by less than the tolerance.
//! Source: Douglas and Peucker, *Algorithms for the reduction of the number of points…*, Cartographica 10(2), 1973.

/// Marks the points of the open chain `first..=last` that must stay; ends are always marked.
///
/// `chord(a, b)` gives the measure for the span from point `a` to point `b`: how far a point of the chain stands out,
/// as a multiple of the tolerance or the square of that; anything above 1 is kept. `pending` is scratch space.
pub fn mark<Measure: Fn(usize) -> f32>(
    (first, last): (usize, usize),
    kept: &mut [bool],
    pending: &mut Vec<(usize, usize)>,
    chord: impl Fn(usize, usize) -> Measure,
) {
    kept[first] = true;
    kept[last] = true;
    pending.clear();
    pending.push((first, last));
    while let Some((a, b)) = pending.pop() {
        if b <= a + 1 {
            continue;
        }
        let measure = chord(a, b);
        let mut farthest = (1.0, a);
        for i in a + 1..b {
            let out = measure(i);
            if out > farthest.0 {
                farthest = (out, i);
            }
        }
        if farthest.1 > a {
            kept[farthest.1] = true;
            pending.push((a, farthest.1));
            pending.push((farthest.1, b));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn simplified(points: &[Vec2], tolerance: f32) -> Vec<usize> {
        let mut kept = vec![false; points.len()];
        mark((0, points.len() - 1), &mut kept, &mut Vec::new(), |a, b| {
            let along = (points[b] - points[a]).normalize();
            move |i| (points[i] - points[a]).perp_dot(along).abs() / tolerance
        });
        (0..points.len()).filter(|&i| kept[i]).collect()
    }

    #[test]
    fn a_straight_run_keeps_its_ends() {
        let line: Vec<Vec2> = (0..10).map(|k| Vec2::new(k as f32, 0.0)).collect();
        assert_eq!(simplified(&line, 0.1), [0, 9]);
    }

    #[test]
    fn corners_stay_and_small_wobble_goes() {
        let hook = [(0.0, 0.0), (1.0, 0.05), (2.0, 0.0), (2.0, 1.0), (2.05, 2.0), (2.0, 3.0)];
        let hook = hook.map(Vec2::from);
        assert_eq!(simplified(&hook, 0.1), [0, 2, 5]);
        assert_eq!(simplified(&hook, 0.03), [0, 1, 2, 4, 5]);
    }
}
