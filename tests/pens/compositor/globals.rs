//! Surfaces, buffers, the screen and the seat.

use super::{Pending, SIZE, State};
use std::os::fd::AsFd as _;
use std::sync::Mutex;
use wayland_protocols::wp::tablet::zv2::server::zwp_tablet_manager_v2::{self, ZwpTabletManagerV2};
use wayland_protocols::wp::tablet::zv2::server::zwp_tablet_seat_v2::{self, ZwpTabletSeatV2};
use wayland_protocols::wp::tablet::zv2::server::zwp_tablet_tool_v2::{
    self, Capability, Type, ZwpTabletToolV2,
};
use wayland_protocols::wp::tablet::zv2::server::zwp_tablet_v2::{self, ZwpTabletV2};
use wayland_server::protocol::wl_buffer::{self, WlBuffer};
use wayland_server::protocol::wl_callback::{self, WlCallback};
use wayland_server::protocol::wl_compositor::{self, WlCompositor};
use wayland_server::protocol::wl_keyboard::{self, KeymapFormat, WlKeyboard};
use wayland_server::protocol::wl_output::{self, Mode, Subpixel, Transform, WlOutput};
use wayland_server::protocol::wl_pointer::{self, WlPointer};
use wayland_server::protocol::wl_region::{self, WlRegion};
use wayland_server::protocol::wl_seat::{self, Capability as SeatCapability, WlSeat};
use wayland_server::protocol::wl_shm::{self, Format, WlShm};
use wayland_server::protocol::wl_shm_pool::{self, WlShmPool};
use wayland_server::protocol::wl_surface::{self, WlSurface};
use wayland_server::{Client, DataInit, Dispatch, DisplayHandle, GlobalDispatch, New, Resource};

/// Objects whose requests change nothing here.
macro_rules! deaf {
    ($($module:ident :: $object:ident),* $(,)?) => {$(
        impl Dispatch<$object, ()> for State {
            fn request(
                _: &mut Self, _: &Client, _: &$object, _: $module::Request, _: &(), _: &DisplayHandle,
                _: &mut DataInit<'_, Self>,
            ) {}
        }
    )*};
}

deaf!(
    wl_buffer::WlBuffer,
    wl_callback::WlCallback,
    wl_keyboard::WlKeyboard,
    wl_output::WlOutput,
    wl_pointer::WlPointer,
    wl_region::WlRegion,
    zwp_tablet_seat_v2::ZwpTabletSeatV2,
    zwp_tablet_tool_v2::ZwpTabletToolV2,
    zwp_tablet_v2::ZwpTabletV2,
);

/// Globals that say nothing when they are bound.
macro_rules! silent_global {
    ($($object:ident),*) => {$(
        impl GlobalDispatch<$object, ()> for State {
            fn bind(
                _: &mut Self, _: &DisplayHandle, _: &Client, new: New<$object>, _: &(), init: &mut DataInit<'_, Self>,
            ) {
                init.init(new, ());
            }
        }
    )*};
}

silent_global!(WlCompositor, ZwpTabletManagerV2);

impl Dispatch<WlCompositor, ()> for State {
    fn request(
        _: &mut Self,
        _: &Client,
        _: &WlCompositor,
        request: wl_compositor::Request,
        _: &(),
        _: &DisplayHandle,
        init: &mut DataInit<'_, Self>,
    ) {
        match request {
            wl_compositor::Request::CreateSurface { id } => {
                init.init(id, Mutex::new(Pending::default()));
            }
            wl_compositor::Request::CreateRegion { id } => {
                init.init(id, ());
            }
            _ => {}
        }
    }
}

impl Dispatch<WlSurface, Mutex<Pending>> for State {
    fn request(
        state: &mut Self,
        _: &Client,
        _: &WlSurface,
        request: wl_surface::Request,
        pending: &Mutex<Pending>,
        _: &DisplayHandle,
        init: &mut DataInit<'_, Self>,
    ) {
        let mut pending = pending.lock().unwrap();
        match request {
            wl_surface::Request::Attach { buffer, .. } => pending.buffer = buffer,
            wl_surface::Request::Frame { callback } => pending.frames.push(init.init(callback, ())),
            wl_surface::Request::Commit => {
                let time = state.time();
                if let Some(buffer) = pending.buffer.take() {
                    buffer.release();
                }
                pending.frames.drain(..).for_each(|frame| frame.done(time));
            }
            _ => {}
        }
    }
}

impl GlobalDispatch<WlShm, ()> for State {
    fn bind(
        _: &mut Self,
        _: &DisplayHandle,
        _: &Client,
        new: New<WlShm>,
        _: &(),
        init: &mut DataInit<'_, Self>,
    ) {
        let shm = init.init(new, ());
        shm.format(Format::Argb8888);
        shm.format(Format::Xrgb8888);
    }
}

impl Dispatch<WlShm, ()> for State {
    fn request(
        _: &mut Self,
        _: &Client,
        _: &WlShm,
        request: wl_shm::Request,
        _: &(),
        _: &DisplayHandle,
        init: &mut DataInit<'_, Self>,
    ) {
        if let wl_shm::Request::CreatePool { id, .. } = request {
            init.init(id, ());
        }
    }
}

impl Dispatch<WlShmPool, ()> for State {
    fn request(
        _: &mut Self,
        _: &Client,
        _: &WlShmPool,
        request: wl_shm_pool::Request,
        _: &(),
        _: &DisplayHandle,
        init: &mut DataInit<'_, Self>,
    ) {
        if let wl_shm_pool::Request::CreateBuffer { id, .. } = request {
            init.init(id, ());
        }
    }
}

impl GlobalDispatch<WlOutput, ()> for State {
    fn bind(
        _: &mut Self,
        _: &DisplayHandle,
        _: &Client,
        new: New<WlOutput>,
        _: &(),
        init: &mut DataInit<'_, Self>,
    ) {
        let output = init.init(new, ());
        output.geometry(0, 0, 340, 210, Subpixel::Unknown, "none".into(), "none".into(), Transform::Normal);
        output.mode(Mode::Current | Mode::Preferred, SIZE.0, SIZE.1, 60_000);
        output.scale(1);
        output.done();
    }
}

impl GlobalDispatch<WlSeat, ()> for State {
    fn bind(
        _: &mut Self,
        _: &DisplayHandle,
        _: &Client,
        new: New<WlSeat>,
        _: &(),
        init: &mut DataInit<'_, Self>,
    ) {
        let seat = init.init(new, ());
        seat.capabilities(SeatCapability::Keyboard | SeatCapability::Pointer);
        seat.name("seat0".into());
    }
}

impl Dispatch<WlSeat, ()> for State {
    fn request(
        state: &mut Self,
        _: &Client,
        _: &WlSeat,
        request: wl_seat::Request,
        _: &(),
        _: &DisplayHandle,
        init: &mut DataInit<'_, Self>,
    ) {
        match request {
            wl_seat::Request::GetKeyboard { id } => {
                let keyboard = init.init(id, ());
                keyboard.keymap(KeymapFormat::XkbV1, state.keymap.as_fd(), state.keymap_size);
                keyboard.repeat_info(0, 0);
                state.keyboards.push(keyboard);
            }
            wl_seat::Request::GetPointer { id } => state.pointers.push(init.init(id, ())),
            _ => {}
        }
    }
}

impl Dispatch<ZwpTabletManagerV2, ()> for State {
    fn request(
        state: &mut Self,
        client: &Client,
        _: &ZwpTabletManagerV2,
        request: zwp_tablet_manager_v2::Request,
        _: &(),
        display: &DisplayHandle,
        init: &mut DataInit<'_, Self>,
    ) {
        let zwp_tablet_manager_v2::Request::GetTabletSeat { tablet_seat, .. } = request else { return };
        let seat = init.init(tablet_seat, ());
        let version = seat.version();
        let tablet = client.create_resource::<ZwpTabletV2, (), Self>(display, version, ()).unwrap();
        seat.tablet_added(&tablet);
        tablet.name("simulated tablet".into());
        tablet.done();
        state.tablet = Some(tablet);
        let tool = |kind: Type| {
            let tool = client.create_resource::<ZwpTabletToolV2, (), Self>(display, version, ()).unwrap();
            seat.tool_added(&tool);
            tool._type(kind);
            tool.capability(Capability::Pressure);
            tool.capability(Capability::Tilt);
            tool.done();
            Some(tool)
        };
        state.tip = tool(Type::Pen);
        state.eraser = tool(Type::Eraser);
    }
}
