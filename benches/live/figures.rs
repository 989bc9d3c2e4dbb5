//! What was measured, by name, and how it is told.

use std::collections::BTreeMap;
use std::time::Duration;

/// Names in the order of the table, and the goal in milliseconds at the 99th percentile.
const ROWS: [(&str, Option<f64>); 13] = [
    ("ink", Some(2.0)),
    ("plant", Some(8.0)),
    ("build", None),
    ("sample", None),
    ("frame", Some(4.0)),
    ("panels", None),
    ("shapes", None),
    ("strokes", None),
    ("pen", None),
    ("submit", None),
    ("lift", None),
    ("collect", None),
    ("gap", None),
];

/// Milliseconds by name.
#[derive(Default)]
pub(crate) struct Figures(BTreeMap<&'static str, Vec<f64>>);

impl Figures {
    /// Notes one measurement.
    pub(crate) fn note(&mut self, name: &'static str, time: Duration) {
        self.0.entry(name).or_default().push(time.as_secs_f64() * 1e3);
    }

    /// Adds what another measured.
    pub(crate) fn add(&mut self, other: Self) {
        for (name, times) in other.0 {
            self.0.entry(name).or_default().extend(times);
        }
    }

    /// How often something was measured.
    pub(crate) fn count(&self, name: &str) -> usize {
        self.0.get(name).map_or(0, Vec::len)
    }

    /// How much more the last tenth of the measurements took than the first: the ratio of their medians.
    pub(crate) fn growth(&self, name: &str) -> f64 {
        let times = self.0.get(name).map_or(&[][..], Vec::as_slice);
        let tenth = times.len() / 10;
        let median = |times: &[f64]| {
            let mut times = times.to_vec();
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        };
        median(&times[times.len() - tenth..]) / median(&times[..tenth])
    }

    /// Writes the rows of the table.
    pub(crate) fn print(&self, title: &str) {
        println!("{title}");
        for (name, goal) in ROWS {
            let Some(times) = self.0.get(name) else { continue };
            let mut times = times.clone();
            times.sort_by(f64::total_cmp);
            let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
            let goal = goal.map_or(String::new(), |goal| {
                let verdict = if at(0.99) <= goal { "met" } else { "MISSED" };
                format!("  ≤ {goal} {verdict}")
            });
            let [half, p95, p99, most] = [at(0.5), at(0.95), at(0.99), at(1.0)];
            println!("  {name:8}{:7}{half:9.3}{p95:9.3}{p99:9.3}{most:9.3}{goal}", times.len());
        }
    }
}

/// Writes the heading of the table.
pub(crate) fn heading() {
    println!("  {:8}{:>7}{:>9}{:>9}{:>9}{:>9}   milliseconds", "", "count", "p50", "p95", "p99", "max");
}
