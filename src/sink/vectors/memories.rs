//! The machine's memories as files, one word per address.

use super::text::{Header, Heading, Notation, Sheet, Way, Written};
use super::wires::{FLAG, notation};
use crate::setup::TerrainUnits;
use crate::sink::SinkError;
use crate::sink::folder::NewFolder;
use crate::unit::height_memory::Edge;
use crate::unit::pyramid::Pyramid;
use crate::word::{Complete, Readout, Register, World};

fn heading(name: &str, notation: Notation, meaning: &str) -> Heading {
    Heading { way: Way::Word, name: name.into(), notation, meaning: meaning.into() }
}

fn header(stem: &str, holds: &'static str, address: &str, columns: Vec<Heading>) -> Header {
    Header {
        stem: stem.into(),
        holds,
        lines: vec![format!("address {address}")],
        registers: Vec::new(),
        columns,
        rows: 0,
        corner_cases: 0,
    }
}

/// Writes memories, a file each.
struct Memories<'a, W: World> {
    world: &'a W,
    folder: &'a NewFolder,
    scene: &'a [String],
    written: Vec<Written>,
}

impl<W: World> Memories<'_, W> {
    fn put(
        &mut self,
        mut header: Header,
        rows: usize,
        row: impl Fn(usize) -> Vec<Option<i64>>,
    ) -> Result<(), SinkError> {
        header.rows = rows as u64;
        let mut sheet = Sheet::begin(self.folder, self.scene, &header)?;
        for at in 0..rows {
            sheet.row(row(at))?;
        }
        self.written.push(sheet.finish()?);
        Ok(())
    }

    /// A memory with one word a row.
    fn words<T: Readout>(
        &mut self,
        (stem, holds, address): (&str, &'static str, &str),
        (name, register, meaning): (&str, Register, &'static str),
        words: &[T],
    ) -> Result<(), SinkError> {
        let column = heading(name, notation(self.world, register), meaning);
        let header = header(stem, holds, address, vec![column]);
        self.put(header, words.len(), |at| vec![words[at].raw()])
    }
}

/// Writes the memories of a height map's machine.
///
/// # Errors
/// If a file cannot be written.
pub fn write<W: Complete>(
    world: &W,
    units: &TerrainUnits<W>,
    folder: &NewFolder,
    scene: &[String],
) -> Result<Vec<Written>, SinkError> {
    let mut memories = Memories { world, folder, scene, written: Vec::new() };
    let heights = &*units.interpolator.heights;
    let (columns, rows) = (heights.columns(), heights.rows());
    let address = format!("row * {columns} + column; {columns} columns, {rows} rows");
    memories.words(
        ("height_memory", "nodes of the map, north row first", &address),
        ("node", Register::Node, "height above the lowest node"),
        heights.nodes(),
    )?;
    if heights.has_voids() {
        let column = heading("void", FLAG, "1 for a node without data");
        let header = header("void_bits", "nodes without data", &address, vec![column]);
        memories.put(header, heights.nodes().len(), |at| {
            let at = at as i32;
            vec![Some(heights.any_void(at % columns, at / columns, 1).into())]
        })?;
    }
    if let Some(pyramid) = &units.stepper.pyramid {
        put_pyramid(&mut memories, pyramid, heights.edge())?;
    }
    if let Some(rom) = &units.interpolator.rom {
        let address = format!("entry; {} entries a cell", 1_u32 << rom.log2());
        memories.words(
            ("kernel_weight", "weights of the kernel", &address),
            ("weight", Register::Weight, "weight of the node before the place"),
            rom.weights().entries(),
        )?;
        memories.words(
            ("kernel_slope", "derivatives of the weights", &address),
            ("weight_slope", Register::WeightSlope, "derivative, per cell"),
            rom.slopes().entries(),
        )?;
    }
    if let Some(light) = &units.shader.light {
        let address = format!("entry; {} entries a unit", 1_u32 << light.rsqrt.log2());
        memories.words(
            ("rsqrt", "reciprocal square roots", &address),
            ("rsqrt", Register::Shade, "one over the root of entry / entries"),
            light.rsqrt.entries(),
        )?;
    }
    let channel = notation(world, Register::Channel);
    let segments = &units.shader.ramp.segments;
    let names = ["red", "green", "blue"];
    let columns = names.iter().flat_map(|name| {
        [
            heading(&format!("{name}_start"), channel, "channel where the segment starts"),
            heading(&format!("{name}_rise"), channel, "what it rises by over the segment"),
        ]
    });
    let header = header("ramp_segments", "segments of the ramp", "segment", columns.collect());
    memories.put(header, segments.len(), |at| {
        segments[at].iter().flat_map(|(start, rise)| [start.raw(), rise.raw()]).collect()
    })?;
    Ok(memories.written)
}

fn put_pyramid<W: World<Height: Readout>>(
    memories: &mut Memories<'_, W>,
    pyramid: &Pyramid<W::Height>,
    edge: Edge,
) -> Result<(), SinkError> {
    let column = heading("bound", notation(memories.world, Register::Node), "no surface is higher");
    let first = if edge == Edge::Ends { -1 } else { 0 };
    let address = format!(
        "level's offset + (row of blocks - first) * level's columns + column of blocks - first; \
         first {first}"
    );
    let holds = "bounds of blocks, all levels one after the other";
    let mut header = header("pyramid", holds, &address, vec![column]);
    for level in 0..=pyramid.top() {
        let (offset, columns, rows) = pyramid.level(level);
        header.lines.push(format!("level {level} offset {offset} columns {columns} rows {rows}"));
    }
    memories.put(header, pyramid.stored_bounds(), |at| vec![pyramid.at(at as i32).raw()])
}
