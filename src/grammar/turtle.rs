//! The turtle: goes through the modules that the rules made and draws by them.
//!
//! Symbols mean what they mean in *The Algorithmic Beauty of Plants* (Prusinkiewicz and Lindenmayer 1990, §1.5 and
//! appendix C), angles in degrees. Where the book's matrices turn the other way than its words say, the words hold:
//! `+` turns to the left, `&` down, `\` rolls to the left. Bending by `~` is that of §2.3.3, `e |H × T|`, at once and by
//! degrees, and ends where the turtle looks straight up or down.

use super::error::{GrammarError, Place};
use super::figure::{Figure, Item, Stem};
use super::limits;
use super::symbols::{Meaning, Turn};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// Radius of stems before any radius is given, metres.
const FIRST_RADIUS: f64 = 0.001;

/// Where the turtle is and how it draws.
#[derive(Clone, Copy, Debug)]
struct State {
    position: DVec3,
    heading: DVec3,
    left: DVec3,
    up: DVec3,
    scale: f64,
    /// Radius of stems, not scaled.
    radius: f64,
    /// The stem drawn last.
    stem: Option<usize>,
    /// Whether the turtle is at its tip and goes on drawing it.
    is_at_tip: bool,
}

/// A module that is not replaced any more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Module<'a> {
    pub(super) meaning: Meaning,
    pub(super) parameters: &'a [f64],
    /// The path by which the rules came to it.
    pub(super) key: u64,
    pub(super) place: Place,
}

/// Draws a figure module by module.
#[derive(Debug)]
pub(super) struct Turtle {
    state: State,
    kept: Vec<State>,
    brackets: usize,
    organs: Vec<Arc<str>>,
    solids: [Arc<str>; 2],
    figure: Figure,
}

impl Turtle {
    /// At the origin, with so many levels of brackets and the names of organs.
    pub(super) fn new(brackets: usize, organs: Vec<Arc<str>>) -> Self {
        let (heading, left, up) = (DVec3::Y, DVec3::NEG_X, DVec3::Z);
        let state = State {
            position: DVec3::ZERO,
            heading,
            left,
            up,
            scale: 1.0,
            radius: FIRST_RADIUS,
            stem: None,
            is_at_tip: false,
        };
        let solids = ["@ball".into(), "@cylinder".into()];
        Self { state, kept: Vec::new(), brackets, organs, solids, figure: Figure::default() }
    }

    /// What was drawn.
    pub(super) fn into_figure(self) -> Figure {
        self.figure
    }

    /// Does what a module says.
    ///
    /// # Errors
    /// Lengths and radii below 0, too many brackets, a place too far away.
    pub(super) fn obey(&mut self, module: &Module<'_>) -> Result<(), GrammarError> {
        let Module { meaning, parameters, place, .. } = *module;
        let first = parameters.first().copied().unwrap_or_default();
        match meaning {
            Meaning::Nothing => {}
            Meaning::Draw => self.draw(parameters, place)?,
            Meaning::Move => self.advance(first, place)?,
            Meaning::Turn(turn) => self.turn(turn, first),
            Meaning::TurnBack => self.turn(Turn::Left, 180.0),
            Meaning::Level => self.level(),
            Meaning::Radius => self.state.radius = not_negative("radius", first, place)?,
            Meaning::Scale => self.scale(first, place)?,
            Meaning::Tropism => self.bend(first),
            Meaning::Push => self.push(place)?,
            Meaning::Pop => self.state = self.kept.pop().unwrap_or(self.state),
            Meaning::Organ(organ) => self.place(self.organs[organ as usize].clone(), module),
            Meaning::Ball => {
                not_negative("radius", first, place)?;
                self.place(self.solids[0].clone(), module);
            }
            Meaning::Cylinder => {
                let length = parameters.get(1).copied().unwrap_or_default();
                not_negative("radius", first.min(length), place)?;
                self.place(self.solids[1].clone(), module);
                self.advance(length, place)?;
            }
        }
        Ok(())
    }

    fn push(&mut self, place: Place) -> Result<(), GrammarError> {
        if self.kept.len() == self.brackets {
            let what = format!("brackets stand in one another {} deep", self.brackets + 1);
            let remedy =
                format!("end after {}, by a condition of the rule that opens one each time", self.brackets);
            return Err(GrammarError::at(place, what, remedy));
        }
        self.kept.push(self.state);
        self.state.is_at_tip = false;
        Ok(())
    }

    /// Goes ahead without drawing.
    fn advance(&mut self, length: f64, place: Place) -> Result<(), GrammarError> {
        let to = self.ahead(length, place)?;
        self.state.is_at_tip &= to == self.state.position;
        self.state.position = to;
        Ok(())
    }

    /// The place ahead at a distance.
    fn ahead(&self, length: f64, place: Place) -> Result<DVec3, GrammarError> {
        let to = self.state.position + self.state.heading * (length * self.state.scale);
        // Lengths that are too large for a number are no distance at all.
        if to.length() <= limits::REACH {
            return Ok(to);
        }
        let what = format!("the turtle is more than {} m away", limits::REACH);
        Err(GrammarError::at(place, what, "lengths are in metres; make this one smaller"))
    }

    fn draw(&mut self, parameters: &[f64], place: Place) -> Result<(), GrammarError> {
        let length = not_negative("length", parameters.first().copied().unwrap_or_default(), place)?;
        let start = not_negative("radius", parameters.get(1).copied().unwrap_or(self.state.radius), place)?;
        let end = not_negative("radius", parameters.get(2).copied().unwrap_or(start), place)?;
        let (from, to) = (self.state.position, self.ahead(length, place)?);
        let scaled = |radius: f64| (radius * self.state.scale).min(limits::REACH) as f32;
        let (start, last) = (scaled(start).max(limits::LEAST_RADIUS), scaled(end).max(limits::LEAST_RADIUS));
        (self.state.position, self.state.radius) = (to, end);
        let stems = &mut self.figure.stems;
        let open = self.state.stem.filter(|_| self.state.is_at_tip);
        let foot = open.and_then(|stem| stems[stem].points.last().copied()).unwrap_or(from.as_vec3());
        // What is too short to be seen in these numbers is no segment.
        if foot == to.as_vec3() {
            return Ok(());
        }
        if let Some(stem) = open.map(|stem| &mut stems[stem]) {
            stem.points.push(to.as_vec3());
            // Where segments meet, the later one says the radius.
            stem.radii.pop();
            stem.radii.extend([start, last]);
        } else {
            let (points, radii) = (vec![foot, to.as_vec3()], vec![start, last]);
            stems.push(Stem { parent: self.state.stem, points, radii });
            self.state.stem = Some(stems.len() - 1);
            self.state.is_at_tip = true;
        }
        Ok(())
    }

    fn turn(&mut self, turn: Turn, degrees: f64) {
        let (sin, cos) = (degrees % 360.0).to_radians().sin_cos();
        let State { heading, left, up, .. } = &mut self.state;
        // Turns the first axis toward the second.
        let (from, toward) = match turn {
            Turn::Left => (heading, left),
            Turn::Right => (left, heading),
            Turn::Down => (up, heading),
            Turn::Up => (heading, up),
            Turn::RollLeft => (up, left),
            Turn::RollRight => (left, up),
        };
        let (a, b) = (*from, *toward);
        *from = a * cos + b * sin;
        *toward = b * cos - a * sin;
    }

    /// Rolls until left is level. Where the turtle looks straight up or down it is already.
    fn level(&mut self) {
        let state = &mut self.state;
        if let Some(left) = DVec3::Y.cross(state.heading).try_normalize() {
            (state.left, state.up) = (left, state.heading.cross(left));
        }
    }

    fn scale(&mut self, factor: f64, place: Place) -> Result<(), GrammarError> {
        let scale = self.state.scale * factor;
        let (least, most) = limits::SCALES;
        if (least..=most).contains(&scale) {
            self.state.scale = scale;
            return Ok(());
        }
        let what = format!("the scale is {scale:.3e}");
        Err(GrammarError::at(
            place,
            what,
            format!("keep the product of all scales between {least} and {most}"),
        ))
    }

    fn bend(&mut self, strength: f64) {
        let toward = if strength > 0.0 { DVec3::Y } else { DVec3::NEG_Y };
        let axis = self.state.heading.cross(toward);
        let Some(unit) = axis.try_normalize() else { return };
        let rest = self.state.heading.angle_between(toward);
        let turn = DQuat::from_axis_angle(unit, (strength.abs().to_radians() * axis.length()).min(rest));
        let State { heading, left, up, .. } = &mut self.state;
        for axis in [heading, left, up] {
            *axis = (turn * *axis).normalize();
        }
    }

    fn place(&mut self, name: Arc<str>, module: &Module<'_>) {
        let State { position, heading, left, up, scale, stem, .. } = self.state;
        // Arguments too large for their numbers are as large as those can be.
        let argument = |a: &f64| a.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
        self.figure.items.push(Item {
            name,
            args: module.parameters.iter().map(argument).collect(),
            stem,
            origin: position.as_vec3(),
            heading: heading.as_vec3(),
            left: left.as_vec3(),
            up: up.as_vec3(),
            scale: scale as f32,
            key: module.key,
        });
    }
}

fn not_negative(name: &str, value: f64, place: Place) -> Result<f64, GrammarError> {
    if value >= 0.0 {
        return Ok(value);
    }
    let what = format!("the {name} is {value:.4}");
    Err(GrammarError::at(
        place,
        what,
        format!("a {name} is 0 or more, in metres: write `max(0, …)`, or turn and then draw"),
    ))
}

#[cfg(test)]
mod tests {
    use super::super::rules::Grammar;
    use super::*;
    use glam::Vec3;

    fn drawn(text: &str) -> Figure {
        let figure =
            Grammar::parse(&format!("axiom: {text}")).and_then(|grammar| grammar.draw(&Default::default()));
        let figure = figure.expect("a figure");
        figure.check_invariants().expect("sound");
        figure
    }

    /// Where the turtle looks after some symbols, and where its left and its upper side are.
    fn frame(text: &str) -> [Vec3; 3] {
        let figure = drawn(&format!("{text} *o"));
        [figure.items[0].heading, figure.items[0].left, figure.items[0].up]
    }

    fn assert_frame(text: &str, expected: [Vec3; 3]) {
        let frame = frame(text);
        assert!((0..3).all(|k| frame[k].abs_diff_eq(expected[k], 1e-6)), "{text}: {frame:?}");
    }

    #[test]
    fn turns_are_those_of_the_book() {
        let (h, l, u) = (Vec3::Y, Vec3::NEG_X, Vec3::Z);
        assert_frame("", [h, l, u]);
        assert_frame("+(90)", [l, -h, u]);
        assert_frame("-(90)", [-l, h, u]);
        assert_frame("&(90)", [-u, l, h]);
        assert_frame("^(90)", [u, l, -h]);
        assert_frame("\\(90)", [h, -u, l]);
        assert_frame("/(90)", [h, u, -l]);
        assert_frame("|", [-h, -l, u]);
        assert_frame("+(30) &(50) /(70) \\(70) ^(50) -(30)", [h, l, u]);
    }

    #[test]
    fn left_is_brought_level() {
        let [heading, left, up] = frame("&(60) /(40) +(20) $");
        assert!(left.y.abs() < 1e-6 && up.y > 0.0 && heading.y > 0.0);
        assert_frame("$", [Vec3::Y, Vec3::NEG_X, Vec3::Z]);
    }

    #[test]
    fn tropism_bends_by_the_sine_of_the_angle_and_not_too_far() {
        assert_frame("-(90) ~(30)", frame("-(60)"));
        let angle = |text: &str| frame(text)[0].angle_between(Vec3::Y).to_degrees();
        assert!((angle("-(30) ~(-10)") - 35.0).abs() < 1e-3);
        assert!(angle("-(90) ~(170)") < 1e-3);
        let bent = 1.0 + 9000.0 * 1.0f32.to_radians().sin();
        assert!((angle("-(1) ~(-9000)") - bent).abs() < 1e-2);
        assert_frame("~(30)", [Vec3::Y, Vec3::NEG_X, Vec3::Z]);
    }

    #[test]
    fn a_stem_goes_on_behind_a_bracket_and_ends_at_a_gap() {
        let figure = drawn("F(1) [ +(90) F(1) ] F(1) f(1) F(1) [ *o ]");
        let ends: Vec<_> = figure.stems.iter().map(|stem| (stem.parent, stem.points.len())).collect();
        assert_eq!(ends, [(None, 3), (Some(0), 2), (Some(0), 2)]);
        assert_eq!(figure.stems[2].points[0], Vec3::new(0.0, 3.0, 0.0));
        assert_eq!(figure.items[0].stem, Some(2));
    }

    #[test]
    fn segments_without_length_are_left_out() {
        let figure = drawn("F(0) F(1) F(0) F(1e-12) F(1) [ F(0) *o ]");
        assert_eq!(figure.stems.len(), 1);
        assert_eq!(figure.stems[0].points.len(), 3);
        assert_eq!(figure.items[0].stem, Some(0));
    }

    #[test]
    fn radii_are_kept_scaled_and_never_zero() {
        let figure = drawn("!(0.5) F(1) \"(0.5) F(1) F(1, 0.2, 0)");
        assert_eq!(figure.stems[0].radii, [0.5, 0.25, 0.1, limits::LEAST_RADIUS]);
        assert_eq!(figure.stems[0].points[3], Vec3::new(0.0, 2.0, 0.0));
        assert_eq!(drawn("F(1)").stems[0].radii, [0.001; 2]);
    }

    #[test]
    fn solids_stand_where_the_turtle_is() {
        let figure = drawn("@cylinder(0.1, 2) @ball(0.3)");
        assert_eq!(figure.items[0].args, [0.1, 2.0]);
        assert_eq!((&*figure.items[1].name, figure.items[1].origin), ("@ball", Vec3::new(0.0, 2.0, 0.0)));
    }
}
