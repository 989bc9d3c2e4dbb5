//! The drawings by people that the program is developed on and judged by: they can be read, and the labels fit them.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::people::{CLASSES, Half, drawings, icons};
use std::collections::BTreeSet;

const LABELS: &str = include_str!("fixtures/real_strokes.tsv");
const HABITS: [&str; 12] = [
    "flower",
    "tree",
    "conifer",
    "palm",
    "bush",
    "herb",
    "grass",
    "succulent",
    "potted",
    "garden",
    "leaf",
    "mushroom",
];
const ROLES: [&str; 17] = [
    "stem",
    "trunk_side",
    "trunk_outline",
    "crown",
    "petal",
    "corolla",
    "flower_centre",
    "leaf",
    "midrib",
    "vein",
    "pot",
    "ground",
    "body",
    "spine",
    "scribble",
    "frame",
    "other",
];

#[test]
fn all_drawings_are_read_and_split_as_they_were_first() {
    let halves = [Half::Development, Half::HeldBack].map(|half| drawings(half).unwrap());
    assert_eq!(halves.map(|half| half.len()), [92, 104]);
    assert_eq!(icons().unwrap().len(), 24);
    assert!(CLASSES.is_sorted());
}

#[test]
fn labels_are_of_the_development_half_a_role_for_every_stroke() {
    let rows: Vec<&str> = LABELS.lines().filter(|line| !line.starts_with('#')).collect();
    let drawings = drawings(Half::Development).unwrap();
    assert_eq!(rows.len(), drawings.len());
    for (row, drawing) in rows.iter().zip(&drawings) {
        let [class, index, habit, strokes] = row.split('\t').collect::<Vec<_>>().try_into().unwrap();
        assert_eq!((class, index), (drawing.class.as_str(), drawing.name.as_str()));
        assert!(HABITS.contains(&habit), "{row}");
        let strokes: Vec<&str> = strokes.split(' ').collect();
        assert_eq!(strokes.len(), drawing.sketch.strokes.len(), "{row}");
        let mut parts = BTreeSet::new();
        for piece in strokes.iter().flat_map(|stroke| stroke.split('+')) {
            let (role, part) = piece.split_once(':').unwrap();
            assert!(ROLES.contains(&role), "{row}: {piece}");
            parts.insert(part.parse::<usize>().unwrap());
        }
        let numbered_from_one = parts.iter().copied().eq(1..=parts.len());
        assert!(numbered_from_one, "{row}");
    }
}
