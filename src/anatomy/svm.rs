//! A trained support vector machine: its text form and its evaluation.
//!
//! The decision value of features x is Σ wᵢ·exp(−γ·|z − vᵢ|²) − offset over the support vectors vᵢ, with z the
//! standardised features; a sigmoid turns it into a probability (Platt 1999). Training lives in
//! `examples/train_classifier`; here a model is only read and evaluated.
//!
//! The text form is one keyword and its numbers to a line, support vectors (weight, then position) last:
//!
//! ```text
//! penstemon-svm 1
//! mean 0.4 0.5 0.1
//! deviation 0.3 0.2 0.1
//! gamma 0.5
//! offset 0.25
//! sigmoid -2.5 0.125
//! vectors 1
//! 4.5 -1.25 0.5 0.75
//! ```
//!
//! Reading is a `const fn`, so that the built-in model is read by the compiler and a broken one does not build. That is
//! why the reader works on bytes and keeps its first error instead of using `?`. Limits: plain decimals of at most 15
//! digits, at most [`MAX_VECTORS`] support vectors.

use thiserror::Error;

/// Number of features of a stroke.
pub const FEATURES: usize = 3;

/// Most support vectors that a model may have.
pub const MAX_VECTORS: usize = 60;

/// A model text that cannot be used.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error(
    "classifier model, line {line}: expected {expected}; train it again with the example `train_classifier`"
)]
pub struct ModelError {
    /// Line of the model text, from 1.
    pub line: u32,
    /// What should have been there.
    pub expected: &'static str,
}

/// One support vector.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SupportVector {
    weight: f32,
    position: [f32; FEATURES],
}

/// A trained machine with a radial kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Svm {
    mean: [f32; FEATURES],
    deviation: [f32; FEATURES],
    gamma: f32,
    offset: f32,
    sigmoid: [f32; 2],
    vectors: [SupportVector; MAX_VECTORS],
    count: usize,
}

impl Svm {
    /// Reads the text form.
    ///
    /// # Errors
    /// The first line that does not hold what it should.
    pub const fn parse(text: &str) -> Result<Self, ModelError> {
        let mut reader = Reader { bytes: text.as_bytes(), at: 0, line: 1, error: None };
        reader.keyword("penstemon-svm", "the header `penstemon-svm 1`");
        let version = reader.number();
        reader.check(version == 1.0, "version 1");
        let svm = reader.machine();
        match reader.error {
            Some(error) => Err(error),
            None => Ok(svm),
        }
    }

    /// How many support vectors the model has.
    pub const fn vector_count(&self) -> usize {
        self.count
    }

    /// Signed distance from the decision surface, in units of the margin; positive for the first class.
    pub fn decision(&self, features: [f32; FEATURES]) -> f32 {
        let z: [f32; FEATURES] = std::array::from_fn(|k| (features[k] - self.mean[k]) / self.deviation[k]);
        let sum: f32 = self.vectors[..self.count].iter().map(|v| v.weight * self.kernel(z, v.position)).sum();
        sum - self.offset
    }

    fn kernel(&self, a: [f32; FEATURES], b: [f32; FEATURES]) -> f32 {
        let squared: f32 = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum();
        (-self.gamma * squared).exp()
    }

    /// Probability of the first class, 0 to 1.
    pub fn probability(&self, features: [f32; FEATURES]) -> f32 {
        let [slope, shift] = self.sigmoid;
        1.0 / (1.0 + (slope * self.decision(features) + shift).exp())
    }
}

/// Walks over the bytes of a model and remembers the first thing that was wrong.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u32,
    error: Option<ModelError>,
}

impl Reader<'_> {
    const fn machine(&mut self) -> Svm {
        self.keyword("mean", "`mean` and three numbers");
        let mean = self.numbers();
        self.keyword("deviation", "`deviation` and three numbers");
        let deviation = self.numbers();
        self.check(deviation[0] > 0.0 && deviation[1] > 0.0 && deviation[2] > 0.0, "positive deviations");
        self.keyword("gamma", "`gamma` and a number");
        let gamma = self.number();
        self.check(gamma > 0.0, "a positive gamma");
        self.keyword("offset", "`offset` and a number");
        let offset = self.number();
        self.keyword("sigmoid", "`sigmoid` and two numbers");
        let sigmoid = self.numbers();
        self.check(sigmoid[0] < 0.0, "a negative slope of the sigmoid");
        self.keyword("vectors", "`vectors` and their number");
        let (vectors, count) = self.vectors();
        Svm { mean, deviation, gamma, offset, sigmoid, vectors, count }
    }

    const fn vectors(&mut self) -> ([SupportVector; MAX_VECTORS], usize) {
        let mut vectors = [SupportVector { weight: 0.0, position: [0.0; FEATURES] }; MAX_VECTORS];
        let announced = self.number();
        let count = announced as usize;
        self.check(count > 0 && count as f32 == announced, "a whole number of vectors, at least one");
        self.check(count <= MAX_VECTORS, "no more vectors than the program has room for");
        let mut i = 0;
        while i < count && self.error.is_none() {
            vectors[i] = SupportVector { weight: self.number(), position: self.numbers() };
            i += 1;
        }
        self.skip_space();
        self.check(self.at == self.bytes.len(), "nothing after the last vector");
        (vectors, count)
    }

    const fn check(&mut self, holds: bool, expected: &'static str) {
        if !holds && self.error.is_none() {
            self.error = Some(ModelError { line: self.line, expected });
        }
    }

    const fn peek(&self) -> u8 {
        if self.at < self.bytes.len() { self.bytes[self.at] } else { 0 }
    }

    const fn skip_space(&mut self) {
        while self.peek().is_ascii_whitespace() {
            if self.peek() == b'\n' {
                self.line += 1;
            }
            self.at += 1;
        }
    }

    const fn keyword(&mut self, word: &str, expected: &'static str) {
        self.skip_space();
        let mut i = 0;
        while i < word.len() && self.peek() == word.as_bytes()[i] {
            self.at += 1;
            i += 1;
        }
        self.check(i == word.len() && self.peek().is_ascii_whitespace(), expected);
    }

    const fn numbers<const N: usize>(&mut self) -> [f32; N] {
        let mut values = [0.0; N];
        let mut i = 0;
        while i < N {
            values[i] = self.number();
            i += 1;
        }
        values
    }

    /// A plain decimal such as `-12.75`, followed by white space or the end.
    const fn number(&mut self) -> f32 {
        self.skip_space();
        let negative = self.peek() == b'-';
        if negative {
            self.at += 1;
        }
        let (mut value, mut unit, mut digits, mut fraction) = (0_u64, 1_u64, 0, false);
        while self.peek().is_ascii_digit() || (self.peek() == b'.' && !fraction) {
            if self.peek() == b'.' {
                fraction = true;
            } else if digits < 15 {
                value = value * 10 + (self.peek() - b'0') as u64;
                unit *= if fraction { 10 } else { 1 };
                digits += 1;
            } else {
                self.check(false, "a number of at most 15 digits");
            }
            self.at += 1;
        }
        let ended = self.at == self.bytes.len() || self.peek().is_ascii_whitespace();
        self.check(digits > 0 && ended, "a plain decimal number");
        let magnitude = (value as f64 / unit as f64) as f32;
        if negative { -magnitude } else { magnitude }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "penstemon-svm 1\nmean 0.5 0 0\ndeviation 0.25 1 1\ngamma 0.5\noffset 0.25\n\
                        sigmoid -2 0.5\nvectors 2\n1.5 0 0 0\n-1 2 0 -0\n";

    #[test]
    fn a_model_is_evaluated_as_its_formula_says() {
        let svm = Svm::parse(GOOD).unwrap();
        // Standardised to (1, 1, 0): squared distances 2 and 2.
        let expected = 0.5 * (-1.0_f32).exp() - 0.25;
        let features = [0.75, 1.0, 0.0];
        assert!((svm.decision(features) - expected).abs() < 1e-6);
        assert!((svm.probability(features) - 1.0 / (1.0 + (0.5 - 2.0 * expected).exp())).abs() < 1e-6);
        assert_eq!(svm.vector_count(), 2);
    }

    #[test]
    fn every_broken_line_is_named() {
        let expect = |text: String, line: u32, part: &str| {
            let error = Svm::parse(&text).unwrap_err();
            assert!(error.line == line && error.expected.contains(part), "{text}: {error}");
        };
        expect(String::new(), 1, "header");
        expect(GOOD.replace("svm 1", "svm 2"), 1, "version");
        expect(GOOD.replace("mean", "means"), 2, "`mean`");
        expect(GOOD.replace("0.25 1 1", "0.25 0 1"), 3, "positive deviations");
        expect(GOOD.replace("0.25 1 1", "0.25 1e3 1"), 3, "plain decimal");
        expect(GOOD.replace("gamma 0.5", "gamma -0.5"), 4, "positive gamma");
        expect(GOOD.replace("offset 0.25", "offset 0.2.5"), 5, "plain decimal");
        expect(GOOD.replace("offset 0.25", "offset 0.1234567890123456"), 5, "15 digits");
        expect(GOOD.replace("sigmoid -2", "sigmoid 2"), 6, "negative slope");
        expect(GOOD.replace("vectors 2", "vectors 0"), 7, "at least one");
        expect(GOOD.replace("vectors 2", "vectors 1.5"), 7, "whole number");
        expect(GOOD.replace("vectors 2", "vectors 61"), 7, "no more vectors");
        expect(GOOD.replace("vectors 2", "vectors 1"), 9, "nothing after");
        expect(GOOD.replace("vectors 2", "vectors 3"), 10, "plain decimal");
        expect(GOOD.replace("-1 2", "-1 NaN"), 9, "plain decimal");
    }

    #[test]
    fn every_truncation_is_an_error() {
        for end in 0..GOOD.len() - 2 {
            assert!(Svm::parse(&GOOD[..end]).is_err(), "{}", &GOOD[..end]);
        }
    }
}
