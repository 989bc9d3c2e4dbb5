//! `penstemon check` and the readers behind it: verdicts, exit codes, and files that mean harm.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::common::{provenance, textures, two_specimens};
use penstemon::formats::read::{ReadFormat, from_bytes, load};
use penstemon::formats::write::{Exporter, Scene, export, glb::Glb, obj::Obj};
use penstemon::model::quality::judge;
use proptest::prelude::*;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::Arc;

fn check(path: &Path, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_penstemon")).arg("check").arg(path).args(more).output().unwrap()
}

fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

fn stderr(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

#[test]
fn clean_models_pass() {
    let (model, plant) = two_specimens();
    let folder = tempfile::tempdir().unwrap();
    for name in ["plant.obj", "plant.glb"] {
        let path = folder.path().join(name);
        export(&path, &model, (&plant, &provenance()), &textures).unwrap();
        let text = check(&path, &[]);
        assert!(text.status.success() && stdout(&text).contains("no defects"), "{text:?}");
        let json = check(&path, &["--json"]);
        let report: serde_json::Value = serde_json::from_str(stdout(&json)).unwrap();
        assert_eq!(report["clean"], true);
        assert_eq!(report["triangles"], model.triangle_count());
        assert_eq!(report["components"], 8);
    }
}

/// An OBJ file with a disc of so many corners around a middle, as one polygon or as a fan of triangles.
fn disc(corners: usize, as_fan: bool) -> String {
    let angle = |k: usize| k as f64 * std::f64::consts::TAU / corners as f64;
    let corner = |k: usize| format!("v {:.6} 0 {:.6}\n", angle(k).cos(), angle(k).sin());
    let points: String = std::iter::once("v 0 0 0\n".to_owned()).chain((0..corners).map(corner)).collect();
    let faces: String = if as_fan {
        (0..corners).map(|k| format!("f 1 {} {}\n", k + 2, (k + 1) % corners + 2)).collect()
    } else {
        let all: Vec<String> = (0..corners).map(|k| (k + 2).to_string()).collect();
        format!("f {}\n", all.join(" "))
    };
    points + &faces
}

#[test]
fn large_fans_and_polygons_are_judged() {
    let folder = tempfile::tempdir().unwrap();
    for (corners, as_fan) in [(1500, true), (4000, false)] {
        let path = folder.path().join("disc.obj");
        fs::write(&path, disc(corners, as_fan)).unwrap();
        let output = check(&path, &["--json"]);
        let report: serde_json::Value = serde_json::from_str(stdout(&output)).unwrap();
        let triangles = if as_fan { corners } else { corners - 2 };
        assert_eq!(
            (output.status.code(), &report["triangles"]),
            (Some(1), &triangles.into()),
            "{}",
            stderr(&output)
        );
        assert_eq!(report["boundary_edges"], corners, "{report}");
    }
}

#[test]
fn defects_are_reported_with_their_mesh_and_exit_code_1() {
    let (mut model, plant) = two_specimens();
    Arc::make_mut(&mut model.parts[2].mesh).triangles.remove(0);
    Arc::make_mut(&mut model.parts[3].mesh).triangles[5].swap(0, 1);
    let folder = tempfile::tempdir().unwrap();
    for name in ["plant.obj", "plant.glb"] {
        let path = folder.path().join(name);
        export(&path, &model, (&plant, &provenance()), &textures).unwrap();
        let output = check(&path, &[]);
        assert_eq!(output.status.code(), Some(1));
        assert!(stdout(&output).contains("3 boundary edges") && stdout(&output).contains("1 flipped faces"));
        assert_eq!(name.ends_with("glb"), stdout(&output).contains("leaf_2, leaf_3"), "{}", stdout(&output));
    }
}

#[test]
fn unreadable_files_are_one_message_with_the_name() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes, reason) in [
        ("a.obj", b"v 1 2\n".as_slice(), "line 1"),
        ("b.obj", b"", "without a face"),
        ("c.glb", b"glTF", "version 2"),
        ("d.stl", b"solid", ".obj and .glb files only"),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        let output = check(&path, &["--json"]);
        assert_eq!(output.status.code(), Some(1), "{name}");
        assert!(stderr(&output).contains(name) && stderr(&output).contains(reason), "{}", stderr(&output));
        assert_eq!((stderr(&output).trim_end().lines().count(), stdout(&output)), (1, ""));
    }
    let gone = check(&folder.path().join("gone.obj"), &[]);
    assert!(gone.status.code() == Some(1) && stderr(&gone).contains("cannot read it"));
}

#[test]
fn copies_count_like_the_triangles_that_they_stand_for() {
    let folder = tempfile::tempdir().unwrap();
    let reports = [&[][..], &["--instances", "nodes"], &["--instances", "gpu"]].map(|form| {
        let path = folder.path().join("oak.glb");
        let grow = ["grow", "oak", "--age", "8", "-o"];
        let grown =
            Command::new(env!("CARGO_BIN_EXE_penstemon")).args(grow).arg(&path).args(form).output().unwrap();
        assert!(grown.status.success(), "{grown:?}");
        let report: serde_json::Value = serde_json::from_slice(&check(&path, &["--json"]).stdout).unwrap();
        ["clean", "points", "triangles", "components", "crossing_faces"].map(|key| report[key].clone())
    });
    assert!(reports[0][0] == true && reports[0][2].as_u64() > Some(5000), "{:?}", reports[0]);
    assert!(reports[0][4].as_u64() > Some(0), "{:?}", reports[0]);
    assert_eq!(reports[0], reports[1], "nodes");
    assert_eq!(reports[0], reports[2], "gpu");
}

fn obj_refusal(text: &str) -> String {
    from_bytes(ReadFormat::Obj, text.as_bytes()).unwrap_err().to_string()
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn obj_errors_name_the_line() {
    for (face, reason) in [
        ("f 1 2 4", "line 5: index 4 is out of range; there are 3 `v` lines above"),
        ("f 1 2 -4", "line 5: index -4 is out of range"),
        ("f 0 1 2", "line 5: index 0 is out of range"),
        ("f 1 2 9223372036854775807", "line 5: index 9223372036854775807 is out of range"),
        ("f 1 2 -9223372036854775808", "line 5: index -9223372036854775808 is out of range"),
        ("f 1/-9223372036854775808 2 3", "line 5: index -9223372036854775808 is out of range"),
        ("f 1 2 99999999999999999999", "line 5: `99999999999999999999` is no corner of a face"),
        ("f 1 2", "line 5: a face of 2 corners"),
        ("f 1 2 /", "line 5: `/` is no corner"),
        ("f 1/1/1/1 2 3", "line 5: index 1 is out of range"),
        ("v 1 x 2\nf 1 2 3", "line 5: position parse error"),
        ("v 1 1 1 0\nf 1 2 3", "line 5: scaling (w) by zero"),
    ] {
        let message = obj_refusal(&format!("# a comment\n{TRIANGLE}{face}\n"));
        assert!(message.starts_with(reason), "{face}: {message}");
    }
}

#[test]
fn obj_points_are_shared_across_groups_and_materials() {
    let tetrahedron = "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl x\nf 1 3 2\ng b\nusemtl y\nf -4 -3 -1\nf 1 4 3\nf 2 3 4";
    let surfaces = from_bytes(ReadFormat::Obj, tetrahedron.as_bytes()).unwrap();
    assert_eq!(surfaces.len(), 1);
    let report = judge(&surfaces[0].mesh, surfaces[0].has);
    assert!(report.is_clean() && report.points == 4, "{report:?}");
    assert!(!surfaces[0].has.normals && !surfaces[0].has.uvs);
}

#[test]
fn obj_numbers_that_are_not_finite_are_reported() {
    let text = "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n";
    let surfaces = from_bytes(ReadFormat::Obj, text.as_bytes()).unwrap();
    assert_eq!(judge(&surfaces[0].mesh, surfaces[0].has).non_finite, 1);
}

/// A GLB file of this document and buffer.
fn container(document: &str, buffer: &[u8]) -> Vec<u8> {
    let mut json = document.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + json.len() as u32 + buffer.len() as u32).to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend((buffer.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(buffer);
    bytes
}

/// A document with one triangle, of which `from` is replaced by `to`.
fn altered(from: &str, to: &str) -> Vec<u8> {
    let document = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":48}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
                     {"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "nodes":[{"mesh":0,"children":[1]},{}]}"#;
    assert!(document.contains(from), "{from}");
    let floats = [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let mut buffer: Vec<u8> = floats.iter().flat_map(|f| f.to_le_bytes()).collect();
    buffer.extend([0u32, 1, 2].iter().flat_map(|i| i.to_le_bytes()));
    container(&document.replacen(from, to, 1), &buffer)
}

#[test]
fn glb_lies_are_refused_with_their_place() {
    for (from, to, reason) in [
        (r#""count":3,"type":"VEC3""#, r#""count":4,"type":"VEC3""#, "accessor 0: its 4 elements do not fit"),
        (r#""count":3"#, r#""count":18446744073709551615"#, "accessor 0: its 18446744073709551615 elements"),
        (r#""count":3"#, r#""count":0"#, "accessor 0: its 0 elements"),
        (r#""byteLength":36}"#, r#""byteLength":4000}"#, "accessor 0: it reaches beyond"),
        (r#""byteOffset":36"#, r#""byteOffset":18446744073709551615"#, "accessor 1: it reaches beyond"),
        (r#""byteLength":36}"#, r#""byteLength":36,"byteStride":0}"#, "accessor 0: its stride of 0"),
        (r#""bufferView":0,"#, "", "accessor 0: it has no buffer view; compressed"),
        (r#""bufferView":0,"#, r#""bufferView":7,"#, "accessor 0: its buffer view does not exist"),
        (
            r#"{"buffer":0,"byteLength":36}"#,
            r#"{"buffer":1,"byteLength":36}"#,
            "accessor 0: its data are outside",
        ),
        (r#"{"byteLength":48}"#, r#"{"byteLength":48,"uri":"a.bin"}"#, "accessor 0: its data are outside"),
        (
            r#""type":"VEC3"}"#,
            r#""type":"VEC3","sparse":{"count":1,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}}}"#,
            "accessor 0: sparse",
        ),
        (r#""componentType":5126"#, r#""componentType":5123"#, "accessor 0: only 32-bit floats"),
        (r#""componentType":5125"#, r#""componentType":5126"#, "accessor 1: indices must be unsigned"),
        (r#""POSITION":0"#, r#""POSITION":9"#, "accessor 9: there is no such accessor"),
        (r#""POSITION":0"#, r#""POSITION":1"#, "accessor 1: it holds Scalar, not Vec3"),
        (r#""POSITION":0"#, r#""NORMAL":0"#, "mesh `mesh 0`: it has no positions"),
        (r#""indices":1"#, r#""indices":1,"mode":5"#, "mesh `mesh 0`: triangle strips"),
        (r#""indices":1"#, r#""indices":1,"mode":1"#, "meshes: the file has no triangles"),
        (r#""children":[1]"#, r#""children":[0]"#, "nodes: a node is its own ancestor"),
        (r#""children":[1]},{}"#, r#""children":[1]},{"children":[0]}"#, "nodes: a node is its own ancestor"),
        (r#""children":[1]"#, r#""children":[1,1]"#, "node 0: its child 1 is also a child"),
        (r#""children":[1]"#, r#""children":[2]"#, "node 0: there is no node 2"),
        (r#""mesh":0"#, r#""mesh":1"#, "node 0: there is no mesh 1"),
    ] {
        let message = from_bytes(ReadFormat::Glb, &altered(from, to)).unwrap_err().to_string();
        assert!(message.starts_with(reason), "{to}: {message}");
    }
}

#[test]
fn glb_indices_without_vertex_are_a_defect_not_an_error() {
    let mut bytes = altered("{}", "{}");
    let end = bytes.len();
    bytes[end - 4] = 200;
    let surfaces = from_bytes(ReadFormat::Glb, &bytes).unwrap();
    assert_eq!(judge(&surfaces[0].mesh, surfaces[0].has).indices_out_of_range, 1);
}

#[test]
fn faces_without_all_their_corners_are_reported_and_not_placed() {
    let mut bytes = altered("{}", "{}");
    let end = bytes.len();
    bytes[end - 4] = 200;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.glb");
    fs::write(&path, &bytes).unwrap();
    let output = check(&path, &[]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    assert!(stdout(&output).contains("1 indices out of range"), "{output:?}");
}

/// A second node with a table of these columns, below the one that shows the triangle.
fn tabled(columns: &str) -> Vec<u8> {
    let extension = format!(r#""extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{{columns}}}}}}}"#);
    altered(",{}]", &format!(r#",{{"mesh":0,{extension}}}]"#))
}

#[test]
fn tables_of_copies_are_read_or_refused_with_their_node() {
    let surfaces = from_bytes(ReadFormat::Glb, &tabled(r#""TRANSLATION":0,"SCALE":0"#)).unwrap();
    assert_eq!((surfaces.len(), surfaces[0].copies), (1, 1 + 3));
    for (columns, reason) in [
        ("", "node 1: EXT_mesh_gpu_instancing: its table has no columns"),
        (r#""SCALE":"a""#, "node 1: EXT_mesh_gpu_instancing: an attribute is no accessor"),
        (r#""SCALE":7"#, "accessor 7: there is no such accessor"),
        (r#""ROTATION":0"#, "accessor 0: it holds Vec3, not Vec4"),
    ] {
        let message = from_bytes(ReadFormat::Glb, &tabled(columns)).unwrap_err().to_string();
        assert!(message.starts_with(reason), "{columns}: {message}");
    }
}

#[test]
fn extensions_that_a_file_requires_and_nobody_reads_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("packed.glb");
    let required =
        r#""version":"2.0"},"extensionsRequired":["EXT_meshopt_compression","EXT_mesh_gpu_instancing"]"#;
    fs::write(&path, altered(r#""version":"2.0"}"#, required)).unwrap();
    let warnings = load(&path).unwrap().warnings;
    assert!(warnings.len() == 1 && warnings[0].contains("EXT_meshopt_compression"), "{warnings:?}");
}

#[test]
fn few_bytes_cannot_be_placed_without_end() {
    let (faces, copies) = (30_000, 1_000);
    let document = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{all}}}],
        "bufferViews":[{{"buffer":0,"byteLength":{table}}},{{"buffer":0,"byteOffset":{table},"byteLength":{index}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{copies},"type":"VEC3"}},
                     {{"bufferView":1,"componentType":5125,"count":{corners},"type":"SCALAR"}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "nodes":[{{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":0}}}}}}}}]}}"#,
        all = 12 * (faces + copies),
        table = 12 * copies,
        index = 12 * faces,
        corners = 3 * faces,
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("many.glb");
    fs::write(&path, container(&document, &vec![0; 12 * (faces + copies)])).unwrap();
    let message = load(&path).unwrap_err().to_string();
    assert!(message.contains("node 0: the file unfolds into far more data"), "{message}");
}

#[test]
fn a_small_glb_cannot_unfold_into_a_large_one() {
    let primitive = r#"{"attributes":{"POSITION":0}}"#;
    let many = vec![primitive; 10_000].join(",");
    let bomb = altered(r#"{"attributes":{"POSITION":0},"indices":1}"#, &many);
    let message = from_bytes(ReadFormat::Glb, &bomb).unwrap_err().to_string();
    assert!(message.contains("unfolds into far more data"), "{message}");
}

#[test]
fn every_truncation_of_a_glb_is_refused() {
    let whole = altered("{}", "{}");
    assert!(from_bytes(ReadFormat::Glb, &whole).is_ok());
    for length in 0..whole.len() {
        assert!(from_bytes(ReadFormat::Glb, &whole[..length]).is_err(), "cut to {length} bytes");
    }
}

fn sample(format: &dyn Exporter) -> Vec<u8> {
    let (model, plant) = two_specimens();
    let provenance = provenance();
    let scene = Scene::new(&model, (&plant, &provenance), &textures, "a".into()).unwrap();
    format.encode(&scene).unwrap().bytes
}

fn read_and_judge(format: ReadFormat, bytes: &[u8]) {
    for surface in from_bytes(format, bytes).unwrap_or_default() {
        judge(&surface.mesh, surface.has);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_never_panic(bytes: Vec<u8>) {
        read_and_judge(ReadFormat::Obj, &bytes);
        read_and_judge(ReadFormat::Glb, &bytes);
    }

    #[test]
    fn random_obj_lines_never_panic(lines in "((v|vt|vn|f)( -?[0-9]{1,3}(/[0-9]?){0,2}){0,5}\n){0,40}") {
        read_and_judge(ReadFormat::Obj, lines.as_bytes());
    }

    #[test]
    fn damaged_files_never_panic(damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..20)) {
        for (format, mut bytes) in [(ReadFormat::Obj, sample(&Obj)), (ReadFormat::Glb, sample(&Glb))] {
            for (place, byte) in &damage {
                let place = place.index(bytes.len());
                bytes[place] = *byte;
            }
            read_and_judge(format, &bytes);
        }
    }
}
