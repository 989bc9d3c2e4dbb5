//! A plant seen from one side: its depth, its crown as a hand would draw it, and the lines of its wood.
//!
//! The depth of a crown is that of its hull: over each cell the nearest and the farthest leaf within [`HULL`] cells. The crown's area
//! is that of its leaves with the gaps between them closed; half of the areas are drawn by a hand that rounds corners off and trembles.
//! Lines are the trunk and some of the boughs.

use crate::trees::{Tree, Wood};
use glam::{Quat, Vec2, Vec3};
use penstemon::learned_depth::picture::{self, FILLED, Frame, Line, SIDE};
use penstemon::random::{mix, unit};
use std::f32::consts::TAU;

/// Cells along a side of what is to be learned.
pub(crate) const CELLS: usize = SIDE / 2;
/// Reach of a crown's hull, cells of [`SIDE`].
const HULL: f32 = 2.5;
/// Least half width of a leaf, cells, and as a share of its length.
const LEAF: (f32, f32) = (0.5, 0.25);
/// Most lines of wood in a drawing.
const LINES: usize = 14;
/// Least length of such a line, as a share of the picture.
const SHORTEST: f32 = 0.1;

/// Numbers drawn by lot that make one view of a plant differ from another.
struct Lot(u64);

impl Lot {
    fn between(&mut self, low: f32, high: f32) -> f32 {
        self.0 = mix(self.0, 1);
        low + (high - low) * unit(self.0)
    }
}

/// A plant turned about its foot and drawn.
pub(crate) struct View {
    /// How the plant was turned.
    pub(crate) turn: Quat,
    /// How much taller it was made.
    pub(crate) tall: f32,
    /// Where the picture lies.
    pub(crate) frame: Frame,
    /// The crown as it is drawn.
    pub(crate) area: Box<[bool; SIDE * SIDE]>,
    /// The wood that is drawn, in the drawing's plane.
    pub(crate) lines: Vec<Line>,
    /// The same in space: depth at each point, in the drawing's unit.
    pub(crate) depths: Vec<Vec<f32>>,
    /// Nearest and farthest of the crown's hull, shares of the picture's side; NaN where there is none.
    pub(crate) front: Vec<f32>,
    /// See `front`.
    pub(crate) back: Vec<f32>,
}

impl View {
    /// What is seen of a plant that is turned and stretched as the seed says; `None` of one too small.
    pub(crate) fn of(tree: &Tree, seed: u64) -> Option<Self> {
        let mut lot = Lot(seed);
        let turn = Quat::from_rotation_y(lot.between(0.0, TAU));
        let tall = lot.between(0.75, 1.35);
        let seen = |p: Vec3| {
            let p = turn * p;
            Vec3::new(p.x, -p.y * tall, p.z)
        };
        let leaves: Vec<[Vec3; 2]> = tree.leaves.iter().map(|leaf| leaf.map(seen)).collect();
        if leaves.len() < 30 {
            return None;
        }
        let frame = Frame::around(Vec2::ZERO, leaves.iter().flatten().map(|p| p.truncate()))?;
        let frame = frame.with_side(frame.side() * FILLED / lot.between(0.8, 0.95));
        let hull = Hull::of(&leaves, &frame);
        let area = drawn(&hull.leaf, &mut lot);
        let (lines, depths) = wood(&tree.wood, seen, &frame, &mut lot);
        Some(Self { turn, tall, frame, area, lines, depths, front: hull.front, back: hull.back })
    }

    /// Rows of bytes, see [`BYTES`].
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut row = Vec::with_capacity(BYTES);
        let picture = picture::Picture::new(&self.area, &self.frame, &self.lines);
        let channel = |k: usize| &picture.channels()[k * SIDE * SIDE..(k + 1) * SIDE * SIDE];
        for k in 0..3 {
            row.extend(channel(k).iter().map(|v| (v * 255.0).round() as u8));
        }
        for k in 3..5 {
            row.extend(channel(k).iter().map(|v| (v * 127.0).round() as i8 as u8));
        }
        let half = |at: &[f32], away: f32| -> Vec<u8> {
            let of = |i: usize| {
                let (x, y) = (2 * (i % CELLS), 2 * (i / CELLS));
                let cells = [y * SIDE + x, y * SIDE + x + 1, (y + 1) * SIDE + x, (y + 1) * SIDE + x + 1];
                let known = cells.iter().map(|i| at[*i]).filter(|z| z.is_finite());
                let (sum, count) = known.fold((0.0, 0), |(sum, count), z| (sum + z, count + 1));
                if count == 0 { away } else { sum / count as f32 }
            };
            (0..CELLS * CELLS).map(|i| byte(of(i))).collect()
        };
        row.extend(half(&self.front, f32::NAN));
        row.extend(half(&self.back, f32::NAN));
        row.extend(self.depth_of_lines());
        row
    }

    fn depth_of_lines(&self) -> Vec<u8> {
        let mut depth = vec![0; CELLS * CELLS];
        for (line, depths) in self.lines.iter().zip(&self.depths) {
            for (pair, z) in line.points.windows(2).zip(depths.windows(2)) {
                let [a, b] = [pair[0], pair[1]].map(|p| self.frame.place(p) * CELLS as f32);
                let z = 0.5 * (z[0] + z[1]) / self.frame.side();
                picture::for_cells_near((a, b), 0.75, CELLS, |cell| depth[cell] = byte(z));
            }
        }
        depth
    }
}

/// Bytes of a view: the first five channels of its picture, then front, back and the depth of lines in a quarter of the cells, 1 to 255
/// for −0.5 to 0.5 of the picture's side and 0 for unknown.
pub(crate) const BYTES: usize = 5 * SIDE * SIDE + 3 * CELLS * CELLS;

fn byte(z: f32) -> u8 {
    if z.is_finite() { (128.0 + 254.0 * z).round().clamp(1.0, 255.0) as u8 } else { 0 }
}

/// The hull of leaves.
struct Hull {
    leaf: Box<[bool; SIDE * SIDE]>,
    front: Vec<f32>,
    back: Vec<f32>,
}

impl Hull {
    fn of(leaves: &[[Vec3; 2]], frame: &Frame) -> Self {
        let mut leaf = Box::new([false; SIDE * SIDE]);
        let (mut front, mut back) = (vec![f32::NEG_INFINITY; SIDE * SIDE], vec![f32::INFINITY; SIDE * SIDE]);
        for &[base, tip] in leaves {
            let place = |p: Vec3| frame.place(p.truncate()) * SIDE as f32;
            let width = LEAF.1 * base.distance(tip) / frame.side() * SIDE as f32;
            let (near, far) = (base.z.max(tip.z) / frame.side(), base.z.min(tip.z) / frame.side());
            picture::for_cells_near((place(base), place(tip)), width.max(LEAF.0), SIDE, |i| leaf[i] = true);
            let middle = place(base.midpoint(tip));
            picture::for_cells_near((middle, middle), HULL, SIDE, |i| {
                front[i] = front[i].max(near);
                back[i] = back[i].min(far);
            });
        }
        Self { leaf, front, back }
    }
}

/// An area as it is drawn: gaps closed, and by half of the hands rounded off and trembling.
fn drawn(leaf: &[bool; SIDE * SIDE], lot: &mut Lot) -> Box<[bool; SIDE * SIDE]> {
    let is_clean = lot.between(0.0, 1.0) < 0.5;
    let reach = if is_clean { 1.5 } else { lot.between(2.0, 8.0) };
    let mut area = within(leaf, reach, true);
    area = within(&area, reach, false);
    fill_small_holes(&mut area, if is_clean { 12 } else { 60 });
    if is_clean {
        return area;
    }
    let strength = lot.between(0.3, 1.6);
    let phases: [f32; 6] = std::array::from_fn(|_| lot.between(0.0, TAU));
    let wave = |p: Vec2, k: usize| {
        (p.y * 19.0 + p.x * 7.0 + phases[k]).sin()
            + (p.x * 31.0 - p.y * 23.0 + phases[k + 1]).sin() * 0.6
            + (p.x * 57.0 + p.y * 49.0 + phases[k + 2]).sin() * 0.3
    };
    let source = area.clone();
    for i in 0..SIDE * SIDE {
        let p = picture::middle(i);
        let q = (p * SIDE as f32 + strength * Vec2::new(wave(p, 0), wave(p, 3))).floor();
        let inside = q.min_element() >= 0.0 && q.max_element() < SIDE as f32;
        area[i] = inside && source[q.y as usize * SIDE + q.x as usize];
    }
    area
}

/// Cells within `reach` of what is set (grown), or of which all within `reach` are set.
pub(crate) fn within(set: &[bool; SIDE * SIDE], reach: f32, grown: bool) -> Box<[bool; SIDE * SIDE]> {
    let r = reach.ceil() as i32;
    let near: Vec<(i32, i32)> = (-r..=r)
        .flat_map(|y| (-r..=r).map(move |x| (x, y)))
        .filter(|(x, y)| ((x * x + y * y) as f32) <= reach * reach)
        .collect();
    let at = |x: i32, y: i32| {
        let inside = x >= 0 && y >= 0 && x < SIDE as i32 && y < SIDE as i32;
        inside && set[y as usize * SIDE + x as usize]
    };
    let mut out = Box::new([false; SIDE * SIDE]);
    for (i, cell) in out.iter_mut().enumerate() {
        let (x, y) = ((i % SIDE) as i32, (i / SIDE) as i32);
        let mut around = near.iter().map(|(dx, dy)| at(x + dx, y + dy));
        *cell = if grown { around.any(|set| set) } else { around.all(|set| set) };
    }
    out
}

/// Fills what is enclosed by the area and has fewer than so many cells.
fn fill_small_holes(area: &mut [bool; SIDE * SIDE], fewer: usize) {
    let mut seen = area.to_vec();
    for first in 0..SIDE * SIDE {
        if seen[first] {
            continue;
        }
        let (mut open, mut hole) = (vec![first], Vec::new());
        seen[first] = true;
        while let Some(i) = open.pop() {
            hole.push(i);
            let (x, y) = (i % SIDE, i / SIDE);
            let mut visit = |x: usize, y: usize| {
                if !std::mem::replace(&mut seen[y * SIDE + x], true) {
                    open.push(y * SIDE + x);
                }
            };
            if x > 0 {
                visit(x - 1, y)
            }
            if y > 0 {
                visit(x, y - 1)
            }
            if x + 1 < SIDE {
                visit(x + 1, y)
            }
            if y + 1 < SIDE {
                visit(x, y + 1)
            }
        }
        if hole.len() < fewer {
            hole.into_iter().for_each(|i| area[i] = true);
        }
    }
}

/// The wood that is drawn: nothing of it, the trunk alone, or boughs too, from thick to thin.
fn wood(
    all: &[Wood],
    seen: impl Fn(Vec3) -> Vec3,
    frame: &Frame,
    lot: &mut Lot,
) -> (Vec<Line>, Vec<Vec<f32>>) {
    let how = lot.between(0.0, 1.0);
    if how < 0.12 {
        return (Vec::new(), Vec::new());
    }
    let foot = all.iter().map(|w| w.radius).fold(0.0, f32::max);
    let least = foot * lot.between(0.1, 0.35);
    let most = 1 + lot.between(0.0, LINES as f32) as usize;
    let length = |w: &Wood| {
        w.points.windows(2).map(|p| seen(p[0]).truncate().distance(seen(p[1]).truncate())).sum::<f32>()
    };
    let is_drawn = |w: &&Wood| {
        w.level == 0
            || (how > 0.3 && w.radius >= least && w.level <= 2 && length(w) > SHORTEST * frame.side())
    };
    let mut chosen: Vec<&Wood> = all.iter().filter(is_drawn).collect();
    chosen.sort_by(|a, b| a.level.cmp(&b.level).then(b.radius.total_cmp(&a.radius)));
    chosen.truncate(most.max(chosen.iter().filter(|w| w.level == 0).count()));
    chosen.reverse();
    let line = |w: &&Wood| Line {
        points: w.points.iter().map(|p| seen(*p).truncate()).collect(),
        is_trunk: w.level == 0,
    };
    let depths = |w: &&Wood| w.points.iter().map(|p| seen(*p).z).collect();
    (chosen.iter().map(line).collect(), chosen.iter().map(depths).collect())
}
