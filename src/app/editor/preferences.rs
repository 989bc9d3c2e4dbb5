//! What the artist chose for the program, and what follows from it: language, fonts and colours.
//!
//! The choices are kept in the configuration folder whenever they have changed. The language is the chosen one where there
//! are fonts for it, English otherwise. Colours follow the system where the artist did not choose: from winit or, where it
//! does not say, from the desktop, which is asked on a thread.

use super::background::{self, Wake, Work};
use crate::app::action::Action;
use crate::app::fonts::{self, ChineseLookup};
use crate::app::messages::{Language, Localize as _, Messages, Msg};
use crate::app::panels::snapshot::{ExportChoice, Notice, PathPurpose, ViewState};
use crate::app::pen_settings::PenSettings;
use crate::app::settings::{self, CANVAS_SHARE, Settings, ThemeChoice};
use crate::app::system_theme;
use std::path::{Path, PathBuf};
use winit::dpi::PhysicalSize;

/// The choices with language, fonts and colours.
pub(super) struct Preferences {
    settings: Settings,
    /// What of them is on disk, or was tried to be put there.
    kept: Option<Settings>,
    /// The folder that they are kept in.
    folder: PathBuf,
    messages: Messages,
    chinese: ChineseLookup,
    fonts_are_set: bool,
    /// Colours of the system, where it says them.
    system_theme: Option<egui::Theme>,
    theme_asked: Option<Work<Option<egui::Theme>>>,
}

impl Preferences {
    /// Those in a folder; a notice where they could not be read.
    pub(super) fn load(folder: PathBuf) -> (Self, Option<Notice>) {
        let mut chinese = ChineseLookup::default();
        let messages = Messages::new(chinese.drawable(Language::of_system()));
        let (settings, broken) = Settings::load(&folder, &messages);
        let preferences = Self {
            messages: Messages::new(chinese.drawable(settings.language())),
            settings,
            kept: None,
            folder,
            chinese,
            fonts_are_set: false,
            system_theme: None,
            theme_asked: None,
        };
        (preferences, broken)
    }

    /// Whether nothing was ever kept: the program starts for the first time.
    pub(super) fn are_new(&self) -> bool {
        !self.folder.join(settings::FILE_NAME).exists()
    }

    pub(super) fn settings(&self) -> &Settings {
        &self.settings
    }

    pub(super) fn messages(&self) -> &Messages {
        &self.messages
    }

    /// What the artist chose for a pen.
    pub(super) fn pen(&self, name: &str) -> PenSettings {
        self.settings.pen(name)
    }

    /// Carries out an action that is about these choices, the pen last used among them; gives back any other.
    pub(super) fn obey(&mut self, action: Action, pen: &str, wake: &Wake) -> Result<(), Action> {
        let settings = &mut self.settings;
        match action {
            Action::SetLanguage(language) => {
                settings.language = Some(language);
                self.messages = Messages::new(language);
                self.fonts_are_set = false;
            }
            Action::SetTheme(theme) => {
                settings.theme = theme;
                self.ask_system_theme(wake);
            }
            Action::SetHandedness(hand) => settings.handedness = hand,
            Action::SetStabiliser(stabiliser) => settings.stabiliser = stabiliser,
            Action::SetPenSource(source) => settings.pen_source = source,
            Action::SetPen(chosen) => settings.set_pen(pen, chosen),
            Action::SetTabletModel { device, model } => settings.set_tablet_model(&device, &model),
            Action::ShowSide(shown) => settings.side_shown = shown,
            Action::SetSideWidth(width) => settings.side_width = width,
            other => return Err(other),
        }
        Ok(())
    }

    /// Remembers a drawing among those opened or saved last.
    pub(super) fn remember_drawing(&mut self, path: &Path) {
        self.settings.remember(path);
    }

    /// Remembers the folder in which such a file was chosen.
    pub(super) fn remember_folder(&mut self, purpose: PathPurpose, file: &Path) {
        self.settings.remember_folder(purpose, file);
    }

    /// Remembers what the export dialog says.
    pub(super) fn set_export(&mut self, choice: ExportChoice) {
        self.settings.export = choice;
    }

    /// The divider was moved: the canvas has this share of the room.
    pub(super) fn set_canvas_share(&mut self, share: f32) {
        self.settings.canvas_share = share.clamp(CANVAS_SHARE.0, CANVAS_SHARE.2);
    }

    /// Remembers how large the window is.
    pub(super) fn follow_window(&mut self, size: PhysicalSize<u32>, scale: f64, is_maximised: bool) {
        self.settings.window.follow(size, scale, is_maximised);
    }

    /// Keeps them, if they are others than those that were kept last; a notice where that fails.
    pub(super) fn save(&mut self, view: ViewState) -> Option<Notice> {
        self.settings.view = view;
        if self.kept.as_ref() == Some(&self.settings) {
            return None;
        }
        self.kept = Some(self.settings.clone());
        let error = self.settings.save(&self.folder).err()?;
        let reason = error.localize(&self.messages);
        Some(Notice::warning(self.messages.fill(Msg::NoticeSettingsUnsaved, &[("reason", &reason)]), ""))
    }
}

/// Fonts of the language.
impl Preferences {
    /// Whether the interface speaks another language than the chosen one, for want of fonts.
    pub(super) fn lack_language(&self) -> bool {
        self.settings.language() != self.messages.language()
    }

    /// Whether a font for Chinese is at hand; until it is loaded, the language is called by its Latin name.
    pub(super) fn have_chinese_font(&self) -> bool {
        self.chinese.font().is_some()
    }

    /// Whether the system was found to have no such font.
    pub(super) fn lack_chinese_font(&self) -> bool {
        self.chinese.is_missing()
    }

    /// Whether egui has not been given the fonts of the language since this was asked last.
    pub(super) fn take_need_of_fonts(&mut self) -> bool {
        !std::mem::replace(&mut self.fonts_are_set, true)
    }

    /// A new egui context knows no fonts.
    pub(super) fn forget_fonts(&mut self) {
        self.fonts_are_set = false;
    }

    /// Fonts for the language of the interface, which becomes English where there are none; whether it did.
    pub(super) fn fonts(&mut self) -> (egui::FontDefinitions, bool) {
        let wanted = self.messages.language();
        let drawable = self.chinese.drawable(wanted);
        if drawable != wanted {
            self.messages = Messages::new(drawable);
        }
        (fonts::definitions(self.chinese.font()), drawable != wanted)
    }

    /// As on a system without a Chinese font.
    #[cfg(test)]
    pub(super) fn lose_chinese_font(&mut self) {
        self.chinese = ChineseLookup::missing();
    }

    /// Speaks a language whether or not there are fonts for it.
    #[cfg(test)]
    pub(super) fn speak(&mut self, language: Language) {
        self.messages = Messages::new(language);
    }
}

/// Colours.
impl Preferences {
    /// The theme to show.
    pub(super) fn theme(&self) -> egui::Theme {
        self.settings.theme.resolve(self.system_theme)
    }

    /// The window's system said what its colours are; whether that is new.
    pub(super) fn set_system_theme(&mut self, theme: Option<egui::Theme>) -> bool {
        std::mem::replace(&mut self.system_theme, theme) != theme
    }

    /// Asks the desktop for its colours, where they are followed and the window's system does not say them.
    pub(super) fn ask_system_theme(&mut self, wake: &Wake) {
        let is_followed = self.settings.theme == ThemeChoice::System;
        if is_followed && self.theme_asked.is_none() && system_theme::can_be_asked() {
            // Without threads there is no opinion.
            self.theme_asked = background::begin("system theme", wake, system_theme::ask).ok();
        }
    }

    /// Takes the desktop's answer; whether its colours are new.
    pub(super) fn collect_system_theme(&mut self) -> bool {
        let Some(answer) = self.theme_asked.as_ref().and_then(Work::result) else { return false };
        self.theme_asked = None;
        self.set_system_theme(answer.flatten())
    }
}
