//! Applies the rules: from the axiom to modules that no rule replaces.
//!
//! No rule looks at neighbours, so what becomes of a module depends on nothing but itself, and the word need not be
//! written down step by step: every module is followed to its end before the next is looked at, and the turtle draws what
//! is left at once. The memory is that of the deepest chain of rules. A module's step is the number of rules above it.
//!
//! A module is named by its path: by its name among the modules that replaced one module, and by the path of that.
//! Numbers at random come from the streams of paths, so a change leaves those of all other paths as they were.

use super::code::{Span, Surroundings};
use super::error::{GrammarError, Place};
use super::limits::Limits;
use super::rules::{Grammar, Template};
use super::turtle::Module;
use crate::quote;
use crate::random::{Choice, mix};
use std::ops::Range;

/// Modules that replace one module, some of them already dealt with.
#[derive(Clone, Debug)]
struct Frame {
    templates: Range<u32>,
    /// Where on the stack the parameters of the replaced module begin.
    base: u32,
    /// The rule that was applied, none for the axiom.
    rule: Option<u32>,
    key: u64,
}

/// So often one rule is applied within itself where it was hardly meant.
const SUSPICIOUS: u32 = 30;

/// What it takes to begin an expression, in steps of expressions.
const SURROUNDINGS: u64 = 4;

/// A derivation on its way.
pub(super) struct Derivation<'g> {
    grammar: &'g Grammar,
    constants: &'g [f64],
    seed: u64,
    limits: Limits,
    /// After how many steps it ends, if the grammar says so.
    steps: Option<usize>,
    stack: Vec<f64>,
    frames: Vec<Frame>,
    modules: u32,
    operations: u64,
    /// How often each rule was applied.
    applied: Vec<u32>,
}

impl<'g> Derivation<'g> {
    /// With the values of all constants.
    pub(super) fn new(grammar: &'g Grammar, constants: &'g [f64], seed: u64, limits: Limits) -> Self {
        Self {
            grammar,
            constants,
            seed,
            limits,
            steps: None,
            stack: Vec::new(),
            frames: Vec::new(),
            modules: 0,
            operations: 0,
            applied: vec![0; grammar.rules],
        }
    }

    /// Derives, and gives every module that is left to a reader, in the order of the word.
    ///
    /// # Errors
    /// Rules that do not end, expressions without a value, and what the reader refuses.
    pub(super) fn run(
        mut self,
        mut read: impl FnMut(&Module<'_>) -> Result<(), GrammarError>,
    ) -> Result<(), GrammarError> {
        let grammar = self.grammar;
        self.steps = grammar.steps.map(|steps| self.step_count(steps)).transpose()?;
        let axiom = Frame { templates: grammar.axiom.clone(), base: 0, rule: None, key: 0 };
        self.frames.push(axiom);
        while let Some(frame) = self.frames.last_mut() {
            let (base, above) = (frame.base as usize, frame.key);
            let Some(at) = frame.templates.next() else {
                self.stack.truncate(base);
                self.frames.pop();
                continue;
            };
            let template = &grammar.templates[at as usize];
            let key = mix(above, template.name);
            let parameters = self.stack.len();
            self.count_module(template)?;
            self.calculate(template, base, key)?;
            if let Some(symbol) = template.symbol.filter(|_| self.may_replace())
                && let Some((rule, templates)) = self.replacement(symbol, parameters, key)?
            {
                self.applied[rule] += 1;
                self.frames.push(Frame { templates, base: parameters as u32, rule: Some(rule as u32), key });
                if self.frames.len() > self.limits.steps as usize {
                    return Err(self.endless());
                }
                continue;
            }
            let (meaning, place) = (template.meaning, template.place);
            read(&Module { meaning, parameters: &self.stack[parameters..], key, place })
                .map_err(|error| self.on_the_way(error))?;
            self.stack.truncate(parameters);
        }
        Ok(())
    }

    /// The number of steps that the grammar asks for.
    fn step_count(&self, steps: Span) -> Result<usize, GrammarError> {
        let count = self.grammar.constant_expression(steps, self.constants)?;
        let most = self.limits.steps.saturating_sub(1);
        if count >= 0.0 && count <= f64::from(most) {
            return Ok(count as usize);
        }
        let what = format!("the derivation has {count} steps");
        Err(GrammarError::at(self.grammar.code.place(steps), what, format!("give it 0 to {most}")))
    }

    /// Whether there is a step left for modules that are made now.
    fn may_replace(&self) -> bool {
        self.steps.is_none_or(|steps| self.frames.len() <= steps)
    }

    fn count_module(&mut self, template: &Template) -> Result<(), GrammarError> {
        self.modules += 1;
        if self.modules <= self.limits.modules {
            return Ok(());
        }
        let what = format!("there are more than {} modules", self.limits.modules);
        Err(self.too_much(template.place, &what))
    }

    fn spend(&mut self, code: Span) -> Result<(), GrammarError> {
        self.operations += code.len() + SURROUNDINGS;
        if self.operations <= self.limits.operations {
            return Ok(());
        }
        let what = format!("the expressions take more than {} steps", self.limits.operations);
        Err(self.too_much(self.grammar.code.place(code), &what))
    }

    fn surroundings(&self, base: usize, stream: u64) -> Surroundings<'g> {
        Surroundings { constants: self.constants, base, stream }
    }

    /// Puts the parameters of a module on the stack.
    fn calculate(&mut self, template: &Template, base: usize, key: u64) -> Result<(), GrammarError> {
        let code = template.parameters;
        if code.len() == 0 {
            return Ok(());
        }
        self.spend(code)?;
        let with = self.surroundings(base, Choice::MODULE_PARAMETERS.key(mix(self.seed, key)));
        self.grammar.code.run(code, with, &mut self.stack)
    }

    /// The first rule whose condition holds, and what it puts in the place of a module.
    fn replacement(
        &mut self,
        symbol: u32,
        base: usize,
        key: u64,
    ) -> Result<Option<(usize, Range<u32>)>, GrammarError> {
        let grammar = self.grammar;
        let with = self.surroundings(base, Choice::RULE_CONDITION.key(mix(self.seed, key)));
        for rule in &grammar.symbols[symbol as usize].rules {
            if let Some(condition) = rule.condition {
                self.spend(condition)?;
                if grammar.code.number(condition, with, &mut self.stack)? == 0.0 {
                    continue;
                }
            }
            if let [only] = rule.alternatives.as_slice() {
                return Ok(Some((rule.number, only.modules.clone())));
            }
            let weights = self.stack.len();
            for weight in rule.alternatives.iter().filter_map(|alternative| alternative.weight) {
                self.spend(weight)?;
                let weight_value = grammar.code.number(weight, with, &mut self.stack)?;
                if weight_value < 0.0 {
                    let what = format!("the weight is {weight_value:.4}");
                    return Err(GrammarError::at(grammar.code.place(weight), what, "weights are 0 or more"));
                }
                self.stack.push(weight_value);
            }
            let share = Choice::ALTERNATIVE.unit(mix(self.seed, key));
            let chosen = chosen(&self.stack[weights..], f64::from(share));
            self.stack.truncate(weights);
            let Some(chosen) = chosen else {
                let what = format!("all weights of this rule for `{}` are 0", self.name(symbol));
                return Err(GrammarError::at(rule.place, what, "give one of them a weight above 0"));
            };
            return Ok(Some((rule.number, rule.alternatives[chosen].modules.clone())));
        }
        Ok(None)
    }

    fn name(&self, symbol: u32) -> String {
        quote::name(&self.grammar.symbols[symbol as usize].name)
    }

    /// The rule that was applied most often in one another up to here, and how often.
    fn repeated(&self) -> Option<(usize, u32)> {
        let mut times = vec![0u32; self.grammar.rules];
        self.frames.iter().filter_map(|frame| frame.rule).for_each(|rule| times[rule as usize] += 1);
        most(&times).map(|rule| (rule, times[rule]))
    }

    /// An error of the reader. Where one rule led there again and again, that is perhaps what is wrong.
    fn on_the_way(&self, error: GrammarError) -> GrammarError {
        let repeated = self.repeated().filter(|(_, times)| *times >= SUSPICIOUS);
        let rule = repeated.and_then(|(rule, times)| Some((self.grammar.rule(rule)?, times)));
        match (error, rule) {
            (GrammarError::At { place, what, remedy }, Some(((symbol, rule), times))) => {
                let (name, line) = (quote::name(&symbol.name), rule.place.line);
                let end = format!("let the rule for `{name}` in line {line} end");
                let remedy = format!("{remedy}, or {end}, which was applied {times} times on the way");
                GrammarError::At { place, what, remedy }
            }
            (error, _) => error,
        }
    }

    /// The error that one chain of rules goes on and on: by the rule that is applied most often in it.
    fn endless(&self) -> GrammarError {
        let what = format!("does not end within {} steps", self.limits.steps);
        let remedy = "give it a condition that fails one day, as in `A(i) : i < n -> …`, or say `steps: 5`";
        match self.repeated().and_then(|(rule, _)| self.grammar.rule(rule)) {
            Some((symbol, rule)) => GrammarError::at(
                rule.place,
                format!("the rule for `{}` {what}", quote::name(&symbol.name)),
                remedy,
            ),
            None => GrammarError::at(Place { line: 1, column: 1 }, format!("the derivation {what}"), remedy),
        }
    }

    /// The error that all is too much together: by the rule that was applied most often.
    fn too_much(&self, place: Place, what: &str) -> GrammarError {
        let busiest = most(&self.applied);
        match busiest.and_then(|number| Some((number, self.grammar.rule(number)?))) {
            Some((number, (symbol, rule))) => {
                let (name, times) = (quote::name(&symbol.name), self.applied[number]);
                let what = format!("{what}; the rule for `{name}` was applied {times} times");
                GrammarError::at(rule.place, what, "let it end earlier, by its condition or by `steps: …`")
            }
            None => GrammarError::at(place, what, "write less"),
        }
    }
}

/// The place of the greatest number above 0, the first of them.
fn most(numbers: &[u32]) -> Option<usize> {
    let greatest = numbers.iter().max().filter(|number| **number > 0)?;
    numbers.iter().position(|number| number == greatest)
}

/// The place in which a share of the sum of all weights falls.
fn chosen(weights: &[f64], share: f64) -> Option<usize> {
    let mut rest = share * weights.iter().sum::<f64>();
    let is_here = |weight: f64| {
        rest -= weight;
        rest < 0.0 && weight > 0.0
    };
    let mut is_here = is_here;
    weights
        .iter()
        .position(|weight| is_here(*weight))
        .or_else(|| weights.iter().rposition(|weight| *weight > 0.0))
}
