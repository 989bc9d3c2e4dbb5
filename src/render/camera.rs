//! Where the viewer stands: a named view, and the closest camera that sees the whole model in it.
//!
//! The fit is exact: of all cameras looking in one direction, the one whose frustum touches the model. In the camera's own axes
//! (right, up, back) a point is inside the right plane when `right + slope·back ≤ right₀ + slope·back₀` for a camera at
//! (right₀, up₀, back₀); the largest left side over all points gives the plane's position, and two opposite planes
//! give the camera's.

use super::studio;
use glam::{Mat4, Vec2, Vec3, Vec4, camera::rh::proj::directx as proj};

/// The side from which a plant is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// As it was drawn.
    #[default]
    Front,
    /// From its right.
    Side,
    /// From above, the drawing's back at the top.
    Top,
    /// From the front right and a little above.
    ThreeQuarter,
}

/// How depth shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// Near things are larger.
    #[default]
    Perspective,
    /// Parallel rays, exactly level in the front and side views: the front view is the drawing.
    Orthographic,
}

/// A view of a plant, framed automatically.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// The side from which it is seen.
    pub direction: Direction,
    /// How depth shows.
    pub projection: Projection,
    /// Further turn of the viewer around the plant in degrees, counter-clockwise from above: a turntable's frame.
    pub turn_deg: f32,
}

/// The viewer's axes in the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    pub(super) right: Vec3,
    pub(super) up: Vec3,
    /// Toward the viewer.
    pub(super) back: Vec3,
}

impl Axes {
    /// A viewer who stands `azimuth_deg` counter-clockwise from the front, seen from above, and looks down by
    /// `elevation_deg`.
    pub(super) fn at(azimuth_deg: f32, elevation_deg: f32) -> Self {
        let (sin, cos) = azimuth_deg.to_radians().sin_cos();
        let (sin_up, cos_up) = elevation_deg.to_radians().sin_cos();
        let right = Vec3::new(cos, 0.0, -sin);
        let back = Vec3::new(sin * cos_up, sin_up, cos * cos_up);
        Self { right, up: back.cross(right), back }
    }

    pub(super) fn view_from_world(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.right), v.dot(self.up), v.dot(self.back))
    }

    /// A vector given in the viewer's axes, in the world.
    pub(super) fn world_from_view(&self, v: Vec3) -> Vec3 {
        self.right * v.x + self.up * v.y + self.back * v.z
    }
}

impl View {
    /// Axes of a viewer who is turned like this view but looks level, as the studio's lamps stand.
    pub(super) fn level_axes(&self) -> Axes {
        Axes::at(self.azimuth_deg(), 0.0)
    }

    fn axes(&self) -> Axes {
        Axes::at(self.azimuth_deg(), self.elevation_deg())
    }

    pub(super) fn elevation_deg(&self) -> f32 {
        let level = match self.projection {
            Projection::Perspective => studio::LEVEL_ELEVATION_DEG,
            Projection::Orthographic => 0.0,
        };
        match self.direction {
            Direction::Front | Direction::Side => level,
            Direction::Top => 90.0,
            Direction::ThreeQuarter => studio::THREE_QUARTER_DEG.y,
        }
    }

    pub(super) fn azimuth_deg(&self) -> f32 {
        let azimuth_deg = match self.direction {
            Direction::Front | Direction::Top => 0.0,
            Direction::Side => 90.0,
            Direction::ThreeQuarter => studio::THREE_QUARTER_DEG.x,
        };
        azimuth_deg + self.turn_deg
    }

    /// The views of a turntable of `frames` pictures, beginning with this one.
    pub fn turntable(self, frames: u32) -> impl ExactSizeIterator<Item = View> {
        (0..frames).map(move |i| View { turn_deg: self.turn_deg + 360.0 * i as f32 / frames as f32, ..self })
    }
}

/// A placed camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Camera {
    /// World to clip space; depth 0 near, 1 far.
    pub(super) clip_from_world: Mat4,
    /// Position with w = 1, or direction to the viewer with w = 0.
    pub(super) eye: Vec4,
}

impl Camera {
    /// A camera at `eye` that sees from `depth.x` to `depth.y` metres in front of it; `half` holds the tangents of the half
    /// angles, or half width and half height in metres.
    pub(super) fn placed(axes: &Axes, eye: Vec3, half: Vec2, depth: Vec2, projection: Projection) -> Self {
        let rotation =
            Mat4::from_cols(axes.right.extend(0.0), axes.up.extend(0.0), axes.back.extend(0.0), Vec4::W)
                .transpose();
        let view_from_world = rotation * Mat4::from_translation(-eye);
        let (clip_from_view, eye) = match projection {
            Projection::Perspective => {
                (proj::perspective(2.0 * half.y.atan(), half.x / half.y, depth.x, depth.y), eye.extend(1.0))
            }
            Projection::Orthographic => (
                proj::orthographic(-half.x, half.x, -half.y, half.y, depth.x, depth.y),
                axes.back.extend(0.0),
            ),
        };
        Self { clip_from_world: clip_from_view * view_from_world, eye }
    }
}

/// A camera's place in the axes of any of the views that share it, relative to `pivot`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Framing {
    pub(super) pivot: Vec3,
    /// Centre of the picture: right and up in metres; for a perspective camera the eye's place.
    pub(super) centre: Vec2,
    /// Eye's distance in front of the pivot in metres; parallel cameras stand clear of the model.
    pub(super) distance: f32,
    /// Tangents of the half angles, or half width and half height in metres.
    pub(super) half: Vec2,
    /// Nearest and farthest point of the model, metres from the eye.
    depth: Vec2,
    projection: Projection,
}

/// Widest reach of the model over all views, along the normals of the four sides of the frustum.
struct Reach {
    low: Vec2,
    high: Vec2,
    back: Vec2,
}

impl Reach {
    fn of(points: &[Vec3], pivot: Vec3, views: &[Axes], slope: Vec2) -> Self {
        let (min, max) = (Vec2::splat(f32::INFINITY), Vec2::splat(f32::NEG_INFINITY));
        let mut reach = Self { low: min, high: max, back: Vec2::new(min.x, max.x) };
        for axes in views {
            for &point in points {
                let p = axes.view_from_world(point - pivot);
                let lean = slope * p.z;
                reach.low = reach.low.min(p.truncate() - lean);
                reach.high = reach.high.max(p.truncate() + lean);
                reach.back = Vec2::new(reach.back.x.min(p.z), reach.back.y.max(p.z));
            }
        }
        reach
    }
}

impl Framing {
    /// The closest camera that sees all `points` in every one of `views`, which must share a projection.
    /// `bounds` are the corners of the points' box, `aspect` is width over height.
    pub(super) fn new(points: &[Vec3], bounds: (Vec3, Vec3), views: &[View], aspect: f32) -> Self {
        let projection = views.first().copied().unwrap_or_default().projection;
        let views: Vec<Axes> = views.iter().map(View::axes).collect();
        Self::of(points, bounds, &views, projection, aspect)
    }

    /// The same for viewers given by their axes.
    pub(super) fn of(
        points: &[Vec3],
        bounds: (Vec3, Vec3),
        views: &[Axes],
        projection: Projection,
        aspect: f32,
    ) -> Self {
        let pivot = (bounds.0 + bounds.1) / 2.0;
        let size = (bounds.1 - bounds.0).length().max(1e-3);
        match projection {
            Projection::Perspective => Self::perspective(points, pivot, size, views, aspect),
            Projection::Orthographic => Self::orthographic(points, pivot, size, views, aspect),
        }
    }

    fn perspective(points: &[Vec3], pivot: Vec3, size: f32, views: &[Axes], aspect: f32) -> Self {
        let tan = (studio::FIELD_OF_VIEW_DEG / 2.0).to_radians().tan();
        let half = Vec2::new(tan * aspect, tan);
        let slope = half * (1.0 - studio::MARGIN);
        let reach = Reach::of(points, pivot, views, slope);
        let distances = (reach.high - reach.low) / (2.0 * slope);
        // A flat model seen edge-on must not end up touching the eye.
        let distance = distances.max_element().max(reach.back.y + 0.05 * size);
        let depth = Vec2::new(distance - reach.back.y, distance - reach.back.x);
        Self {
            pivot,
            centre: (reach.high + reach.low) / 2.0,
            distance,
            half,
            depth,
            projection: Projection::Perspective,
        }
    }

    fn orthographic(points: &[Vec3], pivot: Vec3, size: f32, views: &[Axes], aspect: f32) -> Self {
        let reach = Reach::of(points, pivot, views, Vec2::ZERO);
        let extent = (reach.high - reach.low) / (2.0 * (1.0 - studio::MARGIN));
        let height = extent.y.max(extent.x / aspect).max(0.01 * size);
        let distance = reach.back.y + size;
        let depth = Vec2::new(distance - reach.back.y, distance - reach.back.x);
        let half = Vec2::new(height * aspect, height);
        let centre = (reach.high + reach.low) / 2.0;
        Self { pivot, centre, distance, half, depth, projection: Projection::Orthographic }
    }

    /// The camera for one of the views.
    pub(super) fn camera(&self, view: &View) -> Camera {
        let axes = view.axes();
        let eye = self.pivot + axes.world_from_view(self.centre.extend(self.distance));
        let depth = self.depth * Vec2::new(0.5, 2.0);
        Camera::placed(&axes, eye, self.half, depth, self.projection)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of a lopsided box that does not stand on the origin.
    fn corners() -> Vec<Vec3> {
        let (lo, hi) = (Vec3::new(0.2, 0.0, -0.7), Vec3::new(0.9, 1.8, 0.1));
        (0..8).map(|i| Vec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), hi, lo)).collect()
    }

    fn clip_extent(views: &[View], aspect: f32) -> Vec2 {
        let points = corners();
        let framing = Framing::new(&points, (points[0], points[7]), views, aspect);
        views.iter().fold(Vec2::ZERO, |extent, view| {
            let camera = framing.camera(view);
            points.iter().fold(extent, |e, &p| {
                let clip = camera.clip_from_world.project_point3(p);
                assert!((0.0..=1.0).contains(&clip.z), "depth {} of {p}", clip.z);
                e.max(clip.truncate().abs())
            })
        })
    }

    #[test]
    fn every_view_fills_the_picture_up_to_its_margin() {
        let directions = [Direction::Front, Direction::Side, Direction::Top, Direction::ThreeQuarter];
        for direction in directions {
            for projection in [Projection::Perspective, Projection::Orthographic] {
                for aspect in [0.4, 1.0, 2.5] {
                    let extent = clip_extent(&[View { direction, projection, turn_deg: 0.0 }], aspect);
                    let fill = extent.max_element();
                    assert!((fill - 0.9).abs() < 1e-3, "{direction:?} {projection:?} {aspect}: {extent}");
                }
            }
        }
    }

    #[test]
    fn one_framing_holds_for_a_whole_turn() {
        let views: Vec<View> = View::default().turntable(12).collect();
        assert_eq!(views.len(), 12);
        let extent = clip_extent(&views, 1.3);
        assert!((extent.max_element() - 0.9).abs() < 1e-3, "{extent}");
    }

    #[test]
    fn the_front_view_keeps_right_and_up() {
        let points = corners();
        for projection in [Projection::Perspective, Projection::Orthographic] {
            let view = View { projection, ..View::default() };
            let camera = Framing::new(&points, (points[0], points[7]), &[view], 1.0).camera(&view);
            let at = |p| camera.clip_from_world.project_point3(p);
            let here = at(Vec3::new(0.5, 1.0, -0.3));
            assert!(at(Vec3::new(0.6, 1.0, -0.3)).x > here.x);
            assert!(at(Vec3::new(0.5, 1.1, -0.3)).y > here.y);
            assert!(at(Vec3::new(0.5, 1.0, -0.2)).z < here.z, "toward the viewer is nearer");
        }
    }

    #[test]
    fn a_single_point_has_a_camera() {
        let view = View::default();
        let camera = Framing::new(&[Vec3::ONE], (Vec3::ONE, Vec3::ONE), &[view], 1.0).camera(&view);
        assert!(camera.clip_from_world.is_finite());
        let seen = camera.clip_from_world.project_point3(Vec3::ONE);
        assert!(seen.abs().max_element() <= 1.0, "{seen}");
    }
}
