//! A desk with pen and paper: the editor as the window runs it, and a clock on everything.

use crate::figures::Figures;
use egui::{Context, Pos2, RawInput, Rect, TextureId, ViewportId, vec2};
use glam::Vec2;
use penstemon::app::action::Action;
use penstemon::app::canvas_tool::CanvasTool;
use penstemon::app::editor::{Editor, Places};
use penstemon::app::sheet::Sheet;
use penstemon::pen::{PenButtons, PenEvent, PenPhase, PenSample, PenTool};
use penstemon::render::canvas::InkBuffer;
use penstemon::sketch::{self, Sketch, StrokePoint, Tool};
use std::collections::VecDeque;
use std::hint::black_box;
use std::path::Path;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// The window's size.
const SIZE: egui::Vec2 = vec2(1280.0, 800.0);
/// Time between two samples of a pen.
const SAMPLE: Duration = Duration::from_nanos(1_000_000_000 / 240);
/// Time between two frames.
const FRAME: Duration = Duration::from_nanos(1_000_000_000 / 60);
/// Longest wait for a plant.
const PATIENCE: Duration = Duration::from_secs(120);

/// The editor and what the window keeps beside it.
pub(crate) struct Desk {
    editor: Editor,
    wakes: Receiver<()>,
    egui: Context,
    sheet: Sheet,
    ink: InkBuffer,
    figures: Figures,
    start: Instant,
    last_frame: Instant,
    is_dirty: bool,
    /// Revisions that were submitted, with the arrival of their newest sample.
    pending: VecDeque<(u64, Instant)>,
    _folder: tempfile::TempDir,
}

impl Desk {
    /// Opens a drawing.
    pub(crate) fn open(drawing: &Sketch) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("drawing.penstemon");
        sketch::save::save(&file, drawing, None).unwrap();
        let places = Places { config: folder.path().join("config"), state: folder.path().join("state") };
        let (send, wakes) = channel();
        let wake = std::sync::Mutex::new(send);
        let wake = move || wake.lock().unwrap().send(()).unwrap_or(());
        let editor = Editor::open_in(places, Some(file), wake).unwrap();
        let now = Instant::now();
        let mut desk = Self {
            editor,
            wakes,
            egui: Context::default(),
            sheet: Sheet::default(),
            ink: InkBuffer::default(),
            figures: Figures::default(),
            start: now,
            last_frame: now,
            is_dirty: true,
            pending: VecDeque::new(),
            _folder: folder,
        };
        desk.editor.submit();
        // Fonts and the pictures of the panels are there before anybody draws.
        for _ in 0..40 {
            desk.frame();
        }
        desk.settle();
        desk.figures();
        desk
    }

    /// What was measured since the last call.
    pub(crate) fn figures(&mut self) -> Figures {
        std::mem::take(&mut self.figures)
    }

    /// Carries out a wish.
    pub(crate) fn perform(&mut self, action: Action) {
        self.editor.perform(action);
        self.submit(Instant::now());
        self.is_dirty = true;
    }

    /// Draws a stroke at the pace of a usual pen, with frames and plants between the samples.
    pub(crate) fn draw(&mut self, tool: Tool, points: &[StrokePoint]) {
        self.draw_every(SAMPLE, tool, points);
    }

    /// The same at another pace.
    pub(crate) fn draw_every(&mut self, sample: Duration, tool: Tool, points: &[StrokePoint]) {
        let wanted = CanvasTool::Draw(tool);
        if self.editor.canvas().tool() != wanted {
            self.editor.perform(Action::SetTool(wanted));
        }
        let begun = Instant::now();
        for (i, point) in points.iter().enumerate() {
            let arrived = self.wait_until(begun + sample * i as u32);
            let phase = if i == 0 { PenPhase::Down } else { PenPhase::Move };
            self.sample(phase, point, arrived);
        }
        let Some(last) = points.last() else { return };
        let arrived = self.wait_until(begun + sample * points.len() as u32);
        self.sample(PenPhase::Up, last, arrived);
    }

    fn sample(&mut self, phase: PenPhase, point: &StrokePoint, arrived: Instant) {
        let is_touching = phase != PenPhase::Up;
        let sample = PenSample {
            position: self.editor.canvas().view().to_window(point.position.as_dvec2()),
            pressure: if is_touching { point.pressure } else { 0.0 },
            tilt_deg: Vec2::ZERO,
            twist_deg: 0.0,
            distance: 0.0,
            tool: PenTool::Pen,
            buttons: PenButtons { primary: is_touching, ..PenButtons::default() },
            time_ms: self.start.elapsed().as_secs_f64() * 1e3,
        };
        let begun = Instant::now();
        self.editor.pen(PenEvent { phase, sample });
        let name = if is_touching { "pen" } else { "lift" };
        self.figures.note(name, begun.elapsed());
        self.sheet.grow(&mut self.ink, &self.editor);
        if is_touching {
            self.figures.note("ink", arrived.elapsed());
        }
        self.submit(arrived);
        self.figures.note("sample", begun.elapsed());
        self.is_dirty = true;
    }

    fn submit(&mut self, arrived: Instant) {
        let before = self.editor.revisions().submitted;
        let begun = Instant::now();
        self.editor.submit();
        self.figures.note("submit", begun.elapsed());
        let now = self.editor.revisions().submitted;
        if now != before {
            self.pending.push_back((now, arrived));
        }
    }

    /// Takes a plant that the worker finished.
    fn collect(&mut self) {
        let version = self.editor.versions().plant;
        let begun = Instant::now();
        self.editor.collect();
        self.figures.note("collect", begun.elapsed());
        let collected = self.editor.revisions().collected;
        while let Some((_, arrived)) = self.pending.pop_front_if(|(revision, _)| *revision <= collected) {
            self.figures.note("plant", arrived.elapsed());
        }
        if self.editor.versions().plant != version {
            self.is_dirty = true;
        }
    }

    /// Does what comes up until a moment; says when the thread was there for it: then, or when it was woken.
    fn wait_until(&mut self, due: Instant) -> Instant {
        loop {
            let now = Instant::now();
            let next_frame = self.last_frame + FRAME;
            if now >= due {
                return due;
            }
            if self.is_dirty && now >= next_frame {
                self.show();
                continue;
            }
            let until = if self.is_dirty { due.min(next_frame) } else { due };
            match self.wakes.recv_timeout(until.saturating_duration_since(now)) {
                Ok(()) => self.collect(),
                Err(RecvTimeoutError::Timeout) => {
                    let woken = Instant::now();
                    if woken >= due {
                        return woken;
                    }
                }
                Err(RecvTimeoutError::Disconnected) => panic!("the editor gave up its way to wake"),
            }
        }
    }

    /// Lets some time pass.
    pub(crate) fn pass(&mut self, time: Duration) {
        self.wait_until(Instant::now() + time);
    }

    /// Shows a frame whenever one is due, whether anything changed or not.
    pub(crate) fn frame_after_frame(&mut self, time: Duration) {
        let end = Instant::now() + time;
        while Instant::now() < end {
            self.is_dirty = true;
            self.wait_until((self.last_frame + FRAME).min(end));
            if Instant::now() >= self.last_frame + FRAME {
                self.show();
            }
        }
    }

    /// Waits for the plant of the drawing as it is.
    pub(crate) fn settle(&mut self) {
        let begun = Instant::now();
        while self.editor.revisions().collected < self.editor.revisions().submitted {
            assert!(begun.elapsed() < PATIENCE, "no plant comes");
            self.pass(SAMPLE);
        }
        self.show();
    }

    /// Sleeps as the window does, until somebody wants a frame; the frames that were wanted.
    pub(crate) fn sleep(&mut self, time: Duration) -> usize {
        let end = Instant::now() + time;
        let (mut frames, mut wanted) = (0, None);
        while Instant::now() < end {
            if self.editor.wants_frame() || wanted.is_some_and(|at| at <= Instant::now()) || self.is_dirty {
                wanted = self.show().map(|delay| Instant::now() + delay);
                frames += 1;
                std::thread::sleep(FRAME);
                continue;
            }
            let next = [wanted, self.editor.wakes_at(), Some(end)].into_iter().flatten().min().unwrap_or(end);
            match self.wakes.recv_timeout(next.saturating_duration_since(Instant::now())) {
                Ok(()) => self.collect(),
                Err(_) => self.is_dirty |= self.editor.wakes_at().is_some_and(|at| at <= Instant::now()),
            }
        }
        frames
    }

    /// A frame, with its time noted, and the time since the one before; when egui wants the next.
    fn show(&mut self) -> Option<Duration> {
        let begun = Instant::now();
        self.figures.note("gap", begun - self.last_frame);
        self.last_frame = begun;
        self.is_dirty = false;
        self.frame()
    }

    fn frame(&mut self) -> Option<Duration> {
        let begun = Instant::now();
        let mut raw = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, SIZE)),
            time: Some(self.start.elapsed().as_secs_f64()),
            focused: true,
            ..RawInput::default()
        };
        raw.viewports.entry(ViewportId::ROOT).or_default().native_pixels_per_point = Some(1.0);
        let editor = &mut self.editor;
        let mut output = self.egui.run_ui(raw, |ui| editor.ui(ui, TextureId::default()));
        // Pictures for the graphics card that there is not.
        output.textures_delta.clear();
        let laid_out = Instant::now();
        black_box(self.egui.tessellate(output.shapes, output.pixels_per_point));
        let tessellated = Instant::now();
        self.sheet.follow(&mut self.ink, &self.editor);
        black_box(self.ink.take_dirty());
        let done = Instant::now();
        black_box(self.editor.plant_look());
        self.figures.note("panels", laid_out - begun);
        self.figures.note("shapes", tessellated - laid_out);
        self.figures.note("strokes", done - tessellated);
        self.figures.note("frame", done - begun);
        let delay = output.viewport_output.get(&ViewportId::ROOT)?.repaint_delay;
        (delay < Duration::from_secs(3600)).then_some(delay)
    }
}

/// Processor time of this process so far; `None` where the system does not say.
pub(crate) fn processor_time() -> Option<Duration> {
    let stat = std::fs::read_to_string(Path::new("/proc/self/stat")).ok()?;
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks: u64 = fields.get(11)?.parse::<u64>().ok()? + fields.get(12)?.parse::<u64>().ok()?;
    Some(Duration::from_millis(ticks * 10))
}
