//! The line below everything: what there is, how long it took, with what it is drawn, whether it is safe.

use super::snapshot::{Autosave, PenUsed, Snapshot};
use super::widgets::palette;
use crate::app::messages::{Messages, Msg};
use egui::{Align, Color32, Layout, RichText, Sense, Ui, vec2};

/// The status line.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages) {
    let status = &snapshot.status;
    let p = palette(ui);
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 16.0;
        for (msg, count) in [
            (Msg::StatusStrokes, status.strokes),
            (Msg::StatusFlowers, status.flowers),
            (Msg::StatusVertices, status.vertices),
            (Msg::StatusTriangles, status.triangles),
        ] {
            text(ui, &messages.fill(msg, &[("count", &grouped(count))]), p.weak);
        }
        if status.building {
            text(ui, messages.get(Msg::StatusBuilding), p.accent);
        } else if let Some(ms) = status.build_ms {
            let ms = if ms < 10.0 { format!("{ms:.1}") } else { format!("{ms:.0}") };
            text(ui, &messages.fill(Msg::StatusBuilt, &[("ms", &ms)]), p.weak);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let mut behind = 0;
            let (msg, colour) = match status.autosave {
                Autosave::Saved => (Msg::StatusSaved, p.good),
                Autosave::Journaled => (Msg::StatusJournaled, p.good),
                Autosave::Saving => (Msg::StatusSaving, p.accent),
                Autosave::Writing => (Msg::StatusWriting, p.weak),
                Autosave::Behind(count) => {
                    behind = count;
                    (Msg::StatusBehind, p.warning)
                }
                Autosave::Failed => (Msg::StatusUnsafe, p.error),
            };
            ui.spacing_mut().item_spacing.x = 6.0;
            text(ui, &messages.fill(msg, &[("count", &behind)]), colour);
            dot(ui, colour);
            ui.add_space(12.0);
            let pen = match &status.pen {
                PenUsed::Mouse => messages.get(Msg::StatusMouse).to_owned(),
                PenUsed::Touch => messages.get(Msg::StatusTouch).to_owned(),
                PenUsed::Pen(None) => messages.get(Msg::StatusPen).to_owned(),
                PenUsed::Pen(Some(name)) => messages.fill(Msg::StatusPenNamed, &[("name", name)]),
            };
            text(ui, &pen, p.weak);
            if let Some(shortfall) = &status.shortfall {
                ui.add_space(12.0);
                text(ui, shortfall, p.warning);
            }
        });
    });
}

fn text(ui: &mut Ui, text: &str, colour: Color32) {
    ui.add(egui::Label::new(RichText::new(text).size(12.5).color(colour)).truncate());
}

fn dot(ui: &mut Ui, colour: Color32) {
    let (rect, _) = ui.allocate_exact_size(vec2(8.0, 8.0), Sense::hover());
    ui.painter().circle_filled(rect.center(), 3.5, colour);
}

/// A count with thin spaces between thousands.
pub(super) fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn thousands_stand_apart() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(1234), "1\u{202f}234");
        assert_eq!(grouped(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(grouped(100), "100");
    }
}
