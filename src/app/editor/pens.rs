//! The pens and tablets in use: what they are, how they are held, and what is said of them.

use super::reference_hold::Hold;
use crate::app::panels::snapshot::{PenLive, PenState, PenUsed};
use crate::app::pen_settings::{PenSettings, TabletDoubt};
use crate::app::plant_tools::PlantHand;
use crate::app::tablets::Reach;
use crate::pen::mapping::Rect;
use crate::pen::{PenEvent, PenTool};

/// The pens and tablets in use.
#[derive(Default)]
pub(super) struct Pens {
    /// What was used last to draw.
    used: PenUsed,
    /// Name of the pen last used; empty for one without.
    device: Option<String>,
    is_raw: bool,
    /// Charge of the pen in percent.
    battery: Option<u8>,
    live: PenLive,
    /// Why a tablet cannot be read, and what to do.
    trouble: Option<String>,
    /// Those of which the model is not sure.
    doubts: Vec<TabletDoubt>,
    /// How many monitors one may cover.
    monitors: usize,
    /// What that of the pen last used covers, in physical pixels, if all of it is in the window.
    target: Option<Rect>,
    /// What a pointer holds of the picture under the drawing.
    pub(super) hold: Option<Hold>,
    /// What one works with in the view of the plant.
    pub(super) in_plant: PlantHand,
}

/// What is new about tablets.
pub(super) struct TabletUpdate {
    /// Whether anything is.
    pub(super) is_any: bool,
    /// Why one cannot be read since now.
    pub(super) trouble: Option<String>,
}

impl Pens {
    /// A tool touches the canvas.
    pub(super) fn touches(&mut self, tool: PenTool) {
        self.used = match tool {
            PenTool::Mouse => PenUsed::Mouse,
            PenTool::Finger(_) => PenUsed::Touch,
            PenTool::Pen | PenTool::Eraser => {
                PenUsed::Pen(self.device.clone().filter(|name| !name.is_empty()))
            }
        };
    }

    /// What was used last to draw.
    pub(super) fn used(&self) -> PenUsed {
        self.used.clone()
    }

    /// Sees how a pen is held, wherever it is in the window.
    pub(super) fn note(&mut self, event: &PenEvent) {
        if matches!(event.sample.tool, PenTool::Pen | PenTool::Eraser) {
            let sample = &event.sample;
            self.live = PenLive { pressure: sample.pressure, tilt_deg: sample.tilt_deg.to_array() };
        }
    }

    /// A pen came into use; whether it is another one than before.
    pub(super) fn take_up(&mut self, name: &str, is_raw: bool, battery: Option<u8>) -> bool {
        self.battery = battery;
        let is_other = self.device.as_deref() != Some(name) || self.is_raw != is_raw;
        if is_other {
            self.device = Some(name.to_owned());
            self.is_raw = is_raw;
        }
        is_other
    }

    /// Name of the pen last used; empty for one without, and before there was one.
    pub(super) fn name(&self) -> &str {
        self.device.as_deref().unwrap_or_default()
    }

    /// Whether the tablet of the pen last used is read directly.
    pub(super) fn is_raw(&self) -> bool {
        self.is_raw
    }

    /// Where tablets may reach: how many monitors there are, and what the pen's own tablet covers as the artist chose it.
    pub(super) fn note_reach(&mut self, reach: &Reach, pen: &PenSettings) {
        self.monitors = reach.monitors.len();
        let target = reach.target(pen);
        let is_seen = target.min.cmpge(reach.window.min).all() && target.max.cmple(reach.window.max).all();
        self.target = is_seen.then_some(target);
    }

    /// Why a tablet cannot be read, or that all can, and of which tablets the model is not sure.
    pub(super) fn note_tablets(&mut self, trouble: Option<String>, doubts: &[TabletDoubt]) -> TabletUpdate {
        let is_other = self.trouble != trouble;
        let is_any = is_other || self.doubts != doubts;
        if is_other {
            self.trouble.clone_from(&trouble);
        }
        if is_any {
            self.doubts = doubts.to_vec();
        }
        TabletUpdate { is_any, trouble: trouble.filter(|_| is_other) }
    }

    /// What the panels show, with what the artist chose and the physical pixels of a point.
    pub(super) fn state(&self, settings: &crate::app::settings::Settings, pixels_per_point: f64) -> PenState {
        let point = |at: glam::DVec2| at / pixels_per_point;
        let points = |rect: Rect| {
            let (min, max) = (point(rect.min), point(rect.max));
            egui::Rect::from_min_max(
                egui::pos2(min.x as f32, min.y as f32),
                egui::pos2(max.x as f32, max.y as f32),
            )
        };
        PenState {
            device: self.device.clone(),
            is_raw: self.is_raw,
            battery: self.battery,
            trouble: self.trouble.clone(),
            doubts: self.doubts.clone(),
            monitors: self.monitors,
            target: self.target.map(points),
            source: settings.pen_source,
            settings: settings.pen(self.name()),
            live: self.live,
        }
    }
}
