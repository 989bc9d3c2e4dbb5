//! What grammars may say, what they draw, and the messages for what they may not say.

use super::*;
use glam::Vec3;

fn drawn(text: &str) -> Figure {
    drawn_with(text, &Settings::default())
}

fn drawn_with(text: &str, settings: &Settings<'_>) -> Figure {
    let figure = Grammar::parse(text).and_then(|grammar| grammar.draw(settings)).expect("a grammar");
    figure.check_invariants().expect("a figure");
    figure
}

/// The message about a text.
fn said(text: &str) -> String {
    let result = Grammar::parse(text).and_then(|grammar| grammar.draw(&Settings::default()));
    result.expect_err("the text must be refused").to_string()
}

/// The value of an expression, by an organ's argument.
fn value(expression: &str) -> f32 {
    drawn(&format!("two = 2\naxiom: A(3)\nA(x) -> *o({expression})")).items[0].args[0]
}

#[test]
fn expressions_have_the_usual_precedence() {
    let cases: [(&str, f32); 22] = [
        ("1 + 2 * 3 - 4 / 2", 5.0),
        ("-2 ^ 2", -4.0),
        ("2 ^ 3 ^ 2", 512.0),
        ("2 ^ -1", 0.5),
        ("(1 + two) * x", 9.0),
        ("7 % 3 + -1 % 3", 3.0),
        ("1 < 2 and 2 < 1 or 3 >= 3", 1.0),
        ("not 1 < 2", 0.0),
        ("not (1 == 2) and 1 != 2", 1.0),
        ("min(4, two, 3) + max(1, x)", 5.0),
        ("clamp(5, 0, 1) + abs(-3)", 4.0),
        ("floor(2.7) + ceil(2.2) + round(2.5)", 8.0),
        ("sqrt(16) + exp(0) + ln(1)", 5.0),
        ("round(sin(30) * 100)", 50.0),
        ("round(cos(60) * 100 + tan(45))", 51.0),
        ("round(atan(1) + atan2(1, 0))", 135.0),
        ("round(acos(0) + asin(1))", 180.0),
        ("if(x > 2, 10, 20)", 10.0),
        ("if(x > 3, 1 / 0, 20)", 20.0),
        ("x == 3 or 1 / 0", 1.0),
        ("x != 3 and 1 / 0", 0.0),
        ("5 and 7", 1.0),
    ];
    for (expression, expected) in cases {
        assert!(
            (value(expression) - expected).abs() < 1e-4,
            "{expression}: {} is not {expected}",
            value(expression)
        );
    }
}

#[test]
fn a_stem_with_florets_is_drawn() {
    let text = "n = 3  # Number of florets.\naxiom: A(0)\n\
                A(i) : i < n -> F(0.5, 0.02, 0.01) [ +(90) F(0.1, 0.005) *flower(i, 2) ] A(i + 1)";
    let figure = drawn(text);
    assert_eq!(figure.stems.len(), 4);
    assert_eq!(figure.stems[0].points, [0.0, 0.5, 1.0, 1.5].map(|y| Vec3::new(0.0, y, 0.0)));
    assert_eq!(figure.stems[0].radii, [0.02, 0.02, 0.02, 0.01]);
    assert_eq!(figure.stems[2].parent, Some(0));
    let flower = &figure.items[1];
    assert_eq!(
        (&*flower.name, flower.args.as_slice(), flower.stem),
        ("flower", [1.0, 2.0].as_slice(), Some(2))
    );
    assert!(
        flower.origin.abs_diff_eq(Vec3::new(-0.1, 1.0, 0.0), 1e-6)
            && flower.heading.abs_diff_eq(Vec3::NEG_X, 1e-6)
    );
    assert_eq!(
        drawn_with(text, &Settings { constants: &[("n", 5.0)], ..Settings::default() }).stems.len(),
        6
    );
}

#[test]
fn steps_end_a_derivation_and_the_rest_is_drawn() {
    let text =
        "angle = 20\nsteps: 3\naxiom: F(1)\nF(l) -> F(l / 3) [ + F(l / 3) ] F(l / 3) [ - F(l / 3) ] F(l / 3)";
    let figure = drawn(text);
    // Five for one in every step, the main stem and a stem for every bracket.
    assert_eq!(figure.stems.len(), 1 + 2 + 2 * 5 + 2 * 25);
    let segments: usize = figure.stems.iter().map(|stem| stem.points.len() - 1).sum();
    assert_eq!(segments, 125);
    assert!(figure.stems[0].points[27].abs_diff_eq(Vec3::Y, 1e-5));
    assert!(
        said("steps: 1e9\naxiom: F(1)").contains("line 1, column 8: the derivation has 1000000000 steps")
    );
    assert_eq!(drawn("steps: 0\naxiom: A *x\nA -> *y").items.len(), 1);
}

#[test]
fn alternatives_are_chosen_by_weight() {
    let text =
        "n = 2000\naxiom: A(0)\nA(i) : i < n -> B A(i + 1)\nB -> (3) *often | (1) *seldom | (0) *never";
    let figure = drawn(text);
    let share = figure.items.iter().filter(|item| &*item.name == "often").count() as f32 / 2000.0;
    assert!((share - 0.75).abs() < 0.03, "{share}");
    assert!(figure.items.iter().all(|item| &*item.name != "never"));
    // Weights may be expressions.
    let text = "axiom: A(0) A(1)\nA(x) -> (x) *one | (1 - x) *zero";
    assert_eq!(drawn(text).items.iter().map(|item| &*item.name).collect::<Vec<_>>(), ["zero", "one"]);
}

#[test]
fn the_first_rule_that_holds_is_applied() {
    let text = "axiom: A(0) A(1) A(2)\nA(i) : i < 1 -> *a\nA(i) : i < 2 -> *b";
    assert_eq!(drawn(text).items.iter().map(|item| &*item.name).collect::<Vec<_>>(), ["a", "b"]);
}

#[test]
fn random_numbers_belong_to_paths() {
    let text = "n = 10\nlong = 1\nh = rand(1, 2)\naxiom: A(0)\n\
                A(i) : i < n -> F(long * rand(0.1, 0.2)) [ &(rand(0, 90)) F(1) *flower(rand(0, 1), rand(0, 1)) ] A(i + 1)";
    let with = |seed, constants: &[(&str, f64)]| {
        drawn_with(text, &Settings { seed, constants, ..Settings::default() })
    };
    let arguments = |figure: &Figure| figure.items.iter().map(|item| item.args.clone()).collect::<Vec<_>>();
    let keys = |figure: &Figure| figure.items.iter().map(|item| item.key).collect::<Vec<_>>();
    let plain = with(1, &[]);
    assert_eq!(plain, with(1, &[]));
    assert_ne!(arguments(&plain), arguments(&with(2, &[])));
    assert_eq!(keys(&plain), keys(&with(2, &[])), "keys are paths");
    assert_eq!(arguments(&plain), arguments(&with(1, &[("long", 2.0)])));
    assert_eq!(arguments(&plain)[..5], arguments(&with(1, &[("n", 5.0)])));
    assert!(arguments(&plain).iter().all(|a| a[0] != a[1]), "two numbers of one module");
    // A symbol more beside it changes nothing.
    let more = drawn_with(
        &text.replace("*flower", "!(1) *bract *flower"),
        &Settings { seed: 1, ..Settings::default() },
    );
    let flowers: Vec<_> =
        more.items.iter().filter(|item| &*item.name == "flower").map(|item| item.args.clone()).collect();
    assert_eq!(flowers, arguments(&plain));
}

#[test]
fn constants_have_ranges_and_help() {
    let grammar = Grammar::parse("n = 12 from 1 to 60  # Number of florets.\nm = n * 2\naxiom: *o(m)")
        .expect("a grammar");
    let n = &grammar.constants()[0];
    assert_eq!(
        (n.name.as_str(), n.value, n.range, n.help.as_str()),
        ("n", 12.0, Some((1.0, 60.0)), "Number of florets.")
    );
    assert_eq!(grammar.constants()[1].value, 24.0);
    assert_eq!((&*grammar.organs()[0].name, grammar.organs()[0].arguments), ("o", 1));
    let with = |constants: &[(&str, f64)]| grammar.draw(&Settings { constants, ..Settings::default() });
    assert_eq!(with(&[("n", 20.0)]).expect("in range").items[0].args, [40.0]);
    let whole = Grammar::parse("k = 2.4 from 1 to 5 whole\naxiom: *o(k)").expect("a grammar");
    let set = |k| whole.draw(&Settings { constants: &[("k", k)], ..Settings::default() }).expect("in range");
    assert_eq!((whole.constants()[0].value, whole.constants()[0].is_whole), (2.0, true));
    assert_eq!([set(3.6).items[0].args[0], set(5.4).items[0].args[0]], [4.0, 5.0]);
    let error = |constants: &[(&str, f64)]| with(constants).expect_err("refused").to_string();
    assert_eq!(
        error(&[("n", 61.0)]),
        "line 1, column 1: the constant `n` is 61; give it a value from 1 to 60"
    );
    assert!(error(&[("n", f64::NAN)]).contains("the constant `n` is NaN"));
    assert_eq!(error(&[("N", 1.0)]), "the grammar has no constant `N`; did you mean `m`?; it has: n, m");
}

#[test]
fn what_cannot_be_read_is_named_with_its_place() {
    let cases = [
        ("", "line 1, column 1: the grammar has no axiom; write what it begins with, as in `axiom: A(0)`"),
        ("axiom: F(1)\naxiom: F(1)", "line 2, column 1: `axiom:` stands here a second time; leave one"),
        ("axiom: F(1)\n?", "line 2, column 1: `?` means nothing"),
        ("axiom: F(1)\n-> F(1)", "line 2, column 1: `->` stands where a statement is expected"),
        (
            "axiom: Bx\nBlx -> F(1)",
            "line 1, column 8: `Bx` is no symbol; did you mean `Blx`?; give it a rule",
        ),
        ("axiom: FF", "line 1, column 8: `FF` is no symbol; did you mean `F`?; put spaces between"),
        ("axiom: @bal(1)", "line 1, column 8: `@bal` is no symbol; did you mean `@ball`?"),
        ("axiom: [ F(1)", "line 1, column 8: `[` is never closed"),
        ("axiom: F(1) ]", "line 1, column 13: `]` closes nothing"),
        ("axiom: F", "line 1, column 8: `F` has 0 parameters here; write `F(length)`"),
        (
            "axiom: A(1)\nA(x, y) -> F(x)",
            "line 1, column 8: `A` has 1 parameters here; give it 2, as in its rules",
        ),
        (
            "axiom: A\nA -> F(1)\nA(x) -> F(x)",
            "line 3, column 1: `A` has 1 parameters here; give it 0, as in its first",
        ),
        ("axiom: +", "line 1, column 8: `+` has 0 parameters here; write the angle in degrees"),
        (
            "axiom: A(lenght)\nlength = 1\nA(x) ->",
            "line 1, column 10: `lenght` is no constant and no parameter here; did you",
        ),
        ("axiom: F(sine(1))", "line 1, column 10: `sine` is no function; did you mean `sin`?"),
        ("axiom: F(max(1))", "line 1, column 10: `max` has 1 arguments; it takes 2"),
        ("axiom: F(1 +)", "line 1, column 13: `)` stands where an expression is expected"),
        ("axiom: F(1 2)", "line 1, column 12: `2` stands where `,` is expected"),
        ("axiom: 3", "line 1, column 8: a number stands where a symbol is expected"),
        ("axiom: A\nA -> F(1) | (1) F(2)", "line 2, column 1: the first of the alternatives has no weight"),
        (
            "axiom: A\nA -> (1) [ F(1) | (1) F(2) ]",
            "line 2, column 17: an alternative begins inside of a bracket",
        ),
        ("axiom: F(1) | (2) F(1)", "line 1, column 13: `|` stands where the end of the axiom is expected"),
        ("n = 12 from 1\naxiom: F(n)", "line 1, column 13: the statement ends where `to` is expected"),
        (
            "n = 12 from 20 to 30\naxiom: F(n)",
            "line 1, column 1: the constant `n` is 12; give it a value from 20 to 30",
        ),
        ("n = 1 / 0\naxiom: F(n)", "line 1, column 7: division by zero"),
        ("n = 1\nn = 2\naxiom: F(n)", "line 2, column 1: there is a constant `n` already"),
        ("sin = 1\naxiom: F(1)", "line 1, column 1: `sin` means something else"),
        ("axiom: A(1)\nA(x, x) -> F(x)", "line 2, column 6: `x` cannot be the name of this parameter"),
        ("axiom: A(1)\nA(x) F(1)", "line 2, column 6: `F` stands where `->` is expected"),
        ("F(a, b, c, d) -> f(a)\naxiom: F(1)", "line 1, column 1: `F` has 4 parameters; write `F(length)`"),
    ];
    for (text, expected) in cases {
        let said = said(text);
        assert!(said.starts_with(expected), "{text}\n{said}\n{expected}");
    }
}

#[test]
fn what_cannot_be_drawn_is_named_with_its_place() {
    let cases = [
        (
            "axiom: A\nA -> F(0.001) A",
            "line 2, column 1: the rule for `A` does not end within 100000 steps; give it a condition",
        ),
        ("axiom: A(0)\nA(i) -> [ A(i + 1) ]", "line 2, column 9: brackets stand in one another 61 deep"),
        (
            "axiom: A(0)\nA(i) : i < 30 -> A(i + 1) A(i + 1)",
            "line 2, column 1: there are more than 1000000 modules; the rule for `A`",
        ),
        ("axiom: A(2)\nA(x) -> F(1 / (x - 2))", "line 2, column 13: division by zero"),
        ("axiom: A(2)\nA(x) -> F(sqrt(-x))", "line 2, column 11: the square root of a negative number"),
        ("axiom: F(exp(1000))", "line 1, column 10: the result is too large"),
        ("axiom: A\nA -> (0) F(1) | (0) F(2)", "line 2, column 1: all weights of this rule for `A` are 0"),
        ("axiom: A\nA -> (0) F(1) | (-1) F(2)", "line 2, column 19: the weight is -1.0000"),
        ("axiom: F(-1)", "line 1, column 8: the length is -1.0000; a length is 0 or more"),
        ("axiom: F(1, -1)", "line 1, column 8: the radius is -1.0000"),
        (
            "axiom: A\nA -> F(1) A",
            "line 2, column 6: the turtle is more than 1000 m away; lengths are in metres; make this one smaller, or let \
             the rule for `A` in line 2 end, which was applied 1001 times on the way",
        ),
        ("axiom: F(2000)", "line 1, column 8: the turtle is more than 1000 m away"),
        ("axiom: \"(0)", "line 1, column 8: the scale is 0"),
    ];
    for (text, expected) in cases {
        let said = said(text);
        assert!(said.starts_with(expected), "{text}\n{said}\n{expected}");
    }
}

#[test]
fn many_parameters_are_too_many() {
    let names: Vec<String> = (0..8000).map(|k| format!("p{k}")).collect();
    let text = format!("axiom: F(1)\nA({}) -> F(1)", names.join(","));
    assert!(said(&text).starts_with("line 2, column 57: `A` has more than 16 parameters"), "{}", said(&text));
    let text = format!("axiom: *o({}1)", "1,".repeat(16));
    assert!(
        said(&text).starts_with("line 1, column 8: `o` has 17 parameters here; give it fewer"),
        "{}",
        said(&text)
    );
}

#[test]
fn many_operations_are_too_many() {
    let text = format!("axiom: A(0)\nA(i) : i < 90000 -> B(i{}) A(i + 1)\nB(x) ->", " + 1".repeat(4000));
    assert!(
        said(&text).starts_with("line 2, column 1: the expressions take more than 60000000 steps"),
        "{}",
        said(&text)
    );
}

#[test]
fn layers_of_petals_can_be_said() {
    // The layers of the specification of double flowers: divergence, closing, shrink.
    let text = "layers = 3\nclosing = 80\nhalf = 1.5\nshrink = 0.9\naxiom: F(0.2, 0.003) L(0)\n\
                L(i) : i < layers -> [ \"(shrink ^ i) P(i, 0, 5 + 3 * i) ] L(i + 1)\n\
                P(i, j, n) : j < n -> [ /(360 * j / n + (i % 2) * 180 / n) &(90 - closing * 2 / 180 * atan(i / half)) *petal(i) ] P(i, j + 1, n)";
    let figure = drawn(text);
    assert_eq!(figure.items.len(), 5 + 8 + 11);
    let closing = |item: &Item| item.heading.y.asin().to_degrees();
    assert!(closing(&figure.items[0]).abs() < 1e-4);
    let expected = 80.0 * (2.0 / std::f32::consts::PI) * (1.0f32 / 1.5).atan();
    assert!((closing(&figure.items[5]) - expected).abs() < 1e-3);
    assert!((figure.items[5].scale - 0.9).abs() < 1e-6);
}
