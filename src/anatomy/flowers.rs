//! Which blades are petals, and of which flower (000 §3.3, 002 §4.1).
//!
//! Petals of one flower grow from one place, leaves one by one along a branch: roots that gather are a flower. The
//! radius within which roots see each other is a share of the blade's own length, so flowers of several scales live
//! in one drawing. As in 002, clusters of more than two are flowers; blades drawn with the petal tool are petals in
//! any number, those drawn with the leaf tool never are. What the artist says of one blade is no verdict on another: a
//! blade beside an explicit petal or leaf is what it would be beside any blade.
//!
//! Two habits of hands that the papers do not know: many draw a flower's centre as a circle and petals around it, whose
//! roots keep a distance (an open flower: a wider search, accepted only if the petals stand all round and point away
//! from the middle); and the circle itself is no petal: a round blade around the point where the petals meet is the flower's centre.
//!
//! Petals seen end-on are shorter than their flower is wide: they join it afterwards (`end_on`).
//!
//! Blades that gather at the foot of a stem are a rosette of leaves, but for those that the petal tool drew: flowers end
//! stems, they do not begin them.
//!
//! From one drawing to the next it is remembered where roots gather ([`Gatherer`]): only roots near a blade that came or
//! went are looked at again.

use super::end_on::{self, Rooted};
use super::{FlatBlade, FlatFlower, flower_centre::Roundness};
use crate::geom::mean_shift::{self, Climbs};
use crate::sketch::{StrokeId, Tool};
use glam::Vec2;

crate::parameters! {
    /// How petals gather to flowers.
    pub struct FlowerParams {
        /// Radius within which roots belong together.
        bandwidth: f32 = 0.3, 0.02..=2.0, "of the blade's length";
        /// The same for flowers that are drawn around an open centre.
        open_bandwidth: f32 = 0.75, 0.02..=2.0, "of the blade's length";
        /// Fewest blades that make a flower where the artist did not say petal.
        min_petals: u32 = 3, 1..=50, "";
        /// Widest angle without a petal in a flower with an open centre.
        open_gap: f32 = 150.0, 30.0..=360.0, "degrees";
    }
}

/// Share of a bandwidth within which two modes are the same cluster.
const MERGE: f32 = 0.7;

/// Fewest petals around an open centre.
const OPEN_PETALS: usize = 4;

/// Blades sorted into flowers and leaves.
#[derive(Debug, Default, PartialEq)]
pub struct Gathering {
    /// Petals, flower by flower.
    pub petals: Vec<FlatBlade>,
    /// Flowers over those petals.
    pub flowers: Vec<FlatFlower>,
    /// The rest.
    pub leaves: Vec<FlatBlade>,
    /// Strokes that draw the centre of a flower.
    pub centres: Vec<StrokeId>,
}

/// A blade on its way into a flower.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// The blade.
    pub blade: &'a FlatBlade,
    /// The tool of its stroke.
    pub tool: Tool,
    /// How round it is.
    pub roundness: &'a Roundness,
}

/// A stem that stands by itself: where it begins, and where it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stem {
    /// Its lower end.
    pub foot: Vec2,
    /// Its other end.
    pub tip: Vec2,
}

/// What is remembered of one drawing's flowers for the next: where roots gather, for each time that they are asked.
#[derive(Debug, Default)]
pub struct Gatherer {
    any: Divider,
    with_leaves: Divider,
    petals: Climbs,
}

/// The same for one division into clusters that are flowers and the rest.
#[derive(Debug, Default)]
struct Divider {
    closed: Climbs,
    open: Climbs,
}

/// Sorts blades, each with the tool of its stroke, into flowers and leaves.
pub fn gather(blades: Vec<(FlatBlade, Tool)>, stems: &[Stem], params: &FlowerParams) -> Gathering {
    let roundness: Vec<Roundness> = blades.iter().map(|(blade, _)| Roundness::of(blade)).collect();
    let drawn = blades.iter().zip(&roundness);
    let drawn = drawn.map(|((blade, tool), roundness)| Drawn { blade, tool: *tool, roundness }).collect();
    gather_with(&mut Gatherer::default(), drawn, stems, params)
}

/// The very gathering that [`gather`] gives, again and again while a drawing changes.
pub fn gather_with(
    known: &mut Gatherer,
    blades: Vec<Drawn<'_>>,
    stems: &[Stem],
    params: &FlowerParams,
) -> Gathering {
    let stems = &Stems::new(stems);
    let mut out = Gathering { petals: Vec::with_capacity(blades.len()), ..Gathering::default() };
    let (drawn_leaves, candidates): (Vec<_>, Vec<_>) =
        blades.into_iter().partition(|drawn| drawn.tool == Tool::Leaf);
    let (flowers, mut no_flower) = divide(&mut known.any, candidates, stems, params);
    flowers.into_iter().for_each(|cluster| out.add_flower(cluster));
    if no_flower.is_empty() {
        no_flower = drawn_leaves;
    } else {
        // What is called a leaf still stands beside the others, which stay what they would be beside any blade.
        no_flower.extend(drawn_leaves);
        let (flowers, rest) = divide(&mut known.with_leaves, no_flower, stems, params);
        no_flower = rest;
        for cluster in flowers {
            let (leaves, petals) = cluster.into_iter().partition(|drawn| drawn.tool == Tool::Leaf);
            no_flower.extend::<Vec<Drawn<'_>>>(leaves);
            out.add_flower(petals);
        }
    }
    // The artist's word counts here, and for these blades alone.
    let (drawn_petals, leaves): (Vec<_>, Vec<_>) =
        no_flower.into_iter().partition(|drawn| drawn.tool == Tool::Petal);
    let drawn_petals = clusters(&mut known.petals, drawn_petals, params.bandwidth, Some(params));
    drawn_petals.into_iter().for_each(|cluster| out.add_flower(cluster));
    out.leaves.extend(leaves.into_iter().map(|drawn| drawn.blade.clone()));
    out.leaves.sort_by_key(|leaf| leaf.stroke);
    out
}

/// Divides blades into clusters that are flowers, and those that are in none.
fn divide<'a>(
    known: &mut Divider,
    blades: Vec<Drawn<'a>>,
    stems: &Stems,
    params: &FlowerParams,
) -> (Vec<Vec<Drawn<'a>>>, Vec<Drawn<'a>>) {
    let (mut flowers, mut alone, mut no_flower) = (Vec::new(), Vec::new(), Vec::new());
    for cluster in clusters(&mut known.closed, blades, params.bandwidth, Some(params)) {
        if is_rosette(&cluster, stems, params.bandwidth) {
            no_flower.extend(cluster);
        } else if cluster.len() >= params.min_petals as usize {
            flowers.push(cluster);
        } else {
            alone.extend(cluster);
        }
    }
    for cluster in clusters(&mut known.open, alone, params.open_bandwidth, None) {
        let rosette = is_rosette(&cluster, stems, params.bandwidth);
        if !rosette && is_open_flower(&cluster, params.open_gap.to_radians()) {
            flowers.push(cluster);
        } else {
            no_flower.extend(cluster);
        }
    }
    (flowers, no_flower)
}

/// Blades by the place where their roots gather; `end_on` says from how many on they are flowers that short petals join.
fn clusters<'a>(
    known: &mut Climbs,
    blades: Vec<Drawn<'a>>,
    bandwidth: f32,
    end_on: Option<&FlowerParams>,
) -> Vec<Vec<Drawn<'a>>> {
    let roots: Vec<Vec2> = blades.iter().map(|drawn| drawn.blade.root).collect();
    let reach: Vec<f32> = blades.iter().map(|drawn| bandwidth * drawn.blade.axis().length()).collect();
    let mut labels = mean_shift::cluster_with(known, &roots, &reach, MERGE);
    if let Some(params) = end_on {
        let rooted = |drawn: &Drawn<'_>| Rooted { root: drawn.blade.root, axis: drawn.blade.axis() };
        let rooted: Vec<Rooted> = blades.iter().map(rooted).collect();
        end_on::join(&mut labels, &rooted, bandwidth, params.min_petals as usize);
    }
    let mut labelled: Vec<(usize, Drawn<'_>)> = labels.into_iter().zip(blades).collect();
    labelled.sort_by_key(|(label, _)| *label);
    let members = labelled.chunk_by(|a, b| a.0 == b.0);
    members.map(|members| members.iter().map(|(_, blade)| *blade).collect()).collect()
}

fn center_of(blades: &[Drawn<'_>]) -> Vec2 {
    blades.iter().map(|drawn| drawn.blade.root).sum::<Vec2>() / blades.len().max(1) as f32
}

/// Stems by their feet: from left to right in columns of equal numbers, and downward in each, so that those near a place are
/// found without a look at all.
struct Stems {
    stems: Vec<Stem>,
    /// How many stand in a column; the last may have fewer.
    height: usize,
    /// Where each column begins and ends, to the right.
    columns: Vec<[f32; 2]>,
}

impl Stems {
    fn new(stems: &[Stem]) -> Self {
        let (mut stems, height) = (stems.to_vec(), stems.len().isqrt().max(1));
        stems.sort_by(|a, b| a.foot.x.total_cmp(&b.foot.x));
        let mut columns = Vec::new();
        for column in stems.chunks_mut(height) {
            columns.extend(
                column.first().zip(column.last()).map(|(first, last)| [first, last].map(|stem| stem.foot.x)),
            );
            column.sort_by(|a, b| a.foot.y.total_cmp(&b.foot.y));
        }
        Self { stems, height, columns }
    }

    /// All stems whose feet are less than `reach` away from a place, and some more. Few are left to be measured.
    fn near(&self, place: Vec2, reach: f32) -> impl Iterator<Item = &Stem> {
        // More than the reach by more than any rounding.
        let reach = 1.001 * reach;
        let first = self.columns.partition_point(|[_, right]| *right < place.x - reach);
        let beside = self.columns[first..].iter().take_while(move |[left, _]| *left <= place.x + reach);
        let columns = self.stems.chunks(self.height).skip(first).zip(beside);
        columns.flat_map(move |(column, _)| {
            let top = column.partition_point(|stem| stem.foot.y < place.y - reach);
            column[top..].iter().take_while(move |stem| stem.foot.y <= place.y + reach)
        })
    }
}

/// Whether blades gather at the foot of a stem.
fn is_rosette(blades: &[Drawn<'_>], stems: &Stems, bandwidth: f32) -> bool {
    let center = center_of(blades);
    let lengths: f32 = blades.iter().map(|drawn| drawn.blade.axis().length()).sum();
    let reach = bandwidth * lengths / blades.len().max(1) as f32;
    let at_foot = |stem: &Stem| {
        let away = stem.foot.distance(center);
        away < reach && away < stem.tip.distance(center)
    };
    stems.near(center, reach).any(at_foot)
}

/// Whether blades stand all round a common centre and point away from it, their centre left out.
fn is_open_flower(blades: &[Drawn<'_>], widest_gap: f32) -> bool {
    let center = center_of(blades);
    let petals: Vec<&FlatBlade> =
        blades.iter().filter(|drawn| !drawn.roundness.is_centre(center)).map(|drawn| drawn.blade).collect();
    let outward = |b: &&FlatBlade| {
        let out = (b.tip - center).normalize_or_zero();
        b.axis().normalize_or_zero().dot(out) > 0.7 && b.root.distance(center) < 0.6 * b.tip.distance(center)
    };
    if petals.len() < OPEN_PETALS || !petals.iter().all(outward) {
        return false;
    }
    let mut directions: Vec<f32> = petals.iter().map(|b| (b.tip - center).to_angle()).collect();
    directions.sort_by(f32::total_cmp);
    let around = directions.first().map(|first| first + std::f32::consts::TAU);
    let next = directions.iter().copied().skip(1).chain(around);
    directions.iter().zip(next).all(|(a, b)| b - a <= widest_gap)
}

impl Gathering {
    fn add_flower(&mut self, blades: Vec<Drawn<'_>>) {
        let center = center_of(&blades);
        let is_centre = |drawn: &Drawn<'_>| drawn.tool == Tool::Auto && drawn.roundness.is_centre(center);
        let (centres, petals): (Vec<Drawn<'_>>, Vec<Drawn<'_>>) = blades.into_iter().partition(is_centre);
        if petals.is_empty() {
            self.leaves.extend(centres.into_iter().map(|drawn| drawn.blade.clone()));
            return;
        }
        let center = center_of(&petals);
        let centre_radius = centres.iter().map(|drawn| drawn.roundness.radius()).reduce(f32::max);
        self.centres.extend(centres.iter().filter_map(|drawn| drawn.blade.stroke));
        let first = self.petals.len();
        self.petals.extend(petals.into_iter().map(|drawn| drawn.blade.clone()));
        let petals = (first..self.petals.len()).collect();
        self.flowers.push(FlatFlower { petals, center, centre_radius, attachment: None });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::Sample;

    fn blade(id: u64, root: Vec2, axis: Vec2) -> FlatBlade {
        let side = axis.perp() * 0.3;
        let outline = [root, root + axis * 0.5 + side, root + axis, root + axis * 0.5 - side]
            .map(|position| Sample { position, pressure: 0.5, tilt_deg: Vec2::ZERO });
        FlatBlade {
            stroke: Some(id),
            outline: outline.into(),
            root,
            tip: root + axis,
            copy_of: None,
            attachment: None,
        }
    }

    fn ring(first: u64, center: Vec2, count: usize, size: f32, tool: Tool) -> Vec<(FlatBlade, Tool)> {
        (0..count)
            .map(|k| {
                let out = Vec2::from_angle(k as f32 * std::f32::consts::TAU / count as f32);
                (blade(first + k as u64, center + out * size * 0.08, out * size), tool)
            })
            .collect()
    }

    #[test]
    fn flowers_of_three_scales_and_leaves() {
        let mut blades = ring(10, Vec2::ZERO, 13, 100.0, Tool::Auto);
        blades.extend(ring(40, Vec2::new(150.0, 0.0), 5, 20.0, Tool::Auto));
        blades.extend(ring(60, Vec2::new(180.0, 5.0), 6, 8.0, Tool::Auto));
        blades.push((blade(1, Vec2::new(0.0, 300.0), Vec2::new(60.0, -10.0)), Tool::Auto));
        blades.push((blade(2, Vec2::new(0.0, 310.0), Vec2::new(-60.0, -10.0)), Tool::Auto));
        let gathering = gather(blades, &[], &FlowerParams::default());
        let counts: Vec<usize> = gathering.flowers.iter().map(|f| f.petals.len()).collect();
        assert_eq!(counts, [13, 5, 6]);
        assert_eq!(gathering.leaves.len(), 2);
    }

    #[test]
    fn tools_win_over_counts() {
        let mut blades = ring(1, Vec2::ZERO, 4, 50.0, Tool::Leaf);
        blades.extend(ring(9, Vec2::new(500.0, 0.0), 2, 50.0, Tool::Petal));
        let gathering = gather(blades, &[], &FlowerParams::default());
        assert_eq!(gathering.leaves.len(), 4);
        assert_eq!(gathering.flowers.len(), 1);
        assert!(gathering.flowers[0].center.distance(Vec2::new(500.0, 0.0)) < 1e-3);
    }

    #[test]
    fn saying_petal_of_a_blade_changes_that_blade_only() {
        let stem = Stem { foot: Vec2::new(0.0, 400.0), tip: Vec2::new(0.0, -100.0) };
        let pair = ring(1, Vec2::ZERO, 2, 50.0, Tool::Auto);
        let rosette = ring(10, stem.foot, 5, 60.0, Tool::Auto);
        for drawn in [pair, rosette] {
            let before = gather(drawn.clone(), &[stem], &FlowerParams::default());
            assert!(before.flowers.is_empty() && before.leaves.len() == drawn.len());
            for said in 0..drawn.len() {
                let mut blades = drawn.clone();
                blades[said].1 = Tool::Petal;
                let after = gather(blades, &[stem], &FlowerParams::default());
                assert_eq!(after.petals, [drawn[said].0.clone()]);
                assert_eq!(after.leaves.len(), drawn.len() - 1);
            }
        }
        let mut open = open_flower();
        open[2].1 = Tool::Petal;
        let gathering = gather(open, &[], &FlowerParams::default());
        assert_eq!((gathering.flowers.len(), gathering.petals.len()), (1, 5));
    }

    #[test]
    fn saying_leaf_of_a_petal_leaves_the_others_petals() {
        for count in 3..6 {
            let mut blades = ring(1, Vec2::ZERO, count, 50.0, Tool::Auto);
            blades.extend(ring(20, Vec2::new(400.0, 0.0), 5, 50.0, Tool::Auto));
            for said in 0..count {
                blades[said].1 = Tool::Leaf;
                let gathering = gather(blades.clone(), &[], &FlowerParams::default());
                let of: Vec<usize> = gathering.flowers.iter().map(|flower| flower.petals.len()).collect();
                assert_eq!(gathering.leaves.len(), said + 1);
                assert_eq!(gathering.petals.len(), 5 + count - said - 1, "the rest of {count}: {of:?}");
            }
        }
        let mut open = open_flower();
        open[1].1 = Tool::Leaf;
        let gathering = gather(open, &[], &FlowerParams::default());
        assert_eq!((gathering.petals.len(), gathering.leaves.len()), (4, 1));
    }

    /// Five petals whose roots keep away from a drawn circle.
    fn open_flower() -> Vec<(FlatBlade, Tool)> {
        let mut blades: Vec<(FlatBlade, Tool)> = (0..5)
            .map(|k| {
                let out = Vec2::from_angle(k as f32 * std::f32::consts::TAU / 5.0);
                (blade(1 + k as u64, out * 40.0, out * 80.0), Tool::Auto)
            })
            .collect();
        let mut circle = blade(9, Vec2::new(30.0, 0.0), Vec2::new(-60.0, 0.0));
        for (k, sample) in (0..).zip(std::sync::Arc::make_mut(&mut circle.outline)) {
            sample.position = 30.0 * Vec2::from_angle(k as f32 * std::f32::consts::FRAC_PI_2);
        }
        blades.push((circle, Tool::Auto));
        blades
    }

    #[test]
    fn petals_around_an_open_centre_are_a_flower_and_the_circle_is_its_centre() {
        let gathering = gather(open_flower(), &[], &FlowerParams::default());
        assert_eq!(gathering.flowers.len(), 1);
        assert_eq!(gathering.flowers[0].petals.len(), 5);
        assert_eq!(gathering.centres, [9]);
        let radius = gathering.flowers[0].centre_radius.unwrap();
        assert!((20.0..32.0).contains(&radius), "{radius}");
    }

    #[test]
    fn leaves_along_a_stem_are_no_open_flower() {
        let leaves = (0..8).map(|k| {
            let side = if k % 2 == 0 { 1.0 } else { -1.0 };
            (blade(k, Vec2::new(0.0, -40.0 * k as f32), Vec2::new(80.0 * side, -50.0)), Tool::Auto)
        });
        let gathering = gather(leaves.collect(), &[], &FlowerParams::default());
        assert!(gathering.flowers.is_empty());
        assert_eq!(gathering.leaves.len(), 8);
    }

    #[test]
    fn scale_does_not_matter() {
        for scale in [0.1, 10.0] {
            let blades = ring(1, Vec2::ZERO, 7, 30.0 * scale, Tool::Auto);
            assert_eq!(gather(blades, &[], &FlowerParams::default()).flowers.len(), 1);
        }
    }

    #[test]
    fn blades_at_the_foot_of_a_stem_are_leaves_and_at_its_end_a_flower() {
        let (foot, tip) = (Vec2::new(0.0, 400.0), Vec2::ZERO);
        let stems = [Stem { foot, tip }];
        let mut blades = ring(1, tip, 8, 50.0, Tool::Auto);
        blades.extend(ring(20, foot, 5, 60.0, Tool::Auto));
        let found = gather(blades, &stems, &FlowerParams::default());
        assert_eq!((found.flowers.len(), found.petals.len(), found.leaves.len()), (1, 8, 5));
        let drawn = ring(1, foot, 5, 60.0, Tool::Petal);
        assert_eq!(gather(drawn, &stems, &FlowerParams::default()).flowers.len(), 1);
    }
}
