//! What stands over the window and waits for the artist: one dialog, the menu of parts, and messages.

use super::asked_ways::AskedWays;
use super::notices::Notices;
use crate::app::action::Action;
use crate::app::panels::snapshot::{Dialog, Notice, PartMenu};
use crate::app::ways_to_read::WayToRead;
use crate::sketch::StrokeId;
use std::time::Instant;

/// One dialog, the menu of parts, and messages.
#[derive(Default)]
pub(super) struct Dialogs {
    dialog: Option<Dialog>,
    /// What waits for the answer about unsaved changes.
    held_up: Option<Action>,
    part_menu: Option<PartMenu>,
    /// How the strokes can be read that it is about.
    ways: Option<AskedWays>,
    notices: Notices,
}

impl Dialogs {
    /// What waits for an answer above everything.
    pub(super) fn dialog(&self) -> Option<&Dialog> {
        self.dialog.as_ref()
    }

    pub(super) fn is_open(&self) -> bool {
        self.dialog.is_some()
    }

    /// Shows a dialog in the place of any other; `None` shows none.
    pub(super) fn set_dialog(&mut self, dialog: Option<Dialog>) {
        self.dialog = dialog;
    }

    /// Closes the dialog; what it held up does not come to pass.
    pub(super) fn cancel(&mut self) {
        self.dialog = None;
        self.held_up = None;
    }

    /// Asks about unsaved changes before this.
    pub(super) fn hold_up(&mut self, action: Action) {
        self.held_up = Some(action);
        self.dialog = Some(Dialog::Unsaved);
    }

    /// What waited for the answer about unsaved changes.
    pub(super) fn take_held_up(&mut self) -> Option<Action> {
        self.held_up.take()
    }

    /// The menu that asks what a stroke is, or what to draw.
    pub(super) fn part_menu(&self) -> Option<PartMenu> {
        self.part_menu
    }

    /// Opens that menu.
    pub(super) fn ask_for_part(&mut self, menu: PartMenu) {
        self.part_menu = Some(menu);
        self.ways = None;
    }

    /// Closes it.
    pub(super) fn close_part_menu(&mut self) {
        self.part_menu = None;
        self.ways = None;
    }

    /// How the strokes can be read that the menu is about.
    pub(super) fn ways(&self) -> Option<&AskedWays> {
        self.ways.as_ref()
    }

    /// These ways were asked for.
    pub(super) fn set_ways(&mut self, ways: AskedWays) {
        self.ways = Some(ways);
    }

    /// The ways to read these strokes have been found.
    pub(super) fn ways_found(&mut self, about: &[StrokeId], ways: Vec<WayToRead>) {
        if let Some(asked) = &mut self.ways {
            asked.take(about, ways);
        }
    }

    /// Shows a message.
    pub(super) fn notify(&mut self, notice: Notice) {
        tracing::debug!("notice: {} {}", notice.what, notice.remedy);
        self.notices.add(notice, Instant::now());
    }

    /// The messages.
    pub(super) fn notices(&self) -> &Notices {
        &self.notices
    }

    /// The messages, to be put away or kept.
    pub(super) fn notices_mut(&mut self) -> &mut Notices {
        &mut self.notices
    }
}
