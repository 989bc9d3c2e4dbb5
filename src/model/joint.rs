//! Where a branch leaves its parent, and the window that is cut into the parent's bark for it.
//!
//! A branch's skeleton begins inside its parent. What is seen of it begins where a ring around it lies wholly outside of
//! the parent: its exit. The window is a rectangle of the parent's grid of rings and sides, as wide as the branch is
//! thick and as long as the branch's slanting section through the bark; `wood` joins its rim to the ring at the exit.
//!
//! Windows of one parent never overlap. A branch whose place is taken goes to the nearest free cells.
//!
//! Limits: near its joint a parent counts as a straight cylinder. A branch that never leaves its parent has no exit and is
//! not seen.

use super::spine::Ring;
use glam::Vec3;
use std::f32::consts::TAU;
use std::ops::Range;

/// How far around its axis a branch swells where it leaves its parent.
pub(super) const COLLAR: f32 = 1.25;
/// Space between the parent's bark and the first ring, as a share of the parent's radius.
const CLEAR: f32 = 0.08;
/// Less than this of a branch outside, as a multiple of its radius, is not worth a joint.
const SHORTEST: f32 = 0.5;
/// Longest window, as a multiple of its least length: branches that hug their parent leave it by a long slit otherwise.
const LONGEST: f32 = 2.5;

/// Where a branch leaves its parent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exit {
    /// The first ring outside.
    pub(super) ring: Ring,
    /// Length of the branch before it, metres along the rings.
    pub(super) arc: f32,
    /// Unit direction from the parent's axis to where the branch comes out, square to that axis.
    pub(super) outward: Vec3,
    /// Unit direction of the parent's axis there.
    pub(super) upward: Vec3,
    /// Length of the parent before the middle of the window, metres along its rings.
    pub(super) at: f32,
    /// Half the window's length along the parent, metres.
    pub(super) half_length: f32,
    /// Half the window's width as an angle around the parent, radians, at most a quarter turn.
    pub(super) half_angle: f32,
}

/// The exit of a branch from its parent; `None` for one that stays inside.
pub(super) fn exit(branch: &[Ring], parent: &[Ring], parent_arcs: &[f32]) -> Option<Exit> {
    let foot = Foot::nearest(branch.first()?.at, parent, parent_arcs);
    let (ring, arc) = first_outside(branch, &foot)?;
    let (across, along) = foot.off_axis(ring.at);
    let (distance, axis) = (across.length(), foot.ring.tangent);
    // Where a straight line from foot to exit passes through the bark.
    let share = (foot.ring.radius / distance.max(f32::MIN_POSITIVE)).min(1.0);
    let slant = distance / (distance * distance + along * along).sqrt().max(f32::MIN_POSITIVE);
    let collar = COLLAR * ring.radius;
    Some(Exit {
        ring,
        arc,
        outward: across.try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector()),
        upward: axis,
        at: foot.arc + along * share,
        half_length: collar / slant.max(1.0 / LONGEST),
        half_angle: (collar / foot.ring.radius).min(1.0).asin(),
    })
}

/// The first ring of a branch that lies wholly outside of its parent, and the length of the branch before it; `None` if
/// hardly anything comes after it.
fn first_outside(branch: &[Ring], foot: &Foot) -> Option<(Ring, f32)> {
    let mut before = foot.clearance(branch.first()?);
    let (mut outside, mut length) = ((before >= 0.0).then_some((branch[0], 0.0)), 0.0);
    for w in branch.windows(2) {
        let step = w[0].at.distance(w[1].at);
        if outside.is_none() {
            let here = foot.clearance(&w[1]);
            let share = before / (before - here);
            outside = (here >= 0.0).then(|| (between(&w[0], &w[1], share), length + share * step));
            before = here;
        }
        length += step;
    }
    outside.filter(|(ring, arc)| length - arc >= SHORTEST * ring.radius)
}

/// The place on a parent where a branch begins.
struct Foot {
    /// The parent's ring there; its tangent is the parent's axis.
    ring: Ring,
    /// Length of the parent before it and after it, metres along its rings.
    arc: f32,
    left: f32,
}

impl Foot {
    /// The place on the rings' axis that is nearest to `p`.
    fn nearest(p: Vec3, rings: &[Ring], arcs: &[f32]) -> Self {
        let place = |i: usize| {
            let (a, b) = (rings[i].at, rings[i + 1].at);
            let along = b - a;
            let share = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            (p.distance_squared(a + along * share), i, share)
        };
        let best = (0..rings.len() - 1).map(place).min_by(|a, b| a.0.total_cmp(&b.0));
        let (_, i, share) = best.unwrap_or((0.0, 0, 0.0));
        let tangent = (rings[i + 1].at - rings[i].at).normalize();
        let ring = Ring { tangent, ..between(&rings[i], &rings[i + 1], share) };
        let arc = arcs[i] + share * (arcs[i + 1] - arcs[i]);
        Self { ring, arc, left: arcs[arcs.len() - 1] - arc }
    }

    /// A point from here, divided into what lies across the axis and how far along it is.
    fn off_axis(&self, p: Vec3) -> (Vec3, f32) {
        let off = p - self.ring.at;
        let along = off.dot(self.ring.tangent);
        (off - self.ring.tangent * along, along)
    }

    /// How far the innermost point of a ring's collar lies outside of the bark or beyond the parent's end, metres;
    /// negative inside.
    fn clearance(&self, ring: &Ring) -> f32 {
        let (across, along) = self.off_axis(ring.at);
        let collar = COLLAR * ring.radius;
        let inner = collar * ring.tangent.dot(self.ring.tangent).abs();
        (across.length() - inner - (1.0 + CLEAR) * self.ring.radius).max(along - self.left - collar)
    }
}

/// A ring between two.
pub(super) fn between(a: &Ring, b: &Ring, share: f32) -> Ring {
    Ring {
        at: a.at.lerp(b.at, share),
        radius: a.radius + (b.radius - a.radius) * share,
        tangent: a.tangent.lerp(b.tangent, share).try_normalize().unwrap_or(a.tangent),
    }
}

/// Cells of a parent's grid: between rings `rows` and between sides `column` and `column + columns`, modulo the sides.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Window {
    pub(super) rows: Range<usize>,
    pub(super) column: usize,
    pub(super) columns: usize,
}

/// How many rows away a branch looks for free cells.
const FARTHEST: usize = 32;

/// Which cells of a limb's grid are cut out.
#[derive(Default)]
pub(super) struct Cells {
    sides: usize,
    taken: Vec<bool>,
}

impl Cells {
    pub(super) fn clear(&mut self, rows: usize, sides: usize) {
        self.sides = sides;
        self.taken.clear();
        self.taken.resize(rows * sides, false);
    }

    pub(super) fn is_taken(&self, row: usize, column: usize) -> bool {
        self.taken[row * self.sides + column]
    }

    /// Indices of a window's cells.
    fn of(&self, window: &Window) -> impl Iterator<Item = usize> + use<> {
        let (sides, first, columns) = (self.sides, window.column, window.columns);
        window
            .rows
            .clone()
            .flat_map(move |row| (first..first + columns).map(move |c| row * sides + c % sides))
    }

    fn is_free(&self, window: &Window) -> bool {
        self.of(window).all(|cell| !self.taken[cell])
    }

    fn take(&mut self, window: Window) -> Window {
        self.of(&window).for_each(|cell| self.taken[cell] = true);
        window
    }

    /// Cuts a window of `rows` that is `half_angle` wide on either side of `angle`; a smaller one, or one elsewhere, where
    /// those cells are taken; `None` when no cell is left.
    pub(super) fn cut(&mut self, rows: Range<usize>, angle: f32, half_angle: f32) -> Option<Window> {
        let per_side = TAU / self.sides as f32;
        let columns = ((2.0 * half_angle / per_side).round() as usize).clamp(1, self.sides / 2);
        let middle = angle.rem_euclid(TAU) / per_side;
        let first = |columns: usize| {
            (middle - 0.5 * columns as f32).round().rem_euclid(self.sides as f32) as usize % self.sides
        };
        let wide = Window { rows: rows.clone(), column: first(columns), columns };
        let narrow = Window { column: middle as usize % self.sides, columns: 1, ..wide.clone() };
        if let Some(window) = [wide, narrow].into_iter().find(|window| self.is_free(window)) {
            return Some(self.take(window));
        }
        self.nearest_free(0.5 * (rows.start + rows.end - 1) as f32, middle).map(|window| self.take(window))
    }

    fn nearest_free(&self, row: f32, column: f32) -> Option<Window> {
        let sides = self.sides as f32;
        let off = |cell: usize| {
            let (r, c) = ((cell / self.sides) as f32 - row, (cell % self.sides) as f32 + 0.5 - column);
            let around = (c.abs()).min(sides - c.abs());
            r * r + around * around
        };
        let near = (row as usize).saturating_sub(FARTHEST)
            ..(row as usize + FARTHEST).min(self.taken.len() / self.sides);
        let free = (near.start * self.sides..near.end * self.sides).filter(|cell| !self.taken[*cell]);
        let cell = free.min_by(|a, b| off(*a).total_cmp(&off(*b)))?;
        let row = cell / self.sides;
        Some(Window { rows: row..row + 1, column: cell % self.sides, columns: 1 })
    }
}

impl Window {
    /// The grid points (ring, side) of the rim, counter-clockwise seen from outside, and how far around the window's middle
    /// each lies: a share of a turn, 0 upward; ascending, beginning with the first that is not negative.
    pub(super) fn rim(&self, sides: usize, out: &mut Vec<(usize, usize, f32)>) {
        out.clear();
        let (w, h) = (self.columns, self.rows.len());
        let mut push = |x: usize, y: usize| {
            let (right, up) = (2.0 * x as f32 / w as f32 - 1.0, 2.0 * y as f32 / h as f32 - 1.0);
            let turn = (-right).atan2(up) / TAU;
            out.push((self.rows.start + y, (self.column + x) % sides, turn.rem_euclid(1.0)));
        };
        (0..w).for_each(|x| push(x, 0));
        (0..h).for_each(|y| push(w, y));
        (0..w).for_each(|x| push(w - x, h));
        (0..h).for_each(|y| push(0, h - y));
        let lowest = (0..out.len()).min_by(|a, b| out[*a].2.total_cmp(&out[*b].2)).unwrap_or(0);
        out.rotate_left(lowest);
    }
}
