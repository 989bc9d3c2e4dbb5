//! Matching and refusing, over small tables made for it.

use super::*;
use crate::pen::machine::Silence;

const HEAD: &str =
    "[wake]\nv2 = { strings = [200] }\nxp = { outputs = [\"02 b0 04\"] }\n[[maker]]\nname = \"Maker\"\n";

fn tablet(name: &str, fields: &str, nodes: &str) -> String {
    format!(
        "[[maker.tablet]]\nname = \"{name}\"\narea-mm = [100, 50]\nsteps = {{ x = 1000, y = 500, pressure = 2047 }}\n\
         family = \"uclogic\"\n{fields}\nnodes = [{nodes}]\n"
    )
}

fn table(tablets: &[String]) -> Table {
    Table::from_toml(&(HEAD.to_owned() + &tablets.concat())).unwrap()
}

fn names(found: &Match<'_>) -> Vec<String> {
    found.tablets.iter().map(|t| t.name.replace("Maker ", "")).collect()
}

#[test]
fn lengths_and_interface_must_agree() {
    let table = table(&[
        tablet("Short", "", "{ usb = \"256c:006d\", input = 8 }"),
        tablet("Long", "", "{ usb = \"256c:006d\", input = 12, output = 8, interface = 1 }"),
        tablet("Any", "", "{ usb = \"256c:0001\" }"),
    ]);
    let mut none = |_| -> Option<String> { panic!("no row asks for a string") };
    let mut find = |product, input, output, interface| {
        names(&table.find(0x256C, product, input, output, interface, &mut none)).concat()
    };
    assert_eq!(find(0x6D, 8, 0, None), "Short");
    assert_eq!(find(0x6D, 12, 8, Some(1)), "Long");
    assert_eq!(find(0x6D, 12, 8, None), "Long", "the system does not tell the interface");
    assert_eq!(find(0x6D, 12, 8, Some(0)), "");
    assert_eq!(find(0x6D, 12, 0, Some(1)), "", "it cannot be woken");
    assert_eq!(find(0x6D, 9, 0, None), "");
    assert_eq!(find(0x01, 77, 3, Some(9)), "Any");
    assert!(table.knows(0x256C, 0x6D) && !table.knows(0x256C, 0x6E));
}

#[test]
fn another_output_length_is_a_guess_if_nothing_fits() {
    let table = table(&[
        tablet("Nine", "", "{ usb = \"28bd:0936\", input = 12, output = 9 }"),
        tablet("None", "", "{ usb = \"28bd:0936\", input = 12, output = 0 }"),
        tablet("Told", "", "{ usb = \"28bd:0937\", input = 12, output = 9, strings = { 4 = 'A' } }"),
    ]);
    let find = |product, output, answer: Option<&str>| {
        let found = table.find(0x28BD, product, 12, output, None, &mut |_| answer.map(str::to_owned));
        (found.certainty, names(&found).concat(), found.best().is_some())
    };
    assert_eq!(find(0x936, 9, None), (Certainty::Sure, "Nine".to_owned(), true));
    assert_eq!(find(0x936, 64, None), (Certainty::Guess, "Nine".to_owned(), true));
    assert_eq!(find(0x936, 0, None), (Certainty::Sure, "None".to_owned(), true));
    assert_eq!(find(0x937, 64, Some("A")), (Certainty::Guess, "Told".to_owned(), true));
    assert_eq!(find(0x937, 64, Some("B")), (Certainty::Unknown, String::new(), false));
    assert_eq!(find(0x937, 64, None), (Certainty::StringsUnread, "Told".to_owned(), false));
}

#[test]
fn strings_come_first_and_order_decides() {
    let table = table(&[
        tablet("Plain", "", "{ usb = \"256c:006d\", input = 12 }"),
        tablet("Told", "keys = 4", "{ usb = \"256c:006d\", input = 12, strings = { 201 = '^T1_\\d{3}$' } }"),
        tablet(
            "Not that",
            "keys = 5",
            "{ usb = \"256c:006d\", input = 12, strings = { 4 = 'X' }, other-than = { 5 = '^(A|B)$' } }",
        ),
    ]);
    let find = |answers: &[(u8, &str)]| {
        let mut asked = Vec::new();
        let mut answer = |index| {
            assert!(!asked.contains(&index), "string {index} is asked for twice");
            asked.push(index);
            answers.iter().find(|(at, _)| *at == index).map(|(_, text)| (*text).to_owned())
        };
        names(&table.find(0x256C, 0x6D, 12, 0, None, &mut answer)).concat()
    };
    assert_eq!(find(&[(201, "T1_123")]), "Told");
    assert_eq!(find(&[(201, "T1_12x")]), "Plain");
    assert_eq!(find(&[(4, "X"), (5, "C")]), "Not that");
    assert_eq!(find(&[(4, "X"), (5, "B")]), "Plain", "excluded");
    assert_eq!(find(&[(4, "X")]), "Plain", "what cannot be read does not match");
    assert_eq!(find(&[]), "Plain");
}

#[test]
fn tablets_without_a_difference_are_reported() {
    let table = table(&[
        tablet("One", "wake = \"v2\"", "{ usb = \"256c:006d\" }"),
        tablet("Same", "wake = \"v2\"\nkeys = 3", "{ usb = \"256c:006d\" }"),
        tablet("Secret", "", "{ usb = \"256c:006e\", strings = { 201 = 'S' } }"),
        tablet("Twin", "", "{ usb = \"256c:006f\" }"),
        tablet("Other", "wake = \"v2\"", "{ usb = \"256c:006f\" }"),
    ]);
    let find = |product: u16| {
        let found = table.find(0x256C, product, 12, 0, None, &mut |_| None);
        (found.certainty, names(&found), found.best().is_some(), found.unread)
    };
    let owned = |names: &[&str]| names.iter().map(|&n| n.to_owned()).collect::<Vec<_>>();
    assert_eq!(
        find(0x6D),
        (Certainty::Sure, owned(&["One", "Same"]), true, vec![]),
        "no difference in drawing"
    );
    assert_eq!(find(0x6E), (Certainty::StringsUnread, owned(&["Secret"]), false, vec![201]));
    assert_eq!(find(0x6F), (Certainty::Ambiguous, owned(&["Twin", "Other"]), true, vec![]));
    assert_eq!(find(0x70), (Certainty::Unknown, vec![], false, vec![]));
    let known = table.find(0x256C, 0x6E, 12, 0, None, &mut |_| Some("T".into()));
    assert_eq!(known.certainty, Certainty::Unknown, "read, and another");
}

#[test]
fn waking_decides_the_report_id_and_how_the_pen_leaves() {
    let table = table(&[
        tablet("Asleep", "", "{ usb = \"256c:0001\" }"),
        tablet("Woken", "wake = \"v2\"", "{ usb = \"256c:0002\" }, { usb = \"256c:0003\", wake = \"none\" }"),
        tablet("By output", "wake = \"xp\"", "{ usb = \"256c:0004\" }"),
        tablet(
            "With keys",
            "wake = \"v2\"",
            "{ usb = \"256c:0005\" }, { usb = \"256c:0006\", keys-only = true }",
        ),
    ]);
    let said: Vec<_> = table.tablets().iter().map(|t| (t.spec(12).report_id, t.silence())).collect();
    let (asleep, v2) = ((None, None), (Some(8), Some(Silence::KNOWN)));
    assert_eq!(said, [asleep, v2, asleep, (Some(2), None), v2, asleep]);
    let needs: Vec<_> = table.tablets().iter().map(Tablet::needs_strings).collect();
    assert_eq!(needs, [false, true, false, false, true, false]);
}

#[test]
fn what_is_wrong_is_refused_by_name() {
    let good = "{ usb = \"256c:006d\", input = 12 }";
    for (fields, nodes, message) in [
        ("buttons = 4", good, "at most 3 buttons"),
        ("keys = 33", good, "at most 3 buttons and 32 keys"),
        ("touch = [0, 1]", good, "from 1 to"),
        ("wake = \"v3\"", good, "there is no wake sequence \"v3\""),
        ("colour = 1", good, "colour"),
        ("", "", "no node carries the pen"),
        ("", "{ usb = \"256C:006D\" }", "lower-case"),
        ("", "{ usb = \"256c006d\" }", "a colon"),
        ("", "{ usb = \"256c:006d\", input = 0 }", "report length"),
        ("", "{ usb = \"256c:006d\", family = \"aux-generic\" }", "keys-only"),
        ("", "{ usb = \"256c:006d\", family = \"no-such\" }", "no-such"),
        ("", "{ usb = \"256c:006d\", strings = { 0 = 'x' } }", "indices from 1"),
        ("", "{ usb = \"256c:006d\", strings = { 2 = '(' } }", "no expression"),
        ("", "{ usb = \"256c:006d\" }, { usb = \"256c:006d\", keys-only = true }", "the same marks"),
    ] {
        let error =
            Table::from_toml(&(HEAD.to_owned() + &tablet("Bad", fields, nodes))).unwrap_err().to_string();
        assert!(error.contains(message), "{error}\nshould say: {message}");
    }
    let twice = HEAD.to_owned() + &tablet("A", "", good) + &tablet("A", "", good);
    assert_eq!(Table::from_toml(&twice).unwrap_err().to_string(), "tablet \"Maker A\": is there twice");
    let wake = Table::from_toml("[wake]\nx = { outputs = [\"2 zz\"] }\n[[maker]]\nname = \"M\"\ntablet = []");
    assert!(wake.unwrap_err().to_string().contains("wake sequence \"x\": \"2 zz\" is no report"));
    for (from, to) in [("x = 1000", "x = 0"), ("pressure = 2047", "pressure = 0"), ("[100, 50]", "[0, 50]")] {
        let text = HEAD.to_owned() + &tablet("Bad", "", good).replace(from, to);
        assert!(Table::from_toml(&text).is_err(), "{to}");
    }
}

#[test]
fn rules_for_usb_bluetooth_and_strings() {
    let rules = table(&[
        tablet("Plain", "", "{ usb = \"056a:00b8\" }"),
        tablet("Wireless", "", "{ usb = \"056a:0378\", bluetooth = true }"),
        tablet("Told", "", "{ usb = \"256c:006d\", strings = { 201 = 'T' } }"),
        tablet("Woken", "wake = \"v2\"", "{ usb = \"256c:006d\", input = 8 }"),
    ])
    .udev_rules();
    let lines: Vec<&str> =
        rules.lines().filter(|l| l.starts_with("KERNEL") || l.starts_with("SUBSYSTEM")).collect();
    assert_eq!(
        lines,
        [
            r#"KERNEL=="hidraw*", ATTRS{idVendor}=="056a", ATTRS{idProduct}=="00b8", TAG+="uaccess""#,
            r#"KERNEL=="hidraw*", ATTRS{idVendor}=="056a", ATTRS{idProduct}=="0378", TAG+="uaccess""#,
            r#"KERNEL=="hidraw*", KERNELS=="0005:056A:0378.*", TAG+="uaccess""#,
            r#"KERNEL=="hidraw*", ATTRS{idVendor}=="256c", ATTRS{idProduct}=="006d", TAG+="uaccess""#,
            r#"SUBSYSTEM=="usb", ENV{DEVTYPE}=="usb_device", ATTR{idVendor}=="256c", ATTR{idProduct}=="006d", TAG+="uaccess""#,
        ]
    );
    assert!(rules.contains("# Maker Told and 1 more\n"));
}
