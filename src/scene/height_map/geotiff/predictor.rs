//! Predictors: what was done to a row before it was compressed, undone.

/// Predictor 2: every sample is the difference to the one before, as integers that wrap.
pub(super) fn undo_differences(raw: &mut [u8], width: usize, big_endian: bool) {
    for at in (width..raw.len()).step_by(width) {
        // Byte by byte from the lowest, with a carry.
        let mut carry = false;
        for place in 0..width {
            let byte = at + if big_endian { width - 1 - place } else { place };
            let (sum, over) = raw[byte].overflowing_add(raw[byte - width]);
            let (sum, over_again) = sum.overflowing_add(u8::from(carry));
            raw[byte] = sum;
            carry = over || over_again;
        }
    }
}

/// Predictor 3: bytes are differences, and the row holds the highest bytes of all samples, then the
/// next ones, and so on. Leaves the highest byte of each sample first.
pub(super) fn unshuffle(raw: &mut [u8], width: usize, row: &mut Vec<u8>) {
    for at in 1..raw.len() {
        raw[at] = raw[at].wrapping_add(raw[at - 1]);
    }
    row.clear();
    row.extend_from_slice(raw);
    let count = raw.len() / width;
    for (index, sample) in raw.chunks_exact_mut(width).enumerate() {
        for (place, byte) in sample.iter_mut().enumerate() {
            *byte = row[place * count + index];
        }
    }
}
