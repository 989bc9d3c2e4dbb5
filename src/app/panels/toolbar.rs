//! The bar above the canvas and the strip of tools beside it.

use super::icons::Icon;
use super::snapshot::{Dialog, Snapshot};
use super::widgets::{IconButton, menu_line, note, palette, segments, text_button};
use crate::app::action::Action;
use crate::app::canvas_tool::CanvasTool;
use crate::app::fonts;
use crate::app::messages::{Language, Messages, Msg};
use crate::app::settings::{Handedness, ThemeChoice};
use crate::app::stabiliser::Stabiliser;
use crate::app::theme::{TARGET, TOOL};
use crate::sketch::Tool;
use egui::text::{LayoutJob, TextWrapping};
use egui::{Align, Key, Layout, Popup, PopupCloseBehavior, Rect, ScrollArea, TextStyle, Ui, pos2, vec2};

/// A tool as the strip shows it.
pub struct ToolEntry {
    /// What it does.
    pub tool: CanvasTool,
    /// Its key.
    pub key: Key,
    /// Its name.
    pub name: Msg,
    /// What it is for.
    pub hint: Msg,
    icon: Icon,
}

const fn entry(tool: CanvasTool, key: Key, icon: Icon, name: Msg, hint: Msg) -> ToolEntry {
    ToolEntry { tool, key, name, hint, icon }
}

/// Every tool with its key, in the order of the strip.
pub const TOOLS: [ToolEntry; 11] = [
    entry(CanvasTool::Draw(Tool::Auto), Key::A, Icon::Pen, Msg::ToolAuto, Msg::ToolAutoHint),
    entry(CanvasTool::Draw(Tool::Petal), Key::P, Icon::Petal, Msg::ToolPetal, Msg::ToolPetalHint),
    entry(CanvasTool::Draw(Tool::Leaf), Key::L, Icon::Leaf, Msg::ToolLeaf, Msg::ToolLeafHint),
    entry(CanvasTool::Draw(Tool::Branch), Key::B, Icon::Branch, Msg::ToolBranch, Msg::ToolBranchHint),
    entry(
        CanvasTool::Draw(Tool::BranchOutline),
        Key::T,
        Icon::BranchOutline,
        Msg::ToolBranchOutline,
        Msg::ToolBranchOutlineHint,
    ),
    entry(
        CanvasTool::Draw(Tool::LeafOutline),
        Key::F,
        Icon::LeafOutline,
        Msg::ToolLeafOutline,
        Msg::ToolLeafOutlineHint,
    ),
    entry(CanvasTool::Draw(Tool::Crown), Key::C, Icon::Crown, Msg::ToolCrown, Msg::ToolCrownHint),
    entry(CanvasTool::Erase { partial: false }, Key::E, Icon::Eraser, Msg::ToolErase, Msg::ToolEraseHint),
    entry(
        CanvasTool::Erase { partial: true },
        Key::D,
        Icon::PartialEraser,
        Msg::ToolErasePartial,
        Msg::ToolErasePartialHint,
    ),
    entry(CanvasTool::Select, Key::S, Icon::Lasso, Msg::ToolSelect, Msg::ToolSelectHint),
    entry(CanvasTool::Pan, Key::H, Icon::Hand, Msg::ToolPan, Msg::ToolPanHint),
];

/// What a stroke drawn with a tool is called.
pub fn name_of(tool: Tool) -> Msg {
    // In space it is a branch, too.
    let tool = if tool.is_in_space() { Tool::Branch } else { tool };
    let entry = TOOLS.iter().find(|entry| entry.tool == CanvasTool::Draw(tool));
    entry.map_or(Msg::ToolAuto, |entry| entry.name)
}

/// The strip of tools: one tap each.
pub fn tools(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    ui.spacing_mut().item_spacing.y = 4.0;
    ScrollArea::vertical().show(ui, |ui| {
        for (i, entry) in TOOLS.iter().enumerate() {
            if i == 7 || i == 9 {
                strip_gap(ui);
            }
            let name = messages.get(entry.name);
            let hint = format!("{name} ({})\n{}", entry.key.name(), messages.get(entry.hint));
            let mut button = IconButton::new(entry.icon, name).hint(hint).side(TOOL);
            button = button.chosen(snapshot.tool == entry.tool);
            if let CanvasTool::Draw(tool) = entry.tool
                && tool != Tool::Auto
            {
                button = button.colour(palette(ui).tool(tool));
            }
            if button.show(ui).clicked() {
                out.push(Action::SetTool(entry.tool));
            }
        }
        strip_gap(ui);
        stabiliser(ui, snapshot, messages, out);
        super::focus::reveal(ui);
    });
}

fn strip_gap(ui: &mut Ui) {
    ui.add_space(2.0);
    let (rect, _) = ui.allocate_exact_size(vec2(TOOL, 5.0), egui::Sense::hover());
    ui.painter().hline(rect.shrink2(vec2(8.0, 0.0)).x_range(), rect.center().y, (1.0, palette(ui).line));
}

fn strength_name(strength: Stabiliser) -> Msg {
    match strength {
        Stabiliser::Off => Msg::SettingsStabiliserOff,
        Stabiliser::Light => Msg::SettingsStabiliserLight,
        Stabiliser::Strong => Msg::SettingsStabiliserStrong,
    }
}

/// One tap goes on to the next strength; dots below the icon show which it is.
fn stabiliser(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.get(Msg::SettingsStabiliser);
    let label = format!("{name}: {}", messages.get(strength_name(snapshot.stabiliser)));
    let p = palette(ui);
    let strength = Stabiliser::ALL.iter().position(|s| *s == snapshot.stabiliser).unwrap_or(0);
    let colour = if strength == 0 { p.weak } else { p.text };
    let response = IconButton::new(Icon::Stabiliser, &label).side(TOOL).colour(colour).show(ui);
    for dot in 1..Stabiliser::ALL.len() {
        let at = response.rect.center_bottom() + vec2((dot as f32 - 1.5) * 9.0, -8.0);
        ui.painter().circle_filled(at, 2.2, if dot <= strength { p.accent } else { p.line });
    }
    if response.clicked() {
        out.push(Action::SetStabiliser(Stabiliser::ALL[(strength + 1) % Stabiliser::ALL.len()]));
    }
}

/// The bar above the canvas: files, undo, views, settings, export.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let whole = ui.max_rect();
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        file_menu(ui, snapshot, messages, out);
        let mut button = |ui: &mut Ui, icon, msg, keys: &str, enabled, action| {
            let name = messages.get(msg);
            let hint = if keys.is_empty() { name.to_owned() } else { format!("{name} ({keys})") };
            if IconButton::new(icon, name).hint(hint).enabled(enabled).show(ui).clicked() {
                out.push(action);
            }
        };
        button(ui, Icon::New, Msg::FileNew, "Ctrl+N", true, Action::New);
        button(ui, Icon::Open, Msg::FileOpen, "Ctrl+O", true, Action::Open);
        button(ui, Icon::Save, Msg::FileSave, "Ctrl+S", true, Action::Save);
        gap(ui);
        button(ui, Icon::Undo, Msg::EditUndo, "Ctrl+Z", snapshot.can_undo, Action::Undo);
        button(ui, Icon::Redo, Msg::EditRedo, "Ctrl+Shift+Z", snapshot.can_redo, Action::Redo);
        gap(ui);
        button(ui, Icon::Fit, Msg::EditFit, "0", true, Action::FitCanvas);
        button(ui, Icon::Plant, Msg::EditFront, "1", true, Action::FrontView);
        button(ui, Icon::Picture, Msg::FileReference, "", true, Action::OpenReference);
        let left = ui.cursor().left();
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if text_button(ui, Some(Icon::Export), messages.get(Msg::FileExport), true).clicked() {
                out.push(Action::ShowExport);
            }
            gap(ui);
            side_button(ui, snapshot, messages, out);
            if IconButton::new(Icon::Help, messages.get(Msg::AboutHelp)).show(ui).clicked() {
                out.push(Action::ShowDialog(Dialog::About));
            }
            settings_menu(ui, snapshot, messages, out);
            title(ui, snapshot, messages, whole, left);
        });
    });
}

fn gap(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(13.0, TARGET), egui::Sense::hover());
    ui.painter().vline(rect.center().x, rect.shrink(8.0).y_range(), (1.0, palette(ui).line));
}

fn side_button(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let label = messages.get(if snapshot.side_shown { Msg::SideHide } else { Msg::SideShow });
    if IconButton::new(Icon::Side, label).chosen(snapshot.side_shown).show(ui).clicked() {
        out.push(Action::ShowSide(!snapshot.side_shown));
    }
}

/// Room for the dot behind the drawing's name.
const DOT: f32 = 14.0;

/// The drawing's name in the middle of the bar, shortened where there is no room for all of it, with a dot while there are changes that its file does not have.
fn title(ui: &Ui, snapshot: &Snapshot, messages: &Messages, bar: Rect, left: f32) {
    let name = snapshot.name.as_deref().unwrap_or(messages.get(Msg::AppUntitled));
    let p = palette(ui);
    let free =
        Rect::from_x_y_ranges((left + 12.0)..=(ui.cursor().right() - 12.0).max(left + 12.0), bar.y_range());
    let room = free.width() - DOT;
    if room <= 0.0 {
        return;
    }
    let mut line = LayoutJob::simple_singleline(name.to_owned(), TextStyle::Body.resolve(ui.style()), p.text);
    line.wrap = TextWrapping::truncate_at_width(room);
    let line = ui.painter().layout_job(line);
    let half = line.size() / 2.0;
    // In the middle of the bar, or as near to it as there is room.
    let middle = bar.center().x.clamp(free.left() + half.x, free.right() - DOT - half.x);
    let rect = Rect::from_center_size(pos2(middle, bar.center().y), line.size());
    ui.painter().galley(rect.min, line, p.text);
    if snapshot.unsaved {
        ui.painter().circle_filled(rect.right_center() + vec2(9.0, 1.0), 3.0, p.accent);
    }
}

fn file_menu(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let button = IconButton::new(Icon::Menu, messages.get(Msg::FileMenu)).show(ui);
    Popup::menu(&button).show(|ui| {
        ui.set_width(270.0);
        ui.spacing_mut().item_spacing.y = 2.0;
        let lines = [
            (Icon::New, Msg::FileNew, "Ctrl+N", Action::New),
            (Icon::Open, Msg::FileOpen, "Ctrl+O", Action::Open),
            (Icon::Save, Msg::FileSave, "Ctrl+S", Action::Save),
            (Icon::Save, Msg::FileSaveAs, "Ctrl+Shift+S", Action::SaveAs),
            (Icon::Export, Msg::FileExport, "Ctrl+E", Action::ShowExport),
            (Icon::Picture, Msg::FileReference, "", Action::OpenReference),
            (Icon::Plant, Msg::BesideAdd, "G", Action::ShowDialog(Dialog::PlantSpecies(None))),
            (Icon::Lasso, Msg::EditSelectAll, "Ctrl+A", Action::SelectAll),
            (Icon::Paste, Msg::EditPaste, "Ctrl+V", Action::Paste),
        ];
        for (icon, msg, keys, action) in lines {
            if menu_line(ui, icon, messages.get(msg), keys).clicked() {
                out.push(action);
            }
        }
        ui.separator();
        note(ui, messages.get(if snapshot.recent.is_empty() { Msg::FileNoRecent } else { Msg::FileRecent }));
        for path in snapshot.recent.iter().take(6) {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            let line = menu_line(ui, Icon::File, &name, "");
            if line.on_hover_text(path.display().to_string()).clicked() {
                out.push(Action::OpenPath(path.clone()));
            }
        }
        ui.separator();
        if menu_line(ui, Icon::Close, messages.get(Msg::FileQuit), "Ctrl+Q").clicked() {
            out.push(Action::Quit);
        }
    });
}

fn settings_menu(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let button = IconButton::new(Icon::Settings, messages.get(Msg::SettingsTitle)).show(ui);
    Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_width(300.0);
        note(ui, messages.get(Msg::SettingsLanguage));
        let name = |l: Language| if snapshot.chinese_font { l.own_name() } else { l.latin_name() };
        let languages = Language::ALL.map(|language| (language, name(language)));
        out.extend(segments(ui, &languages, messages.language()).map(Action::SetLanguage));
        if snapshot.lacks_chinese_font {
            // In English whatever the interface speaks: those who cannot draw Chinese read this.
            let missing = fonts::missing_notice();
            note(ui, &format!("{} {}", missing.what, missing.remedy));
        }
        note(ui, messages.get(Msg::SettingsTheme));
        let themes = [
            (ThemeChoice::System, messages.get(Msg::SettingsThemeSystem)),
            (ThemeChoice::Light, messages.get(Msg::SettingsThemeLight)),
            (ThemeChoice::Dark, messages.get(Msg::SettingsThemeDark)),
        ];
        out.extend(segments(ui, &themes, snapshot.theme).map(Action::SetTheme));
        note(ui, messages.get(Msg::SettingsHand));
        let hands = [
            (Handedness::Left, messages.get(Msg::SettingsHandLeft)),
            (Handedness::Right, messages.get(Msg::SettingsHandRight)),
        ];
        out.extend(segments(ui, &hands, snapshot.handedness).map(Action::SetHandedness));
        note(ui, messages.get(Msg::SettingsStabiliser));
        let strengths = Stabiliser::ALL.map(|strength| (strength, messages.get(strength_name(strength))));
        out.extend(segments(ui, &strengths, snapshot.stabiliser).map(Action::SetStabiliser));
        ui.separator();
        super::pen::open_button(ui, messages, out);
    });
}
