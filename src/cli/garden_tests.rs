//! Tests of `penstemon garden`: what is refused, shares, and files of all formats.

use super::*;
use crate::cli::{Cli, Verb};
use clap::Parser;

fn parse(line: &str) -> Result<Args, clap::Error> {
    match Cli::try_parse_from(line.split_whitespace())?.verb {
        Some(Verb::Garden(args)) => Ok(args),
        other => panic!("{other:?}"),
    }
}

fn message(line: &str) -> String {
    crate::cli::one_line(&run(&parse(line).unwrap()).unwrap_err())
}

#[test]
fn plants_an_area_and_an_output_are_needed() {
    assert!(parse("penstemon garden -o a.glb").is_err() && parse("penstemon garden rose").is_err());
    assert!(parse("penstemon garden rose --area 4 -o a.glb").is_err());
    let args =
        parse("penstemon garden rose a.svg b.glb --area 40x25 --density 6 --seed 3 -o a.glb -o a.json")
            .unwrap();
    assert_eq!((args.density, args.seed, args.out.len()), (Some(6.0), Some(3), 2));
    let (spec, _) = spec(&args).unwrap();
    let origins: Vec<Origin> = spec.plants.into_iter().map(|kind| kind.origin).collect();
    let [rose, drawing, model] = ["rose", "a.svg", "b.glb"].map(str::to_owned);
    assert_eq!(origins, [Origin::Species(rose), Origin::Drawing(drawing), Origin::Model(model)]);
}

#[test]
fn faults_are_reported_before_anything_is_built() {
    let garden = |rest: &str| message(&format!("penstemon garden {rest}"));
    assert!(garden("roes --area 4x4 -o a.glb").contains("did you mean `rose`?"));
    assert!(
        garden("cactus --area 4x4 -o a.glb").contains("plant a drawing")
            && garden("cactus -o a.glb").contains("--area")
    );
    assert!(garden("rose -o a.glb").contains("--area 40x25"));
    assert!(garden("rose --area 4x4 -o a.xyz").contains("xyz"));
    assert!(garden("rose --area 4x4 --density 0 -o a.glb").contains("--density"));
    assert!(garden("rose --area 400x400 --density 1000 -o a.glb").contains("5000000"));
    assert!(garden("rose --area 4x4 --spacing 0.000001 -o a.glb").contains("larger spacing"));
    assert!(garden("rose --area 4x4 --spacing 1 --density 6 -o a.glb").contains("spacing of at most"));
    assert!(garden("rose --area 4x4 --set rose.sesaon=1 -o a.glb").contains("did you mean"));
    assert!(garden("no.toml -o a.glb").contains("no.toml"));
    assert!(garden("no.glb --area 4x4 -o a.glb").contains("no.glb"));
    assert!(garden("oak --area 2000x2000 --density 0.4 -o a.glb").contains("--instances gpu"));
}

#[test]
fn a_flat_file_is_refused_when_it_would_be_too_large() {
    assert!(check_size(Path::new("a.obj"), 1_000_000).is_ok());
    let refused = check_size(Path::new("a.obj"), 20_000_000).unwrap_err().to_string();
    assert!(refused.contains("MiB") && refused.contains("Write GLB"), "{refused}");
    assert!(check_size(Path::new("a.png"), 100_000_000).unwrap_err().to_string().contains("smaller area"));
    assert!(check_size(Path::new("a.glb"), 100_000_000).is_ok());
}

/// The lines of a list's plants.
fn plants(list: &Path) -> String {
    let text = std::fs::read_to_string(list).unwrap();
    let (_, plants) = text.split_once("\"plants\":[\n").unwrap();
    plants.strip_suffix("\n]}\n").unwrap().to_owned()
}

#[test]
fn the_lists_of_shares_are_the_list_of_the_garden() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: String, options: &str| {
        let out = folder.path().join(name);
        let garden = "penstemon garden tulip daisy --density 3 --variants 2";
        run(&parse(&format!("{garden} {options} -o {}", out.display())).unwrap()).unwrap();
        out
    };
    let whole = plants(&write("whole.json".into(), "--area 40x30"));
    let share =
        |number: u32| plants(&write(format!("{number}.json"), &format!("--area 40x30 --shard {number}/4")));
    let shares: Vec<String> = (1..=4).map(share).collect();
    assert!(shares.iter().all(|share| share.lines().count() > 300));
    assert!(shares.join(",\n") == whole);
    let glb = load(&write("1.glb".into(), "--area 4x3 --shard 1/1")).unwrap().model;
    assert!(glb.parts.iter().all(|part| !part.name.starts_with("ground")));
    assert!(parse("penstemon garden rose --area 4x4 --shard 5/4 -o a.glb").is_err());
    // Of one square 63 of 64 shares have nothing.
    let empty = write("empty.json".into(), "--area 4x4 --shard 1/64");
    assert!(std::fs::read_to_string(empty).unwrap().ends_with("\"plants\":[\n]}\n"));
    assert!(!write("empty.glb".into(), "--area 4x4 --shard 1/64").exists());
}

#[test]
fn a_garden_is_written_in_all_formats_and_no_source_is_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().display();
    let spec = folder.path().join("bed.toml");
    let text =
        "area = \"3x2\"\nspacing = 0.5\nvariants = 2\n[[plants]]\nspecies = \"tulip\"\ntriangles = 500\n";
    std::fs::write(&spec, text).unwrap();
    let line = format!("penstemon garden {here}/bed.toml -o {here}/a.glb -o {here}/a.obj -o {here}/a.json");
    run(&parse(&line).unwrap()).unwrap();
    let list: Value = serde_json::from_slice(&std::fs::read(folder.path().join("a.json")).unwrap()).unwrap();
    let plants = list["plants"].as_array().unwrap().len();
    assert!((10..30).contains(&plants) && list["kinds"][0]["individuals"].as_array().unwrap().len() == 2);
    let [glb, obj] = ["a.glb", "a.obj"].map(|name| load(&folder.path().join(name)).unwrap().model);
    assert!(glb.triangle_count() == obj.triangle_count() && glb.triangle_count() > 100 * plants);
    let size = |detail: &str| {
        let out = folder.path().join(format!("{detail}.glb"));
        let line =
            format!("penstemon garden peony --area 1x1 --variants 1 --detail {detail} -o {}", out.display());
        run(&parse(&line).unwrap()).unwrap();
        load(&out).unwrap().model.triangle_count()
    };
    assert!(size("reduced") < size("full"));
    let flat = size("billboards");
    assert!(
        flat < size("reduced") && (flat - 12).is_multiple_of(8),
        "{flat}: the ground and two pictures each"
    );
    // A finished model has one individual.
    let models = format!("penstemon garden {here}/a.glb --area 30x30 --spacing 8 -o {here}/b.glb");
    run(&parse(&models).unwrap()).unwrap();
    assert!(
        message(&format!("penstemon garden {here}/a.glb --area 9x9 -o {here}/a.glb")).contains("same file")
    );
}
