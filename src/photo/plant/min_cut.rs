//! The cheapest cut of a grid of pixels into two: maximum flow by Boykov and Kolmogorov (2004).
//!
//! Every pixel is joined to its eight neighbours, and to the source and the sink by what it costs to be on the other side. Two trees
//! of residual edges grow from both; where they touch, flow is pushed along the path, and what it tears off is adopted or set
//! free. Neighbours lie at fixed steps in memory, around the picture is a rim of pixels without edges, and capacities are
//! whole numbers, so that the flow ends and is the same everywhere.
//!
//! Limits: the method has no good bound of steps, so work is counted; past [`STEPS`] for each pixel the cut is that of the trees as
//! they are. Pictures stay far below.
//!
//! Source: Boykov and Kolmogorov, *An experimental comparison of min-cut/max-flow algorithms…*, IEEE PAMI 26(9), 2004.

use std::collections::VecDeque;

/// Steps for each pixel after which the cut ends as it is.
const STEPS: u64 = 4_000;
/// Whose a pixel is.
const FREE: u8 = 0;
const SOURCE: u8 = 1;
const SINK: u8 = 2;
/// Parents that are no neighbour.
const TERMINAL: u8 = 8;
const ORPHAN: u8 = 9;
const NONE: u8 = 10;

/// Directions of neighbours: 0 to 7 are the rows around a pixel from the upper left on; the opposite of `d` is `7 − d`.
pub(super) const AROUND: [(i32, i32); 8] =
    [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];

/// A grid on which flow is sought.
pub(super) struct Grid {
    width: usize,
    rim_width: usize,
    /// Steps to the neighbours.
    steps: [isize; 8],
    /// What may still flow to each neighbour.
    residual: [Vec<i32>; 8],
    /// What may still flow from the source, or, below 0, to the sink.
    terminal: Vec<i32>,
    tree: Vec<u8>,
    parent: Vec<u8>,
    /// When the distance to the terminal was last known, and it.
    seen: Vec<u32>,
    distance: Vec<u32>,
    active: VecDeque<u32>,
    is_active: Vec<bool>,
    orphans: VecDeque<u32>,
    time: u32,
    work: u64,
}

impl Grid {
    /// A grid without edges.
    pub(super) fn new(width: usize, height: usize) -> Self {
        let rim_width = width + 2;
        let cells = rim_width * (height + 2);
        Self {
            width,
            rim_width,
            steps: AROUND.map(|(x, y)| y as isize * rim_width as isize + x as isize),
            residual: std::array::from_fn(|_| vec![0; cells]),
            terminal: vec![0; cells],
            tree: vec![FREE; cells],
            parent: vec![NONE; cells],
            seen: vec![0; cells],
            distance: vec![0; cells],
            active: VecDeque::new(),
            is_active: vec![false; cells],
            orphans: VecDeque::new(),
            time: 0,
            work: 0,
        }
    }

    fn cell(&self, pixel: usize) -> usize {
        (pixel / self.width + 1) * self.rim_width + pixel % self.width + 1
    }

    /// What it costs to have a pixel and its neighbour on different sides; at most 2²⁰.
    pub(super) fn join(&mut self, pixel: usize, direction: usize, cost: i32) {
        let cell = self.cell(pixel);
        let other = cell.wrapping_add_signed(self.steps[direction]);
        self.residual[direction][cell] = cost;
        self.residual[7 - direction][other] = cost;
    }

    /// By how much a pixel is cheaper on the source's side, or, below 0, on the sink's; at most 2²⁸ either way.
    pub(super) fn pull(&mut self, pixel: usize, by: i32) {
        let cell = self.cell(pixel);
        self.terminal[cell] = by;
    }

    /// Which pixels are on the source's side.
    pub(super) fn cut(mut self, height: usize) -> Vec<bool> {
        for cell in 0..self.terminal.len() {
            if self.terminal[cell] != 0 {
                self.tree[cell] = if self.terminal[cell] > 0 { SOURCE } else { SINK };
                self.parent[cell] = TERMINAL;
                self.distance[cell] = 1;
                self.activate(cell);
            }
        }
        let most = STEPS * (self.width * height) as u64;
        while let Some(&cell) = self.active.front() {
            let cell = cell as usize;
            if self.tree[cell] != FREE
                && self.work < most
                && let Some(bridge) = self.grow(cell)
            {
                self.time += 1;
                self.augment(bridge);
                self.adopt();
                continue;
            }
            self.active.pop_front();
            self.is_active[cell] = false;
        }
        (0..self.width * height).map(|pixel| self.tree[self.cell(pixel)] == SOURCE).collect()
    }

    fn activate(&mut self, cell: usize) {
        if !std::mem::replace(&mut self.is_active[cell], true) {
            self.active.push_back(cell as u32);
        }
    }

    /// What may flow within the tree from a cell outward to its neighbour, away from the tree's terminal.
    fn outward(&self, cell: usize, other: usize, direction: usize) -> i32 {
        if self.tree[cell] == SOURCE {
            self.residual[direction][cell]
        } else {
            self.residual[7 - direction][other]
        }
    }

    /// Takes free neighbours into the tree; the edge, from the source's tree to the sink's, at which both touch.
    fn grow(&mut self, cell: usize) -> Option<(usize, usize)> {
        for direction in 0..8 {
            let other = cell.wrapping_add_signed(self.steps[direction]);
            self.work += 1;
            if self.outward(cell, other, direction) <= 0 {
                continue;
            }
            if self.tree[other] == FREE {
                self.tree[other] = self.tree[cell];
                self.hang(other, 7 - direction, cell);
                self.activate(other);
            } else if self.tree[other] != self.tree[cell] {
                let from_source = self.tree[cell] == SOURCE;
                return Some(if from_source { (cell, direction) } else { (other, 7 - direction) });
            } else if self.seen[other] <= self.seen[cell] && self.distance[other] > self.distance[cell] + 1 {
                // A shorter way to the terminal.
                self.hang(other, 7 - direction, cell);
            }
        }
        None
    }

    /// Makes a cell the child of its neighbour in a direction.
    fn hang(&mut self, cell: usize, direction: usize, parent: usize) {
        self.parent[cell] = direction as u8;
        self.seen[cell] = self.seen[parent];
        self.distance[cell] = self.distance[parent] + 1;
    }

    /// The edge between a cell and its parent along which flow runs in this tree: its direction, and the cell at which it begins.
    fn edge_to_parent(&self, cell: usize) -> (usize, usize, usize) {
        let direction = usize::from(self.parent[cell]);
        let parent = cell.wrapping_add_signed(self.steps[direction]);
        if self.tree[cell] == SOURCE { (7 - direction, parent, parent) } else { (direction, cell, parent) }
    }

    /// Pushes as much flow as goes along the path over an edge between both trees.
    fn augment(&mut self, (source_end, direction): (usize, usize)) {
        let sink_end = source_end.wrapping_add_signed(self.steps[direction]);
        let mut flow = self.residual[direction][source_end];
        for end in [source_end, sink_end] {
            let mut cell = end;
            while self.parent[cell] != TERMINAL {
                let (along, begin, parent) = self.edge_to_parent(cell);
                flow = flow.min(self.residual[along][begin]);
                cell = parent;
            }
            flow = flow.min(self.terminal[cell].abs());
        }
        self.residual[direction][source_end] -= flow;
        self.residual[7 - direction][sink_end] += flow;
        for end in [source_end, sink_end] {
            let mut cell = end;
            while self.parent[cell] != TERMINAL {
                let (along, begin, parent) = self.edge_to_parent(cell);
                self.residual[along][begin] -= flow;
                let other = begin.wrapping_add_signed(self.steps[along]);
                self.residual[7 - along][other] += flow;
                if self.residual[along][begin] == 0 {
                    self.parent[cell] = ORPHAN;
                    self.orphans.push_front(cell as u32);
                }
                cell = parent;
                self.work += 1;
            }
            self.terminal[cell] -= flow * self.terminal[cell].signum();
            if self.terminal[cell] == 0 {
                self.parent[cell] = ORPHAN;
                self.orphans.push_front(cell as u32);
            }
        }
    }

    /// Finds a new parent in its own tree for everything that lost its own, or sets it free.
    fn adopt(&mut self) {
        while let Some(cell) = self.orphans.pop_front() {
            let cell = cell as usize;
            let mut best: Option<(u32, usize, usize)> = None;
            for direction in 0..8 {
                let other = cell.wrapping_add_signed(self.steps[direction]);
                if self.tree[other] == self.tree[cell]
                    && self.outward(other, cell, 7 - direction) > 0
                    && let Some(distance) = self.distance_to_terminal(other)
                    && best.is_none_or(|(least, ..)| distance < least)
                {
                    best = Some((distance, direction, other));
                }
            }
            match best {
                Some((distance, direction, _)) => {
                    self.parent[cell] = direction as u8;
                    self.seen[cell] = self.time;
                    self.distance[cell] = distance + 1;
                }
                None => self.set_free(cell),
            }
        }
    }

    fn set_free(&mut self, cell: usize) {
        for direction in 0..8 {
            let other = cell.wrapping_add_signed(self.steps[direction]);
            if self.tree[other] != self.tree[cell] {
                continue;
            }
            if self.outward(other, cell, 7 - direction) > 0 {
                self.activate(other);
            }
            if self.parent[other] == (7 - direction) as u8 {
                self.parent[other] = ORPHAN;
                self.orphans.push_back(other as u32);
            }
        }
        self.tree[cell] = FREE;
        self.parent[cell] = NONE;
    }

    /// How far a cell is from its tree's terminal; `None` where the way up ends at an orphan.
    fn distance_to_terminal(&mut self, start: usize) -> Option<u32> {
        let (mut cell, mut steps) = (start, 0);
        let total = loop {
            self.work += 1;
            if self.seen[cell] == self.time && self.parent[cell] < ORPHAN {
                break steps + self.distance[cell];
            }
            match self.parent[cell] {
                TERMINAL => {
                    self.seen[cell] = self.time;
                    self.distance[cell] = 1;
                    break steps + 1;
                }
                ORPHAN | NONE => return None,
                direction => cell = cell.wrapping_add_signed(self.steps[usize::from(direction)]),
            }
            steps += 1;
        };
        // What is known now need not be walked again.
        let (mut cell, mut distance) = (start, total);
        while self.seen[cell] != self.time {
            self.seen[cell] = self.time;
            self.distance[cell] = distance;
            distance -= 1;
            cell = cell.wrapping_add_signed(self.steps[usize::from(self.parent[cell])]);
        }
        Some(total)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of small numbers, its costs, and what a labelling costs.
    struct Case {
        width: usize,
        height: usize,
        pulls: Vec<i32>,
        edges: Vec<(usize, usize, usize, i32)>,
    }

    impl Case {
        fn new(width: usize, height: usize, state: &mut u32) -> Self {
            let mut next = |range: u32| {
                *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                ((*state >> 16) % range) as i32
            };
            let pulls = (0..width * height).map(|_| next(21) - 10).collect();
            let mut edges = Vec::new();
            for pixel in 0..width * height {
                for (direction, (dx, dy)) in AROUND.into_iter().enumerate().skip(4) {
                    let (x, y) = ((pixel % width) as i32 + dx, (pixel / width) as i32 + dy);
                    if (0..width as i32).contains(&x) && (0..height as i32).contains(&y) {
                        edges.push((pixel, direction, y as usize * width + x as usize, next(7)));
                    }
                }
            }
            Self { width, height, pulls, edges }
        }

        fn cost(&self, is_source: impl Fn(usize) -> bool) -> i32 {
            let pulls = self.pulls.iter().enumerate();
            let wrong = pulls.map(|(i, pull)| if is_source(i) == (*pull > 0) { 0 } else { pull.abs() });
            let cut = self.edges.iter().filter(|(a, _, b, _)| is_source(*a) != is_source(*b));
            wrong.sum::<i32>() + cut.map(|edge| edge.3).sum::<i32>()
        }

        fn cut(&self) -> Vec<bool> {
            let mut grid = Grid::new(self.width, self.height);
            self.edges.iter().for_each(|(pixel, direction, _, cost)| grid.join(*pixel, *direction, *cost));
            self.pulls.iter().enumerate().for_each(|(pixel, by)| grid.pull(pixel, *by));
            grid.cut(self.height)
        }
    }

    #[test]
    fn no_labelling_is_cheaper() {
        let mut state = 5;
        for (width, height) in [(1, 1), (2, 1), (1, 5), (3, 3), (4, 3), (4, 4)] {
            for _ in 0..12 {
                let case = Case::new(width, height, &mut state);
                let cut = case.cut();
                let least = (0..1u32 << (width * height)).map(|code| case.cost(|i| code >> i & 1 == 1)).min();
                assert_eq!(Some(case.cost(|i| cut[i])), least, "{width}×{height}");
            }
        }
    }

    #[test]
    fn larger_grids_cannot_be_bettered_by_any_pixel() {
        let mut state = 11;
        let case = Case::new(60, 40, &mut state);
        let cut = case.cut();
        let cost = case.cost(|i| cut[i]);
        for changed in 0..cut.len() {
            assert!(case.cost(|i| cut[i] != (i == changed)) >= cost);
        }
        assert_eq!(cut, case.cut());
    }
}
