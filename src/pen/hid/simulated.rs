//! Simulated devices: a bus with sockets, and devices that play reports, fall silent, are unplugged and come back.
//!
//! Tests, replays and the soak test use them in place of the system's devices; the reader and the watcher cannot tell.
//! A simulated device keeps its reports until they are read, so that what is lost was lost by the program.

use super::device::{Bus, DeviceInfo};
use super::transport::{Enumerate, Transport, TransportError};
use super::{DeviceStrings, KnownStrings, StringsKept};
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A device that tests hold one end of.
#[derive(Clone, Debug)]
pub struct SimulatedDevice {
    info: Arc<DeviceInfo>,
    descriptor: Arc<[u8]>,
    strings: Arc<KnownStrings>,
    shared: Arc<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    state: Mutex<State>,
    /// Readers wait here.
    changed: Condvar,
    /// Tests wait here for reports to be read.
    was_read: Condvar,
}

#[derive(Debug, Default)]
struct State {
    /// Reports still to be read, and the moment before which each is not there yet.
    reports: VecDeque<(Option<Instant>, Vec<u8>)>,
    /// Reports that were read, and how many threads wait for more of them; without, nobody needs to be woken for a read.
    read: usize,
    waiting_for_reads: usize,
    /// What was written to it: output reports and feature reports.
    written: Vec<Vec<u8>>,
    features: Vec<Vec<u8>>,
    is_unplugged: bool,
    /// It is unplugged by itself after its last report.
    ends: bool,
    is_stalled: bool,
    handles: usize,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        // The state is sound whatever a thread that held it died of.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change<T>(&self, change: impl FnOnce(&mut State) -> T) -> T {
        let changed = change(&mut self.state());
        self.changed.notify_all();
        changed
    }
}

impl SimulatedDevice {
    /// A device, plugged in and silent.
    pub fn new(info: DeviceInfo, descriptor: &[u8]) -> Self {
        let kept = if info.bus == Bus::Bluetooth { StringsKept::Wireless } else { StringsKept::Unanswered };
        let strings = Arc::new(KnownStrings::none(kept));
        Self { info: Arc::new(info), descriptor: descriptor.into(), strings, shared: Arc::default() }
    }

    /// The same with USB strings.
    #[must_use]
    pub fn with_strings(self, strings: KnownStrings) -> Self {
        Self { strings: Arc::new(strings), ..self }
    }

    /// Who it is.
    pub fn info(&self) -> &DeviceInfo {
        &self.info
    }

    /// Sends a report, its report id first.
    pub fn send(&self, report: &[u8]) {
        self.shared.change(|state| state.reports.push_back((None, report.to_vec())));
    }

    /// Sends a report when its time has come.
    pub fn send_at(&self, report: &[u8], when: Instant) {
        self.shared.change(|state| state.reports.push_back((Some(when), report.to_vec())));
    }

    /// Falls silent, or speaks again; reports wait meanwhile.
    pub fn stall(&self, is_stalled: bool) {
        self.shared.change(|state| state.is_stalled = is_stalled);
    }

    /// Is unplugged at once, whatever was not read yet.
    pub fn unplug(&self) {
        self.shared.change(|state| state.is_unplugged = true);
    }

    /// Is unplugged by itself when its last report was read.
    pub fn unplug_at_end(&self) {
        self.shared.change(|state| state.ends = true);
    }

    /// Reports that were read so far.
    pub fn reports_read(&self) -> usize {
        self.shared.state().read
    }

    /// Waits until this many reports were read; whether they were before `timeout` was over.
    pub fn wait_read(&self, reports: usize, timeout: Duration) -> bool {
        let mut state = self.shared.state();
        state.waiting_for_reads += 1;
        let waited = self.shared.was_read.wait_timeout_while(state, timeout, |state| state.read < reports);
        let (mut state, waited) = waited.unwrap_or_else(PoisonError::into_inner);
        state.waiting_for_reads -= 1;
        !waited.timed_out()
    }

    /// Output reports and feature reports that were written to it.
    pub fn written(&self) -> (Vec<Vec<u8>>, Vec<Vec<u8>>) {
        let state = self.shared.state();
        (state.written.clone(), state.features.clone())
    }

    /// Open handles on it.
    pub fn handles(&self) -> usize {
        self.shared.state().handles
    }

    /// Opens it.
    pub fn open(&self) -> SimulatedTransport {
        self.shared.state().handles += 1;
        SimulatedTransport { device: self.clone() }
    }
}

/// An open handle on a simulated device.
#[derive(Debug)]
pub struct SimulatedTransport {
    device: SimulatedDevice,
}

impl SimulatedTransport {
    fn gone(&self) -> TransportError {
        TransportError::Gone { path: self.device.info.path.clone() }
    }

    fn unless_gone(&self, act: impl FnOnce(&mut State)) -> Result<(), TransportError> {
        self.device.shared.change(|state| {
            if state.is_unplugged {
                return Err(self.gone());
            }
            act(state);
            Ok(())
        })
    }
}

impl Drop for SimulatedTransport {
    fn drop(&mut self) {
        self.device.shared.state().handles -= 1;
    }
}

impl Transport for SimulatedTransport {
    fn read(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, TransportError> {
        let shared = &*self.device.shared;
        let deadline = Instant::now() + timeout;
        let mut state = shared.state();
        loop {
            if state.is_unplugged || (state.ends && state.reports.is_empty()) {
                return Err(self.gone());
            }
            let now = Instant::now();
            let due =
                state.reports.front().map(|(when, _)| when.unwrap_or(now)).filter(|_| !state.is_stalled);
            if due.is_some_and(|due| due <= now) {
                let Some((_, report)) = state.reports.pop_front() else { continue };
                state.read += 1;
                let is_awaited = state.waiting_for_reads > 0;
                drop(state);
                if is_awaited {
                    shared.was_read.notify_all();
                }
                let length = report.len().min(buffer.len());
                buffer[..length].copy_from_slice(&report[..length]);
                return Ok(length);
            }
            if now >= deadline {
                return Ok(0);
            }
            let until = due.map_or(deadline, |due| due.min(deadline));
            let waited = shared.changed.wait_timeout(state, until - now);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    fn write(&mut self, report: &[u8]) -> Result<(), TransportError> {
        self.unless_gone(|state| state.written.push(report.to_vec()))
    }

    fn send_feature(&mut self, report: &[u8]) -> Result<(), TransportError> {
        self.unless_gone(|state| state.features.push(report.to_vec()))
    }

    fn descriptor(&self) -> &[u8] {
        &self.device.descriptor
    }

    fn info(&self) -> &DeviceInfo {
        &self.device.info
    }
}

/// Sockets that simulated devices are plugged into.
#[derive(Clone, Debug, Default)]
pub struct SimulatedBus {
    sockets: Arc<Mutex<Sockets>>,
}

#[derive(Debug, Default)]
struct Sockets {
    devices: BTreeMap<String, SimulatedDevice>,
    /// Paths that the user may not open.
    forbidden: Vec<String>,
}

impl SimulatedBus {
    /// A bus without devices.
    pub fn new() -> Self {
        Self::default()
    }

    fn sockets(&self) -> MutexGuard<'_, Sockets> {
        self.sockets.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Plugs a device in; one of the same path is unplugged first.
    pub fn plug(&self, device: &SimulatedDevice) {
        self.unplug(&device.info.path);
        self.sockets().devices.insert(device.info.path.clone(), device.clone());
    }

    /// Unplugs the device with this path, if there is one.
    pub fn unplug(&self, path: &str) {
        if let Some(device) = self.sockets().devices.remove(path) {
            device.unplug();
        }
    }

    /// Forbids opening a path, or allows it again.
    pub fn forbid(&self, path: &str, is_forbidden: bool) {
        let mut sockets = self.sockets();
        sockets.forbidden.retain(|forbidden| forbidden != path);
        if is_forbidden {
            sockets.forbidden.push(path.to_owned());
        }
    }

    fn device(&self, path: &str) -> Result<SimulatedDevice, TransportError> {
        self.sockets()
            .devices
            .get(path)
            .cloned()
            .ok_or_else(|| TransportError::Gone { path: path.to_owned() })
    }
}

impl Enumerate for SimulatedBus {
    fn devices(&mut self) -> Result<Vec<DeviceInfo>, TransportError> {
        Ok(self.sockets().devices.values().map(|device| device.info().clone()).collect())
    }

    fn descriptor(&mut self, device: &DeviceInfo) -> Result<Vec<u8>, TransportError> {
        Ok(self.device(&device.path)?.descriptor.to_vec())
    }

    fn strings(&mut self, device: &DeviceInfo) -> Box<dyn DeviceStrings> {
        let known = self.device(&device.path).map(|device| device.strings);
        let gone = || Arc::new(KnownStrings::none(StringsKept::Unanswered));
        Box::new(KnownStrings::clone(&known.unwrap_or_else(|_| gone())))
    }

    fn open(&mut self, device: &DeviceInfo) -> Result<Box<dyn Transport>, TransportError> {
        if self.sockets().forbidden.contains(&device.path) {
            return Err(TransportError::forbidden(device));
        }
        Ok(Box::new(self.device(&device.path)?.open()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOON: Duration = Duration::from_millis(1);

    fn device() -> SimulatedDevice {
        SimulatedDevice::new(DeviceInfo { path: "sim0".into(), ..Default::default() }, &[1, 2, 3])
    }

    #[test]
    fn reports_come_in_order_and_nothing_comes_while_it_stalls() {
        let device = device();
        let (mut open, mut buffer) = (device.open(), [0; 8]);
        device.send(&[1, 10]);
        device.send(&[2, 20, 21]);
        device.stall(true);
        assert_eq!(open.read(&mut buffer, SOON), Ok(0));
        device.stall(false);
        assert_eq!(open.read(&mut buffer, SOON), Ok(2));
        assert_eq!(open.read(&mut buffer, SOON), Ok(3));
        assert_eq!((buffer[..3].to_vec(), device.reports_read()), (vec![2, 20, 21], 2));
        assert_eq!(open.read(&mut buffer, SOON), Ok(0));
    }

    #[test]
    fn an_unplugged_device_is_gone_until_it_is_plugged_in_again() {
        let (mut bus, device) = (SimulatedBus::new(), device());
        bus.plug(&device);
        let mut open = bus.open(device.info()).unwrap();
        assert_eq!(device.handles(), 1);
        bus.unplug("sim0");
        let gone = TransportError::Gone { path: "sim0".into() };
        assert_eq!(open.read(&mut [0; 8], SOON), Err(gone.clone()));
        assert_eq!(open.write(&[1]), Err(gone.clone()));
        assert_eq!(bus.open(device.info()).map(|_| ()), Err(gone));
        drop(open);
        assert_eq!(device.handles(), 0);
        bus.plug(&self::device());
        assert!(bus.open(device.info()).is_ok());
    }
}
