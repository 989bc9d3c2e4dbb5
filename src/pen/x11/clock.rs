//! The server's time on the program's clock.
//!
//! The server stamps every event in milliseconds since its start, in 32 bits that wrap after 50 days. An event cannot have
//! happened after it arrived, and the one that came fastest tells best how far the two clocks are apart. Where the server's
//! stamps fall far behind all the same (it slept, or its clock runs slow), the difference is taken anew.

/// Most that an event may seem to have been on its way, in milliseconds.
const MOST_DELAY_MS: f64 = 1000.0;

/// Turns time stamps of the server into the program's milliseconds.
#[derive(Clone, Copy, Debug, Default)]
pub struct ServerClock {
    last: Option<Last>,
}

#[derive(Clone, Copy, Debug)]
struct Last {
    stamp: u32,
    /// Server's time since the first stamp.
    server_ms: f64,
    /// What turns it into the program's.
    offset_ms: f64,
    /// Latest time given out.
    reported_ms: f64,
}

impl ServerClock {
    /// When something with this stamp, which arrived at `arrived_ms`, happened. Never before what was given out last.
    pub fn time_ms(&mut self, stamp: u32, arrived_ms: f64) -> f64 {
        let Some(last) = &mut self.last else {
            self.last = Some(Last { stamp, server_ms: 0.0, offset_ms: arrived_ms, reported_ms: arrived_ms });
            return arrived_ms;
        };
        // Seen from the last stamp the new one is at most half the circle away, forward or back.
        last.server_ms += f64::from(stamp.wrapping_sub(last.stamp).cast_signed());
        last.stamp = stamp;
        let offset_ms = arrived_ms - last.server_ms;
        if offset_ms < last.offset_ms || offset_ms > last.offset_ms + MOST_DELAY_MS {
            last.offset_ms = offset_ms;
        }
        last.reported_ms = last.reported_ms.max(last.server_ms + last.offset_ms);
        last.reported_ms
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fastest_event_gives_the_difference_of_the_clocks() {
        let mut clock = ServerClock::default();
        assert_eq!(clock.time_ms(1000, 50.0), 50.0);
        // This one was 4 ms faster; the ones after it are placed by it, however late they are.
        assert_eq!(clock.time_ms(1010, 56.0), 56.0);
        assert_eq!(clock.time_ms(1020, 90.0), 66.0);
        assert_eq!(clock.time_ms(1021, 90.0), 67.0);
    }

    #[test]
    fn stamps_wrap_and_time_does_not() {
        let mut clock = ServerClock::default();
        assert_eq!(clock.time_ms(u32::MAX - 4, 10.0), 10.0);
        assert_eq!(clock.time_ms(5, 20.0), 20.0);
    }

    #[test]
    fn a_stamp_that_goes_back_gives_no_earlier_time() {
        let mut clock = ServerClock::default();
        clock.time_ms(500, 10.0);
        assert_eq!(clock.time_ms(400, 11.0), 10.0);
    }

    #[test]
    fn a_clock_that_stood_still_is_set_again() {
        let mut clock = ServerClock::default();
        clock.time_ms(500, 10.0);
        assert_eq!(clock.time_ms(501, 5000.0), 5000.0);
    }
}
