//! Petals that are seen end-on.
//!
//! Roots see each other within a share of their blade's own length. A petal that points at the viewer is drawn short, sees
//! too little, and would be left out of its flower. What counts is how long petals are where it stands: a blade in no flower
//! that begins where the petals of one gather, as they see it, belongs to that flower. So do several of them that gather
//! beside the flower's middle and all point away from it; a small flower before a large one has petals on all sides of its
//! own middle.
//!
//! Limits: a blade longer than the flower's petals in the mean sees it by itself or is no petal of it; one that lies where two flowers
//! gather belongs to the nearer one, in units of their lengths. Cost: near-linear, as few flowers of one size gather in one
//! place.

use glam::Vec2;
use std::collections::BTreeMap;

/// Mean length of several petals that gather beside the middle of a flower, at most, against the mean of its own.
const SHORT: f32 = 0.6;
/// Least cosine between a petal and the direction away from the middle, where several gather.
const OUTWARD: f32 = 0.3;

/// A place where petals gather.
#[derive(Clone, Copy, Debug)]
struct Gathered {
    center: Vec2,
    /// Mean length of its petals.
    length: f32,
    count: usize,
}

/// Where a blade begins, and the way from there to its tip.
pub(super) struct Rooted {
    pub(super) root: Vec2,
    pub(super) axis: Vec2,
}

/// Gives blades seen end-on the label of their flower. `labels` name the clusters of the blades, counted from 0; one of at least
/// `min_petals` is a flower, within whose `bandwidth`, a share of its petals' length, roots belong to it.
pub(super) fn join(labels: &mut [usize], blades: &[Rooted], bandwidth: f32, min_petals: usize) {
    let clusters = clusters(labels, blades);
    let is_flower = |cluster: &Gathered| cluster.count >= min_petals && cluster.length > 0.0;
    let flowers = ByPlace::new(&clusters, bandwidth, is_flower);
    if flowers.cells.is_empty() {
        return;
    }
    let mut outward = vec![None; clusters.len()];
    for (label, cluster) in clusters.iter().enumerate().filter(|(_, cluster)| is_flower(cluster)) {
        outward[label] = flowers.around(cluster.center, cluster.length / SHORT);
    }
    for (label, blade) in labels.iter().zip(blades) {
        let Some(other) = outward[*label] else { continue };
        let away = (blade.root - clusters[other].center).normalize_or_zero();
        if away.dot(blade.axis.normalize_or_zero()) < OUTWARD {
            outward[*label] = None;
        }
    }
    for (label, blade) in labels.iter_mut().zip(blades) {
        let joined = if is_flower(&clusters[*label]) {
            outward[*label]
        } else {
            flowers.around(blade.root, blade.axis.length())
        };
        *label = joined.unwrap_or(*label);
    }
}

fn clusters(labels: &[usize], blades: &[Rooted]) -> Vec<Gathered> {
    let none = Gathered { center: Vec2::ZERO, length: 0.0, count: 0 };
    let mut clusters = vec![none; labels.iter().max().map_or(0, |most| most + 1)];
    for (label, blade) in labels.iter().zip(blades) {
        let cluster = &mut clusters[*label];
        cluster.center += blade.root;
        cluster.length += blade.axis.length();
        cluster.count += 1;
    }
    for cluster in &mut clusters {
        let count = cluster.count.max(1) as f32;
        cluster.center /= count;
        cluster.length /= count;
    }
    clusters
}

/// Flowers by size and place: in cells about as large as what belongs to them.
struct ByPlace<'a> {
    clusters: &'a [Gathered],
    bandwidth: f32,
    cells: BTreeMap<i32, BTreeMap<[i64; 2], Vec<usize>>>,
}

impl<'a> ByPlace<'a> {
    fn new(clusters: &'a [Gathered], bandwidth: f32, is_flower: impl Fn(&Gathered) -> bool) -> Self {
        let mut cells: BTreeMap<i32, BTreeMap<[i64; 2], Vec<usize>>> = BTreeMap::new();
        for (label, cluster) in clusters.iter().enumerate().filter(|(_, cluster)| is_flower(cluster)) {
            let size = (bandwidth * cluster.length).log2().ceil() as i32;
            let cell = cell(cluster.center, size);
            cells.entry(size).or_default().entry(cell).or_default().push(label);
        }
        Self { clusters, bandwidth, cells }
    }

    /// The flower with longer petals than this to which a blade belongs that begins at a place.
    fn around(&self, root: Vec2, length: f32) -> Option<usize> {
        let mut best: Option<(f32, usize)> = None;
        for (size, cells) in &self.cells {
            let [x, y] = cell(root, *size);
            let near = (-1..=1).flat_map(|i| (-1..=1).map(move |k| [x + i, y + k]));
            for label in near.filter_map(|place| cells.get(&place)).flatten() {
                let flower = &self.clusters[*label];
                let off = root.distance(flower.center) / (self.bandwidth * flower.length);
                let is_its = off < 1.0 && length < flower.length;
                if is_its && best.is_none_or(|(least, _)| off < least) {
                    best = Some((off, *label));
                }
            }
        }
        best.map(|(_, label)| label)
    }
}

fn cell(place: Vec2, size: i32) -> [i64; 2] {
    (place.as_dvec2() / f64::from(size).exp2()).floor().to_array().map(|x| x as i64)
}
