//! Page size, units and `viewBox`: from user units to CSS pixels (SVG 1.1, sections 7.2, 7.7, 7.8 and 7.10).
//!
//! 1 in = 96 px = 72 pt = 25.4 mm. Percentages are of the viewport around; those of the page itself, whose window is
//! unknown, and what cannot be read count as not given.

use crate::quote;
use crate::sketch::warnings::Warnings;
use crate::sketch::{Canvas, Remark, limits};
use kurbo::{Affine, Size, Vec2};
use roxmltree::Node;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, ViewBox};

/// The page.
pub(super) struct Viewport {
    /// Page size in pixels, `None` when the document gives none.
    pub(super) canvas: Option<Canvas>,
    /// From the root's user units to canvas pixels.
    pub(super) user_to_canvas: Affine,
    /// Lengths in the root's user units.
    pub(super) lengths: Lengths,
}

/// What percentages are of: the viewport around an element, in the user units there, where it is known.
#[derive(Clone, Copy)]
pub(super) struct Lengths(Option<Size>);

/// Which side of the viewport a percentage is of.
#[derive(Clone, Copy)]
pub(super) enum Axis {
    X,
    Y,
    /// Neither: the side of a square with the same diagonal.
    Both,
}

impl Viewport {
    /// The page that a root `<svg>` describes; remarks on sizes that make no sense.
    pub(super) fn of_page(root: Node<'_, '_>, warnings: &mut Warnings) -> Self {
        for name in ["width", "height", "viewBox"] {
            if let Some(text) = root.attribute(name).filter(|text| is_unusable(name, text)) {
                warnings.add(None, || Remark::Page { attribute: name, value: quote::name(text) });
            }
        }
        let size = size_of(root, root);
        let fits = |side: f64| side > 0.0 && side <= f64::from(limits::MAX_CANVAS_SIDE);
        let size = size.filter(|size| fits(size.width) && fits(size.height));
        let canvas = size.map(|size| Canvas { width: size.width as f32, height: size.height as f32 });
        let user_to_canvas = size.map_or(Affine::IDENTITY, |size| user_to_viewport(root, size));
        let lengths = Lengths(view_box(root).map(|view| Size::new(view.w, view.h)).or(size));
        Self { canvas, user_to_canvas, lengths }
    }
}

impl Lengths {
    /// The attribute as user units.
    pub(super) fn of(self, node: Node<'_, '_>, name: &str, axis: Axis) -> Option<f64> {
        let text = node.attribute(name)?;
        let percent = || {
            let percent = text.trim().strip_suffix('%')?.parse::<f64>().ok()?;
            Some(self.side(axis)? * percent / 100.0)
        };
        pixels(text).or_else(percent)
    }

    fn side(self, axis: Axis) -> Option<f64> {
        let Size { width, height } = self.0?;
        Some(match axis {
            Axis::X => width,
            Axis::Y => height,
            Axis::Both => ((width * width + height * height) / 2.0).sqrt(),
        })
    }

    /// The shift by an element's `x` and `y`.
    pub(super) fn offset(self, node: Node<'_, '_>) -> Affine {
        let at = |name, axis| self.of(node, name, axis).unwrap_or(0.0);
        Affine::translate((at("x", Axis::X), at("y", Axis::Y)))
    }

    /// From the user units inside an inner `<svg>` or a used `<symbol>` to those around it, and the lengths inside;
    /// `sized` is the element that carries width and height. Without them it is as large as the viewport around.
    pub(super) fn inner(self, viewport: Node<'_, '_>, sized: Node<'_, '_>) -> (Affine, Self) {
        let side = |name, axis| {
            let given = self.of(sized, name, axis).or_else(|| self.side(axis));
            given.filter(|side| *side > 0.0)
        };
        let full = side("width", Axis::X).zip(side("height", Axis::Y));
        let size = full.map(|(width, height)| Size::new(width, height)).or_else(|| size_of(viewport, sized));
        let inside = view_box(viewport).map(|view| Size::new(view.w, view.h)).or(size);
        (size.map_or(Affine::IDENTITY, |size| user_to_viewport(viewport, size)), Self(inside))
    }
}

fn is_unusable(name: &str, text: &str) -> bool {
    match name {
        "viewBox" => text.parse::<ViewBox>().is_err(),
        _ => !text.trim().ends_with('%') && pixels(text).is_none_or(|side| side <= 0.0),
    }
}

fn pixels(text: &str) -> Option<f64> {
    let Length { number, unit } = text.trim().parse().ok()?;
    let pixels_per_unit = match unit {
        LengthUnit::None | LengthUnit::Px => 1.0,
        LengthUnit::In => 96.0,
        LengthUnit::Cm => 96.0 / 2.54,
        LengthUnit::Mm => 96.0 / 25.4,
        LengthUnit::Pt => 96.0 / 72.0,
        LengthUnit::Pc => 16.0,
        // The browsers' default font: 16 px, its x half as high.
        LengthUnit::Em => 16.0,
        LengthUnit::Ex => 8.0,
        LengthUnit::Percent => return None,
    };
    Some(number * pixels_per_unit)
}

fn view_box(node: Node<'_, '_>) -> Option<ViewBox> {
    node.attribute("viewBox")?.parse().ok()
}

/// Width and height; one that is missing follows from the `viewBox`.
fn size_of(viewport: Node<'_, '_>, sized: Node<'_, '_>) -> Option<Size> {
    let side = |name| sized.attribute(name).and_then(pixels).filter(|side| *side > 0.0);
    let view = view_box(viewport);
    match (side("width"), side("height"), view) {
        (Some(width), Some(height), _) => Some(Size::new(width, height)),
        (Some(width), None, Some(view)) => Some(Size::new(width, width * view.h / view.w)),
        (None, Some(height), Some(view)) => Some(Size::new(height * view.w / view.h, height)),
        (None, None, Some(view)) => Some(Size::new(view.w, view.h)),
        _ => None,
    }
}

/// Fits the `viewBox` into `size` as `preserveAspectRatio` asks.
fn user_to_viewport(viewport: Node<'_, '_>, size: Size) -> Affine {
    let Some(view) = view_box(viewport) else { return Affine::IDENTITY };
    let aspect = viewport.attribute("preserveAspectRatio").and_then(|text| text.parse().ok());
    let AspectRatio { align, slice, .. } = aspect.unwrap_or_default();
    let (sx, sy) = (size.width / view.w, size.height / view.h);
    let uniform = if slice { sx.max(sy) } else { sx.min(sy) };
    let (sx, sy) = if align == Align::None { (sx, sy) } else { (uniform, uniform) };
    let (at_x, at_y) = alignment(align);
    let slack = Vec2::new(at_x * (size.width - view.w * sx), at_y * (size.height - view.h * sy));
    Affine::translate(slack) * Affine::scale_non_uniform(sx, sy) * Affine::translate((-view.x, -view.y))
}

/// Which share of the free space comes before the content.
fn alignment(align: Align) -> (f64, f64) {
    match align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    }
}
