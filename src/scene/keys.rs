//! Every key a scene may have: what is not listed here is an error.

/// Name of a table in messages, and its keys.
pub(super) struct Keys {
    /// Path as `--set` takes it; empty for the top level.
    pub(super) table: &'static str,
    pub(super) keys: &'static [&'static str],
}

pub(super) const SCENE: Keys = Keys {
    table: "",
    keys: &[
        "unit_m", "seed", "camera", "screen", "surface", "kernel", "stepper", "light", "color",
        "machine", "format",
    ],
};

pub(super) const CAMERA: Keys = Keys {
    table: "camera",
    keys: &["position", "offset", "heading", "pitch", "roll", "forward", "up"],
};

pub(super) const SCREEN: Keys = Keys {
    table: "screen",
    keys: &["name", "size", "fov", "distance", "pixel", "center", "mount"],
};

pub(super) const MOUNT: Keys = Keys { table: "screen.mount", keys: &["heading", "pitch", "roll"] };

pub(super) const TERRAIN: Keys = Keys {
    table: "surface",
    keys: &["kind", "map", "encoding", "cell", "height", "outside", "nodata", "base_depth"],
};

pub(super) const HEIGHT: Keys = Keys { table: "surface.height", keys: &["offset", "scale"] };

pub(super) const PLANE: Keys =
    Keys { table: "surface", keys: &["kind", "normal", "distance", "checker"] };

pub(super) const KERNEL: Keys =
    Keys { table: "kernel", keys: &["shape", "deformation", "weight_shift", "table"] };

pub(super) const STEPPER: Keys = Keys { table: "stepper", keys: &["mode", "fineness", "halvings"] };

pub(super) const LIGHT: Keys = Keys { table: "light", keys: &["direction", "ambient"] };

pub(super) const COLOR: Keys =
    Keys { table: "color", keys: &["ramp", "sky", "far", "side", "checker"] };

pub(super) const MACHINE: Keys =
    Keys { table: "machine", keys: &["clock_mhz", "memory_latency", "words", "ratio"] };

/// One entry of `[format]`; the names of the entries are those of the register table.
pub(super) const FORMAT: Keys =
    Keys { table: "format.NAME", keys: &["width", "point", "rounding", "overflow"] };

const ALL: [&Keys; 13] = [
    &SCENE, &CAMERA, &SCREEN, &MOUNT, &TERRAIN, &HEIGHT, &PLANE, &KERNEL, &STEPPER, &LIGHT, &COLOR,
    &MACHINE, &FORMAT,
];

impl Keys {
    pub(super) fn has(&self, key: &str) -> bool {
        self.keys.contains(&key)
    }
}

/// The full path of a key that exists in some table: it may only stand in the wrong place.
pub(super) fn elsewhere(key: &str) -> Option<String> {
    ALL.iter().find(|table| table.has(key)).map(|found| {
        if found.table.is_empty() { key.to_owned() } else { format!("{}.{key}", found.table) }
    })
}
