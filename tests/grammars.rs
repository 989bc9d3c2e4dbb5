//! Grammars with any text and any numbers: a result or an error with its place, the same each time; what one number changes,
//! and what it leaves.

use penstemon::grammar::{Figure, Grammar, GrammarError, Limits, Settings, library};
use proptest::prelude::*;

/// Little enough for many cases, enough to reach every limit.
const LIMITS: Limits = Limits { modules: 20_000, brackets: 60, steps: 2_000, operations: 400_000 };

/// Reads and draws; whatever comes of it must be sound.
fn result(text: &str) -> Result<Figure, GrammarError> {
    let result = Grammar::parse(text)
        .and_then(|grammar| grammar.draw(&Settings { seed: 3, limits: LIMITS, ..Settings::default() }));
    match &result {
        Ok(figure) => assert_eq!(figure.check_invariants(), Ok(()), "{text}"),
        Err(error) => {
            let place = error.place().unwrap_or_else(|| panic!("{error} has no place"));
            let lines = text.lines().count().max(1) as u32;
            assert!(place.line >= 1 && place.line <= lines && place.column >= 1, "{error} in\n{text}");
        }
    }
    result
}

/// Pieces of which grammars are made, in any order.
fn soup() -> impl Strategy<Value = String> {
    let pieces = "axiom:|A|B(x)|(|)|[|]|->| : |x|n|=|1|0.5|1e300|-|+|*|/|^|%|&|\\|$|!|\"|~|@ball(1)|*o|F(1)|f(1)|,|<|>=|\
                  and|or|not|if(|rand(0,1)|max(|sqrt(|steps:|from|to|\n|\n  | | |#|é";
    let pieces: Vec<&str> = pieces.split('|').collect();
    prop::collection::vec(prop::sample::select(pieces), 0..60).prop_map(|pieces| pieces.join(" "))
}

/// Expressions that may be wrong only by their values.
fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("x".to_owned()),
        Just("n".to_owned()),
        Just("rand(0, 1)".to_owned()),
        (0.0..3.0f64).prop_map(|number| format!("{number:.3}")),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        let operator = prop::sample::select(vec!["+", "-", "*", "/", "%", "<", ">=", "and", "or"]);
        prop_oneof![
            (inner.clone(), operator, inner.clone()).prop_map(|(a, op, b)| format!("({a} {op} {b})")),
            (inner.clone(), inner.clone(), inner.clone()).prop_map(|(a, b, c)| format!("if({a}, {b}, {c})")),
            inner.clone().prop_map(|a| format!("abs({a})")),
            inner.prop_map(|a| format!("sin({a})")),
        ]
    })
}

/// Grammars that are well formed: two symbols whose rules call each other and end.
fn grammar() -> impl Strategy<Value = String> {
    let module = prop_oneof![
        expression().prop_map(|e| format!("F(min(1, abs({e})), 0.01)")),
        expression().prop_map(|e| format!("[ +({e}) *leaf({e}) A(x + 1) ]")),
        expression().prop_map(|e| format!("&({e})")),
        expression().prop_map(|e| format!("~({e}) $")),
        Just("B(x + 1)".to_owned()),
        expression().prop_map(|e| format!("*flower({e}, rand(0, 1))")),
    ];
    let successor = || prop::collection::vec(module.clone(), 0..5).prop_map(|modules| modules.join(" "));
    (successor(), successor(), successor(), 1..6).prop_map(|(a, b, c, n)| {
        format!(
            "n = {n}\naxiom: A(0)\nA(x) : x < n -> (1) {a} | (rand(0, 2)) {b}\nB(x) : x < n and rand(0, 1) < 0.8 -> {c}"
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn any_text_ends_in_a_result_or_an_error(text in "\\PC{0,200}") {
        let _ = result(&text);
    }

    #[test]
    fn any_pieces_end_in_a_result_or_an_error(text in soup()) {
        let _ = result(&text);
        let _ = result(&format!("n = 2\naxiom: A B(1)\nA -> {text}\nB(x) : x < 9 -> {text}"));
    }

    #[test]
    fn a_valid_grammar_is_deterministic(text in grammar()) {
        prop_assert!(Grammar::parse(&text).is_ok(), "{text}\n{:?}", Grammar::parse(&text));
        prop_assert_eq!(result(&text), result(&text));
    }

    #[test]
    fn one_stems_constant_leaves_the_random_numbers_of_others(
        length in 0.0..1.0f64,
        florets in 0.0..12.0f64,
        seed in any::<u64>(),
    ) {
        let text = "l = 0.1\nn = 6\naxiom: [ M(0) ] [ &(50) O(0) ]\n\
            M(i) : i < n -> (2) F(l * rand(0.5, 1)) [ &(rand(20, 90)) *mine(rand(0, 1)) ] M(i + 1) | (1) F(l) M(i + 1)\n\
            O(i) : i < 6 -> (2) F(rand(0.1, 0.2)) [ &(rand(20, 90)) F(0.1) *other(rand(0, 1)) ] O(i + 1) | (1) F(0.1) O(i + 1)";
        let grammar = Grammar::parse(text).unwrap();
        let drawn = |constants: &[(&str, f64)]| grammar.draw(&Settings { seed, constants, limits: LIMITS }).unwrap();
        let others = |figure: &Figure| {
            let others = figure.items.iter().filter(|item| &*item.name == "other");
            others.map(|item| (item.args.clone(), item.origin, item.heading, item.key)).collect::<Vec<_>>()
        };
        let (before, after) = (drawn(&[]), drawn(&[("l", length), ("n", florets)]));
        prop_assert_eq!(others(&before), others(&after));
        // Of the stem itself those that are there before and after.
        let mine = |figure: &Figure| {
            let mine = figure.items.iter().filter(|item| &*item.name == "mine");
            mine.map(|item| (item.key, item.args.clone())).collect::<Vec<_>>()
        };
        let common = mine(&before).len().min(mine(&after).len());
        prop_assert_eq!(&mine(&before)[..common], &mine(&after)[..common]);
    }

    #[test]
    fn built_in_inflorescences_with_any_values_in_range_are_sound(
        name in prop::sample::select(library::names()),
        shares in prop::collection::vec(0.0..=1.0f64, 30),
        seed in any::<u64>(),
    ) {
        let grammar = library::inflorescence(name).unwrap();
        let ranged = grammar.constants().iter().filter_map(|constant| Some((constant, constant.range?)));
        // Few florets of the widest ranges are many florets still.
        let value = |((constant, (low, high)), share): ((&penstemon::grammar::Constant, (f64, f64)), &f64)| {
            (constant.name.clone(), low + (high - low) * share.powi(3))
        };
        let values: Vec<(String, f64)> = ranged.zip(&shares).map(value).collect();
        let constants: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let figure = grammar.draw(&Settings { seed, constants: &constants, ..Settings::default() });
        let figure = figure.unwrap_or_else(|error| panic!("{name}: {error} with {values:?}"));
        prop_assert_eq!(figure.check_invariants(), Ok(()));
    }
}
