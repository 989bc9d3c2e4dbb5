//! From the XML tree to outlines in canvas pixels: which elements are painted, through which transforms, with which tool.
//!
//! The walk keeps its own stack, so nesting costs no call depth; `<use>` copies count like elements, so that copies of
//! copies end at the limit.

use super::path_data::{PathData, parse_path, parse_points};
use super::style::Style;
use super::style_sheet::StyleSheet;
use super::viewport::{Lengths, Viewport};
use super::{naming, pressure, shapes};
use crate::quote;
use crate::sketch::draft::{Flaw, coordinate_fault};
use crate::sketch::error::{Fault, Place};
use crate::sketch::remark::Element;
use crate::sketch::warnings::Warnings;
use crate::sketch::{Canvas, Remark, Tool, limits};
use kurbo::{Affine, BezPath, PathEl, Point, Rect};
use roxmltree::{Document, Node, NodeId};
use std::collections::HashMap;
use svgtypes::Transform;

const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// Visible elements that an artist may take for strokes but that are none.
const LEFT_OUT: [&str; 3] = ["text", "image", "foreignObject"];

/// An outline in canvas pixels, curves and all.
pub(super) struct Outline {
    pub(super) path: BezPath,
    pub(super) tool: Tool,
    /// One for each point; then the path is a single polyline, or a dot.
    pub(super) pressures: Option<Vec<f32>>,
}

/// Every drawn outline of `document`, in document order.
pub(super) fn outlines(
    document: &Document<'_>,
    page: &Viewport,
    sheet: &StyleSheet<'_>,
    warnings: &mut Warnings,
) -> Result<Vec<Outline>, Flaw> {
    let walk = Walk {
        document,
        page,
        sheet,
        warnings,
        by_id: None,
        outlines: Vec::new(),
        room: limits::MAX_POINTS,
        left_out: [0; LEFT_OUT.len()],
        unpainted: 0,
    };
    walk.run()
}

/// What an element inherits.
#[derive(Clone, Copy)]
struct Inherited {
    to_canvas: Affine,
    lengths: Lengths,
    tool: Tool,
    style: Style,
    use_depth: usize,
}

struct Walk<'d, 'i, 'w> {
    document: &'d Document<'i>,
    page: &'w Viewport,
    sheet: &'w StyleSheet<'w>,
    warnings: &'w mut Warnings,
    /// Elements by id; made when the first `<use>` asks.
    by_id: Option<HashMap<&'d str, NodeId>>,
    outlines: Vec<Outline>,
    /// Path elements that still fit.
    room: usize,
    /// How many of each of [`LEFT_OUT`] were met.
    left_out: [usize; LEFT_OUT.len()],
    /// How many outlines have neither stroke nor fill.
    unpainted: usize,
}

impl<'d, 'i> Walk<'d, 'i, '_> {
    fn run(mut self) -> Result<Vec<Outline>, Flaw> {
        let page = Inherited {
            to_canvas: self.page.user_to_canvas,
            lengths: self.page.lengths,
            tool: Tool::Auto,
            style: Style::INITIAL,
            use_depth: 0,
        };
        let (mut stack, root) = (Vec::new(), self.document.root_element());
        if let Some(style) = self.style(root, page.style)? {
            push_children(&mut stack, root, Inherited { style, ..page });
        }
        let (mut visited, mut copied_bytes) = (0, 0);
        while let Some((node, inherited)) = stack.pop() {
            visited += 1;
            if inherited.use_depth > 0 {
                copied_bytes += node.attributes().map(|a| a.value().len()).sum::<usize>();
            }
            if visited + stack.len() > limits::MAX_SVG_NODES || copied_bytes > limits::MAX_SVG_COPIED_BYTES {
                let message =
                    "the SVG has too many elements, or copies them too often with <use>; thin it out";
                return Err((Place::default(), Fault::Malformed(message.into())));
            }
            if is_svg_element(node) {
                self.visit(node, inherited, &mut stack)?;
            }
        }
        if self.outlines.is_empty() && self.unpainted > 0 {
            return Err((Place::default(), Fault::NothingPainted { count: self.unpainted }));
        }
        for (name, count) in LEFT_OUT.iter().zip(self.left_out).filter(|(_, count)| *count > 0) {
            self.warnings.add(None, || Remark::NoLines { count, element: name });
        }
        Ok(self.outlines)
    }

    fn visit(&mut self, node: Node<'d, 'i>, from: Inherited, stack: &mut Stack<'d, 'i>) -> Result<(), Flaw> {
        let Some(here) = self.inherit(node, from)? else { return Ok(()) };
        match node.tag_name().name() {
            "g" | "a" | "switch" => push_children(stack, node, here),
            "svg" => {
                let (inner, lengths) = here.lengths.inner(node, node);
                let to_canvas = here.to_canvas * here.lengths.offset(node) * inner;
                push_children(stack, node, Inherited { to_canvas, lengths, ..here });
            }
            "use" => self.follow(node, here, stack),
            _ if here.style.is_hidden() => {}
            "path" => {
                let data = parse_path(node.attribute("d").unwrap_or_default(), self.room);
                self.add(node, here, data)?;
            }
            shape @ ("polyline" | "polygon") => {
                let points = node.attribute("points").unwrap_or_default();
                self.add(node, here, parse_points(points, shape == "polygon", self.room))?;
            }
            "line" | "rect" | "circle" | "ellipse" => {
                let path = shapes::outline(node, here.lengths);
                self.add(node, here, PathData { path, error: None })?;
            }
            other => {
                if let Some(at) = LEFT_OUT.iter().position(|name| *name == other) {
                    self.left_out[at] += 1;
                }
            }
        }
        Ok(())
    }

    /// What holds at `node`, `None` if neither it nor anything inside is displayed.
    fn inherit(&mut self, node: Node<'d, 'i>, from: Inherited) -> Result<Option<Inherited>, Flaw> {
        let Some(style) = self.style(node, from.style)? else { return Ok(None) };
        let transform = node.attribute("transform").map(str::parse::<Transform>);
        let own = match transform {
            None => Affine::IDENTITY,
            Some(Ok(Transform { a, b, c, d, e, f })) => Affine::new([a, b, c, d, e, f]),
            Some(Err(error)) => {
                self.warnings.add(None, || {
                    let reason = quote::name(&error.to_string());
                    Remark::Transform { element: title(node), reason }
                });
                Affine::IDENTITY
            }
        };
        let tool = self.tool(node, from.tool)?.unwrap_or(from.tool);
        Ok(Some(Inherited { to_canvas: from.to_canvas * own, tool, style, ..from }))
    }

    /// The style of `node` in an element of style `around`, `None` if neither it nor anything inside is displayed.
    fn style(&self, node: Node<'d, 'i>, around: Style) -> Result<Option<Style>, Flaw> {
        let declared = self.sheet.declarations(node).map_err(|fault| (Place::default(), fault))?;
        Ok(around.inherited_by(&declared))
    }

    /// The tool that this very element names; `around` is that of the groups around it.
    fn tool(&self, node: Node<'d, 'i>, around: Tool) -> Result<Option<Tool>, Flaw> {
        if let Some(name) = node.attribute("data-tool") {
            let known = naming::tool_in(name);
            let fault = || Fault::UnknownTool { name: quote::name(name) };
            return known.map(Some).ok_or_else(|| (self.place(node), fault()));
        }
        let label = node.attribute((INKSCAPE, "label")).and_then(naming::tool_in);
        // An outline to be filled with leaves or twigs may well be called a crown.
        let may_be = |tool: &Tool| *tool != Tool::Crown || around == Tool::Auto;
        let id = node.attribute("id").and_then(naming::tool_in).filter(may_be);
        Ok(label.or(id))
    }

    /// Puts what a `<use>` refers to on the stack.
    fn follow(&mut self, node: Node<'d, 'i>, here: Inherited, stack: &mut Stack<'d, 'i>) {
        let link = node.attribute("href").or_else(|| node.attribute((XLINK, "href"))).unwrap_or_default();
        let document = self.document;
        let by_id = self.by_id.get_or_insert_with(|| {
            document.descendants().filter_map(|n| Some((n.attribute("id")?, n.id()))).collect()
        });
        let target =
            link.strip_prefix('#').and_then(|id| by_id.get(id)).and_then(|id| document.get_node(*id));
        let Some(target) = target.filter(|_| here.use_depth < limits::MAX_SVG_USE_DEPTH) else {
            self.warnings.add(None, || Remark::LeadsNowhere { element: title(node) });
            return;
        };
        let to_canvas = here.to_canvas * here.lengths.offset(node);
        let there = Inherited { to_canvas, use_depth: here.use_depth + 1, ..here };
        if target.tag_name().name() == "symbol" {
            let (inner, lengths) = here.lengths.inner(target, node);
            push_children(stack, target, Inherited { to_canvas: to_canvas * inner, lengths, ..there });
        } else {
            stack.push((target, there));
        }
    }

    /// Adds what an element draws, if it is painted and not the paper.
    fn add(&mut self, node: Node<'d, 'i>, here: Inherited, data: PathData) -> Result<(), Flaw> {
        let PathData { mut path, error } = data;
        if !here.style.is_stroked() && !here.style.is_filled() {
            self.unpainted += usize::from(path.elements().len() > 1);
            return Ok(());
        }
        if let Some(error) = error {
            self.warnings.add(None, || {
                let reason = quote::name(&error.to_string());
                Remark::CutShort { element: title(node), reason }
            });
        }
        path.apply_affine(here.to_canvas);
        if let Some(outside) = first_outside(&path) {
            return Err((self.place(node), coordinate_fault([outside.x, outside.y])));
        }
        let fault = Fault::TooMany { what: "points", limit: limits::MAX_POINTS };
        self.room = self.room.checked_sub(path.elements().len()).ok_or((Place::default(), fault))?;
        let is_paper = !here.style.is_stroked() && self.page.canvas.is_some_and(|page| covers(&path, page));
        if path.elements().len() > 1 && !is_paper {
            let listed = node.attribute("data-pressure");
            let pressures = listed.and_then(|text| pressure::parse(text, path.elements()));
            if listed.is_some() && pressures.is_none() {
                self.warnings.add(None, || Remark::PressureUnfit { element: title(node) });
            }
            self.outlines.push(Outline { path, tool: here.tool, pressures });
        }
        Ok(())
    }

    fn place(&self, node: Node<'_, '_>) -> Place {
        let at = self.document.text_pos_at(node.range().start);
        Place { id: node.attribute("id").map(quote::name), ..Place::at(at.row as usize, at.col as usize) }
    }
}

type Stack<'d, 'i> = Vec<(Node<'d, 'i>, Inherited)>;

/// Children go on the stack backwards, so that they come off it in document order.
fn push_children<'d, 'i>(stack: &mut Stack<'d, 'i>, node: Node<'d, 'i>, inherited: Inherited) {
    stack.extend(node.children().rev().map(|child| (child, inherited)));
}

fn is_svg_element(node: Node<'_, '_>) -> bool {
    node.is_element() && matches!(node.tag_name().namespace(), None | Some(SVG))
}

/// Whether the path is a rectangle over the whole page, to a thousandth of its sides: a coloured ground.
fn covers(path: &BezPath, page: Canvas) -> bool {
    let sides = Rect::new(0.0, 0.0, page.width.into(), page.height.into());
    let inset = sides.inset((-1e-3 * sides.width(), -1e-3 * sides.height()));
    let is_outside = |element: &PathEl| match element {
        PathEl::MoveTo(p) | PathEl::LineTo(p) => !inset.contains(*p),
        PathEl::ClosePath => true,
        PathEl::QuadTo(..) | PathEl::CurveTo(..) => false,
    };
    let most_corners = 6;
    let bounds = path.control_box();
    path.elements().len() <= most_corners
        && path.elements().iter().all(is_outside)
        && bounds.union(inset) == bounds
}

/// The element as a remark names it.
fn title(node: Node<'_, '_>) -> Element {
    let id = node.attribute("id").map(quote::name);
    Element { name: quote::name(node.tag_name().name()), id }
}

/// The first point that is not finite or too far out.
fn first_outside(path: &BezPath) -> Option<Point> {
    let limit = f64::from(limits::MAX_COORDINATE);
    let inside = |p: &Point| p.x.abs() <= limit && p.y.abs() <= limit;
    let points = path.elements().iter().flat_map(|element| match *element {
        PathEl::MoveTo(p) | PathEl::LineTo(p) => [p; 3],
        PathEl::QuadTo(p1, p2) => [p1, p2, p2],
        PathEl::CurveTo(p1, p2, p3) => [p1, p2, p3],
        PathEl::ClosePath => [Point::ORIGIN; 3],
    });
    points.into_iter().find(|p| !inside(p))
}
