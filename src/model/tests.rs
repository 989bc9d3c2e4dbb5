//! Property tests of the whole stage over random plants: outlines of every kind, skeletons that loop and fold back.

use super::*;
use crate::plant::{
    Blade, BladeForm, Branch, Cone, Detail, FinishedPlant, Flower, Organ, OrganPart, Origin, Plant,
    Provenance, RestSurface, Role, Shape, Template, Templates, WoodPart,
};
use glam::{Quat, Vec2};
use proptest::prelude::*;
use std::f32::consts::TAU;

/// A blade's outline in blade lengths, base near the origin.
fn outline() -> impl Strategy<Value = Vec<Vec2>> {
    let smooth = |n: usize, radius: fn(f32, f32, f32) -> f32| {
        (0.004f32..1.2, 0.0f32..1.0, 2.0f32..17.0).prop_map(move |(width, depth, teeth)| {
            let at = |k: usize| {
                let a = TAU * k as f32 / n as f32 - 1.57;
                Vec2::from_angle(a) * Vec2::new(width, 0.5) * radius(a, depth, teeth.round()) + Vec2::Y * 0.5
            };
            (0..n).map(at).collect::<Vec<_>>()
        })
    };
    let notched = (0.05f32..0.6, 0.05f32..0.6, 0.0f32..0.1).prop_map(|(width, notch, slit)| {
        let corner = |x: f32, y| Vec2::new(x * width, y);
        vec![
            corner(0.0, 0.0),
            corner(1.0, 0.5),
            corner(0.8, 1.0),
            corner(slit, 1.0),
            corner(0.0, 1.0 - notch),
        ]
        .into_iter()
        .chain([corner(-slit, 1.0), corner(-0.8, 1.0), corner(-1.0, 0.5)])
        .collect()
    });
    let scribble = prop::collection::vec((-1.0f32..1.0, -0.2f32..1.2), 3..40)
        .prop_map(|points| points.into_iter().map(Vec2::from).collect());
    prop_oneof![
        3 => smooth(90, |_, _, _| 1.0),
        2 => smooth(160, |a, depth, teeth| 1.0 - 0.9 * depth * (a * teeth).cos().abs()),
        2 => smooth(64, |a, depth, _| 1.0 - 0.7 * depth * if ((a * 10.2) as i32) % 2 == 0 { 0.0 } else { 1.0 }),
        2 => notched,
        1 => scribble,
    ]
}

fn form() -> impl Strategy<Value = BladeForm> {
    let bends = (-1.0f32..1.0, -1.0f32..1.0, -2.0f32..2.0, -1.0f32..1.0);
    (bends, 0.0f32..0.3, 0.0f32..40.0, 0.001f32..0.1).prop_map(|(b, ruffle, ruffle_waves, thickness)| {
        BladeForm {
            bend_quartic: b.0,
            twist: 0.0,
            bend_quadratic: b.1,
            cup: b.2,
            fold: b.3,
            ruffle,
            ruffle_waves,
            thickness,
        }
    })
}

fn vector() -> impl Strategy<Value = Vec3> {
    (-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0).prop_map(Vec3::from)
}

fn direction() -> impl Strategy<Value = Vec3> {
    vector().prop_map(|v| v.try_normalize().unwrap_or(Vec3::Y))
}

fn blade() -> impl Strategy<Value = Blade<Arc<Template>>> {
    let rest = prop_oneof![
        Just(None),
        (direction(), 0.2f32..1.4).prop_map(|(axis, opening_rad)| Some((axis, opening_rad)))
    ];
    let pose = (vector(), direction(), 0.0f32..TAU, -2.5f32..0.5);
    (outline(), form(), pose, rest, any::<bool>(), -1.0f32..1.0, 0.5f32..2.0).prop_map(
        |(outline, form, (base, turn, angle, scale), rest, is_reduced, curl, stretch)| {
            let length = 10f32.powf(scale);
            let turn = if rest.is_some() {
                Quat::from_rotation_z(angle)
            } else {
                Quat::from_axis_angle(turn, angle)
            };
            let rest = rest.map_or(RestSurface::Plane, |(axis, opening_rad)| {
                let cone = Cone { apex: base, axis, opening_rad, height: length * opening_rad.cos() };
                RestSurface::Cone { cone, hint: base.z + 0.3 * length, sight: Vec3::Z }
            });
            let curl = (0..outline.len()).map(|k| curl * (k as f32 * 0.1).sin()).collect();
            let outline = outline.into_iter().map(|p| p * length).collect();
            let (u, v) = (turn * Vec3::X * stretch, turn * Vec3::Y);
            let detail = if is_reduced { Detail::Reduced } else { Detail::Full };
            let template = Arc::new(Template::new(outline, curl, length, detail));
            Blade { template, base, u, v, rest, form }
        },
    )
}

fn skeleton() -> impl Strategy<Value = Vec<Vec3>> {
    let walk = prop::collection::vec(vector(), 2..40).prop_map(|steps| {
        let walk = steps.iter().scan(Vec3::ZERO, |at, step| {
            *at += *step * 0.1;
            Some(*at)
        });
        walk.collect()
    });
    let straight = (direction(), 2usize..30).prop_map(|(d, n)| (0..n).map(|k| d * k as f32 * 0.05).collect());
    let upright = (2usize..9).prop_map(|n| (0..n).map(|k| Vec3::Z * k as f32 * 0.1).collect());
    let hairpin =
        (direction(), vector()).prop_map(|(d, off)| vec![Vec3::ZERO, d, d * 0.1 + off * 1e-3, d * 2.0]);
    let spiral = (0.005f32..0.5, 0.0f32..0.2, 4usize..80).prop_map(|(radius, rise, n)| {
        let at =
            |k: usize| (Vec2::from_angle(k as f32 * 0.4) * radius).extend(rise * k as f32 + k as f32 * 1e-4);
        (0..n).map(at).collect()
    });
    prop_oneof![walk, straight, upright, hairpin, spiral].prop_map(|mut points: Vec<Vec3>| {
        points.dedup();
        if points.len() < 2 {
            points = vec![Vec3::ZERO, Vec3::X];
        }
        points
    })
}

fn branch() -> impl Strategy<Value = Branch> {
    (skeleton(), vector(), -4.0f32..0.0, 0.01f32..1.2).prop_map(|(points, base, thick, taper)| {
        let mut points: Vec<Vec3> = points.into_iter().map(|p| p + base).collect();
        points.dedup();
        let share = |k: usize| k as f32 / points.len() as f32;
        let radii = (0..points.len()).map(|k| 10f32.powf(thick) * (1.0 + (taper - 1.0) * share(k))).collect();
        Branch {
            origin: Origin::Generated,
            parent: None,
            level: 0,
            points,
            radii,
            role: Role::of(WoodPart::Stem),
        }
    })
}

fn solid() -> impl Strategy<Value = (Role<OrganPart>, Shape)> {
    let size = (0.01f32..0.5, 0.01f32..0.5);
    let dome = (vector(), direction(), size.clone()).prop_map(|(base, axis, (radius, height))| {
        (Role::of(OrganPart::Disc), Shape::Dome { base, axis, radius, height })
    });
    let thread = (skeleton(), 0.001f32..0.02, size, 0u32..2).prop_map(|(points, radius, head, variant)| {
        let head = Vec2::from(head) * 0.1;
        let role = Role { variant, ..Role::of(OrganPart::Stamen) };
        (role, Shape::Filament { points, radius, head })
    });
    let profile = prop::collection::vec((0.0f32..1.0, 0.0f32..1.0), 3..9);
    let pot = (vector(), direction(), profile).prop_map(|(base, axis, profile)| {
        (
            Role::of(OrganPart::Pot),
            Shape::Lathe { base, axis, profile: profile.into_iter().map(Vec2::from).collect() },
        )
    });
    prop_oneof![dome, thread, pot]
}

fn plant() -> impl Strategy<Value = FinishedPlant> {
    let branches = prop::collection::vec(branch(), 1..6);
    let blades = prop::collection::vec((blade(), prop::option::of(vector())), 0..10);
    (branches, blades, prop::collection::vec(solid(), 0..5)).prop_map(|(mut branches, blades, solids)| {
        for (i, branch) in branches.iter_mut().enumerate() {
            branch.parent = i.checked_sub(2);
            branch.level = i as u32 / 2;
        }
        let mut templates = Templates::default();
        let blades = blades.into_iter().map(|(blade, copy)| {
            let template = templates.add(blade.template.clone());
            let copy = copy.map(|base| Blade { base, ..blade.with_template(template) });
            [Some(blade.with_template(template)), copy]
        });
        let blades: Vec<Blade> = blades.flatten().flatten().collect();
        let blades = blades.into_iter().map(|b| (Role::of(OrganPart::Petal), Shape::Blade(b)));
        let organs = blades.chain(solids).enumerate().map(|(i, (role, shape))| Organ {
            role,
            origin: Origin::Generated,
            branch: (i % 3 == 0).then_some(0),
            flower: (i % 3 == 1).then_some(i % 2),
            shape,
        });
        let cone = Cone { apex: Vec3::ZERO, axis: Vec3::Y, opening_rad: 0.7, height: 0.1 };
        let flower = |branch| Flower {
            origin: Origin::Generated,
            branch,
            cone,
            centre_radius: 0.01,
            reach: 0.1,
            look: 0,
        };
        FinishedPlant::plain(Plant {
            organs: organs.collect(),
            branches,
            flowers: vec![flower(Some(0)), flower(None)],
            templates,
        })
    })
}

fn check(model: &Model) -> Result<(), String> {
    model.check_invariants()?;
    let model = model.flattened();
    let mut names = std::collections::BTreeSet::new();
    for (i, part) in model.parts.iter().enumerate() {
        let here = |what: String| format!("{}: {what}", part.name);
        part.mesh.check_invariants().map_err(here)?;
        let in_picture = |uv: Vec2| uv.cmpge(Vec2::ZERO).all() && uv.cmple(Vec2::ONE).all();
        if part.kind != PartKind::Wood && !part.mesh.vertices.iter().all(|v| in_picture(v.uv)) {
            return Err(here("uv outside the picture".into()));
        }
        if !names.insert(&part.name) {
            return Err(here("name is not unique".into()));
        }
        if part.parent.is_some_and(|p| p >= i || model.parts[p].specimen != part.specimen) {
            return Err(here("parent".into()));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn any_plant_becomes_sound_meshes(plant in plant()) {
        prop_assert_eq!(plant.check_invariants(), Ok(()));
        prop_assert_eq!(check(&build(&plant, &ModelParams::default())), Ok(()));
        let mut single = ModelParams::default();
        single.blade.gathered = false;
        let (model, one) = (build(&plant, &single), build(&plant, &ModelParams::default()));
        prop_assert_eq!(check(&one), Ok(()));
        prop_assert_eq!((one.check_invariants(), one.triangle_count()), (Ok(()), model.triangle_count()));
        let mut apart = ModelParams::default();
        apart.tube.joined = false;
        let model = build(&plant, &apart);
        prop_assert_eq!(check(&model), Ok(()));
        for i in 0..plant.branches.len() {
            prop_assert_eq!(&model.parts[i].name, &format!("branch_{i}"));
        }
    }

    #[test]
    fn threads_change_nothing(plant in plant()) {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| format!("{:?}", build(&plant, &ModelParams::default())))
        };
        prop_assert_eq!(with(1), with(8));
    }

    #[test]
    fn a_cache_changes_nothing_and_keeps_what_is_equal(plants in prop::collection::vec(plant(), 1..4)) {
        let (params, mut cache) = (ModelParams::default(), Cache::default());
        for plant in plants.iter().chain(&plants) {
            let kept = rebuild(plant, &params, &mut cache, &|| false);
            let kept = kept.ok_or_else(|| TestCaseError::fail("nobody stopped it"))?;
            prop_assert_eq!(&kept, &build(plant, &params));
            let again = rebuild(plant, &params, &mut cache, &|| false);
            let again = again.ok_or_else(|| TestCaseError::fail("nobody stopped it"))?;
            for (a, b) in kept.parts.iter().zip(&again.parts) {
                prop_assert!(Arc::ptr_eq(&a.mesh, &b.mesh), "{} was made again", a.name);
            }
            let mut moved = (**plant).clone();
            moved.branches[0].radii[0] *= 1.5;
            moved.organs.truncate(plant.organs.len() / 2);
            moved.drop_unused_templates();
            let moved = FinishedPlant::plain(moved);
            let next = rebuild(&moved, &params, &mut cache, &|| false);
            prop_assert_eq!(next, Some(build(&moved, &params)));
        }
    }

    #[test]
    fn ordinary_outlines_always_become_blades(blade in blade()) {
        let template = &blade.template;
        let area = crate::geom::simple_loop::signed_area(template.outline().iter().copied());
        prop_assume!(area > 1e-3 * template.length() * template.length());
        let waves = flat::waves_of(&blade.form);
        let flat = flat::flatten(
            template,
            waves,
            &BladeMeshParams::default(),
            &mut flat::FlatScratch::default(),
        );
        prop_assert!(flat.is_some());
    }
}

#[test]
fn a_fruit_that_was_kept_is_made_again_when_many_join_it() {
    let profile =
        [(0.0, 0.0), (0.02, 0.01), (0.03, 0.03), (0.02, 0.05), (0.0, 0.06)].map(Vec2::from).to_vec();
    let fruit = |k: usize| Organ {
        role: Role::of(OrganPart::Fruit),
        origin: Provenance::default().record(Some(7)),
        branch: None,
        flower: None,
        shape: Shape::Lathe { base: Vec3::X * k as f32, axis: Vec3::Y, profile: profile.clone() },
    };
    let fruits =
        |count| FinishedPlant::plain(Plant { organs: (0..count).map(fruit).collect(), ..Plant::default() });
    let (params, mut cache) = (ModelParams::default(), Cache::default());
    for plant in [fruits(2), fruits(400), fruits(2)] {
        let kept = rebuild(&plant, &params, &mut cache, &|| false);
        assert_eq!(kept, Some(build(&plant, &params)));
    }
}

#[test]
fn filaments_of_a_flower_are_gathered_by_material() {
    let stamen = |x: f32, variant| Organ {
        role: Role { variant, ..Role::of(OrganPart::Stamen) },
        origin: Origin::Generated,
        branch: None,
        flower: Some(0),
        shape: Shape::Filament {
            points: vec![Vec3::X * x, Vec3::X * x + Vec3::Y],
            radius: 0.02,
            head: Vec2::new(0.05, 0.1),
        },
    };
    let cone = Cone { apex: Vec3::ZERO, axis: Vec3::Y, opening_rad: 0.7, height: 0.1 };
    let plant = FinishedPlant::plain(Plant {
        flowers: vec![Flower {
            origin: Origin::Generated,
            branch: None,
            cone,
            centre_radius: 0.1,
            reach: 1.0,
            look: 0,
        }],
        organs: vec![stamen(0.0, 1), stamen(1.0, 1), stamen(2.0, 0)],
        ..Plant::default()
    });
    let mut params = ModelParams::default();
    params.blade.gathered = false;
    let model = build(&plant, &params);
    let names: Vec<&str> = model.parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["stamens_0", "anthers_0"]);
    assert!(model.parts.iter().all(|p| p.specimen == 0));
    assert_eq!(check(&model), Ok(()));
}

/// A trunk with two flowers on it, each of two sepals, a disc and two stamens of two materials; `petal` gives the first
/// of them a petal that this stroke drew.
fn flowering(petal: Option<u64>) -> FinishedPlant {
    let cone = Cone { apex: Vec3::Y, axis: Vec3::Y, opening_rad: 0.7, height: 0.1 };
    let flower = |_| Flower {
        origin: Origin::Generated,
        branch: Some(0),
        cone,
        centre_radius: 0.01,
        reach: 0.1,
        look: 0,
    };
    let outline = vec![Vec2::ZERO, Vec2::new(0.02, 0.05), Vec2::new(0.0, 0.1), Vec2::new(-0.02, 0.05)];
    let mut templates = Templates::default();
    let template = templates.add(Template::new(outline, Vec::new(), 0.1, Detail::Reduced));
    let blade = |x: f32| {
        let (base, rest) = (Vec3::new(x, 1.0, 0.0), RestSurface::Plane);
        let form = BladeForm::default();
        Shape::Blade(Blade { template, base, u: Vec3::X, v: Vec3::Y, rest, form })
    };
    let stamen = |x: f32| Shape::Filament {
        points: vec![Vec3::new(x, 1.0, 0.0), Vec3::new(x, 1.1, 0.0)],
        radius: 0.002,
        head: Vec2::new(0.005, 0.01),
    };
    let mut organs = Vec::new();
    for index in 0..2 {
        let x = index as f32;
        let disc = Shape::Dome { base: Vec3::new(x, 1.0, 0.0), axis: Vec3::Y, radius: 0.01, height: 0.01 };
        let shapes = [
            (Role::of(OrganPart::Disc), disc),
            (Role::of(OrganPart::Sepal), blade(x + 0.2)),
            (Role::of(OrganPart::Sepal), blade(x + 0.4)),
            (Role::of(OrganPart::Stamen), stamen(x + 0.6)),
            (Role { variant: 1, ..Role::of(OrganPart::Stamen) }, stamen(x + 0.8)),
        ];
        let organ = |(role, shape)| Organ {
            role,
            origin: Origin::Generated,
            branch: Some(0),
            flower: Some(index),
            shape,
        };
        organs.extend(shapes.map(organ));
    }
    if let Some(stroke) = petal {
        let role = Role::of(OrganPart::Petal);
        let drawn = Organ {
            role,
            origin: Provenance::default().record(Some(stroke)),
            shape: blade(0.1),
            ..organs[0].clone()
        };
        organs.push(drawn);
    }
    let branch = Branch {
        origin: Origin::Generated,
        parent: None,
        level: 0,
        points: vec![Vec3::ZERO, Vec3::Y],
        radii: vec![0.02; 2],
        role: Role::of(WoodPart::Stem),
    };
    FinishedPlant::plain(Plant {
        branches: vec![branch],
        flowers: (0..2).map(flower).collect(),
        organs,
        templates,
    })
}

fn part_names(model: &Model) -> Vec<&str> {
    model.parts.iter().map(|part| part.name.as_str()).collect()
}

#[test]
fn organs_that_nobody_drew_are_one_part_of_each_kind() {
    let mut params = ModelParams::default();
    params.blade.gathered = true;
    let model = build(&flowering(None), &params);
    assert_eq!(part_names(&model), ["wood", "receptacles", "sepals", "stamens", "anthers"]);
    assert_eq!(check(&model), Ok(()));
    let anthers = &model.parts[4];
    assert_eq!(anthers.material_slots().count(), 2);
    assert!(model.parts[1..].iter().all(|part| part.parent == Some(0) && part.pivot == Vec3::ZERO));
    let apart = build(&flowering(None), &ModelParams::default());
    assert_eq!(model.triangle_count(), apart.triangle_count());
}

#[test]
fn a_flower_that_was_drawn_keeps_its_parts() {
    let mut params = ModelParams::default();
    params.blade.gathered = true;
    let model = build(&flowering(Some(7)), &params);
    let of_the_drawn = ["receptacles_0", "sepals_0", "stamens_0", "anthers_0"];
    let of_the_other = ["receptacles", "sepals", "stamens", "anthers"];
    let names: Vec<&str> = [&["wood"], &of_the_drawn[..], &of_the_other, &["petal_0_0"]].concat();
    assert_eq!(part_names(&model), names);
    assert_eq!(check(&model), Ok(()));
}

#[test]
fn fruits_of_one_proportion_are_copies_of_one_shape() {
    let mut plant = Plant::default();
    let fruit = |k: usize| {
        let size = 0.01 + 0.0003 * k as f32;
        let profile = [(0.0, 0.1), (0.5, 0.0), (1.0, 0.9), (0.3, 1.7), (0.0, 1.6)];
        let shape = Shape::Lathe {
            base: Vec3::X * k as f32,
            axis: Vec3::new(0.0, -0.8, 0.6),
            profile: profile.iter().map(|point| Vec2::from(*point) * size).collect(),
        };
        let role = Role::of(OrganPart::Fruit);
        Organ { role, origin: Origin::Generated, branch: None, flower: None, shape }
    };
    plant.organs = (0..60).map(fruit).collect();
    let model = build(&FinishedPlant::plain(plant), &ModelParams::default());
    let copies: Vec<_> = model.parts.iter().filter_map(|part| part.copies.as_ref()).collect();
    // Larger ones have more sides.
    assert!(copies.iter().map(|copies| copies.shapes.len()).sum::<usize>() <= 2);
    assert_eq!(copies.iter().map(|copies| copies.placements.len()).sum::<usize>(), 60);
    let flat = model.flattened();
    flat.parts.iter().for_each(|part| part.mesh.check_invariants().unwrap());
    let points = || flat.parts.iter().flat_map(|part| &part.mesh.points);
    // The last one's widest ring and its lower end.
    let (size, axis) = (0.01 + 0.0003 * 59.0, Vec3::new(0.0, -0.8, 0.6));
    let on = |p: &&Vec3| (p.x - 59.0).abs() < 0.1;
    let along = points().filter(on).map(|p| (*p - Vec3::X * 59.0).dot(axis)).fold(0.0, f32::max);
    assert!((along - 1.7 * size).abs() < 1e-4, "{along}");
}
