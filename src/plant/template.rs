//! Templates of blades: what all copies of one petal, leaf or sepal have in common, stored once in the plant.
//!
//! A blade names its template by its place in the plant's [`Templates`](super::Templates). Where a blade was drawn it is the
//! only copy of its template; generated leaves, sepals and the petals of blossom are many copies of a few.
//!
//! The outline of a template is a simple polygon and runs counter-clockwise: [`Template::new`] makes one of any outline, in
//! which crossings are cut as `geom::simple_loop` does it.

use crate::geom::{convex_hull::convex_hull, simple_loop};
use glam::Vec2;
use serde::Serialize;

/// With how much effort blades are made: how finely they are meshed, and whether each has a form of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Detail {
    /// As finely as it was drawn and with a form of its own: for blades of which each is looked at.
    Full,
    /// Finely enough to bend, all of one outline alike: for the petals of full flowers.
    Moderate,
    /// Of few points and in a few forms, of which all copies of one are one mesh: for many small blades.
    Reduced,
}

impl Detail {
    /// Whether all blades of a template have one triangulation, so that those of one form are copies of one mesh.
    pub fn is_shared(self) -> bool {
        self != Self::Full
    }
}

/// What the copies of one blade have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct Template {
    outline: Box<[Vec2]>,
    curl: Box<[f32]>,
    length: f32,
    detail: Detail,
}

impl Template {
    /// A template with this outline, or if that crosses itself with what is left of it without crossings. `curl` has a value
    /// for each point of the outline, or none at all; `length` is more than 0.
    pub fn new(outline: Vec<Vec2>, curl: Vec<f32>, length: f32, detail: Detail) -> Self {
        let is_simple = simple_loop::is_simple(&outline);
        let (mut outline, mut curl) = if is_simple { (outline, curl) } else { untangled(&outline, &curl) };
        if simple_loop::signed_area(outline.iter().copied()) < 0.0 {
            outline.reverse();
            curl.reverse();
        }
        Self { outline: outline.into(), curl: curl.into(), length, detail }
    }

    /// The same outline for copies of reduced detail.
    #[must_use]
    pub fn reduced(&self) -> Self {
        Self { detail: Detail::Reduced, ..self.clone() }
    }

    /// Closed outline in (u, v), base at the origin: a simple polygon, counter-clockwise, first point not repeated. Metres,
    /// where u and v of the copy have unit length.
    pub fn outline(&self) -> &[Vec2] {
        &self.outline
    }

    /// Pen pressure's curl at each outline point, −1 (away from the face) to 1 (toward it), 0 for none; empty for none.
    pub fn curl(&self) -> &[f32] {
        &self.curl
    }

    /// Distance from base to tip along v, in the unit of the outline, positive.
    pub fn length(&self) -> f32 {
        self.length
    }

    /// With how much effort its copies are made.
    pub fn detail(&self) -> Detail {
        self.detail
    }

    /// Checks the outline and its numbers.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self) -> Result<(), String> {
        let Self { outline, curl, length, detail: _ } = self;
        let problem = if outline.len() < 3 {
            "outline of fewer than three points"
        } else if !outline.iter().all(|point| point.is_finite()) {
            "outline not finite"
        } else if !simple_loop::is_simple(outline) {
            "outline crosses itself"
        } else if simple_loop::signed_area(outline.iter().copied()) < 0.0 {
            "outline runs clockwise"
        } else if !curl.is_empty() && curl.len() != outline.len() {
            "curl and outline differ in number"
        } else if !curl.iter().all(|curl| (-1.0..=1.0).contains(curl)) {
            "curl out of range"
        } else if !(length.is_finite() && *length > 0.0) {
            "length not positive"
        } else {
            return Ok(());
        };
        Err(problem.to_owned())
    }
}

/// The outline without its crossings: its largest simple part, or else its convex hull. Of an outline without area three
/// points are left.
fn untangled(outline: &[Vec2], curl: &[f32]) -> (Vec<Vec2>, Vec<f32>) {
    let curl_at = |i: usize| curl.get(i).copied().unwrap_or(0.0);
    let points: Vec<(Vec2, f32)> = outline.iter().enumerate().map(|(i, at)| (*at, curl_at(i))).collect();
    let between =
        |a: &(Vec2, f32), b: &(Vec2, f32), share: f32| (a.0.lerp(b.0, share), a.1 + (b.1 - a.1) * share);
    let is_usable = |points: &[(Vec2, f32)]| {
        let flat: Vec<Vec2> = points.iter().map(|point| point.0).collect();
        flat.len() >= 3 && simple_loop::is_simple(&flat)
    };
    let mut simple = simple_loop::make_simple(points.clone(), |point| point.0, between);
    if !is_usable(&simple) {
        simple = convex_hull(&points, |point| point.0);
    }
    if !is_usable(&simple) {
        simple = points;
        simple.truncate(3);
    }
    let (outline, own_curl): (Vec<Vec2>, Vec<f32>) = simple.into_iter().unzip();
    (outline, if curl.is_empty() { Vec::new() } else { own_curl })
}

/// The place of a template among those of its plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TemplateId(pub(super) u32);

impl TemplateId {
    /// The place as an index into lists that have one entry for each template.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn template(outline: &[(f32, f32)], curl: &[f32]) -> Template {
        let outline = outline.iter().copied().map(Vec2::from).collect();
        let template = Template::new(outline, curl.to_vec(), 1.0, Detail::Full);
        assert_eq!(template.check_invariants(), Ok(()));
        template
    }

    #[test]
    fn a_clockwise_outline_is_turned_with_its_curl() {
        let turned = template(&[(0.0, 0.0), (-1.0, 0.5), (0.0, 1.0), (1.0, 0.5)], &[0.0, 0.1, 0.2, 0.3]);
        assert_eq!(turned.outline()[0], Vec2::new(1.0, 0.5));
        assert_eq!(turned.curl(), [0.3, 0.2, 0.1, 0.0]);
    }

    #[test]
    fn what_crosses_itself_keeps_its_larger_part() {
        let bow = template(&[(0.0, 0.0), (0.4, 0.0), (-1.0, 1.5), (1.0, 1.5)], &[0.0, 0.0, 1.0, 1.0]);
        assert!(bow.outline().len() == bow.curl().len() && bow.outline().iter().all(|point| point.y > 0.2));
        let flat = template(&[(0.0, 0.0), (0.0, 1.0), (0.0, 0.5), (0.0, 2.0)], &[]);
        assert!(flat.outline().len() >= 3 && flat.curl().is_empty());
    }

    #[test]
    fn what_is_wrong_is_named() {
        let sound = template(&[(0.0, 0.0), (1.0, 0.5), (0.0, 1.0), (-1.0, 0.5)], &[]);
        let points = sound.outline.to_vec();
        let crossed = [points[0], points[2], points[1], points[3]];
        let turned: Box<[Vec2]> = points.iter().rev().copied().collect();
        let spoilt = [
            (Template { outline: crossed.into(), ..sound.clone() }, "crosses"),
            (Template { outline: turned, ..sound.clone() }, "clockwise"),
            (Template { outline: points[..2].into(), ..sound.clone() }, "three"),
            (Template { curl: [0.0].into(), ..sound.clone() }, "number"),
            (Template { length: 0.0, ..sound.clone() }, "length"),
        ];
        for (template, word) in spoilt {
            assert!(template.check_invariants().unwrap_err().contains(word), "{word}");
        }
    }

    proptest! {
        #[test]
        fn any_outline_becomes_sound(corners in prop::collection::vec((-1.0f32..1.0, -1.0f32..1.0), 3..60)) {
            let outline: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
            let curl = outline.iter().map(|point| point.x).collect();
            let template = Template::new(outline, curl, 1.0, Detail::Full);
            prop_assert_eq!(template.check_invariants(), Ok(()));
        }
    }
}
