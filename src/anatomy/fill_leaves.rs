//! Leaves for leaf outlines (000 §3.5.2, 002 §4.3).
//!
//! A vein grows from every growth point as a twig would; a leaf drawn by the artist, chosen at random, is laid on it by
//! an affine map: root on the vein's beginning, tip on its end. A leaf grows no longer than the drawn ones (with some
//! variation), so one sample leaf sets the size of a whole crown. Without a drawn leaf a plain ovate one is used;
//! without a branch inside the outline, leaves are scattered over it.

use super::{
    Copy, FlatBlade, Stop,
    growth_points::{Forest, GrowthPoint, Thinned, side},
    recall::Recall,
    vein::{self, Walk},
};
use crate::geom::{region::Region, simple_loop};
use crate::random::{mix, stream};
use crate::sketch::StrokeId;
use glam::Vec2;
use rand::RngExt;
use rayon::prelude::*;
use std::sync::Arc;

crate::parameters! {
    /// How leaf outlines are filled with leaves.
    pub struct LeafFillParams {
        /// Attraction of the vein to the outline (k_p).
        outline_pull: f32 = 0.3, 0.0..=1.0, "";
        /// Attraction of the vein along its branch (k_b).
        parent_pull: f32 = 0.2, 0.0..=1.0, "";
        /// Direction memory of the vein (k_m).
        memory: f32 = 0.7, 0.0..=1.0, "";
        /// Distance between leaves along a branch.
        spacing: f32 = 0.3, 0.05..=5.0, "of the leaf's length";
        /// Length of a leaf where none was drawn.
        default_length: f32 = 0.03, 0.002..=0.3, "of the drawing's diagonal";
        /// Width of a leaf where none was drawn.
        default_width: f32 = 0.5, 0.02..=2.0, "of its length";
        /// Random change of length, up to.
        variation: f32 = 0.25, 0.0..=0.9, "";
        /// Distance from the outline at which a vein ends.
        stop_distance: f32 = 0.004, 0.0..=0.2, "of the drawing's diagonal";
        /// Angle between a branch and its leaves.
        departure: f32 = 50.0, 0.0..=150.0, "degrees";
        /// Random change of that angle, up to.
        scatter: f32 = 25.0, 0.0..=90.0, "degrees";
        /// Most generated leaves in a drawing.
        max_leaves: u32 = 8000, 1..=1000000, "";
    }
}

/// Most places along one side of the grid over an outline without a branch.
const MAX_PLACES: f32 = 300.0;

/// Steps of a vein that is not stopped.
const STEPS: usize = 5;

/// Shortest vein, as a share of the full length, that still carries a leaf.
const SHORTEST: f32 = 0.4;

/// Random change of a copy's width, up to.
const ASPECT_VARIATION: f32 = 0.15;

/// The outlines that generated leaves are copied from.
#[derive(Clone, Debug, PartialEq)]
pub struct Templates {
    /// Closed outlines with the root at the origin and the tip at (0, 1), counter-clockwise with y upward.
    pub outlines: Vec<Arc<[Vec2]>>,
    /// Mean length of the drawn leaves, pixels.
    pub length: f32,
}

impl Templates {
    /// Templates from the drawn leaves, or the default leaf.
    pub fn new(drawn: &[FlatBlade], diagonal: f32, params: &LeafFillParams) -> Self {
        let usable: Vec<&FlatBlade> = drawn.iter().filter(|leaf| leaf.axis().length() > 0.0).collect();
        if usable.is_empty() {
            return Self {
                outlines: vec![ovate_leaf(params.default_width).into()],
                length: params.default_length * diagonal,
            };
        }
        let length = usable.iter().map(|leaf| leaf.axis().length()).sum::<f32>() / usable.len() as f32;
        Self { outlines: usable.iter().map(|leaf| upright(leaf).into()).collect(), length }
    }
}

/// The leaf's outline, moved, turned and scaled so that the axis runs from the origin to (0, 1).
fn upright(leaf: &FlatBlade) -> Vec<Vec2> {
    let axis = leaf.axis();
    let scale = 1.0 / axis.length_squared();
    // Canvas y points down, so the perpendicular is what the eye calls right.
    let right = axis.perp();
    let place = |p: Vec2| Vec2::new((p - leaf.root).dot(right), (p - leaf.root).dot(axis)) * scale;
    let mut outline: Vec<Vec2> = leaf.outline.iter().map(|s| place(s.position)).collect();
    if simple_loop::signed_area(outline.iter().copied()) < 0.0 {
        outline.reverse();
    }
    outline
}

/// A pointed oval of length 1: broadest below the middle, as most leaves are.
fn ovate_leaf(width: f32) -> Vec<Vec2> {
    const HALF: usize = 12;
    let half_width = |v: f32| 0.5 * width * 1.75 * v.powf(0.6) * (1.0 - v).powf(0.9);
    let side = |k: usize| k as f32 / HALF as f32;
    let right = (0..=HALF).map(|k| Vec2::new(half_width(side(k)), side(k)));
    let left = (1..HALF).rev().map(|k| Vec2::new(-half_width(side(k)), side(k)));
    right.chain(left).collect()
}

/// How a leaf is laid on its vein.
#[derive(Clone, Copy, Debug)]
pub struct Laid {
    tip: Vec2,
    /// Index of its template.
    template: u32,
    /// Width relative to the template's.
    aspect: f32,
}

/// Leaves from one drawing to the next, all grown in the same outline and in the same way; nothing where there is no room.
pub type Leaves = Recall<Option<Laid>>;

/// One leaf outline to fill.
pub struct LeafFill<'a> {
    /// The outline's stroke.
    pub outline: StrokeId,
    /// The outline.
    pub region: &'a Region,
    /// What leaves are copied from.
    pub templates: &'a Templates,
    /// The drawing's diagonal, pixels.
    pub diagonal: f32,
    /// Seed of everything random.
    pub seed: u64,
    /// How to fill it.
    pub params: &'a LeafFillParams,
    /// Nothing grows any more once it says yes.
    pub stop: Stop<'a>,
}

impl LeafFill<'_> {
    /// At most `limit` leaves, in the order of their places on the branches, and whether the limit thinned them.
    pub fn fill(&self, forest: &mut Forest, limit: usize, known: &mut Leaves) -> (Vec<FlatBlade>, bool) {
        let spacing = (self.params.spacing * self.templates.length).max(1e-3 * self.diagonal);
        let mut points = Thinned::new(limit);
        let all = 0..forest.branches().len();
        forest.growth_points(all, (self.outline, self.region), spacing, &mut points);
        if points.is_empty() && !points.is_thinned() {
            let grid = Grid::new(self.region, 2.0 * spacing);
            if forest.may_look_at(grid.len()) {
                grid.scatter(self.region, self.outline).for_each(|(point, number)| points.add(point, number));
            } else {
                points.leave_out();
            }
        }
        let leaf = |(point, laid): (&GrowthPoint, Option<Laid>)| {
            let Laid { tip, template, aspect } = laid?;
            Some(FlatBlade {
                stroke: None,
                outline: Arc::default(),
                root: point.position,
                tip,
                copy_of: Some(Copy { template, aspect, key: point.key }),
                attachment: point.attachment,
            })
        };
        let laid = self.all_laid(points.kept(), known);
        (points.kept().iter().zip(laid).filter_map(leaf).collect(), points.is_thinned())
    }

    /// How leaves are laid at growth points; nothing where there is no room, or once it stops.
    fn all_laid(&self, points: &[GrowthPoint], known: &mut Leaves) -> Vec<Option<Laid>> {
        let taken: Vec<Option<Option<Laid>>> =
            points.iter().map(|point| known.get(point, |_| true).copied()).collect();
        let missing: Vec<&GrowthPoint> =
            points.iter().zip(&taken).filter(|(_, taken)| taken.is_none()).map(|(point, _)| point).collect();
        let lay = |point: &&GrowthPoint| (!(self.stop)()).then(|| self.laid(point));
        let new: Vec<Option<Option<Laid>>> = missing.par_iter().with_min_len(32).map(lay).collect();
        for (point, laid) in missing.iter().zip(&new) {
            laid.iter().for_each(|laid| known.keep(point, *laid));
        }
        let mut new = new.into_iter();
        taken.into_iter().map(|taken| taken.or_else(|| new.next().flatten()).flatten()).collect()
    }

    /// How a leaf is laid at one growth point, `None` when there is no room for it.
    fn laid(&self, point: &GrowthPoint) -> Option<Laid> {
        let params = self.params;
        let mut rng = stream(self.seed, "leaf", point.key);
        let first = point.heading(params.departure, params.scatter, &mut rng);
        let size = 1.0 + params.variation * rng.random_range(-1.0..1.0f32);
        let rule = Walk {
            outline_pull: params.outline_pull,
            parent_pull: params.parent_pull,
            memory: params.memory,
            step: self.templates.length * size / STEPS as f32,
            max_steps: STEPS,
            stop_distance: params.stop_distance * self.diagonal,
        };
        let places = vein::walk(self.region, point.position, (point.direction, first), &rule, |_| false);
        let tip = *places.last()?;
        let template = rng.random_range(0..self.templates.outlines.len() as u32);
        let aspect = 1.0 + ASPECT_VARIATION * rng.random_range(-1.0..1.0f32);
        let is_long_enough = tip.distance(point.position) >= SHORTEST * self.templates.length;
        is_long_enough.then_some(Laid { tip, template, aspect })
    }
}

/// A grid of places over an outline without a branch, every other row moved by half a place; wider where they would be too
/// many.
struct Grid {
    low: Vec2,
    high: Vec2,
    spacing: f32,
    columns: usize,
    rows: usize,
}

impl Grid {
    fn new(region: &Region, spacing: f32) -> Self {
        let (low, high) = region.bounds().unwrap_or((Vec2::ZERO, Vec2::NEG_ONE));
        let size = high - low;
        let spacing = spacing.max(size.max_element() / MAX_PLACES);
        let count = |extent: f32| if extent >= 0.0 { (extent / spacing) as usize + 1 } else { 0 };
        Self { low, high, spacing, columns: count(size.x), rows: count(size.y) }
    }

    /// Number of places.
    fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Growth points at the places inside the region, with their numbers on the grid; they point away from its middle.
    fn scatter(self, region: &Region, outline: StrokeId) -> impl Iterator<Item = (GrowthPoint, u64)> {
        let Self { low, high, spacing, columns, rows } = self;
        let middle = low.midpoint(high);
        let places = (0..rows).flat_map(move |row| (0..columns).map(move |column| (row, column)));
        places.filter_map(move |(row, column)| {
            let position = low + spacing * Vec2::new(column as f32 + 0.5 * (row % 2) as f32, row as f32);
            let direction = (position - middle).normalize_or(Vec2::NEG_Y);
            let key = mix(mix(outline, row as u64), column as u64);
            let point = GrowthPoint { position, direction, attachment: None, side: side(column), key };
            region.contains(position).then_some((point, interleaved(row as u32, column as u32)))
        })
    }
}

/// A number of a place on a grid: multiples of a power of two are evenly spaced both ways.
fn interleaved(row: u32, column: u32) -> u64 {
    let bit = |of: u32, k: u32| u64::from(of >> k & 1);
    (0..u32::BITS).map(|k| bit(row, k) << (2 * k + 1) | bit(column, k) << (2 * k)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::{FlatBranch, Sample};

    fn square(size: f32) -> Region {
        Region::new([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|p| size * Vec2::from(p)).to_vec())
    }

    fn stem() -> Vec<FlatBranch> {
        let line = (0..=50).map(|k| Sample::neutral(Vec2::new(500.0, 990.0 - 19.0 * k as f32))).collect();
        vec![FlatBranch {
            stroke: Some(1),
            key: 1,
            line,
            half_width: None,
            parent: None,
            attached_at: 0.0,
            level: 0,
        }]
    }

    fn filled(branches: &[FlatBranch]) -> Vec<FlatBlade> {
        let params = LeafFillParams::default();
        let templates = Templates::new(&[], 1400.0, &params);
        let region = &square(1000.0);
        let params = &params;
        let fill = LeafFill {
            outline: 9,
            region,
            templates: &templates,
            diagonal: 1400.0,
            seed: 5,
            params,
            stop: &|| false,
        };
        fill.fill(&mut Forest::new(branches.to_vec()), 1000, &mut Leaves::default()).0
    }

    #[test]
    fn leaves_grow_from_the_branch_and_stay_inside() {
        let leaves = filled(&stem());
        assert!(leaves.len() > 30, "{}", leaves.len());
        for leaf in &leaves {
            assert!((leaf.root.x - 500.0).abs() < 1e-3 && square(1000.0).contains(leaf.tip));
            assert_eq!(leaf.attachment.unwrap().branch, 0);
        }
    }

    #[test]
    fn leaves_are_scattered_over_an_outline_without_branch() {
        let leaves = filled(&[]);
        assert!(leaves.len() > 100 && leaves.iter().all(|l| l.attachment.is_none()));
    }

    #[test]
    fn templates_stand_upright() {
        let outline = [(10.0, 10.0), (20.0, 0.0), (30.0, 10.0), (20.0, 20.0)]
            .map(|p| Sample::neutral(Vec2::from(p)))
            .to_vec();
        let (root, tip) = (Vec2::new(10.0, 10.0), Vec2::new(30.0, 10.0));
        let drawn = FlatBlade {
            stroke: Some(1),
            outline: outline.into(),
            root,
            tip,
            copy_of: None,
            attachment: None,
        };
        let templates = Templates::new(&[drawn], 100.0, &LeafFillParams::default());
        assert_eq!(templates.length, 20.0);
        // y points down on the canvas: the stroke's upper side lies left of an axis that points right.
        let upright = [(0.5, 0.5), (0.0, 1.0), (-0.5, 0.5), (0.0, 0.0)].map(Vec2::from);
        assert_eq!(templates.outlines[0][..], upright);
    }
}
