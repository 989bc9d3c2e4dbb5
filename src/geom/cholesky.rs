//! Symmetric positive definite systems of equations with few entries in each row, solved directly: factored once, solved often.
//!
//! Unknowns are numbered anew so that those that belong together stand near each other (reverse Cuthill and McKee: breadth first from a far
//! end, few neighbours first, then backward). Each row of the factor keeps what lies between its first entry and the diagonal, where
//! alone numbers other than 0 arise.
//!
//! Own code, because the crates for this are whole libraries of linear algebra (`faer`, `nalgebra-sparse`) or under another licence
//! (`sprs-ldl`, LGPL), and pieces of surfaces are narrow: 5000 unknowns have rows of about a hundred entries.
//! Limits: O(n b²) for factoring and O(n b) for solving, b the mean length of a row; meshes have b of about 1.5 √n.

/// A factored system.
#[derive(Clone, Debug)]
pub struct Cholesky {
    /// The new number of each unknown.
    place: Vec<u32>,
    /// The first column of each row.
    first: Vec<u32>,
    /// Where each row begins among the entries; one more than there are rows.
    starts: Vec<usize>,
    entries: Vec<f64>,
}

impl Cholesky {
    /// Factors a matrix from its entries `(row, column, value)`; of those off the diagonal one of each pair is given. Entries at one
    /// place are added up. `None` if the matrix is not positive definite.
    pub fn new(count: usize, entries: &[(u32, u32, f64)]) -> Option<Self> {
        let place = narrow(count, entries);
        let placed = |(i, j, value): &(u32, u32, f64)| {
            let (i, j) = (place[*i as usize], place[*j as usize]);
            (i.max(j), i.min(j), *value)
        };
        let mut first: Vec<u32> = (0..count as u32).collect();
        for (row, column, _) in entries.iter().map(placed) {
            first[row as usize] = first[row as usize].min(column);
        }
        let mut starts = vec![0];
        for (row, column) in first.iter().enumerate() {
            starts.push(starts[row] + row + 1 - *column as usize);
        }
        let mut whole = vec![0.0; starts[count]];
        for (row, column, value) in entries.iter().map(placed) {
            whole[starts[row as usize] + (column - first[row as usize]) as usize] += value;
        }
        let mut made = Self { place, first, starts, entries: whole };
        made.factor().then_some(made)
    }

    /// Length of the factor's rows, all together.
    pub fn entries(&self) -> usize {
        self.entries.len()
    }

    fn factor(&mut self) -> bool {
        for row in 0..self.first.len() {
            let (from, start) = (self.first[row] as usize, self.starts[row]);
            let (done, open) = self.entries.split_at_mut(start);
            let own = &mut open[..=row - from];
            for column in from..row {
                let (other, other_start) = (self.first[column] as usize, self.starts[column]);
                let both = from.max(other);
                let theirs = &done[other_start + both - other..other_start + column - other];
                let sum = dot(&own[both - from..column - from], theirs);
                let diagonal = done[other_start + column - other];
                own[column - from] = (own[column - from] - sum) / diagonal;
            }
            let squared = own[row - from] - dot(&own[..row - from], &own[..row - from]);
            if !(squared > 0.0 && squared.is_finite()) {
                return false;
            }
            own[row - from] = squared.sqrt();
        }
        true
    }

    /// The unknowns for a right side.
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let count = self.first.len();
        let mut x = vec![0.0; count];
        for (value, place) in right.iter().zip(&self.place) {
            x[*place as usize] = *value;
        }
        for row in 0..count {
            let (from, entries) = self.row(row);
            let sum = dot(&entries[..row - from], &x[from..row]);
            x[row] = (x[row] - sum) / entries[row - from];
        }
        for row in (0..count).rev() {
            let (from, entries) = self.row(row);
            x[row] /= entries[row - from];
            let value = x[row];
            for (x, entry) in x[from..row].iter_mut().zip(entries) {
                *x -= value * entry;
            }
        }
        self.place.iter().map(|place| x[*place as usize]).collect()
    }

    fn row(&self, row: usize) -> (usize, &[f64]) {
        (self.first[row] as usize, &self.entries[self.starts[row]..self.starts[row + 1]])
    }
}

/// Sums of four at a time, so that processors add them side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (fours, rest) = a.as_chunks::<4>();
    let (others, last) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (x, y) in fours.iter().zip(others) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    sums.iter().sum::<f64>() + rest.iter().zip(last).map(|(x, y)| x * y).sum::<f64>()
}

/// New numbers by which entries lie near the diagonal.
fn narrow(count: usize, entries: &[(u32, u32, f64)]) -> Vec<u32> {
    let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(2 * entries.len());
    for (i, j, _) in entries.iter().filter(|(i, j, _)| i != j) {
        pairs.extend([(*i, *j), (*j, *i)]);
    }
    pairs.sort_unstable();
    pairs.dedup();
    let mut beside = vec![Vec::new(); count];
    pairs.iter().for_each(|(i, j)| beside[*i as usize].push(*j));
    let mut seen = vec![false; count];
    let mut order: Vec<u32> = Vec::with_capacity(count);
    for start in 0..count as u32 {
        if seen[start as usize] {
            continue;
        }
        let far = last_reached(&beside, start);
        let mut next = order.len();
        seen[far as usize] = true;
        order.push(far);
        while next < order.len() {
            let mut more: Vec<u32> =
                beside[order[next] as usize].iter().copied().filter(|j| !seen[*j as usize]).collect();
            more.sort_by_key(|j| (beside[*j as usize].len(), *j));
            more.iter().for_each(|j| seen[*j as usize] = true);
            order.extend(more);
            next += 1;
        }
    }
    let mut place = vec![0; count];
    for (k, i) in order.iter().rev().enumerate() {
        place[*i as usize] = k as u32;
    }
    place
}

/// A far end of what hangs together with an unknown: the last one that is reached from the last one that is reached from it.
fn last_reached(beside: &[Vec<u32>], start: u32) -> u32 {
    let mut from = start;
    for _ in 0..2 {
        let (mut seen, mut order) = (vec![false; beside.len()], vec![from]);
        seen[from as usize] = true;
        let mut next = 0;
        while next < order.len() {
            for j in &beside[order[next] as usize] {
                if !seen[*j as usize] {
                    seen[*j as usize] = true;
                    order.push(*j);
                }
            }
            next += 1;
        }
        from = order[order.len() - 1];
    }
    from
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The equations of a sheet of springs, `side` by `side`, held at its rim.
    fn sheet(side: u32) -> Vec<(u32, u32, f64)> {
        let mut entries = Vec::new();
        for y in 0..side {
            for x in 0..side {
                let i = y * side + x;
                entries.push((i, i, 4.0));
                if x + 1 < side {
                    entries.push((i, i + 1, -1.0));
                }
                if y + 1 < side {
                    entries.push((i + side, i, -1.0));
                }
            }
        }
        entries
    }

    #[test]
    fn what_is_solved_gives_the_right_side_again() {
        let side = 20;
        let (entries, count) = (sheet(side), (side * side) as usize);
        let factored = Cholesky::new(count, &entries).unwrap();
        let right: Vec<f64> = (0..count).map(|i| (i as f64 * 0.7).sin()).collect();
        let x = factored.solve(&right);
        let mut again = vec![0.0; count];
        for (i, j, value) in &entries {
            again[*i as usize] += value * x[*j as usize];
            if i != j {
                again[*j as usize] += value * x[*i as usize];
            }
        }
        assert!(again.iter().zip(&right).all(|(a, b)| (a - b).abs() < 1e-9));
        assert!(factored.entries() < count * 2 * side as usize, "{} entries", factored.entries());
    }

    #[test]
    fn parts_that_do_not_hang_together_are_solved_together() {
        let factored = Cholesky::new(3, &[(0, 0, 4.0), (2, 2, 16.0), (1, 1, 1.0)]).unwrap();
        assert_eq!(factored.solve(&[4.0, 3.0, 32.0]), [1.0, 3.0, 2.0]);
    }

    #[test]
    fn what_is_not_positive_definite_is_refused() {
        assert!(Cholesky::new(2, &[(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)]).is_none());
        assert!(Cholesky::new(1, &[(0, 0, f64::NAN)]).is_none());
        assert!(Cholesky::new(0, &[]).unwrap().solve(&[]).is_empty());
    }
}
