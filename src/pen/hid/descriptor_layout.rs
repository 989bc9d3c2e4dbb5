//! From a report descriptor to where everything of a pen lies in each report.
//!
//! A pen is what stands in an application collection Pen or Digitizer of the digitizer page, or of Wacom's page FF0D that
//! mirrors it, and has a position and a tip switch: where a maker hides the tip in bits of their own, the descriptor does
//! not describe the pen. A mouse that says where it is, and pressure or "in range" of the digitizer page besides, is a pen
//! that imitates one ([`super::until_woken`]). Fingers count only in a Touch Screen collection of a device that has a pen
//! as well; pucks, touchpads and other mice do not count. Sources: HID Usage Tables 1.5, chapter 16.

use super::descriptor_pad::{self, PadFields, PadRole};
use super::field::{Angle, Bits, Share, area_mm};
use super::{DescriptorError, descriptor_items};
use glam::DVec2;
use hidreport::{Collection, CollectionType, Field, Report, ReportDescriptor, VariableField};
use hut::{BatterySystem, Digitizers, GenericDesktop, GenericDeviceControls, Usage, Wacom};

/// Most contacts in one report.
const MAX_CONTACTS: usize = 32;

/// What a field is for.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    X,
    Y,
    Tip,
    InRange,
    Sense,
    Invert,
    Eraser,
    Barrel(usize),
    /// What tablets without a second barrel switch use for their second button.
    OddBarrel,
    Pressure,
    TiltX,
    TiltY,
    Twist,
    Height,
    Distance,
    Serial,
    SerialHigh,
    Battery,
    Pad(PadRole),
    Contact,
    Confidence,
    ContactCount,
    /// A mouse's button, counted from 0.
    Button(u16),
}

/// Page of buttons, which are counted from 1.
const BUTTONS: u32 = 0x09;

fn role(usage: u32) -> Option<Role> {
    if let Some(role) = descriptor_pad::role(usage) {
        return Some(Role::Pad(role));
    }
    let id = (usage & 0xFFFF) as u16;
    Some(match Usage::try_from(usage).ok()? {
        Usage::GenericDesktop(GenericDesktop::X) | Usage::Wacom(Wacom::X) => Role::X,
        Usage::GenericDesktop(GenericDesktop::Y) | Usage::Wacom(Wacom::Y) => Role::Y,
        Usage::GenericDesktop(GenericDesktop::Z) => Role::Height,
        Usage::Wacom(Wacom::WacomDistance) => Role::Distance,
        Usage::Digitizers(Digitizers::TipSwitch) | Usage::Wacom(Wacom::TipSwitch) => Role::Tip,
        Usage::Digitizers(Digitizers::InRange) | Usage::Wacom(Wacom::InRange) => Role::InRange,
        Usage::Wacom(Wacom::WacomSense) => Role::Sense,
        Usage::Digitizers(Digitizers::Invert) | Usage::Wacom(Wacom::Invert) => Role::Invert,
        Usage::Digitizers(Digitizers::Eraser) | Usage::Wacom(Wacom::Eraser) => Role::Eraser,
        Usage::Digitizers(Digitizers::BarrelSwitch) | Usage::Wacom(Wacom::BarrelSwitch) => Role::Barrel(0),
        Usage::Digitizers(Digitizers::SecondaryBarrelSwitch) | Usage::Wacom(Wacom::SecondaryBarrelSwitch) => {
            Role::Barrel(1)
        }
        Usage::Digitizers(Digitizers::TabletPick | Digitizers::SecondaryTipSwitch) => Role::OddBarrel,
        // Wacom's third barrel button has a number that the digitizer page uses for something else.
        Usage::Wacom(Wacom::PreferredColorisLocked) => Role::Barrel(2),
        Usage::Digitizers(Digitizers::TipPressure) | Usage::Wacom(Wacom::TipPressure) => Role::Pressure,
        Usage::Digitizers(Digitizers::XTilt) | Usage::Wacom(Wacom::XTilt) => Role::TiltX,
        Usage::Digitizers(Digitizers::YTilt) | Usage::Wacom(Wacom::YTilt) => Role::TiltY,
        Usage::Digitizers(Digitizers::Twist) | Usage::Wacom(Wacom::Twist) => Role::Twist,
        Usage::Digitizers(Digitizers::TransducerSerialNumber)
        | Usage::Wacom(Wacom::TransducerSerialNumber) => Role::Serial,
        Usage::Wacom(Wacom::WacomSerialHi) => Role::SerialHigh,
        Usage::Digitizers(Digitizers::BatteryStrength)
        | Usage::GenericDeviceControls(GenericDeviceControls::BatteryStrength)
        | Usage::BatterySystem(BatterySystem::RelativeStateOfCharge | BatterySystem::AbsoluteStateOfCharge)
        | Usage::Wacom(Wacom::BatteryStrength | Wacom::WacomBatteryLevel) => Role::Battery,
        Usage::Digitizers(Digitizers::ContactIdentifier) | Usage::Wacom(Wacom::ContactId) => Role::Contact,
        Usage::Digitizers(Digitizers::TouchValid) | Usage::Wacom(Wacom::Confidence) => Role::Confidence,
        Usage::Digitizers(Digitizers::ContactCount) | Usage::Wacom(Wacom::ContactCount) => Role::ContactCount,
        _ if usage >> 16 == BUTTONS => Role::Button(id.checked_sub(1)?),
        _ => return None,
    })
}

/// Everything that one report says.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    pub(super) id: u8,
    /// Bytes that a report needs to hold all of it.
    pub(super) length: usize,
    pub(super) pen: Option<PenFields>,
    pub(super) touch: Option<TouchFields>,
    pub(super) battery: Option<Share>,
    pub(super) pad: PadFields,
}

/// Where the fields of a pen lie.
#[derive(Clone, Debug)]
pub(super) struct PenFields {
    pub(super) x: Share,
    pub(super) y: Share,
    pub(super) area_mm: Option<DVec2>,
    pub(super) tip: Bits,
    pub(super) in_range: Option<Bits>,
    pub(super) invert: Option<Bits>,
    pub(super) eraser: Option<Bits>,
    /// The report is about the other end of the pen alone.
    pub(super) is_eraser: bool,
    /// The report is a mouse's.
    pub(super) imitates: bool,
    pub(super) barrel: [Option<Bits>; 3],
    pub(super) pressure: Option<Share>,
    pub(super) tilt: [Option<Angle>; 2],
    pub(super) twist: Option<Angle>,
    /// Rises toward the surface, as HID has it.
    pub(super) height: Option<Share>,
    /// Rises away from the surface, as Wacom has it.
    pub(super) distance: Option<Share>,
    pub(super) serial: [Option<Bits>; 2],
}

/// Where the contacts of a touch screen lie.
#[derive(Clone, Debug)]
pub(super) struct TouchFields {
    pub(super) count: Option<Bits>,
    pub(super) contacts: Vec<ContactFields>,
}

/// Where one contact lies.
#[derive(Clone, Debug)]
pub(super) struct ContactFields {
    pub(super) number: Option<Bits>,
    pub(super) tip: Bits,
    pub(super) confidence: Option<Bits>,
    pub(super) x: Share,
    pub(super) y: Share,
}

/// Where everything lies in all input reports; those that say nothing of interest are left out.
pub(super) fn layouts(descriptor: &[u8]) -> Result<Vec<Layout>, DescriptorError> {
    let plain = descriptor_items::plain(descriptor)?;
    let parsed = ReportDescriptor::try_from(plain.as_slice());
    let parsed = parsed.map_err(|fault| DescriptorError::Meaning(fault.to_string()))?;
    let layouts = parsed.input_reports().iter().map(layout);
    Ok(layouts.filter(|layout| !layout.is_empty()).collect())
}

/// What a field stands in.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Pen,
    /// A finger of a touch screen; which one tells its collection.
    Finger,
    Mouse,
    Other,
}

/// A field with its role and the collections that it stands in.
struct Known<'a> {
    field: &'a VariableField,
    role: Role,
    place: Place,
    is_eraser: bool,
}

fn layout(report: &impl Report) -> Layout {
    let fields: Vec<Known<'_>> = report.fields().iter().filter_map(known).collect();
    let pen = pen_fields(&fields).or_else(|| mouse_fields(&fields));
    let first = |role| fields.iter().find(|f| f.role == role).map(|f| f.field);
    let of_pad = fields.iter().filter_map(|known| match known.role {
        Role::Pad(role) => Some((role, Bits::new(&known.field.bits, false)?, Share::new(known.field))),
        _ => None,
    });
    let mut layout = Layout {
        id: report.report_id().map_or(0, u8::from),
        length: 0,
        touch: touch_fields(&fields),
        battery: first(Role::Battery).and_then(Share::new),
        pad: PadFields::of(&of_pad.collect::<Vec<_>>()),
        pen,
    };
    layout.length = layout.last_byte();
    layout
}

fn known(field: &Field) -> Option<Known<'_>> {
    let Field::Variable(field) = field else { return None };
    use hidreport::FieldAttributes as _;
    if field.is_relative() {
        return None;
    }
    let role = role(u32::from(field.usage))?;
    let is_eraser = usages(&field.collections).any(|u| is_digitizer(u, Digitizers::Eraser));
    Some(Known { field, role, place: place(&field.collections), is_eraser })
}

fn usages(collections: &[Collection]) -> impl Iterator<Item = u32> + '_ {
    collections.iter().filter_map(|c| c.usages().first()).map(u32::from)
}

/// Whether a usage is this one of the digitizer page, or the same of Wacom's copy.
fn is_digitizer(usage: u32, which: Digitizers) -> bool {
    matches!(usage >> 16, 0x0D | 0xFF0D) && usage & 0xFFFF == u32::from(u16::from(which))
}

fn place(collections: &[Collection]) -> Place {
    // The outermost: some tablets declare the stylus inside as an application of its own.
    let application = collections.iter().find(|c| c.collection_type() == CollectionType::Application);
    let Some(application) = application.and_then(|c| c.usages().first()).map(u32::from) else {
        return Place::Other;
    };
    let has = |which: Digitizers| usages(collections).any(|u| is_digitizer(u, which));
    if application == u32::from(&Usage::GenericDesktop(GenericDesktop::Mouse)) {
        return Place::Mouse;
    }
    if is_digitizer(application, Digitizers::TouchScreen) {
        return if has(Digitizers::Stylus) { Place::Other } else { Place::Finger };
    }
    let is_tablet =
        is_digitizer(application, Digitizers::Pen) || is_digitizer(application, Digitizers::Digitizer);
    if is_tablet && !has(Digitizers::Finger) && !has(Digitizers::Puck) { Place::Pen } else { Place::Other }
}

fn pen_fields(fields: &[Known<'_>]) -> Option<PenFields> {
    let of_pen = || fields.iter().filter(|f| f.place == Place::Pen);
    let field = |role| of_pen().find(|f| f.role == role).map(|f| f.field);
    let bits = |role| field(role).and_then(|f| Bits::new(&f.bits, false));
    let (x_field, y_field) = (field(Role::X)?, field(Role::Y)?);
    let second = bits(Role::Barrel(1)).or_else(|| bits(Role::OddBarrel));
    let mut serials = of_pen().filter(|f| f.role == Role::Serial).map(|f| Bits::new(&f.field.bits, false));
    let low = serials.next().flatten();
    let high = bits(Role::SerialHigh).or_else(|| serials.next().flatten());
    Some(PenFields {
        x: Share::new(x_field)?,
        y: Share::new(y_field)?,
        area_mm: area_mm(x_field, y_field),
        tip: bits(Role::Tip)?,
        in_range: bits(Role::InRange).or_else(|| bits(Role::Sense)),
        invert: bits(Role::Invert),
        eraser: bits(Role::Eraser),
        is_eraser: of_pen().any(|f| f.is_eraser),
        imitates: false,
        barrel: [bits(Role::Barrel(0)), second, bits(Role::Barrel(2))],
        pressure: field(Role::Pressure).and_then(Share::new),
        tilt: [Role::TiltX, Role::TiltY].map(|role| field(role).and_then(Angle::tilt)),
        twist: field(Role::Twist).and_then(Angle::turn),
        height: field(Role::Height).and_then(Share::new),
        distance: field(Role::Distance).and_then(Share::new),
        serial: [low, high],
    })
}

/// A pen that imitates a mouse: the first button is its tip, the others those of its barrel.
fn mouse_fields(fields: &[Known<'_>]) -> Option<PenFields> {
    let field = |role| fields.iter().find(|f| f.place == Place::Mouse && f.role == role).map(|f| f.field);
    let bits = |role| field(role).and_then(|f| Bits::new(&f.bits, false));
    let (x_field, y_field) = (field(Role::X)?, field(Role::Y)?);
    let (pressure, in_range) = (field(Role::Pressure).and_then(Share::new), bits(Role::InRange));
    if pressure.is_none() && in_range.is_none() {
        return None;
    }
    Some(PenFields {
        x: Share::new(x_field)?,
        y: Share::new(y_field)?,
        // Steps of a mouse have no length; where makers write one, it is made up.
        area_mm: None,
        tip: bits(Role::Button(0))?,
        in_range,
        invert: None,
        eraser: None,
        is_eraser: false,
        imitates: true,
        barrel: [bits(Role::Button(1)), bits(Role::Button(2)), None],
        pressure,
        tilt: [None, None],
        twist: None,
        height: None,
        distance: None,
        serial: [None, None],
    })
}

fn touch_fields(fields: &[Known<'_>]) -> Option<TouchFields> {
    let of_screen = || fields.iter().filter(|f| f.place == Place::Finger);
    let mut contacts = Vec::new();
    // Every contact has a tip; the fields of one contact share its collection.
    for tip in of_screen().filter(|f| f.role == Role::Tip).take(MAX_CONTACTS) {
        let beside = |role| {
            of_screen()
                .find(|f| f.role == role && f.field.collections == tip.field.collections)
                .map(|f| f.field)
        };
        let bits = |role| beside(role).and_then(|f| Bits::new(&f.bits, false));
        let share = |role| beside(role).and_then(Share::new);
        let (Some(x), Some(y), Some(touches)) = (share(Role::X), share(Role::Y), bits(Role::Tip)) else {
            continue;
        };
        let (number, confidence) = (bits(Role::Contact), bits(Role::Confidence));
        contacts.push(ContactFields { number, tip: touches, confidence, x, y });
    }
    let count = of_screen().find(|f| f.role == Role::ContactCount);
    let count = count.and_then(|f| Bits::new(&f.field.bits, false));
    (!contacts.is_empty()).then_some(TouchFields { count, contacts })
}

impl Layout {
    /// Whether the report says nothing of interest.
    fn is_empty(&self) -> bool {
        self.pen.is_none() && self.touch.is_none() && self.battery.is_none() && self.pad.is_empty()
    }

    fn last_byte(&self) -> usize {
        let mut ends = vec![1];
        let mut note = |bits: Option<Bits>| ends.extend(bits.map(|b| b.end()));
        if let Some(pen) = &self.pen {
            let shares = [Some(pen.x), Some(pen.y), pen.pressure, pen.height, pen.distance];
            shares.into_iter().flatten().for_each(|share| note(Some(share.bits)));
            let angles = [pen.tilt[0], pen.tilt[1], pen.twist];
            angles.into_iter().flatten().for_each(|angle| note(Some(angle.bits())));
            [Some(pen.tip), pen.in_range, pen.invert, pen.eraser].into_iter().for_each(&mut note);
            pen.barrel.into_iter().chain(pen.serial).for_each(&mut note);
        }
        if let Some(touch) = &self.touch {
            note(touch.count);
            for contact in &touch.contacts {
                [contact.number, contact.confidence, Some(contact.tip)].into_iter().for_each(&mut note);
                [contact.x, contact.y].into_iter().for_each(|share| note(Some(share.bits)));
            }
        }
        note(self.battery.map(|b| b.bits));
        ends.push(self.pad.end());
        ends.into_iter().max().unwrap_or(1)
    }
}
