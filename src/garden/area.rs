//! The ground plan of a garden: a rectangle or a polygon, and the paths that stay free.
//!
//! Plans are seen from above: x to the right, z toward the viewer, metres. A rectangle has its middle at the origin.
//!
//! Limits: a polygon has no holes; its edges do not cross.

use crate::geom::polyline;
use crate::geom::region::Region;
use crate::geom::simple_loop;
use glam::Vec2;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// Longest side of an area, metres: places beyond lose their digits.
pub const LONGEST: f32 = 20_000.0;
/// Most corners of an area, and of all paths together.
pub const MOST_CORNERS: usize = 10_000;
/// Share of its box that a polygon has to fill: the lattice is looked through in all of the box.
const LEAST_FILLED: f32 = 1e-3;

/// The ground that is planted.
#[derive(Debug)]
pub struct Area {
    region: Region,
    low: Vec2,
    high: Vec2,
    square_metres: f32,
    /// Whether it is all of its box.
    fills_box: bool,
}

impl Area {
    /// A rectangle of so many metres from left to right and from the far side to the near one.
    ///
    /// # Errors
    /// As [`Area::polygon`].
    pub fn rectangle(size: Vec2) -> Result<Self, String> {
        if !(size.min_element() > 0.0 && size.is_finite()) {
            return Err("the sides of an area are metres above 0, as in 40x25".to_owned());
        }
        let half = size / 2.0;
        Self::polygon(vec![-half, Vec2::new(half.x, -half.y), half, Vec2::new(-half.x, half.y)])
    }

    /// A polygon by its corners, either way round.
    ///
    /// # Errors
    /// What is wrong with it, and what to do.
    pub fn polygon(corners: Vec<Vec2>) -> Result<Self, String> {
        if !(3..=MOST_CORNERS).contains(&corners.len()) {
            return Err(format!("an area has 3 to {MOST_CORNERS} corners, this one {}", corners.len()));
        }
        if !corners.iter().all(|corner| corner.is_finite() && corner.abs().max_element() <= LONGEST) {
            return Err(format!("corners of an area are metres from -{LONGEST} to {LONGEST}"));
        }
        let (low, high) = polyline::bounds(corners.iter().copied());
        let square_metres = simple_loop::area(&corners);
        if square_metres < LEAST_FILLED * (high - low).element_product() || square_metres <= 0.0 {
            return Err(
                "the area is empty or a thin strip askew; give it corners around some ground".to_owned()
            );
        }
        if !simple_loop::is_simple(&corners) {
            return Err(
                "the edges of the area cross each other; list its corners in order around it".to_owned()
            );
        }
        let fills_box =
            corners.iter().all(|c| (c.x == low.x || c.x == high.x) && (c.y == low.y || c.y == high.y));
        let fills_box = fills_box && corners.len() == 4;
        Ok(Self { region: Region::new(corners), low, high, square_metres, fills_box })
    }

    /// Its corners.
    pub fn corners(&self) -> &[Vec2] {
        self.region.outline()
    }

    /// Smallest and largest corner.
    pub fn bounds(&self) -> (Vec2, Vec2) {
        (self.low, self.high)
    }

    /// How large it is.
    pub fn square_metres(&self) -> f32 {
        self.square_metres
    }

    /// Whether it is all of its box.
    pub fn fills_box(&self) -> bool {
        self.fills_box
    }

    /// Whether a point lies in it.
    pub fn contains(&self, p: Vec2) -> bool {
        p.cmpge(self.low).all() && p.cmplt(self.high).all() && (self.fills_box || self.region.contains(p))
    }

    /// How far a point is inside, metres; negative outside.
    pub fn depth(&self, p: Vec2) -> f32 {
        let distance = self.region.nearest_boundary(p).map_or(0.0, |(_, distance)| distance);
        if self.region.contains(p) { distance } else { -distance }
    }

    /// A point well inside: of a lattice over the box the one deepest inside, of several the one nearest to the box's middle.
    pub fn middle(&self) -> Vec2 {
        const STEPS: usize = 33;
        let share = |k: usize| (k as f32 + 0.5) / STEPS as f32;
        let lattice = (0..STEPS * STEPS).map(|k| Vec2::new(share(k % STEPS), share(k / STEPS)));
        let points = lattice.map(|p| self.low + (self.high - self.low) * p);
        let worth = |p: Vec2| self.depth(p) - 1e-2 * p.distance((self.low + self.high) / 2.0);
        points.max_by(|a, b| worth(*a).total_cmp(&worth(*b))).unwrap_or(self.low)
    }
}

/// An area as it is written, which can be one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outline(Vec<Vec2>);

impl Outline {
    /// The area; whoever made the outline has seen that there is one.
    ///
    /// # Errors
    /// As [`Area::polygon`].
    pub fn area(&self) -> Result<Area, String> {
        Area::polygon(self.0.clone())
    }
}

impl std::str::FromStr for Outline {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let explain = || "an area is written as WIDTHxDEPTH in metres, as in 40x25".to_owned();
        let (width, depth) = text.split_once('x').ok_or_else(explain)?;
        let number = |text: &str| text.trim().parse::<f32>().map_err(|_| explain());
        let area = Area::rectangle(Vec2::new(number(width)?, number(depth)?))?;
        Ok(Self(area.corners().to_vec()))
    }
}

impl<'de> Deserialize<'de> for Outline {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(
            untagged,
            expecting = "an area is \"WIDTHxDEPTH\" in metres or a list of corners [[x, z], …]"
        )]
        enum Written {
            Rectangle(String),
            Polygon(Vec<Vec2>),
        }
        let outline = match Written::deserialize(deserializer)? {
            Written::Rectangle(text) => text.parse(),
            Written::Polygon(corners) => Area::polygon(corners.clone()).map(|_| Self(corners)),
        };
        outline.map_err(D::Error::custom)
    }
}

/// Refuses a line that is too short or too long.
///
/// # Errors
/// What is wrong with it; `what` says what it is.
pub fn check_line(points: &[Vec2], what: &str) -> Result<(), String> {
    if !(2..=MOST_CORNERS).contains(&points.len()) {
        return Err(format!("{what} leads along 2 to {MOST_CORNERS} points, this one has {}", points.len()));
    }
    if !points.iter().all(|point| point.is_finite() && point.abs().max_element() <= LONGEST) {
        return Err(format!("points of {what} are metres from -{LONGEST} to {LONGEST}"));
    }
    Ok(())
}

/// A path, on which nothing grows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Path {
    points: Vec<Vec2>,
    half_width: f32,
}

impl Path {
    /// A path along points, so many metres wide.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn new(points: Vec<Vec2>, width: f32) -> Result<Self, String> {
        check_line(&points, "a path")?;
        if !(width > 0.0 && width <= LONGEST) {
            return Err("the width of a path is a number of metres above 0".to_owned());
        }
        Ok(Self { points, half_width: width / 2.0 })
    }

    /// Where it leads.
    pub fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// Half of its width, metres.
    pub fn half_width(&self) -> f32 {
        self.half_width
    }

    /// How far a point is beside the path, metres; negative on it.
    pub fn beside(&self, p: Vec2) -> f32 {
        polyline::nearest(&self.points, p).map_or(f32::INFINITY, |(distance, _)| distance) - self.half_width
    }
}

impl<'de> Deserialize<'de> for Path {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Written {
            points: Vec<Vec2>,
            width: f32,
        }
        let Written { points, width } = Written::deserialize(deserializer)?;
        Self::new(points, width).map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rectangle_lies_around_the_origin() {
        let area = "4x2.5".parse::<Outline>().unwrap().area().unwrap();
        assert_eq!(area.bounds(), (Vec2::new(-2.0, -1.25), Vec2::new(2.0, 1.25)));
        assert!((area.square_metres() - 10.0).abs() < 1e-4);
        assert!(area.contains(Vec2::new(1.9, 1.2)) && !area.contains(Vec2::new(2.1, 0.0)));
        assert!(area.middle().length() < 0.1 && (area.depth(Vec2::ZERO) - 1.25).abs() < 1e-5);
    }

    #[test]
    fn areas_that_are_none_are_refused_with_what_to_do() {
        let refused = |corners: &[[f32; 2]]| {
            Area::polygon(corners.iter().copied().map(Vec2::from).collect()).unwrap_err()
        };
        assert!(refused(&[[0.0, 0.0], [1.0, 0.0]]).contains("3 to"));
        assert!(refused(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]).contains("empty"));
        assert!(refused(&[[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 3.0]]).contains("cross"));
        assert!(refused(&[[0.0, 0.0], [f32::NAN, 0.0], [2.0, 1.0]]).contains("metres"));
        for text in ["", "4", "0x3", "-1x3", "nanx1", "1e9x3"] {
            assert!(text.parse::<Outline>().is_err(), "{text}");
        }
    }

    #[test]
    fn a_path_is_as_wide_as_it_says() {
        let path = Path::new(vec![Vec2::ZERO, Vec2::new(5.0, 0.0)], 2.0).unwrap();
        assert!((path.beside(Vec2::new(3.0, 1.5)) - 0.5).abs() < 1e-5);
        assert!(path.beside(Vec2::new(3.0, -0.5)) < 0.0);
        assert!(Path::new(vec![Vec2::ZERO], 1.0).is_err());
    }
}
