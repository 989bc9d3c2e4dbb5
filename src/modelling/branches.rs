//! Branches drawn in space become wood of the plant (001 §4.2).
//!
//! A stroke in space has places in the canvas frame with depths, which the world of the drawing turns into metres, so that a
//! drawing keeps its proportions whatever its height is set to. It is smoothed ([`super::curve`]), moved to what it grows
//! on ([`super::foothold`]), and as thick as a branch on the sheet would be: pipes, taper and pressure
//! ([`crate::depth::radii`]).
//!
//! Limits: what carries it is not made thicker for it; a stroke that ends in other wood does not grow together with that.

use super::curve::{SpaceSample, smoothed};
use super::foothold::{Boxes, Foothold};
use crate::depth::radii::{RadiusParams, along, pipes, width_of_pipes};
use crate::geom::polyline;
use crate::kept::{Kept, Same};
use crate::plant::{Branch, Origin, Plant, Provenance, Role, WoodPart};
use crate::sketch::{Remark, Stroke, StrokePoint, Warning};
use glam::Vec3;
use std::sync::Arc;

/// Shortest branch, as a share of the yardstick.
const SHORTEST: f32 = 0.005;

/// What is kept of the branches in space of one drawing for the next: their smooth lines, canvas pixels.
#[derive(Debug, Default)]
pub struct Cache(Kept<Same<Stroke>, Arc<[SpaceSample]>>);

impl Cache {
    /// For a single drawing, of which nothing is kept.
    pub fn for_one_build() -> Self {
        Self(Kept::for_one_call())
    }

    /// Forgets them: the drawing has none.
    pub fn forget(&mut self) {
        self.0.keep_only(|_| false);
    }
}

/// Adds the branches that strokes in space draw, in their order, each perhaps on one before it; `diagonal` is the yardstick
/// of thickness, canvas pixels. Remarks name strokes that are no branch.
pub fn add_branches(
    cache: &mut Cache,
    (plant, provenance): (&mut Plant, &mut Provenance),
    strokes: &[&Arc<Stroke>],
    diagonal: f32,
    params: &RadiusParams,
) -> Vec<Warning> {
    let lines = cache.0.made(
        strokes,
        |stroke, used| Same::of(stroke, used),
        |stroke| smoothed(&samples(stroke)).into(),
    );
    let mut boxes = Boxes::of(&plant.branches);
    let (first, mut pressures, mut remarks) = (plant.branches.len(), Vec::new(), Vec::new());
    for (stroke, line) in strokes.iter().zip(lines) {
        let arcs = polyline::arc_lengths(line.iter().map(|sample| sample.position));
        if arcs.last().is_none_or(|length| *length < SHORTEST * diagonal) {
            remarks.push(Warning { stroke: Some(stroke.id), remark: Remark::TooShort });
            continue;
        }
        let points = in_world(line, provenance);
        let foothold = Foothold::of(&boxes, &plant.branches, points[0]);
        let branch = branch(plant, provenance.record(Some(stroke.id)), points, foothold);
        pressures.push(line.iter().map(|sample| sample.pressure).collect());
        boxes.push(&branch);
        plant.branches.push(branch);
    }
    let scale = provenance.world_from_canvas.scale;
    thicken(&mut plant.branches, (first, &pressures), scale * diagonal, params);
    remarks
}

/// The samples of a stroke: where it was drawn, canvas pixels, and its depths.
fn samples(stroke: &Stroke) -> Vec<SpaceSample> {
    let sample = |point: &StrokePoint| SpaceSample {
        position: point.position.extend(point.depth),
        pressure: point.pressure,
    };
    stroke.points.iter().map(sample).collect()
}

/// Where the samples lie in the world.
fn in_world(line: &[SpaceSample], provenance: &Provenance) -> Vec<Vec3> {
    let world = provenance.world_from_canvas;
    let place = |sample: &SpaceSample| world.point_in_space(sample.position.truncate(), sample.position.z);
    line.iter().map(place).collect()
}

/// The branch along a line of at least two points, moved so that it begins on its foothold, or on the ground; thin as yet.
fn branch(plant: &Plant, origin: Origin, mut points: Vec<Vec3>, foothold: Option<Foothold>) -> Branch {
    let begin = points[0];
    let foot = foothold.map_or(begin.with_y(0.0), |foothold| foothold.place);
    points.iter_mut().for_each(|point| *point += foot - begin);
    points[0] = foot;
    let parent = foothold.map(|foothold| foothold.branch);
    let level = parent.map_or(0, |parent| plant.branches[parent].level + 1);
    let radii = vec![f32::MIN_POSITIVE; points.len()];
    Branch { origin, parent, level, points, radii, role: Role::of(WoodPart::Stem) }
}

/// Gives the branches from `first` on, drawn with these pressures, their radii, parents first.
fn thicken(
    branches: &mut [Branch],
    (first, pressures): (usize, &[Vec<f32>]),
    diagonal: f32,
    params: &RadiusParams,
) {
    let pipes = pipes(branches.iter().map(|branch| branch.parent));
    let most = pipes.iter().copied().max().unwrap_or(1);
    for (index, pressures) in (first..).zip(pressures) {
        let width = width_of_pipes((pipes[index], most), diagonal, params);
        let Branch { parent, ref points, .. } = branches[index];
        let parent_radius = parent.map(|parent| branches[parent].axis_at(points[0]).1);
        branches[index].radii = along(points, pressures, (width, parent_radius), diagonal, params);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::WorldFromCanvas;
    use glam::{Vec2, vec2};

    /// A sheet on which a metre is a thousand pixels, the ground at the bottom of a square of 1000.
    fn provenance() -> Provenance {
        Provenance::new(WorldFromCanvas { scale: 0.001, origin: vec2(500.0, 1000.0) })
    }

    /// A trunk of a metre in the middle, 2 cm thick at its foot.
    fn trunk(provenance: &mut Provenance) -> Plant {
        let points = (0..=10).map(|k| Vec3::Y * (0.1 * k as f32)).collect();
        let radii = (0..=10).map(|k| 0.02 - 0.001 * k as f32).collect();
        let (origin, role) = (provenance.record(Some(1)), Role::of(WoodPart::Stem));
        let trunk = Branch { origin, parent: None, level: 0, points, radii, role };
        Plant { branches: vec![trunk], ..Plant::default() }
    }

    /// A straight stroke in space, canvas pixels and depth.
    fn stroke(id: u64, from: (Vec2, f32), to: (Vec2, f32), pressure: f32) -> Arc<Stroke> {
        let point = |k: usize| {
            let share = k as f32 / 20.0;
            let depth = from.1 + (to.1 - from.1) * share;
            StrokePoint { pressure, depth, ..StrokePoint::at(from.0.lerp(to.0, share)) }
        };
        Arc::new(Stroke {
            id,
            tool: crate::sketch::Tool::SpaceBranch,
            points: (0..=20).map(point).collect(),
            brush: None,
        })
    }

    fn added(strokes: &[Arc<Stroke>]) -> (Plant, Provenance, Vec<Warning>) {
        let mut provenance = provenance();
        let mut plant = trunk(&mut provenance);
        let params = RadiusParams::default();
        let (cache, strokes) = (&mut Cache::for_one_build(), strokes.iter().collect::<Vec<_>>());
        let remarks = add_branches(cache, (&mut plant, &mut provenance), &strokes, 1000.0, &params);
        plant.check_invariants().unwrap();
        provenance.check_invariants(&plant).unwrap();
        (plant, provenance, remarks)
    }

    #[test]
    fn a_branch_toward_the_viewer_stands_on_the_trunk() {
        // It begins a little beside the trunk's axis, 40 cm up, and leads 30 cm toward the viewer.
        let toward = stroke(7, (vec2(505.0, 600.0), 0.0), (vec2(505.0, 560.0), 300.0), 0.5);
        let (plant, provenance, remarks) = added(&[toward]);
        assert_eq!(remarks, []);
        let branch = &plant.branches[1];
        assert_eq!((branch.parent, branch.level, provenance.stroke(branch.origin)), (Some(0), 1, Some(7)));
        assert!((branch.points[0] - Vec3::Y * 0.4).length() < 1e-5, "{}", branch.points[0]);
        let end = *branch.points.last().unwrap();
        assert!((end - Vec3::new(0.0, 0.44, 0.3)).length() < 1e-4, "moved to the axis: {end}");
        assert!(branch.radii.iter().all(|radius| *radius <= 0.92 * 0.016 + 1e-6));
        assert!(branch.radii[0] > *branch.radii.last().unwrap(), "it tapers");
    }

    #[test]
    fn pressure_is_thickness_and_branches_carry_branches() {
        let at = |x: f32, y: f32| vec2(500.0 + x, 1000.0 - y);
        let light = stroke(2, (at(0.0, 400.0), 0.0), (at(0.0, 500.0), 400.0), 0.3);
        let strong = stroke(2, (at(0.0, 400.0), 0.0), (at(0.0, 500.0), 400.0), 0.6);
        let on_it = stroke(3, (at(0.0, 450.0), 200.0), (at(200.0, 500.0), 200.0), 0.5);
        let (plant, ..) = added(&[strong.clone(), on_it.clone()]);
        assert_eq!((plant.branches[2].parent, plant.branches[2].level), (Some(1), 2));
        let parent_radius = plant.branches[1].radii.iter().copied().fold(0.0, f32::max);
        assert!(plant.branches[2].radii[0] <= 0.92 * parent_radius);
        let (lighter, ..) = added(&[light]);
        let (alone, ..) = added(&[strong]);
        assert!(alone.branches[1].radii[10] > 1.5 * lighter.branches[1].radii[10]);
        // Drawn in another order the twig stands on the trunk, for there is nothing else yet.
        let (other, ..) = added(&[on_it, stroke(2, (at(0.0, 400.0), 0.0), (at(0.0, 500.0), 400.0), 0.6)]);
        assert_eq!(other.branches[1].parent, Some(0));
    }

    #[test]
    fn what_is_no_branch_is_remarked_on_and_nothing_hangs_in_the_air() {
        let spot = Arc::new(Stroke {
            points: vec![StrokePoint::at(vec2(500.0, 600.0))],
            ..(*stroke(5, Default::default(), Default::default(), 0.5)).clone()
        });
        let tiny = stroke(6, (vec2(500.0, 600.0), 0.0), (vec2(501.0, 600.0), 0.0), 0.5);
        let far = stroke(8, (vec2(2500.0, 100.0), 900.0), (vec2(2600.0, 0.0), 900.0), 0.5);
        let (plant, _, remarks) = added(&[spot, tiny, far]);
        let about: Vec<_> = remarks.iter().map(|w| (w.stroke, w.remark.clone())).collect();
        assert_eq!(about, [(Some(5), Remark::TooShort), (Some(6), Remark::TooShort)]);
        assert!(
            (plant.branches[1].points[0] - Vec3::Y * 0.9).length() < 1e-5,
            "it is moved to the nearest wood"
        );
    }

    #[test]
    fn a_sheet_without_wood_gets_trunks() {
        let mut provenance = provenance();
        let mut plant = Plant::default();
        let strokes = [stroke(1, (vec2(400.0, 990.0), 50.0), (vec2(400.0, 500.0), 0.0), 0.5)];
        let (cache, params) = (&mut Cache::for_one_build(), RadiusParams::default());
        add_branches(cache, (&mut plant, &mut provenance), &[&strokes[0]], 1000.0, &params);
        plant.check_invariants().unwrap();
        let trunk = &plant.branches[0];
        assert_eq!((trunk.parent, trunk.points[0].y), (None, 0.0));
        assert!((trunk.radii[0] - 0.009).abs() < 1e-6, "as thick as a drawn trunk: {}", trunk.radii[0]);
        assert_ne!(trunk.origin, Origin::Generated);
    }
}
