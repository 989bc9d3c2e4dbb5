//! Grids of pictures to choose from.

use super::widgets::{fitted_text, palette};
use crate::app::theme::ROUND;
use egui::{
    CornerRadius, Rect, Response, Role, Sense, Stroke, StrokeKind, TextureHandle, Ui, Vec2, WidgetInfo, pos2,
    vec2,
};

/// Largest size of names below pictures.
const CAPTION: f32 = 12.0;
/// Space between tiles.
const GAP: f32 = 6.0;

/// Shows `count` tiles in `columns` columns; `tile` draws the one of an index at a size.
pub(super) fn grid(
    ui: &mut Ui,
    columns: usize,
    count: usize,
    height: impl Fn(f32) -> f32,
    mut tile: impl FnMut(&mut Ui, usize, Vec2),
) {
    let width = (ui.available_width() - GAP * (columns - 1) as f32) / columns as f32;
    let size = vec2(width, height(width));
    ui.spacing_mut().item_spacing = Vec2::splat(GAP);
    for row in 0..count.div_ceil(columns) {
        ui.horizontal(|ui| {
            for index in (row * columns..count).take(columns) {
                tile(ui, index, size);
            }
        });
    }
}

/// One tile: a picture, its name below if there is room, a frame if it is chosen.
pub(super) fn picture(
    ui: &mut Ui,
    size: Vec2,
    picture: Option<&TextureHandle>,
    name: &str,
    named: bool,
    chosen: bool,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, name));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let p = palette(ui);
    let corner = CornerRadius::same(ROUND);
    ui.painter().rect_filled(rect, corner, if response.hovered() { p.card_hover } else { p.card });
    let text_height = if named { 22.0 } else { 0.0 };
    let image = Rect::from_min_max(rect.min, pos2(rect.right(), rect.bottom() - text_height));
    if let Some(texture) = picture {
        let bottom = if named { 0 } else { ROUND };
        let round = CornerRadius { nw: ROUND, ne: ROUND, sw: bottom, se: bottom };
        egui::Image::new(texture).corner_radius(round).uv(fill_uv(texture, image.size())).paint_at(ui, image);
    }
    if named {
        let line = Rect::from_min_max(pos2(rect.left() + 2.0, image.bottom()), rect.max - vec2(2.0, 0.0));
        fitted_text(ui, line, name, CAPTION, if chosen { p.accent } else { p.text });
    }
    if chosen {
        ui.painter().rect_stroke(rect, corner, Stroke::new(2.5, p.accent), StrokeKind::Inside);
    } else if response.hovered() {
        ui.painter().rect_stroke(rect, corner, Stroke::new(1.0, p.weak), StrokeKind::Inside);
    }
    response
}

/// A tile with a text instead of a picture.
pub(super) fn text(ui: &mut Ui, size: Vec2, label: &str, chosen: bool) -> Response {
    let response = picture(ui, size, None, label, false, chosen);
    let p = palette(ui);
    let rect = response.rect.shrink(4.0);
    let galley = ui.painter().layout(
        label.to_owned(),
        egui::TextStyle::Small.resolve(ui.style()),
        if chosen { p.accent } else { p.text },
        rect.width(),
    );
    let place = rect.center() - galley.size() * 0.5;
    ui.painter().with_clip_rect(rect.intersect(ui.clip_rect())).galley(place, galley, p.text);
    response
}

/// The middle of a picture that fills a place of other proportions.
fn fill_uv(texture: &TextureHandle, place: Vec2) -> Rect {
    let of = texture.size_vec2();
    let shares = vec2(place.x / of.x.max(1.0), place.y / of.y.max(1.0));
    let shown = shares / shares.max_elem().max(f32::EPSILON);
    Rect::from_center_size(pos2(0.5, 0.5), shown)
}
