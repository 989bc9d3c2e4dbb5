//! The `d` of a path and the `points` of a polyline as Bézier elements (SVG 1.1, sections 8.3 and 9.6).
//!
//! As the specification asks, what stands before an error is kept. Arcs become cubics within [`ARC_TOLERANCE`] of their
//! own radius: svgtypes' and kurbo's own readers use a fixed 0.1, which is too coarse for drawings in millimetres.

use kurbo::{Affine, Arc, BezPath, PathEl, Point, SvgArc, Vec2};
use svgtypes::{NumberListParser, PathParser, PathSegment};

/// Largest distance between an arc and its cubics, as a fraction of the larger radius.
const ARC_TOLERANCE: f64 = 1e-5;

/// What could be read, and the error that ended it early.
pub(super) struct PathData {
    pub(super) path: BezPath,
    pub(super) error: Option<svgtypes::Error>,
}

/// Reads path data; stops after `most` elements or so.
pub(super) fn parse_path(d: &str, most: usize) -> PathData {
    let mut pen = Pen::default();
    let mut error = None;
    for segment in PathParser::from(d) {
        match segment {
            Ok(segment) => pen.draw(segment),
            Err(e) => error = Some(e),
        }
        if pen.elements.len() > most {
            break;
        }
    }
    PathData { path: BezPath::from_vec(pen.elements), error }
}

/// Reads a list of points; stops after `most` of them.
pub(super) fn parse_points(points: &str, closed: bool, most: usize) -> PathData {
    let mut elements = Vec::new();
    let mut error = None;
    let mut numbers = NumberListParser::from(points);
    while let Some(x) = numbers.next() {
        // SVG asks to pass over a last number without partner.
        let Some(y) = numbers.next() else { break };
        match x.and_then(|x| Ok(Point::new(x, y?))) {
            Ok(point) if elements.is_empty() => elements.push(PathEl::MoveTo(point)),
            Ok(point) => elements.push(PathEl::LineTo(point)),
            Err(e) => error = Some(e),
        }
        if elements.len() > most {
            break;
        }
    }
    if closed && !elements.is_empty() {
        elements.push(PathEl::ClosePath);
    }
    PathData { path: BezPath::from_vec(elements), error }
}

/// What the next smooth command mirrors.
#[derive(Clone, Copy, Default, PartialEq)]
enum LastCurve {
    #[default]
    None,
    Quadratic(Point),
    Cubic(Point),
}

/// Where path data has drawn to.
#[derive(Default)]
pub(super) struct Pen {
    elements: Vec<PathEl>,
    start: Point,
    at: Point,
    last: LastCurve,
    closed: bool,
}

impl Pen {
    fn draw(&mut self, segment: PathSegment) {
        let origin = if segment.is_abs() { Vec2::ZERO } else { self.at.to_vec2() };
        let point = |x: f64, y: f64| Point::new(x, y) + origin;
        match segment {
            PathSegment::MoveTo { x, y, .. } => self.move_to(point(x, y)),
            PathSegment::ClosePath { .. } => self.close(),
            PathSegment::LineTo { x, y, .. } => self.line_to(point(x, y)),
            PathSegment::HorizontalLineTo { x, .. } => self.line_to(Point::new(x + origin.x, self.at.y)),
            PathSegment::VerticalLineTo { y, .. } => self.line_to(Point::new(self.at.x, y + origin.y)),
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                self.cubic_to(point(x1, y1), point(x2, y2), point(x, y));
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let mirrored = match self.last {
                    LastCurve::Cubic(control) => self.at + (self.at - control),
                    _ => self.at,
                };
                self.cubic_to(mirrored, point(x2, y2), point(x, y));
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => self.quadratic_to(point(x1, y1), point(x, y)),
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let mirrored = match self.last {
                    LastCurve::Quadratic(control) => self.at + (self.at - control),
                    _ => self.at,
                };
                self.quadratic_to(mirrored, point(x, y));
            }
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                let radii = Vec2::new(rx, ry);
                let x_rotation = x_axis_rotation.to_radians();
                self.arc_to(SvgArc { from: self.at, to: point(x, y), radii, x_rotation, large_arc, sweep });
            }
        }
    }

    pub(super) fn at(&self) -> Point {
        self.at
    }

    pub(super) fn finish(self) -> BezPath {
        BezPath::from_vec(self.elements)
    }

    pub(super) fn move_to(&mut self, to: Point) {
        // A move that another move follows draws nothing.
        if let Some(PathEl::MoveTo(_)) = self.elements.last() {
            self.elements.pop();
        }
        self.elements.push(PathEl::MoveTo(to));
        (self.start, self.at, self.last, self.closed) = (to, to, LastCurve::None, false);
    }

    pub(super) fn close(&mut self) {
        if !self.closed {
            self.elements.push(PathEl::ClosePath);
        }
        (self.at, self.last, self.closed) = (self.start, LastCurve::None, true);
    }

    /// Adds a drawing element; after a closed subpath a new one begins at the same start.
    fn push(&mut self, element: PathEl, to: Point, last: LastCurve) {
        if self.closed {
            self.elements.push(PathEl::MoveTo(self.start));
        }
        self.elements.push(element);
        (self.at, self.last, self.closed) = (to, last, false);
    }

    pub(super) fn line_to(&mut self, to: Point) {
        self.push(PathEl::LineTo(to), to, LastCurve::None);
    }

    fn quadratic_to(&mut self, control: Point, to: Point) {
        self.push(PathEl::QuadTo(control, to), to, LastCurve::Quadratic(control));
    }

    fn cubic_to(&mut self, first: Point, second: Point, to: Point) {
        self.push(PathEl::CurveTo(first, second, to), to, LastCurve::Cubic(second));
    }

    pub(super) fn arc_to(&mut self, svg_arc: SvgArc) {
        let to = svg_arc.to;
        let Some((arc, back)) = unit_scaled(&svg_arc) else { return self.line_to(to) };
        arc.to_cubic_beziers(arc.radii.x.max(arc.radii.y) * ARC_TOLERANCE, |p1, p2, p3| {
            self.cubic_to(back * p1, back * p2, back * p3);
        });
        // Rounding must not open a gap to where the next command starts.
        if let Some(PathEl::CurveTo(_, _, end)) = self.elements.last_mut() {
            *end = to;
        }
        (self.at, self.last) = (to, LastCurve::None);
    }
}

/// The arc scaled to radius 1, and the way back: kurbo takes radii below 1e-5 for straight lines.
fn unit_scaled(arc: &SvgArc) -> Option<(Arc, Affine)> {
    let radius = arc.radii.x.abs().max(arc.radii.y.abs());
    let scale = radius.recip();
    if !scale.is_finite() || scale == 0.0 {
        return None;
    }
    let to = ((arc.to - arc.from) * scale).to_point();
    let scaled = SvgArc { from: Point::ZERO, to, radii: arc.radii * scale, ..*arc };
    let is_sound = |a: &Arc| a.radii.is_finite() && a.sweep_angle.is_finite() && a.sweep_angle != 0.0;
    let arc_at_unit = Arc::from_svg_arc(&scaled).filter(is_sound)?;
    Some((arc_at_unit, Affine::translate(arc.from.to_vec2()) * Affine::scale(radius)))
}
