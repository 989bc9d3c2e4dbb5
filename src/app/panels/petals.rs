//! The tool that shapes petals: a small card over the plant, and numbers of the point that was touched last on the side.

use super::icons::Icon;
use super::rail::{Rail, RailChange, Scale};
use super::snapshot::{PetalPoint, PetalState, Snapshot};
use super::widgets::{IconButton, card, note, section};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::sketch::limits;
use egui::{Align2, Area, Context, Id, Margin, Order, Rect, Ui, vec2};
use glam::Vec3;

/// Width of the card while the tool is in hand, logical pixels, where there is room.
const WIDTH: f32 = 190.0;

/// The tool in the lower corner of the view of the plant, away from flowers, `plant` in logical pixels; nothing where no petal
/// can be shaped.
pub fn show(ctx: &Context, plant: Rect, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let state = snapshot.petals;
    if !(state.any || state.on) || plant.width() < 80.0 {
        return;
    }
    let corner = plant.left_bottom() + vec2(12.0, -12.0);
    let area =
        Area::new(Id::unique("petals")).order(Order::Middle).fixed_pos(corner).pivot(Align2::LEFT_BOTTOM);
    area.constrain_to(plant).show(ctx, |ui| {
        card(ui).inner_margin(Margin::same(4)).show(ui, |ui| {
            ui.horizontal(|ui| buttons(ui, &state, messages, out));
            if state.on {
                ui.set_max_width(WIDTH.min(plant.width() - 32.0));
                note(ui, messages.get(if state.chosen { Msg::PetalsDrag } else { Msg::PetalsChoose }));
            }
        });
    });
}

/// The tool, and while it is in hand what it does.
fn buttons(ui: &mut Ui, state: &PetalState, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.get(Msg::PetalsShape);
    let hint = format!("{name} (K)\n{}", messages.get(Msg::PetalsShapeHint));
    if IconButton::new(Icon::Petals, name).hint(hint).chosen(state.on).show(ui).clicked() {
        out.push(Action::ShapePetals(!state.on));
    }
    if !state.on {
        return;
    }
    let mirror = IconButton::new(Icon::MirrorLeftRight, messages.get(Msg::PetalsMirror));
    if mirror.chosen(state.mirrored).show(ui).clicked() {
        out.push(Action::MirrorPetals(!state.mirrored));
    }
    let reset = IconButton::new(Icon::Reset, messages.get(Msg::PetalsReset)).enabled(state.shaped);
    if reset.show(ui).clicked() {
        out.push(Action::ResetPetals);
    }
}

/// On the side: the numbers of the point that was touched last.
pub fn side(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    if let Some(point) = snapshot.petals.point {
        section(ui, messages.get(Msg::PetalsShape), |ui| numbers(ui, &point, messages, out));
    }
}

/// The point that was touched last, in percent of the petal's length.
fn numbers(ui: &mut Ui, point: &PetalPoint, messages: &Messages, out: &mut Vec<Action>) {
    let most = f64::from(limits::MAX_PETAL_OFFSET) * 100.0;
    let scale = Scale { min: -most, max: most, whole: false };
    let names = [Msg::PetalsAcross, Msg::PetalsAlong, Msg::PetalsFace];
    for (direction, msg) in names.into_iter().enumerate() {
        let mut numbers = point.offset.to_array();
        let value = f64::from(numbers[direction]) * 100.0;
        let text = format!("{} %", scale.text(value));
        let label = messages.get(msg);
        let back = messages.fill(Msg::ParamsReset, &[("name", &label), ("value", &"0 %")]);
        let reset = (numbers[direction] != 0.0).then_some(back.as_str());
        let width = ui.available_width();
        let changed = Rail { label, text: &text, scale, value, reset }.show(ui, width).1;
        numbers[direction] = match changed {
            Some(RailChange::To(percent)) => (percent / 100.0) as f32,
            Some(RailChange::Reset) => 0.0,
            None => continue,
        };
        out.push(Action::SetPetalPoint(Vec3::from(numbers)));
    }
}
