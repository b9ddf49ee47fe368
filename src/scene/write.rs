//! A scene as TOML: complete, so that nothing depends on a default, and exact, so that reading it
//! gives the same scene in every bit.

use super::tables::Scene;
use super::writer::Writer;

/// The scene file of a scene. `map` is written as the path of its height map, if it has one that
/// is not built in: give a path that holds from the folder where the file will lie.
///
/// The file reads back as the same scene in every bit if the scene came from a file, or if its
/// angles came from degrees and its directions were normalised as the reader does.
#[must_use]
pub fn toml(scene: &Scene, map: &str) -> String {
    written(scene, map, Writer::default())
}

/// As [`toml()`], with the meaning of every key beside it, the keys that could stand in place of
/// others too, and paragraphs at the top.
#[must_use]
pub fn commented(scene: &Scene, map: &str, top: &[String]) -> String {
    let mut out = Writer::with_comments();
    for paragraph in top {
        out.comment(paragraph);
    }
    out.blank();
    written(scene, map, out)
}

fn written(scene: &Scene, map: &str, mut out: Writer) -> String {
    let mut scene = scene.clone();
    if let Some(terrain) = scene.terrain_mut().filter(|terrain| !terrain.source.is_built_in()) {
        map.clone_into(&mut terrain.source.file);
    }
    scene.write(&mut out);
    out.finish()
}
