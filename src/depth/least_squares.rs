//! Least squares by Levenberg–Marquardt steps, for a fixed number of unknowns.

/// A sum of squares at some place, with the normal equations of the next step.
pub(super) struct Normal<const N: usize> {
    /// The sum.
    pub(super) cost: f64,
    /// Gauss–Newton matrix.
    pub(super) matrix: [[f64; N]; N],
    /// Half the gradient.
    pub(super) gradient: [f64; N],
}

/// What is to be made small, over things that steps in N unknowns change.
pub(super) struct Problem<A, B, C> {
    /// The normal equations at a thing.
    pub(super) normal: A,
    /// Its cost alone.
    pub(super) cost: B,
    /// The thing after a step.
    pub(super) stepped: C,
}

impl<A, B, C> Problem<A, B, C> {
    /// Improves a thing by at most `steps` steps; returns it with its cost.
    pub(super) fn improve<T, const N: usize>(&self, mut thing: T, steps: u32) -> (T, f64)
    where
        A: Fn(&T) -> Normal<N>,
        B: Fn(&T) -> f64,
        C: Fn(&T, [f64; N]) -> T,
    {
        let mut damping = 1e-3;
        let mut now = (self.normal)(&thing);
        for _ in 0..steps {
            let mut matrix = now.matrix;
            for (i, row) in matrix.iter_mut().enumerate() {
                row[i] += damping * row[i].max(1e-9);
            }
            let Some(step) = solve(matrix, now.gradient.map(|g| -g)) else { break };
            let next = (self.stepped)(&thing, step);
            let next_cost = (self.cost)(&next);
            if next_cost < now.cost {
                let gain = now.cost - next_cost;
                thing = next;
                damping = (damping * 0.1).max(1e-9);
                if gain < 1e-6 * now.cost {
                    break;
                }
                now = (self.normal)(&thing);
            } else {
                damping *= 10.0;
                if damping > 1e6 {
                    break;
                }
            }
        }
        (thing, now.cost)
    }
}

/// Solves a positive definite system by Cholesky elimination; `None` where it is singular.
fn solve<const N: usize>(mut m: [[f64; N]; N], mut v: [f64; N]) -> Option<[f64; N]> {
    for i in 0..N {
        if !(m[i][i] > 0.0 && m[i][i].is_finite()) {
            return None;
        }
        for j in i + 1..N {
            let (pivot, share) = (m[i], m[j][i] / m[i][i]);
            m[j].iter_mut().zip(pivot).for_each(|(x, p)| *x -= share * p);
            v[j] -= share * v[i];
        }
    }
    for i in (0..N).rev() {
        let known: f64 = (i + 1..N).map(|k| m[i][k] * v[k]).sum();
        v[i] = (v[i] - known) / m[i][i];
    }
    v.iter().all(|x| x.is_finite()).then_some(v)
}
