//! Everything that points at the window: pointers of winit, pens of X11 beside them, tablets read directly; one at a time.
//!
//! Each way in has a module of its own; here they meet the arbiter. What comes out is in order and is the window's to
//! hand on. The system is asked for the place of monitors only if a tablet covers one.

use super::action::Action;
use super::desktop;
use super::messages::Localize;
use super::pen_settings::TabletDoubt;
use super::settings::Settings;
use super::tablets::{Reach, Tablets};
use crate::pen::hid::replay::Stage;
use crate::pen::hid::{Enumerate, System};
use crate::pen::mapping::Rect;
use crate::pen::x11::X11PenError;
use crate::pen::{Arbiter, Origin, PenEvent, PenSource, PenTool, WinitPen, X11Pens};
use glam::DVec2;
use std::time::{Duration, Instant};
use winit::dpi::PhysicalSize;
use winit::event::{ButtonSource, PointerKind, PointerSource, WindowEvent};
use winit::event_loop::ActiveEventLoop;
use winit::monitor::MonitorHandle;
use winit::window::Window;

/// An event that passed.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointerEvent {
    /// What happened.
    pub(super) event: PenEvent,
    /// It did not come through winit, so egui has not received it.
    pub(super) is_beside: bool,
    /// The way it came.
    pub(super) origin: Origin,
}

/// A pen in use.
#[derive(Clone, Copy, Debug)]
pub(super) struct PenInUse<'a> {
    /// Its tablet's name; empty for the system's pens.
    pub(super) name: &'a str,
    /// Its tablet is read directly.
    pub(super) is_raw: bool,
    /// Its charge in percent.
    pub(super) battery: Option<u8>,
}

/// All ways in.
pub(super) struct Pointers {
    winit: WinitPen,
    /// Pens that winit does not see; only under X11.
    x11: Option<X11Pens>,
    tablets: Tablets,
    /// Where tablets could reach when they were last read.
    reach: Option<Reach>,
    /// The tablets are a recording's, which waits for the window.
    stage: Option<Stage>,
    arbiter: Arbiter,
    /// What times count from.
    started: Instant,
    /// Room for the events of one way in, and for those that the arbiter lets pass.
    events: Vec<PenEvent>,
    passed: Vec<PenEvent>,
    of_tablets: Vec<(Origin, PenEvent)>,
}

impl Pointers {
    /// Begins to listen; `system` says where tablets are looked for. Without X11's pens, mice and fingers still point.
    pub(super) fn open(
        event_loop: &dyn ActiveEventLoop,
        window: &dyn Window,
        system: impl Fn(PenSource) -> Box<dyn Enumerate> + 'static,
    ) -> (Self, Option<X11PenError>) {
        let started = Instant::now();
        let (x11, trouble) = match x11_pens(event_loop, window, started) {
            Some(Ok(pens)) => (Some(pens), None),
            Some(Err(error)) => (None, Some(error)),
            None => (None, None),
        };
        let proxy = event_loop.create_proxy();
        let pointers = Self {
            winit: WinitPen::new(),
            x11,
            tablets: Tablets::new(system, move || proxy.wake_up(), started),
            reach: None,
            stage: None,
            arbiter: Arbiter::default(),
            started,
            events: Vec::new(),
            passed: Vec::new(),
            of_tablets: Vec::new(),
        };
        (pointers, trouble)
    }

    /// The same with a recording's tablets, which play as soon as the window can be drawn in.
    pub(super) fn replay(
        event_loop: &dyn ActiveEventLoop,
        window: &dyn Window,
        stage: Stage,
    ) -> (Self, Option<X11PenError>) {
        let system = stage.clone();
        let (pointers, trouble) = Self::open(event_loop, window, move |_| Box::new(system.clone()));
        (Self { stage: Some(stage), ..pointers }, trouble)
    }

    /// The tablets of this machine; left to itself, the program does not take those that the system serves.
    pub(super) fn of_machine(source: PenSource) -> Box<dyn Enumerate> {
        match source {
            PenSource::Raw => Box::new(System::new()),
            PenSource::Auto | PenSource::System => Box::new(System::without_served()),
        }
    }

    /// The pen that events of this origin are of; none of a mouse.
    pub(super) fn pen(&self, origin: Origin) -> Option<PenInUse<'_>> {
        match origin {
            Origin::Direct(id) => {
                let name = self.tablets.name(id)?;
                Some(PenInUse { name, is_raw: true, battery: self.tablets.battery(id) })
            }
            Origin::System => Some(PenInUse { name: "", is_raw: false, battery: None }),
            Origin::Mouse => None,
        }
    }

    /// Where tablets may reach, as far as that was asked.
    pub(super) fn reach(&self) -> Option<&Reach> {
        self.reach.as_ref()
    }

    /// Actions of keys and wheels of tablets since the last call.
    pub(super) fn actions(&mut self) -> Vec<Action> {
        self.tablets.actions()
    }

    /// Why a tablet cannot be read, and what to do.
    pub(super) fn trouble(&self) -> Option<&dyn Localize> {
        self.tablets.trouble()
    }

    /// Tablets of which it is not sure which model they are.
    pub(super) fn doubts(&self) -> &[TabletDoubt] {
        self.tablets.doubts()
    }

    /// Handles an event of winit. Whether something was not let pass: it is the shadow of a pen, and nobody else's event either.
    pub(super) fn window_event(&mut self, event: &WindowEvent, out: &mut Vec<PointerEvent>) -> bool {
        if self.x11.is_some() {
            // Under X11 pens too come into the window as mice; a mouse that does so moves next.
            if matches!(event, WindowEvent::PointerEntered { kind: PointerKind::Mouse, .. }) {
                return false;
            }
            // What winit makes of touches for the mouse has no device.
            let is_mouse = matches!(
                event,
                WindowEvent::PointerMoved { device_id: Some(_), source: PointerSource::Mouse, .. }
                    | WindowEvent::PointerButton { button: ButtonSource::Mouse(_), .. }
            );
            if is_mouse {
                let now_ms = self.now_ms();
                self.handle_x11(|pens, events| pens.mouse_moved(now_ms, events), out);
            }
        }
        let mut events = std::mem::take(&mut self.events);
        self.winit.event(event, self.now_ms(), &mut events);
        let mut is_shadow = false;
        for event in events.drain(..) {
            let origin = if event.sample.tool == PenTool::Mouse { Origin::Mouse } else { Origin::System };
            is_shadow |= !self.admit(event, origin, false, out);
        }
        self.events = events;
        is_shadow
    }

    /// Takes what other threads have read: pens of X11, and tablets that are read directly.
    pub(super) fn take(&mut self, place: &Place<'_>, settings: &Settings, out: &mut Vec<PointerEvent>) {
        self.handle_x11(X11Pens::take, out);
        let mut events = std::mem::take(&mut self.of_tablets);
        let has_focus = place.window.has_focus();
        let source = match &self.stage {
            Some(stage) => {
                if has_focus && place.canvas.max.x > place.canvas.min.x {
                    stage.begin();
                }
                PenSource::Raw
            }
            None => settings.pen_source,
        };
        self.arbiter.set_source(source);
        self.tablets.obey(source, &settings.tablet_models, &mut events);
        self.tablets.listen(has_focus, &mut events);
        if self.tablets.are_there() {
            let reach = place.reach(self.tablets.cover_monitor(|name| settings.pen(name)));
            self.tablets.take(&reach, |name| settings.pen(name), &mut events);
            self.reach = Some(reach);
        }
        for (origin, event) in events.drain(..) {
            self.admit(event, origin, true, out);
        }
        self.of_tablets = events;
    }

    /// Lets a pen leave that was silent for so long that it must have; only X11 needs it.
    pub(super) fn idle(&mut self, out: &mut Vec<PointerEvent>) {
        let now_ms = self.now_ms();
        self.handle_x11(|pens, events| pens.idle(now_ms, events), out);
    }

    /// When a pen leaves that stays silent.
    pub(super) fn leaves_at(&self) -> Option<Instant> {
        let at_ms = self.x11.as_ref().and_then(X11Pens::leaves_at)?;
        Some(self.started + Duration::from_secs_f64(at_ms.max(0.0) / 1e3))
    }

    fn now_ms(&self) -> f64 {
        self.started.elapsed().as_secs_f64() * 1e3
    }

    fn handle_x11(
        &mut self,
        handle: impl FnOnce(&mut X11Pens, &mut Vec<PenEvent>),
        out: &mut Vec<PointerEvent>,
    ) {
        let Some(pens) = &mut self.x11 else { return };
        let mut events = std::mem::take(&mut self.events);
        handle(pens, &mut events);
        for event in events.drain(..) {
            self.admit(event, Origin::System, true, out);
        }
        self.events = events;
    }

    /// Appends what the arbiter makes of an event; whether that is anything.
    fn admit(
        &mut self,
        event: PenEvent,
        origin: Origin,
        is_beside: bool,
        out: &mut Vec<PointerEvent>,
    ) -> bool {
        self.arbiter.pass(event, origin, &mut self.passed);
        let has_passed = !self.passed.is_empty();
        out.extend(self.passed.drain(..).map(|event| PointerEvent { event, is_beside, origin }));
        has_passed
    }
}

/// Most monitors among which one is chosen.
const MOST_MONITORS: usize = 8;

/// Where the window and its paper are.
pub(super) struct Place<'a> {
    /// The window.
    pub(super) window: &'a dyn Window,
    /// Its size, as last reported: asking X would cost a turn of the server with every sample.
    pub(super) size: PhysicalSize<u32>,
    /// The paper, in physical pixels of the window.
    pub(super) canvas: Rect,
}

impl Place<'_> {
    /// What tablets may cover.
    fn reach(&self, asks_for_monitor: bool) -> Reach {
        let whole = |min: DVec2, size: PhysicalSize<u32>| Rect {
            min,
            max: min + DVec2::new(f64::from(size.width), f64::from(size.height)),
        };
        let (monitor, monitors) =
            if asks_for_monitor { (self.monitor(), self.monitors()) } else { (None, Vec::new()) };
        Reach {
            canvas: self.canvas,
            window: whole(DVec2::ZERO, self.size),
            monitor: monitor.map(|(min, size)| whole(min, size)),
            monitors: monitors.into_iter().map(|(min, size)| whole(min, size)).collect(),
        }
    }

    /// Where the corner of the monitor under the window is, seen from the window's, and its size.
    fn monitor(&self) -> Option<(DVec2, PhysicalSize<u32>)> {
        self.place_of(&self.window.current_monitor()?)
    }

    /// The same of all monitors, from left to right and from the top down.
    fn monitors(&self) -> Vec<(DVec2, PhysicalSize<u32>)> {
        let known = self.window.available_monitors().filter_map(|monitor| self.place_of(&monitor));
        let mut monitors: Vec<_> = known.take(MOST_MONITORS).collect();
        monitors.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        monitors
    }

    fn place_of(&self, monitor: &MonitorHandle) -> Option<(DVec2, PhysicalSize<u32>)> {
        let (outer, inner) = (self.window.outer_position().ok()?, self.window.surface_position());
        let (at, size) = (monitor.position()?, monitor.current_video_mode()?.size());
        let min = DVec2::new(f64::from(at.x - outer.x - inner.x), f64::from(at.y - outer.y - inner.y));
        Some((min, size))
    }
}

/// Listens to the pens of an X server; `None` on other systems.
fn x11_pens(
    event_loop: &dyn ActiveEventLoop,
    window: &dyn Window,
    started: Instant,
) -> Option<Result<X11Pens, X11PenError>> {
    let id = desktop::x11_id(window)?;
    let proxy = event_loop.create_proxy();
    let clock = move || started.elapsed().as_secs_f64() * 1e3;
    Some(X11Pens::open(id, clock, move || proxy.wake_up()))
}
