//! Whole frames of the interface over an editor, without a graphics card.

use super::*;
use crate::app::canvas::Scroll;
use crate::app::canvas_tool::CanvasTool;
use crate::app::editor::Places;
use crate::app::layout::Layout;
use crate::app::messages::{Language, Messages, Msg};
use crate::app::panels::snapshot::Shading;
use egui::{Pos2, TextureId};

/// A window of 1280 × 800 on a new drawing.
struct Screen {
    editor: Editor,
    egui: egui::Context,
    _home: tempfile::TempDir,
}

impl Screen {
    fn new() -> Self {
        let home = tempfile::tempdir().unwrap();
        let places = Places { config: home.path().join("config"), state: home.path().join("state") };
        let mut editor = Editor::open_in(places, None, || ()).unwrap();
        editor.perform(Action::SetLanguage(Language::English));
        editor.perform(Action::New);
        let mut screen = Self { editor, egui: egui::Context::default(), _home: home };
        screen.frame();
        screen
    }

    /// One frame, and the texts that it shows.
    fn frame(&mut self) -> Vec<String> {
        let size = vec2(1280.0, 800.0);
        let input = egui::RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, size)),
            ..egui::RawInput::default()
        };
        let mut output = self.egui.run_ui(input, |ui| self.editor.ui(ui, TextureId::default()));
        // There is no card to send pictures to.
        output.textures_delta.clear();
        let mut texts = Vec::new();
        output.shapes.iter().for_each(|clipped| collect_texts(&clipped.shape, &mut texts));
        texts
    }

    /// The place of the canvas that is seen in its middle.
    fn middle(&self) -> DVec2 {
        self.editor.canvas().view().to_canvas(self.editor.layout().canvas_px().center())
    }
}

fn collect_texts(shape: &Shape, texts: &mut Vec<String>) {
    match shape {
        Shape::Text(text) => texts.push(text.galley.text().to_owned()),
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect_texts(shape, texts)),
        _ => {}
    }
}

fn picture() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder = png::Encoder::new(&mut bytes, 4, 2);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[200; 24]).unwrap();
    writer.finish().unwrap();
    bytes.into_inner()
}

#[test]
fn the_drawing_follows_the_canvas_to_the_other_side_of_the_window() {
    let mut screen = Screen::new();
    // Once the artist has moved the canvas it is no longer fitted by itself.
    screen.editor.wheel(Scroll::Lines(DVec2::new(0.0, 3.0)), DVec2::new(300.0, 300.0));
    screen.frame();
    let (before, left) = (screen.middle(), screen.editor.layout().canvas);
    for hand in [Handedness::Left, Handedness::Right] {
        screen.editor.perform(Action::SetHandedness(hand));
        screen.frame();
        assert!(screen.middle().distance(before) < 1e-6, "{hand:?}");
        assert_eq!(screen.editor.layout().canvas == left, hand == Handedness::Right);
    }
    screen.editor.perform(Action::ShowSide(false));
    screen.frame();
    assert!(screen.editor.layout().canvas.width() > left.width() && screen.middle().distance(before) < 1e-6);
}

#[test]
fn the_invitation_to_draw_does_not_stand_on_a_picture_to_trace() {
    let mut screen = Screen::new();
    let invitation = Messages::new(Language::English).get(Msg::CanvasInvite).to_owned();
    assert!(screen.frame().contains(&invitation));
    screen.editor.paste_picture(picture());
    // It is decoded on a thread of its own.
    let begun = std::time::Instant::now();
    while screen.editor.sketch().reference.is_none() {
        assert!(begun.elapsed().as_secs() < 60, "the picture never comes");
        std::thread::yield_now();
        screen.editor.collect();
    }
    assert!(!screen.frame().contains(&invitation));
}

#[test]
fn a_new_drawing_begins_with_the_pen() {
    let mut screen = Screen::new();
    screen.editor.perform(Action::SetShading(Shading::Wireframe));
    for tool in [CanvasTool::Erase { partial: true }, CanvasTool::Draw(crate::sketch::Tool::Crown)] {
        screen.editor.perform(Action::SetTool(tool));
        screen.editor.perform(Action::New);
        assert_eq!(screen.editor.canvas().tool(), CanvasTool::default());
    }
    assert_eq!(screen.editor.panel_snapshot().view.shading, Shading::Wireframe, "how plants are shown stays");
}

#[test]
fn that_there_is_no_chinese_font_is_said_in_letters_that_can_be_drawn() {
    let mut screen = Screen::new();
    screen.editor.prefs.lose_chinese_font();
    screen.editor.perform(Action::SetLanguage(Language::Chinese));
    screen.frame();
    let snapshot = screen.editor.panel_snapshot();
    let notice = snapshot.notices.last().unwrap();
    for text in [&notice.what, &notice.remedy] {
        assert!(text.chars().all(|c| !('\u{2e80}'..'\u{a000}').contains(&c)), "{text}");
    }
    assert!(notice.remedy.contains("fonts-noto-cjk") && snapshot.lacks_chinese_font);
}

#[test]
fn the_divider_is_not_drawn_on() {
    let [left, right] = [0.0, 100.0].map(|x| Rect::from_min_size(pos2(x, 0.0), vec2(100.0, 50.0)));
    let layout = Layout { canvas: left, plant: right, ..Layout::default() };
    let mirrored = Layout { canvas: right, plant: left, ..layout };
    for (layout, on, off) in [(layout, 90.0, 97.0), (mirrored, 110.0, 103.0)] {
        assert!(layout.is_canvas(pos2(on, 20.0)) && !layout.is_canvas(pos2(off, 20.0)));
    }
    assert!(layout.is_canvas(pos2(1.0, 20.0)) && !layout.is_canvas(pos2(50.0, 60.0)));
}

#[test]
fn stretch_cursors_point_where_the_handle_goes() {
    use std::f64::consts::PI;
    assert_eq!(stretch_cursor(0.0), egui::CursorIcon::ResizeHorizontal);
    assert_eq!(stretch_cursor(PI), egui::CursorIcon::ResizeHorizontal);
    assert_eq!(stretch_cursor(-PI / 2.0), egui::CursorIcon::ResizeVertical);
    assert_eq!(stretch_cursor(PI / 4.0), egui::CursorIcon::ResizeNwSe);
    assert_eq!(stretch_cursor(-PI / 4.0), egui::CursorIcon::ResizeNeSw);
}
