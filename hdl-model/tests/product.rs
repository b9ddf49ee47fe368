//! The shift-and-add multiplier.
#![cfg(rtl)]

use proptest::prelude::*;
use terraline_hdl::{Model, Port};

/// A model of `product`: name, bits of a and b, whether b is signed.
type Shape = (&'static str, u32, u32, bool);

const SHAPES: [Shape; 4] = [
    ("product_32_21", 32, 21, false),
    ("product_32_23", 32, 23, true),
    ("product_64_25", 64, 25, false),
    ("product_64_64", 64, 64, true),
];

struct Bench {
    rtl: Model,
    a: Port,
    b: Port,
    result: Port,
    width: u32,
}

impl Bench {
    fn new((name, a, b, _): Shape) -> Self {
        let rtl = Model::new(name);
        let [port_a, port_b, result] = ["a", "b", "result"].map(|name| rtl.port(name));
        Self { rtl, a: port_a, b: port_b, result, width: a + b }
    }

    /// The bits of the product.
    fn of(&mut self, a: i64, b: i64) -> u128 {
        self.rtl.set_signed(self.a, a);
        self.rtl.set_signed(self.b, b);
        self.rtl.edge();
        let low = u128::from(self.rtl.part(self.result, 0));
        let high = if self.width > 64 { self.rtl.part(self.result, 1) } else { 0 };
        u128::from(high) << 64 | low
    }
}

/// The low bits of a word, as a number.
fn cut(word: i64, bits: u32, signed: bool) -> i64 {
    let spare = 64 - bits;
    if signed { word << spare >> spare } else { ((word as u64) << spare >> spare) as i64 }
}

fn exact(a: i64, b: i64, width: u32) -> u128 {
    let product = i128::from(a) * i128::from(b);
    product as u128 & (u128::MAX >> (128 - width))
}

#[test]
fn every_product_of_small_operands() {
    for shape in [("product_5_5", 5, 5, true), ("product_5_6", 5, 6, false)] {
        let mut bench = Bench::new(shape);
        let (_, a_bits, b_bits, signed) = shape;
        for a in 0..1 << a_bits {
            for b in 0..1 << b_bits {
                let (a, b) = (cut(a, a_bits, true), cut(b, b_bits, signed));
                assert_eq!(bench.of(a, b), exact(a, b, a_bits + b_bits), "{a} · {b}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn products_are_exact(
        shape in prop::sample::select(SHAPES.to_vec()),
        words in prop::collection::vec((any::<i64>(), any::<i64>(), 0..64_u32, 0..64_u32), 500),
    ) {
        let mut bench = Bench::new(shape);
        let (_, a_bits, b_bits, signed) = shape;
        let ends = [0, 1, -1, i64::MIN >> (64 - a_bits), i64::MAX >> (64 - a_bits)];
        let ends = ends.into_iter().flat_map(|a| {
            [0, 1, -1, i64::MIN >> (64 - b_bits), i64::MAX >> (64 - b_bits)].map(|b| (a, b))
        });
        // Small operands, too: their upper bits are all sign.
        let words = words.into_iter().map(|(a, b, few_a, few_b)| (a >> few_a, b >> few_b));
        for (a, b) in ends.chain(words) {
            let (a, b) = (cut(a, a_bits, true), cut(b, b_bits, signed));
            prop_assert_eq!(bench.of(a, b), exact(a, b, a_bits + b_bits), "{} · {}", a, b);
        }
    }
}
