//! What is this stroke? One tap corrects a wrong guess. And what can be done with selected strokes.

use super::icons::Icon;
use super::readings;
use super::snapshot::{MenuOf, PartMenu, Snapshot};
use super::widgets::{CAPTIONED, IconButton, card, note, palette, text_button};
use crate::app::action::Action;
use crate::app::canvas_tool::{CanvasTool, Mirror};
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TOOL;
use crate::sketch::Tool;
use egui::{Align2, Area, Context, Id, Order, Rect, RichText, Ui, pos2, vec2};

/// What a stroke can be, as the menu shows it.
const PARTS: [(Tool, Icon, Msg); 7] = [
    (Tool::Petal, Icon::Petal, Msg::ToolPetal),
    (Tool::Leaf, Icon::Leaf, Msg::ToolLeaf),
    (Tool::Branch, Icon::Branch, Msg::ToolBranch),
    (Tool::BranchOutline, Icon::BranchOutline, Msg::ToolBranchOutline),
    (Tool::LeafOutline, Icon::LeafOutline, Msg::ToolLeafOutline),
    (Tool::Crown, Icon::Crown, Msg::ToolCrown),
    (Tool::Auto, Icon::Pen, Msg::PartAuto),
];
/// What can be done with selected strokes: as the menu shows it, with its keys.
const EDITS: [(Icon, Msg, &str, Action); 7] = [
    (Icon::MirrorLeftRight, Msg::EditMirrorLeftRight, "Shift+H", Action::MirrorSelected(Mirror::LeftRight)),
    (Icon::MirrorTopBottom, Msg::EditMirrorTopBottom, "Shift+V", Action::MirrorSelected(Mirror::TopBottom)),
    (Icon::Duplicate, Msg::EditDuplicate, "Ctrl+D", Action::DuplicateSelected),
    (Icon::Copy, Msg::EditCopy, "Ctrl+C", Action::CopySelected),
    (Icon::Cut, Msg::EditCut, "Ctrl+X", Action::CutSelected),
    (Icon::Paste, Msg::EditPaste, "Ctrl+V", Action::Paste),
    (Icon::Delete, Msg::EditDelete, "Del", Action::DeleteSelected),
];
/// Distance from the place that was tapped, and from the sides of the canvas.
const BESIDE: f32 = 18.0;

/// The menu beside a stroke, inside `canvas`.
pub fn show(ctx: &Context, canvas: Rect, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let Some(menu) = snapshot.part_menu else { return };
    let at = pos2(menu.at[0], menu.at[1]) + vec2(BESIDE, BESIDE);
    let id = Id::unique("part menu");
    let area = Area::new(id).order(Order::Foreground).fixed_pos(at).constrain_to(canvas.shrink(8.0));
    let shown = area.show(ctx, |ui| {
        card(ui).show(ui, |ui| {
            ui.set_width(3.0 * CAPTIONED + 8.0);
            if let Some(ways) = &snapshot.ways {
                readings::ways(ui, ways, messages, out);
            }
            if !matches!(menu.of, MenuOf::Reading(_)) {
                choices(ui, &menu, &snapshot.remarks, messages, out);
                picture_under(ui, snapshot, messages, out);
            }
        });
    });
    if ctx.input(|i| i.pointer.any_pressed()) {
        let outside =
            ctx.input(|i| i.pointer.interact_pos()).is_some_and(|p| !shown.response.rect.contains(p));
        if outside {
            out.push(Action::ClosePartMenu);
        }
    }
}

fn choices(ui: &mut Ui, menu: &PartMenu, remarks: &[String], messages: &Messages, out: &mut Vec<Action>) {
    let title = if menu.of == MenuOf::Pen { Msg::PenDrawNext } else { Msg::PartTitle };
    note(ui, messages.get(title));
    ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
    for row in PARTS.chunks(3) {
        ui.horizontal(|ui| {
            for (tool, icon, name) in row {
                let mut button = IconButton::new(*icon, messages.get(*name))
                    .side(TOOL)
                    .captioned()
                    .chosen(menu.tool == *tool);
                if *tool != Tool::Auto {
                    button = button.colour(palette(ui).tool(*tool));
                }
                if button.show(ui).clicked() {
                    out.push(match menu.of {
                        MenuOf::Stroke(stroke) | MenuOf::Reading(stroke) => {
                            Action::SetStrokePart { stroke, tool: *tool }
                        }
                        MenuOf::Pen => Action::SetTool(CanvasTool::Draw(*tool)),
                    });
                    out.push(Action::ClosePartMenu);
                }
            }
        });
    }
    for remark in remarks {
        ui.label(RichText::new(remark).size(13.0).color(palette(ui).warning));
    }
}

/// The button that gives the part of a stroke the picture under it.
fn picture_under(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let Some(stroke) = snapshot.over_picture else { return };
    let button = text_button(ui, Some(Icon::Picture), messages.get(Msg::PartPictureUnder), false);
    if button.on_hover_text(messages.get(Msg::PartPictureUnderHint)).clicked() {
        out.push(Action::TakePictureUnder(stroke));
    }
}

/// What can be done with selected strokes, at the lower edge of `canvas`.
pub fn selection(
    ctx: &Context,
    canvas: Rect,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    if snapshot.selected == 0 || snapshot.part_menu.is_some() {
        return;
    }
    let at = canvas.center_bottom() - vec2(0.0, 14.0);
    let area =
        Area::new(Id::unique("selection")).order(Order::Middle).pivot(Align2::CENTER_BOTTOM).fixed_pos(at);
    area.constrain_to(canvas).show(ctx, |ui| {
        card(ui).show(ui, |ui| {
            ui.set_max_width(canvas.width() - 2.0 * BESIDE);
            note(ui, &messages.fill(Msg::PartSelected, &[("count", &snapshot.selected)]));
            ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
            ui.horizontal_wrapped(|ui| {
                for (tool, icon, name) in PARTS {
                    let mut button = IconButton::new(icon, messages.get(name));
                    if tool != Tool::Auto {
                        button = button.colour(palette(ui).tool(tool));
                    }
                    if button.show(ui).clicked() {
                        out.push(Action::SetPart(tool));
                    }
                }
            });
            ui.horizontal_wrapped(|ui| {
                for (icon, name, keys, action) in EDITS {
                    let name = messages.get(name);
                    let mut button = IconButton::new(icon, name).hint(format!("{name} ({keys})"));
                    if action == Action::DeleteSelected {
                        button = button.colour(palette(ui).error);
                    }
                    if button.show(ui).clicked() {
                        out.push(action);
                    }
                }
            });
            picture_under(ui, snapshot, messages, out);
        });
    });
}
