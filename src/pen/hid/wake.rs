//! Waking a tablet: what leads it from imitating a mouse to its maker's own protocol.
//!
//! A sequence is data: USB strings whose mere reading is a command, then feature reports, then output reports. The
//! executor knows no device: it speaks to [`WakeIo`]. A step that fails is reported and skipped, because firmwares differ
//! in which steps they need.

use std::io;

/// How a tablet is woken; empty for tablets that need nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Wake {
    /// Indices of USB strings to read; what they say does not matter.
    pub strings: Vec<u8>,
    /// Feature reports to send, each beginning with its id.
    pub features: Vec<Vec<u8>>,
    /// Output reports to write, each beginning with its id.
    pub outputs: Vec<Vec<u8>>,
    /// Milliseconds to wait before each feature report.
    pub pause_ms: u64,
}

/// What waking asks of an open device.
pub trait WakeIo {
    /// Reads the USB string at an index.
    ///
    /// # Errors
    /// The string cannot be read, or not over this transport.
    fn read_string(&mut self, index: u8) -> io::Result<()>;
    /// Sends a feature report that begins with its id.
    ///
    /// # Errors
    /// The device refuses it or is gone.
    fn send_feature(&mut self, report: &[u8]) -> io::Result<()>;
    /// Writes an output report that begins with its id.
    ///
    /// # Errors
    /// The device refuses it or is gone.
    fn write_output(&mut self, report: &[u8]) -> io::Result<()>;
    /// Waits.
    fn sleep(&mut self, milliseconds: u64);
}

/// One step of a sequence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WakeStep {
    /// Reading the USB string at this index.
    String(u8),
    /// Sending this feature report.
    Feature(Vec<u8>),
    /// Writing this output report.
    Output(Vec<u8>),
}

impl std::fmt::Display for WakeStep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::String(index) => write!(f, "reading string {index}"),
            Self::Feature(report) => write!(f, "feature report {report:02x?}"),
            Self::Output(report) => write!(f, "output report {report:02x?}"),
        }
    }
}

/// A step that failed; the tablet may work all the same.
#[derive(Debug, thiserror::Error)]
#[error("the tablet was not fully woken, it may go on imitating a mouse: {step} failed: {source}")]
pub struct WakeError {
    /// Which step.
    pub step: WakeStep,
    /// Why.
    pub source: io::Error,
}

impl Wake {
    /// Nothing is to be done.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.strings.is_empty() && self.features.is_empty() && self.outputs.is_empty()
    }

    /// Wakes a device. Reports shorter than the device declares (bytes, id included; 0 if not known) are filled up with
    /// zeros, which hidraw leaves to its user. Returns the steps that failed, after trying all.
    pub fn run(&self, output_length: usize, feature_length: usize, io: &mut dyn WakeIo) -> Vec<WakeError> {
        let mut failed = Vec::new();
        let mut note = |step: WakeStep, result: io::Result<()>| {
            if let Err(source) = result {
                failed.push(WakeError { step, source });
            }
        };
        for &index in &self.strings {
            note(WakeStep::String(index), io.read_string(index));
        }
        for report in &self.features {
            if self.pause_ms > 0 {
                io.sleep(self.pause_ms);
            }
            note(WakeStep::Feature(report.clone()), io.send_feature(&filled(report, feature_length)));
        }
        for report in &self.outputs {
            note(WakeStep::Output(report.clone()), io.write_output(&filled(report, output_length)));
        }
        failed
    }
}

fn filled(report: &[u8], length: usize) -> Vec<u8> {
    let mut filled = report.to_vec();
    filled.resize(length.max(report.len()), 0);
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Writes down the steps, and fails those that it is set to fail.
    #[derive(Default)]
    struct Scripted {
        log: Vec<String>,
        refuses: Option<&'static str>,
    }

    impl Scripted {
        fn note(&mut self, what: String) -> io::Result<()> {
            let refused = self.refuses.is_some_and(|start| what.starts_with(start));
            self.log.push(what);
            if refused { Err(io::Error::other("stalled")) } else { Ok(()) }
        }
    }

    impl WakeIo for Scripted {
        fn read_string(&mut self, index: u8) -> io::Result<()> {
            self.note(format!("string {index}"))
        }
        fn send_feature(&mut self, report: &[u8]) -> io::Result<()> {
            self.note(format!("feature {report:02x?}"))
        }
        fn write_output(&mut self, report: &[u8]) -> io::Result<()> {
            self.note(format!("output {report:02x?}"))
        }
        fn sleep(&mut self, milliseconds: u64) {
            self.log.push(format!("sleep {milliseconds}"));
        }
    }

    fn everything() -> Wake {
        Wake {
            strings: vec![100, 123],
            features: vec![vec![2, 2], vec![4, 0]],
            outputs: vec![vec![2, 0xB0, 4]],
            pause_ms: 150,
        }
    }

    const ALL_STEPS: [&str; 7] = [
        "string 100",
        "string 123",
        "sleep 150",
        "feature [02, 02, 00]",
        "sleep 150",
        "feature [04, 00, 00]",
        "output [02, b0, 04, 00, 00]",
    ];

    #[test]
    fn steps_come_in_order_paused_and_filled() {
        let mut device = Scripted::default();
        assert!(everything().run(5, 3, &mut device).is_empty());
        assert_eq!(device.log, ALL_STEPS);
        let mut device = Scripted::default();
        Wake { pause_ms: 0, ..everything() }.run(0, 2, &mut device);
        assert_eq!(device.log[2..], ["feature [02, 02]", "feature [04, 00]", "output [02, b0, 04]"]);
    }

    #[test]
    fn a_step_that_fails_is_reported_and_the_others_still_come() {
        for (refuses, step) in
            [("string 100", WakeStep::String(100)), ("output", WakeStep::Output(vec![2, 0xB0, 4]))]
        {
            let mut device = Scripted { refuses: Some(refuses), ..Scripted::default() };
            let failed = everything().run(5, 3, &mut device);
            assert_eq!(failed.iter().map(|error| &error.step).collect::<Vec<_>>(), [&step]);
            assert_eq!(device.log, ALL_STEPS);
            let message = failed[0].to_string();
            assert!(message.contains("stalled") && message.contains(&step.to_string()), "{message}");
        }
    }

    #[test]
    fn nothing_is_nothing() {
        assert!(Wake::default().is_empty() && !everything().is_empty());
        let mut device = Scripted::default();
        assert!(Wake::default().run(64, 64, &mut device).is_empty() && device.log.is_empty());
    }
}
