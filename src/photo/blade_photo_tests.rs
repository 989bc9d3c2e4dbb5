//! Tests of petals and leaves from photographs that the tests paint themselves.

use super::*;
use crate::geom::polyline;

/// A photograph of what covers a share of every pixel, in two colours; both may depend on the place.
fn photograph(
    (width, height): (u32, u32),
    share: impl Fn(Vec2) -> bool,
    petal: impl Fn(Vec2) -> [f32; 3],
    ground: impl Fn(Vec2) -> [f32; 3],
) -> Rgba {
    let mut state = 99u32;
    let mut pixels = Vec::new();
    for i in 0..width * height {
        let corner = Vec2::new((i % width) as f32, (i / width) as f32);
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|c| share(corner + Vec2::from(c)));
        let looks = (0..64).map(|k| corner + (Vec2::new((k % 8) as f32, (k / 8) as f32) + 0.5) / 8.0);
        let covered = match corners {
            [true, true, true, true] => 1.0,
            [false, false, false, false] => 0.0,
            _ => looks.filter(|at| share(*at)).count() as f32 / 64.0,
        };
        let (a, b) = (petal(corner + 0.5), ground(corner + 0.5));
        for c in 0..3 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let noise = 6.0 * ((state >> 8) as f32 / (1 << 24) as f32 - 0.5);
            pixels.push((a[c] * covered + b[c] * (1.0 - covered) + noise).round().clamp(0.0, 255.0) as u8);
        }
        pixels.push(255);
    }
    Rgba { width, height, pixels }
}

const PINK: [f32; 3] = [214.0, 90.0, 140.0];
const PAPER: [f32; 3] = [225.0, 222.0, 214.0];

fn disc(middle: Vec2, radius: f32) -> impl Fn(Vec2) -> bool {
    move |at| at.distance(middle) < radius
}

/// A heart with its point below, turned clockwise about its middle: its outline, finely.
fn notched(middle: Vec2, size: f32, deg: f32) -> Vec<Vec2> {
    let turn = Vec2::from_angle(deg.to_radians());
    (0..720)
        .map(|k| k as f32 * std::f32::consts::TAU / 720.0)
        .map(|t| {
            let y = 13.0 * t.cos() - 5.0 * (2.0 * t).cos() - 2.0 * (3.0 * t).cos() - (4.0 * t).cos();
            middle + turn.rotate(Vec2::new(16.0 * t.sin().powi(3), -y) * size / 34.0)
        })
        .collect()
}

fn within(line: Vec<Vec2>) -> impl Fn(Vec2) -> bool {
    move |at| {
        let crosses = |(a, b): (&Vec2, &Vec2)| {
            (a.y > at.y) != (b.y > at.y) && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y)
        };
        line.iter().zip(line.iter().cycle().skip(1)).filter(|pair| crosses(*pair)).count() % 2 == 1
    }
}

/// The contour alone, before it is simplified.
fn contour_of(picture: &Rgba) -> Vec<Vec2> {
    let lab = lab_of(picture);
    cut_out(picture, &lab, &CutoutParams::default(), &mut Vec::new()).unwrap().contour
}

#[test]
fn contours_of_discs_are_within_half_a_pixel() {
    for (middle, radius) in [((100.3, 90.8), 60.0), ((80.0, 80.0), 25.5), ((101.7, 99.1), 80.2)] {
        let middle = Vec2::from(middle);
        for shadow in [0.0, 70.0] {
            // A ground that the light leaves to one side, and a soft shadow beside the petal.
            let ground = |at: Vec2| {
                let near = (1.0 - (at.distance(middle + 6.0) - radius).max(0.0) / 12.0).clamp(0.0, 1.0);
                PAPER.map(|c| c - 0.08 * at.x - shadow * near)
            };
            let picture = photograph((200, 190), disc(middle, radius), |_| PINK, ground);
            let contour = contour_of(&picture);
            let off = contour.iter().map(|p| (p.distance(middle) - radius).abs()).fold(0.0, f32::max);
            assert!(off <= 0.5, "{off} pixels for radius {radius} with shadow {shadow}");
        }
    }
}

#[test]
fn contours_of_notched_petals_are_within_half_a_pixel() {
    for deg in [0.0, 33.0] {
        let line = notched(Vec2::new(150.2, 140.7), 200.0, deg);
        // Lighter toward its lobes.
        let petal = |at: Vec2| PINK.map(|c| c + 0.12 * (150.0 - at.y));
        let picture = photograph((300, 290), within(line.clone()), petal, |_| PAPER);
        let contour = contour_of(&picture);

        let closed = |line: &[Vec2]| line.iter().chain(line.first()).copied().collect::<Vec<_>>();
        let off = |from: &[Vec2], to: &[Vec2]| {
            let to = closed(to);
            from.iter().filter_map(|p| polyline::nearest(&to, *p)).map(|(d, _)| d).fold(0.0, f32::max)
        };
        // Point and notch are cusps: for two pixels they are half a pixel wide, and end where they are none.
        let beyond = |line_of: &[Vec2], reach: f32| -> Vec<Vec2> {
            let is_blunt = |p: &&Vec2| p.distance(line[0]).min(p.distance(line[360])) > reach;
            line_of.iter().filter(is_blunt).copied().collect()
        };
        let sharp = off(&beyond(&contour, 3.0), &line);
        assert!(sharp <= 0.5, "{deg}: {sharp}");
        let blunt = beyond(&line, 12.0);
        assert!(off(&blunt, &contour) <= 0.5, "{deg}: {}", off(&blunt, &contour));
    }
}

#[test]
fn a_crooked_petal_stands_upright_with_its_colours() {
    for deg in [-30.0, 0.0, 40.0] {
        let (middle, turn) = (Vec2::new(160.0, 150.0), Vec2::from_angle(f32::to_radians(deg)));
        // Red on its right, blue on its left, green above.
        let petal = |at: Vec2| {
            let own = Vec2::new(turn.x, -turn.y).rotate(at - middle);
            [if own.x > 0.0 { 230.0 } else { 60.0 }, if own.y < -20.0 { 200.0 } else { 40.0 }, 120.0]
        };
        let picture = photograph((320, 300), within(notched(middle, 210.0, deg)), petal, |_| PAPER);
        let mut params = PhotoParams::default();
        params.clean.contrast = 0.0;
        let photo = BladePhoto::of_photograph(&picture, None, &params).unwrap();
        assert_eq!(photo.template.check_invariants(), Ok(()));
        assert_eq!(photo.remarks, []);
        let up = photo.tip - photo.base;
        let known = turn.rotate(Vec2::NEG_Y);
        assert!(up.normalize().dot(known) > 0.9995, "{deg}: {up}");
        let Rgba { width, height, pixels } = &photo.texture;
        let at = |u: f32, v: f32| {
            let (x, y) = ((u * *width as f32) as usize, ((1.0 - v) * *height as f32) as usize);
            &pixels[4 * (y * *width as usize + x)..][..3]
        };
        assert!(at(0.75, 0.8)[0] > 200 && at(0.75, 0.8)[1] > 170, "{:?}", at(0.75, 0.8));
        assert!(at(0.25, 0.8)[0] < 90 && at(0.25, 0.8)[1] > 170, "{:?}", at(0.25, 0.8));
        assert!(at(0.6, 0.3)[0] > 200 && at(0.6, 0.3)[1] < 70, "{:?}", at(0.6, 0.3));
    }
}

#[test]
fn what_is_painted_on_the_petal_is_where_the_uv_looks() {
    let middle = Vec2::new(170.0, 160.0);
    // Colours are places.
    let petal = |at: Vec2| [40.0 + 0.5 * at.x, 40.0 + 0.5 * at.y, 30.0];
    let picture =
        photograph((340, 320), within(notched(middle, 240.0, 15.0)), petal, |_| [250.0, 250.0, 250.0]);
    let mut params = PhotoParams::default();
    (params.clean.contrast, params.clean.creases) = (0.0, false);
    let photo = BladePhoto::of_photograph(&picture, None, &params).unwrap();
    let pose = Pose::new(photo.base, photo.tip, false);
    let texture = &photo.texture;
    let (mut looked, mut sum) = (0, Vec2::ZERO);
    for k in 0..400 {
        let uv = Vec2::new((k % 20) as f32 + 0.5, (k / 20) as f32 + 0.5) / 20.0;
        let place = pose.place(photo.uv.point(uv));
        let is_well_inside = (0..8)
            .all(|k| within(notched(middle, 240.0, 15.0))(place + 9.0 * Vec2::from_angle(k as f32 * 0.785)));
        if !is_well_inside {
            continue;
        }
        looked += 1;
        let (x, y) = (uv.x * texture.width as f32, (1.0 - uv.y) * texture.height as f32);
        let pixel = 4 * (y as usize * texture.width as usize + x as usize);
        let [r, g] = [0, 1].map(|c| f32::from(texture.pixels[pixel + c]));
        let seen = Vec2::new(r - 40.0, g - 40.0) / 0.5;
        // The photograph's noise is up to six pixels large.
        assert!(seen.distance(place) < 10.0, "{seen} instead of {place}");
        sum += seen - place;
    }
    let mean = sum / looked as f32;
    assert!(looked > 100 && mean.length() < 0.7, "{mean} of {looked}");
}

#[test]
fn around_the_petal_its_own_colour_goes_on() {
    let picture = photograph((200, 200), disc(Vec2::splat(100.0), 70.0), |_| PINK, |_| [20.0, 30.0, 25.0]);
    let photo = BladePhoto::of_photograph(&picture, None, &PhotoParams::default()).unwrap();
    for [r, g, b, a] in photo.texture.pixels.as_chunks::<4>().0 {
        let off = [(r, PINK[0]), (g, PINK[1]), (b, PINK[2])].map(|(c, own)| (f32::from(*c) - own).abs());
        assert!(off.iter().all(|off| *off < 26.0) && *a == 255, "{r} {g} {b}: no background anywhere");
    }
}

#[test]
fn alpha_says_what_is_there() {
    let line = notched(Vec2::splat(100.0), 150.0, 0.0);
    let is_in = within(line.clone());
    let mut picture = photograph((200, 200), within(line), |_| PINK, |_| PINK);
    for (i, pixel) in picture.pixels.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        let at = Vec2::new((i % 200) as f32 + 0.5, (i / 200) as f32 + 0.5);
        pixel[3] = if is_in(at) { 255 } else { 0 };
    }
    let photo = BladePhoto::of_photograph(&picture, None, &PhotoParams::default()).unwrap();
    assert!(photo.base.distance(Vec2::new(100.0, 175.0)) < 4.0, "{}", photo.base);
}

#[test]
fn ends_that_the_artist_gives_are_taken() {
    let picture = photograph((200, 200), disc(Vec2::splat(100.0), 70.0), |_| PINK, |_| PAPER);
    let given = [Vec2::new(30.0, 100.0), Vec2::new(171.0, 99.0)];
    let photo = BladePhoto::of_photograph(&picture, Some(given), &PhotoParams::default()).unwrap();
    assert!(photo.base.distance(given[0]) < 3.0 && photo.tip.distance(given[1]) < 3.0);
    let outside = [Vec2::splat(-1.0), given[1]];
    let refused = BladePhoto::of_photograph(&picture, Some(outside), &PhotoParams::default());
    assert_eq!(refused, Err(PhotoError::BadEnds { width: 200, height: 200 }));
    // The message names the photograph as it was given, however small the one is that is worked on.
    let mut small = PhotoParams::default();
    small.cutout.side = 100;
    let refused = BladePhoto::of_photograph(&picture, Some(outside), &small);
    assert_eq!(refused, Err(PhotoError::BadEnds { width: 200, height: 200 }));
}

#[test]
fn what_cannot_be_used_says_why() {
    let params = PhotoParams::default();
    let refused = |picture: &Rgba| BladePhoto::of_photograph(picture, None, &params).unwrap_err();
    let dot = Rgba { width: 1, height: 1, pixels: vec![9, 9, 9, 255] };
    assert!(matches!(refused(&dot), PhotoError::TooSmall { width: 1, height: 1, .. }));
    let line = Rgba { width: 20_000, height: 17, pixels: vec![200; 4 * 20_000 * 17] };
    assert!(matches!(refused(&line), PhotoError::TooSmall { height: 17, .. }));
    let plain = photograph((120, 120), |_| false, |_| PINK, |_| PAPER);
    assert!(matches!(refused(&plain), PhotoError::OneColour { .. }), "{:?}", refused(&plain));
    let near = photograph((120, 120), disc(Vec2::new(60.0, 130.0), 70.0), |_| PINK, |_| PAPER);
    assert!(matches!(refused(&near), PhotoError::CutOff { .. }), "{:?}", refused(&near));
    let speck = photograph((400, 400), disc(Vec2::splat(200.0), 3.0), |_| PINK, |_| PAPER);
    assert!(matches!(refused(&speck), PhotoError::NothingThere), "{:?}", refused(&speck));
    let clear = Rgba { width: 50, height: 50, pixels: vec![0; 10_000] };
    assert_eq!(refused(&clear), PhotoError::NothingThere);
}

#[test]
fn of_two_petals_the_larger_is_taken_and_a_cut_stalk_is_said() {
    let two = |at: Vec2| disc(Vec2::new(70.0, 100.0), 50.0)(at) || disc(Vec2::new(170.0, 60.0), 35.0)(at);
    let picture = photograph((220, 180), two, |_| PINK, |_| PAPER);
    let photo = BladePhoto::of_photograph(&picture, None, &PhotoParams::default()).unwrap();
    assert_eq!(photo.remarks, [PhotoRemark::Several { count: 2 }]);
    assert!(photo.outline.iter().all(|p| p.x < 125.0));
    let stalk = |at: Vec2| disc(Vec2::splat(90.0), 60.0)(at) || (at.x - 90.0).abs() < 4.0 && at.y > 90.0;
    let picture = photograph((180, 180), stalk, |_| PINK, |_| PAPER);
    let photo = BladePhoto::of_photograph(&picture, None, &PhotoParams::default()).unwrap();
    assert_eq!(photo.remarks, [PhotoRemark::TouchesEdge]);
    assert!(photo.base.y > 175.0 && photo.tip.y < 35.0, "{} {}", photo.base, photo.tip);
}

#[test]
fn a_traced_outline_takes_what_lies_under_it() {
    let petal = |at: Vec2| [40.0 + 0.8 * at.x, 40.0 + 0.8 * at.y, 30.0];
    let picture = photograph((200, 200), disc(Vec2::splat(100.0), 80.0), petal, |_| PAPER);
    let outline = notched(Vec2::splat(100.0), 100.0, 0.0);
    let (base, tip) = (Vec2::new(100.0, 150.0), Vec2::new(100.0, 85.0));
    let mut params = PhotoParams::default();
    (params.clean.contrast, params.clean.creases) = (0.0, false);
    let take = |from_behind: bool| {
        let traced = Traced { outline: &outline, base, tip, from_behind };
        BladePhoto::under_outline(&picture, &traced, &params).unwrap()
    };
    let (front, back) = (take(false), take(true));
    let red = |photo: &BladePhoto, u: f32| {
        let (w, h) = (photo.texture.width as usize, photo.texture.height as usize);
        photo.texture.pixels[4 * (h / 2 * w + (u * w as f32) as usize)]
    };
    assert!(red(&front, 0.7) > red(&front, 0.3) + 20 && red(&back, 0.3) > red(&back, 0.7) + 20);
    let far: Vec<Vec2> = outline.iter().map(|p| *p + 500.0).collect();
    let beside = Traced { outline: &far, base: base + 500.0, tip: tip + 500.0, from_behind: false };
    assert_eq!(BladePhoto::under_outline(&picture, &beside, &params), Err(PhotoError::BesidePicture));
    let half: Vec<Vec2> = outline.iter().map(|p| *p + Vec2::X * 100.0).collect();
    let half = Traced {
        outline: &half,
        base: base + Vec2::X * 100.0,
        tip: tip + Vec2::X * 100.0,
        from_behind: false,
    };
    let half = BladePhoto::under_outline(&picture, &half, &params).unwrap();
    assert!(
        matches!(half.remarks[..], [PhotoRemark::PartlyBeside { share }] if (40.0..60.0).contains(&share))
    );
    let flat = Traced { outline: &[base, tip, base], base, tip, from_behind: false };
    assert_eq!(BladePhoto::under_outline(&picture, &flat, &params), Err(PhotoError::NoOutline));
}

#[test]
fn the_same_photograph_gives_the_same_bytes_and_a_larger_one_the_same_petal() {
    let at = |scale: f32| {
        let line = notched(Vec2::splat(100.0) * scale, 150.0 * scale, 20.0);
        photograph(((200.0 * scale) as u32, (200.0 * scale) as u32), within(line), |_| PINK, |_| PAPER)
    };
    let picture = at(1.0);
    let photo =
        |picture: &Rgba, params: &PhotoParams| BladePhoto::of_photograph(picture, None, params).unwrap();
    let first = photo(&picture, &PhotoParams::default());
    assert_eq!(first, photo(&picture, &PhotoParams::default()));
    let mut params = PhotoParams::default();
    params.cutout.side = 200;
    let larger = photo(&at(2.0), &params);
    assert!((larger.base / 2.0).distance(first.base) < 2.0 && (larger.tip / 2.0).distance(first.tip) < 2.0);
}
