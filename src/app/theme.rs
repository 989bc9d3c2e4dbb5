//! Colours and measures of the interface, dark and light, and the colours that parts of a plant have everywhere.
//!
//! The light theme is herbarium paper, the dark one a greenhouse at night; both have the plum of *Penstemon* as their
//! only loud colour. Canvas, legend and part menu take part colours from [`Palette`], so that a colour means the same
//! wherever it stands. Text and part colours keep a contrast against their grounds that the tests measure (WCAG 2.1).
//! Everything that can be touched is [`TARGET`] wide and high at least.

use super::ways_to_read::Shown;
use crate::anatomy::Part;
use crate::sketch::{Reading, Tool};
use egui::style::{HandleShape, TextCursorStyle, WidgetVisuals, Widgets};
use egui::{Color32, CornerRadius, FontId, Margin, Shadow, Stroke, Style, TextStyle, Theme, Vec2, Visuals};

/// Least width and height of anything that can be touched, logical pixels.
pub const TARGET: f32 = 40.0;
/// Side of a tool's button, logical pixels.
pub const TOOL: f32 = 48.0;
/// Corner radius of buttons and cards.
pub const ROUND: u8 = 9;

/// Every colour of one theme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    /// Behind everything.
    pub ground: Color32,
    /// Panels.
    pub panel: Color32,
    /// Cards, buttons and rails on panels.
    pub card: Color32,
    /// The same under the pointer.
    pub card_hover: Color32,
    /// Hairlines.
    pub line: Color32,
    /// Text.
    pub text: Color32,
    /// Less important text.
    pub weak: Color32,
    /// What is chosen.
    pub accent: Color32,
    /// Text and icons on the accent colour.
    pub on_accent: Color32,
    /// A chosen thing's ground where the accent would be too loud.
    pub accent_soft: Color32,
    /// Things that went well.
    pub good: Color32,
    /// Warnings.
    pub warning: Color32,
    /// Errors.
    pub error: Color32,
    /// The drawing's paper.
    pub paper: Color32,
    /// Ink that nobody has understood yet.
    pub ink: Color32,
    /// Petals.
    pub petal: Color32,
    /// Leaves.
    pub leaf: Color32,
    /// Trunk or stem, branches, twigs; deeper levels take the last.
    pub branch: [Color32; 4],
    /// Outlines to be filled with twigs.
    pub branch_outline: Color32,
    /// Outlines to be filled with leaves.
    pub leaf_outline: Color32,
    /// Outlines of crowns.
    pub crown: Color32,
    /// Strokes that mean nothing.
    pub ignored: Color32,
    /// Pots.
    pub pot: Color32,
    /// The ground that is drawn.
    pub earth: Color32,
    /// Selected strokes and the lasso.
    pub selection: Color32,
}

const fn rgb(hex: u32) -> Color32 {
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

/// Herbarium paper.
pub const LIGHT: Palette = Palette {
    ground: rgb(0xe9e4d8),
    panel: rgb(0xf7f4ec),
    card: rgb(0xebe6d9),
    card_hover: rgb(0xe0dac9),
    line: rgb(0xd6cfbd),
    text: rgb(0x232b26),
    weak: rgb(0x59635b),
    accent: rgb(0x7b3f83),
    on_accent: rgb(0xffffff),
    accent_soft: rgb(0xe6d5e6),
    good: rgb(0x2f6f3c),
    warning: rgb(0x8a5300),
    error: rgb(0xa6282f),
    paper: rgb(0xfdfbf5),
    ink: rgb(0x2a2e35),
    petal: rgb(0xb8357c),
    leaf: rgb(0x2f7d3a),
    branch: [rgb(0x6b4226), rgb(0xb4571f), rgb(0xa37a18), rgb(0x76831c)],
    branch_outline: rgb(0x8a5a9e),
    leaf_outline: rgb(0x18808a),
    crown: rgb(0x4a4fb5),
    ignored: rgb(0x868b86),
    pot: rgb(0xb5482c),
    earth: rgb(0x7a6a4f),
    selection: rgb(0x2769c9),
};

/// A greenhouse at night.
pub const DARK: Palette = Palette {
    ground: rgb(0x111613),
    panel: rgb(0x1a211d),
    card: rgb(0x27302a),
    card_hover: rgb(0x323d36),
    line: rgb(0x37423b),
    text: rgb(0xe8ece4),
    weak: rgb(0xa3afa5),
    accent: rgb(0xc48fd0),
    on_accent: rgb(0x1e1022),
    accent_soft: rgb(0x47324c),
    good: rgb(0x86c98f),
    warning: rgb(0xe9b15a),
    error: rgb(0xf28b82),
    paper: rgb(0x20262a),
    ink: rgb(0xdfe3dc),
    petal: rgb(0xf08fc0),
    leaf: rgb(0x7fcf86),
    branch: [rgb(0xbd7b4c), rgb(0xe8974a), rgb(0xe9cc6a), rgb(0xd3e08c)],
    branch_outline: rgb(0xc6a0dc),
    leaf_outline: rgb(0x64c4cc),
    crown: rgb(0xa4a6ff),
    ignored: rgb(0x858d88),
    pot: rgb(0xf0906f),
    earth: rgb(0xc2b190),
    selection: rgb(0x7fb2ff),
};

impl Palette {
    /// The colours of a theme.
    pub fn of(theme: Theme) -> &'static Palette {
        match theme {
            Theme::Light => &LIGHT,
            Theme::Dark => &DARK,
        }
    }

    /// The colours of the theme that a piece of interface is shown in.
    pub fn in_use(visuals: &Visuals) -> &'static Palette {
        if visuals.dark_mode { &DARK } else { &LIGHT }
    }

    /// Colour of what a stroke was understood as, of a branch by its level.
    pub fn part(&self, part: Part, level: u32) -> Color32 {
        match part {
            Part::Petal => self.petal,
            Part::Leaf => self.leaf,
            Part::Branch => self.branch_level(level),
            Part::BranchOutline => self.branch_outline,
            Part::LeafOutline => self.leaf_outline,
            Part::Crown => self.crown,
            Part::Ignored => self.ignored,
        }
    }

    /// Colour of a part, or of what is no part of the plant itself.
    pub fn shown(&self, shown: Shown) -> Color32 {
        match shown {
            Shown::Part(part, level) => self.part(part, level),
            Shown::Beside(reading) => self.beside(reading),
        }
    }

    /// Colour of strokes that became no part of the plant but were read as something.
    fn beside(&self, reading: Reading) -> Color32 {
        match reading {
            Reading::Pot => self.pot,
            Reading::Ground => self.earth,
            _ => self.ignored,
        }
    }

    /// Colour of a branch by its level, 0 for trunk or stem.
    pub fn branch_level(&self, level: u32) -> Color32 {
        self.branch[(level as usize).min(self.branch.len() - 1)]
    }

    /// Colour of a tool, which is that of the part it draws.
    pub fn tool(&self, tool: Tool) -> Color32 {
        match tool {
            Tool::Auto => self.ink,
            Tool::Petal | Tool::FlowerBrush => self.petal,
            Tool::Leaf | Tool::GrowthBrush | Tool::LeafBrush => self.leaf,
            Tool::PruningBrush => self.error,
            Tool::LightBrush => self.crown,
            Tool::Branch | Tool::SpaceBranch => self.branch[0],
            Tool::BranchOutline => self.branch_outline,
            Tool::LeafOutline => self.leaf_outline,
            Tool::Crown => self.crown,
        }
    }
}

/// Gives a context the colours and measures of a theme. Cheap; call it when the theme changes.
pub fn apply(ctx: &egui::Context, theme: Theme) {
    ctx.set_theme(theme);
    ctx.set_style_of(theme, style(theme));
}

/// The whole style of a theme.
pub fn style(theme: Theme) -> Style {
    let mut style = Style { visuals: visuals(theme), animation_time: 0.1, ..Style::default() };
    let sizes = [
        (TextStyle::Small, 12.0),
        (TextStyle::Body, 14.5),
        (TextStyle::Button, 14.5),
        (TextStyle::Heading, 19.0),
    ];
    style.text_styles.extend(sizes.map(|(name, size)| (name, FontId::proportional(size))));
    style.text_styles.insert(TextStyle::Monospace, FontId::monospace(13.5));
    let spacing = &mut style.spacing;
    spacing.interact_size = Vec2::splat(TARGET);
    spacing.item_spacing = Vec2::new(8.0, 8.0);
    spacing.button_padding = Vec2::new(12.0, 6.0);
    spacing.icon_width = 22.0;
    spacing.icon_width_inner = 12.0;
    spacing.slider_width = 150.0;
    spacing.window_margin = Margin::same(18);
    spacing.menu_margin = Margin::same(8);
    spacing.tooltip_width = 300.0;
    spacing.combo_height = 400.0;
    // What is longer than its room says so before anybody scrolls.
    spacing.scroll.dormant_handle_opacity = 0.4;
    style.interaction.selectable_labels = false;
    style.interaction.tooltip_delay = 0.4;
    style
}

fn visuals(theme: Theme) -> Visuals {
    let p = Palette::of(theme);
    let base = match theme {
        Theme::Light => Visuals::light(),
        Theme::Dark => Visuals::dark(),
    };
    let shadow_alpha = if base.dark_mode { 120 } else { 40 };
    let shadow =
        |blur| Shadow { offset: [0, 4], blur, spread: 0, color: Color32::from_black_alpha(shadow_alpha) };
    Visuals {
        // An idle window draws nothing, not even a cursor that blinks.
        text_cursor: TextCursorStyle { blink: false, ..base.text_cursor.clone() },
        widgets: widgets(p),
        selection: egui::style::Selection { bg_fill: p.accent_soft, stroke: Stroke::new(1.0, p.accent) },
        weak_text_color: Some(p.weak),
        hyperlink_color: p.accent,
        faint_bg_color: p.card,
        extreme_bg_color: p.card,
        code_bg_color: p.card,
        warn_fg_color: p.warning,
        error_fg_color: p.error,
        window_corner_radius: CornerRadius::same(14),
        menu_corner_radius: CornerRadius::same(12),
        window_shadow: shadow(28),
        popup_shadow: shadow(16),
        window_fill: p.panel,
        window_stroke: Stroke::new(1.0, p.line),
        panel_fill: p.panel,
        slider_trailing_fill: true,
        handle_shape: HandleShape::Circle,
        ..base
    }
}

fn widgets(p: &Palette) -> Widgets {
    let look = |fill, line: Option<Color32>, text| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: line.map_or(Stroke::NONE, |line| Stroke::new(1.0, line)),
        corner_radius: CornerRadius::same(ROUND),
        fg_stroke: Stroke::new(1.3, text),
        expansion: 0.0,
    };
    Widgets {
        noninteractive: look(p.panel, Some(p.line), p.text),
        inactive: look(p.card, None, p.text),
        hovered: look(p.card_hover, None, p.text),
        active: look(p.accent_soft, Some(p.accent), p.text),
        open: look(p.card_hover, None, p.text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contrast of two opaque colours, 1 to 21 (WCAG 2.1).
    fn contrast(a: Color32, b: Color32) -> f32 {
        let luminance = |c: Color32| {
            let [r, g, b, _] = egui::Rgba::from(c).to_array();
            0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
        };
        let (a, b) = (luminance(a), luminance(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn text_is_read_easily_on_everything_it_stands_on() {
        for p in [LIGHT, DARK] {
            for ground in [p.panel, p.card, p.card_hover, p.accent_soft] {
                assert!(contrast(p.text, ground) >= 7.0, "{:?} on {ground:?}", p.text);
            }
            for (text, ground) in [
                (p.weak, p.panel),
                (p.weak, p.card),
                (p.accent, p.panel),
                (p.on_accent, p.accent),
                (p.good, p.panel),
                (p.warning, p.panel),
                (p.error, p.panel),
            ] {
                assert!(contrast(text, ground) >= 4.5, "{text:?} on {ground:?}: {}", contrast(text, ground));
            }
        }
    }

    #[test]
    fn parts_are_seen_on_paper_and_panels() {
        for p in [LIGHT, DARK] {
            let outlines = [p.branch_outline, p.leaf_outline, p.crown];
            let others =
                [p.ink, p.petal, p.leaf, p.ignored, p.pot, p.earth, p.selection].into_iter().chain(outlines);
            for colour in others.chain(p.branch) {
                for ground in [p.paper, p.panel] {
                    assert!(contrast(colour, ground) >= 3.0, "{colour:?}: {}", contrast(colour, ground));
                }
            }
        }
    }

    #[test]
    fn branches_of_any_level_have_a_colour() {
        assert_eq!(LIGHT.branch_level(0), LIGHT.branch[0]);
        assert_eq!(LIGHT.branch_level(u32::MAX), LIGHT.branch[3]);
    }
}
