//! The tally counts what was executed, and changes nothing.

use terraline::word::stock::{Narrow, View32, Wide};
use terraline::word::tally::{Operations, Tally, TallyWord, counted};
use terraline::word::{
    Cell, Divide, Load, Multiply, Ratio, Readout, Register, Rescale, Table, Word, World,
};

use super::site;

type Ground = <Tally<Narrow> as World>::Ground;
type Height = <Tally<Narrow> as World>::Height;
type Weight = <Tally<Narrow> as World>::Weight;
type View = <Tally<Narrow> as World>::View;

const NONE: Operations = Operations { additions: 0, products: 0, ratios: 0, shifts: 0 };

fn additions(additions: u64) -> Operations {
    Operations { additions, ..NONE }
}

fn cost(work: impl FnOnce()) -> Operations {
    counted(work).1
}

fn discard<T>(_: T) {}

#[test]
fn every_operation_has_its_price() {
    let view = |v| View::load(v, ()).unwrap();
    let (a, b) = (view(0.75), view(-0.5));
    let place = Ground::load(-3.3, ()).unwrap();
    let (height, weight) = (Height::load(9.5, ()).unwrap(), Weight::load(0.25, ()).unwrap());

    assert_eq!(cost(|| discard(a + b)), additions(1));
    assert_eq!(cost(|| discard(a - b)), additions(1));
    assert_eq!(cost(|| discard(-a)), additions(1));
    assert_eq!(cost(|| discard(a.is_below(b, site()))), additions(1));
    assert_eq!(cost(|| discard(a.lesser(b))), additions(1));
    assert_eq!(cost(|| discard(a.greater(b))), additions(1));
    assert_eq!(cost(|| discard(a.magnitude())), additions(1));
    assert_eq!(cost(|| discard(place.nearest(site()))), additions(1));
    let table = Table::new(3, vec![weight; 9]);
    assert_eq!(cost(|| discard(place.look_up(&table, site()))), additions(1));
    // One address for all.
    let both = [&table, &table];
    assert_eq!(cost(|| discard(place.look_up_mirrored(both, site()))), additions(1));

    let shift = Operations { shifts: 1, ..NONE };
    let rounded_shift = Operations { additions: 1, ..shift };
    assert_eq!(cost(|| discard(a.shift_floor(3))), shift);
    assert_eq!(cost(|| discard(a.shift_left(3))), shift);
    assert_eq!(cost(|| discard(a.shift_toward_zero(3))), rounded_shift);
    assert_eq!(cost(|| discard::<Ground>(a.rescale(-2, (), site()))), rounded_shift);

    let product = Operations { products: 1, ..NONE };
    let two = Operations { products: 2, additions: 1, ..NONE };
    assert_eq!(cost(|| discard(height.multiply(weight, site()))), product);
    assert_eq!(cost(|| discard(height.multiply_two(weight, height, weight, site()))), two);
    // A lerp is two sums and its products; a slope has one sum less.
    let (pair, weights) = ([height; 2], [weight; 2]);
    let lerp = Operations { additions: 2, ..product };
    let lerp_two = Operations { additions: 4, ..two };
    assert_eq!(cost(|| discard(height.lerp(height, weight, site()))), lerp);
    assert_eq!(cost(|| discard(height.lerp_two(pair, weights, site()))), lerp_two);
    let slope = Operations { additions: 1, ..product };
    let slope_two = Operations { additions: 3, ..two };
    assert_eq!(cost(|| discard(height.multiply_difference(height, weight, site()))), slope);
    assert_eq!(cost(|| discard(height.multiply_differences(pair, weights, site()))), slope_two);
    let ratio = Ratio { exponent: 0, range: 4, format: () };
    let quotient = Operations { ratios: 1, ..NONE };
    assert_eq!(cost(|| discard::<Option<Ground>>(b.divide_array(a, ratio, site()))), quotient);
    assert_eq!(cost(|| discard::<Option<Ground>>(b.divide_direct(a, ratio, site()))), quotient);

    // Wiring is free.
    assert_eq!(
        cost(|| discard((a.is_positive(site()), a.is_negative(site()), a.is_exactly_zero()))),
        NONE
    );
    assert_eq!(cost(|| discard((a.leading_one(site()), a.overflowed(), a.hull(b)))), NONE);
    assert_eq!(cost(|| discard((place.cell(site()), place.fraction()))), NONE);
    assert_eq!(cost(|| discard((View::zero(()), a.value(), a.raw()))), NONE);
}

#[test]
fn counts_add_up_and_nest() {
    let step = View::load(0.001, ()).unwrap();
    let ((sum, inner), outer) = counted(|| {
        let sum = (0..1000).fold(View::zero(()), |at, _| at + step);
        // Work counted inside is not counted again outside.
        (sum, counted(|| discard(sum - step)).1)
    });
    assert_eq!(outer, additions(1000));
    assert_eq!(inner, additions(1));
    assert_eq!(sum.raw(), step.raw().map(|bits| bits * 1000));
    // Each thread counts its own work.
    let (other, here) = counted(|| {
        std::thread::scope(|scope| {
            scope.spawn(|| counted(|| discard(step + step)).1).join().unwrap()
        })
    });
    assert_eq!((other, here), (additions(1), NONE));
}

#[test]
fn a_tally_changes_no_bit() {
    let plain = View32::load(-0.3, ()).unwrap();
    let tallied = TallyWord::<View32>::load(-0.3, ()).unwrap();
    assert_eq!(plain.raw(), tallied.raw());
    assert_eq!((plain - plain.shift_floor(3)).raw(), (tallied - tallied.shift_floor(3)).raw());
    for &register in Register::ALL {
        assert_eq!(Tally(Wide).fixed(register), Wide.fixed(register));
    }
}
