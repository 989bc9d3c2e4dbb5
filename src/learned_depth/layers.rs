//! The layers of the network: convolutions of 3 × 3 cells, and pictures of twice the side.
//!
//! A convolution is one product of matrices: the weights times, for every cell of the result, the cells that it is made from. Sums
//! have a fixed order, so the same picture gives the same answer on any number of threads.

use ndarray::{Array2, ArrayView2};

/// A picture of several channels, each of `side` rows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Maps {
    pub(super) side: usize,
    /// One channel after the other.
    pub(super) cells: Vec<f32>,
}

impl Maps {
    /// How many.
    pub(super) fn channels(&self) -> usize {
        self.cells.len() / (self.side * self.side)
    }

    /// One of them.
    pub(super) fn channel(&self, k: usize) -> &[f32] {
        let size = self.side * self.side;
        &self.cells[k * size..(k + 1) * size]
    }

    /// These, then others of the same side.
    pub(super) fn followed_by(mut self, others: &Self) -> Self {
        debug_assert_eq!(self.side, others.side);
        self.cells.extend_from_slice(&others.cells);
        self
    }

    /// The mean of each channel.
    pub(super) fn means(&self) -> Vec<f32> {
        let size = (self.side * self.side) as f32;
        (0..self.channels()).map(|k| self.channel(k).iter().sum::<f32>() / size).collect()
    }

    /// Adds a number to each channel.
    pub(super) fn add(&mut self, to_channels: &[f32]) {
        let size = self.side * self.side;
        for (cells, number) in self.cells.chunks_exact_mut(size).zip(to_channels) {
            cells.iter_mut().for_each(|cell| *cell += number);
        }
    }

    /// Twice the side, bilinear; the middles of new cells lie a quarter of a cell beside those of the old.
    pub(super) fn doubled(&self) -> Self {
        let (side, last) = (2 * self.side, self.side - 1);
        let place = |i: usize| {
            let at = ((i as f32 + 0.5) / 2.0 - 0.5).max(0.0);
            let low = at as usize;
            (low, (low + 1).min(last), at - low as f32)
        };
        let mut cells = Vec::with_capacity(self.channels() * side * side);
        for k in 0..self.channels() {
            let channel = self.channel(k);
            for y in 0..side {
                let (y0, y1, down) = place(y);
                cells.extend((0..side).map(|x| {
                    let (x0, x1, right) = place(x);
                    let row = |y: usize| {
                        let (a, b) = (channel[y * self.side + x0], channel[y * self.side + x1]);
                        a + (b - a) * right
                    };
                    row(y0) + (row(y1) - row(y0)) * down
                }));
            }
        }
        Self { side, cells }
    }
}

/// A convolution of 3 × 3 cells; outside of a picture is 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Convolution {
    /// A row for each channel of the result: for each channel of the picture nine weights, row by row.
    pub(super) weights: Vec<f32>,
    /// A number that is added to each channel of the result.
    pub(super) constants: Vec<f32>,
    /// 1, or 2 for half the side.
    pub(super) stride: usize,
}

/// Slope of the rectifier below 0.
const LEAK: f32 = 0.1;

impl Convolution {
    /// The sums.
    pub(super) fn of(&self, maps: &Maps) -> Maps {
        let side = maps.side / self.stride;
        let (rows, inner) = (self.constants.len(), 9 * maps.channels());
        let mut sums = Array2::from_shape_fn((rows, side * side), |(row, _)| self.constants[row]);
        let around = self.around(maps, side);
        let shapes = (
            ArrayView2::from_shape((rows, inner), &self.weights),
            ArrayView2::from_shape((inner, side * side), &around),
        );
        if let (Ok(weights), Ok(around)) = shapes {
            ndarray::linalg::general_mat_mul(1.0, &weights, &around, 1.0, &mut sums);
        }
        Maps { side, cells: sums.into_raw_vec_and_offset().0 }
    }

    /// The sums; of those below 0 a tenth.
    pub(super) fn rectified(&self, maps: &Maps) -> Maps {
        let mut sums = self.of(maps);
        for cell in &mut sums.cells {
            *cell = if *cell < 0.0 { LEAK * *cell } else { *cell };
        }
        sums
    }

    /// For each of the nine places around, channel by channel, the cell there for every cell of the result.
    fn around(&self, maps: &Maps, side: usize) -> Vec<f32> {
        let mut around = vec![0.0; 9 * maps.channels() * side * side];
        for (k, column) in around.chunks_exact_mut(side * side).enumerate() {
            let channel = maps.channel(k / 9);
            let (dy, dx) = (k % 9 / 3, k % 3);
            for (y, row) in column.chunks_exact_mut(side).enumerate() {
                let from = y * self.stride + dy;
                if from == 0 || from > maps.side {
                    continue;
                }
                let source = &channel[(from - 1) * maps.side..from * maps.side];
                for (x, cell) in row.iter_mut().enumerate() {
                    let at = x * self.stride + dx;
                    if at > 0 && at <= maps.side {
                        *cell = source[at - 1];
                    }
                }
            }
        }
        around
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(side: usize) -> Maps {
        Maps { side, cells: (0..2 * side * side).map(|i| i as f32).collect() }
    }

    #[test]
    fn a_convolution_is_the_sum_of_what_lies_around() {
        let maps = ramp(4);
        let weights: Vec<f32> = (0..18).map(|k| 0.1 * k as f32 - 0.5).collect();
        for stride in [1, 2] {
            let it = Convolution { weights: weights.clone(), constants: vec![3.0], stride };
            let sums = it.of(&maps);
            assert_eq!(sums.side, 4 / stride);
            for (i, sum) in sums.cells.iter().enumerate() {
                let (x, y) = ((i % sums.side * stride) as i32, (i / sums.side * stride) as i32);
                let mut wanted = 3.0;
                for (k, weight) in weights.iter().enumerate() {
                    let (cx, cy) = (x + (k % 3) as i32 - 1, y + (k % 9 / 3) as i32 - 1);
                    if (0..4).contains(&cx) && (0..4).contains(&cy) {
                        wanted += weight * maps.channel(k / 9)[(cy * 4 + cx) as usize];
                    }
                }
                assert!((sum - wanted).abs() < 1e-3, "{sum} instead of {wanted} at {i}, stride {stride}");
            }
        }
    }

    #[test]
    fn doubled_pictures_keep_slopes_and_their_middle() {
        let maps = ramp(4);
        let twice = maps.doubled();
        assert_eq!((twice.side, twice.channels()), (8, 2));
        assert!((twice.channel(0)[8 + 3] - twice.channel(0)[8 + 2] - 0.5).abs() < 1e-5);
        for (a, b) in maps.means().iter().zip(twice.means()) {
            assert!((a - b).abs() < 1e-4);
        }
    }
}
