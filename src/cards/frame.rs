//! Where a cluster's cards lie.
//!
//! Their axis leads from the cluster's foot to the middle of its organs, or along its wood where these stand to all sides. The first card lies in the plane through that axis to which
//! most of the blades' area is turned, the second square to it. So leaves that lie level are seen as full from above and as thin from
//! aside as they are.

use super::clusters::{Cluster, extremes};
use crate::geom::simple_loop::area;
use crate::plant::{Plant, Shape};
use glam::{Mat3, Vec2, Vec3, Vec3Swizzles as _};

/// How much larger a card is than what it shows, share of its extent to each side: leaves are bent.
const MARGIN: f32 = 0.04;
/// Least extent to a side, share of the height.
const THINNEST: f32 = 0.02;

/// The middle of a cluster that is farther from its foot than this share of its spread tells its direction.
const ASIDE: f32 = 0.5;
/// By how much a shoot is scaled at most to stand for another.
const MOST_SCALED: f32 = 2.0;

/// From which side a card shows its cluster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// From where most of its leaves face.
    Wide,
    /// Square to that.
    Narrow,
}

impl Side {
    /// Both, in the order of their rows in the picture.
    pub(super) const ALL: [Self; 2] = [Self::Wide, Self::Narrow];
}

/// A box around a cluster: y its axis, z where its leaves face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    foot: Vec3,
    /// Columns are unit vectors, right-handed.
    axes: Mat3,
    low: Vec3,
    high: Vec3,
    /// Where, across its axis, its cards cross one another; in its middle if it does not say.
    crossing: Option<Vec2>,
}

impl Frame {
    /// That of a cluster; `None` for one without extent.
    pub(super) fn new(plant: &Plant, cluster: &Cluster) -> Option<Self> {
        let of_organs = cluster.organs.iter().flat_map(|&organ| extremes(plant, &plant.organs[organ]));
        let twigs = cluster.branches.iter().flat_map(|&branch| plant.branches[branch].points.iter().copied());
        let organs: Vec<Vec3> = of_organs.collect();
        let middle = organs.iter().sum::<Vec3>() / organs.len().max(1) as f32;
        let along = axis(cluster, (&organs, middle));
        let axes = axes(plant, cluster, (&organs, middle), along);
        Self::around(cluster.foot, axes, organs.iter().copied().chain(twigs))
    }

    /// An upright box around the whole plant; `None` for one without extent.
    pub(super) fn upright(plant: &Plant) -> Option<Self> {
        let wood = plant.branches.iter().flat_map(|branch| branch.points.iter().copied());
        let organs = plant.organs.iter().flat_map(|organ| extremes(plant, organ));
        let around = Self::around(Vec3::ZERO, Mat3::IDENTITY, wood.chain(organs))?;
        // The trunk is in both pictures: they cross where it stands, so that it is not seen twice.
        let (low, high) = (around.low.xz(), around.high.xz());
        let trunk = plant.branches.first().map(|trunk| trunk.points[0].xz().clamp(low, high));
        Some(Self { crossing: trunk, ..around })
    }

    /// The same box for other points.
    pub(super) fn around_points(&self, points: impl Iterator<Item = Vec3>) -> Option<Self> {
        Some(Self { crossing: self.crossing, ..Self::around(self.foot, self.axes, points)? })
    }

    fn around(foot: Vec3, axes: Mat3, points: impl Iterator<Item = Vec3>) -> Option<Self> {
        let points = points.map(|point| axes.transpose() * (point - foot));
        let (low, high) =
            points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let margin = ((high - low) * MARGIN).max(Vec3::splat(THINNEST * (high.y - low.y)));
        let is_sound = (high - low).is_finite() && high.y - low.y > 0.0;
        is_sound.then_some(Self { foot, axes, low: low - margin, high: high + margin, crossing: None })
    }

    /// The box of another cluster at the place of this one, so much larger or smaller that its wide side has the area of this one's.
    pub(super) fn of_shape(&self, other: &Self) -> Self {
        let area = |frame: &Self| (frame.high - frame.low).truncate().element_product();
        let scale = (area(self) / area(other)).sqrt().clamp(1.0 / MOST_SCALED, MOST_SCALED);
        let crossing = other.crossing.map(|crossing| crossing * scale);
        Self { low: other.low * scale, high: other.high * scale, crossing, ..*self }
    }

    /// Every number of it.
    pub(super) fn bits(&self) -> [u32; 18] {
        let Self { foot, axes, low, high, crossing: _ } = self;
        let rows = [*foot, axes.x_axis, axes.y_axis, axes.z_axis, *low, *high];
        std::array::from_fn(|i| rows[i / 3][i % 3].to_bits())
    }

    /// Thickness as a share of the width.
    pub(super) fn flatness(&self) -> f32 {
        let extent = self.high - self.low;
        extent.z / extent.x
    }

    /// Whether it is around a whole plant.
    pub(super) fn is_whole(&self) -> bool {
        self.crossing.is_some()
    }

    /// Middle of the lower edge, width and height of a card, metres.
    pub(super) fn card(&self, side: Side) -> (Vec3, Vec3, Vec3) {
        let (Mat3 { x_axis, y_axis, z_axis }, extent) = (self.axes, self.high - self.low);
        let middle = 0.5 * (self.low + self.high);
        let base = |x: f32, z: f32| self.foot + self.axes * Vec3::new(x, self.low.y, z);
        let (up, crossing) = (y_axis * extent.y, self.crossing.unwrap_or(middle.xz()));
        match side {
            Side::Wide => (base(middle.x, crossing.y), x_axis * extent.x, up),
            Side::Narrow => (base(crossing.x, middle.z), z_axis * extent.z, up),
        }
    }
}

/// The direction of a cluster: to its middle, or where leaves stand to all sides, so that this is near, along its wood.
fn axis(cluster: &Cluster, (points, middle): (&[Vec3], Vec3)) -> Vec3 {
    let way = middle - cluster.foot;
    let squares = points.iter().map(|point| point.distance_squared(middle)).sum::<f32>();
    let spread = (squares / points.len().max(1) as f32).sqrt();
    if way.length() > ASIDE * spread { way.normalize() } else { cluster.along }
}

/// Axes with y along the cluster and z where its blades face, each counted by its area; without any, square to where the points are
/// spread most.
fn axes(plant: &Plant, cluster: &Cluster, (points, middle): (&[Vec3], Vec3), along: Vec3) -> Mat3 {
    let (x, z) = along.any_orthonormal_pair();
    let flat = |way: Vec3| Vec2::new(way.dot(x), way.dot(z));
    let normals = cluster.organs.iter().filter_map(|&organ| match &plant.organs[organ].shape {
        Shape::Blade(blade) => {
            let normal = blade.u.cross(blade.v);
            let area = area(plant.templates[blade.template].outline()) * normal.length();
            Some(flat(normal.normalize_or_zero()) * area.sqrt())
        }
        _ => None,
    });
    let facing = principal(normals).or_else(|| {
        let spread = principal(points.iter().map(|point| flat(*point - middle)))?;
        Some(spread.perp())
    });
    let facing = facing.unwrap_or(Vec2::Y);
    let facing = (x * facing.x + z * facing.y).normalize();
    Mat3::from_cols(along.cross(facing), along, facing)
}

/// The direction in which vectors are longest, all together and whichever way they point; `None` if no direction stands out.
fn principal(vectors: impl Iterator<Item = Vec2>) -> Option<Vec2> {
    let moments = vectors.fold(Vec3::ZERO, |sum, p| sum + Vec3::new(p.x * p.x, p.y * p.y, p.x * p.y));
    let across = Vec2::new(moments.x - moments.y, 2.0 * moments.z);
    let stands_out = across.length() > 1e-3 * (moments.x + moments.y);
    stands_out.then(|| Vec2::from_angle(0.5 * across.to_angle()))
}
