//! Height files without a scene: text grids of any extent, height range and place.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

fn power(range: std::ops::Range<f64>) -> BoxedStrategy<f64> {
    range.prop_map(|exponent| 10.0_f64.powf(exponent)).boxed()
}

/// The text of a grid. Its heights are `base + range * noise`; some nodes have no data.
pub fn grids() -> BoxedStrategy<String> {
    let edges = select(vec![0.0, 1e-40, -1e9, 1e9, 1.6e7, 3.4e38, -3.4e38, 1e-9]);
    let base = prop_oneof![4 => -400.0..9000.0_f64, 1 => edges];
    let range = prop_oneof![1 => Just(0.0), 6 => 0.0..3000.0_f64, 2 => power(-9.0..12.0)];
    let noise = vec(prop_oneof![12 => (-1.0..1.0_f64).prop_map(Some), 1 => Just(None)], 1..60);
    let cell = prop_oneof![
        2 => select(vec!["30", "0.000277777777", "0.008333333333", "1"]).prop_map(str::to_owned),
        1 => power(-9.0..12.0).prop_map(|cell| format!("{cell:e}")),
    ];
    let corner = prop_oneof![3 => -180.0..180.0_f64, 1 => -1e7..1e7, 1 => Just(0.0)];
    let corners = (corner.clone(), corner);
    (prop_oneof![4 => 2..14_usize, 1 => 1..3_usize], 1..14_usize, base, range, noise, cell, corners)
        .prop_map(|(columns, rows, base, range, noise, cell, (x, y))| {
            let mut text = format!(
                "ncols {columns}\nnrows {rows}\nxllcorner {x}\nyllcorner {y}\ncellsize {cell}\n\
                 NODATA_value -32768\n"
            );
            let height = |at: usize| match noise[at * at % noise.len()] {
                Some(noise) => format!("{:e}", base + range * noise),
                None => "-32768".to_owned(),
            };
            for row in 0..rows {
                let row: Vec<String> = (0..columns).map(|i| height(row * columns + i)).collect();
                text += &format!("{}\n", row.join(" "));
            }
            text
        })
        .boxed()
}
