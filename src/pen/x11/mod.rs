//! Pens under X11, read beside winit, whose X11 part drops them.
//!
//! A second connection to the server asks for the events of every pen over the window of winit. It asks each pen itself, not
//! the pointer that all devices move together: of two connections that ask for the buttons of one device, only one receives
//! what happens while a button is held, and for the pointer that is winit, which the mouse needs. So nothing comes twice
//! either. A device is a pen by the same mark as in winit, an axis of pressure
//! or tilt, so that every device is read by exactly one of the two.
//!
//! | file | what |
//! | --- | --- |
//! | [`devices`] | which device is a pen, and what its axes mean |
//! | [`decode`] | from events of the server to the state of the pen |
//! | [`follow`] | from states to events that obey [`super::grammar`] |
//! | [`clock`] | from the server's time to the program's |
//! | [`connection`] | the thread that listens |

pub mod clock;
pub mod connection;
pub mod decode;
pub mod devices;
pub mod follow;

pub use connection::{X11PenError, X11Pens};
