//! Ellipse through points, by direct least squares.
//!
//! Fitzgibbon, Pilu and Fisher minimise the algebraic distance `Σ (a x² + b xy + c y² + d x + e y + f)²` under
//! `4ac − b² = 1`, so that the answer is an ellipse whatever the points are. As Halír and Flusser do, the linear
//! coefficients (d, e, f) are eliminated first, which leaves the 3×3 problem `M q = λ C q` for q = (a, b, c) with M
//! positive semidefinite. We depart from them in solving it: with the Cholesky factor `M = L Lᵀ` the wanted q is the
//! top eigenvector of the symmetric `L⁻¹ C L⁻ᵀ`, which Jacobi rotations find without complex or mixed-up eigenvalues,
//! also for points exactly on an ellipse, where M is singular.
//!
//! The points are centred and scaled before the fit, so the result is the same at every scale. Limits: at least five
//! points; points on a line, on one spot or not finite give `None`; noise pulls the direct fit toward flat ellipses.

use glam::DVec2;

/// An ellipse in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Its centre.
    pub center: DVec2,
    /// Half the longest diameter.
    pub semi_major: f64,
    /// Half the shortest diameter, positive, at most `semi_major`.
    pub semi_minor: f64,
    /// Unit direction of the longest diameter.
    pub major: DVec2,
}

type Mat3 = [[f64; 3]; 3];

/// Share of M's trace added to its diagonal: keeps the Cholesky factor real for points exactly on an ellipse.
const RIDGE: f64 = 1e-14;
/// Flatter ellipses are taken for a line.
const FLATTEST: f64 = 1e-3;

/// The ellipse of least algebraic distance to `points`; `None` if they do not determine one.
pub fn fit_ellipse(points: &[DVec2]) -> Option<Ellipse> {
    if points.len() < 5 {
        return None;
    }
    let count = points.len() as f64;
    let mean = points.iter().sum::<DVec2>() / count;
    let spread = (points.iter().map(|p| p.distance_squared(mean)).sum::<f64>() / count).sqrt();
    if !(spread.is_finite() && spread > f64::MIN_POSITIVE) {
        return None;
    }
    let unit: Vec<DVec2> = points.iter().map(|&p| (p - mean) / spread).collect();
    let e = from_conic(direct_conic(&unit)?)?;
    Some(Ellipse {
        center: mean + e.center * spread,
        semi_major: e.semi_major * spread,
        semi_minor: e.semi_minor * spread,
        major: e.major,
    })
}

/// Coefficients (a, b, c, d, e, f) of the fitted conic.
fn direct_conic(points: &[DVec2]) -> Option<[f64; 6]> {
    let (mut s1, mut s2, mut s3) = ([[0.0; 3]; 3], [[0.0; 3]; 3], [[0.0; 3]; 3]);
    for p in points {
        let quadratic = [p.x * p.x, p.x * p.y, p.y * p.y];
        let linear = [p.x, p.y, 1.0];
        for i in 0..3 {
            for j in 0..3 {
                s1[i][j] += quadratic[i] * quadratic[j];
                s2[i][j] += quadratic[i] * linear[j];
                s3[i][j] += linear[i] * linear[j];
            }
        }
    }
    let s3_root = cholesky(s3)?;
    // Row i of `eliminate` is S3⁻¹ times row i of S2.
    let eliminate = s2.map(|row| solve_upper_of(&s3_root, solve_lower(&s3_root, row)));
    let mut m = s1;
    for i in 0..3 {
        for j in 0..3 {
            m[i][j] -= (0..3).map(|k| s2[i][k] * eliminate[j][k]).sum::<f64>();
        }
    }
    let ridge = RIDGE * (s1[0][0] + s1[1][1] + s1[2][2]);
    for (i, row) in m.iter_mut().enumerate() {
        row[i] += ridge;
    }
    let root = cholesky(m)?;
    const CONSTRAINT: Mat3 = [[0.0, 0.0, 2.0], [0.0, -1.0, 0.0], [2.0, 0.0, 0.0]];
    let half = CONSTRAINT.map(|row| solve_lower(&root, row));
    let symmetric = transpose(half).map(|row| solve_lower(&root, row));
    let (value, vector) = top_eigenvector(symmetric);
    if !(value.is_finite() && value > 0.0) {
        return None;
    }
    let q = solve_upper_of(&root, vector);
    let linear = |k: usize| -(0..3).map(|i| eliminate[i][k] * q[i]).sum::<f64>();
    Some([q[0], q[1], q[2], linear(0), linear(1), linear(2)])
}

/// Centre, axes and direction of a conic; `None` unless it is a real, finite ellipse.
fn from_conic([a, b, c, d, e, f]: [f64; 6]) -> Option<Ellipse> {
    let discriminant = 4.0 * a * c - b * b;
    if discriminant <= 0.0 || discriminant.is_nan() {
        return None;
    }
    let center = DVec2::new(b * e - 2.0 * c * d, b * d - 2.0 * a * e) / discriminant;
    let at_center = f + 0.5 * (d * center.x + e * center.y);
    // Eigenvalues of [[a, b/2], [b/2, c]], the larger in size belongs to the minor axis.
    let (mean, split) = (0.5 * (a + c), 0.5 * (a - c).hypot(b));
    let sign = mean.signum();
    let (steep, shallow) = (mean + sign * split, mean - sign * split);
    let (minor2, major2) = (-at_center / steep, -at_center / shallow);
    if !(minor2 > 0.0 && major2.is_finite() && minor2 > FLATTEST * FLATTEST * major2 && center.is_finite()) {
        return None;
    }
    let minor = 0.5 * (sign * b).atan2(sign * (a - c));
    let major = DVec2::from_angle(minor).perp();
    Some(Ellipse { center, semi_major: major2.sqrt(), semi_minor: minor2.sqrt(), major })
}

fn transpose(m: Mat3) -> Mat3 {
    [0, 1, 2].map(|j| [m[0][j], m[1][j], m[2][j]])
}

/// Lower triangular factor of a positive definite matrix.
fn cholesky(m: Mat3) -> Option<Mat3> {
    let mut l = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..=i {
            let rest = m[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
            if i == j && (rest <= 0.0 || rest.is_nan()) {
                return None;
            }
            l[i][j] = if i == j { rest.sqrt() } else { rest / l[j][j] };
        }
    }
    Some(l)
}

/// Solves `L x = v`.
fn solve_lower(l: &Mat3, v: [f64; 3]) -> [f64; 3] {
    let x = v[0] / l[0][0];
    let y = (v[1] - l[1][0] * x) / l[1][1];
    [x, y, (v[2] - l[2][0] * x - l[2][1] * y) / l[2][2]]
}

/// Solves `Lᵀ x = v`.
fn solve_upper_of(l: &Mat3, v: [f64; 3]) -> [f64; 3] {
    let z = v[2] / l[2][2];
    let y = (v[1] - l[2][1] * z) / l[1][1];
    [(v[0] - l[1][0] * y - l[2][0] * z) / l[0][0], y, z]
}

/// Largest eigenvalue of a symmetric matrix with its unit eigenvector, by cyclic Jacobi rotations.
fn top_eigenvector(mut m: Mat3) -> (f64, [f64; 3]) {
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // Convergence is quadratic; ten sweeps are more than any 3×3 matrix needs.
    for _ in 0..10 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if m[p][q].abs() <= f64::EPSILON * 1e-3 * (m[p][p].abs() * m[q][q].abs()).sqrt() {
                continue;
            }
            let ratio = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
            let tangent = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
            let cos = 1.0 / tangent.hypot(1.0);
            let sin = tangent * cos;
            rotate_columns(&mut m, p, q, cos, sin);
            m = transpose(m);
            rotate_columns(&mut m, p, q, cos, sin);
            rotate_columns(&mut vectors, p, q, cos, sin);
        }
    }
    let top = (1..3).fold(0, |best, i| if m[i][i] > m[best][best] { i } else { best });
    (m[top][top], vectors.map(|row| row[top]))
}

fn rotate_columns(m: &mut Mat3, p: usize, q: usize, cos: f64, sin: f64) {
    for row in m {
        (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn on_ellipse(e: &Ellipse, phase: f64) -> DVec2 {
        e.center + e.major * (e.semi_major * phase.cos()) + e.major.perp() * (e.semi_minor * phase.sin())
    }

    proptest! {
        #[test]
        fn exact_points_give_their_ellipse_back(
            x in -1e4..1e4f64, y in -1e4..1e4f64, size in 1e-2..1e4f64, flat in 0.02..0.98f64,
            turn in 0.0..std::f64::consts::PI, start in 0.0..6.0f64, count in 5usize..30,
        ) {
            let truth = Ellipse {
                center: DVec2::new(x, y) * size, semi_major: size, semi_minor: size * flat,
                major: DVec2::from_angle(turn),
            };
            let step = std::f64::consts::TAU / count as f64;
            let points: Vec<_> = (0..count).map(|k| on_ellipse(&truth, start + step * k as f64)).collect();
            let found = fit_ellipse(&points).expect("points on an ellipse");
            prop_assert!(found.center.distance(truth.center) < 1e-4 * size);
            prop_assert!((found.semi_major / size - 1.0).abs() < 1e-4);
            prop_assert!((found.semi_minor / size - flat).abs() < 1e-4);
            prop_assert!(found.major.perp_dot(truth.major).abs() * (1.0 - flat) < 1e-4);
        }

        #[test]
        fn any_points_give_a_sound_ellipse_or_none(
            points in prop::collection::vec((-1e6..1e6f64, -1e6..1e6f64), 0..12),
        ) {
            let points: Vec<_> = points.into_iter().map(|(x, y)| DVec2::new(x, y)).collect();
            if let Some(e) = fit_ellipse(&points) {
                prop_assert!(e.center.is_finite() && e.semi_major.is_finite());
                prop_assert!(e.semi_minor > 0.0 && e.semi_minor <= e.semi_major * (1.0 + 1e-9));
                prop_assert!((e.major.length() - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn noise_moves_the_fit_little() {
        let truth = Ellipse {
            center: DVec2::new(3.0, -2.0),
            semi_major: 5.0,
            semi_minor: 2.0,
            major: DVec2::from_angle(0.7),
        };
        let wobble = |k: usize| DVec2::from_angle(k as f64 * 2.4) * 0.03;
        let points: Vec<_> = (0..40).map(|k| on_ellipse(&truth, k as f64 * 0.157) + wobble(k)).collect();
        let found = fit_ellipse(&points).unwrap();
        assert!(found.center.distance(truth.center) < 0.05, "{found:?}");
        assert!((found.semi_minor - 2.0).abs() < 0.05 && (found.semi_major - 5.0).abs() < 0.05, "{found:?}");
    }

    #[test]
    fn what_determines_no_ellipse_gives_none() {
        let line: Vec<_> = (0..9).map(|k| DVec2::new(k as f64, 2.0 * k as f64)).collect();
        assert_eq!(fit_ellipse(&line), None);
        assert_eq!(fit_ellipse(&[DVec2::ONE; 7]), None);
        assert_eq!(fit_ellipse(&line[..4]), None);
        assert_eq!(fit_ellipse(&[DVec2::NAN; 6]), None);
    }
}
