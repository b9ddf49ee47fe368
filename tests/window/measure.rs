//! Lengths in metres, places in the coordinates of the file.

use glam::DVec2;
use terraline::scene::height_map::{Coordinates, Georeference};
use terraline::view::measure::Measure;

use super::scene;

#[test]
fn heights_are_those_of_the_samples() {
    let valley = scene("valley", &[]);
    let terrain = valley.terrain().expect("a terrain");
    let metres = Measure::new(&valley, None);
    let sample = f64::from(terrain.map.sample(7, 9));
    assert!((metres.height_m(terrain.node(7, 9)) - sample).abs() < 1e-9);
    // Twice life size: 80 m of a unit are 40 m.
    assert!((metres.rise_m(1.0) - 40.0).abs() < 1e-9);
    assert_eq!(metres.distance_m(2.0), 160.0);
    let feet = Georeference { height_unit_m: Some(0.3048), ..Georeference::unknown() };
    let metres = Measure::new(&valley, Some(&feet));
    assert!((metres.height_m(terrain.node(7, 9)) - 0.3048 * sample).abs() < 1e-9);
    let plane = scene("plane", &["unit_m=3"]);
    assert_eq!(Measure::new(&plane, None).height_m(5.0), 15.0);
}

#[test]
fn places_are_those_of_the_file() {
    let valley = scene("valley", &["surface.cell=[2, 4]"]);
    let file = |coordinates| Georeference {
        coordinates,
        origin: Some(DVec2::new(-0.5, 10.0)),
        cell: Some(DVec2::new(0.25, 0.125)),
        epsg: Some(32_632),
        ..Georeference::unknown()
    };
    // Three nodes east, two south.
    let place = |file: &Georeference| Measure::new(&valley, Some(file)).place(6.0, 8.0);
    let degrees = file(Coordinates::Degrees);
    assert_eq!(place(&degrees).as_deref(), Some("9.75000° N 0.25000° E"));
    let west = Measure::new(&valley, Some(&degrees)).place(0.0, 0.0);
    assert_eq!(west.as_deref(), Some("10.00000° N 0.50000° W"));
    let lengths = file(Coordinates::Lengths { unit_m: 1.0 });
    assert_eq!(place(&lengths).as_deref(), Some("EPSG:32632 east 0.2 north 9.8"));
    assert_eq!(place(&Georeference::unknown()), None);
}
