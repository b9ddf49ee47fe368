//! Where the maps of a scene come from: files, the program, or a reader that has been there before.

use std::path::Path;
use std::sync::Arc;

use super::builtin;
use super::error::nearest;
use super::height_map::{Encoding, HeightMap, MapError, source};
use super::shown::shorten;

/// What the name of a map of the program begins with.
pub(super) const BUILTIN: &str = "builtin:";

/// A map that is in memory already: the scene that names it need not read it again.
#[derive(Clone, Debug)]
pub(super) struct ReadMap {
    /// As the scene names it.
    pub(super) source: String,
    pub(super) encoding: Encoding,
    pub(super) map: Arc<HeightMap>,
}

/// Where maps come from.
#[derive(Clone, Copy)]
pub(super) struct Maps<'a> {
    /// Where relative paths start.
    pub(super) folder: &'a Path,
    pub(super) known: Option<&'a ReadMap>,
}

impl Maps<'_> {
    /// The map that a scene names.
    pub(super) fn load(self, source: &str, encoding: Encoding) -> Result<Arc<HeightMap>, MapError> {
        if let Some(known) = self.known
            && (known.source.as_str(), known.encoding) == (source, encoding)
        {
            return Ok(Arc::clone(&known.map));
        }
        let Some(name) = source.strip_prefix(BUILTIN) else {
            return source::read(&self.folder.join(source), encoding)
                .map(|file| Arc::new(file.map));
        };
        let shown = format!("{BUILTIN}{}", shorten(name));
        if encoding != Encoding::Stored {
            return Err(MapError::new(
                &shown,
                "maps of the program hold heights as they are",
                "leave surface.encoding out",
            ));
        }
        builtin::map(name).unwrap_or_else(|| {
            let guess = nearest(name, builtin::MAPS).unwrap_or(builtin::MAPS[0]);
            Err(MapError::new(
                &shown,
                "the program has no such map",
                format!("use \"builtin:{guess}\" or the path of a height file"),
            ))
        })
    }
}
