//! Changes that the window and the graphics card have to be notified of.

/// Changes that the graphics card has to be notified of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Versions {
    /// Strokes, their colours or their preview.
    pub drawing: u64,
    /// The plant, or how much of it is shown.
    pub plant: u64,
    /// The picture under the drawing.
    pub reference: u64,
}

/// Something for the clipboard.
pub(in crate::app) enum Copied {
    /// The plant's picture.
    Picture(egui::ColorImage),
    /// Strokes as the text of a sketch file.
    Text(String),
}

/// What is new for those who show the editor.
#[derive(Default)]
pub(super) struct Updates {
    versions: Versions,
    /// A new title for the window, and that which it was given last.
    title: Option<String>,
    shown_title: String,
    copied: Option<Copied>,
    /// What the clipboard holds is to be fetched.
    wants_paste: bool,
    is_closed: bool,
}

impl Updates {
    pub(super) fn versions(&self) -> Versions {
        self.versions
    }

    /// Strokes, their colours or their preview are others.
    pub(super) fn drawing_changed(&mut self) {
        self.versions.drawing += 1;
    }

    /// There is another plant, which gives strokes their colours, too.
    pub(super) fn plant_changed(&mut self) {
        self.versions.plant += 1;
        self.versions.drawing += 1;
    }

    /// The same plant is shown in another level of detail.
    pub(super) fn level_changed(&mut self) {
        self.versions.plant += 1;
    }

    /// The picture under the drawing may be another one.
    pub(super) fn reference_changed(&mut self) {
        self.versions.reference += 1;
    }

    /// The window is called like this.
    pub(super) fn set_title(&mut self, title: String) {
        if title != self.shown_title {
            self.shown_title.clone_from(&title);
            self.title = Some(title);
        }
    }

    /// A new title for the window.
    pub(super) fn take_title(&mut self) -> Option<String> {
        self.title.take()
    }

    /// Puts something on the clipboard.
    pub(super) fn copy(&mut self, what: Copied) {
        self.copied = Some(what);
    }

    /// Something for the clipboard.
    pub(super) fn take_copied(&mut self) -> Option<Copied> {
        self.copied.take()
    }

    /// Asks for what the clipboard holds.
    pub(super) fn want_paste(&mut self) {
        self.wants_paste = true;
    }

    /// Whether the clipboard's content was asked for since the last call.
    pub(super) fn take_paste_request(&mut self) -> bool {
        std::mem::take(&mut self.wants_paste)
    }

    /// The window is to close.
    pub(super) fn close(&mut self) {
        self.is_closed = true;
    }

    pub(super) fn is_closed(&self) -> bool {
        self.is_closed
    }
}
