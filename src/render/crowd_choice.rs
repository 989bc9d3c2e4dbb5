//! In which form each plant of a garden is drawn, and in which order, for a camera: no GPU is needed for it.
//!
//! A form is the coarsest whose pixels are as many as the plant is wide ([`Sight`]). The plants of a form stand next to one another,
//! those inside of the picture first: a counting sort. Plants are judged side by side on all processor cores; a few nanoseconds for
//! each. Plants of one form keep their order, so that the result does not depend on the number of threads.
//!
//! Limits: forms change at once, without a cross-fade.

use super::RenderError;
use super::sight::Sight;
use crate::garden::stock::Individual;
use crate::garden::{Place, Stock};
use glam::{Quat, Vec3};
use rayon::prelude::*;
use std::ops::Range;

/// So many plants are judged by one thread at a time.
const AT_ONCE: usize = 4096;

/// A plant as the choice knows it: its individual, counted through all kinds, and the sphere around it.
struct Plant {
    individual: u32,
    centre: Vec3,
    radius: f32,
    rotation: Quat,
}

/// The forms of an individual, the finest first, those from one side each last.
struct Ladder {
    /// The number of the first among all forms.
    first: u32,
    /// Up to which widths the others do, pixels.
    pixels: Vec<f32>,
    /// Toward the viewer, for those from one side each.
    sides: Vec<Vec3>,
    /// Up to which width these do.
    side_pixels: f32,
}

impl Ladder {
    fn new(first: u32, Individual { coarser, views, .. }: &Individual) -> Self {
        Self {
            first,
            pixels: coarser.iter().map(|form| form.pixels).collect(),
            sides: views.forms.iter().map(|(toward, _)| *toward).collect(),
            side_pixels: views.pixels,
        }
    }

    /// The form for a plant that is so wide, with the viewer in this direction from it.
    fn form(&self, width: f32, toward: impl Fn() -> Vec3) -> u32 {
        let of_all_sides = self.first + self.pixels.partition_point(|pixels| width <= *pixels) as u32;
        if width > self.side_pixels {
            return of_all_sides;
        }
        let toward = toward();
        let sides = self.sides.iter().map(|side| side.dot(toward)).zip(0..);
        let nearest = sides.max_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or(of_all_sides, |(_, side)| self.first + 1 + self.pixels.len() as u32 + side)
    }
}

/// Where the plants of a form are in the table: all, and those inside of the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// All.
    pub all: Range<u32>,
    /// Those inside of the picture.
    pub in_view: Range<u32>,
}

/// The choice for the plants of a garden, and what it was last.
pub struct CrowdChoice {
    plants: Vec<Plant>,
    ladders: Vec<Ladder>,
    forms: usize,
    /// For each plant twice the number of its form, and one more where it is outside of the picture.
    chosen: Vec<u32>,
    /// Where the next choice is put together.
    next: Vec<u32>,
    order: Vec<u32>,
}

impl CrowdChoice {
    /// The plants of a garden, of which none has a form yet.
    ///
    /// # Errors
    /// A place for an individual that does not exist.
    pub fn new(stock: &Stock, places: &[Place]) -> Result<Self, RenderError> {
        let individuals = || stock.kinds.iter().flat_map(|kind| &kind.individuals);
        let mut forms = 0;
        let ladder = |individual: &Individual| {
            let first = forms;
            forms += individual.forms().count();
            Ladder::new(first as u32, individual)
        };
        let ladders = individuals().map(ladder).collect();
        let plants = plants(stock, places)?;
        Ok(Self { plants, ladders, forms, chosen: Vec::new(), next: Vec::new(), order: Vec::new() })
    }

    /// Chooses for every plant the form in which a camera sees it. Gives the plants in the order of their forms, and for each form
    /// where they are in it; nothing where all is as it was.
    pub fn choose(&mut self, sight: &Sight) -> Option<(&[u32], Vec<Rows>)> {
        let ladders = &self.ladders;
        let choice = |plant: &Plant| {
            let Plant { individual, centre, radius, rotation } = *plant;
            let toward = || rotation.inverse() * sight.viewer_from(centre);
            let form = ladders[individual as usize].form(sight.width(centre, radius), toward);
            2 * form + u32::from(!sight.sees(centre, radius))
        };
        self.plants.par_iter().with_min_len(AT_ONCE).map(choice).collect_into_vec(&mut self.next);
        if self.next == self.chosen {
            return None;
        }
        std::mem::swap(&mut self.chosen, &mut self.next);
        let ends = order(&self.chosen, 2 * self.forms, &mut self.order);
        let (ends, _) = ends.as_chunks::<2>();
        let mut begin = 0;
        let rows = |[seen, end]: &[u32; 2]| {
            let rows = Rows { all: begin..*end, in_view: begin..*seen };
            begin = *end;
            rows
        };
        let rows = ends.iter().map(rows).collect();
        Some((&self.order, rows))
    }
}

/// What the choice knows of each plant.
fn plants(stock: &Stock, places: &[Place]) -> Result<Vec<Plant>, RenderError> {
    let individuals = stock.kinds.iter().map(|kind| kind.individuals.len());
    let firsts: Vec<usize> =
        individuals.scan(0, |sum, count| Some(std::mem::replace(sum, *sum + count))).collect();
    let spheres: Vec<(Vec3, f32)> =
        stock.kinds.iter().flat_map(|kind| kind.individuals.iter().map(sphere)).collect();
    let of_place = |place: &Place| {
        let individual = firsts.get(place.kind as usize)? + place.variant as usize;
        let (centre, radius) = *spheres.get(individual)?;
        Some(Plant {
            individual: individual as u32,
            centre: place.point(centre),
            radius: radius * place.scale,
            rotation: place.rotation,
        })
    };
    let unknown = || RenderError::model("garden", "a plant is a copy of an individual that does not exist");
    places.iter().map(|place| of_place(place).ok_or_else(unknown)).collect()
}

/// A sphere around an individual, around the middle of its box.
fn sphere(individual: &Individual) -> (Vec3, f32) {
    let points = || individual.surfaces.iter().flat_map(|surface| surface.mesh.points.iter().copied());
    let bounds = points().map(|point| (point, point)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let centre = bounds.map_or(Vec3::ZERO, |(low, high)| low.midpoint(high));
    (centre, points().map(|point| point.distance(centre)).fold(0.0, f32::max))
}

/// The numbers of the elements by rising bucket, in their order within each. Returns where each bucket ends.
fn order(bucket_of: &[u32], buckets: usize, order: &mut Vec<u32>) -> Vec<u32> {
    let mut next = vec![0; buckets];
    bucket_of.iter().for_each(|bucket| next[*bucket as usize] += 1);
    let mut begin = 0;
    for count in &mut next {
        begin += std::mem::replace(count, begin);
    }
    order.resize(bucket_of.len(), 0);
    for (element, bucket) in (0..).zip(bucket_of) {
        let place = &mut next[*bucket as usize];
        order[*place as usize] = element;
        *place += 1;
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garden::{Coarser, Views};

    #[test]
    fn the_coarsest_form_that_is_fine_enough_is_chosen() {
        let individual = |coarser: &[f32], sides: &[Vec3]| Individual {
            coarser: coarser.iter().map(|pixels| Coarser { form: Vec::new(), pixels: *pixels }).collect(),
            views: Views { forms: sides.iter().map(|side| (*side, Vec::new())).collect(), pixels: 20.0 },
            ..Individual::default()
        };
        let ladder = Ladder::new(7, &individual(&[200.0, 100.0, 50.0], &[Vec3::X, Vec3::Z, Vec3::Y]));
        let forms =
            [1000.0, 200.5, 200.0, 101.0, 99.0, 51.0, 21.0].map(|width| ladder.form(width, || Vec3::X));
        assert_eq!(forms, [7, 7, 8, 8, 9, 9, 10]);
        let toward = [Vec3::new(0.9, 0.2, 0.1), Vec3::new(0.3, 0.2, 0.7), Vec3::Y, Vec3::NEG_X];
        let sides = toward.map(|toward| ladder.form(3.0, || toward) - 7);
        assert_eq!(sides[..3], [4, 5, 6]);
        assert!((5..=6).contains(&sides[3]), "whichever is not opposite");
        assert_eq!(Ladder::new(3, &individual(&[], &[])).form(1.0, || Vec3::X), 3);
    }

    #[test]
    fn elements_are_ordered_by_their_buckets_and_stay_in_order_within_them() {
        let mut found = Vec::new();
        assert_eq!(order(&[2, 0, 2, 4, 0, 2], 5, &mut found), [2, 2, 5, 5, 6]);
        assert_eq!(found, [1, 4, 0, 2, 5, 3]);
        assert_eq!((order(&[], 2, &mut found), found), (vec![0, 0], vec![]));
    }
}
