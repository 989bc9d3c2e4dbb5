//! Seeds by chance.

use crate::random::mix;
use std::time::{SystemTime, UNIX_EPOCH};

/// A seed that differs from the last, by the clock.
pub(super) fn another_seed(last: u64) -> u64 {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    // Small enough to be read and typed.
    let seed = mix(last, now.subsec_nanos().into()) % 10_000;
    if seed == last { seed + 1 } else { seed }
}
