//! Rectangles, circles, ellipses and lines as the paths that SVG says they are (SVG 1.1, chapter 9; SVG 2, section 10).

use super::path_data::Pen;
use super::viewport::{Axis, Lengths};
use kurbo::{BezPath, Point, SvgArc, Vec2};
use roxmltree::Node;

/// The outline of a basic shape in the element's own units: empty where its size is zero, and for other elements.
pub(super) fn outline(node: Node<'_, '_>, lengths: Lengths) -> BezPath {
    let given = |name: &str, axis| lengths.of(node, name, axis);
    let at =
        |[x, y]: [&str; 2]| Point::new(given(x, Axis::X).unwrap_or(0.0), given(y, Axis::Y).unwrap_or(0.0));
    // A radius of less than nothing counts as not given.
    let radius = |name: &str, axis| given(name, axis).filter(|radius| *radius >= 0.0);
    let [rx, ry] = [radius("rx", Axis::X), radius("ry", Axis::Y)];
    match node.tag_name().name() {
        "line" => line(at(["x1", "y1"]), at(["x2", "y2"])),
        "circle" => {
            let radius = radius("r", Axis::Both).unwrap_or(0.0);
            ellipse(at(["cx", "cy"]), Vec2::new(radius, radius))
        }
        "ellipse" => {
            let [rx, ry] = [rx.or(ry), ry.or(rx)].map(Option::unwrap_or_default);
            ellipse(at(["cx", "cy"]), Vec2::new(rx, ry))
        }
        "rect" => {
            let [rx, ry] = [rx.or(ry), ry.or(rx)].map(Option::unwrap_or_default);
            rectangle(at(["x", "y"]), at(["width", "height"]).to_vec2(), Vec2::new(rx, ry))
        }
        _ => BezPath::new(),
    }
}

fn line(from: Point, to: Point) -> BezPath {
    let mut pen = Pen::default();
    pen.move_to(from);
    pen.line_to(to);
    pen.finish()
}

/// From the right, through the bottom.
fn ellipse(center: Point, radii: Vec2) -> BezPath {
    let mut pen = Pen::default();
    if radii.x > 0.0 && radii.y > 0.0 {
        pen.move_to(center + Vec2::new(radii.x, 0.0));
        for to in [
            Vec2::new(0.0, radii.y),
            Vec2::new(-radii.x, 0.0),
            Vec2::new(0.0, -radii.y),
            Vec2::new(radii.x, 0.0),
        ] {
            quarter(&mut pen, center + to, radii);
        }
        pen.close();
    }
    pen.finish()
}

/// From the left of the upper side, to the right.
fn rectangle(corner: Point, size: Vec2, radii: Vec2) -> BezPath {
    let mut pen = Pen::default();
    if size.x <= 0.0 || size.y <= 0.0 {
        return pen.finish();
    }
    let round = Vec2::new(radii.x.min(size.x / 2.0), radii.y.min(size.y / 2.0));
    let is_round = round.x > 0.0 && round.y > 0.0;
    let round = if is_round { round } else { Vec2::ZERO };
    let [x, y] = [Vec2::new(round.x, 0.0), Vec2::new(0.0, round.y)];
    let corners = [(size.x, 0.0, -x, y), (size.x, size.y, -y, -x), (0.0, size.y, x, -y), (0.0, 0.0, y, x)];
    pen.move_to(corner + x);
    for (right, down, before, after) in corners {
        let at = corner + Vec2::new(right, down);
        pen.line_to(at + before);
        if is_round {
            quarter(&mut pen, at + after, round);
        }
    }
    pen.close();
    pen.finish()
}

/// A quarter of an ellipse, clockwise on the screen.
fn quarter(pen: &mut Pen, to: Point, radii: Vec2) {
    pen.arc_to(SvgArc { from: pen.at(), to, radii, x_rotation: 0.0, large_arc: false, sweep: true });
}
