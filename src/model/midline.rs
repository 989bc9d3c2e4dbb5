//! The middle line of a blade: where its midrib runs, half way between its two margins.
//!
//! A leaf drawn with a bow has its chord from base to tip along one margin; the midrib of a real one runs down its
//! middle. The line is a smooth curve through base and tip, `u = t (1 − t) (bow + sway (1 − 2t))` with t the share of the
//! way to the tip, fitted by least squares to the middles of the cross-sections, each weighed by its width. Two numbers
//! follow a bow and an S and pass calmly between the lobes of a maple leaf, whose sections jump from side to side.
//!
//! Limits: sections below the base and beyond the tip, where lobes reach past them, have their middle on the axis.

/// A smooth curve from the base of a blade to its tip, in blade sizes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Midline {
    /// Height of the tip, positive.
    tip: f32,
    bow: f32,
    sway: f32,
}

/// A blade with less bow than this, in blade sizes, is straight.
const STRAIGHT: f32 = 5e-3;

impl Midline {
    /// The line through the middles of sections, given as height, middle and width; the tip is `tip` high.
    pub(super) fn fit(sections: impl Iterator<Item = (f32, f32, f32)>, tip: f32) -> Self {
        let [mut bows, mut sways, mut both, mut bow, mut sway] = [0.0f32; 5];
        for (v, middle, width) in sections {
            let [b, s] = shapes(v / tip);
            bows += width * b * b;
            sways += width * s * s;
            both += width * b * s;
            bow += width * b * middle;
            sway += width * s * middle;
        }
        let determinant = bows * sways - both * both;
        let straight = Self { tip, ..Self::default() };
        if determinant <= 1e-6 * bows * sways {
            return straight;
        }
        let [bow, sway] = [bow * sways - sway * both, sway * bows - bow * both].map(|x| x / determinant);
        if bow.abs().max(sway.abs()) > STRAIGHT { Self { tip, bow, sway } } else { straight }
    }

    /// Where it lies at a height.
    pub(super) fn at(&self, v: f32) -> f32 {
        let [bow, sway] = shapes(v / self.tip);
        self.bow * bow + self.sway * sway
    }
}

/// A bow and an S at a share of the way from base to tip.
fn shapes(t: f32) -> [f32; 2] {
    let t = t.clamp(0.0, 1.0);
    let bow = t * (1.0 - t);
    [bow, bow * (1.0 - 2.0 * t)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fitted(middle: impl Fn(f32) -> f32) -> Midline {
        Midline::fit((0..32).map(|k| (k as f32 + 0.5) / 32.0).map(|v| (v, middle(v), 0.3)), 1.0)
    }

    #[test]
    fn bows_and_curves_like_an_s_are_followed() {
        for middle in [
            |v: f32| 0.2 * (std::f32::consts::PI * v).sin(),
            |v: f32| 0.1 * (std::f32::consts::TAU * v).sin(),
        ] {
            let line = fitted(middle);
            for k in 0..=20 {
                let v = k as f32 / 20.0;
                assert!((line.at(v) - middle(v)).abs() < 0.02, "{} for {} at {v}", line.at(v), middle(v));
            }
        }
    }

    #[test]
    fn it_passes_calmly_between_lobes() {
        let line = fitted(|v| if ((v * 8.0) as u32).is_multiple_of(2) { 0.1 } else { -0.1 });
        assert!((0..=20).all(|k| line.at(k as f32 / 20.0).abs() < 0.04));
    }

    #[test]
    fn a_blade_without_sections_keeps_its_axis() {
        assert_eq!(Midline::fit(std::iter::empty(), 1.0).at(0.5), 0.0);
    }
}
