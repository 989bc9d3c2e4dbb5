//! A real Xorg on a screen that is not there, with pens, a mouse and a touch screen that tests move.
//!
//! The screen is the dummy driver's, mouse and touch screen are of the server's own `inputtest` driver, fed over sockets.
//! Pens are `simpen.c`'s, which is compiled against the server's headers; where they are missing, a pen of `inputtest`
//! still has pressure, but no tilt and no other end.

use super::xorg_conf::configuration;
use std::fs;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::os::unix::net::{UnixDatagram, UnixStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Where distributions keep the server itself; the command of that name may be a wrapper that asks for a console.
const SERVERS: [&str; 4] =
    ["/usr/lib/xorg/Xorg", "/usr/libexec/Xorg", "/usr/lib/Xorg", "/usr/lib/xorg-server/Xorg"];
/// Where they keep its drivers.
const MODULES: [&str; 2] = ["/usr/lib/xorg/modules", "/usr/lib64/xorg/modules"];
/// Longest wait for anything of the server.
const PATIENCE: Duration = Duration::from_secs(30);
/// Pixels of the screen.
pub(crate) const SIZE: (u32, u32) = (1280, 800);

/// Which driver moves the pen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PenDriver {
    /// Pressure only; comes with the server.
    InputTest,
    /// With tilt, wheel, eraser and a hub to unplug it from.
    SimPen,
}

/// A running server, ended with this value.
pub(crate) struct Xorg {
    server: Child,
    folder: TempDir,
    /// For `DISPLAY`.
    pub(crate) display: String,
}

impl Xorg {
    /// Starts a server, or says what it lacks.
    pub(crate) fn start(pens: PenDriver) -> Result<Self, String> {
        let exists = |path: &&&str| Path::new(path).exists();
        let program = SERVERS.iter().find(exists).ok_or("no Xorg (Debian: xserver-xorg-core)")?;
        let modules = MODULES.iter().find(exists).ok_or("no drivers of Xorg (Debian: xserver-xorg-core)")?;
        if !Path::new(modules).join("drivers/dummy_drv.so").exists() {
            return Err("no dummy screen (Debian: xserver-xorg-video-dummy)".into());
        }
        if !Path::new(modules).join("input/inputtest_drv.so").exists() {
            return Err("no inputtest driver in this Xorg (Debian: xserver-xorg-core 21)".into());
        }
        let folder = TempDir::new().unwrap();
        if pens == PenDriver::SimPen {
            compile_driver(folder.path())?;
        }
        let conf = folder.path().join("xorg.conf");
        fs::write(&conf, configuration(folder.path(), modules, pens)).unwrap();
        let log = folder.path().join("xorg.log");
        let mut server = Command::new(program)
            .args(["-displayfd", "1", "-configdir", "/nonexistent", "-noreset", "-nolisten", "tcp"])
            .args(["-novtswitch", "-sharevts", "vt7", "-config"])
            .arg(&conf)
            .arg("-logfile")
            .arg(&log)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| format!("{program}: {error}"))?;
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        if number.trim().is_empty() {
            let _ = server.wait();
            let log = fs::read_to_string(log).unwrap_or_default();
            let why = log.lines().find(|line| line.contains("(EE)") && line.len() > 20).unwrap_or_default();
            return Err(format!("Xorg does not start here: {why}"));
        }
        Ok(Self { server, folder, display: format!(":{}", number.trim()) })
    }

    fn socket(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A device of `simpen.c` by its name.
    pub(crate) fn simpen(&self, name: &str) -> SimPen {
        let socket = UnixDatagram::unbound().unwrap();
        socket.connect(self.socket(name)).unwrap();
        SimPen { socket }
    }

    /// Plugs in a pen of `simpen.c`.
    pub(crate) fn plug(&self, name: &str) {
        let path = self.socket(name);
        self.simpen("hub").say(&format!("plug {name} STYLUS {}", path.display()));
        let deadline = Instant::now() + PATIENCE;
        while !path.exists() {
            assert!(Instant::now() < deadline, "the server does not take the pen");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// Pulls it out.
    pub(crate) fn unplug(&self, name: &str) {
        fs::remove_file(self.socket(name)).unwrap();
        self.simpen("hub").say(&format!("unplug {name}"));
    }

    /// A device of the `inputtest` driver by its name.
    pub(crate) fn inputtest(&self, name: &str) -> InputTest {
        InputTest::connect(&self.socket(name))
    }

    /// Runs xdotool on this display and returns what it prints.
    pub(crate) fn hand(&self, words: &[&str]) -> String {
        let done = Command::new("xdotool").args(words).env("DISPLAY", &self.display).output();
        let done = done.expect("xdotool, from the package of that name");
        assert!(done.status.success(), "xdotool {words:?}: {}", String::from_utf8_lossy(&done.stderr));
        String::from_utf8(done.stdout).unwrap()
    }
}

impl Drop for Xorg {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// Compiles `simpen.c` into a folder of modules.
fn compile_driver(folder: &Path) -> Result<(), String> {
    let missing = "no headers of Xorg (Debian: xserver-xorg-dev, pkg-config)";
    let flags = Command::new("pkg-config").args(["--cflags", "xorg-server"]).output().map_err(|_| missing)?;
    if !flags.status.success() {
        return Err(missing.into());
    }
    let flags = String::from_utf8(flags.stdout).unwrap();
    let modules = folder.join("modules/input");
    fs::create_dir_all(&modules).unwrap();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pens/simpen.c");
    let compiled = Command::new("gcc")
        .args(["-O1", "-shared", "-fPIC", "-o"])
        .arg(modules.join("simpen_drv.so"))
        .arg(source)
        .args(flags.split_whitespace())
        .output()
        .map_err(|_| "no gcc (Debian: gcc)")?;
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    Ok(())
}

/// A pen of `simpen.c`.
pub(crate) struct SimPen {
    socket: UnixDatagram,
}

impl SimPen {
    pub(crate) fn say(&self, line: &str) {
        // The driver reads without pause; a full queue waits.
        self.socket.send(line.as_bytes()).unwrap();
    }
}

/// Kinds of events of the `inputtest` protocol, version 1.1.
#[derive(Clone, Copy)]
enum Kind {
    Version = 0,
    Sync = 1,
    Motion = 2,
    Proximity = 3,
    Button = 4,
    Touch = 6,
}

/// A device of the `inputtest` driver: a stream of packed C structures in the machine's own byte order.
pub(crate) struct InputTest {
    stream: UnixStream,
}

impl InputTest {
    fn connect(path: &Path) -> Self {
        let mut device = Self { stream: UnixStream::connect(path).unwrap() };
        device.stream.set_read_timeout(Some(PATIENCE)).unwrap();
        // Major and minor version.
        device.send(Kind::Version, &[1, 0, 1, 0]);
        device.answer(12);
        device
    }

    fn send(&mut self, kind: Kind, body: &[u8]) {
        let mut event = Vec::new();
        event.extend((8 + body.len() as u32).to_ne_bytes());
        event.extend((kind as u32).to_ne_bytes());
        event.extend(body);
        self.stream.write_all(&event).unwrap();
    }

    fn answer(&mut self, length: usize) {
        self.stream.read_exact(&mut vec![0; length]).unwrap();
    }

    /// Waits until the server has taken everything.
    pub(crate) fn sync(&mut self) {
        self.send(Kind::Sync, &[]);
        self.answer(8);
    }

    pub(crate) fn motion(&mut self, absolute: bool, axes: &[(usize, f64)]) {
        self.send_with(Kind::Motion, &[u32::from(absolute)], axes);
    }

    pub(crate) fn proximity(&mut self, into: bool, axes: &[(usize, f64)]) {
        self.send_with(Kind::Proximity, &[u32::from(into)], axes);
    }

    pub(crate) fn button(&mut self, absolute: bool, button: u32, pressed: bool, axes: &[(usize, f64)]) {
        self.send_with(Kind::Button, &[u32::from(absolute), button, u32::from(pressed)], axes);
    }

    /// `phase` is XInput's number of the event: 18 begins, 19 moves, 20 ends.
    pub(crate) fn touch(&mut self, finger: u32, phase: u32, axes: &[(usize, f64)]) {
        self.send_with(Kind::Touch, &[finger, phase], axes);
    }

    /// An event that ends with the values of axes, which begin at a multiple of 8 bytes.
    fn send_with(&mut self, kind: Kind, words: &[u32], axes: &[(usize, f64)]) {
        const MOST_AXES: usize = 64;
        let mut body: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
        body.resize(body.len().next_multiple_of(8), 0);
        let (mut mask, mut values) = ([0u8; MOST_AXES / 8], [0f64; MOST_AXES]);
        for (axis, value) in axes {
            mask[axis / 8] |= 1 << (axis % 8);
            values[*axis] = *value;
        }
        // Whether there are values before acceleration, which there are not; then padding.
        body.extend(0u32.to_ne_bytes());
        body.extend(mask);
        body.extend([0; 4]);
        body.extend(values.iter().chain(&[0.0; MOST_AXES]).flat_map(|value| value.to_ne_bytes()));
        self.send(kind, &body);
    }
}
