//! Species that a drawing which names none may be of: by number, shape and arrangement of its petals and leaves (000 §6.1.1).
//!
//! The species in question are data: how many petals their flowers have, how wide these are against their length, how far
//! flowers open, whether many stand on one stem, how slender leaves are. What lies in a range speaks for a species, what lies outside of it
//! against it, the more the farther. Those that nothing speaks strongly against are proposed, the likeliest first.
//!
//! Limits: proposals only. What the plant is made of stays the same until the artist chooses; colours, the surest mark of many
//! species, are not drawn. Shapes of petals seen from the side are taken back on their cone first, with its error.

use crate::anatomy::Anatomy;
use crate::plant::{Flower, Organ, OrganKind, Plant, Shape};
use crate::sketch::{Remark, Sketch, Warning};

/// Most species that are proposed.
const MOST: usize = 3;
/// Mean square of the deviations, in units of what is usual in a range, up to which a species is proposed.
const LIKELY: f32 = 0.7;
/// How much worse than the likeliest a species may be that is proposed beside it.
const BESIDE: f32 = 0.35;
/// How far petals of one species are beyond their range at times: number as a share, width as a share of the length, opening in degrees,
/// slenderness of leaves.
const USUAL: [f32; 4] = [0.12, 0.12, 15.0, 0.15];

/// What is drawn of a species: ranges.
struct Marks {
    species: &'static str,
    /// Number of petals.
    petals: [f32; 2],
    /// Width of a petal against its length.
    width: [f32; 2],
    /// Angle between axis and petals, degrees.
    opening: [f32; 2],
    /// Width of a leaf against its length.
    leaf: [f32; 2],
    /// Most flowers that a stem carries side by side.
    together: usize,
}

#[rustfmt::skip]
const KNOWN: [Marks; 13] = [
    Marks { species: "daisy", petals: [12.0, 60.0], width: [0.08, 0.36], opening: [50.0, 88.0], leaf: [0.15, 0.55], together: 1 },
    Marks { species: "sunflower", petals: [16.0, 60.0], width: [0.2, 0.5], opening: [55.0, 88.0], leaf: [0.5, 1.0], together: 1 },
    Marks { species: "lily", petals: [6.0, 6.0], width: [0.2, 0.45], opening: [20.0, 60.0], leaf: [0.08, 0.25], together: 5 },
    Marks { species: "tulip", petals: [3.0, 6.0], width: [0.45, 0.8], opening: [8.0, 30.0], leaf: [0.12, 0.35], together: 1 },
    Marks { species: "poppy", petals: [4.0, 4.0], width: [0.8, 1.4], opening: [35.0, 80.0], leaf: [0.2, 0.5], together: 1 },
    Marks { species: "mallow", petals: [5.0, 5.0], width: [0.4, 0.75], opening: [40.0, 75.0], leaf: [0.7, 1.2], together: 4 },
    Marks { species: "oxalis", petals: [5.0, 5.0], width: [0.35, 0.7], opening: [30.0, 65.0], leaf: [0.7, 1.1], together: 8 },
    Marks { species: "plumeria", petals: [5.0, 5.0], width: [0.4, 0.75], opening: [45.0, 80.0], leaf: [0.25, 0.45], together: 12 },
    Marks { species: "jasmine", petals: [5.0, 5.0], width: [0.25, 0.5], opening: [40.0, 85.0], leaf: [0.3, 0.6], together: 12 },
    Marks { species: "cherry", petals: [5.0, 5.0], width: [0.7, 1.1], opening: [55.0, 85.0], leaf: [0.4, 0.65], together: 6 },
    Marks { species: "balloon_flower", petals: [5.0, 5.0], width: [0.5, 0.95], opening: [35.0, 75.0], leaf: [0.3, 0.55], together: 3 },
    Marks { species: "hepatica_blue", petals: [6.0, 10.0], width: [0.35, 0.7], opening: [40.0, 80.0], leaf: [0.7, 1.3], together: 1 },
    Marks { species: "foxglove", petals: [1.0, 5.0], width: [0.4, 0.9], opening: [8.0, 24.0], leaf: [0.25, 0.5], together: 60 },
];

/// What a drawing shows.
struct Seen {
    petals: f32,
    width: f32,
    opening: f32,
    leaf: Option<f32>,
    together: usize,
}

/// The remark that a drawing which names no species looks like some; none where it names one, or looks like none or like too many.
pub(super) fn proposal(sketch: &Sketch, anatomy: &Anatomy, plant: &Plant) -> Option<Warning> {
    if sketch.species.is_some() {
        return None;
    }
    let seen = Seen::of(anatomy, plant)?;
    let mut likely: Vec<(f32, &str)> = KNOWN.iter().map(|marks| (seen.off(marks), marks.species)).collect();
    likely.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (best, _) = *likely.first()?;
    likely.retain(|(off, _)| *off <= LIKELY && *off <= best + BESIDE);
    likely.truncate(MOST);
    let species: Vec<&str> = likely.into_iter().map(|(_, species)| species).collect();
    let remark = || Remark::LooksLike { species: species.join(", ") };
    (!species.is_empty()).then(|| Warning { stroke: None, remark: remark() })
}

impl Seen {
    fn of(anatomy: &Anatomy, plant: &Plant) -> Option<Self> {
        let mut petals: Vec<Vec<&Organ>> = vec![Vec::new(); plant.flowers.len()];
        for organ in plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal) {
            if let Some(flower) = organ.flower {
                petals[flower].push(organ);
            }
        }
        let width = |organ: &Organ, flower: &Flower| {
            let Shape::Blade(blade) = &organ.shape else { return None };
            let template = plant.templates.get(blade.template)?;
            let across = template.outline().iter().map(|p| p.x);
            let wide = across.clone().fold(0.0, f32::max) - across.fold(0.0, f32::min);
            // Seen along its surface a petal is narrower or shorter than it is: its flower's reach is its length.
            Some(wide * blade.u.length() / flower.reach.max(f32::MIN_POSITIVE))
        };
        let flowers: Vec<(&Flower, &[&Organ])> = plant
            .flowers
            .iter()
            .zip(petals.iter().map(Vec::as_slice))
            .filter(|(_, petals)| !petals.is_empty())
            .collect();
        let counts = flowers.iter().map(|(_, petals)| petals.len() as f32).collect();
        let widest = |(flower, petals): &(&Flower, &[&Organ])| {
            quantile(petals.iter().filter_map(|organ| width(organ, flower)).collect(), 0.75)
        };
        let widths = flowers.iter().filter_map(widest).collect();
        let openings = flowers.iter().map(|(flower, _)| flower.cone.opening_rad.to_degrees()).collect();
        let mut stems: Vec<usize> = flowers.iter().filter_map(|(flower, _)| flower.branch).collect();
        stems.sort_unstable();
        let together = stems.chunk_by(|a, b| a == b).map(<[usize]>::len).max().unwrap_or(1);
        let leaf = |leaf: &crate::anatomy::FlatBlade| {
            let axis = leaf.axis();
            let side = axis.perp() / axis.length_squared().max(f32::MIN_POSITIVE);
            let across = leaf.outline.iter().map(|s| (s.position - leaf.root).dot(side));
            across.clone().fold(0.0, f32::max) - across.fold(0.0, f32::min)
        };
        Some(Self {
            petals: quantile(counts, 0.5)?,
            width: quantile(widths, 0.5)?,
            opening: quantile(openings, 0.5)?,
            leaf: quantile(anatomy.leaves.iter().map(leaf).collect(), 0.5),
            together,
        })
    }

    /// How far it is from what is drawn of a species: the mean square of the deviations.
    fn off(&self, marks: &Marks) -> f32 {
        let beyond = |x: f32, [low, high]: [f32; 2]| (low - x).max(x - high).max(0.0);
        // A petal more or less of many means little, of few much.
        let petals = beyond(self.petals, marks.petals) / (USUAL[0] * self.petals.max(1.0));
        let width = beyond(self.width, marks.width) / USUAL[1];
        let opening = beyond(self.opening, marks.opening) / USUAL[2];
        let leaf = self.leaf.map_or(0.0, |leaf| beyond(leaf, marks.leaf) / USUAL[3]);
        let together = if self.together > marks.together { 1.0 } else { 0.0 };
        let squares = [petals, width, opening, leaf, together].map(|off| off * off);
        squares.iter().sum::<f32>() / squares.len() as f32
    }
}

/// The value below which a share of some lie; none of none.
fn quantile(mut values: Vec<f32>, share: f32) -> Option<f32> {
    values.sort_by(f32::total_cmp);
    values.get(((values.len() as f32 * share) as usize).min(values.len().saturating_sub(1))).copied()
}
