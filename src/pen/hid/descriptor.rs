//! The decoder for every tablet that describes its own reports: HID's report descriptor says where everything lies.
//!
//! The descriptor is read once; what remains is a list of bit fields per report id, so that a report is decoded without
//! allocating and without looking anything up by usage. Combinations of bits that HID does not know are cured as it is
//! usual: an eraser without invert erases, a tip with invert erases, a tip without in-range touches. Touches that the
//! device takes for a palm are never reported. Sources: HID 1.11; HID Usage Tables 1.5; the state table of Microsoft's
//! "Required HID Top-Level Collections" for pens.

use super::descriptor_layout::{self, ContactFields, Layout, PenFields, TouchFields};
use super::field::Bits;
use super::{Decode, DescriptorError, HidEvent, RawPen};
use glam::{DVec2, Vec2};

/// Most fingers followed at once.
const MAX_FINGERS: usize = 32;
/// Mark of a report id without a layout.
const NONE: u8 = u8::MAX;

/// What a pen and its tablet can say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Abilities {
    /// Steps of pressure; 0 without.
    pub pressure_levels: u64,
    /// Lean.
    pub tilt: bool,
    /// Turn about the pen's axis.
    pub twist: bool,
    /// Height over the surface.
    pub distance: bool,
    /// An eraser end.
    pub eraser: bool,
    /// Barrel buttons.
    pub barrel_buttons: u8,
    /// Says when the pen leaves; without, it leaves when it falls silent.
    pub leaves: bool,
    /// Serial number of the pen.
    pub serial: bool,
    /// Charge of the pen or the tablet.
    pub battery: bool,
    /// Fingers on the same surface.
    pub touch: bool,
    /// There is no pen at all, but keys, rings or strips of a tablet whose pen has another node.
    pub is_pad: bool,
}

/// Decodes the reports of a device by its report descriptor.
#[derive(Clone, Debug)]
pub struct DescriptorDecoder {
    layouts: Vec<Layout>,
    /// Place in `layouts` for each report id.
    by_id: Box<[u8; 256]>,
    position: Option<DVec2>,
    battery: Option<u8>,
    keys: u32,
    fingers: Fingers,
}

/// Fingers that were reported to touch.
#[derive(Clone, Debug, Default)]
struct Fingers {
    touching: [u16; MAX_FINGERS],
    count: usize,
    /// Contacts of the current frame still to come in further reports.
    left_in_frame: usize,
}

impl DescriptorDecoder {
    /// A decoder for a device with this descriptor; `None` if it describes no pen.
    ///
    /// # Errors
    /// A descriptor that breaks the rules of HID or is too large.
    pub fn new(descriptor: &[u8]) -> Result<Option<Self>, DescriptorError> {
        Self::if_any(descriptor, |layouts| pens(layouts).any(|pen| !pen.imitates))
    }

    /// The same for a node that has only the mouse which its tablet imitates until it is woken; `None` for other mice.
    ///
    /// # Errors
    /// As before.
    pub fn of_imitation(descriptor: &[u8]) -> Result<Option<Self>, DescriptorError> {
        Self::if_any(descriptor, |layouts| pens(layouts).any(|pen| pen.imitates))
    }

    /// The same for a node without a pen that has keys, rings or strips of a tablet; `None` for other keys.
    ///
    /// # Errors
    /// As before.
    pub fn of_pad(descriptor: &[u8]) -> Result<Option<Self>, DescriptorError> {
        let has_pad = |layouts: &[Layout]| layouts.iter().any(|layout| !layout.pad.is_empty());
        Self::if_any(descriptor, |layouts| pens(layouts).next().is_none() && has_pad(layouts))
    }

    /// A decoder if the reports of the descriptor are what is asked for.
    fn if_any(descriptor: &[u8], is_it: impl Fn(&[Layout]) -> bool) -> Result<Option<Self>, DescriptorError> {
        let mut layouts = descriptor_layout::layouts(descriptor)?;
        if !is_it(&layouts) {
            return Ok(None);
        }
        layouts.truncate(usize::from(NONE));
        let mut by_id = Box::new([NONE; 256]);
        for (place, layout) in layouts.iter().enumerate() {
            by_id[usize::from(layout.id)] = place as u8;
        }
        let fingers = Fingers::default();
        Ok(Some(Self { layouts, by_id, position: None, battery: None, keys: 0, fingers }))
    }

    /// Width and height of the active area in millimetres, where the descriptor says it.
    pub fn area_mm(&self) -> Option<DVec2> {
        self.pens().find_map(|pen| pen.area_mm)
    }

    /// What the pen can say, all its reports together.
    pub fn abilities(&self) -> Abilities {
        let any = |has: fn(&PenFields) -> bool| self.pens().any(has);
        let levels = self.pens().filter_map(|p| p.pressure).map(|p| (p.high - p.low).unsigned_abs() + 1);
        let barrels = self.pens().map(|pen| pen.barrel.iter().flatten().count());
        Abilities {
            pressure_levels: levels.max().unwrap_or(0),
            tilt: any(|pen| pen.tilt.iter().all(Option::is_some)),
            twist: any(|pen| pen.twist.is_some()),
            distance: any(|pen| pen.height.is_some() || pen.distance.is_some()),
            eraser: any(|pen| pen.eraser.is_some() || pen.invert.is_some() || pen.is_eraser),
            barrel_buttons: barrels.max().unwrap_or(0) as u8,
            leaves: any(|pen| pen.in_range.is_some()),
            serial: any(|pen| pen.serial[0].is_some()),
            battery: self.layouts.iter().any(|l| l.battery.is_some()),
            touch: self.layouts.iter().any(|l| l.touch.is_some()),
            is_pad: self.pens().next().is_none(),
        }
    }

    /// Whether reports with this id are those of a mouse that the pen imitates.
    pub fn imitates(&self, report_id: u8) -> bool {
        self.pen_of(report_id).is_some_and(|pen| pen.imitates)
    }

    /// Whether the tablet imitates a mouse until it is woken.
    pub fn waits_to_be_woken(&self) -> bool {
        self.pens().any(|pen| pen.imitates)
    }

    /// Where the fields of the pen in a report lie.
    pub(super) fn pen_of(&self, report_id: u8) -> Option<&PenFields> {
        self.layouts.get(usize::from(self.by_id[usize::from(report_id)]))?.pen.as_ref()
    }

    fn pens(&self) -> impl Iterator<Item = &PenFields> {
        pens(&self.layouts)
    }
}

fn pens(layouts: &[Layout]) -> impl Iterator<Item = &PenFields> {
    layouts.iter().filter_map(|layout| layout.pen.as_ref())
}

impl Decode for DescriptorDecoder {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        let Some(id) = report.first() else { return };
        let Some(layout) = self.layouts.get(usize::from(self.by_id[usize::from(*id)])) else { return };
        if report.len() < layout.length {
            return;
        }
        let mut is_near = true;
        if let Some(fields) = &layout.pen {
            let pen = pen(fields, report, &mut self.position);
            is_near = pen.is_some_and(|p| p.in_range);
            if let Some(pen) = pen {
                sink(HidEvent::Pen(pen));
            }
        }
        if let Some(fields) = &layout.touch {
            self.fingers.frame(fields, report, sink);
        }
        // A pen that is away has no charge to tell: tablets fill the field with 0.
        if let Some(share) = layout.battery.filter(|share| is_near && !share.is_null(report)) {
            let percent = (share.of(report) * 100.0).round() as u8;
            if self.battery.replace(percent) != Some(percent) {
                sink(HidEvent::Battery(percent));
            }
        }
        layout.pad.decode(report, &mut self.keys, sink);
    }
}

/// The pen of a report; `None` as long as it is near but was never seen anywhere.
fn pen(fields: &PenFields, report: &[u8], last: &mut Option<DVec2>) -> Option<RawPen> {
    let is_set = |bits: Option<Bits>| bits.is_some_and(|b| b.is_set(report));
    let pressure = fields.pressure.map(|p| if p.is_null(report) { 0.0 } else { p.of(report) });
    let erases = is_set(fields.eraser);
    let presses = pressure.is_none_or(|pressure| pressure > 0.0);
    let touches = fields.tip.is_set(report) || (erases && presses);
    let in_range = touches || erases || fields.in_range.is_none_or(|bits| bits.is_set(report));
    if !in_range {
        return Some(RawPen { position: last.take().unwrap_or_default(), ..RawPen::default() });
    }
    if !fields.x.is_null(report) && !fields.y.is_null(report) {
        *last = Some(DVec2::new(fields.x.of(report), fields.y.of(report)));
    }
    let degrees = |angle: Option<super::field::Angle>| angle.map_or(0.0, |a| a.degrees(report));
    let tilt = Vec2::from(fields.tilt.map(|angle| degrees(angle).clamp(-90.0, 90.0) as f32));
    let distance = match (fields.distance, fields.height) {
        (Some(distance), _) => distance.of(report),
        (None, Some(height)) => 1.0 - height.of(report),
        (None, None) => 0.0,
    };
    Some(RawPen {
        in_range,
        touches,
        eraser: erases || is_set(fields.invert) || fields.is_eraser,
        barrel: fields.barrel.map(is_set),
        position: (*last)?,
        pressure: pressure.map(|p| p as f32),
        tilt_deg: tilt,
        twist_deg: whole_turn(degrees(fields.twist)),
        distance: distance as f32,
        serial: serial(fields, report),
    })
}

/// Degrees brought into 0 to 360, 360 left out.
fn whole_turn(degrees: f64) -> f32 {
    let turn = degrees.rem_euclid(360.0) as f32;
    if turn < 360.0 { turn } else { 0.0 }
}

fn serial(fields: &PenFields, report: &[u8]) -> u64 {
    let [low, high] = fields.serial.map(|bits| bits.map_or(0, |b| b.raw(report)));
    if fields.serial[1].is_some() { high << 32 | low } else { low }
}

impl Fingers {
    fn frame(&mut self, fields: &TouchFields, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        let mut here = fields.contacts.len();
        if let Some(count) = fields.count {
            // The first report of a frame says how many contacts it has, the others say 0.
            match count.raw(report) {
                0 => {}
                count => self.left_in_frame = usize::try_from(count).unwrap_or(here),
            }
            here = here.min(self.left_in_frame);
            self.left_in_frame -= here;
        }
        for contact in fields.contacts.iter().take(here) {
            self.contact(contact, report, sink);
        }
    }

    fn contact(&mut self, fields: &ContactFields, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        let finger = fields.number.map_or(0, |number| number.raw(report) as u16);
        let is_sure = fields.confidence.is_none_or(|bits| bits.is_set(report));
        let touches = is_sure && fields.tip.is_set(report);
        let known = self.touching.iter().take(self.count).position(|f| *f == finger);
        match known {
            None if !touches || self.count >= MAX_FINGERS => return,
            None => {
                self.touching[self.count] = finger;
                self.count += 1;
            }
            Some(_) if touches => {}
            Some(place) => {
                self.count -= 1;
                self.touching.swap(place, self.count);
            }
        }
        let position = DVec2::new(fields.x.of(report), fields.y.of(report));
        sink(HidEvent::Touch { finger, touches, position });
    }
}
