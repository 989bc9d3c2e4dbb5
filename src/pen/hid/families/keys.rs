//! Nodes that carry the keys alone.

use super::{Bytes, HidEvent, Spec};

/// Every report is about the keys.
pub(super) fn xp_pen_dedicated(_: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    b.twenty_keys(1).map(HidEvent::Keys)
}

/// Four keys; fingers of these tablets are not decoded.
pub(super) fn bamboo_v2(_: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    if b.u8(0)? != 2 { None } else { Some(HidEvent::Keys(u32::from(b.u8(1)? & 0x0F))) }
}

pub(super) fn generic(_: &Spec, b: Bytes<'_>) -> Option<HidEvent> {
    Some(HidEvent::Keys(u32::from(b.u8(3)? & 0x0F)))
}

#[cfg(test)]
mod tests {
    use super::super::Family;
    use super::super::testing::{keys, quiet, silent_when_cut, spec};

    #[test]
    fn keys_stand_where_each_family_has_them() {
        // id, keys 1-8, keys 9-16, keys 17-20 and nothing above them
        let report = [6, 0x01, 0x80, 0xF1];
        assert_eq!(keys(&mut *spec(Family::XpPenDedicatedAux, 8).decoder(), &report), 0x1_8001);
        silent_when_cut(spec(Family::XpPenDedicatedAux, 8), &report, 4);
        // id, four keys and fingers above them
        assert_eq!(keys(&mut *spec(Family::WacomBambooV2Aux, 20).decoder(), &[2, 0xF5]), 5);
        assert!(quiet(&mut *spec(Family::WacomBambooV2Aux, 20).decoder(), &[3, 0xF5]));
        silent_when_cut(spec(Family::WacomBambooV2Aux, 20), &[2, 0xF5], 2);
        // id, -, -, four keys
        assert_eq!(keys(&mut *spec(Family::AuxGeneric, 64).decoder(), &[2, 0, 0, 0x0A]), 10);
        silent_when_cut(spec(Family::AuxGeneric, 64), &[2, 0, 0, 0x0A], 4);
    }
}
