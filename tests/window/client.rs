//! Another program on the display: it asks windows to close, and drags files onto them (XDND, version 5).

use crate::screen::Screen;
use std::path::Path;
use std::time::{Duration, Instant};
use x11rb::connection::Connection as _;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    Atom, BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ChangeWindowAttributesAux, ClientMessageEvent,
    ConnectionExt as _, CreateWindowAux, EventMask, MOTION_NOTIFY_EVENT, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, SelectionRequestEvent, Window, WindowClass,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;
use x11rb::{COPY_DEPTH_FROM_PARENT, CURRENT_TIME};

/// Longest wait for an answer.
const PATIENCE: Duration = Duration::from_secs(30);

pub(crate) struct Client {
    server: RustConnection,
    window: Window,
}

impl Client {
    pub(crate) fn on(screen: &Screen) -> Self {
        let (server, number) = x11rb::connect(Some(&screen.display)).unwrap();
        let (window, root) = (server.generate_id().unwrap(), server.setup().roots[number].root);
        let looks = CreateWindowAux::new();
        let class = WindowClass::INPUT_OUTPUT;
        server.create_window(COPY_DEPTH_FROM_PARENT, window, root, 0, 0, 1, 1, 0, class, 0, &looks).unwrap();
        Self { server, window }
    }

    fn atom(&self, name: &str) -> Atom {
        self.server.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom
    }

    fn send(&self, to: Window, what: &str, data: [u32; 5]) {
        let message = ClientMessageEvent::new(32, to, self.atom(what), data);
        self.server.send_event(false, to, EventMask::NO_EVENT, message).unwrap();
        self.server.flush().unwrap();
    }

    /// What a window manager sends when the button in the title bar is pressed.
    pub(crate) fn close(&self, window: &str) {
        let delete = self.atom("WM_DELETE_WINDOW");
        self.send(window.parse().unwrap(), "WM_PROTOCOLS", [delete, CURRENT_TIME, 0, 0, 0]);
    }

    /// Says of a window, as a window manager does, that it fills its monitor.
    pub(crate) fn call_maximised(&self, window: &str) {
        let states =
            ["_NET_WM_STATE_MAXIMIZED_HORZ", "_NET_WM_STATE_MAXIMIZED_VERT"].map(|name| self.atom(name));
        let (window, property) = (window.parse().unwrap(), self.atom("_NET_WM_STATE"));
        let atom = x11rb::protocol::xproto::AtomEnum::ATOM;
        let said = self.server.change_property32(PropMode::REPLACE, window, property, atom, &states);
        // Heard by the server before the caller goes on.
        said.unwrap().check().unwrap();
    }

    /// Says, as a window manager does, what its panels leave of the screen: left, top, width, height.
    pub(crate) fn call_work_area(&self, area: [u32; 4]) {
        let (root, property) = (self.server.setup().roots[0].root, self.atom("_NET_WORKAREA"));
        let kind = x11rb::protocol::xproto::AtomEnum::CARDINAL;
        let said = self.server.change_property32(PropMode::REPLACE, root, property, kind, &area);
        said.unwrap().check().unwrap();
    }

    /// Paints the screen behind all windows, and hears of windows from then on.
    pub(crate) fn paint_root(&self, [r, g, b]: [u8; 3]) {
        let root = self.server.setup().roots[0].root;
        let pixel = u32::from_be_bytes([0, r, g, b]);
        let looks = ChangeWindowAttributesAux::new()
            .background_pixel(pixel)
            .event_mask(EventMask::SUBSTRUCTURE_NOTIFY);
        self.server.change_window_attributes(root, &looks).unwrap().check().unwrap();
        self.server.clear_area(false, root, 0, 0, 0, 0).unwrap().check().unwrap();
    }

    /// Waits until a window that is no mere helper is seen on the screen.
    pub(crate) fn wait_for_large_window(&self) {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            match self.server.poll_for_event().unwrap() {
                Some(Event::MapNotify(seen)) => {
                    let size = self.server.get_geometry(seen.window).unwrap().reply().unwrap();
                    if size.width > 600 {
                        return;
                    }
                }
                Some(_) => {}
                None => std::thread::sleep(Duration::from_millis(1)),
            }
        }
        panic!("no window opens");
    }

    /// Moves the pointer to a place on the screen.
    pub(crate) fn point(&self, [x, y]: [f64; 2]) {
        let root = self.server.setup().roots[0].root;
        self.fake(MOTION_NOTIFY_EVENT, 0, root, (x.round() as i16, y.round() as i16));
    }

    /// Presses or releases the left button.
    pub(crate) fn press(&self, is_down: bool) {
        let kind = if is_down { BUTTON_PRESS_EVENT } else { BUTTON_RELEASE_EVENT };
        self.fake(kind, 1, x11rb::NONE, (0, 0));
    }

    fn fake(&self, kind: u8, detail: u8, root: Window, (x, y): (i16, i16)) {
        self.server.xtest_fake_input(kind, detail, CURRENT_TIME, root, x, y, 0).unwrap();
        self.server.flush().unwrap();
    }

    /// Drags a file to a place on the screen above a window, and drops it there.
    pub(crate) fn drop_file(&self, window: &str, [x, y]: [f64; 2], file: &Path) {
        let to: Window = window.parse().unwrap();
        let (list, copy) = (self.atom("text/uri-list"), self.atom("XdndActionCopy"));
        let selection = self.atom("XdndSelection");
        self.server.set_selection_owner(self.window, selection, CURRENT_TIME).unwrap();
        self.send(to, "XdndEnter", [self.window, 5 << 24, list, 0, 0]);
        let place = (x as u32) << 16 | y as u32;
        let begun = Instant::now();
        let accepted = || {
            self.send(to, "XdndPosition", [self.window, 0, place, CURRENT_TIME, copy]);
            let status = self.message("XdndStatus", file);
            status[1] & 1 == 1
        };
        while !accepted() {
            assert!(begun.elapsed() < PATIENCE, "a dragged file is not welcome");
            std::thread::sleep(Duration::from_millis(30));
        }
        self.send(to, "XdndDrop", [self.window, 0, CURRENT_TIME, 0, 0]);
        self.message("XdndFinished", file);
    }

    /// Waits for a message, and meanwhile hands over what is dragged to whoever asks.
    fn message(&self, name: &str, file: &Path) -> [u32; 5] {
        let (name, begun) = (self.atom(name), Instant::now());
        while begun.elapsed() < PATIENCE {
            match self.server.poll_for_event().unwrap() {
                Some(Event::ClientMessage(message)) if message.type_ == name => {
                    return message.data.as_data32();
                }
                Some(Event::SelectionRequest(request)) => self.hand_over(&request, file),
                Some(_) => {}
                None => std::thread::sleep(Duration::from_millis(5)),
            }
        }
        panic!("no answer to a drag");
    }

    fn hand_over(&self, request: &SelectionRequestEvent, file: &Path) {
        let SelectionRequestEvent { requestor, property, target, selection, time, .. } = *request;
        let text = format!("file://{}\r\n", file.display());
        self.server
            .change_property8(PropMode::REPLACE, requestor, property, target, text.as_bytes())
            .unwrap();
        let done = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time,
            requestor,
            selection,
            target,
            property,
        };
        self.server.send_event(false, requestor, EventMask::NO_EVENT, done).unwrap();
        self.server.flush().unwrap();
    }
}
