//! Expressions as they are evaluated: a stack machine over numbers.
//!
//! What is true is 1, what is false 0. Angles are in degrees. A result that is no finite number is an error at the
//! operator that gave it. The stack belongs to the caller: parameters lie on it, results are left on it.

use super::error::{GrammarError, Place};
use crate::random::{mix, unit};

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Absolute,
    Floor,
    Ceiling,
    Round,
    SquareRoot,
    Exponential,
    Logarithm,
    Sine,
    Cosine,
    Tangent,
    ArcSine,
    ArcCosine,
    ArcTangent,
}

impl Function {
    fn of(self, x: f64) -> f64 {
        match self {
            Self::Absolute => x.abs(),
            Self::Floor => x.floor(),
            Self::Ceiling => x.ceil(),
            Self::Round => x.round(),
            Self::SquareRoot => x.sqrt(),
            Self::Exponential => x.exp(),
            Self::Logarithm => x.ln(),
            Self::Sine => x.to_radians().sin(),
            Self::Cosine => x.to_radians().cos(),
            Self::Tangent => x.to_radians().tan(),
            Self::ArcSine => x.asin().to_degrees(),
            Self::ArcCosine => x.acos().to_degrees(),
            Self::ArcTangent => x.atan().to_degrees(),
        }
    }
}

/// One step of an expression: takes numbers from the stack and puts one there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Op {
    Number(f64),
    /// A parameter of the module, by its place.
    Parameter(u16),
    /// A constant, by its place.
    Constant(u16),
    Negate,
    Not,
    /// 1 for anything but 0.
    Truth,
    Add,
    Subtract,
    Multiply,
    Divide,
    /// What a division leaves, never negative.
    Remainder,
    Power,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    NotEqual,
    Minimum,
    Maximum,
    /// The angle to the x axis of a point y, x.
    AngleOf,
    /// A number no less than a second and no more than a third.
    Clamp,
    Apply(Function),
    /// A number at random between two, by its name among those of its module.
    Random(u64),
    /// Goes on elsewhere if the number on top, which it takes, is 0.
    JumpIfZero(u32),
    /// Goes on elsewhere.
    Jump(u32),
}

/// A piece of code that leaves as many numbers on the stack as it has expressions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) start: u32,
    pub(super) end: u32,
}

impl Span {
    pub(super) fn len(self) -> u64 {
        u64::from(self.end - self.start)
    }
}

/// What an expression is evaluated with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surroundings<'a> {
    pub(super) constants: &'a [f64],
    /// Where on the stack the parameters begin.
    pub(super) base: usize,
    /// The stream of numbers at random.
    pub(super) stream: u64,
}

/// All expressions of a grammar, one after another.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Code {
    ops: Vec<Op>,
    places: Vec<Place>,
}

impl Code {
    pub(super) fn len(&self) -> u32 {
        self.ops.len() as u32
    }

    pub(super) fn push(&mut self, op: Op, place: Place) {
        self.ops.push(op);
        self.places.push(place);
    }

    /// Lets a jump at a place lead to what comes next.
    pub(super) fn land(&mut self, jump: u32) {
        let end = self.len();
        if let Op::JumpIfZero(target) | Op::Jump(target) = &mut self.ops[jump as usize] {
            *target = end;
        }
    }

    /// The piece of code from a place to the end.
    pub(super) fn since(&self, start: u32) -> Span {
        Span { start, end: self.len() }
    }

    /// Where a piece of code is written.
    pub(super) fn place(&self, span: Span) -> Place {
        self.places.get(span.start as usize).copied().unwrap_or_default()
    }

    /// Evaluates a piece of code; its results are left on the stack.
    ///
    /// # Errors
    /// A result that is no finite number.
    pub(super) fn run(
        &self,
        span: Span,
        with: Surroundings<'_>,
        stack: &mut Vec<f64>,
    ) -> Result<(), GrammarError> {
        let mut at = span.start;
        while at < span.end {
            let op = self.ops[at as usize];
            at += 1;
            let result = match op {
                Op::Number(number) => number,
                Op::Parameter(place) => stack[with.base + place as usize],
                Op::Constant(place) => with.constants[place as usize],
                Op::Jump(target) => {
                    at = target;
                    continue;
                }
                Op::JumpIfZero(target) => {
                    at = if pop(stack) == 0.0 { target } else { at };
                    continue;
                }
                _ => calculated(op, with.stream, stack),
            };
            if !result.is_finite() {
                return Err(fault(op, self.places[at as usize - 1]));
            }
            stack.push(result);
        }
        Ok(())
    }

    /// Evaluates one expression.
    ///
    /// # Errors
    /// A result that is no finite number.
    pub(super) fn number(
        &self,
        span: Span,
        with: Surroundings<'_>,
        stack: &mut Vec<f64>,
    ) -> Result<f64, GrammarError> {
        self.run(span, with, stack)?;
        Ok(pop(stack))
    }
}

/// The number on top. What is parsed never takes more than it put there.
fn pop(stack: &mut Vec<f64>) -> f64 {
    stack.pop().unwrap_or_default()
}

fn calculated(op: Op, stream: u64, stack: &mut Vec<f64>) -> f64 {
    let truth = |holds: bool| f64::from(u8::from(holds));
    let b = pop(stack);
    match op {
        Op::Negate => return -b,
        Op::Not => return truth(b == 0.0),
        Op::Truth => return truth(b != 0.0),
        Op::Apply(function) => return function.of(b),
        _ => {}
    }
    let a = pop(stack);
    match op {
        Op::Add => a + b,
        Op::Subtract => a - b,
        Op::Multiply => a * b,
        Op::Divide => a / b,
        Op::Remainder => a.rem_euclid(b),
        Op::Power => a.powf(b),
        Op::Less => truth(a < b),
        Op::LessOrEqual => truth(a <= b),
        Op::Greater => truth(a > b),
        Op::GreaterOrEqual => truth(a >= b),
        Op::Equal => truth(a == b),
        Op::NotEqual => truth(a != b),
        Op::Minimum => a.min(b),
        Op::Maximum => a.max(b),
        Op::AngleOf => a.atan2(b).to_degrees(),
        Op::Clamp => pop(stack).max(a).min(b),
        Op::Random(name) => a + (b - a) * f64::from(unit(mix(stream, name))),
        // All others are done with.
        _ => f64::NAN,
    }
}

fn fault(op: Op, place: Place) -> GrammarError {
    let (what, remedy) = match op {
        Op::Divide | Op::Remainder => (
            "division by zero, or by a number too near to it",
            "ask for that first, as in `if(b > 0, a / b, 0)`",
        ),
        Op::Apply(Function::SquareRoot) => {
            ("the square root of a negative number", "write `sqrt(max(x, 0))`")
        }
        Op::Apply(Function::Logarithm) => {
            ("the logarithm of a number that is not positive", "write `ln(max(x, 1e-6))`")
        }
        Op::Apply(Function::ArcSine | Function::ArcCosine) => {
            ("the angle of a number that is not from -1 to 1", "write `acos(clamp(x, -1, 1))`")
        }
        Op::Power => (
            "a power that is no number, or one too large",
            "keep what is raised positive and both numbers small",
        ),
        _ => ("the result is too large for a number", "keep the numbers below 1e300"),
    };
    GrammarError::at(place, what, remedy)
}
