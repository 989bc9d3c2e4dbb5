//! The trained network: its file and its answer.
//!
//! A U-Net (Ronneberger, Fischer, Brox 2015): the picture is halved five times and doubled four times, what was seen on the way down
//! is seen again on the way up. In the smallest picture the habit's own numbers are added, if the habit is known.
//!
//! The file: `PENDEPTH`; version and CRC-32 of the rest, four bytes each; length of the habits' names and the names, a line each;
//! then all weights as halves, layer by layer as they are used, batch norms folded in. Written by `examples/train_depth/train.py`.
//!
//! Source: 001 §3.2.2 and fig. 3.4. Where we depart: no adversary and no colours. From a drawing nobody can tell front from back,
//! because the plant mirrored in depth gives the same drawing; an adversarial network chooses one side by chance, this one answers with
//! sizes, and which side a branch turns to is decided where it can be, among its neighbours (`depth/branch_depth.rs`).

use super::layers::{Convolution, Maps};
use super::picture::{CHANNELS, DEEPEST, Picture, SIDE};
use half::f16;
use thiserror::Error;

/// Cells along a side of an answer.
pub const CELLS: usize = SIDE / 2;
/// Channels after each halving.
const WIDTHS: [usize; 5] = [24, 40, 64, 96, 128];
/// Channels of the first layer.
const FIRST: usize = 16;
/// Channels of the answer.
const ANSWERS: usize = 4;
/// Beginning of the file.
const MAGIC: &[u8; 8] = b"PENDEPTH";
/// Version of the file that is read.
const VERSION: u32 = 1;
/// Least scale that is answered, half pictures.
const LEAST: f32 = 0.01;

/// A file that holds no network.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum NetworkError {
    /// Another kind of file.
    #[error(
        "not a file of learned depth: it does not begin with PENDEPTH; train one with the example `train_depth`"
    )]
    Foreign,
    /// Made by another version of the program.
    #[error(
        "the file of learned depth has version {0}, but this program reads version {VERSION}; take the file that came with it"
    )]
    Version(u32),
    /// Changed or cut off.
    #[error(
        "the file of learned depth is damaged: its checksum is wrong or it is cut off; take it from where the program came from"
    )]
    Damaged,
    /// A number that is none.
    #[error(
        "the file of learned depth holds weights that are no numbers; train it again with the example `train_depth`"
    )]
    NotANumber,
}

/// What the network says of a drawing, for each cell of [`CELLS`] rows from the top; lengths in shares of the picture's side.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// How likely the crown's area is that of a plant, 0 to 1.
    pub plant: f32,
    /// Half the depth of the crown.
    pub half_depth: Vec<f32>,
    /// Mean error of that, as the network expects it.
    pub error: Vec<f32>,
    /// How far the middle of the crown strays from the drawing's plane, in the mean.
    pub stray: Vec<f32>,
    /// How far wood leaves the drawing's plane, in the mean.
    pub away: Vec<f32>,
}

/// A network.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    habits: Vec<String>,
    /// Numbers of each habit, then those of an unknown one.
    rows: Vec<Vec<f32>>,
    down: Vec<Convolution>,
    bottom: Convolution,
    up: Vec<Convolution>,
    head: Convolution,
    /// Weights of the means in the smallest picture, and a constant.
    plant: (Vec<f32>, f32),
}

impl Network {
    /// The network that the program ships with; `None` in a library that was built without it.
    pub fn shipped() -> Option<&'static Self> {
        static NETWORK: std::sync::OnceLock<Option<Network>> = std::sync::OnceLock::new();
        NETWORK.get_or_init(|| Self::read(super::WEIGHTS?).ok()).as_ref()
    }

    /// Reads a file.
    ///
    /// # Errors
    /// Anything but a whole file of this version with numbers in it.
    pub fn read(bytes: &[u8]) -> Result<Self, NetworkError> {
        let rest = bytes.strip_prefix(MAGIC).ok_or(NetworkError::Foreign)?;
        let mut reader = Reader { rest };
        let version = reader.word()?;
        if version != VERSION {
            return Err(NetworkError::Version(version));
        }
        if reader.word()? != crc32fast::hash(reader.rest) {
            return Err(NetworkError::Damaged);
        }
        let length = reader.word()? as usize;
        let names = std::str::from_utf8(reader.take(length)?).map_err(|_| NetworkError::Damaged)?;
        let habits: Vec<String> = names.lines().map(str::to_owned).collect();
        let down = pairs_down().map(|(from, to, stride)| reader.convolution(from, to, stride));
        let down = down.collect::<Result<_, _>>()?;
        let [a, b, c, d, e] = WIDTHS;
        let bottom = reader.convolution(e, e, 1)?;
        let up = [(e + d, d), (d + c, c), (c + b, b), (b + a, a)];
        let up =
            up.map(|(from, to)| reader.convolution(from, to, 1)).into_iter().collect::<Result<_, _>>()?;
        let head = reader.convolution(a, ANSWERS, 1)?;
        let plant = (reader.halves(e)?, reader.halves(1)?[0]);
        let rows = (0..=habits.len()).map(|_| reader.halves(e)).collect::<Result<_, _>>()?;
        if reader.rest.is_empty() {
            Ok(Self { habits, rows, down, bottom, up, head, plant })
        } else {
            Err(NetworkError::Damaged)
        }
    }

    /// Names of the habits that it knows.
    pub fn habits(&self) -> impl Iterator<Item = &str> {
        self.habits.iter().map(String::as_str)
    }

    /// What it says of a picture; `habit` is the name of the plant's, where it is known. Whether it is a plant does not depend on that.
    pub fn answer(&self, picture: &Picture, habit: Option<&str>) -> Answer {
        let (smallest, kept) = self.halved(picture);
        let features = self.of_habit(smallest.clone(), None).means();
        let (weights, constant) = &self.plant;
        let likely: f32 = features.iter().zip(weights).map(|(mean, weight)| mean * weight).sum();
        let mut maps = self.of_habit(smallest, habit);
        for (up, seen) in self.up.iter().zip(kept.iter().rev().skip(1)) {
            maps = up.rectified(&maps.doubled().followed_by(seen));
        }
        self.answer_of(&self.head.of(&maps), picture, 1.0 / (1.0 + (-likely - constant).exp()))
    }

    /// The picture halved again and again: the smallest, and all of them, the largest first.
    fn halved(&self, picture: &Picture) -> (Maps, Vec<Maps>) {
        let mut maps = Maps { side: SIDE, cells: picture.channels().to_vec() };
        let mut kept = Vec::with_capacity(WIDTHS.len());
        for pair in self.down.chunks_exact(2) {
            maps = pair[1].rectified(&pair[0].rectified(&maps));
            kept.push(maps.clone());
        }
        (maps, kept)
    }

    /// The smallest picture with what is known of a habit.
    fn of_habit(&self, mut smallest: Maps, habit: Option<&str>) -> Maps {
        let known = habit.and_then(|name| self.habits.iter().position(|habit| habit == name));
        smallest.add(&self.rows[known.unwrap_or(self.habits.len())]);
        self.bottom.rectified(&smallest)
    }

    /// The answer from what the last layer gives, in halves of the picture.
    fn answer_of(&self, last: &Maps, picture: &Picture, plant: f32) -> Answer {
        let scale =
            |k: usize| last.channel(k).iter().map(|log| DEEPEST * log.exp().clamp(LEAST, 1.0)).collect();
        let half = picture.inflated_in_quarter_cells();
        let half_depth =
            last.channel(0).iter().zip(half).map(|(more, half)| DEEPEST * (more + half).clamp(0.0, 1.0));
        Answer { plant, half_depth: half_depth.collect(), error: scale(1), stray: scale(2), away: scale(3) }
    }
}

/// Channels before and after each layer on the way down, and its stride.
fn pairs_down() -> impl Iterator<Item = (usize, usize, usize)> {
    WIDTHS.iter().enumerate().flat_map(|(k, &width)| {
        let (from, between) = if k == 0 { (CHANNELS, FIRST) } else { (WIDTHS[k - 1], width) };
        [(from, between, 2), (between, width, 1)]
    })
}

/// What is left of a file.
struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn take(&mut self, bytes: usize) -> Result<&'a [u8], NetworkError> {
        let (taken, rest) = self.rest.split_at_checked(bytes).ok_or(NetworkError::Damaged)?;
        self.rest = rest;
        Ok(taken)
    }

    fn word(&mut self) -> Result<u32, NetworkError> {
        let (word, rest) = self.rest.split_first_chunk::<4>().ok_or(NetworkError::Damaged)?;
        self.rest = rest;
        Ok(u32::from_le_bytes(*word))
    }

    fn halves(&mut self, count: usize) -> Result<Vec<f32>, NetworkError> {
        let bytes = self.take(2 * count)?;
        let numbers: Vec<f32> =
            bytes.as_chunks::<2>().0.iter().map(|b| f16::from_le_bytes(*b).to_f32()).collect();
        if numbers.iter().all(|n| n.is_finite()) { Ok(numbers) } else { Err(NetworkError::NotANumber) }
    }

    fn convolution(&mut self, from: usize, to: usize, stride: usize) -> Result<Convolution, NetworkError> {
        Ok(Convolution { weights: self.halves(9 * from * to)?, constants: self.halves(to)?, stride })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learned_depth::picture::{Frame, Line};
    use glam::Vec2;

    const SHIPPED: &[u8] = include_bytes!("../../assets/depth/plants.bin");

    /// The picture of a shape, twice as high as wide or as it says, on a short trunk.
    fn picture(outline: Vec<Vec2>) -> Picture {
        let trunk = Line { points: vec![Vec2::ZERO, Vec2::new(0.0, -30.0)], is_trunk: true };
        let frame = Frame::around(Vec2::ZERO, outline.iter().copied()).unwrap();
        Picture::of(&frame, &[outline], &[trunk])
    }

    fn oval(width: f32, height: f32) -> Vec<Vec2> {
        let at = |k: i32| {
            let (sin, cos) = (std::f32::consts::TAU * k as f32 / 80.0).sin_cos();
            let bumps = 1.0 + 0.04 * (k as f32 * 0.9).sin();
            Vec2::new(0.5 * width * cos, -25.0 - 0.5 * height * (1.0 + sin)) * bumps
        };
        (0..80).map(at).collect()
    }

    #[test]
    fn the_shipped_network_is_read_and_knows_species() {
        let network = Network::read(SHIPPED).unwrap();
        assert!(network.habits().any(|name| name == "oak") && network.habits().count() >= 20);
    }

    #[test]
    fn crowns_are_distinguished_from_letters_and_wide_ones_are_deep() {
        let network = Network::read(SHIPPED).unwrap();
        let tree = network.answer(&picture(oval(90.0, 70.0)), None);
        assert!(tree.plant > 0.9, "{}", tree.plant);
        let letter = [
            (-30, 0),
            (-30, -90),
            (30, -90),
            (30, -70),
            (-10, -70),
            (-10, -50),
            (15, -50),
            (15, -32),
            (-10, -32),
            (-10, 0),
        ];
        let letter = letter.map(|(x, y)| Vec2::new(x as f32, y as f32 - 10.0)).to_vec();
        let letter = network.answer(&picture(letter), None);
        assert!(letter.plant < 0.5, "{}", letter.plant);
        // A flat crown is a round plate, not a sausage as Poisson's equation has it.
        let plate = picture(oval(100.0, 24.0));
        let answer = network.answer(&plate, None);
        let deepest = |cells: &[f32]| cells.iter().copied().fold(0.0, f32::max);
        let inflated: Vec<f32> = plate.inflated_in_quarter_cells().map(|half| half * DEEPEST).collect();
        assert!(deepest(&answer.half_depth) > 1.5 * deepest(&inflated), "{}", deepest(&answer.half_depth));
    }

    #[test]
    fn files_that_hold_no_network_are_refused() {
        use NetworkError::{Damaged, Foreign, NotANumber, Version};
        assert_eq!(Network::read(b"PNG").unwrap_err(), Foreign);
        assert_eq!(Network::read(b"").unwrap_err(), Foreign);
        let newer = [&SHIPPED[..8], &9u32.to_le_bytes(), &SHIPPED[12..]].concat();
        assert_eq!(Network::read(&newer).unwrap_err(), Version(9));
        for cut in [8, 11, 20, 3000, SHIPPED.len() - 1] {
            assert_eq!(Network::read(&SHIPPED[..cut]).unwrap_err(), Damaged, "cut at {cut}");
        }
        let mut changed = SHIPPED.to_vec();
        changed[5000] ^= 1;
        assert_eq!(Network::read(&changed).unwrap_err(), Damaged);
        let with_checksum = |mut bytes: Vec<u8>| {
            let sum = crc32fast::hash(&bytes[16..]);
            bytes[12..16].copy_from_slice(&sum.to_le_bytes());
            bytes
        };
        let end = SHIPPED.len();
        let nan = [&SHIPPED[..end - 2], &f16::NAN.to_le_bytes()].concat();
        assert_eq!(Network::read(&with_checksum(nan)).unwrap_err(), NotANumber);
        let longer = [SHIPPED, &[0, 0]].concat();
        assert_eq!(Network::read(&with_checksum(longer)).unwrap_err(), Damaged);
    }

    #[test]
    fn the_same_picture_gives_the_same_answer() {
        let network = Network::read(SHIPPED).unwrap();
        let picture = picture(oval(90.0, 70.0));
        let answer = network.answer(&picture, Some("oak"));
        assert_eq!(network.answer(&picture, Some("oak")), answer);
        let numbers = [&answer.half_depth, &answer.error, &answer.stray, &answer.away];
        assert!(
            numbers.iter().all(|cells| cells.iter().all(|n| n.is_finite() && (0.0..=DEEPEST).contains(n)))
        );
        assert_ne!(network.answer(&picture, Some("cypress")), answer, "a species has a form of its own");
        assert_eq!(network.answer(&picture, Some("a word")), network.answer(&picture, None));
    }
}
