//! Reads expressions: numbers, parameters, constants, operators and functions.
//!
//! Operators from the weakest to the strongest: `or`; `and`; `not`; `< <= > >= == !=`; `+ -`; `* / %`; the sign; `^`, from
//! the right. `and`, `or` and `if` look only at what they need.

use super::code::{Code, Function, Op, Span};
use super::cursor::Cursor;
use super::error::{GrammarError, Place};
use super::lexer::Kind;
use super::limits;
use crate::quote;
use crate::random::mix;
use crate::suggest::{did_you_mean, nearest};

/// Words that mean something, which nothing else may be called.
pub(super) const RESERVED: [&str; 9] = ["axiom", "steps", "from", "to", "whole", "and", "or", "not", "if"];

/// How many numbers a function takes, and what it does with them.
enum Call {
    /// One number.
    One(Function),
    /// So many numbers.
    Fixed(usize, Op),
    /// Two numbers or more, two at a time.
    Many(Op),
    Random,
    If,
}

const CALLS: [(&str, Call); 19] = [
    ("min", Call::Many(Op::Minimum)),
    ("max", Call::Many(Op::Maximum)),
    ("clamp", Call::Fixed(3, Op::Clamp)),
    ("abs", Call::One(Function::Absolute)),
    ("floor", Call::One(Function::Floor)),
    ("ceil", Call::One(Function::Ceiling)),
    ("round", Call::One(Function::Round)),
    ("sqrt", Call::One(Function::SquareRoot)),
    ("exp", Call::One(Function::Exponential)),
    ("ln", Call::One(Function::Logarithm)),
    ("sin", Call::One(Function::Sine)),
    ("cos", Call::One(Function::Cosine)),
    ("tan", Call::One(Function::Tangent)),
    ("asin", Call::One(Function::ArcSine)),
    ("acos", Call::One(Function::ArcCosine)),
    ("atan", Call::One(Function::ArcTangent)),
    ("atan2", Call::Fixed(2, Op::AngleOf)),
    ("rand", Call::Random),
    ("if", Call::If),
];

/// Whether a name is taken by a function or a word that means something.
pub(super) fn is_taken(name: &str) -> bool {
    RESERVED.contains(&name) || CALLS.iter().any(|(call, _)| *call == name)
}

/// What an expression may name, and where its numbers at random come from.
pub(super) struct Scope<'s> {
    pub(super) parameters: &'s [&'s str],
    pub(super) constants: &'s [&'s str],
    /// Tells the numbers at random of one module apart from those of its other expressions.
    pub(super) site: u64,
    /// How many numbers at random there were.
    pub(super) drawn: u64,
}

/// Reads one expression and adds it to the code.
///
/// # Errors
/// What is no expression, unknown names, functions with a wrong number of arguments.
pub(super) fn read(
    cursor: &mut Cursor<'_, '_>,
    scope: &mut Scope<'_>,
    code: &mut Code,
) -> Result<Span, GrammarError> {
    let start = code.len();
    Reader { cursor, scope, code, depth: 0 }.operators(0)?;
    Ok(code.since(start))
}

struct Reader<'a, 't, 's, 'r> {
    cursor: &'r mut Cursor<'a, 't>,
    scope: &'r mut Scope<'s>,
    code: &'r mut Code,
    depth: u32,
}

/// Strength of the sign, below which `^` stands.
const SIGN: u8 = 7;
/// Strength of `not`.
const NOT: u8 = 3;

/// What an operator between two operands does, and how strongly it binds.
fn operator(kind: Kind<'_>) -> Option<(Op, u8)> {
    Some(match kind {
        Kind::Mark("<") => (Op::Less, 4),
        Kind::Mark("<=") => (Op::LessOrEqual, 4),
        Kind::Mark(">") => (Op::Greater, 4),
        Kind::Mark(">=") => (Op::GreaterOrEqual, 4),
        Kind::Mark("==") => (Op::Equal, 4),
        Kind::Mark("!=") => (Op::NotEqual, 4),
        Kind::Mark("+") => (Op::Add, 5),
        Kind::Mark("-") => (Op::Subtract, 5),
        Kind::Mark("*") => (Op::Multiply, 6),
        Kind::Mark("/") => (Op::Divide, 6),
        Kind::Mark("%") => (Op::Remainder, 6),
        Kind::Mark("^") => (Op::Power, 8),
        _ => return None,
    })
}

impl Reader<'_, '_, '_, '_> {
    /// An operand and all operators behind it that bind at least so strongly.
    fn operators(&mut self, least: u8) -> Result<(), GrammarError> {
        self.depth += 1;
        if self.depth > limits::NESTING {
            let what = format!("the expression has more than {} levels", limits::NESTING);
            return Err(GrammarError::at(
                self.cursor.place(),
                what,
                "divide it, with constants or parameters",
            ));
        }
        self.operand()?;
        while let Some(kind) = self.cursor.peek() {
            let place = self.cursor.place();
            match (kind, operator(kind)) {
                (Kind::Name("or"), _) if least <= 1 => self.lazily(place, false)?,
                (Kind::Name("and"), _) if least <= 2 => self.lazily(place, true)?,
                (_, Some((op, strength))) if strength >= least => {
                    self.cursor.skip();
                    // `^` takes what is right of it first.
                    self.operators(strength + u8::from(op != Op::Power))?;
                    self.code.push(op, place);
                }
                _ => break,
            }
        }
        self.depth -= 1;
        Ok(())
    }

    /// `and` and `or`: the second operand only where it decides.
    fn lazily(&mut self, place: Place, is_and: bool) -> Result<(), GrammarError> {
        self.cursor.skip();
        if !is_and {
            self.code.push(Op::Not, place);
        }
        let jump = self.code.len();
        self.code.push(Op::JumpIfZero(0), place);
        self.operators(if is_and { 3 } else { 2 })?;
        self.code.push(Op::Truth, place);
        let end = self.code.len();
        self.code.push(Op::Jump(0), place);
        self.code.land(jump);
        self.code.push(Op::Number(f64::from(u8::from(!is_and))), place);
        self.code.land(end);
        Ok(())
    }

    fn operand(&mut self) -> Result<(), GrammarError> {
        let place = self.cursor.place();
        match self.cursor.peek() {
            Some(Kind::Number(number)) => {
                self.cursor.skip();
                self.code.push(Op::Number(number), place);
                Ok(())
            }
            Some(Kind::Mark("-")) => {
                self.cursor.skip();
                self.operators(SIGN)?;
                self.code.push(Op::Negate, place);
                Ok(())
            }
            Some(Kind::Name("not")) => {
                self.cursor.skip();
                self.operators(NOT)?;
                self.code.push(Op::Not, place);
                Ok(())
            }
            Some(Kind::Mark("(")) => {
                self.cursor.skip();
                self.operators(0)?;
                self.cursor.expect(")", "the expression in brackets ends")
            }
            Some(Kind::Name(name)) => {
                self.cursor.skip();
                if self.cursor.is_at("(") { self.call(name, place) } else { self.named(name, place) }
            }
            _ => {
                let remedy = "write a number, a name, a function or an expression in brackets";
                Err(self.cursor.unexpected("an expression", remedy))
            }
        }
    }

    fn named(&mut self, name: &str, place: Place) -> Result<(), GrammarError> {
        let place_in = |names: &[&str]| names.iter().position(|n| *n == name).map(|at| at as u16);
        let parameter = place_in(self.scope.parameters).map(Op::Parameter);
        if let Some(op) = parameter.or_else(|| place_in(self.scope.constants).map(Op::Constant)) {
            self.code.push(op, place);
            return Ok(());
        }
        let known = self.scope.parameters.iter().chain(self.scope.constants).copied();
        let nearest = nearest(name, known).map(str::to_owned);
        let what =
            format!("`{}` is no constant and no parameter here{}", quote::name(name), did_you_mean(&nearest));
        Err(GrammarError::at(place, what, "constants are declared above what uses them, as in `n = 12`"))
    }

    fn call(&mut self, name: &str, place: Place) -> Result<(), GrammarError> {
        let Some((_, call)) = CALLS.iter().find(|(call, _)| *call == name) else {
            let known = || CALLS.iter().map(|(name, _)| *name);
            let nearest = nearest(name, known()).map(str::to_owned);
            let what = format!("`{}` is no function{}", quote::name(name), did_you_mean(&nearest));
            let remedy = format!("there are {}", known().collect::<Vec<_>>().join(", "));
            return Err(GrammarError::at(place, what, remedy));
        };
        self.cursor.skip();
        let count = match call {
            Call::If => return self.conditional(place),
            Call::Many(op) => self.arguments(|code, at| {
                if at > 0 {
                    code.push(*op, place)
                }
            })?,
            Call::One(_) | Call::Fixed(..) | Call::Random => self.arguments(|_, _| {})?,
        };
        let (wanted, op) = match call {
            Call::One(function) => (1, Some(Op::Apply(*function))),
            Call::Fixed(count, op) => (*count, Some(*op)),
            Call::Random => (2, Some(Op::Random(mix(self.scope.site, self.scope.drawn)))),
            Call::Many(_) | Call::If => (count.max(2), None),
        };
        if count != wanted {
            let what = format!("`{name}` has {count} arguments");
            return Err(GrammarError::at(place, what, format!("it takes {wanted}")));
        }
        self.scope.drawn += u64::from(matches!(call, Call::Random));
        if let Some(op) = op {
            self.code.push(op, place);
        }
        Ok(())
    }

    /// Arguments up to the closing bracket, and after each of them what is done with it.
    fn arguments(&mut self, each: impl Fn(&mut Code, usize)) -> Result<usize, GrammarError> {
        let mut count = 0;
        while !self.cursor.is_at(")") {
            if count > 0 {
                self.cursor.expect(",", "the next argument begins")?;
            }
            self.operators(0)?;
            each(self.code, count);
            count += 1;
        }
        self.cursor.skip();
        Ok(count)
    }

    /// `if(condition, a, b)`: only one of the two is looked at.
    fn conditional(&mut self, place: Place) -> Result<(), GrammarError> {
        let remedy = "what comes next in `if(condition, a, b)` begins";
        self.operators(0)?;
        self.cursor.expect(",", remedy)?;
        let jump = self.code.len();
        self.code.push(Op::JumpIfZero(0), place);
        self.operators(0)?;
        self.cursor.expect(",", remedy)?;
        let end = self.code.len();
        self.code.push(Op::Jump(0), place);
        self.code.land(jump);
        self.operators(0)?;
        self.code.land(end);
        self.cursor.expect(")", "`if(condition, a, b)` ends")
    }
}
