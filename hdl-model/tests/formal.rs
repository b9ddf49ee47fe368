//! Formal proofs about the RTL, in `formal/` (hdl-model/README.md, Proofs).
//!
//! Each has a twin, the RTL with one change, for which it must fail; and cases that must be possible
//! under its assumptions.

mod proof;

use std::collections::BTreeSet;

use proof::{Proof, Twin, yosys};
use terraline_hdl::netlist::yosys::{missing, read, sources};
use terraline_hdl::skipped_without;

/// A harness over modules without registers.
fn combinational<'a>(
    harness: &'a str,
    modules: &'a [&'a str],
    parameters: &'a [(&'a str, i64)],
) -> Proof<'a> {
    Proof { harness, modules, parameters, bound: None, cycles: None }
}

#[test]
fn divider_stage_is_a_step_of_a_long_division() {
    if skipped_without(missing()) {
        return;
    }
    for width in [32, 64] {
        let parameters = [("W", width)];
        let proof = combinational("divider_stage_formal", &["divider_stage"], &parameters);
        proof.holds(3, &["cover_one", "cover_minus_d"]);
        proof.fails_with(("divider_stage", "numerator_bit, 1'b1}", "numerator_bit, 1'b0}"));
        proof.fails_with(("divider_stage", "= !next[W]", "= !remainder[W]"));
    }
}

/// Bits of a, bits of b, whether b is signed.
type Shape = (i64, i64, i64);

const PRODUCT: Proof = Proof {
    harness: "product_formal",
    modules: &["product", "partial_sum"],
    parameters: &[],
    bound: None,
    cycles: Some(2),
};

const PARTIAL_SUM: Proof = Proof { harness: "partial_sum_formal", cycles: None, ..PRODUCT };

fn parameters((a, b, signed): Shape) -> [(&'static str, i64); 3] {
    [("A", a), ("B", b), ("SIGNED", signed)]
}

#[test]
fn products_are_products() {
    if skipped_without(missing()) {
        return;
    }
    let mut products = BTreeSet::new();
    let mut sums = BTreeSet::new();
    for wide in [0, 1] {
        for (terrain, stretch) in [(0, 0), (1, 0), (1, 1)] {
            let (found, found_sums) = multipliers(wide, terrain, stretch);
            products.extend(found);
            sums.extend(found_sums);
        }
    }
    // Heights, slopes and their scale, in narrow and wide words.
    for shape in [(32, 21, 0), (32, 23, 1), (32, 32, 1), (64, 25, 0), (64, 27, 1), (64, 64, 1)] {
        assert!(products.contains(&shape), "the machine has multipliers {shape:?}: {products:?}");
    }
    // Whatever a proof assumes of a smaller partial sum is shown of it.
    for &(a, b, signed) in products.iter().chain(&sums) {
        let halves = [(a, b / 2, 0), (a, b - b / 2, signed)];
        let parts = if products.contains(&(a, b, signed)) {
            halves
                .iter()
                .flat_map(|&(a, b, signed)| [(a, b / 2, 0), (a, b - b / 2, signed)])
                .collect()
        } else if b == 1 || b == 2 && signed == 1 {
            vec![]
        } else {
            halves.to_vec()
        };
        assert!(parts.iter().all(|part| sums.contains(part)), "parts of {b} bits");
    }
    for &shape in &sums {
        Proof { parameters: &parameters(shape), ..PARTIAL_SUM }.holds(1, &["cover_ends"]);
    }
    for &shape in &products {
        Proof { parameters: &parameters(shape), ..PRODUCT }.holds(1, &["cover_ends"]);
    }
    println!("{} multipliers, {} partial sums", products.len(), sums.len());
}

#[test]
fn wrong_products_are_found() {
    if skipped_without(missing()) {
        return;
    }
    let join = "((A + B)'(part_1) <<< B0)";
    let no_sign = "((A + B)'($unsigned(part_1)) <<< B0)";
    let join_halves = "{{HIGH{low[A+LOW-1]}}, low[A+LOW-1:LOW]}, low[LOW-1:0]}";
    let unsigned = "{{HIGH{1'b0}}, low[A+LOW-1:LOW]}, low[LOW-1:0]}";
    let twins: [(&str, Shape, Twin); 6] = [
        ("product_formal", (32, 21, 0), ("product", join, no_sign)),
        ("product_formal", (64, 64, 1), ("product", ".SIGNED(SIGNED)", ".SIGNED(0)")),
        ("partial_sum_formal", (32, 11, 1), ("partial_sum", join_halves, unsigned)),
        ("partial_sum_formal", (64, 32, 1), ("partial_sum", ".b(b[B-1:LOW])", ".b(b[HIGH-1:0])")),
        ("partial_sum_formal", (32, 1, 0), ("partial_sum", "{a[A-1], a} &", "{1'b0, a} &")),
        ("partial_sum_formal", (32, 2, 1), ("partial_sum", "one - two", "one + two")),
    ];
    for (harness, shape, twin) in twins {
        let proof = if harness == PRODUCT.harness { PRODUCT } else { PARTIAL_SUM };
        Proof { parameters: &parameters(shape), ..proof }.fails_with(twin);
    }
}

/// Shapes of all multipliers and partial sums of a machine, as Yosys elaborates it.
fn multipliers(wide: i64, terrain: i64, stretch: i64) -> (BTreeSet<Shape>, BTreeSet<Shape>) {
    let machine =
        format!("-chparam WIDE {wide} -chparam TERRAIN {terrain} -chparam STRETCH {stretch}");
    let sources = read(&sources().expect("sources"), "terraline", &[]);
    let (done, text) = yosys(&format!("{sources}hierarchy -check -top terraline {machine}"));
    assert!(done, "Yosys elaborates the machine:\n{text}");
    let mut found = [("product", BTreeSet::new()), ("partial_sum", BTreeSet::new())];
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        // Each instance: a heading, its parameters, the module that they make.
        let Some((_, module)) = line.split_once("pre-parsed AST for module `\\") else { continue };
        let module = module.trim_end_matches("'.");
        let Some((_, shapes)) = found.iter_mut().find(|(name, _)| *name == module) else {
            continue;
        };
        let (mut a, mut b, mut signed) = (32, if module == "product" { 22 } else { 8 }, 0);
        if module == "product" {
            signed = 1;
        }
        while let Some(line) = lines.next_if(|line| line.starts_with("Parameter ")) {
            let (name, value) = line["Parameter ".len()..].split_once(" = ").expect("a value");
            let value = value.parse().expect("a number");
            match name.trim_start_matches('\\') {
                "A" => a = value,
                "B" => b = value,
                "SIGNED" => signed = value,
                other => panic!("a parameter {other} of a multiplier"),
            }
        }
        shapes.insert((a, b, signed));
    }
    let [(_, products), (_, sums)] = found;
    (products, sums)
}

#[test]
fn steps_cover_at_most_their_cells() {
    if skipped_without(missing()) {
        return;
    }
    for (width, point) in [(32, 20), (64, 24)] {
        let parameters = [("W", width), ("POINT", point)];
        let modules = ["leading_one", "ray_step"];
        let proof = combinational("ray_step_formal", &modules, &parameters);
        proof.holds(4, &["cover_right", "cover_left", "cover_longest"]);
        proof.fails_with(("ray_step", "half + $signed", "to_right + $signed"));
        proof.fails_with(("leading_one", "left = upper;", "left = left;"));
    }
}

/// Proves the bounds of some levels.
fn bounds_cover_their_reach(cell_bits: i64, levels: impl Iterator<Item = i64>) {
    if skipped_without(missing()) {
        return;
    }
    for level in levels {
        let parameters = [("CELL", cell_bits), ("LEVEL", level)];
        let proof = combinational("pyramid_axis_formal", &["pyramid_axis"], &parameters);
        let twins = [
            ("pyramid_axis", "C'(cell_index) + size < 0", "C'(cell_index) < 0"),
            ("pyramid_axis", "beginning >= edge_cell + size", "beginning >= edge_cell"),
            ("pyramid_axis", "CELL'(block) + CELL'(1)", "CELL'(block)"),
            ("pyramid_axis", "stored = CELL'(last)", "stored = CELL'(last) + CELL'(1)"),
        ];
        if level == 2 {
            // All of these need a map that is greater than its blocks.
            proof.holds(4, &["cover_none", "cover_margin", "cover_reached", "cover_edge"]);
            for twin in twins {
                proof.fails_with(twin);
            }
        } else {
            proof.holds(4, &["cover_edge"]);
        }
    }
}

#[test]
fn narrow_bounds_cover_a_jumps_reach() {
    bounds_cover_their_reach(12, 0..=11);
}

#[test]
fn some_wide_bounds_cover_a_jumps_reach() {
    bounds_cover_their_reach(26, [0, 2, 20].into_iter());
}

#[test]
#[ignore = "a minute and a half"]
fn wide_bounds_cover_a_jumps_reach() {
    bounds_cover_their_reach(26, 0..=20);
}

const STEPPER: Proof = Proof {
    harness: "stepper_formal",
    modules: &[
        "terraline_pkg",
        "leading_one",
        "bisection",
        "next_skip_test",
        "ray_axis",
        "ray_step",
        "ray_end",
        "ray_setup",
        "ray_walk",
        "pyramid_axis",
        "pyramid",
        "skip_test",
        "sample_burst",
        "credit",
        "queue",
        "walk_plan",
        "walk_end",
        "stepper",
    ],
    parameters: &[],
    bound: Some("stepper"),
    cycles: Some(2),
};

#[test]
fn jumps_stay_within_the_remaining_samples() {
    if skipped_without(missing()) {
        return;
    }
    let proof = Proof { parameters: &[("PART", 0), ("JUMP", 4)], ..STEPPER };
    proof.holds(9, &["cover_far", "cover_burst"]);
    // A jump of twice the samples that remain.
    proof.fails_with(("walk_plan", ">= jump_length << 1", ">= jump_length"));
}

#[test]
fn jumps_pass_no_sample_below_the_bound() {
    if skipped_without(missing()) {
        return;
    }
    let proof = Proof { parameters: &[("PART", 1), ("JUMP", 4)], cycles: Some(1), ..STEPPER };
    proof.holds(3, &["cover_jump"]);
    proof.fails_with(("skip_test", "(place_y >= bound && ahead_y >= bound)", "(place_y >= bound)"));
}
