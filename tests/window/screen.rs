//! A virtual X display with a frame buffer that can be read, and a hand on its mouse and keyboard.

use crate::turn::{self, Turn};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for the screen to come to rest.
const PATIENCE: Duration = Duration::from_secs(40);
/// A screen that has not changed for so long rests.
const REST: Duration = Duration::from_millis(150);

/// An X server of its own, ended with this value.
pub(crate) struct Screen {
    server: Child,
    folder: TempDir,
    /// For `DISPLAY`.
    pub(crate) display: String,
    _turn: Turn,
}

/// What is on the screen: rows of red, green, blue.
pub(crate) struct Pixels {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) rgb: Vec<u8>,
}

/// A rectangle in pixels: left, top, width, height.
pub(crate) type Area = [f64; 4];

impl Screen {
    /// A server for a test that measures: no other test runs beside it.
    pub(crate) fn start(width: u32, height: u32) -> Self {
        Self::on_turn(turn::alone(), width, height)
    }

    /// A server beside those of other tests.
    pub(crate) fn beside_others(width: u32, height: u32) -> Self {
        Self::on_turn(turn::beside_others(), width, height)
    }

    fn on_turn(_turn: Turn, width: u32, height: u32) -> Self {
        let folder = TempDir::new().unwrap();
        // Without `-noreset` the server starts anew when its last program leaves, and refuses the next one meanwhile.
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-noreset", "-nolisten", "tcp", "-dpi", "96", "-fbdir"])
            .arg(folder.path())
            .args(["-screen", "0", &format!("{width}x{height}x24")])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb, from Debian's package xvfb");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        Self { server, folder, display: format!(":{}", number.trim()), _turn }
    }

    /// Ends the server under whatever it shows.
    pub(crate) fn end(&mut self) {
        self.server.kill().unwrap();
        self.server.wait().unwrap();
    }

    /// The file that holds the frame buffer while the server runs.
    pub(crate) fn frame_buffer(&self) -> std::path::PathBuf {
        self.folder.path().join("Xvfb_screen0")
    }

    /// Runs xdotool on this display and returns what it prints.
    pub(crate) fn hand(&self, words: &[&str]) -> String {
        let done = Command::new("xdotool").args(words).env("DISPLAY", &self.display).output();
        let done = done.expect("xdotool, from the package of that name");
        assert!(done.status.success(), "xdotool {words:?}: {}", String::from_utf8_lossy(&done.stderr));
        String::from_utf8(done.stdout).unwrap()
    }

    pub(crate) fn pixels(&self) -> Pixels {
        let dump = fs::read(self.frame_buffer()).unwrap();
        let word = |i: usize| u32::from_be_bytes(dump[4 * i..4 * i + 4].try_into().unwrap());
        let (header, width, height, stride, colours) = (word(0), word(4), word(5), word(12), word(19));
        assert_eq!(word(11), 32, "bits per pixel");
        let start = (header + 12 * colours) as usize;
        let rows = (0..height as usize).map(|y| &dump[start + y * stride as usize..][..4 * width as usize]);
        let rgb = rows.flat_map(|row| row.chunks_exact(4).flat_map(|p| [p[2], p[1], p[0]])).collect();
        Pixels { width, height, rgb }
    }

    /// What is on the screen once it does not change any more; the program should be at rest.
    pub(crate) fn still(&self) -> Pixels {
        let deadline = Instant::now() + PATIENCE;
        let (mut last, mut since) = (self.pixels(), Instant::now());
        while since.elapsed() < REST {
            assert!(Instant::now() < deadline, "the screen never rests");
            std::thread::sleep(Duration::from_millis(50));
            let now = self.pixels();
            if now.rgb != last.rgb {
                (last, since) = (now, Instant::now());
            }
        }
        last
    }

    /// Presses the left button at a place.
    pub(crate) fn click(&self, [x, y]: [f64; 2]) {
        let (x, y) = (x.round().to_string(), y.round().to_string());
        self.hand(&["mousemove", &x, &y, "sleep", "0.05", "click", "1"]);
    }

    /// Draws a stroke with the left button: through these places in order.
    pub(crate) fn draw(&self, places: &[[f64; 2]]) {
        let at = |p: &[f64; 2]| p.map(|x| format!("{}", x.round()));
        let mut words = vec!["mousemove".to_owned()];
        words.extend(at(&places[0]));
        words.extend(["mousedown".to_owned(), "1".to_owned()]);
        for place in &places[1..] {
            words.push("mousemove".to_owned());
            words.extend(at(place));
            // As fast as a quick hand: every place is an event of its own.
            words.extend(["sleep".to_owned(), "0.002".to_owned()]);
        }
        words.extend(["mouseup".to_owned(), "1".to_owned()]);
        self.hand(&words.iter().map(String::as_str).collect::<Vec<_>>());
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Pixels {
    pub(crate) fn at(&self, x: u32, y: u32) -> [u8; 3] {
        let i = 3 * (y * self.width + x) as usize;
        self.rgb[i..i + 3].try_into().unwrap()
    }

    /// A place in the widest field of a colour, where it is at least as wide as a button.
    pub(crate) fn widest(&self, colour: [u8; 3]) -> Option<[f64; 2]> {
        let runs = (0..self.height).flat_map(|y| {
            let mut from = 0;
            (0..=self.width).filter_map(move |x| {
                let is_in = x < self.width && self.at(x, y) == colour;
                let run = (!is_in && x > from).then_some((x - from, from, y));
                if !is_in {
                    from = x + 1;
                }
                run
            })
        });
        let (width, left, top) = runs.max_by_key(|&(width, _, y)| (width, u32::MAX - y))?;
        // The widest run is the topmost whole row; a button is 40 points high.
        (width >= 24).then(|| [f64::from(left) + 0.5 * f64::from(width), f64::from(top) + 12.0])
    }

    /// The box of a colour, or nearly that, inside an area: left, top, right, bottom.
    pub(crate) fn extent(&self, colour: [u8; 3], [left, top, width, height]: Area) -> [f64; 4] {
        let near = |c: [u8; 3]| c.iter().zip(colour).all(|(a, b)| a.abs_diff(b) <= 24);
        let inside = |from: f64, size: f64| from as u32..(from + size) as u32;
        let places = inside(top, height).flat_map(|y| inside(left, width).map(move |x| (x, y)));
        let found: Vec<(u32, u32)> = places.filter(|&(x, y)| near(self.at(x, y))).collect();
        let span = |of: fn(&(u32, u32)) -> u32| {
            let most = found.iter().map(of).max().expect("the colour is nowhere");
            (f64::from(found.iter().map(of).min().unwrap_or(most)), f64::from(most))
        };
        let ((left, right), (top, bottom)) = (span(|p| p.0), span(|p| p.1));
        [left, top, right, bottom]
    }

    /// Share of an area's pixels that differ clearly from another picture's.
    pub(crate) fn changed(&self, other: &Pixels, area: Area) -> f64 {
        let [left, top, width, height] = area.map(|x| x as u32);
        let differs = |x, y| {
            let (a, b) = (self.at(x, y), other.at(x, y));
            a.iter().zip(b).any(|(&a, b)| a.abs_diff(b) > 24)
        };
        let places = (top..top + height).flat_map(|y| (left..left + width).map(move |x| (x, y)));
        places.filter(|&(x, y)| differs(x, y)).count() as f64 / f64::from(width * height)
    }

    /// Keeps the picture where a person can look at it.
    pub(crate) fn keep(&self, name: &str) {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("window");
        fs::create_dir_all(&folder).unwrap();
        let file = fs::File::create(folder.join(format!("{name}.png"))).unwrap();
        let mut encoder = png::Encoder::new(std::io::BufWriter::new(file), self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().unwrap().write_image_data(&self.rgb).unwrap();
    }
}
