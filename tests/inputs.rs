//! What the program is given: it is never written over, a strange file is refused at once, and however long its names
//! are, the answer is short and comes soon.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest that an answer may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);
/// Longest answer, bytes.
const LONGEST: usize = 16 << 10;

const DRAWING: &str = r#"{"format":"penstemon-sketch","version":1,
    "strokes":[{"tool":"branch","points":[[0,400],[10,200],[0,0]]}]}"#;

/// A closed cube of a metre, as an OBJ file.
const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// Runs the program in a folder; it must end within [`PATIENCE`].
fn penstemon(folder: &Path, args: &[&str]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_penstemon"))
        .current_dir(folder)
        .args(args)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stderr.take().unwrap();
    let reader = thread::spawn(move || {
        let mut read = Vec::new();
        pipe.read_to_end(&mut read).unwrap();
        read
    });
    let begin = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if begin.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("no answer to {args:.80?}");
        }
        thread::sleep(Duration::from_millis(5));
    };
    Output { status, stdout: Vec::new(), stderr: reader.join().unwrap() }
}

/// Runs and expects exit code 1 and a short message without control characters; returns it.
fn refused(folder: &Path, args: &[&str]) -> String {
    let output = penstemon(folder, args);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{args:.80?}: {message}");
    is_plain(&message);
    message
}

fn is_plain(message: &str) {
    assert!(message.len() <= LONGEST, "{} bytes: {message:.300}…", message.len());
    assert!(message.chars().all(|c| c == '\n' || !c.is_control()), "{message:?}");
    assert!(!message.contains("panicked"), "{message}");
}

fn put(folder: &TempDir, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, contents).unwrap();
    path
}

/// A PNG file of one pixel.
fn pixel() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[40, 160, 60]).unwrap();
    bytes
}

/// A folder with one file of every kind that is read.
fn workshop() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    put(&folder, "drawing.json", DRAWING);
    put(&folder, "shape.obj", CUBE);
    put(&folder, "bark.png", pixel());
    put(&folder, "m_bark.png", pixel());
    put(&folder, "unused.png", pixel());
    put(
        &folder,
        "m.mtl",
        "newmtl bark\nKd 1 1 1\nmap_Kd m_bark.png\n\nnewmtl other\nKd 1 1 1\nmap_Ks unused.png\n",
    );
    put(&folder, "m.obj", format!("mtllib m.mtl\nusemtl bark\n{CUBE}"));
    let oak = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/growth/hazel.toml");
    let own = fs::read_to_string(oak).unwrap() + "\n[materials.mine]\ntexture = \"bark.png\"\n";
    put(&folder, "own.toml", &own);
    fs::copy(folder.path().join("own.toml"), folder.path().join("own.json")).unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("drawing.json", folder.path().join("link.json")).unwrap();
        fs::hard_link(folder.path().join("drawing.json"), folder.path().join("twin.json")).unwrap();
        std::os::unix::fs::symlink("own.toml", folder.path().join("linked.json")).unwrap();
        std::os::unix::fs::symlink("shape.obj", folder.path().join("again.obj")).unwrap();
        // The picture that the OBJ file would be written with.
        std::os::unix::fs::symlink("bark.png", folder.path().join("tree_stem-picture.png")).unwrap();
    }
    folder
}

#[cfg(unix)]
#[test]
fn nothing_that_is_read_is_written_over() {
    let texture = ["--texture", "stem=bark.png"];
    let cases: &[(&[&str], &str)] = &[
        (&["build", "drawing.json", "-o", "drawing.json"], "drawing.json"),
        (&["build", "drawing.json", "-o", "new.glb", "-o", "link.json"], "drawing.json"),
        (&["build", "drawing.json", "-o", "twin.json"], "drawing.json"),
        (&["build", "drawing.json", "--species", "own.toml", "-o", "linked.json"], "own.toml"),
        (&["build", "drawing.json", texture[0], texture[1], "-o", "new.glb", "-o", "tree.obj"], "bark.png"),
        (&["grow", "own.toml", "--age", "2", "-o", "linked.json"], "own.toml"),
        (&["grow", "own.toml", "--age", "2", "-o", "bark.png"], "bark.png"),
        (&["grow", "hazel", "--inside", "shape.obj", "--age", "2", "-o", "shape.obj"], "shape.obj"),
        (&["grow", "hazel", "--inside", "shape.obj", "-o", "new.glb", "-o", "again.obj"], "shape.obj"),
        (&["render", "drawing.json", "-o", "link.json"], "drawing.json"),
        (&["render", "drawing.json", "--view", "drawing", "-o", "twin.json"], "drawing.json"),
        (&["render", "m.obj", "-o", "m_bark.png"], "m_bark.png"),
        (&["render", "m.obj", "-o", "unused.png"], "unused.png"),
        (&["render", "m.obj", "-o", "m.mtl"], "m.mtl"),
        (&["render", "m.obj", "-o", "m.obj"], "m.obj"),
    ];
    let folder = workshop();
    let state = || {
        let mut all: Vec<(PathBuf, Vec<u8>)> = fs::read_dir(folder.path())
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .map(|path| (path.clone(), fs::read(path).unwrap()))
            .collect();
        all.sort();
        all
    };
    let before = state();
    for (args, source) in cases {
        let message = refused(folder.path(), args);
        assert!(message.contains("the same file as"), "{args:?}: {message}");
        assert!(
            message.contains(source) && message.contains(args[args.len() - 1].split('.').next().unwrap())
        );
        assert!(state() == before, "{args:?} changed the folder");
    }
}

#[test]
fn what_is_not_read_may_be_replaced() {
    let folder = workshop();
    for args in [
        &["build", "drawing.json", "-o", "own.json"][..],
        &["build", "drawing.json", "-o", "m.obj"],
        &["build", "drawing.json", "-o", "m.obj"],
        &["grow", "hazel", "--age", "2", "-o", "shape.obj"],
    ] {
        let output = penstemon(folder.path(), args);
        assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused_at_once() {
    let folder = workshop();
    for name in ["pipe.toml", "pipe.json", "pipe.obj", "pipe.glb", "pipe.png", "pipe.txt"] {
        assert!(Command::new("mkfifo").arg(folder.path().join(name)).status().unwrap().success());
    }
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("zero.toml")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("zero.obj")).unwrap();
    let named = |key: &str, value: &str| {
        DRAWING.replacen("\"version\":1,", &format!("\"version\":1,\"{key}\":{value},"), 1)
    };
    put(&folder, "species.json", named("species", "\"pipe.toml\""));
    put(&folder, "device.json", named("species", "\"zero.toml\""));
    let cases: &[&[&str]] = &[
        &["grow", "pipe.toml", "-o", "a.glb"],
        &["grow", "zero.toml", "-o", "a.glb"],
        &["grow", "hazel", "--inside", "pipe.obj", "-o", "a.glb"],
        &["grow", "hazel", "--inside", "zero.obj", "-o", "a.glb"],
        &["build", "pipe.json", "-o", "a.glb"],
        &["build", "species.json", "-o", "a.glb"],
        &["build", "device.json", "-o", "a.glb"],
        &["build", "drawing.json", "--species", "pipe.toml", "-o", "a.glb"],
        &["build", "drawing.json", "--texture", "stem=pipe.png", "-o", "a.glb"],
        &["inspect", "pipe.json"],
        &["check", "pipe.obj"],
        &["check", "pipe.glb"],
        &["render", "pipe.obj", "-o", "a.png"],
        &["render", "pipe.json", "-o", "a.png"],
        &["pen", "replay", "pipe.txt"],
    ];
    for args in cases {
        let message = refused(folder.path(), args);
        let strange = ["pipe", "zero"].into_iter().any(|name| message.contains(name));
        assert!(strange && message.contains("file"), "{args:?}: {message}");
    }
}

#[test]
fn long_and_wild_names_get_short_answers() {
    let folder = tempfile::tempdir().unwrap();
    let long = "x".repeat(10 << 20);
    let wild = "a\u{1b}[31m\u{7}\u{9b}2J\u{202e}b".repeat(1000);
    let json = |text: &str| serde_json::to_string(text).unwrap();
    let with = |head: String| DRAWING.replacen("\"version\":1,", &format!("\"version\":1,{head}"), 1);
    for name in [&long, &wild] {
        let name = json(name);
        let drawings = [
            with(format!("\"species\":{name},")),
            with(format!("\"params\":{{{name}:1}},")),
            with(format!("\"params\":{{\"depth\":{{{name}:1}}}},")),
            with(format!("\"params\":{{{name}:1,{name}:2}},")),
            with(format!("\"params\":{{\"depth.world.height\":{name}}},")),
            with(format!("\"textures\":{{{name}:\"oak.png\"}},")),
            with(format!("{name}:1,")),
            DRAWING.replacen("penstemon-sketch", name.trim_matches('"'), 1),
            DRAWING.replacen("\"branch\"", &name, 1),
        ];
        for drawing in drawings {
            put(&folder, "drawing.json", drawing);
            refused(folder.path(), &["build", "drawing.json", "-o", "a.glb"]);
        }
    }
    let head = "latin = \"x\"\n[stem]\nmaterial = \"bark\"\n[leaf]\nmaterials = [\"bark\"]\n";
    let materials = "[materials.bark]\ncolor = \"#102030\"\n";
    // A species file is at most a MiB.
    for name in [&long[..900 << 10], &wild] {
        let name = json(name).replace("\\u001b", "\\u001B");
        let species = [
            format!("name = {name}\n{head}{materials}"),
            format!("name = \"x\"\n{name} = 1\n{head}{materials}"),
            format!("name = \"x\"\n{head}{materials}texture = {name}\n"),
            format!("name = \"x\"\n{head}{materials}[materials.{name}]\n"),
            format!("name = \"x\"\n{head}{materials}[growth]\n{name} = 1\n"),
            format!("name = \"x\"\n{head}[materials.bark]\ncolor = {name}\n"),
            format!("name = \"x\"\n{head}{materials}[params.{name}]\nx = 1\n"),
            format!(
                "name = \"x\"\nlatin = \"x\"\n[stem]\nmaterial = {name}\n[leaf]\nmaterials = [\"bark\"]\n{materials}"
            ),
        ];
        for text in species {
            put(&folder, "own.toml", text);
            refused(folder.path(), &["grow", "own.toml", "-o", "a.glb"]);
        }
    }
}

#[test]
fn arguments_are_quoted_as_files_are() {
    let folder = tempfile::tempdir().unwrap();
    put(&folder, "drawing.json", DRAWING);
    let wild = format!("a\u{1b}[31m{}", "é".repeat(40_000));
    for args in [
        &["build", "drawing.json", "-o", "a.glb", "--species", &wild][..],
        &["build", "drawing.json", "-o", "a.glb", "--set", &wild],
        &["build", "drawing.json", "-o", "a.glb", "--set", &format!("{wild}=1")],
        &["build", "drawing.json", "-o", "a.glb", "--texture", &wild],
        &["build", "drawing.json", "-o", "a.glb", "--texture", &format!("{wild}=x.png")],
        &["build", "drawing.json", "-o", "a.glb", "--texture", &format!("leaf={wild}")],
        &["build", &wild, "-o", "a.glb"],
        &["build", "drawing.json", "-o", &wild],
        &["build", "drawing.json", "-o", &format!("{wild}.glb")],
        &["grow", &wild, "-o", "a.glb"],
        &["grow", "hazel", "--inside", &wild, "-o", "a.glb"],
        &["check", &wild],
    ] {
        refused(folder.path(), args);
    }
    for args in [
        &[wild.as_str()][..],
        &["build", "drawing.json", &wild],
        &["render", "a", "-o", "b", "--size", &wild],
    ] {
        let output = penstemon(folder.path(), args);
        assert_eq!(output.status.code(), Some(2));
        is_plain(&String::from_utf8(output.stderr).unwrap());
    }
}
