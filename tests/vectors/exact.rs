//! Rows computed from the files alone, in exact integers: projector, divider and interpolator in
//! stock words, and the recurrence of cycles.

use std::collections::BTreeMap;

use super::reader::{File, Row};

type Files = BTreeMap<String, File>;

fn get(file: &File, row: &Row, way: &str, name: &str) -> Option<i128> {
    row[file.at(way, name)].map(i128::from)
}

/// Two's complement of a width.
fn wrapped(value: i128, width: u32) -> i64 {
    let spare = 64 - width;
    ((value as i64) << spare) >> spare
}

/// Compares what a row says with what it should.
fn check(file: &File, at: usize, name: &str, expected: Option<i64>) -> Result<(), String> {
    let found = file.rows[at][file.at("out", name)];
    if found != expected {
        return Err(format!("{} row {at}: {name} {found:x?}, exactly {expected:x?}", file.name));
    }
    Ok(())
}

/// Equation 6: start + line · per_line + column · per_column, modulo 2^width.
pub fn projector(files: &Files) -> Result<(), String> {
    let (file, sets) = (&files["projector"], &files["projector_coefficients"]);
    for (at, row) in file.rows.iter().enumerate() {
        let number = |way, name| get(file, row, way, name).ok_or(format!("row {at}: no {name}"));
        let (line, column) = (number("at", "line")?, number("at", "column")?);
        let set = number("in", "set")? as usize;
        if (set == 0) != (at < file.of_scene) {
            return Err(format!("row {at}: set {set}"));
        }
        let coefficients = sets.rows.get(set).ok_or(format!("row {at}: no set {set}"))?;
        for c in file.columns.iter().filter(|c| c.way == "out") {
            let part = |part: &str| {
                let name = format!("{}_{part}", c.name);
                coefficients[sets.at("word", &name)].map(i128::from).ok_or(name)
            };
            let sum = part("start")? + line * part("per_line")? + column * part("per_column")?;
            check(file, at, &c.name, Some(wrapped(sum, c.notation.width)))?;
        }
    }
    for (name, (_, value)) in &file.registers {
        if sets.rows[0][sets.at("word", name)] != Some(*value) || sets.register(name) != *value {
            return Err(format!("{name} of the scene"));
        }
    }
    Ok(())
}

/// Equation 9: the floor of the exact ratio, by the integers' own division.
pub fn divider(files: &Files) -> Result<(), String> {
    let Some(file) = files.get("divider") else { return Ok(()) };
    for (at, row) in file.rows.iter().enumerate() {
        let input = |name: &str| get(file, row, "in", name).ok_or(format!("row {at}: no {name}"));
        let denominator = input("denominator")?;
        let quotient = |axis: &str| -> Result<Option<i128>, String> {
            let numerator = input(&format!("view_{axis}"))?;
            let shift = file.register(&format!("ratio_shift_{axis}"));
            let bits = file.register(&format!("ratio_bits_{axis}"));
            let (up, down) = (shift.max(0) as u32, (-shift).max(0) as u32);
            let quotient = (numerator << up).div_euclid(denominator << down);
            let limit = 1 << (bits - 1);
            Ok((-limit..limit).contains(&quotient).then_some(quotient))
        };
        let met = if denominator > 0 { quotient("x")?.zip(quotient("z")?) } else { None };
        let entry = if met.is_some() {
            0
        } else if denominator > 0 {
            2
        } else {
            1
        };
        check(file, at, "entry", Some(entry))?;
        for (name, eye, quotient) in
            [("entry_x", "eye_x", met.map(|q| q.0)), ("entry_z", "eye_z", met.map(|q| q.1))]
        {
            let width = file.columns[file.at("out", name)].notation.width;
            let place = quotient.map(|q| wrapped(i128::from(file.register(eye)) + q, width));
            check(file, at, name, place)?;
        }
    }
    Ok(())
}

/// `value / 2^places`, to nearest, ties upward.
fn nearest(value: i128, places: u32) -> i128 {
    (2 * value + (1 << places)).div_euclid(2 << places)
}

/// `value / 2^places`, toward zero.
fn truncated(value: i128, places: u32) -> i128 {
    value / (1_i128 << places.min(100))
}

/// Weights and slopes of an axis: of the node before, or of those before and after the nearest.
struct Axis {
    first: i128,
    weights: [i128; 2],
    slopes: [i128; 2],
}

/// The interpolator's memories and registers.
struct Surface<'a> {
    file: &'a File,
    files: &'a Files,
    point: u32,
}

impl Surface<'_> {
    fn node(&self, i: i128, j: i128) -> Result<i128, String> {
        let (columns, rows) = (self.file.register("map_columns"), self.file.register("map_rows"));
        let address = |index: i128, size: i64| match self.file.register("map_edge") {
            2 => index.rem_euclid(size.into()),
            _ => index.clamp(0, i128::from(size) - 1),
        };
        let at = address(j, rows) * i128::from(columns) + address(i, columns);
        let row = self.files["height_memory"].rows.get(at as usize).ok_or("no such node")?;
        row[0].map(i128::from).ok_or("a node of x".into())
    }

    fn table(&self, stem: &str, entry: i128) -> Result<i128, String> {
        let row = self.files[stem].rows.get(entry as usize).ok_or("no such entry")?;
        row[0].map(i128::from).ok_or("an entry of x".into())
    }

    fn axis(&self, place: i128) -> Result<Axis, String> {
        let one = i128::from(self.file.register("weight_one"));
        let (form, shift) =
            (self.file.register("form"), self.file.register("deformation_shift") as u32);
        let (half, mask) = (1_i128 << (self.point - 1), (1_i128 << self.point) - 1);
        let entry = |argument: i128| {
            nearest(argument, self.point - self.file.register("kernel_log2") as u32)
        };
        if form == 3 {
            let before = entry((place + half) & mask);
            let after = (1 << self.file.register("kernel_log2")) - before;
            return Ok(Axis {
                first: ((place + half) >> self.point) - 1,
                weights: [
                    self.table("kernel_weight", before)?,
                    self.table("kernel_weight", after)?,
                ],
                slopes: [self.table("kernel_slope", before)?, -self.table("kernel_slope", after)?],
            });
        }
        let fraction = place & mask;
        let hat = one - fraction;
        let (weight, slope) = match form {
            0 => (
                self.table("kernel_weight", entry(fraction))?,
                self.table("kernel_slope", entry(fraction))?,
            ),
            1 => (
                hat + truncated(self.table("kernel_weight", entry(fraction))? - hat, shift),
                truncated(self.table("kernel_slope", entry(fraction))? + one, shift) - one,
            ),
            _ => (hat, -one),
        };
        Ok(Axis { first: place >> self.point, weights: [weight, 0], slopes: [slope, 0] })
    }

    /// Height and slopes at a place.
    fn at(&self, x: i128, z: i128) -> Result<[i128; 3], String> {
        let round = |product: i128| nearest(product, self.point);
        let lerp = |from: i128, to: i128, weight: i128| from + round((to - from) * weight);
        let (ax, az) = (self.axis(x)?, self.axis(z)?);
        let node = |i: i128, j: i128| self.node(ax.first + i, az.first + j);
        let [surface, slope_x, slope_z] = if self.file.register("form") == 3 {
            let three =
                |[b, c, a]: [i128; 3], w: [i128; 2]| c + round((b - c) * w[0] + (a - c) * w[1]);
            let slope = |[b, c, a]: [i128; 3], s: [i128; 2]| round((c - b) * s[0] + (c - a) * s[1]);
            let (mut along, mut sloped) = ([0; 3], [0; 3]);
            for i in 0..3 {
                let column = [node(i, 0)?, node(i, 1)?, node(i, 2)?];
                along[i as usize] = three(column, az.weights);
                sloped[i as usize] = slope(column, az.slopes);
            }
            [three(along, ax.weights), slope(along, ax.slopes), three(sloped, ax.weights)]
        } else {
            let [h1, h2, h3, h4] = [node(0, 0)?, node(0, 1)?, node(1, 0)?, node(1, 1)?];
            let (west, east) = (lerp(h2, h1, az.weights[0]), lerp(h4, h3, az.weights[0]));
            let (north, south) = (lerp(h3, h1, ax.weights[0]), lerp(h4, h2, ax.weights[0]));
            [
                lerp(east, west, ax.weights[0]),
                round((east - west) * ax.slopes[0]),
                round((south - north) * az.slopes[0]),
            ]
        };
        let scaled = |slope: i128, name: &str| match self.file.registers.get(name) {
            Some((_, scale)) => round(slope * i128::from(*scale)),
            None => slope,
        };
        Ok([surface, scaled(slope_x, "slope_scale_x"), scaled(slope_z, "slope_scale_z")])
    }
}

/// Equations 14 to 18, from the nodes and tables of the files.
pub fn interpolator(files: &Files) -> Result<(), String> {
    let Some(file) = files.get("interpolator") else { return Ok(()) };
    let point = file.columns[file.at("in", "ground_x")].notation.point;
    let surface = Surface { file, files, point };
    for (at, row) in file.rows.iter().enumerate() {
        let place = get(file, row, "in", "ground_x").zip(get(file, row, "in", "ground_z"));
        if place.is_some() != matches!(get(file, row, "in", "hit"), Some(1 | 2)) {
            return Err(format!("interpolator row {at}: a place where nothing is met, or none"));
        }
        let expected = place.map(|(x, z)| surface.at(x, z)).transpose()?;
        for (k, name) in ["surface", "slope_x", "slope_z"].into_iter().enumerate() {
            let width = file.columns[file.at("out", name)].notation.width;
            check(file, at, name, expected.map(|words| wrapped(words[k], width)))?;
        }
    }
    Ok(())
}

/// Equation 28 as it stands, over whole arrays.
pub fn cycles(files: &Files) -> Result<(), String> {
    let file = &files["cycles"];
    let mut stages = Vec::new();
    for line in file.lines("stage") {
        let words: Vec<&str> = line.split(' ').collect();
        let [name, "work", work, "latency", latency, "depth", depth] = words[..] else {
            return Err(format!("stage {line}"));
        };
        let number = |text: &str| text.parse::<i64>().map_err(|error| format!("{line}: {error}"));
        let work = match work {
            "varies" => {
                let stepper = &files[name];
                let column = stepper.at("out", "work");
                stepper.rows[..stepper.of_scene].iter().map(|row| row[column]).collect()
            }
            _ => vec![Some(number(work)?); file.rows.len()],
        };
        stages.push((format!("take_{name}"), work, number(latency)?, number(depth)? as usize));
    }
    let mut taken = vec![vec![0_i64; file.rows.len()]; stages.len()];
    for item in 0..file.rows.len() {
        let mut arrives = 0;
        for (unit, (name, work, latency, depth)) in stages.iter().enumerate() {
            let work = |item: usize| work[item].ok_or("work of x".to_owned());
            let mut at = arrives;
            if item > 0 {
                at = at.max(taken[unit][item - 1] + work(item - 1)?);
            }
            if item >= *depth && unit + 1 < stages.len() {
                at = at.max(taken[unit + 1][item - depth] + 1);
            }
            taken[unit][item] = at;
            arrives = at + work(item)? - 1 + latency;
            check(file, item, name, Some(at))?;
        }
    }
    Ok(())
}
