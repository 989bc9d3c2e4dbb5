//! The thread that listens to the pens of an X server.
//!
//! It has a connection of its own to the server of `DISPLAY`, the same that winit uses, and selects on winit's window. When
//! devices come or go, or a device changes its axes, all are asked again. It ends with the window, with the connection, or
//! with its [`X11Pens`]. Nothing is merged: every event of a pen arrives, in order, with the time at which it happened.

use super::clock::ServerClock;
use super::decode::{Decoder, Reading};
use super::devices::{DeviceKind, KINDS, LABELS, PenDevice, Role};
use super::follow::PenFollower;
use crate::pen::PenEvent;
use glam::DVec2;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use thiserror::Error;
use x11rb::connection::{Connection as _, RequestConnection as _};
use x11rb::errors::{ConnectError, ConnectionError, ReplyError};
use x11rb::protocol::Event;
use x11rb::protocol::xinput::{self, ConnectionExt as _, EventMask, XIEventMask};
use x11rb::protocol::xproto::{ChangeWindowAttributesAux, ConnectionExt as _, EventMask as WindowMask};
use x11rb::rust_connection::RustConnection;

/// The version of XInput that is asked for, as winit asks.
const VERSION: (u16, u16) = (2, 2);
/// All devices, for events that name no single one.
const ALL_DEVICES: u16 = 0;
/// All pointers that the user sees on the screen.
const ALL_POINTERS: u16 = 1;

/// Why pens are not read.
#[derive(Debug, Error)]
pub enum X11PenError {
    /// No second connection.
    #[error(
        "pens have no pressure: the X server of DISPLAY takes no second connection ({0}); drawing goes on as with a mouse"
    )]
    Connect(#[from] ConnectError),
    /// The connection broke.
    #[error("pens have no pressure: the connection to the X server broke ({0}); save and start again")]
    Broken(#[from] ConnectionError),
    /// The server refused.
    #[error(
        "pens have no pressure: the X server refuses to tell of its devices ({0}); drawing goes on as with a mouse"
    )]
    Refused(#[from] ReplyError),
    /// The server is older than its pens.
    #[error("pens have no pressure: the X server has no XInput 2.2 but {0}; a newer X server has it")]
    TooOld(String),
    /// No thread.
    #[error("pens have no pressure: the system starts no thread for them ({0})")]
    Thread(#[from] std::io::Error),
}

/// The pens over a window.
#[derive(Debug)]
pub struct X11Pens {
    receiver: Receiver<(Reading, f64)>,
    /// The window was woken and has not fetched yet.
    is_notified: Arc<AtomicBool>,
    follower: PenFollower,
}

impl X11Pens {
    /// Listens to the pens over a window. `clock` gives the program's milliseconds; `wake` is called from another thread
    /// when there is something to [`X11Pens::take`].
    ///
    /// # Errors
    /// A server that cannot be reached again, or knows no pens.
    pub fn open(
        window: u32,
        clock: impl Fn() -> f64 + Send + 'static,
        wake: impl Fn() + Send + 'static,
    ) -> Result<Self, X11PenError> {
        let (connection, _) = x11rb::connect(None)?;
        let mut listener = Listener::new(connection, window)?;
        let (sender, receiver) = channel();
        let is_notified = Arc::new(AtomicBool::new(false));
        let for_thread = Arc::clone(&is_notified);
        std::thread::Builder::new().name("x11-pens".into()).spawn(move || {
            let mut sender = ReadingSender {
                sender,
                is_notified: for_thread,
                clock,
                wake,
                server: ServerClock::default(),
            };
            if let Err(error) = listener.listen(&mut sender) {
                tracing::warn!("{error}");
            }
        })?;
        Ok(Self { receiver, is_notified, follower: PenFollower::default() })
    }

    /// Appends what the pens did since the last call to `out`.
    pub fn take(&mut self, out: &mut Vec<PenEvent>) {
        self.is_notified.store(false, Ordering::Release);
        while let Ok((reading, time_ms)) = self.receiver.try_recv() {
            self.follower.feed(&reading, time_ms, out);
        }
    }

    /// The mouse moved: a hovering pen leaves.
    pub fn mouse_moved(&mut self, time_ms: f64, out: &mut Vec<PenEvent>) {
        self.take(out);
        self.follower.other_device(time_ms, out);
    }

    /// Gives the time: a hovering pen that has been silent for long leaves.
    pub fn idle(&mut self, now_ms: f64, out: &mut Vec<PenEvent>) {
        self.follower.idle(now_ms, out);
    }

    /// When [`X11Pens::idle`] wants to be called.
    pub fn leaves_at(&self) -> Option<f64> {
        self.follower.leaves_at()
    }
}

/// Sends readings to the window.
struct ReadingSender<C, W> {
    sender: Sender<(Reading, f64)>,
    is_notified: Arc<AtomicBool>,
    clock: C,
    wake: W,
    server: ServerClock,
}

impl<C: Fn() -> f64, W: Fn()> ReadingSender<C, W> {
    /// Sends a reading to the window; whether it still receives.
    fn send(&mut self, reading: Reading) -> bool {
        let time_ms = self.server.time_ms(reading.stamp, (self.clock)());
        let is_received = self.sender.send((reading, time_ms)).is_ok();
        if !self.is_notified.swap(true, Ordering::AcqRel) {
            (self.wake)();
        }
        is_received
    }
}

/// The connection and what is known of the server.
struct Listener {
    connection: RustConnection,
    window: u32,
    /// The window over all screens.
    root: u32,
    labels: Vec<(u32, Role)>,
    kinds: Vec<(u32, DeviceKind)>,
    decoder: Decoder,
}

impl Listener {
    fn new(connection: RustConnection, window: u32) -> Result<Self, X11PenError> {
        if connection.extension_information(xinput::X11_EXTENSION_NAME)?.is_none() {
            return Err(X11PenError::TooOld("none".into()));
        }
        let version = connection.xinput_xi_query_version(VERSION.0, VERSION.1)?.reply()?;
        if (version.major_version, version.minor_version) < VERSION {
            return Err(X11PenError::TooOld(format!("{}.{}", version.major_version, version.minor_version)));
        }
        let atom = |name: &str| -> Result<u32, X11PenError> {
            Ok(connection.intern_atom(false, name.as_bytes())?.reply()?.atom)
        };
        let labels =
            LABELS.iter().map(|(name, role)| Ok((atom(name)?, *role))).collect::<Result<_, X11PenError>>()?;
        let kinds =
            KINDS.iter().map(|(name, kind)| Ok((atom(name)?, *kind))).collect::<Result<_, X11PenError>>()?;
        let root = connection.get_geometry(window)?.reply()?.root;
        let mut listener = Self { connection, window, root, labels, kinds, decoder: Decoder::default() };
        listener.select_window()?;
        let desktop = listener.connection.get_geometry(root)?.reply()?;
        listener.decoder.set_desktop(DVec2::new(desktop.width.into(), desktop.height.into()));
        listener.ask_for_pens(|_| {})?;
        Ok(listener)
    }

    /// Selects the events that belong to no single pen.
    fn select_window(&self) -> Result<(), X11PenError> {
        let devices = EventMask {
            deviceid: ALL_DEVICES,
            mask: vec![XIEventMask::HIERARCHY | XIEventMask::DEVICE_CHANGED],
        };
        let crossings =
            EventMask { deviceid: ALL_POINTERS, mask: vec![XIEventMask::ENTER | XIEventMask::LEAVE] };
        self.connection.xinput_xi_select_events(self.window, &[devices, crossings])?.check()?;
        // The window's end, and the desktop's size.
        let structure = ChangeWindowAttributesAux::new().event_mask(WindowMask::STRUCTURE_NOTIFY);
        for window in [self.window, self.root] {
            self.connection.change_window_attributes(window, &structure)?.check()?;
        }
        Ok(())
    }

    /// Finds out which pens there are and asks for the events of each.
    fn ask_for_pens(&mut self, sink: impl FnMut(Reading)) -> Result<(), X11PenError> {
        let kinds = self.connection.xinput_list_input_devices()?;
        let devices = self.connection.xinput_xi_query_device(ALL_DEVICES)?;
        let (kinds, devices) = (kinds.reply()?.devices, devices.reply()?.infos);
        let kind_of = |id: u16| {
            let listed = kinds.iter().find(|device| u16::from(device.device_id) == id)?;
            known(&self.kinds, listed.device_type)
        };
        let pens: Vec<PenDevice> = devices
            .iter()
            .filter_map(|info| {
                let kind = kind_of(info.deviceid).unwrap_or_default();
                PenDevice::read(info, kind, |label| known(&self.labels, label))
            })
            .collect();
        for pen in &pens {
            let mask = XIEventMask::MOTION | XIEventMask::BUTTON_PRESS | XIEventMask::BUTTON_RELEASE;
            let mask = EventMask { deviceid: pen.id, mask: vec![mask | XIEventMask::DEVICE_CHANGED] };
            match self.connection.xinput_xi_select_events(self.window, &[mask])?.check() {
                // Unplugged meanwhile: the server reports that next.
                Err(ReplyError::X11Error(error)) => tracing::debug!("pen {}: {error:?}", pen.id),
                done => done?,
            }
        }
        let names = devices.iter().filter(|info| pens.iter().any(|pen| pen.id == info.deviceid));
        let names: Vec<_> = names.map(|info| String::from_utf8_lossy(&info.name)).collect();
        tracing::debug!("pens of the X server: {}: {}", names.len(), names.join(", "));
        self.decoder.set_pens(pens, sink);
        Ok(())
    }

    /// Listens until the window or the connection is gone.
    fn listen<C: Fn() -> f64, W: Fn()>(
        &mut self,
        sender: &mut ReadingSender<C, W>,
    ) -> Result<(), X11PenError> {
        loop {
            let event = self.connection.wait_for_event()?;
            let mut is_received = true;
            match &event {
                Event::XinputHierarchy(_) | Event::XinputDeviceChanged(_) => {
                    self.ask_for_pens(|reading| is_received = sender.send(reading))?;
                }
                Event::ConfigureNotify(event) if event.window == self.root => {
                    self.decoder.set_desktop(DVec2::new(event.width.into(), event.height.into()));
                }
                Event::DestroyNotify(event) if event.window == self.window => return Ok(()),
                _ => {
                    if let Some(reading) = self.decoder.decode(&event) {
                        is_received = sender.send(reading);
                    }
                }
            }
            if !is_received {
                return Ok(());
            }
        }
    }
}

fn known<T: Copy>(atoms: &[(u32, T)], atom: u32) -> Option<T> {
    atoms.iter().find(|(known, _)| *known == atom).map(|(_, meaning)| *meaning)
}
