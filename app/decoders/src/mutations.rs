//! Inputs of tests: bytes in hexadecimal digits, and seeded damage to them.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Bytes that are written as hexadecimal digits.
pub(crate) fn hex(text: &str) -> Vec<u8> {
    let digit = |byte: u8| (byte as char).to_digit(16).expect("a hexadecimal digit") as u8;
    text.as_bytes().chunks(2).map(|pair| digit(pair[0]) << 4 | digit(pair[1])).collect()
}

/// Versions of some bytes with flipped, replaced, lost and added ones, the same at each call.
pub(crate) fn mutations(bytes: &[u8], count: usize) -> Vec<Vec<u8>> {
    let mut random = ChaCha8Rng::seed_from_u64(bytes.len() as u64);
    let mut mutation = || {
        let mut bytes = bytes.to_vec();
        for _ in 0..random.random_range(1..4) {
            let place = random.random_range(0..bytes.len().max(1));
            let end = bytes.len().min(place + random.random_range(1..6));
            match random.random_range(0..8) {
                _ if bytes.is_empty() => {}
                0 => bytes.truncate(place),
                1..=3 => bytes[place] ^= 1 << random.random_range(0..8),
                // Headers are hit more often than their share of the bytes.
                4 | 5 => {
                    let place = place.min(random.random_range(0..64));
                    bytes[place] = random.next_u32() as u8;
                }
                6 => bytes[place] = [0, 255, 127, 128][random.random_range(0..4)],
                _ => {
                    let new: Vec<u8> = (0..random.random_range(0..6)).map(|_| random.next_u32() as u8).collect();
                    bytes.splice(place..end, new);
                }
            }
        }
        bytes
    };
    (0..count).map(|_| mutation()).collect()
}
