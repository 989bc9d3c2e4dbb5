//! SVG as Inkscape, Krita and people write it. The expected boxes are Inkscape's own, see `tests/fixtures/svg/README.md`.

use super::read;
use glam::{Vec2, vec2};
use penstemon::sketch::{Canvas, Sketch, Stroke, Tool};
use std::path::Path;
use std::sync::Arc;

const INKSCAPE: &str = include_str!("../fixtures/svg/inkscape-layers.svg");
const INKSCAPE_PLAIN: &str = include_str!("../fixtures/svg/inkscape-plain.svg");
const KRITA: &str = include_str!("../fixtures/svg/krita-shapes.svg");
const HANDMADE: &str = include_str!("../fixtures/svg/handmade.svg");
const DESIGNER: &str = include_str!("../fixtures/svg/designer.svg");

/// Icons and how many subpaths are painted in each, counted by hand; the frames of Tabler's are not painted.
const ICONS: [(&str, usize); 24] = [
    ("mynaui_flower-2", 9),
    ("mynaui_flower", 7),
    ("mynaui_leaf", 3),
    ("mynaui_shrub", 3),
    ("mynaui_sprout", 5),
    ("mynaui_tree-deciduous", 2),
    ("mynaui_tree-palm", 5),
    ("mynaui_tree-pine", 2),
    ("mynaui_tree", 2),
    ("mynaui_trees", 3),
    ("tabler_cactus", 4),
    ("tabler_cherry", 5),
    ("tabler_christmas-tree", 2),
    ("tabler_clover-2", 5),
    ("tabler_clover", 4),
    ("tabler_flower", 2),
    ("tabler_leaf-2", 2),
    ("tabler_leaf-maple", 2),
    ("tabler_leaf", 2),
    ("tabler_plant-2", 5),
    ("tabler_plant", 4),
    ("tabler_seedling", 3),
    ("tabler_tree", 4),
    ("tabler_trees", 6),
];

/// The boxes of `inkscape-layers.svg`: left, top, width, height in pixels, in document order.
const INKSCAPE_BOXES: [[f32; 4]; 9] = [
    [206.398, 36.1732, 81.1035, 155.294],
    [229.974, 172.92, 159.352, 82.2326],
    [149.05, 196.187, 111.374, 171.556],
    [74.4876, 164.973, 147.906, 69.5718],
    [226.772, 196.535, 7.55906, 332.598],
    [217.701, 424.819, 89.1969, 38.5512],
    [173.858, 264.567, 56.6929, 98.2677],
    [230.551, 366.614, 90.7087, 11.3386],
    [415.748, 105.827, 302.362, 226.772],
];

fn positions(stroke: &Stroke) -> Vec<Vec2> {
    stroke.points.iter().map(|p| p.position).collect()
}

/// Compares to a fiftieth of a pixel: the flattening tolerance of the largest of these drawings.
fn assert_boxes(strokes: &[Arc<Stroke>], expected: &[[f32; 4]]) {
    assert_eq!(strokes.len(), expected.len());
    for (stroke, [left, top, width, height]) in strokes.iter().zip(expected) {
        let all = positions(stroke);
        let lo = all.iter().copied().reduce(Vec2::min).unwrap();
        let hi = all.iter().copied().reduce(Vec2::max).unwrap();
        let found = [lo.x, lo.y, hi.x, hi.y];
        let expected = [*left, *top, left + width, top + height];
        let same = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.02);
        assert!(same, "stroke {}: {found:?}, Inkscape says {expected:?}", stroke.id);
    }
}

fn tools(strokes: &[Arc<Stroke>]) -> Vec<Tool> {
    strokes.iter().map(|s| s.tool).collect()
}

/// Reads a file in which nothing is odd.
fn read_cleanly(text: &str) -> Sketch {
    let (sketch, warnings) = read(text).unwrap();
    assert_eq!(warnings, []);
    sketch
}

/// Checks a drawing on a canvas of some width and height: the tool and the box of each of its strokes.
fn assert_strokes(text: &str, [width, height]: [f32; 2], expected: &[(Tool, [f32; 4])]) {
    let sketch = read_cleanly(text);
    assert_eq!(sketch.canvas, Canvas { width, height });
    let (tools_expected, boxes): (Vec<Tool>, Vec<[f32; 4]>) = expected.iter().copied().unzip();
    assert_eq!(tools(&sketch.strokes), tools_expected);
    assert_boxes(&sketch.strokes, &boxes);
}

fn svg(content: &str) -> String {
    format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">{content}</svg>"#)
}

#[test]
fn inkscape_layers_lie_where_inkscape_draws_them() {
    let sketch = read_cleanly(INKSCAPE);
    let Canvas { width, height } = sketch.canvas;
    assert!((width - 793.701).abs() < 1e-3 && (height - 559.370).abs() < 1e-3);
    assert_boxes(&sketch.strokes, &INKSCAPE_BOXES);
}

#[test]
fn inkscape_layer_names_are_tools_and_hidden_layers_are_not_drawn() {
    let (sketch, _) = read(INKSCAPE).unwrap();
    let expected = [[Tool::Petal; 4], [Tool::Branch; 4]].concat();
    assert_eq!(tools(&sketch.strokes), [expected, vec![Tool::LeafOutline]].concat());
}

#[test]
fn plain_svg_from_inkscape_is_the_same_drawing() {
    let sketch = read_cleanly(INKSCAPE_PLAIN);
    assert_boxes(&sketch.strokes, &INKSCAPE_BOXES);
}

#[test]
fn krita_shapes_lie_where_inkscape_draws_them() {
    let expected = [
        (Tool::Auto, [160.321, 129.006, 54.4632, 105.234]),
        (Tool::Auto, [190.24, 141.706, 94.114, 76.4123]),
        (Tool::Branch, [210.495, 234.24, 3.58544, 268.8]),
    ];
    assert_strokes(KRITA, [768.0, 576.0], &expected);
}

#[test]
fn nested_transforms_viewports_symbols_and_all_path_commands() {
    let (sketch, warnings) = read(HANDMADE).unwrap();
    // The symbol's circle has radius 5 in a box that leaves it 5 units of free space to the left.
    let bud = [112.5, 50.0, 25.0, 25.0];
    let nested = [211.141, 61.5363, 37.6799, 25.9637];
    let smooth = [100.0, 25.0, 100.0, 25.0];
    let arcs = [262.309, 50.0, 37.6905, 35.193];
    let (closed, second_subpath) = (&sketch.strokes[2], &sketch.strokes[3]);
    assert_boxes(&[&sketch.strokes[..2], &sketch.strokes[4..]].concat(), &[nested, bud, smooth, arcs]);
    assert_eq!(positions(closed).first(), positions(closed).last());
    assert_eq!(positions(second_subpath), [vec2(230.0, 105.0), vec2(235.0, 110.0)]);
    assert_eq!(warnings, [], "an invisible rectangle is no part of the drawing");
}

#[test]
fn subpaths_are_strokes_of_their_own_and_a_close_returns_to_the_start() {
    let (sketch, _) = read(&svg(r#"<path d="M0 0 L10 0 M 5 5 M1 1 h2 v2 z l 5 5 M9 9"/>"#)).unwrap();
    let found: Vec<_> = sketch.strokes.iter().map(|s| positions(s)).collect();
    let triangle = vec![vec2(1.0, 1.0), vec2(3.0, 1.0), vec2(3.0, 3.0), vec2(1.0, 1.0)];
    let expected = [vec![vec2(0.0, 0.0), vec2(10.0, 0.0)], triangle, vec![vec2(1.0, 1.0), vec2(6.0, 6.0)]];
    assert_eq!(found, expected);
}

#[test]
fn polylines_polygons_and_lines_are_strokes() {
    let shapes = r#"<polyline points="0,0 1,2 3,4 5"/><polygon points="0 0 2 0 2 2"/>
        <line x1="1mm" x2="10"/>"#;
    let (sketch, _) = read(&svg(shapes)).unwrap();
    assert_eq!(positions(&sketch.strokes[0]), [vec2(0.0, 0.0), vec2(1.0, 2.0), vec2(3.0, 4.0)]);
    assert_eq!(positions(&sketch.strokes[1]).len(), 4);
    assert_eq!(positions(&sketch.strokes[2]), [vec2(96.0 / 25.4, 0.0), vec2(10.0, 0.0)]);
}

#[test]
fn the_nearest_name_is_the_tool() {
    let line = r#"<line x2="9"/>"#;
    let text = format!(
        r#"{line}<g id="leaves">{line}<g id="g12">{line}<g data-tool="branch">{line}</g></g>
        <g inkscape:label="Petals" id="leaf1">{line}</g><line id="auto" x2="9"/></g>"#
    );
    let with_namespace = svg(&text).replacen(
        "<svg ",
        r#"<svg xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" "#,
        1,
    );
    let (sketch, _) = read(&with_namespace).unwrap();
    let expected = [Tool::Auto, Tool::Leaf, Tool::Leaf, Tool::Branch, Tool::Petal, Tool::Auto];
    assert_eq!(tools(&sketch.strokes), expected);
}

#[test]
fn what_is_not_rendered_is_not_drawn() {
    let line = r#"<line x2="9"/>"#;
    let hidden = format!(
        r#"<defs>{line}</defs><clipPath>{line}</clipPath><symbol>{line}</symbol><marker>{line}</marker>
        <g display="none">{line}</g><g style="fill:none; display : none">{line}</g>
        <g visibility="hidden">{line}<line y2="7" visibility="visible"/></g>"#
    );
    let (sketch, _) = read(&svg(&hidden)).unwrap();
    assert_eq!(sketch.strokes.len(), 1);
    assert_eq!(positions(&sketch.strokes[0])[1], vec2(0.0, 7.0));
}

#[test]
fn curves_are_as_smooth_in_millimetres_as_in_pixels() {
    let circle = r#"<path d="M 0 5 a 5 5 0 1 1 10 0 a 5 5 0 1 1 -10 0"/>"#;
    let at = |factor: f32| {
        let size = 10.0 * factor;
        let text = format!(r#"<svg width="{size}" height="{size}" viewBox="0 0 10 10">{circle}</svg>"#);
        let sketch = read(&text).unwrap().0;
        let radius_error = |p: Vec2| ((p / factor - vec2(5.0, 5.0)).length() - 5.0).abs();
        let worst = positions(&sketch.strokes[0]).into_iter().map(radius_error).fold(0.0, f32::max);
        assert!(worst < 1e-4, "{worst}");
        sketch.strokes[0].points.len()
    };
    let count = at(1.0);
    assert!((100..1000).contains(&count), "{count}");
    // Rounding may move a subdivision by one.
    assert!(at(1000.0).abs_diff(count) <= 2);
    assert!(at(0.001).abs_diff(count) <= 2);
}

#[test]
fn the_readable_part_of_a_damaged_path_is_kept_with_a_remark() {
    let (sketch, warnings) = read(&svg(r#"<path id="p1" d="M0 0 L10 10 L NaN 5"/>"#)).unwrap();
    assert_eq!(positions(&sketch.strokes[0]), [vec2(0.0, 0.0), vec2(10.0, 10.0)]);
    assert!(warnings[0].to_string().contains("`p1`: only its beginning was read"), "{warnings:?}");
}

#[test]
fn a_page_without_size_is_as_large_as_the_drawing() {
    let (sketch, _) = read(r#"<svg><line x1="5" x2="25" y2="10"/></svg>"#).unwrap();
    assert_eq!(sketch.canvas, Canvas { width: 20.0, height: 10.0 });
    let (sketch, _) = read(r#"<svg width="100%" viewBox="0 0 40 30"><line x2="2"/></svg>"#).unwrap();
    assert_eq!(sketch.canvas, Canvas { width: 40.0, height: 30.0 });
}

#[test]
fn copies_that_contain_themselves_end() {
    let text = svg(r##"<g id="a"><line x2="9"/><use href="#a"/></g><use href="#nothing"/>"##);
    let (sketch, warnings) = read(&text).unwrap();
    assert!(sketch.strokes.len() > 1);
    assert!(warnings.len() == 2, "{warnings:?}");
}

#[test]
fn icons_are_read_without_their_frames() {
    for (name, strokes) in ICONS {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/icons/{name}.svg"));
        let (sketch, warnings) = penstemon::sketch::read(&path).unwrap();
        assert_eq!(sketch.strokes.len(), strokes, "{name}");
        assert_eq!(warnings, [], "{name}");
        assert_eq!(sketch.canvas, Canvas { width: 24.0, height: 24.0 }, "{name}");
    }
}

#[test]
fn classes_copies_shapes_and_nested_transforms_of_design_programs() {
    let expected = [
        (Tool::Branch, [200.0, 160.0, 0.0, 120.0]),
        (Tool::Branch, [200.0, 180.0, 20.0, 60.0]),
        (Tool::Petal, [180.0, 100.0, 40.0, 40.0]),
        // 8 by 4 units, half as wide, a quarter turn, 20 units along the scaled x axis.
        (Tool::Petal, [192.0, 132.0, 16.0, 16.0]),
        (Tool::Auto, [318.0, 216.0, 64.0, 48.0]),
        (Tool::Auto, [30.0, 30.0, 20.0, 20.0]),
    ];
    assert_strokes(DESIGNER, [400.0, 300.0], &expected);
}

#[test]
fn circles_ellipses_and_rectangles_are_their_outlines() {
    let shapes = r#"<circle cx="50%" cy="20" r="10"/><ellipse cx="50" cy="50" rx="20"/>
        <rect x="10" y="20" width="30" height="40"/><rect width="20" height="10" rx="50"/>"#;
    let sketch = read_cleanly(&svg(shapes));
    assert_boxes(
        &sketch.strokes,
        &[
            [40.0, 10.0, 20.0, 20.0],
            [30.0, 30.0, 40.0, 40.0],
            [10.0, 20.0, 30.0, 40.0],
            [0.0, 0.0, 20.0, 10.0],
        ],
    );
    for (stroke, center, radius) in [(0, vec2(50.0, 20.0), 10.0), (1, vec2(50.0, 50.0), 20.0)] {
        let circle = positions(&sketch.strokes[stroke]);
        assert!(circle.iter().all(|p| (p.distance(center) - radius).abs() < 0.01), "stroke {stroke}");
        assert_eq!(circle.first(), circle.last());
        assert!(circle[0].distance(center + vec2(radius, 0.0)) < 1e-4, "SVG begins it on the right");
    }
    let corners = [(10.0, 20.0), (40.0, 20.0), (40.0, 60.0), (10.0, 60.0), (10.0, 20.0)];
    assert_eq!(positions(&sketch.strokes[2]), corners.map(|(x, y)| vec2(x, y)));
    let capsule = positions(&sketch.strokes[3]);
    assert!(capsule.iter().all(|p| ((p.x - 10.0) / 10.0).hypot((p.y - 5.0) / 5.0) > 0.99), "{capsule:?}");
}

#[test]
fn what_has_neither_stroke_nor_fill_is_not_drawn() {
    let none = [
        r#"stroke="none" fill="none""#,
        r#"style="fill:none""#,
        r#"class="clear""#,
        r#"fill="transparent" stroke="red" stroke-width="0""#,
        r#"fill-opacity="0""#,
        r#"opacity="0""#,
        r#"display="none""#,
        r#"style="visibility:hidden""#,
    ];
    let seen = [r#"fill="none" stroke="currentColor""#, r#"fill="url(#g)""#, r#"class="clear line""#, ""];
    let path = |attributes: &str| format!(r#"<path {attributes} d="M1 1L9 9L9 1"/>"#);
    let sheet = "<style>.clear{fill:none} .line{stroke:red}</style>";
    let text = svg(&format!("{sheet}{}{}", none.map(path).concat(), seen.map(path).concat()));
    let (sketch, warnings) = read(&text).unwrap();
    assert_eq!(sketch.strokes.len(), seen.len());
    assert_eq!(warnings, []);
    let inside = format!(r#"<g fill="none">{}<g stroke="red">{}</g></g>"#, path(""), path(""));
    assert_eq!(read(&svg(&inside)).unwrap().0.strokes.len(), 1);
    let message = read(&svg(&path(none[0]))).unwrap_err().to_string();
    assert!(message.contains("all 1 have neither stroke nor fill; give them a stroke"), "{message}");
}

#[test]
fn a_filled_rectangle_over_the_page_is_paper() {
    let line = r#"<line x2="9"/>"#;
    for paper in [r#"<rect width="100%" height="100%" fill="white"/>"#, r#"<path d="M0 0h100v100H0z"/>"#] {
        assert_eq!(read(&svg(&format!("{paper}{line}"))).unwrap().0.strokes.len(), 1, "{paper}");
    }
    for drawn in [
        r#"<rect width="100" height="100" stroke="red"/>"#,
        r#"<rect width="100" height="90"/>"#,
        r#"<path d="M0 0h100L50 50L100 100H0z"/>"#,
    ] {
        assert_eq!(read(&svg(&format!("{drawn}{line}"))).unwrap().0.strokes.len(), 2, "{drawn}");
    }
}

#[test]
fn an_inner_viewport_without_size_is_as_large_as_the_one_around() {
    let inner = r##"<svg viewBox="0 0 10 10"><line x2="10" y2="50%"/></svg>
        <symbol id="s" viewBox="0 0 50 50"><line x2="50" y2="5"/></symbol><use href="#s" width="50%"/>"##;
    let (sketch, _) = read(&svg(inner)).unwrap();
    assert_boxes(&sketch.strokes, &[[0.0, 0.0, 100.0, 50.0], [0.0, 25.0, 50.0, 5.0]]);
}
