//! Virtual HID devices: the kernel takes them for real, and tells what is asked of them.
//!
//! `/dev/uhid` is spoken in whole events, each a number and a packed structure (Linux, `Documentation/hid/uhid.rst` and
//! `include/uapi/linux/uhid.h`). A thread listens to the kernel: whoever asks for a feature report waits for the answer.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Write};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Numbers of events.
mod event {
    pub(super) const DESTROY: u32 = 1;
    pub(super) const STOP: u32 = 3;
    pub(super) const OPEN: u32 = 4;
    pub(super) const CLOSE: u32 = 5;
    pub(super) const OUTPUT: u32 = 6;
    pub(super) const GET_REPORT: u32 = 9;
    pub(super) const GET_REPORT_REPLY: u32 = 10;
    pub(super) const CREATE: u32 = 11;
    pub(super) const INPUT: u32 = 12;
    pub(super) const SET_REPORT: u32 = 13;
    pub(super) const SET_REPORT_REPLY: u32 = 14;
}

/// Longest descriptor and longest report.
const MAX_DATA: usize = 4096;
/// Room of a device's name, of its place and of its serial number.
const NAMES: [usize; 3] = [128, 64, 64];
/// Longest event: the number, then what creating a device takes.
const MAX_EVENT: usize = 4 + 128 + 64 + 64 + 2 + 2 + 4 * 4 + MAX_DATA;
/// Numbers of buses in Linux's `input.h`.
pub(crate) const USB: u16 = 3;
pub(crate) const BLUETOOTH: u16 = 5;

/// What was asked of a device.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Asked {
    /// The first handle on it was opened.
    Open,
    /// The last handle was closed.
    Close,
    /// This output report was sent to it.
    Output(Vec<u8>),
    /// This feature report was sent to it.
    Feature(Vec<u8>),
}

/// Who a device says it is.
#[derive(Clone, Copy)]
pub(crate) struct Identity {
    pub(crate) name: &'static str,
    pub(crate) bus: u16,
    pub(crate) vendor: u16,
    pub(crate) product: u16,
    pub(crate) descriptor: &'static [u8],
}

/// A device that is plugged in; dropping it unplugs it.
pub(crate) struct VirtualDevice {
    kernel: File,
    asked: Receiver<Asked>,
    listens: Option<JoinHandle<()>>,
}

impl VirtualDevice {
    /// Plugs a device in. The kernel takes it up a moment later.
    pub(crate) fn plug(who: &Identity) -> io::Result<Self> {
        let mut kernel = OpenOptions::new().read(true).write(true).open("/dev/uhid")?;
        let mut create = event::CREATE.to_le_bytes().to_vec();
        for (text, room) in [who.name, "", ""].into_iter().zip(NAMES) {
            create.extend(text.bytes());
            create.resize(create.len() + room - text.len(), 0);
        }
        create.extend((who.descriptor.len() as u16).to_le_bytes());
        create.extend(who.bus.to_le_bytes());
        for number in [who.vendor.into(), who.product.into(), 0u32, 0] {
            create.extend(number.to_le_bytes());
        }
        create.extend(who.descriptor);
        create.resize(MAX_EVENT, 0);
        kernel.write_all(&create)?;
        let (asks, asked) = channel();
        let reader = kernel.try_clone()?;
        let listens = std::thread::Builder::new().name("uhid".into()).spawn(move || listen(reader, &asks))?;
        Ok(Self { kernel, asked, listens: Some(listens) })
    }

    /// Sends an input report as the wire has it: with its id, or without for devices without ids.
    pub(crate) fn send(&mut self, report: &[u8]) -> io::Result<()> {
        let mut input = event::INPUT.to_le_bytes().to_vec();
        input.extend((report.len() as u16).to_le_bytes());
        input.extend(report);
        self.kernel.write_all(&input)
    }

    /// What was asked of it next, if anything is within `patience`.
    pub(crate) fn asked(&self, patience: Duration) -> Option<Asked> {
        self.asked.recv_timeout(patience).ok()
    }
}

impl Drop for VirtualDevice {
    fn drop(&mut self) {
        // The kernel says in turn that the device stopped, which ends the thread.
        let unplugged = self.kernel.write_all(&event::DESTROY.to_le_bytes());
        if let Some(thread) = self.listens.take().filter(|_| unplugged.is_ok()) {
            let _ = thread.join();
        }
    }
}

/// Hears the kernel until the device is unplugged.
fn listen(mut kernel: File, asks: &Sender<Asked>) {
    let mut received = vec![0; MAX_EVENT];
    while let Ok(length) = kernel.read(&mut received) {
        let received = &received[..length];
        let asked = match u32_at(received, 0) {
            event::STOP => return,
            event::OPEN => Asked::Open,
            event::CLOSE => Asked::Close,
            event::OUTPUT => Asked::Output(data(received, 4, u16_at(received, 4 + MAX_DATA))),
            // The request's number, the report's id and kind, then its length and bytes.
            event::SET_REPORT => {
                let _ = kernel.write_all(&reply(event::SET_REPORT_REPLY, received));
                Asked::Feature(data(received, 12, u16_at(received, 10)))
            }
            event::GET_REPORT => {
                let _ = kernel.write_all(&reply(event::GET_REPORT_REPLY, received));
                continue;
            }
            _ => continue,
        };
        let _ = asks.send(asked);
    }
}

/// An answer to a request: its number, and no error; where a report is asked for, an empty one.
fn reply(kind: u32, request: &[u8]) -> Vec<u8> {
    let mut reply = kind.to_le_bytes().to_vec();
    reply.extend(u32_at(request, 4).to_le_bytes());
    reply.resize(MAX_EVENT, 0);
    reply
}

fn data(event: &[u8], at: usize, length: u16) -> Vec<u8> {
    event.get(at..at + usize::from(length)).unwrap_or_default().to_vec()
}

fn u16_at(event: &[u8], at: usize) -> u16 {
    event.get(at..at + 2).and_then(|b| b.try_into().ok()).map_or(0, u16::from_le_bytes)
}

fn u32_at(event: &[u8], at: usize) -> u32 {
    event.get(at..at + 4).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes)
}
