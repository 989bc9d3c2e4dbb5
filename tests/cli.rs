//! The program as a user meets it: exit codes, messages, files.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn penstemon(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_penstemon")).args(args).output().unwrap()
}

fn sketch(name: &str) -> String {
    format!("{}/assets/sketches/{name}.penstemon", env!("CARGO_MANIFEST_DIR"))
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Runs and expects exit code 1 and one message that holds every given piece.
fn refused(args: &[&str], pieces: &[&str]) {
    let output = penstemon(args);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    for piece in pieces {
        assert!(message.contains(piece), "`{piece}` is not in: {message}");
    }
    assert!(!message.contains("panicked"), "{message}");
    assert_eq!(
        message.trim_end().lines().filter(|line| line.starts_with("penstemon:")).count(),
        1,
        "{message}"
    );
}

fn written(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    files
}

#[test]
fn build_writes_every_format_and_check_finds_them_clean() {
    let folder = tempfile::tempdir().unwrap();
    let out = |ext: &str| folder.path().join(format!("daisy.{ext}")).display().to_string();
    let (glb, obj, json) = (out("glb"), out("obj"), out("json"));
    let built = penstemon(&["build", &sketch("daisy"), "-o", &glb, "-o", &obj, "-o", &json, "--stats"]);
    assert!(built.status.success(), "{}", stderr(&built));
    let stats: serde_json::Value = serde_json::from_slice(&built.stdout).unwrap();
    assert!(stats["triangles"].as_u64().unwrap() > 1000);
    assert!(stats["total_ms"].as_f64().unwrap() > 0.0);
    let bytes: u64 = written(folder.path()).iter().map(|f| fs::metadata(f).unwrap().len()).sum();
    assert_eq!(stats["bytes"].as_u64(), Some(bytes));
    for model in [&glb, &obj] {
        let checked = penstemon(&["check", model]);
        assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stdout));
    }
    let plant: serde_json::Value = serde_json::from_slice(&fs::read(&json).unwrap()).unwrap();
    assert!(plant["world_from_canvas"]["scale"].as_f64().unwrap() > 0.0);
    assert_eq!(plant["world_from_canvas"]["origin"].as_array().unwrap().len(), 2);
    assert!(plant["branches"][0]["points"][0].as_array().unwrap().len() == 3);
    assert!(plant["branches"][0]["radii"].as_array().is_some() && plant["organs"].as_array().is_some());
    // Every blade names a template, and every template is named.
    let templates = plant["templates"].as_array().unwrap();
    let blades = plant["organs"].as_array().unwrap().iter().map(|organ| &organ["shape"]["blade"]);
    let named: BTreeSet<u64> = blades.filter_map(|blade| blade["template"].as_u64()).collect();
    assert_eq!(named, (0..templates.len() as u64).collect());
    assert!(templates.iter().all(|template| template["outline"].as_array().unwrap().len() >= 3));
}

#[test]
fn the_same_sketch_gives_the_same_bytes_and_another_seed_others() {
    let folder = tempfile::tempdir().unwrap();
    let build = |name: &str, seed: &str| {
        let out = folder.path().join(name);
        let args = ["build", &sketch("jasmine"), "--seed", seed, "-o", &out.display().to_string()];
        assert!(penstemon(&args).status.success());
        fs::read(out).unwrap()
    };
    let first = build("a.glb", "5");
    assert!(first == build("b.glb", "5"));
    assert!(first != build("c.glb", "6"));
}

#[test]
fn inspect_prints_the_promised_fields() {
    let output = penstemon(&["inspect", &sketch("daisy")]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let stroke = &report["strokes"][0];
    for field in ["id", "part", "flower", "parent", "level", "root", "tip", "confidence"] {
        assert!(stroke.get(field).is_some(), "{field}");
    }
    let flower = &report["flowers"][0];
    for field in ["petals", "center", "axis", "opening_deg", "cone_height"] {
        assert!(flower.get(field).is_some(), "{field}");
    }
    assert!(report["generated"]["branches"].is_u64() && report["generated"]["leaves"].is_u64());
}

#[test]
fn a_drawing_with_a_grown_plant_beside_it_is_built_and_inspected() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let plants = r#""version": 3, "plants": [
        {"maker": "growth", "species": "hazel", "age": 2, "foot": [700, 900], "height": 300},
        {"maker": "growth", "species": "hazle", "foot": [100, 900]}],"#;
    let drawing = fs::read_to_string(sketch("daisy")).unwrap().replace("\"version\": 1,", plants);
    fs::write(file("a.penstemon"), drawing).unwrap();
    let done = penstemon(&["build", &file("a.penstemon"), "-o", &file("a.glb"), "-o", &file("a.json")]);
    assert!(done.status.success(), "{}", stderr(&done));
    assert!(stderr(&done).contains("plant 2 (`hazle`)"), "{}", stderr(&done));
    assert!(penstemon(&["check", &file("a.glb")]).status.success());
    let report = penstemon(&["inspect", &file("a.penstemon")]);
    let report: serde_json::Value = serde_json::from_slice(&report.stdout).unwrap();
    assert_eq!(report["plants"][0]["maker"], "growth");
    assert_eq!(report["plants"][1]["species"], "hazle");
}

#[test]
fn parameters_reach_the_plant_and_wrong_ones_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("tall.json").display().to_string();
    let set = |assignment: &str| penstemon(&["build", &sketch("daisy"), "-o", &out, "--set", assignment]);
    assert!(set("depth.world.height=3").status.success());
    let plant: serde_json::Value = serde_json::from_slice(&fs::read(&out).unwrap()).unwrap();
    let tops = plant["branches"].as_array().unwrap().iter().flat_map(|b| b["points"].as_array().unwrap());
    let top = tops.map(|p| p[1].as_f64().unwrap()).fold(0.0, f64::max);
    assert!((1.0..3.5).contains(&top), "{top}");
    refused(
        &["build", &sketch("daisy"), "-o", &out, "--set", "depth.world.hieght=3"],
        &["--set", "did you mean"],
    );
    refused(&["build", &sketch("daisy"), "-o", &out, "--set", "depth.world.height=-1"], &["outside"]);
}

#[test]
fn bad_input_is_one_clear_message() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let out = folder.path().join("never.glb").display().to_string();
    refused(&["build", "/nowhere/drawing.penstemon", "-o", &out], &["/nowhere/drawing.penstemon"]);
    let empty = file("empty.penstemon", r#"{"format":"penstemon-sketch","version":1,"strokes":[]}"#);
    refused(&["build", &empty, "-o", &out], &["empty.penstemon", "stroke"]);
    let cut = file("cut.penstemon", r#"{"format":"penstemon-sketch","version":1,"strokes":[{"id":1,"po"#);
    refused(&["build", &cut, "-o", &out], &["cut.penstemon"]);
    let specks = r#"{"format":"penstemon-sketch","version":1,
        "strokes":[{"points":[[5,5],[6,6]]},{"points":[[905,905],[906,906]]}]}"#;
    refused(
        &["build", &file("specks.penstemon", specks), "-o", &out],
        &["specks.penstemon", "no stroke is long"],
    );
    let odd =
        r#"{"format":"penstemon-sketch","version":1,"species":"dasy","strokes":[{"points":[[0,0],[9,9]]}]}"#;
    refused(&["build", &file("odd.penstemon", odd), "-o", &out], &["odd.penstemon", "dasy", "daisy"]);
    let unknown = r#"{"format":"penstemon-sketch","version":1,"params":{"depth.wrld.height":1},
        "strokes":[{"points":[[0,0],[9,9]]}]}"#;
    refused(&["inspect", &file("unknown.penstemon", unknown)], &["unknown.penstemon", "depth.wrld.height"]);
    assert!(!Path::new(&out).exists());
}

#[test]
fn how_a_species_grows_can_be_set() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a.json").display().to_string();
    let grow = |set: &[&str]| {
        let done = penstemon(&[&["grow", "hazel", "--age", "4", "-o", &out], set].concat());
        assert!(done.status.success(), "{}", stderr(&done));
        fs::read(&out).unwrap()
    };
    let own = grow(&[]);
    assert!(own != grow(&["--set", "habit.lambda=0.7"]));
    // What the file says anyway.
    assert!(own == grow(&["--set", "habit.stems=9"]));
    let build = |set: &[&str]| {
        let done =
            penstemon(&[&["build", &sketch("topiary"), "--set", "growth.years=3", "-o", &out], set].concat());
        assert!(done.status.success(), "{}", stderr(&done));
        fs::read(&out).unwrap()
    };
    assert!(build(&[]) != build(&["--set", "habit.branching=30"]));
    let refuse = |set: &str, pieces: &[&str]| refused(&["grow", "oak", "-o", &out, "--set", set], pieces);
    refuse("habit.lamda=0.7", &["oak", "--set", "did you mean `habit.lambda`?"]);
    refuse("habit.light.depth=99", &["habit.light.depth", "outside 0 to 24"]);
}

#[test]
fn a_plant_grows_inside_a_volume() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (shape, out) = (file("shape.obj"), file("plant.json"));
    let corners = "v 0 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n";
    let five = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n";
    fs::write(&shape, format!("{corners}{five}f 4 1 5 8\n")).unwrap();
    let grown = penstemon(&["grow", "hazel", "--inside", &shape, "-o", &out]);
    assert!(grown.status.success() && stderr(&grown).is_empty(), "{}", stderr(&grown));
    let plant: serde_json::Value = serde_json::from_slice(&fs::read(&out).unwrap()).unwrap();
    let ends: Vec<Vec<f64>> = plant["branches"]
        .as_array()
        .unwrap()
        .iter()
        .map(|branch| {
            serde_json::from_value(branch["points"].as_array().unwrap().last().unwrap().clone()).unwrap()
        })
        .collect();
    assert!(ends.len() > 100, "{}", ends.len());
    let within = |x: f64, low: f64| (low - 0.01..=low + 1.01).contains(&x);
    assert!(ends.iter().all(|p| within(p[0], 0.0) && within(p[1], 1.0) && within(p[2], 0.0)));

    fs::write(&shape, format!("{corners}{five}")).unwrap();
    let inside =
        |shape: &str, pieces: &[&str]| refused(&["grow", "hazel", "--inside", shape, "-o", &out], pieces);
    inside(&shape, &["shape.obj: the mesh is open: 4 edges", "close its holes"]);
    inside(&file("none.obj"), &["none.obj", "No such file"]);
    inside("box:1x1", &["--inside box:1x1", "width, height, depth"]);
    inside("box:1e-9x1x1", &["scale it"]);
}

#[test]
fn caps_of_growth_end_in_a_smaller_plant_and_a_message() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("oak.json").display().to_string();
    let grown = penstemon(&["grow", "oak", "--max-internodes", "500", "-o", &out, "--stats"]);
    assert!(grown.status.success() && stderr(&grown).contains("500 internodes"), "{}", stderr(&grown));
    let stats: serde_json::Value = serde_json::from_slice(&grown.stdout).unwrap();
    assert!((100..=500).contains(&stats["internodes"].as_u64().unwrap()), "{stats}");
    let output = penstemon(&["grow", "oak", "-o", &out, "--max-internodes", "0"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
}

#[test]
fn unwritable_targets_leave_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("no/such/folder/a.obj").display().to_string();
    refused(&["build", &sketch("daisy"), "-o", &missing], &["no/such/folder"]);
    let odd = folder.path().join("a.stl").display().to_string();
    refused(&["build", &sketch("daisy"), "-o", &odd], &["stl", "glb"]);
    assert!(written(folder.path()).is_empty());
}

#[test]
fn wrong_usage_is_exit_code_2() {
    assert_eq!(penstemon(&["bulid"]).status.code(), Some(2));
    assert_eq!(penstemon(&["build"]).status.code(), Some(2));
}

#[test]
fn odd_strokes_warn_and_the_rest_is_built() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"{"format":"penstemon-sketch","version":1,
        "strokes":[{"id":7,"points":[[5,5],[5,5]]},{"id":8,"tool":"branch","points":[[0,400],[10,200],[0,0]]}]}"#;
    let drawing = folder.path().join("dot.penstemon");
    fs::write(&drawing, text).unwrap();
    let out = folder.path().join("dot.glb").display().to_string();
    let built = penstemon(&["build", &drawing.display().to_string(), "-o", &out]);
    assert!(built.status.success());
    assert!(stderr(&built).contains("stroke 7"), "{}", stderr(&built));
}

/// A daisy whose petals have the picture of this path.
fn daisy_with_petals(folder: &Path, picture: &str) -> String {
    let text = fs::read_to_string(sketch("daisy")).unwrap();
    let textures = format!("\"params\": {{}}, \"textures\": {{\"petal\": {}}}", serde_json::json!(picture));
    let text = text.replacen("\"params\": { }", &textures, 1);
    assert!(text.contains("textures"));
    let path = folder.join("daisy.penstemon");
    fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn a_missing_picture_gives_a_plant_and_one_remark() {
    let folder = tempfile::tempdir().unwrap();
    let drawing = daisy_with_petals(folder.path(), "/home/ada/petal.png");
    let out = |name: &str| folder.path().join(name).display().to_string();
    let (glb, json) = (out("a.glb"), out("a.json"));
    let built = penstemon(&["build", &drawing, "-o", &glb, "-o", &json]);
    assert!(built.status.success(), "{}", stderr(&built));
    assert_eq!(stderr(&built).matches("petal.png").count(), 1, "{}", stderr(&built));
    let plain = out("plain.glb");
    assert!(penstemon(&["build", &sketch("daisy"), "-o", &plain]).status.success());
    assert_eq!(fs::read(&glb).unwrap(), fs::read(&plain).unwrap(), "the species' own texture is shown");
    assert!(!fs::read_to_string(&json).unwrap().contains("/home/ada"));
}

#[test]
fn a_missing_species_file_gives_a_plant_and_one_remark() {
    let folder = tempfile::tempdir().unwrap();
    let named = |species: &str| {
        let text = fs::read_to_string(sketch("daisy")).unwrap();
        let mut drawing: serde_json::Value = serde_json::from_str(&text).unwrap();
        drawing["species"] = species.into();
        let path = folder.path().join("drawing.penstemon");
        fs::write(&path, drawing.to_string()).unwrap();
        path.display().to_string()
    };
    let out = |name: &str| folder.path().join(name).display().to_string();
    let built = penstemon(&["build", &named("/home/ada/weed.toml"), "-o", &out("a.glb")]);
    assert!(built.status.success(), "{}", stderr(&built));
    let message = stderr(&built);
    assert!(message.matches("weed.toml").count() == 1 && !message.contains("/home/ada"), "{message}");
    assert!(penstemon(&["build", &named("plant"), "-o", &out("b.glb")]).status.success());
    assert_eq!(fs::read(out("a.glb")).unwrap(), fs::read(out("b.glb")).unwrap());
    // Beside the drawing it is found; what the command line names has to be there.
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/weed.toml"), out("weed.toml")).unwrap();
    let built = penstemon(&["build", &named("/home/ada/weed.toml"), "-o", &out("a.glb")]);
    assert!(built.status.success() && stderr(&built).is_empty(), "{}", stderr(&built));
    let wrong = penstemon(&["build", &named("daisy"), "--species", "gone.toml", "-o", &out("a.glb")]);
    assert_eq!(wrong.status.code(), Some(1), "{}", stderr(&wrong));
}

#[test]
fn a_picture_beside_the_drawing_is_found_and_no_path_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("petal.png");
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/reference/small.png"), &picture).unwrap();
    let drawing = daisy_with_petals(folder.path(), "/home/ada/petal.png");
    let out = |name: &str| folder.path().join(name).display().to_string();
    let outs = ["a.glb", "a.obj", "a.json"].map(out);
    let built = penstemon(&["build", &drawing, "-o", &outs[0], "-o", &outs[1], "-o", &outs[2]]);
    assert!(built.status.success() && stderr(&built).is_empty(), "{}", stderr(&built));
    let texture = format!("petal={}", picture.display());
    let (own, json) = (out("b.glb"), out("b.json"));
    let built = penstemon(&["build", &sketch("daisy"), "--texture", &texture, "-o", &own, "-o", &json]);
    assert!(built.status.success(), "{}", stderr(&built));
    for file in written(folder.path()).iter().filter(|file| **file != Path::new(&drawing)) {
        let bytes = fs::read(file).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        let home = folder.path().display().to_string();
        assert!(!text.contains("/home/ada") && !text.contains(&home), "{}", file.display());
    }
}

#[test]
fn a_cause_is_said_once() {
    let output = penstemon(&["check", "/nowhere/plant.obj"]);
    assert_eq!(stderr(&output).matches("No such file").count(), 1, "{}", stderr(&output));
}

#[test]
fn a_model_is_drawn_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (model, picture) = (path("daisy.obj"), path("daisy.png"));
    assert!(penstemon(&["build", &sketch("daisy"), "-o", &model]).status.success());
    for option in [["--seed", "3"], ["--set", "depth.world.height=1"], ["--texture", "leaf=a.png"]] {
        let args = ["render", &model, "-o", &picture, option[0], option[1]];
        refused(&args, &["daisy.obj is a model", option[0]]);
    }
    refused(&["render", &model, "-o", &picture, "--view", "drawing"], &["daisy.obj is a model", "drawing"]);
    assert!(!Path::new(&picture).exists());
}

#[test]
fn render_counts_what_it_writes() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("turn.png").display().to_string();
    let args = ["render", &sketch("daisy"), "-o", &out, "--size", "80x60", "--turntable", "2", "--stats"];
    let output = penstemon(&args);
    assert!(output.status.success(), "{}", stderr(&output));
    let stats: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let files = written(folder.path());
    let bytes: u64 = files.iter().map(|f| fs::metadata(f).unwrap().len()).sum();
    assert_eq!((files.len(), stats["bytes"].as_u64()), (2, Some(bytes)));
}

#[test]
fn verbose_tells_the_stages() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("daisy.glb").display().to_string();
    let output = penstemon(&["build", &sketch("daisy"), "-o", &out, "--verbose"]);
    assert!(stderr(&output).contains("anatomy took"), "{}", stderr(&output));
}

#[test]
fn a_recording_is_written_over_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tablet.txt");
    fs::write(&file, "an evening's drawing").unwrap();
    let name = file.display().to_string();
    refused(
        &["pen", "record", &name, "--seconds", "1"],
        &["tablet.txt: there is already something of this name"],
    );
    assert_eq!(fs::read_to_string(&file).unwrap(), "an evening's drawing");
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("daisy.glb").display().to_string();
    assert!(penstemon(&["build", &sketch("daisy"), "-o", &out]).status.success());
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let status = Command::new(env!("CARGO_BIN_EXE_penstemon")).args(["check", &out]).stdout(writer).status();
    assert!(status.unwrap().success());
}

#[test]
fn a_picture_made_without_a_desktop_is_made_in_silence() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("daisy.png");
    for folder in [None, Some("not/absolute")] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_penstemon"));
        command.args(["render", "assets/sketches/daisy.penstemon", "--size", "64x64", "-o"]).arg(&out);
        command.env_remove("NODEVICE_SELECT").env_remove("XDG_RUNTIME_DIR");
        command.envs(folder.map(|folder| ("XDG_RUNTIME_DIR", folder)));
        let made = command.output().unwrap();
        assert_eq!(
            (made.status.success(), String::from_utf8_lossy(&made.stderr).as_ref()),
            (true, ""),
            "{folder:?}"
        );
        std::fs::remove_file(&out).unwrap();
    }
}

#[test]
fn what_can_never_grow_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("hazel.glb").display().to_string();
    let grow = |age: &str, pieces: &[&str]| {
        refused(&["grow", "hazel", "--age", age, "--set", "habit.supply=0", "-o", &out], pieces);
    };
    grow("60", &["no bud is left", "a higher habit.supply"]);
    // While buds still wait, they may grow later for all that is known.
    grow("2", &["choose a higher --age"]);
    assert!(written(folder.path()).is_empty());
}

#[test]
fn fineness_without_a_crown_is_remarked_on() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("daisy.glb").display().to_string();
    let message = |set: &str| stderr(&penstemon(&["build", &sketch("daisy"), "-o", &out, "--set", set]));
    assert!(message("habit.fineness=0.5").contains("fineness changes only what grows in a crown"));
    assert!(!message("habit.height=2").contains("fineness"));
}

#[test]
fn a_model_that_cannot_be_read_is_named_where_it_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (obj, glb, picture) = (file("broken.obj"), file("broken.glb"), file("picture.png"));
    fs::write(&obj, "v 0 0 0\nv 1 0 x\nf 1 2 3\n").unwrap();
    fs::write(&glb, b"glTF but no more").unwrap();
    refused(&["render", &obj, "-o", &picture], &["broken.obj", "line 2"]);
    refused(&["render", &glb, "-o", &picture], &["broken.glb"]);
    assert!(!Path::new(&picture).exists());
}

#[test]
fn seasons_have_names_and_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let grow = |options: &[&str], name: &str| {
        let out = folder.path().join(name);
        let mut args = vec!["grow", "birch", "--age", "5", "-o", out.to_str().unwrap()];
        args.extend(options);
        let output = penstemon(&args);
        assert!(output.status.success(), "{}", stderr(&output));
        std::fs::read(out).unwrap()
    };
    let usual = grow(&[], "usual.json");
    assert_eq!(grow(&["--season", "2"], "number.json"), usual);
    let winter = grow(&["--season", "winter"], "winter.json");
    assert_eq!(grow(&["--set", "season.time=5"], "set.json"), winter);
    assert!(winter.len() < usual.len() / 2, "{} of {} bytes", winter.len(), usual.len());
    for wrong in ["fall", "5.1", "-1", "nan"] {
        let output = penstemon(&["grow", "birch", &format!("--season={wrong}"), "-o", "never.json"]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
        assert!(
            stderr(&output).contains("spring, summer, autumn, winter or a number"),
            "{}",
            stderr(&output)
        );
    }
    let rose = |option: &str, name: &str| {
        let out = folder.path().join(name);
        assert!(penstemon(&["grow", "rose", option, "-o", out.to_str().unwrap()]).status.success());
        std::fs::read(out).unwrap()
    };
    assert_eq!(rose("--season=winter", "rose.json"), rose("--set=season.time=5", "set_rose.json"));
}
