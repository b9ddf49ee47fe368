//! Test vectors: files read by their page, every row computed again, and no digit that may differ.

#[path = "vectors/exact.rs"]
mod exact;
#[path = "vectors/grade.rs"]
mod grade;
#[path = "vectors/memories.rs"]
mod memories;
#[path = "vectors/mutation.rs"]
mod mutation;
#[path = "vectors/reader.rs"]
mod reader;
mod scenes;
mod support;

use std::collections::BTreeMap;

use reader::File;
use tempfile::TempDir;
use terraline::engine::FixedWorld;
use terraline::plan::Plan;
use terraline::scene::Scene;
use terraline::sink::vectors::Vectors;
use terraline::sink::vectors::selection::{Choice, Selection};

/// Vectors of a scene in a folder of their own.
struct Written {
    folder: TempDir,
    scene: Scene,
    plan: Plan,
    selection: Selection,
}

impl Written {
    fn new(name: &str, sets: &[&str], full: bool, choice: Choice, corner_cases: u32) -> Self {
        Self::of(support::loaded(name, sets), full, choice, corner_cases, 11)
    }

    fn of(scene: Scene, full: bool, choice: Choice, corner_cases: u32, seed: u64) -> Self {
        let plan = Plan::new(&scene, None, full).expect("a plan");
        let selection = Selection::new(&plan, choice, seed);
        let folder = tempfile::tempdir().expect("a folder");
        let vectors = Vectors {
            machine: &support::machine(&scene, &plan).expect("a machine"),
            selection: &selection,
            corner_cases,
            seed,
            folder: &folder.path().join("vectors"),
        };
        let report = vectors.write().unwrap_or_else(|error| panic!("{}: {error}", scene.name));
        for file in &report.files {
            let path = folder.path().join("vectors").join(&file.file);
            assert_eq!(std::fs::metadata(path).expect("a file").len(), file.bytes);
        }
        Self { folder, scene, plan, selection }
    }

    fn files(&self) -> BTreeMap<String, File> {
        reader::folder(&self.folder.path().join("vectors")).expect("files as the page says")
    }

    fn grade(&self, files: &BTreeMap<String, File>) -> Result<(), String> {
        let (scene, plan, selection) = (&self.scene, &self.plan, &self.selection);
        let machine = support::machine(scene, plan).expect("a machine");
        let stock = !matches!(machine.world(), FixedWorld::Sweep(_));
        machine.run(grade::Grade { scene, plan, selection, files, stock })
    }
}

#[test]
fn every_row_of_every_unit_is_what_the_units_answer() {
    let wrap = "surface.outside=\"wrap\"";
    for (name, sets) in [
        ("overview", vec![]),
        ("flight", vec!["machine.memory_latency=5"]),
        ("valley", vec!["stepper.halvings=7"]),
        ("plane", vec![]),
        ("overview", vec!["kernel.deformation=0"]),
        ("overview", vec!["kernel.deformation=1", "machine.memory_latency=1"]),
        ("overview", vec!["kernel.deformation=1", "kernel.shape=\"parabola\"", wrap]),
        ("flight", vec!["kernel.shape=\"hat\""]),
        ("overview", vec!["machine.words=\"wide\"", wrap]),
        ("overview", vec!["machine.words=\"wide\"", "kernel.deformation=1"]),
        ("plane", vec!["machine.words=\"wide\"", "camera.roll=25"]),
        ("flight", vec!["surface.outside=\"clamp\"", "stepper.mode=\"plain\""]),
        ("overview", vec!["surface.cell=[0.8, 1.25]", "light.ambient=1"]),
        ("overview", vec!["surface.cell=[2, 1]", "kernel.deformation=1"]),
        ("overview", vec!["camera.position=[172, 192, -400]", "camera.pitch=-20"]),
    ] {
        for full in [false, true] {
            let sets = [&sets[..], &["screen.size=[40, 30]"]].concat();
            let written = Written::new(name, &sets, full, Choice::Strips(12), 600);
            let graded = written.grade(&written.files());
            assert_eq!(graded, Ok(()), "{name} {sets:?}, full {full}");
        }
    }
}

#[test]
fn every_kernel_at_every_edge_with_and_without_holes() {
    use terraline::scene::{Outside, WordSize};
    for (at, kernel) in scenes::kernels().enumerate() {
        for outside in [Outside::Sky, Outside::Clamp, Outside::Wrap] {
            let height = |n: usize| match n % 11 {
                3 if at % 2 == 0 => f32::NAN,
                _ => (n * n % 37) as f32 / 7.0,
            };
            let map = scenes::terrain(9, 7, (0..63).map(height).collect());
            let map = scenes::with_outside(map, outside);
            for words in [WordSize::Narrow, WordSize::Wide] {
                let scene = scenes::terrain_scene(map.clone(), kernel, words);
                let written = Written::of(scene, at % 3 == 0, Choice::Pixels(30), 150, 5);
                let graded = written.grade(&written.files());
                assert_eq!(graded, Ok(()), "{kernel:?}, {outside:?}, {words:?}");
            }
        }
    }
}

#[test]
fn a_map_without_surface_has_vectors_without_places() {
    use terraline::scene::WordSize;
    let samples = (0..63).map(|n| if n % 4 == 0 { n as f32 / 9.0 } else { f32::NAN }).collect();
    let kernel = scenes::kernels().next().expect("a kernel");
    let scene = scenes::terrain_scene(scenes::terrain(9, 7, samples), kernel, WordSize::Narrow);
    let written = Written::of(scene, false, Choice::Strips(12), 50, 5);
    let files = written.files();
    assert_eq!(written.grade(&files), Ok(()));
    let hit = files["interpolator"].at("in", "hit");
    assert!(files["interpolator"].rows.iter().all(|row| row[hit] == Some(0)));
}

#[test]
fn coarse_registers_have_vectors_in_their_own_widths() {
    for formats in [
        &["format.ground={ width = 24, point = 12, rounding = \"nearest\", overflow = \"wrap\" }"]
            [..],
        &[
            "format.ground={ width = 23, point = 11, rounding = \"nearest\", overflow = \"saturate\" }",
        ],
        &[
            "format.view={ width = 21, point = 19, rounding = \"nearest\", overflow = \"wrap\" }",
            "format.weight={ width = 13, point = 9, rounding = \"floor\", overflow = \"wrap\" }",
            "format.tone={ width = 19, point = 7, rounding = \"nearest_even\", overflow = \"wrap\" }",
        ],
    ] {
        for name in ["overview", "valley", "plane"] {
            let sets = [formats, &["screen.size=[24, 18]"]].concat();
            let written = Written::new(name, &sets, false, Choice::Strips(18), 400);
            assert_eq!(written.grade(&written.files()), Ok(()), "{name} {sets:?}");
        }
    }
}

#[test]
fn pixels_may_be_chosen_one_by_one() {
    for choice in [Choice::Pixels(1), Choice::Pixels(77), Choice::Pixels(5000), Choice::Lines(3, 5)]
    {
        let sets = ["screen.size=[40, 30]"];
        let written = Written::new("flight", &sets, false, choice, 3);
        let expected = match choice {
            Choice::Pixels(count) => u64::from(count.min(1200)),
            Choice::Lines(from, to) => u64::from(to - from) * 40,
            Choice::Strips(_) => unreachable!("not among them"),
        };
        assert_eq!(written.selection.pixels(), expected);
        assert_eq!(written.grade(&written.files()), Ok(()), "{choice:?}");
    }
}

#[test]
fn a_whole_frame_takes_as_many_cycles_as_are_counted() {
    use terraline::study::error::Sample;
    for name in ["overview", "plane"] {
        let sets = ["screen.size=[40, 30]"];
        let written = Written::new(name, &sets, false, Choice::Strips(30), 0);
        let cycles = &written.files()["cycles"];
        let last = cycles.rows.last().expect("rows")[cycles.at("out", "take_frame")];
        let all = Sample::all(&written.plan);
        let none = Sample { lines: vec![], columns: vec![] };
        let cost = support::machine(&written.scene, &written.plan)
            .and_then(|machine| machine.cost(&all, &none))
            .expect("a cost");
        assert_eq!(last.map(|last| last as u64 + 1), Some(cost.cycles), "{name}");
    }
}

#[test]
fn corner_cases_reach_every_outcome() {
    let outcomes = |name: &str, file: &str, column: (&str, &str)| {
        let written = Written::new(name, &["screen.size=[8, 8]"], false, Choice::Pixels(1), 2000);
        let file = &written.files()[file];
        let at = file.at(column.0, column.1);
        let mut counts = [0; 4];
        for row in &file.rows[file.of_scene..] {
            counts[row[at].expect("an outcome") as usize] += 1;
        }
        counts
    };
    let least = |counts: [usize; 4], least: [usize; 4]| {
        assert!(counts.iter().zip(least).all(|(count, least)| *count >= least), "{counts:?}");
    };
    least(outcomes("overview", "divider", ("out", "entry")), [300, 100, 300, 0]);
    least(outcomes("plane", "checker", ("out", "hit")), [100, 900, 0, 100]);
    least(outcomes("overview", "stepper", ("out", "hit")), [300, 300, 1, 0]);
    least(outcomes("valley", "stepper", ("out", "hit")), [50, 1000, 0, 0]);
    least(outcomes("overview", "interpolator", ("in", "hit")), [0, 1000, 100, 0]);
    least(outcomes("overview", "pixel", ("in", "hit")), [50, 1000, 50, 50]);
}

#[test]
fn the_page_shows_a_file_as_it_is_written() {
    let page = include_str!("../docs/vectors.md");
    let example = page.split("```text\n").nth(1).and_then(|rest| rest.split("```").next());
    let scene = support::loaded("plane", &[]);
    let seed = scene.seed;
    let written = Written::of(scene, false, Choice::Strips(4), 256, seed);
    let text = std::fs::read_to_string(written.folder.path().join("vectors/divider.mem"));
    let text = text.expect("a file");
    let lines: Vec<&str> = text.lines().collect();
    let mut compared = 0;
    for line in example.expect("an example").lines().filter(|line| *line != "...") {
        // These two change with the program's version.
        if !line.starts_with("// program") && !line.starts_with("// crc32") {
            assert!(lines.contains(&line), "not in the file: {line}");
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared} lines");
}
