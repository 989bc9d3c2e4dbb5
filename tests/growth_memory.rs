//! Memory of growth at its peak, counted by the allocator: markers of space, and the plant that takes them.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::Vec3;
use peak_alloc::PeakAlloc;
use penstemon::growth::habit::Resource;
use penstemon::growth::{Envelope, Field, Habit, Limits, Simulation};

#[global_allocator]
static COUNTER: PeakAlloc = PeakAlloc;

/// Side of a box that holds a million markers of the default habit, metres.
const SIDE: f32 = 24.0;
/// Most bytes for a marker, and for an internode.
const MOST: (usize, usize) = (200, 500);

#[test]
fn a_million_markers_and_their_plant_stay_within_their_bytes() {
    let half = Vec3::new(0.5 * SIDE, 0.0, 0.5 * SIDE);
    let envelope = Envelope::Box { low: -half, high: half + Vec3::Y * SIDE };
    let habit = Habit { resource: Resource::Space, height: SIDE, ..Habit::default() };
    let before = COUNTER.current_usage();
    COUNTER.reset_peak_usage();
    let mut simulation = Simulation::in_envelope(&habit, envelope, 1, Limits::default());
    let strewn = COUNTER.peak_usage() - before;
    let Field::Space(markers) = simulation.field() else { panic!("the habit competes for space") };
    let markers = markers.len();
    let held = COUNTER.current_usage();
    COUNTER.reset_peak_usage();
    simulation.grow_to(200, &|| false);
    let (grown, internodes) = (COUNTER.peak_usage() - held, simulation.tree().len());
    let each = (strewn / markers, grown / internodes);
    eprintln!("{markers} markers: {} bytes each; {internodes} internodes: {} bytes each", each.0, each.1);
    assert!(markers > 900_000 && internodes > 200_000, "{markers} markers, {internodes} internodes");
    assert!(each.0 <= MOST.0, "{} bytes for each of {markers} markers", each.0);
    assert!(each.1 <= MOST.1, "{} bytes for each of {internodes} internodes", each.1);
}
