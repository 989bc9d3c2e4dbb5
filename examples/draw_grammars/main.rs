//! Draws inflorescences as simple pictures: stems as lines, florets as discs seen at their angle, bracts as strokes.
//!
//! Usage: `cargo run --example draw_grammars -- FOLDER [FILE.lsys …]` writes an SVG for every built-in inflorescence, or for
//! every file: from the front as it comes into flower, from the side and from above, each fitted to its cell; and
//! `inflorescences.svg` with all of them. `rsvg-convert` makes pictures of them.

use penstemon::geom::convex_hull::convex_hull;
use penstemon::grammar::{Figure, Grammar, Item, Settings, library};
use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use glam::{Vec2, Vec3};

/// Width and height of a view.
const CELL: Vec2 = Vec2::new(360.0, 480.0);
/// Width and height of the five views of a grammar.
const ROW: Vec2 = Vec2::new(5.0 * CELL.x, CELL.y);
/// Share of a cell that the figure fills.
const FILL: f32 = 0.9;
/// Corners of a disc.
const CORNERS: usize = 24;

/// From where a figure is seen.
#[derive(Clone, Copy)]
enum View {
    Front,
    Side,
    Top,
}

impl View {
    /// To the right, down and away from the viewer.
    fn of(self, p: Vec3) -> Vec3 {
        match self {
            Self::Front => Vec3::new(p.x, -p.y, -p.z),
            Self::Side => Vec3::new(-p.z, -p.y, -p.x),
            Self::Top => Vec3::new(p.x, p.z, -p.y),
        }
    }
}

/// Something to paint: how far away, and its element.
struct Piece {
    depth: f32,
    element: String,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("usage: draw_grammars FOLDER [FILE.lsys …]")?;
    fs::create_dir_all(&folder)?;
    let mut texts: Vec<(String, String)> = Vec::new();
    for file in arguments {
        let name = Path::new(&file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        texts.push((name, fs::read_to_string(&file)?));
    }
    if texts.is_empty() {
        for name in library::names() {
            texts.push((name.to_owned(), library::text(name)?.to_owned()));
        }
    }
    let mut all = String::new();
    for (k, (name, text)) in texts.iter().enumerate() {
        let row = row(&Grammar::parse(text).map_err(|error| format!("{name}: {error}"))?)?;
        fs::write(Path::new(&folder).join(format!("{name}.svg")), svg(ROW, &row))?;
        let place = ROW * Vec2::new((k % 2) as f32, (k / 2) as f32);
        let name = name.replace('_', " ");
        writeln!(all, "<g transform=\"translate({} {})\">", place.x, place.y)?;
        writeln!(
            all,
            "{row}<text x=\"20\" y=\"40\" font-size=\"30\" font-family=\"sans-serif\">{name}</text></g>"
        )?;
    }
    let size = ROW * Vec2::new(2.0, texts.len().div_ceil(2) as f32);
    fs::write(Path::new(&folder).join("inflorescences.svg"), svg(size, &all))?;
    Ok(())
}

fn svg(size: Vec2, inside: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{inside}</svg>\n",
        size.x, size.y
    )
}

/// The views of one grammar side by side.
fn row(grammar: &Grammar) -> Result<String, Box<dyn Error>> {
    let has_bloom = grammar.constants().iter().any(|constant| constant.name == "bloom");
    let at = |bloom: f64| {
        let constants: &[_] = if has_bloom { &[("bloom", bloom)] } else { &[] };
        grammar.draw(&Settings { seed: 1, constants, ..Settings::default() })
    };
    let middle = at(0.6)?;
    let views = [
        (at(0.0)?, View::Front),
        (at(0.4)?, View::Front),
        (middle.clone(), View::Side),
        (at(1.0)?, View::Front),
        (middle, View::Top),
    ];
    let mut row = String::new();
    for (column, (figure, view)) in views.iter().enumerate() {
        writeln!(row, "<g transform=\"translate({} 0)\">", CELL.x * column as f32)?;
        row.push_str(&picture(figure, *view)?);
        row.push_str("</g>\n");
    }
    Ok(row)
}

/// How far out an item is painted, metres.
fn reach(item: &Item) -> f32 {
    item.args.last().map_or(0.0, |size| size * item.scale)
}

fn picture(figure: &Figure, view: View) -> Result<String, std::fmt::Error> {
    let (mut low, mut high) = (Vec2::MAX, Vec2::MIN);
    let mut include = |p: Vec3| {
        let p = view.of(p).truncate();
        (low, high) = (low.min(p), high.max(p));
    };
    // Long stalks would make the rest small: of those only the end is shown.
    let crown = figure.items.iter().map(|item| item.origin.y).fold(f32::MAX, f32::min) - 0.02;
    figure.stems.iter().flat_map(|stem| &stem.points).filter(|p| p.y > crown).for_each(|p| include(*p));
    for item in &figure.items {
        include(item.origin + item.heading * reach(item));
        include(item.origin - item.left * reach(item));
        include(item.origin + item.left * reach(item));
    }
    let scale = FILL * (CELL / (high - low).max(Vec2::splat(1e-6))).min_element();
    let place = |p: Vec3| (view.of(p).truncate() - 0.5 * (low + high)) * scale + 0.5 * CELL;
    let mut pieces = Vec::new();
    for stem in &figure.stems {
        for (k, ends) in stem.points.windows(2).enumerate() {
            let (a, b, width) = (place(ends[0]), place(ends[1]), (2.0 * stem.radii[k] * scale).max(0.6));
            let element = format!(
                "<path d=\"M{:.2} {:.2}L{:.2} {:.2}\" stroke=\"#4a7a2a\" stroke-width=\"{width:.2}\" \
                 stroke-linecap=\"round\"/>\n",
                a.x, a.y, b.x, b.y
            );
            pieces.push(Piece { depth: view.of(0.5 * (ends[0] + ends[1])).z, element });
        }
    }
    for item in &figure.items {
        pieces.push(Piece { depth: view.of(item.origin).z, element: item_element(item, &place)? });
    }
    pieces.sort_by(|a, b| b.depth.total_cmp(&a.depth));
    let clip = format!("<svg width=\"{}\" height=\"{}\">\n", CELL.x, CELL.y);
    Ok(pieces.iter().fold(clip, |svg, piece| svg + &piece.element) + "</svg>\n")
}

fn item_element(item: &Item, place: &impl Fn(Vec3) -> Vec2) -> Result<String, std::fmt::Error> {
    let (open, reach) = (item.args.first().copied().unwrap_or_default(), reach(item));
    let tip = item.origin + item.heading * reach;
    let ring = |ahead: f32, out: f32| {
        (0..CORNERS).map(move |k| {
            let (sin, cos) = (k as f32 / CORNERS as f32 * std::f32::consts::TAU).sin_cos();
            place(item.origin + item.heading * ahead + (item.left * cos + item.up * sin) * out)
        })
    };
    match &*item.name {
        "bract" | "ray" => {
            let side = item.left * (0.16 * reach);
            let corners =
                [item.origin, item.origin.lerp(tip, 0.5) + side, tip, item.origin.lerp(tip, 0.5) - side];
            path(corners.map(place).into_iter(), if &*item.name == "ray" { "#f0c020" } else { "#8ab060" })
        }
        "receptacle" => {
            let corners: Vec<Vec2> = ring(0.0, item.args[0] * item.scale).chain([place(tip)]).collect();
            path(convex_hull(&corners, |p| *p).into_iter(), "#a08040")
        }
        _ => {
            // A bud is a narrow cup, an open floret a wide one: its outside is the hull of rim and foot.
            let (out, ahead) = (reach * (0.25 + 0.75 * open), reach * 0.8 * (1.0 - 0.7 * open));
            let corners: Vec<Vec2> = ring(ahead, out).chain([place(item.origin)]).collect();
            let mix = |bud: f32, flower: f32| (bud + (flower - bud) * open) as u8;
            let outside = format!("rgb({},{},{})", mix(120.0, 190.0), mix(160.0, 80.0), mix(80.0, 150.0));
            let inside = format!("rgb({},{},{})", mix(150.0, 235.0), mix(185.0, 130.0), mix(110.0, 195.0));
            Ok(path(convex_hull(&corners, |p| *p).into_iter(), &outside)? + &path(ring(ahead, out), &inside)?)
        }
    }
}

fn path(corners: impl Iterator<Item = Vec2>, fill: &str) -> Result<String, std::fmt::Error> {
    let mut d = String::new();
    for (k, corner) in corners.enumerate() {
        write!(d, "{}{:.2} {:.2}", if k == 0 { 'M' } else { 'L' }, corner.x, corner.y)?;
    }
    Ok(format!("<path d=\"{d}Z\" fill=\"{fill}\" stroke=\"#503050\" stroke-width=\"0.4\"/>\n"))
}
