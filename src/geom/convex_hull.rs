//! Convex hull of anything with a position, by Andrew's monotone chain in O(n log n).

use glam::Vec2;

/// The corners of the hull, counter-clockwise with y up, no three on a line. Fewer than three points have no inside
/// and come back as they are.
pub fn convex_hull<T: Clone>(points: &[T], position: impl Fn(&T) -> Vec2) -> Vec<T> {
    let mut sorted: Vec<&T> = points.iter().collect();
    let key = |p: &T| (position(p).x, position(p).y);
    sorted.sort_by(|a, b| key(a).0.total_cmp(&key(b).0).then(key(a).1.total_cmp(&key(b).1)));
    sorted.dedup_by(|a, b| position(a) == position(b));
    if sorted.len() < 3 {
        return sorted.into_iter().cloned().collect();
    }
    let half = |chain: &mut dyn Iterator<Item = &&T>| {
        let mut hull: Vec<T> = Vec::new();
        for &point in chain {
            while let [.., a, b] = hull.as_slice() {
                let (a, b) = (position(a), position(b));
                if (b - a).perp_dot(position(point) - b) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(point.clone());
        }
        hull.pop();
        hull
    };
    let mut hull = half(&mut sorted.iter());
    hull.extend(half(&mut sorted.iter().rev()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_star_is_its_tips() {
        let star: Vec<Vec2> = (0..10)
            .map(|k| Vec2::from_angle(k as f32 * 0.628) * if k % 2 == 0 { 2.0 } else { 0.5 })
            .collect();
        let hull = convex_hull(&star, |p| *p);
        assert_eq!(hull.len(), 5);
        assert!(hull.iter().all(|p| p.length() > 1.9));
    }

    #[test]
    fn collinear_and_repeated_points_have_no_inside() {
        let line = [Vec2::ZERO, Vec2::X, Vec2::X, 3.0 * Vec2::X];
        assert!(convex_hull(&line, |p| *p).len() <= 2);
        assert_eq!(convex_hull(&[Vec2::ONE], |p| *p), [Vec2::ONE]);
    }
}
