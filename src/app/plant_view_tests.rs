//! The camera, clicks and rest of the view of the plant.

use super::*;

const BOX: (Vec3, Vec3) = (Vec3::new(-0.2, 0.0, -0.2), Vec3::new(0.2, 1.0, 0.2));

#[test]
fn the_camera_follows_the_plant_until_the_artist_takes_hold() {
    let mut view = PlantView::default();
    view.set_bounds(Some(BOX));
    let small = view.camera();
    view.set_bounds(Some((BOX.0, BOX.1 * 3.0)));
    assert!(view.camera().distance > small.distance);
    view.take_hold();
    let held = view.camera();
    view.set_bounds(Some(BOX));
    assert_eq!(view.camera(), held);
}

#[test]
fn a_single_click_picks_once_and_a_double_click_does_not() {
    let mut view = PlantView { height: 200.0, middle: egui::pos2(100.0, 100.0), ..PlantView::default() };
    view.set_bounds(Some(BOX));
    let at = DVec2::new(150.0, 50.0);
    view.tap(at, false);
    assert_eq!(view.take_click(), None, "a second click may follow");
    let (click, _) = view.click.unwrap();
    assert_eq!((click.at, click.besides), (Vec2::new(0.25, -0.25), false));
    view.click = Some((click, Instant::now() - DOUBLE_CLICK));
    assert_eq!((view.take_click(), view.take_click()), (Some(click), None));
    view.tap(at, false);
    view.tap(at, false);
    assert!(view.click.is_none() && view.flight.is_some());
}

#[test]
fn a_plant_that_grows_from_its_beginning_leaves_the_camera_where_it_is() {
    let mut view = PlantView::default();
    view.set_bounds(Some(BOX));
    let whole = view.camera();
    view.keeps_room = true;
    view.set_bounds(Some((BOX.0, BOX.1 * 0.2)));
    assert_eq!(view.camera(), whole);
    view.set_bounds(None);
    assert_eq!(view.camera(), whole);
    view.keeps_room = false;
    view.set_bounds(Some((BOX.0, BOX.1 * 0.2)));
    assert!(view.camera().distance < whole.distance);
}

#[test]
fn a_flight_to_a_plant_that_is_gone_ends() {
    let mut view = PlantView::default();
    view.set_bounds(Some(BOX));
    view.show_front();
    assert!(view.is_moving());
    view.set_bounds(None);
    assert!(!view.is_moving());
}

#[test]
fn drafts_while_moving_and_a_finished_picture_at_rest() {
    let mut view = PlantView::default();
    view.set_bounds(Some(BOX));
    assert_eq!(view.look(egui::Theme::Light).quality, Quality::Draft);
    view.moved = Some(Instant::now() - REST);
    assert_eq!(view.look(egui::Theme::Light).quality, Quality::Full);
    assert_eq!(view.wakes_at(), None);
}
