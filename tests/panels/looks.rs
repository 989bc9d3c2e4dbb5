//! What the interface looks like, drawn by the graphics card for people to look at; and letters for every text.

use super::pictures;
use super::stage::{self, busy, press};
use crate::not_run::not_run;
use egui::vec2;
use egui_kittest::kittest::Queryable;
use penstemon::app::messages::{Language, Localize as _, Messages, Msg, Named};
use penstemon::app::panels::snapshot::{
    Dialog, ExportFormat, GrowthState, MenuOf, Notice, ParamValues, PartMenu, PathPurpose, PathRequest,
    Recovered, ReferenceState,
};
use penstemon::app::pen_settings::TabletDoubt;
use penstemon::app::presets::Listed;
use penstemon::app::settings::{Handedness, ThemeChoice};
use penstemon::app::theme::{DARK, LIGHT};
use penstemon::growth::Habit;
use penstemon::growth::habit::Resource;
use penstemon::growth::overlay::Wanted;
use penstemon::pen::hid::{ChooseError, DeviceInfo, Refused, StringsKept};
use penstemon::sketch::Tool;

/// A state of the interface to be looked at: name, language, page of the side panel, what is different.
type Shot = (&'static str, Language, Option<Msg>, fn(&mut penstemon::app::panels::Snapshot));

/// A tablet in doubt that is read as this model, if any.
fn doubt(taken: Option<&str>) -> TabletDoubt {
    TabletDoubt {
        device: "256c:006d HUION Tablet".into(),
        name: "HUION Tablet".into(),
        models: ["Huion H640P", "Huion H950P", "Huion H1060P"].map(str::to_owned).to_vec(),
        taken: taken.map(str::to_owned),
        is_chosen: false,
    }
}

/// States whose pictures are written for people to look at.
const SHOTS: [Shot; 22] = [
    ("beside", Language::English, None, |s| s.beside = super::beside::garden(Some(0)).beside),
    ("petals", Language::English, None, |s| s.petals = super::petals::at_work()),
    ("petals chinese", Language::Chinese, None, |s| s.petals = super::petals::at_work()),
    ("plant species", Language::Chinese, None, |s| s.dialog = Some(Dialog::PlantSpecies(None))),
    ("chinese", Language::Chinese, None, |_| ()),
    ("shape", Language::English, Some(Msg::TabShape), |s| {
        s.params.own =
            [("depth.world.height".to_owned(), 0.8), ("anatomy.flowers.min_petals".to_owned(), 5.0)].into();
    }),
    ("habit", Language::Chinese, Some(Msg::TabShape), |s| {
        s.params = ParamValues::default().growing(&Habit::default(), 12.0);
        s.params.own = [("habit.lambda".to_owned(), 0.62)].into();
    }),
    ("inside", Language::English, Some(Msg::TabView), |s| {
        let (crown, resource) = (true, Some(Resource::Space));
        s.growth = Some(GrowthState { age: 9.0, most: 30.0, chosen: false, crown, playing: false, resource });
        s.view.overlay = Wanted { markers: true, buds: true, light: true };
    }),
    ("view", Language::Chinese, Some(Msg::TabView), |s| {
        s.reference = Some(ReferenceState { opacity: 0.5, locked: true });
    }),
    ("settings", Language::English, Some(Msg::SettingsTitle), |_| ()),
    ("files", Language::Chinese, Some(Msg::FileMenu), |_| ()),
    ("textures", Language::English, None, |s| {
        s.textures.insert("petal".into(), penstemon::sketch::TextureChoice::Named("petal_rose".into()));
        s.presets = vec![Listed { name: "Evening".into(), path: "/presets/evening.toml".into() }];
        s.part_menu = Some(PartMenu { of: MenuOf::Stroke(9), tool: Tool::Petal, at: [400.0, 300.0] });
    }),
    ("export", Language::English, None, |s| {
        s.dialog = Some(Dialog::Export);
        s.export_bytes = Some(3_400_000);
    }),
    ("png", Language::Chinese, None, |s| {
        s.dialog = Some(Dialog::Export);
        s.export.format = ExportFormat::Png;
    }),
    ("pen", Language::English, None, |s| {
        s.dialog = Some(Dialog::Pen);
        s.pen.device = Some("Wacom Intuos M".to_owned());
        s.pen.live.pressure = 0.4;
        s.pen.settings.pressure = penstemon::pen::PressureCurve::soft();
    }),
    ("pen raw", Language::Chinese, None, |s| {
        s.dialog = Some(Dialog::Pen);
        s.pen.is_raw = true;
        let models = vec!["Huion H640P".to_owned(), "Huion H950P".to_owned()];
        let why = ChooseError::StringsUnread { models, reason: StringsKept::Forbidden }.into();
        let device = DeviceInfo { product: "HUION Tablet".into(), ..DeviceInfo::default() };
        s.pen.trouble = Some(Refused { device, why }.localize(&Messages::new(Language::Chinese)));
        s.pen.doubts = vec![doubt(None)];
    }),
    ("pen doubt", Language::English, None, |s| {
        s.dialog = Some(Dialog::Pen);
        s.pen.is_raw = true;
        s.pen.device = Some("HUION Tablet".to_owned());
        s.pen.doubts = vec![doubt(Some("Huion H640P"))];
    }),
    ("pen keys", Language::English, None, |s| {
        s.dialog = Some(Dialog::Pen);
        s.pen.is_raw = true;
        s.pen.monitors = 2;
        s.pen.settings.covers = penstemon::app::pen_settings::Covers::Monitor;
        s.pen.device = Some("HUION Tablet".to_owned());
    }),
    ("about", Language::English, None, |s| s.dialog = Some(Dialog::About)),
    ("recovery", Language::English, None, |s| {
        let one = |name: &str| Recovered {
            path: name.into(),
            name: name.into(),
            strokes: 12,
            when: "yesterday, 18:03".into(),
            thumbnail: None,
        };
        s.dialog = Some(Dialog::Recovery(vec![one("Rose"), one("Meadow")]));
    }),
    ("path", Language::English, None, |s| {
        s.dialog = Some(Dialog::Path(PathRequest {
            purpose: PathPurpose::SaveDrawing,
            folder: concat!(env!("CARGO_MANIFEST_DIR"), "/assets/sketches").into(),
            name: "meadow".into(),
            extensions: vec!["penstemon"],
        }));
    }),
    ("menus", Language::English, None, |s| {
        s.selected = 3;
        s.notices = vec![
            Notice::error(
                "The disk is full; the drawing stays in memory.",
                "free some space, or save elsewhere",
            ),
            Notice {
                find: Some(PathPurpose::Reference),
                ..Notice::warning(
                    "the picture `petal.png` is missing, so the species' own texture is shown; choose the picture again, or \
                     put it beside the drawing",
                    "",
                )
            },
            Notice::warning("No Chinese font was found.", "install one"),
            Notice::info("rose.glb is written."),
        ];
        s.handedness = Handedness::Left;
    }),
];

#[test]
fn chinese_has_no_boxes_where_a_font_was_found() {
    let Some(font) = stage::chinese_font() else {
        let messages = Messages::new(Language::English);
        not_run("chinese_has_no_boxes_where_a_font_was_found", messages.get(Msg::NoticeInstallFont));
        return;
    };
    let context = egui::Context::default();
    context.set_fonts(penstemon::app::fonts::definitions(Some(font)));
    let mut output = context.run_ui(egui::RawInput::default(), |_| ());
    output.textures_delta.clear();
    let chinese = Messages::new(Language::Chinese);
    for msg in Msg::ALL {
        for letter in chinese.get(*msg).chars() {
            let known = context.fonts_mut(|fonts| fonts.has_glyph(&egui::FontId::proportional(14.0), letter));
            assert!(known, "{letter:?} of {:?} is missing in {}", msg.name(), font.family);
        }
    }
}

#[test]
fn the_graphics_card_draws_the_interface_in_both_themes() {
    use pictures::{Painter, Textures, write};
    use std::{cell::RefCell, rc::Rc};
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let painter = Rc::new(RefCell::new(Painter::new()));
    for (theme, p) in [(ThemeChoice::Light, LIGHT), (ThemeChoice::Dark, DARK)] {
        let mut snapshot = busy();
        snapshot.theme = theme;
        let textures = Some(Textures(painter.clone()));
        let harness = stage::stage_of(snapshot, Language::English, vec2(1280.0, 800.0), 1.0, textures);
        let (size, pixels) = painter.borrow_mut().draw(&harness, p.paper);
        assert_eq!(size, [1280, 800]);
        write(&folder.join(format!("panels-{theme:?}.png")), size, &pixels);
        let at = |x: usize, y: usize| &pixels[(y * 1280 + x) * 4..][..3];
        for (x, y) in [(500, 300), (900, 700), (40, 700)] {
            assert_eq!(at(x, y), &p.panel.to_array()[..3], "nothing is drawn at {x}, {y}");
        }
        let accent =
            pixels.as_chunks::<4>().0.iter().filter(|pixel| pixel[..3] == p.accent.to_array()[..3]).count();
        assert!(accent > 500, "the loud button is seen: {accent}");
        for (name, language, page, change) in SHOTS {
            let mut snapshot = busy();
            snapshot.theme = theme;
            change(&mut snapshot);
            let textures = Some(Textures(painter.clone()));
            let mut harness = stage::stage_of(snapshot, language, vec2(1280.0, 800.0), 1.0, textures);
            if let Some(page) = page {
                press(&mut harness, Messages::new(language).get(page));
            }
            if name == "textures" {
                harness.get_by_label("Save this look").scroll_to_me();
                harness.run();
            }
            if name == "pen keys" {
                harness.get_by_label_contains("Key 6: ").scroll_to_me();
                harness.run();
            }
            if name == "habit" {
                press(&mut harness, &Messages::new(language).name(Named::Group, "habit"));
            }
            let (size, pixels) = painter.borrow_mut().draw(&harness, p.paper);
            write(&folder.join(format!("panels-{theme:?}-{name}.png")), size, &pixels);
        }
        let mut snapshot = busy();
        snapshot.theme = theme;
        let textures = Some(Textures(painter.clone()));
        let harness = stage::stage_of(snapshot, Language::English, vec2(1280.0, 800.0), 2.0, textures);
        let (size, pixels) = painter.borrow_mut().draw(&harness, p.paper);
        assert_eq!(size, [2560, 1600]);
        write(&folder.join(format!("panels-{theme:?}-2x.png")), size, &pixels);
    }
}
