//! The non-restoring divider array, on integers (equation 10): the datapath of `unit::divider`.

/// Floor of `numerator · 2^shift / denominator` where it lies in `-2^(bits-1) .. 2^(bits-1)`.
///
/// The numerator is biased by `denominator · 2^(bits-1)`, so that quotient bits are unsigned and
/// the range check is one comparison: the biased numerator must lie in
/// `0 .. denominator · 2^bits`. Then each stage shifts one numerator bit into the partial
/// remainder and adds or subtracts the denominator by the remainder's sign; the quotient bit is
/// one where the new remainder is not negative.
///
/// A negative `shift` drops bits of the numerator instead, which leaves the floor as it is.
/// `denominator` is positive and below 2^63, `bits` at most 62.
pub fn non_restoring(numerator: i128, denominator: i128, shift: i32, bits: u32) -> Option<i128> {
    debug_assert!(denominator > 0);
    let biased = aligned(numerator, shift)? + (denominator << (bits - 1));
    if biased < 0 || biased >= denominator << bits {
        return None;
    }
    let mut remainder = biased >> bits;
    let mut quotient = 0_i128;
    for stage in (0..bits).rev() {
        // Below the leading stages the remainder holds the numerator's next bit in its last place.
        let shifted = (remainder << 1) | ((biased >> stage) & 1);
        remainder = if remainder < 0 { shifted + denominator } else { shifted - denominator };
        quotient = (quotient << 1) | i128::from(remainder >= 0);
    }
    Some(quotient - (1 << (bits - 1)))
}

/// The result of [`non_restoring`] by the host's own division.
pub fn direct(numerator: i128, denominator: i128, shift: i32, bits: u32) -> Option<i128> {
    let numerator = aligned(numerator, shift)?;
    let limit = denominator << (bits - 1);
    (-limit <= numerator && numerator < limit).then(|| numerator.div_euclid(denominator))
}

/// The numerator times the ratio's power of two; `None` where it is beyond every denominator's
/// range. `floor(n / (d·2^s)) = floor(floor(n / 2^s) / d)`, so bits below may be dropped.
fn aligned(numerator: i128, shift: i32) -> Option<i128> {
    if shift < 0 {
        return Some(numerator >> (-shift).min(127));
    }
    // 2^126 is more than any denominator below 2^63 times 2^62.
    let room = numerator.unsigned_abs().leading_zeros() as i32 - 2;
    if numerator == 0 || shift <= room { Some(numerator << (shift % 128)) } else { None }
}
