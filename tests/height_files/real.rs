//! Real elevation models beside the project, where they are there.

use std::path::{Path, PathBuf};

use glam::DVec2;
use terraline::scene::height_map::source;
use terraline::scene::{HeightFile, Interpretation};

use super::skipped::skipped;

/// A file of the collection, or `None` with a printed reason.
fn file(name: &str) -> Option<HeightFile> {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/dem").join(name);
    if !path.exists() {
        skipped(&format!("{} does not exist", path.display()));
        return None;
    }
    Some(source::read(&path, &Interpretation::default()).unwrap_or_else(|error| panic!("{error}")))
}

/// Size, range, voids, cell and EPSG code as the collection documents them.
struct Expected {
    name: &'static str,
    size: (usize, usize),
    range: (f32, f32),
    voids: usize,
    cell: Option<f64>,
    epsg: Option<u16>,
}

const ARC: Option<f64> = Some(1.0 / 1200.0);

#[rustfmt::skip]
const ALL: [Expected; 13] = [
    Expected { name: "bigtujunga_utm11_i16_tiled.tif", size: (1197, 643), range: (315.0, 2295.0), voids: 0, cell: Some(30.0), epsg: Some(32611) },
    Expected { name: "jacksboro_fault_epsg4326_i16_deflate_tiled.tif", size: (403, 344), range: (236.0, 1076.0), voids: 0, cell: ARC, epsg: Some(4326) },
    Expected { name: "jotunheimen_utm32_f32_deflate_pred3_tiled.tif", size: (512, 512), range: (2.186_007_5, 2461.7083), voids: 0, cell: Some(117.1875), epsg: Some(32632) },
    Expected { name: "mt_fuji_srtm3_voids.tif", size: (1201, 1201), range: (-16.0, 3742.0), voids: 2437, cell: ARC, epsg: Some(4326) },
    Expected { name: "st_helens_utm10_i16_lzw_nodata.tif", size: (327, 468), range: (682.0, 2543.0), voids: 4151, cell: Some(30.0), epsg: Some(26710) },
    Expected { name: "zion_srtm_epsg4326_u16_deflate.tif", size: (465, 457), range: (1024.0, 2892.0), voids: 0, cell: ARC, epsg: Some(4326) },
    Expected { name: "N51E001.hgt", size: (1201, 1201), range: (-9.0, 191.0), voids: 0, cell: ARC, epsg: Some(4326) },
    Expected { name: "N53E028.hgt", size: (1201, 1201), range: (134.0, 260.0), voids: 0, cell: ARC, epsg: Some(4326) },
    Expected { name: "colorado_front_range_srtmgl3.asc", size: (144, 144), range: (2186.0, 3345.0), voids: 0, cell: ARC, epsg: None },
    Expected { name: "west_bijou_gully_3m.asc", size: (43, 89), range: (1680.7794, 1725.4326), voids: 2739, cell: Some(3.0), epsg: None },
    Expected { name: "jacksboro_fault_16bit.png", size: (403, 344), range: (236.0, 1076.0), voids: 0, cell: None, epsg: None },
    Expected { name: "jotunheimen_16bit.png", size: (512, 512), range: (58.0, 65315.0), voids: 0, cell: None, epsg: None },
    Expected { name: "st_helens_16bit.png", size: (317, 460), range: (694.0, 2543.0), voids: 0, cell: None, epsg: None },
];

#[test]
fn the_collection_is_what_its_list_says() {
    for expected in &ALL {
        let Some(file) = file(expected.name) else { continue };
        let name = expected.name;
        let (columns, rows) = (file.map.columns(), file.map.rows());
        assert_eq!((columns, rows), expected.size, "{name}");
        assert_eq!(file.map.range(), expected.range, "{name}");
        assert_eq!(file.map.voids(), expected.voids, "{name}");
        assert_eq!(file.georeference.epsg, expected.epsg, "{name}");
        match (file.georeference.cell, expected.cell) {
            (Some(cell), Some(size)) => {
                assert!((cell / size - DVec2::ONE).length() < 1e-6, "{name}: {cell}");
            }
            (None, None) => {}
            (found, _) => panic!("{name}: {found:?}"),
        }
        let metres = file.georeference.cell_m(columns, rows);
        assert_eq!(metres.is_some(), expected.cell.is_some(), "{name}");
    }
}

#[test]
fn the_same_ground_from_two_formats_is_the_same() {
    let (Some(tif), Some(png)) =
        (file("jacksboro_fault_epsg4326_i16_deflate_tiled.tif"), file("jacksboro_fault_16bit.png"))
    else {
        return;
    };
    assert_eq!(tif.map, png.map);
    let cell = tif.georeference.cell_m(403, 344).unwrap();
    assert!((cell - DVec2::new(74.57, 92.47)).length() < 0.01, "{cell}");
}
