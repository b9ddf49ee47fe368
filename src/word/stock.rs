//! The stock worlds: fixed point at one format per class, in two word sizes.
//!
//! Words are newtypes over the `fixed` crate, which stays in this file. Sums wrap; the plan
//! proves that none does. `fixed` floors products and truncates quotients, so every rounding here
//! is our own: to nearest, ties upward, which in hardware is an addition of half a bit.
//!
//! | class | [`Narrow`] (32 bits) | [`Wide`] (64 bits) |
//! |---|---|---|
//! | view | Q2.30 | Q26.38 |
//! | ground, height, weight, tone | Q12.20 | Q40.24 |

use std::ops::{Add, Neg, Sub};

use fixed::types::extra::{U20, U24, U30, U38};
use fixed::{FixedI32, FixedI64};

use super::{
    Cell, Divide, Enter, Fixed, Lane, Load, Multiply, Ratio, Readout, Register, Rescale, Site,
    Table, Word, World, array,
};

/// Integer and fraction bits of a stock word, for conversions inside this file.
trait Bits: Copy {
    type Int;
    const POINT: u32;
    fn bits(self) -> Self::Int;
    fn of(bits: Self::Int) -> Self;
}

macro_rules! stock_words {
    ($world:ident $name:literal, $int:ident, $product:ident, $fixed:ident,
     $($(#[$doc:meta])* $word:ident: $fraction:ident,)*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq)]
            #[repr(transparent)]
            pub struct $word($fixed<$fraction>);

            impl Bits for $word {
                type Int = $int;
                const POINT: u32 = <$fixed<$fraction>>::FRAC_NBITS;
                #[inline(always)]
                fn bits(self) -> $int {
                    self.0.to_bits()
                }
                #[inline(always)]
                fn of(bits: $int) -> Self {
                    Self(<$fixed<$fraction>>::from_bits(bits))
                }
            }

            impl Add for $word {
                type Output = Self;
                #[inline(always)]
                fn add(self, other: Self) -> Self {
                    Self(self.0.wrapping_add(other.0))
                }
            }

            impl Sub for $word {
                type Output = Self;
                #[inline(always)]
                fn sub(self, other: Self) -> Self {
                    Self(self.0.wrapping_sub(other.0))
                }
            }

            impl Neg for $word {
                type Output = Self;
                #[inline(always)]
                fn neg(self) -> Self {
                    Self(self.0.wrapping_neg())
                }
            }

            impl Word for $word {
                type Format = ();

                #[inline(always)]
                fn zero((): ()) -> Self {
                    Self::of(0)
                }
                #[inline(always)]
                fn shift_floor(self, places: u32) -> Self {
                    Self::of(self.bits() >> places.min($int::BITS - 1))
                }
                #[inline(always)]
                fn shift_toward_zero(self, places: u32) -> Self {
                    if places >= $int::BITS {
                        return Self::of(0);
                    }
                    // Adding 2^places - 1 to a negative value turns the floor into truncation.
                    let sign = self.bits() >> ($int::BITS - 1);
                    Self::of(self.bits().wrapping_add(sign & ((1 as $int) << places).wrapping_sub(1)) >> places)
                }
                #[inline(always)]
                fn shift_left(self, places: u32) -> Self {
                    Self::of(self.bits() << places)
                }
                #[inline(always)]
                fn magnitude(self) -> Self {
                    Self::of(self.bits().wrapping_abs())
                }
                #[inline(always)]
                fn is_below(self, other: Self, _: Site) -> bool {
                    self.bits() < other.bits()
                }
                #[inline(always)]
                fn is_positive(self, _: Site) -> bool {
                    self.bits() > 0
                }
                #[inline(always)]
                fn is_negative(self, _: Site) -> bool {
                    self.bits() < 0
                }
                #[inline(always)]
                fn lesser(self, other: Self) -> Self {
                    Self(self.0.min(other.0))
                }
                #[inline(always)]
                fn greater(self, other: Self) -> Self {
                    Self(self.0.max(other.0))
                }
                #[inline(always)]
                fn is_exactly_zero(self) -> bool {
                    self.bits() == 0
                }
                #[inline(always)]
                fn leading_one(self, _: Site) -> i32 {
                    const TOP: i32 = $int::BITS as i32 - 1;
                    TOP - self.magnitude().bits().leading_zeros() as i32 - Self::POINT as i32
                }
            }

            impl Cell for $word {
                #[inline(always)]
                fn cell(self, _: Site) -> i32 {
                    (self.bits() >> Self::POINT) as i32
                }
                #[inline(always)]
                fn fraction(self) -> Self {
                    Self::of(self.bits() & ((1 << Self::POINT) - 1))
                }
                #[inline(always)]
                fn nearest(self, site: Site) -> i32 {
                    self.cell(site).wrapping_add((self.bits() >> (Self::POINT - 1) & 1) as i32)
                }
                #[inline(always)]
                fn fraction_from_midpoint(self) -> Self {
                    Self::of(self.bits().wrapping_add(1 << (Self::POINT - 1))).fraction()
                }
                #[inline(always)]
                fn look_up<T: Word>(self, table: &Table<T>, _: Site) -> T {
                    table.at(self.address(table.log2()))
                }
                #[inline(always)]
                fn look_up_mirrored<T: Word, const N: usize>(
                    self,
                    tables: [&Table<T>; N],
                    _: Site,
                ) -> [[T; 2]; N] {
                    tables.map(|table| table.both_ways(self.address(table.log2())))
                }
            }

            impl $word {
                /// Of the entry nearest to this argument.
                #[inline(always)]
                fn address(self, log2: u32) -> usize {
                    let places = Self::POINT - log2;
                    ((self.bits() + (1 << (places - 1))) >> places) as usize
                }
            }

            impl<By: Bits<Int = $int> + Word> Multiply<By> for $word {
                #[inline(always)]
                fn multiply(self, by: By, _: Site) -> Self {
                    let product = $product::from(self.bits()) * $product::from(by.bits());
                    Self::of(((product + (1 << (By::POINT - 1))) >> By::POINT) as $int)
                }
                #[inline(always)]
                fn multiply_two(self, by: By, other: Self, other_by: By, _: Site) -> Self {
                    let product = ($product::from(self.bits()) * $product::from(by.bits()))
                        .wrapping_add($product::from(other.bits()) * $product::from(other_by.bits()));
                    Self::of(((product + (1 << (By::POINT - 1))) >> By::POINT) as $int)
                }
            }

            impl<To: Bits<Int = $int> + Word<Format = ()>> Rescale<To> for $word {
                #[inline(always)]
                fn rescale(self, exponent: i32, (): (), _: Site) -> To {
                    let places = Self::POINT as i32 - To::POINT as i32 - exponent;
                    let bits = self.bits();
                    To::of(if places > 0 {
                        // The bit below the last one rounds; half a bit added before the shift
                        // could overflow.
                        let places = (places as u32).min($int::BITS) - 1;
                        (bits >> places >> 1) + (bits >> places & 1)
                    } else {
                        // Nothing is left of bits that are shifted out of the word.
                        bits.checked_shl((-places) as u32).unwrap_or(0)
                    })
                }
            }

            impl Load for $word {
                fn load(value: f64, (): ()) -> Option<Self> {
                    <$fixed<$fraction>>::checked_from_num(value).map(Self)
                }
                fn load_raw(bits: i64, (): ()) -> Option<Self> {
                    let kept = bits as $int;
                    (i64::from(kept) == bits).then(|| Self::of(kept))
                }
            }

            impl Readout for $word {
                fn value(self) -> f64 {
                    self.0.to_num::<f64>()
                }
                fn raw(self) -> Option<i64> {
                    Some(i64::from(self.bits()))
                }
            }

            impl Enter for $word {
                #[inline(always)]
                fn after(self, step: Self, k: u32) -> Self {
                    Self::of(self.bits().wrapping_add(step.bits().wrapping_mul(k as $int)))
                }
            }

            impl Lane for $word {
                type Int = $int;
                const FRACTION: u32 = Self::POINT;

                #[inline(always)]
                fn int(self) -> $int {
                    self.bits()
                }
                #[inline(always)]
                fn of_int(int: $int) -> Self {
                    Self::of(int)
                }
            }
        )*
    };
}

macro_rules! stock_world {
    ($(#[$doc:meta])* $world:ident $name:literal,
     $view:ident $ground:ident $height:ident $weight:ident $tone:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $world;

        impl World for $world {
            type View = $view;
            type Ground = $ground;
            type Height = $height;
            type Weight = $weight;
            type Tone = $tone;

            fn name(&self) -> &'static str {
                $name
            }
            #[inline(always)]
            fn view(&self, _: Register) {}
            #[inline(always)]
            fn ground(&self, _: Register) {}
            #[inline(always)]
            fn height(&self, _: Register) {}
            #[inline(always)]
            fn weight(&self, _: Register) {}
            #[inline(always)]
            fn tone(&self, _: Register) {}
            fn fixed(&self, register: Register) -> Option<Fixed> {
                use super::Class;
                fn format<T: Bits>() -> Fixed {
                    Fixed { width: 8 * size_of::<T>() as u32, point: T::POINT }
                }
                Some(match register.class() {
                    Class::View => format::<$view>(),
                    Class::Ground => format::<$ground>(),
                    Class::Height => format::<$height>(),
                    Class::Weight => format::<$weight>(),
                    Class::Tone => format::<$tone>(),
                })
            }
        }
    };
}

stock_words! { Narrow "narrow", i32, i64, FixedI32,
    /// View word of 32 bits, Q2.30.
    View32: U30,
    /// Ground word of 32 bits, Q12.20.
    Ground32: U20,
    /// Height word of 32 bits, Q12.20.
    Height32: U20,
    /// Weight word of 32 bits, Q12.20.
    Weight32: U20,
    /// Tone word of 32 bits, Q12.20.
    Tone32: U20,
}

stock_words! { Wide "wide", i64, i128, FixedI64,
    /// View word of 64 bits, Q26.38.
    View64: U38,
    /// Ground word of 64 bits, Q40.24.
    Ground64: U24,
    /// Height word of 64 bits, Q40.24.
    Height64: U24,
    /// Weight word of 64 bits, Q40.24.
    Weight64: U24,
    /// Tone word of 64 bits, Q40.24.
    Tone64: U24,
}

stock_world! {
    /// 32-bit words.
    Narrow "narrow", View32 Ground32 Height32 Weight32 Tone32
}

stock_world! {
    /// 64-bit words.
    Wide "wide", View64 Ground64 Height64 Weight64 Tone64
}

/// Shift and quotient bits of a ratio whose quotient has `point` fraction bits.
#[inline(always)]
fn stages(ratio: Ratio<()>, point: u32) -> (i32, u32) {
    (ratio.exponent + point as i32, ratio.range + point + 1)
}

impl Divide<Ground32> for View32 {
    fn divide_array(self, denominator: Self, ratio: Ratio<()>, _: Site) -> Option<Ground32> {
        let (shift, bits) = stages(ratio, Ground32::POINT);
        array::non_restoring(self.bits().into(), denominator.bits().into(), shift, bits)
            .map(|quotient| Ground32::of(quotient as i32))
    }

    #[inline(always)]
    fn divide_direct(self, denominator: Self, ratio: Ratio<()>, _: Site) -> Option<Ground32> {
        let (shift, bits) = stages(ratio, Ground32::POINT);
        if !(0..=31).contains(&shift) {
            return array::direct(self.bits().into(), denominator.bits().into(), shift, bits)
                .map(|quotient| Ground32::of(quotient as i32));
        }
        // |numerator| <= 2^31 and shift <= 31; denominator < 2^31 and bits <= 32: 64 bits do.
        let denominator = i64::from(denominator.bits());
        let numerator = i64::from(self.bits()) << shift;
        let limit = denominator << (bits - 1);
        (-limit <= numerator && numerator < limit)
            .then(|| Ground32::of(numerator.div_euclid(denominator) as i32))
    }
}

impl Divide<Ground64> for View64 {
    fn divide_array(self, denominator: Self, ratio: Ratio<()>, _: Site) -> Option<Ground64> {
        let (shift, bits) = stages(ratio, Ground64::POINT);
        array::non_restoring(self.bits().into(), denominator.bits().into(), shift, bits)
            .map(|quotient| Ground64::of(quotient as i64))
    }

    #[inline(always)]
    fn divide_direct(self, denominator: Self, ratio: Ratio<()>, _: Site) -> Option<Ground64> {
        let (shift, bits) = stages(ratio, Ground64::POINT);
        array::direct(self.bits().into(), denominator.bits().into(), shift, bits)
            .map(|quotient| Ground64::of(quotient as i64))
    }
}
