//! What the artist makes of the petals of a flower: how far the control points of their surfaces are moved, kept with the drawing.
//!
//! A petal has the 4 × 4 control points of the bicubic Bézier patch that comes nearest to it. Those of all petals of a shaped
//! flower are moved alike, each petal in its own directions and by shares of its own length, so that one shape fits large petals and small ones,
//! wherever they stand.
//!
//! A [`PetalShape`] names the strokes that drew the petals when they were shaped. It holds for the flower that has most of these
//! strokes ([`shares_most`]), so that it stays while petals are added, drawn again or erased. It is the shape of a whole flower
//! and not of one of its whorls: which petals are a whorl is found by fitting cones and may become another with the next stroke,
//! which petals are a flower seldom does.
//!
//! Limits: petals in layers that a species makes by itself are not shaped.

use super::corrections::shares_most;
use super::{StrokeId, limits};
use glam::Vec3;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

/// How far control points are moved: rows from base to tip, in each from left to right as the face of the petal is seen;
/// across, along and toward the face, shares of the petal's length.
pub type Offsets = [[Vec3; 4]; 4];

/// How the petals of a flower are shaped.
#[derive(Clone, Debug, PartialEq)]
pub struct PetalShape {
    /// The strokes that drew the petals, ascending, each once, at least one.
    pub strokes: Vec<StrokeId>,
    /// How far the control points are moved.
    pub offsets: Offsets,
}

/// All shapes of petals of a drawing, oldest first; shared, because drawings are copied with every sample of the pen.
pub type PetalShapes = Arc<[PetalShape]>;

impl PetalShape {
    /// What petals become that these strokes draw, in any order.
    pub fn new(strokes: impl IntoIterator<Item = StrokeId>, offsets: Offsets) -> Self {
        let mut strokes: Vec<StrokeId> = strokes.into_iter().collect();
        strokes.sort_unstable();
        strokes.dedup();
        Self { strokes, offsets }
    }

    /// Whether it moves no point.
    pub fn is_still(&self) -> bool {
        self.offsets.as_flattened().iter().all(|offset| *offset == Vec3::ZERO)
    }
}

/// The shape of each flower, by the place of its strokes in `flowers`; of several for one flower the last.
pub fn of_flowers<'a>(shapes: &'a [PetalShape], flowers: &[Vec<StrokeId>]) -> Vec<Option<&'a PetalShape>> {
    let mut found = vec![None; flowers.len()];
    if shapes.is_empty() {
        return found;
    }
    let mut sizes = vec![0; flowers.len()];
    let mut flowers_of: HashMap<StrokeId, Vec<usize>> = HashMap::new();
    for (flower, strokes) in flowers.iter().enumerate() {
        let strokes: HashSet<StrokeId> = strokes.iter().copied().collect();
        sizes[flower] = strokes.len();
        strokes.iter().for_each(|stroke| flowers_of.entry(*stroke).or_default().push(flower));
    }
    for shape in shapes {
        let mut shared: BTreeMap<usize, usize> = BTreeMap::new();
        let named = shape.strokes.iter().filter_map(|stroke| flowers_of.get(stroke)).flatten();
        named.for_each(|flower| *shared.entry(*flower).or_default() += 1);
        for (flower, shared) in shared {
            if shares_most(shared, shape.strokes.len(), sizes[flower]) {
                found[flower] = Some(shape);
            }
        }
    }
    found
}

/// The shapes with a new one, in place of all that were about the same flower; one that moves nothing takes theirs away. What
/// names only strokes that are not there is left out.
pub fn shaped(
    known: &[PetalShape],
    new: PetalShape,
    strokes: impl IntoIterator<Item = StrokeId>,
) -> PetalShapes {
    let there: HashSet<StrokeId> = strokes.into_iter().collect();
    let is_about = |old: &PetalShape| {
        let shared = old.strokes.iter().filter(|stroke| new.strokes.binary_search(stroke).is_ok()).count();
        shares_most(shared, old.strokes.len(), new.strokes.len())
    };
    let stays = |old: &&PetalShape| old.strokes.iter().any(|s| there.contains(s)) && !is_about(old);
    let kept: Vec<PetalShape> = known.iter().filter(stays).cloned().collect();
    kept.into_iter().chain((!new.is_still()).then_some(new)).collect()
}

/// Checks that there are not too many, that each names strokes, ascending and each once, and that none moves a point too far.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn check(shapes: &[PetalShape]) -> Result<(), String> {
    if shapes.len() > limits::MAX_PETAL_SHAPES {
        return Err(format!("a drawing holds at most {} shapes of petals", limits::MAX_PETAL_SHAPES));
    }
    let names: usize = shapes.iter().map(|shape| shape.strokes.len()).sum();
    if names > limits::MAX_SHAPED_STROKES {
        return Err(format!(
            "shapes of petals name at most {} strokes, all together",
            limits::MAX_SHAPED_STROKES
        ));
    }
    let check_one = |(i, shape): (usize, &PetalShape)| {
        check_one(shape).map_err(|what| format!("petal shape {}: {what}", i + 1))
    };
    shapes.iter().enumerate().try_for_each(check_one)
}

/// What is wrong with a shape, in words.
pub(super) fn check_one(shape: &PetalShape) -> Result<(), String> {
    if shape.strokes.is_empty() || !shape.strokes.is_sorted_by(|a, b| a < b) {
        return Err(
            "it names no stroke, or one twice; name each stroke of the flower's petals once".to_owned()
        );
    }
    let most = limits::MAX_PETAL_OFFSET;
    for (row, points) in shape.offsets.iter().enumerate() {
        for (column, offset) in points.iter().enumerate() {
            if let Some(found) = offset.to_array().into_iter().find(|x| !(-most..=most).contains(x)) {
                let (row, column) = (row + 1, column + 1);
                return Err(format!(
                    "point {column} of row {row} is moved by {found}; write −{most} to {most}, shares of the petal's length"
                ));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shape that lifts the tip by so much.
    fn lifted(strokes: &[StrokeId], by: f32) -> PetalShape {
        let mut offsets = Offsets::default();
        offsets[3][1].z = by;
        PetalShape::new(strokes.iter().copied(), offsets)
    }

    #[test]
    fn the_last_word_on_a_flower_holds_and_a_still_shape_takes_it_back() {
        let one = shaped(&[], lifted(&[3, 1, 2, 1], 0.5), 1..=9);
        assert_eq!(one[0].strokes, [1, 2, 3]);
        let two = shaped(&one, lifted(&[7, 8], 0.2), 1..=9);
        // A petal more, one less: it is the same flower.
        let again = shaped(&two, lifted(&[2, 3, 4], 0.7), 1..=9);
        assert_eq!(again.iter().map(|shape| shape.offsets[3][1].z).collect::<Vec<_>>(), [0.2, 0.7]);
        assert_eq!(*shaped(&again, lifted(&[2, 3], 0.0), 1..=9), [lifted(&[7, 8], 0.2)]);
        // Of strokes that went nothing is left with the next shape.
        assert_eq!(shaped(&again, lifted(&[9], 0.1), 9..=9).len(), 1);
    }

    #[test]
    fn a_shape_stays_while_petals_come_and_go() {
        let shapes = [lifted(&[1, 2, 3], 0.5), lifted(&[7], 0.2)];
        let heights = |flowers: &[&[StrokeId]]| -> Vec<Option<f32>> {
            let flowers: Vec<Vec<StrokeId>> = flowers.iter().map(|strokes| strokes.to_vec()).collect();
            of_flowers(&shapes, &flowers).iter().map(|shape| Some(shape.as_ref()?.offsets[3][1].z)).collect()
        };
        assert_eq!(heights(&[&[4, 5], &[3, 2, 1, 9, 10]]), [None, Some(0.5)]);
        assert_eq!(heights(&[&[2, 3], &[7, 7, 7]]), [Some(0.5), Some(0.2)]);
        assert_eq!(heights(&[&[3, 8, 9]]), [None], "one petal of three is not that flower");
    }

    #[test]
    fn too_much_is_refused() {
        assert_eq!(check(&[lifted(&[1], limits::MAX_PETAL_OFFSET)]), Ok(()));
        assert!(check(&[lifted(&[], 0.1)]).is_err());
        assert!(check(&vec![lifted(&[1], 0.1); limits::MAX_PETAL_SHAPES + 1]).is_err());
        for bad in [f32::NAN, f32::INFINITY, -2.5] {
            let what = check(&[lifted(&[1], 0.0), lifted(&[2], bad)]).unwrap_err();
            assert!(what.starts_with("petal shape 2: point 2 of row 4"), "{what}");
        }
        let all = PetalShape::new(0..limits::MAX_SHAPED_STROKES as u64, Offsets::default());
        assert!(check(std::slice::from_ref(&all)).is_ok() && check(&[all, lifted(&[1], 0.1)]).is_err());
    }
}
