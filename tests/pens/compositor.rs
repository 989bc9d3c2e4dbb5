//! A Wayland compositor without a screen: just enough for the program to open its window, and a tablet to draw on it.
//!
//! Surfaces take buffers and show them to nobody; every frame counts as seen at once. There is one seat with a keyboard, a
//! mouse, and a tablet with a pen and its eraser. It runs on a thread of its own; the test asks it to do things and waits
//! until they are done.

mod globals;
mod shell;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};
use wayland_protocols::wp::tablet::zv2::server::zwp_tablet_manager_v2::ZwpTabletManagerV2;
use wayland_protocols::wp::tablet::zv2::server::zwp_tablet_tool_v2::{
    ButtonState as PenButton, ZwpTabletToolV2,
};
use wayland_protocols::wp::tablet::zv2::server::zwp_tablet_v2::ZwpTabletV2;
use wayland_protocols::xdg::shell::server::xdg_wm_base::XdgWmBase;
use wayland_server::backend::{ClientData, ClientId, DisconnectReason};
use wayland_server::protocol::wl_buffer::WlBuffer;
use wayland_server::protocol::wl_callback::WlCallback;
use wayland_server::protocol::wl_compositor::WlCompositor;
use wayland_server::protocol::wl_keyboard::{KeyState, WlKeyboard};
use wayland_server::protocol::wl_output::WlOutput;
use wayland_server::protocol::wl_pointer::{ButtonState, WlPointer};
use wayland_server::protocol::wl_seat::WlSeat;
use wayland_server::protocol::wl_shm::WlShm;
use wayland_server::protocol::wl_surface::WlSurface;
use wayland_server::{Display, DisplayHandle, ListeningSocket};

/// Size of the window that the compositor asks for.
pub(crate) const SIZE: (i32, i32) = (1280, 800);
/// Name of the socket, for `WAYLAND_DISPLAY`.
pub(crate) const SOCKET: &str = "wayland-pens";
/// How often the compositor looks for news.
const BEAT: Duration = Duration::from_millis(1);
/// Longest wait for the compositor to do something.
const PATIENCE: Duration = Duration::from_secs(60);

/// Bit of the Ctrl key among the modifiers of the usual keymap.
const CTRL: u32 = 1 << 2;
/// States of a pen's button.
pub(crate) const PRESSED: PenButton = PenButton::Pressed;
pub(crate) const RELEASED: PenButton = PenButton::Released;
/// Linux's code of the left button of a mouse.
const BTN_LEFT: u32 = 0x110;

/// Something that the compositor shall do.
type Order = Box<dyn FnOnce(&mut State) -> bool + Send>;

/// A running compositor, ended with this value.
pub(crate) struct Compositor {
    orders: Sender<(Order, Sender<bool>)>,
}

/// Which end of the pen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    Tip,
    Eraser,
}

/// What the compositor knows.
pub(crate) struct State {
    begun: Instant,
    serial: u32,
    /// A file with the keymap, which clients map.
    keymap: std::fs::File,
    keymap_size: u32,
    /// The window's surface, once it has shown something.
    window: Option<WlSurface>,
    keyboards: Vec<WlKeyboard>,
    pointers: Vec<WlPointer>,
    tablet: Option<ZwpTabletV2>,
    tip: Option<ZwpTabletToolV2>,
    eraser: Option<ZwpTabletToolV2>,
}

struct Client;

impl ClientData for Client {
    fn initialized(&self, _: ClientId) {}
    fn disconnected(&self, _: ClientId, _: DisconnectReason) {}
}

impl Compositor {
    /// Listens in a folder, which is `XDG_RUNTIME_DIR` to clients.
    pub(crate) fn start(folder: &Path) -> Self {
        let (orders, ordered) = channel();
        let (socket, keymap) = (folder.join(SOCKET), folder.join("keymap"));
        let listener = ListeningSocket::bind_absolute(socket).unwrap();
        std::thread::spawn(move || run(&listener, &keymap, &ordered));
        Self { orders }
    }

    /// Has something done; whether it could be.
    fn ask(&self, order: impl FnOnce(&mut State) -> bool + Send + 'static) -> bool {
        let (done, is_done) = channel();
        self.orders.send((Box::new(order), done)).unwrap();
        is_done.recv_timeout(PATIENCE).expect("the compositor is gone")
    }

    /// Waits until the window is there and listens to all devices, and gives it the keyboard.
    pub(crate) fn wait_for_window(&self) {
        let deadline = Instant::now() + PATIENCE;
        while !self.ask(State::focus) {
            assert!(Instant::now() < deadline, "no window");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Presses Ctrl and a key, told by Linux's code.
    pub(crate) fn press_ctrl(&self, key: u32) {
        self.ask(move |state| {
            let (serial, time) = (state.next(), state.time());
            for keyboard in &state.keyboards {
                keyboard.modifiers(serial, CTRL, 0, 0, 0);
                keyboard.key(serial, time, key, KeyState::Pressed);
                keyboard.key(serial, time, key, KeyState::Released);
                keyboard.modifiers(serial, 0, 0, 0, 0);
            }
            true
        });
    }

    /// Draws with the left button of the mouse.
    pub(crate) fn drag(&self, places: Vec<[f64; 2]>) {
        self.ask(move |state| {
            let Some(window) = state.window.clone() else { return false };
            let (serial, time) = (state.next(), state.time());
            for pointer in &state.pointers {
                pointer.enter(serial, &window, places[0][0], places[0][1]);
                pointer.frame();
                pointer.button(serial, time, BTN_LEFT, ButtonState::Pressed);
                pointer.frame();
                for [x, y] in &places[1..] {
                    pointer.motion(time, *x, *y);
                    pointer.frame();
                }
                pointer.button(serial, time, BTN_LEFT, ButtonState::Released);
                pointer.frame();
                pointer.leave(serial, &window);
                pointer.frame();
            }
            true
        });
    }

    /// Has one end of the pen say something; a frame ends it.
    pub(crate) fn pen(
        &self,
        end: End,
        say: impl FnOnce(&ZwpTabletToolV2, &WlSurface, &ZwpTabletV2, u32) + Send + 'static,
    ) {
        let done = self.ask(move |state| {
            let (serial, time) = (state.next(), state.time());
            let tool = if end == End::Tip { &state.tip } else { &state.eraser };
            let (Some(tool), Some(window), Some(tablet)) = (tool, &state.window, &state.tablet) else {
                return false;
            };
            say(tool, window, tablet, serial);
            tool.frame(time);
            true
        });
        assert!(done, "the window does not listen to tablets");
    }
}

impl State {
    fn new(keymap: &PathBuf) -> Self {
        // The client's own library fills in the rules of the usual keyboard.
        let text = "xkb_keymap { xkb_keycodes { include \"evdev\" }; xkb_types { include \"complete\" }; \
                    xkb_compat { include \"complete\" }; xkb_symbols { include \"pc+us\" }; };\0";
        std::fs::write(keymap, text).unwrap();
        Self {
            begun: Instant::now(),
            serial: 0,
            keymap: std::fs::File::open(keymap).unwrap(),
            keymap_size: text.len() as u32,
            window: None,
            keyboards: Vec::new(),
            pointers: Vec::new(),
            tablet: None,
            tip: None,
            eraser: None,
        }
    }

    fn next(&mut self) -> u32 {
        self.serial += 1;
        self.serial
    }

    fn time(&self) -> u32 {
        self.begun.elapsed().as_millis() as u32
    }

    /// Gives the window the keyboard, if it is there.
    fn focus(&mut self) -> bool {
        let is_ready = self.tip.is_some() && !self.keyboards.is_empty() && !self.pointers.is_empty();
        let Some(window) = self.window.clone().filter(|_| is_ready) else { return false };
        let serial = self.next();
        for keyboard in &self.keyboards {
            keyboard.enter(serial, &window, Vec::new());
            keyboard.modifiers(serial, 0, 0, 0, 0);
        }
        true
    }
}

fn offer(display: &DisplayHandle) {
    display.create_global::<State, WlCompositor, ()>(4, ());
    display.create_global::<State, WlShm, ()>(1, ());
    display.create_global::<State, WlOutput, ()>(2, ());
    display.create_global::<State, WlSeat, ()>(5, ());
    display.create_global::<State, XdgWmBase, ()>(2, ());
    display.create_global::<State, ZwpTabletManagerV2, ()>(1, ());
}

/// Serves clients until nobody gives orders any more.
fn run(listener: &ListeningSocket, keymap: &PathBuf, orders: &Receiver<(Order, Sender<bool>)>) {
    let mut display: Display<State> = Display::new().unwrap();
    offer(&display.handle());
    let mut state = State::new(keymap);
    loop {
        while let Some(stream) = listener.accept().unwrap() {
            display.handle().insert_client(stream, Arc::new(Client)).unwrap();
        }
        display.dispatch_clients(&mut state).unwrap();
        display.flush_clients().unwrap();
        match orders.recv_timeout(BEAT) {
            Ok((order, done)) => {
                let is_done = order(&mut state);
                display.flush_clients().unwrap();
                let _ = done.send(is_done);
            }
            Err(std::sync::mpsc::RecvTimeoutError::Timeout) => {}
            Err(std::sync::mpsc::RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// What a surface is told between two commits.
#[derive(Debug, Default)]
struct Pending {
    buffer: Option<WlBuffer>,
    frames: Vec<WlCallback>,
}
