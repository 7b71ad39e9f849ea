//! sRGB in f64, by IEC 61966-2-1.

/// Byte nearest to a linear value.
pub fn srgb_byte(linear: f64) -> u8 {
    encoded(linear).round() as u8
}

/// Bytes nearest to three linear values, opaque.
pub fn srgb_pixel(linear: [f32; 3]) -> [u8; 4] {
    let [red, green, blue] = linear.map(|value| srgb_byte(f64::from(value)));
    [red, green, blue, 255]
}

/// Encoded value of a linear one, on the scale of a byte and before rounding; values out of range are clipped.
pub fn encoded(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    255.0 * if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Linear value of a byte.
pub fn linear(byte: u8) -> f64 {
    linear_of(f64::from(byte) / 255.0)
}

/// Linear value of an encoded one, on the scale where white is 1.
pub fn linear_of(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    //! Numbers from the standard: its breakpoint, and mid grey, 188 for half the light.

    use super::*;

    #[test]
    fn half_the_light_is_188() {
        assert_eq!(srgb_byte(0.5), 188);
        assert_eq!(srgb_pixel([0.0, 1.0, 2.0]), [0, 255, 255, 255]);
        assert!((encoded(0.003_130_8) / 255.0 - 0.040_45).abs() < 1e-6);
    }

    #[test]
    fn every_byte_comes_back() {
        assert!((0..=255).all(|byte| srgb_byte(linear(byte)) == byte));
    }
}
