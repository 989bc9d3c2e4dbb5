//! Numbers in a report, read without running over its end.

/// The bytes of one report; every number in it is little-endian.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bytes<'r>(pub(super) &'r [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(self, at: usize) -> Option<[u8; N]> {
        self.0.get(at..)?.first_chunk().copied()
    }

    pub(super) fn u8(self, at: usize) -> Option<u8> {
        self.0.get(at).copied()
    }

    pub(super) fn i8(self, at: usize) -> Option<i8> {
        self.take(at).map(i8::from_le_bytes)
    }

    pub(super) fn u16(self, at: usize) -> Option<u16> {
        self.take(at).map(u16::from_le_bytes)
    }

    pub(super) fn i16(self, at: usize) -> Option<i16> {
        self.take(at).map(i16::from_le_bytes)
    }

    pub(super) fn u24(self, at: usize) -> Option<u32> {
        self.take(at).map(|[a, b, c]| u32::from_le_bytes([a, b, c, 0]))
    }

    pub(super) fn u32(self, at: usize) -> Option<u32> {
        self.take(at).map(u32::from_le_bytes)
    }

    pub(super) fn u64(self, at: usize) -> Option<u64> {
        self.take(at).map(u64::from_le_bytes)
    }

    /// 16 bits and the bits above them, which some protocols keep elsewhere.
    pub(super) fn u16_and_above(self, at: usize, above: usize) -> Option<u32> {
        Some(u32::from(self.u16(at)?) | u32::from(self.u8(above)?) << 16)
    }

    /// Three bytes of key bits from `at`: keys 1 to 8, 9 to 16, and 17 to 20 in the low half of the last.
    pub(super) fn twenty_keys(self, at: usize) -> Option<u32> {
        self.u24(at).map(|keys| keys & 0xF_FFFF)
    }
}
