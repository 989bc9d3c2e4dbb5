//! Every way a drawing file can be bad, and what the message says: file, stroke, reason, remedy.

use super::{read, with_points, with_strokes};
use penstemon::sketch::error::Fault;
use penstemon::sketch::{PartName, from_bytes, json, limits};
use std::path::Path;
use std::time::{Duration, Instant};

/// Reads `text`, which must fail with a message that holds all of `parts` after the file's name.
#[track_caller]
fn assert_message(text: &str, parts: &[&str]) {
    let message = read(text).unwrap_err().to_string();
    assert!(message.starts_with("drawing: "), "{message}");
    for part in parts {
        assert!(message.contains(part), "`{part}` is not in: {message}");
    }
}

const GOOD: &str = r#"{"format": "penstemon-sketch", "version": 1, "canvas": {"width": 9, "height": 9},
  "strokes": [
    {"id": 3, "tool": "petal", "points": [[0, 0], [1, 1]]},
    {"id": 4, "tool": "branch", "points": [[0, 0], [2, 1], [3, 1]]}
  ]
}"#;

#[test]
fn a_file_cut_off_anywhere_is_an_error_and_says_where() {
    for end in 1..GOOD.len() - 1 {
        let message = read(&GOOD[..end]).unwrap_err().to_string();
        assert!(message.contains("ends too early") && message.contains("line "), "{end}: {message}");
    }
    let cut = &GOOD[..GOOD.find("[2, 1]").unwrap() + 3];
    let column = cut.lines().last().unwrap().len();
    assert_message(cut, &["stroke 2 (id `4`), point 2, line 4", &format!("column {column}: ")]);
}

/// A file with these corrections.
fn with_corrections(corrections: &str) -> String {
    GOOD.replace("\"strokes\": [\n", &format!("\"corrections\": {corrections},\n  \"strokes\": [\n"))
}

#[test]
fn corrections_that_say_nothing_are_refused() {
    let sound =
        with_corrections(r#"[{"strokes": [9, 3, 3], "not": "tree"}, {"strokes": [7], "as": "separate"}]"#);
    let corrections = read(&sound).unwrap().0.corrections;
    assert_eq!(corrections.len(), 2);
    assert_eq!(corrections[0].strokes, [3, 9], "strokes that are not there do no harm");
    for (bad, part) in [
        (r#"{"strokes": [3], "not": "shrub"}"#, "never read as `shrub`; readings are tree, bare_tree, bush"),
        (r#"{"strokes": [3], "not": "separate"}"#, "never read as `separate`"),
        (r#"{"strokes": [3], "not": "tree", "as": "bush"}"#, "either `not` or `as`"),
        (r#"{"strokes": [3]}"#, "either `not` or `as`"),
        (r#"{"strokes": [], "not": "tree"}"#, "names no strokes"),
        (r#"{"not": "tree"}"#, "missing field `strokes`"),
        (r#"{"strokes": [-1], "not": "tree"}"#, "whole number"),
        (r#"{"strokes": 3, "not": "tree"}"#, "a list of ids of strokes"),
        (r#"{"strokes": [3], "not": "tree", "why": 1}"#, "unknown field `why`"),
        (r#"[3, "tree"]"#, "line 2"),
    ] {
        assert_message(&with_corrections(&format!("[{bad}]")), &[part]);
        let second = with_corrections(&format!(r#"[{{"strokes": [3], "as": "leaf"}}, {bad}]"#));
        assert!(read(&second).is_err());
    }
    assert_message(&with_corrections("{}"), &["a list of corrections"]);
    assert_message(&with_corrections(r#"[], "corrections": []"#), &["duplicate field `corrections`"]);
}

/// A file with these shapes of petals.
fn with_petal_shapes(shapes: &str) -> String {
    GOOD.replace("\"strokes\": [\n", &format!("\"petal_shapes\": {shapes},\n  \"strokes\": [\n"))
}

/// The offsets of a petal, of which the third point of the second row is `odd`.
fn offsets(odd: &str) -> String {
    let row = "[[0, 0, 0], [0, 0, 0.5], [0, 0, 0], [0, 0, 0]]";
    format!("[{row}, [[0, 0, 0], [0, 0, 0], {odd}, [0, 0, 0]], {row}, {row}]")
}

#[test]
fn shapes_of_petals_that_mean_nothing_are_refused() {
    let shape =
        |strokes: &str, odd: &str| format!(r#"{{"strokes": {strokes}, "offsets": {}}}"#, offsets(odd));
    let good = shape("[9, 3, 3]", "[-2, 2, 0.1]");
    let shapes = read(&with_petal_shapes(&format!("[{good}]"))).unwrap().0.petal_shapes;
    assert_eq!((shapes.len(), &shapes[0].strokes[..]), (1, &[3, 9][..]));
    assert_eq!(shapes[0].offsets[1][2].to_array(), [-2.0, 2.0, 0.1]);
    for (bad, part) in [
        (shape("[3]", "[0, 2.5, 0]"), "point 3 of row 2 is moved by 2.5; write −2 to 2"),
        (shape("[3]", "[0, 1e30, 0]"), "point 3 of row 2"),
        (
            shape("[3]", "[0, 0]"),
            "invalid length 2, expected an array of length 3; write 4 rows of 4 offsets",
        ),
        (shape("[3]", "[0, 0, 0], [0, 0, 0]"), "write 4 rows of 4 offsets of 3 numbers"),
        (shape("[3]", "7"), "an array of length 3"),
        (shape("[]", "[0, 0, 0]"), "names no stroke"),
        (shape("3", "[0, 0, 0]"), "a list of ids of strokes"),
        (r#"{"strokes": [3]}"#.to_owned(), "missing field `offsets`"),
        (r#"{"strokes": [3], "offsets": [], "why": 1}"#.to_owned(), "4"),
        (r#"{"strokes": [3], "why": 1}"#.to_owned(), "unknown field `why`"),
    ] {
        assert_message(&with_petal_shapes(&format!("[{good}, {bad}]")), &["petal shape 2: ", part, "line "]);
    }
    assert_message(&with_petal_shapes(&format!("[{}]", shape("[3]", "[0, NaN, 0]"))), &["NaN"]);
    assert_message(
        &with_petal_shapes(&format!("[{}]", shape("[3]", "[0, 1e999, 0]"))),
        &["no finite number"],
    );
    assert_message(&with_petal_shapes("{}"), &["a list of shapes of petals"]);
}

#[test]
fn poses_of_branches_that_mean_nothing_are_refused() {
    let with = |poses: &str| {
        GOOD.replace("\"strokes\": [\n", &format!("\"wood_poses\": {poses},\n  \"strokes\": [\n"))
    };
    let good = r#"{"stroke": 3, "turn": [0, 0.6, 0, 0.8]}"#;
    let poses = read(&with(&format!("[{good}]"))).unwrap().0.part_poses;
    assert_eq!((poses.len(), poses[0].part, poses[0].turn.y), (1, PartName::Stroke(3), 0.6));
    for (bad, part) in [
        (
            r#"{"stroke": 4, "turn": [0, 0, 0, 0]}"#,
            "the `turn` of stroke 4 is no turn; write the four numbers",
        ),
        (r#"{"stroke": 4, "bend": [0, 0, 0, 1.1]}"#, "the `bend` of stroke 4"),
        (r#"{"stroke": 4, "turn": [0, 0, 1]}"#, "an array of length 4"),
        (r#"{"stroke": 3}"#, "stroke 3 has two poses"),
        (r#"{"turn": [0, 0, 0, 1]}"#, "one of `stroke` and `grown`"),
        (r#"{"stroke": 4, "grown": "00000000000000ff"}"#, "one of `stroke` and `grown`"),
        (r#"{"grown": "ff"}"#, "16 hexadecimal digits"),
        (r#"{"grown": "00000000000000fx"}"#, "16 hexadecimal digits"),
        (r#"{"grown": "00000000000000ff", "thickness": 9}"#, "write a number from 0.2 to 5"),
        (r#"{"stroke": 4, "shift": [0, 2e7, 0]}"#, "the `shift` of stroke 4 is too far"),
        (r#"{"stroke": 4, "shift": [0, 1]}"#, "an array of length 3"),
        (r#"{"stroke": 4, "straight": 1.5}"#, "the `straight` of stroke 4 is 1.5"),
        (r#"{"stroke": 4, "graft": {"stroke": 4, "at": 0.5}}"#, "stroke 4 is grafted onto itself"),
        (r#"{"stroke": 4, "graft": {"stroke": 3, "at": -1}}"#, "a share of its length"),
        (r#"{"stroke": 4, "graft": {"at": 1}}"#, "a `graft` has one of `stroke` and `grown`"),
        (r#"{"stroke": 4, "graft": {"stroke": 3}}"#, "missing field `at`"),
        (r#"{"stroke": 4, "cut": true}"#, "leave out the stroke"),
        (r#"{"stroke": 4, "why": 1}"#, "unknown field `why`"),
    ] {
        assert_message(&with(&format!("[{good}, {bad}]")), &[part, "line "]);
    }
    assert_message(&with("{}"), &["a list of poses of branches and organs"]);
    let many: Vec<String> = (0..=limits::MAX_PART_POSES).map(|id| format!(r#"{{"stroke": {id}}}"#)).collect();
    assert_message(&with(&format!("[{}]", many.join(","))), &["poses", "4096"]);
}

#[test]
fn endless_shapes_of_petals_are_refused() {
    let shape = |strokes: &str| format!(r#"{{"strokes": [{strokes}], "offsets": {}}}"#, offsets("[0, 0, 0]"));
    let all = vec![shape("3"); limits::MAX_PETAL_SHAPES].join(",");
    assert!(read(&with_petal_shapes(&format!("[{all}]"))).is_ok());
    assert_message(&with_petal_shapes(&format!("[{all}, {}]", shape("3"))), &["shapes of petals", "4096"]);
    let names = |count: usize| shape(&vec!["7"; count].join(","));
    let half = names(limits::MAX_SHAPED_STROKES / 2);
    assert_message(&with_petal_shapes(&format!("[{half}, {half}, {}]", shape("3"))), &["200000"]);
    assert_message(&with_petal_shapes(&format!("[{}]", names(limits::MAX_SHAPED_STROKES + 1))), &["200000"]);
}

#[test]
fn endless_corrections_are_refused() {
    let one = r#"{"strokes": [3], "not": "tree"}"#;
    let all = vec![one; limits::MAX_CORRECTIONS].join(",");
    assert!(read(&with_corrections(&format!("[{all}]"))).is_ok());
    assert_message(&with_corrections(&format!("[{all}, {one}]")), &["corrections", "4096"]);
    let names = |count: usize| format!(r#"{{"strokes": [{}7], "not": "tree"}}"#, "7, ".repeat(count - 1));
    let half = names(limits::MAX_CORRECTED_STROKES / 2);
    assert!(read(&with_corrections(&format!("[{half}, {half}]"))).is_ok());
    assert_message(&with_corrections(&format!("[{half}, {half}, {one}]")), &["200000"]);
    assert_message(
        &with_corrections(&format!("[{}]", names(limits::MAX_CORRECTED_STROKES + 1))),
        &["200000"],
    );
}

#[test]
fn a_file_that_cannot_be_opened() {
    let missing = penstemon::sketch::read(Path::new("no/such/drawing.penstemon")).unwrap_err().to_string();
    assert!(missing.starts_with("no/such/drawing.penstemon: cannot be read: "), "{missing}");
    assert!(penstemon::sketch::read(Path::new("tests")).is_err());
}

#[test]
fn an_endless_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("huge.penstemon");
    std::fs::File::create(&path).unwrap().set_len(limits::MAX_FILE_BYTES + 1).unwrap();
    let error = penstemon::sketch::read(&path).unwrap_err();
    assert!(matches!(error.fault, Fault::FileTooLarge), "{error}");
}

#[test]
fn files_of_other_kinds() {
    assert_message("", &["is empty"]);
    assert_message(" \n\t", &["is empty"]);
    assert_message("v 0 0 0\n", &["is not a drawing"]);
    assert_message("<html><body/></html>", &["its root is not <svg>"]);
    let compressed = from_bytes(b"\x1f\x8b\x08\0", "a.svgz").unwrap_err().to_string();
    assert!(compressed.contains("save it as plain .svg"), "{compressed}");
    assert_message(r#"{"strokes": []}"#, &["`format` is missing"]);
    assert_message(
        r#"{"format": "excalidraw", "elements": []}"#,
        &["\"excalidraw\", not \"penstemon-sketch\""],
    );
    assert_message(
        r#"{"elements": [], "format": "excalidraw"}"#,
        &["\"excalidraw\", not \"penstemon-sketch\""],
    );
}

#[test]
fn other_versions() {
    let newer = r#"{"format": "penstemon-sketch", "layers": [], "version": 15, "strokes": []}"#;
    assert_message(newer, &["version 15", "reads versions 1 to 14", "newer Penstemon"]);
    assert_message(
        &GOOD.replace("\"version\": 1", "\"version\": 0"),
        &["version 0", "reads versions 1 to 14"],
    );
    assert_message(&GOOD.replace("\"version\": 1,", ""), &["`version` is missing"]);
    assert_message(&GOOD.replace("\"version\": 1", "\"version\": \"one\""), &["\"one\"", "line 1"]);
}

#[test]
fn numbers_that_are_none() {
    for number in ["NaN", "-Infinity", "1e999", "-1e400", "null", "1e39"] {
        let text = with_strokes(&format!(
            r#"{{"points": [[0,0]]}}, {{"id": 8, "points": [[0, 1], [2, {number}]]}}"#
        ));
        assert_message(&text, &["stroke 2 (id `8`), point 2, line 1", number, "no finite number"]);
    }
}

#[test]
fn coordinates_too_far_out() {
    assert_message(&with_points("[[0, 0], [0, -1e30]]"), &["stroke 1, point 2: coordinate -1e30", "±1e7"]);
    assert!(read(&with_points("[[0, 0], [1e7, -1e7]]")).is_ok());
    let deep =
        |depth: &str| with_points(&format!("[[5, 5, 0.5, 0, 0, 0, 0], [5, 5, 0.5, 0, 0, 0, {depth}]]"));
    assert_message(&deep("-2e7"), &["stroke 1, point 2: coordinate -2e7", "±1e7"]);
    assert!(read(&deep("-1e7")).is_ok(), "a line straight away from the viewer is none of dots");
    let far = r#"<svg><path id="far" d="M0 0 L1e30 5"/></svg>"#;
    assert_message(far, &["element `far`, line 1, column 6: coordinate 1e30", "±1e7"]);
    let far =
        r#"<svg><g transform="scale(1e200)"><g transform="scale(1e200)"><path d="M0 0 L1 5"/></g></g></svg>"#;
    assert_message(far, &["line 1, column 62: `NaN` is no finite number"]);
}

#[test]
fn drawings_without_a_line() {
    assert_message(&with_strokes(""), &["no stroke", "draw at least one"]);
    assert_message(&with_points("[]"), &["no stroke"]);
    assert_message(&with_points("[[3, 4]]"), &["dot"]);
    assert_message("<svg/>", &["no stroke"]);
    assert_message(r#"<svg><path d="M 5 5"/></svg>"#, &["no stroke"]);
    assert_message(r#"<svg><path d="M 5 5 Z"/></svg>"#, &["dot"]);
}

#[test]
fn empty_strokes_are_left_out_and_dots_kept_when_there_is_a_line() {
    let text = with_strokes(r#"{"id": 5, "points": []}, {"points": [[1, 1]]}, {"points": [[0, 0], [5, 5]]}"#);
    let (sketch, warnings) = read(&text).unwrap();
    assert_eq!(sketch.strokes.iter().map(|s| s.points.len()).collect::<Vec<_>>(), [1, 2]);
    assert_eq!(warnings.len(), 1);
    assert_eq!(warnings[0].to_string(), "stroke 5: stroke 1 of the file has no points and was left out");
}

#[test]
fn remarks_are_bounded() {
    let text = with_strokes(&format!(r#"{}{{"points": [[0,0],[1,1]]}}"#, r#"{"points": []},"#.repeat(5000)));
    let (_, warnings) = read(&text).unwrap();
    assert_eq!(warnings.len(), limits::MAX_WARNINGS + 1);
    assert_eq!(warnings[limits::MAX_WARNINGS].to_string(), "and 4900 more remarks like these");
}

#[test]
fn too_many_points() {
    let text = with_points(&format!("[{}[0,0]]", "[1,2],".repeat(limits::MAX_POINTS)));
    assert_message(&text, &["stroke 1, point 10000001", "more than 10000000 points"]);
}

#[test]
fn pressure_tilt_and_time_are_brought_into_range() {
    let (sketch, warnings) = read(&with_points("[[0,0,-1], [1,1,7,100,-100,-3], [2,2,0.3]]")).unwrap();
    let points = &sketch.strokes[0].points;
    assert_eq!(points.iter().map(|p| p.pressure).collect::<Vec<_>>(), [0.0, 1.0, 0.3]);
    assert_eq!((points[1].tilt_deg.to_array(), points[1].time_ms), ([90.0, -90.0], 0.0));
    let messages: Vec<_> = warnings.iter().map(ToString::to_string).collect();
    assert_eq!(messages[0], "stroke 1: pressure of 2 points lay outside 0 to 1 and was brought into it");
    assert_eq!(messages.len(), 3, "{messages:?}");
}

#[test]
fn ids_used_twice() {
    let text =
        with_strokes(r#"{"id": 9, "points": [[0,0]]}, {"points": [[0,0]]}, {"id": 9, "points": [[0,0]]}"#);
    assert_message(&text, &["stroke 3 (id `9`)", "already names stroke 1"]);
    assert_message(&with_strokes(r#"{"id": -1, "points": []}"#), &["stroke 1", "whole number"]);
}

#[test]
fn tools_that_do_not_exist() {
    let known = "auto, petal, leaf, branch, branch_outline, leaf_outline, crown";
    assert_message(
        &with_strokes(r#"{"id": 2, "tool": "lawnmower", "points": []}"#),
        &["stroke 1 (id `2`)", "unknown tool `lawnmower`", known],
    );
    assert_message(
        r#"<svg><path id="x" data-tool="mower" d="M0 0L1 1"/></svg>"#,
        &["element `x`", "`mower`", known],
    );
}

#[test]
fn fields_that_do_not_exist_are_missing_or_repeated() {
    assert_message(&GOOD.replace("\"canvas\"", "\"canvass\""), &["unknown field `canvass`", "line 1"]);
    assert_message(
        &GOOD.replace("\"height\"", "\"hight\""),
        &["unknown field `hight`", "`width` or `height`"],
    );
    assert_message(
        &GOOD.replace("\"id\": 4", "\"colour\": 4"),
        &["stroke 2", "unknown field `colour`", "line 4"],
    );
    assert_message(&with_strokes(r#"{"id": 3}"#), &["stroke 1 (id `3`)", "missing field `points`"]);
    assert_message(
        &with_strokes(r#"{"id": 3, "id": 4, "points": []}"#),
        &["stroke 1", "duplicate field `id`"],
    );
    assert_message(r#"{"format": "penstemon-sketch", "version": 1}"#, &["no `strokes`"]);
    assert_message(&GOOD.replace("\"width\": 9", "\"width\": -9"), &["canvas is -9 by 9"]);
}

#[test]
fn points_of_the_wrong_shape() {
    for (point, says) in [
        ("[]", "length 0"),
        ("[1]", "length 1"),
        ("[1, 2, 3, 4]", "length 4"),
        ("[1, 2, 3, 4, 5, 6, 7, 8]", "length 8"),
        ("{}", "map"),
        ("5", "integer `5`"),
        (r#"["1", 2]"#, "expected a number"),
    ] {
        assert_message(&with_points(&format!("[[0, 0], {point}]")), &["stroke 1, point 2, line 1", says]);
    }
    assert_message(&format!("{GOOD} x"), &["trailing characters"]);
}

#[test]
fn parameters_of_the_wrong_shape() {
    let with_params = |params: &str| GOOD.replace("\"canvas\"", &format!("\"params\": {params}, \"canvas\""));
    assert_message(&with_params("[]"), &["object of parameters"]);
    assert_message(&with_params(r#"{"a": [1]}"#), &["number, true or false, a name"]);
    assert_message(&with_params(r#"{"a": 1, "a": 2}"#), &["parameter `a` is set twice"]);
    let deep = format!("{}1{}", r#"{"a":"#.repeat(20), "}".repeat(20));
    assert_message(&with_params(&deep), &["nested too deeply"]);
    let many: Vec<String> = (0..=limits::MAX_PARAMS).map(|i| format!("\"p{i}\": 1")).collect();
    assert_message(&with_params(&format!("{{{}}}", many.join(","))), &["more than 4096 parameters"]);
}

#[test]
fn bytes_that_are_no_text() {
    let mut bytes = GOOD.as_bytes().to_vec();
    bytes[40] = 0xff;
    let message = from_bytes(&bytes, "drawing").unwrap_err().to_string();
    assert!(message.contains("byte 40 is not valid UTF-8"), "{message}");
}

#[test]
fn deep_nesting_is_refused_without_recursion() {
    let depth = 1_000_000;
    assert_message(
        &format!("{}\"points\": {}", r#"{"strokes": [{"#, "[".repeat(depth)),
        &["stroke 1", "point 1"],
    );
    assert_message(&format!("{}{}", r#"{"x":"#, "[".repeat(depth)), &["unknown field `x`"]);
    let nested = format!("<svg>{}<line x2='3'/>{}</svg>", "<g>".repeat(depth / 2), "</g>".repeat(depth / 2));
    assert!(read(&nested).is_ok());
    assert!(read(&format!("<svg>{}", "<g>".repeat(depth))).is_err());
    assert!(read(&format!("<svg><path d='M0 0L1 1{}'/></svg>", "z".repeat(depth))).is_ok());
}

#[test]
fn damaged_svg() {
    let text = r#"<svg width="9"><g><path d="M0 0L5 5"/></g></svg>"#;
    for end in 1..text.len() {
        assert!(read(&text[..end]).is_err(), "{}", &text[..end]);
    }
    assert_message(&text[..text.len() - 4], &["line 1, column 45", "ends too early"]);
    assert_message("<svg>\n<path></g></svg>", &["line 2, column 7", "not well-formed XML"]);
    assert_message("<!DOCTYPE svg [<!ENTITY a 'b'>]><svg>&a;</svg>", &["entities", "plain SVG"]);
}

/// Documents made to cost quadratic time or memory must not.
#[test]
fn hostile_svg_ends_soon() {
    let start = Instant::now();
    let many_attributes: String = (0..300_000).map(|i| format!(" a{i}=''")).collect();
    assert!(read(&format!("<svg{many_attributes}/>")).is_err());
    let prefixes: String = (0..2_000).map(|i| format!(" xmlns:n{i}='u'")).collect();
    let declaring = "<g xmlns:x='u'/>".repeat(24_000);
    assert!(read(&format!("<svg{prefixes}>{declaring}</svg>")).is_err());
    let copies = r##"<use href="#p"/>"##.repeat(100_000);
    let spaces = " ".repeat(1 << 20);
    assert!(read(&format!("<svg><path id='p' d='M0 0{spaces}L1 1'/>{copies}</svg>")).is_err());
    let levels: String = (1..16)
        .map(|i| {
            let use_twenty = format!("<use href='#l{}'/>", i - 1).repeat(20);
            format!("<g id='l{i}'>{use_twenty}</g>")
        })
        .collect();
    assert!(read(&format!("<svg><g id='l0'><line x2='9'/></g>{levels}</svg>")).is_err());
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}

/// Style sheets of many rules, of rules that all look at all ancestors, and of lists against lists of declarations.
#[test]
fn hostile_style_sheets_end_soon() {
    let start = Instant::now();
    let styled = |css: &str, content: &str| read(&format!("<svg><style>{css}</style>{content}</svg>"));
    let line = "<line x2='9' class='c'/>";
    let (open, close) = ("<g>".repeat(100_000), "</g>".repeat(100_000));
    let descendants = format!("x {}line {{fill:red}}", "g ".repeat(100_000));
    assert!(styled(&descendants, &format!("{open}{line}{close}")).is_err());
    let rules: String = (0..20_000).map(|i| format!(".c{i}{{fill:red}}")).collect();
    let classes: String = (0..20_000).map(|i| format!("<line x2='9' class='c{i}'/>")).collect();
    assert_eq!(styled(&rules, &classes).unwrap().0.strokes.len(), 20_000);
    let for_all = "[class]{fill:red}".repeat(20_000);
    assert!(styled(&for_all, &classes).is_err());
    let (list, declarations) = ("line,".repeat(50_000), "fill:red;".repeat(50_000));
    assert_eq!(styled(&format!("{list}line {{{declarations}}}"), line).unwrap().0.strokes.len(), 1);
    assert!(styled(&"/**/".repeat(500_000), line).is_ok());
    let message = styled(&" ".repeat(limits::MAX_SVG_STYLE_BYTES), line).unwrap_err().to_string();
    assert!(message.contains("style sheets are larger"), "{message}");
    for css in [
        "{",
        "}",
        "@",
        "@{",
        "a{",
        ",{fill:none}",
        "a>{x:y}",
        "*|*{fill:none}",
        "a[b='{']{fill:none}",
        "é{é:é}",
    ] {
        assert!(styled(css, line).is_ok(), "{css}");
    }
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}

#[test]
fn a_path_of_ten_megabytes_is_read() {
    let data: String = (0..1_000_000).map(|i| format!("L{}.5 {}.5 ", i % 999, i % 777)).collect();
    assert!(data.len() > 10_000_000);
    let (sketch, _) = read(&format!("<svg><path d='M0 0 {data}'/></svg>")).unwrap();
    assert_eq!(sketch.strokes[0].points.len(), 1_000_001);
}

#[test]
fn the_good_file_is_good() {
    let (sketch, warnings) = read(GOOD).unwrap();
    assert_eq!((sketch.strokes.len(), warnings.len()), (2, 0));
    assert_eq!(read(&json::write(&sketch)).unwrap().0, sketch);
}

/// A file with one stroke and these plants.
fn with_plants(plants: &str) -> String {
    let stroke = r#"{"points": [[0, 0], [1, 1]]}"#;
    format!(r#"{{"format": "penstemon-sketch", "version": 3, "plants": [{plants}], "strokes": [{stroke}]}}"#)
}

#[test]
fn plants_beside_the_drawn_one() {
    let good = r#"{"maker": "growth", "species": "oak", "foot": [1, 2]}"#;
    super::read(&with_plants(good)).unwrap();
    let after_good = |plant: &str| with_plants(&format!("{good}, {plant}"));
    for (wrong, pieces) in [
        (r#"{"maker": "rose", "petals": 5}"#, &["plant 2: ", "made by `rose`", "the makers are growth"][..]),
        (r#"{"species": "oak", "foot": [1, 2]}"#, &["plant 2: ", "maker"]),
        (r#"{"maker": "growth", "foot": [1, 2]}"#, &["plant 2: ", "species"]),
        (r#"{"maker": "growth", "species": "oak"}"#, &["plant 2: ", "foot"]),
        (r#"{"maker": "growth", "species": "", "foot": [1, 2]}"#, &["plant 2: ", "species"]),
        (r#"{"maker": "growth", "species": "oak", "foot": [1, 2e7]}"#, &["plant 2: ", "foot", "nearer"]),
        (r#"{"maker": "growth", "species": "oak", "foot": [1, 1e300]}"#, &["`1e300` is no finite number"]),
        (
            r#"{"maker": "growth", "species": "oak", "foot": [1, 2], "age": -1}"#,
            &["plant 2: ", "age", "0 to 10000"],
        ),
        (
            r#"{"maker": "growth", "species": "oak", "foot": [1, 2], "height": 0}"#,
            &["plant 2: ", "height", "natural"],
        ),
        (r#"{"maker": "growth", "species": "oak", "foot": [1, 2], "hight": 9}"#, &["plant 2: ", "`hight`"]),
    ] {
        assert_message(&after_good(wrong), &[&["line 1, column "], pieces].concat());
    }
    let many = vec![good; limits::MAX_PLANTS + 1].join(", ");
    assert_message(&with_plants(&many), &["more than 16 plants"]);
}

#[test]
fn a_drawing_of_plants_alone_needs_no_strokes() {
    let good = r#"{"maker": "growth", "species": "oak", "foot": [1, 2]}"#;
    let text = with_plants(good).replace(r#"{"points": [[0, 0], [1, 1]]}"#, "");
    let (sketch, _) = super::read(&text).unwrap();
    assert_eq!((sketch.strokes.len(), sketch.plants.len()), (0, 1));
}
