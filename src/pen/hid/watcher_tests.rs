//! Tests of finding and losing devices, on a simulated bus.

use super::*;
use crate::pen::hid::made_up as tablets;
use crate::pen::hid::reader::Notice;
use crate::pen::hid::simulated::{SimulatedBus, SimulatedDevice};
use crate::pen::hid::{KnownStrings, StringsKept};

/// Longest that a test waits for another thread.
const PATIENCE_OF_TESTS: Duration = Duration::from_secs(60);

fn device(path: &str, descriptor: &[u8]) -> SimulatedDevice {
    SimulatedDevice::new(DeviceInfo { path: path.into(), ..Default::default() }, descriptor)
}

fn roster(bus: &SimulatedBus) -> (Roster, Inbox) {
    let (outbox, inbox) = queue(|| {}, Instant::now());
    (Roster::new(Box::new(bus.clone()), Box::new(choose_model), outbox), inbox)
}

fn wait(mut is_done: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !is_done() {
        assert!(begin.elapsed() < PATIENCE_OF_TESTS, "it never happened");
        std::thread::yield_now();
    }
}

/// Arrivals and goings in order.
fn comings(inbox: &Inbox) -> Vec<(DeviceId, bool)> {
    let mut all = Vec::new();
    inbox.drain(|message| match message.notice {
        Notice::Arrived(_) => all.push((message.device, true)),
        Notice::Gone(_) => all.push((message.device, false)),
        Notice::Said(_) | Notice::Refused(_) | Notice::Settled(_) => {}
    });
    all
}

#[test]
fn only_pens_are_opened() {
    let bus = SimulatedBus::new();
    let devices = [
        device("mouse", tablets::MOUSE),
        device("screen", tablets::TOUCH_SCREEN),
        device("broken", &[0xC0]),
        device("pen", tablets::PEN_DISPLAY),
        device("tablet", tablets::WACOM_PAGE),
    ];
    devices.iter().for_each(|device| bus.plug(device));
    let (mut roster, inbox) = roster(&bus);
    roster.poll().unwrap();
    roster.poll().unwrap();
    assert_eq!((roster.readers(), devices.each_ref().map(SimulatedDevice::handles)), (2, [0, 0, 0, 1, 1]));
    drop(roster);
    let mut comings = comings(&inbox);
    comings.sort();
    assert_eq!(comings, [(0, false), (0, true), (1, false), (1, true)]);
    assert!(devices.iter().all(|device| device.handles() == 0));
}

#[test]
fn a_device_comes_back_under_its_path() {
    let (bus, first, again) =
        (SimulatedBus::new(), device("a", tablets::PEN_DISPLAY), device("a", tablets::PEN_DISPLAY));
    bus.plug(&first);
    let (mut roster, inbox) = roster(&bus);
    roster.poll().unwrap();
    // Unplugged and plugged in again between two looks.
    bus.plug(&again);
    wait(|| {
        roster.poll().unwrap();
        again.handles() == 1
    });
    assert_eq!((first.handles(), roster.readers()), (0, 1));
    bus.unplug("a");
    wait(|| {
        roster.poll().unwrap();
        roster.readers() == 0
    });
    assert_eq!(comings(&inbox), [(0, true), (0, false), (1, true), (1, false)]);
}

#[test]
fn a_device_that_was_forbidden_is_read_once_it_is_allowed() {
    let (bus, tablet) = (SimulatedBus::new(), device("a", tablets::DESK_TABLET));
    bus.plug(&tablet);
    bus.forbid("a", true);
    let (mut roster, inbox) = roster(&bus);
    roster.poll().unwrap();
    roster.poll().unwrap();
    assert_eq!(roster.readers(), 0);
    bus.forbid("a", false);
    roster.poll().unwrap();
    assert_eq!((roster.readers(), tablet.handles()), (1, 1));
    let mut notices = Vec::new();
    inbox.drain(|message| match message.notice {
        Notice::Refused(refused) => notices.push(format!("refused {}", refused.device.path)),
        Notice::Settled(path) => notices.push(format!("settled {path}")),
        _ => {}
    });
    assert_eq!(notices, ["refused a", "settled a"], "each is said once");
}

/// A tablet whose numbers fit many models and whose strings nobody gives.
fn doubtful() -> SimulatedDevice {
    let info = DeviceInfo { path: "a".into(), vendor_id: 0x256C, product_id: 0x6D, ..Default::default() };
    SimulatedDevice::new(info, tablets::VENDOR_PAGE)
}

/// The models that the first refusal names, if one was said.
fn offered(inbox: &Inbox) -> Option<Vec<String>> {
    let mut models = None;
    inbox.drain(|message| {
        if let Notice::Refused(refused) = message.notice {
            models.get_or_insert(refused.why.models().to_vec());
        }
    });
    models
}

/// The ways in which devices that arrived are read, and paths of which nothing is refused any more.
fn ways(inbox: &Inbox) -> Vec<String> {
    let mut ways = Vec::new();
    inbox.drain(|message| match message.notice {
        Notice::Arrived(arrival) => ways.push(arrival.way.clone()),
        Notice::Settled(path) => ways.push(path.to_string()),
        _ => {}
    });
    ways
}

#[test]
fn a_chosen_model_is_read_at_once_and_another_in_its_place() {
    let (bus, tablet) = (SimulatedBus::new(), doubtful());
    bus.plug(&tablet);
    let (mut roster, inbox) = roster(&bus);
    roster.poll().unwrap();
    let models = offered(&inbox).expect("it is refused");
    assert!(models.len() > 1 && roster.readers() == 0, "{models:?}");
    let mut choose = |model: &str| {
        roster.set_models([(tablet.info().identity(), model.to_owned())].into());
        roster.poll().unwrap();
        wait(|| tablet.handles() == 1);
    };
    choose(&models[0]);
    let way = |model: &str| format!("the table, as {model}");
    let mut notices = Vec::new();
    wait(|| {
        notices.extend(ways(&inbox));
        notices.len() == 2
    });
    notices.sort();
    assert_eq!(notices, ["a".to_owned(), way(&models[0])]);
    choose(&models[1]);
    wait(|| ways(&inbox) == [way(&models[1])]);
    // Choosing for another device leaves this one alone.
    let handles = tablet.handles();
    roster.set_models([(tablet.info().identity(), models[1].clone()), ("other".into(), "x".into())].into());
    roster.poll().unwrap();
    assert_eq!((tablet.handles(), comings(&inbox)), (handles, vec![]));
    roster.set_models(Models::new());
    roster.poll().unwrap();
    assert_eq!(
        (tablet.handles(), offered(&inbox)),
        (0, Some(models)),
        "without a choice it is refused again"
    );
}

#[test]
fn a_device_is_woken_before_it_is_read() {
    let bus = SimulatedBus::new();
    // Genius i405x by its numbers.
    let info = DeviceInfo { path: "a".into(), vendor_id: 0x0458, product_id: 0x5010, ..Default::default() };
    let tablet = SimulatedDevice::new(info, tablets::SILENT_TABLET);
    bus.plug(&tablet);
    let (mut roster, inbox) = roster(&bus);
    roster.poll().unwrap();
    assert_eq!(tablet.written(), (vec![], vec![vec![0x05, 0x12, 0x10, 0x11, 0x12, 0, 0, 0]]));
    wait(|| comings(&inbox) == [(0, true)]);
}

#[test]
fn a_model_that_does_not_say_how_large_it_is_is_refused_once() {
    let bus = SimulatedBus::new();
    let info = DeviceInfo { path: "a".into(), vendor_id: 0x256C, product_id: 0xFFFF, ..Default::default() };
    let strings = [(201, crate::pen::hid::strings::descriptor("HUION_T999_300101"))].into();
    let strings = KnownStrings { strings, ..KnownStrings::none(StringsKept::Unanswered) };
    bus.plug(&SimulatedDevice::new(info, tablets::VENDOR_PAGE).with_strings(strings));
    let (mut roster, inbox) = roster(&bus);
    (0..5).for_each(|_| roster.poll().unwrap());
    let mut notices = Vec::new();
    inbox.drain(|message| notices.push(message.notice));
    let [Notice::Refused(refused)] = &notices[..] else { panic!("{notices:?}") };
    assert!(refused.to_string().contains("HUION_T999_300101"), "{refused}");
    assert_eq!(roster.readers(), 0);
}

#[test]
fn what_is_refused_for_good_is_not_asked_for_again_until_it_is_plugged_in_anew() {
    let (bus, tablet) = (SimulatedBus::new(), doubtful());
    bus.plug(&tablet);
    let (outbox, inbox) = queue(|| {}, Instant::now());
    let asked = Arc::new(std::sync::atomic::AtomicUsize::new(0));
    let counter = Arc::clone(&asked);
    let choose: Box<Choose> = Box::new(move |device, descriptor, strings, model| {
        counter.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        choose_model(device, descriptor, strings, model)
    });
    let mut roster = Roster::new(Box::new(bus.clone()), choose, outbox);
    (0..5).for_each(|_| roster.poll().unwrap());
    assert_eq!(asked.load(std::sync::atomic::Ordering::Relaxed), 1);
    bus.unplug("a");
    roster.poll().unwrap();
    assert_eq!(ways(&inbox), ["a"], "its refusal is taken back");
    bus.plug(&doubtful());
    roster.poll().unwrap();
    assert!(offered(&inbox).is_some() && asked.load(std::sync::atomic::Ordering::Relaxed) == 2);
}

#[test]
fn the_watcher_finds_what_is_plugged_in_and_ends() {
    let (bus, tablet) = (SimulatedBus::new(), device("a", tablets::PEN_DISPLAY));
    let watcher = Watcher::start(Box::new(bus.clone()), || {}, Instant::now()).unwrap();
    bus.plug(&tablet);
    wait(|| tablet.handles() == 1);
    wait(|| comings(watcher.inbox()) == [(0, true)]);
    drop(watcher);
    assert_eq!(tablet.handles(), 0);
}

/// Threads of this process that read the device `cycling`, as Linux lists them.
fn reading_threads() -> usize {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let names = tasks.filter_map(|task| std::fs::read_to_string(task.path().join("comm")).ok());
    names.filter(|name| name.trim() == "cycling").count()
}

#[test]
fn ten_thousand_times_plugged_in_and_out_leaves_nothing_behind() {
    const CYCLES: u32 = 10_000;
    let bus = SimulatedBus::new();
    let (mut roster, inbox) = roster(&bus);
    let mut notices = Vec::new();
    for cycle in 0..CYCLES {
        let tablet = device("cycling", tablets::DESK_TABLET);
        bus.plug(&tablet);
        roster.poll().unwrap();
        if cfg!(target_os = "linux") && cycle == 0 {
            wait(|| reading_threads() == 1);
        }
        bus.unplug("cycling");
        wait(|| {
            roster.poll().unwrap();
            roster.readers() == 0
        });
        assert_eq!(tablet.handles(), 0);
        notices.extend(comings(&inbox));
    }
    assert!(notices.into_iter().eq((0..CYCLES).flat_map(|id| [(id, true), (id, false)])));
    assert_eq!(roster.known.len(), 0);
    // Linux lists a thread for a moment after it was joined.
    wait(|| reading_threads() == 0);
}
